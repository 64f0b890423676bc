"""The runs of a report, by method and by problem.

A method is what a user would choose between: representation, solver, rounds and other options of smoothing. A problem is
what it is given: an input with its mesh, a treatment of the boundary (a setting) and a seed. Energies compare within a
problem only.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

OF_METHODS = ("representation", "solver", "rounds", "max_iterations", "tolerance", "start")
OF_SETTINGS = ("boundary", "sampling", "feature_tolerance")


@dataclass(eq=False)
class Run:
    """row: the record (result.json; `state` failed or crashed where there is no field). input: its name on the page. folder:
    of the run's files; link: the same relative to the page."""

    row: dict[str, Any]
    input: str
    folder: Path | None = None
    link: str = ""

    @property
    def options(self) -> dict[str, Any]:
        return self.row.get("options") or {}

    @property
    def choices(self) -> dict[str, Any]:
        """The options, and what is no option of FieldOptions: the start, and the name of a field that was read."""
        row = self.row
        return {**self.options, **{name: row[name] for name in ("representation", "boundary", "start") if name in row}}

    @property
    def state(self) -> str:
        return str(self.row.get("state", "done"))

    @property
    def done(self) -> bool:
        return self.state == "done"

    @property
    def computed(self) -> bool:
        """Has a field, and not one that was read from a file."""
        return self.done and "energy_history" in self.row

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
    """variant: what it is beside the representation, where methods differ in that ("lbfgs", "rounds 2"); empty for the default
    solver and where nothing else differs."""

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
    seed: int


@dataclass
class Results:
    """Runs in their order; methods, settings, problems and inputs in that of their first run."""

    runs: Sequence[Run]
    methods: list[Method] = field(init=False)
    settings: list[Setting] = field(init=False)
    problems: list[Problem] = field(init=False)
    inputs: list[str] = field(init=False)

    def __post_init__(self) -> None:
        names = (*OF_METHODS, *OF_SETTINGS)
        self._varying = {name for name in names if len({repr(run.choices.get(name)) for run in self.runs if name in run.choices}) > 1}
        self._of = {run: (self._method(run.choices), self._problem(run)) for run in self.runs}
        self.methods = list(dict.fromkeys(method for method, _ in self._of.values()))
        self.problems = list(dict.fromkeys(problem for _, problem in self._of.values()))
        self.settings = list(dict.fromkeys(problem.setting for problem in self.problems))
        self.inputs = list(dict.fromkeys(problem.input for problem in self.problems))
        self._fields: dict[tuple[Method, Problem], list[Run]] = {}
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
        return self._of[run][1]

    def rank(self, run: Run) -> tuple[int, ...]:
        """Order by input, setting, seed, method."""
        method, problem = self._of[run]
        return self.inputs.index(problem.input), self.settings.index(problem.setting), problem.seed, self.methods.index(method)

    def field(self, method: Method, problem: Problem) -> Run | None:
        """The run that ended with a field, the first of its repeats."""
        return next(iter(self._fields.get((method, problem), ())), None)

    def on(self, name: str) -> list[Run]:
        """Runs on an input."""
        return [run for run in self.runs if run.input == name]

    def first_on(self, name: str, setting: Setting) -> Problem | None:
        """The problem of the input and setting with the first seed that any method ended on."""
        of = [p for p in self.problems if p.input == name and p.setting == setting]
        return next((p for p in of if any(self.field(m, p) for m in self.methods)), None)

    def least(self, value: Callable[[dict[str, Any]], float], problems: Sequence[Problem]) -> dict[Method, np.ndarray]:
        """value(record) per method and problem, the least of the repeats; infinite without a field."""
        return {
            method: np.array([min((value(run.row) for run in self._fields.get((method, p), ())), default=math.inf) for p in problems], float)
            for method in self.methods
        }

    def _method(self, options: dict[str, Any]) -> Method:
        words = [_word(name, options.get(name)) for name in OF_METHODS[1:] if name in self._varying]
        return Method(str(options.get("representation", "unknown")), " ".join(filter(None, words)))

    def _problem(self, run: Run) -> Problem:
        options = run.choices
        words = [_word(name, options.get(name)) for name in OF_SETTINGS[1:] if name in self._varying]
        return Problem(run.input, Setting(str(options.get("boundary", "unknown")), ", ".join(words)), run.seed)


def _word(name: str, value: object) -> str:
    if name == "solver":
        return "" if value == "default" else str(value)
    if name == "start":
        return "" if value in (None, "default") else f"from {value}"
    if name == "sampling":
        return f"frames at {value}" if value == "vertices" else f"frames in {value}"
    if name == "feature_tolerance" and isinstance(value, (int, float)):
        return f"feature tolerance {math.degrees(value):.4g}\N{DEGREE SIGN}"
    return f"{name.replace('_', ' ')} {value:g}" if isinstance(value, (int, float)) else f"{name.replace('_', ' ')} {value}"
