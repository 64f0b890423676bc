"""Which vertices or tets the frames of a file belong to."""

from dataclasses import replace

import numpy as np

from .._core import TetMesh
from ..domain.inputs import Input
from ..errors import InvalidInput
from .base import FrameFile

_SAME_PLACE = 1e-6  # of the bounding-box diagonal


def place(found: FrameFile, given: Input | TetMesh | None, where: str | None) -> FrameFile:
    """Sets where and mesh; orders frames by the centres that the file may have."""
    mesh = found.mesh if given is None else given.volume().mesh if isinstance(given, Input) else given
    if mesh is None:
        return replace(found, where=where or found.where)
    if isinstance(given, Input):
        found.regions = given.regions
        features = given.features_of_tets()
        if features is not None:
            found.features = features
        found.notes += given.notes
    found.mesh = mesh
    if found.centres is not None:
        return _by_centres(found, found.centres, mesh, where)
    counts = {"vertices": len(mesh.vertices), "tets": len(mesh.tets)}
    sites = [where] if where else sorted(counts, key=lambda site: site != found.where)
    for site in sites:
        if len(found.frames) == counts[site]:
            return replace(found, where=site)
    if isinstance(given, Input) and "vertices" in sites and len(found.frames) == given.points_in_file:
        used = given.file_points  # other points of the file belong to no tet
        lengths = None if found.lengths is None else found.lengths[used]
        stretch = None if found.stretch is None else found.stretch[used]
        return replace(found, frames=found.frames[used], lengths=lengths, stretch=stretch, where="vertices")
    raise InvalidInput(
        f"{found.path}: {len(found.frames)} frames; the mesh has {counts['vertices']} vertices and {counts['tets']}"
        " tets"
        + (f", and frames at {where} were asked for" if where else "")
        + ": give the mesh that the frames were made on",
        "bad_count",
    )


def _by_centres(found: FrameFile, centres: np.ndarray, mesh: TetMesh, where: str | None) -> FrameFile:
    """Each tet (or vertex) takes the frame whose centre is nearest, as geogram does."""
    from scipy.spatial import cKDTree

    points = np.asarray(mesh.vertices)
    sites = {"tets": points[np.asarray(mesh.tets)].mean(axis=1), "vertices": points}
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    for site in [where] if where else ["tets", "vertices"]:
        wanted = sites[site]
        if len(wanted) == len(centres) and np.abs(wanted - centres).max(initial=0) <= _SAME_PLACE * size:
            return replace(found, where=site)
    if not len(centres):
        raise InvalidInput(f"{found.path}: holds no frames", "bad_count")
    site = where or "tets"
    far, nearest = cKDTree(centres).query(sites[site])
    note = f"each of the {site} took the frame with the nearest centre, {far.max():.3g} away at most"
    lengths = None if found.lengths is None else found.lengths[nearest]
    return replace(found, frames=found.frames[nearest], lengths=lengths, where=site, notes=[*found.notes, note])
