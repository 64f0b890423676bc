"""Files of frames as the input of commands."""

import math
from pathlib import Path

from ..domain.meshing import prepare_mesh
from ..errors import InvalidInput
from ..fields.analysed import AnalysedField, analyse
from ..fields.frame_field import FieldResult, compute_field
from ..frame_files import read_frames
from ..frame_files.base import frames_at
from ..meshes.registry import is_written
from ..options import FieldOptions
from ..progress.phases import Progress


def analyse_file(
    field: Path, mesh: Path | None, format: str | None, options: FieldOptions, progress: Progress | None = None
) -> AnalysedField:
    """The analysis of the frames in a file, on the mesh given or the file's own."""
    source = mesh if mesh is not None else field if is_written(field) and format is None else None
    found = read_frames(field, mesh, format, stretched=True)
    if found.mesh is None:
        raise InvalidInput(f"{field}: holds frames and no mesh; give it with --mesh", "no_mesh")
    meshed = prepare_mesh(found.mesh if source is None else source, options, progress=progress)
    result = analyse(meshed, found.frames, found.where, options, progress, stretch=found.stretch)
    result.lengths = found.lengths
    result.record = result.record.changed(
        field=str(field),
        field_format=found.format,
        deviation_deg=math.degrees(found.deviation),
        notes=list(dict.fromkeys([*result.record.notes, *found.notes])),
    )
    return result


def polish_file(source: str, start: Path, options: FieldOptions, progress: Progress | None = None) -> FieldResult:
    """A field on a tet mesh, smoothed from the frames of a file, which are taken to where the field has its own."""
    if options.split:
        raise InvalidInput(
            "splitting makes another mesh than the start belongs to; leave it out", "option_out_of_range"
        )
    found = read_frames(start, source)
    frames = frames_at(found, options.sampling)
    result = compute_field(prepare_mesh(source, options, progress=progress), options, progress, start=frames)
    notes = list(dict.fromkeys([*result.record.notes, *found.notes]))
    result.record = result.record.changed(start=str(start), notes=notes)
    return result
