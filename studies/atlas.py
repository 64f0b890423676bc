"""Charts of surfaces of all sorts, beside Gmsh's patches.

    python -m studies.atlas -o DIR [--only s05u,nut] [--growth | --picture]

All of the data's surfaces (bad ones after the repair that is advised), the boundaries of HexMe's files, examples of
pyvista and level sets (studies.atlas_shapes). Each is made and mapped in a process of its own, by `octafield.atlas`
with its defaults and by Gmsh (classifySurfaces with 40 degrees and createGeometry, its own atlas of the same thesis),
which are stopped at 120 s of CPU time. That every triangle is positive is told by octafield.surface.not_positive and
again with whole numbers of any size, which know nothing of the library. --growth: seconds of potatoes and foams of up
to a million triangles. DIR gets rows.jsonl, atlas.md, growth.md and when.md.
"""

import argparse
import json
import sys
import tempfile
import time
from fractions import Fraction
from pathlib import Path

import numpy as np
import octafield
from octafield.domain.meshing import prepare_mesh

from .atlas_shapes import SHAPES, foam, potato
from .benchmarks.pages import when
from .hex_dominant.rows import markdown_table, run_words

DATA = Path(__file__).resolve().parents[2] / "shared" / "data"
LIMIT = 120.0  # seconds of CPU time
MOST_EXACT = 50000  # triangles that are tested with whole numbers, too
HEADER = (
    "surface", "triangles", "faces", "handles", "charts", "not one-to-one", "conformity 5 %", "below", "CPU s",
    "Gmsh's patches", "CPU s", "note",
)  # fmt: skip
GROWTH_HEADER = ("surface", "triangles", "charts", "not one-to-one", "conformity 5 %", "CPU s", "µs per triangle")
PICTURED = ("torus", "double torus", "vessel", "gyroid", "foam", "nut")
GROWTH = {"potato": (potato, (80, 140, 235, 428)), "foam": (foam, (45, 80, 140, 260))}


def inputs(data: Path) -> dict[str, str]:
    """Name and file; no file: one of SHAPES."""
    files = {path.name.split(".")[0]: str(path) for path in sorted((data / "surfaces").glob("*.obj"))}
    files |= {path.name.split(".")[0]: str(path) for path in sorted((data / "hexme").glob("*.vtk.gz"))}
    return files | dict.fromkeys(SHAPES, "")


def prepared(name: str, path: str) -> tuple[octafield.MeshedInput, str]:
    """And the level of repair that was needed."""
    source = path or SHAPES[name]()
    for level in ("default", "safe", "fill", "resolve", "wrap"):
        try:
            meshed = prepare_mesh(source, octafield.MeshOptions(remesh=False, repair=level), volume=False)
            return meshed, "" if level == "default" else f"repair {level}"
        except octafield.GeometryError as error:
            failed = error
    if not isinstance(source, octafield.TriangleMesh):
        raise failed
    closed = octafield.surface.repair(source, level="wrap").mesh  # open ones are not wrapped
    return prepare_mesh(closed, octafield.MeshOptions(remesh=False), volume=False), "closed by repair wrap"


def exactly_positive(uv: np.ndarray, triangles: np.ndarray) -> bool:
    exact = [(Fraction(u), Fraction(v)) for u, v in uv.tolist()]
    for a, b, c in triangles.tolist():
        (p, q), (r, s), (t, w) = exact[a], exact[b], exact[c]
        if (r - p) * (w - q) <= (s - q) * (t - p):
            return False
    return True


def mapped(meshed: octafield.MeshedInput) -> dict:
    """CPU seconds are those of the atlas alone."""
    domain = octafield.surface.SurfaceDomain(meshed.surface, meshed.features)
    begun = time.process_time()
    made = octafield.surface.atlas(domain)
    cpu = time.process_time() - begun
    uv, triangles = np.asarray(made.uv), np.asarray(made.uv_triangles)
    bad = len(octafield.surface.not_positive(uv, triangles))
    if len(triangles) <= MOST_EXACT:
        assert exactly_positive(uv, triangles) == (bad == 0)
    areas = np.asarray(octafield.surface.triangle_areas(made.domain.mesh))
    conformity = np.asarray(made.conformity)
    order = np.argsort(conformity)
    place = int(np.searchsorted(np.cumsum(areas[order]), 0.05 * areas.sum()))
    return {
        "triangles": len(triangles), "faces": len(made.face_list), "handles": sum(f.genus for f in made.face_list),
        "charts": len(made.chart_list), "bad": bad, "conformity": float(conformity[order[place]]),
        "below": sum(not chart.as_asked for chart in made.chart_list), "cpu": cpu,
    }  # fmt: skip


def patches(meshed: octafield.MeshedInput) -> dict:
    """Of Gmsh's."""
    import gmsh

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "surface.stl"
        octafield.write_surface(meshed.surface, path)
        gmsh.initialize(interruptible=False)
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.merge(str(path))
    begun = time.process_time()
    gmsh.model.mesh.classifySurfaces(40 * np.pi / 180, True, True)
    gmsh.model.mesh.createGeometry()
    return {"patches": len(gmsh.model.getEntities(2)), "cpu": time.process_time() - begun}


def one(what: str, name: str, path: str, out: str) -> None:
    try:
        meshed, note = prepared(name, path)
        row = (mapped if what == "octafield" else patches)(meshed) | {"note": note}
    except octafield.Error as error:
        row = {"error": f"{error.kind}: {error}"[:200]}
    Path(out).write_text(json.dumps(row))


def cells(row: dict) -> list[str]:
    ours, others = row["octafield"], row["gmsh"]
    beside = [f"{others['patches']:,}", f"{others['cpu']:.2f}"] if "patches" in others else ["none", ""]
    if "error" in ours:
        return [row["name"], *[""] * 8, *beside, ours["error"].partition(":")[0]]
    counts = [f"{ours[name]:,}" for name in ("triangles", "faces", "handles", "charts", "bad")]
    last = [f"{ours['conformity']:.2f}", f"{ours['below']}", f"{ours['cpu']:.2f}"]
    return [row["name"], *counts, *last, *beside, ours["note"]]


def summary(rows: list[dict]) -> str:
    ours = [row["octafield"] for row in rows if "charts" in row["octafield"]]
    both = [row for row in rows if "charts" in row["octafield"] and "patches" in row["gmsh"]]
    return (
        f"{len(rows)} surfaces, {len(ours)} atlases, {sum(row['charts'] for row in ours):,} charts;"
        f" {sum(row['bad'] for row in ours)} triangles not positive. Gmsh has patches of {len(both)} of them:"
        f" {sum(row['gmsh']['patches'] for row in both):,} where octafield has"
        f" {sum(row['octafield']['charts'] for row in both):,} charts;"
        f" {sum(2 * row['octafield']['charts'] <= row['gmsh']['patches'] for row in both)} surfaces with at"
        " most half of Gmsh's number."
    )


def run(data: Path, output: Path, only: list[str]) -> None:
    """Rows that are there already are kept."""
    path = output / "rows.jsonl"
    rows = [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []
    done = {row["name"] for row in rows}
    for name, file in inputs(data).items():
        if name in done or (only and name not in only):
            continue
        row = {"name": name}
        for what in ("octafield", "gmsh"):
            row[what] = run_words(["studies.atlas", "one", what, name, file or "-"], LIMIT)
        rows.append(row)
        with path.open("a") as stream:
            stream.write(json.dumps(row) + "\n")
        print(*cells(row), flush=True)
    (output / "atlas.md").write_text(f"{summary(rows)}\n\n{markdown_table(HEADER, [cells(row) for row in rows])}")


def growth(output: Path) -> None:
    lines = []
    for name, (maker, sizes) in GROWTH.items():
        for n in sizes:
            meshed = octafield.MeshedInput("", "surface", maker(n), octafield.FeatureGraph(), "none")
            row = mapped(meshed)
            each = f"{1e6 * row['cpu'] / row['triangles']:.1f}"
            lines.append([name, f"{row['triangles']:,}", str(row["charts"]), str(row["bad"]),
                          f"{row['conformity']:.2f}", f"{row['cpu']:.1f}", each])  # fmt: skip
            print(*lines[-1], flush=True)
    (output / "growth.md").write_text(markdown_table(GROWTH_HEADER, lines))


def picture(output: Path) -> None:
    """Charts in colours, of level sets and examples, without features where they are smooth."""
    from PIL import Image

    width, height = 700, 525
    whole = Image.new("RGB", (3 * width, 2 * height), "white")
    for place, name in enumerate(PICTURED):
        features = "angle" if name in ("nut", "scanned part") else "none"
        result = octafield.compute_atlas(SHAPES[name](), octafield.MeshOptions(remesh=False, features=features))
        image = Image.fromarray(result.scene().screenshot(return_img=True)).resize((width, height))
        whole.paste(image, (place % 3 * width, place // 3 * height))
    whole.convert("P", palette=Image.Palette.ADAPTIVE).save(output / "atlas.png", optimize=True)


def main() -> None:
    if sys.argv[1:2] == ["one"]:
        what, name, path, out = sys.argv[2:6]
        one(what, name, "" if path == "-" else path, out)
        return
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--data", type=Path, default=DATA)
    parser.add_argument("--only", default="", help="names with commas")
    parser.add_argument("--growth", action="store_true", help="seconds by size, instead")
    parser.add_argument("--picture", action="store_true", help="atlas.png, instead")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    if given.picture:
        return picture(given.output)
    if given.growth:
        growth(given.output)
    else:
        run(given.data, given.output, [word for word in given.only.split(",") if word])
    (given.output / "when.md").write_text(when())


if __name__ == "__main__":
    main()
