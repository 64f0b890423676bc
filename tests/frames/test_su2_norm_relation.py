"""The norm relation of frames/src/su2_surface.cpp, in exact arithmetic at rational unit quaternions."""

import re
from fractions import Fraction
from itertools import product
from pathlib import Path

from sympy import GF
from sympy.polys.matrices import DomainMatrix

SOURCE = Path(__file__).parents[2] / "frames/src/su2_surface.cpp"
DEGREES, LARGEST = (16, 24, 36, 48), 96  # in the quaternion, of A, B, E, C and of the relation


def written() -> dict[tuple[int, ...], int]:
    table = re.search(r"norm_relation\[\] = \{(.*?)\n\};", SOURCE.read_text(), re.S)
    rows = [tuple(map(int, row.split(","))) for row in re.findall(r"\{([-\d, ]+)\}", table[1])]
    return {row[:4]: row[4] for row in rows}


class Gaussian:
    """A complex number of two fractions."""

    def __init__(self, re, im=0):
        self.re, self.im = Fraction(re), Fraction(im)

    def __add__(self, other):
        return Gaussian(self.re + other.re, self.im + other.im)

    def __mul__(self, other):
        return Gaussian(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)

    def __rmul__(self, factor):
        return Gaussian(factor * self.re, factor * self.im)

    def __pow__(self, n):
        return self if n == 1 else self * self ** (n - 1)

    def conjugate(self):
        return Gaussian(self.re, -self.im)


def unit_quaternions():
    """Points of the unit sphere over those of space, by stereographic projection: all rational."""
    for x, y, z in product((1, 2, 3, 4), (5, 6, 7), (8, 9, 11, 13)):
        square = x * x + y * y + z * z
        yield [Fraction(n, square + 1) for n in (square - 1, 2 * x, 2 * y, 2 * z)]


def values(q):
    """A, B, E, C."""
    u, v = Gaussian(q[0], q[1]), Gaussian(q[2], q[3])
    g0 = u * v * (u**4 + -1 * v**4)
    h0 = u**8 + 14 * (u**4 * v**4) + v**8
    h1, h2 = g0 * g0, g0 * (u**12 + -33 * (u**4 * v**4 * (u**4 + v**4)) + v**12)
    return [(a * a.conjugate()).re for a in (h0, h1, h2)] + [(h0**3 * (h1 * h1).conjugate()).re]


def monomial(point, powers):
    result = Fraction(1)
    for value, power in zip(point, powers, strict=True):
        result *= value**power
    return result


def test_the_relation_holds_exactly_and_is_the_only_one_of_its_degree():
    points = [values(q) for q in unit_quaternions()]
    # E^2 = B (A^3 + 108^2 B^2 - 216 C) by Klein's relation: powers of E above 1 say nothing new.
    for a, b, e, c in points:
        assert e * e == b * (a**3 + 108**2 * b * b - 216 * c)
    monomials = [
        powers
        for powers in product(range(7), range(5), range(2), range(3))
        if sum(d * p for d, p in zip(DEGREES, powers, strict=True)) <= LARGEST
    ]
    relation = written()
    assert len(relation) == 32 and set(relation) <= set(monomials)
    for point in points:
        assert sum(c * monomial(point, powers) for powers, c in relation.items()) == 0
    # Modulo a prime the rank is at most what it is.
    field = GF(2**31 - 1)
    table = [[field(m.numerator) / field(m.denominator) for m in (monomial(p, k) for k in monomials)] for p in points]
    matrix = DomainMatrix(table, (len(points), len(monomials)), field)
    assert len(points) >= len(monomials) and matrix.rank() == len(monomials) - 1
