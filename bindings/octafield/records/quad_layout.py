"""Records of quad layouts and their quads."""

from typing import Any

from pydantic import Field

from .measured import QuadRecord
from .parts import ImposedPointFigures, JacobianFigures, Misalignment


class QuadLayoutRecord(QuadRecord):
    """`octafield quad-layout`: result.json and `QuadLayoutResult.record`."""

    euler_characteristic: int = Field(description="of the surface, cut along its features where these are followed")
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
        description="at least this many there are for these faces between features and their irregular vertices"
    )
    coarsest_patches: int | None = Field(
        default=None,
        description="the fewest that whole numbers on the T-mesh were found to make, whatever the shapes of quads",
    )
    chords: int = Field(description="of the layout: rows of blocks")
    largest_mismatch: float | None = Field(
        default=None, description="of opposite sides of a patch in quad coordinates, over their mean length"
    )
    irregular_vertices: int = Field(description="of the mesh, inside, with other than 4 quads")
    irregular_boundary_vertices: int = Field(description="of the mesh, on the boundary, with other than 2 quads")
    angle_quality: JacobianFigures = Field(description="of the quads (octafield.surface.quad_angle_quality)")
    options: dict[str, Any] = Field(description="`octafield.QuadLayoutOptions(**record.options)` makes them again")
