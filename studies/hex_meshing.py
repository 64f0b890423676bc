"""Hexahedra from the seamless maps of MC3D-samples (Brueckler, Gupta, Mandad, Campen 2022) at three numbers of cells.

    python -m studies.hex_meshing -o DIR [--only s05c,scof] [--cells 500,2000,8000] [--walls own]

The meshes are judged by studies.hex_dominant.checker, which knows arrays alone. DIR gets
rows.jsonl, maps.md and when.md, with --walls own walls.md, and pictures of two meshes cut open.
"""

import argparse
import json
import time
from pathlib import Path

import numpy as np
import octafield
from octafield.hexmesh.hex_mesh import WALLS, compute_hex_mesh
from octafield.hexmesh.hexex import read_seamless_map

from .benchmarks.pages import when
from .hex_dominant import checker
from .study_output import markdown_table

DATA = Path(__file__).resolve().parents[2] / "shared" / "data" / "mc3d"
HEADER = (
    "map", "tets", "blocks", "wanted", "hexahedra", "ratio", "inverted at first", "inverted", "nonconforming", "SJ min",
    "mean", "volume error %", "off features %", "corners lost", "irregular edges", "CPU s", "error",
)  # fmt: skip
PICTURES = {("s12c_cube_rounded_1", 8000), ("hexalab_fandisk", 8000)}


def name_of(path: Path) -> str:
    return path.name.removesuffix(".hexex.gz")


def run(path: Path, cells: int, walls: str, output: Path) -> dict:
    name, begun = name_of(path), time.process_time()
    row: dict = {"map": name, "wanted": cells}
    try:
        result = compute_hex_mesh(path, cells=cells, walls=walls)
    except octafield.Error as error:
        return {**row, "error": f"{error.kind}: {error}", "cpu": time.process_time() - begun}
    row["cpu"] = time.process_time() - begun
    record, given = result.record, result.map
    domain = octafield.volume.map_domain(given)
    edges = np.asarray(domain.surface.vertex_map)[np.asarray(domain.features.edges)]
    figures = checker.check(
        np.asarray(result.mesh.vertices), {"hexahedra": np.asarray(result.mesh.hexahedra)},
        np.asarray(given.mesh.vertices), np.asarray(given.mesh.tets), record.edge_length.median, edges,
    )  # fmt: skip
    if (name, cells) in PICTURES:
        result.scene().screenshot(str(output / f"{name}.png"))
    return {
        **row, "tets": record.tets, "blocks": record.blocks, "first": record.inverted_at_first,
        "irregular": record.irregular_edges, "curves": record.feature_deviation.curves, "notes": record.notes,
        **{k: v for k, v in figures.items() if k != "tets"},
    }  # fmt: skip


def cells_of(row: dict) -> list[str]:
    if "error" in row:
        return [row["map"], *[""] * 2, f"{row['wanted']:,}", *[""] * 11, f"{row['cpu']:.1f}", row["error"]]
    irregular = ", ".join(f"{n} of {valence}" for valence, n in row["irregular"].items())
    return [
        row["map"], f"{row['tets']:,}", str(row["blocks"]), f"{row['wanted']:,}", f"{row['hexahedra']:,}",
        f"{row['hexahedra'] / row['wanted']:.3f}", str(row["first"]), str(row["inverted"]), str(row["nonconforming"]),
        f"{row['hex_sj_min']:.2f}", f"{row['hex_sj_mean']:.3f}", f"{100 * row['volume_error']:.2f}",
        f"{100 * row['curves']:.2f}", f"{row['corners_lost']} of {row['corners']}", irregular, f"{row['cpu']:.1f}", "",
    ]  # fmt: skip


def summary(rows: list[dict]) -> str:
    made = [row for row in rows if "error" not in row]
    sound = [row for row in made if not row["faults"]]
    near = [row for row in made if abs(row["hexahedra"] / row["wanted"] - 1) <= 0.1]
    kept = [row for row in made if row["volume_error"] < 0.01]
    return (
        f"{len(rows)} runs, {len(made)} meshes, {len(sound)} without a fault. Number within 10 % of that wanted:"
        f" {len(near)} of {len(made)}; volume within 1 %: {len(kept)} of {len(made)}."
        f" {sum(r['cpu'] for r in rows):.0f} s of CPU time in all.\n"
    )


WALLS_HEADER = ("map", "tets", "cut", "their blocks", "ours", "hexahedra", "SJ min", "volume error %", "CPU s")


def walls_cells(path: Path, rows: list[dict]) -> list[str]:
    """One row for all numbers of cells: walls of the file beside those of our own."""
    given = read_seamless_map(path)
    walled = octafield.volume.motorcycle_complex(given)
    blocks = [str(len(octafield.volume.block_complex(map_).sizes)) for map_ in (given, walled)]
    made = [row for row in rows if "error" not in row]
    hexahedra = ", ".join("none" if "error" in row else f"{row['hexahedra']:,}" for row in rows)
    return [
        rows[0]["map"], f"{len(given.mesh.tets):,}", f"{len(walled.mesh.tets):,}", *blocks, hexahedra,
        f"{min(row['hex_sj_min'] for row in made):.2f}", f"{100 * max(row['volume_error'] for row in made):.2f}",
        f"{sum(row['cpu'] for row in rows):.1f}",
    ]  # fmt: skip


def walls_table(paths: list[Path], rows: list[dict]) -> str:
    of_map = {path: [row for row in rows if row["map"] == name_of(path)] for path in paths}
    return markdown_table(WALLS_HEADER, (walls_cells(path, found) for path, found in of_map.items()))


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m studies.hex_meshing", description=__doc__)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--only", default="", help="beginnings of names with commas")
    parser.add_argument("--cells", default="500,2000,8000")
    parser.add_argument("--walls", choices=WALLS, default="file")
    a = parser.parse_args()
    a.output.mkdir(parents=True, exist_ok=True)
    only = tuple(filter(None, a.only.split(","))) or ("",)
    paths = [path for path in sorted(DATA.glob("*.hexex.gz")) if path.name.startswith(only)]
    rows = []
    with (a.output / "rows.jsonl").open("w") as file:
        for path in paths:
            for cells in map(int, a.cells.split(",")):
                rows.append(run(path, cells, a.walls, a.output))
                file.write(json.dumps(rows[-1]) + "\n")
                print(" | ".join(cells_of(rows[-1])), flush=True)
    (a.output / "maps.md").write_text(summary(rows) + "\n" + markdown_table(HEADER, map(cells_of, rows)))
    if a.walls == "own":
        (a.output / "walls.md").write_text(walls_table(paths, rows))
    (a.output / "when.md").write_text(when())
    print(summary(rows))


if __name__ == "__main__":
    main()
