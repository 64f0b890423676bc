"""The whole way from a file to a frame field: read, mesh, cross field, constraints, smoothing, analysis.

    result = compute_field("part.stl", FieldOptions(boundary="fixed"))
    result.frames            # (n, 4) unit quaternions w x y z
    result.record["energy"]  # the figures that every table shows

A comparison prepares a Problem once and runs it with several options:

    problem = prepare(prepare_mesh("part.stl"), seed=0)
    results = [run(problem, FieldOptions(boundary=boundary)) for boundary in ("fixed", "aligned")]
"""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from . import _core, display
from ._core import (
    BoundaryConstraints,
    BoundaryMeshability,
    DirectionField,
    FeatureGraph,
    FrameStreamline,
    Integrability,
    Meshability,
    SingularGraph,
    Streamline,
    SurfaceSingularities,
    TetMesh,
    TriangleMesh,
    VertexConstraints,
)
from .analysis import FieldAnalysis, analyse, constraint_counts, counts_by_index, spread
from .errors import InvalidInput
from .meshing import MeshedInput, Source, load_surface, prepare_mesh
from .options import OF_A_START, FieldOptions, MeshOptions, SurfaceFieldOptions
from .phases import PeakMemory, PhaseClock, Progress, announce, forward
from .sizes import Sizes, sizes_of_run
from .smoothing import held_at_start, smoothed_field
from .tet_analysis import TetFieldAnalysis, analyse_tets
from .surface_pipeline import SurfaceFieldResult, common_record, compute_surface_field, index_summary, structure

if TYPE_CHECKING:
    import pyvista

__all__ = [
    "FieldOptions",
    "FieldResult",
    "MeshOptions",
    "MeshedInput",
    "Problem",
    "SurfaceFieldOptions",
    "SurfaceFieldResult",
    "compute_field",
    "compute_surface_field",
    "load_surface",
    "prepare",
    "prepare_mesh",
    "run",
]


@dataclass(repr=False)
class Problem:
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
        return display.problem_line(self)


@dataclass(repr=False)
class FieldResult:
    """A frame field and what led to it. frames: (n, 4) unit quaternions w x y z, per tet vertex. alignment: radians,
    per boundary vertex and smooth sector, interfaces included. feature_alignment: radians, per feature tangent. record:
    the JSON object of the command line. regions: (m,) ids of the tets where the mesh has several. lengths: (n, 3) of the
    frames' axes, of the representation odeco_lengths. sizes: an IsotropicScale or AxisScales, as the option of that name asks.

    With sampling "tets" the field is tet_frames, (m, 4), and so are constraints, singular_graph (of singular_edges),
    alignment (per triangle and tet beside it) and lengths; frames is the field taken to the vertices, meshability and
    integrability are None; sizes are those of frames."""

    surface: TriangleMesh
    features: FeatureGraph
    direction_field: DirectionField
    directions: np.ndarray
    singularities: SurfaceSingularities
    separatrices: Sequence[Streamline]
    tets: TetMesh
    constraints: BoundaryConstraints
    frames: np.ndarray
    singular_graph: SingularGraph
    alignment: np.ndarray
    feature_alignment: np.ndarray
    meshability: Meshability | None
    boundary_meshability: BoundaryMeshability | None
    integrability: Integrability | None
    streamlines: list[FrameStreamline]
    record: dict[str, Any]
    regions: np.ndarray | None = None
    tet_frames: np.ndarray | None = None
    lengths: np.ndarray | None = None
    sizes: Sizes | None = None

    def __repr__(self) -> str:
        return display.field_line(self)

    def scene(self) -> "pyvista.Plotter":
        """The singular curves inside the translucent surface, to show() in a window or Jupyter."""
        return display.scene_of(self)


def compute_field(
    source: Source | MeshedInput,
    options: FieldOptions = FieldOptions(),
    progress: Progress | None = None,
    *,
    constraints: VertexConstraints | None = None,
    start: ArrayLike | None = None,
) -> FieldResult:
    """Frame field inside a closed surface or on a tet mesh (paths or meshes in memory).

    constraints: the user's own, on vertices (or, with sampling "tets", tets) of the mesh the field is computed on. Meshing and splitting make
    another mesh of the input, so prepare it first:

        >>> import octafield
        >>> from octafield.study.generators import generate
        >>> meshed = octafield.prepare_mesh(generate("ball"), octafield.MeshOptions(edge_length=0.3))  # or a path
        >>> held = octafield.VertexConstraints(vertices=[300], kinds=[1], axes=[[0, 0, 1]])  # of meshed.tets
        >>> result = octafield.compute_field(meshed, constraints=held)
        >>> result.record["constraints"]["given"]
        1

    start: (n, 4) frames to smooth from, on that mesh's vertices (sampling "tets": tets), such as octafield.read_frames gives; they are
    polished by one smoothing, without the heat flow that a field begins with otherwise.

    progress(phase, fraction, merit): False cancels. Raises InvalidInput, GeometryError, IoError, SolverError, Cancelled.
    """
    if start is not None and not isinstance(source, (MeshedInput, TetMesh)):
        raise InvalidInput("a start belongs to a tet mesh; give that, or the result of prepare_mesh(source, options)", "not_meshed")
    if constraints is not None and not isinstance(source, MeshedInput):
        raise InvalidInput(
            "constraints belong to the tet mesh the field is computed on; "
            "give the result of prepare_mesh(source, options) instead of the source",
            "not_meshed",
        )
    meshed = source if isinstance(source, MeshedInput) else prepare_mesh(source, options, progress=progress)
    return run(prepare(meshed, options.seed, progress), options, progress, constraints=constraints, start=start)


def prepare(meshed: MeshedInput, seed: int = 0, progress: Progress | None = None) -> Problem:
    """Computes the cross field on the surface, the start of every boundary frame. Raises GeometryError, SolverError.

        >>> import octafield
        >>> from octafield.study.generators import generate
        >>> octafield.prepare(octafield.prepare_mesh(generate("box"), octafield.MeshOptions(edge_length=0.3))).seed
        0
    """
    memory = PeakMemory()
    clock = PhaseClock(meshed.clock)
    with clock.phase("surface"):
        announce(progress, "surface")
        field = _core.direction_field(
            meshed.surface, meshed.features, seed=seed, progress=forward(progress, "surface", 0.0, 0.9)
        )
        directions, singularities, separatrices = structure(meshed, field, progress)
    peak = max(meshed.peak_mb, memory.megabytes())
    return Problem(meshed, seed, field, directions, singularities, separatrices, clock, peak)


def run(
    problem: Problem,
    options: FieldOptions = FieldOptions(),
    progress: Progress | None = None,
    *,
    constraints: VertexConstraints | None = None,
    start: ArrayLike | None = None,
) -> FieldResult:
    """One frame field on a prepared problem. The record's phase times include those of the shared preparation.
    constraints, start: see compute_field.

        >>> import octafield
        >>> from octafield.study.generators import generate
        >>> problem = octafield.prepare(octafield.prepare_mesh(generate("box"), octafield.MeshOptions(edge_length=0.3)))
        >>> for boundary in ("fixed", "aligned"):  # on one mesh, so that energies compare
        ...     print(boundary, octafield.run(problem, octafield.FieldOptions(boundary=boundary)).record["singular_edges"])
        fixed 0
        aligned 0
    """
    memory = PeakMemory()
    meshed, clock = problem.meshed, PhaseClock(problem.clock)
    tets, threads = meshed.volume().tets, options.threads
    with clock.phase("smooth"):
        announce(progress, "smooth")
        in_tets = _core.tet_sampling(tets) if options.sampling == "tets" else None
        held = _boundary_constraints(problem, options)
        if options.boundary == OF_A_START:
            held = held_at_start(tets, options, held, start)
        if constraints is not None:
            held = _core.with_constraints(held, constraints)
        where = tets if in_tets is None else in_tets
        smoothed, diffusion_steps = smoothed_field(tets, options, where, held, start, problem.seed, progress)
    with clock.phase("analyse"):
        announce(progress, "analyse")
        frames, of_tets = np.asarray(smoothed.frames), None
        analysis: FieldAnalysis | TetFieldAnalysis
        if in_tets is not None:
            of_tets = frames
            analysis = analyse_tets(meshed, in_tets, of_tets, threads)
            frames = analysis.frames
        else:
            analysis = analyse(meshed, frames, threads, options.streamlines)
        at_vertices = analysis if isinstance(analysis, FieldAnalysis) else None
        lengths = np.asarray(smoothed.lengths) if len(smoothed.lengths) else None
    sizes, sizes_entry = sizes_of_run(tets, frames, options, clock, progress)
    record = {
        **common_record(meshed, clock, max(problem.peak_mb, memory.megabytes())),
        "vertices": len(tets.vertices),
        "tets": len(tets.tets),
        "boundary_triangles": len(meshed.surface.triangles) - meshed.interface_triangles,
        "regions": 1 if meshed.regions is None else len(np.unique(meshed.regions)),
        "interface_triangles": meshed.interface_triangles,
        "locking": meshed.locking,
        "sampling": options.sampling,
        "representation": options.representation,
        "solver": options.solver,
        "boundary": options.boundary,
        "seed": problem.seed,
        "threads": threads,
        **analysis.record,
        **({} if lengths is None else {"lengths": spread(lengths)}),
        **sizes_entry,
        "objective": float(smoothed.objective),
        "iterations": smoothed.iterations,
        "diffusion_steps": diffusion_steps,
        "start": "default" if start is None else "given",
        "converged": bool(smoothed.converged),
        "stop_reason": smoothed.message,
        "energy_history": [float(e) for e in smoothed.energy_history],
        "surface_field": {
            "singular_points": counts_by_index(problem.singularities),
            "epsilon": problem.direction_field.epsilon,
            "iterations": problem.direction_field.iterations,
            "converged": bool(problem.direction_field.converged),
            **index_summary(problem.singularities),
        },
        "constraints": constraint_counts(held, constraints),
        "released_corners": len(held.released_corners),
        "released_corner_vertices": np.asarray(held.released_corners).tolist(),
        "options": asdict(replace(options, seed=problem.seed)),
    }
    return FieldResult(
        meshed.surface,
        meshed.features,
        problem.direction_field,
        problem.directions,
        problem.singularities,
        problem.separatrices,
        tets,
        held,
        frames,
        analysis.singular_graph if isinstance(analysis, FieldAnalysis) else analysis.singular.graph,
        analysis.alignment,
        analysis.feature_alignment,
        None if at_vertices is None else at_vertices.meshability,
        None if at_vertices is None else at_vertices.boundary_meshability,
        None if at_vertices is None else at_vertices.integrability,
        [] if at_vertices is None else at_vertices.streamlines,
        record,
        meshed.regions,
        of_tets,
        lengths,
        sizes,
    )


def _boundary_constraints(problem: Problem, options: FieldOptions) -> BoundaryConstraints:
    meshed = problem.meshed
    tets, boundary, features = meshed.volume()
    mode, tolerance = "none" if options.boundary == OF_A_START else options.boundary, options.feature_tolerance
    if options.sampling == "tets":  # triangles of the surface are those of the boundary, sheets or not
        directions = _core.triangle_directions(meshed.surface, problem.direction_field)
        return _core.tet_boundary_constraints(tets, boundary, directions, mode=mode, feature_tolerance=tolerance)
    directions = meshed.at_boundary_vertices(problem.directions)
    return _core.boundary_constraints(
        len(tets.vertices), boundary, features, directions, mode=mode, feature_tolerance=tolerance
    )
