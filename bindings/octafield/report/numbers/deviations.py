"""How far fields lie from each other: angles between the frames of two methods at the vertices of one mesh."""

from dataclasses import dataclass

import numpy as np

from ... import _core
from .records import Case, Method, Results, Run, Setting

_MOST_ANGLES = 200_000_000  # of all pairs: some tens of seconds
_FEWEST, _MOST = 500, 50_000  # vertices of a problem
_MOST_DRAWN = 400_000  # angles to the first method, of one method
_Pairs = list[list[list[float]]]  # of two methods: a figure per problem they have in common


@dataclass(frozen=True)
class Deviations:
    """Degrees. mean, high: (M, M), mean over problems of the mean and of the 95th percentile over vertices, NaN where
    two methods have no problem in common. lines: {(setting, method): (mean, high) to the first method}. drawn: per
    method the angles to the first at the vertices of all problems. sampled: not all vertices, but evenly chosen ones.
    """

    methods: list[Method]
    mean: np.ndarray
    high: np.ndarray
    lines: dict[tuple[Setting, Method], tuple[float, float]]
    drawn: dict[Method, np.ndarray]
    sampled: bool

    def pairs(self) -> dict[tuple[Method, Method], tuple[float, float]]:
        """(mean, 95th percentile) of the pairs with problems in common."""
        count = len(self.methods)
        return {
            (self.methods[i], self.methods[j]): (float(self.mean[i, j]), float(self.high[i, j]))
            for i in range(count)
            for j in range(i + 1, count)
            if np.isfinite(self.mean[i, j])
        }


def deviations(results: Results) -> Deviations:
    """Of all pairs of methods, from the files of the runs; NaN and empty where these were not kept."""
    count = len(results.methods)
    means, highs = _no_pairs(count), _no_pairs(count)
    lines: dict[tuple[Setting, Method], list[tuple[float, float]]] = {}
    drawn: dict[Method, list[np.ndarray]] = {}
    sampled = False
    budget = _MOST_ANGLES // max(1, count * (count - 1) // 2 * len(results.cases))
    most = int(np.clip(budget, _FEWEST, _MOST))
    share = max(_FEWEST, _MOST_DRAWN // max(1, len(results.cases)))
    for case in results.cases if count > 1 else ():
        frames, skipped = _frames_on(results, case, most)
        sampled |= skipped
        for i in frames:
            for j in frames:
                if i >= j:
                    continue
                angles = angles_between(frames[i], frames[j])
                pair = float(angles.mean()), float(np.percentile(angles, 95))
                for part, value in zip((means, highs), pair, strict=True):
                    part[i][j].append(value)
                    part[j][i].append(value)
                if i == 0:
                    lines.setdefault((case.setting, results.methods[j]), []).append(pair)
                    drawn.setdefault(results.methods[j], []).append(angles[:: -(-len(angles) // share)])
    return Deviations(
        results.methods,
        _averages(means),
        _averages(highs),
        {key: tuple(np.mean(pairs, axis=0).tolist()) for key, pairs in lines.items()},
        {method: np.concatenate(parts) for method, parts in drawn.items()},
        sampled,
    )


def _no_pairs(count: int) -> _Pairs:
    return [[[] for _ in range(count)] for _ in range(count)]


def _averages(pairs: _Pairs) -> np.ndarray:
    """(M, M), NaN where there is nothing."""
    rows = [
        [0.0 if i == j else np.mean(part) if part else np.nan for j, part in enumerate(row)]
        for i, row in enumerate(pairs)
    ]
    return np.array(rows, float).reshape(len(pairs), len(pairs))


def angles_between(frames: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Degrees of the smallest rotations that take frames to others."""
    angles: np.ndarray = np.degrees(np.asarray(_core.distance(frames, others)))
    return angles


def frames_of(run: Run) -> np.ndarray | None:
    """(n, 4) quaternions at the vertices, from the run's field.vtu; None where it was not kept."""
    import pyvista

    path = run.file("field.vtu")
    if path is None:
        return None
    reader = pyvista.XMLUnstructuredGridReader(str(path))
    reader.disable_all_cell_arrays()
    reader.disable_all_point_arrays()
    reader.enable_point_array("quaternion")
    return np.asarray(reader.read().point_data["quaternion"], float)


def _frames_on(results: Results, case: Case, most: int) -> tuple[dict[int, np.ndarray], bool]:
    """Frames per place of a method, at no more than `most` vertices; whether some were left out. All on one mesh."""
    found: dict[int, np.ndarray] = {}
    mesh, step = None, 1
    for place, method in enumerate(results.methods):
        run = results.field(method, case)
        frames = None if run is None else frames_of(run)
        if run is None or frames is None or not len(frames) or mesh not in (None, run.record.mesh_sha256):
            continue
        mesh = run.record.mesh_sha256
        step = -(-len(frames) // most)
        found[place] = frames[::step].copy()
    return found, step > 1
