"""Readers of files with frames that share nothing with octafield: other libraries, or parsers written from the layouts
alone.

Each takes a path and gives (n, 3, 3) axes in columns or (n, 4) quaternions w x y z.
"""

import struct
from pathlib import Path

import meshio
import numpy as np
import pyvista


def arff(path: Path) -> np.ndarray:
    """As MATLAB's dlmread and reshape(frames', 3, 3, []) do: column by column."""
    return np.loadtxt(path, ndmin=2).reshape(-1, 3, 3, order="C").transpose(0, 2, 1)


def geogram(path: Path) -> np.ndarray:
    axes = [list(map(float, line.split())) for line in path.read_text().splitlines()]
    assert all(len(axis) == 3 for axis in axes) and len(axes) % 3 == 0
    return np.array([np.column_stack(axes[i : i + 3]) for i in range(0, len(axes), 3)])


def geogram_centres(path: Path, centres: np.ndarray) -> np.ndarray:
    """Looked up by nearest centre."""
    rows = np.array([list(map(float, line.split())) for line in path.read_text().splitlines()])
    assert rows.shape[1] == 12
    nearest = [np.linalg.norm(rows[:, :3] - c, axis=1).argmin() for c in centres]
    return np.array([np.column_stack(np.split(rows[i, 3:], 3)) for i in nearest])


def mouette_text(path: Path) -> np.ndarray:
    lines = path.read_text().splitlines()
    assert lines[0] == "FRAME" and lines[-1] == "END" and int(lines[1]) == len(lines) - 3
    return np.array([np.reshape([float(x) for x in line.split()], (3, 3)).T for line in lines[2:-1]])


def mouette_library(path: Path, mesh_path: Path) -> np.ndarray:
    import mouette
    from mouette.processing.framefield.cells import FrameField3DCells

    field = FrameField3DCells(mouette.mesh.load(str(mesh_path)), verbose=False)
    field.read_from_file(str(path))
    return np.array([frame.as_matrix() for frame in field.frames])


def fra(path: Path) -> np.ndarray:
    words = path.read_text().split()
    assert words[:2] == ["FRA", "1"] and words[3] == "3"
    vectors = np.array(words[5:], float).reshape(int(words[2]), 3, 3)
    return np.array([np.column_stack(frame) for frame in vectors])


def perm(path: Path) -> tuple[int, np.ndarray]:
    words = path.read_text().split()
    assert words[:2] == ["PERM", "1"] and words[4] == "3"
    return int(words[2]), np.array(words[5:], int).reshape(int(words[3]), 5)


def bfra(path: Path) -> np.ndarray:
    data = path.read_bytes()
    assert data[:6] == b"FRA 2\0"
    rows, columns, vectors = struct.unpack("<3i", data[6:18])
    assert columns == 9 and vectors == 3
    numbers = struct.unpack(f"<{rows * columns}d", data[18:])
    matrix = [[numbers[c * rows + r] for c in range(columns)] for r in range(rows)]
    return np.array([np.column_stack([row[0:3], row[3:6], row[6:9]]) for row in matrix])


def qtn(path: Path) -> np.ndarray:
    return np.array(list(map(float, path.read_text().split()))).reshape(-1, 4)


def ff3(path: Path) -> np.ndarray:
    first, *lines = path.read_text().splitlines()
    assert first.split() == ["9", str(len(lines))]
    return np.array([np.reshape(list(map(float, line.split())), (3, 3), order="F") for line in lines])


def ovm_text(path: Path) -> dict:
    """Sections and properties, as OpenVolumeMesh's FileManager reads them: line by line."""
    lines = iter(path.read_text().splitlines())
    assert next(lines) == "OVM ASCII"
    found: dict = {}
    for section in ("Vertices", "Edges", "Faces", "Polyhedra"):
        assert next(lines) == section
        rows = [next(lines).split() for _ in range(int(next(lines)))]
        found[section] = np.array(rows, float if section == "Vertices" else int)
        if section in ("Faces", "Polyhedra"):
            assert (found[section][:, 0] == found[section].shape[1] - 1).all()
            found[section] = found[section][:, 1:]
    counts = {"VProp": "Vertices", "EProp": "Edges", "FProp": "Faces", "CProp": "Polyhedra"}
    for line in lines:
        entity, kind, name = line.split(" ", 2)
        assert kind in ("int", "vec3d", "vec4d") and name[0] == name[-1] == '"'
        rows = [
            next(lines).split()
            for _ in range(2 * len(found["Faces"]) if entity == "HFProp" else len(found[counts[entity]]))
        ]
        found[entity, name[1:-1]] = np.array(rows, int if kind == "int" else float)
    return found


def ovm_binary(path: Path) -> dict:
    """Chunk by chunk, one number at a time."""
    data = path.read_bytes()
    assert data[:8] == b"OVMB\n\r\n\xff" and data[8:16] == bytes([1, 1, 3, 1, 0, 0, 0, 0])
    counts = dict(zip(("Vertices", "Edges", "Faces", "Polyhedra"), struct.unpack("<4Q", data[16:48]), strict=True))
    at, found, properties = 48, {}, []
    while True:
        kind, version, padding, compression, flags, size = struct.unpack_from("<4sBBBBQ", data, at)
        body = data[at + 16 : at + 16 + size - padding]
        assert (version, compression, flags) == (0, 0, 1) and size % 8 == 0
        assert data[at + 16 + size - padding : at + 16 + size] == bytes(padding)
        at += 16 + size
        if kind == b"EOF ":
            assert at == len(data)
            return found
        if kind == b"DIRP":
            while body:
                entity, body, texts = body[0], body[1:], []
                for _ in range(3):
                    (length,) = struct.unpack("<I", body[:4])
                    texts.append(body[4 : 4 + length])
                    body = body[4 + length :]
                properties.append((entity, texts[0].decode(), texts[1].decode()))
                assert len(texts[2]) == {"i32": 4, "Quaternion": 32}[texts[1].decode()]
            continue
        first, count = struct.unpack("<QI", body[:12])
        assert first == 0
        if kind == b"VERT":
            assert body[12] == 2 and count == counts["Vertices"]
            found["Vertices"] = np.array(struct.unpack(f"<{3 * count}d", body[16:])).reshape(-1, 3)
        elif kind == b"TOPO":
            entity, valence, none, encoding, offset = struct.unpack("<BBBBQ", body[12:24])
            name = ("Edges", "Faces", "Polyhedra")[entity - 1]
            assert none == 0 and offset == 0 and count == counts[name] and valence == (2, 3, 4)[entity - 1]
            letter = {1: "B", 2: "H", 4: "I"}[encoding]
            found[name] = np.array(struct.unpack(f"<{valence * count}{letter}", body[24:])).reshape(-1, valence)
        elif kind == b"PROP":
            (number,) = struct.unpack("<I", body[12:16])
            entity, name, form = properties[number]
            width = {"i32": "i", "Quaternion": "4d"}[form]
            values = list(struct.iter_unpack(f"<{width}", body[16:]))
            assert len(values) == count
            found[("VProp", "EProp", "FProp", "CProp", "HEProp", "HFProp")[entity], name] = np.array(values)


def ovm_tets(found: dict) -> tuple[np.ndarray, np.ndarray]:
    """Sorted vertex ids of each cell, and the signed volume that its half-faces enclose, normals inward."""
    points, ends = found["Vertices"], found["Edges"]
    cells, volumes = [], []
    for half_faces in found["Polyhedra"]:
        volume, ids = 0.0, set()
        for half_face in half_faces:
            loop = [ends[h // 2][h % 2] for h in found["Faces"][half_face // 2]]
            nexts = [ends[h // 2][1 - h % 2] for h in found["Faces"][half_face // 2]]
            assert loop[1:] + loop[:1] == nexts
            loop = loop[::-1] if half_face % 2 else loop
            volume -= np.linalg.det(points[loop]) / 6
            ids |= set(loop)
        cells.append(sorted(ids))
        volumes.append(volume)
    return np.array(cells), np.array(volumes)


def vtk_arrays(path: Path, where: str) -> dict[str, np.ndarray]:
    """By VTK itself."""
    found = pyvista.read(path)
    data = found.cell_data if where == "tets" and not isinstance(found, pyvista.PolyData) else found.point_data
    return {name: np.asarray(data[name]) for name in data}


def meshio_arrays(path: Path, where: str) -> dict[str, np.ndarray]:
    found = meshio.read(path)
    if where == "vertices":
        return dict(found.point_data)
    chosen = [i for i, block in enumerate(found.cells) if block.type == "tetra"]
    return {name: np.concatenate([values[i] for i in chosen]) for name, values in found.cell_data.items()}


def gmsh_views(path: Path) -> dict[str, np.ndarray]:
    """Views by name: (n, k) values, of a .msh per element or node, of a .pos per point: place and vector."""
    import gmsh

    gmsh.initialize(["test"], readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.merge(str(path))
        found = {}
        for tag in gmsh.view.getTags():
            name = gmsh.view.option.getString(tag, "Name")
            if path.suffix == ".pos":
                kinds, _, values = gmsh.view.getListData(tag)
                assert list(kinds) == ["VP"]
                found[name] = values[0].reshape(-1, 6)
            else:
                kind, elements, values, *_ = gmsh.view.getModelData(tag, 0)
                if kind == "ElementData":
                    tets = gmsh.model.mesh.getElementsByType(4)[0]
                    values = [v for e, v in zip(elements, values, strict=True) if e in set(tets)]
                found[name] = np.array(values)
        return found
    finally:
        gmsh.finalize()


def columns(u: np.ndarray, v: np.ndarray, w: np.ndarray) -> np.ndarray:
    return np.stack([u, v, w], axis=2)
