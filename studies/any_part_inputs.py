"""What any_part.py runs on: files of the data folder, surfaces that packages ship, and generated ones, each with what
is known of it."""

import gzip
import json
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import octafield
from any_part_shapes import SHAPES
from octafield.domain.inputs import read_input

ENDINGS = (".stl", ".obj", ".off", ".ply", ".vtp")
DAMAGED = {"scan_holes": 6}  # so many holes of a ring of triangles are cut into it
ASCII_SIX_DIGITS = ("knot_2_3", "lattice")
BINARY = ("far_torus", "screw", "sliver_rod", "scan_328k", "gyroid")


@dataclass
class Case:
    """volume, euler: of the body that the file means; None where unknown. sound: the file has no defect."""

    name: str
    path: Path
    source: str
    volume: float | None = None
    euler: int | None = None
    sound: bool = True


def collect(folder: Path, data: Path | None, extra: list[Path]) -> list[Case]:
    """Writes the generated files to `folder` and lists all inputs."""
    folder.mkdir(parents=True, exist_ok=True)
    cases = list(_generated(folder))
    if data is not None:
        cases += [*_shared(data), *_boundaries(data, folder)]
    cases += list(_shipped())
    for place in extra:
        found = sorted(place.rglob("*")) if place.is_dir() else [place]
        cases += [_measured(Case(path.name, path, "extra")) for path in found if path.name.lower().endswith(ENDINGS)]
    return cases


def truth(mesh: octafield.TriangleMesh) -> tuple[float, int] | None:
    """Volume and Euler characteristic of a surface without defects, but for crossings, which are not looked for."""
    if octafield.surface.find_defects(mesh, self_intersection=False):
        return None
    return float(octafield.surface.signed_volume(mesh)), int(octafield.surface.euler_characteristic(mesh))


def _measured(case: Case) -> Case:
    """A broken file has no truth of its own."""
    try:
        known = truth(octafield.read_surface(case.path))
    except octafield.Error:
        known = None
    if known is None:
        case.sound = False
    else:
        case.volume, case.euler = known
    return case


def _generated(folder: Path) -> Iterator[Case]:
    for name, make in SHAPES.items():
        path = folder / f"{name}{'.stl' if name in (*BINARY, *ASCII_SIX_DIGITS) else '.obj'}"
        points, triangles = make()
        known = truth(octafield.TriangleMesh(points, triangles.astype(np.int32)))
        if known is None:
            raise RuntimeError(f"{name}: the generator makes a surface with defects")
        if name in DAMAGED:
            triangles = _with_holes(points, triangles, DAMAGED[name])
        if not path.exists():
            _write(path, points, triangles, ascii_digits=6 if name in ASCII_SIX_DIGITS else None)
        yield Case(name, path, "generated", *known, sound=name not in DAMAGED)


def _with_holes(points: np.ndarray, triangles: np.ndarray, count: int) -> np.ndarray:
    random = np.random.default_rng(0)
    size = np.linalg.norm(np.ptp(points, axis=0))
    centres = points[random.choice(len(points), count, replace=False)]
    middle = points[triangles].mean(axis=1)
    near = np.min([np.linalg.norm(middle - c, axis=1) for c in centres], axis=0) < 0.03 * size
    return triangles[~near]


def _write(path: Path, points: np.ndarray, triangles: np.ndarray, ascii_digits: int | None) -> None:
    if path.suffix == ".obj":
        lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points.tolist()] + [
            "f {} {} {}".format(*t) for t in (triangles + 1).tolist()
        ]
        path.write_text("\n".join(lines) + "\n")
    elif ascii_digits is None:
        record = np.zeros(len(triangles), [("n", "<f4", 3), ("p", "<f4", (3, 3)), ("a", "<u2")])
        record["p"] = points[triangles]
        path.write_bytes(b"binary".ljust(80) + np.uint32(len(triangles)).tobytes() + record.tobytes())
    else:
        words = [
            [f"vertex {x:.{ascii_digits}g} {y:.{ascii_digits}g} {z:.{ascii_digits}g}" for x, y, z in t]
            for t in points[triangles].tolist()
        ]
        facets = [f"facet normal 0 0 0\nouter loop\n{a}\n{b}\n{c}\nendloop\nendfacet" for a, b, c in words]
        path.write_text("\n".join(["solid part", *facets, "endsolid part"]) + "\n")


def _shared(data: Path) -> Iterator[Case]:
    told = {entry["name"]: entry for entry in json.loads((data / "surfaces/manifest.json").read_text())}
    for path in [
        *sorted((data / "surfaces").glob("*.obj")),
        *sorted((data / "surfaces").glob("*.stl.gz")),
        data / "surfaces/bad_soup_s04.stl",
    ]:
        name = path.name.split(".")[0].removesuffix("_binary")
        of = told[
            (
                name
                if name in told and not name.startswith("bad")
                else f"{name[-3:]}_surface"
                if name.startswith("bad")
                else name
            )
        ]
        yield Case(path.name, path, "data/surfaces", of["signed_volume"], of["chi"], sound=not name.startswith("bad"))
    for path in sorted((data / "wild").iterdir()):
        if path.name.endswith(ENDINGS) and not path.name.startswith("damaged") and path.name != "s_comma.stl":
            case = _measured(Case(path.name, path, "data/wild"))
            known = {"cube_split_zero.stl": (None, 2), "part_split_points.stl": (None, -16)}.get(path.name)
            if known:
                case.volume, case.euler = known
            yield case


def _boundaries(data: Path, folder: Path) -> Iterator[Case]:
    """Of all tet meshes of the data folder, as OBJ."""
    for mesh in (*sorted((data / "hexme").glob("*.vtk.gz")), *sorted((data / "arff").glob("*.mesh.gz")),
                 data / "arff/prism.node.gz",
                 *sorted((data / "mc3d").glob("*.hexex.gz"))):  # fmt: skip
        path = folder / f"{mesh.name.removesuffix('.gz').rpartition('.')[0]}_boundary.obj"
        if not path.exists():
            tets = _hexex(mesh) if mesh.name.endswith(".hexex.gz") else read_input(mesh).tets
            boundary = octafield.volume.boundary_surface(tets).mesh
            _write(path, np.asarray(boundary.vertices), np.asarray(boundary.triangles), ascii_digits=None)
        yield _measured(Case(path.name, path, f"data/{mesh.parent.name}"))


def _hexex(path: Path) -> octafield.TetMesh:
    """Counts, vertices, and tets with their parameters behind the four ids."""
    with gzip.open(path, "rt") as lines:
        points = [next(lines).split() for _ in range(int(next(lines)))]
        tets = [next(lines).split()[:4] for _ in range(int(next(lines)))]
    return octafield.TetMesh(np.array(points, float), np.array(tets, np.int32))


def _shipped() -> Iterator[Case]:
    """Of the packages pyvista, trimesh and meshio; the last two ship none in their packages of today."""
    import meshio
    import pyvista
    import trimesh

    for package in (pyvista, trimesh, meshio):
        for path in sorted(Path(str(package.__file__)).parent.rglob("*")):
            if path.name.lower().endswith(ENDINGS):
                yield _measured(Case(path.name, path, package.__name__))


def unpacked(path: Path, folder: Path) -> Path:
    """A file without its .gz."""
    if path.suffix != ".gz":
        return path
    target = folder / path.stem
    with gzip.open(path) as source, target.open("wb") as out:
        shutil.copyfileobj(source, out)
    return target
