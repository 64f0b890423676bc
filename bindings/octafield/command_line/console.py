"""What the command line says: log lines, progress and errors on stderr, JSON."""

import contextlib
import json
import logging
import math
import os
import sys
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from datetime import timedelta
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer
from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, Task, TextColumn, TimeElapsedColumn

from ..errors import Cancelled, Error, GeometryError, InvalidInput, IoError, SolverError
from ..files.writing import write_json
from ..progress.phases import Progress as Callback

if TYPE_CHECKING:
    from ..records.field import InputRecord
    from ..records.hex_dominant import HexDominantRecord
    from ..records.hex_mesh import HexMeshRecord, SeamlessMapRecord
    from ..records.quad_layout import QuadLayoutRecord
    from ..records.quad_mesh import QuadMeshRecord
    from ..records.remesh import RemeshRecord

    Told = (
        InputRecord
        | HexDominantRecord
        | HexMeshRecord
        | SeamlessMapRecord
        | QuadLayoutRecord
        | QuadMeshRecord
        | RemeshRecord
    )

OK, DEFECT, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130
# kinds of SolverError that another option or another mesh avoids
_OPTION_AT_FAULT = (
    "epsilon_too_large", "thin_triangles", "bad_weights", "move_failed", "unresolved_turns", "unclear_directions",
    "folded_map", "inverted_quads", "inverted_cells", "conjugate_gradients",
)  # fmt: skip

log = logging.getLogger("octafield")
_written: list[str] = []  # targets of --json that have their document


def set_verbosity(quiet: bool, verbose: bool) -> None:
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(logging.Formatter("octafield: %(message)s"))
    log.handlers[:] = [handler]
    log.propagate = False
    log.setLevel(logging.ERROR if quiet else logging.DEBUG if verbose else logging.INFO)


def error_code(error: BaseException) -> int:
    """Reports an error in one line on stderr (with a traceback under -v where it is ours) and returns the exit code."""
    if isinstance(error, (KeyboardInterrupt, Cancelled)):
        _say("interrupted")
        return INTERRUPTED
    if isinstance(error, (InvalidInput, GeometryError, IoError)):
        _say(f"error: {error}")
        return BAD_INPUT
    if isinstance(error, SolverError) and error.kind in _OPTION_AT_FAULT:
        _say(f"error: {error}")
        return BAD_INPUT
    if isinstance(error, OSError):
        _say(f"error: {error.filename or 'file'}: {error.strerror or error}")
        return BAD_INPUT
    if log.isEnabledFor(logging.DEBUG):
        traceback.print_exception(error)
    what = str(error) if isinstance(error, Error) else f"{type(error).__name__}: {error}"
    _say(f"defect: {what}; please report this (run again with -v for details)")
    return DEFECT


def carry_out(
    work: Callable[[], None], quiet: bool, verbose: bool, json: str | None, output: Path | None = None
) -> None:
    """Runs a command; an error becomes one line on stderr, an exit code and, with --json, a document. output: the
    folder that it makes, which --json must not name."""
    set_verbosity(quiet, verbose)
    _written.clear()
    try:
        if json and json != "-" and output is not None and Path(json).absolute() == output.absolute():
            named, json = json, None  # nothing is written there
            raise InvalidInput(f"--json and -o are both {named}: give the figures a file of their own", "same_path")
        check_json_target(json)
        work()
    except typer.Exit:
        raise
    except (Exception, KeyboardInterrupt) as error:
        code = error_code(error)
        put_error(json, error, code)
        raise typer.Exit(code) from None


def usage_error(error: Exception, arguments: Sequence[str]) -> int:
    """Reports what typer's parser finds wrong as carry_out does errors. arguments: of the command line."""
    if not hasattr(error, "format_message"):
        return error_code(error)
    code = int(getattr(error, "exit_code", BAD_INPUT))
    context: Any = getattr(error, "ctx", None)
    if type(error).__name__ == "NoArgsIsHelpError":
        typer.echo(context.get_help(), err=True)
        return code
    near = getattr(error, "possibilities", None)
    message = error.format_message()
    if near:
        message = message.split(" (Possible")[0].rstrip(".") + f". Did you mean {near[0]}?"
    path = context.command_path if context else "octafield"
    _say(f"error: {message.rstrip('.')}" + ("" if message.endswith("?") else ".") + f" Try '{path} --help'.")
    put_error(_json_target(arguments), InvalidInput(message, "usage"), code)
    return code


def _json_target(arguments: Sequence[str]) -> str | None:
    for word, after in zip(arguments, [*arguments[1:], ""], strict=True):
        if word.startswith("--json="):
            return word.removeprefix("--json=")
        if word == "--json":
            return after or None
    return None


def put_error(target: str | None, error: BaseException, code: int) -> None:
    """The JSON document of a command that failed before it had one."""
    if target is None or target in _written:
        return
    told = {
        "type": type(error).__name__,
        "kind": getattr(error, "kind", ""),
        "message": " ".join(str(error).split()),
        "elements": [int(i) for i in getattr(error, "elements", [])],
        "exit_code": code,
    }
    with contextlib.suppress(Error):  # the target itself may be what is wrong
        check_json_target(target)
        put_json(target, {"error": told})


def _say(message: str) -> None:
    print("octafield: " + " ".join(message.split()), file=sys.stderr, flush=True)


def report_notes(record: "Told") -> None:
    for note in record.notes:
        log.info("%s: %s", record.input, note)


def finish(
    record: "Told",
    show: Callable[..., None],
    target: str | None,
    quiet: bool,
    output: Path,
) -> None:
    """What a command tells of the run that it wrote: notes, its JSON, a table by `show`, where it is."""
    report_notes(record)
    if target:
        put_json(target, record.to_dict())
    if target != "-" and not quiet:
        show(record)
    log.info("wrote %s", output)


@contextlib.contextmanager
def progress_bar(quiet: bool, whole: bool = False) -> Iterator[Callback | None]:
    """Yields a progress callback; None when quiet. Draws on stderr when that is a terminal, else writes a plain line
    there now and then. whole: what is reported is one piece of work; else phases, one after the other, whose fractions
    are of the most steps."""
    if quiet:
        yield None
    elif sys.stderr.isatty():
        with _drawn(whole) as report:
            yield report
    else:
        yield PlainLines(_say, whole)


@contextlib.contextmanager
def _drawn(whole: bool) -> Iterator[Callback]:
    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TextColumn("{task.fields[merit]}"),
        TimeElapsedColumn(),
        TextColumn("{task.fields[left]}"),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True, speed_estimate_period=_period(whole)) as bar:
        task = bar.add_task("", total=None, merit="", left="")
        shown = ""

        def report(phase: str, fraction: float, merit: float) -> bool:
            nonlocal shown
            if phase != shown and not whole:
                bar.reset(task, merit="", left="")
            shown = phase
            bar.update(
                task,
                description=phase,
                total=1.0 if fraction >= 0 else None,
                completed=fraction if fraction >= 0 else None,
                merit="" if math.isnan(merit) else f"{merit:.6g}",
            )
            bar.update(task, left=_left(bar.tasks[0], whole))
            return True

        yield report


def _period(whole: bool) -> float:
    """Seconds of the past that tell the speed: runs take long, and phases change their pace."""
    return math.inf if whole else 30.0


def _left(task: Task, whole: bool) -> str:
    """Empty while it is not known, and at the end."""
    seconds = task.time_remaining
    return "" if not seconds else f"{'about' if whole else 'at most'} {timedelta(seconds=seconds)} left"


class PlainLines:
    """A progress callback for logs: lines without control codes, the first after some seconds, then ever more
    rarely."""

    FIRST, GROWTH, LARGEST = 10.0, 1.5, 300.0  # seconds between lines

    def __init__(self, say: Callable[[str], None], whole: bool, clock: Callable[[], float] = time.monotonic):
        self._say, self._whole, self._clock = say, whole, clock
        self._wait, self._last, self._phase = self.FIRST, clock(), ""
        self._bar = Progress(disable=True, get_time=clock, speed_estimate_period=_period(whole))
        self._task = self._bar.add_task("", total=1.0)

    def __call__(self, phase: str, fraction: float, merit: float) -> bool:
        now = self._clock()
        if phase != self._phase and not self._whole:
            self._bar.reset(self._task)
        self._phase = phase
        self._bar.update(self._task, completed=fraction if fraction >= 0 else None)
        if now - self._last >= self._wait:
            share = "" if self._whole or fraction < 0 else f"{fraction:.0%} of the most steps"
            self._say(", ".join(filter(None, [phase, share, _left(self._bar.tasks[0], self._whole)])))
            self._last, self._wait = now, min(self._wait * self.GROWTH, self.LARGEST)
        return True


def check_json_target(target: str | None) -> None:
    """Raises IoError where put_json could not write, so that this is known before the work."""
    if target is None or target == "-":
        return
    path = Path(target)
    if path.is_dir():
        raise IoError(f"{target}: cannot write there (is a folder)")
    existing = path.absolute() if path.exists() else path.absolute().parent
    while not existing.exists():
        existing = existing.parent
    if not path.exists() and not existing.is_dir():
        raise IoError(f"{target}: cannot write there ({existing} is not a folder)")
    if not os.access(existing, os.W_OK):
        raise IoError(f"{target}: cannot write there (no permission)")


def put_json(target: str, value: Any) -> None:
    """Writes the JSON of a command to a file, or to stdout for "-"."""
    _written.append(target)
    if target == "-":
        sys.stdout.write(json.dumps(value, indent=1, allow_nan=False) + "\n")
        return
    path = Path(target)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_json(path, value)
    except OSError as error:
        raise IoError(f"{target}: cannot write there ({error.strerror})") from error
