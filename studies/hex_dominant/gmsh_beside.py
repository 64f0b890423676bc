"""Beside Gmsh's hex-dominant mesher (Algorithm3D 9, R-tree), at an edge length of the diagonal over n.

octafield gets the boundary of HexMe's tets. Gmsh gets the CAD model where that is a box, cylinder, torus or sphere,
made anew by Open CASCADE with the size of the file; of the others the CAD models are not at hand, and it gets the
boundary classified into patches (creases of 40 degrees). Published figures are Gmsh's on the CAD models.

    python -m studies.hex_dominant.gmsh_beside FILE EDGE ALGORITHM JSON     one run of Gmsh
"""

import contextlib
import json
import os
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from study_output import markdown_table

from ..benchmarks.pages import commit, machine
from . import checker
from .rows import run_one, run_words

# File, n, and of Gmsh 4.15.2 on the CAD models with surface algorithms 9 and 8: hexahedra in % of the volume.
MODELS = {
    "s01u": (20, 70, 99.6), "s05u": (20, 65, 78), "i10c": (25, 55, 61), "i11c": (30, 67, None),
    "s15u": (25, 67, None), "s16u": (25, 50, None), "s17u": (25, 54, None),
}  # fmt: skip
TYPES = {4: "tets", 5: "hexahedra", 6: "wedges", 7: "pyramids"}
TRIHEDRON = 140  # without volume, between a quad and two triangles
HEADER = [
    "file", "n", "octafield: volume %", "number %", "SJ min", "mean", "s", "Gmsh, 9: volume %", "number %", "SJ min",
    "misfits", "s", "Gmsh, 8: volume %", "number %", "SJ min", "misfits", "s", "published (CAD), 9", "8",
    "points above the best",
]  # fmt: skip


def boundary(path: Path) -> tuple[np.ndarray, np.ndarray]:
    from octafield.domain.meshing import prepare_mesh

    mesh = prepare_mesh(path).tets.surface.mesh
    return np.asarray(mesh.vertices), np.asarray(mesh.triangles)


def diagonal(path: Path) -> float:
    return float(np.linalg.norm(np.ptp(boundary(path)[0], axis=0)))


def box(kernel, points: np.ndarray, volume: float) -> None:
    side = np.cbrt(volume)  # however it is turned
    kernel.addBox(0, 0, 0, side, side, side)


def cylinder(kernel, points: np.ndarray, volume: float) -> None:
    wide, _, height = np.ptp(points, axis=0)
    kernel.addCylinder(0, 0, 0, 0, 0, height, wide / 2)


def torus(kernel, points: np.ndarray, volume: float) -> None:
    wide, _, height = np.ptp(points, axis=0)
    kernel.addTorus(0, 0, 0, (wide - height) / 2, height / 2)


def sphere(kernel, points: np.ndarray, volume: float) -> None:
    kernel.addSphere(0, 0, 0, np.ptp(points, axis=0).max() / 2)


SHAPES = {"s01u": box, "s15u": cylinder, "s16u": torus, "s17u": sphere}


def set_geometry(path: Path) -> None:
    """In the current model of Gmsh."""
    import gmsh
    import meshio

    points, triangles = boundary(path)
    corners = points[triangles]
    volume = float(np.linalg.det(corners).sum() / 6)
    if shape := SHAPES.get(path.name.split(".")[0]):
        shape(gmsh.model.occ, points, volume)
        gmsh.model.occ.synchronize()
        if abs(gmsh.model.occ.getMass(3, 1) / volume - 1) > 0.01:
            raise ValueError(f"the model of {path} has another volume")
        return
    with tempfile.TemporaryDirectory() as folder:
        meshio.write_points_cells(Path(folder) / "in.stl", points, [("triangle", triangles)])
        gmsh.merge(str(Path(folder) / "in.stl"))
    gmsh.model.mesh.classifySurfaces(np.radians(40), True, True, np.pi)
    gmsh.model.mesh.createGeometry()
    loop = gmsh.model.geo.addSurfaceLoop([tag for _, tag in gmsh.model.getEntities(2)])
    gmsh.model.geo.addVolume([loop])
    gmsh.model.geo.synchronize()


def gmsh_mesh(path: Path, edge: float, algorithm: int) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    import gmsh

    gmsh.initialize(["-nt", "2", "-v", "1"])
    set_geometry(path)
    options = {
        "MeshSizeMin": edge, "MeshSizeMax": edge, "MeshSizeExtendFromBoundary": 0, "Algorithm": algorithm,
        "Algorithm3D": 9, "Recombine3DAll": 1,
    }  # fmt: skip
    for name, value in options.items():
        gmsh.option.setNumber(f"Mesh.{name}", value)
    gmsh.model.mesh.generate(3)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    place = np.zeros(int(tags.max()) + 1, np.int64)
    place[tags.astype(int)] = np.arange(len(tags))
    cells = {kind: np.zeros((0, {"tets": 4, "hexahedra": 8, "wedges": 6, "pyramids": 5}[kind]), np.int64)
             for kind in checker.KINDS}  # fmt: skip
    for number, _, nodes in zip(*gmsh.model.mesh.getElements(3), strict=True):
        if int(number) == TRIHEDRON:
            continue
        kind = TYPES[int(number)]
        cells[kind] = place[nodes.astype(int)].reshape(-1, cells[kind].shape[1])
    return coordinates.reshape(-1, 3), cells


def figures(points: np.ndarray, cells: dict[str, np.ndarray]) -> dict[str, float]:
    volumes = {kind: np.abs(v).sum() for kind, v in checker.volumes_of(points, cells).items()}
    quality = checker.scaled_jacobians(points, "hexahedra", cells["hexahedra"])
    return {
        "volume": volumes["hexahedra"] / sum(volumes.values()),
        "number": len(cells["hexahedra"]) / sum(len(rows) for rows in cells.values()),
        "sj_min": float(quality.min()) if len(quality) else float("nan"),
        "misfits": checker.face_map(cells)[1],
    }


def one() -> None:
    path, out = Path(sys.argv[1]).absolute(), Path(sys.argv[4]).absolute()
    edge, algorithm = float(sys.argv[2]), int(sys.argv[3])
    begun = time.perf_counter()
    try:
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):  # Gmsh leaves new_points.pos
            found = figures(*gmsh_mesh(path, edge, algorithm))
    except Exception as error:
        found = {"error": f"{type(error).__name__}: {error}"[:200]}
    out.write_text(json.dumps(found | {"seconds": time.perf_counter() - begun}))


def work(data: Path, output: Path, limit: float, only: tuple[str, ...]) -> None:
    output.mkdir(parents=True, exist_ok=True)
    path = output / "gmsh.jsonl"
    done = {json.loads(line)["file"] for line in path.read_text().splitlines()} if path.exists() else set()
    for name, (n, *published) in MODELS.items():
        if name in done or (only and name not in only):
            continue
        file = data / "hexme" / f"{name}.vtk.gz"
        edge = diagonal(file) / n
        row = {"file": name, "n": n, "published": published, "load": round(os.getloadavg()[0], 1), "commit": commit()}
        row["octafield"] = run_one(file, 1, limit, edge)
        for algorithm in (9, 8):
            words = ["studies.hex_dominant.gmsh_beside", str(file), str(edge), str(algorithm)]
            row[f"gmsh{algorithm}"] = run_words(words, limit)
        with path.open("a") as stream:
            stream.write(json.dumps(row) + "\n")
        write_table(output)
        print(json.dumps(row)[:600], flush=True)


def write_table(output: Path) -> None:
    rows = [json.loads(line) for line in (output / "gmsh.jsonl").read_text().splitlines()]
    lines = []
    for row in rows:
        line = [row["file"], row["n"], *own(row["octafield"]), *other(row["gmsh9"]), *other(row["gmsh8"])]
        line += ["fails" if share is None else f"{share:g}" for share in row["published"]]
        lines.append([*line, ahead(row)])
    (output / "gmsh.md").write_text(markdown_table(HEADER, lines))
    loads = [row["load"] for row in rows]
    (output / "gmsh_when.md").write_text(
        f"{machine()}, load average {min(loads)} to {max(loads)},"
        f" commits {', '.join(dict.fromkeys(row['commit'] for row in rows))}.\n"
    )


def own(row: dict) -> list[str]:
    if "error" in row:
        return [row["error"], "", "", "", f"{row['seconds']:.0f}"]
    shares = [f"{100 * row[name]:.1f}" for name in ("hex_volume_share", "hex_number_share")]
    return [*shares, f"{row['hex_sj_min']:.2f}", f"{row['hex_sj_mean']:.3f}", f"{row['seconds']:.0f}"]


def other(row: dict) -> list[str]:
    if "error" in row:
        return [row["error"], "", "", "", f"{row['seconds']:.0f}"]
    shares = [f"{100 * row[name]:.1f}" for name in ("volume", "number")]
    return [*shares, f"{row['sj_min']:.2f}", f"{row['misfits']:,}", f"{row['seconds']:.0f}"]


def ahead(row: dict) -> str:
    """Of the hexahedra's share of the volume, in percent, against the best of the published and the measured."""
    if "error" in row["octafield"]:
        return ""
    known = [share for share in row["published"] if share is not None]
    known += [100 * row[name]["volume"] for name in ("gmsh9", "gmsh8") if "error" not in row[name]]
    return f"{100 * row['octafield']['hex_volume_share'] - max(known):+.1f}"


if __name__ == "__main__":
    one()
