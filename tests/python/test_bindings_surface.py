"""Functions on triangle meshes."""

import gc
import pickle

import numpy as np
import octafield as of
import pytest


def edges_of(mesh):
    t = np.asarray(mesh.triangles)
    return np.unique(np.sort(np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]), axis=1), axis=0)


@pytest.fixture(scope="module")
def box_field(box_surface, box_features):
    return of.surface.direction_field(of.surface.SurfaceDomain(box_surface, box_features))


def test_the_cube_has_its_volume_area_and_characteristic(box_surface):
    assert of.surface.signed_volume(box_surface) == pytest.approx(1)
    assert of.surface.triangle_areas(box_surface).sum() == pytest.approx(6)
    assert of.surface.euler_characteristic(box_surface) == 2
    assert of.surface.bounding_box_diagonal(box_surface.vertices) == pytest.approx(3**0.5)


def test_edges_are_those_found_with_numpy(box_surface):
    topology = of.surface.edge_topology(box_surface)
    np.testing.assert_array_equal(topology.edges, edges_of(box_surface))
    assert of.surface.mean_edge_length(box_surface) == pytest.approx(
        np.linalg.norm(np.diff(box_surface.vertices[topology.edges], axis=1), axis=2).mean()
    )
    for k in range(3):
        ends = np.sort(box_surface.triangles[:, [k, (k + 1) % 3]], axis=1)
        np.testing.assert_array_equal(topology.edges[topology.triangle_edges[:, k]], ends)
    assert (topology.edge_triangles >= 0).all()


def test_normals_of_the_sphere_point_outward(sphere):
    assert (np.sum(of.surface.vertex_normals(sphere) * sphere.vertices, axis=1) > 0.99).all()
    centroids = sphere.vertices[sphere.triangles].mean(axis=1)
    normals = of.surface.triangle_normals(sphere)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1)
    assert (np.sum(normals * centroids, axis=1) > 0.9).all()


@pytest.mark.parametrize("suffix", [".off", ".obj", ".ply", ".stl"])
def test_files_give_back_what_was_written(box_surface, tmp_path, suffix):
    path = tmp_path / ("box" + suffix)
    of.write_surface(box_surface, path)
    for spelling in (path, str(path)):
        again = of.read_surface(spelling)
        assert len(again.triangles) == len(box_surface.triangles)
        assert of.surface.signed_volume(again) == pytest.approx(1, rel=1e-6)
    if suffix != ".stl":
        np.testing.assert_array_equal(again.triangles, box_surface.triangles)


def test_shared_surfaces_are_read(shared_data):
    mesh = of.read_surface(shared_data / "surfaces" / "s01_surface.stl")
    assert (
        repr(mesh).startswith("TriangleMesh(208 vertices, 412 triangles, box ") and of.surface.find_defects(mesh) == []
    )


def test_a_missing_file_is_an_os_error(tmp_path, box_surface):
    with pytest.raises(of.IoError, match="absent.stl") as caught:
        of.read_surface(tmp_path / "absent.stl")
    assert isinstance(caught.value, OSError) and isinstance(caught.value, of.Error)
    with pytest.raises(of.IoError):
        of.write_surface(box_surface, tmp_path / "no_such_folder" / "box.off")


def test_a_hole_is_found_and_filled(box_surface):
    open_mesh = of.TriangleMesh(box_surface.vertices, box_surface.triangles[1:])
    defects = of.surface.find_defects(open_mesh)
    assert [d.kind for d in defects] == ["not_closed"] and defects[0].element == "edge"
    assert set(defects[0].elements) == set(box_surface.triangles[0]) and defects[0].elements.dtype == np.int32
    assert of.surface.find_defects(open_mesh, closed=False) == []
    with pytest.raises(of.GeometryError) as caught:
        of.require_valid(open_mesh)
    assert caught.value.kind == "not_closed" and caught.value.elements == list(defects[0].elements)
    of.require_valid(open_mesh, closed=False)
    result = of.surface.repair(open_mesh)
    assert of.surface.find_defects(result.mesh) == [] and len(result.actions) == 1
    assert of.surface.signed_volume(result.mesh) == pytest.approx(1)
    assert of.surface.find_defects(of.surface.repair(open_mesh, closed=False).mesh) != []


def test_broken_arrays_are_named_as_defects_and_nothing_crashes():
    assert [d.kind for d in of.surface.find_defects(of.TriangleMesh())] == ["empty"]
    wild = of.TriangleMesh(np.eye(3), [[0, 1, 10**9], [0, 1, 2]])
    assert of.surface.find_defects(wild)[0].kind == "index_out_of_range" and list(
        of.surface.find_defects(wild)[0].elements
    ) == [0]
    lost = of.TriangleMesh([[0, 0, np.nan], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    assert of.surface.find_defects(lost)[0].kind == "non_finite_vertex"


def test_features_of_the_cube_are_its_edges(box_surface, box_features):
    detected = of.surface.detect_features(box_surface)
    np.testing.assert_array_equal(detected.edges, box_features.edges)
    np.testing.assert_array_equal(detected.corners, box_features.corners)
    assert len(of.surface.detect_features(box_surface, angle=np.radians(100)).edges) == 0
    given = of.surface.feature_graph(box_surface, box_features.edges[::-1, ::-1])
    np.testing.assert_array_equal(given.edges, box_features.edges)
    np.testing.assert_array_equal(given.corners, box_features.corners)


def test_remeshing_keeps_shape_and_corners(box_surface, box_features):
    phases = []
    result = of.surface.remesh(
        box_surface, box_features, edge_length=0.3, progress=lambda *report: phases.append(report)
    )
    assert of.surface.find_defects(result.mesh) == [] and of.surface.signed_volume(result.mesh) == pytest.approx(1)
    corners = result.mesh.vertices[result.features.corners]
    assert sorted(map(tuple, corners)) == sorted(map(tuple, box_surface.vertices[box_features.corners]))
    assert of.surface.mean_edge_length(result.mesh) == pytest.approx(0.3, rel=0.3)
    assert phases and all(isinstance(p, str) and f <= 1 for p, f, _ in phases)


def test_cross_field_of_the_cube_has_eight_corners(box_surface, box_features, box_field):
    assert box_field.symmetry == 4 and box_field.converged and box_field.values.dtype == np.complex128
    np.testing.assert_array_equal(box_field.domain.edges, edges_of(box_surface))
    found = of.surface.surface_singularities(box_field)
    assert found.index_sum == pytest.approx(2) and found.euler_characteristic == 2 and found.agree
    assert [p.index_times_symmetry for p in found.points] == [1] * 8 and found.boundary_deviation == 0
    features = {tuple(e) for e in box_features.edges.tolist()}
    on_features = [tuple(e) in features for e in box_field.domain.edges.tolist()]
    np.testing.assert_allclose(box_field.values[on_features], 1)


def test_directions_are_unit_tangents(box_surface, box_features, box_field):
    per_triangle = of.surface.triangle_directions(box_field)
    np.testing.assert_allclose(np.linalg.norm(per_triangle, axis=1), 1)
    np.testing.assert_allclose(np.sum(per_triangle * of.surface.triangle_normals(box_surface), axis=1), 0, atol=1e-12)
    per_vertex = of.surface.vertex_directions(box_field)
    np.testing.assert_allclose(np.linalg.norm(per_vertex, axis=1), 1)
    np.testing.assert_allclose(np.sum(per_vertex * of.surface.vertex_normals(box_surface), axis=1), 0, atol=1e-12)


@pytest.mark.parametrize("symmetry, method", [(4, "eigen"), (6, "eigen"), (4, "gl"), (6, "mbo"), (1, "mbo")])
def test_indices_on_the_sphere_add_up_to_two(sphere, symmetry, method):
    field = of.surface.direction_field(sphere, symmetry=symmetry, method=method, seed=3)
    found = of.surface.surface_singularities(field)
    assert sum(p.index for p in found.points) == pytest.approx(2) and found.agree
    again = of.surface.direction_field(sphere, symmetry=symmetry, method=method, seed=3)
    assert again.values.tobytes() == field.values.tobytes()


def test_features_may_be_given_in_any_order(box_surface, box_features, box_field):
    shuffled = of.FeatureGraph(
        np.concatenate([box_features.edges[::-1, ::-1], box_features.edges[:3]]), box_features.corners[::-1]
    )
    assert (
        of.surface.direction_field(of.surface.SurfaceDomain(box_surface, shuffled)).values.tobytes()
        == box_field.values.tobytes()
    )


def test_stopping_a_field_keeps_the_best_state(sphere):
    field = of.surface.direction_field(sphere, progress=lambda phase, fraction, merit: False)
    assert not field.converged and np.isfinite(field.values).all()


WILD = of.TriangleMesh(np.eye(3), [[0, 1, 10**9]])
LOST = of.TriangleMesh([[0, 0, np.inf], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
NONE = of.FeatureGraph()
ON_MESH = [
    of.surface.edge_topology,
    of.surface.signed_volume,
    of.surface.triangle_areas,
    of.surface.triangle_normals,
    of.surface.vertex_normals,
    of.surface.mean_edge_length,
    of.surface.euler_characteristic,
    of.surface.repair,
    of.surface.detect_features,
    of.volume.tetrahedralize,
    lambda m: of.surface.feature_graph(m, []),
    lambda m: of.surface.remesh(m, NONE),
    of.surface.SurfaceDomain,
    of.surface.direction_field,
    lambda m: of.write_surface(m, "never.off"),
    of.surface.principal_directions,
    lambda m: of.volume.write_surface_field("never.vtp", m, np.eye(3)),
]


@pytest.mark.parametrize("call", ON_MESH)
def test_ids_out_of_range_are_refused_everywhere(call):
    with pytest.raises(of.InvalidInput, match="triangles") as caught:
        call(WILD)
    assert caught.value.kind == "index_out_of_range" and caught.value.elements == [0]


@pytest.mark.parametrize("call", ON_MESH)
def test_coordinates_that_are_not_finite_are_refused_everywhere(call):
    with pytest.raises(of.InvalidInput, match="vertices") as caught:
        call(LOST)
    assert caught.value.kind == "non_finite" and caught.value.elements == [0]


@pytest.mark.parametrize(
    "call",
    [
        of.surface.mean_edge_length,
        of.surface.detect_features,
        of.volume.tetrahedralize,
        of.surface.principal_directions,
        lambda m: of.surface.remesh(m, NONE),
        of.surface.direction_field,
    ],
)
def test_an_empty_mesh_is_refused_where_nothing_can_be_said(call):
    with pytest.raises(of.InvalidInput):
        call(of.TriangleMesh())


def test_features_that_are_not_of_the_mesh_are_refused(box, box_surface, box_field):
    far = [int(np.argmin(box_surface.vertices.sum(axis=1))), int(np.argmax(box_surface.vertices.sum(axis=1)))]
    for bad, kind in (
        (of.FeatureGraph([far], []), "not_an_edge"),
        (of.FeatureGraph([[0, 10**9]], []), "index_out_of_range"),
        (of.FeatureGraph([], [-1]), "index_out_of_range"),
        (of.FeatureGraph([[3, 3]], []), "not_an_edge"),
    ):
        for call in (
            lambda f: of.surface.SurfaceDomain(box_surface, f),
            box_field.domain.with_features,
            lambda f: of.surface.remesh(box_surface, f),
            lambda f: of.TetDomain(box, features=f),
        ):
            with pytest.raises(of.InvalidInput, match="features") as caught:
                call(bad)
            assert caught.value.kind == kind and caught.value.elements == [0]
    with pytest.raises(of.InvalidInput, match="not an edge"):
        of.surface.feature_graph(box_surface, [far])


def test_values_that_are_not_those_of_the_domain_are_refused(sphere, box_field):
    make = of.surface.DirectionField
    for field in (
        make(4, of.surface.SurfaceDomain(sphere), box_field.values),
        make(4, box_field.domain, box_field.values[:-1]),
        make(4, box_field.domain, box_field.values * np.nan),
        make(0, box_field.domain, box_field.values),
    ):
        for call in (
            of.surface.triangle_directions,
            of.surface.surface_singularities,
            of.surface.vertex_directions,
            lambda f: of.surface.separatrices(f, of.surface.SurfaceSingularities()),
        ):
            with pytest.raises(of.InvalidInput, match="field"):
                call(field)


def test_a_domain_shows_its_arrays_and_keeps_them_alive(box_surface, box_features, box_field):
    domain = of.surface.SurfaceDomain(box_surface, box_features)
    topology = of.surface.edge_topology(box_surface)
    expected = {
        "vertices": box_surface.vertices,
        "triangles": box_surface.triangles,
        "edges": topology.edges,
        "triangle_edges": topology.triangle_edges,
        "edge_triangles": topology.edge_triangles,
        "normals": of.surface.triangle_normals(box_surface),
    }
    for name, array in expected.items():
        shown = getattr(domain, name)
        np.testing.assert_array_equal(shown, array)
        assert not shown.flags.writeable
        assert np.shares_memory(shown, getattr(domain.with_features(of.FeatureGraph()), name))  # nothing is copied
    np.testing.assert_allclose(domain.corner_angles.sum(axis=1), np.pi)
    ends = box_surface.vertices[topology.edges]
    np.testing.assert_allclose(domain.edge_lengths, np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1))
    assert domain.size == of.surface.shape_size(box_surface)
    assert domain.mean_edge_length == of.surface.mean_edge_length(box_surface)
    np.testing.assert_array_equal(domain.features.edges, box_features.edges)
    lengths, copy = domain.edge_lengths, domain.edge_lengths.copy()
    del domain
    gc.collect()
    np.testing.assert_array_equal(lengths, copy)
    again = pickle.loads(pickle.dumps(box_field))
    np.testing.assert_array_equal(again.domain.edges, box_field.domain.edges)
    np.testing.assert_array_equal(again.domain.features.edges, box_features.edges)


def test_options_out_of_range_are_refused(box_surface, box_features):
    for options in (
        {"symmetry": 0},
        {"epsilon": -1.0},
        {"epsilon": np.nan},
        {"tolerance": np.inf},
        {"max_iterations": -1},
    ):
        with pytest.raises(of.InvalidInput):
            of.surface.direction_field(of.surface.SurfaceDomain(box_surface, box_features), **options)
    with pytest.raises(of.InvalidInput, match="gl, mbo, eigen") as caught:
        of.surface.direction_field(of.surface.SurfaceDomain(box_surface, box_features), method="ginzburg_landau")
    assert caught.value.kind == "unknown_word"
    for options in ({"edge_length": -1.0}, {"edge_length": np.nan}, {"iterations": 0}):
        with pytest.raises(of.InvalidInput):
            of.surface.remesh(box_surface, box_features, **options)
    for options in ({"angle": 0.0}, {"angle": 4.0}, {"corner_angle": np.nan}):
        with pytest.raises(of.InvalidInput):
            of.surface.detect_features(box_surface, **options)
    for points in ([], [[1, 2]], [[np.nan, 0, 0]]):
        with pytest.raises(of.InvalidInput):
            of.surface.bounding_box_diagonal(points)
    with pytest.raises(TypeError):
        of.surface.remesh(box_surface, box_features, 0.3)
