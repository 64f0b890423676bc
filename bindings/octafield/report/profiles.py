"""Ratios to the best of each problem, performance profiles of them, and a line of figures per method and setting."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .records import Method, Problem, Results, Setting

EQUAL = 1e-4  # relative: energies closer than this are not ranked

Values = Sequence[float] | np.ndarray  # one per problem


@dataclass(frozen=True)
class Profile:
    """Of one method: share[k] of `problems` problems on which it needs at most ratio[k] times what the best method needs."""

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
    """Each value over the least of its problem; problems that no method solves, or with a least value of 0, are left out."""
    table = np.array([list(v) for v in values.values()], float)
    best = table.min(axis=0, initial=np.inf)
    counted = np.isfinite(best) & (best > 0)
    return dict(zip(values, table[:, counted] / best[counted], strict=True))


def energies(results: Results, problems: Sequence[Problem]) -> dict[Method, np.ndarray]:
    """Of each method on each problem; 0 where it is rounding, as of fields without singularities in a straight solid."""
    return results.least(_energy, problems)


def smoothing_seconds(results: Results, problems: Sequence[Problem]) -> dict[Method, np.ndarray]:
    """Processor seconds of constraints, start and smoothing; infinite for fields that were read."""
    return results.least(lambda row: row["cpu_seconds"]["smooth"] if "energy_history" in row else math.inf, problems)


def _energy(row: dict[str, Any]) -> float:
    """Rounding is measured by that of frames, squared, and the size of the shape."""
    size = row["edge_length"] * math.sqrt(row["boundary_triangles"])
    energy = row["energy"]
    return 0.0 if energy <= 1e-9 * size else float(energy)


@dataclass(frozen=True)
class Line:
    """Of one method in one setting. asked: problems in the setting; problems: those of them with a field of any method, which
    all else is about; solved: with a field of this one. complete: that is on all of them. energy: where there is one problem.
    zero: problems whose lowest energy is rounding. ratio, largest: energy over the lowest of each problem, geometric mean and largest;
    lowest: problems on which no method is lower by more than EQUAL. Counts of the singular graphs are sums over problems,
    None where they are not defined. seconds: sum over problems; slowdown: over the fastest of each, geometric mean."""

    setting: Setting
    method: Method
    asked: int
    problems: int
    solved: int
    complete: bool
    energy: float | None
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
    energy: np.ndarray, best: np.ndarray, over: tuple[dict[Method, np.ndarray], dict[Method, np.ndarray]], seconds: np.ndarray,
) -> Line:  # fmt: skip
    fields = [run.row for run in (results.field(method, p) for p in within) if run is not None]
    problems = sum(any(results.field(m, p) for m in results.methods) for p in within)
    ratio, slowdown = (part[method][np.isfinite(part[method])] for part in over)
    return Line(
        setting,
        method,
        asked=len(within),
        problems=problems,
        solved=len(fields),
        complete=0 < len(fields) == problems,
        energy=fields[0]["energy"] if problems == 1 and fields else None,
        zero=int(np.sum(best == 0)),
        ratio=geometric_mean(ratio),
        largest=float(ratio.max()) if len(ratio) else None,
        lowest=int(np.sum(np.isfinite(energy) & (energy <= best * (1 + EQUAL)))),
        singular_edges=_total(fields, "singular_edges"),
        complex_edges=_total(fields, "complex_edges"),
        non_meshable=_total(fields, "non_meshable_vertices"),
        seconds=float(seconds[np.isfinite(seconds)].sum()) if np.isfinite(seconds).any() else None,
        slowdown=geometric_mean(slowdown),
    )


def _total(fields: list[dict[str, Any]], key: str) -> int | None:
    values = [row[key] for row in fields if row.get(key) is not None]
    return sum(values) if values and len(values) == len(fields) else None


def geometric_mean(values: np.ndarray) -> float | None:
    return float(np.exp(np.mean(np.log(values)))) if len(values) else None
