"""Records of remeshed surfaces."""

from typing import Any

from pydantic import Field

from .measured import MeasuredRecord
from .parts import BothWays, KeptFeatures, QualityFigures


class RemeshRecord(MeasuredRecord):
    """`octafield remesh`: what --json writes, and `RemeshedSurface.record`."""

    input_vertices: int = Field(description="of the surface, after repair")
    input_triangles: int = Field(description="of the surface, after repair")
    feature_source: str = Field(description="file, angle or none: where features come from")
    target_vertices: int | None = Field(default=None, description="number of vertices wanted")
    target_length: float | None = Field(default=None, description="edge length wanted, input unit")
    vertices: int = Field(description="of the mesh")
    triangles: int = Field(description="of the mesh")
    mean_edge: float = Field(description="of the mesh, input unit")
    quality: QualityFigures = Field(description="of the triangles")
    poor: int = Field(description="triangles below the quality asked for")
    forced: int = Field(description="of these, in corners of the input between two feature edges")
    smallest_angle: float = Field(description="of all triangles, degrees")
    deviation: BothWays = Field(description="between mesh and input")
    off_surface: float = Field(
        description="the largest distance of a vertex from the input, over its diagonal: rounding"
    )
    features: KeptFeatures = Field(description="what became of them")
    watertight: bool = Field(description="no open edges, and each edge is of two triangles")
    open_edges: int = Field(description="of one triangle")
    kept: bool = Field(description="no sound mesh was found, and the triangles are those of the input")
    seconds: float = Field(description="by the clock, of all phases")
    options: dict[str, Any] = Field(description="`octafield.RemeshingOptions(**record.options)` makes them again")
    mesh_options: dict[str, Any] = Field(description="`octafield.MeshOptions(**record.mesh_options)` makes them again")
    output: str | None = Field(default=None, description="the file that was written")
