"""Pictures of direction fields, for the surface studies: small files though they are full of lines.

Everywhere: streamlines grey, separatrices green, singular points of positive index vermillion (plane: circles), of
    negative index blue (plane: squares).
"""

from io import BytesIO
from pathlib import Path

import numpy as np
import octafield
import pyvista
from matplotlib import rc_context
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from octafield.view import scene
from PIL import Image
from study_output import STYLE

STREAMLINE, SEPARATRIX, SIGNS = "#8593a3", scene.GREEN, ((1, scene.VERMILLION, "o"), (-1, scene.BLUE, "s"))


# ---- surfaces in space


def polylines(lines) -> pyvista.PolyData:
    lines = [line for line in lines if len(line.points) > 1]
    starts = np.cumsum([0, *(len(line.points) for line in lines)])
    cells = [np.concatenate([[b - a], np.arange(a, b)]) for a, b in zip(starts, starts[1:])]
    return pyvista.PolyData(np.concatenate([line.points for line in lines]), lines=np.concatenate(cells))


def draw_field(
    path: Path, mesh, field, singular, view, spacing: float, separatrix: float = 0.0, up=(0, 0, 1.0)
) -> None:
    """Streamlines, singular points, and the separatrices up to a length; seen from `view`."""
    shape = scene.plotter()
    shape.add_mesh(
        scene.surface_mesh(mesh).compute_normals(),
        color="#e8ecf1",
        smooth_shading=True,
        ambient=0.62,
        diffuse=0.42,
        specular=0,
    )
    towards = np.array(view, float) / np.linalg.norm(view)
    lifted = 2e-3 * scene.diagonal(np.array(mesh.vertices)) * towards  # lines in front of the facets they lie in
    lines = polylines(octafield.surface.even_streamlines(field, singular, spacing=spacing))
    shape.add_mesh(lines.translate(lifted), color=STREAMLINE, line_width=2, lighting=False)
    if separatrix:
        lines = polylines(octafield.surface.separatrices(field, singular, max_length=separatrix))
        shape.add_mesh(lines.translate(1.5 * lifted), color=SEPARATRIX, line_width=5, lighting=False)
    radius = 0.012 * scene.diagonal(np.array(mesh.vertices))
    ball = pyvista.Sphere(radius=radius, theta_resolution=48, phi_resolution=48)
    for sign, color, _ in SIGNS:
        points = np.array([s.position for s in singular.points if s.index * sign > 0])
        if len(points):
            points += radius * towards  # before the surface, not half in it
            shape.add_mesh(
                pyvista.PolyData(points).glyph(geom=ball, scale=False, orient=False),
                color=color,
                ambient=0.45,
                diffuse=0.6,
                smooth_shading=True,
            )
    scene.look(shape, np.array(mesh.vertices), towards, np.array(up))
    image = np.array(shape.screenshot(return_img=True))
    shape.close()
    drawn = np.argwhere((image < 255).any(axis=2))
    (top, left), (bottom, right) = drawn.min(0), drawn.max(0) + 1
    small = Image.fromarray(image[top:bottom, left:right])
    small.thumbnail((560, 560), Image.Resampling.LANCZOS)
    save_with_few_colours(small, path, 64)


# ---- plane fields


def add_lines(axes, lines, color: str, width: float) -> None:
    axes.add_collection(LineCollection([line.points[:, :2] for line in lines], colors=color, linewidths=width))


def add_points(axes, singular, size: float = 6, keep=lambda point: True) -> None:
    for sign, color, marker in SIGNS:
        x = np.array([s.position for s in singular.points if s.index * sign > 0 and keep(s)]).reshape(-1, 3)
        axes.plot(
            x[:, 0],
            x[:, 1],
            marker,
            color=color,
            markersize=size,
            markeredgecolor="black",
            markeredgewidth=0.6,
            zorder=5,
        )


def add_norm(axes, mesh, field) -> object:
    """|f| by colour, 0 to 1: each triangle the mean of its edges."""
    norm = abs(np.array(field.values))[np.array(field.domain.triangle_edges)].mean(axis=1)
    points = np.array(mesh.vertices)
    return axes.tripcolor(
        points[:, 0],
        points[:, 1],
        np.array(mesh.triangles),
        facecolors=norm,
        vmin=0,
        vmax=1,
        cmap="cividis",
        rasterized=True,
    )


def point_legend(figure, symmetry, separatrices: bool = True, signs: tuple = (1, -1)) -> None:
    points = [
        Line2D(
            [],
            [],
            linestyle="",
            marker=marker,
            color=color,
            markeredgecolor="black",
            markeredgewidth=0.6,
            label=f"singular point, index {'+' if sign > 0 else '-'}1/{symmetry}",
        )
        for sign, color, marker in SIGNS
        if sign in signs
    ]
    lines = [Line2D([], [], color=SEPARATRIX, linewidth=1.3, label="separatrix")] if separatrices else []
    figure.get_layout_engine().set(h_pad=0.1)
    figure.legend(handles=points + lines, loc="outside lower center", ncols=3, frameon=False)


def save_drawing(figure: Figure, path: Path, dpi: int = 100, colours: int = 64) -> None:
    buffer = BytesIO()
    with rc_context(STYLE):
        figure.savefig(buffer, format="png", dpi=dpi, facecolor="white")
    save_with_few_colours(Image.open(buffer).convert("RGB"), path, colours)


def save_with_few_colours(image: Image.Image, path: Path, colours: int) -> None:
    image.quantize(colours, method=Image.Quantize.MEDIANCUT, kmeans=2, dither=Image.Dither.NONE).save(
        path, optimize=True
    )
    print(path)
