"""Critical points of 4- and 6-direction fields tangent to the unit circle: radius and energy against the asymptotic
theory (thesis figures 3.8 and 3.9).

    python studies/surface_disk.py -o DIR [--edges 0.04,0.02,0.01,0.007] [--epsilons 0.1,0.07,0.05,0.03,0.02,0.014]
    [--seed 1]

The d critical points sit where the renormalised energy W(r) of a regular d-gon is least: r^(2 d) = (d - 1) / (3 d - 1).
DIR gets pictures, the curves (CSV) and summary.md: radius, its spread, and the energy beside pi d |log eps| + W + d *
1.1966. Points are located by a fit to the core (surface_points.py). Epsilons below 1.5 edge lengths are left out.
"""

import argparse
from pathlib import Path

import numpy as np
import octafield
from matplotlib.lines import Line2D
from octafield.view.plots import PALETTE
from study_output import markdown_table, new_figure, with_grid, write_csv
from surface_meshes import even_disk
from surface_pictures import SEPARATRIX, STREAMLINE, add_lines, add_points, point_legend, save_drawing
from surface_points import located_in_plane

PRINTED = {4: 0.85, 6: 0.90}  # Beaufort et al. 2017, caption of figure 8


def solve(edge: float, symmetry: int, epsilon: float, seed: int):
    mesh = even_disk(edge)
    features = octafield.surface.detect_features(mesh)
    field = octafield.surface.direction_field(
        octafield.surface.SurfaceDomain(mesh, features), symmetry=symmetry, epsilon=epsilon, seed=seed
    )
    return mesh, field, octafield.surface.surface_singularities(field)


def measured(edge: float, symmetry: int, epsilon: float, seed: int) -> dict:
    mesh, field, singular = solve(edge, symmetry, epsilon, seed)
    points = np.array([s.position for s in singular.points])
    inside = located_in_plane(mesh, field, points[[not s.boundary for s in singular.points]], epsilon)
    renormalised = octafield.surface.disk_renormalised_energy(inside)
    return {
        "d": symmetry,
        "triangles": len(mesh.triangles),
        "eps": epsilon,
        "points": len(points),
        "radius": abs(inside).mean(),
        "spread": abs(inside).max() - abs(inside).min(),
        "index_sum": singular.index_sum,
        "energy": field.energy,
        "asymptotic": octafield.surface.asymptotic_energy(symmetry, renormalised, epsilon),
        "dirichlet": field.dirichlet_energy,
        "iterations": field.iterations,
        "converged": field.converged,
    }


def table(rows: list[dict]) -> str:
    lines = []
    for row in rows:
        best = octafield.surface.disk_polygon_radius(row["d"])
        lines.append(
            (
                row["d"],
                f"{row['triangles']:,}",
                f"{row['eps']:g}",
                row["points"],
                f"{row['radius']:.4f}",
                f"{best:.4f}",
                f"{row['radius'] - best:+.4f}",
                f"{row['spread']:.0e}",
                f"{row['energy']:.3f}",
                f"{row['asymptotic']:.3f}",
                f"{row['energy'] - row['asymptotic']:+.3f}",
            )
        )
    return markdown_table(
        [
            "N",
            "triangles",
            "eps",
            "points",
            "radius",
            "(d-1)/(3d-1) root",
            "difference",
            "largest - smallest radius",
            "energy",
            "asymptotic",
            "energy - asymptotic",
        ],
        lines,
    )


def figure_3_8(output: Path) -> str:
    """W of the regular d-gon against its radius."""
    figure, panels = new_figure(7.6, 3.0, 1, 2)
    radii = np.linspace(0.5, 0.99, 491)
    curves, lines = [], []
    for axes, d, color in zip(panels, PRINTED, PALETTE):
        best = octafield.surface.disk_polygon_radius(d)
        curves.append([octafield.surface.disk_polygon_energy(d, r) for r in radii])
        axes.plot(radii, curves[-1], color=color)
        axes.plot(best, octafield.surface.disk_polygon_energy(d, best), "o", color=color)
        axes.set(title=f"{d} critical points", xlabel="radius", ylabel="W")
        with_grid(axes)
        sampled = radii[np.argmin(curves[-1])]
        lines.append(
            (d, PRINTED[d], f"{best:.5f}", f"{sampled:.3f}", f"{octafield.surface.disk_polygon_energy(d, best):.5f}")
        )
    save_drawing(figure, output / "surface_disk_energy.png")
    write_csv(output / "surface_disk_energy.csv", ["r", "W_4", "W_6"], np.column_stack([radii, *curves]).tolist())
    return markdown_table(
        ["d", "printed radius", "root of (d-1)/(3d-1)", "least sample of the curve", "W there"], lines
    )


def figure_3_9(output: Path, edge: float, epsilon: float, seed: int) -> None:
    """The fields, their critical points and separatrices, and the circle of theory."""
    figure, panels = new_figure(7.8, 4.4, 1, 2)
    for axes, d in zip(panels, PRINTED):
        mesh, field, singular = solve(edge, d, epsilon, seed)
        add_lines(axes, octafield.surface.even_streamlines(field, singular, spacing=0.07), STREAMLINE, 0.6)
        add_lines(
            axes,
            octafield.surface.separatrices(field, singular, singular_radius=3 * edge),
            SEPARATRIX,
            1.3,
        )
        angle = np.linspace(0, 2 * np.pi, 361)
        best = octafield.surface.disk_polygon_radius(d)
        axes.plot(np.cos(angle), np.sin(angle), color="black", linewidth=1)
        axes.plot(best * np.cos(angle), best * np.sin(angle), ":", color="black", linewidth=1.2)
        add_points(axes, singular)
        axes.set(title=f"N = {d}; dotted: radius {best:.4f}", aspect="equal", xlim=(-1.03, 1.03), ylim=(-1.03, 1.03))
        axes.axis("off")
    point_legend(figure, "N", signs=(1,))
    save_drawing(figure, output / "surface_disk_fields.png")


def figure_error(output: Path, rows: list[dict]) -> None:
    """What is left of radius and energy as epsilon falls, on each mesh."""
    figure, panels = new_figure(8.2, 3.4, 1, 2)
    meshes = sorted({row["triangles"] for row in rows})
    styles, colors = dict(zip(meshes, (":", "-.", "--", "-"))), dict(zip(PRINTED, PALETTE))
    for row_of, axes in zip(
        (
            lambda r: r["radius"] - octafield.surface.disk_polygon_radius(r["d"]),
            lambda r: r["energy"] - r["asymptotic"],
        ),
        panels,
    ):
        for d in PRINTED:
            for triangles in meshes:
                chosen = sorted((r["eps"], row_of(r)) for r in rows if r["d"] == d and r["triangles"] == triangles)
                axes.plot(
                    *np.transpose(chosen),
                    styles[triangles],
                    marker="os"[d > 4],
                    color=colors[d],
                    markersize=4,
                    linewidth=1.2,
                )
        axes.axhline(0, color="black", linewidth=0.8)
        axes.set(xlabel="eps", xlim=(0, None))
        with_grid(axes)
    panels[0].set_ylabel("mean radius - theory")
    panels[1].set_ylabel("energy - asymptotic energy")
    handles = [Line2D([], [], color=colors[d], marker="os"[d > 4], markersize=4, label=f"N = {d}") for d in PRINTED]
    handles += [
        Line2D([], [], color="black", linestyle=styles[n], linewidth=1.2, label=f"{n:,} triangles") for n in meshes
    ]
    panels[1].legend(handles=handles, frameon=False, fontsize=9)
    save_drawing(figure, output / "surface_disk_radius.png")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--edges", default="0.04,0.02,0.01,0.007")
    parser.add_argument("--epsilons", default="0.1,0.07,0.05,0.03,0.02,0.014")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    edges = [float(x) for x in arguments.edges.split(",")]
    epsilons = [float(x) for x in arguments.epsilons.split(",")]
    rows = [
        measured(edge, d, eps, arguments.seed)
        for d in PRINTED
        for edge in edges
        for eps in epsilons
        if eps >= 1.5 * edge
    ]
    text = figure_3_8(arguments.output) + "\n" + table(rows)
    figure_error(arguments.output, rows)
    figure_3_9(arguments.output, edges[len(edges) // 2], 0.05, arguments.seed)
    write_csv(arguments.output / "surface_disk.csv", list(rows[0]), [list(row.values()) for row in rows])
    (arguments.output / "summary.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
