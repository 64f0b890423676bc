"""Where the singular points of a resolved field are, to a small part of a mesh width, for the surface studies.

The zero of the interpolant in one triangle is off by up to half an edge length, as the values of one triangle depend on
how it lies; the zero of a smooth function fitted to the field in the whole core, of radius epsilon, is not. Charts must
keep angles: the plane itself, or a stereographic projection.
"""

import numpy as np


def fitted_zero(places: np.ndarray, values: np.ndarray) -> complex:
    """Of the least-squares a + b z + c conj(z) + (second order) + d z |z|^2, from 0 by Newton's method; 0 where it does
    not converge."""
    basis = lambda z: np.stack([1 + 0 * z, z, z.conj(), z**2, z * z.conj(), z.conj() ** 2, z**2 * z.conj()], axis=-1)
    if len(places) < 14:
        return 0j
    scale = abs(places).max()
    c = np.linalg.lstsq(basis(places / scale), values, rcond=None)[0]
    z = np.array(0j)
    for _ in range(30):
        f = basis(z) @ c
        fz, fc = (
            c[1] + 2 * c[3] * z + c[4] * z.conj() + 2 * c[6] * z * z.conj(),
            c[2] + c[4] * z + 2 * c[5] * z.conj() + c[6] * z**2,
        )
        step = (fz.conj() * f - fc * f.conj()) / (abs(fz) ** 2 - abs(fc) ** 2)
        z = z - step
        if not abs(z) < 1:
            return 0j
    return complex(z) * scale


def edge_vectors(mesh, field) -> tuple[np.ndarray, np.ndarray]:
    """Midpoints and vectors of the edges, (E, 3)."""
    ends = np.array(mesh.vertices)[np.array(field.domain.edges)]
    return ends.mean(axis=1), ends[:, 1] - ends[:, 0]


def core_radius(along: np.ndarray, epsilon: float) -> float:
    return max(0.8 * epsilon, 2 * float(np.linalg.norm(along, axis=1).mean()))


def located_in_plane(mesh, field, points: np.ndarray, epsilon: float) -> np.ndarray:
    """(n,) complex, from (n, 3)."""
    middles, along = edge_vectors(mesh, field)
    z, values = (
        middles[:, 0] + 1j * middles[:, 1],
        np.array(field.values) * np.exp(1j * field.symmetry * np.arctan2(along[:, 1], along[:, 0])),
    )
    found = []
    for start in points[:, 0] + 1j * points[:, 1]:
        core = abs(z - start) < core_radius(along, epsilon)
        found.append(start + fitted_zero(z[core] - start, values[core]))
    return np.array(found)


def located_on_sphere(mesh, field, points: np.ndarray, epsilon: float) -> np.ndarray:
    """(n, 3) on the unit sphere: in the stereographic projection from the antipode of each point."""
    middles, along = edge_vectors(mesh, field)
    middles /= np.linalg.norm(middles, axis=1, keepdims=True)
    found = []
    for start in points / np.linalg.norm(points, axis=1, keepdims=True):
        first = np.cross(start, np.eye(3)[abs(start).argmin()])
        first /= np.linalg.norm(first)
        second = np.cross(start, first)
        core = np.linalg.norm(middles - start, axis=1) < core_radius(along, epsilon)
        height, x, y = 1 + middles[core] @ start, middles[core] @ first, middles[core] @ second
        z = 2 * (x + 1j * y) / height
        # derivative of the projection along the edge
        dx, dy, dh = along[core] @ first, along[core] @ second, along[core] @ start
        angle = np.angle((dx + 1j * dy) / height - (x + 1j * y) * dh / height**2)
        zero = fitted_zero(z, np.array(field.values)[core] * np.exp(1j * field.symmetry * angle))
        square = abs(zero) ** 2 / 4
        found.append(((1 - square) * start + zero.real * first + zero.imag * second) / (1 + square))
    return np.array(found)
