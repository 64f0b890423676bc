"""A frame field on every tet mesh of a folder: what is held, how well, what the field is like, and the time it takes.

    python studies/hexme_fields.py shared/data/hexme -o out/hexme [--split] [--skip i16c] [--only s01,i1]

DIR gets fields.csv and fields.md, one line per file. The alignment error is found anew from the mesh, without the
program's own sectors: at vertices away from features the angle between the area-weighted normal of their triangles and
the nearest axis of the frame, on feature curves that between their tangent and the nearest axis.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np
from study_output import markdown_table, write_csv

import octafield
from octafield.meshing import prepare_mesh
from octafield.options import FieldOptions
from octafield.phases import PHASES
from octafield.pipeline import prepare, run
from octafield.results import write_field_result

HEADER = [
    "file", "vertices", "tets", "regions", "interface", "energy", "singular", "complex", "error deg", "misfit deg",
    "released", "tangent only", "locking tets", "locking edges", *(f"{phase} s" for phase in PHASES), "CPU s", "MB",
]  # fmt: skip


def to_nearest_axis(frames: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """Degrees between directions and the nearest axes of the frames."""
    axes = np.asarray(octafield.rotation_matrices(frames))
    unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    sines = np.linalg.norm(np.cross(axes.transpose(0, 2, 1), unit[:, None, :]), axis=2)
    return np.degrees(np.arcsin(np.minimum(sines.min(axis=1), 1)))


def alignment_error(meshed, result) -> float:
    """Largest angle at vertices held to a normal or to the tangent of a curve."""
    mesh, features = meshed.boundary.mesh, meshed.boundary_features
    points, triangles = np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    edges, corners = np.asarray(features.edges), np.asarray(features.corners)
    p = points[triangles]
    area = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    normals = np.zeros_like(points)
    for k in range(3):
        np.add.at(normals, triangles[:, k], area)
    tangents, degree = np.zeros_like(points), np.bincount(edges.ravel(), minlength=len(points))
    first = np.zeros(len(points), bool)
    for a, b in np.concatenate([edges, edges[:, ::-1]]):  # along the first edge at a, against the second
        unit = (points[b] - points[a]) / np.linalg.norm(points[b] - points[a])
        tangents[a] += -unit if first[a] else unit
        first[a] = True
    on_curve = degree == 2
    on_curve[corners] = False
    frames = np.asarray(result.frames)[np.asarray(meshed.boundary.vertex_map)]
    smooth = degree == 0
    errors = [to_nearest_axis(frames[smooth], normals[smooth]), to_nearest_axis(frames[on_curve], tangents[on_curve])]
    return float(np.concatenate(errors).max(initial=0))


def row_of(path: Path, options: FieldOptions) -> list:
    meshed = prepare_mesh(path, options)
    result = run(prepare(meshed), options)
    with tempfile.TemporaryDirectory() as folder:
        write_field_result(result, Path(folder))
    r = result.record
    held, vertex_map = result.constraints, np.asarray(meshed.boundary.vertex_map)
    on_features = vertex_map[np.unique(np.asarray(meshed.boundary_features.edges))]
    return [
        path.name.split(".")[0], r["vertices"], r["tets"], r["regions"], r["interface_triangles"], r["energy"],
        r["singular_edges"], r["complex_edges"], alignment_error(meshed, result), r["alignment_deg"]["max"],
        r["released_corners"], int((np.asarray(held.kind)[on_features] == 1).sum()), r["locking"]["tets"],
        r["locking"]["edges"], *(r["cpu_seconds"][phase] for phase in PHASES),
        sum(r["cpu_seconds"].values()), r["peak_mb"],
    ]  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--split", action="store_true", help="split locking tets first")
    parser.add_argument("--skip", default="", help="beginnings of file names, with commas")
    parser.add_argument("--only", default="", help="beginnings of file names, with commas")
    parser.add_argument("--feature-tolerance", type=float, default=np.degrees(FieldOptions().feature_tolerance))
    arguments = parser.parse_args()
    skip, only = (tuple(filter(None, text.split(","))) for text in (arguments.skip, arguments.only))
    options = FieldOptions(split=arguments.split, feature_tolerance=np.radians(arguments.feature_tolerance))
    arguments.output.mkdir(parents=True, exist_ok=True)
    rows = []
    for path in sorted(arguments.folder.glob("*.vtk*")):
        if (skip and path.name.startswith(skip)) or (only and not path.name.startswith(only)):
            continue
        try:
            rows.append(row_of(path, options))
        except octafield.Error as error:
            rows.append([path.name.split(".")[0], f"{type(error).__name__}: {error}"])
        print(*(f"{x:.5g}" if isinstance(x, float) else x for x in rows[-1]), flush=True)
    write_csv(arguments.output / "fields.csv", HEADER, rows)
    shown = [[f"{x:.4g}" if isinstance(x, float) else x for x in row] for row in rows]
    (arguments.output / "fields.md").write_text(markdown_table(HEADER, shown))


if __name__ == "__main__":
    main()
