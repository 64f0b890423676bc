"""Writers of tets, or of triangles alone, with feature edges, CAD faces and regions."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..files.reading import plain_name, rows_of, write_all, write_whole
from ..files.scratch import through_file
from .openvolumemesh.features import add_features
from .openvolumemesh.mesh import ovm_of_tets
from .openvolumemesh.text import write_ovm
from .parts import Parts

if TYPE_CHECKING:
    import meshio


def write_vtk(path: Path, parts: Parts) -> list[str]:
    """Legacy."""
    write_whole(path, _vtk_pieces(parts))
    return []


def write_vtu(path: Path, parts: Parts) -> list[str]:
    """By meshio."""
    import meshio

    mesh = _meshio_mesh(parts, "CellEntityIds")
    through_file(path, ".vtu", lambda plain: meshio.vtu.write(str(plain), mesh))
    return []


def write_msh(path: Path, parts: Parts) -> list[str]:
    """Version 2.2, binary."""
    import meshio

    mesh, notes = msh_of(parts)
    through_file(path, ".msh", lambda plain: meshio.gmsh.write(str(plain), mesh, "2.2", binary=True))
    return notes


def write_medit(path: Path, parts: Parts) -> list[str]:
    """.mesh or, binary, .meshb."""
    import meshio

    mesh = _meshio_mesh(parts, "medit:ref")
    through_file(path, Path(plain_name(path)).suffix, lambda plain: meshio.medit.write(str(plain), mesh))
    return []


def write_openvolumemesh(path: Path, parts: Parts) -> list[str]:
    """.ovm or, binary, .ovmb, with features as AlgoHex names them."""
    tets = np.asarray(parts.tets)
    mesh = ovm_of_tets(parts.points, tets)
    add_features(mesh, tets, parts.lines, parts.regions, triangles=parts.triangles, faces=parts.faces)
    write_ovm(path, mesh, binary=plain_name(path).endswith(".ovmb"))
    return []


def write_tetgen(path: Path, parts: Parts) -> list[str]:
    """All of .node, .ele, .face and, where there are features, .edge; ids from 0."""
    name, suffix = path.name, Path(plain_name(path)).suffix
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


def _meshio_mesh(parts: Parts, name: str) -> meshio.Mesh:
    import meshio

    blocks = parts.blocks()
    return meshio.Mesh(
        parts.points, [(kind, cells) for kind, cells, _ in blocks], cell_data={name: [ids for *_, ids in blocks]}
    )


def msh_of(parts: Parts) -> tuple[meshio.Mesh, list[str]]:
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
