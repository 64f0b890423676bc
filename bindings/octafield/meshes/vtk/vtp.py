"""VTK's XML files of surfaces and curves (.vtp), by the reader of .vtu: VTK's own ends the process where a count is
wrong."""

import numpy as np

from ...errors import IoError
from ..cell_mesh import Block, CellMesh
from .legacy import from_offsets, whole_numbers
from .vtu import NUMBERS, File, Piece, parsed, points_of, require_rows, values_of

_CELLS = ("Verts", "Lines", "Strips", "Polys")


def read_vtp(data: bytes, name: str, size: int = 0) -> CellMesh:
    """Triangles and line segments: polygons cut by VTK, strips and polylines taken apart; none of them where a result
    has no curves. Arrays at points and cells are not read.
    size: of the file, where that is packed as a whole."""
    file = parsed(data, name, "PolyData", ("NumberOfPoints", *(f"NumberOf{kind}" for kind in _CELLS)))
    file.size = size or file.size
    points, triangles, lines, first = [np.empty((0, 3))], [np.empty((0, 3), np.int64)], [np.empty((0, 2), np.int64)], 0
    for piece in file.pieces:
        arrays = [
            (array, values_of(file, array))
            for array in piece.arrays
            if array.section == "Points" and array.attributes.get("type") in NUMBERS
        ]
        points.append(points_of(file, piece, arrays))
        cells = {kind: _cells(file, piece, kind, len(points[-1])) for kind in _CELLS}
        lines.append(_segments(*cells["Lines"]) + first)
        triangles += [_of_strips(*cells["Strips"]) + first, _of_polygons(name, points[-1], *cells["Polys"]) + first]
        first += len(points[-1])
    return CellMesh(
        np.concatenate(points), [Block("triangle", np.concatenate(triangles)), Block("line", np.concatenate(lines))]
    )


def _cells(file: File, piece: Piece, kind: str, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertex ids of all cells; where each begins and how many it has."""
    arrays = {
        array.attributes.get("Name", ""): array
        for array in piece.arrays
        if array.section == kind and array.attributes.get("type") in NUMBERS
    }
    number = piece.counts[f"NumberOf{kind}"]
    if not number and not ({"connectivity", "offsets"} <= arrays.keys()):
        return np.empty(0, np.int64), np.empty(0, np.int64), np.empty(0, np.int64)
    for key in ("connectivity", "offsets"):
        if key not in arrays:
            raise IoError(f"{file.name}: {number} {kind} have no array {key}")
    places = {key: f"{file.name}, line {array.line}" for key, array in arrays.items()}
    ids = whole_numbers(
        values_of(file, arrays["connectivity"]).ravel(), f"{places['connectivity']}: connectivity of {kind}"
    )
    ends = values_of(file, arrays["offsets"]).ravel()
    if len(ends) == number + 1 and len(ends) and ends[0] == 0:  # as newer files begin
        ends = ends[1:]
    require_rows(file, arrays["offsets"], ends, number)
    starts, sizes = from_offsets(np.concatenate([[0], ends]), len(ids), places["offsets"])
    outside = np.flatnonzero((ids < 0) | (ids >= count))
    if len(outside):
        raise IoError(
            f"{places['connectivity']}: {kind} name point {ids[outside[0]]}; there are {count} points, from 0"
        )
    return ids, starts, sizes


def _segments(ids: np.ndarray, starts: np.ndarray, sizes: np.ndarray) -> np.ndarray:
    inner = np.ones(len(ids), bool)
    inner[(starts + sizes - 1)[sizes > 0]] = False
    at = np.flatnonzero(inner)
    return np.column_stack([ids[at], ids[at + 1]]) if len(at) else np.empty((0, 2), np.int64)


def _of_strips(ids: np.ndarray, starts: np.ndarray, sizes: np.ndarray) -> np.ndarray:
    parts = [np.empty((0, 3), np.int64)]
    for start, size in zip(starts.tolist(), sizes.tolist(), strict=True):
        strip = ids[start : start + size]
        rows = np.column_stack([strip[:-2], strip[1:-1], strip[2:]]) if size > 2 else parts[0]
        rows[1::2] = rows[1::2][:, [1, 0, 2]]
        parts.append(rows)
    return np.concatenate(parts)


def _of_polygons(name: str, points: np.ndarray, ids: np.ndarray, starts: np.ndarray, sizes: np.ndarray) -> np.ndarray:
    """In the file's order where all have three vertices."""
    if (sizes == 3).all():
        return ids.reshape(-1, 3)
    if (sizes < 3).any():
        bad = int(np.argmax(sizes < 3))
        raise IoError(f"{name}: polygon {bad} (from 0) has {sizes[bad]} vertices")
    if not np.isfinite(points).all():
        raise IoError(
            f"{name}: the coordinates of point {np.argmin(np.isfinite(points).all(axis=1))} (from 0) are not finite"
        )
    import pyvista

    rows = np.insert(ids, starts, sizes)
    flat = pyvista.PolyData(points, faces=rows).triangulate()
    return np.asarray(flat.faces).reshape(-1, 4)[:, 1:].astype(np.int64)
