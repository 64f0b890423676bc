"""Ctrl-C during long calls, each in a process of its own."""

import os
import signal
import subprocess
import sys
import time

import pytest
from conftest import cpu_seconds

PROGRAM = """
import sys, time
sys.path.insert(0, {tests!r})
import numpy as np
import octafield as of
{setup}
print("ready", flush=True)
try:
    {call}
    print("finished", flush=True)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""

RANDOM_BOX = """
from conftest import box_tets
box = box_tets(30)
n = len(box.vertices)
frames = of.frames.random_rotations(n, 1)
free = of.volume.BoundaryConstraints([0] * n, np.zeros((n, 3)), frames, [0] * n, [])
"""

# Each takes far more than a second when left alone: projection sees the flag, smoothing its progress callback, TetGen
# runs in a process of its own, generation of random numbers sees nothing at all, so that its worker is abandoned.
CASES = {
    "flag": ("vectors = np.random.default_rng(1).normal(size=(300_000, 6))", "of.frames.su2_project(vectors)"),
    "progress": (RANDOM_BOX, "of.volume.smooth(box, free, frames, tolerance=0, max_iterations=100000)"),
    "python_progress": (
        RANDOM_BOX,
        "of.volume.smooth(box, free, frames, tolerance=0, max_iterations=100000, progress=lambda *_: True)",
    ),
    "other_process": (
        "from conftest import icosphere\nball = icosphere(3)",
        "of.volume.tetrahedralize(ball, edge_length=0.015)",
    ),
    "abandoned": ("", "of.frames.random_rotations(150_000_000)"),
}


def start(case, tmp_path, tests):
    setup, call = CASES[case]
    program = tmp_path / "program.py"
    program.write_text(PROGRAM.format(setup=setup, call=call, tests=str(tests)))
    process = subprocess.Popen(
        [sys.executable, program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    assert process.stdout.readline() == "ready\n", process.communicate()[1]
    return process


@pytest.mark.parametrize("case", CASES)
def test_ctrl_c_ends_a_long_call_within_a_second_of_work(case, tmp_path, request):
    process = start(case, tmp_path, request.path.parent)
    time.sleep(1.0)
    before = cpu_seconds(process.pid)
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does: to the whole group
    out = process.stdout.readline()
    seconds = cpu_seconds(process.pid) - before
    _, errors = process.communicate(timeout=120)
    assert out == "interrupted\n" and errors == ""
    assert seconds < os.cpu_count()  # of CPU time, on all cores: does not depend on what else runs
    assert process.returncode == 0  # an abandoned worker does not disturb the exit


def test_the_exit_status_survives_an_abandoned_worker(tmp_path, request):
    setup, call = CASES["abandoned"]
    program = tmp_path / "program.py"
    program.write_text(PROGRAM.format(setup=setup, call=call, tests=str(request.path.parent)) + "\nsys.exit(7)\n")
    process = subprocess.Popen([sys.executable, program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "ready\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    out, errors = process.communicate(timeout=120)
    assert (out, errors, process.returncode) == ("interrupted\n", "", 7)
