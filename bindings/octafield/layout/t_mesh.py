"""Quads by whole numbers on the arcs of a motorcycle graph."""

from __future__ import annotations

import numpy as np

from .. import _core
from .._core import ImposedField
from ..progress.phases import Progress
from .block_parts import block_chords, parts_of_blocks
from .blocks import BlockQuads
from .options import QuadLayoutOptions


def quads_of_t_mesh(
    field: ImposedField,
    options: QuadLayoutOptions,
    edge_length: float,
    origins: np.ndarray | None,
    progress: Progress | None,
) -> BlockQuads:
    """By whole numbers on the arcs of a motorcycle graph. origins: where the surface was cut open."""
    graph = _core.motorcycle_graph(
        field, end_tolerance=options.end_tolerance, max_length=options.max_length, progress=progress
    )
    size = {"quad_count": options.quads} if options.quads else {"edge_length": edge_length}
    made = _core.quantized_quads(graph, coarsest=options.coarsest, origins=origins, progress=progress, **size)
    quads, blocks = np.asarray(made.mesh.quads), np.array(made.patches)
    chords = block_chords(quads, blocks, np.asarray(made.patch_chords))
    parts = parts_of_blocks(made.mesh, blocks, chords, graph.largest_mismatch, graph.curves.traced)
    return BlockQuads(made.mesh, blocks, chords, parts, t_joints=made.t_joints, optimal=made.optimal)
