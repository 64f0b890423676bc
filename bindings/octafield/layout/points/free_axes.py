"""The pattern that is imposed where the axes of quads may be at any angle. Parts of the surface (faces, where it is cut
along features) with corners that no right angles fit get that of a field of two lines, and are measured so that these
are orthonormal; the others that of a cross field, as ever."""

from __future__ import annotations

import math

import numpy as np

from ... import _core
from ..._core import CornerQuads, NonOrthogonalField, SingularPattern, SurfaceDomain
from ...errors import InvalidInput, SolverError
from ...progress.phases import Progress, forward
from .pattern import Pattern, pattern_of, with_corners
from .point_files import corner_rows
from .wanted import Corners, Places, PointsWanted

_OBLIQUE = math.radians(10)  # by which a corner of 1 or 3 quads is off their right angles


def pattern_of_lines(
    domain: SurfaceDomain, wanted: PointsWanted, progress: Progress | None
) -> tuple[SurfaceDomain, Pattern]:
    """The surface measured by the lines, and the pattern on it. Corners that are given decide how the lines run
    there."""
    surface = SurfaceDomain(domain.mesh)  # features inside, which the lines do not follow, have been cut or told of
    lines = _core.non_orthogonal_field(
        surface,
        corners=corners_of_lines(surface, wanted.places, wanted.corners),
        seed=wanted.options.seed,
        progress=forward(progress, "surface", 0, 0.5),
    )
    oblique = _oblique_parts(lines)
    if not oblique.any():
        return domain, pattern_of(domain, wanted, progress)
    metric = _core.lines_metric(lines)
    measured = _measured(domain, metric.domain, oblique)
    if wanted.singularities is not None:
        made = pattern_of(measured, wanted, progress)
    else:
        made = _joined(lines, measured, oblique)
        if not oblique.all():
            right = pattern_of(domain, wanted, forward(progress, "surface", 0.5, 1))
            made = _put_together(domain, oblique, made.pattern, right)
    made.notes += _notes(lines, np.asarray(metric.damped), oblique)
    return measured, made


def corners_of_lines(surface: SurfaceDomain, places: Places, corners: Corners | None) -> list[CornerQuads] | None:
    """Of vertices of the boundary, by their numbers on the surface. Raises InvalidInput where one is elsewhere."""
    if corners is None:
        return None
    given = with_corners(surface, places, SingularPattern(), corner_rows(corners))
    if given.points:
        at = np.round(_core.imposed_position(surface, given.points[0]), 6).tolist()
        raise InvalidInput(
            f"corners of quads with free axes are at vertices of the boundary, and remeshing has left none at {at};"
            " leave the corner out, or mark the vertices of the boundary as features",
            "not_on_boundary",
        )
    return given.corners


def _oblique_parts(lines: NonOrthogonalField) -> np.ndarray:
    """(F,) bool: triangles of connected parts with a corner that both lines follow and right angles do not fit."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    domain, quads = lines.domain, np.asarray(lines.quads)
    triangles, beside = np.asarray(domain.triangles), np.asarray(domain.edge_triangles)
    inner = beside[beside.min(axis=1) >= 0]
    graph = coo_array((np.ones(len(inner)), (inner[:, 0], inner[:, 1])), shape=(len(triangles), len(triangles)))
    count, part = connected_components(graph, directed=False)
    angles = np.bincount(triangles.ravel(), np.asarray(domain.corner_angles).ravel(), len(quads))
    off = (quads % 2 == 1) & (abs(angles - quads * np.pi / 2) > _OBLIQUE)
    found = np.zeros(count, bool)
    found[part[off[triangles].any(axis=1)]] = True
    oblique: np.ndarray = found[part]
    return oblique


def _measured(domain: SurfaceDomain, by_lines: SurfaceDomain, oblique: np.ndarray) -> SurfaceDomain:
    edges = oblique[np.asarray(domain.edge_triangles).max(axis=1)]
    lengths = np.where(edges, np.asarray(by_lines.edge_lengths), np.asarray(domain.edge_lengths))
    return SurfaceDomain(domain.mesh).with_edge_lengths(lengths)


def _joined(lines: NonOrthogonalField, measured: SurfaceDomain, oblique: np.ndarray) -> Pattern:
    """The points of the lines, where the indices on oblique parts add up."""
    found = _core.surface_singularities(lines)
    triangles, at = np.asarray(measured.triangles), _at_vertices(measured, oblique)
    total = sum(
        point.index_times_symmetry
        for point in found.points
        if (at[point.vertex] if point.vertex >= 0 else oblique[point.triangle])
    )
    edges = int(oblique[np.asarray(measured.edge_triangles).max(axis=1)].sum())
    wanted = len(np.unique(triangles[oblique])) - edges + int(oblique.sum())
    if total != 4 * wanted:
        raise SolverError(
            f"the singular points of the lines are of index {total / 4:g} in all, where the surface asks for {wanted}:"
            " along its boundary lines turn by more than half their angle from vertex to vertex; --triangle-length"
            " (edge_length of the field's options) gives shorter triangles, or take orthogonal axes",
            "unclear_points",
        )
    return Pattern(_core.singular_pattern(measured, found), "computed", "computed")


def _at_vertices(domain: SurfaceDomain, oblique: np.ndarray) -> np.ndarray:
    at = np.zeros(len(domain.vertices), bool)
    at[np.asarray(domain.triangles)[oblique]] = True
    return at


def _put_together(domain: SurfaceDomain, oblique: np.ndarray, of_lines: SingularPattern, right: Pattern) -> Pattern:
    at = _at_vertices(domain, oblique)
    points = [p for p in of_lines.points if oblique[p.triangle]]
    points += [p for p in right.pattern.points if not oblique[p.triangle]]
    corners = [c for c in of_lines.corners if at[c.vertex]] + [c for c in right.pattern.corners if not at[c.vertex]]
    corners.sort(key=lambda corner: corner.vertex)
    return Pattern(SingularPattern(points, corners), right.source, right.corner_source, right.notes)


def _notes(lines: NonOrthogonalField, damped: np.ndarray, oblique: np.ndarray) -> list[str]:
    notes = []
    if not lines.converged:
        notes.append("the field of lines did not come to rest; quads follow its last state")
    count = int(_at_vertices(lines.domain, oblique)[damped].sum())
    if count:
        notes.append(
            f"lines turn too fast for the triangles at {count} of {len(lines.angles)} vertices, where quads are drawn"
            " towards right angles; --triangle-length (edge_length of the field's options) gives shorter triangles"
        )
    return notes
