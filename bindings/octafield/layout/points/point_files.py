"""Singular points and corners as users write them: JSON, CSV, rows of arrays, lists of dictionaries."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import InvalidInput, IoError
from ...files.reading import plain_name, read_text

_PLACES, _NUMBERS = ("position", "vertex"), ("index", "index_times_four", "valence", "quads")
_LISTS = {"points": ("points", "singular_points", "singularities"), "corners": ("corners",)}
_LARGEST = 1000  # index times four
_POINTS_REMEDY = 'a position or vertex and an index or valence each, as {"position": [1, 0, 0], "index": 0.25}'
_CORNERS_REMEDY = 'a vertex or position and a number of quads each, as {"vertex": 12, "quads": 1}'


@dataclass(frozen=True)
class PointRow:
    """One point as it was given. name: for messages. position: (3,), or vertex: of the input. index_times_four, or what
    it follows from: valence inside, quads on the boundary."""

    name: str
    position: tuple[float, float, float] | None
    vertex: int | None
    index_times_four: int | None
    valence: int | None = None
    quads: int | None = None


def point_rows(given: Any) -> tuple[list[PointRow], list[PointRow]]:
    """Singular points, and the corners given with them. Raises InvalidInput, IoError."""
    if isinstance(given, (str, Path)):
        content = _read(Path(given))
        points = _list_in(content, "points", str(given), _POINTS_REMEDY)
        corners = content.get("corners", []) if isinstance(content, dict) else []
        return _rows(points, "point", str(given)), _rows(corners, "corner", str(given))
    if isinstance(given, Mapping):
        points = _list_in(dict(given), "points", "singularities", _POINTS_REMEDY)
        return _rows(points, "point"), _rows(given.get("corners", []), "corner")
    return _rows(_listed(given, 4, "singularities", _of_point_row, "x y z index"), "point"), []


def corner_rows(given: Any) -> list[PointRow]:
    """As point_rows. An array has rows of vertex and quads."""
    if isinstance(given, (str, Path)):
        content = _list_in(_read(Path(given)), "corners", str(given), _CORNERS_REMEDY)
        return _rows(content, "corner", str(given))
    if isinstance(given, Mapping):
        return _rows(_list_in(dict(given), "corners", "corners", _CORNERS_REMEDY), "corner")
    return _rows(
        _listed(given, 2, "corners", lambda row: {"vertex": row[0], "quads": row[1]}, "vertex quads"), "corner"
    )


def _of_point_row(row: np.ndarray) -> dict[str, Any]:
    return {"position": row[:3].tolist(), "index": row[3]}


def _listed(given: Any, columns: int, name: str, as_row: Any, words: str) -> list[Any]:
    """Dictionaries as they are, an array as dictionaries."""
    if (
        isinstance(given, Sequence)
        and not isinstance(given, (str, bytes))
        and any(isinstance(g, Mapping) for g in given)
    ):
        return list(given)
    try:
        array = np.asarray(given)
        if array.dtype.kind not in "fiu":
            raise ValueError(f"dtype {array.dtype}")
    except (TypeError, ValueError) as error:
        raise InvalidInput(
            f"{name}: neither dictionaries nor an array of numbers ({error}); give rows {words}", "wrong_type"
        ) from error
    if not array.size:
        return []
    if array.ndim != 2 or array.shape[1] != columns:
        raise InvalidInput(f"{name}: an array of shape {array.shape}; give rows {words}", "wrong_shape")
    return [as_row(row) for row in array.astype(float)]


def _read(path: Path) -> Any:
    suffix = Path(plain_name(path)).suffix
    text = read_text(path)
    if suffix == ".json":
        try:
            return json.loads(text)
        except (ValueError, RecursionError) as error:
            raise IoError(f"{path}: no whole JSON ({error}); correct it", "bad_points") from error
    if suffix == ".csv":
        return _csv(text, str(path))
    raise IoError(
        f"{path}: unknown kind of file for singular points and corners; known are .json and .csv", "bad_points"
    )


def _csv(text: str, name: str) -> list[dict[str, Any]]:
    """The first line names the columns: x, y, z (0 where it is left out) or vertex; then one number."""
    lines = csv.reader(io.StringIO(text), skipinitialspace=True)
    head = [word.strip().lower() for word in next(lines, [])]
    known = {"x", "y", "z", "vertex", *_NUMBERS, "boundary"}
    if not head or not set(head) <= known or len(set(head)) < len(head):
        raise IoError(
            f"{name}: the first line names the columns, as x,y,z,index or vertex,valence; it reads"
            f" {','.join(head)[:80]!r}",
            "bad_points",
        )
    rows = []
    for words in lines:
        if not any(word.strip() for word in words):
            continue
        if len(words) != len(head):
            raise IoError(
                f"{name}: line {lines.line_num} has {len(words)} columns, not {len(head)} as the first; correct it",
                "bad_points",
            )
        found: dict[str, Any] = {k: word.strip() for k, word in zip(head, words, strict=True) if word.strip()}
        if {"x", "y"} & set(found):
            found["position"] = [found.pop(axis, "0" if axis == "z" else "") for axis in "xyz"]
        rows.append({**found, "line": lines.line_num})
    return rows


def _list_in(content: Any, what: str, name: str, remedy: str) -> Any:
    if not isinstance(content, dict):
        return content
    if what == "points" and isinstance(content.get("imposed"), dict):
        content = content["imposed"]  # of a record: as they were given, not as they were found
    for key in _LISTS[what]:
        if key in content:
            return content[key]
    raise InvalidInput(f"{name}: holds no {what}; give a list of {what}: {remedy}", "bad_points")


def _rows(content: Any, what: str, file: str = "") -> list[PointRow]:
    remedy = _POINTS_REMEDY if what == "point" else _CORNERS_REMEDY
    if not isinstance(content, list):
        raise InvalidInput(f"{file or what + 's'}: holds no list of {what}s; give {remedy}", "bad_points")
    return [_row(entry, place, what, file) for place, entry in enumerate(content)]


def _row(entry: Any, place: int, what: str, file: str) -> PointRow:
    name = f"{file}: {what} {place}" if file else f"{what} {place}"

    def refuse(why: str) -> InvalidInput:
        remedy = _POINTS_REMEDY if what == "point" else _CORNERS_REMEDY
        return InvalidInput(f"{name} (from 0): {why}; give {remedy}", "bad_points", [place])

    if not isinstance(entry, Mapping):
        raise refuse("is no object with names")
    if "line" in entry:
        name += f", line {entry['line']}"
    places = [key for key in _PLACES if entry.get(key) is not None]
    numbers = [key for key in _NUMBERS if entry.get(key) is not None]
    if len(places) != 1 and "position" not in places:  # a record names the vertex as well
        raise refuse("has neither position nor vertex")
    if not numbers:
        raise refuse(f"has no {'index or valence' if what == 'point' else 'number of quads'}")
    position = _position(entry["position"], refuse) if "position" in places else None
    vertex = None if position is not None else _whole(entry["vertex"], "vertex", refuse)
    values = {key: entry[key] for key in numbers}
    index = _quarters(values, refuse)
    valence, quads = (_whole(values[key], key, refuse) if key in values else None for key in ("valence", "quads"))
    if index is not None:
        valence = quads = None
    return PointRow(name, position, vertex, index, valence, quads)


def _position(given: Any, refuse: Any) -> tuple[float, float, float]:
    numbers = list(given) if isinstance(given, (list, tuple, np.ndarray)) else []
    if len(numbers) == 2:
        numbers.append(0.0)
    try:
        if len(numbers) != 3 or any(isinstance(n, bool) for n in numbers):
            raise ValueError
        x, y, z = map(float, numbers)
    except (TypeError, ValueError):
        raise refuse(f"position {given!r} is no list of 3 numbers") from None
    if not all(map(math.isfinite, (x, y, z))):
        raise refuse(f"position {[x, y, z]} is not finite")
    return x, y, z


def _whole(given: Any, name: str, refuse: Any) -> int:
    try:
        number = float(given)
        if isinstance(given, bool) or not number.is_integer() or abs(number) > 2**31 - 1:
            raise ValueError
    except (TypeError, ValueError, OverflowError):
        raise refuse(f"{name} {given!r} is no whole number") from None
    return int(number)


def _quarters(values: dict[str, Any], refuse: Any) -> int | None:
    """The index times four, where it is given."""
    if "index_times_four" in values:
        four = _whole(values["index_times_four"], "index_times_four", refuse)
    elif "index" in values:
        try:
            turns = float(values["index"])
        except (TypeError, ValueError):
            raise refuse(f"index {values['index']!r} is no number") from None
        if not math.isfinite(turns) or abs(4 * turns - round(4 * turns)) > 1e-6:
            raise refuse(f"index {turns:g} is no multiple of 1/4; a valence v inside has the index (4 - v) / 4")
        four = round(4 * turns)
    else:
        return None
    if abs(four) > _LARGEST:
        raise refuse(f"index {four}/4 is out of range")
    return four
