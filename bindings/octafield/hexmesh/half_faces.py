"""Maps as HexHex (2025) reads them: OpenVolumeMesh, parameters as a property of half-faces."""

from pathlib import Path

import numpy as np

from .._core import SeamlessMap
from ..meshes.openvolumemesh.mesh import OvmMesh, ovm_of_tets
from ..meshes.openvolumemesh.text import write_ovm

PROPERTY = "halfface", "HexHex::Parametrization"


def write_half_faces(path: Path, given: SeamlessMap, *, binary: bool) -> None:
    """Walls, features and corners are left out: the layout has none. Raises IoError."""
    mesh = ovm_of_tets(np.asarray(given.mesh.vertices), np.asarray(given.mesh.tets))
    mesh.properties[PROPERTY] = _values(mesh, np.asarray(given.mesh.tets), np.asarray(given.parameters))
    write_ovm(path, mesh, binary=binary)


def _values(mesh: OvmMesh, tets: np.ndarray, parameters: np.ndarray) -> np.ndarray:
    """(2 f, 3): of each half-face, parameters of the vertex opposite to it in its tet; 0 outside."""
    of_cell = mesh.triangles()[mesh.cells // 2]
    on_face = (tets[:, None, :, None] == of_cell[:, :, None, :]).any(axis=3)
    opposite = (~on_face).argmax(axis=2)
    values = np.zeros((mesh.count("halfface"), 3))
    values[mesh.cells] = parameters.reshape(-1, 4, 3)[np.arange(len(tets))[:, None], opposite]
    return values
