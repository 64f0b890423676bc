"""How exactly quads follow features, found on their arrays: nothing asks what made them."""

from __future__ import annotations

import numpy as np

from .._core import QuadMesh, SurfaceDomain
from ..layout.quality import edges_of

_ON = 1e-9  # of the diagonal: on a feature
_CHORD = 0.35  # of its length: how far the middle of an edge along a feature may be from it


def feature_deviation(mesh: QuadMesh, domain: SurfaceDomain) -> tuple[float, float]:
    """Over the diagonal of the surface, of its features and its boundary: how far their corners are from the nearest
    vertex of the quads at most; and how far any of their points are from an edge of the quads that has both ends on
    them, along the curve (chords of bent curves count; infinite where there is no such edge). 0, 0 without features."""
    import pyvista

    vertices = np.asarray(domain.vertices)
    lines = feature_edges(domain)
    if not len(lines):
        return 0.0, 0.0
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    diagonal = float(np.linalg.norm(high - low))
    middle = (low + high) / 2  # far from the origin VTK's tolerances are larger than the surface
    vertices = vertices - middle
    points, edges = np.asarray(mesh.vertices) - middle, edges_of(np.asarray(mesh.quads))[0]
    curves = lines_of(vertices, lines)
    on = distance_to(curves, points) <= _ON * diagonal
    along = edges[on[edges].all(axis=1)]
    if len(along):
        lengths = np.linalg.norm(points[along[:, 0]] - points[along[:, 1]], axis=1)
        along = along[distance_to(curves, points[along].mean(axis=1)) <= _CHORD * lengths]
    corners = np.asarray(domain.features.corners)
    cloud = pyvista.PolyData(points)
    missed = 0.0
    for corner in vertices[corners]:
        missed = max(missed, float(np.linalg.norm(points[cloud.find_closest_point(corner)] - corner)))
    if not len(along):
        return missed / diagonal, float("inf")
    places = np.concatenate([vertices[np.unique(lines)], vertices[lines].mean(axis=1)])
    return missed / diagonal, float(distance_to(lines_of(points, along), places).max()) / diagonal


def feature_edges(domain: SurfaceDomain) -> np.ndarray:
    """(n, 2) vertex ids: of features, and of the boundary."""
    rim = np.asarray(domain.edges)[np.asarray(domain.edge_triangles).min(axis=1) < 0]
    both = np.concatenate([np.asarray(domain.features.edges).reshape(-1, 2), rim])
    result: np.ndarray = np.unique(np.sort(both, axis=1), axis=0)
    return result


def lines_of(points: np.ndarray, edges: np.ndarray):  # type: ignore[no-untyped-def]
    import pyvista

    return pyvista.PolyData(points.copy(), lines=np.column_stack([np.full(len(edges), 2), edges]).ravel())


def distance_to(lines, places: np.ndarray) -> np.ndarray:  # type: ignore[no-untyped-def]
    _, nearest = lines.find_closest_cell(places, return_closest_point=True)
    result: np.ndarray = np.linalg.norm(np.asarray(nearest) - places, axis=1)
    return result
