"""Several runs as one piece of work: how many are done."""

from .phases import Progress


class SeveralRuns:
    def __init__(self, progress: Progress | None, total: int):
        self._progress, self._total, self._done = progress, total, 0

    def finished(self) -> None:
        """A run."""
        self._done += 1

    def labelled(self, label: str) -> Progress | None:
        """For one run: its phases with this label, and the share of all runs in place of its own."""
        tell = self._progress
        return tell and (
            lambda phase, _, merit: tell(
                f"{self._done} of {self._total}: {label}: {phase}", self._done / self._total, merit
            )
        )
