"""The files of a quad layout."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import ImposedField
from ..files.scratch import through_file
from ..files.writing import vtp_bytes, vtu_bytes, write_file
from ..progress.phases import PeakMemory, PhaseClock, Progress, announce
from ..records.quad_layout import QuadLayoutRecord
from ..records.record_file import RECORD_FILE, write_record
from .blocks import LayoutParts, imposed_indices
from .quad_layout import QuadLayoutResult

if TYPE_CHECKING:
    import pyvista

LAYOUT_FILES = ("mesh.vtu", "mesh.msh", "layout.vtp", "field.vtp")


def write_layout_result(result: QuadLayoutResult, folder: Path, progress: Progress | None = None) -> None:
    """mesh.vtu and mesh.msh (quads with blocks and chords), layout.vtp (vertices, sides, patches), field.vtp (the
    crosses and sizes), and the record with their names and the time it took."""
    announce(progress, "write")
    memory, clock = PeakMemory(), PhaseClock()
    metadata = _metadata(result.record)
    with clock.phase("write"):
        write_file(folder / "mesh.vtu", vtu_bytes(quad_grid(result), metadata))
        through_file(folder / "mesh.msh", ".msh", lambda plain: _write_msh(plain, result))
        if result.layout is not None:
            write_file(folder / "layout.vtp", vtp_bytes(layout_polydata(result.layout), metadata))
        write_file(folder / "field.vtp", vtp_bytes(field_polydata(result.field), metadata))
    record, peak = result.record, round(memory.megabytes(), 1)
    result.record = record.changed(
        wall_seconds={**record.wall_seconds, "write": clock.wall["write"]},
        cpu_seconds={**record.cpu_seconds, "write": clock.cpu["write"]},
        phase_peak_mb={**record.phase_peak_mb, "write": peak},
        peak_mb=max(record.peak_mb, peak),
        files=[*(name for name in LAYOUT_FILES if (folder / name).is_file()), RECORD_FILE],
    )
    write_record(folder / RECORD_FILE, result.record)


def quad_grid(result: QuadLayoutResult) -> pyvista.UnstructuredGrid:
    """Cell data block, chords (2 numbers) and scaled_jacobian; point data quads (round the vertex) and boundary."""
    from ..view.datasets import quad_grid as plain

    grid = plain(result.mesh)
    grid.cell_data["block"] = result.blocks.astype(np.int32)
    grid.cell_data["chords"] = result.chords.astype(np.int32)
    grid.cell_data["scaled_jacobian"] = result.scaled_jacobians
    grid.point_data["quads"] = result.valences.astype(np.int32)
    grid.point_data["boundary"] = result.on_boundary.astype(np.uint8)
    return grid


def _write_msh(path: Path, result: QuadLayoutResult) -> None:
    """Gmsh 2.2, binary. Blocks are physical groups and entities, from 1; chords are element data."""
    import meshio

    blocks = result.blocks.astype(np.int64) + 1
    data = {
        "gmsh:physical": [blocks],
        "gmsh:geometrical": [blocks],
        "first_chord": [result.chords[:, 0].astype(float)],
        "second_chord": [result.chords[:, 1].astype(float)],
    }
    quads = np.array(result.mesh.quads, np.int64)
    mesh = meshio.Mesh(np.array(result.mesh.vertices), [("quad", quads)], cell_data=data)
    meshio.gmsh.write(str(path), mesh, "2.2", binary=True)


def layout_polydata(layout: LayoutParts) -> pyvista.PolyData:
    """Vertices of the layout, then its sides as polylines, then the polygons of its patches. Cell data: kind 0, 1, 2 in
    this order; number (of the vertex, side or patch); chord of sides, else -1; index_times_four of vertices, else 0;
    boundary: 1 for vertices and sides there."""
    import pyvista

    vertices, sides, polygons = len(layout.positions), len(layout.sides), len(layout.polygon_patches)
    lengths = [len(side) for side in layout.sides]
    starts = vertices + np.cumsum([0, *lengths])
    lines = [np.r_[n, np.arange(a, a + n)] for a, n in zip(starts, lengths, strict=False)]
    corners = layout.corners + starts[-1]
    sizes = np.diff(layout.first)
    faces = np.insert(corners, layout.first[:-1], sizes)
    mesh = pyvista.PolyData()
    mesh.points = np.concatenate([layout.positions, *layout.sides, layout.points])
    mesh.verts = np.column_stack([np.ones(vertices, np.int64), np.arange(vertices)]).ravel()
    if lines:  # a torus in one block has none
        mesh.lines = np.concatenate(lines)
    mesh.faces = faces
    kinds = (vertices, sides, polygons)
    at_rim = np.array([kind in ("corner", "boundary") for kind in layout.kinds], bool)
    mesh.cell_data["kind"] = np.repeat(np.arange(3, dtype=np.int32), kinds)
    mesh.cell_data["number"] = np.concatenate([np.arange(vertices), np.arange(sides), layout.polygon_patches]).astype(
        np.int32
    )
    mesh.cell_data["chord"] = _by_kind(kinds, 1, layout.side_chords, -1)
    mesh.cell_data["index_times_four"] = _by_kind(kinds, 0, layout.indices_times_four, 0)
    mesh.cell_data["boundary"] = _by_kind(kinds, 0, at_rim, 0) + _by_kind(kinds, 1, layout.on_boundary, 0)
    return mesh


def _by_kind(kinds: tuple[int, int, int], kind: int, values: np.ndarray, other: int) -> np.ndarray:
    """(cells,) the values of one kind, and `other` for the rest."""
    result = np.full(sum(kinds), other, np.int32)
    first = sum(kinds[:kind])
    result[first : first + kinds[kind]] = values
    return result


def field_polydata(field: ImposedField) -> pyvista.PolyData:
    """The surface refined round the singular points. Point data: direction (one of the four; with free axes
    the next one is at any angle from it), log_size (H; exp(H) is
    the edge length of quads there up to one factor), index_times_four."""
    import pyvista

    domain = field.field.domain
    surface: pyvista.PolyData = pyvista.PolyData.from_regular_faces(
        np.array(domain.vertices), np.array(domain.triangles, int)
    )
    indices = np.zeros(surface.n_points, np.int32)
    for vertex, four in imposed_indices(field).items():
        indices[vertex] = four
    surface.point_data["direction"] = np.asarray(_core.vertex_directions(field.field))
    surface.point_data["log_size"] = np.array(field.log_size)
    surface.point_data["index_times_four"] = indices
    return surface


def _metadata(record: QuadLayoutRecord) -> dict[str, str]:
    """What makes a file understandable by itself; no times, so that equal runs write equal files."""
    return {
        "program": f"octafield {record.version}",
        "input": record.input,
        "mesh_sha256": record.mesh_sha256,
        "options": json.dumps(record.options),
        "field_options": json.dumps(record.field_options),
    }
