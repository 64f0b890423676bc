"""Meshes and results to and from the objects of other libraries: pyvista, meshio, pandas.

    >>> import octafield
    >>> from octafield.study.generators import generate
    >>> result = octafield.compute_field(generate("box"))
    >>> grid = octafield.to_pyvista(result)  # tets with the axes of the frames
    >>> sorted(grid.point_data)
    ['frame_u', 'frame_v', 'frame_w', 'quaternion']
    >>> tets = octafield.from_pyvista(grid)  # back: a TetMesh (or TriangleMesh)
    >>> len(tets.tets) == len(result.tets.tets)
    True
    >>> octafield.to_meshio(result.tets).write("part.vtu")

    octafield.to_pandas([result.record])  # one line per record; needs pandas

Matrices (`octafield.stiffness`, `octafield.mass`) are scipy.sparse already; arrays of every object are numpy's.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._core import SingularGraph, TetMesh, TriangleMesh
from .errors import InvalidInput
from .pipeline import FieldResult, SurfaceFieldResult
from .results import polylines

if TYPE_CHECKING:
    import meshio
    import pandas
    import pyvista

__all__ = ["from_meshio", "from_pyvista", "to_meshio", "to_pandas", "to_pyvista"]


def to_pyvista(
    value: TriangleMesh | TetMesh | SingularGraph | FieldResult | SurfaceFieldResult,
) -> pyvista.PolyData | pyvista.UnstructuredGrid:
    """A dataset of pyvista: triangles or tets with the arrays of results, or the curves of a singular graph.

    FieldResult: point data frame_u, frame_v, frame_w (the axes, unit vectors) and quaternion (w x y z); cell data region
    where there are several. SurfaceFieldResult: point data direction. SingularGraph: one polyline per curve with cell data
    quarter_turns (+1: valence 3, -1: valence 5, 0: complex).
    """
    import pyvista

    if isinstance(value, TriangleMesh):
        return pyvista.PolyData.from_regular_faces(np.array(value.vertices), np.array(value.triangles))
    if isinstance(value, TetMesh):
        return pyvista.UnstructuredGrid({pyvista.CellType.TETRA: np.array(value.tets)}, np.array(value.vertices))
    if isinstance(value, SingularGraph):
        points = np.asarray(value.points)
        lines = polylines([points[np.asarray(curve)] for curve in value.curves])
        lines.cell_data["quarter_turns"] = np.array(value.curve_quarter_turns, np.int32)
        return lines
    if isinstance(value, SurfaceFieldResult):
        surface = to_pyvista(value.surface)
        surface.point_data["direction"] = np.array(value.directions)
        return surface
    if isinstance(value, FieldResult):
        grid = to_pyvista(value.tets)
        axes = np.asarray(_core.rotation_matrices(value.frames))
        for k, name in enumerate(("frame_u", "frame_v", "frame_w")):
            grid.point_data[name] = np.ascontiguousarray(axes[:, :, k])
        grid.point_data["quaternion"] = np.array(value.frames)
        if value.regions is not None:
            grid.cell_data["region"] = np.asarray(value.regions)
        return grid
    raise InvalidInput(f"to_pyvista takes meshes, results and singular graphs, not {type(value).__name__}", "bad_type")


def from_pyvista(dataset: pyvista.DataSet) -> TriangleMesh | TetMesh:
    """A TetMesh where the dataset has tets, else a TriangleMesh of its triangles (polygons are cut into triangles).
    Points are kept as they are, unused ones too. Raises InvalidInput where there are other volume cells or no cells of either kind."""
    import pyvista

    if isinstance(dataset, pyvista.PolyData):
        return _triangles(dataset)
    grid = dataset.cast_to_unstructured_grid()
    cells = grid.cells_dict
    volumes = [kind for kind in cells if pyvista.CellType(kind).name not in _FLAT]
    if [int(kind) for kind in volumes] == [int(pyvista.CellType.TETRA)]:
        return TetMesh(np.array(grid.points, float), np.array(cells[pyvista.CellType.TETRA], np.int32))
    if volumes:
        names = ", ".join(sorted(pyvista.CellType(kind).name.lower() for kind in volumes))
        raise InvalidInput(f"the dataset has cells of kind {names}; frame fields need tets only", "not_tets")
    return _triangles(grid.extract_surface(algorithm=None))


_FLAT = ("EMPTY_CELL", "VERTEX", "POLY_VERTEX", "LINE", "POLY_LINE", "TRIANGLE", "TRIANGLE_STRIP", "POLYGON", "PIXEL", "QUAD")


def _triangles(surface: pyvista.PolyData) -> TriangleMesh:
    flat = surface.triangulate() if surface.n_cells and not surface.is_all_triangles else surface
    if flat.faces is None or not len(flat.faces):
        raise InvalidInput("the dataset has no triangles and no tets", "no_cells")
    return TriangleMesh(np.array(flat.points, float), flat.faces.reshape(-1, 4)[:, 1:].astype(np.int32))


def to_meshio(value: TriangleMesh | TetMesh | FieldResult) -> meshio.Mesh:
    """A meshio.Mesh; of a FieldResult with the point data of to_pyvista."""
    import meshio

    if isinstance(value, TriangleMesh):
        return meshio.Mesh(np.array(value.vertices), [("triangle", np.array(value.triangles))])
    if isinstance(value, TetMesh):
        return meshio.Mesh(np.array(value.vertices), [("tetra", np.array(value.tets))])
    if isinstance(value, FieldResult):
        grid = to_pyvista(value)
        mesh = to_meshio(value.tets)
        mesh.point_data = {name: np.asarray(grid.point_data[name]) for name in grid.point_data}
        mesh.cell_data = {name: [np.asarray(grid.cell_data[name])] for name in grid.cell_data}
        return mesh
    raise InvalidInput(f"to_meshio takes meshes and results, not {type(value).__name__}", "bad_type")


def from_meshio(mesh: meshio.Mesh) -> TriangleMesh | TetMesh:
    """A TetMesh of the cells of kind tetra where there are any, else a TriangleMesh of those of kind triangle."""
    for kind, make in (("tetra", TetMesh), ("triangle", TriangleMesh)):
        blocks = [block.data for block in mesh.cells if block.type == kind]
        if blocks:
            return make(np.array(mesh.points, float), np.concatenate(blocks).astype(np.int32))
    raise InvalidInput("the mesh has no cells of kind tetra or triangle", "no_cells")


def to_pandas(records: Sequence[dict[str, Any]]) -> pandas.DataFrame:
    """One line per record (`result.record`, `Comparison.rows`, `octafield.study.rows`), nested numbers as group_name.
    Lists are left out. Raises InvalidInput where pandas is not installed."""
    try:
        import pandas
    except ImportError as error:
        raise InvalidInput("pandas is not installed; pip install pandas", "no_pandas") from error
    from .report.tables import flatten

    return pandas.DataFrame([flatten(record) for record in records])
