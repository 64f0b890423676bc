"""Inputs at the edge of what a mesh can be made of, and beyond: made here by rule, or a file that went wrong before."""

import itertools
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import octafield
from any_part_shapes import SHAPES, ball, box, comb, grid_faces, joined, lathe, outward, prism, reversed_
from octafield.domain.generators import generate

Source = Path | octafield.TriangleMesh | octafield.TetMesh


@dataclass
class Extreme:
    """make: of the folder of data. edge, cells: as HexMeshOptions has them. of_mean: the edge is so many mean edges of
    the input's surface. options: of the field."""

    words: str
    make: Callable[[Path], Source]
    edge: float = 0.0
    cells: int = 0
    of_mean: float = 0.0
    sizes: Any = None
    options: dict[str, Any] = field(default_factory=dict)


def surface(points, triangles) -> octafield.TriangleMesh:
    return octafield.TriangleMesh(np.asarray(points, float), np.asarray(triangles, np.int32))


def tets(points, rows) -> octafield.TetMesh:
    return octafield.TetMesh(np.asarray(points, float), np.asarray(rows, np.int32))


def turned(points: np.ndarray) -> np.ndarray:
    """By an orthogonal matrix without a zero."""
    q = np.linalg.qr(np.array([[3.0, 1, 2], [-1, 4, 1], [-2, -1, 5]]))[0]
    return points @ (q * np.linalg.det(q))


def box_of_tets(x: float, y: float, z: float, parts: tuple[int, int, int] = (1, 1, 1)) -> octafield.TetMesh:
    """Six tets a box."""
    nx, ny, nz = parts
    axes = [np.linspace(0, length, n + 1) for length, n in zip((x, y, z), parts, strict=True)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    step = ((ny + 1) * (nz + 1), nz + 1, 1)
    rows = []
    for at in np.ndindex(nx, ny, nz):
        for order in itertools.permutations(range(3)):
            corners = [int(np.dot(at, step))]
            for axis in order:
                corners.append(corners[-1] + step[axis])
            if np.linalg.det(points[corners[1:]] - points[corners[0]]) < 0:
                corners[2:] = corners[:1:-1]
            rows.append(corners)
    return tets(points, rows)


def one_tet(height: float = 1.0) -> octafield.TetMesh:
    return tets([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.3, 0.3, height]], [[0, 1, 2, 3]])


def cone(height: float, segments: int = 24) -> octafield.TriangleMesh:
    angle = np.arange(segments) / segments * 2 * np.pi
    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    k, m = np.arange(segments), (np.arange(segments) + 1) % segments
    ends = [np.stack([np.full(segments, segments), m, k], 1), np.stack([np.full(segments, segments + 1), k, m], 1)]
    return surface([*ring, [0, 0, 0], [0, 0, height]], np.concatenate(ends))


def hourglass(waist: float) -> octafield.TriangleMesh:
    return surface(*lathe(np.array([(0.2, -1), (1, -1), (waist + 0.2, 0), (1, 1), (0.2, 1)]), 24))


def touching(by: tuple[float, float, float]) -> octafield.TriangleMesh:
    """Two unit cubes, the second moved; their common points are one."""
    both = joined(box(1, 1, 1), (box(1, 1, 1)[0] + by, box(1, 1, 1)[1]))
    return octafield.surface.repair(surface(*both), level="merge").mesh


def shaken_ball(amount: float) -> octafield.TriangleMesh:
    points, triangles = ball(levels=3)
    return surface(points + amount * np.random.default_rng(3).standard_normal(points.shape), triangles)


def scaled_ball(radius: float) -> octafield.TriangleMesh:
    points, triangles = ball(levels=3)
    return surface(points * radius, triangles)


def spiked_ball() -> octafield.TriangleMesh:
    points, triangles = ball(levels=3)
    points[triangles[0, 0]] *= -1.3
    return surface(points, triangles)


def moebius() -> octafield.TriangleMesh:
    angle = np.linspace(0, 2 * np.pi, 40, endpoint=False)[:, None]
    across = np.array([-0.3, 0.3])[None]
    radius = 1 + across * np.cos(angle / 2)
    rim = np.stack([radius * np.cos(angle), radius * np.sin(angle), across * np.sin(angle / 2)], axis=2)
    faces = grid_faces(41, 2, False, False)
    last = np.array([1, 0])
    return surface(rim.reshape(-1, 3), np.where(faces >= 80, last[faces % 2], faces))


def torus(u: int, v: int) -> octafield.TriangleMesh:
    a, b = np.meshgrid(np.arange(u) / u * 2 * np.pi, np.arange(v) / v * 2 * np.pi, indexing="ij")
    r = 1 + 0.4 * np.cos(b)
    points = np.stack([r * np.cos(a), r * np.sin(a), 0.4 * np.sin(b)], axis=2).reshape(-1, 3)
    return surface(*outward((points, grid_faces(u, v, True, True))))


def far_cylinder() -> octafield.TriangleMesh:
    mesh = generate("cylinder")
    return surface(np.asarray(mesh.vertices) + 1e7, mesh.triangles)


def two_materials() -> octafield.TetDomain:
    """A slab one tenth as thick as the cells between two blocks."""
    block, heights = box_of_tets(1, 1, 1, (3, 3, 3)), np.array([0, 0.45, 0.46, 1])
    points = np.array(block.vertices)
    points[:, 2] = heights[np.rint(points[:, 2] * 3).astype(int)]
    middle = points[np.asarray(block.tets)].mean(axis=1)[:, 2]
    return octafield.TetDomain(tets(points, block.tets), regions=(1 + (middle > 0.45) + (middle > 0.46)).astype(int))


def by_height(low: float, high: float) -> Callable[[np.ndarray], np.ndarray]:
    """Sizes that grow geometrically from z = 0 to z = 1."""
    return lambda p: low * (high / low) ** np.clip(p[:, 2], 0, 1)


def in_parts(low: float, high: float) -> Callable[[np.ndarray], np.ndarray]:
    """Sizes that jump at x = 0.5."""
    return lambda p: np.where(p[:, 0] < 0.5, low, high)


def at_one_row(value: float) -> np.ndarray:
    rows = np.array([[x, y, z, 0.25] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    rows[5, 3] = value
    return rows


def wild(name: str) -> Callable[[Path], Source]:
    return lambda data: data / "wild" / name


def made(make: Callable[..., Source], *given: Any) -> Callable[[Path], Source]:
    return lambda data: make(*given)


def shape(name: str) -> Callable[[Path], Source]:
    return lambda data: surface(*SHAPES[name]())


WEDGE = np.array([(0, 0), (40, 0), (40, 1.4)])
NEEDLE = np.array([(0, 0), (20, 0), (0, 0.02)])
SCALENE = box_of_tets(1, 1, 40)

EXTREMES: dict[str, Extreme] = {
    # one or few tets
    "one_tet": Extreme("one tet, three cells along an edge", made(one_tet), edge=0.35),
    "one_tet_default": Extreme("one tet, cells as large as it", made(one_tet)),
    "one_tet_1000": Extreme("one tet, cells 1000 times its edge", made(one_tet), of_mean=1000),
    "sliver_tet": Extreme("one tet of height 1e-4", made(one_tet, 1e-4), edge=0.1),
    "sliver_tet_0001": Extreme("one tet of height 0.01, cells of 0.001 mean edges", made(one_tet, 0.01), of_mean=0.001),
    "flat_tet": Extreme("one tet of height 1e-14", made(one_tet, 1e-14), edge=0.1),
    "cube_1000": Extreme("a cube, cells 1000 times its edge", made(generate, "box"), of_mean=1000),
    "cube_0001": Extreme("a cube, cells of 0.001 mean edges", made(generate, "box"), of_mean=0.001),
    # long, thin, sharp
    "long_box": Extreme("1 x 1 x 40 in 6 tets, cells of 0.5", made(box_of_tets, 1, 1, 40), edge=0.5),
    "long_box_turned": Extreme(
        "the same, askew to the axes", lambda data: tets(turned(np.asarray(SCALENE.vertices)), SCALENE.tets), edge=0.25
    ),
    "long_box_third": Extreme("1 x 1 x 40 in 6 tets, 3.3 cells across", made(box_of_tets, 1, 1, 40), edge=0.3),
    "long_wedge": Extreme("40 x 1.4 x 20, an edge of 2 degrees", lambda data: surface(*prism(WEDGE, 20)), edge=1.0),
    "needle_wedge": Extreme("20 x 0.02 x 1, cells of 0.1", lambda data: surface(*prism(NEEDLE, 1)), edge=0.1),
    "needle_wedge_0001": Extreme("the same, cells of 0.001 mean edges", lambda data: surface(*prism(NEEDLE, 1)),
        of_mean=0.001),
    "thin_plate": Extreme("1 x 1 x 0.02, cells of 0.1", lambda data: surface(*box(1, 1, 0.02)), edge=0.1),
    "thin_plate_100": Extreme("1 x 1 x 0.001, cells of 0.1", lambda data: surface(*box(1, 1, 0.001)), edge=0.1),
    "thin_shell": Extreme("between balls of 1 and 0.97, cells of 0.15",
        lambda data: surface(*joined(ball(levels=3), reversed_(ball(0.97, levels=3)))), edge=0.15),
    "fins": Extreme("a comb of 12 fins, 300 cells", lambda data: surface(*comb()), cells=300),
    "cone": Extreme("a cone of height 2", made(cone, 2.0), edge=0.25),
    "cone_needle": Extreme("a cone 50 times as high as its radius", made(cone, 50.0), edge=0.5),
    "cone_flat": Extreme("a cone of height 0.01", made(cone, 0.01), edge=0.2),
    "waist": Extreme("two bells joined at a ring 0.02 thick", made(hourglass, 0.02), edge=0.3),
    # curved and coarse
    "ball_coarse": Extreme("a ball, cells of its radius", lambda data: surface(*ball(levels=3)), edge=1.0),
    "torus_coarse": Extreme("a torus, 40 cells", made(torus, 48, 24), cells=40),
    "knot": Extreme("a knotted tube, 500 cells", shape("knot_2_3"), cells=500),
    "gyroid": Extreme("a gyroid, 2000 cells", shape("gyroid"), cells=2000),
    # units and places
    "huge_units": Extreme("a ball of radius 1e12", made(scaled_ball, 1e12), edge=4e11),
    "tiny_units": Extreme("a ball of radius 1e-12", made(scaled_ball, 1e-12), edge=4e-13),
    "far_away": Extreme("a cylinder 1e7 from the origin", made(far_cylinder), edge=0.4),
    # sizes
    "sizes_nan": Extreme("a size that is not a number", made(generate, "box"), sizes=at_one_row(np.nan)),
    "sizes_negative": Extreme("a size below 0", made(generate, "box"), sizes=at_one_row(-0.25)),
    "sizes_zero": Extreme("a size of 0", made(generate, "box"), sizes=at_one_row(0)),
    "sizes_count": Extreme("too few sizes", made(generate, "box"), sizes=np.full(7, 0.25)),
    "sizes_10": Extreme("sizes from 0.04 to 0.4", made(box_of_tets, 1, 1, 1, (4, 4, 4)), sizes=by_height(0.04, 0.4)),
    "sizes_100": Extreme("sizes from 0.01 to 1 along a bar", made(box_of_tets, 0.2, 0.2, 1, (2, 2, 8)),
        sizes=by_height(0.01, 1.0)),
    "sizes_100_ball": Extreme("sizes from 0.02 to 2 in a ball",
        lambda data: surface(ball(0.5, 3)[0] + [0, 0, 0.5], ball(0.5, 3)[1]), sizes=by_height(0.02, 2.0),
        options={"edge_length": 0.12}),
    "sizes_jump": Extreme("sizes of 0.05 beside 0.5", made(box_of_tets, 1, 1, 1, (4, 4, 4)), sizes=in_parts(0.05, 0.5)),
    "sizes_tiny": Extreme("sizes down to 1e-6", made(box_of_tets, 1, 1, 1), sizes=by_height(1e-6, 0.5)),
    # parts and contacts
    "two_parts": Extreme("two balls, 0.01 apart", shape("two_bodies"), edge=0.4),
    "touching_edge": Extreme("two cubes with one edge in common", made(touching, (1, 1, 0)), edge=0.3),
    "touching_point": Extreme("two cubes with one corner in common", made(touching, (1, 1, 1)), edge=0.3),
    "overlapping": Extreme("two cubes through each other",
        lambda data: surface(*joined(box(1, 1, 1), (box(1, 1, 1)[0] + 0.37, box(1, 1, 1)[1]))), edge=0.3),
    "thin_material": Extreme("a layer of a tenth of a cell between two", made(two_materials), edge=0.1),
    # damaged surfaces
    "moebius": Extreme("a Möbius strip", made(moebius), edge=0.2),
    "spiked": Extreme("a ball, one vertex pulled through the other side", made(spiked_ball), edge=0.4),
    "noise": Extreme("a ball with noise as large as its edges", made(shaken_ball, 0.06), edge=0.4),
    "rough": Extreme("a ball with noise of a tenth of its edges", made(shaken_ball, 0.012), edge=0.4),
    "no_triangles": Extreme("no triangles at all", lambda data: surface(np.zeros((0, 3)), np.zeros((0, 3))), edge=0.4),
    "cup_open": Extreme("a cup without a lid", wild("cup_open_60.stl")),
    "cup_filled": Extreme("the same, holes filled", wild("cup_open_60.stl"), cells=300, options={"repair": "fill"}),
    "split_zero": Extreme("a cube whose corners differ by a rounding", wild("cube_split_zero.stl"), cells=60),
    "flap": Extreme("a surface with a flap", wild("t_flap.off"), cells=200),
    "fold": Extreme("a fold of 2e-5 of the size", wild("fold_patch.stl"), cells=100),
    "pipe_thin": Extreme("a pipe with a thin wall", wild("pipe_thin.stl"), cells=600),
    "screw": Extreme("a screw, cells as long as its pitch", wild("screw.stl"), cells=1500),
    "holder": Extreme("a CAD model that stopped TetGen", wild("holder.stp"), cells=800),
    # files of tets
    "voxels": Extreme("a file of voxels", wild("voxel.vtu")),
    "not_a_number": Extreme("a file with coordinates that are no numbers", wild("nan.vtu")),
    "outside": Extreme("tets of which some are inverted", wild("outside.mesh")),
    "folded": Extreme("a ball of tets that fold over", wild("ball_folded_deep.mesh")),
    "second_order": Extreme("tets of ten nodes", wild("order2.mesh")),
    "count_attribute": Extreme("a file that lies about its length", wild("damaged_count_a.vtp")),
}  # fmt: skip
