"""A report's page from what was found: numbers its exhibits in the order of the page, then writes the prose that refers
to them."""

import html
import json
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..numbers.columns import input_table, run_table
from ..numbers.deviations import Deviations
from ..numbers.integrability import integrability_table
from ..numbers.profiles import Line
from ..numbers.records import Results
from .front import make_front
from .html import Exhibits, page, paragraphs, resource
from .meshes import mesh_section, runs_without_field

if TYPE_CHECKING:
    from ...view.picture import Picture

_PARTS = ("results", "inputs", "runs", "methods", "reproduction")


@dataclass
class Content:
    """What a page is made from. pictures: per input. links: HTML, to the files beside the page."""

    results: Results
    lines: list[Line]
    found: Deviations
    pictures: "dict[str, list[Picture]]"
    title: str
    description: str
    open_runs: int
    links: str

    @property
    def anchors(self) -> dict[str, str]:
        """Of the parts of the page, per input."""
        return {name: f"mesh-{k}-{_slug(name)}".rstrip("-") for k, name in enumerate(self.results.inputs, 1)}


def render(content: Content) -> tuple[str, Exhibits]:
    """The page, and its figures for files."""
    results, exhibits, anchors = content.results, Exhibits(), content.anchors
    many = len(results.inputs) > 1
    front = make_front(results, content.lines, content.found, exhibits)
    inputs = exhibits.table(
        "inputs", input_table(results, anchors), "Inputs", "Every input, its mesh and its features."
    )
    meshes = "".join(
        mesh_section(results, exhibits, anchors, name, content.pictures.get(name, ())) for name in results.inputs
    )
    runs = exhibits.table(
        "runs",
        run_table(results, results.runs, files=not many),
        "Runs",
        "One line per run, those on one problem together.",
    )
    sizes = integrability_table(results)
    if sizes.rows:
        runs += exhibits.table(
            "integrability",
            sizes.without_dull("input", "seed"),
            "Integrability",
            "One line per run with sizes: curl and jump of the axes before and after.",
        )
    body = (
        f'<div class="front"><h2 id="results" class="first">Results</h2>{front.text(exhibits, content.open_runs)}<h2'
        f' id="inputs">Inputs</h2>{inputs}</div>{meshes}<div class="front"><h2'
        f' id="runs">Runs</h2>{runs}{runs_without_field(results, results.runs)}<h2 id="methods">Methods</h2><div'
        f' class="prose">{resource("methods.html")}</div><h2'
        f' id="reproduction">Reproduction</h2>{_reproduction(content, exhibits)}</div>'
    )
    return (
        page(content.title, _subtitle(content), body, f"<script>{resource('view.js')}</script>", paged=many),
        exhibits,
    )


def _subtitle(content: Content) -> str:
    version = next((run.record.version for run in content.results.runs if run.done), "")
    links = " ".join(f'<a href="#{part}">{part.capitalize()}</a>' for part in _PARTS)
    return f"octafield {html.escape(version)}. {content.links}.<nav>{links}</nav>"


def _reproduction(content: Content, exhibits: Exhibits) -> str:
    runs = content.results.runs
    options = [run.options for run in runs]
    common = (
        {name: value for name, value in options[0].items() if all(o.get(name) == value for o in options)}
        if options
        else {}
    )
    varying = list(dict.fromkeys(name for o in options for name in o if name not in common))
    record = next((run.record for run in runs if run.done), None)
    software = ", ".join(f"{name} {value}" for name, value in (record.versions if record else {}).items())
    machine = record and record.machine
    where = f" on {html.escape(machine.cpu)}, {machine.cores} cores, load {machine.load}" if machine else ""
    differ = f" The runs differ in {html.escape(', '.join(varying).replace('_', ' '))}." if varying else ""
    text = (
        f"Computed with {html.escape(software)}{where}. Hashes of the meshes are in"
        f" {exhibits.cite('inputs').strip('()')}; the options of a run are "
        'in its record (<code>result.json</code>), and <code>octafield.FieldOptions(**record["options"])</code> makes'
        f" them again.{differ} "
        "The same version, input, options and seed give the same field at any number of threads."
    )
    shown = (
        "<details><summary>Options that all runs"
        f" share</summary><pre>{html.escape(json.dumps(common, indent=1))}</pre></details>"
    )
    if content.description:
        shown += (
            "<details open><summary>Description of the"
            f" study</summary><pre>{html.escape(content.description)}</pre></details>"
        )
    return paragraphs(text) + shown


def _slug(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9]+", "-", name).strip("-")[:40].lower()
