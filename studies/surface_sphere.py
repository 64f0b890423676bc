"""Singular points of 4- and 6-direction fields on the unit sphere: the square antiprism and the icosahedron (thesis
figures 3.10, 3.11, 3.13).

    python studies/surface_sphere.py -o DIR [--meshes 12,24,48,96] [--epsilons 0.1,0.05,0.025] [--seeds 3]

2 N singular points of index 1/N; where they sit is decided by the renormalised energy, that is by -sum over pairs of
log|x_i - x_j|. DIR gets pictures, the curve of figure 3.11 (CSV) and summary.md: that sum and the distances of the
points beside its minimisers. Points are located by a fit to the core (surface_points.py). A mesh of number n has 20 n^2
triangles (N = 4, icosahedral) or 8 (1.6 n)^2 (N = 6, octahedral, so that the mesh has not the symmetry of the answer).
"""

import argparse
from pathlib import Path

import numpy as np
import octafield
import pyvista
from octafield.view.plots import PALETTE
from study_output import markdown_table, new_figure, with_grid, write_csv
from surface_meshes import sphere
from surface_pictures import draw_field, save_drawing
from surface_points import located_on_sphere

BEST = {4: -10.428018, 6: -21.606145}  # antiprism of height 2 * 0.564617, icosahedron: by minimising over the points
NAMES = {4: "square antiprism", 6: "icosahedron"}
GROUPS = {4: (8, 8, 4, 8), 6: (30, 30, 6)}  # pairs at equal distance, nearest first
HEIGHT = 0.564617


def pair_distances(points: np.ndarray) -> np.ndarray:
    i, j = np.triu_indices(len(points), 1)
    return np.sort(np.linalg.norm(points[i] - points[j], axis=1))


def grouped(points: np.ndarray, symmetry: int) -> list[np.ndarray]:
    return np.split(pair_distances(points), np.cumsum(GROUPS[symmetry])[:-1])


def squares(height: float, twist: float) -> np.ndarray:
    """Two parallel squares on the sphere, one turned."""
    angle = np.pi / 2 * np.arange(4)
    radius = np.sqrt(1 - height**2)
    ring = lambda turn, z: np.column_stack(
        [radius * np.cos(angle + turn), radius * np.sin(angle + turn), np.full(4, z)]
    )
    return np.concatenate([ring(0, height), ring(twist, -height)])


def exact(symmetry: int) -> np.ndarray:
    if symmetry == 4:
        return squares(HEIGHT, np.pi / 4)
    points = np.asarray(pyvista.PlatonicSolid("icosahedron").points, float)
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def mesh_of(symmetry: int, n: int) -> octafield.TriangleMesh:
    return sphere(n) if symmetry == 4 else sphere(round(1.6 * n), "octahedron")


def solve(symmetry: int, n: int, epsilon: float, seed: int):
    mesh = mesh_of(symmetry, n)
    features = octafield.surface.detect_features(mesh, angle=2.0)
    field = octafield.surface.direction_field(
        octafield.surface.SurfaceDomain(mesh, features), symmetry=symmetry, epsilon=epsilon, seed=seed
    )
    return mesh, field, octafield.surface.surface_singularities(field)


def measured(symmetry: int, n: int, epsilon: float, seed: int) -> tuple:
    mesh, field, singular = solve(symmetry, n, epsilon, seed)
    points = located_on_sphere(mesh, field, np.array([s.position for s in singular.points]), epsilon)
    logarithmic = octafield.surface.logarithmic_energy(points)
    if len(points) == 2 * symmetry:
        distances = ", ".join(f"{g.min():.4f} to {g.max():.4f}" for g in grouped(points, symmetry))
        theory = octafield.surface.asymptotic_energy(
            len(points), octafield.surface.sphere_renormalised_energy(points), epsilon
        )
    else:
        distances, theory = "-", float("nan")
    return (
        symmetry,
        f"{len(mesh.triangles):,}",
        f"{epsilon:g}",
        seed,
        len(points),
        f"{singular.index_sum:g}",
        f"{logarithmic:.5f}",
        f"{logarithmic - BEST[symmetry]:.1e}",
        distances,
        f"{field.energy:.3f}",
        f"{theory:.3f}",
        f"{field.dirichlet_energy:.3f}",
        field.iterations,
        f"{field.residual:.0e}",
    )


def figure_3_11(output: Path) -> str:
    """-sum of log distances against the twist of the two squares, at the height of the thesis and at the best one."""
    twists = np.linspace(0, 90, 181)
    heights = {"1/sqrt(3), the cube's": 1 / np.sqrt(3), f"{HEIGHT}, the best": HEIGHT}
    curves = {
        name: [octafield.surface.logarithmic_energy(squares(z, np.radians(t))) for t in twists]
        for name, z in heights.items()
    }
    figure, axes = new_figure(5.4, 3.4)
    for (name, values), color, style in zip(curves.items(), PALETTE, ("-", "--")):
        axes.plot(twists, values, style, color=color, label=f"squares at z = {name}")
    axes.set(
        xlabel="twist of the two squares (degrees)",
        ylabel="$-\\Sigma_{i<j}\\,\\log |x_i - x_j|$",
        xticks=(0, 15, 30, 45, 60, 75, 90),
    )
    axes.legend(frameon=False)
    with_grid(axes)
    save_drawing(figure, output / "surface_sphere_twist.png")
    write_csv(
        output / "surface_sphere_twist.csv",
        ["twist_deg", "cube_height", "best_height"],
        np.column_stack([twists, *curves.values()]).tolist(),
    )
    rows = [
        (name, f"{values[0]:.6f}", f"{min(values):.6f}", f"{twists[np.argmin(values)]:g}")
        for name, values in curves.items()
    ]
    return markdown_table(["height of the squares", "twist 0", "least", "at twist (degrees)"], rows)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--meshes", default="12,24,48,96")
    parser.add_argument(
        "--epsilons", default="0.1,0.05,0.025", help="the first for every mesh, the others for the finest"
    )
    parser.add_argument("--seeds", type=int, default=3, help="random starts of each mesh")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    sizes = [int(x) for x in arguments.meshes.split(",")]
    epsilons = [float(x) for x in arguments.epsilons.split(",")]
    rows = []
    for symmetry in BEST:
        distances = ", ".join(f"{g[0]:.4f} ({len(g)}x)" for g in grouped(exact(symmetry), symmetry))
        rows.append(
            (
                symmetry,
                NAMES[symmetry],
                "-",
                "-",
                2 * symmetry,
                "2",
                f"{BEST[symmetry]:.5f}",
                "0",
                distances,
                "-",
                "-",
                "-",
                "-",
                "-",
            )
        )
        rows += [measured(symmetry, n, epsilons[0], seed) for n in sizes for seed in range(1, arguments.seeds + 1)]
        rows += [measured(symmetry, sizes[-1], epsilon, 1) for epsilon in epsilons[1:]]
    header = [
        "N",
        "triangles",
        "eps",
        "seed",
        "points",
        "index sum",
        "-sum log",
        "above the best",
        "pair distances, by group",
        "energy",
        "asymptotic",
        "Dirichlet",
        "iterations",
        "residual",
    ]
    text = figure_3_11(arguments.output) + "\n" + markdown_table(header, rows)
    for symmetry in BEST:
        mesh, field, singular = solve(symmetry, sizes[len(sizes) // 2], epsilons[0], 1)
        draw_field(
            arguments.output / f"surface_sphere_{symmetry}.png",
            mesh,
            field,
            singular,
            (0.5, -0.7, 0.5),
            spacing=0.09,
            separatrix=0.35,
        )
    (arguments.output / "summary.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
