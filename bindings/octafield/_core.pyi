"""Types of the compiled module. Docstrings are in the module itself."""

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, ClassVar, Literal, TypeAlias, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csc_matrix

from .schemes import OwnScheme

Complex128s: TypeAlias = NDArray[np.complex128]
Float64s: TypeAlias = NDArray[np.float64]
Int32s: TypeAlias = NDArray[np.int32]
UInt8s: TypeAlias = NDArray[np.uint8]
Path: TypeAlias = str | PathLike[str]
Progress: TypeAlias = Callable[[str, float, float], bool | None]

__version__: str
__libraries__: str
unit_speed_factor: float
"""3/20: times an energy of sh4 vectors gives that of a representation that moves at speed 1 per radian."""
core_energy: float
"""Energy of the core of one simple zero, 1.1966: the constant term of the asymptotic energy, per point."""

# ---- frames

class Representation:
    @property
    def name(self) -> str: ...
    @property
    def dimension(self) -> int: ...
    @property
    def speed(self) -> float | None: ...
    @property
    def embed(self) -> Callable[..., Float64s]: ...
    @property
    def differential(self) -> Callable[..., Float64s]: ...
    @property
    def hessian(self) -> Callable[..., Float64s]: ...
    @property
    def project(self) -> Callable[..., tuple[Float64s, Any]]: ...
    @property
    def rotate(self) -> Callable[..., Float64s] | None: ...

class Metric:
    @property
    def name(self) -> str: ...
    @property
    def description(self) -> str: ...
    @property
    def speed(self) -> float | None: ...
    def distance(self, q1: ArrayLike, q2: ArrayLike, *, threads: int = 0) -> Any: ...

representations: dict[str, Representation]
"""Every representation of a frame by its name, in the order of tables."""
metrics: dict[str, Metric]
"""Every distance of frames by its name."""

def quaternion_exp(rotation_vectors: ArrayLike, *, threads: int = 0) -> Float64s: ...
def quaternion_log(q: ArrayLike, *, threads: int = 0) -> Float64s: ...
def rotation_matrices(q: ArrayLike, *, threads: int = 0) -> Float64s: ...
def random_rotations(n: int, seed: int = 0) -> Float64s: ...
def frame_from_axes(directions: ArrayLike, normals: ArrayLike, *, threads: int = 0) -> Float64s: ...
def octahedral_group() -> Float64s: ...
def binary_octahedral_group() -> Float64s: ...
def octahedral_product_table() -> Int32s: ...
def octahedral_inverse_table() -> Int32s: ...

# A number for two single quaternions, an array otherwise.
def distance(q1: ArrayLike, q2: ArrayLike, *, threads: int = 0) -> Any: ...
def matching(q1: ArrayLike, q2: ArrayLike, *, threads: int = 0) -> Any: ...
def closest_representative(q: ArrayLike, reference: ArrayLike, *, threads: int = 0) -> Float64s: ...
def frame_exp(q: ArrayLike, w: ArrayLike, *, threads: int = 0) -> Float64s: ...
def frame_log(q1: ArrayLike, q2: ArrayLike, *, threads: int = 0) -> Float64s: ...
def slerp(q1: ArrayLike, q2: ArrayLike, t: ArrayLike, *, threads: int = 0) -> Float64s: ...
def frame_mean(
    frames: ArrayLike, weights: ArrayLike | None = None, *, threads: int = 0
) -> tuple[Float64s, Any, Any]: ...
def harmonics_evaluate(degree: int, directions: ArrayLike, *, threads: int = 0) -> Float64s: ...
def harmonics_rotation(degree: int, g: ArrayLike, *, threads: int = 0) -> Float64s: ...
def harmonics_rotate(degree: int, g: ArrayLike, v: ArrayLike, *, threads: int = 0) -> Float64s: ...
def harmonics_generators(degree: int) -> Float64s: ...
def harmonics_octahedral(degree: int) -> Float64s: ...
def sh4_embed(q: ArrayLike, *, threads: int = 0) -> Float64s: ...
def sh4_differential(q: ArrayLike, *, threads: int = 0) -> Float64s: ...
def sh4_hessian(q: ArrayLike, v: ArrayLike, *, threads: int = 0) -> Float64s: ...
def sh4_project(v: ArrayLike, guess: ArrayLike | None = None, *, threads: int = 0) -> tuple[Float64s, Any]: ...
def sh4_rotate(g: ArrayLike, v: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_embed(q: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_differential(q: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_hessian(q: ArrayLike, v: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_project(v: ArrayLike, guess: ArrayLike | None = None, *, threads: int = 0) -> tuple[Float64s, Any]: ...
def tensor4_rotate(g: ArrayLike, v: ArrayLike, *, threads: int = 0) -> Float64s: ...
def su2_embed(q: ArrayLike, *, threads: int = 0) -> Float64s: ...
def su2_differential(q: ArrayLike, *, threads: int = 0) -> Float64s: ...
def su2_hessian(q: ArrayLike, v: ArrayLike, *, threads: int = 0) -> Float64s: ...
def su2_project(v: ArrayLike, guess: ArrayLike | None = None, *, threads: int = 0) -> tuple[Float64s, Any]: ...
@overload
def odeco_embed(q: ArrayLike, *, threads: int = 0) -> Float64s: ...
@overload
def odeco_embed(q: ArrayLike, lengths: ArrayLike, *, threads: int = 0) -> Float64s: ...
@overload
def odeco_differential(q: ArrayLike, *, threads: int = 0) -> Float64s: ...
@overload
def odeco_differential(q: ArrayLike, lengths: ArrayLike, *, threads: int = 0) -> Float64s: ...
def odeco_hessian(q: ArrayLike, v: ArrayLike, *, threads: int = 0) -> Float64s: ...
def odeco_project(v: ArrayLike, guess: ArrayLike | None = None, *, threads: int = 0) -> tuple[Float64s, Any]: ...
def odeco_rotate(g: ArrayLike, v: ArrayLike, *, threads: int = 0) -> Float64s: ...
@overload
def sh469_embed(q: ArrayLike, *, threads: int = 0) -> Float64s: ...
@overload
def sh469_embed(q: ArrayLike, weights: ArrayLike, *, threads: int = 0) -> Float64s: ...
@overload
def sh469_differential(q: ArrayLike, *, threads: int = 0) -> Float64s: ...
@overload
def sh469_differential(q: ArrayLike, weights: ArrayLike, *, threads: int = 0) -> Float64s: ...
@overload
def sh469_hessian(q: ArrayLike, v: ArrayLike, *, threads: int = 0) -> Float64s: ...
@overload
def sh469_hessian(q: ArrayLike, v: ArrayLike, weights: ArrayLike, *, threads: int = 0) -> Float64s: ...
@overload
def sh469_project(v: ArrayLike, guess: ArrayLike | None = None, *, threads: int = 0) -> tuple[Float64s, Any]: ...
@overload
def sh469_project(
    v: ArrayLike, guess: ArrayLike | None = None, *, weights: ArrayLike, threads: int = 0
) -> tuple[Float64s, Any]: ...
def sh469_rotate(g: ArrayLike, v: ArrayLike, *, threads: int = 0) -> Float64s: ...
def convert(v: ArrayLike, from_representation: str, to_representation: str, *, threads: int = 0) -> Float64s: ...
def sh4_project_certified(
    v: ArrayLike, gap_tolerance: float = 1e-09, *, threads: int = 0
) -> tuple[Float64s, Any, Any]: ...
def tensor4_full(v: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_from_full(a: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_monomials(v: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_from_monomials(coefficients: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_mandel(v: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_from_mandel(p: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_affine(v: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_from_affine(p: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_to_sh4(v: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_from_sh4(a: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_residual(a: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tensor4_recover(v: ArrayLike, *, threads: int = 0) -> Float64s: ...
def odeco_nearest(
    v: ArrayLike, guess: ArrayLike | None = None, *, threads: int = 0
) -> tuple[Float64s, Float64s, Any]: ...
def odeco_nearest_local(v: ArrayLike, start: ArrayLike, *, threads: int = 0) -> tuple[Float64s, Float64s, Any]: ...
def odeco_extract(v: ArrayLike, *, threads: int = 0) -> tuple[Float64s, Float64s, Any]: ...

# Points of C^3 are (n, 3) complex arrays.
def su2_complex(v: ArrayLike, *, threads: int = 0) -> Complex128s: ...
def su2_real(h: ArrayLike, *, threads: int = 0) -> Float64s: ...
def su2_jacobian(q: ArrayLike, *, threads: int = 0) -> Complex128s: ...
def su2_surface_residual(h: ArrayLike, *, threads: int = 0) -> Any: ...
def su2_squared_norm(h: ArrayLike, *, threads: int = 0) -> Any: ...
def su2_inverse(h: ArrayLike, tolerance: float = 1e-06, *, threads: int = 0) -> Float64s: ...
def su2_inverse_frame(h: ArrayLike, tolerance: float = 1e-06, *, threads: int = 0) -> Float64s: ...
def su2_axis_turn(n: ArrayLike, t: ArrayLike, *, threads: int = 0) -> Complex128s: ...
def su2_axis_ellipse(n: ArrayLike, *, threads: int = 0) -> Complex128s: ...
def su2_axis_linear_residual(n: ArrayLike, h: ArrayLike, *, threads: int = 0) -> Any: ...
def su2_axis_residual(n: ArrayLike, h: ArrayLike, *, threads: int = 0) -> Complex128s: ...
def su2_pulled_back(q: ArrayLike, *, threads: int = 0) -> Complex128s: ...
def su2_distance(h1: ArrayLike, h2: ArrayLike, *, threads: int = 0) -> Any: ...
def su2_log(h1: ArrayLike, h2: ArrayLike, *, threads: int = 0) -> Complex128s: ...
def su2_exp(h: ArrayLike, tangent: ArrayLike, *, threads: int = 0) -> Complex128s: ...
def su2_length(h: ArrayLike, tangent: ArrayLike, *, threads: int = 0) -> Any: ...
def su2_mean(points: ArrayLike, weights: ArrayLike | None = None) -> Complex128s: ...
def binary_group_elements(name: str) -> Float64s: ...
def binary_group_invariants(name: str, q: ArrayLike, *, threads: int = 0) -> Complex128s: ...
def binary_group_relation_residual(name: str, f: ArrayLike, *, threads: int = 0) -> Any: ...

# ---- surface

class TriangleMesh:
    def __init__(self, vertices: ArrayLike = ..., triangles: ArrayLike = ...) -> None: ...
    @property
    def vertices(self) -> Float64s: ...
    @vertices.setter
    def vertices(self, value: ArrayLike) -> None: ...
    @property
    def triangles(self) -> Int32s: ...
    @triangles.setter
    def triangles(self, value: ArrayLike) -> None: ...

class EdgeTopology:
    def __init__(
        self, edges: ArrayLike = ..., triangle_edges: ArrayLike = ..., edge_triangles: ArrayLike = ...
    ) -> None: ...
    @property
    def edges(self) -> Int32s: ...
    @edges.setter
    def edges(self, value: ArrayLike) -> None: ...
    @property
    def triangle_edges(self) -> Int32s: ...
    @triangle_edges.setter
    def triangle_edges(self, value: ArrayLike) -> None: ...
    @property
    def edge_triangles(self) -> Int32s: ...
    @edge_triangles.setter
    def edge_triangles(self, value: ArrayLike) -> None: ...

class FeatureGraph:
    def __init__(self, edges: ArrayLike = ..., corners: ArrayLike = ...) -> None: ...
    @property
    def edges(self) -> Int32s: ...
    @edges.setter
    def edges(self, value: ArrayLike) -> None: ...
    @property
    def corners(self) -> Int32s: ...
    @corners.setter
    def corners(self, value: ArrayLike) -> None: ...

class Defect:
    kind: str
    element: str
    message: str
    def __init__(self, kind: str = ..., element: str = ..., elements: ArrayLike = ..., message: str = ...) -> None: ...
    @property
    def elements(self) -> Int32s: ...
    @elements.setter
    def elements(self, value: ArrayLike) -> None: ...

class RepairResult:
    def __init__(self, mesh: TriangleMesh = ..., actions: Sequence[str] = ..., largest_move: float = ...) -> None: ...
    @property
    def mesh(self) -> TriangleMesh: ...
    @property
    def actions(self) -> list[str]: ...
    @property
    def largest_move(self) -> float: ...
    @largest_move.setter
    def largest_move(self, value: float) -> None: ...

class RepairAdvice:
    def __init__(
        self, level: str = ..., actions: Sequence[str] = ..., left: Sequence[Defect] = ..., not_tried: str = ...
    ) -> None: ...
    @property
    def level(self) -> str: ...
    @level.setter
    def level(self, value: str) -> None: ...
    @property
    def actions(self) -> list[str]: ...
    @property
    def left(self) -> list[Defect]: ...
    @property
    def not_tried(self) -> str: ...
    @not_tried.setter
    def not_tried(self, value: str) -> None: ...

class CloseRemeshOptions:
    vertices: float
    deviation: float
    quality: float
    max_vertices: float
    keep_stubs: bool
    iterations: int
    def __init__(
        self,
        vertices: float = ...,
        deviation: float = ...,
        quality: float = ...,
        max_vertices: float = ...,
        keep_stubs: bool = ...,
        iterations: int = ...,
    ) -> None: ...

class CloseRemeshResult:
    def __init__(
        self,
        mesh: TriangleMesh = ...,
        stubs: ArrayLike = ...,
        features: FeatureGraph = ...,
        notes: Sequence[str] = ...,
        deviation: float = ...,
        own_deviation: float = ...,
        off_surface: float = ...,
        poor: int = ...,
        forced: int = ...,
        kept: bool = ...,
    ) -> None: ...
    @property
    def mesh(self) -> TriangleMesh: ...
    @property
    def features(self) -> FeatureGraph: ...
    @property
    def notes(self) -> list[str]: ...
    stubs: Int32s
    deviation: float
    own_deviation: float
    off_surface: float
    poor: int
    forced: int
    kept: bool

class WinslowOptions:
    rounds: int
    tolerance: float
    def __init__(self, rounds: int = ..., tolerance: float = ...) -> None: ...

class WinslowResult:
    points: Float64s
    before: float
    after: float
    rounds: int
    moved: int
    def __init__(
        self, points: ArrayLike = ..., before: float = ..., after: float = ..., rounds: int = ..., moved: int = ...
    ) -> None: ...

class RemeshResult:
    def __init__(
        self,
        mesh: TriangleMesh = ...,
        features: FeatureGraph = ...,
        notes: Sequence[str] = ...,
        deviation: float = ...,
        inner_length: float = ...,
    ) -> None: ...
    @property
    def mesh(self) -> TriangleMesh: ...
    @property
    def features(self) -> FeatureGraph: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def deviation(self) -> float: ...
    @deviation.setter
    def deviation(self, value: float) -> None: ...
    @property
    def inner_length(self) -> float: ...
    @inner_length.setter
    def inner_length(self, value: float) -> None: ...

class SizeField:
    def __init__(
        self,
        lengths: ArrayLike = ...,
        shortest: float = ...,
        longest: float = ...,
        triangles: float = ...,
        tets: float = ...,
        scale: float = ...,
        notes: Sequence[str] = ...,
    ) -> None: ...
    @property
    def lengths(self) -> Float64s: ...
    @lengths.setter
    def lengths(self, value: ArrayLike) -> None: ...
    @property
    def shortest(self) -> float: ...
    @shortest.setter
    def shortest(self, value: float) -> None: ...
    @property
    def longest(self) -> float: ...
    @longest.setter
    def longest(self, value: float) -> None: ...
    @property
    def triangles(self) -> float: ...
    @triangles.setter
    def triangles(self, value: float) -> None: ...
    @property
    def tets(self) -> float: ...
    @tets.setter
    def tets(self, value: float) -> None: ...
    @property
    def scale(self) -> float: ...
    @scale.setter
    def scale(self, value: float) -> None: ...
    @property
    def notes(self) -> list[str]: ...

class SurfaceDomain:
    def __init__(
        self,
        mesh: TriangleMesh | None = None,
        features: FeatureGraph | None = None,
        edge_lengths: ArrayLike | None = None,
    ) -> None: ...
    @property
    def vertices(self) -> Float64s: ...
    @property
    def triangles(self) -> Int32s: ...
    @property
    def edges(self) -> Int32s: ...
    @property
    def triangle_edges(self) -> Int32s: ...
    @property
    def edge_triangles(self) -> Int32s: ...
    @property
    def normals(self) -> Float64s: ...
    @property
    def edge_lengths(self) -> Float64s: ...
    @property
    def corner_angles(self) -> Float64s: ...
    @property
    def mesh(self) -> TriangleMesh: ...
    @property
    def features(self) -> FeatureGraph: ...
    @property
    def mean_edge_length(self) -> float: ...
    @property
    def size(self) -> float: ...
    @property
    def has_own_lengths(self) -> bool: ...
    @property
    def areas(self) -> Float64s: ...
    def with_features(self, features: FeatureGraph) -> SurfaceDomain: ...
    def with_edge_lengths(self, lengths: ArrayLike) -> SurfaceDomain: ...
    @staticmethod
    def made() -> int: ...

class DirectionConstraints:
    def __init__(
        self,
        edges: ArrayLike = ...,
        edge_directions: ArrayLike = ...,
        edge_weights: ArrayLike = ...,
        vertices: ArrayLike = ...,
        vertex_directions: ArrayLike = ...,
        vertex_weights: ArrayLike = ...,
    ) -> None: ...
    @property
    def edges(self) -> Int32s: ...
    @edges.setter
    def edges(self, value: ArrayLike) -> None: ...
    @property
    def edge_directions(self) -> Float64s: ...
    @edge_directions.setter
    def edge_directions(self, value: ArrayLike) -> None: ...
    @property
    def edge_weights(self) -> Float64s: ...
    @edge_weights.setter
    def edge_weights(self, value: ArrayLike) -> None: ...
    @property
    def vertices(self) -> Int32s: ...
    @vertices.setter
    def vertices(self, value: ArrayLike) -> None: ...
    @property
    def vertex_directions(self) -> Float64s: ...
    @vertex_directions.setter
    def vertex_directions(self, value: ArrayLike) -> None: ...
    @property
    def vertex_weights(self) -> Float64s: ...
    @vertex_weights.setter
    def vertex_weights(self, value: ArrayLike) -> None: ...

class DirectionGuide:
    length: float
    def __init__(self, directions: ArrayLike = ..., weights: ArrayLike = ..., length: float = ...) -> None: ...
    @property
    def directions(self) -> Float64s: ...
    @directions.setter
    def directions(self, value: ArrayLike) -> None: ...
    @property
    def weights(self) -> Float64s: ...
    @weights.setter
    def weights(self, value: ArrayLike) -> None: ...

class DirectionField:
    symmetry: int
    epsilon: float
    energy: float
    dirichlet_energy: float
    iterations: int
    converged: bool
    residual: float
    def __init__(
        self,
        symmetry: int = ...,
        domain: SurfaceDomain = ...,
        values: ArrayLike = ...,
        epsilon: float = ...,
        energy: float = ...,
        dirichlet_energy: float = ...,
        iterations: int = ...,
        converged: bool = ...,
        residual: float = ...,
        energy_history: ArrayLike = ...,
    ) -> None: ...
    @property
    def domain(self) -> SurfaceDomain: ...
    @property
    def values(self) -> NDArray[np.complex128]: ...
    @values.setter
    def values(self, value: ArrayLike) -> None: ...
    @property
    def energy_history(self) -> Float64s: ...
    @energy_history.setter
    def energy_history(self, value: ArrayLike) -> None: ...

class LinesMetric:
    least_part: float
    def __init__(self, domain: SurfaceDomain = ..., damped: ArrayLike = ..., least_part: float = ...) -> None: ...
    @property
    def domain(self) -> SurfaceDomain: ...
    @property
    def damped(self) -> Int32s: ...
    @damped.setter
    def damped(self, value: ArrayLike) -> None: ...

class NonOrthogonalField:
    energy: float
    start_energy: float
    iterations: int
    converged: bool
    smallest_angle: float
    freedom: float
    def __init__(
        self,
        domain: SurfaceDomain = ...,
        angles: ArrayLike = ...,
        first: ArrayLike = ...,
        second: ArrayLike = ...,
        quads: ArrayLike = ...,
        energy: float = ...,
        start_energy: float = ...,
        iterations: int = ...,
        converged: bool = ...,
        smallest_angle: float = ...,
        freedom: float = ...,
        inverted: ArrayLike = ...,
    ) -> None: ...
    @property
    def domain(self) -> SurfaceDomain: ...
    @property
    def angles(self) -> Float64s: ...
    @angles.setter
    def angles(self, value: ArrayLike) -> None: ...
    @property
    def first(self) -> Float64s: ...
    @first.setter
    def first(self, value: ArrayLike) -> None: ...
    @property
    def second(self) -> Float64s: ...
    @second.setter
    def second(self, value: ArrayLike) -> None: ...
    @property
    def quads(self) -> Int32s: ...
    @quads.setter
    def quads(self, value: ArrayLike) -> None: ...
    @property
    def inverted(self) -> Int32s: ...
    @inverted.setter
    def inverted(self, value: ArrayLike) -> None: ...

class PrincipalDirections:
    def __init__(
        self, directions: ArrayLike = ..., curvatures: ArrayLike = ..., anisotropy: ArrayLike = ...
    ) -> None: ...
    @property
    def directions(self) -> Float64s: ...
    @directions.setter
    def directions(self, value: ArrayLike) -> None: ...
    @property
    def curvatures(self) -> Float64s: ...
    @curvatures.setter
    def curvatures(self, value: ArrayLike) -> None: ...
    @property
    def anisotropy(self) -> Float64s: ...
    @anisotropy.setter
    def anisotropy(self, value: ArrayLike) -> None: ...

class SurfaceSingularity:
    index_times_symmetry: int
    index: float
    triangle: int
    vertex: int
    boundary: bool
    def __init__(
        self,
        position: ArrayLike = ...,
        index_times_symmetry: int = ...,
        index: float = ...,
        triangle: int = ...,
        vertex: int = ...,
        boundary: bool = ...,
    ) -> None: ...
    @property
    def position(self) -> Float64s: ...
    @position.setter
    def position(self, value: ArrayLike) -> None: ...

class SurfaceSingularities:
    index_sum: float
    euler_characteristic: int
    agree: bool
    boundary_deviation: float
    def __init__(
        self,
        points: Sequence[SurfaceSingularity] = ...,
        index_sum: float = ...,
        euler_characteristic: int = ...,
        agree: bool = ...,
        boundary_deviation: float = ...,
    ) -> None: ...
    @property
    def points(self) -> list[SurfaceSingularity]: ...

class Streamline:
    words: ClassVar[dict[str, list[str]]]
    length: float
    first_end: str
    last_end: str
    first_singularity: int
    last_singularity: int
    def __init__(
        self,
        points: ArrayLike = ...,
        triangles: ArrayLike = ...,
        length: float = ...,
        first_end: str = ...,
        last_end: str = ...,
        first_singularity: int = ...,
        last_singularity: int = ...,
    ) -> None: ...
    @property
    def points(self) -> Float64s: ...
    @points.setter
    def points(self, value: ArrayLike) -> None: ...
    @property
    def triangles(self) -> Int32s: ...
    @triangles.setter
    def triangles(self, value: ArrayLike) -> None: ...

def edge_topology(mesh: TriangleMesh) -> EdgeTopology: ...
def bounding_box_diagonal(points: ArrayLike) -> float: ...
def shape_size(mesh: TriangleMesh) -> float: ...
def default_edge_length(mesh: TriangleMesh) -> float: ...
def signed_volume(mesh: TriangleMesh) -> float: ...
def triangle_areas(mesh: TriangleMesh) -> Float64s: ...
def triangle_normals(mesh: TriangleMesh) -> Float64s: ...
def vertex_normals(mesh: TriangleMesh) -> Float64s: ...
def mean_edge_length(mesh: TriangleMesh) -> float: ...
def euler_characteristic(mesh: TriangleMesh) -> int: ...
def read_surface(path: Path) -> TriangleMesh: ...
def write_surface(mesh: TriangleMesh, path: Path) -> None: ...
def find_defects(mesh: TriangleMesh, *, closed: bool = ..., self_intersection: bool = ...) -> list[Defect]: ...
@overload
def require_valid(mesh: TriangleMesh, *, closed: bool = ..., self_intersection: bool = ...) -> None: ...
@overload
def require_valid(mesh: TetMesh) -> None: ...
@overload
def require_valid(mesh: MixedMesh) -> None: ...
@overload
def require_valid(mesh: QuadMesh, *, closed: bool = ...) -> None: ...
def repair(
    mesh: TriangleMesh,
    *,
    level: str = ...,
    closed: bool = ...,
    merge_tolerance: float = ...,
    small_hole_edges: int = ...,
    max_hole_edges: int = ...,
    wrap_alpha: float = ...,
    wrap_offset: float = ...,
) -> RepairResult: ...
def advise_repair(
    mesh: TriangleMesh,
    *,
    level: str = ...,
    closed: bool = ...,
    merge_tolerance: float = ...,
    small_hole_edges: int = ...,
    max_hole_edges: int = ...,
    wrap_alpha: float = ...,
    wrap_offset: float = ...,
    most_triangles: int = ...,
) -> RepairAdvice: ...
def coordinate_precision(points: ArrayLike) -> float: ...
def detect_features(mesh: TriangleMesh, *, angle: float = ..., corner_angle: float = ...) -> FeatureGraph: ...
def feature_graph(mesh: TriangleMesh, edges: ArrayLike, *, corner_angle: float = ...) -> FeatureGraph: ...
def remesh(
    mesh: TriangleMesh,
    features: FeatureGraph,
    *,
    edge_length: float = ...,
    iterations: int = ...,
    max_cells: float = ...,
    progress: Progress | None = None,
) -> RemeshResult: ...
def close_remesh(
    mesh: TriangleMesh,
    features: FeatureGraph,
    lengths: ArrayLike,
    *,
    vertices: float = ...,
    deviation: float = ...,
    quality: float = ...,
    max_vertices: float = ...,
    keep_stubs: bool = ...,
    iterations: int = ...,
    progress: Progress | None = None,
) -> CloseRemeshResult: ...
def winslow_smooth(
    surface: TriangleMesh,
    features: FeatureGraph,
    points: ArrayLike,
    *,
    rounds: int = ...,
    tolerance: float = ...,
    triangles: ArrayLike = ...,
    quads: ArrayLike = ...,
    fixed: Sequence[int] = ...,
    progress: Progress | None = None,
) -> WinslowResult: ...
def triangle_qualities(mesh: TriangleMesh) -> Float64s: ...
def size_field(
    mesh: TriangleMesh,
    features: FeatureGraph,
    *,
    longest: float = ...,
    shortest: float = ...,
    angle: float = ...,
    growth: float = ...,
    max_cells: float = ...,
) -> SizeField: ...
def direction_field(
    surface: SurfaceDomain | TriangleMesh,
    *,
    symmetry: int = ...,
    method: str = ...,
    epsilon: float = ...,
    edge_epsilon: ArrayLike | None = None,
    first_epsilon: float = ...,
    max_iterations: int = ...,
    tolerance: float = ...,
    energy_tolerance: float = ...,
    seed: int = ...,
    boundary_alignment: str = ...,
    feature_alignment: str = ...,
    alignment_length: float = ...,
    least_feature_angle: float = ...,
    corner_tolerance: float = ...,
    constraints: DirectionConstraints | None = None,
    guide: DirectionGuide | None = None,
    progress: Progress | None = None,
) -> DirectionField: ...
def non_orthogonal_field(
    surface: SurfaceDomain | TriangleMesh,
    *,
    method: str = ...,
    lambda_: float = ...,
    weights: str = ...,
    second_line: str = ...,
    corner_angle: float = ...,
    corners: ArrayLike | Sequence[CornerQuads] | None = None,
    least_angle: float = ...,
    max_iterations: int = ...,
    seed: int = ...,
    inertia: float = ...,
    penalty: float = ...,
    tolerance: float = ...,
    progress: Progress | None = None,
) -> NonOrthogonalField: ...
def lines_metric(field: NonOrthogonalField) -> LinesMetric: ...
def vertex_directions(field: DirectionField) -> Float64s: ...
def triangle_directions(field: DirectionField) -> Float64s: ...
@overload
def surface_singularities(field: DirectionField) -> SurfaceSingularities: ...
@overload
def surface_singularities(field: NonOrthogonalField) -> SurfaceSingularities: ...
def principal_directions(surface: SurfaceDomain | TriangleMesh) -> PrincipalDirections: ...

class ImposedPoint:
    triangle: int
    index_times_four: int
    def __init__(self, triangle: int = ..., weights: ArrayLike = ..., index_times_four: int = ...) -> None: ...
    @property
    def weights(self) -> Float64s: ...
    @weights.setter
    def weights(self, value: ArrayLike) -> None: ...

class CornerQuads:
    vertex: int
    quads: int
    def __init__(self, vertex: int = ..., quads: int = ...) -> None: ...

class SingularPattern:
    def __init__(self, points: Sequence[ImposedPoint] = ..., corners: Sequence[CornerQuads] = ...) -> None: ...
    @property
    def points(self) -> list[ImposedPoint]: ...
    @property
    def corners(self) -> list[CornerQuads]: ...

class CornerChoice:
    def __init__(
        self,
        corners: Sequence[CornerQuads] = ...,
        changed: ArrayLike = ...,
        inner_index_before: ArrayLike = ...,
        inner_index: ArrayLike = ...,
    ) -> None: ...
    @property
    def corners(self) -> list[CornerQuads]: ...
    @property
    def changed(self) -> Int32s: ...
    @changed.setter
    def changed(self, value: ArrayLike) -> None: ...
    @property
    def inner_index_before(self) -> Int32s: ...
    @inner_index_before.setter
    def inner_index_before(self, value: ArrayLike) -> None: ...
    @property
    def inner_index(self) -> Int32s: ...
    @inner_index.setter
    def inner_index(self, value: ArrayLike) -> None: ...

class ImposedFieldOptions:
    words: ClassVar[dict[str, list[str]]]
    inadmissible: str
    tolerance: float
    allow_zero_quads: bool
    sectors: int
    rings: int
    ring_ratio: float
    max_steps: int
    def __init__(
        self,
        inadmissible: str = ...,
        tolerance: float = ...,
        allow_zero_quads: bool = ...,
        sectors: int = ...,
        rings: int = ...,
        ring_ratio: float = ...,
        max_steps: int = ...,
    ) -> None: ...

class HolonomyCondition:
    boundary: bool
    vertex: int
    angle: float
    rotation: float
    size_factor: float
    def __init__(
        self,
        boundary: bool = ...,
        vertex: int = ...,
        angle: float = ...,
        rotation: float = ...,
        size_factor: float = ...,
    ) -> None: ...

class ImposedField:
    closure: float
    steps: int
    largest_move: float
    def __init__(
        self,
        field: DirectionField = ...,
        log_size: ArrayLike = ...,
        pattern: SingularPattern = ...,
        point_vertices: ArrayLike = ...,
        vertex_triangles: ArrayLike = ...,
        vertex_weights: ArrayLike = ...,
        triangle_origins: ArrayLike = ...,
        conditions: Sequence[HolonomyCondition] = ...,
        closure: float = ...,
        steps: int = ...,
        largest_move: float = ...,
    ) -> None: ...
    @property
    def field(self) -> DirectionField: ...
    @property
    def log_size(self) -> Float64s: ...
    @log_size.setter
    def log_size(self, value: ArrayLike) -> None: ...
    @property
    def pattern(self) -> SingularPattern: ...
    @property
    def point_vertices(self) -> Int32s: ...
    @point_vertices.setter
    def point_vertices(self, value: ArrayLike) -> None: ...
    @property
    def vertex_triangles(self) -> Int32s: ...
    @vertex_triangles.setter
    def vertex_triangles(self, value: ArrayLike) -> None: ...
    @property
    def vertex_weights(self) -> Float64s: ...
    @vertex_weights.setter
    def vertex_weights(self, value: ArrayLike) -> None: ...
    @property
    def triangle_origins(self) -> Int32s: ...
    @triangle_origins.setter
    def triangle_origins(self, value: ArrayLike) -> None: ...
    @property
    def conditions(self) -> list[HolonomyCondition]: ...

def impose_singular_points(
    surface: SurfaceDomain | TriangleMesh,
    pattern: SingularPattern,
    *,
    inadmissible: str = ...,
    tolerance: float = ...,
    allow_zero_quads: bool = ...,
    sectors: int = ...,
    rings: int = ...,
    ring_ratio: float = ...,
    max_steps: int = ...,
    progress: Progress | None = None,
) -> ImposedField: ...
def default_corner_quads(surface: SurfaceDomain | TriangleMesh) -> list[CornerQuads]: ...
def fewest_points_corner_quads(surface: SurfaceDomain | TriangleMesh) -> CornerChoice: ...
def imposed_point(
    surface: SurfaceDomain | TriangleMesh, position: ArrayLike, index_times_four: int
) -> ImposedPoint: ...
def imposed_at_vertex(surface: SurfaceDomain | TriangleMesh, vertex: int, index_times_four: int) -> ImposedPoint: ...
def imposed_position(surface: SurfaceDomain | TriangleMesh, point: ImposedPoint) -> Float64s: ...
@overload
def singular_pattern(field: DirectionField, singularities: SurfaceSingularities) -> SingularPattern: ...
@overload
def singular_pattern(surface: SurfaceDomain, singularities: SurfaceSingularities) -> SingularPattern: ...
def move_singular_point(
    surface: SurfaceDomain | TriangleMesh, pattern: SingularPattern, place: int, to: ArrayLike
) -> SingularPattern: ...
def add_singular_pair(
    surface: SurfaceDomain | TriangleMesh, pattern: SingularPattern, valence_3: ArrayLike, valence_5: ArrayLike
) -> SingularPattern: ...
def remove_singular_points(pattern: SingularPattern, places: ArrayLike) -> SingularPattern: ...
def merge_singular_points(
    surface: SurfaceDomain | TriangleMesh, pattern: SingularPattern, places: ArrayLike, to: ArrayLike
) -> SingularPattern: ...

# ---- surface: quad layouts

class WantedSizes:
    def __init__(
        self,
        lengths: ArrayLike = ...,
        turns: ArrayLike = ...,
    ) -> None: ...
    @property
    def lengths(self) -> Float64s: ...
    @lengths.setter
    def lengths(self, value: ArrayLike) -> None: ...
    @property
    def turns(self) -> Float64s: ...
    @turns.setter
    def turns(self, value: ArrayLike) -> None: ...

class SizedField:
    eigenvalue: float
    iterations: int
    converged: bool
    least_length: float
    def __init__(
        self,
        field: DirectionField = ...,
        values: ArrayLike = ...,
        directions: ArrayLike = ...,
        eigenvalue: float = ...,
        iterations: int = ...,
        converged: bool = ...,
        holonomy: ArrayLike = ...,
        unresolved: ArrayLike = ...,
        triangle_indices: ArrayLike = ...,
        least_length: float = ...,
    ) -> None: ...
    @property
    def field(self) -> DirectionField: ...
    @property
    def values(self) -> Complex128s: ...
    @values.setter
    def values(self, value: ArrayLike) -> None: ...
    @property
    def directions(self) -> Float64s: ...
    @directions.setter
    def directions(self, value: ArrayLike) -> None: ...
    @property
    def holonomy(self) -> Float64s: ...
    @holonomy.setter
    def holonomy(self, value: ArrayLike) -> None: ...
    @property
    def unresolved(self) -> Int32s: ...
    @unresolved.setter
    def unresolved(self, value: ArrayLike) -> None: ...
    @property
    def triangle_indices(self) -> Int32s: ...
    @triangle_indices.setter
    def triangle_indices(self, value: ArrayLike) -> None: ...

class ReachedSizes:
    misfit: float
    def __init__(
        self,
        log_sizes: ArrayLike = ...,
        misfit: float = ...,
    ) -> None: ...
    @property
    def log_sizes(self) -> Float64s: ...
    @log_sizes.setter
    def log_sizes(self, value: ArrayLike) -> None: ...

class ExtendedRegion:
    vertices: int
    triangles: int
    def __init__(
        self,
        mesh: TriangleMesh = ...,
        vertices: int = ...,
        triangles: int = ...,
    ) -> None: ...
    @property
    def mesh(self) -> TriangleMesh: ...

class SizedFieldOptions:
    words: ClassVar[dict[str, list[str]]]
    symmetry: int
    s: float
    boundary_alignment: str
    feature_alignment: str
    corner_tolerance: float
    shift: float
    max_iterations: int
    tolerance: float
    seed: int
    def __init__(
        self,
        symmetry: int = ...,
        s: float = ...,
        boundary_alignment: str = ...,
        feature_alignment: str = ...,
        corner_tolerance: float = ...,
        directions: ArrayLike = ...,
        weights: ArrayLike = ...,
        shift: float = ...,
        max_iterations: int = ...,
        tolerance: float = ...,
        seed: int = ...,
    ) -> None: ...
    @property
    def directions(self) -> Float64s: ...
    @directions.setter
    def directions(self, value: ArrayLike) -> None: ...
    @property
    def weights(self) -> Float64s: ...
    @weights.setter
    def weights(self, value: ArrayLike) -> None: ...

Sizes: TypeAlias = WantedSizes | ArrayLike | Callable[[Float64s], ArrayLike]

def wanted_sizes(
    surface: SurfaceDomain | TriangleMesh, sizes: Sizes, middles: ArrayLike | None = None
) -> WantedSizes: ...
def edge_midpoints(surface: SurfaceDomain | TriangleMesh) -> Float64s: ...
def sized_field(
    surface: SurfaceDomain | TriangleMesh,
    sizes: Sizes,
    *,
    symmetry: int = ...,
    s: float = ...,
    boundary_alignment: str = ...,
    feature_alignment: str = ...,
    corner_tolerance: float = ...,
    directions: ArrayLike | None = None,
    weights: ArrayLike | None = None,
    shift: float = ...,
    max_iterations: int = ...,
    tolerance: float = ...,
    seed: int = ...,
    progress: Progress | None = None,
) -> SizedField: ...
def sized_domain(surface: SurfaceDomain | TriangleMesh, lengths: ArrayLike) -> SurfaceDomain: ...
def boundary_sizes(surface: SurfaceDomain | TriangleMesh, *, growth: float = ..., largest: float = ...) -> Float64s: ...
def reached_sizes(field: DirectionField) -> ReachedSizes: ...
def size_ratios(surface: SurfaceDomain | TriangleMesh, reached: ReachedSizes, wanted: ArrayLike) -> Float64s: ...
def extended_region(
    region: SurfaceDomain | TriangleMesh, *, margin: float = ..., longest: float = ...
) -> ExtendedRegion: ...
def extended_sizes(region: ExtendedRegion, lengths: ArrayLike) -> Float64s: ...
def restricted_field(field: DirectionField, region: SurfaceDomain | TriangleMesh) -> DirectionField: ...

class DiskParameterization:
    def __init__(
        self,
        uv: ArrayLike = ...,
        loops: list[ArrayLike] = ...,
    ) -> None: ...
    @property
    def uv(self) -> Float64s: ...
    @uv.setter
    def uv(self, value: ArrayLike) -> None: ...
    @property
    def loops(self) -> list[Int32s]: ...

class MapDistortion:
    def __init__(
        self,
        singular_values: ArrayLike = ...,
        conformity: ArrayLike = ...,
    ) -> None: ...
    @property
    def singular_values(self) -> Float64s: ...
    @singular_values.setter
    def singular_values(self, value: ArrayLike) -> None: ...
    @property
    def conformity(self) -> Float64s: ...
    @conformity.setter
    def conformity(self, value: ArrayLike) -> None: ...

class BisectedEdges:
    def __init__(
        self,
        domain: SurfaceDomain = ...,
        parents: ArrayLike = ...,
    ) -> None: ...
    @property
    def domain(self) -> SurfaceDomain: ...
    @property
    def parents(self) -> Int32s: ...
    @parents.setter
    def parents(self, value: ArrayLike) -> None: ...

class AtlasOptions:
    conformity: float
    max_triangles: int
    bisect: bool
    def __init__(
        self,
        conformity: float = ...,
        max_triangles: int = ...,
        bisect: bool = ...,
    ) -> None: ...

class AtlasChart:
    triangles: int
    area: float
    loops: int
    conformity: float
    least_conformity: float
    mean_conformity: float
    evenness: float
    as_asked: bool
    def __init__(
        self,
        triangles: int = ...,
        area: float = ...,
        loops: int = ...,
        conformity: float = ...,
        least_conformity: float = ...,
        mean_conformity: float = ...,
        evenness: float = ...,
        as_asked: bool = ...,
    ) -> None: ...

class AtlasFace:
    genus: int
    loops: int
    triangles: int
    def __init__(
        self,
        genus: int = ...,
        loops: int = ...,
        triangles: int = ...,
    ) -> None: ...

class Atlas:
    def __init__(
        self,
        domain: SurfaceDomain = ...,
        parents: ArrayLike = ...,
        faces: ArrayLike = ...,
        charts: ArrayLike = ...,
        uv: ArrayLike = ...,
        uv_triangles: ArrayLike = ...,
        origins: ArrayLike = ...,
        cuts: ArrayLike = ...,
        conformity: ArrayLike = ...,
        face_list: list[AtlasFace] = ...,
        chart_list: list[AtlasChart] = ...,
    ) -> None: ...
    @property
    def domain(self) -> SurfaceDomain: ...
    @property
    def parents(self) -> Int32s: ...
    @parents.setter
    def parents(self, value: ArrayLike) -> None: ...
    @property
    def faces(self) -> Int32s: ...
    @faces.setter
    def faces(self, value: ArrayLike) -> None: ...
    @property
    def charts(self) -> Int32s: ...
    @charts.setter
    def charts(self, value: ArrayLike) -> None: ...
    @property
    def uv(self) -> Float64s: ...
    @uv.setter
    def uv(self, value: ArrayLike) -> None: ...
    @property
    def uv_triangles(self) -> Int32s: ...
    @uv_triangles.setter
    def uv_triangles(self, value: ArrayLike) -> None: ...
    @property
    def origins(self) -> Int32s: ...
    @origins.setter
    def origins(self, value: ArrayLike) -> None: ...
    @property
    def cuts(self) -> Int32s: ...
    @cuts.setter
    def cuts(self, value: ArrayLike) -> None: ...
    @property
    def conformity(self) -> Float64s: ...
    @conformity.setter
    def conformity(self, value: ArrayLike) -> None: ...
    @property
    def face_list(self) -> list[AtlasFace]: ...
    @property
    def chart_list(self) -> list[AtlasChart]: ...

def mean_value_weights(surface: SurfaceDomain | TriangleMesh) -> tuple[Int32s, Float64s]: ...
def boundary_loops(surface: SurfaceDomain | TriangleMesh) -> list[Int32s]: ...
def parameterize_disk(surface: SurfaceDomain | TriangleMesh, *, fill_holes: bool = True) -> DiskParameterization: ...
def not_positive(uv: ArrayLike, triangles: ArrayLike) -> Int32s: ...
def map_distortion(surface: SurfaceDomain | TriangleMesh, uv: ArrayLike, uv_triangles: ArrayLike) -> MapDistortion: ...
def plane_metric(
    surface: SurfaceDomain | TriangleMesh, uv: ArrayLike, uv_triangles: ArrayLike, h: float
) -> Float64s: ...
def bisected_edges(
    surface: SurfaceDomain | TriangleMesh, longest: ArrayLike, *, most_triangles: int = 50000000
) -> BisectedEdges: ...
def atlas(
    surface: SurfaceDomain | TriangleMesh,
    *,
    conformity: float = ...,
    max_triangles: int = ...,
    bisect: bool = ...,
    progress: Progress | None = None,
) -> Atlas: ...
def packed_uv(atlas: Atlas) -> tuple[Float64s, float]: ...

class SizeFamilies:
    worst_anisotropy: float
    mean_anisotropy: float
    objective: float
    iterations: int
    converged: bool
    self_crossings: int
    parts: int
    left_out: int
    def __init__(
        self,
        lines: list[Streamline] = ...,
        positions: ArrayLike = ...,
        triangles: ArrayLike = ...,
        crossing_lines: ArrayLike = ...,
        log_widths: ArrayLike = ...,
        worst_anisotropy: float = ...,
        mean_anisotropy: float = ...,
        objective: float = ...,
        iterations: int = ...,
        converged: bool = ...,
        self_crossings: int = ...,
        parts: int = ...,
        left_out: int = ...,
        log_anisotropy: ArrayLike = ...,
        log_sizes: ArrayLike = ...,
    ) -> None: ...
    @property
    def lines(self) -> list[Streamline]: ...
    @property
    def positions(self) -> Float64s: ...
    @positions.setter
    def positions(self, value: ArrayLike) -> None: ...
    @property
    def triangles(self) -> Int32s: ...
    @triangles.setter
    def triangles(self, value: ArrayLike) -> None: ...
    @property
    def crossing_lines(self) -> Int32s: ...
    @crossing_lines.setter
    def crossing_lines(self, value: ArrayLike) -> None: ...
    @property
    def log_widths(self) -> Float64s: ...
    @log_widths.setter
    def log_widths(self, value: ArrayLike) -> None: ...
    @property
    def log_anisotropy(self) -> Float64s: ...
    @log_anisotropy.setter
    def log_anisotropy(self, value: ArrayLike) -> None: ...
    @property
    def log_sizes(self) -> Float64s: ...
    @log_sizes.setter
    def log_sizes(self, value: ArrayLike) -> None: ...

class PhaseSearch:
    least_worst: int
    least_mean: int
    def __init__(
        self,
        angles: ArrayLike = ...,
        worst: ArrayLike = ...,
        mean: ArrayLike = ...,
        least_worst: int = ...,
        least_mean: int = ...,
    ) -> None: ...
    @property
    def angles(self) -> Float64s: ...
    @angles.setter
    def angles(self, value: ArrayLike) -> None: ...
    @property
    def worst(self) -> Float64s: ...
    @worst.setter
    def worst(self, value: ArrayLike) -> None: ...
    @property
    def mean(self) -> Float64s: ...
    @mean.setter
    def mean(self, value: ArrayLike) -> None: ...

class LimitCycle:
    flux: float
    crosses_itself: bool
    def __init__(
        self,
        line: Streamline = ...,
        flux: float = ...,
        crosses_itself: bool = ...,
    ) -> None: ...
    @property
    def line(self) -> Streamline: ...

class UnwoundField:
    def __init__(
        self,
        field: DirectionField = ...,
        removed: list[LimitCycle] = ...,
        left: list[LimitCycle] = ...,
    ) -> None: ...
    @property
    def field(self) -> DirectionField: ...
    @property
    def removed(self) -> list[LimitCycle]: ...
    @property
    def left(self) -> list[LimitCycle]: ...

class SizeFamilyOptions:
    spacing: float
    power: int
    max_length: float
    singular_radius: float
    max_iterations: int
    stop_at_features: bool
    def __init__(
        self,
        spacing: float = ...,
        power: int = ...,
        max_length: float = ...,
        singular_radius: float = ...,
        max_iterations: int = ...,
        stop_at_features: bool = ...,
    ) -> None: ...

class LimitCycleOptions:
    seeds: int
    max_length: float
    tolerance: float
    band_width: float
    most_removed: int
    def __init__(
        self,
        seeds: int = ...,
        max_length: float = ...,
        tolerance: float = ...,
        band_width: float = ...,
        most_removed: int = ...,
    ) -> None: ...

def size_families(
    field: DirectionField,
    singularities: SurfaceSingularities,
    *,
    spacing: float = ...,
    power: int = ...,
    max_length: float = ...,
    singular_radius: float = ...,
    max_iterations: int = ...,
    stop_at_features: bool = ...,
    progress: Progress | None = None,
) -> SizeFamilies: ...
def phase_search(
    field: DirectionField,
    phases: int,
    *,
    spacing: float = ...,
    power: int = ...,
    max_length: float = ...,
    singular_radius: float = ...,
    max_iterations: int = ...,
    stop_at_features: bool = ...,
    progress: Progress | None = None,
) -> PhaseSearch: ...
def limit_cycles(
    field: DirectionField,
    singularities: SurfaceSingularities,
    *,
    seeds: int = ...,
    max_length: float = ...,
    tolerance: float = ...,
    band_width: float = ...,
    most_removed: int = ...,
    progress: Progress | None = None,
) -> list[LimitCycle]: ...
def without_limit_cycles(
    field: DirectionField,
    *,
    seeds: int = ...,
    max_length: float = ...,
    tolerance: float = ...,
    band_width: float = ...,
    most_removed: int = ...,
    progress: Progress | None = None,
) -> UnwoundField: ...
def rotated_field(field: DirectionField, angle: float) -> DirectionField: ...

class LayoutCurveOptions:
    end_tolerance: float
    max_length: float
    def __init__(
        self,
        end_tolerance: float = ...,
        max_length: float = ...,
        cut_vertices: ArrayLike = ...,
    ) -> None: ...
    @property
    def cut_vertices(self) -> Int32s: ...
    @cut_vertices.setter
    def cut_vertices(self, value: ArrayLike) -> None: ...

class FittingOptions:
    edge_length: float
    places: int
    more_tried: int
    most_tried: int
    most_triangles: float
    def __init__(
        self,
        edge_length: float = ...,
        places: int = ...,
        more_tried: int = ...,
        most_tried: int = ...,
        most_triangles: float = ...,
    ) -> None: ...

class LayoutQuadsOptions:
    edge_length: float
    quad_count: int
    def __init__(
        self,
        edge_length: float = ...,
        quad_count: int = ...,
    ) -> None: ...

class LayoutCurve:
    first_vertex: int
    last_vertex: int
    offset: float
    def __init__(
        self,
        vertices: ArrayLike = ...,
        edges: ArrayLike = ...,
        fractions: ArrayLike = ...,
        lengths: ArrayLike = ...,
        triangles: ArrayLike = ...,
        first_vertex: int = ...,
        last_vertex: int = ...,
        offset: float = ...,
    ) -> None: ...
    @property
    def vertices(self) -> Int32s: ...
    @vertices.setter
    def vertices(self, value: ArrayLike) -> None: ...
    @property
    def edges(self) -> Int32s: ...
    @edges.setter
    def edges(self, value: ArrayLike) -> None: ...
    @property
    def fractions(self) -> Float64s: ...
    @fractions.setter
    def fractions(self, value: ArrayLike) -> None: ...
    @property
    def lengths(self) -> Float64s: ...
    @lengths.setter
    def lengths(self, value: ArrayLike) -> None: ...
    @property
    def triangles(self) -> Int32s: ...
    @triangles.setter
    def triangles(self, value: ArrayLike) -> None: ...

class LayoutCurves:
    traced: int
    end_tolerance: float
    parameter_area: float
    def __init__(
        self,
        curves: Sequence[LayoutCurve] = ...,
        traced: int = ...,
        end_tolerance: float = ...,
        parameter_area: float = ...,
        domain: SurfaceDomain = ...,
    ) -> None: ...
    @property
    def curves(self) -> list[LayoutCurve]: ...
    @property
    def domain(self) -> SurfaceDomain: ...

class LayoutVertex:
    words: ClassVar[dict[str, list[str]]]
    kind: str
    vertex: int
    index_times_four: int
    def __init__(
        self,
        kind: str = ...,
        vertex: int = ...,
        index_times_four: int = ...,
        position: ArrayLike = ...,
    ) -> None: ...
    @property
    def position(self) -> Float64s: ...
    @position.setter
    def position(self, value: ArrayLike) -> None: ...

class LayoutSide:
    first: int
    last: int
    curve: int
    chord: int
    def __init__(
        self,
        first: int = ...,
        last: int = ...,
        curve: int = ...,
        chord: int = ...,
        points: ArrayLike = ...,
        parameters: ArrayLike = ...,
    ) -> None: ...
    @property
    def points(self) -> Float64s: ...
    @points.setter
    def points(self, value: ArrayLike) -> None: ...
    @property
    def parameters(self) -> Float64s: ...
    @parameters.setter
    def parameters(self, value: ArrayLike) -> None: ...

class LayoutPatch:
    words: ClassVar[dict[str, list[str]]]
    kind: str
    euler_characteristic: int
    corners: int
    def __init__(
        self,
        kind: str = ...,
        euler_characteristic: int = ...,
        corners: int = ...,
        loops: Sequence[ArrayLike] = ...,
        corner_sides: ArrayLike = ...,
    ) -> None: ...
    @property
    def corner_sides(self) -> Int32s: ...
    @corner_sides.setter
    def corner_sides(self, value: ArrayLike) -> None: ...
    @property
    def loops(self) -> list[Int32s]: ...
    @loops.setter
    def loops(self, value: Sequence[ArrayLike]) -> None: ...

class LayoutChord:
    length: float
    def __init__(
        self,
        sides: ArrayLike = ...,
        length: float = ...,
    ) -> None: ...
    @property
    def sides(self) -> Int32s: ...
    @sides.setter
    def sides(self, value: ArrayLike) -> None: ...

class PatchPolygons:
    def __init__(
        self,
        points: ArrayLike = ...,
        first: ArrayLike = ...,
        corners: ArrayLike = ...,
        patches: ArrayLike = ...,
    ) -> None: ...
    @property
    def points(self) -> Float64s: ...
    @points.setter
    def points(self, value: ArrayLike) -> None: ...
    @property
    def first(self) -> Int32s: ...
    @first.setter
    def first(self, value: ArrayLike) -> None: ...
    @property
    def corners(self) -> Int32s: ...
    @corners.setter
    def corners(self, value: ArrayLike) -> None: ...
    @property
    def patches(self) -> Int32s: ...
    @patches.setter
    def patches(self, value: ArrayLike) -> None: ...

class LayoutQuads:
    mean_value_patches: int
    least_scaled_jacobian: float
    def __init__(
        self,
        mesh: QuadMesh = ...,
        patches: ArrayLike = ...,
        chord_counts: ArrayLike = ...,
        patch_sizes: ArrayLike = ...,
        mean_value_patches: int = ...,
        least_scaled_jacobian: float = ...,
    ) -> None: ...
    @property
    def mesh(self) -> QuadMesh: ...
    @property
    def patches(self) -> Int32s: ...
    @patches.setter
    def patches(self, value: ArrayLike) -> None: ...
    @property
    def chord_counts(self) -> Int32s: ...
    @chord_counts.setter
    def chord_counts(self, value: ArrayLike) -> None: ...
    @property
    def patch_sizes(self) -> Int32s: ...
    @patch_sizes.setter
    def patch_sizes(self, value: ArrayLike) -> None: ...

class QuantizedQuadsOptions:
    words: ClassVar[dict[str, list[str]]]
    edge_length: float
    quad_count: int
    blocks: str
    least_jacobian: float
    weights: str
    measure: str
    smoothing: int
    release_points: bool
    most_nodes: int
    def __init__(
        self,
        edge_length: float = ...,
        quad_count: int = ...,
        blocks: str = ...,
        least_jacobian: float = ...,
        weights: str = ...,
        measure: str = ...,
        origins: ArrayLike = ...,
        smoothing: int = ...,
        release_points: bool = ...,
        follow: ArrayLike = ...,
        most_nodes: int = ...,
    ) -> None: ...
    @property
    def origins(self) -> Int32s: ...
    @origins.setter
    def origins(self, value: ArrayLike) -> None: ...
    @property
    def follow(self) -> Complex128s: ...
    @follow.setter
    def follow(self, value: ArrayLike) -> None: ...

class QuantizedQuads:
    fewest_blocks: int
    coarsest_blocks: int
    t_joints: int
    size: float
    deviation: float
    bound: float
    optimal: bool
    mean_value_patches: int
    least_scaled_jacobian: float
    def __init__(
        self,
        mesh: QuadMesh = ...,
        patches: ArrayLike = ...,
        chord_counts: ArrayLike = ...,
        patch_sizes: ArrayLike = ...,
        patch_chords: ArrayLike = ...,
        tiles: ArrayLike = ...,
        arc_counts: ArrayLike = ...,
        part_counts: ArrayLike = ...,
        fewest_blocks: int = ...,
        coarsest_blocks: int = ...,
        t_joints: int = ...,
        irregular: ArrayLike = ...,
        size: float = ...,
        deviation: float = ...,
        bound: float = ...,
        optimal: bool = ...,
        mean_value_patches: int = ...,
        least_scaled_jacobian: float = ...,
    ) -> None: ...
    @property
    def mesh(self) -> QuadMesh: ...
    @property
    def patches(self) -> Int32s: ...
    @patches.setter
    def patches(self, value: ArrayLike) -> None: ...
    @property
    def chord_counts(self) -> Int32s: ...
    @chord_counts.setter
    def chord_counts(self, value: ArrayLike) -> None: ...
    @property
    def patch_sizes(self) -> Int32s: ...
    @patch_sizes.setter
    def patch_sizes(self, value: ArrayLike) -> None: ...
    @property
    def patch_chords(self) -> Int32s: ...
    @patch_chords.setter
    def patch_chords(self, value: ArrayLike) -> None: ...
    @property
    def tiles(self) -> Int32s: ...
    @tiles.setter
    def tiles(self, value: ArrayLike) -> None: ...
    @property
    def arc_counts(self) -> Int32s: ...
    @arc_counts.setter
    def arc_counts(self, value: ArrayLike) -> None: ...
    @property
    def part_counts(self) -> Int32s: ...
    @part_counts.setter
    def part_counts(self, value: ArrayLike) -> None: ...
    @property
    def irregular(self) -> Int32s: ...
    @irregular.setter
    def irregular(self, value: ArrayLike) -> None: ...

class IntegerGridMap:
    mean_distortion: float
    largest_distortion: float
    largest_residual: float
    steps: int
    def __init__(
        self,
        positions: ArrayLike = ...,
        triangles: ArrayLike = ...,
        coordinates: ArrayLike = ...,
        triangle_origins: ArrayLike = ...,
        singular: ArrayLike = ...,
        mean_distortion: float = ...,
        largest_distortion: float = ...,
        largest_residual: float = ...,
        steps: int = ...,
    ) -> None: ...
    @property
    def positions(self) -> Float64s: ...
    @positions.setter
    def positions(self, value: ArrayLike) -> None: ...
    @property
    def triangles(self) -> Int32s: ...
    @triangles.setter
    def triangles(self, value: ArrayLike) -> None: ...
    @property
    def coordinates(self) -> Float64s: ...
    @coordinates.setter
    def coordinates(self, value: ArrayLike) -> None: ...
    @property
    def triangle_origins(self) -> Int32s: ...
    @triangle_origins.setter
    def triangle_origins(self, value: ArrayLike) -> None: ...
    @property
    def singular(self) -> Int32s: ...
    @singular.setter
    def singular(self, value: ArrayLike) -> None: ...

class BaseComplex:
    cut_vertices: int
    def __init__(
        self,
        blocks: ArrayLike = ...,
        block_sizes: ArrayLike = ...,
        block_chords: ArrayLike = ...,
        chord_counts: ArrayLike = ...,
        irregular: ArrayLike = ...,
        cut_vertices: int = ...,
    ) -> None: ...
    @property
    def blocks(self) -> Int32s: ...
    @blocks.setter
    def blocks(self, value: ArrayLike) -> None: ...
    @property
    def block_sizes(self) -> Int32s: ...
    @block_sizes.setter
    def block_sizes(self, value: ArrayLike) -> None: ...
    @property
    def block_chords(self) -> Int32s: ...
    @block_chords.setter
    def block_chords(self, value: ArrayLike) -> None: ...
    @property
    def chord_counts(self) -> Int32s: ...
    @chord_counts.setter
    def chord_counts(self, value: ArrayLike) -> None: ...
    @property
    def irregular(self) -> Int32s: ...
    @irregular.setter
    def irregular(self, value: ArrayLike) -> None: ...

class FeatureCut:
    def __init__(self, domain: SurfaceDomain = ..., origins: ArrayLike = ...) -> None: ...
    @property
    def domain(self) -> SurfaceDomain: ...
    @property
    def origins(self) -> Int32s: ...
    @origins.setter
    def origins(self, value: ArrayLike) -> None: ...

class PlanarOutline:
    def __init__(self, points: ArrayLike = ..., loops: ArrayLike = ..., lines: ArrayLike = ...) -> None: ...
    @property
    def points(self) -> Float64s: ...
    @points.setter
    def points(self, value: ArrayLike) -> None: ...
    @property
    def loops(self) -> Int32s: ...
    @loops.setter
    def loops(self, value: ArrayLike) -> None: ...
    @property
    def lines(self) -> Int32s: ...
    @lines.setter
    def lines(self, value: ArrayLike) -> None: ...

class FixedBoundaryOptions:
    words: ClassVar[dict[str, list[str]]]
    edge_length: float
    rotation: float
    offset_x: float
    offset_y: float
    clearance: float
    odd_loops: str
    rounds: int
    def __init__(
        self,
        edge_length: float = ...,
        rotation: float = ...,
        offset_x: float = ...,
        offset_y: float = ...,
        clearance: float = ...,
        odd_loops: str = ...,
        rounds: int = ...,
    ) -> None: ...

class FixedBoundaryQuads:
    reformed: int
    def __init__(
        self,
        mesh: QuadMesh = ...,
        boundary: ArrayLike = ...,
        lines: ArrayLike = ...,
        interior: ArrayLike = ...,
        split: ArrayLike = ...,
        reformed: int = ...,
    ) -> None: ...
    @property
    def mesh(self) -> QuadMesh: ...
    @property
    def boundary(self) -> Int32s: ...
    @boundary.setter
    def boundary(self, value: ArrayLike) -> None: ...
    @property
    def lines(self) -> Int32s: ...
    @lines.setter
    def lines(self, value: ArrayLike) -> None: ...
    @property
    def interior(self) -> Int32s: ...
    @interior.setter
    def interior(self, value: ArrayLike) -> None: ...
    @property
    def split(self) -> Int32s: ...
    @split.setter
    def split(self, value: ArrayLike) -> None: ...

class PatternChange:
    def __init__(self, triangle: int = ..., added: bool = ..., positions: ArrayLike = ...) -> None: ...
    triangle: int
    added: bool
    @property
    def positions(self) -> Float64s: ...
    @positions.setter
    def positions(self, value: ArrayLike) -> None: ...

class FittedPattern:
    def __init__(
        self,
        pattern: SingularPattern = ...,
        changes: Sequence[PatternChange] = ...,
        before: float = ...,
        left: float = ...,
        tried: int = ...,
    ) -> None: ...
    @property
    def pattern(self) -> SingularPattern: ...
    @pattern.setter
    def pattern(self, value: SingularPattern) -> None: ...
    @property
    def changes(self) -> list[PatternChange]: ...
    @changes.setter
    def changes(self, value: Sequence[PatternChange]) -> None: ...
    before: float
    left: float
    tried: int

class QuadLayout:
    def __init__(
        self, field: ImposedField, options: LayoutCurveOptions = ..., cut_annuli: bool = ..., t_mesh: bool = ...
    ) -> None: ...
    @property
    def vertices(self) -> list[LayoutVertex]: ...
    @property
    def sides(self) -> list[LayoutSide]: ...
    @property
    def patches(self) -> list[LayoutPatch]: ...
    @property
    def chords(self) -> list[LayoutChord]: ...
    @property
    def curves(self) -> LayoutCurves: ...
    @property
    def largest_mismatch(self) -> float: ...
    @property
    def field(self) -> ImposedField: ...
    @property
    def options(self) -> LayoutCurveOptions: ...
    @property
    def cut_annuli(self) -> bool: ...
    @property
    def t_mesh(self) -> bool: ...

def layout_curves(
    field: ImposedField,
    *,
    end_tolerance: float = ...,
    max_length: float = ...,
    cut_vertices: ArrayLike | None = ...,
    progress: Progress | None = None,
) -> LayoutCurves: ...
def turned_for_layout(
    field: ImposedField,
    *,
    end_tolerance: float = ...,
    max_length: float = ...,
    cut_vertices: ArrayLike | None = ...,
    progress: Progress | None = None,
) -> ImposedField: ...
def quad_layout(
    field: ImposedField,
    *,
    end_tolerance: float = ...,
    max_length: float = ...,
    cut_vertices: ArrayLike | None = ...,
    cut_annuli: bool = ...,
    progress: Progress | None = None,
) -> QuadLayout: ...
def patch_polygons(layout: QuadLayout) -> PatchPolygons: ...
def layout_quads(
    layout: QuadLayout, *, edge_length: float = ..., quad_count: int = ..., progress: Progress | None = None
) -> LayoutQuads: ...
def motorcycle_graph(
    field: ImposedField,
    *,
    end_tolerance: float = ...,
    max_length: float = ...,
    cut_vertices: ArrayLike | None = ...,
    progress: Progress | None = None,
) -> QuadLayout: ...
def quantized_quads(
    layout: QuadLayout,
    *,
    edge_length: float = ...,
    quad_count: int = ...,
    blocks: str = ...,
    least_jacobian: float = ...,
    weights: str = ...,
    measure: str = ...,
    origins: ArrayLike | None = ...,
    smoothing: int = ...,
    release_points: bool = ...,
    follow: ArrayLike | None = ...,
    most_nodes: int = ...,
    progress: Progress | None = None,
) -> QuantizedQuads: ...
def quad_templates(sides: int, interior: int) -> list[Int32s]: ...
def require_planar(outline: PlanarOutline) -> None: ...
def outline_triangles(outline: PlanarOutline) -> TriangleMesh: ...
def outline_of_graph(points: ArrayLike, segments: ArrayLike, holes: ArrayLike = ...) -> PlanarOutline: ...
def fixed_boundary_quads(
    outline: PlanarOutline,
    inside: QuadMesh | None = None,
    *,
    edge_length: float = ...,
    rotation: float = ...,
    offset_x: float = ...,
    offset_y: float = ...,
    clearance: float = ...,
    odd_loops: str = ...,
    rounds: int = ...,
    progress: Progress | None = None,
) -> FixedBoundaryQuads: ...
def integer_grid_map(
    layout: QuadLayout, quads: QuantizedQuads, origins: ArrayLike = ..., *, progress: Progress | None = None
) -> IntegerGridMap: ...
def arc_shortages(layout: QuadLayout, origins: ArrayLike = ...) -> Float64s: ...
def moved_by_faces(
    surface: SurfaceDomain | TriangleMesh,
    pattern: SingularPattern,
    *,
    inadmissible: str = ...,
    tolerance: float = ...,
    allow_zero_quads: bool = ...,
    sectors: int = ...,
    rings: int = ...,
    ring_ratio: float = ...,
    max_steps: int = ...,
    progress: Progress | None = None,
) -> SingularPattern: ...
def fitted_pattern(
    surface: SurfaceDomain | TriangleMesh,
    pattern: SingularPattern,
    origins: ArrayLike,
    *,
    inadmissible: str = ...,
    tolerance: float = ...,
    allow_zero_quads: bool = ...,
    sectors: int = ...,
    rings: int = ...,
    ring_ratio: float = ...,
    max_steps: int = ...,
    end_tolerance: float = ...,
    max_length: float = ...,
    cut_vertices: ArrayLike | None = ...,
    edge_length: float = ...,
    places: int = ...,
    more_tried: int = ...,
    most_tried: int = ...,
    most_triangles: float = ...,
    progress: Progress | None = None,
) -> FittedPattern: ...
def base_complex(mesh: QuadMesh) -> BaseComplex: ...
def fewest_blocks(mesh: QuadMesh, faces: ArrayLike = ...) -> int: ...
def cut_along_features(surface: SurfaceDomain | TriangleMesh) -> FeatureCut: ...
def blunted_features(
    surface: SurfaceDomain | TriangleMesh, least_angle: float = ...
) -> tuple[SurfaceDomain, list[int]]: ...
def with_corner_quads(
    surface: SurfaceDomain | TriangleMesh, pattern: SingularPattern, corners: Sequence[CornerQuads]
) -> SingularPattern: ...
def finite_corner_quads(surface: SurfaceDomain | TriangleMesh, pattern: SingularPattern) -> list[CornerQuads]: ...
def quad_angle_quality(mesh: QuadMesh) -> Float64s: ...
@overload
def streamlines(
    field: DirectionField,
    singularities: SurfaceSingularities,
    triangles: ArrayLike,
    directions: ArrayLike,
    weights: ArrayLike | None = None,
    *,
    max_length: float = ...,
    both_ways: bool = ...,
    stop_at_features: bool = ...,
    singular_radius: float = ...,
) -> list[Streamline]: ...
@overload
def streamlines(
    field: NonOrthogonalField,
    singularities: SurfaceSingularities,
    triangles: ArrayLike,
    directions: ArrayLike,
    weights: ArrayLike | None = None,
    *,
    max_length: float = ...,
    both_ways: bool = ...,
    stop_at_features: bool = ...,
    singular_radius: float = ...,
) -> list[Streamline]: ...
@overload
def separatrices(
    field: DirectionField,
    singularities: SurfaceSingularities,
    *,
    max_length: float = ...,
    stop_at_features: bool = ...,
    singular_radius: float = ...,
    progress: Progress | None = None,
) -> list[Streamline]: ...
@overload
def separatrices(
    field: NonOrthogonalField,
    singularities: SurfaceSingularities,
    *,
    max_length: float = ...,
    stop_at_features: bool = ...,
    singular_radius: float = ...,
    progress: Progress | None = None,
) -> list[Streamline]: ...
def even_streamlines(
    field: DirectionField,
    singularities: SurfaceSingularities,
    *,
    spacing: float = ...,
    stop_ratio: float = ...,
    min_length: float = ...,
    max_length: float = ...,
    both_ways: bool = ...,
    stop_at_features: bool = ...,
    singular_radius: float = ...,
    progress: Progress | None = None,
) -> list[Streamline]: ...
def disk_renormalised_energy(points: ArrayLike) -> float: ...
def disk_polygon_energy(d: int, r: float) -> float: ...
def disk_polygon_radius(d: int) -> float: ...
def logarithmic_energy(points: ArrayLike) -> float: ...
def sphere_renormalised_energy(points: ArrayLike) -> float: ...
def asymptotic_energy(points: int, renormalised_energy: float, epsilon: float) -> float: ...

# ---- volume

class TetMesh:
    def __init__(self, vertices: ArrayLike = ..., tets: ArrayLike = ...) -> None: ...
    @property
    def vertices(self) -> Float64s: ...
    @vertices.setter
    def vertices(self, value: ArrayLike) -> None: ...
    @property
    def tets(self) -> Int32s: ...
    @tets.setter
    def tets(self, value: ArrayLike) -> None: ...

class TetDomain:
    def __init__(
        self, domain: TetDomain | TetMesh, *, regions: ArrayLike = ..., features: FeatureGraph | None = None
    ) -> None: ...
    @property
    def vertices(self) -> Float64s: ...
    @property
    def tets(self) -> Int32s: ...
    @property
    def regions(self) -> Int32s: ...
    @property
    def triangles(self) -> Int32s: ...
    @property
    def triangle_sides(self) -> Int32s: ...
    @property
    def tet_triangles(self) -> Int32s: ...
    @property
    def sides(self) -> Int32s: ...
    @property
    def surface_rows(self) -> Int32s: ...
    @property
    def mesh(self) -> TetMesh: ...
    @property
    def surface(self) -> BoundarySurface: ...
    @property
    def boundary(self) -> BoundarySurface: ...
    @property
    def interface_triangles(self) -> int: ...
    @property
    def sheets(self) -> Sheets: ...
    @property
    def features(self) -> FeatureGraph: ...
    @property
    def vertex_count(self) -> int: ...
    @property
    def tet_count(self) -> int: ...
    def with_features(self, features: FeatureGraph) -> TetDomain: ...
    @staticmethod
    def made() -> int: ...

class BoundarySurface:
    def __init__(self, mesh: TriangleMesh = ..., vertex_map: ArrayLike = ...) -> None: ...
    @property
    def mesh(self) -> TriangleMesh: ...
    @property
    def vertex_map(self) -> Int32s: ...
    @vertex_map.setter
    def vertex_map(self, value: ArrayLike) -> None: ...

class BoundaryConstraints:
    def __init__(
        self,
        kind: ArrayLike = ...,
        axis: ArrayLike = ...,
        frames: ArrayLike = ...,
        on_boundary: ArrayLike = ...,
        released_corners: ArrayLike = ...,
        lengths: ArrayLike = ...,
    ) -> None: ...
    @property
    def kind(self) -> UInt8s: ...
    @kind.setter
    def kind(self, value: ArrayLike) -> None: ...
    @property
    def axis(self) -> Float64s: ...
    @axis.setter
    def axis(self, value: ArrayLike) -> None: ...
    @property
    def frames(self) -> Float64s: ...
    @frames.setter
    def frames(self, value: ArrayLike) -> None: ...
    @property
    def on_boundary(self) -> UInt8s: ...
    @on_boundary.setter
    def on_boundary(self, value: ArrayLike) -> None: ...
    @property
    def released_corners(self) -> Int32s: ...
    @released_corners.setter
    def released_corners(self, value: ArrayLike) -> None: ...
    @property
    def lengths(self) -> Float64s: ...
    @lengths.setter
    def lengths(self, value: ArrayLike) -> None: ...

class SectorNormals:
    def __init__(self, vertex: ArrayLike = ..., normal: ArrayLike = ...) -> None: ...
    @property
    def vertex(self) -> Int32s: ...
    @vertex.setter
    def vertex(self, value: ArrayLike) -> None: ...
    @property
    def normal(self) -> Float64s: ...
    @normal.setter
    def normal(self, value: ArrayLike) -> None: ...

class SmoothResult:
    energy: float
    objective: float
    iterations: int
    converged: bool
    message: str
    def __init__(
        self,
        frames: ArrayLike = ...,
        energy: float = ...,
        objective: float = ...,
        iterations: int = ...,
        converged: bool = ...,
        message: str = ...,
        energy_history: ArrayLike = ...,
        objective_history: ArrayLike = ...,
        lengths: ArrayLike = ...,
    ) -> None: ...
    @property
    def frames(self) -> Float64s: ...
    @frames.setter
    def frames(self, value: ArrayLike) -> None: ...
    @property
    def energy_history(self) -> Float64s: ...
    @energy_history.setter
    def energy_history(self, value: ArrayLike) -> None: ...
    @property
    def objective_history(self) -> Float64s: ...
    @objective_history.setter
    def objective_history(self, value: ArrayLike) -> None: ...
    @property
    def lengths(self) -> Float64s: ...
    @lengths.setter
    def lengths(self, value: ArrayLike) -> None: ...

class FrameFieldResult:
    diffusion_steps: int
    def __init__(self, smooth: SmoothResult = ..., diffusion_steps: int = ...) -> None: ...
    @property
    def smooth(self) -> SmoothResult: ...

class SingularTriangle:
    a: int
    b: int
    c: int
    holonomy: int
    quarter_turns: int
    boundary: bool
    undecided: bool
    def __init__(
        self,
        a: int = ...,
        b: int = ...,
        c: int = ...,
        holonomy: int = ...,
        quarter_turns: int = ...,
        boundary: bool = ...,
        point: ArrayLike = ...,
        undecided: bool = ...,
    ) -> None: ...
    @property
    def point(self) -> Float64s: ...
    @point.setter
    def point(self, value: ArrayLike) -> None: ...

class SingularGraph:
    length: float
    complex_triangles: int
    undecided_triangles: int
    def __init__(
        self,
        triangles: Sequence[SingularTriangle] = ...,
        points: ArrayLike = ...,
        curves: Sequence[ArrayLike] = ...,
        curve_quarter_turns: ArrayLike = ...,
        nodes: ArrayLike = ...,
        length: float = ...,
        complex_triangles: int = ...,
        undecided_triangles: int = ...,
    ) -> None: ...
    @property
    def triangles(self) -> list[SingularTriangle]: ...
    @property
    def points(self) -> Float64s: ...
    @points.setter
    def points(self, value: ArrayLike) -> None: ...
    @property
    def curves(self) -> list[Int32s]: ...
    @property
    def curve_quarter_turns(self) -> Int32s: ...
    @curve_quarter_turns.setter
    def curve_quarter_turns(self, value: ArrayLike) -> None: ...
    @property
    def nodes(self) -> Int32s: ...
    @nodes.setter
    def nodes(self, value: ArrayLike) -> None: ...

def tetrahedralize(
    mesh: TriangleMesh,
    *,
    radius_edge_ratio: float = ...,
    min_dihedral: float = ...,
    edge_length: float = ...,
    notes: list[str] | None = None,
    progress: Progress | None = None,
) -> TetMesh: ...
def tet_volumes(domain: TetDomain | TetMesh) -> Float64s: ...
def boundary_surface(domain: TetDomain | TetMesh) -> BoundarySurface: ...
def stiffness(domain: TetDomain | TetMesh) -> csc_matrix: ...
def mass(domain: TetDomain | TetMesh) -> csc_matrix: ...
def lumped_mass(domain: TetDomain | TetMesh) -> Float64s: ...
def dirichlet_energy(domain: TetDomain | TetMesh | Sampling, frames: ArrayLike, *, threads: int = 0) -> float: ...

class Sampling:
    def __init__(
        self,
        stiffness: Any,
        mass: ArrayLike,
        body_radius: float,
        edge_length: float,
        size: float,
        sites: str = ...,
    ) -> None: ...
    @property
    def sites(self) -> str: ...
    @property
    def stiffness(self) -> csc_matrix: ...
    @property
    def mass(self) -> Float64s: ...
    @property
    def body_radius(self) -> float: ...
    @property
    def edge_length(self) -> float: ...
    @property
    def size(self) -> float: ...
    def __len__(self) -> int: ...

class SingularEdge:
    a: int
    b: int
    holonomy: int
    quarter_turns: int
    valence: int
    undecided: bool
    def __init__(
        self,
        a: int = ...,
        b: int = ...,
        holonomy: int = ...,
        quarter_turns: int = ...,
        valence: int = ...,
        undecided: bool = ...,
    ) -> None: ...

class SingularEdges:
    complex_edges: int
    undecided_edges: int
    tied_triangles: int
    def __init__(
        self,
        edges: Sequence[SingularEdge] = ...,
        complex_edges: int = ...,
        undecided_edges: int = ...,
        tied_triangles: int = ...,
        graph: SingularGraph = ...,
        vertices: ArrayLike = ...,
    ) -> None: ...
    @property
    def edges(self) -> list[SingularEdge]: ...
    @property
    def graph(self) -> SingularGraph: ...
    @property
    def vertices(self) -> Int32s: ...
    @vertices.setter
    def vertices(self, value: ArrayLike) -> None: ...

def vertex_sampling(domain: TetDomain | TetMesh) -> Sampling: ...
def tet_sampling(domain: TetDomain | TetMesh) -> Sampling: ...
def vertex_frames(domain: TetDomain | TetMesh, of_tets: ArrayLike, *, threads: int = 0) -> Float64s: ...
def tet_boundary_constraints(
    domain: TetDomain | TetMesh,
    directions: ArrayLike,
    *,
    mode: str = ...,
    feature_tolerance: float = ...,
) -> BoundaryConstraints: ...
def tet_alignment_angles(domain: TetDomain | TetMesh, frames: ArrayLike) -> Float64s: ...
def singular_edges(domain: TetDomain | TetMesh, of_tets: ArrayLike, *, threads: int = 0) -> SingularEdges: ...
def sector_normals(domain: TetDomain | TetMesh) -> SectorNormals: ...
def boundary_constraints(
    domain: TetDomain | TetMesh,
    directions: ArrayLike,
    *,
    mode: str = ...,
    feature_tolerance: float = ...,
    stretch: ArrayLike | None = None,
) -> BoundaryConstraints: ...
def alignment_angles(
    domain: TetDomain | TetMesh, frames: ArrayLike, *, stretch: ArrayLike | None = None
) -> Float64s: ...
def axes_stretch(
    domain: TetDomain | TetMesh, *, corner_angle: float = ..., least_deviation: float = ...
) -> AxesStretch: ...
def stretched_axes(frames: ArrayLike, stretch: ArrayLike) -> Float64s: ...

class AxesStretchOptions:
    corner_angle: float
    least_deviation: float
    def __init__(self, corner_angle: float = ..., least_deviation: float = ...) -> None: ...

class AxesStretch:
    def __init__(
        self, values: ArrayLike = ..., followed: ArrayLike = ..., sharp: ArrayLike = ..., needles: ArrayLike = ...
    ) -> None: ...
    @property
    def values(self) -> Float64s: ...
    @values.setter
    def values(self, value: ArrayLike) -> None: ...
    @property
    def followed(self) -> Int32s: ...
    @followed.setter
    def followed(self, value: ArrayLike) -> None: ...
    @property
    def sharp(self) -> Int32s: ...
    @sharp.setter
    def sharp(self, value: ArrayLike) -> None: ...
    @property
    def needles(self) -> Int32s: ...
    @needles.setter
    def needles(self, value: ArrayLike) -> None: ...

class FeatureOptions:
    angle: float
    corner_angle: float
    def __init__(self, angle: float = ..., corner_angle: float = ...) -> None: ...

class RemeshOptions:
    edge_length: float
    iterations: int
    max_cells: float
    def __init__(self, edge_length: float = ..., iterations: int = ..., max_cells: float = ...) -> None: ...

class SizeFieldOptions:
    longest: float
    shortest: float
    angle: float
    growth: float
    max_cells: float
    def __init__(
        self,
        longest: float = ...,
        shortest: float = ...,
        angle: float = ...,
        growth: float = ...,
        max_cells: float = ...,
    ) -> None: ...

direction_field_methods: dict[str, str]
"""What each method for direction fields is, by its name."""

class DirectionFieldOptions:
    words: ClassVar[dict[str, list[str]]]
    symmetry: int
    method: str
    epsilon: float
    first_epsilon: float
    max_iterations: int
    tolerance: float
    energy_tolerance: float
    seed: int
    boundary_alignment: str
    feature_alignment: str
    alignment_length: float
    least_feature_angle: float
    corner_tolerance: float
    def __init__(
        self,
        symmetry: int = ...,
        method: str = ...,
        epsilon: float = ...,
        edge_epsilon: ArrayLike = ...,
        first_epsilon: float = ...,
        max_iterations: int = ...,
        tolerance: float = ...,
        energy_tolerance: float = ...,
        seed: int = ...,
        boundary_alignment: str = ...,
        feature_alignment: str = ...,
        alignment_length: float = ...,
        least_feature_angle: float = ...,
        corner_tolerance: float = ...,
        constraints: DirectionConstraints = ...,
        guide: DirectionGuide = ...,
    ) -> None: ...
    @property
    def edge_epsilon(self) -> Float64s: ...
    @edge_epsilon.setter
    def edge_epsilon(self, value: ArrayLike) -> None: ...
    @property
    def constraints(self) -> DirectionConstraints: ...
    @property
    def guide(self) -> DirectionGuide: ...

non_orthogonal_field_methods: dict[str, str]
"""What each method for non-orthogonal fields is, by its name."""

class NonOrthogonalFieldOptions:
    words: ClassVar[dict[str, list[str]]]
    method: str
    lambda_: float
    weights: str
    second_line: str
    corner_angle: float
    least_angle: float
    max_iterations: int
    seed: int
    inertia: float
    penalty: float
    tolerance: float
    def __init__(
        self,
        method: str = ...,
        lambda_: float = ...,
        weights: str = ...,
        second_line: str = ...,
        corner_angle: float = ...,
        corners: ArrayLike | Sequence[CornerQuads] = ...,
        least_angle: float = ...,
        max_iterations: int = ...,
        seed: int = ...,
        inertia: float = ...,
        penalty: float = ...,
        tolerance: float = ...,
    ) -> None: ...
    @property
    def corners(self) -> Int32s: ...
    @corners.setter
    def corners(self, value: ArrayLike | Sequence[CornerQuads] | None) -> None: ...

class BoundaryOptions:
    words: ClassVar[dict[str, list[str]]]
    mode: str
    feature_tolerance: float
    def __init__(self, mode: str = ..., feature_tolerance: float = ...) -> None: ...

class DiffuseOptions:
    first_time: float
    last_time: float
    time_exponent: float
    max_steps: int
    linear_tolerance: float
    keep_best: bool
    threads: int
    def __init__(
        self,
        first_time: float = ...,
        last_time: float = ...,
        time_exponent: float = ...,
        max_steps: int = ...,
        linear_tolerance: float = ...,
        keep_best: bool = ...,
        threads: int = ...,
    ) -> None: ...

class SmoothOptions:
    words: ClassVar[dict[str, list[str]]]
    representation: str | OwnScheme
    solver: str
    max_iterations: int
    tolerance: float
    linear_solver: str
    midpoint_limit: float
    threads: int
    def __init__(
        self,
        representation: str | OwnScheme = ...,
        solver: str = ...,
        max_iterations: int = ...,
        tolerance: float = ...,
        linear_solver: str = ...,
        midpoint_limit: float = ...,
        threads: int = ...,
    ) -> None: ...

class FrameFieldOptions:
    words: ClassVar[dict[str, list[str]]]
    start: str
    seed: int
    rounds: int
    round_time: float
    threads: int
    def __init__(
        self,
        start: str = ...,
        seed: int = ...,
        rounds: int = ...,
        round_time: float = ...,
        diffuse: DiffuseOptions = ...,
        smooth: SmoothOptions = ...,
        threads: int = ...,
    ) -> None: ...
    @property
    def diffuse(self) -> DiffuseOptions: ...
    @property
    def smooth(self) -> SmoothOptions: ...

class Scheme:
    @property
    def name(self) -> str: ...
    @property
    def sort(self) -> Literal["embedding", "embedding_with_lengths", "metric"]: ...
    @property
    def equation(self) -> str: ...
    @property
    def meaning(self) -> str: ...
    @property
    def consistent(self) -> bool: ...
    @property
    def descends(self) -> bool: ...
    @property
    def bytes_per_tet(self) -> dict[str, float]: ...
    @property
    def seconds_per_million_tets(self) -> float: ...
    @property
    def colour(self) -> str: ...
    @property
    def compared(self) -> bool: ...

schemes: dict[str, Scheme]
constraint_kinds: tuple[str, ...]

def scheme_energy(
    scheme: OwnScheme, domain: TetDomain | TetMesh | Sampling, frames: ArrayLike, *, threads: int = 0
) -> float: ...
def initial_frames(
    domain: TetDomain | TetMesh | Sampling, constraints: BoundaryConstraints, *, start: str = ..., threads: int = ...
) -> Float64s: ...
def diffuse(
    domain: TetDomain | TetMesh | Sampling,
    constraints: BoundaryConstraints,
    start: ArrayLike,
    *,
    first_time: float = ...,
    last_time: float = ...,
    time_exponent: float = ...,
    max_steps: int = ...,
    linear_tolerance: float = ...,
    keep_best: bool = ...,
    threads: int = ...,
    progress: Progress | None = None,
) -> SmoothResult: ...
def smooth(
    domain: TetDomain | TetMesh | Sampling,
    constraints: BoundaryConstraints,
    start: ArrayLike,
    *,
    representation: str | OwnScheme = ...,
    solver: str = ...,
    max_iterations: int = ...,
    tolerance: float = ...,
    linear_solver: str = ...,
    midpoint_limit: float = ...,
    threads: int = ...,
    progress: Progress | None = None,
) -> SmoothResult: ...
def frame_field(
    domain: TetDomain | TetMesh | Sampling,
    constraints: BoundaryConstraints,
    *,
    start: str = ...,
    seed: int = ...,
    rounds: int = ...,
    round_time: float = ...,
    threads: int = ...,
    first_time: float = ...,
    last_time: float = ...,
    time_exponent: float = ...,
    max_steps: int = ...,
    linear_tolerance: float = ...,
    keep_best: bool = ...,
    representation: str | OwnScheme = ...,
    solver: str = ...,
    max_iterations: int = ...,
    tolerance: float = ...,
    linear_solver: str = ...,
    midpoint_limit: float = ...,
    progress: Progress | None = None,
) -> FrameFieldResult: ...
def singular_graph(domain: TetDomain | TetMesh, frames: ArrayLike, *, threads: int = 0) -> SingularGraph: ...
def write_field(
    path: Path,
    domain: TetDomain | TetMesh,
    frames: ArrayLike,
    metadata: Mapping[str, str] = ...,
    *,
    tet_frames: ArrayLike = ...,
    lengths: ArrayLike = ...,
    tet_lengths: ArrayLike = ...,
    point_data: Mapping[str, ArrayLike] = ...,
    cell_data: Mapping[str, ArrayLike] = ...,
    features: ArrayLike = ...,
    stretch: ArrayLike | None = None,
) -> None: ...
def write_singular_graph(
    path: Path, graph: SingularGraph, metadata: Mapping[str, str] = ..., meshability: Meshability | None = None
) -> None: ...
def write_surface_field(
    path: Path, mesh: TriangleMesh, directions: ArrayLike, metadata: Mapping[str, str] = ...
) -> None: ...

class SingularVertex:
    words: ClassVar[dict[str, list[str]]]
    point: int
    kind: str
    valence2: int
    valence3: int
    valence5: int
    valence6: int
    complex: int
    about_normal: bool
    one_axis: bool
    meshable: bool
    junction: int
    valence1: int
    valence7: int
    valence8: int
    def __init__(
        self,
        point: int = ...,
        kind: str = ...,
        valence2: int = ...,
        valence3: int = ...,
        valence5: int = ...,
        valence6: int = ...,
        complex: int = ...,
        about_normal: bool = ...,
        one_axis: bool = ...,
        meshable: bool = ...,
        junction: int = ...,
        valence1: int = ...,
        valence7: int = ...,
        valence8: int = ...,
    ) -> None: ...

class SingularEnd:
    vertex: int
    curve: int
    quarter_turns: int
    angle: float
    def __init__(
        self,
        vertex: int = ...,
        curve: int = ...,
        quarter_turns: int = ...,
        axis: ArrayLike = ...,
        angle: float = ...,
    ) -> None: ...
    @property
    def axis(self) -> Float64s: ...
    @axis.setter
    def axis(self, value: ArrayLike) -> None: ...

class SingularJunction:
    vertices: int
    valence2: int
    valence3: int
    valence5: int
    valence6: int
    complex: int
    meshable: bool
    valence1: int
    valence7: int
    valence8: int
    def __init__(
        self,
        vertices: int = ...,
        valence2: int = ...,
        valence3: int = ...,
        valence5: int = ...,
        valence6: int = ...,
        complex: int = ...,
        meshable: bool = ...,
        valence1: int = ...,
        valence7: int = ...,
        valence8: int = ...,
    ) -> None: ...

class Meshability:
    non_meshable_vertices: int
    non_meshable_junctions: int
    non_meshable_curves: int
    closed_curves: int
    boundary_ends: int
    boundary_ends_about_normal: int
    def __init__(
        self,
        vertices: Sequence[SingularVertex] = ...,
        junctions: Sequence[SingularJunction] = ...,
        ends: Sequence[SingularEnd] = ...,
        curve_ends: ArrayLike = ...,
        non_meshable_vertices: int = ...,
        non_meshable_junctions: int = ...,
        non_meshable_curves: int = ...,
        closed_curves: int = ...,
        boundary_ends: int = ...,
        boundary_ends_about_normal: int = ...,
    ) -> None: ...
    @property
    def vertices(self) -> list[SingularVertex]: ...
    @property
    def junctions(self) -> list[SingularJunction]: ...
    @property
    def ends(self) -> list[SingularEnd]: ...
    @property
    def curve_ends(self) -> Int32s: ...
    @curve_ends.setter
    def curve_ends(self, value: ArrayLike) -> None: ...

no_number: int

class FeatureWedge:
    a: int
    b: int
    angle: float
    hexahedra_a: int
    hexahedra_b: int
    around: int
    meshable: bool
    def __init__(
        self,
        a: int = ...,
        b: int = ...,
        angle: float = ...,
        hexahedra_a: int = ...,
        hexahedra_b: int = ...,
        around: int = ...,
        meshable: bool = ...,
    ) -> None: ...

class SurfaceCrossing:
    a: int
    b: int
    hexahedra: int
    def __init__(self, a: int = ..., b: int = ..., hexahedra: int = ...) -> None: ...

class SurfaceCorner:
    vertex: int
    feature_edges: int
    sectors: int
    inside: int
    empty_sectors: int
    unclear_sectors: int
    non_meshable_edges: int
    meshable: bool
    def __init__(
        self,
        vertex: int = ...,
        feature_edges: int = ...,
        sectors: int = ...,
        inside: int = ...,
        empty_sectors: int = ...,
        unclear_sectors: int = ...,
        non_meshable_edges: int = ...,
        meshable: bool = ...,
    ) -> None: ...

class BoundaryMeshability:
    non_meshable_wedges: int
    non_meshable_crossings: int
    non_meshable_corners: int
    def __init__(
        self,
        wedges: Sequence[FeatureWedge] = ...,
        crossings: Sequence[SurfaceCrossing] = ...,
        corners: Sequence[SurfaceCorner] = ...,
        non_meshable_wedges: int = ...,
        non_meshable_crossings: int = ...,
        non_meshable_corners: int = ...,
    ) -> None: ...
    @property
    def wedges(self) -> list[FeatureWedge]: ...
    @property
    def crossings(self) -> list[SurfaceCrossing]: ...
    @property
    def corners(self) -> list[SurfaceCorner]: ...

class SmoothedCurves:
    length: float
    def __init__(self, points: ArrayLike = ..., lengths: ArrayLike = ..., length: float = ...) -> None: ...
    @property
    def points(self) -> Float64s: ...
    @points.setter
    def points(self, value: ArrayLike) -> None: ...
    @property
    def lengths(self) -> Float64s: ...
    @lengths.setter
    def lengths(self, value: ArrayLike) -> None: ...

class Integrability:
    jump_rms: float
    jump_max: float
    twist_rms: float
    twist_max: float
    def __init__(
        self,
        jump_rms: float = ...,
        jump_max: float = ...,
        twist_rms: float = ...,
        twist_max: float = ...,
        twist: ArrayLike = ...,
    ) -> None: ...
    @property
    def twist(self) -> Float64s: ...
    @twist.setter
    def twist(self, value: ArrayLike) -> None: ...

class FeatureTangents:
    def __init__(self, vertex: ArrayLike = ..., tangent: ArrayLike = ...) -> None: ...
    @property
    def vertex(self) -> Int32s: ...
    @vertex.setter
    def vertex(self, value: ArrayLike) -> None: ...
    @property
    def tangent(self) -> Float64s: ...
    @tangent.setter
    def tangent(self, value: ArrayLike) -> None: ...

def hex_vertex_exists(
    valence3: int, valence5: int, valence6: int = ..., valence7: int = ..., valence8: int = ...
) -> bool: ...
def local_meshability(
    domain: TetDomain | TetMesh, frames: ArrayLike, graph: SingularGraph, *, stretch: ArrayLike | None = None
) -> Meshability: ...
def tet_meshability(
    domain: TetDomain | TetMesh,
    of_tets: ArrayLike,
    singular: SingularEdges,
) -> Meshability: ...
def tet_boundary_meshability(
    domain: TetDomain | TetMesh, of_tets: ArrayLike, *, threads: int = 0
) -> BoundaryMeshability: ...
def boundary_meshability(
    domain: TetDomain | TetMesh, frames: ArrayLike, *, stretch: ArrayLike | None = None, threads: int = 0
) -> BoundaryMeshability: ...
def wedge_alignment(
    domain: TetDomain | TetMesh, frames: ArrayLike, *, stretch: ArrayLike | None = None, threads: int = 0
) -> Float64s: ...
def smoothed_curves(graph: SingularGraph, *, steps: int = ...) -> SmoothedCurves: ...
def integrability(domain: TetDomain | TetMesh, frames: ArrayLike, *, threads: int = 0) -> Integrability: ...
def tet_frames(domain: TetDomain | TetMesh, frames: ArrayLike, *, threads: int = 0) -> Float64s: ...
def feature_tangents(domain: TetDomain | TetMesh) -> FeatureTangents: ...
def feature_alignment_angles(
    domain: TetDomain | TetMesh, frames: ArrayLike, *, stretch: ArrayLike | None = None
) -> Float64s: ...

class FaceMatchings:
    def __init__(self, triangles: ArrayLike = ..., tets: ArrayLike = ..., matching: ArrayLike = ...) -> None: ...
    @property
    def triangles(self) -> Int32s: ...
    @triangles.setter
    def triangles(self, value: ArrayLike) -> None: ...
    @property
    def tets(self) -> Int32s: ...
    @tets.setter
    def tets(self, value: ArrayLike) -> None: ...
    @property
    def matching(self) -> UInt8s: ...
    @matching.setter
    def matching(self, value: ArrayLike) -> None: ...

class CombedField:
    parts: int
    def __init__(
        self,
        frames: ArrayLike = ...,
        element: ArrayLike = ...,
        faces: FaceMatchings = ...,
        cut: ArrayLike = ...,
        parts: int = ...,
    ) -> None: ...
    @property
    def frames(self) -> Float64s: ...
    @frames.setter
    def frames(self, value: ArrayLike) -> None: ...
    @property
    def element(self) -> UInt8s: ...
    @element.setter
    def element(self, value: ArrayLike) -> None: ...
    @property
    def faces(self) -> FaceMatchings: ...
    @property
    def cut(self) -> UInt8s: ...
    @cut.setter
    def cut(self, value: ArrayLike) -> None: ...

class CombedVertices:
    parts: int
    def __init__(
        self, frames: ArrayLike = ..., element: ArrayLike = ..., agree: ArrayLike = ..., parts: int = ...
    ) -> None: ...
    @property
    def frames(self) -> Float64s: ...
    @frames.setter
    def frames(self, value: ArrayLike) -> None: ...
    @property
    def element(self) -> UInt8s: ...
    @element.setter
    def element(self, value: ArrayLike) -> None: ...
    @property
    def agree(self) -> UInt8s: ...
    @agree.setter
    def agree(self, value: ArrayLike) -> None: ...

class AlignmentTables:
    def __init__(
        self,
        triangle_tet: ArrayLike = ...,
        triangle_axis: ArrayLike = ...,
        triangle_angle: ArrayLike = ...,
        triangle_patch: ArrayLike = ...,
        patch_one_axis: ArrayLike = ...,
        feature_edges: ArrayLike = ...,
        feature_tet: ArrayLike = ...,
        feature_axis: ArrayLike = ...,
        feature_angle: ArrayLike = ...,
    ) -> None: ...
    @property
    def triangle_tet(self) -> Int32s: ...
    @triangle_tet.setter
    def triangle_tet(self, value: ArrayLike) -> None: ...
    @property
    def triangle_axis(self) -> Int32s: ...
    @triangle_axis.setter
    def triangle_axis(self, value: ArrayLike) -> None: ...
    @property
    def triangle_angle(self) -> Float64s: ...
    @triangle_angle.setter
    def triangle_angle(self, value: ArrayLike) -> None: ...
    @property
    def triangle_patch(self) -> Int32s: ...
    @triangle_patch.setter
    def triangle_patch(self, value: ArrayLike) -> None: ...
    @property
    def patch_one_axis(self) -> UInt8s: ...
    @patch_one_axis.setter
    def patch_one_axis(self, value: ArrayLike) -> None: ...
    @property
    def feature_edges(self) -> Int32s: ...
    @feature_edges.setter
    def feature_edges(self, value: ArrayLike) -> None: ...
    @property
    def feature_tet(self) -> Int32s: ...
    @feature_tet.setter
    def feature_tet(self, value: ArrayLike) -> None: ...
    @property
    def feature_axis(self) -> Int32s: ...
    @feature_axis.setter
    def feature_axis(self, value: ArrayLike) -> None: ...
    @property
    def feature_angle(self) -> Float64s: ...
    @feature_angle.setter
    def feature_angle(self, value: ArrayLike) -> None: ...

class ScaledIntegrability:
    curl_rms: float
    curl_max: float
    jump_rms: float
    jump_max: float
    def __init__(
        self,
        curl_rms: float = ...,
        curl_max: float = ...,
        jump_rms: float = ...,
        jump_max: float = ...,
        curl: ArrayLike = ...,
    ) -> None: ...
    @property
    def curl(self) -> Float64s: ...
    @curl.setter
    def curl(self, value: ArrayLike) -> None: ...

class IsotropicScale:
    parts: int
    iterations: int
    def __init__(
        self,
        log_scale: ArrayLike = ...,
        before: ScaledIntegrability = ...,
        after: ScaledIntegrability = ...,
        parts: int = ...,
        iterations: int = ...,
    ) -> None: ...
    @property
    def log_scale(self) -> Float64s: ...
    @log_scale.setter
    def log_scale(self, value: ArrayLike) -> None: ...
    @property
    def before(self) -> ScaledIntegrability: ...
    @property
    def after(self) -> ScaledIntegrability: ...

class AxisScales:
    parts: int
    iterations: int
    def __init__(
        self,
        values: ArrayLike = ...,
        unknowns: ArrayLike = ...,
        log_scales: ArrayLike = ...,
        of_tets: ArrayLike = ...,
        before: ScaledIntegrability = ...,
        after: ScaledIntegrability = ...,
        parts: int = ...,
        iterations: int = ...,
    ) -> None: ...
    @property
    def values(self) -> Float64s: ...
    @values.setter
    def values(self, value: ArrayLike) -> None: ...
    @property
    def unknowns(self) -> Int32s: ...
    @unknowns.setter
    def unknowns(self, value: ArrayLike) -> None: ...
    @property
    def log_scales(self) -> Float64s: ...
    @log_scales.setter
    def log_scales(self, value: ArrayLike) -> None: ...
    @property
    def of_tets(self) -> Float64s: ...
    @of_tets.setter
    def of_tets(self, value: ArrayLike) -> None: ...
    @property
    def before(self) -> ScaledIntegrability: ...
    @property
    def after(self) -> ScaledIntegrability: ...

def face_matchings(domain: TetDomain | TetMesh, of_tets: ArrayLike, *, threads: int = 0) -> FaceMatchings: ...
def comb_vertices(domain: TetDomain | TetMesh, frames: ArrayLike, *, threads: int = 0) -> CombedVertices: ...
def axes_agree(domain: TetDomain | TetMesh, frames: ArrayLike, *, threads: int = 0) -> UInt8s: ...
def comb(domain: TetDomain | TetMesh, of_tets: ArrayLike, *, threads: int = 0) -> CombedField: ...
def alignment_tables(domain: TetDomain | TetMesh, combed: CombedField) -> AlignmentTables: ...
def isotropic_scale(domain: TetDomain | TetMesh, frames: ArrayLike, *, threads: int = 0) -> IsotropicScale: ...
def axis_scales(
    domain: TetDomain | TetMesh, frames: ArrayLike, *, along: float = ..., threads: int = 0
) -> AxisScales: ...

# ---- volume: streamlines

class FrameStreamline:
    words: ClassVar[dict[str, list[str]]]
    length: float
    first_end: str
    last_end: str
    def __init__(
        self,
        points: ArrayLike = ...,
        tets: ArrayLike = ...,
        length: float = ...,
        first_end: str = ...,
        last_end: str = ...,
    ) -> None: ...
    @property
    def points(self) -> Float64s: ...
    @points.setter
    def points(self, value: ArrayLike) -> None: ...
    @property
    def tets(self) -> Int32s: ...
    @tets.setter
    def tets(self, value: ArrayLike) -> None: ...

class LocatedPoints:
    def __init__(self, tet: ArrayLike = ..., weights: ArrayLike = ...) -> None: ...
    @property
    def tet(self) -> Int32s: ...
    @tet.setter
    def tet(self, value: ArrayLike) -> None: ...
    @property
    def weights(self) -> Float64s: ...
    @weights.setter
    def weights(self, value: ArrayLike) -> None: ...

class SampledFrames:
    def __init__(
        self, frames: ArrayLike = ..., confidence: ArrayLike = ..., tet: ArrayLike = ..., distance: ArrayLike = ...
    ) -> None: ...
    @property
    def frames(self) -> Float64s: ...
    @frames.setter
    def frames(self, value: ArrayLike) -> None: ...
    @property
    def confidence(self) -> Float64s: ...
    @confidence.setter
    def confidence(self, value: ArrayLike) -> None: ...
    @property
    def tet(self) -> Int32s: ...
    @tet.setter
    def tet(self, value: ArrayLike) -> None: ...
    @property
    def distance(self) -> Float64s: ...
    @distance.setter
    def distance(self, value: ArrayLike) -> None: ...

def locate_points(domain: TetDomain | TetMesh, points: ArrayLike, *, threads: int = 0) -> LocatedPoints: ...
def interpolate_frames(
    domain: TetDomain | TetMesh, frames: ArrayLike, points: ArrayLike, *, tolerance: float = ..., threads: int = 0
) -> SampledFrames: ...
def spread_points(domain: TetDomain | TetMesh, count: int) -> Float64s: ...
def frame_streamlines(
    domain: TetDomain | TetMesh,
    frames: ArrayLike,
    points: ArrayLike,
    directions: ArrayLike | None = None,
    *,
    stretch: ArrayLike | None = None,
    max_length: float = ...,
    both_ways: bool = ...,
    closing_distance: float = ...,
    threads: int = 0,
) -> list[FrameStreamline]: ...

# ---- volume: input

class Sheets:
    def __init__(
        self,
        mesh: TriangleMesh = ...,
        vertex_map: ArrayLike = ...,
        cuts: ArrayLike = ...,
    ) -> None: ...
    @property
    def mesh(self) -> TriangleMesh: ...
    @property
    def vertex_map(self) -> Int32s: ...
    @vertex_map.setter
    def vertex_map(self, value: ArrayLike) -> None: ...
    @property
    def cuts(self) -> Int32s: ...
    @cuts.setter
    def cuts(self, value: ArrayLike) -> None: ...

class LockingElements:
    def __init__(
        self,
        tets: ArrayLike = ...,
        edges: ArrayLike = ...,
        triangles: ArrayLike = ...,
    ) -> None: ...
    @property
    def tets(self) -> Int32s: ...
    @tets.setter
    def tets(self, value: ArrayLike) -> None: ...
    @property
    def edges(self) -> Int32s: ...
    @edges.setter
    def edges(self, value: ArrayLike) -> None: ...
    @property
    def triangles(self) -> Int32s: ...
    @triangles.setter
    def triangles(self, value: ArrayLike) -> None: ...

class LockingSplit:
    added_vertices: int
    def __init__(
        self,
        domain: TetDomain | TetMesh = ...,
        parent: ArrayLike = ...,
        found: LockingElements = ...,
        added_vertices: int = ...,
        left: ArrayLike = ...,
    ) -> None: ...
    @property
    def mesh(self) -> TetMesh: ...
    @property
    def parent(self) -> Int32s: ...
    @parent.setter
    def parent(self, value: ArrayLike) -> None: ...
    @property
    def found(self) -> LockingElements: ...
    @property
    def left(self) -> Int32s: ...
    @left.setter
    def left(self, value: ArrayLike) -> None: ...

class SingularSplit:
    added_vertices: int
    def __init__(
        self,
        domain: TetDomain | TetMesh = ...,
        parent: ArrayLike = ...,
        edges: ArrayLike = ...,
        left: ArrayLike = ...,
        added_vertices: int = ...,
    ) -> None: ...
    @property
    def mesh(self) -> TetMesh: ...
    @property
    def parent(self) -> Int32s: ...
    @parent.setter
    def parent(self, value: ArrayLike) -> None: ...
    @property
    def edges(self) -> Int32s: ...
    @edges.setter
    def edges(self, value: ArrayLike) -> None: ...
    @property
    def left(self) -> Int32s: ...
    @left.setter
    def left(self, value: ArrayLike) -> None: ...

class VertexConstraints:
    def __init__(
        self,
        vertices: ArrayLike = ...,
        kinds: ArrayLike = ...,
        axes: ArrayLike = ...,
        frames: ArrayLike = ...,
    ) -> None: ...
    @property
    def vertices(self) -> Int32s: ...
    @vertices.setter
    def vertices(self, value: ArrayLike) -> None: ...
    @property
    def kinds(self) -> UInt8s: ...
    @kinds.setter
    def kinds(self, value: ArrayLike) -> None: ...
    @property
    def axes(self) -> Float64s: ...
    @axes.setter
    def axes(self, value: ArrayLike) -> None: ...
    @property
    def frames(self) -> Float64s: ...
    @frames.setter
    def frames(self, value: ArrayLike) -> None: ...

def features_on_sheets(features: FeatureGraph, sheets: Sheets) -> FeatureGraph: ...
def cut_into_sheets(surface: TriangleMesh) -> Sheets: ...
def find_locking(domain: TetDomain | TetMesh) -> LockingElements: ...
def split_locking(domain: TetDomain | TetMesh) -> LockingSplit: ...
def split_between_singular(domain: TetDomain | TetMesh, of_tets: ArrayLike, *, threads: int = 0) -> SingularSplit: ...
def with_constraints(base: BoundaryConstraints, given: VertexConstraints) -> BoundaryConstraints: ...

class FieldAnalysis:
    energy: float
    def __init__(
        self,
        energy: float = ...,
        singular_graph: SingularGraph = ...,
        meshability: Meshability = ...,
        boundary_meshability: BoundaryMeshability = ...,
        integrability: Integrability = ...,
        alignment: ArrayLike = ...,
        feature_alignment: ArrayLike = ...,
    ) -> None: ...
    @property
    def singular_graph(self) -> SingularGraph: ...
    @property
    def meshability(self) -> Meshability: ...
    @property
    def boundary_meshability(self) -> BoundaryMeshability: ...
    @property
    def integrability(self) -> Integrability: ...
    @property
    def alignment(self) -> Float64s: ...
    @alignment.setter
    def alignment(self, value: ArrayLike) -> None: ...
    @property
    def feature_alignment(self) -> Float64s: ...
    @feature_alignment.setter
    def feature_alignment(self, value: ArrayLike) -> None: ...

class TetFieldAnalysis:
    energy: float
    energy_at_vertices: float
    def __init__(
        self,
        energy: float = ...,
        energy_at_vertices: float = ...,
        vertex_frames: ArrayLike = ...,
        singular_edges: SingularEdges = ...,
        meshability: Meshability = ...,
        boundary_meshability: BoundaryMeshability = ...,
        alignment: ArrayLike = ...,
        feature_alignment: ArrayLike = ...,
    ) -> None: ...
    @property
    def vertex_frames(self) -> Float64s: ...
    @vertex_frames.setter
    def vertex_frames(self, value: ArrayLike) -> None: ...
    @property
    def singular_edges(self) -> SingularEdges: ...
    @property
    def meshability(self) -> Meshability: ...
    @property
    def boundary_meshability(self) -> BoundaryMeshability: ...
    @property
    def alignment(self) -> Float64s: ...
    @alignment.setter
    def alignment(self, value: ArrayLike) -> None: ...
    @property
    def feature_alignment(self) -> Float64s: ...
    @feature_alignment.setter
    def feature_alignment(self, value: ArrayLike) -> None: ...

class ComputedField:
    def __init__(
        self,
        cross_field: DirectionField = ...,
        stretch: AxesStretch = ...,
        constraints: BoundaryConstraints = ...,
        solved: FrameFieldResult = ...,
        combed: CombedVertices = ...,
        analysis: FieldAnalysis = ...,
    ) -> None: ...
    @property
    def cross_field(self) -> DirectionField: ...
    @property
    def stretch(self) -> AxesStretch: ...
    @property
    def constraints(self) -> BoundaryConstraints: ...
    @property
    def solved(self) -> FrameFieldResult: ...
    @property
    def combed(self) -> CombedVertices: ...
    @property
    def analysis(self) -> FieldAnalysis: ...

class ComputedTetField:
    def __init__(
        self,
        cross_field: DirectionField = ...,
        constraints: BoundaryConstraints = ...,
        solved: FrameFieldResult = ...,
        combed: CombedVertices = ...,
        analysis: TetFieldAnalysis = ...,
    ) -> None: ...
    @property
    def cross_field(self) -> DirectionField: ...
    @property
    def constraints(self) -> BoundaryConstraints: ...
    @property
    def solved(self) -> FrameFieldResult: ...
    @property
    def combed(self) -> CombedVertices: ...
    @property
    def analysis(self) -> TetFieldAnalysis: ...

def sheet_domain(domain: TetDomain | TetMesh) -> SurfaceDomain: ...
def surface_constraints(
    domain: TetDomain | TetMesh,
    cross: DirectionField,
    *,
    mode: str = ...,
    feature_tolerance: float = ...,
    sites: str = ...,
    stretch: ArrayLike | None = None,
) -> BoundaryConstraints: ...
def analyse_field(
    domain: TetDomain | TetMesh, frames: ArrayLike, *, stretch: ArrayLike | None = None, threads: int = 0
) -> FieldAnalysis: ...
def analyse_tet_field(
    domain: TetDomain | TetMesh, sampling: Sampling, of_tets: ArrayLike, *, threads: int = 0
) -> TetFieldAnalysis: ...
def computed_field(
    domain: TetDomain | TetMesh,
    *,
    mode: str = ...,
    feature_tolerance: float = ...,
    start: str = ...,
    seed: int = ...,
    rounds: int = ...,
    round_time: float = ...,
    threads: int = ...,
    first_time: float = ...,
    last_time: float = ...,
    time_exponent: float = ...,
    max_steps: int = ...,
    linear_tolerance: float = ...,
    keep_best: bool = ...,
    representation: str = ...,
    solver: str = ...,
    max_iterations: int = ...,
    tolerance: float = ...,
    linear_solver: str = ...,
    midpoint_limit: float = ...,
    corner_angle: float = ...,
    least_deviation: float = ...,
    constraints: VertexConstraints | None = None,
    axes: str = ...,
    progress: Progress | None = None,
) -> ComputedField: ...
def computed_tet_field(
    domain: TetDomain | TetMesh,
    *,
    mode: str = ...,
    feature_tolerance: float = ...,
    start: str = ...,
    seed: int = ...,
    rounds: int = ...,
    round_time: float = ...,
    threads: int = ...,
    first_time: float = ...,
    last_time: float = ...,
    time_exponent: float = ...,
    max_steps: int = ...,
    linear_tolerance: float = ...,
    keep_best: bool = ...,
    representation: str = ...,
    solver: str = ...,
    max_iterations: int = ...,
    tolerance: float = ...,
    linear_solver: str = ...,
    midpoint_limit: float = ...,
    corner_angle: float = ...,
    least_deviation: float = ...,
    constraints: VertexConstraints | None = None,
    axes: str = ...,
    progress: Progress | None = None,
) -> ComputedTetField: ...

class QuadMesh:
    def __init__(self, vertices: ArrayLike = ..., triangles: ArrayLike = ..., quads: ArrayLike = ...) -> None: ...
    @property
    def vertices(self) -> Float64s: ...
    @vertices.setter
    def vertices(self, value: ArrayLike) -> None: ...
    @property
    def triangles(self) -> Int32s: ...
    @triangles.setter
    def triangles(self, value: ArrayLike) -> None: ...
    @property
    def quads(self) -> Int32s: ...
    @quads.setter
    def quads(self, value: ArrayLike) -> None: ...

class MixedMesh:
    def __init__(
        self,
        vertices: ArrayLike = ...,
        tets: ArrayLike = ...,
        hexahedra: ArrayLike = ...,
        wedges: ArrayLike = ...,
        pyramids: ArrayLike = ...,
    ) -> None: ...
    @property
    def vertices(self) -> Float64s: ...
    @vertices.setter
    def vertices(self, value: ArrayLike) -> None: ...
    @property
    def tets(self) -> Int32s: ...
    @tets.setter
    def tets(self, value: ArrayLike) -> None: ...
    @property
    def hexahedra(self) -> Int32s: ...
    @hexahedra.setter
    def hexahedra(self, value: ArrayLike) -> None: ...
    @property
    def wedges(self) -> Int32s: ...
    @wedges.setter
    def wedges(self, value: ArrayLike) -> None: ...
    @property
    def pyramids(self) -> Int32s: ...
    @pyramids.setter
    def pyramids(self, value: ArrayLike) -> None: ...

class CellDefect:
    kind: str
    message: str
    def __init__(self, kind: str = ..., cells: ArrayLike = ..., message: str = ...) -> None: ...
    @property
    def cells(self) -> Int32s: ...
    @cells.setter
    def cells(self, value: ArrayLike) -> None: ...

class CellBoundary:
    def __init__(self, mesh: QuadMesh = ..., vertex_map: ArrayLike = ..., cells: ArrayLike = ...) -> None: ...
    @property
    def mesh(self) -> QuadMesh: ...
    @property
    def vertex_map(self) -> Int32s: ...
    @vertex_map.setter
    def vertex_map(self, value: ArrayLike) -> None: ...
    @property
    def cells(self) -> Int32s: ...
    @cells.setter
    def cells(self, value: ArrayLike) -> None: ...

def find_cell_defects(mesh: MixedMesh) -> list[CellDefect]: ...
@overload
def scaled_jacobians(mesh: MixedMesh) -> Float64s: ...
@overload
def scaled_jacobians(mesh: QuadMesh) -> Float64s: ...
def cell_volumes(mesh: MixedMesh) -> Float64s: ...
def cell_boundary(mesh: MixedMesh) -> CellBoundary: ...
def split_quads(mesh: QuadMesh) -> TriangleMesh: ...
def write_mixed_mesh(path: Path, mesh: MixedMesh, metadata: dict[str, str] = ...) -> None: ...
def write_quad_mesh(path: Path, mesh: QuadMesh, metadata: dict[str, str] = ...) -> None: ...

# ---- volume: hex-dominant meshes

class PeriodicMapOptions:
    hold_angle: float
    rounds: int
    threads: int
    def __init__(
        self,
        hold_angle: float = ...,
        rounds: int = ...,
        threads: int = ...,
    ) -> None: ...

class RecombineOptions:
    min_scaled_jacobian: float
    wedges: bool
    max_boundary_fold: float
    threads: int
    def __init__(
        self,
        min_scaled_jacobian: float = ...,
        wedges: bool = ...,
        max_boundary_fold: float = ...,
        kept_edges: ArrayLike = ...,
        walls: ArrayLike = ...,
        threads: int = ...,
    ) -> None: ...
    @property
    def kept_edges(self) -> Int32s: ...
    @kept_edges.setter
    def kept_edges(self, value: ArrayLike) -> None: ...
    @property
    def walls(self) -> Int32s: ...
    @walls.setter
    def walls(self, value: ArrayLike) -> None: ...

class ImproveOptions:
    sweeps: int
    good: float
    tolerance: float
    fit_surface: bool
    hexahedra_first: bool
    threads: int
    def __init__(
        self,
        sweeps: int = ...,
        good: float = ...,
        tolerance: float = ...,
        fit_surface: bool = ...,
        hexahedra_first: bool = ...,
        threads: int = ...,
    ) -> None: ...

class HexDominantOptions:
    words: ClassVar[dict[str, list[str]]]
    edge_length: float
    correction: str
    points: str
    refinements: int
    most_tets: int
    most_hexahedra: int
    min_scaled_jacobian: float
    hold_angle: float
    recombine: bool
    improve: bool
    threads: int
    def __init__(
        self,
        edge_length: float = ...,
        sizes: ArrayLike = ...,
        correction: str = ...,
        points: str = ...,
        refinements: int = ...,
        most_tets: int = ...,
        most_hexahedra: int = ...,
        min_scaled_jacobian: float = ...,
        hold_angle: float = ...,
        recombine: bool = ...,
        improve: bool = ...,
        threads: int = ...,
    ) -> None: ...
    @property
    def sizes(self) -> Float64s: ...
    @sizes.setter
    def sizes(self, value: ArrayLike) -> None: ...

class SeamlessMap:
    def __init__(
        self,
        mesh: TetMesh = ...,
        parameters: ArrayLike = ...,
        walls: ArrayLike = ...,
        features: ArrayLike = ...,
        corners: ArrayLike = ...,
    ) -> None: ...
    @property
    def mesh(self) -> TetMesh: ...
    @property
    def parameters(self) -> Float64s: ...
    @parameters.setter
    def parameters(self, value: ArrayLike) -> None: ...
    @property
    def walls(self) -> Int32s: ...
    @walls.setter
    def walls(self, value: ArrayLike) -> None: ...
    @property
    def features(self) -> Int32s: ...
    @features.setter
    def features(self, value: ArrayLike) -> None: ...
    @property
    def corners(self) -> Int32s: ...
    @corners.setter
    def corners(self, value: ArrayLike) -> None: ...

class SeamlessReport:
    residual: float
    unaligned: int
    volume: float
    def __init__(
        self,
        flipped: ArrayLike = ...,
        residual: float = ...,
        torn: ArrayLike = ...,
        unaligned: int = ...,
        volume: float = ...,
        wound: ArrayLike = ...,
    ) -> None: ...
    @property
    def flipped(self) -> Int32s: ...
    @flipped.setter
    def flipped(self, value: ArrayLike) -> None: ...
    @property
    def torn(self) -> Int32s: ...
    @torn.setter
    def torn(self, value: ArrayLike) -> None: ...
    @property
    def wound(self) -> Int32s: ...
    @wound.setter
    def wound(self, value: ArrayLike) -> None: ...

class FieldMap:
    map: SeamlessMap
    added_vertices: int
    turns: int
    unzipped: int
    unknowns: int
    flipped_at_first: int
    steps: int
    angle_at_first: float
    angle: float
    def __init__(
        self,
        map: SeamlessMap = ...,
        parent: ArrayLike = ...,
        curves: ArrayLike = ...,
        added_vertices: int = ...,
        turns: int = ...,
        unzipped: int = ...,
        unknowns: int = ...,
        locked: ArrayLike = ...,
        flipped: ArrayLike = ...,
        flipped_at_first: int = ...,
        steps: int = ...,
        angle_at_first: float = ...,
        angle: float = ...,
    ) -> None: ...
    @property
    def parent(self) -> Int32s: ...
    @parent.setter
    def parent(self, value: ArrayLike) -> None: ...
    @property
    def curves(self) -> Int32s: ...
    @curves.setter
    def curves(self, value: ArrayLike) -> None: ...
    @property
    def locked(self) -> Int32s: ...
    @locked.setter
    def locked(self, value: ArrayLike) -> None: ...
    @property
    def flipped(self) -> Int32s: ...
    @flipped.setter
    def flipped(self, value: ArrayLike) -> None: ...

class BlockArc:
    feature: bool
    boundary: bool
    def __init__(
        self,
        vertices: ArrayLike = ...,
        parameters: ArrayLike = ...,
        feature: bool = ...,
        boundary: bool = ...,
    ) -> None: ...
    @property
    def vertices(self) -> Int32s: ...
    @vertices.setter
    def vertices(self, value: ArrayLike) -> None: ...
    @property
    def parameters(self) -> Float64s: ...
    @parameters.setter
    def parameters(self, value: ArrayLike) -> None: ...

class BlockComplex:
    @property
    def tet_block(self) -> Int32s: ...
    @property
    def charts(self) -> Float64s: ...
    @property
    def nodes(self) -> Int32s: ...
    @property
    def arcs(self) -> list[BlockArc]: ...
    @property
    def sizes(self) -> Float64s: ...
    @property
    def patches(self) -> int: ...

class ArcNumbers:
    deviation: float
    bound: float
    hexahedra: int
    def __init__(
        self,
        numbers: ArrayLike = ...,
        deviation: float = ...,
        bound: float = ...,
        hexahedra: int = ...,
    ) -> None: ...
    @property
    def numbers(self) -> Int32s: ...
    @numbers.setter
    def numbers(self, value: ArrayLike) -> None: ...

class BlockHexahedra:
    def __init__(self, mesh: MixedMesh = ..., blocks: ArrayLike = ..., support: ArrayLike = ...) -> None: ...
    @property
    def mesh(self) -> MixedMesh: ...
    @property
    def blocks(self) -> Int32s: ...
    @blocks.setter
    def blocks(self, value: ArrayLike) -> None: ...
    @property
    def support(self) -> UInt8s: ...
    @support.setter
    def support(self, value: ArrayLike) -> None: ...

class AllHexOptions:
    cells: int
    edge_length: float
    most_nodes: int
    most_hexahedra: int
    good: float
    sweeps: int
    threads: int
    def __init__(
        self,
        cells: int = ...,
        edge_length: float = ...,
        most_nodes: int = ...,
        most_hexahedra: int = ...,
        good: float = ...,
        sweeps: int = ...,
        threads: int = ...,
    ) -> None: ...

class AllHexMesh:
    wanted: int
    inverted: int
    block_count: int
    def __init__(
        self,
        mesh: MixedMesh = ...,
        blocks: ArrayLike = ...,
        support: ArrayLike = ...,
        numbers: ArcNumbers = ...,
        wanted: int = ...,
        inverted: int = ...,
        block_count: int = ...,
        notes: Sequence[str] = ...,
    ) -> None: ...
    @property
    def mesh(self) -> MixedMesh: ...
    @property
    def blocks(self) -> Int32s: ...
    @blocks.setter
    def blocks(self, value: ArrayLike) -> None: ...
    @property
    def support(self) -> UInt8s: ...
    @support.setter
    def support(self, value: ArrayLike) -> None: ...
    @property
    def numbers(self) -> ArcNumbers: ...
    @property
    def notes(self) -> list[str]: ...

class PeriodicMap:
    inconsistent: int
    turned_over: int
    def __init__(
        self,
        frames: ArrayLike = ...,
        coordinates: ArrayLike = ...,
        usable: ArrayLike = ...,
        faces: FaceMatchings = ...,
        translation: ArrayLike = ...,
        joined: ArrayLike = ...,
        inconsistent: int = ...,
        turned_over: int = ...,
    ) -> None: ...
    @property
    def frames(self) -> Float64s: ...
    @frames.setter
    def frames(self, value: ArrayLike) -> None: ...
    @property
    def coordinates(self) -> Int32s: ...
    @coordinates.setter
    def coordinates(self, value: ArrayLike) -> None: ...
    @property
    def usable(self) -> UInt8s: ...
    @usable.setter
    def usable(self, value: ArrayLike) -> None: ...
    @property
    def faces(self) -> FaceMatchings: ...
    @property
    def translation(self) -> Int32s: ...
    @translation.setter
    def translation(self, value: ArrayLike) -> None: ...
    @property
    def joined(self) -> UInt8s: ...
    @joined.setter
    def joined(self, value: ArrayLike) -> None: ...

class LostCells:
    outside: int
    unusable: int
    degenerate: int
    poor: int
    def __init__(
        self,
        outside: int = ...,
        unusable: int = ...,
        degenerate: int = ...,
        poor: int = ...,
    ) -> None: ...

class LatticeCells:
    apart: bool
    def __init__(
        self,
        points: ArrayLike = ...,
        tet: ArrayLike = ...,
        weights: ArrayLike = ...,
        hexahedra: ArrayLike = ...,
        on_surface: ArrayLike = ...,
        lost: LostCells = ...,
        apart: bool = ...,
    ) -> None: ...
    @property
    def points(self) -> Float64s: ...
    @points.setter
    def points(self, value: ArrayLike) -> None: ...
    @property
    def tet(self) -> Int32s: ...
    @tet.setter
    def tet(self, value: ArrayLike) -> None: ...
    @property
    def weights(self) -> Float64s: ...
    @weights.setter
    def weights(self, value: ArrayLike) -> None: ...
    @property
    def hexahedra(self) -> Int32s: ...
    @hexahedra.setter
    def hexahedra(self, value: ArrayLike) -> None: ...
    @property
    def on_surface(self) -> UInt8s: ...
    @on_surface.setter
    def on_surface(self, value: ArrayLike) -> None: ...
    @property
    def lost(self) -> LostCells: ...

class RecombineReport:
    potential_hexahedra: int
    potential_wedges: int
    hexahedra: int
    wedges: int
    flat_tets: int
    def __init__(
        self,
        potential_hexahedra: int = ...,
        potential_wedges: int = ...,
        hexahedra: int = ...,
        wedges: int = ...,
        flat_tets: int = ...,
    ) -> None: ...

class ConformReport:
    combined: int
    raised: int
    split: int
    def __init__(
        self,
        combined: int = ...,
        raised: int = ...,
        split: int = ...,
    ) -> None: ...

class HexDominantCounts:
    tets: int
    inconsistent: int
    turned_over: int
    lattice_hexahedra: int
    crossing: int
    recombined_hexahedra: int
    recombined_wedges: int
    def __init__(
        self,
        tets: int = ...,
        inconsistent: int = ...,
        turned_over: int = ...,
        lost: LostCells = ...,
        lattice_hexahedra: int = ...,
        crossing: int = ...,
        recombined_hexahedra: int = ...,
        recombined_wedges: int = ...,
        pyramids: ConformReport = ...,
    ) -> None: ...
    @property
    def lost(self) -> LostCells: ...
    @property
    def pyramids(self) -> ConformReport: ...

class HexDominantMesh:
    words: ClassVar[dict[str, list[str]]]
    def __init__(
        self,
        mesh: MixedMesh = ...,
        regions: ArrayLike = ...,
        support: ArrayLike = ...,
        points: str = ...,
        counts: HexDominantCounts = ...,
    ) -> None: ...
    @property
    def mesh(self) -> MixedMesh: ...
    @property
    def regions(self) -> Int32s: ...
    @regions.setter
    def regions(self, value: ArrayLike) -> None: ...
    @property
    def support(self) -> UInt8s: ...
    @support.setter
    def support(self, value: ArrayLike) -> None: ...
    @property
    def points(self) -> str: ...
    @points.setter
    def points(self, value: str) -> None: ...
    @property
    def counts(self) -> HexDominantCounts: ...

def hex_dominant(
    domain: TetDomain | TetMesh,
    frames: ArrayLike,
    *,
    edge_length: float = ...,
    sizes: ArrayLike | None = ...,
    correction: str = ...,
    points: str = ...,
    refinements: int = ...,
    most_tets: int = ...,
    most_hexahedra: int = ...,
    min_scaled_jacobian: float = ...,
    hold_angle: float = ...,
    recombine: bool = ...,
    improve: bool = ...,
    threads: int = ...,
    progress: Progress | None = None,
) -> HexDominantMesh: ...
def field_map(
    domain: TetDomain | TetMesh,
    frames: ArrayLike,
    *,
    progress: Progress | None = None,
    edge_length: float = 0.0,
    threads: int = 0,
) -> FieldMap: ...
def seamless_report(map: SeamlessMap) -> SeamlessReport: ...
def map_domain(map: SeamlessMap) -> TetDomain: ...
def motorcycle_complex(map: SeamlessMap, *, progress: Progress | None = None) -> SeamlessMap: ...
def block_complex(map: SeamlessMap) -> BlockComplex: ...
def arc_numbers(
    blocks: BlockComplex, scale: float, *, least: ArrayLike | None = None, most_nodes: int = 2000
) -> ArcNumbers: ...
def block_hexahedra(map: SeamlessMap, blocks: BlockComplex, numbers: ArrayLike) -> BlockHexahedra: ...
def all_hex(
    map: SeamlessMap,
    *,
    cells: int = ...,
    edge_length: float = ...,
    most_nodes: int = ...,
    most_hexahedra: int = ...,
    good: float = ...,
    sweeps: int = ...,
    threads: int = ...,
    progress: Progress | None = None,
) -> AllHexMesh: ...
def refine_tets(domain: TetDomain | TetMesh, marked: ArrayLike) -> tuple[TetDomain, Int32s, Int32s]: ...
def periodic_map(
    domain: TetDomain | TetMesh,
    of_tets: ArrayLike,
    lengths: ArrayLike,
    *,
    hold_angle: float = ...,
    rounds: int = ...,
    threads: int = ...,
    progress: Progress | None = None,
) -> PeriodicMap: ...
def lattice_cells(
    domain: TetDomain | TetMesh,
    map: PeriodicMap,
    *,
    min_scaled_jacobian: float = ...,
    threads: int = 0,
) -> LatticeCells: ...
def recombine(
    mesh: MixedMesh,
    *,
    min_scaled_jacobian: float = ...,
    wedges: bool = ...,
    max_boundary_fold: float = ...,
    kept_edges: ArrayLike | None = ...,
    walls: ArrayLike | None = ...,
    threads: int = ...,
) -> tuple[MixedMesh, RecombineReport]: ...
def conform(mesh: MixedMesh) -> tuple[MixedMesh, ConformReport]: ...
def proven_positive(mesh: MixedMesh, *, depth: int = 8, threads: int = 0) -> UInt8s: ...
def improve_cells(
    mesh: MixedMesh,
    support: ArrayLike,
    surface: TriangleMesh,
    features: FeatureGraph,
    *,
    sweeps: int = ...,
    good: float = ...,
    tolerance: float = ...,
    fit_surface: bool = ...,
    hexahedra_first: bool = ...,
    threads: int = ...,
) -> MixedMesh: ...
