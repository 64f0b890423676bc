"""What a field is told to be worth: no false alarm on simple parts, and the cause where it is coarse."""

import numpy as np
import octafield as of
import pytest
from conftest import SHARED_DATA
from octafield.domain.generators import generate
from octafield.fields import verdict
from octafield.inspect.info import examine
from pipeline_fixtures import octafield, shared


@pytest.mark.parametrize("name", ["box", "cylinder"])
def test_simple_parts_are_fine(name):
    found = of.compute_field(generate(name), of.FieldOptions(edge_length=0.25, streamlines=0)).record["verdict"]
    assert found == {"state": "fine", "sentences": ["fine"], "vertices": [], "suggested_edge_length": None}


@pytest.mark.parametrize("sampling", ["vertices", "tets"])
def test_places_no_hex_mesh_has_are_counted(sampling):
    record = of.compute_field(
        generate("ball"), of.FieldOptions(edge_length=0.3, streamlines=0, sampling=sampling)
    ).record
    assert record["verdict"]["state"] == "not meshable" and record["non_meshable_vertices"] > 0
    assert f"{record['non_meshable_vertices']:,} singular vertices" in record["verdict"]["sentences"][0]


def test_turned_frames_are_told_as_off_their_normals():
    meshed = of.prepare_mesh(generate("box"), of.MeshOptions(edge_length=0.3))
    turned = np.tile([np.cos(np.pi / 8), 0, 0, np.sin(np.pi / 8)], (len(meshed.tets.vertices), 1))  # 45 degrees about z
    found = of.analyse(meshed, turned, options=of.FieldOptions(streamlines=0)).record["verdict"]
    assert found["state"] == "coarse" and "differ by more than 20 degrees" in found["sentences"][0]
    points = np.asarray(meshed.tets.vertices)[found["vertices"]]
    low, high = np.asarray(meshed.tets.vertices).min(axis=0), np.asarray(meshed.tets.vertices).max(axis=0)
    assert len(points) and (np.isclose(points[:, :2], low[:2]) | np.isclose(points[:, :2], high[:2])).any(axis=1).all()


def test_turns_are_those_of_the_dihedral_angle_and_features_are_left_out():
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -np.cos(np.radians(40)), -np.sin(np.radians(40))]])
    triangles = np.array([[0, 1, 2], [1, 0, 3]])
    edges, turns = verdict.smooth_turns(points, triangles, np.empty((0, 2), int))
    assert edges.tolist() == [[0, 1]] and np.allclose(turns, 40)
    assert len(verdict.smooth_turns(points, triangles, np.array([[1, 0]]))[0]) == 0


def test_a_thread_finer_than_the_edges_asked_for_is_coarse_and_the_length_told_is_shorter():
    record = of.compute_field(
        shared(SHARED_DATA / "wild/screw.stl"), of.FieldOptions(streamlines=0, edge_length=0.53)
    ).record
    assert record["verdict"]["state"] == "coarse" and record["verdict"]["vertices"]
    assert 0 < record["verdict"]["suggested_edge_length"] < record["edge_length"]


@pytest.mark.parametrize("name", ["s01", "s15", "i10"])
def test_no_false_alarm_of_coarseness(name):
    record = of.compute_field(
        shared(SHARED_DATA / f"surfaces/{name}_surface.obj"), of.FieldOptions(streamlines=0)
    ).record
    assert record["verdict"]["state"] != "coarse"


def test_info_says_what_to_expect(tmp_path):
    assert examine(tmp_path / "none.stl")["verdict"]["state"] == "no field"
    path = tmp_path / "box.stl"
    of.write_surface(generate("box"), path)
    assert examine(path)["verdict"]["state"] == "fine"
    assert octafield("info", path).stdout.rstrip().endswith("verdict: fine")
    coarse = examine(path, of.MeshOptions(edge_length=5))["verdict"]
    assert coarse["state"] == "coarse" and 0 < coarse["suggested_edge_length"] < 5
