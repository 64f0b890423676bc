"""The command line of studies: octafield study run, resume, status, report."""

import dataclasses
import functools
import inspect
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from . import console
from .console import carry_out, log
from .options import Json, Quiet, Verbose

if TYPE_CHECKING:
    from ..study import Status, Study
    from ..study.store import RunRecord

app = typer.Typer(no_args_is_help=True, help="Comparisons that a file describes. They go on after any interruption.")

Folder = Annotated[Path, typer.Argument(metavar="DIR", help="Folder of a study.")]
Jobs = Annotated[int, typer.Option(metavar="N", help="Processes at once; 0: one per core.")]
RunThreads = Annotated[
    int, typer.Option("--threads", metavar="N", help="Threads of each run; 0: all. Results do not depend on it.")
]
Memory = Annotated[
    float,
    typer.Option(metavar="GB", help="That all processes may be expected to need; 0: four fifths of the machine's."),
]
Scheduler = Annotated[
    str,
    typer.Option(metavar="ADDRESS", help="Dask scheduler whose workers do the runs; they must see DIR and the inputs."),
]
Patience = Annotated[
    float, typer.Option(metavar="S", help="Seconds to wait for a dask worker that can take what is left.")
]
Retry = Annotated[bool, typer.Option("--retry", help="Try runs that failed again.")]


def _running(described: Callable[..., "tuple[Study, Path]"]) -> Callable[..., None]:
    """A command that carries a study out, made of a function that gives the study and its folder: its parameters, and
    those of carrying out."""

    def called(
        *,
        jobs: Jobs = 0,
        threads: RunThreads = 1,
        memory: Memory = 0,
        scheduler: Scheduler = "",
        patience: Patience = 300,
        retry: Retry = False,
        json: Json = None,
        quiet: Quiet = False,
        verbose: Verbose = False,
        **given: Any,
    ) -> None:
        def work() -> None:
            from ..study.report import write_report
            from ..study.running.engine import run as run_study

            study, folder = described(**given)
            with console.progress_bar(quiet, whole=True) as progress:
                outcome = run_study(
                    study, folder, jobs=jobs, threads=threads, memory_mb=1000 * memory,
                    scheduler=scheduler, patience=patience, retry=retry, progress=progress,
                )  # fmt: skip
                if progress:
                    progress("report", -1.0, float("nan"))
                page = write_report(folder)
            log.info("%d runs now, %d before", len(outcome.computed), outcome.status.total - len(outcome.computed))
            _tell(outcome.status, folder, json, quiet)
            log.info("wrote %s", page)

        carry_out(work, quiet, verbose, json)

    own, common = (inspect.signature(function).parameters.values() for function in (described, called))
    parameters = [one.replace(kind=one.KEYWORD_ONLY) for one in (*own, *common) if one.kind != one.VAR_KEYWORD]
    functools.update_wrapper(called, described)
    called.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    called.__annotations__ = {one.name: one.annotation for one in parameters}
    return called


@app.command()
@_running
def run(
    description: Annotated[Path, typer.Argument(metavar="FILE", help="Description of the study (.yaml).")],
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="DIR", help="Folder of the study; an earlier one is continued.")
    ],
) -> "tuple[Study, Path]":
    """Carries out what DIR does not hold yet. Then writes report.html there."""
    from ..study.description import load

    return load(description), output


@app.command()
@_running
def resume(folder: Folder) -> "tuple[Study, Path]":
    """As run, with the description kept in DIR."""
    from ..study.store import Store

    return Store(folder).study(), folder


@app.command()
def status(folder: Folder, json: Json = None, quiet: Quiet = False, verbose: Verbose = False) -> None:
    """How many runs are done, failed, crashed and open. With --json also the records of the finished ones."""

    def work() -> None:
        from ..study import finished_runs as results

        _tell(results.status(folder), folder, json, quiet)

    carry_out(work, quiet, verbose, json)


@app.command()
def report(folder: Folder, json: Json = None, quiet: Quiet = False, verbose: Verbose = False) -> None:
    """Writes report.html and tables/ from the finished runs. With --json the document of status, and what was
    written."""

    def work() -> None:
        from ..study import finished_runs as results
        from ..study.report import write_report

        page = write_report(folder)
        if json:
            console.put_json(json, {**_document(results.status(folder), results.rows(folder)), "report": str(page)})
        log.info("wrote %s", page)

    carry_out(work, quiet, verbose, json)


def _document(status: "Status", rows: "list[RunRecord]") -> dict[str, Any]:
    return {**dataclasses.asdict(status), "runs": [row.to_dict() for row in rows]}


def _tell(status: "Status", folder: Path, json: str | None, quiet: bool) -> None:
    from ..study.finished_runs import rows

    known = rows(folder)
    if json:
        console.put_json(json, _document(status, known))
    if json != "-" and not quiet:
        typer.echo(f"{status.done} done, {status.failed} failed, {status.crashed} crashed, {status.open} open")
    for row in known:
        if row.state != "done":
            log.info("%s, %s: %s", row.input, row.options["representation"], row.message)
