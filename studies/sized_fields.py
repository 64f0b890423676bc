"""Sizes wanted and reached by cross fields: the radial tests and the doubling strip of L. Simons (UC Davis 2024).

    python -m studies.sized_fields -o DIR [--edge 0.04] [--spacing 0.05] [--only linear,x10,...]

Simons does not give the radii of his radial tests: here a disk of radius 1.4, sizes largest within radius 0.25 and
smallest from radius 1.15 on, between them by three easings. DIR gets summary.md (a row per easing, growth and way to a
field; then the strip in two phases) and sized_fields.png.
"""

import argparse
import os
import sys
from pathlib import Path

import numpy as np
import octafield
from matplotlib.collections import LineCollection

sys.path[:0] = [str(Path(__file__).parent)]
from benchmarks.pages import commit, machine  # noqa: E402
from study_output import markdown_table, new_figure  # noqa: E402
from surface_meshes import region, resampled  # noqa: E402
from surface_pictures import STREAMLINE, add_points, save_drawing  # noqa: E402

SURFACE = octafield.surface
INNER, OUTER, RADIUS = 0.25, 1.15, 1.4
EASINGS = {
    "exponential": lambda t, growth: growth**t,
    "linear": lambda t, growth: 1 + (growth - 1) * t,
    "cubic": lambda t, growth: 1 + (growth - 1) * t * t * (3 - 2 * t),
}
HEADER = (
    "easing", "wanted", "way", "reached", "size ratio p10", "p90", "least", "largest", "points of valence 3, 5",
    "misfit", "least length of u", "unresolved triangles", "anisotropy worst", "mean", "size by lines, least",
    "largest",
)  # fmt: skip


def disk(edge: float) -> octafield.TriangleMesh:
    angle = np.linspace(0, 2 * np.pi, 20_001)
    circle = RADIUS * np.column_stack([np.cos(angle), np.sin(angle)])
    size = lambda points: np.full(len(points), edge)
    return region([resampled([circle], size)], size)


def radial(easing: str, growth: float):
    """Sizes of points, 1 outside."""

    def sizes(points):
        t = np.clip((OUTER - np.hypot(points[:, 0], points[:, 1])) / (OUTER - INNER), 0, 1)
        return EASINGS[easing](t, growth)

    return sizes


# ---- fields and what they reach


def globally_optimal(mesh, sizes):
    made = SURFACE.sized_field(mesh, sizes, boundary_alignment="none")
    return made.field, f"{made.least_length:.2g}", str(len(made.unresolved))


def by_metric(mesh, sizes):
    domain = SURFACE.sized_domain(mesh, sizes(np.array(mesh.vertices)))
    field = SURFACE.direction_field(domain, method="mbo", boundary_alignment="none")
    return SURFACE.restricted_field(field, mesh), "", ""


WAYS = {"globally optimal": globally_optimal, "diffusion in the metric": by_metric}


def measured(mesh, sizes, field, spacing: float) -> tuple:
    """Growth from the outer to the inner circle, ratios, points, anisotropy."""
    points = np.array(mesh.vertices)
    wanted, radius = sizes(points), np.hypot(points[:, 0], points[:, 1])
    reached = SURFACE.reached_sizes(field)
    ratios = np.array(SURFACE.size_ratios(mesh, reached, wanted))
    inside = radius <= OUTER
    grown = np.exp(reached.log_sizes[radius <= INNER].mean() - reached.log_sizes[abs(radius - OUTER) < 0.05].mean())
    singular = SURFACE.surface_singularities(field)
    indices = [point.index_times_symmetry for point in singular.points if not point.boundary]
    near = 0.5 * np.array(SURFACE.SurfaceDomain(mesh).edge_lengths).mean()
    families = SURFACE.size_families(field, singular, spacing=spacing, singular_radius=near)
    by_lines = np.exp(families.log_widths.mean(axis=1)) / sizes(np.array(families.positions))
    if len(by_lines) == 0:
        raise RuntimeError("every line comes too near to a singular point: choose a smaller --edge")
    by_lines /= np.exp(np.log(by_lines).mean())
    low, high = np.quantile(ratios[inside], (0.1, 0.9))
    told = (
        f"{grown:.1f}", f"{low:.2f}", f"{high:.2f}", f"{ratios[inside].min():.2f}", f"{ratios[inside].max():.2f}",
        f"{indices.count(1)}, {indices.count(-1)}", f"{reached.misfit:.2f}",
    )  # fmt: skip
    lines = (
        f"{families.worst_anisotropy:.2f}",
        f"{families.mean_anisotropy:.2f}",
        f"{by_lines.min():.2f}",
        f"{by_lines.max():.2f}",
    )
    return told, lines, singular


def draw(axes, mesh, field, singular, title: str) -> None:
    lines = SURFACE.even_streamlines(field, singular, spacing=0.06)
    curves = [np.array(line.points)[:, :2] for line in lines]
    axes.add_collection(LineCollection(curves, colors=STREAMLINE, linewidths=0.6))
    angle = np.linspace(0, 2 * np.pi, 200)
    for radius in (INNER, OUTER):
        axes.plot(radius * np.cos(angle), radius * np.sin(angle), color="black", linewidth=0.6, linestyle=":")
    add_points(axes, singular, 4, keep=lambda point: not point.boundary)
    axes.set(aspect="equal", xticks=(), yticks=(), xlim=(-RADIUS, RADIUS), ylim=(-RADIUS, RADIUS))
    axes.spines[:].set_visible(False)
    axes.set_title(title, fontsize=9)


def radial_rows(output: Path, edge: float, spacing: float, chosen) -> list[tuple]:
    mesh, rows = disk(edge), []
    figure, panels = new_figure(9.6, 6.6, 2, 3)
    for row, growth in enumerate((10, 50)):
        for column, easing in enumerate(EASINGS):
            if chosen and not {easing, f"x{growth}"} <= chosen:
                continue
            sizes = radial(easing, growth)
            for way, make in WAYS.items():
                field, least, unresolved = make(mesh, sizes)
                told, lines, singular = measured(mesh, sizes, field, spacing)
                rows.append((easing, f"{growth}", way, *told, least, unresolved, *lines))
                if way == "diffusion in the metric":
                    draw(panels[row, column], mesh, field, singular, f"{easing}, x{growth}: reached x{told[0]}")
    save_drawing(figure, output / "sized_fields.png", colours=12)
    return rows


# ---- the doubling strip


def strip_rows() -> list[tuple]:
    """sigma = 1 + x on the unit square: by what the widths of both families grow from left to right, by phase."""
    n = 32
    y, x = np.divmod(np.arange((n + 1) ** 2), n + 1)
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    quads = np.column_stack([a, a + 1, a + n + 2, a + n + 1])
    mesh = SURFACE.split_quads(SURFACE.QuadMesh(np.column_stack([x / n, y / n, 0 * x]), quads=quads))
    made = SURFACE.sized_field(mesh, lambda points: 1 + points[:, 0], boundary_alignment="none")
    rows = []
    middle = np.array(made.directions)[np.argmin(np.linalg.norm(np.array(mesh.vertices)[:, :2] - 0.5, axis=1))]
    for name, phase in (("along the growth", 0.0), ("turned by 45 degrees", np.pi / 4)):
        field = SURFACE.rotated_field(made.field, phase - np.arctan2(middle[1], middle[0]))
        families = SURFACE.size_families(field, SURFACE.surface_singularities(field), spacing=0.05)
        x, width = np.array(families.positions)[:, 0], np.array(families.log_widths)
        ends = [np.array(line.points)[[0, -1], :2] for line in families.lines]
        angle = np.array([np.arctan2(*(end - start)[::-1]) for start, end in ends]) - phase
        first = abs(np.cos(angle)) > np.sqrt(0.5)
        family = first[np.array(families.crossing_lines)]
        grown = [np.exp(np.polyfit(np.tile(x, (2, 1)).T[family == k], width[family == k], 1)[0]) for k in (True, False)]
        rows.append((name, f"{grown[0]:.2f}", f"{grown[1]:.2f}", f"{families.worst_anisotropy:.2f}"))
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--edge", type=float, default=0.04, help="of the triangles; the disk has radius 1.4")
    parser.add_argument("--spacing", type=float, default=0.05, help="of the lines whose anisotropy is measured")
    parser.add_argument("--only", default="", help="an easing and a growth, linear,x10, in place of all")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    chosen = {word for word in arguments.only.split(",") if word}
    rows = radial_rows(arguments.output, arguments.edge, arguments.spacing, chosen)
    text = (
        f"octafield {octafield.__version__}, commit {commit()}, {machine()}, load average {os.getloadavg()[0]:.1f}\n\n"
    )
    text += markdown_table(HEADER, rows) + "\n"
    strip = ("phase", "width of lines along x", "width of lines across", "anisotropy worst")
    text += markdown_table(strip, strip_rows())
    (arguments.output / "summary.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
