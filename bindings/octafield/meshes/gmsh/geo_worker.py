"""The part of geo.py that runs in a process of its own: Gmsh on a script of its own language.

A program (see files/isolated.py), not a module of the package: it imports Gmsh and NumPy alone. Its one argument is a
JSON object: model (path), edge_length (0: as the file says) and folder. There it leaves answer.json ({}, or {"error":
kind, "message": ...}) and curves.npz: points (P, 2), segments (S, 2) and surfaces (S,), how many surfaces the curve of
each is at.
"""

import json
import os
import resource
import sys
from pathlib import Path
from typing import Any

import numpy as np


class Refused(Exception):
    def __init__(self, kind: str, message: str):
        super().__init__(message)
        self.kind = kind


def main() -> None:
    job = json.loads(sys.argv[1])
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))  # a crash leaves no core file
    answer: dict[str, str] = {}
    try:
        np.savez(Path(job["folder"], "curves.npz"), **_curves(job["model"], job["edge_length"]))
    except Refused as error:
        answer = {"error": error.kind, "message": str(error)}
    except Exception as error:  # Gmsh raises plain exceptions
        answer = {"error": "unreadable", "message": f"Gmsh cannot read it ({' '.join(str(error).split())})"}
    Path(job["folder"], "answer.json").write_text(json.dumps(answer))
    os._exit(0)  # libraries that end may crash too


def _curves(model: str, edge_length: float) -> dict[str, Any]:
    try:
        import gmsh
    except (ImportError, OSError) as error:
        raise Refused(
            "no_gmsh", f".geo files are read by Gmsh, which is not here ({error}); pip install 'octafield[cad]'"
        ) from error
    gmsh.initialize(["octafield"], readConfigFiles=False, interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("General.NumThreads", 1)
    gmsh.open(model)
    if edge_length > 0:
        gmsh.option.setNumber("Mesh.MeshSizeMin", edge_length)
        gmsh.option.setNumber("Mesh.MeshSizeMax", edge_length)
    gmsh.model.mesh.generate(1)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    points = np.asarray(coordinates).reshape(-1, 3)
    if len(points) and np.ptp(points[:, 2]) > 1e-9 * np.ptp(points, axis=0).max():
        raise Refused("not_plane", "its curves do not lie in a plane z = const; give a plane model")
    row = np.zeros(int(max(tags, default=0)) + 1, np.int64)
    row[np.asarray(tags, np.int64)] = np.arange(len(tags))
    segments, surfaces = [np.zeros((0, 2), np.int64)], [np.zeros(0, np.int64)]
    for _, curve in gmsh.model.getEntities(1):
        for nodes in gmsh.model.mesh.getElements(1, curve)[2]:
            pairs = row[np.asarray(nodes, np.int64)].reshape(-1, 2)
            segments.append(pairs)
            surfaces.append(np.full(len(pairs), len(gmsh.model.getAdjacencies(1, curve)[0])))
    return {"points": points[:, :2], "segments": np.concatenate(segments), "surfaces": np.concatenate(surfaces)}


if __name__ == "__main__":
    main()
