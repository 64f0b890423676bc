"""What the naive and the frozen scheme converge to on a bar, from their equations in the continuum.

In x = (u, v) in C^2 = R^4, on the unit 3-sphere; J = dh/d(u, v), H[a, b] its second derivative, J^+ the pseudo-inverse
  of J: harmonic (geodesic):  x'' = 0 tangentially naive:                J^H (J x'' + H[x', x']) = 0 tangentially
  (geodesic of the metric J^H J) frozen:               x'' = (J^+ H[x', .])^H x' tangentially
"""

import numpy as np
from scipy.integrate import solve_bvp


def jacobian(x: np.ndarray) -> np.ndarray:
    u, v = x
    a, b = u**4, v**4
    g0, g2 = u * v * (a - b), (a + b) * ((a + b) ** 2 - 36 * a * b)
    d0 = np.array([v * (5 * a - b), u * (a - 5 * b)])
    d2 = 12 * np.array([u**3 * (a * a - 22 * a * b - 11 * b * b), v**3 * (b * b - 22 * a * b - 11 * a * a)])
    return np.array([8 * np.array([u**3 * (a + 7 * b), v**3 * (b + 7 * a)]), 2 * g0 * d0, g2 * d0 + g0 * d2])


def second(x: np.ndarray, along: np.ndarray) -> np.ndarray:
    """H[along, .], 3 x 2, by a central difference of the polynomial J."""
    step = 1e-5
    return (jacobian(x + step * along) - jacobian(x - step * along)) / (2 * step)


def as_complex(x: np.ndarray) -> np.ndarray:
    return np.array([x[0] + 1j * x[1], x[2] + 1j * x[3]])


def as_real(z: np.ndarray) -> np.ndarray:
    return np.array([z[0].real, z[0].imag, z[1].real, z[1].imag])


def acceleration(scheme: str, x: np.ndarray, v: np.ndarray) -> np.ndarray:
    """x'' of the path in R^4."""
    z, w = as_complex(x), as_complex(v)
    if scheme == "frozen":
        force = as_real((np.linalg.pinv(jacobian(z)) @ second(z, w)).conj().T @ w)
        return force - x * (x @ force) - x * (v @ v)
    basis = np.linalg.svd(x[None])[2][1:]  # orthonormal tangents, as rows
    j = jacobian(z)
    moved = np.array([j @ as_complex(t) for t in basis])
    rest = j @ as_complex(-x * (v @ v)) + second(z, w) @ w
    matrix = (moved.conj() @ moved.T).real
    return basis.T @ np.linalg.solve(matrix, -(moved.conj() @ rest).real) - x * (v @ v)


def path(scheme: str, ends: np.ndarray, at: np.ndarray) -> np.ndarray:
    """(len(at), 4) unit quaternions of the scheme's limit between two frames given as quaternions w x y z."""
    t = np.linspace(0, 1, 101)
    angle = np.arccos(ends[0] @ ends[1])
    x = (np.sin((1 - t) * angle)[:, None] * ends[0] + np.sin(t * angle)[:, None] * ends[1]) / np.sin(angle)

    def rate(_, y):
        return np.vstack([y[4:], np.array([acceleration(scheme, p[:4], p[4:]) for p in y.T]).T])

    solved = solve_bvp(
        rate,
        lambda a, b: np.concatenate([a[:4] - ends[0], b[:4] - ends[1]]),
        t,
        np.vstack([x.T, np.gradient(x, t, axis=0).T]),
        tol=1e-6,
        max_nodes=20_000,
    )
    if not solved.success:
        raise RuntimeError(f"{scheme}: {solved.message}")
    y = solved.sol(at)[:4].T
    return y / np.linalg.norm(y, axis=1, keepdims=True)
