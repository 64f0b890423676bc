"""The files of an atlas."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from .. import _core
from .._core import Atlas
from ..files.writing import vtp_bytes, write_file
from ..progress.phases import PeakMemory, PhaseClock, Progress, announce
from ..records.parts import PhaseSeconds
from ..records.record_file import RECORD_FILE, write_record
from .atlas import AtlasResult

ATLAS_FILES = ("charts.vtp", "atlas.obj")


def write_atlas_result(result: AtlasResult, folder: Path, progress: Progress | None = None) -> None:
    """charts.vtp (AtlasResult.dataset), atlas.obj (the surface with texture coordinates: charts side by side in the
    unit square, at one scale), and the record with their names and the time it took."""
    announce(progress, "write")
    memory, clock = PeakMemory(), PhaseClock()
    record = result.record
    metadata = {
        "program": f"octafield {record.version}",
        "input": record.input,
        "mesh_sha256": record.mesh_sha256,
        "options": json.dumps(record.options),
        "mesh_options": json.dumps(record.mesh_options),
    }
    with clock.phase("write"):
        write_file(folder / "charts.vtp", vtp_bytes(result.dataset(), metadata))
        write_file(folder / "atlas.obj", obj_text(result.atlas).encode())
    result.record = record.changed(
        wall_seconds=PhaseSeconds(**{**record.wall_seconds, "write": clock.wall["write"]}),
        cpu_seconds=PhaseSeconds(**{**record.cpu_seconds, "write": clock.cpu["write"]}),
        peak_mb=max(record.peak_mb, round(memory.megabytes(), 1)),
        files=[*ATLAS_FILES, RECORD_FILE],
    )
    write_record(folder / RECORD_FILE, result.record)


def obj_text(atlas: Atlas) -> str:
    """Wavefront OBJ counts from 1. Each chart is a group."""
    mesh, (uv, _) = atlas.domain.mesh, _core.packed_uv(atlas)
    lines = [f"v {x:.17g} {y:.17g} {z:.17g}" for x, y, z in np.asarray(mesh.vertices).tolist()]
    lines += [f"vt {u:.17g} {v:.17g}" for u, v in uv.tolist()]
    charts = np.asarray(atlas.charts)
    order = np.argsort(charts, kind="stable")
    corners = np.stack([np.asarray(mesh.triangles), np.asarray(atlas.uv_triangles)], axis=2)[order] + 1
    last = -1
    for chart, ((a, p), (b, q), (c, r)) in zip(charts[order].tolist(), corners.tolist(), strict=True):
        if chart != last:
            lines.append(f"g chart_{chart}")
            last = chart
        lines.append(f"f {a}/{p} {b}/{q} {c}/{r}")
    return "\n".join(lines) + "\n"
