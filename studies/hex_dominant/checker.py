"""Meshes of mixed cells judged on their arrays alone, with numpy: nothing here asks octafield.

Cells: a dict of (n, corners) vertex ids by kind, corners in VTK's order of tets, hexahedra and pyramids, wedges with
the triangle 3 4 5 on the side to which the normal of 0 1 2 points. Lengths are in the mesh's unit.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

KINDS = ("tets", "hexahedra", "wedges", "pyramids")
FACES = {
    "tets": ["021", "013", "123", "203"],
    "hexahedra": ["0321", "4567", "0154", "1265", "2376", "3047"],
    "wedges": ["021", "345", "0143", "1254", "2035"],
    "pyramids": ["0321", "014", "124", "234", "304"],
}
# A corner and its neighbours: the determinant of the edges is positive in a sound cell.
CORNERS = {
    "tets": ["0123", "1203", "2013", "3021"],
    "hexahedra": ["0134", "1205", "2316", "3027", "4750", "5461", "6572", "7643"],
    "wedges": ["0123", "1204", "2015", "3540", "4351", "5432"],
    "pyramids": ["0134", "1204", "2314", "3024"],
}
BEST = {"tets": np.sqrt(0.5), "hexahedra": 1.0, "wedges": np.sqrt(0.75), "pyramids": np.sqrt(0.5)}
# Every cell as a hexahedron, some of whose corners coincide: the trilinear map gives the cell's own shape functions.
AS_HEXAHEDRON = {
    "tets": [0, 1, 2, 2, 3, 3, 3, 3],
    "hexahedra": [0, 1, 2, 3, 4, 5, 6, 7],
    "wedges": [0, 1, 2, 2, 3, 4, 5, 5],
    "pyramids": [0, 1, 2, 3, 4, 4, 4, 4],
}
SIGNS = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])
NEAR = 24  # triangles, by their centres, among which the nearest to a point is sought: never too small a distance


@dataclass
class Surface:
    """corners: (t, 3) and (q, 4) of the faces that one cell has, seen from outside counter-clockwise."""

    triangles: np.ndarray
    quads: np.ndarray

    def corners(self, points: np.ndarray) -> np.ndarray:
        """(t, 3, 3) of triangles; four about the centre of each quad, a point of its bilinear surface."""
        quads = points[self.quads]
        fans = [np.stack([quads[:, k], quads[:, (k + 1) % 4], quads.mean(axis=1)], axis=1) for k in range(4)]
        return np.concatenate([points[self.triangles], *fans])


def shape_gradients(at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Trilinear shape functions (p, 8) at (p, 3) points of [-1, 1]^3 and their derivatives (p, 8, 3)."""
    terms = 1 + at[:, None] * SIGNS
    a, b, c = (terms[..., k] for k in range(3))
    gradients = np.stack([SIGNS[:, 0] * b * c, a * SIGNS[:, 1] * c, a * b * SIGNS[:, 2]], axis=-1) / 8
    return terms.prod(axis=-1) / 8, gradients


def gauss(points: int) -> tuple[np.ndarray, np.ndarray]:
    """Places in [-1, 1]^3 and weights."""
    x, w = np.polynomial.legendre.leggauss(points)
    grid = np.stack(np.meshgrid(x, x, x, indexing="ij"), axis=-1).reshape(-1, 3)
    return grid, np.einsum("i,j,k->ijk", w, w, w).ravel()


def jacobians_at(points: np.ndarray, hexahedra: np.ndarray, at: np.ndarray) -> np.ndarray:
    """(n, p, 3, 3) derivatives of the trilinear maps."""
    return np.einsum("nkx,pkd->npxd", points[hexahedra], shape_gradients(at)[1])


def volumes_of(points: np.ndarray, cells: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Exact integrals of the Jacobians."""
    at, weights = gauss(2)
    return {
        kind: np.linalg.det(jacobians_at(points, rows[:, AS_HEXAHEDRON[kind]], at)) @ weights
        for kind, rows in cells.items()
    }


def scaled_jacobians(points: np.ndarray, kind: str, rows: np.ndarray) -> np.ndarray:
    """The smallest of a cell's corners (and the middle of a hexahedron): the determinant of the edges over their
    lengths, over that of the best shape, at most 1. Tets take the longest three edges at a corner, as Verdict does."""
    values = []
    for pattern in CORNERS[kind]:
        at, *ends = (points[rows[:, int(k)]] for k in pattern)
        edges = np.stack([end - at for end in ends], axis=1)
        values.append((np.linalg.det(edges), np.linalg.norm(edges, axis=2).prod(axis=1)))
    if kind == "hexahedra":
        axes = jacobians_at(points, rows, np.zeros((1, 3)))[:, 0]
        values.append((np.linalg.det(axes), np.linalg.norm(axes, axis=1).prod(axis=1)))
    determinants, products = (np.stack(v) for v in zip(*values, strict=True))
    if kind == "tets":
        products = np.broadcast_to(products.max(axis=0), products.shape)
    with np.errstate(divide="ignore", invalid="ignore"):
        found = np.where(products > 0, determinants / products, -1) / BEST[kind]
    return np.minimum(found.min(axis=0), 1.0)


def smallest_inside(points: np.ndarray, kind: str, rows: np.ndarray) -> np.ndarray:
    """The smallest determinant of the map at 5^3 places of the open cell."""
    x = np.linspace(-0.98, 0.98, 5)
    at = np.stack(np.meshgrid(x, x, x, indexing="ij"), axis=-1).reshape(-1, 3)
    hexahedra = rows[:, AS_HEXAHEDRON[kind]]
    parts = np.array_split(hexahedra, max(len(rows) // 20000, 1))
    return np.concatenate([np.linalg.det(jacobians_at(points, part, at)).min(axis=1) for part in parts])


def face_map(cells: dict[str, np.ndarray]) -> tuple[Surface, int]:
    """The surface, and how many faces do not fit: shared by three cells, run by two in the same sense or with corners
    in another order, or a triangle that lies alone on half of a quadrilateral."""
    wrong, alone, keys = 0, {}, {}
    for sides in (3, 4):
        faces = np.concatenate(
            [np.zeros((0, sides), np.int64)]
            + [rows[:, [int(c) for c in p]] for kind, rows in cells.items() for p in FACES[kind] if len(p) == sides]
        )
        first = faces.argmin(axis=1)[:, None]
        rolled = np.take_along_axis(faces, (first + np.arange(sides)) % sides, axis=1)
        turned = np.concatenate([rolled[:, :1], rolled[:, :0:-1]], axis=1)
        _, group, count = np.unique(np.sort(faces, axis=1), axis=0, return_inverse=True, return_counts=True)
        group = group.reshape(-1)
        wrong += int((count > 2).sum())
        order = np.argsort(group, kind="stable")
        begins = np.concatenate([[0], np.cumsum(count)[:-1]])[count == 2].astype(int)
        one, other = order[begins], order[begins + 1]
        wrong += int((rolled[one] != turned[other]).any(axis=1).sum())
        alone[sides] = faces[count[group] == 1]
        keys[sides] = np.sort(faces, axis=1)
    halves = np.concatenate([np.delete(keys[4], k, axis=1) for k in range(4)])
    single = np.sort(alone[3], axis=1)
    both = np.unique(np.concatenate([np.unique(halves, axis=0), single]), axis=0, return_counts=True)[1]
    return Surface(alone[3], alone[4]), wrong + int((both > 1).sum())


def open_edges(surface: Surface) -> int:
    """Edges of the surface that its faces do not run as often one way as the other."""
    ends = [faces[:, [k, (k + 1) % faces.shape[1]]] for faces in (surface.triangles, surface.quads)
            for k in range(faces.shape[1])]  # fmt: skip
    pairs = np.concatenate(ends)
    way = np.where(pairs[:, 0] < pairs[:, 1], 1, -1)
    _, group = np.unique(np.sort(pairs, axis=1), axis=0, return_inverse=True)
    return int((np.bincount(group.reshape(-1), way) != 0).sum())


def enclosed_volume(points: np.ndarray, surface: Surface) -> float:
    """By the divergence theorem; a bilinear patch is the mean of its two splits."""
    p = points - points.mean(axis=0)
    cones = lambda faces, order: np.linalg.det(p[faces[:, order]]).sum() / 6  # noqa: E731
    quads = sum(cones(surface.quads, order) for order in ([0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3])) / 2
    return float(cones(surface.triangles, [0, 1, 2]) + quads)


def distances(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """(n,) from points to the nearest of triangles (t, 3, 3): exact to each of those whose centres are nearest."""
    tree = cKDTree(corners.mean(axis=1))
    found = np.full(len(points), np.inf)
    near = tree.query(points, k=[*range(1, min(NEAR, len(corners)) + 1)])[1]
    for column in near.T:
        found = np.minimum(found, _to_triangles(points, corners[column]))
    return found


def _to_triangles(p: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """(n,) of each point to its triangle: to the plane where the foot lies inside, else to the nearest side."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    size = np.maximum(np.linalg.norm(normal, axis=1), 1e-300)
    dot = lambda x, y: np.einsum("ij,ij->i", x, y)  # noqa: E731
    inside = np.ones(len(p), bool)
    best = np.full(len(p), np.inf)
    for s, e in ((a, b), (b, c), (c, a)):
        inside &= dot(np.cross(e - s, p - s), normal) >= 0
        best = np.minimum(best, to_segments(p, s, e))
    return np.where(inside, np.abs(dot(p - a, normal)) / size, best)


def to_segments(p: np.ndarray, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    along = end - start
    square = np.maximum((along**2).sum(axis=-1), 1e-300)
    t = np.clip(((p - start) * along).sum(axis=-1) / square, 0, 1)
    return np.linalg.norm(p - start - t[..., None] * along, axis=-1)


def surface_samples(corners: np.ndarray) -> np.ndarray:
    """Corners, midpoints of sides and centres."""
    places = np.array([*np.eye(3), (0.5, 0.5, 0), (0, 0.5, 0.5), (0.5, 0, 0.5), (1 / 3, 1 / 3, 1 / 3)])
    return np.einsum("pc,tcx->tpx", places, corners).reshape(-1, 3)


def creases(points: np.ndarray, triangles: np.ndarray, angle: float) -> np.ndarray:
    """(e, 2) edges of a closed surface whose triangles meet at more than `angle` (radians) from flat, or of which not
    two triangles meet."""
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    pairs = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    owner = np.tile(np.arange(len(triangles)), 3)
    edges, group, count = np.unique(pairs, axis=0, return_inverse=True, return_counts=True)
    order = np.argsort(group.reshape(-1), kind="stable")
    begins = np.concatenate([[0], np.cumsum(count)[:-1]]).astype(int)
    one, other = owner[order[begins]], owner[order[np.minimum(begins + 1, len(order) - 1)]]
    sharp = np.einsum("ij,ij->i", normals[one], normals[other]) < np.cos(angle)
    return edges[sharp | (count != 2)]


@dataclass
class Features:
    """length: of the input's curves. kept: share of it within a quarter of the edge length (an edge of a hexagon in a
    circle leaves 0.13 of its length) of an edge of the mesh whose ends lie on the curves. far: the largest distance
    there. corners, corners_kept: where not two edges of curves meet, or at more than 45 degrees, and how many are
    vertices of the mesh."""

    length: float
    kept: float
    far: float
    corners: int
    corners_kept: int


def features_kept(points, surface: Surface, given, edges, edge_length: float, scale: float) -> Features:
    if not len(edges):
        return Features(0.0, 1.0, 0.0, 0, 0)
    start, end = given[edges[:, 0]], given[edges[:, 1]]
    lengths = np.linalg.norm(end - start, axis=1)
    ends = [faces[:, [k, (k + 1) % faces.shape[1]]] for faces in (surface.triangles, surface.quads)
            for k in range(faces.shape[1])]  # fmt: skip
    pairs = np.unique(np.sort(np.concatenate(ends), axis=1), axis=0)
    used = np.unique(pairs)
    on = np.zeros(len(points), bool)
    on[used] = _to_curves(points[used], start, end) < 1e-6 * scale
    pairs = pairs[on[pairs].all(axis=1)]
    corners = _corners(given, edges)
    kept_corners = int((cKDTree(points[used]).query(given[corners])[0] < 1e-6 * scale).sum()) if len(corners) else 0
    if not len(pairs):
        return Features(float(lengths.sum()), 0.0, float("inf"), len(corners), kept_corners)
    places = (np.arange(8) + 0.5) / 8
    samples = start[:, None] + places[None, :, None] * (end - start)[:, None]
    far = _to_curves(samples.reshape(-1, 3), points[pairs[:, 0]], points[pairs[:, 1]])
    good = (far < 0.25 * edge_length).reshape(-1, 8).mean(axis=1)
    kept = float((lengths * good).sum() / lengths.sum())
    return Features(float(lengths.sum()), kept, float(far.max()), len(corners), kept_corners)


def _to_curves(p: np.ndarray, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    parts = np.array_split(p, max(len(p) * len(start) // 4_000_000, 1))
    return np.concatenate([to_segments(part[:, None], start[None], end[None]).min(axis=1) for part in parts])


def _corners(points: np.ndarray, edges: np.ndarray) -> np.ndarray:
    degree = np.bincount(edges.ravel(), minlength=len(points))
    found = set(np.flatnonzero((degree > 0) & (degree != 2)))
    ways: dict[int, list[np.ndarray]] = {}
    for a, b in np.concatenate([edges, edges[:, ::-1]]):
        ways.setdefault(int(a), []).append((points[b] - points[a]) / np.linalg.norm(points[b] - points[a]))
    found |= {v for v, way in ways.items() if len(way) == 2 and way[0] @ way[1] > -np.cos(np.pi / 4)}
    return np.array(sorted(found), int)


def check(points, cells, given, given_tets, edge_length: float, curves) -> dict[str, float]:
    """Figures of a mesh against the tets of the input, and in "faults" what makes it unfit for use, in words. curves:
    (e, 2) feature edges of the input, by its vertices."""
    cells = {kind: np.asarray(rows, np.int64) for kind, rows in cells.items()}
    volumes = volumes_of(points, cells)
    quality = {kind: scaled_jacobians(points, kind, rows) for kind, rows in cells.items() if len(rows)}
    inside = {kind: smallest_inside(points, kind, rows) for kind, rows in cells.items() if len(rows)}
    inverted = sum(int(((quality[kind] <= 0) | (inside[kind] <= 0)).sum()) for kind in quality)
    surface, misfits = face_map(cells)
    total = sum(v.sum() for v in volumes.values())
    outside, _ = face_map({"tets": np.asarray(given_tets, np.int64)})
    wanted = float(np.linalg.det(given[given_tets[:, 1:]] - given[given_tets[:, :1]]).sum() / 6)
    made, old = surface.corners(points), given[outside.triangles]
    used = given[np.unique(given_tets)]
    scale = float(np.linalg.norm(np.ptp(used, axis=0)))
    deviation = max(distances(surface_samples(made), old).max(), distances(surface_samples(old), made).max())
    features = features_kept(points, surface, given, np.asarray(curves), edge_length, scale)
    enclosed = enclosed_volume(points, surface)
    count = sum(len(rows) for rows in cells.values())
    hexahedra = quality.get("hexahedra", np.zeros(0))
    unused = len(points) - len(np.unique(np.concatenate([rows.ravel() for rows in cells.values()])))
    open_count = open_edges(surface)
    faults = {
        "inverted": inverted, "nonconforming": misfits, "open edges": open_count, "unused vertices": unused,
        "cells overlap": int(abs(enclosed - total) > 1e-9 * abs(total)),
        "not finite": int((~np.isfinite(points)).sum()),
    }  # fmt: skip
    return {
        **{kind: len(rows) for kind, rows in cells.items()},
        "hex_volume_share": float(volumes["hexahedra"].sum() / total),
        "hex_number_share": len(hexahedra) / count,
        "hex_sj_min": float(hexahedra.min()) if len(hexahedra) else float("nan"),
        "hex_sj_mean": float(hexahedra.mean()) if len(hexahedra) else float("nan"),
        "sj_min": float(min(values.min() for values in quality.values())),
        "volume_error": abs(enclosed - wanted) / abs(wanted),
        "deviation": float(deviation / scale),
        "nonconforming": misfits,
        "inverted": inverted,
        "features_kept": features.kept,
        "corners": features.corners,
        "corners_lost": features.corners - features.corners_kept,
        "faults": ", ".join(f"{name}: {number}" for name, number in faults.items() if number),
    }
