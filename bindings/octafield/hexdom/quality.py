"""What a hex-dominant mesh is worth, found on its arrays and those of the input."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import _core
from .._core import MixedMesh, TetDomain
from ..meshes.figures import Spread, spread, surface_deviation
from .faces import KINDS, blocks, edges_of, nonconforming_faces, outline
from .sizes import SizeAt


@dataclass
class MeshFigures:
    """scaled_jacobians, volumes: (cells,). deviation: largest and root mean square distance between the boundary and
    interfaces of the mesh and those of the input, both ways. region_volume_error: the largest of a region. edges:
    lengths, input unit; edges_to_sizes: over what is wanted at their middles."""

    cells: dict[str, int]
    scaled_jacobians: np.ndarray
    jacobians: dict[str, Spread]
    hex_volume_share: float
    hex_number_share: float
    inverted: int
    unproven: int
    nonconforming_faces: int
    volume_error: float
    region_volume_error: float | None
    deviation: tuple[float, float]
    edges: Spread
    edges_to_sizes: Spread | None


def figures_of(
    mesh: MixedMesh, regions: np.ndarray | None, domain: TetDomain, size_at: SizeAt | None = None, threads: int = 0
) -> MeshFigures:
    jacobians, volumes = np.asarray(_core.scaled_jacobians(mesh)), np.asarray(_core.cell_volumes(mesh))
    cells = {kind: len(rows) for kind, rows in blocks(mesh).items()}
    of_kind = np.repeat(np.arange(len(KINDS)), [cells[kind] for kind in KINDS])
    hexahedra = of_kind == KINDS.index("hexahedra")
    points, edges = np.asarray(mesh.vertices), edges_of(mesh)
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    wanted = None if size_at is None else size_at(points[edges].mean(axis=1))
    error, of_regions = volume_errors(volumes, regions, domain)
    return MeshFigures(
        cells=cells,
        scaled_jacobians=jacobians,
        jacobians={kind: spread(jacobians[of_kind == k]) for k, kind in enumerate(KINDS) if cells[kind]},
        hex_volume_share=float(volumes[hexahedra].sum() / volumes.sum()),
        hex_number_share=float(hexahedra.mean()),
        inverted=int((jacobians <= 0).sum()),
        unproven=int((np.asarray(_core.proven_positive(mesh, threads=threads)) == 0).sum()),
        nonconforming_faces=nonconforming_faces(mesh),
        volume_error=error,
        region_volume_error=of_regions,
        deviation=boundary_deviation(mesh, regions, domain),
        edges=spread(lengths),
        edges_to_sizes=None if wanted is None else spread(lengths / wanted),
    )


def volume_errors(volumes: np.ndarray, regions: np.ndarray | None, domain: TetDomain) -> tuple[float, float | None]:
    """Relative to the input's volume: of the whole, and the largest of a region relative to that region's."""
    given = np.asarray(_core.tet_volumes(domain))
    whole = float(abs(volumes.sum() - given.sum()) / given.sum())
    if regions is None:
        return whole, None
    of_tets = np.asarray(domain.regions)
    return whole, max(
        float(abs(volumes[regions == region].sum() - given[of_tets == region].sum()) / given[of_tets == region].sum())
        for region in np.unique(of_tets)
    )


def boundary_deviation(mesh: MixedMesh, regions: np.ndarray | None, domain: TetDomain) -> tuple[float, float]:
    """surface_deviation of the boundary and interfaces of the mesh from those of the input."""
    return surface_deviation(np.asarray(mesh.vertices), *outline(mesh, regions), domain.surface.mesh)
