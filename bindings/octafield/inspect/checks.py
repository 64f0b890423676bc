"""What the doctor for inputs asks of a sound input: each check is a function of what was examined that returns a
Finding."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _core
from .._core import FeatureGraph
from ..domain.inputs import Input
from ..errors import Error
from ..fields.verdict import WARN, rounded_down
from ..options import MeshOptions
from . import estimates
from .measures import curve_lengths, dihedral_angles, wall_samples

if TYPE_CHECKING:
    from ..records.parts import LockingCounts

PASS, FAIL, NOT_TESTED = "pass", "fail", "not tested"

SIZES = 1e-6, 1e6  # of bounding boxes, input unit: what the tests of octafield cover
_LEAST_ANGLE = 5.0  # degrees, of triangles
_LEAST_DIHEDRAL = 0.5  # degrees, of tets; TetGen leaves slivers of 0.7 under given surfaces
MOST_CELLS = 1e6  # that are advised
_SHARE = 0.02  # of the area that may be too fine for the mesh size before it is worth a word


@dataclass(frozen=True)
class Finding:
    """remedy: an option of the command line first where one does it. elements: ids of what the message names."""

    requirement: str
    state: str
    kind: str = ""
    message: str = ""
    remedy: str = ""
    elements: tuple[int, ...] = ()

    def to_json(self) -> dict[str, Any]:
        return {**vars(self), "elements": [int(i) for i in self.elements]}


@dataclass
class Examined:
    """An input without defects. length: of the shortest edges of the mesh to be made, or the mean where the mesh stays;
    lengths: (V,) of the edges to be made at the vertices of the surface; locking: counts of what joins the surface of
    tets to itself."""

    found: Input
    options: MeshOptions
    features: FeatureGraph
    feature_source: str
    length: float
    locking: LockingCounts | None = None
    lengths: np.ndarray[Any, Any] | None = None

    def at_triangles(self) -> np.ndarray[Any, Any]:
        """(F,) lengths of the edges there: to be made, or the longest of each triangle."""
        if self.lengths is not None:
            mean: np.ndarray[Any, Any] = self.lengths[np.asarray(self.found.surface.triangles)].mean(axis=1)
            return mean
        longest: np.ndarray[Any, Any] = np.linalg.norm(self.corners - np.roll(self.corners, 1, axis=1), axis=2).max(
            axis=1
        )
        return longest

    @property
    def remade(self) -> bool:
        """Whether the surface will get new triangles."""
        return self.found.tets is None and self.options.remesh

    @property
    def sized(self) -> bool:
        """Whether the edge length is the user's to choose."""
        return self.remade or (self.found.of_cad and self.found.tets is not None)

    @cached_property
    def diagonal(self) -> float:
        return float(_core.bounding_box_diagonal(self.found.surface.vertices))

    @cached_property
    def corners(self) -> np.ndarray[Any, Any]:
        """(F, 3, 3) of the triangles."""
        return np.asarray(self.found.surface.vertices)[np.asarray(self.found.surface.triangles)]

    @cached_property
    def dihedral_angles(self) -> np.ndarray[Any, Any]:
        """(m, 6) degrees, of the tets; no rows without."""
        tets = self.found.tets
        return np.empty((0, 6)) if tets is None else dihedral_angles(np.asarray(tets.vertices), np.asarray(tets.tets))


def _few(ids: Any) -> str:
    shown = ", ".join(map(str, list(ids)[:5]))
    return shown + (f" and {len(ids) - 5:,} more" if len(ids) > 5 else "")


def sizes(seen: Examined) -> Finding:
    text = "size can be computed with"
    if SIZES[0] <= seen.diagonal <= SIZES[1]:
        return Finding(text, PASS)
    factor = 10.0 ** -round(math.log10(seen.diagonal))
    return Finding(text, WARN, "size", f"the bounding box's diagonal is {seen.diagonal:.3g}, beyond {SIZES[0]:g} .. "
                                       f"{SIZES[1]:g}",
                   f"take another unit: multiply the coordinates by {factor:g}")  # fmt: skip


def digits(seen: Examined) -> Finding:
    """Coordinates far from the origin have few digits left for the shape."""
    text = "coordinates have digits for the shape"
    points = np.asarray(seen.found.surface.vertices)
    single = bool((points.astype(np.float32) == points).all())
    step = float(np.abs(points).max()) * float(np.finfo(np.float32 if single else np.float64).eps)
    edge = float(_core.mean_edge_length(seen.found.surface))
    if step < 1e-4 * edge:
        return Finding(text, PASS)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    return Finding(text, WARN, "far_from_origin",
                   f"the shape lies so far from the origin that coordinates are exact to {step:.1g} only, with edges "
                   f"of {edge:.3g}",
                   f"export it with more digits, or from a place nearer to the origin (its middle is "
                   f"{', '.join(f'{x:.6g}' for x in middle)})")  # fmt: skip


def lines_on_surface(seen: Examined) -> Finding:
    text = "feature lines are edges of the surface"
    if not seen.found.ignored_lines or seen.feature_source != "file":
        return Finding(text, PASS)
    return Finding(text, WARN, "lines_off_surface",
                   f"{seen.found.ignored_lines:,} lines of the file are no edges of its surface, or repeat one, and "
                   f"are left out",
                   "--features angle, or mark edges of the mesh")  # fmt: skip


def open_curves(seen: Examined) -> Finding:
    text = "feature curves end at corners"
    edges = np.asarray(seen.features.edges)
    ends = np.flatnonzero(np.bincount(edges.ravel(), minlength=1) == 1) if len(edges) else np.empty(0, int)
    if not len(ends):
        return Finding(text, PASS)
    how = "a smaller --feature-angle may go on with them, --features none leaves them out"
    return Finding(text, WARN, "open_features",
                   f"feature curves end in the middle of a face at {len(ends):,} vertices ({_few(ends)})",
                   how if seen.feature_source == "angle" else "--features angle, or mark whole curves",
                   tuple(ends.tolist()))  # fmt: skip


def feature_sizes(seen: Examined) -> Finding:
    text = "feature curves are longer than the edges"
    found = curve_lengths(seen.found.surface, seen.features)
    short = found[found < 0.5 * seen.length] if len(found) else found
    if not len(short) or not seen.remade:
        return Finding(text, PASS)
    return Finding(text, WARN, "short_features",
                   f"{len(short):,} feature curves are shorter than half an edge of {seen.length:.3g} (the shortest: "
                   f"{short.min():.3g})",
                   _shorter(seen, 2 * float(short.min())))  # fmt: skip


def curvature(seen: Examined) -> Finding:
    text = "edges are shorter than radii of curvature"
    surface = seen.found.surface
    try:
        found = _core.principal_directions(_core.SurfaceDomain(surface, seen.features))
    except Error:
        return Finding(text, PASS)  # interfaces: the surface has no two sides
    bend = np.abs(np.asarray(found.curvatures)[:, 0])
    areas = np.asarray(_core.triangle_areas(surface))
    tight = bend * seen.at_triangles() > 1
    share = float(areas[tight].sum() / areas.sum())
    if share < _SHARE:
        return Finding(text, PASS)
    order = np.argsort(bend)[::-1]
    worst = order[np.searchsorted(np.cumsum(areas[order]), _SHARE / 2 * areas.sum())]
    radius = float(1 / bend[worst])
    what = f"on {share:.0%} of the surface, where it is {radius:.3g} and less"
    if seen.sized:
        return Finding(
            text,
            WARN,
            "coarse_for_curvature",
            f"edges are longer than the radius of curvature {what}",
            _shorter(seen, radius),
        )
    return Finding(text, WARN, "coarse_for_curvature", f"edges are longer than the radius of curvature {what}",
                   _finer(seen), tuple(np.flatnonzero(tight).tolist()))  # fmt: skip


def _finer(seen: Examined) -> str:
    return "make the mesh finer there" + ("" if seen.found.tets is not None else ", or leave out --no-remesh")


def walls(seen: Examined) -> Finding:
    """Rays from triangles inward meet a nearly parallel face."""
    text = "walls are thicker than half an edge"
    if not seen.remade:
        return Finding(text, PASS)
    triangles, thick = wall_samples(seen.found.surface)
    thin = thick < 0.45 * seen.at_triangles()[triangles]
    if not len(thick) or float(thin.mean()) < _SHARE:
        return Finding(text, PASS)
    least = float(np.sort(thick)[int(_SHARE / 2 * len(thick))])
    return Finding(text, WARN, "thin_walls", f"walls are thinner than half an edge behind {float(thin.mean()):.0%} of "
                                             f"the surface, {least:.3g} and less",
                   _shorter(seen, 2 * least))  # fmt: skip


def _shorter(seen: Examined, length: float) -> str:
    """The option for edges of such a length, where so many cells can be computed with; tets of CAD models are made by
    Gmsh."""
    told = float(rounded_down(length))
    surface = seen.found.surface
    area = float(np.asarray(_core.triangle_areas(surface)).sum())
    if max(estimates.tets_inside(surface, told), area / (0.43 * told**2)) < MOST_CELLS:
        return f"--edge-length {told:.2g}"
    return "" if seen.options.edge_length == 0 or not seen.remade else "leave out --edge-length"


def triangle_shapes(seen: Examined) -> Finding:
    text = "triangles are well shaped"
    if seen.remade:
        return Finding(text, PASS)
    sides = np.roll(seen.corners, -1, axis=1) - seen.corners
    sides /= np.linalg.norm(sides, axis=2, keepdims=True)
    cosines = -np.einsum("fkc,fkc->fk", sides, np.roll(sides, 1, axis=1))
    angles = np.degrees(np.arccos(np.clip(cosines, -1, 1))).min(axis=1)
    thin = np.flatnonzero(angles < _LEAST_ANGLE)
    if not len(thin):
        return Finding(text, PASS)
    return Finding(text, WARN, "thin_triangles",
                   f"{len(thin):,} triangles have an angle below {_LEAST_ANGLE:g} degrees, the least "
                   f"{angles.min():.2g} ({_few(thin)})",
                   "another --edge-length" if seen.sized else "leave out --no-remesh" if seen.found.tets is None
                   else "mesh the volume anew from a better surface",
                   tuple(thin.tolist()))  # fmt: skip


def tet_shapes(seen: Examined) -> Finding:
    text = "tets are well shaped"
    angles = seen.dihedral_angles
    low, high = angles.min(axis=1), angles.max(axis=1)
    bad = np.flatnonzero(~((low >= _LEAST_DIHEDRAL) & (high <= 180 - _LEAST_DIHEDRAL)))
    if not len(bad):
        return Finding(text, PASS)
    return Finding(text, WARN, "slivers",
                   f"{len(bad):,} of {len(low):,} tets have a dihedral angle below {_LEAST_DIHEDRAL:g} or above "
                   f"{180 - _LEAST_DIHEDRAL:g} degrees, "
                   f"the least {np.nanmin(low):.2g}, the largest {np.nanmax(high):.4g} ({_few(bad)})",
                   "another --edge-length" if seen.sized else
                   "make the volume mesh anew from its surface (octafield.volume.boundary_surface, "
                   "octafield.volume.tetrahedralize); energies near such tets mean little",
                   tuple(bad.tolist()))  # fmt: skip


def locking(seen: Examined) -> Finding:
    text = "nothing inside joins the surface to itself"
    found = seen.locking
    if found is None:
        return Finding(text, PASS)
    counts = {
        name: count
        for name, count in (("tets", found.tets), ("edges", found.edges), ("triangles", found.triangles))
        if count
    }
    if seen.options.split:
        left = found.left
        if not left:
            return Finding(text, PASS)
        return Finding(text, WARN, "locking_left",
                       f"{left:,} tets with all vertices on the surface are too flat to split",
                       "make the volume mesh anew from its surface (octafield.volume.boundary_surface, "
                       "octafield.volume.tetrahedralize)")  # fmt: skip
    if not counts:
        return Finding(text, PASS)
    listed = ", ".join(f"{count:,} {name if count > 1 else name[:-1]}" for name, count in counts.items())
    return Finding(text, WARN, "locking", f"{listed} inside have all vertices on the surface, which holds the frames "
                                          f"there from both sides",
                   "--split")  # fmt: skip


def memory(seen: Examined, tets: int) -> Finding:
    text = "memory suffices"
    needed, there = estimates.memory_mb(tets), estimates.machine_mb()
    if needed < 0.8 * there:
        return Finding(text, PASS)
    remedy = f"a machine with {needed / 800:,.0f} GB, or a coarser mesh"
    base, per_tet = estimates.memory_mb(0), (needed - estimates.memory_mb(0)) / tets
    fit = (0.7 * there - base) / per_tet
    if fit > 0 and (seen.sized or seen.found.tets is None):
        coarser = (
            estimates.edge_length_for(seen.found.surface, fit)
            if seen.found.tets is None
            else seen.length * (tets / fit) ** (1 / 3)
        )
        remedy = f"--edge-length {_rounded_up(coarser)}" if coarser > seen.length else remedy
    return Finding(
        text,
        WARN,
        "memory",
        f"about {tets:,} tets need {needed / 1000:,.1f} GB of this machine's {there / 1000:.1f}",
        remedy,
    )


def _rounded_up(value: float) -> str:
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f"{math.ceil(value / unit * (1 - 1e-12)) * unit:.2g}"


OF_ALL = (sizes, digits, lines_on_surface, open_curves, feature_sizes, curvature)
OF_SURFACES = (walls, triangle_shapes)
OF_TETS = (tet_shapes, locking)
