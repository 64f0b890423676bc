"""From a mesh to hexahedra alone, as far as it goes: field, seamless map, hexahedra; else to mostly hexahedra."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .._core import SeamlessMap
from ..errors import GeometryError, SolverError
from ..hexdom.files import MESH_FILES, write_hex_result
from ..hexdom.hex_mesh import HexDominantResult, compute_hex_dominant
from ..hexdom.options import HexMeshOptions
from ..options import FieldOptions, require_one_of
from ..progress.phases import Progress
from ..records.record_file import RECORD_FILE, write_record
from .files import write_hex_mesh_result
from .hex_mesh import compute_hex_mesh
from .options import FALLBACKS
from .seamless import MAP_FILE, MAP_RECORD, compute_seamless_map, write_seamless_result

if TYPE_CHECKING:
    from ..records.hex_mesh import HexMeshRecord, SeamlessMapRecord

DOMINANT_RECORD = "hex_dominant.json"


def hex_mesh_of_field(
    source: str | Path,
    options: FieldOptions,
    folder: Path,
    progress: Progress | None = None,
    *,
    cells: int = 0,
    edge_length: float = 0.0,
    walls: str = "file",
    fallback: str = FALLBACKS[0],
) -> HexMeshRecord | SeamlessMapRecord:
    """What was reached goes into the folder: the map with its record, then the hexahedra with theirs, or, where these
    are not to be had, a hex-dominant mesh along the same field with its record (fallback: "none" leaves it out) and the
    map's record as result.json, too, with what stopped it. Returns the record of result.json. Raises what
    compute_seamless_map raises, InvalidInput, Cancelled."""
    require_one_of("fallback", fallback, FALLBACKS)
    seamless = compute_seamless_map(source, options, progress)
    write_seamless_result(seamless, folder)
    stopped = seamless.record
    length = edge_length or (0.0 if cells else _mean_edge(seamless.map))
    if stopped.stage == "injective":
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
    files, notes = [MAP_FILE, MAP_RECORD, RECORD_FILE], list(stopped.notes)
    if fallback == "hex-dominant":
        try:
            other = compute_hex_dominant(
                seamless.field, options, progress, hex_options=HexMeshOptions(cells=cells, edge_length=length)
            )
        except (GeometryError, SolverError) as error:
            notes.append(f"no hex-dominant mesh either: {error}")
        else:
            share = 100 * other.record.hex_volume_share
            notes.append(f"the mesh is hex-dominant: hexahedra fill {share:.3g} % of its volume ({DOMINANT_RECORD})")
            files += _write_dominant(other, folder, progress)
    stopped = stopped.changed(files=files, notes=notes)
    write_record(folder / RECORD_FILE, stopped)
    return stopped


def _write_dominant(made: HexDominantResult, folder: Path, progress: Progress | None) -> list[str]:
    write_hex_result(made, folder, progress)
    (folder / RECORD_FILE).unlink()
    files = [*MESH_FILES, DOMINANT_RECORD]
    write_record(folder / DOMINANT_RECORD, made.record.changed(files=files))
    return files


def _mean_edge(given: SeamlessMap) -> float:
    """Of the tets; those at singular curves are small, so that the boundary's edges say little."""
    tets, points = np.asarray(given.mesh.tets), np.asarray(given.mesh.vertices)
    corners = points[tets]
    return float(np.mean([np.linalg.norm(corners[:, a] - corners[:, b], axis=1) for a in range(4) for b in range(a)]))
