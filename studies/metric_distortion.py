"""How much each distance of frames distorts the angle between them, and where.

    python studies/metric_distortion.py -o DIR [--pairs 20000] [--seed 1] [--threads 0]

For every entry of octafield.frames.metrics and a list of angles: pairs of frames exactly that far apart (a random
frame, a random direction of rotation among those in which the angle is the shortest way), and over the pairs minimum,
maximum and the 1 %, 50 % and 99 % quantiles of distance / (angle x speed). 1 is no distortion. A metric whose speed
depends on frame and direction is divided by its median at the smallest angle instead. DIR gets distortion.csv,
distortion.md and frames_distortion.png.
"""

import argparse
from itertools import permutations, product
from pathlib import Path

import numpy as np
import octafield
from octafield.view.plots import PALETTE
from study_output import markdown_table, new_figure, save_figure, with_grid, write_csv

IDENTITY = np.array([1.0, 0, 0, 0])
# The frames farthest from the identity: Rodrigues vectors at the corners of the truncated cube that is SO(3)/O.
FARTHEST = np.array(
    [
        np.multiply(signs, corner)
        for corner in sorted(set(permutations((np.sqrt(2) - 1, np.sqrt(2) - 1, 3 - 2 * np.sqrt(2)))))
        for signs in product((1, -1), repeat=3)
    ]
)
LARGEST = np.degrees(2 * np.arctan(np.linalg.norm(FARTHEST[0])))  # 62.7994 degrees
ANGLES = (0.5, 1, 2, 3, 5, 7.5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60, 62, LARGEST)
SHOWN = (0.5, 2, 5, 10, 20, 30, 45, 60, LARGEST)
QUANTILES = (0, 0.01, 0.5, 0.99, 1)
NAMES = ("min", "q01", "q50", "q99", "max")


def unit_rows(rows: np.ndarray) -> np.ndarray:
    return rows / np.linalg.norm(rows, axis=1, keepdims=True)


def directions_at(angle: float, count: int, rng: np.random.Generator) -> np.ndarray:
    """(count, 3) random directions, uniform among those in which a turn by `angle` leads to a frame that far from the
    identity."""
    if angle == np.radians(LARGEST):
        return unit_rows(FARTHEST)[rng.integers(len(FARTHEST), size=count)]
    kept, missing = [], count
    while missing > 0:
        candidates = unit_rows(rng.normal(size=(100_000, 3)))
        reached = octafield.frames.distance(IDENTITY, octafield.frames.quaternion_exp(angle * candidates))
        kept.append(candidates[abs(reached - angle) < 1e-9][:missing])
        missing -= len(kept[-1])
    return np.concatenate(kept)


def frame_pairs(angle: float, count: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    first = octafield.frames.random_rotations(count, seed=int(rng.integers(2**31)))
    in_frame = directions_at(
        angle, count, rng
    )  # how far a turn leads depends on its direction against the frame's axes
    in_world = np.einsum("nij,nj->ni", octafield.frames.rotation_matrices(first), in_frame)
    return first, octafield.frames.frame_exp(first, angle * in_world)


def measure(pairs: int, seed: int, threads: int) -> tuple[dict[str, np.ndarray], dict[str, float]]:
    """Per metric (angles, quantiles) of distance / (angle x speed), and the speeds used."""
    rng = np.random.default_rng(seed)
    ratios = {name: [] for name in octafield.frames.metrics}
    for angle in np.radians(ANGLES):
        first, second = frame_pairs(angle, pairs, rng)
        for name, metric in octafield.frames.metrics.items():
            ratios[name].append(np.quantile(metric.distance(first, second, threads=threads) / angle, QUANTILES))
    speeds = {name: metric.speed or ratios[name][0][2] for name, metric in octafield.frames.metrics.items()}
    return {name: np.array(rows) / speeds[name] for name, rows in ratios.items()}, speeds


def draw(table: dict[str, np.ndarray], path: Path) -> None:
    columns = 5
    rows = -(-len(table) // columns)
    figure, grid = new_figure(12, 2.9 * rows, rows, columns, sharex=True, sharey=True, squeeze=False)
    for axes in grid.flat[len(table) :]:
        axes.set_visible(False)
    for axes, (name, values) in zip(grid.flat, table.items()):
        low, q01, q50, q99, high = values.T
        axes.axhline(1, color="black", linewidth=0.8, linestyle=":")
        axes.fill_between(ANGLES, low, high, color=PALETTE[5], alpha=0.3, linewidth=0, label="all pairs")
        axes.fill_between(ANGLES, q01, q99, color=PALETTE[0], alpha=0.45, linewidth=0, label="1 % to 99 %")
        axes.plot(ANGLES, q50, color=PALETTE[1], linewidth=1.8, label="median")
        axes.set(xscale="log", ylim=(0, 3.4), title=name)
        axes.set_xticks((0.5, 2, 5, 10, 20, 60), ("0.5", "2", "5", "10", "20", "60"))
        axes.minorticks_off()
        with_grid(axes)
    grid[0, 0].legend(frameon=False, loc="upper left")
    figure.supxlabel("angle between the frames (degrees)", fontsize=10)
    figure.supylabel("distance / (angle x speed)", fontsize=10)
    save_figure(figure, path)


def as_markdown(table: dict[str, np.ndarray], speeds: dict[str, float]) -> str:
    picked = [ANGLES.index(angle) for angle in SHOWN]
    rows = [
        [name, f"{speeds[name]:.4g}", *(" / ".join(f"{x:.3f}" for x in values[k, 1:4]) for k in picked)]
        for name, values in table.items()
    ]
    quantiles = markdown_table(["metric", "speed", *(f"{angle:.4g}°" for angle in SHOWN)], rows)
    extremes = markdown_table(
        ["metric", "smallest", "at", "largest", "at", "largest / smallest"],
        [
            [
                name,
                f"{v[:, 0].min():.4f}",
                f"{ANGLES[v[:, 0].argmin()]:.4g}°",
                f"{v[:, 4].max():.4f}",
                f"{ANGLES[v[:, 4].argmax()]:.4g}°",
                f"{v[:, 4].max() / v[:, 0].min():.4f}",
            ]
            for name, v in table.items()
        ],
    )
    return (
        f"distance / (angle x speed): 1 % / 50 % / 99 % quantiles\n\n{quantiles}\nOver all pairs and"
        f" angles\n\n{extremes}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--pairs", type=int, default=20_000, help="pairs of frames per angle")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=0, help="0: all cores; the results are the same")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)

    table, speeds = measure(arguments.pairs, arguments.seed, arguments.threads)
    write_csv(
        arguments.output / "distortion.csv",
        ["metric", "speed", "angle_deg", *NAMES],
        (
            [name, float(speeds[name]), float(angle), *map(float, row)]
            for name, values in table.items()
            for angle, row in zip(ANGLES, values)
        ),
    )
    draw(table, arguments.output / "frames_distortion.png")
    text = as_markdown(table, speeds)
    (arguments.output / "distortion.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
