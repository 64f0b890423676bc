"""Hex-dominant meshes cut open: hexahedra coloured by their scaled Jacobians, other cells plain, singular curves."""

from pathlib import Path

import numpy as np
import pyvista

from .._core import MixedMesh, SingularGraph
from ..errors import IoError
from ..meshes.vtk.vtu import read_vtu
from . import scene
from .curves import add_curves, curves_by_kind, curves_of_file
from .datasets import cell_grid

_VIEW = np.array([-0.45, -0.75, 0.62])  # from the middle towards the eye, in the shape's principal axes
OTHERS = "#e9b3a4"
_COLOURS = "viridis"


def hex_scene(mesh: MixedMesh, scaled_jacobians: np.ndarray, graph: SingularGraph | None) -> pyvista.Plotter:
    """Cells behind a plane through the middle, whole ones. Singular curves in front of it are shown, too."""
    grid = cell_grid(mesh)
    grid.cell_data["scaled_jacobian"] = scaled_jacobians
    return _drawn(grid, {} if graph is None else curves_by_kind(graph))


def scene_of_folder(folder: Path) -> pyvista.Plotter:
    """The same from mesh.vtu and singular.vtp of a result."""
    path = folder / "mesh.vtu"
    read_vtu(path.read_bytes(), str(path))  # VTK ends the process where a count is wrong
    grid = pyvista.read(path)
    if not isinstance(grid, pyvista.UnstructuredGrid) or "scaled_jacobian" not in grid.cell_data:
        raise IoError(f"{path}: no cells with scaled Jacobians; give a result of octafield hex-dominant")
    curves = curves_of_file(folder / "singular.vtp")[0] if (folder / "singular.vtp").is_file() else {}
    return _drawn(grid, curves)


def _drawn(grid: pyvista.UnstructuredGrid, curves: dict[int, pyvista.PolyData | None]) -> pyvista.Plotter:
    points = np.asarray(grid.points)
    axes = scene.principal_axes(points)
    direction = _VIEW @ axes
    kept = _behind(grid, points, axes)
    shape = scene.plotter()
    hexahedra = kept.celltypes == pyvista.CellType.HEXAHEDRON
    if hexahedra.any():
        shape.add_mesh(
            _skin(kept.extract_cells(hexahedra)),
            scalars="scaled_jacobian",
            clim=(0, 1),
            cmap=_COLOURS,  # type: ignore[arg-type]
            show_edges=True,
            edge_color=scene.INK,
            ambient=0.45,
            specular=0,
            scalar_bar_args={"title": "scaled Jacobian of hexahedra", "color": scene.INK, "n_labels": 2},
        )
    if not hexahedra.all():
        shape.add_mesh(
            _skin(kept.extract_cells(~hexahedra)),
            color=OTHERS,
            show_edges=True,
            edge_color=scene.GREY,
            ambient=0.45,
            specular=0,
        )
    outline = grid.extract_surface(algorithm=None).extract_feature_edges(35, boundary_edges=False)
    if outline.n_cells:
        shape.add_mesh(outline, color=scene.CURVE, line_width=2, lighting=False)
    add_curves(shape, curves, 0.006 * scene.diagonal(points))
    scene.look(shape, points, direction, axes[2])
    if hexahedra.any():
        shape.camera.Zoom(0.88)
        shape.camera.SetWindowCenter(0, -0.12)  # above the bar of colours
    return shape


def _behind(grid: pyvista.UnstructuredGrid, points: np.ndarray, axes: np.ndarray) -> pyvista.UnstructuredGrid:
    """The cells of the half away from the eye, across the second axis."""
    centres = np.asarray(grid.cell_centers().points) @ axes[1]
    middle = ((points @ axes[1]).max() + (points @ axes[1]).min()) / 2
    kept: pyvista.UnstructuredGrid = grid.extract_cells(centres >= middle - 1e-9 * scene.diagonal(points))
    return kept


def _skin(grid: pyvista.UnstructuredGrid) -> pyvista.PolyData:
    surface: pyvista.PolyData = grid.extract_surface(algorithm=None)
    return surface
