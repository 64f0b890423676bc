"""Seconds per phase, peak memory and versions: the figures every record carries."""

import contextlib
import functools
import importlib.metadata
import os
import platform
import resource
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from .. import _core
from ..errors import Cancelled

PHASES = ("read", "mesh", "surface", "smooth", "analyse", "write")  # of every run; "sizes" where they are asked for

# Called with the phase (one of PHASES, a label before it in comparisons), the fraction done (negative: unknown) and a
# figure of merit (NaN: none). Returning False cancels.
Progress = Callable[[str, float, float], bool | None]


class PhaseClock:
    """Wall and processor seconds per phase. Processor time counts all threads of the process."""

    def __init__(self, earlier: "PhaseClock | None" = None):
        self.wall: dict[str, float] = dict(earlier.wall) if earlier else dict.fromkeys(PHASES, 0.0)
        self.cpu: dict[str, float] = dict(earlier.cpu) if earlier else dict.fromkeys(PHASES, 0.0)

    @contextlib.contextmanager
    def phase(self, name: str) -> Iterator[None]:
        wall, cpu = time.perf_counter(), time.process_time()
        try:
            yield
        finally:
            self.wall[name] = self.wall.get(name, 0.0) + time.perf_counter() - wall
            self.cpu[name] = self.cpu.get(name, 0.0) + time.process_time() - cpu


class PeakMemory:
    """Peak resident memory since it was made, in megabytes (1e6 bytes), Python and its libraries included.

    Linux lets a process reset its own high-water mark; where that fails the figure is the process's peak so far. The
    mesher runs in a process of its own: the larger of the two counts.
    """

    def __init__(self) -> None:
        self._children = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        with contextlib.suppress(OSError):
            Path("/proc/self/clear_refs").write_text("5")

    def megabytes(self) -> float:
        children = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        started_here = children if children > self._children else 0
        return max(self._own_kilobytes(), started_here) * 1024 / 1e6

    @staticmethod
    def _own_kilobytes() -> int:
        with contextlib.suppress(OSError):
            for line in Path("/proc/self/status").read_text().splitlines():
                if line.startswith("VmHWM:"):
                    return int(line.split()[1])
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def versions() -> dict[str, str]:
    """Versions of octafield and of what its results depend on."""
    found = {"octafield": octafield_version(), "python": platform.python_version()}
    for package in ("numpy", "vtk", "pyvista", "meshio"):
        try:
            found[package] = importlib.metadata.version(package)
        except importlib.metadata.PackageNotFoundError:
            found[package] = "not installed"
    found["platform"] = platform.platform()
    return found


def machine() -> dict[str, str | int | float]:
    """What times depend on: the processor's model, cores this process may use, and how many processes ran or waited in
    the last minute (load; this one included)."""
    return {"cpu": _processor(), "cores": len(os.sched_getaffinity(0)), "load": round(os.getloadavg()[0], 2)}


@functools.cache
def _processor() -> str:
    with contextlib.suppress(OSError):
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            name, _, value = line.partition(":")
            if name.strip() == "model name":
                return value.strip()
    return platform.processor() or platform.machine()


def libraries() -> dict[str, str]:
    """Versions of the C++ libraries that the compiled part was built with."""
    found = {}
    for entry in _core.__libraries__.split(","):
        name, _, version = entry.partition(" ")
        found[name] = version or "unknown"
    return found


def octafield_version() -> str:
    return _core.__version__


def forward(progress: Progress | None, phase: str, low: float = 0.0, high: float = 1.0) -> Progress | None:
    """A callback for the core that passes its reports on under our phase's name, the fraction scaled to [low, high]."""
    if progress is None:
        return None

    def report(_core_phase: str, fraction: float, merit: float) -> bool | None:
        return progress(phase, fraction if fraction < 0 else low + (high - low) * fraction, merit)

    return report


class StopNote:
    """Passes reports on to a callback and remembers whether it said stop."""

    def __init__(self, progress: Progress | None):
        self.stopped = False
        self.progress = None if progress is None else self._report
        self._callback = progress

    def _report(self, phase: str, fraction: float, merit: float) -> bool | None:
        answer = None if self._callback is None else self._callback(phase, fraction, merit)
        self.stopped = self.stopped or (answer is not None and not answer)
        return answer


def announce(progress: Progress | None, phase: str, fraction: float = -1.0) -> None:
    """Reports that a phase of unknown length begins; raises Cancelled when the callback says stop."""
    answer = None if progress is None else progress(phase, fraction, float("nan"))
    if answer is not None and not answer:
        raise Cancelled(f"cancelled during {phase}")
