"""Files of cells: what they hold as arrays, by our own readers (of .vtp VTK's), before any meaning is given to it."""

import contextlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from .binary_medit import read_binary_medit
from ..errors import InvalidInput, IoError
from ..files import read_bytes, read_text
from .gmsh_mesh import read_gmsh
from .legacy_vtk import read_legacy_vtk
from ..output import read_vtp, scratch_folder
from .text_meshes import TextMesh, read_medit, read_tetgen
from .vtu_mesh import FEATURES, read_vtu

if TYPE_CHECKING:
    import meshio

GRID_SUFFIXES = (".vtk", ".vtu", ".vtp", ".msh", ".mesh", ".meshb", ".node", ".ele", ".ovm", ".ovmb")
_READERS = {".vtk": read_legacy_vtk, ".vtu": read_vtu, ".msh": read_gmsh}
MESHIO_SUFFIXES = tuple(_READERS)  # whose readers make objects of meshio's
_SIDES = {"triangle": [[0, 1, 2]], "quad": [[0, 1, 2], [0, 2, 3]], "pixel": [[0, 1, 3], [0, 3, 2]]}  # as triangles
LOWER = ("vertex", "line", "triangle")
Blocks = list[tuple[str, np.ndarray]]  # meshio's cell type and the connectivity
_Read = TypeVar("_Read")


@dataclass
class Grid:
    """Points, connectivity per meshio cell type, and, where the file tells, the CAD face of each triangle, the region
    of each tet and which lines are creases (all, where it does not). notes: what is odd about the file."""

    points: np.ndarray
    cells: dict[str, np.ndarray]
    faces: np.ndarray | None = None
    regions: np.ndarray | None = None
    creases: np.ndarray | None = None
    notes: list[str] = field(default_factory=list)


def read_grid(path: Path, suffix: str) -> Grid:
    """Whatever a reader stumbles over becomes an IoError."""
    if suffix == ".vtp":
        return _vtp_grid(path)
    with _reading(path, suffix):
        if suffix in MESHIO_SUFFIXES:
            return grid_of_meshio(read_meshio(path, suffix))
        if suffix == ".meshb":
            return _grid_of_text(read_binary_medit(_bytes(path), str(path)))
        if suffix == ".mesh":
            return _grid_of_text(read_medit(_text(path), str(path)))
        if suffix in (".node", ".ele"):
            files = _tetgen_files(path, suffix)
            return _grid_of_text(read_tetgen({kind: (_text(file), str(file)) for kind, file in files.items()}))
        return _ovm_grid(path)


def _text(path: Path) -> str:
    return read_text(path)


def _bytes(path: Path) -> bytes:
    return read_bytes(path)


def _tetgen_files(path: Path, suffix: str) -> dict[str, Path]:
    """The .node and the .ele file, of which one was given, and .face and .edge where they lie beside it; packed or not."""
    stem = path.name[: path.name.lower().rindex(suffix)]
    files = {suffix: path}
    for other in (".node", ".ele", ".face", ".edge"):
        beside = [path.with_name(stem + other + packed) for packed in ("", ".gz")]
        found = next((p for p in beside if p.is_file()), None)
        if found is not None:
            files.setdefault(other, found)
        elif other in (".node", ".ele") and other != suffix:
            raise IoError(f"{path}: needs {beside[0].name} (or .gz) beside it, which is not there")
    return files


def _grid_of_text(mesh: TextMesh) -> Grid:
    grid = _grid(mesh.points, mesh.cells, mesh.references, mesh.references, mesh.ridges)
    grid.notes = mesh.notes
    return grid


def read_meshio(path: Path, suffix: str) -> "meshio.Mesh":
    return _READERS[suffix](_bytes(path), str(path))


@contextlib.contextmanager
def _reading(path: Path, suffix: str) -> Iterator[None]:
    try:
        yield
    except (InvalidInput, IoError):
        raise
    except Exception as error:  # whatever parsers run into
        reason = " ".join(str(error).split()) or type(error).__name__
        raise IoError(f"{path}: cannot be read as {suffix} ({reason})") from error


def grid_of_meshio(found: "meshio.Mesh") -> Grid:
    blocks = [(block.type, np.asarray(block.data)) for block in found.cells]
    entities = _entity_ids(found, ("CellEntityIds", "gmsh:geometrical"))
    regions, creases = _regions_of(found, entities), None
    features = found.field_data.get(FEATURES)
    if np.ndim(features) == 2:  # a physical group of Gmsh by that name is a pair
        creases = np.repeat([False, True], [sum(len(data) for kind, data in blocks if kind == "line"), len(features)])
        blocks.append(("line", np.asarray(features)))
        entities, regions = ([*ids, np.zeros(len(features), np.int64)] if ids is not None else None for ids in (entities, regions))
    return _grid(found.points, blocks, entities, regions, creases)


def _ovm_grid(path: Path) -> Grid:
    """Feature edges and faces are those that AlgoHex marks; regions: cell property region."""
    from ..formats.ovm import read_ovm
    from ..formats.ovm_mesh import tets_of_ovm

    mesh = read_ovm(path)
    blocks, faces = [("tetra", tets_of_ovm(mesh, str(path)))], [np.zeros(len(mesh.cells), np.int64)]
    for entity, name, kind, of in (("edge", "AlgoHex::FeatureEdges", "line", mesh.edges), ("face", "AlgoHex::FeatureFaces", "triangle", mesh.triangles())):
        tags = mesh.properties.get((entity, name))
        if tags is not None and tags.ndim == 1:
            marked = tags[tags > 0].astype(np.int64)
            blocks.append((kind, of[tags > 0]))
            faces.append(marked if len(np.unique(marked)) > 1 else 0 * marked)  # one tag for the whole boundary tells no faces apart
    regions = mesh.properties.get(("cell", "region"))
    ids = None if regions is None or regions.ndim != 1 else [regions.astype(np.int64), *faces[1:]]
    if not len(mesh.cells):
        raise InvalidInput(f"{path}: holds no tetrahedra")
    return _grid(mesh.vertices, blocks, faces, ids)


def _vtp_grid(path: Path) -> Grid:
    data = read_bytes(path)
    with _reading(path, ".vtp"), scratch_folder() as folder:
        (folder / "input.vtp").write_bytes(data)
        found = _quietly(lambda: read_vtp(folder / "input.vtp"))
        flat = found.triangulate() if found.n_cells else found
        if not found.n_points:
            raise IoError(f"{path}: holds no points, or is damaged")
        sides = np.asarray(flat.faces)
        blocks = [("triangle", sides.reshape(-1, 4)[:, 1:])] if len(sides) else []
        lines = _line_segments(np.asarray(found.lines))
        if len(lines):
            blocks.append(("line", lines))
        return _grid(np.asarray(flat.points, float), blocks, None, None)


def _quietly(work: Callable[[], _Read]) -> _Read:
    """VTK writes about damaged files to stderr and goes on; what it read is tested instead."""
    from vtkmodules.vtkCommonCore import vtkObject

    shown = vtkObject.GetGlobalWarningDisplay()
    vtkObject.GlobalWarningDisplayOff()
    try:
        return work()
    finally:
        vtkObject.SetGlobalWarningDisplay(shown)


def _line_segments(cells: np.ndarray) -> np.ndarray:
    """(k, 2) of VTK's polylines: a count and the points of each."""
    segments, at = [], 0
    while at < len(cells):
        ids = cells[at + 1 : at + 1 + cells[at]]
        segments.append(np.column_stack([ids[:-1], ids[1:]]))
        at += 1 + cells[at]
    return np.concatenate(segments) if segments else np.empty((0, 2), np.int64)


def _regions_of(found: "meshio.Mesh", entities: list[np.ndarray] | None) -> list[np.ndarray] | None:
    """Our own files: cell data region, where every number is one. Gmsh: physical volumes where all tets are in one, which is how a
    file says what belongs together (0: in none); else CAD volumes."""
    ours = _entity_ids(found, ("region",))
    if ours is not None:
        return ours
    groups = _entity_ids(found, ("gmsh:physical",))
    of_tets = [] if groups is None else [ids for block, ids in zip(found.cells, groups, strict=True) if block.type == "tetra"]
    return groups if of_tets and all((ids > 0).all() for ids in of_tets) else entities


def _entity_ids(found: "meshio.Mesh", names: tuple[str, ...]) -> list[np.ndarray] | None:
    """Cell data of the first of these names, per block."""
    for name in names:
        if name in found.cell_data:
            return [np.ravel(values).astype(np.int64) for values in found.cell_data[name]]
    return None


def _grid(
    points: np.ndarray,
    blocks: Blocks,
    entities: list[np.ndarray] | None,
    regions: list[np.ndarray] | None,
    creases: np.ndarray | None = None,
) -> Grid:
    """Blocks of one type joined. An entity 0 or below, as in Gmsh files without geometry, is no CAD face."""
    in_space = np.zeros((len(points), 3))
    in_space[:, : points.shape[1]] = points
    faces = None if entities is None else [np.where(ids > 0, ids, -1) for ids in entities]
    of_tets = None if regions is None else _of_kind("tetra", blocks, regions)
    if not any(kind == "tetra" and len(data) for kind, data in blocks):
        blocks, faces = _split_sides(blocks, faces)
    of_triangles = None if faces is None else _of_kind("triangle", blocks, faces)
    return Grid(in_space, _joined(blocks), of_triangles, of_tets, creases)


def _of_kind(kind: str, blocks: Blocks, ids: list[np.ndarray]) -> np.ndarray | None:
    chosen = [i for (name, data), i in zip(blocks, ids, strict=True) if name == kind and len(data)]
    return np.concatenate(chosen) if chosen else None


def _split_sides(blocks: Blocks, ids: list[np.ndarray] | None) -> tuple[Blocks, list[np.ndarray] | None]:
    """Quads as two triangles each, with the face of the quad."""
    split: Blocks = []
    split_ids: list[np.ndarray] = []
    for number, (kind, data) in enumerate(blocks):
        if kind == "polygon" and data.ndim == 2:
            kind = {3: "triangle", 4: "quad"}.get(data.shape[1], kind)
        corners = _SIDES.get(kind)
        split.append(("triangle", data[:, corners].reshape(-1, 3)) if corners else (kind, data))
        if ids is not None:
            split_ids.append(np.repeat(ids[number], len(corners)) if corners else ids[number])
    return split, split_ids if ids is not None else None


def _joined(blocks: Blocks) -> dict[str, np.ndarray]:
    """Connectivity per cell type. Blocks of one type differ in width for polygons only, which are merely counted."""
    cells: dict[str, list[np.ndarray]] = {}
    for kind, data in blocks:
        if len(data):
            cells.setdefault(kind, []).append(data if kind in (*LOWER, "tetra") else np.empty((len(data), 0)))
    return {kind: np.concatenate(found).astype(np.int64) for kind, found in cells.items()}
