"""Fields inside a jagged coast with islands: Ginzburg-Landau with several coherence lengths, MBO and the eigenvector /
harmonic field, strong and weak boundary.

    python studies/surface_coast.py -o DIR [--edge 0.012] [--levels 6] [--seed 4]

The coast is a random fractal (midpoint displacement of an octagon, 2^levels pieces per side), the islands smaller ones,
resampled at the mesh width; the thesis's Florida keys are not public. Table: CPU seconds, singular points inside and on
the boundary, and the Dirichlet energy of each field at length 1 (one direction per triangle, as in
benchmarks/surface_fields.py), which compares cross fields of different kinds. Strong means weak where the coast turns
too sharply for any field.
"""

import argparse
import sys
import time
from pathlib import Path

import numpy as np
import octafield
from matplotlib.collections import LineCollection
from matplotlib.patches import Rectangle
from study_output import markdown_table, new_figure
from surface_meshes import region
from surface_pictures import STREAMLINE, add_lines, add_points, point_legend, save_drawing

sys.path.insert(0, str(Path(__file__).parent / "benchmarks"))
from surface_fields import common_energy  # noqa: E402


def coast(levels: int, seed: int, roughness: float = 0.27) -> np.ndarray:
    generator = np.random.default_rng(seed)
    angle = 2 * np.pi * np.arange(8) / 8
    points = np.column_stack([np.cos(angle), 0.8 * np.sin(angle)])
    for _ in range(levels):
        step = np.roll(points, -1, axis=0) - points
        shift = roughness * generator.uniform(-1, 1, len(points))[:, None] * np.column_stack([-step[:, 1], step[:, 0]])
        points = np.stack([points, points + step / 2 + shift], axis=1).reshape(-1, 2)
    return points


ISLANDS = {(-0.35, 0.12): 0.16, (0.02, -0.28): 0.1, (0.2, -0.16): 0.07}  # centre: size


def outlines(levels: int, seed: int, edge: float) -> list[np.ndarray]:
    """The coast, then the islands."""
    islands = [
        size * coast(max(levels - 2, 1), seed + 1 + k) + centre for k, (centre, size) in enumerate(ISLANDS.items())
    ]
    return [with_edges(curve, edge) for curve in (coast(levels, seed), *islands)]


def with_edges(curve: np.ndarray, edge: float) -> np.ndarray:
    """The curve's vertices at least an edge apart, and its long sides divided: corners stay."""
    kept = [curve[0]]
    for p in curve[1:]:
        if np.linalg.norm(p - kept[-1]) > 0.8 * edge:
            kept.append(p)
    kept = np.array(kept)
    pieces = [
        np.linspace(a, b, max(1, round(np.linalg.norm(b - a) / edge)) + 1)[:-1]
        for a, b in zip(kept, np.roll(kept, -1, axis=0))
    ]
    return np.concatenate(pieces)


def runs(mean_edge: float) -> dict[str, dict]:
    half = {"epsilon": mean_edge / 2}
    return {
        "eigenvector (harmonic)": {"method": "eigen"},
        "mbo": {"method": "mbo"},
        "gl, eps h/2": half,
        "gl, eps 2 h": {},
        "gl, eps 8 h": {"epsilon": 8 * mean_edge},
        "gl, eps 2 h, N = 6": {"symmetry": 6},
        "gl, eps 2 h, weak": {"boundary_alignment": "weak"},
        "gl, eps 2 h, weak, L = eps / 10": {"boundary_alignment": "weak", "alignment_length": mean_edge / 5},
    }


PANELS = {
    "eigenvector (harmonic)": "eigenvector (harmonic)",
    "gl, eps 2 h": "Ginzburg-Landau, eps = 2 h",
    "gl, eps 2 h, weak": "the same, weak",
    "gl, eps 2 h, N = 6": "the same, strong, N = 6",
}


def draw(output: Path, mesh, features, drawn, size: float) -> None:
    """Above the whole, below the part in the frame, with the points on the boundary."""
    points, part = np.array(mesh.vertices)[:, :2], (-1.12, -0.62, 0.06, 0.56)
    figure, rows = new_figure(11.2, 5.6, 2, len(PANELS), height_ratios=(0.85, 1))
    for upper, lower, (name, title) in zip(*rows, PANELS.items()):
        field, singular = drawn[name]
        for axes, spacing in ((upper, 0.055), (lower, 1.6 * size)):
            add_lines(
                axes,
                octafield.surface.even_streamlines(field, singular, spacing=spacing),
                STREAMLINE,
                0.5,
            )
            axes.add_collection(LineCollection(points[np.array(features.edges)], colors="black", linewidths=0.8))
            axes.set(aspect="equal", xticks=(), yticks=())
        upper.set(title=title, xlim=(-1.15, 1.15), ylim=(-0.98, 0.98))
        upper.axis("off")
        upper.add_patch(Rectangle(part[::2], part[1] - part[0], part[3] - part[2], fill=False, linewidth=0.8, zorder=6))
        add_points(upper, singular, 4, lambda s: not s.boundary)
        add_points(lower, singular, 5, lambda s: not s.boundary)
        add_points(lower, singular, 2.5, lambda s: s.boundary)
        lower.set(xlim=part[:2], ylim=part[2:])
        lower.spines[:].set_visible(True)
    point_legend(figure, "N (small: on the boundary)", separatrices=False)
    save_drawing(figure, output / "surface_coast.png", colours=32)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--edge", type=float, default=0.012)
    parser.add_argument("--levels", type=int, default=6)
    parser.add_argument("--seed", type=int, default=4)
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    loops = outlines(arguments.levels, arguments.seed, arguments.edge)
    mesh = region(loops, lambda points: np.full(len(points), arguments.edge))
    features, mean_edge = octafield.surface.detect_features(mesh), float(octafield.surface.mean_edge_length(mesh))
    rows, drawn = [], {}
    for name, options in runs(mean_edge).items():
        start = time.process_time()
        field = octafield.surface.direction_field(octafield.surface.SurfaceDomain(mesh, features), **options)
        seconds = time.process_time() - start
        singular = octafield.surface.surface_singularities(field)
        directions = np.array(octafield.surface.triangle_directions(field))
        inside = [s.index for s in singular.points if not s.boundary]
        drawn[name] = (field, singular)
        rows.append(
            (
                name,
                f"{seconds:.2f}",
                sum(i > 0 for i in inside),
                sum(i < 0 for i in inside),
                len(singular.points) - len(inside),
                f"{singular.index_sum:g}",
                ("-" if field.symmetry != 4 else f"{common_energy(mesh, features, directions):.1f}"),
                f"{field.energy:.2f}",
                field.iterations,
            )
        )
    header = [
        "method",
        "CPU s",
        "points inside, +",
        "-",
        "on the boundary",
        "index sum",
        "energy at length 1",
        "own energy",
        "iterations",
    ]
    text = (
        f"{len(mesh.triangles):,} triangles, {sum(map(len, loops)):,} boundary edges, {len(loops) - 1} islands, mean"
        f" edge h = {mean_edge:.4f}\n\n" + markdown_table(header, rows)
    )
    draw(arguments.output, mesh, features, drawn, arguments.edge)
    (arguments.output / "summary.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
