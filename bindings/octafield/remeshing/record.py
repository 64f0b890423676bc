"""The record of a remeshed surface. Imported where a record is made: pydantic takes long to import."""

from __future__ import annotations

import numpy as np

from .. import _core
from .._core import CloseRemeshResult, FeatureGraph, TriangleMesh
from ..domain.meshing import SoundInput
from ..options import MeshOptions
from ..progress.phases import PeakMemory, machine, octafield_version, versions
from ..quad_mesh.features import distance_to, lines_of
from ..records.parts import BothWays, KeptFeatures, Machine, QualityFigures
from ..records.remesh import RemeshRecord
from .options import RemeshingOptions

_LENGTH_WITHIN = 0.05  # of the length asked for, that of edges away from features is met


def of_remesh(
    sound: SoundInput,
    surface: TriangleMesh,
    made: CloseRemeshResult,
    options: RemeshingOptions,
    mesh_options: MeshOptions,
    memory: PeakMemory,
) -> RemeshRecord:
    """surface: that was remeshed. Figures of triangles and features are found on the arrays, not by what made them."""
    found, mesh, diagonal = sound.found, made.mesh, _core.bounding_box_diagonal(surface.vertices)
    qualities = np.asarray(_core.triangle_qualities(mesh))
    sides = np.asarray(_core.edge_topology(mesh).edge_triangles)
    wall = {name: seconds for name, seconds in sound.clock.wall.items() if seconds}
    return RemeshRecord(
        input=found.name,
        version=octafield_version(),
        input_kind=found.kind,
        input_vertices=len(surface.vertices),
        input_triangles=len(surface.triangles),
        feature_source=sound.feature_source,
        target_vertices=options.vertices or None,
        target_length=options.edge_length or None,
        vertices=len(mesh.vertices),
        triangles=len(mesh.triangles),
        mean_edge=float(_core.mean_edge_length(mesh)),
        quality=QualityFigures(
            min=float(qualities.min()), p05=float(np.percentile(qualities, 5)), mean=float(qualities.mean())
        ),
        poor=made.poor,
        forced=made.forced,
        smallest_angle=smallest_angle(mesh),
        deviation=BothWays(of_input=made.deviation / diagonal, of_mesh=made.own_deviation / diagonal),
        off_surface=made.off_surface / diagonal,
        features=kept_features(surface, followed(sound.features, made), mesh, made.features),
        watertight=bool((sides >= 0).all()),
        open_edges=int((sides < 0).any(axis=1).sum()),
        kept=made.kept,
        seconds=sum(wall.values()),
        wall_seconds=wall,
        cpu_seconds={name: sound.clock.cpu[name] for name in wall},
        peak_mb=round(max(sound.peak_mb, memory.megabytes()), 1),
        notes=[*found.notes, *made.notes, *off_length(made, options)],
        versions=versions(),
        machine=Machine.model_validate(machine()),
        options=dict(vars(options)),
        mesh_options=mesh_options.recorded(),
    )


def off_length(made: CloseRemeshResult, options: RemeshingOptions) -> list[str]:
    """A note where edges away from features are not as long in the mean as was asked for."""
    points, on_feature = np.asarray(made.mesh.vertices), np.zeros(len(made.mesh.vertices), bool)
    on_feature[np.asarray(made.features.edges).ravel()] = True
    ends = np.asarray(_core.edge_topology(made.mesh).edges)
    ends = ends[~on_feature[ends].any(axis=1)]
    if not options.edge_length or not len(ends):
        return []
    mean = float(np.linalg.norm(points[ends[:, 1]] - points[ends[:, 0]], axis=1).mean())
    if abs(mean / options.edge_length - 1) <= _LENGTH_WITHIN:
        return []
    why = " so that the deviation is kept" if options.deviation and mean < options.edge_length else ""
    return [
        f"edges away from features have a mean length of {mean:.3g}, not the {options.edge_length:.3g} asked for{why}"
    ]


def smallest_angle(mesh: TriangleMesh) -> float:
    """Degrees."""
    corners = np.asarray(mesh.vertices)[np.asarray(mesh.triangles)]
    u, v = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    angles = np.arctan2(np.linalg.norm(np.cross(u, v), axis=2), (u * v).sum(axis=2))
    return float(np.degrees(angles.min()))


def followed(features: FeatureGraph, made: CloseRemeshResult) -> FeatureGraph:
    """Without what noise made, if that was left out."""
    edges = {tuple(sorted(edge)) for edge in np.asarray(features.edges).tolist()}
    edges -= {tuple(sorted(edge)) for edge in np.asarray(made.stubs).tolist()}
    kept = np.array(sorted(edges), np.int32).reshape(-1, 2)
    there = set(kept.ravel().tolist())
    return FeatureGraph(kept, [corner for corner in features.corners if corner in there])


def kept_features(
    surface: TriangleMesh, features: FeatureGraph, mesh: TriangleMesh, made: FeatureGraph
) -> KeptFeatures:
    points, places = np.asarray(surface.vertices), np.asarray(mesh.vertices)
    corners = points[np.asarray(features.corners, int)]
    there = {tuple(place) for place in places.tolist()}
    edges, lines = np.asarray(made.edges).reshape(-1, 2), np.asarray(features.edges).reshape(-1, 2)
    off = 0.0
    if len(edges) and len(lines):
        off = float(distance_to(lines_of(points, lines), places[np.unique(edges)]).max())
    return KeptFeatures(
        corners=len(corners),
        missed_corners=sum(tuple(corner) not in there for corner in corners.tolist()),
        edges=len(edges),
        off_curves=off / _core.bounding_box_diagonal(surface.vertices),
    )
