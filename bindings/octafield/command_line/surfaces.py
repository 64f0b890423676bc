"""The commands that make something of a surface: octafield atlas, its charts, and remesh, other triangles."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from .._core import AtlasOptions
from ..options import MeshOptions
from ..remeshing.options import RemeshingOptions
from . import console, tables
from .console import carry_out
from .options import InputFile, Json, Output, Quiet, Verbose, with_options

_DEFAULTS = AtlasOptions()
_WITHOUT = ("edge_length", "max_cells", "remesh", "interfaces", "split")


def register(app: typer.Typer) -> None:
    app.command("atlas")(atlas)
    app.command("remesh")(remesh)


@with_options(MeshOptions, without=_WITHOUT)
def atlas(
    input: InputFile,
    output: Output,
    conformity: Annotated[
        float,
        typer.Option(
            metavar="C",
            help="Least ratio of the two stretches of a chart, but for 5 % of its area; 0: none is asked for.",
        ),
    ] = _DEFAULTS.conformity,
    max_triangles: Annotated[int, typer.Option(metavar="N", help="Of a chart.")] = _DEFAULTS.max_triangles,
    bisect: Annotated[
        bool,
        typer.Option("--bisect/--no-bisect", help="Halve long edges of coarse faces that miss the conformity."),
    ] = _DEFAULTS.bisect,
    options: Callable[[], MeshOptions] = MeshOptions,
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """One-to-one charts of a surface or a tet mesh's boundary. DIR gets charts.vtp, atlas.obj with
    texture coordinates, result.json."""

    def work() -> None:
        from dataclasses import replace

        from ..atlas.atlas import compute_atlas
        from ..atlas.files import write_atlas_result
        from ..files.writing import staged_folder
        from ..records.record_file import RECORD_FILE

        chosen = replace(options(), remesh=False)
        of_atlas = AtlasOptions(conformity=conformity, max_triangles=max_triangles, bisect=bisect)
        with staged_folder(output, RECORD_FILE) as folder, console.progress_bar(quiet) as progress:
            result = compute_atlas(input, chosen, progress, atlas_options=of_atlas)
            write_atlas_result(result, folder, progress)
        console.finish(result.record, tables.show_atlas_record, json, quiet, output)

    carry_out(work, quiet, verbose, json, output)


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
        float,
        typer.Option(
            metavar="Q", help="Of the worst triangle, 0 to 0.5: inscribed over circumscribed radius, times 2."
        ),
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

    carry_out(work, quiet, verbose, json, output)
