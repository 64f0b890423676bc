"""Frames and features as AlgoHex names them, in OpenVolumeMesh files."""

from pathlib import Path

import numpy as np

from .. import _core
from ..domain.inputs import input_of_grid, naming
from ..domain.rotations import axes_of
from ..errors import InvalidInput
from ..meshes.grids import grid_of_ovm
from ..meshes.openvolumemesh.features import add_features
from ..meshes.openvolumemesh.mesh import OvmMesh, ovm_of_tets
from ..meshes.openvolumemesh.text import read_ovm, write_ovm
from .algohex_transitions import CUT, TRANSITIONS, VALENCES, far_transitions, inner_faces, transitions_of, valences_of
from .base import Field, FrameFile, from_axes, from_quaternions, from_sh4, mesh_of
from .vtk import AXES, with_mesh

_BINARY_NAME = {"tets": "FrameFieldQuaternions", "vertices": "vertex quaternion"}  # type Quaternion: x y z w
_COEFFICIENTS = "scaled vertex spherical harmonic coefficients"
_ENTITY = {"tets": "cell", "vertices": "vertex"}


def read_text(path: Path) -> FrameFile:
    return _read(path, "ovm")


def read_binary(path: Path) -> FrameFile:
    return _read(path, "ovmb")


def _read(path: Path, name: str) -> FrameFile:
    """Of the cells, or of the vertices where the cells have none."""
    mesh = read_ovm(path, binary=name == "ovmb")
    result = _frames_in(path, name, mesh)
    if result is None:
        known = ", ".join(sorted(f"{entity} {key}" for entity, key in mesh.properties)) or "none"
        raise InvalidInput(f"{path}: holds no frames that are known (properties: {known})", "no_frames")
    with naming(str(path)):
        found = input_of_grid(str(path), grid_of_ovm(mesh, path))
    if result.where == "vertices":
        for part in ("frames", "lengths"):
            if getattr(result, part) is not None:
                setattr(result, part, getattr(result, part)[found.file_points])
    if result.where == "tets":
        result.notes += far_transitions(mesh, result.frames)
        for part in ("frames", "lengths"):
            if getattr(result, part) is not None:
                setattr(result, part, getattr(result, part)[found.file_tets])
    if mesh.skipped:
        result.notes.append(f"properties of other types were left out: {', '.join(mesh.skipped[:5])}")
    return with_mesh(result, found)


def _frames_in(path: Path, name: str, mesh: OvmMesh) -> FrameFile | None:
    for where, entity in _ENTITY.items():
        found = {key: values for (of, key), values in mesh.properties.items() if of == entity and values.ndim == 2}
        key = _BINARY_NAME[where]
        if mesh.kinds.get((entity, key)) == "Quaternion":
            return from_quaternions(path, name, where, found[key][:, [3, 0, 1, 2]])
        for either in ("quaternion", key):
            if either in found and found[either].shape[1] == 4:
                return from_quaternions(path, name, where, found[either])
        if all(key in found and found[key].shape[1] == 3 for key in AXES):
            return from_axes(path, name, where, np.stack([found[key] for key in AXES], axis=2))
        if _COEFFICIENTS in found and found[_COEFFICIENTS].shape[1] == 9:
            return from_sh4(path, name, where, found[_COEFFICIENTS])
    return None


def write_text(path: Path, field: Field) -> None:
    _write(path, field, binary=False)


def write_binary(path: Path, field: Field) -> None:
    _write(path, field, binary=True)


def _write(path: Path, field: Field, *, binary: bool) -> None:
    mesh = ovm_of_tets(mesh_of(field).vertices, mesh_of(field).tets)
    tets = np.asarray(mesh_of(field).tets)
    add_features(mesh, tets, field.features, field.regions, with_frames=len(field.frames) > 0)
    entity = _ENTITY[field.where]
    if binary:
        key = entity, _BINARY_NAME[field.where]
        mesh.properties[key] = field.frames[:, [1, 2, 3, 0]]
        mesh.kinds[key] = "Quaternion"
    else:
        mesh.properties[entity, "quaternion"] = field.frames
        axes = axes_of(field.frames)
        for k, name in enumerate(AXES):
            mesh.properties[entity, name] = np.ascontiguousarray(axes[:, :, k])
    if field.where == "tets":
        _add_transitions(mesh, field)
    write_ovm(path, mesh, binary=binary)


def _add_transitions(mesh: OvmMesh, field: Field) -> None:
    """What AlgoHex's refined meshes hold beside the frames."""
    if field.combed is None:
        edges = _core.singular_edges(mesh_of(field), field.frames).edges
    else:
        edges, parts = field.combed.singular.edges, field.combed.arrays()
        mesh.properties[CUT] = np.zeros(len(mesh.faces), np.int32)
        mesh.properties[CUT][inner_faces(mesh)] = parts["cut"]
    mesh.properties[TRANSITIONS] = transitions_of(mesh, field.matchings())
    mesh.properties[VALENCES] = valences_of(mesh, field, mesh.properties[TRANSITIONS], edges)
