"""Critical points of 4- and 6-direction fields tangent to the unit circle: radius and energy against the asymptotic theory (thesis figures 3.8 and 3.9).

    python studies/surface_disk.py -o DIR [--edges 0.04,0.02,0.01,0.007] [--epsilons 0.1,0.07,0.05,0.03,0.02] [--seed 1]

The d critical points sit where the renormalised energy W(r) of a regular d-gon is least: r^(2 d) = (d - 1) / (3 d - 1). DIR gets
pictures, the curves (CSV) and summary.md: radius, its spread, and the energy beside pi d |log eps| + W + d * 1.1966.
Epsilons below 1.5 edge lengths are left out.
"""

import argparse
from pathlib import Path

import numpy as np
from matplotlib.collections import LineCollection
from study_output import markdown_table, new_figure, save_figure, with_grid, write_csv
from surface_meshes import even_disk
from surface_pictures import save_drawing

import octafield
from octafield.plots import PALETTE

PRINTED = {4: 0.85, 6: 0.90}  # Beaufort et al. 2017, caption of figure 8


def solve(edge: float, symmetry: int, epsilon: float, seed: int):
    mesh = even_disk(edge)
    features = octafield.detect_features(mesh)
    field = octafield.direction_field(mesh, features, symmetry=symmetry, epsilon=epsilon, seed=seed)
    return mesh, features, field, octafield.surface_singularities(mesh, field)


def measured(edge: float, symmetry: int, epsilon: float, seed: int) -> dict:
    mesh, _, field, singular = solve(edge, symmetry, epsilon, seed)
    points = np.array([s.position[0] + 1j * s.position[1] for s in singular.points])
    inside = points[abs(points) < 1 - 1e-9]
    renormalised = octafield.disk_renormalised_energy(inside)
    return {
        "d": symmetry, "triangles": len(mesh.triangles), "eps": epsilon, "points": len(points), "radius": abs(inside).mean(),
        "spread": abs(inside).max() - abs(inside).min(), "index_sum": singular.index_sum, "energy": field.energy,
        "asymptotic": octafield.asymptotic_energy(symmetry, renormalised, epsilon), "dirichlet": field.dirichlet_energy,
        "iterations": field.iterations, "converged": field.converged,
    }


def table(rows: list[dict]) -> str:
    lines = []
    for row in rows:
        best = octafield.disk_polygon_radius(row["d"])
        lines.append((row["d"], f"{row['triangles']:,}", f"{row['eps']:g}", row["points"], f"{row['radius']:.4f}", f"{best:.4f}",
                      f"{row['radius'] - best:+.4f}", f"{row['spread']:.4f}", f"{row['energy']:.3f}", f"{row['asymptotic']:.3f}"))
    return markdown_table(["N", "triangles", "eps", "points", "radius", "(d-1)/(3d-1) root", "difference", "largest - smallest radius", "energy", "asymptotic"], lines)


def figure_3_8(output: Path) -> str:
    """W of the regular d-gon against its radius."""
    figure, panels = new_figure(7.6, 3.0, 1, 2)
    radii = np.linspace(0.5, 0.99, 491)
    curves, lines = [], []
    for axes, d, color in zip(panels, PRINTED, PALETTE):
        best = octafield.disk_polygon_radius(d)
        curves.append([octafield.disk_polygon_energy(d, r) for r in radii])
        axes.plot(radii, curves[-1], color=color)
        axes.plot(best, octafield.disk_polygon_energy(d, best), "o", color=color)
        axes.set(title=f"{d} critical points", xlabel="radius", ylabel="W")
        with_grid(axes)
        sampled = radii[np.argmin(curves[-1])]
        lines.append((d, PRINTED[d], f"{best:.5f}", f"{sampled:.3f}", f"{octafield.disk_polygon_energy(d, best):.5f}"))
    save_figure(figure, output / "surface_disk_energy.png")
    write_csv(output / "surface_disk_energy.csv", ["r", "W_4", "W_6"], np.column_stack([radii, *curves]).tolist())
    return markdown_table(["d", "printed radius", "root of (d-1)/(3d-1)", "least sample of the curve", "W there"], lines)


def figure_3_9(output: Path, edge: float, epsilon: float, seed: int) -> None:
    """The fields, their critical points and separatrices, and the circle of theory."""
    figure, panels = new_figure(7.8, 4.0, 1, 2)
    for axes, d in zip(panels, PRINTED):
        mesh, features, field, singular = solve(edge, d, epsilon, seed)
        lines = octafield.even_streamlines(mesh, features, field, singular, spacing=0.07)
        axes.add_collection(LineCollection([line.points[:, :2] for line in lines], colors=PALETTE[6], linewidths=0.5))
        lines = octafield.separatrices(mesh, features, field, singular)
        axes.add_collection(LineCollection([line.points[:, :2] for line in lines], colors=PALETTE[0], linewidths=1.3))
        angle = np.linspace(0, 2 * np.pi, 361)
        best = octafield.disk_polygon_radius(d)
        axes.plot(np.cos(angle), np.sin(angle), color="black", linewidth=1)
        axes.plot(best * np.cos(angle), best * np.sin(angle), ":", color=PALETTE[1], linewidth=1.2)
        x = np.array([s.position for s in singular.points])
        axes.plot(x[:, 0], x[:, 1], "o", color=PALETTE[1], markersize=6)
        axes.set(title=f"N = {d}", aspect="equal", xlim=(-1.03, 1.03), ylim=(-1.03, 1.03))
        axes.axis("off")
    save_drawing(figure, output / "surface_disk_fields.png")


def figure_error(output: Path, rows: list[dict]) -> None:
    figure, panels = new_figure(7.6, 3.2, 1, 2, sharey=True)
    for axes, d in zip(panels, PRINTED):
        for color, triangles in zip(PALETTE, sorted({row["triangles"] for row in rows})):
            chosen = sorted((r["eps"], r["radius"]) for r in rows if r["d"] == d and r["triangles"] == triangles)
            axes.plot(*np.transpose(chosen), "o-", color=color, label=f"{triangles:,} triangles", markersize=4)
        axes.axhline(octafield.disk_polygon_radius(d), color="black", linewidth=0.8, linestyle=":")
        axes.set(title=f"N = {d}", xlabel="eps", xlim=(0, None))
        with_grid(axes)
    panels[0].set_ylabel("mean radius of the critical points")
    panels[0].legend(frameon=False)
    save_figure(figure, output / "surface_disk_radius.png")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--edges", default="0.04,0.02,0.01,0.007")
    parser.add_argument("--epsilons", default="0.1,0.07,0.05,0.03,0.02")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    edges = [float(x) for x in arguments.edges.split(",")]
    epsilons = [float(x) for x in arguments.epsilons.split(",")]
    rows = [measured(edge, d, eps, arguments.seed) for d in PRINTED for edge in edges for eps in epsilons if eps >= 1.5 * edge]
    text = figure_3_8(arguments.output) + "\n" + table(rows)
    figure_error(arguments.output, rows)
    figure_3_9(arguments.output, edges[len(edges) // 2], 0.05, arguments.seed)
    write_csv(arguments.output / "surface_disk.csv", list(rows[0]), [list(row.values()) for row in rows])
    (arguments.output / "summary.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
