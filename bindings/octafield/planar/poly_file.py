"""Outlines from .poly files of Triangle (Shewchuk 1996), with the .node file beside where the points are there."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .. import _core
from .._core import PlanarOutline
from ..errors import IoError
from ..files.reading import read_bytes


class _Words:
    """The numbers of a file in their order; text from # on is a comment."""

    def __init__(self, path: Path):
        self.path, self.at = path, 0
        lines = read_bytes(path).decode("utf-8", "replace").splitlines()
        self.words = [(word, number) for number, line in enumerate(lines, 1) for word in line.partition("#")[0].split()]

    def number(self, what: str) -> float:
        if self.at == len(self.words):
            raise IoError(f"{self.path}: ends where {what} is expected; save it again", "unreadable")
        word, line = self.words[self.at]
        self.at += 1
        try:
            return float(word)
        except ValueError:
            raise IoError(f"{self.path}, line {line}: {word!r} is not {what}", "unreadable") from None

    def count(self, what: str) -> int:
        value = self.number(what)
        if value != int(value if np.isfinite(value) else 0) or not 0 <= value <= len(self.words):
            raise IoError(
                f"{self.path}, line {self.words[self.at - 1][1]}: {what} is {value:g}, which the file cannot hold",
                "unreadable",
            )
        return int(value)

    def rows(self, count: int, columns: int, what: str) -> np.ndarray:
        values = [self.number(what) for _ in range(count * columns)]
        return np.array(values, float).reshape(count, columns)


def read_poly(path: str | Path) -> PlanarOutline:
    """Segments between the outside, or a hole, and the inside are loops, others lines. Attributes, markers and regional
    attributes are left out. Raises IoError (kind unreadable), and as octafield.surface.outline_of_graph."""
    path = Path(path)
    words = _Words(path)
    points = _points(words)
    if not len(points):
        points = _points(_Words(path.with_suffix(".node")))
    segments = words.count("the number of segments")
    markers = words.count("the number of markers")
    rows = words.rows(segments, 3 + markers, "a segment")[:, 1:3]
    holes = words.rows(words.count("the number of holes"), 3, "a hole")[:, 1:]
    numbers = {int(number): i for i, number in enumerate(points[:, 0])}
    try:
        ids = [[numbers[int(end)] for end in row] for row in rows]
    except (KeyError, ValueError, OverflowError) as error:
        raise IoError(f"{path}: a segment names the point {error}, which is not there", "unreadable") from error
    return _core.outline_of_graph(points[:, 1:], np.array(ids, np.int32).reshape(-1, 2), holes)


def _points(words: _Words) -> np.ndarray:
    """(n, 3) number and place."""
    count, dimension = words.count("the number of points"), words.count("the dimension")
    attributes, markers = words.count("the number of attributes"), words.count("the number of markers")
    if dimension != 2:
        raise IoError(f"{words.path}: has {dimension} dimensions; a .poly file of Triangle has 2", "unreadable")
    rows = words.rows(count, 3 + attributes + markers, "a point")[:, :3]
    if not np.isfinite(rows[:, 0]).all():
        raise IoError(f"{words.path}: numbers of points are not finite", "unreadable")
    return rows
