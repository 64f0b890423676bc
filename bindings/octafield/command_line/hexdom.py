"""The commands that make hexahedra: octafield hex-dominant, and hex-mesh."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..hexdom.options import CORRECTIONS, POINTS, HexMeshOptions
from ..hexmesh.options import FALLBACKS, WALLS
from ..options import FieldOptions
from . import console, tables
from .console import carry_out
from .options import InputFile, Json, Output, Quiet, Verbose, with_options
from .shell_completion import words

if TYPE_CHECKING:
    from ..records.hex_mesh import HexMeshRecord, SeamlessMapRecord

_DEFAULTS = HexMeshOptions()
# What has another meaning here, or none: lengths of the tets have names of their own.
_WITHOUT = ("edge_length", "axes", "sizes", "streamlines", "split_singular")


def register(app: typer.Typer) -> None:
    app.command("hex-dominant")(hex_dominant)
    app.command("hex-mesh")(hex_mesh)


@with_options(FieldOptions, without=_WITHOUT)
def hex_dominant(
    input: InputFile,
    output: Output,
    edge_length: Annotated[
        float, typer.Option(metavar="LENGTH", help="Wanted edge of the cells, input unit; 0: the tets' on the surface.")
    ] = 0.0,
    cells: Annotated[
        int, typer.Option(metavar="N", help="In its place: the edge of N cubes that fill the volume.")
    ] = 0,
    size: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="In its place: a number per vertex of INPUT, or rows x y z size; .npy or text.",
        ),
    ] = None,
    tet_length: Annotated[
        float,
        typer.Option(
            metavar="LENGTH",
            help="Edge of the tets that the field is computed on, where INPUT has none; 0: that of the cells.",
        ),
    ] = 0.0,
    field: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Frames of another program or run (docs/formats.md), on INPUT's tets, in place of computing them.",
        ),
    ] = None,
    correction: Annotated[
        str,
        typer.Option(
            metavar="|".join(CORRECTIONS),
            autocompletion=words(CORRECTIONS),
            help="How sizes give way to the turning of the field: not, alike along all axes, or along each.",
        ),
    ] = _DEFAULTS.correction,
    points: Annotated[
        str,
        typer.Option(
            metavar="|".join(POINTS),
            autocompletion=words(POINTS),
            help="Vertices of cells from a periodic map, a front from the surface inside, or the better of both.",
        ),
    ] = _DEFAULTS.points,
    options: Callable[[], FieldOptions] = FieldOptions,
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Hex-dominant mesh along a frame field. DIR gets mesh.vtu, mesh.msh, mesh.mesh, singular.vtp, result.json."""

    def work() -> None:
        from dataclasses import replace

        from ..files.writing import staged_folder
        from ..hexdom.files import write_hex_result
        from ..hexdom.hex_mesh import compute_hex_dominant
        from ..records.record_file import RECORD_FILE

        chosen = replace(options(), edge_length=tet_length)
        of_cells = HexMeshOptions(edge_length=edge_length, cells=cells, correction=correction, points=points)
        with staged_folder(output, RECORD_FILE) as folder, console.progress_bar(quiet) as progress:
            result = compute_hex_dominant(input, chosen, progress, hex_options=of_cells, sizes=size, field=field)
            write_hex_result(result, folder, progress)
        console.finish(result.record, tables.show_hex_record, json, quiet, output)

    carry_out(work, quiet, verbose, json, output)


@with_options(FieldOptions, without=_WITHOUT)
def hex_mesh(
    input: InputFile,
    output: Output,
    edge_length: Annotated[
        float,
        typer.Option(metavar="LENGTH", help="Wanted edge of the hexahedra, input unit; 0: mean edge of the boundary."),
    ] = 0.0,
    cells: Annotated[int, typer.Option(metavar="N", help="In its place: wanted number of hexahedra.")] = 0,
    walls: Annotated[
        str,
        typer.Option(
            metavar="|".join(WALLS),
            autocompletion=words(WALLS),
            help="That cut the map into blocks: the file's, or own ones where it has none; or own ones always.",
        ),
    ] = WALLS[0],
    tet_length: Annotated[
        float,
        typer.Option(
            metavar="LENGTH", help="Edge of the tets that the field is computed on, where INPUT has none; 0: what fits."
        ),
    ] = 0.0,
    fallback: Annotated[
        str,
        typer.Option(
            metavar="|".join(FALLBACKS),
            autocompletion=words(FALLBACKS),
            help="What a mesh becomes, along the same field, where its map does not become hexahedra.",
        ),
    ] = FALLBACKS[0],
    options: Callable[[], FieldOptions] = FieldOptions,
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Hexahedra alone, from a mesh or a seamless map. Of a mesh by a frame field and its map, of a .hexex file by the
    map in it. DIR gets mesh.vtu, mesh.msh, mesh.mesh, result.json; of a field seamless.hexex and seamless.json, too.
    Where the map does not become hexahedra, result.json says what stops it, and the mesh is hex-dominant."""

    def work() -> None:
        from dataclasses import replace

        from ..errors import InvalidInput
        from ..files.writing import staged_folder
        from ..hexmesh.files import write_hex_mesh_result
        from ..hexmesh.hex_mesh import compute_hex_mesh
        from ..hexmesh.hexex import is_seamless_map
        from ..hexmesh.stages import hex_mesh_of_field
        from ..records.record_file import RECORD_FILE

        chosen = replace(options(), edge_length=tet_length)
        given = is_seamless_map(input)
        if given and chosen != FieldOptions(threads=chosen.threads):
            raise InvalidInput("a map has its field; leave the options of fields out", "option_out_of_range")
        if given and fallback != FALLBACKS[0]:
            raise InvalidInput("a map has no field to fall back on; leave --fallback out", "ignored_option")
        with staged_folder(output, RECORD_FILE) as folder, console.progress_bar(quiet) as progress:
            told: HexMeshRecord | SeamlessMapRecord
            if given:
                result = compute_hex_mesh(
                    input, progress, cells=cells, edge_length=edge_length, walls=walls, threads=chosen.threads
                )
                write_hex_mesh_result(result, folder, progress)
                told = result.record
            else:
                told = hex_mesh_of_field(
                    input,
                    chosen,
                    folder,
                    progress,
                    cells=cells,
                    edge_length=edge_length,
                    walls=walls,
                    fallback=fallback,
                )
        console.finish(told, tables.show_hex_mesh_record, json, quiet, output)

    carry_out(work, quiet, verbose, json, output)
