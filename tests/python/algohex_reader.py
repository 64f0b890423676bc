"""What AlgoHex computes of a mesh with frames in its tets (SingularGraphExtractionT_impl.hh), one element at a time,
from the layouts alone: against the HalffaceTransiton and edge_valance of a file. Shares nothing with octafield.

Quaternions are w x y z here. Half-face h of cell c has a normal into c; t of h: q_c t is close to the q of the cell
beyond.
"""

import itertools

import numpy as np
from scipy.spatial.transform import Rotation

H, S = 0.5, np.sqrt(0.5)
# TransitionQuaternionEigen.cc, in its order: identity; half turns about x, y, z; quarter turns about x, -x, y, -y, z,
# -z; half turns about (x,y), (y,z), (z,x), (y,-x), (z,-y), (x,-z); third turns about the diagonals +++, ++-, +-+, +--,
# -++, -+-, --+, ---.
TRANSITIONS = np.array(
    [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)]
    + [(S, S, 0, 0), (S, -S, 0, 0), (S, 0, S, 0), (S, 0, -S, 0), (S, 0, 0, S), (S, 0, 0, -S)]
    + [(0, S, S, 0), (0, 0, S, S), (0, S, 0, S), (0, -S, S, 0), (0, 0, -S, S), (0, S, 0, -S)]
    + [(H, H * a, H * b, H * c) for a, b, c in itertools.product((1, -1), repeat=3)]
)
COMPLEX, UNDETERMINED = 2**31 - 1, -(2**31)


def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Of quaternions, by Hamilton's rules."""
    return np.array(
        [
            a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
        ]
    )


def nearest(q: np.ndarray) -> int:
    return int(np.abs(TRANSITIONS @ q).argmax())


PRODUCT = [[nearest(product(a, b)) for b in TRANSITIONS] for a in TRANSITIONS]


def matrix(q: np.ndarray) -> np.ndarray:
    return Rotation.from_quat(q[[1, 2, 3, 0]]).as_matrix()


class Mesh:
    """found: of other_readers.ovm_binary."""

    def __init__(self, found: dict):
        self.points, self.edges, self.faces, self.cells = (
            found["Vertices"],
            found["Edges"],
            found["Faces"],
            found["Polyhedra"],
        )
        self.frames = found["CProp", "FrameFieldQuaternions"][:, [3, 0, 1, 2]]
        self.transition = found["HFProp", "HalffaceTransiton"].ravel().tolist()
        self.valence = found["EProp", "edge_valance"].ravel().tolist()
        self.cell_of = {h: c for c, half_faces in enumerate(self.cells.tolist()) for h in half_faces}

    def half_edges(self, half_face: int) -> list[int]:
        loop = self.faces[half_face // 2].tolist()
        return loop if half_face % 2 == 0 else [h ^ 1 for h in loop[::-1]]

    def around(self) -> dict[int, list[int]]:
        """Half-faces with a cell, by their half-edges."""
        found: dict[int, list[int]] = {}
        for half_face in self.cell_of:
            for half_edge in self.half_edges(half_face):
                found.setdefault(half_edge, []).append(half_face)
        return found

    def beside(self, half_face: int, edge: int) -> int:
        """The other half-face of its cell at the edge."""
        (other,) = (
            h
            for h in self.cells[self.cell_of[half_face]].tolist()
            if h != half_face and edge in [e // 2 for e in self.half_edges(h)]
        )
        return other

    def outward(self, half_face: int) -> np.ndarray:
        a, b, c = (self.points[self.edges[e // 2][e % 2]] for e in self.half_edges(half_face))
        return -np.cross(b - a, c - a)

    def direction(self, edge: int) -> np.ndarray:
        return self.points[self.edges[edge][1]] - self.points[self.edges[edge][0]]


def check_transitions(mesh: Mesh) -> None:
    """-1 on the boundary; else the closest of 24, opposite ones inverse."""
    for half_face, cell in mesh.cell_of.items():
        t = mesh.transition[half_face]
        if half_face ^ 1 not in mesh.cell_of:
            assert t == mesh.transition[half_face ^ 1] == -1
            continue
        beyond = mesh.frames[mesh.cell_of[half_face ^ 1]]
        dots = [abs(product(mesh.frames[cell], o) @ beyond) for o in TRANSITIONS]
        assert dots[t] > max(dots) - 1e-12
        assert PRODUCT[t][mesh.transition[half_face ^ 1]] == 0


def check_valences(mesh: Mesh) -> dict:
    """Every edge; how many inside are regular, of quarter turns (three, too), of half turns, of whole turns, complex,
    and of each valence, and how many of the boundary are not 0."""
    around, counts = mesh.around(), dict.fromkeys(("regular", "quarter", "half", "complex", "boundary"), 0)
    for edge, valence in enumerate(mesh.valence):
        here = around[2 * edge]
        outer = [h for h in here if h ^ 1 not in mesh.cell_of]
        if outer:
            (start,) = outer
            assert valence == boundary_valence(mesh, edge, start), edge
            counts["boundary"] += valence != 0
            continue
        start = min(here, key=lambda h: mesh.cell_of[h ^ 1])  # AlgoHex begins where its iterator does
        cell, turn = once_round(mesh, edge, start)
        along = mesh.direction(edge) @ matrix(mesh.frames[cell]) @ TRANSITIONS[turn][1:]
        turned = carried_round(
            mesh, edge, start
        )  # AlgoHex adds up the angles of the steps: so many quarters about the edge
        quarters = 4 * np.arccos(np.clip(turned[0], -1, 1)) / np.pi * np.sign(turned[1:] @ mesh.direction(edge))
        if valence == 0:
            assert turn == 0 and np.isclose(turned[0], 1)
            counts["regular"] += 1
        elif valence == COMPLEX:
            assert turn >= 10
            counts["complex"] += 1
        elif valence == 4:
            assert turn == 0 and np.isclose(turned[0], -1)
            counts["whole"] = counts.get("whole", 0) + 1
        elif valence == UNDETERMINED:
            assert turn <= 9 and abs(along) < 1e-5
        else:  # valence 3: a quarter turn about the edge as one goes round it, right-handed; valence 5: back
            assert turn <= 9 and np.isclose(valence, -quarters)
            counts["half" if turn <= 3 else "quarter"] += 1
            counts["valence", valence] = counts.get(("valence", valence), 0) + 1
    return counts


def carried_round(mesh: Mesh, edge: int, start: int) -> np.ndarray:
    """The quaternion in space by which the frame of the cell before the first half-face comes back turned: of its 48
    quaternions each cell takes the one nearest to that of the cell before."""
    first = mesh.frames[mesh.cell_of[start ^ 1]]
    here, carried = start, first
    while True:
        names = [product(mesh.frames[mesh.cell_of[here]], sign * o) for o in TRANSITIONS for sign in (1, -1)]
        carried = max(names, key=lambda q: float(q @ carried))
        here = mesh.beside(here, edge) ^ 1
        if here == start:
            return product(carried, first * [1, -1, -1, -1])


def once_round(mesh: Mesh, edge: int, start: int) -> tuple[int, int]:
    """The cell before the first half-face, and its frame's turn: t_n ... t_1 of the half-faces entered."""
    here, turn = start, 0
    while True:
        turn = PRODUCT[mesh.transition[here]][turn]
        here = mesh.beside(here, edge) ^ 1
        if here == start:
            return mesh.cell_of[start ^ 1], turn


def boundary_valence(mesh: Mesh, edge: int, start: int) -> int:
    here, turn = start, 0
    while (following := mesh.beside(here, edge)) ^ 1 in mesh.cell_of:
        here = following ^ 1
        turn = PRODUCT[mesh.transition[here]][turn]
    last = mesh.beside(here, edge)
    first_axis = closest_axis(mesh.frames[mesh.cell_of[start]], mesh.outward(start))
    last_axis = closest_axis(mesh.frames[mesh.cell_of[last]], mesh.outward(last))
    back = np.rint(matrix(TRANSITIONS[turn]).T @ last_axis)
    if np.array_equal(first_axis, back):
        return 0
    if np.array_equal(first_axis, -back):
        return -2 if inner_angle(mesh, edge, start, last) < np.pi else 2
    third = matrix(mesh.frames[mesh.cell_of[start]]) @ np.cross(first_axis, back)
    return 1 if -third @ mesh.direction(edge) < 0 else -1


def inner_angle(mesh: Mesh, edge: int, start: int, last: int) -> float:
    n, m, e = (v / np.linalg.norm(v) for v in (mesh.outward(start), mesh.outward(last), mesh.direction(edge)))
    return float(np.pi + np.arctan2(np.cross(n, m) @ e, n @ m))


def closest_axis(q: np.ndarray, direction: np.ndarray) -> np.ndarray:
    axes = np.concatenate([np.eye(3), -np.eye(3)])
    return axes[(axes @ matrix(q).T @ direction).argmax()]
