"""The studies of frame fields in volumes run on small meshes and write what they say."""

import subprocess
import sys
from pathlib import Path

import meshio
from octafield.domain.meshing import prepare_mesh
from pipeline_fixtures import write_cube, write_sphere

ROOT = Path(__file__).parents[2]


def run(script: str, output: Path, *options) -> str:
    """`script`: a file, or a module of the benchmarks."""
    program = [ROOT / "studies" / script] if script.endswith(".py") else ["-m", f"studies.benchmarks.volume.{script}"]
    command = [sys.executable, *program, "-o", output, *options]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout


def rows(path: Path) -> list[dict[str, str]]:
    lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in path.read_text().strip().splitlines()]
    return [dict(zip(lines[0], line)) for line in lines[2:]]


def test_the_benchmark_tells_energies_of_every_start(tmp_path):
    run("energies", tmp_path, write_sphere(tmp_path), "--seeds", "2", "--repeats", "1")
    (row,) = rows(tmp_path / "summary.md")
    default, low = float(row["E, default"]), float(row["E over 2 seeds"].split(" to ")[0])
    assert 0 < default <= float(row["E, no diffusion"]) * (1 + 1e-6) and 0.9 * default < low < 1.1 * default


def test_growth_measures_balls_and_files(tmp_path):
    told = run("growth", tmp_path, write_cube(tmp_path), "--balls", "4,6")
    table = rows(tmp_path / "growth.md")
    assert [row["mesh"] for row in table] == ["ball 4", "ball 6", "cube"]
    assert float(table[-1]["E"]) < 1e-9 and table[-1]["singular edges"] == "0" and "tets^" in told


def test_singular_graphs_make_one_picture(tmp_path):
    run("singular_graphs.py", tmp_path, write_cube(tmp_path), write_sphere(tmp_path))
    assert (tmp_path / "singular_graphs.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    cube, sphere = rows(tmp_path / "singular_graphs.md")
    assert cube["curves"] == "0" and int(sphere["singular edges"]) > 0


def test_parts_compares_representations_on_a_folder(tmp_path):
    folder = tmp_path / "in"
    folder.mkdir()
    meshed = prepare_mesh(write_sphere(tmp_path))
    meshio.write_points_cells(folder / "ball.vtk", meshed.tets.vertices, [("tetra", meshed.tets.tets)])
    run("parts", tmp_path / "out", folder, "--representations", "sh4,su2")
    lines = rows(tmp_path / "out" / "representations.md")
    assert [(line["representation"], line["start"]) for line in lines] == [
        (name, start) for start in ("recipe", "linear start") for name in ("sh4", "su2")
    ]
    assert all(float(line["error deg"]) < 0.01 for line in lines)
    summary = rows(tmp_path / "out" / "summary.md")
    assert float(summary[0]["energy over the default's"]) == 1 < float(summary[1]["energy over the default's"])
    (field,) = rows(tmp_path / "out" / "fields.md")
    assert field["energy"] == lines[0]["energy"]


def test_samplings_are_compared_on_cubes_and_fields(tmp_path):
    run("sampling_tets.py", tmp_path, write_cube(tmp_path), "--cubes", "4,6", "--balls", "3")
    cubes, fields, lengths = (rows(tmp_path / f"{name}.md") for name in ("cubes", "fields", "lengths"))
    assert [row["mesh"] for row in cubes] == ["cells 4", "cells 6", "TetGen 4", "TetGen 6"]
    assert all(0.85 < float(row["E / exact, tets"]) < 1.05 for row in cubes)
    ball, cube = fields
    assert int(ball["singular edges, vertices"]) > 0 and float(cube["E, tets"]) < 1e-9
    assert float(lengths[0]["objective, free lengths"]) < float(lengths[0]["E, unit lengths"])


def test_sizes_take_as_many_steps_on_finer_cubes():
    done = subprocess.run(
        [sys.executable, ROOT / "studies" / "benchmarks" / "sizes.py", "6", "12"],
        capture_output=True,
        text=True,
        timeout=100,
        check=True,
    )
    coarse, fine = ([cell.strip() for cell in line.strip("|").split("|")] for line in done.stdout.splitlines()[2:])
    assert coarse[:2] == ["6", "1,296"] and fine[:2] == ["12", "10,368"]
    assert int(fine[2]) < 20 and int(fine[4]) < 20
