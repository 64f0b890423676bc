"""What a caller asks of singular points and corners, and the surface these are for."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..._core import DirectionField, SingularPattern, SurfaceDomain, TetDomain, TetMesh, TriangleMesh
from ...domain.inputs import Input, from_mesh, read_input
from ...domain.meshed_input import MeshedInput
from ...domain.meshing import Source, prepare_mesh, read_sound
from ...errors import InvalidInput
from ...options import MeshOptions, SurfaceFieldOptions
from ...progress.phases import PeakMemory, Progress, announce

Points = str | Path | SingularPattern | Mapping[str, Any] | Sequence[Mapping[str, Any]] | ArrayLike
Corners = str | Path | Mapping[str, Any] | Sequence[Mapping[str, Any]] | ArrayLike


@dataclass
class Places:
    """Positions of the vertices that users number, before repair and remeshing. ids: of the file, ascending; None: 0 to
    the number of positions. found: that they are of, where it was read."""

    positions: np.ndarray
    ids: np.ndarray | None
    found: Input | None = None

    def of(self, vertex: int, name: str) -> np.ndarray:
        place = vertex
        if self.ids is not None:
            place = int(np.searchsorted(self.ids, vertex))
            if place < len(self.ids) and self.ids[place] != vertex:
                place = -1
        if not 0 <= place < len(self.positions):
            raise InvalidInput(
                f"{name}: the input has no vertex {vertex} at a triangle; it has {len(self.positions)}, from 0; correct"
                " the number",
                "outside_surface",
                [vertex],
            )
        position: np.ndarray = self.positions[place]
        return position


def _places_of(found: Input) -> Places:
    if found.tets is None:
        return Places(np.array(found.surface.vertices), found.surface_points, found)
    return Places(np.array(found.tets.vertices), found.file_points, found)


@dataclass(frozen=True)
class PointsWanted:
    """places: of the vertices that singularities and corners number. singularities: a SingularPattern on the surface,
    what point_rows takes, or None: those of a field that is computed with the options. corners: what corner_rows takes,
    in place of those that follow from angles or the computed field. fitted: corners of a computed field get a quad at
    least, and what corners change the sum of indices by is made good inside."""

    places: Places
    singularities: Points | None
    corners: Corners | None
    options: SurfaceFieldOptions
    fitted: bool = False
    field: Callable[[SurfaceDomain], DirectionField] | None = None  # in place of one that is computed
    field_name: str = "given"


def require_own_surface(source: object, singularities: Points | None) -> None:
    if isinstance(singularities, SingularPattern) and not isinstance(source, (MeshedInput, SurfaceDomain)):
        raise InvalidInput(
            "a SingularPattern belongs to the surface the field is on; give that SurfaceDomain, or the result of"
            " prepare_mesh(source, options, volume=False), or positions instead",
            "not_meshed",
        )


def meshed_with_places(
    source: Source | SurfaceDomain | MeshedInput, options: MeshOptions, progress: Progress | None
) -> tuple[MeshedInput, Places, TriangleMesh]:
    """The surface for the field, the vertices that users number, and the surface that quads are compared with."""
    if isinstance(source, SurfaceDomain):
        source = MeshedInput("mesh in memory", "surface", source.mesh, source.features, "file", options=options)
    if isinstance(source, MeshedInput):
        return source, Places(np.array(source.surface.vertices), None), source.surface
    before, memory = time.perf_counter(), PeakMemory()
    announce(progress, "read")
    found = _read(source, options, progress)
    places, seconds, peak = _places_of(found), time.perf_counter() - before, memory.megabytes()
    sound = read_sound(found, options, volume=False, fills=True, progress=progress)
    sound.clock.wall["read"] += seconds
    meshed = prepare_mesh(sound, options, volume=False, progress=progress)
    meshed.peak_mb = max(meshed.peak_mb, peak)
    return meshed, places, meshed.surface if found.tets is not None else found.surface


def _read(source: Source, options: MeshOptions, progress: Progress | None) -> Input:
    if isinstance(source, (str, Path)):
        return read_input(source, interfaces=False, edge_length=options.edge_length, progress=progress)
    if isinstance(source, Input):
        return source
    if isinstance(source, (TriangleMesh, TetMesh, TetDomain)):
        return from_mesh(source)
    raise InvalidInput(
        f"a path, TriangleMesh, SurfaceDomain, TetMesh or TetDomain is needed, not {type(source).__name__}",
        "wrong_type",
    )
