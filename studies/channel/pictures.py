"""Quads coloured by how far their worst angle is from a right angle."""

from pathlib import Path

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from octafield.planar.quads import corner_angles
from study_output import new_figure
from surface_pictures import save_drawing


def draw(path: Path, made) -> None:
    """The whole beside the part round the vertex of the boundary that is farthest to the left."""
    points, quads = np.asarray(made.mesh.vertices)[:, :2], np.asarray(made.mesh.quads)
    worst = np.abs(corner_angles(points, quads) - 90).max(axis=1)
    figure, (whole, part) = new_figure(10.5, 5, 1, 2)
    for axes, width in ((whole, 0.25), (part, 0.7)):
        shapes = PolyCollection(points[quads], array=worst, cmap="YlGnBu", edgecolors="#333333", linewidths=width)
        shapes.set_clim(0, 60)
        axes.add_collection(shapes)
        axes.add_collection(
            LineCollection(points[np.asarray(made.made.boundary)], colors="#b2182b", linewidths=3 * width)
        )
        axes.autoscale()
        axes.set(aspect="equal", xticks=(), yticks=())
        axes.axis("off")
    low, high = points.min(axis=0), points.max(axis=0)
    size = 0.13 * (high - low).max()
    centre = points[np.unique(made.made.boundary)]
    centre = centre[np.argmin(centre @ (1, -0.4))]
    part.set(xlim=centre[0] + np.array([-0.3, 1.7]) * size, ylim=centre[1] + np.array([-1, 1]) * size)
    figure.colorbar(shapes, ax=part, shrink=0.7, label="worst angle less 90, degrees")
    save_drawing(figure, path, colours=64)
