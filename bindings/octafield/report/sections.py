"""The parts of a report's page: what holds for all inputs, then a section per input."""

import html
import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

from . import figures, prose, scenes
from .columns import deviation_table, input_table, run_table, summary_table
from .deviations import Deviations
from .page import Exhibits, page, paragraphs, picture
from .profiles import Line, energies, lines, performance_profiles, smoothing_seconds
from .records import Problem, Results, Run
from .tables import Column, Table

CONVERGENCE = (
    "Dirichlet energy of the frames at the start (iteration 0) and after each step: rounds of diffusion and of Newton "
    "steps in sh4, then, where something else is smoothed, what that minimises, scaled to begin where sh4 ended. A mark ends each curve."
)


@dataclass
class Content:
    """What a page is made from. pictures: per input. links: HTML, to the files beside the page."""

    results: Results
    lines: list[Line]
    found: Deviations
    pictures: dict[str, list]
    title: str
    description: str
    open_runs: int
    links: str

    @property
    def anchors(self) -> dict[str, str]:
        return {name: f"mesh-{k}-{_slug(name)}".rstrip("-") for k, name in enumerate(self.results.inputs, 1)}


def render(content: Content) -> str:
    results, exhibits = content.results, Exhibits()
    many = len(results.inputs) > 1
    front = _results(content, exhibits)
    inputs = exhibits.table("inputs", input_table(results, content.anchors), "Inputs", "Every input, its mesh and its features.")
    meshes = "".join(_mesh_section(content, exhibits, name) for name in results.inputs)
    runs = exhibits.table("runs", run_table(results, list(results.runs), files=True) if not many else run_table(results, list(results.runs)), "Runs", "Every run.")
    opening = _opening(content, exhibits)
    version = next((run.row["version"] for run in results.runs if "version" in run.row), "")
    navigation = [("results", "Results"), ("inputs", "Inputs"), ("runs", "Runs"), ("methods", "Methods"), ("reproduction", "Reproduction")]
    subtitle = (
        f"octafield {html.escape(version)}. {content.links}."
        f"<nav>{' '.join(f'<a href=#{anchor}>{word}</a>' for anchor, word in navigation)}</nav>"
    )
    body = (
        f'<div class="front"><h2 id="results" class="first">Results</h2>{opening}{front}<h2 id="inputs">Inputs</h2>{inputs}</div>'
        f'{meshes}<div class="front"><h2 id="runs">Runs</h2>{runs}{_failures(results)}'
        f'<h2 id="methods">Methods</h2><div class="prose">{scenes.resource("methods.html")}</div>'
        f'<h2 id="reproduction">Reproduction</h2>{_reproduction(content, exhibits)}</div>'
    )
    return page(content.title, subtitle, body, f"<script>{scenes.resource('view.js')}</script>", paged=many)


def _opening(content: Content, exhibits: Exhibits) -> str:
    results = content.results
    return paragraphs(f"{prose.scope(results, content.open_runs, exhibits.cite('runs'))} {prose.meshes(results, exhibits.cite('inputs'))}")


def _results(content: Content, exhibits: Exhibits) -> str:
    """Exhibits first, then the prose that refers to them."""
    results, found, compared = content.results, content.found, len(content.results.methods) > 1
    anything = any(run.done for run in results.runs)
    summary = exhibits.table(
        "summary", summary_table(results, content.lines, found), "Methods",
        "One line per boundary treatment and method, over all inputs and seeds." + (" Angles are to the first method." if compared else ""),
    ) if anything else ""  # fmt: skip
    ratios = profiles = matrix = boxes = ""
    energy_profiles = {}
    if compared and anything:
        energy_profiles = performance_profiles(energies(results, results.problems))
        ratios = exhibits.figure("ratios", figures.ratio_plot(results, exhibits.salt), "Energy and time relative to the best method", _ratio_caption(results))
        if len(results.problems) > 1:
            seconds = performance_profiles(smoothing_seconds(results, results.problems))
            parts = [(energy_profiles, "energy over the lowest"), (seconds, "CPU seconds over the fastest")]
            caption = "Share of the problems on which a method's energy (left) or processor time of smoothing (right) is at most so many times the best of the problem; higher is better."
            profiles = exhibits.figure("profiles", figures.profile_plot(parts, exhibits.salt), "Performance profiles", caption)
        if found.pairs():
            matrix = exhibits.table("matrix", deviation_table(found), "Angles between the fields of two methods", _matrix_caption(found), "matrix" if len(results.methods) < 9 else "matrix many")
            matrix = _shaded(matrix)
        if found.drawn:
            caption = f"Angles between a field's frames and those of {html.escape(found.methods[0].name)} on the same mesh, at the vertices of all problems, in degrees: median, quartiles (box), 5th and 95th percentile (line)."
            boxes = exhibits.figure("boxes", figures.deviation_plot(found.drawn, found.methods[0], exhibits.salt), "Distance to the first method", caption, "plot half")
    cite = exhibits.cite
    first = prose.energy(content.lines, cite("summary", "ratios"))
    if profiles:
        first.append(prose.profile(energy_profiles, cite("profiles")))
    second = [*prose.graphs(content.lines, cite("summary")), prose.convergence(results, cite("summary"))]
    last = [f"{prose.times(results, cite('summary', 'ratios'))} {prose.shared_time(results, cite('summary'))}" if anything else ""]
    return (
        _headed("Energy", *first) + summary + ratios + profiles + _headed("Singular graphs", *second)
        + _headed("Distance between fields", prose.distances(found, cite("matrix", "boxes")))
        + (f'<div class="figures">{matrix}{boxes}</div>' if len(results.methods) < 9 else matrix + boxes) + _headed("Time", *last)
    )  # fmt: skip


def _headed(head: str, *texts: str) -> str:
    return f"<h3>{head}</h3>{paragraphs(*texts)}" if any(texts) else ""


def _ratio_caption(results: Results) -> str:
    marks = "; marks tell boundary treatments apart" if len(results.settings) > 1 else ""
    return f"One mark per problem: energy over the lowest energy (left) and processor seconds of smoothing over the fastest (right) of all methods on the problem{marks}. Bars: geometric means."


def _matrix_caption(found: Deviations) -> str:
    most = " at evenly chosen vertices" if found.sampled else ""
    return f"Degrees{most}; below the diagonal the mean over vertices, above it the 95th percentile, each the mean over the problems that both methods solve."


def _shaded(matrix: str) -> str:
    """Cells of the matrix with a ground the stronger the larger their number."""
    values = [float(v) for v in re.findall(r'<td data-value="([^"]+)"', matrix)]
    largest = max(values, default=0.0) or 1.0
    shade = lambda match: f'<td style="--share:{min(1.0, float(match[1]) / largest):.3f}" data-value="{match[1]}"'  # noqa: E731
    return re.sub(r'<td data-value="([^"]+)"', shade, matrix)


def _mesh_section(content: Content, exhibits: Exhibits, name: str) -> str:
    results, many = content.results, len(content.results.inputs) > 1
    runs, anchors = results.on(name), content.anchors
    fields = [run for run in runs if run.done]
    problems = [p for p in (results.first_on(name, setting) for setting in results.settings) if p is not None]
    table = exhibits.table(f"runs {name}", run_table(results, runs, files=True), "Runs on this input", "One line per run.") if many else ""
    figures_ = [_picture(exhibits, picture_) for picture_ in content.pictures.get(name, ())] + _plots(results, exhibits, problems)
    views = _views(results, exhibits, name, problems, anchors[name])
    cite = exhibits.cite(f"runs {name}" if many else "runs", *[f"convergence {name}"] * bool(fields))
    text = prose.energy(lines(results, [p for p in results.problems if p.input == name]), cite) if many and fields else []
    if not fields:
        text = ["No run on this input ended with a field."]
    head = f"<h2>{html.escape(name)}</h2>"
    notes = "".join(f"<li>{html.escape(note)}</li>" for note in (fields[0].row.get("notes", ()) if fields else ()))
    return (
        f'<section class="mesh" id="{anchors[name]}">{_turner(content, name) if many else ""}{head}{_facts(fields)}{f"<ul>{notes}</ul>" if notes else ""}{paragraphs(*text)}'
        f'{table}{_failures(results, name) if many else ""}<div class="figures">{"".join(figures_)}</div>{views}</section>'
    )


def _facts(fields: Sequence[Run]) -> str:
    if not fields:
        return ""
    row = fields[0].row
    source = {"file": "the file's lines", "angle": "dihedral angle", "none": "request none"}.get(row["feature_source"], row["feature_source"])
    facts = (
        f"{row['vertices']:,} vertices, {row['tets']:,} tetrahedra, {row['boundary_triangles']:,} boundary triangles with a mean edge of {row['edge_length']:.4g}; "
        f"{row['feature_edges']:,} feature edges and {row['feature_corners']:,} corners by {html.escape(source)}."
    )
    return f'<p class="note">{facts} Mesh <code>{html.escape(row["mesh_sha256"])}</code>.</p>'


def _turner(content: Content, name: str) -> str:
    """Links back and to the neighbours."""
    anchors, names = content.anchors, content.results.inputs
    k = names.index(name)
    links = ['<a href="#inputs">All inputs</a>']
    links += [f'<a href="#{anchors[names[n]]}">{arrow} {html.escape(names[n])}</a>' for n, arrow in ((k - 1, "&larr;"), (k + 1, "&rarr;")) if 0 <= n < len(names)]
    return f"<nav>{' '.join(links)}</nav>"


def _picture(exhibits: Exhibits, shown) -> str:
    image, legend = picture(shown.small, shown.title, shown.legend)
    return exhibits.figure("", image, html.escape(shown.title), html.escape(shown.caption) + legend, "shot")


def _plots(results: Results, exhibits: Exhibits, problems: Sequence[Problem]) -> list[str]:
    if not problems:
        return []
    name = problems[0].input
    more = " Panels are boundary treatments on common axes." if len(problems) > 1 else ""
    more += " First seed." if len({p.seed for p in results.problems if p.input == name}) > 1 else ""
    kind = "plot wide" if figures.is_wide(results, problems) else "plot"
    plots = [exhibits.figure(f"convergence {name}", figures.convergence_plot(results, problems, exhibits.salt), "Convergence", CONVERGENCE + more, kind)]
    shown = [(p, m, run) for p in problems for m in results.methods if (run := results.field(m, p)) is not None]
    labels = [m.name + (f" ({p.setting.name})" if len(problems) > 1 else "") for p, m, _ in shown]
    caption = "Seconds by the clock per phase. Reading, meshing and the surface field are done once and shared; their times are shown in every run."
    return [*plots, exhibits.figure("", figures.seconds_plot(labels, [run for *_, run in shown], exhibits.salt), "Time", caption)]


def _views(results: Results, exhibits: Exhibits, name: str, problems: Sequence[Problem], anchor: str) -> str:
    shown = [(p, m, run) for p in problems for m in results.methods if (run := results.field(m, p)) is not None]
    data, places = scenes.encode([run for *_, run in shown])
    if not data:
        return ""
    rows = ""
    for problem, of in groupby(zip(shown, places, strict=True), lambda entry: entry[0][0]):
        views = "".join(_view(f"data-{anchor}", place, m.name, run.row) for (_, m, run), place in of if place is not None)
        rows += (f"<h4>{html.escape(problem.setting.name)}</h4>" if len(problems) > 1 else "") + f'<div class="views">{views}</div>'
    block = f'<script type="text/plain" id="data-{anchor}">{data}</script>'
    legend = "".join(f'<li><i style="background:{c}"></i>{w}</li>' for c, w in scenes.LEGEND)
    caption = f'Drag to turn all of them, arrow keys too; after a click the wheel scales. Curves are smoothed, and fainter at the back.<ul class="legend">{legend}</ul>'
    return exhibits.figure(f"views {name}", rows + block, "Singular curves", caption, "turned")


def _view(block: str, place: int, label: str, row: dict) -> str:
    canvas = f'<canvas class="view" tabindex="0" data-block="{block}" data-scene="{place}" role="img" aria-label="singular curves of {html.escape(label)}"></canvas>'
    return f"<div>{canvas}<p><b>{html.escape(label)}</b> E {row['energy']:.6g}, {row['singular_edges']:,} edges</p></div>"


def _failures(results: Results, name: str = "") -> str:
    """Runs that ended without a field, and why."""
    bad = [run for run in results.runs if not run.done and name in ("", run.input)]
    if not bad:
        return ""
    columns = [Column(head) for head in ("input", "method", "boundary", "state", "message")]
    rows = [[run.input, results.method(run).name, results.problem(run).setting.name, run.state, run.row.get("message", "")] for run in bad]
    return f'<h3>Runs without a field</h3>{Table("failures", columns, rows).html("main words")}'


def _reproduction(content: Content, exhibits: Exhibits) -> str:
    runs = content.results.runs
    options = [run.options for run in runs]
    common = {name: value for name, value in options[0].items() if all(o.get(name) == value for o in options)} if options else {}
    varying = list(dict.fromkeys(name for o in options for name in o if name not in common))
    row = next((run.row for run in runs if "versions" in run.row), {})
    software = ", ".join(f"{name} {value}" for name, value in row.get("versions", {}).items())
    differ = f" The runs differ in {html.escape(', '.join(varying).replace('_', ' '))}." if varying else ""
    text = (
        f"Computed with {html.escape(software)}. Hashes of the meshes are in {exhibits.cite('inputs').strip('()')}; the options of a run are in its record "
        f"(<code>result.json</code>), and <code>octafield.FieldOptions(**record[\"options\"])</code> makes them again.{differ} The same version, input, options and seed give the same field at any number of threads."
    )
    shown = f"<details><summary>Options that all runs share</summary><pre>{html.escape(json.dumps(common, indent=1))}</pre></details>"
    described = f"<details open><summary>Description of the study</summary><pre>{html.escape(content.description)}</pre></details>" if content.description else ""
    return paragraphs(text) + shown + described


def _slug(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9]+", "-", name).strip("-")[:40].lower()
