"""Surfaces measured in wanted edge lengths of quads: where quads shall be small, much of it is."""

from __future__ import annotations

import numpy as np

from .. import _core
from .._core import SurfaceDomain
from ..errors import GeometryError, InvalidInput
from ..hexdom.sizes import SizeAt

_STEP = 2.0  # sizes at the ends of an edge: beyond this ratio triangles cannot tell how a field turns


def sized(domain: SurfaceDomain, sizes: SizeAt) -> SurfaceDomain:
    """The same surface by other edge lengths: int ds / size, the size geometric between the ends of an edge, up to the
    one factor that keeps its area. Its area without that factor, in quads, is quads_wanted.

    Raises InvalidInput (kind "steep_sizes") where sizes change too fast for the triangles."""
    lengths = np.asarray(domain.edge_lengths) * _inverse_means(domain, sizes)
    try:
        plain = domain.with_edge_lengths(lengths)
    except GeometryError as error:
        raise _steep(domain, error.elements) from error
    factor = float(np.sqrt(np.asarray(domain.areas).sum() / np.asarray(plain.areas).sum()))
    return domain.with_edge_lengths(lengths * factor)


def quads_wanted(domain: SurfaceDomain, sizes: SizeAt) -> float:
    """int dA / size^2, over triangles that are flat in space with sizes linear in them (rule of three midpoints)."""
    values = sizes(np.asarray(domain.vertices))[np.asarray(domain.triangles)]
    middle = (values + np.roll(values, -1, axis=1)) / 2
    return float((np.asarray(_core.triangle_areas(domain.mesh)) * (middle**-2.0).mean(axis=1)).sum())


def _inverse_means(domain: SurfaceDomain, sizes: SizeAt) -> np.ndarray:
    at = sizes(np.asarray(domain.vertices))[np.asarray(domain.edges)]
    ratio = at.max(axis=1) / at.min(axis=1)
    if (ratio > _STEP).any():
        raise _steep(domain, [int(e) for e in np.flatnonzero(ratio > _STEP)[:100]])
    step = np.log(at[:, 1] / at[:, 0])
    even = abs(step) < 1e-6
    with np.errstate(invalid="ignore", divide="ignore"):
        means = np.where(even, 2 / at.sum(axis=1), (1 / at[:, 0] - 1 / at[:, 1]) / step)
    result: np.ndarray = means
    return result


def _steep(domain: SurfaceDomain, edges: list[int]) -> InvalidInput:
    place = np.asarray(domain.vertices)[np.asarray(domain.edges)[edges[0]]].mean(axis=0) if edges else np.zeros(3)
    return InvalidInput(
        f"sizes change too fast for the triangles, first at ({', '.join(f'{x:.4g}' for x in place)}): by more than"
        f" {_STEP:g} times along an edge; --triangle-length (edge_length of the field's options) gives shorter"
        " triangles, or let sizes grow more slowly",
        "steep_sizes",
        edges,
    )
