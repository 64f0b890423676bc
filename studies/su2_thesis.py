"""The three schemes of Beaufort's thesis, section 4.4, with boundary frames held."""

import numpy as np
import octafield
from scipy.optimize import minimize
from scipy.sparse.linalg import splu
from su2_problems import Problem


def _fixed(problem: Problem) -> np.ndarray:
    return np.setdiff1d(np.arange(len(problem.mesh.vertices)), problem.free)


def linear(problem: Problem) -> np.ndarray:
    """4.4.1: h0, h1, h2 harmonic. The thesis leaves them off the model surface; here the nearest frames of each."""
    stiff, free, fixed = octafield.volume.stiffness(problem.mesh).tocsc(), problem.free, _fixed(problem)
    h = octafield.frames.su2_embed(problem.target)
    h[free] = splu(stiff[free][:, free]).solve(-stiff[free][:, fixed] @ h[fixed])
    frames = problem.target.copy()
    frames[free] = octafield.frames.su2_project(h[free])[0]
    return frames


def euler_angles(problem: Problem, start: np.ndarray) -> np.ndarray:
    """4.4.2: the Dirichlet energy of h over Euler angles about z, y, z at every vertex, by L-BFGS."""
    stiff, free = octafield.volume.stiffness(problem.mesh).tocsr(), problem.free

    def quaternions(angles):
        a, b, c = angles.reshape(-1, 3).T
        return np.stack(
            [
                np.cos(b / 2) * np.cos((a + c) / 2),
                np.sin(b / 2) * np.sin((c - a) / 2),
                np.sin(b / 2) * np.cos((c - a) / 2),
                np.cos(b / 2) * np.sin((a + c) / 2),
            ],
            1,
        )

    frames = problem.constraints.frames.copy()

    def energy(angles):
        frames[free] = quaternions(angles)
        h = octafield.frames.su2_embed(frames)
        pull = stiff @ h
        turn = np.einsum(
            "nij,ni->nj", octafield.frames.su2_differential(frames[free]), pull[free]
        )  # by world rotation vectors
        a = angles.reshape(-1, 3)[:, 0]
        about_b = np.stack([-np.sin(a), np.cos(a), 0 * a], 1)
        about_c = octafield.frames.rotation_matrices(frames[free])[:, :, 2]
        gradient = np.stack([turn[:, 2], np.sum(turn * about_b, 1), np.sum(turn * about_c, 1)], 1)
        return 0.5 * np.sum(h * pull), gradient.ravel()

    r = octafield.frames.rotation_matrices(start[free])
    begin = np.stack(
        [
            np.arctan2(r[:, 1, 2], r[:, 0, 2]),
            np.arccos(np.clip(r[:, 2, 2], -1, 1)),
            np.arctan2(r[:, 2, 1], -r[:, 2, 0]),
        ],
        1,
    )
    found = minimize(
        energy,
        begin.ravel(),
        jac=True,
        method="L-BFGS-B",
        options={"maxiter": 3000, "maxfun": 4000, "ftol": 1e-13, "gtol": 1e-8},
    )
    frames[free] = quaternions(found.x)
    return frames


def held_metric(problem: Problem, start: np.ndarray, steps: int = 200) -> np.ndarray:
    """4.4.3: int grad h M grad h^H with M = (J^+)^H J^+ interpolated from the vertices (the order of factors of
    su2_metric.hpp; as printed, (4.33) is no form on C^3). Gauss-Newton steps in which M is held, at most 0.1 rad each.
    """
    from scipy.sparse import csr_matrix

    tets, free = np.asarray(problem.mesh.tets), problem.free
    frames = start.copy()
    local = _element_stiffness(problem)
    number = np.full(len(frames), -1)
    number[free] = np.arange(len(free))
    rows = 3 * np.repeat(number[tets], 4, axis=1)[..., None, None] + np.arange(3)[:, None]
    columns = 3 * np.tile(number[tets], (1, 4))[..., None, None] + np.arange(3)
    inside = np.broadcast_to(((rows >= 0) & (columns >= 0)), np.broadcast_shapes(rows.shape, columns.shape))
    rows, columns = (np.broadcast_to(x, inside.shape)[inside] for x in (rows, columns))
    for _ in range(steps):
        m = octafield.frames.su2_pulled_back(frames)[tets].mean(1)  # (m, 3, 3)
        h, d = (
            octafield.frames.su2_complex(octafield.frames.su2_embed(frames)),
            octafield.frames.su2_differential(frames),
        )
        d = np.stack([octafield.frames.su2_complex(np.ascontiguousarray(d[:, :, k])) for k in range(3)], 2)[
            tets
        ]  # (m, 4, 3 of h, 3)
        pulled = np.einsum("tvik,tij->tvkj", d.conj(), m)
        force = np.einsum("tvw,tvkj,twj->tvk", local, pulled, h[tets]).real
        gradient = np.zeros((len(frames), 3))
        np.add.at(gradient, tets, force)
        blocks = np.einsum("tvw,tvkj,twjl->tvwkl", local, pulled, d).real.reshape(len(tets), 16, 3, 3)
        matrix = csr_matrix((blocks[inside], (rows, columns)), shape=(3 * len(free),) * 2).tocsc()
        step = -splu(matrix).solve(gradient[free].ravel()).reshape(-1, 3)
        largest = np.linalg.norm(step, axis=1).max()
        step *= min(1, 0.1 / largest)
        frames[free] = octafield.frames.frame_exp(frames[free], step)
        if largest < 1e-8:
            break
    return frames


def _element_stiffness(problem: Problem) -> np.ndarray:
    """(m, 4, 4) of every tet."""
    points, tets = np.asarray(problem.mesh.vertices), np.asarray(problem.mesh.tets)
    edges = points[tets[:, 1:]] - points[tets[:, :1]]
    gradients = np.linalg.inv(edges)
    gradients = np.concatenate([-gradients.sum(2, keepdims=True), gradients], 2)
    return np.einsum("t,tiv,tiw->tvw", np.abs(np.linalg.det(edges)) / 6, gradients, gradients)
