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
