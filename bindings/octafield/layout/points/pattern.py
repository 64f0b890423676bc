"""The pattern of singular points that is imposed: of a computed field, or as given, placed on the surface."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ... import _core
from ..._core import CornerQuads, DirectionField, ImposedPoint, SingularPattern, SurfaceDomain
from ...errors import InvalidInput
from ...options import SurfaceFieldOptions
from ...progress.phases import Progress, forward
from .point_files import PointRow, corner_rows, point_rows
from .wanted import Places, PointsWanted

_SAME = 1e-6  # of the diagonal: places that are one
_ANY_WAY, _TRIANGLES_EACH = 40, 25  # singular points of a user's field, and triangles for each where there are more
_MOST_QUADS = 16  # at a corner, for points inside that make up for it
_NEAR = 1e-3  # of the diagonal: how far a corner may be from the boundary


@dataclass
class Pattern:
    """On the surface that the field will be on. source, corner_source: computed, given, or files; by angle."""

    pattern: SingularPattern
    source: str
    corner_source: str
    notes: list[str] = field(default_factory=list)


def pattern_of(domain: SurfaceDomain, wanted: PointsWanted, progress: Progress | None) -> Pattern:
    singularities, corners = wanted.singularities, wanted.corners
    fitted = wanted.fitted and singularities is None
    if isinstance(singularities, SingularPattern):
        made = Pattern(singularities, "given", "given" if singularities.corners else "angle")
    elif singularities is None:
        if wanted.field is None:
            computed = _computed(domain, wanted.options, progress)
        else:
            computed = _of_field(wanted.field(domain))
            _require_smooth(domain, computed)
        if fitted:
            computed = _core.with_corner_quads(domain, computed, _core.finite_corner_quads(domain, computed))
        source = "computed" if wanted.field is None else wanted.field_name
        made = Pattern(computed, source, source)
    else:
        made = _given(domain, wanted.places, singularities)
    if corners is not None:
        rows = corner_rows(corners)
        replaced = with_corners(domain, wanted.places, made.pattern, rows)
        if fitted and all(abs(corner.quads) <= _MOST_QUADS for corner in replaced.corners):
            replaced = _made_good(domain, made.pattern, replaced)
        made = Pattern(replaced, made.source, name_of(corners), made.notes)
    return made


def _made_good(domain: SurfaceDomain, computed: SingularPattern, wanted: SingularPattern) -> SingularPattern:
    """The computed pattern with the corners of `wanted`, and points inside for what these change the sum by. wanted has
    the points of `computed` first, then corners where the boundary has no vertex."""
    had = {corner.vertex: corner.quads for corner in computed.corners}
    vertices = np.asarray(domain.vertices)
    for corner in wanted.corners:
        if had.get(corner.vertex) != corner.quads:
            require_one_face(vertices, corner)
    fitting = _core.with_corner_quads(domain, computed, wanted.corners)
    return SingularPattern([*fitting.points, *list(wanted.points)[len(computed.points) :]], fitting.corners)


def require_one_face(vertices: np.ndarray, corner: CornerQuads) -> None:
    """vertices: of the surface, cut along features."""
    at = vertices[corner.vertex]
    if (vertices == at).all(axis=1).sum() > 1:
        raise InvalidInput(
            f"the corner at {at.tolist()} is on a feature edge, where faces meet that have numbers of quads of"
            " their own; give corners of the boundary away from features, or take no features",
            "several_faces",
            [corner.vertex],
        )


def _computed(domain: SurfaceDomain, options: SurfaceFieldOptions, progress: Progress | None) -> SingularPattern:
    if options.symmetry != 4:
        raise InvalidInput(
            f"quads follow crosses: a field of symmetry 4 is needed, not {options.symmetry}", "wrong_symmetry"
        )
    guide = None
    if options.curvature > 0:
        found = _core.principal_directions(domain)
        guide = _core.DirectionGuide(found.directions, options.curvature * found.anisotropy)
    made = _core.direction_field(
        domain,
        symmetry=4,
        method=options.method,
        epsilon=options.epsilon,
        feature_alignment=options.feature_alignment,
        least_feature_angle=options.least_feature_angle,
        guide=guide,
        seed=options.seed,
        progress=forward(progress, "surface", 0, 1),
    )
    return _of_field(made)


def _of_field(field: DirectionField) -> SingularPattern:
    return _core.singular_pattern(field, _core.surface_singularities(field))


def _require_smooth(domain: SurfaceDomain, found: SingularPattern) -> None:
    """Of a field that the user has: noise turns by as much as it can in every triangle."""
    points, triangles = len(found.points), len(domain.triangles)
    if points > _ANY_WAY and points * _TRIANGLES_EACH > triangles:
        raise InvalidInput(
            f"the field has {points} singular points inside on {triangles} triangles; give one that is smooth, one"
            f" point to {_TRIANGLES_EACH} triangles at most, or shorter triangles",
            "rough_field",
        )


def _given(domain: SurfaceDomain, places: Places, singularities: Any) -> Pattern:
    points, corners = point_rows(singularities)
    rim = Rim(domain)
    placed = [_placed(domain, places, rim, row) for row in points]
    pattern = SingularPattern(placed)
    source = name_of(singularities)
    if not corners:
        return Pattern(pattern, source, "angle")
    return Pattern(with_corners(domain, places, pattern, corners), source, source)


def name_of(given: Any) -> str:
    return str(given) if isinstance(given, str) or hasattr(given, "__fspath__") else "given"


def _placed(domain: SurfaceDomain, places: Places, rim: Rim, row: PointRow) -> ImposedPoint:
    at = np.array(row.position) if row.position is not None else places.of(row.vertex or 0, row.name)
    try:
        point = _core.imposed_point(domain, at, row.index_times_four or 0)
    except InvalidInput as error:
        raise InvalidInput(f"{row.name} (from 0): {error}; give a place on it", error.kind, error.elements) from error
    if row.index_times_four is None:
        on_boundary = rim.distance(_core.imposed_position(domain, point)) <= _SAME
        if row.quads is not None and not on_boundary:
            raise InvalidInput(
                f"{row.name} (from 0): has a number of quads but is not on the boundary; give a valence or index",
                "not_on_boundary",
            )
        number = row.valence if row.quads is None else row.quads
        four = (2 if on_boundary else 4) - (number or 0)
        point = ImposedPoint(point.triangle, point.weights, four)
    return point


def with_corners(
    domain: SurfaceDomain, places: Places, pattern: SingularPattern, rows: list[PointRow]
) -> SingularPattern:
    """Each at the vertex of the boundary there or, where remeshing left none, at the point of the boundary."""
    rim, points = Rim(domain), list(pattern.points)
    corners = {corner.vertex: corner.quads for corner in pattern.corners}
    for row in rows:
        at = np.array(row.position) if row.position is not None else places.of(row.vertex or 0, row.name)
        number = row.quads if row.quads is not None else row.valence
        quads = 2 - row.index_times_four if row.index_times_four is not None else number or 0
        if rim.distance(at) > _NEAR:
            raise InvalidInput(
                f"{row.name} (from 0): is not on the boundary of the surface; inside, give a singular point instead",
                "not_on_boundary",
            )
        vertex = rim.vertex_at(at)
        if vertex is not None:
            corners[vertex] = quads
        else:
            points.append(_core.imposed_point(domain, rim.nearest(at), 2 - quads))
    return SingularPattern(points, [CornerQuads(vertex, quads) for vertex, quads in sorted(corners.items())])


class Rim:
    """The boundary of a surface, for finding what is on it. Distances are relative to the diagonal."""

    def __init__(self, domain: SurfaceDomain):
        alone = np.asarray(domain.edge_triangles).min(axis=1) < 0
        points, self._edges = np.asarray(domain.vertices), np.asarray(domain.edges)[alone]
        self._points = points
        self._scale = float(np.linalg.norm(points.max(axis=0) - points.min(axis=0))) or 1.0

    def nearest(self, at: np.ndarray) -> np.ndarray:
        a, b = self._points[self._edges[:, 0]], self._points[self._edges[:, 1]]
        along = b - a
        share = np.clip(np.einsum("ij,ij->i", at - a, along) / np.einsum("ij,ij->i", along, along), 0, 1)
        places = a + share[:, None] * along
        nearest: np.ndarray = places[np.linalg.norm(places - at, axis=1).argmin()]
        return nearest

    def distance(self, at: np.ndarray) -> float:
        if not len(self._edges):
            return float("inf")
        return float(np.linalg.norm(self.nearest(at) - at)) / self._scale

    def vertex_at(self, at: np.ndarray) -> int | None:
        ids = np.unique(self._edges)
        distances = np.linalg.norm(self._points[ids] - at, axis=1) / self._scale
        return int(ids[distances.argmin()]) if distances.min() <= _SAME else None
