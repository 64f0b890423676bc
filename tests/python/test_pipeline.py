"""The pipeline from a file to a frame field: records, shared preparation, inputs of every kind."""

import gzip
import math
from collections.abc import Mapping
from dataclasses import replace

import meshio
import numpy as np
import octafield
import pytest
from octafield.domain.generators import generate
from octafield.domain.inputs import read_input
from octafield.domain.meshing import load_surface, prepare_mesh
from octafield.fields.direction_field import compute_surface_field
from octafield.fields.frame_field import compute_field, prepare_field, run_field
from octafield.options import FieldOptions, SurfaceFieldOptions
from octafield.progress.phases import PHASES
from octafield.runs.run_folder import FIELD_FILES, write_field_result, write_surface_result
from pipeline_fixtures import SHARED_SURFACES, SHARED_TETS, shared, write_cube, write_sphere

COARSE = FieldOptions(edge_length=0.25)
ROUND = FieldOptions(edge_length=0.35)  # of the sphere that is prepared once

NUMBER, TEXT = (int, float), str
CONTRACT = {
    "input": TEXT, "version": TEXT, "vertices": int, "tets": int, "boundary_triangles": int, "representation": TEXT,
    "solver": TEXT, "boundary": TEXT, "seed": int, "threads": int, "energy": NUMBER, "energy_unit_speed": NUMBER,
    "singular_edges": int, "singular_length": NUMBER, "complex_edges": int, "alignment_deg": Mapping, "iterations": int,
    "verdict": Mapping,
    "energy_history": list, "wall_seconds": Mapping, "cpu_seconds": Mapping, "peak_mb": NUMBER,
}  # fmt: skip


@pytest.fixture(scope="module")
def cube(tmp_path_factory):
    return compute_field(write_cube(tmp_path_factory.mktemp("cube")), COARSE)


@pytest.fixture(scope="module")
def sphere_problem(tmp_path_factory):
    path = write_sphere(tmp_path_factory.mktemp("sphere"))
    return prepare_field(prepare_mesh(path, ROUND))


def write_tets(path, tets, points, lines=None):
    cells = [("tetra", tets)] + ([("line", lines)] if lines is not None else [])
    meshio.Mesh(points, cells).write(path, file_format="gmsh" if path.suffix == ".msh" else None)
    return path


def test_record_has_every_key_of_the_contract_with_its_type(cube):
    for key, kind in CONTRACT.items():
        assert isinstance(cube.record[key], kind), key
    for group in ("wall_seconds", "cpu_seconds"):
        assert set(PHASES) <= set(cube.record[group])
        assert all(seconds >= 0 for seconds in cube.record[group].values())
    assert set(cube.record["alignment_deg"]) == {"median", "max", "held_max"}
    assert {"octafield", "numpy", "vtk", "python", "platform"} <= set(cube.record["versions"])
    assert cube.record["options"]["edge_length"] == COARSE.edge_length


def test_the_field_of_a_cube_is_its_own_axes(cube):
    # The constant frame of the axes meets every constraint, so the least energy is 0 and no curve is singular.
    assert cube.record["energy"] == pytest.approx(0, abs=1e-9)
    assert cube.record["singular_edges"] == 0
    assert cube.record["alignment_deg"]["max"] == pytest.approx(0, abs=1e-4)
    identity = np.array([1.0, 0, 0, 0])
    assert max(octafield.frames.distance(np.asarray(cube.frames), np.tile(identity, (len(cube.frames), 1)))) < 1e-6


def test_energy_is_that_of_the_frames_and_unit_speed_is_three_twentieths(cube):
    assert cube.record["energy"] == octafield.volume.dirichlet_energy(cube.tets, cube.frames)
    assert cube.record["energy_unit_speed"] == pytest.approx(0.15 * cube.record["energy"])


def test_a_sphere_has_cross_indices_of_sum_two(sphere_problem):
    record = run_field(sphere_problem, ROUND).record["surface_field"]
    assert record["euler_characteristic"] == 2
    assert record["index_sum"] == pytest.approx(2)


def test_runs_share_the_mesh_and_free_twist_never_costs_energy(sphere_problem):
    fixed, aligned = (run_field(sphere_problem, replace(ROUND, boundary=mode)) for mode in ("fixed", "aligned"))
    assert fixed.tets is aligned.tets
    assert fixed.record["mesh_sha256"] == aligned.record["mesh_sha256"]
    assert fixed.record["wall_seconds"]["mesh"] == aligned.record["wall_seconds"]["mesh"]
    assert aligned.record["energy"] <= fixed.record["energy"] * (1 + 1e-9)  # fixed frames are among the aligned ones


def test_equal_options_give_equal_bits_at_any_thread_count(sphere_problem):
    one, two = (run_field(sphere_problem, replace(ROUND, threads=threads)) for threads in (1, 2))
    assert np.array_equal(one.frames, two.frames)
    assert one.record["energy"] == two.record["energy"]


def test_frames_do_not_depend_on_the_unit_of_length(tmp_path, cube):
    (tmp_path / "small").mkdir()
    small = compute_field(write_cube(tmp_path / "small", 1e-6), replace(COARSE, edge_length=0.25e-6))
    assert small.record["singular_edges"] == 0
    assert small.record["alignment_deg"]["max"] == pytest.approx(0, abs=1e-4)


def test_tet_meshes_of_every_format_are_kept_as_they_are(tmp_path, cube):
    tets, points = np.asarray(cube.tets.tets), np.asarray(cube.tets.vertices)
    for suffix in (".vtk", ".vtu", ".msh", ".mesh"):
        result = compute_field(write_tets(tmp_path / f"cube{suffix}", tets, points))
        assert result.record["tets"] == len(tets), suffix
        assert result.record["input_kind"] == "tets"
        assert result.record["energy"] == pytest.approx(cube.record["energy"], abs=1e-6)


def test_gzipped_tets_read_like_plain_ones(tmp_path, cube):
    plain = write_tets(tmp_path / "cube.vtk", np.asarray(cube.tets.tets), np.asarray(cube.tets.vertices))
    packed = tmp_path / "cube.VTK.gz"
    packed.write_bytes(gzip.compress(plain.read_bytes()))
    assert np.array_equal(read_input(packed).tets.tets, read_input(plain).tets.tets)


def test_inverted_tets_are_turned_over_and_unused_points_left_out(tmp_path, cube):
    tets = np.asarray(cube.tets.tets)[:, [1, 0, 2, 3]]
    points = np.vstack([np.asarray(cube.tets.vertices), [[9.0, 9, 9]]])
    found = read_input(write_tets(tmp_path / "inverted.vtk", tets, points))
    assert len(found.tets.vertices) == len(cube.tets.vertices)
    assert (np.asarray(octafield.volume.tet_volumes(found.tets)) > 0).all()
    assert len(found.notes) == 2


def test_lines_of_a_tet_mesh_become_its_features_by_default(tmp_path, cube):
    edges = np.asarray(cube.features.edges)
    inner = [[0, int(np.asarray(cube.tets.tets).max())]]  # not an edge of the boundary
    path = write_tets(
        tmp_path / "cube.vtk", np.asarray(cube.tets.tets), np.asarray(cube.tets.vertices), np.vstack([edges, inner])
    )
    meshed = prepare_mesh(path)
    assert meshed.feature_source == "file"
    assert len(meshed.features.edges) == len(edges)
    assert len(meshed.features.corners) == 8


def test_lines_that_list_all_mesh_edges_are_no_features(tmp_path, cube):
    topology = octafield.surface.edge_topology(cube.surface)
    path = write_tets(
        tmp_path / "all.vtk", np.asarray(cube.tets.tets), np.asarray(cube.tets.vertices), np.asarray(topology.edges)
    )
    meshed = prepare_mesh(path)
    assert meshed.feature_source == "angle"
    assert len(meshed.features.edges) == len(cube.features.edges)


def test_features_from_a_file_without_lines_are_refused(tmp_path):
    with pytest.raises(octafield.InvalidInput, match="no line cells"):
        compute_field(write_cube(tmp_path), FieldOptions(features="file"))


def test_a_file_that_is_no_mesh_names_the_file(tmp_path):
    for name in ("empty.vtk", "empty.vtu", "empty.msh", "empty.mesh", "empty.stl", "empty.xyz", "cut.vtk.gz"):
        path = tmp_path / name
        path.write_bytes(b"nothing of use")
        with pytest.raises(octafield.IoError, match=name):
            read_input(path)
    with pytest.raises(octafield.IoError, match="absent"):
        read_input(tmp_path / "absent.vtk")


@pytest.mark.parametrize("bad", [{"boundary": "loose"}, {"features": "some"}, {"feature_angle": 4.0},
                                     {"edge_length": -1.0},
                                 {"edge_length": math.nan}, {"seed": -1}, {"threads": -2},
                                 {"representation": "none"}])  # fmt: skip
def test_options_out_of_range_are_refused(bad):
    with pytest.raises(octafield.InvalidInput):
        FieldOptions(**bad)


def test_progress_names_the_phases_in_order_and_false_cancels(tmp_path):
    seen = []
    compute_field(write_cube(tmp_path), COARSE, lambda phase, fraction, merit: seen.append(phase))
    assert list(dict.fromkeys(seen)) == ["read", "mesh", "surface", "smooth", "analyse"]
    with pytest.raises(octafield.Cancelled):
        compute_field(write_cube(tmp_path), COARSE, lambda phase, fraction, merit: phase != "surface")


def test_surface_field_of_a_sphere_for_several_symmetries(tmp_path):
    path = write_sphere(tmp_path)
    for symmetry in (2, 4, 6):
        result = compute_surface_field(path, SurfaceFieldOptions(symmetry=symmetry, remesh=False))
        assert result.record["triangles"] == 1280
        assert result.record["index_sum"] == pytest.approx(2)
        assert all(
            abs(s["index"] * symmetry - round(s["index"] * symmetry)) < 1e-12 for s in result.record["singularities"]
        )
        assert all(set(s) == {"position", "index", "boundary"} for s in result.record["singularities"])


def test_repair_is_done_on_request_only_and_reported():
    path = shared(SHARED_SURFACES / "bad_insideout_s16.obj")
    with pytest.raises(octafield.GeometryError) as caught:
        load_surface(path)
    assert caught.value.kind == "inside_out"
    assert octafield.surface.signed_volume(load_surface(path, repair=True)) > 0
    assert any(
        note.startswith("repair: ") for note in prepare_mesh(path, FieldOptions(repair=True), volume=False).notes
    )


def test_feature_lines_of_a_hexme_file():
    meshed = prepare_mesh(shared(SHARED_TETS / "s01c.vtk.gz"))
    assert meshed.feature_source == "file"
    assert len(meshed.features.corners) == 8
    assert meshed.notes == []


def test_seams_of_a_closed_cad_face_are_no_features():
    meshed = prepare_mesh(shared(SHARED_TETS / "s17c.vtk.gz"))  # a sphere: one CAD face, one seam
    assert meshed.feature_source == "file"
    assert len(meshed.features.edges) == 0
    assert any("seam" in note for note in meshed.notes)


def test_volume_cells_other_than_tets_are_refused_by_type_and_count(tmp_path, cube):
    points = np.asarray(cube.tets.vertices)
    for kind, width in (("hexahedron", 8), ("pyramid", 5), ("wedge", 6)):
        path = tmp_path / f"{kind}.vtu"
        others = (kind, np.arange(2 * width).reshape(2, width))
        meshio.Mesh(points, [("tetra", np.asarray(cube.tets.tets)), others]).write(path)
        with pytest.raises(octafield.InvalidInput, match=f"{kind}.vtu: .*2 of type {kind}"):
            read_input(path)


def test_quads_of_a_surface_become_two_triangles_each(tmp_path):
    corners = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
    quads = np.array([(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2)])
    triangles = np.array([(1, 3, 7), (1, 7, 5)])
    path = tmp_path / "mixed.vtk"
    meshio.Mesh(corners, [("quad", quads), ("triangle", triangles)]).write(path)
    surface = load_surface(path)
    assert len(surface.triangles) == 12
    assert octafield.surface.signed_volume(surface) == pytest.approx(1)


@pytest.mark.parametrize("face, kept", [(0, True), (-1, True), (7, False)])
def test_lines_within_one_cad_face_are_seams_only_where_the_face_is_known(tmp_path, cube, face, kept):
    triangles, lines = np.asarray(cube.surface.triangles), np.asarray(cube.features.edges)
    ids = [np.full(len(triangles), face), np.ones(len(lines), int)]
    path = tmp_path / "faces.vtu"
    cells = [("triangle", triangles), ("line", lines)]
    meshio.Mesh(np.asarray(cube.surface.vertices), cells, cell_data={"CellEntityIds": ids}).write(path)
    assert len(read_input(path).lines) == (len(lines) if kept else 0)


def test_written_files_do_not_depend_on_the_thread_count(tmp_path, sphere_problem):
    for threads in (1, 2):
        (tmp_path / str(threads)).mkdir()
        result = run_field(sphere_problem, replace(ROUND, threads=threads))
        write_field_result(result, tmp_path / str(threads))
        assert result.record["options"]["threads"] == threads
    written = {name for name in FIELD_FILES if (tmp_path / "1" / name).exists()}
    assert set(FIELD_FILES) - written == {"mesh.vtu"}  # a comparison's, where it is asked for
    for name in sorted(written):
        assert (tmp_path / "1" / name).read_bytes() == (tmp_path / "2" / name).read_bytes()


def test_integers_of_numpy_are_taken_and_fractions_refused():
    options = FieldOptions(seed=np.int64(3), threads=np.int32(1))
    assert type(options.seed) is int and type(options.threads) is int
    for bad in ({"threads": 2**31}, {"seed": 2**64}, {"seed": 1.0}, {"max_iterations": 2.5}, {"threads": "2"}):
        with pytest.raises(octafield.InvalidInput, match="integer"):
            FieldOptions(**bad)
    with pytest.raises(octafield.InvalidInput, match="symmetry"):
        SurfaceFieldOptions(symmetry=2**31)


@pytest.mark.parametrize("sampling", ["vertices", "tets"])
@pytest.mark.parametrize("kind", ["surface", "tets"])
def test_a_run_validates_its_mesh_once(tmp_path, kind, sampling):
    """Every crossing into C++ that is handed a TetMesh instead of the domain would validate it again."""
    options = FieldOptions(sampling=sampling, edge_length=0.4, sizes="axes", streamlines=2)
    source = generate("box") if kind == "surface" else octafield.volume.tetrahedralize(generate("box"), edge_length=0.4)
    before = octafield.TetDomain.made()
    result = compute_field(source, options if kind == "surface" else replace(options, edge_length=0))
    write_field_result(result, tmp_path)
    assert octafield.TetDomain.made() == before + 1


@pytest.mark.parametrize("options", [{"remesh": False}, {"edge_length": 0.3}, {"edge_length": 0.3, "curvature": 5}])
def test_a_surface_run_validates_its_surface_once(tmp_path, options):
    """Counted from the field on: remeshing works on surfaces that change."""
    options = SurfaceFieldOptions(**options)
    meshed = octafield.prepare_mesh(generate("cylinder"), options, volume=False)
    before = octafield.surface.SurfaceDomain.made()
    result = octafield.compute_surface_field(meshed, options)
    write_surface_result(result, tmp_path)
    assert octafield.surface.SurfaceDomain.made() == before + 1


def in_halves(tets):
    """With a region on either side of x = 0."""
    centres = np.asarray(tets.vertices)[np.asarray(tets.tets)].mean(axis=1)
    return octafield.TetDomain(tets.mesh, regions=(centres[:, 0] > 0).astype(np.int32) + 1)


@pytest.mark.parametrize("sampling", ["vertices", "tets"])
@pytest.mark.parametrize("body, boundary", [("cylinder", "aligned"), ("ball", "fixed"), ("halves", "aligned")])
def test_the_recipe_of_cpp_gives_the_same_bits(body, boundary, sampling):
    options = FieldOptions(edge_length=0.4, boundary=boundary, sampling=sampling, seed=3)
    source = generate("ball" if body == "halves" else body)
    meshed = octafield.prepare_mesh(source, options)
    if body == "halves":
        options = replace(options, edge_length=0)
        meshed = octafield.prepare_mesh(in_halves(meshed.volume()), options)
        assert meshed.interface_triangles > 0
    result = compute_field(meshed, options)
    compute = octafield.volume.computed_field if sampling == "vertices" else octafield.volume.computed_tet_field
    found = compute(meshed.volume(), mode=boundary, seed=3)
    assert found.cross_field.energy == result.direction_field.energy
    assert found.analysis.energy == result.record["energy"]
    np.testing.assert_array_equal(found.combed.frames, result.frames)
    np.testing.assert_array_equal(found.constraints.kind, result.constraints.kind)
    np.testing.assert_array_equal(found.analysis.alignment, result.alignment)
