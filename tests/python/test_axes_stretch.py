"""Frames whose axes are not at right angles, in prisms with a sharp edge meshed by TetGen."""

import numpy as np
import octafield
import pytest
from surface_fixtures import prism

volume = octafield.volume
ANGLE = 30.0
EDGE = 0.1


@pytest.fixture(scope="module")
def wedge() -> octafield.FieldProblem:
    return octafield.prepare_field(octafield.prepare_mesh(prism(ANGLE, 0.5), octafield.MeshOptions(edge_length=EDGE)))


@pytest.mark.parametrize("representation", ["sh4", "tensor4", "su2_midpoint"])
def test_axes_follow_both_faces_of_a_sharp_edge_in_every_representation(wedge, representation):
    domain = wedge.meshed.volume()
    stretch = volume.axes_stretch(domain)
    held = volume.boundary_constraints(domain, wedge.directions, stretch=stretch.values)
    frames = volume.frame_field(domain, held, representation=representation).smooth.frames
    assert volume.alignment_angles(domain, frames, stretch=stretch.values).max() < 1e-6
    assert volume.feature_alignment_angles(domain, frames, stretch=stretch.values).max() < 1e-6
    axes = volume.stretched_axes(frames, stretch.values)
    at_edge = np.flatnonzero(np.linalg.norm(np.asarray(domain.vertices)[:, :2], axis=1) < 1e-9)
    assert len(at_edge) > 3
    wanted = [(0, 0, 1), (1, 0, 0), (np.cos(np.radians(ANGLE)), np.sin(np.radians(ANGLE)), 0)]
    unit = axes[at_edge] / np.linalg.norm(axes[at_edge], axis=2, keepdims=True)
    assert np.abs(np.einsum("vid,jd->vij", unit, wanted)).max(axis=1) == pytest.approx(1, abs=1e-9)
    graph = volume.singular_graph(domain, frames)
    assert min(np.linalg.norm(t.point[:2]) for t in graph.triangles) > 4 * EDGE


def test_at_right_angles_no_frame_follows_both_faces(wedge):
    domain = wedge.meshed.volume()
    frames = volume.frame_field(domain, volume.boundary_constraints(domain, wedge.directions)).smooth.frames
    assert volume.alignment_angles(domain, frames).max() > np.radians(10)


def test_a_stretch_of_another_mesh_or_that_is_not_positive_is_refused(wedge):
    domain = wedge.meshed.volume()
    stretch = np.array(volume.axes_stretch(domain).values)
    with pytest.raises(octafield.InvalidInput, match="one per vertex"):
        volume.boundary_constraints(domain, wedge.directions, stretch=stretch[1:])
    stretch[7, 0] = -1
    with pytest.raises(octafield.InvalidInput, match="positive definite") as caught:
        volume.alignment_angles(domain, np.tile([1.0, 0, 0, 0], (len(stretch), 1)), stretch=stretch)
    assert list(caught.value.elements) == [7]
    with pytest.raises(octafield.InvalidInput):
        volume.axes_stretch(domain, corner_angle=2)
