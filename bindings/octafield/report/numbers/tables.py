"""Tables of a report as CSV, LaTeX and cells of a page, from one list of rows."""

import csv
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

    @property
    def url(self) -> str:
        return quote(self.href, safe="/#")


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

    def cells(self, shaded: bool = False) -> list[list["Cell"]]:
        """Of a page, per row. shaded: with the shares of numbers in the largest."""
        numbers = [abs(v) for row in self.rows for v in row if isinstance(v, float)] if shaded else []
        largest = max(numbers, default=0.0) or 1.0
        return [
            [_cell(column, value, largest if shaded else None) for column, value in zip(self.columns, row, strict=True)]
            for row in self.rows
        ]

    def groups(self) -> list[list[tuple[str, int]]]:
        """The line above the heads, of groups with their widths; no line where there are none."""
        return [list(self._grouped())] if any(column.group for column in self.columns) else []

    def _grouped(self) -> Iterator[tuple[str, int]]:
        for group, of in itertools.groupby(column.group for column in self.columns):
            yield group, len(list(of))

    def _latex_groups(self) -> list[str]:
        if not self.groups():
            return []
        cells, rules, first = [], [], 1
        for group, width in self._grouped():
            cells.append(rf"\multicolumn{{{width}}}{{c}}{{{group.translate(_LATEX)}}}")
            rules += [rf"\cmidrule(lr){{{first}-{first + width - 1}}}"] if group else []
            first += width
        return [" & ".join(cells) + r" \\", "".join(rules)]


def _latex_line(cells: Iterable[object]) -> str:
    return " & ".join(str(cell).translate(_LATEX) for cell in cells) + r" \\"


@dataclass(frozen=True)
class Cell:
    """shown: in place of links, where there are none. key: what the page sorts by, where that is not what is shown.
    share: of a number in the largest, where that is shown."""

    shown: str
    links: Sequence[Link]
    key: str | None
    is_text: bool
    share: str | None = None


def _cell(column: Column, value: object, largest: float | None) -> Cell:
    shown, several = column.show(value), isinstance(value, (list, tuple))
    links: Sequence[Link] = value if isinstance(value, (list, tuple)) else [value] if isinstance(value, Link) else []
    key = "" if value is None else str(value)
    share = f"{min(1.0, value / largest):.3f}" if largest and isinstance(value, float) else None
    return Cell("" if several else shown, links, None if several or key == shown else key, not column.form, share)


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
        elif name == "mesh":
            flat |= _leaves(name, value)
        elif not isinstance(value, (Mapping, list)):
            flat[name] = value
    return flat


def _leaves(name: str, value: Any) -> dict[str, Any]:
    """Of groups within groups."""
    if not isinstance(value, Mapping):
        return {name: value}
    return {path: leaf for key, inner in value.items() for path, leaf in _leaves(f"{name}_{key}", inner).items()}
