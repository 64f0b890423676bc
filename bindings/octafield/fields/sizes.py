"""Sizes along the axes for which a field is closest to the gradients of a map (octafield.volume.isotropic_scale,
axis_scales): in results, their files and conversions."""

import numpy as np

from .. import _core
from .._core import AxisScales, IsotropicScale, TetDomain, TetMesh
from ..domain.rotations import axes_in_rows, axes_of
from ..options import FieldOptions
from ..progress.phases import PhaseClock, Progress, announce

Sizes = IsotropicScale | AxisScales


def find_sizes(tets: TetMesh | TetDomain, frames: np.ndarray, kind: str, threads: int = 0) -> Sizes:
    """kind: "isotropic" or "axes". frames: (n, 4), at the vertices."""
    find = _core.isotropic_scale if kind == "isotropic" else _core.axis_scales
    return find(tets, frames, threads=threads)


def sizes_of_run(
    tets: TetDomain, frames: np.ndarray, options: FieldOptions, clock: PhaseClock, progress: Progress | None
) -> Sizes | None:
    """What options.sizes asks for."""
    if options.sizes == "none":
        return None
    with clock.phase("sizes"):
        announce(progress, "sizes")
        return find_sizes(tets, frames, options.sizes, options.threads)


def sizes_arrays(
    found: Sizes | None, tet_frames: np.ndarray | None
) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Point and cell data of field.vtu: log_scale at the vertices; or log_scales in the tets, for the axes of
    tet_frames (None: of octafield.volume.tet_frames), and scaled_frame, those axes times exp(log_scales), one after the
    other; curl, what is left of it per tet."""
    if found is None:
        return {}, {}
    cells = {"curl": np.asarray(found.after.curl)}
    if isinstance(found, IsotropicScale):
        return {"log_scale": np.asarray(found.log_scale)}, cells
    frames = np.asarray(found.of_tets) if tet_frames is None else tet_frames
    logs = log_scales_of(found, frames)
    return {}, {**cells, "log_scales": logs, "scaled_frame": axes_in_rows(frames, np.exp(logs))}


def log_scales_of(found: AxisScales, tet_frames: np.ndarray) -> np.ndarray:
    """(m, 3): found.log_scales for the axes of other frames in the tets, which are matched to found.of_tets."""
    order = axis_order(np.asarray(_core.matching(np.asarray(found.of_tets), tet_frames)).reshape(-1))
    return np.take_along_axis(np.asarray(found.log_scales), order, axis=1)


def axis_order(elements: np.ndarray) -> np.ndarray:
    """(n, 3): which axis of R is, up to sign, the axis j of R o, for (n,) elements o of the octahedral group: where
    column j of o is not 0."""
    group = np.abs(np.rint(axes_of(np.asarray(_core.octahedral_group()))))
    found: np.ndarray = group.argmax(axis=1)[elements]
    return found
