"""u, v per corner of the triangles of a surface: the map to the integer grid whose lines are those of the quads."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .._core import IntegerGridMap
from ..errors import InvalidInput
from ..files.writing import write_file

_DIGITS = 9  # after the point: u, v of a vertex that agree so far are one


def corner_coordinates(grid_map: IntegerGridMap) -> np.ndarray:
    """(m, 3, 2) u, v of each corner of each triangle; a quad is 1 by 1."""
    result: np.ndarray = np.array(grid_map.coordinates).reshape(-1, 3, 2)
    return result


def write_grid_map(grid_map: IntegerGridMap, path: str | Path) -> None:
    """.obj with v and vt: corners of a vertex have one vt where u, v go on, and others where they do so after a turn by
    quarters and a shift by whole numbers, which a texture that repeats does not show. Raises InvalidInput (kind
    "unknown_format"), IoError.

        >>> import tempfile
        >>> import octafield
        >>> corners = [[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]]
        >>> plate = octafield.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]])
        >>> result = octafield.compute_quad_mesh(plate, quad_options=octafield.QuadMeshOptions(quads=8))
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     octafield.write_grid_map(result.grid_map(), f"{folder}/uv.obj")
        ...     {line.split()[0] for line in open(f"{folder}/uv.obj")} == {"v", "vt", "f"}
        True
    """
    target = Path(path)
    if target.suffix.lower() != ".obj":
        raise InvalidInput(f"{target}: u, v are written as .obj; give that extension", "unknown_format")
    write_file(target, obj_bytes(grid_map))


def obj_bytes(grid_map: IntegerGridMap) -> bytes:
    triangles, places = np.asarray(grid_map.triangles).ravel(), np.asarray(grid_map.coordinates)
    keys = np.column_stack([triangles, np.round(places, _DIGITS) + 0.0])  # no -0
    _, first, number = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    lines = ["v " + " ".join(f"{x:.17g}" for x in point) for point in np.asarray(grid_map.positions).tolist()]
    lines += [f"vt {u:.17g} {v:.17g}" for u, v in places[first].tolist()]
    corners = np.column_stack([triangles, number.ravel()]).reshape(-1, 3, 2) + 1
    lines += ["f " + " ".join(f"{v}/{vt}" for v, vt in triangle) for triangle in corners.tolist()]
    return ("\n".join(lines) + "\n").encode()
