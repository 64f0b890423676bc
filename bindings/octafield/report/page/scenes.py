"""Singular curves of the runs on one mesh as lines to turn in a page: a small binary block, drawn by view.js.

A block is base64 of zlib's stream of: uint32 length of the head, the head (JSON, padded to an even length with spaces),
then int16 coordinates, all little-endian. Coordinates are whole steps along the longest side of the box; the first
point of a line from the box's corner, each other from the point before. The head: size: of the box in steps; outline:
points per line; scenes: a list of {kind: points per line}, of "nodes" one line. The coordinates follow in this order,
those of the outline first.
"""

import base64
import json
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...view.datasets import read_vtp
from ..numbers.records import Run

if TYPE_CHECKING:
    import pyvista

STEPS = 16383
LEGEND = (
    ("#D55E00", "valence 3"),
    ("#0072B2", "valence 5"),
    ("#AA4499", "other singular curves"),
    ("#7b8794", "sharp edges and middle sections"),
)
KINDS = ("valence 3", "valence 5", "other", "nodes")
_MOST_SURFACE_POINTS, _MOST_CURVE_POINTS = 5000, 30_000


class _Files(NamedTuple):
    surface: Path
    curves: Path


def encode(runs: Sequence[Run]) -> tuple[str, list[int | None]]:
    """The block of the runs on one mesh, and the place in it of each run; None where files were not kept. Empty without
    any. Runs with the same curves share a place."""
    kept = [_files(run) for run in runs]
    first = next((files for files in kept if files is not None), None)
    if first is None:
        return "", [None] * len(runs)
    surface = read_vtp(first.surface)
    low, high = np.array(surface.bounds).reshape(3, 2).T
    scale = STEPS / (high - low).max()

    def whole(points: np.ndarray) -> np.ndarray:
        steps: np.ndarray = np.rint((np.asarray(points) - low) * scale).astype(np.int64)
        return steps

    outline = [whole(line) for line in _thinned(_outline(surface), _MOST_SURFACE_POINTS)]
    places: list[int | None] = []
    known: dict[bytes, int] = {}
    scenes: list[dict[str, list[int]]] = []
    parts = [_deltas(outline)]
    for files in kept:
        if files is None:
            places.append(None)
            continue
        lines = {kind: [whole(line) for line in of] for kind, of in _curves(files.curves).items()}
        data = _deltas([line for kind in KINDS for line in lines[kind]])
        place = known.setdefault(data.tobytes(), len(scenes))
        places.append(place)
        if place == len(scenes):
            scenes.append({kind: list(map(len, lines[kind])) for kind in KINDS})
            parts.append(data)
    head = {"size": whole(high).tolist(), "outline": list(map(len, outline)), "scenes": scenes}
    text = json.dumps(head, separators=(",", ":")).encode()
    text += b" " * (len(text) % 2)
    content = np.uint32(len(text)).astype("<u4").tobytes() + text + np.concatenate(parts).tobytes()
    return base64.b64encode(zlib.compress(content, 9)).decode(), places


def _files(run: Run) -> _Files | None:
    surface, curves = run.file("surface.vtp"), run.file("singular.vtp")
    return None if surface is None or curves is None else _Files(surface, curves)


def _deltas(lines: list[np.ndarray]) -> np.ndarray:
    if not lines:
        return np.zeros(0, "<i2")
    return (
        np.concatenate([np.diff(line, axis=0, prepend=np.zeros((1, 3), np.int64)) for line in lines])
        .astype("<i2")
        .ravel()
    )


def _curves(path: Path) -> dict[str, list[np.ndarray]]:
    found = read_vtp(path)
    curves: dict[str, list[np.ndarray]] = {kind: [] for kind in KINDS}
    if not found.n_lines:
        return curves
    nodes = np.asarray(found.points)[np.asarray(found.point_data["node"], bool)]
    found.points = np.asarray(found.point_data["smoothed"])
    turns = np.asarray(found.cell_data["quarter_turns"])[found.n_verts :]  # cell data begin with those of vertices
    for line, turn in zip(_thinned(_polylines(found), _MOST_CURVE_POINTS), turns, strict=True):
        curves[{1: "valence 3", -1: "valence 5"}.get(int(turn), "other")].append(line)
    curves["nodes"] = [nodes] if len(nodes) else []
    return curves


def _outline(surface: "pyvista.PolyData") -> list[np.ndarray]:
    """Sharp edges, and where the surface crosses the three middle planes."""
    sharp = surface.extract_feature_edges(35, boundary_edges=False, non_manifold_edges=False)
    cuts = surface.slice_orthogonal().combine().extract_surface(algorithm=None)
    return [line for part in (sharp, cuts) if part.n_cells for line in _polylines(part.strip(join=True))]


def _thinned(lines: list[np.ndarray], most: int) -> list[np.ndarray]:
    """Every so-manieth point of lines that have more than `most` in all, and their last."""
    keep = max(1, -(-sum(map(len, lines)) // most))
    return [line if len(line) < 3 * keep else np.concatenate([line[:-1:keep], line[-1:]]) for line in lines]


def _polylines(poly: "pyvista.PolyData") -> list[np.ndarray]:
    points, cells = np.asarray(poly.points), np.asarray(poly.lines)
    result, k = [], 0
    while k < len(cells):
        result.append(points[cells[k + 1 : k + 1 + cells[k]]])
        k += 1 + cells[k]
    return result
