"""Block-structured quads on their surface: blocks in colours, edges of quads, sides of blocks, singular points."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyvista

from .._core import QuadMesh
from ..errors import IoError
from ..meshes.vtk.vtu import read_vtu
from . import scene
from .datasets import polylines, quad_grid, read_vtp

# Pale, so that edges and points stand out; neighbours never have the same.
COLOURS = ("#b9d7ea", "#f6d7a7", "#c8e3c0", "#e9c6d8", "#d6cdea", "#f3efb1", "#cfd6dc", "#f0c4b4")

_EDGES = "#56616d"


def quad_scene(
    mesh: QuadMesh,
    blocks: np.ndarray,
    valences: np.ndarray,
    on_boundary: np.ndarray,
    sides: Sequence[np.ndarray] | None,
) -> pyvista.Plotter:
    """valences: quads round each vertex. sides: polylines of the layout; None: edges between quads of two blocks."""
    grid = quad_grid(mesh)
    grid.cell_data["block"] = blocks
    grid.point_data["quads"], grid.point_data["boundary"] = valences, on_boundary
    return _drawn(grid, None if sides is None else polylines(sides))


def is_layout(folder: Path) -> bool:
    """Whether it holds the result of octafield quad-layout."""
    return (folder / "mesh.vtu").is_file() and (folder / "field.vtp").is_file()


def scene_of_folder(folder: Path) -> tuple[pyvista.Plotter, list[str]]:
    """The same from mesh.vtu and layout.vtp of a result, with the names of the files it shows."""
    grid, lines = _read(folder)
    return _drawn(grid, lines), ["mesh.vtu"] if lines is None else ["mesh.vtu", "layout.vtp"]


def jacobian_scene_of_folder(folder: Path) -> pyvista.Plotter:
    """Quads by their scaled Jacobian, from mesh.vtu of a result."""
    return jacobian_scene(_read(folder)[0])


def chart_scene(points: np.ndarray, triangles: np.ndarray, charts: np.ndarray) -> pyvista.Plotter:
    """charts: (t,) of each triangle. Their edges are left out where there are many."""
    shape = scene.plotter()
    _add_in_colours(shape, points, triangles, charts, show_edges=len(triangles) < 10000)
    lines = _between_blocks(points, triangles, charts)
    if lines.n_cells:
        shape.add_mesh(lines.tube(radius=0.0015 * scene.diagonal(points), n_sides=8), color=scene.INK, lighting=False)
    _look(shape, points)
    return shape


def _add_in_colours(
    shape: pyvista.Plotter, points: np.ndarray, faces: np.ndarray, parts: np.ndarray, **edges: float
) -> None:
    """parts: number of the part that each face is of; neighbours get different colours."""
    colours = colours_of(faces, parts)[parts]
    for number, colour in enumerate(COLOURS):
        if (colours == number).any():
            part = pyvista.PolyData.from_regular_faces(points, faces[colours == number])
            shape.add_mesh(part, color=colour, ambient=0.5, diffuse=0.6, specular=0, edge_color=_EDGES, **edges)  # type: ignore[arg-type]


def jacobian_scene(grid: pyvista.UnstructuredGrid) -> pyvista.Plotter:
    """grid: with cell data scaled_jacobian."""
    flat = _is_flat(np.asarray(grid.points))
    shape = scene.plotter()
    shape.add_mesh(
        grid,
        scalars="scaled_jacobian",
        clim=(0, 1),
        cmap="viridis",
        show_edges=True,
        edge_color=_EDGES,
        line_width=_edge_width(grid),
        lighting=not flat,
        ambient=0 if flat else 0.45,  # with diffuse: never brighter than the scale
        diffuse=1 if flat else 0.55,
        specular=0,
        scalar_bar_args={
            "title": "scaled Jacobian\n", "color": scene.INK, "n_labels": 3, "fmt": "%.1f", "vertical": True,
            "position_x": 0.93, "position_y": 0.2, "width": 0.05, "height": 0.6,
        },
    )  # fmt: skip
    _look(shape, np.asarray(grid.points))
    shape.camera.zoom(0.84)  # type: ignore[no-untyped-call]  # room for the scale
    return shape


def _read(folder: Path) -> tuple[pyvista.UnstructuredGrid, pyvista.PolyData | None]:
    """The quads and the sides of blocks."""
    path = folder / "mesh.vtu"
    read_vtu(path.read_bytes(), str(path))  # VTK ends the process where a count is wrong
    grid = pyvista.read(path)
    if (
        not isinstance(grid, pyvista.UnstructuredGrid)
        or not {"block", "scaled_jacobian"} <= set(grid.cell_data)
        or not {"quads", "boundary"} <= set(grid.point_data)
    ):
        raise IoError(f"{path}: no quads in blocks; give a result of octafield quad-layout")
    if not (folder / "layout.vtp").is_file():
        return grid, None
    layout = read_vtp(folder / "layout.vtp")
    if "kind" not in layout.cell_data:
        raise IoError(f"{folder / 'layout.vtp'}: holds no layout; give a result of octafield quad-layout")
    return grid, pyvista.PolyData(np.array(layout.points), lines=np.array(layout.lines))


def _drawn(grid: pyvista.UnstructuredGrid, sides: pyvista.PolyData | None) -> pyvista.Plotter:
    points, quads = np.asarray(grid.points), grid.cells.reshape(-1, 5)[:, 1:]
    shape = scene.plotter()
    size = scene.diagonal(points)
    blocks = np.asarray(grid.cell_data["block"])
    width = _edge_width(grid)
    _add_in_colours(shape, points, quads, blocks, show_edges=True, line_width=width)
    lines = _between_blocks(points, quads, blocks) if sides is None else sides
    if lines.n_cells:
        shape.add_mesh(lines.tube(radius=0.0018 * size, n_sides=8), color=scene.INK, lighting=False)
    index = np.where(np.asarray(grid.point_data["boundary"]) > 0, 2, 4) - np.asarray(grid.point_data["quads"])
    for sign, colour in ((1, scene.VERMILLION), (-1, scene.BLUE)):
        centres = points[index * sign > 0]
        if len(centres):
            balls = pyvista.PolyData(centres).glyph(geom=pyvista.Sphere(radius=0.009 * size), scale=False, orient=False)
            shape.add_mesh(balls, color=colour, smooth_shading=True, ambient=0.4)
    _look(shape, points)
    return shape


def _edge_width(grid: pyvista.UnstructuredGrid) -> float:
    return 1.5 if grid.n_cells < 3000 else 0.8


def _look(shape: pyvista.Plotter, points: np.ndarray) -> None:
    if _is_flat(points):
        scene.look(shape, points, *_from_above(points))
    else:
        scene.three_quarter_view(shape, points)


def _edges_with_quads(quads: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Edges (e, 2), and for each side of a quad, or of a triangle, its edge and its quad."""
    corners = quads.shape[1]
    sides = np.sort(np.concatenate([quads[:, [k, (k + 1) % corners]] for k in range(corners)]), axis=1)
    edges, group = np.unique(sides, axis=0, return_inverse=True)
    return edges, group.reshape(-1), np.tile(np.arange(len(quads)), corners)


def _neighbours(quads: np.ndarray, blocks: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Edges, and (e, 2) the lowest and highest block there; -1 and the block at edges of one quad."""
    edges, group, of_quad = _edges_with_quads(quads)
    low, high = np.full(len(edges), np.iinfo(np.int64).max), np.full(len(edges), -1)
    np.minimum.at(low, group, blocks[of_quad])
    np.maximum.at(high, group, blocks[of_quad])
    low[np.bincount(group) == 1] = -1
    return edges, np.column_stack([low, high])


def _between_blocks(points: np.ndarray, quads: np.ndarray, blocks: np.ndarray) -> pyvista.PolyData:
    edges, beside = _neighbours(quads, blocks)
    kept = edges[beside[:, 0] != beside[:, 1]]
    return scene.segments(points[kept[:, 0]], points[kept[:, 1]])


def colours_of(quads: np.ndarray, blocks: np.ndarray) -> np.ndarray:
    """By block: the first colour that no neighbour before it has, or the one that fewest have."""
    beside: list[set[int]] = [set() for _ in range(int(blocks.max(initial=-1)) + 1)]
    for a, b in np.unique(_neighbours(quads, blocks)[1], axis=0).tolist():
        if 0 <= a != b:
            beside[a].add(b)
            beside[b].add(a)
    colours = np.full(len(beside), -1)
    for block, others in enumerate(beside):
        used = np.bincount([colours[o] for o in others if colours[o] >= 0], minlength=len(COLOURS))
        colours[block] = int(used.argmin())
    return colours


def _is_flat(points: np.ndarray) -> bool:
    values = np.linalg.eigvalsh(np.cov(points.T))
    return bool(values[0] < 1e-12 * values[2])


def _from_above(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where to look at something flat from, and what is up: coordinate axes where they do."""
    normal = np.linalg.eigh(np.cov(points.T))[1][:, 0]
    normal = normal * np.sign(normal[np.abs(normal).argmax()])
    world = np.eye(3)
    up = world[1] if abs(normal[1]) < 0.9 else world[2]
    return normal, up - normal * (normal @ up)
