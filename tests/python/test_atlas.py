"""One-to-one charts: weights and maps against closed forms and published figures, atlases against exact arithmetic."""

import json
from fractions import Fraction

import numpy as np
import octafield as of
import octafield.surface as surface
import pytest
import scipy.sparse as sparse
from octafield.domain.generators import generate
from pipeline_fixtures import octafield
from scipy.sparse.linalg import spsolve
from scipy.spatial import Delaunay


def square(n, jitter=0.0):
    """n x n squares of the unit square, two triangles each; inner vertices moved by parts of the side."""
    x, y = np.meshgrid(np.arange(n + 1) / n, np.arange(n + 1) / n)
    points = np.column_stack([x.ravel(), y.ravel(), np.zeros((n + 1) ** 2)])
    inner = np.all((points[:, :2] > 1e-9) & (points[:, :2] < 1 - 1e-9), axis=1)
    points[inner, :2] += jitter / n * (np.random.default_rng(1).random((int(inner.sum()), 2)) - 0.5)
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    triangles = np.concatenate([np.column_stack([a, a + 1, a + n + 2]), np.column_stack([a, a + n + 2, a + n + 1])])
    return of.TriangleMesh(points, triangles)


def mean_value_matrix(mesh):
    places, weights = surface.mean_value_weights(mesh)
    count = len(mesh.vertices)
    return sparse.csr_matrix((weights, places.T), (count, count))


def cotangent_matrix(mesh):
    angles = np.asarray(surface.SurfaceDomain(mesh).corner_angles)
    triangles, count = np.asarray(mesh.triangles), len(mesh.vertices)
    ends = [(triangles[:, (k + 1) % 3], triangles[:, (k + 2) % 3]) for k in range(3)]
    values = np.concatenate([0.5 / np.tan(angles[:, k]) for k in range(3)])
    rows, columns = (np.concatenate([end[side] for end in ends]) for side in range(2))
    half = sparse.coo_matrix((values, (rows, columns)), (count, count))
    return (half + half.T).tocsr()


def harmonic(points):
    return np.sin(2 * np.pi * points[:, 0]) * np.cosh(2 * np.pi * points[:, 1])


def relative_error(mesh, weights):
    """Of sum_j weights_ij (f_i - f_j) = 0 inside with the harmonic function on the boundary: in L2, f linear in
    triangles, by the middles of edges."""
    points, triangles = np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    inner = np.all((points[:, :2] > 1e-9) & (points[:, :2] < 1 - 1e-9), axis=1)
    matrix = sparse.diags(np.asarray(weights.sum(axis=1)).ravel()) - weights
    found = harmonic(points)
    found[inner] = spsolve(matrix[inner][:, inner].tocsc(), -(matrix[inner][:, ~inner] @ found[~inner]))
    areas = np.tile(np.asarray(surface.triangle_areas(mesh)), 3)
    ends = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    exact = harmonic(points[ends].mean(axis=1))
    return float(np.sqrt((areas * (found[ends].mean(axis=1) - exact) ** 2).sum() / (areas * exact**2).sum()))


def delaunay(points):
    corners = Delaunay(points[:, :2]).simplices
    twice = np.cross(points[corners[:, 1]] - points[corners[:, 0]], points[corners[:, 2]] - points[corners[:, 0]])[:, 2]
    corners[twice < 0] = corners[twice < 0][:, ::-1]
    return of.TriangleMesh(points, corners[np.abs(twice) > 1e-12].astype(np.int32))


def test_mean_value_coordinates_do_not_converge_on_structured_meshes():
    """Thesis, figure 2.6; the limit is the error of the solution of f_xx + f_yy - (2 - sqrt 2) f_xy = 0."""
    errors = [relative_error(square(n), mean_value_matrix(square(n))) for n in (8, 16, 32, 128)]
    assert errors == pytest.approx([0.2393, 0.2133, 0.2101, 0.2094], abs=1e-4)


def test_mean_value_coordinates_are_of_first_order_elsewhere_and_cotangents_of_second():
    sides = np.array([16, 32, 64, 128])
    meshes = [delaunay(np.asarray(square(n, 0.5).vertices)) for n in sides]
    errors = [relative_error(mesh, mean_value_matrix(mesh)) for mesh in meshes]
    assert -np.polyfit(np.log(sides), np.log(errors), 1)[0] == pytest.approx(1, abs=0.2)
    linear = [relative_error(square(n), cotangent_matrix(square(n))) for n in sides]
    assert linear == pytest.approx([0.02841, 0.00716, 0.00179, 0.000449], rel=5e-3)  # of order 2


def test_weights_are_positive_where_cotangents_are_not():
    mesh = square(6, 0.8)
    assert len(surface.not_positive(np.asarray(mesh.vertices)[:, :2], mesh.triangles)) == 0
    assert mean_value_matrix(mesh).data.min() > 0
    assert cotangent_matrix(mesh).data.min() < 0


def test_second_order_mean_value_weights_would_be_negative():
    """Thesis (2.8): the weight depends on the circle's radius, and tends to -r^2 tan(theta / 2) / l for small ones."""
    length, r = 0.7, 1e-3
    for angle in (0.3, 1.0, 2.0, 2.8):
        s, c = np.sin(angle), np.cos(angle)
        weight = r**2 / (length * s) ** 2 * ((length - r) * c * s + r * angle - length * s)
        assert weight == pytest.approx(-(r**2) * np.tan(angle / 2) / length, rel=0.02)
        assert weight < 0


def test_the_metric_of_an_ellipsoid_is_the_one_of_its_formula():
    """x = e sin u sin v, y = sin u cos v, z = cos u with e = 7; the thesis's (2.3) has its first entry wrong."""
    e, n = 7, 40
    u, v = np.meshgrid(
        np.linspace(0.8, 0.8 + n / 20000, n + 1), np.linspace(0.5, 0.5 + n / 20000, n + 1), indexing="ij"
    )
    plane = np.column_stack([u.ravel(), v.ravel()])
    flat = square(n)
    points = np.column_stack(
        [e * np.sin(plane[:, 0]) * np.sin(plane[:, 1]), np.sin(plane[:, 0]) * np.cos(plane[:, 1]), np.cos(plane[:, 0])]
    )
    mesh = of.TriangleMesh(points, flat.triangles)
    metric = np.asarray(surface.plane_metric(mesh, plane, mesh.triangles, 0.5)) * 0.25
    u, v = plane[np.asarray(mesh.triangles)].mean(axis=1).T
    first = np.cos(u) ** 2 * (e**2 * np.sin(v) ** 2 + np.cos(v) ** 2) + np.sin(u) ** 2
    second = np.sin(u) * np.sin(v) * np.cos(u) * np.cos(v) * (e**2 - 1)
    third = np.sin(u) ** 2 * (e**2 * np.cos(v) ** 2 + np.sin(v) ** 2)
    assert np.abs(metric - np.column_stack([first, second, third])).max() < 2e-3
    values = np.asarray(surface.map_distortion(mesh, plane, mesh.triangles).singular_values)
    assert np.allclose((values**2).sum(axis=1), metric[:, 0] + metric[:, 2])
    assert np.allclose((values**2).prod(axis=1), metric[:, 0] * metric[:, 2] - metric[:, 1] ** 2)


def exactly_positive(uv, triangles):
    """By whole numbers of any size."""
    exact = [(Fraction(x), Fraction(y)) for x, y in np.asarray(uv).tolist()]
    for a, b, c in np.asarray(triangles).tolist():
        (p, q), (r, s), (t, w) = exact[a], exact[b], exact[c]
        if (r - p) * (w - q) - (s - q) * (t - p) <= 0:
            return False
    return True


@pytest.mark.parametrize("shape", ["ball", "box", "cylinder", "torus", "nut"])
def test_every_chart_is_one_to_one_in_exact_arithmetic(shape):
    result = of.compute_atlas(generate(shape))
    made, record = result.atlas, result.record
    assert exactly_positive(made.uv, made.uv_triangles)
    assert exactly_positive(surface.packed_uv(made)[0], made.uv_triangles)
    assert record.not_positive == record.charts_below == 0
    assert record.conformity.min <= record.conformity.p05 <= record.conformity.mean <= 1
    found = surface.map_distortion(made.domain, made.uv, made.uv_triangles)
    assert np.allclose(found.conformity, made.conformity)
    assert sum(chart.area for chart in made.chart_list) == pytest.approx(surface.triangle_areas(made.domain.mesh).sum())


def test_smooth_closed_surfaces_need_one_chart_whatever_their_handles():
    for shape, handles in (("ball", 0), ("torus", 1)):
        record = of.compute_atlas(generate(shape), of.MeshOptions(remesh=False, features="none")).record
        assert (record.charts, record.faces, record.handles, record.closed_faces) == (1, 1, handles, 1)
        assert record.cut_edges > 0 and record.conformity.p05 > 0.2


def open_ball():
    ball = generate("ball")
    points, triangles = np.asarray(ball.vertices), np.asarray(ball.triangles)
    return surface.TriangleMesh(points, triangles[points[triangles, 2].mean(axis=1) < 0.7])


def test_holes_are_filled_from_level_fill_on_and_rims_kept_below():
    for repair, closed in (("safe", False), ("fill", True), ("wrap", True)):
        options = of.SurfaceFieldOptions(remesh=False, features="none", repair=repair)
        atlas = of.compute_atlas(open_ball(), options).atlas
        rim = (np.asarray(atlas.domain.edge_triangles) < 0).any()
        assert rim == (not closed or repair == "safe")


def test_quads_are_of_the_filled_surface():
    options = of.SurfaceFieldOptions(features="none", repair="fill")
    record = of.compute_quad_mesh(open_ball(), options, quad_options=of.QuadMeshOptions(quads=200)).record
    assert record.irregular_boundary_vertices == {} and any("hole" in note for note in record.notes)


def test_the_command_writes_charts_texture_coordinates_and_a_record(tmp_path):
    surface.write_surface(generate("torus"), tmp_path / "torus.obj")
    done = octafield("atlas", tmp_path / "torus.obj", "-o", tmp_path / "out", "--json", tmp_path / "r.json", "-q")
    assert done.returncode == 0, done.stderr
    record = json.loads((tmp_path / "r.json").read_text())
    assert sorted(record["files"]) == sorted(path.name for path in (tmp_path / "out").iterdir())
    assert record == json.loads((tmp_path / "out" / "result.json").read_text())
    lines = (tmp_path / "out" / "atlas.obj").read_text().splitlines()
    uv = np.array([line.split()[1:] for line in lines if line.startswith("vt ")], float)
    corners = [line.split()[1:] for line in lines if line.startswith("f ")]
    assert uv.min() >= 0 and uv.max() <= 1 and len(corners) == record["triangles"]
    assert exactly_positive(uv, [[int(corner.split("/")[1]) - 1 for corner in face] for face in corners])
    again = surface.read_surface(tmp_path / "out" / "atlas.obj")
    assert np.array_equal(again.vertices, generate("torus").vertices)
    import pyvista

    charts = pyvista.read(tmp_path / "out" / "charts.vtp")
    assert {"chart", "conformity", "face", "parent"} <= set(charts.cell_data)
    assert np.ptp(np.asarray(charts.cell_data["chart"])) == record["charts"] - 1


def test_a_conformity_out_of_range_is_refused_and_leaves_no_folder(tmp_path):
    surface.write_surface(generate("ball"), tmp_path / "ball.obj")
    done = octafield("atlas", tmp_path / "ball.obj", "-o", tmp_path / "out", "--conformity", "1.5")
    assert done.returncode == 2 and "conformity" in done.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("call", "kind"),
    [
        (lambda mesh: surface.parameterize_disk(mesh), "closed"),
        (lambda mesh: surface.map_distortion(mesh, np.zeros((3, 2)), mesh.triangles), "index_out_of_range"),
        (lambda mesh: surface.map_distortion(mesh, np.full((99, 2), np.nan), mesh.triangles), "non_finite"),
        (lambda mesh: surface.map_distortion(mesh, np.zeros((99, 2)), mesh.triangles[:3]), "bad_shape"),
        (lambda mesh: surface.plane_metric(mesh, np.zeros((99, 2)), mesh.triangles, 0.0), "bad_option"),
        (lambda mesh: surface.not_positive(np.zeros((2, 2)), [[0, 1, 2]]), "index_out_of_range"),
        (lambda mesh: surface.bisected_edges(mesh, [1.0]), "bad_option"),
        (lambda mesh: surface.packed_uv(surface.Atlas(uv_triangles=[[0, 1, 2]])), "bad_shape"),
        (lambda mesh: surface.atlas(mesh, conformity=-1), "bad_option"),
        (lambda mesh: surface.atlas(of.TriangleMesh([[0, 0, 0]] * 3, [[0, 1, 2]])), "degenerate_triangle"),
    ],
)
def test_what_cannot_be_done_is_named(call, kind):
    box = of.TriangleMesh(
        [[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)],
        [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6],
         [1, 3, 5], [3, 7, 5]],
    )  # fmt: skip
    with pytest.raises(of.Error) as error:
        call(box)
    assert error.value.kind == kind
