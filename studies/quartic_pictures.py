"""The quartic x^4 + y^4 + z^4 of a frame: three ways to evaluate it, and pictures of it (for thesis_frames.py)."""

import numpy as np
import octafield
from octafield.view.plots import PALETTE

# ---- the quartic of a frame


def quartic(points: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Sum of the fourth powers of the coordinates along the axes of frame q, (1, 4), at (n, 3) points."""
    return np.sum((points @ octafield.frames.rotation_matrices(q)[0]) ** 4, axis=1)


def quartic_by_harmonics(directions: np.ndarray, q: np.ndarray) -> np.ndarray:
    sh4 = (
        octafield.frames.sh4_embed(q)[0] * (4 * np.sqrt(np.pi) / 15) / np.sqrt(7 / 12)
    )  # the identity frame is sqrt(7/12) at Y40
    return 3 / 5 + octafield.frames.harmonics_evaluate(4, directions) @ sh4


def quartic_by_tensor(points: np.ndarray, q: np.ndarray) -> np.ndarray:
    tensor = octafield.frames.tensor4_full(octafield.frames.tensor4_embed(q))[0]
    return np.einsum("ijkl,ni,nj,nk,nl->n", tensor, points, points, points, points, optimize=True)


def printed_y40_y44(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The thesis's expressions, misprint included."""
    x, y, z = points.T
    y40 = (
        3
        / 16
        * np.sqrt(1 / np.pi)
        * (3 * x**4 + 3 * y**4 + 8 * z**4 + 6 * x**2 * y**2 - 24 * x**2 * z**2 - 24 * y**2 * z**2)
    )
    y44 = 3 / 16 * np.sqrt(35 / np.pi) * (x**4 + y**4 - 6 * x**2 * y**2 + 12)
    return y40, y44


def sphere_grid(step: float = 3) -> np.ndarray:
    polar, azimuth = np.meshgrid(
        np.radians(np.arange(0, 180.1, step)), np.radians(np.arange(0, 360, step)), indexing="ij"
    )
    return np.stack([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)], axis=-1).reshape(
        -1, 3
    )


# ---- pictures of solids, seen from SIGHT in parallel projection

SIGHT = np.array([2.0, 1.1, 1.2]) / np.linalg.norm([2.0, 1.1, 1.2])
RIGHT = np.cross([0, 0, 1], SIGHT) / np.linalg.norm(np.cross([0, 0, 1], SIGHT))
UP = np.cross(SIGHT, RIGHT)
EXTENT = 1.5


def screen(size: int) -> np.ndarray:
    """(size * size, 3) points of the picture plane, top row first."""
    line = np.linspace(-EXTENT, EXTENT, size)
    across, upwards = np.meshgrid(line, line[::-1])
    return across.reshape(-1, 1) * RIGHT + upwards.reshape(-1, 1) * UP


def hits_of_sphere(plane: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    square = 1 - np.sum(plane**2, axis=1)
    return plane + np.sqrt(np.maximum(square, 0))[:, None] * SIGHT, square > 0


def hits_of_isosurface(plane: np.ndarray, q: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points where quartic = 1 first meets the line of sight, whether it does, and the unit normals. The quartic is
    convex along a line, so Newton steps from outside come down on the root without passing it."""
    axes = octafield.frames.rotation_matrices(q)[0]
    start, along = plane @ axes, SIGHT @ axes
    depth = np.full(len(plane), 2.0)
    for _ in range(40):
        local = start + depth[:, None] * along
        cube = local * local * local
        step = np.maximum(np.sum(cube * local, axis=1) - 1, 0) / np.maximum(4 * cube @ along, 1e-3)
        depth = np.maximum(depth - step, -2)  # lines that miss end there
    points = plane + depth[:, None] * SIGHT
    normals = (points @ axes) ** 3 @ axes.T
    return points, abs(quartic(points, q) - 1) < 1e-6, normals / np.linalg.norm(normals, axis=1, keepdims=True)


def lit(normals: np.ndarray) -> np.ndarray:
    """Colours of a matt surface under a light above the viewer's right shoulder."""
    light = 0.8 * SIGHT + 0.4 * RIGHT + 0.5 * UP
    brightness = 0.45 + 0.55 * np.maximum(normals @ light / np.linalg.norm(light), 0)
    return brightness[:, None] * (0.66, 0.82, 0.96)


def draw_frame(axes, q: np.ndarray, length: float = 1.45) -> None:
    """The frame's axes where the solid, on which they end at distance 1, does not hide them."""
    for direction, color in zip(octafield.frames.rotation_matrices(q)[0].T, (PALETTE[1], PALETTE[2], PALETTE[3])):
        for end in (direction, -direction):
            line = np.outer((1, length), end)
            axes.plot(line @ RIGHT, line @ UP, color=color, linewidth=2.4, zorder=3 if end @ SIGHT > 0 else 0)
    axes.set(xlim=(-EXTENT, EXTENT), ylim=(-EXTENT, EXTENT), aspect="equal")
    axes.set_axis_off()


def show(axes, values: np.ndarray, seen: np.ndarray, size: int, **options):
    if values.ndim == 1:
        values = np.where(seen, values, np.nan)
    else:
        values = np.concatenate([values, seen[:, None]], axis=1)
    shape = (size, size) if values.ndim == 1 else (size, size, 4)
    return axes.imshow(values.reshape(shape), extent=2 * (-EXTENT, EXTENT), zorder=2, **options)
