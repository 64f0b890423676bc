"""Cells of any kind with their arrays, as files hold them; and what is done with those that are not linear, or are
there twice."""

from dataclasses import dataclass, field

import numpy as np

Blocks = list[tuple[str, np.ndarray]]  # meshio's cell type and the connectivity
_CORNERS = {"line": 2, "triangle": 3, "tetra": 4}
# Names of meshio's, and of VTK's Lagrange and Bezier cells: corners come first in all of them.
_HIGHER = {f"{kind}{count}": kind for kind, counts in {
    "line": (3, 4, 5, 6, 7, 8, 9, 10, 11), "triangle": (6, 7, 9, 10, 12, 15, 18, 21, 28, 36, 45, 55, 66),
    "tetra": (10, 16, 20, 22, 35, 56, 84, 120, 165, 220, 286),
}.items() for count in counts} | {f"VTK_{family}_{name}": kind for family in ("LAGRANGE", "BEZIER") for name, kind in (
    ("CURVE", "line"), ("TRIANGLE", "triangle"), ("TETRAHEDRON", "tetra"), ("TETRAHEDRA", "tetra"),
)}  # fmt: skip
_COUNTED = ("tetra", "triangle", "line")


@dataclass
class Block:
    """Cells of one type, by meshio's name; data: (n, vertices of one)."""

    type: str
    data: np.ndarray


@dataclass
class CellMesh:
    """points: (n, 2 or 3). cell_data: per name an array for each block. features: (n, 2) feature edges, where the file
    is one of ours. notes: what was changed in reading."""

    points: np.ndarray
    cells: list[Block]
    point_data: dict[str, np.ndarray] = field(default_factory=dict)
    cell_data: dict[str, list[np.ndarray]] = field(default_factory=dict)
    features: np.ndarray | None = None
    notes: list[str] = field(default_factory=list)


def linear(blocks: Blocks) -> tuple[Blocks, list[str]]:
    """Lines, triangles and tets of higher order by their corners alone, which a note tells."""
    result, counts = Blocks(), dict[str, int]()
    for kind, data in blocks:
        plain = _HIGHER.get(kind)
        if plain is not None and data.ndim == 2 and data.shape[1] >= _CORNERS[plain]:
            counts[plain] = counts.get(plain, 0) + len(data)
            kind, data = plain, data[:, : _CORNERS[plain]]
        result.append((kind, data))
    told = ", ".join(f"{counts[kind]} of type {kind}" for kind in _COUNTED if counts.get(kind))
    return result, [f"cells of higher order were read by their corners, with straight edges: {told}"] if told else []


def first_of_equal(cells: np.ndarray) -> np.ndarray:
    """Ascending ids of the rows that have other vertices than all rows before them, in whatever order."""
    if len(cells) < 2:
        return np.arange(len(cells))
    return np.sort(np.unique(np.sort(cells, axis=1), axis=0, return_index=True)[1])
