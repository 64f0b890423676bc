"""CAD models come in by Gmsh, with their curves as features; the models are made here, by Gmsh."""

import gzip
import sys

import gmsh
import numpy as np
import pytest

import octafield as of
from octafield.inputs import read_input


@pytest.fixture(scope="module")
def part(tmp_path_factory):
    """A block of 2 x 1 x 1 with a hole of radius 0.3 through it, as STEP and BREP."""
    folder = tmp_path_factory.mktemp("cad")
    gmsh.initialize(["test"], readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        block = gmsh.model.occ.addBox(0, 0, 0, 2, 1, 1)
        pin = gmsh.model.occ.addCylinder(1, 0.5, -1, 0, 0, 3, 0.3)
        gmsh.model.occ.cut([(3, block)], [(3, pin)])
        gmsh.model.occ.synchronize()
        for suffix in (".step", ".brep"):
            gmsh.write(str(folder / f"part{suffix}"))
    finally:
        gmsh.finalize()
    return folder


@pytest.mark.parametrize("suffix", [".step", ".brep", ".step.gz"])
def test_a_model_becomes_a_closed_surface_with_its_curves_as_features(part, tmp_path, suffix):
    path = part / f"part{suffix}"
    if suffix.endswith(".gz"):
        path = tmp_path / path.name
        path.write_bytes(gzip.compress((part / path.name.removesuffix(".gz")).read_bytes()))
    found = read_input(path, edge_length=0.1)
    of.require_valid(found.surface)
    assert found.kind == "surface" and found.lines_are_features()
    assert of.signed_volume(found.surface) == pytest.approx(2 - np.pi * 0.09, rel=0.01)
    ends = np.asarray(found.surface.vertices)[found.lines]
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    assert lengths.sum() == pytest.approx(4 * (2 + 1 + 1) + 2 * 2 * np.pi * 0.3, rel=0.01)  # the seam of the hole is no feature
    assert lengths.max() < 0.13 and any("seam" in note for note in found.notes)
    assert len(np.unique(found.faces)) == 7


def test_a_field_is_computed_in_a_model(part):
    result = of.compute_field(part / "part.step", of.FieldOptions(edge_length=0.15))
    assert result.record["feature_source"] == "file" and result.record["complex_edges"] == 0
    assert result.record["feature_alignment_deg"]["max"] < 1e-6


def test_the_callers_session_of_gmsh_stays_as_it_was(part):
    gmsh.initialize(["test"], readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("Mesh.MeshSizeMax", 7.0)
        gmsh.model.add("mine")
        read_input(part / "part.brep", edge_length=0.3)
        assert gmsh.isInitialized() and gmsh.model.getCurrent() == "mine"
        assert gmsh.option.getNumber("Mesh.MeshSizeMax") == 7.0 and "octafield input" not in gmsh.model.list()
    finally:
        gmsh.finalize()


@pytest.mark.parametrize("content", [b"", b"ISO-10303-21;\nnonsense", bytes(range(256))])
def test_damaged_models_are_refused(tmp_path, content):
    for suffix in (".step", ".brep", ".iges"):
        (tmp_path / f"a{suffix}").write_bytes(content)
        with pytest.raises(of.Error, match=f"a{suffix}"):
            read_input(tmp_path / f"a{suffix}")
    with pytest.raises(of.IoError, match="no such file"):
        read_input(tmp_path / "none.stp")


def test_without_gmsh_the_remedy_is_told(part, monkeypatch):
    monkeypatch.setitem(sys.modules, "gmsh", None)
    with pytest.raises(of.InvalidInput, match=r"pip install 'octafield\[cad\]'"):
        read_input(part / "part.step")


DEFECTS = {  # of STEP text: what is replaced, by what, the message
    "cut": (lambda text: text[: len(text) // 2], "Line [0-9]+: .*export it again"),
    "not a number": (lambda text: text.replace("CARTESIAN_POINT('',(0.,0.,1.))", "CARTESIAN_POINT('',(0.,nan,1.))"), "line [0-9]+: a coordinate is nan"),
    "a word": (lambda text: text.replace("CARTESIAN_POINT('',(0.,0.,1.))", "CARTESIAN_POINT('',(0.,x,1.))"), "damaged .*export it again"),
    "without solids": (lambda text: text[: text.index("DATA;")] + "DATA;\nENDSEC;\nEND-ISO-10303-21;\n", "damaged|no faces"),
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


def test_bodies_without_curves_and_several_solids(tmp_path):
    gmsh.initialize(["test"], readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.occ.addSphere(0, 0, 0, 1)
        gmsh.model.occ.synchronize()
        gmsh.write(str(tmp_path / "ball.step"))
        gmsh.model.occ.addBox(2, 0, 0, 1, 1, 1)
        gmsh.model.occ.synchronize()
        gmsh.write(str(tmp_path / "two.step"))
        gmsh.model.add("nothing")
        gmsh.model.occ.addCircle(0, 0, 0, 1)
        gmsh.model.occ.synchronize()
        gmsh.write(str(tmp_path / "curve.step"))
    finally:
        gmsh.finalize()
    ball, two = read_input(tmp_path / "ball.step", edge_length=0.4), read_input(tmp_path / "two.step", edge_length=0.4)
    for found in (ball, two):
        of.require_valid(found.surface)
    assert ball.lines is None or not len(ball.lines)
    assert len(two.lines) == 12 * 3 and of.signed_volume(two.surface) == pytest.approx(1 + 4 / 3 * np.pi, rel=0.1)
    with pytest.raises(of.InvalidInput, match="the model has no faces"):
        read_input(tmp_path / "curve.step")


def test_loose_faces_of_iges_are_sewn(tmp_path):
    gmsh.initialize(["test"], readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.occ.addBox(0, 0, 0, 1, 2, 3)
        gmsh.model.occ.synchronize()
        gmsh.write(str(tmp_path / "box.iges"))
    finally:
        gmsh.finalize()
    found = read_input(tmp_path / "box.iges", edge_length=0.5)
    of.require_valid(found.surface)
    assert of.signed_volume(found.surface) == pytest.approx(6) and len(found.lines) == 4 * (2 + 4 + 6)
