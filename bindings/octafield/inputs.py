"""Reading what octafield works on: closed surfaces and tetrahedral meshes, gzipped or not."""

import contextlib
import gzip
import shutil
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from . import _core
from ._core import BoundarySurface, TetMesh, TriangleMesh
from .errors import GeometryError, InvalidInput, IoError, SolverError
from .output import require_utf8, scratch_folder

SURFACE_SUFFIXES = (".stl", ".obj", ".off", ".ply")
GRID_SUFFIXES = (".vtk", ".vtu", ".msh", ".mesh")
_SIDES = {"triangle": [[0, 1, 2]], "quad": [[0, 1, 2], [0, 2, 3]], "pixel": [[0, 1, 3], [0, 3, 2]]}  # as triangles
_VOLUMES = ("tetra", "hexahedron", "wedge", "pyramid", "penta", "voxel", "polyhedron")  # meshio's names begin so
_LOWER = ("vertex", "line", "triangle")


@dataclass
class Input:
    """What a file held, before any test of its soundness.

    surface: the triangles, or the boundary of the tets. boundary: the same with the map to tet vertices. lines: (n, 2)
    feature edges given by the file, vertex ids of `surface`; None when it has no line cells. notes: what was changed in
    reading (tets turned over, unused points dropped), one sentence each.
    """

    name: str
    surface: TriangleMesh
    tets: TetMesh | None = None
    boundary: BoundarySurface | None = None
    lines: np.ndarray | None = None
    ignored_lines: int = 0
    notes: list[str] = field(default_factory=list)

    @property
    def kind(self) -> str:
        return "surface" if self.tets is None else "tets"

    def lines_are_features(self) -> bool:
        """Line cells mark features (none where all are seams) unless they list the edges of the mesh itself, as Medit
        files often do."""
        return self.lines is not None and len(self.lines) < 0.5 * 1.5 * len(self.surface.triangles)


def read_input(path: str | Path) -> Input:
    """Reads a surface (STL, OBJ, OFF, PLY) or a tet mesh (.vtk, .vtu, .msh, .mesh; triangles alone are a surface),
    each also as .gz. Raises IoError naming the file, InvalidInput where it holds neither tets nor triangles."""
    path = Path(path)
    require_utf8(path)
    if path.is_dir():
        raise IoError(f"{path}: is a folder; give a file")
    with naming(str(path)):
        return _read(path)


@contextlib.contextmanager
def naming(name: str) -> Iterator[None]:
    """Puts the input's name before the message of an error about it that does not have it yet."""
    try:
        yield
    except (GeometryError, InvalidInput, SolverError) as error:
        if name in str(error):
            raise
        raise type(error)(f"{name}: {error}", error.kind, error.elements) from error


def _read(path: Path) -> Input:
    suffix = _suffix(path)
    if suffix in SURFACE_SUFFIXES:
        return Input(str(path), _core.read_surface(path))
    if suffix not in GRID_SUFFIXES:
        surfaces, tets = " ".join(SURFACE_SUFFIXES), " ".join(GRID_SUFFIXES)
        raise IoError(
            f"{path}: unknown kind of file; known are surfaces ({surfaces}) and tet meshes ({tets}), also .gz"
        )
    points, cells, faces = _read_grid(path, suffix)
    _refuse({kind: len(c) for kind, c in cells.items() if kind.startswith(_VOLUMES) and kind != "tetra"})
    others = {kind: len(c) for kind, c in cells.items() if kind != "tetra" and kind not in _LOWER}
    if "tetra" in cells:
        found = _tet_input(str(path), points, cells, faces)
        found.notes += [f"{count} cells of type {kind} were left out" for kind, count in others.items()]
        return found
    _refuse({kind: count for kind, count in others.items() if not kind.startswith(("line", "VTK_LAGRANGE_CURVE"))})
    if "triangle" in cells:
        found = _surface_input(str(path), points, cells, faces)
        found.notes += [f"{count} cells of type {kind} were left out" for kind, count in others.items()]
        return found
    kinds = ", ".join(sorted(cells)) or "none"
    raise InvalidInput(f"{path}: holds neither tetrahedra nor triangles (cell types: {kinds}); linear ones are needed")


def _refuse(counts: dict[str, int]) -> None:
    """Leaving cells out would leave a hole in the domain."""
    if counts:
        listed = ", ".join(f"{count} of type {kind}" for kind, count in counts.items())
        raise InvalidInput(
            f"holds cells that are not used: {listed}; linear tetrahedra, or triangles and quads of a surface, "
            "are needed: convert the mesh",
            "unsupported_cells",
        )


def from_mesh(mesh: TriangleMesh | TetMesh) -> Input:
    """Input made from a mesh in memory."""
    if isinstance(mesh, TriangleMesh):
        return Input("mesh in memory", mesh)
    if isinstance(mesh, TetMesh):
        return _tet_input("mesh in memory", np.asarray(mesh.vertices), {"tetra": np.asarray(mesh.tets)})
    raise InvalidInput(f"a path, TriangleMesh or TetMesh is needed, not {type(mesh).__name__}")


def _suffix(path: Path) -> str:
    name = path.name.lower()
    return Path(name.removesuffix(".gz")).suffix


def _read_grid(path: Path, suffix: str) -> tuple[np.ndarray, dict[str, np.ndarray], np.ndarray | None]:
    """Points, connectivity per meshio cell type, and the CAD face of each triangle where the file tells.

    Readers are called directly: meshio.read exits on failure.
    """
    import meshio

    reader = {".vtk": meshio.vtk, ".vtu": meshio.vtu, ".msh": meshio.gmsh, ".mesh": meshio.medit}[suffix]
    if not path.is_file():
        raise IoError(f"{path}: no such file")
    try:
        if path.name.lower().endswith(".gz"):
            with scratch_folder() as folder:
                plain = folder / f"input{suffix}"
                with gzip.open(path, "rb") as packed, open(plain, "wb") as unpacked:
                    shutil.copyfileobj(packed, unpacked)
                grid = reader.read(str(plain))
        else:
            grid = reader.read(str(path))
    except (gzip.BadGzipFile, EOFError, zlib.error) as error:
        raise IoError(f"{path}: damaged gzip file ({error}); unpack or download it again") from error
    except (Exception, SystemExit) as error:  # meshio raises whatever its parsers run into
        reason = " ".join(str(error).split()) or type(error).__name__
        raise IoError(f"{path}: cannot be read as {suffix} ({reason})") from error
    points = np.zeros((len(grid.points), 3))
    points[:, : grid.points.shape[1]] = grid.points
    blocks = [(block.type, np.asarray(block.data)) for block in grid.cells]
    ids = _face_ids(grid)
    if not any(kind == "tetra" and len(data) for kind, data in blocks):
        blocks, ids = _split_sides(blocks, ids)
    faces = [i for (kind, _), i in zip(blocks, ids, strict=True) if kind == "triangle"] if ids is not None else []
    return points, _joined(blocks), np.concatenate(faces) if faces else None


def _face_ids(grid) -> list[np.ndarray] | None:
    """CAD face (or other entity) of each cell per block: cell data CellEntityIds (HexMe) or gmsh:geometrical.

    -1: unknown, as tag 0 says in gmsh files without geometry.
    """
    for name in ("CellEntityIds", "gmsh:geometrical"):
        if name in grid.cell_data:
            return [np.where(np.ravel(values) > 0, np.ravel(values), -1) for values in grid.cell_data[name]]
    return None


def _split_sides(blocks: list[tuple[str, np.ndarray]], ids: list[np.ndarray] | None) -> tuple[list, list | None]:
    """Quads as two triangles each, with the face of the quad."""
    split, split_ids = [], []
    for number, (kind, data) in enumerate(blocks):
        if kind == "polygon" and data.ndim == 2:
            kind = {3: "triangle", 4: "quad"}.get(data.shape[1], kind)
        corners = _SIDES.get(kind)
        split.append(("triangle", data[:, corners].reshape(-1, 3)) if corners else (kind, data))
        if ids is not None:
            split_ids.append(np.repeat(ids[number], len(corners)) if corners else ids[number])
    return split, split_ids if ids is not None else None


def _joined(blocks: list[tuple[str, np.ndarray]]) -> dict[str, np.ndarray]:
    """Connectivity per cell type. Blocks of one type differ in width for polygons only, which are merely counted."""
    cells: dict[str, list[np.ndarray]] = {}
    for kind, data in blocks:
        if len(data):
            cells.setdefault(kind, []).append(data if kind in (*_LOWER, "tetra") else np.empty((len(data), 0)))
    return {kind: np.concatenate(found).astype(np.int64) for kind, found in cells.items()}


def _compact(points: np.ndarray, cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Keeps the points that `cells` use: new points and, per old point, its new id or -1."""
    if cells.min() < 0 or cells.max() >= len(points):
        raise InvalidInput(
            f"a cell names point {int(cells.max())}, but there are {len(points)} points", "index_out_of_range"
        )
    used = np.zeros(len(points), bool)
    used[cells] = True
    new_id = np.where(used, np.cumsum(used) - 1, -1)
    return points[used], new_id


def _tet_input(name: str, points: np.ndarray, cells: dict[str, np.ndarray], faces: np.ndarray | None = None) -> Input:
    points_used, new_id = _compact(points, cells["tetra"])
    tets = new_id[cells["tetra"]]
    notes = []
    if len(points_used) < len(points):
        notes.append(f"{len(points) - len(points_used)} points that no tet uses were left out")
    origin = points_used[tets[:, 0]]
    inverted = np.linalg.det(points_used[tets[:, 1:]] - origin[:, None, :]) < 0
    if inverted.any():
        tets[inverted] = tets[inverted][:, [0, 1, 3, 2]]
        notes.append(f"{int(inverted.sum())} of {len(tets)} tets were turned over to positive volume")
    mesh = TetMesh(points_used, tets.astype(np.int32))
    _core.require_valid(mesh)
    boundary = _core.boundary_surface(mesh)
    found = Input(name, boundary.mesh, mesh, boundary, notes=notes)
    if "line" in cells:
        to_boundary = np.full(len(points_used), -1)
        to_boundary[np.asarray(boundary.vertex_map)] = np.arange(len(boundary.mesh.vertices))
        to_boundary = np.append(to_boundary, -1)[new_id]  # from points of the file; -1: none
        _take_lines(found, to_boundary, cells, faces)
    return found


def _surface_input(name: str, points: np.ndarray, cells: dict[str, np.ndarray], faces: np.ndarray | None) -> Input:
    points_used, new_id = _compact(points, cells["triangle"])
    found = Input(name, TriangleMesh(points_used, new_id[cells["triangle"]].astype(np.int32)))
    if "line" in cells:
        _take_lines(found, new_id, cells, faces)
    return found


def _take_lines(found: Input, to_surface: np.ndarray, cells: dict[str, np.ndarray], faces: np.ndarray | None) -> None:
    """Sets found.lines to the line cells that are edges of the surface, each once, seams left out.

    A seam is an edge with one CAD face on both sides: it marks no crease. to_surface: surface vertex of each point of
    the file, -1 where there is none.
    """
    lines = np.sort(to_surface[cells["line"]], axis=1)
    lines = np.unique(lines[lines[:, 0] >= 0], axis=0)
    count = len(found.surface.vertices)
    triangles = np.asarray(found.surface.triangles).astype(np.int64)
    keys, first, second, sides = _edges_with_faces(triangles, _face_of(triangles, to_surface, cells, faces), count)
    place = np.searchsorted(keys, lines[:, 0] * count + lines[:, 1])
    place[place == len(keys)] = 0
    exists = keys[place] == lines[:, 0] * count + lines[:, 1]
    seam = exists & (first[place] == second[place]) & (first[place] > 0) & (sides[place] > 1)
    if seam.any():
        found.notes.append(f"{int(seam.sum())} seam edges, with one CAD face on both sides, are not taken as features")
    found.lines = lines[exists & ~seam].astype(np.int32)
    found.ignored_lines = int((~exists).sum()) + len(cells["line"]) - len(lines)


def _face_of(triangles: np.ndarray, to_surface: np.ndarray, cells: dict, faces: np.ndarray | None) -> np.ndarray:
    """CAD face of each surface triangle: that of the triangle cell with the same vertices, -1 where there is none."""
    result = np.full(len(triangles), -1)
    if faces is None or "triangle" not in cells:
        return result
    told = np.sort(to_surface[cells["triangle"]], axis=1)
    both, inverse = np.unique(np.concatenate([told, np.sort(triangles, axis=1)]), axis=0, return_inverse=True)
    face = np.full(len(both), -1)
    face[inverse.ravel()[: len(told)]] = faces
    return face[inverse.ravel()[len(told) :]]


def _edges_with_faces(triangles: np.ndarray, face: np.ndarray, count: int) -> tuple[np.ndarray, ...]:
    """Keys low * count + high of all edges, ascending, with the lowest and highest face id beside each and the number
    of triangles there."""
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    keys, inverse = np.unique(sides[:, 0] * count + sides[:, 1], return_inverse=True)
    beside = np.tile(face, 3)
    low, high = np.full(len(keys), np.iinfo(np.int64).max), np.full(len(keys), -1)
    np.minimum.at(low, inverse.ravel(), beside)
    np.maximum.at(high, inverse.ravel(), beside)
    return keys, low, high, np.bincount(inverse.ravel())
