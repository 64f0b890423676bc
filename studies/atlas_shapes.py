"""Surfaces for studies.atlas that come from no file of the data: examples of pyvista, and level sets on a grid (VTK's
flying edges) that stand in for the scans of Beaufort's thesis: a part with noise, a foam, a branching vessel, an
isosurface with many handles.

Each maker returns a closed octafield.TriangleMesh, or one that `repair` mends; SHAPES holds them by name. n: points of
the grid along each side.
"""

from collections.abc import Callable

import numpy as np
import octafield
import pyvista
from pyvista import examples
from scipy.ndimage import gaussian_filter

SIDE = 1.3  # half of it


def of_poly(poly: pyvista.PolyData) -> octafield.TriangleMesh:
    clean = poly.triangulate().clean()
    triangles = clean.faces.reshape(-1, 4)[:, 1:].astype(np.int32)
    mesh = octafield.TriangleMesh(np.asarray(clean.points, float), triangles)
    if octafield.surface.signed_volume(mesh) < 0:
        mesh = octafield.TriangleMesh(mesh.vertices, triangles[:, ::-1])
    return mesh


def grid(n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    x = np.linspace(-SIDE, SIDE, n)
    return tuple(np.meshgrid(x, x, x, indexing="ij"))


def level_set(values: np.ndarray) -> octafield.TriangleMesh:
    """The largest connected part of where they are 0."""
    n = len(values)
    image = pyvista.ImageData(dimensions=(n,) * 3, spacing=(2 * SIDE / (n - 1),) * 3, origin=(-SIDE,) * 3)
    image["values"] = values.ravel(order="F")
    return of_poly(image.contour([0.0], scalars="values", method="flying_edges").connectivity("largest"))


def noise(n: int, width: float) -> np.ndarray:
    """Smooth over `width` of 80 grid points, of variance 1."""
    values = gaussian_filter(np.random.default_rng(0).standard_normal((n, n, n)), width * n / 80)
    return values / values.std()


def potato(n: int) -> octafield.TriangleMesh:
    x, y, z = grid(n)
    return level_set(np.sqrt(x**2 + y**2 + z**2) - 0.9 + 0.2 * noise(n, 8))


def foam(n: int) -> octafield.TriangleMesh:
    x, y, z = grid(n)
    return level_set(np.maximum(np.abs(noise(n, 5)) - 0.5, np.sqrt(x**2 + y**2 + z**2) - 1.1))


def gyroid(n: int) -> octafield.TriangleMesh:
    x, y, z = (4 * c for c in grid(n))
    wave = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
    return level_set(np.maximum(np.abs(wave) - 0.5, np.sqrt(x**2 + y**2 + z**2) / 4 - 1))


def double_torus(n: int) -> octafield.TriangleMesh:
    x, y, z = grid(n)
    return level_set((x**2 * (1 - x**2) - y**2) ** 2 + z**2 / 2 - 0.02)


def vessel(n: int) -> octafield.TriangleMesh:
    points = np.stack(grid(n), axis=-1)

    def branch(start: tuple, end: tuple, radius: float) -> np.ndarray:
        way = np.subtract(end, start)
        share = np.clip((points - start) @ way / (way @ way), 0, 1)
        return np.linalg.norm(points - start - share[..., None] * way, axis=-1) - radius

    branches = [
        branch((0, 0, -1.1), (0, 0, 0), 0.2), branch((0, 0, 0), (0.7, 0, 0.7), 0.15),
        branch((0, 0, 0), (-0.7, 0.1, 0.6), 0.15), branch((0.7, 0, 0.7), (1.1, 0.3, 1.0), 0.1),
        branch((0.7, 0, 0.7), (0.6, -0.3, 1.1), 0.1), branch((-0.7, 0.1, 0.6), (-1.1, 0.1, 1.1), 0.1),
    ]  # fmt: skip
    return level_set(-np.log(sum(np.exp(-20 * b) for b in branches)) / 20)


def scanned_part(n: int) -> octafield.TriangleMesh:
    """A block with a bore and a step, with noise as of a scanner."""
    x, y, z = grid(n)
    block = np.maximum.reduce([np.abs(x) - 0.9, np.abs(y) - 0.6, np.abs(z) - 0.5])
    step = np.maximum(0.1 - x, 0.1 - z)
    bore = 0.25 - np.hypot(x + 0.4, y)
    return level_set(np.maximum.reduce([block, -step, bore]) + 0.004 * noise(n, 1))


SHAPES: dict[str, Callable[[], octafield.TriangleMesh]] = {
    "ant": lambda: of_poly(examples.load_ant()),
    "nut": lambda: of_poly(examples.load_nut()),
    "airplane": lambda: of_poly(examples.load_airplane()),
    "sphere": lambda: of_poly(examples.load_sphere()),
    "icosphere": lambda: of_poly(pyvista.Icosphere(nsub=4)),
    "torus": lambda: of_poly(pyvista.ParametricTorus(u_res=100, v_res=60)),
    "spheroid 20:1": lambda: of_poly(pyvista.Icosphere(nsub=5).scale((1, 1, 20))),
    "potato": lambda: potato(80),
    "double torus": lambda: double_torus(80),
    "vessel": lambda: vessel(80),
    "gyroid": lambda: gyroid(60),
    "foam": lambda: foam(80),
    "scanned part": lambda: scanned_part(80),
}
