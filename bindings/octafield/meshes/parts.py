"""What a mesh file is written from, as arrays."""

from dataclasses import dataclass

import numpy as np


@dataclass
class Parts:
    """What is written. points: (n, 3), double. lines: (k, 2) feature edges or None. triangles: (t, 3), of the surface
    and interfaces, or None; faces: (t,) CAD face of each, 0: none, or None. tets: (m, 4) or None; regions: (m,) or
    None. Ids are 0-based rows of points."""

    points: np.ndarray
    lines: np.ndarray | None = None
    triangles: np.ndarray | None = None
    faces: np.ndarray | None = None
    tets: np.ndarray | None = None
    regions: np.ndarray | None = None

    def blocks(self) -> list[tuple[str, np.ndarray, np.ndarray]]:
        """meshio's cell type, connectivity and entity ids (0: none), in the order that ARFF's reader of Medit files
        wants."""
        parts = []
        if self.triangles is not None:
            parts.append(
                ("triangle", self.triangles, np.zeros(len(self.triangles)) if self.faces is None else self.faces)
            )
        if self.lines is not None and len(self.lines):
            parts.append(("line", self.lines, np.ones(len(self.lines))))
        if self.tets is not None:
            parts.append(("tetra", self.tets, np.ones(len(self.tets)) if self.regions is None else self.regions))
        return [
            (kind, np.asarray(cells).astype(np.int64), np.asarray(ids).astype(np.int64)) for kind, cells, ids in parts
        ]
