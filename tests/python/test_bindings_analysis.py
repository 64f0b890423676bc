"""Analysis of frame fields: meshability, integrability, alignment with features."""

import numpy as np
import octafield as of
import pytest
import pyvista
from conftest import SHARED_DATA
from octafield.fields.frame_field import compute_field
from pipeline_fixtures import shared


def turning(points, turns=0.25, centre=(0.48, 0.53)):
    """One straight line of the given index, along z."""
    angle = turns * np.arctan2(points[:, 1] - centre[1], points[:, 0] - centre[0])
    return of.frames.quaternion_exp(np.column_stack([0 * angle, 0 * angle, angle]))


@pytest.mark.parametrize("turns", [1, -1])
def test_a_straight_line_ends_twice_at_singular_points_of_the_surface(box, turns):
    frames = turning(np.asarray(box.vertices), turns / 4)
    found = of.volume.local_meshability(box, frames, of.volume.singular_graph(box, frames))
    assert found.boundary_ends == found.boundary_ends_about_normal == len(found.vertices) == 2
    assert found.non_meshable_vertices == found.non_meshable_junctions == found.closed_curves == 0
    assert [v.kind for v in found.vertices] == ["boundary_end"] * 2 and all(v.meshable for v in found.vertices)
    assert [(v.valence3, v.valence5) for v in found.vertices] == [(1, 0) if turns > 0 else (0, 1)] * 2
    np.testing.assert_array_equal(np.sort(found.curve_ends), [[0, 1]])


def test_hex_vertices_of_low_valence_are_eleven():
    assert sum(of.volume.hex_vertex_exists(v3, v5) for v3 in range(13) for v5 in range(13)) == 11
    assert (
        of.volume.hex_vertex_exists(4, 0)
        and not of.volume.hex_vertex_exists(1, 1)
        and not of.volume.hex_vertex_exists(3, 1)
    )
    with pytest.raises(of.InvalidInput):
        of.volume.hex_vertex_exists(-1, 0)


def test_meshability_is_written_with_the_graph(box, tmp_path):
    frames = of.frames.random_rotations(len(box.vertices), 5)
    graph = of.volume.singular_graph(box, frames)
    found = of.volume.local_meshability(box, frames, graph)
    of.volume.write_singular_graph(tmp_path / "singular.vtp", graph, meshability=found)
    data = pyvista.read(tmp_path / "singular.vtp").point_data
    np.testing.assert_array_equal(data["smoothed"], of.volume.smoothed_curves(graph).points)
    expected = np.full(len(graph.points), -1)
    expected[[v.point for v in found.vertices]] = [v.meshable for v in found.vertices]
    np.testing.assert_array_equal(data["meshable"], expected)
    assert data["junction"].max() == len(found.junctions) - 1
    other = of.volume.Meshability(vertices=[of.volume.SingularVertex(point=10**6)])
    with pytest.raises(of.InvalidInput):
        of.volume.write_singular_graph(tmp_path / "other.vtp", graph, meshability=other)


def test_ends_of_curves_tell_axis_and_angle(box):
    frames = turning(np.asarray(box.vertices))
    graph = of.volume.singular_graph(box, frames)
    found = of.volume.local_meshability(box, frames, graph)
    assert [(end.vertex, end.curve, end.quarter_turns) for end in found.ends] == [(0, 0, 1), (1, 0, 1)]
    np.testing.assert_allclose([abs(end.axis) for end in found.ends], [[0, 0, 1]] * 2, atol=1e-12)
    assert all(end.angle < 0.6 for end in found.ends) and found.non_meshable_curves == 0


def test_smoothed_curves_are_shorter_and_keep_their_ends(box):
    graph = of.volume.singular_graph(box, turning(np.asarray(box.vertices)))
    found = of.volume.smoothed_curves(graph)
    ends = [graph.curves[0][0], graph.curves[0][-1]]
    np.testing.assert_array_equal(found.points[ends], np.asarray(graph.points)[ends])
    assert found.length <= graph.length * (1 + 1e-12) and found.lengths.sum() == pytest.approx(found.length)
    assert of.volume.smoothed_curves(graph, steps=0).length == pytest.approx(graph.length)
    with pytest.raises(of.InvalidInput):
        of.volume.smoothed_curves(graph, steps=-1)


def test_a_cube_has_one_hexahedron_at_every_edge(box):
    features = of.surface.detect_features(of.volume.boundary_surface(box).mesh)
    domain = of.TetDomain(box, features=features)
    frames = np.tile([1.0, 0, 0, 0], (len(box.vertices), 1))
    found = of.volume.boundary_meshability(domain, frames)
    assert {(w.hexahedra_a, w.hexahedra_b, w.around) for w in found.wedges} == {(1, 1, 1)}
    assert len(found.wedges) == len(features.edges) and len(found.corners) == 8 and not found.crossings
    assert found.non_meshable_wedges == found.non_meshable_corners == 0
    assert all(c.meshable and c.inside == 0 and c.feature_edges == c.sectors == 3 for c in found.corners)
    with pytest.raises(of.InvalidInput):
        of.volume.boundary_meshability(domain, frames[:3])


def test_integrability_of_a_screw_field_is_its_twist(box):
    z = np.asarray(box.vertices)[:, 2]
    found = of.volume.integrability(box, of.frames.quaternion_exp(np.column_stack([0 * z, 0 * z, 0.5 * z])))
    assert found.twist_rms == pytest.approx(0.5 * 2**0.5, rel=0.01) and found.twist.shape == (len(box.tets),)
    assert 0 < found.jump_rms <= found.jump_max < 0.2
    still = of.volume.integrability(box, np.tile([1.0, 0, 0, 0], (len(z), 1)))
    assert still.jump_max == still.twist_max == 0
    # Each tet's frame turns by the mean of z, to the third order in the turns within it.
    frames = of.volume.tet_frames(box, of.frames.quaternion_exp(np.column_stack([0 * z, 0 * z, 0.5 * z])))
    np.testing.assert_allclose(2 * np.arctan2(frames[:, 3], frames[:, 0]), 0.5 * z[box.tets].mean(axis=1), atol=1e-3)


def test_feature_alignment_of_a_cube_is_the_angle_it_is_turned_by(box):
    domain = of.TetDomain(box, features=of.surface.detect_features(of.volume.boundary_surface(box).mesh))
    tangents = of.volume.feature_tangents(domain)
    frames = of.frames.quaternion_exp(np.tile([0, 0, 0.2], (len(box.vertices), 1)))
    angles = of.volume.feature_alignment_angles(domain, frames)
    np.testing.assert_allclose(angles, np.where(abs(tangents.tangent[:, 2]) > 0.5, 0, 0.2), atol=1e-14)


def test_graphs_of_other_meshes_are_refused(box):
    frames = turning(np.asarray(box.vertices))
    graph = of.volume.singular_graph(box, frames)
    small = of.TetMesh(np.eye(4)[:, :3], [[0, 1, 2, 3]])
    with pytest.raises(of.Error):
        of.volume.local_meshability(small, frames[:4], graph)


def test_in_a_ball_eight_nodes_of_four_curves_of_valence_three_and_eight_curves_to_the_surface():
    """As in a cube blown up to a ball: a block inside, whose eight corners are the nodes."""
    result = compute_field(shared(SHARED_DATA / "arff" / "sphere_r0.17.mesh.gz"))
    found, record = result.meshability, result.record
    nodes = [j for j in found.junctions if (j.valence3, j.valence5, j.valence6) == (4, 0, 0)]
    assert len(nodes) == 8 and all(j.meshable for j in nodes)
    assert record["singular_boundary_ends"] == record["singular_boundary_ends_about_normal"] == 8
    assert record["non_meshable_vertices"] >= record["non_meshable_junctions"]
    assert sum(record["singular_vertex_types"].values()) == len(found.vertices) - 8
    assert record["feature_alignment_deg"] == {"median": 0, "max": 0}
    assert record["integrability"]["jump_rms"] == result.integrability.jump_rms > 0
