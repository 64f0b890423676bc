"""Triangle meshes of the surface studies, by formulas: unit disk, unit sphere, torus, and plane regions between closed
polygons."""

import numpy as np
import octafield
import pyvista
from matplotlib.path import Path as Polygon
from scipy.spatial import cKDTree


def disk(rings: int) -> octafield.TriangleMesh:
    """Unit disk of 6 rings^2 triangles: ring k has 6 k vertices."""
    ring = np.repeat(np.arange(rings + 1), [1, *6 * np.arange(1, rings + 1)])
    first = np.concatenate([[0], 1 + 3 * np.arange(rings + 1) * np.arange(1, rings + 2)])  # of each ring
    place = np.arange(len(ring)) - first[ring]
    angle = 2 * np.pi * place / np.maximum(6 * ring, 1)
    points = np.column_stack([ring * np.cos(angle), ring * np.sin(angle), 0 * angle]) / rings
    triangles = []
    for k in range(1, rings + 1):
        outer, inner = first[k] + np.arange(6 * k), np.arange(6 * k)  # the edge from outer i to i + 1, and what it sees
        inner = first[k - 1] + (inner - inner // k) % max(6 * (k - 1), 1)
        triangles.append(np.column_stack([outer, np.roll(outer, -1), inner]))
        sector = np.arange(6 * k) % k > 0  # a triangle that points outwards between two others
        triangles.append(np.column_stack([outer, inner, np.roll(inner, 1)])[sector])
    return octafield.TriangleMesh(points, np.concatenate(triangles))


def even_disk(edge: float) -> octafield.TriangleMesh:
    """Unit disk of triangles as equilateral as its boundary allows, in no pattern that critical points could lock
    to."""
    angle = np.linspace(0, 2 * np.pi, 20_001)
    size = lambda points: np.full(len(points), edge)
    return region([resampled([np.column_stack([np.cos(angle), np.sin(angle)])], size)], size)


def merged(corners: np.ndarray) -> octafield.TriangleMesh:
    """From (F, 3, 3) corners, equal ones one vertex."""
    _, first, which = np.unique(
        np.round(corners.reshape(-1, 3), 9) + 0.0, axis=0, return_index=True, return_inverse=True
    )
    return octafield.TriangleMesh(corners.reshape(-1, 3)[first], which.reshape(-1, 3))


def sphere(n: int, solid: str = "icosahedron") -> octafield.TriangleMesh:
    """Unit sphere: each triangle of the solid in n^2. Icosahedron: 20 n^2 triangles; octahedron: 8 n^2."""
    body = pyvista.PlatonicSolid(solid)
    a, b, c = (np.asarray(body.points, float)[body.regular_faces[:, k]] for k in range(3))
    ups = [(i, j) for i in range(n) for j in range(n - i)]
    corner = lambda i, j: a * (n - i - j) / n + b * (i / n) + c * (j / n)
    parts = [np.stack([corner(i, j), corner(i + 1, j), corner(i, j + 1)], axis=1) for i, j in ups]
    parts += [
        np.stack([corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)], axis=1) for i, j in ups if i + j + 1 < n
    ]
    flat = merged(np.concatenate(parts))
    points, triangles = np.array(flat.vertices), np.array(flat.triangles)
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    if np.linalg.det(points[triangles[0]]) < 0:
        triangles = triangles[:, ::-1]
    return octafield.TriangleMesh(points, triangles)


def torus(around: int, across: int, big: float = 1.0, small: float = 0.5) -> octafield.TriangleMesh:
    """2 around across triangles; vertex i across + j at azimuth 2 pi i / around and angle 2 pi j / across from the
    outer equator."""
    i, j = (x.ravel() for x in np.meshgrid(np.arange(around), np.arange(across), indexing="ij"))
    phi, theta = 2 * np.pi * i / around, 2 * np.pi * j / across
    radius = big + small * np.cos(theta)
    points = np.column_stack([radius * np.cos(phi), radius * np.sin(phi), small * np.sin(theta)])
    at = lambda di, dj: (i + di) % around * across + (j + dj) % across
    first = np.column_stack([at(0, 0), at(1, 0), at(1, 1)])
    second = np.column_stack([at(0, 0), at(1, 1), at(0, 1)])
    return octafield.TriangleMesh(points, np.concatenate([first, second]))


# ---- plane regions


def resampled(pieces: list[np.ndarray], size) -> np.ndarray:
    """Closed curve of polylines, each from the end of the last one, with edges about size(points) long; ends of pieces
    stay."""
    points = []
    for piece in pieces:
        length = np.linalg.norm(np.diff(piece, axis=0), axis=1)
        count = np.concatenate([[0], np.cumsum(length / size((piece[1:] + piece[:-1]) / 2))])
        wanted = np.linspace(0, count[-1], max(2, int(round(count[-1]))) + 1)[:-1]
        points.append(np.column_stack([np.interp(wanted, count, piece[:, k]) for k in range(2)]))
    return np.concatenate(points)


def lattice(low: np.ndarray, high: np.ndarray, step: float, size) -> np.ndarray:
    """Triangular lattice, edges `step`, where size(points) may be about that; size grows by at most 1/4 of the
    distance."""
    tile = 8 * step
    x, y = np.meshgrid(*(np.arange(a, b, tile) for a, b in zip(low, high)))
    corners = np.column_stack([x.ravel(), y.ravel()])
    corners = corners[size(corners + tile / 2) - tile * np.sqrt(2) / 8 < step * np.sqrt(2)]
    rows = np.round(2 / np.sqrt(3) * (corners[:, 1] - low[1]) / step).astype(int)[:, None] + np.arange(10)
    columns = np.round((corners[:, 0] - low[0]) / step).astype(int)[:, None] + np.arange(8)
    rows, columns = np.broadcast_arrays(rows[:, :, None], columns[:, None, :])
    ids = np.unique(np.column_stack([rows.ravel(), columns.ravel()]), axis=0)
    return low + step * np.column_stack([ids[:, 1] + ids[:, 0] % 2 / 2, ids[:, 0] * np.sqrt(3) / 2])


def interior(loops: list[np.ndarray], size) -> np.ndarray:
    """Points inside the first loop and outside the others, where `size` asks for them: triangular lattices of halving
    step."""
    low, high = loops[0].min(0), loops[0].max(0)
    edges = np.concatenate([(loop + np.roll(loop, -1, 0)) / 2 for loop in loops])
    near = cKDTree(edges)
    finest = min(size(loop).min() for loop in loops)
    taken, step = [], finest * 2.0 ** np.ceil(np.log2((high - low).max() / finest))
    while step > finest / np.sqrt(2):
        points = lattice(low, high, step, size)
        wanted = size(points)
        points = points[(wanted > step / np.sqrt(2)) & (wanted <= step * np.sqrt(2))]
        step /= 2
        if not len(points):
            continue
        inside = Polygon(loops[0]).contains_points(points)
        for loop in loops[1:]:
            inside &= ~Polygon(loop).contains_points(points)
        points = points[inside]
        taken.append(points[near.query(points)[0] > 0.55 * size(points)])
    return np.concatenate(taken)


def region(loops: list[np.ndarray], size, smoothings: int = 5) -> octafield.TriangleMesh:
    """Inside the first closed polygon, outside the others; their edges are mesh edges, interior edges about
    size(points) long."""
    fixed = np.concatenate(loops)
    starts = np.cumsum([0, *map(len, loops)])
    outline = pyvista.PolyData(np.column_stack([fixed, 0 * fixed[:, 0]]))
    # delaunay_2d cuts what lies right of a polygon: the outer one runs counter-clockwise, holes clockwise.
    polygons = [np.arange(a, b) for a, b in zip(starts, starts[1:])]
    area = lambda p: np.cross(np.column_stack([p, 0 * p[:, 0]]), np.column_stack([np.roll(p, -1, 0), 0 * p[:, 0]]))[
        :, 2
    ].sum()
    turned = [ids if (area(fixed[ids]) > 0) == (k == 0) else ids[::-1] for k, ids in enumerate(polygons)]
    outline.faces = np.concatenate([[len(ids), *ids] for ids in turned])
    free = interior(loops, size)
    for sweep in range(smoothings + 1):
        points = np.column_stack([np.concatenate([fixed, free]), np.zeros(len(fixed) + len(free))])
        edges = outline.copy()
        edges.points = points[: len(fixed)]
        triangles = pyvista.PolyData(points).delaunay_2d(edge_source=edges).regular_faces
        if sweep < smoothings:
            pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
            pairs = np.concatenate([pairs, pairs[:, ::-1]])
            count = np.bincount(pairs[:, 0], minlength=len(points))
            mean = np.stack([np.bincount(pairs[:, 0], points[pairs[:, 1], k], len(points)) for k in range(2)], axis=1)
            free = (mean / np.maximum(count, 1)[:, None])[len(fixed) :]
    used, compact = np.unique(triangles, return_inverse=True)
    return oriented(points[used], compact.reshape(-1, 3))


def oriented(points: np.ndarray, triangles: np.ndarray) -> octafield.TriangleMesh:
    """Counter-clockwise seen from +z."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    back = np.cross(b - a, c - a)[:, 2] < 0
    triangles = np.where(back[:, None], triangles[:, ::-1], triangles)
    return octafield.TriangleMesh(points, triangles)
