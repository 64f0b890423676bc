"""Tets, edges and triangles inside a mesh that join its surface to itself: counted, and split on request."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _core
from .._core import LockingElements
from ..options import MeshOptions
from .inputs import Input, with_regions

if TYPE_CHECKING:
    from .meshed_input import MeshedInput


def split_on_request(mesh: Input | MeshedInput, options: MeshOptions) -> dict[str, Any]:
    """Counts what joins the surface to itself and splits it on request: tets, regions and boundary change, surface
    vertices and features stay."""
    if mesh.tets is None or mesh.boundary is None:
        return {}
    if not options.split:
        found = _core.find_locking(mesh.tets, mesh.boundary)
        return _locking_record(found)
    split = _core.split_locking(mesh.tets, mesh.boundary)
    mesh.tets = split.mesh
    regions = None if mesh.regions is None else np.asarray(mesh.regions)[np.asarray(split.parent)]
    with_regions(mesh, regions)
    return _locking_record(split.found) | {
        "added_vertices": split.added_vertices,
        "added_tets": len(split.parent) - len(np.unique(split.parent)),
        "left": len(split.left),
    }


def split_between_singular(
    mesh: MeshedInput, frames: np.ndarray, lengths: np.ndarray | None, threads: int
) -> tuple[MeshedInput, np.ndarray, np.ndarray | None, np.ndarray, dict[str, Any]]:
    """A field in the tets on a mesh whose edges between singular vertices are split: mesh, frames, lengths, (m,) tet
    that each is part of, and counts. Vertices and features of the surface stay; its triangles come in the order of the
    new tets."""
    tets, boundary, _ = mesh.volume()
    split = _core.split_between_singular(tets, boundary, frames, threads=threads)
    parent = np.asarray(split.parent)
    finer = replace(mesh, tets=split.mesh)
    with_regions(finer, None if mesh.regions is None else np.asarray(mesh.regions)[parent])
    finer.surface = mesh.surface
    counts = {
        "edges": len(split.edges),
        "left": len(split.left),
        "added_vertices": split.added_vertices,
        "added_tets": len(parent) - len(tets.tets),
    }
    return finer, frames[parent], None if lengths is None else lengths[parent], parent, counts


def _locking_record(found: LockingElements) -> dict[str, Any]:
    return {"tets": len(found.tets), "edges": len(found.edges), "triangles": len(found.triangles)}
