"""Sizes along streamlines, phases and limit cycles, from Python."""

import numpy as np
import octafield as of
import pytest
from surface_fixtures import grid_triangles, square

SURFACE = of.surface


def ring(around: int = 96, across: int = 20) -> of.TriangleMesh:
    """Radii 1 and 2 in the plane z = 0."""
    row, column = np.divmod(np.arange((across + 1) * around), around)
    radius, angle = 1 + row / across, 2 * np.pi * column / around
    points = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), 0 * angle])
    triangles = grid_triangles(across + 1, around, closed=True)[:, ::-1]
    return of.TriangleMesh(points, triangles)


def along(mesh: of.TriangleMesh, angle) -> of.surface.DirectionField:
    """The cross field at these angles from the x axis, a function of points in a plane."""
    domain = SURFACE.SurfaceDomain(mesh)
    points, edges = np.array(mesh.vertices), np.array(domain.edges)
    sides = points[edges[:, 1]] - points[edges[:, 0]]
    values = np.exp(4j * (angle(points[edges].mean(axis=1)) - np.arctan2(sides[:, 1], sides[:, 0])))
    return SURFACE.DirectionField(symmetry=4, domain=domain, values=values)


def twisted(slope: float) -> of.surface.DirectionField:
    return along(ring(), lambda p: np.arctan2(p[:, 1], p[:, 0]) + slope * (np.hypot(p[:, 0], p[:, 1]) - 1.5))


def test_sums_of_an_odd_function_with_an_offset_keep_their_bias():  # printed in the source, section 4.14.1
    coarse = np.arctan(0.01 * np.arange(-1000, 1001) - 0.001).sum()
    fine = np.arctan(0.001 * np.arange(-10000, 10001) - 0.0001).sum()
    assert coarse == pytest.approx(-0.2942354325, abs=1e-9) and fine == pytest.approx(-0.2942265249, abs=1e-9)
    assert abs(np.arctan(0.01 * np.arange(-1000, 1001)).sum()) < 2e-12


def test_widths_along_circles_and_rays_are_those_of_polar_coordinates():
    field = twisted(0)
    made = SURFACE.size_families(field, SURFACE.surface_singularities(field))
    assert made.converged and made.parts == 1 and made.worst_anisotropy < 1.06
    radius = np.hypot(*np.array(made.positions)[:, :2].T)
    off = made.log_widths.mean(axis=1) - np.log(radius)
    assert np.ptp(off) < 0.1 < np.ptp(np.log(radius)) / 6
    wanted = np.hypot(*np.array(field.domain.vertices)[:, :2].T)
    ratios = SURFACE.size_ratios(field.domain, SURFACE.ReachedSizes(log_sizes=made.log_sizes), wanted)
    assert abs(np.log(ratios)).max() < 0.1


@pytest.mark.parametrize("phase", [0.0, 0.4])
def test_a_torus_has_squares_as_large_as_the_distance_from_its_axis(phase):
    around, across = 64, 32
    i, j = np.divmod(np.arange(around * across), across)
    radius, azimuth, angle = 1 + 0.4 * np.cos(2 * np.pi * j / across), 2 * np.pi * i / around, 2 * np.pi * j / across
    points = np.column_stack([radius * np.cos(azimuth), radius * np.sin(azimuth), 0.4 * np.sin(angle)])
    a, b = np.roll(np.arange(around * across).reshape(around, across), -1, axis=0), np.arange(around * across)
    right, up = a.ravel(), np.roll(b.reshape(around, across), -1, axis=1).ravel()
    corner = np.roll(a, -1, axis=1).ravel()
    mesh = of.TriangleMesh(points, np.concatenate([np.stack(t, axis=1) for t in ((b, right, corner), (b, corner, up))]))
    made = SURFACE.sized_field(mesh, radius)
    along_azimuth = np.column_stack([-points[:, 1], points[:, 0], 0 * radius]) / radius[:, None]
    out = np.array(SURFACE.vertex_normals(mesh))
    d = np.array(made.directions)
    off = np.arctan2(np.einsum("ij,ij->i", np.cross(d, along_azimuth), out), np.einsum("ij,ij->i", d, along_azimuth))
    field = SURFACE.rotated_field(made.field, np.angle(np.exp(4j * off).mean()) / 4 + phase)
    families = SURFACE.size_families(field, SURFACE.surface_singularities(field), spacing=0.15)
    assert families.worst_anisotropy < 1.1 and families.parts == 1
    ratios = SURFACE.size_ratios(mesh, SURFACE.ReachedSizes(log_sizes=families.log_sizes), radius)
    assert abs(np.log(ratios)).max() < 0.1 < np.ptp(np.log(radius)) / 8


def test_the_phase_of_a_bent_field_decides_its_anisotropy():
    field = along(square(16), lambda p: 1.5 * p[:, 0] ** 2)  # not harmonic
    search = SURFACE.phase_search(field, 4, spacing=0.1)
    assert search.worst[search.least_worst] == search.worst.min() < 0.95 * search.worst.max()
    turned = SURFACE.rotated_field(field, search.angles[1])
    again = SURFACE.size_families(turned, SURFACE.surface_singularities(turned), spacing=0.1)
    assert again.worst_anisotropy == search.worst[1]


def test_the_limit_cycle_of_a_twisted_ring_is_removed():
    field = twisted(0.8)
    (cycle,) = SURFACE.limit_cycles(field, SURFACE.surface_singularities(field))
    assert abs(cycle.flux) == pytest.approx(2 * np.pi * 1.5 * 0.8, rel=0.03) and not cycle.crosses_itself
    unwound = SURFACE.without_limit_cycles(field, band_width=0.5)
    assert len(unwound.removed) == 1 and unwound.left == []
    assert all(point.boundary for point in SURFACE.surface_singularities(unwound.field).points)
    middles = SURFACE.edge_midpoints(field.domain)
    outside = abs(np.hypot(middles[:, 0], middles[:, 1]) - 1.5) > 0.26
    assert np.allclose(unwound.field.values[outside], field.values[outside])
    blocked = SURFACE.without_limit_cycles(field, band_width=1.2)
    assert len(blocked.left) == 1 and np.array_equal(blocked.field.values, field.values)


@pytest.mark.parametrize(
    ("options", "kind"),
    [({"spacing": -1}, "bad_option"), ({"power": 0}, "bad_option"), ({"max_length": np.inf}, "non_finite")],
)
def test_bad_options_are_refused(options, kind):
    field = along(square(4), lambda p: p[:, 0])
    points = SURFACE.surface_singularities(field)
    with pytest.raises(of.InvalidInput) as caught:
        SURFACE.size_families(field, points, **options)
    assert caught.value.kind == kind
    field.symmetry = 6
    for call in (SURFACE.size_families, SURFACE.limit_cycles):
        with pytest.raises(of.InvalidInput) as caught:
            call(field, points)
        assert caught.value.kind == "wrong_symmetry"
