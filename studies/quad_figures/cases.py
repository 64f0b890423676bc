"""Domains and singular points of the figures. t: four times the index, so 4 - t quads meet there."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import octafield
from surface_meshes import even_disk, region, resampled
from surface_non_orthogonal import aerofoil, corners_of_one, diamond, polygon, right_trapezoid, shuriken, solved

Points = list[dict]
T_MESH, SEPARATRICES = "t-mesh", "separatrices"
TIPS = 28.65  # degrees, of the very acute diamond


@dataclass
class Case:
    """make: a surface from an edge length, with what the arguments of compute_quad_layout are beside it. finer: edges
    of the triangles are those of the command divided by this. window: middle and half width of what is drawn, None:
    all. shows, differs: what the document has, and how that differs."""

    name: str
    title: str
    make: Callable[[float], tuple[octafield.TriangleMesh, dict]]
    sheet: str
    layout: str = SEPARATRICES
    inadmissible: str = "default"
    end_tolerance: float = 0.0
    quads: int = 500
    finer: float = 1.0
    window: tuple | None = None
    drawn: bool = True
    shows: str = ""
    differs: str = ""


def at(radius: float, degrees: float, t: int) -> dict:
    angle = np.radians(degrees)
    return {"position": [radius * np.cos(angle), radius * np.sin(angle), 0.0], "index_times_four": t}


def placed(x: float, y: float, t: int) -> dict:
    return {"position": [x, y, 0.0], "index_times_four": t}


def circle(radius: float, edge: float) -> np.ndarray:
    angle = np.linspace(0, 2 * np.pi, 20_001)
    return resampled(
        [radius * np.column_stack([np.cos(angle), np.sin(angle)])], lambda points: np.full(len(points), edge)
    )


SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]


def holed_square(points: Points, radius: float = 0.4) -> Callable:
    return lambda edge: (polygon(SQUARE, edge, circle(radius, edge)), {"singularities": points})


def square(points: Points) -> Callable:
    return lambda edge: (polygon(SQUARE, edge), {"singularities": points})


def disk(points: Points) -> Callable:
    return lambda edge: (even_disk(edge), {"singularities": points})


def l_shape(edge: float) -> tuple:
    return polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], edge), {"singularities": []}


def annulus(turn: float) -> Callable:
    """Four points of valence 5 on a circle, four of valence 3 on a wider one, turned by some degrees."""
    points = [at(0.5, 90 * k, -1) for k in range(4)] + [at(0.8, 90 * k + turn, 1) for k in range(4)]

    def make(edge: float) -> tuple:
        size = lambda places: np.full(len(places), edge)
        return region([circle(1, edge), circle(0.3, edge)], size), {"singularities": points}

    return make


def of_two_lines(make: Callable, one_quad: Callable | None = None) -> Callable:
    """The singular points of the non-orthogonal field on a domain, imposed on an orthogonal one. one_quad: corners
    that have one quad whatever their angle."""

    def made(edge: float) -> tuple:
        mesh = make(edge)
        corners = None if one_quad is None else corners_of_one(mesh, one_quad())
        _, found = solved(mesh, **({} if corners is None else {"corners": corners}))
        points = [
            {"position": list(p.position), "index_times_four": p.index_times_symmetry}
            for p in found.points
            if not p.boundary
        ]
        return mesh, {"singularities": points} | ({} if corners is None else {"corners": corners})

    return made


def tips() -> list[tuple]:
    half = np.radians(TIPS) / 2
    return [(-np.cos(half), 0), (0, -np.sin(half)), (np.cos(half), 0), (0, np.sin(half))]


KITE = [at(0.85009, angle, 1) for angle in (0, 85, 180, 275)]
GENERIC = [at(radius, angle, 1) for radius, angle in ((0.8, 0), (0.7, 83), (0.85, 190), (0.6, 262))]
EIGHT = [placed(0, 0, -4)]

PLACES = "places are ours"
GOLDEN = "figures 1, 8, 10, 12: a layout"
RINGS = "figure 11"
CYCLES = "figures 15 to 17: limit cycles cut, T-junctions merged"
NO_CYCLES = "no limit cycle: a field from one H has none"
THESIS = "the points of the thesis"
CASES = [
    Case("holed_5", "square less a disk, valence 5", holed_square([at(1.0, 45 + 90 * k, -1) for k in range(4)]),
         "blocks", shows=GOLDEN, differs=PLACES),
    Case("holed_6", "square less a disk, valence 6", holed_square([at(0.8, 180 * k, -2) for k in range(2)]), "blocks",
         shows=GOLDEN, differs=PLACES),
    Case("holed_8", "square less a disk, valence 8", holed_square([placed(0.55, 0, -4)], 0.3), "blocks", quads=1500,
         finer=5 / 3, end_tolerance=1e-3, shows=GOLDEN,
         differs="on a diagonal it would be 45 degrees off; sizes differ much"),
    Case("l_shape", "L", l_shape, "blocks", shows="no figure", differs="-"),
    Case("square_8", "square, valence 8", square([*EIGHT, *(at(0.9, 45 + 90 * k, 1) for k in range(4))]), "blocks",
         shows="figure 4: valence 8 alone", differs="a square without a hole needs four of valence 3 with it"),
    Case("disk_8", "disk, valence 8", disk([*EIGHT, *(at(0.7, 45 * k, 1) for k in range(8))]), "blocks",
         shows="no figure", differs="-"),
    Case("annulus", "rings at equal angles", annulus(0), "rings", shows=RINGS + ", left: a layout", differs=PLACES),
    Case("annulus_fail", "turned by 20 degrees", annulus(20), "rings", shows=RINGS + ", right: no layout",
         differs="the angle is told"),
    Case("annulus_move", "the same, moved", annulus(20), "rings", inadmissible="move", finer=5 / 3, shows="-",
         differs="ours"),
    Case("annulus_rotate", "turned by 5, field rotated", annulus(5), "rings", T_MESH, "rotate", end_tolerance=0.05,
         shows="-", differs="ours; sizes disagree round the ring, and tracks become one"),
    Case("kite", "kite, separatrices", disk(KITE), "cycles", shows=CYCLES, differs=f"{NO_CYCLES}; near misses join"),
    Case("kite_apart", "kite, nothing joined", disk(KITE), "cycles", T_MESH, end_tolerance=1e-3, shows=CYCLES,
         differs="tracks that run side by side become one"),
    Case("kite_long", "kite, nothing joined, separatrices", disk(KITE), "cycles", end_tolerance=1e-3, drawn=False,
         shows=CYCLES, differs="a separatrix winds on without an end: refused"),
    Case("generic", "general places, separatrices", disk(GENERIC), "cycles", shows="no figure", differs="-"),
    Case("generic_t", "general places, T-mesh", disk(GENERIC), "cycles", T_MESH, shows="no figure", differs="-"),
    Case("aerofoil", "NACA 2412 in a box", of_two_lines(aerofoil), "profile", quads=8000, window=((0, 0), 0.75),
         shows=THESIS + ", figure 4.8: two of valence 5", differs="chords at the nose: quads are large at its points"),
    Case("aerofoil_nose", "its nose", of_two_lines(aerofoil), "profile", quads=8000, window=((-0.47, 0), 0.06)),
    Case("shuriken", "shuriken", of_two_lines(shuriken), "profile", T_MESH, quads=1500,
         shows=THESIS + ", figure 4.6: 11 of valence 5", differs="-"),
    *(
        Case(f"trapezoid_{degrees}", f"right trapezoid, {degrees} degrees",
             of_two_lines(lambda edge, d=degrees: right_trapezoid(d, edge)), "corners",
             shows=THESIS + ", figure 4.5: " + ("none" if degrees > 45 else "one"), differs="crosses at right angles")
        for degrees in (50, 40, 30, 20)
    ),
    Case("diamond", f"diamond, {TIPS:g} degrees", of_two_lines(lambda edge: diamond(TIPS, edge), tips), "corners",
         shows=THESIS + ", figure 4.2: none", differs="one quad at every corner, as there"),
]  # fmt: skip
