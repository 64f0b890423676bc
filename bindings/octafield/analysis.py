"""What a finished frame field is judged by: its singular graph, whether a hex mesh could follow it, how well it is
aligned, how far it is from the gradients of a map."""

import math
from collections import Counter
from dataclasses import dataclass

import numpy as np

from . import _core
from ._core import Integrability, Meshability, SingularGraph
from .meshing import MeshedInput


@dataclass
class FieldAnalysis:
    """alignment, feature_alignment: radians, one per sector normal and feature tangent. record: for the JSON object."""

    singular_graph: SingularGraph
    meshability: Meshability
    integrability: Integrability
    alignment: np.ndarray
    feature_alignment: np.ndarray
    energy: float
    record: dict


def analyse(meshed: MeshedInput, frames: np.ndarray, threads: int = 0) -> FieldAnalysis:
    tets = meshed.tets
    graph = _core.singular_graph(tets, frames, threads=threads)
    meshability = _core.local_meshability(tets, frames, graph)
    integrability = _core.integrability(tets, frames, threads=threads)
    alignment = np.asarray(_core.alignment_angles(meshed.boundary, meshed.boundary_features, frames))
    feature_alignment = np.asarray(_core.feature_alignment_angles(meshed.boundary, meshed.boundary_features, frames))
    energy = float(_core.dirichlet_energy(tets, frames, threads=threads))
    record = {
        "energy": energy,
        "energy_unit_speed": _core.unit_speed_factor * energy,
        **_singular_record(graph),
        **_meshability_record(meshability),
        "alignment_deg": degrees(alignment),
        "feature_alignment_deg": degrees(feature_alignment),
        "integrability": {
            name: getattr(integrability, name) for name in ("jump_rms", "jump_max", "twist_rms", "twist_max")
        },
    }
    return FieldAnalysis(graph, meshability, integrability, alignment, feature_alignment, energy, record)


def _singular_record(graph: SingularGraph) -> dict:
    turns = [int(t.quarter_turns) for t in graph.triangles]
    return {
        "singular_edges": len(turns),
        "singular_length": float(graph.length),
        "singular_curves": len(graph.curves),
        "singular_nodes": len(graph.nodes),
        "complex_edges": int(graph.complex_triangles),
        "singular_edges_by_turns": {
            f"{t:+d}" if t else "complex": turns.count(t) for t in sorted(set(turns), reverse=True)
        },
    }


def _meshability_record(found: Meshability) -> dict:
    counts = Counter(_type(vertex) for vertex in found.vertices if vertex.kind != "boundary_end")
    return {
        "non_meshable_vertices": found.non_meshable_vertices,
        "non_meshable_junctions": found.non_meshable_junctions,
        "singular_closed_curves": found.closed_curves,
        "singular_boundary_ends": found.boundary_ends,
        "singular_boundary_ends_about_normal": found.boundary_ends_about_normal,
        "singular_vertex_types": {name: counts[name] for name in sorted(counts)},
    }


def _type(vertex) -> str:
    """The valences of the singular edges at a vertex: "3 3 5 5"."""
    return " ".join(
        ["3"] * vertex.valence3 + ["5"] * vertex.valence5 + ["6"] * vertex.valence6 + ["complex"] * vertex.complex
    )


def degrees(angles: np.ndarray) -> dict[str, float]:
    if len(angles) == 0:
        return {"median": 0.0, "max": 0.0}
    return {"median": math.degrees(float(np.median(angles))), "max": math.degrees(float(angles.max()))}
