"""Plane regions by their outline: as surfaces, and with every segment of the outline kept."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from .. import _core
from .._core import PlanarOutline, QuadMesh, SurfaceDomain, TriangleMesh
from ..domain.inputs import Input, from_mesh, read_input
from ..errors import InvalidInput, SolverError
from ..files.reading import plain_name
from ..hexdom.sizes import SizeAt
from ..layout.quality import require_apart
from ..planar.quads import FixedBoundaryFigures, compute_fixed_boundary_quads
from ..planar.read import as_outline
from ..progress.phases import Progress

_SUFFIXES = (".geojson", ".json", ".poly", ".geo")
_FLAT = 1e-9  # of the diagonal
_MOST = 200_000  # triangles of the rectangle
_ROOM = 0.1  # of the diagonal: round the outline, for the field


def is_outline(source: object) -> bool:
    if isinstance(source, (str, Path)):
        return Path(plain_name(Path(source))).suffix.lower() in _SUFFIXES
    return isinstance(source, (PlanarOutline, Mapping, list, tuple))


def input_of_outline(source: Any, progress: Progress | None = None) -> Input:
    """The region as triangles, lines as features."""
    return _input_of(as_outline(source, progress=progress), source)


def _input_of(outline: PlanarOutline, source: Any) -> Input:
    name = str(source) if isinstance(source, (str, Path)) else "outline in memory"
    lines = np.asarray(outline.lines)
    return Input(name, _core.outline_triangles(outline), lines=lines if len(lines) else None, creases=bool(len(lines)))


def outline_of(source: Any, progress: Progress | None) -> tuple[PlanarOutline, float, Input]:
    """Of an outline, or of a flat surface in a plane z = const by its boundary; that z; and the region as a surface."""
    if is_outline(source):
        outline = as_outline(source, progress=progress)
        return outline, 0.0, _input_of(outline, source)
    if isinstance(source, SurfaceDomain):
        found = from_mesh(source.mesh)
    elif isinstance(source, TriangleMesh):
        found = from_mesh(source)
    else:
        found = read_input(source, interfaces=False, edge_length=0.0, progress=progress)
    points, domain = np.asarray(found.surface.vertices), SurfaceDomain(found.surface)
    if found.tets is not None or np.ptp(points[:, 2]) > _FLAT * np.linalg.norm(np.ptp(points, axis=0)):
        raise InvalidInput(
            f"{found.name}: a boundary is kept segment by segment in a plane z = const only; leave keep_boundary"
            " (--keep-boundary) out: features and the boundary are followed without it, too",
            "not_plane",
        )
    rim = np.asarray(domain.edges)[np.asarray(domain.edge_triangles).min(axis=1) < 0]
    used, ids = np.unique(rim, return_inverse=True)
    outline = PlanarOutline(points[used, :2], ids.reshape(-1, 2).astype(np.int32), np.zeros((0, 2), np.int32))
    _core.require_planar(outline)
    return outline, float(points[0, 2]), found


def mean_segment(outline: PlanarOutline) -> float:
    ends = np.asarray(outline.points)[np.asarray(outline.loops)]
    return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).mean())


def box_round(outline: PlanarOutline, height: float, triangle_length: float) -> TriangleMesh:
    """A rectangle at z = height round the outline in triangles of about that edge: squares, cut along alternating
    diagonals."""
    points = np.asarray(outline.points)
    low, high = points.min(axis=0), points.max(axis=0)
    room = _ROOM * np.linalg.norm(high - low)
    low, high = low - room, high + room
    count = np.maximum(np.ceil((high - low) / triangle_length).astype(int), 1)
    x, y = (np.linspace(low[k], high[k], count[k] + 1) for k in range(2))
    vertices = np.column_stack([np.tile(x, len(y)), np.repeat(y, len(x)), np.full(len(x) * len(y), height)])
    i, j = (part.ravel() for part in np.meshgrid(np.arange(count[0]), np.arange(count[1])))
    a = j * len(x) + i
    b, c, d = a + 1, a + 1 + len(x), a + len(x)
    odd = ((i + j) % 2 == 1)[:, None]
    first = np.where(odd, np.column_stack([a, b, d]), np.column_stack([a, b, c]))
    second = np.where(odd, np.column_stack([b, c, d]), np.column_stack([a, c, d]))
    return TriangleMesh(vertices, np.concatenate([first, second]))


def kept(
    outline: PlanarOutline, height: float, inside: QuadMesh, progress: Progress | None
) -> tuple[QuadMesh, FixedBoundaryFigures]:
    """inside: quads at z = height that cover the region. A segment is split where there is an odd number round a
    region. Raises SolverError where the quads are not sound: a defect of the program."""
    made = compute_fixed_boundary_quads(
        outline, interior=_at_height(inside, 0.0), spacing="accept", odd_loops="split_one", progress=progress
    )
    for kind, count in (("inverted_quads", made.figures.inverted), ("nonconforming", made.figures.nonconforming_edges)):
        if count:
            raise SolverError(f"the quads have {count} defects; take another edge length", kind)
    require_apart(made.mesh)
    return _at_height(made.mesh, height), made.figures


def _at_height(mesh: QuadMesh, z: float) -> QuadMesh:
    points = np.array(mesh.vertices)
    points[:, 2] = z
    return QuadMesh(points, quads=np.asarray(mesh.quads))


def triangle_length(outline: PlanarOutline, height: float, sizes: SizeAt) -> float:
    """For the rectangle: twice the least size at the outline, in no more than _MOST triangles and 40 to its diagonal at
    least."""
    points = np.asarray(outline.points)
    extent = np.ptp(points, axis=0) * (1 + 2 * _ROOM)
    least = float(sizes(np.column_stack([points, np.full(len(points), height)])).min())
    return max(min(2 * least, float(np.linalg.norm(extent)) / 40), float(np.sqrt(2 * extent.prod() / _MOST)))
