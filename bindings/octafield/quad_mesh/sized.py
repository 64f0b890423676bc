"""Wanted edge lengths of quads, and surfaces measured in them: where quads shall be small, much of it is."""

from __future__ import annotations

import numpy as np

from .. import _core
from .._core import SurfaceDomain, TriangleMesh
from ..domain.inputs import Input
from ..errors import GeometryError, InvalidInput
from ..hexdom.sizes import SizeAt, Sizes, size_function

_GROWTH = "growth="


def size_at(sizes: Sizes, found: Input) -> SizeAt:
    """As size_function; or "growth=G": the length of edges of the input's boundary at the nearest place of it, plus G
    times the distance to it. Raises InvalidInput, IoError."""
    if not (isinstance(sizes, str) and sizes.startswith(_GROWTH)):
        return size_function(sizes, found)
    try:
        growth = float(sizes[len(_GROWTH) :])
    except ValueError:
        growth = float("nan")
    if not (np.isfinite(growth) and growth >= 0):
        raise InvalidInput(f"{sizes}: growth is a number of 0 or more, as growth=0.2", "bad_option")
    return _from_boundary(found.surface, growth)


def _from_boundary(surface: TriangleMesh, growth: float) -> SizeAt:
    import pyvista

    domain, points = SurfaceDomain(surface), np.array(surface.vertices)
    rim = np.asarray(domain.edges)[np.asarray(domain.edge_triangles).min(axis=1) < 0]
    if not len(rim):
        raise InvalidInput("the surface has no boundary that sizes could grow from; give sizes", "no_boundary")
    lengths = np.linalg.norm(points[rim[:, 1]] - points[rim[:, 0]], axis=1)
    sums, counts = np.zeros(len(points)), np.zeros(len(points))
    for end in (0, 1):
        np.add.at(sums, rim[:, end], lengths)
        np.add.at(counts, rim[:, end], 1)
    at_vertex = sums / np.maximum(counts, 1)
    lines = pyvista.PolyData(points, lines=np.column_stack([np.full(len(rim), 2), rim]).ravel())

    def at(places: np.ndarray) -> np.ndarray:
        cells, nearest = lines.find_closest_cell(places, return_closest_point=True)  # type: ignore[misc]
        first, last = rim[np.asarray(cells)].T
        share = np.linalg.norm(nearest - points[first], axis=1) / lengths[np.asarray(cells)]
        there = (1 - share) * at_vertex[first] + share * at_vertex[last]
        result: np.ndarray = there + growth * np.linalg.norm(nearest - places, axis=1)
        return result

    return at


def sized(domain: SurfaceDomain, sizes: SizeAt) -> SurfaceDomain:
    """octafield.surface.sized_domain with these sizes. Raises InvalidInput (kind "steep_sizes") where they change too
    fast for the triangles."""
    try:
        return _core.sized_domain(domain, sizes(np.asarray(domain.vertices)))
    except GeometryError as error:
        if error.kind != "no_triangle":
            raise
        triangle = np.asarray(domain.triangles)[error.elements[0]]
        place = ", ".join(f"{x:.4g}" for x in np.asarray(domain.vertices)[triangle].mean(axis=0))
        raise InvalidInput(
            f"sizes change too fast for the triangles, first at ({place}); --triangle-length (edge_length of the"
            " field's options) gives shorter triangles, or let sizes grow more slowly",
            "steep_sizes",
            error.elements,
        ) from error


def quads_wanted(domain: SurfaceDomain, sizes: SizeAt) -> float:
    """int dA / size^2, the sizes linear in triangles (rule of three midpoints)."""
    values = sizes(np.asarray(domain.vertices))[np.asarray(domain.triangles)]
    middle = (values + np.roll(values, -1, axis=1)) / 2
    return float((np.asarray(_core.triangle_areas(domain.mesh)) * (middle**-2.0).mean(axis=1)).sum())
