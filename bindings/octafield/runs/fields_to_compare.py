"""Fields that were read, in a comparison: as they are, and what one smoothing makes of them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ..domain.meshing import SoundInput
from ..domain.sites import fitting_frames
from ..errors import InvalidInput
from ..frame_files import read_frames
from ..frame_files.base import frames_at
from ..options import REPRESENTATIONS, FieldOptions

FieldSource = str | Path | ArrayLike


@dataclass
class GivenField:
    """frames: where the comparison has its own. notes: on reading."""

    name: str
    frames: np.ndarray
    notes: list[str]


def given_fields(
    inputs: Sequence[SoundInput], fields: Mapping[str, FieldSource], options: FieldOptions
) -> list[GivenField]:
    """Reads them all, so that an unfit one is refused before the first run. Raises InvalidInput, IoError."""
    if not fields:
        return []
    mesh = inputs[0].found
    if len(inputs) != 1 or options.split or options.split_singular or mesh.tets is None:
        raise InvalidInput(
            "fields that are given belong to one tet mesh: make it the only input, and leave splitting out", "not_tets"
        )
    found = []
    for name, source in fields.items():
        if name in REPRESENTATIONS or not name.strip() or set(name) & set("/\\"):
            raise InvalidInput(
                f"a given field needs a name without slashes that is no representation's; not {name!r}", "bad_name"
            )
        if not isinstance(source, (str, Path)):
            found.append(GivenField(name, fitting_frames(mesh.tets, source, options.sampling), []))
            continue
        file = read_frames(source, mesh)
        frames = frames_at(file, options.sampling)
        found.append(GivenField(name, frames, [f"{name}: {note}" for note in file.notes if note not in mesh.notes]))
    return found
