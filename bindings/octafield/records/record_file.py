"""Records as files: written by one function, read and checked by one."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import IoError
from ..files.writing import write_json

if TYPE_CHECKING:
    from pydantic import ValidationError

    from .atlas import AtlasRecord
    from .base import Record
    from .field import FieldRecord, RunWithField, RunWithoutField
    from .hex_dominant import HexDominantRecord
    from .hex_mesh import HexMeshRecord, SeamlessMapRecord
    from .quad_layout import QuadLayoutRecord
    from .quad_mesh import QuadMeshRecord
    from .remesh import RemeshRecord
    from .surface_field import SurfaceFieldRecord

    AnyRecord = (
        FieldRecord
        | SurfaceFieldRecord
        | HexDominantRecord
        | HexMeshRecord
        | SeamlessMapRecord
        | QuadLayoutRecord
        | QuadMeshRecord
        | AtlasRecord
        | RemeshRecord
        | RunWithField
        | RunWithoutField
    )

RECORD_FILE = "result.json"
_WHAT = {
    "AtlasRecord": "an atlas",
    "FieldRecord": "a frame field",
    "GivenFieldRecord": "a frame field",
    "HexDominantRecord": "a hex-dominant mesh",
    "HexMeshRecord": "a hex mesh",
    "QuadLayoutRecord": "a quad layout",
    "QuadMeshRecord": "a quad mesh",
    "RemeshRecord": "a remeshed surface",
    "RunWithField": "a frame field",
    "RunWithoutField": "a run of a study that ended without a field",
    "SeamlessMapRecord": "a seamless map",
    "SurfaceFieldRecord": "a surface field",
}
_REMEDY = "write it again with the command that made it, or give the result.json of another run"


def write_record(path: Path, record: Record | Sequence[Record]) -> None:
    """A record, or a list of them, as JSON. Raises IoError."""
    from .base import Record

    write_json(path, record.to_dict() if isinstance(record, Record) else [one.to_dict() for one in record])


def read_record(path: str | Path) -> FieldRecord:
    """The record of a frame field, in a result.json or what --json wrote. Keys of other versions are kept. Raises
    IoError where the file cannot be read, is cut short or holds something else, with the name that is wrong.

        >>> import pathlib, octafield
        >>> from octafield.domain.generators import generate
        >>> from octafield.runs.run_folder import write_field_result
        >>> result = octafield.compute_field(generate("box"), octafield.FieldOptions(edge_length=0.5))
        >>> write_field_result(result, pathlib.Path())
        >>> octafield.read_record("result.json").singular_edges
        0
    """
    from .field import FieldRecord

    record = any_record(path)
    if not isinstance(record, FieldRecord):
        raise IoError(f"{path}: no record of a frame field, but of {_WHAT[type(record).__name__]}", "other_record")
    return record


def read_surface_record(path: str | Path) -> SurfaceFieldRecord:
    """The record of a surface field, as read_record reads that of a frame field.

    >>> import pathlib, octafield
    >>> from octafield.domain.generators import generate
    >>> from octafield.runs.run_folder import write_surface_result
    >>> write_surface_result(octafield.compute_surface_field(generate("ball")), pathlib.Path())
    >>> octafield.read_surface_record("result.json").index_sum
    2.0
    """
    from .surface_field import SurfaceFieldRecord

    record = any_record(path)
    if not isinstance(record, SurfaceFieldRecord):
        raise IoError(f"{path}: no record of a surface field, but of {_WHAT[type(record).__name__]}", "other_record")
    return record


def any_record(path: str | Path) -> AnyRecord:
    """Whichever it is."""
    try:
        content = json.loads(Path(path).read_text(encoding="utf-8"))
    except OSError as error:
        raise IoError(f"{path}: cannot read it ({error.strerror})", "cannot_read") from error
    except (ValueError, RecursionError) as error:
        raise IoError(f"{path}: not a record of octafield: no whole JSON ({error}); {_REMEDY}", "bad_record") from error
    return record_of(content, path)


def record_of(content: Any, name: object) -> AnyRecord:
    """The record that a JSON object holds. name: of its file, for messages. Raises IoError."""
    from pydantic import ValidationError

    if not isinstance(content, dict):
        raise IoError(f"{name}: not a record of octafield: no JSON object; {_REMEDY}", "bad_record")
    try:
        return _kind(content).model_validate(content)
    except ValidationError as error:
        raise IoError(f"{name}: not a record of octafield: {_told(error)}; {_REMEDY}", "bad_record") from error


def _kind(content: dict[str, Any]) -> type[AnyRecord]:
    from . import atlas, field, hex_dominant, hex_mesh, quad_layout, quad_mesh, remesh, surface_field

    if content.get("state", "done") != "done":
        return field.RunWithoutField
    if "state" in content:
        return field.RunWithField
    if "hex_volume_share" in content:
        return hex_dominant.HexDominantRecord
    if "index_sum" in content and "patches" in content:
        return quad_layout.QuadLayoutRecord
    if "chart_list" in content:
        return atlas.AtlasRecord
    if "size_ratio" in content:
        return quad_mesh.QuadMeshRecord
    if "blocks" in content and "arcs" in content:
        return hex_mesh.HexMeshRecord
    if "flipped_at_first" in content:
        return hex_mesh.SeamlessMapRecord
    if "off_surface" in content:
        return remesh.RemeshRecord
    if "symmetry" in content:
        return surface_field.SurfaceFieldRecord
    return field.GivenFieldRecord if "label" in content and "objective" not in content else field.FieldRecord


def _told(error: ValidationError) -> str:
    """The first few names that are wrong."""
    found = [f"{'.'.join(map(str, one['loc']))}: {one['msg'].lower()}" for one in error.errors()[:3]]
    more = error.error_count() - len(found)
    return ", ".join(found) + (f" and {more} more" if more > 0 else "")
