"""Seconds and memory of the phases that the core names in its reports."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from .phases import PHASES, PeakMemory, Progress

if TYPE_CHECKING:
    from ..records.field import InputRecord


class PhaseMeter:
    """wall, cpu: seconds, those of the record before, if there is one; peak_mb: of the phases that begin here. Two
    phases of the core that have a name of one before get "mesh_" before it. `report` is a callback for the core that
    passes its reports on."""

    def __init__(self, before: InputRecord | None, progress: Progress | None):
        seconds = (before.wall_seconds, before.cpu_seconds) if before else ({}, {})
        self.wall, self.cpu = ({name: float(s) for name, s in of_phases.items()} for of_phases in seconds)
        self.wall.pop("write", None)
        self.cpu.pop("write", None)
        self._taken = PHASES if before else ()
        self.peak_mb: dict[str, float] = {}
        self._progress = progress
        self._phase = ""
        self._memory, self._began = PeakMemory(), (time.perf_counter(), time.process_time())

    def report(self, phase: str, fraction: float, merit: float) -> bool | None:
        self.begin(phase)
        return None if self._progress is None else self._progress(phase, fraction, merit)

    def begin(self, phase: str) -> None:
        name = phase.replace(" ", "_")
        name = f"mesh_{name}" if name in self._taken and name != "write" else name
        if name == self._phase:
            return
        self.end()
        self._phase = name
        self._memory, self._began = PeakMemory(), (time.perf_counter(), time.process_time())

    def end(self) -> None:
        """Of the phase that is going on."""
        if not self._phase:
            return
        wall, cpu = self._began
        self.wall[self._phase] = self.wall.get(self._phase, 0.0) + time.perf_counter() - wall
        self.cpu[self._phase] = self.cpu.get(self._phase, 0.0) + time.process_time() - cpu
        self.peak_mb[self._phase] = round(max(self.peak_mb.get(self._phase, 0.0), self._memory.megabytes()), 1)
        self._phase = ""
