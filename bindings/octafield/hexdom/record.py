"""The record of a hex-dominant mesh. Imported where a record is made: pydantic takes long to import."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import HexDominantCounts, HexDominantMesh
from ..meshes.figures import Spread
from ..progress.meter import PhaseMeter
from ..progress.phases import machine, octafield_version, versions
from ..records.hex_dominant import HexDominantRecord
from ..records.parts import (
    CellCounts,
    Deviation,
    EdgeLengths,
    FieldOfMesh,
    JacobianFigures,
    LatticeSteps,
    LostLatticeCells,
    Machine,
    PyramidCounts,
    Quantiles,
)
from .quality import MeshFigures

if TYPE_CHECKING:
    from ..records.field import FieldRecord


def of_mesh(
    made: HexDominantMesh,
    figures: MeshFigures,
    field: FieldRecord,
    source: str,
    target: float,
    meter: PhaseMeter,
    options: dict[str, Any],
) -> HexDominantRecord:
    """field: that of the field's analysis. source: of the field. target: edge length."""
    return HexDominantRecord(
        input=field.input,
        version=octafield_version(),
        input_kind=field.input_kind,
        mesh_sha256=field.mesh_sha256,
        tets=field.tets,
        regions=field.regions,
        field=of_field(field, source),
        points=made.points,
        vertices=len(made.mesh.vertices),
        cells=CellCounts(**figures.cells),
        hex_volume_share=figures.hex_volume_share,
        hex_number_share=figures.hex_number_share,
        scaled_jacobian={
            kind: JacobianFigures(min=s.min, p05=s.p05, mean=s.mean) for kind, s in figures.jacobians.items()
        },
        inverted=figures.inverted,
        unproven=figures.unproven,
        nonconforming_faces=figures.nonconforming_faces,
        volume_error=figures.volume_error,
        region_volume_error=figures.region_volume_error,
        boundary_deviation=Deviation(max=figures.deviation[0], rms=figures.deviation[1]),
        edge_length=EdgeLengths(target=target, **_quantiles(figures.edges)),
        edge_to_size=None if figures.edges_to_sizes is None else Quantiles(**_quantiles(figures.edges_to_sizes)),
        steps=of_steps(made.counts),
        wall_seconds=meter.wall,
        cpu_seconds=meter.cpu,
        phase_peak_mb=meter.peak_mb,
        peak_mb=max(field.peak_mb, *meter.peak_mb.values()),
        notes=list(field.notes),
        versions=versions(),
        machine=Machine.model_validate(machine()),
        options=options,
        field_options=field.options,
    )


def of_field(field: FieldRecord, source: str) -> FieldOfMesh:
    return FieldOfMesh(
        source=source,
        representation=field.representation,
        boundary=field.boundary,
        energy=field.energy,
        singular_edges=field.singular_edges,
        complex_edges=field.complex_edges,
        non_meshable_vertices=field.non_meshable_vertices,
        edge_length=field.edge_length,
    )


def of_steps(counts: HexDominantCounts) -> LatticeSteps:
    lost, pyramids = counts.lost, counts.pyramids
    return LatticeSteps(
        tets=counts.tets,
        inconsistent=counts.inconsistent,
        turned_over=counts.turned_over,
        lost=LostLatticeCells(outside=lost.outside, unusable=lost.unusable, degenerate=lost.degenerate, poor=lost.poor),
        lattice_hexahedra=counts.lattice_hexahedra,
        crossing=counts.crossing,
        recombined_hexahedra=counts.recombined_hexahedra,
        recombined_wedges=counts.recombined_wedges,
        pyramids=PyramidCounts(combined=pyramids.combined, raised=pyramids.raised, split=pyramids.split),
    )


def _quantiles(values: Spread) -> dict[str, float]:
    return {name: value for name, value in asdict(values).items() if name in ("median", "p05", "p95")}


def recorded_sizes(sizes: object) -> str | None:
    """What a record tells of the sizes that were wanted."""
    if sizes is None or isinstance(sizes, str):
        return sizes
    if callable(sizes):
        return f"function {getattr(sizes, '__name__', type(sizes).__name__)}"
    return str(sizes) if hasattr(sizes, "__fspath__") else f"array {np.asarray(sizes).shape}"
