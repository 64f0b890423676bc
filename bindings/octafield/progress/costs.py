"""How long the runs of a study or a comparison still take, judged by those that are finished.

A run's seconds are taken to grow with its tets, at a rate of its method (representation, solver ...). Rates begin with
measured ones (docs/scaling.md), which finished runs of any method correct together and those of the same method by
itself. An input whose tets are not known yet is judged by the size of its file beside those known.
"""

import heapq
import math
from collections.abc import Hashable
from dataclasses import dataclass, field

from .. import _core

PREPARE = "prepare"  # the method of reading, meshing and the cross field
# Seconds on a million tets, one thread; they matter until runs of the method are finished.
_PREPARING = 10.0
_UNKNOWN_METHOD = 100.0
_LEAST = 0.2  # seconds of a run on any mesh
_TYPICAL_TETS = 50_000.0  # of an input before any is known


def _seconds_per_million(method: str) -> float:
    if method == PREPARE:
        return _PREPARING
    scheme = _core.schemes.get(method)
    return scheme.seconds_per_million_tets or _UNKNOWN_METHOD if scheme else _UNKNOWN_METHOD


def field_seconds(representation: str, tets: float) -> float:
    """Of one field from file to analysis, one thread, where nothing else is known."""
    return _LEAST + (_PREPARING + _seconds_per_million(representation)) * tets / 1e6


@dataclass
class _Seen:
    expected: float = 0.0  # by the measured rates
    seconds: float = 0.0
    count: int = 0


class Costs:
    """limit: seconds after which a run is ended."""

    def __init__(self, limit: float = math.inf) -> None:
        self._limit = limit
        self._methods: dict[str, _Seen] = {}
        self._all = _Seen()
        self._tets: dict[Hashable, int] = {}
        self._bytes: dict[Hashable, int] = {}
        self._fit: tuple[float, float] | None = None  # log tets = a + b log bytes

    @property
    def known(self) -> bool:
        """Whether anything is finished."""
        return self._all.count > 0

    def saw_file(self, mesh: Hashable, size: int) -> None:
        self._bytes[mesh] = size

    def saw_tets(self, mesh: Hashable, tets: int) -> None:
        self._tets[mesh], self._fit = tets, None

    def finished(self, method: str, mesh: Hashable, seconds: float) -> None:
        if not 0 <= seconds < math.inf:
            return
        measured = self._measured(method, self.tets(mesh))
        for seen in (self._methods.setdefault(method, _Seen()), self._all):
            seen.expected += measured
            seen.seconds += seconds
            seen.count += 1

    def tets(self, mesh: Hashable) -> float:
        if mesh in self._tets:
            return self._tets[mesh]
        if not self._tets:
            return _TYPICAL_TETS
        if mesh not in self._bytes:
            return sum(self._tets.values()) / len(self._tets)
        if self._fit is None:
            self._fit = self._fitted()
        return math.exp(self._fit[0] + self._fit[1] * math.log1p(self._bytes[mesh]))

    def knows(self, mesh: Hashable) -> bool:
        return mesh in self._tets

    def _fitted(self) -> tuple[float, float]:
        """Tet meshes grow with their files; surfaces that are remeshed do not."""
        pairs = [
            (math.log1p(self._bytes[mesh]), math.log1p(tets))
            for mesh, tets in self._tets.items()
            if mesh in self._bytes
        ]
        if not pairs:
            return math.log(sum(self._tets.values()) / len(self._tets)), 0.0
        x, y = (sum(column) / len(pairs) for column in zip(*pairs, strict=True))
        variance = sum((a - x) ** 2 for a, _ in pairs)
        slope = sum((a - x) * (b - y) for a, b in pairs) / variance if len(pairs) > 2 and variance > 0 else 0.5
        slope = min(max(slope, 0.0), 1.2)
        return y - slope * x, slope

    def expected(self, method: str, mesh: Hashable) -> float:
        """Seconds. The factor on the measured rate: of the method's own runs, and, as if it were one run more, of
        all."""
        seen, overall = self._methods.get(method, _Seen()), self._all
        general = overall.seconds / overall.expected if overall.expected > 0 else 1.0
        weight = seen.expected / seen.count if seen.count else 1.0
        factor = (seen.seconds + general * weight) / (seen.expected + weight)
        return min(factor * self._measured(method, self.tets(mesh)), self._limit)

    @staticmethod
    def _measured(method: str, tets: float) -> float:
        return _LEAST + _seconds_per_million(method.split("/")[0]) * tets / 1e6


@dataclass
class _Group:
    mesh: Hashable
    steps: list[str]  # methods to come, that in work first
    since: float | None = None  # when that began; None: no process has this group


@dataclass
class Forecast:
    """Of all groups of runs that are not finished. slots: groups in work at once."""

    costs: Costs
    slots: int = 1
    _groups: dict[int, _Group] = field(default_factory=dict)

    def add(self, group: int, mesh: Hashable, methods: list[str]) -> None:
        """A group to do, or to do again; it begins with the preparation."""
        self._groups[group] = _Group(mesh, [PREPARE, *methods])

    def begins(self, group: int, now: float) -> None:
        if group in self._groups:
            self._groups[group].since = now

    def step_done(self, group: int, seconds: float, now: float, *, counts: bool = True) -> None:
        """counts: False for runs that failed, whose time says nothing."""
        of = self._groups.get(group)
        if of is None or not of.steps:
            return
        method = of.steps.pop(0)
        if counts:
            self.costs.finished(method, of.mesh, seconds)
        of.since = now
        if not of.steps:
            del self._groups[group]

    def drop(self, group: int) -> None:
        self._groups.pop(group, None)

    def left(self, now: float) -> float | None:
        """Seconds until all are done; None before anything is finished. Groups go to the first free slot in their
        order."""
        if not self.costs.known:
            return None
        ends = sorted(self._seconds(group, now) for group in self._groups.values() if group.since is not None)
        ends = ends[-self.slots :] if self.slots else ends
        ends += [0.0] * (self.slots - len(ends))
        heapq.heapify(ends)
        for group in self._groups.values():
            if group.since is None:
                heapq.heapreplace(ends, ends[0] + self._seconds(group, now))
        return max(ends, default=0.0)

    def _seconds(self, group: _Group, now: float) -> float:
        steps = [self.costs.expected(method, group.mesh) for method in group.steps]
        if group.since is not None:
            passed = max(now - group.since, 0.0)
            # What takes longer than expected is likely to take some time more.
            steps[0] = max(steps[0] - passed, 0.5 * passed)
        return sum(steps)
