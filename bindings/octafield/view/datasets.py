"""Curves as datasets of pyvista, and datasets of .vtp files."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .._core import MixedMesh, QuadMesh
from ..errors import IoError

if TYPE_CHECKING:
    import pyvista


def polylines(lines: Sequence[np.ndarray]) -> "pyvista.PolyData":
    """Polylines, (n, 3) points each, as the cells of a pyvista.PolyData, in their order."""
    import pyvista

    if not lines:
        return pyvista.PolyData()
    counts = [len(line) for line in lines]
    starts = np.cumsum([0, *counts[:-1]])
    cells = [np.r_[count, np.arange(start, start + count)] for start, count in zip(starts, counts, strict=True)]
    return pyvista.PolyData(np.concatenate(lines), lines=np.concatenate(cells))


def cell_grid(mesh: MixedMesh) -> "pyvista.UnstructuredGrid":
    """A mesh of mixed cells, in the order of their numbers."""
    import pyvista
    from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, VTK_PYRAMID, VTK_TETRA, VTK_WEDGE

    cells, types = [np.zeros(0, np.int64)], [np.zeros(0, np.uint8)]
    for rows, kind in zip(
        (mesh.tets, mesh.hexahedra, mesh.wedges, mesh.pyramids),
        (VTK_TETRA, VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID),
        strict=True,
    ):
        count, corners = rows.shape
        cells.append(np.column_stack([np.full(count, corners), rows]).ravel())
        types.append(np.full(count, kind, np.uint8))
    return pyvista.UnstructuredGrid(np.concatenate(cells), np.concatenate(types), np.array(mesh.vertices))


def quad_grid(mesh: QuadMesh) -> "pyvista.UnstructuredGrid":
    """A surface of quads."""
    import pyvista
    from vtkmodules.vtkCommonDataModel import VTK_QUAD

    quads = np.asarray(mesh.quads)
    cells = np.column_stack([np.full(len(quads), 4), quads]).ravel()
    return pyvista.UnstructuredGrid(cells, np.full(len(quads), VTK_QUAD, np.uint8), np.array(mesh.vertices))


def beginning(points: np.ndarray, length: float) -> np.ndarray:
    """The points of a polyline until it is longer than `length`."""
    run = np.linalg.norm(np.diff(points, axis=0), axis=1).cumsum()
    return points[: 2 + int(np.searchsorted(run, length))]


def read_vtp(path: Path) -> "pyvista.PolyData":
    import pyvista

    from ..meshes.vtk.vtp import read_vtp as checked

    checked(Path(path).read_bytes(), str(path))  # VTK ends the process where a count is wrong
    found = pyvista.read(path)
    if not isinstance(found, pyvista.PolyData):
        raise IoError(f"{path}: holds neither a surface nor curves")
    return found
