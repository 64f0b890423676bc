"""What files of frames hold, what a format is, and frames from the tables that most formats are made of."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import TetMesh
from ..domain.rotations import Place, frames_of_axes, unit_quaternions
from ..domain.sites import moved_frames
from ..errors import InvalidInput
from ..files.reading import plain_name

if TYPE_CHECKING:
    from ..domain.parameterization import ParameterizationInput

_WORTH_A_NOTE = 1e-6  # radians, or relative length: what six digits leave


@dataclass
class FrameFile:
    """What a file of frames held.

    frames: (n, 4) unit quaternions w x y z. where: "vertices" or "tets". mesh: the tet mesh, where the file has one or
    one was given. lengths: (n, 3) of the axes, None where all are 1. deviation: radians, largest angle between an axis
    in the file and the frame's. left_handed: how many triads were; their third axis was turned round. features: (k, 2)
    feature edges, vertex ids of mesh. regions: (m,) of the tets. centres: (n, 3) where each frame belongs, if the file
    tells that and not the order. notes: what was changed in reading, one sentence each. stretch: (n, 6) of axes S Q
    that are not at right angles, frames being the rotations Q then (octafield.volume.stretched_axes); else None.
    """

    path: str
    format: str
    frames: np.ndarray
    where: str
    mesh: TetMesh | None = None
    lengths: np.ndarray | None = None
    deviation: float = 0.0
    left_handed: int = 0
    features: np.ndarray | None = None
    regions: np.ndarray | None = None
    centres: np.ndarray | None = None
    notes: list[str] = field(default_factory=list)
    stretch: np.ndarray | None = None

    def __repr__(self) -> str:
        mesh = "no mesh" if self.mesh is None else f"{len(self.mesh.tets):,} tets"
        notes = f"; {len(self.notes)} notes" if self.notes else ""
        return (
            f"FrameFile({self.path}: {self.format}, {len(self.frames):,} frames"
            f" {'at' if self.where == 'vertices' else 'in'} {self.where}, {mesh}{notes})"
        )


@dataclass
class Field:
    """A field to be written: see write_frames for the parts. combed: of frames in the tets that are combed. stretch:
    for formats that hold one."""

    mesh: TetMesh | None
    frames: np.ndarray
    where: str
    lengths: np.ndarray | None = None
    features: np.ndarray | None = None
    regions: np.ndarray | None = None
    metadata: dict[str, str] = field(default_factory=dict)
    combed: "ParameterizationInput | None" = None
    stretch: np.ndarray | None = None

    def sites(self) -> np.ndarray:
        """(n, 3): where each frame is, a vertex or the centroid of a tet."""
        mesh = mesh_of(self)
        points = np.array(mesh.vertices)
        centroids: np.ndarray = points[np.asarray(mesh.tets)].mean(axis=1)
        return points if self.where == "vertices" else centroids

    def matchings(self) -> _core.FaceMatchings:
        """Of frames in the tets, across all triangles between two of them."""
        return _core.face_matchings(mesh_of(self), self.frames) if self.combed is None else self.combed.combed.faces


def mesh_of(field: Field | FrameFile) -> TetMesh:
    """Raises InvalidInput where there is none."""
    if field.mesh is None:
        raise InvalidInput("the frames need their mesh; give it", "no_mesh")
    return field.mesh


def frames_at(found: FrameFile, where: str) -> np.ndarray:
    """The frames of a file with a mesh, taken to the vertices or the tets if they are not there; a note tells."""
    if found.where == where:
        return found.frames
    frames, note = moved_frames(mesh_of(found), found.frames, where)
    found.notes.append(note)
    return frames


@dataclass(frozen=True)
class FrameFormat:
    """A kind of file with frames.

    where: the sites it can hold, the usual one first. read, write: None where that is not done; write may return notes.
        holds_mesh: the file has the tets, too. needs_mesh: writing takes one. holds: what is written per frame, with
        its order. precision: of what is written.
    exact: quaternions come back bit by bit. holds_lengths: of axes; as its readers take them, gradients of a map or,
        with holds_edges, edges of cells. holds_stretch: of axes that are not at right angles. source: where the layout
        was read.
    """

    name: str
    extensions: tuple[str, ...]
    title: str
    where: tuple[str, ...]
    holds: str
    precision: str
    source: str
    read: Callable[[Path], FrameFile] | None = None
    write: Callable[[Path, Field], list[str] | None] | None = None
    holds_mesh: bool = False
    needs_mesh: bool = False
    exact: bool = False
    holds_lengths: bool = False
    holds_edges: bool = False
    holds_stretch: bool = False
    holds_features: bool = False
    holds_regions: bool = False

    def __repr__(self) -> str:
        done = " and ".join(word for word, how in (("read", self.read), ("written", self.write)) if how is not None)
        return f"FrameFormat({self.name}: {self.title}, {self.holds}; {' or '.join(self.where)}; {done})"

    def owns(self, path: str | Path) -> bool:
        return plain_name(path).endswith(self.extensions)


def from_axes(path: Path, name: str, where: str, axes: np.ndarray, lines: np.ndarray | None = None) -> FrameFile:
    """axes: (n, 3, 3), in the columns. lines: of the file, one per frame."""
    found = frames_of_axes(axes, _place_of(path, lines))
    result = FrameFile(str(path), name, found.frames, where, deviation=found.deviation, left_handed=found.left_handed)
    if len(found.lengths) and np.abs(found.lengths - 1).max() > _WORTH_A_NOTE:
        result.lengths = found.lengths
        low, high = found.lengths.min(), found.lengths.max()
        result.notes.append(
            f"the axes have lengths {low:.6g} to {high:.6g}; frames have directions only, kept apart as lengths"
        )
    if found.left_handed:
        result.notes.append(
            f"{found.left_handed} left-handed frames: their third axis was turned round, which is the same frame"
        )
    if found.deviation > _WORTH_A_NOTE:
        result.notes.append(
            f"axes not at right angles were replaced by the nearest frame's: {np.degrees(found.deviation):.3g} degrees"
            " at most"
        )
    return result


def from_quaternions(
    path: Path, name: str, where: str, values: np.ndarray, lines: np.ndarray | None = None
) -> FrameFile:
    """values: (n, 4), w x y z."""
    frames, change = unit_quaternions(values, _place_of(path, lines))
    result = FrameFile(str(path), name, frames, where)
    if change > _WORTH_A_NOTE:
        result.notes.append(f"quaternions were scaled to length 1: they were off by up to {change:.3g}")
    return result


def stretched(result: FrameFile, stretch: np.ndarray) -> FrameFile:
    """With axes S Q, Q the rotation of the frames. Raises InvalidInput where S is no stretch."""
    values = np.asarray(stretch, float)
    try:
        _core.stretched_axes(result.frames, values)
    except InvalidInput as error:
        raise InvalidInput(f"{result.path}: {error}", error.kind, error.elements) from error
    result.stretch = values
    return result


def from_sh4(path: Path, name: str, where: str, values: np.ndarray) -> FrameFile:
    """values: (n, 9), order m = -4..4."""
    values = np.asarray(values, float)
    length = np.linalg.norm(values, axis=1)
    unit_quaternions(np.column_stack([length] * 4), _place_of(path, None))  # not zero, finite
    frames, distances = _core.sh4_project(values / length[:, None])
    result = FrameFile(str(path), name, np.asarray(frames), where)
    if len(frames) and distances.max() > _WORTH_A_NOTE:
        result.notes.append(
            f"sh4 vectors were replaced by the nearest frames: {distances.max():.3g} away at most, length 1"
        )
    return result


def _place_of(path: Path, lines: np.ndarray | None) -> Place:
    return lambda i: str(path) if lines is None else f"{path}, line {lines[i]}"
