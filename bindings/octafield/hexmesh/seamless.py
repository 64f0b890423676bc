"""From a mesh to a seamless map: a field, its singular curves as edges, parameters along its axes.

result = compute_seamless_map("part.vtk")
result.map                        # octafield.volume.SeamlessMap
result.record.stage               # what was reached
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import SeamlessMap
from ..domain.inputs import naming
from ..domain.meshed_input import MeshedInput
from ..domain.meshing import Source
from ..domain.sites import require_right_angles
from ..errors import InvalidInput
from ..fields.analysed import AnalysedField
from ..fields.frame_field import compute_field
from ..options import FieldOptions
from ..progress.meter import PhaseMeter
from ..progress.phases import Progress, announce
from ..view.notebook import Facts, ShownInNotebooks
from .hexex import write_seamless_map

if TYPE_CHECKING:
    from ..records.hex_mesh import SeamlessMapRecord

MAP_FILE = "seamless.hexex"
MAP_RECORD = "seamless.json"
_RIGHT_ANGLES = "seamless maps are made along axes at right angles"
_SHOWN = ("stage", "stopped_by", "tets", "singular_edges", "flipped_at_first", "flipped", "angle_deg")


@dataclass(repr=False, kw_only=True)
class SeamlessMapResult(ShownInNotebooks):
    """A seamless map and what led to it.

    map: without walls; its tets are parts of the field's. parent: (m,) int32, the field's tet of each. curves: (e, 2)
    int32 singular edges of the map's tets. locked, flipped: int32 tets of it that are flat in every map, and in this
    one turned over or flat. field: on its tets. record: all figures."""

    map: SeamlessMap
    parent: np.ndarray
    curves: np.ndarray
    locked: np.ndarray
    flipped: np.ndarray
    field: AnalysedField
    record: SeamlessMapRecord

    def __repr__(self) -> str:
        r = self.record
        return f"SeamlessMapResult({r.input}: {r.stage}, {r.tets:,} tets, {r.flipped:,} of them flipped)"

    def _facts(self) -> Facts:
        return str(self.record.input), {name: self.record.to_dict()[name] for name in _SHOWN}


def compute_seamless_map(
    source: Source | MeshedInput | AnalysedField,
    options: FieldOptions = FieldOptions(),
    progress: Progress | None = None,
    *,
    unit: float = 0.0,
) -> SeamlessMapResult:
    """A seamless map of a tet mesh, or of the tets of a closed surface, along a frame field at its vertices that is
    computed, or along that of a result of compute_field or analyse. Whether it has folds, and what stops them from
    going, is told by record.stage and stopped_by, not raised.

    unit: length that has the parameters' length 1, input unit; 0: the mean edge of the tets.

    progress(phase, fraction, merit): False cancels. Raises InvalidInput, GeometryError, IoError, SolverError,
    Cancelled.

        >>> import octafield
        >>> from octafield.domain.generators import generate
        >>> result = octafield.compute_seamless_map(generate("box"), octafield.FieldOptions(edge_length=0.5))
        >>> result.record.stage, result.record.flipped
        ('injective', 0)
    """
    if options.axes == "free":
        raise InvalidInput(_RIGHT_ANGLES + "; take axes 'orthogonal'", "stretched_axes")
    field = source if isinstance(source, AnalysedField) else compute_field(source, options, progress)
    require_right_angles(field.stretch, _RIGHT_ANGLES)
    if field.tet_frames is not None:
        raise InvalidInput("seamless maps are made of fields at vertices; take sampling 'vertices'", "not_at_vertices")
    with naming(field.record.input):
        return _mapped(field, unit, progress)


def _mapped(field: AnalysedField, unit: float, progress: Progress | None) -> SeamlessMapResult:
    from ..progress.phases import machine, octafield_version, versions
    from ..records.hex_mesh import SeamlessMapRecord
    from ..records.parts import Machine

    meter, before = PhaseMeter(field.record, progress), field.record
    made = _core.field_map(field.tets, field.frames, edge_length=unit, progress=meter.report)
    meter.begin("check")
    announce(progress, "check")
    report = _core.seamless_report(made.map)
    meter.end()
    locked, flipped, wound = np.asarray(made.locked), np.asarray(report.flipped), np.asarray(report.wound)
    stage = "field" if len(locked) else "seamless" if len(flipped) or len(wound) else "injective"
    tets = np.asarray(made.map.mesh.tets)
    kind, places = {
        "field": ("locked_tet", tets[locked]),
        "seamless": ("flipped_tet", tets[flipped]) if len(flipped) else ("winding_edge", wound),
    }.get(stage, (None, wound))
    record = SeamlessMapRecord(
        input=before.input,
        version=octafield_version(),
        input_kind=before.input_kind,
        mesh_sha256=before.mesh_sha256,
        tets=len(made.map.mesh.tets),
        field_tets=len(field.tets.tets),
        added_vertices=made.added_vertices,
        stage=stage,
        stopped_by=kind,
        stopped_at=_middles(made.map, places),
        singular_edges=len(made.curves),
        turns=made.turns,
        unzipped=made.unzipped,
        unknowns=made.unknowns,
        locked=len(locked),
        flipped_at_first=made.flipped_at_first,
        flipped=len(flipped),
        steps=made.steps,
        residual=report.residual,
        angle_at_first_deg=float(np.degrees(made.angle_at_first)),
        angle_deg=float(np.degrees(made.angle)),
        non_meshable_vertices=before.non_meshable_vertices,
        non_meshable_junctions=before.non_meshable_junctions,
        seconds=sum(meter.wall.values()),
        wall_seconds=meter.wall,
        cpu_seconds=meter.cpu,
        phase_peak_mb=meter.peak_mb,
        peak_mb=max([before.peak_mb, *meter.peak_mb.values()]),
        notes=list(before.notes),
        versions=versions(),
        machine=Machine.model_validate(machine()),
        options={"unit": unit},
        field_options=before.options,
    )
    return SeamlessMapResult(
        map=made.map,
        parent=np.asarray(made.parent),
        curves=np.asarray(made.curves),
        locked=locked,
        flipped=flipped,
        field=field,
        record=record,
    )


def _middles(given: SeamlessMap, places: np.ndarray) -> list[list[float]]:
    """Of tets or edges, rows of vertex ids."""
    corners = np.asarray(given.mesh.vertices)[places[:100]]
    middles: list[list[float]] = corners.mean(axis=1).tolist()
    return middles


def write_seamless_result(result: SeamlessMapResult, folder: Path) -> None:
    """seamless.hexex and seamless.json."""
    from ..records.record_file import write_record

    write_seamless_map(folder / MAP_FILE, result.map)
    result.record = result.record.changed(files=[MAP_FILE, MAP_RECORD])
    write_record(folder / MAP_RECORD, result.record)
