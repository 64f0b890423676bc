"""Cross fields on the same meshes: CPU seconds, peak memory, singular points and a common Dirichlet energy of our
methods and, if asked, of Gmsh and mouette.

    pip install gmsh==4.15.2 mouette==1.2.8      # for --peers; not dependencies of octafield
    python studies/benchmarks/surface_fields.py -o DIR [--sizes 3000,20000,100000] [--large] [--peers] [--part FILE]

Surfaces: unit disk, unit sphere, torus (1, 0.4), and a part with sharp edges, aligned with its features (angle 40
    degrees), where --part names its mesh. Every run is a process of its own (surface_field_runs.py); seconds are CPU
    seconds of the field alone, memory is the peak of the process. --large adds a million triangles without the peers.
    "eps h/2": a coherence length of half a mean edge instead of the default of two. --gmsh-python and --mouette-python
    name interpreters in which the peers are installed, if not this one.

Energy: every method gives one direction per triangle; edges get the mean of exp(4 i theta) of their triangles at length
    1, and the energy is (1/2) int |grad|^2 of what is linear in between (Crouzeix, Raviart). The cost of singular
    points grows with the mesh, by pi |log h| each, alike for all methods: compare within one mesh only.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

STUDIES = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(STUDIES))

import octafield  # noqa: E402
import surface_meshes  # noqa: E402
from study_output import markdown_table  # noqa: E402

OURS = {
    "octafield mbo": "mbo",
    "octafield gl": "gl",
    "octafield gl, eps h/2": "gl fine",
    "octafield eigen": "eigen",
}
HELD = "octafield mbo, one edge held"  # as Gmsh needs on closed surfaces without features
PEERS = ("gmsh", "mouette")
LARGEST_MESHED = 110_000  # finer disks and parts are split


def split(mesh: octafield.TriangleMesh) -> octafield.TriangleMesh:
    """Every triangle in four."""
    topology = octafield.surface.edge_topology(mesh)
    points, (a, b, c) = np.array(mesh.vertices), np.array(mesh.triangles).T
    x, y, z = len(points) + np.array(topology.triangle_edges).T
    middles = points[np.array(topology.edges)].mean(axis=1)
    triangles = [np.column_stack(t) for t in ((a, x, z), (b, y, x), (c, z, y), (x, y, z))]
    return octafield.TriangleMesh(np.concatenate([points, middles]), np.concatenate(triangles))


def part(path: Path, size: int) -> octafield.TriangleMesh:
    """The file's surface, remeshed to about `size` triangles."""
    mesh = octafield.read_surface(path)
    edge = np.sqrt(4 / np.sqrt(3) * float(np.sum(octafield.surface.triangle_areas(mesh))) / size)
    return octafield.surface.remesh(mesh, octafield.surface.detect_features(mesh), edge_length=edge).mesh


def surface(name: str, size: int, file: Path | None) -> octafield.TriangleMesh:
    if name == "sphere":
        return surface_meshes.sphere(round(np.sqrt(size / 20)))
    if name == "torus":
        return surface_meshes.torus(2 * round(np.sqrt(size / 4)), round(np.sqrt(size / 4)), 1.0, 0.4)
    if size > LARGEST_MESHED:
        return split(surface(name, size // 4, file))
    return surface_meshes.even_disk(np.sqrt(4 / np.sqrt(3) * np.pi / size)) if name == "disk" else part(file, size)


def common_energy(mesh: octafield.TriangleMesh, features: octafield.FeatureGraph, directions: np.ndarray) -> float:
    topology = octafield.surface.edge_topology(mesh)
    edges, sides, points = (np.array(x) for x in (topology.edges, topology.edge_triangles, mesh.vertices))
    normals, areas = (
        np.array(octafield.surface.triangle_normals(mesh)),
        np.array(octafield.surface.triangle_areas(mesh)),
    )
    along = points[edges[:, 1]] - points[edges[:, 0]]

    def crosses(t: np.ndarray) -> np.ndarray:  # of triangle t, from the edge's direction; 0 where there is no triangle
        across = np.cross(normals[t], along)
        angle = np.arctan2(np.sum(directions[t] * across, axis=1), np.sum(directions[t] * along, axis=1))
        return np.where(t < 0, 0, np.exp(4j * angle))

    first, second = crosses(sides[:, 0]), crosses(sides[:, 1])
    mean = first + second
    sharp = {tuple(e) for e in np.array(features.edges).tolist()}
    alone = np.array([tuple(e) in sharp for e in edges.tolist()]) | (abs(mean) < 1e-9)  # each triangle its own value
    both = [np.where(alone, value, mean / np.maximum(abs(mean), 1e-9)) for value in (first, second)]

    x = along[np.array(topology.triangle_edges)[:, 0]]
    y = np.cross(normals, x)
    gradient = np.zeros((len(areas), 3), dtype=complex)
    for e in np.array(topology.triangle_edges).T:
        turn = np.arctan2(np.sum(along[e] * y, axis=1), np.sum(along[e] * x, axis=1))
        own = sides[e, 0] == np.arange(len(areas))
        value = np.where(own, both[0][e], both[1][e]) * np.exp(4j * turn)
        outward = np.cross(np.where(own[:, None], 1, -1) * along[e], normals)
        gradient += value[:, None] * outward / areas[:, None]
    return float(np.sum(areas * np.sum(abs(gradient) ** 2, axis=1)) / 2)


def run(method: str, mesh_file: Path, folder: Path, python: str, timeout: float) -> tuple[dict, np.ndarray | None]:
    result = folder / "field.npz"
    result.unlink(missing_ok=True)
    command = [
        python,
        Path(__file__).with_name("surface_field_runs.py"),
        OURS.get(method, "mbo held" if method == HELD else method),
        mesh_file,
        result,
    ]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout)
    except subprocess.TimeoutExpired:
        return {"note": f"not done in {timeout:.0f} s"}, None
    if done.returncode or not result.exists():
        return {"note": "failed: " + (done.stderr.strip().splitlines() or ["no field"])[-1][:80]}, None
    with np.load(result) as data:
        return json.loads(str(data["record"])), data["directions"]


def installed(python: str, module: str) -> bool:
    return subprocess.run([python, "-c", f"import {module}"], capture_output=True).returncode == 0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--surfaces", default="disk,sphere,torus,part")
    parser.add_argument("--sizes", default="3000,20000,100000")
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--peers", action="store_true")
    parser.add_argument(
        "--part", type=Path, help="surface mesh of a part with sharp edges; without it there is none in the table"
    )
    parser.add_argument("--gmsh-python", default=sys.executable)
    parser.add_argument("--mouette-python", default=sys.executable)
    parser.add_argument("--timeout", type=float, default=600, help="seconds per run")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    pythons = dict.fromkeys([*OURS, HELD], sys.executable)
    for peer in PEERS if arguments.peers else ():
        python = getattr(arguments, f"{peer}_python")
        if installed(python, peer):
            pythons[peer] = python
        else:
            print(f"{peer} is not installed in {python}: left out", file=sys.stderr)
    sizes = [int(x) for x in arguments.sizes.split(",")] + [1_000_000] * arguments.large
    names = [name for name in arguments.surfaces.split(",") if name != "part" or arguments.part]
    rows = []
    header = ["surface", "triangles", "method", "CPU s", "peak MB", "singular points", "energy", "note"]
    for name in names:
        for size in sizes:
            mesh = surface(name, size, arguments.part)
            features = octafield.surface.detect_features(mesh)
            for method, python in pythons.items():
                if method in PEERS and size > 200_000 or method == HELD and len(features.edges):
                    continue
                with tempfile.TemporaryDirectory() as folder:
                    file = Path(folder) / "mesh.npz"
                    np.savez(
                        file,
                        vertices=mesh.vertices,
                        triangles=mesh.triangles,
                        features=features.edges,
                        corners=features.corners,
                    )
                    record, directions = run(method, file, Path(folder), python, arguments.timeout)
                energy = "-" if directions is None else f"{common_energy(mesh, features, directions):.2f}"
                rows.append(
                    (
                        name,
                        f"{len(mesh.triangles):,}",
                        method,
                        record.get("seconds", "-"),
                        record.get("megabytes", "-"),
                        record.get("points", "-"),
                        energy,
                        record.get("note", ""),
                    )
                )
                print(*rows[-1], flush=True)
                (arguments.output / "summary.md").write_text(markdown_table(header, rows))
    print(markdown_table(header, rows))


if __name__ == "__main__":
    main()
