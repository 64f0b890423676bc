"""Quads by whole numbers on the arcs of a motorcycle graph."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from .. import _core
from .._core import ImposedField, SurfaceDomain
from ..errors import Cancelled, Error, GeometryError
from ..progress.phases import Progress
from .block_parts import block_chords, parts_of_blocks
from .blocks import BlockQuads, TMesh, WholeNumbers
from .options import QuadLayoutOptions
from .points.pattern import Pattern

Follow = Callable[[SurfaceDomain], np.ndarray]  # values of a cross field, as DirectionField.values
MENDED = ("no_integers", "no_quad_layout")  # kinds of errors that other singular points may mend
_TOLD = 3  # places


def quads_of_t_mesh(
    field: ImposedField,
    options: QuadLayoutOptions,
    edge_length: float,
    origins: np.ndarray | None,
    release_points: bool,
    follow: Follow | None,
    progress: Progress | None,
) -> tuple[ImposedField, BlockQuads]:
    """By whole numbers on the arcs of a motorcycle graph. origins: where the surface was cut open. release_points:
    singular points inside may move where bad quads are left. follow: a field that edges are drawn to. The field comes
    back turned on closed parts where that makes for few blocks."""
    field, graph = _graph(field, options, progress)
    size = {"quad_count": options.quads} if options.quads else {"edge_length": edge_length}
    made = _core.quantized_quads(
        graph,
        blocks=options.blocks,
        measure=options.measure,
        origins=origins,
        release_points=release_points,
        follow=None if follow is None else follow(graph.curves.domain),
        progress=progress,
        **size,
    )
    quads, blocks = np.asarray(made.mesh.quads), np.array(made.patches)
    chords = block_chords(quads, blocks, np.asarray(made.patch_chords))
    parts = parts_of_blocks(made.mesh, blocks, chords, graph.largest_mismatch, graph.curves.traced)
    whole = WholeNumbers(
        made.t_joints, made.deviation, made.bound, made.optimal, made.coarsest_blocks, made.fewest_blocks
    )
    return field, BlockQuads(made.mesh, blocks, chords, parts, whole, TMesh(graph, made, origins))


def turn_to(field: ImposedField, follow: Follow) -> None:
    """Parts without a boundary are turned as a whole to where they are nearest to the other field: nothing else fixes
    their angle."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    domain = field.field.domain
    edges, beside = np.asarray(domain.edges), np.asarray(domain.edge_triangles)
    size = len(domain.vertices)
    graph = coo_array((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(size, size))
    part = connected_components(graph, directed=False)[1][edges[:, 0]]
    closed = np.bincount(part, beside.min(axis=1) < 0) == 0
    if not closed.any():
        return
    values, areas = np.array(field.field.values), np.asarray(_core.triangle_areas(domain.mesh))
    apart = follow(domain) * values.conj() * np.where(beside >= 0, areas[beside], 0).sum(axis=1)
    sums = np.bincount(part, apart.real) + 1j * np.bincount(part, apart.imag)
    turns = np.where(closed, np.exp(1j * np.angle(sums)), 1)
    field.field.values = values * turns[part]


def _graph(
    field: ImposedField, options: QuadLayoutOptions, progress: Progress | None
) -> tuple[ImposedField, _core.QuadLayout]:
    """Where few blocks are wanted the field of closed parts is turned, if there are fewer T-joints then."""

    def graph_of(given: ImposedField) -> _core.QuadLayout:
        return _core.motorcycle_graph(
            given, end_tolerance=options.end_tolerance, max_length=options.max_length, progress=progress
        )

    graph = graph_of(field)
    if options.blocks != "few" or not _joints(graph):
        return field, graph
    try:
        turned = _core.turned_for_layout(
            field, end_tolerance=options.end_tolerance, max_length=options.max_length, progress=progress
        )
    except Cancelled:
        raise
    except Error:  # no short turn, or a field that was rotated
        return field, graph
    if np.array_equal(np.asarray(turned.field.values), np.asarray(field.field.values)):
        return field, graph
    other = graph_of(turned)
    return (turned, other) if _joints(other) < _joints(graph) else (field, graph)


def _joints(graph: _core.QuadLayout) -> int:
    return sum(vertex.kind == "t_joint" for vertex in graph.vertices)


def fitted_points(
    domain: SurfaceDomain,
    pattern: Pattern,
    origins: np.ndarray | None,
    inadmissible: str,
    options: QuadLayoutOptions,
    edge_length: float,
    error: GeometryError,
    progress: Progress | None,
) -> Pattern:
    """The pattern with points moved or pairs added, so that whole numbers fit, and a note that says so. error:
    raised, with what was tried, where that was not enough."""
    found = _core.fitted_pattern(
        domain,
        pattern.pattern,
        np.arange(len(domain.vertices), dtype=np.int32) if origins is None else origins,
        edge_length=edge_length,
        inadmissible=inadmissible,
        tolerance=options.tolerance,
        end_tolerance=options.end_tolerance,
        max_length=options.max_length,
        progress=progress,
    )
    if found.left > 0:
        rest = f"{found.left:g} quads missing on arcs" if math.isfinite(found.left) else "a face without quads"
        raise GeometryError(
            f"{error.args[0]}. Of {found.tried} other patterns of points tried in faces none fits, {len(found.changes)}"
            f" changes leave {rest}; give points (quad-layout --singularities), or take fewer features",
            error.kind,
            error.elements,
        ) from error
    return replace(pattern, pattern=found.pattern, notes=[*pattern.notes, _told(found)])


def _told(found: _core.FittedPattern) -> str:
    pairs = sum(change.added for change in found.changes)
    moved = len(found.changes) - pairs
    words = [f"{pairs} pair{'s' * (pairs > 1)} of valence 3 and 5 added"] * (pairs > 0)
    words += [f"{moved} moved"] * (moved > 0)
    places = [np.asarray(change.positions)[0] for change in found.changes[:_TOLD]]
    where = "; ".join(", ".join(f"{x:.4g}" for x in place) for place in places)
    return (
        f"singular points of the computed field changed, {' and '.join(words)}, at ({where})"
        f"{' and other places' if len(found.changes) > _TOLD else ''}: with those that were found, faces ask for"
        " numbers of quads that contradict one another, or have patches without four corners"
    )
