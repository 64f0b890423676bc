"""Nearest sh4 frames against the semidefinite relaxation of Palmer, Bommes and Solomon (2020), an independent proof of
optimality."""

import sys
from pathlib import Path

import numpy as np
import octafield as of
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "studies"))
from certified_projection import FAMILIES, Relaxation, make_inputs, values  # noqa: E402


@pytest.fixture(scope="module")
def relaxation():
    return Relaxation(of.frames.sh4_embed(of.frames.random_rotations(200, seed=1)))


@pytest.fixture(scope="module")
def inputs():
    return make_inputs(18, seed=5)


def test_embedded_frames_satisfy_fifteen_quadratic_equations(relaxation):
    assert relaxation.equations == 15


@pytest.mark.parametrize("family", ("random direction", *FAMILIES))
def test_fast_and_certified_values_reach_the_upper_bound_of_the_relaxation(relaxation, inputs, family):
    v = inputs[family]
    fast, _ = of.frames.sh4_project(v)
    certified, distances, gaps = of.frames.sh4_project_certified(v)
    assert np.all(gaps <= 1e-9)
    np.testing.assert_allclose(values(v, fast), values(v, certified), atol=1e-9)
    np.testing.assert_allclose(distances, np.linalg.norm(v - of.frames.sh4_embed(certified), axis=1), atol=1e-12)
    bounds = np.array([relaxation.solve(row)[0] for row in v])
    np.testing.assert_allclose(bounds, values(v, certified), atol=1e-7)


def test_relaxation_has_rank_one_where_one_frame_is_nearest(relaxation, inputs):
    assert max(relaxation.solve(row)[1] for row in inputs["random direction"]) < 1e-5


def test_certificate_reports_its_gap_and_checks_its_arguments():
    v = np.ones(9)
    frame, distance, gap = of.frames.sh4_project_certified(v)
    assert frame.shape == (4,)
    assert 0 <= gap <= 1e-9
    np.testing.assert_allclose(distance, np.linalg.norm(v - of.frames.sh4_embed(frame)), atol=1e-14)
    with pytest.raises(of.InvalidInput):
        of.frames.sh4_project_certified(v * np.nan)
