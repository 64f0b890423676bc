"""Records of hex-dominant meshes."""

from typing import Any

from pydantic import Field

from .measured import MeasuredRecord
from .parts import (
    CellCounts,
    Deviation,
    EdgeLengths,
    FieldOfMesh,
    JacobianFigures,
    LatticeSteps,
    Quantiles,
)


class HexDominantRecord(MeasuredRecord):
    """`octafield hex-dominant`: result.json and `HexDominantResult.record`. Figures are found on the mesh's arrays and
    the input's, not by what made the mesh."""

    mesh_sha256: str = Field(description="of the arrays of the tets that the field is on, first 16 hexadecimal digits")
    tets: int = Field(description="of the mesh that the field is on")
    regions: int = Field(description="how many")
    field: FieldOfMesh = Field(description="that the cells follow")
    points: str = Field(default="periodic", description="where the vertices come from: periodic or frontal")
    vertices: int = Field(description="of the mesh that was made")
    cells: CellCounts = Field(description="of the mesh that was made")
    hex_volume_share: float = Field(description="volume of the hexahedra over that of all cells")
    hex_number_share: float = Field(description="number of the hexahedra over that of all cells")
    scaled_jacobian: dict[str, JacobianFigures] = Field(
        description="by kind of cell, where there are any (octafield.volume.scaled_jacobians)"
    )
    inverted: int = Field(description="cells with a scaled Jacobian of 0 or less: 0")
    unproven: int = Field(
        description="cells whose Jacobian is not proven to be above 0 everywhere (octafield.volume.proven_positive)"
    )
    nonconforming_faces: int = Field(description="that do not match: 0")
    volume_error: float = Field(description="difference of the volumes of mesh and input, over the input's")
    region_volume_error: float | None = Field(
        default=None, description="the largest of a region, over that region's, where there are several"
    )
    boundary_deviation: Deviation = Field(
        description="between the boundaries (and interfaces) of mesh and input, both ways, over the diagonal of the"
        " input's box"
    )
    edge_length: EdgeLengths = Field(description="of the edges of all cells, input unit")
    edge_to_size: Quantiles | None = Field(
        default=None, description="lengths of edges over the size wanted at their middles, where sizes are given"
    )
    steps: LatticeSteps = Field(description="what became of the cells of the lattice")
    phase_peak_mb: dict[str, float] = Field(
        description="largest resident memory in each phase of the meshing, 1e6 bytes, libraries included"
    )
    options: dict[str, Any] = Field(description="those of octafield.hexdom.options.HexMeshOptions, by name, and sizes")
    field_options: dict[str, Any] = Field(description="`octafield.FieldOptions(**record.field_options)` makes them")
    files: list[str] | None = Field(default=None, description="names of what was written, within the folder")
