"""Reader of binary Medit files (.meshb), versions 1 to 4 in either byte order, errors with their byte.

meshio reads these too, but stops at keywords it does not know and takes files that end early as they are. Layout:
libMeshb, sources/libmeshb7.c.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import DTypeLike

from ..errors import IoError
from .text_meshes import TextMesh

_DIMENSION, _VERTICES, _RIDGES, _END = 3, 4, 14, 54
_CELLS = {5: ("line", 2), 6: ("triangle", 3), 7: ("quad", 4), 8: ("tetra", 4), 9: ("wedge", 6), 10: ("hexahedron", 8),
          49: ("pyramid", 5),
          24: ("triangle6", 6), 25: ("line3", 3), 27: ("quad9", 9), 30: ("tetra10", 10),
          33: ("hexahedron27", 27)}  # fmt: skip


def read_binary_medit(data: bytes, name: str) -> TextMesh:
    order = {b"\1\0\0\0": "<", b"\0\0\0\1": ">"}.get(data[:4], "")
    version = int(np.frombuffer(data, f"{order}i4", 1, 4)[0]) if order and len(data) >= 8 else 0
    if version not in (1, 2, 3, 4):
        raise IoError(f"{name}, byte 0: a binary Medit file begins with 1 and a version of 1 to 4")
    word, real, place = (
        order + kind
        for kind in ("i8" if version == 4 else "i4", "f4" if version == 1 else "f8", "i8" if version >= 3 else "i4")
    )
    points, lines = None, 0
    mesh = TextMesh(np.empty((0, 3)))
    for keyword, start, end in _keywords(data, name, f"{order}i4", place):
        if keyword == _DIMENSION:
            dimension = int(_numbers(data, name, start, end, f"{order}i4", 1)[0])
            if dimension != 3:
                raise IoError(f"{name}, byte {start}: points of dimension {dimension}; 3 is needed")
        if keyword not in (_VERTICES, _RIDGES, *_CELLS):
            continue
        count = int(_numbers(data, name, start, end, word, 1)[0])
        body = start + np.dtype(word).itemsize
        if count < 0:
            raise IoError(f"{name}, byte {start}: the number of elements is {count}")
        if keyword == _VERTICES:
            points = _numbers(data, name, body, end, np.dtype([("at", real, 3), ("reference", word)]), count)[
                "at"
            ].astype(float)
            mesh.points = points
        elif keyword == _RIDGES:
            mesh.ridges = _numbers(data, name, body, end, word, count).astype(np.int64) - 1
            ridges_at = body
        else:
            kind, corners = _CELLS[keyword]
            rows = _numbers(data, name, body, end, np.dtype((word, corners + 1)), count).astype(np.int64)
            if points is not None:
                _require_ids(
                    rows[:, :corners], len(points), f"{name}, byte {{}}", body, rows.shape[1] * np.dtype(word).itemsize
                )
            mesh.cells.append((kind, rows[:, :corners] - 1))
            mesh.references.append(rows[:, corners])
            lines += count if kind == "line" else 0
    if points is None:
        raise IoError(f"{name}, byte {len(data)}: ends without vertices")
    if mesh.ridges is not None:
        _require_ids(mesh.ridges[:, None] + 1, lines, f"{name}, byte {{}}", ridges_at, np.dtype(word).itemsize)
    return mesh


def _keywords(data: bytes, name: str, word: str, place: str) -> Iterator[tuple[int, int, int]]:
    """Code, first byte after the head and last byte of each part of the file; every part tells where the next
    begins."""
    at, head = 8, 4 + np.dtype(place).itemsize
    while True:
        if at + 4 > len(data):
            raise IoError(
                f"{name}, byte {at}: the file ends without the keyword End: it is cut; write or download it again"
            )
        keyword = int(np.frombuffer(data, word, 1, at)[0])
        if keyword == _END:
            return
        if at + head > len(data):
            raise IoError(
                f"{name}, byte {at}: the file ends within keyword {keyword}: it is cut; write or download it again"
            )
        following = int(np.frombuffer(data, place, 1, at + 4)[0])
        if not at + head <= following <= len(data):
            raise IoError(
                f"{name}, byte {at + 4}: keyword {keyword} names byte {following} as its end; the file has {len(data)}:"
                " it is cut or damaged"
            )
        yield keyword, at + head, following
        at = following


def _numbers(data: bytes, name: str, at: int, end: int, kind: DTypeLike, count: int) -> np.ndarray:
    size = np.dtype(kind).itemsize * count
    if size > end - at:
        raise IoError(f"{name}, byte {at}: {count} elements take {size} bytes, {end - at} are left of their keyword")
    return np.frombuffer(data, kind, count, at)


def _require_ids(ids: np.ndarray, limit: int, place: str, start: int, size: int) -> None:
    bad = np.flatnonzero(((ids < 1) | (ids > limit)).any(axis=1))
    if len(bad):
        raise IoError(
            f"{place.format(start + int(bad[0]) * size)}: row {bad[0] + 1} names a number outside 1 .. {limit}"
        )
