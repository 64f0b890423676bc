"""The package's su2 functions against exact arithmetic at rational quaternions (names: su2_forms.py)."""

from fractions import Fraction

import numpy as np
import octafield
import pytest
import sympy as sp
from su2_forms import FORMS, OCTAHEDRAL, u, v

UNIT = [(1, 2, 2, 4, 5), (2, 3, 6, 0, 7), (1, 4, 4, 4, 7), (-2, 4, 5, 6, 9), (1, 0, 0, 0, 1), (1, 1, 1, 1, 2)]


def exact_quaternions():
    return [tuple(sp.Rational(c, row[4]) for c in row[:4]) for row in UNIT]


def exact_values(forms, q):
    pair = {u: q[0] + sp.I * q[1], v: q[2] + sp.I * q[3]}
    return [complex(sp.N(sp.expand(form.subs(pair)), 30)) for form in forms]


def su2_points(q):
    return octafield.frames.su2_complex(octafield.frames.su2_embed(q))


def test_embedding_is_the_exact_one():
    q = exact_quaternions()
    expected = np.array([exact_values(OCTAHEDRAL, row) for row in q])
    found = su2_points(np.array(q, dtype=float))
    assert found.shape == (len(q), 3)
    assert np.abs(found - expected).max() < 1e-14


@pytest.mark.parametrize("group", FORMS)
def test_invariants_are_the_exact_ones_off_the_unit_sphere_too(group):
    q = [tuple(c * sp.Rational(7, 8) for c in row) for row in exact_quaternions()]
    expected = np.array([exact_values(FORMS[group], row) for row in q])
    found = octafield.frames.binary_group_invariants(group, np.array(q, dtype=float))
    assert np.abs(found - expected).max() < 1e-13


def test_inverse_holds_the_quaternion_among_48_with_the_same_exact_invariants():
    q = np.array(exact_quaternions(), dtype=float)
    h = np.array([exact_values(OCTAHEDRAL, row) for row in exact_quaternions()])
    found = octafield.frames.su2_inverse(h)
    assert found.shape == (len(q), 48, 4)
    assert np.linalg.norm(found - q[:, None], axis=2).min(axis=1).max() < 1e-14
    flat = found.reshape(-1, 4)
    assert np.abs(su2_points(flat).reshape(len(q), 48, 3) - h[:, None]).max() < 1e-14


def test_inverse_of_a_scaled_point_has_its_norm():
    q = [tuple(3 * c for c in row) for row in exact_quaternions()]
    h = np.array([exact_values(OCTAHEDRAL, row) for row in q])
    assert np.abs(np.linalg.norm(octafield.frames.su2_inverse(h), axis=2) - 3).max() < 1e-14
    assert np.abs(octafield.frames.su2_squared_norm(h) - 9).max() < 1e-14


def test_turns_about_an_axis_are_the_exact_ellipses():
    t = np.linspace(0, np.pi / 2, 9)
    for n in ((Fraction(1, 3), Fraction(2, 3), Fraction(-2, 3)), (-1, 0, 0), (0, Fraction(3, 5), Fraction(4, 5))):
        found = octafield.frames.su2_axis_turn(np.array(n, dtype=float), t)
        nx, ny, nz = (sp.Rational(c) for c in n)
        a = sp.I * (ny + sp.I * nz) / 2
        first = sp.sqrt((1 + nx) / 2)
        second = a / first if first != 0 else sp.Integer(1)
        turn = np.exp(0.5j * t)
        pair = complex(first) * turn, complex(second) * turn.conj()
        expected = np.stack([sp.lambdify((u, v), h)(*pair) for h in OCTAHEDRAL], axis=1)
        assert found.shape == (len(t), 3)
        assert np.abs(found - expected).max() < 1e-14
        a = complex(a)
        assert np.abs(a**2 * found[:, 0] - found[:, 1] - 16 * a**6).max() < 1e-15


def test_points_off_the_model_surface_are_refused():
    with pytest.raises(octafield.InvalidInput, match="model surface"):
        octafield.frames.su2_inverse(np.array([[1, 0, 0.1 + 0j]]))
    with pytest.raises(octafield.InvalidInput):
        octafield.frames.su2_inverse(np.array([[np.nan, 0, 0j]]))
