"""What a field whose frames live in the tets is judged by. Integrability is defined for frames at vertices and left
out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import BoundaryMeshability, Meshability, Sampling, SingularEdges
from ..domain.meshed_input import MeshedInput
from . import verdict

if TYPE_CHECKING:
    from ..records.field import FieldFigures


@dataclass
class TetFieldAnalysis:
    """frames: (n, 4), those of the tets taken to the vertices. alignment: radians, per triangle of the surface and tet
    beside it. feature_alignment: of `frames`. off_vertices: of the boundary, beside triangles that are too far off.
    figures: for the record."""

    frames: np.ndarray
    singular: SingularEdges
    alignment: np.ndarray
    feature_alignment: np.ndarray
    meshability: Meshability
    boundary_meshability: BoundaryMeshability
    off_vertices: np.ndarray
    figures: FieldFigures


def analyse_tets(meshed: MeshedInput, sampling: Sampling, of_tets: np.ndarray, threads: int = 0) -> TetFieldAnalysis:
    """What the record and the files of a field in tets need."""
    from . import record

    tets = meshed.volume()
    boundary = tets.surface
    frames = np.asarray(_core.vertex_frames(tets, of_tets, threads=threads))
    found = _core.singular_edges(tets, of_tets, threads=threads)
    alignment = np.asarray(_core.tet_alignment_angles(tets, of_tets))
    sides = np.where(
        np.arange(len(boundary.mesh.triangles)) < len(boundary.mesh.triangles) - meshed.interface_triangles, 1, 2
    )
    off = verdict.off_vertices(alignment, np.repeat(np.asarray(boundary.mesh.triangles), sides, axis=0))
    feature_alignment = np.asarray(_core.feature_alignment_angles(tets, frames))
    energy = float(_core.dirichlet_energy(sampling, of_tets, threads=threads))
    meshability = _core.tet_meshability(tets, of_tets, found)
    at_boundary = _core.tet_boundary_meshability(tets, of_tets, threads=threads)
    figures = record.of_field_in_tets(
        energy,
        float(_core.dirichlet_energy(tets, frames, threads=threads)),
        found,
        meshability,
        at_boundary,
        alignment,
        feature_alignment,
    )
    return TetFieldAnalysis(frames, found, alignment, feature_alignment, meshability, at_boundary, off, figures)
