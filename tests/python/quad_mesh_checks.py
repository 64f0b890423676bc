"""Meshes of quads on surfaces, judged by code of the tests' own, and small plates whose layouts are known."""

from collections import defaultdict

import numpy as np
import octafield as of


def require_conforming(mesh, euler_characteristic):
    """Quads of positive area at each corner, two at each edge inside, that run it in opposite senses; returns the quads
    round each vertex and the vertices of the boundary."""
    points, quads = np.asarray(mesh.vertices), [tuple(map(int, row)) for row in np.asarray(mesh.quads)]
    runs, round_vertex = defaultdict(list), defaultdict(int)
    for quad in quads:
        assert len(set(quad)) == 4
        p = points[list(quad)]
        normal = np.cross(p[2] - p[0], p[3] - p[1])
        for k in range(4):
            assert np.dot(np.cross(p[(k + 1) % 4] - p[k], p[k - 1] - p[k]), normal) > 0
            runs[frozenset((quad[k], quad[(k + 1) % 4]))].append((quad[k], quad[(k + 1) % 4]))
            round_vertex[quad[k]] += 1
    assert sorted(round_vertex) == list(range(len(points)))
    rim = set()
    for both in runs.values():
        assert len(both) <= 2
        if len(both) == 2:
            assert both[0] == both[1][::-1]
        else:
            rim |= set(both[0])
    assert len(points) - len(runs) + len(quads) == euler_characteristic
    return round_vertex, rim


def irregular(mesh, euler_characteristic):
    """Vertices inside with other than 4 quads, and their index times four."""
    found, rim = require_conforming(mesh, euler_characteristic)
    return {v: 4 - count for v, count in found.items() if v not in rim and count != 4}


def area_of(mesh):
    corners = np.asarray(mesh.vertices)[np.asarray(mesh.quads)]
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    return np.linalg.norm(normals, axis=1).sum() / 2


def disk(rings=8):
    """The unit disk, 6 k triangle corners on ring k."""
    points, triangles, first = [[0.0, 0, 0]], [], 0
    for k in range(1, rings + 1):
        start, inner = len(points), max(6 * (k - 1), 1)
        angles = 2 * np.pi * np.arange(6 * k) / (6 * k)
        points += np.column_stack([k / rings * np.cos(angles), k / rings * np.sin(angles), 0 * angles]).tolist()
        for i in range(6 * k):
            sector, along = divmod(i, k)
            a = first + (sector * (k - 1) + along) % inner
            triangles.append([start + i, start + (i + 1) % (6 * k), a])
            if along < k - 1:
                triangles.append([start + (i + 1) % (6 * k), first + (sector * (k - 1) + along + 1) % inner, a])
        first = start
    return of.TriangleMesh(points, triangles)


def four_points(radius=0.5):
    """Of valence 3, on the axes."""
    places = radius * np.array([[1, 0], [0, 1], [-1, 0], [0, -1]])
    return [{"position": [x, y, 0.0], "index": 0.25} for x, y in places.tolist()]
