"""Frames in the tets against frames at the vertices.

    python studies/sampling_tets.py -o DIR [--cubes 4,8,16] [--balls 4,8,12] [MESH...]

cubes.md: a twist of 1 radian about z from bottom to top of the unit cube, given at the boundary. It is a harmonic map
    of energy 1/2 20/3, so energy and angles are compared with the exact ones; on cells of six tets and, of as many
    vertices along an edge, on TetGen's meshes. fields.md: the default recipe on refined balls and on MESH, with the
    energy of each field in the other sampling, singular edges and CPU seconds of both. lengths.md: odeco tensors with
    unit and with free axis lengths on the same meshes.
"""

import argparse
import time
from pathlib import Path

import numpy as np
import octafield
import surface_meshes
from octafield.domain.meshing import prepare_mesh
from octafield.fields.frame_field import compute_field
from octafield.options import FieldOptions
from study_output import markdown_table
from su2_problems import kuhn_grid

EXACT = 10 / 3


def twist(points: np.ndarray) -> np.ndarray:
    return octafield.frames.quaternion_exp(np.column_stack([0 * points[:, 0], 0 * points[:, 0], points[:, 2]]))


def held(values: np.ndarray, on_boundary: np.ndarray) -> octafield.volume.BoundaryConstraints:
    kind = np.where(on_boundary, 2, 0).astype(np.uint8)
    frames = np.where(on_boundary[:, None], values, [1.0, 0, 0, 0])
    return octafield.volume.BoundaryConstraints(
        kind, np.zeros((len(kind), 3)), frames, on_boundary.astype(np.uint8), []
    )


def cube_row(name: str, mesh: octafield.TetMesh) -> tuple:
    points, tets = np.asarray(mesh.vertices), np.asarray(mesh.tets)
    surface = octafield.volume.boundary_surface(mesh)
    at_vertices = np.zeros(len(points), bool)
    at_vertices[surface.vertex_map] = True
    tangents = np.ones((len(surface.mesh.triangles), 3))
    in_tets = np.asarray(octafield.volume.tet_boundary_constraints(mesh, tangents, mode="none").on_boundary) == 1
    row = [name, f"{len(points):,}", f"{len(tets):,}"]
    for where, sites, on in (
        (mesh, points, at_vertices),
        (octafield.volume.tet_sampling(mesh), points[tets].mean(axis=1), in_tets),
    ):
        exact = twist(sites)
        constraints = held(exact, on)
        found = octafield.volume.smooth(
            where, constraints, octafield.volume.initial_frames(where, constraints), tolerance=1e-10
        )
        angles = np.degrees(octafield.frames.distance(found.frames, exact))[~on]
        row += [
            f"{found.energy / EXACT:.4f}",
            f"{octafield.volume.dirichlet_energy(where, exact) / EXACT:.4f}",
            f"{angles.mean():.3f} ({angles.max():.2f})",
        ]
    return tuple(row)


def tetgen_cube(n: int) -> octafield.TetMesh:
    surface = octafield.volume.boundary_surface(kuhn_grid(n, n, n, 1 / n)).mesh
    return octafield.volume.tetrahedralize(surface)


def field_rows(name: str, mesh) -> tuple[tuple, list[tuple]]:
    features = "none" if name.startswith("ball") or "sphere" in name else "default"
    meshed = prepare_mesh(mesh, FieldOptions(features=features, remesh=False))
    seconds, results = [], []
    for sampling in ("vertices", "tets"):
        results.append(compute_field(meshed, FieldOptions(features=features, sampling=sampling, threads=1)))
        seconds.append(results[-1].record.cpu_seconds.smooth)
    vertices, tets = results
    sampling = octafield.volume.tet_sampling(meshed.tets)
    a, b = vertices.record, tets.record
    other = octafield.volume.dirichlet_energy(sampling, octafield.volume.tet_frames(meshed.tets, vertices.frames))
    row = (
        name,
        f"{a.vertices:,}",
        f"{a.tets:,}",
        f"{a.energy:.5g}",
        f"{b.energy:.5g}",
        f"{b.energy_at_vertices:.5g}",
        f"{other:.5g}",
        a.singular_edges,
        b.singular_edges,
        f"{a.singular_length:.4g}",
        f"{b.singular_length:.4g}",
        a.complex_edges,
        b.complex_edges,
        b.released_corners,
        f"{seconds[0]:.2f}",
        f"{seconds[1]:.2f}",
    )
    return row, odeco_rows(name, meshed, vertices)


def odeco_rows(name: str, meshed, field) -> list[tuple]:
    start = time.process_time()
    found = octafield.volume.smooth(
        meshed.tets, field.constraints, field.frames, representation="odeco_lengths", max_iterations=1000, threads=1
    )
    seconds = time.process_time() - start
    lengths = np.asarray(found.lengths)
    graph = octafield.volume.singular_graph(meshed.tets, found.frames)
    return [
        (
            name,
            f"{field.record.energy:.5g}",
            f"{found.objective:.5g}",
            f"{found.energy:.5g}",
            f"{lengths.min():.2f}, {np.median(lengths):.2f}, {lengths.max():.2f}",
            field.record.singular_edges,
            len(graph.triangles),
            found.iterations,
            f"{seconds:.1f}",
        )
    ]


FIELD_HEADER = [
    "mesh",
    "vertices",
    "tets",
    "E, vertices",
    "E, tets",
    "E of the tets' field at vertices",
    "E of the vertices' field in tets",
    "singular edges, vertices",
    "tets",
    "length, vertices",
    "tets",
    "complex, vertices",
    "tets",
    "released tets",
    "CPU s, vertices",
    "tets",
]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="*", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--cubes", default="4,8,16")
    parser.add_argument("--balls", default="4,8,12")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    numbers = lambda text: [int(n) for n in text.split(",") if n]
    cubes = [cube_row(f"cells {n}", kuhn_grid(n, n, n, 1 / n)) for n in numbers(arguments.cubes)]
    cubes += [cube_row(f"TetGen {n}", tetgen_cube(n)) for n in numbers(arguments.cubes)]
    rows, lengths = [], []
    inputs = [(f"ball {n}", surface_meshes.sphere(n)) for n in numbers(arguments.balls)]
    inputs += [(path.name.split(".mesh")[0].split(".vtk")[0], path) for path in arguments.mesh]
    for name, mesh in inputs:
        row, odeco = field_rows(name, mesh)
        rows.append(row)
        print(*row, *odeco[0], flush=True)
        lengths += odeco
    tables = {
        "cubes.md": (
            [
                "mesh",
                "vertices",
                "tets",
                "E / exact, vertices",
                "of exact frames",
                "angle, degrees: mean (max)",
                "E / exact, tets",
                "of exact frames",
                "angle, degrees: mean (max)",
            ],
            cubes,
        ),
        "fields.md": (FIELD_HEADER, rows),
        "lengths.md": (
            [
                "mesh",
                "E, unit lengths",
                "objective, free lengths",
                "E of its frames",
                "lengths: min, median, max",
                "singular edges, unit",
                "free",
                "iterations",
                "CPU s",
            ],
            lengths,
        ),
    }
    for file, (header, body) in tables.items():
        (arguments.output / file).write_text(markdown_table(header, body))
        print(markdown_table(header, body))


if __name__ == "__main__":
    main()
