"""The part of a report's page that holds for all inputs: figures and tables that compare methods, and prose about
them."""

import html
import re
from dataclasses import dataclass

from ..numbers.columns import deviation_table, summary_table
from ..numbers.deviations import Deviations
from ..numbers.integrability import integrability
from ..numbers.own_energies import own_energy_table
from ..numbers.profiles import Line, Profile, energies, performance_profiles, smoothing_seconds
from ..numbers.records import Method, Results
from . import figures, prose
from .html import Exhibits, paragraphs


@dataclass
class Front:
    """Exhibits as HTML, empty where there is nothing to show; text() when the whole page's exhibits have their
    numbers."""

    results: Results
    lines: list[Line]
    found: Deviations
    summary: str = ""
    own_energies: str = ""
    ratios: str = ""
    profiles: str = ""
    matrix: str = ""
    boxes: str = ""
    energy_profiles: dict[Method, Profile] | None = None

    def text(self, exhibits: Exhibits, open_runs: int) -> str:
        """The section: paragraphs, each with what it refers to."""
        results, cite = self.results, exhibits.cite
        scope = (
            f"{prose.scope(results, open_runs, cite('runs'))} {prose.meshes(results, cite('inputs'))}"
            f" {prose.starts(results, cite('summary', 'runs'))}".strip()
        )
        both, matrix = cite("summary", "ratios"), cite("matrix", "boxes")
        energy = [*prose.energy(self.lines, both or cite("runs"))]
        if self.energy_profiles:
            energy.append(prose.profile(self.energy_profiles, cite("profiles")))
        graphs = [*prose.graphs(self.lines, cite("summary")), prose.convergence(results, cite("runs"))]
        times = prose.times(results, cite("summary"), cite("ratios"))
        time = f"{times} {prose.shared_time(results, cite('inputs'))}".strip()
        distances = self.matrix + self.boxes
        if distances and len(results.methods) <= MANY:
            distances = f'<div class="figures">{distances}</div>'
        return (
            paragraphs(scope) + _headed("Energy", *energy) + self.summary + self.own_energies + self.ratios
            + self.profiles
            + _headed("Singular graphs", *graphs) + _headed("Integrability",
                *integrability(results, cite("integrability")))
                + _headed("Distance between fields", prose.distances(self.found, matrix)) + distances
            + _headed("Time", time)
        )  # fmt: skip


MANY = 8  # methods: a matrix of more takes the width of the page


def make_front(results: Results, lines: list[Line], found: Deviations, exhibits: Exhibits) -> Front:
    front = Front(results, lines, found)
    if not any(run.done for run in results.runs):
        return front
    caption = (
        "One line per boundary treatment and method, over all inputs; seeds of one input count once, by their mean."
    )
    if found.pairs():
        caption += f" Angles are to the fields of {html.escape(results.methods[0].name)}."
    front.summary = exhibits.table("summary", summary_table(results, lines, found), "Methods", caption)
    own = own_energy_table(results)
    if own.rows:
        front.own_energies = exhibits.table(
            "energies",
            own,
            "Energies of one's own",
            "As given to the comparison, of the same fields; methods in the order of the first.",
        )
    if len(results.methods) > 1:
        plot = figures.ratio_plot(results, exhibits.salt)
        front.ratios = exhibits.figure(
            "ratios", plot, "Energy and time relative to the best method", _ratio_caption(results)
        )
        if len(results.problems) > 1:
            _add_profiles(front, exhibits)
    if found.pairs():
        kind = "matrix many" if len(results.methods) > MANY else "matrix"
        table = exhibits.table(
            "matrix", deviation_table(found), "Angles between the fields of two methods", _matrix_caption(found), kind
        )
        front.matrix = _shaded(table)
    if found.drawn:
        plot = figures.deviation_plot(found.drawn, found.methods[0], exhibits.salt)
        front.boxes = exhibits.figure("boxes", plot, "Distance to the first method", _box_caption(found), "plot half")
    return front


def _add_profiles(front: Front, exhibits: Exhibits) -> None:
    energy, seconds = (
        performance_profiles(of(front.results, front.results.problems)) for of in (energies, smoothing_seconds)
    )
    plot = figures.profile_plot(
        [(energy, "energy over the lowest"), (seconds, "CPU seconds over the fastest")], exhibits.salt
    )
    caption = (
        "Share of the problems on which a method's energy (left) or processor time of smoothing (right) is at most so"
        " many times the best of the problem; higher is better."
    )
    front.profiles = exhibits.figure("profiles", plot, "Performance profiles", caption)
    front.energy_profiles = energy


def _headed(head: str, *texts: str) -> str:
    return f"<h3>{head}</h3>{paragraphs(*texts)}" if any(texts) else ""


def _ratio_caption(results: Results) -> str:
    marks = "; marks tell boundary treatments apart" if len(results.settings) > 1 else ""
    return (
        "One mark per problem: energy over the lowest energy (left) and processor seconds of smoothing over the"
        f" fastest (right) of all methods on the problem{marks}. Bars are geometric means."
    )


def _matrix_caption(found: Deviations) -> str:
    most = " at evenly chosen vertices" if found.sampled else ""
    return (
        f"Degrees{most}; below the diagonal the mean over vertices, above it the 95th percentile, each the mean over"
        " the problems that both methods solve."
    )


def _box_caption(found: Deviations) -> str:
    first = html.escape(found.methods[0].name)
    return (
        f"Angles between a field's frames and those of {first} on the same mesh, at the vertices of all problems, in"
        " degrees: median (bar), quartiles (box), 5th and 95th percentile (line)."
    )


def _shaded(matrix: str) -> str:
    """Cells of the matrix with a ground the stronger the larger their number."""
    values = [float(v) for v in re.findall(r'<td data-value="([^"]+)"', matrix)]
    largest = max(values, default=0.0) or 1.0
    # noqa: E731
    shade = lambda match: f'<td style="--share:{min(1.0, float(match[1]) / largest):.3f}" data-value="{match[1]}"'
    return re.sub(r'<td data-value="([^"]+)"', shade, matrix)
