"""Meshes and results to and from the objects of other libraries: pyvista, meshio, scipy.sparse, pandas.

    >>> import octafield
    >>> from octafield.domain.generators import generate
    >>> result = octafield.compute_field(generate("box"))
    >>> grid = octafield.to_pyvista(result)  # tets with the axes of the frames
    >>> sorted(grid.point_data)
    ['frame_u', 'frame_v', 'frame_w', 'quaternion', 'sh4']
    >>> tets = octafield.from_pyvista(grid)  # back: a TetMesh (or TriangleMesh)
    >>> len(tets.tets) == len(result.tets.tets)
    True
    >>> octafield.to_meshio(result.tets).write("part.vtu")

    >>> octafield.to_scipy(result.tets).shape == (len(tets.vertices),) * 2  # the graph of the edges, with their lengths
    True

    octafield.to_pandas(result)  # one line per record; needs pandas

Matrices (`octafield.volume.stiffness`, `octafield.volume.mass`, `Sampling.stiffness`) are scipy.sparse already, and
`octafield.volume.Sampling` takes one of your own; arrays of every object are numpy's.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from .. import _core
from .._core import BoundarySurface, FrameStreamline, SingularGraph, Streamline, TetDomain, TetMesh, TriangleMesh
from ..errors import InvalidInput
from ..fields.analysed import AnalysedField
from ..fields.direction_field import FieldOnSurface
from ..fields.probes import put_frames, put_stretched_frames
from ..meshes.topology import unique_edges
from ..view.datasets import polylines

if TYPE_CHECKING:
    import meshio
    import pandas
    import pyvista
    import scipy.sparse

    from ..runs.compare import Comparison

__all__ = ["from_meshio", "from_pandas", "from_pyvista", "to_meshio", "to_pandas", "to_pyvista", "to_scipy"]


def to_pyvista(
    value: TriangleMesh
    | BoundarySurface
    | TetMesh
    | TetDomain
    | SingularGraph
    | AnalysedField
    | FieldOnSurface
    | Sequence[Streamline]
    | Sequence[FrameStreamline],
) -> pyvista.PolyData | pyvista.UnstructuredGrid:
    """A dataset of pyvista: triangles or tets with the arrays of results, the curves of a singular graph, or
    streamlines.

    AnalysedField, FieldResult: point data frame_u, frame_v, frame_w (the axes, unit vectors), quaternion (w x y z) and
        sh4 (9); cell data of the same names where the field lives in the tets, axes_agree (1 or 0), and region where
        there are several. Where the axes are not at right angles, rotation (w x y z), stretch (6) and frame_lengths (3)
        take the place of quaternion and sh4. Axes are labelled vertex by vertex: slices, clips, probes and stream
        tracers of VTK interpolate them, and mix different axes in the tets where axes_agree is 0. Threshold these away,
        or use octafield.slice_frames, sample_frames and frame_streamlines, which interpolate sh4 or match the axes.
        SurfaceFieldResult: point data direction, and its vertex_data. SingularGraph: one polyline per curve with cell
        data quarter_turns (+1: valence 3, -1: valence 5, 4 less the valence in general; 0: complex). Streamlines: one
        polyline each with cell data length. Raises InvalidInput for anything else.

        >>> import octafield
        >>> from octafield.domain.generators import generate
        >>> octafield.to_pyvista(generate("box")).n_cells
        12
    """
    import pyvista

    if isinstance(value, BoundarySurface):
        value = value.mesh
    if isinstance(value, TriangleMesh):
        faces: Any = np.array(value.triangles)
        surface: pyvista.PolyData = pyvista.PolyData.from_regular_faces(np.array(value.vertices), faces)
        return surface
    if isinstance(value, (TetMesh, TetDomain)):
        return pyvista.UnstructuredGrid({pyvista.CellType.TETRA: np.array(value.tets)}, np.array(value.vertices))
    lines: pyvista.PolyData
    if isinstance(value, SingularGraph):
        points = np.asarray(value.points)
        lines = polylines([points[np.asarray(curve)] for curve in value.curves])
        lines.cell_data["quarter_turns"] = np.array(value.curve_quarter_turns, np.int32)
        return lines
    if isinstance(value, FieldOnSurface):
        return value.dataset()
    if isinstance(value, AnalysedField):
        grid = to_pyvista(value.tets)
        sites = [(grid.point_data, value.frames)]
        if value.tet_frames is not None:
            sites.append((grid.cell_data, value.tet_frames))
        for data, frames in sites:
            if value.stretch is None:
                put_frames(data, frames)
            else:
                put_stretched_frames(data, frames, value.stretch)
        grid.cell_data["axes_agree"] = np.asarray(_core.axes_agree(value.tets, value.frames))
        if value.regions is not None:
            grid.cell_data["region"] = np.asarray(value.regions)
        return grid
    if isinstance(value, Sequence) and all(isinstance(line, (Streamline, FrameStreamline)) for line in value):
        lines = polylines([np.asarray(line.points) for line in value])
        lines.cell_data["length"] = np.array([line.length for line in value], float)
        return lines
    raise InvalidInput(
        f"to_pyvista takes meshes, results, singular graphs and streamlines, not {type(value).__name__}", "bad_type"
    )


def from_pyvista(dataset: pyvista.DataSet) -> TriangleMesh | TetMesh:
    """A TetMesh where the dataset has tets, else a TriangleMesh of its triangles (polygons are cut into triangles).
    Points are kept as they are, unused ones too. Raises InvalidInput where there are other volume cells or no cells of
    either kind.

        >>> import octafield, pyvista
        >>> octafield.from_pyvista(pyvista.Box(bounds=(0, 1, 0, 1, 0, 1)).clean())
        TriangleMesh(8 vertices, 12 triangles, box [0, 1] x [0, 1] x [0, 1])
    """
    import pyvista

    if isinstance(dataset, pyvista.PolyData):
        return _triangles(dataset)
    grid = dataset.cast_to_unstructured_grid()
    cells = grid.cells_dict
    volumes = {int(kind): ids for kind, ids in cells.items() if pyvista.CellType(int(kind)).name not in _FLAT}
    if list(volumes) == [int(pyvista.CellType.TETRA)]:
        return TetMesh(np.array(grid.points, float), np.array(volumes[int(pyvista.CellType.TETRA)], np.int32))
    if volumes:
        names = ", ".join(sorted(pyvista.CellType(kind).name.lower() for kind in volumes))
        raise InvalidInput(f"the dataset has cells of kind {names}; frame fields need tets only", "not_tets")
    return _triangles(grid.extract_surface(algorithm=None))


_FLAT = (
    "EMPTY_CELL",
    "VERTEX",
    "POLY_VERTEX",
    "LINE",
    "POLY_LINE",
    "TRIANGLE",
    "TRIANGLE_STRIP",
    "POLYGON",
    "PIXEL",
    "QUAD",
)


def _triangles(surface: pyvista.PolyData) -> TriangleMesh:
    flat = surface.triangulate() if surface.n_cells and not surface.is_all_triangles else surface
    if flat.faces is None or not len(flat.faces):
        raise InvalidInput("the dataset has no triangles and no tets", "no_cells")
    return TriangleMesh(np.array(flat.points, float), flat.faces.reshape(-1, 4)[:, 1:].astype(np.int32))


def to_meshio(value: TriangleMesh | TetMesh | TetDomain | AnalysedField) -> meshio.Mesh:
    """A meshio.Mesh; of a field (AnalysedField, FieldResult) with the data of to_pyvista. Raises InvalidInput for
    anything else.

    >>> import octafield
    >>> from octafield.domain.generators import generate
    >>> octafield.to_meshio(generate("box")).cells_dict["triangle"].shape
    (12, 3)
    """
    import meshio

    if isinstance(value, TriangleMesh):
        return meshio.Mesh(np.array(value.vertices), [("triangle", np.array(value.triangles))])
    if isinstance(value, (TetMesh, TetDomain)):
        return meshio.Mesh(np.array(value.vertices), [("tetra", np.array(value.tets))])
    if isinstance(value, AnalysedField):
        grid = to_pyvista(value)
        mesh = to_meshio(value.tets)
        mesh.point_data = {name: np.asarray(grid.point_data[name]) for name in grid.point_data}
        mesh.cell_data = {name: [np.asarray(grid.cell_data[name])] for name in grid.cell_data}
        return mesh
    raise InvalidInput(f"to_meshio takes meshes and results, not {type(value).__name__}", "bad_type")


def from_meshio(mesh: meshio.Mesh) -> TriangleMesh | TetMesh:
    """A TetMesh of the cells of kind tetra where there are any, else a TriangleMesh of those of kind triangle. Raises
    InvalidInput where there are neither.

        >>> import meshio, octafield
        >>> octafield.from_meshio(meshio.Mesh([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]], [("triangle", [[0, 1, 2]])]))
        TriangleMesh(3 vertices, 1 triangle, box [0, 1] x [0, 1] x [0, 0])
    """
    for kind, make in (("tetra", TetMesh), ("triangle", TriangleMesh)):
        blocks = [block.data for block in mesh.cells if block.type == kind]
        if blocks:
            return make(np.array(mesh.points, float), np.concatenate(blocks).astype(np.int32))
    raise InvalidInput("the mesh has no cells of kind tetra or triangle", "no_cells")


def to_scipy(value: TriangleMesh | TetMesh | TetDomain | SingularGraph | AnalysedField) -> scipy.sparse.csr_array:
    """A graph as a scipy.sparse matrix, for scipy.sparse.csgraph. Meshes: (n, n) symmetric, the length (input unit) of
    the edge between two vertices. SingularGraph: the same between its points, along its curves. AnalysedField,
    FieldResult: int32 entry (a, b), a < b, of each edge of its tets: the element of octahedral_group() that brings the
    frame of a closest to that of b (octafield.frames.matching); the identity, 0, is stored too. Raises InvalidInput for
    anything else.

        >>> import octafield, scipy.sparse.csgraph
        >>> from octafield.domain.generators import generate
        >>> graph = octafield.to_scipy(generate("box"))
        >>> scipy.sparse.csgraph.connected_components(graph, directed=False)[0]
        1
    """
    import scipy.sparse

    if isinstance(value, AnalysedField):
        edges = unique_edges(value.tets.tets)
        numbers = np.asarray(_core.matching(value.frames[edges[:, 0]], value.frames[edges[:, 1]]), np.int32)
        size = len(value.tets.vertices)
        return scipy.sparse.csr_array((numbers, (edges[:, 0], edges[:, 1])), shape=(size, size))
    if isinstance(value, SingularGraph):
        points = np.asarray(value.points)
        pairs = [np.column_stack([curve[:-1], curve[1:]]) for curve in map(np.asarray, value.curves)]
        edges = np.unique(np.sort(np.concatenate([np.empty((0, 2), int), *pairs]), axis=1), axis=0)
    elif isinstance(value, (TriangleMesh, TetMesh, TetDomain)):
        points = np.asarray(value.vertices)
        edges = unique_edges(value.triangles if isinstance(value, TriangleMesh) else value.tets)
    else:
        raise InvalidInput(f"to_scipy takes meshes, fields and singular graphs, not {type(value).__name__}", "bad_type")
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    both = np.concatenate([edges, edges[:, ::-1]])
    return scipy.sparse.csr_array((np.tile(lengths, 2), (both[:, 0], both[:, 1])), shape=(len(points), len(points)))


Record = Mapping[str, Any]


def to_pandas(
    records: Sequence[Record] | Record | AnalysedField | FieldOnSurface | Comparison | SingularGraph,
) -> pandas.DataFrame:
    """One line per record: of a result, a list of `result.record`, a Comparison, `octafield.study.rows(folder)`; nested
    numbers are in columns group_name, lists are left out. SingularGraph: one line per curve with quarter_turns, length,
    closed and points. Raises InvalidInput where pandas is not installed.

        >>> import octafield
        >>> from octafield.domain.generators import generate
        >>> result = octafield.compute_field(generate("box"))
        >>> frame = octafield.to_pandas([result.record])  # doctest: +SKIP
        >>> frame[["tets", "energy", "wall_seconds_smooth"]]  # doctest: +SKIP
    """
    try:
        import pandas
    except ImportError as error:
        raise InvalidInput("pandas is not installed; pip install pandas", "no_pandas") from error
    from ..report.numbers.tables import flatten

    if isinstance(records, SingularGraph):
        return pandas.DataFrame(_curve_lines(records), columns=["quarter_turns", "length", "closed", "points"])
    if isinstance(records, (AnalysedField, FieldOnSurface)):
        records = [records.record]
    elif isinstance(records, Mapping):
        records = [records]
    rows = cast("Sequence[Record]", getattr(records, "rows", records))
    return pandas.DataFrame([flatten(dict(record)) for record in rows])


def _curve_lines(graph: SingularGraph) -> list[dict[str, Any]]:
    points = np.asarray(graph.points)
    lines = []
    for curve, turns in zip(graph.curves, np.asarray(graph.curve_quarter_turns).tolist(), strict=True):
        along = points[np.asarray(curve)]
        length = float(np.linalg.norm(np.diff(along, axis=0), axis=1).sum())
        lines.append(
            {"quarter_turns": turns, "length": length, "closed": bool(curve[0] == curve[-1]), "points": len(curve)}
        )
    return lines


_GROUPS = ("feature_alignment_deg", "alignment_deg", "integrability", "wall_seconds", "cpu_seconds")


def from_pandas(frame: pandas.DataFrame) -> list[dict[str, Any]]:
    """The records of a table of to_pandas, or of results.csv: one per line, groups nested again, empty cells left out.
    What the table does not have (lists, versions) is not there.

        >>> import octafield, pandas
        >>> octafield.from_pandas(pandas.DataFrame({"energy": [2.5], "wall_seconds_smooth": [0.1]}))  # doctest: +SKIP
        [{'energy': 2.5, 'wall_seconds': {'smooth': 0.1}}]
    """
    records = []
    for row in frame.to_dict("records"):
        record: dict[str, Any] = {}
        for name, value in row.items():
            if value is None or value != value:
                continue
            group = next((g for g in _GROUPS if str(name).startswith(f"{g}_")), None)
            if group is None:
                record[str(name)] = value
            else:
                record.setdefault(group, {})[str(name).removeprefix(f"{group}_")] = value
        records.append(record)
    return records
