"""Quads beside Gmsh's quasi-structured ones (quadqs, Mesh.Algorithm 11; Reberol, Georgiadis, Remacle 2021), on the
surfaces of HexMe, one process each. Part of studies.quad_layouts, which makes the table:

    python -m studies.quad_beside_gmsh gmsh FILE QUADS JSON
    python -m studies.quad_beside_gmsh octafield FILE QUADS JSON

Gmsh gets the CAD model where the file is one, or where it is a box, cylinder, torus or sphere, made anew by Open
CASCADE with the size of the file; of the others the boundary of the file's tets, classified into patches (creases of
40 degrees). Its edge length
is tried until the number of quads is within 10 % of the one wanted, CPU seconds are those of the last try; octafield
then gets that number. Both meshes are judged here, against the boundary in the file.
"""

import json
import os
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import octafield
from octafield.domain.meshing import prepare_mesh
from octafield.meshes.figures import surface_deviation

from .benchmarks.pages import when
from .hex_dominant.gmsh_beside import SHAPES, boundary, set_geometry
from .hex_dominant.rows import markdown_table, run_words

FILES = (
    "s01u", "s15u", "s16u", "s17u", "holder.stp", "s02u", "s05u", "i10c", "i12c", "i09c", "i01c", "i02c",
)  # fmt: skip
LIMIT = 60.0  # seconds of CPU time
TRIES = 4
PATIENCE = 20.0  # seconds of CPU time after which no other edge length is tried
COARSER = 2.2  # quads of quadqs are smaller than the edge length asked for
TRIANGLE, QUAD = 2, 3  # of Gmsh
ON_FEATURE = 3e-3  # of the diagonal: chords of circles included
HEADER = (
    "file", "by", "quads", "others", "irregular in faces", "open edges", "inverted", "SJ min", "mean", "deviation %",
    "CPU s", "error",
)  # fmt: skip


# ---- figures, of either


def figures(points: np.ndarray, quads: np.ndarray, triangles: np.ndarray, path: Path) -> dict:
    meshed = prepare_mesh(path, octafield.SurfaceFieldOptions(remesh=False), volume=False)
    given = octafield.TriangleMesh(*surface_of(path))
    jacobians = np.asarray(octafield.surface.scaled_jacobians(octafield.surface.QuadMesh(points, quads=quads)))
    edges = [np.sort(cells[:, [k, (k + 1) % n]], axis=1) for cells, n in ((quads, 4), (triangles, 3)) for k in range(n)]
    count = np.unique(np.concatenate(edges), axis=0, return_counts=True)[1]
    around = np.bincount(np.concatenate([quads.ravel(), triangles.ravel()]), minlength=len(points))
    inside = ~near_features(points, np.asarray(meshed.surface.vertices), np.asarray(meshed.features.edges))
    return {
        "quads": len(quads),
        "others": len(triangles),
        "irregular": int((inside & (around > 0) & (around != 4)).sum()),
        "open": int((count != 2).sum()),
        "inverted": int((~(jacobians > 0)).sum()),
        "least": float(jacobians.min()),
        "mean": float(jacobians.mean()),
        "deviation": surface_deviation(points, triangles.astype(np.int32), quads.astype(np.int32), given)[0],
    }


def surface_of(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Of CAD models as octafield reads them: edges of 36 to a turn."""
    if path.suffix != ".stp":
        return boundary(path)
    mesh = prepare_mesh(path, octafield.SurfaceFieldOptions(remesh=False), volume=False).surface
    return np.asarray(mesh.vertices), np.asarray(mesh.triangles)


def near_features(points: np.ndarray, vertices: np.ndarray, edges: np.ndarray) -> np.ndarray:
    import pyvista

    if not len(edges):
        return np.zeros(len(points), bool)
    lines = pyvista.PolyData(vertices, lines=np.column_stack([np.full(len(edges), 2), edges]).ravel())
    nearest = lines.find_closest_cell(points, return_closest_point=True)[1]
    return np.linalg.norm(nearest - points, axis=1) < ON_FEATURE * np.linalg.norm(np.ptp(vertices, axis=0))


# ---- octafield


def own(path: Path, quads: int) -> dict:
    result = octafield.compute_quad_layout(path, layout_options=octafield.QuadLayoutOptions(quads=quads))
    found = figures(np.asarray(result.mesh.vertices), np.asarray(result.mesh.quads), np.zeros((0, 3), int), path)
    return found | {"cpu": sum(result.record.cpu_seconds.values())}


# ---- Gmsh


def other(path: Path, quads: int) -> dict:
    points, cells, rest, cpu = nearest_to(path, quads)
    return figures(points, cells, rest, path) | {"cpu": cpu}


def nearest_to(path: Path, quads: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """Vertices, quads, triangles where their number is nearest to the one wanted, and CPU seconds of that try."""
    points, triangles = surface_of(path)
    area = np.linalg.norm(np.cross(*(points[triangles[:, k]] - points[triangles[:, 0]] for k in (1, 2))), axis=1).sum()
    edge, best = COARSER * np.sqrt(area / 2 / quads), None
    for _ in range(TRIES):
        began = time.process_time()
        made = quadqs(path, edge)
        cpu = time.process_time() - began
        ratio = len(made[1]) / quads
        if not ratio:
            raise ValueError("no quads")
        if best is None or abs(np.log(ratio)) < abs(np.log(best[0])):
            best = ratio, made, cpu
        if 1 / 1.1 < ratio < 1.1 or time.process_time() > PATIENCE:
            break
        edge *= np.sqrt(ratio)
    _, (vertices, cells, rest), cpu = best
    return placed(vertices, path, points, triangles), cells, rest, cpu


def quadqs(path: Path, edge: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices, quads, triangles."""
    import gmsh

    gmsh.initialize(["-nt", "2", "-v", "1"])
    try:
        if path.suffix == ".stp":
            gmsh.model.occ.importShapes(str(path))
            gmsh.model.occ.synchronize()
        else:
            set_geometry(path)
        for name, value in {"Algorithm": 11, "MeshSizeMin": edge, "MeshSizeMax": edge}.items():
            gmsh.option.setNumber(f"Mesh.{name}", value)
        gmsh.model.mesh.generate(2)
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        cells = {QUAD: [], TRIANGLE: []}
        for kind, _, nodes in zip(*gmsh.model.mesh.getElements(2), strict=True):
            cells[int(kind)].append(nodes.astype(np.int64))
    finally:
        gmsh.finalize()
    place = np.zeros(int(tags.max()) + 1, np.int64)
    place[tags.astype(int)] = np.arange(len(tags))
    of = {kind: place[np.concatenate(parts)] if parts else np.zeros(0, np.int64) for kind, parts in cells.items()}
    return coordinates.reshape(-1, 3), of[QUAD].reshape(-1, 4), of[TRIANGLE].reshape(-1, 3)


def placed(vertices: np.ndarray, path: Path, points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """CAD models that were made anew are moved to where the file has them: boxes are turned there."""
    if path.name.split(".")[0] not in SHAPES:
        return vertices
    turn = np.eye(3)
    if SHAPES[path.name.split(".")[0]].__name__ == "box":
        a, b, c = (points[triangles[:, k]] for k in range(3))
        normals = np.cross(b - a, c - a)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        second = normals[abs(normals @ normals[0]) < 0.5][0]
        turn = np.array([normals[0], second, np.cross(normals[0], second)])
    middle = lambda places: (places.min(axis=0) + places.max(axis=0)) / 2  # noqa: E731
    return (vertices - middle(vertices) + middle(points @ turn.T)) @ turn


# ---- the table


def work(data: Path, output: Path, only: list[str], quads: int) -> None:
    """Rows that are there already are kept."""
    path = output / "gmsh.jsonl"
    rows = [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []
    for name in FILES:
        if name in {row["file"] for row in rows} or (only and name not in only):
            continue
        at = data / "wild" / name if name.endswith(".stp") else data / "hexme" / f"{name}.vtk.gz"
        file, number = str(at), quads
        for by in ("gmsh", "octafield"):
            row = {"file": name, "by": by} | run_words(["studies.quad_beside_gmsh", by, file, str(number)], LIMIT)
            number = row.get("quads", number)
            rows.append(row)
            with path.open("a") as stream:
                stream.write(json.dumps(row) + "\n")
            print(*cells_of(row), flush=True)
        (output / "gmsh.md").write_text(markdown_table(HEADER, [cells_of(row) for row in rows]))
    (output / "gmsh_when.md").write_text(when())


def cells_of(row: dict) -> list[str]:
    by = (
        row["by"]
        if row["by"] == "octafield"
        else "Gmsh, " + ("CAD" if row["file"] in SHAPES or row["file"].endswith(".stp") else "triangles")
    )
    if "error" in row:
        return [row["file"], by, *[""] * (len(HEADER) - 3), row["error"]]
    counts = [f"{row[name]:,}" for name in ("quads", "others", "irregular", "open", "inverted")]
    quality = [f"{row['least']:.2f}", f"{row['mean']:.3f}", f"{100 * row['deviation']:.2f}"]
    return [row["file"], by, *counts, *quality, f"{row['cpu']:.1f}", ""]


def one() -> None:
    by, path, quads, out = sys.argv[1], Path(sys.argv[2]).absolute(), int(sys.argv[3]), Path(sys.argv[4]).absolute()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)  # Gmsh leaves files
        try:
            found = (own if by == "octafield" else other)(path, quads)
        except octafield.Error as error:
            found = {"error": error.kind}
        except Exception as error:
            found = {"error": f"{type(error).__name__}: {error}"[:120].replace("\n", " ")}
        os.chdir("/")
    out.write_text(json.dumps(found))


if __name__ == "__main__":
    one()
