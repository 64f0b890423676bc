"""The layout that blocks of quads make up, found on the quads: vertices, sides and patches as arrays."""

from __future__ import annotations

import numpy as np

from .._core import QuadMesh
from .blocks import LayoutParts
from .quality import quads_round


def block_chords(quads: np.ndarray, blocks: np.ndarray, of_blocks: np.ndarray) -> np.ndarray:
    """(q, 2) the chords across the first and second pair of sides of each quad, where of_blocks (b, 2) has those of its
    block's lowest quad."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    one, other, turned = _pairs(quads, blocks)
    # Nodes: a quad as its block's lowest one runs, and turned by a right angle.
    rows = np.concatenate([2 * one, 2 * one + 1])
    columns = np.concatenate([2 * other + turned, 2 * other + 1 - turned])
    graph = coo_array((np.ones(len(rows)), (rows, columns)), shape=(2 * len(quads), 2 * len(quads)))
    label = connected_components(graph, directed=False)[1]
    _, lowest = np.unique(blocks, return_index=True)
    straight = label[2 * np.arange(len(quads))] == label[2 * lowest[blocks]]
    chords: np.ndarray = np.where(straight[:, None], of_blocks[blocks], of_blocks[blocks][:, ::-1])
    return chords


def _pairs(quads: np.ndarray, blocks: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Quads of one block with an edge in common: both, and 1 where sides of the one continue as other sides of the
    other."""
    edges = np.concatenate([np.sort(quads[:, [k, (k + 1) % 4]], axis=1) for k in range(4)]).astype(np.int64)
    place = np.tile(np.arange(len(quads)), 4)
    number = np.repeat(np.arange(4), len(quads))
    key = edges[:, 0] * (int(quads.max()) + 1) + edges[:, 1]
    order = np.argsort(key, kind="stable")
    next_to = np.flatnonzero(key[order][1:] == key[order][:-1])
    a, b = order[next_to], order[next_to + 1]
    same = blocks[place[a]] == blocks[place[b]]
    a, b = a[same], b[same]
    return place[a], place[b], (number[a] + number[b]) % 2


def parts_of_blocks(
    mesh: QuadMesh, blocks: np.ndarray, chords: np.ndarray, largest_mismatch: float, separatrices: int
) -> LayoutParts:
    """Sides run along edges between blocks and of the boundary, from corner to corner of blocks; those that close on
    themselves have no ends. largest_mismatch, separatrices: of the T-mesh that the quads come from."""
    points, quads = np.asarray(mesh.vertices), np.asarray(mesh.quads)
    on_boundary, round_vertex = quads_round(quads, len(points))
    walls, wall_chords, at_rim = _walls(quads, blocks, chords)
    corner = _corners(quads, blocks)
    wall_degree = np.bincount(walls.ravel(), minlength=len(points))
    nodes = np.flatnonzero(corner & (wall_degree > 0))
    number = np.full(len(points), -1)
    number[nodes] = np.arange(len(nodes))
    sides, ends, of_side = _chains(walls, number)
    regular = np.where(on_boundary, 2, 4)
    return LayoutParts(
        positions=points[nodes],
        kinds=[_kind(on_boundary[v], round_vertex[v] == regular[v]) for v in nodes],
        indices_times_four=(regular - round_vertex)[nodes].astype(np.int32),
        sides=[points[side] for side in sides],
        side_ends=np.array(ends, np.int32).reshape(-1, 2),
        side_chords=wall_chords[of_side].astype(np.int32),
        on_boundary=at_rim[of_side],
        points=points,
        first=np.arange(0, quads.size + 1, 4),
        corners=quads.ravel(),
        polygon_patches=blocks,
        largest_mismatch=largest_mismatch,
        separatrices=separatrices,
        chords=len(np.unique(chords)),
    )


def _kind(on_boundary: bool, regular: bool) -> str:
    if on_boundary:
        return "boundary" if regular else "corner"
    return "crossing" if regular else "singular"


def _walls(quads: np.ndarray, blocks: np.ndarray, chords: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(w, 2) edges with one quad or with two of different blocks; the chord of each, and whether it is of one quad."""
    edges = np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)]).astype(np.int64)
    of_edge = np.tile(np.arange(len(quads)), 4)
    across = np.concatenate([chords[:, k % 2] for k in range(4)])
    found, first, group, count = np.unique(
        np.sort(edges, axis=1), axis=0, return_index=True, return_inverse=True, return_counts=True
    )
    group = group.reshape(-1)
    low, high = np.full(len(found), len(quads)), np.full(len(found), -1)
    np.minimum.at(low, group, blocks[of_edge])
    np.maximum.at(high, group, blocks[of_edge])
    wall = (count == 1) | (low != high)
    return edges[first[wall]], across[first[wall]], count[wall] == 1


def _corners(quads: np.ndarray, blocks: np.ndarray) -> np.ndarray:
    """(V,) bool: of some block, which has one quad there."""
    count = int(quads.max()) + 1
    pairs = blocks.repeat(4).astype(np.int64) * count + quads.ravel()
    once, times = np.unique(pairs, return_counts=True)
    corner = np.zeros(count, bool)
    corner[once[times == 1] % count] = True
    return corner


def _chains(walls: np.ndarray, number: np.ndarray) -> tuple[list[list[int]], list[tuple[int, int]], np.ndarray]:
    """Vertices along each side, the numbers of its ends (-1: closed), and one of its walls."""
    at: dict[int, list[int]] = {}
    for w, (a, b) in enumerate(walls.tolist()):
        at.setdefault(a, []).append(w)
        at.setdefault(b, []).append(w)
    taken = np.zeros(len(walls), bool)
    sides, ends, of_side = [], [], []
    starts = [v for v in at if number[v] >= 0] + [v for v in at if number[v] < 0]
    for start in starts:
        for w in at[start]:
            if taken[w]:
                continue
            side, current = [start], w
            while True:
                taken[current] = True
                a, b = walls[current].tolist()
                side.append(b if side[-1] == a else a)
                end = side[-1]
                if end == start or number[end] >= 0:
                    break
                current = next(other for other in at[end] if other != current)
            sides.append(side)
            ends.append((int(number[start]), int(number[side[-1]])))
            of_side.append(w)
    return sides, ends, np.array(of_side, int)
