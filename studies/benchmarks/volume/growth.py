"""Seconds and memory of the whole chain against mesh size: balls meshed by TetGen, and files.

    python -m studies.benchmarks.volume.growth -o DIR [--balls 12,20,32,48] [--threads 0] [FILE...]

A ball of number n is an icosphere of 20 n^2 triangles filled by TetGen; files are surfaces or tet meshes. Each runs as
`octafield field` in a process of its own. Wall seconds by phase, CPU seconds and peak memory are those of its JSON
record. The last line: the exponents p of CPU seconds ~ tets^p by least squares over the balls. DIR gets growth.md.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import octafield
import surface_meshes
from octafield.progress.phases import PHASES
from study_output import markdown_table

HEADER = [
    "mesh",
    "vertices",
    "tets",
    *(f"{phase} s" for phase in PHASES),
    "wall s",
    "CPU s",
    "CPU s, smoothing",
    "peak MB",
    "E",
    "singular edges",
]


def record(path: Path, *options: str) -> dict:
    with tempfile.TemporaryDirectory() as folder:
        out, result = Path(folder) / "out", Path(folder) / "result.json"
        command = [sys.executable, "-m", "octafield", "field", path, "-o", out, "--json", result, "-q", *options]
        subprocess.run(command, check=True)
        return json.loads(result.read_text())


def row(name: str, r: dict) -> tuple:
    wall, cpu = r["wall_seconds"], r["cpu_seconds"]
    return (
        name,
        f"{r['vertices']:,}",
        f"{r['tets']:,}",
        *(f"{wall[phase]:.2f}" for phase in PHASES),
        f"{sum(wall.values()):.1f}",
        f"{sum(cpu.values()):.1f}",
        f"{cpu['smooth']:.1f}",
        f"{r['peak_mb']:.0f}",
        f"{r['energy']:.6g}",
        f"{r['singular_edges']:,}",
    )


def exponent(sizes, seconds) -> float:
    """p of seconds ~ sizes^p by least squares."""
    return np.polyfit(np.log(sizes), np.log(seconds), 1)[0]


def main(arguments=None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", nargs="*", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--balls", default="12,20,32,48")
    parser.add_argument("--threads", default="0")
    arguments = parser.parse_args(arguments)
    arguments.output.mkdir(parents=True, exist_ok=True)
    rows, sizes, seconds, smoothing = [], [], [], []

    def add(name: str, r: dict) -> None:
        rows.append(row(name, r))
        print(*rows[-1], flush=True)
        (arguments.output / "growth.md").write_text(markdown_table(HEADER, rows))

    with tempfile.TemporaryDirectory() as folder:
        for n in map(int, filter(None, arguments.balls.split(","))):
            ball = Path(folder) / f"ball{n}.ply"
            octafield.write_surface(surface_meshes.sphere(n), ball)
            r = record(ball, "--no-remesh", "--features", "none", "--threads", arguments.threads)
            add(f"ball {n}", r)
            sizes.append(r["tets"])
            seconds.append(sum(r["cpu_seconds"].values()))
            smoothing.append(r["cpu_seconds"]["smooth"])
    for path in arguments.file:
        add(path.name.split(".")[0], record(path, "--threads", arguments.threads))
    if len(sizes) > 1:
        told = (
            f"CPU seconds of the balls grow like tets^{exponent(sizes, seconds):.2f}, of their smoothing like"
            f" tets^{exponent(sizes, smoothing):.2f}."
        )
        print(told)
        (arguments.output / "exponent.md").write_text(told + "\n")


if __name__ == "__main__":
    main()
