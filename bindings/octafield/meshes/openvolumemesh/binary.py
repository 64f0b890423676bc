"""The chunks of OpenVolumeMesh's binary files. Layout: docs/formats.md."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import IoError
from ...files.reading import read_bytes
from .mesh import ENTITIES, OvmMesh

_MAGIC = b"OVMB\n\r\n\xff"
_HEAD = struct.Struct("<8sBBBB4xQQQQ")  # magic, file and header version, dimension, topology; counts
_CHUNK = struct.Struct("<4sBBBBQ")  # type, version, padding, compression, flags, bytes with padding
_SPAN = struct.Struct("<QI")  # first element, number of elements
_TOPOLOGY = struct.Struct("<BBBBQ")  # entity, valence (0: varies), encoding of valences and of ids, offset of ids
_INTEGERS = {1: "<u1", 2: "<u2", 4: "<u4"}
_NUMBERS = {
    "b": ("bits", 1), "u8": ("<u1", 1), "u16": ("<u2", 1), "u32": ("<u4", 1), "u64": ("<u8", 1), "i8": ("<i1", 1),
    "i16": ("<i2", 1),
    "i32": ("<i4", 1), "i64": ("<i8", 1), "f": ("<f4", 1), "d": ("<f8", 1), "Quaternion": ("<f8", 4),
    "SPHCoeffs": ("<f8", 9),
    "3x3d": ("<f8", 9),
} | {f"{n}{kind}": (dtype, n) for n in (2, 3, 4, 9) for kind,
dtype in (("d", "<f8"), ("f", "<f4"), ("i32", "<i4"))}  # fmt: skip
_TYPE_OF = {("i", 1): "i32", ("f", 1): "d", ("f", 2): "2d", ("f", 3): "3d", ("f", 4): "4d", ("f", 9): "9d"}


@dataclass
class _Cursor:
    """Reads forward through a part of the file; IoError with the byte where it ends early."""

    data: bytes
    at: int
    end: int
    path: Path

    def take(self, count: int) -> int:
        """Where the next `count` bytes begin."""
        if count > self.end - self.at:
            raise IoError(f"{self.path}, byte {self.at}: {count} bytes are needed, {self.end - self.at} are left")
        self.at += count
        return self.at - count

    def unpack(self, layout: struct.Struct) -> tuple[Any, ...]:
        return layout.unpack_from(self.data, self.take(layout.size))

    def array(self, dtype: str, count: int) -> np.ndarray:
        start = self.take(count * np.dtype(dtype).itemsize)
        return np.frombuffer(self.data, dtype, count, start)

    def text(self) -> str:
        (length,) = self.unpack(struct.Struct("<I"))
        start = self.take(length)
        return self.data[start : start + length].decode("utf-8", "replace")


def read_binary(path: Path) -> OvmMesh:
    data = read_bytes(path)
    cursor = _Cursor(data, 0, len(data), path)
    magic, _, version, dimension, _, *counts = cursor.unpack(_HEAD)
    if magic != _MAGIC:
        raise IoError(f"{path}, byte 0: not an OpenVolumeMesh binary file")
    if version != 1 or dimension != 3:
        raise IoError(f"{path}, byte 9: header version {version} in dimension {dimension}; 1 and 3 are read")
    for what, count in zip(ENTITIES, counts, strict=False):
        if count > len(data):  # every element takes a byte or more
            raise IoError(f"{path}, byte 16: {count} elements of kind {what} in {len(data)} bytes")
    edges, faces, cells = (np.full((n, k), -1) for n, k in zip(counts[1:], (2, 3, 4), strict=True))
    mesh = OvmMesh(np.full((counts[0], 3), np.nan), edges, faces, cells)
    directory: list[tuple[str, str, str]] = []
    while True:
        start = cursor.at
        kind, _, padding, compression, flags, size = cursor.unpack(_CHUNK)
        if kind == b"EOF ":
            break
        end = cursor.take(size) + size - padding
        if compression or end < start + _CHUNK.size:
            raise IoError(f"{path}, byte {start}: a packed or damaged chunk, which is not read")
        chunk = _Cursor(data, start + _CHUNK.size, end, path)
        if kind == b"VERT":
            _take_vertices(chunk, mesh)
        elif kind == b"TOPO":
            _take_topology(chunk, mesh)
        elif kind == b"DIRP":
            directory = list(_directory(chunk))
        elif kind == b"PROP":
            _take_property(chunk, mesh, directory)
        elif flags & 1:
            raise IoError(f"{path}, byte {start}: a chunk of unknown kind {kind!r} that readers must know")
    if not np.isfinite(mesh.vertices).all():
        bad = int(np.argmin(np.isfinite(mesh.vertices).all(axis=1)))
        raise IoError(f"{path}: vertex {bad} (from 0) has no place or one that is not finite")
    return mesh


def _span(chunk: _Cursor, limit: int) -> slice:
    start = chunk.at
    first, count = chunk.unpack(_SPAN)
    if first + count > limit:
        raise IoError(f"{chunk.path}, byte {start}: elements {first} .. {first + count - 1} of {limit}")
    return slice(first, first + count)


def _take_vertices(chunk: _Cursor, mesh: OvmMesh) -> None:
    span = _span(chunk, len(mesh.vertices))
    encoding, *_ = chunk.unpack(struct.Struct("<B3B"))
    if encoding not in (1, 2):
        raise IoError(f"{chunk.path}, byte {chunk.at - 4}: unknown encoding {encoding} of vertices")
    numbers = chunk.array("<f4" if encoding == 1 else "<f8", 3 * (span.stop - span.start))
    mesh.vertices[span] = numbers.reshape(-1, 3)


def _take_topology(chunk: _Cursor, mesh: OvmMesh) -> None:
    start = chunk.at
    first, count = chunk.unpack(_SPAN)
    entity, valence, of_valence, of_ids, offset = chunk.unpack(_TOPOLOGY)
    if entity not in (1, 2, 3) or of_ids not in _INTEGERS:
        raise IoError(f"{chunk.path}, byte {start + _SPAN.size}: unknown kind of elements or of ids")
    target = (mesh.edges, mesh.faces, mesh.cells)[entity - 1]
    width = target.shape[1]
    if first + count > len(target):
        raise IoError(f"{chunk.path}, byte {start}: elements {first} .. {first + count - 1} of {len(target)}")
    if valence == 0 and of_valence in _INTEGERS:
        valences = np.unique(chunk.array(_INTEGERS[of_valence], count))
        valence = int(valences[0]) if len(valences) == 1 else 0
    if valence != width:
        raise IoError(
            f"{chunk.path}, byte {start + _SPAN.size + 1}: elements of {ENTITIES[entity]} with other than {width}"
            " sides; tets are needed"
        )
    ids = chunk.array(_INTEGERS[of_ids], width * count).astype(np.int64)
    target[first : first + count] = ids.reshape(-1, width) + min(offset, 1 << 40)


def _directory(chunk: _Cursor) -> Iterator[tuple[str, str, str]]:
    while chunk.at < chunk.end:
        (entity,) = chunk.unpack(struct.Struct("<B"))
        if entity >= len(ENTITIES):
            raise IoError(f"{chunk.path}, byte {chunk.at - 1}: a property of an unknown kind of elements")
        name, kind, _default = chunk.text(), chunk.text(), chunk.text()
        yield ENTITIES[entity], name, kind


def _take_property(chunk: _Cursor, mesh: OvmMesh, directory: list[tuple[str, str, str]]) -> None:
    start = chunk.at
    first, count = chunk.unpack(_SPAN)
    (number,) = chunk.unpack(struct.Struct("<I"))
    if number >= len(directory):
        raise IoError(f"{chunk.path}, byte {start}: values of property {number}; {len(directory)} are listed")
    entity, name, kind = directory[number]
    if kind not in _NUMBERS:
        mesh.skipped.append(name)
        return
    if first + count > mesh.count(entity):
        raise IoError(f"{chunk.path}, byte {start}: elements {first} .. {first + count - 1} of {mesh.count(entity)}")
    dtype, width = _NUMBERS[kind]
    if dtype == "bits":
        values = np.unpackbits(chunk.array("<u1", (count + 7) // 8), bitorder="little", count=count)
    else:
        values = chunk.array(dtype, width * count)
    if (entity, name) not in mesh.properties:
        shape = (mesh.count(entity),) if width == 1 else (mesh.count(entity), width)
        mesh.properties[entity, name] = np.zeros(shape, values.dtype)
        mesh.kinds[entity, name] = kind
    mesh.properties[entity, name][first : first + count] = values if width == 1 else values.reshape(-1, width)


def binary_pieces(mesh: OvmMesh) -> Iterator[bytes]:
    """Header version 1, topology type tetrahedral, doubles, ids of 32 bits at most."""
    counts = [mesh.count(entity) for entity in ENTITIES[:4]]
    yield _HEAD.pack(_MAGIC, 1, 1, 3, 1, *counts)
    kinds = {key: mesh.kinds.get(key) or _TYPE_OF[_signature(values)] for key, values in mesh.properties.items()}
    if kinds:
        yield from _chunk(b"DIRP", b"".join(_entry(*key, kind) for key, kind in kinds.items()))
    yield from _chunk(
        b"VERT", _SPAN.pack(0, counts[0]), b"\2\0\0\0", np.ascontiguousarray(mesh.vertices, "<f8").tobytes()
    )
    for code, ids, limit in (
        (1, mesh.edges, counts[0]),
        (2, mesh.faces, 2 * counts[1]),
        (3, mesh.cells, 2 * counts[2]),
    ):
        size = 1 if limit < 1 << 8 else 2 if limit < 1 << 16 else 4
        head = _SPAN.pack(0, len(ids)) + _TOPOLOGY.pack(code, ids.shape[1], 0, size, 0)
        yield from _chunk(b"TOPO", head, np.ascontiguousarray(ids, _INTEGERS[size]).tobytes())
    for number, (key, values) in enumerate(mesh.properties.items()):
        dtype = _NUMBERS[kinds[key]][0]
        head = _SPAN.pack(0, mesh.count(key[0])) + struct.pack("<I", number)
        yield from _chunk(b"PROP", head, np.ascontiguousarray(values, dtype).tobytes())
    yield from _chunk(b"EOF ")


def _signature(values: np.ndarray) -> tuple[str, int]:
    values = np.asarray(values)
    return values.dtype.kind, 1 if values.ndim == 1 else values.shape[1]


def _entry(entity: str, name: str, kind: str) -> bytes:
    dtype, width = _NUMBERS[kind]
    default = bytes(width * np.dtype(dtype).itemsize)
    parts = [name.encode(), kind.encode(), default]
    return bytes([ENTITIES.index(entity)]) + b"".join(struct.pack("<I", len(part)) + part for part in parts)


def _chunk(kind: bytes, *parts: bytes) -> Iterator[bytes]:
    """Filled up to a multiple of 8 bytes; readers must know it."""
    size = sum(map(len, parts))
    padding = -size % 8
    yield _CHUNK.pack(kind, 0, padding, 0, 1, size + padding)
    yield from parts
    yield bytes(padding)
