"""The sentences of a report, each made from the figures of the tables and plots that it cites; HTML."""

import html
import itertools
from collections.abc import Sequence

import numpy as np

from .deviations import Deviations
from .profiles import EQUAL, Line, Profile, geometric_mean, ratios_to_best, smoothing_seconds
from .records import Method, Results, Setting
from .words import counted, listed, named, sentence, spread, with_boundary

COINCIDE = 0.01  # degrees: fields closer at 95 % of the vertices are called equal
_MANY = 3  # names in a list before "and so many more"


def scope(results: Results, open_runs: int, cite: str) -> str:
    """What was computed on what."""
    where = html.escape(results.inputs[0]) if len(results.inputs) == 1 else counted(len(results.inputs), "input")
    settings = [html.escape(setting.name) for setting in results.settings]
    treatments = f"with {counted(len(settings), 'boundary treatment')} ({'; '.join(settings) if any(',' in s for s in settings) else listed(settings)})"
    seeds = len({problem.seed for problem in results.problems})
    where += f" {with_boundary(results.settings[0]) if len(settings) == 1 else treatments}" + (f" and {seeds} seeds" if seeds > 1 else "")
    runs, problems = counted(len(results.runs), "run"), counted(len(results.problems), "problem")
    names = named(results.methods)
    methods = f"{counted(len(results.methods), 'method')} ({names})"
    variants = list(dict.fromkeys(method.variant or "default" for method in results.methods))
    representations = list(dict.fromkeys(method.representation for method in results.methods))
    if len(variants) > 1 and len(representations) * len(variants) == len(results.methods):
        methods = f"{counted(len(results.methods), 'method')}, {counted(len(representations), 'representation')} ({listed(representations)}) in {len(variants)} variants each ({listed(variants)}),"
    if len(results.methods) == 1:
        text = [sentence(f"One method, {names}, is applied to {where}: {runs} {cite}")]
    else:
        text = [sentence(f"the comparison covers {methods} on {where}: {runs} on {problems} {cite}")]
        text.append("A problem is an input with a boundary treatment and a seed; its fields share one mesh, and energies are compared within a problem only.")
    states = [run.state for run in results.runs]
    counts = {word: states.count(word) for word in ("failed", "crashed")}
    if any(counts.values()):
        without = listed(f"{count} {word}" for word, count in counts.items() if count)
        text.append(sentence(f"a field was obtained in {states.count('done')} of the {runs}; {without} {cite}"))
    if open_runs:
        text.append(sentence(f"not carried out yet: {counted(open_runs, 'run')}"))
    return " ".join(text)


def meshes(results: Results, cite: str) -> str:
    """Their sizes."""
    first = {run.input: run.row for run in reversed(results.runs) if run.done}
    if not first:
        return ""
    sizes = [sorted(row[key] for row in first.values()) for key in ("vertices", "tets")]
    vertices, tets = (f"{s[0]:,}" if s[0] == s[-1] else f"{s[0]:,} to {s[-1]:,}" for s in sizes)
    of = "mesh has" if len(first) == 1 else "meshes have"
    return sentence(f"the {of} {vertices} vertices and {tets} tetrahedra {cite}")


def energy(lines: Sequence[Line], cite: str) -> list[str]:
    """Which methods end lowest, and by how much; a paragraph per setting."""
    return list(_energy_in(setting, list(of), cite) for setting, of in itertools.groupby(lines, lambda line: line.setting))


def _energy_in(setting: Setting, lines: list[Line], cite: str) -> str:
    where, problems = with_boundary(setting), lines[0].problems
    complete = [line for line in lines if line.complete]
    if not any(line.solved for line in lines):
        return sentence(f"{where}, no run ended with a field {cite}")
    text = []
    if not complete:
        text.append(f"{where}, no method has a field on every problem, so methods are not ranked {cite}")
    elif complete[0].ratio is None:
        text.append(f"{where}, the lowest energy is zero up to rounding{_on_all(problems)}; {_who_reach_zero(complete)} {cite}")
    elif len(lines) == 1:
        one = complete[0]
        text.append(f"{where}, {named([one.method])} ends at " + (f"E = {one.energy:.6g} {cite}" if problems == 1 else f"the energies of its runs {cite}"))
    else:
        text.append(_ranking(where, complete, problems, cite))
    if lines[0].zero and complete and complete[0].ratio is not None:
        text.append(f"a lowest energy of zero, up to rounding, keeps {counted(lines[0].zero, 'problem')} out of the ratios {cite}")
    missing = [line.method for line in lines if not line.complete]
    if complete and missing:
        text.append(f"not ranked, for want of a field on some problem that another method solves: {named(missing)} {cite}")
    return " ".join(map(sentence, text))


def _ranking(where: str, complete: list[Line], problems: int, cite: str) -> str:
    ratio = {line.method: line.ratio for line in complete}
    low, reach = min(ratio.values()), max(complete, key=lambda line: line.largest)
    lowest = [method for method, value in ratio.items() if value <= low * (1 + EQUAL)]
    others = {method: value for method, value in ratio.items() if method not in lowest}
    best = min((line for line in complete if line.method in lowest), key=lambda line: line.ratio)
    if len(complete) == 1:
        return f"{where}, only {named(lowest)} has a field on every problem {cite}"
    if not others and reach.largest <= 1 + EQUAL:
        at = f", E = {best.energy:.6g}" if problems == 1 else ""
        return f"{where}, all {counted(len(complete), 'method')} end at the same energy within 0.01 %{at} {cite}"
    same = " (within 0.01 % of each other)" if len(lowest) > 1 else ""
    end = _verb(len(others), "the other ends", "the others end")
    if problems == 1:
        return f"{where}, {named(lowest, _MANY)} {_verb(len(lowest), 'has', 'have')} the lowest energy, E = {best.energy:.6g}{same}; {end} at {_times(others)} that {cite}"
    over = f"{low:.4f} times the lowest of each problem on geometric mean"
    if not others:
        return f"{where}, all {counted(len(complete), 'method')} are equal on geometric mean, {over}; single problems reach {reach.largest:.4f} ({named([reach.method])}) {cite}"
    text = f"{where}, {named(lowest, _MANY)} {_verb(len(lowest), 'has', 'have')} the lowest energies{same}: {over}; {end} at {_times(others)} it"
    if reach.largest > 1 + EQUAL:
        text += f", and single problems reach {reach.largest:.4f} ({named([reach.method])})"
    most = max(line.lowest for line in complete)
    tops = [line.method for line in complete if line.lowest == most]
    return f"{sentence(f'{text} {cite}')} On {most} of {counted(problems, 'problem')} the lowest energy, or one within 0.01 % of it, is that of {named(tops, _MANY)} {cite}"


def _times(ratio: dict[Method, float]) -> str:
    return f"{spread(ratio, '.4f', same=EQUAL)} times" if len(ratio) > 1 else f"{next(iter(ratio.values())):.4f} times"


def _who_reach_zero(complete: list[Line]) -> str:
    reach = [line.method for line in complete if line.lowest == line.problems]
    if len(reach) == len(complete):
        return "all methods reach it" if len(reach) > 1 else f"{named(reach)} reaches it"
    if not reach:
        return "no method reaches it everywhere"
    return f"{named(reach, _MANY)} {_verb(len(reach), 'reaches', 'reach')} it, the {_verb(len(complete) - len(reach), 'other ends', 'others end')} above"


def _on_all(problems: int) -> str:
    return "" if problems == 1 else " on both problems" if problems == 2 else f" on all {problems:,} problems"


def profile(profiles: dict[Method, Profile], cite: str) -> str:
    """The share of problems on which methods come within a hundredth of the lowest energy."""
    shares = {method: 100 * found.at(1.01) for method, found in profiles.items()}
    span = spread(shares, ".0f", unit=" %")
    return sentence(f"the share of problems on which a method ends within 1 % of the lowest energy is {span if len(set(shares.values())) > 1 else span + ' for every method'} {cite}")


def convergence(results: Results, cite: str) -> str:
    fields = [run.row for run in results.runs if run.done]
    stopped = [row for row in fields if not row.get("converged", True)]
    if not stopped:
        return ""
    reasons = listed(f"“{html.escape(str(reason))}”" for reason in dict.fromkeys(row.get("stop_reason", "") for row in stopped))
    return sentence(f"the tolerance was not met by {len(stopped)} of {counted(len(fields), 'field')} ({reasons}) {cite}")


def graphs(lines: Sequence[Line], cite: str) -> list[str]:
    """Where singular graphs differ; a paragraph per setting."""
    text = []
    for setting, of in itertools.groupby(lines, lambda line: line.setting):
        complete = [line for line in of if line.complete]
        if not complete:
            continue
        head = "the field has" if len(complete) == 1 and complete[0].problems == 1 else "the fields have"
        summed = f", summed over {counted(complete[0].problems, 'problem')}," if complete[0].problems > 1 else ""
        edges = {line.method: line.singular_edges for line in complete}
        bad = {line.method: line.non_meshable for line in complete}
        parts = [_amount(edges, "singular edge")]
        if any(edges.values()):
            parts.append(_complex({line.method: line.complex_edges for line in complete}))
        if all(value is not None for value in bad.values()):
            parts.append(f"and {_amount(bad, 'place')} that no hex mesh has")
        text.append(sentence(f"{with_boundary(setting)}, {head}{summed} {', '.join(parts)} {cite}"))
    return text


def _amount(values: dict[Method, int], singular: str) -> str:
    if len(set(values.values())) == 1:
        value = next(iter(values.values()))
        return counted(value, singular) if value else f"no {singular}s"
    return f"{spread(values, ',d')} {singular}s"


def _complex(values: dict[Method, int]) -> str:
    if len(set(values.values())) == 1:
        value = next(iter(values.values()))
        return f"{value:,} of them complex" if value else "none of them complex"
    return f"{spread(values, ',d')} of them complex"


def distances(found: Deviations, cite: str) -> str:
    """Which fields coincide, and how far the others lie apart."""
    pairs = found.pairs()
    if not pairs:
        return ""
    groups, text = _coinciding(found), []
    alike = [group for group in groups if len(group) > 1]
    if alike:
        within = max(high for (a, b), (_, high) in pairs.items() if any(a in group and b in group for group in alike))
        which = f"those of {named(alike[0])}" if len(alike) == 1 else "; ".join(map(named, alike))
        if len(alike[0]) == len(found.methods):
            which = f"those of all {counted(len(found.methods), 'method')}"
        text.append(f"fields that coincide are {which}; at 95 % of the vertices their frames are within {max(within, 1e-4):.2g} degrees of each other {cite}")
    heads = [group[0] for group in groups]
    others = {pair: angles for pair, angles in pairs.items() if all(method in heads for method in pair)}
    if len(others) == 1:
        ((a, b), (mean, high)) = next(iter(others.items()))
        text.append(f"the fields of {named([a])} and {named([b])} lie {mean:.2f} degrees apart on average, with a 95th percentile of {high:.2f} degrees {cite}")
    elif others:
        near, far = (choose(others.items(), key=lambda item: item[1][0]) for choose in (min, max))
        ends = [f"{mean:.2f} degrees ({named([a])} to {named([b])}; 95th percentile {high:.2f})" for (a, b), (mean, high) in (near, far)]
        which = "fields that do not coincide" if len(heads) < len(found.methods) else "fields"
        text.append(f"pairs of {which} lie between {ends[0]} and {ends[1]} apart on average {cite}")
    return " ".join(map(sentence, text))


def _coinciding(found: Deviations) -> list[list[Method]]:
    """Methods in groups whose pairs all coincide."""
    groups: list[list[int]] = []
    for k in range(len(found.methods)):
        fits = (group for group in groups if all(found.high[k, other] <= COINCIDE for other in group))
        own = next(fits, None)
        if own is None:
            groups.append([k])
        else:
            own.append(k)
    return [[found.methods[k] for k in group] for group in groups]


def times(results: Results, cite: str) -> str:
    """What methods cost, those with a field wherever any has one."""
    seconds = smoothing_seconds(results, results.problems)
    solved = np.isfinite(np.min(list(seconds.values()), axis=0)) if seconds else np.zeros(0, bool)
    complete = {method: own[solved] for method, own in seconds.items() if solved.any() and np.isfinite(own[solved]).all()}
    if not complete:
        return ""
    total = {method: float(own.sum()) for method, own in complete.items()}
    text = [f"smoothing takes {spread(total, '.3g')} processor seconds{_in_all(int(solved.sum()))} {cite}"]
    if len(complete) > 1:
        slow = {method: geometric_mean(ratio) for method, ratio in ratios_to_best(complete).items() if len(ratio)}
        if slow:
            text.append(f"relative to the fastest of these methods on each problem that is a factor of {spread(slow, '.2f')} on geometric mean {cite}")
    return " ".join(map(sentence, text))


def _in_all(problems: int) -> str:
    return f" in all on {counted(problems, 'problem')}" if problems > 1 else ""


def shared_time(results: Results, cite: str) -> str:
    first = {run.input: run.row["wall_seconds"] for run in reversed(results.runs) if run.done}
    seconds = sorted(sum(of[phase] for phase in ("read", "mesh", "surface")) for of in first.values())
    if not seconds:
        return ""
    span = " to ".join(dict.fromkeys(f"{value:.3g}" for value in (seconds[0], seconds[-1])))
    return sentence(f"reading, meshing and the surface cross field, which runs on an input share, take {span} seconds by the clock {cite}")


def _verb(count: int, singular: str, plural: str) -> str:
    return singular if count == 1 else plural
