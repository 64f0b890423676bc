"""Cross field round a three-element aerofoil in a box, with strong and with weak boundary conditions (after thesis
figure 3.14).

    python studies/surface_aerofoil.py -o DIR [--size 0.0006] [--lengths 1,0.1,0.03,0.01,0.003] [--drawn 0.01]

Slat, main element and flap are NACA four-digit profiles (analytic, closed trailing edges): the thesis does not give its
geometry. Strong: f = 1 on all boundary edges, so singular points can come near a leading edge, but not onto it. Weak:
the penalty L / (2 eps^2) int |f - 1|^2, L in units of length (the elements together are about 1.1 long); points may sit
on the boundary. DIR gets pictures of the leading edges and summary.md: where the singular points nearest to them are.
Euler characteristic -2: each element has -1, of which its trailing edge takes -1/2 and its nose -1/2; the box has +1.
"""

import argparse
from pathlib import Path

import numpy as np
import octafield
from matplotlib.collections import LineCollection
from matplotlib.path import Path as Polygon
from scipy.spatial import cKDTree
from study_output import markdown_table, new_figure
from surface_meshes import region, resampled
from surface_pictures import SEPARATRIX, STREAMLINE, add_lines, add_points, point_legend, save_drawing

# name: chord, maximum camber, its place, thickness, angle of attack in degrees, leading edge
ELEMENTS = {
    "slat": (0.16, 0.06, 0.4, 0.18, 28, (-0.155, -0.070)),
    "main": (0.75, 0.02, 0.4, 0.13, 0, (0.0, 0.0)),
    "flap": (0.28, 0.04, 0.4, 0.15, -28, (0.735, -0.035)),
}
BOX = np.array([[-1.5, -1.5], [2.5, -1.5], [2.5, 1.5], [-1.5, 1.5]])


def naca(camber: float, place: float, thickness: float, count: int = 400) -> np.ndarray:
    """Closed profile of chord 1 from the trailing edge over the upper side and back; the last coefficient closes the
    trailing edge."""
    x = (1 - np.cos(np.linspace(0, np.pi, count))) / 2
    half = 5 * thickness * (0.2969 * np.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    front = x < place
    line = camber * np.where(
        front, (2 * place * x - x**2) / place**2, (1 - 2 * place + 2 * place * x - x**2) / (1 - place) ** 2
    )
    slope = np.arctan(2 * camber * (place - x) * np.where(front, 1 / place**2, 1 / (1 - place) ** 2))
    upper = np.column_stack([x - half * np.sin(slope), line + half * np.cos(slope)])
    lower = np.column_stack([x + half * np.sin(slope), line - half * np.cos(slope)])
    return np.concatenate([upper[::-1], lower[1:]])


def element(name: str) -> np.ndarray:
    chord, camber, place, thickness, degrees, nose = ELEMENTS[name]
    turn = np.radians(degrees)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    return chord * naca(camber, place, thickness) @ rotation.T + nose


def build(smallest: float) -> octafield.TriangleMesh:
    profiles = [element(name) for name in ELEMENTS]
    walls = cKDTree(np.concatenate(profiles))
    noses = cKDTree([values[-1] for values in ELEMENTS.values()])

    def size(points: np.ndarray) -> np.ndarray:
        return np.minimum(smallest + 0.12 * noses.query(points)[0], 0.007) + 0.09 * walls.query(points)[0]

    sides = [np.linspace(a, b, 200) for a, b in zip(BOX, np.roll(BOX, -1, axis=0))]
    return region([resampled(sides, size), *(resampled([profile], size) for profile in profiles)], size)


def nose_points(name: str, singular, profiles: dict) -> str:
    """Those nearest to this element and within 0.05 of its nose: index, and distance to the wall."""
    found = []
    for point in singular.points:
        place = np.array(point.position)[:2]
        distance = {n: float(np.min(np.linalg.norm(profiles[n] - place, axis=1))) for n in profiles}
        if min(distance, key=distance.get) == name and np.linalg.norm(place - ELEMENTS[name][-1]) < 0.05:
            found.append(f"{4 * point.index:+.0f}/4 " + ("on it" if point.boundary else f"{distance[name]:.4f} off"))
    return ", ".join(sorted(found)) or "none"


def solve(mesh, features, boundary: str, epsilon: float, length: float):
    edges, points = np.array(octafield.surface.edge_topology(mesh).edges), np.array(mesh.vertices)
    lengths = np.linalg.norm(points[edges[:, 1]] - points[edges[:, 0]], axis=1)
    field = octafield.surface.direction_field(
        octafield.surface.SurfaceDomain(mesh, features),
        boundary_alignment=boundary,
        edge_epsilon=np.maximum(epsilon, 2 * lengths),
        alignment_length=length,
    )
    return field, octafield.surface.surface_singularities(field)


def crosses(mesh, field, window, count: int) -> np.ndarray:
    """One per point of a lattice in the window, outside the elements, (n, 2, 2)."""
    centres = np.array(mesh.vertices)[np.array(mesh.triangles)].mean(axis=1)[:, :2]
    spacing = (window[1] - window[0]) / count
    places = np.stack(
        np.meshgrid(*(np.arange(a + spacing / 2, b, spacing) for a, b in (window[:2], window[2:]))), axis=-1
    ).reshape(-1, 2)
    for name in ELEMENTS:
        places = places[~Polygon(element(name)).contains_points(places)]
    first = (
        0.4 * spacing * np.array(octafield.surface.triangle_directions(field))[cKDTree(centres).query(places)[1], :2]
    )
    second = np.column_stack([-first[:, 1], first[:, 0]])
    return np.concatenate([np.stack([places - arm, places + arm], axis=1) for arm in (first, second)])


WINDOWS = {
    "all three": (-0.25, 1.05, -0.33, 0.21),
    "nose of the slat": (-0.195, -0.105, -0.125, -0.035),
    "nose of the main element": (-0.035, 0.055, -0.05, 0.04),
}


def draw(output: Path, mesh, features, drawn, size: float) -> None:
    widths = [w[1] - w[0] for w in WINDOWS.values()]
    heights = [w[3] - w[2] for w in WINDOWS.values()]
    figure, panels = new_figure(
        10.4, 5.4, len(drawn), len(WINDOWS), width_ratios=[w / h for w, h in zip(widths, heights)]
    )
    for row, (label, field, singular) in zip(panels, drawn):
        lines = octafield.surface.separatrices(field, singular, max_length=1.2, singular_radius=size)
        for axes, (name, window) in zip(row, WINDOWS.items()):
            axes.add_collection(
                LineCollection(
                    crosses(mesh, field, window, 44 if name == "all three" else 22), colors=STREAMLINE, linewidths=0.7
                )
            )
            add_lines(axes, lines, SEPARATRIX, 1.2)
            for part in ELEMENTS:
                axes.fill(*element(part).T, color="#d9dfe6", zorder=3)
                axes.plot(*element(part).T, color="black", linewidth=0.8, zorder=3)
            add_points(axes, singular, 5 if name == "all three" else 7)
            axes.set(aspect="equal", xlim=window[:2], ylim=window[2:], xticks=(), yticks=())
            axes.spines[:].set_visible(True)
            axes.set_title(name, fontsize=9)
        row[0].set_ylabel(label)
    point_legend(figure, "4 (trailing edges -2/4)", signs=(-1,))
    save_drawing(figure, output / "surface_aerofoil.png")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument(
        "--size", type=float, default=0.0006, help="edges at the leading edges; chord of the whole about 1.1"
    )
    parser.add_argument("--lengths", default="1,0.1,0.03,0.01,0.003", help="L of the weak runs")
    parser.add_argument("--drawn", default="0.01", help="the L of the picture")
    parser.add_argument("--epsilon", type=float, default=0.01, help="two edge lengths where those are longer")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    mesh = build(arguments.size)
    features, profiles = octafield.surface.detect_features(mesh), {name: element(name) for name in ELEMENTS}
    epsilon, rows, drawn = arguments.epsilon, [], []
    for length in ("strong", *arguments.lengths.split(",")):
        strong = length == "strong"
        field, singular = solve(mesh, features, "strong" if strong else "weak", epsilon, 0 if strong else float(length))
        label = "strong" if strong else f"weak, L = {length}"
        noses = [nose_points(name, singular, profiles) for name in ELEMENTS]
        rows.append(
            (
                label,
                len(singular.points),
                f"{singular.index_sum:g}",
                singular.euler_characteristic,
                f"{np.degrees(singular.boundary_deviation):.1f}",
                f"{field.energy:.2f}",
                *noses,
            )
        )
        if strong or length == arguments.drawn:
            drawn.append((label, field, singular))
    header = [
        "boundary",
        "singular points",
        "index sum",
        "Euler characteristic",
        "largest angle off the boundary (degrees)",
        "energy",
        *(f"at the nose of the {name}" for name in ELEMENTS),
    ]
    text = (
        f"{len(mesh.triangles):,} triangles, eps {epsilon:g}, edges {arguments.size:g} at the leading edges\n\n"
        + markdown_table(header, rows)
    )
    draw(
        arguments.output,
        mesh,
        features,
        drawn if len(drawn) > 1 else [*drawn, (label, field, singular)],
        arguments.size,
    )
    (arguments.output / "summary.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
