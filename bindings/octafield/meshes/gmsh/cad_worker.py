"""The part of cad.py that runs in a process of its own: Gmsh and Open CASCADE, which damaged models can crash or hang.

A program (see files/isolated.py), not a module of the package: it imports Gmsh and NumPy alone, which halves its start.
Its one argument is a JSON object: model (path), format (Gmsh's name of it), edge_length (0: from the size), way (number
in WAYS) and folder. There it leaves answer.json ({"notes": [...]}, or {"error": kind, "message": ...}) and grid.npz
with the arrays of a Grid; what Open CASCADE prints goes to the standard output, a file that it also reads.
"""

import json
import os
import re
import resource
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]
Entity = tuple[int, int]  # dimension and tag

PARTS = 30  # edges along the diagonal of the bounding box, where no length is asked for
_CLOSE = 1e-6  # diagonals: what lies nearer is the same point of two solids or faces
_ROUND = 36  # edges in a turn: a cylinder loses 0.5 % of its volume to its triangles
_TOLD = 0.01  # of the volume, more than which is noted
_MOST = 5e7  # triangles or tets, as of remeshing
_LINE, _TRIANGLE, _TET = 1, 2, 4  # Gmsh's numbers of elements


@dataclass(frozen=True)
class Way:
    """One way to mesh a model: Gmsh's options, whether small edges and faces are healed away first, factor of the edge
    length, edges in a full turn of a surface that bends (0: of one length everywhere), and the least edge length they
    may have for it, as a share."""

    name: str
    options: dict[str, float] = field(default_factory=dict)
    heal: bool = False
    size: float = 1.0
    round: float = _ROUND
    least: float = 0.1


# The first is taken; the others where its triangles cannot be used (cad.py).
WAYS = (
    Way("Gmsh's default"),
    Way("Delaunay triangulation", {"Mesh.Algorithm": 5}),
    Way("edges of one length", round=0, least=1.0),
    Way("its MeshAdapt algorithm", {"Mesh.Algorithm": 1}, round=0, least=1.0),
    Way("small edges and faces of the model healed", heal=True),
    Way("edges half as long, adapted to curvature", {"Mesh.Algorithm": 5}, size=0.5, round=16, least=0.2),
)


class Refused(Exception):
    """A model that cannot be used. kind: of the error."""

    def __init__(self, kind: str, message: str):
        super().__init__(message)
        self.kind = kind


@dataclass
class Model:
    """What is current in Gmsh. region: of each solid. notes: what was found and changed."""

    gmsh: Any
    diagonal: float
    region: dict[int, int]
    notes: list[str] = field(default_factory=list)


def main() -> None:
    job = json.loads(sys.argv[1])
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))  # a crash leaves no core file
    try:
        answer = _answer(job)
    except Refused as error:
        answer = {"error": error.kind, "message": str(error)}
    except Exception as error:  # Gmsh raises plain exceptions
        answer = {
            "error": "unreadable",
            "message": f"Gmsh cannot read or mesh it ({' '.join(str(error).split()) or type(error).__name__})",
        }
    Path(job["folder"], "answer.json").write_text(json.dumps(answer))
    os._exit(0)  # libraries that end may crash too


def _answer(job: dict[str, Any]) -> dict[str, Any]:
    try:
        import gmsh
    except (ImportError, OSError) as error:
        raise Refused(
            "no_gmsh", f"CAD models are read by Gmsh, which is not here ({error}); pip install 'octafield[cad]'"
        ) from error
    gmsh.initialize(["octafield"], readConfigFiles=False, interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("General.NumThreads", 1)
    _import(gmsh, job["model"], job["format"])
    model = _with_solids(gmsh)
    way = WAYS[job.get("way", 0)]
    if way.heal:
        _heal(model)
    for name, value in way.options.items():
        gmsh.option.setNumber(name, value)
    try:
        arrays = _meshed(model, way.size * (job["edge_length"] or model.diagonal / PARTS), way)
    except Refused:
        raise
    except Exception as error:
        raise Refused(
            "not_meshed",
            f"Gmsh cannot mesh it ({' '.join(str(error).split())}); choose another edge length (--edge-length), or"
            " export it again",
        ) from error
    np.savez(Path(job["folder"], "grid.npz"), **arrays)
    return {"notes": model.notes}


def _import(gmsh: Any, path: str, kind: str) -> None:
    """Open CASCADE prints what it finds wrong and goes on with what is left, which may not end."""
    try:
        gmsh.model.occ.importShapes(path, highestDimOnly=False, format=kind)
    except Exception as error:
        raise Refused(
            "unreadable", f"Gmsh cannot read it ({_first_defect() or ' '.join(str(error).split())}); export it again"
        ) from error
    if defect := _first_defect():
        raise Refused("unreadable", f"damaged ({defect}); export it again")
    gmsh.model.occ.synchronize()


def _first_defect() -> str:
    said = os.pread(1, os.fstat(1).st_size, 0).decode("utf-8", "replace")
    found = re.search(r"\*{4} ERR \w+ : (.*?)\s*\*{4}", said)
    return " ".join(found[1].split()) if found else ""


def _with_solids(gmsh: Any) -> Model:
    """With the solids of the file, or those that its faces enclose; solids that touch share faces, curves and points
    then."""
    left_out = _drop_loose(gmsh)
    solids = gmsh.model.getEntities(3)
    if not solids and not gmsh.model.getEntities(2):
        raise Refused("no_faces", "the model has no faces; export its solids or surfaces")
    box = np.array(gmsh.model.getBoundingBox(-1, -1)).reshape(2, 3)
    model = Model(
        gmsh, float(np.linalg.norm(box[1] - box[0])), {tag: number for number, (_, tag) in enumerate(solids, 1)}
    )
    model.notes += [f"faces that bound no solid were left out: {left_out}"] * (left_out > 0)
    gmsh.option.setNumber("Geometry.ToleranceBoolean", _CLOSE * model.diagonal)
    if not solids:
        _enclose(model, box)
    elif len(solids) > 1:
        _make_conformal(model)
    return model


def _drop_loose(gmsh: Any) -> int:
    """Removes what bounds nothing: points, curves and, beside solids, faces. How many faces."""
    faces = 0
    for dimension in (2, 1, 0) if gmsh.model.getEntities(3) else (1, 0):
        loose = [
            entity for entity in gmsh.model.getEntities(dimension) if not len(gmsh.model.getAdjacencies(*entity)[0])
        ]
        faces += len(loose) * (dimension == 2)
        gmsh.model.occ.remove(loose, recursive=True)
        gmsh.model.occ.synchronize()
    return faces


def _make_conformal(model: Model) -> None:
    gmsh = model.gmsh
    boxes = np.array([gmsh.model.getBoundingBox(3, tag) for tag in model.region])
    low, high = boxes[:, :3] - _CLOSE * model.diagonal, boxes[:, 3:] + _CLOSE * model.diagonal
    meets = np.array(
        [int((low <= high[i]).all(axis=1)[(low[i] <= high).all(axis=1)].sum()) > 1 for i in range(len(boxes))]
    )
    near = [(3, tag) for tag, close in zip(model.region, meets, strict=True) if close]
    if not near:
        return
    numbers, count = [model.region.pop(tag) for _, tag in near], len(model.region) + len(near)
    try:
        _, images = gmsh.model.occ.fragment(near, [])
    except Exception as error:
        reason = " ".join(str(error).split())
        raise Refused(
            "not_conformal",
            f"its solids cannot be made to share their faces ({reason}); export them one by one, or fused",
        ) from error
    gmsh.model.occ.synchronize()
    owners: dict[int, list[int]] = {}
    for number, image in zip(numbers, images, strict=True):
        for _, tag in image:
            owners.setdefault(tag, []).append(number)
    alone = {number: image[0][1] for number, image in zip(numbers, images, strict=True) if len(image) == 1}
    shared: dict[tuple[int, ...], int] = {}
    for tag, of in owners.items():
        whole = next((number for number in of if alone.get(number) == tag), None)  # a solid that lies inside others
        if whole is None and len(of) > 1:
            whole = shared.setdefault(tuple(of), count + len(shared) + 1)
        model.region[tag] = of[0] if whole is None else whole
    if any(len(of) > 1 for of in owners.values()):
        new = f", here {', '.join(map(str, shared.values()))}" if shared else ""
        model.notes.append(
            "solids overlap: one that lies inside another is cut out of it, any other overlap is a region of its"
            f" own{new}"
        )


def _enclose(model: Model, box: Array) -> None:
    """Loose faces, as IGES holds them, are sewn and made the boundary of what they enclose; where that is nothing, they
    stay faces."""
    gmsh = model.gmsh
    gmsh.model.occ.healShapes(
        tolerance=_CLOSE * model.diagonal,
        fixDegenerated=False,
        fixSmallEdges=False,
        fixSmallFaces=False,
        sewFaces=True,
        makeSolids=False,
    )
    gmsh.model.occ.synchronize()
    shells = _shells(gmsh)
    one = (
        len(shells) == 1
        and not gmsh.model.getBoundary(gmsh.model.getEntities(2), combined=True)
        and not _has_twins(model)
    )
    solids = [
        gmsh.model.occ.addVolume([gmsh.model.occ.addSurfaceLoop(shell)]) for shell in shells
    ]  # repairs poles, which sewing loses
    gmsh.model.occ.synchronize()
    faces = gmsh.model.getBoundary([(3, tag) for tag in solids], combined=False, oriented=False)
    if one:
        model.region = {solids[0]: 1}
    else:
        gmsh.model.occ.remove([(3, tag) for tag in solids])
    gmsh.model.occ.remove(sorted(set(gmsh.model.getEntities(2)) - set(faces)), recursive=True)
    gmsh.model.occ.synchronize()
    if not one:
        _fill(model, box, faces)


def _shells(gmsh: Any) -> list[list[int]]:
    """Faces that are joined by curves."""
    left, shells = {tag for _, tag in gmsh.model.getEntities(2)}, []
    while left:
        shell = [min(left)]
        left.remove(shell[0])
        for face in shell:  # grows
            for curve in gmsh.model.getAdjacencies(2, face)[1]:
                more = left.intersection(gmsh.model.getAdjacencies(1, curve)[0].tolist())
                left -= more
                shell += sorted(more)
        shells.append(shell)
    return shells


def _fill(model: Model, box: Array, faces: list[Entity]) -> None:
    """Splits a larger box at the faces: of its pieces, those behind an odd number of faces are solids."""
    gmsh = model.gmsh
    around = gmsh.model.occ.addBox(*(box[0] - model.diagonal), *(box[1] - box[0] + 2 * model.diagonal))
    _, images = gmsh.model.occ.fragment([(3, around)], faces)
    gmsh.model.occ.synchronize()
    kept = {tag for image in images[1:] for dimension, tag in image if dimension == 2}
    depth = _depths(gmsh, kept)
    solids = sorted(tag for tag, crossed in depth.items() if crossed % 2)
    useful = {tag for _, tag in gmsh.model.getBoundary([(3, tag) for tag in solids], combined=False, oriented=False)}
    if solids and kept - useful:
        model.notes.append(
            f"{len(kept - useful)} of the {len(kept)} faces enclose nothing, so that all stay a surface; where solids"
            " are meant, export them as solids"
        )
        solids = []
    elif any(crossed and crossed % 2 == 0 for crossed in depth.values()):
        model.notes.append(
            "the file holds faces and no solids: what lies behind an even number of them is taken as empty"
        )
    model.region = {tag: number for number, tag in enumerate(solids, 1)}
    gmsh.model.occ.remove([(3, tag) for tag in depth if tag not in solids])
    gmsh.model.occ.remove([entity for entity in gmsh.model.getEntities(2) if entity[1] not in kept], recursive=True)
    gmsh.model.occ.synchronize()


def _has_twins(model: Model) -> bool:
    """Whether two curves between the same points run close together: shells that touch there, of which sewing joined
    the wrong faces."""
    middles: dict[tuple[int, ...], list[Array]] = {}
    for _, curve in model.gmsh.model.getEntities(1):
        middle = np.array(model.gmsh.model.occ.getCenterOfMass(1, curve))
        others = middles.setdefault(tuple(sorted(model.gmsh.model.getAdjacencies(1, curve)[1].tolist())), [])
        if any(np.linalg.norm(middle - other) < _CLOSE * model.diagonal for other in others):
            return True
        others.append(middle)
    return False


def _depths(gmsh: Any, faces: set[int]) -> dict[int, int]:
    """How many faces lie between each solid and the outermost, which has others around it."""
    beside = {tag: [int(face) for face in gmsh.model.getAdjacencies(3, tag)[1]] for _, tag in gmsh.model.getEntities(3)}
    waiting = [tag for tag, around in beside.items() if not faces.issuperset(around)]
    depth = dict.fromkeys(waiting, 0)
    for tag in waiting:  # grows
        for face in faces.intersection(beside[tag]):
            for other in map(int, gmsh.model.getAdjacencies(2, face)[0]):
                if other not in depth:
                    depth[other] = depth[tag] + 1
                    waiting.append(other)
    return depth


def _heal(model: Model) -> None:
    """May number faces and solids anew; where the solids do not come through, the model stays as it was meshed
    before."""
    gmsh, count = model.gmsh, len(model.region)
    gmsh.model.occ.healShapes(
        tolerance=_CLOSE * model.diagonal,
        fixDegenerated=True,
        fixSmallEdges=True,
        fixSmallFaces=True,
        sewFaces=False,
        makeSolids=False,
    )
    gmsh.model.occ.synchronize()
    solids = sorted(tag for _, tag in gmsh.model.getEntities(3))
    if len(solids) != count:
        raise Refused("not_meshed", "healing the model loses solids")
    model.region = dict(zip(solids, (model.region[tag] for tag in sorted(model.region)), strict=True))


def _meshed(model: Model, size: float, way: Way = WAYS[0]) -> dict[str, Any]:
    """Triangles of the boundary of solids, where there are any, which follow what bends; where some touch, tets of one
    edge length."""
    gmsh, solids = model.gmsh, list(model.region)
    touching = _touching(gmsh, solids)
    _require_few(gmsh, 2, size, 3**0.5 / 4 * size**2)
    gmsh.option.setNumber("Mesh.MeshSizeMin", size * (1 if touching else way.least))
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", 0 if touching else way.round)
    gmsh.model.mesh.generate(2)
    if touching:
        model.notes.append(
            f"solids touch: Gmsh filled them with tets, {len(set(model.region.values()))} regions with their interfaces"
        )
    elif len(solids) > 1:
        model.notes.append(f"{len(solids)} solids that do not touch")
    bounding = gmsh.model.getBoundary([(3, tag) for tag in solids], combined=not touching, oriented=False)
    faces = sorted({tag for _, tag in bounding or gmsh.model.getEntities(2)})
    curves = sorted(
        {tag for _, tag in gmsh.model.getBoundary([(2, tag) for tag in faces], combined=False, oriented=False)}
    )
    if touching:
        _require_few(gmsh, 3, size, size**3 / 72**0.5)
        gmsh.model.mesh.generate(3)
    else:
        for tag in solids:
            gmsh.model.mesh.setOutwardOrientation(tag)
    cells = {"triangle": _elements(gmsh, faces, 2, _TRIANGLE), "line": _elements(gmsh, curves, 1, _LINE)}
    if touching:
        cells["tetra"] = _elements(gmsh, solids, 3, _TET)
    tags, points, _ = gmsh.model.mesh.getNodes()
    place = np.zeros(int(tags.max()) + 1, np.int64)
    place[tags] = np.arange(len(tags))
    arrays: dict[str, Any] = {kind: place[nodes] for kind, (nodes, _) in cells.items() if len(nodes)}
    arrays |= {"points": points.reshape(-1, 3), "faces": cells["triangle"][1]}
    if touching:
        arrays["regions"] = np.array([model.region[tag] for tag in cells["tetra"][1].tolist()])
    _note_volume(model, arrays)
    return arrays


def _note_volume(model: Model, arrays: dict[str, Any]) -> None:
    of_model = sum(abs(model.gmsh.model.occ.getMass(3, tag)) for tag in model.region)
    corners = arrays["points"][arrays.get("tetra", arrays["triangle"])]
    if "tetra" in arrays:
        corners = corners[:, 1:] - corners[:, :1]
    volume = abs(np.linalg.det(corners)).sum() / 6 if "tetra" in arrays else abs(np.linalg.det(corners).sum()) / 6
    if of_model > 0 and abs(volume / of_model - 1) > _TOLD:
        model.notes.append(
            f"the mesh of the model has {volume / of_model:.1%} of its volume; a shorter --edge-length follows it more"
            " closely"
        )


def _require_few(gmsh: Any, dimension: int, size: float, of_one: float) -> None:
    """of_one: area of a triangle or volume of a tet of that size."""
    expected = sum(abs(gmsh.model.occ.getMass(dimension, tag)) for _, tag in gmsh.model.getEntities(dimension)) / of_one
    if expected > _MOST:
        what = {2: "triangles", 3: "tets"}[dimension]
        raise Refused(
            "invalid_option",
            f"an edge length of {size:.3g} would give about {expected:.2g} {what}; choose a larger one (--edge-length)",
        )


def _touching(gmsh: Any, solids: list[int]) -> bool:
    """Whether two solids share a face, a curve or a point."""
    seen: set[Entity] = set()
    for solid in solids:
        own: set[Entity] = set()
        front: list[Entity] = [(3, solid)]
        while front:
            front = sorted(set(gmsh.model.getBoundary(front, combined=False, oriented=False)))
            own.update(front)
        if not seen.isdisjoint(own):
            return True
        seen |= own
    return False


def _elements(gmsh: Any, entities: list[int], dimension: int, kind: int) -> tuple[Array, Array]:
    """(k, dimension + 1) node tags of the elements on the entities, and (k,) the entity of each."""
    nodes = [
        gmsh.model.mesh.getElementsByType(kind, tag)[1].reshape(-1, dimension + 1).astype(np.int64) for tag in entities
    ]
    empty = next((tag for tag, part in zip(entities, nodes, strict=True) if dimension > 1 and not len(part)), None)
    if empty is not None:
        what = {2: "face", 3: "solid"}[dimension]
        raise Refused(
            "not_meshed",
            f"Gmsh cannot mesh {what} {empty} of the model; choose another edge length (--edge-length), or export it"
            " again",
        )
    ids = [np.full(len(part), tag) for part, tag in zip(nodes, entities, strict=True)]
    return (
        (np.concatenate(nodes), np.concatenate(ids))
        if nodes
        else (np.empty((0, dimension + 1), np.int64), np.empty(0, np.int64))
    )


if __name__ == "__main__":
    main()
