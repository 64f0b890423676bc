"""A frame field at points of one's own choice: anywhere, and on a plane.

>>> import octafield
>>> from octafield.domain.generators import generate
>>> result = octafield.compute_field(generate("box"), octafield.FieldOptions(edge_length=0.3))
>>> octafield.sample_frames(result, [[0.2, 0.3, 0.4], [5, 5, 5]])
SampledFrames(2 frames, 1 outside)
>>> cut = octafield.slice_frames(result, normal=(1, 0, 0))
>>> "frame_u" in cut.point_data
True
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from .._core import SampledFrames, TetDomain, TetMesh
from ..domain.sites import fitting_frames, require_right_angles
from ..errors import InvalidInput
from ..options import require_one_of
from .analysed import AnalysedField

if TYPE_CHECKING:
    import pyvista

__all__ = ["slice_frames", "sample_frames"]

OUTSIDE = ("mask", "error")
MOST_POINTS = 10_000_000  # of a lattice


def sample_frames(
    field: AnalysedField | TetMesh | TetDomain,
    points: ArrayLike,
    frames: ArrayLike | None = None,
    *,
    tolerance: float | None = None,
    outside: str = "mask",
    threads: int = 0,
) -> SampledFrames:
    """The field at (k, 3) points: frames (k, 4) quaternions w x y z, confidence, tet and distance, each a row per
    point.

    field: a result, or a TetMesh with (n, 4) frames at its vertices. The sh4 vectors of the frames are interpolated
        linearly in the tet that holds the point, and projected to the nearest frame: second order in the mesh width,
        whatever the labels of the axes (interpolating frame_u or quaternion is wrong where the labels of a tet's
        vertices disagree). confidence is the norm of the interpolant: 1 where the tet's frames are equal, near 0 at
        singular curves, where the frame means little. A result that lives in the tets is sampled through its frames at
        the vertices.

    tolerance: a point outside the mesh, but no farther from it, has the frame of the mesh's nearest point (input unit;
        None: a millionth of the bounding-box diagonal; math.inf: every point). outside: what a point farther outside
        gives, "mask" (a row of NaN, tet -1, confidence 0) or "error" (InvalidInput that names the first). Raises
        InvalidInput, GeometryError.

        >>> import octafield
        >>> tets = octafield.volume.tetrahedralize(octafield.domain.generators.generate("box"))
        >>> frames = octafield.frames.random_rotations(1).repeat(len(tets.vertices), axis=0)
        >>> found = octafield.sample_frames(tets, [[0.5, 0.5, 0.5]], frames)
        >>> bool(octafield.frames.distance(found.frames, frames[:1])[0] < 1e-6), round(float(found.confidence[0]), 12)
        (True, 1.0)
    """
    require_one_of("outside", outside, OUTSIDE)
    mesh, at_vertices = _parts(field, frames)
    if tolerance is not None and not tolerance >= 0:
        raise InvalidInput(f"tolerance must be a length, 0 or more, not {tolerance!r}", "option_out_of_range")
    found = _core.interpolate_frames(
        mesh, at_vertices, points, tolerance=-1 if tolerance is None else float(tolerance), threads=threads
    )
    away = np.flatnonzero(np.asarray(found.tet) < 0)
    if outside == "error" and len(away):
        few = ", ".join(map(str, away[:5])) + (" ..." if len(away) > 5 else "")
        raise InvalidInput(
            f"{len(away)} points are outside the mesh (rows {few}); leave them out, or raise the tolerance (math.inf:"
            " nearest point)",
            "outside",
        )
    return found


def slice_frames(
    field: AnalysedField | TetMesh | TetDomain,
    origin: ArrayLike | None = None,
    normal: ArrayLike = (0.0, 0.0, 1.0),
    frames: ArrayLike | None = None,
    *,
    spacing: float | None = None,
    threads: int = 0,
) -> pyvista.PolyData:
    """The field on a plane, as a dataset of pyvista: the cut through the tets, with frames at its points by
    sample_frames (not interpolated axes, which pyvista's and ParaView's slices give). Point data frame_u, frame_v,
    frame_w, quaternion, sh4 (of the frames) and confidence.

    origin: a point of the plane (None: the centre of the bounding box). normal: of any length. spacing: None for the
        points where the plane crosses edges of the mesh, as polygons; else points of a square lattice so far apart
        (input unit), those inside the mesh. frames: of a TetMesh. Raises InvalidInput where the plane misses the mesh,
        and GeometryError.

        >>> import octafield
        >>> from octafield.domain.generators import generate
        >>> result = octafield.compute_field(generate("box"), octafield.FieldOptions(edge_length=0.3))
        >>> octafield.slice_frames(result, normal=(0, 0, 1), spacing=0.1).point_data["frame_w"].shape[1]
        3
    """
    import pyvista

    mesh, at_vertices = _parts(field, frames)
    vertices = np.asarray(mesh.vertices)
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    middle = (low + high) / 2 if origin is None else _vector("origin", origin)
    direction = _vector("normal", normal)
    length = np.linalg.norm(direction)
    if not length > 0:
        raise InvalidInput("normal is 0; give a direction", "no_direction")
    direction = direction / length
    if spacing is None:
        grid = pyvista.UnstructuredGrid({pyvista.CellType.TETRA: np.asarray(mesh.tets)}, vertices)
        cut = grid.slice(normal=direction, origin=middle)
        places = np.asarray(cut.points, float)
    else:
        places = _lattice(vertices, middle, direction, spacing)
        places = places[np.asarray(_core.locate_points(mesh, places, threads=threads).tet) >= 0]
        cut = pyvista.PolyData(places) if len(places) else pyvista.PolyData()
    if not len(places):
        raise InvalidInput(
            f"the plane through {middle.tolist()} with normal {direction.tolist()} misses the mesh; its box is"
            f" {low.tolist()} to {high.tolist()}",
            "outside",
        )
    # Points of the cut are on the mesh up to the rounding of single precision, in which VTK may cut.
    found = sample_frames(
        mesh, places, at_vertices, tolerance=1e-5 * float(np.linalg.norm(high - low)), outside="error", threads=threads
    )
    put_frames(cut.point_data, np.asarray(found.frames))
    cut.point_data["confidence"] = np.asarray(found.confidence)
    return cut


def put_frames(data: pyvista.DataSetAttributes, frames: np.ndarray) -> None:
    """frame_u, frame_v, frame_w (columns of R), quaternion (w x y z) and sh4 of (n, 4) frames."""
    axes = np.asarray(_core.rotation_matrices(frames))
    for k, name in enumerate(("frame_u", "frame_v", "frame_w")):
        data[name] = np.ascontiguousarray(axes[:, :, k])
    data["quaternion"] = np.array(frames)
    data["sh4"] = np.asarray(_core.representations["sh4"].embed(frames))


def put_stretched_frames(data: pyvista.DataSetAttributes, frames: np.ndarray, stretch: np.ndarray) -> None:
    """As field.vtu has axes S Q: frame_u, frame_v, frame_w (unit), frame_lengths, stretch and rotation (Q, w x y z)."""
    axes = np.asarray(_core.stretched_axes(frames, stretch))
    lengths = np.linalg.norm(axes, axis=2)
    for k, name in enumerate(("frame_u", "frame_v", "frame_w")):
        data[name] = axes[:, k] / lengths[:, k, None]
    data["frame_lengths"], data["stretch"], data["rotation"] = lengths, np.array(stretch), np.array(frames)


def _parts(
    field: AnalysedField | TetMesh | TetDomain, frames: ArrayLike | None
) -> tuple[TetMesh | TetDomain, np.ndarray]:
    if isinstance(field, AnalysedField):
        if frames is not None:
            raise InvalidInput("a result has frames of its own; give frames with a TetMesh only", "bad_type")
        require_right_angles(field.stretch, "fields are sampled between vertices by sh4, with axes at right angles")
        return field.tets, np.asarray(field.frames)
    if not isinstance(field, (TetMesh, TetDomain)):
        raise InvalidInput(
            "a field is a result (octafield.compute_field, analyse) or a TetMesh with frames, not"
            f" {type(field).__name__}",
            "bad_type",
        )
    if frames is None:
        raise InvalidInput("a TetMesh needs frames, (n, 4) at its vertices", "no_frames")
    return field, fitting_frames(field, frames, "vertices")


def _vector(name: str, value: ArrayLike) -> np.ndarray:
    found = np.asarray(value, float)
    if found.shape != (3,) or not np.isfinite(found).all():
        raise InvalidInput(f"{name} must be three finite numbers, not {value!r}", "bad_shape")
    return found


def _lattice(vertices: np.ndarray, origin: np.ndarray, normal: np.ndarray, spacing: float) -> np.ndarray:
    """Points on the plane, over the box of the vertices seen along the normal; one of them is the origin."""
    if not (np.isfinite(spacing) and spacing > 0):
        raise InvalidInput(f"spacing must be a positive length, not {spacing!r}", "option_out_of_range")
    across = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    across /= np.linalg.norm(across)
    both = np.stack([across, np.cross(normal, across)])
    places = (vertices - origin) @ both.T / spacing
    first, last = np.ceil(places.min(axis=0)), np.floor(places.max(axis=0))
    if np.prod(np.maximum(last - first + 1, 0)) > MOST_POINTS:
        raise InvalidInput(
            f"spacing {spacing:g} makes more than {MOST_POINTS:,} points; give a larger one", "option_out_of_range"
        )
    steps = [np.arange(a, b + 1) for a, b in zip(first, last, strict=True)]
    grid: np.ndarray = np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, 2)
    points: np.ndarray = origin + spacing * grid @ both
    return points
