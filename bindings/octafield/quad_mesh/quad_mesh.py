"""From a file to quads of wanted sizes: read, singular points, field, whole numbers, quads, figures.

result = compute_quad_mesh("part.stl", quad_options=QuadMeshOptions(quads=3000), sizes=lambda points: 1 + points[:, 0])
result.mesh                    # octafield.surface.QuadMesh
result.record.size_ratio       # reached over wanted
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from .._core import ImposedField, IntegerGridMap, QuadMesh, SurfaceDomain, TriangleMesh
from ..domain.inputs import from_mesh, naming
from ..domain.meshed_input import MeshedInput
from ..domain.meshing import Source, prepare_mesh
from ..errors import InvalidInput
from ..hexdom.sizes import SizeAt, Sizes
from ..layout.blocks import TMesh
from ..layout.made import quads_on
from ..layout.options import MOST_QUADS, QuadLayoutOptions
from ..layout.points.wanted import PointsWanted, meshed_with_places
from ..layout.quality import quads_round
from ..options import SurfaceFieldOptions
from ..planar.read import Outline
from ..progress.phases import PhaseClock, Progress
from ..view.notebook import Facts, ShownInNotebooks
from .given_field import FieldGiven, GivenField, field_at, is_vtp
from .options import QuadMeshOptions
from .plane import box_round, input_of_outline, is_outline, kept, mean_segment, outline_of, triangle_length
from .sized import quads_wanted, size_at, sized

if TYPE_CHECKING:
    import pyvista

    from ..records.quad_mesh import QuadMeshRecord

_SHOWN = ("quads", "target", "irregular_vertices", "scaled_jacobian", "size_ratio", "surface_deviation")


@dataclass(repr=False, kw_only=True)
class QuadMeshResult(ShownInNotebooks):
    """Quads and what led to them.

    mesh: the quads. scaled_jacobians: (q,). size_ratios: (q,) square root of the area over the edge length wanted
    there. valences: (V,) quads round each vertex; on_boundary: (V,) bool. field: with their singular points, on the
    surface refined round these. t_mesh: that they come from; None with a kept boundary. record: all figures, the JSON
    object of the command line."""

    mesh: QuadMesh
    scaled_jacobians: np.ndarray
    size_ratios: np.ndarray
    valences: np.ndarray
    on_boundary: np.ndarray
    field: ImposedField
    record: QuadMeshRecord
    t_mesh: TMesh | None = None

    def __repr__(self) -> str:
        r = self.record
        return (
            f"QuadMeshResult({r.input}: {r.quads:,} quads, {sum(r.irregular_vertices.values()):,} irregular vertices;"
            f" least scaled Jacobian {r.scaled_jacobian.min:.3f})"
        )

    def grid_map(self, progress: Progress | None = None) -> IntegerGridMap:
        """The surface mapped to the plane so that lines of whole u and v are those of the quads
        (octafield.surface.integer_grid_map); write_grid_map writes it. Raises SolverError (kind "folded_map", naming
        how many triangles stay folded and in which of the field's surface), InvalidInput (kind "ignored_option") with a
        kept boundary, Cancelled."""
        if self.t_mesh is None:
            raise InvalidInput(
                "quads with a kept boundary come from templates there, and no map of the surface; mesh without keeping"
                " it",
                "ignored_option",
            )
        t_mesh = self.t_mesh
        origins: ArrayLike = [] if t_mesh.origins is None else t_mesh.origins
        return _core.integer_grid_map(t_mesh.graph, t_mesh.quads, origins, progress=progress)

    def _facts(self) -> Facts:
        return str(self.record.input), {name: self.record.to_dict()[name] for name in _SHOWN}

    def scene(self) -> pyvista.Plotter:
        """A pyvista scene: quads by their scaled Jacobian."""
        from ..view.window import shown_where_possible

        return shown_where_possible(self._drawn())

    def _drawn(self) -> pyvista.Plotter:
        from ..view.quad_layout import jacobian_scene

        return jacobian_scene(self.grid())

    def grid(self) -> pyvista.UnstructuredGrid:
        """The quads with cell data scaled_jacobian and size_ratio; point data quads (round the vertex), boundary."""
        from ..view.datasets import quad_grid

        grid = quad_grid(self.mesh)
        grid.cell_data["scaled_jacobian"] = self.scaled_jacobians
        grid.cell_data["size_ratio"] = self.size_ratios
        grid.point_data["quads"] = self.valences.astype(np.int32)
        grid.point_data["boundary"] = self.on_boundary.astype(np.uint8)
        return grid


def compute_quad_mesh(
    source: Source | SurfaceDomain | MeshedInput | Outline,
    options: SurfaceFieldOptions = SurfaceFieldOptions(),
    progress: Progress | None = None,
    *,
    quad_options: QuadMeshOptions = QuadMeshOptions(),
    sizes: Sizes | None = None,
    field: FieldGiven | None = None,
) -> QuadMeshResult:
    """Quads on a surface, open or closed, on the boundary of a tet mesh (paths or meshes in memory), or on a plane
    region by its outline (read_outline, planar_outline: files, GeoJSON, lists of loops), along a cross field whose
    singular points are their irregular vertices, about as large as wanted; features are followed.

    With keep_boundary every segment of the outline, or of the boundary of a flat surface, is an edge of a quad: the
    quads of a rectangle round it are taken as far as they stay clear of it, and templates go between
    (compute_fixed_boundary_quads).

    options: of the mesh that the field is computed on, and of that field. Their edge_length is that of triangles.
    sizes: edge lengths wanted, input unit: a function of (n, 3) points; (n,) one per vertex of the input; (k, 4) rows
        x y z size; a file of these, .npy or text; or "growth=0.2": the length of the boundary's edges at the nearest
        place of it, plus 0.2 times the distance. The field is the one of the surface measured in them, so that it
        turns as quads of such sizes have to. None: the same everywhere.

    field: a cross field in place of a computed one: (V, 3) or (F, 3) directions, one of each cross, at the vertices or
        triangles of the input, .npy of these, or .vtp of a surface with data `direction`. Its singular points are to be
        the irregular vertices, and edges of quads are drawn to its directions (quad_options.follow).

    progress(phase, fraction, merit): False cancels. Raises InvalidInput, GeometryError, IoError, SolverError,
    Cancelled.

        >>> import octafield
        >>> corners = [[0, 0, 0], [3, 0, 0], [3, 1, 0], [0, 1, 0]]
        >>> plate = octafield.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]])
        >>> result = octafield.compute_quad_mesh(plate, quad_options=octafield.QuadMeshOptions(quads=12))
        >>> result.record.quads, result.record.irregular_vertices, result.record.scaled_jacobian.min > 0.99
        (12, {}, True)
    """
    if quad_options.keep_boundary:
        return _kept(source, options, progress, quad_options, sizes, field)
    if is_outline(source) and field is not None and not is_vtp(field):
        raise InvalidInput(
            "an outline has no vertices or triangles that a field could be of; give .vtp of a surface with the field",
            "wrong_type",
        )
    read: Any = input_of_outline(source, progress) if is_outline(source) else source
    meshed, places, given = meshed_with_places(read, replace(options, interfaces=False), progress)
    with naming(meshed.name):
        found = places.found or from_mesh(meshed.surface)
        own = None if field is None else field_at(field, found)
        if own is None and quad_options.follow != "default":
            raise InvalidInput(
                "no field was given that quads could follow: give one (--field, field=), or leave --follow out",
                "ignored_option",
            )
        name = str(field) if isinstance(field, (str, Path)) else "given"
        points = PointsWanted(
            places, None, None, options, fitted=True, field=None if own is None else own.aligned, field_name=name
        )
        wanted_at = None if sizes is None else size_at(sizes, found)
        return _on(meshed, given, points, quad_options, wanted_at, progress, own)


def _kept(
    source: Any,
    options: SurfaceFieldOptions,
    progress: Progress | None,
    wanted: QuadMeshOptions,
    sizes: Sizes | None,
    field: FieldGiven | None,
) -> QuadMeshResult:
    from . import record

    if isinstance(source, MeshedInput):
        source = source.surface
    if field is not None:
        raise InvalidInput(
            "a field cannot be given where the boundary is kept: the field is one of a rectangle round it",
            "ignored_option",
        )
    outline, height, found = outline_of(source, progress)
    if not (wanted.quads or wanted.edge_length or sizes is not None):
        wanted = replace(wanted, edge_length=mean_segment(outline))
    with naming(found.name):
        known = None if sizes is None else size_at(sizes, found)
        region = prepare_mesh(found, replace(options, interfaces=False), volume=False, progress=progress)
        target, scale = _target(region, wanted, known)
        there = _times(known, scale)
        box = box_round(outline, height, options.edge_length or triangle_length(outline, height, there))
        round_it = replace(options, remesh=False, edge_length=0.0, features="none", interfaces=False)
        inner = QuadMeshOptions(edge_length=scale if known is None else 0.0, inadmissible=wanted.inadmissible)
        result = compute_quad_mesh(box, round_it, progress, quad_options=inner, sizes=None if known is None else there)
        clock = PhaseClock(region.clock)
        with clock.phase("channel"):
            mesh, figures = kept(outline, height, result.mesh, progress)
        ratios = _size_ratios(mesh, known, scale)
        told = record.of_kept_boundary(result.record, mesh, figures, clock, ratios, found, target, wanted, options)
    on_boundary, valences = quads_round(np.asarray(mesh.quads), len(mesh.vertices))
    return QuadMeshResult(
        mesh=mesh,
        scaled_jacobians=np.asarray(_core.scaled_jacobians(mesh)),
        size_ratios=ratios,
        valences=valences,
        on_boundary=on_boundary,
        field=result.field,
        record=told,
    )


def _times(sizes: SizeAt | None, scale: float) -> SizeAt:
    if sizes is None:
        return lambda points: np.full(len(points), scale)
    return lambda points: scale * sizes(points)


def _on(
    meshed: MeshedInput,
    given: TriangleMesh,
    points: PointsWanted,
    wanted: QuadMeshOptions,
    sizes: SizeAt | None,
    progress: Progress | None,
    own: GivenField | None,
) -> QuadMeshResult:
    from . import record

    target, scale = _target(meshed, wanted, sizes)
    layout = QuadLayoutOptions(quads=target, blocks="fine", measure="lengths", inadmissible=wanted.inadmissible)
    measure = None if sizes is None else partial(sized, sizes=sizes)
    follow = None if own is None or wanted.follow == "points" else own.followed
    found = quads_on(meshed, given, points, layout, progress, measure, follow)
    ratios = _size_ratios(found.quads.mesh, sizes, scale)
    told = record.of_quad_mesh(found, ratios, target, len(meshed.surface.triangles), wanted, points.options, own)
    return QuadMeshResult(
        mesh=found.quads.mesh,
        scaled_jacobians=found.figures.scaled_jacobians,
        size_ratios=ratios,
        valences=found.figures.quads_round,
        on_boundary=found.figures.on_boundary,
        field=found.field,
        record=told,
        t_mesh=found.quads.t_mesh,
    )


def _target(meshed: MeshedInput, wanted: QuadMeshOptions, sizes: SizeAt | None) -> tuple[int, float]:
    """How many quads, and their edge length where sizes are None, else what sizes are times."""
    domain = SurfaceDomain(meshed.surface)
    area = float(np.asarray(_core.triangle_areas(meshed.surface)).sum())
    per_unit = area if sizes is None else quads_wanted(domain, sizes)  # quads of size 1, or of these sizes
    if wanted.quads:
        count = float(wanted.quads)
    elif wanted.edge_length:
        count = area / wanted.edge_length**2
    elif sizes is None:
        count = area / float(_core.mean_edge_length(meshed.surface)) ** 2
    else:
        count = per_unit
    if count > MOST_QUADS:
        raise InvalidInput(
            f"that asks for about {count:.2g} quads, and at most {MOST_QUADS:,} are made; give a larger edge length or"
            " larger sizes",
            "too_many_cells",
        )
    return max(1, round(count)), float(np.sqrt(per_unit / count))


def _size_ratios(mesh: QuadMesh, sizes: SizeAt | None, scale: float) -> np.ndarray:
    corners = np.asarray(mesh.vertices)[np.asarray(mesh.quads)]
    areas = np.linalg.norm(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]), axis=1) / 2
    there = 1.0 if sizes is None else sizes(corners.mean(axis=1))
    ratios: np.ndarray = np.sqrt(areas) / (scale * there)
    return ratios
