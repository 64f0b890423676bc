"""Every representation and metric of the registry, from Python: the same laws for all, on arrays, with hypothesis."""

import itertools

import numpy as np
import octafield as of
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

NAMES = sorted(of.frames.representations)
EQUIVARIANT = [name for name in NAMES if of.frames.representations[name].rotate]
LARGE = 1500  # rows enough for several threads and the interruptible path


def multiply(a, b):
    """Quaternion products, w x y z, by scipy."""
    xyzw = (Rotation.from_quat(np.roll(a, -1, axis=-1)) * Rotation.from_quat(np.roll(b, -1, axis=-1))).as_quat()
    return np.roll(xyzw, 1, axis=-1)


coordinates = st.floats(-1, 1, allow_nan=False)
quaternions = (
    st.tuples(*[coordinates] * 4)
    .map(np.array)
    .filter(lambda q: np.linalg.norm(q) > 0.1)
    .map(lambda q: q / np.linalg.norm(q))
)


@pytest.fixture(scope="module")
def q():
    return of.frames.random_rotations(LARGE, seed=3)


def test_all_five_are_there():
    assert NAMES == ["odeco", "sh4", "sh469", "su2", "tensor4"]
    assert sorted(set(NAMES) - set(EQUIVARIANT)) == ["su2"]


@pytest.mark.parametrize("name", NAMES)
@given(q=quaternions, o=st.integers(0, 47))
@settings(max_examples=50, deadline=None)
def test_embedding_does_not_see_the_symmetry(name, q, o):
    embed = of.frames.representations[name].embed
    moved = multiply(q, of.frames.binary_octahedral_group()[o])
    np.testing.assert_allclose(embed(moved), embed(q), atol=1e-13)


@pytest.mark.parametrize("name", EQUIVARIANT)
@given(g=quaternions, q=quaternions)
@settings(max_examples=50, deadline=None)
def test_turning_the_vector_turns_the_frame(name, g, q):
    r = of.frames.representations[name]
    np.testing.assert_allclose(r.rotate(g, r.embed(q)), r.embed(multiply(g, q)), atol=1e-13)


@pytest.mark.parametrize("name", NAMES)
@given(q=quaternions, data=st.data())
@settings(max_examples=25, deadline=None)
def test_projection_is_idempotent_and_no_worse_than_the_frame_nearby(name, q, data):
    r = of.frames.representations[name]
    noise = np.array(data.draw(st.lists(coordinates, min_size=r.dimension, max_size=r.dimension)))
    v = r.embed(q) + noise
    frame, distance = r.project(v)
    assert distance <= np.linalg.norm(noise) + 1e-12
    assert of.frames.distance(r.project(r.embed(frame))[0], frame) < 1e-7


@pytest.mark.parametrize("name", NAMES)
def test_differential_and_hessian_are_derivatives(name, q):
    r = of.frames.representations[name]
    q, h = q[:50], 1e-4
    v = np.random.default_rng(1).normal(size=(50, r.dimension))
    at = lambda w: r.embed(of.frames.frame_exp(q, w))
    e = h * np.eye(3)
    first, second = r.differential(q), r.hessian(q, v)
    for j in range(3):
        np.testing.assert_allclose((at(e[j]) - at(-e[j])) / (2 * h), first[:, :, j], atol=2e-5)
        for k in range(3):
            mixed = (at(e[j] + e[k]) - at(e[j] - e[k]) - at(e[k] - e[j]) + at(-e[j] - e[k])) / (4 * h * h)
            np.testing.assert_allclose(np.sum(v * mixed, axis=1), second[:, j, k], atol=1e-3)


@pytest.mark.parametrize("name", EQUIVARIANT)
def test_speed_is_that_of_every_direction_at_every_frame(name, q):
    r = of.frames.representations[name]
    j = r.differential(q[:100])
    gram = np.einsum("nij,nik->njk", j, j)
    np.testing.assert_allclose(gram, np.broadcast_to(r.speed**2 * np.eye(3), gram.shape), atol=1e-12)


@pytest.mark.parametrize("one,two,three", list(itertools.permutations(NAMES, 3)))
def test_conversions_commute(one, two, three, q):
    v = of.frames.representations[one].embed(q[:5])
    direct = of.frames.convert(v, one, three)
    np.testing.assert_allclose(of.frames.convert(of.frames.convert(v, one, two), two, three), direct, atol=1e-6)


@pytest.mark.parametrize("name", NAMES)
def test_batches_have_the_bits_of_single_calls_at_any_thread_count(name, q):
    r = of.frames.representations[name]
    v = r.embed(q) + 0.3 * np.random.default_rng(2).normal(size=(LARGE, r.dimension))
    calls = [
        lambda t: r.embed(q, threads=t),
        lambda t: r.differential(q, threads=t),
        lambda t: r.hessian(q, v, threads=t),
        lambda t: np.column_stack(r.project(v, threads=t)),
        lambda t: np.column_stack(r.project(v, q, threads=t)),
    ]
    for call in calls:
        assert call(1).tobytes() == call(2).tobytes() == call(5).tobytes()
    frames, distances = r.project(v)
    for i in (0, 7, LARGE - 1):
        frame, distance = r.project(v[i])
        assert frame.tobytes() == frames[i].tobytes() and distance == distances[i]
        assert r.embed(q[i]).tobytes() == r.embed(q)[i].tobytes()


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_nan_and_infinity_are_named(name, bad):
    r = of.frames.representations[name]
    v = np.ones((4, r.dimension))
    v[2, r.dimension - 1] = bad
    with pytest.raises(of.InvalidInput, match="row 2"):
        r.project(v)
    with pytest.raises(of.InvalidInput):
        r.embed([bad, 0, 0, 0])


@pytest.mark.parametrize("name", NAMES)
def test_zero_and_extreme_vectors_have_a_projection(name):
    r = of.frames.representations[name]
    for size in (0.0, 1e-300, 1e300):
        frame, distance = r.project(np.full(r.dimension, size))
        assert abs(np.linalg.norm(frame) - 1) < 1e-12 and np.isfinite(distance)


def test_unknown_names_are_refused_with_the_known_ones():
    with pytest.raises(of.InvalidInput, match="sh469"):
        of.frames.convert(np.zeros(9), "sh4", "sh5")
    with pytest.raises(of.InvalidInput, match="2, 4, 6, 8, 9"):
        of.frames.harmonics_octahedral(3)
    with pytest.raises(of.InvalidInput, match="icosahedral"):
        of.frames.binary_group_elements("cubic")


@pytest.mark.parametrize("name", sorted(of.frames.metrics))
def test_metrics_do_not_see_the_symmetry_and_match_the_angle_to_first_order(name, q):
    metric = of.frames.metrics[name]
    p, r = q[:200], q[200:400]
    moved = multiply(p, np.repeat(of.frames.binary_octahedral_group()[[7]], 200, axis=0))
    np.testing.assert_allclose(metric.distance(moved, r), metric.distance(p, r), rtol=1e-6, atol=1e-9)
    if metric.speed:
        turned = of.frames.frame_exp(p, 1e-4 * of.frames.quaternion_log(r))
        np.testing.assert_allclose(
            metric.distance(p, turned) / (metric.speed * of.frames.distance(p, turned)), 1, atol=5e-3
        )


def test_mackenzie_distribution_of_random_pairs():
    """Mackenzie 1958: the density of the misorientation of two random cubes (Kolmogorov-Smirnov test)."""
    from scipy import stats

    angles = of.frames.distance(of.frames.random_rotations(20000, 1), of.frames.random_rotations(20000, 2))
    assert 40.6 < np.degrees(angles.mean()) < 40.9 and np.degrees(angles.max()) < 62.7995
    # Its distribution function below 45 degrees: density 24 (1 - cos a) / pi.
    below = angles[angles < np.pi / 4]
    share = lambda a: 24 / np.pi * (a - np.sin(a))
    assert abs(len(below) / len(angles) - share(np.pi / 4)) < 0.015
    assert stats.kstest(below, lambda a: share(a) / share(np.pi / 4)).pvalue > 0.001


def test_extreme_ratio_of_the_chordal_to_the_geodesic_distance():
    """4 / sqrt(7) times 62.7994 degrees = 1.65708, at a corner of the cut locus (tests/frames/sh469_test.cpp)."""
    p, r = of.frames.random_rotations(200000, 4), of.frames.random_rotations(200000, 5)
    ratio = np.linalg.norm(of.frames.sh4_embed(p) - of.frames.sh4_embed(r), axis=1) / of.frames.distance(p, r)
    ratio = np.append(ratio, of.frames.representations["sh4"].speed)  # its limit at small angles
    exact = 4 / 7**0.5 * np.arccos((8**0.5 - 1) / 4)
    assert exact - 0.01 < ratio.max() / ratio.min() < exact + 1e-9


def test_projection_of_an_embedding_is_the_frame_to_rounding(q):
    for r in of.frames.representations.values():
        assert of.frames.distance(r.project(r.embed(q))[0], q).max() < 1e-12, r.name


def test_frame_mean_takes_many_lists_at_once(q):
    lists = of.frames.frame_exp(
        np.repeat(q[:20], 6, axis=0), 0.2 * np.random.default_rng(3).normal(size=(120, 3))
    ).reshape(20, 6, 4)
    frames, variances, converged = of.frames.frame_mean(lists)
    assert frames.shape == (20, 4) and variances.shape == (20,) and converged.dtype == bool and converged.all()
    logs = of.frames.frame_log(np.repeat(frames, 6, axis=0), lists.reshape(-1, 4)).reshape(20, 6, 3)
    np.testing.assert_allclose(logs.sum(axis=1), 0, atol=1e-10)
    np.testing.assert_allclose(np.sum(logs**2, axis=2).mean(axis=1), variances, rtol=1e-9)
    frame, variance, _ = of.frames.frame_mean(lists[3])
    assert frame.tobytes() == frames[3].tobytes() and variance == variances[3]
    weighted = of.frames.frame_mean(lists, np.eye(6)[2])[0]
    assert of.frames.distance(weighted, lists[:, 2]).max() < 1e-9


def test_slerp_takes_one_fraction_or_one_per_row(q):
    p, r = q[:10], q[10:20]
    t = np.linspace(0, 1, 10)
    np.testing.assert_allclose(
        of.frames.distance(p, of.frames.slerp(p, r, t)), t * of.frames.distance(p, r), atol=1e-12
    )
    np.testing.assert_allclose(of.frames.slerp(p, r, 0.25)[4], of.frames.slerp(p[4], r[4], 0.25), atol=0)


def test_directions_of_any_length_will_do():
    for size in (1e-300, 1e-200, 1e155, 1e300):
        np.testing.assert_allclose(
            of.frames.harmonics_evaluate(4, np.multiply([1, 2, 3], size)),
            of.frames.harmonics_evaluate(4, [1, 2, 3]),
            rtol=1e-12,
        )
        np.testing.assert_allclose(
            of.frames.su2_axis_turn([size, size, 0], 0.3), of.frames.su2_axis_turn([1, 1, 0], 0.3), atol=1e-12
        )
        axes = of.frames.rotation_matrices(of.frames.frame_from_axes([0, 0, 1], [size, -size, 0]))
        np.testing.assert_allclose(axes[:, 2], np.array([1, -1, 0]) / 2**0.5, atol=1e-15)


def test_the_row_at_fault_is_named(q):
    h = of.frames.su2_complex(of.frames.su2_embed(q[:10]))
    h[7] += 0.3
    tensors = of.frames.tensor4_embed(q[:10])
    tensors[4] = 0
    full = of.frames.tensor4_full(of.frames.tensor4_embed(q[:10]))
    full[2, 0, 0, 0, 0] = np.nan
    for call, row in [
        (lambda: of.frames.su2_inverse(h), 7),
        (lambda: of.frames.su2_distance(h, h[0]), 7),
        (lambda: of.frames.tensor4_recover(tensors), 4),
        (lambda: of.frames.tensor4_residual(full), 2),
        (lambda: of.frames.slerp(q[:3], q[3:6], [0, np.nan, 1]), 1),
    ]:
        with pytest.raises(of.InvalidInput, match=f"row {row}") as caught:
            call()
        assert caught.value.elements == [row]


def test_one_guess_or_fraction_goes_with_every_row(q):
    v = of.frames.odeco_embed(q[:3], [1, 0.7, 0.4])
    assert of.frames.odeco_nearest(v, q[0])[0].shape == (3, 4)
    assert of.frames.sh4_project(of.frames.sh4_embed(q[:3]), q[0])[0].shape == (3, 4)
    assert of.frames.slerp(q[0], q[1], np.linspace(0, 1, 5)).shape == (5, 4)
    assert of.frames.sh469_project(of.frames.sh469_embed(q[:3], [1, 1, 1]), weights=[1, 1, 1])[1].max() < 1e-7


@pytest.mark.parametrize(
    "call",
    [
        lambda: of.frames.frame_mean(np.zeros((0, 4))),
        lambda: of.frames.frame_mean(np.eye(4)[:2], [1, -1]),
        lambda: of.frames.frame_mean(np.eye(4)[:2], [1, 2, 3]),
        lambda: of.frames.frame_mean([1, 0, 0, 0]),
        lambda: of.frames.slerp(np.eye(4), np.eye(4), [0, 1]),
        lambda: of.frames.slerp(np.eye(4), np.eye(4), np.nan),
        lambda: of.frames.tensor4_residual(np.zeros((3, 3, 3))),
        lambda: of.frames.tensor4_from_mandel(np.zeros((5, 5))),
        lambda: of.frames.tensor4_recover(np.zeros(15)),
        lambda: of.frames.sh469_embed([1, 0, 0, 0], [1, -1, 0]),
        lambda: of.frames.sh469_embed([1, 0, 0, 0], [0, 0, 0]),
        lambda: of.frames.sh469_embed([1, 0, 0, 0], [1, 2]),
        lambda: of.frames.su2_inverse([0, 0, 0]),
        lambda: of.frames.su2_inverse([1, 2, 3]),
        lambda: of.frames.su2_axis_turn([0, 0, 0], 1.0),
        lambda: of.frames.su2_inverse_frame([np.nan, 0, 0]),
        lambda: of.frames.odeco_embed([1, 0, 0, 0], [1, np.inf, 1]),
        lambda: of.frames.harmonics_evaluate(4, [0, 0, 0]),
        lambda: of.frames.harmonics_rotate(4, [1, 0, 0, 0], np.ones(8)),
    ],
)
def test_wrong_input_is_refused(call):
    with pytest.raises(of.InvalidInput):
        call()
