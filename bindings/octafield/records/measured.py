"""What records of runs that make meshes have in common."""

from typing import Any, ClassVar

from pydantic import Field

from .base import Record
from .parts import Deviation, EdgeLengths, JacobianFigures, Machine


class MeasuredRecord(Record):
    """What the run took, and on what."""

    LAST: ClassVar = (
        "seconds",
        "wall_seconds",
        "cpu_seconds",
        "phase_peak_mb",
        "peak_mb",
        "notes",
        "versions",
        "machine",
        "options",
        "mesh_options",
        "field_options",
        "files",
        "output",
    )

    input: str = Field(description="path or name of the input")
    version: str = Field(description="of octafield")
    input_kind: str = Field(description="surface, tets or seamless map: what the input was")
    wall_seconds: dict[str, float] = Field(description="by the clock, per phase")
    cpu_seconds: dict[str, float] = Field(description="of the processor, all threads, per phase")
    peak_mb: float = Field(description="largest resident memory of all phases, 1e6 bytes, libraries included")
    notes: list[str] = Field(description="what was done to the input, and what it or the mesh is without")
    versions: dict[str, str] = Field(description="of octafield, Python, packages and platform")
    machine: Machine | None = Field(default=None, description="that it ran on")


class QuadRecord(MeasuredRecord):
    """Figures of the quads are found on the mesh's arrays and the input's, not by what made the mesh."""

    mesh_sha256: str = Field(description="of the arrays of the surface, first 16 hexadecimal digits")
    triangles: int = Field(description="of the surface that the field is on")
    field_triangles: int = Field(description="of the surface refined round singular points")
    feature_source: str = Field(description="file, angle or none: where features come from")
    feature_edges: int = Field(description="edges of the surface that bend")
    point_source: str = Field(description="computed, given, or the file: where the singular points come from")
    quads: int = Field(description="how many")
    vertices: int = Field(description="of the quads")
    inverted: int = Field(description="quads with a scaled Jacobian of 0 or less: 0")
    nonconforming_edges: int = Field(description="that do not match: 0")
    t_junctions: int = Field(description="vertices within edges of other quads: 0")
    scaled_jacobian: JacobianFigures = Field(description="of the quads (octafield.surface.scaled_jacobians)")
    edge_length: EdgeLengths = Field(description="of the edges of the quads, input unit")
    surface_deviation: Deviation = Field(
        description="between quads and input, both ways, over the diagonal of the input's box"
    )
    phase_peak_mb: dict[str, float] = Field(
        description="largest resident memory in each phase after reading, 1e6 bytes, libraries included"
    )
    field_options: dict[str, Any] = Field(
        description="`octafield.SurfaceFieldOptions(**record.field_options)` makes them again"
    )
    files: list[str] | None = Field(default=None, description="names of what was written, within the folder")
