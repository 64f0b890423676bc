"""How large a field will be and what it takes, before it is computed."""

import os

import numpy as np

from . import _core
from ._core import TriangleMesh
from .costs import field_seconds
from .options import FieldOptions

_TETS_PER_CUBE = 12.5  # in a cube of one edge length; measured on remeshed bodies of 2,000 to 100,000 tets: 11 to 16


def edge_length(surface: TriangleMesh, asked: float) -> float:
    """Of remeshing, input unit; asked 0: the default, which remesh shortens where the shape needs it."""
    return asked or float(_core.default_edge_length(surface))


def tets_inside(surface: TriangleMesh, length: float) -> int:
    """About how many tets fill a closed surface at an edge length."""
    return max(int(_TETS_PER_CUBE * abs(_core.signed_volume(surface)) / length**3), len(surface.triangles))


def edge_length_for(surface: TriangleMesh, tets: float) -> float:
    """That fills a closed surface with about so many tets."""
    return float(np.cbrt(_TETS_PER_CUBE * abs(_core.signed_volume(surface)) / tets))


def memory_mb(tets: int) -> float:
    """Peak of one field by default options."""
    from .study.memory import needed_mb
    from .study.plan import Run

    return needed_mb(tets, [Run("", "", "", FieldOptions(), 0)])


def seconds(tets: int) -> float:
    """From file to field by default options."""
    return 1.0 + field_seconds(FieldOptions().representation, tets)


def machine_mb() -> float:
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e6
