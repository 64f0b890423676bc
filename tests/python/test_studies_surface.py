"""The studies of surface fields run on small meshes, write what they say, and find the numbers derived elsewhere."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import octafield
import pytest

STUDIES = Path(__file__).parents[2] / "studies"
sys.path[:0] = [str(STUDIES), str(STUDIES / "benchmarks")]

import surface_fields  # noqa: E402
import surface_meshes  # noqa: E402
import surface_points  # noqa: E402


def run(script: str, output: Path, *options: str) -> Path:
    done = subprocess.run(
        [sys.executable, STUDIES / script, "-o", output, *options], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    return output


def rows(folder: Path, table: int) -> list[dict[str, str]]:
    """Of the table with this number in summary.md."""
    blocks = [block for block in (folder / "summary.md").read_text().split("\n\n") if "| ---" in block]
    lines = [line.strip("|").split("|") for line in blocks[table].splitlines() if line.startswith("|")]
    header = [word.strip() for word in lines[0]]
    return [dict(zip(header, map(str.strip, line))) for line in lines[2:]]


def is_picture(path: Path) -> bool:
    return path.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"


# ---- meshes


def area(mesh) -> float:
    return float(np.sum(octafield.surface.triangle_areas(mesh)))


@pytest.mark.parametrize(
    "mesh, triangles, euler, expected",
    [
        (surface_meshes.even_disk(0.1), None, 1, np.pi),
        (surface_meshes.sphere(8), 1280, 2, 4 * np.pi),
        (surface_meshes.sphere(12, "octahedron"), 1152, 2, 4 * np.pi),
        (surface_meshes.torus(60, 30), 3600, 0, 2 * np.pi**2),
    ],
)
def test_meshes_are_valid_and_have_the_area_of_their_surface(mesh, triangles, euler, expected):
    octafield.require_valid(mesh, closed=euler != 1)
    assert octafield.surface.euler_characteristic(mesh) == euler
    assert triangles in (None, len(mesh.triangles))
    assert area(mesh) == pytest.approx(expected, rel=0.02)


def test_a_region_with_a_hole_keeps_its_corners_and_follows_the_size_asked_for():
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1.0]])
    angle = np.linspace(0, 2 * np.pi, 400)
    circle = np.column_stack([np.cos(angle), np.sin(angle)]) / 4
    size = lambda points: 0.02 + 0.15 * abs(np.hypot(*points.T) - 0.25)
    sides = [np.linspace(a, b, 50) for a, b in zip(corners, np.roll(corners, -1, axis=0))]
    mesh = surface_meshes.region(
        [surface_meshes.resampled(sides, size), surface_meshes.resampled([circle], size)], size
    )
    assert octafield.surface.euler_characteristic(mesh) == 0
    assert area(mesh) == pytest.approx(4 - np.pi / 16, rel=2e-3)
    points, edges = np.array(mesh.vertices), np.array(octafield.surface.edge_topology(mesh).edges)
    assert all(np.min(np.linalg.norm(points[:, :2] - corner, axis=1)) < 1e-12 for corner in corners)
    ratio = np.linalg.norm(points[edges[:, 1]] - points[edges[:, 0]], axis=1) / size(points[edges].mean(axis=1)[:, :2])
    assert 0.3 < ratio.min() and ratio.max() < 2.2 and 0.8 < np.median(ratio) < 1.2


# ---- the common energy of the benchmark


def test_common_energy_is_the_dirichlet_integral_of_smooth_fields():
    mesh = surface_meshes.torus(120, 60)
    middle = np.array(mesh.vertices)[np.array(mesh.triangles)].mean(axis=1)
    along = np.column_stack([-middle[:, 1], middle[:, 0], 0 * middle[:, 0]]) / np.linalg.norm(
        middle[:, :2], axis=1, keepdims=True
    )
    exact = 32 * np.pi**2 * (2 - np.sqrt(3))  # along the curvature lines
    assert surface_fields.common_energy(mesh, octafield.FeatureGraph(), along) == pytest.approx(exact, rel=0.01)


def test_common_energy_does_not_know_which_of_the_four_directions_is_given():
    mesh = surface_meshes.torus(40, 20)
    directions = np.array(octafield.surface.triangle_directions(octafield.surface.direction_field(mesh, method="mbo")))
    turned = np.cross(octafield.surface.triangle_normals(mesh), directions)
    mixed = np.where(np.arange(len(turned))[:, None] % 2 == 0, directions, turned)
    energies = [surface_fields.common_energy(mesh, octafield.FeatureGraph(), d) for d in (directions, turned, mixed)]
    assert energies == pytest.approx([energies[0]] * 3, rel=1e-9)


# ---- where singular points are


def with_values(mesh, symmetry: int, values: np.ndarray):
    domain = octafield.surface.SurfaceDomain(mesh)
    return octafield.surface.DirectionField(symmetry=symmetry, domain=domain, values=values)


def core(z: np.ndarray) -> np.ndarray:
    """Like one of Ginzburg-Landau, times a smooth factor."""
    return z / np.sqrt(0.03 + abs(z) ** 2) * np.exp(0.3j + 0.5 * z)


def test_a_zero_in_the_plane_is_found_far_below_the_mesh_width():
    mesh, zero = surface_meshes.even_disk(0.05), 0.312 + 0.147j
    ends = np.array(mesh.vertices)[np.array(octafield.surface.edge_topology(mesh).edges)]
    middle, along = ends.mean(axis=1), ends[:, 1] - ends[:, 0]
    f = core(middle[:, 0] + 1j * middle[:, 1] - zero)
    field = with_values(mesh, 4, f * np.exp(-4j * np.arctan2(along[:, 1], along[:, 0])))
    start = np.array([[zero.real + 0.02, zero.imag - 0.015, 0]])
    assert abs(surface_points.located_in_plane(mesh, field, start, 0.15)[0] - zero) < 5e-4


@pytest.mark.parametrize("symmetry", [4, 6])
def test_a_zero_on_the_sphere_is_found_far_below_the_mesh_width(symmetry):
    """The field with f = z, of index 1/N, round a point of the sphere, made by turning the azimuthal direction."""
    mesh, axis = surface_meshes.sphere(20), np.array([0.3, -0.5, 0.81])
    axis /= np.linalg.norm(axis)
    ends = np.array(mesh.vertices)[np.array(octafield.surface.edge_topology(mesh).edges)]
    middle, along = ends.mean(axis=1), ends[:, 1] - ends[:, 0]
    normal = middle / np.linalg.norm(middle, axis=1, keepdims=True)
    first = np.cross(axis, [1.0, 0, 0]) / np.linalg.norm(np.cross(axis, [1.0, 0, 0]))
    azimuth = np.arctan2(normal @ np.cross(axis, first), normal @ first)
    east = np.cross(axis, normal)
    edge = np.arctan2(
        np.sum(np.cross(east, along) * normal, axis=1), np.sum(east * along, axis=1)
    )  # from east to the edge
    wanted = azimuth * (1 / symmetry - 1)  # from east, which itself turns once
    distance = np.linalg.norm(normal - axis, axis=1)
    field = with_values(
        mesh, symmetry, distance / np.sqrt(0.03 + distance**2) * np.exp(1j * symmetry * (wanted - edge))
    )
    start = (axis + [0.02, 0.01, 0])[None]
    assert np.linalg.norm(surface_points.located_on_sphere(mesh, field, start, 0.15)[0] - axis) < 5e-4


# ---- scripts


def test_disk_points_come_near_the_radius_of_theory(tmp_path):
    run("surface_disk.py", tmp_path, "--edges", "0.04", "--epsilons", "0.07")
    curves, measured = rows(tmp_path, 0), rows(tmp_path, 1)
    assert [float(row["least sample of the curve"]) for row in curves] == pytest.approx(
        [(3 / 11) ** (1 / 8), (5 / 17) ** (1 / 12)], abs=1e-3
    )
    for row, radius in zip(measured, (0.850, 0.903)):
        assert row["points"] == row["N"]
        assert float(row["radius"]) == pytest.approx(
            radius, abs=0.015
        )  # what is left is of epsilon, alike on every mesh
        assert float(row["largest - smallest radius"]) < 5e-4
        assert float(row["energy"]) == pytest.approx(float(row["asymptotic"]), rel=0.03)
    assert all(is_picture(tmp_path / f"surface_disk_{name}.png") for name in ("energy", "radius", "fields"))


def test_sphere_points_come_near_the_antiprism_and_the_icosahedron(tmp_path):
    run("surface_sphere.py", tmp_path, "--meshes", "10", "--seeds", "1", "--epsilons", "0.15")
    assert [float(row["at twist (degrees)"]) for row in rows(tmp_path, 0)] == [45, 45]
    for row in rows(tmp_path, 1):
        symmetry = int(row["N"])
        assert int(row["points"]) == 2 * symmetry and float(row["index sum"]) == 2
        assert float(row["-sum log"]) == pytest.approx({4: -10.428018, 6: -21.606145}[symmetry], abs=1e-3)
    assert is_picture(tmp_path / "surface_sphere_4.png") and is_picture(tmp_path / "surface_sphere_6.png")


def test_torus_has_a_state_of_each_number_of_points(tmp_path):
    run("surface_torus.py", tmp_path, "--around", "48", "--epsilons", "0.12", "--points", "0,8,12")
    states = {row["points asked"]: row for row in rows(tmp_path, 0)}
    assert [row["points found, + and -"] for row in states.values()] == ["0 + 0", "4 + 4", "6 + 6"]
    # On 20,736 triangles: 75.85, 49.48, 51.36.
    assert [float(row["energy"]) for row in states.values()] == pytest.approx([75.85, 49.48, 51.36], rel=0.03)
    assert all(float(row["of the constraints"]) < 0.02 for row in states.values())


def test_laplacian_smoothing_of_the_disk_is_r_to_the_fourth_and_ginzburg_landau_keeps_the_norm(tmp_path):
    run("surface_norm.py", tmp_path, "--edge", "0.05", "--epsilon", "0.1")
    laplacian, descent = rows(tmp_path, 0)
    assert float(laplacian["area with abs(f) < 1/2, %"]) == pytest.approx(100 * np.sqrt(0.5), abs=1)
    assert float(laplacian["Dirichlet"]) == pytest.approx(4 * np.pi, rel=3e-3)
    assert float(laplacian["largest error of r^4"]) < 0.005
    assert float(descent["area with abs(f) < 1/2, %"]) < 5
    assert [(row["points +1/4"], row["-1/4"], row["index sum"]) for row in rows(tmp_path, 1)] == [("5", "1", "1")] * 2
    assert is_picture(tmp_path / "surface_norm_disk.png")


def test_weak_boundaries_let_points_sit_on_the_aerofoil(tmp_path):
    run("surface_aerofoil.py", tmp_path, "--size", "0.002", "--lengths", "0.003", "--drawn", "0.003")
    strong, weak = rows(tmp_path, 0)
    assert strong["index sum"] == weak["index sum"] == strong["Euler characteristic"] == "-2"
    for name in ("slat", "main", "flap"):
        assert "on it" not in strong[f"at the nose of the {name}"]
        assert weak[f"at the nose of the {name}"] == "-1/4 on it, -1/4 on it"
    assert float(weak["energy"]) < float(strong["energy"])


def test_index_sums_are_exact_on_a_jagged_coast(tmp_path):
    run("surface_coast.py", tmp_path, "--edge", "0.04", "--levels", "4")
    table = rows(tmp_path, 0)
    assert {row["index sum"] for row in table} == {"-2"}  # three islands
    inside = {row["method"]: int(row["points inside, +"]) + int(row["-"]) for row in table}
    assert inside["gl, eps 2 h"] <= inside["eigenvector (harmonic)"]


def test_the_benchmark_tells_every_method_s_points_and_energy(tmp_path):
    run("benchmarks/surface_fields.py", tmp_path, "--surfaces", "sphere", "--sizes", "700")
    table = {row["method"]: row for row in rows(tmp_path, 0)}
    assert set(table) == {*surface_fields.OURS, surface_fields.HELD}
    assert all(
        row["singular points"] == "8" and float(row["energy"]) < 120 and row["note"] == "" for row in table.values()
    )


# ---- reliability


def test_the_study_of_reliability_tells_right_sums_and_refused_files(tmp_path):
    inputs = tmp_path / "inputs"
    inputs.mkdir()
    octafield.write_surface(surface_meshes.sphere(4), inputs / "sphere.obj")
    octafield.write_surface(surface_meshes.torus(16, 8), inputs / "torus.ply")
    (inputs / "notes.txt").write_text("no surface")
    (inputs / "bad.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
    script = [
        sys.executable,
        STUDIES / "surface_reliability.py",
        inputs,
        "-o",
        tmp_path / "out",
        "--symmetries",
        "4",
        "1",
    ]
    done = subprocess.run(script, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    table = rows(tmp_path / "out", 0)
    assert len(table) == 2 * 2 * 3 and {line["agree"] for line in table} == {"yes"}
    assert {(line["file"], line["chi"]) for line in table} == {("sphere.obj", "2"), ("torus.ply", "0")}
    (refused,) = rows(tmp_path / "out", 1)
    assert refused["file"] == "bad.obj" and refused["kind"] == "degenerate_triangle"


def test_non_orthogonal_crosses_have_the_points_of_the_thesis(tmp_path):
    run("surface_non_orthogonal.py", tmp_path, "--edge", "0.08")
    found, corners = {}, {}
    for row in rows(tmp_path, 0):
        assert row["sum is chi"] == "yes"
        if row["method, second line"] == "angles, fixed":
            found[row["domain"]], corners[row["domain"]] = row["points inside"], row["corners"]
    for degrees in (50, 46, 44, 40, 30, 20):
        assert found[f"right trapezoid, {degrees} degrees"] == ("none" if degrees > 45 else "1 of t = +1")
    assert found["diamond, 60 degrees"] == found["diamond, 28.65 degrees, one quad at every corner"] == "none"
    assert found["diamond, 28.65 degrees, quads by angle"] == "2 of t = +1"
    assert found["disk"] == "4 of t = +1"
    assert (corners["shuriken"], found["shuriken"]) == ("15 of t = +1", "11 of t = -1")
    assert corners["NACA 2412 in a square"] == "1 of t = -2, 4 of t = +1"
    assert found["NACA 2412 in a square"] == "2 of t = -1"
    for name in ("trapezoids", "diamond", "disk", "shuriken", "aerofoil"):
        assert is_picture(tmp_path / f"non_orthogonal_{name}.png")


def test_quads_of_hexme_have_a_row_per_file_with_the_figures_or_the_error(tmp_path):
    command = [sys.executable, "-m", "studies.quad_layouts", "-o", tmp_path]
    data = STUDIES.parents[1] / "shared" / "data"
    if not (data / "hexme").is_dir():
        pytest.skip("no data")
    (tmp_path / "data" / "hexme").mkdir(parents=True)
    for name in ("s01c", "s16c"):
        (tmp_path / "data" / "hexme" / f"{name}.vtk.gz").symlink_to((data / "hexme" / f"{name}.vtk.gz").resolve())
    (tmp_path / "data" / "hexme" / "s99c.vtk.gz").write_bytes(b"no mesh")
    subprocess.run([*command, "--data", tmp_path / "data", "--quads", "24"], cwd=STUDIES.parent, check=True)
    text = (tmp_path / "hexme.md").read_text()
    assert text.startswith("3 surfaces, 2 meshes, 2 of them")
    assert "2 with at most 4 times the fewest blocks" in text
    cube, torus, broken = ([word.strip() for word in line.split("|")[1:-1]] for line in text.splitlines()[4:])
    assert (
        cube[0] == "s01c"
        and cube[4:10] == ["6", "6", "1.0", "6", "1.0", "8"]
        and float(cube[11]) > 0.99
        and cube[-1] == ""
    )
    assert torus[0] == "s16c" and torus[4:10] == ["1", "1", "1.0", "1", "1.0", "0"]
    assert broken[0] == "s99c" and "s99c.vtk.gz" in broken[-1]
    subprocess.run(
        [*command[:-1], tmp_path / "free", "--only", "s01c", "--quads", "24", "--axes", "free"],
        cwd=STUDIES.parent,
        check=True,
    )
    assert (tmp_path / "free" / "hexme.md").read_text().splitlines()[4].startswith("| s01c |")


def test_the_cost_of_quad_layouts_has_a_row_per_sphere(tmp_path):
    command = [sys.executable, "-m", "studies.quad_layouts", "-o", tmp_path, "--cost", "2,3", "--quads", "150"]
    subprocess.run(command, cwd=STUDIES.parent, check=True)
    lines = [line.split("|")[1:-1] for line in (tmp_path / "cost.md").read_text().splitlines()[2:4]]
    assert [line[0].strip() for line in lines] == ["320", "1,280"]
    assert all(100 < int(line[1]) < 220 for line in lines)


def test_the_cost_of_non_orthogonal_fields_has_a_row_per_edge_length(tmp_path):
    run("surface_non_orthogonal.py", tmp_path, "--cost", "0.2,0.1")
    lines = [line.split("|")[1:-1] for line in (tmp_path / "cost.md").read_text().splitlines()[2:]]
    (coarse, fine) = ([word.strip() for word in line] for line in lines)
    assert (coarse[0], fine[0]) == ("0.2", "0.1") and 2.5 * int(coarse[1]) < int(fine[1]) < 5 * int(coarse[1])
    assert coarse[3] == coarse[5] == "" and all(float(fine[k]) >= 0 for k in (2, 4))


def test_the_cost_of_quads_of_wedges_has_a_row_per_edge_length(tmp_path):
    run("surface_non_orthogonal.py", tmp_path, "--wedges-cost", "0.2,0.1")
    lines = [line.split("|")[1:-1] for line in (tmp_path / "wedges_cost.md").read_text().splitlines()[2:]]
    coarse, fine = (int(line[0].replace(",", "")) for line in lines)
    assert 3 * coarse < fine < 5 * coarse and all(float(seconds) >= 0 for line in lines for seconds in line[1:])


def test_quads_of_wedges_are_as_good_as_their_corners_with_free_axes(tmp_path):
    run("surface_non_orthogonal.py", tmp_path, "--wedges", "15,30")
    rows = [line.split("|")[1:-1] for line in (tmp_path / "wedges.md").read_text().splitlines()[2:10]]
    sharp, lines = rows[::2], rows[1::2]
    for line in sharp:  # a quad that its corner keeps below 0.3 does not cost the others
        least, _, mean = map(float, line[7].split(","))
        assert abs(least - np.sin(np.pi / 12)) < 0.01
        assert float(line[6]) < 7 and (mean > 0.95 or line[0].strip() == "parallelogram")
    assert [line[0].strip() for line in lines] == ["sector", "right trapezoid", "parallelogram", "prism"]
    for line in lines:
        assert float(line[7].split(",")[0]) > np.sin(np.pi / 6) - 0.05
        assert abs(int(line[5]) - 400) < 40
        if "prism" not in line[0]:
            assert float(line[3]) < 1e-9
    assert [line[4].strip() for line in lines[2:]] == ["none", "2"]
    for name in ("wedges", "prisms"):
        assert is_picture(tmp_path / f"non_orthogonal_{name}.png")


def test_gmsh_quads_are_judged_beside_ours(tmp_path):
    pytest.importorskip("gmsh")
    command = [sys.executable, "-m", "studies.quad_layouts", "-o", tmp_path, "--gmsh", "--only", "s01u"]
    if not (STUDIES.parents[1] / "shared" / "data" / "hexme").is_dir():
        pytest.skip("no data")
    subprocess.run([*command, "--quads", "300"], cwd=STUDIES.parent, check=True)
    lines = [line.split("|")[1:-1] for line in (tmp_path / "gmsh.md").read_text().splitlines()[2:]]
    gmsh, ours = ([word.strip() for word in line] for line in lines)
    assert (gmsh[1], ours[1]) == ("Gmsh, CAD", "octafield") and gmsh[-1] == ours[-1] == ""
    assert abs(int(gmsh[2]) - 300) < 90 and abs(int(ours[2]) - int(gmsh[2])) < 60
    for row in (gmsh, ours):  # a cube in squares, however it is turned
        assert row[3:7] == ["0"] * 4 and row[7] == "1.00" and float(row[9]) == 0
