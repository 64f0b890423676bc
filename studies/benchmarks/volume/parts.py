"""A frame field on every tet mesh of a folder: what is held, how well, what the field is like, and the time it takes.

    python -m studies.benchmarks.volume.parts FOLDER -o DIR [--representations all] [--split] [--skip i16c] [--only
    s01,i1]

DIR gets fields.csv and fields.md, one line per file, of the default recipe. The alignment error is found anew from the
mesh, without the program's own sectors: at vertices away from features the angle between the area-weighted normal of
their triangles and the nearest axis of the frame, on feature curves that between their tangent and the nearest axis.

With --representations (names with commas; "all": those that `octafield compare` takes) the recipe also ends in each of
them, and each runs alone from the linear start: representations.csv, representations.md (one line per file and
representation) and summary.md (one line per representation).
"""

import argparse
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import octafield
from octafield.domain.meshing import prepare_mesh
from octafield.fields.frame_field import prepare_field, run_field
from octafield.options import COMPARED, FieldOptions
from octafield.progress.phases import PHASES
from octafield.runs.run_folder import write_field_result
from study_output import markdown_table, write_csv

HEADER = [
    "file", "vertices", "tets", "regions", "interface", "energy", "singular", "complex", "error deg", "misfit deg",
    "released", "tangent only", "locking tets", "locking edges", *(f"{phase} s" for phase in PHASES), "CPU s", "MB",
]  # fmt: skip
REPRESENTATION_HEADER = [
    "file", "representation", "start", "energy", "objective", "singular edges", "complex edges",
    "non-meshable vertices", "from sh4 deg", "error deg", "iterations", "converged", "CPU s",
]  # fmt: skip
SUMMARY_HEADER = [
    "representation", "start", "energy over the default's", "singular edges", "complex edges",
    "non-meshable vertices", "mean angle to the default, degrees", "largest alignment error, degrees", "converged",
    "smoothing CPU s",
]  # fmt: skip
STARTS = ("linear start", "recipe")
SINGULARITY_FREE = 1e-9  # energies below it are rounding


def to_nearest_axis(frames: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """Degrees between directions and the nearest axes of the frames."""
    axes = np.asarray(octafield.frames.rotation_matrices(frames))
    unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    sines = np.linalg.norm(np.cross(axes.transpose(0, 2, 1), unit[:, None, :]), axis=2)
    return np.degrees(np.arcsin(np.minimum(sines.min(axis=1), 1)))


def alignment_error(meshed, result) -> float:
    """Largest angle at vertices held to a normal or to the tangent of a curve."""
    mesh, features = meshed.tets.surface.mesh, meshed.tets.features
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
    frames = np.asarray(result.frames)[np.asarray(meshed.tets.surface.vertex_map)]
    smooth = degree == 0
    errors = [to_nearest_axis(frames[smooth], normals[smooth]), to_nearest_axis(frames[on_curve], tangents[on_curve])]
    return float(np.concatenate(errors).max(initial=0))


def row_of(path: Path, meshed, result) -> list:
    """Of the default recipe; writes its files as the command line does."""
    with tempfile.TemporaryDirectory() as folder:
        write_field_result(result, Path(folder))
    r = result.record
    held, vertex_map = result.constraints, np.asarray(meshed.tets.surface.vertex_map)
    on_features = vertex_map[np.unique(np.asarray(meshed.tets.features.edges))]
    return [
        name_of(path), r.vertices, r.tets, r.regions, r.interface_triangles, r.energy,
        r.singular_edges, r.complex_edges, alignment_error(meshed, result), r.alignment_deg.max,
        r.released_corners, int((np.asarray(held.kind)[on_features] == 1).sum()), r.locking.tets,
        r.locking.edges, *(r.cpu_seconds[phase] for phase in PHASES),
        sum(r.cpu_seconds.values()), r.peak_mb,
    ]  # fmt: skip


def representation_row(path: Path, meshed, result, reference) -> list:
    """`reference`: the default recipe's result, to which the mean angle between frames is measured."""
    r = result.record
    return [
        name_of(path), r.representation, STARTS[r.options["rounds"] > 0], r.energy, r.objective,
        r.singular_edges, r.complex_edges, r.non_meshable_vertices,
        np.degrees(np.mean(octafield.frames.distance(result.frames, reference.frames))),
        alignment_error(meshed, result),
        r.iterations, r.converged, r.cpu_seconds.smooth,
    ]  # fmt: skip


def summary_rows(rows: list[list]) -> list[tuple]:
    """Sums and means over the files of one representation and start; energies by their ratio to the default's."""
    records = [dict(zip(REPRESENTATION_HEADER, row, strict=True)) for row in rows]
    default = {r["file"]: r["energy"] for r in records if (r["representation"], r["start"]) == ("sh4", STARTS[True])}
    result = []
    for kind in dict.fromkeys((r["representation"], r["start"]) for r in records):
        of = [r for r in records if (r["representation"], r["start"]) == kind]
        ratios = [r["energy"] / default[r["file"]] for r in of if default[r["file"]] > SINGULARITY_FREE]
        total = lambda key: sum(r[key] for r in of)  # noqa: B023, E731
        result.append(
            (*kind, f"{np.exp(np.mean(np.log(ratios))):.4f}" if ratios else "-", total("singular edges"),
             total("complex edges"), total("non-meshable vertices"), f"{np.mean([r['from sh4 deg'] for r in of]):.2f}",
             f"{max(r['error deg'] for r in of):.1e}", f"{total('converged')} of {len(of)}", f"{total('CPU s'):.1f}")
        )  # fmt: skip
    return result


def measure(
    path: Path, options: FieldOptions, representations: list[str], alone: bool = True
) -> tuple[list, list[list]]:
    """The line of fields.md and those of representations.md."""
    meshed = prepare_mesh(path, options)
    problem = prepare_field(meshed)
    reference = run_field(problem, options)
    lines = []
    for rounds in (options.rounds, 0) if alone else (options.rounds,):
        for name in representations:
            chosen = replace(options, representation=name, rounds=rounds)
            lines.append(representation_row(path, meshed, run_field(problem, chosen), reference))
    return row_of(path, meshed, reference), lines


def measure_folder(
    folder: Path, output: Path, options: FieldOptions, representations=(), skip=(), only=(), alone=True
) -> None:
    """Writes the tables after every file, so that an interrupted run leaves those of the files before."""
    output.mkdir(parents=True, exist_ok=True)
    rows, lines = [], []
    for path in sorted(folder.glob("*.vtk*")):
        if (skip and path.name.startswith(skip)) or (only and not path.name.startswith(only)):
            continue
        try:
            row, more = measure(path, options, list(representations), alone)
            lines.extend(more)
        except octafield.Error as error:
            row = [name_of(path), f"{type(error).__name__}: {error}"]
        rows.append(row)
        print(*(f"{x:.5g}" if isinstance(x, float) else x for x in row), flush=True)
        write_tables(output / "fields", HEADER, rows)
        if lines:
            write_tables(output / "representations", REPRESENTATION_HEADER, lines)
            (output / "summary.md").write_text(markdown_table(SUMMARY_HEADER, summary_rows(lines)))


def write_tables(stem: Path, header: list[str], rows: list[list]) -> None:
    write_csv(stem.with_suffix(".csv"), header, rows, quiet=True)
    shown = [[f"{x:.4g}" if isinstance(x, float) else x for x in row] for row in rows]
    stem.with_suffix(".md").write_text(markdown_table(header, shown))


def name_of(path: Path) -> str:
    return path.name.split(".")[0]


def names(text: str) -> tuple[str, ...]:
    return tuple(filter(None, text.split(",")))


def main(arguments=None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--representations", default="", help="names with commas, or all")
    parser.add_argument("--recipe-only", action="store_true", help="no runs from the linear start")
    parser.add_argument("--split", action="store_true", help="split locking tets first")
    parser.add_argument("--skip", default="", help="beginnings of file names, with commas")
    parser.add_argument("--only", default="", help="beginnings of file names, with commas")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--feature-tolerance", type=float, default=np.degrees(FieldOptions().feature_tolerance))
    a = parser.parse_args(arguments)
    options = FieldOptions(split=a.split, feature_tolerance=np.radians(a.feature_tolerance), threads=a.threads)
    representations = COMPARED if a.representations == "all" else names(a.representations)
    measure_folder(a.folder, a.output, options, representations, names(a.skip), names(a.only), not a.recipe_only)


if __name__ == "__main__":
    main()
