"""Work in processes of their own, which may crash, hang or be ended at any moment without harm to this one.

run_supervised: the command line's. The parent only waits; on Ctrl-C it kills the child and removes the staging folders
the child had open (writing.py). start_isolated: programs that are started, as readers of CAD models and runs of
studies.
"""

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import FrameType
from typing import Any

from ..errors import IoError
from . import isolated
from .writing import on_staging

INTERRUPTED = 130
DEFECT = 1
_ENDINGS = (signal.SIGTERM, signal.SIGHUP)  # treated like Ctrl-C: a batch system or a closed terminal


def run_supervised(work: Callable[[], int]) -> int:
    """Exit code of work(), 130 after an interrupt."""
    if not hasattr(os, "fork"):
        return work()
    sys.stdout.flush()
    sys.stderr.flush()
    reading, writing = os.pipe()
    parent, child = os.getpid(), 0
    try:
        previous = {number: signal.signal(number, _raise_interrupt) for number in _ENDINGS}
        child = os.fork()
        if child == 0:
            _be_the_child(work, parent, reading, writing)
        os.close(writing)
        _, status = os.waitpid(child, 0)
        for number, handler in previous.items():
            signal.signal(number, handler)
    except KeyboardInterrupt:
        for number in (signal.SIGINT, *_ENDINGS):
            signal.signal(number, signal.SIG_IGN)
        if child:
            _stop(child)
            _remove_staging(reading)
        print("octafield: interrupted", file=sys.stderr, flush=True)
        return INTERRUPTED
    code = os.waitstatus_to_exitcode(status)
    if code >= 0:
        return code
    _remove_staging(reading)
    print(f"octafield: stopped by signal {reason(code)}", file=sys.stderr, flush=True)
    return DEFECT


def start_isolated(
    program: str | Path,
    arguments: Sequence[str],
    place: str,
    remedy: str,
    environment: Mapping[str, str] | None = None,
    **streams: Any,
) -> "subprocess.Popen[str]":
    """A Python program that imports what this one can, ends with this one and leaves Ctrl-C to it.

    program: a file, or the name of a module. place, remedy: head and end of the errors. environment: in addition to
    this process's. streams: of subprocess.Popen. Raises IoError (kinds no_python, cannot_start).
    """
    if not sys.executable or getattr(sys, "frozen", False):
        raise IoError(
            f"{place}: needs a process of its own, and this program does not tell which Python to start"
            f" (sys.executable); {remedy}",
            "no_python",
        )
    given = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    paths = os.pathsep.join(os.path.abspath(entry) for entry in [*filter(None, given), *sys.path])
    command = [sys.executable, "-P", isolated.__file__, str(os.getpid()), str(program), *arguments]
    try:
        return subprocess.Popen(
            command, env={**os.environ, **(environment or {}), "PYTHONPATH": paths}, text=True, **streams
        )
    except OSError as error:
        raise IoError(f"{place}: cannot start {sys.executable} ({error.strerror}); {remedy}", "cannot_start") from error


def reason(code: int) -> str:
    """The signal that ended a process, and what that most likely means. code: as of subprocess, negative."""
    name = signal.Signals(-code).name
    why = "most likely memory ran out" if name == "SIGKILL" else "a defect of octafield: please report this input"
    return f"{name}; {why}"


def _raise_interrupt(_number: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt


def _be_the_child(work: Callable[[], int], parent: int, reading: int, writing: int) -> None:
    for number in _ENDINGS:
        signal.signal(number, signal.SIG_DFL)
    isolated.become_a_part_of(parent)
    os.close(reading)
    on_staging(lambda path, alive: os.write(writing, os.fsencode(f"{'+' if alive else '-'}{path}\0")))
    code = DEFECT
    try:
        code = work()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)


def _stop(child: int) -> None:
    try:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
    except (ProcessLookupError, ChildProcessError):
        pass
    if sys.stderr.isatty():
        sys.stderr.write("\x1b[?25h\n")  # the child's progress bar had hidden the cursor


def _remove_staging(reading: int) -> None:
    """The child is gone: every folder it announced with + and did not take back with - is left over."""
    os.set_blocking(reading, False)  # a mesher the child had started may hold the other end a moment longer
    with os.fdopen(reading, "rb") as pipe:
        announced = os.fsdecode(pipe.read() or b"").split("\0")[:-1]
    for path in {entry[1:] for entry in announced if entry[0] == "+"} - {e[1:] for e in announced if e[0] == "-"}:
        shutil.rmtree(Path(path), ignore_errors=True)
