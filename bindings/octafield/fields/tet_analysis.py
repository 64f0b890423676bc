"""What a field whose frames live in the tets is judged by. Integrability is defined for frames at vertices and left
out."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import _core
from .._core import BoundaryMeshability, Meshability, Sampling, SingularEdges
from ..domain.meshed_input import MeshedInput
from . import verdict
from .vertex_analysis import boundary_record, degrees, meshability_record


@dataclass
class TetFieldAnalysis:
    """frames: (n, 4), those of the tets taken to the vertices. alignment: radians, per triangle of the surface and tet
    beside it. feature_alignment: of `frames`. off_vertices: of the boundary, beside triangles that are too far off.
    record: for the JSON object."""

    frames: np.ndarray
    singular: SingularEdges
    alignment: np.ndarray
    feature_alignment: np.ndarray
    meshability: Meshability
    boundary_meshability: BoundaryMeshability
    off_vertices: np.ndarray
    record: dict[str, Any]


def analyse_tets(meshed: MeshedInput, sampling: Sampling, of_tets: np.ndarray, threads: int = 0) -> TetFieldAnalysis:
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
    turns = [int(edge.quarter_turns) for edge in found.edges]
    record = {
        "energy": energy,
        "energy_unit_speed": _core.unit_speed_factor * energy,
        "energy_at_vertices": float(_core.dirichlet_energy(tets, frames, threads=threads)),
        "singular_edges": len(turns),
        "singular_length": float(found.graph.length),
        "singular_curves": len(found.graph.curves),
        "singular_nodes": len(found.graph.nodes),
        "complex_edges": int(found.complex_edges),
        "undecided_edges": int(found.undecided_edges),
        "tied_triangles": int(found.tied_triangles),
        "singular_edges_by_turns": {
            f"{t:+d}" if t else "complex": turns.count(t) for t in sorted(set(turns), reverse=True)
        },
        **meshability_record(meshability),
        **boundary_record(at_boundary),
        "alignment_deg": degrees(alignment),
        "feature_alignment_deg": degrees(feature_alignment),
    }
    return TetFieldAnalysis(frames, found, alignment, feature_alignment, meshability, at_boundary, off, record)
