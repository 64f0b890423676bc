"""Quads with a fixed boundary: how often they fail, and how good they are beside Gmsh's.

    python -m studies.channel -o DIR [--edge 0.04] [--angles 90] [--quads 2000]

1. One coast with islands (fractal, seeded), 4 offsets of the squares inside and `angles` turns from 0 to 90 degrees:
   failures, angles, vertices inside of other than four quads. Simons (2024, 2.3) has 18 failures of 360 on Merced
   County.
2. Merced County and the coast, with about `quads` quads, and Gmsh on the same segments. The county is in the package
   plotly-geo (pip install plotly-geo; US Census Bureau, public domain); without it only the coast is made.

Every mesh is judged here, in numpy: open edges are the outline's segments, corners are below 180 degrees.
"""

import argparse
import time
from pathlib import Path

import numpy as np
import octafield
from octafield.planar.quads import corner_angles
from study_output import markdown_table

from .gmsh_beside import ALGORITHMS, meshed
from .outlines import coast_outline, county_file, county_outline
from .pictures import draw

MERCED = "06047"
OFFSETS = ((0, 0), (0.5, 0), (0, 0.5), (0.5, 0.5))
HEADER = (
    "", "elements", "triangles", "quads", "least angle", "largest", "irregular inside", "3 / 5 / other",
    "segments kept", "CPU s",
)  # fmt: skip


def judged(points: np.ndarray, triangles: np.ndarray, quads: np.ndarray, outline) -> dict:
    triangles, quads = (_counter_clockwise(points, cells) for cells in (triangles, quads))
    sides = [np.sort(cells[:, [k, (k + 1) % n]], axis=1) for cells, n in ((triangles, 3), (quads, 4)) for k in range(n)]
    edges, count = np.unique(np.concatenate(sides), axis=0, return_counts=True)
    rim = edges[count == 1]
    kept = _as_places(points, rim) & _as_places(np.asarray(outline.points), np.asarray(outline.loops))
    inside = np.ones(len(points), bool)
    inside[rim] = False
    valence = np.bincount(edges.ravel(), minlength=len(points))
    valence = valence[inside & (valence > 0)]
    corners = np.concatenate([corner_angles(points, cells).ravel() for cells in (triangles, quads)])
    return {
        "triangles": len(triangles),
        "quads": len(quads),
        "angles": (corners.min(), corners.max()),
        "three": int((valence == 3).sum()),
        "five": int((valence == 5).sum()),
        "other": int((~np.isin(valence, (3, 4, 5))).sum()),
        "kept": len(kept),
        "whole": len(kept) == len(rim) == len(outline.loops),
        "sound": bool((count <= 2).all() and corners.max() < 180),
    }


def _counter_clockwise(points: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """Gmsh's cells run as the outline's loop does: all turned where their areas sum to less than 0."""
    x, y = points[cells, 0], points[cells, 1]
    return cells[:, ::-1] if (x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y).sum() < 0 else cells


def _as_places(points: np.ndarray, edges: np.ndarray) -> set:
    return {frozenset(map(tuple, ends)) for ends in np.round(points[edges], 12).tolist()}


def of_channel(outline, edge_length: float, **options) -> tuple[dict, object]:
    start = time.process_time()
    made = octafield.compute_fixed_boundary_quads(outline, edge_length=edge_length, spacing="accept", **options)
    seconds = time.process_time() - start
    return judged(*arrays(made), made_outline(made)) | {"seconds": seconds}, made


def arrays(made) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return np.asarray(made.mesh.vertices)[:, :2], np.zeros((0, 3), int), np.asarray(made.mesh.quads)


def made_outline(made):
    """With the middles of segments that were split."""
    return octafield.surface.PlanarOutline(np.asarray(made.mesh.vertices)[:, :2], made.made.boundary)


def robustness(edge_length: float, angles: int) -> str:
    outline = coast_outline(edge_length)
    found, failures = [], []
    for offset in OFFSETS:
        for k in range(angles):
            turn = np.pi / 2 * k / angles
            try:
                row, _ = of_channel(outline, edge_length, rotation=turn, offset=offset, odd_loops="split_one")
                if not (row["sound"] and row["whole"] and row["triangles"] == 0):
                    failures.append((offset, k, "unsound"))
                found.append(row)
            except octafield.Error as error:
                failures.append((offset, k, error.kind))
    low, high = np.array([row["angles"] for row in found]).T
    irregular = np.array([row["three"] + row["five"] + row["other"] for row in found])
    seconds = np.array([row["seconds"] for row in found])
    return (
        f"{len(OFFSETS) * angles} configurations of a coast with {len(outline.loops)} segments, edge length"
        f" {edge_length:g}: {len(failures)} failures{f' {failures}' if failures else ''}. Quads"
        f" {min(r['quads'] for r in found):,} to {max(r['quads'] for r in found):,}. Least angle {low.min():.1f} to"
        f" {low.max():.1f} (median {np.median(low):.1f}), largest {high.min():.1f} to {high.max():.1f} (median"
        f" {np.median(high):.1f}) degrees; irregular vertices inside {irregular.min()} to {irregular.max()} (median"
        f" {np.median(irregular):.0f}); {np.median(seconds):.2f} CPU s (median).\n"
    )


def line(name: str, row: dict) -> tuple:
    irregular = row["three"] + row["five"] + row["other"]
    return (
        name, row["triangles"] + row["quads"], row["triangles"], row["quads"], f"{row['angles'][0]:.2f}",
        f"{row['angles'][1]:.2f}", irregular, f"{row['three']} / {row['five']} / {row['other']}", row["kept"],
        f"{row['seconds']:.2f}",
    )  # fmt: skip


def beside(name: str, outline, edge_length: float, folder: Path) -> str:
    text = f"\n{name}: {len(outline.loops)} segments, edge length {edge_length:.4g}\n\n"
    rows = []
    for label, algorithm in ALGORITHMS.items():
        start = time.process_time()
        mesh = meshed(outline, algorithm, edge_length)
        rows.append(line(label, judged(*mesh, outline) | {"seconds": time.process_time() - start}))
    for label, odd in (("octafield", "split_one"), ("octafield, all segments split", "split_all")):
        row, made = of_channel(outline, edge_length, odd_loops=odd)
        rows.append(line(label, row))
        if odd == "split_one":
            draw(folder / f"channel_{name.split()[0].lower()}.png", made)
    return text + markdown_table(HEADER, rows)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--edge", type=float, default=0.04)
    parser.add_argument("--angles", type=int, default=90)
    parser.add_argument("--quads", type=int, default=2000)
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    text = ""
    counties = county_file()
    if counties is not None:
        text += beside("Merced County", *county_outline(counties, MERCED, arguments.quads), arguments.output)
    edge = 0.03 * np.sqrt(2300 / arguments.quads)
    text += beside("Coast with islands", coast_outline(edge), edge, arguments.output)
    text += "\n" + robustness(arguments.edge, arguments.angles)
    (arguments.output / "summary.md").write_text(text.lstrip())
    print(text)


if __name__ == "__main__":
    main()
