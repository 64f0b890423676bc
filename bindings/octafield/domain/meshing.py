"""From an input to the surface, its features and the tets inside: the part that all runs of a comparison share."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _core
from .._core import FeatureGraph, Sheets, TetDomain, TetMesh, TriangleMesh
from ..errors import GeometryError, InvalidInput
from ..options import MeshOptions
from ..progress.phases import PeakMemory, PhaseClock, Progress, announce, forward
from .inputs import Input, from_mesh, naming, read_input
from .locking import split_on_request
from .meshed_input import MeshedInput
from .repairing import message_with_remedy, repair_surface

if TYPE_CHECKING:
    from ..records.parts import LockingCounts

Array = np.ndarray[Any, Any]
Source = str | Path | TriangleMesh | TetMesh | TetDomain
FILLING = ("fill", "resolve", "wrap")  # levels of repair
REPAIR_IGNORED = "repair was ignored: it works on surfaces only"
TOUCHING = ("non_manifold_edge", "non_manifold_vertex")  # kinds of defects that the boundary of tets may have

_LARGEST = 1e60  # coordinates, input unit


def load_surface(path: str | Path, *, repair: str = "default") -> TriangleMesh:
    """Reads a closed surface, repaired up to a level (MeshOptions.repair), and raises GeometryError, InvalidInput or
    IoError naming the defect unless it is sound."""
    with naming(str(path)):
        return _sound(read_input(path), MeshOptions(repair=repair), closed=True, fills=True).surface


@dataclass
class SoundInput:
    """An input that was read and found fit, with its features, before any meshing."""

    found: Input
    features: FeatureGraph
    feature_source: str
    clock: PhaseClock
    peak_mb: float
    sheets: Sheets | None
    locking: LockingCounts | None


def read_sound(
    source: Source | Input,
    options: MeshOptions = MeshOptions(),
    *,
    volume: bool = True,
    fills: bool = False,
    progress: Progress | None = None,
) -> SoundInput:
    """Reads, validates and finds features: everything that can show an input unfit in short time. fills: where no
    volume is asked for, levels of repair from "fill" on fill holes all the same; else rims stay."""
    memory = PeakMemory()
    clock = PhaseClock()
    with clock.phase("read"):
        announce(progress, "read")
        if isinstance(source, Input):
            found = source
        elif isinstance(source, (TriangleMesh, TetMesh, TetDomain)):
            found = from_mesh(source)
        else:
            found = read_input(
                source, interfaces=options.interfaces, edge_length=options.edge_length, progress=progress
            )
        with naming(found.name):
            require_scale(np.asarray(found.surface.vertices if found.tets is None else found.tets.vertices))
            found = _sound(found, options, closed=volume, fills=volume or fills)
    with naming(found.name), clock.phase("mesh"):
        locking = None
        if found.tets is not None:
            locking = split_input(found, options)
        sheets = sheets_of(found)
        features, feature_source = find_features(found, options, sheets)
        if found.tets is not None:
            found.tets = found.tets.with_features(features)
        of_surface = features if sheets is None else _core.features_on_sheets(features, sheets)
    return SoundInput(found, of_surface, feature_source, clock, memory.megabytes(), sheets, locking)


def require_scale(points: Array, what: str = "coordinates") -> None:
    """Products of four lengths and their inverses are to be numbers."""
    if not len(points) or not np.isfinite(points).all():
        return
    extent = float((points.max(axis=0) - points.min(axis=0)).max())
    if np.abs(points).max() > _LARGEST or 0 < extent < 1 / _LARGEST:
        raise InvalidInput(
            f"{what} reach {np.abs(points).max():.2g}, over {extent:.2g}: lengths from {1 / _LARGEST:g} to"
            f" {_LARGEST:g} are computed with; take another unit",
            "size_out_of_range",
        )


def split_input(found: Input, options: MeshOptions) -> LockingCounts:
    """Counts what joins the surface of the tets to itself, and splits it where the options say so."""
    found.tets, locking = split_on_request(found.volume(), options)
    if options.split:
        found.surface = found.tets.surface.mesh
    return locking


def sheets_of(found: Input) -> Sheets | None:
    """Of a surface of tets that is not manifold."""
    return found.volume().sheets if found.interface_triangles or found.touches else None


def prepare_mesh(
    source: Source | Input | SoundInput,
    options: MeshOptions = MeshOptions(),
    *,
    volume: bool = True,
    fills: bool = False,
    progress: Progress | None = None,
) -> MeshedInput:
    """Reads, validates, finds features, remeshes and (volume) fills with tets.

    Tet meshes are kept; their boundary is the surface. An open surface is accepted where no volume is asked for; with
    `fills` levels of repair from "fill" on fill its holes, else rims stay.
    source: a path, TriangleMesh or TetMesh. Raises InvalidInput, GeometryError (naming the defect), IoError, Cancelled.

        >>> import octafield
        >>> from octafield.domain.generators import generate
        >>> meshed = octafield.prepare_mesh(generate("box"), octafield.MeshOptions(edge_length=0.3))
        >>> len(meshed.features.corners), meshed.feature_source
        (8, 'angle')
    """
    if not isinstance(source, SoundInput):
        source = read_sound(source, options, volume=volume, fills=fills, progress=progress)
    memory = PeakMemory()
    found, clock = source.found, source.clock
    with naming(found.name), clock.phase("mesh"):
        announce(progress, "mesh")
        meshed = MeshedInput(
            found.name,
            found.kind,
            found.surface if source.sheets is None else source.sheets.mesh,
            source.features,
            source.feature_source,
            found.tets,
            found.notes,
            clock,
            sheet_map=None if source.sheets is None else np.asarray(source.sheets.vertex_map),
            locking=source.locking,
            options=options,
        )
        if found.tets is not None:
            _note_unused(meshed, options, found.of_cad)
        else:
            if options.remesh:
                _remesh(meshed, options, progress, volume)
            if volume:
                _fill_or_refine(meshed, progress, options)
    meshed.peak_mb = max(source.peak_mb, memory.megabytes())
    return meshed


def _sound(found: Input, options: MeshOptions, *, closed: bool, fills: bool) -> Input:
    """Repairs as far as the level says, then raises unless the surface is sound."""
    repair_surface(found, options, closed or (fills and options.repair in FILLING))
    if found.tets is not None:
        # Tets of positive volume rarely cross, and the test is slow. Interfaces are sound where the tets are.
        _require_valid(found, options, fills, self_intersection=False)
    else:
        _require_valid(found, options, fills, closed=closed)
    return found


def _require_valid(found: Input, options: MeshOptions, fills: bool, **tests: bool) -> None:
    surface = found.surface
    if found.interface_triangles and found.tets is not None:
        surface = found.tets.boundary.mesh
    try:
        try:
            _core.require_valid(surface, **tests)
        except GeometryError as error:
            if found.tets is None or error.kind not in TOUCHING:
                raise
            _accept_touching(found, surface)
    except GeometryError as error:
        closed = tests.get("closed", True)
        message = message_with_remedy(str(error), error.kind, found, options, closed, fills=fills)
        raise GeometryError(message, error.kind, error.elements) from error


def _accept_touching(found: Input, surface: TriangleMesh) -> None:
    """Parts of a tet mesh may touch at edges and vertices: the cross field lives on the boundary cut open there."""
    for defect in _core.find_defects(surface, self_intersection=False):
        if defect.kind not in TOUCHING:
            raise GeometryError(defect.message, defect.kind, defect.elements)
    sheets = found.volume().sheets
    found.touches = True
    copies = np.bincount(np.asarray(sheets.vertex_map))
    alone = np.setdiff1d(np.flatnonzero(copies > 1), np.asarray(sheets.cuts))
    found.notes.append(
        f"the boundary touches itself at {len(sheets.cuts)} edges and {len(alone)} other vertices; these edges are "
        "features, the vertices corners"
    )


def find_features(found: Input, options: MeshOptions, sheets: Sheets | None) -> tuple[FeatureGraph, str]:
    """Of found.surface. Curves where interfaces meet the boundary or each other always belong to them."""
    source = options.features
    if source == "default":
        source = "file" if found.lines_are_features() else "angle"
        if found.lines is not None and source == "angle":
            found.notes.append("the file's lines list mesh edges in general; features were found by angle instead")
    if source == "file" and found.lines is None:
        raise InvalidInput(
            f"{found.name}: features were asked from the file, but it holds no line cells; "
            "use --features angle or none",
            "no_feature_lines",
        )
    if source == "angle" and sheets is None:
        return _core.detect_features(found.surface, angle=options.feature_angle), source
    edges: Array = np.empty((0, 2), np.int32) if source != "file" or found.lines is None else found.lines
    if sheets is not None:
        cuts = np.asarray(sheets.cuts)
        if source == "angle":
            edges = np.asarray(_core.detect_features(sheets.mesh, angle=options.feature_angle).edges)
            edges = np.asarray(sheets.vertex_map)[edges]
        edges = np.unique(np.sort(np.concatenate([edges, cuts]), axis=1), axis=0)
    return _core.feature_graph(found.surface, edges), source


def _remesh(meshed: MeshedInput, options: MeshOptions, progress: Progress | None, volume: bool) -> None:
    result = _core.remesh(
        meshed.surface,
        meshed.features,
        edge_length=options.edge_length,
        max_cells=options.cells,
        progress=forward(progress, "mesh", 0, 0.7 if volume else 1),
    )
    meshed.surface, meshed.features = result.mesh, result.features
    meshed.inner_length = result.inner_length
    meshed.notes += result.notes


def _fill_or_refine(meshed: MeshedInput, progress: Progress | None, options: MeshOptions) -> None:
    """Where TetGen fails in all its ways, other triangles of the same surface may do, unless these are to be kept."""
    try:
        return _fill(meshed, progress, options)
    except GeometryError as error:
        if error.kind not in ("tetgen_failed", "tetgen_self_intersection"):
            raise
        if not options.remesh:
            fact = str(error).partition("; ")[0]
            raise GeometryError(
                f"{fact}; leave out --no-remesh, so that other triangles can be tried", error.kind, error.elements
            ) from error
        failed = error
    surface, features, length = meshed.surface, meshed.features, float(_core.mean_edge_length(meshed.surface))
    for shorter in (0.8, 0.6):
        notes = len(meshed.notes)
        try:
            result = _core.remesh(surface, features, edge_length=shorter * length)
            meshed.surface, meshed.features, meshed.inner_length = result.mesh, result.features, result.inner_length
            meshed.notes += result.notes
            _fill(meshed, progress, options)
        except GeometryError:
            del meshed.notes[notes:]
            continue
        meshed.notes.append(
            f"TetGen could not fill the surface with edges of {length:.3g}; it could with edges of"
            f" {shorter * length:.3g}"
        )
        return
    fact = str(failed).partition("; ")[0]
    raise GeometryError(
        f"{fact}; nor with edges of {0.8 * length:.3g} and {0.6 * length:.3g}; try another --edge-length",
        failed.kind,
        failed.elements,
    ) from failed


def _fill(meshed: MeshedInput, progress: Progress | None, options: MeshOptions) -> None:
    announce(progress, "mesh", 0.7)
    count = len(meshed.surface.vertices)
    mesh = _core.tetrahedralize(meshed.surface, edge_length=meshed.inner_length, notes=meshed.notes)
    domain = TetDomain(mesh, features=meshed.features)
    if not np.array_equal(np.asarray(domain.surface.vertex_map), np.arange(count)):
        raise GeometryError("the tet mesh does not keep the vertices of the surface; please report this input")
    meshed.tets, meshed.locking = split_on_request(domain, options)
    meshed.surface = meshed.tets.surface.mesh  # the same vertices; triangles in the order of the tets


def _note_unused(meshed: MeshedInput, options: MeshOptions, of_cad: bool) -> None:
    if options.edge_length > 0 and not of_cad:
        meshed.notes.append("the edge length was ignored: tet meshes are kept as they are")
    if options.repair not in ("default", "none"):
        meshed.notes.append(REPAIR_IGNORED)
