"""From a file to block-structured quads: read, singular points, field, layout, quads, figures.

result = compute_quad_layout("plate.obj", layout_options=QuadLayoutOptions(quads=500), singularities="points.json")
result.mesh             # octafield.surface.QuadMesh
result.record.patches   # the figures
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from .._core import ImposedField, QuadMesh, SurfaceDomain, TriangleMesh
from ..domain.inputs import naming
from ..domain.meshed_input import MeshedInput
from ..domain.meshing import Source
from ..options import SurfaceFieldOptions
from ..progress.phases import Progress
from ..view.notebook import Facts, ShownInNotebooks
from .blocks import LayoutParts
from .made import quads_on
from .options import QuadLayoutOptions
from .points.wanted import Corners, Points, PointsWanted, meshed_with_places, require_own_surface

if TYPE_CHECKING:
    import pyvista

    from ..records.quad_layout import QuadLayoutRecord

_SHOWN = ("patches", "quads", "irregular_vertices", "scaled_jacobian", "surface_deviation")


@dataclass(repr=False, kw_only=True)
class QuadLayoutResult(ShownInNotebooks):
    """Block-structured quads and what led to them.

    mesh: the quads. blocks: (q,) block of each. chords: (q, 2) row of blocks that it is in, across its first and second
    pair of sides. scaled_jacobians: (q,). valences: (V,) quads round each vertex; on_boundary: (V,) bool. layout: as
    arrays, None where the quads come from no layout of curves. field: that they follow, on the surface refined round
    its singular points. record: all figures, the JSON object of the command line."""

    mesh: QuadMesh
    blocks: np.ndarray
    chords: np.ndarray
    scaled_jacobians: np.ndarray
    valences: np.ndarray
    on_boundary: np.ndarray
    layout: LayoutParts | None
    field: ImposedField
    record: QuadLayoutRecord

    def __repr__(self) -> str:
        r = self.record
        return (
            f"QuadLayoutResult({r.input}: {r.quads:,} quads in {r.patches:,} patches, {r.irregular_vertices:,}"
            f" irregular vertices; least scaled Jacobian {r.scaled_jacobian.min:.3f})"
        )

    def _facts(self) -> Facts:
        return str(self.record.input), {name: self.record.to_dict()[name] for name in _SHOWN}

    def scene(self) -> pyvista.Plotter:
        """A pyvista scene: blocks in colours, the edges of quads, sides of blocks, singular points."""
        from ..view.window import shown_where_possible

        return shown_where_possible(self._drawn())

    def _drawn(self) -> pyvista.Plotter:
        from ..view.quad_layout import quad_scene

        sides = None if self.layout is None else self.layout.sides
        return quad_scene(self.mesh, self.blocks, self.valences, self.on_boundary, sides)


def compute_quad_layout(
    source: Source | SurfaceDomain | MeshedInput,
    options: SurfaceFieldOptions = SurfaceFieldOptions(),
    progress: Progress | None = None,
    *,
    layout_options: QuadLayoutOptions = QuadLayoutOptions(),
    singularities: Points | None = None,
    corners: Corners | None = None,
) -> QuadLayoutResult:
    """Block-structured quads on a surface, open or closed, or on the boundary of a tet mesh (paths or meshes in
    memory), along the cross field that has just the singular points wanted.

    options: of the mesh that the field is computed on, and of the cross field that the singular points come from where
        none are given. Their edge_length is that of triangles.
    singularities: a .json or .csv file, or what it holds: dictionaries with position (3,) or vertex (of the input) and
        index (turns), index_times_four or valence; or (n, 4) rows x y z index. Or a SingularPattern on the surface of
        the result of prepare_mesh that is the source.
    corners: likewise, of vertex or position, and quads; or (n, 2) rows of vertex and quads: where other numbers than
        those by angle are wanted.

    progress(phase, fraction, merit): False cancels. Raises InvalidInput, GeometryError, IoError, SolverError,
    Cancelled.

        >>> import octafield
        >>> corners = [[0, 0, 0], [3, 0, 0], [3, 1, 0], [0, 1, 0]]
        >>> plate = octafield.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]])
        >>> result = octafield.compute_quad_layout(plate, layout_options=octafield.QuadLayoutOptions(quads=12))
        >>> result.record.quads, result.record.patches, result.record.scaled_jacobian.min > 0.99
        (12, 1, True)
    """
    require_own_surface(source, singularities)
    meshed, places, given = meshed_with_places(source, replace(options, interfaces=False), progress)
    with naming(meshed.name):
        points = PointsWanted(places, singularities, corners, options, fitted=layout_options.layout == "t-mesh")
        return _on(meshed, given, points, layout_options, progress)


def _on(
    meshed: MeshedInput,
    given: TriangleMesh,
    points: PointsWanted,
    wanted: QuadLayoutOptions,
    progress: Progress | None,
) -> QuadLayoutResult:
    from . import record

    found = quads_on(meshed, given, points, wanted, progress)
    made, figures = found.quads, found.figures
    told = record.of_quads(
        made, figures, found.field, found.pattern, found.begun, len(meshed.surface.triangles), found.target,
        found.inadmissible, found.meter, dict(vars(wanted)), points.options.recorded(),
    )  # fmt: skip
    return QuadLayoutResult(
        mesh=made.mesh,
        blocks=made.blocks,
        chords=made.chords,
        scaled_jacobians=figures.scaled_jacobians,
        valences=figures.quads_round,
        on_boundary=figures.on_boundary,
        layout=made.layout,
        field=found.field,
        record=told,
    )
