"""Tables of a study as CSV, LaTeX and HTML, from one list of rows."""

import csv
import html
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

_LATEX = str.maketrans({c: rf"\{c}" for c in "&%$#_{}"} | {"~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "\\": r"\textbackslash{}"})


@dataclass(frozen=True)
class Column:
    """form: of numbers, empty for text."""

    head: str
    form: str = ""

    def show(self, value) -> str:
        if value is None:
            return "\N{EN DASH}"
        return format(value, self.form) if self.form else str(value)


def write_csv(path: Path, columns: Sequence[Column], rows: Sequence[Sequence]) -> None:
    """Full precision."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow([column.head for column in columns])
        writer.writerows([["" if value is None else value for value in row] for row in rows])


def write_latex(path: Path, columns: Sequence[Column], rows: Sequence[Sequence]) -> None:
    """A tabular for booktabs."""
    lines = [[column.head for column in columns], *([c.show(v) for c, v in zip(columns, row, strict=True)] for row in rows)]
    head, *body = [" & ".join(cell.replace("\N{EN DASH}", "--").translate(_LATEX) for cell in line) + r" \\" for line in lines]
    kinds = "".join("r" if column.form else "l" for column in columns)
    text = [rf"\begin{{tabular}}{{{kinds}}}", r"\toprule", head, r"\midrule", *body, r"\bottomrule", r"\end{tabular}"]
    path.write_text("\n".join(text) + "\n", encoding="utf-8")


def to_html(columns: Sequence[Column], rows: Sequence[Sequence]) -> str:
    heads = "".join(
        f'<th scope="col"{_class(c)}><button type="button">{html.escape(c.head)}</button></th>' for c in columns
    )
    body = "".join("<tr>" + "".join(map(_cell, columns, row)) + "</tr>" for row in rows)
    return f'<div class="scroll"><table class="main"><thead><tr>{heads}</tr></thead><tbody>{body}</tbody></table></div>'


def _cell(column: Column, value) -> str:
    key = "" if value is None else str(value)
    return f'<td{_class(column)} data-value="{html.escape(key)}">{html.escape(column.show(value))}</td>'


def _class(column: Column) -> str:
    return "" if column.form else ' class="text"'
