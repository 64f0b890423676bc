"""Plots of a report. Colour tells representations apart, dashes and marks their variants (solvers), marks of dots
settings."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ... import _core
from ...progress.phases import PHASES
from ...view.plots import PALETTE, TEXT, new_figure, to_svg
from ..numbers.profiles import Profile, energies, geometric_mean, ratios_to_best, smoothing_seconds
from ..numbers.records import Case, Method, Results, Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

# TEXT is black or white with the page.
COLOURS = {
    name: TEXT if scheme.colour == "text" else scheme.colour for name, scheme in _core.schemes.items() if scheme.colour
}
_OF_OTHERS = ("#AA4499", "#44AA99", "#999933", "#6699CC")  # fields that were read
_DASHES, _MARKS = ("-", "--", ":", "-."), ("o", "s", "^", "D", "v", "P")
_WIDE, _HALF = 12.4, 6.4  # inches: the whole width of the page, half of it
_GREY = "#8a939d"
_LARGEST = 1e12  # ratio that is drawn where it is
_MOST_POINTS = 400  # of a curve


@dataclass(frozen=True)
class Style:
    """width: later methods are drawn narrower, so that curves that coincide are all seen."""

    colour: str
    dash: str
    mark: str
    width: float

    @property
    def line(self) -> dict[str, Any]:
        return {"color": self.colour, "linestyle": self.dash, "linewidth": self.width}


def styles(methods: Sequence[Method]) -> dict[Method, Style]:
    variants = list(dict.fromkeys(method.variant for method in methods))
    others = list(dict.fromkeys(method.representation for method in methods if method.representation not in COLOURS))
    colours = COLOURS | {name: _OF_OTHERS[k % len(_OF_OTHERS)] for k, name in enumerate(others)}
    found = {}
    for number, method in enumerate(methods):
        place = variants.index(method.variant)
        width = 3.6 - 2.2 * number / max(1, len(methods) - 1) if len(methods) > 1 else 1.8
        found[method] = Style(
            colours[method.representation], _DASHES[place % len(_DASHES)], _MARKS[place % len(_MARKS)], width
        )
    return found


def ratio_plot(results: Results, salt: str = "") -> str:
    """A dot per method and problem: energy over the lowest, processor seconds over the fastest; a bar: geometric
    mean."""
    figure, both = new_figure(_WIDE, 1.3 + 0.27 * len(results.methods), 2, sharey=True)
    marks = {setting: _MARKS[k % len(_MARKS)] for k, setting in enumerate(results.settings)}
    style, places = styles(results.methods), range(len(results.methods))
    parts = (
        (energies, "energy over the lowest of the problem"),
        (smoothing_seconds, "CPU seconds over the fastest of the problem"),
    )
    for axes, (quantity, label) in zip(both, parts, strict=True):
        means: dict[Method, list[float]] = {}
        largest = 1.0
        for number, setting in enumerate(results.settings):
            found = ratios_to_best(quantity(results, [p for p in results.problems if p.setting == setting]))
            shift = 0.22 * (2 * number / max(1, len(marks) - 1) - 1) if len(marks) > 1 else 0.0
            for place, (method, ratios) in enumerate(found.items()):
                ratios = np.minimum(ratios[np.isfinite(ratios)], _LARGEST)
                means.setdefault(method, []).extend(ratios)
                largest = max(largest, ratios.max(initial=1))
                at, colour = np.full(len(ratios), place + shift), style[method].colour
                axes.plot(ratios, at, marks[setting], color=colour, markersize=5.5, alpha=0.75, markeredgewidth=0)
        for place, method in enumerate(results.methods):
            mean = geometric_mean(np.array(means.get(method, [])))
            if mean is not None:
                axes.plot([mean, mean], [place - 0.36, place + 0.36], color=TEXT, linewidth=1.6)
        _ratio_axis(axes, largest)
        axes.set_xlabel(label)
        axes.grid(axis="x", alpha=0.25, linewidth=0.6)
    both[0].set_yticks(list(places), [method.name for method in results.methods])
    both[0].set_ylim(len(results.methods) - 0.5, -0.5)
    if len(results.settings) > 1:
        _legend(
            figure,
            [_handle(marker=mark, color=TEXT, linestyle="none", label=setting.name) for setting, mark in marks.items()],
        )
    return to_svg(figure, "energies and seconds relative to the best method of each problem", salt)


def profile_plot(parts: Sequence[tuple[Mapping[Method, Profile], str]], salt: str = "") -> str:
    """One panel per (profiles, label of their ratios), the same methods in each."""
    methods = list(parts[0][0])
    style = styles(methods)
    figure, panels = new_figure(_WIDE, 3.6 + 0.24 * (1 + len(methods) // 8), len(parts), sharey=True)
    for axes, (profiles, label) in zip(panels, parts, strict=True):
        largest = max((p.ratio[-1] for p in profiles.values()), default=1.0)
        right = 1 + (min(max(largest, 1.01), _LARGEST) - 1) * 1.05
        for method, profile in profiles.items():
            axes.step(
                np.r_[np.minimum(profile.ratio, right), right],
                np.r_[profile.share, profile.share[-1]],
                where="post",
                **style[method].line,
            )
        _ratio_axis(axes, right)
        axes.set_ylim(0, 1.03)
        axes.set_xlabel(label)
        axes.grid(alpha=0.25, linewidth=0.6)
    panels[0].set_ylabel("share of problems")
    _method_legend(figure, methods)
    return to_svg(figure, "performance profiles", salt)


def deviation_plot(angles: Mapping[Method, np.ndarray], first: Method, salt: str = "") -> str:
    """One box per method: median, quartiles, 5th and 95th per cent of degrees."""
    figure, (axes,) = new_figure(_HALF, 0.9 + 0.3 * len(angles))
    style = styles(list(angles))
    for place, (method, values) in enumerate(angles.items()):
        low, left, middle, right, high = np.percentile(values, [5, 25, 50, 75, 95])
        colour = style[method].colour
        axes.plot([low, high], [place, place], color=colour, linewidth=1.4)
        axes.barh(place, right - left, left=left, height=0.5, color=colour, alpha=0.55, linewidth=0)
        axes.plot([middle, middle], [place - 0.32, place + 0.32], color=TEXT, linewidth=1.8)
    axes.set_yticks(range(len(angles)), [method.name for method in angles])
    axes.set_ylim(len(angles) - 0.5, -0.5)
    axes.set_xlim(left=0)
    if axes.get_xlim()[1] < 0.01:  # they coincide: no axis full of rounding
        axes.set_xlim(0, 0.01)
    axes.set_xlabel(f"angle to the frames of {first.name}, degrees")
    axes.grid(axis="x", alpha=0.25, linewidth=0.6)
    return to_svg(figure, "angles between fields", salt)


def is_wide(results: Results, cases: Sequence[Case]) -> bool:
    """Whether the plot of convergence takes the whole width."""
    return len(cases) > 1 or len(results.methods) > 8


@dataclass(frozen=True)
class Convergence:
    """Of one run. energy: E at the start and after each step. own: what was minimised over its first value, from
    iteration `begin` on."""

    energy: list[float]
    own: list[float]
    begin: int


def convergence(results: Results, case: Case) -> dict[Method, Convergence]:
    """What the plot shows."""
    found = {}
    for method in results.methods:
        run = results.field(method, case)
        if run is None or not run.computed:
            continue
        energy, own = run.record.energy_history or [], run.record.objective_history or []
        scaled = [value / own[0] for value in own] if own and own[0] > 0 else []
        found[method] = Convergence(energy, scaled, max(0, len(energy) - len(scaled)))
    return found


def convergence_plot(results: Results, cases: Sequence[Case], salt: str = "") -> str:
    """Energy against iteration, below it the methods' own objectives; a column per case on common axes."""
    every = [convergence(results, case) for case in cases]
    methods = [m for m in results.methods if any(m in curves for curves in every)]
    style = styles(methods)
    height = 5.6 + 0.24 * (1 + len(methods) // 8)
    figure, panels = new_figure(
        _WIDE if is_wide(results, cases) else _HALF, height, len(cases), rows=2, sharex=True, sharey="row"
    )
    above, below = panels[: len(cases)], panels[len(cases) :]
    longest = 1
    shared: dict[str, Any] = {}
    for upper, lower, case, curves in zip(above, below, cases, every, strict=True):
        begin = _common([curve.energy for curve in curves.values()])
        if begin > 1:
            shared |= {"color": _GREY, "linewidth": 2.4}
            _curve(upper, next(iter(curves.values())).energy[:begin], 0, **shared)
        for method, curve in curves.items():
            longest = max(longest, len(curve.energy))
            mark = {"marker": style[method].mark, "markevery": [-1], "markersize": 5 + style[method].width / 2}
            _curve(upper, curve.energy[max(0, begin - 1) :], max(0, begin - 1), **style[method].line, **mark)
            if curve.own:
                _curve(lower, curve.own, curve.begin, **style[method].line, **mark)
        lower.set_xlabel("iteration")
        for axes in (upper, lower):
            axes.grid(alpha=0.25, linewidth=0.6)
        if len(cases) > 1:
            upper.set_title(case.setting.name, fontsize=10)
    if longest > 300:
        panels[0].set_xscale("symlog", linthresh=10)
    else:
        panels[0].locator_params(axis="x", integer=True)
    above[0].set_ylabel("energy E")
    below[0].set_ylabel("own objective / its start")
    _method_legend(figure, methods, [_handle(**shared, label="common to all")] if shared else [])
    return to_svg(figure, "energy, and own objectives over their start, against iteration", salt)


def _common(histories: list[list[float]]) -> int:
    """How many steps all have in common from the start on: sh4, which others start from. 0 for a single one."""
    steps = list(zip(*histories, strict=False)) if len(histories) > 1 else []
    return next((k for k, values in enumerate(steps) if len(set(values)) > 1), len(steps))


def _curve(axes: "Axes", history: list[float], first: int, **options: Any) -> None:
    places = np.unique(np.linspace(0, len(history) - 1, min(len(history), _MOST_POINTS)).astype(int))
    axes.plot(first + places, np.array(history)[places], **options)


def seconds_plot(labels: Sequence[str], runs: Sequence[Run], salt: str = "") -> str:
    """Seconds by the clock per phase, one stacked bar per run."""
    figure, (axes,) = new_figure(_HALF, 1.0 + 0.24 * len(runs))
    left, places = np.zeros(len(runs)), range(len(runs))
    phases = [*PHASES, *(["sizes"] if any("sizes" in run.record.wall_seconds for run in runs) else [])]
    for number, phase in enumerate(phases):
        seconds = np.array([run.record.wall_seconds.get(phase, 0.0) for run in runs])
        axes.barh(places, seconds, left=left, height=0.66, color=PALETTE[number], label=phase, edgecolor="none")
        left += seconds
    axes.set_yticks(list(places), labels, fontsize=9)
    axes.set_ylim(len(runs) - 0.4, -0.6)
    axes.set_xlabel("seconds by the clock")
    axes.grid(axis="x", alpha=0.25, linewidth=0.6)
    _legend(
        figure,
        [_handle(color=colour, linewidth=7, label=phase) for phase, colour in zip(phases, PALETTE, strict=False)],
    )
    return to_svg(figure, "seconds per phase", salt)


def _ratio_axis(axes: "Axes", largest: float) -> None:
    """From 1; logarithmic where ratios are large, and never an axis full of rounding."""
    from matplotlib.ticker import ScalarFormatter

    largest = min(max(largest, 1.001), _LARGEST)
    if largest > 4:
        axes.set_xscale("log")
        axes.xaxis.set_major_formatter("{x:g}")
        axes.xaxis.set_minor_formatter("{x:g}" if largest < 10 else "")
        axes.set_xlim(0.96, largest * 1.08)
    else:
        axes.xaxis.set_major_formatter(ScalarFormatter(useOffset=False))
        axes.set_xlim(1 - 0.02 * (largest - 1), 1 + 1.05 * (largest - 1))


def _method_legend(figure: "Figure", methods: Sequence[Method], more: "Sequence[Line2D]" = ()) -> None:
    """A line per method where they are few; else colours of representations, then dashes of variants."""
    style = styles(methods)
    variants = list(dict.fromkeys(method.variant for method in methods))
    if len(variants) < 2 or len(methods) < 8:
        _legend(
            figure,
            [_handle(**{**style[m].line, "linewidth": 2}, marker=style[m].mark, label=m.name) for m in methods]
            + list(more),
        )
        return
    first = {method.representation: style[method].colour for method in methods}
    handles = [_handle(color=colour, linewidth=5, label=name) for name, colour in first.items()]
    for variant in variants:
        of = next(style[m] for m in methods if m.variant == variant)
        handles.append(_handle(color=TEXT, linestyle=of.dash, marker=of.mark, label=variant or "default"))
    _legend(figure, [*handles, *more])


def _handle(**options: Any) -> "Line2D":
    import matplotlib.lines

    return matplotlib.lines.Line2D([], [], **options)


def _legend(figure: "Figure", handles: "list[Line2D]") -> None:
    widest = max(len(str(handle.get_label())) for handle in handles)
    columns = max(1, min(len(handles), int(figure.get_figwidth() / (0.6 + 0.085 * widest))))
    figure.legend(handles=handles, frameon=False, labelcolor=TEXT, loc="outside lower center", ncols=columns)
