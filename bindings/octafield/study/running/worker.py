"""Runs of one group, one after the other, in a process of their own.

Speaks JSON lines: reads one job from standard input; writes to the file descriptor that its argument names {"event":
"ready"}, {"event": "prepared", "tets": n}, waits for a line (the leader's leave to use that much memory), then
{"event": "finished", "key": ...} for each run and "progress" between. Before it ends without having finished all:
"changed" (the input is no longer what was planned), "unwritable" (the folder) or "broken", each with a "message".
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
from typing import TYPE_CHECKING

from ..._core import TriangleMesh
from ...errors import Error, InvalidInput
from ...progress.phases import Progress
from ..plan import Run, Source, has_promised_content
from ..store import LOG_FILE, Store, write_failure, write_field

if TYPE_CHECKING:
    from ...fields.frame_field import FieldResult
    from ...hexdom.options import HexMeshOptions

_QUIET = 0.5  # seconds between reports
Prepared = Callable[[int], None]  # called with the number of tets before the first field
Finished = Callable[[str], None]  # called with each key that is finished


class InputChanged(InvalidInput):
    """The file of an input is gone or holds something else than when its runs were planned: their keys promise that."""


def execute(
    store: Store,
    runs: list[Run],
    keep_fields: bool,
    prepared: Prepared,
    finished: Finished,
    progress: Progress | None = None,
) -> None:
    """Runs of one group that are not finished yet. An error that the input or an option is at fault for is the run's
    result; InputChanged and IoError of the study's folder are raised."""
    from ...domain.meshing import prepare_mesh
    from ...fields.frame_field import prepare_field, run_field
    from ...runs.compared_meshes import of_one_length

    runs = [run for run in runs if not store.is_finished(run.key)]
    if not runs:
        return
    begin, error = time.time(), None
    try:
        meshed = prepare_mesh(_surface(runs[0].source), runs[0].options, progress=progress)
        problem = prepare_field(meshed, runs[0].options.seed, progress)
    except Error as raised:
        error = raised
    if not has_promised_content(runs[0]):  # asked after the reading: what was read is what the key stands for
        raise InputChanged(f"{runs[0].source}: not there, or changed since its runs were planned", "input_changed")
    if error:
        for run in runs:
            _write_failure(store, run, error, begin)
            finished(run.key)
        return
    prepared(meshed.volume().tet_count)
    cells = runs[0].hex_options and of_one_length(runs[0].hex_options, meshed.volume())
    for run in runs:
        begin, result = time.time(), None
        try:
            result = run_field(problem, run.options, progress)
        except Error as raised:
            _write_failure(store, run, raised, begin)
        if result is not None:
            _write_run(store, run, result, keep_fields, begin, cells, progress)
        finished(run.key)


def _surface(source: Source) -> str | TriangleMesh:
    from ...domain.generators import generate

    return source if isinstance(source, str) else generate(source["generator"], **source["with"])


def _write_run(
    store: Store,
    run: Run,
    result: "FieldResult",
    keep_fields: bool,
    begin: float,
    cells: "HexMeshOptions | None",
    progress: Progress | None,
) -> None:
    """cells: of the mesh along the field, which is made first."""
    from ...runs.compared_meshes import add_mesh
    from ...runs.run_folder import write_field_result

    with store.new_run(run) as folder:
        add_mesh(result, cells, folder if keep_fields else None, progress)
        if keep_fields:
            write_field_result(result, folder)
        notes = [f"{run.name}: {note}" for note in result.record.notes]
        if result.record.mesh is not None and result.record.mesh.error is not None:
            notes.append(f"no mesh along the field: {result.record.mesh.error}")
        lines = [*notes, f"{result.record.stop_reason} after {result.record.iterations} iterations"]
        (folder / LOG_FILE).write_text("\n".join(lines) + "\n", encoding="utf-8")
        write_field(folder, run, result.record, began=begin, ended=time.time(), host=os.uname().nodename)


def _write_failure(store: Store, run: Run, error: Error, begin: float) -> None:
    with store.new_run(run) as folder:
        (folder / LOG_FILE).write_text("".join(traceback.format_exception(error)), encoding="utf-8")
        kind = {"error": type(error).__name__, "error_kind": getattr(error, "kind", "")}
        times = {"began": begin, "ended": time.time(), "host": os.uname().nodename}
        write_failure(folder, run, "failed", str(error), **kind, **times)


def main() -> None:
    logging.disable()
    out = os.fdopen(int(sys.argv[1]), "w", buffering=1)
    job = json.loads(sys.stdin.readline())
    reported = 0.0

    def tell(**event: str | float) -> None:
        print(json.dumps(event), file=out)

    tell(event="ready")
    runs = [Run.from_json(content) for content in job["runs"]]

    def prepared(tets: int) -> None:
        tell(event="prepared", tets=tets)
        if not sys.stdin.readline():
            sys.exit(1)  # the leader is gone

    def report(phase: str, fraction: float, merit: float) -> None:
        nonlocal reported
        now = time.monotonic()
        if now - reported > _QUIET:
            reported = now
            tell(event="progress", phase=phase, fraction=fraction)

    def finished(key: str) -> None:
        tell(event="finished", key=key)

    with contextlib.suppress(BrokenPipeError):
        try:
            execute(Store(Path(job["folder"])), runs, job["keep_fields"], prepared, finished, report)
        except InputChanged as error:
            tell(event="changed", message=str(error))
        except MemoryError:
            tell(event="broken", message="memory ran out")
            raise
        except BrokenPipeError:
            pass
        except OSError as error:
            tell(event="unwritable", message=str(error))
        except Exception as error:
            tell(event="broken", message=f"{type(error).__name__}: {error}")
            raise


if __name__ == "__main__":
    main()
