"""CAD models, by Gmsh where it is installed: as triangles, or as tets where solids touch; the model's curves are the
feature edges.

Gmsh works in a process of its own (cad_worker.py): damaged models can crash it or keep it for ever.
"""

import json
import re
from pathlib import Path

import numpy as np

from ... import _core
from ...errors import Cancelled, Error, InvalidInput, IoError
from ...files.reading import plain_name, read_bytes
from ...progress.phases import Progress
from ..grids import Grid
from .cad_worker import WAYS
from .working import ending, run_worker, scratch_for

_FORMATS = {".step": "step", ".stp": "step", ".brep": "brep", ".iges": "iges", ".igs": "iges"}
_WORKER = Path(__file__).with_name("cad_worker.py")
_OF_MESHING = (
    "degenerate_triangle",
    "non_manifold_edge",
    "self_intersection",
)  # defects that another mesh may not have
_NO_NUMBER = re.compile(rb"(?i)[(,\s]\s*([-+]?(?:nan|inf|infinity))\s*[,)\s]")  # on which Open CASCADE does not end


def read_cad(path: Path, edge_length: float, progress: Progress | None = None) -> Grid:
    """Cells with their CAD face and lines along the curves between faces: triangles of the boundary of solids, where
    there are any, else of all faces; where solids touch, tets with the number of their solid as region. progress:
    called with phase "read" while Gmsh works; may cancel."""
    if not path.is_file():
        raise IoError(f"{path}: no such file")
    if not 0 <= edge_length < float("inf"):
        raise InvalidInput(
            f"{path}: the edge length must be positive, or 0 for one from the size of the model; not {edge_length}",
            "invalid_option",
        )
    suffix = Path(plain_name(path)).suffix
    grid, fault = _meshed(path, suffix, edge_length, 0, progress)
    if fault is None:
        assert grid is not None
        return grid
    for number, way in enumerate(WAYS[1:], 1):
        try:
            other, again = _meshed(path, suffix, edge_length, number, progress)
        except Error as error:
            if isinstance(error, Cancelled):
                raise
            continue
        if other is not None and again is None:
            other.notes.append(f"Gmsh's first mesh could not be used ({fault}); made again: {way.name}")
            return other
    if grid is None:
        raise IoError(f"{path}: {fault}; {len(WAYS)} ways to mesh it were tried", "not_meshed")
    grid.notes.append(f"Gmsh was asked in {len(WAYS)} ways; none gave triangles that can be used ({fault})")
    return grid


def _meshed(
    path: Path, suffix: str, edge_length: float, way: int, progress: Progress | None
) -> tuple[Grid | None, str | None]:
    """The mesh, None where Gmsh gave none for the model it could read, and what is wrong with it. way: number in
    WAYS."""
    with scratch_for(path) as folder:
        job = {
            "model": str(_plain(path, suffix, folder)),
            "format": _FORMATS[suffix],
            "edge_length": edge_length,
            "way": way,
        }
        code = run_worker(_WORKER, path, job | {"folder": str(folder)}, folder, progress)
        try:
            answer = json.loads((folder / "answer.json").read_bytes()) if code == 0 else None
        except (OSError, ValueError):
            answer = None
        if answer is None:
            raise IoError(f"{path}: {ending(code, (folder / 'printed').read_text(errors='replace'))}", "reader_stopped")
        if answer.get("error") == "not_meshed":
            return None, answer["message"]
        if "error" in answer:
            kind = InvalidInput if answer["error"] in ("no_gmsh", "no_faces", "invalid_option") else IoError
            raise kind(f"{path}: {answer['message']}", answer["error"])
        with np.load(folder / "grid.npz") as arrays:
            cells = {kind: arrays[kind] for kind in ("triangle", "line", "tetra") if kind in arrays}
            creases = np.ones(len(cells["line"]), bool) if "line" in cells else None
            grid = Grid(arrays["points"], cells, arrays["faces"], arrays.get("regions"), creases, notes=answer["notes"])
    return grid, _fault(grid)


def _fault(grid: Grid) -> str | None:
    """Of triangles alone: what makes them no surface. Its rim may be open."""
    if "tetra" in grid.cells or "triangle" not in grid.cells:
        return None
    used, triangles = np.unique(grid.cells["triangle"], return_inverse=True)
    surface = _core.TriangleMesh(grid.points[used], triangles.reshape(-1, 3).astype(np.int32))
    defect = next((found for found in _core.find_defects(surface, closed=False) if found.kind in _OF_MESHING), None)
    return defect.message.partition("; ")[0] if defect else None


def _plain(path: Path, suffix: str, folder: Path) -> Path:
    """A file that is not packed, without numbers that are none."""
    content = read_bytes(path)
    found = _NO_NUMBER.search(content)
    if found:
        raise IoError(
            f"{path}, line {content.count(10, 0, found.start(1)) + 1}: a coordinate is {found[1].decode()}; export it"
            " again"
        )
    if not path.name.lower().endswith(".gz"):
        return path.absolute()
    (folder / f"input{suffix}").write_bytes(content)
    return folder / f"input{suffix}"
