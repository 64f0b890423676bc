"""Panels of plane layouts: blocks in colours, quads, sides of blocks, singular points by valence."""

import numpy as np
import octafield
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from octafield.view import scene
from octafield.view.quad_layout import COLOURS, colours_of

# Colours of the document's figure 19, in shades that can be told apart, and markers with their size.
VALENCES = {
    3: (scene.BLUE, "o", 6), 5: (scene.VERMILLION, "s", 6), 6: (scene.ORANGE, "D", 6), 8: ("#F0E442", "*", 12),
}  # fmt: skip
QUADS = "#7b8794"


def draw_quads(axes, result) -> None:
    points, quads = np.asarray(result.mesh.vertices)[:, :2], np.asarray(result.mesh.quads)
    colours = np.array([to_rgb(colour) for colour in COLOURS])[colours_of(quads, result.blocks)]
    axes.add_collection(
        PolyCollection(points[quads], facecolors=colours[result.blocks], edgecolors=QUADS, linewidths=0.3)
    )
    axes.add_collection(LineCollection([side[:, :2] for side in result.layout.sides], colors=scene.INK, linewidths=1.1))
    index = np.where(result.on_boundary, 0, 4 - result.valences)
    for t in np.unique(index[index != 0]):
        draw_points(axes, points[index == t], 4 - int(t))


def draw_outline(axes, mesh, points: list[dict]) -> None:
    """Where there are no quads: the boundary and the points."""
    topology = octafield.surface.edge_topology(mesh)
    rim = np.array(topology.edges)[np.array(topology.edge_triangles).min(axis=1) < 0]
    axes.add_collection(LineCollection(np.array(mesh.vertices)[rim][:, :, :2], colors=scene.INK, linewidths=1.1))
    for point in points:
        draw_points(axes, np.array([point["position"][:2]]), 4 - point["index_times_four"])


def marker(valence: int) -> dict:
    colour, shape, size = VALENCES[valence]
    return {
        "linestyle": "", "marker": shape, "color": colour, "markersize": size, "markeredgecolor": "black",
        "markeredgewidth": 0.6,
    }  # fmt: skip


def draw_points(axes, places: np.ndarray, valence: int) -> None:
    axes.plot(*places.T, **marker(valence), zorder=5)


def finish(axes, title: str, window: tuple | None) -> None:
    axes.set(aspect="equal", xticks=(), yticks=())
    axes.autoscale_view()
    if window:
        (x, y), half = window
        axes.set(xlim=(x - half, x + half), ylim=(y - half, y + half))
    axes.spines[:].set_visible(False)
    axes.set_title(title, fontsize=9)


def legend(figure, valences: list[int]) -> None:
    marks = [Line2D([], [], **marker(v), label=f"valence {v}") for v in valences]
    if marks:
        figure.legend(handles=marks, loc="outside lower center", ncols=len(marks), frameon=False, fontsize=9)
