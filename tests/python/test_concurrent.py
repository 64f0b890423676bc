"""Factorizations in several threads at once give what they give alone."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import octafield as of
import pytest
from conftest import box_tets, icosphere

BALL, BOX, NONE = icosphere(3), box_tets(8), of.FeatureGraph()
N = len(BOX.vertices)
FRAMES = of.frames.random_rotations(N, 1)
FREE = of.volume.BoundaryConstraints([0] * N, np.zeros((N, 3)), FRAMES, [0] * N, [])


def metric_field():
    return of.volume.smooth(
        BOX, FREE, FRAMES, representation="su2_midpoint", solver="levenberg_marquardt", max_iterations=20
    ).frames


CALLS = {
    "gl": lambda: of.surface.direction_field(BALL).values,
    "mbo": lambda: of.surface.direction_field(BALL, method="mbo").values,
    "ceres": metric_field,
}


@pytest.mark.parametrize("other", CALLS)
@pytest.mark.parametrize("one", CALLS)
def test_two_threads_give_the_bits_of_each_alone(one, other):
    alone = {name: np.asarray(CALLS[name]()).tobytes() for name in (one, other)}
    with ThreadPoolExecutor(2) as pool:
        jobs = [(name, pool.submit(CALLS[name])) for name in (one, other) * 4]
        assert [name for name, job in jobs if np.asarray(job.result()).tobytes() != alone[name]] == []
