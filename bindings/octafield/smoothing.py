"""The field of a run: by the whole recipe, or smoothed from frames that are given."""

from numpy.typing import ArrayLike

from . import _core
from ._core import BoundaryConstraints, Sampling, SmoothResult, TetMesh
from .imported import fitting_frames
from .options import FieldOptions
from .phases import Progress, forward


def smoothed_field(
    tets: TetMesh,
    options: FieldOptions,
    where: TetMesh | Sampling,
    held: BoundaryConstraints,
    start: ArrayLike | None,
    seed: int,
    progress: Progress | None,
) -> tuple[SmoothResult, int]:
    """The field and how many steps of the heat flow came before. where: what the frames are smoothed on."""
    how = {
        "representation": options.representation,
        "max_iterations": options.max_iterations,
        "tolerance": options.tolerance,
        "threads": options.threads,
        "progress": forward(progress, "smooth", 0.0, 1.0),
        **({} if options.solver == "default" else {"solver": options.solver}),
    }
    if start is not None:
        return _core.smooth(where, held, fitting_frames(tets, start, options.sampling), **how), 0
    begin = "cross_field" if options.boundary == "none" else "constraints"
    found = _core.frame_field(where, held, start=begin, seed=seed, rounds=options.rounds, **how)
    return found.smooth, found.diffusion_steps
