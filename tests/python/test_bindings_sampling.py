"""Frames in the tets, and odeco tensors with free axis lengths."""

import copy

import numpy as np
import octafield as of
import pytest
import scipy.sparse
from octafield.fields.frame_field import compute_field
from octafield.options import FieldOptions
from octafield.runs.run_folder import write_field_result
from pipeline_fixtures import octafield as command
from pipeline_fixtures import write_cube, write_sphere


def tangents(surface):
    normals = of.surface.triangle_normals(surface.mesh)
    return np.cross(normals, np.roll(normals, 1, axis=1) + [0.1, 0.2, 0.3])


@pytest.fixture(scope="module")
def held(box):
    surface = of.volume.boundary_surface(box)
    return of.volume.tet_boundary_constraints(box, tangents(surface))


def test_a_sampling_is_the_coupling_of_its_sites(box):
    vertices, tets = of.volume.vertex_sampling(box), of.volume.tet_sampling(box)
    assert (vertices.sites, len(vertices)) == ("vertices", len(box.vertices))
    assert (tets.sites, len(tets)) == ("tets", len(box.tets)) and repr(tets).startswith(
        f"Sampling({len(box.tets)} tets, "
    )
    assert abs(vertices.stiffness - of.volume.stiffness(box)).max() == 0
    np.testing.assert_array_equal(vertices.mass, of.volume.lumped_mass(box))
    np.testing.assert_allclose(tets.mass, of.volume.tet_volumes(box))
    assert tets.body_radius == pytest.approx(
        0.5
    ) and tets.edge_length == vertices.edge_length == of.surface.mean_edge_length(of.volume.boundary_surface(box).mesh)
    with pytest.raises(TypeError):
        of.volume.Sampling()


def test_weights_are_area_over_distance_of_centroids(box):
    points, tets, stiffness = (
        np.asarray(box.vertices),
        np.asarray(box.tets),
        of.volume.tet_sampling(box).stiffness.tocoo(),
    )
    centroids = points[tets].mean(axis=1)
    for s, t, value in list(zip(stiffness.row, stiffness.col, stiffness.data))[::50]:
        if s != t:
            a, b, c = points[list(set(tets[s]) & set(tets[t]))]
            area = np.linalg.norm(np.cross(b - a, c - a)) / 2
            assert -value == pytest.approx(area / np.linalg.norm(centroids[s] - centroids[t]))


def test_every_solver_takes_a_sampling(box, held):
    sampling = of.volume.tet_sampling(box)
    start = of.volume.initial_frames(sampling, held)
    assert start.shape == (len(box.tets), 4)
    for result in (
        of.volume.diffuse(sampling, held, start),
        of.volume.smooth(sampling, held, start),
        of.volume.frame_field(sampling, held).smooth,
    ):
        assert result.energy == pytest.approx(0, abs=1e-9)
        assert of.volume.dirichlet_energy(sampling, result.frames) == pytest.approx(0, abs=1e-9)
    assert of.volume.tet_alignment_angles(box, result.frames).max() < 1e-6
    assert of.frames.distance(of.volume.vertex_frames(box, result.frames), [1, 0, 0, 0]).max() < 1e-3
    assert of.volume.singular_edges(box, result.frames).edges == []
    random = of.frames.random_rotations(len(box.tets), 3)
    assert of.volume.dirichlet_energy(
        of.volume.vertex_sampling(box), of.volume.vertex_frames(box, random)
    ) == pytest.approx(of.volume.dirichlet_energy(box, of.volume.vertex_frames(box, random)))


def test_a_straight_line_is_one_curve_of_singular_edges(box):
    centroids = np.asarray(box.vertices)[np.asarray(box.tets)].mean(axis=1)
    x, y, _ = (centroids - [0.53, 0.51, 0]).T
    angle = np.arctan2(y, x) / 4
    found = of.volume.singular_edges(box, of.frames.quaternion_exp(np.column_stack([0 * angle, 0 * angle, angle])))
    assert len(found.graph.curves) == 1 and list(found.graph.curve_quarter_turns) == [1]
    assert {edge.quarter_turns for edge in found.edges} == {1} and found.complex_edges == 0
    np.testing.assert_array_equal(found.graph.points, np.asarray(box.vertices)[found.vertices])
    again = copy.deepcopy(found)
    assert repr(again) == repr(found) and again.edges[0].a == found.edges[0].a


def test_what_does_not_fit_is_refused(box, held, box_problem):
    _, _, of_vertices, start = box_problem
    with pytest.raises(of.InvalidInput):
        of.volume.smooth(of.volume.tet_sampling(box), of_vertices, start)
    with pytest.raises(of.InvalidInput):
        of.volume.tet_boundary_constraints(box, [[1, 0, 0]])
    with pytest.raises(of.InvalidInput, match="one per vertex|row"):
        of.volume.dirichlet_energy(of.volume.tet_sampling(box), start)
    with pytest.raises(of.InvalidInput, match="sampling"):
        FieldOptions(sampling="edges")


def test_lengths_are_interpolated_between_two_faces(box):
    z = np.asarray(box.vertices)[:, 2]
    kind = np.where((z == 0) | (z == 1), 2, 0).astype(np.uint8)
    frames = np.tile([1.0, 0, 0, 0], (len(z), 1))
    lengths = np.where(z[:, None] == 1, [3, 1, 0.5], [1, 2, 1.5])
    constraints = of.volume.BoundaryConstraints(kind, np.zeros((len(z), 3)), frames, kind > 0, [], lengths)
    assert of.volume.schemes["odeco_lengths"].sort == "embedding_with_lengths"
    result = of.volume.smooth(box, constraints, frames, representation="odeco_lengths", tolerance=1e-10)
    expected = (1 - z)[:, None] * [1, 2, 1.5] + z[:, None] * [3, 1, 0.5]
    assert abs(np.asarray(result.lengths) - expected).max() < 5e-3
    assert len(of.volume.smooth(box, constraints, frames, representation="odeco").lengths) == 0
    constraints.lengths = np.zeros((len(z), 3))
    with pytest.raises(of.InvalidInput, match="above 0"):
        of.volume.smooth(box, constraints, frames, representation="odeco_lengths")
    with pytest.raises(of.InvalidInput, match="shrink"):
        free = of.volume.BoundaryConstraints(0 * kind, np.zeros((len(z), 3)), frames, kind > 0, [])
        of.volume.smooth(box, free, frames, representation="odeco_lengths")


def test_the_pipeline_runs_in_the_tets(tmp_path):
    import pyvista

    result = compute_field(write_sphere(tmp_path), FieldOptions(edge_length=0.4, sampling="tets"))
    record = result.record
    assert record["sampling"] == "tets" and record["options"]["sampling"] == "tets"
    assert result.tet_frames.shape == (len(result.tets.tets), 4) and result.frames.shape == (
        len(result.tets.vertices),
        4,
    )
    assert record["energy"] == of.volume.dirichlet_energy(of.volume.tet_sampling(result.tets), result.tet_frames)
    assert record["alignment_deg"]["max"] < 25 and record["singular_edges"] > 0
    assert sum(record["singular_edges_by_turns"].values()) == record["singular_edges"]
    assert result.integrability is None and result.meshability.non_meshable_vertices == record["non_meshable_vertices"]
    assert record["non_meshable_junctions"] == 0  # the curves of a ball: eight corners of a cube, each with its end
    assert record["singular_boundary_ends"] == record["singular_boundary_ends_about_normal"] == 8
    write_field_result(result, tmp_path)
    grid = pyvista.read(tmp_path / "field.vtu")
    np.testing.assert_allclose(grid.cell_data["quaternion"], result.tet_frames, atol=1e-15)
    np.testing.assert_allclose(
        grid.cell_data["frame_w"], of.frames.rotation_matrices(result.tet_frames)[:, :, 2], atol=1e-12
    )


def test_the_command_line_writes_tets_and_lengths(tmp_path):
    import pyvista

    cube = write_cube(tmp_path)
    command("field", cube, "-o", tmp_path / "tets", "--edge-length", 0.3, "--sampling", "tets", check=0)
    assert "quaternion" in pyvista.read(tmp_path / "tets" / "field.vtu").cell_data
    command("field", cube, "-o", tmp_path / "odeco", "--edge-length", 0.3, "--representation", "odeco_lengths", check=0)
    lengths = pyvista.read(tmp_path / "odeco" / "field.vtu").point_data["frame_lengths"]
    np.testing.assert_allclose(lengths, 1, atol=1e-6)  # of the constant field
    assert command("field", cube, "-o", tmp_path / "bad", "--sampling", "edges", check=2).stderr


def test_a_sampling_of_ones_own_matrix_is_used_by_every_solver(box):
    made = of.volume.tet_sampling(box)
    own = of.volume.Sampling(made.stiffness.tocsr(), made.mass, made.body_radius, made.edge_length, made.size, "tets")
    assert repr(own) == repr(made) and (own.stiffness != made.stiffness).nnz == 0
    start = of.frames.random_rotations(len(own))
    held = of.volume.BoundaryConstraints(
        np.zeros(len(own), int),
        np.zeros((len(own), 3)),
        np.tile([1.0, 0, 0, 0], (len(own), 1)),
        np.zeros(len(own), int),
    )
    for call in (lambda s: of.volume.diffuse(s, held, start, max_steps=3).frames,
                 lambda s: of.volume.smooth(s, held, start, max_iterations=3).frames,
                 lambda s: of.volume.smooth(s, held, start, representation="geodesic",
                     max_iterations=2).frames):  # fmt: skip
        np.testing.assert_array_equal(call(own), call(made))
    assert of.volume.dirichlet_energy(own, start) == of.volume.dirichlet_energy(made, start)


@pytest.mark.parametrize(
    "matrix, mass, kind",
    [
        ([[1, -1], [-1, 1]], [1, 1, 1], "wrong_shape"),
        ([[1, -1, 0], [-1, 1, 0]], [1, 1], "wrong_shape"),
        ([[1, -1], [0, 0]], [1, 1], "not_symmetric"),
        ([[2, -1], [-1, 1]], [1, 1], "rows_sum"),
        ([[-1, 1], [1, -1]], [1, 1], "positive_entry"),
        ([[np.inf, -1], [-1, 1]], [1, 1], "non_finite"),
        ([[1, -1], [-1, 1]], [1, -1], "bad_mass"),
        ([[1, -1], [-1, 1]], [0, 0], "bad_mass"),
    ],
)
def test_matrices_that_couple_nothing_sensible_are_refused(matrix, mass, kind):
    with pytest.raises(of.InvalidInput) as caught:
        of.volume.Sampling(scipy.sparse.csc_array(np.array(matrix, float)), mass, 1, 1, 1)
    assert caught.value.kind == kind


def test_lengths_of_a_sampling_must_be_positive_and_its_sites_known():
    matrix = scipy.sparse.csc_array([[1.0, -1], [-1, 1]])
    with pytest.raises(of.InvalidInput, match="must be positive"):
        of.volume.Sampling(matrix, [1, 1], 0, 1, 1)
    with pytest.raises(of.InvalidInput, match="sites"):
        of.volume.Sampling(matrix, [1, 1], 1, 1, 1, "edges")
