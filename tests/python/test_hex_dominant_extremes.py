"""Extreme and damaged inputs of the study (studies/hex_dominant/extremes.py): a sound mesh, or an error that names
cause and remedy and leaves no file."""

import sys
from pathlib import Path

import numpy as np
import octafield as of
import pytest
from hex_mesh_checks import require_conforming, volume_of

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from studies.hex_dominant import extremes  # noqa: E402
from studies.hex_dominant.extreme_inputs import EXTREMES, box_of_tets, by_height  # noqa: E402


@pytest.mark.parametrize("name", ["one_tet", "one_tet_1000", "sliver_tet", "long_box", "thin_plate", "sizes_100"])
def test_ends_with_a_sound_mesh(name, tmp_path):
    result = extremes.mesh_into(EXTREMES[name], tmp_path, tmp_path / "out")
    require_conforming(result.mesh)
    volume = np.asarray(of.volume.tet_volumes(result.field.tets)).sum()
    assert volume_of(result.mesh) == pytest.approx(volume, rel=2e-3)
    assert (tmp_path / "out" / "mesh.vtu").exists()


@pytest.mark.parametrize(
    ("name", "error", "kind", "words"),
    [
        ("flat_tet", of.SolverError, "scaling", "degenerate tets"),
        ("cube_0001", of.InvalidInput, "too_many_cells", "larger edge length"),
        ("needle_wedge_0001", of.InvalidInput, "too_many_cells", "larger edge length"),
        ("sizes_nan", of.InvalidInput, "bad_sizes", "correct it"),
        ("sizes_negative", of.InvalidInput, "bad_sizes", "not above 0"),
        ("moebius", of.GeometryError, "", ""),
    ],
)
def test_ends_with_an_error_and_no_file(name, error, kind, words, tmp_path):
    with pytest.raises(error) as raised:
        extremes.mesh_into(EXTREMES[name], tmp_path, tmp_path / "out")
    assert kind in raised.value.kind and raised.value.kind and words in str(raised.value)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("points, low, high", [("periodic", 0.77, 1.36), ("best", 0.6, 1.41)])
def test_edges_have_the_sizes_wanted_where_these_vary_by_ten(points, low, high):
    """With the mean size in place of that near, the 5th percentile would be 0.73, the 95th 1.41."""
    wanted = of.HexMeshOptions(points=points)
    result = of.compute_hex_dominant(box_of_tets(1, 1, 1, (4, 4, 4)), hex_options=wanted, sizes=by_height(0.04, 0.4))
    require_conforming(result.mesh)
    told = result.record
    assert told.edge_to_size.p05 > low and told.edge_to_size.p95 < high
    assert min(figures.min for figures in told.scaled_jacobian.values()) > 0.05


def test_sizes_that_edges_do_not_have_are_told(tmp_path):
    jumping = extremes.mesh_into(EXTREMES["sizes_jump"], tmp_path, tmp_path / "out").record
    assert jumping.edge_to_size.p95 > 3 and any("sizes that vary less" in note for note in jumping.notes)


def test_a_volume_far_from_the_inputs_is_told(tmp_path):
    coarse = extremes.mesh_into(EXTREMES["ball_coarse"], tmp_path, tmp_path / "out").record
    assert coarse.volume_error > 0.05 and any("give a smaller edge length" in note for note in coarse.notes)
