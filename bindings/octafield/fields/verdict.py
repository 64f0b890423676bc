"""Whether a field can be trusted: fine, too coarse for its shape, or with places that no hex mesh has. Said at the end
of `field` and `info`, in records and in reports."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _core
from ..domain.meshed_input import MeshedInput

if TYPE_CHECKING:
    from ..records.field import FieldFigures
    from ..records.parts import Verdict

FINE, COARSE, NOT_MESHABLE, NO_FIELD = "fine", "coarse", "not meshable", "no field"
WARN = "warn"  # the state of a requirement that a field can do without
OFF = 20.0  # degrees between a normal and the nearest axis of its frame
BENT = 30.0  # degrees between triangles at an edge that is no feature
SHARE_OFF, SHARE_COARSE = 0.02, 0.1  # of the area that may be off, and off or bent, before it is worth a word
_LISTED = 100  # vertices in a record


def of_field(meshed: MeshedInput, off: np.ndarray, figures: FieldFigures) -> Verdict:
    """off: (k,) ids of vertices of the boundary whose frames are more than OFF degrees from normals that can be served.
    figures: of the analysis."""
    domain = meshed.volume()
    boundary, features = domain.surface, domain.features
    points, triangles = np.asarray(boundary.mesh.vertices), np.asarray(boundary.mesh.triangles)
    edges, turns = smooth_turns(points, triangles, np.asarray(features.edges))
    bent = edges[turns > BENT]
    coarse = np.union1d(off, bent.ravel()).astype(int)
    areas = np.repeat(np.asarray(_core.triangle_areas(boundary.mesh)) / 3, 3)
    at_vertices = np.bincount(triangles.ravel(), areas, len(points))
    share_off, share = (float(at_vertices[ids].sum() / at_vertices.sum()) for ids in (off, coarse))
    sentences, suggested, named = [], None, coarse[:0]
    if share_off >= SHARE_OFF or share >= SHARE_COARSE:
        named = coarse
        suggested = _length_for(points, edges, turns, coarse)
        sentences.append(
            f"coarse here: {len(coarse):,} vertices ({share:.0%} of the surface): at {len(off):,} frames differ by more"
            f" than {OFF:g} degrees from their normals, and smooth faces turn by more than {BENT:g} degrees at"
            f" {len(bent):,} edges; edges of about {suggested:.2g} would turn half as much (not tried)"
        )
    counts = {
        "singular vertices": figures.non_meshable_vertices,
        "feature edges": figures.non_meshable_feature_edges,
        "corners": figures.non_meshable_corners,
        "points where singular curves reach the surface": figures.non_meshable_crossings,
    }
    places = {words: count for words, count in counts.items() if count}
    if places:
        sentences.append(
            f"places no hex mesh has: {sum(places.values()):,}"
            f" ({', '.join(f'{count:,} {words}' for words, count in places.items())})"
        )
    state = COARSE if len(named) else NOT_MESHABLE if places else FINE
    ids = np.asarray(boundary.vertex_map)[named[:_LISTED]]
    return _entry(state, sentences, ids.tolist(), suggested)


def of_input(requirements: list[dict[str, Any]]) -> Verdict:
    """What the checks of `info` let expect."""
    failed = next((r for r in requirements if r["state"] not in ("pass", WARN)), None)
    if failed is not None:
        return _entry(NO_FIELD, [f"no field: {failed['message'] or failed['requirement']}"], [], None)
    warned = [r for r in requirements if r["kind"] in ("coarse_for_curvature", "thin_walls")]
    lengths = [float(r["remedy"].split()[1]) for r in warned if r["remedy"].startswith("--edge-length ")]
    sentences = [
        f"coarse is to be expected: {r['message']}" + (f"; {r['remedy']}" if r["remedy"] else "") for r in warned
    ]
    return _entry(COARSE if warned else FINE, sentences, [], min(lengths, default=None))


def smooth_turns(points: np.ndarray, triangles: np.ndarray, features: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(k, 2) edges of two triangles that are no features, and (k,) degrees between the normals of the two."""
    p = points[triangles]
    normals = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1).astype(
        np.int64
    )
    key, feature_key = (
        e[:, 0] * len(points) + e[:, 1] for e in (sides, np.sort(features.reshape(-1, 2), axis=1).astype(np.int64))
    )
    order = np.argsort(key, kind="stable")
    first = np.flatnonzero(key[order][1:] == key[order][:-1])
    first = first[~np.isin(key[order[first]], feature_key)]
    a, b = order[first], order[first + 1]
    cosines = np.einsum("kc,kc->k", normals[a % len(triangles)], normals[b % len(triangles)])
    return sides[a], np.degrees(np.arccos(np.clip(cosines, -1, 1)))


def _length_for(points: np.ndarray, edges: np.ndarray, turns: np.ndarray, vertices: np.ndarray) -> float:
    """With which smooth faces would turn by half of BENT at an edge where they turn most now (a tenth of the edges
    there may turn more)."""
    length = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    there = np.isin(edges, vertices).any(axis=1)
    if not there.any():
        return float(rounded_down(0.5 * float(length.mean())))
    ratio = BENT / 2 / max(float(np.quantile(turns[there], 0.9)), BENT)
    return float(rounded_down(ratio * float(np.median(length[there]))))


def _entry(state: str, sentences: list[str], vertices: list[int], length: float | None) -> Verdict:
    from ..records.parts import Verdict

    return Verdict(state=state, sentences=sentences or [FINE], vertices=vertices, suggested_edge_length=length)


def off_vertices(angles: np.ndarray, vertices: np.ndarray) -> np.ndarray:
    """Ids of those whose angle (radians) is above OFF. angles: (k,), vertices: (k,) or (k, 3) of triangles."""
    found: np.ndarray = np.unique(vertices[angles > math.radians(OFF)])
    return found


def rounded_down(value: float) -> str:
    """Two digits, never more than `value`."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f"{math.floor(value / unit * (1 + 1e-12)) * unit:.2g}"
