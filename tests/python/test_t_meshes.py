"""Quads by whole numbers on the arcs of a motorcycle graph, also on surfaces with features."""

from collections import Counter

import numpy as np
import octafield as of
import pytest
from octafield.domain.generators import generate
from octafield.layout import t_mesh
from octafield.layout.causes import told_of_points
from octafield.layout.files import write_layout_result
from quad_mesh_checks import area_of, disk, four_points, irregular, require_conforming

KEPT = of.SurfaceFieldOptions(remesh=False)


def made(source, singularities=None, **wanted):
    return of.compute_quad_layout(
        source, KEPT, layout_options=of.QuadLayoutOptions(**wanted), singularities=singularities
    )


def cube(n=4):
    """The surface of the unit cube, 2 n^2 triangles a face."""
    points, triangles, number = [], [], {}

    def vertex(x):
        if x not in number:
            number[x] = len(points)
            points.append([c / n for c in x])
        return number[x]

    for axis in range(3):
        for end in (0, n):
            for i in range(n):
                for j in range(n):
                    corners = []
                    for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        at = [0, 0, 0]
                        at[axis], at[(axis + 1) % 3], at[(axis + 2) % 3] = end, a, b
                        corners.append(vertex(tuple(at)))
                    a, b, c, d = corners if end else corners[::-1]
                    triangles += [[a, b, c], [a, c, d]]
    return of.TriangleMesh(points, triangles)


def test_a_cube_is_followed_along_its_edges():
    result = made(cube(), quads=600)
    points = np.asarray(result.mesh.vertices)
    assert irregular(result.mesh, 2).keys() == set(np.flatnonzero(np.isin(points, (0, 1)).all(axis=1)).tolist())
    assert result.record.patches == 6 and result.record.quads == 600 and result.record.notes == []
    assert result.record.scaled_jacobian.min > 0.999 and result.record.surface_deviation.max < 1e-9
    assert result.record.t_joints == 0 and result.record.whole_numbers_optimal
    # Twelve sides of 11 vertices along the edges.
    on_edges = Counter(int(np.isin(side, (0, 1)).sum(axis=1).min()) for side in result.layout.sides)
    assert on_edges == {2: 12} and {len(side) for side in result.layout.sides} == {11}


@pytest.mark.parametrize("name, points, chi", [("disk", four_points(), 1), ("cube", None, 2), ("ball", None, 2)])
def test_blocks_make_up_a_layout(name, points, chi):
    source = {"disk": disk, "cube": cube}.get(name, lambda: generate(name))()
    result = made(source, points, quads=300)
    layout = result.layout
    assert len(layout.positions) - len(layout.sides) + result.record.patches == chi
    require_conforming(result.mesh, chi)
    assert layout.kinds.count("singular") == result.record.irregular_vertices
    for side, (first, last) in zip(layout.sides, layout.side_ends, strict=True):
        assert np.array_equal(side[0], layout.positions[first]) and np.array_equal(side[-1], layout.positions[last])
    # Each block has four corners, and all its quads are one grid.
    quads = np.asarray(result.mesh.quads)
    for block in range(result.record.patches):
        of_block = quads[result.blocks == block]
        count = Counter(of_block.ravel().tolist())
        assert sorted(count.values())[:4] == [1] * 4 and list(count.values()).count(1) == 4


def test_quads_of_one_row_of_blocks_have_its_chord():
    result, by_edge = made(cube(), quads=150), {}
    for quad, corners in enumerate(np.asarray(result.mesh.quads).tolist()):
        for k in range(4):
            edge = frozenset((corners[k], corners[(k + 1) % 4]))
            by_edge.setdefault(edge, set()).add(int(result.chords[quad, k % 2]))
    assert {len(chords) for chords in by_edge.values()} == {1}
    assert result.record.chords == 3


def test_a_torus_without_points_is_one_block(tmp_path):
    surface = of.surface
    u, v = np.meshgrid(np.arange(40), np.arange(20), indexing="ij")
    a, b = 2 * np.pi * u.ravel() / 40, 2 * np.pi * v.ravel() / 20
    points = np.column_stack([(1 + 0.5 * np.cos(b)) * np.cos(a), (1 + 0.5 * np.cos(b)) * np.sin(a), 0.5 * np.sin(b)])
    at = lambda i, j: 20 * (i % 40) + j % 20
    triangles = [
        t
        for i in range(40)
        for j in range(20)
        for t in ([at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)])
    ]
    field = surface.impose_singular_points(of.TriangleMesh(points, triangles), surface.SingularPattern())
    quads = surface.quantized_quads(surface.motorcycle_graph(field), quad_count=400)
    assert len(quads.patch_sizes) == 1 and len(quads.irregular) == 0 and irregular(quads.mesh, 0) == {}
    result = made(of.TriangleMesh(points, triangles), [], quads=400)
    write_layout_result(result, tmp_path)
    assert result.record.patches == 1 and (tmp_path / "layout.vtp").is_file()


def test_both_ways_have_the_same_irregular_vertices():
    places = []
    for layout in ("t-mesh", "separatrices"):
        result = made(disk(), four_points(), quads=200, layout=layout)
        vertices = np.asarray(result.mesh.vertices)
        places.append(sorted(map(tuple, vertices[sorted(irregular(result.mesh, 1))].round(9).tolist())))
        assert result.record.t_joints is None or layout == "t-mesh"
    assert places[0] == places[1] and len(places[0]) == 4


def test_bad_options_are_named():
    field = of.surface.impose_singular_points(disk(), of.surface.SingularPattern(
        [of.surface.imposed_point(disk(), p["position"], 1) for p in four_points()]))  # fmt: skip
    graph = of.surface.motorcycle_graph(field)
    for wrong in ({}, {"quad_count": -1}, {"edge_length": 0.1, "quad_count": 5}, {"edge_length": np.inf}):
        with pytest.raises(of.InvalidInput, match="quad_count|quad count|number of quads|edge_length|edge length"):
            of.surface.quantized_quads(graph, **wrong)
    with pytest.raises(of.InvalidInput, match="origins"):
        of.surface.quantized_quads(graph, quad_count=50, origins=np.arange(10**6))
    with pytest.raises(of.InvalidInput, match="did you mean 't-mesh'"):
        of.QuadLayoutOptions(layout="tmesh")
    with pytest.raises(of.InvalidInput, match="did you mean 'few'"):
        of.QuadLayoutOptions(blocks="fwe")
    for wrong in (-0.1, 1.5, np.nan):
        with pytest.raises(of.InvalidInput, match="least_jacobian|least scaled Jacobian"):
            of.surface.quantized_quads(graph, quad_count=50, least_jacobian=wrong)


def turned_hole(degrees):
    """A square of four quads round a square hole that is turned by an angle: no singular points, and no cross field
    that follows both, with nothing that could be moved."""
    ring = np.array([[np.cos(t), np.sin(t), 0] for t in np.pi / 4 + np.pi / 2 * np.arange(4)])
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    points = np.concatenate([2 * ring, 0.8 * ring @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])])
    sides = [(k, (k + 1) % 4) for k in range(4)]
    return of.TriangleMesh(points, [t for a, b in sides for t in ([a, b, b + 4], [a, b + 4, a + 4])])


def test_a_pattern_without_points_cannot_be_moved():
    plate = turned_hole(10)
    with pytest.raises(of.SolverError, match="no singular points inside that could be moved") as caught:
        of.surface.impose_singular_points(plate, of.surface.SingularPattern(), inadmissible="move")
    assert caught.value.kind == "move_failed"
    rotated = made(plate, [], quads=200, inadmissible="rotate")
    assert irregular(rotated.mesh, 0) == {} and area_of(rotated.mesh) == pytest.approx(8 - 2 * 0.8**2, 1e-9)


def refused(source, points=None, corners=None, **wanted):
    with pytest.raises(of.SolverError) as caught:
        of.compute_quad_layout(
            source, KEPT, layout_options=of.QuadLayoutOptions(**wanted), singularities=points, corners=corners
        )
    return str(caught.value)


def test_points_that_leave_a_quad_180_degrees_are_named():
    one = [{"position": [0.2, 0, 0], "valence": 1}, {"position": [-0.5, 0, 0], "valence": 3}]
    assert "1 quad in the 360 degrees at (0.2, 0, 0)" in refused(disk(), one, quads=200)
    assert "more quads must meet there" in refused(disk(), one, quads=200, layout="separatrices")
    square = of.TriangleMesh([[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]], [[0, 1, 4], [1, 3, 4], [1, 2, 3]])
    moved = [{"vertex": 1, "quads": 1}, {"vertex": 0, "quads": 2}]
    assert "1 quad in the 180 degrees at (1, 0, 0)" in refused(square, corners=moved, quads=100)


def test_a_map_that_folds_names_the_option_for_shorter_triangles():
    domain, options = of.surface.SurfaceDomain(disk()), of.QuadLayoutOptions()
    with pytest.raises(of.SolverError, match="folds; --triangle-length") as caught:
        with told_of_points(domain, of.surface.SingularPattern(), options):
            raise of.SolverError("folds", "folded_map", [3])
    assert (caught.value.kind, list(caught.value.elements)) == ("folded_map", [3])
    with pytest.raises(of.SolverError, match="^other$"):
        with told_of_points(domain, of.surface.SingularPattern(), options):
            raise of.SolverError("other", "no_integers")


def test_blocks_are_few_where_that_leaves_quads_good():
    few, fine = (made(generate("ball"), quads=600, blocks=blocks).record for blocks in ("few", "fine"))
    # Eight points of valence 3 are in 24 corners of blocks, four of each.
    assert few.fewest_patches == fine.fewest_patches == 6
    assert 6 <= few.patches <= 24 and few.patches < fine.patches / 4
    assert few.scaled_jacobian.min > 0.8 and few.options["blocks"] == "few"


def test_few_blocks_do_not_invert_quads():
    record = of.compute_quad_layout(generate("nut"), layout_options=of.QuadLayoutOptions(quads=300)).record
    assert record.inverted == 0 and record.scaled_jacobian.min > 0.3


@pytest.mark.parametrize(("name", "at_most"), [("s17c", 1), ("s08c", 1.5), ("i02c", 4)])
def test_tracks_that_run_side_by_side_become_one_where_few_blocks_are_wanted(shared_data, name, at_most):
    path = shared_data / "hexme" / f"{name}.vtk.gz"
    surface = of.prepare_mesh(path, KEPT, volume=False).surface
    result = made(path, quads=2000)
    require_conforming(result.mesh, len(surface.vertices) - len(surface.triangles) // 2)
    assert result.record.patches <= at_most * result.record.fewest_patches
    assert result.record.scaled_jacobian.min > 0.3 and result.record.surface_deviation.max < 0.03


def test_the_fewest_blocks_follow_from_the_quads_at_irregular_vertices():
    result = made(cube(), quads=150)
    counts = irregular(result.mesh, 2)
    assert sum(4 - index for index in counts.values()) == 24 and of.surface.fewest_blocks(result.mesh) == 6
    assert result.record.fewest_patches == result.record.patches == 6


def test_only_points_of_a_computed_field_may_move_in_smoothing(monkeypatch):
    seen, quantized = [], t_mesh._core.quantized_quads

    def watched(*arguments, **options):
        seen.append(options["release_points"])
        return quantized(*arguments, **options)

    monkeypatch.setattr(t_mesh._core, "quantized_quads", watched)
    made(disk(), four_points(), quads=100)
    made(disk(), quads=100)
    assert seen == [False, True]


def test_quads_far_from_the_number_wanted_or_from_the_surface_are_noted():
    few, enough = (made(generate("ball"), quads=n).record for n in (1, 600))
    assert [note for note in enough.notes if "apart" in note or "wanted" in note] == []
    assert few.quads > 1 and few.surface_deviation.max > 0.02
    assert any(note.startswith(f"{few.quads} quads, 1 wanted") for note in few.notes)
    assert any("% of the diagonal apart" in note for note in few.notes)


def test_corners_that_are_given_change_computed_points_to_fit():
    angles = np.arange(10) * np.pi / 5
    tips = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles]) * np.where(np.arange(10) % 2, 0.35, 1)[:, None]
    star = of.TriangleMesh([*tips.tolist(), [0, 0, 0]], [[10, i, (i + 1) % 10] for i in range(10)])

    def quads_at_tips(corners):
        mesh = of.compute_quad_layout(star, layout_options=of.QuadLayoutOptions(quads=200), corners=corners).mesh
        found, _ = require_conforming(mesh, 1)
        near = [np.linalg.norm(np.asarray(mesh.vertices) - tip, axis=1).argmin() for tip in tips[::2]]
        return [found[int(v)] for v in near]

    assert quads_at_tips([{"vertex": 0, "quads": 1}]) == [1, 1, 1, 1, 1]


def test_a_corner_of_two_quads_that_is_cut_is_noted():
    points, triangles = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]]
    plate, wanted = of.TriangleMesh(points, triangles), of.QuadLayoutOptions(quads=100)
    result = of.compute_quad_layout(plate, layout_options=wanted, corners=[{"vertex": 0, "quads": 2}])
    away = np.linalg.norm(np.asarray(result.mesh.vertices), axis=1).min()
    told = [note for note in result.record.notes if "corners of the boundary are no vertices" in note]
    assert len(told) == (away > 1e-6) and (not told or told[0].startswith("1 "))
    assert list(irregular(result.mesh, 1).values()) == [1]
    square = of.compute_quad_layout(plate, layout_options=wanted)
    assert square.record.notes == []


def test_a_corner_on_a_feature_is_refused():
    message = "is on a feature edge, where faces meet"
    with pytest.raises(of.InvalidInput, match=message) as caught:
        of.compute_quad_layout(cube(), KEPT, corners=[{"vertex": 0, "quads": 2}])
    assert caught.value.kind == "several_faces"


def test_a_map_of_the_whole_surface_has_whole_numbers_over_every_edge():
    mesh = disk()
    points = [of.surface.imposed_point(mesh, p["position"], 1) for p in four_points()]
    field = of.surface.impose_singular_points(mesh, of.surface.SingularPattern(points))
    layout = of.surface.motorcycle_graph(field)
    quads = of.surface.quantized_quads(layout, quad_count=150)
    grid = of.surface.integer_grid_map(layout, quads)
    places = grid.coordinates.reshape(-1, 3, 2)
    u, v = places[:, 1] - places[:, 0], places[:, 2] - places[:, 0]
    areas = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
    assert (areas > 0).all() and areas.sum() == pytest.approx(len(quads.mesh.quads))
    assert grid.largest_residual < 1e-9 and 1 <= grid.mean_distortion < 1.1
    at_points = np.isin(grid.triangles, grid.singular)
    assert len(grid.singular) == 4 and np.allclose(places[at_points], np.round(places[at_points]), atol=1e-12)
    with pytest.raises(of.InvalidInput) as caught:
        of.surface.integer_grid_map(layout, of.surface.QuantizedQuads())
    assert caught.value.kind == "bad_option"
    with pytest.raises(of.Cancelled):
        of.surface.integer_grid_map(layout, quads, progress=lambda phase, fraction, merit: False)
