"""Runs of one group, one after the other, in a process of their own.

Speaks JSON lines: reads one job from standard input; writes {"event": "prepared", "tets": n}, waits for a line (the leader's
leave to use that much memory), then {"event": "finished", "key": ...} for each run and "progress" between.
"""

import contextlib
import json
import logging
import os
import sys
import time
import traceback
from collections.abc import Callable
from pathlib import Path

from ..errors import Error
from ..phases import Progress
from .plan import Run
from .store import LOG_FILE, Store, write_record

Prepared = Callable[[int], None]  # called with the number of tets before the first field
Finished = Callable[[str], None]  # called with each key that is finished


def execute(store: Store, runs: list[Run], keep_fields: bool, prepared: Prepared, finished: Finished, progress: Progress | None = None) -> None:
    """Runs of one group that are not finished yet. An error that the input or an option is at fault for is the run's result."""
    from ..pipeline import prepare, prepare_mesh
    from ..pipeline import run as compute

    runs = [run for run in runs if not store.is_finished(run.key)]
    if not runs:
        return
    begin = time.time()
    try:
        meshed = prepare_mesh(_surface(runs[0].source), runs[0].options, progress=progress)
        problem = prepare(meshed, runs[0].options.seed, progress)
    except Error as error:
        for run in runs:
            _write_failure(store, run, error, begin)
            finished(run.key)
        return
    prepared(len(meshed.tets.tets))
    for run in runs:
        begin = time.time()
        try:
            _write_run(store, run, compute(problem, run.options, progress), keep_fields, begin)
        except Error as error:
            _write_failure(store, run, error, begin)
        finished(run.key)


def _surface(source):
    from .generators import generate

    return source if isinstance(source, str) else generate(source["generator"], **source["with"])


def _write_run(store: Store, run: Run, result, keep_fields: bool, begin: float) -> None:
    from ..results import write_field_result

    with store.new_run(run) as folder:
        if keep_fields:
            write_field_result(result, folder)
        notes = [f"{run.name}: {note}" for note in result.record["notes"]]
        lines = [*notes, f"{result.record['stop_reason']} after {result.record['iterations']} iterations"]
        (folder / LOG_FILE).write_text("\n".join(lines) + "\n", encoding="utf-8")
        times = {"began": begin, "ended": time.time(), "host": os.uname().nodename}
        write_record(folder, run, {**result.record, **times}, "done")


def _write_failure(store: Store, run: Run, error: Error, begin: float) -> None:
    with store.new_run(run) as folder:
        (folder / LOG_FILE).write_text("".join(traceback.format_exception(error)), encoding="utf-8")
        times = {"began": begin, "ended": time.time(), "host": os.uname().nodename}
        kind = {"error": type(error).__name__, "error_kind": getattr(error, "kind", "")}
        write_record(folder, run, {**kind, **times}, "failed", str(error))


def main() -> None:
    from ..supervise import die_with_parent

    die_with_parent()
    logging.disable()
    out = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)  # what libraries print goes to the log
    tell = lambda **event: print(json.dumps(event), file=out)
    job = json.loads(sys.stdin.readline())
    runs = [Run.from_json(content) for content in job["runs"]]

    def prepared(tets: int) -> None:
        tell(event="prepared", tets=tets)
        if not sys.stdin.readline():
            sys.exit(1)  # the leader is gone

    def report(phase: str, fraction: float, merit: float) -> None:
        now = time.monotonic()
        if now - report.last > 0.5:
            report.last = now
            tell(event="progress", phase=phase, fraction=fraction)

    report.last = 0.0
    with contextlib.suppress(BrokenPipeError):
        execute(Store(Path(job["folder"])), runs, job["keep_fields"], prepared, lambda key: tell(event="finished", key=key), report)


if __name__ == "__main__":
    main()
