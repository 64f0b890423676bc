"""The field of a run: by the whole recipe, or smoothed from frames that are given."""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from .._core import BoundaryConstraints, Sampling, SmoothResult, TetDomain, VertexConstraints
from ..domain.sites import fitting_frames
from ..errors import InvalidInput
from ..options import OF_A_START, FieldOptions
from ..progress.phases import Progress, forward
from ..schemes import minimised

_OF_SMOOTHING = (
    "representation",
    "solver",
    "max_iterations",
    "tolerance",
    "linear_solver",
    "midpoint_limit",
    "threads",
)
_OF_ROUNDS = ("rounds", "round_time", "first_time", "last_time", "time_exponent", "max_steps", "linear_tolerance")


def smoothed_field(
    tets: TetDomain,
    options: FieldOptions,
    where: TetDomain | Sampling,
    held: BoundaryConstraints,
    start: ArrayLike | None,
    seed: int,
    progress: Progress | None,
) -> tuple[SmoothResult, int]:
    """The field and how many steps of the heat flow came before. where: what the frames are smoothed on."""
    how: dict[str, Any] = {name: getattr(options, name) for name in _OF_SMOOTHING}
    how["representation"] = minimised(options.representation)
    how["progress"] = forward(progress, "smooth", 0.0, 1.0)
    try:
        if start is not None:
            return _finite(_core.smooth(where, held, fitting_frames(tets, start, options.sampling), **how), options), 0
        how |= {name: getattr(options, name) for name in _OF_ROUNDS}
        begin = "cross_field" if options.boundary == "none" else "constraints"
        found = _core.frame_field(where, held, start=begin, seed=seed, **how)
        return _finite(found.smooth, options), found.diffusion_steps
    except SystemExit as error:  # of a user's scheme: it would end a command as if it were done
        raise InvalidInput(
            f"scheme {options.scheme_name!r} calls sys.exit(); raise an error instead", "bad_scheme"
        ) from error


def _finite(found: SmoothResult, options: FieldOptions) -> SmoothResult:
    """Numbers of a user's scheme may be finite and their squares not: nothing was minimised then."""
    if not math.isfinite(found.objective):
        raise InvalidInput(
            f"scheme {options.scheme_name!r}: its energy is {found.objective}: the squares of its numbers are"
            " beyond a float64; give smaller numbers (lengths near 1)",
            "bad_scheme",
        )
    return found


def held_at_start(
    tets: TetDomain, options: FieldOptions, free: BoundaryConstraints, start: ArrayLike | None
) -> BoundaryConstraints:
    """free: constraints that hold nothing. With the frames on the surface held at those of the start."""
    if start is None:
        raise InvalidInput(
            f"boundary {OF_A_START!r} holds the surface at the frames of a start (--start FILE): give one, or another"
            " boundary",
            "no_start",
        )
    there = np.flatnonzero(free.on_boundary)
    frames = fitting_frames(tets, start, options.sampling)[there]
    fixed = VertexConstraints(vertices=there, kinds=["fixed"] * len(there), frames=frames)
    return _core.with_constraints(free, fixed)
