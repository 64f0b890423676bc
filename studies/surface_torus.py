"""4-direction fields on the torus R = 1, r = 0.5: the states with 0, 4, ..., 16 singular points, and which of them
costs least (thesis figure 3.15).

    python studies/surface_torus.py -o DIR [--around 144] [--epsilons 0.17,0.12,0.085,0.06,0.042,0.03] [--points
    0,4,6,8,10,12,14,16]

The torus has states for every even number of singular points, half of them of index +1/4 on the outer equator, half of
-1/4 on the inner one: along the curvature lines f turns by exp(-i floor(m/2) phi) on the upper half and exp(+i
ceil(m/2) phi) on the lower one, m points on each equator, phi the azimuth. What a run without constraints reaches is
one of them. To reach each, the field's direction is given at the 2 m azimuths pi k / m of the top and the bottom
circle, where the state's symmetry fixes it (weak constraints); so the constraints change the energy by next to nothing,
and the part they have in it is subtracted. Continuation is left out: it would leave the state. The mesh has around^2
triangles.
"""

import argparse
from pathlib import Path

import numpy as np
import octafield
from octafield.view.plots import PALETTE
from study_output import markdown_table, new_figure, with_grid, write_csv
from surface_meshes import torus
from surface_pictures import draw_field, save_drawing

PUBLISHED = {
    0: "84.58",
    12: "72.10",
}  # thesis, eps 0.06; the first one has no penalty part: it is |f| = 1 along the curvature lines
EARLIER = {
    0: 82.28,
    4: 69.95,
    6: 67.22,
    8: 63.52,
    10: 67.22,
    12: 72.09,
    14: 84.03,
    16: 98.27,
}  # another solver, 20,736 triangles, eps 0.06
WEIGHTS = (1e-3, 1e-2, 1e-1, 1.0, 10.0)  # of each given direction; the stiffness of an edge is about 4
PUBLISHED_EPSILON, ALIGNED = 0.06, 32 * np.pi**2 * (2 - np.sqrt(3))


def azimuthal(vertex: np.ndarray) -> np.ndarray:
    return np.column_stack([-vertex[:, 1], vertex[:, 0], 0 * vertex[:, 0]]) / np.linalg.norm(
        vertex[:, :2], axis=1, keepdims=True
    )


def constraints(mesh, around: int, points: int, weight: float) -> octafield.surface.DirectionConstraints | None:
    """Of the state with so many points; fewer than 6 need more places."""
    across, m = around // 2, points // 2
    count = 2 * m if m > 2 else 24
    vertices, directions = [], []
    for j, turns in ((across // 4, -(m // 2)), (3 * across // 4, (m + 1) // 2)):
        ring = np.round(np.arange(count) * around / count).astype(int) % around
        ids = ring * across + j
        at = np.array(mesh.vertices)[ids]
        theta, phi = 2 * np.pi * j / across, 2 * np.pi * ring / around
        first = azimuthal(at)
        second = np.column_stack(
            [-np.sin(theta) * np.cos(phi), -np.sin(theta) * np.sin(phi), np.full(count, np.cos(theta))]
        )
        angle = turns * phi / 4
        vertices.append(ids)
        directions.append(np.cos(angle)[:, None] * first + np.sin(angle)[:, None] * second)
    return octafield.surface.DirectionConstraints(
        vertices=np.concatenate(vertices),
        vertex_directions=np.concatenate(directions),
        vertex_weights=np.full(2 * count, weight),
    )


def free_energy(mesh, field) -> float:
    """E of the field without its constraints: Dirichlet part and penalty."""
    share = np.repeat(np.array(octafield.surface.triangle_areas(mesh)) / 3, 3)
    masses = np.bincount(np.array(field.domain.triangle_edges).ravel(), share)
    return field.dirichlet_energy + float(np.sum(masses * (abs(np.array(field.values)) ** 2 - 1) ** 2)) / (
        4 * field.epsilon**2
    )


def state(mesh, around: int, points: int, epsilon: float):
    """With the least of the weights that leads there; the last one if none does."""
    for weight in WEIGHTS:
        held = constraints(mesh, around, points, weight)
        field = octafield.surface.direction_field(mesh, epsilon=epsilon, first_epsilon=epsilon, constraints=held)
        singular = octafield.surface.surface_singularities(field)
        if len(singular.points) == points:
            break
    return field, singular, weight


def counts(singular) -> tuple[int, int]:
    signs = [s.index for s in singular.points]
    return sum(i > 0 for i in signs), sum(i < 0 for i in signs)


def states_table(around: int, epsilons: list[float], wanted: list[int]) -> tuple[str, dict]:
    mesh = torus(around, around // 2)
    rows, curves = [], {}
    for points in wanted:
        for epsilon in epsilons:
            field, singular, weight = state(mesh, around, points, epsilon)
            energy, found = free_energy(mesh, field), counts(singular)
            kept = sum(found) == points
            if kept:
                curves.setdefault(points, []).append((epsilon, energy))
            at = abs(epsilon - PUBLISHED_EPSILON) < 1e-9
            rows.append(
                (
                    points,
                    f"{epsilon:g}",
                    f"{found[0]} + {found[1]}",
                    f"{singular.index_sum:g}",
                    f"{energy:.3f}",
                    f"{field.dirichlet_energy:.3f}",
                    f"{weight:g}",
                    f"{field.energy - energy:.1e}",
                    PUBLISHED.get(points, "-") if at else "-",
                    EARLIER.get(points, "-") if at else "-",
                    field.iterations,
                    f"{field.residual:.0e}",
                )
            )
    header = [
        "points asked",
        "eps",
        "points found, + and -",
        "index sum",
        "energy",
        "Dirichlet",
        "weight",
        "of the constraints",
        "published",
        "other solver",
        "iterations",
        "residual",
    ]
    return markdown_table(header, rows), curves


def free_table(around: int, epsilons: list[float]) -> str:
    """Without constraints: each method as it is, and guided by the principal directions. mbo and eigen do not
    depend on epsilon."""
    mesh, rows = torus(around, around // 2), []
    principal = octafield.surface.principal_directions(mesh)
    guide = octafield.surface.DirectionGuide(principal.directions, principal.anisotropy)
    runs = [
        (name, epsilon, {"epsilon": epsilon, **options})
        for epsilon in epsilons
        for name, options in (
            ("gl", {}),
            ("gl, no continuation", {"first_epsilon": epsilon}),
            ("gl, guided by curvature", {"guide": guide}),
        )
    ]
    runs += [(name, None, {"method": name}) for name in ("mbo", "eigen")]
    for name, epsilon, options in runs:
        field = octafield.surface.direction_field(mesh, **options)
        found = counts(octafield.surface.surface_singularities(field))
        rows.append(
            (
                "-" if epsilon is None else f"{epsilon:g}",
                name,
                f"{found[0]} + {found[1]}",
                f"{free_energy(mesh, field):.3f}",
                f"{field.dirichlet_energy:.3f}",
            )
        )
    return markdown_table(["eps", "run", "points found, + and -", "energy", "Dirichlet"], rows)


def aligned(around: int) -> float:
    """Dirichlet energy of |f| = 1 along the curvature lines."""
    mesh = torus(around, around // 2)
    topology = octafield.surface.edge_topology(mesh)
    edges, points = np.array(topology.edges), np.array(mesh.vertices)
    middle = points[edges].mean(axis=1)
    held = octafield.surface.DirectionConstraints(edges, azimuthal(middle))
    return octafield.surface.direction_field(mesh, method="eigen", constraints=held).dirichlet_energy


def energy_figure(path: Path, curves: dict) -> None:
    figure, axes = new_figure(6.6, 4.0)
    markers = "o^vDs*Pp"
    for number, (points, curve) in enumerate(curves.items()):
        epsilon, energy = np.transpose(sorted(curve))
        axes.plot(
            epsilon,
            energy,
            ("-", "--")[number // len(PALETTE)],
            marker=markers[number % len(markers)],
            markersize=5,
            color=PALETTE[number % len(PALETTE)],
            label=f"{points} points",
        )
    for number, value in enumerate(PUBLISHED.values()):
        axes.plot(
            PUBLISHED_EPSILON,
            float(value),
            "x",
            color="black",
            markersize=9,
            markeredgewidth=1.8,
            zorder=5,
            label=None if number else "thesis: 72.10, 84.58",
        )
    axes.set(xlabel="eps", ylabel="energy", xscale="log")
    ticks = sorted({e for curve in curves.values() for e, _ in curve})
    axes.set_xticks(ticks, [f"{e:g}" for e in ticks], minor=False)
    axes.set_xticks([], minor=True)
    axes.legend(frameon=False, ncols=2)
    with_grid(axes)
    save_drawing(figure, path)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--around", type=int, default=144)
    parser.add_argument("--epsilons", default="0.17,0.12,0.085,0.06,0.042,0.03")
    parser.add_argument("--points", default="0,4,6,8,10,12,14,16")
    parser.add_argument("--states-only", action="store_true", help="no runs without constraints, no pictures of fields")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    epsilons = [float(x) for x in arguments.epsilons.split(",")]
    table, curves = states_table(arguments.around, epsilons, [int(x) for x in arguments.points.split(",")])
    along = (
        f"Along the curvature lines, |f| = 1: {aligned(arguments.around):.3f} (exact {ALIGNED:.3f}, thesis"
        f" {PUBLISHED[0]})\n"
    )
    text = "\n".join([along, table, *([] if arguments.states_only else [free_table(arguments.around, epsilons)])])
    energy_figure(arguments.output / "surface_torus_energy.png", curves)
    write_csv(
        arguments.output / "surface_torus.csv",
        ["points", "eps", "energy"],
        [(n, *pair) for n, curve in curves.items() for pair in curve],
    )
    for points in () if arguments.states_only else (8, 12):
        mesh = torus(arguments.around, arguments.around // 2)
        field, singular, _ = state(mesh, arguments.around, points, PUBLISHED_EPSILON)
        draw_field(
            arguments.output / f"surface_torus_{points}.png",
            mesh,
            field,
            singular,
            (0, -0.75, 0.9),
            spacing=0.1,
            separatrix=0.35,
        )
    (arguments.output / "summary.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
