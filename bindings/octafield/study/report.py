"""The report of a study: one HTML page that needs nothing but itself, and its tables as CSV and LaTeX beside it."""

import html
import os
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..phases import octafield_version
from ..report import CONVERGENCE, page
from ..summary import total_seconds
from . import figures, scenes
from .description import Study
from .profiles import deviations, frames_of, performance_profiles
from .results import Status, rows, status
from .store import Store
from .tables import Column, to_html, write_csv, write_latex

REPORT_FILE, TABLES = "report.html", "tables"
_NO_ENERGY = 1e-9  # energies below it are rounding: fields without singularities in a straight solid

_RUN_COLUMNS = (
    Column("input"), Column("method"), Column("seed", "d"), Column("state"), Column("vertices", ",d"), Column("tets", ",d"), Column("energy", ".6g"),
    Column("singular edges", ",d"), Column("complex edges", ",d"), Column("non-meshable", ",d"), Column("alignment max deg", ".2g"),
    Column("iterations", "d"), Column("smooth s", ".3f"), Column("total s", ".3f"), Column("peak MB", ".0f"),
)  # fmt: skip
_SUMMARY_COLUMNS = (
    Column("method"), Column("done", "d"), Column("failed", "d"), Column("energy over best", ".4f"), Column("best on", "d"),
    Column("singular edges", ",d"), Column("complex edges", ",d"), Column("non-meshable", ",d"), Column("mean angle to first, deg", ".2f"),
    Column("smooth s", ".2f"),
)  # fmt: skip
_MEANINGS = """<dl class="columns"><dt>energy</dt><dd>Dirichlet energy of the sh4 vectors of the final frames, whatever was smoothed; compare on one mesh only</dd>
<dt>energy over best</dt><dd>to the lowest of all methods on the same input and seed, geometric mean; fields without energy are left out</dd>
<dt>best on</dt><dd>problems (input and seed) on which no method has an energy lower by more than a hundredth of a per cent</dd>
<dt>complex edges</dt><dd>singular edges that no hex mesh can have; <b>non-meshable</b>: vertices of the singular graph that none can have (a necessary condition)</dd>
<dt>mean angle to first</dt><dd>smallest rotation between a field's frames and those of the first method on the same mesh, mean over vertices and problems</dd>
<dt>smooth s</dt><dd>processor seconds of constraints, start and smoothing</dd></dl>"""


@dataclass
class _Results:
    """Rows by method and problem; a problem is an input with a seed."""

    study: Study
    rows: list[dict]
    store: Store

    def __post_init__(self):
        varying = [name for name, values in self.study.runs.items() if len(values) > 1]
        if "representation" not in varying:
            varying.insert(0, "representation")
        for row in self.rows:
            options = row.get("options") or {}
            words = [str(options.get(name, "?")) if name in ("representation", "boundary", "solver") else f"{name} {options.get(name, '?')}" for name in varying]
            row["method"] = ", ".join(words)

    @property
    def done(self) -> list[dict]:
        return [row for row in self.rows if row["state"] == "done"]

    @property
    def methods(self) -> list[str]:
        return list(dict.fromkeys(row["method"] for row in self.rows))

    @property
    def problems(self) -> list[tuple]:
        return list(dict.fromkeys((row["input"], row["options"]["seed"]) for row in self.rows))

    def of(self, method: str) -> list[dict]:
        return [row for row in self.done if row["method"] == method]

    def values(self, value) -> dict[str, list[float]]:
        """value(row) per method and problem, least over repeats; infinite where no run is done."""
        table = {m: dict.fromkeys(self.problems, np.inf) for m in self.methods}
        for row in self.done:
            problem = (row["input"], row["options"]["seed"])
            table[row["method"]][problem] = min(table[row["method"]][problem], value(row))
        return {method: list(by.values()) for method, by in table.items()}


def write_report(folder: str | Path) -> Path:
    """Writes report.html and tables/*.csv, *.tex into the folder of a study from the runs finished so far; the page's path."""
    store = Store(folder)
    results = _Results(store.study(), rows(folder), store)
    angles = _angles(results)
    summary = [_summary_row(results, method, angles) for method in results.methods]
    lines = [_run_row(row) for row in results.rows]
    tables = store.folder / TABLES
    tables.mkdir(exist_ok=True)
    for stem, columns, table in (("summary", _SUMMARY_COLUMNS, summary), ("runs", _RUN_COLUMNS, lines)):
        _replace(tables / f"{stem}.csv", lambda path: write_csv(path, columns, table))  # noqa: B023
        _replace(tables / f"{stem}.tex", lambda path: write_latex(path, columns, table))  # noqa: B023
    text = _page(results, status(folder), summary, lines, angles)
    _replace(store.folder / REPORT_FILE, lambda path: path.write_text(text, encoding="utf-8"))
    return store.folder / REPORT_FILE


def _summary_row(results: _Results, method: str, angles: dict[str, np.ndarray]) -> tuple:
    of = results.of(method)
    best = np.min(list(results.values(lambda r: r["energy"]).values()), axis=0)
    own = np.array(results.values(lambda r: r["energy"])[method])
    counted = np.isfinite(own) & (best > _NO_ENERGY)
    ratio = float(np.exp(np.mean(np.log(own[counted] / best[counted])))) if counted.any() else None
    # Frames in tets have no meshability.
    total = lambda key: sum(row[key] for row in of) if all(key in row for row in of) else None  # noqa: E731
    failed = sum(row["method"] == method and row["state"] != "done" for row in results.rows)
    return (
        method, len(of), failed, ratio, int(np.sum(np.isfinite(own) & (own <= best * 1.0001 + _NO_ENERGY))), total("singular_edges"),
        total("complex_edges"), total("non_meshable_vertices"), float(angles[method].mean()) if len(angles.get(method, ())) else None,
        sum(row["cpu_seconds"]["smooth"] for row in of),
    )  # fmt: skip


def _run_row(row: dict) -> tuple:
    head = (row["input"], row["method"], row.get("options", {}).get("seed"), row["state"])
    if row["state"] != "done":
        return (*head, *[None] * (len(_RUN_COLUMNS) - len(head)))
    names = ("vertices", "tets", "energy", "singular_edges", "complex_edges", "non_meshable_vertices")
    return (
        *head, *(row.get(name) for name in names), row["alignment_deg"]["max"], row["iterations"], row["cpu_seconds"]["smooth"],
        total_seconds(row, "cpu_seconds"), row["peak_mb"],
    )  # fmt: skip


def _angles(results: _Results) -> dict[str, np.ndarray]:
    """Degrees between each method's frames and the first method's, all vertices of all problems; empty without files."""
    first, found = results.methods[0] if results.methods else "", {}
    runs = {(r["method"], r["input"], r["options"]["seed"]): r for r in reversed(results.done)}
    for problem in results.problems:
        base = runs.get((first, *problem))
        reference = None if base is None else frames_of(results.store.run_folder(base["key"]))
        for method in results.methods if reference is not None else ():
            row = runs.get((method, *problem))
            frames = None if row is None else frames_of(results.store.run_folder(row["key"]))
            if frames is not None and len(frames) == len(reference):
                found.setdefault(method, []).append(deviations(frames, reference))
    return {method: np.concatenate(parts) for method, parts in found.items()}


def _page(results: _Results, state: Status, summary: list, lines: list, angles: dict) -> str:
    study = results.study
    files = ", ".join(f'<a href="{TABLES}/{stem}{end}">{stem}{end}</a>' for stem in ("summary", "runs") for end in (".csv", ".tex"))
    counts = ", ".join(f"{n} {word}" for word, n in vars(state).items() if n or word == "done")
    subtitle = f"{state.total} runs: {counts}. octafield {html.escape(octafield_version())}. Tables: {files}."
    parts = [
        f'<h2 class="first">Methods</h2>{to_html(_SUMMARY_COLUMNS, summary)}',
        f"<details><summary>What the columns mean</summary>{_MEANINGS}</details>",
        _comparison_figures(results, angles),
        f"<h2>All runs</h2>{to_html(_RUN_COLUMNS, lines)}{_failures(results.rows)}",
        *(_input_section(results, name, k) for k, name in enumerate(dict.fromkeys(row["input"] for row in results.done))),
        f"<h2>Description</h2><pre>{html.escape(study.text)}</pre>",
        f"<script>{scenes.view_script()}</script>",
    ]
    return page(html.escape(study.name), subtitle, "\n".join(parts))


def _comparison_figures(results: _Results, angles: dict[str, np.ndarray]) -> str:
    if len(results.methods) < 2 or not results.done:
        return ""
    energy = performance_profiles(results.values(lambda r: r["energy"] if r["energy"] > _NO_ENERGY else 0))
    seconds = performance_profiles(results.values(lambda r: r["cpu_seconds"]["smooth"]))
    drawn = [
        (figures.profile_plot(energy, "energy over the best"), "Energy", "share of problems on which a method's energy is at most so many times the best (Dolan, Moré 2002); higher is better."),
        (figures.profile_plot(seconds, "seconds over the fastest"), "Time", "the same for processor seconds of smoothing."),
    ]
    others = {name: values for name, values in angles.items() if name != results.methods[0]}
    if others:
        caption = f"angle between a field's frames and those of {html.escape(results.methods[0])} on the same mesh, all vertices: median, quartiles, 5th and 95th per cent."
        drawn.append((figures.deviation_plot(others), "Deviation", caption))
    return f'<h2>Comparison</h2><div class="figures">{"".join(_figure(*d) for d in drawn)}</div>'


def _figure(content: str, title: str, caption: str) -> str:
    return f'<figure class="plot">{content}<figcaption><b>{title}:</b> {caption}</figcaption></figure>'


def _failures(all_rows: Sequence[dict]) -> str:
    items = "".join(
        f"<li>{html.escape(row['input'])}, {html.escape(row['method'])}: {html.escape(row['message'])}</li>"
        for row in all_rows
        if row["state"] != "done"
    )
    return f"<h3>Runs without a field</h3><ul>{items}</ul>" if items else ""


def _input_section(results: _Results, name: str, number: int) -> str:
    of = [row for row in results.done if row["input"] == name]
    first = of[0]
    shown = [{**row, "label": row["method"] + (f", seed {row['options']['seed']}" if len(results.study.seeds) > 1 else "")} for row in of if row["repeat"] == 0]
    views = []
    for k, row in enumerate(shown):
        scene = scenes.scene_json(results.store.run_folder(row["key"]))
        if scene and row["options"]["seed"] == first["options"]["seed"]:
            identity = f"scene-{number}-{k}"
            canvas = f'<canvas class="view" data-scene="{identity}" role="img" aria-label="singular curves"></canvas>'
            data = f'<script type="application/json" id="{identity}">{scene}</script>'
            caption = f"{row['singular_edges']:,} singular edges, energy {row['energy']:.6g}."
            views.append(f'<figure>{canvas}{data}<figcaption><b>{html.escape(row["label"])}:</b> {caption}</figcaption></figure>')
    facts = f"{first['vertices']:,} vertices, {first['tets']:,} tets. Mesh <code>{first['mesh_sha256']}</code>."
    legend = "Vermillion: valence 3; blue: valence 5; purple: other singular curves; grey: sharp edges and middle sections. Drag to turn, wheel to scale."
    lines = [_run_row(row) for row in of]
    plot = _figure(figures.convergence_plot(shown), "Convergence", CONVERGENCE)
    return (
        f'<h2 id="input-{number}">{html.escape(name)}</h2><p class="note">{facts}{" " + legend if views else ""}</p>{to_html(_RUN_COLUMNS, lines)}'
        f'<div class="figures">{plot}{"".join(views)}</div>'
    )


def _replace(path: Path, write) -> None:
    handle, partial = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    os.close(handle)
    write(Path(partial))
    os.chmod(partial, 0o644)
    os.replace(partial, path)
