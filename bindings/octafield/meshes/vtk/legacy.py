"""Legacy .vtk files, text and binary, versions 1 to 5.1: unstructured grids with their arrays, errors with their line
or byte.

meshio reads these too, but takes tables that end early as they are, knows no NORMALS, and does not say where.
"""

import codecs
import re
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import unquote

import numpy as np

from ...errors import InvalidInput, IoError
from ...files.reading import numbers_of
from ..cell_mesh import Block, CellMesh

_TYPES = {
    "bit": "u1", "unsigned_char": "u1", "char": "i1", "unsigned_short": "u2", "short": "i2", "unsigned_int": "u4",
    "int": "i4", "unsigned_long": "u8",
    "long": "i8", "vtkidtype": "i4", "vtktypeint64": "i8", "vtktypeuint64": "u8", "vtktypeint32": "i4", "float": "f4",
    "double": "f8",
}  # fmt: skip
_SIZES = {1: 1, 3: 2, 5: 3, 8: 4, 9: 4, 10: 4, 11: 8, 12: 8, 13: 6, 14: 5}  # vertices of the linear cells
_COMPONENTS = {"VECTORS": 3, "NORMALS": 3, "TENSORS": 9, "TENSORS6": 6, "GLOBAL_IDS": 1, "PEDIGREE_IDS": 1}
_NEXT_WORD = re.compile(rb"(?i)\n[ \t]*(?!nan\b|inf)[a-z]")


@dataclass
class _File:
    """Reads forward. at: the byte where it is."""

    data: bytes
    name: str
    at: int = 0
    text: bool = True
    arrays: dict[str, dict[str, np.ndarray]] = field(
        default_factory=lambda: {"POINT_DATA": {}, "CELL_DATA": {}, "": {}}
    )

    def place(self, at: int | None = None) -> str:
        at = self.at if at is None else at
        return f"{self.name}, line {self.data.count(10, 0, at) + 1}" if self.text else f"{self.name}, byte {at}"

    def words(self) -> list[str]:
        """Of the next line that has some; none at the end."""
        while self.at < len(self.data):
            end = self.data.find(b"\n", self.at)
            start, self.at = self.at, len(self.data) if end < 0 else end + 1
            words = self.data[start : self.at].decode("utf-8", "replace").split()
            if words:
                self.line_at = start
                return words
        return []

    def whole(self, words: list[str], k: int, what: str) -> int:
        if len(words) <= k or not re.fullmatch(r"\d{1,15}", words[k]):
            raise IoError(f"{self.place(self.line_at)}: {words[0]} is not followed by the number of {what}")
        return int(words[k])

    def table(self, what: str, count: int, width: int, kind: str) -> np.ndarray:
        """(count, width) numbers, from here on."""
        kind = kind.lower()
        if kind not in _TYPES:
            raise IoError(f"{self.place(self.line_at)}: {what} of type {kind[:40]!r}, which is not read")
        numbers = self._text(what, count * width) if self.text else self._binary(what, count * width, kind)
        return numbers.reshape(count, width)

    def _text(self, what: str, count: int) -> np.ndarray:
        found = _NEXT_WORD.search(self.data, max(self.at - 1, 0))
        start, self.at = self.at, len(self.data) if found is None else found.start() + 1
        first = self.data.count(10, 0, start) + 1
        numbers = numbers_of(self.data[start : self.at].decode("utf-8", "replace"), self.name, first)
        if len(numbers) != count:
            raise IoError(
                f"{self.place(start)}: {what} has {len(numbers)} numbers up to line"
                f" {max(first, self.data.count(10, 0, self.at))}, not {count}"
            )
        return numbers

    def _binary(self, what: str, count: int, kind: str) -> np.ndarray:
        if kind == "bit":
            taken = (count + 7) // 8
            self._require(what, taken)
            numbers = np.unpackbits(np.frombuffer(self.data, np.uint8, taken, self.at), count=count)
        else:
            dtype = np.dtype(">" + _TYPES[kind])
            taken = count * dtype.itemsize
            self._require(what, taken)
            numbers = np.frombuffer(self.data, dtype, count, self.at).astype(dtype.newbyteorder("="))
        self.at += taken
        return numbers

    def _require(self, what: str, count: int) -> None:
        if count > len(self.data) - self.at:
            raise IoError(f"{self.place()}: {what} needs {count} bytes, {len(self.data) - self.at} are left")


def read_legacy_vtk(data: bytes, name: str) -> CellMesh:
    data = data.removeprefix(codecs.BOM_UTF8)
    file = _File(data, name)
    if not data.startswith(b"# vtk DataFile Version"):
        raise IoError(f"{name}, line 1: a legacy VTK file begins with '# vtk DataFile Version'")
    file.words()
    end = data.find(b"\n", file.at)  # the title, which may be empty
    file.at = len(data) if end < 0 else end + 1
    mode = file.words()
    if mode[:1] not in (["ASCII"], ["BINARY"]):
        raise IoError(f"{name}, line 3: ASCII or BINARY is needed, not {' '.join(mode)[:40]!r}")
    file.text = mode[0] == "ASCII"
    parts: dict[str, Any] = {}
    number, site = 0, ""
    while words := file.words():
        words[0] = words[0].upper()
        if words[0] == "DATASET":
            if [w.upper() for w in words[1:]] != ["UNSTRUCTURED_GRID"]:
                raise InvalidInput(
                    f"{file.place(file.line_at)}: {' '.join(words)[:60]}; UNSTRUCTURED_GRID is needed: save surfaces as"
                    " .vtp or .ply",
                    "unsupported_cells",
                )
        elif words[0] == "METADATA":
            _skip_metadata(file)
        elif words[0] in ("POINT_DATA", "CELL_DATA"):
            number, site = file.whole(words, 1, "rows"), words[0]
            have = len(parts.get("POINTS" if site == "POINT_DATA" else "CELL_TYPES", ()))
            if number != have:
                raise IoError(f"{file.place(file.line_at)}: {site} {number}; the grid has {have}")
        elif words[0] in ("POINTS", "CELLS", "CELL_TYPES"):
            parts[words[0]] = _geometry(file, words)
        else:
            _take_array(file, words, number, file.arrays[site])
    for section in ("POINTS", "CELLS", "CELL_TYPES"):
        if section not in parts:
            raise IoError(f"{file.place(len(data))}: ends without the section {section}")
    return _mesh(file, parts)


def _skip_metadata(file: _File) -> None:
    """Up to an empty line."""
    end = re.compile(rb"\n[ \t\r]*\n").search(file.data, max(file.at - 1, 0))
    file.at = len(file.data) if end is None else end.end()


def _geometry(file: _File, words: list[str]) -> Any:
    at = file.line_at
    if words[0] == "POINTS":
        return file.table(
            "POINTS", file.whole(words, 1, "points"), 3, words[2] if len(words) > 2 else "none given"
        ).astype(float)
    if words[0] == "CELL_TYPES":
        types = file.table("CELL_TYPES", file.whole(words, 1, "cells"), 1, "int").ravel()
        if not ((types >= 0) & (types < 256) & (types == np.floor(types))).all():
            raise IoError(f"{file.place(at)}: CELL_TYPES holds a number that is no type of cell")
        return types.astype(np.int64)
    count, size = file.whole(words, 1, "cells"), file.whole(words, 2, "numbers")
    before = file.at
    inner = file.words()
    if [w.upper() for w in inner[:1]] != ["OFFSETS"]:
        file.at = before
        return at, count, file.table("CELLS", size, 1, "int").ravel(), None
    offsets = file.table("OFFSETS", count, 1, (inner + [""])[1]).ravel()
    inner = file.words()
    if [w.upper() for w in inner[:1]] != ["CONNECTIVITY"]:
        raise IoError(f"{file.place()}: OFFSETS are not followed by CONNECTIVITY")
    return at, max(count - 1, 0), file.table("CONNECTIVITY", size, 1, (inner + [""])[1]).ravel(), offsets


def _take_array(file: _File, words: list[str], count: int, arrays: dict[str, np.ndarray]) -> None:
    kind, name = words[0], unquote(words[1]) if len(words) > 1 else ""
    type_ = words[2] if len(words) > 2 else ""
    if kind == "SCALARS":
        width = file.whole(words, 3, "components") if len(words) > 3 else 1
        before = file.at
        if file.words()[:1] != ["LOOKUP_TABLE"]:
            file.at = before
        arrays[name] = file.table(name, count, width, type_)
    elif kind in _COMPONENTS:
        arrays[name] = file.table(name, count, _COMPONENTS[kind], type_)
    elif kind == "TEXTURE_COORDINATES":
        file.table(name, count, file.whole(words, 2, "components"), (words + ["", ""])[3])
    elif kind == "COLOR_SCALARS":
        file.table(name, count, file.whole(words, 2, "components"), "float" if file.text else "unsigned_char")
    elif kind == "LOOKUP_TABLE":
        file.table(name, file.whole(words, 2, "colours"), 4, "float" if file.text else "unsigned_char")
    elif kind == "FIELD":
        for _ in range(file.whole(words, 2, "arrays")):
            head = file.words()
            if head[:1] == ["METADATA"]:
                _skip_metadata(file)
                head = file.words()
            if len(head) < 4:
                raise IoError(f"{file.place()}: an array of FIELD begins with name, components, rows and type")
            rows, width = file.whole(head, 2, "rows"), file.whole(head, 1, "components")
            if head[3] == "string":
                _skip_strings(file, rows * width)
                continue
            table = file.table(unquote(head[0]), rows, width, head[3])
            if not count or len(table) == count:
                arrays[unquote(head[0])] = table
    else:
        raise IoError(f"{file.place(file.line_at)}: unknown section {kind[:40]!r}")


def _skip_strings(file: _File, count: int) -> None:
    """A line each in text; in binary files the length goes before, in 1, 2, 4 or 8 bytes by the first two bits."""
    for _ in range(count):
        if file.at >= len(file.data):
            raise IoError(f"{file.place()}: ends within {count} strings")
        if file.text:
            file.words()
            continue
        bits = file.data[file.at] >> 6
        size = 1 << (3 - bits)
        length = int.from_bytes(file.data[file.at : file.at + size], "big") & ((1 << (8 * size - 2)) - 1)
        file.at += size + length


def _mesh(file: _File, parts: dict[str, Any]) -> CellMesh:
    at, count, numbers, offsets = parts["CELLS"]
    types = parts["CELL_TYPES"]
    place = file.place(at)
    if len(types) != count:
        raise IoError(f"{place}: {count} cells; CELL_TYPES has {len(types)}")
    numbers = whole_numbers(numbers, f"{place}: CELLS")
    starts, sizes = _extents(numbers, types, place) if offsets is None else from_offsets(offsets, len(numbers), place)
    return mesh_of_cells(
        parts["POINTS"], numbers, starts, sizes, types, file.arrays["POINT_DATA"], file.arrays["CELL_DATA"], place
    )


def whole_numbers(numbers: np.ndarray, place: str) -> np.ndarray:
    if not ((np.abs(numbers) < 2**53) & (numbers == np.floor(numbers))).all():
        raise IoError(f"{place} hold a number that is no id")
    return numbers.astype(np.int64)


Arrays = dict[str, np.ndarray]


def mesh_of_cells(
    points: np.ndarray,
    numbers: np.ndarray,
    starts: np.ndarray,
    sizes: np.ndarray,
    types: np.ndarray,
    of_points: Arrays,
    of_cells: Arrays,
    place: str,
) -> CellMesh:
    """With a block per run of cells of one kind. numbers: ids of all cells. starts, sizes: where each cell's are.
    Arrays: (n, components)."""
    known = np.array([_SIZES.get(kind, -1) for kind in range(256)])[np.clip(types, 0, 255)]
    wrong = np.flatnonzero((known >= 0) & (sizes != known))
    if len(wrong):
        raise IoError(
            f"{place}: cell {wrong[0]} (from 0) of type {types[wrong[0]]} has {sizes[wrong[0]]} vertices, not"
            f" {known[wrong[0]]}"
        )
    breaks = np.flatnonzero((np.diff(types) != 0) | (np.diff(sizes) != 0)) + 1
    chunks = [c for c in np.split(np.arange(len(types)), breaks) if len(c)]
    blocks = [Block(_kind(types[c[0]]), numbers[starts[c][:, None] + np.arange(sizes[c[0]])]) for c in chunks]
    flat_points, flat_cells = (
        {key: v[:, 0] if v.shape[1] == 1 else v for key, v in arrays.items()} for arrays in (of_points, of_cells)
    )
    split = {key: [values[c] for c in chunks] for key, values in flat_cells.items()}
    return CellMesh(points, blocks, flat_points, split if chunks else {})


def _kind(vtk_type: int) -> str:
    from meshio._vtk_common import vtk_to_meshio_type

    return "voxel" if vtk_type == 11 else str(vtk_to_meshio_type.get(int(vtk_type), f"VTK type {vtk_type}"))


def _extents(numbers: np.ndarray, types: np.ndarray, place: str) -> tuple[np.ndarray, np.ndarray]:
    """Where each cell's ids begin and how many there are, of rows that begin with their number."""
    starts, at, values = np.empty(len(types), np.int64), 0, numbers.tolist()
    for cell in range(len(types)):
        if at >= len(values) or values[at] < 0:
            raise IoError(f"{place}: CELLS ends within cell {cell} (from 0) of {len(types)}")
        starts[cell] = at + 1
        at += 1 + values[at]
    if at != len(values):
        raise IoError(f"{place}: CELLS has {len(values)} numbers; its {len(types)} cells take {at}")
    return starts, numbers[starts - 1]


def from_offsets(offsets: np.ndarray, count: int, place: str) -> tuple[np.ndarray, np.ndarray]:
    offsets = whole_numbers(offsets, f"{place}: OFFSETS")
    if (np.diff(offsets) < 0).any() or (len(offsets) and (offsets[0] != 0 or offsets[-1] != count)):
        raise IoError(f"{place}: OFFSETS do not rise from 0 to {count}, the size of CONNECTIVITY")
    return offsets[:-1], np.diff(offsets)
