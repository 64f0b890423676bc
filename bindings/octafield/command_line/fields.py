"""The command line: octafield compare, field, surface-field; study, convert, analyse, info, view, doctor,
representations are elsewhere."""

import math
import sys
from pathlib import Path
from typing import Annotated, Any

import typer

from ..files.process import run_supervised
from ..options import (
    ALIGNMENTS,
    BOUNDARIES,
    METHODS,
    OF_A_START,
    REPRESENTATIONS,
    SOLVERS,
    FieldOptions,
    SurfaceFieldOptions,
)
from . import compare as compare_cli
from . import console, tables
from . import files as files_cli
from . import inspect as cli_inspect
from .console import carry_out, log
from .options import (
    ANGLE,
    EdgeLength,
    FeatureAngle,
    Features,
    InputFile,
    Interfaces,
    Json,
    MaxCells,
    MaxHoleEdges,
    Output,
    Quiet,
    Remesh,
    Repair,
    Sampling,
    Seed,
    Sizes,
    Split,
    SplitSingular,
    Threads,
    Verbose,
    WrapAlpha,
    WrapOffset,
    choices,
    mesh_options,
)
from .shell_completion import words
from .study import app as studies

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

_FIELD, _SURFACE = FieldOptions(), SurfaceFieldOptions()


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
def field(
    input: InputFile,
    output: Output,
    sampling: Sampling = _FIELD.sampling,
    representation: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            autocompletion=words(REPRESENTATIONS),
            help=(
                f"What is smoothed: {', '.join(REPRESENTATIONS)}. odeco: fourth-order tensors whose axes have length 1;"
                " odeco_lengths: their lengths are "
                "unknown, too (docs/frame_fields.md)."
            ),
        ),
    ] = _FIELD.representation,
    solver: Annotated[
        str,
        typer.Option(
            metavar="|".join(SOLVERS),
            autocompletion=words(SOLVERS),
            help="Of the smoothing; default: what goes with the representation.",
        ),
    ] = _FIELD.solver,
    boundary: Annotated[
        str,
        typer.Option(
            metavar=choices((*BOUNDARIES, OF_A_START)),
            autocompletion=words((*BOUNDARIES, OF_A_START)),
            help="aligned: twist free; fixed: whole frame held at the cross field; start: at --start.",
        ),
    ] = _FIELD.boundary,
    feature_tolerance: Annotated[
        float, typer.Option(metavar="DEG", help="How well one frame must fit a feature vertex to be held, degrees.")
    ] = round(math.degrees(_FIELD.feature_tolerance), 6),
    features: Features = _FIELD.features,
    feature_angle: FeatureAngle = ANGLE,
    edge_length: EdgeLength = _FIELD.edge_length,
    max_cells: MaxCells = _FIELD.max_cells,
    remesh: Remesh = _FIELD.remesh,
    repair: Repair = _FIELD.repair,
    max_hole_edges: MaxHoleEdges = _FIELD.max_hole_edges,
    wrap_alpha: WrapAlpha = _FIELD.wrap_alpha,
    wrap_offset: WrapOffset = _FIELD.wrap_offset,
    interfaces: Interfaces = _FIELD.interfaces,
    split: Split = _FIELD.split,
    split_singular: SplitSingular = _FIELD.split_singular,
    rounds: Annotated[int, typer.Option(metavar="K", help="Rounds of diffusion and polish.")] = _FIELD.rounds,
    streamlines: Annotated[
        int, typer.Option(metavar="N", help="Seeds of streamlines.vtp, three curves each; 0: none.")
    ] = _FIELD.streamlines,
    sizes: Sizes = _FIELD.sizes,
    start: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Smooth from the frames of a file (docs/formats.md); INPUT: their tet mesh."),
    ] = None,
    seed: Seed = _FIELD.seed,
    threads: Threads = _FIELD.threads,
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Frame field inside a closed surface or on a tet mesh. DIR gets field.vtu, singular.vtp, features.vtp,
    streamlines.vtp, result.json."""

    def work() -> None:
        from ..fields.frame_field import compute_field
        from ..files.writing import staged_folder
        from ..runs.frame_file_input import polish_file
        from ..runs.run_folder import RECORD_FILE, write_field_result

        options = FieldOptions(
            sampling=sampling,
            representation=representation,
            solver=solver,
            boundary=boundary,
            feature_tolerance=math.radians(feature_tolerance),
            rounds=rounds,
            streamlines=streamlines,
            sizes=sizes,
            split_singular=split_singular,
            seed=seed,
            threads=threads,
            **mesh_options(
                features,
                feature_angle,
                edge_length,
                remesh,
                repair,
                interfaces=interfaces,
                split=split,
                max_hole_edges=max_hole_edges,
                wrap_alpha=wrap_alpha,
                wrap_offset=wrap_offset,
                max_cells=max_cells,
            ),  # fmt: skip
        )
        with staged_folder(output, RECORD_FILE) as folder, console.progress_bar(quiet) as progress:
            result = (
                compute_field(input, options, progress)
                if start is None
                else polish_file(input, start, options, progress)
            )
            write_field_result(result, folder, progress)
        _finish(result.record, json, quiet, output)

    carry_out(work, quiet, verbose, json)


@app.command("surface-field")
def surface_field(
    input: InputFile,
    output: Output,
    symmetry: Annotated[
        int, typer.Option(metavar="N", help="N of the N-direction field; 4: crosses.")
    ] = _SURFACE.symmetry,
    method: Annotated[
        str,
        typer.Option(
            metavar=choices(METHODS),
            autocompletion=words(METHODS),
            help="gl: Ginzburg-Landau; mbo: diffusion, faster; eigen: smoothest eigenvector.",
        ),
    ] = _SURFACE.method,
    epsilon: Annotated[
        float, typer.Option(metavar="E", help="Coherence length, input unit; 0: from the edge length.")
    ] = _SURFACE.epsilon,
    boundary: Annotated[
        str,
        typer.Option(
            metavar=choices(ALIGNMENTS),
            autocompletion=words(ALIGNMENTS),
            help="How the field follows the rim of an open surface.",
        ),
    ] = _SURFACE.boundary,
    curvature: Annotated[
        float, typer.Option(metavar="WEIGHT", help="Pull towards the lines of curvature, 1 is usual; 0: none.")
    ] = _SURFACE.curvature,
    features: Features = _SURFACE.features,
    feature_angle: FeatureAngle = ANGLE,
    least_feature_angle: Annotated[
        float, typer.Option(metavar="DEG", help="Feature edges that bend by less are not followed, degrees.")
    ] = math.degrees(_SURFACE.least_feature_angle),
    edge_length: EdgeLength = _SURFACE.edge_length,
    max_cells: MaxCells = _SURFACE.max_cells,
    remesh: Remesh = _SURFACE.remesh,
    repair: Repair = _SURFACE.repair,
    max_hole_edges: MaxHoleEdges = _SURFACE.max_hole_edges,
    wrap_alpha: WrapAlpha = _SURFACE.wrap_alpha,
    wrap_offset: WrapOffset = _SURFACE.wrap_offset,
    seed: Seed = _SURFACE.seed,
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """N-direction field on a surface or a tet mesh's boundary. DIR gets surface.vtp, singular points,
    separatrices, result.json."""

    def work() -> None:
        from ..fields.direction_field import compute_surface_field
        from ..files.writing import staged_folder
        from ..runs.run_folder import RECORD_FILE, write_surface_result

        options = SurfaceFieldOptions(
            symmetry=symmetry,
            method=method,
            epsilon=epsilon,
            boundary=boundary,
            least_feature_angle=math.radians(least_feature_angle),
            curvature=curvature,
            seed=seed,
            **mesh_options(
                features,
                feature_angle,
                edge_length,
                remesh,
                repair,
                max_hole_edges=max_hole_edges,
                wrap_alpha=wrap_alpha,
                wrap_offset=wrap_offset,
                max_cells=max_cells,
            ),  # fmt: skip
        )
        with staged_folder(output, RECORD_FILE) as folder, console.progress_bar(quiet) as progress:
            result = compute_surface_field(input, options, progress)
            write_surface_result(result, folder, progress)
        _finish(result.record, json, quiet, output)

    carry_out(work, quiet, verbose, json)


def _finish(record: dict[str, Any], json: str | None, quiet: bool, output: Path) -> None:
    console.report_notes(record)
    if json:
        console.put_json(json, record)
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
