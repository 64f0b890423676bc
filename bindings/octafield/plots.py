"""Plots of a report as inline SVG. Text and axes take the page's colour, so they read on light and dark ground."""

import io
import re

from .phases import PHASES

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#7b8794")
DASHES = ("-", "--", "-.", ":")
TEXT = "#010203"  # stands for the page's text colour until the SVG is made


def convergence_plot(rows: list[dict]) -> str:
    """Energy against iteration, all runs on common axes."""
    columns = 3
    figure, axes = new_figure(6.4, 3.6 + 0.22 * -(-len(rows) // columns))
    for number, row in enumerate(rows):
        energies = row["energy_history"]
        axes.plot(
            range(len(energies)),
            energies,
            DASHES[number // len(PALETTE) % len(DASHES)],
            color=PALETTE[number % len(PALETTE)],
            linewidth=1.8,
            marker="o",
            markersize=3,
            label=row["label"],
        )
    axes.set_xlabel("iteration")
    axes.set_ylabel("energy E")
    figure.legend(frameon=False, labelcolor=TEXT, loc="outside lower center", ncols=columns)
    axes.grid(alpha=0.25, linewidth=0.6)
    axes.xaxis.get_major_locator().set_params(integer=True)
    return to_svg(figure, "energy against iteration")


def seconds_plot(rows: list[dict]) -> str:
    """Wall seconds per phase, one stacked bar per run."""
    figure, axes = new_figure(6.4, 0.8 + 0.38 * len(rows))
    left = [0.0] * len(rows)
    places = range(len(rows))
    for number, phase in enumerate(PHASES):
        seconds = [row["wall_seconds"][phase] for row in rows]
        axes.barh(places, seconds, left=left, height=0.62, color=PALETTE[number], label=phase, edgecolor="none")
        left = [a + b for a, b in zip(left, seconds)]
    axes.set_yticks(list(places), [row["label"] for row in rows])
    axes.invert_yaxis()
    axes.set_xlabel("wall seconds")
    axes.legend(
        frameon=False,
        ncols=len(PHASES),
        loc="lower center",
        bbox_to_anchor=(0.5, 1.0),
        labelcolor=TEXT,
        columnspacing=1.2,
        handlelength=1.0,
    )
    axes.grid(axis="x", alpha=0.25, linewidth=0.6)
    return to_svg(figure, "wall seconds per phase")


def new_figure(width: float, height: float):
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    axes = figure.add_subplot()
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_color(TEXT)
    axes.tick_params(colors=TEXT)
    axes.xaxis.label.set_color(TEXT)
    axes.yaxis.label.set_color(TEXT)
    axes.patch.set_visible(False)
    return figure, axes


def to_svg(figure, label: str) -> str:
    """An <svg> element for HTML: no prolog, no namespaces (HTML has them built in), no metadata."""
    import matplotlib

    text = io.StringIO()
    with matplotlib.rc_context(
        {"svg.fonttype": "none", "svg.hashsalt": label, "font.family": "DejaVu Sans", "font.size": 10}
    ):
        figure.savefig(text, format="svg", transparent=True, metadata={"Date": None})
    svg = text.getvalue()
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = re.sub(r' xmlns(:\w+)?="[^"]*"', "", svg)
    svg = re.sub(r"<!--.*?-->", "", svg, flags=re.DOTALL)
    svg = re.sub(r'(<svg) height="[^"]*"', r"\1", svg)
    svg = re.sub(r'(<svg[^>]*) width="[^"]*"', rf'\1 role="img" aria-label="{label}"', svg, count=1)
    svg = re.sub(r"font-family: [^;\"]*|font: ([\d.]+px) [^;\"]*", _page_font, svg)
    return svg.replace(TEXT, "currentColor")


def _page_font(match: re.Match) -> str:
    return f"font-size: {match[1]}" if match[1] else "font-family: inherit"
