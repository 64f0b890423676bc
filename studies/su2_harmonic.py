"""A manufactured harmonic map: how far the schemes are from a solution that is known, in three norms, on three families
of meshes.

    python studies/su2_harmonic.py -o DIR [--cells 4,6,8,12] [--schemes sh4,geodesic,...]

Frames are unit quaternions q(x) = g (cos a(r), sin a(r) y / r) with y = x - centre, r = |y| and a'' + 2 a' / r - sin(2
a) / r^2 = 0, a(0) = 0: the harmonic maps from space to the sphere S^3 that turn with y (Eells, Sampson 1964, for the
equation; the reduction is that of every equivariant map). All three axes turn, by different amounts, 60 degrees from
corner to corner. Boundary frames are held; the error is that of the nodes, as the rotation vector from the exact frame
to the computed one. DIR gets harmonic.csv, harmonic.md, su2_harmonic.png, and cost.md: iterations from the linear start
on the finest meshes and CPU seconds of each (all threads, the start included).
"""

import argparse
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import octafield
from octafield.view.plots import PALETTE
from scipy.integrate import solve_ivp
from study_output import markdown_table, new_figure, save_figure, write_csv
from su2_problems import Problem, held, jittered_cube, kuhn_grid, minimise, on_cells, quaternion_product, tetgen_cube

SCHEMES = ("sh4", "geodesic", "su2_surface", "su2_midpoint", "su2_symmetric", "su2_frozen", "su2")
FAMILIES = {
    "kuhn": lambda n: kuhn_grid(n, n, n, 1 / n),
    "jittered": lambda n: jittered_cube(n, 0.2, n),
    "tetgen": tetgen_cube,
}
CELLS = (4, 6, 8, 12)
NORMS = ("L2", "H1", "max")
CENTRE, SLOPE = np.array([0.2, 0.4, -0.3]), 0.4
TURNED = np.array([[0.3, 0.2, -0.1]])  # rotation vector of g: far from the symmetric frames


def angle_of(radius: np.ndarray) -> np.ndarray:
    """a at distances from the centre; near it, a = s r - 2/15 s^3 r^3 + O(r^5)."""
    begin = 1e-3

    def right_side(r: float, a: Sequence[float]) -> list[float]:
        return [a[1], np.sin(2 * a[0]) / r**2 - 2 * a[1] / r]

    first = [SLOPE * begin - 2 / 15 * (SLOPE * begin) ** 3, SLOPE - 2 / 5 * SLOPE**3 * begin**2]
    solved = solve_ivp(right_side, (begin, 3), first, method="DOP853", rtol=1e-12, atol=1e-14, dense_output=True)
    near = SLOPE * radius - 2 / 15 * (SLOPE * radius) ** 3
    return np.where(radius < begin, near, solved.sol(np.clip(radius, begin, 3))[0])


def exact_frames(points: np.ndarray) -> np.ndarray:
    """(n, 4) unit quaternions at points (n, 3)."""
    y = points - CENTRE
    radius = np.linalg.norm(y, axis=1)
    direction = y / np.maximum(radius, 1e-300)[:, None]
    a = angle_of(radius)
    turned = np.repeat(octafield.frames.quaternion_exp(TURNED), len(points), axis=0)
    return quaternion_product(turned, np.column_stack([np.cos(a), np.sin(a)[:, None] * direction]))


def problem_of(family: str, n: int) -> Problem:
    mesh = FAMILIES[family](n)
    frames = exact_frames(np.asarray(mesh.vertices))
    boundary = np.asarray(octafield.volume.boundary_surface(mesh).vertex_map)
    return Problem(
        f"{family} n = {n}",
        1 / n,
        mesh,
        held(mesh, frames, boundary),
        frames,
        np.setdiff1d(np.arange(len(frames)), boundary),
    )


def solved(problem: Problem, scheme: str) -> octafield.volume.SmoothResult:
    """From the linear field of sh4, as every method here starts."""
    start = octafield.volume.initial_frames(problem.mesh, problem.constraints)
    return minimise(problem, scheme, start)


def errors(problem: Problem, frames: np.ndarray) -> dict[str, float]:
    """In degrees: root mean square over the cube, of the gradient (degrees per side), and the largest."""
    assert problem.target is not None
    difference = np.degrees(octafield.frames.frame_log(problem.target, frames))
    mass, stiffness = np.asarray(octafield.volume.lumped_mass(problem.mesh)), octafield.volume.stiffness(problem.mesh)
    return {
        "L2": float(np.sqrt(mass @ np.sum(difference**2, axis=1) / mass.sum())),
        "H1": float(np.sqrt(max(0.0, np.sum(difference * (stiffness @ difference))) / mass.sum())),
        "max": float(np.linalg.norm(difference, axis=1).max()),
    }


def order(values: Sequence[float], cells: Sequence[int]) -> float:
    """Slope of a straight line through all meshes, logarithms of both."""
    return float(-np.polyfit(np.log(cells), np.log(values), 1)[0])


def study(folder: Path, cells: Sequence[int], schemes: Sequence[str]) -> list[list[Any]]:
    rows: list[list[Any]] = []
    cost: list[list[Any]] = []
    figure, panels = new_figure(11, 3.4, 1, 3, sharey=True)
    for axes, family in zip(panels, FAMILIES, strict=True):
        problems = [problem_of(family, n) for n in cells]
        for colour, scheme in zip(("black", *PALETTE), schemes, strict=False):
            results = []
            for problem in problems:
                begin = time.process_time()
                results.append(solved(problem, scheme))
                seconds = time.process_time() - begin
            steps = results[-1].iterations
            cost.append([family, scheme, steps, seconds / max(1, steps)])
            found = [errors(problem, result.frames) for problem, result in zip(problems, results, strict=True)]
            for norm in NORMS:
                values = [each[norm] for each in found]
                rows.append(
                    [
                        family,
                        scheme,
                        norm,
                        *values,
                        order(values, cells),
                        "yes" if all(r.converged for r in results) else "no",
                    ]
                )
            axes.loglog(
                cells, [each["L2"] for each in found], "o-", color=colour, label=scheme, markersize=4, linewidth=1.2
            )
        axes.loglog(cells, 2.0 / np.array(cells) ** 2, ":", color="gray", label="second order")
        on_cells(axes, cells, family)
    panels[0].set_ylabel("L2 error, degrees")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside right center", fontsize=9)
    save_figure(figure, folder / "su2_harmonic.png")
    header = ["mesh", "scheme", "norm", *(f"n = {n}" for n in cells), "order", "converged"]
    write_csv(folder / "harmonic.csv", header, rows)
    text = markdown_table(header, [[f"{x:.4g}" if isinstance(x, float) else x for x in row] for row in rows])
    (folder / "harmonic.md").write_text(text)
    print(text)
    text = markdown_table(
        ["mesh", "scheme", f"iterations, n = {cells[-1]}", "CPU s of each"],
        [[family, scheme, steps, f"{seconds:.3g}"] for family, scheme, steps, seconds in cost],
    )
    (folder / "cost.md").write_text(text)
    print(text)
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument(
        "--cells", default=",".join(map(str, CELLS)), help="cells along a side of the cube, with commas"
    )
    parser.add_argument(
        "--schemes",
        default=",".join(SCHEMES),
        help="names of representations and metrics of octafield.volume.smooth, with commas",
    )
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    study(arguments.output, [int(n) for n in arguments.cells.split(",")], arguments.schemes.split(","))


if __name__ == "__main__":
    main()
