"""What a finished frame field is judged by: its singular graph, whether a hex mesh could follow it, how well it is
aligned, how far it is from the gradients of a map; and streamlines to look at it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import (
    BoundaryMeshability,
    FrameStreamline,
    Integrability,
    Meshability,
    SectorNormals,
    SingularGraph,
)
from ..domain.meshed_input import MeshedInput
from . import verdict

if TYPE_CHECKING:
    from ..records.field import FieldFigures


@dataclass
class FieldAnalysis:
    """alignment, feature_alignment: radians, one per sector normal and feature tangent. off_vertices: of the boundary,
    too far from a normal that is served. figures: for the record."""

    singular_graph: SingularGraph
    meshability: Meshability
    boundary_meshability: BoundaryMeshability
    integrability: Integrability
    alignment: np.ndarray
    feature_alignment: np.ndarray
    energy: float
    streamlines: list[FrameStreamline]
    off_vertices: np.ndarray
    figures: FieldFigures


def analyse(
    meshed: MeshedInput,
    frames: np.ndarray,
    threads: int = 0,
    streamlines: int = 0,
    feature_tolerance: float = _core.BoundaryOptions().feature_tolerance,
) -> FieldAnalysis:
    """streamlines: number of seeds, three curves each. feature_tolerance: radians, of the constraints."""
    from . import record

    tets = meshed.volume()
    graph = _core.singular_graph(tets, frames, threads=threads)
    meshability = _core.local_meshability(tets, frames, graph)
    at_boundary = _core.boundary_meshability(tets, frames, threads=threads)
    integrability = _core.integrability(tets, frames, threads=threads)
    alignment = np.asarray(_core.alignment_angles(tets, frames))
    sectors = _core.sector_normals(tets)
    unserved = unserved_sectors(meshed, sectors, feature_tolerance)
    off = verdict.off_vertices(alignment[~unserved], np.asarray(sectors.vertex)[~unserved])
    feature_alignment = np.asarray(_core.feature_alignment_angles(tets, frames))
    energy = float(_core.dirichlet_energy(tets, frames, threads=threads))
    size = _core.shape_size(tets.surface.mesh)
    seeds = _core.spread_points(tets, streamlines)
    lines = _core.frame_streamlines(tets, frames, seeds, max_length=2 * size, threads=threads) if len(seeds) else []
    figures = record.of_field_at_vertices(
        energy,
        graph,
        meshability,
        at_boundary,
        integrability,
        alignment,
        unserved,
        len(np.unique(np.asarray(sectors.vertex)[unserved])),
        feature_alignment,
        lines,
    )
    return FieldAnalysis(
        graph, meshability, at_boundary, integrability, alignment, feature_alignment, energy, lines, off, figures
    )


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
