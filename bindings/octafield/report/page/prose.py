"""The sentences of a report, each made from the figures of the tables and plots that it cites; HTML."""

import html
import itertools
from collections.abc import Mapping, Sequence
from typing import TypeVar

import numpy as np

from ..numbers.columns import preparation_seconds
from ..numbers.deviations import Deviations
from ..numbers.profiles import EQUAL, Line, Profile, geometric_mean, ratios_to_best, smoothing_seconds
from ..numbers.records import Method, Results, Setting
from .words import counted, every, listed, named, sentence, spread, with_boundary

COINCIDE = 0.01  # degrees: fields closer at 95 % of the vertices are called equal
_MANY = 3  # names in a list before "and so many more"
_Figure = TypeVar("_Figure", int, float)


def scope(results: Results, open_runs: int, cite: str) -> str:
    """What was computed on what."""
    settings = [html.escape(setting.name) for setting in results.settings]
    where = html.escape(results.inputs[0]) if len(results.inputs) == 1 else counted(len(results.inputs), "input")
    if len(settings) == 1:
        where += f" {with_boundary(results.settings[0])}"
    else:
        names = "; ".join(settings) if any("," in name for name in settings) else listed(settings)
        where += f" with {len(settings)} boundary treatments ({names})"
    seeds = len({case.seed for case in results.cases})
    where += f" and {seeds} seeds" if seeds > 1 else ""
    runs = counted(len(results.runs), "run")
    read = results.read()
    others = f" and {counted(len(read), 'field')} read from files ({named(read)})" if read else ""
    if len(results.methods) == 1:
        text = [f"one method, {named(results.methods)}, is applied to {where}: {runs} {cite}"]
    else:
        text = [
            (
                f"the comparison covers {_methods([m for m in results.methods if m not in read])}{others} on {where}:"
                f" {runs} on {counted(len(results.problems), 'problem')} {cite}"
            ),
            (
                "a problem is an input with a boundary treatment; its fields share one mesh, and energies are compared"
                " within a problem only"
            ),
        ]
    if seeds > 1:
        text.append("figures of a problem are means over its seeds")
    states = [run.state for run in results.runs]
    without = listed(f"{states.count(word)} {word}" for word in ("failed", "crashed") if word in states)
    if without:
        text.append(f"a field was obtained in {states.count('done')} of the {runs}; {without} {cite}")
    if open_runs:
        text.append(f"not carried out yet: {counted(open_runs, 'run')}")
    return " ".join(map(sentence, text))


def starts(results: Results, cite: str) -> str:
    """Where methods begin and what they are judged by."""
    ours = [run for run in results.runs if run.computed and run.record.start in (None, "default")]
    rounds = {run.options.get("rounds", 2) > 0 for run in ours}
    others = [m for m in results.methods if m.representation != "sh4" and m not in results.read()]
    if not ours or not (others or len(rounds) > 1):
        return ""
    judged = f"all are judged by sh4's energy E, and what each minimised stands beside it {cite}"
    if rounds == {True}:
        return sentence(f"every method starts from the minimum that was found of sh4's energy; {judged}")
    if rounds == {False}:
        return sentence(
            "every method starts for itself, from one linear solve (a random field for seeds other than 0), without a"
            f" step in sh4; {judged}"
        )
    each = (
        "methods start from the minimum that was found of sh4's energy; those called “independent start” from one"
        " linear solve (a random field for seeds other than 0)"
    )
    return sentence(f"{each}; {judged}")


def _methods(methods: Sequence[Method]) -> str:
    """ "3 methods (a, b and c)"; as a product where they are one of representations and variants."""
    count = counted(len(methods), "method")
    variants = list(dict.fromkeys(method.variant or "default" for method in methods))
    representations = list(dict.fromkeys(method.representation for method in methods))
    if min(len(variants), len(representations)) > 1:
        each = "" if len(representations) * len(variants) == len(methods) else "up to "
        return (
            f"{count}, {len(representations)} representations ({listed(representations)}) in"
            f" {each}{counted(len(variants), 'variant')} ({listed(variants)}),"
        )
    return f"{count} ({named(methods)})"


def meshes(results: Results, cite: str) -> str:
    """Their sizes."""
    first = {run.input: run.record for run in reversed(results.runs) if run.done}
    if not first:
        return ""
    sizes = [sorted(r.vertices for r in first.values()), sorted(r.tets for r in first.values())]
    vertices, tets = (f"{s[0]:,}" if s[0] == s[-1] else f"{s[0]:,} to {s[-1]:,}" for s in sizes)
    of = "mesh has" if len(first) == 1 else "meshes have"
    return sentence(f"the {of} {vertices} vertices and {tets} tetrahedra {cite}")


def energy(lines: Sequence[Line], cite: str) -> list[str]:
    """Which methods end lowest, and by how much; a paragraph per setting."""
    return list(
        _energy_in(setting, list(of), cite) for setting, of in itertools.groupby(lines, lambda line: line.setting)
    )


def _energy_in(setting: Setting, lines: list[Line], cite: str) -> str:
    where, first = with_boundary(setting), lines[0]
    complete = [line for line in lines if line.complete]
    missing = [line.method for line in lines if not line.complete]
    if not any(line.solved for line in lines):
        return sentence(f"{where}, no run ended with a field {cite}")
    if not complete:
        return sentence(f"{where}, no method has a field on every problem, so methods are not ranked {cite}")
    text = []
    if complete[0].ratio is None:
        reached = _who_reach_zero(complete) if len(lines) > 1 else "the method reaches it"
        text.append(f"{where}, the lowest energy is zero up to rounding{_on_all(first.problems)}; {reached} {cite}")
    elif len(lines) > 1:
        text += _ranking(where, complete, first.problems, cite)
    elif first.problems == 1:
        text.append(f"{where}, {named([first.method])} ends at E = {first.energy:.6g} {cite}")
    if first.zero and complete[0].ratio is not None and len(lines) > 1:
        text.append(
            f"a lowest energy of zero, up to rounding, keeps {counted(first.zero, 'problem')} out of the ratios {cite}"
        )
    if missing:
        text.append(
            f"not ranked, for want of a field on some problem that another method solves: {named(missing)} {cite}"
        )
    return " ".join(map(sentence, text))


def _ranking(where: str, complete: list[Line], problems: int, cite: str) -> list[str]:
    """Of methods with a field on every problem."""
    ratio, largest = (
        _known({line.method: line.ratio for line in complete}),
        _known({line.method: line.largest for line in complete}),
    )
    low, reach = min(ratio.values()), max(largest, key=lambda method: largest[method])
    lowest = [method for method, value in ratio.items() if value <= low * (1 + EQUAL)]
    others = {method: value for method, value in ratio.items() if method not in lowest}
    energy = next(line.energy for line in complete if line.ratio == low)
    if len(complete) == 1:
        return [f"{where}, only {named(lowest)} has a field on every problem {cite}"]
    if not others and largest[reach] <= 1 + EQUAL:
        at = "" if energy is None else f", E = {energy:.6g}"
        return [f"{where}, {every(len(complete), 'method')} end at the same energy within 0.01 %{at} {cite}"]
    farthest = f"single problems reach {largest[reach]:.4f} ({named([reach])})"
    if not others:
        return [
            f"{where}, {every(len(complete), 'method')} are equal on geometric mean, at {low:.4f} times the lowest of"
            f" each problem; {farthest} {cite}"
        ]
    have, same = _verb(len(lowest), "has", "have"), " (within 0.01 % of each other)" if len(lowest) > 1 else ""
    end = f"{_verb(len(others), 'the other ends', 'the others end')} at {_times(others)}"
    if problems == 1:
        return [f"{where}, {named(lowest, _MANY)} {have} the lowest energy, E = {energy:.6g}{same}; {end} that {cite}"]
    over = f"{low:.4f} times the lowest of each problem on geometric mean"
    text = f"{where}, {named(lowest, _MANY)} {have} the lowest energies{same}: {over}; {end} it, and {farthest} {cite}"
    most = max(line.lowest for line in complete)
    tops = named([line.method for line in complete if line.lowest == most], _MANY)
    return [
        text,
        f"on {most} of {problems} problems the lowest energy, or one within 0.01 % of it, is that of {tops} {cite}",
    ]


def _known(values: Mapping[Method, _Figure | None]) -> dict[Method, _Figure]:
    return {method: value for method, value in values.items() if value is not None}


def _times(ratio: dict[Method, float]) -> str:
    return f"{spread(ratio, '.4f', same=EQUAL)} times" if len(ratio) > 1 else f"{next(iter(ratio.values())):.4f} times"


def _who_reach_zero(complete: list[Line]) -> str:
    reach = [line.method for line in complete if line.lowest == line.problems]
    if len(reach) == len(complete):
        return f"{every(len(reach), 'method')} reach it" if len(reach) > 1 else f"{named(reach)} reaches it"
    if not reach:
        return "no method reaches it everywhere"
    return (
        f"{named(reach, _MANY)} {_verb(len(reach), 'reaches', 'reach')} it, the"
        f" {_verb(len(complete) - len(reach), 'other ends', 'others end')} above"
    )


def _on_all(problems: int) -> str:
    return "" if problems == 1 else f" on {every(problems, 'problem')}"


def profile(profiles: dict[Method, Profile], cite: str) -> str:
    """The share of problems on which methods come within a hundredth of the lowest energy."""
    shares = {method: 100 * found.at(1.01) for method, found in profiles.items()}
    problems = next(iter(profiles.values())).problems
    if not problems:
        return ""
    span = spread(shares, ".0f", unit=" %") + (" for every method" if len(set(shares.values())) == 1 else "")
    what = f"the share of problems on which a method ends within 1 % of the lowest energy is {span}"
    return sentence(f"{what}, of {counted(problems, 'problem')} with an energy above zero {cite}")


def convergence(results: Results, cite: str) -> str:
    fields = [run.record for run in results.runs if run.computed]
    stopped = [record for record in fields if record.converged is False]
    if not stopped:
        return ""
    reasons = listed(
        f"“{html.escape(reason)}”" for reason in dict.fromkeys(record.stop_reason or "" for record in stopped)
    )
    return sentence(
        f"the tolerance was not met by {len(stopped)} of {counted(len(fields), 'field')} ({reasons}) {cite}"
    )


def graphs(lines: Sequence[Line], cite: str) -> list[str]:
    """Where singular graphs differ; a paragraph per setting."""
    text = []
    for setting, of in itertools.groupby(lines, lambda line: line.setting):
        complete = [line for line in of if line.complete]
        if not complete:
            continue
        head = "the field has" if len(complete) == 1 and complete[0].problems == 1 else "the fields have"
        summed = f", summed over {counted(complete[0].problems, 'problem')}," if complete[0].problems > 1 else ""
        edges = _known({line.method: line.singular_edges for line in complete})
        bad = _known({line.method: line.non_meshable for line in complete})
        parts = [_amount(edges, "singular edge")]
        if any(edges.values()):
            parts.append(_complex(_known({line.method: line.complex_edges for line in complete})))
        if len(bad) == len(complete):
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
            which = f"those of {every(len(found.methods), 'method')}"
        close = f"at 95 % of the vertices their frames are within {max(within, 1e-4):.2g} degrees of each other"
        text.append(f"fields that coincide are {which}; {close} {cite}")
    heads = [group[0] for group in groups]
    others = {pair: angles for pair, angles in pairs.items() if all(method in heads for method in pair)}
    if len(others) == 1:
        (a, b), (mean, high) = next(iter(others.items()))
        text.append(
            f"the fields of {named([a])} and {named([b])} lie {mean:.2f} degrees apart on average, with a 95th"
            f" percentile of {high:.2f} degrees {cite}"
        )
    elif others:
        near, far = (choose(others.items(), key=lambda item: item[1][0]) for choose in (min, max))
        ends = [
            f"{mean:.2f} degrees ({named([a])} to {named([b])}; 95th percentile {high:.2f})"
            for (a, b), (mean, high) in (near, far)
        ]
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


def times(results: Results, cite: str, ratios: str) -> str:
    """What methods cost, those with a field wherever any has one. ratios: where these are shown."""
    seconds = smoothing_seconds(results, results.problems)
    solved = np.isfinite(np.min(list(seconds.values()), axis=0)) if seconds else np.zeros(0, bool)
    complete = {
        method: own[solved] for method, own in seconds.items() if solved.any() and np.isfinite(own[solved]).all()
    }
    if not complete:
        return ""
    total = {method: float(own.sum()) for method, own in complete.items()}
    alone = f" with {named(complete)}" if len(complete) == 1 < len(results.methods) else ""
    text = [f"smoothing takes {spread(total, '.3g')} processor seconds{alone}{_in_all(int(solved.sum()))} {cite}"]
    over = ratios_to_best(seconds)
    slow = _known({method: geometric_mean(over[method]) for method in complete})
    if len(results.methods) > 1 and slow:
        text.append(
            f"relative to the fastest method on each problem that is a factor of {spread(slow, '.2f')} on geometric"
            f" mean {ratios}"
        )
    read = results.read()
    missing = [method for method in results.methods if method not in complete and method not in read]
    if read:
        text.append(f"read from files, without times: {named(read)}")
    if missing:
        text.append(
            f"left out of times, for want of a field on some problem that another method solves: {named(missing)}"
            f" {cite}"
        )
    return " ".join(map(sentence, text))


def _in_all(problems: int) -> str:
    return f" in all on {counted(problems, 'problem')}" if problems > 1 else ""


def shared_time(results: Results, cite: str) -> str:
    first = {run.input: run.record for run in reversed(results.runs) if run.done}
    seconds = sorted(map(preparation_seconds, first.values()))
    if not seconds:
        return ""
    span = " to ".join(dict.fromkeys(f"{value:.3g}" for value in (seconds[0], seconds[-1])))
    return sentence(
        f"reading, meshing and the surface cross field, which runs on an input share, take {span} seconds by the clock"
        f" {cite}"
    )


def _verb(count: int, singular: str, plural: str) -> str:
    return singular if count == 1 else plural
