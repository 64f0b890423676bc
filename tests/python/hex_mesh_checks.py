"""Meshes of mixed cells judged by code of the tests' own, with the study's tables of faces and corners: nothing of it
asks what octafield says of a mesh."""

from collections import Counter, defaultdict

import numpy as np

from studies.hex_dominant.checker import CORNERS, FACES


def cells_of(mesh):
    """(kind, corner ids) of each cell in the order of their numbers."""
    return [(kind, tuple(map(int, row))) for kind in FACES for row in np.asarray(getattr(mesh, kind))]


def faces_of(mesh):
    """By sorted corners: the faces of cells there, (cell, corners round it)."""
    found = defaultdict(list)
    for number, (kind, cell) in enumerate(cells_of(mesh)):
        for pattern in FACES[kind]:
            corners = [cell[int(c)] for c in pattern]
            found[tuple(sorted(corners))].append((number, corners))
    return found


def corner_jacobians(mesh):
    points, found = np.asarray(mesh.vertices), []
    for kind, patterns in CORNERS.items():
        rows = np.asarray(getattr(mesh, kind))
        for pattern in patterns:
            at, a, b, c = (points[rows[:, int(k)]] for k in pattern)
            found.append(np.einsum("ij,ij->i", np.cross(a - at, b - at), c - at))
    return np.concatenate(found)


def require_conforming(mesh):
    """Every face belongs to two cells that run it in opposite senses, or lies on the boundary; that closes up. Every
    vertex is of a cell."""
    assert (corner_jacobians(mesh) > 0).all()
    assert np.array_equal(np.unique([v for _, cell in cells_of(mesh) for v in cell]), np.arange(len(mesh.vertices)))
    boundary = Counter()
    for faces in faces_of(mesh).values():
        assert len(faces) <= 2, "a face of three cells"
        if len(faces) == 2:
            (_, one), (_, other) = faces
            back = other[::-1]
            turned = back[back.index(one[0]) :] + back[: back.index(one[0])]
            assert one == turned, "a face that its cells do not run in opposite senses"
        else:
            corners = faces[0][1]
            boundary.update(zip(corners, [*corners[1:], corners[0]], strict=True))
    assert all(boundary[b, a] == count for (a, b), count in boundary.items()), "the boundary does not close up"
    quads = [set(corners) for corners, faces in faces_of(mesh).items() if len(corners) == 4]
    thirds = {tuple(sorted(quad - {corner})) for quad in quads for corner in quad}
    assert not thirds & {corners for corners, faces in faces_of(mesh).items() if len(corners) == 3 and len(faces) == 1}


def volume_of(mesh):
    """By the divergence theorem over the boundary, quads as bilinear patches."""
    points, total = np.asarray(mesh.vertices), 0.0
    for corners, faces in faces_of(mesh).items():
        if len(faces) != 1:
            continue
        p = points[faces[0][1]]
        if len(corners) == 3:
            total += np.dot(p[0], np.cross(p[1], p[2])) / 6
        else:  # the mean of both ways to split it is exact
            total += (
                sum(np.dot(p[a], np.cross(p[b], p[c])) for a, b, c in ((0, 1, 2), (0, 2, 3), (0, 1, 3), (1, 2, 3))) / 12
            )
    return total
