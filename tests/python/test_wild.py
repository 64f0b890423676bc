"""Inputs that went wrong once, by the command line's default: what other tests do not say of them yet. Skipped without
the data folder."""

import json
import subprocess
import sys

import octafield as of
import pytest
from conftest import SHARED_DATA
from pipeline_fixtures import octafield, shared

WILD = SHARED_DATA / "wild"


def field_of(name, folder, *options):
    octafield("field", shared(WILD / name), "-o", folder, "-q", "--json", folder / "r.json", *options, check=0)
    return json.loads((folder / "r.json").read_text())


@pytest.mark.parametrize("name", ["pipe_thin.stl", "knob.stl"])
def test_thin_walls_and_tight_bends_have_a_field_that_follows_them(name):
    path = shared(WILD / name)
    meshed = of.prepare_mesh(path)
    assert of.surface.signed_volume(meshed.surface) == pytest.approx(
        of.surface.signed_volume(of.surface.repair(of.read_surface(path), level="merge").mesh), rel=0.01
    )
    assert not of.surface.find_defects(meshed.surface)
    assert of.compute_field(meshed, of.FieldOptions(streamlines=0)).record["alignment_deg"]["median"] < 1e-6


def test_a_mesh_and_its_rotation_have_one_energy(tmp_path):
    base, turned = (field_of(f"plate_{name}.mesh", tmp_path / name, "--boundary", "fixed") for name in ("base", "rot"))
    assert turned["energy"] == pytest.approx(base["energy"], rel=1e-9)
    assert turned["edge_length"] == pytest.approx(base["edge_length"], rel=1e-12)


def test_python_ends_quietly_while_the_example_computes():
    done = subprocess.run(
        [sys.executable, str(shared(WILD / "exit_while_computing.py"))], capture_output=True, text=True, timeout=120
    )
    assert (done.returncode, done.stderr) == (0, "")
