"""Python ends at random moments while daemon threads compute: the status asked for, at once, and never an abort.

    .venv/bin/python studies/random_endings.py --seconds 60 --seed 1

Each process calls one to three of the long functions of the library over and over in daemon threads, half of them with
a Python callback, and ends after a random delay: by its last line, sys.exit, an exception that nobody catches, or
Ctrl-C while the main thread waits in a join or sleeps. A fault is another status than that, more than 30 seconds, or
words of an abort among the messages; it is printed with the functions, the ending and the delay. Ends with 1 where
there was one. Where Ctrl-C has ended nothing after three seconds, it is sent again, as a user would: the system may
give it to a thread of Python's own that is not the main one.
"""

import argparse
import collections
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
WORDS = ("terminate", "Fatal Python", "Aborted", "Segmentation", "core dumped", "FATAL", "Error")
LIMIT, AGAIN = 30, 3  # seconds

SETUP = """
import sys, threading, time
sys.path[:0] = {path!r}
import numpy as np
import octafield as of
from conftest import box_tets, icosphere
ball, box, none = icosphere(3), box_tets(8), of.FeatureGraph()
n = len(box.vertices)
frames, of_tets = of.frames.random_rotations(n, 1), of.frames.random_rotations(len(box.tets), 2)
free = of.volume.BoundaryConstraints([0] * n, np.zeros((n, 3)), frames, [0] * n, [])
smooth = of.frames.quaternion_exp(0.3 * np.asarray(box.vertices))
cross = of.surface.direction_field(ball)
points = of.surface.surface_singularities(cross)
vectors = np.random.default_rng(1).normal(size=(20_000, 9))
answer = dict(progress=lambda *_: True)
def forever(call):
    while True:
        call()
threads = [threading.Thread(target=forever, args=[call], daemon=True) for call in [{calls}]]
for thread in threads:
    thread.start()
print("ready", flush=True)
{end}
"""

# CALL may be given a callback: {} or {**answer}.
CALLS = {
    "direction_field": "lambda: of.surface.direction_field(ball, {})",
    "mbo": "lambda: of.surface.direction_field(ball, method='mbo', {})",
    "remesh": "lambda: of.surface.remesh(ball, none, edge_length=0.08, {})",
    "tetrahedralize": "lambda: of.volume.tetrahedralize(ball, edge_length=0.15, {})",
    "separatrices": "lambda: of.surface.separatrices(cross, points, {})",
    "even_streamlines": "lambda: of.surface.even_streamlines(cross, points, spacing=0.1, {})",
    "smooth": "lambda: of.volume.smooth(box, free, frames, tolerance=0, max_iterations=1000, {})",
    "smooth_lbfgs": "lambda: of.volume.smooth(box, free, frames, solver='lbfgs', tolerance=0, max_iterations=1000, {})",
    "smooth_metric": "lambda: of.volume.smooth(box, free, smooth, representation='geodesic', tolerance=0, {})",
    "diffuse": "lambda: of.volume.diffuse(box, free, frames, {})",
    "frame_field": "lambda: of.volume.frame_field(box, free, {})",
}
PLAIN = {
    "sh4_project": "lambda: of.frames.sh4_project(vectors)",
    "sh4_project_few": "lambda: of.frames.sh4_project(vectors[:300])",
    "sh4_project_certified": "lambda: of.frames.sh4_project_certified(vectors[:200])",
    "singular_graph": "lambda: of.volume.singular_graph(box, frames)",
    "singular_edges": "lambda: of.volume.singular_edges(box, of_tets)",
    "vertex_frames": "lambda: of.volume.vertex_frames(box, of_tets)",
    "integrability": "lambda: of.volume.integrability(box, smooth)",
    "axis_scales": "lambda: of.volume.axis_scales(box, smooth)",
    "comb": "lambda: of.volume.comb(box, of_tets)",
    "frame_streamlines": "lambda: of.volume.frame_streamlines(box, smooth, of.volume.spread_points(box, 50))",
    "find_defects": "lambda: of.surface.find_defects(ball)",
}
# Last lines of the program, its status, and whether Ctrl-C is sent.
ENDS = {
    "return": ("time.sleep({delay})", 0, False),
    "sys.exit": ("time.sleep({delay}); sys.exit(7)", 7, False),
    "exception": ("time.sleep({delay}); raise ValueError('on purpose')", 1, False),
    "ctrl-c": ("threads[0].join()", -signal.SIGINT, True),
    "ctrl-c asleep": ("time.sleep(1000)", -signal.SIGINT, True),
}


def drawn(choose: random.Random) -> tuple[list[str], list[str], str, float]:
    """Names of functions, their calls, the ending and the delay."""
    names, calls = [], []
    for _ in range(choose.choice((1, 1, 2, 3))):
        name = choose.choice([*CALLS, *PLAIN])
        answers = name in CALLS and choose.random() < 0.5
        names.append(name + " (calls back)" * answers)
        calls.append(CALLS[name].replace("{}", "**answer" if answers else "") if name in CALLS else PLAIN[name])
    return names, calls, choose.choice(list(ENDS)), choose.choice((0.0, 0.01, 0.1, 0.5)) * choose.random()


def fault_of(calls: list[str], ending: str, delay: float) -> tuple[str, bool]:
    """What went wrong, empty where nothing did; and whether Ctrl-C was sent again."""
    end, status, interrupts = ENDS[ending]
    text = SETUP.format(path=[str(ROOT / "tests" / "python")], calls=", ".join(calls), end=end.format(delay=delay))
    process = subprocess.Popen(
        [sys.executable, "-c", text], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    twice = False
    try:
        if process.stdout.readline() != "ready\n":
            return f"did not begin: {process.communicate()[1][-2000:]}", False
        if interrupts:
            time.sleep(delay)
            os.killpg(process.pid, signal.SIGINT)
            for _ in range(LIMIT // AGAIN):
                try:
                    process.wait(AGAIN)
                    break
                except subprocess.TimeoutExpired:
                    twice = True
                    os.killpg(process.pid, signal.SIGINT)
        _, errors = process.communicate(timeout=LIMIT)
    except subprocess.TimeoutExpired:
        return f"still there after {LIMIT} seconds", twice
    finally:
        if process.poll() is None:
            process.kill()
            process.communicate()
    if process.returncode != status:
        return f"status {process.returncode}, not {status}: {errors[-500:]}", twice
    errors = errors.replace("ValueError: on purpose", "")
    return next((f"messages with {word!r}: {errors[-500:]}" for word in WORDS if word in errors), ""), twice


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    choose, stop = random.Random(options.seed), time.monotonic() + options.seconds
    ended, functions, faults = collections.Counter[str](), collections.Counter[str](), 0
    repeated = 0
    while time.monotonic() < stop:
        names, calls, ending, delay = drawn(choose)
        fault, twice = fault_of(calls, ending, delay)
        repeated += twice
        ended[ending] += 1
        functions.update(name.split()[0] for name in names)
        faults += bool(fault)
        if fault or twice:
            print(
                f"{' + '.join(names)}; {ending} after {delay:.4f} s: {fault or 'ended by a later Ctrl-C'}", flush=True
            )
    print(
        f"{ended.total()} endings, {faults} faults, {repeated} times Ctrl-C was sent again; "
        + ", ".join(f"{name} {count}" for name, count in sorted(ended.items()))
    )
    print("functions: " + ", ".join(f"{name} {functions[name]}" for name in [*CALLS, *PLAIN]))
    return int(faults > 0)


if __name__ == "__main__":
    sys.exit(main())
