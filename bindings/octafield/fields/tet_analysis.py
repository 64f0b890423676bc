"""What a field whose frames live in the tets is judged by. Integrability is defined for frames at vertices and left
out."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import _core
from .._core import Sampling, TetFieldAnalysis
from ..domain.meshed_input import MeshedInput
from . import verdict
from .vertex_analysis import boundary_record, degrees, meshability_record


@dataclass
class TetAnalysis:
    """of_field: what C++ finds. off_vertices: of the boundary, beside triangles that are too far off. record: for the
    JSON object."""

    of_field: TetFieldAnalysis
    off_vertices: np.ndarray
    record: dict[str, Any]


def analyse_tets(meshed: MeshedInput, sampling: Sampling, of_tets: np.ndarray, threads: int = 0) -> TetAnalysis:
    tets = meshed.volume()
    boundary = tets.surface
    found = _core.analyse_tet_field(tets, sampling, of_tets, threads=threads)
    singular, alignment = found.singular_edges, np.asarray(found.alignment)
    sides = np.where(
        np.arange(len(boundary.mesh.triangles)) < len(boundary.mesh.triangles) - meshed.interface_triangles, 1, 2
    )
    off = verdict.off_vertices(alignment, np.repeat(np.asarray(boundary.mesh.triangles), sides, axis=0))
    turns = [int(edge.quarter_turns) for edge in singular.edges]
    record = {
        "energy": found.energy,
        "energy_unit_speed": _core.unit_speed_factor * found.energy,
        "energy_at_vertices": found.energy_at_vertices,
        "singular_edges": len(turns),
        "singular_length": float(singular.graph.length),
        "singular_curves": len(singular.graph.curves),
        "singular_nodes": len(singular.graph.nodes),
        "complex_edges": int(singular.complex_edges),
        "undecided_edges": int(singular.undecided_edges),
        "tied_triangles": int(singular.tied_triangles),
        "singular_edges_by_turns": {
            f"{t:+d}" if t else "complex": turns.count(t) for t in sorted(set(turns), reverse=True)
        },
        **meshability_record(found.meshability),
        **boundary_record(found.boundary_meshability),
        "alignment_deg": degrees(alignment),
        "feature_alignment_deg": degrees(np.asarray(found.feature_alignment)),
    }
    return TetAnalysis(found, off, record)
