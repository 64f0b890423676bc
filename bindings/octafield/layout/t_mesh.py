"""Quads by whole numbers on the arcs of a motorcycle graph."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from .. import _core
from .._core import ImposedField, SurfaceDomain
from ..errors import GeometryError
from ..progress.phases import Progress
from .block_parts import block_chords, parts_of_blocks
from .blocks import BlockQuads
from .options import QuadLayoutOptions
from .points.pattern import Pattern

MENDED = ("no_integers", "no_quad_layout")  # kinds of errors that other singular points may mend
_TOLD = 3  # places


def quads_of_t_mesh(
    field: ImposedField,
    options: QuadLayoutOptions,
    edge_length: float,
    origins: np.ndarray | None,
    release_points: bool,
    progress: Progress | None,
) -> BlockQuads:
    """By whole numbers on the arcs of a motorcycle graph. origins: where the surface was cut open. release_points:
    singular points inside may move where bad quads are left."""
    graph = _core.motorcycle_graph(
        field, end_tolerance=options.end_tolerance, max_length=options.max_length, progress=progress
    )
    size = {"quad_count": options.quads} if options.quads else {"edge_length": edge_length}
    made = _core.quantized_quads(
        graph,
        coarsest=options.coarsest,
        origins=origins,
        release_points=release_points,
        progress=progress,
        **size,
    )
    quads, blocks = np.asarray(made.mesh.quads), np.array(made.patches)
    chords = block_chords(quads, blocks, np.asarray(made.patch_chords))
    parts = parts_of_blocks(made.mesh, blocks, chords, graph.largest_mismatch, graph.curves.traced)
    return BlockQuads(made.mesh, blocks, chords, parts, t_joints=made.t_joints, optimal=made.optimal)


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
            f" changes leave {rest}; give points (--singularities), or take fewer features",
            error.kind,
            error.elements,
        ) from error
    return replace(pattern, pattern=found.pattern, notes=[*pattern.notes, _told(found)])


def _told(found: _core.FittedPattern) -> str:
    pairs = sum(change.added for change in found.changes)
    gone = sum(change.removed for change in found.changes)
    moved = len(found.changes) - pairs - gone
    words = [f"{pairs} pair{'s' * (pairs > 1)} of valence 3 and 5 added"] * (pairs > 0)
    words += [f"{gone} pair{'s' * (gone > 1)} of points that cancel taken away"] * (gone > 0)
    words += [f"{moved} moved"] * (moved > 0)
    places = [np.asarray(change.positions)[0] for change in found.changes[:_TOLD]]
    where = "; ".join(", ".join(f"{x:.4g}" for x in place) for place in places)
    return (
        f"singular points of the computed field changed, {' and '.join(words)}, at ({where})"
        f"{' and other places' if len(found.changes) > _TOLD else ''}: with those that were found, faces ask for"
        " numbers of quads that contradict one another, or have patches without four corners"
    )
