"""A cross field that the user has: its singular points become the irregular vertices."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from .._core import DirectionField, SurfaceDomain, TriangleMesh
from ..domain.inputs import Input
from ..errors import InvalidInput, IoError
from ..files.reading import read_bytes

FieldGiven = str | Path | ArrayLike
FieldAt = Callable[[SurfaceDomain], DirectionField]

_FLAT = 0.1  # of its length: a direction whose part in the surface is shorter says nothing there
_MOST_FLAT = 0.1  # of the triangles
_AWAY = 0.02  # of the diagonal: a surface that is farther is another one
_NAMES = ("direction", "directions")  # of data in .vtp files


def is_vtp(given: FieldGiven) -> bool:
    return isinstance(given, (str, Path)) and Path(given).suffix.lower() == ".vtp"


def field_at(given: FieldGiven, found: Input) -> FieldAt:
    """given: (V, 3) or (F, 3) directions, one of each cross, at the vertices or triangles of the input; a .npy file of
    these; or a .vtp file of a surface with data `direction`, as `octafield surface-field` writes. Elsewhere on the
    surface the nearest one counts. Raises InvalidInput, IoError."""
    if is_vtp(given):
        surface, directions, of_triangles = _of_file(Path(str(given)))
    else:
        name = str(given) if isinstance(given, (str, Path)) else "field"
        values = _load(Path(given)) if isinstance(given, (str, Path)) else given
        surface = found.surface
        directions, of_triangles = _checked(values, surface, name)
    return lambda domain: _on(domain, surface, directions, of_triangles)


def _load(path: Path) -> np.ndarray:
    import io

    try:
        array: np.ndarray = np.load(io.BytesIO(read_bytes(path)), allow_pickle=False)
    except (ValueError, EOFError, OSError) as error:
        raise IoError(
            f"{path}: no field ({error}); give .npy of (V, 3) or (F, 3) directions, or .vtp", "bad_field"
        ) from error
    return array


def _of_file(path: Path) -> tuple[TriangleMesh, np.ndarray, bool]:
    from ..view.datasets import read_vtp

    whole = read_vtp(path)
    if not whole.n_cells or not whole.is_all_triangles:
        raise InvalidInput(f"{path}: a field's surface is of triangles; give one of these", "bad_field")
    surface = TriangleMesh(np.array(whole.points, float), np.array(whole.regular_faces, np.int32))
    for data in (whole.point_data, whole.cell_data):
        for name in _NAMES:
            if name in data:
                return surface, *_checked(np.array(data[name]), surface, f"{path}: {name}")
    raise InvalidInput(f"{path}: has no data named {_NAMES[0]}; give the field that name", "bad_field")


def _checked(values: ArrayLike, surface: TriangleMesh, name: str) -> tuple[np.ndarray, bool]:
    """And whether they are of triangles."""
    try:
        array = np.asarray(values, dtype=float)
    except (TypeError, ValueError) as error:
        raise InvalidInput(f"{name}: not an array of numbers ({error})", "wrong_type") from error
    vertices, triangles = len(surface.vertices), len(surface.triangles)
    if array.ndim != 2 or array.shape[1] != 3 or len(array) not in (vertices, triangles):
        raise InvalidInput(
            f"{name}: an array of shape {array.shape}; give directions in space, one per vertex ({vertices}, 3) or"
            f" triangle ({triangles}, 3) of the input",
            "wrong_shape",
        )
    bad = np.flatnonzero(~np.isfinite(array).all(axis=1) | (np.linalg.norm(array, axis=1) == 0))
    if len(bad):
        raise InvalidInput(
            f"{name}: {len(bad)} directions are 0 or not finite, the first at row {bad[0]} (from 0); correct them",
            "bad_field",
            [int(i) for i in bad[:100]],
        )
    return array / np.linalg.norm(array, axis=1)[:, None], len(array) != vertices


def _on(domain: SurfaceDomain, surface: TriangleMesh, directions: np.ndarray, of_triangles: bool) -> DirectionField:
    """On edges: the mean of the crosses of the triangles beside it, along those of the boundary."""
    points, triangles = np.asarray(domain.vertices), np.asarray(domain.triangles)
    there = _nearest(points[triangles].mean(axis=1), surface, directions, of_triangles)
    first, second = (points[triangles[:, k]] - points[triangles[:, 0]] for k in (1, 2))
    normals = np.cross(first, second)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    edges, beside = np.asarray(domain.edges), np.asarray(domain.edge_triangles)
    along = points[edges[:, 1]] - points[edges[:, 0]]
    along /= np.linalg.norm(along, axis=1)[:, None]
    values, flats = np.zeros(len(edges), complex), 0
    for k in (0, 1):
        at = np.flatnonzero(beside[:, k] >= 0)
        triangle = beside[at, k]
        x = np.einsum("ij,ij->i", there[triangle], along[at])
        y = np.einsum("ij,ij->i", there[triangle], np.cross(normals[triangle], along[at]))
        flat = np.hypot(x, y)
        flats += int((flat <= _FLAT).sum())
        values[at] += np.where(flat > _FLAT, ((x + 1j * y) / np.maximum(flat, _FLAT)) ** 4, 0)
    if flats > _MOST_FLAT * (beside >= 0).sum():
        raise InvalidInput(
            "the field's directions are nearly normal to the surface in many triangles; give tangent ones",
            "not_tangent",
        )
    values[beside.min(axis=1) < 0] = 1
    size = np.abs(values)
    return DirectionField(symmetry=4, domain=domain, values=np.where(size > 0, values / np.maximum(size, 1e-300), 1))


def _nearest(places: np.ndarray, surface: TriangleMesh, directions: np.ndarray, of_triangles: bool) -> np.ndarray:
    """(n, 3): of the nearest triangle, or of its corner nearest to the place."""
    import pyvista

    points, triangles = np.array(surface.vertices), np.array(surface.triangles, int)
    given = pyvista.PolyData.from_regular_faces(points, triangles)
    found, nearest = given.find_closest_cell(places, return_closest_point=True)
    cells = np.asarray(found)
    away = np.linalg.norm(nearest - places, axis=1).max() / np.linalg.norm(np.ptp(points, axis=0))
    if away > _AWAY:
        raise InvalidInput(
            f"the field is on another surface: up to {100 * away:.2g} % of its diagonal away; give one on this surface",
            "other_surface",
        )
    corners = triangles[cells]
    near = np.linalg.norm(points[corners] - places[:, None], axis=2).argmin(axis=1)
    result: np.ndarray = directions[cells if of_triangles else corners[np.arange(len(cells)), near]]
    return result
