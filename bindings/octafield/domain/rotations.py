"""Axes of frames in files: to unit quaternions and back, with what that changed."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .. import _core
from ..errors import InvalidInput

Place = Callable[[int], str]  # where element i stands in the file, for messages
_EXACT = 1e-12  # axes so close to orthonormal are taken as they are; the quaternion made of them is a unit one anyway
_SINGULAR = 1e-6  # smallest over largest singular value of the unit axes


@dataclass
class FromAxes:
    """frames: (n, 4) unit quaternions. lengths: (n, 3) of the axes given. deviation: radians, largest angle between an
    axis given and the frame's. left_handed: how many triads were; their third axis was turned round, which is the same
    frame."""

    frames: np.ndarray
    lengths: np.ndarray
    deviation: float
    left_handed: int


def frames_of_axes(axes: np.ndarray, place: Place) -> FromAxes:
    """The frames nearest to (n, 3, 3) triads, axes in the columns, each scaled to length 1 first (nearest: least sum of
    squared differences, by the singular value decomposition). Raises InvalidInput
    where axes are zero, not finite or in one plane."""
    axes = np.array(axes, float).reshape(-1, 3, 3)
    finite = np.isfinite(axes).all(axis=(1, 2))
    if not finite.all():
        i = int(np.argmin(finite))
        raise InvalidInput(f"{place(i)}: the axes of frame {i} (from 0) are not finite", "bad_frame", [i])
    largest = np.abs(axes).max(axis=1)
    scaled = np.divide(axes, largest[:, None, :], where=largest[:, None, :] > 0, out=np.zeros_like(axes))
    lengths = np.linalg.norm(scaled, axis=1)
    zero = (largest == 0).any(axis=1)
    if zero.any():
        i = int(np.argmax(zero))
        raise InvalidInput(f"{place(i)}: an axis of frame {i} (from 0) has length 0: no frame there", "bad_frame", [i])
    unit = scaled / lengths[:, None, :]
    lengths = lengths * largest
    near = np.abs(lengths - 1) < _EXACT
    unit = np.where(near[:, None, :], axes, unit)
    left = np.linalg.det(unit) < 0
    unit[left, :, 2] *= -1
    nearest, far = _nearest_rotations(unit, place)
    cosine = np.einsum("nij,nij->nj", unit, nearest)
    sine = np.linalg.norm(np.cross(unit, nearest, axis=1), axis=1)
    deviation = float(np.arctan2(sine, cosine)[far].max()) if far.any() else 0.0
    return FromAxes(quaternions_of(nearest), lengths, deviation, int(left.sum()))


def _nearest_rotations(unit: np.ndarray, place: Place) -> tuple[np.ndarray, np.ndarray]:
    far = np.abs(np.swapaxes(unit, 1, 2) @ unit - np.eye(3)).max(axis=(1, 2)) > _EXACT
    rotations = unit.copy()
    if far.any():
        u, s, vt = np.linalg.svd(unit[far])
        bad = s[:, 2] < _SINGULAR * s[:, 0]
        if bad.any():
            i = int(np.flatnonzero(far)[np.argmax(bad)])
            raise InvalidInput(
                f"{place(i)}: the axes of frame {i} (from 0) lie in one plane: no frame is nearest", "bad_frame", [i]
            )
        rotations[far] = u @ vt
    return rotations, far


def quaternions_of(rotations: np.ndarray) -> np.ndarray:
    """(n, 4) unit quaternions w x y z, w >= 0, of (n, 3, 3) rotations: the largest component from a square root, the
    others by division by it (Shepperd 1978)."""
    r = np.asarray(rotations, float)
    trace = np.trace(r, axis1=1, axis2=2)
    squares = np.column_stack([1 + trace, *(1 + 2 * r[:, i, i] - trace for i in range(3))])
    k = squares.argmax(axis=1)
    products = np.empty((len(r), 4, 4))  # 4 q_i q_j
    for i in range(4):
        products[:, i, i] = squares[:, i]
    for i, j, value in (
        (0, 1, r[:, 2, 1] - r[:, 1, 2]),
        (0, 2, r[:, 0, 2] - r[:, 2, 0]),
        (0, 3, r[:, 1, 0] - r[:, 0, 1]),
        (1, 2, r[:, 0, 1] + r[:, 1, 0]),
        (1, 3, r[:, 0, 2] + r[:, 2, 0]),
        (2, 3, r[:, 1, 2] + r[:, 2, 1]),
    ):
        products[:, i, j] = products[:, j, i] = value
    q = products[np.arange(len(r)), k]
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    upper: np.ndarray = np.where(q[:, :1] < 0, -q, q)
    return upper


def unit_quaternions(values: np.ndarray, place: Place) -> tuple[np.ndarray, float]:
    """(n, 4) numbers as unit quaternions, those within rounding of length 1 kept bit by bit; and the largest
    relative change of length."""
    values = np.array(values, float).reshape(-1, 4)
    with np.errstate(over="ignore"):
        length = np.linalg.norm(values, axis=1)
    bad = ~(np.isfinite(length) & (length > 0))
    if bad.any():
        i = int(np.argmax(bad))
        raise InvalidInput(f"{place(i)}: quaternion {i} (from 0) is zero or not finite", "bad_frame", [i])
    off = np.abs(length - 1)
    change = off > 4 * np.finfo(float).eps
    values[change] /= length[change, None]
    return values, float(off.max(initial=0.0))


def axes_of(frames: np.ndarray) -> np.ndarray:
    """(n, 3, 3) rotations: the axes are the columns."""
    return np.asarray(_core.rotation_matrices(frames)).reshape(-1, 3, 3)


def axes_in_rows(frames: np.ndarray, lengths: np.ndarray | None = None) -> np.ndarray:
    """(n, 9): first, second, third axis, which is the matrix column by column. lengths: (n, 3)."""
    axes = np.swapaxes(axes_of(frames), 1, 2)
    if lengths is not None:
        axes = axes * np.asarray(lengths, float)[:, :, None]
    return np.ascontiguousarray(axes).reshape(-1, 9)
