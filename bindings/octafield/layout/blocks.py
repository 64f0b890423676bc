"""Quads in blocks, whatever made them, and the layout they come from where there is one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import _core
from .._core import ImposedField, QuadLayout, QuadMesh, QuantizedQuads
from ..progress.phases import Progress
from .options import QuadLayoutOptions


@dataclass
class LayoutParts:
    """A layout as arrays. positions: (v, 3), kinds and indices_times_four: of its vertices. sides: (n, 3) polylines on
    the surface; side_ends: (s, 2) vertices, -1: none; side_chords: (s,); on_boundary: (s,) bool. points, first,
    corners: polygons that tile the surface, as of octafield.surface.PatchPolygons; polygon_patches: patch of each.
    largest_mismatch: of the lengths of opposite sides in quad coordinates, over their mean. separatrices: traced.
    chords: how many."""

    positions: np.ndarray
    kinds: list[str]
    indices_times_four: np.ndarray
    sides: list[np.ndarray]
    side_ends: np.ndarray
    side_chords: np.ndarray
    on_boundary: np.ndarray
    points: np.ndarray
    first: np.ndarray
    corners: np.ndarray
    polygon_patches: np.ndarray
    largest_mismatch: float
    separatrices: int
    chords: int


@dataclass
class WholeNumbers:
    """On the arcs of a T-mesh. t_joints: of the T-mesh. deviation: from the lengths wanted, over all arcs; bound: what
    it cannot be below; optimal: whether the two are the same. coarsest: the fewest blocks that whole numbers were found
    to make; fewest: that any layout of the faces could have."""

    t_joints: int
    deviation: float
    bound: float
    optimal: bool
    coarsest: int
    fewest: int


@dataclass
class TMesh:
    """That quads come from, with their whole numbers. origins: of the surface cut open."""

    graph: QuadLayout
    quads: QuantizedQuads
    origins: np.ndarray | None


@dataclass
class BlockQuads:
    """mesh: of quads. blocks: (q,) patch of each; chords: (q, 2) the chord across its first and its second pair of
    sides. layout: that it is the grid of; None: there is none of curves."""

    mesh: QuadMesh
    blocks: np.ndarray
    chords: np.ndarray
    layout: LayoutParts | None = None
    whole_numbers: WholeNumbers | None = None  # of the T-mesh that the quads come from
    t_mesh: TMesh | None = None


def quads_of_separatrices(
    field: ImposedField, options: QuadLayoutOptions, edge_length: float, progress: Progress | None
) -> tuple[ImposedField, BlockQuads]:
    """By the layout of all separatrices. The field comes back turned on closed parts of the surface."""
    end_tolerance, max_length = options.end_tolerance, options.max_length
    field = _core.turned_for_layout(field, end_tolerance=end_tolerance, max_length=max_length, progress=progress)
    layout = _core.quad_layout(field, end_tolerance=end_tolerance, max_length=max_length, progress=progress)
    if options.quads:
        made = _core.layout_quads(layout, quad_count=options.quads, progress=progress)
    else:
        made = _core.layout_quads(layout, edge_length=edge_length, progress=progress)
    sides = layout.sides
    of_patches = [[sides[loop[k, 0]].chord for k in (0, 1)] for loop in (patch.loops[0] for patch in layout.patches)]
    blocks = np.array(made.patches)
    chords = np.array(of_patches, np.int32).reshape(-1, 2)[blocks]
    return field, BlockQuads(made.mesh, blocks, chords, parts_of(layout))


def imposed_indices(field: ImposedField) -> dict[int, int]:
    """Of the vertices of the field's surface at singular points and corners, the index times four, not 0."""
    found = {corner.vertex: 2 - corner.quads for corner in field.pattern.corners}
    for vertex, point in zip(np.asarray(field.point_vertices).tolist(), field.pattern.points, strict=True):
        found[vertex] = point.index_times_four
    return {vertex: four for vertex, four in sorted(found.items()) if four}


def parts_of(layout: QuadLayout) -> LayoutParts:
    vertices, sides, polygons = layout.vertices, layout.sides, _core.patch_polygons(layout)
    return LayoutParts(
        positions=np.array([v.position for v in vertices]).reshape(-1, 3),
        kinds=[v.kind for v in vertices],
        indices_times_four=np.array([v.index_times_four for v in vertices], np.int32),
        sides=[np.array(side.points) for side in sides],
        side_ends=np.array([(side.first, side.last) for side in sides], np.int32).reshape(-1, 2),
        side_chords=np.array([side.chord for side in sides], np.int32),
        on_boundary=np.array([side.curve < 0 for side in sides], bool),
        points=np.array(polygons.points),
        first=np.array(polygons.first),
        corners=np.array(polygons.corners),
        polygon_patches=np.array(polygons.patches),
        largest_mismatch=layout.largest_mismatch,
        separatrices=layout.curves.traced,
        chords=len(layout.chords),
    )
