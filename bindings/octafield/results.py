"""The files of one run: field, singular curves, surface field, singular points, record."""

import json
from pathlib import Path

import numpy as np

from . import _core
from .output import write_json
from .phases import PhaseClock, Progress, announce
from .pipeline import FieldResult, SurfaceFieldResult

FIELD_FILES = ("field.vtu", "singular.vtp", "surface.vtp", "surface_singularities.vtp")
SURFACE_FILES = ("surface.vtp", "surface_singularities.vtp")
RECORD_FILE = "result.json"


def write_field_result(result: FieldResult, folder: Path, progress: Progress | None = None) -> None:
    """Writes the files of a run, and the record with their names and the time it took."""
    announce(progress, "write")
    metadata = _metadata(result.record)
    clock = _clock(result.record)
    with clock.phase("write"):
        _core.write_field(folder / "field.vtu", result.tets, result.frames, metadata)
        _core.write_singular_graph(folder / "singular.vtp", result.singular_graph, metadata)
        _core.write_surface_field(folder / "surface.vtp", result.surface, result.directions, metadata)
        write_singular_points(folder / "surface_singularities.vtp", result.singularities, metadata)
    result.record["files"] = [*FIELD_FILES, RECORD_FILE]
    write_json(folder / RECORD_FILE, result.record)


def write_surface_result(result: SurfaceFieldResult, folder: Path, progress: Progress | None = None) -> None:
    announce(progress, "write")
    metadata = _metadata(result.record)
    with _clock(result.record).phase("write"):
        _core.write_surface_field(folder / "surface.vtp", result.surface, result.directions, metadata)
        write_singular_points(folder / "surface_singularities.vtp", result.singularities, metadata)
    result.record["files"] = [*SURFACE_FILES, RECORD_FILE]
    write_json(folder / RECORD_FILE, result.record)


def write_singular_points(path: Path, singularities, metadata: dict[str, str]) -> None:
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
    for name, text in metadata.items():
        poly.GetFieldData().AddArray(_text_array(name, text))
    poly.save(path)


def _text_array(name: str, text: str):
    """UTF-8, as in the other files; pyvista's own field data holds ASCII only."""
    from vtkmodules.vtkCommonCore import vtkStringArray

    array = vtkStringArray()
    array.SetName(name)
    array.InsertNextValue(text)
    return array


def _metadata(record: dict) -> dict[str, str]:
    """What makes a file understandable by itself; no times, so that equal runs write equal files, and no
    thread count, on which results do not depend."""
    options = {name: value for name, value in record["options"].items() if name != "threads"}
    return {
        "program": f"octafield {record['version']}",
        "input": record["input"],
        "mesh_sha256": record["mesh_sha256"],
        "options": json.dumps(options),
        "energy": repr(record["energy"]),
        "convention": "frame axes are the columns of R(quaternion), quaternion w x y z, sh4 order m = -4..4",
    }


def _clock(record: dict) -> PhaseClock:
    """A clock that adds to the record's own times."""
    clock = PhaseClock()
    clock.wall, clock.cpu = record["wall_seconds"], record["cpu_seconds"]
    return clock
