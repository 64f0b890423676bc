"""Frames whose axes are the columns of S Q, at any angle (octafield.volume.axes_stretch): what records tell of them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import AxesStretch, BoundaryMeshability, TetDomain
from ..options import FieldOptions

if TYPE_CHECKING:
    from ..records.field import FieldRecord
    from ..records.parts import AxesFigures, WedgeFigures

_OBLIQUE = math.radians(1)
_STEP = 15  # degrees, of the table of feature edges


def values_of(stretch: AxesStretch | None) -> np.ndarray | None:
    """(n, 6); None where nothing is stretched, so that fields are those at right angles bit by bit."""
    return None if stretch is None or not len(stretch.sharp) else np.array(stretch.values)


def off_wedges_of(
    tets: TetDomain, frames: np.ndarray, stretch: np.ndarray | None, options: FieldOptions
) -> np.ndarray | None:
    """Where axes may be at any angle."""
    if options.axes != "free":
        return None
    return np.asarray(_core.wedge_alignment(tets, frames, stretch=stretch, threads=options.threads))


def axes_figures(
    tets: TetDomain,
    frames: np.ndarray,
    stretch: np.ndarray | None,
    found: BoundaryMeshability,
    off_wedges: np.ndarray | None,
) -> AxesFigures | None:
    """found: with the wedges that off_wedges, (k, 2) radians, is of; None: axes are at right angles."""
    from ..records.parts import AxesFigures, Range

    if off_wedges is None:
        return None
    none = np.tile([1.0, 1, 1, 0, 0, 0], (len(frames), 1))
    axes = np.asarray(_core.stretched_axes(frames, none if stretch is None else stretch))
    lengths = np.linalg.norm(axes, axis=2)
    unit = axes / lengths[:, :, None]
    cosines = abs(np.einsum("vid,vid->vi", unit, np.roll(unit, 1, axis=1))).max(axis=1)
    oblique = np.zeros(len(frames)) if stretch is None else np.arcsin(np.minimum(cosines, 1))
    return AxesFigures(
        oblique_share=float((oblique > _OBLIQUE).mean()),
        largest_obliqueness_deg=math.degrees(float(oblique.max(initial=0))),
        lengths=Range(min=float(lengths.min()), median=float(np.median(lengths)), max=float(lengths.max())),
        wedges=_by_angle(np.array([wedge.angle for wedge in found.wedges]), off_wedges),
    )


def with_vertices(record: FieldRecord, stretch: AxesStretch) -> FieldRecord:
    """With the vertices that the stretch comes from, and a note of those that are not followed."""
    figures = record.axes
    assert figures is not None
    told = figures.changed(
        followed_vertices=len(stretch.followed),
        sharp_vertices=len(stretch.sharp),
        needle_vertices=len(stretch.needles),
    )
    notes = list(record.notes)
    if len(stretch.sharp):
        notes.append(
            "axes are not at right angles: energy, singular curves and the rotation in field.vtu are those of Q, the"
            " axes those of S Q; integrability is left out"
        )
    return record.changed(axes=told, notes=notes)


def _by_angle(angles: np.ndarray, off: np.ndarray) -> list[WedgeFigures]:
    from ..records.parts import WedgeFigures
    from .record import degrees_of

    nearest = np.rint(np.degrees(angles) / _STEP).astype(int) * _STEP
    return [
        WedgeFigures(
            angle_deg=int(angle),
            edges=int((nearest == angle).sum()),
            off_faces_deg=degrees_of(off[nearest == angle, 0]),
            off_edges_deg=degrees_of(off[nearest == angle, 1]),
        )
        for angle in np.unique(nearest)
    ]
