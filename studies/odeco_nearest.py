"""How often the nearest odeco tensor, lengths free, is the best of many random starts.

    python studies/odeco_nearest.py [-o DIR] [--count 2000] [--starts 1000] [--seed 1]

Inputs: odeco tensors with normally distributed lengths plus noise of 1 %, 10 % and 30 % of their norm, and random
    vectors of R^15. For each, octafield.frames.odeco_nearest is compared with the best of --starts local ascents
    (octafield.frames.odeco_nearest_local) from random frames; farther by more than 1e-9 of the input's norm counts as a
    miss.
"""

import argparse
from pathlib import Path

import numpy as np
import octafield
from study_output import markdown_table


def inputs(kind: str, count: int, random: np.random.Generator) -> np.ndarray:
    noise = random.normal(size=(count, 15))
    if kind == "random":
        return noise
    v = octafield.frames.odeco_embed(
        octafield.frames.random_rotations(count, int(random.integers(2**31))), random.normal(size=(count, 3))
    )
    level = float(kind.rstrip(" %")) / 100
    return v + level * np.linalg.norm(v, axis=1, keepdims=True) * noise / np.linalg.norm(noise, axis=1, keepdims=True)


def best_of_random_starts(v: np.ndarray, starts: int) -> np.ndarray:
    best = np.full(len(v), np.inf)
    for start in octafield.frames.random_rotations(starts, 7):
        best = np.minimum(best, octafield.frames.odeco_nearest_local(v, start)[2])
    return best


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--starts", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    random = np.random.default_rng(arguments.seed)
    rows = []
    for kind in ("1 %", "10 %", "30 %", "random"):
        v = inputs(kind, arguments.count, random)
        excess = (octafield.frames.odeco_nearest(v)[2] - best_of_random_starts(v, arguments.starts)) / np.linalg.norm(
            v, axis=1
        )
        rows.append([kind, str(len(v)), str(int((excess > 1e-9).sum())), f"{max(excess.max(), 0):.1e}"])
    table = markdown_table(["noise", "inputs", "missed", "worst by, of |v|"], rows)
    print(table)
    if arguments.output:
        arguments.output.mkdir(parents=True, exist_ok=True)
        (arguments.output / "odeco_nearest.md").write_text(table)


if __name__ == "__main__":
    main()
