"""From a file to a field of two lines at any angle, which follow both sides of corners that are not right.

result = compute_non_orthogonal_field("plate.obj")
result.directions, result.second_directions  # (V, 3) each, per vertex of result.surface
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .. import _core
from .._core import CornerQuads, NonOrthogonalField, SurfaceDomain, SurfaceSingularities
from ..domain.inputs import naming
from ..domain.meshed_input import MeshedInput
from ..domain.meshing import Source
from ..fields.direction_field import FieldOnSurface, curves_of
from ..options import NonOrthogonalOptions
from ..progress.phases import PeakMemory, PhaseClock, Progress, StopNote, forward
from .made import inner_features
from .points.free_axes import corners_of_lines
from .points.pattern import name_of, require_one_face
from .points.wanted import Corners, Places, meshed_with_places

_OF_LINES = (
    "method",
    "second_line",
    "corner_angle",
    "least_angle",
    "lambda_",
    "weights",
    "max_iterations",
    "inertia",
    "penalty",
    "tolerance",
    "seed",
)


@dataclass(repr=False, kw_only=True)
class NonOrthogonalFieldResult(FieldOnSurface):
    """Two lines at any angle per vertex of a surface. surface: cut open along feature edges inside, which both sides
    follow. lines: the field. directions, second_directions: (V, 3) unit vectors along the two lines. origins: (V,)
    vertex of the surface before it was cut that each is a copy of."""

    lines: NonOrthogonalField
    second_directions: np.ndarray
    origins: np.ndarray

    @property
    def vertex_data(self) -> dict[str, np.ndarray]:
        """second_direction; angle_deg: between the two lines; quads: at vertices of the boundary, 0 inside; origin."""
        cosines = abs(np.einsum("vi,vi->v", self.directions, self.second_directions))
        return {
            "second_direction": self.second_directions,
            "angle_deg": np.degrees(np.arccos(np.minimum(cosines, 1))),
            "quads": np.array(self.lines.quads, np.int32),
            "origin": self.origins,
        }


def compute_non_orthogonal_field(
    source: Source | SurfaceDomain | MeshedInput,
    options: NonOrthogonalOptions = NonOrthogonalOptions(),
    progress: Progress | None = None,
    *,
    corners: Corners | None = None,
) -> NonOrthogonalFieldResult:
    """Two lines per vertex of a surface (path or TriangleMesh) or of the boundary of a tet mesh: one follows the
    boundary, both follow the sides of corners of 1 or 3 quads (octafield.surface.non_orthogonal_field). Where feature
    edges run inside, the surface is cut open along them, so that the lines on either side follow them.

    corners: vertices of the input on the boundary with other numbers of quads than by angle: a file, dictionaries with
    vertex or position and quads, or (n, 2) rows of vertex and quads. When progress returns False while the field is
    computed or after, the best field so far is returned, with record.stopped true. Raises InvalidInput, GeometryError,
    IoError, SolverError, Cancelled.

        >>> import octafield
        >>> from octafield.layout.non_orthogonal import compute_non_orthogonal_field
        >>> corners = [[0, 0, 0], [4, 0, 0], [2.8, 1, 0], [1.2, 1, 0]]
        >>> plate = octafield.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]])
        >>> by_angle = compute_non_orthogonal_field(plate)  # the obtuse corners have two quads
        >>> told = compute_non_orthogonal_field(plate, corners=[[2, 1], [3, 1]])
        >>> [len([p for p in result.singularities.points if not p.boundary]) for result in (by_angle, told)]
        [2, 0]
    """
    from ..fields import record

    memory = PeakMemory()
    meshed, places, _ = meshed_with_places(source, replace(options, interfaces=False), progress)
    clock = PhaseClock(meshed.clock)
    stop = StopNote(progress)
    with naming(meshed.name), clock.phase("surface"):
        whole = SurfaceDomain(meshed.surface, meshed.features)
        cut_edges = inner_features(whole)
        domain, origins = _cut(whole) if cut_edges else (whole, np.arange(len(whole.vertices), dtype=np.int32))
        field = _core.non_orthogonal_field(
            domain,
            corners=_corners(domain, places, corners),
            progress=forward(stop.progress, "surface", 0.0, 0.9),
            **{name: getattr(options, name) for name in _OF_LINES},
        )
        singularities, separatrices = curves_of(field, stop.progress, stop)
    told = record.of_lines(
        meshed,
        clock,
        max(meshed.peak_mb, memory.megabytes()),
        field,
        singularities,
        options,
        corner_source="angle" if corners is None else name_of(corners),
        cut_edges=cut_edges,
        stopped=stop.stopped,
    )
    told = told.changed(notes=[*told.notes, *_notes(field, singularities)])
    return NonOrthogonalFieldResult(
        surface=domain.mesh,
        features=domain.features,
        lines=field,
        directions=np.asarray(field.first),
        second_directions=np.asarray(field.second),
        origins=origins,
        singularities=singularities,
        separatrices=separatrices,
        record=told,
    )


def _cut(whole: SurfaceDomain) -> tuple[SurfaceDomain, np.ndarray]:
    cut = _core.cut_along_features(whole)
    return cut.domain, np.array(cut.origins)


def _corners(domain: SurfaceDomain, places: Places, corners: Corners | None) -> list[CornerQuads] | None:
    found = corners_of_lines(domain, places, corners)
    for corner in found or ():
        require_one_face(np.asarray(domain.vertices), corner)
    return found


def _notes(field: NonOrthogonalField, singularities: SurfaceSingularities) -> list[str]:
    notes = []
    if not np.asarray(field.quads).any():
        notes.append(
            "the surface is closed and has no features inside: nothing asks for another angle than a right one"
        )
    if not singularities.agree:
        notes.append(
            f"the indices of the singular points add up to {singularities.index_sum:g} and the Euler characteristic is"
            f" {singularities.euler_characteristic}: along the boundary lines turn by more than half their angle from"
            " vertex to vertex; shorter edges (--edge-length) tell them apart"
        )
    return notes
