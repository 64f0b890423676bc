"""Frames in the arrays of mesh files: VTU, legacy VTK and Gmsh's views; and VTP for pictures."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import TetDomain
from ..domain.inputs import Input, input_of_grid, naming
from ..domain.rotations import axes_of
from ..errors import InvalidInput
from ..files.reading import write_whole
from ..files.scratch import through_file
from ..files.writing import vtp_bytes
from ..meshes.grids import grid_of_cells, read_cells
from .base import Field, FrameFile, from_axes, from_quaternions, from_sh4, mesh_of, stretched

if TYPE_CHECKING:
    import meshio

QUATERNIONS = ("quaternion", "frame_quaternion")  # w x y z
AXES = ("frame_u", "frame_v", "frame_w")
CONVENTION = (
    "frame axes are the columns of R(quaternion), quaternion w x y z, sh4 order m = -4..4; axes are named per vertex:"
    " interpolate sh4, or axes only in cells with axes_agree 1"
)

STRETCHED_CONVENTION = (
    "axes are not at right angles: frame_u, frame_v, frame_w are unit vectors along the columns of S R(rotation),"
    " frame_lengths their lengths, rotation w x y z, S symmetric with elements stretch xx yy zz yz xz xy; axes are"
    " named per vertex"
)


def read_arrays(path: Path, name: str) -> FrameFile:
    """The frames of a mesh file's cell data, or of its point data where the cells have none."""
    found = read_cells(path, name)
    blocks = [block.type for block in found.cells]
    if "tetra" not in blocks:
        raise InvalidInput(f"{path}: holds no tetrahedra", "not_tets")
    with naming(str(path)):
        read = input_of_grid(str(path), grid_of_cells(found))
    of_tets = {
        key: np.concatenate([np.asarray(v) for kind, v in zip(blocks, values, strict=True) if kind == "tetra"])
        for key, values in found.cell_data.items()
    }
    of_tets = {key: values[read.file_tets] for key, values in of_tets.items()}
    of_points = {key: np.asarray(values)[read.file_points] for key, values in found.point_data.items()}
    for where, data in (("tets", of_tets), ("vertices", of_points)):
        result = _frames_in(path, name, where, data)
        if result is not None:
            break
    else:
        raise InvalidInput(
            f"{path}: holds no frames: no array {' or '.join(QUATERNIONS)} (4), {', '.join(AXES)} (3 each), frame (9)"
            " or sh4 (9)",
            "no_frames",
        )
    if where == "tets" and _frames_in(path, name, "vertices", of_points) is not None:
        result.notes.append("frames of the tets were taken; the file has frames at the vertices, too")
    return with_mesh(result, read)


def with_mesh(result: FrameFile, read: Input) -> FrameFile:
    """Adds what was read beside the frames."""
    result.mesh, result.regions = read.volume().mesh, read.regions
    features = read.features_of_tets()
    if features is not None:
        result.features = features
    result.notes += read.notes
    return result


def _frames_in(path: Path, name: str, where: str, data: dict[str, np.ndarray]) -> FrameFile | None:
    if where == "vertices" and _has(data, "stretch", 6) and _has(data, "rotation", 4):
        return stretched(from_quaternions(path, name, where, data["rotation"]), data["stretch"])
    for key in QUATERNIONS:
        if _has(data, key, 4):
            result = from_quaternions(path, name, where, data[key])
            if _has(data, "frame_lengths", 3):
                result.lengths = np.asarray(data["frame_lengths"], float)
            return result
    if all(_has(data, key, 3) for key in AXES):
        return from_axes(path, name, where, np.stack([np.asarray(data[key], float) for key in AXES], axis=2))
    for key in ("frame", "frames"):
        if _has(data, key, 9):
            return from_axes(path, name, where, np.swapaxes(np.asarray(data[key], float).reshape(-1, 3, 3), 1, 2))
    return from_sh4(path, name, where, data["sh4"]) if _has(data, "sh4", 9) else None


def _has(data: dict[str, np.ndarray], key: str, width: int) -> bool:
    return key in data and np.ndim(data[key]) == 2 and data[key].shape[1] == width


def read_vtu(path: Path) -> FrameFile:
    return read_arrays(path, "vtu")


def read_vtk(path: Path) -> FrameFile:
    return read_arrays(path, "vtk")


def read_msh(path: Path) -> FrameFile:
    return read_arrays(path, "msh")


def write_vtu(path: Path, field: Field) -> None:
    """As `octafield field` writes it; frames in tets are taken to the vertices as well."""
    of_tets, mesh = field.where == "tets", mesh_of(field)
    frames = _core.vertex_frames(mesh, field.frames) if of_tets else field.frames
    lengths, features = (() if part is None else part for part in (field.lengths, field.features))
    domain = TetDomain(mesh, regions=() if field.regions is None else field.regions)
    metadata = {"convention": CONVENTION if field.stretch is None else STRETCHED_CONVENTION} | field.metadata

    def write(plain: Path) -> None:
        if of_tets:
            _core.write_field(
                plain, domain, frames, metadata, tet_frames=field.frames, tet_lengths=lengths, features=features
            )
        else:
            _core.write_field(
                plain, domain, frames, metadata, lengths=lengths, features=features, stretch=field.stretch
            )

    through_file(path, ".vtu", write)


def write_vtp(path: Path, field: Field) -> None:
    """A point per frame: at the vertices, or at the centroids of the tets."""
    import pyvista

    points = pyvista.PolyData(field.sites())
    axes = axes_of(field.frames)
    for k, name in enumerate(AXES):
        points.point_data[name] = np.ascontiguousarray(axes[:, :, k])
    points.point_data["quaternion"] = np.array(field.frames)
    points.add_field_data([CONVENTION], "convention")
    write_whole(path, [vtp_bytes(points)])


def write_msh(path: Path, field: Field) -> list[str]:
    """Version 2.2, binary, with vector views frame_u, frame_v, frame_w and the tensor view frame (axes one after the
    other)."""
    import meshio

    from ..meshes.parts import Parts
    from ..meshes.writers import msh_of

    axes = np.swapaxes(axes_of(field.frames), 1, 2)
    data = {name: np.ascontiguousarray(axes[:, k]) for k, name in enumerate(AXES)}
    data["frame"] = axes.reshape(-1, 9)
    tets = mesh_of(field)
    parts = Parts(np.asarray(tets.vertices), field.features, tets=np.asarray(tets.tets), regions=field.regions)
    mesh, notes = msh_of(parts)
    if field.where == "vertices":
        mesh.point_data = data
    else:
        mesh.cell_data |= {name: _for_blocks(values, mesh) for name, values in data.items()}
    through_file(path, ".msh", lambda plain: meshio.gmsh.write(str(plain), mesh, "2.2", binary=True))
    return notes


def _for_blocks(values: np.ndarray, mesh: "meshio.Mesh") -> list[np.ndarray]:
    """Zeros for the cells that are no tets."""
    return [values if block.type == "tetra" else np.zeros((len(block.data), values.shape[1])) for block in mesh.cells]


def write_pos(path: Path, field: Field) -> None:
    """Gmsh's parsed views: one of vectors at points per axis."""
    points, axes = field.sites(), axes_of(field.frames)
    write_whole(path, _pos_pieces(points, axes))


def _pos_pieces(points: np.ndarray, axes: np.ndarray) -> Iterator[bytes]:
    for k, name in enumerate(AXES):
        yield f'View "{name}" {{\n'.encode()
        for start in range(0, len(points), 1 << 16):
            part = slice(start, start + (1 << 16))
            rows = zip(points[part].tolist(), axes[part, :, k].tolist(), strict=True)
            yield "".join("VP(%r,%r,%r){%r,%r,%r};\n" % (*at, *axis) for at, axis in rows).encode()
        yield b"};\n"
