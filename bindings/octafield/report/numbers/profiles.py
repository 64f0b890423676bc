"""Ratios to the best of each problem, performance profiles of them, and a line of figures per method and setting."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .records import Method, Problem, Results, Setting

if TYPE_CHECKING:
    from ...records.field import FieldRecord

EQUAL = 1e-4  # relative: energies closer than this are not ranked

Values = Sequence[float] | np.ndarray  # one per problem


@dataclass(frozen=True)
class Profile:
    """Of one method: share[k] of `problems` problems on which it needs at most ratio[k] times what the best method
    needs."""

    ratio: np.ndarray
    share: np.ndarray
    problems: int

    def at(self, ratio: float) -> float:
        """Share of the problems on which it needs at most `ratio` times the best."""
        return float(self.share[np.searchsorted(self.ratio, ratio, side="right") - 1])


def performance_profiles(values: Mapping[Method, Values]) -> dict[Method, Profile]:
    """Performance profiles (Dolan, More 2002). values: per method one positive number per problem, in the same order;
    infinite: not solved. Problems that no method solves are left out; so are those whose best value is 0."""
    result = {}
    for name, own in ratios_to_best(values).items():
        steps = np.sort(own[np.isfinite(own)])
        shares = np.arange(1, len(steps) + 1) / max(len(own), 1)
        result[name] = Profile(np.r_[1.0, steps], np.r_[np.sum(own == 1) / max(len(own), 1), shares], len(own))
    return result


def ratios_to_best(values: Mapping[Method, Values]) -> dict[Method, np.ndarray]:
    """Each value over the least of its problem; problems that no method solves, or with a least value of 0, are left
    out."""
    table = np.array([list(v) for v in values.values()], float)
    best = table.min(axis=0, initial=np.inf)
    counted = np.isfinite(best) & (best > 0)
    return dict(zip(values, table[:, counted] / best[counted], strict=True))


def energies(results: Results, problems: Sequence[Problem]) -> dict[Method, np.ndarray]:
    """Of each method on each problem; 0 where it is rounding, as of fields without singularities in a straight
    solid."""
    return results.least(_energy, problems)


def smoothing_seconds(results: Results, problems: Sequence[Problem]) -> dict[Method, np.ndarray]:
    """Processor seconds of constraints, start and smoothing; infinite for fields that were read."""
    return results.least(lambda record: record.cpu_seconds.smooth if record.computed else math.inf, problems)


def _energy(record: FieldRecord) -> float:
    """Rounding is measured by that of frames, squared, and the size of the shape."""
    size = record.edge_length * math.sqrt(record.boundary_triangles)
    return 0.0 if record.energy <= 1e-9 * size else record.energy


@dataclass(frozen=True)
class Line:
    """Of one method in one setting. asked: problems in the setting; problems: those of them with a field of any method,
    which all else is about; solved: with fields of this one, for each seed that any method has a field for. complete:
    that is on all of them. energy, own (what the method minimised): where there is one problem, mean over seeds.
    spread: standard deviation of the energies of a problem's seeds over their mean, mean over the problems with
    several.
    zero: problems whose lowest energy is rounding. ratio, largest: energy over the lowest of each problem, geometric
        mean and largest;
    lowest: problems on which no method is lower by more than EQUAL. Counts of the singular graphs are sums over
        problems of the means over seeds, None where they are not defined. seconds: sum over problems; slowdown: over
        the fastest of each, geometric mean."""

    setting: Setting
    method: Method
    asked: int
    problems: int
    solved: int
    complete: bool
    energy: float | None
    own: float | None
    spread: float | None
    zero: int
    ratio: float | None
    largest: float | None
    lowest: int
    singular_edges: int | None
    complex_edges: int | None
    non_meshable: int | None
    seconds: float | None
    slowdown: float | None


def lines(results: Results, problems: Sequence[Problem] | None = None) -> list[Line]:
    """One per setting and method that was run in it, on `problems` (all)."""
    problems = results.problems if problems is None else problems
    found = []
    for setting in dict.fromkeys(p.setting for p in problems):
        within = [p for p in problems if p.setting == setting]
        energy, seconds = energies(results, within), smoothing_seconds(results, within)
        over = ratios_to_best(energy), ratios_to_best(seconds)
        best = np.min(list(energy.values()), axis=0)
        wanted = set(within)
        inside = {results.method(run) for run in results.runs if results.problem(run) in wanted}
        for method in (method for method in results.methods if method in inside):
            found.append(_line(results, setting, method, within, energy[method], best, over, seconds[method]))
    return found


def _line(
    results: Results, setting: Setting, method: Method, within: list[Problem],
    energy: np.ndarray, best: np.ndarray, over: tuple[dict[Method, np.ndarray], dict[Method, np.ndarray]],
    seconds: np.ndarray,
) -> Line:  # fmt: skip
    cases = {p: results.cases_of(p) for p in within}
    records = {
        p: [run.record for case in of if (run := results.field(method, case)) is not None]
        for p, of in cases.items()
        if of
    }
    fields = [records[p] for p in records if len(records[p]) == len(cases[p])]
    alone = fields[0] if len(records) == 1 and fields else []
    ratio, slowdown = (part[method][np.isfinite(part[method])] for part in over)
    return Line(
        setting,
        method,
        asked=len(within),
        problems=len(records),
        solved=len(fields),
        complete=0 < len(fields) == len(records),
        energy=_mean(alone, lambda record: record.energy),
        own=_mean(alone, lambda record: record.objective),
        spread=_spread(fields),
        zero=int(np.sum(best == 0)),
        ratio=geometric_mean(ratio),
        largest=float(ratio.max()) if len(ratio) else None,
        lowest=int(np.sum(np.isfinite(energy) & (energy <= best * (1 + EQUAL)))),
        singular_edges=_total(fields, lambda record: record.singular_edges),
        complex_edges=_total(fields, lambda record: record.complex_edges),
        non_meshable=_total(fields, lambda record: record.non_meshable_vertices),
        seconds=float(seconds[np.isfinite(seconds)].sum()) if np.isfinite(seconds).any() else None,
        slowdown=geometric_mean(slowdown),
    )


def _mean(records: list[FieldRecord], value: Callable[[FieldRecord], float | None]) -> float | None:
    """None where a record is without it."""
    values = [value(record) for record in records]
    known = [value for value in values if value is not None]
    return float(sum(known) / len(known)) if known and len(known) == len(values) else None


def _total(fields: list[list[FieldRecord]], value: Callable[[FieldRecord], int | None]) -> int | None:
    """fields: per problem the records of its seeds."""
    means = [_mean(records, value) for records in fields]
    known = [mean for mean in means if mean is not None]
    return round(sum(known)) if known and len(known) == len(means) else None


def _spread(fields: list[list[FieldRecord]]) -> float | None:
    parts = [np.array([record.energy for record in records]) for records in fields if len(records) > 1]
    return (
        float(np.mean([part.std(ddof=1) / part.mean() if part.mean() > 0 else 0.0 for part in parts]))
        if parts
        else None
    )


def geometric_mean(values: np.ndarray) -> float | None:
    return float(np.exp(np.mean(np.log(values)))) if len(values) else None
