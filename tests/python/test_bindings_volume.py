"""Functions on tet meshes."""

import meshio
import numpy as np
import octafield as of
import pytest


def harmonic_turn(points, turns=0.25):
    """Frames turned about z by `turns` of the polar angle round the cube's axis: one singular line of index `turns`."""
    angle = turns * np.arctan2(points[:, 1] - 0.5, points[:, 0] - 0.5)
    return of.frames.quaternion_exp(np.column_stack([0 * angle, 0 * angle, angle]))


@pytest.fixture(scope="module")
def random_field(box):
    return of.frames.random_rotations(len(box.vertices), 5)


def test_tets_of_the_cube_fill_it(box):
    of.require_valid(box)
    np.testing.assert_allclose(of.volume.tet_volumes(box), 1 / (6 * 5**3))


def test_its_boundary_is_the_surface_found_with_numpy(box, box_surface):
    boundary = of.volume.boundary_surface(box)
    assert boundary.vertex_map.dtype == np.int32
    np.testing.assert_array_equal(boundary.mesh.vertices, box.vertices[boundary.vertex_map])
    same = lambda m: sorted(map(tuple, np.sort(m.triangles, axis=1).tolist()))
    assert same(boundary.mesh) == same(box_surface) and of.surface.signed_volume(boundary.mesh) == pytest.approx(1)


def test_operators_are_exact_for_linear_functions(box):
    stiffness, mass = of.volume.stiffness(box), of.volume.mass(box)
    x = box.vertices @ [1.0, 2.0, 3.0]
    assert x @ stiffness @ x == pytest.approx(14)  # |gradient|^2 times the volume
    assert abs(stiffness @ np.ones(len(x))).max() < 1e-12 and abs(stiffness - stiffness.T).max() < 1e-15
    assert mass.sum() == pytest.approx(1) and x @ mass @ x == pytest.approx(
        14 * (1 / 12) + 9
    )  # variance plus mean squared
    np.testing.assert_allclose(of.volume.lumped_mass(box), np.asarray(mass.sum(axis=1)).ravel())


def test_dirichlet_energy_is_that_of_the_sh4_vectors(box, random_field):
    a = of.frames.sh4_embed(random_field)
    expected = 0.5 * np.sum(a * (of.volume.stiffness(box) @ a))
    assert of.volume.dirichlet_energy(box, random_field) == pytest.approx(expected, rel=1e-12)
    assert of.volume.unit_speed_factor == 3 / 20
    assert of.volume.dirichlet_energy(box, random_field, threads=1) == of.volume.dirichlet_energy(
        box, random_field, threads=5
    )


def test_tetrahedralize_keeps_the_surface(box_surface):
    mesh = of.volume.tetrahedralize(box_surface, radius_edge_ratio=1.4, edge_length=0.2)
    of.require_valid(mesh)
    boundary = of.volume.boundary_surface(mesh)
    np.testing.assert_array_equal(mesh.vertices[: len(box_surface.vertices)], box_surface.vertices)
    assert of.volume.tet_volumes(mesh).sum() == pytest.approx(1) and len(boundary.mesh.triangles) == len(
        box_surface.triangles
    )


def test_sector_normals_of_the_cube_are_its_axes(box, box_surface, box_features):
    sectors = of.volume.sector_normals(of.TetDomain(box, features=box_features))
    assert sectors.vertex.dtype == np.int32 and (np.diff(sectors.vertex) >= 0).all()
    np.testing.assert_allclose(
        np.sort(np.abs(sectors.normal), axis=1), np.tile([0, 0, 1], (len(sectors.vertex), 1)), atol=1e-14
    )
    inside, edge = len(box_surface.vertices) - 12 * 4 - 8, 12 * 4
    assert len(sectors.vertex) == inside + 2 * edge + 3 * 8


@pytest.mark.parametrize("mode, face_kind", [("aligned", 1), ("fixed", 2), ("none", 0)])
def test_constraints_follow_the_mode(box, box_features, box_problem, mode, face_kind):
    boundary, directions, _, _ = box_problem
    constraints = of.volume.boundary_constraints(of.TetDomain(box, features=box_features), directions, mode=mode)
    on_surface = np.zeros(len(box.vertices), dtype=np.uint8)
    on_surface[boundary.vertex_map] = 1
    np.testing.assert_array_equal(constraints.on_boundary, on_surface)
    assert constraints.kind.dtype == np.uint8 and (constraints.kind[on_surface == 0] == 0).all()
    face = [v for v in boundary.vertex_map if np.isin(box.vertices[v], (0, 1)).sum() == 1]
    assert (constraints.kind[face] == face_kind).all()
    assert len(constraints.released_corners) == 0


def test_smoothing_the_cube_finds_the_constant_field(box, box_features, box_problem):
    boundary, _, constraints, start = box_problem
    reports = []
    result = of.volume.smooth(box, constraints, start, progress=lambda *report: reports.append(report))
    assert result.energy == pytest.approx(of.volume.dirichlet_energy(box, result.frames), rel=1e-12, abs=1e-20)
    assert result.energy <= result.energy_history[0] * (1 + 1e-12) and result.message
    assert of.frames.distance(result.frames, [1, 0, 0, 0]).max() < 1e-3
    assert np.degrees(of.volume.alignment_angles(of.TetDomain(box, features=box_features), result.frames)).max() < 0.1
    assert all(isinstance(p, str) and isinstance(f, float) and isinstance(m, float) for p, f, m in reports)


def test_smoothing_holds_fixed_frames_and_lowers_the_energy(box, random_field):
    n = len(box.vertices)
    kind = np.zeros(n, dtype=np.uint8)
    kind[::7] = 2
    constraints = of.volume.BoundaryConstraints(kind, np.zeros((n, 3)), random_field, kind > 0, [])
    results = [
        of.volume.smooth(box, constraints, random_field, max_iterations=5, linear_solver=s, threads=t)
        for s, t in (("cholesky", 1), ("cholesky", 4), ("conjugate_gradients", 2))
    ]
    for result in results:
        assert of.frames.distance(result.frames[::7], random_field[::7]).max() < 1e-7
        assert result.energy < of.volume.dirichlet_energy(box, random_field)
    assert results[0].frames.tobytes() == results[1].frames.tobytes()


def test_initial_frames_keep_what_is_fixed(box, box_problem):
    _, _, constraints, start = box_problem
    held = constraints.kind == 2
    assert held.any() and of.frames.distance(start[held], constraints.frames[held]).max() < 1e-7
    assert (
        of.volume.initial_frames(box, constraints, threads=1).tobytes()
        == of.volume.initial_frames(box, constraints, threads=3).tobytes()
    )


def test_stopped_smoothing_keeps_the_best_state(box, random_field):
    n = len(box.vertices)
    constraints = of.volume.BoundaryConstraints([0] * n, np.zeros((n, 3)), random_field, [0] * n, [])
    result = of.volume.smooth(box, constraints, random_field, progress=lambda *report: False)
    assert not result.converged and result.frames.shape == (n, 4)


def test_constant_fields_have_no_singularity(box):
    graph = of.volume.singular_graph(box, np.tile(of.frames.octahedral_group()[9], (len(box.vertices), 1)))
    assert graph.triangles == [] and graph.curves == [] and graph.length == 0


@pytest.mark.parametrize("turns, quarter_turns", [(0.25, 1), (-0.25, -1)])
def test_a_quarter_turn_round_the_axis_is_one_singular_line(turns, quarter_turns):
    from conftest import box_tets

    box = box_tets(4)
    box.vertices[:] += [0.013, 0.007, 0]  # the axis x = y = 1/2 then misses all vertices and edges
    graph = of.volume.singular_graph(box, harmonic_turn(box.vertices, turns))
    assert graph.complex_triangles == 0 and len(graph.nodes) == 0 and list(graph.curve_quarter_turns) == [quarter_turns]
    assert {t.quarter_turns for t in graph.triangles} == {quarter_turns} and {t.holonomy for t in graph.triangles} <= {
        8,
        9,
    }
    assert graph.length == pytest.approx(1, rel=0.5)
    np.testing.assert_array_equal(graph.points[: len(graph.triangles)], [t.point for t in graph.triangles])
    assert sorted(graph.curves[0]) == list(range(len(graph.points)))


def test_singular_graphs_do_not_depend_on_threads(box, random_field):
    one, many = (
        of.volume.singular_graph(box, random_field, threads=1),
        of.volume.singular_graph(box, random_field, threads=6),
    )
    assert one.points.tobytes() == many.points.tobytes() and one.length == many.length and len(one.triangles) > 100
    assert all((a == b).all() for a, b in zip(one.curves, many.curves, strict=True))


def test_written_fields_are_read_by_others(box, box_surface, random_field, tmp_path):
    of.volume.write_field(tmp_path / "field.vtu", box, random_field, {"seed": "5"})
    data = meshio.read(tmp_path / "field.vtu")
    np.testing.assert_array_equal(data.points, box.vertices)
    np.testing.assert_array_equal(data.cells_dict["tetra"], box.tets)
    np.testing.assert_allclose(data.point_data["quaternion"], random_field, atol=1e-15)
    np.testing.assert_allclose(data.point_data["sh4"], of.frames.sh4_embed(random_field), atol=1e-14)
    np.testing.assert_allclose(
        np.stack([data.point_data["frame_" + k] for k in "uvw"], axis=2),
        of.frames.rotation_matrices(random_field),
        atol=1e-14,
    )

    import pyvista

    graph = of.volume.singular_graph(box, random_field)
    of.volume.write_singular_graph(tmp_path / "singular.vtp", graph, {"seed": "5"})
    lines = pyvista.read(tmp_path / "singular.vtp")
    assert lines.n_lines == len(graph.curves) and lines.length == pytest.approx(3**0.5, rel=0.2)
    of.volume.write_surface_field(
        tmp_path / "cross.vtp", box_surface, np.tile([0.0, 0.0, 1.0], (len(box_surface.vertices), 1))
    )
    cross = pyvista.read(tmp_path / "cross.vtp")
    assert cross.n_points == len(box_surface.vertices) and (cross.point_data["direction"] == [0, 0, 1]).all()
    with pytest.raises(of.IoError):
        of.volume.write_field(tmp_path / "no_such_folder" / "field.vtu", box, random_field)


WILD = of.TetMesh(np.eye(4)[:, :3], [[0, 1, 2, 10**9]])
LOST = of.TetMesh(np.eye(4)[:, :3] * np.nan, [[0, 1, 2, 3]])
FRAMES = np.tile([1.0, 0, 0, 0], (4, 1))
FREE = of.volume.BoundaryConstraints([0] * 4, np.zeros((4, 3)), FRAMES, [0] * 4, [])
ON_TETS = [
    of.volume.tet_volumes,
    of.volume.boundary_surface,
    of.volume.stiffness,
    of.volume.mass,
    of.volume.lumped_mass,
    lambda m: of.volume.dirichlet_energy(m, FRAMES),
    lambda m: of.volume.initial_frames(m, FREE),
    lambda m: of.volume.smooth(m, FREE, FRAMES),
    lambda m: of.volume.singular_graph(m, FRAMES),
    lambda m: of.volume.write_field("never.vtu", m, FRAMES),
]


@pytest.mark.parametrize("call", ON_TETS)
def test_unsound_tet_meshes_are_refused_everywhere(call):
    with pytest.raises(of.InvalidInput, match="tets") as caught:
        call(WILD)
    assert caught.value.kind == "index_out_of_range" and caught.value.elements == [0]
    with pytest.raises(of.InvalidInput, match="vertices"):
        call(LOST)


def test_require_valid_names_tets_as_geometry_errors(box):
    with pytest.raises(of.GeometryError) as caught:
        of.require_valid(WILD)
    assert caught.value.kind == "index_out_of_range" and caught.value.elements == [0]
    tets = box.tets.copy()
    tets[3, :2] = tets[3, 1::-1]
    with pytest.raises(of.GeometryError) as caught:
        of.require_valid(of.TetMesh(box.vertices, tets))
    assert caught.value.kind == "inverted_tet" and caught.value.elements == [3]


@pytest.mark.parametrize("frames", [FRAMES, np.ones((5, 3)), "frames", [[2.0, 0, 0, 0]] * 216, [[np.nan] * 4] * 216])
def test_frames_that_do_not_fit_the_mesh_are_refused(box, frames):
    assert len(box.vertices) == 216
    constraints = of.volume.BoundaryConstraints(
        [0] * 216, np.zeros((216, 3)), np.tile(FRAMES[0], (216, 1)), [0] * 216, []
    )
    for call in (
        of.volume.dirichlet_energy,
        of.volume.singular_graph,
        lambda m, f: of.volume.smooth(m, constraints, f),
        lambda m, f: of.volume.write_field("never.vtu", m, f),
        of.volume.alignment_angles,
    ):
        with pytest.raises(of.InvalidInput, match="frames|start"):
            call(box, frames)


@pytest.mark.parametrize(
    "field, value",
    [
        ("kind", [0, 0]),
        ("kind", [7] * 216),
        ("axis", np.zeros((3, 3))),
        ("axis", np.full((216, 3), np.nan)),
        ("frames", FRAMES),
        ("frames", np.zeros((216, 4))),
        ("on_boundary", [1]),
        ("released_corners", [216]),
        ("released_corners", [-1]),
    ],
)
def test_constraints_that_do_not_fit_the_mesh_are_refused(box, field, value):
    constraints = of.volume.BoundaryConstraints(
        [0] * 216, np.zeros((216, 3)), np.tile(FRAMES[0], (216, 1)), [0] * 216, []
    )
    setattr(constraints, field, value)
    for call in (of.volume.initial_frames, lambda m, c: of.volume.smooth(m, c, np.tile(FRAMES[0], (216, 1)))):
        with pytest.raises(of.InvalidInput, match=field):
            call(box, constraints)


def test_an_axis_that_is_not_unit_is_refused(box):
    constraints = of.volume.BoundaryConstraints(
        [1] * 216, np.full((216, 3), 2.0), np.tile(FRAMES[0], (216, 1)), [1] * 216, []
    )
    with pytest.raises(of.InvalidInput, match="constraints.axis"):
        of.volume.initial_frames(box, constraints)


def test_directions_that_do_not_fit_the_surface_are_refused(box, box_features, box_problem):
    boundary, directions, _, _ = box_problem
    domain = of.TetDomain(box, features=box_features)
    for wrong in (directions[:-1], directions[:, :2], directions * np.nan):
        with pytest.raises(of.InvalidInput, match="directions"):
            of.volume.boundary_constraints(domain, wrong)
        with pytest.raises(of.InvalidInput, match="directions"):
            of.volume.write_surface_field("never.vtp", boundary.mesh, wrong)
    with pytest.raises(of.InvalidInput, match="aligned, fixed, none"):
        of.volume.boundary_constraints(domain, directions, mode="loose")


WILD_SURFACE = of.TriangleMesh(np.eye(3), [[0, 1, 10**9]])


@pytest.mark.parametrize(
    "graph",
    [
        of.SingularGraph(points=np.eye(3), curves=[[0, 3]], curve_quarter_turns=[1]),
        of.SingularGraph(points=np.eye(3), nodes=[-1]),
        of.SingularGraph(points=np.eye(3), curves=[[0, 1]]),
        of.SingularGraph(triangles=[of.volume.SingularTriangle()]),
        of.SingularGraph(points=np.full((2, 3), np.nan)),
    ],
)
def test_unsound_graphs_are_not_written(graph, tmp_path):
    with pytest.raises(of.InvalidInput, match="graph"):
        of.volume.write_singular_graph(tmp_path / "never.vtp", graph)


def test_options_out_of_range_are_refused(box, box_surface, box_problem):
    _, _, constraints, start = box_problem
    for options in (
        {"max_iterations": -1},
        {"tolerance": -1.0},
        {"tolerance": np.nan},
        {"threads": -1},
        {"linear_solver": "magic"},
    ):
        with pytest.raises(of.InvalidInput):
            of.volume.smooth(box, constraints, start, **options)
    for options in (
        {"radius_edge_ratio": 0.5},
        {"radius_edge_ratio": np.nan},
        {"min_dihedral": -1.0},
        {"edge_length": -1.0},
    ):
        with pytest.raises(of.InvalidInput):
            of.volume.tetrahedralize(box_surface, **options)
