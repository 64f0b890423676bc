"""Quads along two lines at any angle: octafield quad-layout --axes free."""

import pickle

import numpy as np
import octafield as of
import pytest
from octafield.command_line import fields as cli
from octafield.domain.generators import generate
from quad_mesh_checks import require_conforming
from surface_fixtures import polygon, prism, right_triangle
from typer.testing import CliRunner

surface = of.surface


def parallelogram(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return [(0, 0), (1.3, 0), (1.3 + c, s), (c, s)]


def made(source, quads=200, **more):
    return of.compute_quad_layout(source, layout_options=of.QuadLayoutOptions(quads=quads, axes="free"), **more)


def least_sine(mesh) -> float:
    corners = np.array(mesh.vertices)[np.array(mesh.quads)]
    to_next, to_last = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    crossed = np.linalg.norm(np.cross(to_next, to_last), axis=2)
    return float((crossed / np.linalg.norm(to_next, axis=2) / np.linalg.norm(to_last, axis=2)).min())


@pytest.mark.parametrize("degrees", [15, 30, 60])
def test_quads_of_a_triangle_are_as_good_as_its_sharpest_corner(degrees):
    result = made(polygon(right_triangle(degrees)), quads=300)
    sharpest = np.radians(min(degrees, 90 - degrees))
    assert least_sine(result.mesh) > np.sin(sharpest) - 0.05
    assert 270 <= result.record.quads <= 330
    assert result.record.options["axes"] == "free"
    assert result.record.point_source == "computed"
    require_conforming(result.mesh, 1)


def test_corners_that_are_given_decide_how_lines_run():
    corners = parallelogram(30)
    single = [{"position": [*corner, 0], "quads": 1} for corner in corners]
    result = made(polygon(corners), corners=single)
    assert not [point for point in result.record.singular_points if not point.boundary]
    points, quads = np.array(result.mesh.vertices), np.array(result.mesh.quads)
    sides = points[np.roll(quads, -1, axis=1)] - points[quads]
    sides /= np.linalg.norm(sides, axis=2)[..., None]
    slant = np.array([np.cos(np.pi / 6), np.sin(np.pi / 6), 0])
    along = np.maximum(abs(sides @ [1, 0, 0]), abs(sides @ slant))
    assert along.min() > 1 - 1e-12


@pytest.mark.parametrize("degrees", [15, 45])
def test_prisms_are_followed_along_all_edges(degrees):
    result = made(prism(degrees), quads=400)
    require_conforming(result.mesh, 2)
    assert 340 <= result.record.quads <= 460
    assert least_sine(result.mesh) > np.sin(np.radians(degrees)) - 0.05
    # Each corner is a vertex, and the quads' edges along each edge of the prism are as long as it.
    points, quads = np.array(result.mesh.vertices), np.array(result.mesh.quads)
    corners = np.array(prism(degrees).vertices)
    edges = np.unique(np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=2).reshape(-1, 2), axis=1), axis=0)
    for a, b in [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]:
        side = corners[b] - corners[a]
        away = np.linalg.norm(np.cross(points - corners[a], side), axis=1) / np.linalg.norm(side)
        on_it = edges[(away[edges] < 1e-9).all(axis=1)]
        length = np.linalg.norm(points[on_it[:, 0]] - points[on_it[:, 1]], axis=1).sum()
        assert length == pytest.approx(np.linalg.norm(side), rel=1e-9)


def test_given_points_run_on_the_surface_measured_by_lines():
    result = made(polygon(right_triangle(30)), singularities=[{"position": [0.7, 0.2, 0], "valence": 3}])
    inside = [point for point in result.record.singular_points if not point.boundary]
    assert [point.index_times_four for point in inside] == [1]
    assert np.allclose(inside[0].position, [0.7, 0.2, 0], atol=1e-6)


def test_a_surface_keeps_its_own_lengths_where_it_is_copied():
    domain = made(polygon(right_triangle(30))).field.field.domain
    assert domain.has_own_lengths
    again = pickle.loads(pickle.dumps(domain))
    assert again.has_own_lengths
    assert np.array_equal(again.edge_lengths, domain.edge_lengths)
    assert np.array_equal(again.corner_angles, domain.corner_angles)
    with pytest.raises(of.InvalidInput) as caught:
        surface.non_orthogonal_field(domain)
    assert caught.value.kind == "own_lengths"
    with pytest.raises(of.GeometryError) as caught:
        surface.SurfaceDomain(polygon(right_triangle(30)), edge_lengths=[1, 1, 3])
    assert caught.value.kind == "no_triangle" and caught.value.elements == [0]


def test_directions_of_a_field_are_along_the_lines():
    """In space they are oblique: of the pair at a vertex of the boundary one is along it."""
    result = made(polygon(right_triangle(30)))
    field = result.field.field
    found = np.array(surface.vertex_directions(field))
    points, edges = np.array(field.domain.vertices), np.array(field.domain.edges)
    rim = edges[np.array(field.domain.edge_triangles).min(axis=1) < 0]
    along = points[rim[:, 1]] - points[rim[:, 0]]
    along /= np.linalg.norm(along, axis=1)[:, None]
    best = np.zeros(len(points))
    for k in range(2):
        np.maximum.at(best, rim[:, k], abs(np.einsum("ij,ij->i", found[rim[:, k]], along)))
    assert best[np.unique(rim)].min() > 1 - 1e-9
    assert np.allclose(np.linalg.norm(surface.triangle_directions(field), axis=1), 1)


def test_the_command_takes_it(tmp_path):
    of.write_surface(prism(30), tmp_path / "prism.obj")
    arguments = [
        "quad-layout",
        tmp_path / "prism.obj",
        "-o",
        tmp_path / "out",
        "--quads",
        "200",
        "--axes",
        "free",
        "-q",
    ]
    done = CliRunner().invoke(cli.app, [str(argument) for argument in arguments])
    assert done.exit_code == 0, done.output
    assert '"axes": "free"' in (tmp_path / "out" / "result.json").read_text()


def test_other_axes_are_refused():
    with pytest.raises(of.InvalidInput, match="axes"):
        of.QuadLayoutOptions(axes="oblique")


def test_only_faces_with_oblique_corners_are_measured_by_lines():
    domain = made(prism(30)).field.field.domain
    lengths = np.linalg.norm(np.diff(np.array(domain.vertices)[np.array(domain.edges)], axis=1)[:, 0], axis=1)
    other = abs(np.array(domain.edge_lengths) / lengths - 1) > 1e-6
    assert other.any()
    heights = np.array(domain.vertices)[np.array(domain.edges)[other]][..., 2]
    assert set(np.round(heights.ravel(), 9)) == {0.0, 0.6}  # those of the triangles at both ends


def test_without_oblique_corners_quads_are_those_of_right_angles():
    cylinder = generate("cylinder")
    free = made(cylinder, quads=300)
    right = of.compute_quad_layout(cylinder, layout_options=of.QuadLayoutOptions(quads=300))
    assert np.array_equal(free.mesh.vertices, right.mesh.vertices)
    assert np.array_equal(free.mesh.quads, right.mesh.quads)
    assert not free.field.field.domain.has_own_lengths
