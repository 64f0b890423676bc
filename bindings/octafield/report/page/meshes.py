"""The part of a report's page that shows one input."""

from __future__ import annotations

import base64
import html
from collections.abc import Sequence
from itertools import groupby
from typing import TYPE_CHECKING, Any

from ..numbers.columns import failure_table, run_table
from ..numbers.profiles import lines
from ..numbers.records import Case, Results, Run
from ..numbers.tables import Link, Table
from . import figures, prose, scenes
from .exhibits import Exhibit, Exhibits

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
) -> dict[str, Any]:
    """What the page shows of it: a page of its own where there are several inputs, with the runs on it. anchors: per
    input; pictures: of octafield.view.picture."""
    runs, many = results.on(name), len(results.inputs) > 1
    fields = [run for run in runs if run.done]
    cases = [case for case in (results.first_on(name, setting) for setting in results.settings) if case is not None]
    if many:
        table = run_table(results, runs, files=True)
        exhibits.add(f"runs {name}", table, "Runs on this input", "One line per run, those on one problem together.")
    shown = [_picture(exhibits, one) for one in pictures] + _plots(results, exhibits, cases)
    views = _views(results, exhibits, cases, anchors[name])
    texts = [] if fields else ["No run on this input ended with a field."]
    if many and fields:
        texts = prose.energy(
            lines(results, [p for p in results.problems if p.input == name]),
            exhibits.cite(f"runs {name}", f"convergence {name}"),
        )
    record = fields[0].record if fields else None
    return {
        "anchor": anchors[name],
        "name": name,
        "links": _links(anchors, name) if many else [],
        "facts": _facts(record) if record else "",
        "sha256": record.mesh_sha256 if record else None,
        "notes": [*record.notes, *_unserved(record), *_verdicts(fields)] if record else [],
        "texts": texts,
        "tables": exhibits.of(f"runs {name}"),
        "failures": runs_without_field(results, runs) if many else None,
        "figures": shown,
        "views": views,
    }


def runs_without_field(results: Results, runs: Sequence[Run]) -> Table | None:
    """And why; none where all have one."""
    bad = [run for run in runs if not run.done]
    return failure_table(results, bad) if bad else None


def _facts(record: FieldRecord) -> str:
    source = {"file": "the file's lines", "angle": "dihedral angle", "none": "request none"}.get(
        record.feature_source, record.feature_source
    )
    return (
        f"{record.vertices:,} vertices, {record.tets:,} tetrahedra, {record.boundary_triangles:,} boundary triangles"
        f" with a mean edge of {record.edge_length:.4g}; {record.feature_edges:,} feature edges and"
        f" {record.feature_corners:,} corners by {source}."
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


def _links(anchors: dict[str, str], name: str) -> list[Link]:
    """Back, and to the neighbours."""
    names = list(anchors)
    place = names.index(name)
    found = [Link("All inputs", "#inputs")]
    for other, arrow in ((place - 1, "\N{LEFTWARDS ARROW}"), (place + 1, "\N{RIGHTWARDS ARROW}")):
        if 0 <= other < len(names):
            found.append(Link(f"{arrow} {names[other]}", f"#{anchors[names[other]]}"))
    return found


def _picture(exhibits: Exhibits, shown: "Picture") -> Exhibit:
    data = base64.b64encode(shown.small).decode()
    made = exhibits.add("", data, shown.title, html.escape(shown.caption), "shot", shown.legend)
    exhibits.images[made.id] = shown.png
    return made


def _shown(results: Results, cases: Sequence[Case]) -> list[tuple[Case, str, Run]]:
    """The runs that plots and views of an input show, with the names of their methods."""
    return [
        (case, m.name, run) for case in cases for m in results.methods if (run := results.field(m, case)) is not None
    ]


def _plots(results: Results, exhibits: Exhibits, cases: Sequence[Case]) -> list[Exhibit]:
    if not cases:
        return []
    name, shown = cases[0].input, _shown(results, cases)
    more = " Panels side by side are boundary treatments on common axes." if len(cases) > 1 else ""
    more += " First seed." if len({case.seed for case in results.cases if case.input == name}) > 1 else ""
    kind = "plot wide" if figures.is_wide(results, cases) else "plot"
    curves = figures.convergence_plot(results, cases, exhibits.salt)
    convergence = exhibits.add(f"convergence {name}", curves, "Convergence", CONVERGENCE + more, kind)
    labels = [method + (f" ({case.setting.name})" if len(cases) > 1 else "") for case, method, _ in shown]
    seconds = figures.seconds_plot(labels, [run for *_, run in shown], exhibits.salt)
    return [convergence, exhibits.add("", seconds, "Time", TIME)]


def _views(results: Results, exhibits: Exhibits, cases: Sequence[Case], anchor: str) -> list[Exhibit]:
    shown = _shown(results, cases)
    data, places = scenes.encode([run for *_, run in shown])
    if not data:
        return []
    rows = []
    for case, of in groupby(zip(shown, places, strict=True), lambda entry: entry[0][0]):
        views = [
            (place, method, f"E {run.record.energy:.6g}, {run.record.singular_edges:,} edges")
            for (_, method, run), place in of
            if place is not None
        ]
        rows.append((case.setting.name if len(cases) > 1 else "", views))
    content = {"block": f"data-{anchor}", "rows": rows, "data": data}
    return [exhibits.add("", content, "Singular curves", TURN, "turned", scenes.LEGEND)]
