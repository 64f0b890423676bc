"""What a hex-dominant mesh is worth, found on its arrays and those of the input."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import _core
from .._core import MixedMesh, TetDomain, TriangleMesh
from .faces import KINDS, blocks, edges_of, nonconforming_faces, outline
from .sizes import SizeAt

# Points of a triangle, and weights for the mean of a polynomial of degree 3: corners, midpoints of sides, centre.
_PLACES = np.array([*np.eye(3), (0.5, 0.5, 0), (0, 0.5, 0.5), (0.5, 0, 0.5), (1 / 3, 1 / 3, 1 / 3)])
_WEIGHTS = np.array([3, 3, 3, 8, 8, 8, 27]) / 60


@dataclass
class Spread:
    """Of numbers: the smallest, what 5 %, half and 95 % of them stay below, and their mean."""

    min: float
    p05: float
    median: float
    p95: float
    mean: float


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


def spread(values: np.ndarray) -> Spread:
    low, median, high = np.percentile(values, [5, 50, 95])
    return Spread(float(values.min()), float(low), float(median), float(high), float(values.mean()))


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
    """Largest and root mean square, relative to the diagonal of the bounding box. Of each surface's points (seven per
    triangle) to the other surface; both ways. A quadrilateral that is not flat counts as four triangles about its
    centre, which is where its bilinear surface passes: the two ways of cutting it along a diagonal are as far from that
    as from each other."""
    made = _about_centres(np.asarray(mesh.vertices), *outline(mesh, regions))
    given = domain.surface.mesh
    there, back = _distances(made, given), _distances(given, made)
    points = np.asarray(given.vertices)
    diagonal = float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))
    return max(there[0], back[0]) / diagonal, max(there[1], back[1]) / diagonal


def _about_centres(points: np.ndarray, triangles: np.ndarray, quads: np.ndarray) -> TriangleMesh:
    middle = len(points) + np.arange(len(quads))
    parts = [np.column_stack([quads[:, k], quads[:, (k + 1) % 4], middle]) for k in range(4)]
    vertices = np.concatenate([points, points[quads].mean(axis=1)])
    return TriangleMesh(vertices, np.concatenate([triangles, *parts]))


def _distances(of: TriangleMesh, to: TriangleMesh) -> tuple[float, float]:
    """From points of one surface to the other: largest, root mean square by area."""
    import pyvista

    corners = np.asarray(of.vertices)[np.asarray(of.triangles)]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    samples = np.einsum("pc,tcx->tpx", _PLACES, corners)
    surface = pyvista.PolyData.from_regular_faces(np.array(to.vertices), np.array(to.triangles, int))
    found = pyvista.PolyData(samples.reshape(-1, 3)).compute_implicit_distance(surface)
    distances = np.abs(np.asarray(found["implicit_distance"])).reshape(-1, len(_PLACES))
    mean_square = float((area * (distances**2 @ _WEIGHTS)).sum() / area.sum())
    return float(distances.max()), mean_square**0.5
