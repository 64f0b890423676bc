"""A mesh as OpenVolumeMesh has it: edges, faces of half-edges, cells of half-faces, and properties."""

from dataclasses import dataclass, field

import numpy as np

from ...errors import InvalidInput
from ..topology import TRIANGLES_OF_TET, unique_edges, unique_triangles

ENTITIES = ("vertex", "edge", "face", "cell", "halfedge", "halfface", "mesh")  # in the order of their binary codes


@dataclass
class OvmMesh:
    """vertices: (n, 3). edges: (e, 2). faces: (f, 3) half-edges. cells: (m, 4) half-faces; half-edge 2e runs along edge
    e, 2e + 1 back, half-faces likewise. properties: arrays, one row per element, by entity and name. kinds: binary type
    of a property, where it is not that of its array. skipped: properties of types that are not read."""

    vertices: np.ndarray
    edges: np.ndarray
    faces: np.ndarray
    cells: np.ndarray
    properties: dict[tuple[str, str], np.ndarray] = field(default_factory=dict)
    kinds: dict[tuple[str, str], str] = field(default_factory=dict)
    skipped: list[str] = field(default_factory=list)

    def count(self, entity: str) -> int:
        vertices, edges, faces, cells = (len(part) for part in (self.vertices, self.edges, self.faces, self.cells))
        return [vertices, edges, faces, cells, 2 * edges, 2 * faces, 1][ENTITIES.index(entity)]

    def triangles(self) -> np.ndarray:
        """(f, 3) vertices of each face, in its order: where its half-edges begin."""
        starts: np.ndarray = self.edges[self.faces // 2, self.faces % 2]
        return starts


def ovm_of_tets(vertices: np.ndarray, tets: np.ndarray) -> OvmMesh:
    """Half-faces of a cell have normals into the cell, as OpenVolumeMesh has them for tets of positive volume. Faces
    begin at their lowest vertex and half-faces of a cell ascend, so that the order of a tet's vertices, which files do
    not keep, makes no difference."""
    tets = np.asarray(tets).astype(np.int64)
    edges = unique_edges(tets)
    outward, of_tet = unique_triangles(tets)
    faces = _from_lowest(outward[:, [0, 2, 1]])  # into the first tet that has it
    count = len(vertices)
    start, end = faces, np.roll(faces, -1, axis=1)
    edge = np.searchsorted(edges[:, 0] * count + edges[:, 1], np.minimum(start, end) * count + np.maximum(start, end))
    half_edges = 2 * edge + (start > end)
    inward = tets[:, TRIANGLES_OF_TET][:, :, [0, 2, 1]]
    reversed_ = (_from_lowest(inward.reshape(-1, 3)) != _from_lowest(faces[of_tet.ravel()])).any(axis=1)
    half_faces = 2 * of_tet + reversed_.reshape(-1, 4)
    return OvmMesh(np.asarray(vertices, float), edges, half_edges, np.sort(half_faces, axis=1))


def _from_lowest(triangles: np.ndarray) -> np.ndarray:
    """The same cyclic order, lowest id first."""
    turn = (triangles.argmin(axis=1)[:, None] + np.arange(3)) % 3
    return np.take_along_axis(triangles, turn, axis=1)


def tets_of_ovm(mesh: OvmMesh, name: str) -> np.ndarray:
    """(m, 4) vertices, of positive volume where half-face normals point into the cell."""
    triangles = mesh.triangles()
    ends = mesh.edges[mesh.faces // 2, 1 - mesh.faces % 2]
    open_ = (np.roll(triangles, -1, axis=1) != ends).any(axis=1)
    if open_.any():
        bad = int(np.argmax(open_))
        raise InvalidInput(f"{name}: the half-edges of face {bad} (from 0) are no loop", "bad_face", [bad])
    of_cell = triangles[mesh.cells // 2]
    of_cell = np.where((mesh.cells % 2 == 1)[:, :, None], of_cell[:, :, ::-1], of_cell)
    base, others = of_cell[:, 0], of_cell[:, 1:].reshape(-1, 9)
    is_apex = (others[:, :, None] != base[:, None, :]).all(axis=2)
    apex = np.take_along_axis(others, is_apex.argmax(axis=1)[:, None], axis=1)
    tets = np.hstack([base, apex])
    distinct = np.sort(of_cell.reshape(-1, 12), axis=1)
    four = (np.diff(distinct, axis=1) != 0).sum(axis=1) == 3
    sides = np.sort(mesh.cells // 2, axis=1)
    bounds = four & is_apex.any(axis=1) & (np.diff(sides, axis=1) > 0).all(axis=1)
    if not bounds.all():
        bad = int(np.argmin(bounds))
        raise InvalidInput(f"{name}: the half-faces of cell {bad} (from 0) bound no tetrahedron", "not_tets", [bad])
    return tets
