"""Runs the command line's work in a child process, so that an interrupt ends it at once whatever it is doing.

The parent only waits. On Ctrl-C it kills the child and removes the staging folders the child had open (writing.py). It
also turns a crash of the child into one message and an exit code.
"""

import ctypes
import os
import shutil
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from types import FrameType

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
    child = 0
    try:
        previous = {number: signal.signal(number, _raise_interrupt) for number in _ENDINGS}
        child = os.fork()
        if child == 0:
            _be_the_child(work, reading, writing)
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
    if os.WIFEXITED(status):
        return os.WEXITSTATUS(status)
    _remove_staging(reading)
    fatal = signal.Signals(os.WTERMSIG(status))
    hint = (
        "most likely memory ran out" if fatal == signal.SIGKILL else "a defect of octafield: please report this input"
    )
    print(f"octafield: stopped by signal {fatal.name}; {hint}", file=sys.stderr, flush=True)
    return DEFECT


def _raise_interrupt(_number: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt


def _be_the_child(work: Callable[[], int], reading: int, writing: int) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the terminal sends Ctrl-C to both; the parent decides
    for number in _ENDINGS:
        signal.signal(number, signal.SIG_DFL)
    die_with_parent()
    os.close(reading)
    on_staging(lambda path, alive: os.write(writing, os.fsencode(f"{'+' if alive else '-'}{path}\0")))
    code = DEFECT
    try:
        code = work()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)


def die_with_parent() -> None:
    try:
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG
    except (OSError, AttributeError):
        pass  # not Linux


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
