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


def moved_frames(mesh: TetMesh, frames: np.ndarray, where: str) -> tuple[np.ndarray, str]:
    """Frames of the other sites taken to the vertices or the tets, and the note that tells."""
    move = _core.tet_frames if where == "tets" else _core.vertex_frames
    note = f"the frames were taken to the {where}: the nearest to the mean sh4 vector of those around"
    return np.asarray(move(mesh, frames)), note
