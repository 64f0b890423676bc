"""Singular curves drawn by type inside a surface: of results, of graphs and of files."""

from pathlib import Path

import numpy as np
import pyvista

from .. import _core
from .._core import BoundaryMeshability, FeatureGraph, SingularGraph, TetDomain, TriangleMesh
from . import scene
from .datasets import read_vtp
from .scene import three_quarter_view

TURNS = {
    1: (scene.VERMILLION, "valence 3 (index +1/4)"),
    -1: (scene.BLUE, "valence 5 (index \N{MINUS SIGN}1/4)"),
    2: (scene.GREEN, "valence 2 (index +1/2)"),
    -2: (scene.BROWN, "valence 6 (index \N{MINUS SIGN}1/2)"),
    3: (scene.GREY, "valence 1, 7 or 8 (index +3/4, \N{MINUS SIGN}3/4, \N{MINUS SIGN}1)"),
    0: (scene.PURPLE, "complex: no hex mesh has it"),
}


def singular_scene(
    surface: TriangleMesh, features: FeatureGraph, graph: SingularGraph, bad: pyvista.PolyData | None = None
) -> pyvista.Plotter:
    """Tubes along the curves (smoothed), by type, inside the translucent surface. bad: edges that no hex mesh has."""
    points = np.asarray(surface.vertices)
    radius = 0.0045 * scene.diagonal(points)
    shape = glass(scene.surface_mesh(surface))
    scene.add_features(shape, surface, features, 3)
    add_curves(shape, curves_by_kind(graph), radius)
    _add_nodes(shape, np.asarray(graph.points)[np.asarray(graph.nodes, dtype=int)], radius)
    if bad is not None:
        shape.add_mesh(bad.tube(radius=0.8 * radius, n_sides=8), color=scene.ORANGE, smooth_shading=True, ambient=0.3)
    three_quarter_view(shape, points)
    return shape


def scene_from_files(surface_file: Path, singular_file: Path) -> pyvista.Plotter:
    """The same from surface.vtp and singular.vtp of a result; sharp edges in place of feature curves."""
    surface = read_vtp(surface_file)
    points = np.asarray(surface.points)
    radius = 0.0045 * scene.diagonal(points)
    curves, nodes = curves_of_file(singular_file)
    shape = glass(surface)
    sharp = surface.extract_feature_edges(35, boundary_edges=False, non_manifold_edges=False)
    if sharp.n_cells:
        shape.add_mesh(sharp, color=scene.CURVE, line_width=3, lighting=False)
    if curves:
        add_curves(shape, curves, radius)
        _add_nodes(shape, nodes, radius)
    three_quarter_view(shape, points)
    return shape


def curves_of_file(path: Path) -> tuple[dict[int, pyvista.PolyData | None], np.ndarray]:
    """The smoothed curves of singular.vtp by kind, and (n, 3) their nodes."""
    found = read_vtp(path)
    curves: dict[int, pyvista.PolyData | None] = {}
    if not found.n_lines:
        return curves, np.zeros((0, 3))
    of = np.array([kind_of(int(t)) for t in np.asarray(found.cell_data["quarter_turns"])[found.n_verts :]])
    nodes = np.asarray(found.points)[np.asarray(found.point_data["node"], bool)]
    found.points = np.asarray(found.point_data["smoothed"])
    for kind in set(of):
        cells: np.ndarray = found.n_verts + np.flatnonzero(of == kind)
        curves[kind] = found.extract_cells(cells).extract_surface(algorithm=None)
    return curves, nodes


def glass(surface: pyvista.PolyData) -> pyvista.Plotter:
    """The translucent surface."""
    shape = scene.plotter()
    pyvista.Plotter.enable_depth_peeling(shape, 8)  # so called, its types are right
    shape.add_mesh(surface, color="#9fb0c3", opacity=0.16, smooth_shading=False, specular=0)
    return shape


def curves_by_kind(graph: SingularGraph) -> dict[int, pyvista.PolyData | None]:
    points = np.asarray(_core.smoothed_curves(graph).points)
    return {kind: _polylines(graph, points, kind) for kind in TURNS}


def add_curves(shape: pyvista.Plotter, curves: dict[int, pyvista.PolyData | None], radius: float) -> None:
    for kind, lines in curves.items():
        if lines is not None:
            shape.add_mesh(
                lines.tube(radius=radius, n_sides=12), color=TURNS[kind][0], smooth_shading=True, ambient=0.3
            )


def _add_nodes(shape: pyvista.Plotter, nodes: np.ndarray, radius: float) -> None:
    if len(nodes):
        shape.add_mesh(spheres(nodes, 1.8 * radius), color=scene.INK, smooth_shading=True)


def bad_features(tets: TetDomain, found: BoundaryMeshability | None) -> pyvista.PolyData | None:
    """Feature edges that no hex mesh has; None where there are none."""
    if found is None:
        return None
    edges = np.array([(w.a, w.b) for w in found.wedges if not w.meshable], int).reshape(-1, 2)
    points = np.asarray(tets.vertices)
    return scene.segments(points[edges[:, 0]], points[edges[:, 1]]) if len(edges) else None


def spheres(centres: np.ndarray, radius: float) -> pyvista.PolyData:
    ball = pyvista.Sphere(radius=radius, theta_resolution=24, phi_resolution=24)
    balls: pyvista.PolyData = pyvista.PolyData(centres).glyph(geom=ball, scale=False, orient=False)
    return balls


def kind_of(turns: int) -> int:
    return turns if turns in (2, 1, 0, -1, -2) else 3


def _polylines(graph: SingularGraph, points: np.ndarray, kind: int) -> pyvista.PolyData | None:
    cells = [
        entry
        for curve, turns in zip(graph.curves, graph.curve_quarter_turns)
        if kind_of(int(turns)) == kind
        for entry in (len(curve), *map(int, curve))
    ]
    return pyvista.PolyData(points, lines=np.array(cells)) if cells else None
