"""Records of all-hex meshes."""

from typing import Any

from pydantic import Field

from .measured import MeasuredRecord
from .parts import Deviation, EdgeLengths, FeatureDeviation, JacobianFigures, WholeNumberFigures


class HexMeshRecord(MeasuredRecord):
    """`octafield hex-mesh`: result.json and `HexMeshResult.record`. Figures of the hexahedra are found on the mesh's
    arrays and the input's, not by what made the mesh."""

    mesh_sha256: str = Field(description="of the arrays of the tets that the map is on, first 16 hexadecimal digits")
    tets: int = Field(description="that the map is on")
    stage: str = Field(description="reached: extracted")
    walls: str = Field(description="file or own: where those come from that bound the blocks")
    blocks: int = Field(description="boxes in the map's parameters that its walls bound")
    arcs: int = Field(description="where blocks meet, each with a whole number of edges")
    whole_numbers: WholeNumberFigures = Field(description="of edges on the arcs")
    target: int = Field(description="number of hexahedra wanted")
    hexahedra: int = Field(description="how many; there are no other cells")
    vertices: int = Field(description="of the hexahedra")
    irregular_edges: dict[str, int] = Field(
        description="inside, with other than 4 hexahedra: how many by the number of hexahedra"
    )
    scaled_jacobian: JacobianFigures = Field(description="of the hexahedra (octafield.volume.scaled_jacobians)")
    inverted_at_first: int = Field(description="with a scaled Jacobian of 0 or less where the map puts their vertices")
    inverted: int = Field(description="with a scaled Jacobian of 0 or less: 0")
    unproven: int = Field(
        description="whose Jacobian is not proven to be above 0 everywhere (octafield.volume.proven_positive)"
    )
    nonconforming_faces: int = Field(description="that do not match: 0")
    volume_error: float = Field(description="difference of the volumes of mesh and input, over the input's")
    boundary_deviation: Deviation = Field(
        description="between the boundaries of mesh and input, both ways, over the diagonal of the input's box"
    )
    feature_deviation: FeatureDeviation = Field(description="of the boundary's quads from features")
    edge_length: EdgeLengths = Field(description="of the edges of the hexahedra, input unit")
    seconds: float = Field(description="by the clock, of all phases")
    phase_peak_mb: dict[str, float] = Field(
        description="largest resident memory in each phase of the meshing, 1e6 bytes, libraries included"
    )
    options: dict[str, Any] = Field(description="`compute_hex_mesh(map, **record.options)` makes it again")
    files: list[str] | None = Field(default=None, description="names of what was written, within the folder")


class SeamlessMapRecord(MeasuredRecord):
    """`SeamlessMapResult.record`, seamless.json of `octafield hex-mesh`, and its result.json where it ends without
    hexahedra."""

    mesh_sha256: str = Field(description="of the arrays of the tets that the field is on, first 16 hexadecimal digits")
    tets: int = Field(description="that the map is on")
    field_tets: int = Field(description="that the field is on")
    added_vertices: int = Field(description="of the map's tets")
    stage: str = Field(
        description="reached: field, meshable (no tet is flat in every map), seamless (a map, with folds or edges that"
        " parameters wind round) or injective (without)"
    )
    stopped_by: str | None = Field(
        description="locked_tet, flipped_tet, winding_edge, or the kind of the error after the map; none: hexahedra"
        " were made"
    )
    stopped_at: list[list[float]] = Field(description="where: middles of such tets or edges, input unit, the first 100")
    singular_edges: int = Field(description="of the map's tets")
    turns: int = Field(
        0, description="places where a singular curve of the field goes on with another type, which no hex mesh has"
    )
    unzipped: int = Field(0, description="of these, how many the map does not have: both parts were led to the surface")
    unknowns: int = Field(description="numbers that were free")
    locked: int = Field(description="tets that are flat in every map with these singular curves and this surface")
    flipped_at_first: int = Field(description="tets turned over or flat in the map of least squares")
    flipped: int = Field(description="in the end")
    steps: int = Field(description="of Newton's method between the two")
    residual: float = Field(description="largest distance of a corner from where a transition takes it, parameters")
    angle_at_first_deg: float = Field(
        description="between axes and gradients of least squares, mean over axes, by volume: what the curl of the field"
        " leaves"
    )
    angle_deg: float = Field(description="the same in the end")
    non_meshable_vertices: int | None = Field(description="of the field before curves were shortened")
    non_meshable_junctions: int | None = Field(description="those where curves meet")
    seconds: float = Field(description="by the clock, of all phases")
    phase_peak_mb: dict[str, float] = Field(
        description="largest resident memory in each phase of the mapping, 1e6 bytes, libraries included"
    )
    options: dict[str, Any] = Field(description="of the map")
    field_options: dict[str, Any] = Field(description="of the field")
    files: list[str] | None = Field(default=None, description="names of what was written, within the folder")
