"""How long work still takes: estimates that do not jump, and the words for them. Times are seconds of one clock that
never goes backwards."""

import math
from collections import deque

_LEAST_FRACTION, _LEAST_SECONDS = 0.02, 2.0  # of a phase, before its rate says anything
_INERTIA = 5.0  # seconds in which what is shown follows an estimate most of the way


def words(seconds: float, most: bool = False) -> str:
    """As "about 3 min left"; most: an upper bound."""
    if seconds < 10:
        return "a few seconds left"
    for size, unit, last in ((1, "s", 55), (60, "min", 90), (3600, "h", 36), (86400, "days", math.inf)):  # noqa: B007
        number = seconds / size
        if number < last:
            break
    step = 10 if unit == "s" else 0.5 if unit != "min" and number < 5 else 1 if number < 10 or unit != "min" else 5
    return f"{'at most' if most else 'about'} {max(round(number / step), 1) * step:g} {unit} left"


class SteadyTimeLeft:
    """Follows estimates without jumps: between two it counts down, and it moves towards a new one by a share that grows
    with the time passed."""

    def __init__(self) -> None:
        self._left: float | None = None
        self._at = 0.0

    def follow(self, estimate: float, now: float) -> float:
        if self._left is None:
            self._left, self._at = estimate, now
            return estimate
        passed = max(now - self._at, 0.0)
        share = 1 - math.exp(-passed / _INERTIA)
        counted = max(self._left - passed, 0.0)
        # in the logarithm, as errors of estimates are factors
        self._left = math.expm1((1 - share) * math.log1p(counted) + share * math.log1p(max(estimate, 0.0)))
        self._at = now
        return self._left


class PhaseTimeLeft:
    """Of a phase that reports the fraction of its largest number of steps done: an upper bound, from its speed
    lately."""

    def __init__(self) -> None:
        self._seen: deque[tuple[float, float]] = deque()
        self._begin = 0.0
        self._steady = SteadyTimeLeft()

    def at(self, fraction: float, now: float) -> float | None:
        """None while too little is known."""
        if not 0 <= fraction <= 1:
            return None
        if self._seen and fraction < self._seen[-1][1]:
            self._seen.clear()
        if not self._seen:
            self._begin = now
        self._seen.append((now, fraction))

        def tells(seen: tuple[float, float]) -> bool:
            return now - seen[0] >= _LEAST_SECONDS and fraction - seen[1] >= _LEAST_FRACTION

        if not tells(self._seen[0]):
            return None
        # The slope over the later half of the time so far: steps of one kind follow those of another.
        middle = (self._begin + now) / 2
        while self._seen[1][0] <= middle and tells(self._seen[1]):
            self._seen.popleft()
        earlier, low = self._seen[0]
        return self._steady.follow((1 - fraction) * (now - earlier) / (fraction - low), now)
