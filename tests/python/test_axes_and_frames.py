"""Axes of files to unit quaternions and back, against SciPy's rotations and polar decomposition."""

import numpy as np
import octafield as of
import pytest
from octafield.domain import rotations
from octafield.errors import InvalidInput
from scipy.linalg import polar
from scipy.spatial.transform import Rotation

EPS = np.finfo(float).eps


def place(i: int) -> str:
    return f"line {i + 10}"


def random_rotations(count: int, seed: int = 0) -> np.ndarray:
    return Rotation.random(count, random_state=seed).as_matrix()


def half_turns() -> np.ndarray:
    """About the axes and diagonals, where one component of the quaternion is 0 or equal to another."""
    axes = np.array(
        [[i, j, k] for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1) if (i, j, k) != (0, 0, 0)], float
    )
    return Rotation.from_rotvec(np.pi * axes / np.linalg.norm(axes, axis=1, keepdims=True)).as_matrix()


def test_quaternions_are_those_of_scipy_with_w_not_below_0():
    quarter = Rotation.create_group("O").as_matrix()
    near = half_turns() @ Rotation.from_rotvec([[1e-3, 2e-3, -1e-3]]).as_matrix()
    for matrices in (random_rotations(500), half_turns(), near, quarter, np.eye(3)[None]):
        found = rotations.quaternions_of(matrices)
        expected = Rotation.from_matrix(matrices).as_quat(scalar_first=True)
        assert (found[:, 0] >= 0).all()
        assert np.abs(np.linalg.norm(found, axis=1) - 1).max() < 4 * EPS
        np.testing.assert_allclose(np.abs(np.sum(found * expected, axis=1)), 1, atol=1e-15)
        np.testing.assert_allclose(rotations.axes_of(found), matrices, atol=1e-14)


def test_axes_of_any_length_give_their_frame_and_their_lengths():
    matrices = random_rotations(200, 1)
    lengths = np.random.default_rng(2).uniform(-1, 1, (200, 3))
    lengths = 10.0 ** (150 * lengths)  # squares of them do not fit a double
    found = rotations.frames_of_axes(matrices * lengths[:, None, :], place)
    np.testing.assert_allclose(found.lengths, lengths, rtol=1e-14)
    np.testing.assert_allclose(rotations.axes_of(found.frames), matrices, atol=1e-14)
    assert found.left_handed == 0 and found.deviation < 1e-14
    np.testing.assert_array_equal(rotations.frames_of_axes(matrices, place).frames, rotations.quaternions_of(matrices))


def test_left_handed_axes_are_counted_and_their_third_is_turned_round():
    matrices = random_rotations(50, 3)
    mirrored = matrices.copy()
    mirrored[::7, :, 2] *= -1
    mirrored[::7, :, 0] *= 2
    found = rotations.frames_of_axes(mirrored, place)
    assert found.left_handed == len(matrices[::7])
    np.testing.assert_allclose(rotations.axes_of(found.frames), matrices, atol=1e-14)


def test_skew_axes_give_the_nearest_frame_and_their_largest_angle_to_it():
    axes = random_rotations(100, 4) + np.random.default_rng(5).normal(size=(100, 3, 3)) * 0.2
    axes[np.linalg.det(axes) < 0, :, 2] *= -1
    axes[:5] = random_rotations(5, 6)
    found = rotations.frames_of_axes(axes, place)
    unit = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    nearest = np.array([polar(one)[0] for one in unit])
    np.testing.assert_allclose(rotations.axes_of(found.frames), nearest, atol=1e-13)
    assert found.deviation == pytest.approx(np.arccos(np.clip(np.sum(unit * nearest, axis=1), -1, 1)).max(), rel=1e-12)
    assert rotations.frames_of_axes(axes[:5], place).deviation < 1e-15
    skew = np.eye(3)[None].copy()
    skew[0, :, 1] = [np.sin(1e-7), np.cos(1e-7), 0]  # far above rounding, far below what is seen
    assert rotations.frames_of_axes(skew, place).deviation == pytest.approx(0.5e-7, rel=1e-6)


def test_no_frames_at_all_are_no_frames():
    empty = rotations.frames_of_axes(np.empty((0, 3, 3)), place)
    assert (
        empty.frames.shape == (0, 4)
        and empty.lengths.shape == (0, 3)
        and (empty.deviation, empty.left_handed) == (0.0, 0)
    )
    values, change = rotations.unit_quaternions(np.empty((0, 4)), place)
    assert values.shape == (0, 4) and change == 0


@pytest.mark.parametrize(("row", "column", "value", "words"), [
    (3, 1, np.nan, r"line 13: the axes of frame 3 \(from 0\) are not finite"),
    (3, 2, np.inf, r"line 13: the axes of frame 3 \(from 0\) are not finite"),
    (3, slice(0, 1), 0, r"line 13: an axis of frame 3 \(from 0\) has length 0"),
    (3, slice(2, 3), 0, r"line 13: an axis of frame 3 \(from 0\) has length 0"),
    (3, slice(0, 3), np.array([[1, 1, 0], [0, 1, 1], [0, 0, 0]]),
        r"line 13: the axes of frame 3 \(from 0\) lie in one plane"),
])  # fmt: skip
def test_the_first_triad_that_is_no_frame_is_named(row, column, value, words):
    axes = random_rotations(6, 7)
    for k in (row, row + 2):
        if isinstance(column, int):
            axes[k, 0, column] = value
        else:
            axes[k, :, column] = value
    with pytest.raises(InvalidInput, match=words) as error:
        rotations.frames_of_axes(axes, place)
    assert (error.value.kind, error.value.elements) == ("bad_frame", [3])


def singular_values(axes: np.ndarray) -> np.ndarray:
    return np.linalg.svd(axes / np.linalg.norm(axes, axis=0), compute_uv=False)


@pytest.mark.parametrize("part", [0.5, 0.95, 1.05, 2.0])
@pytest.mark.parametrize("second", [1.0, 1e-3])
def test_axes_in_one_plane_are_refused_below_a_millionth_of_their_largest_singular_value(part, second):
    """second: how far the axes are from lying on one line."""
    axes = np.array([[1, 1, 1], [0, second, -second], [0, 0, 1e-6]])
    for _ in range(3):  # the smallest value goes with the third row
        s = singular_values(axes)
        axes[2] *= part * 1e-6 / (s[2] / s[0])
    s = singular_values(axes)
    assert s[2] / s[0] == pytest.approx(part * 1e-6, rel=1e-3) and (second == 1) == (s[1] > 0.5 * s[0])
    if part > 1:
        found = rotations.frames_of_axes(axes[None], place)
        assert found.deviation > 0.1
    else:
        with pytest.raises(InvalidInput, match=r"line 10: the axes of frame 0 \(from 0\) lie in one plane"):
            rotations.frames_of_axes(axes[None], place)


def test_quaternions_within_rounding_of_length_1_keep_their_bits_and_others_are_scaled():
    unit = np.asarray(of.frames.random_rotations(100, 8))
    values, change = rotations.unit_quaternions(unit, place)
    assert values.tobytes() == unit.tobytes() and change < 4 * EPS
    one = np.array([[1.0, 0, 0, 0]])
    for ulps, kept in ((4, True), (5, False)):
        longer = one * (1 + ulps * EPS)
        found, off = rotations.unit_quaternions(longer, place)
        assert (found.tobytes() == longer.tobytes()) == kept and off == ulps * EPS
    scales = np.random.default_rng(9).uniform(0.1, 3, 100)[:, None]
    scaled, change = rotations.unit_quaternions(unit * scales, place)
    np.testing.assert_allclose(scaled, unit, atol=1e-15)
    assert change == pytest.approx(np.abs(scales - 1).max(), rel=1e-12)
    assert (unit * scales != scaled).any()  # the input is left as it is


@pytest.mark.parametrize("value", [0.0, np.nan, np.inf, 1e200])
def test_the_first_quaternion_that_is_none_is_named(value):
    values = np.asarray(of.frames.random_rotations(6, 1)).copy()
    values[2] = values[4] = value
    with pytest.raises(InvalidInput, match=r"line 12: quaternion 2 \(from 0\) is zero or not finite") as error:
        rotations.unit_quaternions(values, place)
    assert (error.value.kind, error.value.elements) == ("bad_frame", [2])


def test_rows_hold_one_axis_after_the_other_times_its_length():
    frames, lengths = np.asarray(of.frames.random_rotations(20, 2)), np.random.default_rng(3).uniform(1, 2, (20, 3))
    matrices = Rotation.from_quat(frames, scalar_first=True).as_matrix()
    np.testing.assert_allclose(rotations.axes_of(frames), matrices, atol=1e-15)
    rows = rotations.axes_in_rows(frames)
    assert rows.flags.c_contiguous and rows.shape == (20, 9)
    for axis in range(3):
        np.testing.assert_allclose(rows[:, 3 * axis : 3 * axis + 3], matrices[:, :, axis], atol=1e-15)
        of_length = rotations.axes_in_rows(frames, lengths)[:, 3 * axis : 3 * axis + 3]
        np.testing.assert_allclose(of_length, matrices[:, :, axis] * lengths[:, axis, None], atol=1e-14)
