"""From one kind of file to another: meshes, and fields with their meshes."""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from .. import _core
from .._core import AxisScales, TetDomain, TetMesh
from ..domain.inputs import Input, domain_of, from_mesh, naming, read_input
from ..domain.mesh_writers import write_mesh
from ..domain.meshing import REPAIR_IGNORED
from ..domain.repairing import level_of, repair_surface
from ..domain.sites import moved_frames, require_right_angles
from ..errors import InvalidInput, IoError
from ..fields.sizes import Sizes, find_sizes, log_scales_of
from ..files.reading import plain_name
from ..frame_files import FrameFile, read_frames, write_frames
from ..frame_files.base import FrameFormat, frames_at, mesh_of
from ..frame_files.registry import FORMATS, READERS, WRITERS, find_format
from ..meshes.registry import find_mesh_format, is_written, written_suffixes
from ..options import SIZES, MeshOptions, require_one_of


@dataclass
class Conversion:
    """kind: "surface", "tets" or "field", of what was written. where: of the frames in the file written. notes: what
    was changed or left out.
    sizes: curl and jump before and after, where sizes were written."""

    input: str
    output: str
    kind: str
    vertices: int
    cells: int
    frames: int = 0
    where: str | None = None
    deviation_deg: float = 0.0
    notes: list[str] = field(default_factory=list, repr=False)
    sizes: dict[str, Any] = field(default_factory=dict, repr=False)


def convert_file(
    source: str | Path,
    target: str | Path,
    *,
    mesh: str | Path | None = None,
    from_format: str | None = None,
    to_format: str | None = None,
    at: str | None = None,
    combed: bool = False,
    edge_length: float = 0.0,
    sizes: str = "none",
    cell_edge: float | str | None = None,
    split_singular: bool = False,
    repair: MeshOptions = MeshOptions(repair="none"),
) -> Conversion:
    """Reads a mesh or a field, writes the other file. mesh: of the frames, where their file has none. from_format,
    to_format: names of octafield.frame_formats, where the extensions do not tell. at: "vertices" or "tets", where the
    frames shall be. combed: as of write_frames. edge_length: of triangles on CAD models. sizes: "isotropic" or "axes"
    (see octafield.FieldOptions): lengths of the axes, where the file can hold them. cell_edge: as of write_frames.
    split_singular: edges inside between singular vertices are split first (octafield.volume.split_between_singular),
    and the frames are those of the tets. repair: its level and bounds are for a surface, as octafield.prepare_mesh
    takes them for one that is to be closed; what the level leaves unsound is noted."""
    require_one_of("sizes", sizes, SIZES)
    source, target = Path(source), Path(target)
    frames = _frames(source, mesh, from_format)
    if to_format is None and not _writes_frames(target) and not is_written(target):
        kinds = " ".join(sorted({*written_suffixes(), *(e for name in WRITERS for e in FORMATS[name].extensions)}))
        raise IoError(f"{target}: unknown kind of file; known are {kinds}, also .gz")
    if frames is not None and (to_format is not None or _writes_frames(target)):
        if repair.repair != "none":
            raise InvalidInput(
                f"{source}: holds frames on a tet mesh; repair works on surfaces only, leave it out", "option_not_used"
            )
        if split_singular or sizes != "none":
            require_right_angles(frames.stretch, f"{source}: splitting and sizes need axes at right angles")
        if split_singular:
            frames = _split(frames, find_format(target, to_format, to_write=True), at)
        curls: dict[str, Any] = {}
        if sizes != "none":
            frames, curls = with_sizes(
                frames, find_format(target, to_format, to_write=True), "tets" if combed else at, sizes
            )
        notes = write_frames(
            target, frames.mesh, frames.frames, frames.where, to_format, at=at, lengths=frames.lengths,
            features=frames.features, regions=frames.regions,
            combed=combed, cell_edge=cell_edge, stretch=frames.stretch,
        )  # fmt: skip
        written = "tets" if combed else at or _site_in_file(target, to_format, frames.where)
        count, cells = (0, 0) if frames.mesh is None else (len(frames.mesh.vertices), len(frames.mesh.tets))
        number = len(frames.frames) if written == frames.where else {"vertices": count, "tets": cells}[written]
        return Conversion(
            str(source),
            str(target),
            "field",
            count,
            cells,
            number,
            written,
            _degrees(frames.deviation),
            frames.notes + notes,
            sizes=curls,
        )
    if (
        not is_written(target)
        or to_format is not None
        or (frames is None and at is not None)
        or combed
        or sizes != "none"
        or cell_edge is not None
        or split_singular
    ):
        raise InvalidInput(
            f"{source}: holds no frames to write" if frames is None else f"{target}: cannot hold frames", "no_frames"
        )
    return _convert_mesh(source, target, frames, mesh, edge_length, repair)


def _split(found: FrameFile, writer: FrameFormat, at: str | None) -> FrameFile:
    if not writer.holds_mesh:
        raise InvalidInput(
            f"splitting makes another mesh, and {writer.title} files hold none; write .vtu or .ovmb first and convert"
            " that",
            "option_not_used",
        )
    if at == "vertices":
        raise InvalidInput(
            "singular edges are split by frames in the tets; leave out 'vertices'", "unknown_option_value"
        )
    mesh, frames, notes = mesh_of(found), frames_at(found, "tets"), list(found.notes)
    split = _core.split_between_singular(domain_of(mesh, found.regions), frames)
    parent = np.asarray(split.parent)
    notes.append(
        f"{len(split.edges) - len(split.left)} edges inside between singular vertices were split:"
        f" {split.added_vertices} vertices and {len(parent) - len(mesh.tets)} tets more"
        + (f"; {len(split.left)} are left, in tets too flat to split" if len(split.left) else "")
    )
    lengths = found.lengths if found.where == "tets" else None
    return replace(
        found, mesh=split.mesh, frames=frames[parent], where="tets", notes=notes, centres=None,
        lengths=None if lengths is None else lengths[parent],
        regions=None if found.regions is None else np.asarray(found.regions)[parent],
    )  # fmt: skip


def _convert_mesh(
    source: Path,
    target: Path,
    frames: FrameFile | None,
    mesh: str | Path | None,
    edge_length: float,
    repair: MeshOptions,
) -> Conversion:
    found = _mesh_of(source, frames, mesh, edge_length)
    with naming(found.name):
        if repair.repair != "none":
            _repair(found, repair)
        notes = [*found.notes, *write_mesh(target, found)]
    if found.lines is not None and not found.lines_are_features():
        notes.append("the file's lines list mesh edges in general: they were left out")
    if frames is not None:
        notes.append(f"the frames were left out: {Path(plain_name(target)).suffix} files hold a mesh alone")
    if found.tets is None or "tets" not in find_mesh_format(target).holds:
        return Conversion(
            str(source), str(target), "surface", len(found.surface.vertices), len(found.surface.triangles), notes=notes
        )
    return Conversion(str(source), str(target), "tets", len(found.tets.vertices), len(found.tets.tets), notes=notes)


def _repair(found: Input, options: MeshOptions) -> None:
    if found.tets is not None:
        found.notes.append(REPAIR_IGNORED)
        return
    repair_surface(found, options)
    left = _core.find_defects(found.surface)
    if left:
        found.notes.append(
            f"after --repair {level_of(found, options)}: {left[0].message}"
            + (f"; {len(left) - 1} more" if len(left) > 1 else "")
        )


def _mesh_of(source: Path, frames: FrameFile | None, mesh: str | Path | None, edge_length: float) -> Input:
    if frames is None:
        return read_input(source, edge_length=edge_length)
    if mesh is not None:
        return read_input(mesh)
    if is_written(source):
        return read_input(source)
    if frames.mesh is None:
        raise InvalidInput(f"{source}: holds frames and no mesh; give it with --mesh", "no_mesh")
    return from_mesh(frames.mesh)


def _frames(source: Path, mesh: str | Path | None, name: str | None) -> FrameFile | None:
    """None where the file is one of a mesh alone."""
    if name is None and not any(FORMATS[known].owns(source) for known in READERS):
        return None
    if name is not None or not find_format(source, None).holds_mesh or not is_written(source):
        return read_frames(source, mesh, name, stretched=True)
    try:
        return read_frames(source, mesh, stretched=True)
    except InvalidInput as error:
        if error.kind in ("no_frames", "not_tets"):
            return None
        raise


def _writes_frames(path: Path) -> bool:
    return any(FORMATS[name].owns(path) for name in WRITERS)


def _site_in_file(target: Path, name: str | None, where: str) -> str:
    known = find_format(target, name, to_write=True).where
    return where if where in known else known[0]


def _degrees(radians: float) -> float:
    return radians * 57.29577951308232


def with_sizes(found: FrameFile, writer: FrameFormat, at: str | None, kind: str) -> tuple[FrameFile, dict[str, Any]]:
    """The frames where the file to write has them, with sizes as the lengths of their axes: densities exp(H), or
    exp(-H) where the format holds edges of cells (FrameFormat.holds_edges). And the record of them."""
    from ..fields import record

    if found.mesh is None:
        raise InvalidInput("sizes are found on the mesh of the frames; give it with --mesh", "no_mesh")
    if not writer.holds_lengths:
        return replace(
            found, notes=[*found.notes, f"sizes were left out: {writer.title} files hold no lengths of axes"]
        ), {}
    where = at or (found.where if found.where in writer.where else writer.where[0])
    if kind == "axes" and where == "vertices":
        raise InvalidInput(
            "sizes per axis are those of frames in the tets; add --at tets, or take --sizes isotropic", "wrong_sampling"
        )
    notes = list(found.notes)
    at_vertices = (
        found.frames if found.where == "vertices" else np.asarray(_core.vertex_frames(found.mesh, found.frames))
    )
    frames = found.frames
    if where != found.where:
        frames, note = moved_frames(found.mesh, found.frames, where)
        notes.append(note)
    sizes = find_sizes(found.mesh, at_vertices, kind)
    lengths = np.exp((-1 if writer.holds_edges else 1) * _logs_at(sizes, found.mesh, frames, where))
    if found.lengths is not None:
        notes.append("the lengths of the axes in the file were replaced by sizes")
    return replace(found, frames=frames, where=where, lengths=lengths, notes=notes), record.of_sizes(sizes).to_dict()


def _logs_at(sizes: Sizes, tets: TetMesh | TetDomain, frames: np.ndarray, where: str) -> np.ndarray:
    if isinstance(sizes, AxisScales):
        return log_scales_of(sizes, frames)
    values = np.asarray(sizes.log_scale)
    return np.repeat(
        (values if where == "vertices" else values[np.asarray(tets.tets)].mean(axis=1))[:, None], 3, axis=1
    )
