"""Records of atlases."""

from typing import Any

from pydantic import Field

from .field import InputRecord
from .parts import ChartFigures, ConformityFigures


class AtlasRecord(InputRecord):
    """`octafield atlas`: result.json and `AtlasResult.record`."""

    vertices: int = Field(description="of the surface, with those added in coarse faces")
    triangles: int = Field(description="of the surface, with those added in coarse faces")
    added_triangles: int = Field(description="that bisection in coarse faces made, with the same geometry")
    faces: int = Field(description="connected parts between features")
    handles: int = Field(description="of all faces: sum of the genera")
    closed_faces: int = Field(description="faces without a boundary")
    charts: int = Field(description="how many")
    not_positive: int = Field(description="triangles that are flat or turned over in the plane, in exact arithmetic: 0")
    charts_below: int = Field(description="charts that miss the conformity asked for, or are uneven")
    conformity: ConformityFigures = Field(description="of all triangles")
    cut_edges: int = Field(description="where charts, or u and v in them, end, but for features and the boundary")
    cut_length: float = Field(description="of these edges, input unit")
    chart_list: list[ChartFigures] = Field(description="of each chart")
    options: dict[str, Any] = Field(description="`octafield.surface.AtlasOptions(**record.options)` makes them again")
    mesh_options: dict[str, Any] = Field(description="`octafield.MeshOptions(**record.mesh_options)` makes them again")
    files: list[str] | None = Field(default=None, description="names of what was written, within the folder")
