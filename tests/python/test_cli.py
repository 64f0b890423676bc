"""The command line: JSON, exit codes, one message per failure, nothing left behind."""

import json
import os
import re
import signal
import subprocess
import sys
import time

import meshio
import numpy as np
import pytest
import pyvista
from conftest import cpu_seconds
from octafield.command_line.console import error_code
from octafield.errors import SolverError
from octafield.runs.run_folder import SURFACE_FILES
from pipeline_fixtures import SHARED_SURFACES, octafield, shared, write_cube, write_sphere

FAST = ("--edge-length", "0.4")

BAD_SURFACES = {
    "bad_hole_s17": "not closed",
    "bad_flipped_s01": "orientation",
    "bad_selfcross_s15": "cross",
    "bad_soup_s04": "soup",
    "bad_insideout_s16": "wrong way",
    "bad_fin_s01": "share",
    "bad_degenerate_s17": "no area",
}


def leftovers(folder):
    return sorted(path.name for path in folder.iterdir() if "partial" in path.name)


def test_field_writes_its_files_and_the_same_record_to_json(tmp_path):
    out, figures = tmp_path / "out", tmp_path / "figures.json"
    octafield("field", write_cube(tmp_path), "-o", out, *FAST, "--json", figures, check=0)
    names = {"field.vtu", "singular.vtp", "features.vtp", "streamlines.vtp", *SURFACE_FILES, "result.json"}
    assert {path.name for path in out.iterdir()} == names
    record = json.loads(figures.read_text())
    assert record == json.loads((out / "result.json").read_text())
    assert record["input"] == str(tmp_path / "cube.obj")
    assert record["wall_seconds"]["write"] > 0


def test_json_to_stdout_is_all_that_stdout_gets(tmp_path):
    done = octafield("field", write_cube(tmp_path), "-o", tmp_path / "out", *FAST, "--json", "-", check=0)
    assert json.loads(done.stdout)["boundary"] == "aligned"


def test_without_json_a_table_goes_to_stdout_and_nothing_with_quiet(tmp_path):
    cube = write_cube(tmp_path)
    shown = octafield("field", cube, "-o", tmp_path / "a", *FAST, check=0)
    assert "energy" in shown.stdout and "\x1b" not in shown.stdout
    silent = octafield("field", cube, "-o", tmp_path / "b", *FAST, "-q", check=0)
    assert silent.stdout == "" and silent.stderr == ""


def test_surface_field_reports_indices(tmp_path):
    arguments = ("--symmetry", 6, "--no-remesh", "--json", "-")
    done = octafield("surface-field", write_sphere(tmp_path), "-o", tmp_path / "out", *arguments, check=0)
    record = json.loads(done.stdout)
    assert record["index_sum"] == pytest.approx(2) and record["euler_characteristic"] == 2
    assert {"triangles", "singularities", "energy", "epsilon", "iterations", "wall_seconds", "cpu_seconds"} <= set(
        record
    )


@pytest.mark.parametrize("method", ["gl", "mbo", "eigen"])
def test_surface_field_writes_singular_points_and_separatrices_by_every_method(tmp_path, method):
    out = tmp_path / "out"
    octafield("surface-field", write_sphere(tmp_path), "-o", out, "--method", method, "--no-remesh", "-q", check=0)
    assert {path.name for path in out.iterdir()} == {*SURFACE_FILES, "result.json"}
    record = json.loads((out / "result.json").read_text())
    assert record["method"] == method and record["index_sum"] == pytest.approx(2)
    points, curves = (pyvista.read(out / name) for name in SURFACE_FILES[1:])
    assert curves.n_cells == sum(round(4 - 4 * index) for index in points.point_data["index"])  # N - k each
    first = curves.cell_data["first_singularity"]
    starts = [curves.get_cell(i).points[0] for i in range(curves.n_cells)]
    np.testing.assert_allclose(starts, points.points[first], atol=1e-6)
    assert set(curves.cell_data["first_end"]) == {"singularity"}
    assert set(curves.cell_data["last_end"]) <= {"singularity", "length"}
    assert curves.compute_cell_sizes()["Length"] == pytest.approx(curves.cell_data["length"], rel=1e-5)


def test_the_rim_of_an_open_surface_is_followed_as_asked(tmp_path):
    disk = tmp_path / "disk.ply"
    pyvista.Disc(inner=0, r_res=8, c_res=32).triangulate().clean().save(disk)
    energies = {}
    for boundary in ("strong", "weak", "none"):
        arguments = ("--boundary-alignment", boundary, "--no-remesh", "--json", "-")
        record = json.loads(octafield("surface-field", disk, "-o", tmp_path / boundary, *arguments, check=0).stdout)
        assert record["index_sum"] == pytest.approx(1) and record["options"]["boundary_alignment"] == boundary
        energies[boundary] = record["energy"]
    assert energies["strong"] > energies["weak"] > energies["none"] == pytest.approx(0, abs=1e-6)
    octafield("surface-field", disk, "-o", tmp_path / "firm", "--boundary-alignment", "firm", check=2)


def test_info_passes_a_sound_surface_and_names_the_failure_of_a_bad_one(tmp_path):
    done = octafield("info", write_cube(tmp_path), "--json", "-", check=0)
    record = json.loads(done.stdout)
    assert record["ok"] and record["euler_characteristic"] == 2 and record["volume"] == pytest.approx(1)
    assert record["features"]["edges"] == 12 and record["features"]["corners"] == 8
    open_cube = tmp_path / "open.obj"
    open_cube.write_text("\n".join((tmp_path / "cube.obj").read_text().splitlines()[:-1]))
    failed = octafield("info", open_cube, check=2)
    assert "not closed" in failed.stderr and "fail" in failed.stdout


@pytest.mark.parametrize("name, words", BAD_SURFACES.items())
@pytest.mark.parametrize("command", ["field", "compare"])
def test_a_broken_surface_gives_one_line_naming_its_defect_and_no_folder(tmp_path, name, words, command):
    out = tmp_path / "deep" / "out"
    done = octafield(command, shared(SHARED_SURFACES / f"{name}.obj"), "-o", out, check=2)
    assert words in done.stderr and name in done.stderr
    assert len(done.stderr.splitlines()) == 1 and "Traceback" not in done.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name, words", BAD_SURFACES.items())
def test_info_names_the_defect_of_a_broken_surface_and_shows_the_rest(name, words):
    done = octafield("info", shared(SHARED_SURFACES / f"{name}.obj"), "--json", "-", check=2)
    record = json.loads(done.stdout)
    assert not record["ok"]
    assert any(r["state"] == "fail" and words in r["message"] for r in record["requirements"])
    assert len(done.stderr.splitlines()) == 1


def test_bad_usage_is_exit_code_two(tmp_path):
    cube = write_cube(tmp_path)
    assert octafield("field", cube).returncode == 2
    assert octafield("field", tmp_path / "absent.stl", "-o", tmp_path / "out").returncode == 2
    assert octafield("field", cube, "-o", tmp_path / "out", "--boundary", "loose").returncode == 2
    assert octafield("compare", cube, "-o", tmp_path / "out", "--representations", "sh5").returncode == 2
    assert octafield("surface-field", cube, "-o", tmp_path / "out", "--symmetry", "0").returncode == 2
    assert not (tmp_path / "out").exists()


def test_an_earlier_result_is_replaced_and_a_foreign_folder_refused(tmp_path):
    cube, out = write_cube(tmp_path), tmp_path / "out"
    octafield("field", cube, "-o", out, *FAST, check=0)
    (out / "mine.txt").write_text("stays")
    octafield("field", cube, "-o", out, "--edge-length", "0.5", check=0)
    assert (out / "mine.txt").read_text() == "stays"
    assert json.loads((out / "result.json").read_text())["options"]["edge_length"] == 0.5
    foreign = tmp_path / "foreign"
    foreign.mkdir()
    (foreign / "thesis.tex").write_text("precious")
    done = octafield("field", cube, "-o", foreign, check=2)
    assert "not an earlier result" in done.stderr
    assert [path.name for path in foreign.iterdir()] == ["thesis.tex"]


def test_a_failed_run_keeps_the_earlier_result(tmp_path):
    cube, out = write_cube(tmp_path), tmp_path / "out"
    octafield("field", cube, "-o", out, *FAST, check=0)
    before = (out / "result.json").read_bytes()
    octafield("field", cube, "-o", out, "--features", "file", check=2)
    assert (out / "result.json").read_bytes() == before and leftovers(out) == []


def test_representations_lists_the_registry():
    record = json.loads(octafield("representations", "--json", "-", check=0).stdout)
    assert [r["name"] for r in record["representations"]] == ["sh4", "tensor4", "su2", "odeco", "sh469"]
    assert [r["dimension"] for r in record["representations"]] == [9, 15, 6, 15, 41]
    shown = octafield("representations", check=0).stdout
    assert all(entry["name"] in shown for group in record.values() for entry in group)


def test_version_and_help(tmp_path):
    assert octafield("--version", check=0).stdout.startswith("octafield ")
    shown = octafield("--help", check=0).stdout
    assert all(command in shown for command in ("compare", "field", "surface-field", "info"))


@pytest.mark.parametrize("stop", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_an_interrupt_ends_a_comparison_at_once_and_leaves_nothing(tmp_path, stop):
    work = tmp_path / "work"
    work.mkdir()
    sphere, out = write_sphere(tmp_path), work / "out"
    command = [
        sys.executable,
        "-m",
        "octafield.command_line.fields",
        "compare",
        str(sphere),
        "-o",
        str(out),
        "--edge-length",
        "0.06",
    ]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 120
    while not leftovers(work) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert leftovers(work), "the comparison did not begin"
    time.sleep(1.0)
    assert process.poll() is None, "the comparison ended before the interrupt: give it more to do"
    before = cpu_seconds(process.pid)
    os.kill(process.pid, stop)
    os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)  # what it used can be read until it is waited for
    assert cpu_seconds(process.pid) - before < os.cpu_count()  # a second on every core
    _, messages = process.communicate(timeout=120)
    assert process.returncode == 130
    assert messages.splitlines() == ["octafield: interrupted"]
    assert list(work.iterdir()) == []


def test_file_names_beyond_ascii_are_kept_in_every_file(tmp_path):
    path = write_cube(tmp_path).rename(tmp_path / "Würfel 立方.obj")
    octafield("field", path, "-o", tmp_path / "räumlich", *FAST, check=0)
    volume = pyvista.read(tmp_path / "räumlich" / "field.vtu").GetFieldData().GetAbstractArray("input")
    assert bytes(np.asarray(volume)).rstrip(b"\0").decode() == str(path)
    for name in ("singular.vtp", "features.vtp", "streamlines.vtp", *SURFACE_FILES):
        words = pyvista.read(tmp_path / "räumlich" / name).GetFieldData().GetAbstractArray("input")
        assert words.GetValue(0) == str(path), name


def test_a_file_name_that_is_not_utf8_is_refused_before_the_work(tmp_path):
    work = tmp_path / "work"
    work.mkdir()
    name = os.fsencode(tmp_path) + b"/bad\xff.obj"
    os.rename(write_cube(tmp_path), name)
    done = octafield("field", os.fsdecode(name), "-o", work / "out", check=2)
    assert "not UTF-8" in done.stderr and list(work.iterdir()) == []
    done = octafield("field", write_cube(tmp_path), "-o", os.fsdecode(os.fsencode(work) + b"/bad\xff"), check=2)
    assert "not UTF-8" in done.stderr and list(work.iterdir()) == []


def test_brackets_in_file_names_are_no_markup(tmp_path):
    path = write_cube(tmp_path).rename(tmp_path / "[bold]x[red].obj")
    assert path.name in octafield("info", path, check=0).stdout
    assert path.name in octafield("compare", path, "-o", tmp_path / "out", "--edge-length", "0.5", check=0).stdout


def test_a_json_target_that_cannot_be_written_is_refused_before_the_work(tmp_path):
    cube = write_cube(tmp_path)
    for target in (tmp_path, cube / "figures.json"):
        done = octafield("field", cube, "-o", tmp_path / "out", "--json", target, check=2)
        assert "cannot write there" in done.stderr and not (tmp_path / "out").exists()


def test_integers_beyond_those_of_the_core_are_usage_errors(tmp_path):
    cube, out = write_cube(tmp_path), tmp_path / "out"
    octafield("field", cube, "-o", out, "--threads", 2**31, check=2)
    octafield("surface-field", cube, "-o", out, "--symmetry", 2**31, check=2)
    octafield("compare", cube, "-o", out, "--seed", 2**64 - 1, "--seeds", 2, check=2)
    assert not out.exists()


def test_a_solver_error_is_bad_input_where_an_option_caused_it_and_a_defect_elsewhere(capsys):
    assert error_code(SolverError("the field vanishes; choose a smaller epsilon", "epsilon_too_large")) == 2
    assert capsys.readouterr().err == "octafield: error: the field vanishes; choose a smaller epsilon\n"
    assert error_code(SolverError("a diffusion step failed", "diffusion")) == 1
    assert "defect" in capsys.readouterr().err


def test_a_folder_as_input_is_called_a_folder(tmp_path):
    folder = tmp_path / "mesh.vtk"
    folder.mkdir()
    assert "is a folder" in octafield("info", folder, check=2).stderr


def test_repair_is_advised_only_where_it_may_help(tmp_path):
    open_cube = write_cube(tmp_path)
    open_cube.write_text("\n".join(open_cube.read_text().splitlines()[:-1]))
    assert "--repair" in octafield("info", open_cube, check=2).stderr
    points = [[0, 0, 0], [0, 0, 1], [1, 0, 0], [1, 1, 0], [-1, 0, 0], [-1, -1, 0]]
    tets = tmp_path / "apart.vtu"  # two tets with one edge in common, whose points are there twice
    twice = np.array([points[i] for i in (0, 1, 2, 3, 0, 1, 4, 5)], float)
    meshio.Mesh(twice, [("tetra", np.arange(8).reshape(2, 4))]).write(tets)
    for command in (("info", tets), ("field", tets, "-o", tmp_path / "out")):
        message = octafield(*command, check=2).stderr
        assert f"{tets}: 2 vertices coincide" in message and message.endswith(
            "; correct the tet mesh where it was made\n"
        )
    meshio.Mesh(np.array(points, float), [("tetra", np.array([[0, 1, 2, 3], [0, 1, 4, 5]]))]).write(tets)
    for command in (("info", tets), ("field", tets, "-o", tmp_path / "out")):
        octafield(*command, check=0)  # tets may touch
    fin = tmp_path / "fin.obj"  # three fans on one edge: no single dangling triangle to remove
    fin.write_text("\n".join(f"v {x} {y} {z}" for x, y, z in points) + "\nf 1 2 3\nf 1 2 4\nf 1 2 5\n")
    assert "no level of --repair makes it sound" in octafield("info", fin, "--repair", "safe", check=2).stderr


def test_doctor_finds_this_installation_sound(tmp_path):
    octafield("doctor", "--json", tmp_path / "d.json", "-q", check=0)
    record = json.loads((tmp_path / "d.json").read_text())
    assert record["ok"] and {c["state"] for c in record["checks"]} <= {"pass", "not installed"}
    assert set(record["libraries"]) == {"CGAL", "CHOLMOD", "Ceres", "Eigen", "TetGen", "VTK"}
    assert all(re.fullmatch(r"\d+(\.\d+)+", version) for version in record["libraries"].values())
    assert "smoothing (Ceres)" in {c["name"] for c in record["checks"] if c["state"] == "pass"}


def test_view_draws_the_folder_of_a_field_and_refuses_others(tmp_path):
    octafield("field", write_sphere(tmp_path), "-o", tmp_path / "out", "-q", check=0)
    octafield("view", tmp_path / "out", "-o", tmp_path / "curves.png", check=0)
    assert (tmp_path / "curves.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    assert "surface.vtp: no such file" in octafield("view", tmp_path, "-o", tmp_path / "x.png", check=2).stderr
    assert not (tmp_path / "x.png").exists()


@pytest.mark.parametrize(
    ("display", "words"), [("", "there is no display"), (":987", "the display :987 cannot be opened")]
)
def test_view_without_a_display_says_so_and_names_the_way_to_a_picture(tmp_path, monkeypatch, display, words):
    monkeypatch.setenv("DISPLAY", display)
    for name in ("surface", "singular"):
        pyvista.Sphere().save(tmp_path / f"{name}.vtp")
    errors = octafield("view", tmp_path, check=2).stderr
    assert words in errors and "-o curves.png" in " ".join(errors.split()), errors
