"""The record of a direction field on a surface."""

from typing import Any

from pydantic import Field

from .field import InputRecord
from .parts import ImposedFigures, NonOrthogonalFigures, SingularPoint


class SurfaceFieldRecord(InputRecord):
    """`octafield surface-field`: result.json and `SurfaceFieldResult.record`."""

    vertices: int = Field(description="of the surface")
    triangles: int = Field(description="of the surface")
    symmetry: int = Field(description="directions at a point, N")
    method: str = Field(description="as the option says; imposed where the singular points were given")
    seed: int = Field(description="of the random start")
    euler_characteristic: int = Field(description="of the surface")
    index_sum: float = Field(description="of the singular points, turns")
    singularities: list[SingularPoint] = Field(description="the singular points")
    energy: float = Field(description="what the method minimised")
    dirichlet_energy: float | None = Field(
        default=None, description="of the unit field, a number without unit; not of two lines"
    )
    energy_history: list[float] | None = Field(
        default=None, description="energy at the start and after each step; not of two lines"
    )
    epsilon: float = Field(description="of the Ginzburg-Landau energy, input unit; 0 for other methods")
    iterations: int = Field(description="of the solver")
    converged: bool = Field(description="whether the tolerance was met")
    stopped: bool = Field(description="by the caller's progress")
    residual: float | None = Field(default=None, description="of the last step, relative; not of two lines")
    constraints: int = Field(description="edges and vertices whose directions the caller gave")
    imposed: ImposedFigures | None = Field(default=None, description="where the singular points were given")
    non_orthogonal: NonOrthogonalFigures | None = Field(default=None, description="of two lines at any angle")
    options: dict[str, Any] = Field(
        description="`octafield.SurfaceFieldOptions(**record.options)` makes them again; of two lines"
        " `octafield.options.NonOrthogonalOptions`"
    )
    files: list[str] | None = Field(default=None, description="names of what was written, within the folder")
