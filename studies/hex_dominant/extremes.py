"""Extreme and damaged inputs: each ends with a sound mesh or an error that says what is wrong and what to do.

One input in a process of its own: python -m studies.hex_dominant.extremes NAME DATA JSON. Writes a row.
"""

import json
import os
import sys
import tempfile
import time
import traceback
from pathlib import Path

import numpy as np
import octafield
from octafield.files.writing import staged_folder
from octafield.hexdom.files import MESH_FILES, write_hex_result
from octafield.records.record_file import RECORD_FILE
from study_output import markdown_table

from ..benchmarks.pages import commit
from . import checker, extreme_inputs, rows
from .run import THREADS, cells_of_file, mean_edge

LIMIT = 120.0  # seconds of CPU time
TYPES = (octafield.InvalidInput, octafield.GeometryError, octafield.SolverError, octafield.IoError)
HEADER = ["input", "what it is", "outcome", "cells", "hex volume %", "SJ min", "volume error %", "s", "MB", "fine"]


def mesh_into(case: extreme_inputs.Extreme, data: Path, folder: Path) -> octafield.HexDominantResult:
    """As the command line does it: the folder is complete or absent."""
    source = case.make(data)
    edge = case.edge
    if case.of_mean:
        found = source if isinstance(source, octafield.TriangleMesh) else octafield.volume.boundary_surface(source).mesh
        edge = case.of_mean * mean_edge(np.asarray(found.vertices), np.asarray(found.triangles))
    options = octafield.FieldOptions(**{"threads": THREADS, "streamlines": 0, **case.options})
    with staged_folder(folder, RECORD_FILE) as staged:
        cells = octafield.HexMeshOptions(edge_length=edge, cells=case.cells)
        result = octafield.compute_hex_dominant(source, options, hex_options=cells, sizes=case.sizes)
        write_hex_result(result, staged)
    return result


def measure(name: str, data: Path) -> dict:
    case = extreme_inputs.EXTREMES[name]
    began = time.perf_counter()
    with tempfile.TemporaryDirectory() as parent:
        folder = Path(parent) / "out"
        try:
            result = mesh_into(case, data, folder)
        except TYPES as error:
            row = failed(error)
            if list(Path(parent).iterdir()):
                row["faults"] += "; files are left"
        else:
            row = checked(result, folder)
    return row | {"seconds": time.perf_counter() - began}


def failed(error: octafield.Error) -> dict:
    """A fault is a message without a kind (those of files have none), too short to tell cause and remedy, or with a
    path of a source file."""
    text = str(error)
    faults = [
        what
        for what, there in (
            ("no kind", not error.kind and not isinstance(error, octafield.IoError)),
            ("the message says little", len(text.split()) < 6),
            ("the message names a source file", any(word in text for word in (".cxx", ".cpp", "/src/"))),
        )
        if there
    ]
    return {"error": type(error).__name__, "kind": error.kind, "message": text, "faults": ", ".join(faults)}


def checked(result: octafield.HexDominantResult, folder: Path) -> dict:
    domain, edge = result.field.tets, result.record.edge_length.target
    given, tets = np.asarray(domain.vertices), np.asarray(domain.tets)
    points, cells = cells_of_file(folder / "mesh.vtu")
    row = checker.check(points, cells, given, tets, edge, np.zeros((0, 2), int))
    missing = [name for name in (*MESH_FILES, RECORD_FILE) if not (folder / name).exists()]
    if missing:
        row["faults"] = f"{row['faults']}; missing: {', '.join(missing)}".strip("; ")
    return row | {"cells": sum(len(part) for part in cells.values())}


def work(data: Path, output: Path, limit: float, only: tuple[str, ...]) -> None:
    """extremes.jsonl and extremes.md in the folder. Rows that are there already are kept."""
    output.mkdir(parents=True, exist_ok=True)
    done = {row["input"] for row in read_rows(output)}
    for name in only or extreme_inputs.EXTREMES:
        if name in done:
            continue
        row = {"input": name} | rows.run_words(["studies.hex_dominant.extremes", name, str(data)], limit)
        row |= {"load": round(os.getloadavg()[0], 1), "commit": commit()}
        with (output / "extremes.jsonl").open("a") as file:
            file.write(json.dumps(row) + "\n")
        print(*cells_of(row), sep=" | ", flush=True)
        write_table(output)


def read_rows(output: Path) -> list[dict]:
    path = output / "extremes.jsonl"
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


def fine(row: dict) -> bool:
    """A mesh or a typed error, without a fault."""
    return not row.get("faults") and ("cells" in row or "kind" in row)


def outcome(row: dict) -> str:
    if "cells" in row:
        return f"mesh: {row['faults']}" if row["faults"] else "mesh, sound"
    if "kind" not in row:
        return rows.clean(row["error"])
    first = rows.clean(row["message"].split("; ")[0])
    return f"{row['error']} {row['kind']}: {first}" + (f" ({row['faults']})" if row["faults"] else "")


def cells_of(row: dict) -> list[str]:
    figures = [""] * 4
    if "cells" in row:
        figures = [f"{row['cells']:,}", f"{100 * row['hex_volume_share']:.1f}", f"{row['sj_min']:.3f}",
                   f"{100 * row['volume_error']:.2g}"]  # fmt: skip
    words = extreme_inputs.EXTREMES[row["input"]].words
    return [row["input"], words, outcome(row), *figures, f"{row['seconds']:.1f}", f"{row.get('MB', 0):.0f}",
            "yes" if fine(row) else "no"]  # fmt: skip


def write_table(output: Path) -> None:
    told = read_rows(output)
    meshes, sound = sum("cells" in row for row in told), sum(fine(row) for row in told)
    loads = [row["load"] for row in told]
    (output / "extremes.md").write_text(
        f"{len(told)} inputs: {meshes} meshes, {len(told) - meshes} errors; {sound} as they should be. Load average"
        f" {min(loads)} to {max(loads)}, commits {', '.join(dict.fromkeys(row['commit'] for row in told))}.\n\n"
        + markdown_table(HEADER, [cells_of(row) for row in told])
    )


def main() -> None:
    name, data, out = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    try:
        row = measure(name, data)
    except Exception as error:  # a row of its own: a defect
        traceback.print_exc()
        row = {"error": f"{type(error).__name__}: {error}"[:400], "faults": "an error without a type of octafield's"}
    out.write_text(json.dumps(row))


if __name__ == "__main__":
    main()
