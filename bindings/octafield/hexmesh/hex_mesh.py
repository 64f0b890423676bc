"""From a seamless map to a mesh of hexahedra alone, with its figures.

result = compute_hex_mesh("map.hexex", cells=2000)
result.mesh                       # octafield.volume.MixedMesh
result.record.scaled_jacobian     # the figures
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _core
from .._core import MixedMesh, SeamlessMap
from ..domain.inputs import naming
from ..domain.meshing import require_scale
from ..errors import InvalidInput
from ..hexdom.hex_mesh import require_sound
from ..options import LARGEST_INT, integer_in, require_one_of
from ..progress.meter import PhaseMeter
from ..progress.phases import Progress, announce
from ..view.notebook import Facts, ShownInNotebooks
from .hexex import is_seamless_map, read_seamless_map
from .options import WALLS

if TYPE_CHECKING:
    import pyvista

    from ..records.hex_mesh import HexMeshRecord


_SHOWN = ("hexahedra", "target", "irregular_edges", "scaled_jacobian", "volume_error", "feature_deviation")
_COARSE = 0.01  # difference of the volume that is worth a note


@dataclass(repr=False, kw_only=True)
class HexMeshResult(ShownInNotebooks):
    """Hexahedra and what led to them.

    mesh: the hexahedra. blocks: (h,) int32, the block of each. support: (n,) uint8 per vertex, 0 inside, 1 on the
    surface, 2 on a feature curve, 3 a corner. scaled_jacobians: (h,). map: that they come from, with the walls of the
    blocks. record: all figures, the JSON object of the command line."""

    mesh: MixedMesh
    blocks: np.ndarray
    support: np.ndarray
    scaled_jacobians: np.ndarray
    map: SeamlessMap
    record: HexMeshRecord

    def __repr__(self) -> str:
        r = self.record
        return (
            f"HexMeshResult({r.input}: {r.hexahedra:,} hexahedra in {r.blocks:,} blocks; least scaled Jacobian"
            f" {r.scaled_jacobian.min:.3f})"
        )

    def _facts(self) -> Facts:
        return str(self.record.input), {name: self.record.to_dict()[name] for name in _SHOWN}

    def scene(self) -> pyvista.Plotter:
        """A pyvista scene: the mesh cut open, hexahedra coloured by their scaled Jacobians."""
        from ..view.window import shown_where_possible

        return shown_where_possible(self._drawn())

    def _drawn(self) -> pyvista.Plotter:
        from ..view.hex_mesh import hex_scene

        return hex_scene(self.mesh, self.scaled_jacobians, None)


def compute_hex_mesh(
    source: str | Path | SeamlessMap,
    progress: Progress | None = None,
    *,
    cells: int = 0,
    edge_length: float = 0.0,
    walls: str = "file",
    threads: int = 0,
) -> HexMeshResult:
    """A mesh of hexahedra alone from a seamless map (octafield.volume.SeamlessMap, or its .hexex file): walls that cut
    it into blocks, whole numbers of edges for the arcs of these, a grid in each block, vertices moved on the surface
    and along features.

    cells: number of hexahedra wanted. edge_length: in its place, input unit; 0: the mean edge of the boundary.
    walls: "file": the map's, or where it has none, own ones (octafield.volume.motorcycle_complex); "own": these always.

    progress(phase, fraction, merit): False cancels. Raises IoError; InvalidInput; GeometryError whose kind says what
    stops the map: flipped_tet, torn_map, unaligned_boundary, winding_edge, bent_wall, not_a_box; SolverError;
    Cancelled.

        >>> import numpy as np, octafield
        >>> from octafield.domain.generators import generate
        >>> tets = octafield.prepare_mesh(generate("box")).volume()
        >>> parameters = np.asarray(tets.vertices)[np.asarray(tets.tets)].reshape(-1, 12)
        >>> mesh = octafield.TetMesh(tets.vertices, tets.tets)
        >>> given = octafield.volume.SeamlessMap(mesh, parameters)
        >>> octafield.compute_hex_mesh(given, cells=64).record.hexahedra
        64
    """
    integer_in("cells", cells, 0, LARGEST_INT, " (0: by the edge length)")
    require_one_of("walls", walls, WALLS)
    meter = PhaseMeter(None, progress)
    meter.begin("read")
    announce(progress, "read")
    given, name = _map_of(source)
    with naming(name):
        require_scale(np.asarray(given.mesh.vertices))
        require_scale(np.asarray(given.parameters), "parameters")
        options = {"cells": cells, "edge_length": edge_length, "walls": walls, "threads": threads}
        return _made(given, name, meter, progress, options)


def _map_of(source: object) -> tuple[SeamlessMap, str]:
    if isinstance(source, SeamlessMap):
        return source, "map"
    if is_seamless_map(source):
        return read_seamless_map(source), str(source)  # type: ignore[arg-type]
    raise InvalidInput(
        f"{source}: hex meshes are made from seamless maps (.hexex); octafield.compute_seamless_map and octafield"
        " hex-mesh make these of tet meshes and surfaces",
        "not_a_map",
    )


def _made(
    given: SeamlessMap, name: str, meter: PhaseMeter, progress: Progress | None, options: dict[str, Any]
) -> HexMeshResult:
    from ..hexdom.quality import figures_of
    from . import record

    own = options["walls"] == "own" or not len(given.walls)
    walled = _core.motorcycle_complex(given, progress=meter.report) if own else given
    of_all_hex = {name: value for name, value in options.items() if name != "walls"}
    made = _core.all_hex(walled, progress=meter.report, **of_all_hex)
    meter.begin("check")
    announce(progress, "check")
    require_sound(made.mesh)
    domain = _core.map_domain(given)
    figures = figures_of(made.mesh, None, domain, None, options["threads"])
    meter.end()
    told = record.of_mesh(made, figures, domain, given, "own" if own else "file", name, meter, options)
    if told.volume_error > _COARSE:
        note = (
            f"the mesh has another volume than the input, by {told.volume_error:.1%}: the hexahedra are large for how"
            " the surface bends; ask for more"
        )
        told = told.changed(notes=[*told.notes, note])
    return HexMeshResult(
        mesh=made.mesh,
        blocks=np.asarray(made.blocks),
        support=np.asarray(made.support),
        scaled_jacobians=figures.scaled_jacobians,
        map=walled,
        record=told,
    )
