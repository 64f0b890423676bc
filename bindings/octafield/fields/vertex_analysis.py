"""What a finished frame field is judged by: its singular graph, whether a hex mesh could follow it, how well it is
aligned, how far it is from the gradients of a map; and streamlines to look at it."""

import math
from collections import Counter
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from .. import _core
from .._core import (
    BoundaryConstraints,
    BoundaryMeshability,
    FeatureWedge,
    FieldAnalysis,
    FrameStreamline,
    Meshability,
    SectorNormals,
    SingularGraph,
    SingularVertex,
    SurfaceSingularities,
    VertexConstraints,
)
from ..domain.meshed_input import MeshedInput
from . import verdict


@dataclass
class VertexAnalysis:
    """of_field: what C++ finds. off_vertices: of the boundary, too far from a normal that is served. record: for the
    JSON object."""

    of_field: FieldAnalysis
    streamlines: list[FrameStreamline]
    off_vertices: np.ndarray
    record: dict[str, Any]


def analyse(
    meshed: MeshedInput,
    frames: np.ndarray,
    threads: int = 0,
    streamlines: int = 0,
    feature_tolerance: float = _core.BoundaryOptions().feature_tolerance,
) -> VertexAnalysis:
    """streamlines: number of seeds, three curves each. feature_tolerance: radians, of the constraints."""
    tets = meshed.volume()
    found = _core.analyse_field(tets, frames, threads=threads)
    alignment, integrability, energy = np.asarray(found.alignment), found.integrability, found.energy
    sectors = _core.sector_normals(tets)
    unserved = unserved_sectors(meshed, sectors, feature_tolerance)
    off = verdict.off_vertices(alignment[~unserved], np.asarray(sectors.vertex)[~unserved])
    size = _core.shape_size(tets.surface.mesh)
    seeds = _core.spread_points(tets, streamlines)
    lines = _core.frame_streamlines(tets, frames, seeds, max_length=2 * size, threads=threads) if len(seeds) else []
    record = {
        "energy": energy,
        "energy_unit_speed": _core.unit_speed_factor * energy,
        **_singular_record(found.singular_graph),
        **meshability_record(found.meshability),
        **boundary_record(found.boundary_meshability),
        "alignment_deg": {**degrees(alignment), "held_max": degrees(alignment[~unserved])["max"]},
        "unserved_vertices": len(np.unique(np.asarray(sectors.vertex)[unserved])),
        "feature_alignment_deg": degrees(np.asarray(found.feature_alignment)),
        "integrability": {
            name: getattr(integrability, name) for name in ("jump_rms", "jump_max", "twist_rms", "twist_max")
        },
        "streamlines": {
            "curves": len(lines),
            "length": float(sum(line.length for line in lines)),
            "ends": dict(sorted(Counter(end for line in lines for end in (line.first_end, line.last_end)).items())),
        },
    }
    return VertexAnalysis(found, lines, off, record)


def _singular_record(graph: SingularGraph) -> dict[str, Any]:
    turns = [int(t.quarter_turns) for t in graph.triangles]
    return {
        "singular_edges": len(turns),
        "singular_length": float(graph.length),
        "singular_length_smoothed": float(_core.smoothed_curves(graph).length),
        "singular_curves": len(graph.curves),
        "singular_nodes": len(graph.nodes),
        "complex_edges": int(graph.complex_triangles),
        "undecided_edges": int(graph.undecided_triangles),
        "singular_edges_by_turns": {
            f"{t:+d}" if t else "complex": turns.count(t) for t in sorted(set(turns), reverse=True)
        },
    }


def meshability_record(found: Meshability) -> dict[str, Any]:
    counts = Counter(_type(vertex) for vertex in found.vertices if vertex.kind != "boundary_end")
    return {
        "non_meshable_vertices": found.non_meshable_vertices,
        "non_meshable_junctions": found.non_meshable_junctions,
        "non_meshable_curves": found.non_meshable_curves,
        "singular_closed_curves": found.closed_curves,
        "singular_boundary_ends": found.boundary_ends,
        "singular_boundary_ends_about_normal": found.boundary_ends_about_normal,
        "singular_vertex_types": {name: counts[name] for name in sorted(counts)},
        "singular_axis_deg": degrees(np.array([end.angle for end in found.ends if end.quarter_turns])),
    }


def boundary_record(found: BoundaryMeshability) -> dict[str, Any]:
    """hexahedra_at_features: how many feature edges have how many, by the frames of their ends where these agree."""
    numbers = Counter(_hexahedra(wedge) for wedge in found.wedges)
    return {
        "hexahedra_at_features": {name: numbers[name] for name in sorted(numbers)},
        "non_meshable_feature_edges": found.non_meshable_wedges,
        "non_meshable_feature_edge_vertices": [[w.a, w.b] for w in found.wedges if not w.meshable],
        "non_meshable_corners": found.non_meshable_corners,
        "non_meshable_corner_vertices": [corner.vertex for corner in found.corners if not corner.meshable],
        "surface_crossings": len(found.crossings),
        "non_meshable_crossings": found.non_meshable_crossings,
    }


def _hexahedra(wedge: FeatureWedge) -> str:
    numbers = {number for number in (wedge.hexahedra_a, wedge.hexahedra_b) if number != _core.no_number}
    return "none" if not numbers else str(numbers.pop()) if len(numbers) == 1 else "changing"


def _type(vertex: SingularVertex) -> str:
    """The valences of the singular edges at a vertex: "3 3 5 5"."""
    counts = {str(valence): getattr(vertex, f"valence{valence}") for valence in (1, 2, 3, 5, 6, 7, 8)} | {
        "complex": vertex.complex
    }
    return " ".join(word for word, count in counts.items() for _ in range(count))


def unserved_sectors(meshed: MeshedInput, sectors: SectorNormals, feature_tolerance: float) -> np.ndarray:
    """(k,) true: at a vertex where smooth sectors meet and no frame fits all their normals and the tangents within the
    tolerance, so that constraints do not hold the normals (octafield.volume.boundary_constraints): the field may be off
    by up to 45 degrees there, whatever the method."""
    tets = meshed.volume()
    boundary = tets.surface
    vertex, normal = np.asarray(sectors.vertex), np.asarray(sectors.normal)
    tangents = np.cross(normal, np.eye(3)[np.abs(normal).argmin(axis=1)])  # any will do: on features the normals decide
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    directions = tangents[np.searchsorted(vertex, np.arange(len(boundary.mesh.vertices)))]
    held = _core.boundary_constraints(tets, directions, mode="aligned", feature_tolerance=feature_tolerance)
    loose = np.asarray(held.kind)[np.asarray(boundary.vertex_map)] != _core.constraint_kinds.index("fixed")
    several = np.bincount(vertex, minlength=len(loose)) > 1
    found: np.ndarray = (loose & several)[vertex]
    return found


def degrees(angles: np.ndarray) -> dict[str, float]:
    if len(angles) == 0:
        return {"median": 0.0, "max": 0.0}
    return {"median": math.degrees(float(np.median(angles))), "max": math.degrees(float(angles.max()))}


def spread(lengths: np.ndarray) -> dict[str, float]:
    return {"min": float(lengths.min()), "median": float(np.median(lengths)), "max": float(lengths.max())}


def constraint_counts(held: BoundaryConstraints, given: VertexConstraints | None) -> dict[str, int]:
    names = _core.constraint_kinds
    counts = dict(zip(names, np.bincount(np.asarray(held.kind), minlength=len(names)).tolist()))
    return {**counts, "given": 0 if given is None else len(given.vertices)}


def counts_by_index(singularities: SurfaceSingularities) -> dict[str, int]:
    """{"1/4": 8}: how many singular points of each index, positive ones first."""
    indices = sorted((Fraction(float(s.index)).limit_denominator(1000) for s in singularities.points), reverse=True)
    return {("+" if index > 0 else "") + str(index): indices.count(index) for index in dict.fromkeys(indices)}
