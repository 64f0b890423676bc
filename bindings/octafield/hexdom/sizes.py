"""Wanted sizes of cells: a function of points, numbers at the vertices of the input, points with sizes, or a file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ..domain.inputs import Input
from ..errors import InvalidInput, IoError
from ..files.reading import read_bytes

Sizes = str | Path | ArrayLike | Callable[[np.ndarray], ArrayLike]
SizeAt = Callable[[np.ndarray], np.ndarray]

_NEIGHBOURS = 4  # of a point, that its size is interpolated between


def size_function(sizes: Sizes, found: Input) -> SizeAt:
    """Sizes at (n, 3) points, (n,) above 0. sizes: a function of points; (n,) numbers, one per vertex of the input;
    (k, 4) points x y z with sizes, between which sizes are interpolated (inverse squared distance to the nearest four);
    or a file of these, .npy or text. Raises InvalidInput, IoError."""
    if callable(sizes):
        return lambda points: _checked(sizes(points), points, f"the function of sizes {_name(sizes)}")
    name = str(sizes) if isinstance(sizes, (str, Path)) else "sizes"
    values = _read(Path(sizes)) if isinstance(sizes, (str, Path)) else _numbers(sizes, name)
    if values.ndim == 2 and values.shape[1] == 1:
        values = values[:, 0]
    if values.ndim == 1:
        places = _places(found, len(values), name)
        given = np.column_stack([places[0], values if places[1] is None else values[places[1]]])
    elif values.ndim == 2 and values.shape[1] == 4:
        given = values
    else:
        raise InvalidInput(
            f"{name}: an array of shape {values.shape}; give a number per vertex of the input, or rows x y z size",
            "wrong_shape",
        )
    if not np.isfinite(given).all():
        row = int(np.flatnonzero(~np.isfinite(given).all(axis=1))[0])
        raise InvalidInput(f"{name}: row {row} (from 0) is not finite; correct it", "bad_sizes", [row])
    _checked(given[:, 3], given, name)
    return _interpolated(given)


def _places(found: Input, count: int, name: str) -> tuple[np.ndarray, np.ndarray | None]:
    """The vertices that numbers are of, and which of the numbers they are where some are of no vertex."""
    mesh = found.surface if found.tets is None else found.tets
    points = np.asarray(mesh.vertices)
    if found.file_points is not None and count == found.points_in_file:
        return points, found.file_points
    if count != len(points):
        raise InvalidInput(
            f"{name}: {count} sizes, but {found.name} has {len(points)} vertices; give one per vertex, or rows x y z"
            " size",
            "wrong_size",
        )
    return points, None


def _read(path: Path) -> np.ndarray:
    content = read_bytes(path)
    try:
        if content[:6] == b"\x93NUMPY":
            import io

            return _numbers(np.load(io.BytesIO(content), allow_pickle=False), str(path))
        lines = content.decode("utf-8").replace(",", " ").splitlines()
        told = any(line.partition("#")[0].strip() for line in lines)
        values: np.ndarray = np.loadtxt(lines, ndmin=2) if told else np.empty(0)
    except (ValueError, EOFError, UnicodeDecodeError) as error:
        raise IoError(
            f"{path}: not a file of sizes ({error}); give .npy or text, a number per vertex of the input or rows x y z"
            " size",
            "bad_sizes",
        ) from error
    if not len(values):
        raise InvalidInput(f"{path}: holds no sizes", "bad_sizes")
    return values


def _numbers(values: ArrayLike, name: str) -> np.ndarray:
    try:
        array = np.asarray(values)
        if array.dtype.kind not in "fiu":
            raise ValueError(f"dtype {array.dtype}")
    except (TypeError, ValueError) as error:
        raise InvalidInput(f"{name}: not an array of numbers ({error})", "wrong_type") from error
    if not array.size:
        raise InvalidInput(f"{name}: holds no sizes", "bad_sizes")
    return array.astype(float)


def _checked(values: ArrayLike, points: np.ndarray, name: str) -> np.ndarray:
    array = _numbers(values, name)
    if array.shape != (len(points),):
        raise InvalidInput(f"{name}: an array of shape {array.shape} for {len(points)} points", "wrong_shape")
    bad = np.flatnonzero(~(np.isfinite(array) & (array > 0)))
    if len(bad):
        raise InvalidInput(
            f"{name}: {len(bad)} of {len(array)} sizes are not above 0, the first {array[bad[0]]:g} at row {bad[0]}"
            " (from 0)",
            "bad_sizes",
            [int(i) for i in bad[:100]],
        )
    return array


def _interpolated(given: np.ndarray) -> SizeAt:
    from scipy.spatial import cKDTree

    tree, count = cKDTree(given[:, :3]), min(_NEIGHBOURS, len(given))

    def at(points: np.ndarray) -> np.ndarray:
        distance, near = tree.query(points, k=[*range(1, count + 1)])
        weights = 1 / np.maximum(distance, 1e-12 * max(float(distance.max()), 1e-300)) ** 2
        sizes: np.ndarray = (weights * given[near, 3]).sum(axis=1) / weights.sum(axis=1)
        exact = distance[:, 0] == 0
        sizes[exact] = given[near[exact, 0], 3]
        return sizes

    return at


def _name(function: Callable[..., object]) -> str:
    return getattr(function, "__name__", type(function).__name__)
