"""Options of surface fields from file to result: curvature, constraints, features of the file, stopping."""

import json

import numpy as np
import octafield as of
import pytest
from octafield.domain.inputs import read_input
from octafield.domain.meshing import prepare_mesh
from octafield.fields.direction_field import compute_surface_field
from octafield.options import SurfaceFieldOptions
from pipeline_fixtures import SHARED_TETS, octafield, shared, write_sphere
from surface_fixtures import cylinder, grid_triangles, square

AS_IT_IS = {"remesh": False, "features": "none"}


def torus(around=40, across=20):
    i, j = np.divmod(np.arange(around * across), across)
    phi, theta = 2 * np.pi * i / around, 2 * np.pi * j / across
    radius = 1 + 0.5 * np.cos(theta)
    points = np.column_stack([radius * np.cos(phi), radius * np.sin(phi), 0.5 * np.sin(theta)])
    cells = grid_triangles(around + 1, across, closed=True) % (around * across)
    return of.TriangleMesh(points, cells[:, ::-1])


def bumpy_cylinder():
    straight = cylinder(radius=1.0, height=4.0, around=40, along=40)
    points = np.array(straight.vertices)
    points[:, :2] *= (1 + 0.15 * np.cos(np.pi * points[:, 2]))[:, None]
    return of.TriangleMesh(points, straight.triangles)


def degrees_off(mesh, field, wanted):
    """Per triangle, between the nearest of the four directions and the part of `wanted` in its plane."""
    normals, found = of.surface.triangle_normals(mesh), of.surface.triangle_directions(field)
    along = np.abs((found * wanted).sum(axis=1))
    across = np.abs((found * np.cross(normals, wanted)).sum(axis=1))
    return np.degrees(np.arctan2(np.minimum(along, across), np.maximum(along, across)))


def round_the_axis(mesh):
    x, y, _ = mesh.vertices[mesh.triangles].mean(axis=1).T
    return np.column_stack([-y, x, 0 * x]) / np.hypot(x, y)[:, None]


@pytest.mark.parametrize("make", [torus, bumpy_cylinder])
def test_curvature_makes_the_field_follow_the_lines_of_curvature(make):
    mesh = make()
    # The other methods try the lines of curvature by themselves.
    free, held = (
        compute_surface_field(
            mesh, SurfaceFieldOptions(curvature=weight, method="eigen", boundary_alignment="none", **AS_IT_IS)
        )
        for weight in (0, 1)
    )
    assert degrees_off(mesh, free.direction_field, round_the_axis(mesh)).mean() > 10
    assert degrees_off(mesh, held.direction_field, round_the_axis(mesh)).max() < 0.5
    assert len(held.singularities.points) == 0 and held.record["options"]["curvature"] == 1


def test_curvature_counts_by_its_weight_and_where_the_curvatures_differ(sphere):
    ellipsoid = of.TriangleMesh(sphere.vertices * [3, 2, 1], sphere.triangles)
    lines = of.surface.principal_directions(ellipsoid)
    clear = lines.anisotropy > 0.4
    means = []
    for weight in (0.0, 1.0, 100.0):
        result = compute_surface_field(ellipsoid, SurfaceFieldOptions(curvature=weight, **AS_IT_IS))
        assert result.singularities.agree
        means.append(degrees_off(ellipsoid, result.direction_field, lines.directions)[clear].mean())
    assert means[0] > 2 * means[1] > 4 * means[2] and means[2] < 1


def test_curvature_on_the_command_line(tmp_path):
    out = tmp_path / "out"
    arguments = (write_sphere(tmp_path), "-o", out, "--no-remesh", "-q")
    octafield("surface-field", *arguments, "--curvature", 2, "--least-feature-angle", 10, check=0)
    options = json.loads((out / "result.json").read_text())["options"]
    assert options["curvature"] == 2 and options["least_feature_angle"] == pytest.approx(np.radians(10))
    for wrong in (("--curvature", -1), ("--curvature", "nan"), ("--curvature", 1, "--symmetry", 3),
                  ("--least-feature-angle", 200), ("--symmetry", 1001)):  # fmt: skip
        octafield("surface-field", *arguments, *wrong, check=2)


def test_constraints_and_guides_reach_the_field_of_a_prepared_surface():
    mesh = square(8)
    options = SurfaceFieldOptions(boundary_alignment="none", **AS_IT_IS)
    meshed = prepare_mesh(mesh, options, volume=False)
    direction = [np.cos(0.3), np.sin(0.3), 0]
    asked = of.surface.DirectionConstraints(vertices=[40], vertex_directions=[direction])
    result = compute_surface_field(meshed, options, constraints=asked)
    assert np.abs(result.directions @ direction).max() == pytest.approx(1, abs=1e-9)
    assert result.record["constraints"] == 1
    guide = of.surface.DirectionGuide(np.tile(direction, (len(mesh.triangles), 1)))
    guided = compute_surface_field(meshed, options, guide=guide)
    assert degrees_off(mesh, guided.direction_field, np.array(direction)).max() < 1e-6
    with pytest.raises(of.InvalidInput, match="prepare_mesh"):
        compute_surface_field(mesh, options, constraints=asked)
    with pytest.raises(of.InvalidInput, match="curvature"):
        compute_surface_field(meshed, SurfaceFieldOptions(curvature=1, **AS_IT_IS), guide=guide)


def test_stopping_keeps_the_best_field_there_is(sphere):
    def stopped_when(phase, fraction=-1.0):
        return compute_surface_field(
            sphere, SurfaceFieldOptions(**AS_IT_IS), lambda p, done, merit: not (p == phase and done >= fraction)
        )

    for phase in ("read", "mesh"):
        with pytest.raises(of.Cancelled):
            stopped_when(phase)
    early = stopped_when("surface")
    assert early.record["stopped"] and not early.record["converged"] and early.singularities.agree
    late = stopped_when("surface", 0.9)  # while curves are traced
    assert late.record["stopped"] and late.record["converged"] and len(late.singularities.points) == 8
    assert len(early.separatrices) == len(late.separatrices) == 0
    whole = stopped_when("nothing")
    assert not whole.record["stopped"] and len(whole.separatrices) == 24
    with pytest.raises(ZeroDivisionError):
        compute_surface_field(sphere, SurfaceFieldOptions(**AS_IT_IS), lambda *report: 1 / 0)


def test_answers_that_are_neither_true_nor_false_are_the_callers_error(sphere):
    with pytest.raises(ValueError, match="ambiguous"):
        of.surface.direction_field(sphere, progress=lambda *report: np.zeros(3))
    assert not of.surface.direction_field(sphere, progress=lambda *report: 0).converged


def test_the_files_features_go_before_the_angle_and_seams_are_none():
    path = shared(SHARED_TETS / "s10c.vtk.gz")
    source = read_input(path)
    assert any("3 seam edges" in note for note in source.notes)
    by_default, by_file, by_angle, none = (
        prepare_mesh(path, SurfaceFieldOptions(features=word), volume=False)
        for word in ("default", "file", "angle", "none")
    )
    assert by_default.feature_source == by_file.feature_source == "file"
    np.testing.assert_array_equal(by_default.features.edges, by_file.features.edges)
    assert by_angle.feature_source == "angle" and len(none.features.edges) == 0
    field = compute_surface_field(path, SurfaceFieldOptions(features="file")).direction_field
    followed = {tuple(edge) for edge in by_file.features.edges.tolist()}
    on = np.array([tuple(edge) in followed for edge in field.domain.edges.tolist()])
    assert (np.abs(field.values[on] - 1) < 1e-12).mean() > 0.8  # all but those at corners no field can follow
    assert (np.abs(field.values[~on] - 1) < 1e-12).mean() < 0.05


def test_flat_feature_edges_are_followed_or_not_as_asked(tmp_path):
    mesh = square(8)
    middle = np.flatnonzero(np.isclose(mesh.vertices[:, 0], 0.5))
    diagonal = [[0, 10], [10, 20]]  # edges of the mesh, at 45 degrees to its sides
    features = of.surface.feature_graph(mesh, diagonal + np.column_stack([middle[:-1], middle[1:]]).tolist())
    on = [tuple(edge) in {(0, 10), (10, 20)} for edge in of.surface.edge_topology(mesh).edges.tolist()]
    follows = lambda **more: np.abs(
        of.surface.direction_field(of.surface.SurfaceDomain(mesh, features), **more).values[on] - 1
    )
    assert follows(boundary_alignment="none").min() < 1e-12
    assert follows(least_feature_angle=1e-6).min() > 1


# ---- what a script can get wrong


@pytest.fixture(scope="module")
def flat():
    field = of.surface.direction_field(square(5))
    return field, of.surface.surface_singularities(field)


def test_fields_of_any_size_are_traced_and_those_without_numbers_refused(flat):
    field, found = flat
    usual = of.surface.even_streamlines(*flat)
    for size in (1e300, 1e-300):
        scaled = of.surface.DirectionField(4, field.domain, field.values * size)
        lines = of.surface.even_streamlines(scaled, found)
        assert sum(line.length for line in lines) == pytest.approx(sum(line.length for line in usual), rel=1e-3)
        assert of.surface.separatrices(scaled, found) == []
    for values, symmetry in (
        (field.values * np.nan, 4),
        (field.values[:5], 4),
        (field.values, 0),
        (field.values, 1001),
    ):
        wrong = of.surface.DirectionField(symmetry, field.domain, values)
        for call in (of.surface.triangle_directions, of.surface.surface_singularities):
            with pytest.raises(of.InvalidInput, match="field"):
                call(wrong)


def test_singular_points_away_from_their_triangle_are_refused(flat):
    field, _ = flat
    for position, triangle, vertex in (([1e300, 0, 0], 10, -1), ([0.9, 0.9, 0], 0, -1), ([0.5, 0.5, 0], -1, 0)):
        points = of.surface.SurfaceSingularities([of.surface.SurfaceSingularity(position, 1, 0.25, triangle, vertex)])
        with pytest.raises(of.InvalidInput, match="not on the mesh") as caught:
            of.surface.separatrices(field, points)
        assert caught.value.elements == [0]


@pytest.mark.parametrize("change", [
    lambda x: np.repeat(x, 2, axis=0)[::2], np.asfortranarray, lambda x: x.astype(">f8"), lambda x: x.tolist(),
    lambda x: x.astype(np.longdouble), lambda x: np.lib.stride_tricks.as_strided(x, writeable=False)])  # fmt: skip
def test_arrays_of_any_layout_are_the_same_mesh(flat, change):
    field, _ = flat
    mesh = field.domain
    other = of.TriangleMesh(change(np.array(mesh.vertices)), np.repeat(mesh.triangles, 2, axis=1)[:, ::2])
    np.testing.assert_array_equal(of.surface.direction_field(other).values, field.values)


@pytest.mark.parametrize("change, kind", [
    (lambda x: x * np.nan, "non_finite"), (lambda x: x[:0], "index_out_of_range"), (lambda x: x.ravel(), "wrong_shape"),
    (lambda x: x + 1j, "wrong_type"), (lambda x: x.astype(str), "wrong_type"),
    (lambda x: x * 1e300, "size_out_of_range")])  # fmt: skip
def test_vertices_that_are_none_are_refused(flat, change, kind):
    mesh = flat[0].domain
    with pytest.raises(of.Error) as caught:
        of.surface.direction_field(of.TriangleMesh(change(np.array(mesh.vertices)), mesh.triangles))
    assert caught.value.kind == kind


def test_energies_of_many_points_do_not_overflow():
    assert np.isfinite(of.surface.disk_polygon_energy(2**31 - 1, 0.5))
    assert of.surface.disk_polygon_radius(2**31 - 1) == pytest.approx(1)
