"""Meshes of mixed cells and surfaces of quads, from files and to files."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from .._core import MixedMesh, QuadMesh
from ..errors import GeometryError, InvalidInput, IoError
from ..files.reading import plain_name, read_bytes, read_text, reading
from ..files.scratch import through_file
from ..meshes import grids
from ..meshes.binary_medit import read_binary_medit
from ..meshes.cell_mesh import Blocks, linear
from ..meshes.text_meshes import read_medit

if TYPE_CHECKING:
    import meshio

WRITTEN = (".vtu", ".msh", ".mesh", ".meshb")
_READ = (*(f".{name}" for name in grids.CELL_READERS), ".mesh", ".meshb")
# meshio's cell types, and the arrays of our meshes
_SOLIDS = {"tetra": "tets", "hexahedron": "hexahedra", "wedge": "wedges", "pyramid": "pyramids"}
_FACES = {"triangle": "triangles", "quad": "quads"}
_LOWER = ("vertex", "line")
_OF_RASTER = {"voxel": ("hexahedron", [0, 1, 3, 2, 4, 5, 7, 6]), "pixel": ("quad", [0, 1, 3, 2])}  # VTK's


def read_cells(path: str | Path) -> MixedMesh | QuadMesh:
    """The tets, hexahedra, wedges and pyramids of a file (.vtu, .vtk, Gmsh .msh, Medit .mesh and .meshb, each also as
    .gz), or, where it has none of them, its triangles and quads. Vertices are those of the file in its order; lower
    cells (faces of solids, lines) are left out. Nothing is validated: octafield.require_valid. Raises IoError naming
    the file and the place, and InvalidInput for cells of other kinds (kind "unsupported_cells") and where there are
    none ("no_cells")."""
    path = Path(path)
    suffix = _suffix(path, _READ)
    with reading(path, suffix):
        points, blocks = _contents(path, suffix)
    blocks = [_plain(kind, cells) for kind, cells in blocks]
    if points.shape[1] < 3:
        points = np.column_stack([points, np.zeros((len(points), 3 - points.shape[1]))])
    solid = any(
        kind not in (*_FACES, *_LOWER) and not kind.startswith(("line", "triangle", "quad")) for kind, _ in blocks
    )
    kinds, ignored = (_SOLIDS, (*_FACES, *_LOWER)) if solid else (_FACES, _LOWER)
    others = sorted({kind for kind, _ in blocks} - {*kinds, *ignored})
    if others:
        raise InvalidInput(
            f"{path}: holds cells of type {', '.join(others)}; linear ones are needed: {', '.join(kinds)}",
            "unsupported_cells",
        )
    arrays = {
        name: np.concatenate([cells for of, cells in blocks if of == kind])
        for kind, name in kinds.items()
        if any(of == kind for of, _ in blocks)
    }
    if "wedges" in arrays and suffix in (".vtk", ".vtu"):
        arrays["wedges"] = _either_way(points, arrays["wedges"])
    if not arrays:
        raise InvalidInput(f"{path}: holds no cells", "no_cells")
    make: Callable[..., MixedMesh | QuadMesh] = MixedMesh if solid else QuadMesh
    return make(points, **arrays)


def write_cells(path: str | Path, mesh: MixedMesh | QuadMesh, *, regions: ArrayLike | None = None) -> None:
    """Writes by extension: .vtu (with cell data scaled_jacobian), Gmsh .msh (2.2, binary), Medit .mesh or .meshb, also
    .gz. regions: an id per cell, in the order of their numbers, which become Gmsh's physical groups and Medit's
    references (all raised where the least is below 1); a .vtu has none. Raises IoError, GeometryError for ids out of
    range and coordinates that are not finite, and InvalidInput where there are no cells ("no_cells"): no reader takes
    such files.

    >>> import octafield
    >>> cube = octafield.volume.MixedMesh(
    ...     [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
    ...     hexahedra=[[0, 1, 2, 3, 4, 5, 6, 7]])
    >>> octafield.write_cells("cube.mesh", cube)
    >>> octafield.read_cells("cube.mesh").hexahedra.tolist()
    [[0, 1, 2, 3, 4, 5, 6, 7]]
    """
    path = Path(path)
    suffix = _suffix(path, WRITTEN)
    cells = _core.scaled_jacobians(mesh)  # refuses ids out of range
    if not len(cells):
        raise InvalidInput(f"{path}: the mesh has no cells; give one at least", "no_cells")
    lost = np.flatnonzero(~np.isfinite(np.asarray(mesh.vertices)).all(axis=1))
    if len(lost):
        raise GeometryError(
            f"{path}: vertex {lost[0]} (from 0) of {len(lost)} has coordinates that are not finite; correct them",
            "non_finite_vertex",
        )
    ids = np.ones(len(cells), np.int64) if regions is None else np.asarray(regions, np.int64)
    if ids.shape != (len(cells),):
        raise InvalidInput(f"{path}: regions of shape {ids.shape} for {len(cells)} cells", "wrong_shape")
    ids = ids + max(0, 1 - int(ids.min()))
    through_file(path, suffix, lambda plain: _write(plain, suffix, mesh, ids))


def _suffix(path: Path, known: tuple[str, ...]) -> str:
    suffix = Path(plain_name(path)).suffix
    if suffix not in known:
        raise IoError(f"{path}: unknown kind of file for cells; known are {' '.join(known)}, also .gz")
    return suffix


def _contents(path: Path, suffix: str) -> tuple[np.ndarray, Blocks]:
    if suffix[1:] in grids.CELL_READERS:
        found = grids.read_cells(path, suffix[1:])
        return np.asarray(found.points, float), [(block.type, block.data) for block in found.cells]
    text = (
        read_binary_medit(read_bytes(path), str(path)) if suffix == ".meshb" else read_medit(read_text(path), str(path))
    )
    return np.asarray(text.points, float), linear(text.cells)[0]


def _plain(kind: str, cells: np.ndarray) -> tuple[str, np.ndarray]:
    if kind not in _OF_RASTER:
        return kind, cells
    plain, order = _OF_RASTER[kind]
    return plain, cells[:, order]


def _either_way(points: np.ndarray, wedges: np.ndarray) -> np.ndarray:
    """VTK's documentation (and meshio) numbers wedges the other way round than its measures (and Gmsh) do; taken is
    the way in which most are not inverted."""
    if len(wedges) and (wedges.min() < 0 or wedges.max() >= len(points)):
        return wedges  # for the tests of the mesh to name
    origin, *ends = (points[wedges[:, corner]] for corner in (0, 1, 2, 3))
    first, second, third = (end - origin for end in ends)
    turned = np.einsum("ij,ij->i", np.cross(first, second), third) < 0
    return wedges[:, [0, 2, 1, 3, 5, 4]] if turned.sum() > len(wedges) / 2 else wedges


def _write(path: Path, suffix: str, mesh: MixedMesh | QuadMesh, regions: np.ndarray) -> None:
    if suffix != ".vtu":
        _write_by_meshio(path, suffix, mesh, regions)
    elif isinstance(mesh, MixedMesh):
        _core.write_mixed_mesh(path, mesh)
    else:
        _core.write_quad_mesh(path, mesh)


def _write_by_meshio(path: Path, suffix: str, mesh: MixedMesh | QuadMesh, regions: np.ndarray) -> None:
    import meshio

    kinds = _SOLIDS if isinstance(mesh, MixedMesh) else _FACES
    blocks = [(kind, np.array(getattr(mesh, name), np.int64)) for kind, name in kinds.items()]
    blocks = [(kind, cells) for kind, cells in blocks if len(cells)]
    ids = np.split(regions, np.cumsum([len(cells) for _, cells in blocks])[:-1])
    if suffix == ".msh":
        data = {"gmsh:physical": ids, "gmsh:geometrical": ids}
        meshio.gmsh.write(str(path), _mesh(mesh, blocks, data), "2.2", binary=True)
    else:
        meshio.medit.write(str(path), _mesh(mesh, blocks, {"medit:ref": ids}))


def _mesh(mesh: MixedMesh | QuadMesh, blocks: Blocks, data: dict[str, list[np.ndarray]]) -> "meshio.Mesh":
    import meshio

    return meshio.Mesh(np.array(mesh.vertices), blocks, cell_data=data)
