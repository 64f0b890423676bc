"""Layouts of four points of valence 3 in the unit disk against closed forms: |dz| = |(P^4 - r^4) (1 - r^4 P^4)|^(-1/4)
|dP| and the like, integrated numerically beforehand (SOURCES of seed 001, found without octafield)."""

from functools import cache

import numpy as np
import octafield as of
import pytest
from quad_mesh_checks import disk

surface = of.surface
SYMMETRIC = (0, 90, 180, 270)
KITE = [(0.85009, angle) for angle in (0, 85, 180, 275)]
GENERAL = [(0.8, 0), (0.7, 83), (0.85, 190), (0.6, 262)]
RADIUS = 0.85009


@cache
def fine_disk():
    return surface.SurfaceDomain(disk(40))


class Layout:
    """Of points of valence 3 at radii and degrees. unit: parameters of the field over those of the closed form."""

    def __init__(self, places, end_tolerance=0.0):
        self.at = [r * np.exp(1j * np.radians(degrees)) for r, degrees in places]
        domain = fine_disk()
        points = [surface.imposed_point(domain, [z.real, z.imag, 0], 1) for z in self.at]
        self.field = surface.impose_singular_points(domain, surface.SingularPattern(points))
        self.found = surface.layout_curves(self.field, end_tolerance=end_tolerance)
        self.number = {v: i for i, v in enumerate(self.field.point_vertices.tolist())} | {-1: -1}
        self.points = np.asarray(self.field.field.domain.vertices)
        z = self.points[:, 0] + 1j * self.points[:, 1]
        far = np.min([abs(z - a) for a in self.at], axis=0) > 0.2
        exact = sum((np.log(abs(z[far] - a)) + np.log(abs(1 - np.conj(a) * z[far]))) / 4 for a in self.at)
        self.unit = np.exp(np.mean(exact - np.asarray(self.field.log_size)[far]))

    def curves(self):
        """Points at the ends, length in quad coordinates, length in the plane, offset, of each."""
        edges = np.asarray(self.field.field.domain.edges)
        for curve in self.found.curves:
            ends, vertices = edges[np.maximum(curve.edges, 0)], np.asarray(curve.vertices)
            inner = (1 - curve.fractions[:, None]) * self.points[ends[:, 0]]
            inner += curve.fractions[:, None] * self.points[ends[:, 1]]
            places = np.where((vertices >= 0)[:, None], self.points[np.maximum(vertices, 0)], inner)
            length = np.linalg.norm(np.diff(places, axis=0), axis=1).sum()
            number = self.number[curve.first_vertex], self.number[curve.last_vertex]
            yield number, curve.lengths[-1] / self.unit, length, abs(curve.offset) / self.unit

    def offsets(self):
        """By pairs of points, the lower first."""
        return {tuple(sorted(pair)): offset for pair, _, _, offset in self.curves() if pair[1] >= 0}


@pytest.mark.parametrize(
    ("radius", "a", "b", "area"),
    [
        (0.5, 1.571180408, 0.820325648, 7.624126221),
        (0.7, 1.576587650, 0.482848568, 5.530640979),
        (0.8500923, 1.600959759, 0.280557937, 4.359720020),
        (0.9, 1.622602237, 0.214947913, 4.027937881),
    ],
)
def test_four_points_on_a_circle_give_a_square_and_four_rectangles(radius, a, b, area):
    layout = Layout([(radius, angle) for angle in SYMMETRIC])
    assert layout.found.traced == 12 and len(layout.found.curves) == 8
    inner = [length for pair, length, _, _ in layout.curves() if pair[1] >= 0]
    outer = [length for pair, length, _, _ in layout.curves() if pair[1] < 0]
    assert inner == pytest.approx([a] * 4, rel=0.008) and outer == pytest.approx([b] * 4, rel=0.018)
    assert layout.found.parameter_area / layout.unit**2 == pytest.approx(area, rel=0.003)


@pytest.mark.parametrize(("radius", "ratio"), [(5**0.5 - 2, 1), (2 * np.sin(np.radians(15)), 0.5)])
def test_two_radii_give_squares_and_half_squares(radius, ratio):
    layout = Layout([(radius, angle) for angle in SYMMETRIC])
    lengths = {inner: [x for p, x, _, _ in layout.curves() if (p[1] >= 0) == inner] for inner in (True, False)}
    assert np.mean(lengths[False]) / np.mean(lengths[True]) == pytest.approx(ratio, rel=0.01)


@pytest.mark.parametrize(
    ("radius", "turned", "either"),
    [(RADIUS, 1, (1.22e-3, 1.19e-3)), (RADIUS, 5, (6.35e-3, 5.70e-3)), (0.5, 5, (1.45e-2, 1.45e-2))],
)
def test_a_point_that_is_turned_misses_its_neighbours_by_the_closed_form(radius, turned, either):
    offsets = Layout([(radius, turned), *((radius, angle) for angle in SYMMETRIC[1:])], 0.06).offsets()
    found = sorted(offsets[0, other] for other in (1, 3))
    assert found == pytest.approx(sorted(either), abs=1.5e-3)
    assert found[1] > 0.5 * min(either)  # an offset in space is below 2e-3 up to 5 degrees


def test_the_kite_misses_by_its_offsets_and_has_a_closed_separatrix():
    offsets = Layout(KITE, 0.06).offsets()
    assert sorted(offsets) == [(0, 1), (0, 3), (1, 2), (2, 3)]
    assert offsets[0, 1] == pytest.approx(1.18e-2, abs=1.5e-3) and offsets[0, 3] == pytest.approx(1.18e-2, abs=1.5e-3)
    assert offsets[1, 2] == pytest.approx(1.23e-2, abs=3e-3) and offsets[2, 3] == pytest.approx(1.23e-2, abs=3e-3)
    ends = list(Layout(KITE, 0.004).curves())
    (loop,) = [curve for curve in ends if curve[0][0] == curve[0][1]]
    assert loop[0] == (2, 2) and loop[2] == pytest.approx(4.916, rel=2e-3)
    assert [pair for pair, *_ in ends if pair[1] >= 0 and pair[0] != pair[1]] in ([(1, 3)], [(3, 1)])
    assert len(ends) == 10  # 12 traces: one pair joined, two the loop, eight to the boundary


def test_points_in_general_places_have_one_closed_separatrix():
    ends = list(Layout(GENERAL).curves())
    (loop,) = [curve for curve in ends if curve[0][1] >= 0]
    assert loop[0] == (2, 2) and loop[2] == pytest.approx(4.626, rel=2e-3)
    outer = [length for pair, _, length, _ in ends if pair[1] < 0]
    assert len(outer) == 10 and max(outer) == pytest.approx(2.52, abs=0.005)
