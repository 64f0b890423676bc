"""Surfaces for remeshing.py: files, and level sets like those that scanners and tomographs give. Makers return (points,
triangles), closed ones outward."""

from collections.abc import Callable

import numpy as np
import pyvista
from pyvista import examples

from .any_part_shapes import Mesh, grid_faces, of_poly, outward

HEXME = ("s02u", "s05u", "s07c", "s08c", "s09u", "s10u", "s11c", "s13c", "s14u", "i04c", "i05c", "i07c")
FILES = ("s01", "s04", "s15", "s16", "s17", "i10")
BAD = ("degenerate_s17", "fin_s01", "flipped_s01", "hole_s17", "insideout_s16", "selfcross_s15", "soup_s04")


def level_set(value: Callable[..., np.ndarray], side: int, half: float = 1.0) -> Mesh:
    """Where value(x, y, z) is 0, by marching cubes on side^3 points of [-half, half]^3; inside is below 0."""
    line = np.linspace(-half, half, side, dtype=np.float32)
    x, y, z = np.meshgrid(line, line, line, indexing="ij", copy=False)
    grid = pyvista.ImageData(dimensions=(side,) * 3, spacing=(line[1] - line[0],) * 3, origin=(-half,) * 3)
    found = grid.contour([0.0], np.asarray(value(x, y, z)).ravel(order="F"), method="flying_edges").clean()
    triangles = found.faces.reshape(-1, 4)[:, 1:]
    points = np.asarray(found.points, float)
    corners = points[triangles]
    flat = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) == 0
    return outward((points, triangles[~flat]))


def noise(shape: tuple[int, ...], size: float) -> np.ndarray:
    return size * np.random.default_rng(0).standard_normal(shape, dtype=np.float32)


def scanned_part(side: int) -> Mesh:
    """A block with three bores and rounded edges, with noise of a scanner on it."""

    def value(x, y, z):
        block = np.maximum.reduce([abs(x) - 0.85, abs(y) - 0.55, abs(z) - 0.35])
        bores = np.minimum.reduce([np.hypot(x - at, y) - r for at, r in ((-0.5, 0.2), (0.05, 0.15), (0.5, 0.25))])
        return np.maximum(block, -bores) + noise(x.shape, 0.1 / side)

    return level_set(value, side)


def foam(side: int, cells: float = 1.5) -> Mesh:
    """Both walls of a gyroid's cells, cut off by a box."""

    def value(x, y, z):
        a, b, c = (np.pi * cells * 2 * t for t in (x, y, z))
        gyroid = np.sin(a) * np.cos(b) + np.sin(b) * np.cos(c) + np.sin(c) * np.cos(a)
        return np.maximum(abs(gyroid) - 0.6, 6 * (np.maximum.reduce([abs(x), abs(y), abs(z)]) - 0.93))

    return level_set(value, side)


def vessel(side: int) -> Mesh:
    """A tube that forks twice, smoothly."""
    trunk = [((0, 0, -0.8), (0, 0, -0.1), 0.16)]
    for sign in (-1, 1):
        fork = (0.45 * sign, 0, 0.3)
        trunk.append(((0, 0, -0.1), fork, 0.12))
        trunk += [(fork, (0.45 * sign + 0.2 * t, 0.35 * t, 0.8), 0.08) for t in (-1, 1)]

    def value(x, y, z):
        near = 0.0
        for start, end, radius in trunk:
            a, d = np.array(start), np.subtract(end, start)
            share = np.clip(((x - a[0]) * d[0] + (y - a[1]) * d[1] + (z - a[2]) * d[2]) / (d @ d), 0, 1)
            square = (x - a[0] - share * d[0]) ** 2 + (y - a[1] - share * d[1]) ** 2 + (z - a[2] - share * d[2]) ** 2
            near = near + np.exp(-40 * (np.sqrt(square) - radius))
        return -np.log(np.maximum(near, 1e-30)) / 40

    return level_set(value, side)


def skull(side: int) -> Mesh:
    """A shell with many holes, as bone: handles between an inner and an outer wall."""

    def value(x, y, z):
        r = np.sqrt(x * x + y * y + 1.4 * z * z)
        shell = abs(r - 0.75) - 0.07
        holes = np.sin(9 * x) * np.sin(9 * y) + np.sin(9 * y) * np.sin(9 * z) + np.sin(9 * z) * np.sin(9 * x)
        return np.maximum(shell, 0.12 * (holes - 0.9))

    return level_set(value, side)


def roll(gap: float = 0.01, along: int = 400, across: int = 24) -> Mesh:
    """A sheet rolled up three times, open."""
    turns, height = (t.ravel() for t in np.meshgrid(np.linspace(0, 3, along), np.linspace(0, 1, across), indexing="ij"))
    radius = 0.5 + gap * turns
    points = np.stack([radius * np.cos(2 * np.pi * turns), radius * np.sin(2 * np.pi * turns), height], axis=1)
    return points, grid_faces(along, across, False, False)


def noisy_ball(size: float) -> Mesh:
    return level_set(lambda x, y, z: np.sqrt(x * x + y * y + z * z) - 0.7 + noise(x.shape, size), 48)


def drilled_ball() -> Mesh:
    def value(x, y, z):
        bores = np.minimum.reduce([np.hypot(x, y), np.hypot(y, z), np.hypot(z, x)]) - 0.25
        return np.maximum(np.sqrt(x * x + y * y + z * z) - 0.9, -bores)

    return level_set(value, 56)


def knot(around: int = 300, sides: int = 24, radius: float = 0.3) -> Mesh:
    """A tube along a trefoil."""
    t = np.linspace(0, 2 * np.pi, around, endpoint=False)
    centre = np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], axis=1)
    along = np.roll(centre, -1, axis=0) - np.roll(centre, 1, axis=0)
    first = np.cross(along, [0.0, 0.0, 1.0])
    second = np.cross(along, first)
    first, second = (v / np.linalg.norm(v, axis=1, keepdims=True) for v in (first, second))
    angle = np.linspace(0, 2 * np.pi, sides, endpoint=False)[None, :, None]
    points = centre[:, None] + radius * (np.cos(angle) * first[:, None] + np.sin(angle) * second[:, None])
    return outward((points.reshape(-1, 3), grid_faces(around, sides, True, True)))


GENERATED: dict[str, Callable[[], Mesh]] = {
    "noisy ball": lambda: noisy_ball(0.003),
    "drilled ball": drilled_ball,
    "foam": lambda: foam(44, 1.0),
    "vessel": lambda: vessel(64),
    "bone": lambda: skull(56),
    "roll": roll,
    "plate 1 : 1000": lambda: of_poly(pyvista.Box((0, 1, 0, 1, 0, 0.001))),
    "lens 1 : 50": lambda: of_poly(pyvista.ParametricEllipsoid(1, 1, 0.02, u_res=90, v_res=45, w_res=45)),
    "ellipsoid 1 : 7": lambda: of_poly(pyvista.Icosphere(nsub=4).scale([7, 1, 1])),
    "cone": lambda: of_poly(pyvista.Cone(resolution=60)),
    "torus": lambda: of_poly(pyvista.ParametricTorus(u_res=60, v_res=30, w_res=30)),
    "tube knot": knot,
}
PYVISTA = {
    "ant": examples.antfile,
    "airplane": examples.planefile,
    "sphere": examples.spherefile,
    "nut": examples.nutfile,
}
INDUSTRIAL = {"scanned part": scanned_part, "foam": foam, "vessel": vessel, "bone": skull}
