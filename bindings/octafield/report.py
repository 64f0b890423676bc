"""The report of a comparison: one HTML page that needs nothing but itself."""

import base64
import html
import json
from dataclasses import dataclass, field
from importlib import resources
from string import Template

from .phases import PHASES
from .plots import convergence_plot, seconds_plot
from .summary import COLUMNS, Column, total_seconds

CONVERGENCE = (
    "Dirichlet energy of the frames at the start (iteration 0) and after each step: rounds of diffusion and of Newton "
    "steps in sh4, then, where something else is smoothed, what that minimises, scaled to begin where sh4 ended."
)
TIME = "Reading, meshing and the surface field are done once and shared; their times are shown in every run."


@dataclass
class Picture:
    """A rendered picture with a caption stating facts from the data and a legend of (colour, meaning)."""

    title: str
    caption: str
    png: bytes
    legend: list[tuple[str, str]] = field(default_factory=list)


@dataclass
class InputSection:
    """What the report shows of one input: its runs, and pictures (of the surface first, then per run)."""

    name: str
    slug: str
    rows: list[dict] = field(default_factory=list)
    pictures: list[Picture] = field(default_factory=list)


def render_report(sections: list[InputSection]) -> str:
    """The page. Links to files are relative to the folder it lies in."""
    rows = [row for section in sections for row in section.rows]
    names = ", ".join(section.name for section in sections)
    runs = "1 run" if len(rows) == 1 else f"{len(rows)} runs"
    links = "; ".join(f'<a href="{name}">{name}</a>' for name in ("results.json", "results.csv"))
    subtitle = f"{runs}, octafield {html.escape(rows[0]['version'])}. Runs on an input share its mesh. {links}."
    body = f"""<h2 class="first">Summary</h2>
<div class="scroll">{_summary_table(sections)}</div>
<details><summary>What the columns mean</summary>{_column_notes()}</details>
{"".join(map(_section, sections))}
<h2>Options and versions</h2>
{_options(rows)}"""
    return page(f"Frame fields on {html.escape(names)}", subtitle, body)


def page(title: str, subtitle: str, body: str) -> str:
    """A page of HTML parts in the style of all reports; tables of class main sort by a click on a head."""
    template = Template(resources.files(__package__).joinpath("report_template.html").read_text(encoding="utf-8"))
    return template.substitute(title=title, subtitle=subtitle, body=body)


def _summary_table(sections: list[InputSection]) -> str:
    groups, heads = "", ""
    columns = list(COLUMNS)
    position = 0
    while position < len(columns):
        group = columns[position].group
        width = next((k for k, c in enumerate(columns[position:]) if c.group != group), len(columns) - position)
        groups += (
            f'<th class="group" colspan="{width}">{group}</th>'
            if group
            else f'<td colspan="{width}" style="border:0"></td>'
        )
        position += width
    for column in columns:
        heads += f'<th scope="col"{_text_class(column)}><button type="button">{column.head}</button></th>'
    body = "".join(
        "<tr>" + "".join(_cell(column, column.value(section.name, row)) for column in columns) + "</tr>"
        for section in sections
        for row in section.rows
    )
    return f'<table class="main"><thead><tr>{groups}</tr><tr>{heads}</tr></thead><tbody>{body}</tbody></table>'


def _text_class(column: Column) -> str:
    return ' class="text"' if column.form == "" else ""


def _cell(column: Column, value) -> str:
    shown = html.escape(column.show(value))
    return f'<td{_text_class(column)} data-value="{html.escape(str(value))}">{shown}</td>'


def _column_notes() -> str:
    entries = "".join(
        f"<dt>{(column.group + ', ') if column.group else ''}{column.head}</dt><dd>{column.meaning}</dd>"
        for column in COLUMNS
    )
    return f'<dl class="columns">{entries}</dl>'


def _section(section: InputSection) -> str:
    first = section.rows[0]
    facts = ", ".join(f"{first[key]:,} {key.replace('_', ' ')}" for key in ("vertices", "tets", "boundary_triangles"))
    facts += f"; mean boundary edge {first['edge_length']:.4g}; {first['feature_edges']:,} feature edges and "
    facts += f"{first['feature_corners']:,} corners by {_feature_words(first['feature_source'])}. "
    facts += f"Mesh <code>{first['mesh_sha256']}</code>."
    notes = "".join(f"<li>{html.escape(note)}</li>" for note in first["notes"])
    pictures = [_figure(picture) for picture in section.pictures]
    plots = _plot(convergence_plot(section.rows), "Convergence", CONVERGENCE) + _plot(
        seconds_plot(section.rows), "Time", TIME
    )
    return f"""<h2 id="{html.escape(section.slug)}">{html.escape(section.name)}</h2>
<p class="note">{facts}</p>{f"<ul>{notes}</ul>" if notes else ""}
<div class="figures">{"".join(pictures[:1])}<div>{plots}</div>{"".join(pictures[1:])}</div>
{_seconds_table(section.rows)}
<h3>Files</h3>
{_file_links(section.rows)}"""


def _plot(svg: str, title: str, caption: str) -> str:
    return f'<figure class="plot">{svg}<figcaption><b>{title}.</b> {caption}</figcaption></figure>'


def _feature_words(source: str) -> str:
    return {"file": "the file's lines", "angle": "dihedral angle", "none": "request none"}[source]


def _figure(picture: Picture) -> str:
    data = base64.b64encode(picture.png).decode()
    legend = "".join(
        f'<li><i style="background:{colour}"></i>{html.escape(meaning)}</li>' for colour, meaning in picture.legend
    )
    return (
        f'<figure><div class="picture"><img alt="{html.escape(picture.title)}" '
        f'src="data:image/png;base64,{data}"></div>'
        f"<figcaption><b>{html.escape(picture.title)}.</b> {html.escape(picture.caption)}"
        f'<ul class="legend">{legend}</ul></figcaption></figure>'
    )


def _seconds_table(rows: list[dict]) -> str:
    heads = "".join(f"<th>{phase}</th>" for phase in (*PHASES, "total"))
    body = ""
    for row in rows:
        for kind, label in (("wall_seconds", "wall"), ("cpu_seconds", "processor")):
            cells = "".join(f"<td>{row[kind][phase]:.3f}</td>" for phase in PHASES)
            cells += f"<td>{total_seconds(row, kind):.3f}</td>"
            body += f'<tr><td class="text">{html.escape(row["label"])}</td><td class="text">{label}</td>{cells}</tr>'
    return (
        '<details><summary>Seconds per phase</summary><div class="scroll"><table><thead><tr><th class="text">run</th>'
        f'<th class="text">seconds</th>{heads}</tr></thead><tbody>{body}</tbody></table></div></details>'
    )


def _file_links(rows: list[dict]) -> str:
    items = ""
    for row in rows:
        files = [file for file in row["files"] if file.startswith(row["folder"] + "/")]
        links = ", ".join(f'<a href="{html.escape(file)}">{html.escape(file.split("/")[-1])}</a>' for file in files)
        items += f"<li>{html.escape(row['label'])}: {links}</li>"
    return f"<ul>{items}</ul>"


def _options(rows: list[dict]) -> str:
    versions = ", ".join(f"{name} {value}" for name, value in rows[0]["versions"].items())
    entries = "".join(
        f"<h3>{html.escape(row['folder'])}</h3><pre>{html.escape(json.dumps(row['options'], indent=1))}</pre>"
        for row in rows
    )
    return f"<p>{html.escape(versions)}</p><details><summary>Options of every run</summary>{entries}</details>"
