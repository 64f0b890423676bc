"""Schemes against a harmonic map that is known: which converge, and that it is harmonic at all."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "studies"))

import su2_harmonic as harmonic  # noqa: E402

STEP = 2e-3
STENCIL = np.array([-2, -1, 1, 2])


def differences(points, axis):
    """First and second derivative along an axis, of fourth order."""
    along = np.eye(3)[axis] * STEP
    a, b, c, d = (harmonic.exact_frames(points + k * along) for k in STENCIL)
    middle = harmonic.exact_frames(points)
    return (a - 8 * b + 8 * c - d) / (12 * STEP), (-a + 16 * b - 30 * middle + 16 * c - d) / (12 * STEP**2)


def test_the_map_is_harmonic_and_turns_in_all_directions():
    points = np.random.default_rng(0).uniform(0, 1, (200, 3))
    q = harmonic.exact_frames(points)
    first, second = zip(*(differences(points, axis) for axis in range(3)), strict=True)
    speed = sum(np.sum(d**2, axis=1) for d in first)
    assert np.abs(sum(second) + speed[:, None] * q).max() < 1e-7 * speed.max()
    assert np.abs(sum(second)).max() > 0.1 and np.linalg.svd(np.stack(first, 2), compute_uv=False).min() > 0.3


def errors_on_grids(scheme, cells):
    problems = [harmonic.problem_of("kuhn", n) for n in cells]
    return [harmonic.errors(problem, harmonic.solved(problem, scheme).frames)["L2"] for problem in problems]


@pytest.mark.parametrize("scheme", ["sh4", "geodesic", "su2_midpoint"])
def test_consistent_schemes_converge_to_it_to_second_order(scheme):
    assert 1.8 < harmonic.order(errors_on_grids(scheme, (4, 8)), (4, 8)) < 2.3


@pytest.mark.parametrize("scheme", ["su2_frozen", "su2"])
def test_other_schemes_stay_degrees_away(scheme):
    assert min(errors_on_grids(scheme, (4, 8))) > 1
