"""What a field whose frames live in the tets is judged by. Integrability is defined for frames at vertices and left
out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import Sampling, TetFieldAnalysis
from ..domain.meshed_input import MeshedInput
from . import verdict

if TYPE_CHECKING:
    from ..records.field import FieldFigures


@dataclass
class TetAnalysis:
    """of_field: what C++ finds. off_vertices: of the boundary, beside triangles that are too far off. figures: for
    the record."""

    of_field: TetFieldAnalysis
    off_vertices: np.ndarray
    figures: FieldFigures


def analyse_tets(meshed: MeshedInput, sampling: Sampling, of_tets: np.ndarray, threads: int = 0) -> TetAnalysis:
    """What the record and the files of a field in tets need."""
    from . import record

    tets = meshed.volume()
    boundary = tets.surface
    found = _core.analyse_tet_field(tets, sampling, of_tets, threads=threads)
    alignment = np.asarray(found.alignment)
    sides = np.where(
        np.arange(len(boundary.mesh.triangles)) < len(boundary.mesh.triangles) - meshed.interface_triangles, 1, 2
    )
    off = verdict.off_vertices(alignment, np.repeat(np.asarray(boundary.mesh.triangles), sides, axis=0))
    return TetAnalysis(found, off, record.of_field_in_tets(found))
