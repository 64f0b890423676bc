"""Energies and seconds of the steps that lower the energy: start, diffusion with time exponents 3 and 2, smoothing after each and without.

    python studies/benchmarks/diffusion.py [MESH...]

MESH: surfaces or tet meshes; default: a unit sphere meshed at three sizes. No features; every boundary vertex aligned with the normal, twist free. Compare
energies of one mesh only; seconds are those of one run on one machine.
"""

import argparse
import time

import pyvista

import octafield
from octafield.options import MeshOptions
from octafield.pipeline import prepare, prepare_mesh


def spheres():
    solid = pyvista.Icosphere(nsub=4)
    mesh = octafield.TriangleMesh(solid.points.astype(float), solid.regular_faces)
    for edge in (0.25, 0.15, 0.1):
        yield f"sphere {edge}", mesh, edge


def timed(function, *arguments, **options):
    begin = time.perf_counter()
    result = function(*arguments, **options)
    return result, time.perf_counter() - begin


def measure(name, source, edge_length) -> None:
    problem = prepare(prepare_mesh(source, MeshOptions(features="none", edge_length=edge_length)))
    tets, meshed = problem.meshed.tets, problem.meshed
    constraints = octafield.boundary_constraints(len(tets.vertices), meshed.boundary, meshed.features, problem.directions, mode="aligned")
    start, seconds = timed(octafield.initial_frames, tets, constraints)
    print(f"{name}: {len(tets.vertices)} vertices, {len(tets.tets)} tets; start {octafield.dirichlet_energy(tets, start):.4f}, {seconds:.1f} s")
    for label, exponent in (("none", None), ("1/k^3", 3.0), ("1/k^2", 2.0)):
        frames, diffused, before = start, "", 0.0
        if exponent:
            result, before = timed(octafield.diffuse, tets, constraints, start, time_exponent=exponent)
            frames, diffused = result.frames, f"{result.iterations:3d} steps {before:5.1f} s energy {result.energy:.4f};"
        smoothed, seconds = timed(octafield.smooth, tets, constraints, frames)
        print(f"  diffusion {label:6s} {diffused:40s} smooth {smoothed.iterations:3d} iterations {seconds:5.1f} s energy {smoothed.energy:.4f}; both {before + seconds:5.1f} s")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="*")
    arguments = parser.parse_args()
    cases = [(mesh, mesh, 0.0) for mesh in arguments.mesh] or spheres()
    for case in cases:
        measure(*case)


if __name__ == "__main__":
    main()
