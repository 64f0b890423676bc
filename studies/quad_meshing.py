"""Quads of one size on the surfaces of HexMe, beside QuadriFlow, Instant Meshes and Gmsh's quasi-structured quads.

    python -m studies.quad_meshing -o DIR [--factor 0.5] [--only s05u,i02c] [--by octafield,quadriflow,instant,gmsh]

Each file's boundary at `factor` times its mean edge, area / edge^2 quads wanted; each tool on each file in a process of
its own (QuadriFlow may end it) that is stopped at 240 s of CPU time, QuadriFlow at 120, the others at 60. The others
get the triangles of the file, and the same judge: studies.quad_judge, which knows arrays alone. DIR gets rows.jsonl,
meshing.md and when.md. QuadriFlow is pyQuadriFlow 0.0.4, Instant Meshes is pynanoinstantmeshes 0.0.3 (pip install them;
a row says where one is missing); Gmsh is of requirements-test.txt.
"""

import argparse
import json
import os
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import octafield
from octafield.domain.meshing import prepare_mesh

from .benchmarks.pages import when
from .hex_dominant.rows import markdown_table, run_words
from .quad_judge import judged

DATA = Path(__file__).resolve().parents[2] / "shared" / "data"
LIMITS = {"octafield": 240.0, "quadriflow": 120.0, "instant": 60.0, "gmsh": 60.0}  # seconds of CPU time
TOOLS = ("octafield", "quadriflow", "instant", "gmsh")
NAMES = {"octafield": "octafield", "quadriflow": "QuadriFlow", "instant": "Instant Meshes", "gmsh": "Gmsh quadqs"}
HEADER = (
    "file", "wanted", "quads", "ratio", "others", "irregular", "of the field", "nonconforming", "inverted", "SJ min",
    "mean", "size p10", "p90", "off features %", "deviation %", "CPU s", "error",
)  # fmt: skip


def surface_and_features(path: Path) -> tuple[octafield.TriangleMesh, np.ndarray]:
    """As the file has them."""
    kept = octafield.SurfaceFieldOptions(remesh=False, interfaces=False)
    meshed = prepare_mesh(path, kept, volume=False)
    domain = octafield.surface.SurfaceDomain(meshed.surface, meshed.features)
    rim = np.asarray(domain.edges)[np.asarray(domain.edge_triangles).min(axis=1) < 0]
    return meshed.surface, np.concatenate([np.asarray(meshed.features.edges).reshape(-1, 2), rim])


def by_octafield(path: Path, surface: octafield.TriangleMesh, quads: int) -> dict:
    result = octafield.compute_quad_mesh(path, quad_options=octafield.QuadMeshOptions(quads=quads))
    record = result.record
    inside = sum(not point.boundary for point in record.field_singularities)
    return {
        "points": np.asarray(result.mesh.vertices),
        "quads": np.asarray(result.mesh.quads),
        "cpu": sum(record.cpu_seconds.values()),
        "told": {"of_field": inside, "phases": dict(record.cpu_seconds), "corners": record.feature_deviation.corners},
    }


def by_quadriflow(path: Path, surface: octafield.TriangleMesh, quads: int) -> dict:
    from pyQuadriFlow.pyQuadriFlow import pyquadriflow

    began = time.process_time()
    made = pyquadriflow(
        quads, 0, np.asarray(surface.vertices).tolist(), np.asarray(surface.triangles).tolist(), True, True, False,
        False, False,
    )  # fmt: skip
    points, cells = np.array(made["vertices"]), np.array(made["faces"], int)
    return {"points": points, "quads": cells, "cpu": time.process_time() - began}


def by_instant(path: Path, surface: octafield.TriangleMesh, quads: int) -> dict:
    """Its face count comes out four times as large as asked for."""
    from pynanoinstantmeshes import remesh

    began = time.process_time()
    points, cells = remesh(
        np.asarray(surface.vertices, np.float32), np.asarray(surface.triangles, np.uint32), quads // 4,
        creaseAngle=30.0, align_to_boundaries=True, deterministic=True,
    )  # fmt: skip
    return {"points": np.array(points, float), "quads": np.array(cells, int), "cpu": time.process_time() - began}


def by_gmsh(path: Path, surface: octafield.TriangleMesh, quads: int) -> dict:
    from .quad_beside_gmsh import nearest_to

    points, cells, rest, cpu = nearest_to(path, quads)
    return {"points": points, "quads": cells, "triangles": rest, "cpu": cpu}


MAKERS = {"octafield": by_octafield, "quadriflow": by_quadriflow, "instant": by_instant, "gmsh": by_gmsh}


def measure(by: str, path: Path, factor: float) -> dict:
    surface, features = surface_and_features(path)
    area = float(np.asarray(octafield.surface.triangle_areas(surface)).sum())
    edge = factor * float(octafield.surface.mean_edge_length(surface))
    wanted = round(area / edge**2)
    row = {"wanted": wanted, "triangles": len(surface.triangles)}
    try:
        made = MAKERS[by](path, surface, wanted)
    except octafield.Error as error:
        return row | {"error": f"{error.kind}: {error}"[:300], "kind": error.kind}
    except ImportError as error:
        return row | {"error": f"{error}", "kind": "not installed"}
    found = judged(made["points"], made["quads"], made.get("triangles", np.zeros((0, 3), int)), surface, features, edge)
    return row | found | made.get("told", {}) | {"cpu": made["cpu"]}


def cells(row: dict) -> list[str]:
    if "error" in row:
        wanted = f"{row['wanted']:,}" if "wanted" in row else ""
        return [row["file"], wanted, *[""] * (len(HEADER) - 3), row.get("kind") or row["error"]]
    counts = [f"{row[name]:,}" for name in ("wanted", "quads")] + [f"{row['quads'] / row['wanted']:.3f}"]
    counts += [f"{row['others']:,}", f"{row['irregular']:,}", f"{row['of_field']:,}" if "of_field" in row else ""]
    counts += [f"{row['nonconforming']:,}", f"{row['inverted']:,}"]
    quality = [f"{row[name]:.{digits}f}" for name, digits in (("least", 2), ("mean", 3), ("p10", 2), ("p90", 2))]
    off = [f"{100 * row['off_features']:.2f}", f"{100 * row['deviation']:.2f}"]
    return [row["file"], *counts, *quality, *off, f"{row['cpu']:.1f}", ""]


def summary(rows: list[dict]) -> str:
    sound = [row for row in rows if "error" not in row]
    pure = [row for row in sound if not (row["others"] or row["nonconforming"] or row["inverted"])]
    share = lambda good: f"{sum(map(bool, good))} of {len(sound)}"  # noqa: E731
    return (
        f"{len(rows)} surfaces, {len(sound)} meshes, {len(pure)} of them quads alone, conforming, none inverted."
        f" Number within 5 % of that wanted: {share(abs(r['quads'] / r['wanted'] - 1) <= 0.05 for r in sound)};"
        f" least scaled Jacobian 0.3 or more: {share(r['least'] >= 0.3 for r in sound)};"
        f" sizes from 0.7 (10 %) to 1.4 (90 %): {share(r['p10'] >= 0.7 and r['p90'] <= 1.4 for r in sound)}."
    )


def run(data: Path, output: Path, only: list[str], tools: list[str], factor: float) -> None:
    """Rows that are there already are kept."""
    path = output / "rows.jsonl"
    rows = [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []
    done = {(row["file"], row["by"]) for row in rows}
    for file in sorted((data / "hexme").glob("*.vtk.gz")):
        name = file.name.split(".")[0]
        for by in tools:
            if (name, by) in done or (only and name not in only):
                continue
            row = {"file": name, "by": by}
            row |= run_words(["studies.quad_meshing", "one", by, str(file), str(factor)], LIMITS[by])
            rows.append(row)
            with path.open("a") as stream:
                stream.write(json.dumps(row) + "\n")
            print(by, *cells(row), flush=True)
    text = []
    for by in tools:
        of_tool = [row for row in rows if row["by"] == by]
        text += [f"**{NAMES[by]}**: {summary(of_tool)}\n", markdown_table(HEADER, [cells(row) for row in of_tool])]
    (output / "meshing.md").write_text("\n".join(text))
    (output / "when.md").write_text(when())


def one(by: str, file: str, factor: str, out: str) -> None:
    path, result = Path(file).absolute(), Path(out).absolute()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)  # some tools leave files
        result.write_text(json.dumps(measure(by, path, float(factor))))


def main() -> None:
    if sys.argv[1:2] == ["one"]:
        one(*sys.argv[2:6])
        return
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--data", type=Path, default=DATA)
    parser.add_argument("--only", default="", help="names with commas")
    parser.add_argument("--by", default=",".join(TOOLS), help="tools with commas")
    parser.add_argument("--factor", type=float, default=1.0, help="of the mean edge")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    split = lambda words: [word for word in words.split(",") if word]  # noqa: E731
    run(given.data, given.output, split(given.only), split(given.by), given.factor)


if __name__ == "__main__":
    main()
