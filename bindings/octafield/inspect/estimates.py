"""How large a field will be and what it takes, before it is computed."""

import os

import numpy as np

from .. import _core
from .._core import FeatureGraph, SizeField, TriangleMesh
from ..options import FieldOptions, MeshOptions

_PREPARING, _UNKNOWN_METHOD = (
    10.0,
    100.0,
)  # seconds on a million tets: up to the cross field; fields that were not measured
_TETS_PER_CUBE = 12.5  # in a cube of one edge length; measured on remeshed bodies of 2,000 to 100,000 tets: 11 to 16


def planned_sizes(surface: TriangleMesh, features: FeatureGraph, options: MeshOptions) -> SizeField:
    """What remeshing starts from, and the cells to be expected: octafield.surface.size_field, or the one length that
    was asked for."""
    if options.edge_length == 0:
        return _core.size_field(surface, features, max_cells=options.cells)
    length = options.edge_length
    triangles = float(np.asarray(_core.triangle_areas(surface)).sum()) / (np.sqrt(3) / 4 * length**2)
    return SizeField(np.full(len(surface.vertices), length), length, length, triangles, tets_inside(surface, length))


def tets_inside(surface: TriangleMesh, length: float) -> int:
    """About how many tets fill a closed surface at an edge length."""
    return max(int(_TETS_PER_CUBE * abs(_core.signed_volume(surface)) / length**3), len(surface.triangles))


def edge_length_for(surface: TriangleMesh, tets: float) -> float:
    """That fills a closed surface with about so many tets."""
    return float(np.cbrt(_TETS_PER_CUBE * abs(_core.signed_volume(surface)) / tets))


def memory_mb(tets: int) -> float:
    """Peak of one field by default options."""
    from ..study.memory import needed_mb
    from ..study.plan import Run

    return needed_mb(tets, [Run("", "", "", FieldOptions(), 0)])


def seconds(tets: int) -> float:
    """From file to field by default options."""
    return 1.0 + field_seconds(FieldOptions().scheme_name, tets)


def field_seconds(representation: str, tets: float) -> float:
    """Of one field from file to analysis, one thread."""
    scheme = _core.schemes.get(representation)
    smoothing = (scheme.seconds_per_million_tets if scheme else 0) or _UNKNOWN_METHOD
    return 0.2 + (_PREPARING + smoothing) * tets / 1e6


def machine_mb() -> float:
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e6
