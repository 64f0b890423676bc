"""The commands that make something of a surface: octafield atlas."""

from collections.abc import Callable
from typing import Annotated

import typer

from .._core import AtlasOptions
from ..options import MeshOptions
from . import console, tables
from .console import carry_out
from .options import InputFile, Json, Output, Quiet, Verbose, with_options

_DEFAULTS = AtlasOptions()


def register(app: typer.Typer) -> None:
    app.command("atlas")(atlas)


@with_options(MeshOptions, without=("remesh", "edge_length", "max_cells", "interfaces", "split"))
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

    carry_out(work, quiet, verbose, json)
