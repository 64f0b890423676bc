"""Tables and numbers of the flagship study from the records of its runs."""

from collections.abc import Iterable

import numpy as np
import pandas
from octafield.options import COMPARED
from octafield.records.field import RunWithField, RunWithoutField

NO_ENERGY = 1e-9  # below it a field is constant but for rounding
START = {2: "recipe", 0: "linear start"}
COUNTS = ("singular edges", "complex edges", "non-meshable vertices")


def frame_of(rows: Iterable[RunWithField | RunWithoutField]) -> pandas.DataFrame:
    """One line per finished run. over best: energy over the lowest on the same input with the same boundary mode, any
    method; nan where the field is constant."""
    table = pandas.DataFrame(
        {
            "input": r.input,
            "tets": r.tets,
            "representation": r.options["representation"],
            "solver": r.options["solver"],
            "start": START[r.options["rounds"]],
            "boundary": r.options["boundary"],
            "energy": r.energy,
            "singular edges": r.singular_edges,
            "complex edges": r.complex_edges,
            "non-meshable vertices": r.non_meshable_vertices,
            "converged": r.converged,
            "CPU s": r.cpu_seconds.smooth,
        }
        for r in rows
        if r.state == "done"
    )
    best = table.groupby(["input", "boundary"])["energy"].transform("min")
    table["over best"] = (table["energy"] / best).where(best > NO_ENERGY)
    return table


def geometric_mean(values: pandas.Series) -> float:
    return float(np.exp(np.log(values.dropna()).mean()))


def by_method(table: pandas.DataFrame, keys: list[str]) -> pandas.DataFrame:
    """Geometric mean of `over best`, sums of counts and seconds, per combination of the keys; seconds also over those
    of the first line."""
    groups = table.groupby(keys, sort=False)
    result = groups.agg(
        {
            "input": "size",
            "over best": geometric_mean,
            **dict.fromkeys(COUNTS, "sum"),
            "converged": "mean",
            "CPU s": "sum",
        }
    )
    return result.rename(columns={"input": "fields"})


def markdown(table: pandas.DataFrame) -> str:
    """With the keys as first columns."""
    form = {"over best": "{:.4f}", "converged": "{:.0%}", "CPU s": "{:.1f}"}
    flat = table.reset_index()
    lines = [list(flat.columns), ["---"] * len(flat.columns)]
    lines += [
        ["\N{EN DASH}" if v != v else form.get(c, "{}").format(v) for c, v in zip(flat.columns, row, strict=True)]
        for row in flat.itertuples(index=False)
    ]
    return "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines).rstrip()


def energy_ratio(table: pandas.DataFrame, one: dict, other: dict) -> float:
    """Geometric mean over inputs of the energy of the runs that match `one` over that of those that match `other`."""

    def energies(which: dict) -> pandas.Series:
        found = table[np.logical_and.reduce([table[key] == value for key, value in which.items()])]
        return found.set_index("input")["energy"]

    ratio = energies(one) / energies(other)
    return geometric_mean(ratio[(energies(other) > NO_ENERGY) & (energies(one) > NO_ENERGY)])


def time_ratio(table: pandas.DataFrame, one: dict, other: dict) -> float:
    def seconds(which: dict) -> float:
        return table[np.logical_and.reduce([table[key] == value for key, value in which.items()])]["CPU s"].sum()

    return seconds(one) / seconds(other)


def representations(table: pandas.DataFrame) -> list[str]:
    return [name for name in COMPARED if name in set(table["representation"])]
