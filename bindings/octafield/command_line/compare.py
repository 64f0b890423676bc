"""The command that compares: octafield compare."""

from collections.abc import Callable
from dataclasses import fields
from typing import Annotated

import typer

from ..hexdom.options import CORRECTIONS, MESHES, HexMeshOptions
from ..options import BOUNDARIES, COMPARED, REPRESENTATIONS, FieldOptions, MeshOptions
from . import console, tables
from .console import carry_out, log
from .options import InputFiles, Json, Output, Quiet, Verbose, choices, named_files, with_options
from .shell_completion import lists, words

# The rest is told by other parameters, or the same for all.
_CELLS = HexMeshOptions()
_OF_ALL = ("sampling", "sizes", "seed", "threads", *(option.name for option in fields(MeshOptions)))


def register(app: typer.Typer) -> None:
    app.command()(compare)


@with_options(FieldOptions, only=_OF_ALL)
def compare(
    inputs: InputFiles = None,
    output: Output = ...,  # type: ignore[assignment]
    options: Callable[[], FieldOptions] = FieldOptions,
    representations: Annotated[
        str,
        typer.Option(
            metavar="all|A,B",
            autocompletion=lists(REPRESENTATIONS, "all"),
            help=(
                f"Of: {', '.join(REPRESENTATIONS)}, or FILE.py:NAME, a scheme of your own; all: {', '.join(COMPARED)}."
            ),
        ),
    ] = "all",
    boundaries: Annotated[
        str, typer.Option(metavar="A,B", autocompletion=lists(BOUNDARIES), help=f"Of: {choices(BOUNDARIES)}.")
    ] = "fixed,aligned",
    given: Annotated[
        list[str] | None,
        typer.Option(
            "--field",
            metavar="NAME=FILE",
            help=(
                "A field of another program (docs/formats.md) beside the others, as it is and smoothed; may be"
                " repeated."
            ),
        ),
    ] = None,
    energies: Annotated[
        list[str] | None,
        typer.Option(
            "--energy",
            metavar="FILE.py:NAME",
            help="An energy of your own that judges all fields: a scheme or a function; may be repeated.",
        ),
    ] = None,
    seeds: Annotated[int, typer.Option(metavar="K", help="Seeds per run: --seed and the K - 1 numbers after it.")] = 1,
    starts: Annotated[
        str,
        typer.Option(
            metavar="A,B",
            autocompletion=lists(("sh4", "independent")),
            help=(
                "sh4: from its minimum; independent: each method for itself, from a linear solve (random for seeds"
                " above 0)."
            ),
        ),
    ] = "sh4",
    mesh: Annotated[
        str,
        typer.Option(
            metavar="|".join(MESHES),
            autocompletion=words(MESHES),
            help="A mesh along every field, in the folder of its run; the report ranks them.",
        ),
    ] = MESHES[0],
    cell_edge: Annotated[
        float, typer.Option(metavar="LENGTH", help="Wanted edge of its cells, input unit; 0: the tets' on the surface.")
    ] = 0.0,
    cells: Annotated[
        int, typer.Option(metavar="N", help="In its place: the edge of N cubes that fill the volume.")
    ] = 0,
    correction: Annotated[
        str,
        typer.Option(
            metavar="|".join(CORRECTIONS),
            autocompletion=words(CORRECTIONS),
            help="How sizes of cells give way to the turning of the field.",
        ),
    ] = _CELLS.correction,
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Representations and boundary treatments side by side. DIR gets report.html, results.json, a folder per run."""

    def work() -> None:
        from ..runs.compare import compare as run_comparison
        from ..runs.compare import default_input

        of_cells = HexMeshOptions(edge_length=cell_edge, cells=cells, correction=correction)
        chosen = COMPARED if representations == "all" else _listed(representations)
        with console.progress_bar(quiet, whole=True) as progress:
            comparison = run_comparison(
                inputs or [default_input()],
                output,
                representations=chosen,
                boundaries=_listed(boundaries),
                seeds=seeds,
                starts=_listed(starts),
                options=options(),
                fields=named_files(given or []),
                energies=energies or [],
                mesh=mesh,
                hex_options=None if of_cells == _CELLS else of_cells,
                progress=progress,
            )
        for record in {row.input: row for row in comparison.rows}.values():
            console.report_notes(record)
        if json:
            console.put_json(json, [row.to_dict() for row in comparison.rows])
        if json != "-" and not quiet:
            tables.show_comparison(comparison.rows)
        log.info("wrote %s", output / "report.html")

    carry_out(work, quiet, verbose, json)


def _listed(text: str) -> list[str]:
    return [word.strip() for word in text.split(",") if word.strip()]
