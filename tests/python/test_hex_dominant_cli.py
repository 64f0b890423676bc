"""octafield hex-dominant: its files as other programs read them, its JSON, what it refuses, and that nothing is left
half-written."""

import json
import shutil

import meshio
import numpy as np
import octafield as of
import pytest
import pyvista
from hex_mesh_checks import corner_jacobians, require_conforming, volume_of
from octafield.domain.generators import generate
from pipeline_fixtures import SHARED_TETS, octafield, shared, write_cube

FILES = ["mesh.mesh", "mesh.msh", "mesh.vtu", "result.json", "singular.vtp"]
KINDS = {"tetra": "tets", "hexahedron": "hexahedra", "wedge": "wedges", "pyramid": "pyramids"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Of a run on a cylinder, with its JSON beside."""
    folder = tmp_path_factory.mktemp("cylinder")
    of.write_surface(generate("cylinder"), folder / "cylinder.stl")
    octafield("hex-dominant", folder / "cylinder.stl", "-o", folder / "out", "--cells", "300", "--json",
              folder / "out.json", "-q", check=0)  # fmt: skip
    return folder


@pytest.fixture(scope="module")
def mesh(folder):
    return of.read_cells(folder / "out" / "mesh.vtu")


def test_the_folder_has_the_files_and_nothing_else(folder):
    assert sorted(path.name for path in (folder / "out").iterdir()) == FILES
    assert json.loads((folder / "out" / "result.json").read_text())["files"] == [
        "mesh.vtu", "mesh.msh", "mesh.mesh", "singular.vtp", "result.json",
    ]  # fmt: skip


def test_the_mesh_in_the_file_conforms_and_fills_the_cylinder(mesh):
    require_conforming(mesh)
    assert len(mesh.hexahedra) and len(mesh.tets) and len(mesh.pyramids)
    assert volume_of(mesh) == pytest.approx(2 * np.pi, rel=0.06)


def test_vtk_reads_the_cells_with_their_data(folder, mesh):
    grid = pyvista.read(folder / "out" / "mesh.vtu")
    assert set(np.unique(grid.celltypes)) <= {10, 12, 13, 14} and {10, 12, 14} <= set(np.unique(grid.celltypes))
    assert np.allclose(grid.cell_data["scaled_jacobian"], of.volume.scaled_jacobians(mesh), atol=1e-12)
    assert set(grid.cell_data["region"]) == {0} and set(np.unique(grid.point_data["support"])) == {0, 1, 2}
    on_surface = np.unique(np.asarray(of.volume.cell_boundary(mesh).vertex_map))
    assert np.array_equal(np.flatnonzero(grid.point_data["support"]), on_surface)
    volumes = grid.compute_cell_sizes(length=False, area=False)["Volume"]
    assert (volumes > 0).all() and volumes.sum() == pytest.approx(volume_of(mesh), rel=1e-2)
    assert bytes(grid.field_data["program"]).decode().startswith("octafield ")


@pytest.mark.parametrize("name", ["mesh.vtu", "mesh.msh", "mesh.mesh"])
def test_meshio_reads_the_same_cells_from_every_file(folder, mesh, name):
    found = meshio.read(folder / "out" / name)
    assert np.allclose(found.points, mesh.vertices, atol=1e-12)
    cells = {KINDS[block.type]: block.data for block in found.cells}
    for kind in KINDS.values():
        assert np.array_equal(np.sort(cells[kind], axis=1), np.sort(getattr(mesh, kind), axis=1))
    again = of.read_cells(folder / "out" / name)
    assert (corner_jacobians(again) > 0).all()


@pytest.mark.parametrize("name", ["mesh.msh", "mesh.mesh"])
def test_gmsh_reads_the_same_cells_and_finds_them_positive(folder, mesh, name):
    gmsh = pytest.importorskip("gmsh")
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.set_number("General.Terminal", 0)
        gmsh.open(str(folder / "out" / name))
        kinds, numbers, _ = gmsh.model.mesh.get_elements(3)
        counts = dict(zip(kinds, map(len, numbers), strict=True))
        expected = {4: len(mesh.tets), 5: len(mesh.hexahedra), 6: len(mesh.wedges), 7: len(mesh.pyramids)}
        if name == "mesh.mesh":  # of which Gmsh takes no others
            assert counts == {4: expected[4], 5: expected[5]}
            return
        assert counts == expected
        worst = gmsh.model.mesh.get_element_qualities(np.concatenate(numbers), "minDetJac")
        assert (worst > 0).all()
        total = sum(gmsh.model.mesh.get_element_qualities(np.concatenate(numbers), "volume"))
        assert total == pytest.approx(volume_of(mesh), rel=1e-6)
    finally:
        gmsh.finalize()


def test_the_json_has_what_a_table_of_meshes_needs(folder, mesh):
    record = json.loads((folder / "out.json").read_text())
    assert record == json.loads((folder / "out" / "result.json").read_text())
    assert record["cells"] == {kind: len(getattr(mesh, kind)) for kind in KINDS.values()}
    assert set(record["scaled_jacobian"]) == {kind for kind, count in record["cells"].items() if count}
    assert all(list(figures) == ["min", "p05", "mean"] for figures in record["scaled_jacobian"].values())
    assert list(record["boundary_deviation"]) == ["max", "rms"]
    assert list(record["edge_length"]) == ["target", "median", "p05", "p95"]
    assert record["inverted"] == record["nonconforming_faces"] == 0
    assert list(record["steps"]["lost"]) == ["outside", "unusable", "degenerate", "poor"]
    assert list(record["steps"]["pyramids"]) == ["combined", "raised", "split"]
    assert {"read", "mesh", "surface", "smooth", "sizes", "periodic_map", "lattice", "conform", "check",
            "write"} <= set(record["wall_seconds"])  # fmt: skip
    assert 0 < record["volume_error"] < 0.06 and 0.5 < record["hex_volume_share"] < 1
    assert record["options"]["cells"] == 300 and record["field_options"]["boundary"] == "aligned"


def test_view_draws_the_mesh_cut_open(folder, tmp_path):
    done = octafield("view", folder / "out", "-o", tmp_path / "cut.png", "--json", "-", check=0)
    assert json.loads(done.stdout)["files"] == ["mesh.vtu", "singular.vtp"]
    colours = np.unique(pyvista.read(tmp_path / "cut.png").active_scalars.reshape(-1, 3), axis=0).astype(int)
    yellow = (colours[:, 0] > 180) & (colours[:, 1] > 160) & (colours[:, 2] < 90)  # of good hexahedra
    red = (colours[:, 0] > 190) & (colours[:, 1] < 190) & (colours[:, 2] > 120)  # of the others
    assert yellow.any() and red.any()


def test_equal_runs_write_equal_files(folder, tmp_path):
    octafield("hex-dominant", folder / "cylinder.stl", "-o", tmp_path / "again", "--cells", "300", "--threads", "1",
              "-q", check=0)  # fmt: skip
    for name in ("mesh.vtu", "mesh.msh", "mesh.mesh", "singular.vtp"):
        assert (tmp_path / "again" / name).read_bytes() == (folder / "out" / name).read_bytes()


def test_a_field_of_a_file_is_followed(folder, tmp_path):
    octafield("field", folder / "cylinder.stl", "-o", tmp_path / "field", "--edge-length", "0.3", "-q", check=0)
    field = tmp_path / "field" / "field.vtu"
    octafield("hex-dominant", field, "--field", field, "-o", tmp_path / "out", "--cells", "300", "-q", check=0)
    record = json.loads((tmp_path / "out" / "result.json").read_text())
    assert record["field"]["source"] == str(field) and "representation" not in record["field"]
    require_conforming(of.read_cells(tmp_path / "out" / "mesh.vtu"))
    done = octafield("hex-dominant", folder / "cylinder.stl", "--field", field, "-o", tmp_path / "no", check=2)
    assert "holds triangles" in done.stderr and not (tmp_path / "no").exists()


def test_a_tet_mesh_with_a_file_of_sizes(tmp_path):
    path = shared(SHARED_TETS / "s02u.vtk.gz")
    points = meshio.read(_unpacked(path, tmp_path)).points
    span = np.ptp(points, axis=0).max()
    np.savetxt(tmp_path / "rows.txt", np.column_stack([points, np.full(len(points), span / 6)]))
    octafield("hex-dominant", path, "-o", tmp_path / "out", "--size", tmp_path / "rows.txt", "-q", check=0)
    record = json.loads((tmp_path / "out" / "result.json").read_text())
    assert record["edge_length"]["target"] == pytest.approx(span / 6) and "edge_to_size" in record
    require_conforming(of.read_cells(tmp_path / "out" / "mesh.vtu"))


def test_regions_and_the_interface_between_them_are_kept(tmp_path):
    path = shared(SHARED_TETS / "s01b.vtk.gz")
    octafield("hex-dominant", path, "-o", tmp_path / "out", "-q", check=0)
    grid = pyvista.read(tmp_path / "out" / "mesh.vtu")
    given = of.prepare_mesh(path).tets
    volumes = grid.compute_cell_sizes(length=False, area=False)["Volume"]
    of_tets = np.asarray(of.volume.tet_volumes(given))
    for region in np.unique(given.regions):
        expected = of_tets[np.asarray(given.regions) == region].sum()
        assert volumes[grid.cell_data["region"] == region].sum() == pytest.approx(expected, rel=0.02)
    require_conforming(of.read_cells(tmp_path / "out" / "mesh.vtu"))
    record = json.loads((tmp_path / "out" / "result.json").read_text())
    assert record["regions"] == len(np.unique(given.regions)) and record["region_volume_error"] < 0.02
    groups = {int(i) for block in meshio.read(tmp_path / "out" / "mesh.mesh").cell_data["medit:ref"] for i in block}
    assert len(groups) == record["regions"] and min(groups) >= 1


def test_points_of_a_front_on_the_command_line(tmp_path):
    wanted = ["--cells", "64", "--points", "frontal"]
    octafield("hex-dominant", write_cube(tmp_path), "-o", tmp_path / "out", *wanted, "-q", check=0)
    record = json.loads((tmp_path / "out" / "result.json").read_text())
    assert record["options"]["points"] == "frontal" and record["cells"]["hexahedra"] > 40
    require_conforming(of.read_cells(tmp_path / "out" / "mesh.vtu"))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["CUBE", "--edge-length", "-1"], "must be positive"),
        (["CUBE", "--edge-length", "nan"], "must be positive"),
        (["CUBE", "--cells", "-5"], "cells must be an integer"),
        (["CUBE", "--edge-length", "0.5", "--cells", "8"], "leave it or the number of cells out"),
        (["CUBE", "--edge-length", "0.00001"], "about 1e+15 cells"),
        (["CUBE", "--size", "absent.txt"], "absent.txt"),
        (["CUBE", "--size", "WORDS"], "not a file of sizes"),
        (["CUBE", "--size", "CUBE", "--cells", "8"], "leave one out"),
        (["CUBE", "--correction", "axis"], "did you mean 'axes'?"),
        (["CUBE", "--points", "frontl"], "did you mean 'frontal'?"),
        (["CUBE", "--field", "absent.frame"], "absent.frame|holds triangles"),
        (["CUBE", "--representation", "sh5"], "did you mean 'sh4'?"),
        (["absent.stl"], "absent.stl"),
        (["CUBE", "--tet-length", "0.5", "--max-cells", "100"], "leave it or max_cells out"),
        (["CUBE", "--sizes", "axes"], "No such option"),
    ],
)
def test_bad_input_is_one_line_exit_code_2_and_no_folder(tmp_path, arguments, words):
    (tmp_path / "words.txt").write_text("no numbers\n")
    known = {"CUBE": write_cube(tmp_path), "WORDS": tmp_path / "words.txt"}
    done = octafield("hex-dominant", *(known.get(word, word) for word in arguments), "-o", tmp_path / "out", check=2)
    line = [line for line in done.stderr.splitlines() if "error" in line]
    assert len(line) == 1 and any(word in line[0] for word in words.split("|")), done.stderr
    assert not (tmp_path / "out").exists() and done.stdout == ""
    assert not [path for path in tmp_path.iterdir() if "partial" in path.name]


def test_a_defect_found_at_the_end_writes_nothing(tmp_path, monkeypatch):
    from octafield.command_line import fields as cli
    from octafield.hexdom import hex_mesh
    from typer.testing import CliRunner

    real = hex_mesh._core.hex_dominant

    def damaged(*arguments, **options):
        made = real(*arguments, **options)
        made.mesh.vertices[0] = np.nan
        return made

    monkeypatch.setattr(hex_mesh._core, "hex_dominant", damaged)
    cube = write_cube(tmp_path)
    command = ["hex-dominant", str(cube), "-o", str(tmp_path / "out"), "--json", str(tmp_path / "e.json"), "-q"]
    assert CliRunner().invoke(cli.app, command).exit_code == 1
    assert json.loads((tmp_path / "e.json").read_text())["error"]["kind"] == "non_finite_vertex"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cube.obj", "e.json"]


def test_a_later_run_replaces_an_earlier_one_and_another_folder_is_left_alone(folder, tmp_path):
    shutil.copytree(folder / "out", tmp_path / "out")
    cube = write_cube(tmp_path)
    octafield("hex-dominant", cube, "-o", tmp_path / "out", "--cells", "8", "-q", check=0)
    assert len(of.read_cells(tmp_path / "out" / "mesh.vtu").hexahedra) == 8
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("mine")
    done = octafield("hex-dominant", cube, "-o", tmp_path / "mine", check=2)
    assert "choose another output folder" in done.stderr


def _unpacked(path, folder):
    import gzip

    plain = folder / path.name.removesuffix(".gz")
    plain.write_bytes(gzip.decompress(path.read_bytes()))
    return plain
