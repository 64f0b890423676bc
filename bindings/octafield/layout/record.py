"""The record of a quad layout. Imported where a record is made: pydantic takes long to import."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _core
from .._core import ImposedField
from ..meshes.figures import Spread
from ..progress.meter import PhaseMeter
from ..records.parts import Deviation, EdgeLengths, ImposedPointFigures, JacobianFigures, Misalignment
from ..records.quad_layout import QuadLayoutRecord
from .blocks import BlockQuads, imposed_indices
from .points.pattern import Pattern
from .quality import QuadFigures

if TYPE_CHECKING:
    from ..records.field import InputRecord

_OTHER_NUMBER = 1.05  # times the number of quads wanted
_FAR = 0.02  # of the diagonal


def of_quads(
    made: BlockQuads,
    figures: QuadFigures,
    field: ImposedField,
    pattern: Pattern,
    begun: InputRecord,
    triangles: int,
    target: float,
    inadmissible: str,
    meter: PhaseMeter,
    options: dict[str, Any],
    field_options: dict[str, Any],
) -> QuadLayoutRecord:
    """begun: what every record begins with. triangles: of the surface before it was refined. target: edge length."""
    found = _core.surface_singularities(field.field)
    layout, whole, domain = made.layout, made.whole_numbers, field.field.domain
    return QuadLayoutRecord(
        input=begun.input,
        version=begun.version,
        input_kind=begun.input_kind,
        mesh_sha256=begun.mesh_sha256,
        triangles=triangles,
        field_triangles=len(domain.triangles),
        euler_characteristic=found.euler_characteristic,
        feature_source=begun.feature_source,
        feature_edges=begun.feature_edges,
        point_source=pattern.source,
        corner_source=pattern.corner_source,
        singular_points=points_of(field),
        index_sum=found.index_sum,
        misalignment=misalignment_of(field),
        inadmissible=inadmissible,
        largest_move=field.largest_move,
        t_joints=None if whole is None else whole.t_joints,
        whole_numbers_optimal=None if whole is None else whole.optimal,
        separatrices=None if layout is None else layout.separatrices,
        patches=len(np.unique(made.blocks)),
        fewest_patches=int(_core.fewest_blocks(made.mesh)) if whole is None else whole.fewest,
        coarsest_patches=None if whole is None else whole.coarsest,
        chords=len(np.unique(made.chords)),
        largest_mismatch=None if layout is None else layout.largest_mismatch,
        vertices=len(made.mesh.vertices),
        quads=len(made.mesh.quads),
        irregular_vertices=figures.irregular_vertices,
        irregular_boundary_vertices=figures.irregular_boundary_vertices,
        t_junctions=figures.t_junctions,
        inverted=figures.inverted,
        nonconforming_edges=figures.nonconforming_edges,
        scaled_jacobian=jacobians(figures.jacobians),
        angle_quality=jacobians(figures.angle_quality),
        edge_length=EdgeLengths(
            target=target, median=figures.edges.median, p05=figures.edges.p05, p95=figures.edges.p95
        ),
        surface_deviation=Deviation(max=figures.deviation[0], rms=figures.deviation[1]),
        wall_seconds={name: seconds for name, seconds in meter.wall.items() if seconds},
        cpu_seconds={name: meter.cpu[name] for name, seconds in meter.wall.items() if seconds},
        phase_peak_mb=meter.peak_mb,
        peak_mb=max(begun.peak_mb, *meter.peak_mb.values()),
        notes=[*begun.notes, *notes_of(len(made.mesh.quads), int(options["quads"]), figures)],
        versions=begun.versions,
        machine=begun.machine,
        options=options,
        field_options=field_options,
    )


def points_of(field: ImposedField) -> list[ImposedPointFigures]:
    """Of index other than 0, corners included."""
    domain = field.field.domain
    points, on_boundary = np.asarray(domain.vertices), np.zeros(len(domain.vertices), bool)
    on_boundary[np.asarray(domain.edges)[np.asarray(domain.edge_triangles).min(axis=1) < 0]] = True
    return [
        ImposedPointFigures(position=points[vertex].tolist(), index_times_four=four, boundary=bool(on_boundary[vertex]))
        for vertex, four in imposed_indices(field).items()
    ]


def misalignment_of(field: ImposedField) -> list[Misalignment]:
    return [
        Misalignment(boundary=c.boundary, vertex=c.vertex, angle_deg=math.degrees(c.angle), size_factor=c.size_factor)
        for c in field.conditions
    ]


def jacobians(values: Spread) -> JacobianFigures:
    return JacobianFigures(min=values.min, p05=values.p05, mean=values.mean)


def notes_of(made: int, wanted: int, figures: QuadFigures) -> list[str]:
    """Notes where the quads are far from what was asked for, or from the surface."""
    notes = []
    if wanted and not 1 / _OTHER_NUMBER <= made / wanted <= _OTHER_NUMBER:
        notes.append(
            f"{made:,} quads, {wanted:,} wanted: each arc of the layout has one at least, and few numbers fit all arcs;"
            " with fewer singular points there are fewer arcs"
        )
    if figures.deviation[0] > _FAR:
        notes.append(
            f"quads and surface are up to {100 * figures.deviation[0]:.2g} % of the diagonal apart: more quads follow"
            " it more closely, where features are followed"
        )
    return notes
