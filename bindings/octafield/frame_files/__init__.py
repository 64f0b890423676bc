"""Files of frames: what other programs write comes in, what they read goes out.

    found = octafield.read_frames("field.frame", mesh="part.mesh")  # a FrameFile
    octafield.analyse(found.mesh, found.frames, where=found.where).record.singular_edges
    octafield.write_frames("field.ovmb", found.mesh, found.frames, found.where)

Formats and their layouts: docs/formats.md, octafield.frame_formats.
"""

import math
import numbers
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from .._core import TetDomain, TetMesh
from ..domain.inputs import Input, feature_edges, from_mesh, read_input, regions_of
from ..domain.rotations import axes_of, unit_quaternions
from ..domain.sites import SITES, moved_frames
from ..errors import InvalidInput
from ..files.reading import plain_name, reading
from .base import Field, FrameFile, FrameFormat
from .placing import place
from .registry import FORMATS, READERS, WRITERS, find_format
from .text import read_txt

if TYPE_CHECKING:
    from ..fields.analysed import AnalysedField

__all__ = ["FrameFile", "FrameFormat", "frame_formats", "read_frames", "write_frames"]

frame_formats: Mapping[str, FrameFormat] = MappingProxyType(FORMATS)


@np.errstate(all="ignore")  # what is not finite is refused by name, without NumPy's warning before
def read_frames(
    path: str | Path,
    mesh: TetMesh | TetDomain | Input | str | Path | None = None,
    format: str | None = None,
    *,
    where: str | None = None,
    stretched: bool = False,
) -> FrameFile:
    """The frames of a file, as unit quaternions, with what else it holds.

    mesh: the tet mesh they belong to, or its file; without one, the file's own. With a mesh, the number of frames tells
        whether they sit at its vertices or in its tets. format: a name of frame_formats; None: by the extension, and in
        .txt by the numbers on the first line. where: "vertices" or "tets", where the file does not tell. Axes of any
        length and handedness that are not quite at right angles are taken to the nearest frame, which the notes tell.
        stretched: take files of fields with axes "free", too, whose frames are rotations Q and whose axes are those of
        S Q, S the stretch of the result; else they are refused.
        Raises IoError naming the line or byte, and InvalidInput where axes are zero or in one plane, or the number of
        frames fits nothing.
    """
    path = Path(path)
    _require_site(where)
    reader = find_format(path, format)
    given = read_input(mesh) if isinstance(mesh, (str, Path)) else mesh
    given = from_mesh(given) if isinstance(given, TetDomain) else given
    if given is not None and not isinstance(given, (Input, TetMesh)):
        raise InvalidInput(f"a TetMesh or its file is needed, not {type(given).__name__}", "bad_type")
    if isinstance(given, Input) and given.tets is None:
        raise InvalidInput(f"{given.name}: holds triangles; frames need the tet mesh they belong to", "not_tets")
    read = read_txt if format is None and plain_name(path).endswith(".txt") else READERS[reader.name]
    with reading(path, reader.name):
        found = read(path)
    if found.stretch is not None and not stretched:
        raise InvalidInput(
            f"{path}: its axes are not at right angles, which are needed here; octafield analyse and convert take such"
            " files, and octafield.read_frames(..., stretched=True)",
            "stretched_axes",
        )
    if found.mesh is not None:  # the file is checked, and its own mesh is the one wanted unless another is given
        _core.require_valid(found.mesh)
    result = place(found, given, where)
    form = frame_formats[result.format]
    if (
        where is None
        and not form.holds_mesh
        and len(form.where) > 1
        and result.mesh is not None
        and len(result.mesh.vertices) == len(result.mesh.tets)
    ):
        result.notes.append(
            "the mesh has as many vertices as tets: the frames are taken to be"
            f" {'at the vertices' if result.where == 'vertices' else 'in the tets'}"
        )
    return result


def write_frames(
    path: str | Path,
    mesh: "TetMesh | TetDomain | AnalysedField | None",
    frames: ArrayLike,
    where: str = "vertices",
    format: str | None = None,
    *,
    at: str | None = None,
    lengths: ArrayLike | None = None,
    features: ArrayLike | None = None,
    regions: ArrayLike | None = None,
    metadata: Mapping[str, str] | None = None,
    combed: bool = False,
    cell_edge: float | str | None = None,
    stretch: ArrayLike | None = None,
) -> list[str]:
    """Writes (n, 4) frames to a file that appears only when complete, packed where the name ends with .gz.

    where: where the frames are, "vertices" or "tets". format: a name of frame_formats; None: by the extension. at:
        where they shall be in the file; None: where they are, if the format has that; else they are taken there by
        vertex_frames or tet_frames. lengths: (n, 3) of the axes.
    features: (k, 2) feature edges, vertex ids. regions: (m,) of the tets. metadata: words for .vtu. combed: the frames
        go to the tets and are combed (octafield.volume.comb): axes correspond by number and sign across all triangles
        but a cut; .npz then holds all of octafield.parameterization_input, .ovmb and .ovm the cut, .perm its matchings.
        mesh: None where the format needs none; a TetDomain, or a result of compute_field or analyse, gives its features
        and regions, too, where these are None. cell_edge: edge length of the cells that a mesher shall make, input
        unit, or "auto", the mean edge of the tets: the axes are divided by it (.fra, .bfra: densities of cells) or
        multiplied (.ff3: edges of cells), on top of their lengths. stretch: (n, 6) of axes S Q, that of the result
        where None, for .vtu and .npz alone: other formats would lose it and are refused. Returns notes on what was
        changed or left out.
        Raises InvalidInput and IoError.
    """
    if isinstance(mesh, TetDomain):
        if features is None and len(mesh.features.edges):
            features = feature_edges(mesh)
        regions = regions_of(mesh) if regions is None else regions
        mesh = mesh.mesh
    if mesh is not None and not isinstance(mesh, TetMesh):
        if not hasattr(mesh, "feature_edges"):
            raise InvalidInput(f"a TetMesh or a result that has one is needed, not {type(mesh).__name__}", "bad_type")
        stretch = mesh.stretch if stretch is None else stretch
        features, regions = (
            (mesh.feature_edges if features is None else features),
            (mesh.regions if regions is None else regions),
        )
        mesh = mesh.tets.mesh
    path = Path(path)
    _require_site(where)
    _require_site(at)
    writer = find_format(path, format, to_write=True)
    values = np.asarray(frames, float)
    if values.ndim != 2 or values.shape[1] != 4:
        raise InvalidInput(f"frames of shape {values.shape}; (n, 4) quaternions w x y z are needed", "bad_shape")
    values, _ = unit_quaternions(values, lambda i: "frames")
    field = Field(
        mesh,
        values,
        where,
        _array(lengths, 3),
        _ids(features, 2, "features"),
        _ids(regions, None, "regions"),
        dict(metadata or {}),
        stretch=_array(stretch, 6),
    )
    _require_fit(field, writer)
    if field.stretch is not None:
        _require_stretch_kept(field, writer, at, combed, cell_edge)
    if combed and at == "vertices":
        raise InvalidInput("combed frames sit in the tets; leave out at='vertices'", "unknown_option_value")
    notes = _move(field, writer, "tets" if combed else at)
    if combed:
        notes += _comb(field)
    if cell_edge is not None:
        notes += _take_cell_edge(field, writer, cell_edge)
    for name, words in (("lengths", "lengths of the axes"), ("features", "feature edges"), ("regions", "regions")):
        if getattr(field, name) is not None and not getattr(writer, f"holds_{name}"):
            notes.append(f"the {words} were left out: {writer.title} files hold none")
            setattr(field, name, None)
    if field.features is None and features is None and writer.holds_features:
        notes.append("no feature edges were given: the file marks none")
    return notes + (WRITERS[writer.name](path, field) or [])


def _require_stretch_kept(
    field: Field, writer: FrameFormat, at: str | None, combed: bool, cell_edge: float | str | None
) -> None:
    if not writer.holds_stretch:
        holding = " ".join(e for form in FORMATS.values() if form.holds_stretch for e in form.extensions)
        raise InvalidInput(
            f"{writer.title} files hold frames at right angles, and these axes are not; write one of: {holding}",
            "stretched_axes",
        )
    if field.where != "vertices" or at == "tets" or combed or cell_edge is not None or field.lengths is not None:
        raise InvalidInput(
            "axes that are not at right angles are written as they are, at the vertices: leave out tets, combing, cell"
            " edges and lengths",
            "stretched_axes",
        )


def _take_cell_edge(field: Field, writer: FrameFormat, cell_edge: float | str) -> list[str]:
    if not writer.holds_lengths:
        raise InvalidInput(
            f"{writer.title} files hold no lengths of axes, so no size of cells; leave out the cell edge",
            "option_not_used",
        )
    edge = cell_edge
    if edge == "auto":
        if field.mesh is None:
            raise InvalidInput("the mean edge is that of the mesh; give it, or a length", "no_mesh")
        edge = mean_edge(field.mesh)
    if isinstance(edge, bool) or not isinstance(edge, numbers.Real) or not (math.isfinite(edge) and edge > 0):
        raise InvalidInput(
            f"the cell edge must be a positive length or 'auto', not {cell_edge!r}", "option_out_of_range"
        )
    lengths = np.ones((len(field.frames), 3)) if field.lengths is None else np.asarray(field.lengths, float)
    field.lengths = lengths * edge if writer.holds_edges else lengths / edge
    return [
        f"the axes are {'edges' if writer.holds_edges else 'densities'} of cells with edges of {float(edge):.6g}"
        + (", the mean edge of the tets" if cell_edge == "auto" else "")
    ]


def mean_edge(mesh: TetMesh) -> float:
    """Length of the edges of the tets, each counted once."""
    tets, points = np.asarray(mesh.tets), np.asarray(mesh.vertices)
    edges = np.unique(np.sort(tets[:, [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]].reshape(-1, 2), axis=1), axis=0)
    return float(np.linalg.norm(points[edges[:, 1]] - points[edges[:, 0]], axis=1).mean())


def _comb(field: Field) -> list[str]:
    from ..domain.parameterization import parameterization_input, with_parts

    if field.mesh is None:
        raise InvalidInput("frames are combed with their mesh; give it", "no_mesh")
    meshed = with_parts(field.mesh, field.features, field.regions)
    field.combed = parameterization_input(meshed, field.frames, "tets")
    field.frames, _ = unit_quaternions(np.asarray(field.combed.combed.frames), lambda i: "frames")
    if field.lengths is not None:  # axis j of q o is axis i of q, turned round or not, where o has its entry (i, j)
        entries = np.abs(axes_of(np.asarray(_core.octahedral_group()))).argmax(axis=1)
        field.lengths = np.take_along_axis(field.lengths, entries[np.asarray(field.combed.combed.element)], axis=1)
    found = (
        ""
        if field.features is not None
        else f"; no feature edges were given: {len(field.combed.tets.features.edges)} were found by angle"
    )
    return [f"the frames were combed, {int(np.asarray(field.combed.combed.cut).sum())} triangles are cut{found}"]


def _require_site(where: str | None) -> None:
    if where is not None and where not in SITES:
        raise InvalidInput(f"where must be one of: {', '.join(SITES)}; not {where!r}", "unknown_option_value")


def _array(values: ArrayLike | None, width: int | None) -> np.ndarray | None:
    if values is None:
        return None
    result = np.asarray(values)
    if result.ndim != (1 if width is None else 2) or (width and result.shape[1] != width):
        raise InvalidInput(
            (
                f"an array of shape {result.shape}; (n, {width}) is needed"
                if width
                else f"(m,) ids are needed, not {result.shape}"
            ),
            "bad_shape",
        )
    return result


def _ids(values: ArrayLike | None, width: int | None, name: str) -> np.ndarray | None:
    result = _array(values, width)
    if result is None or not result.size:
        return result
    if result.dtype.kind not in "iub" or int(result.max()) >= 2**31 or int(result.min()) < -(2**31):
        raise InvalidInput(f"{name} are whole numbers of 32 bits, not {result.dtype} up to {result.max()}", "bad_ids")
    return result


def _require_fit(field: Field, writer: FrameFormat) -> None:
    if field.mesh is None:
        if writer.needs_mesh:
            raise InvalidInput(f"{writer.title} files need the mesh of the frames; give it", "no_mesh")
        return
    count = len(field.mesh.vertices if field.where == "vertices" else field.mesh.tets)
    if len(field.frames) != count:
        raise InvalidInput(f"{len(field.frames)} frames; the mesh has {count} {field.where}", "bad_count")
    for name, wanted in (("lengths", count), ("stretch", count), ("regions", len(field.mesh.tets))):
        part = getattr(field, name)
        if part is not None and len(part) != wanted:
            raise InvalidInput(f"{len(part)} rows of {name}; {wanted} are needed", "bad_count")
    if field.features is not None and field.features.size:
        outside = ((field.features < 0) | (field.features >= len(field.mesh.vertices))).any(axis=1)
        if outside.any():
            bad = int(np.argmax(outside))
            raise InvalidInput(
                f"feature edge {bad} (from 0) names a vertex outside 0 .. {len(field.mesh.vertices) - 1}",
                "index_out_of_range",
                [bad],
            )


def _move(field: Field, writer: FrameFormat, at: str | None) -> list[str]:
    """Takes the frames to where the file shall have them."""
    target = at or (field.where if field.where in writer.where else writer.where[0])
    if target not in writer.where:
        raise InvalidInput(f"{writer.title} files hold frames at {writer.where[0]} only", "unknown_option_value")
    if target == field.where:
        return []
    if field.mesh is None:
        raise InvalidInput(f"frames at {field.where} are taken to {target} with the mesh; give it", "no_mesh")
    field.frames, note = moved_frames(field.mesh, field.frames, target)
    field.where, notes = target, [note]
    if field.lengths is not None:
        field.lengths = None
        notes.append("the lengths of the axes were left out: they stay where they were")
    return notes
