"""Quads by the directions of a given field, beside those by its singular points alone.

    python -m studies.followed_fields -o DIR

Angles are those of all edges of quads at their middles, from the nearest of the four directions. DIR gets summary.md
and followed_field.png (the wavy square in 400 quads both ways).
"""

import argparse
from collections.abc import Callable
from pathlib import Path

import numpy as np
import octafield
from matplotlib.collections import LineCollection
from octafield.domain.generators import generate

from .benchmarks.pages import when
from .hex_dominant.rows import markdown_table
from .limit_cycles import ring
from .study_output import new_figure
from .surface_pictures import save_drawing

SURFACE = octafield.surface
KEPT = octafield.SurfaceFieldOptions(remesh=False)
HEADER = ("field", "quads", "valence 3, 5", "by points: median", "p90", "SJ min", "size p10, p90",
          "by directions: median", "p90", "SJ min", "size p10, p90", "CPU s")  # fmt: skip
WAVE = 0.1


def squares(n: int = 24) -> octafield.TriangleMesh:
    y, x = np.divmod(np.arange((n + 1) ** 2), n + 1)
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    quads = np.column_stack([a, a + 1, a + n + 2, a + n + 1])
    return SURFACE.split_quads(SURFACE.QuadMesh(np.column_stack([x / n, y / n, 0 * x]), quads=quads))


def wavy_square():
    """Along lines of one value of y + 0.1 cos(2 pi x) sin(pi y): up to 32 degrees from the sides."""
    plate = squares()
    x, y, z = np.array(plate.vertices).T
    by_x = -2 * np.pi * WAVE * np.sin(2 * np.pi * x) * np.sin(np.pi * y)
    by_y = 1 + np.pi * WAVE * np.cos(2 * np.pi * x) * np.cos(np.pi * y)
    return plate, np.column_stack([by_y, -by_x, z])


def bent_disk():
    """Of four points of valence 3 off the middle, bent inside by up to 25 degrees."""
    a = np.linspace(0, 2 * np.pi, 97)[:-1]
    outline = octafield.planar_outline([np.column_stack([np.cos(a), np.sin(a)])])
    plate = octafield.prepare_mesh(
        SURFACE.outline_triangles(outline), octafield.SurfaceFieldOptions(edge_length=0.06), volume=False
    ).surface
    places = [(0.5, 0.01), (0, 0.4), (-0.5, 0), (0.02, -0.45)]
    pattern = SURFACE.SingularPattern([SURFACE.imposed_point(plate, [x, y, 0], 1) for x, y in places])
    made = SURFACE.impose_singular_points(plate, pattern, inadmissible="rotate")
    fine = made.field.domain.mesh
    middles = np.asarray(fine.vertices)[np.asarray(fine.triangles)].mean(axis=1)
    bend = np.radians(25) * (1 - (middles**2).sum(axis=1)) * np.sin(4 * middles[:, 0])
    x, y, z = np.array(SURFACE.triangle_directions(made.field)).T
    return fine, np.column_stack([np.cos(bend) * x - np.sin(bend) * y, np.sin(bend) * x + np.cos(bend) * y, z])


def turned_torus(degrees: float):
    """By that from the circles the long way."""
    torus = generate("torus")
    points = np.asarray(torus.vertices)
    around, radii = np.arctan2(points[:, 1], points[:, 0]), np.hypot(points[:, 0], points[:, 1])
    outward, along = (np.column_stack([f(around), g(around), 0 * around]) for f, g in
                      ((np.cos, np.sin), (lambda a: -np.sin(a), np.cos)))  # fmt: skip
    normal = (radii - (radii.min() + radii.max()) / 2)[:, None] * outward + points * [0, 0, 1]
    other = np.cross(normal / np.linalg.norm(normal, axis=1)[:, None], along)
    return torus, np.cos(np.radians(degrees)) * along + np.sin(np.radians(degrees)) * other


def spiral(degrees: float):
    """Between circles, by that from them."""
    plate = ring()
    points = np.asarray(plate.vertices)
    angle = np.arctan2(points[:, 1], points[:, 0]) + np.radians(degrees)
    return plate, np.column_stack([-np.sin(angle), np.cos(angle), 0 * angle])


CASES: dict[str, tuple[Callable, tuple[int, ...]]] = {
    "wavy square": (wavy_square, (100, 400, 1600)),
    "bent disk": (bent_disk, (400, 1600)),
    **{f"torus, {d} degrees": (lambda d=d: turned_torus(d), (1500,)) for d in (0, 20, 45)},
    **{f"ring, {d} degrees": (lambda d=d: spiral(d), (900,)) for d in (0, 10, 20, 40)},
}


def row(name: str, quads: int) -> tuple:
    surface, field = CASES[name][0]()
    told: list[str] = []
    for follow in ("points", "directions"):
        options = octafield.QuadMeshOptions(quads=quads, follow=follow)
        record = octafield.compute_quad_mesh(surface, KEPT, quad_options=options, field=field).record
        told += [
            f"{record.field_angle.median:.1f}", f"{record.field_angle.p90:.1f}", f"{record.scaled_jacobian.min:.2f}",
            f"{record.size_ratio.p10:.2f}, {record.size_ratio.p90:.2f}",
        ]  # fmt: skip
    irregular = record.irregular_vertices
    counts = f"{irregular.get('3', 0)}, {irregular.get('5', 0)}"
    return name, f"{record.quads:,}", counts, *told, f"{sum(record.cpu_seconds.values()):.1f}"


def draw(path: Path) -> None:
    surface, field = wavy_square()
    points = np.asarray(surface.vertices)
    figure, panels = new_figure(7.0, 3.7, 1, 2)
    for panel, follow in zip(np.ravel(panels), ("points", "directions"), strict=True):
        options = octafield.QuadMeshOptions(quads=400, follow=follow)
        mesh = octafield.compute_quad_mesh(surface, KEPT, quad_options=options, field=field).mesh
        loops = np.asarray(mesh.vertices)[np.asarray(mesh.quads)[:, [0, 1, 2, 3, 0]], :2]
        panel.add_collection(LineCollection(loops, colors="black", linewidths=0.5))
        half = 0.016 * field / np.linalg.norm(field, axis=1)[:, None]
        every = np.flatnonzero((np.arange(len(points)) % 25 % 2 == 1) & (np.arange(len(points)) // 25 % 2 == 1))
        dashes = np.stack([points - half, points + half], axis=1)[every, :, :2]
        panel.add_collection(LineCollection(dashes, colors="#d55e00", linewidths=1.4))
        panel.set(aspect="equal", xticks=(), yticks=(), xlim=(-0.02, 1.02), ylim=(-0.02, 1.02))
        panel.spines[:].set_visible(False)
        panel.set_title(f"by its {follow}", fontsize=9)
    save_drawing(figure, path, colours=12)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    rows = []
    for name, (_, counts) in CASES.items():
        for quads in counts:
            rows.append(row(name, quads))
            print(*rows[-1], sep=" | ", flush=True)
    draw(given.output / "followed_field.png")
    (given.output / "summary.md").write_text(when() + "\n\n" + markdown_table(HEADER, rows))


if __name__ == "__main__":
    main()
