"""What the command line says: log lines, progress and errors on stderr, JSON."""

import contextlib
import json
import logging
import math
import os
import sys
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path

import typer
from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

from .errors import Cancelled, Error, GeometryError, InvalidInput, IoError, SolverError
from .output import write_json

OK, DEFECT, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130
_REPAIRABLE = (
    "degenerate_triangle",
    "soup",
    "duplicate_vertex",
    "non_manifold_edge",
    "inconsistent_orientation",
    "not_closed",
    "inside_out",
)

# kinds of SolverError that another option or another mesh avoids
_OPTION_AT_FAULT = ("epsilon_too_large", "thin_triangles", "bad_weights")

log = logging.getLogger("octafield")


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
        hint = " (option --repair does this)" if error.kind in _REPAIRABLE and "repair the mesh" in str(error) else ""
        _say(f"error: {error}{hint}")
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


def carry_out(work: Callable[[], None], quiet: bool, verbose: bool, json: str | None) -> None:
    """Runs a command; an error becomes one line on stderr and an exit code."""
    set_verbosity(quiet, verbose)
    try:
        check_json_target(json)
        work()
    except typer.Exit:
        raise
    except (Exception, KeyboardInterrupt) as error:
        raise typer.Exit(error_code(error)) from None


def _say(message: str) -> None:
    print("octafield: " + " ".join(message.split()), file=sys.stderr, flush=True)


@contextlib.contextmanager
def progress_bar(quiet: bool) -> Iterator:
    """Yields a progress callback; draws on stderr when that is a terminal."""
    if quiet or not sys.stderr.isatty():
        yield None
        return
    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TextColumn("{task.fields[merit]}"),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=None, merit="")
        shown = ""

        def report(phase: str, fraction: float, merit: float) -> bool:
            nonlocal shown
            if phase != shown:
                bar.reset(task, description=phase, merit="")
                shown = phase
            bar.update(
                task,
                total=1.0 if fraction >= 0 else None,
                completed=max(fraction, 0.0),
                merit="" if math.isnan(merit) else f"{merit:.6g}",
            )
            return True

        yield report


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


def put_json(target: str, value) -> None:
    """Writes the JSON of a command to a file, or to stdout for "-"."""
    if target == "-":
        sys.stdout.write(json.dumps(value, indent=1, allow_nan=False) + "\n")
        return
    path = Path(target)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_json(path, value)
    except OSError as error:
        raise IoError(f"{target}: cannot write there ({error.strerror})") from error
