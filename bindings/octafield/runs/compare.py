"""Representations and boundary treatments side by side, on one mesh per input.

comparison = compare(["part.stl"], "out")   # out/report.html, results.json, results.csv, tables/, one folder per run
comparison.rows[0].energy
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from ..domain.meshing import Source, prepare_mesh, read_sound
from ..errors import InvalidInput
from ..fields.analysed import AnalysedField, analyse
from ..fields.frame_field import FieldProblem, FieldResult, prepare_field, run_field
from ..files.writing import staged_folder
from ..hexdom.options import MESHES, HexMeshOptions
from ..options import (
    BOUNDARIES,
    COMPARED,
    LARGEST_SEED,
    FieldOptions,
    integer_in,
    require_one_of,
    require_scheme,
)
from ..progress.phases import Progress, announce
from ..progress.several_runs import SeveralRuns
from ..records.record_file import write_record
from ..report import PAGE_FILE, Report, Run, write_report
from ..report.numbers.records import INDEPENDENT
from ..schemes import OwnScheme, name_of
from ..view.captions import counted
from ..view.notebook import Facts, ShownInNotebooks
from . import compared_meshes
from .fields_to_compare import FieldSource, GivenField, given_fields
from .own_energies import Energy, energies_of, named_energies
from .run_folder import write_analysis, write_field_result

if TYPE_CHECKING:
    from ..records.field import FieldRecord
    from ..view.picture import Picture

ROWS_FILE = "results.json"
STARTS = ("sh4", "independent")
_SHOWN = ("input", "representation", "boundary", "seed", "energy", "singular_edges", "singular_length", "complex_edges")
_MOST_CURVES = 3  # pictures of singular curves per boundary treatment


@dataclass
class _Section:
    """One input: its runs, and pictures: of the surface, then per boundary treatment. folder: of the comparison, with a
    folder per run. drawn: per boundary treatment, the singular graphs that have a picture. given: rows of the fields
    that were read, by name. energies: of the user's own, by name. cells: of the meshes along fields; None: none."""

    name: str
    slug: str
    folder: Path
    options: FieldOptions
    several_seeds: bool
    energies: dict[str, Energy]
    cells: HexMeshOptions | None = None
    rows: list[FieldRecord] = field(default_factory=list)
    pictures: dict[str, list[Picture]] = field(default_factory=dict)
    drawn: dict[str, set[tuple[str, ...]]] = field(default_factory=dict)
    given: dict[str, FieldRecord] = field(default_factory=dict)

    def new_folder(self, run: str) -> str:
        """Makes it; its name."""
        name = _unique([path.name for path in self.folder.iterdir()], f"{self.slug}-{_quoted(run)}")
        (self.folder / name).mkdir()
        return name


@dataclass(repr=False)
class Comparison(ShownInNotebooks):
    """rows: one record per run, in the order of the report. folder: where everything was written."""

    rows: list[FieldRecord]
    folder: Path

    def __repr__(self) -> str:
        """inputs, how many runs of what, the range of energies, and where."""
        energies = [row.energy for row in self.rows]

        def count(name: str, plural: str = "") -> str:
            return counted(len({row[name] for row in self.rows if name in row}), name, plural)

        spread = f"; E {min(energies):.6g} to {max(energies):.6g}" if energies else ""
        return (
            f"Comparison({counted(len(self.rows), 'run')}: {count('input')}, {count('representation')},"
            f" {count('boundary', 'boundaries')}{spread}; {self.folder})"
        )

    def _facts(self) -> Facts:
        """For notebooks: a line per run."""
        return f"Comparison in {self.folder}", [
            {name: row[name] for name in _SHOWN if name in row} for row in self.rows
        ]

    def to_html(self) -> str:
        """The report, a self-contained page."""
        return (self.folder / PAGE_FILE).read_text(encoding="utf-8")


def default_input() -> str:
    """The nut inside the pyvista package: closed, genus 1."""
    from pyvista import examples

    return str(examples.nutfile)


def compare(
    inputs: Sequence[Source] | Source,
    output: str | Path,
    *,
    representations: Sequence[str | OwnScheme] = COMPARED,
    boundaries: Sequence[str] = ("fixed", "aligned"),
    seeds: int = 1,
    starts: Sequence[str] = STARTS[:1],
    options: FieldOptions = FieldOptions(),
    fields: Mapping[str, FieldSource] = MappingProxyType({}),
    energies: Sequence[Energy] = (),
    mesh: str = MESHES[0],
    hex_options: HexMeshOptions | None = None,
    progress: Progress | None = None,
) -> Comparison:
    """Every representation with every boundary treatment and `seeds` seeds (options.seed and following) on each input.

    representations: keys of octafield.volume.schemes, an EmbeddingScheme or EdgeScheme, or "FILE.py:NAME" of one.

    starts: "sh4" (from the minimum of sh4's energy, options.rounds of it) or "independent" (no step in sh4: each
        minimises its own objective from one linear solve, or for seeds other than 0 from a random field; rounds 0), or
        both, a row each.

    Each input is read and meshed once. `options` gives everything else. fields: by name, files of frames (read_frames)
    or (n, 4) arrays on the vertices (sampling "tets": the tets) of the only input, a tet mesh; each stands beside the
    others as it is and as the first representation makes it by one smoothing. The output
    folder is complete or absent; an earlier comparison in it is replaced, a folder with anything else is refused
    (InvalidInput).

    energies: of one's own, by which all fields are judged, too: schemes, functions of a FieldResult that give a number,
    or "FILE.py:NAME" of either. Records have them in `energies`, the report a table with methods ranked by the first.

    mesh: "hex-dominant" makes a mesh along every field (mesh.vtu in the run's folder), with hex_options, whose edge
    length holds for all fields on an input. Records have its figures, or why there is none, in `mesh`; the report ranks
    methods by what hexahedra are of the volume, then of the cells.

        >>> import octafield
        >>> from octafield.domain.generators import generate
        >>> options = octafield.FieldOptions(edge_length=0.4)
        >>> found = octafield.compare(generate("box"), "out", representations=["sh4"], options=options)
        >>> [(row.boundary, row.singular_edges) for row in found.rows]
        [('fixed', 0), ('aligned', 0)]
    """
    inputs = [inputs] if isinstance(inputs, Source) else list(inputs)
    _check(inputs, representations, boundaries, starts)
    if options.axes == "free":
        raise InvalidInput("fields are compared with axes at right angles; take axes 'orthogonal'", "stretched_axes")
    judges, cells = named_energies(energies), compared_meshes.mesh_options(mesh, hex_options)
    seeds = integer_in("seeds", seeds, 1, LARGEST_SEED - options.seed + 1)
    with staged_folder(output, ROWS_FILE) as folder:
        rows: list[FieldRecord] = []
        sections: list[_Section] = []
        # All are read before the first run: an unfit one should not cost the time of those before it.
        reports = [_labelled(progress, _short_name(source)) for source in inputs]
        sound = [read_sound(source, options, progress=report) for source, report in zip(inputs, reports, strict=True)]
        given = given_fields(sound, fields, options)
        steps = _steps(representations, boundaries, starts, given)
        whole = SeveralRuns(progress, len(inputs) * seeds * len(steps))
        for number, source in enumerate(inputs):
            name = _unique([s.name for s in sections], _short_name(source), " ")
            section = _Section(
                name, _unique([s.slug for s in sections], _slug(source)), folder, options, seeds > 1, judges
            )
            meshed = prepare_mesh(sound[number], options, progress=whole.labelled(name))
            section.cells = compared_meshes.of_one_length(cells, meshed.volume()) if cells else None
            meshed.notes += [note for one in given for note in one.notes]
            for seed in range(options.seed, options.seed + seeds):
                problem = prepare_field(meshed, seed, whole.labelled(name))
                _run_all(problem, section, steps, whole)
                _add_given(problem, section, boundaries, given)
            for boundary, picture in compared_meshes.pictures(section.rows, folder):
                section.pictures.setdefault(boundary, []).append(picture)
            sections.append(section)
            rows += section.rows
        announce(progress, "report")
        files = [*(rows[0].files or ()), *write_report(_report(sections, folder), folder)]
        rows[0] = rows[0].changed(files=files)
        write_record(folder / ROWS_FILE, rows)
    return Comparison(rows, Path(output).resolve())


@dataclass(frozen=True)
class _Step:
    """A field to compute. start: the given field it is smoothed from. independent: without rounds in sh4 before."""

    representation: str | OwnScheme
    boundary: str
    start: GivenField | None = None
    independent: bool = False

    @property
    def scheme(self) -> str:
        return name_of(self.representation)

    @property
    def method(self) -> str:
        if self.start is not None:
            return f"{self.scheme} from {self.start.name}"
        return f"{self.scheme} {INDEPENDENT}" if self.independent else self.scheme

    def options(self, common: FieldOptions, seed: int) -> FieldOptions:
        rounds = 0 if self.independent else common.rounds
        return replace(common, representation=self.representation, boundary=self.boundary, rounds=rounds, seed=seed)


def _steps(
    representations: Sequence[str | OwnScheme],
    boundaries: Sequence[str],
    starts: Sequence[str],
    given: Sequence[GivenField],
) -> list[_Step]:
    methods: list[tuple[str | OwnScheme, GivenField | None, bool]] = [
        (name, None, start == STARTS[1]) for start in starts for name in representations
    ]
    methods += [(representations[0], one, False) for one in given]
    return [
        _Step(name, boundary, start, independent) for name, start, independent in methods for boundary in boundaries
    ]


def _run_all(problem: FieldProblem, section: _Section, steps: Sequence[_Step], whole: SeveralRuns) -> None:
    first = problem.seed == section.options.seed
    if first:
        section.pictures["surface"] = _surface_pictures(problem)
    for step in steps:
        label = f"{step.method}, {step.boundary}" + (f", seed {problem.seed}" if section.several_seeds else "")
        report = whole.labelled(f"{section.name}, {label}")
        result = run_field(
            problem,
            step.options(section.options, problem.seed),
            report,
            start=None if step.start is None else step.start.frames,
        )
        start = result.record.start if step.start is None else step.start.name
        result.record = result.record.changed(label=label, start=start)
        _judge(result, section)
        name = section.new_folder(
            f"{step.method}-{step.boundary}" + (f"-seed{problem.seed}" if section.several_seeds else "")
        )
        compared_meshes.add_mesh(result, section.cells, section.folder / name, report)
        write_field_result(result, section.folder / name, report)
        section.rows.append(_row(result.record, name))
        if first:
            section.pictures.setdefault(step.boundary, []).extend(_volume_pictures(section, result, label))
        whole.finished()


def _judge(result: AnalysedField, section: _Section) -> None:
    if section.energies:
        found = energies_of(result, section.energies, section.options.threads)
        result.record = result.record.changed(energies=found)


def _add_given(
    problem: FieldProblem, section: _Section, boundaries: Sequence[str], given: Sequence[GivenField]
) -> None:
    """A row per boundary treatment and seed, all of one analysis."""
    from ..records.field import GivenFieldRecord

    for one in given:
        if one.name not in section.given:
            result = analyse(problem.meshed, one.frames, section.options.sampling, section.options)
            result.record = GivenFieldRecord(**result.record).changed(label=one.name, representation=one.name)
            _judge(result, section)
            name = section.new_folder(one.name)
            compared_meshes.add_mesh(result, section.cells, section.folder / name)
            write_analysis(result, section.folder / name)
            section.given[one.name] = _row(result.record, name)
            section.pictures.setdefault("given", []).extend(_pictures_of_given(one.name, result))
        row = section.given[one.name]
        chosen = [{**row.options, "boundary": boundary, "seed": problem.seed} for boundary in boundaries]
        section.rows += [row.changed(boundary=options["boundary"], options=options) for options in chosen]


def _row(record: FieldRecord, folder: str) -> FieldRecord:
    return record.changed(folder=folder, files=[f"{folder}/{file}" for file in record.files or ()])


def _report(sections: list[_Section], folder: Path) -> Report:
    runs = [
        Run(row, section.name, folder / str(row.folder), str(row.folder))
        for section in sections
        for row in section.rows
    ]
    names = ", ".join(section.name for section in sections[:3]) + (
        f" and {len(sections) - 3} more" if len(sections) > 3 else ""
    )
    pictures = {section.name: sum(section.pictures.values(), []) for section in sections}
    return Report(f"Frame fields on {names}", runs, pictures, files=(ROWS_FILE,))


def _surface_pictures(problem: FieldProblem) -> list[Picture]:
    from ..view import scene
    from . import field_pictures as pictures  # brings VTK, which nothing else in the package needs when it is imported

    if not scene.can_draw():
        problem.meshed.notes.append(f"no pictures: {scene.NO_OPENGL}")
        return []
    return [pictures.surface_cross_field(problem)]


def _volume_pictures(section: _Section, result: FieldResult, label: str) -> list[Picture]:
    """Of the first method with a boundary treatment: singular curves, frames on a cut, and streamlines once per input,
    since they differ little. Of another: singular curves where they differ in kind."""
    from ..view import scene
    from . import field_pictures as pictures

    if not scene.can_draw():
        return []
    record = result.record
    begun, first = not section.drawn, record.boundary not in section.drawn
    drawn = section.drawn.setdefault(str(record.boundary), set())
    counts = record.singular_curves, record.singular_nodes, record.singular_boundary_ends
    kind = tuple(map(str, (record.singular_edges_by_turns, *counts)))
    chosen = []
    if record.singular_edges and kind not in drawn and len(drawn) < _MOST_CURVES:
        chosen.append(pictures.singular_curves(result))
        drawn.add(kind)
    if first:
        chosen.append(pictures.frames_on_cut(result))
    if begun and result.streamlines:
        chosen.append(pictures.streamlines(result))
    return [replace(picture, title=f"{picture.title} ({label})") for picture in chosen]


def _pictures_of_given(name: str, result: AnalysedField) -> list[Picture]:
    from ..view import scene
    from . import field_pictures as pictures

    if not scene.can_draw() or not result.record.singular_edges:
        return []
    picture = pictures.singular_curves(result)
    return [replace(picture, title=f"{picture.title} ({name})")]


def _check(
    inputs: Sequence[Source],
    representations: Sequence[str | OwnScheme],
    boundaries: Sequence[str],
    starts: Sequence[str],
) -> None:
    if not inputs or not representations or not boundaries or not starts:
        raise InvalidInput(
            "a comparison needs at least one input, representation, boundary treatment and start", "nothing_to_compare"
        )
    for start in starts:
        require_one_of("start", start, STARTS)
    for representation in representations:
        require_scheme(representation)
    for boundary in boundaries:
        require_one_of("boundary", boundary, BOUNDARIES)
    for what, values in (
        ("representations", [name_of(r) for r in representations]),
        ("boundaries", boundaries),
        ("starts", starts),
    ):
        twice = next((value for k, value in enumerate(values) if value in values[:k]), None)
        if twice is not None:
            raise InvalidInput(
                f"{what}: {twice!r} is there twice; leave one out, or give schemes of one's own different names",
                "repeated_value",
            )


def _labelled(progress: Progress | None, label: str) -> Progress | None:
    return progress and (lambda phase, fraction, merit: progress(f"{label}: {phase}", fraction, merit))


def _short_name(source: Source) -> str:
    return Path(source).name if isinstance(source, (str, Path)) else "mesh in memory"


def _slug(source: Source) -> str:
    """A folder name from an input's: the stem, letters that need no quoting."""
    return _quoted(_short_name(source).removesuffix(".gz").rsplit(".", 1)[0])


def _quoted(stem: str) -> str:
    return "".join(c if c.isalnum() or c in "-_." else "_" for c in stem).lstrip(".") or "input"


def _unique(taken: list[str], name: str, between: str = "-") -> str:
    number, candidate = 2, name
    while candidate in taken:
        number, candidate = number + 1, f"{name}{between}{number}"
    return candidate
