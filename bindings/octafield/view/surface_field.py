"""A direction field's singular points and separatrices on its surface."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyvista

from .._core import FeatureGraph, Streamline, SurfaceSingularities, TriangleMesh
from ..errors import IoError
from . import scene
from .datasets import beginning, polylines, read_vtp

_FILES = ("surface.vtp", "surface_singularities.vtp", "surface_separatrices.vtp")


def surface_field_scene(
    surface: TriangleMesh,
    features: FeatureGraph,
    singularities: SurfaceSingularities,
    separatrices: Sequence[Streamline],
) -> pyvista.Plotter:
    shape = scene.plotter()
    scene.add_body(shape, scene.surface_mesh(surface))
    scene.add_features(shape, surface, features, 5)
    positions = np.array([s.position for s in singularities.points], float).reshape(-1, 3)
    indices = np.array([s.index for s in singularities.points], float)
    lines = [np.asarray(line.points) for line in separatrices]
    _add_field(shape, np.asarray(surface.vertices), positions, indices, lines)
    return shape


def is_surface_field(folder: Path) -> bool:
    """Whether the folder is that of `octafield surface-field`: frame fields have singular curves beside the same."""
    return not (folder / "singular.vtp").is_file() and all((folder / name).is_file() for name in _FILES)


def scene_of_folder(folder: Path) -> tuple[pyvista.Plotter, list[str]]:
    """The same from the files of a result, sharp edges in place of features; and their names."""
    surface, points, curves = (read_vtp(folder / name) for name in _FILES)
    if points.n_points and "index" not in points.point_data:
        raise IoError(f"{folder / _FILES[1]}: holds no singular points; give a result of octafield surface-field")
    shape = scene.plotter()
    scene.add_body(shape, surface)
    sharp = surface.extract_feature_edges(35, non_manifold_edges=False)
    if sharp.n_cells:
        shape.add_mesh(sharp, color=scene.CURVE, line_width=5, lighting=False)
    lines = [np.asarray(curves.get_cell(i).points) for i in range(curves.n_cells)]
    indices = np.asarray(points.point_data["index"]) if points.n_points else np.zeros(0)
    _add_field(shape, np.asarray(surface.points), np.asarray(points.points, float), indices, lines)
    return shape, list(_FILES)


def _add_field(
    shape: pyvista.Plotter,
    vertices: np.ndarray,
    positions: np.ndarray,
    indices: np.ndarray,
    lines: Sequence[np.ndarray],
) -> None:
    """The beginnings of the curves, and balls at singular points in the colour of their sign."""
    size = scene.diagonal(vertices)
    radius = 0.009 * size
    begun = [beginning(line, size) for line in lines if len(line) > 1]
    if begun:
        shape.add_mesh(polylines(begun).tube(radius=0.2 * radius, n_sides=8), color=scene.GREEN, lighting=False)
    for sign, colour in ((1, scene.VERMILLION), (-1, scene.BLUE)):
        centres = positions[indices * sign > 0]
        if len(centres):
            balls = pyvista.PolyData(centres).glyph(geom=pyvista.Sphere(radius=radius), scale=False, orient=False)
            shape.add_mesh(balls, color=colour, smooth_shading=True, ambient=0.3)
    scene.three_quarter_view(shape, vertices)
