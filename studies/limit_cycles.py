"""Fields with limit cycles: whether quads come of them, and how.

    python -m studies.limit_cycles -o DIR

Each field is made with `rotate`, so that sizes disagree by a factor after one turn; its directions are given to
compute_quad_mesh, and its points to compute_quad_layout (t-mesh, rotate), which changes none of them. DIR gets
summary.md.
"""

import argparse
from collections.abc import Callable
from pathlib import Path

import numpy as np
import octafield
from octafield.domain.generators import generate

from .benchmarks.pages import when
from .hex_dominant.rows import markdown_table

SURFACE = octafield.surface
KEPT = octafield.SurfaceFieldOptions(remesh=False)
QUADS = 1000
HEADER = ("field", "sizes after a turn", "points kept (quad-layout)", "quads (quad-mesh)", "valence 3, 5", "changed",
          "SJ min", "from the field, median", "p90", "CPU s")  # fmt: skip


def ring(n: int = 64, rings: int = 20) -> octafield.TriangleMesh:
    """Between the circles of radius 1 and 4."""
    angles, radii = 2 * np.pi * np.arange(n) / n, 4.0 ** (np.arange(rings + 1) / rings)
    points = radii[:, None, None] * np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    inner = [(r * n + i, r * n + (i + 1) % n) for r in range(rings) for i in range(n)]
    triangles = [t for a, b in inner for t in ([a, a + n, b + n], [a, b + n, b])]
    return octafield.TriangleMesh(points.reshape(-1, 3), triangles)


def pair_in_ring(three: tuple[float, float], five: tuple[float, float]):
    """(radius, angle) of both."""
    at = lambda place: [place[0] * np.cos(place[1]), place[0] * np.sin(place[1]), 0.0]
    return ring(), [(at(three), 1), (at(five), -1)]


def pair_on_torus(three: float, five: float):
    """Angles round the tube; half a turn apart the long way."""
    torus = generate("torus")
    points = np.asarray(torus.vertices)
    radii = np.hypot(points[:, 0], points[:, 1])
    middle, tube = (radii.min() + radii.max()) / 2, np.ptp(radii) / 2
    places = [
        [side * (middle + tube * np.cos(angle)), 0.0, tube * np.sin(angle)] for side, angle in ((1, three), (-1, five))
    ]
    return torus, list(zip(places, (1, -1), strict=True))


def twisted_ring(quarters: int):
    """No points: along the inner circle, and turned by quarters of a turn on the way to the outer one."""
    plate = ring()
    points = np.asarray(plate.vertices)
    radii = np.hypot(points[:, 0], points[:, 1])
    angle = np.arctan2(points[:, 1], points[:, 0]) + quarters * np.pi / 2 * (radii - 1) / 3
    return plate, np.column_stack([-np.sin(angle), np.cos(angle), 0 * angle])


FIELDS: dict[str, Callable] = {
    "torus, pair 3 and 5 half a turn apart, at 0 and 90 degrees of the tube": lambda: pair_on_torus(0, np.pi / 2),
    "torus, at 0 and 150 degrees": lambda: pair_on_torus(0, 5 * np.pi / 6),
    "torus, at 60 and 240 degrees": lambda: pair_on_torus(np.pi / 3, 4 * np.pi / 3),
    "nautilus: ring, 3 and 5 at radius 2, opposite": lambda: pair_in_ring((2, 0), (2, 3.1)),
    "nautilus: 3 at radius 1.5, 5 at 3, a sixth of a turn apart": lambda: pair_in_ring((1.5, 0), (3, 1)),
    "nautilus: 3 at radius 3, 5 at 1.5": lambda: pair_in_ring((3, 0), (1.5, 2)),
    "ring twisted by a quarter turn": lambda: twisted_ring(1),
    "ring twisted by half a turn": lambda: twisted_ring(2),
}


def made_with(surface: octafield.TriangleMesh, points: list) -> tuple:
    """The surface of the field, its directions, and how far sizes disagree."""
    domain = SURFACE.SurfaceDomain(surface)
    pattern = SURFACE.SingularPattern([SURFACE.imposed_point(domain, place, index) for place, index in points])
    field = SURFACE.impose_singular_points(domain, pattern, inadmissible="rotate")
    factors = ", ".join(f"{condition.size_factor:.2f}" for condition in field.conditions)
    return field.field.domain.mesh, np.array(SURFACE.triangle_directions(field.field)), factors


def with_points_kept(surface: octafield.TriangleMesh, points: list) -> str:
    given = [{"position": list(place), "index_times_four": index} for place, index in points]
    options = octafield.QuadLayoutOptions(quads=QUADS, inadmissible="rotate", blocks="fine", measure="lengths")
    try:
        result = octafield.compute_quad_layout(surface, KEPT, layout_options=options, singularities=given)
    except octafield.Error as error:
        return error.kind
    return f"{result.record.quads:,} quads"


def row(name: str) -> tuple:
    surface, given = FIELDS[name]()
    kept, factors, directions = "", "", given
    if isinstance(given, list):
        kept = with_points_kept(surface, given)
        surface, directions, factors = made_with(surface, given)
    options = octafield.QuadMeshOptions(quads=QUADS)
    try:
        record = octafield.compute_quad_mesh(surface, KEPT, quad_options=options, field=directions).record
    except octafield.Error as error:
        return name, factors, kept, error.kind, *[""] * 6
    irregular = record.irregular_vertices
    changed = [note.split(", ")[1] for note in record.notes if note.startswith("singular points of the computed field")]
    return (
        name, factors, kept, f"{record.quads:,}", f"{irregular.get('3', 0)}, {irregular.get('5', 0)}",
        "; ".join(changed), f"{record.scaled_jacobian.min:.2f}", f"{record.field_angle.median:.1f}",
        f"{record.field_angle.p90:.1f}", f"{sum(record.cpu_seconds.values()):.1f}",
    )  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    rows = []
    for name in FIELDS:
        rows.append(row(name))
        print(*rows[-1], sep=" | ", flush=True)
    (given.output / "summary.md").write_text(when() + "\n\n" + markdown_table(HEADER, rows))


if __name__ == "__main__":
    main()
