"""The options that several commands share: name, metavar and help."""

import functools
import inspect
import math
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import MISSING, Field, fields
from pathlib import Path
from types import MappingProxyType
from typing import Annotated, Any, TypeVar

import typer

from ..errors import InvalidInput
from ..meshes.registry import kinds_in_words
from ..options import (
    ALIGNMENTS,
    AXES,
    BOUNDARIES,
    EDGE_WEIGHTS,
    FEATURES,
    LINES_METHODS,
    METHODS,
    OF_A_START,
    REPAIRS,
    REPRESENTATIONS,
    SAMPLINGS,
    SECOND_LINES,
    SIZES,
    SOLVERS,
    MeshOptions,
)
from .shell_completion import words

_Options = TypeVar("_Options", bound=MeshOptions)


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


InputFile = Annotated[
    str,
    typer.Argument(
        metavar="INPUT",
        help=f"A {kinds_in_words('surface', 'tet mesh', 'CAD model').replace(' and ', ' or ')}.",
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

Representation = Annotated[
    str,
    typer.Option(
        metavar="NAME",
        autocompletion=words(REPRESENTATIONS),
        help=(
            f"What is smoothed: {', '.join(REPRESENTATIONS)}. odeco: fourth-order tensors whose axes have length 1;"
            " odeco_lengths: their lengths are "
            "unknown, too (docs/frame_fields.md). Or FILE.py:NAME, a scheme of your own (docs/own_schemes.md)."
        ),
    ),
]
Solver = Annotated[
    str,
    typer.Option(
        metavar="|".join(SOLVERS),
        autocompletion=words(SOLVERS),
        help="Of the smoothing; default: what goes with the representation.",
    ),
]
Boundary = Annotated[
    str,
    typer.Option(
        metavar=choices((*BOUNDARIES, OF_A_START)),
        autocompletion=words((*BOUNDARIES, OF_A_START)),
        help="aligned: twist free; fixed: whole frame held at the cross field; start: at --start.",
    ),
]
Axes = Annotated[
    str,
    typer.Option(
        metavar=choices(AXES),
        autocompletion=words(AXES),
        help="At right angles, or along both faces of sharp feature edges at whatever angle (docs/non_orthogonal.md).",
    ),
]
FeatureTolerance = Annotated[
    float, typer.Option(metavar="DEG", help="How well one frame must fit a feature vertex to be held, degrees.")
]
Rounds = Annotated[int, typer.Option(metavar="K", help="Rounds of diffusion and polish.")]
MaxIterations = Annotated[int, typer.Option(metavar="N", help="Steps of one smoothing at most.")]
Tolerance = Annotated[
    float, typer.Option(metavar="T", help="Smoothing ends when a step lowers the energy by less than this part of it.")
]
Streamlines = Annotated[int, typer.Option(metavar="N", help="Seeds of streamlines.vtp, three curves each; 0: none.")]
Symmetry = Annotated[int, typer.Option(metavar="N", help="N of the N-direction field; 4: crosses.")]
Method = Annotated[
    str,
    typer.Option(
        metavar=choices(METHODS),
        autocompletion=words(METHODS),
        help=f"{'; '.join(f'{name}: {meaning}' for name, meaning in METHODS.items())}.",
    ),
]
Epsilon = Annotated[float, typer.Option(metavar="E", help="Coherence length, input unit; 0: from the edge length.")]
BoundaryAlignment = Annotated[
    str,
    typer.Option(
        metavar=choices(ALIGNMENTS),
        autocompletion=words(ALIGNMENTS),
        help="How the field follows the rim of an open surface.",
    ),
]
FeatureAlignment = Annotated[
    str,
    typer.Option(
        metavar=choices(ALIGNMENTS),
        autocompletion=words(ALIGNMENTS),
        help="How the field follows feature edges inside the surface.",
    ),
]
Curvature = Annotated[
    float, typer.Option(metavar="WEIGHT", help="Pull towards the lines of curvature, 1 is usual; 0: none.")
]
LeastFeatureAngle = Annotated[
    float, typer.Option(metavar="DEG", help="Feature edges that bend by less are not followed, degrees.")
]
LinesMethod = Annotated[
    str,
    typer.Option(
        metavar=choices(LINES_METHODS),
        autocompletion=words(LINES_METHODS),
        help="With --non-orthogonal: descent by the angles; the loop of Dermine 2024; or linear, PolyVectors.",
    ),
]
SecondLine = Annotated[
    str,
    typer.Option(
        metavar=choices(SECOND_LINES),
        autocompletion=words(SECOND_LINES),
        help="With --non-orthogonal: on the boundary, linear from corner to corner; or found with the field.",
    ),
]
CornerAngle = Annotated[
    float,
    typer.Option(metavar="DEG", help="With --non-orthogonal: by which a corner of 1 or 3 quads is off 180 degrees."),
]
LeastAngle = Annotated[
    float, typer.Option(metavar="DEG", help="With --second-line free: lines stay so far from the boundary, degrees.")
]
Lambda = Annotated[
    float,
    typer.Option(
        "--lambda", metavar="L", help="With --non-orthogonal: what a change of the angle between lines costs."
    ),
]
Weights = Annotated[
    str,
    typer.Option(
        metavar=choices(EDGE_WEIGHTS), autocompletion=words(EDGE_WEIGHTS), help="With --non-orthogonal: of edges."
    ),
]
LinesIterations = Annotated[
    int, typer.Option(metavar="N", help="With --non-orthogonal: steps of the descent, or rounds, at most.")
]
Inertia = Annotated[
    float, typer.Option(metavar="TAU", help="With --lines-method projected: weight of the change in a round.")
]
Penalty = Annotated[
    float, typer.Option(metavar="B", help="With --lines-method projected: weight of the lengths of free lines.")
]
LinesTolerance = Annotated[
    float, typer.Option(metavar="T", help="With --lines-method projected: change at which rounds stop.")
]

# By the name of the field in the classes of options; a field that is not here is none of the command line.
PARAMETERS: dict[str, Any] = {
    "sampling": Sampling,
    "representation": Representation,
    "solver": Solver,
    "boundary": Boundary,
    "axes": Axes,
    "feature_tolerance": FeatureTolerance,
    "symmetry": Symmetry,
    "method": Method,
    "epsilon": Epsilon,
    "boundary_alignment": BoundaryAlignment,
    "feature_alignment": FeatureAlignment,
    "curvature": Curvature,
    "features": Features,
    "feature_angle": FeatureAngle,
    "least_feature_angle": LeastFeatureAngle,
    "edge_length": EdgeLength,
    "max_cells": MaxCells,
    "remesh": Remesh,
    "repair": Repair,
    "max_hole_edges": MaxHoleEdges,
    "wrap_alpha": WrapAlpha,
    "wrap_offset": WrapOffset,
    "interfaces": Interfaces,
    "split": Split,
    "split_singular": SplitSingular,
    "rounds": Rounds,
    "max_iterations": MaxIterations,
    "tolerance": Tolerance,
    "streamlines": Streamlines,
    "sizes": Sizes,
    "seed": Seed,
    "threads": Threads,
    "lines_method": LinesMethod,
    "second_line": SecondLine,
    "corner_angle": CornerAngle,
    "least_angle": LeastAngle,
    "lambda_": Lambda,
    "weights": Weights,
    "lines_iterations": LinesIterations,
    "inertia": Inertia,
    "penalty": Penalty,
    "lines_tolerance": LinesTolerance,
}
_IN_DEGREES = ("feature_angle", "feature_tolerance", "least_feature_angle", "corner_angle", "least_angle")


def _default(option: Field[Any]) -> Any:
    assert option.default is not MISSING
    return round(math.degrees(option.default), 6) if option.name in _IN_DEGREES else option.default


def _taken(option: Field[Any], value: Any) -> Any:
    """An option's value from the command line's. The default comes back as it is, whatever its digits in degrees."""
    if value == _default(option):
        return option.default
    return math.radians(value) if option.name in _IN_DEGREES else value


def with_options(
    kind: type[_Options],
    *,
    only: Collection[str] = (),
    without: Collection[str] = (),
    renamed: Mapping[str, str] = MappingProxyType({}),
    place: str = "options",
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Gives a command the options of a class as parameters, with their defaults, in place of its parameter `place`:
    that is called to make them, and raises InvalidInput then. renamed: the parameter's name by that of the option,
    where another class has an option of that name."""
    known = {renamed.get(option.name, option.name): option for option in fields(kind)}
    names = [name for name in PARAMETERS if name in known and name in (only or known) and name not in without]

    def decorated(command: Callable[..., None]) -> Callable[..., None]:
        @functools.wraps(command)
        def called(**given: Any) -> None:
            values = {name: given.pop(name) for name in names}

            def made() -> _Options:
                return kind(**{known[name].name: _taken(known[name], value) for name, value in values.items()})

            command(**{place: made}, **given)

        parameters = []
        for parameter in inspect.signature(command, eval_str=True).parameters.values():
            if parameter.name != place:
                parameters.append(parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY))
                continue
            for name in names:
                parameters.append(
                    inspect.Parameter(
                        name,
                        inspect.Parameter.KEYWORD_ONLY,
                        default=_default(known[name]),
                        annotation=PARAMETERS[name],
                    )
                )
        called.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        called.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
        return called

    return decorated
