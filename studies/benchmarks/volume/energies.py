"""Frame fields in volumes: energy and CPU seconds of the default recipe, its spread over random starts, and the time of one linear solve.

    python -m studies.benchmarks.volume.energies -o DIR [--seeds 10] MESH...

MESH: tet meshes or closed surfaces. No features; every boundary vertex aligned with its area-weighted normal, twist free (the conventions of Palmer, Bommes,
Solomon 2020). Energies: sh4, P1 stiffness. "linear solve": nine conjugate-gradient solves of the harmonic extension of the boundary's sh4 vectors with
SciPy, Jacobi preconditioner, relative residual 1e-8, on the same mesh in the same process: a machine-independent unit of time. CPU seconds of one thread, smoothing only; least of `--repeats` runs.
DIR gets summary.md.
"""

import argparse
import time
from pathlib import Path

import numpy as np
import scipy.sparse.linalg
from study_output import markdown_table

import octafield
from octafield.options import MeshOptions
from octafield.pipeline import prepare, prepare_mesh


def timed(function, repeats: int):
    """The result, and the least CPU seconds."""
    seconds = []
    for _ in range(repeats):
        begin = time.process_time()
        result = function()
        seconds.append(time.process_time() - begin)
    return result, min(seconds)


def linear_solve(tets, boundary_vertices: np.ndarray, values: np.ndarray) -> int:
    """Harmonic extension of `values` at the boundary; total conjugate-gradient iterations of the nine components."""
    stiffness = octafield.stiffness(tets).tocsr()
    inside = np.setdiff1d(np.arange(len(tets.vertices)), boundary_vertices)
    system, coupling = stiffness[inside][:, inside], stiffness[inside][:, boundary_vertices]
    inverse = scipy.sparse.diags(1 / system.diagonal())
    iterations = 0

    def count(_):
        nonlocal iterations
        iterations += 1

    for column in (coupling @ values).T:
        scipy.sparse.linalg.cg(system, -column, rtol=1e-8, M=inverse, callback=count)
    return iterations


def measure(path: str, seeds: int, repeats: int) -> tuple:
    meshed = prepare_mesh(path, MeshOptions(features="none"))
    problem = prepare(meshed)
    tets, boundary = meshed.tets, np.array(meshed.boundary.vertex_map)
    constraints = octafield.boundary_constraints(len(tets.vertices), meshed.boundary, meshed.features, problem.directions, mode="aligned")
    run = lambda **options: octafield.frame_field(tets, constraints, threads=1, **options)
    once, seconds_once = timed(lambda: run(rounds=1), repeats)
    result, seconds = timed(run, repeats)
    vectors = octafield.sh4_embed(np.array(constraints.frames)[boundary])
    iterations, unit = timed(lambda: linear_solve(tets, boundary, vectors), repeats)
    undiffused = run(rounds=0)
    other = run(start="cross_field", rounds=1)
    spread = [run(seed=seed).smooth.energy for seed in range(1, seeds + 1)]
    return (Path(path).name.split(".mesh")[0], f"{len(tets.vertices):,}", f"{len(tets.tets):,}", f"{undiffused.smooth.energy:.4f}",
            f"{once.smooth.energy:.4f}", f"{seconds_once:.3f}",
            f"{other.smooth.energy:.4f}", f"{result.smooth.energy:.4f}", f"{seconds:.3f}", f"{unit:.3f} ({iterations})", f"{seconds_once / unit:.1f}", f"{seconds / unit:.1f}",
            f"{min(spread):.4f} to {max(spread):.4f}" if spread else "-")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="+")
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--repeats", type=int, default=3)
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    header = ["mesh", "vertices", "tets", "E, no diffusion", "E, one round", "CPU s", "E, one round from the cross field", "E, default", "CPU s", "linear solve, CPU s (iterations)", "one round over it", "default over it",
              f"E over {arguments.seeds} seeds"]
    rows = []
    for mesh in arguments.mesh:
        rows.append(measure(mesh, arguments.seeds, arguments.repeats))
        print(*rows[-1], flush=True)
        (arguments.output / "summary.md").write_text(markdown_table(header, rows))


if __name__ == "__main__":
    main()
