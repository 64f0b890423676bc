"""Hex-dominant meshes along the fields of comparisons and studies: made, told in records, written, shown."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from .._core import TetDomain
from ..errors import Cancelled, Error, InvalidInput, IoError
from ..fields.analysed import AnalysedField
from ..hexdom.hex_mesh import HexDominantResult, cell_length, compute_hex_dominant
from ..hexdom.options import MESHES, HexMeshOptions
from ..options import FieldOptions, require_one_of
from ..progress.phases import Progress
from .run_folder import MESH_FILE

if TYPE_CHECKING:
    from ..records.field import FieldRecord
    from ..records.parts import HexDominantFigures
    from ..view.picture import Picture

_BOTH = (
    "hex_volume_share", "hex_number_share", "scaled_jacobian", "inverted", "nonconforming_faces", "volume_error",
    "boundary_deviation", "cells",
)  # fmt: skip


def mesh_options(mesh: str, options: HexMeshOptions | None) -> HexMeshOptions | None:
    """Of the meshes that are asked for; None: none are. Raises InvalidInput."""
    require_one_of("mesh", mesh, MESHES)
    if mesh == MESHES[0]:
        if options is not None:
            raise InvalidInput(
                "options of cells (hex_options; --cell-edge, --cells, --correction) need meshes: mesh 'hex-dominant'"
                " (--mesh hex-dominant)",
                "ignored_options",
            )
        return None
    return options or HexMeshOptions()


def of_one_length(options: HexMeshOptions, domain: TetDomain) -> HexMeshOptions:
    """With the edge length that cells along all fields on these tets get."""
    return replace(options, edge_length=cell_length(options, domain), cells=0)


def add_mesh(
    result: AnalysedField, options: HexMeshOptions | None, folder: Path | None, progress: Progress | None = None
) -> None:
    """Makes the mesh along the field, puts its figures into the field's record and its cells into mesh.vtu. Where none
    can be made the record has the error. folder: None: no file. options: of of_one_length; None: nothing is done.
    Raises IoError, Cancelled."""
    if options is None:
        return
    from ..records.parts import HexDominantFigures

    begun = time.perf_counter()
    try:
        threads = FieldOptions(threads=result.record.threads)
        made = compute_hex_dominant(result, threads, progress, hex_options=options)
    except (Cancelled, IoError):
        raise
    except Error as error:
        seconds = time.perf_counter() - begun
        figures = HexDominantFigures(
            edge_length=options.edge_length, seconds=seconds, error=str(error), error_kind=error.kind
        )
    else:
        figures = _figures(made, time.perf_counter() - begun)
        if folder is not None:
            from ..hexdom.files import write_vtu

            write_vtu(folder / MESH_FILE, made)
    result.record = result.record.changed(mesh=figures)


def _figures(made: HexDominantResult, seconds: float) -> HexDominantFigures:
    from ..records.parts import HexDominantFigures

    record = made.record
    told = {name: record[name] for name in _BOTH}
    peak = max(record.phase_peak_mb.values())
    return HexDominantFigures(edge_length=record.edge_length.target, seconds=seconds, peak_mb=peak, **told)


def pictures(rows: Sequence[FieldRecord], folder: Path) -> Iterator[tuple[str, Picture]]:
    """By boundary treatment, the best mesh along a field that was computed. rows: of one input. folder: of the
    comparison."""
    from ..view import scene

    if not scene.can_draw():
        return
    for boundary in dict.fromkeys(row.boundary for row in rows):
        made = [row for row in rows if row.boundary == boundary and row.computed and shares(row) is not None]
        if made:
            yield (
                str(boundary),
                _picture(max(made, key=lambda row: [round(share, 3) for share in shares(row) or ()]), folder),
            )


def shares(row: FieldRecord) -> tuple[float, float] | None:
    """Of the hexahedra, by volume and number; None without a mesh."""
    mesh = row.mesh
    if mesh is None or mesh.hex_volume_share is None or mesh.hex_number_share is None:
        return None
    return mesh.hex_volume_share, mesh.hex_number_share


def _picture(row: FieldRecord, folder: Path) -> Picture:
    from ..view import scene
    from ..view.curves import TURNS, curves_of_file
    from ..view.hex_mesh import OTHERS, scene_of_folder
    from ..view.picture import Picture

    run = folder / str(row.folder)
    by_volume, by_number = shares(row) or (0.0, 0.0)
    caption = (
        "The best mesh with this boundary treatment, the half behind its middle: hexahedra coloured by their scaled"
        f" Jacobians, other cells plain. Hexahedra are {by_volume:.1%} of the volume and {by_number:.1%} of the cells."
    )
    kinds = curves_of_file(run / "singular.vtp")[0]
    legend = [(OTHERS, "tets, wedges, pyramids"), *(TURNS[kind] for kind in TURNS if kind in kinds)]
    return Picture(f"Hex-dominant mesh ({row.label})", caption, scene.render(scene_of_folder(run)), legend)
