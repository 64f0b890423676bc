"""Transitions across half-faces and valences of edges as AlgoHex keeps them. Conventions and their sources:
docs/formats.md."""

from collections.abc import Sequence

import numpy as np

from .. import _core
from ..domain.rotations import axes_of
from ..meshes.openvolumemesh.mesh import OvmMesh
from .base import Field

TRANSITIONS, VALENCES, CUT = ("halfface", "HalffaceTransiton"), ("edge", "edge_valance"), ("face", "octafield::cut")
COMPLEX, UNDETERMINED = np.iinfo(np.int32).max, np.iinfo(np.int32).min  # of edge_valance
_NEAR = 1e-6  # radians


def owners(mesh: OvmMesh) -> np.ndarray:
    """Cell of each half-face, -1: none."""
    result = np.full(mesh.count("halfface"), -1)
    result[mesh.cells.ravel()] = np.repeat(np.arange(len(mesh.cells)), 4)
    return result


def inner_faces(mesh: OvmMesh) -> np.ndarray:
    """With a cell on both sides; of ovm_of_tets in the order of their vertices, as those of FaceMatchings are."""
    return np.flatnonzero((owners(mesh).reshape(-1, 2) >= 0).all(axis=1))


def transitions_of(mesh: OvmMesh, faces: _core.FaceMatchings) -> np.ndarray:
    """(2f,) t with q t close to the frame beyond, q that of the half-face's own cell; -1 on the boundary. faces: of the
    same tets."""
    own, inner = owners(mesh), inner_faces(mesh)
    half_face = 2 * inner + (own[2 * inner] != np.asarray(faces.tets)[:, 0])
    result = np.full(len(own), -1, np.int32)
    result[half_face] = faces.matching
    result[half_face ^ 1] = np.asarray(_core.octahedral_inverse_table())[faces.matching]
    return result


def far_transitions(mesh: OvmMesh, frames: np.ndarray) -> list[str]:
    """A note where a file's transitions lead to another than the closest axes: octafield goes by the frames."""
    found, own = mesh.properties.get(TRANSITIONS), owners(mesh)
    if found is None or found.ndim != 1:
        return []
    here = np.flatnonzero((own >= 0) & (own[np.arange(len(own)) ^ 1] >= 0) & (found >= 0) & (found < 24))
    q, beyond = frames[own[here]], frames[own[here ^ 1]]
    turned = np.swapaxes(axes_of(q) @ axes_of(np.asarray(_core.octahedral_group()))[found[here]], 1, 2) @ axes_of(
        beyond
    )
    angle = np.arccos(np.clip((np.trace(turned, axis1=1, axis2=2) - 1) / 2, -1, 1))
    far = int((angle > np.asarray(_core.distance(q, beyond)).reshape(-1) + _NEAR).sum())
    return (
        [f"{TRANSITIONS[1]} does not lead to the closest axes at {far} half-faces; octafield goes by the frames alone"]
        if far
        else []
    )


def valences_of(
    mesh: OvmMesh, field: Field, transitions: np.ndarray, singular: Sequence[_core.SingularEdge]
) -> np.ndarray:
    """(e,) hexahedra at each edge less 4, on the boundary less 2. singular: edges inside with a turn."""
    result = np.zeros(len(mesh.edges), np.int32)
    count = len(mesh.vertices)
    ends = np.array([(e.a, e.b) for e in singular], np.int64).reshape(-1, 2)
    place = np.searchsorted(mesh.edges[:, 0] * count + mesh.edges[:, 1], ends[:, 0] * count + ends[:, 1])
    hexahedra = np.array([e.valence for e in singular], np.int64)
    complex_or_across = np.where([e.quarter_turns == 0 for e in singular], COMPLEX, UNDETERMINED)
    result[place] = np.where(hexahedra < 0, complex_or_across, hexahedra - 4)
    edges, values = _boundary_valences(mesh, axes_of(field.frames), transitions)
    result[edges] = values
    return result


def _boundary_valences(mesh: OvmMesh, axes: np.ndarray, transitions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of the edges of the boundary: the axes nearest to the two normals, the second carried back through the tets
    between, tell the quarter turns between them."""
    own = owners(mesh)
    starts = np.flatnonzero((own >= 0) & (own[np.arange(len(own)) ^ 1] < 0))
    half_edges = _half_edges(mesh, starts)
    row, column = np.nonzero(half_edges % 2 == 0)  # the wedge from there runs right-handed round the edge
    start, edge = starts[row], half_edges[row, column] // 2
    stop, product = _across_wedges(mesh, own, transitions, start, edge)
    first, last = _nearest_axes(mesh, axes, own, start), _nearest_axes(mesh, axes, own, stop)
    matrices = np.rint(axes_of(np.asarray(_core.octahedral_group()))).astype(int)
    last = np.einsum("nij,ni->nj", matrices[product], last)  # the inverse
    turn = np.cross(first, last)
    direction = mesh.vertices[mesh.edges[edge, 1]] - mesh.vertices[mesh.edges[edge, 0]]
    side = np.einsum("nij,nj,ni->n", axes[own[start]], turn, direction)
    bend = np.einsum("ni,ni->n", np.cross(_outward(mesh, start), _outward(mesh, stop)), direction)
    quarter = np.where(side == 0, UNDETERMINED, np.sign(side).astype(int))
    half = np.where(bend < 0, -2, 2)  # convex: nothing is left; reflex: all round
    dot = (first * last).sum(axis=1)
    return edge, np.where(dot == 1, 0, np.where(dot == -1, half, quarter))


def _half_edges(mesh: OvmMesh, half_faces: np.ndarray) -> np.ndarray:
    """(n, 3) of each half-face, which runs against its face where its id is odd."""
    half_edges: np.ndarray = mesh.faces[half_faces // 2] ^ (half_faces % 2)[:, None]
    return half_edges


def _across_wedges(
    mesh: OvmMesh, own: np.ndarray, transitions: np.ndarray, start: np.ndarray, edge: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """From half-faces on the boundary round edges to the next half-face on it: that one, and the product of the
    transitions into each tet on the way: an axis a of the first tet's frame is product a in the last's."""
    table, sides = np.asarray(_core.octahedral_product_table()), mesh.faces // 2
    here, product = start.copy(), np.zeros(len(start), int)
    going = np.arange(len(start))
    while len(going):
        cells = mesh.cells[own[here[going]]]
        others = (sides[cells // 2] == edge[going, None, None]).any(axis=2) & (cells != here[going, None])
        beyond = np.take_along_axis(cells, others.argmax(axis=1)[:, None], axis=1)[:, 0]
        inside = own[beyond ^ 1] >= 0
        here[going] = np.where(inside, beyond ^ 1, beyond)
        going = going[inside]
        product[going] = table[transitions[here[going]], product[going]]
    return here, product


def _outward(mesh: OvmMesh, half_faces: np.ndarray) -> np.ndarray:
    """(n, 3) normals of any length; those of half-faces point into their cells."""
    a, b, c = np.swapaxes(mesh.vertices[mesh.triangles()[half_faces // 2]], 0, 1)
    return np.cross(b - a, c - a) * np.where(half_faces % 2 == 0, -1, 1)[:, None]


def _nearest_axes(mesh: OvmMesh, axes: np.ndarray, own: np.ndarray, half_faces: np.ndarray) -> np.ndarray:
    """(n, 3) of the cell's frame, nearest to the outward normal: a signed unit vector."""
    along = np.einsum("nij,ni->nj", axes[own[half_faces]], _outward(mesh, half_faces))
    best = np.abs(along).argmax(axis=1)
    result = np.zeros((len(best), 3), int)
    result[np.arange(len(best)), best] = np.where(along[np.arange(len(best)), best] < 0, -1, 1)
    return result
