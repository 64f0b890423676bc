"""From a mesh to hexahedra alone, as far as it goes: field, seamless map, hexahedra."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .._core import SeamlessMap
from ..errors import GeometryError, SolverError
from ..options import FieldOptions
from ..progress.phases import Progress
from ..records.record_file import RECORD_FILE, write_record
from .files import write_hex_mesh_result
from .hex_mesh import compute_hex_mesh
from .seamless import MAP_FILE, MAP_RECORD, compute_seamless_map, write_seamless_result

if TYPE_CHECKING:
    from ..records.hex_mesh import HexMeshRecord, SeamlessMapRecord


def hex_mesh_of_field(
    source: str | Path,
    options: FieldOptions,
    folder: Path,
    progress: Progress | None = None,
    *,
    cells: int = 0,
    edge_length: float = 0.0,
    walls: str = "file",
) -> HexMeshRecord | SeamlessMapRecord:
    """What was reached goes into the folder: the map with its record, then the hexahedra with theirs, or, where these
    are not to be had, the map's record as result.json, too, with what stopped it. Returns the record of result.json.
    Raises what compute_seamless_map raises, InvalidInput, Cancelled."""
    seamless = compute_seamless_map(source, options, progress)
    write_seamless_result(seamless, folder)
    stopped = seamless.record
    if stopped.stage == "injective":
        length = edge_length or (0.0 if cells else _mean_edge(seamless.map))
        try:
            made = compute_hex_mesh(
                seamless.map, progress, cells=cells, edge_length=length, walls=walls, threads=options.threads
            )
        except (GeometryError, SolverError) as error:
            note = f"no hexahedra of the map: {error}"
            stopped = stopped.changed(stopped_by=error.kind or "unknown", notes=[*stopped.notes, note])
        else:
            made.record = made.record.changed(input=seamless.record.input)
            write_hex_mesh_result(made, folder, progress)
            made.record = made.record.changed(files=[*(made.record.files or []), MAP_FILE, MAP_RECORD])
            write_record(folder / RECORD_FILE, made.record)
            return made.record
    stopped = stopped.changed(files=[MAP_FILE, MAP_RECORD, RECORD_FILE])
    write_record(folder / RECORD_FILE, stopped)
    return stopped


def _mean_edge(given: SeamlessMap) -> float:
    """Of the tets; those at singular curves are small, so that the boundary's edges say little."""
    tets, points = np.asarray(given.mesh.tets), np.asarray(given.mesh.vertices)
    corners = points[tets]
    return float(np.mean([np.linalg.norm(corners[:, a] - corners[:, b], axis=1) for a in range(4) for b in range(a)]))
