"""Edges and triangles of tet meshes as arrays."""

import numpy as np

TRIANGLES_OF_TET = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])  # opposite vertex 0 .. 3, normals outward
_EDGES_OF_TET = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]])


def unique_edges(cells: np.ndarray) -> np.ndarray:
    """(k, 2) edges of (m, 4) tets or (m, 3) triangles, each once, lower id first, in ascending order."""
    cells = np.asarray(cells).astype(np.int64)
    pairs = _EDGES_OF_TET if cells.shape[1] == 4 else np.array([[0, 1], [1, 2], [0, 2]])
    return np.unique(np.sort(cells[:, pairs].reshape(-1, 2), axis=1), axis=0)


def unique_triangles(tets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(k, 3) triangles of (m, 4) tets, each once, as the first tet that has it sees it, outward; and (m, 4) the
    triangle opposite each vertex of each tet."""
    tets = np.asarray(tets).astype(np.int64)
    all_of = tets[:, TRIANGLES_OF_TET].reshape(-1, 3)
    _, first, of_tet = np.unique(np.sort(all_of, axis=1), axis=0, return_index=True, return_inverse=True)
    return all_of[first], of_tet.reshape(-1, 4)


def first_tets_at(tets: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """(k,) the lowest tet at each of (k, 2) edges of the mesh, lower id first."""
    pairs = np.sort(np.asarray(tets).astype(np.int64)[:, _EDGES_OF_TET].reshape(-1, 2), axis=1)
    count = int(pairs.max(initial=0)) + 1
    keys, first = np.unique(pairs[:, 0] * count + pairs[:, 1], return_index=True)
    edges = np.asarray(edges).astype(np.int64)
    tets_at: np.ndarray = first[np.searchsorted(keys, edges[:, 0] * count + edges[:, 1])] // 6
    return tets_at
