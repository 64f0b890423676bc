"""The files of a quad mesh."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..errors import InvalidInput
from ..files.scratch import through_file
from ..files.writing import vtp_bytes, vtu_bytes, write_file
from ..layout.files import field_polydata
from ..options import require_one_of
from ..progress.phases import PeakMemory, PhaseClock, Progress, announce
from ..records.record_file import RECORD_FILE, write_record
from .grid_maps import obj_bytes
from .options import FORMATS
from .quad_mesh import QuadMeshResult

if TYPE_CHECKING:
    from ..records.parts import ParameterizationFigures


def formats_of(words: str) -> list[str]:
    """Of "vtu,obj". Raises InvalidInput."""
    found = [word.strip() for word in words.split(",") if word.strip()]
    if not found:
        raise InvalidInput(f"no format is told; give some of {', '.join(FORMATS)}", "unknown_option_value")
    for word in found:
        require_one_of("format", word, FORMATS)
    return list(dict.fromkeys(found))


def write_quad_mesh_result(
    result: QuadMeshResult,
    folder: Path,
    formats: Sequence[str] = ("vtu",),
    progress: Progress | None = None,
    parameterization: bool = False,
) -> None:
    """mesh.* in each format, field.vtp (the crosses and sizes), and the record with their names and the time it took.
    mesh.vtu has cell data scaled_jacobian and size_ratio, point data quads (round the vertex) and boundary.
    parameterization: and parameterization.obj, u, v of the surface (grid_map). Raises as that, IoError."""
    announce(progress, "write")
    memory, clock = PeakMemory(), PhaseClock()
    metadata = _metadata(result)
    names = [f"mesh.{form}" for form in formats]
    figures = None
    with clock.phase("write"):
        for form, name in zip(formats, names, strict=True):
            if form == "vtu":
                write_file(folder / name, vtu_bytes(result.grid(), metadata))
            elif form in ("obj", "off"):
                write_file(folder / name, _text(result, form).encode())
            else:
                through_file(folder / name, f".{form}", partial(_through_meshio, result=result, form=form))
        write_file(folder / "field.vtp", vtp_bytes(field_polydata(result.field), metadata))
        if parameterization:
            names.append("parameterization.obj")
            figures = _write_map(result, folder / names[-1], progress)
    record, peak = result.record, round(memory.megabytes(), 1)
    result.record = record.changed(
        parameterization=figures,
        seconds=record.seconds + clock.wall["write"],
        wall_seconds={**record.wall_seconds, "write": clock.wall["write"]},
        cpu_seconds={**record.cpu_seconds, "write": clock.cpu["write"]},
        phase_peak_mb={**record.phase_peak_mb, "write": peak},
        peak_mb=max(record.peak_mb, peak),
        files=[*names, "field.vtp", RECORD_FILE],
    )
    write_record(folder / RECORD_FILE, result.record)


def _write_map(result: QuadMeshResult, path: Path, progress: Progress | None) -> ParameterizationFigures:
    from ..records.parts import ParameterizationFigures

    found = result.grid_map(progress)
    write_file(path, obj_bytes(found))
    return ParameterizationFigures(
        triangles=len(found.triangles),
        mean_distortion=found.mean_distortion,
        largest_distortion=found.largest_distortion,
        largest_residual=found.largest_residual,
    )


def _text(result: QuadMeshResult, form: str) -> str:
    """OBJ counts vertices from 1, OFF from 0."""
    points = [" ".join(f"{x:.17g}" for x in point) for point in np.asarray(result.mesh.vertices).tolist()]
    quads = np.asarray(result.mesh.quads).tolist()
    if form == "obj":
        lines = [f"v {point}" for point in points] + ["f " + " ".join(str(v + 1) for v in quad) for quad in quads]
    else:
        lines = ["OFF", f"{len(points)} {len(quads)} 0", *points]
        lines += ["4 " + " ".join(str(v) for v in quad) for quad in quads]
    return "\n".join(lines) + "\n"


def _through_meshio(path: Path, result: QuadMeshResult, form: str) -> None:
    """Gmsh 2.2 binary, Medit text, Abaqus."""
    import meshio

    mesh = meshio.Mesh(np.array(result.mesh.vertices, float), [("quad", np.array(result.mesh.quads, np.int64))])
    if form == "msh":
        ones = [np.ones(len(result.mesh.quads), np.int64)]
        mesh.cell_data = {"gmsh:physical": ones, "gmsh:geometrical": ones}
        meshio.gmsh.write(str(path), mesh, "2.2", binary=True)
    else:
        meshio.write(str(path), mesh, file_format={"mesh": "medit", "inp": "abaqus"}[form])


def _metadata(result: QuadMeshResult) -> dict[str, str]:
    """What makes a file understandable by itself; no times, so that equal runs write equal files."""
    record = result.record
    return {
        "program": f"octafield {record.version}",
        "input": record.input,
        "mesh_sha256": record.mesh_sha256,
        "options": json.dumps(record.options),
        "field_options": json.dumps(record.field_options),
    }
