"""Plots of a study's report, in the style of plots.py."""

from collections.abc import Mapping

import numpy as np

from ..plots import DASHES, PALETTE, TEXT, convergence_plot, new_figure, to_svg
from .profiles import Profile

__all__ = ["convergence_plot", "deviation_plot", "profile_plot"]


def profile_plot(profiles: Mapping[str, Profile], label: str) -> str:
    figure, axes = new_figure(6.4, 3.6 + 0.22 * -(-len(profiles) // 3))
    largest = max((p.ratio[-1] for p in profiles.values()), default=1.0)
    right = max(1.05 * largest, 1.01)
    for number, (name, profile) in enumerate(profiles.items()):
        axes.step(
            np.r_[profile.ratio, right], np.r_[profile.share, profile.share[-1]], DASHES[number // len(PALETTE) % len(DASHES)],
            where="post", color=PALETTE[number % len(PALETTE)], linewidth=1.8, label=name,
        )  # fmt: skip
    if right > 4:
        axes.set_xscale("log")
    axes.set_xlim(1, right)
    axes.set_ylim(0, 1.03)
    axes.set_xlabel(label)
    axes.set_ylabel("share of problems")
    axes.grid(alpha=0.25, linewidth=0.6)
    figure.legend(frameon=False, labelcolor=TEXT, loc="outside lower center", ncols=3)
    return to_svg(figure, label)


def deviation_plot(angles: Mapping[str, np.ndarray]) -> str:
    """One box per method: median, quartiles, 5th and 95th per cent of degrees."""
    figure, axes = new_figure(6.4, 0.9 + 0.42 * len(angles))
    boxes = [
        dict(zip(("whislo", "q1", "med", "q3", "whishi"), np.percentile(values, [5, 25, 50, 75, 95]), strict=True), label=name)
        for name, values in angles.items()
    ]
    line = {"color": PALETTE[0], "linewidth": 1.4}
    axes.bxp(boxes, orientation="horizontal", showfliers=False, boxprops=line, whiskerprops=line, capprops=line, medianprops={"color": PALETTE[1], "linewidth": 2})
    axes.invert_yaxis()
    axes.set_xlabel("degrees")
    axes.grid(axis="x", alpha=0.25, linewidth=0.6)
    return to_svg(figure, "deviation between fields")
