"""Problems of su2_consistency.py: tet meshes of the unit cube, a bar and a ball, with constrained boundary frames."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import octafield
from octafield.domain.inputs import read_input
from scipy.interpolate import RegularGridInterpolator
from study_output import with_grid

EVEN_AND_ODD_ORDERS = ((0, 1, 2), (1, 2, 0), (2, 0, 1), (1, 0, 2), (0, 2, 1), (2, 1, 0))
FIXED, AXIS = 2, 1


@dataclass
class Problem:
    name: str
    spacing: float
    mesh: octafield.TetMesh
    constraints: octafield.volume.BoundaryConstraints
    target: np.ndarray | None  # (n, 4) the smooth frames whose boundary values are held
    free: np.ndarray  # vertices that are not fixed
    boundary: octafield.volume.BoundarySurface | None = None


def kuhn_grid(nx: int, ny: int, nz: int, h: float) -> octafield.TetMesh:
    """Six tets round the diagonal of every cell of a grid of cubes of side h."""
    shape = np.array([nx, ny, nz]) + 1
    points = h * np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), -1).reshape(-1, 3)
    cells = np.stack(np.meshgrid(*map(np.arange, shape - 1), indexing="ij"), -1).reshape(-1, 3)
    tets = []
    for k, order in enumerate(EVEN_AND_ODD_ORDERS):
        corner, ids = cells.copy(), []
        for axis in (None, *order):
            if axis is not None:
                corner[:, axis] += 1
            ids.append(np.ravel_multi_index(corner.T, shape))
        if k >= 3:
            ids[2], ids[3] = ids[3], ids[2]
        tets.append(np.stack(ids, 1))
    return octafield.TetMesh(points, np.concatenate(tets).astype(np.int32))


def jittered_cube(n: int, amount: float, seed: int) -> octafield.TetMesh:
    """Kuhn cube, inner vertices moved by up to `amount` cells along each axis: obtuse tets, negative cotangents."""
    mesh = kuhn_grid(n, n, n, 1 / n)
    points = np.array(mesh.vertices)
    inner = np.all((points > 1e-9) & (points < 1 - 1e-9), axis=1)
    points[inner] += amount / n * np.random.default_rng(seed).uniform(-1, 1, (inner.sum(), 3))
    return octafield.TetMesh(points, mesh.tets)


def tetgen_cube(n: int) -> octafield.TetMesh:
    """TetGen inside the boundary of the Kuhn cube, inner points by its own rules."""
    surface = octafield.volume.boundary_surface(kuhn_grid(n, n, n, 1 / n)).mesh
    return octafield.volume.tetrahedralize(surface, edge_length=1 / n)


def smooth_frames(points: np.ndarray, amplitude: float) -> np.ndarray:
    """Smooth, without singularities, far from constant: turns by 0.6 to 1 rad across the cube at amplitude 1."""
    x, y, z = points.T
    return octafield.frames.quaternion_exp(
        amplitude * np.stack([0.4 * np.sin(2 * y), 0.5 * x * z, 0.6 * x - 0.3 * z], 1)
    )


def held(mesh: octafield.TetMesh, frames: np.ndarray, vertices: np.ndarray) -> octafield.volume.BoundaryConstraints:
    n = len(mesh.vertices)
    kind, on_boundary, values = np.zeros(n, np.uint8), np.zeros(n, np.uint8), np.tile([1.0, 0, 0, 0], (n, 1))
    kind[vertices] = FIXED
    on_boundary[octafield.volume.boundary_surface(mesh).vertex_map] = 1
    values[vertices] = frames[vertices]
    return octafield.volume.BoundaryConstraints(kind, np.zeros((n, 3)), values, on_boundary)


def cube(family: str, n: int, amplitude: float = 1) -> Problem:
    mesh = {
        "kuhn": lambda: kuhn_grid(n, n, n, 1 / n),
        "jittered": lambda: jittered_cube(n, 0.2, n),
        "tetgen": lambda: tetgen_cube(n),
    }[family]()
    target = smooth_frames(np.asarray(mesh.vertices), amplitude)
    boundary = np.asarray(octafield.volume.boundary_surface(mesh).vertex_map)
    return Problem(
        f"{family} n = {n}",
        1 / n,
        mesh,
        held(mesh, target, boundary),
        target,
        np.setdiff1d(np.arange(len(target)), boundary),
    )


def singular_line(n: int) -> Problem:
    """Kuhn cube round a singular line along z, at the same place of its cell for every n: frames turn by a quarter
    of the angle about the line, the harmonic map away from it, and are held on the boundary."""
    mesh = kuhn_grid(n, n, n, 1 / n)
    points = np.asarray(mesh.vertices)
    x, y = (points[:, :2] - line_of(n)).T
    turned = octafield.frames.quaternion_exp(np.stack([0 * x, 0 * x, np.arctan2(y, x) / 4], 1))
    # From the left: far from the axes that su2 singles out.
    first = np.repeat(octafield.frames.quaternion_exp(np.array([[0.7, 0.4, -0.3]])), len(points), axis=0)
    frames = quaternion_product(first, turned)
    boundary = np.asarray(octafield.volume.boundary_surface(mesh).vertex_map)
    free = np.setdiff1d(np.arange(len(frames)), boundary)
    return Problem(f"line n = {n}", 1 / n, mesh, held(mesh, frames, boundary), frames, free)


def line_of(n: int) -> np.ndarray:
    """x and y of the singular line: 0.3 and 0.2 cells from the middle of the cube, n odd."""
    return np.array([0.5, 0.5]) + np.array([0.3, 0.2]) / n


def bar(cells: int, ends: np.ndarray) -> Problem:
    """[0, 1] x [0, 2 / cells]^2 with frames held at x = 0 and x = 1 only: a problem in one dimension."""
    mesh = kuhn_grid(cells, 2, 2, 1 / cells)
    x = np.asarray(mesh.vertices)[:, 0]
    target = octafield.frames.slerp(np.tile(ends[0], (len(x), 1)), np.tile(ends[1], (len(x), 1)), x)
    fixed = np.flatnonzero((x < 1e-9) | (x > 1 - 1e-9))
    return Problem("bar", 1 / cells, mesh, held(mesh, target, fixed), target, np.setdiff1d(np.arange(len(x)), fixed))


def ball(path: Path) -> Problem:
    """A tet mesh of a ball, one axis on the area-weighted normal of every boundary vertex, twist free."""
    read = read_input(path)
    mesh, vertices = read.tets, np.asarray(read.tets.surface.vertex_map)
    n, normals = len(mesh.vertices), np.asarray(octafield.surface.vertex_normals(read.tets.surface.mesh))
    kind, axis, frames = np.zeros(n, np.uint8), np.zeros((n, 3)), np.tile([1.0, 0, 0, 0], (n, 1))
    kind[vertices], axis[vertices] = AXIS, normals
    frames[vertices] = octafield.frames.frame_from_axes(np.tile([1.0, 0, 0], (len(vertices), 1)), normals)
    constraints = octafield.volume.BoundaryConstraints(kind, axis, frames, (kind > 0).astype(np.uint8))
    return Problem(
        path.name.removesuffix(".mesh.gz"),
        octafield.surface.mean_edge_length(read.tets.surface.mesh),
        mesh,
        constraints,
        None,
        np.arange(n),
        read.tets.surface,
    )


def minimise(
    problem: Problem, scheme: str, start: np.ndarray, tolerance: float = 1e-12, **options
) -> octafield.volume.SmoothResult:
    solver = "trust_region" if scheme == "sh4" else "levenberg_marquardt"
    return octafield.volume.smooth(
        problem.mesh,
        problem.constraints,
        start,
        representation=scheme,
        solver=solver,
        tolerance=tolerance,
        max_iterations=300,
        **options,
    )


def on_cells(axes: Any, cells: Sequence[int], title: str) -> None:
    """A panel over the number of cells along a side."""
    axes.set(xlabel="cells a side", title=title)
    axes.set_xticks(cells, cells)
    axes.minorticks_off()
    with_grid(axes)


def grid_values(frames: np.ndarray, n: int, points: np.ndarray) -> np.ndarray:
    """Frames of a Kuhn cube at points: exact at its vertices, else trilinear in sh4 and projected."""
    axis = np.linspace(0, 1, n + 1)
    table = octafield.frames.sh4_embed(frames).reshape(n + 1, n + 1, n + 1, 9)
    values = RegularGridInterpolator((axis, axis, axis), table)(np.clip(points, 0, 1))
    return octafield.frames.sh4_project(values)[0]


def random_representatives(frames: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Each quaternion times one of the 48 of the binary octahedral group: the same frames."""
    group = np.asarray(octafield.frames.binary_octahedral_group())[rng.integers(48, size=len(frames))]
    return quaternion_product(frames, group)


def quaternion_product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    w = a[:, 0] * b[:, 0] - np.sum(a[:, 1:] * b[:, 1:], 1)
    v = a[:, :1] * b[:, 1:] + b[:, :1] * a[:, 1:] + np.cross(a[:, 1:], b[:, 1:])
    product = np.column_stack([w, v])
    return product / np.linalg.norm(product, axis=1, keepdims=True)
