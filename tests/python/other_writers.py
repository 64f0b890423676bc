"""Writers of files with frames and tets that share nothing with octafield: from the layouts of docs/formats.md alone,
one number at a time.

frames: axes, (n, 3, 3) in columns, or quaternions w x y z. Liberties that the layouts leave are taken otherwise than
    octafield takes them.
"""

import struct
from pathlib import Path

import numpy as np


def geogram_centres(path: Path, centres: np.ndarray, axes: np.ndarray) -> None:
    """In any order, with axes of any length."""
    order = np.random.default_rng(0).permutation(len(axes))
    rows = [[*centres[i], *(2 * axes[i][:, 0]), *axes[i][:, 1], *(0.5 * axes[i][:, 2])] for i in order]
    path.write_text("\n".join(" ".join(map(repr, map(float, row))) for row in rows) + "\n")


def fra(path: Path, axes: np.ndarray) -> None:
    lines = ["FRA 1", f"{len(axes)} 3 4"]
    lines += [" ".join(repr(float(x)) for x in frame[:, k]) for frame in axes for k in range(3)]
    path.write_text("\n".join(lines) + "\n")


def bfra(path: Path, axes: np.ndarray) -> None:
    numbers = [float(frame[c % 3, c // 3]) for c in range(9) for frame in axes]
    path.write_bytes(b"FRA 2\0" + struct.pack("<3i", len(axes), 9, 3) + struct.pack(f"<{len(numbers)}d", *numbers))


class Cells:
    """Edges, faces and half-faces of tets, numbered in the order in which they are met."""

    def __init__(self, tets: np.ndarray):
        self.edges: dict[tuple[int, int], int] = {}
        self.faces: dict[frozenset[int], tuple[int, tuple[int, ...]]] = {}
        self.loops: list[list[int]] = []
        self.cells = [[self._half_face(side) for side in self._sides(*map(int, tet))] for tet in tets]

    @staticmethod
    def _sides(a: int, b: int, c: int, d: int) -> list[tuple[int, int, int]]:
        """With normals into a positive tet."""
        return [(a, b, c), (a, c, d), (a, d, b), (b, d, c)]

    def _half_edge(self, a: int, b: int) -> int:
        if (b, a) in self.edges:
            return 2 * self.edges[b, a] + 1
        return 2 * self.edges.setdefault((a, b), len(self.edges))

    def _half_face(self, side: tuple[int, int, int]) -> int:
        key = frozenset(side)
        if key not in self.faces:
            self.faces[key] = len(self.faces), side
            self.loops.append([self._half_edge(side[k], side[(k + 1) % 3]) for k in range(3)])
            return 2 * self.faces[key][0]
        number, first = self.faces[key]
        turned = [side[k:] + side[:k] for k in range(3)]
        return 2 * number + (first not in turned)


def tetgen(path: Path, points: np.ndarray, tets: np.ndarray, regions: np.ndarray) -> None:
    """Ids from 1, comments, an attribute of the tets."""
    lines = [
        "# of the test",
        f"{len(points)} 3 0 0",
        *(f"{i} " + " ".join(map(repr, map(float, p))) for i, p in enumerate(points, 1)),
    ]
    path.write_text("\n".join(lines) + "\n")
    lines = [
        f"{len(tets)} 4 1",
        *(
            f"{i} " + " ".join(str(k + 1) for k in tet) + f" {r}"
            for i, (tet, r) in enumerate(zip(tets, regions, strict=True), 1)
        ),
    ]
    path.with_suffix(".ele").write_text("\n".join(lines) + "\n# end\n")


def ovm_mesh(path: Path, points: np.ndarray, tets: np.ndarray, regions: np.ndarray) -> None:
    path.write_text("\n".join([*_ovm(points, tets), 'CProp int "region"', *map(str, regions)]) + "\n")


def ovm(path: Path, points: np.ndarray, tets: np.ndarray, entity: str, quaternions: np.ndarray) -> None:
    values = (" ".join(repr(float(x)) for x in q) for q in quaternions)
    path.write_text("\n".join([*_ovm(points, tets), f'{entity} vec4d "quaternion"', *values]) + "\n")


def _ovm(points: np.ndarray, tets: np.ndarray) -> list[str]:
    cells = Cells(tets)
    text = ["OVM ASCII", "Vertices", str(len(points)), *(" ".join(repr(float(x)) for x in p) for p in points)]
    text += ["Edges", str(len(cells.edges)), *(f"{a} {b}" for a, b in cells.edges)]
    text += ["Faces", str(len(cells.loops)), *("3 " + " ".join(map(str, loop)) for loop in cells.loops)]
    return [*text, "Polyhedra", str(len(cells.cells)), *("4 " + " ".join(map(str, cell)) for cell in cells.cells)]


def ovmb(path: Path, points: np.ndarray, tets: np.ndarray, entity: int, name: str, quaternions: np.ndarray) -> None:
    """Of Quaternion: x y z w. entity: 0 vertices, 3 cells."""
    values = [struct.pack("<4d", *map(float, q[[1, 2, 3, 0]])) for q in quaternions]
    path.write_bytes(_ovmb(points, tets, entity, name.encode(), b"Quaternion", bytes(32), values))


def ovmb_mesh(path: Path, points: np.ndarray, tets: np.ndarray, regions: np.ndarray) -> None:
    path.write_bytes(_ovmb(points, tets, 3, b"region", b"i32", bytes(4), [struct.pack("<i", r) for r in regions]))


def _ovmb(
    points: np.ndarray, tets: np.ndarray, entity: int, name: bytes, kind: bytes, default: bytes, values: list[bytes]
) -> bytes:
    """General topology with a valence per element and ids of 32 bits; a property in two chunks."""
    cells = Cells(tets)

    def chunk(kind: bytes, body: bytes) -> bytes:
        padding = -len(body) % 8
        return struct.pack("<4sBBBBQ", kind, 0, padding, 0, 1, len(body) + padding) + body + bytes(padding)

    def string(text: bytes) -> bytes:
        return struct.pack("<I", len(text)) + text

    def topology(code: int, rows: list[list[int]]) -> bytes:
        width, ids = len(rows[0]), [i for row in rows for i in row]
        head = struct.pack("<QIBBBBQ", 0, len(rows), code, 0, 1, 4, 0)
        return chunk(b"TOPO", head + bytes([width] * len(rows)) + struct.pack(f"<{len(ids)}I", *ids))

    counts = len(points), len(cells.edges), len(cells.loops), len(cells.cells)
    data = b"OVMB\n\r\n\xff" + bytes([1, 1, 3, 0, 0, 0, 0, 0]) + struct.pack("<4Q", *counts)
    data += chunk(b"DIRP", bytes([entity]) + string(name) + string(kind) + string(default))
    flat = [float(x) for p in points for x in p]
    data += chunk(b"VERT", struct.pack("<QIBBBB", 0, len(points), 2, 0, 0, 0) + struct.pack(f"<{len(flat)}d", *flat))
    data += topology(1, [list(edge) for edge in cells.edges]) + topology(2, cells.loops) + topology(3, cells.cells)
    half = len(values) // 2
    for first, part in ((0, values[:half]), (half, values[half:])):
        data += chunk(b"PROP", struct.pack("<QII", first, len(part), 0) + b"".join(part))
    return data + chunk(b"EOF ", b"")
