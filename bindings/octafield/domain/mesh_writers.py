"""Meshes to files: surfaces and tets with feature edges, CAD faces and regions, as far as a format holds them."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import TriangleMesh
from ..errors import InvalidInput, IoError
from ..files.reading import plain_name, rows_of, write_all, write_whole
from ..files.scratch import through_file
from ..files.writing import vtp_bytes
from ..meshes.openvolumemesh.mesh import ovm_of_tets
from ..meshes.openvolumemesh.text import write_ovm
from .algohex_features import add_features
from .inputs import SURFACE_SUFFIXES, Input

if TYPE_CHECKING:
    import meshio

BOTH_SUFFIXES = (".vtk", ".vtu", ".msh", ".mesh", ".meshb")  # of tets, or of triangles alone
TETS_SUFFIXES = (".node", ".ele", ".ovm", ".ovmb")
MESH_SUFFIXES = (*SURFACE_SUFFIXES, ".vtp", *BOTH_SUFFIXES, *TETS_SUFFIXES)


def patches(triangles: np.ndarray, lines: np.ndarray | None) -> np.ndarray:
    """(t,) numbers from 1 of the connected parts of a surface cut along (k, 2) lines. Where a line ends inside a part,
    a triangle beside it is a part of its own, so that no line has one part on both sides."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    triangles = triangles.astype(np.int64)
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    count = int(triangles.max(initial=0)) + 1
    keys, of_triangle = sides[:, 0] * count + sides[:, 1], np.repeat(np.arange(len(triangles)), 3)
    order = np.argsort(keys, kind="stable")
    same = keys[order][1:] == keys[order][:-1]
    first, second, key = of_triangle[order][:-1][same], of_triangle[order][1:][same], keys[order][1:][same]
    cut = np.zeros(len(key), bool)
    if lines is not None and len(lines):
        low, high = np.sort(np.asarray(lines).astype(np.int64), axis=1).T
        cut = np.isin(key, low * count + high)
    graph = coo_array((np.ones((~cut).sum()), (first[~cut], second[~cut])), shape=(len(triangles), len(triangles)))
    labels: np.ndarray = connected_components(graph, directed=False)[1].astype(np.int64) + 1
    for triangle in np.unique(first[cut & (labels[first] == labels[second])]):
        labels[triangle] = labels.max() + 1
    return labels


@dataclass
class Parts:
    """What is written. lines: (k, 2) feature edges or None. triangles: (t, 3); faces: (t,) CAD face of each, 0: none,
    or None. tets: (m, 4) or None; regions: (m,) or None."""

    points: np.ndarray
    lines: np.ndarray | None = None
    triangles: np.ndarray | None = None
    faces: np.ndarray | None = None
    tets: np.ndarray | None = None
    regions: np.ndarray | None = None

    @classmethod
    def of_input(cls, found: Input) -> "Parts":
        """The tets with their boundary and interfaces, or the surface. Where the file tells no CAD faces, the parts of
        the surface between feature edges stand for them, for readers take an edge with one face on both sides for a
        seam."""
        features = found.lines if found.lines_are_features() else None
        triangles = np.asarray(found.surface.triangles)
        if found.faces is None or (found.faces <= 0).all():
            faces = patches(triangles, features)
        else:
            faces = np.maximum(found.faces, 0)
        if found.tets is None:
            return cls(np.asarray(found.surface.vertices), features, triangles, faces)
        tets = found.volume()
        ids = np.asarray(tets.surface.vertex_map)
        lines = None if features is None else ids[features]
        return cls(np.asarray(tets.vertices), lines, ids[triangles], faces, np.asarray(tets.tets), found.regions)

    def blocks(self) -> list[tuple[str, np.ndarray, np.ndarray]]:
        """meshio's cell type, connectivity and entity ids (0: none), in the order that ARFF's reader of Medit files
        wants."""
        parts = []
        if self.triangles is not None:
            parts.append(
                ("triangle", self.triangles, np.zeros(len(self.triangles)) if self.faces is None else self.faces)
            )
        if self.lines is not None and len(self.lines):
            parts.append(("line", self.lines, np.ones(len(self.lines))))
        if self.tets is not None:
            parts.append(("tetra", self.tets, np.ones(len(self.tets)) if self.regions is None else self.regions))
        return [
            (kind, np.asarray(cells).astype(np.int64), np.asarray(ids).astype(np.int64)) for kind, cells, ids in parts
        ]


def write_mesh(path: str | Path, found: Input) -> list[str]:
    """Writes by extension (also .gz) and says what the format could not hold."""
    path = Path(path)
    suffix = next((s for s in sorted(MESH_SUFFIXES, key=len, reverse=True) if plain_name(path).endswith(s)), None)
    if suffix is None:
        raise IoError(f"{path}: unknown kind of mesh file; known are {' '.join(MESH_SUFFIXES)}, also .gz")
    parts = Parts.of_input(found)
    if suffix in TETS_SUFFIXES and parts.tets is None:
        raise InvalidInput(
            f"{path}: {suffix} files hold tets, and {found.name} is a surface; write one of"
            f" {' '.join((*SURFACE_SUFFIXES, *BOTH_SUFFIXES))}",
            "not_tets",
        )
    if suffix in SURFACE_SUFFIXES:
        surface = found.surface if not found.interface_triangles else found.volume().boundary.mesh
        return _write_surface(path, suffix, surface, parts, found)
    if suffix == ".vtp":
        return _write_vtp(path, parts, found)
    if suffix in (".node", ".ele"):
        return _write_tetgen(path, suffix, parts)
    if suffix in (".ovm", ".ovmb"):
        tets = found.volume().mesh
        mesh = ovm_of_tets(tets.vertices, tets.tets)
        add_features(
            mesh, np.asarray(tets.tets), parts.lines, parts.regions, triangles=parts.triangles, faces=parts.faces
        )
        write_ovm(path, mesh, binary=suffix == ".ovmb")
        return []
    return _write_by_meshio(path, suffix, parts)


def _write_surface(path: Path, suffix: str, surface: TriangleMesh, parts: Parts, found: Input) -> list[str]:
    notes = [] if parts.tets is None else [f"{suffix} files hold triangles: the boundary of the tets was written"]
    notes += _lost(suffix, ("feature edges", parts.lines), ("CAD faces", found.faces), ("regions", parts.regions))
    if suffix == ".stl":
        notes.append(
            "STL files hold single precision and no vertex ids: points were rounded, equal ones merge on reading"
        )
    through_file(path, suffix, lambda plain: _core.write_surface(surface, plain))
    return notes


def _write_vtp(path: Path, parts: Parts, found: Input) -> list[str]:
    import pyvista

    triangles: np.ndarray = np.array(found.surface.triangles)
    surface = pyvista.PolyData.from_regular_faces(np.array(found.surface.vertices), triangles)
    if parts.lines is not None:
        lines = np.asarray(found.lines)
        surface.lines = np.column_stack([np.full(len(lines), 2), lines]).ravel()
    write_whole(path, [vtp_bytes(surface)])
    notes = [] if parts.tets is None else [".vtp files hold triangles: the boundary of the tets was written"]
    return notes + _lost(".vtp", ("CAD faces", found.faces), ("regions", parts.regions))


def _lost(suffix: str, *parts: tuple[str, np.ndarray | None]) -> list[str]:
    names = [name for name, part in parts if part is not None]
    return [f"{suffix} files hold no {', no '.join(names)}: left out"] if names else []


def _write_tetgen(path: Path, suffix: str, parts: Parts) -> list[str]:
    """All of .node, .ele, .face and, where there are features, .edge; ids from 0."""
    name = path.name
    cut = name.lower().rindex(suffix)
    beside = {
        kind: path.with_name(name[:cut] + kind + name[cut + len(suffix) :])
        for kind in (".node", ".ele", ".face", ".edge")
    }
    ids = np.arange(len(parts.points))
    head = f"{len(parts.points)} 3 0 0\n".encode()
    cells = {kind: (corners, numbers) for kind, corners, numbers in parts.blocks()}
    with_regions = [] if parts.regions is None else [parts.regions]
    tets = np.column_stack([np.arange(len(cells["tetra"][0])), cells["tetra"][0], *with_regions])
    faces = np.column_stack([np.arange(len(cells["triangle"][0])), *cells["triangle"]])
    files = {
        ".node": [head, *_numbered(ids, parts.points)],
        ".ele": [f"{len(tets)} 4 {len(with_regions)}\n".encode(), *rows_of(tets)],
        ".face": [f"{len(faces)} 1\n".encode(), *rows_of(faces)],
    }
    if parts.lines is not None:
        lines = np.column_stack([np.arange(len(parts.lines)), parts.lines, np.ones(len(parts.lines), np.int64)])
        files[".edge"] = [f"{len(lines)} 1\n".encode(), *rows_of(lines)]
    write_all([(beside[kind], pieces) for kind, pieces in files.items()])
    return [f"wrote {', '.join(p.name for kind, p in beside.items() if kind != '.edge' or parts.lines is not None)}"]


def _numbered(ids: np.ndarray, points: np.ndarray) -> Iterator[bytes]:
    for start in range(0, len(ids), 1 << 16):
        rows = zip(ids[start : start + (1 << 16)].tolist(), points[start : start + (1 << 16)].tolist(), strict=True)
        yield "".join("%d %r %r %r\n" % (i, *point) for i, point in rows).encode()


def _write_by_meshio(path: Path, suffix: str, parts: Parts) -> list[str]:
    import meshio

    notes: list[str] = []
    if suffix == ".vtk":
        write_whole(path, _vtk_pieces(parts))
        return notes
    if suffix == ".msh":
        mesh, notes = msh_of(parts)
        write = lambda plain: meshio.gmsh.write(str(plain), mesh, "2.2", binary=True)  # noqa: E731
    else:
        name = "medit:ref" if suffix in (".mesh", ".meshb") else "CellEntityIds"
        mesh = _meshio_mesh(parts, name)
        writers = {".vtu": meshio.vtu, ".mesh": meshio.medit, ".meshb": meshio.medit}
        write = lambda plain: writers[suffix].write(str(plain), mesh)  # noqa: E731
    through_file(path, suffix, write)
    return notes


def _vtk_pieces(parts: Parts) -> Iterator[bytes]:
    """Legacy version 2.0 in ASCII with one colour per cell, as Gmsh writes it and AlgoHex's reader wants it."""
    blocks = parts.blocks()
    counts = [len(cells) for _, cells, _ in blocks]
    numbers = sum(cells.size + len(cells) for _, cells, _ in blocks)
    yield b"# vtk DataFile Version 2.0\nwritten by octafield\nASCII\nDATASET UNSTRUCTURED_GRID\n"
    yield f"POINTS {len(parts.points)} double\n".encode()
    yield from rows_of(parts.points)
    yield f"CELLS {sum(counts)} {numbers}\n".encode()
    for _, cells, _ in blocks:
        yield from rows_of(cells, prefix=f"{cells.shape[1]} ")
    yield f"CELL_TYPES {sum(counts)}\n".encode()
    for (kind, *_), count in zip(blocks, counts, strict=True):
        yield ({"line": "3\n", "triangle": "5\n", "tetra": "10\n"}[kind] * count).encode()
    yield f"CELL_DATA {sum(counts)}\nSCALARS CellEntityIds int 1\nLOOKUP_TABLE default\n".encode()
    for *_, ids in blocks:
        yield from rows_of(ids[:, None])


def _meshio_mesh(parts: Parts, name: str) -> "meshio.Mesh":
    import meshio

    blocks = parts.blocks()
    return meshio.Mesh(
        parts.points, [(kind, cells) for kind, cells, _ in blocks], cell_data={name: [ids for *_, ids in blocks]}
    )


def msh_of(parts: Parts) -> tuple["meshio.Mesh", list[str]]:
    """With Gmsh's physical groups: 1 for feature edges, 1 and up for regions; and notes."""
    mesh = _meshio_mesh(parts, "gmsh:geometrical")
    notes: list[str] = []
    physical = [ids.copy() for ids in mesh.cell_data["gmsh:geometrical"]]
    for number, block in enumerate(mesh.cells):
        if block.type == "tetra" and physical[number].min(initial=1) < 1:
            known, place = np.unique(physical[number], return_inverse=True)
            notes.append(f"regions {known.tolist()[:10]} were numbered from 1: Gmsh's groups are positive")
            physical[number] = mesh.cell_data["gmsh:geometrical"][number] = place.ravel() + 1
    mesh.cell_data["gmsh:physical"] = physical
    return mesh, notes
