"""Tets, edges and triangles inside a mesh that join its surface to itself: counted, and split on request."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._core import LockingElements, TetDomain, TetMesh
from ..options import MeshOptions
from .inputs import domain_of, regions_of

if TYPE_CHECKING:
    from ..records.parts import LockingCounts, SplitCounts
    from .meshed_input import MeshedInput


def split_on_request(domain: TetDomain, options: MeshOptions) -> tuple[TetDomain, LockingCounts]:
    """Counts what joins the surface to itself and splits it on request: the domain, where tets and regions have changed
    then, and counts. Surface vertices and features stay."""
    if not options.split:
        return domain, _counts(_core.find_locking(domain))
    split = _core.split_locking(domain)
    counts = _counts(split.found).changed(
        added_vertices=split.added_vertices,
        added_tets=len(split.parent) - len(np.unique(split.parent)),
        left=len(split.left),
    )
    return split_domain(domain, split.mesh, np.asarray(split.parent)), counts


def split_domain(domain: TetDomain, mesh: TetMesh, parent: np.ndarray) -> TetDomain:
    """The finer mesh with the regions and features of the domain. parent: (m,) old tet that each is part of. Vertices
    of the surface have kept their ids."""
    regions = regions_of(domain)
    return domain_of(mesh, None if regions is None else regions[parent]).with_features(domain.features)


def split_between_singular(
    mesh: MeshedInput, frames: np.ndarray, lengths: np.ndarray | None, threads: int
) -> tuple[MeshedInput, np.ndarray, np.ndarray | None, np.ndarray, SplitCounts]:
    """A field in the tets on a mesh whose edges between singular vertices are split: mesh, frames, lengths, (m,) tet
    that each is part of, and counts. Vertices and features of the surface stay; its triangles come in the order of the
    new tets."""
    from ..records.parts import SplitCounts

    domain = mesh.volume()
    split = _core.split_between_singular(domain, frames, threads=threads)
    parent = np.asarray(split.parent)
    finer = replace(mesh, tets=split_domain(domain, split.mesh, parent))
    counts = SplitCounts(
        edges=len(split.edges),
        left=len(split.left),
        added_vertices=split.added_vertices,
        added_tets=len(parent) - domain.tet_count,
    )
    return finer, frames[parent], None if lengths is None else lengths[parent], parent, counts


def _counts(found: LockingElements) -> LockingCounts:
    from ..records.parts import LockingCounts

    return LockingCounts(tets=len(found.tets), edges=len(found.edges), triangles=len(found.triangles))
