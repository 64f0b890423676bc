"""Closed surfaces made by rule, for studies without files."""

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._core import TriangleMesh
from ..options import require_one_of


@dataclass(frozen=True)
class Generator:
    """make(**parameters) -> TriangleMesh; parameters: their defaults, input unit."""

    make: Callable[..., TriangleMesh]

    @property
    def parameters(self) -> dict[str, float]:
        return {name: p.default for name, p in inspect.signature(self.make).parameters.items()}


def generate(name: str, **parameters: float) -> TriangleMesh:
    """A closed surface by rule: "ball" (radius), "box" (x, y, z), "cylinder" (radius, height), "torus" (radius, tube)
    or "nut" (of the package pyvista). parameters: input unit. Not remeshed: faces are as large as the shape lets them
    be. Raises InvalidInput.

        >>> from octafield.domain.generators import generate
        >>> generate("box", z=2)
        TriangleMesh(8 vertices, 12 triangles, box [0, 1] x [0, 1] x [0, 2])
    """
    require_one_of("generator", name, GENERATORS)
    known = GENERATORS[name].parameters
    for given in parameters:
        require_one_of(f"parameter of {name}", given, known)
    return GENERATORS[name].make(**parameters)


def _closed(poly: Any) -> TriangleMesh:
    """Triangles with shared vertices, oriented outwards."""
    clean = poly.triangulate().clean(tolerance=1e-9)
    clean = clean.compute_normals(auto_orient_normals=True, split_vertices=False, cell_normals=False)
    return TriangleMesh(np.asarray(clean.points, float), clean.faces.reshape(-1, 4)[:, 1:].astype(np.int32))


def _ball(radius: float = 1.0) -> TriangleMesh:
    import pyvista

    return _closed(pyvista.Icosphere(radius=radius, nsub=4))


def _box(x: float = 1.0, y: float = 1.0, z: float = 1.0) -> TriangleMesh:
    import pyvista

    return _closed(pyvista.Box(bounds=(0, x, 0, y, 0, z)))


def _cylinder(radius: float = 1.0, height: float = 2.0) -> TriangleMesh:
    import pyvista

    return _closed(pyvista.Cylinder(direction=(0, 0, 1), radius=radius, height=height, resolution=64))


def _torus(radius: float = 1.0, tube: float = 0.4) -> TriangleMesh:
    import pyvista

    return _closed(pyvista.ParametricTorus(ringradius=radius, crosssectionradius=tube, u_res=64, v_res=32, w_res=32))


def _nut() -> TriangleMesh:
    from pyvista import examples

    from .._core import read_surface

    return read_surface(examples.nutfile)


GENERATORS = {
    "ball": Generator(_ball),
    "box": Generator(_box),
    "cylinder": Generator(_cylinder),
    "torus": Generator(_torus),
    "nut": Generator(_nut),
}
