"""Meshes and singular graphs in notebooks: the compiled classes get here what ShownInNotebooks has."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _core
from .._core import SingularGraph, TetDomain, TetMesh, TriangleMesh
from .notebook import Facts, display_live, html_of

if TYPE_CHECKING:
    import pyvista

Arrays = TriangleMesh | TetMesh | TetDomain | SingularGraph


def _figures(value: TriangleMesh | TetMesh | TetDomain | SingularGraph) -> dict[str, Any]:
    if isinstance(value, SingularGraph):
        turns = np.asarray(value.curve_quarter_turns)
        kinds = {f"valence {4 - number}": number for number in (3, 2, 1, -1, -2, -3, -4)} | {"complex": 0}
        counts = {
            name: int((turns == number).sum())
            for name, number in kinds.items()
            if number in (1, -1, 0) or number in turns
        }
        return {"curves": len(value.curves), **counts, "nodes": len(value.nodes), "length": float(value.length)}
    points = np.asarray(value.vertices)
    cells = (
        {"tets": len(value.tets)} if isinstance(value, (TetMesh, TetDomain)) else {"triangles": len(value.triangles)}
    )
    facts: dict[str, Any] = {"vertices": len(points), **cells}
    if len(points):
        sides = zip("xyz", points.min(axis=0), points.max(axis=0), strict=True)
        facts |= {axis: f"{low:.6g} to {high:.6g}" for axis, low, high in sides}
    return facts


def _surface_scene(mesh: TriangleMesh) -> pyvista.Plotter:
    from . import scene

    shape = scene.plotter()
    edges = len(mesh.triangles) <= _MOST_WITH_EDGES
    shape.add_mesh(scene.surface_mesh(mesh), color=scene.BODY, show_edges=edges, edge_color=scene.INK, ambient=0.35)
    scene.three_quarter_view(shape, mesh.vertices)
    return shape


def _tets_scene(tets: TetMesh | TetDomain) -> pyvista.Plotter:
    """The half behind the middle, so that the inside shows."""
    import pyvista

    from . import scene

    if len(tets.tets) > _MOST_OPENED:
        return _surface_scene(_core.boundary_surface(tets).mesh)
    shape = scene.plotter()
    points = np.asarray(tets.vertices)
    axes = scene.principal_axes(points)
    grid = pyvista.UnstructuredGrid({pyvista.CellType.TETRA: np.asarray(tets.tets)}, points)
    half = grid.clip(normal=axes[1], origin=(points.min(0) + points.max(0)) / 2, crinkle=True)
    edges = half.n_cells <= _MOST_WITH_EDGES
    shape.add_mesh(
        half.extract_surface(algorithm=None), color=scene.BODY, show_edges=edges, edge_color=scene.INK, ambient=0.35
    )
    scene.look(shape, points, axes[1] + 0.4 * axes[0] + 0.4 * axes[2], axes[2])
    return shape


def _curves_scene(graph: SingularGraph) -> pyvista.Plotter:
    from . import scene
    from .curves import TURNS

    shape = scene.plotter()
    points = np.asarray(_core.smoothed_curves(graph).points)
    if not len(points):
        return shape
    from .datasets import polylines

    radius = 0.006 * scene.diagonal(points)
    of_kind: dict[int, list[np.ndarray[Any, Any]]] = {}
    for curve, turns in zip(graph.curves, np.asarray(graph.curve_quarter_turns).tolist(), strict=True):
        of_kind.setdefault(turns if turns in TURNS else 2, []).append(points[np.asarray(curve)])
    for kind, lines in of_kind.items():
        tubes = polylines(lines).tube(radius=radius, n_sides=12)
        shape.add_mesh(tubes, color=TURNS[kind][0], smooth_shading=True, ambient=0.3)
    scene.three_quarter_view(shape, points)
    return shape


_MOST_WITH_EDGES = 50_000  # triangles drawn with their edges


_MOST_OPENED = 300_000  # tets of a mesh that is shown cut open


def scene_of(value: Arrays) -> pyvista.Plotter | None:
    """The curves, the surface, or the tet mesh cut open; None where a mesh has no cells. Raises IoError without
    OpenGL."""
    if isinstance(value, SingularGraph):
        return _curves_scene(value)
    if isinstance(value, TriangleMesh):
        return _surface_scene(value) if len(value.triangles) else None
    return _tets_scene(value) if len(value.tets) else None


def _facts(value: Arrays) -> Facts:
    return type(value).__name__, _figures(value)


def _html(value: Arrays) -> str:
    return html_of(_facts(value), lambda: scene_of(value))


def _display(value: Arrays) -> None:
    display_live(_facts(value), lambda: scene_of(value))


for _kind in (TriangleMesh, TetMesh, TetDomain, SingularGraph):
    for _name, _method in (("_repr_html_", _html), ("_ipython_display_", _display)):
        setattr(_kind, _name, _method)
del _kind, _name, _method
