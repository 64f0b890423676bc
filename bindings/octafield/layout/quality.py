"""What quads on a surface are worth, found on their arrays and the surface's: nothing asks what made them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import _core
from .._core import QuadMesh, SurfaceDomain, TriangleMesh
from ..errors import GeometryError, SolverError
from ..meshes.figures import Spread, spread, surface_deviation

_ON_BOUNDARY = 1e-6  # of the diagonal
_FLAT = 1e-6  # scaled Jacobian: no more than that is none
_CHORD = 0.35  # of its length: how far its middle may be from the boundary


@dataclass
class QuadFigures:
    """scaled_jacobians: (q,). quads_round: (V,) per vertex; on_boundary: (V,) bool. deviation: largest and root mean
    square, over the diagonal. edges: lengths, input unit."""

    scaled_jacobians: np.ndarray
    jacobians: Spread
    angle_quality: Spread
    inverted: int
    nonconforming_edges: int
    t_junctions: int
    irregular_vertices: int
    irregular_boundary_vertices: int
    quads_round: np.ndarray
    on_boundary: np.ndarray
    deviation: tuple[float, float]
    edges: Spread


def require_sound(mesh: QuadMesh, figures: QuadFigures, euler_characteristic: int) -> None:
    """Raises where the quads are not fit for use: that is a defect of the program, not of the input."""
    _core.require_valid(mesh, closed=False)
    found = (
        ("inverted_quads", figures.inverted, "inverted quads"),
        ("nonconforming", figures.nonconforming_edges, "edges that do not match"),
        ("t_junctions", figures.t_junctions, "T-junctions"),
    )
    for kind, count, words in found:
        if count:
            raise SolverError(
                f"the quads have {count} {words}; ask for more quads, or give corners other numbers of quads",
                kind,
            )
    euler = len(mesh.vertices) - len(edges_of(np.asarray(mesh.quads))[0]) + len(mesh.quads)
    if euler != euler_characteristic:
        raise SolverError(
            f"the quads have the Euler characteristic {euler}, and the surface {euler_characteristic}",
            "other_topology",
        )


def require_apart(mesh: QuadMesh) -> list[str]:
    """A note where quads, cut along diagonals, cross one another. Raises GeometryError where all lie in one plane."""
    found = [d for d in _core.find_defects(_core.split_quads(mesh), closed=False) if d.kind == "self_intersection"]
    if not found:
        return []
    points = np.asarray(mesh.vertices)
    extents = np.sqrt(np.maximum(np.linalg.eigvalsh(np.cov(points.T)), 0))
    told = f"{len(found[0].elements)} triangles of the quads cut along diagonals cross one another"
    if extents[0] <= 1e-9 * extents[2]:
        raise GeometryError(f"{told}: quads are too large for the boundary; ask for more quads", "crossing_quads")
    return [f"{told}: more quads keep parts of the surface that are near one another apart"]


def figures_of(mesh: QuadMesh, domain: SurfaceDomain, given: TriangleMesh) -> QuadFigures:
    """domain: the surface that the quads are on, for its boundary. given: that they are compared with."""
    points, quads = np.asarray(mesh.vertices), np.asarray(mesh.quads)
    edges, count, same_sense = edges_of(quads)
    open_edges = edges[count == 1]
    stray = open_edges[~_at_boundary(points, open_edges, domain)]
    on_boundary, round_vertex = quads_round(quads, len(points))
    jacobians = np.asarray(_core.scaled_jacobians(mesh))
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    return QuadFigures(
        scaled_jacobians=jacobians,
        jacobians=spread(jacobians),
        angle_quality=spread(np.asarray(_core.quad_angle_quality(mesh))),
        inverted=int((~(jacobians > _FLAT)).sum()),
        nonconforming_edges=int((count > 2).sum()) + same_sense + len(stray),
        t_junctions=_t_junctions(stray),
        irregular_vertices=int((~on_boundary & (round_vertex != 4)).sum()),
        irregular_boundary_vertices=int((on_boundary & (round_vertex != 2)).sum()),
        quads_round=round_vertex,
        on_boundary=on_boundary,
        deviation=surface_deviation(points, np.zeros((0, 3), np.int32), quads, given),
        edges=spread(lengths),
    )


def quads_round(quads: np.ndarray, vertices: int) -> tuple[np.ndarray, np.ndarray]:
    """(vertices,) bool whether it is on an edge of one quad, and how many quads it has."""
    edges, count, _ = edges_of(quads)
    on_boundary = np.zeros(vertices, bool)
    on_boundary[edges[count == 1]] = True
    return on_boundary, np.bincount(quads.ravel(), minlength=vertices)


def edges_of(quads: np.ndarray) -> tuple[np.ndarray, np.ndarray, int]:
    """(e, 2) vertex ids, lower first; how many quads each has; how many two quads run in the same sense."""
    directed = np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)]).astype(np.int64)
    edges, group, count = np.unique(np.sort(directed, axis=1), axis=0, return_inverse=True, return_counts=True)
    upwards = np.bincount(group.reshape(-1), directed[:, 0] < directed[:, 1], minlength=len(edges))
    return edges, count, int(((count == 2) & (upwards != 1)).sum())


def _at_boundary(points: np.ndarray, open_edges: np.ndarray, domain: SurfaceDomain) -> np.ndarray:
    """(e,) bool: edges whose ends are on the boundary of the surface and their middles near to it: chords of arcs up
    to a third of the circle."""
    import pyvista

    rim = np.asarray(domain.edges)[np.asarray(domain.edge_triangles).min(axis=1) < 0]
    if not len(rim) or not len(open_edges):
        return np.zeros(len(open_edges), bool)
    vertices = np.array(domain.vertices)
    lines = pyvista.PolyData(vertices, lines=np.column_stack([np.full(len(rim), 2), rim]).ravel())
    ends = points[open_edges]
    places = np.concatenate([ends[:, 0], ends[:, 1], ends.mean(axis=1)])
    _, nearest = lines.find_closest_cell(places, return_closest_point=True)  # type: ignore[misc]
    first, second, middle = np.linalg.norm(nearest - places, axis=1).reshape(3, -1)
    near = _ON_BOUNDARY * np.linalg.norm(vertices.max(axis=0) - vertices.min(axis=0))
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    at: np.ndarray = (first <= near) & (second <= near) & (middle <= _CHORD * lengths)
    return at


def _t_junctions(stray: np.ndarray) -> int:
    """Edges with one quad inside of the surface close in rings; one of k edges, with quads of one long edge on either
    side, has k - 2 vertices that hang."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    if not len(stray):
        return 0
    ids, local = np.unique(stray, return_inverse=True)
    a, b = local.reshape(-1, 2).T
    rings = connected_components(coo_array((np.ones(len(a)), (a, b)), shape=(len(ids), len(ids))), directed=False)[0]
    return max(len(stray) - 2 * int(rings), 1)
