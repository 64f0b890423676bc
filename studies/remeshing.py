"""Remeshing of forty surfaces by `octafield.compute_remesh` at its default size, each in a process of its own, and by
Gmsh beside (classifySurfaces(40 degrees), createGeometry, generate(2), with as many vertices); then growth up to a
million triangles, and four cases as the thesis's (Beaufort, table after figure 2.21). Both meshes are judged here, on
their arrays.

    python -m studies.remeshing [table|growth|cases] [--only NAME] [-o FILE.md]

Seconds are of the processor, limits too: 60 s (Gmsh), 300 s (octafield, table), 900 s (others). Reading counts for the
limits, not for the seconds.
"""

import argparse
import json
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import octafield
import pyvista
from octafield.meshes.figures import surface_deviation

from .benchmarks.pages import when
from .remeshing_surfaces import BAD, FILES, GENERATED, HEXME, INDUSTRIAL, PYVISTA
from .study_output import markdown_table

DATA = Path(__file__).parents[2] / "shared" / "data"
LIMITS = {"octafield": 300, "gmsh": 60, "case": 900}
REPAIR = {"airplane": "wrap"}
HEADER = ("surface", "triangles", "by", "vertices", "closed", "open edges", "worst", "mean", "deviation %", "s", "told")


def names() -> list[str]:
    return [*FILES, *(f"bad {name}" for name in BAD), *HEXME, *PYVISTA, *GENERATED]


def surface_of(name: str) -> octafield.TriangleMesh:
    """As it is in the file, or as it is made."""
    if name in GENERATED:
        points, triangles = GENERATED[name]()
        return octafield.TriangleMesh(points, np.asarray(triangles, np.int32))
    if name in PYVISTA:
        poly = pyvista.read(PYVISTA[name]).triangulate().clean()
        return octafield.TriangleMesh(np.asarray(poly.points, float), poly.faces.reshape(-1, 4)[:, 1:].astype(np.int32))
    if name in HEXME:
        found = octafield.prepare_mesh(
            DATA / "hexme" / f"{name}.vtk.gz", octafield.MeshOptions(interfaces=False), volume=False
        )
        return found.surface
    file = f"bad_{name[4:]}" if name.startswith("bad ") else f"{name}_surface"
    return octafield.read_surface(DATA / "surfaces" / f"{file}.obj")


def repaired(name: str) -> tuple[octafield.TriangleMesh, list[str]]:
    """What both get: open ones keep their rims."""
    surface = surface_of(name)
    done = octafield.surface.repair(surface, level=REPAIR.get(name, "resolve"), closed=name != "roll")
    return done.mesh, list(done.actions)


# ---- figures, of either


def qualities(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """2 inscribed over circumscribed radius, by lengths alone."""
    corners = points[triangles]
    a, b, c = (np.linalg.norm(corners[:, k] - corners[:, (k + 1) % 3], axis=1) for k in range(3))
    return np.maximum(0, (b + c - a) * (c + a - b) * (a + b - c) / np.maximum(a * b * c, 1e-300))


def figures(points: np.ndarray, triangles: np.ndarray, given: octafield.TriangleMesh) -> dict:
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    counts = np.unique(sides, axis=0, return_counts=True)[1]
    shape = qualities(points, triangles)
    return {
        "vertices": len(np.unique(triangles)),
        "open": int((counts != 2).sum()),
        "worst": float(shape.min()),
        "mean": float(shape.mean()),
        "deviation": surface_deviation(points, triangles.astype(np.int32), np.zeros((0, 4), int), given)[0],
    }


# ---- octafield, and Gmsh, in processes of their own


def own(name: str) -> dict:
    given, actions = repaired(name)
    options = octafield.MeshOptions(feature_angle=np.radians(40))
    if name == "roll":
        lengths = octafield.RemeshingOptions(deviation=1e-3)
    else:
        lengths = octafield.RemeshingOptions()
    began = time.process_time()
    result = octafield.compute_remesh(given, options, remeshing=lengths)
    seconds = time.process_time() - began
    found = figures(np.asarray(result.mesh.vertices), np.asarray(result.mesh.triangles), given)
    notes = [note for note in result.record.notes if note not in actions]
    return found | {
        "triangles": len(given.triangles),
        "seconds": seconds,
        "told": "; ".join(notes),
        "kept": result.record.kept,
    }


def gmsh_of(name: str, vertices: int) -> dict:
    """Edges as long as those of so many vertices."""
    import gmsh

    given, _ = repaired(name)
    points, triangles = np.asarray(given.vertices), np.asarray(given.triangles)
    area = float(np.asarray(octafield.surface.triangle_areas(given)).sum())
    began = time.process_time()
    gmsh.initialize(["-v", "1", "-nt", "1"])
    surface = gmsh.model.addDiscreteEntity(2)
    gmsh.model.mesh.addNodes(2, surface, list(range(1, len(points) + 1)), points.ravel())
    gmsh.model.mesh.addElementsByType(surface, 2, [], (triangles + 1).astype(np.int64).ravel())
    gmsh.model.mesh.classifySurfaces(np.radians(40), True, True)
    gmsh.model.mesh.createGeometry()
    edge = np.sqrt(area / vertices * 2 / np.sqrt(3))
    for bound in ("Min", "Max"):
        gmsh.option.setNumber(f"Mesh.MeshSize{bound}", edge)
    gmsh.model.mesh.generate(2)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    place = np.full(int(tags.max()) + 1, -1)
    place[tags.astype(int)] = np.arange(len(tags))
    _, corners = gmsh.model.mesh.getElementsByType(2)
    cells = place[corners.astype(int)].reshape(-1, 3)
    seconds = time.process_time() - began
    gmsh.finalize()
    return figures(coordinates.reshape(-1, 3), cells, given) | {
        "triangles": len(triangles),
        "seconds": seconds,
        "told": "",
    }


def peak_gigabytes() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6


def case(kind: str, side: int, wanted: int) -> dict:
    """A level set on side^3 points. wanted: vertices; 0: as many as the input has, by curvature."""
    points, triangles = INDUSTRIAL[kind](side)
    given = octafield.TriangleMesh(points, triangles.astype(np.int32))
    began, cpu = time.perf_counter(), time.process_time()
    remeshing = octafield.RemeshingOptions(vertices=wanted or len(points), curvature=not wanted)
    result = octafield.compute_remesh(given, octafield.MeshOptions(repair="safe"), remeshing=remeshing)
    record = result.record
    seconds, wall, memory = time.process_time() - cpu, time.perf_counter() - began, peak_gigabytes()
    cpu = time.process_time()
    atlas = octafield.compute_atlas(given, octafield.MeshOptions(repair="safe", remesh=False)).record
    return {
        "charts": atlas.charts, "atlas_seconds": time.process_time() - cpu,
        "triangles": len(triangles), "out": record.triangles, "genus": genus(given),
        "seconds": seconds, "wall": wall, "worst": record.quality.min, "poor": record.poor,
        "deviation": max(record.deviation.of_input, record.deviation.of_mesh), "closed": record.watertight,
        "memory": memory, "kept": record.kept,
    }  # fmt: skip


def genus(mesh: octafield.TriangleMesh) -> int:
    """Of all pieces together."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    triangles = np.asarray(mesh.triangles)
    pairs = triangles[:, [0, 1, 1, 2]].reshape(-1, 2)
    graph = coo_array((np.ones(len(pairs)), pairs.T), shape=(len(mesh.vertices),) * 2)
    return connected_components(graph, directed=False)[0] - octafield.surface.euler_characteristic(mesh) // 2


def in_process(*words: object, limit: float) -> dict:
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "figures.json"
        command = [
            sys.executable,
            "-m",
            "studies.remeshing",
            "one",
            *map(str, words),
            "-o",
            str(out),
            "--limit",
            f"{limit:g}",
        ]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=20 * limit, check=False)
        except subprocess.TimeoutExpired:
            return {"error": f"not done after {20 * limit:g} s by the clock"}
        if done.returncode == -signal.SIGXCPU:
            return {"error": f"not done after {limit:g} s"}
        if not out.exists():
            lines = done.stderr.strip().splitlines() or [f"status {done.returncode}"]
            told = [line for line in lines if "Error" in line or line.startswith("Exception")]
            return {"error": (told or lines)[-1][:160]}
        return json.loads(out.read_text())


# ---- tables


def row(name: str, by: str, found: dict) -> tuple:
    if "error" in found:
        return (name, "", by, "", "", "", "", "", "", "", found["error"])
    closed = "yes" if found["open"] == 0 else "no"
    return (
        name, f"{found['triangles']:,}", by, f"{found['vertices']:,}", closed, found["open"], f"{found['worst']:.3f}",
        f"{found['mean']:.3f}", f"{100 * found['deviation']:.3f}", f"{found['seconds']:.1f}", found["told"],
    )  # fmt: skip


def table(only: str | None) -> str:
    rows, own_rows = [], []
    for name in names():
        if only and only != name:
            continue
        found = in_process("octafield", name, limit=LIMITS["octafield"])
        own_rows.append(found)
        rows.append(row(name, "octafield", found))
        beside = in_process("gmsh", name, found.get("vertices", 3000), limit=LIMITS["gmsh"])
        rows.append(row("", "Gmsh", beside))
        print(markdown_table(HEADER, rows[-2:]), flush=True)
    done = [found for found in own_rows if "error" not in found]
    good = sum(found["worst"] >= 0.3 for found in done)
    near = sum(found["deviation"] <= 1e-3 for found in done)
    return (
        markdown_table(HEADER, rows)
        + f"\n{len(done)} of {len(own_rows)} done; worst triangle 0.3 or better: {good};"
        + (f" deviation within 0.1 %: {near}; closed: {sum(found['open'] == 0 for found in done)}.\n")
    )


CASE_HEADER = (
    "case",
    "triangles",
    "genus",
    "new triangles",
    "worst",
    "below 0.3",
    "deviation %",
    "closed",
    "CPU s",
    "GB",
    "charts",
    "charts, CPU s",
)


def cases(rows: list[tuple[str, int, int]]) -> str:
    made = []
    for kind, side, wanted in rows:
        found = in_process("case", kind, side, wanted, limit=LIMITS["case"])
        if "error" in found:
            made.append((kind, f"side {side}", "", found["error"], *[""] * 8))
        else:
            made.append(
                (
                    kind,
                    f"{found['triangles']:,}",
                    found["genus"],
                    f"{found['out']:,}",
                    f"{found['worst']:.3f}",
                    found["poor"],
                    f"{100 * found['deviation']:.3f}",
                    "yes" if found["closed"] else "no",
                    f"{found['seconds']:.0f}",
                    f"{found['memory']:.1f}",
                    f"{found['charts']:,}",
                    f"{found['atlas_seconds']:.1f}",
                )  # fmt: skip
            )
        print(markdown_table(CASE_HEADER, made[-1:]), flush=True)
    return markdown_table(CASE_HEADER, made)


GROWTH = [("foam", 47, 30_000), ("foam", 80, 30_000), ("foam", 146, 30_000)]
CASES = [("scanned part", 230, 0), ("foam", 150, 0), ("vessel", 130, 0), ("bone", 110, 0)]


def one(words: list[str]) -> dict:
    kind, *rest = words
    if kind == "octafield":
        return own(rest[0])
    return gmsh_of(rest[0], int(rest[1])) if kind == "gmsh" else case(rest[0], int(rest[1]), int(rest[2]))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("part", choices=["table", "growth", "cases", "one"])
    parser.add_argument("words", nargs="*")
    parser.add_argument("--only")
    parser.add_argument("-o", type=Path)
    parser.add_argument("--limit", type=int, default=600, help="seconds of the processor")
    given = parser.parse_args()
    if given.part == "one":
        resource.setrlimit(resource.RLIMIT_CPU, (given.limit, given.limit + 5))
        given.o.write_text(json.dumps(one(given.words)))
        return
    if given.part == "table":
        text = table(given.only)
    else:
        rows = GROWTH if given.part == "growth" else CASES
        text = cases([row for row in rows if given.only in (None, row[0])])
    text += "\n" + when()
    print(text)
    if given.o:
        given.o.write_text(text)


if __name__ == "__main__":
    main()
