"""The tables of a report and of the terminal: head, number format, meaning and value of each column in one place."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from .deviations import Deviations
from .profiles import Line
from .records import Results, Run
from .tables import Column, Link, Table

if TYPE_CHECKING:
    from ...records.field import FieldRecord
    from ...records.parts import HexDominantFigures

_DEG, _HEX = "alignment, deg", "hexahedra"
_MADE = ("volume, %", "cells, %", "worst")


@dataclass(frozen=True)
class RunColumn(Column):
    """value(results, run). terminal: shown there too, where lines are short. page: shown in the report."""

    value: Callable[[Results, Run], object] = lambda results, run: None
    terminal: bool = True
    page: bool = True


def preparation_seconds(record: FieldRecord) -> float:
    """By the clock, of what the runs on an input share."""
    seconds = record.wall_seconds
    return seconds.read + seconds.mesh + seconds.surface


def held_alignment(record: FieldRecord) -> float:
    """The largest angle where a frame can serve all faces; of older records, anywhere."""
    angles = record.alignment_deg
    return angles.max if angles.held_max is None else angles.held_max


def percent(share: float | None) -> float | None:
    return None if share is None else 100 * share


def worst(mesh: HexDominantFigures) -> float | None:
    """The least scaled Jacobian of its hexahedra; None without any."""
    found = (mesh.scaled_jacobian or {}).get("hexahedra")
    return None if found is None else found.min


def field_column(
    head: str, form: str, meaning: str, group: str, value: Callable[[FieldRecord], object], **more: bool
) -> RunColumn:
    """A number of the record; none where the run has no field."""
    return RunColumn(head, form, meaning, group, lambda _, run: value(run.record) if run.done else None, **more)


RUN_COLUMNS: tuple[RunColumn, ...] = (
    RunColumn("input", "", "the file or generated shape", value=lambda _, run: run.input),
    RunColumn("method", "", "what the frames were smoothed as, and how where methods differ in that; or the name "
                            "given to a field that was read", value=lambda results, run: results.method(run).name),
    RunColumn(
        "boundary",
        "",
        "fixed: frames held at the surface cross field; aligned: one axis on the normal, twist free; none: free",
        value=lambda results, run: results.problem(run).setting.name,
    ),
    RunColumn("seed", "d", "of every random start", value=lambda _, run: run.seed),
    RunColumn("repeat", "d", "equal runs, for timings", value=lambda _, run: run.repeat, terminal=False),
    RunColumn("state", "", "done; failed: the input or an option is at fault; crashed: the process died",
        value=lambda _, run: run.state, terminal=False),
    field_column("vertices", ",d", "of the tetrahedral mesh", "", lambda r: r.vertices, page=False),
    field_column("tets", ",d", "tetrahedra", "", lambda r: r.tets, page=False),
    field_column("E", ".6g", "Dirichlet energy of the final frames in sh4; compare on one mesh only", "energy",
        lambda r: r.energy),
    field_column("unit speed", ".6g", "3/20 of E: of an embedding in which a frame turning by 1 radian moves by 1",
        "energy", lambda r: r.energy_unit_speed),
    field_column("own", ".6g", "what the method itself minimised, for its last field; compare with the same method "
                                "only", "energy", lambda r: r.objective, terminal=False),
    field_column("edges", ",d", "triangles round which the frames turn: edges of the dual mesh on singular curves",
        "singular", lambda r: r.singular_edges),
    field_column("length", ".4g", "of the singular curves, unit of the input", "singular", lambda r: r.singular_length),
    field_column("complex", ",d", "singular edges whose rotation keeps no axis of the frame; no hex mesh has them",
        "singular", lambda r: r.complex_edges),
    field_column(
        "non-meshable", ",d",
        "places where singular curves meet, change or reach the surface in a way no hex mesh has (a necessary "
        "condition: the "
        "others may still have none); nodes that complex edges join count one by one",
        "singular", lambda r: r.non_meshable_vertices,
    ),
    field_column(
        "edges", ",d", "feature edges at which the turn of the field leaves no hexahedron (a necessary condition)",
        "non-meshable features", lambda r: r.non_meshable_feature_edges, terminal=False,
    ),
    field_column(
        "corners", ",d", "corners at which the numbers of hexahedra and quadrilaterals round them fit no hex mesh (a "
                         "necessary condition)",
        "non-meshable features", lambda r: r.non_meshable_corners, terminal=False,
    ),
    field_column("median", ".2f", "angle between surface normal and nearest frame axis, over boundary vertices and "
                                   "their smooth sectors", _DEG, lambda r: r.alignment_deg.median),
    field_column(
        "held, max", ".2f", "its maximum, but for vertices where faces meet that no frame serves all (normals neither "
                            "parallel nor at right angles)",
        _DEG, held_alignment,
    ),
    field_column("unserved", ",d", "how many vertices such edges and corners have; one face is off by up to 45 "
                                    "degrees there, whatever the method", _DEG, lambda r: r.unserved_vertices,
        terminal=False),
    field_column(
        "features", ".2f", "largest angle between a feature curve and the nearest frame axis, corners included",
        _DEG, lambda r: r.feature_alignment_deg.max, terminal=False,
    ),
    field_column(
        "axis jump", ".3g",
        "jump of the axes along the face between two tets, root mean square: 0 for gradients of a map, of the order "
        "of the mesh "
        "width on smooth fields; compare on one mesh only",
        "", lambda r: r.integrability and r.integrability.jump_rms, terminal=False,
    ),
    field_column("volume, %", ".1f", "what hexahedra are of the volume of the hex-dominant mesh along the field", _HEX,
        lambda r: r.mesh and percent(r.mesh.hex_volume_share)),
    field_column("cells, %", ".1f", "what they are of the number of its cells", _HEX,
        lambda r: r.mesh and percent(r.mesh.hex_number_share)),
    field_column("worst", ".3f", "the least of their scaled Jacobians", _HEX, lambda r: r.mesh and worst(r.mesh)),
    field_column("iterations", "d", "diffusion steps and iterations of smoothing", "", lambda r: r.iterations),
    field_column("smooth, CPU", ".3f", "processor seconds of boundary constraints, start and smoothing, all threads",
        "seconds", lambda r: r.cpu_seconds.smooth, terminal=False),
    field_column("smooth", ".3f", "the same by the clock", "seconds", lambda r: r.wall_seconds.smooth, terminal=False),
    field_column(
        "total", ".2f", "all phases by the clock, those that runs share included", "seconds",
        lambda r: sum(r.wall_seconds.values()),
    ),
    field_column("peak MB", ",.0f", "largest resident memory of the process during the run, its libraries included",
        "", lambda r: r.peak_mb),
)  # fmt: skip


def run_table(results: Results, runs: Sequence[Run], *, files: bool = False) -> Table:
    """A line per run, those on one problem together. files: with links to their files, for the page only."""
    runs = sorted(runs, key=lambda run: (results.rank(run), run.repeat))
    of_page = [column for column in RUN_COLUMNS if column.page]
    rows = [[column.value(results, run) for column in of_page] for run in runs]
    columns: list[Column] = [*of_page]
    if files:
        columns.append(Column("files"))
        rows = [[*row, _links(run)] for row, run in zip(rows, runs, strict=True)]
    table = Table("runs", columns, rows).without_empty(*_MADE)
    return table.without_dull("repeat", "state", *(["input", "seed"] if files else []))


def _links(run: Run) -> list[Link]:
    short = {"result.json": "record", "field.vtu": "field", "singular.vtp": "curves", "log.txt": "log"}
    return [Link(text, f"{run.link}/{name}") for name, text in short.items() if run.link and run.file(name)]


def terminal_table(results: Results) -> Table:
    columns = [column for column in RUN_COLUMNS if column.terminal]
    rows = [[column.value(results, run) for column in columns] for run in results.runs]
    return Table("terminal", columns, rows).without_empty(*_MADE)


def input_table(results: Results, anchors: dict[str, str]) -> Table:
    """A line per input with any field on it; anchors: of its part of the page."""
    columns = (
        Column("input", "", "leads to its part of this page"), Column("vertices", ",d", "of the tetrahedral mesh"),
        Column("tets", ",d", "tetrahedra"),
        Column("boundary triangles", ",d", "of its surface"),
        Column("mean edge", ".4g", "of the surface, unit of the input"),
        Column("feature edges", ",d", "edges of the surface that the field follows"),
        Column("corners", ",d", "where feature curves meet or turn"),
        Column("Euler characteristic", "d", "of the surface; the sum of the indices of the singular points of its "
                                            "cross field"),
        Column("preparation, s", ".3f", "reading, meshing and cross field on the surface, seconds by the clock, which "
                                        "runs share"),
        Column("runs", "d", "all runs on it"), Column("mesh", "", "first digits of the SHA-256 of the mesh"),
    )  # fmt: skip
    rows = []
    for name, anchor in anchors.items():
        runs = results.on(name)
        record = next((run.record for run in runs if run.done), None)
        *facts, mesh = _facts(record) if record is not None else [None] * 9
        rows.append([Link(name, f"#{anchor}"), *facts, len(runs), mesh])
    return Table("inputs", columns, rows)


def _facts(r: FieldRecord) -> list[object]:
    """Of an input, by one of its fields."""
    euler_characteristic = r.surface_field and r.surface_field.euler_characteristic
    return [
        r.vertices, r.tets, r.boundary_triangles, r.edge_length, r.feature_edges, r.feature_corners,
        euler_characteristic, preparation_seconds(r), r.mesh_sha256,
    ]  # fmt: skip


def summary_table(results: Results, lines: list[Line], found: Deviations) -> Table:
    """A line per setting and method."""
    first = results.methods[0].name if results.methods else ""
    columns = (
        Column("boundary", "", "fixed: frames held at the surface cross field; aligned: one axis on the normal, twist "
                               "free; none: free"),
        Column("method", "", "what the frames were smoothed as, and how where methods differ in that; or the name "
                             "given to a field that was read"),
        Column("solved", "d", "problems (input and boundary) with a field for every seed"),
        Column("of", "d", "problems"),
        Column("E", ".6g", "Dirichlet energy of the final frames in sh4, on the only problem with a field; mean over "
                           "seeds", "energy"),
        Column("seeds %", ".3g", "standard deviation of E over the seeds of a problem, per cent of its mean; mean "
                                 "over problems", "energy"),
        Column("own", ".6g", "what the method itself minimised, for its last field; mean over seeds; compare with the "
                             "same method only", "energy"),
        Column("over lowest", ".4f", "to the lowest energy of all methods on the problem, geometric mean; problems "
                                     "without energy are left out", "energy"),
        Column("at most", ".4f", "the largest of these ratios", "energy"),
        Column("lowest on", "d", "problems on which no method has an energy lower by more than a hundredth of a per "
                                 "cent", "energy"),
        Column("edges", ",d", "singular edges, sum over the problems solved (means over seeds)", "singular"),
        Column("complex", ",d", "singular edges that no hex mesh has", "singular"),
        Column("non-meshable", ",d", "places of the singular graph that no hex mesh has (a necessary condition)",
            "singular"),
        Column(
        "mean", ".2f", "angle between the frames and those of the first method, mean over vertices and problems",
        f"deg to {first}"),
        Column("95 %", ".2f", "95th percentile over vertices, mean over problems", f"deg to {first}"),
        Column("sum", ".3g", "processor seconds of constraints, start and smoothing, on the problems solved; means "
                             "over seeds", "CPU seconds"),
        Column("over fastest", ".2f", "to the fastest method on the problem, geometric mean", "CPU seconds"),
    )  # fmt: skip
    rows = []
    for line in lines:
        angles = (
            (0.0, 0.0)
            if line.method == results.methods[0] and found.lines
            else found.lines.get((line.setting, line.method), (None, None))
        )
        rows.append((
            line.setting.name, line.method.name, line.solved, line.asked, line.energy,
            None if line.spread is None else 100 * line.spread, line.own, line.ratio, line.largest, line.lowest,
            line.singular_edges, line.complex_edges, line.non_meshable, *angles, line.seconds, line.slowdown,
        ))  # fmt: skip
    alone = ("over lowest", "at most", "lowest on", "mean", "95 %", "over fastest") if len(results.methods) < 2 else ()
    return Table("summary", columns, rows).without(*alone).without_empty("E", "seeds %", "own")


def failure_table(results: Results, runs: Sequence[Run]) -> Table:
    columns = [Column(head) for head in ("input", "method", "boundary", "state", "message")]
    rows = [
        [run.input, results.method(run).name, results.problem(run).setting.name, run.state, run.message] for run in runs
    ]
    return Table("failures", columns, rows)


def deviation_table(found: Deviations) -> Table:
    """Mean angles below the diagonal, 95th percentiles above."""
    columns = [Column("method"), *(Column(method.name, ".2f") for method in found.methods)]
    rows = []
    for i, method in enumerate(found.methods):
        values = [found.mean[i, j] if j < i else found.high[i, j] for j in range(len(found.methods))]
        rows.append([method.name, *(None if i == j or not (v == v) else float(v) for j, v in enumerate(values))])
    return Table("deviations", columns, rows)
