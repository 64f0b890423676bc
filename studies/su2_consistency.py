"""Which discrete schemes on the SU(2) invariants are consistent: bar, cube, starts, the thesis's attempts, balls.

    python studies/su2_consistency.py -o DIR [--parts bar,cube,starts,thesis,line,ball] [--schemes sh4,geodesic,...]
    [--amplitude 1] [--balls FILE.mesh.gz ...]

Write-up: docs/su2_smoothing.md. DIR gets a CSV file and a markdown table per part, and the figures su2_*.png. --balls:
    tet meshes of balls (those published with ARFF); part ball is left out without them. --amplitude: of the boundary
    frames of part cube. --schemes: of parts cube, starts and ball, with sh4 in any case.
"""

import argparse
import time
from pathlib import Path

import numpy as np
import octafield
import su2_limits
import su2_thesis
from octafield.view.plots import PALETTE
from study_output import markdown_table, new_figure, save_figure, with_grid, write_csv
from su2_problems import (
    Problem,
    ball,
    bar,
    cube,
    grid_values,
    line_of,
    minimise,
    on_cells,
    random_representatives,
    singular_line,
)

SCHEMES = ("sh4", "geodesic", "su2_geodesic", "su2_surface", "su2_midpoint", "su2_symmetric", "su2_frozen", "su2")
COLOURS = dict(zip(SCHEMES, ("black", *PALETTE)))
SIZES, FINE = (4, 8, 12, 16), 48
LIMITS = (10, 20, 30, 40, np.inf)  # degrees
PARTS = ("bar", "cube", "starts", "thesis", "line", "ball")


def degrees(a: np.ndarray, b: np.ndarray, where: np.ndarray) -> np.ndarray:
    return np.degrees(octafield.frames.distance(a, b))[where]


def edge_angles(problem: Problem, frames: np.ndarray) -> np.ndarray:
    tets = np.asarray(problem.mesh.tets)
    pairs = np.concatenate([tets[:, [i, j]] for i in range(4) for j in range(i + 1, 4)])
    i, j = np.unique(np.sort(pairs, 1), axis=0).T
    return np.degrees(octafield.frames.distance(frames[i], frames[j]))


def orders(values, spacings) -> list[str]:
    """Between neighbours: log of the ratio of values over that of spacings."""
    rates = np.diff(np.log(values)) / np.diff(np.log(spacings))
    return ["-", *(f"{r:.1f}" for r in rates)]


def save(folder: Path, name: str, header, rows) -> None:
    write_csv(folder / f"{name}.csv", header, rows)
    text = [[("-" if np.isnan(x) else f"{x:.4g}") if isinstance(x, float) else x for x in row] for row in rows]
    (folder / f"{name}.md").write_text(markdown_table(header, text))
    print(markdown_table(header, text))


def study_bar(folder: Path) -> None:
    first = octafield.frames.quaternion_exp(np.array([[0.3, 0.2, -0.1]]))
    ends = np.vstack([first, octafield.frames.frame_exp(first, np.array([[0.25, 0.3, -0.3]]))])
    limits = {"su2": "naive", "su2_frozen": "frozen"}
    shown = ("geodesic", "su2_midpoint", "su2_frozen", "su2")
    found, rows = {}, []
    for cells in (8, 16, 32, 64):
        problem = bar(cells, ends)
        x = np.asarray(problem.mesh.vertices)[:, 0]
        for scheme in shown:
            result = minimise(problem, scheme, problem.target, 1e-13)
            limit = su2_limits.path(limits[scheme], ends, x) if scheme in limits else problem.target
            line = degrees(result.frames, problem.target, np.arange(len(x)))
            found[scheme, cells] = x, line
            rows.append([scheme, cells, line.max(), degrees(result.frames, limit, np.arange(len(x))).max()])
    save(
        folder,
        "bar",
        ["scheme", "cells", "max deviation from the geodesic, degrees", "max deviation from its own limit, degrees"],
        sorted(rows, key=lambda row: shown.index(row[0])),
    )
    figure, axes = new_figure(7.5, 3.4)
    fine = np.linspace(0, 1, 101)
    straight = octafield.frames.slerp(np.tile(ends[0], (101, 1)), np.tile(ends[1], (101, 1)), fine)
    for scheme in shown:
        limit = su2_limits.path(limits[scheme], ends, fine) if scheme in limits else straight
        axes.plot(fine, np.degrees(octafield.frames.distance(limit, straight)), color=COLOURS[scheme], linewidth=1)
        x, line = found[scheme, 32]
        axes.plot(x, line, "o", markersize=3, color=COLOURS[scheme], label=scheme)
    axes.set(
        xlabel="x", ylabel="degrees from the geodesic", title="Frames held at both ends of a bar, 28.2 degrees apart"
    )
    with_grid(axes)
    figure.legend(
        *axes.get_legend_handles_labels(),
        loc="outside right center",
        fontsize=9,
        title="dots: 32 cells\nlines: continuum",
    )
    save_figure(figure, folder / "su2_bar.png")


def study_cube(folder: Path, amplitude: float, schemes: list[str]) -> None:
    fine = cube("kuhn", FINE, amplitude)
    reference = minimise(fine, "sh4", fine.target).frames
    rows = []
    for family in ("kuhn", "jittered", "tetgen"):
        for n in SIZES:
            problem = cube(family, n, amplitude)
            sh4 = minimise(problem, "sh4", octafield.volume.initial_frames(problem.mesh, problem.constraints))
            exact = grid_values(reference, FINE, np.asarray(problem.mesh.vertices))
            for scheme in schemes:
                result = sh4 if scheme == "sh4" else minimise(problem, scheme, sh4.frames)
                near, true = (degrees(result.frames, q, problem.free) for q in (sh4.frames, exact))
                rows.append(
                    [
                        family,
                        scheme,
                        n,
                        len(problem.free),
                        near.mean(),
                        near.max(),
                        true.mean(),
                        true.max(),
                        result.energy / sh4.energy - 1,
                        "yes" if result.converged else "no",
                    ]
                )
    save(
        folder,
        f"cube_{amplitude:g}",
        [
            "mesh",
            "scheme",
            "n",
            "free vertices",
            "mean from sh4",
            "max from sh4",
            "mean from reference",
            "max from reference",
            "E / E(sh4) - 1",
            "converged",
        ],
        rows,
    )
    table = []
    figure, panels = new_figure(11, 3.4, 1, 3, sharey=True)
    for axes, family in zip(panels, ("kuhn", "jittered", "tetgen")):
        for scheme in schemes:
            mine = [row for row in rows if row[0] == family and row[1] == scheme]
            means = [row[6] for row in mine]
            axes.loglog(
                SIZES,
                means,
                "o--" if scheme == "su2_geodesic" else "o-",
                color=COLOURS[scheme],
                label=scheme,
                markersize=4,
                linewidth=1.2,
            )
            if scheme != "sh4":
                table.append(
                    [
                        family,
                        scheme,
                        *(f"{row[4]:.4f} ({row[5]:.3f})" for row in mine),
                        orders([row[4] for row in mine], 1 / np.array(SIZES))[-1],
                        orders(means, 1 / np.array(SIZES))[-1],
                    ]
                )
        axes.loglog(SIZES, 8.0 / np.array(SIZES) ** 2, ":", color="gray", label="second order")
        on_cells(axes, SIZES, family)
    panels[0].set_ylabel("mean degrees from the fine reference")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside right center", fontsize=9)
    save_figure(figure, folder / f"su2_cube_{amplitude:g}.png")
    save(
        folder,
        f"cube_{amplitude:g}_orders",
        ["mesh", "scheme", *(f"n = {n}" for n in SIZES), "order (sh4)", "order (reference)"],
        table,
    )


def study_starts(folder: Path, schemes: list[str]) -> None:
    rows = []
    for family, n in (("kuhn", 8), ("tetgen", 8)):
        problem, rng = cube(family, n), np.random.default_rng(1)
        linear = octafield.volume.initial_frames(problem.mesh, problem.constraints)
        sh4 = minimise(problem, "sh4", linear).frames
        noise = rng.uniform(-1, 1, (len(sh4), 3))
        starts = {
            "sh4": sh4,
            "diffusion": octafield.volume.diffuse(problem.mesh, problem.constraints, linear).frames,
            **{f"target + {a}": octafield.frames.frame_exp(problem.target, a * noise) for a in (0.05, 0.3, 0.5)},
            "random": octafield.frames.random_rotations(len(sh4), seed=2),
        }
        for label, start in starts.items():
            row = [family, label]
            for scheme in schemes:
                result = minimise(problem, scheme, random_representatives(start, rng), 1e-10)
                away = degrees(result.frames, sh4, problem.free)
                row.append(f"{away.mean():.3f} ({away.max():.2f})")
            rows.append(row)
    save(
        folder,
        "starts",
        ["mesh", "start", *schemes],
        rows,
    )


def study_thesis(folder: Path) -> None:
    rows = []
    for n in (4, 8, 12):
        problem = cube("kuhn", n)
        sh4 = minimise(problem, "sh4", problem.target)
        attempts = {
            "linear (4.4.1), projected here": su2_thesis.linear(problem),
            "Euler angles (4.4.2) from sh4": su2_thesis.euler_angles(problem, sh4.frames),
            "Euler angles (4.4.2) from the linear field": su2_thesis.euler_angles(problem, su2_thesis.linear(problem)),
            "the same minimised on quaternions, from sh4": minimise(problem, "su2", sh4.frames).frames,
            "metric (4.4.3) at vertices, held in each step": su2_thesis.held_metric(problem, sh4.frames),
            "metric (4.4.3) at vertices, differentiated": minimise(problem, "su2_symmetric", sh4.frames).frames,
        }
        for label, frames in attempts.items():
            away = degrees(frames, sh4.frames, problem.free)
            energy = octafield.volume.dirichlet_energy(problem.mesh, frames)
            rows.append([label, n, away.mean(), away.max(), energy / sh4.energy - 1])
    rows.sort(key=lambda row: list(attempts).index(row[0]))
    save(folder, "thesis", ["scheme", "n", "mean from sh4", "max from sh4", "E / E(sh4) - 1"], rows)


def study_line(folder: Path) -> None:
    """Away from a singular line: at free vertices a quarter of the cube or more from it."""
    sizes = (5, 9, 13, 17)
    rows = []
    for scheme in ("sh4", "geodesic", "su2_midpoint"):
        means, largest = [], []
        for n in sizes:
            problem = singular_line(n)
            assert problem.target is not None
            result = minimise(problem, scheme, problem.target, 1e-10)
            far = np.linalg.norm(np.asarray(problem.mesh.vertices)[problem.free, :2] - line_of(n), axis=1) > 0.25
            away = degrees(result.frames, problem.target, problem.free[far])
            means.append(away.mean())
            largest.append(away.max())
        slopes = (-np.polyfit(np.log(sizes), np.log(values), 1)[0] for values in (means, largest))
        rows.append([scheme, *(f"{m:.3f} ({x:.2f})" for m, x in zip(means, largest)), *(f"{s:.1f}" for s in slopes)])
    save(folder, "line", ["scheme", *(f"n = {n}" for n in sizes), "order of means", "of maxima"], rows)


def study_ball(folder: Path, paths: list[Path], names: list[str]) -> None:
    schemes = [
        ("sh4", {}),
        ("geodesic", {}),
        ("su2_geodesic", {}),
        ("su2_surface", {}),
        *(("su2_midpoint", {"midpoint_limit": np.radians(limit)}) for limit in LIMITS),
        ("su2_frozen", {}),
        ("su2", {}),
    ]
    schemes = [(name, options) for name, options in schemes if name in names]
    rows, drawn, edges = [], [], []
    for path in paths:
        problem, rng = ball(path), np.random.default_rng(4)
        field = octafield.volume.frame_field(problem.mesh, problem.constraints).smooth
        noise = rng.uniform(-1, 1, field.frames.shape[:1] + (3,))
        edges.append(
            [problem.name, *(float(np.mean(edge_angles(problem, field.frames) < limit)) for limit in LIMITS[:-1])]
        )
        starts = {
            "frame_field": field.frames,
            **{f"+ {a} rad": octafield.frames.frame_exp(field.frames, a * noise) for a in (0.1, 0.3)},
            "linear": octafield.volume.initial_frames(problem.mesh, problem.constraints),
        }
        if len(field.frames) > 2000:
            starts = {"frame_field": field.frames}
        for label, start in starts.items():
            for scheme, options in schemes:
                begin = time.process_time()
                result = minimise(problem, scheme, start, 1e-7, **options)
                seconds = time.process_time() - begin
                graph = octafield.volume.singular_graph(problem.mesh, result.frames)
                away = degrees(result.frames, field.frames, problem.free)
                name = scheme + (f" {np.degrees(options['midpoint_limit']):.0f}" if options else "")
                rows.append(
                    [
                        problem.name,
                        label,
                        name,
                        result.energy / field.energy,
                        0.15 * result.energy / result.objective if scheme not in ("sh4", "su2") else float("nan"),
                        np.median(away),
                        away.mean(),
                        away.max(),
                        len(graph.triangles),
                        graph.length,
                        graph.complex_triangles,
                        result.iterations,
                        "yes" if result.converged else "no",
                        seconds,
                    ]
                )
                if (
                    label == "frame_field"
                    and name in ("sh4", "geodesic", "su2_midpoint 20", "su2")
                    and path == paths[-1]
                ):
                    drawn.append((name, problem, result, graph))
    save(folder, "ball_edges", ["mesh", *(f"edges below {limit} degrees" for limit in LIMITS[:-1])], edges)
    save(
        folder,
        "ball",
        [
            "mesh",
            "start",
            "scheme",
            "E / E(sh4)",
            "0.15 E / objective",
            "median",
            "mean",
            "max degrees",
            "singular triangles",
            "length",
            "complex",
            "iterations",
            "converged",
            "CPU s",
        ],
        rows,
    )
    figure, panels = new_figure(12, 3.3, 1, len(drawn), subplot_kw={"projection": "3d"})
    for axes, (name, _, result, graph) in zip(panels, drawn):
        points = np.asarray(graph.points)
        for curve, turns in zip(graph.curves, graph.curve_quarter_turns):
            axes.plot(*points[curve].T, color=PALETTE[0] if turns > 0 else PALETTE[1], linewidth=1.4)
        axes.set_title(f"{name}: E = {result.energy:.2f}", fontsize=10)
        axes.set_box_aspect((1, 1, 1), zoom=1.3)
        axes.set_axis_off()
    save_figure(figure, folder / "su2_ball.png")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--parts", default=",".join(PARTS))
    parser.add_argument("--schemes", default=",".join(SCHEMES))
    parser.add_argument("--amplitude", type=float, default=1)
    parser.add_argument("--balls", type=Path, nargs="*", default=[])
    args = parser.parse_args()
    args.output.mkdir(parents=True, exist_ok=True)
    parts = args.parts.split(",")
    if unknown := set(parts) - set(PARTS):
        parser.error(f"unknown parts {sorted(unknown)}; give some of {','.join(PARTS)}")
    asked = args.schemes.split(",")
    if unknown := set(asked) - set(SCHEMES):
        parser.error(f"unknown schemes {sorted(unknown)}; give some of {','.join(SCHEMES)}")
    schemes = [name for name in SCHEMES if name in asked or name == "sh4"]
    without_symmetric = [name for name in schemes if name != "su2_symmetric"]
    studies = {
        "bar": study_bar,
        "cube": lambda folder: study_cube(folder, args.amplitude, schemes),
        "starts": lambda folder: study_starts(folder, without_symmetric),
        "thesis": study_thesis,
        "line": study_line,
        "ball": lambda folder: study_ball(folder, args.balls, schemes),
    }
    for part in parts:
        if part != "ball" or args.balls:
            studies[part](args.output)


if __name__ == "__main__":
    main()
