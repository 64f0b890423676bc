"""What a finished frame field is judged by: its singular graph, whether a hex mesh could follow it, how well it is
aligned, how far it is from the gradients of a map; and streamlines to look at it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import (
    FieldAnalysis,
    FrameStreamline,
    SectorNormals,
)
from ..domain.meshed_input import MeshedInput
from . import verdict

if TYPE_CHECKING:
    from ..records.field import FieldFigures


@dataclass
class VertexAnalysis:
    """of_field: what C++ finds. off_vertices: of the boundary, too far from a normal that is served. figures: for
    the record."""

    of_field: FieldAnalysis
    streamlines: list[FrameStreamline]
    off_vertices: np.ndarray
    figures: FieldFigures


def analyse(
    meshed: MeshedInput,
    frames: np.ndarray,
    threads: int = 0,
    streamlines: int = 0,
    feature_tolerance: float = _core.BoundaryOptions().feature_tolerance,
    stretch: np.ndarray | None = None,
) -> VertexAnalysis:
    """streamlines: number of seeds, three curves each. feature_tolerance: radians, of the constraints. stretch: (n, 6)
    of axes S Q; None: at right angles."""
    from . import record

    tets = meshed.volume()
    found = _core.analyse_field(tets, frames, stretch=stretch, threads=threads)
    alignment = np.asarray(found.alignment)
    sectors = _core.sector_normals(tets)
    unserved = unserved_sectors(meshed, sectors, feature_tolerance, stretch)
    off = verdict.off_vertices(alignment[~unserved], np.asarray(sectors.vertex)[~unserved])
    size = _core.shape_size(tets.surface.mesh)
    seeds = _core.spread_points(tets, streamlines)
    lines = []
    if len(seeds):
        lines = _core.frame_streamlines(tets, frames, seeds, stretch=stretch, max_length=2 * size, threads=threads)
    unserved_vertices = len(np.unique(np.asarray(sectors.vertex)[unserved]))
    figures = record.of_field_at_vertices(found, unserved, unserved_vertices, lines, at_right_angles=stretch is None)
    return VertexAnalysis(found, lines, off, figures)


def unserved_sectors(
    meshed: MeshedInput, sectors: SectorNormals, feature_tolerance: float, stretch: np.ndarray | None = None
) -> np.ndarray:
    """(k,) true: at a vertex where smooth sectors meet and no frame fits all their normals and the tangents within the
    tolerance, so that constraints do not hold the normals (octafield.volume.boundary_constraints): the field may be off
    by up to 45 degrees there, whatever the method."""
    tets = meshed.volume()
    boundary = tets.surface
    vertex, normal = np.asarray(sectors.vertex), np.asarray(sectors.normal)
    tangents = np.cross(normal, np.eye(3)[np.abs(normal).argmin(axis=1)])  # any will do: on features the normals decide
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    directions = tangents[np.searchsorted(vertex, np.arange(len(boundary.mesh.vertices)))]
    held = _core.boundary_constraints(
        tets, directions, mode="aligned", feature_tolerance=feature_tolerance, stretch=stretch
    )
    loose = np.asarray(held.kind)[np.asarray(boundary.vertex_map)] != _core.constraint_kinds.index("fixed")
    several = np.bincount(vertex, minlength=len(loose)) > 1
    found: np.ndarray = (loose & several)[vertex]
    return found
