"""CAD models as triangles, by Gmsh where it is installed: the model's curves are the feature edges."""

import contextlib
import os
import re
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from .errors import InvalidInput, IoError
from .grids import Grid
from .output import scratch_folder

CAD_SUFFIXES = (".step", ".stp", ".brep", ".iges", ".igs")
_PARTS = 30  # edges along the diagonal of the bounding box, where no length is asked for
_NO_NUMBER = re.compile(rb"(?i)[(,\s]\s*([-+]?(?:nan|inf|infinity))\s*[,)\s]")  # on which Open CASCADE does not end
_GMSH_TRIANGLE, _GMSH_LINE = 2, 1


def read_cad(path: Path, suffix: str, edge_length: float) -> Grid:
    """Triangles with their CAD face and lines along the curves between faces. The boundary of solids alone is meshed where there are any."""
    try:
        import gmsh
    except (ImportError, OSError) as error:
        raise InvalidInput(
            f"{path}: CAD models are read by Gmsh, which is not here ({error}); pip install 'octafield[cad]'", "no_gmsh"
        ) from error
    if not path.is_file():
        raise IoError(f"{path}: no such file")
    try:
        with _model(gmsh), _plain(path, suffix) as plain:
            _import(gmsh, path, plain)
            gmsh.model.occ.synchronize()
            if not gmsh.model.getEntities(3) and len(gmsh.model.getEntities(2)) > 1:  # IGES holds loose faces: with curves of their own they would not fit
                with _printed([]):
                    gmsh.model.occ.healShapes(tolerance=1e-8, fixDegenerated=False, fixSmallEdges=False, fixSmallFaces=False, sewFaces=True, makeSolids=True)
                gmsh.model.occ.synchronize()
            return _meshed(gmsh, path, edge_length)
    except (InvalidInput, IoError):
        raise
    except Exception as error:  # Gmsh raises plain exceptions
        raise IoError(f"{path}: Gmsh cannot read or mesh it ({' '.join(str(error).split())})") from error


def _import(gmsh, path: Path, plain: Path) -> None:
    """Open CASCADE, inside Gmsh, prints what it finds wrong and goes on with what is left, which may not end."""
    found = _NO_NUMBER.search(content := plain.read_bytes())
    if found:
        raise IoError(f"{path}, line {content.count(10, 0, found.start(1)) + 1}: a coordinate is {found[1].decode()}; export it again")
    said: list[str] = []
    try:
        with _printed(said):
            gmsh.model.occ.importShapes(str(plain))
    except Exception as error:
        raise IoError(f"{path}: Gmsh cannot read it ({_first_defect(said) or ' '.join(str(error).split())}); export it again") from error
    if defect := _first_defect(said):
        raise IoError(f"{path}: damaged ({defect}); export it again")


def _first_defect(said: list[str]) -> str:
    found = re.search(r"\*{4} ERR \w+ : (.*?)\s*\*{4}", "".join(said))
    return " ".join(found[1].split()) if found else ""


@contextlib.contextmanager
def _printed(said: list[str]) -> Iterator[None]:
    """Collects what libraries print to the process's output, which belongs to the command."""
    sys.stdout.flush()
    try:
        kept = os.dup(1)
    except OSError:  # there is no output
        yield
        return
    with tempfile.TemporaryFile() as file:
        os.dup2(file.fileno(), 1)
        try:
            yield
        finally:
            os.dup2(kept, 1)
            os.close(kept)
            file.seek(0)
            said.append(file.read().decode("utf-8", "replace"))


@contextlib.contextmanager
def _model(gmsh) -> Iterator[None]:
    """A model of its own. Where the calling program has initialised Gmsh already, its options and current model are put back."""
    ours = not gmsh.isInitialized()
    if ours:
        gmsh.initialize(["octafield"], readConfigFiles=False, interruptible=False)
    numbers = ("General.Terminal", "Mesh.MeshSizeMin", "Mesh.MeshSizeMax", "General.NumThreads")
    before = {name: gmsh.option.getNumber(name) for name in numbers}
    current = None if ours else gmsh.model.getCurrent()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("General.NumThreads", 1)
    gmsh.model.add("octafield input")
    try:
        yield
    finally:
        gmsh.model.remove()
        for name, value in before.items():
            gmsh.option.setNumber(name, value)
        if ours:
            gmsh.finalize()
        elif current:
            gmsh.model.setCurrent(current)


@contextlib.contextmanager
def _plain(path: Path, suffix: str) -> Iterator[Path]:
    if not path.name.lower().endswith(".gz"):
        yield path
        return
    from .formats.files import read_bytes

    with scratch_folder() as folder:
        (folder / f"input{suffix}").write_bytes(read_bytes(path))
        yield folder / f"input{suffix}"


def _meshed(gmsh, path: Path, edge_length: float) -> Grid:
    solids = gmsh.model.getEntities(3)
    faces = gmsh.model.getBoundary(solids, combined=True, oriented=False) if solids else gmsh.model.getEntities(2)
    if not faces:
        raise InvalidInput(f"{path}: the model has no faces")
    box = np.array(gmsh.model.getBoundingBox(-1, -1)).reshape(2, 3)
    size = edge_length if edge_length > 0 else float(np.linalg.norm(box[1] - box[0])) / _PARTS
    gmsh.option.setNumber("Mesh.MeshSizeMin", size)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.model.mesh.generate(2)
    for _, solid in solids:
        gmsh.model.mesh.setOutwardOrientation(solid)
    tags, points, _ = gmsh.model.mesh.getNodes()
    place = np.zeros(int(tags.max()) + 1, np.int64)
    place[tags] = np.arange(len(tags))
    curves = gmsh.model.getBoundary(faces, combined=False, oriented=False)
    triangles, of_face = _elements(gmsh, [tag for _, tag in faces], 2, _GMSH_TRIANGLE)
    lines, _ = _elements(gmsh, sorted({abs(tag) for _, tag in curves}), 1, _GMSH_LINE)
    cells = {"triangle": place[triangles]} | ({"line": place[lines]} if len(lines) else {})
    return Grid(points.reshape(-1, 3), cells, of_face, None, np.ones(len(lines), bool) if len(lines) else None)


def _elements(gmsh, entities: list[int], dimension: int, kind: int) -> tuple[np.ndarray, np.ndarray]:
    """(k, dimension + 1) node tags of the elements on the entities, and (k,) the entity of each."""
    nodes = [gmsh.model.mesh.getElementsByType(kind, tag)[1].reshape(-1, dimension + 1).astype(np.int64) for tag in entities]
    ids = [np.full(len(part), tag) for part, tag in zip(nodes, entities, strict=True)]
    return (np.concatenate(nodes), np.concatenate(ids)) if nodes else (np.empty((0, dimension + 1), np.int64), np.empty(0, np.int64))
