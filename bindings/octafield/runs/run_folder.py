"""The files of one run: field, singular curves, features and corners, streamlines, surface field, its singular points
and separatrices, record."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import BoundaryMeshability, FrameStreamline, Streamline, SurfaceSingularity, TetDomain
from ..fields.analysed import AnalysedField
from ..fields.direction_field import FieldOnSurface
from ..fields.frame_field import FieldResult
from ..fields.sizes import sizes_arrays
from ..files.writing import text_array, vtp_bytes, write_file
from ..frame_files.vtk import CONVENTION, STRETCHED_CONVENTION
from ..progress.phases import PeakMemory, PhaseClock, Progress, announce
from ..records.record_file import RECORD_FILE, write_record
from ..view.datasets import polylines

if TYPE_CHECKING:
    import pyvista

    from ..records.field import FieldRecord
    from ..records.surface_field import SurfaceFieldRecord

MESH_FILE = "mesh.vtu"  # of a comparison with meshes
SURFACE_FILES = ("surface.vtp", "surface_singularities.vtp", "surface_separatrices.vtp")
FIELD_FILES = ("field.vtu", "singular.vtp", "features.vtp", "streamlines.vtp", *SURFACE_FILES, MESH_FILE)


def write_field_result(result: FieldResult, folder: Path, progress: Progress | None = None) -> None:
    """Writes the files of a run, and the record with their names and the time it took."""
    announce(progress, "write")
    metadata = _metadata(result.record, result.stretch is not None)
    with _telling(result, folder, FIELD_FILES):
        _write_volume_files(result, folder, metadata)
        _write_surface_files(result, folder, metadata)


def write_analysis(result: AnalysedField, folder: Path, progress: Progress | None = None) -> None:
    """The files of the volume, the surface without a field, and the record."""
    import pyvista

    announce(progress, "write")
    metadata = _metadata(result.record, result.stretch is not None)
    with _telling(result, folder, FIELD_FILES):
        _write_volume_files(result, folder, metadata)
        surface = pyvista.PolyData.from_regular_faces(
            np.array(result.surface.vertices), np.array(result.surface.triangles, int)
        )
        _save(surface, folder / SURFACE_FILES[0], metadata)


def _write_volume_files(result: AnalysedField, folder: Path, metadata: dict[str, str]) -> None:
    more = {}
    if result.tet_frames is not None:
        more["tet_frames"] = result.tet_frames
    if result.lengths is not None:
        more["lengths" if result.tet_frames is None else "tet_lengths"] = result.lengths
    if result.feature_edges is not None:
        more["features"] = result.feature_edges
    if result.stretch is not None:
        more["stretch"] = result.stretch
    points, cells = sizes_arrays(result.sizes, result.tet_frames)
    _core.write_field(
        folder / "field.vtu", result.tets, result.frames, metadata, point_data=points, cell_data=cells, **more
    )
    _core.write_singular_graph(folder / "singular.vtp", result.singular_graph, metadata, result.meshability)
    if result.boundary_meshability is not None:
        write_features(
            folder / "features.vtp", result.tets, result.boundary_meshability, metadata, result.wedge_alignment
        )
    if result.streamlines:
        write_streamlines(folder / "streamlines.vtp", result.streamlines, metadata)


def write_surface_result(result: FieldOnSurface, folder: Path, progress: Progress | None = None) -> None:
    """The files of a surface field, and the record."""
    announce(progress, "write")
    metadata = _metadata(result.record)
    with _telling(result, folder, SURFACE_FILES):
        _write_surface_files(result, folder, metadata)


def _write_surface_files(
    result: FieldResult | FieldOnSurface,
    folder: Path,
    metadata: dict[str, str],
) -> None:
    surface, points, curves = (folder / name for name in SURFACE_FILES)
    if isinstance(result, FieldOnSurface) and result.vertex_data:
        _save(result.dataset(), surface, metadata)
    else:
        _core.write_surface_field(surface, result.surface, result.directions, metadata)
    write_singular_points(points, result.singularities.points, metadata)
    write_streamlines(curves, result.separatrices, metadata)


def write_singular_points(path: Path, singularities: Sequence[SurfaceSingularity], metadata: dict[str, str]) -> None:
    """.vtp vertices with point data index (turns), triangle, vertex (-1: none) and boundary (0/1)."""
    import pyvista

    points = np.array([s.position for s in singularities], dtype=float).reshape(-1, 3)
    poly = pyvista.PolyData()
    if len(points):
        poly = pyvista.PolyData(points)
    poly.point_data["index"] = np.array([s.index for s in singularities], float)
    poly.point_data["triangle"] = np.array([s.triangle for s in singularities], np.int32)
    poly.point_data["vertex"] = np.array([s.vertex for s in singularities], np.int32)
    poly.point_data["boundary"] = np.array([s.boundary for s in singularities], np.uint8)
    _save(poly, path, metadata)


def write_streamlines(
    path: Path, lines: Sequence[Streamline] | Sequence[FrameStreamline], metadata: dict[str, str]
) -> None:
    """.vtp polylines with cell data length, first_end and last_end (words, see octafield.surface.Streamline and
    octafield.volume.FrameStreamline); for curves on surfaces first_singularity and last_singularity (places in the file
    of singular points, -1: none). Curves of a single point are left out, but for those on surfaces."""
    if lines and isinstance(lines[0], FrameStreamline):
        lines = [line for line in lines if isinstance(line, FrameStreamline) and len(line.points) > 1]
    poly = polylines([line.points for line in lines])
    poly.cell_data["length"] = np.array([line.length for line in lines], float)
    for name in ("first_singularity", "last_singularity"):
        if lines and hasattr(lines[0], name):
            poly.cell_data[name] = np.array([getattr(line, name) for line in lines], np.int32)
    for name in ("first_end", "last_end"):
        poly.GetCellData().AddArray(text_array(name, [getattr(line, name) for line in lines]))
    _save(poly, path, metadata)


def write_features(
    path: Path,
    tets: TetDomain,
    found: BoundaryMeshability,
    metadata: dict[str, str],
    off_wedges: np.ndarray | None = None,
) -> None:
    """.vtp: corners as vertex cells, then feature edges (one line per wedge), then edges of the surface that a singular
    edge crosses. Cell data kind (0, 1, 2 in this order), meshable (0/1) and hexahedra (lines: the lower number of the
    two ends; corners: what is left for edges inside; octafield.volume.no_number: none), angle (of the wedge, degrees;
    else 0), vertex (of the tet mesh; lines: the first of their two); with off_wedges, (k, 2) radians, off_faces and
    off_edge (of the wedge, degrees; else 0)."""
    import pyvista

    corners, wedges, crossings = found.corners, found.wedges, found.crossings
    pairs = [(wedge.a, wedge.b) for wedge in wedges] + [(crossing.a, crossing.b) for crossing in crossings]
    edges = np.array(pairs, np.int64).reshape(-1, 2)
    ids = np.array([c.vertex for c in corners], np.int64)
    used, place = np.unique(np.concatenate([ids, edges.ravel()]), return_inverse=True)
    lines = place.ravel()[len(ids) :].reshape(-1, 2)
    poly = pyvista.PolyData()
    if len(used):
        poly.points = np.asarray(tets.vertices)[used]
        poly.verts = np.column_stack([np.full(len(ids), 1), place.ravel()[: len(ids)]]).ravel()
        poly.lines = np.column_stack([np.full(len(lines), 2), lines]).ravel()
    wedge_numbers = [min((n for n in (w.hexahedra_a, w.hexahedra_b) if n != _core.no_number), default=_core.no_number)
                     for w in wedges]  # fmt: skip
    crossing_numbers = [c.hexahedra for c in crossings]
    columns = {
        "kind": [0] * len(corners) + [1] * len(wedges) + [2] * len(crossings),
        "meshable": [c.meshable for c in corners] + [w.meshable for w in wedges] + [n >= 1 for n in crossing_numbers],
        "hexahedra": [c.inside for c in corners] + wedge_numbers + crossing_numbers,
        "vertex": [*ids, *edges[:, 0]],
    }
    for name, values in columns.items():
        poly.cell_data[name] = np.array(values, np.int32)
    degrees = {"angle": np.array([np.degrees(w.angle) for w in wedges], float)}
    if off_wedges is not None:
        degrees |= {"off_faces": np.degrees(off_wedges[:, 0]), "off_edge": np.degrees(off_wedges[:, 1])}
    for name, of_wedges in degrees.items():
        poly.cell_data[name] = np.concatenate([np.zeros(len(corners)), of_wedges, np.zeros(len(crossings))])
    _save(poly, path, metadata)


def _save(poly: pyvista.PolyData, path: Path, metadata: dict[str, str]) -> None:
    write_file(path, vtp_bytes(poly, metadata))


def _metadata(record: FieldRecord | SurfaceFieldRecord, stretched: bool = False) -> dict[str, str]:
    """What makes a file understandable by itself; no times, so that equal runs write equal files, and no
    thread count, on which results do not depend."""
    options = {name: value for name, value in record.options.items() if name != "threads"}
    return {
        "program": f"octafield {record.version}",
        "input": record.input,
        "mesh_sha256": record.mesh_sha256,
        "options": json.dumps(options),
        "energy": repr(record.energy),
        "convention": STRETCHED_CONVENTION if stretched else CONVENTION,
    }


@contextlib.contextmanager
def _telling(result: AnalysedField | FieldOnSurface, folder: Path, names: Sequence[str]) -> Iterator[None]:
    """Files are written in the block; then the record, with what that took and which of `names` are there."""
    memory, clock = PeakMemory(), PhaseClock()
    clock.wall, clock.cpu = dict(result.record.wall_seconds), dict(result.record.cpu_seconds)
    with clock.phase("write"):
        yield
    told = {
        "wall_seconds": clock.wall,
        "cpu_seconds": clock.cpu,
        "peak_mb": max(result.record.peak_mb, round(memory.megabytes(), 1)),
        "files": [*(name for name in names if (folder / name).exists()), RECORD_FILE],
    }
    result.record = result.record.changed(**told)
    write_record(folder / RECORD_FILE, result.record)
