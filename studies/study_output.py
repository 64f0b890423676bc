"""What the studies share: the style of figures, CSV files and markdown tables."""

import csv
from pathlib import Path

from matplotlib import rc_context
from matplotlib.figure import Figure

STYLE = {"font.family": "DejaVu Sans", "font.size": 10, "axes.spines.top": False, "axes.spines.right": False}


def new_figure(width: float, height: float, rows: int = 1, columns: int = 1, **options):
    """A figure in inches and its axes, as pyplot.subplots."""
    with rc_context(STYLE):
        figure = Figure(figsize=(width, height), layout="constrained")
        axes = figure.subplots(rows, columns, **options)
    return figure, axes


def with_grid(axes) -> None:
    axes.grid(alpha=0.25, linewidth=0.6)
    axes.set_axisbelow(True)


def save_figure(figure: Figure, path: Path, dpi: int = 130) -> None:
    with rc_context(STYLE):
        figure.savefig(path, dpi=dpi, facecolor="white", metadata={"Software": None})
    print(path)


def write_csv(path: Path, header, rows, quiet: bool = False) -> None:
    """Numbers with 9 significant digits; anything else as it is."""
    with path.open("w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(header)
        out.writerows([f"{x:.9g}" if isinstance(x, float) else x for x in row] for row in rows)
    if not quiet:
        print(path)


def markdown_table(header, rows) -> str:
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)
