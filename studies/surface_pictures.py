"""Pictures of direction fields, for the surface studies: small files though they are full of lines."""

from io import BytesIO
from pathlib import Path

import numpy as np
import pyvista
from matplotlib import rc_context
from matplotlib.figure import Figure
from PIL import Image
from study_output import STYLE

import octafield
from octafield import scene


def polylines(lines) -> pyvista.PolyData:
    lines = [line for line in lines if len(line.points) > 1]
    starts = np.cumsum([0, *(len(line.points) for line in lines)])
    cells = [np.concatenate([[b - a], np.arange(a, b)]) for a, b in zip(starts, starts[1:])]
    return pyvista.PolyData(np.concatenate([line.points for line in lines]), lines=np.concatenate(cells))


def draw_field(path: Path, mesh, field, singular, view, spacing: float, separatrix: float = 0.0) -> None:
    """Streamlines, singular points (positive index vermillion, negative blue), and the first part of the separatrices."""
    shape, features = scene.plotter(), octafield.FeatureGraph()
    scene.add_body(shape, scene.surface_mesh(mesh))
    lines = octafield.even_streamlines(mesh, features, field, singular, spacing=spacing)
    shape.add_mesh(polylines(lines), color=scene.CROSS, line_width=2, lighting=False)
    if separatrix:
        lines = octafield.separatrices(mesh, features, field, singular, max_length=separatrix)
        shape.add_mesh(polylines(lines), color=scene.VERMILLION, line_width=4, lighting=False)
    radius = 0.01 * scene.diagonal(np.array(mesh.vertices))
    for sign, color in ((1, scene.VERMILLION), (-1, scene.BLUE)):
        points = np.array([s.position for s in singular.points if s.index * sign > 0])
        if len(points):
            shape.add_mesh(pyvista.PolyData(points).glyph(geom=pyvista.Sphere(radius=radius), scale=False, orient=False), color=color, ambient=0.3)
    scene.look(shape, np.array(mesh.vertices), np.array(view, float), np.array([0, 0, 1.0]))
    image = np.array(shape.screenshot(return_img=True))
    shape.close()
    drawn = np.argwhere((image < 255).any(axis=2))
    (top, left), (bottom, right) = drawn.min(0), drawn.max(0) + 1
    small = Image.fromarray(image[top:bottom, left:right])
    small.thumbnail((640, 640), Image.Resampling.LANCZOS)
    save_with_few_colours(small, path, 128)


def save_drawing(figure: Figure, path: Path, dpi: int = 100) -> None:
    buffer = BytesIO()
    with rc_context(STYLE):
        figure.savefig(buffer, format="png", dpi=dpi, facecolor="white")
    save_with_few_colours(Image.open(buffer).convert("RGB"), path, 96)


def save_with_few_colours(image: Image.Image, path: Path, colours: int) -> None:
    image.quantize(colours, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(path, optimize=True)
    print(path)
