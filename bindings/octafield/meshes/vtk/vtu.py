"""VTK's XML files of unstructured grids (.vtu): text, base64 and raw, packed or not, in one or several pieces, errors
with their line or byte.

meshio reads these too, but of several pieces keeps the cells of the last alone, leaves out arrays that do not fit, and
does not say where. Layout: VTK file formats, XML formats.
"""

import base64
import binascii
import lzma
import re
import zlib
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any
from xml.parsers import expat

import numpy as np

from ...errors import InvalidInput, IoError
from ...files.reading import numbers_of, require_unpackable
from ..cell_mesh import CellMesh
from .legacy import from_offsets, mesh_of_cells, whole_numbers

NUMBERS = {
    f"{sign}{8 * size}": f"{code}{size}" for sign, code in (("Int", "i"), ("UInt", "u")) for size in (1, 2, 4, 8)
} | {"Float32": "f4", "Float64": "f8"}
FEATURES = "feature_edges"  # field data of octafield's own files: pairs of ids of points
_UNPACK: dict[str, Callable[[], Any]] = {
    "vtkZLibDataCompressor": zlib.decompressobj,
    "vtkLZMADataCompressor": lzma.LZMADecompressor,
}


@dataclass
class _Array:
    """A DataArray. line: where it begins; text_line: where its text does."""

    section: str
    attributes: dict[str, str]
    line: int
    text_line: int = 0
    text: list[str] = field(default_factory=list)


@dataclass
class Piece:
    counts: dict[str, int]
    arrays: list[_Array] = field(default_factory=list)


@dataclass
class File:
    name: str
    root: dict[str, str] = field(default_factory=dict)
    pieces: list[Piece] = field(default_factory=list)
    features: _Array | None = None  # field data
    appended: bytes = b""
    raw: bool = False
    appended_at: int = 0
    size: int = 0  # of the file, which bounds what its arrays may become
    unpacked: int = 0  # so far

    def fail(self, line: int, what: str) -> IoError:
        return IoError(f"{self.name}, line {line}: {what}")


def read_vtu(data: bytes, name: str, size: int = 0) -> CellMesh:
    """size: of the file, where that is packed as a whole."""
    file = parsed(data, name, "UnstructuredGrid", ("NumberOfPoints", "NumberOfCells"))
    file.size = size or file.size
    parts = [_piece(file, piece) for piece in file.pieces]
    start = np.cumsum([0, *(len(part["points"]) for part in parts)])
    ends = np.cumsum([0, *(len(part["numbers"]) for part in parts)])
    points, sizes, types = (np.concatenate([part[what] for part in parts]) for what in ("points", "sizes", "types"))
    numbers = np.concatenate([part["numbers"] + first for part, first in zip(parts, start[:-1], strict=True)])
    starts = np.concatenate([part["starts"] + first for part, first in zip(parts, ends[:-1], strict=True)])
    data_of = {
        site: {
            key: _joined([part[site][key] for part in parts])
            for key in parts[0][site]
            if all(key in p[site] for p in parts)
        }
        for site in ("PointData", "CellData")
    }
    of_points, of_cells = (
        {key: values for key, values in data_of[site].items() if values is not None} for site in data_of
    )
    mesh = mesh_of_cells(points, numbers, starts, sizes, types, of_points, of_cells, name)
    if file.features is not None and len(parts) == 1:
        edges = values_of(file, file.features)
        if edges.shape[1] != 2 or (edges < 0).any() or (edges >= len(points)).any():
            raise file.fail(file.features.line, f"{FEATURES}: pairs of ids of the {len(points)} points are needed")
        mesh.features = whole_numbers(edges, f"{name}: {FEATURES}")
    return mesh


def _joined(parts: list[np.ndarray]) -> np.ndarray | None:
    return np.concatenate(parts) if len({part.shape[1:] for part in parts}) == 1 else None


def parsed(data: bytes, name: str, kind: str, counted: tuple[str, ...]) -> File:
    """The arrays of a VTKFile of this type, not yet decoded. counted: attributes of its Pieces with their numbers;
    none: 0, but for the first."""
    file, path, reading = (
        File(name, size=len(data)),
        list[str](),
        list[_Array](),
    )  # reading: the array that text belongs to, or none
    parser = expat.ParserCreate()
    parser.buffer_text = True

    def start(tag: str, attributes: dict[str, str]) -> None:
        line = parser.CurrentLineNumber
        if not path and tag != "VTKFile":
            raise file.fail(line, f"<{tag[:40]}>; a file of VTK's begins with <VTKFile>")
        if not path:
            file.root = attributes
            if attributes.get("type") != kind:
                raise InvalidInput(
                    f"{name}, line {line}: VTKFile of type {attributes.get('type')}; {kind} is needed: name the file by"
                    " its type",
                    "unsupported_cells",
                )
        path.append(tag)
        if tag == "Piece":
            numbers = {
                key: attributes.get(key, "" if key == counted[0] or len(counted) == 2 else "0") for key in counted
            }
            for key, number in numbers.items():
                if not re.fullmatch(r"\s*\d{1,15}\s*", number):
                    raise file.fail(line, f"Piece with {key} {number[:20]!r}: a number is needed")
            file.pieces.append(Piece({key: int(number) for key, number in numbers.items()}))
        elif tag == "DataArray" and "Piece" in path and len(path) > 2:
            file.pieces[-1].arrays.append(_Array(path[-2], attributes, line))
            reading[:] = file.pieces[-1].arrays[-1:]
        elif (
            tag == "DataArray"
            and "FieldData" in path
            and attributes.get("Name") == FEATURES
            and attributes.get("type") in NUMBERS
        ):
            file.features = _Array("FieldData", attributes, line)
            reading[:] = [file.features]
        else:
            reading.clear()

    def end(tag: str) -> None:
        path.pop()

    def text(value: str) -> None:
        if path and path[-1] == "DataArray" and reading:
            array = reading[-1]
            array.text_line = array.text_line or parser.CurrentLineNumber
            array.text.append(value)

    parser.StartElementHandler, parser.EndElementHandler, parser.CharacterDataHandler = start, end, text
    tail = re.search(rb"<AppendedData\b([^>]*)>\s*_", data)
    try:
        parser.Parse(data if tail is None else data[: tail.start()], tail is None)
    except expat.ExpatError as error:
        raise file.fail(
            error.lineno, f"no XML, or damaged ({expat.errors.messages[error.code]}); is the file cut?"
        ) from error
    if tail is not None:
        stop = data.rfind(b"</AppendedData>")
        if stop < tail.end() or b"</VTKFile>" not in data[stop:]:
            raise IoError(
                f"{name}, byte {len(data)}: ends within AppendedData: the file is cut; write or download it again"
            )
        file.appended, file.raw, file.appended_at = data[tail.end() : stop], b'"raw"' in tail[1], tail.end()
    if not file.pieces:
        raise IoError(f"{name}: holds no Piece of {'an' if kind[0] in 'AEIOU' else 'a'} {kind}")
    if any(
        file.root.get(key) not in known
        for key, known in (
            ("byte_order", (None, "LittleEndian", "BigEndian")),
            ("header_type", (None, "UInt32", "UInt64")),
        )
    ):
        raise IoError(
            f"{name}, line 1: byte_order {file.root.get('byte_order')!r} with header_type"
            f" {file.root.get('header_type')!r} is not read"
        )
    if file.root.get("compressor") not in (None, "", *_UNPACK):
        raise IoError(
            f"{name}: packed by {file.root['compressor']}, which is not read; save it with ZLib or not packed"
        )
    return file


def _piece(file: File, piece: Piece) -> dict[str, Any]:
    sections: dict[str, dict[str, tuple[_Array, np.ndarray]]] = {
        "Points": {},
        "Cells": {},
        "PointData": {},
        "CellData": {},
    }
    for array in piece.arrays:
        if array.section in sections and array.attributes.get("type") in NUMBERS:  # others are strings
            sections[array.section][array.attributes.get("Name", "")] = array, values_of(file, array)
    for key in ("connectivity", "offsets", "types"):
        if key not in sections["Cells"]:
            raise IoError(f"{file.name}: Cells have no array {key}")
    points = points_of(file, piece, list(sections["Points"].values()))
    cells = {key: (array, values.ravel()) for key, (array, values) in sections["Cells"].items()}
    for key in ("offsets", "types"):
        require_rows(file, *cells[key], piece.counts["NumberOfCells"])
    places = {key: f"{file.name}, line {array.line}" for key, (array, _) in cells.items()}
    numbers, types = (whole_numbers(cells[key][1], f"{places[key]}: {key}") for key in ("connectivity", "types"))
    starts, sizes = from_offsets(np.concatenate([[0], cells["offsets"][1]]), len(numbers), places["offsets"])
    for key, count in (("PointData", piece.counts["NumberOfPoints"]), ("CellData", piece.counts["NumberOfCells"])):
        for array, values in sections[key].values():
            require_rows(file, array, values, count)
    data = {site: {key: values for key, (_, values) in sections[site].items()} for site in ("PointData", "CellData")}
    return {"points": points, "numbers": numbers, "starts": starts, "sizes": sizes, "types": types, **data}


def points_of(file: File, piece: Piece, arrays: list[tuple[_Array, np.ndarray]]) -> np.ndarray:
    if not arrays and piece.counts["NumberOfPoints"] == 0:  # as VTK writes what is empty
        return np.empty((0, 3))
    if len(arrays) != 1:
        raise IoError(f"{file.name}: a Piece has {len(arrays)} arrays of Points; one is needed")
    array, points = arrays[0]
    require_rows(file, array, points, piece.counts["NumberOfPoints"])
    if points.shape[1] != 3:
        raise file.fail(array.line, f"Points have {points.shape[1]} components; 3 are needed")
    return points.astype(float)


def require_rows(file: File, array: _Array, values: np.ndarray, count: int) -> None:
    if len(values) != count:
        raise file.fail(
            array.line,
            f"array {array.attributes.get('Name', '')} of {array.section} has {len(values)} rows; the Piece has"
            f" {count}",
        )


def values_of(file: File, array: _Array) -> np.ndarray:
    """(n, components)."""
    name, how = array.attributes.get("Name", ""), array.attributes.get("format", "ascii")
    if how == "ascii":
        values = numbers_of("".join(array.text), file.name, array.text_line or array.line)
    elif how in ("binary", "appended"):
        order = ">" if file.root.get("byte_order") == "BigEndian" else "<"
        dtype = np.dtype(order + NUMBERS[array.attributes["type"]])
        content = _decoded(file, array, how, order)
        if len(content) % dtype.itemsize:
            raise file.fail(array.line, f"array {name} has {len(content)} bytes, of numbers with {dtype.itemsize}")
        values = np.frombuffer(content, dtype).astype(dtype.newbyteorder("="))
    else:
        raise file.fail(array.line, f"array {name} in format {how[:20]!r}, which is not read")
    width = array.attributes.get("NumberOfComponents") or "1"
    if not re.fullmatch(r"\s*[1-9]\d{0,3}\s*", width) or len(values) % int(width):
        raise file.fail(array.line, f"array {name} has {len(values)} numbers in rows of {width[:20]}")
    return values.reshape(-1, int(width))


def _decoded(file: File, array: _Array, how: str, order: str) -> bytes:
    """The bytes of an array: after a head of their number or, packed, of the blocks' sizes."""
    name = array.attributes.get("Name", "")
    head = np.dtype(order + ("u8" if file.root.get("header_type") == "UInt64" else "u4"))
    raw, source = False, "".join("".join(array.text).split()).encode()
    if how == "appended":
        offset = array.attributes.get("offset", "")
        if not re.fullmatch(r"\s*\d{1,18}\s*", offset) or int(offset) >= len(file.appended):
            raise file.fail(
                array.line, f"array {name} at offset {offset[:20]!r} of {len(file.appended)} appended bytes"
            )
        raw, source = file.raw, file.appended[int(offset) :]
    take = _take_raw if raw else _take_base64
    try:
        if not file.root.get("compressor"):
            size = int(np.frombuffer(take(source, 0, head.itemsize), head)[0])
            return take(source, 0, head.itemsize + size)[head.itemsize :]
        count = int(np.frombuffer(take(source, 0, head.itemsize), head)[0])
        full, last, *_ = ahead = np.frombuffer(take(source, 0, head.itemsize * (3 + count)), head)[1:].astype(np.int64)
        sizes = ahead[2:]
        begin = (
            head.itemsize * (3 + count) if raw else 4 * -(-head.itemsize * (3 + count) // 3)
        )  # the head is encoded by itself
        ends = np.cumsum(sizes)
        if (sizes < 0).any() or (len(ends) and ends[-1] > len(source)):
            raise ValueError("blocks beyond the end")
        packed = take(source, begin, int(ends[-1]) if len(ends) else 0)
        announced = [int(full)] * (count - 1) + [int(last or full)] if count else []
        if min(announced, default=0) < 0:
            raise ValueError("blocks of less than no bytes")
        file.unpacked += sum(announced)
        require_unpackable(f"{file.name}, line {array.line}", file.unpacked, file.size)
        return b"".join(
            _block(file, packed[e - s : e], size) for s, e, size in zip(sizes, ends, announced, strict=True)
        )
    except (ValueError, binascii.Error, zlib.error, lzma.LZMAError, EOFError, OverflowError) as error:
        raise file.fail(array.line, f"array {name} is cut or damaged ({error})") from error


def _block(file: File, packed: bytes, size: int) -> bytes:
    """Of the announced size, which bounds the memory."""
    unpacker = _UNPACK[file.root["compressor"]]()
    unpacked: bytes = unpacker.decompress(packed, size + 1)
    if len(unpacked) != size or not unpacker.eof:
        raise ValueError(f"a block does not end after the {size} bytes announced")
    return unpacked


def _take_raw(source: bytes, start: int, count: int) -> bytes:
    if start + count > len(source):
        raise ValueError(f"{count} bytes are needed, {max(len(source) - start, 0)} are left")
    return source[start : start + count]


def _take_base64(source: bytes, start: int, count: int) -> bytes:
    """The first `count` bytes that are encoded from `start` on."""
    characters = 4 * -(-count // 3)
    if start + characters > len(source):
        raise ValueError(f"{characters} characters are needed, {max(len(source) - start, 0)} are left")
    return base64.b64decode(source[start : start + characters], validate=True)[:count]
