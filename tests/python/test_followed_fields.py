"""Quads along the directions of a field that the user has; u, v of the surface."""

import json

import numpy as np
import octafield as of
import pytest
from octafield.domain.generators import generate
from octafield.quad_mesh.given_field import GivenField
from pipeline_fixtures import octafield
from quad_mesh_checks import disk, require_conforming
from surface_fixtures import square
from test_quad_mesh import ring, turned
from test_t_meshes import cube

KEPT = of.SurfaceFieldOptions(remesh=False)
WAVE = 0.1


def height(points):
    """Constant along the wavy lines; 0 and 1 below and above."""
    x, y = np.asarray(points)[:, :2].T
    return y + WAVE * np.cos(2 * np.pi * x) * np.sin(np.pi * y)


def wavy(points):
    """Along lines of one height: these follow the lower and the upper side, and meet the others at right angles."""
    x, y = np.asarray(points)[:, :2].T
    by_x = -2 * np.pi * WAVE * np.sin(2 * np.pi * x) * np.sin(np.pi * y)
    by_y = 1 + np.pi * WAVE * np.cos(2 * np.pi * x) * np.cos(np.pi * y)
    return np.column_stack([by_y, -by_x, 0 * x]) / np.hypot(by_x, by_y)[:, None]


def edges(mesh):
    quads = np.asarray(mesh.quads)
    return np.unique(np.sort(np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)]), axis=1), axis=0)


def degrees_off(mesh, directions_at):
    """Of edges at their middles, in the plane."""
    ends = np.asarray(mesh.vertices)[edges(mesh)]
    along, line = ends[:, 1] - ends[:, 0], directions_at(ends.mean(axis=1))
    sine, cosine = along[:, 0] * line[:, 1] - along[:, 1] * line[:, 0], (along * line).sum(axis=1)
    angle = np.degrees(np.arctan2(abs(sine), abs(cosine)))
    return np.minimum(angle, 90 - angle)


def made(plate, field, **wanted):
    return of.compute_quad_mesh(plate, KEPT, quad_options=of.QuadMeshOptions(**wanted), field=field)


def test_edges_follow_wavy_lines_where_points_alone_say_nothing_of_them():
    plate = square(24)
    field = wavy(plate.vertices)
    followed, square_ones = (made(plate, field, quads=400, follow=way) for way in ("directions", "points"))
    for result in (followed, square_ones):
        off, told = degrees_off(result.mesh, wavy), result.record.field_angle
        assert np.median(off) == pytest.approx(told.median, abs=0.2)
        assert np.percentile(off, 90) == pytest.approx(told.p90, abs=0.5)
        assert result.record.irregular_vertices == {}
    assert followed.record.field_angle.median < 1 and followed.record.field_angle.p90 < 4
    assert square_ones.record.field_angle.median > 10
    assert followed.record.scaled_jacobian.min > 0.9
    np.testing.assert_array_equal(followed.mesh.quads, square_ones.mesh.quads)


def test_rows_of_quads_are_lines_of_one_height():
    plate = square(24)
    result = made(plate, wavy(plate.vertices), quads=400)
    points, pairs = np.asarray(result.mesh.vertices), edges(result.mesh)
    along = points[pairs[:, 1]] - points[pairs[:, 0]]
    level = pairs[abs(along[:, 0]) > abs(along[:, 1])]
    heights = height(points)
    steps = abs(heights[level[:, 1]] - heights[level[:, 0]])
    assert len(level) == 21 * 20 and np.percentile(steps, 90) < 0.04 / 20


def test_directions_may_be_of_triangles_and_the_surface_may_be_made_anew():
    plate = square(24)
    middles = np.asarray(plate.vertices)[np.asarray(plate.triangles)].mean(axis=1)
    assert made(plate, wavy(middles), quads=400).record.field_angle.median < 2
    remeshed = of.compute_quad_mesh(
        plate, quad_options=of.QuadMeshOptions(quads=400), field=wavy(plate.vertices)
    )  # lengths that fit a plate are long
    assert remeshed.record.field_angle.median < remeshed.record.field_angle.p90 < 12


def test_between_vertices_crosses_are_linear_not_directions():
    """Two directions of one cross are no turn."""
    plate = of.TriangleMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    field = GivenField(plate, np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0]]), False)
    directions, normals = field.at(np.array([[0.3, 0.3, 0], [0.5, 0.5, 0.1]]))
    assert np.allclose(abs(directions[:, :2]).max(axis=1), 1) and np.allclose(normals, [0, 0, 1])
    angle = np.radians(20)
    half = GivenField(plate, np.array([[1.0, 0, 0], [np.cos(angle), np.sin(angle), 0], [1, 0, 0]]), False)
    found = half.at(np.array([[0.5, 0, 0]]))[0][0]
    assert np.degrees(np.arctan2(found[1], found[0])) == pytest.approx(10)


def test_on_a_surface_without_boundary_quads_turn_as_the_field_is():
    """Round the tube of a torus, or at 45 degrees to it: no point and no boundary would tell."""
    torus = generate("torus")
    points = np.asarray(torus.vertices)
    around = np.arctan2(points[:, 1], points[:, 0])
    radii = np.hypot(points[:, 0], points[:, 1])
    middle = (radii.min() + radii.max()) / 2
    outward = np.column_stack([np.cos(around), np.sin(around), 0 * around])
    along = np.column_stack([-np.sin(around), np.cos(around), 0 * around])
    normal = (radii - middle)[:, None] * outward + points * [0, 0, 1]
    other = np.cross(normal / np.linalg.norm(normal, axis=1)[:, None], along)
    for share in (0.0, 1.0):
        record = made(torus, along + share * other, quads=1500).record
        assert record.irregular_vertices == {} and record.field_angle.p90 < 2


def test_points_go_where_the_field_has_them():
    """A field that is bent from the smoothest of its points, which no imposed field has there."""
    plate = disk(24)
    surface = of.surface
    places = [(0.5, 0.01), (0, 0.4), (-0.5, 0), (0.02, -0.45)]
    points = [surface.imposed_point(plate, [x, y, 0], 1) for x, y in places]
    own = surface.impose_singular_points(plate, surface.SingularPattern(points), inadmissible="rotate")
    fine = own.field.domain.mesh
    middles = np.asarray(fine.vertices)[np.asarray(fine.triangles)].mean(axis=1)
    bend = np.radians(25) * (1 - (middles**2).sum(axis=1)) * np.sin(4 * middles[:, 0])
    x, y = np.array(surface.triangle_directions(own.field))[:, :2].T
    bent = np.column_stack([np.cos(bend) * x - np.sin(bend) * y, np.sin(bend) * x + np.cos(bend) * y, 0 * x])
    followed, not_followed = (made(fine, bent, quads=400, follow=way).record for way in ("directions", "points"))
    assert followed.irregular_vertices == not_followed.irregular_vertices == {"3": 4}
    assert followed.field_angle.median < 2 and followed.field_angle.p90 < 7
    assert not_followed.field_angle.median > 7 and followed.scaled_jacobian.min > 0.7


def test_sizes_and_features_go_with_a_field():
    plate = square(24)
    result = of.compute_quad_mesh(
        plate,
        KEPT,
        quad_options=of.QuadMeshOptions(quads=400),
        sizes=lambda points: 1 + points[:, 0],
        field=wavy(plate.vertices),
    )
    assert result.record.field_angle.median < 2 and result.record.inverted == 0
    part = cube()
    directions = np.zeros((len(part.triangles), 3))
    normals = np.array(of.surface.triangle_normals(part))
    turn = np.radians(15)
    for row, normal in zip(directions, normals, strict=True):
        x = np.roll(abs(normal), 1)
        row[:] = np.cos(turn) * x + np.sin(turn) * np.cross(normal, x)
    boxed = made(part, directions, quads=600)
    assert boxed.record.feature_deviation.curves < 1e-12 and boxed.record.irregular_vertices == {"3": 8}
    [note] = boxed.record.notes
    assert "100 % of the boundary and the features" in note and "by up to 15" in note


def test_a_field_that_leaves_the_boundary_is_told_and_followed_inside():
    plate = ring()
    spiral = turned(plate, lambda r: np.radians(20) + 0 * r)
    record = made(plate, spiral, quads=900).record
    assert any("100 % of the boundary" in note and "by up to 20" in note for note in record.notes)
    assert record.inverted == 0 and record.field_angle.median < 8  # farther inside, where it follows
    aligned = made(plate, turned(plate, lambda r: 0 * r), quads=900).record
    assert aligned.notes == [] and aligned.field_angle.p90 < 0.5


@pytest.mark.parametrize(
    "given",
    [
        {"follow": np.ones(3, complex)},
        {"follow": np.full(56, np.nan + 0j)},
        {"measure": "parameters"},
        {"smoothing": 0},
    ],
)
def test_what_cannot_be_followed_is_refused(given):
    surface = of.surface
    field = surface.impose_singular_points(square(4), surface.SingularPattern())
    layout = surface.motorcycle_graph(field)
    assert len(layout.curves.domain.edges) == 56
    options = {"quad_count": 16, "measure": "lengths", "follow": np.ones(56, complex)} | given
    with pytest.raises(of.InvalidInput) as error:
        surface.quantized_quads(layout, **options)
    assert error.value.kind == "bad_option"


def test_following_needs_a_field():
    with pytest.raises(of.InvalidInput) as error:
        made(square(4), None, follow="points")
    assert error.value.kind == "ignored_option"
    with pytest.raises(of.InvalidInput):
        of.QuadMeshOptions(follow="me")


# ---- u, v


def read_obj(text):
    """Points, u v, and triangles as vertices and as u v, by nothing of octafield."""
    points, places, corners = [], [], []
    for word, *rest in (line.split() for line in text.splitlines()):
        if word == "f":
            corners.append([[int(number) - 1 for number in corner.split("/")] for corner in rest])
        else:
            {"v": points, "vt": places}[word].append([float(x) for x in rest])
    return np.array(points), np.array(places), np.array(corners)


def test_u_and_v_of_a_file_are_the_grid_of_the_quads(tmp_path):
    of.write_surface(disk(), tmp_path / "disk.obj")
    octafield("quad-mesh", tmp_path / "disk.obj", "-o", tmp_path / "out", "--quads", "200", "--no-remesh",
              "--parameterization", "-q", check=0)  # fmt: skip
    record = json.loads((tmp_path / "out" / "result.json").read_text())
    assert "parameterization.obj" in record["files"]
    points, places, corners = read_obj((tmp_path / "out" / "parameterization.obj").read_text())
    assert len(corners) == record["parameterization"]["triangles"] and points.shape[1] == 3
    flat = places[corners[:, :, 1]]
    u, v = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    areas = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
    assert areas.min() > 0 and areas.sum() == pytest.approx(record["quads"])
    # Over an edge: a turn by quarters and whole shifts, so lengths along it agree on both sides.
    sides = {}
    for triangle in corners:
        for k in range(3):
            (a, at), (b, bt) = sorted((tuple(triangle[k]), tuple(triangle[(k + 1) % 3])))
            sides.setdefault((a, b), []).append((places[at], places[bt]))
    for pair in sides.values():
        for (a, b), (c, d) in zip(pair, pair[1:], strict=False):
            one, other = complex(*(b - a)), complex(*(d - c))
            turn = other / one
            quarter = 1j ** round(np.angle(turn) / (np.pi / 2))
            assert abs(turn - quarter) < 1e-7
            shift = complex(*c) - quarter * complex(*a)
            assert abs(shift - complex(round(shift.real), round(shift.imag))) < 1e-7
    # A vertex has more than one u, v only where these do not go on.
    assert len(points) < len(places) < 2 * len(points)


def test_corner_coordinates_are_those_of_the_file(tmp_path):
    result = made(square(6), None, quads=30)
    grid_map = result.grid_map()
    places = of.corner_coordinates(grid_map)
    assert places.shape == (len(grid_map.triangles), 3, 2)
    of.write_grid_map(grid_map, tmp_path / "uv.obj")
    points, written, corners = read_obj((tmp_path / "uv.obj").read_text())
    np.testing.assert_array_equal(corners[:, :, 0], grid_map.triangles)
    np.testing.assert_array_equal(points, grid_map.positions)
    np.testing.assert_allclose(written[corners[:, :, 1]], places, atol=1e-8)
    with pytest.raises(of.InvalidInput) as error:
        of.write_grid_map(grid_map, tmp_path / "uv.stl")
    assert error.value.kind == "unknown_format"


def test_a_kept_boundary_has_no_map():
    region = [[(0, 0), (1, 0), (1, 1), (0, 1)]]
    result = of.compute_quad_mesh(region, quad_options=of.QuadMeshOptions(keep_boundary=True))
    require_conforming(result.mesh, 1)
    with pytest.raises(of.InvalidInput) as error:
        result.grid_map()
    assert error.value.kind == "ignored_option"
