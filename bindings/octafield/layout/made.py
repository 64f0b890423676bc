"""Quads on a surface that is ready for fields: singular points, imposed field, layout, quads, and their check."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import ImposedField, ImposedPoint, SurfaceDomain, TriangleMesh
from ..domain.meshed_input import MeshedInput
from ..errors import GeometryError, InvalidInput, SolverError
from ..progress.phases import PeakMemory, PhaseClock, Progress, announce
from .blocks import BlockQuads, quads_of_separatrices
from .causes import cut_corners, told_of_points
from .options import MOST_QUADS, QuadLayoutOptions
from .points.free_axes import pattern_of_lines
from .points.pattern import Pattern, pattern_of
from .points.wanted import Points, PointsWanted
from .quality import QuadFigures, figures_of, require_apart, require_sound
from .t_mesh import MENDED, Follow, fitted_points, quads_of_t_mesh, turn_to

if TYPE_CHECKING:
    from ..progress.meter import PhaseMeter
    from ..records.field import InputRecord

Measure = Callable[[SurfaceDomain], SurfaceDomain]


@dataclass
class QuadsMade:
    """whole: the surface with its features; quads: what was made on it; figures: what they are worth. target: their
    edge length, input unit. begun: what every record begins with; meter: of the phases so far."""

    whole: SurfaceDomain
    field: ImposedField
    pattern: Pattern
    quads: BlockQuads
    figures: QuadFigures
    target: float
    inadmissible: str
    begun: InputRecord
    meter: PhaseMeter


def quads_on(
    meshed: MeshedInput,
    given: TriangleMesh,
    points: PointsWanted,
    wanted: QuadLayoutOptions,
    progress: Progress | None,
    measure: Measure | None = None,
    follow: Follow | None = None,
) -> QuadsMade:
    """given: what the quads are compared with. measure: of the surface, cut open along features where these are
    followed, the same by other edge lengths; the quads are as long as one another in these. follow: a cross field that
    edges of quads are drawn to, by lengths."""
    from ..fields.record import of_input
    from ..progress.meter import PhaseMeter

    memory, clock = PeakMemory(), PhaseClock(meshed.clock)
    target = _edge_length(meshed.surface, wanted)
    with clock.phase("surface"):
        announce(progress, "surface")
        whole = SurfaceDomain(meshed.surface, meshed.features)
        domain, origins = _cut(whole, wanted, points.singularities, measure)
        domain, pattern = _pattern(domain, wanted, points, progress)
    begun = of_input(meshed, clock, max(meshed.peak_mb, memory.megabytes()))
    begun = begun.changed(notes=[*begun.notes, *pattern.notes, *([] if origins is not None else _of_features(whole))])
    meter = PhaseMeter(begun, progress)
    inadmissible = wanted.inadmissible
    if inadmissible == "default":
        inadmissible = "move" if points.singularities is None else "fail"

    def imposed() -> tuple[ImposedField, Pattern, str]:
        made, changed, way = _imposed(domain, pattern, inadmissible, wanted, meter.report)
        if follow is not None:
            turn_to(made, follow)
        return made, changed, way

    try:
        field, pattern, inadmissible = imposed()
    except SolverError as error:
        blunted, notes = _blunted(whole) if origins is not None else (whole, [])
        if error.kind != "unresolved_turns":
            raise
        if not notes:
            remedy = "; --triangle-length (edge_length of the field's options) gives shorter triangles"
            raise SolverError(f"{error.args[0]}{remedy}", error.kind, error.elements) from error
        domain, origins = _cut(blunted, wanted, points.singularities, measure)
        domain, pattern = _pattern(domain, wanted, points, progress)
        begun = begun.changed(notes=[*begun.notes, *notes])
        field, pattern, inadmissible = imposed()
    computed = points.singularities is None
    made: BlockQuads
    with told_of_points(domain, pattern.pattern, wanted):
        if wanted.layout == "t-mesh":
            try:
                field, made = quads_of_t_mesh(field, wanted, target, origins, computed, follow, meter.report)
            except GeometryError as error:
                if not computed or error.kind not in MENDED:
                    raise
                pattern = fitted_points(domain, pattern, origins, inadmissible, wanted, target, error, meter.report)
                begun = begun.changed(notes=[*begun.notes, pattern.notes[-1]])
                field, pattern, inadmissible = imposed()
                field, made = quads_of_t_mesh(field, wanted, target, origins, computed, follow, meter.report)
        else:
            field, made = quads_of_separatrices(field, wanted, target, meter.report)
    meter.begin("check")
    announce(progress, "check")
    figures = figures_of(made.mesh, whole, given)
    require_sound(made.mesh, figures, int(_core.euler_characteristic(meshed.surface)))
    begun = begun.changed(notes=[*begun.notes, *cut_corners(made.mesh, whole), *require_apart(made.mesh)])
    meter.end()
    return QuadsMade(whole, field, pattern, made, figures, target, inadmissible, begun, meter)


def _pattern(
    domain: SurfaceDomain, wanted: QuadLayoutOptions, points: PointsWanted, progress: Progress | None
) -> tuple[SurfaceDomain, Pattern]:
    """And the domain, measured along free axes where these are wanted."""
    if wanted.axes == "free":
        return pattern_of_lines(domain, points, progress)
    return domain, pattern_of(domain, points, progress)


def _cut(
    whole: SurfaceDomain, wanted: QuadLayoutOptions, singularities: Points | None, measure: Measure | None
) -> tuple[SurfaceDomain, np.ndarray | None]:
    """The surface for the field: cut open along features inside where these are to be followed, with the vertices of
    the whole surface. Points that are given are of the surface as a whole."""
    if wanted.layout != "t-mesh" or singularities is not None or not inner_features(whole):
        return (whole if measure is None else measure(whole)), None
    cut = _core.cut_along_features(whole)
    return (cut.domain if measure is None else measure(cut.domain)), np.array(cut.origins)


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
    """T-meshes take rotated fields: in faces where points of a computed field cannot be moved, the field is rotated.
    Points move face by face: on the whole surface at once each step takes as long, and one face can stop all."""
    may_rotate = wanted.inadmissible == "default" and inadmissible == "move" and wanted.layout == "t-mesh"

    def imposed(pattern: Pattern, way: str) -> tuple[ImposedField, Pattern, str]:
        field = _core.impose_singular_points(
            domain, pattern.pattern, inadmissible=way, tolerance=wanted.tolerance, progress=progress
        )
        return field, pattern, way

    if not may_rotate:
        return imposed(pattern, inadmissible)
    field, _, _ = imposed(pattern, "rotate")
    if _admissible(field, wanted):
        return field, pattern, inadmissible
    before = field.pattern.points
    moved = _core.moved_by_faces(domain, pattern.pattern, tolerance=wanted.tolerance, progress=progress)
    field, pattern, _ = imposed(replace(pattern, pattern=moved), "rotate")
    field.largest_move = _largest_move(domain, before, moved.points)
    return field, pattern, inadmissible if _admissible(field, wanted) else "rotate"


def _admissible(field: ImposedField, wanted: QuadLayoutOptions) -> bool:
    return all(abs(condition.angle) <= wanted.tolerance for condition in field.conditions)


def _largest_move(domain: SurfaceDomain, before: Sequence[ImposedPoint], after: Sequence[ImposedPoint]) -> float:
    """In a straight line. after: face by face, in the order of their lowest triangles."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    edges, size = np.asarray(domain.edges), len(domain.vertices)
    graph = coo_array((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(size, size))
    part = connected_components(graph, directed=False)[1][np.asarray(domain.mesh.triangles)[:, 0]]
    _, lowest, face = np.unique(part, return_index=True, return_inverse=True)
    order = np.argsort([lowest[face[point.triangle]] for point in before], kind="stable")
    ways = [
        np.subtract(_core.imposed_position(domain, before[i]), _core.imposed_position(domain, point))
        for i, point in zip(order, after, strict=True)
    ]
    return float(np.linalg.norm(ways, axis=1).max()) if ways else 0.0


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
