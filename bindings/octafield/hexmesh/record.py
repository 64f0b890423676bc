"""The record of an all-hex mesh. Imported where a record is made: pydantic takes long to import."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import _core
from .._core import AllHexMesh, MixedMesh, SeamlessMap, SurfaceDomain, TetDomain
from ..domain.meshed_input import MeshedInput
from ..hexdom.quality import MeshFigures
from ..progress.meter import PhaseMeter
from ..progress.phases import machine, octafield_version, versions
from ..quad_mesh.features import feature_deviation
from ..records.hex_mesh import HexMeshRecord
from ..records.parts import Deviation, EdgeLengths, FeatureDeviation, JacobianFigures, Machine, WholeNumberFigures

_SIDES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))


def of_mesh(
    made: AllHexMesh,
    figures: MeshFigures,
    domain: TetDomain,
    given: SeamlessMap,
    walls: str,
    name: str,
    meter: PhaseMeter,
    options: dict[str, Any],
) -> HexMeshRecord:
    boundary = _core.cell_boundary(made.mesh)
    features = domain.features
    corners, curves = feature_deviation(boundary.mesh, SurfaceDomain(domain.surface.mesh, features))
    quality, edges = figures.jacobians["hexahedra"], figures.edges
    hexahedra = figures.cells["hexahedra"]
    wanted_edge = options["edge_length"] or float(
        np.cbrt(np.asarray(_core.tet_volumes(domain)).sum() / max(made.wanted, 1))
    )
    return HexMeshRecord(
        input=name,
        version=octafield_version(),
        input_kind="seamless map",
        mesh_sha256=MeshedInput(name, "tets", domain.surface.mesh, features, "none", domain).digest(),
        tets=len(given.mesh.tets),
        stage="extracted",
        walls=walls,
        blocks=made.block_count,
        arcs=len(made.numbers.numbers),
        whole_numbers=WholeNumberFigures(
            objective=made.numbers.deviation,
            bound=made.numbers.bound,
            optimal=made.numbers.deviation <= made.numbers.bound + 1e-6,
        ),
        target=made.wanted,
        hexahedra=hexahedra,
        vertices=len(made.mesh.vertices),
        irregular_edges=irregular_edges(made.mesh),
        scaled_jacobian=JacobianFigures(min=quality.min, p05=quality.p05, mean=quality.mean),
        inverted_at_first=made.inverted,
        inverted=figures.inverted,
        unproven=figures.unproven,
        nonconforming_faces=figures.nonconforming_faces,
        volume_error=figures.volume_error,
        boundary_deviation=Deviation(max=figures.deviation[0], rms=figures.deviation[1]),
        feature_deviation=FeatureDeviation(corners=corners, curves=curves),
        edge_length=EdgeLengths(target=wanted_edge, median=edges.median, p05=edges.p05, p95=edges.p95),
        seconds=sum(meter.wall.values()),
        wall_seconds=meter.wall,
        cpu_seconds=meter.cpu,
        phase_peak_mb=meter.peak_mb,
        peak_mb=max(meter.peak_mb.values()),
        notes=list(made.notes),
        versions=versions(),
        machine=Machine.model_validate(machine()),
        options=options,
    )


def irregular_edges(mesh: MixedMesh) -> dict[str, int]:
    """Inside, by the number of hexahedra round them, other than 4."""
    cells = np.asarray(mesh.hexahedra)
    edges = np.sort(np.concatenate([cells[:, list(side)] for side in _SIDES]), axis=1)
    every, around = np.unique(edges, axis=0, return_counts=True)
    boundary = _core.cell_boundary(mesh)
    quads = np.asarray(boundary.vertex_map)[np.asarray(boundary.mesh.quads)]
    outside = np.sort(np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)]), axis=1)
    both = np.concatenate([every, np.unique(outside, axis=0)])
    _, first, count = np.unique(both, axis=0, return_index=True, return_counts=True)
    inside = first[count == 1]
    found, counts = np.unique(around[inside], return_counts=True)
    return {str(valence): int(n) for valence, n in zip(found, counts, strict=True) if valence != 4}
