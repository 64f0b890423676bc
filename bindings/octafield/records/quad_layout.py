"""Records of quad layouts and their quads."""

from typing import Any

from pydantic import Field

from .base import Record
from .parts import Deviation, EdgeLengths, ImposedPointFigures, JacobianFigures, Machine, Misalignment


class QuadLayoutRecord(Record):
    """`octafield quad-layout`: result.json and `QuadLayoutResult.record`. Figures of the quads are found on the mesh's
    arrays and the input's, not by what made the mesh."""

    input: str = Field(description="path or name of the input")
    version: str = Field(description="of octafield")
    input_kind: str = Field(description="surface or tets: what the input was")
    mesh_sha256: str = Field(description="of the arrays of the surface, first 16 hexadecimal digits")
    triangles: int = Field(description="of the surface that the points were imposed on")
    field_triangles: int = Field(description="of the surface refined round them")
    euler_characteristic: int = Field(description="of the surface, cut along its features where these are followed")
    feature_source: str = Field(description="file, angle or none: where features come from")
    feature_edges: int = Field(description="edges of the surface that bend")
    point_source: str = Field(description="computed, given, or the file: where the singular points come from")
    corner_source: str = Field(description="angle, computed, given, or the file: where the quads at corners come from")
    singular_points: list[ImposedPointFigures] = Field(description="of index other than 0, corners included")
    index_sum: float = Field(description="of those found in the field, turns: the Euler characteristic")
    misalignment: list[Misalignment] = Field(description="per further condition on the places of the points")
    inadmissible: str = Field(description="fail, move or rotate: what was to be done where one is missed")
    largest_move: float = Field(description="of a point, input unit, where they were moved")
    t_joints: int | None = Field(
        default=None, description="of the T-mesh that the quads come from; the quads have none"
    )
    whole_numbers_optimal: bool | None = Field(
        default=None, description="whether no other whole numbers on the arcs of the T-mesh deviate less"
    )
    separatrices: int | None = Field(default=None, description="traced, before any were joined")
    patches: int = Field(description="of the layout, each a block of quads")
    fewest_patches: int = Field(
        description="at least this many there are for these irregular vertices: a quarter of the quads' corners there"
    )
    chords: int = Field(description="of the layout: rows of blocks")
    largest_mismatch: float | None = Field(
        default=None, description="of opposite sides of a patch in quad coordinates, over their mean length"
    )
    vertices: int = Field(description="of the mesh of quads")
    quads: int = Field(description="how many")
    irregular_vertices: int = Field(description="of the mesh, inside, with other than 4 quads")
    irregular_boundary_vertices: int = Field(description="of the mesh, on the boundary, with other than 2 quads")
    t_junctions: int = Field(description="vertices within edges of other quads: 0")
    inverted: int = Field(description="quads with a scaled Jacobian of 0 or less: 0")
    nonconforming_edges: int = Field(description="that do not match: 0")
    scaled_jacobian: JacobianFigures = Field(description="of the quads (octafield.surface.scaled_jacobians)")
    angle_quality: JacobianFigures = Field(description="of the quads (octafield.surface.quad_angle_quality)")
    edge_length: EdgeLengths = Field(description="of the edges of the quads, input unit")
    surface_deviation: Deviation = Field(
        description="between quads and input, both ways, over the diagonal of the input's box"
    )
    wall_seconds: dict[str, float] = Field(description="by the clock, per phase")
    cpu_seconds: dict[str, float] = Field(description="of the processor, all threads, per phase")
    phase_peak_mb: dict[str, float] = Field(
        description="largest resident memory in each phase after reading, 1e6 bytes, libraries included"
    )
    peak_mb: float = Field(description="the largest of all phases")
    notes: list[str] = Field(description="what was done to the input, and what it was without")
    versions: dict[str, str] = Field(description="of octafield, Python, packages and platform")
    machine: Machine | None = Field(default=None, description="that it ran on")
    options: dict[str, Any] = Field(description="`octafield.QuadLayoutOptions(**record.options)` makes them again")
    field_options: dict[str, Any] = Field(
        description="`octafield.SurfaceFieldOptions(**record.field_options)` makes them again"
    )
    files: list[str] | None = Field(default=None, description="names of what was written, within the folder")
