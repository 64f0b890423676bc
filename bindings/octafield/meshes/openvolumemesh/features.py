"""Features, CAD faces and regions as AlgoHex names them in OpenVolumeMesh files."""

import numpy as np

from ...errors import InvalidInput
from ..topology import unique_triangles
from .mesh import OvmMesh

FEATURES = {"vertex": "AlgoHex::FeatureVertices", "edge": "AlgoHex::FeatureEdges", "face": "AlgoHex::FeatureFaces"}


def add_features(
    mesh: OvmMesh,
    tets: np.ndarray,
    features: np.ndarray | None,
    regions: np.ndarray | None,
    *,
    triangles: np.ndarray | None = None,
    faces: np.ndarray | None = None,
    with_frames: bool = False,
) -> None:
    """tets: (m, 4) of the mesh. Edges as given, vertices where other than two of them meet, all faces of the boundary
    and between regions, by the CAD faces of (t, 3) triangles where these are known, else 1. Where no edges are given
    AlgoHex finds features itself, unless there are frames."""
    if regions is not None:
        mesh.properties["cell", "region"] = np.asarray(regions).astype(np.int32)
    if features is not None:
        marked = _marked_edges(mesh, np.asarray(features))
        degree = np.bincount(mesh.edges[marked].ravel(), minlength=len(mesh.vertices))
        mesh.properties["vertex", FEATURES["vertex"]] = ((degree > 0) & (degree != 2)).astype(np.int32)
        mesh.properties["edge", FEATURES["edge"]] = marked.astype(np.int32)
    if features is not None or with_frames:
        mesh.properties["face", FEATURES["face"]] = _face_tags(mesh, tets, regions, triangles, faces)


def _marked_edges(mesh: OvmMesh, features: np.ndarray) -> np.ndarray:
    count = len(mesh.vertices)
    features = np.sort(features.astype(np.int64), axis=1)
    keys = features[:, 0] * count + features[:, 1]
    marked: np.ndarray = np.isin(mesh.edges[:, 0] * count + mesh.edges[:, 1], keys)
    if marked.sum() < len(np.unique(keys)):
        raise InvalidInput("features name pairs of vertices that are no edges of the tet mesh", "bad_features")
    return marked


def _face_tags(
    mesh: OvmMesh, tets: np.ndarray, regions: np.ndarray | None, triangles: np.ndarray | None, faces: np.ndarray | None
) -> np.ndarray:
    _, of_tet = unique_triangles(tets)
    on_surface: np.ndarray = np.bincount(of_tet.ravel(), minlength=len(mesh.faces)) == 1
    if regions is not None:
        ids = np.repeat(np.asarray(regions), 4)
        low, high = np.full(len(mesh.faces), np.iinfo(np.int64).max), np.full(len(mesh.faces), np.iinfo(np.int64).min)
        np.minimum.at(low, of_tet.ravel(), ids)
        np.maximum.at(high, of_tet.ravel(), ids)
        on_surface |= low != high
    if triangles is None or faces is None:
        return on_surface.astype(np.int32)
    both = np.sort(np.concatenate([mesh.triangles(), triangles]), axis=1)
    ids = np.unique(both, axis=0, return_inverse=True)[1].ravel()
    of_triangle = np.zeros(ids.max() + 1, np.int64)
    of_triangle[ids[len(mesh.faces) :]] = np.where(faces > 0, faces, faces.max() + 1)
    tags: np.ndarray = np.where(on_surface, of_triangle[ids[: len(mesh.faces)]], 0).astype(np.int32)
    return tags
