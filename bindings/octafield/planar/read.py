"""Outlines from whatever holds one."""

from __future__ import annotations

import json
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from .. import _core
from .._core import PlanarOutline
from ..errors import InvalidInput, IoError
from ..files.reading import plain_name, read_bytes
from ..meshes.gmsh.geo import read_geo_curves
from ..progress.phases import Progress
from .geojson import outline_of_geojson
from .outline import planar_outline
from .poly_file import read_poly

Outline = PlanarOutline | Mapping[str, Any] | str | PathLike[str] | list[Any] | tuple[Any, ...]


def read_outline(path: str | PathLike[str], edge_length: float = 0, progress: Progress | None = None) -> PlanarOutline:
    """The PlanarOutline of a file: GeoJSON (.geojson, .json), .poly of Triangle, or .geo of Gmsh, whose curves Gmsh
    divides by edge_length (0: as the file says). Raises IoError (kind unreadable), InvalidInput and GeometryError."""
    path = Path(path)
    suffix = Path(plain_name(path)).suffix
    if suffix in (".geojson", ".json"):
        try:
            value = json.loads(read_bytes(path))
        except ValueError as error:
            raise IoError(f"{path}: is no JSON ({error})", "unreadable") from error
        return outline_of_geojson(value)
    if suffix == ".poly":
        return read_poly(path)
    if suffix == ".geo":
        return _of_curves(path, *read_geo_curves(path, edge_length, progress))
    raise InvalidInput(f"{path}: outlines are read from .geojson, .json, .poly and .geo files", "unknown_format")


def as_outline(value: Outline, edge_length: float = 0, progress: Progress | None = None) -> PlanarOutline:
    """A PlanarOutline, a GeoJSON-like dictionary, the path of a file, or a list of loops."""
    if isinstance(value, PlanarOutline):
        return value
    if isinstance(value, Mapping):
        return outline_of_geojson(value)
    if isinstance(value, (str, PathLike)):
        return read_outline(value, edge_length, progress)
    return planar_outline(value)


def _of_curves(path: Path, points: np.ndarray, segments: np.ndarray, surfaces: np.ndarray) -> PlanarOutline:
    """Curves at one surface are loops, where there are surfaces; others lines."""
    used, ids = np.unique(segments, return_inverse=True)
    ids = ids.reshape(-1, 2).astype(np.int32)
    if not len(ids):
        raise InvalidInput(f"{path}: has no curves", "empty")
    if not surfaces.any():
        return _core.outline_of_graph(points[used], ids, np.zeros((0, 2)))
    outline = PlanarOutline(points[used], ids[surfaces == 1], ids[surfaces != 1])
    _core.require_planar(outline)
    return outline
