"""The whole way from a file to a frame field: read, mesh, cross field, constraints, smoothing, analysis.

    result = compute_field("part.stl", FieldOptions(boundary="fixed"))
    result.frames            # (n, 4) unit quaternions w x y z
    result.record.energy     # the figures that every table shows

A comparison prepares a FieldProblem once and runs it with several options:

    problem = prepare_field(prepare_mesh("part.stl"), seed=0)
    results = [run_field(problem, FieldOptions(boundary=boundary)) for boundary in ("fixed", "aligned")]
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from .._core import (
    BoundaryConstraints,
    DirectionField,
    Streamline,
    SurfaceSingularities,
    TetDomain,
    TetMesh,
    VertexConstraints,
)
from ..domain.locking import split_between_singular
from ..domain.meshed_input import MeshedInput
from ..domain.meshing import Source, prepare_mesh
from ..errors import InvalidInput
from ..options import OF_A_START, FieldOptions, MeshOptions
from ..progress.phases import PeakMemory, PhaseClock, Progress, announce, forward
from .analysed import AnalysedField, analysed_field
from .direction_field import structure
from .free_axes import values_of, with_vertices
from .smoothing import held_at_start, smoothed_field


@dataclass(repr=False)
class FieldProblem:
    """What all runs on one input and seed share: the mesh and the surface cross field.

    meshed: the input. seed: of the cross field. direction_field: of the surface. directions: (B, 3), per vertex of the
    surface. singularities, separatrices: of the cross field. clock, peak_mb: what it took."""

    meshed: MeshedInput
    seed: int
    direction_field: DirectionField
    directions: np.ndarray  # (B, 3) per surface vertex
    singularities: SurfaceSingularities
    separatrices: Sequence[Streamline]
    clock: PhaseClock
    peak_mb: float

    def __repr__(self) -> str:
        return (
            f"FieldProblem({self.meshed!r}, seed {self.seed}, "
            f"{len(self.singularities.points):,} singular points on the surface)"
        )


@dataclass(repr=False, kw_only=True)
class FieldResult(AnalysedField):
    """A frame field and what led to it: the cross field on the surface, and the constraints, on vertices or, with
    sampling "tets", tets.

    parent: with the option split_singular, (m,) tet of the mesh the field was computed on, which constraints are of,
        that each tet is part of; else None."""

    direction_field: DirectionField
    directions: np.ndarray
    singularities: SurfaceSingularities
    separatrices: Sequence[Streamline]
    constraints: BoundaryConstraints
    parent: np.ndarray | None = None

    def __repr__(self) -> str:
        r = self.record
        return (
            f"FieldResult({r.input}: {r.vertices:,} vertices, {r.tets:,} tets; {r.representation},"
            f" {r.boundary}; E {r.energy:.6g}, {r.singular_edges:,} singular edges)"
        )


def compute_field(
    source: Source | MeshedInput,
    options: FieldOptions = FieldOptions(),
    progress: Progress | None = None,
    *,
    constraints: VertexConstraints | None = None,
    start: ArrayLike | None = None,
) -> FieldResult:
    """Frame field inside a closed surface or on a tet mesh (paths or meshes in memory).

    constraints: the user's own, on vertices (or, with sampling "tets", tets) of the mesh the field is computed on.
        Meshing and splitting make another mesh of the input, so prepare it first:

        >>> import octafield
        >>> from octafield.domain.generators import generate
        >>> meshed = octafield.prepare_mesh(generate("ball"), octafield.MeshOptions(edge_length=0.3))  # or a path
        >>> Held = octafield.volume.VertexConstraints
        >>> held = Held(vertices=[300], kinds=["axis"], axes=[[0, 0, 1]])  # of meshed.tets
        >>> result = octafield.compute_field(meshed, constraints=held)
        >>> result.record.constraints["given"]
        1

    start: (n, 4) frames to smooth from, on that mesh's vertices (sampling "tets": tets), such as octafield.read_frames
        gives; they are polished by one smoothing, without the heat flow that a field begins with otherwise.

    progress(phase, fraction, merit): False cancels. Raises InvalidInput, GeometryError, IoError, SolverError,
    Cancelled.
    """
    if start is not None and not isinstance(source, (MeshedInput, TetMesh, TetDomain)):
        raise InvalidInput(
            "a start belongs to a tet mesh; give that, or the result of prepare_mesh(source, options)", "not_meshed"
        )
    if constraints is not None and not isinstance(source, MeshedInput):
        raise InvalidInput(
            "constraints belong to the tet mesh the field is computed on; "
            "give the result of prepare_mesh(source, options) instead of the source",
            "not_meshed",
        )
    meshed = source if isinstance(source, MeshedInput) else prepare_mesh(source, options, progress=progress)
    return run_field(
        prepare_field(meshed, options.seed, progress), options, progress, constraints=constraints, start=start
    )


def prepare_field(meshed: MeshedInput, seed: int = 0, progress: Progress | None = None) -> FieldProblem:
    """Computes the cross field on the surface, the start of every boundary frame. Raises GeometryError, SolverError.

    >>> import octafield
    >>> from octafield.domain.generators import generate
    >>> octafield.prepare_field(octafield.prepare_mesh(generate("box"), octafield.MeshOptions(edge_length=0.3))).seed
    0
    """
    memory = PeakMemory()
    clock = PhaseClock(meshed.clock)
    with clock.phase("surface"):
        announce(progress, "surface")
        field = _core.direction_field(
            _core.sheet_domain(meshed.volume()), seed=seed, progress=forward(progress, "surface", 0.0, 0.9)
        )
        directions, singularities, separatrices = structure(field, progress)
    peak = max(meshed.peak_mb, memory.megabytes())
    return FieldProblem(meshed, seed, field, directions, singularities, separatrices, clock, peak)


def run_field(
    problem: FieldProblem,
    options: FieldOptions = FieldOptions(),
    progress: Progress | None = None,
    *,
    constraints: VertexConstraints | None = None,
    start: ArrayLike | None = None,
) -> FieldResult:
    """One frame field on a prepared problem. The record's phase times include those of the shared preparation.
    constraints, start: see compute_field. Raises InvalidInput where options of the mesh differ from those it was
        prepared with and from the defaults.

        >>> import octafield
        >>> from octafield.domain.generators import generate
        >>> meshed = octafield.prepare_mesh(generate("box"), octafield.MeshOptions(edge_length=0.3))
        >>> problem = octafield.prepare_field(meshed)
        >>> for boundary in ("fixed", "aligned"):  # on one mesh, so that energies compare
        ...     result = octafield.run_field(problem, octafield.FieldOptions(boundary=boundary))
        ...     print(boundary, result.record.singular_edges)
        fixed 0
        aligned 0
    """
    from . import record

    memory = PeakMemory()
    meshed, clock = problem.meshed, PhaseClock(problem.clock)
    _refuse_ignored(meshed, options)
    if start is not None and options.axes == "free":
        raise InvalidInput(
            "a start has axes at right angles, and free axes begin from the boundary; leave out the start, or take axes"
            " 'orthogonal'",
            "stretched_axes",
        )
    tets = meshed.volume()
    with clock.phase("smooth"):
        announce(progress, "smooth")
        in_tets = _core.tet_sampling(tets) if options.sampling == "tets" else None
        stretch = _core.axes_stretch(tets) if options.axes == "free" else None
        held = _core.surface_constraints(
            tets,
            problem.direction_field,
            sites=options.sampling,
            stretch=values_of(stretch),
            mode="none" if options.boundary == OF_A_START else options.boundary,
            feature_tolerance=options.feature_tolerance,
        )
        if options.boundary == OF_A_START:
            held = held_at_start(tets, options, held, start)
        if constraints is not None:
            held = _core.with_constraints(held, constraints)
        where = tets if in_tets is None else in_tets
        smoothed, diffusion_steps = smoothed_field(tets, options, where, held, start, problem.seed, progress)
    lengths = np.asarray(smoothed.lengths) if len(smoothed.lengths) else None
    frames, parent, split = np.asarray(smoothed.frames), None, None
    if options.split_singular:
        with clock.phase("analyse"):
            meshed, frames, lengths, parent, split = split_between_singular(meshed, frames, lengths, options.threads)
    found = analysed_field(meshed, frames, options, clock, memory, progress, lengths, values_of(stretch))
    if stretch is not None:
        found.record = with_vertices(found.record, stretch)
    found.record = found.record.changed(
        interface_triangles=meshed.interface_triangles,
        locking=meshed.locking,
        representation=options.scheme_name,
        solver=options.solver,
        boundary=options.boundary,
        seed=problem.seed,
        lengths=record.of_lengths(lengths),
        split_singular=split,
        peak_mb=max(found.record.peak_mb, round(problem.peak_mb, 1)),
        objective=float(smoothed.objective),
        iterations=smoothed.iterations,
        diffusion_steps=diffusion_steps,
        start="default" if start is None else "given",
        converged=bool(smoothed.converged),
        stop_reason=smoothed.message,
        energy_history=[float(e) for e in smoothed.energy_history],
        objective_history=[float(e) for e in smoothed.objective_history],
        surface_field=record.of_cross_field(problem.direction_field, problem.singularities),
        **record.of_constraints(held, constraints),
        options=replace(options, seed=problem.seed).recorded(),
    )
    return FieldResult(
        **vars(found),
        direction_field=problem.direction_field,
        directions=problem.directions,
        singularities=problem.singularities,
        separatrices=problem.separatrices,
        constraints=held,
        parent=parent,
    )


def _refuse_ignored(meshed: MeshedInput, options: FieldOptions) -> None:
    """Options of the mesh that were given and are not those it was prepared with would be ignored. Defaults count as
    not given."""
    if meshed.options is None:
        return
    names = [
        f.name
        for f in fields(MeshOptions)
        if getattr(options, f.name) not in (f.default, getattr(meshed.options, f.name))
    ]
    if names:
        listed = ", ".join(
            f"{name}={getattr(options, name)!r} (prepared with {getattr(meshed.options, name)!r})" for name in names
        )
        raise InvalidInput(
            f"{meshed.name}: the mesh is there already, so that {listed} would be ignored; give them to prepare_mesh",
            "ignored_options",
        )
