"""From a file to a direction field on its surface: read, mesh, field, singular points, separatrices.

result = compute_surface_field("part.stl", SurfaceFieldOptions(symmetry=4, curvature=1))
result.directions  # (V, 3), one of the N directions per vertex of result.surface
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import (
    DirectionConstraints,
    DirectionField,
    DirectionGuide,
    FeatureGraph,
    NonOrthogonalField,
    Streamline,
    SurfaceDomain,
    SurfaceSingularities,
    TriangleMesh,
)
from ..domain.inputs import naming
from ..domain.meshed_input import MeshedInput
from ..domain.meshing import Source, prepare_mesh
from ..errors import Cancelled, InvalidInput
from ..options import SurfaceFieldOptions
from ..progress.phases import PeakMemory, PhaseClock, Progress, StopNote, forward
from ..view.notebook import Facts, ShownInNotebooks, facts_of_record

if TYPE_CHECKING:
    import pyvista

    from ..records.surface_field import SurfaceFieldRecord

_SHOWN = ("triangles", "energy", "epsilon", "euler_characteristic", "index_sum", "converged")


@dataclass(repr=False, kw_only=True)
class FieldOnSurface(ShownInNotebooks):
    """What fields of directions on a surface have in common. directions: (V, 3), one representative per vertex. record:
    all figures, the JSON object of the command line."""

    surface: TriangleMesh
    features: FeatureGraph
    directions: np.ndarray
    singularities: SurfaceSingularities
    separatrices: Sequence[Streamline]
    record: SurfaceFieldRecord

    def __repr__(self) -> str:
        r = self.record
        return (
            f"{type(self).__name__}({r.input}: {r.triangles:,} triangles; symmetry {r.symmetry}; "
            f"{len(self.singularities.points):,} singular points, index sum {self.singularities.index_sum:g})"
        )

    @property
    def vertex_data(self) -> dict[str, np.ndarray]:
        """What is known at the vertices beside the directions."""
        return {}

    def dataset(self) -> pyvista.PolyData:
        """The surface with point data direction and vertex_data."""
        from ..view.scene import surface_mesh

        surface = surface_mesh(self.surface).copy()
        for name, values in {"direction": self.directions, **self.vertex_data}.items():
            surface.point_data[name] = np.array(values)
        return surface

    def _facts(self) -> Facts:
        """For notebooks."""
        return facts_of_record(self.record, _SHOWN)

    def _drawn(self) -> pyvista.Plotter:
        """Singular points and separatrices on the surface."""
        from ..view.surface_field import surface_field_scene

        return surface_field_scene(self.surface, self.features, self.singularities, self.separatrices)


@dataclass(repr=False, kw_only=True)
class SurfaceFieldResult(FieldOnSurface):
    """An N-direction field on a surface. directions: (V, 3), one representative per vertex. record: all
    figures, the JSON object of the command line."""

    direction_field: DirectionField


def compute_surface_field(
    source: Source | MeshedInput,
    options: SurfaceFieldOptions = SurfaceFieldOptions(),
    progress: Progress | None = None,
    *,
    constraints: DirectionConstraints | None = None,
    guide: DirectionGuide | None = None,
) -> SurfaceFieldResult:
    """N-direction field on a surface (path or TriangleMesh) or on the boundary of a tet mesh.

    constraints, guide: directions to follow, on the vertices, edges and triangles of the surface the field is computed
    on. Remeshing makes another surface of the input, so prepare it first:

        >>> import octafield
        >>> from octafield.domain.generators import generate
        >>> meshed = octafield.prepare_mesh(generate("ball"), volume=False)  # or a path
        >>> held = {"vertices": [7], "vertex_directions": [[1, 0, 0]]}  # of meshed.surface
        >>> asked = octafield.surface.DirectionConstraints(**held)
        >>> len(octafield.compute_surface_field(meshed, constraints=asked).singularities.points)
        8

    When progress returns False while the field is computed or after, the best field so far is returned, with
    record.stopped true, converged False where the solver was stopped, and no separatrices; before that, Cancelled is
    raised.
    """
    from . import record

    memory = PeakMemory()
    if (constraints is not None or guide is not None) and not isinstance(source, MeshedInput):
        raise InvalidInput(
            "constraints and guides belong to the surface the field is computed on; "
            "give the result of prepare_mesh(source, options, volume=False) instead of the source",
            "not_meshed",
        )
    meshed = (
        source if isinstance(source, MeshedInput) else prepare_mesh(source, options, volume=False, progress=progress)
    )
    clock = PhaseClock(meshed.clock)
    stop = StopNote(progress)
    with naming(meshed.name), clock.phase("surface"):
        surface = SurfaceDomain(meshed.surface, meshed.features)
        if options.curvature > 0:
            guide = _lines_of_curvature(surface, options, guide)
        field = _core.direction_field(
            surface,
            symmetry=options.symmetry,
            method=options.method,
            epsilon=options.epsilon,
            boundary_alignment=options.boundary_alignment,
            feature_alignment=options.feature_alignment,
            least_feature_angle=options.least_feature_angle,
            constraints=constraints,
            guide=guide,
            seed=options.seed,
            progress=forward(stop.progress, "surface", 0.0, 0.9),
        )
        directions, singularities, separatrices = structure(field, stop.progress, stop)
    peak_mb = max(meshed.peak_mb, memory.megabytes())
    told = record.of_surface_field(
        meshed, clock, peak_mb, field, singularities, options, constraints, stopped=stop.stopped
    )
    return SurfaceFieldResult(
        surface=meshed.surface,
        features=meshed.features,
        direction_field=field,
        directions=directions,
        singularities=singularities,
        separatrices=separatrices,
        record=told,
    )


def _lines_of_curvature(
    surface: SurfaceDomain, options: SurfaceFieldOptions, guide: DirectionGuide | None
) -> DirectionGuide:
    if guide is not None:
        raise InvalidInput("a guide field and curvature are one too many: set curvature to 0", "two_guides")
    found = _core.principal_directions(surface)
    return DirectionGuide(found.directions, options.curvature * found.anisotropy)


def structure(
    field: DirectionField, progress: Progress | None, stop: StopNote | None = None
) -> tuple[np.ndarray, SurfaceSingularities, list[Streamline]]:
    """Directions at the vertices, singular points and separatrices of a surface field. Cancelled while it traces, it
    raises Cancelled; with `stop` it leaves the separatrices out, as when it was stopped before."""
    return np.asarray(_core.vertex_directions(field)), *curves_of(field, progress, stop)


def curves_of(
    field: DirectionField | NonOrthogonalField, progress: Progress | None, stop: StopNote | None = None
) -> tuple[SurfaceSingularities, list[Streamline]]:
    """Singular points and separatrices; cancelled, as structure."""
    singularities = _core.surface_singularities(field)
    if stop is not None and stop.stopped:
        return singularities, []
    try:
        separatrices = _core.separatrices(field, singularities, progress=forward(progress, "surface", 0.9, 1.0))
    except Cancelled:
        if stop is None:
            raise
        separatrices = []
    return singularities, separatrices
