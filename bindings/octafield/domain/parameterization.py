"""All that a seamless map asks of a frame field in the tets, in one object; write_frames(..., combed=True) writes
it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from .._core import AlignmentTables, CombedField, SingularEdges, TetDomain, TetMesh
from ..errors import InvalidInput
from ..meshes.topology import first_tets_at
from ..options import MeshOptions
from .inputs import domain_of, from_mesh, to_surface_ids
from .meshed_input import MeshedInput
from .meshing import Source, prepare_mesh
from .sites import SITES, fitting_frames

__all__ = ["ParameterizationInput", "parameterization_input"]

_TABLES = (
    "triangle_tet", "triangle_axis", "triangle_angle", "triangle_patch", "patch_one_axis",
    "feature_edges", "feature_tet", "feature_axis", "feature_angle",
)  # fmt: skip


@dataclass(repr=False)
class ParameterizationInput:
    """combed: frames of the tets whose axes correspond by number and sign across all triangles but the cut, with their
    matchings.
    singular: the edges inside with a turn, as octafield.volume.singular_edges has them of the frames before combing.
        surface: with interfaces between regions; features: its. tables: axes held at both."""

    tets: TetDomain
    combed: CombedField
    singular: SingularEdges
    tables: AlignmentTables

    def __repr__(self) -> str:
        cut, edges = int(np.asarray(self.combed.cut).sum()), len(self.singular.edges)
        return (
            f"ParameterizationInput({len(self.tets.tets):,} tets, {cut:,} cut triangles, {edges:,} singular edges,"
            f" {len(self.tables.patch_one_axis):,} patches)"
        )

    def arrays(self) -> dict[str, np.ndarray]:
        """By name, as .npz files hold them beside frames, vertices and tets; docs/formats.md describes each."""
        faces, edges = self.combed.faces, self.singular.edges
        ends = np.array([(e.a, e.b) for e in edges], np.int32).reshape(-1, 2)
        parts = {
            "element": self.combed.element,
            "triangles": faces.triangles,
            "triangle_tets": faces.tets,
            "matching": faces.matching,
            "cut": self.combed.cut,
            "singular_edges": ends,
            "singular_holonomy": self._holonomies(ends),
            "singular_quarter_turns": np.array([e.quarter_turns for e in edges], np.int32),
            "surface_triangles": np.asarray(self.tets.surface.vertex_map)[np.asarray(self.tets.surface.mesh.triangles)],
        }
        return {k: np.asarray(v) for k, v in parts.items()} | {
            f"alignment_{k}": np.asarray(getattr(self.tables, k)) for k in _TABLES
        }

    def _holonomies(self, ends: np.ndarray) -> np.ndarray:
        """Of the combed frame q g of the lowest tet at each edge: g^-1 h g."""
        h = np.array([e.holonomy for e in self.singular.edges], np.int32)
        g = np.asarray(self.combed.element)[first_tets_at(np.asarray(self.tets.tets), ends)]
        product, inverse = np.asarray(_core.octahedral_product_table()), np.asarray(_core.octahedral_inverse_table())
        conjugates: np.ndarray = product[product[inverse[g], h], g]
        return conjugates


def parameterization_input(
    mesh: Source | MeshedInput, frames: ArrayLike, where: str = "vertices", options: MeshOptions = MeshOptions()
) -> ParameterizationInput:
    """Combs (n, 4) frames at the vertices or in the tets of a tet mesh (or its file; features as octafield field finds
    them) and collects cut, matchings, singular edges and what the boundary holds. Frames at vertices are taken to the
    tets by tet_frames. Raises InvalidInput where the frames do not fit the mesh, GeometryError (unsound mesh)."""
    if where not in SITES:
        raise InvalidInput(f"where must be one of: {', '.join(SITES)}; not {where!r}", "unknown_option_value")
    meshed = mesh if isinstance(mesh, MeshedInput) else prepare_mesh(mesh, options)
    if meshed.kind != "tets" and not isinstance(mesh, MeshedInput):
        raise InvalidInput(f"{meshed.name}: is a surface; frames need the tet mesh they belong to", "not_tets")
    tets = meshed.volume()
    of_tets = fitting_frames(tets, frames, where)
    if where == "vertices":
        of_tets = np.asarray(_core.tet_frames(tets, of_tets))
    combed = _core.comb(tets, of_tets)
    tables = _core.alignment_tables(tets, combed)
    return ParameterizationInput(tets, combed, _core.singular_edges(tets, of_tets), tables)


def with_parts(mesh: TetMesh, features: np.ndarray | None, regions: np.ndarray | None) -> MeshedInput:
    """The mesh as its file would be read. features: (k, 2) vertex ids of the tet mesh; None: found by angle."""
    found = from_mesh(domain_of(mesh, regions))
    if features is not None:
        found.lines, found.creases = to_surface_ids(found.volume())[features].astype(np.int32), True
        if (found.lines < 0).any():
            raise InvalidInput("features name vertices that are not on the surface", "bad_features")
    return prepare_mesh(found)
