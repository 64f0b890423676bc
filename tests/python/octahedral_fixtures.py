"""The octahedral group by its matrices, made here from the turns that octafield lists."""

import numpy as np
from scipy.spatial.transform import Rotation

# Element numbers as octafield and AlgoHex list them: turns about these directions.
DIAGONALS = [(1, 1, 1), (1, 1, -1), (1, -1, 1), (1, -1, -1), (-1, 1, 1), (-1, 1, -1), (-1, -1, 1), (-1, -1, -1)]
TURNS = (
    [((1, 0, 0), 0)]
    + [(axis, 180) for axis in np.eye(3)]
    + [(sign * axis, 90) for axis in np.eye(3) for sign in (1, -1)]
    + [(axis, 180) for axis in [(1, 1, 0), (0, 1, 1), (1, 0, 1), (-1, 1, 0), (0, -1, 1), (1, 0, -1)]]
    + [(axis, 120) for axis in DIAGONALS]
)
GROUP = (
    np.array([Rotation.from_rotvec(np.radians(t) * np.array(a) / np.linalg.norm(a)).as_matrix() for a, t in TURNS])
    .round()
    .astype(int)
)
NUMBER = {m.tobytes(): k for k, m in enumerate(GROUP)}
PRODUCT = np.array([[NUMBER[(a @ b).tobytes()] for b in GROUP] for a in GROUP])
INVERSE = np.array([NUMBER[np.ascontiguousarray(a.T).tobytes()] for a in GROUP])


def matrices(quaternions):
    return Rotation.from_quat(np.asarray(quaternions), scalar_first=True).as_matrix()


def closest(first, second):
    """Number of the element o for which first @ o is closest to second, and the angle left, per row."""
    traces = np.einsum("fij,ojk,fik->fo", first, GROUP, second)
    best = traces.argmax(axis=1)
    return best, np.arccos(np.clip((traces[np.arange(len(best)), best] - 1) / 2, -1, 1))
