"""Pictures of a report: cross field on the surface, singular curves in the volume, frames on a cut."""

import numpy as np
import pyvista

from .. import _core
from .._core import DirectionField
from ..fields.analysed import AnalysedField
from ..fields.frame_field import FieldProblem
from ..view import captions, scene
from ..view.curves import TURNS, add_curves, bad_features, curves_by_kind, glass, kind_of, singular_scene, spheres
from ..view.datasets import beginning, polylines
from ..view.picture import Picture
from ..view.scene import three_quarter_view

MOST_CROSSES = 4000
MOST_CUBES = 1500
CUT = "#f6ecd6"


def surface_cross_field(problem: FieldProblem) -> Picture:
    """Crosses in evenly spread triangles, feature curves, separatrices, and spheres at the singular points."""
    mesh, features = problem.meshed.surface, problem.meshed.features
    points = np.asarray(mesh.vertices)
    shape = scene.plotter()
    scene.add_body(shape, scene.surface_mesh(mesh))
    shape.add_mesh(_crosses(problem.direction_field), color=scene.CROSS, line_width=4, lighting=False)
    scene.add_features(shape, mesh, features, 7)
    radius = 0.011 * scene.diagonal(points)
    legend = [(scene.CROSS, "cross")] + [(scene.CURVE, "feature curve")] * (len(features.edges) > 0)
    beginnings = [beginning(line.points, scene.diagonal(points)) for line in problem.separatrices]
    curves = polylines([line for line in beginnings if len(line) > 1])
    if curves.n_cells:
        shape.add_mesh(curves.tube(radius=0.16 * radius, n_sides=8), color=scene.GREEN, lighting=False)
        legend.append((scene.GREEN, "separatrix, for one bounding-box diagonal at most"))
    for sign, colour, word in ((1, scene.VERMILLION, "positive"), (-1, scene.BLUE, "negative")):
        centres = np.array([s.position for s in problem.singularities.points if s.index * sign > 0])
        if len(centres):
            shape.add_mesh(spheres(centres, radius), color=colour, smooth_shading=True, ambient=0.3)
            legend.append((colour, f"singular point, {word} index"))
    three_quarter_view(shape, points)
    return Picture(
        "Cross field on the surface", captions.of_surface(problem.singularities), scene.render(shape), legend
    )


def singular_curves(result: AnalysedField) -> Picture:
    """Tubes along the singular curves (smoothed), by type, inside the translucent surface; what no hex mesh has."""
    graph = result.singular_graph
    kinds = {kind_of(int(turns)) for turns in graph.curve_quarter_turns}
    legend = [TURNS[kind] for kind in TURNS if kind in kinds] + [(scene.CURVE, "feature curve")] * (
        len(result.features.edges) > 0
    )
    if len(graph.nodes):
        legend.append((scene.INK, "node: three or four curves meet"))
    bad = bad_features(result.tets, result.boundary_meshability)
    if bad is not None:
        legend.append((scene.ORANGE, "feature edge that no hex mesh has"))
    shape = singular_scene(result.surface, result.features, graph, bad)
    return Picture("Singular curves", captions.of_curves(result.record), scene.render(shape), legend)


def streamlines(result: AnalysedField) -> Picture:
    """Curves along the axes of the frames, and the singular curves that end them."""
    points = np.asarray(result.surface.vertices)
    radius = 0.0025 * scene.diagonal(points)
    shape = glass(scene.surface_mesh(result.surface))
    scene.add_features(shape, result.surface, result.features, 3)
    lines = polylines([line.points for line in result.streamlines if len(line.points) > 1])
    if lines.n_cells:
        shape.add_mesh(lines.tube(radius=radius, n_sides=6), color=scene.SKY, smooth_shading=True, ambient=0.3)
    add_curves(shape, curves_by_kind(result.singular_graph), 1.5 * radius)
    three_quarter_view(shape, points)
    kinds = {kind_of(int(turns)) for turns in result.singular_graph.curve_quarter_turns}
    legend = [(scene.SKY, "streamline"), *(TURNS[kind] for kind in TURNS if kind in kinds)]
    counts = result.record.streamlines
    return Picture(
        "Streamlines", "" if counts is None else captions.of_streamlines(counts), scene.render(shape), legend
    )


def frames_on_cut(result: AnalysedField) -> Picture:
    """The shape cut through its middle, with a small cube for the frame of every vertex near the cut."""
    points, surface = np.asarray(result.tets.vertices), scene.surface_mesh(result.surface)
    grid = pyvista.UnstructuredGrid({pyvista.CellType.TETRA: np.asarray(result.tets.tets)}, points)
    axes = scene.principal_axes(np.asarray(result.surface.vertices))
    middle = (points.min(0) + points.max(0)) / 2
    cuts = [grid.slice(normal=axis, origin=middle) for axis in axes]
    best = int(np.argmax([cut.area if cut.n_cells else 0 for cut in cuts]))
    normal, cut = axes[best], cuts[best]
    spacing = float(_core.mean_edge_length(result.surface))
    near = np.flatnonzero(np.abs((points - middle) @ normal) < 0.5 * spacing)
    centres = points[near] - np.outer((points[near] - middle) @ normal, normal)
    if len(near):
        apart = _spread(centres, max(0.8 * spacing, np.sqrt(cut.area / MOST_CUBES)))
        near, centres = near[apart], centres[apart]
    shape = scene.plotter()
    behind = surface.clip(normal=normal, origin=middle, invert=True)
    if behind.n_cells:
        scene.add_body(shape, behind)
    shape.add_mesh(cut, color=CUT, lighting=False)
    outline = surface.slice(normal=normal, origin=middle)
    scene.add_features(shape, result.surface, result.features, 2.5, behind=(normal, middle))
    shape.add_mesh(outline, color=scene.INK, line_width=4, lighting=False)
    if len(near):
        cubes = _cubes(centres, np.asarray(result.frames)[near], 0.6 * spacing)
        shape.add_mesh(
            cubes, color=scene.SKY, show_edges=True, edge_color=scene.INK, line_width=2, ambient=0.35, specular=0
        )
    visible = np.concatenate([np.asarray(behind.points), centres]) if behind.n_cells else points
    other = [axes[k] for k in range(3) if k != best]
    scene.look(shape, visible, normal + 0.28 * other[0] + 0.42 * other[1], other[1])
    words = (
        "for the frames of vertices within half an edge length of the cut, moved onto it, one where several would"
        " overlap"
    )
    caption = (
        f"The shape is cut through the centre of its bounding box, with {captions.counted(len(near), 'cube')} {words}."
    )
    return Picture("Frames on a cut", caption, scene.render(shape), [(scene.SKY, "frame"), (CUT, "cut")])


def _crosses(field: DirectionField) -> pyvista.PolyData:
    surface = field.domain
    corners = surface.vertices[surface.triangles]
    normals = surface.normals
    directions = np.asarray(_core.triangle_directions(field))
    total = float(np.asarray(_core.triangle_areas(surface.mesh)).sum())
    spacing = max(np.sqrt(total / MOST_CROSSES), 0.75 * surface.mean_edge_length)
    chosen = _spread(corners.mean(axis=1), spacing)
    centres = corners[chosen].mean(axis=1) + 0.06 * spacing * normals[chosen]
    first, second = directions[chosen], np.cross(normals[chosen], directions[chosen])
    arms = 0.46 * spacing * np.concatenate([first, second])
    both = np.concatenate([centres, centres])
    return scene.segments(both - arms, both + arms)


def _spread(points: np.ndarray, spacing: float) -> np.ndarray:
    """Ids of points of which no two are closer than `spacing`, greedily in the order given."""
    cells = np.floor((points - points.min(0)) / spacing).astype(int)
    taken: dict[tuple[int, ...], list[int]] = {}
    offsets = [(i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)]
    chosen = []
    for number, (point, (x, y, z)) in enumerate(zip(points, cells.tolist())):
        near = [other for i, j, k in offsets for other in taken.get((x + i, y + j, z + k), ())]
        if not near or ((points[near] - point) ** 2).sum(axis=1).min() >= spacing**2:
            chosen.append(number)
            taken.setdefault((x, y, z), []).append(number)
    return np.array(chosen, dtype=int)


def _cubes(centres: np.ndarray, quaternions: np.ndarray, size: float) -> pyvista.PolyData:
    """One cube per frame, its edges along the columns of R(quaternion w x y z)."""
    w, x, y, z = quaternions.T
    rotations = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    ).transpose(2, 0, 1)
    corners = np.array([[i, j, k] for k in (-1, 1) for j in (-1, 1) for i in (-1, 1)]) * (size / 2)
    faces = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
    points = centres[:, None, :] + np.einsum("nij,cj->nci", rotations, corners)
    cells: np.ndarray = faces[None] + 8 * np.arange(len(centres))[:, None, None]
    cubes: pyvista.PolyData = pyvista.PolyData.from_regular_faces(points.reshape(-1, 3), cells.reshape(-1, 4))
    return cubes
