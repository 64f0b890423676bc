"""Files of cells: what they hold as arrays, by our own readers (of .vtp VTK's), before any meaning is given to it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..errors import InvalidInput, IoError
from ..files.reading import plain_name, read_bytes, read_text, reading
from .binary_medit import read_binary_medit
from .cell_mesh import Block, Blocks, CellMesh, first_of_equal, linear
from .gmsh.mesh_file import read_gmsh
from .openvolumemesh.mesh import OvmMesh, tets_of_ovm
from .openvolumemesh.text import read_ovm
from .text_meshes import TextMesh, read_medit, read_tetgen
from .vtk.legacy import read_legacy_vtk
from .vtk.vtu import read_vtu

CELL_READERS: dict[str, Callable[[Path], CellMesh]] = {  # which give data of points and cells, too
    "vtk": lambda path: read_legacy_vtk(read_bytes(path), str(path)),
    "vtu": lambda path: read_vtu(read_bytes(path), str(path), path.stat().st_size),
    "msh": lambda path: read_gmsh(read_bytes(path), str(path)),
}
_SIDES = {"triangle": [[0, 1, 2]], "quad": [[0, 1, 2], [0, 2, 3]], "pixel": [[0, 1, 3], [0, 3, 2]]}  # as triangles
LOWER = ("vertex", "line", "triangle")


@dataclass
class Grid:
    """Points, connectivity per meshio cell type, and, where the file tells, the CAD face of each triangle, the region
    of each tet and which lines are creases (all, where it does not). file_tets: (m,) of each tet its number among those
    of the file. notes: what is odd about the file."""

    points: np.ndarray
    cells: dict[str, np.ndarray]
    faces: np.ndarray | None = None
    regions: np.ndarray | None = None
    creases: np.ndarray | None = None
    file_tets: np.ndarray | None = None
    notes: list[str] = field(default_factory=list)


def read_cells(path: Path, name: str) -> CellMesh:
    """name: of a format in CELL_READERS. Whatever the reader stumbles over becomes an IoError."""
    with reading(path, f".{name}"):
        found = CELL_READERS[name](path)
        blocks, found.notes = linear([(block.type, block.data) for block in found.cells])
        found.cells = [Block(kind, data) for kind, data in blocks]
        return found


def read_cell_grid(name: str) -> Callable[[Path], Grid]:
    """The reader of a format in CELL_READERS."""
    return lambda path: grid_of_cells(read_cells(path, name))


def read_medit_text(path: Path) -> Grid:
    return _grid_of_text(read_medit(read_text(path), str(path)))


def read_medit_binary(path: Path) -> Grid:
    return _grid_of_text(read_binary_medit(read_bytes(path), str(path)))


def read_tetgen_files(path: Path) -> Grid:
    """path: of the .node or the .ele file."""
    files = _tetgen_files(path, Path(plain_name(path)).suffix)
    return _grid_of_text(read_tetgen({kind: (read_text(file), str(file)) for kind, file in files.items()}))


def read_openvolumemesh(path: Path) -> Grid:
    """.ovm or, binary, .ovmb."""
    return grid_of_ovm(read_ovm(path, binary=plain_name(path).endswith(".ovmb")), path)


def _tetgen_files(path: Path, suffix: str) -> dict[str, Path]:
    """The .node and the .ele file, of which one was given, and .face and .edge where they lie beside it; packed or
    not."""
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
    grid = grid_of_blocks(mesh.points, mesh.cells, mesh.references, mesh.references, mesh.ridges)
    grid.notes += mesh.notes
    return grid


def grid_of_cells(found: CellMesh) -> Grid:
    blocks = [(block.type, block.data) for block in found.cells]
    entities = _entity_ids(found, ("CellEntityIds", "gmsh:geometrical"))
    regions, creases = _regions_of(found, entities), None
    if found.features is not None:
        creases = np.repeat(
            [False, True], [sum(len(data) for kind, data in blocks if kind == "line"), len(found.features)]
        )
        blocks.append(("line", found.features))
        entities, regions = (
            [*ids, np.zeros(len(found.features), np.int64)] if ids is not None else None for ids in (entities, regions)
        )
    grid = grid_of_blocks(found.points, blocks, entities, regions, creases)
    grid.notes += found.notes
    return grid


def grid_of_ovm(mesh: OvmMesh, path: Path) -> Grid:
    """Feature edges and faces are those that AlgoHex marks; regions: cell property region."""
    blocks, faces = [("tetra", tets_of_ovm(mesh, str(path)))], [np.zeros(len(mesh.cells), np.int64)]
    for entity, name, kind, of in (
        ("edge", "AlgoHex::FeatureEdges", "line", mesh.edges),
        ("face", "AlgoHex::FeatureFaces", "triangle", mesh.triangles()),
    ):
        tags = mesh.properties.get((entity, name))
        if tags is not None and tags.ndim == 1:
            marked = tags[tags > 0].astype(np.int64)
            blocks.append((kind, of[tags > 0]))
            faces.append(
                marked if len(np.unique(marked)) > 1 else 0 * marked
            )  # one tag for the whole boundary tells no faces apart
    regions = mesh.properties.get(("cell", "region"))
    ids = None if regions is None or regions.ndim != 1 else [regions.astype(np.int64), *faces[1:]]
    if not len(mesh.cells):
        raise InvalidInput(f"{path}: holds no tetrahedra")
    return grid_of_blocks(mesh.vertices, blocks, faces, ids)


def _regions_of(found: CellMesh, entities: list[np.ndarray] | None) -> list[np.ndarray] | None:
    """Our own files: cell data region, where every number is one. Gmsh: physical volumes where all tets are in one,
    which is how a file says what belongs together (0: in none), and none in several; else CAD volumes."""
    ours = _entity_ids(found, ("region",))
    if ours is not None:
        return ours
    groups = _entity_ids(found, ("gmsh:physical",))
    of_tets = (
        [] if groups is None else [ids for block, ids in zip(found.cells, groups, strict=True) if block.type == "tetra"]
    )
    if not of_tets or not all((ids > 0).all() for ids in of_tets):
        return entities
    tets = np.sort(np.concatenate([block.data for block in found.cells if block.type == "tetra"]), axis=1)
    several = len(first_of_equal(np.column_stack([tets, -1 - np.concatenate(of_tets)]))) > len(first_of_equal(tets))
    return entities if several and entities is not None else groups


def _entity_ids(found: CellMesh, names: tuple[str, ...]) -> list[np.ndarray] | None:
    """Cell data of the first of these names, per block."""
    for name in names:
        if name in found.cell_data:
            return [np.ravel(values).astype(np.int64) for values in found.cell_data[name]]
    return None


def grid_of_blocks(
    points: np.ndarray,
    blocks: Blocks,
    entities: list[np.ndarray] | None,
    regions: list[np.ndarray] | None,
    creases: np.ndarray | None = None,
) -> Grid:
    """The cells of a file: blocks of one type joined, each cell once.

    entities: per block the CAD face of each cell; an entity 0 or below, as in Gmsh files without geometry, is no CAD
    face. regions: per block the region of each tet. creases: (l,) bool, of the lines. None where the file does not
    tell."""
    blocks, notes = linear(blocks)
    in_space = np.zeros((len(points), 3))
    in_space[:, : points.shape[1]] = points
    faces = None if entities is None else [np.where(ids > 0, ids, -1) for ids in entities]
    of_tets = None if regions is None else _of_kind("tetra", blocks, regions)
    if not any(kind == "tetra" and len(data) for kind, data in blocks):
        blocks, faces = _split_sides(blocks, faces)
    of_triangles = None if faces is None else _of_kind("triangle", blocks, faces)
    return _without_repeats(Grid(in_space, _joined(blocks), of_triangles, of_tets, creases, notes=notes))


def _without_repeats(grid: Grid) -> Grid:
    """Each tet once, the first of those with the same vertices. Without tets, each triangle once, where it is there
    again in the same sense."""
    if "tetra" in grid.cells:
        kind, keys, ids = "tetra", grid.cells["tetra"], grid.regions
    elif "triangle" in grid.cells:
        cells = grid.cells["triangle"]
        sense = (cells[:, 0] < cells[:, 1]).astype(int) + (cells[:, 1] < cells[:, 2]) + (cells[:, 2] < cells[:, 0]) == 2
        kind, keys, ids = "triangle", np.column_stack([np.sort(cells, axis=1), -1 - sense.astype(np.int64)]), grid.faces
    else:
        return grid
    kept, count = first_of_equal(keys), len(keys)
    if kind == "tetra":
        grid.file_tets = kept
    if len(kept) == count:
        return grid
    grid.notes.append(
        f"{count - len(kept)} of {count} {'tets' if kind == 'tetra' else 'triangles'} are in the file twice or more (as"
        " in groups of Gmsh that overlap): each was taken once"
    )
    grid.cells[kind] = grid.cells[kind][kept]
    if ids is not None:
        setattr(grid, "regions" if kind == "tetra" else "faces", ids[kept])
    return grid


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
