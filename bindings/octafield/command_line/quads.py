"""The commands that make quads: octafield quad-layout, in blocks, and quad-mesh, of wanted sizes."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from ..layout.options import BLOCKS, INADMISSIBLE, LAYOUTS, MEASURES, QuadLayoutOptions
from ..meshes.registry import kinds_in_words
from ..options import AXES, SurfaceFieldOptions
from ..quad_mesh.options import FOLLOW, FORMATS, QuadMeshOptions
from . import console, tables
from .console import carry_out, log
from .options import InputFile, Json, Output, Quiet, Verbose, choices, with_options
from .shell_completion import words

_DEFAULTS = QuadLayoutOptions()
PlaneInput = Annotated[
    str,
    typer.Argument(
        metavar="INPUT",
        help=(
            f"A {kinds_in_words('surface', 'tet mesh', 'CAD model')}, or the outline of a plane region: GeoJSON"
            " (.geojson, .json), Triangle (.poly), Gmsh (.geo)."
        ),
    ),
]
Quads = Annotated[
    int, typer.Option(metavar="N", help="Wanted number of quads; made is the nearest that whole numbers allow.")
]
QuadEdgeLength = Annotated[
    float,
    typer.Option(metavar="LENGTH", help="In its place: their mean edge, input unit; 0: that of the triangles."),
]
Inadmissible = Annotated[
    str,
    typer.Option(
        metavar=choices(INADMISSIBLE),
        autocompletion=words(INADMISSIBLE[1:]),
        help=(
            "Where no field has the singular points in these places: refuse them, move them, or rotate the field."
            " Default: move those of a computed field, fail with points of a file."
        ),
    ),
]
TriangleLength = Annotated[
    float,
    typer.Option(
        metavar="LENGTH",
        help="Edge of the triangles that the field is computed on, input unit; 0: lengths that fit the shape.",
    ),
]
# What has another meaning here, or none: lengths of the triangles have a name of their own.
_WITHOUT = ("edge_length", "symmetry", "boundary_alignment", "interfaces", "split")


def register(app: typer.Typer) -> None:
    app.command("quad-layout")(quad_layout)
    app.command("quad-mesh")(quad_mesh)
    app.command("report")(report)


@with_options(SurfaceFieldOptions, without=_WITHOUT)
def quad_layout(
    input: InputFile,
    output: Output,
    singularities: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help=(
                "The singular points, .json or .csv: position (or vertex of INPUT) and index, in turns, or valence of"
                " each. Default: those of a cross field that is computed."
            ),
        ),
    ] = None,
    corners: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Corners of the boundary with other numbers of quads than by angle, .json or .csv: vertex and quads.",
        ),
    ] = None,
    quads: Quads = 0,
    edge_length: QuadEdgeLength = 0.0,
    layout: Annotated[
        str,
        typer.Option(
            metavar=choices(LAYOUTS),
            autocompletion=words(LAYOUTS),
            help=(
                "Separatrices stop at one another and whole numbers fit the quads, along features too; or all of them"
                " run to their ends."
            ),
        ),
    ] = _DEFAULTS.layout,
    blocks: Annotated[
        str,
        typer.Option(
            metavar=choices(BLOCKS),
            autocompletion=words(BLOCKS),
            help="As few as keep quads good; or quads nearer to the lengths, in blocks that may be as small as quads.",
        ),
    ] = _DEFAULTS.blocks,
    measure: Annotated[
        str,
        typer.Option(
            metavar=choices(MEASURES),
            autocompletion=words(MEASURES),
            help="Quads as large as the field's own sizes are, or about as large as one another (t-mesh).",
        ),
    ] = _DEFAULTS.measure,
    axes: Annotated[
        str,
        typer.Option(
            metavar=choices(AXES),
            autocompletion=words(AXES),
            help="Of quads: at right angles, or along two lines at any angle, which follow both sides of corners.",
        ),
    ] = _DEFAULTS.axes,
    inadmissible: Inadmissible = "default",
    tolerance: Annotated[float, typer.Option(metavar="DEG", help="By how much places may be off, degrees.")] = round(
        math.degrees(_DEFAULTS.tolerance), 6
    ),
    end_tolerance: Annotated[
        float,
        typer.Option(
            metavar="D",
            help="Separatrices that miss a point by less are joined with its own, quad coordinates; 0: default.",
        ),
    ] = _DEFAULTS.end_tolerance,
    max_length: Annotated[
        float, typer.Option(metavar="L", help="Longest separatrix, quad coordinates; 0: default.")
    ] = _DEFAULTS.max_length,
    triangle_length: TriangleLength = 0.0,
    options: Callable[[], SurfaceFieldOptions] = SurfaceFieldOptions,
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Quads in blocks, from singular points. DIR gets mesh.vtu, mesh.msh, layout.vtp,
    field.vtp, result.json."""

    def work() -> None:
        from dataclasses import replace

        from ..files.writing import staged_folder
        from ..layout.files import write_layout_result
        from ..layout.quad_layout import compute_quad_layout
        from ..records.record_file import RECORD_FILE

        chosen = replace(options(), edge_length=triangle_length)
        of_quads = QuadLayoutOptions(
            quads=quads,
            edge_length=edge_length,
            layout=layout,
            blocks=blocks,
            measure=measure,
            axes=axes,
            inadmissible=inadmissible,
            tolerance=math.radians(tolerance),
            end_tolerance=end_tolerance,
            max_length=max_length,
        )
        with staged_folder(output, RECORD_FILE) as folder, console.progress_bar(quiet) as progress:
            result = compute_quad_layout(
                input, chosen, progress, layout_options=of_quads, singularities=singularities, corners=corners
            )
            write_layout_result(result, folder, progress)
        console.finish(result.record, tables.show_layout_record, json, quiet, output)

    carry_out(work, quiet, verbose, json, output)


@with_options(SurfaceFieldOptions, without=_WITHOUT)
def quad_mesh(
    input: PlaneInput,
    output: Output,
    quads: Quads = 0,
    edge_length: QuadEdgeLength = 0.0,
    size: Annotated[
        str | None,
        typer.Option(
            metavar="FILE|growth=G",
            help=(
                "Edge lengths wanted, .npy or text: a number per vertex of INPUT, or rows x y z size. Or those of its"
                " boundary, plus G times the distance. With --quads or --edge-length their ratios count."
            ),
        ),
    ] = None,
    field: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help=(
                "A cross field that quads follow, in place of a computed one: .vtp with data `direction`, or .npy, a"
                " direction per vertex or triangle of INPUT. Its singular points become irregular vertices."
            ),
        ),
    ] = None,
    follow: Annotated[
        str,
        typer.Option(
            metavar=choices(FOLLOW),
            autocompletion=words(FOLLOW[1:]),
            help="Of --field: its directions, or its singular points alone. Default: directions.",
        ),
    ] = "default",
    keep_boundary: Annotated[
        bool,
        typer.Option(
            "--keep-boundary",
            help="Every segment of a plane region's outline, or of a flat surface's boundary, is an edge of a quad.",
        ),
    ] = False,
    inadmissible: Inadmissible = "default",
    formats: Annotated[
        str, typer.Option(metavar="LIST", help=f"Of the quads, with commas: {', '.join(FORMATS)}.")
    ] = "vtu,obj",
    parameterization: Annotated[
        bool,
        typer.Option(
            "--parameterization",
            help="Also parameterization.obj: the surface's triangles with u, v (vt) whose whole numbers are the quads'"
            " lines.",
        ),
    ] = False,
    triangle_length: TriangleLength = 0.0,
    options: Callable[[], SurfaceFieldOptions] = SurfaceFieldOptions,
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Quads of wanted sizes along a cross field. DIR gets mesh.vtu, mesh.obj (or other formats),
    field.vtp, result.json."""

    def work() -> None:
        from dataclasses import replace

        from ..files.writing import staged_folder
        from ..quad_mesh.files import formats_of, write_quad_mesh_result
        from ..quad_mesh.quad_mesh import compute_quad_mesh
        from ..records.record_file import RECORD_FILE

        chosen = replace(options(), edge_length=triangle_length)
        of_quads = QuadMeshOptions(
            quads=quads,
            edge_length=edge_length,
            keep_boundary=keep_boundary,
            follow=follow,
            inadmissible=inadmissible,
        )
        written = formats_of(formats)
        with staged_folder(output, RECORD_FILE) as folder, console.progress_bar(quiet) as progress:
            result = compute_quad_mesh(input, chosen, progress, quad_options=of_quads, sizes=size, field=field)
            write_quad_mesh_result(result, folder, written, progress, parameterization)
        console.finish(result.record, tables.show_quad_mesh_record, json, quiet, output)

    carry_out(work, quiet, verbose, json, output)


def report(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="Folder that `quad-layout` wrote.")],
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """A page about a quad layout. Its blocks and quads drawn, its record as tables. DIR gets
    report.html, figures/, tables/. Reports of studies: octafield study report."""

    def work() -> None:
        from ..report.quad_layout import write_layout_report

        page = write_layout_report(folder)
        if json:
            console.put_json(json, {"folder": str(folder), "report": str(page)})
        log.info("wrote %s", page)

    carry_out(work, quiet, verbose, json)
