"""Where the frames of a field are: at the vertices of a tet mesh, or in its tets."""

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from .._core import TetDomain, TetMesh
from ..errors import InvalidInput
from .rotations import unit_quaternions

SITES = ("vertices", "tets")


def fitting_frames(tets: TetMesh | TetDomain, frames: ArrayLike, where: str) -> np.ndarray:
    """Unit quaternions, as many as the mesh has vertices or tets; InvalidInput otherwise."""
    values = np.asarray(frames, float)
    count = len(tets.vertices if where == "vertices" else tets.tets)
    if values.shape != (count, 4):
        raise InvalidInput(
            f"frames of shape {values.shape}; ({count}, 4) are needed, one per"
            f" {'vertex' if where == 'vertices' else 'tet'}",
            "bad_count",
        )
    return unit_quaternions(values, lambda i: "frames")[0]


def require_right_angles(stretch: np.ndarray | None, what: str) -> None:
    """stretch: of frames with axes S Q; None: at right angles. what: that needs these, a sentence."""
    if stretch is not None:
        raise InvalidInput(
            f"{what}, and the axes of this field are not (octafield.volume.axes_stretch); compute it with axes"
            " 'orthogonal'",
            "stretched_axes",
        )


def fitting_stretch(tets: TetMesh | TetDomain, stretch: ArrayLike | None, frames: np.ndarray) -> np.ndarray | None:
    """(n, 6) positive definite matrices, one per vertex; InvalidInput otherwise."""
    if stretch is None:
        return None
    values = np.asarray(stretch, float)
    if values.shape != (len(tets.vertices), 6):
        raise InvalidInput(
            f"a stretch of shape {values.shape}; ({len(tets.vertices)}, 6) is needed, one row per vertex", "bad_count"
        )
    _core.stretched_axes(frames, values)
    return values


def moved_frames(mesh: TetMesh, frames: np.ndarray, where: str) -> tuple[np.ndarray, str]:
    """Frames of the other sites taken to the vertices or the tets, and the note that tells."""
    move = _core.tet_frames if where == "tets" else _core.vertex_frames
    note = f"the frames were taken to the {where}: the nearest to the mean sh4 vector of those around"
    return np.asarray(move(mesh, frames)), note
