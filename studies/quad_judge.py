"""Judges quads on a surface by their arrays: nothing here asks what made them, or shares code with octafield's record
(but for distances between surfaces)."""

import numpy as np
import octafield
from octafield.meshes.figures import surface_deviation


def judged(
    points: np.ndarray,
    quads: np.ndarray,
    triangles: np.ndarray,
    surface: octafield.TriangleMesh,
    features: np.ndarray,
    edge: float,
) -> dict:
    """triangles: other cells. features: (n, 2) edges of the surface, its boundary among them. edge: wanted. Small are
    quads of less than 0.7 of it: their share of the number, and of the area."""
    vertices = np.asarray(surface.vertices)
    diagonal = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    jacobians, areas = shapes(points[quads])
    sides = [np.sort(c[:, [k, (k + 1) % n]], axis=1) for c, n in ((quads, 4), (triangles, 3)) for k in range(n)]
    edges, count = np.unique(np.concatenate(sides), axis=0, return_counts=True)
    around = np.bincount(np.concatenate([quads.ravel(), triangles.ravel()]), minlength=len(points))
    open_edges = edges[count == 1]
    rim = np.zeros(len(points), bool)
    rim[open_edges] = True
    sizes = np.sqrt(areas) / edge
    return {
        "quads": len(quads),
        "others": len(triangles),
        "irregular": int((~rim & (around > 0) & (around != 4)).sum()),
        "nonconforming": int((count > 2).sum()) + extra_open(open_edges, points, surface),
        "inverted": int((~(jacobians > 0)).sum()),
        "least": float(jacobians.min()),
        "mean": float(jacobians.mean()),
        "poor": int((jacobians < 0.3).sum()),
        "p10": float(np.percentile(sizes, 10)),
        "p90": float(np.percentile(sizes, 90)),
        "small": float((sizes < 0.7).mean()),
        "small_area": float(areas[sizes < 0.7].sum() / areas.sum()),
        "off_features": off_features(points, edges, vertices, features) / diagonal,
        "deviation": surface_deviation(points, triangles.astype(np.int32), quads.astype(np.int32), surface)[0],
    }


def shapes(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Least scaled Jacobian of each quad against its own normal (of its diagonals), and its area."""
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    area = np.linalg.norm(normal, axis=1) / 2
    unit = normal / np.maximum(2 * area, 1e-300)[:, None]
    u, v = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    lengths = np.linalg.norm(u, axis=2) * np.linalg.norm(v, axis=2)
    turned = np.einsum("qkx,qx->qk", np.cross(u, v), unit)
    return (turned / np.maximum(lengths, 1e-300)).min(axis=1), area


def extra_open(open_edges: np.ndarray, points: np.ndarray, surface: octafield.TriangleMesh) -> int:
    """Edges of one cell: all of a closed surface, of an open one those whose ends are not both on its boundary."""
    triangles = np.asarray(surface.triangles)
    sides = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    edges, count = np.unique(sides, axis=0, return_counts=True)
    rim = edges[count == 1]
    if not len(rim) or not len(open_edges):
        return len(open_edges)
    vertices = np.asarray(surface.vertices)
    far = distances(vertices, rim, points[open_edges].reshape(-1, 3)).reshape(-1, 2).max(axis=1)
    return int((far > 1e-6 * np.linalg.norm(np.ptp(vertices, axis=0))).sum())


def off_features(points: np.ndarray, edges: np.ndarray, vertices: np.ndarray, features: np.ndarray) -> float:
    """The largest distance of a vertex or middle of a feature edge to an edge of the mesh: chords of bent features
    count."""
    if not len(features):
        return 0.0
    places = np.concatenate([vertices[np.unique(features)], vertices[features].mean(axis=1)])
    return float(distances(points, edges, places).max())


def distances(points: np.ndarray, edges: np.ndarray, places: np.ndarray) -> np.ndarray:
    import pyvista

    lines = pyvista.PolyData(points, lines=np.column_stack([np.full(len(edges), 2), edges]).ravel())
    return np.linalg.norm(lines.find_closest_cell(places, return_closest_point=True)[1] - places, axis=1)
