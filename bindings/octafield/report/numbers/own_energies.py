"""Energies of the user's own (octafield.compare(energies=...)): methods ranked by each."""

import html

import numpy as np

from .profiles import geometric_mean
from .records import Results, Run
from .tables import Column, Table


def names_of(results: Results) -> list[str]:
    """In the order given."""
    return list(dict.fromkeys(name for run in results.runs if run.done for name in run.record.energies or ()))


def own_energy_table(results: Results) -> Table:
    """A line per boundary treatment and method, the lowest by the first energy first; no line without energies."""
    names = names_of(results)
    columns = [Column("boundary"), Column("method")]
    for name in names:
        columns += [
            Column("mean", ".6g", f"{html.escape(name)} of the final frames, mean over runs", name),
            Column(
                "over lowest", ".4f", "to the lowest of all methods on the problem, geometric mean over problems", name
            ),
        ]
    rows = []
    for setting in dict.fromkeys(results.problem(run).setting for run in results.runs):
        lines = []
        for method in results.methods:
            runs = [
                run
                for run in results.runs
                if run.done and results.method(run) == method and results.problem(run).setting == setting
            ]
            if not any(run.record.energies for run in runs):
                continue
            cells: list[object] = []
            for name in names:
                values = [_value(run, name) for run in runs]
                ratios = [_ratio(results, run, name) for run in runs]
                found = [ratio for ratio in ratios if ratio is not None]
                cells += [float(np.mean(values)), geometric_mean(np.array(found)) if found else None]
            lines.append([setting.name, method.name, *cells])
        rows += sorted(lines, key=lambda line: (line[3] is None, line[3] if line[3] is not None else line[2]))
    return Table("energies", columns, rows)


def _value(run: Run, name: str) -> float:
    return float((run.record.energies or {}).get(name, np.nan))


def _ratio(results: Results, run: Run, name: str) -> float | None:
    """Of the energy to the lowest of all methods on the same problem and seed; none where that is 0."""
    problem = results.problem(run)
    others = [
        _value(other, name)
        for other in results.runs
        if other.done and results.problem(other) == problem and other.seed == run.seed
    ]
    lowest = np.nanmin(others)
    return float(_value(run, name) / lowest) if lowest > 0 else None
