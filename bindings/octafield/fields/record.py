"""Records of fields, made of what was computed: the one place where figures of C++ become names of a record.

Imported where a record is made, not with the package: pydantic takes longer to import than a small part of it."""

import math
from collections import Counter
from dataclasses import asdict
from fractions import Fraction
from typing import Any

import numpy as np

from .. import _core
from .._core import (
    AxisScales,
    BoundaryConstraints,
    BoundaryMeshability,
    DirectionConstraints,
    DirectionField,
    FeatureWedge,
    FieldAnalysis,
    FrameStreamline,
    Meshability,
    NonOrthogonalField,
    SingularGraph,
    SingularVertex,
    SurfaceSingularities,
    TetFieldAnalysis,
    VertexConstraints,
)
from ..domain.meshed_input import MeshedInput
from ..options import NonOrthogonalOptions, SurfaceFieldOptions
from ..progress.phases import PhaseClock, machine, octafield_version, versions
from ..records.field import FieldFigures, InputRecord
from ..records.parts import (
    Angles,
    IntegrabilityFigures,
    Machine,
    NonOrthogonalFigures,
    PhaseSeconds,
    Range,
    SingularPoint,
    SizesFigures,
    StreamlineCounts,
    SurfaceFieldSummary,
)
from ..records.surface_field import SurfaceFieldRecord
from .sizes import Sizes


def of_input(meshed: MeshedInput, clock: PhaseClock, peak_mb: float) -> InputRecord:
    """What every record begins with."""
    return InputRecord(
        input=meshed.name,
        version=octafield_version(),
        input_kind=meshed.kind,
        mesh_sha256=meshed.digest(),
        edge_length=float(_core.mean_edge_length(meshed.surface)),
        feature_source=meshed.feature_source,
        feature_edges=len(meshed.features.edges),
        feature_corners=len(meshed.features.corners),
        notes=list(meshed.notes),
        wall_seconds=PhaseSeconds(**clock.wall),
        cpu_seconds=PhaseSeconds(**clock.cpu),
        peak_mb=round(peak_mb, 1),
        versions=versions(),
        machine=Machine.model_validate(machine()),
    )


def of_mesh(meshed: MeshedInput) -> dict[str, Any]:
    """The figures of the tet mesh."""
    domain = meshed.volume()
    return {
        "vertices": len(domain.vertices),
        "tets": len(domain.tets),
        "boundary_triangles": len(meshed.surface.triangles) - meshed.interface_triangles,
        "regions": 1 if meshed.regions is None else len(np.unique(meshed.regions)),
    }


def of_field_at_vertices(
    found: FieldAnalysis,
    unserved: np.ndarray,
    unserved_vertices: int,
    lines: list[FrameStreamline],
    *,
    at_right_angles: bool,
) -> FieldFigures:
    """unserved: (k,) bool, of the angles of alignment. at_right_angles: whether axes are, as integrability needs."""
    graph, integrability, alignment = found.singular_graph, found.integrability, np.asarray(found.alignment)
    held = degrees_of(alignment[~unserved]).max
    ends = Counter(end for line in lines for end in (line.first_end, line.last_end))
    return FieldFigures(
        energy=found.energy,
        energy_unit_speed=_core.unit_speed_factor * found.energy,
        **_of_graph([int(t.quarter_turns) for t in graph.triangles], graph),
        singular_length_smoothed=float(_core.smoothed_curves(graph).length),
        complex_edges=int(graph.complex_triangles),
        undecided_edges=int(graph.undecided_triangles),
        **_of_meshability(found.meshability),
        **_of_boundary(found.boundary_meshability),
        alignment_deg=degrees_of(alignment).changed(held_max=held),
        unserved_vertices=unserved_vertices,
        feature_alignment_deg=degrees_of(np.asarray(found.feature_alignment)),
        integrability=IntegrabilityFigures(
            jump_rms=integrability.jump_rms,
            jump_max=integrability.jump_max,
            twist_rms=integrability.twist_rms,
            twist_max=integrability.twist_max,
        )
        if at_right_angles
        else None,
        streamlines=StreamlineCounts(
            curves=len(lines), length=float(sum(line.length for line in lines)), ends=dict(sorted(ends.items()))
        ),
    )


def of_field_in_tets(found: TetFieldAnalysis) -> FieldFigures:
    singular = found.singular_edges
    return FieldFigures(
        energy=found.energy,
        energy_unit_speed=_core.unit_speed_factor * found.energy,
        energy_at_vertices=found.energy_at_vertices,
        **_of_graph([int(edge.quarter_turns) for edge in singular.edges], singular.graph),
        complex_edges=int(singular.complex_edges),
        undecided_edges=int(singular.undecided_edges),
        tied_triangles=int(singular.tied_triangles),
        **_of_meshability(found.meshability),
        **_of_boundary(found.boundary_meshability),
        alignment_deg=degrees_of(np.asarray(found.alignment)),
        feature_alignment_deg=degrees_of(np.asarray(found.feature_alignment)),
    )


def _of_graph(turns: list[int], graph: SingularGraph) -> dict[str, Any]:
    """turns: quarter turns of each singular edge, 0: complex."""
    return {
        "singular_edges": len(turns),
        "singular_length": float(graph.length),
        "singular_curves": len(graph.curves),
        "singular_nodes": len(graph.nodes),
        "singular_edges_by_turns": {
            f"{t:+d}" if t else "complex": turns.count(t) for t in sorted(set(turns), reverse=True)
        },
    }


def _of_meshability(found: Meshability) -> dict[str, Any]:
    counts = Counter(_type(vertex) for vertex in found.vertices if vertex.kind != "boundary_end")
    return {
        "non_meshable_vertices": found.non_meshable_vertices,
        "non_meshable_junctions": found.non_meshable_junctions,
        "non_meshable_curves": found.non_meshable_curves,
        "singular_closed_curves": found.closed_curves,
        "singular_boundary_ends": found.boundary_ends,
        "singular_boundary_ends_about_normal": found.boundary_ends_about_normal,
        "singular_vertex_types": {name: counts[name] for name in sorted(counts)},
        "singular_axis_deg": degrees_of(np.array([end.angle for end in found.ends if end.quarter_turns])),
    }


def _of_boundary(found: BoundaryMeshability) -> dict[str, Any]:
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


def degrees_of(angles: np.ndarray) -> Angles:
    if len(angles) == 0:
        return Angles(median=0.0, max=0.0)
    return Angles(median=math.degrees(float(np.median(angles))), max=math.degrees(float(angles.max())))


def of_lengths(lengths: np.ndarray | None) -> Range | None:
    """lengths: (n, 3)."""
    if lengths is None:
        return None
    return Range(min=float(lengths.min()), median=float(np.median(lengths)), max=float(lengths.max()))


def of_sizes(found: Sizes) -> SizesFigures:
    """What sizes leave of the curl."""
    values = np.asarray(found.values if isinstance(found, AxisScales) else found.log_scale)
    return SizesFigures(
        kind="axes" if isinstance(found, AxisScales) else "isotropic",
        curl_rms_before=found.before.curl_rms,
        curl_rms_after=found.after.curl_rms,
        jump_rms_before=found.before.jump_rms,
        jump_rms_after=found.after.jump_rms,
        size_ratio=float(np.exp(np.ptp(values))),
        iterations=found.iterations,
    )


def of_constraints(held: BoundaryConstraints, given: VertexConstraints | None) -> dict[str, Any]:
    """How many sites are held in which way."""
    names = _core.constraint_kinds
    counts = dict(zip(names, np.bincount(np.asarray(held.kind), minlength=len(names)).tolist()))
    return {
        "constraints": {**counts, "given": 0 if given is None else len(given.vertices)},
        "released_corners": len(held.released_corners),
        "released_corner_vertices": np.asarray(held.released_corners).tolist(),
    }


def of_cross_field(field: DirectionField, singularities: SurfaceSingularities) -> SurfaceFieldSummary:
    """singular_points: how many of each index, positive ones first."""
    indices = sorted((Fraction(float(s.index)).limit_denominator(1000) for s in singularities.points), reverse=True)
    return SurfaceFieldSummary(
        singular_points={
            ("+" if index > 0 else "") + str(index): indices.count(index) for index in dict.fromkeys(indices)
        },
        epsilon=field.epsilon,
        iterations=field.iterations,
        converged=bool(field.converged),
        euler_characteristic=singularities.euler_characteristic,
        index_sum=singularities.index_sum,
    )


def of_surface_field(
    meshed: MeshedInput,
    clock: PhaseClock,
    peak_mb: float,
    field: DirectionField,
    singularities: SurfaceSingularities,
    options: SurfaceFieldOptions,
    constraints: DirectionConstraints | None,
    stopped: bool,
) -> SurfaceFieldRecord:
    """stopped: by the caller's progress."""
    return SurfaceFieldRecord(
        **of_input(meshed, clock, peak_mb),
        vertices=len(meshed.surface.vertices),
        triangles=len(meshed.surface.triangles),
        symmetry=options.symmetry,
        method=options.method,
        seed=options.seed,
        **_of_points(singularities),
        energy=field.energy,
        dirichlet_energy=field.dirichlet_energy,
        energy_history=[float(e) for e in field.energy_history],
        epsilon=field.epsilon,
        iterations=field.iterations,
        converged=bool(field.converged),
        stopped=stopped,
        residual=field.residual,
        constraints=0 if constraints is None else len(constraints.edges) + len(constraints.vertices),
        options=asdict(options),
    )


def of_lines(
    meshed: MeshedInput,
    clock: PhaseClock,
    peak_mb: float,
    field: NonOrthogonalField,
    singularities: SurfaceSingularities,
    options: NonOrthogonalOptions,
    corner_source: str,
    cut_edges: int,
    stopped: bool,
) -> SurfaceFieldRecord:
    """cut_edges: feature edges inside, along which the surface was cut."""
    quads, used = np.asarray(field.quads), np.unique(np.asarray(field.domain.triangles))
    cosines = abs(np.einsum("vi,vi->v", np.asarray(field.first)[used], np.asarray(field.second)[used]))
    numbers = Counter(quads[(quads > 0) & (quads != 2)].tolist())
    return SurfaceFieldRecord(
        **of_input(meshed, clock, peak_mb),
        vertices=len(field.domain.vertices),
        triangles=len(field.domain.triangles),
        symmetry=4,
        method=options.method,
        seed=options.seed,
        **_of_points(singularities),
        energy=field.energy,
        epsilon=0.0,
        iterations=field.iterations,
        converged=bool(field.converged),
        stopped=stopped,
        constraints=0,
        non_orthogonal=NonOrthogonalFigures(
            smallest_angle_deg=math.degrees(field.smallest_angle),
            oblique_share=float((cosines > math.cos(math.radians(89))).mean()),
            start_energy=field.start_energy,
            corners={str(number): numbers[number] for number in sorted(numbers)},
            corner_source=corner_source,
            agree=bool(singularities.agree),
            inverted=len(field.inverted),
            freedom=field.freedom,
            cut_edges=cut_edges,
            input_vertices=len(meshed.surface.vertices),
        ),
        options=options.recorded(),
    )


def _of_points(found: SurfaceSingularities) -> dict[str, Any]:
    return {
        "euler_characteristic": found.euler_characteristic,
        "index_sum": found.index_sum,
        "singularities": [
            SingularPoint(position=[float(x) for x in s.position], index=float(s.index), boundary=bool(s.boundary))
            for s in found.points
        ],
    }
