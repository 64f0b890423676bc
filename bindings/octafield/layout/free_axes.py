"""The pattern that is imposed where the axes of quads may be at any angle: that of a field of two lines, on the surface
measured so that these are orthonormal."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import _core
from .._core import NonOrthogonalField, SingularPattern, SurfaceDomain
from ..errors import InvalidInput, SolverError
from ..options import SurfaceFieldOptions
from ..progress.phases import Progress, forward
from .pattern import Pattern, Places, given_pattern, name_of, with_corners
from .point_files import corner_rows


def pattern_of_lines(
    domain: SurfaceDomain,
    places: Places,
    singularities: Any,
    corners: Any,
    options: SurfaceFieldOptions,
    progress: Progress | None,
) -> tuple[SurfaceDomain, Pattern]:
    """The surface measured by the lines, and the pattern on it. singularities, corners: as of pattern_of; corners that
    are given decide how the lines run there."""
    surface = SurfaceDomain(domain.mesh)  # features inside, which the lines do not follow, have been cut or told of
    rows = None if corners is None else corner_rows(corners)
    wanted = SingularPattern() if rows is None else with_corners(surface, places, SingularPattern(), rows)
    if wanted.points:
        raise InvalidInput(
            "corners of quads with free axes are at vertices of the boundary, and remeshing has left none at"
            f" {np.round(_core.imposed_position(surface, wanted.points[0]), 6).tolist()}; leave the corner out, or mark"
            " the vertices of the boundary as features",
            "not_on_boundary",
        )
    lines = _core.non_orthogonal_field(
        surface, corners=wanted.corners or None, seed=options.seed, progress=forward(progress, "surface", 0, 1)
    )
    metric = _core.lines_metric(lines)
    if singularities is None:
        made = Pattern(
            _points_of(lines, metric.domain), "computed", "computed" if corners is None else name_of(corners)
        )
    elif isinstance(singularities, SingularPattern):
        made = Pattern(singularities, "given", "given" if singularities.corners else "computed")
    else:
        made = given_pattern(metric.domain, places, singularities)
    made.notes += _notes(lines, len(metric.damped))
    return metric.domain, made


def _points_of(lines: NonOrthogonalField, measured: SurfaceDomain) -> SingularPattern:
    found = _core.surface_singularities(lines)
    if not found.agree:
        raise SolverError(
            f"the singular points of the lines are of index {found.index_sum:g} in all, where the surface asks for"
            f" {found.euler_characteristic}: along its boundary lines turn by more than half their angle from vertex to"
            " vertex; --triangle-length (edge_length of the field's options) gives shorter triangles, or take"
            " orthogonal axes",
            "unclear_points",
        )
    return _core.singular_pattern(measured, found)


def _notes(lines: NonOrthogonalField, damped: int) -> list[str]:
    notes = []
    if not lines.converged:
        notes.append("the field of lines did not come to rest; quads follow its last state")
    if damped:
        notes.append(
            f"lines turn too fast for the triangles at {damped} of {len(lines.angles)} vertices, where quads are drawn"
            " towards right angles; --triangle-length (edge_length of the field's options) gives shorter triangles"
        )
    return notes
