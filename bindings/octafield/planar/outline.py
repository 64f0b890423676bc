"""Outlines from arrays: loops and lines become points and segments."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from .._core import PlanarOutline
from ..errors import GeometryError, InvalidInput

SHORTEST, LONGEST = 0.5, 2.0  # segments, in edge lengths (Simons 2024, 2.2)


def planar_outline(
    loops: Iterable[ArrayLike], lines: Iterable[ArrayLike] = (), points: ArrayLike | None = None
) -> PlanarOutline:
    """The PlanarOutline of polylines.

    loops: (n, 2) points each, closed without the first one again (a last point equal to the first is left out); inside
    is what an odd number of them goes round, so holes are loops too. lines: (n, 2) points each, which become edges;
    where one has a point of another or of a loop, the two are joined. points: (n, 2) more points inside that become
    vertices. Raises InvalidInput (kinds wrong_shape, wrong_type, short_loop, non_finite_vertex, empty) and
    GeometryError (repeated_point, and the kinds of octafield.surface.require_planar).
    """
    closed = [_closed(_rows(loop, f"loop {i}"), i) for i, loop in enumerate(loops)]
    open_lines = [_rows(line, f"line {i}") for i, line in enumerate(lines)]
    singles = np.zeros((0, 2)) if points is None else _rows(points, "points")
    for i, curve in enumerate(closed):
        _require_new_points(curve, f"loop {i}")
    for i, curve in enumerate(open_lines):
        if len(curve) < 2:
            raise InvalidInput(f"line {i} has {len(curve)} points; a line has two at least", "short_line", [i])
        _require_new_points(curve[:-1] if (curve[0] == curve[-1]).all() else curve, f"line {i}")
    everything = np.concatenate([*closed, *open_lines, singles, np.zeros((0, 2))])
    places, ids = _numbered(everything)
    segments: tuple[list[np.ndarray], list[np.ndarray]] = ([], [])
    start = 0
    for kind, curves in enumerate((closed, open_lines)):
        for curve in curves:
            own = ids[start : start + len(curve)]
            start += len(curve)
            following = np.roll(own, -1)
            pairs = np.column_stack([own, following])
            segments[kind].append(pairs if kind == 0 else pairs[:-1])
    outline = PlanarOutline(places, *(np.concatenate([*kind, np.zeros((0, 2), np.int32)]) for kind in segments))
    _core.require_planar(outline)
    return outline


def lengths_of(outline: PlanarOutline) -> np.ndarray:
    """Of the segments, loops first, then lines."""
    points = np.asarray(outline.points)
    ends = points[np.concatenate([np.asarray(outline.loops), np.asarray(outline.lines)])]
    lengths: np.ndarray = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    return lengths


def require_spacing(outline: PlanarOutline, edge_length: float) -> None:
    """Raises GeometryError (kind segment_length, elements: segments) unless all have from half to twice the edge
    length."""
    lengths = lengths_of(outline)
    wrong = np.flatnonzero((lengths < SHORTEST * edge_length) | (lengths >= LONGEST * edge_length))
    if len(wrong):
        raise GeometryError(
            f"{len(wrong)} segments have less than half the edge length {edge_length:.4g} or twice that and more (from"
            f" {lengths[wrong].min():.4g} to {lengths[wrong].max():.4g}); choose another edge length, resample the"
            ' outline (spacing="resample") or take it as it is (spacing="accept")',
            "segment_length",
            wrong.tolist(),
        )


def resampled_outline(outline: PlanarOutline, edge_length: float) -> PlanarOutline:
    """The same region with segments near to an edge length.

    Points nearer than 0.7 of it to the one kept before are left out, but for ends of lines and points where they meet,
    and what is longer is divided evenly. So corners may be cut by less than that; what is left of a loop may cross
    itself, which is GeometryError (kind crossing), or vanish (kind lost_loop).
    """
    if not 0 < edge_length < np.inf:
        raise InvalidInput(f"the edge length must be positive, not {edge_length}", "bad_option")
    _core.require_planar(outline)
    loops, lines = np.asarray(outline.loops), np.asarray(outline.lines)
    points = np.asarray(outline.points)
    used = np.zeros(len(points), bool)
    used[loops] = used[lines] = True
    count = np.bincount(np.concatenate([loops.ravel(), lines.ravel()]), minlength=len(points))
    joints = (count != 2) & used
    new_loops = [_thinned(points, chain, joints, edge_length) for chain in chains(loops, np.zeros(len(points), bool))]
    for number, loop in enumerate(new_loops):
        if len(loop) < 4:
            raise GeometryError(
                f"loop {number} is too small for the edge length {edge_length:.4g}", "lost_loop", [number]
            )
    new_lines = [_thinned(points, chain, joints, edge_length) for chain in chains(lines, joints)]
    return planar_outline([loop[:-1] for loop in new_loops], new_lines, points[~used])


def chains(segments: np.ndarray, ends: np.ndarray) -> list[list[int]]:
    """Polylines of (n, 2) segments, cut where `ends` (bool per point) says so; rings have their first point twice."""
    round_point: dict[int, list[int]] = {}
    for number, pair in enumerate(segments.tolist()):
        for point in pair:
            round_point.setdefault(point, []).append(number)
    cut = {p for p, there in round_point.items() if len(there) != 2 or ends[p]}
    used: set[int] = set()
    result: list[list[int]] = []
    for start in [*sorted(cut), *sorted(round_point)]:
        for first in round_point[start]:
            chain: list[int] = [start]
            s: int | None = None if first in used else first
            while s is not None:
                used.add(s)
                a, b = segments[s].tolist()
                chain.append(b if a == chain[-1] else a)
                onward = [] if chain[-1] in cut else [other for other in round_point[chain[-1]] if other not in used]
                s = onward[0] if onward else None
            if len(chain) > 1:
                result.append(chain)
    return result


def _thinned(points: np.ndarray, chain: Sequence[int], joints: np.ndarray, edge_length: float) -> np.ndarray:
    kept: list[int] = []
    for number, p in enumerate(chain):
        last = number == len(chain) - 1
        near = len(kept) > 0 and _near(points, kept[-1], p, 0.7 * edge_length)
        if near and not (last or joints[p]):
            continue
        while len(kept) > 1 and not joints[kept[-1]] and _near(points, kept[-1], p, 0.7 * edge_length):
            kept.pop()
        kept.append(p)
    corners = points[kept]
    parts = [
        np.linspace(a, b, max(1, round(float(np.linalg.norm(b - a)) / edge_length)) + 1)[:-1]
        for a, b in zip(corners, corners[1:], strict=False)
    ]
    return np.concatenate([*parts, corners[-1:]])


def _near(points: np.ndarray, a: int, b: int, distance: float) -> bool:
    return bool(np.linalg.norm(points[a] - points[b]) < distance)


def _rows(value: ArrayLike, name: str) -> np.ndarray:
    try:
        rows = np.asarray(value, dtype=float)
    except (TypeError, ValueError) as error:
        raise InvalidInput(f"{name}: not an array of numbers ({error})", "wrong_type") from error
    if rows.ndim != 2 or rows.shape[1] != 2:
        raise InvalidInput(f"{name}: expected an array of shape (n, 2), got {rows.shape}", "wrong_shape")
    lost = np.flatnonzero(~np.isfinite(rows).all(axis=1))
    if len(lost):
        raise InvalidInput(
            f"{name}: coordinates are not finite (points {lost[:5].tolist()})", "non_finite_vertex", lost.tolist()
        )
    return rows + 0.0  # no -0.0


def _closed(loop: np.ndarray, number: int) -> np.ndarray:
    if len(loop) > 1 and (loop[0] == loop[-1]).all():
        loop = loop[:-1]
    if len(loop) < 3:
        raise InvalidInput(f"loop {number} has {len(loop)} points; a loop has three at least", "short_loop", [number])
    return loop


def _require_new_points(curve: np.ndarray, name: str) -> None:
    _, first = np.unique(curve, axis=0, return_index=True)
    again = np.setdiff1d(np.arange(len(curve)), first)
    if len(again):
        raise GeometryError(
            f"{name} is at a point twice (points {again[:5].tolist()}); remove repeated points, and give what touches"
            " itself as several loops apart from each other",
            "repeated_point",
            again.tolist(),
        )


def _numbered(rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Different rows in the order in which they come first, and the number of each."""
    _, first, inverse = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    rank = np.argsort(np.argsort(first))
    return rows[np.sort(first)], rank[inverse.reshape(-1)].astype(np.int32)
