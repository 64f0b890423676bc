"""What a scheme of Python costs beside the compiled ones: CPU seconds of the smoothing and peak memory of a process.

    .venv/bin/python -m studies.benchmarks.own_schemes [--edge-length 0.09]

On a ball; each scheme in a process of its own, after the field of sh4, whose peak is subtracted."""

import argparse
import resource
import subprocess
import sys
from pathlib import Path

from octafield import FieldOptions, MeshOptions, prepare_field, prepare_mesh, run_field
from octafield.domain.generators import generate
from octafield.frames import sh4_embed
from octafield.volume import EmbeddingScheme

IDEAS = Path(__file__).parents[1] / "examples" / "own_scheme" / "ideas.py"
own_sh4 = EmbeddingScheme("own_sh4", sh4_embed)
SCHEMES = ("sh4", f"{__file__}:own_sh4", f"{IDEAS}:bump_scheme", f"{IDEAS}:capped_scheme")


def peak_bytes() -> int:
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def measure(scheme: str, edge_length: float) -> None:
    problem = prepare_field(prepare_mesh(generate("ball"), MeshOptions(edge_length=edge_length)))
    run_field(problem, FieldOptions(streamlines=0))
    before = peak_bytes()
    record = run_field(problem, FieldOptions(representation=scheme, streamlines=0)).record
    more = (peak_bytes() - before) / record.tets
    print(f"| {record.representation} | {record.tets:,} | {record.cpu_seconds['smooth']:.1f} | {more:,.0f} |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--edge-length", type=float, default=0.09)
    parser.add_argument("--scheme", help="this one alone, in this process")
    given = parser.parse_args()
    if given.scheme:
        return measure(given.scheme, given.edge_length)
    print("| scheme | tets | smoothing, CPU s | bytes per tet more |\n|---|---|---|---|", flush=True)
    for scheme in SCHEMES:
        command = [sys.executable, "-m", "studies.benchmarks.own_schemes", "--scheme", scheme]
        subprocess.run([*command, "--edge-length", str(given.edge_length)], check=True)


if __name__ == "__main__":
    main()
