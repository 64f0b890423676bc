"""Whether a solver can use the meshes: a Poisson problem with a known solution on them and on tets.

-laplace u = f, u given on the boundary, u = sin(2 a) cos(3 b) exp(c) in coordinates x, y, z over a third of the
diagonal, solved with elements.py. Beside each mesh one of tets in the same surface, made by octafield (surface meshed
anew, TetGen) with the edge length that gives the same number of vertices within a few percent.
"""

import csv
import json
import os
from pathlib import Path

import numpy as np
import octafield
from octafield.domain.meshing import prepare_mesh
from study_output import markdown_table

from ..benchmarks.pages import commit, machine
from . import checker, elements
from .rows import run_one
from .run import cells_of_file

MODELS = {"s08u": (1.6, 1.13, 0.8), "s05u": (2.8, 2.0, 1.4), "i10c": (1.0, 0.71, 0.5)}
HEADER = [
    "file", "mesh", "edge", "vertices", "cells", "hex volume %", "L2 error", "order", "H1 error", "order", "patch test",
]  # fmt: skip
CLOSE, TRIES = 0.03, 5  # of vertex counts


class Solution:
    """At points in the mesh's unit."""

    def __init__(self, centre: np.ndarray, unit: float):
        self.centre, self.unit = centre, unit

    def __call__(self, points: np.ndarray) -> np.ndarray:
        a, b, c = np.moveaxis((points - self.centre) / self.unit, -1, 0)
        return np.sin(2 * a) * np.cos(3 * b) * np.exp(c)

    def gradient(self, points: np.ndarray) -> np.ndarray:
        a, b, c = np.moveaxis((points - self.centre) / self.unit, -1, 0)
        e = np.exp(c) / self.unit
        slopes = (
            2 * np.cos(2 * a) * np.cos(3 * b) * e,
            -3 * np.sin(2 * a) * np.sin(3 * b) * e,
            np.sin(2 * a) * np.cos(3 * b) * e,
        )
        return np.stack(slopes, axis=-1)

    def source(self, points: np.ndarray) -> np.ndarray:
        """Minus the Laplacian: 4 + 9 - 1 times the solution."""
        return 12 * self(points) / self.unit**2


def boundary_of(cells: dict[str, np.ndarray]) -> np.ndarray:
    surface, misfits = checker.face_map(cells)
    if misfits:
        raise ValueError(f"{misfits} faces do not fit")
    return np.union1d(surface.triangles, surface.quads)


def compact(points: np.ndarray, cells: dict[str, np.ndarray]) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Without vertices that no cell has."""
    used, place = np.unique(np.concatenate([rows.ravel() for rows in cells.values()]), return_inverse=True)
    ends = np.cumsum([rows.size for rows in cells.values()])[:-1]
    numbered = np.split(place.reshape(-1), ends)
    return points[used], {
        kind: part.reshape(rows.shape) for (kind, rows), part in zip(cells.items(), numbered, strict=True)
    }


def patch_error(points, cells, boundary) -> float:
    """Largest error at vertices, over the range, of a solution that is linear."""
    slope = np.array([1.0, -2.0, 0.5])
    linear = lambda p: p @ slope  # noqa: E731
    exact = linear(points)
    found = elements.solve(points, cells, boundary, linear, lambda p: np.zeros(p.shape[:-1]))
    return float(np.abs(found - exact).max() / np.ptp(exact))


def figures(points, cells, solution: Solution) -> dict[str, float]:
    points, cells = compact(points, cells)
    boundary = boundary_of(cells)
    values = elements.solve(points, cells, boundary, solution, solution.source)
    l2, h1 = elements.errors(points, cells, values, solution, solution.gradient)
    volumes = {kind: v.sum() for kind, v in checker.volumes_of(points, cells).items()}
    return {
        "vertices": len(points),
        "cells": sum(len(rows) for rows in cells.values()),
        "hex_share": float(volumes.get("hexahedra", 0.0) / sum(volumes.values())),
        "l2": l2,
        "h1": h1,
        "patch": patch_error(points, cells, boundary),
    }


def tets_with(surface: octafield.TriangleMesh, vertices: int, edge: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Points, tets and edge length of a mesh with about so many vertices; of the tries the nearest."""
    best = None
    for _ in range(TRIES):
        domain = prepare_mesh(surface, octafield.FieldOptions(edge_length=edge, threads=2)).tets
        count = len(domain.vertices)
        if best is None or abs(np.log(count / vertices)) < abs(np.log(len(best[0]) / vertices)):
            best = (np.asarray(domain.vertices), np.asarray(domain.tets, np.int64), edge)
        if abs(count / vertices - 1) < CLOSE:
            break
        edge *= (count / vertices) ** (1 / 3)
    return best


def work(data: Path, output: Path, limit: float, only: tuple[str, ...]) -> None:
    output.mkdir(parents=True, exist_ok=True)
    path = output / "poisson.jsonl"
    for name, factors in MODELS.items():
        if only and name not in only:
            continue
        file = data / "hexme" / f"{name}.vtk.gz"
        given = prepare_mesh(file, octafield.FieldOptions(threads=2)).tets
        corners = np.asarray(given.surface.mesh.vertices)
        unit = float(np.linalg.norm(np.ptp(corners, axis=0))) / 3
        solution = Solution((corners.min(axis=0) + corners.max(axis=0)) / 2, unit)
        for factor in factors:
            common = {"file": name, "load": round(os.getloadavg()[0], 1), "commit": commit()}
            folder = output / "meshes" / f"{name}_{factor:g}"
            row = run_one(file, factor, limit, keep=folder)
            if "error" in row:
                append(path, common | {"mesh": "hex-dominant", "error": row["error"]})
                continue
            found = figures(*cells_of_file(folder / "mesh.vtu"), solution)
            append(path, common | {"mesh": "hex-dominant", "edge": row["edge"]} | found)
            points, tets, edge = tets_with(given.surface.mesh, found["vertices"], 1.1 * row["edge"])
            append(path, common | {"mesh": "tets", "edge": edge} | figures(points, {"tets": tets}, solution))
            write_tables(output)


def append(path: Path, row: dict) -> None:
    with path.open("a") as file:
        file.write(json.dumps(row) + "\n")
    print(*(f"{x:.4g}" if isinstance(x, float) else x for x in row.values()), flush=True)


def write_tables(output: Path) -> None:
    rows = [json.loads(line) for line in (output / "poisson.jsonl").read_text().splitlines()]
    with (output / "poisson.csv").open("w", newline="") as file:
        out = csv.DictWriter(file, list(dict.fromkeys(k for row in rows for k in row)), lineterminator="\n")
        out.writeheader()
        out.writerows(rows)
    lines, before = [], {}
    for row in sorted(rows, key=lambda r: (list(MODELS).index(r["file"]), r["mesh"], r.get("vertices", 0))):
        if "error" in row:
            lines.append([row["file"], row["mesh"], *[""] * 8, row["error"]])
            continue
        last = before.get((row["file"], row["mesh"]))
        before[row["file"], row["mesh"]] = row
        lines.append(
            [row["file"], row["mesh"], f"{row['edge']:.3g}", f"{row['vertices']:,}", f"{row['cells']:,}",
             f"{100 * row['hex_share']:.1f}", f"{row['l2']:.2e}", order(last, row, "l2"), f"{row['h1']:.2e}",
             order(last, row, "h1"), f"{row['patch']:.0e}"]
        )  # fmt: skip
    (output / "poisson.md").write_text(markdown_table(HEADER, lines))
    (output / "poisson_when.md").write_text(
        f"{machine()}, commits {', '.join(dict.fromkeys(row['commit'] for row in rows))}.\n"
    )


def order(last: dict | None, row: dict, name: str) -> str:
    """Against the edge length that the number of vertices stands for."""
    if last is None:
        return ""
    return f"{3 * np.log(last[name] / row[name]) / np.log(row['vertices'] / last['vertices']):.2f}"
