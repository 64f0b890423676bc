"""The page of the flagship study: its text, filled with numbers of the runs, after testing what its words claim."""

from pathlib import Path

import pandas

from . import numbers
from .numbers import by_method, energy_ratio, markdown, time_ratio

TEXT = Path(__file__).parent / "texts" / "flagship.md"
FREE = ["sh4", "tensor4", "odeco"]  # one energy, but for a factor
METRICS = ["geodesic", "su2_midpoint"]


def page(generators: list[dict], hexme: list[dict], *, made: str) -> str:
    """Raises RuntimeError where the runs contradict a sentence."""
    bodies, parts = numbers.frame_of(generators), numbers.frame_of(hexme)
    fill = {
        "made": made,
        "generated_fields": len(bodies),
        "bodies": bodies["input"].nunique(),
        "hexme_fields": len(parts),
        "parts": parts["input"].nunique(),
    }
    fill |= _representations(parts) | _starts(parts) | _solvers(bodies) | _boundaries(bodies, parts)
    return TEXT.read_text(encoding="utf-8").format(**fill)


def require(holds: bool, sentence: str) -> None:
    if not holds:
        raise RuntimeError(f"the runs contradict the text, which says: {sentence}")


def percent(ratio: float) -> str:
    return f"{100 * (ratio - 1):.2g} %"


def _of(table: pandas.DataFrame, **which) -> pandas.DataFrame:
    for key, value in which.items():
        table = table[table[key].isin(value if isinstance(value, list) else [value])]
    return table


def _sum(table: pandas.DataFrame, column: str, **which) -> int:
    return int(_of(table, **which)[column].sum())


def _representations(parts: pandas.DataFrame) -> dict:
    recipe = _of(parts, start="recipe")
    aligned = {"start": "recipe", "boundary": "aligned"}
    ratio = {
        r: energy_ratio(parts, {"representation": r, **aligned}, {"representation": "sh4", **aligned})
        for r in numbers.representations(parts)
    }
    seconds = {
        r: time_ratio(parts, {"representation": r, **aligned}, {"representation": "sh4", **aligned}) for r in ratio
    }
    broken = {
        r: _sum(recipe, "complex edges", boundary="aligned", representation=r)
        / _sum(recipe, "complex edges", boundary="aligned", representation="sh4")
        for r in ratio
    }
    require(max(abs(ratio[r] - 1) for r in FREE) < 2e-3, "sh4, tensor4 and odeco end in one field")
    require(ratio["sh469"] < 1.01 and seconds["sh469"] > 1.1, "sh469 is as good and dearer")
    require(
        all(1 < ratio[r] < 1.1 and broken[r] < 1 and seconds[r] > 3 for r in METRICS),
        "metrics: a little more energy, fewer complex edges, far dearer",
    )
    fixed = _of(recipe, boundary="fixed").groupby("representation")["complex edges"].sum()
    require(
        all(fixed[r] > 0.99 * fixed["sh4"] for r in METRICS), "with fixed frames metrics have no fewer complex edges"
    )
    require(ratio["su2"] > 1.5 and broken["su2"] > 10, "su2 fails")
    return {
        "representation_table": markdown(by_method(recipe, ["boundary", "representation"])),
        "same": max(abs(ratio[r] - 1) for r in FREE) * 100,
        "sh469_energy": percent(ratio["sh469"]),
        "sh469_time": seconds["sh469"],
        "metric_energy": " and ".join(percent(ratio[r]) for r in METRICS),
        "metric_time": " and ".join(f"{seconds[r]:.0f}" for r in METRICS),
        "metric_complex": " and ".join(f"{100 * (1 - broken[r]):.0f} %" for r in METRICS),
        "su2_energy": ratio["su2"],
        "su2_complex": broken["su2"],
    }


def _starts(parts: pandas.DataFrame) -> dict:
    aligned = _of(parts, boundary="aligned")
    worse, broken = {}, {}
    for r in numbers.representations(parts):
        worse[r] = energy_ratio(
            aligned, {"representation": r, "start": "linear start"}, {"representation": r, "start": "recipe"}
        )
        broken[r] = _sum(aligned, "complex edges", representation=r, start="linear start") / _sum(
            aligned, "complex edges", representation=r, start="recipe"
        )
    require(all(value > 1 for value in worse.values()), "the recipe lowers every representation's energy")
    require(all(worse[r] > 1.1 for r in METRICS), "metrics need it most")
    return {
        "start_table": markdown(by_method(aligned, ["representation", "start"])),
        "start_sh4": percent(worse["sh4"]),
        "start_metrics": " and ".join(percent(worse[r]) for r in METRICS),
        "start_complex": 100 * (broken["sh4"] - 1),
    }


def _solvers(bodies: pandas.DataFrame) -> dict:
    held = _of(bodies, boundary=["aligned", "fixed"])
    own = {"representation": "sh4", "solver": "default"}
    fill = {"solver_table": markdown(by_method(_of(held, representation="sh4"), ["start", "solver"]))}
    spread = (
        _of(held, representation=FREE, start="recipe")
        .groupby(["input", "boundary"])["energy"]
        .agg(lambda e: e.max() / e.min() if e.min() > numbers.NO_ENERGY else 1)
    )
    fill["solver_spread"] = 100 * (spread.max() - 1)
    for start, name in (("recipe", "recipe"), ("linear start", "linear")):
        for solver, short in (("levenberg_marquardt", "lm"), ("lbfgs", "lbfgs")):
            fill[f"{short}_{name}_time"] = time_ratio(
                held, {**own, "solver": solver, "start": start}, {**own, "start": start}
            )
            require(fill[f"{short}_{name}_time"] > 1.5, f"{solver} is slower than the trust region from the {start}")
    return fill


def _boundaries(bodies: pandas.DataFrame, parts: pandas.DataFrame) -> dict:
    sh4 = _of(parts, representation="sh4", start="recipe")
    free = bodies[bodies["boundary"] == "none"]
    require(
        free["energy"].max() < numbers.NO_ENERGY and free["singular edges"].sum() == 0, "nothing held: constant fields"
    )
    raised = energy_ratio(sh4, {"boundary": "fixed"}, {"boundary": "aligned"})
    broken = _sum(sh4, "complex edges", boundary="fixed") / _sum(sh4, "complex edges", boundary="aligned")
    bad = _sum(sh4, "non-meshable vertices", boundary="fixed") / _sum(sh4, "non-meshable vertices", boundary="aligned")
    require(raised > 1 and broken > 1 and bad > 1, "fixed frames cost energy and complex edges")
    return {
        "boundary_table": markdown(
            by_method(_of(bodies, representation="sh4", solver="default", start="recipe"), ["input", "boundary"])
        ),
        "fixed_energy": percent(raised),
        "fixed_complex": broken,
        "fixed_bad": bad,
        "free_fields": len(free),
    }
