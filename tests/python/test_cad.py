"""CAD models come in by Gmsh, with their curves as features; the models are made here, by Gmsh."""

import contextlib
import gzip
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import gmsh
import numpy as np
import octafield as of
import pytest
from octafield.domain.inputs import read_input
from octafield.inspect.info import examine
from octafield.meshes.gmsh import cad
from octafield.runs.conversion import convert_file


@contextlib.contextmanager
def opened_gmsh():
    gmsh.initialize(["test"], readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        yield gmsh.model.occ
    finally:
        gmsh.finalize()


def write_models(folder, models):
    """models: what draws each, by name, and its suffixes."""
    with opened_gmsh() as occ:
        for name, (draw, suffixes) in models.items():
            gmsh.model.add(name)
            draw(occ)
            occ.synchronize()
            for suffix in suffixes:
                gmsh.write(str(folder / f"{name}{suffix}"))
    return folder


def block_with_hole(occ):
    occ.cut([(3, occ.addBox(0, 0, 0, 2, 1, 1))], [(3, occ.addCylinder(1, 0.5, -1, 0, 0, 3, 0.3))])


@pytest.fixture(scope="module")
def part(tmp_path_factory):
    """A block of 2 x 1 x 1 with a hole of radius 0.3 through it, as STEP and BREP."""
    return write_models(tmp_path_factory.mktemp("cad"), {"part": (block_with_hole, (".step", ".brep"))})


@pytest.mark.parametrize("suffix", [".step", ".brep", ".step.gz"])
def test_a_model_becomes_a_closed_surface_with_its_curves_as_features(part, tmp_path, suffix):
    path = part / f"part{suffix}"
    if suffix.endswith(".gz"):
        path = tmp_path / path.name
        path.write_bytes(gzip.compress((part / path.name.removesuffix(".gz")).read_bytes()))
    found = read_input(path, edge_length=0.1)
    of.require_valid(found.surface)
    assert found.kind == "surface" and found.lines_are_features()
    assert of.surface.signed_volume(found.surface) == pytest.approx(2 - np.pi * 0.09, rel=0.01)
    ends = np.asarray(found.surface.vertices)[found.lines]
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    assert lengths.sum() == pytest.approx(
        4 * (2 + 1 + 1) + 2 * 2 * np.pi * 0.3, rel=0.01
    )  # the seam of the hole is no feature
    assert lengths.max() < 0.13 and any("seam" in note for note in found.notes)
    assert len(np.unique(found.faces)) == 7


def test_a_field_is_computed_in_a_model(part):
    result = of.compute_field(part / "part.step", of.FieldOptions(edge_length=0.15))
    assert result.record["feature_source"] == "file" and result.record["complex_edges"] == 0
    assert result.record["feature_alignment_deg"]["max"] < 1e-6


def test_what_the_caller_has_in_gmsh_stays_as_it_was(part):
    with opened_gmsh():
        gmsh.option.setNumber("Mesh.MeshSizeMax", 7.0)
        gmsh.model.add("mine")
        read_input(part / "part.brep", edge_length=0.3)
        assert gmsh.isInitialized() and gmsh.model.getCurrent() == "mine"
        assert gmsh.option.getNumber("Mesh.MeshSizeMax") == 7.0


@pytest.mark.parametrize("content", [b"", b"ISO-10303-21;\nnonsense", bytes(range(256))])
def test_damaged_models_are_refused(tmp_path, content):
    for suffix in (".step", ".brep", ".iges"):
        (tmp_path / f"a{suffix}").write_bytes(content)
        with pytest.raises(of.Error, match=f"a{suffix}"):
            read_input(tmp_path / f"a{suffix}")
    with pytest.raises(of.IoError, match="no such file"):
        read_input(tmp_path / "none.stp")


def test_without_gmsh_the_remedy_is_told(part, tmp_path, monkeypatch):
    (tmp_path / "gmsh.py").write_text("raise ImportError('not today')")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(of.InvalidInput, match=r"pip install 'octafield\[cad\]'"):
        read_input(part / "part.step")


DEFECTS = {  # of STEP text: what is replaced, by what, the message
    "cut": (lambda text: text[: len(text) // 2], "Line [0-9]+: .*export it again"),
    "not a number": (
        lambda text: text.replace("CARTESIAN_POINT('',(0.,0.,1.))", "CARTESIAN_POINT('',(0.,nan,1.))"),
        "line [0-9]+: a coordinate is nan",
    ),
    "a word": (
        lambda text: text.replace("CARTESIAN_POINT('',(0.,0.,1.))", "CARTESIAN_POINT('',(0.,x,1.))"),
        "damaged .*export it again",
    ),
    "without solids": (
        lambda text: text[: text.index("DATA;")] + "DATA;\nENDSEC;\nEND-ISO-10303-21;\n",
        "damaged|no faces",
    ),
    "a page": (lambda text: "<html></html>", "Gmsh cannot read it .Undefined Parsing: Line 2"),
}


@pytest.mark.parametrize("name", DEFECTS)
def test_damaged_step_text_is_told_with_its_line_and_the_output_stays_clean(part, tmp_path, capfd, name):
    change, message = DEFECTS[name]
    text = (part / "part.step").read_text()
    assert change(text) != text
    (tmp_path / "a.step").write_text(change(text))
    with pytest.raises(of.Error, match=rf"a\.step.*({message})"):
        read_input(tmp_path / "a.step")
    assert capfd.readouterr().out == ""


def test_damaged_packed_models_are_told_as_such(part, tmp_path):
    (tmp_path / "a.step.gz").write_bytes(gzip.compress((part / "part.step").read_bytes())[:-50])
    with pytest.raises(of.IoError, match="damaged gzip file"):
        read_input(tmp_path / "a.step.gz")


# Damaged models may crash or hang Gmsh: it works in a process of its own.


def test_a_point_of_two_coordinates_is_an_error_of_the_file(part, tmp_path, capfd):
    text = (part / "part.step").read_text()
    (tmp_path / "flat.step").write_text(text.replace("CARTESIAN_POINT('',(0.,0.,1.))", "CARTESIAN_POINT('',(0.,0.))"))
    with pytest.raises(of.IoError, match=r"flat\.step: .*export it again"):  # Open CASCADE 7.8 ends by SIGSEGV
        read_input(tmp_path / "flat.step")
    record = examine(tmp_path / "flat.step")
    assert not record["ok"] and record["requirements"][0]["remedy"] == "export it again"
    assert capfd.readouterr().out == ""


ENDINGS = {  # what the process does, the message
    "os.kill(os.getpid(), signal.SIGSEGV)": "stopped by signal SIGSEGV: .*; export it again",
    "os.kill(os.getpid(), signal.SIGKILL)": "SIGKILL, most likely because memory ran out; choose a larger edge length",
    "os.abort()": "stopped by signal SIGABRT: .*; export it again",
    "print('one'); sys.exit('words')": r"no answer \(exit code 1: words\)",
    "pass": r"no answer \(exit code 0\)",
    "raise MemoryError": r"no answer \(exit code 1: MemoryError\)",
}


@pytest.mark.parametrize("work", ENDINGS)
def test_however_the_process_ends_the_file_is_named(part, tmp_path, monkeypatch, capfd, work):
    (tmp_path / "worker.py").write_text(
        f"import os, resource, signal, sys\nresource.setrlimit(resource.RLIMIT_CORE, (0, 0))\n{work}\n"
    )
    monkeypatch.setattr(cad, "_WORKER", tmp_path / "worker.py")
    with pytest.raises(of.IoError, match=rf"part\.step: Gmsh .*{ENDINGS[work]}"):
        read_input(part / "part.step")
    assert capfd.readouterr() == ("", "")


def test_without_a_python_to_start_the_remedy_is_told(part, monkeypatch):
    monkeypatch.setattr(sys, "executable", "")
    with pytest.raises(of.IoError, match=r"part\.step: .*give the \.msh"):
        read_input(part / "part.step")
    monkeypatch.setattr(sys, "executable", "/none/python")
    with pytest.raises(of.IoError, match=r"part\.step: cannot start /none/python"):
        read_input(part / "part.step")


SLEEPER = f"""import importlib.util, os, time
spec = importlib.util.spec_from_file_location("worker", {str(cad._WORKER)!r})
worker = importlib.util.module_from_spec(spec)
spec.loader.exec_module(worker)

def sleep(job):
    with open("pid.new", "w") as file:
        file.write(str(os.getpid()))
    os.rename("pid.new", "pid")
    time.sleep(60)

worker._answer = sleep
worker.main()
"""
READER = """import sys
from pathlib import Path
from octafield.domain import inputs
from octafield.meshes.gmsh import cad
cad._WORKER = Path("sleeper.py")
inputs.read_input(sys.argv[1])
"""


def wait_for(condition):
    end = time.monotonic() + 120
    while not condition() and time.monotonic() < end:
        time.sleep(0.02)
    assert condition()


def is_gone(folder):
    """Whether the process that told its id there has ended."""
    try:
        return Path("/proc", (folder / "pid").read_text(), "stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except FileNotFoundError:
        return True


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_no_process_outlives_a_reader_that_is_stopped(part, tmp_path, number):
    (tmp_path / "sleeper.py").write_text(SLEEPER)
    (tmp_path / "scratch").mkdir()
    environment = {**os.environ, "TMPDIR": str(tmp_path / "scratch"), "PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-c", READER, part / "part.step"]
    with subprocess.Popen(command, cwd=tmp_path, env=environment, stderr=subprocess.PIPE, text=True) as reader:
        wait_for((tmp_path / "pid").exists)
        reader.send_signal(number)
        words = reader.communicate(timeout=120)[1]
    wait_for(lambda: is_gone(tmp_path))
    if number == signal.SIGINT:
        assert words.strip().endswith("KeyboardInterrupt") and not any((tmp_path / "scratch").iterdir())


def test_the_callback_may_cancel(part, tmp_path, monkeypatch):
    (tmp_path / "sleeper.py").write_text(SLEEPER)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(cad, "_WORKER", tmp_path / "sleeper.py")
    with pytest.raises(of.Cancelled, match="during read"):
        of.prepare_mesh(
            part / "part.step", progress=lambda phase, *_: phase != "read" or not (tmp_path / "pid").exists()
        )
    assert is_gone(tmp_path)


# Assemblies: solids that touch become tets, a region for each.


def two_boxes(x, y=0, z=0):
    def draw(occ):
        occ.addBox(0, 0, 0, 1, 1, 1)
        occ.addBox(x, y, z, 1, 1, 1)

    return draw


def box_on_larger(occ):
    occ.addBox(0, 0, 0, 2, 2, 1)
    occ.addBox(0.5, 0.5, 1, 1, 1, 1)


def two_drums(occ):
    occ.addCylinder(0, 0, 0, 0, 0, 1, 1)
    occ.addCylinder(0, 0, 1, 0, 0, 1, 1)


def ball_in_box(occ):
    occ.addBox(0, 0, 0, 1, 1, 1)
    occ.addSphere(0.5, 0.5, 0.5, 0.3)


def ball_in_hole(radius):
    def draw(occ):
        occ.cut([(3, occ.addBox(0, 0, 0, 1, 1, 1))], [(3, occ.addSphere(0.5, 0.5, 0.5, 0.3))])
        occ.addSphere(0.5, 0.5, 0.5, radius)

    return draw


def shells(x):
    def draw(occ):
        two_boxes(x)(occ)
        occ.synchronize()
        occ.remove(gmsh.model.getEntities(3))

    return draw


def box_and_sheet(occ):
    occ.addBox(0, 0, 0, 1, 1, 1)
    occ.addRectangle(3, 0, 0, 1, 1)


def open_box(occ):
    shells(3)(occ)
    occ.remove([(2, 6)])


def pair_and_one(occ):
    two_boxes(1)(occ)
    occ.addBox(5, 0, 0, 1, 1, 1)


@pytest.fixture(scope="module")
def models(tmp_path_factory):
    both, all_three = (".step", ".brep"), (".step", ".brep", ".iges")
    drawn = {
        "face": (two_boxes(1), all_three), "near": (two_boxes(1 + 1e-6), (".step",)),
        "edge": (two_boxes(1, 1), all_three), "vertex": (two_boxes(1, 1, 1), both),
        "apart": (two_boxes(3), all_three), "partial": (box_on_larger, all_three),
        "overlap": (two_boxes(0.5, 0.5, 0.5), all_three), "same": (two_boxes(0), both),
        "inside": (ball_in_box, all_three), "filled": (ball_in_hole(0.3), (".step",)),
        "loose": (ball_in_hole(0.15), all_three), "shells": (shells(1), all_three),
        "shells_apart": (shells(2), both), "sheet": (box_and_sheet, all_three), "open": (open_box, both),
        "three": (pair_and_one, (".step",)),
        "ball": (lambda occ: occ.addSphere(0, 0, 0, 1), all_three),
        "cone": (lambda occ: occ.addCone(0, 0, 0, 0, 0, 1, 0, 1), (".iges",)),
        "curve": (lambda occ: occ.addCircle(0, 0, 0, 1), (".step",)),
        "slab": (lambda occ: occ.addBox(0, 0, 0, 1, 2, 3), (".iges",)),
        "tube": (lambda occ: occ.addTorus(0, 0, 0, 1, 0.2), (".step",)), "drums": (two_drums, (".step",)),
        "square": (lambda occ: occ.addRectangle(0, 0, 0, 1, 1), (".step",)),
    }  # fmt: skip
    return write_models(tmp_path_factory.mktemp("models"), drawn)


BALL = 4 / 3 * np.pi * 0.3**3
TOUCHING = {  # volume by region, area of the interface
    "face.step": ({1: 1, 2: 1}, 1), "face.brep": ({1: 1, 2: 1}, 1), "face.iges": ({1: 1, 2: 1}, 1),
    "near.step": ({1: 1, 2: 1}, 1),
    "shells.brep": ({1: 1, 2: 1}, 1), "shells.iges": ({1: 1, 2: 1}, 1),
    "partial.step": ({1: 4, 2: 1}, 1), "partial.brep": ({1: 4, 2: 1}, 1), "partial.iges": ({1: 4, 2: 1}, 1),
    "edge.step": ({1: 1, 2: 1}, 0), "edge.iges": ({1: 1, 2: 1}, 0), "vertex.step": ({1: 1, 2: 1}, 0),
    "overlap.step": ({1: 0.875, 2: 0.875, 3: 0.125}, 1.5), "overlap.iges": ({1: 0.875, 2: 0.875}, 0),
    "inside.step": ({1: 1 - BALL, 2: BALL}, 4 * np.pi * 0.09),
    "filled.step": ({1: 1 - BALL, 2: BALL}, 4 * np.pi * 0.09),
    "three.step": ({1: 1, 2: 1, 3: 1}, 1),
}  # fmt: skip


@pytest.mark.parametrize("name", TOUCHING)
def test_solids_that_touch_become_tets_with_a_region_each(models, name):
    volumes, interface = TOUCHING[name]
    curved = volumes[1] == 1 - BALL
    found = read_input(models / name, edge_length=0.15 if curved else 0.4)
    points, tets = np.asarray(found.tets.vertices), np.asarray(found.tets.tets)
    corners = points[tets]
    volume = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
    assert volume.min() > 0 and not any("turned over" in note for note in found.notes)
    assert len(np.unique(np.round(points, 7), axis=0)) == len(points) == len(np.unique(tets))
    for region, size in volumes.items():
        assert volume[found.regions == region].sum() == pytest.approx(size, rel=0.15 if curved else 1e-5)
    assert set(found.regions) == set(volumes)
    triangles = np.sort(np.asarray(found.surface.triangles), axis=1)
    assert len(np.unique(triangles, axis=0)) == len(triangles)
    shared = np.asarray(of.surface.triangle_areas(found.surface))[len(triangles) - found.interface_triangles :].sum()
    assert shared == pytest.approx(interface, rel=0.15 if curved else 1e-5)
    assert (
        any("solids touch" in note for note in found.notes) and found.lines_are_features() and found.ignored_lines == 0
    )
    assert (found.faces > 0).all()


@pytest.mark.parametrize("name", ["face.step", "edge.step", "inside.step"])
def test_info_tells_the_facts_of_an_assembly(models, name):
    record = examine(models / name, of.MeshOptions(edge_length=0.4))
    assert record["ok"] and record["regions"] == 2 and any("solids touch" in note for note in record["notes"])
    remedies = {r["kind"]: r["remedy"] for r in record["requirements"] if r["state"] != "pass"}
    assert remedies.pop("locking") == "--split"
    assert all(
        kind == "coarse_for_curvature" and remedy.startswith("--edge-length") for kind, remedy in remedies.items()
    )


APART = {  # volume, what is noted
    "apart.step": (2, "2 solids that do not touch"), "apart.brep": (2, "2 solids"), "apart.iges": (2, "2 solids"),
    "shells_apart.step": (2, "2 solids"), "same.step": (1, "solids overlap"),
    "loose.step": (1 - BALL * 0.875, "2 solids"), "loose.iges": (1 - BALL * 0.875, "2 solids"),
    "inside.iges": (1 - BALL, "an even number"), "ball.step": (4 / 3 * np.pi, ""),
    "ball.iges": (4 / 3 * np.pi, "seam"), "cone.iges": (np.pi / 3, "seam"),
}  # fmt: skip


@pytest.mark.parametrize("name", APART)
def test_solids_that_do_not_touch_become_triangles(models, name):
    found = read_input(models / name, edge_length=0.2)
    of.require_valid(found.surface)
    assert found.kind == "surface" and of.surface.signed_volume(found.surface) == pytest.approx(
        APART[name][0], rel=0.05
    )
    assert APART[name][1] in " ".join(found.notes)


@pytest.mark.parametrize("length", [1e-5, -1, float("nan")])
def test_edge_lengths_that_no_machine_can_mesh_are_refused(models, length):
    with pytest.raises(of.InvalidInput, match=r"face\.step: .*edge length") as raised:
        read_input(models / "face.step", edge_length=length)
    assert raised.value.kind == "invalid_option"


def test_bodies_may_lack_curves_and_models_faces(models):
    found = read_input(models / "ball.step", edge_length=0.4)
    assert found.lines is None or not len(found.lines)
    with pytest.raises(of.InvalidInput, match="the model has no faces"):
        read_input(models / "curve.step")


@pytest.mark.parametrize("name", ["open.step", "sheet.iges"])
def test_faces_that_enclose_nothing_are_not_dropped(models, name):
    record = examine(models / name, of.MeshOptions(edge_length=0.4))
    failed = {r["requirement"]: r["message"] for r in record["requirements"] if r["state"] == "fail"}
    assert list(failed) == ["closed"] and any(
        "enclose nothing" in note and "export them as solids" in note for note in record["notes"]
    )


def test_open_faces_of_a_model_are_told_what_to_export(models):
    with pytest.raises(of.GeometryError, match="export the model as solids, or take octafield surface-field"):
        of.prepare_mesh(models / "square.step", of.MeshOptions(edge_length=0.4))


@pytest.mark.parametrize("name, volume", [("ball.step", 4 / 3 * np.pi), ("tube.step", 2 * np.pi**2 * 0.2**2)])
def test_triangles_follow_what_bends_in_a_model(models, name, volume):
    found = read_input(models / name)
    assert of.surface.signed_volume(found.surface) == pytest.approx(volume, rel=0.008)
    assert not any("of its volume" in note for note in found.notes)


def test_a_mesh_that_loses_volume_of_the_model_says_how_much(models):
    found = read_input(models / "drums.step", edge_length=1)
    p = np.asarray(found.tets.vertices)[np.asarray(found.tets.tets)]
    share = np.linalg.det(p[:, 1:] - p[:, :1]).sum() / 6 / (2 * np.pi)
    assert share < 0.99 and any(f"has {share:.1%} of its volume" in note for note in found.notes)


@pytest.mark.parametrize("suffix", [".step", ".brep"])
def test_faces_beside_solids_are_left_out_and_told(models, suffix):
    found = read_input(models / f"sheet{suffix}", edge_length=0.5)
    assert of.surface.signed_volume(found.surface) == pytest.approx(1) and np.asarray(found.surface.vertices)[
        :, 0
    ].max() == pytest.approx(1)
    assert any("bound no solid were left out: 1" in note for note in found.notes)


def test_loose_faces_of_iges_are_sewn(models):
    found = read_input(models / "slab.iges", edge_length=0.5)
    of.require_valid(found.surface)
    points, lines = np.asarray(found.surface.vertices), np.asarray(found.lines)
    lengths = np.linalg.norm(points[lines[:, 1]] - points[lines[:, 0]], axis=1)
    assert of.surface.signed_volume(found.surface) == pytest.approx(6) and lengths.sum() == pytest.approx(
        4 * (1 + 2 + 3)
    )


def test_a_field_is_computed_in_an_assembly(models):
    result = of.compute_field(models / "partial.step", of.FieldOptions(edge_length=0.5))
    assert result.record["regions"] == 2 and result.record["feature_alignment_deg"]["max"] < 1e-6
    assert not any("ignored" in note for note in result.record["notes"])
    again = of.compute_field(models / "partial.step", of.FieldOptions(edge_length=0.5))
    assert (
        again.record["mesh_sha256"] == result.record["mesh_sha256"]
        and again.record["energy"] == result.record["energy"]
    )
    finer = of.compute_field(models / "partial.step", of.FieldOptions(edge_length=0.3, interfaces=False))
    assert finer.record["tets"] > 2 * result.record["tets"] and not finer.record.get("interface_triangles")


def test_an_assembly_is_converted_with_its_regions(models, tmp_path):
    done = convert_file(models / "face.step", tmp_path / "face.vtk", edge_length=0.3)
    found, source = read_input(tmp_path / "face.vtk"), read_input(models / "face.step", edge_length=0.3)
    assert (
        done.kind == "tets" and np.array_equal(found.regions, source.regions) and len(found.lines) == len(source.lines)
    )
    assert found.interface_triangles == source.interface_triangles > 0 and np.array_equal(
        np.sort(found.faces), np.sort(source.faces)
    )
