"""Outlines from GeoJSON-like dictionaries (RFC 7946, coordinates taken as plane ones)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from .._core import PlanarOutline
from ..errors import InvalidInput
from .outline import planar_outline

_PARTS = {"MultiPolygon": "Polygon", "MultiLineString": "LineString", "MultiPoint": "Point"}


def outline_of_geojson(value: Mapping[str, Any]) -> PlanarOutline:
    """Polygons (the first ring and its holes) give the region, LineStrings lines inside, Points more vertices; Feature,
    FeatureCollection, GeometryCollection and the Multi kinds all of their parts. Third coordinates and properties are
    left out. Raises InvalidInput (kind bad_geojson), and as planar_outline."""
    loops: list[np.ndarray] = []
    lines: list[np.ndarray] = []
    points: list[np.ndarray] = []
    _collect(value, {"Polygon": loops, "LineString": lines, "Point": points})
    if not loops:
        raise InvalidInput("the GeoJSON has no Polygon, so nothing is inside", "empty")
    return planar_outline(loops, lines, np.concatenate(points) if points else None)


def _collect(value: object, into: dict[str, list[np.ndarray]]) -> None:
    if not isinstance(value, Mapping):
        raise InvalidInput(f"GeoJSON objects are dictionaries, not {type(value).__name__}", "bad_geojson")
    kind = value.get("type")
    parts = {"FeatureCollection": "features", "GeometryCollection": "geometries"}.get(str(kind))
    if kind == "Feature":
        if value.get("geometry") is not None:
            _collect(value["geometry"], into)
    elif parts is not None:
        for part in _list(value, parts):
            _collect(part, into)
    elif kind in _PARTS:
        for part in _list(value, "coordinates"):
            _collect({"type": _PARTS[str(kind)], "coordinates": part}, into)
    elif kind == "Polygon":
        into["Polygon"] += [_rows(ring) for ring in _list(value, "coordinates")]
    elif kind == "LineString":
        into["LineString"].append(_rows(_list(value, "coordinates")))
    elif kind == "Point":
        into["Point"].append(_rows([_list(value, "coordinates")]))
    else:
        raise InvalidInput(f"{kind!r} is no type of GeoJSON", "bad_geojson")


def _list(value: Mapping[str, Any], name: str) -> list[Any]:
    found = value.get(name)
    if not isinstance(found, (list, tuple)):
        raise InvalidInput(f"a {value.get('type')} of GeoJSON needs a list {name!r}", "bad_geojson")
    return list(found)


def _rows(coordinates: object) -> np.ndarray:
    try:
        rows = np.asarray(coordinates, dtype=float)
    except (TypeError, ValueError) as error:
        raise InvalidInput(f"coordinates of GeoJSON are lists of numbers ({error})", "bad_geojson") from error
    if rows.ndim != 2 or rows.shape[1] not in (2, 3):
        raise InvalidInput(f"positions of GeoJSON have 2 or 3 numbers, got shape {rows.shape}", "bad_geojson")
    return rows[:, :2]
