"""The commands on files of other programs: octafield convert, octafield analyse."""

from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from typing import Annotated

import typer

from ..errors import InvalidInput
from ..options import REPAIRS, SAMPLINGS, SIZES, FieldOptions, MeshOptions
from . import console, tables
from .console import carry_out, log
from .options import (
    EdgeLength,
    Json,
    MaxHoleEdges,
    Quiet,
    SplitSingular,
    Verbose,
    WrapAlpha,
    WrapOffset,
    choices,
    with_options,
)
from .shell_completion import words

_FIELD = FieldOptions()
MeshFile = Annotated[
    Path | None, typer.Option("--mesh", metavar="MESH", help="Tet mesh of the frames, where their file holds none.")
]
Format = Annotated[
    str | None,
    typer.Option(metavar="FORMAT", help="Of the frames, where the extension does not tell; see docs/formats.md."),
]


def register(app: typer.Typer) -> None:
    app.command()(convert)
    app.command()(analyse)


def convert(
    input: Annotated[Path, typer.Argument(metavar="INPUT", help="A mesh, a CAD model or a file of frames, also .gz.")],
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="OUTPUT", help="The file to write; its extension tells the kind.")
    ],
    mesh: MeshFile = None,
    source: Annotated[
        str | None,
        typer.Option("--from", metavar="FORMAT", help="Format of frames, where the extension does not tell."),
    ] = None,
    target: Annotated[
        str | None, typer.Option("--to", metavar="FORMAT", help="Format of frames, where the extension does not tell.")
    ] = None,
    at: Annotated[
        str | None, typer.Option(metavar=choices(SAMPLINGS), help="Where the frames shall be; else where they are.")
    ] = None,
    combed: Annotated[
        bool,
        typer.Option(
            "--combed",
            help=(
                "Axes correspond by number across all triangles but a cut; .npz gets all that a parameterization asks"
                " for."
            ),
        ),
    ] = False,
    edge_length: EdgeLength = 0.0,
    sizes: Annotated[
        str,
        typer.Option(
            metavar="|".join(SIZES),
            autocompletion=words(SIZES),
            help="Lengths of the axes that leave least curl, into the file.",
        ),
    ] = _FIELD.sizes,
    cell_edge: Annotated[
        str | None,
        typer.Option(
            metavar="LENGTH|auto",
            help="Edge of the cells to make, into the lengths of axes; auto: the mean edge of the tets.",
        ),
    ] = None,
    split_singular: SplitSingular = False,
    repair: Annotated[
        str,
        typer.Option(
            metavar=choices(REPAIRS),
            autocompletion=words(REPAIRS),
            help="Repair a surface, up to this level; every action is reported.",
        ),
    ] = "none",
    max_hole_edges: MaxHoleEdges = _FIELD.max_hole_edges,
    wrap_alpha: WrapAlpha = _FIELD.wrap_alpha,
    wrap_offset: WrapOffset = _FIELD.wrap_offset,
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """A mesh or a field from one kind of file to another. Features and regions go with it where the file holds them."""

    def work() -> None:
        from ..runs.conversion import convert_file

        done = convert_file(
            input,
            output,
            mesh=mesh,
            from_format=source,
            to_format=target,
            at=at,
            combed=combed,
            edge_length=edge_length,
            sizes=sizes,
            cell_edge=_cell_edge(cell_edge),
            split_singular=split_singular,
            repair=MeshOptions(
                repair=repair, max_hole_edges=max_hole_edges, wrap_alpha=wrap_alpha, wrap_offset=wrap_offset
            ),
        )
        for note in done.notes:
            log.info("%s: %s", input, note)
        if json:
            console.put_json(json, asdict(done))
        log.info("wrote %s", output)

    carry_out(work, quiet, verbose, json)


def _cell_edge(text: str | None) -> float | str | None:
    if text is None or text == "auto":
        return text
    try:
        return float(text)
    except ValueError:
        raise InvalidInput(f"--cell-edge {text!r} is neither a length nor 'auto'", "option_out_of_range") from None


@with_options(FieldOptions, only=("features", "feature_angle", "interfaces", "streamlines", "sizes", "threads"))
def analyse(
    field: Annotated[
        Path, typer.Argument(metavar="FIELD", help="A file of frames, also .gz; docs/formats.md lists the kinds.")
    ],
    options: Callable[[], FieldOptions],
    mesh: MeshFile = None,
    format: Format = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="DIR", help="Folder for the results; complete or absent.")
    ] = None,
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """A field that another program made, judged as our own. Singular curves, energy, alignment and meshability; DIR
    gets what `octafield field` writes of the volume."""

    def work() -> None:
        from ..files.writing import staged_folder
        from ..records.record_file import RECORD_FILE
        from ..runs.frame_file_input import analyse_file
        from ..runs.run_folder import write_analysis

        chosen = options() if output else replace(options(), streamlines=0)
        with console.progress_bar(quiet) as progress:
            result = analyse_file(field, mesh, format, chosen, progress)
            if output:
                with staged_folder(output, RECORD_FILE) as folder:
                    write_analysis(result, folder, progress)
        for note in result.record.notes:
            log.info("%s: %s", field, note)
        if json:
            console.put_json(json, result.record.to_dict())
        if json != "-" and not quiet:
            tables.show_record(result.record)
        if output:
            log.info("wrote %s", output)

    carry_out(work, quiet, verbose, json)
