"""Python ends while threads compute: a quiet exit with the status that was asked for, never an abort."""

import os
import signal
import subprocess
import sys
import time

import pytest

SETUP = """
import sys, threading, time
sys.path.insert(0, {tests!r})
import numpy as np
import octafield as of
from conftest import box_tets, icosphere
def forever(call):
    def work():
        while True:
            call()
    return work
def start(call):
    thread = threading.Thread(target=forever(call), daemon=True)
    thread.start()
    return thread
ball, box = icosphere(4), box_tets(12)
none = of.FeatureGraph()
n = len(box.vertices)
frames = of.frames.random_rotations(n, 1)
free = of.volume.BoundaryConstraints([0] * n, np.zeros((n, 3)), frames, [0] * n, [])
vectors = np.random.default_rng(1).normal(size=(20_000, 6))
some = vectors[:300]  # short enough to be computed in the calling thread
thread = start(lambda: {call})
print("ready", flush=True)
"""

CALLS = {
    "direction_field": "of.surface.direction_field(ball)",
    "direction_field_calls_back": "of.surface.direction_field(ball, progress=lambda *_: True)",
    "smooth": "of.volume.smooth(box, free, frames, tolerance=0, max_iterations=1000)",
    "smooth_calls_back": "of.volume.smooth(box, free, frames, tolerance=0, max_iterations=1000, progress=lambda *_: "
    "True)",
    "smooth_sleeps_in_its_callback": (
        "of.volume.smooth(box, free, frames, max_iterations=1000, progress=lambda *_: time.sleep(5))"
    ),
    "tetrahedralize": "of.volume.tetrahedralize(ball, edge_length=0.05)",
    "remesh": "of.surface.remesh(ball, none, edge_length=0.05)",
    "rows": "of.frames.su2_project(vectors)",
    "few_rows": "of.frames.su2_project(some)",
}
ENDS = ("", "sys.exit(7)", "raise SystemExit(7)")


def interrupt_until_it_ends(process):
    """Python itself may miss one, with or without octafield: the system gives it to a thread of Python's or of numpy's,
    and the main thread is not woken in its join."""
    for _ in range(60):
        os.killpg(process.pid, signal.SIGINT)
        try:
            process.wait(timeout=1)
        except subprocess.TimeoutExpired:
            continue
        return


def ended(call, end, delay, tests, interrupt=False):
    """(exit status, stderr) of a process that ends `delay` seconds after its thread began."""
    text = SETUP.format(tests=str(tests), call=CALLS[call]) + (
        "thread.join()\n" if interrupt else f"time.sleep({delay})\n{end}\n"
    )
    process = subprocess.Popen([sys.executable, "-c", text], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               start_new_session=True)  # fmt: skip
    try:
        assert process.stdout.readline() == "ready\n", process.communicate()[1]
        if interrupt:
            time.sleep(delay)
            interrupt_until_it_ends(process)
        _, errors = process.communicate(timeout=60)
    finally:
        process.kill()
    return process.returncode, errors


@pytest.mark.parametrize("call", CALLS)
def test_python_ends_quietly_while_a_thread_computes(call, request):
    for delay, end in zip((0.02, 0.2), ENDS, strict=False):
        status, errors = ended(call, end, delay, request.path.parent)
        assert (status, errors) == (7 if end else 0, "")


@pytest.mark.parametrize("call", ["direction_field", "smooth_calls_back", "remesh"])
def test_ctrl_c_while_a_thread_is_joined_ends_by_the_signal(call, request):
    status, errors = ended(call, "", 0.2, request.path.parent, interrupt=True)
    assert status == -signal.SIGINT
    assert errors.splitlines()[-1] == "KeyboardInterrupt" and "terminate" not in errors


def threads_without_interrupts(call, tests):
    """The most threads of a process that did not take SIGINT at one time, while a daemon thread of Python computed."""
    text = (
        SETUP.format(tests=str(tests), call=CALLS[call])
        + "import pathlib\ndef status(task):\n    try: return (task / 'status').read_text()\n    except"
        " (FileNotFoundError, ProcessLookupError): return ''  # a thread that has ended\ndef interrupts_blocked():\n "
        "   lines = [line for task in pathlib.Path('/proc/self/task').iterdir() for line in"
        " status(task).splitlines()]\n    return sum(int(line.split()[1], 16) >> 1 & 1 for line in lines if"
        " line.startswith('SigBlk'))\nmost = 0\nfor _ in range(200):\n    most = max(most, interrupts_blocked())\n   "
        " time.sleep(0.01)\nprint(most)\n"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, timeout=60)
    return int(done.stdout.splitlines()[-1])


def test_ctrl_c_goes_to_no_thread_that_computes(request):
    assert (
        threads_without_interrupts("smooth_calls_back", request.path.parent) >= 2
    )  # the one that waits and the one that computes
