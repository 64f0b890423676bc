"""What L. Simons (UC Davis 2024) and its check print of sizes and quads and no other test holds."""

import numpy as np
import octafield as of
import pytest
from octafield.domain.inputs import from_mesh
from octafield.quad_mesh.sized import size_at
from quad_mesh_checks import require_conforming
from surface_fixtures import square
from test_quad_mesh import coast, ring

SURFACE = of.surface


@pytest.mark.parametrize("valence", [2, 3, 5, 6])
def test_a_field_round_a_point_turns_by_a_quarter_for_each_quad_that_is_missing(valence):
    """Sizes r^((4 - v) / 4) have it (complex powers; figure 3.9: + pi / 2 for valence 3, pi for 2)."""
    plate = ring()
    power = (4 - valence) / 4
    turns = np.array(SURFACE.wanted_sizes(plate, lambda p: np.linalg.norm(p, axis=1) ** power).turns)
    edges = np.array(SURFACE.SurfaceDomain(plate).edges)
    inner = (edges < 48).all(axis=1)  # the circle of radius 1
    start, end = edges[inner].T
    sign = np.where((end - start) % 48 == 1, 1, -1)
    assert inner.sum() == 48 and (sign * turns[inner]).sum() == pytest.approx(power * 2 * np.pi, rel=2e-3)


def test_growth_by_a_third_doubles_over_three_edges():
    """Figure 3.15."""
    plate = square(12)
    there = size_at("growth=0.3333333333333333", from_mesh(plate))(np.array([[0.5, 0.0, 0], [0.5, 3 / 12, 0]]))
    np.testing.assert_allclose(there, [1 / 12, 2 / 12])


def test_the_boundary_has_twice_as_many_edges_as_vertices_less_quads_and_one():
    """So it is even, whatever the quads. 1.1.1 prints V - F - 2, which one quad contradicts."""
    kept = of.compute_quad_mesh([coast()], quad_options=of.QuadMeshOptions(keep_boundary=True)).mesh
    one = SURFACE.QuadMesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], quads=[[0, 1, 2, 3]])
    for mesh in (kept, one):
        _, rim = require_conforming(mesh, 1)
        assert len(rim) == 2 * (len(mesh.vertices) - len(mesh.quads) - 1)


def step_turns(plate):
    """(3.5): atan2(sigma_y S_x - sigma_x S_y, sigma + sigma_x S_x + sigma_y S_y) of sigma = e^x, means over both ends;
    its sign is that of the parallel transport, the field's is the other one."""
    points, edges = np.array(plate.vertices), np.array(SURFACE.SurfaceDomain(plate).edges)
    step = points[edges[:, 1]] - points[edges[:, 0]]
    sigma = np.exp(points[:, 0])[edges].mean(axis=1)
    return np.arctan2(sigma * step[:, 1], sigma + sigma * step[:, 0])


def test_the_printed_step_leaves_an_eigenvalue_that_the_exact_edge_integrals_do_not():
    """Its 9.2e-3 and 2.5e-3 are of jittered meshes of h = 1/16 and 1/32 that are not told: falling about as h^2, and
    its angles' errors, 0.70 and 0.35 degrees, as h."""
    found = []
    for n in (16, 32):
        plate = square(n)
        sizes = SURFACE.wanted_sizes(plate, lambda p: np.exp(p[:, 0]))
        exact = SURFACE.sized_field(plate, sizes, boundary_alignment="none")
        assert abs(exact.eigenvalue) < 1e-7
        sizes.turns = step_turns(plate)
        stepped = SURFACE.sized_field(plate, sizes, boundary_alignment="none")
        errors = []
        for field in (exact, stepped):
            x, y = np.array(field.directions)[:, :2].T
            off = np.exp(4j * (np.arctan2(y, x) - np.array(plate.vertices)[:, 1]))
            errors.append(np.degrees(abs(np.angle(off / off.mean())).max() / 4))
        assert errors[0] < 1e-3
        found.append((stepped.eigenvalue, errors[1]))
    (coarse, wide), (fine, narrow) = found
    assert 3e-3 < coarse < 1.5e-2 and 3 < coarse / fine < 4.5
    assert 0.3 < wide < 1.5 and 1.7 < wide / narrow < 2.3


def test_a_strip_whose_sizes_double_has_quads_that_grow_without_irregular_ones():
    """Figure 3.21a: no singular points, about twice the size along; sides that are held let less of it happen."""
    mesh = of.compute_quad_mesh(square(24), of.SurfaceFieldOptions(remesh=False), sizes=lambda p: 0.05 * (1 + p[:, 0]))
    assert mesh.record.irregular_vertices == {}
    corners = np.asarray(mesh.mesh.vertices)[np.asarray(mesh.mesh.quads)]
    areas = np.linalg.norm(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]), axis=1) / 2
    x = corners[:, :, 0].mean(axis=1)
    grown = np.sqrt(np.median(areas[x > 0.85]) / np.median(areas[x < 0.15]))
    assert 1.1 < grown < 2
