"""Records of quad meshes."""

from typing import Any

from pydantic import Field

from .measured import QuadRecord
from .parts import (
    FeatureDeviation,
    FieldAngles,
    ImposedPointFigures,
    KeptBoundary,
    MinMax,
    ParameterizationFigures,
    SizeRatios,
    WholeNumberFigures,
)


class QuadMeshRecord(QuadRecord):
    """`octafield quad-mesh`: result.json and `QuadMeshResult.record`."""

    field_singularities: list[ImposedPointFigures] = Field(
        description="of the field that the quads follow, of index other than 0, corners included"
    )
    target: int = Field(description="number of quads wanted")
    irregular_vertices: dict[str, int] = Field(
        description="inside, with other than 4 quads: how many by the number of quads"
    )
    irregular_boundary_vertices: dict[str, int] = Field(
        description="on the boundary, with other than 2 quads: how many by the number of quads"
    )
    angle: MinMax = Field(description="between edges of a quad in space, degrees")
    size_ratio: SizeRatios = Field(description="reached over wanted, of quads")
    field_angle: FieldAngles | None = Field(
        default=None, description="of edges of the quads, where a field was given: from its directions, degrees"
    )
    feature_deviation: FeatureDeviation = Field(description="of the quads from features")
    kept_boundary: KeptBoundary | None = Field(default=None, description="where it was to be kept segment by segment")
    whole_numbers: WholeNumberFigures = Field(description="that the quads come from")
    parameterization: ParameterizationFigures | None = Field(
        default=None, description="of parameterization.obj, where it was written"
    )
    seconds: float = Field(description="by the clock, of all phases")
    options: dict[str, Any] = Field(description="`octafield.QuadMeshOptions(**record.options)` makes them again")
