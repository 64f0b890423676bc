"""Options of the pipeline. Defaults of numerical options are those of the C++ structs."""

import difflib
import math
import numbers
from collections.abc import Iterable
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from . import _core
from .errors import InvalidInput
from .schemes import OwnScheme, is_in_file, minimised, name_of

REPRESENTATIONS = tuple(_core.schemes)
COMPARED = tuple(name for name, scheme in _core.schemes.items() if scheme.compared)  # when a comparison is not told
# default: what goes with the representation.
SOLVERS = ("default", *dict.fromkeys(solver for scheme in _core.schemes.values() for solver in scheme.bytes_per_tet))
LINEAR_SOLVERS = tuple(_core.SmoothOptions.words["linear_solver"])
BOUNDARIES = tuple(_core.BoundaryOptions.words["mode"])
OF_A_START = "start"  # a treatment of the boundary that needs frames to start from
SAMPLINGS = ("vertices", "tets")
SIZES = ("none", "isotropic", "axes")
AXES = ("orthogonal", "free")
FEATURES = ("default", "file", "angle", "none")
REPAIR_LEVELS = ("none", "merge", "safe", "fill", "resolve", "wrap")  # each does what those before it do
REPAIRS = ("default", *REPAIR_LEVELS)
LARGEST_INT, LARGEST_SEED = 2**31 - 1, 2**64 - 1  # int and uint64 of the core
LARGEST_SYMMETRY = 1000  # largest_symmetry of direction_field.hpp
METHODS = dict(_core.direction_field_methods)  # with what each is
ALIGNMENTS = tuple(_core.DirectionFieldOptions.words["boundary_alignment"])
LINES_METHODS = dict(_core.non_orthogonal_field_methods)  # with what each is
SECOND_LINES = tuple(_core.NonOrthogonalFieldOptions.words["second_line"])
EDGE_WEIGHTS = tuple(_core.NonOrthogonalFieldOptions.words["weights"])

# The structs of the compiled module, whose defaults are those of the classes below.
_BOUNDARY, _RECIPE, _SURFACE = _core.BoundaryOptions(), _core.FrameFieldOptions(), _core.DirectionFieldOptions()
_LINES = _core.NonOrthogonalFieldOptions()


def changed_options(options: "MeshOptions", *, of_mesh: bool) -> dict[str, Any]:
    """By name, those that are not at their defaults: all, or all but those of the mesh."""
    mesh = {option.name for option in fields(MeshOptions)}
    return {
        option.name: getattr(options, option.name)
        for option in fields(options)
        if (of_mesh or option.name not in mesh) and getattr(options, option.name) != option.default
    }


def require_one_of(name: str, value: str, allowed: Iterable[str]) -> None:
    allowed = list(allowed)
    if value not in allowed:
        raise InvalidInput(
            f"{name} {value!r} is not one of: {', '.join(allowed)}{did_you_mean(value, allowed)}",
            "unknown_option_value",
        )


def require_scheme(representation: str | OwnScheme) -> None:
    """Reads the file where it is FILE.py:NAME. Raises InvalidInput, IoError."""
    if is_in_file(representation):
        minimised(representation)
    elif not isinstance(representation, OwnScheme):
        if isinstance(representation, str) and ".py" in representation:
            raise InvalidInput(
                f"representation {representation!r} is not FILE.py:NAME, as ideas.py:bump_scheme",
                "unknown_option_value",
            )
        require_one_of("representation", representation, REPRESENTATIONS)


def did_you_mean(value: str, known: Iterable[str]) -> str:
    """ "; did you mean 'sh4'?" where a known word is near, else nothing."""
    near = difflib.get_close_matches(str(value), list(known), 1)
    return f"; did you mean {near[0]!r}?" if near else ""


def _require(condition: bool, message: str) -> None:
    if not condition:
        raise InvalidInput(message, "option_out_of_range")


def _make_integer(options: object, name: str, low: int, high: int, note: str = "") -> None:
    """Requires an integer in low .. high and keeps it as an int: numpy's integers are no JSON."""
    object.__setattr__(options, name, integer_in(name.replace("_", " "), getattr(options, name), low, high, note))


def _make_boolean(options: object, name: str) -> None:
    value = getattr(options, name)
    _require(isinstance(value, (bool, np.bool_)), f"{name} must be true or false, not {value!r}")
    object.__setattr__(options, name, bool(value))


def integer_in(name: str, value: Any, low: int, high: int, note: str = "") -> int:
    valid = isinstance(value, numbers.Integral) and low <= int(value) <= high
    _require(valid, f"{name} must be an integer in {low} .. {high}{note}, not {value!r}")
    return int(value)


@dataclass(frozen=True, kw_only=True, repr=False)
class MeshOptions:
    """From a file to the mesh the field is computed on.

    features: "file" (line cells of the file), "angle" (dihedral angle), "none",
        "default": file when it marks some, else angle.
    feature_angle: radians in (0, pi), between the normals of two triangles at a feature edge.
    edge_length: target of surface remeshing, input unit; 0: lengths that fit the shape (see remesh, size_field).
    max_cells: without an edge length, triangles and tets that those lengths may ask for; 0: 200,000.
    remesh: False keeps the triangles of a surface. Tet meshes are always kept as they are.
    repair: level of the repair of a surface before it is tested (octafield.surface.repair), each action recorded;
        "default": "merge" for STL, "none" otherwise. True stands for "safe", False for "none".
    max_hole_edges: level "fill" leaves holes of more edges open; 0: no bound.
    wrap_alpha, wrap_offset: of level "wrap", input unit; 0: 1/50 of the bounding-box diagonal, and 1/20 of that.
    interfaces: triangles between tets of different regions of the file hold the field as the boundary does.
    split: splits edges, triangles and tets inside that join the surface to itself (octafield.volume.split_locking).
    """

    features: str = "default"
    feature_angle: float = _core.FeatureOptions().angle
    edge_length: float = 0.0
    remesh: bool = True
    repair: str = "default"
    interfaces: bool = True
    split: bool = False
    max_hole_edges: int = 0
    wrap_alpha: float = 0.0
    wrap_offset: float = 0.0
    max_cells: int = 0

    def __repr__(self) -> str:
        changed = changed_options(self, of_mesh=True)
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in changed.items())})"

    def __post_init__(self) -> None:
        require_one_of("features", self.features, FEATURES)
        if isinstance(self.repair, (bool, np.bool_)):
            object.__setattr__(self, "repair", "safe" if self.repair else "none")
        require_one_of("repair", self.repair, REPAIRS)
        _make_integer(self, "max_hole_edges", 0, LARGEST_INT, " (0: no bound)")
        _make_integer(self, "max_cells", 0, LARGEST_INT, " (0: default)")
        for name in ("wrap_alpha", "wrap_offset"):
            _require(
                math.isfinite(getattr(self, name)) and getattr(self, name) >= 0,
                f"{name.replace('_', ' ')} must be positive and finite (0: default)",
            )
        for name in ("remesh", "interfaces", "split"):
            _make_boolean(self, name)
        _require(0 < self.feature_angle < math.pi, "the feature angle must lie between 0 and 180 degrees")
        _require(
            math.isfinite(self.edge_length) and self.edge_length >= 0,
            "the edge length must be positive and finite (0: default)",
        )
        _require(
            self.edge_length == 0 or self.max_cells == 0,
            "an edge length decides the number of cells: leave it or max_cells out",
        )

    def recorded(self) -> dict[str, Any]:
        """As records have them, by name."""
        return dict(vars(self))

    @property
    def cells(self) -> int:
        """max_cells, or what 0 stands for."""
        return self.max_cells or int(_core.RemeshOptions().max_cells)


@dataclass(frozen=True, kw_only=True, repr=False)
class SurfaceFieldOptions(MeshOptions):
    """Of an N-direction field on a surface: symmetry is N, method a key of
    octafield.surface.direction_field_methods, epsilon the coherence length (0: default).

    boundary_alignment, feature_alignment: how the field follows the rim of an open surface, and feature edges inside:
        "strong", "weak" (singular points may sit there), "none".
    least_feature_angle: radians; feature edges inside the surface that bend by less are not followed (0: all are).
    curvature: pull towards the lines of curvature, 0 (none) or more; symmetry must be even. 1 lets the field follow
        them over lengths of a tenth of octafield.surface.shape_size, 100 over a hundredth; where the two principal
        curvatures are alike it pulls less (weight = curvature * octafield.surface.principal_directions().anisotropy).
    """

    symmetry: int = _SURFACE.symmetry
    method: str = _SURFACE.method
    epsilon: float = _SURFACE.epsilon
    boundary_alignment: str = _SURFACE.boundary_alignment
    feature_alignment: str = _SURFACE.feature_alignment
    least_feature_angle: float = _SURFACE.least_feature_angle
    curvature: float = 0.0
    seed: int = 0

    def __post_init__(self) -> None:
        super().__post_init__()
        require_one_of("method", self.method, METHODS)
        require_one_of("boundary_alignment", self.boundary_alignment, ALIGNMENTS)
        require_one_of("feature_alignment", self.feature_alignment, ALIGNMENTS)
        _make_integer(self, "symmetry", 1, LARGEST_SYMMETRY)
        _require(math.isfinite(self.epsilon) and self.epsilon >= 0, "epsilon must be positive and finite (0: default)")
        _require(
            math.isfinite(self.least_feature_angle) and 0 <= self.least_feature_angle < math.pi,
            "the least feature angle must lie between 0 and 180 degrees",
        )
        _require(
            math.isfinite(self.curvature) and 0 <= self.curvature <= 1e9,
            "the weight of curvature must lie between 0 and 1e9",
        )
        _require(
            self.curvature == 0 or self.symmetry % 2 == 0,
            "lines of curvature have no sense to run in: curvature needs an even symmetry",
        )
        _make_integer(self, "seed", 0, LARGEST_SEED)


@dataclass(frozen=True, kw_only=True, repr=False)
class NonOrthogonalOptions(MeshOptions):
    """Of a field of two lines at any angle on a surface: a key of octafield.surface.non_orthogonal_field_methods and
    the other options of octafield.surface.non_orthogonal_field, which says what they are. Angles are radians. inertia,
    penalty and tolerance are of the method "projected", least_angle of free lines: elsewhere they would be ignored.

    Raises InvalidInput.

        >>> from octafield.options import NonOrthogonalOptions
        >>> NonOrthogonalOptions(second_line="free", remesh=False)
        NonOrthogonalOptions(remesh=False, second_line='free')
    """

    method: str = _LINES.method
    second_line: str = _LINES.second_line
    corner_angle: float = _LINES.corner_angle
    least_angle: float = _LINES.least_angle
    lambda_: float = _LINES.lambda_
    weights: str = _LINES.weights
    max_iterations: int = _LINES.max_iterations
    inertia: float = _LINES.inertia
    penalty: float = _LINES.penalty
    tolerance: float = _LINES.tolerance
    seed: int = _LINES.seed

    def __post_init__(self) -> None:
        super().__post_init__()
        require_one_of("method", self.method, LINES_METHODS)
        require_one_of("second_line", self.second_line, SECOND_LINES)
        require_one_of("weights", self.weights, EDGE_WEIGHTS)
        _require(0 < self.corner_angle < math.pi / 2, "the corner angle must lie between 0 and 90 degrees")
        _require(0 < self.least_angle < math.pi / 4, "the least angle must lie between 0 and 45 degrees")
        _require(math.isfinite(self.lambda_) and self.lambda_ > 0, "lambda must be positive")
        for name in ("inertia", "penalty", "tolerance"):
            _require(math.isfinite(getattr(self, name)) and getattr(self, name) >= 0, f"{name} must not be negative")
        _make_integer(self, "max_iterations", 1, LARGEST_INT)
        _make_integer(self, "seed", 0, LARGEST_SEED)
        changed = changed_options(self, of_mesh=False)
        unused = {"inertia", "penalty", "tolerance"} if self.method != "projected" else {"least_angle"}
        if self.second_line != "free":
            unused |= {"least_angle", "penalty"}
        if ignored := sorted(unused & changed.keys()):
            raise InvalidInput(
                f"{', '.join(ignored)} would be ignored by method {self.method!r} with second_line"
                f" {self.second_line!r}; leave that out",
                "ignored_options",
            )


@dataclass(frozen=True, kw_only=True, repr=False)
class FieldOptions(MeshOptions):
    """Of a frame field in a volume.

    sampling: where the frames live, "vertices" or "tets" (octafield.volume.tet_sampling; constraints, energy, singular
        edges, alignment and meshability are those of the tets then, and integrability is left out).
    boundary: "aligned" (one axis on the normal, twist free), "fixed" (frames held at the surface cross field), "none",
        or "start" (frames on the surface held at those of the start that compute_field is given).
    axes: of frames, "orthogonal", at right angles; or "free", along feature edges and both faces of those that are
        sharp, at whatever angle (octafield.volume.axes_stretch): then frames are rotations Q, and the axes are the
        columns of S Q with the stretch S of the result. For frames at vertices, without a start, sizes and
        odeco_lengths.
    feature_tolerance: radians; a vertex on a feature keeps its whole frame when one frame fits all its normals and
        tangents so well (octafield.volume.boundary_constraints).
    seed: of every random start; other than 0, the frame field's start is random too. threads: 0 means all; results do
    not depend on it. representation, solver: what the last smoothing minimises and how: a key of
    octafield.volume.schemes, an EmbeddingScheme or EdgeScheme, or "FILE.py:NAME" of one; rounds, max_iterations,
    tolerance, linear_solver, midpoint_limit, round_time, first_time, last_time, time_exponent, max_steps,
    linear_tolerance: see octafield.volume.frame_field; a start that is given is smoothed only, so that those of rounds
    and of the heat flow do nothing then. streamlines: so many seeds of curves along the three axes, spread over the
    volume (octafield.volume.spread_points), go into streamlines.vtp; 0: none. sizes: lengths of the axes for which the
    field is closest to the gradients of a map, "isotropic" (one for all three, octafield.volume.isotropic_scale) or
    "axes" (octafield.volume.axis_scales); "none": not computed.
    split_singular: with sampling "tets"; edges inside that join singular vertices without being singular are split
        after the field is found (octafield.volume.split_between_singular): tets are more than those it was computed on,
        each with the frame of the tet it is part of.

    Raises InvalidInput.

        >>> import octafield
        >>> octafield.FieldOptions(boundary="fixed", edge_length=0.5)
        FieldOptions(edge_length=0.5, boundary='fixed')
        >>> octafield.FieldOptions(representation="sh5")  # doctest: +ELLIPSIS
        Traceback (most recent call last):
            ...
        octafield.InvalidInput: representation 'sh5' is not one of: ...
    """

    sampling: str = "vertices"
    representation: str | OwnScheme = _RECIPE.smooth.representation
    solver: str = _RECIPE.smooth.solver
    boundary: str = _BOUNDARY.mode
    axes: str = AXES[0]
    feature_tolerance: float = _BOUNDARY.feature_tolerance
    seed: int = 0
    threads: int = 0
    rounds: int = _RECIPE.rounds
    max_iterations: int = _RECIPE.smooth.max_iterations
    tolerance: float = _RECIPE.smooth.tolerance
    linear_solver: str = _RECIPE.smooth.linear_solver
    midpoint_limit: float = _RECIPE.smooth.midpoint_limit
    round_time: float = _RECIPE.round_time
    first_time: float = _RECIPE.diffuse.first_time
    last_time: float = _RECIPE.diffuse.last_time
    time_exponent: float = _RECIPE.diffuse.time_exponent
    max_steps: int = _RECIPE.diffuse.max_steps
    linear_tolerance: float = _RECIPE.diffuse.linear_tolerance
    streamlines: int = 30
    sizes: str = "none"
    split_singular: bool = False

    def __post_init__(self) -> None:
        super().__post_init__()
        require_one_of("sampling", self.sampling, SAMPLINGS)
        _make_boolean(self, "split_singular")
        _require(
            self.sampling == "tets" or not self.split_singular,
            "singular edges are split by frames in the tets: split_singular (--split-singular) needs sampling 'tets'"
            " (--sampling tets)",
        )
        require_scheme(self.representation)
        require_one_of("solver", self.solver, SOLVERS)
        require_one_of("boundary", self.boundary, (*BOUNDARIES, OF_A_START))
        require_one_of("sizes", self.sizes, SIZES)
        require_one_of("axes", self.axes, AXES)
        if self.axes == "free":
            self._require_free_axes()
        _require(0 <= self.feature_tolerance <= math.pi / 2, "the feature tolerance must lie between 0 and 90 degrees")
        _make_integer(self, "seed", 0, LARGEST_SEED)
        _make_integer(self, "threads", 0, LARGEST_INT, " (0: all)")
        _make_integer(self, "rounds", 0, LARGEST_INT)
        _make_integer(self, "max_iterations", 0, LARGEST_INT)
        _make_integer(self, "streamlines", 0, LARGEST_INT)
        _require(math.isfinite(self.tolerance) and self.tolerance >= 0, "the tolerance must not be negative")
        require_one_of("linear_solver", self.linear_solver, LINEAR_SOLVERS)
        _require(self.midpoint_limit > 0, "the midpoint limit must be positive (infinity: none)")
        _make_integer(self, "max_steps", 0, LARGEST_INT)
        for name in ("round_time", "first_time", "last_time", "time_exponent", "linear_tolerance"):
            value = getattr(self, name)
            _require(math.isfinite(value) and value > 0, f"{name.replace('_', ' ')} must be positive, not {value!r}")

    def _require_free_axes(self) -> None:
        for given, needed in (
            (self.sampling == "vertices", "frames at the vertices: leave out sampling 'tets'"),
            (self.boundary != OF_A_START, "the boundary's own frames: a start has axes at right angles"),
            (self.scheme_name != "odeco_lengths", "axes without lengths of their own: leave out 'odeco_lengths'"),
            (self.sizes == "none", "no sizes, which are found for axes at right angles: leave them out"),
        ):
            if not given:
                raise InvalidInput(f"axes 'free' need {needed}, or take axes 'orthogonal'", "stretched_axes")

    def recorded(self) -> dict[str, Any]:
        given = self.representation
        return {**vars(self), "representation": given if isinstance(given, str) else given.name}

    @property
    def scheme_name(self) -> str:
        """Of what is minimised, as records and reports have it."""
        return name_of(self.representation)
