"""Shapes whose fields are known, through the whole chain."""

import json

import numpy as np
import octafield
import pytest
from octafield.fields.direction_field import compute_surface_field
from octafield.fields.frame_field import compute_field
from octafield.options import FieldOptions, SurfaceFieldOptions
from pipeline_fixtures import SHARED_SURFACES, shared, write_sphere

MANIFEST = SHARED_SURFACES / "manifest.json"
SOUND = (
    [entry for entry in json.loads(MANIFEST.read_text()) if entry["what"] == "closed, outward"]
    if MANIFEST.exists()
    else []
)


def test_the_cross_field_of_a_sphere_has_eight_points_of_index_one_quarter(tmp_path):
    found = compute_surface_field(write_sphere(tmp_path), SurfaceFieldOptions(edge_length=0.2))
    assert [s.index for s in found.singularities.points] == [0.25] * 8
    assert found.record["index_sum"] == found.record["euler_characteristic"] == 2


@pytest.mark.parametrize("remesh", [True, False])
def test_the_indices_sum_to_the_euler_characteristic_of_every_sound_surface(remesh):
    shared(MANIFEST)
    assert len(SOUND) >= 6
    for entry in SOUND:
        for suffix in (".stl", ".obj"):
            record = compute_surface_field(
                SHARED_SURFACES / (entry["name"] + suffix), SurfaceFieldOptions(remesh=remesh)
            ).record
            assert record["euler_characteristic"] == entry["chi"], entry["name"]
            assert record["index_sum"] == entry["chi"], entry["name"]


@pytest.mark.parametrize("boundary", ["fixed", "aligned"])
def test_a_cube_has_no_singular_edge_and_no_energy(boundary):
    result = compute_field(shared(SHARED_SURFACES / "s01_surface.stl"), FieldOptions(boundary=boundary))
    random = octafield.frames.random_rotations(len(result.frames), seed=1)
    assert result.record["singular_edges"] == 0
    assert result.record["energy"] < 1e-8 * octafield.volume.dirichlet_energy(result.tets, random)
    assert result.record["alignment_deg"]["max"] < 1e-4


def test_the_singular_curves_of_a_cylinder_run_from_cap_to_cap():
    result = compute_field(
        shared(SHARED_SURFACES / "s15_surface.stl"), FieldOptions(boundary="fixed", max_iterations=60)
    )
    graph = result.singular_graph
    ends = np.array([[graph.points[c[0]], graph.points[c[-1]]] for c in graph.curves])
    extent = np.ptp(result.surface.vertices, axis=0)
    along = int(np.argmax(np.abs(extent - np.median(extent))))  # the axis of the cylinder
    assert set(graph.curve_quarter_turns) == {1}  # valence 3
    assert len(ends) == 4
    assert np.allclose(np.sort(np.abs(np.diff(ends[:, :, along], axis=1)).ravel()), extent[along], rtol=0.02)
