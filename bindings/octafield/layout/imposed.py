"""From a file to the cross field that has just the singular points wanted.

result = compute_imposed_field("plate.obj", singularities="points.json")
result.imposed.log_size  # H at the vertices of result.surface
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import _core
from .._core import ImposedField, SurfaceDomain
from ..domain.inputs import naming
from ..domain.meshed_input import MeshedInput
from ..domain.meshing import Source
from ..errors import InvalidInput
from ..fields.direction_field import SurfaceFieldResult, structure
from ..options import SurfaceFieldOptions, changed_options, require_one_of
from ..progress.phases import PeakMemory, PhaseClock, Progress, forward
from .blocks import imposed_indices
from .made import inner_features
from .options import INADMISSIBLE
from .points.pattern import pattern_of
from .points.wanted import Corners, Points, PointsWanted, meshed_with_places, require_own_surface


@dataclass(repr=False, kw_only=True)
class ImposedFieldResult(SurfaceFieldResult):
    """A cross field with imposed singular points. surface: refined round them; the first vertices are those of the
    surface before. imposed: with the sizes, and where the refined surface is in the one before."""

    imposed: ImposedField

    @property
    def vertex_data(self) -> dict[str, np.ndarray]:
        """log_size: H; exp(H) is the edge of quads up to one factor. index_times_four: of singular points and corners,
        else 0."""
        indices = np.zeros(len(self.surface.vertices), np.int32)
        for vertex, four in imposed_indices(self.imposed).items():
            indices[vertex] = four
        return {"log_size": np.array(self.imposed.log_size), "index_times_four": indices}


def compute_imposed_field(
    source: Source | SurfaceDomain | MeshedInput,
    options: SurfaceFieldOptions = SurfaceFieldOptions(),
    progress: Progress | None = None,
    *,
    singularities: Points,
    corners: Corners | None = None,
    inadmissible: str = "fail",
) -> ImposedFieldResult:
    """The cross field that has just these singular points, on a surface or on the boundary of a tet mesh.

    options: of the mesh; those of a field that is computed must be left at their defaults. singularities, corners: as
    of compute_quad_layout. inadmissible: what to do where no field has the points in these places: "fail", "move" them,
    "rotate" the field (octafield.surface.impose_singular_points). Raises InvalidInput, GeometryError, IoError,
    SolverError, Cancelled.

        >>> import octafield
        >>> from octafield.layout.imposed import compute_imposed_field
        >>> plate = octafield.TriangleMesh([[0, 0, 0], [3, 0, 0], [3, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
        >>> pair = [{"position": [1, 0.5, 0], "valence": 3}, {"position": [2, 0.5, 0], "valence": 5}]
        >>> result = compute_imposed_field(plate, singularities=pair)
        >>> sorted(point.index for point in result.record.singularities)
        [-0.25, 0.25, 0.25, 0.25, 0.25, 0.25]
    """
    from ..fields import record as of_fields
    from ..records.parts import ImposedFigures
    from .record import misalignment_of, points_of

    require_one_of("inadmissible", inadmissible, INADMISSIBLE[1:])
    _refuse_ignored(options)
    require_own_surface(source, singularities)
    memory = PeakMemory()
    meshed, places, _ = meshed_with_places(source, options, progress)
    clock = PhaseClock(meshed.clock)
    with naming(meshed.name), clock.phase("surface"):
        domain = SurfaceDomain(meshed.surface, meshed.features)
        pattern = pattern_of(domain, PointsWanted(places, singularities, corners, options), progress)
        made = _core.impose_singular_points(
            domain, pattern.pattern, inadmissible=inadmissible, progress=forward(progress, "surface", 0, 0.9)
        )
        directions, found, separatrices = structure(made.field, progress)
    fine = made.field.domain
    told = of_fields.of_surface_field(
        meshed, clock, max(meshed.peak_mb, memory.megabytes()), made.field, found, options, None, stopped=False
    )
    told = told.changed(
        vertices=len(fine.vertices),
        triangles=len(fine.triangles),
        method="imposed",
        notes=[*told.notes, *pattern.notes, *_of_features(domain)],
        imposed=ImposedFigures(
            point_source=pattern.source,
            corner_source=pattern.corner_source,
            points=points_of(made),
            misalignment=misalignment_of(made),
            inadmissible=inadmissible,
            largest_move=made.largest_move,
            closure=made.closure,
            input_triangles=len(meshed.surface.triangles),
        ),
    )
    return ImposedFieldResult(
        surface=fine.mesh,
        features=fine.features,
        direction_field=made.field,
        directions=directions,
        singularities=found,
        separatrices=separatrices,
        record=told,
        imposed=made,
    )


def _refuse_ignored(options: SurfaceFieldOptions) -> None:
    if options.symmetry != 4:
        raise InvalidInput(
            f"singular points are imposed on crosses: a symmetry of 4 is needed, not {options.symmetry}",
            "wrong_symmetry",
        )
    given = [f"{name}={value!r}" for name, value in changed_options(options, of_mesh=False).items()]
    if given:
        raise InvalidInput(
            f"the field follows from its singular points: {', '.join(given)} would be ignored; leave that out",
            "ignored_options",
        )


def _of_features(domain: SurfaceDomain) -> list[str]:
    count = inner_features(domain)
    if not count:
        return []
    return [f"{count} feature edges inside the surface are not followed: imposed fields follow the boundary alone"]
