"""Finite elements of first order on meshes of mixed cells: every cell is a hexahedron some of whose corners coincide.

The trilinear map of such a hexahedron gives the linear functions of a tet, those of a wedge, and on a pyramid the
rational ones (Bedrosian 1992), which are bilinear on the base and linear on the triangles: neighbours agree on every
shared face. Two Gauss points per direction integrate the gradients of a mesh's functions exactly, so that a linear
solution is found exactly (the patch test).
"""

from collections.abc import Callable

import numpy as np
from scipy.sparse import csr_matrix, diags
from scipy.sparse.linalg import LinearOperator, cg, splu

from .checker import AS_HEXAHEDRON, gauss, shape_gradients

Function = Callable[[np.ndarray], np.ndarray]
PART = 20_000  # cells at a time
DIRECT = 8_000  # unknowns below which the system is factored


def as_hexahedra(cells: dict[str, np.ndarray]) -> np.ndarray:
    return np.concatenate([np.asarray(rows, np.int64)[:, AS_HEXAHEDRON[kind]] for kind, rows in cells.items()])


def parts(points: np.ndarray, hexahedra: np.ndarray, order: int):
    """Of some cells at a time: corners, shape functions (p, 8), gradients (n, p, 8, 3), weights (n, p), places."""
    at, weights = gauss(order)
    shapes, derivatives = shape_gradients(at)
    for rows in np.array_split(hexahedra, max(len(hexahedra) // PART, 1)):
        maps = np.einsum("nkx,pkd->npxd", points[rows], derivatives)
        gradients = np.einsum("pkd,npdx->npkx", derivatives, np.linalg.inv(maps))
        places = np.einsum("pk,nkx->npx", shapes, points[rows])
        yield rows, shapes, gradients, np.linalg.det(maps) * weights, places


def assemble(points: np.ndarray, hexahedra: np.ndarray, source: Function) -> tuple[csr_matrix, np.ndarray]:
    """Stiffness matrix, and the load of `source` by three Gauss points per direction."""
    size = len(points)
    matrix, load = csr_matrix((size, size)), np.zeros(size)
    for rows, _, gradients, weights, _ in parts(points, hexahedra, 2):
        blocks = np.einsum("npix,npjx,np->nij", gradients, gradients, weights)
        i, j = np.repeat(rows, 8, axis=1), np.tile(rows, (1, 8))
        matrix = matrix + csr_matrix((blocks.ravel(), (i.ravel(), j.ravel())), (size, size))
    for rows, shapes, _, weights, places in parts(points, hexahedra, 3):
        np.add.at(load, rows, np.einsum("pk,np,np->nk", shapes, weights, source(places)))
    return matrix, load


def solve(points, cells, boundary: np.ndarray, exact: Function, source: Function) -> np.ndarray:
    """Values at the vertices of the solution of -laplace u = source with u = exact at `boundary` vertices."""
    matrix, load = assemble(points, as_hexahedra(cells), source)
    values = np.zeros(len(points))
    values[boundary] = exact(points[boundary])
    free = np.setdiff1d(np.unique(np.concatenate([rows.ravel() for rows in cells.values()])), boundary)
    inner = matrix[free][:, free]
    right = load[free] - matrix[free] @ values
    if len(free) <= DIRECT:
        values[free] = splu(inner.tocsc()).solve(right)
        return values
    scaling = diags(1 / inner.diagonal())
    found, failed = cg(inner, right, rtol=1e-11, maxiter=20_000, M=LinearOperator(inner.shape, scaling.dot))
    if failed:
        raise RuntimeError(f"conjugate gradients stopped with {failed}")
    values[free] = found
    return values


def errors(points, cells, values: np.ndarray, exact: Function, gradient: Function) -> tuple[float, float]:
    """L2 of the values and of the gradients (H1 seminorm), each relative to the solution's, by three Gauss points."""
    sums = np.zeros(4)
    for rows, shapes, gradients, weights, places in parts(points, as_hexahedra(cells), 3):
        u, slope = exact(places), gradient(places)
        miss = values[rows] @ shapes.T - u
        wrong = np.einsum("npkx,nk->npx", gradients, values[rows]) - slope
        squares = (miss**2, u**2, (wrong**2).sum(axis=-1), (slope**2).sum(axis=-1))
        sums += [float((weights * square).sum()) for square in squares]
    return float(np.sqrt(sums[0] / sums[1])), float(np.sqrt(sums[2] / sums[3]))
