"""Why quads could not be made, where the points or options wanted are to blame: put into the message of the error."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from .. import _core
from .._core import ImposedPoint, QuadMesh, SingularPattern, SurfaceDomain
from ..errors import GeometryError, SolverError
from .options import QuadLayoutOptions
from .points.pattern import Rim

_BAD_QUADS = ("inverted_quads", "non_manifold_edge", "degenerate_face")
_SAME = 1e-6  # of the diagonal: a point that is at a vertex
_STRAIGHT = math.pi - 1e-6
_BENT = math.radians(30)  # a boundary that turns by more has a corner


@contextmanager
def told_of_points(domain: SurfaceDomain, pattern: SingularPattern, options: QuadLayoutOptions) -> Iterator[None]:
    """Errors about quads that are no quads name the points that leave one quad 180 degrees or more, and the option
    that asks for large quads; others pass as they are."""
    try:
        yield
    except (SolverError, GeometryError) as error:
        if error.kind == "folded_map":
            remedy = "; --triangle-length (edge_length of the field's options) gives shorter triangles"
            raise SolverError(f"{error}{remedy}", error.kind, error.elements) from error
        if error.kind not in _BAD_QUADS:
            raise
        wide = _wide_corners(domain, pattern)
        if wide:
            raise SolverError(
                f"{error.args[0]}: {', '.join(wide[:5])}{' and others' if len(wide) > 5 else ''}; corners of quads are"
                " below 180 degrees, so more quads must meet there",
                error.kind,
                error.elements,
            ) from error
        raise


def _wide_corners(domain: SurfaceDomain, pattern: SingularPattern) -> list[str]:
    """In words, points and corners where the angle of the surface leaves each quad 180 degrees or more."""
    points = np.asarray(domain.mesh.vertices)
    angles, rim = vertex_angles(points, np.asarray(domain.mesh.triangles)), Rim(domain)
    near = _SAME * float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))
    found = [(points[c.vertex], float(angles[c.vertex]), c.quads) for c in pattern.corners]
    found += [_at_point(domain, point, points, angles, rim, near) for point in pattern.points]
    return [
        f"{quads} quad{'s' if quads > 1 else ''} in the {math.degrees(angle):.4g} degrees at"
        f" ({', '.join(f'{x:.4g}' for x in at)})"
        for at, angle, quads in found
        if quads >= 1 and angle / quads >= _STRAIGHT
    ]


def cut_corners(mesh: QuadMesh, domain: SurfaceDomain) -> list[str]:
    """A note where corners of the boundary are no vertices of the quads: where two quads meet nothing holds one."""
    points = np.asarray(domain.mesh.vertices)
    rim = np.asarray(domain.edges)[np.asarray(domain.edge_triangles).min(axis=1) < 0]
    if not len(rim):
        return []
    sums, counts = np.zeros(points.shape), np.zeros(len(points), int)
    along = points[rim[:, 1]] - points[rim[:, 0]]
    along /= np.linalg.norm(along, axis=1)[:, None]
    for end, sense in ((0, 1), (1, -1)):
        np.add.at(sums, rim[:, end], sense * along)
        np.add.at(counts, rim[:, end], 1)
    # Unit vectors to both neighbours add up to 2 sin(turn / 2).
    angles = 2 * np.arcsin(np.clip(np.linalg.norm(sums, axis=1) / 2, 0, 1))
    corners = points[(counts == 2) & (angles > _BENT)]
    vertices = np.asarray(mesh.vertices)
    diagonal = float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))
    away = np.array([np.linalg.norm(vertices - corner, axis=1).min() for corner in corners]) / diagonal
    if not (away > _SAME).any():
        return []
    worst = ", ".join(f"{x:.4g}" for x in corners[away.argmax()])
    return [
        f"{int((away > _SAME).sum())} corners of the boundary are no vertices of the quads, the farthest by"
        f" {away.max():.2g} of the diagonal, at ({worst}): two quads meet there; another number of quads at the corner"
        " (quad-layout --corners), or more quads, follow it"
    ]


def _at_point(
    domain: SurfaceDomain, point: ImposedPoint, points: np.ndarray, angles: np.ndarray, rim: Rim, near: float
) -> tuple[np.ndarray, float, int]:
    at = np.asarray(_core.imposed_position(domain, point))
    distances = np.linalg.norm(points - at, axis=1)
    on_boundary = rim.distance(at) <= _SAME
    whole = math.pi if on_boundary else 2 * math.pi
    angle = float(angles[distances.argmin()]) if distances.min() <= near else whole
    return at, angle, (2 if on_boundary else 4) - point.index_times_four


def vertex_angles(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """(V,) the sum of the angles of the triangles at each vertex, radians."""
    sums = np.zeros(len(points))
    for k in range(3):
        a, b = (points[triangles[:, (k + i) % 3]] - points[triangles[:, k]] for i in (1, 2))
        np.add.at(
            sums,
            triangles[:, k],
            np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.einsum("ij,ij->i", a, b)),
        )
    return sums
