"""Direction fields on every surface of a collection of files: does the index sum equal the Euler characteristic?

    python studies/surface_reliability.py FOLDER_OR_FILE... -o out/reliability

Reads surfaces and tet meshes as the package does (the boundary of tets; feature edges of the file, where it has some,
else by angle), keeps their triangles and computes fields by every method. Writes table.csv and summary.md, one line per
file, method and symmetry: triangles, where feature edges come from and how many, singular points, index sum, Euler
characteristic, whether they agree, converged, CPU seconds. Files that are refused are listed with the kind of the error
and its message. Ends with exit code 1 if an index sum is wrong, or a file that is read has no field.
"""

import argparse
import sys
import time
from pathlib import Path

import octafield
from octafield.domain.meshing import prepare_mesh
from octafield.options import METHODS, MeshOptions
from study_output import markdown_table, write_csv

HEADER = ["file", "triangles", "features", "feature edges", "N", "method", "points", "index sum", "chi", "agree",
          "converged",
          "CPU s"]  # fmt: skip


def surfaces(places: list[Path]) -> list[Path]:
    """The files named, and of folders those the package reads."""
    forms = [form for form in octafield.mesh_formats.values() if form.read is not None]
    endings = tuple(suffix + packed for form in forms for suffix in form.suffixes for packed in ("", ".gz"))
    found = []
    for place in places:
        inside = sorted(place.rglob("*")) if place.is_dir() else [place]
        found += [path for path in inside if not place.is_dir() or path.name.endswith(endings)]
    return found


def row(path: Path, meshed, symmetry: int, method: str) -> list:
    """With odd N there is no sense in which feature edges inside the surface could be followed: none are."""
    features = meshed.features if symmetry % 2 == 0 else octafield.FeatureGraph()
    begin = time.process_time()
    field = octafield.surface.direction_field(
        octafield.surface.SurfaceDomain(meshed.surface, features), symmetry=symmetry, method=method
    )
    found = octafield.surface.surface_singularities(field)
    octafield.surface.vertex_directions(field)
    seconds = time.process_time() - begin
    return [path.name, len(meshed.surface.triangles), meshed.feature_source, len(features.edges), symmetry, method,
            len(found.points), f"{found.index_sum:g}", found.euler_characteristic, "yes" if found.agree else "NO",
            "yes" if field.converged else "no", f"{seconds:.2f}"]  # fmt: skip


def examine(path: Path, symmetries: list[int], methods: list[str]) -> tuple[list, list]:
    """Rows of fields, and rows of errors: file, what was refused, kind, message."""
    try:
        meshed = prepare_mesh(path, MeshOptions(remesh=False), volume=False)
    except octafield.Error as error:
        return [], [[path.name, "the file", error.kind, str(error).removeprefix(f"{path}: ")]]
    rows, errors = [], []
    for symmetry in symmetries:
        for method in methods:
            try:
                rows.append(row(path, meshed, symmetry, method))
            except octafield.Error as error:
                errors.append([path.name, f"N = {symmetry}, {method}", error.kind, str(error)])
    return rows, errors


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("inputs", nargs="+", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--symmetries", type=int, nargs="+", default=[4])
    parser.add_argument("--methods", nargs="+", choices=list(METHODS), default=list(METHODS))
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    rows, errors = [], []
    for path in surfaces(arguments.inputs):
        more, refused = examine(path, arguments.symmetries, arguments.methods)
        rows += more
        errors += refused
        for line in more + refused:
            print(*line, flush=True)
    right = sum(line[HEADER.index("agree")] == "yes" for line in rows)
    failed = sum(line[1] != "the file" for line in errors)
    read = len({line[0] for line in rows})
    write_csv(arguments.output / "table.csv", HEADER, rows)
    summary = arguments.output / "summary.md"
    summary.write_text(
        f"{len(rows)} fields on {read} surfaces; the index sum is the Euler characteristic in {right}.\n\n"
        + markdown_table(HEADER, rows)
        + f"\n{len(errors)} errors:\n\n"
        + markdown_table(["file", "refused", "kind", "message"], errors)
    )
    print(summary)
    return 0 if right == len(rows) and failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
