"""Cross fields for sizes, and the sizes of cross fields, from Python."""

import numpy as np
import octafield as of
import pytest
from surface_fixtures import cylinder, square

SURFACE = of.surface


def exponential(points: np.ndarray) -> np.ndarray:
    return np.exp(1.5 * points[:, 0])


def test_sizes_are_a_function_an_array_or_both_with_middles():
    mesh = square(8)
    points, middles = np.array(mesh.vertices), SURFACE.edge_midpoints(mesh)
    called = SURFACE.wanted_sizes(mesh, exponential)
    for sizes in (
        SURFACE.wanted_sizes(mesh, exponential(points), exponential(middles)),
        SURFACE.wanted_sizes(mesh, exponential(points)),  # linear in the logarithm: the same
    ):
        assert np.allclose(sizes.turns, called.turns, atol=1e-12)
    edges = np.array(SURFACE.edge_topology(mesh).edges)
    assert np.allclose(called.turns, 1.5 * (points[edges[:, 1]] - points[edges[:, 0]])[:, 1], atol=1e-12)


@pytest.mark.parametrize("symmetry", [1, 4, 6])
def test_an_exponential_size_is_reached(symmetry):
    mesh = square(10)
    made = SURFACE.sized_field(
        mesh, exponential, symmetry=symmetry, boundary_alignment="none", feature_alignment="none"
    )
    assert made.converged and abs(made.eigenvalue) < 1e-9 and len(made.unresolved) == 0
    turned = (made.directions[:, 0] + 1j * made.directions[:, 1]) ** symmetry
    turned = turned * np.exp(-1j * symmetry * 1.5 * np.array(mesh.vertices)[:, 1])
    assert np.allclose(turned, turned[0], atol=1e-6)
    reached = SURFACE.reached_sizes(made.field)
    assert reached.misfit < 1e-5
    assert np.allclose(SURFACE.size_ratios(mesh, reached, exponential(np.array(mesh.vertices))), 1, atol=1e-5)


def test_the_metric_of_the_sizes_serves_every_method():
    mesh = square(12)
    domain = SURFACE.sized_domain(mesh, exponential(np.array(mesh.vertices)))
    assert domain.has_own_lengths
    made = SURFACE.sized_field(mesh, exponential)
    for method in SURFACE.direction_field_methods:
        field = SURFACE.restricted_field(SURFACE.direction_field(domain, method=method), mesh)
        found = SURFACE.surface_singularities(field)
        assert found.agree and found.boundary_deviation == 0
        inside = [p.index_times_symmetry for p in found.points if not p.boundary]
        same = [p.index_times_symmetry for p in SURFACE.surface_singularities(made.field).points if not p.boundary]
        assert sum(inside) == sum(same)
    with pytest.raises(of.InvalidInput) as caught:
        SURFACE.direction_field(domain, constraints=SURFACE.DirectionConstraints([[0, 1]], [[1, 0, 0]]))
    assert caught.value.kind == "own_lengths"
    with pytest.raises(of.GeometryError) as caught:
        SURFACE.sized_domain(mesh, np.exp(60 * np.array(mesh.vertices)[:, 0]))
    assert caught.value.kind == "no_triangle"


def test_sizes_that_grow_along_a_cylinder_turn_the_field_round_it():
    # By 2 pi times the rate: 1.6 quarter turns at 0.4, one at 0.25. What is missing from whole ones is the eigenvalue.
    mesh = cylinder(1.0, 2.0, 48, 16)
    for rate, eigenvalue in ((0.4, 0.16), (0.25, 0)):
        made = SURFACE.sized_field(mesh, lambda p, rate=rate: np.exp(rate * p[:, 2]), boundary_alignment="none")
        assert made.eigenvalue == pytest.approx(eigenvalue, rel=0.02, abs=1e-3)


def test_boundary_sizes_and_those_of_a_larger_region():
    mesh = square(6)
    sizes = SURFACE.boundary_sizes(mesh, growth=0.4, largest=0.3)
    assert sizes.min() == pytest.approx(1 / 6) and sizes.max() == pytest.approx(0.3)
    region = SURFACE.extended_region(mesh, margin=0.4)
    assert (region.vertices, region.triangles) == (49, 72)
    wider = SURFACE.extended_sizes(region, sizes)
    assert np.array_equal(wider[:49], sizes) and np.allclose(wider[49:], 1 / 6)
    made = SURFACE.sized_field(region.mesh, wider, boundary_alignment="none")
    field = SURFACE.restricted_field(made.field, mesh)
    assert len(field.values) == len(SURFACE.edge_topology(mesh).edges)


@pytest.mark.parametrize(
    ("call", "kind"),
    [
        (lambda m: SURFACE.sized_field(m, np.full(81, -1.0)), "bad_size"),
        (lambda m: SURFACE.sized_field(m, np.full(81, np.nan)), "bad_size"),
        (lambda m: SURFACE.sized_field(m, np.ones(7)), "wrong_size"),
        (lambda m: SURFACE.sized_field(m, lambda p: p), "wrong_shape"),
        (lambda m: SURFACE.sized_field(m, exponential, s=np.nan), "non_finite"),
        (lambda m: SURFACE.sized_field(m, exponential, symmetry=0), "bad_option"),
        (lambda m: SURFACE.sized_field(m, exponential, shift=1e9), "shift_too_large"),
        (lambda m: SURFACE.sized_field(m, exponential, directions=np.ones((3, 3))), "wrong_size"),
        (lambda m: SURFACE.sized_field(m, exponential, weights=np.ones(81)), "wrong_size"),
        (lambda m: SURFACE.boundary_sizes(m, growth=-1), "bad_option"),
        (lambda m: SURFACE.extended_region(m, margin=-1), "bad_option"),
        (lambda m: SURFACE.restricted_field(SURFACE.sized_field(m, exponential).field, square(9)), "wrong_mesh"),
        (lambda m: SURFACE.size_ratios(m, SURFACE.ReachedSizes(), np.ones(81)), "wrong_size"),
        (lambda m: SURFACE.extended_sizes(SURFACE.ExtendedRegion(m, 81, 9999), np.ones(81)), "wrong_mesh"),
        (lambda m: SURFACE.extended_sizes(SURFACE.ExtendedRegion(m, -1, -1), np.ones(81)), "wrong_size"),
    ],
)
def test_bad_input_is_refused_with_a_kind(call, kind):
    with pytest.raises(of.Error) as caught:
        call(square(8))
    assert caught.value.kind == kind


def test_errors_of_functions_that_give_sizes_come_through():
    def broken(points):
        raise ZeroDivisionError("in the user's function")

    with pytest.raises(ZeroDivisionError):
        SURFACE.sized_field(square(3), broken)


def test_the_same_bits_on_every_run_and_the_best_state_when_cancelled():
    mesh = square(10)
    sizes = 1 + np.array(mesh.vertices)[:, 0] ** 2
    one, other = (SURFACE.sized_field(mesh, sizes, boundary_alignment="none", seed=3) for _ in range(2))
    assert one.values.tobytes() == other.values.tobytes() and one.converged
    calls = []

    def few(phase: str, fraction: float, merit: float) -> bool:
        calls.append(phase)
        return len(calls) < 3

    stopped = SURFACE.sized_field(mesh, sizes, boundary_alignment="none", progress=few)
    assert not stopped.converged and stopped.iterations == 1 and np.isfinite(stopped.values).all()
    with pytest.raises(of.Cancelled):
        SURFACE.sized_field(mesh, sizes, progress=lambda *_: False)


def test_sizes_from_curvature_are_segments_round_a_bend():
    mesh = cylinder(1.0, 2.0, 64, 20)
    segments = 24
    sizes = SURFACE.size_field(mesh, SURFACE.FeatureGraph(), angle=2 * np.pi / segments, longest=2.0).lengths
    inside = abs(np.array(mesh.vertices)[:, 2] - 1) < 0.5
    assert np.median(sizes[inside]) == pytest.approx(2 * np.pi / segments, rel=0.05)
    assert SURFACE.surface_singularities(SURFACE.sized_field(mesh, sizes).field).agree
