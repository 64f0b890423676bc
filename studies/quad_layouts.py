"""Quads by T-meshes on the surfaces of HexMe, and their time.

    python -m studies.quad_layouts -o DIR [--only s05u,i02c] [--data ../shared/data] [--quads 2000] [--axes free]
    python -m studies.quad_layouts -o DIR --cost 5,6,7
    python -m studies.quad_layouts -o DIR --gmsh [--only s16u,i01c]

The first takes the boundary and the feature edges of every file and the singular points of a computed cross field;
each in a process of its own that is stopped at 240 s of CPU time. DIR gets rows.jsonl, hexme.md and when.md. The second
puts the eight points of the cube on spheres of 20 * 4^n triangles: cost.md. Figures are those of the records. The third
has Gmsh's quasi-structured quads beside ours, on the files that it may take: gmsh.md (studies/quad_beside_gmsh.py).
"""

import argparse
import json
import math
import sys
from pathlib import Path

import octafield

from . import quad_beside_gmsh
from .benchmarks.pages import when
from .hex_dominant.rows import markdown_table, run_words

DATA = Path(__file__).resolve().parents[2] / "shared" / "data"
LIMIT = 240.0  # seconds of CPU time
HEADER = (
    "file", "triangles", "points inside", "T-joints", "blocks", "at least", "ratio", "coarsest", "ratio to it",
    "irregular", "quads", "SJ min", "mean", "deviation %", "layout and quads, CPU s", "all, CPU s", "error",
)  # fmt: skip
MADE = ("trace", "cut", "integers", "map", "mesh_smooth")  # phases of the layout and its quads


def measure(path: Path, quads: int, axes: str) -> dict:
    wanted = octafield.QuadLayoutOptions(quads=quads, axes=axes)
    try:
        record = octafield.compute_quad_layout(path, layout_options=wanted).record
    except octafield.Error as error:
        return {"error": f"{error.kind}: {error}"[:300], "kind": error.kind}
    return {
        "triangles": record.triangles,
        "points": sum(not point.boundary for point in record.singular_points),
        "t_joints": record.t_joints,
        "blocks": record.patches,
        "fewest": record.fewest_patches,
        "coarsest": record.coarsest_patches,
        "irregular": record.irregular_vertices,
        "quads": record.quads,
        "least": record.scaled_jacobian.min,
        "mean": record.scaled_jacobian.mean,
        "deviation": record.surface_deviation.max,
        "made": sum(record.cpu_seconds.get(phase, 0.0) for phase in MADE),
        "cpu": sum(record.cpu_seconds.values()),
    }


def cells(row: dict) -> list[str]:
    if "error" in row:
        return [row["file"], *[""] * (len(HEADER) - 2), row.get("kind") or row["error"]]
    counts = [f"{row[name]:,}" for name in ("triangles", "points", "t_joints", "blocks", "fewest")]
    counts += [f"{row['blocks'] / row['fewest']:.1f}", f"{row['coarsest']:,}"]
    counts += [f"{row['blocks'] / row['coarsest']:.1f}", f"{row['irregular']:,}", f"{row['quads']:,}"]
    quality = [f"{row['least']:.2f}", f"{row['mean']:.3f}", f"{100 * row['deviation']:.2f}"]
    return [row["file"], *counts, *quality, f"{row['made']:.1f}", f"{row['cpu']:.1f}", ""]


def hexme(data: Path, output: Path, only: list[str], quads: int, axes: str) -> None:
    """Rows that are there already are kept."""
    path = output / "rows.jsonl"
    rows = [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []
    for file in sorted((data / "hexme").glob("*.vtk.gz")):
        name = file.name.split(".")[0]
        if name in {row["file"] for row in rows} or (only and name not in only):
            continue
        row = {"file": name} | run_words(["studies.quad_layouts", str(file), str(quads), axes], LIMIT)
        rows.append(row)
        with path.open("a") as stream:
            stream.write(json.dumps(row) + "\n")
        print(*cells(row), flush=True)
        sound = [row for row in rows if "error" not in row]
        fair = sum(row["least"] >= 0.3 for row in sound)
        head = f"{len(rows)} surfaces, {len(sound)} meshes, {fair} of them with a least scaled Jacobian of 0.3 or more,"
        few = sum(row["blocks"] <= 4 * row["fewest"] for row in sound)
        most = max((row["blocks"] / row["coarsest"] for row in sound), default=0)
        head += f" {few} with at most 4 times the fewest blocks that there could be, all with at most {most:.1f} times"
        head += " those that the coarsest whole numbers on their T-meshes make."
        (output / "hexme.md").write_text(head + "\n\n" + markdown_table(HEADER, [cells(row) for row in rows]))
    (output / "when.md").write_text(when())


def cost(levels: list[int], quads: int) -> str:
    """CPU seconds by size, with the exponent in the number of triangles."""
    import pyvista

    points = [[x, y, z, 0.25] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    rows, before = [], None
    for level in levels:
        ball = pyvista.Icosphere(radius=math.sqrt(3), nsub=level)
        mesh = octafield.TriangleMesh(ball.points.astype(float), ball.regular_faces)
        kept = octafield.SurfaceFieldOptions(remesh=False, features="none")
        wanted = octafield.QuadLayoutOptions(quads=quads)
        record = octafield.compute_quad_layout(mesh, kept, layout_options=wanted, singularities=points).record
        made = sum(record.cpu_seconds.get(phase, 0.0) for phase in MADE)
        exponent = f"{math.log(made / before[1]) / math.log(record.triangles / before[0]):.2f}" if before else ""
        before = record.triangles, made
        impose = record.cpu_seconds["impose"]
        rows.append(
            [f"{record.triangles:,}", f"{record.quads:,}", f"{impose:.1f}", f"{made:.2f}", exponent,
             f"{sum(record.cpu_seconds.values()):.1f}", f"{record.peak_mb:,.0f}"]
        )  # fmt: skip
        print(*rows[-1], flush=True)
    header = ("triangles", "quads", "field, CPU s", "layout and quads, CPU s", "exponent", "all, CPU s", "MB")
    return markdown_table(header, rows)


def main() -> None:
    if len(sys.argv) == 5 and not sys.argv[1].startswith("-"):  # one file, in a process of its own
        Path(sys.argv[4]).write_text(json.dumps(measure(Path(sys.argv[1]), int(sys.argv[2]), sys.argv[3])))
        return
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--data", type=Path, default=DATA)
    parser.add_argument("--only", default="", help="names with commas")
    parser.add_argument("--quads", type=int, default=0, help="0: 2,000; of spheres 10,000")
    parser.add_argument("--axes", default="orthogonal", choices=("orthogonal", "free"), help="of the quads of HexMe")
    parser.add_argument("--cost", help="times that the triangles of an icosahedron are cut into four")
    parser.add_argument("--gmsh", action="store_true", help="Gmsh's quads beside them (gmsh of requirements-test.txt)")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    if given.cost:
        text = cost([int(word) for word in given.cost.split(",")], given.quads or 10_000)
        (given.output / "cost.md").write_text(text + "\n" + when())
        return
    only = [word for word in given.only.split(",") if word]
    if given.gmsh:
        quad_beside_gmsh.work(given.data, given.output, only, given.quads or 2_000)
        return
    hexme(given.data, given.output, only, given.quads or 2_000, given.axes)


if __name__ == "__main__":
    main()
