"""A report's page from what was found: numbers its exhibits in the order of the page, then writes the prose that refers
to them."""

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ..numbers.columns import input_table, run_table
from ..numbers.deviations import Deviations
from ..numbers.integrability import integrability_table
from ..numbers.profiles import Line
from ..numbers.records import Results, Run
from .exhibits import Exhibits, filled
from .front import add_front, front_blocks
from .meshes import mesh_section, runs_without_field

if TYPE_CHECKING:
    from ...view.picture import Picture


@dataclass
class Report:
    """runs: in the order of the page; the first method is the one that others are measured against. pictures: of
    octafield.view.picture, per input. description: of the study, shown as it is. open_runs: not carried out yet. files:
    others beside the page to link."""

    title: str
    runs: Sequence[Run]
    pictures: "dict[str, list[Picture]]" = field(default_factory=dict)
    description: str = ""
    open_runs: int = 0
    files: Sequence[str] = ()


def anchors_of(results: Results) -> dict[str, str]:
    """Of the parts of the page, per input."""
    return {name: f"mesh-{k}-{_slug(name)}".rstrip("-") for k, name in enumerate(results.inputs, 1)}


def render(
    report: Report,
    results: Results,
    methods: list[Line],
    found: Deviations,
    files: Sequence[str],
    tables: Sequence[str],
) -> tuple[str, Exhibits]:
    """The page, and its figures for files. methods: lines of the summary. files, tables: to link beside the page; stems
    of those in tables/."""
    exhibits, anchors, many = Exhibits(), anchors_of(results), len(results.inputs) > 1
    profiles = add_front(results, methods, found, exhibits)
    exhibits.add("inputs", input_table(results, anchors), "Inputs", "Every input, its mesh and its features.")
    meshes = [mesh_section(results, exhibits, anchors, name, report.pictures.get(name, ())) for name in results.inputs]
    table = run_table(results, results.runs, files=not many)
    exhibits.add("runs", table, "Runs", "One line per run, those on one problem together.")
    sizes = integrability_table(results).without_dull("input", "seed")
    if sizes.rows:
        caption = "One line per run with sizes: curl and jump of the axes before and after."
        exhibits.add("integrability", sizes, "Integrability", caption)
    page = filled(
        "page.html",
        title=report.title,
        report=report,
        files=files,
        tables=tables,
        front=front_blocks(results, methods, found, profiles, exhibits, report.open_runs),
        exhibits=exhibits,
        meshes=meshes,
        failures=runs_without_field(results, results.runs),
        **_reproduction(results.runs),
    )
    return page, exhibits


def _reproduction(runs: Sequence[Run]) -> dict[str, Any]:
    options = [run.options for run in runs]
    first = options[0] if options else {}
    common = {name: value for name, value in first.items() if all(o.get(name) == value for o in options)}
    record = next((run.record for run in runs if run.done), None)
    return {
        "version": record.version if record else "",
        "common": json.dumps(common, indent=1),
        "varying": [name.replace("_", " ") for name in dict.fromkeys(n for o in options for n in o if n not in common)],
        "versions": record.versions if record else {},
        "machine": record.machine if record else None,
    }


def _slug(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9]+", "-", name).strip("-")[:40].lower()
