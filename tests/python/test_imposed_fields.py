"""Cross fields with imposed singular points, and the patterns of such points."""

import numpy as np
import octafield as of
import pytest
from surface_fixtures import square

surface = of.surface


def annulus(inner=0.4, around=64, rings=10):
    """Between circles of radius inner and 1, in the plane."""
    radii = np.geomspace(inner, 1, rings + 1)[:, None]
    angles = 2 * np.pi * (np.arange(around) + 0.5 * (np.arange(rings + 1) % 2)[:, None]) / around
    vertices = np.stack([radii * np.cos(angles), radii * np.sin(angles), 0 * angles], axis=-1).reshape(-1, 3)
    triangles = []
    for j in range(rings):
        for i in range(around):
            a, b, right = j * around, (j + 1) * around, (i + 1) % around
            if j % 2 == 0:
                triangles += [[a + i, b + i, a + right], [b + i, b + right, a + right]]
            else:
                triangles += [[a + i, b + i, b + right], [a + i, b + right, a + right]]
    return of.TriangleMesh(vertices, triangles)


def on_circle(radius, angle):
    return [radius * np.cos(angle), radius * np.sin(angle), 0]


def two_rings(domain, delta):
    """Valence 5 on one circle and valence 3 on a wider one, turned by delta."""
    quarters = np.pi / 2 * np.arange(4)
    return surface.SingularPattern(
        [surface.imposed_point(domain, on_circle(0.6, 0.2 + q), -1) for q in quarters]
        + [surface.imposed_point(domain, on_circle(0.8, 0.2 + delta + q), 1) for q in quarters]
    )


@pytest.fixture(scope="module")
def ring():
    return surface.SurfaceDomain(annulus())


def test_the_points_imposed_are_those_found(sphere):
    places = np.random.default_rng(2).normal(size=(6, 3))
    places /= np.linalg.norm(places, axis=1)[:, None]
    pattern = surface.SingularPattern(
        [surface.imposed_point(sphere, place, t) for place, t in zip(places, [3, 2, 2, 1, 1, -1], strict=True)]
    )
    made = surface.impose_singular_points(sphere, pattern)
    found = surface.surface_singularities(made.field)
    assert found.agree and made.closure < 1e-9 and made.conditions == []
    expected = dict(zip(made.point_vertices.tolist(), [3, 2, 2, 1, 1, -1], strict=True))
    at = made.field.domain.mesh.vertices
    nearest = [int(np.argmin(np.linalg.norm(at - p.position, axis=1))) for p in found.points]
    assert dict(zip(nearest, [p.index_times_symmetry for p in found.points], strict=True)) == expected


def test_the_refined_surface_is_told_in_the_input(ring):
    made = surface.impose_singular_points(ring, two_rings(ring, 0))
    fine, mesh = made.field.domain.mesh, ring.mesh
    np.testing.assert_array_equal(fine.vertices[: len(mesh.vertices)], mesh.vertices)
    corners = mesh.vertices[mesh.triangles[made.vertex_triangles]]
    np.testing.assert_allclose(np.einsum("vk,vkx->vx", made.vertex_weights, corners), fine.vertices, atol=1e-12)
    areas = np.bincount(made.triangle_origins, surface.triangle_areas(fine))
    np.testing.assert_allclose(areas, surface.triangle_areas(mesh), rtol=1e-9)
    assert len(made.log_size) == len(fine.vertices) and np.isfinite(made.log_size).all()


def test_inadmissible_patterns_are_refused_moved_or_rotated(ring):
    pattern = two_rings(ring, np.radians(10))
    with pytest.raises(of.InvalidInput, match="degrees") as error:
        surface.impose_singular_points(ring, pattern)
    assert error.value.kind == "inadmissible_pattern" and error.value.elements == [0]
    rotated = surface.impose_singular_points(ring, pattern, inadmissible="rotate")
    (condition,) = rotated.conditions
    assert condition.boundary and abs(condition.angle) == pytest.approx(np.radians(10), abs=1e-3)
    expected = np.exp(np.radians(10) * 2 * np.pi / np.log(1 / 0.4))
    assert condition.size_factor == pytest.approx(expected, rel=5e-3)
    moved = surface.impose_singular_points(ring, pattern, inadmissible="move")
    assert abs(moved.conditions[0].angle) < 1e-6 and moved.steps > 0 and moved.largest_move < 0.1
    before = [surface.imposed_position(ring, p) for p in pattern.points]
    after = [surface.imposed_position(ring, p) for p in moved.pattern.points]
    moves = np.linalg.norm(np.subtract(after, before), axis=1)
    assert 0.01 < moves.max() <= moved.largest_move + 1e-12
    for made in rotated, moved:
        assert surface.surface_singularities(made.field).boundary_deviation < 1e-9


def test_patterns_of_computed_fields_can_be_edited(ring):
    plate = surface.SurfaceDomain(square(12))
    field = surface.direction_field(plate)
    pattern = surface.singular_pattern(field, surface.surface_singularities(field))
    assert pattern.points == [] and [c.quads for c in pattern.corners] == [1, 1, 1, 1]
    pattern = surface.add_singular_pair(plate, pattern, [0.3, 0.3, 0], [0.7, 0.6, 0])
    pattern = surface.move_singular_point(plate, pattern, 1, [0.6, 0.6, 0])
    np.testing.assert_allclose(surface.imposed_position(plate, pattern.points[1]), [0.6, 0.6, 0])
    assert surface.surface_singularities(surface.impose_singular_points(plate, pattern).field).agree
    assert surface.merge_singular_points(plate, pattern, [0, 1], [0.5, 0.5, 0]).points == []
    one = surface.remove_singular_points(pattern, [0])
    with pytest.raises(of.InvalidInput, match="1/4 too little") as error:
        surface.impose_singular_points(plate, one)
    assert error.value.kind == "index_sum"


def test_corners_by_angle_and_with_the_fewest_points():
    skewed = square(6)
    vertices = skewed.vertices.copy()
    vertices[:, 0] += np.cos(0.5) * vertices[:, 1]
    vertices[:, 1] *= np.sin(0.5)
    skewed.vertices = vertices
    assert [c.quads for c in surface.default_corner_quads(skewed)] == [1, 1]
    choice = surface.fewest_points_corner_quads(skewed)
    assert choice.inner_index_before.tolist() == [2] and choice.inner_index.tolist() == [0]
    made = surface.impose_singular_points(skewed, surface.SingularPattern(corners=choice.corners))
    assert {c.quads for c in made.pattern.corners} == {1}


@pytest.mark.parametrize(
    ("call", "kind"),
    [
        (lambda d: surface.imposed_point(d, [5, 0, 0], 1), "outside_surface"),
        (lambda d: surface.imposed_point(d, [np.nan, 0, 0], 1), "not_finite"),
        (lambda d: surface.imposed_at_vertex(d, -3, 1), "outside_surface"),
        (lambda d: surface.imposed_position(d, surface.ImposedPoint(10**6)), "outside_surface"),
        (lambda d: surface.impose_singular_points(d, two_rings(d, 0), inadmissible="bend"), "unknown_word"),
        (lambda d: surface.impose_singular_points(d, two_rings(d, 0), tolerance=np.nan), "non_finite"),
        (lambda d: surface.impose_singular_points(d, two_rings(d, 0), sectors=2), "bad_option"),
        (
            lambda d: surface.impose_singular_points(d, surface.SingularPattern(corners=[surface.CornerQuads(200, 1)])),
            "not_on_boundary",
        ),
        (lambda d: surface.remove_singular_points(surface.SingularPattern(), [0]), "index_out_of_range"),
    ],
)
def test_bad_input_is_refused_with_its_kind(ring, call, kind):
    with pytest.raises(of.InvalidInput) as error:
        call(ring)
    assert error.value.kind == kind


def test_progress_can_cancel(ring):
    with pytest.raises(of.Cancelled):
        surface.impose_singular_points(ring, two_rings(ring, 0), progress=lambda *_: False)
