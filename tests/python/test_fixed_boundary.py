"""Quads that keep a boundary segment by segment: outlines from arrays and files, and what is made of them."""

import json

import numpy as np
import octafield as of
import pytest

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def divided(corners, length):
    corners = np.array(corners, float)
    return np.concatenate(
        [
            np.linspace(a, b, max(1, round(np.linalg.norm(b - a) / length)) + 1)[:-1]
            for a, b in zip(corners, np.roll(corners, -1, axis=0))
        ]
    )


def circle(radius, count, centre=(0, 0)):
    angle = 2 * np.pi * np.arange(count) / count
    return np.column_stack([np.cos(angle), np.sin(angle)]) * radius + centre


def edge_set(rows):
    return {frozenset(row) for row in np.asarray(rows).tolist()}


def require_kept(result, area):
    """The mesh against the outline, in numpy alone."""
    points, quads = np.asarray(result.mesh.vertices), np.asarray(result.mesh.quads)
    outline = result.outline
    assert (points[:, 2] == 0).all()
    assert np.array_equal(points[: len(outline.points), :2], outline.points)
    sides = np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)])
    keys, count = np.unique(np.sort(sides, axis=1), axis=0, return_counts=True)
    assert count.max() <= 2 and len(np.unique(sides, axis=0)) == len(sides)
    whole = not len(result.made.split)
    if whole:
        assert edge_set(keys[count == 1]) == edge_set(outline.loops)
        assert edge_set(outline.lines) <= edge_set(keys[count == 2])
    x, y = points[:, 0][quads], points[:, 1][quads]
    corners = [
        (x[:, (k + 1) % 4] - x[:, k]) * (y[:, k - 1] - y[:, k])
        - (y[:, (k + 1) % 4] - y[:, k]) * (x[:, k - 1] - x[:, k])
        for k in range(4)
    ]
    assert np.min(corners) > 0  # strictly convex
    found = sum((x[:, k - 1] * y[:, k] - x[:, k] * y[:, k - 1]).sum() for k in range(4)) / 2
    assert found == pytest.approx(area, rel=1e-9)
    figures = result.figures
    assert figures.inverted == figures.nonconforming_edges == 0
    assert figures.quads == len(quads)
    assert figures.kept_segments == figures.boundary_segments - figures.split_segments
    assert figures.angle[0] <= figures.sharpest + 1e-9


def test_templates_of_the_octagon_are_36():
    assert [len(of.surface.quad_templates(8, k)) for k in range(5)] == [2, 2, 4, 7, 21]
    assert of.surface.quad_templates(6, 1)[0].shape == (3, 4)
    with pytest.raises(of.InvalidInput, match="4, 6, 8 or 10"):
        of.surface.quad_templates(7, 0)


def test_a_square_is_its_grid_and_the_figures_say_so():
    result = of.compute_fixed_boundary_quads([divided(SQUARE, 0.1)])
    require_kept(result, 1)
    assert result.figures.quads == 100 and result.figures.irregular_vertices == {}
    assert result.figures.angle == pytest.approx((90, 90), abs=1e-6)
    assert result.figures.as_dict()["boundary_segments"] == 40


@pytest.mark.parametrize("turn", [0, 0.4, 1.1])
def test_holes_and_lines_are_kept_whatever_the_turn(turn):
    line = np.column_stack([np.linspace(-0.7, -0.45, 4), np.linspace(-0.1, 0.15, 4)])
    result = of.compute_fixed_boundary_quads(
        [circle(1, 60), circle(0.25, 16, (0.3, 0.2))], [line], rotation=turn, offset=(0.2, 0.6)
    )
    require_kept(result, 30 * np.sin(np.pi / 30) - 8 * 0.25**2 * np.sin(np.pi / 8))
    assert result.figures.scaled_jacobian.min > 0.3
    assert result.figures.boundary_segments == 60 + 16 + 3


def test_a_mesh_of_ones_own_stays_where_it_has_room():
    own = of.compute_fixed_boundary_quads([divided(SQUARE, 0.1)]).mesh
    result = of.compute_fixed_boundary_quads([circle(0.42, 26, (0.5, 0.5))], interior=own)
    require_kept(result, 13 * 0.42**2 * np.sin(np.pi / 13))
    assert result.figures.interior_quads > 10


def test_odd_loops_are_refused_or_split():
    with pytest.raises(of.GeometryError, match="odd number of segments") as caught:
        of.compute_fixed_boundary_quads([circle(1, 31)])
    assert caught.value.kind == "odd_boundary" and len(caught.value.elements) == 1
    one = of.compute_fixed_boundary_quads([circle(1, 31)], odd_loops="split_one")
    require_kept(one, 15.5 * np.sin(2 * np.pi / 31))
    assert one.figures.split_segments == 1 and one.figures.kept_segments == 30
    every = of.compute_fixed_boundary_quads([circle(1, 31)], odd_loops="split_all")
    assert len(every.made.boundary) == 62 and every.figures.kept_segments == 0


def test_segments_are_near_to_the_edge_length_or_it_is_said():
    with pytest.raises(of.GeometryError, match="resample") as caught:
        of.compute_fixed_boundary_quads([SQUARE], edge_length=0.2)
    assert caught.value.kind == "segment_length" and caught.value.elements == [0, 1, 2, 3]
    assert of.compute_fixed_boundary_quads([SQUARE], edge_length=0.2, spacing="accept").figures.kept_segments == 4
    made = of.compute_fixed_boundary_quads([SQUARE], edge_length=0.2, spacing="resample")
    require_kept(made, 1)
    assert made.figures.quads == 25


def test_resampling_keeps_corners_where_lines_meet_loops():
    loop = np.concatenate([divided(SQUARE, 0.01), [(0.001, 0.001)]])[:-1]
    outline = of.resampled_outline(of.planar_outline([loop], [[(0.5, 0), (0.5, 0.013), (0.5, 1)]]), 0.1)
    points = np.asarray(outline.points)
    ends = points[np.concatenate([outline.loops, outline.lines])]
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    assert lengths.min() > 0.06 and lengths.max() < 0.16
    for kept in [(0, 0), (0.5, 0), (0.5, 1)]:
        assert np.linalg.norm(points - kept, axis=1).min() == 0
    with pytest.raises(of.GeometryError) as caught:
        of.resampled_outline(of.planar_outline([circle(0.01, 12)]), 1)
    assert caught.value.kind == "lost_loop"


@pytest.mark.parametrize(
    "loops, lines, kind",
    [
        ([[(0, 0), (1, 1), (1, 0), (0, 1)]], [], "crossing"),
        ([[(0, 0), (1, 0), (1, 1), (1, 0), (0, 1)]], [], "repeated_point"),
        ([SQUARE, [(1, 1), (2, 1), (2, 2)]], [], "touching_loops"),
        ([SQUARE, [(0.2, 0), (0.8, 0), (0.5, 0.5)]], [], "crossing"),
        ([SQUARE], [[(0.5, 0.5), (2, 0.5)]], "crossing"),
        ([SQUARE], [[(2, 2), (3, 3)]], "outside_line"),
        ([SQUARE], [[(0.5, 0.5)]], "short_line"),
        ([SQUARE[:2]], [], "short_loop"),
        ([[(0, 0), (1, 0), (1, np.nan), (0, 1)]], [], "non_finite_vertex"),
        ([[(0, 0, 0), (1, 0, 0), (1, 1, 0)]], [], "wrong_shape"),
        ([["a", "b"]], [], "wrong_type"),
        ([], [], "empty"),
    ],
)
def test_bad_outlines_are_refused_by_kind(loops, lines, kind):
    with pytest.raises(of.Error) as caught:
        of.compute_fixed_boundary_quads(loops, lines, edge_length=0.7, spacing="accept")
    assert caught.value.kind == kind


@pytest.mark.parametrize(
    "wrong", [{"edge_length": -1}, {"edge_length": np.nan}, {"spacing": "x"}, {"clearance": 0.1}, {"rotation": np.inf}]
)
def test_bad_options_are_refused(wrong):
    with pytest.raises(of.InvalidInput):
        of.compute_fixed_boundary_quads([SQUARE], **wrong)


def closed(loop):
    rows = np.asarray(loop, float).tolist()
    return [*rows, rows[0]]


def test_geojson_gives_regions_lines_and_points(tmp_path):
    hole = circle(0.15, 8, (0.5, 0.5))[::-1]
    collection = {
        "type": "FeatureCollection",
        "features": [
            {
                "type": "Feature",
                "properties": None,
                "geometry": {"type": "Polygon", "coordinates": [closed(divided(SQUARE, 0.1)), closed(hole)]},
            },
            {
                "type": "Feature",
                "geometry": {
                    "type": "GeometryCollection",
                    "geometries": [
                        {"type": "LineString", "coordinates": [[0.1, 0.1, 7], [0.1, 0.2, 7], [0.1, 0.3, 7]]},
                        {"type": "MultiPoint", "coordinates": [[0.82, 0.83]]},
                        {"type": "MultiPolygon", "coordinates": [[closed(divided(SQUARE, 0.1) + (3, 0))]]},
                    ],
                },
            },
            {"type": "Feature", "geometry": None},
        ],
    }
    outline = of.outline_of_geojson(collection)
    assert (len(outline.loops), len(outline.lines), len(outline.points)) == (88, 2, 40 + 8 + 40 + 3 + 1)
    path = tmp_path / "area.geojson"
    path.write_text(json.dumps(collection))
    result = of.compute_fixed_boundary_quads(path, edge_length=0.1)
    require_kept(result, 2 - 4 * 0.15**2 * np.sin(np.pi / 4))
    assert result.figures.boundary_segments == 90


@pytest.mark.parametrize(
    "wrong",
    [
        {"type": "Polygon"},
        {"type": "Circle", "coordinates": []},
        {"type": "Polygon", "coordinates": [[1, 2]]},
        {"type": "FeatureCollection", "features": [3]},
        {"type": "Polygon", "coordinates": [[["a", 1]]]},
        {},
    ],
)
def test_what_is_no_geojson_is_refused(wrong):
    with pytest.raises(of.InvalidInput) as caught:
        of.outline_of_geojson(wrong)
    assert caught.value.kind == "bad_geojson"


POLY = """# a box with a hole, and a line from corner to hole
8 2 0 0
1 0 0
2 3 0   # comment
3 3 3
4 0 3
5 1 1
6 2 1
7 2 2
8 1 2
9 1
1 1 2 1
2 2 3 1
3 3 4 1
4 4 1 1
5 5 6 2
6 6 7 2
7 7 8 2
8 8 5 2
9 1 5 0
1
1 1.5 1.5
"""


def test_poly_files_tell_loops_by_their_holes(tmp_path):
    path = tmp_path / "box.poly"
    path.write_text(POLY)
    outline = of.read_outline(path)
    assert (len(outline.loops), len(outline.lines)) == (8, 1)
    require_kept(of.compute_fixed_boundary_quads(path, edge_length=1, spacing="resample"), 8)
    header, points, rest = POLY.partition("9 1\n")
    nodes = header.partition("\n")[2]
    (tmp_path / "split.node").write_text(nodes)
    (tmp_path / "split.poly").write_text("0 2 0 0\n" + points + rest)
    assert np.array_equal(of.read_outline(tmp_path / "split.poly").points, outline.points)


@pytest.mark.parametrize(
    "text",
    ["", "8 2 0", "x", "4 3 0 0", POLY[:200], POLY.replace("9 1 5 0", "9 1 55 0"), POLY.replace("2 3 0", "2 3 z")],
)
def test_damaged_poly_files_are_refused(tmp_path, text):
    path = tmp_path / "bad.poly"
    path.write_text(text)
    with pytest.raises(of.IoError) as caught:
        of.read_outline(path)
    assert caught.value.kind == "unreadable"


def test_unknown_and_absent_files_are_refused(tmp_path):
    (tmp_path / "area.shp").touch()
    with pytest.raises(of.InvalidInput) as caught:
        of.read_outline(tmp_path / "area.shp")
    assert caught.value.kind == "unknown_format"
    for name in ("none.poly", "none.geojson", "none.geo"):
        with pytest.raises(of.IoError):
            of.read_outline(tmp_path / name)
    (tmp_path / "broken.json").write_text("{")
    with pytest.raises(of.IoError):
        of.read_outline(tmp_path / "broken.json")


GEO = """
Point(1) = {0, 0, 0, 0.2}; Point(2) = {2, 0, 0, 0.2}; Point(3) = {2, 1, 0, 0.2}; Point(4) = {0, 1, 0, 0.2};
Point(5) = {1, 0, 0, 0.2}; Point(6) = {1, 1, 0, 0.2};
Line(1) = {1, 5}; Line(2) = {5, 6}; Line(3) = {6, 4}; Line(4) = {4, 1};
Line(5) = {5, 2}; Line(6) = {2, 3}; Line(7) = {3, 6};
Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {5, 6, 7, -2};
Plane Surface(1) = {1}; Plane Surface(2) = {2};
"""


def test_geo_files_are_read_by_gmsh(tmp_path):
    pytest.importorskip("gmsh")
    path = tmp_path / "plates.geo"
    path.write_text(GEO)
    outline = of.read_outline(path)
    assert (len(outline.loops), len(outline.lines)) == (30, 5)
    result = of.compute_fixed_boundary_quads(path, edge_length=0.2)
    require_kept(result, 2)
    assert result.figures.quads == 50
    path.write_text("Point(1) = {0, 0, 0}; Line(1) = {1, 7};")
    with pytest.raises(of.Error):
        of.read_outline(path)


def test_progress_is_told_and_may_cancel():
    phases = []
    of.compute_fixed_boundary_quads([circle(1, 40)], progress=lambda phase, fraction, merit: phases.append(phase))
    assert "forming quads anew" in phases
    with pytest.raises(of.Cancelled):
        of.compute_fixed_boundary_quads([circle(1, 40)], progress=lambda *_: False)
