"""Non-orthogonal cross fields on the figures of L. Dermine (master thesis, UCLouvain 2024): trapezoids, a diamond, the
disk, a shuriken and an aerofoil in a square.

    python studies/surface_non_orthogonal.py -o DIR [--edge 0.05] [--cost] [--wedges] [--wedges-cost]

The thesis does not give its geometries: angles, the numbers of corners and of singular points are its own, all else is
chosen here. DIR gets one picture per figure, and summary.md: energy, singular points and angles of every domain and
method. With --cost cost.md alone: CPU seconds by mesh size. With --wedges wedges.md and its pictures alone: quads of
acute corners; with --wedges-cost wedges_cost.md alone.
"""

import argparse
import time
from pathlib import Path

import numpy as np
import octafield
import surface_wedges
from matplotlib.collections import LineCollection
from study_output import markdown_table, new_figure
from surface_aerofoil import naca
from surface_meshes import even_disk, region, resampled
from surface_pictures import SEPARATRIX, STREAMLINE, add_lines, add_points, save_drawing

SURFACE = octafield.surface


# ---- domains


def polygon(corners, edge: float, *holes) -> octafield.TriangleMesh:
    corners = np.array(corners, float)
    size = lambda points: np.full(len(points), edge)
    sides = [np.linspace(a, b, 200) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
    return region([resampled(sides, size), *holes], size)


def right_trapezoid(degrees: float, edge: float) -> octafield.TriangleMesh:
    """Height 1, top 0.8, right angles on the left."""
    return polygon([(0, 0), (0.8 + 1 / np.tan(np.radians(degrees)), 0), (0.8, 1), (0, 1)], edge)


def diamond(degrees: float, edge: float) -> octafield.TriangleMesh:
    half = np.radians(degrees) / 2
    return polygon([(-np.cos(half), 0), (0, -np.sin(half)), (np.cos(half), 0), (0, np.sin(half))], edge)


def shuriken(edge: float, blades: int = 5) -> octafield.TriangleMesh:
    """Blades with three corners each, hollows between them: every corner has one quad."""
    pieces = []
    for blade in range(blades):
        turn = 2 * np.pi * blade / blades
        at = lambda radius, angle, turn=turn: radius * np.array([np.cos(turn + angle), np.sin(turn + angle)])
        first, tip, last = at(0.95, -0.2), at(1.1, 0.0), at(0.95, 0.2)
        following = at(0.95, 2 * np.pi / blades - 0.2)
        middle = at(0.1, np.pi / blades)  # control point of the hollow
        t = np.linspace(0, 1, 200)[:, None]
        pieces += [
            first + t * (tip - first),
            tip + t * (last - tip),
            (1 - t) ** 2 * last + 2 * t * (1 - t) * middle + t**2 * following,
        ]
    size = lambda points: np.full(len(points), edge)
    return region([resampled(pieces, size)], size)


def aerofoil(edge: float) -> octafield.TriangleMesh:
    """NACA 2412 of chord 1 in a square of side 3."""
    profile = naca(0.02, 0.4, 0.12) - [0.5, 0]
    near = lambda points: np.min(np.linalg.norm(points[:, None] - profile[None, ::8], axis=2), axis=1)
    # The polygon of the nose turns by less than 45 degrees at each vertex, or it has corners.
    nose = lambda points: np.linalg.norm(points - [-0.5, 0], axis=1)
    size = lambda points: np.minimum(
        np.minimum(edge / 16 + 0.1 * nose(points), edge / 3) + 0.12 * near(points), 2 * edge
    )
    corners = 1.5 * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    sides = [np.linspace(a, b, 200) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
    return region([resampled(sides, size), resampled([profile], size)], size)


# ---- fields


def solved(mesh, **options):
    field = SURFACE.non_orthogonal_field(mesh, **options)
    return field, SURFACE.surface_singularities(field)


def corners_of_one(mesh, places) -> np.ndarray:
    points = np.array(mesh.vertices)[:, :2]
    nearest = [int(np.argmin(np.linalg.norm(points - place, axis=1))) for place in places]
    return np.column_stack([nearest, np.ones(len(nearest), int)])


def row(name: str, label: str, field, singular) -> tuple:
    inside = [point.index_times_symmetry for point in singular.points if not point.boundary]
    corners = [point.index_times_symmetry for point in singular.points if point.boundary]
    told = lambda found: ", ".join(f"{found.count(t)} of t = {t:+d}" for t in sorted(set(found))) or "none"
    return (
        name,
        label,
        len(field.angles),
        f"{field.start_energy:.4g}",
        f"{field.energy:.4g}",
        told(inside),
        told(corners),
        "yes" if singular.agree else "no",
        f"{np.degrees(field.smallest_angle):.1f}",
        f"{field.freedom:g}",
    )


HEADER = (
    "domain", "method, second line", "vertices", "energy of the start", "energy", "points inside", "corners",
    "sum is chi", "smallest angle (degrees)", "freedom",
)  # fmt: skip


def local_length(domain) -> np.ndarray:
    """(V, 1): the mean length of the edges at each vertex."""
    edges, length = np.array(domain.edges), np.array(domain.edge_lengths)
    count = np.bincount(edges.ravel(), minlength=len(domain.vertices))
    total = sum(np.bincount(edges[:, k], length, len(domain.vertices)) for k in range(2))
    return (total / np.maximum(count, 1))[:, None]


def draw(axes, field, singular, title: str) -> None:
    """Both lines at vertices, separatrices, singular points."""
    points = np.array(field.domain.vertices)[:, :2]
    arm, near = 0.32 * local_length(field.domain), 0.5 * np.array(field.domain.edge_lengths).min()
    lines = [
        np.stack([points - arm * d, points + arm * d], axis=1)
        for d in (np.array(v)[:, :2] for v in (field.first, field.second))
    ]
    axes.add_collection(LineCollection(np.concatenate(lines), colors=STREAMLINE, linewidths=0.7))
    add_lines(axes, SURFACE.separatrices(field, singular, singular_radius=near), SEPARATRIX, 1.2)
    edges = np.array(field.domain.edges)[np.array(field.domain.edge_triangles).min(axis=1) < 0]
    axes.add_collection(LineCollection(points[edges], colors="black", linewidths=0.9))
    add_points(axes, singular, 5, keep=lambda point: not point.boundary)
    axes.set(aspect="equal", xticks=(), yticks=())
    axes.autoscale_view()
    axes.spines[:].set_visible(False)
    axes.set_title(title, fontsize=9)


def trapezoids(output: Path, edge: float) -> list[tuple]:
    rows, angles = [], (50, 46, 44, 40, 30, 20)
    figure, panels = new_figure(10.4, 4.4, 2, 3)
    for axes, degrees in zip(panels.ravel(), angles, strict=True):
        mesh = right_trapezoid(degrees, edge)
        for method in SURFACE.non_orthogonal_field_methods:
            field, singular = solved(mesh, method=method)
            rows.append(row(f"right trapezoid, {degrees} degrees", f"{method}, fixed", field, singular))
            if method == "angles":
                draw(axes, field, singular, f"{degrees} degrees")
        rows.append(row(f"right trapezoid, {degrees} degrees", "angles, free", *solved(mesh, second_line="free")))
    save_drawing(figure, output / "non_orthogonal_trapezoids.png")
    return rows


def diamonds(output: Path, edge: float) -> list[tuple]:
    figure, panels = new_figure(10.4, 2.6, 1, 3)
    rows, half = [], np.radians(28.65) / 2
    sharp, wide = diamond(28.65, edge), diamond(60, edge)
    tips = [(-np.cos(half), 0), (0, -np.sin(half)), (np.cos(half), 0), (0, np.sin(half))]
    for axes, mesh, name, options in (
        (panels[0], wide, "60 degrees", {}),
        (panels[1], sharp, "28.65 degrees, quads by angle", {}),
        (panels[2], sharp, "28.65 degrees, one quad at every corner", {"corners": corners_of_one(sharp, tips)}),
    ):
        field, singular = solved(mesh, **options)
        rows.append(row(f"diamond, {name}", "angles, fixed", field, singular))
        draw(axes, field, singular, name)
    save_drawing(figure, output / "non_orthogonal_diamond.png")
    return rows


def disks(output: Path, edge: float) -> list[tuple]:
    figure, panels = new_figure(7.2, 3.6, 1, 2)
    rows, mesh = [], even_disk(1.5 * edge)
    for axes, second in zip(panels, ("fixed", "free"), strict=True):
        field, singular = solved(mesh, second_line=second)
        rows.append(row("disk", f"angles, {second}", field, singular))
        radii = [np.linalg.norm(point.position) for point in singular.points]
        draw(axes, field, singular, f"{second}: radii {min(radii):.3f} to {max(radii):.3f}")
    save_drawing(figure, output / "non_orthogonal_disk.png")
    return rows


def stars(output: Path, edge: float) -> list[tuple]:
    figure, axes = new_figure(5.0, 5.0)
    field, singular = solved(shuriken(edge))
    draw(axes, field, singular, "")
    save_drawing(figure, output / "non_orthogonal_shuriken.png")
    return [row("shuriken", "angles, fixed", field, singular)]


def aerofoils(output: Path, edge: float) -> list[tuple]:
    figure, panels = new_figure(9.0, 4.5, 1, 2)
    field, singular = solved(aerofoil(edge))
    for axes, middle, half in ((panels[0], (0, 0), 0.8), (panels[1], (-0.47, 0), 0.05)):
        draw(axes, field, singular, "")
        axes.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half))
    save_drawing(figure, output / "non_orthogonal_aerofoil.png")
    return [row("NACA 2412 in a square", "angles, fixed", field, singular)]


def cost(edges) -> str:
    """A row per edge length of the trapezoid of 30 degrees, with the exponent of the CPU time in the vertices."""
    rows, before = [], {}
    for edge in edges:
        mesh = right_trapezoid(30, edge)
        line = [f"{edge:g}", f"{len(mesh.vertices):,}"]
        for method in ("angles", "poly_vector"):
            began = time.process_time()
            SURFACE.non_orthogonal_field(mesh, method=method)
            took = time.process_time() - began
            size, seconds = before.get(method, (len(mesh.vertices), took))
            exponent = np.log(took / seconds) / np.log(len(mesh.vertices) / size) if method in before else None
            line += [f"{took:.2f}", "" if exponent is None else f"{exponent:.2f}"]
            before[method] = len(mesh.vertices), took
        rows.append(line)
    return markdown_table(("edge", "vertices", "angles, CPU s", "exponent", "poly_vector, CPU s", "exponent"), rows)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--edge", type=float, default=0.05, help="edge length; trapezoids have height 1")
    parser.add_argument("--cost", nargs="?", const="0.02,0.01,0.005", help="edges; seconds in place of the figures")
    parser.add_argument("--wedges", nargs="?", const="15,30,45,60,75", help="angles; quads of wedges in their place")
    parser.add_argument("--wedges-cost", nargs="?", const="0.01,0.005,0.0025", help="edges; seconds of quads of wedges")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    output, edge = arguments.output, arguments.edge
    if arguments.cost:
        text = cost(map(float, arguments.cost.split(",")))
        (output / "cost.md").write_text(text)
        print(text)
        return
    if arguments.wedges_cost:
        text = surface_wedges.cost(map(float, arguments.wedges_cost.split(",")))
        (output / "wedges_cost.md").write_text(text)
        print(text)
        return
    if arguments.wedges:
        print(surface_wedges.wedges(output, [int(degrees) for degrees in arguments.wedges.split(",")]))
        return
    rows = [*trapezoids(output, edge), *diamonds(output, 0.9 * edge), *disks(output, edge)]
    rows += [*stars(output, edge), *aerofoils(output, edge)]
    text = markdown_table(HEADER, rows)
    (output / "summary.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
