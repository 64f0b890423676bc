"""The part of a report's page that shows one input."""

from __future__ import annotations

import html
from collections.abc import Sequence
from itertools import groupby
from typing import TYPE_CHECKING

from ..numbers.columns import failure_table, run_table
from ..numbers.profiles import lines
from ..numbers.records import Case, Results, Run
from . import figures, prose, scenes
from .html import Exhibits, paragraphs, picture

if TYPE_CHECKING:
    from ...records.field import FieldRecord
    from ...view.picture import Picture

CONVERGENCE = (
    "Above, the energy E of the tables (of sh4, whatever a method minimises) at the start (iteration 0) and after each"
    " step: rounds of diffusion and of Newton steps in sh4, then, where something else is smoothed, the steps of that."
    " Below, what the method itself minimises, relative to where it began with it; a method may lower its own objective"
    " and raise E. A mark ends each curve."
)
TIME = (
    "Seconds by the clock per phase. Reading, meshing and the surface field are done once and shared; their times are"
    " shown in every run."
)
TURN = (
    "Drag to turn all of them, arrow keys too; after a click the wheel scales. Curves are smoothed, and fainter at the"
    " back."
)


def mesh_section(
    results: Results, exhibits: Exhibits, anchors: dict[str, str], name: str, pictures: "Sequence[Picture]"
) -> str:
    """A page of its own where there are several inputs, with the runs on it. anchors: per input; pictures: of
    octafield.view.picture."""
    runs, many = results.on(name), len(results.inputs) > 1
    fields = [run for run in runs if run.done]
    cases = [case for case in (results.first_on(name, setting) for setting in results.settings) if case is not None]
    table = failures = links = ""
    if many:
        table = exhibits.table(
            f"runs {name}",
            run_table(results, runs, files=True),
            "Runs on this input",
            "One line per run, those on one problem together.",
        )
        failures, links = runs_without_field(results, runs), _links(anchors, name)
    plots = [_picture(exhibits, one) for one in pictures] + _plots(results, exhibits, cases)
    views = _views(results, exhibits, cases, anchors[name])
    text = ["" if fields else "No run on this input ended with a field."]
    if many and fields:
        text = prose.energy(
            lines(results, [p for p in results.problems if p.input == name]),
            exhibits.cite(f"runs {name}", f"convergence {name}"),
        )
    return (
        '<section class="mesh"'
        f' id="{anchors[name]}">{links}<h2>{html.escape(name)}</h2>{_facts(fields)}{paragraphs(*text)}{table}{failures}'
        f'<div class="figures">{"".join(plots)}</div>{views}</section>'
    )


def runs_without_field(results: Results, runs: Sequence[Run]) -> str:
    """And why; empty where all have one."""
    bad = [run for run in runs if not run.done]
    return f"<h3>Runs without a field</h3>{failure_table(results, bad).html('main words')}" if bad else ""


def _facts(fields: Sequence[Run]) -> str:
    if not fields:
        return ""
    record = fields[0].record
    source = {"file": "the file's lines", "angle": "dihedral angle", "none": "request none"}.get(
        record.feature_source, record.feature_source
    )
    facts = (
        f"{record.vertices:,} vertices, {record.tets:,} tetrahedra, {record.boundary_triangles:,} boundary triangles"
        f" with a mean edge of {record.edge_length:.4g}; {record.feature_edges:,} feature edges and"
        f" {record.feature_corners:,} corners by {html.escape(source)}."
    )
    notes = "".join(f"<li>{html.escape(note)}</li>" for note in [*record.notes, *_unserved(record), *_verdicts(fields)])
    return f'<p class="note">{facts} Mesh <code>{html.escape(record.mesh_sha256)}</code>.</p>' + (
        f"<ul>{notes}</ul>" if notes else ""
    )


def _verdicts(fields: Sequence[Run]) -> list[str]:
    """What runs on this mesh are told to be worth, each sentence once."""
    told = [f"Verdict: {sentence}." for run in fields for sentence in _sentences(run.record)]
    return list(dict.fromkeys(told))


def _sentences(record: FieldRecord) -> list[str]:
    return [] if record.verdict is None else record.verdict.sentences


def _unserved(record: FieldRecord) -> list[str]:
    """Why an angle of up to 45 degrees at some edges is no fault of a method."""
    count = record.unserved_vertices
    if not count:
        return []
    return [
        f"At {count:,} vertices on edges between faces no frame serves all faces that meet (their normals are neither"
        " parallel nor at right angles): one of them is off by up to 45 degrees there, whatever the method. These"
        " vertices are left out of the largest alignment that the tables call held."
    ]


def _links(anchors: dict[str, str], name: str) -> str:
    """Back, and to the neighbours."""
    names = list(anchors)
    place = names.index(name)
    found = ['<a href="#inputs">All inputs</a>']
    for other, arrow in ((place - 1, "&larr;"), (place + 1, "&rarr;")):
        if 0 <= other < len(names):
            found.append(f'<a href="#{anchors[names[other]]}">{arrow} {html.escape(names[other])}</a>')
    return f"<nav>{' '.join(found)}</nav>"


def _picture(exhibits: Exhibits, shown: "Picture") -> str:
    image, legend = picture(shown.small, shown.title, shown.legend)
    return exhibits.figure("", image, html.escape(shown.title), html.escape(shown.caption) + legend, "shot", shown.png)


def _shown(results: Results, cases: Sequence[Case]) -> list[tuple[Case, str, Run]]:
    """The runs that plots and views of an input show, with the names of their methods."""
    return [
        (case, m.name, run) for case in cases for m in results.methods if (run := results.field(m, case)) is not None
    ]


def _plots(results: Results, exhibits: Exhibits, cases: Sequence[Case]) -> list[str]:
    if not cases:
        return []
    name, shown = cases[0].input, _shown(results, cases)
    more = " Panels side by side are boundary treatments on common axes." if len(cases) > 1 else ""
    more += " First seed." if len({case.seed for case in results.cases if case.input == name}) > 1 else ""
    kind = "plot wide" if figures.is_wide(results, cases) else "plot"
    convergence = exhibits.figure(
        f"convergence {name}",
        figures.convergence_plot(results, cases, exhibits.salt),
        "Convergence",
        CONVERGENCE + more,
        kind,
    )
    labels = [method + (f" ({case.setting.name})" if len(cases) > 1 else "") for case, method, _ in shown]
    seconds = figures.seconds_plot(labels, [run for *_, run in shown], exhibits.salt)
    return [convergence, exhibits.figure("", seconds, "Time", TIME)]


def _views(results: Results, exhibits: Exhibits, cases: Sequence[Case], anchor: str) -> str:
    shown = _shown(results, cases)
    data, places = scenes.encode([run for *_, run in shown])
    if not data:
        return ""
    block, rows = f"data-{anchor}", ""
    for case, of in groupby(zip(shown, places, strict=True), lambda entry: entry[0][0]):
        views = "".join(_view(block, place, method, run.record) for (_, method, run), place in of if place is not None)
        head = f"<h4>{html.escape(case.setting.name)}</h4>" if len(cases) > 1 else ""
        rows += f'{head}<div class="views">{views}</div>'
    legend = "".join(f'<li><i style="background:{colour}"></i>{word}</li>' for colour, word in scenes.LEGEND)
    content = f'{rows}<script type="text/plain" id="{block}">{data}</script>'
    return exhibits.figure("", content, "Singular curves", f'{TURN}<ul class="legend">{legend}</ul>', "turned")


def _view(block: str, place: int, label: str, record: FieldRecord) -> str:
    label = html.escape(label)
    what = f'tabindex="0" data-block="{block}" data-scene="{place}" role="img" aria-label="singular curves of {label}"'
    words = f"<b>{label}</b> E {record.energy:.6g}, {record.singular_edges:,} edges"
    return f'<div><canvas class="view" {what}></canvas><p>{words}</p></div>'
