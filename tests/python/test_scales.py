"""Sizes along the axes: against least squares made with numpy, known maps, and the derivation."""

import numpy as np
import octafield as of
import pytest
import scipy.sparse as sparse
import scipy.sparse.linalg
import sympy
from conftest import box_tets
from octahedral_fixtures import GROUP, closest, matrices


def smooth_field(mesh):
    x, y, z = np.asarray(mesh.vertices).T
    return of.frames.quaternion_exp(np.column_stack([0.3 * np.sin(2 * y), 0.2 * x * z, 0.4 * x - 0.2 * z]))


def gradient_rows(mesh):
    """(3 m, n) gradients of the hat functions and the volumes, by numpy."""
    points, tets = np.asarray(mesh.vertices), np.asarray(mesh.tets)
    inverse = np.linalg.inv(points[tets[:, 1:]] - points[tets[:, :1]])  # columns: gradients of hats 1 to 3
    hats = np.concatenate([-inverse.sum(axis=2, keepdims=True), inverse], axis=2)
    rows = np.repeat(np.arange(3 * len(tets)), 4)
    return sparse.csr_matrix(
        (hats.ravel(), (rows, np.repeat(tets, 3, axis=0).ravel())), shape=(3 * len(tets), len(points))
    )


def test_scales_are_those_of_least_squares_made_with_numpy(box):
    """The curl of all tets as one overdetermined system in H, solved by LSQR: no Poisson equation, no integration by
    parts."""
    frames, volumes = smooth_field(box), of.volume.tet_volumes(box)
    gradients = gradient_rows(box)
    axes = matrices(frames)  # continuous, and so near to one another that no tet needs another representative
    centre = matrices(of.volume.tet_frames(box, frames))
    middle = axes[np.asarray(box.tets)].mean(axis=1)
    order, _ = closest(centre, middle)
    centre = np.einsum("tij,tjk->tik", centre, GROUP[order])
    weights = np.sqrt(np.repeat(volumes, 3))
    alone, along, curls, loads = [], [], [], []
    for i in range(3):
        jacobian = (gradients @ axes[:, :, i]).reshape(-1, 3, 3)  # [t, direction, component]
        curl = np.stack(
            [jacobian[:, (k + 1) % 3, (k + 2) % 3] - jacobian[:, (k + 2) % 3, (k + 1) % 3] for k in range(3)], axis=1
        )
        n = centre[:, :, i]
        cross = np.zeros((len(n), 3, 3))  # g x n as a matrix times g
        cross[:, [0, 1, 2], [1, 2, 0]], cross[:, [1, 2, 0], [0, 1, 2]] = n[:, [2, 0, 1]], -n[:, [2, 0, 1]]
        alone.append(sparse.diags(weights) @ sparse.block_diag(cross, format="csr") @ gradients)
        along.append(sparse.diags(np.sqrt(volumes)) @ sparse.block_diag(n[:, None, :], format="csr") @ gradients)
        curls.append(weights * curl.ravel())
        loads.append((curl * n).sum(axis=1))

    def solve(system, right):
        return scipy.sparse.linalg.lsqr(system, -right, atol=1e-14, btol=1e-14, iter_lim=20000)

    one = of.volume.isotropic_scale(box, frames)
    x, *_, norm = solve(sparse.vstack(alone), np.concatenate(curls))[:4]
    np.testing.assert_allclose(one.log_scale - one.log_scale.mean(), x - x.mean(), atol=1e-6)
    assert one.after.curl_rms == pytest.approx(norm / np.sqrt(volumes.sum()), rel=1e-6)
    assert one.before.curl_rms == pytest.approx(
        np.linalg.norm(np.concatenate(curls)) / np.sqrt(volumes.sum()), rel=1e-12
    )

    three = of.volume.axis_scales(box, frames, along=0.05)
    corners = np.asarray(three.values)[np.asarray(three.unknowns).reshape(-1, 4, 3)]
    left = 0
    for i in range(3):
        system = sparse.vstack([alone[i], np.sqrt(0.05) * along[i]])
        x = solve(system, np.concatenate([curls[i], np.zeros(len(volumes))]))[0]
        left += np.sum((alone[i] @ x + curls[i]) ** 2)
        which = abs(np.einsum("tji,tj->ti", matrices(three.of_tets), centre[:, :, i])).argmax(axis=1)
        mine = corners[np.arange(len(which)), :, which]
        exact = x[np.asarray(box.tets)]
        np.testing.assert_allclose(mine - mine.mean(), exact - exact.mean(), atol=1e-6)
        np.testing.assert_allclose(
            np.asarray(three.log_scales)[np.arange(len(which)), which], mine.mean(axis=1), atol=1e-14
        )
    assert three.after.curl_rms == pytest.approx(np.sqrt(left / volumes.sum()), rel=1e-6)
    assert three.parts == 3 and three.after.curl_rms < one.after.curl_rms < one.before.curl_rms


def test_scales_of_polar_coordinates_are_one_over_the_radius():
    grid = box_tets(8)
    x, y, z = np.asarray(grid.vertices).T
    r, angle = 1 + x, 1.5 * y
    mesh = of.TetMesh(np.column_stack([r * np.cos(angle), r * np.sin(angle), z]), grid.tets)
    frames = of.frames.quaternion_exp(np.column_stack([0 * r, 0 * r, angle]))
    one, three = of.volume.isotropic_scale(mesh, frames), of.volume.axis_scales(mesh, frames)
    assert np.std(one.log_scale + np.log(r) / 2) < 0.01 and np.std(np.log(r)) > 0.15
    assert one.after.curl_rms / one.before.curl_rms == pytest.approx(0.5**0.5, rel=0.02)
    assert three.after.curl_rms < 0.13 * three.before.curl_rms
    assert "before" in repr(one) and "3 sets" in repr(three) and "curl" in repr(one.after)


def test_the_derivation_of_the_scales():
    """By sympy. In the plane grad a = grad H x n (Beaufort 2019, (5.5)) makes exp(H) times the axes gradients, and
    exp(-H) times them fields that commute."""
    p = sympy.symbols("x y z")

    def curl(v):
        return sympy.Matrix(
            [v[(k + 2) % 3].diff(p[(k + 1) % 3]) - v[(k + 1) % 3].diff(p[(k + 2) % 3]) for k in range(3)]
        )

    def along(u, v):  # (u . grad) v
        return sympy.Matrix([sum(u[j] * v[i].diff(p[j]) for j in range(3)) for i in range(3)])

    a, b = sympy.Function("a")(*p), sympy.Function("b")(*p)
    n = sympy.Matrix([sympy.cos(a) * sympy.sin(b), sympy.sin(a) * sympy.sin(b), sympy.cos(b)])  # any unit field
    assert (n.cross(curl(n)) + along(n, n)).applyfunc(sympy.simplify).is_zero_matrix

    t, h = sympy.Function("t")(*p[:2]), sympy.Function("h")(*p[:2])
    axes = [sympy.Matrix([sympy.cos(t), sympy.sin(t), 0]), sympy.Matrix([-sympy.sin(t), sympy.cos(t), 0])]
    held = {h.diff(p[0]): -t.diff(p[1]), h.diff(p[1]): t.diff(p[0])}
    gradient = sympy.Matrix([h.diff(p[0]), h.diff(p[1]), 0])
    difference = sympy.Matrix([t.diff(p[0]), t.diff(p[1]), 0]) - gradient.cross(sympy.Matrix([0, 0, 1]))
    assert difference.subs(held).is_zero_matrix
    assert all(curl(sympy.exp(h) * n).subs(held).applyfunc(sympy.simplify).is_zero_matrix for n in axes)
    u, v = (sympy.exp(-h) * n for n in axes)
    assert (along(u, v) - along(v, u)).subs(held).applyfunc(sympy.simplify).is_zero_matrix


def test_weights_that_are_none_are_refused(box):
    for bad in (0, 2, float("nan")):
        with pytest.raises(of.InvalidInput):
            of.volume.axis_scales(box, np.tile([1.0, 0, 0, 0], (len(box.vertices), 1)), along=bad)
