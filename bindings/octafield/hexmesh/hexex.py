"""Seamless maps as .hexex files (Lyon, Bommes, Kobbelt 2016), with the trailers of MC3D (Brueckler et al. 2022): walls
of the motorcycle complex, then features. Numbers may be rationals, numerator/denominator."""

from __future__ import annotations

import gzip
from pathlib import Path

import numpy as np

from .._core import SeamlessMap, TetMesh
from ..errors import IoError
from ..files.reading import plain_name, read_bytes
from ..files.writing import write_file
from .half_faces import write_half_faces


def is_seamless_map(path: object) -> bool:
    """By its name."""
    return isinstance(path, (str, Path)) and plain_name(path).endswith(".hexex")


def read_seamless_map(path: str | Path) -> SeamlessMap:
    """Vertices, tets with the parameters of their corners, and, where the file goes on, walls and features. Rationals
    are rounded to the nearest float64. Raises IoError naming the file and what is wrong."""
    words = _Words(read_bytes(path).split(), str(path))
    vertices = words.floats(words.count("vertices"), 3, "vertex")
    tets, parameters = words.tets(words.count("tets"))
    walls, features, corners = np.zeros((0, 3), np.int32), np.zeros((0, 2), np.int32), np.zeros(0, np.int32)
    if words.left:
        walls = words.walls(words.count("walls"))
    if words.left:
        points, edges, triangles = (words.count(name) for name in ("feature points", "feature edges", "feature faces"))
        corners = words.ids(points, 1, "feature point").reshape(-1)
        features = words.ids(edges, 2, "feature edge")
        words.ids(triangles, 3, "feature face")  # the boundary, which is known
    words.end()
    for name, ids in (("tet", tets), ("wall", walls), ("feature edge", features), ("feature point", corners)):
        if ids.size and not 0 <= ids.min() <= ids.max() < len(vertices):
            row = int(np.flatnonzero(((ids < 0) | (ids >= len(vertices))).reshape(len(ids), -1).any(axis=1))[0])
            raise IoError(
                f"{path}: {name} {row} names a vertex beyond the {len(vertices)} of the file", "index_out_of_range"
            )
    return SeamlessMap(TetMesh(vertices, tets), parameters, walls, features, corners)


def write_seamless_map(path: str | Path, given: SeamlessMap) -> None:
    """.hexex as read_seamless_map reads it, each float64 with all its digits; packed where the name ends in .gz. Or,
    by the name, .ovm or .ovmb with the half-face property of HexHex, which has no walls. Raises IoError."""
    suffix = Path(path).suffix.lower()
    if suffix in (".ovm", ".ovmb"):
        return write_half_faces(Path(path), given, binary=suffix == ".ovmb")
    rows = [str(len(given.mesh.vertices)), *(_text(row) for row in np.asarray(given.mesh.vertices).tolist())]
    rows.append(str(len(given.mesh.tets)))
    pairs = zip(np.asarray(given.mesh.tets).tolist(), np.asarray(given.parameters).tolist(), strict=True)
    rows += [" ".join(map(str, tet)) + " " + _text(at) for tet, at in pairs]
    walls, features, corners = (np.asarray(ids).tolist() for ids in (given.walls, given.features, given.corners))
    rows += [str(len(walls)), *(" ".join(map(str, wall)) + " 0" for wall in walls)]
    rows += [f"{len(corners)} {len(features)} 0", *map(str, corners), *(f"{a} {b}" for a, b in features)]
    text = ("\n".join(rows) + "\n").encode()
    write_file(Path(path), gzip.compress(text, mtime=0) if str(path).lower().endswith(".gz") else text)


def _text(numbers: list[float]) -> str:
    return " ".join(f"{number:.17g}" for number in numbers)


class _Words:
    """The words of a file, taken one after another."""

    def __init__(self, words: list[bytes], name: str):
        self._words, self._at, self._name = words, 0, name

    @property
    def left(self) -> int:
        return len(self._words) - self._at

    def end(self) -> None:
        if self.left:
            raise IoError(f"{self._name}: {self.left} words follow what the counts announce; is a count too low?")

    def count(self, what: str) -> int:
        (word,) = self._take(1, f"the number of {what}")
        if not word.isdigit():
            raise IoError(f"{self._name}: the number of {what} is {_shown(word)}; it must be a whole number")
        number = int(word)
        if number > self.left:
            raise IoError(f"{self._name}: {number} {what} are announced, and {self.left} words follow: cut short?")
        return number

    def floats(self, rows: int, columns: int, what: str) -> np.ndarray:
        taken = self._take(rows * columns, what)
        numbers = [self._number(word, k // columns, what) for k, word in enumerate(taken)]
        return np.array(numbers, float).reshape(rows, columns)

    def ids(self, rows: int, columns: int, what: str) -> np.ndarray:
        taken = self._take(rows * columns, what)
        return np.array([self._id(word, k // columns, what) for k, word in enumerate(taken)], np.int32).reshape(
            rows, columns
        )

    def tets(self, rows: int) -> tuple[np.ndarray, np.ndarray]:
        taken = self._take(rows * 16, "tet")
        ids = np.empty((rows, 4), np.int32)
        parameters = np.empty((rows, 12))
        for row in range(rows):
            words = taken[16 * row : 16 * row + 16]
            ids[row] = [self._id(word, row, "tet") for word in words[:4]]
            parameters[row] = [self._number(word, row, "tet") for word in words[4:]]
        return ids, parameters

    def walls(self, rows: int) -> np.ndarray:
        """The fourth number, how far from its start a wall was made, is not kept."""
        taken = self._take(4 * rows, "wall")
        ids = [self._id(word, k // 4, "wall") for k, word in enumerate(taken) if k % 4 < 3]
        return np.array(ids, np.int32).reshape(rows, 3)

    def _take(self, count: int, what: str) -> list[bytes]:
        if count > self.left:
            raise IoError(f"{self._name}: ends within {what} data: {count} words are needed, {self.left} are left")
        self._at += count
        return self._words[self._at - count : self._at]

    def _id(self, word: bytes, row: int, what: str) -> int:
        if not word.isdigit() or len(word) > 9:
            raise IoError(f"{self._name}: {what} {row} has the vertex {_shown(word)}; it must be a whole number")
        return int(word)

    def _number(self, word: bytes, row: int, what: str) -> float:
        above, _, below = word.partition(b"/")
        try:
            number = int(above) / int(below) if below else float(above)
        except (ValueError, ZeroDivisionError, OverflowError):
            number = float("nan")
        if not np.isfinite(number):
            raise IoError(f"{self._name}: {what} {row} has the number {_shown(word)}; finite numbers are needed")
        return number


def _shown(word: bytes) -> str:
    return repr(word[:40].decode(errors="replace"))
