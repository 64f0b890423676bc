"""Singular curves of a run as lines to turn in a page: small JSON, drawn by view.js."""

import json
from importlib import resources
from pathlib import Path

import numpy as np

_STEPS = 4095  # of coordinates along the longest side of the box
_MOST_SURFACE_POINTS = 6000
KINDS = ("surface", "valence 3", "valence 5", "other")


def scene_json(folder: Path) -> str | None:
    """{"size": [x, y, z], "lines": {kind: [[x0, y0, z0, x1, ...], ...]}} in whole steps of the box; None without files."""
    import pyvista

    paths = folder / "surface.vtp", folder / "singular.vtp"
    if not all(path.is_file() for path in paths):
        return None
    surface, singular = map(pyvista.read, paths)
    low, high = np.array(surface.bounds).reshape(3, 2).T
    scale = _STEPS / (high - low).max()
    whole = lambda points: np.rint((np.asarray(points) - low) * scale).astype(int).ravel().tolist()  # noqa: E731
    lines: dict[str, list] = {kind: [] for kind in KINDS}
    lines["surface"] = [whole(line) for line in _outline(surface)]
    if singular.n_cells:
        singular.points = np.asarray(singular.point_data["smoothed"])
        for cell, kind in zip(_polylines(singular), _kinds(singular), strict=True):
            lines[kind].append(whole(cell))
    size = np.rint((high - low) * scale).astype(int).tolist()
    return json.dumps({"size": size, "lines": lines}, separators=(",", ":"))


def view_script() -> str:
    return resources.files(__package__).joinpath("view.js").read_text(encoding="utf-8")


def _kinds(singular) -> list[str]:
    turns = np.asarray(singular.cell_data["quarter_turns"])[singular.n_verts :]  # cell data begin with those of vertices
    return [{1: "valence 3", -1: "valence 5"}.get(int(t), "other") for t in turns]


def _outline(surface) -> list[np.ndarray]:
    """Sharp edges, and where the surface crosses the three middle planes."""
    sharp = surface.extract_feature_edges(35, boundary_edges=False, non_manifold_edges=False)
    cuts = surface.slice_orthogonal().combine().extract_surface(algorithm=None)
    lines = [line for part in (sharp, cuts) if part.n_cells for line in _polylines(part.strip(join=True))]
    total = sum(map(len, lines))
    keep = max(1, -(-total // _MOST_SURFACE_POINTS))
    return [line if len(line) < 3 * keep else np.concatenate([line[:-1:keep], line[-1:]]) for line in lines]


def _polylines(poly) -> list[np.ndarray]:
    points, cells = np.asarray(poly.points), np.asarray(poly.lines)
    result, k = [], 0
    while k < len(cells):
        result.append(points[cells[k + 1 : k + 1 + cells[k]]])
        k += 1 + cells[k]
    return result
