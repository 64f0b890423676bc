"""Commands that look and tell: info, representations, doctor, view."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from ..errors import InvalidInput
from ..options import MeshOptions
from . import console, tables
from .console import carry_out, log
from .options import InputFile, Json, Quiet, Verbose, with_options

app = typer.Typer()


@app.command()
@with_options(MeshOptions)
def info(
    input: InputFile,
    options: Callable[[], MeshOptions],
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """What a file holds, and whether it is fit for a field. Pass, warn or fail of each requirement, with the remedy;
    exit code 2 when one fails."""

    def work() -> None:
        from ..inspect.info import PASS, examine, first_failure

        chosen = options()
        record = examine(input, chosen)
        if json:
            console.put_json(json, record)
        unread = record["requirements"][0]["state"] != PASS
        if json != "-" and not quiet and not unread:
            tables.show_info(record)
        failure = first_failure(record)
        if not failure or chosen.repair not in ("default", "none"):  # an error is one line; the document has the notes
            for note in record["notes"]:
                log.info("%s: %s", record["input"], note)
        if failure:
            message = failure["message"] if str(input) in failure["message"] else f"{input}: {failure['message']}"
            raise InvalidInput(message, failure["kind"], failure["elements"])

    carry_out(work, quiet, verbose, json)


@app.command()
def representations(json: Json = None, quiet: Quiet = False, verbose: Verbose = False) -> None:
    """Names of representations and of metrics on frames. Options and functions take them."""

    def work() -> None:
        from ..frames import metrics
        from ..frames import representations as known

        record = {
            "representations": [
                {"name": r.name, "dimension": r.dimension, "speed": r.speed, "rotates_linearly": r.rotate is not None}
                for r in known.values()
            ],
            "metrics": [{"name": m.name, "speed": m.speed, "description": m.description} for m in metrics.values()],
        }
        if json:
            console.put_json(json, record)
        if json != "-" and not quiet:
            tables.show_registry(record)

    carry_out(work, quiet, verbose, json)


@app.command()
def doctor(json: Json = None, quiet: Quiet = False, verbose: Verbose = False) -> None:
    """Whether this installation works. Versions, libraries, cores, memory, and a small run of every part; exit code 1
    when one fails."""

    def work() -> None:
        from ..inspect.doctor import examine

        record = examine()
        if json:
            console.put_json(json, record)
        if json != "-" and not quiet:
            tables.show_doctor(record)
        if not record["ok"]:
            raise typer.Exit(console.DEFECT)

    carry_out(work, quiet, verbose, json)


@app.command()
def view(
    folder: Annotated[
        Path,
        typer.Argument(metavar="DIR", help="Folder that a command wrote which makes a field, a mesh or a layout."),
    ],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="PNG", help="Write a picture in place of opening a window.")
    ] = None,
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """A field's singular curves or points, or a mesh, drawn."""

    def work() -> None:
        from ..view.window import view_folder

        record = view_folder(folder, output)
        if json:
            console.put_json(json, record)
        if output is not None:
            log.info("wrote %s", output)

    carry_out(work, quiet, verbose, json)
