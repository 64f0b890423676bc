"""Surfaces with one defect each, made here, with the lowest level of repair that mends it (None: no level does)."""

from collections.abc import Callable

import numpy as np
import octafield as of
import pyvista
from octafield.domain.generators import generate


def mesh_of(points, triangles) -> of.TriangleMesh:
    return of.TriangleMesh(np.asarray(points, float), np.asarray(triangles, np.int32))


def parts(mesh):
    return np.array(mesh.vertices), np.array(mesh.triangles)


def ball(nsub=3):
    poly = pyvista.Icosphere(radius=1.0, nsub=nsub)
    return mesh_of(poly.points, poly.faces.reshape(-1, 4)[:, 1:])


def joined(*meshes):
    shifts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    triangles = [np.asarray(mesh.triangles) + shift for mesh, shift in zip(meshes, shifts, strict=False)]
    return mesh_of(np.concatenate([np.asarray(mesh.vertices) for mesh in meshes]), np.concatenate(triangles))


def moved(mesh, *by):
    return mesh_of(np.asarray(mesh.vertices) + by, mesh.triangles)


def reversed_(mesh):
    return mesh_of(mesh.vertices, np.asarray(mesh.triangles)[:, ::-1])


def soup(mesh):
    points, triangles = parts(mesh)
    return mesh_of(points[triangles].reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))


def without_vertices(mesh, *ids):
    triangles = np.asarray(mesh.triangles)
    return mesh_of(mesh.vertices, triangles[~np.isin(triangles, ids).any(axis=1)])


def split_points():
    """The top of a box on points of its own, a rounding lower."""
    points, triangles = parts(generate("box"))
    top = (points[triangles][:, :, 2] == 1).all(axis=1)
    copies = points.copy()
    copies[:, 2] -= 2**-52
    triangles[top] += len(points)
    return mesh_of(np.concatenate([points, copies]), triangles)


def shaken_soup():
    """Every corner of every triangle rounded its own way, as float32."""
    apart = soup(ball())
    points = np.asarray(apart.vertices, np.float32)
    up = np.random.default_rng(7).random(points.shape) < 0.5
    return mesh_of(np.where(up & (np.abs(points) > 0.1), np.nextafter(points, np.float32(0)), points), apart.triangles)


def repeated():
    points, triangles = parts(ball())
    return mesh_of(points, np.concatenate([triangles, triangles[5:9]]))


def fin():
    points, triangles = parts(ball())
    a, b = triangles[0, :2]
    return mesh_of([*points, 1.5 * points[a]], [*triangles, [a, b, len(points)]])


def t_junction():
    """A point on the edge between two triangles that one of them has only."""
    points, triangles = parts(generate("box"))
    a, b, c = triangles[0]
    middle = len(points)
    return mesh_of([*points, (points[a] + points[b]) / 2], [*triangles[1:], [a, middle, c], [middle, b, c]])


def flat_triangle():
    points, triangles = parts(t_junction())
    return mesh_of(points, [*triangles, [triangles[-2][0], triangles[-1][1], len(points) - 1]])


def open_cylinder():
    """Without a lid: a hole of 64 edges."""
    points, triangles = parts(generate("cylinder"))
    top = (points[triangles][:, :, 2] > points[:, 2].max() - 1e-9).all(axis=1)
    return mesh_of(points, triangles[~top])


def large_cap():
    """A ball without a cap: a hole of more than 50 edges in a smooth surface."""
    points, triangles = parts(ball(4))
    return mesh_of(points, triangles[(points[triangles][:, :, 2] < 0.8).all(axis=1)])


def pinched_holes():
    """Two holes that touch at a vertex."""
    points, triangles = parts(ball())
    at = triangles[0, 0]
    around = np.flatnonzero((triangles == at).any(axis=1))
    one = triangles[around[0]]
    apart = next(t for t in around if len(np.intersect1d(triangles[t], one)) == 1)
    return mesh_of(points, np.delete(triangles, [around[0], apart], axis=0))


def spike():
    """A vertex pushed through the opposite wall."""
    points, triangles = parts(ball())
    points[triangles[0, 0]] *= -1.3
    return mesh_of(points, triangles)


def fold():
    """A vertex pulled over its neighbours along the surface."""
    points, triangles = parts(ball())
    at, other = triangles[0, :2]
    points[at] += 2.2 * (points[other] - points[at])
    points[at] /= np.linalg.norm(points[at])
    return mesh_of(points, triangles)


def noise():
    points, triangles = parts(ball())
    return mesh_of(points + 0.06 * np.random.default_rng(3).standard_normal(points.shape), triangles)


def crossing_tubes():
    one = generate("cylinder", radius=0.3, height=2.0)
    points, triangles = parts(one)
    return joined(one, moved(mesh_of(points[:, [2, 0, 1]], triangles), 0.013, 0.021, 0.017))


def moebius():
    angle = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    rim = [
        [(1 + s * np.cos(a / 2)) * np.cos(a), (1 + s * np.cos(a / 2)) * np.sin(a), s * np.sin(a / 2)]
        for a in angle
        for s in (-0.3, 0.3)
    ]
    triangles = []
    for i in range(40):
        a, b, c, d = 2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3
        if i == 39:
            c, d = 1, 0
        triangles += [[a, c, b], [b, c, d]]
    return mesh_of(rim, triangles)


def sheet():
    poly = pyvista.Plane(i_resolution=8, j_resolution=8).triangulate()
    return mesh_of(poly.points, poly.faces.reshape(-1, 4)[:, 1:])


def three_leaves():
    """Triangles on one edge that enclose nothing."""
    return mesh_of([[0, 0, 0], [0, 0, 1], [1, 0, 0], [1, 1, 0], [-1, 0, 0]], [[0, 1, 2], [0, 1, 3], [0, 1, 4]])


def boxes_sharing_a_face():
    """Two boxes with a wall between them, their points merged."""
    box = generate("box")
    return of.surface.repair(
        joined(box, moved(reversed_(mesh_of(np.asarray(box.vertices) * [-1, 1, 1], box.triangles)), 0, 0, 0)),
        level="merge",
    ).mesh


def boxes_sharing_an_edge():
    return of.surface.repair(joined(generate("box"), moved(generate("box"), 1, 1, 0)), level="merge").mesh


ZOO: dict[str, tuple[Callable[[], of.TriangleMesh], str | None]] = {
    "soup": (lambda: soup(ball()), "merge"),
    "split points": (split_points, "merge"),
    "soup rounded corner by corner": (shaken_soup, "merge"),
    "small hole": (lambda: without_vertices(ball(), 20), "safe"),
    "holes touching at a vertex": (pinched_holes, "safe"),
    "turned triangles": (
        lambda: mesh_of(
            ball().vertices, np.concatenate([np.asarray(ball().triangles)[:9, ::-1], np.asarray(ball().triangles)[9:]])
        ),
        "safe",
    ),
    "inside out": (lambda: reversed_(ball()), "safe"),
    "repeated triangles": (repeated, "safe"),
    "fin": (fin, "safe"),
    "T-junction": (t_junction, "safe"),
    "triangle without area": (flat_triangle, "safe"),
    "stray crumb": (lambda: joined(ball(), mesh_of(np.eye(3) * 1e-4 + 2, [[0, 1, 2]])), "safe"),
    "wall between boxes": (boxes_sharing_a_face, "safe"),
    "open cylinder": (open_cylinder, "fill"),
    "ball without a cap": (large_cap, "fill"),
    "crossing tubes": (crossing_tubes, "resolve"),
    "spike": (spike, "resolve"),
    "fold": (fold, "resolve"),
    "noise": (noise, "resolve"),
    "boxes touching at an edge": (boxes_sharing_an_edge, "wrap"),
    "Moebius strip": (moebius, None),
    "sheet": (sheet, None),
    "leaves on one edge": (three_leaves, None),
}
