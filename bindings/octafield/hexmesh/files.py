"""The files of an all-hex mesh."""

from __future__ import annotations

import json
from pathlib import Path

from ..domain.cell_files import write_cells
from ..files.writing import vtu_bytes, write_file
from ..progress.phases import PeakMemory, PhaseClock, Progress, announce
from ..records.record_file import RECORD_FILE, write_record
from ..view.datasets import cell_grid
from .hex_mesh import HexMeshResult

MESH_FILES = ("mesh.vtu", "mesh.msh", "mesh.mesh")


def write_hex_mesh_result(result: HexMeshResult, folder: Path, progress: Progress | None = None) -> None:
    """mesh.vtu (cell data block and scaled_jacobian, point data support), mesh.msh and mesh.mesh, and the record with
    their names and the time it took."""
    announce(progress, "write")
    memory, clock = PeakMemory(), PhaseClock()
    record = result.record
    with clock.phase("write"):
        grid = cell_grid(result.mesh)
        grid.cell_data["scaled_jacobian"] = result.scaled_jacobians
        grid.cell_data["block"] = result.blocks
        grid.point_data["support"] = result.support
        metadata = {
            "program": f"octafield {record.version}",
            "input": record.input,
            "mesh_sha256": record.mesh_sha256,
            "options": json.dumps({name: value for name, value in record.options.items() if name != "threads"}),
        }
        write_file(folder / MESH_FILES[0], vtu_bytes(grid, metadata))
        for name in MESH_FILES[1:]:
            write_cells(folder / name, result.mesh)
    peak = round(memory.megabytes(), 1)
    result.record = record.changed(
        seconds=record.seconds + clock.wall["write"],
        wall_seconds={**record.wall_seconds, "write": clock.wall["write"]},
        cpu_seconds={**record.cpu_seconds, "write": clock.cpu["write"]},
        phase_peak_mb={**record.phase_peak_mb, "write": peak},
        peak_mb=max(record.peak_mb, peak),
        files=[*MESH_FILES, RECORD_FILE],
    )
    write_record(folder / RECORD_FILE, result.record)
