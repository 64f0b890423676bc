"""Cross field round a three-element aerofoil in a box, with strong and with weak boundary conditions (after thesis figure 3.14).

    python studies/surface_aerofoil.py -o DIR [--size 0.001] [--lengths 1,0.3,0.1]

Slat, main element and flap are NACA four-digit profiles (analytic, closed trailing edges): the thesis does not give its geometry. Strong: f = 1 on all boundary edges, so
singular points can come near a leading edge, but not onto it. Weak: the penalty L / (2 eps^2) int |f - 1|^2, L in units of eps; points may sit on
the boundary. The box and the trailing edges' sectors are the same in all runs. DIR gets pictures of the leading edges and summary.md: where the singular
points nearest to them are. Euler characteristic -2.
"""

import argparse
from pathlib import Path

import numpy as np
from matplotlib.collections import LineCollection
from scipy.spatial import cKDTree
from study_output import markdown_table, new_figure
from surface_meshes import region, resampled
from surface_pictures import save_drawing

import octafield
from octafield.plots import PALETTE

# name: chord, maximum camber, its place, thickness, angle of attack in degrees, leading edge
ELEMENTS = {"slat": (0.16, 0.06, 0.4, 0.18, 28, (-0.155, -0.070)), "main": (0.75, 0.02, 0.4, 0.13, 0, (0.0, 0.0)), "flap": (0.28, 0.04, 0.4, 0.15, -28, (0.735, -0.035))}
BOX = np.array([[-1.5, -1.5], [2.5, -1.5], [2.5, 1.5], [-1.5, 1.5]])


def naca(camber: float, place: float, thickness: float, count: int = 400) -> np.ndarray:
    """Closed profile of chord 1 from the trailing edge over the upper side and back; the last coefficient closes the trailing edge."""
    x = (1 - np.cos(np.linspace(0, np.pi, count))) / 2
    half = 5 * thickness * (0.2969 * np.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    front = x < place
    line = camber * np.where(front, (2 * place * x - x**2) / place**2, (1 - 2 * place + 2 * place * x - x**2) / (1 - place) ** 2)
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
        return np.minimum(smallest + 0.12 * noses.query(points)[0], 0.01) + 0.12 * walls.query(points)[0]

    sides = [np.linspace(a, b, 200) for a, b in zip(BOX, np.roll(BOX, -1, axis=0))]
    return region([resampled(sides, size), *(resampled([profile], size) for profile in profiles)], size)


def boundary_distance(point: np.ndarray, profiles: dict) -> tuple[str, float, float]:
    """Nearest element, distance to it, and to its nose."""
    name = min(profiles, key=lambda n: np.min(np.linalg.norm(profiles[n] - point, axis=1)))
    return name, float(np.min(np.linalg.norm(profiles[name] - point, axis=1))), float(np.linalg.norm(point - ELEMENTS[name][-1]))


def solve(mesh, features, boundary: str, epsilon: float, length: float):
    edges, points = np.array(octafield.edge_topology(mesh).edges), np.array(mesh.vertices)
    lengths = np.linalg.norm(points[edges[:, 1]] - points[edges[:, 0]], axis=1)
    field = octafield.direction_field(mesh, features, boundary=boundary, edge_epsilon=np.maximum(epsilon, 2 * lengths), alignment_length=length)
    return field, octafield.surface_singularities(mesh, field)


def crosses(mesh, field, window, count: int = 34) -> np.ndarray:
    """One per point of a lattice in the window, (n, 2, 2)."""
    centres = np.array(mesh.vertices)[np.array(mesh.triangles)].mean(axis=1)[:, :2]
    spacing = (window[1] - window[0]) / count
    x, y = np.meshgrid(np.arange(window[0], window[1], spacing), np.arange(window[2], window[3], spacing))
    triangles = np.unique(cKDTree(centres).query(np.column_stack([x.ravel(), y.ravel()]), distance_upper_bound=spacing)[1])
    triangles = triangles[triangles < len(centres)]
    first = 0.4 * spacing * np.array(octafield.triangle_directions(mesh, field))[triangles, :2]
    second = np.column_stack([-first[:, 1], first[:, 0]])
    return np.concatenate([np.stack([centres[triangles] - arm, centres[triangles] + arm], axis=1) for arm in (first, second)])


def draw(axes, mesh, features, field, singular, window) -> None:
    axes.add_collection(LineCollection(crosses(mesh, field, window), colors=PALETTE[6], linewidths=0.6))
    lines = octafield.separatrices(mesh, features, field, singular, max_length=1.5 * (window[1] - window[0]))
    axes.add_collection(LineCollection([line.points[:, :2] for line in lines], colors=PALETTE[0], linewidths=1.0))
    for name in ELEMENTS:
        axes.fill(*element(name).T, color="#d9dfe6", edgecolor="black", linewidth=0.8)
    for point in singular.points:
        if abs(np.array(point.position)[0] - 0.5) < 1.9:  # not the corners of the box
            axes.plot(*np.array(point.position)[:2], "s" if point.boundary else "o", color=PALETTE[1] if point.index > 0 else PALETTE[4], markersize=6,
                      markeredgecolor="black", markeredgewidth=0.6, zorder=5)
    axes.set(aspect="equal", xlim=window[:2], ylim=window[2:], xticks=(), yticks=())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--size", type=float, default=0.001, help="edges at the leading edges; chord of the whole about 1.1")
    parser.add_argument("--lengths", default="1,0.3,0.1", help="L / eps of the weak runs")
    parser.add_argument("--epsilon", type=float, default=0.01, help="two edge lengths where those are longer")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    mesh = build(arguments.size)
    features, profiles = octafield.detect_features(mesh), {name: element(name) for name in ELEMENTS}
    epsilon, rows, drawn = arguments.epsilon, [], []
    for ratio in ("strong", *arguments.lengths.split(",")):
        strong = ratio == "strong"
        field, singular = solve(mesh, features, "strong" if strong else "weak", epsilon, 0 if strong else float(ratio) * epsilon)
        label = "strong" if strong else f"weak, L = {ratio} eps"
        near = []
        for point in singular.points:
            name, wall, nose = boundary_distance(np.array(point.position)[:2], profiles)
            if nose < 0.1:
                near.append(f"{name}: {4 * point.index:+.0f}/4 " + ("on it" if point.boundary else f"{wall:.4f} off") + f", {nose:.3f} from the nose")
        rows.append((label, len(singular.points), f"{singular.index_sum:g}", singular.euler_characteristic, f"{np.degrees(singular.boundary_deviation):.1f}",
                     f"{field.energy:.2f}", "; ".join(near) or "none"))
        drawn.append((label, field, singular))
    header = ["boundary", "singular points", "index sum", "Euler characteristic", "largest angle off the boundary (degrees)", "energy", "near leading edges"]
    text = f"{len(mesh.triangles):,} triangles, eps {epsilon:g}, edges {arguments.size:g} at the leading edges\n\n" + markdown_table(header, rows)
    windows = {"all three": (-0.3, 1.1, -0.35, 0.3), "slat": (-0.2, 0.06, -0.12, 0.08)}
    figure, panels = new_figure(9.0, 5.6, 2, 2)
    for row, chosen in zip(panels, (drawn[0], drawn[min(len(drawn) - 1, 1)])):
        for axes, (name, window) in zip(row, windows.items()):
            draw(axes, mesh, features, *chosen[1:], window)
            axes.set_title(f"{chosen[0]}: {name}", fontsize=9)
    save_drawing(figure, arguments.output / "surface_aerofoil.png")
    (arguments.output / "summary.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
