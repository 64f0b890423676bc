"""Quads of wedges, along two lines at any angle and at right angles: plane families, and prisms over them.

Run by surface_non_orthogonal.py --wedges.
"""

import time
from pathlib import Path

import numpy as np
import octafield
from matplotlib.collections import PolyCollection
from study_output import markdown_table, new_figure
from surface_meshes import region, resampled
from surface_pictures import SIGNS, save_drawing

SURFACE = octafield.surface
QUADS = 400


# ---- domains: a mesh, the corner, the sharpest angle (degrees), vertices that get one quad


def _meshed(pieces, edge: float) -> octafield.TriangleMesh:
    size = lambda points: np.full(len(points), edge)
    return region([resampled(pieces, size)], size)


def _polygon(corners, edge: float) -> octafield.TriangleMesh:
    corners = np.array(corners, float)
    return _meshed([np.linspace(a, b, 200) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)], edge)


def _edge_for(area: float) -> float:
    """Of triangles: about 700 of them."""
    return float(np.sqrt(area / 300))


def sector(degrees: float):
    angle = np.radians(degrees)
    turn = np.linspace(0, angle, 200)
    arc = np.column_stack([np.cos(turn), np.sin(turn)])
    to = np.linspace(0, 1, 200)[:, None]
    return _meshed([to * arc[0], arc, (1 - to) * arc[-1]], _edge_for(angle / 2)), (0, 0), degrees, None


def right_trapezoid(degrees: float):
    width = 0.8 + 1 / np.tan(np.radians(degrees))
    mesh = _polygon([(0, 0), (width, 0), (0.8, 1), (0, 1)], _edge_for((width + 0.8) / 2))
    return mesh, (width, 0), degrees, None


def parallelogram(degrees: float):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    corners = [(0, 0), (1.3, 0), (1.3 + c, s), (c, s)]
    return _polygon(corners, _edge_for(1.3 * s)), (0, 0), degrees, corners


FAMILIES = {
    "sector": sector,
    "right trapezoid": right_trapezoid,
    "parallelogram": parallelogram,
}


def prism(degrees: float) -> octafield.TriangleMesh:
    """Over the right triangle with this angle and a side of 1 at it; height 0.6."""
    plane = np.array([(0, 0), (1, 0), (1, np.tan(np.radians(degrees)))])
    points = np.concatenate([np.column_stack([plane, np.full(3, z)]) for z in (0, 0.6)])
    sides = [t for a, b in ((0, 1), (1, 2), (2, 0)) for t in ([a, b, b + 3], [a, b + 3, a + 3])]
    return octafield.TriangleMesh(points, [[0, 2, 1], [3, 4, 5], *sides])


# ---- figures


def quads_of(source, axes: str, corners=None):
    """The result, or the kind of the error."""
    wanted = octafield.QuadLayoutOptions(quads=QUADS, axes=axes)
    try:
        return octafield.compute_quad_layout(source, layout_options=wanted, corners=corners)
    except octafield.Error as error:
        return error.kind


def off_sides(field, corner) -> float:
    """Degrees: the largest angle between one of the two sides at the corner and the nearest line of its vertices, but
    for those at its other end."""
    points = np.array(field.domain.vertices)
    edges = np.array(field.domain.edges)[np.array(field.domain.edge_triangles).min(axis=1) < 0]
    rim = np.unique(edges)
    at = int(np.argmin(np.linalg.norm(points[:, :2] - corner, axis=1)))
    away = points - points[at]
    worst = 0.0
    for a, b in edges[(edges == at).any(axis=1)]:
        side = away[a + b - at] / np.linalg.norm(away[a + b - at])
        on_it = rim[np.linalg.norm(away[rim] - np.outer(away[rim] @ side, side), axis=1) < 1e-9]
        on_it = on_it[np.argsort(away[on_it] @ side)][:-1]
        across = [
            np.linalg.norm(np.cross(np.array(lines)[on_it], side), axis=1) for lines in (field.first, field.second)
        ]
        worst = max(worst, float(np.degrees(np.arcsin(np.minimum(*across).max()))))
    return worst


def _points(result, corner, edge: float) -> str:
    inside = [point for point in result.record.singular_points if not point.boundary]
    if not inside:
        return "none"
    near = min(np.linalg.norm(np.array(point.position)[:2] - corner) for point in inside)
    return f"{len(inside)}, {near / edge:.1f}"


def _jacobians(result) -> str:
    found = result.record.scaled_jacobian
    return f"{found.min:.3f}, {found.p05:.2f}, {found.mean:.3f}"


def _told(result, points) -> tuple:
    """points, quads, edges, scaled Jacobians; the kind of an error."""
    if isinstance(result, str):
        return result, "", "", ""
    lengths = result.record.edge_length
    return points(result), result.record.quads, f"{lengths.p95 / lengths.p05:.1f}", _jacobians(result)


HEADER = (
    "domain", "angle", "sine of the sharpest corner", "lines off sides, degrees", "free: points inside, edges away",
    "quads", "edges p95 / p05", "scaled Jacobian: min, p05, mean", "orthogonal: points", "quads", "edges",
    "scaled Jacobian",
)  # fmt: skip


def _at(mesh, places):
    """One quad at each of the places."""
    points = np.array(mesh.vertices)[:, :2]
    return None if places is None else [[int(np.argmin(np.linalg.norm(points - p, axis=1))), 1] for p in places]


def plane_rows(angles) -> tuple[list[tuple], dict]:
    rows, results = [], {}
    for name, family in FAMILIES.items():
        for degrees in angles:
            mesh, corner, sharpest, single = family(degrees)
            domain = SURFACE.SurfaceDomain(mesh)
            corners = None if single is None else [{"position": [*place, 0], "quads": 1} for place in single]
            free, right = (quads_of(domain, axes, corners) for axes in ("free", "orthogonal"))
            results[name, degrees] = free, right
            points = lambda result, corner=corner, edge=domain.mean_edge_length: _points(result, corner, edge)
            told = (*_told(free, points), *_told(right, points))
            lines = SURFACE.non_orthogonal_field(mesh, corners=_at(mesh, single))
            rows.append(
                (name, degrees, f"{np.sin(np.radians(sharpest)):.3f}", f"{off_sides(lines, corner):.1e}", *told)
            )
    return rows, results


def prism_rows(angles) -> tuple[list[tuple], dict]:
    rows, results = [], {}
    for degrees in angles:
        sharpest = min(degrees, 90 - degrees)
        free, right = (quads_of(prism(degrees), axes) for axes in ("free", "orthogonal"))
        results[degrees] = free, right
        points = lambda result: sum(not point.boundary for point in result.record.singular_points)
        told = (*_told(free, points), *_told(right, points))
        rows.append(("prism", degrees, f"{np.sin(np.radians(sharpest)):.3f}", "", *told))
    return rows, results


# ---- pictures


def _draw(axes, result, title: str) -> None:
    points, quads = np.array(result.mesh.vertices)[:, :2], np.array(result.mesh.quads)
    shown = PolyCollection(
        points[quads], array=result.scaled_jacobians, cmap="cividis", edgecolors="black", linewidths=0.25
    )
    shown.set_clim(0, 1)
    axes.add_collection(shown)
    for point in result.record.singular_points:
        if not point.boundary:
            _, color, marker = SIGNS[point.index_times_four < 0]
            axes.plot(*point.position[:2], marker, color=color, markersize=4, markeredgecolor="black", zorder=5)
    axes.set(aspect="equal", xticks=(), yticks=())
    axes.autoscale_view()
    axes.spines[:].set_visible(False)
    axes.set_title(f"{title}: least {result.record.scaled_jacobian.min:.2f}", fontsize=8)


def draw_plane(results: dict, path: Path) -> None:
    wanted = [("sector", 15), ("sector", 30), ("right trapezoid", 30), ("sector", 60)]
    shown = [key for key in wanted if key in results]
    if not shown:
        return
    figure, panels = new_figure(2.6 * len(shown), 4.2, 2, len(shown), squeeze=False)
    for column, key in enumerate(shown):
        for axes, result, title in zip(panels[:, column], results[key], ("free", "orthogonal"), strict=True):
            if not isinstance(result, str):
                _draw(axes, result, f"{key[0]}, {key[1]} degrees, {title}")
            else:
                axes.set_axis_off()
    save_drawing(figure, path)


def draw_prisms(results: dict, path: Path) -> None:
    from octafield.view import scene

    shown = [degrees for degrees in (15, 30) if degrees in results]
    if not shown:
        return
    figure, panels = new_figure(4.0 * len(shown), 3.4, 1, len(shown), squeeze=False)
    for axes, degrees in zip(panels[0], shown, strict=True):
        result = results[degrees][0]
        axes.set_axis_off()
        if isinstance(result, str):
            continue
        plotter = result._drawn()
        scene.look(plotter, np.array(result.mesh.vertices), np.array([-0.6, -1.0, 0.7]), np.array([0, 0, 1.0]))
        image = np.array(plotter.screenshot(return_img=True))
        plotter.close()
        drawn = np.argwhere((image < 255).any(axis=2))
        (top, left), (bottom, right) = drawn.min(0), drawn.max(0) + 1
        axes.imshow(image[top:bottom, left:right])
        axes.set_title(f"{degrees} degrees: least {result.record.scaled_jacobian.min:.2f}", fontsize=9)
    save_drawing(figure, path)


def at_the_corner(degrees: float, quads: int) -> float:
    """The longest edge at the corner of a sector of radius 1, along lines at any angle."""
    mesh, corner, _, _ = sector(degrees)
    wanted = octafield.QuadLayoutOptions(quads=quads, axes="free")
    made = octafield.compute_quad_layout(SURFACE.SurfaceDomain(mesh), layout_options=wanted).mesh
    points, cells = np.array(made.vertices)[:, :2], np.array(made.quads)
    at = int(np.argmin(np.linalg.norm(points - corner, axis=1)))
    edges = np.concatenate([cells[:, [k, (k + 1) % 4]] for k in range(4)])
    ends = points[edges[(edges == at).any(axis=1)]]
    return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).max())


def cost(edges) -> str:
    """A row per edge length of the trapezoid of 30 degrees: CPU seconds of each step to 2,000 quads along its lines."""
    rows = []
    for edge in edges:
        width = 0.8 + 1 / np.tan(np.radians(30))
        mesh = _polygon([(0, 0), (width, 0), (0.8, 1), (0, 1)], edge)
        marks = [time.process_time()]
        mark = lambda value, marks=marks: (marks.append(time.process_time()), value)[1]
        lines = mark(SURFACE.non_orthogonal_field(mesh))
        domain = SURFACE.lines_metric(lines).domain
        pattern = mark(SURFACE.singular_pattern(domain, SURFACE.surface_singularities(lines)))
        field = mark(SURFACE.impose_singular_points(domain, pattern, inadmissible="move"))
        mark(SURFACE.quantized_quads(SURFACE.motorcycle_graph(field), quad_count=2000))
        rows.append([f"{len(mesh.triangles):,}", *(f"{took:.2f}" for took in np.diff(marks))])
    return markdown_table(("triangles", "lines, CPU s", "points and metric", "imposed field", "quads"), rows)


def wedges(output: Path, angles) -> str:
    rows, planes = plane_rows(angles)
    more, prisms = prism_rows(angles)
    draw_plane(planes, output / "non_orthogonal_wedges.png")
    draw_prisms(prisms, output / "non_orthogonal_prisms.png")
    text = markdown_table(HEADER, rows + more)
    if 15 in angles:
        longest = [f"{at_the_corner(15, quads):.2f}" for quads in (400, 6400)]
        text += (
            f"\nLongest edge at the corner of the sector of 15 degrees, 400 and 6,400 quads: {', '.join(longest)}.\n"
        )
    (output / "wedges.md").write_text(text)
    return text
