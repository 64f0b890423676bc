"""Frame fields in volumes: energy and CPU seconds of the default recipe, its spread over random starts, and the time of
linear solves.

    python -m studies.benchmarks.volume.energies -o DIR [--seeds 10] MESH...

MESH: tet meshes or closed surfaces. No features; every boundary vertex aligned with its area-weighted normal, twist
    free (the conventions of Palmer, Bommes, Solomon 2020). Energies: sh4, P1 stiffness. CPU seconds of one thread,
    smoothing only; least of `--repeats` runs. Units of time, by conjugate gradients of SciPy with the Jacobi
    preconditioner to the relative residual 1e-8, in the same process, without assembly: "same constraints": the
    harmonic sh4 field under the field's own constraints, one system (Ray, Sokolov, Levy 2016): nine unknowns per vertex
    inside, two at a vertex whose axis is fixed; "boundary fixed": the harmonic extension of whole sh4 vectors given at
    the boundary, nine systems. DIR gets summary.md.
"""

import argparse
import time
from pathlib import Path

import numpy as np
import octafield
import scipy.sparse as sparse
import scipy.sparse.linalg
from octafield.domain.meshing import prepare_mesh
from octafield.fields.frame_field import prepare_field
from octafield.options import MeshOptions
from study_output import markdown_table

AXIS, FIXED = 1, 2  # of BoundaryConstraints.kind

# Best energy that public codes reached on these meshes in the same conventions, and CPU seconds: of modified MBO and a
# trust region (Palmer, Bommes, Solomon 2020), in brackets of Ray, Sokolov, Levy 2016, converged; measured on another
# day.
PUBLIC_CODES = {
    "sphere_r0.17": (39.8463, "2.5 (0.21)"),
    "sphere_r0.10": (52.2090, "7.5 (5.2)"),
    "78322_gear.2": (1673.6623, "23.7 (2.6)"),
    "genus3": (37.8703, "82.0 (7.3)"),
    "sphere_r0.06": (61.4593, "37.7 (21.6)"),
}


def timed(function, repeats: int):
    """The result, and the least CPU seconds."""
    seconds = []
    for _ in range(repeats):
        begin = time.process_time()
        result = function()
        seconds.append(time.process_time() - begin)
    return result, min(seconds)


def solve(system, columns) -> int:
    """Conjugate-gradient iterations of all columns together."""
    inverse = sparse.diags(1 / system.diagonal())
    iterations = 0

    def count(_):
        nonlocal iterations
        iterations += 1

    for column in columns:
        _, failed = scipy.sparse.linalg.cg(system, column, rtol=1e-8, M=inverse, callback=count)
        if failed:
            raise RuntimeError("the linear solve did not converge")
    return iterations


def twist_circles(frames: np.ndarray, axes: np.ndarray) -> tuple:
    """Centres (k, 9) and orthonormal bases (k, 9, 2) of the planes of the circles that sh4 vectors describe as frames
    turn about an axis."""
    start = octafield.frames.sh4_embed(frames)
    turned = lambda angle: octafield.frames.sh4_rotate(octafield.frames.quaternion_exp(angle * axes), start)
    centre = (start + turned(np.pi / 4)) / 2
    basis = np.stack([start - centre, turned(np.pi / 8) - centre], axis=2)
    return centre, basis / np.linalg.norm(basis, axis=1, keepdims=True)


def constrained_system(tets, constraints) -> tuple:
    """Matrix and right-hand side of the harmonic sh4 field under the constraints: with x = given + B u, B'(L x I)B u =
    -B'(L x I) given."""
    stiffness, kind, frames = (
        octafield.volume.stiffness(tets).tocsr(),
        np.array(constraints.kind),
        np.array(constraints.frames),
    )
    n, turning, fixed = len(kind), np.flatnonzero(kind == AXIS), np.flatnonzero(kind == FIXED)
    given = np.zeros((n, 9))
    given[fixed] = octafield.frames.sh4_embed(frames[fixed])
    given[turning], planes = twist_circles(frames[turning], np.array(constraints.axis)[turning])
    unknowns = np.where(kind == AXIS, 2, np.where(kind == FIXED, 0, 9))
    first = np.cumsum(unknowns) - unknowns
    inside = np.flatnonzero(unknowns == 9)
    rows = [
        (9 * inside[:, None] + np.arange(9)).ravel(),
        (9 * turning[:, None, None] + np.arange(9)[:, None] + [0, 0]).ravel(),
    ]
    columns = [
        (first[inside][:, None] + np.arange(9)).ravel(),
        (first[turning][:, None, None] + np.zeros((9, 1), int) + np.arange(2)).ravel(),
    ]
    values = [np.ones(9 * len(inside)), planes.ravel()]
    basis = sparse.csr_matrix(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(9 * n, unknowns.sum())
    )
    system = (basis.T @ sparse.kron(stiffness, sparse.identity(9), "csr") @ basis).tocsr()
    return system, -basis.T @ (stiffness @ given).ravel()


def dirichlet_system(tets, boundary: np.ndarray, values: np.ndarray) -> tuple:
    """Matrix, and right-hand sides of the nine components, of the harmonic extension of `values` at the boundary."""
    stiffness = octafield.volume.stiffness(tets).tocsr()
    inside = np.setdiff1d(np.arange(len(tets.vertices)), boundary)
    return stiffness[inside][:, inside], -(stiffness[inside][:, boundary] @ values).T


def problem(path) -> tuple:
    """Mesh and constraints of the comparison."""
    meshed = prepare_mesh(path, MeshOptions(features="none"))
    directions = prepare_field(meshed).directions
    return meshed.tets, octafield.volume.boundary_constraints(meshed.tets, directions, mode="aligned")


def measure(path, seeds: int = 10, repeats: int = 3) -> tuple:
    """A row of header(seeds)."""
    tets, constraints = problem(path)
    run = lambda **options: octafield.volume.frame_field(tets, constraints, threads=1, **options)
    result, seconds = timed(run, repeats)
    system, right = constrained_system(tets, constraints)
    iterations, unit = timed(lambda: solve(system, [right]), repeats)
    boundary = np.flatnonzero(np.array(constraints.on_boundary))
    system, right = dirichlet_system(tets, boundary, octafield.frames.sh4_embed(np.array(constraints.frames)[boundary]))
    fixed_iterations, fixed_unit = timed(lambda: solve(system, right), repeats)
    spread = [run(seed=seed).smooth.energy for seed in range(1, seeds + 1)]
    name = Path(path).name.split(".mesh")[0]
    known, others = PUBLIC_CODES.get(name, ("-", "-"))
    return (
        name,
        f"{len(tets.vertices):,}",
        f"{len(tets.tets):,}",
        f"{run(rounds=0).smooth.energy:.4f}",
        f"{run(rounds=1).smooth.energy:.4f}",
        f"{result.smooth.energy:.4f}",
        f"{seconds:.3f}",
        f"{unit:.3f} ({iterations})",
        f"{seconds / unit:.1f}",
        f"{fixed_unit:.3f} ({fixed_iterations})",
        f"{seconds / fixed_unit:.1f}",
        f"{min(spread):.4f} to {max(spread):.4f}" if spread else "-",
        known,
        others,
    )


def header(seeds: int = 10) -> list:
    return [
        "mesh",
        "vertices",
        "tets",
        "E, no diffusion",
        "E, one round",
        "E, default",
        "CPU s",
        "linear solve, same constraints: CPU s (iterations)",
        "default over it",
        "boundary fixed: CPU s (iterations)",
        "default over it",
        f"E over {seeds} seeds",
        "best known",
        "others, CPU s",
    ]


def main(arguments=None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="+")
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--repeats", type=int, default=3)
    arguments = parser.parse_args(arguments)
    arguments.output.mkdir(parents=True, exist_ok=True)
    rows = []
    for mesh in arguments.mesh:
        rows.append(measure(mesh, arguments.seeds, arguments.repeats))
        print(*rows[-1], flush=True)
        (arguments.output / "summary.md").write_text(markdown_table(header(arguments.seeds), rows))


if __name__ == "__main__":
    main()
