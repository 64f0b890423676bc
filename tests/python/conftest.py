"""Meshes every test file shares: made here, by formulas whose answers are known."""

import itertools
import os
import signal
from pathlib import Path

import numpy as np
import octafield
import pytest

# Started in the background (nohup, &) Ctrl-C is ignored, and so it is in every child; a handler here gives children the
# default.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

SHARED_DATA = Path(__file__).parents[3] / "shared" / "data"


def cpu_seconds(pid: int) -> float:
    """Used so far by a process that was not waited for yet. Linux."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


@pytest.fixture(scope="session")
def shared_data() -> Path:
    if not SHARED_DATA.is_dir():
        pytest.skip(f"no test data at {SHARED_DATA}")
    return SHARED_DATA


def box_tets(n: int) -> octafield.TetMesh:
    """The unit cube in n^3 cubes of six tets each (Kuhn), which match across faces."""
    grid = np.arange(n + 1)
    points = np.array(list(itertools.product(grid, repeat=3)), dtype=float) / n
    index = lambda p: (p[0] * (n + 1) + p[1]) * (n + 1) + p[2]
    tets = []
    for corner in itertools.product(range(n), repeat=3):
        for order in itertools.permutations(range(3)):
            path = [np.array(corner)]
            for axis in order:
                path.append(path[-1] + np.eye(3, dtype=int)[axis])
            tet = [index(p) for p in path]
            if np.linalg.det(points[tet[1:]] - points[tet[0]]) < 0:
                tet[2], tet[3] = tet[3], tet[2]
            tets.append(tet)
    return octafield.TetMesh(points, tets)


@pytest.fixture(scope="session")
def box() -> octafield.TetMesh:
    return box_tets(5)


@pytest.fixture(scope="session")
def box_surface(box) -> octafield.TriangleMesh:
    """Its boundary, found with numpy: faces that occur once, outward."""
    tets = np.array(box.tets)
    faces = np.concatenate([tets[:, [1, 2, 3]], tets[:, [0, 3, 2]], tets[:, [0, 1, 3]], tets[:, [0, 2, 1]]])
    _, first, counts = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    boundary = faces[first[counts == 1]]
    used, compact = np.unique(boundary, return_inverse=True)
    return octafield.TriangleMesh(box.vertices[used], compact.reshape(-1, 3))


@pytest.fixture(scope="session")
def box_features(box_surface) -> octafield.FeatureGraph:
    """The cube's twelve edges: mesh edges whose ends share two extreme coordinates."""
    p = box_surface.vertices
    t = box_surface.triangles
    edges = np.unique(np.sort(np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]), axis=1), axis=0)
    extreme = (p[edges[:, 0]] == p[edges[:, 1]]) & np.isin(p[edges[:, 0]], (0.0, 1.0))
    corners = np.flatnonzero(np.isin(p, (0.0, 1.0)).all(axis=1))
    return octafield.FeatureGraph(edges[extreme.sum(axis=1) == 2], corners)


def icosphere(levels: int) -> octafield.TriangleMesh:
    golden = (1 + 5**0.5) / 2
    points = [p for a, b in itertools.product((-1, 1), (-golden, golden)) for p in ((0, a, b), (a, b, 0), (b, 0, a))]
    points = np.array(points) / np.hypot(1, golden)
    near = lambda i, j: abs(np.linalg.norm(points[i] - points[j]) - 2 / np.hypot(1, golden)) < 1e-9
    triangles = [
        t for t in itertools.combinations(range(12), 3) if near(t[0], t[1]) and near(t[1], t[2]) and near(t[0], t[2])
    ]
    triangles = np.array([t if np.linalg.det(points[list(t)]) > 0 else t[::-1] for t in triangles])
    for _ in range(levels):
        edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        unique, which = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)
        middle = points[unique].sum(axis=1)
        m = len(points) + which.reshape(3, -1)
        points = np.concatenate([points, middle / np.linalg.norm(middle, axis=1, keepdims=True)])
        a, b, c = triangles.T
        triangles = np.concatenate(
            [np.stack(t, axis=1) for t in ((a, m[0], m[2]), (b, m[1], m[0]), (c, m[2], m[1]), m)]
        )
    return octafield.TriangleMesh(points, triangles)


@pytest.fixture(scope="session")
def sphere() -> octafield.TriangleMesh:
    return icosphere(3)


@pytest.fixture(scope="session")
def box_problem(box, box_surface, box_features):
    """Boundary, cross directions, constraints and start of the cube."""
    boundary = octafield.volume.boundary_surface(box)
    field = octafield.surface.direction_field(octafield.surface.SurfaceDomain(box_surface, box_features))
    directions = octafield.surface.vertex_directions(field)
    constraints = octafield.volume.boundary_constraints(octafield.TetDomain(box, features=box_features), directions)
    return boundary, directions, constraints, octafield.volume.initial_frames(box, constraints)
