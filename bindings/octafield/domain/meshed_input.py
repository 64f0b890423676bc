"""What every field is computed on: a sound mesh with its features and regions."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from .._core import FeatureGraph, TetDomain, TriangleMesh
from ..errors import InvalidInput
from ..options import MeshOptions
from ..progress.phases import PhaseClock
from .inputs import OnTets

if TYPE_CHECKING:
    from ..records.parts import LockingCounts


@dataclass(repr=False)
class MeshedInput(OnTets):
    """A sound input, ready for fields: `surface` is that of `tets` (None where only a surface was wanted).

    Where a tet mesh has several regions, or its boundary touches itself, `surface` is cut into sheets: manifold, each
    vertex a copy of vertex `sheet_map` of tets.surface. features are those of `surface`, tets.features those of
    tets.surface. locking: counts of what split_locking is for. options: what it was prepared with. inner_length: of
    edges far inside where those of the surface are graded, input unit; else 0.
    """

    name: str
    kind: str  # "surface" or "tets": what the input was
    surface: TriangleMesh
    features: FeatureGraph
    feature_source: str  # "file", "angle" or "none"
    tets: TetDomain | None = None
    notes: list[str] = field(default_factory=list)
    clock: PhaseClock = field(default_factory=PhaseClock)
    peak_mb: float = 0.0
    sheet_map: np.ndarray | None = None
    locking: LockingCounts | None = None
    options: MeshOptions | None = None
    inner_length: float = 0.0

    def __repr__(self) -> str:
        tets = "" if self.tets is None else f", {len(self.tets.tets):,} tets"
        regions = f", {self.interface_triangles:,} interface triangles" if self.interface_triangles else ""
        return (
            f"MeshedInput({self.name}: {len(self.surface.triangles):,} triangles{tets}{regions}; "
            f"{len(self.features.edges):,} feature edges by {self.feature_source})"
        )

    def volume(self) -> TetDomain:
        """The tets and what goes with them. Raises InvalidInput where only a surface was prepared."""
        if self.tets is None:
            raise InvalidInput(f"{self.name}: was prepared with volume=False; prepare it with its volume", "no_volume")
        return self.tets

    def digest(self) -> str:
        """SHA-256 of the mesh arrays, first 16 hexadecimal digits: equal for equal meshes."""
        vertices, cells = (
            (self.surface.vertices, self.surface.triangles)
            if self.tets is None
            else (self.tets.vertices, self.tets.tets)
        )
        sha = hashlib.sha256(np.ascontiguousarray(vertices).tobytes())
        sha.update(np.ascontiguousarray(cells).tobytes())
        return sha.hexdigest()[:16]
