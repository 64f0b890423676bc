"""The runs of a report, by method and by problem.

A method is what a user would choose between: representation, solver, rounds and other options of smoothing. A problem
is what it is given: an input with its mesh and a treatment of the boundary (a setting). Energies compare within a
problem only. A case is a problem with a seed: seeds are no problems of their own, figures of a problem are means over
its seeds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

if TYPE_CHECKING:
    from ...records.field import FieldRecord, RunWithoutField

OF_METHODS = ("representation", "solver", "rounds", "max_iterations", "tolerance", "start")
INDEPENDENT = "independent start"  # rounds 0: no step in sh4 before the method's own
OF_SETTINGS = ("boundary", "sampling", "feature_tolerance")


@dataclass(eq=False)
class Run:
    """row: the record of a field, or of a run without (octafield.read_record). input: its name on the page. folder: of
    the run's files; link: the same relative to the page."""

    row: FieldRecord | RunWithoutField
    input: str
    folder: Path | None = None
    link: str = ""

    @property
    def record(self) -> FieldRecord:
        """Of the field. Raises ValueError where there is none."""
        if not self.done:
            raise ValueError(f"{self.input}: the run {self.state}")
        return cast("FieldRecord", self.row)

    @property
    def options(self) -> dict[str, Any]:
        return self.row.options

    @property
    def choices(self) -> dict[str, Any]:
        """The options, and what is no option of FieldOptions: the start, and the name of a field that was read."""
        row = self.row
        return {**self.options, **{name: row[name] for name in ("representation", "boundary", "start") if name in row}}

    @property
    def state(self) -> str:
        return str(self.row.get("state", "done"))  # a comparison has runs with a field only, and no states

    @property
    def done(self) -> bool:
        return self.state == "done"

    @property
    def computed(self) -> bool:
        """Has a field, and not one that was read from a file."""
        return self.done and self.record.computed

    @property
    def message(self) -> str:
        """What went wrong where there is no field."""
        return str(self.row.get("message", ""))

    @property
    def seed(self) -> int:
        return int(self.options.get("seed", 0))

    @property
    def repeat(self) -> int:
        return int(self.row.get("repeat", 0))

    def file(self, name: str) -> Path | None:
        """A file of the run; None where it was not kept."""
        path = None if self.folder is None else self.folder / name
        return path if path is not None and path.is_file() else None


@dataclass(frozen=True)
class Method:
    """variant: what it is beside the representation, where methods differ in that ("lbfgs", "rounds 2"); empty for the
    default solver and where nothing else differs."""

    representation: str
    variant: str = ""

    @property
    def name(self) -> str:
        return f"{self.representation} {self.variant}" if self.variant else self.representation


@dataclass(frozen=True)
class Setting:
    """A treatment of the boundary. more: what it is beside `boundary`, where settings differ in that."""

    boundary: str
    more: str = ""

    @property
    def name(self) -> str:
        return f"{self.boundary}, {self.more}" if self.more else self.boundary


@dataclass(frozen=True)
class Problem:
    input: str
    setting: Setting


@dataclass(frozen=True)
class Case:
    problem: Problem
    seed: int

    @property
    def input(self) -> str:
        return self.problem.input

    @property
    def setting(self) -> Setting:
        return self.problem.setting


@dataclass
class Results:
    """Runs in their order; methods, settings, problems, their cases and inputs in that of their first run."""

    runs: Sequence[Run]
    methods: list[Method] = field(init=False)
    settings: list[Setting] = field(init=False)
    problems: list[Problem] = field(init=False)
    cases: list[Case] = field(init=False)
    inputs: list[str] = field(init=False)

    def __post_init__(self) -> None:
        names = (*OF_METHODS, *OF_SETTINGS)
        self._varying = {
            name for name in names if len({repr(run.choices.get(name)) for run in self.runs if name in run.choices}) > 1
        }
        self._rounds = {run.choices["rounds"] for run in self.runs if "rounds" in run.choices}
        self._of = {run: (self._method(run.choices), self._case(run)) for run in self.runs}
        self.methods = list(dict.fromkeys(method for method, _ in self._of.values()))
        self.cases = list(dict.fromkeys(case for _, case in self._of.values()))
        self.problems = list(dict.fromkeys(case.problem for case in self.cases))
        self.settings = list(dict.fromkeys(problem.setting for problem in self.problems))
        self.inputs = list(dict.fromkeys(problem.input for problem in self.problems))
        self._fields: dict[tuple[Method, Case], list[Run]] = {}
        for run in self.runs:
            if run.done:
                self._fields.setdefault(self._of[run], []).append(run)

    def read(self) -> list[Method]:
        """Fields that were read from files."""
        found = {self.method(run) for run in self.runs if run.done and not run.computed}
        return [method for method in self.methods if method in found]

    def method(self, run: Run) -> Method:
        return self._of[run][0]

    def problem(self, run: Run) -> Problem:
        return self._of[run][1].problem

    def cases_of(self, problem: Problem) -> list[Case]:
        """Those of its seeds on which any method ended with a field."""
        return [
            case
            for case in self.cases
            if case.problem == problem and any((m, case) in self._fields for m in self.methods)
        ]

    def rank(self, run: Run) -> tuple[int, ...]:
        """Order by input, setting, seed, method."""
        method, case = self._of[run]
        return self.inputs.index(case.input), self.settings.index(case.setting), case.seed, self.methods.index(method)

    def field(self, method: Method, case: Case) -> Run | None:
        """The run that ended with a field, the first of its repeats."""
        return next(iter(self._fields.get((method, case), ())), None)

    def on(self, name: str) -> list[Run]:
        """Runs on an input."""
        return [run for run in self.runs if run.input == name]

    def first_on(self, name: str, setting: Setting) -> Case | None:
        """The input and setting with the first seed that any method ended on."""
        return next(iter(self.cases_of(Problem(name, setting))), None)

    def least(self, value: Callable[[FieldRecord], float], problems: Sequence[Problem]) -> dict[Method, np.ndarray]:
        """value(record) per method and problem: the mean over seeds of the least of the repeats; infinite where a seed
        is without a field that another method has."""

        def of(method: Method, problem: Problem) -> float:
            seeds = [
                min((value(run.record) for run in self._fields.get((method, case), ())), default=math.inf)
                for case in self.cases_of(problem)
            ]
            return sum(seeds) / len(seeds) if seeds else math.inf

        return {method: np.array([of(method, problem) for problem in problems], float) for method in self.methods}

    def _method(self, options: dict[str, Any]) -> Method:
        told = self._varying - (
            {"rounds"} if options.get("rounds") and len(self._rounds - {0}) == 1 else set()
        )  # those with rounds need no word
        words = [_word(name, options.get(name)) for name in OF_METHODS[1:] if name in told]
        return Method(str(options.get("representation", "unknown")), " ".join(filter(None, words)))

    def _case(self, run: Run) -> Case:
        options = run.choices
        words = [_word(name, options.get(name)) for name in OF_SETTINGS[1:] if name in self._varying]
        return Case(Problem(run.input, Setting(str(options.get("boundary", "unknown")), ", ".join(words))), run.seed)


def _word(name: str, value: object) -> str:
    if name == "solver":
        return "" if value == "default" else str(value)
    if name == "rounds" and value == 0:
        return INDEPENDENT
    if name == "start":
        return "" if value in (None, "default") else f"from {value}"
    if name == "sampling":
        return f"frames at {value}" if value == "vertices" else f"frames in {value}"
    if name == "feature_tolerance" and isinstance(value, (int, float)):
        return f"feature tolerance {math.degrees(value):.4g}\N{DEGREE SIGN}"
    return (
        f"{name.replace('_', ' ')} {value:g}"
        if isinstance(value, (int, float))
        else f"{name.replace('_', ' ')} {value}"
    )
