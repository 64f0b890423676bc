"""Batch functions on frames, against scipy and brute force."""

import numpy as np
import octafield as of
import pytest
from scipy.spatial.transform import Rotation
from scipy.special import sph_harm_y

WXYZ = [3, 0, 1, 2]  # scipy stores x y z w
LARGE = 3000  # rows enough for several threads and the interruptible path


@pytest.fixture(scope="module")
def q():
    return Rotation.random(LARGE, random_state=1).as_quat()[:, WXYZ]


def multiply(a, b):
    """Quaternion products, w x y z, broadcast over rows."""
    aw, ax, ay, az = np.moveaxis(np.asarray(a), -1, 0)
    bw, bx, by, bz = np.moveaxis(np.asarray(b), -1, 0)
    return np.stack(
        [
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ],
        axis=-1,
    )


def cube_rotations():
    return Rotation.create_group("O").as_quat()[:, WXYZ]


def brute_force_distance(q1, q2):
    dots = np.abs(np.einsum("gni,ni->gn", multiply(q1[None], cube_rotations()[:, None]), q2))
    return 2 * np.arccos(np.minimum(dots.max(axis=0), 1))


def real_harmonics_4(direction):
    x, y, z = direction
    theta, phi = np.arccos(np.clip(z, -1, 1)), np.arctan2(y, x)
    complex_ = [sph_harm_y(4, abs(m), theta, phi) for m in range(-4, 5)]
    return np.array(
        [
            c.real if m == 0 else np.sqrt(2) * (-1) ** m * (c.imag if m < 0 else c.real)
            for m, c in zip(range(-4, 5), complex_)
        ]
    )


def test_rotation_matrices_agree_with_scipy(q):
    np.testing.assert_allclose(
        of.frames.rotation_matrices(q), Rotation.from_quat(q[:, [1, 2, 3, 0]]).as_matrix(), atol=1e-14
    )


def test_exp_agrees_with_scipy_and_log_inverts_it(q):
    vectors = Rotation.from_quat(q[:, [1, 2, 3, 0]]).as_rotvec()
    result = of.frames.quaternion_exp(vectors)
    expected = Rotation.from_rotvec(vectors).as_quat()[:, WXYZ]
    np.testing.assert_allclose(np.abs(np.sum(result * expected, axis=1)), 1, atol=1e-14)
    np.testing.assert_allclose(of.frames.quaternion_log(result), vectors, atol=1e-9)


def test_random_rotations_are_uniform_and_repeatable():
    frames = of.frames.random_rotations(20000, seed=7)
    np.testing.assert_allclose(np.linalg.norm(frames, axis=1), 1, atol=1e-14)
    np.testing.assert_array_equal(frames, of.frames.random_rotations(20000, seed=7))
    assert not np.array_equal(frames, of.frames.random_rotations(20000, seed=8))
    assert np.abs(of.frames.rotation_matrices(frames).mean(axis=0)).max() < 0.02


def test_frame_from_axes_keeps_the_normal_and_follows_the_direction(q):
    direction, normal = of.frames.rotation_matrices(q)[:, :, 0], of.frames.rotation_matrices(q[::-1])[:, :, 2]
    axes = of.frames.rotation_matrices(of.frames.frame_from_axes(direction, 3 * normal))
    np.testing.assert_allclose(axes[:, :, 2], normal, atol=1e-12)
    assert (np.sum(axes[:, :, 0] * direction, axis=1) > 0).all()
    assert np.allclose(np.linalg.det(np.stack([axes[:, :, 0], direction, normal], axis=1)), 0, atol=1e-12)


def test_octahedral_group_is_the_group_of_the_cube():
    group = of.frames.octahedral_group()
    matrices = of.frames.rotation_matrices(group)
    assert group.shape == (24, 4) and (group[:, 0] >= 0).all()
    assert set(np.round(matrices).ravel()) == {-1, 0, 1} and np.abs(matrices - np.round(matrices)).max() < 1e-15
    assert len({m.round().astype(int).tobytes() for m in matrices}) == 24
    np.testing.assert_array_equal(of.frames.binary_octahedral_group(), np.concatenate([group, -group]))


def test_product_and_inverse_tables_match_matrix_products():
    matrices = of.frames.rotation_matrices(of.frames.octahedral_group())
    table = of.frames.octahedral_product_table()
    assert table.dtype == np.int32 and table.shape == (24, 24)
    np.testing.assert_allclose(matrices[table], np.einsum("aij,bjk->abik", matrices, matrices), atol=1e-14)
    assert (table[np.arange(24), of.frames.octahedral_inverse_table()] == 0).all()


def test_distance_is_the_smallest_angle_over_the_group(q):
    distances = of.frames.distance(q, q[::-1])
    np.testing.assert_allclose(distances, brute_force_distance(q, q[::-1]), atol=1e-7)
    assert distances.max() <= np.radians(62.7994 + 1e-4)


def test_matching_brings_the_frames_closest(q):
    matches = of.frames.matching(q, q[::-1])
    assert matches.dtype == np.int32
    moved = multiply(q, of.frames.octahedral_group()[matches])
    angle = 2 * np.arccos(np.minimum(np.abs(np.sum(moved * q[::-1], axis=1)), 1))
    np.testing.assert_allclose(angle, brute_force_distance(q, q[::-1]), atol=1e-7)


def test_closest_representative_is_the_same_frame_near_the_reference(q):
    result = of.frames.closest_representative(q, q[::-1])
    assert (np.sum(result * q[::-1], axis=1) > 0).all()
    np.testing.assert_allclose(
        2 * np.arccos(np.minimum(np.sum(result * q[::-1], axis=1), 1)), of.frames.distance(q, q[::-1]), atol=1e-7
    )
    np.testing.assert_allclose(of.frames.distance(result, q), 0, atol=1e-7)


def test_sh4_embedding_is_the_sum_of_spherical_harmonics(q):
    axes = of.frames.rotation_matrices(q[:50])
    expected = [np.sqrt(16 * np.pi / 189) * sum(real_harmonics_4(r[:, k]) for k in range(3)) for r in axes]
    np.testing.assert_allclose(of.frames.sh4_embed(q[:50]), expected, atol=1e-13)


def test_sh4_differential_is_the_derivative_of_the_embedding(q):
    step = 1e-5
    differential = of.frames.sh4_differential(q[:100])
    for k in range(3):
        turn = of.frames.quaternion_exp(step * np.eye(3)[k])
        back = of.frames.quaternion_exp(-step * np.eye(3)[k])
        numeric = (of.frames.sh4_embed(multiply(turn, q[:100])) - of.frames.sh4_embed(multiply(back, q[:100]))) / (
            2 * step
        )
        np.testing.assert_allclose(differential[:, :, k], numeric, atol=1e-8)


def test_sh4_projection_finds_the_nearest_frame(q):
    rng = np.random.default_rng(2)
    vectors = rng.normal(size=(60, 9))
    frames, distances = of.frames.sh4_project(vectors)
    np.testing.assert_allclose(distances, np.linalg.norm(vectors - of.frames.sh4_embed(frames), axis=1), rtol=1e-12)
    others = np.linalg.norm(vectors[:, None] - of.frames.sh4_embed(q)[None], axis=2)
    assert (distances[:, None] <= others).all()
    again, _ = of.frames.sh4_project(vectors, frames)
    assert of.frames.distance(frames, again).max() < 1e-7


def test_projection_of_an_embedding_is_the_frame(q):
    frames, distances = of.frames.sh4_project(of.frames.sh4_embed(q))
    assert of.frames.distance(frames, q).max() < 1e-7 and distances.max() < 1e-7


def test_registry_leads_to_the_module_functions(q):
    entry = of.frames.representations["sh4"]
    assert entry.name == "sh4" and entry.dimension == 9 and repr(entry) == "Representation(sh4, dimension 9)"
    np.testing.assert_array_equal(entry.embed(q), of.frames.sh4_embed(q))
    np.testing.assert_array_equal(entry.differential(q), of.frames.sh4_differential(q))
    np.testing.assert_array_equal(
        entry.project(entry.embed(q[:9]))[0], of.frames.sh4_project(of.frames.sh4_embed(q[:9]))[0]
    )


def test_a_single_input_gives_a_single_result(q):
    one = q[0]
    assert of.frames.sh4_embed(one).shape == (9,) and of.frames.sh4_differential(one).shape == (9, 3)
    assert of.frames.rotation_matrices(one).shape == (3, 3) and of.frames.quaternion_log(one).shape == (3,)
    assert of.frames.quaternion_exp([0, 0, 1]).shape == (4,) and of.frames.closest_representative(one, q[1]).shape == (
        4,
    )
    assert isinstance(of.frames.distance(one, q[1]), float) and isinstance(of.frames.matching(one, q[1]), int)
    frame, distance = of.frames.sh4_project(of.frames.sh4_embed(one))
    assert frame.shape == (4,) and isinstance(distance, float)
    assert of.frames.sh4_embed(q[:1]).shape == (1, 9)


def test_a_single_frame_goes_with_every_row_of_the_other(q):
    np.testing.assert_array_equal(of.frames.distance(q[0], q), of.frames.distance(np.repeat(q[:1], len(q), axis=0), q))
    np.testing.assert_array_equal(of.frames.matching(q, q[0]), of.frames.matching(q, np.repeat(q[:1], len(q), axis=0)))


@pytest.mark.parametrize(
    "call",
    [
        lambda q, t: of.frames.sh4_embed(q, threads=t),
        lambda q, t: of.frames.sh4_differential(q, threads=t),
        lambda q, t: np.column_stack(of.frames.sh4_project(of.frames.sh4_embed(q) + 0.1, threads=t)),
        lambda q, t: of.frames.distance(q, q[::-1], threads=t),
        lambda q, t: of.frames.matching(q, q[::-1], threads=t),
        lambda q, t: of.frames.closest_representative(q, q[::-1], threads=t),
        lambda q, t: of.frames.quaternion_log(q, threads=t),
        lambda q, t: of.frames.rotation_matrices(q, threads=t),
    ],
)
def test_results_have_the_same_bits_at_any_thread_count(q, call):
    assert call(q, 1).tobytes() == call(q, 2).tobytes() == call(q, 7).tobytes()


def test_empty_input_gives_empty_output():
    assert of.frames.sh4_embed([]).shape == (0, 9) and of.frames.distance(np.zeros((0, 4)), np.zeros((0, 4))).shape == (
        0,
    )
    assert of.frames.random_rotations(0).shape == (0, 4)


def test_nearly_unit_quaternions_are_normalised():
    assert of.frames.sh4_embed([1 + 1e-7, 0, 0, 0]) == pytest.approx(of.frames.sh4_embed([1, 0, 0, 0]), abs=1e-15)


def test_the_first_row_that_is_not_unit_is_named(q):
    bad = q.copy()
    bad[17] *= 1.01
    bad[40] = 0
    with pytest.raises(of.InvalidInput, match="row 17") as caught:
        of.frames.sh4_embed(bad)
    assert caught.value.kind == "not_unit" and caught.value.elements == [17]


@pytest.mark.parametrize(
    "call",
    [
        lambda: of.frames.sh4_embed(np.ones((3, 3))),
        lambda: of.frames.sh4_embed(np.ones(5)),
        lambda: of.frames.sh4_embed(np.ones((2, 2, 4))),
        lambda: of.frames.sh4_embed(1.0),
        lambda: of.frames.sh4_embed("word"),
        lambda: of.frames.sh4_embed(None),
        lambda: of.frames.sh4_embed([[1, 0], [1]]),
        lambda: of.frames.sh4_embed(np.array([1j, 0, 0, 0])),
        lambda: of.frames.sh4_embed([np.nan, 0, 0, 0]),
        lambda: of.frames.sh4_embed([1, 0, 0, 0], threads=-1),
        lambda: of.frames.sh4_differential(np.ones((3, 9))),
        lambda: of.frames.sh4_project(np.ones((2, 4))),
        lambda: of.frames.sh4_project(np.full(9, np.inf)),
        lambda: of.frames.sh4_project(np.ones((2, 9)), np.eye(4)[[0, 0, 0]]),
        lambda: of.frames.sh4_project(np.ones(9), [2, 0, 0, 0]),
        lambda: of.frames.distance(np.eye(4)[:2], np.eye(4)[:3]),
        lambda: of.frames.matching([1, 0, 0, 0], [1, 0, 0]),
        lambda: of.frames.closest_representative([1, 0, 0, 0], [0, 0, 0, 0]),
        lambda: of.frames.quaternion_exp([1, 2]),
        lambda: of.frames.quaternion_exp([np.nan, 0, 0]),
        lambda: of.frames.quaternion_log([1, 1, 1, 1]),
        lambda: of.frames.rotation_matrices(np.ones((4, 3))),
        lambda: of.frames.random_rotations(-1),
        lambda: of.frames.frame_from_axes([1, 0, 0], [0, 0, 0]),
        lambda: of.frames.frame_from_axes([1, 0], [0, 0, 1]),
    ],
)
def test_wrong_input_is_refused(call):
    with pytest.raises(of.InvalidInput):
        call()
