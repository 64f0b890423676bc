"""Plots as inline SVG. Text and axes take the page's colour, so they read on light and dark ground."""

import io
import re
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#7b8794")
TEXT = "#010203"  # stands for the page's text colour until the SVG is made


def new_figure(
    width: float,
    height: float,
    columns: int = 1,
    *,
    rows: int = 1,
    sharex: bool = False,
    sharey: bool | Literal["row"] = False,
) -> "tuple[Figure, list[Axes]]":
    """A figure in inches and its axes, row by row."""
    import matplotlib.figure

    figure = matplotlib.figure.Figure(figsize=(width, height), layout="constrained")
    every: list[Axes] = list(figure.subplots(rows, columns, squeeze=False, sharex=sharex, sharey=sharey).flat)
    for axes in every:
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
        for side in ("left", "bottom"):
            axes.spines[side].set_color(TEXT)
        axes.tick_params(colors=TEXT, which="both")
        for part in (axes.xaxis.label, axes.yaxis.label, axes.title):
            part.set_color(TEXT)
        axes.patch.set_visible(False)
    return figure, every


def to_svg(figure: "Figure", label: str, salt: str = "") -> str:
    """An <svg> element for HTML: no prolog, no namespaces (HTML has them built in), no metadata. label: what it shows,
    HTML.
    salt: unlike that of the other plots of the page, for their ids to be."""
    import matplotlib

    text = io.StringIO()
    with matplotlib.rc_context(
        {"svg.fonttype": "none", "svg.hashsalt": salt or label, "font.family": "DejaVu Sans", "font.size": 10}
    ):
        figure.savefig(text, format="svg", transparent=True, metadata={"Date": None})
    svg = text.getvalue()
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = re.sub(r' xmlns(:\w+)?="[^"]*"', "", svg)
    svg = re.sub(r"<!--.*?-->", "", svg, flags=re.DOTALL)
    svg = re.sub(r"\s*\n\s*", " ", svg)
    svg = re.sub(r'<g id="[^"]*"', "<g", svg)  # nothing refers to groups
    svg = re.sub(r"<[^>]+>", lambda tag: re.sub(r"(-?\d+\.\d\d)\d+", r"\1", tag[0]), svg)  # coordinates, not text
    svg = re.sub(r'(<svg) height="[^"]*"', r"\1", svg)
    svg = re.sub(r'(<svg[^>]*) width="[^"]*"', rf'\1 role="img" aria-label="{label}"', svg, count=1)
    svg = re.sub(r"font-family: [^;\"]*|font: ([\d.]+px) [^;\"]*", _page_font, svg)
    return svg.replace(TEXT, "currentColor")


def standalone(svg: str) -> str:
    """A file from an element of to_svg: black, on white in a browser."""
    spaces = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    return svg.replace("<svg", f'<svg {spaces} color="black" font-family="sans-serif" style="background: white"', 1)


def _page_font(match: re.Match[str]) -> str:
    return f"font-size: {match[1]}" if match[1] else "font-family: inherit"
