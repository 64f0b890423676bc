"""Records of frame fields in volumes: computed, analysed, read from files."""

from typing import Any, ClassVar

from pydantic import Field

from .base import Record
from .parts import (
    Angles,
    AxesFigures,
    HexDominantFigures,
    IntegrabilityFigures,
    LockingCounts,
    Machine,
    PhaseSeconds,
    Range,
    SizesFigures,
    SplitCounts,
    StreamlineCounts,
    SurfaceFieldSummary,
    Verdict,
)

# Names that a record may be without have None: figures of some kinds of runs, and what earlier versions did not write.


class InputRecord(Record):
    """What a field was computed on, with what, and what it took."""

    input: str = Field(description="path or name of the input")
    version: str = Field(description="of octafield")
    input_kind: str = Field(description="surface or tets: what the input was")
    mesh_sha256: str = Field(description="of the mesh's arrays, first 16 hexadecimal digits")
    edge_length: float = Field(description="mean of the surface's edges, input unit")
    feature_source: str = Field(description="file, angle or none: where features come from")
    feature_edges: int = Field(description="edges of the surface that the field follows")
    feature_corners: int = Field(description="where feature curves meet, end or turn")
    notes: list[str] = Field(description="what was done to the input, and what it was without")
    wall_seconds: PhaseSeconds = Field(description="by the clock")
    cpu_seconds: PhaseSeconds = Field(description="of the processor, all threads")
    peak_mb: float = Field(description="largest resident memory, 1e6 bytes, libraries included")
    versions: dict[str, str] = Field(description="of octafield, Python, packages and platform")
    machine: Machine | None = Field(default=None, description="that it ran on")


class VolumeRecord(InputRecord):
    """The tet mesh, and how the field was made."""

    vertices: int = Field(description="of the tet mesh")
    tets: int = Field(description="of the tet mesh")
    boundary_triangles: int = Field(description="of its boundary, interfaces between regions left out")
    regions: int = Field(description="how many")
    sampling: str | None = Field(default=None, description="vertices or tets: where the frames are")
    interface_triangles: int | None = Field(default=None, description="between regions")
    locking: LockingCounts | None = Field(default=None, description="what joins the surface to itself")
    representation: str | None = Field(
        default=None, description="or metric that was minimised; the name of a field that was read"
    )
    solver: str | None = Field(default=None, description="as the option says")
    boundary: str | None = Field(default=None, description="aligned, fixed, none or start")
    seed: int | None = Field(default=None, description="of every random start")
    threads: int = Field(description="as the option says; 0: all")


class FieldFigures(Record):
    """What the analysis of a field tells. Where frames are in the tets, singular edges are edges of the mesh, else
    triangles (edges of the dual mesh)."""

    energy: float = Field(description="Dirichlet energy in sh4, input unit; compare on one mesh only")
    energy_unit_speed: float = Field(
        description="3/20 of it: of an embedding where a frame turning by 1 radian moves by 1"
    )
    energy_at_vertices: float | None = Field(
        default=None, description="of frames in tets: energy of the field taken to the vertices"
    )
    singular_edges: int = Field(description="round which the frames turn")
    singular_length: float = Field(description="of the singular curves, input unit")
    singular_length_smoothed: float | None = Field(default=None, description="of the smoothed curves, input unit")
    singular_curves: int = Field(description="how many")
    singular_nodes: int = Field(description="where they meet")
    complex_edges: int = Field(description="singular edges whose rotation keeps no axis; no hex mesh has them")
    undecided_edges: int | None = Field(default=None, description="whose rotation is not told by the frames")
    tied_triangles: int | None = Field(
        default=None, description="of frames in tets: across which two matchings are equally near"
    )
    singular_edges_by_turns: dict[str, int] = Field(description='by quarter turns: `{"+1": 40, "-1": 8, "complex": 2}`')
    non_meshable_vertices: int | None = Field(
        default=None, description="places of the singular graph that no hex mesh has"
    )
    non_meshable_junctions: int | None = Field(default=None, description="those where curves meet")
    non_meshable_curves: int | None = Field(default=None, description="those along curves")
    singular_closed_curves: int | None = Field(default=None, description="without ends")
    singular_boundary_ends: int | None = Field(default=None, description="on the surface")
    singular_boundary_ends_about_normal: int | None = Field(default=None, description="those whose axis is the normal")
    singular_vertex_types: dict[str, int] | None = Field(
        default=None, description='valences that meet: `{"3 3 5 5": 1}`'
    )
    singular_axis_deg: Angles | None = Field(
        default=None, description="between curves and their axes at ends on the surface"
    )
    hexahedra_at_features: dict[str, int] | None = Field(
        default=None, description="feature edges by their number of hexahedra"
    )
    non_meshable_feature_edges: int | None = Field(default=None, description="at which the field leaves no hexahedron")
    non_meshable_feature_edge_vertices: list[list[int]] | None = Field(
        default=None, description="(k, 2) their ends, of the tet mesh, 0-based"
    )
    non_meshable_corners: int | None = Field(default=None, description="that no hex mesh has")
    non_meshable_corner_vertices: list[int] | None = Field(default=None, description="of the tet mesh, 0-based")
    surface_crossings: int | None = Field(default=None, description="edges of the surface that singular edges cross")
    non_meshable_crossings: int | None = Field(default=None, description="those that no hex mesh has")
    alignment_deg: Angles = Field(description="between normal and nearest axis, per boundary vertex and smooth sector")
    unserved_vertices: int | None = Field(default=None, description="where faces meet whose normals no frame serves")
    feature_alignment_deg: Angles = Field(description="between feature curves and nearest axis")
    integrability: IntegrabilityFigures | None = Field(
        default=None, description="of frames at vertices, axes at right angles"
    )
    streamlines: StreamlineCounts | None = Field(default=None, description="of frames at vertices")


class FieldRecord(FieldFigures, VolumeRecord):  # pydantic puts the names of the last base first
    """`octafield field`, `compare`, `analyse`: result.json, results.json and `FieldResult.record`."""

    axes: AxesFigures | None = Field(default=None, description="where they may be at any angle")
    sizes: SizesFigures | None = Field(default=None, description="where the option asks for them")
    verdict: Verdict | None = Field(default=None, description="what the field is worth")
    lengths: Range | None = Field(default=None, description="of the axes, with representation odeco_lengths")
    split_singular: SplitCounts | None = Field(default=None, description="where the option asks for it")
    objective: float | None = Field(default=None, description="what the method minimised, of its last field")
    iterations: int | None = Field(default=None, description="diffusion steps and iterations of smoothing")
    diffusion_steps: int | None = Field(default=None, description="of the heat flow the field began with")
    start: str | None = Field(
        default=None, description="default, given, the file or the name of the field it was smoothed from"
    )
    converged: bool | None = Field(default=None, description="whether the tolerance was met")
    stop_reason: str | None = Field(default=None, description="in words")
    energy_history: list[float] | None = Field(default=None, description="energy at the start and after each step")
    objective_history: list[float] | None = Field(
        default=None, description="objective at the start and after each step"
    )
    surface_field: SurfaceFieldSummary | None = Field(default=None, description="the cross field on the surface")
    constraints: dict[str, int] | None = Field(
        default=None, description="sites by kind of constraint; given: the caller's own"
    )
    released_corners: int | None = Field(default=None, description="vertices whose normals no frame serves, not held")
    released_corner_vertices: list[int] | None = Field(default=None, description="of the tet mesh, 0-based")
    options: dict[str, Any] = Field(description="`octafield.FieldOptions(**record.options)` makes them again")
    field: str | None = Field(default=None, description="the file of frames that was analysed")
    field_format: str | None = Field(default=None, description="its kind")
    deviation_deg: float | None = Field(default=None, description="largest turn that made its axes orthonormal")
    label: str | None = Field(default=None, description="of the run in its comparison")
    energies: dict[str, float] | None = Field(default=None, description="of the user's own, by name")
    mesh: HexDominantFigures | None = Field(
        default=None, description="along the field, where a comparison or study asks for meshes"
    )
    files: list[str] | None = Field(default=None, description="names of what was written, within the folder")
    folder: str | None = Field(default=None, description="of the run, within its comparison")

    @property
    def computed(self) -> bool:
        """Not read from a file."""
        return self.energy_history is not None


class GivenFieldRecord(FieldRecord):
    """A field of a file, beside those that `octafield compare` computes."""

    LAST: ClassVar = ("label", "representation", "files", "folder", "boundary")


class RunWithField(FieldRecord):
    """A run of a study that is done."""

    FIRST: ClassVar = ("options",)

    began: float | None = Field(default=None, description="seconds since 1970, UTC")
    ended: float | None = Field(default=None, description="seconds since 1970, UTC")
    host: str | None = Field(default=None, description="name of the machine")
    key: str = Field(description="of the run: what its result depends on, hashed")
    repeat: int = Field(default=0, description="equal runs, for timings: 0, 1, ...")
    state: str = Field(default="done", description="done")
    message: str = Field(default="", description="empty")


class RunWithoutField(Record):
    """A run of a study that failed or crashed."""

    options: dict[str, Any] = Field(description="`octafield.FieldOptions(**record.options)` makes them again")
    error: str | None = Field(default=None, description="class of the error")
    error_kind: str | None = Field(default=None, description="its kind, a word")
    began: float | None = Field(default=None, description="seconds since 1970, UTC")
    ended: float | None = Field(default=None, description="seconds since 1970, UTC")
    host: str | None = Field(default=None, description="name of the machine")
    key: str = Field(description="of the run")
    input: str = Field(description="path or name of the input")
    repeat: int = Field(default=0, description="equal runs, for timings: 0, 1, ...")
    state: str = Field(description="failed: the input, an option or the limit; crashed: the process died")
    message: str = Field(default="", description="what went wrong")
