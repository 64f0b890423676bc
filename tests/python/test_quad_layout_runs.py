"""From a mesh and singular points to block-structured quads with their figures, in Python."""

import json

import numpy as np
import octafield as of
import pytest
from octafield.layout.quality import figures_of, require_sound
from quad_mesh_checks import area_of, disk, four_points, irregular, require_conforming
from surface_fixtures import square
from test_imposed_fields import annulus, on_circle

KEPT = of.SurfaceFieldOptions(remesh=False)
QUADS = of.QuadLayoutOptions(quads=200)


def run(source, options=KEPT, quads=QUADS, **given):
    return of.compute_quad_layout(source, options, layout_options=quads, **given)


@pytest.fixture(scope="module")
def result():
    return run(disk(), singularities=four_points())


def test_the_quads_have_the_points_wanted_and_nothing_else_irregular(result):
    found = irregular(result.mesh, 1)
    places = np.asarray(result.mesh.vertices)[sorted(found)]
    wanted = np.array([p["position"] for p in four_points()])
    assert set(found.values()) == {1} and len(found) == 4
    assert np.linalg.norm(places[:, None] - wanted, axis=2).min(axis=0) == pytest.approx(0, abs=1e-9)
    assert area_of(result.mesh) == pytest.approx(np.pi, rel=0.03)
    assert np.allclose(np.linalg.norm(result.mesh.vertices[result.on_boundary], axis=1), 1, atol=0.01)


def test_the_record_says_what_is_in_the_arrays(result):
    record, mesh = result.record, result.mesh
    found, rim = require_conforming(mesh, 1)
    assert record.quads == len(mesh.quads) == len(result.blocks) == len(result.chords)
    assert (record.patches, record.chords) == (len(set(result.blocks)), len(set(result.chords.ravel()))) == (5, 3)
    assert record.irregular_vertices == 4 and record.irregular_boundary_vertices == 0
    assert record.inverted == record.nonconforming_edges == record.t_junctions == 0
    assert record.index_sum == record.euler_characteristic == 1 and record.misalignment == []
    assert sorted(rim) == np.flatnonzero(result.on_boundary).tolist()
    assert [found[v] for v in range(len(mesh.vertices))] == result.valences.tolist()
    assert record.scaled_jacobian.min == result.scaled_jacobians.min() > 0.5
    points = [(p.index_times_four, p.boundary) for p in record.singular_points]
    assert points == [(1, False)] * 4 and (record.point_source, record.corner_source) == ("given", "angle")
    assert record.inadmissible == "fail" and record.largest_move == 0
    assert 0 < record.surface_deviation.rms < record.surface_deviation.max < 0.02
    assert {"read", "impose", "trace", "map", "check"} <= set(record.wall_seconds)
    assert of.QuadLayoutOptions(**record.options) == QUADS
    assert of.SurfaceFieldOptions(**record.field_options) == KEPT


def test_chords_are_the_same_across_the_edge_of_two_blocks(result):
    """Quads that share an edge are in one row across it."""
    quads, by_edge = np.asarray(result.mesh.quads), {}
    for quad, corners in enumerate(quads.tolist()):
        for k in range(4):
            edge = frozenset((corners[k], corners[(k + 1) % 4]))
            by_edge.setdefault(edge, []).append(int(result.chords[quad, k % 2]))
    assert all(len(set(chords)) == 1 for chords in by_edge.values())
    assert sum(len(chords) == 2 for chords in by_edge.values()) > 300


def test_points_may_be_given_in_many_ways(result, tmp_path):
    mesh, points = disk(), four_points()
    at = [int(np.argmin(np.linalg.norm(mesh.vertices - p["position"], axis=1))) for p in points]
    assert np.allclose(mesh.vertices[at], [p["position"] for p in points])
    (tmp_path / "list.json").write_text(json.dumps(points))
    (tmp_path / "points.json").write_text(json.dumps({"points": [{"vertex": v, "valence": 3} for v in at]}))
    (tmp_path / "rows.csv").write_text("x, y, index\n0.5,0,0.25\n0,0.5,0.25\n\n-0.5,0,0.25\n0,-0.5,0.25\n")
    (tmp_path / "ids.CSV").write_text("vertex,index_times_four\n" + "".join(f"{v},1\n" for v in at))
    (tmp_path / "record.json").write_text(json.dumps(result.record.to_dict()))
    domain = of.surface.SurfaceDomain(mesh)
    pattern = of.surface.SingularPattern([of.surface.imposed_at_vertex(domain, v, 1) for v in at])
    ways = [
        tmp_path / "list.json", str(tmp_path / "points.json"), tmp_path / "rows.csv", tmp_path / "ids.CSV",
        tmp_path / "record.json", np.array([[*p["position"], p["index"]] for p in points]), {"points": points},
        [{"vertex": v, "valence": 3} for v in at],
    ]  # fmt: skip
    expected = result.mesh.vertices
    for given in ways:
        assert np.allclose(run(mesh, singularities=given).mesh.vertices, expected, atol=1e-9), given
    assert np.allclose(run(domain, singularities=pattern).mesh.vertices, expected, atol=1e-9)


def test_points_of_a_surface_field_are_taken_from_its_record(tmp_path):
    from octafield.runs.run_folder import write_surface_result

    mesh = square(8)
    write_surface_result(of.compute_surface_field(mesh, KEPT), tmp_path)
    found = run(mesh, singularities=tmp_path / "result.json")
    assert [(p.index_times_four, p.boundary) for p in found.record.singular_points] == [(1, True)] * 4
    assert found.record.patches == 1


def test_without_points_those_of_a_computed_field_are_taken():
    found = run(disk())
    assert found.record.point_source == "computed" and found.record.inadmissible == "move"
    assert sorted(irregular(found.mesh, 1).values()) == [1] * 4


def test_corners_may_have_other_numbers_of_quads_than_by_angle(tmp_path):
    """A sheared square has 1 and 2 quads by angle, and then needs two points."""
    skewed = square(6)
    vertices = skewed.vertices.copy()
    vertices[:, 0] += np.cos(0.75) * vertices[:, 1]
    vertices[:, 1] *= np.sin(0.75)
    skewed.vertices = vertices
    ends = [0, 6, 42, 48]
    (tmp_path / "corners.csv").write_text("vertex,quads\n" + "".join(f"{v},1\n" for v in ends))
    by_position = [{"position": vertices[v].tolist(), "quads": 1} for v in ends]
    for corners in ([[v, 1] for v in ends], tmp_path / "corners.csv", {"corners": by_position}):
        found = run(skewed, singularities=[], corners=corners)
        assert found.record.patches == 1 and [p.boundary for p in found.record.singular_points] == [True] * 4
    together = {"points": [], "corners": by_position}
    assert run(skewed, singularities=together).record.corner_source == "given"
    with pytest.raises(of.InvalidInput, match="2/4 too little"):
        run(skewed, singularities=[])


@pytest.mark.parametrize("name", ["quads", "valence"])
def test_a_point_of_the_boundary_has_two_quads_where_nothing_is_singular(name):
    inside = [{"position": p, "valence": 3} for p in ([0.3, 0.3, 0], [0.6, 0.7, 0])]
    found = run(square(10), singularities=[*inside, {"position": [0.5, 0, 0], name: 4}])
    points = {tuple(np.round(p.position, 9)): p for p in found.record.singular_points}
    assert points[0.5, 0, 0].index_times_four == -2 and points[0.5, 0, 0].boundary
    at = int(np.argmin(np.linalg.norm(found.mesh.vertices - [0.5, 0, 0], axis=1)))
    assert found.valences[at] == 4 and found.record.irregular_boundary_vertices == 5
    with pytest.raises(of.InvalidInput, match="has a number of quads but is not on the boundary"):
        run(square(10), singularities=[{"position": [0.5, 0.5, 0], "quads": 3}])


def test_remeshing_moves_corners_and_points_with_the_surface():
    """Vertices are those of the input."""
    mesh = square(10)
    middle = 5  # of the side y = 0
    points = [{"vertex": 3 * 11 + 3, "valence": 3}, {"vertex": 7 * 11 + 6, "valence": 3}]
    found = of.compute_quad_layout(
        mesh, of.SurfaceFieldOptions(edge_length=0.07), layout_options=QUADS,
        singularities=points, corners=[[middle, 4]],
    )  # fmt: skip
    fours = {tuple(np.round(p.position, 9)): p.index_times_four for p in found.record.singular_points}
    assert fours[0.5, 0, 0] == -2 and fours[0.3, 0.3, 0] == fours[0.6, 0.7, 0] == 1
    assert found.record.triangles != len(mesh.triangles)


def test_numbers_of_vertices_are_those_of_the_file_where_some_points_are_unused(tmp_path):
    import meshio

    mesh = disk()
    points = np.concatenate([[[9.0, 9, 9]], mesh.vertices])
    meshio.write(tmp_path / "shifted.vtk", meshio.Mesh(points, [("triangle", np.asarray(mesh.triangles) + 1)]))
    at = [int(np.argmin(np.linalg.norm(points - p["position"], axis=1))) for p in four_points()]
    found = run(tmp_path / "shifted.vtk", singularities=[{"vertex": v, "index": 0.25} for v in at])
    places = sorted(tuple(np.round(p.position, 9)) for p in found.record.singular_points)
    assert places == sorted(tuple(p["position"]) for p in four_points())
    with pytest.raises(of.InvalidInput, match="no vertex 0 at a triangle"):
        run(tmp_path / "shifted.vtk", singularities=[{"vertex": 0, "index": 1}])


def ring_points(delta):
    quarters = np.pi / 2 * np.arange(4)
    return [{"position": on_circle(0.6, 0.2 + q), "valence": 5} for q in quarters] + [
        {"position": on_circle(0.8, 0.2 + delta + q), "valence": 3} for q in quarters
    ]


def test_places_that_no_field_has_are_refused_moved_or_rotated_too_far():
    mesh, points = annulus(around=48, rings=8), ring_points(np.radians(10))
    with pytest.raises(of.InvalidInput, match="10.* degrees") as error:
        run(mesh, singularities=points)
    assert error.value.kind == "inadmissible_pattern"
    found = run(mesh, quads=of.QuadLayoutOptions(quads=300, inadmissible="move"), singularities=points)
    (condition,) = found.record.misalignment
    assert condition.boundary and abs(condition.angle_deg) < 1e-3 and 0.01 < found.record.largest_move < 0.1
    assert sorted(irregular(found.mesh, 0).values()) == [-1] * 4 + [1] * 4
    with pytest.raises(of.InvalidInput, match="inadmissible: move") as error:
        separatrices = of.QuadLayoutOptions(quads=300, inadmissible="rotate", layout="separatrices")
        run(mesh, quads=separatrices, singularities=points)
    assert error.value.kind == "rotated_field"
    with pytest.raises(of.GeometryError, match="no whole numbers fit") as error:
        run(mesh, quads=of.QuadLayoutOptions(quads=300, inadmissible="rotate", blocks="fine"), singularities=points)
    assert error.value.kind == "no_integers"
    # With few blocks tracks may become one, and numbers fit.
    found = run(mesh, quads=of.QuadLayoutOptions(quads=300, inadmissible="rotate"), singularities=points)
    assert sorted(irregular(found.mesh, 0).values()) == [-1] * 4 + [1] * 4
    assert found.record.patches <= 24 and found.record.scaled_jacobian.min > 0.8


@pytest.mark.parametrize("layout", ["t-mesh", "separatrices"])
def test_the_boundary_of_tets_with_a_note_where_edges_inside_are_not_followed(box, layout):
    found = of.compute_quad_layout(box, layout_options=of.QuadLayoutOptions(quads=150, layout=layout))
    assert found.record.input_kind == "tets" and found.record.patches == 6
    assert set(irregular(found.mesh, 2).values()) == {1}
    told = [note for note in found.record.notes if "feature edges inside the surface are not followed" in note]
    assert bool(told) == (layout == "separatrices")
    assert found.record.surface_deviation.max < 1e-4


def test_the_default_size_is_the_mean_edge_of_the_triangles():
    found = run(square(9), quads=of.QuadLayoutOptions())
    assert found.record.edge_length.target == of.surface.mean_edge_length(square(9))
    assert found.record.quads == 64  # 1 / 0.1137 rounded: 9; by two triangles' diagonals 8 or 9 on a side


def test_progress_can_cancel_and_names_the_phases():
    seen = []

    def stop(phase, fraction, merit):
        seen.append(phase)
        return phase != "trace"

    with pytest.raises(of.Cancelled):
        run(disk(), singularities=four_points(), progress=stop)
    assert seen[0] == "read" and seen[-1] == "trace" and "impose" in seen


def t_mesh(hanging):
    """Of the square: a column of one quad beside one of `hanging` + 1."""
    count = hanging + 1
    points = [[0, 0, 0], [0, 1, 0], *([0.5, j / count, 0] for j in range(count + 1)),
              *([1, j / count, 0] for j in range(count + 1))]  # fmt: skip
    a, b = 2, 3 + count
    return of.surface.QuadMesh(
        points, quads=[[0, a, a + count, 1], *([a + j, b + j, b + j + 1, a + j + 1] for j in range(count))]
    )


@pytest.mark.parametrize("hanging", [0, 1, 3])
def test_quads_that_do_not_match_are_counted_and_refused(hanging):
    plate = of.surface.SurfaceDomain(square(4))
    mesh = t_mesh(hanging)
    figures = figures_of(mesh, plate, plate.mesh)
    assert figures.t_junctions == hanging
    assert figures.nonconforming_edges == (hanging + 2 if hanging else 0)
    if hanging:
        with pytest.raises(of.SolverError) as error:
            require_sound(mesh, figures, 1)
        assert error.value.kind == "nonconforming"
    else:
        require_sound(mesh, figures, 1)
        assert figures.deviation[0] < 1e-9 and figures.jacobians.min == pytest.approx(1)


def test_a_mesh_that_lacks_a_part_is_refused():
    """Conforming, but not the surface: an edge that is open inside of it."""
    plate = of.surface.SurfaceDomain(square(4))
    half = of.surface.QuadMesh([[0, 0, 0], [0.5, 0, 0], [0.5, 1, 0], [0, 1, 0]], quads=[[0, 1, 2, 3]])
    figures = figures_of(half, plate, plate.mesh)
    assert figures.nonconforming_edges == 1 and figures.deviation[0] == pytest.approx(0.5 / 2**0.5, rel=1e-6)
    turned = of.surface.QuadMesh(t_mesh(0).vertices, quads=[t_mesh(0).quads[0], t_mesh(0).quads[1][::-1]])
    assert figures_of(turned, plate, plate.mesh).nonconforming_edges == 1


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"quads": -1}, "quads must be an integer"),
        ({"quads": 2.5}, "quads must be an integer"),
        ({"quads": 10**8}, "quads must be an integer"),
        ({"edge_length": np.nan}, "must be positive"),
        ({"edge_length": -1.0}, "must be positive"),
        ({"edge_length": 1.0, "quads": 5}, "leave it or the number of quads out"),
        ({"inadmissible": "mve"}, "did you mean 'move'"),
        ({"tolerance": 0.0}, "between 0 and 45 degrees"),
        ({"end_tolerance": -1.0}, "end tolerance must be positive"),
        ({"max_length": np.inf}, "max length must be positive"),
    ],
)
def test_options_out_of_range_are_refused(options, words):
    with pytest.raises(of.InvalidInput, match=words):
        of.QuadLayoutOptions(**options)


@pytest.mark.parametrize(
    ("given", "kind"),
    [
        ({"singularities": np.zeros((2, 3))}, "wrong_shape"),
        ({"singularities": [["a", "b", "c", "d"]]}, "wrong_type"),
        ({"singularities": {"places": []}}, "bad_points"),
        ({"singularities": of.surface.SingularPattern()}, "not_meshed"),
        ({"corners": [[0, 1, 2]]}, "wrong_shape"),
        ({"corners": {"points": []}}, "bad_points"),
        ({"options": of.SurfaceFieldOptions(symmetry=6)}, "wrong_symmetry"),
        ({"source": 3}, "wrong_type"),
    ],
)
def test_what_is_no_input_is_refused_with_its_kind(given, kind):
    with pytest.raises(of.InvalidInput) as error:
        run(**({"source": disk(3)} | given))
    assert error.value.kind == kind
