"""Curves along direction fields, and the energies of critical points."""

import numpy as np
import octafield as of
import pytest
from surface_fixtures import at_angle, square


@pytest.fixture(scope="module")
def flat():
    """The unit square, its field of axes and the four corners."""
    field = of.surface.direction_field(square(6))
    return field, of.surface.surface_singularities(field)


@pytest.fixture(scope="module")
def on_sphere(sphere):
    field = of.surface.direction_field(sphere)
    return field, of.surface.surface_singularities(field)


def test_streamlines_of_a_constant_field_are_straight_and_cross_the_square(flat):
    mesh = flat[0].domain
    triangles = [12, 30, 59]
    lines = of.surface.streamlines(*flat, triangles, [at_angle(0.2), at_angle(np.pi / 2), [-3.0, 0, 0]])
    centres = mesh.vertices[mesh.triangles[triangles]].mean(axis=1)
    for line, centre, axis in zip(lines, centres, (0, 1, 0), strict=True):
        assert line.points.dtype == np.float64 and len(line.triangles) == len(line.points) - 1
        np.testing.assert_allclose(line.points[:, 1 - axis], centre[1 - axis], atol=1e-6)
        assert line.length == pytest.approx(1) and line.first_end == line.last_end == "boundary"
    assert lines[0].points[0, 0] == pytest.approx(0) and lines[2].points[0, 0] == pytest.approx(1)


def test_streamlines_start_at_the_weights_and_end_where_asked(flat):
    mesh = flat[0].domain
    start = mesh.vertices[mesh.triangles[20]].T @ [0.2, 0.3, 0.5]
    (line,) = of.surface.streamlines(*flat, [20], [at_angle(0)], [[0.2, 0.3, 0.5]], both_ways=False, max_length=0.1)
    np.testing.assert_allclose(line.points[0], start, atol=1e-6)
    np.testing.assert_allclose(line.points[-1], start + [0.1, 0, 0], atol=1e-6)
    assert (line.first_end, line.last_end, line.first_singularity) == ("seed", "length", -1)
    assert of.surface.streamlines(*flat, [], []) == []


def test_streamlines_stop_at_features_unless_told_not_to(flat):
    plain, found = flat
    mesh = plain.domain.mesh
    middle = np.flatnonzero(np.isclose(mesh.vertices[:, 0], 0.5))
    features = of.surface.feature_graph(mesh, np.column_stack([middle[:-1], middle[1:]]))
    field = of.surface.DirectionField(4, plain.domain.with_features(features), plain.values)
    (stopped,) = of.surface.streamlines(field, found, [12], [at_angle(0)])
    (through,) = of.surface.streamlines(field, found, [12], [at_angle(0)], stop_at_features=False)
    assert stopped.last_end == "feature" and stopped.length == pytest.approx(0.5)
    assert through.last_end == "boundary" and through.length == pytest.approx(1)


@pytest.mark.parametrize("symmetry", [2, 4, 6])
def test_every_singular_point_has_its_separatrices(sphere, symmetry):
    field = of.surface.direction_field(sphere, symmetry=symmetry, method="mbo")
    found = of.surface.surface_singularities(field)
    lines, edge = (
        of.surface.separatrices(field, found, max_length=1.0),
        of.surface.mean_edge_length(sphere),
    )
    assert len(found.points) >= 2 * symmetry - 2
    for place, point in enumerate(found.points):
        from_here = [line for line in lines if line.first_singularity == place]
        assert len(from_here) == symmetry - point.index_times_symmetry
        for line in from_here:
            assert line.first_end == "singularity" and line.length < 1 + 2 * edge  # the straight start is beside it
            np.testing.assert_allclose(line.points[0], point.position, atol=1e-12)
            if line.last_end == "singularity":
                gap = np.linalg.norm(line.points[-1] - found.points[line.last_singularity].position)
                assert gap < edge
            else:
                assert (line.last_end, line.last_singularity) == ("length", -1)


def test_the_separatrices_of_a_cube_are_its_edges(box_surface, box_features):
    field = of.surface.direction_field(of.surface.SurfaceDomain(box_surface, box_features))
    found = of.surface.surface_singularities(field)
    assert of.surface.separatrices(field, found) == []
    plain = of.surface.DirectionField(4, of.surface.SurfaceDomain(box_surface), field.values)
    traced = of.surface.separatrices(plain, found)  # the same field, its edges no features
    assert len(traced) == 24 and all(line.length == pytest.approx(1, abs=0.15) for line in traced)


def test_even_streamlines_cover_the_square(flat):
    lines = of.surface.even_streamlines(*flat, spacing=0.1)
    along = [np.abs(line.points[-1] - line.points[0]).argmax() for line in lines]
    assert set(along) == {0, 1}
    for family in (0, 1):
        total = sum(line.length for line, axis in zip(lines, along) if axis == family)
        assert 5 < total < 20  # the area over the spacing is 10; neighbours are between half of it and twice it
    assert len(of.surface.even_streamlines(*flat, spacing=0.05)) > len(lines)
    assert all(line.length >= 0.9 for line in of.surface.even_streamlines(*flat, spacing=0.1, min_length=0.9))


def test_a_stopped_trace_is_cancelled(on_sphere):
    for call in (of.surface.separatrices, of.surface.even_streamlines):
        reports: list = []
        call(*on_sphere, progress=lambda *report, reports=reports: reports.append(report[0]))
        assert reports and all(isinstance(phase, str) for phase in reports)
        with pytest.raises(of.Cancelled):
            call(*on_sphere, progress=lambda phase, fraction, merit: False)


def test_seeds_that_do_not_fit_are_named(flat):
    x, up = at_angle(0), [0.0, 0, 1]
    for triangles, directions, weights, kind in (
        ([0, 72], [x, x], None, "bad_seed"), ([0, -1], [x, x], None, "bad_seed"), ([0, 1], [x, up], None, "bad_seed"),
        ([0, 1], [x, 0 * x], None, "bad_seed"), ([0, 1], [x, x], [[1, 0, 0], [1, 1, 1]], "bad_seed"),
        ([0, 1], [x, x], [[1, 0, 0], [2, -1, 0]], "bad_seed"), ([0, 1], [x, [np.nan, 0, 0]], None, "non_finite"),
    ):  # fmt: skip
        with pytest.raises(of.InvalidInput) as caught:
            of.surface.streamlines(*flat, triangles, directions, weights)
        assert caught.value.kind == kind and caught.value.elements == [1]
    for triangles, directions, weights in (([0], [x, x], None), ([0, 1], [x, x], [[1, 0, 0]]), ([0.5], [x], None)):
        with pytest.raises(of.InvalidInput, match="directions|weights|triangles"):
            of.surface.streamlines(*flat, triangles, directions, weights)


def test_options_and_points_that_do_not_fit_are_refused(flat, on_sphere):
    field, found = flat
    for options in ({"spacing": -1.0}, {"spacing": np.nan}, {"spacing": 1e-9}, {"stop_ratio": 0.0}, {"stop_ratio": 2.0},
                    {"min_length": -1.0}, {"max_length": -1.0}, {"singular_radius": np.inf}):  # fmt: skip
        with pytest.raises(of.InvalidInput, match=next(iter(options))):
            of.surface.even_streamlines(*flat, **options)
    nowhere = [of.surface.SurfaceSingularity([0, 0, 0], 1, 0.25, triangle, vertex) for triangle, vertex in
               ((72, -1), (-1, 49), (-1, -1), (0, -2))]  # fmt: skip
    lost = of.surface.SurfaceSingularity([np.nan, 0, 0], 1, 0.25, 0, -1)
    endless = of.surface.SurfaceSingularity([0, 0, 0], -(2**31), 0.25, 0, -1)
    for point in (*nowhere, lost, endless):
        with pytest.raises(of.InvalidInput, match="singularities.points") as caught:
            of.surface.separatrices(field, of.surface.SurfaceSingularities([point]))
        assert caught.value.elements == [0]
    with pytest.raises(of.InvalidInput, match="not on the mesh"):
        of.surface.separatrices(on_sphere[0], found)


def test_energies_of_points_are_their_formulas():
    rng = np.random.default_rng(4)
    a = 0.9 * np.sqrt(rng.random(5)) * np.exp(2j * np.pi * rng.random(5))
    pairs = np.abs(a[:, None] - a) + np.eye(5)
    expected = -np.pi * np.log(pairs).sum() - np.pi * np.log(np.abs(1 - a[:, None] * a.conj())).sum()
    assert of.surface.disk_renormalised_energy(a) == pytest.approx(expected)
    radii = np.linspace(0.5, 0.99, 2001)
    energies = [of.surface.disk_polygon_energy(4, r) for r in radii]
    polygon = 0.7 * np.exp(0.5j * np.pi * np.arange(4))
    assert of.surface.disk_polygon_energy(4, 0.7) == pytest.approx(of.surface.disk_renormalised_energy(polygon))
    assert of.surface.disk_polygon_radius(4) == pytest.approx(radii[np.argmin(energies)], abs=3e-4)
    x = rng.standard_normal((8, 3))
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    logs = -np.log(np.linalg.norm(x[:, None] - x, axis=2) + np.eye(8)).sum() / 2
    assert of.surface.logarithmic_energy(x) == pytest.approx(logs)
    assert of.surface.sphere_renormalised_energy(x) == pytest.approx(2 * np.pi * logs + 64 * np.pi * (np.log(2) - 0.5))
    assert of.surface.asymptotic_energy(8, 3.0, 0.1) == pytest.approx(
        8 * np.pi * np.log(10) + 3 + 8 * of.surface.core_energy
    )


def test_the_field_of_the_sphere_finds_nearly_the_least_energy(on_sphere):
    points = np.array([p.position / np.linalg.norm(p.position) for p in on_sphere[1].points])
    assert len(points) == 8
    assert of.surface.logarithmic_energy(points) == pytest.approx(-10.428018, abs=0.05)  # of the square antiprism


@pytest.mark.parametrize(
    "call",
    [
        lambda: of.surface.disk_renormalised_energy([0.5, 1.5]),
        lambda: of.surface.disk_renormalised_energy([0.5, 0.5]),
        lambda: of.surface.disk_renormalised_energy([np.nan]),
        lambda: of.surface.disk_polygon_energy(0, 0.5),
        lambda: of.surface.disk_polygon_energy(4, 1.0),
        lambda: of.surface.disk_polygon_radius(0),
        lambda: of.surface.logarithmic_energy(np.ones((2, 3))),
        lambda: of.surface.logarithmic_energy([[np.inf, 0, 0]]),
        lambda: of.surface.sphere_renormalised_energy([[0, 0, 1.0]]),
        lambda: of.surface.sphere_renormalised_energy([[0, 0, 2.0], [0, 0, -1]]),
        lambda: of.surface.asymptotic_energy(-1, 0.0, 0.1),
        lambda: of.surface.asymptotic_energy(8, np.nan, 0.1),
        lambda: of.surface.asymptotic_energy(8, 0.0, 2.0),
    ],
)
def test_points_without_an_energy_are_refused(call):
    with pytest.raises(of.InvalidInput):
        call()
