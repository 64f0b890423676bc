"""Meshes to files: surfaces and tets with feature edges, CAD faces and regions, as far as a format holds them."""

from pathlib import Path

import numpy as np

from ..errors import InvalidInput
from ..meshes.mesh_format import MeshFormat
from ..meshes.parts import Parts
from ..meshes.registry import find_mesh_format, written_suffixes
from .inputs import Input


def write_mesh(path: str | Path, found: Input) -> list[str]:
    """Writes by extension (also .gz) and says what the format could not hold."""
    path = Path(path)
    form = find_mesh_format(path, to_write=True)
    assert form.write is not None
    suffix = form.suffix_of(path)
    if "triangles" not in form.holds and found.tets is None:
        raise InvalidInput(
            f"{path}: {suffix} files hold tets, and {found.name} is a surface; write one of"
            f" {' '.join(written_suffixes(surfaces=True))}",
            "not_tets",
        )
    return [*_lost(suffix, form, found), *form.write(path, parts_of(found, form))]


def parts_of(found: Input, form: MeshFormat) -> Parts:
    """The tets with their boundary and interfaces, or the surface. Where the file tells no CAD faces, the parts of the
    surface between feature edges stand for them, for readers take an edge with one face on both sides for a seam."""
    features = found.lines if found.lines_are_features() else None
    if form.closed and found.interface_triangles:
        boundary = found.volume().boundary.mesh
        return Parts(np.asarray(boundary.vertices), None, np.asarray(boundary.triangles))
    triangles = np.asarray(found.surface.triangles)
    if "faces" not in form.holds:
        faces = None
    elif found.faces is None or (found.faces <= 0).all():
        faces = patches(triangles, features)
    else:
        faces = np.maximum(found.faces, 0)
    if found.tets is None or "tets" not in form.holds:
        return Parts(np.asarray(found.surface.vertices), features, triangles, faces)
    tets = found.volume()
    ids = np.asarray(tets.surface.vertex_map)
    lines = None if features is None else ids[features]
    return Parts(np.asarray(tets.vertices), lines, ids[triangles], faces, np.asarray(tets.tets), found.regions)


def _lost(suffix: str, form: MeshFormat, found: Input) -> list[str]:
    notes = []
    if found.tets is not None and "tets" not in form.holds:
        notes.append(f"{suffix} files hold triangles: the boundary of the tets was written")
    there = {
        "feature edges": ("features", found.lines if found.lines_are_features() else None),
        "CAD faces": ("faces", found.faces),
        "regions": ("regions", found.regions),
    }
    names = [name for name, (part, values) in there.items() if values is not None and part not in form.holds]
    return [*notes, f"{suffix} files hold no {', no '.join(names)}: left out"] if names else notes


def patches(triangles: np.ndarray, lines: np.ndarray | None) -> np.ndarray:
    """(t,) numbers from 1 of the connected parts of a surface cut along (k, 2) lines. Where a line ends inside a part,
    a triangle beside it is a part of its own, so that no line has one part on both sides."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    triangles = triangles.astype(np.int64)
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    count = int(triangles.max(initial=0)) + 1
    keys, of_triangle = sides[:, 0] * count + sides[:, 1], np.repeat(np.arange(len(triangles)), 3)
    order = np.argsort(keys, kind="stable")
    same = keys[order][1:] == keys[order][:-1]
    first, second, key = of_triangle[order][:-1][same], of_triangle[order][1:][same], keys[order][1:][same]
    cut = np.zeros(len(key), bool)
    if lines is not None and len(lines):
        low, high = np.sort(np.asarray(lines).astype(np.int64), axis=1).T
        cut = np.isin(key, low * count + high)
    graph = coo_array((np.ones((~cut).sum()), (first[~cut], second[~cut])), shape=(len(triangles), len(triangles)))
    labels: np.ndarray = connected_components(graph, directed=False)[1].astype(np.int64) + 1
    for triangle in np.unique(first[cut & (labels[first] == labels[second])]):
        labels[triangle] = labels.max() + 1
    return labels
