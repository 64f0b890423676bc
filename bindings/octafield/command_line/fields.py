"""The command line: octafield compare, field, surface-field; study, convert, analyse, info, view, doctor,
representations are elsewhere."""

import sys
from collections.abc import Callable
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import InvalidInput
from ..files.process import run_supervised
from ..layout.options import INADMISSIBLE
from ..options import FieldOptions, MeshOptions, NonOrthogonalOptions, SurfaceFieldOptions, changed_options
from . import compare as compare_cli
from . import console, tables
from . import files as files_cli
from . import hexdom as hexdom_cli
from . import inspect as cli_inspect
from . import quads as quads_cli
from . import surfaces as surfaces_cli
from .console import carry_out
from .options import InputFile, Json, Output, Quiet, Verbose, choices, with_options
from .shell_completion import words
from .study import app as studies

if TYPE_CHECKING:
    from ..fields.direction_field import FieldOnSurface

# Of fields of lines: what they share with crosses, and what has another meaning there.
_SHARED = (*(option.name for option in fields(MeshOptions)), "seed")
_OF_LINES = {"method": "lines_method", "max_iterations": "lines_iterations", "tolerance": "lines_tolerance"}

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
surfaces_cli.register(app)


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
        console.finish(result.record, tables.show_record, json, quiet, output)

    carry_out(work, quiet, verbose, json)


@app.command("surface-field")
@with_options(SurfaceFieldOptions, without=("interfaces", "split"))
@with_options(NonOrthogonalOptions, without=_SHARED, renamed=_OF_LINES, place="lines")
def surface_field(
    input: InputFile,
    output: Output,
    options: Callable[[], SurfaceFieldOptions],
    non_orthogonal: Annotated[
        bool,
        typer.Option(
            "--non-orthogonal",
            help=(
                "Two lines per point at any angle, which follow both sides of corners and of feature edges. Options of"
                " crosses are refused."
            ),
        ),
    ] = False,
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
            help=(
                "With --imposed or --non-orthogonal: corners with other numbers of quads than by angle, .json or .csv:"
                " vertex and quads."
            ),
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
    lines: Callable[[], NonOrthogonalOptions] = NonOrthogonalOptions,
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
        of_lines = _of_lines(chosen, lines(), non_orthogonal)
        _refuse_unused(non_orthogonal, imposed is not None, corners is not None, inadmissible != INADMISSIBLE[1])
        with staged_folder(output, RECORD_FILE) as folder, console.progress_bar(quiet) as progress:
            result: "FieldOnSurface"
            if of_lines is not None:
                from ..layout.non_orthogonal import compute_non_orthogonal_field

                result = compute_non_orthogonal_field(input, of_lines, progress, corners=corners)
            elif imposed is None:
                from ..fields.direction_field import compute_surface_field

                result = compute_surface_field(input, chosen, progress)
            else:
                from ..layout.imposed import compute_imposed_field

                result = compute_imposed_field(
                    input, chosen, progress, singularities=imposed, corners=corners, inadmissible=inadmissible
                )
            write_surface_result(result, folder, progress)
        console.finish(result.record, tables.show_record, json, quiet, output)

    carry_out(work, quiet, verbose, json)


def _of_lines(chosen: SurfaceFieldOptions, lines: NonOrthogonalOptions, wanted: bool) -> NonOrthogonalOptions | None:
    """Those of lines on the mesh that is chosen; None where crosses are wanted. What would be ignored is refused."""
    unused = changed_options(chosen if wanted else lines, of_mesh=False)
    if wanted:
        unused.pop("seed", None)
    if unused:
        words = ", ".join(f"{name}={value!r}" for name, value in unused.items())
        raise InvalidInput(
            f"{words} belongs to a field of crosses and would be ignored with --non-orthogonal; leave that out"
            if wanted
            else f"{words} belongs to a field of lines at any angle: add --non-orthogonal",
            "ignored_options",
        )
    if not wanted:
        return None
    of_mesh = {option.name: getattr(chosen, option.name) for option in fields(MeshOptions)}
    return replace(lines, **of_mesh, seed=chosen.seed)


def _refuse_unused(non_orthogonal: bool, imposed: bool, corners: bool, inadmissible: bool) -> None:
    if non_orthogonal and imposed:
        raise InvalidInput(
            "singular points are imposed on crosses: leave out --imposed or --non-orthogonal", "ignored_options"
        )
    if (corners and not (imposed or non_orthogonal)) or (inadmissible and not imposed):
        raise InvalidInput(
            "corners and inadmissible belong to points that are imposed: add --imposed FILE (or --non-orthogonal, which"
            " takes corners)",
            "ignored_options",
        )


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
