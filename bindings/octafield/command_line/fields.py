"""The command line: octafield compare, field, surface-field; study, convert, analyse, info, view, doctor,
representations are elsewhere."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import InvalidInput
from ..files.process import run_supervised
from ..layout.options import INADMISSIBLE
from ..options import FieldOptions, SurfaceFieldOptions
from . import compare as compare_cli
from . import console, tables
from . import files as files_cli
from . import hexdom as hexdom_cli
from . import inspect as cli_inspect
from . import quads as quads_cli
from .console import carry_out, log
from .options import InputFile, Json, Output, Quiet, Verbose, choices, with_options
from .shell_completion import words
from .study import app as studies

if TYPE_CHECKING:
    from ..fields.direction_field import SurfaceFieldResult
    from ..records.field import FieldRecord
    from ..records.surface_field import SurfaceFieldRecord

app = typer.Typer(
    name="octafield",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,  # plain help: tables of rich cut names of options at 80 columns
    help="Frame fields in volumes and on surfaces. Exit code: 0 done, 2 bad input or usage, 130 interrupted, 1 defect.",
)

app.add_typer(cli_inspect.app)
app.add_typer(studies, name="study")
files_cli.register(app)
compare_cli.register(app)
hexdom_cli.register(app)
quads_cli.register(app)


def _show_version(wanted: bool) -> None:
    if wanted:
        from ..progress.phases import octafield_version

        typer.echo(f"octafield {octafield_version()}")
        raise typer.Exit()


@app.callback()
def _options_of_all(
    version: Annotated[
        bool, typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version and exit.")
    ] = False,
) -> None:
    pass


@app.command()
@with_options(FieldOptions)
def field(
    input: InputFile,
    output: Output,
    options: Callable[[], FieldOptions],
    start: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Smooth from the frames of a file (docs/formats.md); INPUT: their tet mesh."),
    ] = None,
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Frame field inside a closed surface or on a tet mesh. DIR gets field.vtu, singular.vtp, features.vtp,
    streamlines.vtp, result.json."""

    def work() -> None:
        from ..fields.frame_field import compute_field
        from ..files.writing import staged_folder
        from ..records.record_file import RECORD_FILE
        from ..runs.frame_file_input import polish_file
        from ..runs.run_folder import write_field_result

        chosen = options()
        with staged_folder(output, RECORD_FILE) as folder, console.progress_bar(quiet) as progress:
            result = (
                compute_field(input, chosen, progress) if start is None else polish_file(input, start, chosen, progress)
            )
            write_field_result(result, folder, progress)
        _finish(result.record, json, quiet, output)

    carry_out(work, quiet, verbose, json)


@app.command("surface-field")
@with_options(SurfaceFieldOptions, without=("interfaces", "split"))
def surface_field(
    input: InputFile,
    output: Output,
    options: Callable[[], SurfaceFieldOptions],
    imposed: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help=(
                "The cross field that has just these singular points, .json or .csv: position (or vertex of INPUT) and"
                " index, in turns, or valence of each. Options of fields that are computed are refused."
            ),
        ),
    ] = None,
    corners: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="With --imposed: corners with other numbers of quads than by angle, .json or .csv: vertex and quads.",
        ),
    ] = None,
    inadmissible: Annotated[
        str,
        typer.Option(
            metavar=choices(INADMISSIBLE[1:]),
            autocompletion=words(INADMISSIBLE[1:]),
            help=(
                "With --imposed: where no field has the points in these places, refuse them, move them, or rotate the"
                " field."
            ),
        ),
    ] = INADMISSIBLE[1],
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """N-direction field on a surface or a tet mesh's boundary. DIR gets surface.vtp, singular points,
    separatrices, result.json."""

    def work() -> None:
        from ..files.writing import staged_folder
        from ..records.record_file import RECORD_FILE
        from ..runs.run_folder import write_surface_result

        chosen = options()
        if imposed is None and (corners is not None or inadmissible != INADMISSIBLE[1]):
            raise InvalidInput("corners and inadmissible belong to points that are imposed: add --imposed FILE",
                               "ignored_options")  # fmt: skip
        with staged_folder(output, RECORD_FILE) as folder, console.progress_bar(quiet) as progress:
            result: "SurfaceFieldResult"
            if imposed is None:
                from ..fields.direction_field import compute_surface_field

                result = compute_surface_field(input, chosen, progress)
            else:
                from ..layout.imposed import compute_imposed_field

                result = compute_imposed_field(
                    input, chosen, progress, singularities=imposed, corners=corners, inadmissible=inadmissible
                )
            write_surface_result(result, folder, progress)
        _finish(result.record, json, quiet, output)

    carry_out(work, quiet, verbose, json)


def _finish(record: "FieldRecord | SurfaceFieldRecord", json: str | None, quiet: bool, output: Path) -> None:
    console.report_notes(record)
    if json:
        console.put_json(json, record.to_dict())
    if json != "-" and not quiet:
        tables.show_record(record)
    log.info("wrote %s", output)


def main() -> None:
    """Entry point of the command `octafield`."""
    sys.exit(run_supervised(_run_app))


def _run_app() -> int:
    try:
        code = app(prog_name="octafield", standalone_mode=False)
    except SystemExit as stop:
        code = stop.code
    except Exception as error:  # of typer's parser: commands handle their own
        return console.usage_error(error, sys.argv[1:])
    return code if isinstance(code, int) else 0 if code is None else 1


if __name__ == "__main__":
    main()
