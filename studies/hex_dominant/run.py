"""One mesh in a process of its own: python -m studies.hex_dominant.run FILE FACTOR JSON. Writes a row, errors too."""

import json
import os
import sys
import tempfile
import time
import traceback
from pathlib import Path

import numpy as np
import octafield
import pyvista
from octafield.domain.meshing import prepare_mesh
from octafield.hexdom.files import write_hex_result

from . import checker

THREADS = 2
VTK_TYPES = {"tets": 10, "hexahedra": 12, "wedges": 13, "pyramids": 14}
SIZES = {"tets": 4, "hexahedra": 8, "wedges": 6, "pyramids": 5}


def curves_of(meshed, given, triangles, options) -> np.ndarray:
    """Feature edges of the file on the boundary; where it marks none, creases."""
    edges = np.asarray(meshed.tets.features.edges)
    if not len(edges):
        return checker.creases(given, triangles, options.feature_angle)
    edges = np.sort(np.asarray(meshed.tets.surface.vertex_map)[edges], axis=1)
    sides = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    keys = lambda pairs: pairs[:, 0].astype(np.int64) * len(given) + pairs[:, 1]  # noqa: E731
    return edges[np.isin(keys(edges), keys(sides))]


def mean_edge(points: np.ndarray, triangles: np.ndarray) -> float:
    pairs = np.unique(np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1), axis=0)
    return float(np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1).mean())


def cells_of_file(path: Path) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    grid = pyvista.read(path)
    parts = grid.cells_dict
    return np.asarray(grid.points, float), {
        kind: np.asarray(parts.get(number, np.zeros((0, SIZES[kind]))), np.int64) for kind, number in VTK_TYPES.items()
    }


def measure(path: Path, factor: float, length: float = 0.0, keep: Path | None = None) -> dict:
    """length: in place of the mean edge of the boundary. keep: folder for the mesh's files."""
    options = octafield.FieldOptions(threads=THREADS, streamlines=0)
    started = time.perf_counter()
    meshed = prepare_mesh(path, options)
    given, tets = np.asarray(meshed.tets.vertices), np.asarray(meshed.tets.tets)
    outside, _ = checker.face_map({"tets": tets.astype(np.int64)})
    surface = meshed.tets.surface.mesh  # with interfaces: shapes in a box are far finer than its sides
    edge = factor * (length or mean_edge(np.asarray(surface.vertices), np.asarray(surface.triangles)))
    row = {"file_tets": len(tets), "edge": edge}
    try:
        result = octafield.compute_hex_dominant(meshed, options, hex_options=octafield.HexMeshOptions(edge_length=edge))
    except octafield.Error as error:
        return row | failure(error) | {"seconds": time.perf_counter() - started}
    row |= {
        "seconds": time.perf_counter() - started,
        "cpu": sum(os.times()[:4]),  # TetGen has a process of its own
        "MB": result.record.peak_mb,  # the largest of its phases, each measured from its start
        "tets_used": result.counts.tets,
        "points": result.record.points,
    }
    lost = {name: getattr(result.counts.lost, name) for name in ("outside", "unusable", "degenerate", "poor")}
    steps = ("inconsistent", "turned_over", "lattice_hexahedra", "crossing", "recombined_hexahedra")
    row["steps"] = {name: int(getattr(result.counts, name)) for name in steps} | lost
    row["phases"] = {name: round(seconds, 2) for name, seconds in result.record.wall_seconds.items()}
    with tempfile.TemporaryDirectory() as folder:
        place = keep or Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        write_hex_result(result, place)
        points, cells = cells_of_file(place / "mesh.vtu")
    row |= checker.check(points, cells, given, tets, edge, curves_of(meshed, given, outside.triangles, options))
    told = result.record
    for name, value in (("hex_volume_share", told.hex_volume_share), ("volume_error", told.volume_error)):
        if abs(row[name] - value) > 1e-6:
            row["faults"] = f"{row['faults']}; the record says {name} {value:.6g}".strip("; ")
    # The checker looks at the outer boundary alone.
    if told.regions < 2 and abs(row["deviation"] - told.boundary_deviation.max) > 0.1 * row["deviation"] + 1e-6:
        row["faults"] = f"{row['faults']}; the record says deviation {told.boundary_deviation.max:.4g}".strip("; ")
    row["unproven"] = told.unproven
    row["regions"], row["region_volume_error"] = told.regions, told.region_volume_error
    return row


def failure(error: BaseException) -> dict:
    return {"error": f"{type(error).__name__}: {error}".splitlines()[0][:400]}


def main() -> None:
    path, factor, out = Path(sys.argv[1]), float(sys.argv[2]), Path(sys.argv[3])
    length = float(sys.argv[4]) if len(sys.argv) > 4 else 0.0
    keep = Path(sys.argv[5]) if len(sys.argv) > 5 else None
    try:
        row = measure(path, factor, length, keep)
    except Exception as error:  # a row of its own: a defect
        traceback.print_exc()
        row = failure(error) | {"faults": "an error without a type of octafield's"}
    out.write_text(json.dumps(row))


if __name__ == "__main__":
    main()
