"""Numbered figures and tables that the page's prose refers to, and the templates that show them."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from ..numbers.tables import Table

Legend = Iterable[tuple[str, str]]
_TEMPLATES = Environment(
    loader=PackageLoader(__package__), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
)


def filled(template: str, **values: Any) -> str:
    """A file of templates/ with these values: text, but for prose, captions, meanings of columns and plots, which are
    HTML."""
    return _TEMPLATES.get_template(template).render(values)


@dataclass(frozen=True)
class Exhibit:
    """caption: HTML. kind: how it is shown, the classes of its element. content: a Table, the <svg> of a plot, or what
    the template shows of this kind. legend: of (colour, meaning)."""

    word: str
    number: int
    title: str
    caption: str
    kind: str
    content: Any
    legend: Legend = ()

    @property
    def id(self) -> str:
        return f"{self.word.lower()}-{self.number}"


@dataclass
class Exhibits:
    """Numbers figures and tables in the order in which they are made, which is that of the page."""

    _numbers: Counter[str] = field(default_factory=Counter)
    _by_key: dict[str, Exhibit] = field(default_factory=dict)
    plots: dict[str, str] = field(default_factory=dict)  # "figure-2" -> <svg> element
    images: dict[str, bytes] = field(default_factory=dict)  # the same of PNG files, larger than on the page

    @property
    def salt(self) -> str:
        """For the ids in the next figure."""
        return f"figure-{self._numbers['Figure'] + 1}"

    def add(self, key: str, content: Any, title: str, caption: str, kind: str = "", legend: Legend = ()) -> Exhibit:
        """See Exhibit. key: to cite it by. kind: default: main for a table, plot for a figure."""
        word, usual = ("Table", "main") if isinstance(content, Table) else ("Figure", "plot")
        kind = kind or usual
        self._numbers[word] += 1
        self._by_key[key] = made = Exhibit(word, self._numbers[word], title, caption, kind, content, legend)
        if kind.startswith("plot"):
            self.plots[made.id] = content
        return made

    def of(self, *keys: str) -> list[Exhibit]:
        """Those that are there."""
        return [self._by_key[key] for key in keys if key in self._by_key]

    def cite(self, *keys: str) -> str:
        """ "(Table 1, Figure 2)" in HTML, of those that are there."""
        links = [f'<a href="#{one.id}">{one.word} {one.number}</a>' for one in self.of(*keys)]
        return f"({', '.join(links)})" if links else ""
