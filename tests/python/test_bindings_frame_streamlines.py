"""Streamlines of frame fields in volumes, points in tets, points spread over a mesh."""

import numpy as np
import octafield as of
import pytest
from scipy.spatial.transform import Rotation


def constant(mesh, rotation=(0.1, 0.2, 0.3)):
    return np.tile(of.frames.quaternion_exp(np.array([rotation]))[0], (len(mesh.vertices), 1))


def test_streamlines_of_a_constant_field_are_straight(box):
    frames = constant(box)
    seeds = of.volume.spread_points(box, 10)
    lines = of.volume.frame_streamlines(box, frames, seeds)
    assert len(lines) == 3 * len(seeds) and len(seeds) <= 10
    axes = Rotation.from_quat(np.roll(frames[0], -1)).as_matrix().T
    for number, line in enumerate(lines):
        across = np.cross(line.points - seeds[number // 3], axes[number % 3])
        assert np.linalg.norm(across, axis=1).max() < 1e-7
        assert (line.first_end, line.last_end) == ("boundary", "boundary") and len(line.tets) == len(line.points) - 1
        assert np.linalg.norm(line.points[-1] - line.points[0]) == pytest.approx(line.length)


def test_streamlines_start_along_the_direction_asked_for_and_end_at_the_length(box):
    (line,) = of.volume.frame_streamlines(
        box, constant(box, (0, 0, 0)), [[0.5, 0.5, 0.5]], [[0.9, 0.1, 0.1]], both_ways=False, max_length=0.3
    )
    np.testing.assert_allclose(line.points[[0, -1]], [[0.5, 0.5, 0.5], [0.8, 0.5, 0.5]], atol=1e-6)
    assert (line.first_end, line.last_end) == ("seed", "length") and line.length == pytest.approx(0.3)
    assert of.volume.frame_streamlines(box, constant(box), np.empty((0, 3))) == []


def test_streamlines_end_before_a_singular_curve(box):
    points = np.asarray(box.vertices)
    angle = np.arctan2(points[:, 1] - 0.53, points[:, 0] - 0.48) / 4
    frames = of.frames.quaternion_exp(np.column_stack([0 * angle, 0 * angle, angle]))
    (line,) = of.volume.frame_streamlines(box, frames, [[0.9, 0.53, 0.4]], [[-1, 0, 0]])
    assert (line.first_end, line.last_end) == ("boundary", "singular")


def test_threads_do_not_change_streamlines(box):
    random_field = of.frames.random_rotations(len(box.vertices), 5)
    seeds = of.volume.spread_points(box, 20)
    one, many = (of.volume.frame_streamlines(box, random_field, seeds, threads=t) for t in (1, 5))
    assert all(np.array_equal(a.points, b.points) for a, b in zip(one, many, strict=True))


def test_points_are_located(box):
    found = of.volume.locate_points(box, [[0.31, 0.42, 0.53], [2, 0, 0]])
    assert found.tet[0] >= 0 and found.tet[1] == -1 and not found.weights[1].any()
    corners = np.asarray(box.vertices)[np.asarray(box.tets)[found.tet[0]]]
    np.testing.assert_allclose(found.weights[0] @ corners, [0.31, 0.42, 0.53], atol=1e-12)


@pytest.mark.parametrize("points, directions, kind", [
    ([[2, 0, 0]], None, "outside"),
    ([[0.5, 0.5, 0.5]], [[0, 0, 0]], "no_direction"),
    ([[0.5, 0.5, 0.5]], [[1, 0, 0], [0, 1, 0]], "wrong_shape"),
    ([[0.5, np.nan, 0.5]], None, "non_finite"),
])  # fmt: skip
def test_bad_seeds_are_refused(box, points, directions, kind):
    with pytest.raises(of.InvalidInput) as error:
        of.volume.frame_streamlines(box, constant(box), points, directions)
    assert error.value.kind == kind


@pytest.mark.parametrize(
    "options", [{"max_length": -1}, {"closing_distance": -1}, {"max_length": np.inf}, {"threads": -1}]
)
def test_bad_options_are_refused(box, options):
    with pytest.raises(of.InvalidInput):
        of.volume.frame_streamlines(box, constant(box), [[0.5, 0.5, 0.5]], **options)
    with pytest.raises(of.InvalidInput):
        of.volume.spread_points(box, -1)
