"""Objects within records."""

from pydantic import Field

from .base import Record


class Machine(Record):
    """What times depend on."""

    cpu: str = Field(description="model of the processor")
    cores: int = Field(description="that the process may use")
    load: float = Field(description="processes that ran or waited, mean over the last minute, this one included")


class PhaseSeconds(Record):
    """Seconds per phase; what runs share counts for each of them."""

    read: float = Field(default=0.0, description="reading, repairing and checking the input")
    mesh: float = Field(default=0.0, description="remeshing the surface and filling it")
    surface: float = Field(default=0.0, description="direction field on the surface and its curves")
    smooth: float = Field(default=0.0, description="constraints, start and smoothing")
    analyse: float = Field(default=0.0, description="singular graph, meshability, alignment, streamlines")
    write: float = Field(default=0.0, description="the files")
    sizes: float | None = Field(default=None, description="sizes along the axes, where they are asked for")


class Angles(Record):
    """Degrees; 0 where there are none."""

    median: float = Field(description="half of them are smaller")
    max: float = Field(description="the largest")
    held_max: float | None = Field(default=None, description="the largest where one frame can serve all faces")


class Range(Record):
    """Of positive numbers."""

    min: float = Field(description="the smallest")
    median: float = Field(description="half of them are smaller")
    max: float = Field(description="the largest")


class IntegrabilityFigures(Record):
    """How far the axes are from the gradients of a map (octafield.volume.integrability)."""

    jump_rms: float = Field(description="jump of the axes along the face between two tets, root mean square")
    jump_max: float | None = Field(default=None, description="the largest")
    twist_rms: float | None = Field(
        default=None, description="n . curl n of the axes n, 1 over the input's unit, root mean square"
    )
    twist_max: float | None = Field(default=None, description="the largest")


class StreamlineCounts(Record):
    """Of curves along the axes from evenly spread seeds."""

    curves: int = Field(description="how many")
    length: float = Field(description="of all, input unit")
    ends: dict[str, int] = Field(description="how many ends of each kind (octafield.volume.FrameStreamline)")


class WedgeFigures(Record):
    """Feature edges whose interior angles are nearest to one multiple of 15 degrees."""

    angle_deg: int = Field(description="the multiple")
    edges: int = Field(description="how many")
    off_faces_deg: Angles = Field(
        description="per edge, from the normals of its two faces to the nearest normals of two axes, at both ends"
    )
    off_edges_deg: Angles = Field(description="per edge, from its direction to the nearest axis")


class AxesFigures(Record):
    """Of axes that may be at any angle (option axes)."""

    oblique_share: float = Field(description="of the vertices: two axes are off a right angle by more than a degree")
    largest_obliqueness_deg: float = Field(description="by which two axes of a vertex are off a right angle")
    lengths: Range = Field(description="of the axes S Q; their mean is about 1")
    followed_vertices: int | None = Field(
        default=None, description="on feature edges and corners that give the axes; 0 where nothing is stretched"
    )
    sharp_vertices: int | None = Field(default=None, description="of these, off right angles by more than 10 degrees")
    needle_vertices: int | None = Field(default=None, description="with an angle below a degree, not followed")
    wedges: list[WedgeFigures] = Field(description="feature edges by their angle")


class LockingCounts(Record):
    """Inside of the mesh and with all vertices on its surface."""

    tets: int = Field(description="such tets")
    edges: int = Field(description="such edges")
    triangles: int = Field(description="such triangles")
    added_vertices: int | None = Field(default=None, description="by splitting, where it was asked for")
    added_tets: int | None = Field(default=None, description="by splitting")
    left: int | None = Field(default=None, description="tets left as they were: too flat to split")


class SplitCounts(Record):
    """Of edges between singular vertices (option split_singular)."""

    edges: int = Field(description="split")
    left: int = Field(description="left as they were: their tets are too flat")
    added_vertices: int = Field(description="by splitting")
    added_tets: int = Field(description="by splitting")


class SurfaceFieldSummary(Record):
    """The direction field on the surface from which boundary frames start."""

    singular_points: dict[str, int] | None = Field(
        default=None, description='how many by index, in turns: `{"+1/4": 8}`'
    )
    epsilon: float | None = Field(
        default=None, description="of the Ginzburg-Landau energy, input unit; 0 for other methods"
    )
    iterations: int | None = Field(default=None, description="of its solver")
    converged: bool | None = Field(default=None, description="whether these met its tolerance")
    euler_characteristic: int = Field(description="of the surface")
    index_sum: float | None = Field(default=None, description="of the singular points, turns")


class SizesFigures(Record):
    """Sizes along the axes that bring the field closest to the gradients of a map (option sizes)."""

    kind: str = Field(description="isotropic: one size for all axes; axes: one per axis")
    curl_rms_before: float = Field(description="curl of the unit axes, 1 over the input's unit, root mean square")
    curl_rms_after: float = Field(description="of the axes with their sizes, over these")
    jump_rms_before: float = Field(description="jump of the unit axes between tets, root mean square")
    jump_rms_after: float = Field(description="with the sizes, over these")
    size_ratio: float = Field(description="the largest size over the smallest")
    iterations: int = Field(description="of the linear solver")


class Verdict(Record):
    """What a field is worth."""

    state: str = Field(description="fine, coarse, not meshable or no field")
    sentences: list[str] = Field(description="why")
    vertices: list[int] = Field(description="of the tet mesh, 0-based: the first hundred of the places that are coarse")
    suggested_edge_length: float | None = Field(description="input unit, not tried; null: no advice")


class SingularPoint(Record):
    """Of a direction field on a surface."""

    position: list[float] = Field(description="(3,), input unit")
    index: float = Field(description="turns")
    boundary: bool = Field(description="on the boundary of the surface")


class ImposedPointFigures(Record):
    """A singular point of a cross field, as it was imposed."""

    position: list[float] = Field(description="(3,), input unit")
    index_times_four: int = Field(description="t: the valence inside is 4 - t; 2 - t quads on the boundary")
    boundary: bool = Field(description="on the boundary of the surface")


class Misalignment(Record):
    """Of a field from a condition on the places of its singular points."""

    boundary: bool = Field(description="a boundary curve is followed; else, the field comes back to itself")
    vertex: int = Field(description="the lowest of the boundary curve, or one beside the generator, of the surface")
    angle_deg: float = Field(description="by which the pattern that was imposed misses it, degrees")
    size_factor: float = Field(description="1 or more: by what sizes disagree after a turn, where it was rotated away")


class ImposedFigures(Record):
    """How the singular points of a cross field were imposed."""

    point_source: str = Field(description="given, or the file: where the singular points come from")
    corner_source: str = Field(description="angle, given, or the file: where the quads at corners come from")
    points: list[ImposedPointFigures] = Field(description="of index other than 0, corners included")
    misalignment: list[Misalignment] = Field(description="per further condition on the places of the points")
    inadmissible: str = Field(description="fail, move or rotate: what was to be done where one is missed")
    largest_move: float = Field(description="of a point, input unit, where they were moved")
    closure: float = Field(description="largest angle by which edges disagree with their triangles, radians: rounding")
    input_triangles: int = Field(description="of the surface before it was refined round the points")


class NonOrthogonalFigures(Record):
    """Of a field of two lines at any angle on a surface."""

    smallest_angle_deg: float = Field(description="between the two lines of a vertex")
    oblique_share: float = Field(description="of the vertices, where that is below 89 degrees")
    start_energy: float = Field(description="of the linear start")
    corners: dict[str, int] = Field(description="vertices of the boundary by number of quads, those of 2 left out")
    corner_source: str = Field(description="angle, given, or the file: where these numbers come from")
    agree: bool = Field(description="the indices inside and at corners add up to the Euler characteristic")
    inverted: int = Field(description="vertices of the boundary where a line has passed through its direction")
    freedom: float = Field(description="of free lines on the boundary, what is left of their range; 0: fixed")
    cut_edges: int = Field(description="feature edges inside, along which the surface was cut")
    input_vertices: int = Field(description="of the surface before it was cut")


class CellCounts(Record):
    """Cells of a mesh by kind."""

    tets: int = Field(description="how many")
    hexahedra: int = Field(description="how many")
    wedges: int = Field(description="how many")
    pyramids: int = Field(description="how many")


class _Lowest(Record):
    min: float = Field(description="the smallest")
    p05: float = Field(description="5 % are smaller")
    mean: float = Field(description="of all")


class JacobianFigures(_Lowest):
    """Least scaled Jacobians of the cells of a kind: 1 for the best shape, 0 and less where a corner is inverted."""


class QualityFigures(_Lowest):
    """Of twice the inscribed over the circumscribed radius of triangles, in [0, 1]."""


class BothWays(Record):
    """Distances between two surfaces, over the diagonal of the input's box."""

    of_input: float = Field(description="the largest of a vertex of the input from the new triangles")
    of_mesh: float = Field(description="the largest of a middle of a new triangle, or of a side of one, from the input")


class KeptFeatures(Record):
    """Corners and curves between features. Distances are over the diagonal of the input's box."""

    corners: int = Field(description="of the input")
    missed_corners: int = Field(description="of these, no vertex of the mesh, to the last bit: 0")
    edges: int = Field(description="of the mesh along features")
    off_curves: float = Field(description="the largest distance of a vertex along features from the input's features")


class Deviation(Record):
    """Between two surfaces, the larger of both ways."""

    max: float = Field(description="the largest distance of a point to the other surface")
    rms: float = Field(description="root mean square by area")


class ConformityFigures(Record):
    """Of maps to the plane: the smaller over the larger stretch of a triangle."""

    min: float = Field(description="the least")
    p05: float = Field(description="5 % of the area have less")
    mean: float = Field(description="by area")


class ChartFigures(Record):
    """One chart of an atlas."""

    triangles: int = Field(description="how many")
    area: float = Field(description="on the surface, input unit squared")
    loops: int = Field(description="boundary curves; all but the outer one are holes")
    conformity: ConformityFigures = Field(description="of its triangles")
    evenness: float = Field(
        description="root of plane over surface area, over its mean, at least; 5 % of the area have less"
    )


class FeatureDeviation(Record):
    """Of quads from features and the boundary, over the diagonal of the surface's box."""

    corners: float = Field(
        description="the largest distance of a corner between features to the nearest vertex of the quads"
    )
    curves: float = Field(
        description="of a point of these to edges of quads with both ends on them: chords, where they are bent"
    )


class KeptBoundary(Record):
    """Segments of an outline."""

    segments: int = Field(description="of the outline, lines inside with them")
    kept: int = Field(description="that are an edge of a quad")
    split: int = Field(description="that were split at their middle")


class MinMax(Record):
    """Of numbers."""

    min: float = Field(description="the smallest")
    max: float = Field(description="the largest")


class SizeRatios(Record):
    """Of quads: the square root of the area over the edge length wanted there."""

    p10: float = Field(description="10 % are smaller")
    median: float = Field(description="half of them are smaller")
    p90: float = Field(description="90 % are smaller")


class FieldAngles(Record):
    """Of edges of quads: from the nearest of a given field's four directions at their middle, degrees."""

    median: float = Field(description="half of the edges are nearer")
    p90: float = Field(description="90 % are nearer")


class ParameterizationFigures(Record):
    """Of the surface's map to the integer grid."""

    triangles: int = Field(description="parts of the surface's")
    mean_distortion: float = Field(description="of (s + 1 / s) / 2 by area, s the ratio of the two stretches")
    largest_distortion: float = Field(description="of the same")
    largest_residual: float = Field(
        description="how far u, v over an edge are from a turn by quarters and a shift by whole numbers"
    )


class WholeNumberFigures(Record):
    """Of quads along the arcs of a T-mesh."""

    objective: float = Field(
        description="sum of |n - length / size|; by lengths, what is large beside the number wanted counts more"
    )
    bound: float = Field(description="what no other whole numbers are below")
    optimal: bool = Field(description="whether the two are the same")


class EdgeLengths(Record):
    """Input unit."""

    target: float = Field(description="wanted: the edge length, or the mean of the sizes by volume")
    median: float = Field(description="half of them are smaller")
    p05: float = Field(description="5 % are smaller")
    p95: float = Field(description="95 % are smaller")


class Quantiles(Record):
    """Of positive numbers."""

    median: float = Field(description="half of them are smaller")
    p05: float = Field(description="5 % are smaller")
    p95: float = Field(description="95 % are smaller")


class FieldOfMesh(Record):
    """The frame field that cells of a mesh follow."""

    source: str = Field(description="computed, given, or the file it was read from")
    representation: str | None = Field(default=None, description="or metric that was minimised")
    boundary: str | None = Field(default=None, description="aligned, fixed, none or start")
    energy: float = Field(description="Dirichlet energy in sh4, input unit")
    singular_edges: int = Field(description="round which the frames turn")
    complex_edges: int = Field(description="of these, those whose rotation keeps no axis")
    non_meshable_vertices: int | None = Field(
        default=None, description="places of the singular graph that no hex mesh has"
    )
    edge_length: float = Field(description="mean edge of the surface of the tets, input unit")


class HexDominantFigures(Record):
    """Of the hex-dominant mesh along a field; where none could be made `error`, and nothing that needs a mesh."""

    edge_length: float = Field(description="wanted of the cells, input unit; the same for all runs on an input")
    seconds: float = Field(description="by the clock, of making and judging it")
    error: str | None = Field(default=None, description="why there is no mesh")
    error_kind: str | None = Field(default=None, description="its kind, a word")
    cells: CellCounts | None = Field(default=None, description="of the mesh that was made")
    hex_volume_share: float | None = Field(default=None, description="volume of the hexahedra over that of all cells")
    hex_number_share: float | None = Field(default=None, description="number of the hexahedra over that of all cells")
    scaled_jacobian: dict[str, JacobianFigures] | None = Field(
        default=None, description="by kind of cell, where there are any"
    )
    inverted: int | None = Field(default=None, description="cells with a scaled Jacobian of 0 or less: 0")
    nonconforming_faces: int | None = Field(default=None, description="that do not match: 0")
    volume_error: float | None = Field(
        default=None, description="difference of the volumes of mesh and input, over the input's"
    )
    boundary_deviation: Deviation | None = Field(
        default=None, description="between the boundaries of mesh and input, over the diagonal of the input's box"
    )
    peak_mb: float | None = Field(default=None, description="largest resident memory while it was made, 1e6 bytes")


class LostLatticeCells(Record):
    """Cells of the lattice whose middle is in the map and that are no hexahedra, by the first reason."""

    outside: int = Field(description="a corner lies beyond the surface")
    unusable: int = Field(description="on the way to a corner are tets without coordinates")
    degenerate: int = Field(description="two corners are one point")
    poor: int = Field(description="a scaled Jacobian is below the least")


class PyramidCounts(Record):
    """How faces were made to match."""

    combined: int = Field(description="pyramids of two tets")
    raised: int = Field(description="pyramids with a new apex in the tets round a diagonal")
    split: int = Field(description="hexahedra and wedges given up")


class LatticeSteps(Record):
    """Cells at every step of octafield.volume.hex_dominant."""

    tets: int = Field(description="of the mesh that the periodic map is on")
    inconsistent: int = Field(description="of these, without coordinates: jumps of edges do not sum to 0")
    turned_over: int = Field(description="of these, coordinates turned over or flat")
    lost: LostLatticeCells = Field(description="cells of the lattice that are no hexahedra")
    lattice_hexahedra: int = Field(description="taken from the lattice")
    crossing: int = Field(description="of these, left out as their faces cross others or are not in the surface")
    recombined_hexahedra: int = Field(description="made of tets")
    recombined_wedges: int = Field(description="made of tets")
    pyramids: PyramidCounts = Field(description="where quads meet triangles")
