"""The invariants of the binary groups and what follows from them, derived in exact arithmetic (names: su2_forms.py)."""

from fractions import Fraction
from functools import cache
from math import factorial

import pytest
import sympy as sp
from su2_forms import FORMS, GENERATORS, ICOSAHEDRAL, OCTAHEDRAL, PHI, ROOT, TETRAHEDRAL, VIERER, u, v

x = sp.symbols("x")


def is_zero(expression):
    return sp.simplify(sp.expand(expression)) == 0


def product(p, q):
    a, b, c, d = p
    e, f, g, h = q
    return (
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    )


def power(q, n):
    return q if n == 1 else tuple(sp.expand(c) for c in product(q, power(q, n - 1)))


def times(form, q):
    """form at (u, v) times q from the right."""
    a, b = q[0] + sp.I * q[1], q[2] + sp.I * q[3]
    a_bar, b_bar = q[0] - sp.I * q[1], q[2] - sp.I * q[3]
    return form.subs({u: u * a - v * b_bar, v: u * b + v * a_bar}, simultaneous=True)


def axis_form(n):
    """The quadratic form whose roots are the fixed points of the rotations about n."""
    return (n[1] + sp.I * n[2]) * u**2 - 2 * sp.I * n[0] * u * v + (n[1] - sp.I * n[2]) * v**2


@cache
def icosahedral():
    """Degree 12 as a product over the six five-fold axes, then Klein's Hessian and Jacobian determinants."""
    axes = [(0, PHI, 1), (0, PHI, -1), (1, 0, PHI), (1, 0, -PHI), (PHI, 1, 0), (PHI, -1, 0)]
    vertices = sp.prod([axis_form(n) for n in axes])
    field = sp.QQ.algebraic_field(sp.sqrt(5), sp.I)
    f = sp.Poly(sp.expand(vertices), u, v, domain=field)
    f = f.quo_ground(field.from_sympy(f.coeff_monomial(u**12)))
    hessian = f.diff(u).diff(u) * f.diff(v).diff(v) - f.diff(u).diff(v) ** 2
    jacobian = f.diff(u) * hessian.diff(v) - f.diff(v) * hessian.diff(u)
    return f, hessian, jacobian


@pytest.mark.parametrize("group", FORMS)
def test_generators_obey_the_relations_of_the_group(group):  # (4.17)
    p, q, a, b, c = GENERATORS[group]
    for word in (power(a, p), power(b, q), power(c, 2), product(product(a, b), c)):
        assert all(is_zero(found - expected) for found, expected in zip(word, (-1, 0, 0, 0)))


def test_printed_octahedral_generators_do_not_multiply_to_minus_one():
    _, _, a, b, _ = GENERATORS["octahedral"]
    printed = product(product(a, b), (0, 0, ROOT, -ROOT))
    assert not is_zero(printed[0] + 1)


@pytest.mark.parametrize("group", ["vierer", "tetrahedral", "octahedral"])
def test_forms_are_invariant_under_the_generators(group):  # (4.18)
    for generator in GENERATORS[group][2:]:
        for form in FORMS[group]:
            assert is_zero(times(form, generator) - form)


def test_icosahedral_form_is_invariant_and_hence_its_covariants_are():
    field = sp.QQ.algebraic_field(sp.sqrt(5), sp.I)
    f, _, _ = icosahedral()
    for generator in GENERATORS["icosahedral"][2:4]:
        turned = sp.Poly(sp.expand(times(f.as_expr(), generator)), u, v, domain=field)
        assert (turned - f).is_zero


def test_relations_of_vierer_tetrahedral_and_octahedral_forms():
    f0, f1, f2 = VIERER
    assert is_zero(f2**2 - f0 * (f1**2 - 4 * f0**2))
    g0, g1, g2 = TETRAHEDRAL
    assert is_zero(g2**2 - g1**3 + 108 * g0**4)
    h0, h1, h2 = OCTAHEDRAL
    assert is_zero(h2**2 - h1 * (h0**3 - 108 * h1**2))


def test_icosahedral_forms_are_polynomials_in_the_tetrahedral_ones():
    f, hessian, jacobian = icosahedral()
    field = f.domain
    f0, f1, f2 = (sp.Poly(sp.expand(form), u, v, domain=field) for form in ICOSAHEDRAL)
    assert (f - f0).is_zero
    assert (hessian - f1.mul_ground(field.from_sympy(5808 / sp.sqrt(5)))).is_zero
    assert (jacobian + f2.mul_ground(field.from_sympy(sp.Integer(2787840)))).is_zero
    assert ((f2**2).mul_ground(field.from_sympy(60 * sp.sqrt(5))) - f0**5 + f1**3).is_zero


def test_chain_from_vierer_to_tetrahedral():
    """Between (4.20) and (4.21): the thesis prints g2 = f0~^3 + f1~^3, twice the form it lists."""
    f0, f1, f2 = VIERER
    root = 2 * sp.sqrt(3) * sp.I
    first, second = f1 + root * f0, f1 - root * f0
    assert is_zero(f2**2 - sp.sqrt(3) * sp.I / 36 * (second**3 - first**3))
    assert is_zero(TETRAHEDRAL[1] - first * second)
    assert is_zero(TETRAHEDRAL[2] - (first**3 + second**3) / 2)
    assert is_zero(f0 - (first - second) / (4 * sp.sqrt(3) * sp.I))


def test_printed_pair_is_invariant_on_the_left_and_the_other_indices_on_the_right():
    """(4.25) prints u = q0 - i q1, v = q2 + i q3; the conjugate of (4.12) is u = q0 - i q3, v = q2 + i q1."""
    q = (Fraction(1, 5), Fraction(2, 5), Fraction(2, 5), Fraction(4, 5))
    o = tuple(Fraction(1, 2) for _ in range(4))
    invariant = sp.lambdify((u, v), OCTAHEDRAL[0])

    def printed(p):
        return invariant(complex(p[0], -p[1]), complex(p[2], p[3]))

    def conjugate(p):
        return invariant(complex(p[0], -p[3]), complex(p[2], p[1]))

    assert abs(printed(product(o, q)) - printed(q)) < 1e-14 < 0.01 < abs(printed(product(q, o)) - printed(q))
    assert abs(conjugate(product(q, o)) - conjugate(q)) < 1e-14


def test_cubic_of_the_squared_norm():  # (4.29), squares restored
    roots = ((u * v) ** 2, -((u**2 + v**2) ** 2) / 4, (u**2 - v**2) ** 2 / 4)
    h0, h1, _ = OCTAHEDRAL
    assert is_zero(16 * sp.prod([x - r for r in roots]) - (16 * x**3 - h0 * x + h1))
    # The roots of the quadratic (4.30) and its discriminant.
    y = roots[0]
    assert is_zero(h0 - 14 * y**2 - u**8 - v**8)
    assert is_zero(h0**2 - 28 * h0 * y**2 + 192 * y**4 - (u**8 - v**8) ** 2)


def test_roots_of_the_cubic_are_the_axes():
    """x_k = -(n_y + i n_z)^2 / 4, so that 4 |x_k| = |q|^4 - n_x^2 and 2 sum |x_k| = |q|^4."""
    q = sp.symbols("q0:4", real=True)
    w, a, b, c = q
    columns = (  # of the rotation matrix times |q|^2
        (w**2 + a**2 - b**2 - c**2, 2 * (a * b + w * c), 2 * (a * c - w * b)),
        (2 * (a * b - w * c), w**2 - a**2 + b**2 - c**2, 2 * (b * c + w * a)),
        (2 * (a * c + w * b), 2 * (b * c - w * a), w**2 - a**2 - b**2 + c**2),
    )
    pair = {u: w + sp.I * a, v: b + sp.I * c}
    roots = ((u * v) ** 2, -((u**2 + v**2) ** 2) / 4, (u**2 - v**2) ** 2 / 4)
    for n, root in zip(columns, roots):
        assert sp.expand(-((n[1] + sp.I * n[2]) ** 2) / 4 - root.subs(pair)) == 0
    norm4 = (w**2 + a**2 + b**2 + c**2) ** 2
    assert sp.expand(2 * sum(norm4 - n[0] ** 2 for n in columns) / 4 - norm4) == 0
    assert sp.expand(columns[0][1] + sp.I * columns[0][2] + 2 * sp.I * (u * v).subs(pair)) == 0


def test_inverse_needs_no_branch():
    """With a = u v: h2 = a (u^8 - v^8) (h0 - 48 a^4), and h0 - 48 a^4 is minus the derivative of the cubic."""
    h0, _, h2 = OCTAHEDRAL
    a = u * v
    assert is_zero(h2 - a * (u**8 - v**8) * (h0 - 48 * a**4))
    others = (-((u**2 + v**2) ** 2) / 4, (u**2 - v**2) ** 2 / 4)
    assert is_zero(h0 - 48 * a**4 + 16 * (a**2 - others[0]) * (a**2 - others[1]))


def test_jacobian_has_full_rank_away_from_zero():
    """Its 2x2 minors are the gradient of the relation, which vanishes at h = 0 only."""
    h0, h1, h2 = OCTAHEDRAL
    gradient = (-3 * h0**2 * h1, 324 * h1**2 - h0**3, 2 * h2)

    def minor(f, g):
        return sp.diff(f, u) * sp.diff(g, v) - sp.diff(f, v) * sp.diff(g, u)

    for entry, (f, g) in zip(gradient, ((h1, h2), (h2, h0), (h0, h1))):
        assert is_zero(minor(f, g) - 8 * entry)
    a, b, c = sp.symbols("a b c")
    system = [c, a**2 * b, 324 * b**2 - a**3]
    assert sp.solve(system, [a, b, c], dict=True) == [{a: 0, b: 0, c: 0}]


def test_ellipses_of_frames_that_share_an_axis():  # (4.28) with w = v/u, a = u v
    a, w = sp.symbols("a w")
    fourth, difference = w**4 + w**-4, w**4 - w**-4
    # u^2 = a / w, v^2 = a w
    values = [sp.expand(h).subs({u: sp.sqrt(a) / sp.sqrt(w), v: sp.sqrt(a) * sp.sqrt(w)}) for h in OCTAHEDRAL]
    expected = [a**4 * (fourth + 14), a**6 * (fourth - 2), -(a**9) * difference * (fourth - 34)]
    assert all(is_zero(found - wanted) for found, wanted in zip(values, expected))
    assert is_zero(a**2 * expected[0] - expected[1] - 16 * a**6)
    assert is_zero(expected[2] + a**3 * difference * (expected[1] - 32 * a**6))  # thesis: - 32
    assert not is_zero(expected[2] + a**3 * difference * (expected[1] - 32))


def test_polar_form_of_the_shared_axis():
    """|v/u|^2 = (1 - n) / (1 + n), so p = |v/u|^4 is its square; the thesis takes |v/u| and the fourth power."""
    n = sp.symbols("n", real=True)
    size_u, size_v = (1 + n) / 2, (1 - n) / 2  # |u|^2, |v|^2
    assert is_zero(size_u * size_v - (1 - n**2) / 4)  # |a|^2, |n_y + i n_z|^2 = 1 - n^2
    assert is_zero((size_v / size_u) ** 2 - ((1 - n) / (1 + n)) ** 2)


def test_second_axis_condition():
    """(p^2 - m^2) h2 = a (h0 - 48 a^4) ((p^2 + m^2) y - 2 a^8 conj(y)) with y = u^8 + v^8, p = |u|^8, m = |v|^8."""
    u_bar, v_bar = sp.symbols("u_bar v_bar")
    h0, _, h2 = OCTAHEDRAL
    p, m, a = (u * u_bar) ** 4, (v * v_bar) ** 4, u * v
    y, y_bar = u**8 + v**8, u_bar**8 + v_bar**8
    side = (p**2 + m**2) * y - 2 * a**8 * y_bar
    assert is_zero((p**2 - m**2) * h2 - a * (h0 - 48 * a**4) * side)


def test_left_averages_are_the_band_weights():
    """Monomials are orthogonal on the unit 3-sphere: mean |u^a v^b|^2 = a! b! / (a + b + 1)!."""

    def mean_square(form):
        total = sp.Integer(0)
        for (a, b), c in sp.Poly(sp.expand(form), u, v).terms():
            total += c**2 * sp.Rational(factorial(a) * factorial(b), factorial(a + b + 1))
        return total

    assert [mean_square(h) for h in OCTAHEDRAL] == [sp.Rational(8, 15), sp.Rational(8, 3003), sp.Rational(8, 399)]
