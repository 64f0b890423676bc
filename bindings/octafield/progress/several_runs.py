"""Several runs as one piece of work: how many are done, the time left."""

import math
import time
from collections.abc import Sequence

from .costs import Costs, Forecast
from .phases import Progress
from .time_left import SteadyTimeLeft, words

_FORECAST_EVERY = 2.0  # seconds


class SeveralRuns:
    """Groups of runs on one mesh each, one after the other. methods: of the runs of a group, in their order; equal
    where they cost alike."""

    def __init__(self, progress: Progress | None, groups: int, methods: Sequence[str]):
        self._progress, self._forecast, self._steady = progress, Forecast(Costs()), SteadyTimeLeft()
        self._left: float | None = None
        self._at = -math.inf
        self._began = time.monotonic()
        self._group, self._done, self._total = -1, 0, groups * len(methods)
        for number in range(groups):
            self._forecast.add(number, number, list(methods))

    def begins(self) -> None:
        """The preparation of the next group."""
        self._group, self._began = self._group + 1, time.monotonic()
        self._forecast.begins(self._group, self._began)

    def prepared(self, tets: int) -> None:
        self._forecast.costs.saw_tets(self._group, tets)
        self._step_done()

    def finished(self) -> None:
        """A run."""
        self._step_done()
        self._done += 1

    def _step_done(self) -> None:
        now = time.monotonic()
        self._forecast.step_done(self._group, now - self._began, now)
        self._began, self._at = now, -math.inf

    def labelled(self, label: str) -> Progress | None:
        """For one run: its phases with this label, and the share of all runs in place of its own."""
        progress = self._progress
        return progress and (lambda phase, fraction, merit: self._tell(progress, f"{label}: {phase}", merit))

    def _tell(self, progress: Progress, what: str, merit: float) -> bool | None:
        now = time.monotonic()
        if now - self._at >= _FORECAST_EVERY:
            self._left, self._at = self._forecast.left(now), now
        left = (
            ""
            if self._left is None or self._done == self._total
            else f", {words(self._steady.follow(self._left, now))}"
        )
        return progress(f"{self._done} of {self._total}{left}: {what}", self._done / self._total, merit)
