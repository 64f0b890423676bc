"""Nearest sh4 frames per second beside mouette's `project_to_frame`, and how often it is farther.

    pip install mouette==1.2.8      # not a dependency of octafield
    python studies/benchmarks/projection_peers.py [--count 2000] [--seed 1]

Both get the same random directions in R^9 and the same frames with noise of 0.17, on one thread; seconds are CPU
seconds of this process. mouette starts from the nearest of five fixed frames and is written in Python; octafield is
called once per vector (as mouette must be) and once for all. "farther" counts mouette's frames that are farther from
the input than octafield's by more than 1e-6.
"""

import argparse
import time

import numpy as np
import octafield
from mouette.geometry.SphericalHarmonics import project_to_frame
from mouette.geometry.vector import Vec


def rate(function, count: int) -> float:
    start = time.process_time()
    function()
    return count / (time.process_time() - start)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    generator = np.random.default_rng(arguments.seed)
    directions = generator.normal(size=(arguments.count, 9))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    near = (
        octafield.frames.sh4_embed(octafield.frames.random_rotations(arguments.count, seed=arguments.seed))
        + 0.17 * directions
    )
    print(
        f"{'input':>18} {'mouette/s':>10} {'octafield/s, each':>18} {'octafield/s, batch':>19} {'ratio, batch':>13}"
        f" {'farther':>8}"
    )
    for name, v in (("random direction", directions), ("frame and noise", near)):
        theirs = []
        peer = rate(lambda v=v, theirs=theirs: theirs.extend(project_to_frame(Vec(row))[1] for row in v), len(v))
        each = rate(lambda v=v: [octafield.frames.sh4_project(row, threads=1) for row in v], len(v))
        large = np.tile(v, (max(1, 100000 // len(v)), 1))
        batch = rate(lambda large=large: octafield.frames.sh4_project(large, threads=1), len(large))
        distances = octafield.frames.sh4_project(v, threads=1)[1]
        # mouette's vectors are of the same harmonics in the same order: its result is a frame of ours.
        off = octafield.frames.sh4_project(np.array(theirs), threads=1)[1].max()
        if off > 1e-5:
            raise SystemExit(f"mouette's results are not frames in octafield's convention (off by {off:.1e})")
        farther = np.sum(np.linalg.norm(v - np.array(theirs), axis=1) > distances + 1e-6)
        print(f"{name:>18} {peer:10.0f} {each:18.0f} {batch:19.0f} {batch / peer:13.0f} {farther:8d}")


if __name__ == "__main__":
    main()
