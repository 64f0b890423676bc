"""The study of hex-dominant meshes: its checker finds what is wrong, its elements solve, its parts run."""

import csv
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from studies.hex_dominant import checker, elements, poisson  # noqa: E402

CUBE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float)


def all_kinds(seed=0):
    """A block of 3^3 cubes: hexahedra, wedges in one corner, pyramids over one cube's faces, tets where pyramids meet
    wedges; inner vertices moved."""
    n, rng = 4, np.random.default_rng(seed)
    grid = np.stack(np.meshgrid(*[np.arange(n)] * 3, indexing="ij"), axis=-1).reshape(-1, 3).astype(float)
    inner = ((grid > 0) & (grid < n - 1)).all(axis=1)
    grid[inner] += rng.uniform(-0.15, 0.15, (inner.sum(), 3))
    number = lambda x: int(x[0] * n * n + x[1] * n + x[2])  # noqa: E731
    cells = {kind: [] for kind in checker.KINDS}
    points = list(grid)
    for at in np.ndindex(3, 3, 3):
        cube = [number(np.array(at) + c.astype(int)) for c in CUBE]
        if at in ((0, 0, 0), (0, 0, 1)):
            cells["wedges"] += [[cube[k] for k in (0, 1, 2, 4, 5, 6)], [cube[k] for k in (0, 2, 3, 4, 6, 7)]]
        elif at == (0, 0, 2):
            points.append(np.mean([points[v] for v in cube], axis=0))
            for k, face in enumerate(checker.FACES["hexahedra"]):
                quad = [cube[int(c)] for c in face][::-1]
                if k == 0:  # on the wedges' triangles
                    cells["tets"] += [[cube[0], cube[1], cube[2], len(points) - 1]]
                    cells["tets"] += [[cube[0], cube[2], cube[3], len(points) - 1]]
                else:
                    cells["pyramids"].append([*quad, len(points) - 1])
        else:
            cells["hexahedra"].append(cube)
    return np.array(points), {kind: np.array(rows, np.int64) for kind, rows in cells.items()}


def test_a_mesh_of_all_kinds_is_sound_and_fills_the_block():
    points, cells = all_kinds()
    assert all(len(rows) for rows in cells.values())
    surface, misfits = checker.face_map(cells)
    assert misfits == 0 and checker.open_edges(surface) == 0
    assert checker.enclosed_volume(points, surface) == pytest.approx(27, rel=1e-12)
    assert sum(v.sum() for v in checker.volumes_of(points, cells).values()) == pytest.approx(27, rel=1e-12)
    for kind, rows in cells.items():
        assert (checker.scaled_jacobians(points, kind, rows) > 0).all()
        assert (checker.smallest_inside(points, kind, rows) > 0).all()


def test_the_best_shapes_have_scaled_jacobian_1():
    high = np.sqrt(0.5)
    shapes = {
        "hexahedra": CUBE,
        "tets": np.array([[1, 1, 1], [-1, -1, 1], [1, -1, -1], [-1, 1, -1]], float)[[0, 2, 1, 3]],
        "wedges": np.array([[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (0.5, np.sqrt(0.75)))]),
        "pyramids": np.array([*CUBE[:4], [0.5, 0.5, high]]),
    }
    for kind, points in shapes.items():
        signs = [checker.scaled_jacobians(points[list(order)], kind, np.arange(len(points))[None])[0]
                 for order in ([*range(len(points))], [1, 0, *range(2, len(points))])]  # fmt: skip
        assert max(signs) == pytest.approx(1), kind


@pytest.mark.parametrize("damage", ["turned", "missing", "doubled", "halved"])
def test_damage_is_found(damage):
    points, cells = all_kinds()
    if damage == "turned":
        cells["hexahedra"][5] = cells["hexahedra"][5][[1, 0, 3, 2, 5, 4, 7, 6]]
        assert checker.face_map(cells)[1] > 0
        assert (checker.scaled_jacobians(points, "hexahedra", cells["hexahedra"]) <= 0).sum() == 1
    elif damage == "missing":
        cells["hexahedra"] = np.delete(cells["hexahedra"], 12, axis=0)
        volume = checker.enclosed_volume(points, checker.face_map(cells)[0])
        assert abs(volume - 27) > 0.3
    elif damage == "doubled":
        cells["hexahedra"] = np.concatenate([cells["hexahedra"], cells["hexahedra"][12:13]])
        assert checker.face_map(cells)[1] > 0
    else:  # one pyramid on two triangles of wedges
        first, second = cells["tets"]
        cells["pyramids"] = np.concatenate([cells["pyramids"], [[*first[:3], second[2], first[3]]]])
        cells["tets"] = cells["tets"][:0]
        surface, misfits = checker.face_map(cells)
        assert misfits == 2 and len(surface.quads) == 9 * 6 - 1 + 1


def test_distances_and_creases_of_a_cube():
    triangles = np.array([[f[k] for k in order] for f in
                          [[int(c) for c in face] for face in checker.FACES["hexahedra"]]
                          for order in ([0, 1, 2], [0, 2, 3])])  # fmt: skip
    assert len(checker.creases(CUBE, triangles, 0.7)) == 12
    at = np.array([[0.5, 0.5, 1.25], [2, 0.5, 0.5], [2, 2, 0.5], [0.5, 0.5, 0.4]])
    assert checker.distances(at, CUBE[triangles]) == pytest.approx([0.25, 1, np.sqrt(2), 0.4])


def test_linear_solutions_are_exact_on_mixed_cells():
    points, cells = all_kinds()
    assert poisson.patch_error(points, cells, poisson.boundary_of(cells)) < 1e-12


def test_elements_of_tets_are_the_linear_ones():
    points = np.random.default_rng(1).normal(size=(4, 3))
    tet = np.array([[0, 1, 2, 3]] if np.linalg.det(points[1:] - points[0]) > 0 else [[0, 2, 1, 3]])
    matrix, load = elements.assemble(points, elements.as_hexahedra({"tets": tet}), lambda p: np.ones(p.shape[:-1]))
    gradients = np.linalg.inv(np.column_stack([np.ones(4), points]))[1:].T
    volume = np.linalg.det(points[tet[0, 1:]] - points[tet[0, 0]]) / 6
    assert matrix.toarray() == pytest.approx(volume * gradients @ gradients.T)
    assert load == pytest.approx(np.full(4, volume / 4))


def test_errors_fall_as_theory_says():
    solution, found = poisson.Solution(np.zeros(3), 1.0), []
    for n in (4, 8):
        x = np.linspace(0, 1, n + 1)
        points = np.stack(np.meshgrid(x, x, x, indexing="ij"), axis=-1).reshape(-1, 3)
        number = np.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1)
        corners = [number[a : a + n, b : b + n, c : c + n].ravel() for a, b, c in CUBE.astype(int)]
        cells = {"hexahedra": np.stack(corners, axis=1)}
        found.append(poisson.figures(points, cells, solution))
    assert 3.6 < found[0]["l2"] / found[1]["l2"] < 4.4 and 1.8 < found[0]["h1"] / found[1]["h1"] < 2.2
    step = 1e-5
    at = np.random.default_rng(2).uniform(-1, 1, (20, 3))
    slope = [(solution(at + step * axis) - solution(at - step * axis)) / (2 * step) for axis in np.eye(3)]
    assert solution.gradient(at) == pytest.approx(np.stack(slope, axis=-1), abs=1e-8)
    second = [(solution(at + 1e-3 * axis) + solution(at - 1e-3 * axis) - 2 * solution(at)) / 1e-6 for axis in np.eye(3)]
    assert solution.source(at) == pytest.approx(-sum(second), abs=1e-4)


def test_rows_run_and_are_kept(tmp_path):
    import gzip

    import meshio
    from octafield.domain.generators import generate
    from octafield.domain.meshing import prepare_mesh

    tets = prepare_mesh(generate("box")).tets
    (tmp_path / "hexme").mkdir()
    plain = tmp_path / "box.vtk"
    meshio.write_points_cells(plain, np.asarray(tets.vertices), [("tetra", np.asarray(tets.tets))])
    (tmp_path / "hexme" / "s01u.vtk.gz").write_bytes(gzip.compress(plain.read_bytes()))
    words = [sys.executable, "-m", "studies.hex_dominant", "rows", "-o", tmp_path / "out", "--data", tmp_path]
    for _ in range(2):
        done = subprocess.run([*words, "--factors", "2"], cwd=ROOT, capture_output=True, text=True, timeout=300)
        assert done.returncode == 0, done.stderr
    with (tmp_path / "out" / "rows.csv").open() as file:
        (row,) = csv.DictReader(file)
    assert float(row["hex_volume_share"]) == pytest.approx(1) and row["error"] == "" and row["corners_lost"] == "0"
    assert "100.0" in (tmp_path / "out" / "rows.md").read_text()
