"""The part of a report's page that holds for all inputs: figures and tables that compare methods, and prose about
them."""

import html

from ..numbers.columns import deviation_table, summary_table
from ..numbers.deviations import Deviations
from ..numbers.hex_meshes import hex_mesh_table, hex_meshes
from ..numbers.integrability import integrability
from ..numbers.own_energies import own_energy_table
from ..numbers.profiles import Line, Profile, energies, performance_profiles, smoothing_seconds
from ..numbers.records import Method, Results
from . import figures, prose
from .exhibits import Exhibit, Exhibits

MANY = 8  # methods: a matrix of more takes the width of the page


Block = tuple[str, list[str], list[Exhibit], bool]  # head, paragraphs, what they refer to, whether that is side by side


def front_blocks(
    results: Results,
    lines: list[Line],
    found: Deviations,
    profiles: dict[Method, Profile],
    exhibits: Exhibits,
    open_runs: int,
) -> list[Block]:
    """When the whole page's exhibits have their numbers. profiles: of add_front()."""
    cite, of = exhibits.cite, exhibits.of
    scope = (
        f"{prose.scope(results, open_runs, cite('runs'))} {prose.meshes(results, cite('inputs'))}"
        f" {prose.starts(results, cite('summary', 'runs'))}".strip()
    )
    energy = [*prose.energy(lines, cite("summary", "ratios") or cite("runs"))]
    if profiles:
        energy.append(prose.profile(profiles, cite("profiles")))
    graphs = [*prose.graphs(lines, cite("summary")), prose.convergence(results, cite("runs"))]
    distances = [prose.distances(found, cite("matrix", "boxes"))]
    times = prose.times(results, cite("summary"), cite("ratios"))
    return [
        ("", [scope], [], False),
        ("Energy", energy, of("summary", "energies", "ratios", "profiles"), False),
        ("Hex-dominant meshes", hex_meshes(results, cite("hex_meshes")), of("hex_meshes"), False),
        ("Singular graphs", graphs, [], False),
        ("Integrability", integrability(results, cite("integrability")), [], False),
        ("Distance between fields", distances, of("matrix", "boxes"), len(results.methods) <= MANY),
        ("Time", [f"{times} {prose.shared_time(results, cite('inputs'))}".strip()], [], False),
    ]


def add_front(results: Results, lines: list[Line], found: Deviations, exhibits: Exhibits) -> dict[Method, Profile]:
    """Profiles of energy, where they are shown."""
    profiles: dict[Method, Profile] = {}
    if not any(run.done for run in results.runs):
        return profiles
    caption = (
        "One line per boundary treatment and method, over all inputs; seeds of one input count once, by their mean."
    )
    if found.pairs():
        caption += f" Angles are to the fields of {html.escape(results.methods[0].name)}."
    exhibits.add("summary", summary_table(results, lines, found), "Methods", caption)
    own = own_energy_table(results)
    if own.rows:
        caption = "As given to the comparison, of the same fields; methods in the order of the first."
        exhibits.add("energies", own, "Energies of one's own", caption)
    if len(results.methods) > 1:
        plot = figures.ratio_plot(results, exhibits.salt)
        exhibits.add("ratios", plot, "Energy and time relative to the best method", _ratio_caption(results))
        if len(results.problems) > 1:
            profiles = _add_profiles(results, exhibits)
    meshes = hex_mesh_table(results)
    if meshes.rows:
        caption = (
            "One line per boundary treatment and method, over all inputs; the best first. Cells of an input have one"
        )
        caption += " wanted edge length, whatever the field."
        exhibits.add("hex_meshes", meshes, "Hex-dominant meshes", caption)
    if found.pairs():
        kind = "matrix many" if len(results.methods) > MANY else "matrix"
        title = "Angles between the fields of two methods"
        exhibits.add("matrix", deviation_table(found), title, _matrix_caption(found), kind)
    if found.drawn:
        plot = figures.deviation_plot(found.drawn, found.methods[0], exhibits.salt)
        exhibits.add("boxes", plot, "Distance to the first method", _box_caption(found), "plot half")
    return profiles


def _add_profiles(results: Results, exhibits: Exhibits) -> dict[Method, Profile]:
    energy, seconds = (performance_profiles(of(results, results.problems)) for of in (energies, smoothing_seconds))
    plot = figures.profile_plot(
        [(energy, "energy over the lowest"), (seconds, "CPU seconds over the fastest")], exhibits.salt
    )
    caption = (
        "Share of the problems on which a method's energy (left) or processor time of smoothing (right) is at most so"
        " many times the best of the problem; higher is better."
    )
    exhibits.add("profiles", plot, "Performance profiles", caption)
    return energy


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
