"""Faces and edges of meshes of mixed cells, from their arrays alone: what judges a mesh does not ask what made it."""

from dataclasses import dataclass

import numpy as np

from .._core import MixedMesh

# In the order of the cells' numbers. Corners of the faces, seen from outside counter-clockwise.
TRIANGLES = {
    "tets": [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
    "hexahedra": [],
    "wedges": [(0, 2, 1), (3, 4, 5)],
    "pyramids": [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
}
QUADS = {
    "tets": [],
    "hexahedra": [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
    "wedges": [(0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
    "pyramids": [(0, 3, 2, 1)],
}
KINDS = tuple(TRIANGLES)


@dataclass
class Faces:
    """corners: (f, 3 or 4) of each face of each cell. cells: (f,) whose it is. group: (f,) equal for faces of the same
    vertices; count: of those, by group."""

    corners: np.ndarray
    cells: np.ndarray
    group: np.ndarray
    count: np.ndarray

    @property
    def alone(self) -> np.ndarray:
        """(f,) bool: of one cell only."""
        single: np.ndarray = self.count[self.group] == 1
        return single


def blocks(mesh: MixedMesh) -> dict[str, np.ndarray]:
    """Corners of the cells by kind, in the order of their numbers."""
    return {kind: np.asarray(getattr(mesh, kind)) for kind in KINDS}


def faces_of(mesh: MixedMesh, sides: int) -> Faces:
    """Those with so many sides, 3 or 4."""
    patterns, first = TRIANGLES if sides == 3 else QUADS, 0
    corners, cells = [np.zeros((0, sides), np.int64)], [np.zeros(0, np.int64)]
    for kind, rows in blocks(mesh).items():
        for pattern in patterns[kind]:
            corners.append(rows[:, pattern].astype(np.int64))
            cells.append(np.arange(first, first + len(rows)))
        first += len(rows)
    every = np.concatenate(corners)
    _, group, count = np.unique(np.sort(every, axis=1), axis=0, return_inverse=True, return_counts=True)
    return Faces(every, np.concatenate(cells), group.reshape(-1), count)


def edges_of(mesh: MixedMesh) -> np.ndarray:
    """(e, 2) vertex ids, each edge once."""
    found = [np.zeros((0, 2), np.int64)]
    for kind, rows in blocks(mesh).items():
        pairs = {
            tuple(sorted((face[k - 1], face[k]))) for face in TRIANGLES[kind] + QUADS[kind] for k in range(len(face))
        }
        found += [np.sort(rows[:, pair], axis=1).astype(np.int64) for pair in sorted(pairs)]
    edges: np.ndarray = np.unique(np.concatenate(found), axis=0)
    return edges


def nonconforming_faces(mesh: MixedMesh) -> int:
    """Faces that more than two cells share, quads of the same vertices in another order, and triangles of one cell only
    between three corners of a quad of another."""
    triangles, quads = faces_of(mesh, 3), faces_of(mesh, 4)
    crowded = int((triangles.count > 2).sum() + (quads.count > 2).sum())
    lowest = quads.corners.argmin(axis=1)
    across = quads.corners[np.arange(len(lowest)), (lowest + 2) % 4]
    order = np.argsort(quads.group, kind="stable")
    same = quads.group[order][1:] == quads.group[order][:-1]
    twisted = int((same & (across[order][1:] != across[order][:-1])).sum())
    thirds = [np.sort(np.delete(quads.corners, k, axis=1), axis=1) for k in range(4)]
    of_quads = np.unique(np.concatenate(thirds), axis=0)
    lone = np.unique(np.sort(triangles.corners[triangles.alone], axis=1), axis=0)
    both = np.concatenate([of_quads, lone])
    mismatched = len(both) - len(np.unique(both, axis=0))
    return crowded + twisted + mismatched


def outline(mesh: MixedMesh, regions: np.ndarray | None) -> tuple[np.ndarray, np.ndarray]:
    """Triangles and quads of the boundary and, once each, between cells of different regions."""

    def of(faces: Faces) -> np.ndarray:
        if not len(faces.cells):
            return faces.corners
        first = np.zeros(len(faces.count), np.int64)
        first[faces.group[::-1]] = np.arange(len(faces.group))[::-1]
        wanted = faces.count == 1
        if regions is not None:
            low, high = np.full(len(faces.count), np.iinfo(np.int64).max), np.full(len(faces.count), -1)
            np.minimum.at(low, faces.group, regions[faces.cells])
            np.maximum.at(high, faces.group, regions[faces.cells])
            wanted |= low != high
        corners: np.ndarray = faces.corners[first[wanted]]
        return corners

    return of(faces_of(mesh, 3)), of(faces_of(mesh, 4))
