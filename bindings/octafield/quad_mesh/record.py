"""The record of a quad mesh. Imported where a record is made: pydantic takes long to import."""

from __future__ import annotations

import numpy as np

from .._core import FeatureGraph, QuadMesh, SurfaceDomain
from ..domain.inputs import Input
from ..domain.meshed_input import MeshedInput
from ..layout.made import QuadsMade
from ..layout.quality import edges_of, quads_round
from ..layout.record import jacobians, notes_of, points_of
from ..meshes.figures import spread, surface_deviation
from ..options import SurfaceFieldOptions
from ..planar.quads import FixedBoundaryFigures
from ..progress.phases import PhaseClock
from ..records.parts import (
    Deviation,
    EdgeLengths,
    FeatureDeviation,
    FieldAngles,
    KeptBoundary,
    MinMax,
    SizeRatios,
    WholeNumberFigures,
)
from ..records.quad_mesh import QuadMeshRecord
from .features import feature_deviation
from .field_angles import angles_of, notes_of_field
from .given_field import GivenField
from .options import QuadMeshOptions

_SAME, _FAR = 1e-6, 0.02  # of the diagonal
_POOR = 0.1  # scaled Jacobian


def of_quad_mesh(
    made: QuadsMade,
    size_ratios: np.ndarray,
    target: int,
    triangles: int,
    options: QuadMeshOptions,
    field_options: SurfaceFieldOptions,
    own: GivenField | None,
) -> QuadMeshRecord:
    """size_ratios: of each quad. target: number of quads wanted. triangles: of the surface before it was refined. own:
    field that was given."""
    begun, figures, mesh, meter = made.begun, made.figures, made.quads.mesh, made.meter
    corners, curves = feature_deviation(mesh, made.whole)
    notes = notes_of_features(corners, curves)
    off_field = None
    if own is not None:
        off_field = FieldAngles(**angles_of(mesh, own))
        notes += notes_of_field(own, made.whole, off_field.p90, options.follow != "points")
    low, median, high = np.percentile(size_ratios, [10, 50, 90])
    smallest, largest = quad_angles(mesh)
    whole = made.quads.whole_numbers
    assert whole is not None  # of t-meshes, which quad meshes come from
    wall = {name: seconds for name, seconds in meter.wall.items() if seconds}
    return QuadMeshRecord(
        input=begun.input,
        version=begun.version,
        input_kind=begun.input_kind,
        mesh_sha256=begun.mesh_sha256,
        triangles=triangles,
        field_triangles=len(made.field.field.domain.triangles),
        feature_source=begun.feature_source,
        feature_edges=begun.feature_edges,
        point_source=made.pattern.source,
        field_singularities=points_of(made.field),
        target=target,
        quads=len(mesh.quads),
        vertices=len(mesh.vertices),
        irregular_vertices=_valences(figures.quads_round[~figures.on_boundary], 4),
        irregular_boundary_vertices=_valences(figures.quads_round[figures.on_boundary], 2),
        inverted=figures.inverted,
        nonconforming_edges=figures.nonconforming_edges,
        t_junctions=figures.t_junctions,
        scaled_jacobian=jacobians(figures.jacobians),
        angle=MinMax(min=smallest, max=largest),
        edge_length=EdgeLengths(
            target=made.target, median=figures.edges.median, p05=figures.edges.p05, p95=figures.edges.p95
        ),
        size_ratio=SizeRatios(p10=float(low), median=float(median), p90=float(high)),
        feature_deviation=FeatureDeviation(corners=corners, curves=curves),
        surface_deviation=Deviation(max=figures.deviation[0], rms=figures.deviation[1]),
        whole_numbers=WholeNumberFigures(objective=whole.deviation, bound=whole.bound, optimal=whole.optimal),
        seconds=sum(wall.values()),
        wall_seconds=wall,
        cpu_seconds={name: meter.cpu[name] for name in wall},
        phase_peak_mb=meter.peak_mb,
        peak_mb=max(begun.peak_mb, *meter.peak_mb.values()),
        field_angle=off_field,
        notes=[*begun.notes, *notes_of(len(mesh.quads), target, figures), *notes],
        versions=begun.versions,
        machine=begun.machine,
        options=dict(vars(options)),
        field_options=field_options.recorded(),
    )


def notes_of_features(corners: float, curves: float) -> list[str]:
    notes = []
    if corners > _SAME:
        notes.append(
            f"a corner between features is no vertex of the quads, by up to {100 * corners:.2g} % of the diagonal: two"
            " quads meet there on either side; more quads come nearer"
        )
    if curves > _FAR:
        notes.append(
            f"features or the boundary are up to {100 * curves:.2g} % of the diagonal away from edges of quads along"
            " them: more quads follow them more closely"
        )
    return notes


def of_kept_boundary(
    inside: QuadMeshRecord,
    mesh: QuadMesh,
    figures: FixedBoundaryFigures,
    clock: PhaseClock,
    size_ratios: np.ndarray,
    found: Input,
    target: int,
    options: QuadMeshOptions,
    field_options: SurfaceFieldOptions,
) -> QuadMeshRecord:
    """inside: of the quads round the outline, some of which are kept. clock: of all but these. found: the region as a
    surface."""
    phases = dict.fromkeys([*inside.wall_seconds, *clock.wall])
    wall, cpu = (
        {name: a.get(name, 0.0) + b.get(name, 0.0) for name in phases}
        for a, b in ((inside.wall_seconds, clock.wall), (inside.cpu_seconds, clock.cpu))
    )
    quads = np.asarray(mesh.quads)
    on_boundary, around = quads_round(quads, len(mesh.vertices))
    edges = edges_of(quads)[0]
    points = np.asarray(mesh.vertices)
    lengths = spread(np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1))
    domain = SurfaceDomain(found.surface)
    corners, curves = feature_deviation(mesh, domain)
    deviation = surface_deviation(points, np.zeros((0, 3), np.int32), quads, found.surface)
    low, median, high = np.percentile(size_ratios, [10, 50, 90])
    smallest, largest = quad_angles(mesh)
    notes = []
    if figures.split_segments:
        notes.append(
            f"{figures.split_segments} segments were split at their middle: the number round each region has to be even"
        )
    if figures.scaled_jacobian.min < _POOR:
        notes.append(
            f"the least scaled Jacobian is {figures.scaled_jacobian.min:.2g}: the segments of the outline and the quads"
            " wanted differ much in length, or corners are acute"
        )
    return inside.changed(
        input=found.name,
        mesh_sha256=MeshedInput(found.name, "surface", found.surface, FeatureGraph(), "none").digest(),
        feature_edges=0,
        target=target,
        quads=len(quads),
        vertices=len(points),
        irregular_vertices=_valences(around[~on_boundary], 4),
        irregular_boundary_vertices=_valences(around[on_boundary], 2),
        inverted=figures.inverted,
        nonconforming_edges=figures.nonconforming_edges,
        scaled_jacobian=jacobians(figures.scaled_jacobian),
        angle=MinMax(min=smallest, max=largest),
        edge_length=EdgeLengths(
            target=inside.edge_length.target, median=lengths.median, p05=lengths.p05, p95=lengths.p95
        ),
        size_ratio=SizeRatios(p10=float(low), median=float(median), p90=float(high)),
        feature_deviation=FeatureDeviation(corners=corners, curves=curves),
        surface_deviation=Deviation(max=deviation[0], rms=deviation[1]),
        kept_boundary=KeptBoundary(
            segments=figures.boundary_segments, kept=figures.kept_segments, split=figures.split_segments
        ),
        seconds=sum(wall.values()),
        wall_seconds=wall,
        cpu_seconds=cpu,
        notes=notes,
        options=dict(vars(options)),
        field_options=field_options.recorded(),
    )


def quad_angles(mesh: QuadMesh) -> tuple[float, float]:
    """The smallest and the largest of all corners, degrees: between edges in space."""
    corners = np.asarray(mesh.vertices)[np.asarray(mesh.quads)]
    u, v = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    angles = np.arctan2(np.linalg.norm(np.cross(u, v), axis=2), (u * v).sum(axis=2))
    return float(np.degrees(angles.min())), float(np.degrees(angles.max()))


def _valences(quads_round: np.ndarray, regular: int) -> dict[str, int]:
    found, counts = np.unique(quads_round[(quads_round != regular) & (quads_round > 0)], return_counts=True)
    return {str(valence): int(count) for valence, count in zip(found, counts, strict=True)}
