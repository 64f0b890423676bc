"""A direction field's singular points and separatrices on its surface."""

from collections.abc import Sequence

import numpy as np
import pyvista

from .._core import FeatureGraph, Streamline, SurfaceSingularities, TriangleMesh
from . import scene
from .datasets import beginning, polylines


def surface_field_scene(
    surface: TriangleMesh,
    features: FeatureGraph,
    singularities: SurfaceSingularities,
    separatrices: Sequence[Streamline],
) -> pyvista.Plotter:
    shape = scene.plotter()
    points = np.asarray(surface.vertices)
    scene.add_body(shape, scene.surface_mesh(surface))
    scene.add_features(shape, surface, features, 5)
    radius = 0.009 * scene.diagonal(points)
    lines = [
        beginning(np.asarray(line.points), scene.diagonal(points)) for line in separatrices if len(line.points) > 1
    ]
    if lines:
        shape.add_mesh(polylines(lines).tube(radius=0.2 * radius, n_sides=8), color=scene.GREEN, lighting=False)
    for sign, colour in ((1, scene.VERMILLION), (-1, scene.BLUE)):
        centres = np.array([s.position for s in singularities.points if s.index * sign > 0])
        if len(centres):
            balls = pyvista.PolyData(centres).glyph(geom=pyvista.Sphere(radius=radius), scale=False, orient=False)
            shape.add_mesh(balls, color=colour, smooth_shading=True, ambient=0.3)
    scene.three_quarter_view(shape, points)
    return shape
