"""Parts whose faces ask for numbers of quads that contradict one another: singular points change until they fit."""

import math

import numpy as np
import octafield as of
import pytest
from octafield.layout.made import _imposed
from octafield.layout.points.pattern import Pattern
from pipeline_fixtures import SHARED_TETS, shared
from quad_mesh_checks import irregular

KEPT = of.SurfaceFieldOptions(feature_angle=math.radians(30))

# A cube with a wedge cut out of one edge: of the two faces that the cut's slanted side ends on, a triangle and a
# pentagon with corners of 135 degrees, the triangle's points ask for a slanted edge shorter than its other two
# together, and the pentagon's for a longer one.
NOTCH = np.array(
    [[-5, -5, 10], [-5, -5, 0], [-5, 5, 10], [-5, 5, 0], [5, -5, 0], [5, -5, 10], [5, 5, 10], [1, 5, 0], [1, 5, 5],
     [5, 5, 5], [1, 0, 0], [5, 0, 0]]
) / 10  # fmt: skip
NOTCH_FACES = [
    ((-1, 0, 0), [0, 1, 3, 2]),
    ((0, -1, 0), [0, 1, 4, 5]),
    ((0, 0, 1), [0, 2, 6, 5]),
    ((0, 0, -1), [10, 11, 4, 1, 3, 7]),
    ((0, 1, 0), [8, 9, 6, 2, 3, 7]),
    ((1, 0, 0), [9, 11, 4, 5, 6]),
    ((1, 0, 0), [7, 8, 10]),
    ((0, 1, -1), [8, 9, 11, 10]),
]


def solid(points, faces):
    """Each face, of an outward normal, as a fan from its first vertex."""
    triangles = []
    for normal, loop in faces:
        for a, b in zip(loop[1:], loop[2:], strict=False):
            corners = points[[loop[0], a, b]]
            outside = np.dot(np.cross(corners[1] - corners[0], corners[2] - corners[0]), normal) > 0
            triangles.append([loop[0], a, b] if outside else [loop[0], b, a])
    return of.TriangleMesh(points, triangles)


def prism(sides):
    angles = 2 * math.pi * np.arange(sides) / sides
    points = np.array([[math.cos(a), math.sin(a), z] for z in (0, 1) for a in angles])
    faces = [((0, 0, -1), list(range(sides))), ((0, 0, 1), list(range(sides, 2 * sides)))]
    for i in range(sides):
        j = (i + 1) % sides
        middle = angles[i] + math.pi / sides
        faces.append(((math.cos(middle), math.sin(middle), 0), [i, j, sides + j, sides + i]))
    return solid(points, faces)


def made(part, quads=600, **wanted):
    return of.compute_quad_layout(part, KEPT, layout_options=of.QuadLayoutOptions(quads=quads, **wanted))


def parts_of(part):
    """Face by face: the surface cut open, and the points of the computed field there."""
    domain = of.surface.SurfaceDomain(part, of.surface.detect_features(part, angle=math.radians(30)))
    cut = of.surface.cut_along_features(domain)
    field = of.surface.direction_field(cut.domain, symmetry=4)
    pattern = of.surface.singular_pattern(field, of.surface.surface_singularities(field))
    return cut, of.surface.with_corner_quads(cut.domain, pattern, of.surface.finite_corner_quads(cut.domain, pattern))


def shortages(cut, pattern):
    field = of.surface.impose_singular_points(cut.domain, pattern, inadmissible="rotate")
    return np.asarray(of.surface.arc_shortages(of.surface.motorcycle_graph(field), cut.origins))


def test_a_cube_with_a_notch_gets_a_pair_of_points_in_one_face():
    assert made(solid(NOTCH, NOTCH_FACES), blocks="fine").record.scaled_jacobian.min > 0.6
    result = made(solid(NOTCH, NOTCH_FACES))
    assert result.record.scaled_jacobian.min > 0.5 and result.record.surface_deviation.max < 1e-9
    found = irregular(result.mesh, 2)
    assert sum(found.values()) == 8
    points = np.asarray(result.mesh.vertices)
    assert all((np.linalg.norm(points - corner, axis=1) < 1e-9).any() for corner in NOTCH)
    # The points of the computed field and the pair; the others are corners.
    _, pattern = parts_of(of.prepare_mesh(solid(NOTCH, NOTCH_FACES), KEPT, volume=False).surface)
    inside = [found[v] for v in found if np.linalg.norm(NOTCH - points[v], axis=1).min() > 1e-9]
    assert sorted(inside) == sorted([-1, 1, *(point.index_times_four for point in pattern.points)])
    assert [note for note in result.record.notes if "1 pair of valence 3 and 5 added" in note]


def test_changes_are_the_same_each_time_and_no_more_than_are_needed():
    mesh = of.prepare_mesh(solid(NOTCH, NOTCH_FACES), KEPT, volume=False).surface
    cut, pattern = parts_of(mesh)
    assert shortages(cut, pattern).sum() > 0
    first, second = (
        of.surface.fitted_pattern(cut.domain, pattern, cut.origins, edge_length=0.1, inadmissible="rotate")
        for _ in range(2)
    )
    assert first.before == pytest.approx(shortages(cut, pattern).sum()) and first.left == 0
    assert shortages(cut, first.pattern).sum() == 0
    assert len(first.changes) == 1 and len(first.pattern.points) == len(pattern.points) + 2
    assert [(p.triangle, p.weights.tolist()) for p in first.pattern.points] == [
        (p.triangle, p.weights.tolist()) for p in second.pattern.points
    ]
    assert {(c.vertex, c.quads) for c in first.pattern.corners} == {(c.vertex, c.quads) for c in pattern.corners}
    # What fits stays as it is.
    again = of.surface.fitted_pattern(cut.domain, first.pattern, cut.origins, edge_length=0.1, inadmissible="rotate")
    assert again.changes == [] and again.tried == 0 and len(again.pattern.points) == len(first.pattern.points)


@pytest.mark.parametrize("sides", [5, 7, 9, 11])
def test_prisms_over_polygons_of_odd_numbers_of_sides(sides):
    result = made(prism(sides))
    found = irregular(result.mesh, 2)
    assert sum(found.values()) == 8
    assert result.record.scaled_jacobian.min > 0.3 and result.record.surface_deviation.max < 1e-9
    corners = np.asarray(prism(sides).vertices)
    points = np.asarray(result.mesh.vertices)
    assert all((np.linalg.norm(points - corner, axis=1) < 1e-9).any() for corner in corners)


def test_separatrices_of_near_corners_that_would_cross_are_joined(shared_data):
    mesh = of.prepare_mesh(shared_data / "wild" / "knob.stl", KEPT, volume=False).surface
    cut, pattern = parts_of(mesh)
    field = of.surface.impose_singular_points(cut.domain, pattern, inadmissible="rotate")
    graph = of.surface.motorcycle_graph(field)
    assert {patch.kind for patch in graph.patches} == {"quad"}


def test_points_that_are_given_are_never_changed():
    points = [{"position": [0.0, 0.0, 0.0], "index_times_four": 8}]
    with pytest.raises(of.Error) as error:
        of.compute_quad_layout(
            solid(NOTCH, NOTCH_FACES), KEPT, layout_options=of.QuadLayoutOptions(quads=600), singularities=points
        )
    assert error.value.kind != "no_integers"


def test_origins_that_do_not_fit_are_refused():
    cut, pattern = parts_of(of.prepare_mesh(prism(4), KEPT, volume=False).surface)
    with pytest.raises(of.InvalidInput, match="origin"):
        of.surface.fitted_pattern(cut.domain, pattern, [0, 1], edge_length=0.1)
    with pytest.raises(of.InvalidInput):
        of.surface.fitted_pattern(cut.domain, pattern, cut.origins, edge_length=0.0)


def square_ring(turn, centre=0.0, n=10, layers=8):
    """A square with a square hole that is turned."""
    side = np.linspace(-1, 1, n, endpoint=False)
    edge = np.column_stack([side, -np.ones(n)])
    quarter = np.array([[0, 1], [-1, 0]])  # rows to the left
    loop = np.vstack([edge @ np.linalg.matrix_power(quarter, k) for k in range(4)])
    turned = 0.4 * loop @ np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
    rings = [loop + (turned - loop) * i / layers for i in range(layers + 1)]
    points = np.column_stack([np.vstack(rings), np.zeros((layers + 1) * 4 * n)]) + [centre, 0, 0]
    triangles = []
    for i in range(layers):
        for j in range(4 * n):
            a, b = 4 * n * i + j, 4 * n * i + (j + 1) % (4 * n)
            triangles += [[a, b, b + 4 * n], [a, b + 4 * n, a + 4 * n]]
    return of.TriangleMesh(points, triangles)


def test_a_face_whose_points_cannot_be_moved_leaves_the_others_alone():
    turn = math.radians(20)
    first, second = square_ring(turn), square_ring(turn, 5.0)
    both = of.TriangleMesh(
        np.vstack([first.vertices, second.vertices]),
        np.vstack([first.triangles, np.asarray(second.triangles) + len(first.vertices)]),
    )
    pair = [of.surface.imposed_point(both, [x, y, 0], four) for x, y, four in ((0.7, 0.1, 1), (-0.1, 0.72, -1))]
    pattern = of.surface.SingularPattern(pair)
    with pytest.raises(of.SolverError) as error:  # the second ring has no points that could move
        of.surface.impose_singular_points(both, pattern, inadmissible="move")
    assert error.value.kind == "move_failed"
    moved = of.surface.moved_by_faces(both, pattern)
    assert [point.index_times_four for point in moved.points] == [1, -1]
    assert all(point.triangle < len(first.triangles) for point in moved.points)
    # They are admissible in the first ring by itself, as it is told by a function that moves nothing.
    of.surface.impose_singular_points(first, of.surface.SingularPattern(moved.points), inadmissible="fail")
    with pytest.raises(of.Error):
        of.surface.impose_singular_points(first, pattern, inadmissible="fail")
    # What cannot be mended by moving is told.
    with pytest.raises(of.InvalidInput):
        of.surface.moved_by_faces(both, of.surface.SingularPattern(pair[:1]))


def test_layouts_move_points_face_by_face_and_tell_the_largest_move():
    """Of two rings that need it one has points that can move: the other's field is rotated."""
    turn = math.radians(20)
    first, second = square_ring(turn), square_ring(turn, 5.0)
    both = of.surface.SurfaceDomain(of.TriangleMesh(
        np.vstack([first.vertices, second.vertices]),
        np.vstack([np.asarray(second.triangles) + len(first.vertices), first.triangles]),
    ))  # fmt: skip
    pair = [of.surface.imposed_point(both, [x, y, 0], four) for x, y, four in ((0.7, 0.1, 1), (-0.1, 0.72, -1))]
    away = [of.surface.imposed_point(both, [5 + x, y, 0], four) for x, y, four in ((0.7, 0.1, 1), (-0.1, 0.72, -1))]
    pattern = Pattern(of.surface.SingularPattern([*pair, *away]), "computed", "default", [])
    field, found, way = _imposed(both, pattern, "move", of.QuadLayoutOptions(layout="t-mesh"), None)
    turned = [abs(condition.angle) for condition in field.conditions]
    assert way == "move" and max(turned) <= of.QuadLayoutOptions().tolerance
    # Faces come in the order of their triangles.
    assert [of.surface.imposed_position(both, point)[0] > 2 for point in found.pattern.points] == [
        True,
        True,
        False,
        False,
    ]
    moves = [
        np.linalg.norm(np.subtract(of.surface.imposed_position(both, a), of.surface.imposed_position(both, b)))
        for a, b in zip([*away, *pair], found.pattern.points, strict=True)
    ]
    assert math.isclose(field.largest_move, max(moves), abs_tol=1e-6) and min(moves) > 1e-3
    alone = Pattern(of.surface.SingularPattern(pair), "computed", "default", [])
    field, found, way = _imposed(both, alone, "move", of.QuadLayoutOptions(layout="t-mesh"), None)
    assert way == "rotate" and field.largest_move > 1e-3


def test_rows_too_narrow_at_a_needle_are_moved_all_at_once_with_the_singular_points():
    """One vertex after the other leaves a least scaled Jacobian of 0.01 there."""
    found = of.compute_quad_mesh(shared(SHARED_TETS / "i11c.vtk.gz"), quad_options=of.QuadMeshOptions(quads=1706))
    assert found.record.inverted == 0 and found.record.scaled_jacobian.min >= 0.3
