"""Where the frames of a field are: at the vertices of a tet mesh, or in its tets."""

import numpy as np
from numpy.typing import ArrayLike

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
