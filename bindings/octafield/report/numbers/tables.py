"""Tables of a report as HTML, CSV and LaTeX, from one list of rows."""

import csv
import html
import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import quote

_LATEX = str.maketrans(
    {c: rf"\{c}" for c in "&%$#_{}"}
    | {
        "~": r"\textasciitilde{}",
        "^": r"\textasciicircum{}",
        "\\": r"\textbackslash{}",
        "<": r"\textless{}",
        ">": r"\textgreater{}",
    }
    | {"\N{EN DASH}": "--", "\N{DEGREE SIGN}": r"\textdegree{}"}
    | dict.fromkeys(map(chr, range(32)), " ")
)


@dataclass(frozen=True)
class Link:
    """A value of a text column that leads to a place on the page or a file beside it."""

    text: str
    href: str

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class Column:
    """form: format of numbers, empty for text. meaning: HTML. group: a head over neighbouring columns."""

    head: str
    form: str = ""
    meaning: str = ""
    group: str = ""

    @property
    def name(self) -> str:
        return f"{self.group} {self.head}".strip()

    def show(self, value: object) -> str:
        if value is None:
            return "\N{EN DASH}"
        return format(value, self.form) if self.form else str(value)


@dataclass(frozen=True)
class Table:
    """stem: of its files. rows: one value per column each; None: there is none."""

    stem: str
    columns: Sequence[Column]
    rows: Sequence[Sequence[object]] = field(default_factory=list)

    def without(self, *heads: str) -> "Table":
        kept = [k for k, column in enumerate(self.columns) if column.head not in heads]
        return Table(self.stem, [self.columns[k] for k in kept], [[row[k] for k in kept] for row in self.rows])

    def without_empty(self, *heads: str) -> "Table":
        """Without those of these columns that hold nothing."""
        return self.without(
            *(
                c.head
                for k, c in enumerate(self.columns)
                if c.head in heads and all(row[k] is None for row in self.rows)
            )
        )

    def without_dull(self, *heads: str) -> "Table":
        """Without those of these columns that hold one and the same value."""
        return self.without(
            *(
                c.head
                for k, c in enumerate(self.columns)
                if c.head in heads and len({str(row[k]) for row in self.rows}) < 2
            )
        )

    def write_csv(self, path: Path) -> None:
        """Full precision."""
        with path.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow([column.name for column in self.columns])
            writer.writerows([["" if value is None else value for value in row] for row in self.rows])

    def write_latex(self, path: Path) -> None:
        """A tabular for booktabs."""
        kinds = "".join("r" if column.form else "l" for column in self.columns)
        lines = [
            rf"\begin{{tabular}}{{{kinds}}}",
            r"\toprule",
            *self._latex_groups(),
            _latex_line([c.head for c in self.columns]),
            r"\midrule",
        ]
        lines += [_latex_line(map(Column.show, self.columns, row)) for row in self.rows]
        path.write_text("\n".join([*lines, r"\bottomrule", r"\end{tabular}"]) + "\n", encoding="utf-8")

    def html(self, kind: str = "main") -> str:
        """A <table>; of class main its rows sort by a click on a head."""
        heads = "".join(
            f'<th scope="col"{_class(c)}><button type="button">{html.escape(c.head)}</button></th>'
            for c in self.columns
        )
        body = "".join(f"<tr>{''.join(map(_cell, self.columns, row))}</tr>" for row in self.rows)
        return (
            '<div class="scroll"><table'
            f' class="{kind}"><thead>{self._groups()}<tr>{heads}</tr></thead><tbody>{body}</tbody></table></div>'
        )

    def notes(self) -> str:
        """A list of what the columns mean."""
        entries = "".join(f"<dt>{html.escape(c.name)}</dt><dd>{c.meaning}</dd>" for c in self.columns if c.meaning)
        return f'<details><summary>What the columns mean</summary><dl class="columns">{entries}</dl></details>'

    def _grouped(self) -> Iterator[tuple[str, int]]:
        for group, of in itertools.groupby(column.group for column in self.columns):
            yield group, len(list(of))

    def _groups(self) -> str:
        if not any(column.group for column in self.columns):
            return ""
        cells = (
            (
                f'<th class="group" colspan="{width}" scope="colgroup">{html.escape(group)}</th>'
                if group
                else f'<td class="none" colspan="{width}"></td>'
            )
            for group, width in self._grouped()
        )
        return f"<tr>{''.join(cells)}</tr>"

    def _latex_groups(self) -> list[str]:
        if not any(column.group for column in self.columns):
            return []
        cells, rules, first = [], [], 1
        for group, width in self._grouped():
            cells.append(rf"\multicolumn{{{width}}}{{c}}{{{group.translate(_LATEX)}}}")
            rules += [rf"\cmidrule(lr){{{first}-{first + width - 1}}}"] if group else []
            first += width
        return [" & ".join(cells) + r" \\", "".join(rules)]


def _latex_line(cells: Iterable[object]) -> str:
    return " & ".join(str(cell).translate(_LATEX) for cell in cells) + r" \\"


def _cell(column: Column, value: object) -> str:
    """data-value: what the page sorts by, where that is not what is shown."""
    shown = column.show(value)
    text = html.escape(shown)
    if isinstance(value, Link):
        text = f'<a href="{quote(value.href, safe="/#")}">{text}</a>'
    elif isinstance(value, (list, tuple)):
        text = " ".join(f'<a href="{quote(link.href, safe="/#")}">{html.escape(link.text)}</a>' for link in value)
    key = "" if value is None else str(value)
    data = "" if key == shown or isinstance(value, (list, tuple)) else f' data-value="{html.escape(key)}"'
    return f"<td{_class(column)}{data}>{text}</td>"


def _class(column: Column) -> str:
    return "" if column.form else ' class="text"'


def write_records(path: Path, records: Sequence[Mapping[str, Any]]) -> None:
    """One line per record: every number and word of it, see flatten."""
    flat = [flatten(record) for record in records]
    columns = list(dict.fromkeys(name for line in flat for name in line))
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, restval="")
        writer.writeheader()
        writer.writerows(flat)


def flatten(record: Mapping[str, Any]) -> dict[str, Any]:
    """The record's numbers and words, nested ones as group_name; lists and versions are left out."""
    flat: dict[str, Any] = {}
    for name, value in record.items():
        if name in ("alignment_deg", "feature_alignment_deg", "integrability", "sizes", "wall_seconds", "cpu_seconds"):
            flat |= {f"{name}_{key}": inner for key, inner in value.items()}
        elif not isinstance(value, (Mapping, list)):
            flat[name] = value
    return flat
