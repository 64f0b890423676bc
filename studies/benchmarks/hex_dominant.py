"""Time and memory of hex-dominant meshes by number of cells, per phase; each run in a process of its own.

    .venv/bin/python -m studies.benchmarks.hex_dominant [--cells 10000,100000,1000000] [--shape cylinder]

Tets of the field have about the edge length of the cells. Prints a table, with the exponent of the CPU time between one
size and the next."""

import argparse
import json
import math
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import octafield
from octafield.domain.generators import generate


def measure(shape: str, cells: int) -> dict:
    with TemporaryDirectory() as folder:
        part = Path(folder) / f"{shape}.stl"
        octafield.write_surface(generate(shape), part)
        command = [sys.executable, "-m", "octafield", "hex-dominant", part, "-o", Path(folder) / "out", "--quiet"]
        subprocess.run([*map(str, command), "--cells", str(cells)], check=True)
        return json.loads((Path(folder) / "out" / "result.json").read_text())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", default="10000,100000,1000000")
    parser.add_argument("--shape", default="cylinder")
    given = parser.parse_args()
    print("| cells wanted | cells | tets of the field | hexahedra, volume % | wall s | CPU s | exponent | MB |")
    print("|---|---|---|---|---|---|---|---|", flush=True)
    before = None
    for wanted in map(int, given.cells.split(",")):
        record = measure(given.shape, wanted)
        cells, cpu = sum(record["cells"].values()), sum(record["cpu_seconds"].values())
        exponent = "" if before is None else f"{math.log(cpu / before[1]) / math.log(cells / before[0]):.2f}"
        before = cells, cpu
        wall = sum(record["wall_seconds"].values())
        share = 100 * record["hex_volume_share"]
        print(
            f"| {wanted:,} | {cells:,} | {record['tets']:,} | {share:.1f} | {wall:.0f} | {cpu:.0f} | {exponent}"
            f" | {record['peak_mb']:,.0f} |",
            flush=True,
        )
        for phase, seconds in record["wall_seconds"].items():
            print(f"  {phase}: {seconds:.1f} s, {record['phase_peak_mb'].get(phase, 0):,.0f} MB", file=sys.stderr)


if __name__ == "__main__":
    main()
