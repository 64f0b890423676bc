"""From a file to block-structured quads: read, singular points, field, layout, quads, figures.

result = compute_quad_layout("plate.obj", layout_options=QuadLayoutOptions(quads=500), singularities="points.json")
result.mesh             # octafield.surface.QuadMesh
result.record.patches   # the figures
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import ImposedField, QuadMesh, SurfaceDomain, TriangleMesh
from ..domain.inputs import naming
from ..domain.meshed_input import MeshedInput
from ..domain.meshing import Source
from ..errors import GeometryError, InvalidInput, SolverError
from ..options import SurfaceFieldOptions
from ..progress.phases import PeakMemory, PhaseClock, Progress, announce
from ..view.notebook import Facts, ShownInNotebooks
from .blocks import BlockQuads, LayoutParts, quads_of_separatrices
from .causes import cut_corners, told_of_points
from .options import MOST_QUADS, QuadLayoutOptions
from .points.free_axes import pattern_of_lines
from .points.pattern import Pattern, pattern_of
from .points.wanted import Corners, Points, PointsWanted, meshed_with_places, require_own_surface
from .quality import figures_of, require_sound
from .t_mesh import MENDED, fitted_points, quads_of_t_mesh

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
    from ..fields.record import of_input
    from ..progress.meter import PhaseMeter
    from . import record

    memory, clock = PeakMemory(), PhaseClock(meshed.clock)
    target = _edge_length(meshed.surface, wanted)
    with clock.phase("surface"):
        announce(progress, "surface")
        whole = SurfaceDomain(meshed.surface, meshed.features)
        domain, origins = _cut(whole, wanted, points.singularities)
        domain, pattern = _pattern(domain, wanted, points, progress)
    begun = of_input(meshed, clock, max(meshed.peak_mb, memory.megabytes()))
    begun = begun.changed(notes=[*begun.notes, *pattern.notes, *([] if origins is not None else _of_features(whole))])
    meter = PhaseMeter(begun, progress)
    inadmissible = wanted.inadmissible
    if inadmissible == "default":
        inadmissible = "move" if points.singularities is None else "fail"
    try:
        field, pattern, inadmissible = _imposed(domain, pattern, inadmissible, wanted, meter.report)
    except SolverError as error:
        blunted, notes = _blunted(whole) if origins is not None else (whole, [])
        if error.kind != "unresolved_turns" or not notes:
            raise
        domain, origins = _cut(blunted, wanted, points.singularities)
        domain, pattern = _pattern(domain, wanted, points, progress)
        begun = begun.changed(notes=[*begun.notes, *notes])
        field, pattern, inadmissible = _imposed(domain, pattern, inadmissible, wanted, meter.report)
    computed = pattern.source == "computed"
    made: BlockQuads
    with told_of_points(domain, pattern.pattern, wanted):
        if wanted.layout == "t-mesh":
            try:
                field, made = quads_of_t_mesh(field, wanted, target, origins, computed, meter.report)
            except GeometryError as error:
                if not computed or error.kind not in MENDED:
                    raise
                pattern = fitted_points(domain, pattern, origins, inadmissible, wanted, target, error, meter.report)
                begun = begun.changed(notes=[*begun.notes, pattern.notes[-1]])
                field, pattern, inadmissible = _imposed(domain, pattern, inadmissible, wanted, meter.report)
                field, made = quads_of_t_mesh(field, wanted, target, origins, computed, meter.report)
        else:
            field, made = quads_of_separatrices(field, wanted, target, meter.report)
    meter.begin("check")
    announce(progress, "check")
    figures = figures_of(made.mesh, whole, given)
    require_sound(made.mesh, figures, int(_core.euler_characteristic(meshed.surface)))
    begun = begun.changed(notes=[*begun.notes, *cut_corners(made.mesh, whole)])
    meter.end()
    told = record.of_quads(
        made, figures, field, pattern, begun, len(meshed.surface.triangles), target, inadmissible, meter,
        dict(vars(wanted)), points.options.recorded(),
    )  # fmt: skip
    return QuadLayoutResult(
        mesh=made.mesh,
        blocks=made.blocks,
        chords=made.chords,
        scaled_jacobians=figures.scaled_jacobians,
        valences=figures.quads_round,
        on_boundary=figures.on_boundary,
        layout=made.layout,
        field=field,
        record=told,
    )


def _pattern(
    domain: SurfaceDomain, wanted: QuadLayoutOptions, points: PointsWanted, progress: Progress | None
) -> tuple[SurfaceDomain, Pattern]:
    """And the domain, measured along free axes where these are wanted."""
    if wanted.axes == "free":
        return pattern_of_lines(domain, points, progress)
    return domain, pattern_of(domain, points, progress)


def _cut(
    whole: SurfaceDomain, wanted: QuadLayoutOptions, singularities: Points | None
) -> tuple[SurfaceDomain, np.ndarray | None]:
    """The surface for the field: cut open along features inside where these are to be followed, with the vertices of
    the whole surface. Points that are given are of the surface as a whole."""
    if wanted.layout != "t-mesh" or singularities is not None or not inner_features(whole):
        return whole, None
    cut = _core.cut_along_features(whole)
    return cut.domain, np.array(cut.origins)


def _blunted(whole: SurfaceDomain) -> tuple[SurfaceDomain, list[str]]:
    """With needles between features that end a triangle before their tips, and a note; none where there are none."""
    blunted, tips = _core.blunted_features(whole)
    if not len(tips):
        return whole, []
    at = ", ".join(f"{x:.4g}" for x in np.asarray(whole.vertices)[tips[0]])
    return blunted, [
        f"{len(tips)} feature edges are not followed up to where they meet another one at less than 10 degrees, the"
        f" first at ({at}), but to a triangle before: no cross field follows both on triangles of that size"
    ]


def _imposed(
    domain: SurfaceDomain,
    pattern: Pattern,
    inadmissible: str,
    wanted: QuadLayoutOptions,
    progress: Progress | None,
) -> tuple[ImposedField, Pattern, str]:
    """T-meshes take rotated fields: in faces where points of a computed field cannot be moved, the field is rotated."""
    may_rotate = wanted.inadmissible == "default" and inadmissible == "move" and wanted.layout == "t-mesh"

    def imposed(pattern: Pattern, way: str) -> tuple[ImposedField, Pattern, str]:
        field = _core.impose_singular_points(
            domain, pattern.pattern, inadmissible=way, tolerance=wanted.tolerance, progress=progress
        )
        return field, pattern, way

    try:
        return imposed(pattern, inadmissible)
    except SolverError as error:
        if not may_rotate:
            raise
        if error.kind == "move_failed":
            moved = _core.moved_by_faces(domain, pattern.pattern, tolerance=wanted.tolerance, progress=progress)
            pattern = replace(pattern, pattern=moved)
        return imposed(pattern, "rotate")


def _edge_length(surface: TriangleMesh, wanted: QuadLayoutOptions) -> float:
    """Of the quads, input unit. Refuses what would hardly end before any work."""
    area = float(np.asarray(_core.triangle_areas(surface)).sum())
    if wanted.quads:
        return float(np.sqrt(area / wanted.quads))
    length = wanted.edge_length or float(_core.mean_edge_length(surface))
    count = area / length**2
    if count > MOST_QUADS:
        raise InvalidInput(
            f"the edge length {length:g} asks for about {count:.2g} quads, and at most {MOST_QUADS:,} are made; give a"
            " larger edge length",
            "too_many_cells",
        )
    return length


def _of_features(domain: SurfaceDomain) -> list[str]:
    """A note where features inside the surface will not be followed."""
    count = inner_features(domain)
    if not count:
        return []
    return [
        f"{count} feature edges inside the surface are not followed: with points that are given, and by separatrices,"
        " layouts follow the boundary alone"
    ]


def inner_features(domain: SurfaceDomain) -> int:
    features = np.sort(np.asarray(domain.features.edges), axis=1).astype(np.int64)
    if not len(features):
        return 0
    rim = np.asarray(domain.edges)[np.asarray(domain.edge_triangles).min(axis=1) < 0].astype(np.int64)
    count = len(domain.vertices)
    inside = ~np.isin(features[:, 0] * count + features[:, 1], rim[:, 0] * count + rim[:, 1])
    return int(inside.sum())
