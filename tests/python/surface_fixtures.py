"""Small open surfaces for the tests of direction fields and streamlines."""

import numpy as np
import octafield as of


def at_angle(angle: float) -> np.ndarray:
    return np.array([np.cos(angle), np.sin(angle), 0])


def grid_triangles(rows: int, columns: int, closed: bool = False) -> np.ndarray:
    """Two triangles per cell of a grid of rows x columns points, row by row; closed: the last column meets the
    first."""
    cells = []
    for i in range(rows - 1):
        for j in range(columns if closed else columns - 1):
            k = (j + 1) % columns
            a, b, c, d = i * columns + j, i * columns + k, (i + 1) * columns + k, (i + 1) * columns + j
            cells += [(a, b, c), (a, c, d)]
    return np.array(cells)


def square(n: int) -> of.TriangleMesh:
    """The unit square in the plane z = 0, n^2 cells."""
    y, x = np.divmod(np.arange((n + 1) ** 2), n + 1)
    return of.TriangleMesh(np.column_stack([x / n, y / n, 0 * x]), grid_triangles(n + 1, n + 1))


def cylinder(radius: float, height: float, around: int, along: int) -> of.TriangleMesh:
    """Open at both ends, normals outward."""
    row, column = np.divmod(np.arange((along + 1) * around), around)
    angle = 2 * np.pi * column / around
    points = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), height * row / along])
    return of.TriangleMesh(points, grid_triangles(along + 1, around, closed=True))


def polygon(corners) -> of.TriangleMesh:
    """A fan of triangles, to be remeshed."""
    points = np.array([(*corner, 0) for corner in corners], float)
    return of.TriangleMesh(points, [[0, k, k + 1] for k in range(1, len(points) - 1)])


def right_triangle(degrees):
    """Its corners: a side of 1 along x, and the angle at the origin."""
    return [(0, 0), (1, 0), (1, np.tan(np.radians(degrees)))]


def prism(degrees, height=0.6) -> of.TriangleMesh:
    """Over the right triangle, its sharp edge along z."""
    plane = np.array(right_triangle(degrees))
    points = np.concatenate([np.column_stack([plane, np.full(3, z)]) for z in (0, height)])
    sides = [t for a, b in ((0, 1), (1, 2), (2, 0)) for t in ([a, b, b + 3], [a, b + 3, a + 3])]
    return of.TriangleMesh(points, [[0, 2, 1], [3, 4, 5], *sides])
