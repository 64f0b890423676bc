"""How far edges of quads are from the directions of a field that was given, found on their arrays."""

from __future__ import annotations

import numpy as np

from .._core import QuadMesh, SurfaceDomain
from ..layout.quality import edges_of
from .features import feature_edges
from .given_field import GivenField

_TOLD, _FAR = 10.0, 20.0  # degrees


def angles_of(mesh: QuadMesh, own: GivenField) -> dict[str, float]:
    """Degrees, over all edges, at their middles: from the nearest of the four directions."""
    angles = _angles(np.asarray(mesh.vertices), edges_of(np.asarray(mesh.quads))[0], own)
    return {"median": float(np.median(angles)), "p90": float(np.percentile(angles, 90))}


def notes_of_field(own: GivenField, domain: SurfaceDomain, p90: float, followed: bool) -> list[str]:
    """p90: of the edges. Where the field does not follow what edges of quads have to, and where these do not follow
    it."""
    notes = []
    held = feature_edges(domain)
    if len(held):
        points = np.asarray(domain.vertices)
        angles = _angles(points, held, own)
        lengths = np.linalg.norm(points[held[:, 1]] - points[held[:, 0]], axis=1)
        share = float(lengths[angles > _TOLD].sum() / lengths.sum())
        if share:
            notes.append(
                f"on {100 * share:.0f} % of the boundary and the features the field's directions are more than"
                f" {_TOLD:g} degrees away from these, by up to {angles.max():.0f}: edges of quads follow the boundary"
                " and the features, and the field farther inside alone"
            )
    if followed and p90 > _FAR:
        notes.append(
            f"a tenth of the edges of quads are {p90:.0f} degrees or more from the field's directions: with its"
            " singular points and this boundary rows of quads do not wind as its lines do; to follow its points alone"
            " (--follow points) makes better quads"
        )
    return notes


def _angles(points: np.ndarray, edges: np.ndarray, own: GivenField) -> np.ndarray:
    ends = points[edges]
    directions, normals = own.at(ends.mean(axis=1))
    along = ends[:, 1] - ends[:, 0]
    x = np.einsum("ij,ij->i", along, directions)
    y = np.einsum("ij,ij->i", along, np.cross(normals, directions))
    angles: np.ndarray = np.degrees(np.arctan2(y, x))
    return abs((angles + 45) % 90 - 45)
