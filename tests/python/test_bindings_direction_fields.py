"""What a direction field can be asked to follow, its singular points, principal directions."""

import numpy as np
import octafield as of
import pytest
from surface_fixtures import at_angle, cylinder, square


@pytest.fixture(scope="module")
def flat():
    return square(8)


def angles_of(mesh, field):
    """Direction of the field at every edge of a mesh in the plane z = 0, modulo pi / 2."""
    along = np.diff(mesh.vertices[field.domain.edges], axis=1)[:, 0]
    return (np.angle(field.values) / field.symmetry + np.arctan2(along[:, 1], along[:, 0])) % (np.pi / 2)


def guide_at(mesh, angle, **more):
    return of.surface.DirectionGuide(np.tile(at_angle(angle), (len(mesh.triangles), 1)), **more)


@pytest.mark.parametrize("method", ["gl", "mbo", "eigen"])
def test_a_constant_guide_is_the_field_where_nothing_else_is_asked(flat, method):
    field = of.surface.direction_field(flat, method=method, boundary_alignment="none", guide=guide_at(flat, 0.3))
    np.testing.assert_allclose(angles_of(flat, field), 0.3, atol=1e-6)
    np.testing.assert_allclose(np.abs(field.values), 1, atol=1e-6)
    assert of.surface.surface_singularities(field).boundary_deviation == pytest.approx(0.3, abs=1e-6)


def test_the_guides_weights_and_length_count(flat):
    def largest(**more):
        field = of.surface.direction_field(flat, guide=guide_at(flat, 0.3, **more))
        angles = angles_of(flat, field)[(field.domain.edge_triangles >= 0).all(axis=1)]
        return np.minimum(angles, np.pi / 2 - angles).max()

    assert largest(length=1e-3) == pytest.approx(0.3, abs=1e-3)  # the square's sides hold the boundary only
    assert largest(length=1e-3, weights=np.zeros(len(flat.triangles))) == pytest.approx(0, abs=1e-6)
    assert largest(length=0.03) > largest(length=0.3)


def test_the_boundary_is_followed_as_strongly_as_asked(flat):
    deviation = {}
    for word in ("strong", "weak", "none"):
        field = of.surface.direction_field(
            flat, boundary_alignment=word, alignment_length=0.05, guide=guide_at(flat, 0.3, length=0.1)
        )
        deviation[word] = of.surface.surface_singularities(field).boundary_deviation
    assert deviation["strong"] == pytest.approx(0, abs=1e-12)
    assert deviation["none"] == pytest.approx(0.3, abs=1e-6) and 0.01 < deviation["weak"] < 0.29


def test_features_are_followed_on_request_only(box_surface, box_features):
    features = {tuple(e) for e in box_features.edges.tolist()}

    def on_features(**options):
        field = of.surface.direction_field(
            of.surface.SurfaceDomain(box_surface, box_features), method="eigen", seed=1, **options
        )
        return field.values[[tuple(e) in features for e in field.domain.edges.tolist()]]

    np.testing.assert_allclose(on_features(), 1)
    free = on_features(feature_alignment="none")
    assert np.abs(free - 1).max() > 1e-3
    np.testing.assert_array_equal(on_features(least_feature_angle=np.radians(100)), free)  # they bend by 90 degrees
    np.testing.assert_allclose(on_features(least_feature_angle=np.radians(80)), 1)


def test_edges_of_the_constraints_hold_the_direction_given(sphere):
    topology = of.surface.edge_topology(sphere)
    edge = topology.edges[100]
    along = np.diff(sphere.vertices[edge], axis=0)[0]
    normal = of.surface.triangle_normals(sphere)[topology.edge_triangles[100]].sum(axis=0)
    along, normal = along / np.linalg.norm(along), normal / np.linalg.norm(normal)
    direction = np.cos(0.2) * along + np.sin(0.2) * np.cross(normal, along)
    for given in (edge, edge[::-1]):
        asked = of.surface.DirectionConstraints([given], [5 * direction + normal])
        field = of.surface.direction_field(sphere, constraints=asked)
        assert field.values[100] == pytest.approx(np.exp(0.8j), abs=1e-12)
    loose = of.surface.direction_field(sphere, constraints=of.surface.DirectionConstraints([edge], [direction], [1e-3]))
    assert 1e-6 < abs(loose.values[100] - np.exp(0.8j))


def test_vertices_of_the_constraints_turn_the_edges_around_them(flat):
    middle = int(np.argmin(np.linalg.norm(flat.vertices - [0.5, 0.5, 0], axis=1)))
    asked = of.surface.DirectionConstraints(
        vertices=[middle], vertex_directions=[at_angle(0.3)], vertex_weights=[np.inf]
    )
    field = of.surface.direction_field(flat, constraints=asked)
    here = (field.domain.edges == middle).any(axis=1)
    assert here.sum() == 6
    np.testing.assert_allclose(angles_of(flat, field)[here], 0.3)


def test_one_coherence_length_per_edge_overrides_the_common_one(sphere):
    count = len(of.surface.edge_topology(sphere).edges)
    common = of.surface.direction_field(sphere, epsilon=0.15)
    same = of.surface.direction_field(sphere, epsilon=9.0, edge_epsilon=np.full(count, 0.15))
    assert same.epsilon == common.epsilon == 0.15 and same.energy == pytest.approx(common.energy, rel=1e-6)
    graded = of.surface.direction_field(sphere, edge_epsilon=np.linspace(0.1, 0.2, count))
    assert graded.epsilon == 0.1 and graded.energy != common.energy


@pytest.mark.parametrize("method", ["gl", "mbo", "eigen"])
def test_the_square_has_no_singular_point_and_its_corners_make_the_characteristic(flat, method):
    found = of.surface.surface_singularities(of.surface.direction_field(flat, method=method))
    assert found.euler_characteristic == 1 and found.agree and found.index_sum == pytest.approx(1)
    assert all(p.boundary and p.index_times_symmetry == 1 for p in found.points) and len(found.points) == 4


def test_indices_that_contradict_the_surface_are_seen(flat):
    field = of.surface.direction_field(flat)
    values = field.values.copy()
    values[np.flatnonzero((field.domain.edge_triangles >= 0).all(axis=1))[40]] *= -1
    found = of.surface.surface_singularities(of.surface.DirectionField(4, field.domain, values))
    assert found.index_sum == pytest.approx(1) and found.agree  # of any field: Poincare and Hopf


def test_principal_directions_of_a_cylinder_run_round_it():
    mesh = cylinder(radius=2.0, height=3.0, around=48, along=12)
    found = of.surface.principal_directions(mesh)
    inside = np.abs(mesh.vertices[mesh.triangles].mean(axis=1)[:, 2] - 1.5) < 1
    np.testing.assert_allclose(found.curvatures[inside], np.tile([0.5, 0], (inside.sum(), 1)), atol=0.01)
    np.testing.assert_allclose(found.directions[:, 2], 0, atol=0.01)
    np.testing.assert_allclose(np.linalg.norm(found.directions, axis=1), 1)
    assert found.anisotropy.min() > 0.5
    guide = of.surface.DirectionGuide(found.directions, found.anisotropy, 0.1)
    field = of.surface.direction_field(mesh, boundary_alignment="none", symmetry=2, guide=guide)
    np.testing.assert_allclose(of.surface.triangle_directions(field)[:, 2], 0, atol=0.02)


def test_principal_directions_do_not_reach_across_features(box_surface, box_features):
    domain = of.surface.SurfaceDomain(box_surface, box_features)
    assert np.abs(of.surface.principal_directions(domain).curvatures).max() < 1e-9
    assert np.abs(of.surface.principal_directions(box_surface).curvatures).max() > 1
    with pytest.raises(of.InvalidInput, match="features"):
        of.surface.SurfaceDomain(box_surface, of.FeatureGraph([[0, 10**6]]))


def test_constraints_and_guides_that_do_not_fit_are_refused(flat):
    count = len(flat.triangles)
    x = [1.0, 0, 0]
    edge = of.surface.edge_topology(flat).edges[50]
    bad = [
        ("edges", of.surface.DirectionConstraints([[0, len(flat.vertices) - 1]], [x])),
        ("edges", of.surface.DirectionConstraints([[0, 10**9]], [x])),
        ("vertices", of.surface.DirectionConstraints(vertices=[-1], vertex_directions=[x])),
        ("edge_directions", of.surface.DirectionConstraints([edge])),
        ("edge_directions", of.surface.DirectionConstraints([edge], [[np.nan, 0, 0]])),
        ("vertex_directions", of.surface.DirectionConstraints(vertices=[3, 4], vertex_directions=[x])),
        ("edge_weights", of.surface.DirectionConstraints([edge], [x], [0.0])),
        ("edge_weights", of.surface.DirectionConstraints([edge], [x], [np.nan])),
        ("vertex_weights", of.surface.DirectionConstraints(vertices=[3], vertex_directions=[x], vertex_weights=[1, 2])),
        ("direction", of.surface.DirectionConstraints([edge], [[0, 0, 1.0]])),
    ]
    for name, constraints in bad:
        with pytest.raises(of.InvalidInput, match=name):
            of.surface.direction_field(flat, constraints=constraints)
    for guide in (
        of.surface.DirectionGuide([x]),
        of.surface.DirectionGuide(np.zeros((count, 3))),
        guide_at(flat, 0.3, length=-1.0),
        guide_at(flat, 0.3, length=np.inf),
        guide_at(flat, np.nan),
        guide_at(flat, 0.3, weights=[1.0]),
        guide_at(flat, 0.3, weights=np.full(count, -1.0)),
        guide_at(flat, 0.3, weights=np.full(count, np.nan)),
    ):
        with pytest.raises(of.InvalidInput, match="guide"):
            of.surface.direction_field(flat, guide=guide)


@pytest.mark.parametrize("options", [
    {"boundary_alignment": "firm"}, {"feature_alignment": "firm"}, {"alignment_length": -1.0},
    {"alignment_length": np.nan}, {"least_feature_angle": -0.1}, {"corner_tolerance": 1.5},
    {"first_epsilon": -1.0}, {"first_epsilon": np.inf},
    {"edge_epsilon": [0.1]}, {"edge_epsilon": "wide"}])  # fmt: skip
def test_options_out_of_range_are_refused(flat, options):
    with pytest.raises(of.InvalidInput, match=next(iter(options))):
        of.surface.direction_field(flat, **options)
    with pytest.raises(TypeError):
        of.surface.direction_field(flat, constraints=[[0, 1]])
