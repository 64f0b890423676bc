"""What the checks of the doctor for inputs measure."""

import math
from typing import Any

import numpy as np

from .. import _core
from .._core import FeatureGraph, TriangleMesh

Array = np.ndarray[Any, Any]
_MOST_RAYS = 2000
_FACING = math.cos(math.radians(30))  # two faces within this angle of parallel are a wall


def curve_lengths(surface: TriangleMesh, features: FeatureGraph) -> Array:
    """Of the feature curves between corners, input unit; closed ones without a corner too."""
    import scipy.sparse.csgraph

    edges = np.asarray(features.edges)
    points = np.asarray(surface.vertices)
    if not len(edges):
        return np.empty(0)
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    inner = np.ones(len(points), bool)
    inner[np.asarray(features.corners)] = False
    # Two edges belong to one curve when they meet at a vertex that is no corner.
    vertex, edge = edges.ravel(), np.repeat(np.arange(len(edges)), 2)
    chosen = inner[vertex]
    at = scipy.sparse.csr_array(
        (np.ones(int(chosen.sum())), (edge[chosen], vertex[chosen])), shape=(len(edges), len(points))
    )
    count, label = scipy.sparse.csgraph.connected_components(at @ at.T, directed=False)
    result: Array = np.bincount(label, weights=lengths, minlength=count)
    return result


def thicknesses(surface: TriangleMesh) -> tuple[Array, Array]:
    """Distances to the face opposite of evenly chosen triangles that have one, and the share of the surface each stands
    for."""
    _, thick = wall_samples(surface)
    return thick, np.full(len(thick), 1 / len(thick))


def wall_samples(surface: TriangleMesh) -> tuple[Array, Array]:
    """Evenly chosen triangles (ids), and the distance from each to the face opposite; inf where there is no wall."""
    import vtk

    from ..runs.interop import to_pyvista

    corners = np.asarray(surface.vertices)[np.asarray(surface.triangles)]
    diagonal = float(_core.bounding_box_diagonal(surface.vertices))
    areas = np.asarray(_core.triangle_areas(surface))
    normals = np.asarray(_core.triangle_normals(surface))
    total = areas.cumsum()
    count = min(_MOST_RAYS, 20 * len(areas))
    chosen = np.searchsorted(total, (np.arange(count) + 0.5) / count * total[-1])
    # spread inside large triangles: barycentric coordinates from a fixed sequence
    u, v = np.modf(np.outer(np.arange(1, count + 1), [0.754877666, 0.569840291]))[0].T
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    weights = np.stack([1 - u - v, u, v], axis=1)
    points = np.einsum("nk,nkc->nc", weights, corners[chosen])
    mesh = to_pyvista(surface)
    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(mesh)
    locator.BuildLocator()
    parameter, cell = vtk.mutable(0.0), vtk.mutable(0)
    hit, local, sub = [0.0] * 3, [0.0] * 3, vtk.mutable(0)
    thick = np.full(count, np.inf)
    for k, (point, normal) in enumerate(zip(points, normals[chosen], strict=True)):
        start, end = point - 1e-6 * diagonal * normal, point - 1.1 * diagonal * normal
        if (
            locator.IntersectWithLine(start, end, 0.0, parameter, hit, local, sub, cell)
            and -normals[cell.get()] @ normal > _FACING
        ):
            thick[k] = np.linalg.norm(np.asarray(hit) - point)
    return chosen, thick


def dihedral_angles(points: Array, tets: Array) -> Array:
    """(m, 6) degrees."""
    p = points[tets]
    normals = np.stack(
        [np.cross(p[:, b] - p[:, a], p[:, c] - p[:, a]) for a, b, c in ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))],
        axis=1,
    )
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    pairs = [(a, b) for a in range(4) for b in range(a)]
    cosines = np.stack([-np.einsum("nc,nc->n", normals[:, a], normals[:, b]) for a, b in pairs], axis=1)
    angles: Array = np.degrees(np.arccos(np.clip(cosines, -1, 1)))
    return angles


def radius_ratios(points: Array, tets: Array) -> Array:
    """(m,) 3 inradius / circumradius: 1 for regular tets, 0 for flat ones."""
    p = points[tets]
    a, b, c = (p[:, k] - p[:, 0] for k in (1, 2, 3))
    volume = np.abs(np.einsum("nc,nc->n", a, np.cross(b, c))) / 6
    faces = ((a, b), (b, c), (c, a), (b - a, c - a))
    area = sum(np.linalg.norm(np.cross(u, v), axis=1) / 2 for u, v in faces)
    squares = [np.einsum("nc,nc->n", x, x)[:, None] for x in (a, b, c)]
    turned = squares[0] * np.cross(b, c) + squares[1] * np.cross(c, a) + squares[2] * np.cross(a, b)
    circumradius = np.linalg.norm(turned, axis=1) / np.maximum(12 * volume, np.finfo(float).tiny)
    ratios: Array = 9 * volume / (area * np.maximum(circumradius, np.finfo(float).tiny))
    return ratios
