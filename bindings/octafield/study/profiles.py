"""What a study's report compares methods by: profiles, ratios, deviations."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import _core


@dataclass(frozen=True)
class Profile:
    """Of one method: share[k] of the problems on which it needs at most ratio[k] times what the best method needs."""

    ratio: np.ndarray
    share: np.ndarray


def performance_profiles(values: Mapping[str, Sequence[float]]) -> dict[str, Profile]:
    """Performance profiles (Dolan, More 2002). values: per method one positive number per problem, in the same order;
    infinite: not solved. Problems that no method solves are left out; so are those whose best value is 0."""
    table = np.array([list(v) for v in values.values()], float)
    best = table.min(axis=0, initial=np.inf)
    counted = np.isfinite(best) & (best > 0)
    ratios = table[:, counted] / best[counted]
    problems = max(int(counted.sum()), 1)
    result = {}
    for name, own in zip(values, ratios, strict=True):
        steps = np.sort(own[np.isfinite(own)])
        result[name] = Profile(np.r_[1.0, steps], np.r_[np.sum(own == 1), np.arange(1, len(steps) + 1)] / problems)
    return result


def frames_of(folder: Path) -> np.ndarray | None:
    """(n, 4) quaternions in a run's field.vtu; None where fields were not kept."""
    import pyvista

    path = folder / "field.vtu"
    return np.asarray(pyvista.read(path).point_data["quaternion"], float) if path.is_file() else None


def deviations(frames: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Degrees of the smallest rotation between the frames of two fields on one mesh."""
    return np.degrees(np.asarray(_core.distance(frames, reference)))
