"""Quads that keep a boundary segment by segment, with their figures.

result = compute_fixed_boundary_quads([[(0, 0), (1, 0), (1, 1), (0, 1)]], edge_length=0.25, spacing="resample")
result.mesh                    # octafield.surface.QuadMesh
result.figures.angle           # smallest and largest, degrees
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Literal, get_args

import numpy as np

from .. import _core
from .._core import FixedBoundaryOptions, FixedBoundaryQuads, PlanarOutline, QuadMesh
from ..errors import InvalidInput
from ..layout.quality import edges_of, quads_round
from ..meshes.figures import Spread, spread
from ..progress.phases import Progress
from .outline import lengths_of, planar_outline, require_spacing, resampled_outline
from .read import Outline, as_outline

Spacing = Literal["require", "accept", "resample"]
_DEFAULTS = FixedBoundaryOptions()


@dataclass(repr=False)
class FixedBoundaryFigures:
    """irregular_vertices: how many inside by how many quads they have, other than four. angle: smallest and largest of
    all corners, degrees. sharpest: the smallest angle inside between two segments next to each other, degrees, above
    which no smallest angle can be. boundary_segments: of the outline, lines with them; kept of them as one edge."""

    quads: int
    interior_quads: int
    irregular_vertices: dict[int, int]
    angle: tuple[float, float]
    sharpest: float
    scaled_jacobian: Spread
    inverted: int
    nonconforming_edges: int
    boundary_segments: int
    kept_segments: int
    split_segments: int

    def __repr__(self) -> str:
        low, high = self.angle
        return f"FixedBoundaryFigures({self.quads} quads, angles {low:.1f} to {high:.1f} degrees)"

    def as_dict(self) -> dict[str, Any]:
        return asdict(self)


@dataclass(repr=False, kw_only=True)
class FixedBoundaryResult:
    """mesh: in the plane z = 0, the outline's points first. outline: that was kept. made: which edges and quads are of
    the loops, the lines and the mesh inside. figures: of the mesh."""

    mesh: QuadMesh
    outline: PlanarOutline
    made: FixedBoundaryQuads
    figures: FixedBoundaryFigures

    def __repr__(self) -> str:
        low, high = self.figures.angle
        return f"FixedBoundaryResult({self.figures.quads} quads, angles {low:.1f} to {high:.1f} degrees)"


def compute_fixed_boundary_quads(
    outline: Outline,
    lines: Any = (),
    *,
    edge_length: float = _DEFAULTS.edge_length,
    interior: QuadMesh | None = None,
    rotation: float = _DEFAULTS.rotation,
    offset: tuple[float, float] = (_DEFAULTS.offset_x, _DEFAULTS.offset_y),
    clearance: float = _DEFAULTS.clearance,
    odd_loops: str = _DEFAULTS.odd_loops,
    rounds: int = _DEFAULTS.rounds,
    spacing: Spacing = "require",
    progress: Progress | None = None,
) -> FixedBoundaryResult:
    """Quads of a plane region with every segment of its boundary and of its lines as an edge.

    outline: a PlanarOutline, a list of loops ((n, 2) points each), a GeoJSON-like dictionary or a file (read_outline).
    lines: more lines inside, (n, 2) points each, where loops are given. interior: quads of one's own in the plane
    z = 0, taken as far as they keep the clearance; None: squares. spacing: segments from half to twice the edge length
    are required (where squares are inside), accepted whatever they are, or made first (resampled_outline). The other
    options are those of octafield.surface.fixed_boundary_quads; edge_length 0: the mean segment of the loops.

    Raises as octafield.surface.fixed_boundary_quads and planar_outline, and GeometryError (kind segment_length).
    """
    if spacing not in get_args(Spacing):
        raise InvalidInput(f"spacing is one of {', '.join(get_args(Spacing))}, not {spacing!r}", "bad_option")
    if not 0 <= edge_length < np.inf:
        raise InvalidInput(f"the edge length is a number >= 0, not {edge_length}", "bad_option")
    given = list(lines)
    if given and not isinstance(outline, (list, tuple)):
        raise InvalidInput("lines are given beside loops; otherwise as those of the outline", "bad_option")
    region = planar_outline(outline, given) if given else as_outline(outline, edge_length, progress)  # type: ignore[arg-type]
    _core.require_planar(region)
    length = edge_length or float(lengths_of(region)[: len(region.loops)].mean())
    if spacing == "resample":
        region = resampled_outline(region, length)
    elif spacing == "require" and interior is None:
        require_spacing(region, length)
    made = _core.fixed_boundary_quads(
        region,
        interior,
        edge_length=length,
        rotation=rotation,
        offset_x=offset[0],
        offset_y=offset[1],
        clearance=clearance,
        odd_loops=odd_loops,
        rounds=rounds,
        progress=progress,
    )
    return FixedBoundaryResult(mesh=made.mesh, outline=region, made=made, figures=figures_of(made, region))


def figures_of(made: FixedBoundaryQuads, outline: PlanarOutline) -> FixedBoundaryFigures:
    points, quads = np.asarray(made.mesh.vertices)[:, :2], np.asarray(made.mesh.quads)
    edges, count, same_sense = edges_of(quads)
    on_boundary, valence = quads_round(quads, len(points))
    on_boundary[np.asarray(made.lines)] = True  # regular or not is a matter of angles there
    inside = valence[~on_boundary]
    segments = np.sort(np.concatenate([np.asarray(outline.loops), np.asarray(outline.lines)]), axis=1)
    loops = np.sort(np.asarray(made.boundary), axis=1)
    open_edges = {tuple(edge) for edge in edges[count == 1].tolist()}
    known = {tuple(edge) for edge in edges.tolist()}
    corners = corner_angles(points, quads)
    jacobians = np.asarray(_core.scaled_jacobians(made.mesh))
    stray = len(open_edges ^ {tuple(edge) for edge in loops.tolist()})
    return FixedBoundaryFigures(
        quads=len(quads),
        interior_quads=len(made.interior),
        irregular_vertices={int(v): int((inside == v).sum()) for v in np.unique(inside) if v != 4},
        angle=(float(corners.min()), float(corners.max())),
        sharpest=float(np.bincount(quads.ravel(), corners.ravel(), len(points))[on_boundary].min()),
        scaled_jacobian=spread(jacobians),
        inverted=int(((corners <= 0) | (corners >= 180)).any(axis=1).sum()),
        nonconforming_edges=int((count > 2).sum()) + same_sense + stray,
        boundary_segments=len(segments),
        kept_segments=sum(tuple(segment) in known for segment in segments.tolist()),
        split_segments=len(made.split),
    )


def corner_angles(points: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """(q, 4) of counter-clockwise quads, degrees in [0, 360)."""
    corners = points[quads]
    out, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    cross = out[..., 0] * back[..., 1] - out[..., 1] * back[..., 0]
    angles: np.ndarray = np.degrees(np.arctan2(cross, (out * back).sum(axis=-1))) % 360
    return angles
