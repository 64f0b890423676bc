"""The files of a hex-dominant mesh."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from .. import _core
from ..domain.cell_files import write_cells
from ..files.writing import vtu_bytes, write_file
from ..progress.phases import PeakMemory, PhaseClock, Progress, announce
from ..records.hex_dominant import HexDominantRecord
from ..records.record_file import RECORD_FILE, write_record
from ..view.datasets import cell_grid
from .hex_mesh import HexDominantResult

MESH_FILES = ("mesh.vtu", "mesh.msh", "mesh.mesh", "singular.vtp")


def write_hex_result(result: HexDominantResult, folder: Path, progress: Progress | None = None) -> None:
    """mesh.vtu (cell data region and scaled_jacobian, point data support), mesh.msh and mesh.mesh (regions as physical
    groups and references), singular.vtp, and the record with their names and the time it took."""
    announce(progress, "write")
    memory, clock = PeakMemory(), PhaseClock()
    with clock.phase("write"):
        write_vtu(folder / MESH_FILES[0], result)
        for name in MESH_FILES[1:3]:
            write_cells(folder / name, result.mesh, regions=result.regions)
        metadata = _metadata(result.record)
        _core.write_singular_graph(folder / MESH_FILES[3], result.field.singular_graph, metadata)
    record, peak = result.record, round(memory.megabytes(), 1)
    result.record = record.changed(
        wall_seconds={**record.wall_seconds, "write": clock.wall["write"]},
        cpu_seconds={**record.cpu_seconds, "write": clock.cpu["write"]},
        phase_peak_mb={**record.phase_peak_mb, "write": peak},
        peak_mb=max(record.peak_mb, peak),
        files=[*MESH_FILES, RECORD_FILE],
    )
    write_record(folder / RECORD_FILE, result.record)


def write_vtu(path: Path, result: HexDominantResult) -> None:
    grid = cell_grid(result.mesh)
    grid.cell_data["scaled_jacobian"] = result.scaled_jacobians
    grid.cell_data["region"] = np.zeros(grid.n_cells, np.int32) if result.regions is None else result.regions
    grid.point_data["support"] = result.support
    write_file(path, vtu_bytes(grid, _metadata(result.record)))


def _metadata(record: HexDominantRecord) -> dict[str, str]:
    """What makes a file understandable by itself; no times and threads, so that equal runs write equal files."""
    options = {name: value for name, value in record.field_options.items() if name != "threads"}
    return {
        "program": f"octafield {record.version}",
        "input": record.input,
        "mesh_sha256": record.mesh_sha256,
        "options": json.dumps(record.options),
        "field_options": json.dumps(options),
    }
