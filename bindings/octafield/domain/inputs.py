"""Reading what octafield works on: closed surfaces and tetrahedral meshes, gzipped or not."""

import contextlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .._core import TetDomain, TetMesh, TriangleMesh
from ..errors import GeometryError, InvalidInput, IoError, SolverError
from ..files.writing import require_utf8
from ..meshes.grids import LOWER, Grid
from ..meshes.registry import find_mesh_format, read_mesh_file
from ..progress.phases import Progress

_VOLUMES = ("tetra", "hexahedron", "wedge", "pyramid", "penta", "voxel", "polyhedron")  # meshio's names begin so


class OnTets:
    """What is read off the tets, of an object that may have some."""

    tets: TetDomain | None

    @property
    def interface_triangles(self) -> int:
        """The last so many of the surface."""
        return 0 if self.tets is None else self.tets.interface_triangles

    @property
    def regions(self) -> np.ndarray | None:
        """(m,) region of each tet, where there are several."""
        return None if self.tets is None else regions_of(self.tets)


@dataclass
class Input(OnTets):
    """What a file held, before any test of its soundness.

    surface: the triangles, or the surface of the tets, with interfaces where there are several regions. tets: with no
    features yet; None for surfaces. touches: the boundary of the tets touches itself at edges or vertices. lines:
    (n, 2) feature edges given by the file, vertex ids of `surface`; None when it has no line cells. creases: the file
    tells that they are. faces: CAD face of each triangle of `surface`, -1 where the file tells none.
    surface_points: (n,) ids of the vertices of `surface` among the points of the file; None: the same.
    file_points: (n,) ids of the vertices of `tets` among the points_in_file of the file; file_tets: (m,) of the tets
        among those of the file. of_cad: meshed here, at the edge length asked for. notes: what was changed in reading
        (tets turned over, unused points dropped), one sentence each.
    """

    name: str
    surface: TriangleMesh
    tets: TetDomain | None = None
    lines: np.ndarray | None = None
    ignored_lines: int = 0
    creases: bool = False
    touches: bool = False
    faces: np.ndarray | None = None
    surface_points: np.ndarray | None = None
    file_points: np.ndarray | None = None
    file_tets: np.ndarray | None = None
    points_in_file: int = 0
    of_cad: bool = False
    notes: list[str] = field(default_factory=list)

    @property
    def kind(self) -> str:
        return "surface" if self.tets is None else "tets"

    def volume(self) -> TetDomain:
        """The tets. Raises InvalidInput where the input is a surface."""
        if self.tets is None:
            raise InvalidInput(f"{self.name}: holds triangles; tets are needed", "not_tets")
        return self.tets

    def features_of_tets(self) -> np.ndarray | None:
        """(n, 2) feature edges given by the file, vertex ids of `tets`; None where it has no lines or they are not
        features."""
        if self.lines is None or not self.lines_are_features():
            return None
        features: np.ndarray = np.asarray(self.volume().surface.vertex_map)[self.lines]
        return features

    def lines_are_features(self) -> bool:
        """Line cells mark features (none where all are seams) unless they list the edges of the mesh itself, as Medit
        files often do."""
        if self.lines is None:
            return False
        return self.creases or len(self.lines) < 0.5 * 1.5 * len(self.surface.triangles)


@np.errstate(all="ignore")
def read_input(
    path: str | Path, *, interfaces: bool = True, edge_length: float = 0.0, progress: Progress | None = None
) -> Input:
    """Reads a surface, tet mesh (of triangles alone: a surface) or, where Gmsh is installed, a CAD model, of the kinds
    in octafield.mesh_formats, each also as .gz. Raises IoError naming the file, and the line in text, InvalidInput
    where it holds neither tets nor triangles. interfaces: see MeshOptions.
    edge_length: of the triangles on a CAD model, or tets in it (0: from its size). progress: asked while Gmsh reads
    one; may cancel."""
    path = Path(path)
    require_utf8(path)
    if path.is_dir():
        raise IoError(f"{path}: is a folder; give a file")
    if path.exists() and not path.is_file():
        raise IoError(f"{path}: is a pipe or a device; save it to a file first")
    with naming(str(path)):
        return _read(path, interfaces, edge_length, progress)


@contextlib.contextmanager
def naming(name: str) -> Iterator[None]:
    """Puts the input's name before the message of an error about it that does not have it yet."""
    try:
        yield
    except (GeometryError, InvalidInput, SolverError) as error:
        if name in str(error):
            raise
        raise type(error)(f"{name}: {error}", error.kind, error.elements) from error


def _read(path: Path, interfaces: bool, edge_length: float, progress: Progress | None) -> Input:
    grid = read_mesh_file(path, edge_length, progress)
    if isinstance(grid, TriangleMesh):
        return Input(str(path), grid)
    if not interfaces:
        grid.regions = None
    found = input_of_grid(str(path), grid)
    found.of_cad = find_mesh_format(path).mesh is not None
    return found


@np.errstate(all="ignore")  # what is not finite is refused by name, without NumPy's warning before
def input_of_grid(name: str, grid: Grid) -> Input:
    cells = grid.cells
    _refuse({kind: len(c) for kind, c in cells.items() if kind.startswith(_VOLUMES) and kind != "tetra"})
    others = {kind: len(c) for kind, c in cells.items() if kind != "tetra" and kind not in LOWER}
    if "tetra" in cells:
        found = _tet_input(name, grid)
        found.notes += grid.notes + [f"{count} cells of type {kind} were left out" for kind, count in others.items()]
        return found
    _refuse({kind: count for kind, count in others.items() if not kind.startswith(("line", "VTK_LAGRANGE_CURVE"))})
    if "triangle" in cells:
        found = _surface_input(name, grid)
        found.notes += grid.notes + [f"{count} cells of type {kind} were left out" for kind, count in others.items()]
        return found
    kinds = ", ".join(sorted(cells)) or "none"
    raise InvalidInput(f"{name}: holds neither tetrahedra nor triangles (cell types: {kinds}); linear ones are needed")


def _refuse(counts: dict[str, int]) -> None:
    """Leaving cells out would leave a hole in the domain."""
    if counts:
        listed = ", ".join(f"{count} of type {kind}" for kind, count in counts.items())
        raise InvalidInput(
            f"holds cells that are not used: {listed}; linear tetrahedra, or triangles and quads of a surface, "
            "are needed: convert the mesh",
            "unsupported_cells",
        )


@np.errstate(all="ignore")
def from_mesh(mesh: TriangleMesh | TetMesh | TetDomain) -> Input:
    """Input made from a mesh in memory. Features of a TetDomain are taken as those of a file."""
    if isinstance(mesh, TriangleMesh):
        return Input("mesh in memory", mesh)
    if isinstance(mesh, TetDomain):
        found = Input("mesh in memory", mesh.surface.mesh, mesh, file_tets=np.arange(mesh.tet_count))
        found.file_points, found.points_in_file = np.arange(mesh.vertex_count), mesh.vertex_count
        edges = np.asarray(mesh.features.edges)
        if len(edges):
            found.lines, found.creases = edges, True
        return found
    if isinstance(mesh, TetMesh):
        return _tet_input("mesh in memory", Grid(np.asarray(mesh.vertices), {"tetra": np.asarray(mesh.tets)}))
    raise InvalidInput(f"a path, TriangleMesh, TetMesh or TetDomain is needed, not {type(mesh).__name__}")


def _require_points(cells: dict[str, np.ndarray], count: int) -> None:
    for kind in ("tetra", "triangle", "line"):
        ids = cells.get(kind, np.empty((0, 1), np.int64))
        bad = np.flatnonzero(((ids < 0) | (ids >= count)).any(axis=1))
        if len(bad):
            few = ", ".join(map(str, bad[:5])) + (f" and {len(bad) - 5} more" if len(bad) > 5 else "")
            raise InvalidInput(
                f"cells of type {kind} name points that are not there (cell {few} of these, from 0); there are {count} "
                "points",
                "index_out_of_range",
                bad.tolist(),
            )


def _compact(points: np.ndarray, cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Keeps the points that `cells` use: new points and, per old point, its new id or -1."""
    used = np.zeros(len(points), bool)
    used[cells] = True
    new_id = np.where(used, np.cumsum(used) - 1, -1)
    return points[used], new_id


def _tet_input(name: str, grid: Grid) -> Input:
    points, cells = grid.points, grid.cells
    _require_points(cells, len(points))
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
    domain = domain_of(TetMesh(points_used, tets.astype(np.int32)), grid.regions)
    found = Input(name, domain.surface.mesh, domain, notes=notes, points_in_file=len(points))
    found.file_points = np.flatnonzero(new_id >= 0)
    found.file_tets = np.arange(len(tets)) if grid.file_tets is None else grid.file_tets
    lines = np.append(to_surface_ids(domain), -1)[new_id]
    if grid.faces is not None:
        found.faces = _face_of(np.asarray(found.surface.triangles).astype(np.int64), lines, grid)
    if "line" in cells:
        _take_lines(found, lines, grid)
    return found


def domain_of(mesh: TetMesh, regions: np.ndarray | None) -> TetDomain:
    """regions: (m,) ids; None, or all the same: one region. Raises InvalidInput, GeometryError (unsound mesh)."""
    if regions is None or (regions == regions[0]).all():
        return TetDomain(mesh)
    wide = np.asarray(regions)
    if (wide.astype(np.int32) != wide).any():
        bad = int(np.argmax(wide.astype(np.int32) != wide))
        raise InvalidInput(
            f"tet {bad} (from 0) is of region {wide[bad]}: numbers of regions have 32 bits; number them anew",
            "bad_regions",
            [bad],
        )
    return TetDomain(mesh, regions=wide.astype(np.int32))


def regions_of(domain: TetDomain) -> np.ndarray | None:
    """(m,) ids, None where all tets are one region."""
    regions = np.asarray(domain.regions)
    return regions if len(regions) else None


def feature_edges(domain: TetDomain) -> np.ndarray:
    """(k, 2) int32 vertex ids of the tets: the feature edges of its surface."""
    edges: np.ndarray = np.asarray(domain.surface.vertex_map)[np.asarray(domain.features.edges)]
    return edges.astype(np.int32).reshape(-1, 2)


def to_surface_ids(domain: TetDomain) -> np.ndarray:
    """(n,) vertex of the surface that each vertex of the tets is; -1: none."""
    vertex_map = np.asarray(domain.surface.vertex_map)
    ids: np.ndarray = np.full(domain.vertex_count, -1)
    ids[vertex_map] = np.arange(len(vertex_map))
    return ids


def _surface_input(name: str, grid: Grid) -> Input:
    _require_points(grid.cells, len(grid.points))
    points_used, new_id = _compact(grid.points, grid.cells["triangle"])
    found = Input(name, TriangleMesh(points_used, new_id[grid.cells["triangle"]].astype(np.int32)))
    found.surface_points = np.flatnonzero(new_id >= 0)
    found.faces = grid.faces
    if "line" in grid.cells:
        _take_lines(found, new_id, grid)
    return found


def _take_lines(found: Input, to_surface: np.ndarray, grid: Grid) -> None:
    """Sets found.lines to the line cells that are edges of the surface, each once, seams left out.

    A seam is an edge with one CAD face on both sides: it marks no crease. to_surface: surface vertex of each point of
    the file, -1 where there is none.
    """
    told = grid.cells["line"] if grid.creases is None else grid.cells["line"][grid.creases]
    found.creases = grid.creases is not None
    lines = np.sort(to_surface[told], axis=1)
    lines = np.unique(lines[lines[:, 0] >= 0], axis=0)
    count = len(found.surface.vertices)
    triangles = np.asarray(found.surface.triangles).astype(np.int64)
    keys, first, second, sides = _edges_with_faces(triangles, _face_of(triangles, to_surface, grid), count)
    place = np.searchsorted(keys, lines[:, 0] * count + lines[:, 1])
    place[place == len(keys)] = 0
    exists = keys[place] == lines[:, 0] * count + lines[:, 1]
    seam = exists & (first[place] == second[place]) & (first[place] > 0) & (sides[place] > 1)
    if seam.any():
        found.notes.append(f"{int(seam.sum())} seam edges, with one CAD face on both sides, are not taken as features")
    found.lines = lines[exists & ~seam].astype(np.int32)
    found.ignored_lines = int((~exists).sum()) + len(told) - len(lines)


def _face_of(triangles: np.ndarray, to_surface: np.ndarray, grid: Grid) -> np.ndarray:
    """CAD face of each surface triangle: that of the triangle cell with the same vertices, -1 where there is none."""
    result = np.full(len(triangles), -1)
    if grid.faces is None or "triangle" not in grid.cells:
        return result
    told = np.sort(to_surface[grid.cells["triangle"]], axis=1)
    both, inverse = np.unique(np.concatenate([told, np.sort(triangles, axis=1)]), axis=0, return_inverse=True)
    face = np.full(len(both), -1)
    face[inverse.ravel()[: len(told)]] = grid.faces
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
