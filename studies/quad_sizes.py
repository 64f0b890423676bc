"""Sizes of quads, wanted and reached: the radial tests and the doubling strip of L. Simons (UC Davis 2024), meshed.

    python -m studies.quad_sizes -o DIR [--only exponential,x10]

The disk, radii and easings are those of studies.sized_fields (Simons gives no radii): quads of the edge `OUTER_EDGE`
from radius 1.15 on, 10 or 50 times as large within radius 0.25. The strip is the unit square, sigma = 1 + x. Sizes of
quads are the roots of their areas, by their middles; both are found on arrays. Each mesh of the disk is made in a
process of its own, stopped at 240 s of CPU time. DIR gets summary.md, quad_sizes.png and the meshes as .npz.
"""

import argparse
import json
import sys
from pathlib import Path

import numpy as np
import octafield
from matplotlib.collections import LineCollection

from .benchmarks.pages import when
from .hex_dominant.rows import markdown_table, run_words
from .sized_fields import EASINGS, INNER, OUTER, RADIUS, disk, radial
from .study_output import new_figure
from .surface_pictures import save_drawing

OUTER_EDGE = {10: 0.02, 50: 0.008}  # of quads, by the growth
LIMIT = 240.0  # seconds of CPU time
TRIANGLES = 0.04  # their edge
RADII = (0.0, INNER, 0.55, 0.85, OUTER, RADIUS)
KEPT = octafield.SurfaceFieldOptions(remesh=False)
BANDS = tuple(f"r {low:g} to {high:g}" for low, high in zip(RADII, RADII[1:], strict=False))
HEADER = (
    "easing", "wanted", "quads wanted", "made", "valence 3, 5", "reached", "ratio p10", "median", "p90", *BANDS,
    "SJ min", "mean", "CPU s",
)  # fmt: skip
STRIP = ("quads", "irregular", "ratio p10", "median", "p90", "size at x = 0.05, wanted 1.05", "at 0.95, wanted 1.95")


def sizes_of(result) -> tuple[np.ndarray, np.ndarray]:
    """(q, 3) middles of the quads, and (q,) roots of their areas."""
    corners = np.asarray(result.mesh.vertices)[np.asarray(result.mesh.quads)]
    areas = np.linalg.norm(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]), axis=1) / 2
    return corners.mean(axis=1), np.sqrt(areas)


def radial_row(easing: str, growth: int):
    """The row, and the mesh."""
    edge, sizes = OUTER_EDGE[growth], radial(easing, growth)
    wanted = lambda points: edge * sizes(points)
    result = octafield.compute_quad_mesh(disk(TRIANGLES), KEPT, sizes=wanted)
    record = result.record
    middles, found = sizes_of(result)
    radius, ratios = np.hypot(middles[:, 0], middles[:, 1]), found / wanted(middles)
    bands = []
    for low, high in zip(RADII, RADII[1:], strict=False):
        inside = ratios[(radius >= low) & (radius < high)]
        bands.append(f"{np.median(inside):.2f}" if len(inside) else "none")
    reached = np.median(found[radius < INNER]) / np.median(found[radius > OUTER]) if (radius < INNER).any() else np.nan
    irregular = record.irregular_vertices
    told = (
        easing, f"x{growth}", f"{record.target:,}", f"{record.quads:,}",
        f"{irregular.get('3', 0)}, {irregular.get('5', 0)}", f"x{reached:.1f}",
        *(f"{x:.2f}" for x in np.percentile(ratios, (10, 50, 90))), *bands,
        f"{record.scaled_jacobian.min:.2f}", f"{record.scaled_jacobian.mean:.3f}",
        f"{sum(record.cpu_seconds.values()):.0f}",
    )  # fmt: skip
    return told, result


def one(easing: str, growth: str, folder: str, out: str) -> None:
    try:
        row, result = radial_row(easing, int(growth))
    except octafield.Error as error:
        Path(out).write_text(json.dumps({"error": error.kind}))
        return
    np.savez(file_of(Path(folder), easing, int(growth)), points=result.mesh.vertices, quads=result.mesh.quads)
    Path(out).write_text(json.dumps({"row": row}))


def file_of(folder: Path, easing: str, growth: int) -> Path:
    return folder / f"{easing}_x{growth}.npz"


def strip_row() -> tuple:
    """A plain grid of n by n squares, cut in two."""
    n = 32
    y, x = np.divmod(np.arange((n + 1) ** 2), n + 1)
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    quads = np.column_stack([a, a + 1, a + n + 2, a + n + 1])
    plate = octafield.surface.split_quads(
        octafield.surface.QuadMesh(np.column_stack([x / n, y / n, 0 * x]), quads=quads)
    )
    result = octafield.compute_quad_mesh(plate, KEPT, sizes=lambda points: 0.04 * (1 + points[:, 0]))
    middles, found = sizes_of(result)
    ratios = result.size_ratios
    ends = [f"{np.median(found[abs(middles[:, 0] - at) < 0.05]) / 0.04:.2f}" for at in (0.05, 0.95)]
    spread = (f"{ratio:.2f}" for ratio in np.percentile(ratios, (10, 50, 90)))
    return f"{result.record.quads:,}", f"{result.record.irregular_vertices or 'none'}", *spread, *ends


def draw(axes, points: np.ndarray, quads: np.ndarray, title: str) -> None:
    axes.add_collection(LineCollection(points[quads[:, [0, 1, 2, 3, 0]], :2], colors="black", linewidths=0.15))
    axes.set(aspect="equal", xticks=(), yticks=(), xlim=(-RADIUS, RADIUS), ylim=(-RADIUS, RADIUS))
    axes.spines[:].set_visible(False)
    axes.set_title(title, fontsize=9)


def radial_rows(output: Path, chosen: set[str]) -> list[tuple]:
    rows = []
    figure, panels = new_figure(9.6, 5.0, 1, 2)
    for panel, growth in zip(np.ravel(panels), OUTER_EDGE, strict=True):
        for easing in EASINGS:
            if chosen and not {easing, f"x{growth}"} <= chosen:
                continue
            found = run_words(["studies.quad_sizes", "one", easing, f"{growth}", str(output.absolute())], LIMIT)
            row = tuple(found.get("row", (easing, f"x{growth}", found.get("error"), *[""] * (len(HEADER) - 3))))
            rows.append(row)
            print(*row, flush=True)
            if easing == "exponential" and "row" in found:
                mesh = np.load(file_of(output, easing, growth))
                draw(panel, mesh["points"], mesh["quads"], f"{easing}, wanted {row[1]}, reached {row[5]}")
    save_drawing(figure, output / "quad_sizes.png", colours=8)
    return rows


def main() -> None:
    if sys.argv[1:2] == ["one"]:
        one(*sys.argv[2:6])
        return
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--only", default="", help="an easing and a growth, linear,x10, in place of all")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    rows = radial_rows(given.output, {word for word in given.only.split(",") if word})
    text = when() + "\n\n" + markdown_table(HEADER, rows) + "\n" + markdown_table(STRIP, [strip_row()])
    (given.output / "summary.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
