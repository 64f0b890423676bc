"""Harmonics and the embeddings built from them, against scipy.special.sph_harm_y and numpy.

Conventions. scipy's Y_l^m(theta, phi), theta the polar angle from +z and phi the azimuth, is complex, orthonormal on
the sphere, and has the Condon-Shortley phase (-1)^m. Ours are real, orthonormal and without that phase, so that Y_{1,1}
is a positive multiple of x:

    m > 0: Y_{l,m}  = sqrt(2) (-1)^m Re Y_l^m      (cosines)
    m = 0: Y_{l,0}  = Y_l^0
    m < 0: Y_{l,m}  = sqrt(2) (-1)^m Im Y_l^|m|    (sines)

in the order m = -l..l. Rotations act on functions by (g f)(x) = f(R^T x), so values obey Y(R x) = D(g) Y(x).
"""

import numpy as np
import octafield
import pytest
from scipy.spatial.transform import Rotation
from scipy.special import sph_harm_y

DEGREES = [2, 4, 6, 8, 9]
SH4_FACTOR = np.sqrt(16 * np.pi / 189)


def scipy_harmonics(degree: int, directions: np.ndarray) -> np.ndarray:
    x, y, z = np.moveaxis(directions, -1, 0)
    polar, azimuth = np.arctan2(np.hypot(x, y), z), np.arctan2(y, x)
    values = []
    for m in range(-degree, degree + 1):
        complex_value = (-1) ** m * sph_harm_y(degree, abs(m), polar, azimuth)
        part = complex_value.imag if m < 0 else complex_value.real
        values.append(part * (1 if m == 0 else np.sqrt(2)))
    return np.stack(values, axis=-1)


def random_directions(n: int) -> np.ndarray:
    x = np.random.default_rng(1).normal(size=(n, 3))
    return x / np.linalg.norm(x, axis=1, keepdims=True)


def matrices(q: np.ndarray) -> np.ndarray:
    return Rotation.from_quat(np.roll(q, -1, axis=-1)).as_matrix()


def sphere_rule(points: int) -> tuple[np.ndarray, np.ndarray]:
    """Directions and weights, exact for polynomials of degree 2 points - 1."""
    z, weight = np.polynomial.legendre.leggauss(points)
    azimuth = np.arange(2 * points) * np.pi / points
    z, azimuth = (a.ravel() for a in np.meshgrid(z, azimuth, indexing="ij"))
    s = np.sqrt(1 - z * z)
    return np.stack([s * np.cos(azimuth), s * np.sin(azimuth), z], axis=1), np.repeat(
        weight, 2 * points
    ) * np.pi / points


@pytest.mark.parametrize("degree", DEGREES)
def test_values_are_scipys(degree):
    poles = [[0, 0, 1], [0, 0, -1], [1, 0, 0], [0, -1, 0], [1e-7, 0, np.sqrt(1 - 1e-14)]]
    x = np.concatenate([random_directions(200), poles])
    np.testing.assert_allclose(octafield.frames.harmonics_evaluate(degree, x), scipy_harmonics(degree, x), atol=2e-14)


def test_the_sign_convention_is_the_documented_one():
    x = np.array([0.8, 0.0, 0.6])
    y = octafield.frames.harmonics_evaluate(2, x)
    assert y[2 + 1] > 0  # Y_21 ~ + x z; with the Condon-Shortley phase it would be negative
    assert octafield.frames.harmonics_evaluate(2, [0.0, 0.8, 0.6])[2 - 1] > 0  # Y_2,-1 ~ + y z


@pytest.mark.parametrize("degree", DEGREES)
def test_rotation_is_the_map_of_scipys_values(degree):
    x = random_directions(60)
    for q in octafield.frames.random_rotations(20, seed=2):
        before, after = scipy_harmonics(degree, x), scipy_harmonics(degree, x @ matrices(q).T)
        expected = np.linalg.lstsq(before, after, rcond=None)[0].T  # after = before D^T, 60 rows for 2 l + 1 unknowns
        np.testing.assert_allclose(octafield.frames.harmonics_rotation(degree, q), expected, atol=1e-12)


def test_sh4_is_the_sum_of_scipys_values_at_the_axes():
    q = octafield.frames.random_rotations(200, seed=3)
    axes = matrices(q).transpose(0, 2, 1)  # row k: axis k
    expected = SH4_FACTOR * scipy_harmonics(4, axes).sum(axis=1)
    np.testing.assert_allclose(octafield.frames.sh4_embed(q), expected, atol=1e-14)


def test_sh469_bands_are_the_invariant_functions_turned_by_the_frame():
    """Degrees 4 and 6: sums over the axes, normalised; degree 9: x y z (x2-y2)(y2-z2)(z2-x2), by quadrature."""

    def chiral(p):
        x, y, z = np.moveaxis(p, -1, 0)
        return x * y * z * (x * x - y * y) * (y * y - z * z) * (z * z - x * x)

    nodes, weights = sphere_rule(10)
    basis = scipy_harmonics(9, nodes)
    ninth = lambda r: (weights * chiral(nodes @ r)) @ basis
    sign = np.sign(ninth(np.eye(3))[9 - 4])  # ours is positive at m = -4
    q = octafield.frames.random_rotations(50, seed=4)
    weight = np.array([0.5, 2.0, 3.0])
    embedded = octafield.frames.sh469_embed(q, weight)
    for row, r in zip(embedded, matrices(q)):
        bands = [scipy_harmonics(4, r.T).sum(axis=0), scipy_harmonics(6, r.T).sum(axis=0), sign * ninth(r)]
        expected = [np.sqrt(w) * band / np.linalg.norm(band) for w, band in zip(weight, bands)]
        np.testing.assert_allclose(row, np.concatenate(expected), atol=1e-13)


def test_tensor4_is_the_fourth_power_sum_contracted_by_numpy():
    q = octafield.frames.random_rotations(50, seed=5)
    r = matrices(q)
    full = np.einsum("nim,njm,nkm,nlm->nijkl", r, r, r, r)
    norm = np.sqrt(((full[:, None] - full[None]) ** 2).sum(axis=(2, 3, 4, 5)))
    a, t = octafield.frames.sh4_embed(q), octafield.frames.tensor4_embed(q)
    np.testing.assert_allclose(np.linalg.norm(t[:, None] - t[None], axis=2), norm, atol=1e-13)
    np.testing.assert_allclose(np.sqrt(1.2) * np.linalg.norm(a[:, None] - a[None], axis=2), norm, atol=1e-13)


def test_odeco_coordinates_are_the_harmonic_coefficients_of_the_polynomial():
    """By quadrature of sum_k lambda_k (r_k . x)^4 against scipy's harmonics, in units of sh4's."""
    nodes, weights = sphere_rule(6)
    basis = np.concatenate([scipy_harmonics(degree, nodes) for degree in (0, 2, 4)], axis=1)
    unit = SH4_FACTOR / (32 * np.pi / 315)
    q = octafield.frames.random_rotations(50, seed=6)
    lengths = np.random.default_rng(7).normal(size=(50, 3))
    for row, r, scale in zip(octafield.frames.odeco_embed(q, lengths), matrices(q), lengths):
        polynomial = ((nodes @ r) ** 4) @ scale
        np.testing.assert_allclose(row, unit * (weights * polynomial) @ basis, atol=1e-13)
