"""The page: its frame, and numbered figures and tables that prose refers to."""

import base64
import html
from dataclasses import dataclass, field
from importlib import resources
from string import Template

from ..numbers.tables import Table


@dataclass
class Exhibits:
    """Numbers figures and tables in the order in which they are made, which is that of the page."""

    _figures: int = 0
    _tables: int = 0
    _links: dict[str, str] = field(default_factory=dict)
    plots: dict[str, str] = field(default_factory=dict)  # "figure-2" -> <svg> element
    images: dict[str, bytes] = field(default_factory=dict)  # the same of PNG files, larger than on the page

    @property
    def salt(self) -> str:
        """For the ids in the next figure."""
        return f"figure-{self._figures + 1}"

    def figure(self, key: str, content: str, title: str, caption: str, kind: str = "plot", image: bytes = b"") -> str:
        """caption: HTML. image: PNG of what content shows, for a file."""
        self._figures += 1
        self._links[key] = f'<a href="#figure-{self._figures}">Figure {self._figures}</a>'
        if image:
            self.images[f"figure-{self._figures}"] = image
        if content.startswith("<svg"):
            self.plots[f"figure-{self._figures}"] = content
        text = f"<figcaption><b>Figure {self._figures}. {title}.</b> {caption}</figcaption>"
        return f'<figure class="{kind}" id="figure-{self._figures}">{content}{text}</figure>'

    def table(self, key: str, table: Table, title: str, caption: str, kind: str = "main") -> str:
        self._tables += 1
        self._links[key] = f'<a href="#table-{self._tables}">Table {self._tables}</a>'
        text = f"<figcaption><b>Table {self._tables}. {title}.</b> {caption}</figcaption>"
        notes = table.notes() if kind.startswith("main") else ""
        return f'<figure class="table" id="table-{self._tables}">{text}{table.html(kind)}{notes}</figure>'

    def cite(self, *keys: str) -> str:
        """ "(Table 1, Figure 2)", of those that are there."""
        links = [self._links[key] for key in keys if key in self._links]
        return f"({', '.join(links)})" if links else ""


def page(title: str, subtitle: str, body: str, script: str = "", *, paged: bool = False) -> str:
    """title: text; the others HTML. paged: sections of class mesh are shown one at a time."""
    template = Template(resource("template.html"))
    start = '<script>document.documentElement.classList.add("paged")</script>' if paged else ""
    return template.substitute(title=html.escape(title), subtitle=subtitle, body=body, script=script, start=start)


def resource(name: str) -> str:
    """A file of this package."""
    return resources.files(__package__).joinpath(name).read_text(encoding="utf-8")


def paragraphs(*texts: str) -> str:
    return "".join(f'<p class="prose">{text}</p>' for text in texts if text)


def picture(image: bytes, title: str, legend: list[tuple[str, str]]) -> tuple[str, str]:
    """The picture, and what goes below its caption."""
    data = base64.b64encode(image).decode()
    kind = "jpeg" if image.startswith(b"\xff\xd8") else "png"
    shown = f'<div class="picture"><img alt="{html.escape(title)}" src="data:image/{kind};base64,{data}"></div>'
    entries = "".join(
        f'<li><i style="background:{colour}"></i>{html.escape(meaning)}</li>' for colour, meaning in legend
    )
    return shown, f'<ul class="legend">{entries}</ul>' if entries else ""
