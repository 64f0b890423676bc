"""numpy's files: .npy with frames alone, .npz with the mesh and what belongs to it."""

import io
import zipfile
from pathlib import Path

import numpy as np

from .._core import TetMesh
from ..domain.sites import SITES
from ..errors import InvalidInput, IoError
from ..files.reading import read_bytes, require_unpackable, write_whole
from .base import Field, FrameFile, from_axes, from_quaternions, stretched

_UNITS = {1: "read_array_header_1_0", 2: "read_array_header_2_0"}


def read_npy(path: Path) -> FrameFile:
    return _frames(path, "npy", "vertices", _array(read_bytes(path), str(path)))


def _frames(path: Path, name: str, where: str, values: np.ndarray) -> FrameFile:
    """(n, 4) quaternions w x y z, (n, 9) axes one after the other, or (n, 3, 3) with the axes in columns."""
    if values.dtype.kind not in "fiu" or values.shape[1:] not in ((4,), (9,), (3, 3)):
        raise InvalidInput(
            f"{path}: an array of {values.dtype} with shape {values.shape}; (n, 4), (n, 9) or (n, 3, 3) numbers are"
            " needed",
            "bad_shape",
        )
    values = values.astype(float)
    if values.shape[1:] == (4,):
        return from_quaternions(path, name, where, values)
    return from_axes(path, name, where, np.swapaxes(values.reshape(-1, 3, 3), 1, 2) if values.ndim == 2 else values)


def _array(data: bytes, name: str) -> np.ndarray:
    """Without pickles, and never larger than the data."""
    stream = io.BytesIO(data)
    try:
        version = np.lib.format.read_magic(stream)
        shape, fortran, dtype = getattr(np.lib.format, _UNITS[version[0]])(stream)
    except Exception as error:  # the head is Python text: whatever its tokenizer raises
        raise IoError(f"{name}, byte 0: no .npy array ({error})") from error
    start, count = stream.tell(), 1
    for length in shape:
        count *= length
    if dtype.hasobject or min(shape, default=0) < 0 or len(data) - start != count * dtype.itemsize:
        raise IoError(
            f"{name}, byte {start}: {len(data) - start} bytes; an array of {dtype} with shape {shape} is announced"
        )
    return np.frombuffer(data, dtype, count, start).reshape(shape, order="F" if fortran else "C")


def write_npy(path: Path, field: Field) -> None:
    write_whole(path, [_packed(np.ascontiguousarray(field.frames, "<f8"))])


def _packed(values: np.ndarray) -> bytes:
    stream = io.BytesIO()
    np.lib.format.write_array(stream, np.array(values, order="C"), allow_pickle=False)
    return stream.getvalue()


def read_npz(path: Path) -> FrameFile:
    """Arrays frames and where, or rotation and stretch; vertices and tets (the mesh), lengths, features, regions if
    there."""
    parts = _members(path)
    stretch = _numbers(path, parts, "stretch", 6) if {"rotation", "stretch"} <= parts.keys() else None
    if stretch is not None:
        parts["frames"] = parts["rotation"]
    if "frames" not in parts:
        raise InvalidInput(f"{path}: has no array frames (but {', '.join(sorted(parts)) or 'nothing'})", "no_frames")
    where = str(parts.pop("where", np.array("vertices")))
    if where not in SITES:
        raise InvalidInput(f"{path}: array where says {where[:20]!r}; vertices or tets are known", "bad_shape")
    result = _frames(path, "npz", where, parts["frames"])
    if stretch is not None:
        stretched(result, stretch)
    if "vertices" in parts and "tets" in parts:
        result.mesh = TetMesh(_numbers(path, parts, "vertices", 3).astype(float), _ids(path, parts, "tets", 4))
    if "lengths" in parts:
        result.lengths = _numbers(path, parts, "lengths", 3).astype(float)
    if "features" in parts:
        result.features = _ids(path, parts, "features", 2)
    if "regions" in parts:
        result.regions = _ids(path, parts, "regions", None)
    return result


def _members(path: Path) -> dict[str, np.ndarray]:
    data = read_bytes(path)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as folder:
            members = [member for member in folder.infolist() if member.filename.endswith(".npy")]
            require_unpackable(str(path), sum(member.file_size for member in members), path.stat().st_size)
            return {
                member.filename[:-4]: _array(folder.read(member), f"{path}:{member.filename}") for member in members
            }
    except IoError:
        raise
    except Exception as error:  # damaged members raise what zlib, zipfile and struct raise
        raise IoError(f"{path}: no .npz file, or damaged ({error})") from error


def _numbers(path: Path, parts: dict[str, np.ndarray], name: str, width: int | None) -> np.ndarray:
    values = parts[name]
    if (
        values.dtype.kind not in "fiu"
        or values.ndim != (1 if width is None else 2)
        or (width and values.shape[1] != width)
    ):
        raise InvalidInput(f"{path}: array {name} has shape {values.shape} of {values.dtype}", "bad_shape")
    return values


def _ids(path: Path, parts: dict[str, np.ndarray], name: str, width: int | None) -> np.ndarray:
    values = _numbers(path, parts, name, width)
    if values.dtype.kind == "f" or (values.size and (values.min() < -(2**31) or values.max() >= 2**31)):
        raise InvalidInput(f"{path}: array {name} holds no ids of 32 bits", "bad_shape")
    return values.astype(np.int32)


def write_npz(path: Path, field: Field) -> None:
    parts = {"frames" if field.stretch is None else "rotation": field.frames, "where": np.array(field.where)}
    if field.mesh is not None:
        parts |= {"vertices": field.mesh.vertices, "tets": field.mesh.tets}
    for name in ("lengths", "stretch", "features", "regions"):
        if getattr(field, name) is not None:
            parts[name] = getattr(field, name)
    if field.combed is not None:
        parts |= field.combed.arrays()
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as folder:  # no times: equal fields, equal bytes
        for name, values in parts.items():
            folder.writestr(zipfile.ZipInfo(f"{name}.npy"), _packed(np.asarray(values)))
    write_whole(path, [stream.getvalue()])
