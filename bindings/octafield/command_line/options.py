"""The options that several commands share: name, placeholder and help."""

import math
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any

import typer

from ..errors import InvalidInput
from ..options import FEATURES, REPAIRS, SAMPLINGS, SIZES, MeshOptions
from .shell_completion import words

ANGLE = round(math.degrees(MeshOptions().feature_angle), 6)


def choices(values: Iterable[str]) -> str:
    return "|".join(value for value in values if value != "default")


def named_files(words: Iterable[str]) -> dict[str, Path]:
    """Of NAME=FILE; InvalidInput otherwise, and where a name comes twice."""
    found: dict[str, Path] = {}
    for word in words:
        name, between, file = word.partition("=")
        if not (between and name and file):
            raise InvalidInput(f"--field {word}: give it as NAME=FILE", "bad_name")
        if name in found:
            raise InvalidInput(f"--field {word}: the name {name} is there already", "repeated_value")
        found[name] = Path(file)
    return found


def mesh_options(
    features: str, feature_angle: float, edge_length: float, remesh: bool, repair: str, **others: Any
) -> dict[str, Any]:
    return {
        **others,
        "features": features,
        "feature_angle": math.radians(feature_angle),
        "edge_length": edge_length,
        "remesh": remesh,
        "repair": repair,
    }


InputFile = Annotated[
    str,
    typer.Argument(
        metavar="INPUT",
        help=(
            "Surface (.stl .obj .off .ply .vtp), CAD model (.step .brep) or tet mesh (.vtk .vtu .msh .mesh .ovm"
            " .node/.ele), also .gz."
        ),
    ),
]
InputFiles = Annotated[
    list[str] | None, typer.Argument(metavar="[INPUT]...", help="Surfaces or tet meshes; none: the nut of pyvista.")
]
Output = Annotated[
    Path, typer.Option("-o", "--output", metavar="DIR", help="Folder for the results; complete or absent.")
]
Json = Annotated[str | None, typer.Option("--json", metavar="FILE", help="Write the figures as JSON; - is stdout.")]
Features = Annotated[
    str,
    typer.Option(
        metavar=choices(FEATURES),
        autocompletion=words(FEATURES),
        help="Source of feature edges; default: file when it marks some, else angle.",
    ),
]
FeatureAngle = Annotated[float, typer.Option(metavar="DEG", help="Angle between normals at a feature edge, degrees.")]
EdgeLength = Annotated[
    float,
    typer.Option(metavar="LENGTH", help="Target edge length of remeshing, input unit; 0: lengths that fit the shape."),
]
MaxCells = Annotated[
    int, typer.Option(metavar="N", help="Without --edge-length: triangles and tets to stay within; 0: 200,000.")
]
Remesh = Annotated[bool, typer.Option("--remesh/--no-remesh", help="Remesh a surface, or keep its triangles.")]
Repair = Annotated[
    str,
    typer.Option(
        metavar=choices(REPAIRS),
        autocompletion=words(REPAIRS),
        help="Repair a surface first, up to this level; every action is reported. Default: merge for STL.",
    ),
]
MaxHoleEdges = Annotated[int, typer.Option(metavar="N", help="--repair fill leaves larger holes open; 0: no bound.")]
WrapAlpha = Annotated[
    float, typer.Option(metavar="LENGTH", help="--repair wrap bridges gaps narrower than this; 0: from the size.")
]
WrapOffset = Annotated[float, typer.Option(metavar="LENGTH", help="--repair wrap lies so far outside; 0: from alpha.")]
Interfaces = Annotated[
    bool, typer.Option("--interfaces/--no-interfaces", help="Follow the interfaces between regions of a tet mesh.")
]
Split = Annotated[bool, typer.Option("--split", help="Split inner edges and tets that join the surface to itself.")]
SplitSingular = Annotated[
    bool,
    typer.Option(
        "--split-singular",
        help="Split inner edges that join singular vertices without being singular; frames are in tets.",
    ),
]
Sampling = Annotated[
    str, typer.Option(metavar=choices(SAMPLINGS), autocompletion=words(SAMPLINGS), help="Where the frames live.")
]
Sizes = Annotated[
    str,
    typer.Option(
        metavar="|".join(SIZES),
        autocompletion=words(SIZES),
        help="Lengths of the axes that leave least curl, and that curl.",
    ),
]
Seed = Annotated[int, typer.Option(metavar="N", help="Seed of every random start.")]
Threads = Annotated[int, typer.Option(metavar="N", help="Threads; 0: all. Results do not depend on it.")]
Quiet = Annotated[bool, typer.Option("-q", "--quiet", help="Nothing but errors.")]
Verbose = Annotated[bool, typer.Option("-v", "--verbose", help="More log lines; traceback for defects.")]
