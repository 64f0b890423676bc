"""octafield quad-mesh: quads of wanted sizes."""

import json

import meshio
import numpy as np
import octafield as of
import pytest
from octafield.command_line import fields as cli
from octafield.domain.generators import generate
from octafield.quad_mesh.features import feature_deviation
from octafield.quad_mesh.record import notes_of_features
from octafield.records.record_file import any_record
from pipeline_fixtures import octafield
from quad_mesh_checks import area_of, disk, require_conforming
from surface_fixtures import square
from test_t_meshes import cube
from typer.testing import CliRunner

KEPT = of.SurfaceFieldOptions(remesh=False)


def made(source, sizes=None, **wanted):
    return of.compute_quad_mesh(source, KEPT, quad_options=of.QuadMeshOptions(**wanted), sizes=sizes)


def valences(mesh):
    """Of vertices inside with other than four quads: {number of quads: how many}, by numpy alone."""
    quads = np.asarray(mesh.quads)
    sides = np.sort(np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)]), axis=1)
    edges, count = np.unique(sides, axis=0, return_counts=True)
    around = np.bincount(quads.ravel(), minlength=len(mesh.vertices))
    around[edges[count == 1].ravel()] = 4
    found, number = np.unique(around[around != 4], return_counts=True)
    return {str(k): int(n) for k, n in zip(found, number, strict=True)}


def areas(mesh):
    p = np.asarray(mesh.vertices)[np.asarray(mesh.quads)]
    return np.linalg.norm(np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1]), axis=1) / 2


@pytest.fixture(scope="module")
def of_disk():
    return made(disk(), quads=300)


def test_quads_are_conforming_of_wanted_number_and_irregular_where_the_field_is(of_disk):
    mesh, record = of_disk.mesh, of_disk.record
    require_conforming(mesh, 1)
    inside = [point for point in record.field_singularities if not point.boundary]
    assert valences(mesh) == record.irregular_vertices == {"3": len(inside)} == {"3": 4}
    assert abs(record.quads / record.target - 1) <= 0.05 and record.target == 300
    assert record.inverted == record.nonconforming_edges == record.t_junctions == 0
    assert record.whole_numbers.objective >= record.whole_numbers.bound - 1e-9 >= -1e-9
    assert record.angle.min > 45 and record.angle.max < 160


def test_size_ratios_are_those_of_the_areas(of_disk):
    ratios = np.sqrt(areas(of_disk.mesh)) / np.sqrt(np.pi / 300)
    np.testing.assert_allclose(of_disk.size_ratios, ratios, rtol=2e-3)  # the disk is a polygon
    p10, p90 = np.percentile(ratios, [10, 90])
    assert abs(of_disk.record.size_ratio.p10 - p10) < 2e-3 and abs(of_disk.record.size_ratio.p90 - p90) < 2e-3


def test_quads_by_lengths_are_nearer_to_one_size_than_those_by_parameters():
    """Where the field's own sizes differ: round a hole."""

    def spread(measure):
        wanted = of.QuadLayoutOptions(quads=300, blocks="fine", measure=measure)
        low, high = np.percentile(areas(of.compute_quad_layout(plate, KEPT, layout_options=wanted).mesh), [10, 90])
        return high / low

    plate = plate_with_hole()
    assert spread("lengths") < 0.8 * spread("parameters")


def plate_with_hole(n=32, rings=10):
    """The square [-4, 4]^2 less the unit disk."""
    angles = 2 * np.pi * np.arange(n) / n
    inner = np.column_stack([np.cos(angles), np.sin(angles)])
    outer = 4 * inner / abs(inner).max(axis=1)[:, None]
    shares = (np.arange(rings + 1) / rings)[:, None, None] ** 1.5
    points = ((1 - shares) * inner + shares * outer).reshape(-1, 2)
    return of.TriangleMesh(np.column_stack([points, 0 * points[:, 0]]), ring_triangles(n, rings))


def test_features_and_corners_are_followed_exactly():
    result = made(cube(), quads=300)
    assert result.record.feature_deviation.corners == 0 and result.record.feature_deviation.curves < 1e-12
    assert result.record.irregular_vertices == {"3": 8}
    moved = np.array(result.mesh.vertices)
    corner = int(np.flatnonzero((moved == 1).all(axis=1))[0])
    moved[corner] = 0.99
    bent = of.surface.QuadMesh(moved, quads=np.asarray(result.mesh.quads))
    whole = of.surface.SurfaceDomain(cube(), of.surface.detect_features(cube()))
    corners, curves = feature_deviation(bent, whole)
    assert corners > 1e-3 and curves > 1e-3


def test_how_features_are_followed_does_not_depend_on_where_the_surface_is():
    quads, shift = made(cube(), quads=300).mesh, np.array([1e8, -1e8, 0])
    moved = of.TriangleMesh(np.asarray(cube().vertices) + shift, cube().triangles)
    whole = of.surface.SurfaceDomain(moved, of.surface.detect_features(moved))
    there = of.surface.QuadMesh(np.asarray(quads.vertices) + shift, quads=np.asarray(quads.quads))
    corners, curves = feature_deviation(there, whole)
    assert corners < 1e-7 and curves < 1e-7


def ring(n=48, rings=16):
    """Between the circles of radius 1 and 4."""
    angles, radii = 2 * np.pi * np.arange(n) / n, 4.0 ** (np.arange(rings + 1) / rings)
    points = radii[:, None, None] * np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    return of.TriangleMesh(points.reshape(-1, 3), ring_triangles(n, rings))


def ring_triangles(n, rings):
    inner = [(r * n + i, r * n + (i + 1) % n) for r in range(rings) for i in range(n)]
    return [t for a, b in inner for t in ([a, a + n, b + n], [a, b + n, b])]


def test_sizes_like_the_radius_are_reached_between_circles_without_points():
    """Crosses along the circles turn as such quads do: squares of log r and the angle."""
    result = made(ring(), sizes=lambda p: 0.15 * np.linalg.norm(p, axis=1))
    mesh, record = result.mesh, result.record
    assert record.irregular_vertices == {}
    assert abs(record.target / (2 * np.pi * np.log(4) / 0.15**2) - 1) < 0.01
    assert abs(record.quads / record.target - 1) <= 0.05
    assert 0.9 < record.size_ratio.p10 and record.size_ratio.p90 < 1.1
    radii = np.linalg.norm(np.asarray(mesh.vertices)[np.asarray(mesh.quads)].mean(axis=1), axis=1)
    ratios = np.sqrt(areas(mesh)) / radii
    assert ratios.max() / ratios.min() < 1.25


def test_what_is_away_from_features_is_told():
    assert notes_of_features(0.0, 0.019) == []
    [corner] = notes_of_features(0.018, 0.019)
    [curve] = notes_of_features(1e-9, 0.03)
    assert "corner between features is no vertex of the quads, by up to 1.8 %" in corner
    assert "up to 3 % of the diagonal away from edges of quads along them" in curve


def growing(points):
    return 0.04 * 4 ** points[:, 0]


def test_where_the_boundary_forbids_how_sizes_turn_there_are_points():
    """Lines of quads that grow so turn by 79 degrees from the lower to the upper side, which are parallel."""
    result = made(square(24), sizes=growing)
    assert result.record.irregular_vertices == {"3": 1, "5": 1}
    middles = np.asarray(result.mesh.vertices)[np.asarray(result.mesh.quads)].mean(axis=1)
    sizes = np.sqrt(areas(result.mesh))
    assert sizes[middles[:, 0] > 0.9].mean() > 2 * sizes[middles[:, 0] < 0.1].mean()


def test_sizes_may_be_an_array_rows_a_file_or_grow_from_the_boundary(tmp_path):
    plate = square(12)
    points = np.asarray(plate.vertices)
    np.save(tmp_path / "sizes.npy", growing(points))
    rows = np.column_stack([points, growing(points)])
    numbers = {made(plate, sizes=sizes).record.quads for sizes in (growing(points), rows, tmp_path / "sizes.npy")}
    assert len(numbers) == 1
    grown = made(square(24), sizes="growth=0.3")
    middles = np.asarray(grown.mesh.vertices)[np.asarray(grown.mesh.quads)].mean(axis=1)
    depth = np.minimum(middles[:, :2], 1 - middles[:, :2]).min(axis=1)
    size = np.sqrt(areas(grown.mesh))
    assert size[depth > 0.3].mean() > 1.2 * size[depth < 0.1].mean()
    assert area_of(grown.mesh) == pytest.approx(1)


def test_with_a_number_of_quads_the_ratios_of_sizes_count():
    plate = square(12)
    one, other = (made(plate, sizes=lambda p, f=f: f * growing(p), quads=150) for f in (1, 1000))
    assert one.record.quads == other.record.quads
    np.testing.assert_array_equal(one.mesh.quads, other.mesh.quads)


@pytest.mark.parametrize(
    "sizes, kind",
    [
        ([1.0, 2.0], "wrong_size"),
        (lambda p: -np.ones(len(p)), "bad_sizes"),
        (lambda p: np.where(p[:, 0] > 0.5, 1.0, 0.01), "steep_sizes"),
        (lambda p: 1e-7 + 0 * p[:, 0], "too_many_cells"),
        ("growth=fast", "bad_option"),
        ("growth=-1", "bad_option"),
        ("nowhere.npy", None),
    ],
)
def test_sizes_that_no_quads_can_have_are_refused(sizes, kind):
    with pytest.raises(of.Error) as error:
        made(square(6), sizes=sizes)
    assert kind is None or error.value.kind == kind


def test_growth_needs_a_boundary_and_one_size_is_enough():
    with pytest.raises(of.InvalidInput) as error:
        made(cube(), sizes="growth=0.1")
    assert error.value.kind == "no_boundary"
    with pytest.raises(of.InvalidInput):
        of.QuadMeshOptions(quads=10, edge_length=0.1)


@pytest.mark.parametrize("name", ["torus", "nut"])
def test_generated_parts_have_quads_alone(name):
    part = generate(name)
    result = of.compute_quad_mesh(part, quad_options=of.QuadMeshOptions(quads=800))
    surface = of.surface.SurfaceDomain(part)
    euler = len(part.vertices) - len(surface.edges) + len(part.triangles)
    require_conforming(result.mesh, euler)
    record = result.record
    assert record.inverted == 0 and record.scaled_jacobian.min > 0.3
    assert sum((4 - int(v)) * n for v, n in record.irregular_vertices.items()) == 4 * euler


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Of a run of the command, with its JSON beside."""
    folder = tmp_path_factory.mktemp("quads")
    of.write_surface(disk(), folder / "disk.obj")
    octafield("quad-mesh", folder / "disk.obj", "-o", folder / "out", "--quads", "200", "--no-remesh", "--formats",
              "vtu,obj,off,msh,mesh,inp", "--json", folder / "out.json", "-q", check=0)  # fmt: skip
    return folder


def test_every_format_holds_the_same_quads(folder):
    whole = meshio.read(folder / "out" / "mesh.vtu")
    quads = whole.cells_dict["quad"]
    lines = (folder / "out" / "mesh.obj").read_text().splitlines()
    places = np.array([line.split()[1:] for line in lines if line.startswith("v ")], float)
    faces = np.array([line.split()[1:] for line in lines if line.startswith("f ")], int) - 1
    np.testing.assert_array_equal(places, whole.points)
    np.testing.assert_array_equal(faces, quads)
    head, counts, *rest = (folder / "out" / "mesh.off").read_text().splitlines()
    assert head == "OFF" and counts.split() == [str(len(places)), str(len(quads)), "0"]
    np.testing.assert_array_equal(
        [line.split() for line in rest[len(places) :]], np.insert(quads, 0, 4, axis=1).astype(str)
    )
    for name in ("mesh.msh", "mesh.mesh", "mesh.inp"):
        found = meshio.read(folder / "out" / name)
        np.testing.assert_allclose(found.points, whole.points, atol=1e-12)
        np.testing.assert_array_equal(found.cells_dict["quad"], quads)
    assert {"scaled_jacobian", "size_ratio"} <= set(whole.cell_data) and {"quads", "boundary"} <= set(whole.point_data)


def test_json_of_the_name_of_the_folder_is_refused_before_anything_is_written(folder, capsys):
    told = CliRunner().invoke(
        cli.app, ["quad-mesh", str(folder / "disk.obj"), "-o", str(folder / "one"), "--json", str(folder / "one"), "-q"]
    )
    assert told.exit_code == 2 and not (folder / "one").exists()
    assert "--json and -o are both" in told.output + capsys.readouterr().err


def test_quads_are_as_many_as_wanted_where_one_size_has_all_arcs_of_a_cube_alike():
    """Of one size 6 n^2: 150 or 216. 5 x 5 x 6 are 170."""
    result = made(cube(), quads=172)
    assert result.record.quads == 170 and result.record.scaled_jacobian.min > 0.99


def test_the_record_is_read_back(folder):
    told = json.loads((folder / "out.json").read_text())
    assert told == json.loads((folder / "out" / "result.json").read_text())
    record = any_record(folder / "out" / "result.json")
    assert type(record).__name__ == "QuadMeshRecord" and record.quads == told["quads"]
    assert sorted(told["files"]) == sorted(path.name for path in (folder / "out").iterdir())
    assert record.seconds == pytest.approx(sum(record.wall_seconds.values()))


def test_the_command_refuses_unknown_formats(tmp_path):
    of.write_surface(square(2), tmp_path / "plate.obj")
    done = CliRunner().invoke(
        cli.app, ["quad-mesh", str(tmp_path / "plate.obj"), "-o", str(tmp_path / "out"), "--formats", "vtu,stl"]
    )
    assert done.exit_code != 0 and not (tmp_path / "out").exists()


def turned_points(result):
    return sorted(tuple(np.round(p.position, 3)) for p in result.record.field_singularities if not p.boundary)


def test_a_field_of_ones_own_gives_the_irregular_vertices(tmp_path):
    """Of the disk: the field round four points at other places than a computed one has them."""
    plate = disk(12)
    places = [(0.5, 0.01), (0.0, 0.4), (-0.5, 0.0), (0.02, -0.45)]
    surface = of.surface
    points = [surface.imposed_point(plate, [x, y, 0], 1) for x, y in places]
    own = surface.impose_singular_points(plate, surface.SingularPattern(points))
    fine = own.field.domain
    of.write_surface(fine.mesh, tmp_path / "fine.obj")
    directions = np.asarray(surface.vertex_directions(own.field))
    np.save(tmp_path / "field.npy", directions)
    result = of.compute_quad_mesh(
        tmp_path / "fine.obj", KEPT, quad_options=of.QuadMeshOptions(quads=300), field=tmp_path / "field.npy"
    )
    found = np.array(turned_points(result))[:, :2]
    assert len(found) == 4 and result.record.irregular_vertices == {"3": 4}
    assert np.linalg.norm(found - sorted(places), axis=1).max() < 0.05
    assert result.record.point_source == str(tmp_path / "field.npy")
    computed = np.array(turned_points(made(plate, quads=300)))[:, :2]
    assert np.linalg.norm(computed, axis=1).min() > 0.7  # where nobody has moved them


@pytest.mark.parametrize(
    "field, kind",
    [(np.ones((3, 3)), "wrong_shape"), (np.zeros((49, 3)), "bad_field"), (np.full((49, 3), np.nan), "bad_field"),
     (np.ones(49), "wrong_shape"), ("no.npy", None)],
)  # fmt: skip
def test_what_is_no_field_is_refused(field, kind):
    with pytest.raises(of.Error) as error:
        of.compute_quad_mesh(square(6), KEPT, field=field)
    assert kind is None or error.value.kind == kind


def coast(n=96):
    """A closed curve with detail, counter-clockwise, of n points."""
    a = 2 * np.pi * np.arange(n) / n
    r = 1 + 0.25 * np.sin(3 * a) + 0.06 * np.sin(11 * a + 1)
    return np.column_stack([r * np.cos(a), r * np.sin(a)])


def segments_of(mesh):
    quads = np.asarray(mesh.quads)
    return {tuple(sorted((int(a), int(b)))) for q in quads for a, b in zip(q, np.roll(q, -1), strict=True)}


def test_a_boundary_is_kept_segment_by_segment_round_a_hole_as_well():
    outer, hole = coast(), 0.3 * coast(24)[::-1]
    result = of.compute_quad_mesh([outer, hole], quad_options=of.QuadMeshOptions(keep_boundary=True))
    mesh, record = result.mesh, result.record
    _, rim = require_conforming(mesh, 0)
    points = np.asarray(mesh.vertices)[:, :2]
    place = {tuple(p): i for i, p in enumerate(points)}
    edges = segments_of(mesh)
    for loop in (outer, hole):
        ids = [place[tuple(p)] for p in loop]
        assert all(tuple(sorted(pair)) in edges for pair in zip(ids, np.roll(ids, -1).tolist(), strict=True))
    assert len(rim) == len(outer) + len(hole)
    told = record.kept_boundary
    assert (told.segments, told.kept, told.split) == (120, 120, 0)
    assert record.feature_deviation.corners == 0 and record.surface_deviation.max < 1e-12
    assert record.scaled_jacobian.min > 0.2 and abs(record.quads / record.target - 1) < 0.4


def test_sizes_grow_from_a_kept_boundary():
    result = of.compute_quad_mesh([coast()], quad_options=of.QuadMeshOptions(keep_boundary=True), sizes="growth=0.4")
    from_middle = np.linalg.norm(np.asarray(result.mesh.vertices)[np.asarray(result.mesh.quads)].mean(axis=1), axis=1)
    sizes = np.sqrt(areas(result.mesh))
    assert sizes[from_middle < 0.4].mean() > 2 * sizes[from_middle > 0.9].mean()
    assert result.record.kept_boundary.kept == 96


def test_a_flat_surface_keeps_its_boundary_at_its_height():
    """The same quads wherever it is, and sizes that are a function are asked where they are."""
    ground = of.surface.outline_triangles(of.planar_outline([coast(40)]))
    points = np.asarray(ground.vertices) + [0, 0, 5]
    raised = of.TriangleMesh(points, ground.triangles)
    options = of.QuadMeshOptions(keep_boundary=True)

    def size(places):
        assert (abs(places[:, 2] - 5) < 1e-12).all()
        return 0.1 + 0.1 * abs(places[:, 0])

    for low, high in (("growth=0.4", "growth=0.4"), (lambda p: size(p + [0, 0, 5]), size)):
        one = of.compute_quad_mesh(ground, KEPT, quad_options=options, sizes=low)
        other = of.compute_quad_mesh(raised, KEPT, quad_options=options, sizes=high)
        np.testing.assert_array_equal(one.mesh.quads, other.mesh.quads)
        np.testing.assert_allclose(np.asarray(one.mesh.vertices) + [0, 0, 5], other.mesh.vertices, atol=1e-9)
        assert other.record.surface_deviation.max < 1e-9 and other.record.feature_deviation.corners == 0
        assert other.record.seconds == pytest.approx(sum(other.record.wall_seconds.values()))
        assert other.record.wall_seconds["channel"] > 0


def test_outlines_are_surfaces_where_they_are_not_kept(tmp_path):
    shape = {"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 2], [0, 2], [0, 0]]]}
    (tmp_path / "plate.geojson").write_text(json.dumps(shape))
    options = of.QuadMeshOptions(quads=32)
    one, other = (of.compute_quad_mesh(source, quad_options=options) for source in (shape, tmp_path / "plate.geojson"))
    assert one.record.quads == other.record.quads == 32 and one.record.irregular_vertices == {}
    assert other.record.input.endswith("plate.geojson")


def test_a_line_inside_is_a_feature_of_an_outline():
    outline = of.planar_outline([[(0, 0), (1.3, 0), (4, 0), (4, 2), (1.3, 2), (0, 2)]], [[(1.3, 0), (1.3, 2)]])
    mesh = of.compute_quad_mesh(outline, quad_options=of.QuadMeshOptions(quads=32)).mesh
    points = np.asarray(mesh.vertices)
    assert (abs(points[:, 0] - 1.3) < 1e-12).sum() >= 4


def test_only_flat_surfaces_keep_their_boundary():
    with pytest.raises(of.InvalidInput) as error:
        made(cube(), keep_boundary=True)
    assert error.value.kind == "not_plane"


def test_triangles_of_an_outline_cover_what_is_inside():
    outline = of.planar_outline([[(0, 0), (4, 0), (4, 4), (0, 4)], [(1, 1), (1, 2), (2, 2), (2, 1)]])
    mesh = of.surface.outline_triangles(outline)
    assert np.asarray(of.surface.triangle_areas(mesh)).sum() == pytest.approx(15)
    assert of.surface.euler_characteristic(mesh) == 0


def turned(plate, by):
    """Directions at the vertices of a ring: along circles, turned by `by` of the radius."""
    points = np.asarray(plate.vertices)
    angle = np.arctan2(points[:, 1], points[:, 0]) + by(np.linalg.norm(points, axis=1))
    return np.column_stack([-np.sin(angle), np.cos(angle), 0 * angle])


def test_a_twisted_field_between_circles_has_valid_quads():
    """Its streamlines wind towards a closed one (a limit cycle), which the imposed field of its points has not. No rows
    of quads do."""
    plate = ring()
    twisted = turned(plate, lambda r: np.pi / 2 * (r - 1) / 3)
    for follow, least in (("points", 0.8), ("directions", 0.3)):
        wanted = of.QuadMeshOptions(quads=400, follow=follow)
        result = of.compute_quad_mesh(plate, KEPT, quad_options=wanted, field=twisted)
        require_conforming(result.mesh, 0)
        assert result.record.irregular_vertices == {} and result.record.scaled_jacobian.min > least
        assert any("do not wind as its lines do" in note for note in result.record.notes) == (follow == "directions")


def test_a_pair_on_a_torus_is_refused_or_meshed():
    """Fields of one point of valence 3 and one of 5 have a limit cycle there: no parameters exist."""
    torus = generate("torus")
    domain = of.surface.SurfaceDomain(torus)
    points = np.asarray(torus.vertices)
    pair = [
        {"position": points[0].tolist(), "valence": 3},
        {"position": points[len(points) // 2].tolist(), "valence": 5},
    ]
    for way in ("fail", "rotate"):
        options = of.QuadLayoutOptions(quads=400, inadmissible=way, blocks="fine", measure="lengths")
        try:
            result = of.compute_quad_layout(domain, layout_options=options, singularities=pair)
        except of.Error as error:
            refused = "inadmissible_pattern" if way == "fail" else ("no_integers", "no_quad_layout", "inverted_quads")
            assert error.kind in refused
        else:
            assert way == "rotate"
            require_conforming(result.mesh, 0)
            assert valences(result.mesh) == {"3": 1, "5": 1}


def test_noise_is_no_field():
    plate = square(24)
    noise = np.random.default_rng(3).normal(size=(len(plate.triangles), 3)) * [1, 1, 0]
    with pytest.raises(of.InvalidInput) as error:
        of.compute_quad_mesh(plate, KEPT, field=noise)
    assert error.value.kind == "rough_field"


def test_quads_that_cross_are_refused_and_poor_ones_told():
    """Of a hole in large quads: its loop would cross itself."""
    outer, hole = coast(40), 0.3 * coast(12)[::-1]
    for quads in (12, 20, 30, 60):
        try:
            result = of.compute_quad_mesh([outer, hole], quad_options=of.QuadMeshOptions(quads=quads))
        except of.GeometryError as error:
            assert error.kind == "crossing_quads"
        else:
            split = of.surface.split_quads(result.mesh)
            assert not of.surface.find_defects(split, closed=False)
            far = result.record.feature_deviation.curves > 0.02
            assert far == any("of the diagonal away from edges" in note for note in result.record.notes)


def test_an_odd_outline_has_one_segment_split():
    result = of.compute_quad_mesh([coast(41)], quad_options=of.QuadMeshOptions(keep_boundary=True))
    told = result.record.kept_boundary
    assert (told.segments, told.kept, told.split) == (41, 40, 1) and "1 segments were split" in result.record.notes[0]


def test_a_kept_boundary_sets_the_size_of_quads():
    square_of_four = [[(0, 0), (1, 0), (1, 1), (0, 1)]]
    result = of.compute_quad_mesh(square_of_four, quad_options=of.QuadMeshOptions(keep_boundary=True))
    assert result.record.quads < 10 and result.record.scaled_jacobian.min > 0.1


@pytest.mark.parametrize(
    "given, kind",
    [
        ({"field": np.tile([0, 0, 1.0], (49, 1))}, "not_tangent"),
        ({"field": np.ones((49, 3)), "quad_options": of.QuadMeshOptions(keep_boundary=True)}, "ignored_option"),
    ],
)
def test_fields_that_say_nothing_are_refused(given, kind):
    with pytest.raises(of.InvalidInput) as error:
        of.compute_quad_mesh(square(6), KEPT, **given)
    assert error.value.kind == kind


@pytest.mark.parametrize("scale", [1e80, 1e-80])
def test_units_that_no_number_can_be_squared_in_are_refused(scale):
    plate = square(3)
    with pytest.raises(of.InvalidInput) as error:
        made(of.TriangleMesh(np.asarray(plate.vertices) * scale, plate.triangles))
    assert error.value.kind == "size_out_of_range"
