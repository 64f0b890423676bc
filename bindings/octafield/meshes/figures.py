"""Figures of meshes of any kind: spreads of numbers, distances between surfaces."""

from dataclasses import dataclass

import numpy as np

from .._core import TriangleMesh

# Points of a triangle, and weights for the mean of a polynomial of degree 3: corners, midpoints of sides, centre.
_PLACES = np.array([*np.eye(3), (0.5, 0.5, 0), (0, 0.5, 0.5), (0.5, 0, 0.5), (1 / 3, 1 / 3, 1 / 3)])
_WEIGHTS = np.array([3, 3, 3, 8, 8, 8, 27]) / 60


@dataclass
class Spread:
    """Of numbers: the smallest, what 5 %, half and 95 % of them stay below, and their mean."""

    min: float
    p05: float
    median: float
    p95: float
    mean: float


def spread(values: np.ndarray) -> Spread:
    low, median, high = np.percentile(values, [5, 50, 95])
    return Spread(float(values.min()), float(low), float(median), float(high), float(values.mean()))


def surface_deviation(
    points: np.ndarray, triangles: np.ndarray, quads: np.ndarray, given: TriangleMesh
) -> tuple[float, float]:
    """Largest and root mean square, relative to the diagonal of the bounding box of `given`. Of each surface's points
    (seven per triangle) to the other surface; both ways. A quadrilateral that is not flat counts as four triangles
    about its centre, which is where its bilinear surface passes: the two ways of cutting it along a diagonal are as far
    from that as from each other."""
    made = _about_centres(points, triangles, quads)
    there, back = _distances(made, given), _distances(given, made)
    corners = np.asarray(given.vertices)
    diagonal = float(np.linalg.norm(corners.max(axis=0) - corners.min(axis=0)))
    return max(there[0], back[0]) / diagonal, max(there[1], back[1]) / diagonal


def _about_centres(points: np.ndarray, triangles: np.ndarray, quads: np.ndarray) -> TriangleMesh:
    middle = len(points) + np.arange(len(quads))
    parts = [np.column_stack([quads[:, k], quads[:, (k + 1) % 4], middle]) for k in range(4)]
    vertices = np.concatenate([points, points[quads].mean(axis=1)])
    return TriangleMesh(vertices, np.concatenate([triangles, *parts]))


def _distances(of: TriangleMesh, to: TriangleMesh) -> tuple[float, float]:
    """From points of one surface to the other: largest, root mean square by area."""
    import pyvista

    corners = np.asarray(of.vertices)[np.asarray(of.triangles)]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    samples = np.einsum("pc,tcx->tpx", _PLACES, corners)
    surface = pyvista.PolyData.from_regular_faces(np.array(to.vertices), np.array(to.triangles, int))
    found = pyvista.PolyData(samples.reshape(-1, 3)).compute_implicit_distance(surface)
    distances = np.abs(np.asarray(found["implicit_distance"])).reshape(-1, len(_PLACES))
    mean_square = float((area * (distances**2 @ _WEIGHTS)).sum() / area.sum())
    return float(distances.max()), mean_square**0.5
