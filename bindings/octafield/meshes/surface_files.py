"""Files of triangles alone: STL, OBJ, OFF and PLY in C++, .vtp by VTK."""

from pathlib import Path

import numpy as np

from .. import _core
from .._core import TriangleMesh
from ..errors import IoError
from ..files.reading import plain_name, read_bytes, write_whole
from ..files.scratch import through_file
from ..files.writing import vtp_bytes
from .grids import Grid, grid_of_blocks
from .parts import Parts
from .vtk.vtp import read_vtp


def read_triangles(path: Path) -> TriangleMesh:
    """STL, OBJ, OFF, PLY, by the path's suffix."""
    return _core.read_surface(path)


def write_triangles(path: Path, parts: Parts) -> list[str]:
    """STL, OBJ, OFF, PLY, by the path's suffix."""
    surface = TriangleMesh(parts.points, np.asarray(parts.triangles))
    through_file(path, Path(plain_name(path)).suffix, lambda plain: _core.write_surface(surface, plain))
    return []


def write_stl(path: Path, parts: Parts) -> list[str]:
    """Says what the format does to points."""
    write_triangles(path, parts)
    return ["STL files hold single precision and no vertex ids: points were rounded, equal ones merge on reading"]


def read_vtp_file(path: Path) -> Grid:
    """Triangles and lines."""
    found = read_vtp(read_bytes(path), str(path), path.stat().st_size)
    if not len(found.points):
        raise IoError(f"{path}: holds no points")
    return grid_of_blocks(found.points, [(block.type, block.data) for block in found.cells], None, None)


def write_vtp(path: Path, parts: Parts) -> list[str]:
    """Triangles and lines."""
    import pyvista

    surface = pyvista.PolyData.from_regular_faces(np.array(parts.points), np.array(parts.triangles))
    if parts.lines is not None:
        surface.lines = np.column_stack([np.full(len(parts.lines), 2), parts.lines]).ravel()
    write_whole(path, [vtp_bytes(surface)])
    return []
