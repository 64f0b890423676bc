"""Outlines for the study: a generated coast with islands, and a county of the US Census Bureau (public domain)."""

import struct
from pathlib import Path

import numpy as np
import octafield
from surface_coast import ISLANDS, coast

COUNTIES = "package_data/cb_2016_us_county_500k.shp"  # in the package plotly-geo
POLYGON = 5


def coast_outline(edge_length: float, levels: int = 6, seed: int = 4):
    islands = [
        size * coast(levels - 2, seed + 1 + k) + np.array(centre) for k, (centre, size) in enumerate(ISLANDS.items())
    ]
    return octafield.resampled_outline(octafield.planar_outline([coast(levels, seed), *islands]), edge_length)


def county_file() -> Path | None:
    try:
        import _plotly_geo
    except ImportError:
        return None
    return Path(_plotly_geo.__file__).parent / COUNTIES


def county_outline(path: Path, number: str, quads: int):
    """The county of this GEOID, in kilometres (longitudes times the cosine of its mean latitude), with segments for
    about so many quads. The edge length, too."""
    rings = [ring for ring in _rings(path, number)]
    latitude = np.radians(np.concatenate(rings)[:, 1].mean())
    loops = [ring[:-1] * 111.195 * np.array([np.cos(latitude), 1]) for ring in rings]
    area = abs(sum(_area(loop) for loop in loops))
    edge_length = float(np.sqrt(area / quads))
    return octafield.resampled_outline(octafield.planar_outline(loops), edge_length), edge_length


def _area(loop: np.ndarray) -> float:
    x, y = loop.T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)


def _rings(path: Path, number: str) -> list[np.ndarray]:
    """Of a shapefile with its table beside it (ESRI, 1998)."""
    table, shapes = path.with_suffix(".dbf").read_bytes(), path.read_bytes()
    records, header, length = struct.unpack("<IHH", table[4:12])
    fields, at, start = {}, 32, 1
    while table[at] != 0x0D:
        name = table[at : at + 11].rstrip(b"\0").decode()
        fields[name] = (start, start + table[at + 16])
        start, at = start + table[at + 16], at + 32
    low, high = fields["GEOID"]
    rows = [table[header + i * length + low : header + i * length + high].decode().strip() for i in range(records)]
    wanted, at = rows.index(number), 100
    for _ in range(wanted):
        at += 8 + 2 * struct.unpack(">I", shapes[at + 4 : at + 8])[0]
    kind, *_, parts, points = struct.unpack("<I4dII", shapes[at + 8 : at + 52])
    assert kind == POLYGON
    first = [*struct.unpack(f"<{parts}I", shapes[at + 52 : at + 52 + 4 * parts]), points]
    places = np.frombuffer(shapes, "<f8", 2 * points, at + 52 + 4 * parts).reshape(-1, 2)
    return [places[a:b] for a, b in zip(first, first[1:], strict=False)]
