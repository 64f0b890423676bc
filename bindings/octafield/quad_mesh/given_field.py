"""A cross field that the user has: its singular points become the irregular vertices, its directions those of edges."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from .._core import DirectionField, SurfaceDomain, TriangleMesh
from ..domain.inputs import Input
from ..errors import InvalidInput, IoError
from ..files.reading import read_bytes

FieldGiven = str | Path | ArrayLike

_FLAT = 0.1  # of its length: a direction whose part in the surface is shorter says nothing there
_MOST_FLAT = 0.1  # of the triangles
_AWAY = 0.02  # of the diagonal: a surface that is farther is another one
_NAMES = ("direction", "directions")  # of data in .vtp files


def is_vtp(given: FieldGiven) -> bool:
    return isinstance(given, (str, Path)) and Path(given).suffix.lower() == ".vtp"


@dataclass
class GivenField:
    """surface: that the field is on. directions: (n, 3) of length 1, one of each cross, at its vertices or triangles.
    Elsewhere the nearest place of the surface counts."""

    surface: TriangleMesh
    directions: np.ndarray
    of_triangles: bool

    def aligned(self, domain: SurfaceDomain) -> DirectionField:
        """On edges: the mean of the crosses of the triangles beside it, along those of the boundary."""
        return _on(domain, self._at_triangles(domain), along_boundary=True)

    def followed(self, domain: SurfaceDomain) -> np.ndarray:
        """(E,) values of the field as it is, also on the boundary."""
        return np.asarray(_on(domain, self._at_triangles(domain), along_boundary=False).values)

    def at(self, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(n, 3) directions, and normals of the surface there."""
        return self._near(places)[:2]

    def _near(self, places: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Directions, of the nearest triangle or between those at its corners; its normals; how far it is."""
        import pyvista

        points, triangles = np.array(self.surface.vertices), np.array(self.surface.triangles, int)
        given = pyvista.PolyData.from_regular_faces(points, triangles)
        found, nearest = given.find_closest_cell(places, return_closest_point=True)
        cells, nearest = np.asarray(found), np.asarray(nearest)
        corners = points[triangles[cells]]
        normals, distances = _normals(corners), np.linalg.norm(nearest - places, axis=1)
        if self.of_triangles:
            return self.directions[cells], normals, distances
        at_corners = self.directions[triangles[cells]]
        return _between(nearest, corners, at_corners, normals), normals, distances

    def _at_triangles(self, domain: SurfaceDomain) -> np.ndarray:
        directions, _, distances = self._near(np.asarray(domain.vertices)[np.asarray(domain.triangles)].mean(axis=1))
        away = distances.max() / np.linalg.norm(np.ptp(np.asarray(self.surface.vertices), axis=0))
        if away > _AWAY:
            raise InvalidInput(
                f"the field is on another surface: up to {100 * away:.2g} % of its diagonal away; give one on this"
                " surface",
                "other_surface",
            )
        return directions


def field_at(given: FieldGiven, found: Input) -> GivenField:
    """given: (V, 3) or (F, 3) directions, one of each cross, at the vertices or triangles of the input; a .npy file of
    these; or a .vtp file of a surface with data `direction`, as `octafield surface-field` writes. Raises InvalidInput,
    IoError."""
    if is_vtp(given):
        return GivenField(*_of_file(Path(str(given))))
    name = str(given) if isinstance(given, (str, Path)) else "field"
    values = _load(Path(given)) if isinstance(given, (str, Path)) else given
    return GivenField(found.surface, *_checked(values, found.surface, name))


def _load(path: Path) -> np.ndarray:
    import io

    try:
        array: np.ndarray = np.load(io.BytesIO(read_bytes(path)), allow_pickle=False)
    except (ValueError, EOFError, OSError) as error:
        raise IoError(
            f"{path}: no field: no .npy file of numbers; give .npy of (V, 3) or (F, 3) directions, or .vtp", "bad_field"
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
        array = np.array(values, dtype=float)
    except (TypeError, ValueError) as error:
        raise InvalidInput(f"{name}: not an array of numbers ({error})", "wrong_type") from error
    vertices, triangles = len(surface.vertices), len(surface.triangles)
    if array.ndim != 2 or array.shape[1] != 3 or len(array) not in (vertices, triangles):
        raise InvalidInput(
            f"{name}: an array of shape {array.shape}; give directions in space, one per vertex ({vertices}, 3) or"
            f" triangle ({triangles}, 3) of the input",
            "wrong_shape",
        )
    largest = np.abs(array).max(axis=1, initial=0)
    odd = (largest > 0) & ~((largest > 1e-100) & (largest < 1e100))
    array[odd] /= largest[odd, None]  # squares stay numbers
    bad = np.flatnonzero(~np.isfinite(array).all(axis=1) | (array == 0).all(axis=1))
    if len(bad):
        raise InvalidInput(
            f"{name}: {len(bad)} directions are 0 or not finite, the first at row {bad[0]} (from 0); correct them",
            "bad_field",
            [int(i) for i in bad[:100]],
        )
    return array / np.linalg.norm(array, axis=1)[:, None], len(array) != vertices


def _on(domain: SurfaceDomain, there: np.ndarray, along_boundary: bool) -> DirectionField:
    """there: (F, 3) directions at the triangles of the domain."""
    points, triangles = np.asarray(domain.vertices), np.asarray(domain.triangles)
    normals = _normals(points[triangles])
    edges, beside = np.asarray(domain.edges), np.asarray(domain.edge_triangles)
    along = points[edges[:, 1]] - points[edges[:, 0]]
    along /= np.linalg.norm(along, axis=1)[:, None]
    values, flats = np.zeros(len(edges), complex), 0
    for k in (0, 1):
        at = np.flatnonzero(beside[:, k] >= 0)
        triangle = beside[at, k]
        z = _in_plane(there[triangle], along[at], normals[triangle])
        flats += int((abs(z) <= _FLAT).sum())
        values[at] += _fourth(z)
    if flats > _MOST_FLAT * (beside >= 0).sum():
        raise InvalidInput(
            "the field's directions are nearly normal to the surface in many triangles; give tangent ones",
            "not_tangent",
        )
    if along_boundary:
        values[beside.min(axis=1) < 0] = 1
    size = np.abs(values)
    return DirectionField(symmetry=4, domain=domain, values=np.where(size > 0, values / np.maximum(size, 1e-300), 1))


def _between(places: np.ndarray, corners: np.ndarray, at_corners: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """(n, 3) at places in triangles: linear in fourth powers; that of the nearest corner where these cancel."""
    x = corners[:, 1] - corners[:, 0]
    x /= np.linalg.norm(x, axis=1)[:, None]
    sums = np.zeros(len(places), complex)
    for k in range(3):
        a, b = corners[:, (k + 1) % 3], corners[:, (k + 2) % 3]
        share = np.einsum("ij,ij->i", np.cross(b - a, places - a), normals)
        sums += np.maximum(share, 0) * _fourth(_in_plane(at_corners[:, k], x, normals))
    turned = np.exp(0.25j * np.angle(sums))[:, None]
    near = np.linalg.norm(corners - places[:, None], axis=2).argmin(axis=1)
    result: np.ndarray = np.where(
        abs(sums)[:, None] > 0,
        turned.real * x + turned.imag * np.cross(normals, x),
        at_corners[np.arange(len(places)), near],
    )
    return result


def _normals(corners: np.ndarray) -> np.ndarray:
    """(n, 3) of triangles, corners (n, 3, 3)."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    result: np.ndarray = normals / np.linalg.norm(normals, axis=1)[:, None]
    return result


def _in_plane(directions: np.ndarray, x: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """(n,) complex, x real."""
    along, across = (np.einsum("ij,ij->i", directions, axis) for axis in (x, np.cross(normals, x)))
    result: np.ndarray = along + 1j * across
    return result


def _fourth(directions: np.ndarray) -> np.ndarray:
    """Of length 1; 0 where they say nothing."""
    sizes = abs(directions)
    result: np.ndarray = np.where(sizes > _FLAT, (directions / np.maximum(sizes, _FLAT)) ** 4, 0)
    return result
