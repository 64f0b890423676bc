"""CubeCover's .fra and .perm, and MINT's binary .bfra."""

import struct
from pathlib import Path

import numpy as np

from .. import _core
from ..domain.rotations import axes_in_rows, axes_of
from ..errors import InvalidInput, IoError
from ..files.reading import head_of, plain_name, read_bytes, read_text, rows_of, table_of, write_all, write_whole
from .base import Field, FrameFile, from_axes
from .text import columns_of, count_in, require_count

_BINARY_HEAD = struct.Struct("<6siii")  # "FRA 2" and a zero byte; rows: tets; columns: 9; vectors per tet


def read_fra(path: Path) -> FrameFile:
    (head, counts), body, first = head_of(read_text(path), 2)
    if head.split() != ["FRA", "1"]:
        raise IoError(f"{path}, line 1: 'FRA 1' is needed, not {head[:40]!r}")
    words = counts.split()
    if len(words) != 3:
        raise IoError(f"{path}, line 2: the number of tets, of vectors per tet and a type are needed")
    count, vectors, _ = (count_in(word, f"{path}, line 2", "tets and vectors") for word in words)
    _require_three(vectors, f"{path}, line 2")
    rows, numbers = table_of(body, str(path), 3, first_line=first)
    require_count(len(rows), 3 * count, path, first + body.rstrip().count("\n"), "vectors")
    return from_axes(path, "fra", "tets", columns_of(rows.reshape(-1, 9)), numbers[::3])


def _require_three(vectors: int, place: str) -> None:
    if vectors != 3:
        raise InvalidInput(f"{place}: {vectors} vectors per tet; a frame has 3", "not_frames")


def write_fra(path: Path, field: Field) -> None:
    """And .perm beside it."""
    rows = axes_in_rows(field.frames, field.lengths).reshape(-1, 3)
    perm = permutations(field)
    stem = path.name[: len(plain_name(path).removesuffix(".fra"))]
    beside = path.with_name(stem + ".perm")
    write_all(
        [
            (path, [f"FRA 1\n{len(field.frames)} 3 1\n".encode(), *rows_of(rows)]),
            (beside, [f"PERM 1\n{len(field.frames)} {len(perm)} 3\n".encode(), *rows_of(perm)]),
        ]
    )


def permutations(field: Field) -> np.ndarray:
    """(k, 5): two tets, ids from 0, and p1 p2 p3: vector i of the first times the sign of pi is closest to vector |pi|,
    from 1, of the second. Where that is the identity there is no row. Combed frames: rows of the cut alone."""
    faces = field.matchings()
    tets, matched = np.asarray(faces.tets), np.asarray(faces.matching)
    group = np.rint(axes_of(np.asarray(_core.octahedral_group()))).astype(
        int
    )  # R1 o is close to R2: column j of R2 is sum_i R1_i o_ij
    column = np.abs(group).argmax(axis=2)  # row i of o has its entry there
    sign = np.take_along_axis(group, column[:, :, None], axis=2)[:, :, 0]
    rows = (sign * (column + 1))[matched]
    changed = matched != 0
    return np.column_stack([tets[changed], rows[changed]])


def read_bfra(path: Path) -> FrameFile:
    data = read_bytes(path)
    if len(data) < _BINARY_HEAD.size or not data.startswith(b"FRA 2"):
        raise IoError(f"{path}, byte 0: 'FRA 2' and three counts are needed")
    _, rows, columns, vectors = _BINARY_HEAD.unpack_from(data)
    _require_three(columns // 3 if columns % 3 == 0 else vectors, f"{path}, byte 10")
    have = len(data) - _BINARY_HEAD.size
    if rows < 0 or have != 8 * 9 * rows:
        raise IoError(f"{path}, byte {_BINARY_HEAD.size}: {have} bytes of numbers; {rows} rows of 9 take {72 * rows}")
    numbers = np.frombuffer(data, "<f8", offset=_BINARY_HEAD.size).reshape(9, rows).T  # column by column
    return from_axes(path, "bfra", "tets", columns_of(np.ascontiguousarray(numbers)))


def write_bfra(path: Path, field: Field) -> None:
    rows = axes_in_rows(field.frames, field.lengths)
    head = _BINARY_HEAD.pack(b"FRA 2\0", len(rows), 9, 3)
    write_whole(path, [head, np.ascontiguousarray(rows.T, "<f8").tobytes()])
