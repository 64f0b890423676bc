"""What the penalty of Ginzburg-Landau does to the norm, and which points a boundary with corners asks for (thesis
figures 3.5 and 3.2).

    python studies/surface_norm.py -o DIR [--edge 0.02] [--epsilon 0.05]

Disk: Laplacian smoothing is the limit of a large epsilon; tangent to the unit circle it is f = z^4 (times a constant of
    length 1), so |f| = r^4 and the four critical points fall together in the centre, Dirichlet energy 4 pi.
    Ginzburg-Landau keeps |f| = 1 but for the cores of four points. L-shaped domain, right angles: five corners of index
    +1/4 and one of -1/4, field constant.
"""

import argparse
from pathlib import Path

import numpy as np
import octafield
from octafield.view.plots import PALETTE
from study_output import markdown_table, new_figure, with_grid
from surface_meshes import even_disk, region, resampled
from surface_pictures import add_norm, add_points, save_drawing

HARMONIC = 100.0  # an epsilon that leaves the penalty below 1e-4 of the energy
ELL = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2.0]])


def midpoints(mesh) -> np.ndarray:
    return np.array(mesh.vertices)[np.array(octafield.surface.edge_topology(mesh).edges)].mean(axis=1)[:, :2]


def disk_rows(edge: float, epsilon: float, output: Path) -> list[tuple]:
    mesh = even_disk(edge)
    features, radii = octafield.surface.detect_features(mesh), np.linalg.norm(midpoints(mesh), axis=1)
    figure, panels = new_figure(9.8, 3.0, 1, 3, width_ratios=(1, 1.16, 1.3))
    rows = []
    for axes, name, eps, color in zip(panels, ("Laplacian smoothing", "Ginzburg-Landau"), (HARMONIC, epsilon), PALETTE):
        field = octafield.surface.direction_field(octafield.surface.SurfaceDomain(mesh, features), epsilon=eps)
        singular = octafield.surface.surface_singularities(field)
        norm = abs(np.array(field.values))
        shown = add_norm(axes, mesh, field)
        add_points(axes, singular, 4)
        axes.set(aspect="equal", title=name if eps == HARMONIC else f"{name}, eps = {eps:g}")
        axes.axis("off")
        order = np.argsort(radii)[:: max(1, len(radii) // 3000)]
        panels[2].plot(radii[order], norm[order], ".", color=color, markersize=2, label=name)
        area = np.bincount(
            np.array(field.domain.triangle_edges).ravel(),
            np.repeat(np.array(octafield.surface.triangle_areas(mesh)) / 3, 3),
        )
        rows.append(
            (
                name,
                f"{len(mesh.triangles):,}",
                f"{eps:g}",
                f"{100 * area[norm < 0.5].sum() / area.sum():.1f}",
                f"{np.abs(norm - radii**4).max():.4f}" if eps == HARMONIC else "-",
                f"{field.dirichlet_energy:.3f}",
                f"{4 * np.pi:.3f}" if eps == HARMONIC else "-",
                len(singular.points),
                f"{max(np.linalg.norm(s.position) for s in singular.points):.3f}",
                f"{singular.index_sum:g}",
            )
        )
    r = np.linspace(0, 1, 101)
    panels[2].plot(r, r**4, color="black", linewidth=0.9, linestyle="--", label="r⁴")
    panels[2].set(xlabel="distance from the centre", ylabel="|f| at edge midpoints", ylim=(0, 1.05), xlim=(0, 1))
    panels[2].legend(frameon=False, markerscale=4)
    with_grid(panels[2])
    figure.colorbar(shown, ax=panels[1], shrink=0.7, label="|f|")
    save_drawing(figure, output / "surface_norm_disk.png")
    return rows


def ell_rows(edge: float, epsilon: float) -> list[tuple]:
    size = lambda points: np.full(len(points), edge)
    mesh = region([resampled([np.linspace(a, b, 50) for a, b in zip(ELL, np.roll(ELL, -1, axis=0))], size)], size)
    features = octafield.surface.detect_features(mesh)
    rows = []
    for name, options in (
        ("strong", {}),
        ("weak, L = eps", {"boundary_alignment": "weak", "alignment_length": epsilon}),
    ):
        field = octafield.surface.direction_field(
            octafield.surface.SurfaceDomain(mesh, features), epsilon=epsilon, **options
        )
        singular = octafield.surface.surface_singularities(field)
        signs = [s.index > 0 for s in singular.points]
        rows.append(
            (
                name,
                f"{len(mesh.triangles):,}",
                f"{epsilon:g}",
                sum(signs),
                len(signs) - sum(signs),
                sum(s.boundary for s in singular.points),
                f"{singular.index_sum:g}",
                f"{field.energy:.1e}",
            )
        )
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--edge", type=float, default=0.02)
    parser.add_argument("--epsilon", type=float, default=0.05)
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    disk = disk_rows(arguments.edge, arguments.epsilon, arguments.output)
    ell = ell_rows(2 * arguments.edge, 2 * arguments.epsilon)
    text = markdown_table(
        [
            "disk",
            "triangles",
            "eps",
            "area with abs(f) < 1/2, %",
            "largest error of r^4",
            "Dirichlet",
            "exact",
            "points",
            "farthest from the centre",
            "index sum",
        ],
        disk,
    )
    text += "\n" + markdown_table(
        ["L-shaped domain", "triangles", "eps", "points +1/4", "-1/4", "on the boundary", "index sum", "energy"], ell
    )
    (arguments.output / "summary.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
