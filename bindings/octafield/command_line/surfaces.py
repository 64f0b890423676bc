"""The command that makes other triangles of a surface: octafield remesh."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from ..options import MeshOptions
from ..remeshing.options import RemeshingOptions
from . import console, tables
from .console import carry_out
from .options import InputFile, Json, Quiet, Verbose, with_options

_WITHOUT = ("edge_length", "max_cells", "remesh", "interfaces", "split")


def register(app: typer.Typer) -> None:
    app.command("remesh")(remesh)


@with_options(MeshOptions, without=_WITHOUT)
def remesh(
    input: InputFile,
    output: Annotated[
        Path,
        typer.Option("-o", "--output", metavar="OUT", help="The surface file to write; its suffix tells the kind."),
    ],
    edge_length: Annotated[
        float, typer.Option(metavar="LENGTH", help="Of the triangles, input unit; 0: from --deviation.")
    ] = 0.0,
    vertices: Annotated[int, typer.Option(metavar="N", help="Wanted number of vertices, met within 5 %.")] = 0,
    curvature: Annotated[
        bool, typer.Option("--curvature", help="Short edges where the surface bends and where walls and gaps are thin.")
    ] = False,
    size: Annotated[
        str | None,
        typer.Option(
            metavar="FILE|growth=G",
            help=(
                "Edge lengths wanted, .npy or text: a number per vertex of INPUT, or rows x y z size. Or those of its"
                " boundary, plus G times the distance. With --vertices their ratios count."
            ),
        ),
    ] = None,
    deviation: Annotated[
        float,
        typer.Option(
            metavar="D", help="Between the surfaces at most, over the diagonal; 0: 0.001 where nothing else is told."
        ),
    ] = 0.0,
    quality: Annotated[
        float, typer.Option(metavar="Q", help="Of the worst triangle: inscribed over circumscribed radius, times 2.")
    ] = RemeshingOptions.quality,
    options: Callable[[], MeshOptions] = MeshOptions,
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Other triangles of a surface. Of wanted sizes and good shape, vertices on it, features
    kept."""

    def work() -> None:
        from ..remeshing.remesh import compute_remesh, require_surface_format

        require_surface_format(output)
        wanted = RemeshingOptions(
            edge_length=edge_length, vertices=vertices, curvature=curvature, deviation=deviation, quality=quality
        )
        with console.progress_bar(quiet) as progress:
            result = compute_remesh(input, options(), progress, remeshing=wanted, sizes=size)
        lost = result.write(output)
        record = result.record.changed(output=str(output), notes=[*result.record.notes, *lost])
        console.finish(record, tables.show_remesh_record, json, quiet, output)

    carry_out(work, quiet, verbose, json)
