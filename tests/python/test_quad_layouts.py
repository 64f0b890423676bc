"""Quad layouts in parts: separatrices, patches, block-structured quads."""

import pickle

import numpy as np
import octafield as of
import pytest
from quad_mesh_checks import disk, four_points, irregular, require_conforming
from surface_fixtures import square

surface = of.surface


def imposed(mesh, points, **options):
    placed = [surface.imposed_point(mesh, p["position"], round(4 * p["index"])) for p in points]
    return surface.impose_singular_points(mesh, surface.SingularPattern(placed), **options)


@pytest.fixture(scope="module")
def layout():
    return surface.quad_layout(imposed(disk(), four_points()))


@pytest.fixture(scope="module")
def pair():
    """A square with a point of valence 3 and one of valence 5: crossings, and curves that end at the boundary."""
    points = [{"position": [0.3, 0.3, 0], "index": 0.25}, {"position": [0.7, 0.6, 0], "index": -0.25}]
    return surface.quad_layout(imposed(square(12), points))


def test_four_points_in_a_disk_give_five_patches_in_three_chords(layout):
    assert (len(layout.vertices), len(layout.sides), len(layout.patches), len(layout.chords)) == (8, 12, 5, 3)
    assert {patch.kind for patch in layout.patches} == {"quad"} and layout.curves.traced == 12
    kinds = sorted(vertex.kind for vertex in layout.vertices)
    assert kinds == ["boundary"] * 4 + ["singular"] * 4
    lengths = sorted(side.parameters[-1] for side in layout.sides if side.curve >= 0)
    assert lengths[0] == pytest.approx(lengths[3], rel=0.01) and lengths[4] == pytest.approx(lengths[7], rel=0.01)
    assert lengths[4] / lengths[0] == pytest.approx(1.57118 / 0.82033, rel=0.01)  # closed form


def test_sides_go_round_each_patch_and_chords_join_opposite_ones(layout, pair):
    for made in layout, pair:
        for patch in made.patches:
            (loop,) = patch.loops
            assert loop.shape == (4, 2) and patch.corners == 4 and patch.euler_characteristic == 1
            ends = [(s.first, s.last)[:: -1 if back else 1] for s, back in ((made.sides[i], b) for i, b in loop)]
            assert [b for _, b in ends] == [a for a, _ in ends[1:] + ends[:1]]
            chords = [made.sides[i].chord for i in loop[:, 0]]
            assert chords[:2] == chords[2:]
        for number, chord in enumerate(made.chords):
            assert [s for s, side in enumerate(made.sides) if side.chord == number] == chord.sides.tolist()
        assert len(made.vertices) - len(made.sides) + len(made.patches) == 1


def test_polygons_tile_the_surface(layout, pair):
    for made in layout, pair:
        polygons, whole = surface.patch_polygons(made), surface.triangle_areas(made.curves.domain.mesh).sum()
        areas = np.zeros(len(made.patches))
        for i, patch in enumerate(polygons.patches):
            p = polygons.points[polygons.corners[polygons.first[i] : polygons.first[i + 1]]]
            areas[patch] += np.cross(p - p[0], np.roll(p, -1, axis=0) - p[0])[:, 2].sum() / 2
        assert (areas > 0).all() and areas.sum() == pytest.approx(whole, rel=1e-9)


def test_points_of_curves_are_where_they_cross_edges(pair):
    curves = surface.layout_curves(pair.field)
    domain = curves.domain
    points = np.asarray(domain.vertices)
    for curve in curves.curves:
        count = len(curve.vertices)
        assert len(curve.edges) == len(curve.fractions) == len(curve.lengths) == len(curve.triangles) + 1 == count
        at_vertex = curve.vertices >= 0
        assert (at_vertex == (curve.edges < 0)).all() and curve.vertices[0] == curve.first_vertex
        low, high = domain.edges[curve.edges].T
        places = np.where(at_vertex[:, None], points[curve.vertices],
            points[low] + curve.fractions[:, None] * (points[high] - points[low]))  # fmt: skip
        corners = points[domain.triangles[curve.triangles]]
        for ends in places[:-1], places[1:]:  # each part is in its triangle
            solved = [np.linalg.lstsq(np.c_[c, np.ones(3)].T, np.r_[e, 1], rcond=None)[0]
                      for c, e in zip(corners, ends, strict=True)]  # fmt: skip
            assert np.min(solved) > -1e-9
        assert (np.diff(curve.lengths) > 0).all()
        if curve.last_vertex < 0:
            assert np.isclose(np.abs(places[-1, :2] - 0.5).max(), 0.5)


def test_quads_are_a_grid_in_each_patch(pair):
    made = surface.layout_quads(pair, quad_count=250)
    sizes, blocks = made.patch_sizes, made.patches
    assert np.bincount(blocks).tolist() == sizes.prod(axis=1).tolist()
    assert abs(len(made.mesh.quads) - 250) < 60 and made.least_scaled_jacobian > 0.7
    found = irregular(made.mesh, 1)
    assert sorted(found.values()) == [-1, 1]
    assert all(v < len(pair.vertices) for v in found)  # vertices of the layout come first
    for patch, (first, second) in enumerate(sizes.tolist()):
        chords = [made.chord_counts[pair.sides[s].chord] for s in pair.patches[patch].loops[0][:2, 0]]
        assert [first, second] == chords


def test_an_edge_length_gives_the_quads_of_its_size(layout):
    wanted = 0.08
    made = surface.layout_quads(layout, edge_length=wanted)
    assert len(made.mesh.quads) == pytest.approx(np.pi / wanted**2, rel=0.1)


def test_a_layout_comes_back_from_a_pickle_with_the_same_bits(pair):
    again = pickle.loads(pickle.dumps(pair))
    assert [s.points.tobytes() for s in again.sides] == [s.points.tobytes() for s in pair.sides]
    one, other = (surface.layout_quads(x, quad_count=90).mesh.vertices.tobytes() for x in (pair, again))
    assert one == other


def test_a_ring_without_points_is_cut_unless_it_shall_not_be():
    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    rims = [np.column_stack([r * np.cos(angles), r * np.sin(angles), 0 * angles]) for r in (0.5, 0.7, 1)]
    rows = [[k * 24 + i, (k + 1) * 24 + i, (k + 1) * 24 + j, k * 24 + j] for k in (0, 1) for i in range(24)
            for j in [(i + 1) % 24]]  # fmt: skip
    ring = surface.split_quads(surface.QuadMesh(np.concatenate(rims), quads=rows))
    field = surface.impose_singular_points(ring, surface.SingularPattern())
    whole = surface.quad_layout(field, cut_annuli=False)
    assert [patch.kind for patch in whole.patches] == ["annulus"]
    with pytest.raises(of.GeometryError, match="1 are annuli") as error:
        surface.layout_quads(whole, quad_count=50)
    assert error.value.kind == "no_quad_layout" and error.value.elements == [0]
    made = surface.layout_quads(surface.quad_layout(field), quad_count=50)
    found, rim = require_conforming(made.mesh, 0)
    assert set(found.values()) == {2, 4} and {found[v] for v in rim} == {2}
    cut = surface.layout_curves(field, cut_vertices=[5])
    assert [(c.first_vertex, c.last_vertex) for c in cut.curves] == [(5, -1)]


def test_the_angle_on_a_sphere_is_turned_so_that_curves_join(sphere_points):
    mesh, points = sphere_points
    field = surface.turned_for_layout(imposed(mesh, points))
    made = surface.quad_layout(field)
    assert (len(made.vertices), len(made.sides), len(made.patches)) == (8, 12, 6)
    assert irregular(surface.layout_quads(made, quad_count=96).mesh, 2) == dict.fromkeys(range(8), 1)


def test_each_of_two_spheres_is_turned_for_itself(sphere_points):
    mesh, points = sphere_points
    away, count = np.array([3.0, 0, 0]), len(mesh.vertices)
    two = of.TriangleMesh(
        np.concatenate([mesh.vertices, mesh.vertices + away]), np.concatenate([mesh.triangles, mesh.triangles + count])
    )
    there = [{"position": (p["position"] + away).tolist(), "index": p["index"]} for p in points]
    made = surface.quad_layout(surface.turned_for_layout(imposed(two, [*points, *there])))
    assert (len(made.vertices), len(made.sides), len(made.patches)) == (16, 24, 12)


def test_turning_can_be_cancelled(sphere_points):
    seen = []

    def stop(phase, fraction, merit):
        seen.append((phase, fraction))
        return fraction < 0.2

    with pytest.raises(of.Cancelled):
        surface.turned_for_layout(imposed(*sphere_points), progress=stop)
    assert {phase for phase, _ in seen} == {"turn"} and len(seen) > 10


@pytest.fixture(scope="module")
def sphere_points():
    import pyvista

    ball = pyvista.Icosphere(nsub=2)
    mesh = of.TriangleMesh(ball.points.astype(float), ball.faces.reshape(-1, 4)[:, 1:])
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) / 3**0.5
    near = corners * (1 - 0.01)  # within the sphere, where its triangles are
    return mesh, [{"position": p.tolist(), "index": 0.25} for p in near]


def test_angles_of_quads_are_judged_by_the_worst():
    leaning = [[0, 0, 0], [1, 0, 0], [1.5, 3**0.5 / 2, 0], [0.5, 3**0.5 / 2, 0]]
    mesh = surface.QuadMesh([[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1], *leaning], quads=[[0, 1, 2, 3], [4, 5, 6, 7]])
    assert surface.quad_angle_quality(mesh) == pytest.approx([1, 2 / 3])


def field_of(layout, **changed):
    """The field with some parts as nobody makes them."""
    names = ("field", "log_size", "pattern", "point_vertices")
    return surface.ImposedField(**({name: getattr(layout.field, name) for name in names} | changed))


@pytest.mark.parametrize(
    ("call", "kind"),
    [
        (lambda m: surface.layout_curves(m.field, end_tolerance=-1.0), "bad_option"),
        (lambda m: surface.layout_curves(m.field, end_tolerance=np.inf), "non_finite"),
        (lambda m: surface.layout_curves(m.field, cut_vertices=[0]), "bad_option"),
        (lambda m: surface.layout_curves(surface.ImposedField()), "bad_field"),
        (lambda m: surface.turned_for_layout(surface.ImposedField()), "bad_field"),
        (lambda m: surface.turned_for_layout(field_of(m, point_vertices=[10**6] * 4)), "bad_field"),
        (lambda m: surface.quad_layout(field_of(m, log_size=m.field.log_size[:-1])), "bad_field"),
        (lambda m: surface.layout_quads(m), "bad_option"),
        (lambda m: surface.layout_quads(m, edge_length=0.1, quad_count=9), "bad_option"),
        (lambda m: surface.layout_quads(m, edge_length=-0.1), "bad_option"),
        (lambda m: surface.layout_quads(m, edge_length=np.nan), "non_finite"),
        (lambda m: surface.layout_quads(m, edge_length=1e-6), "bad_option"),
        (lambda m: surface.layout_quads(m, quad_count=-5), "bad_option"),
        (lambda m: surface.quad_layout(m.field, max_length=0.4), "long_separatrix"),
        (lambda m: surface.quad_angle_quality(surface.QuadMesh([[0, 0, 0]], quads=[[0, 1, 2, 3]])),
         "index_out_of_range"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_with_its_kind(layout, call, kind):
    with pytest.raises(of.Error) as error:
        call(layout)
    assert error.value.kind == kind and not isinstance(error.value, of.SolverError)


def test_progress_can_cancel(layout):
    for call in (
        lambda stop: surface.layout_curves(layout.field, progress=stop),
        lambda stop: surface.quad_layout(layout.field, progress=stop),
        lambda stop: surface.layout_quads(layout, quad_count=100, progress=stop),
    ):
        with pytest.raises(of.Cancelled):
            call(lambda *_: False)
