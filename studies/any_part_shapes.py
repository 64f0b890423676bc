"""Surfaces made by rule for any_part.py: thin walls, needles, high genus, noise, scans with holes, and files as other
programs write them.

Each maker returns (points, triangles); SHAPES holds them by name. Holes and coarse coordinates are added by
any_part_inputs.py, so that volume and Euler characteristic of the sound body are known.
"""

import itertools
from collections.abc import Callable

import numpy as np
import pyvista

Mesh = tuple[np.ndarray, np.ndarray]


def of_poly(poly: pyvista.PolyData) -> Mesh:
    """Triangles with shared vertices, oriented outwards."""
    clean = poly.triangulate().clean(tolerance=1e-9)
    clean = clean.compute_normals(auto_orient_normals=True, split_vertices=False, cell_normals=False)
    return np.asarray(clean.points, float), clean.faces.reshape(-1, 4)[:, 1:].copy()


def joined(*parts: Mesh) -> Mesh:
    """Several closed surfaces as one file; a reversed one is a cavity."""
    offsets = np.cumsum([0, *(len(p) for p, _ in parts)])
    return np.concatenate([p for p, _ in parts]), np.concatenate(
        [t + o for (_, t), o in zip(parts, offsets, strict=False)]
    )


def reversed_(mesh: Mesh) -> Mesh:
    return mesh[0], mesh[1][:, ::-1]


def box(x: float, y: float, z: float, inset: float = 0.0) -> Mesh:
    return of_poly(pyvista.Box(bounds=(inset, x - inset, inset, y - inset, inset, z - inset)))


def ball(radius: float = 1.0, levels: int = 4, centre: tuple[float, float, float] = (0, 0, 0)) -> Mesh:
    return of_poly(pyvista.Icosphere(radius=radius, nsub=levels, center=centre))


def grid_faces(rows: int, columns: int, wrap_rows: bool, wrap_columns: bool) -> np.ndarray:
    """Triangles of a grid of rows x columns vertices, closed over its ends where told."""
    i, j = np.meshgrid(np.arange(rows - (not wrap_rows)), np.arange(columns - (not wrap_columns)), indexing="ij")
    i, j, k, m = i.ravel(), j.ravel(), (i.ravel() + 1) % rows, (j.ravel() + 1) % columns
    a, b, c, d = i * columns + j, k * columns + j, k * columns + m, i * columns + m
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def outward(mesh: Mesh) -> Mesh:
    p = mesh[0][mesh[1]]
    return mesh if np.einsum("ij,ij->", p[:, 0], np.cross(p[:, 1], p[:, 2])) > 0 else reversed_(mesh)


def lathe(profile: np.ndarray, segments: int, height: Callable | None = None) -> Mesh:
    """A closed profile (n, 2) of radius and z, turned about z; `height` moves the radii by angle and z."""
    angle = np.arange(segments) / segments * 2 * np.pi
    radius, z = np.asarray(profile, float).T
    radii = np.broadcast_to(radius, (segments, len(z))).copy()
    if height is not None:
        radii += height(angle[:, None], radius[None], z[None])
    points = np.stack(
        [radii * np.cos(angle)[:, None], radii * np.sin(angle)[:, None], np.broadcast_to(z, radii.shape)], axis=2
    )
    return outward((points.reshape(-1, 3), grid_faces(segments, len(z), True, True)))


def tube(curve: np.ndarray, radius: float, sides: int, closed: bool) -> Mesh:
    """About a space curve (n, 3), with flat ends where it is open."""
    along = np.gradient(curve, axis=0) if not closed else np.roll(curve, -1, 0) - np.roll(curve, 1, 0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    normal = np.empty_like(along)
    normal[0] = np.cross(along[0], [0.31, 0.17, 0.93])
    for k in range(1, len(curve)):
        normal[k] = normal[k - 1] - along[k] * (along[k] @ normal[k - 1])
        normal[k] /= np.linalg.norm(normal[k])
    normal[0] = normal[1] - along[0] * (along[0] @ normal[1])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    second = np.cross(along, normal)
    angle = np.arange(sides) / sides * 2 * np.pi
    turn = 0.0
    if closed:  # the frame carried round comes back turned: spread that over the curve
        turn = np.arctan2(normal[-1] @ second[0], normal[-1] @ normal[0])
    shift = (angle[None] - turn * np.arange(len(curve))[:, None] / len(curve))[..., None]
    points = curve[:, None] + radius * (np.cos(shift) * normal[:, None] + np.sin(shift) * second[:, None])
    points, faces = points.reshape(-1, 3), grid_faces(len(curve), sides, closed, True)
    if not closed:
        n, ring = len(points), np.arange(sides)
        points = np.concatenate([points, curve[[0, -1]]])
        last = ring + n - sides
        faces = np.concatenate([faces, np.stack([np.full(sides, n), ring, np.roll(ring, -1)], axis=1),
                                np.stack([np.full(sides, n + 1), np.roll(last, -1), last], axis=1)])  # fmt: skip
    return outward((points, faces))


def prism(outline: np.ndarray, height: float) -> Mesh:
    """A simple polygon (n, 2), extruded."""
    n = len(outline)
    flat = pyvista.PolyData(np.c_[outline, np.zeros(n)], faces=np.r_[n, np.arange(n)]).triangulate()
    cap = flat.faces.reshape(-1, 4)[:, 1:]
    points = np.concatenate([np.c_[outline, np.full(n, z)] for z in (0.0, height)])
    p = points[cap]
    if np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])[:, 2].sum() > 0:
        cap = cap[:, ::-1]
    k, m = np.arange(n), (np.arange(n) + 1) % n
    forward = np.sum(outline[k, 0] * outline[m, 1] - outline[m, 0] * outline[k, 1]) > 0
    sides = np.concatenate([np.stack([k, m, m + n], axis=1), np.stack([k, m + n, k + n], axis=1)])
    return outward((points, np.concatenate([cap, cap[:, ::-1] + n, sides if forward else sides[:, ::-1]])))


def level_set(function: Callable, bound: float, cells: int) -> Mesh:
    """{function < 0} in the cube [-bound, bound]^3, its largest piece closed at the cube's faces."""
    axis = np.linspace(-bound, bound, cells + 1)
    x, y, z = np.meshgrid(axis, axis, axis, indexing="ij")
    values = np.asarray(function(x, y, z), float)
    for side in range(3):
        np.moveaxis(values, side, 0)[[0, -1]] = bound
    grid = pyvista.ImageData(dimensions=(cells + 1,) * 3, spacing=(2 * bound / cells,) * 3, origin=(-bound,) * 3)
    grid["value"] = values.ravel(order="F")
    return outward(of_poly(grid.contour([1e-9 * bound], scalars="value").connectivity("largest")))


def voxels(filled: np.ndarray) -> Mesh:
    """Boundary of unit cubes; no two of them may touch along an edge or corner alone."""
    padded, quads = np.pad(filled, 1), []
    for axis in range(3):
        for step in (1, -1):
            cells = np.argwhere(padded & ~np.roll(padded, -step, axis))
            square = np.array([(0, 0), (1, 0), (1, 1), (0, 1)][::step])
            corner = np.zeros((4, 3), int)
            corner[:, [(axis + 1) % 3, (axis + 2) % 3]] = square
            corner[:, axis] = step > 0
            quads.append(cells[:, None] + corner)
    points, ids = np.unique(np.concatenate(quads).reshape(-1, 3), axis=0, return_inverse=True)
    q = ids.reshape(-1, 4)
    return points - 1.0, np.concatenate([q[:, [0, 1, 2]], q[:, [0, 2, 3]]])


def menger() -> Mesh:
    index = np.arange(9)
    ones = np.stack(np.meshgrid(*[index] * 3, indexing="ij"))
    holes = [((ones // s % 3) == 1).sum(axis=0) >= 2 for s in (1, 3)]
    return voxels(~(holes[0] | holes[1]))


def engraved() -> Mesh:
    """A block with letters of half a unit's depth: one part in a hundred of its size."""
    words = ["1110111001001110", "1000101001001000", "1000101001001100", "1000101001001000", "1110111001101000"]
    letters = np.array([[c == "1" for c in word] for word in words])
    depth = np.ones((20, 9, 4), bool)
    depth[2:18, 2:7, 3] = ~letters.T
    points, triangles = voxels(depth)
    return points * [3, 3, 1] * np.where(points[:, 2:] > 3, [1, 1, 1], 1), triangles


def gear(teeth: int = 24) -> Mesh:
    """With a bore: rings of as many points joined by strips."""
    angle = np.arange(4 * teeth) / (4 * teeth) * 2 * np.pi
    outer = np.where(np.arange(4 * teeth) % 4 < 2, 10.0, 8.5)
    ring = np.c_[np.cos(angle), np.sin(angle)]
    rings = [
        np.c_[ring * r, np.full(len(ring), z)] for r, z in ((outer[:, None], 0), (outer[:, None], 5), (3, 5), (3, 0))
    ]
    points = np.stack(rings, axis=1).reshape(-1, 3)
    return outward((points, grid_faces(4 * teeth, 4, True, True)))


def comb(fins: int = 12) -> Mesh:
    """A heat sink: thin fins on a plate."""
    outline = [(0.0, 0.0), (5.0 * fins, 0.0)]
    for k in reversed(range(fins)):
        outline += [
            (5 * k + 5.0, 3.0),
            (5 * k + 3.0, 3.0),
            (5 * k + 3.0, 25.0),
            (5 * k + 2.4, 25.0),
            (5 * k + 2.4, 3.0),
        ]
    return prism(np.array([*outline, (0.0, 3.0)]), 40.0)


def noisy(seed: int, amount: float) -> Mesh:
    points, triangles = of_poly(
        pyvista.ParametricTorus(ringradius=1, crosssectionradius=0.4, u_res=60, v_res=30, w_res=30)
    )
    return points + np.random.default_rng(seed).normal(scale=amount, size=points.shape), triangles


def bumpy(levels: int, seed: int) -> Mesh:
    """A scan: a ball with waves of several lengths."""
    points, triangles = ball(levels=levels)
    random = np.random.default_rng(seed)
    radius = np.ones(len(points))
    for length in (2, 5, 11, 23):
        radius += (
            0.12 / length * np.sin(length * points @ random.normal(size=(3, 2)) + random.uniform(size=2)).sum(axis=1)
        )
    return points * radius[:, None], triangles


def cad(build: Callable, size: float) -> Mesh:
    """A surface triangulation by Gmsh of what build(occ) makes, as CAD programs export: no finer than its curves ask
    for."""
    import gmsh

    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        build(gmsh.model.occ)
        gmsh.model.occ.synchronize()
        gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", 12)
        gmsh.option.setNumber("Mesh.MeshSizeMax", size)
        gmsh.model.mesh.generate(2)
        ids, coordinates, _ = gmsh.model.mesh.getNodes()
        triangles = gmsh.model.mesh.getElementsByType(2)[1].reshape(-1, 3)
    finally:
        gmsh.finalize()
    place = np.zeros(int(ids.max()) + 1, int)
    place[ids.astype(int)] = np.arange(len(ids))
    used, compact = np.unique(place[triangles.astype(int)], return_inverse=True)
    return outward((coordinates.reshape(-1, 3)[used], compact.reshape(-1, 3)))


def bracket(occ) -> None:
    first, second = occ.addBox(0, 0, 0, 60, 40, 6), occ.addBox(0, 0, 0, 6, 40, 50)
    body, _ = occ.fuse([(3, first)], [(3, second)])
    occ.synchronize()
    inner = [tag for _, tag in occ.getEntities(1) if np.allclose(np.array(occ.getCenterOfMass(1, tag))[[0, 2]], 6)]
    body = occ.fillet([body[0][1]], inner, [4.0])
    drills = [(3, occ.addCylinder(x, y, -1, 0, 0, 10, 4)) for x, y in ((45, 10), (45, 30))]
    occ.cut(body, drills)


def plate(occ) -> None:
    sheet = occ.addBox(0, 0, 0, 70, 70, 2)
    occ.cut(
        [(3, sheet)],
        [
            (3, occ.addCylinder(10 * x + 10, 10 * y + 10, -1, 0, 0, 4, 3.5))
            for x, y in itertools.product(range(6), repeat=2)
        ],
    )


def impeller(occ) -> None:
    hub, blades = occ.addCylinder(0, 0, 0, 0, 0, 12, 8), []
    for k in range(6):
        blade = occ.addBox(5, -0.4, 1, 22, 0.8, 10)
        occ.rotate([(3, blade)], 10, 0, 6, 1, 0, 0, 0.6)
        occ.rotate([(3, blade)], 0, 0, 0, 0, 0, 1, k * np.pi / 3)
        blades.append((3, blade))
    occ.fuse([(3, hub)], blades)


def curve(function: Callable, turns: float, count: int, closed: bool) -> np.ndarray:
    t = np.linspace(0, 2 * np.pi * turns, count, endpoint=not closed)
    return np.stack(function(t), axis=1).astype(float)


def torus_knot(p: int, q: int) -> Callable:
    return lambda t: ((2 + np.cos(q * t)) * np.cos(p * t), (2 + np.cos(q * t)) * np.sin(p * t), np.sin(q * t))


def thread(angle: np.ndarray, radius: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Depth 0.6 at a pitch of 2 on the outside of a rod, running out at its ends."""
    wave = np.abs((z / 2 - angle / (2 * np.pi)) % 1 - 0.5) * 2
    return np.where(radius > 4, 0.6 * wave * np.clip(np.minimum(z - 1, 39 - z), 0, 1), 0.0)


def rod_profile() -> np.ndarray:
    z = np.linspace(0, 40, 321)
    return np.concatenate([[(1.5, 0.0)], np.c_[np.full(len(z), 5.0), z], [(1.5, 40.0)]])


def rectangle(inner: float, outer: float, height: float) -> np.ndarray:
    return np.array([(inner, 0.0), (outer, 0.0), (outer, height), (inner, height)])


def gyroid(x, y, z):
    a, b, c = 2.5 * x, 2.5 * y, 2.5 * z
    sheet = np.abs(np.sin(a) * np.cos(b) + np.sin(b) * np.cos(c) + np.sin(c) * np.cos(a)) - 0.45
    return np.maximum(sheet, np.max(np.abs([x, y, z]), axis=0) - 3)


def foam(x, y, z):
    centres = np.random.default_rng(3).uniform(-1, 1, size=(40, 3))
    nearest = np.min([np.linalg.norm([x - a, y - b, z - c], axis=0) for a, b, c in centres], axis=0)
    return np.maximum(0.30 - nearest, np.max(np.abs([x, y, z]), axis=0) - 1)


def struts(x, y, z):
    nearest = [np.hypot((u + 0.5) % 1 - 0.5, (v + 0.5) % 1 - 0.5) - 0.16 for u, v in ((x, y), (y, z), (z, x))]
    return np.maximum(np.min(nearest, axis=0), np.max(np.abs([x, y, z]), axis=0) - 1.4)


def blobs(x, y, z):
    return 1.0 - sum(
        0.35 / ((x - a) ** 2 + (y - b) ** 2 + (z - c) ** 2 + 0.05)
        for a, b, c in ((0, 0, 0), (0.7, 0.2, 0), (-0.6, 0.4, 0.3))
    )


SHAPES: dict[str, Callable[[], Mesh]] = {
    "hollow_box": lambda: joined(box(100, 60, 40), reversed_(box(100, 60, 40, 1.0))),
    "cup": lambda: lathe(np.array([(0.5, 0), (30, 0), (32, 70), (30.5, 70), (28.5, 1.5), (0.5, 1.5)]), 64),
    "thin_pipe": lambda: lathe(rectangle(9.6, 10, 80), 48),
    "screw": lambda: lathe(rod_profile(), 48, thread),
    "spring": lambda: tube(curve(lambda t: (10 * np.cos(t), 10 * np.sin(t), 0.7 * t), 6, 300, False), 1.2, 12, False),
    "knot_2_3": lambda: tube(curve(torus_knot(2, 3), 1, 300, True), 0.35, 16, True),
    "knot_3_8": lambda: tube(curve(torus_knot(3, 8), 1, 800, True), 0.15, 10, True),
    "needle": lambda: of_poly(pyvista.Cone(height=100, radius=1, resolution=24)),
    "wedge": lambda: prism(np.array([(0, 0), (40, 0), (40, 1.4)]), 20),
    "gyroid": lambda: level_set(gyroid, 3.2, 60),
    "foam": lambda: level_set(foam, 1.05, 50),
    "lattice": lambda: level_set(struts, 1.45, 60),
    "noisy_torus": lambda: noisy(1, 0.004),
    "very_noisy_torus": lambda: noisy(2, 0.012),
    "scan_holes": lambda: level_set(blobs, 2.5, 48),
    "terraces": lambda: prism(np.array([(0, 0), *[(k + d, 0.3 * (20 - k)) for k in range(20) for d in (0, 1)],
        (20, 0)]), 8),
    "engraved": engraved,
    "gear": gear,
    "fins": comb,
    "shell_gap": lambda: joined(ball(1.0), reversed_(ball(0.98))),
    "two_bodies": lambda: joined(ball(1.0), ball(1.0, centre=(2.01, 0, 0))),
    "chain": lambda: joined(tube(curve(lambda t: (2 * np.cos(t), 2 * np.sin(t), 0 * t), 1, 80, True), 0.5, 20, True),
                            tube(curve(lambda t: (2 + 2 * np.cos(t), 0 * t, 2 * np.sin(t)), 1, 80, True), 0.5, 20,
                                True)),
    "bracket": lambda: cad(bracket, 1e3),
    "plate_36": lambda: cad(plate, 1e3),
    "impeller": lambda: cad(impeller, 1e3),
    "menger": menger,
    "sliver_rod": lambda: of_poly(pyvista.Cylinder(radius=10, height=100, resolution=400)),
    "far_torus": lambda: (noisy(1, 0)[0] * 10 + 1e5, noisy(1, 0)[1]),
    "tiny_knot": lambda: (tube(curve(torus_knot(2, 3), 1, 200, True), 0.5, 16, True)[0] * 1e-6,
                          tube(curve(torus_knot(2, 3), 1, 200, True), 0.5, 16, True)[1]),
    "scan_328k": lambda: bumpy(7, 5),
}  # fmt: skip
