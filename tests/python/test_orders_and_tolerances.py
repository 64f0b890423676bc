"""Orders of rows, factors, and both sides of tolerances: what a changed constant or a lost index would turn wrong
without a word."""

import math
import re
from dataclasses import replace

import numpy as np
import octafield as of
import pytest
from conftest import box_tets
from octafield.errors import InvalidInput, IoError
from octafield.fields.record import of_sizes
from octafield.frame_files import placing
from octafield.frame_files.base import FrameFile, from_axes, from_quaternions
from octafield.meshes.text_meshes import read_medit, read_tetgen
from octafield.options import FieldOptions
from octafield.study import memory
from octafield.study.plan import Run

EPS = 1e-6  # a tolerance that several readers and checks share


@pytest.fixture(scope="module")
def mesh():
    return box_tets(3)


def random_frames(count: int, seed: int = 0) -> np.ndarray:
    return np.asarray(of.frames.random_rotations(count, seed))


# ---- factors ----


@pytest.mark.parametrize("sampling", ["vertices", "tets"])
def test_energy_at_unit_speed_is_that_of_frames_that_move_by_one_per_radian(mesh, sampling):
    """sh4 moves by sqrt(20/3) per radian (DESIGN section 3): 3/20 of E, whatever has the frames."""
    frames = random_frames(len(mesh.vertices if sampling == "vertices" else mesh.tets))
    record = of.analyse(mesh, frames, sampling).record
    assert record["energy"] > 1 and record["energy_unit_speed"] == pytest.approx(0.15 * record["energy"], rel=1e-12)
    result = of.compute_field(
        mesh, FieldOptions(sampling=sampling, boundary="fixed", features="none", streamlines=0, max_iterations=2)
    )
    assert result.record["energy_unit_speed"] == pytest.approx(0.15 * result.record["energy"], rel=1e-12)


def test_singular_edges_of_frames_in_tets_are_counted_by_turns_from_the_highest_on(mesh):
    frames = random_frames(len(mesh.tets))
    turns = [edge.quarter_turns for edge in of.volume.singular_edges(mesh, frames).edges]
    record = of.analyse(mesh, frames, "tets").record
    assert len(set(turns)) > 2 and 0 in turns
    names = ["complex" if turn == 0 else f"+{turn}" if turn > 0 else str(turn) for turn in sorted(set(turns))[::-1]]
    assert list(record["singular_edges_by_turns"].items()) == [
        (name, turns.count(0 if name == "complex" else int(name))) for name in names
    ]


def test_size_ratio_is_the_largest_over_the_smallest_size(mesh):
    x, y, _ = np.asarray(mesh.vertices).T
    frames = np.asarray(of.frames.quaternion_exp(np.column_stack([0 * x, 0.3 * y, 1.5 * y])))
    for found, logs in (
        (one := of.volume.isotropic_scale(mesh, frames), one.log_scale),
        (axes := of.volume.axis_scales(mesh, frames), axes.values),
    ):
        sizes = np.exp(np.asarray(logs))
        assert sizes.max() > 1.05 * sizes.min()
        assert of_sizes(found).size_ratio == pytest.approx(sizes.max() / sizes.min(), rel=1e-12)


def run_of(**options) -> Run:
    return Run("", "", "", FieldOptions(**options), 0)


def test_memory_reserved_is_the_formula_of_the_page_and_more_than_was_measured(request):
    """Page: docs/scaling.md, whose tables were measured."""
    page = (request.path.parents[2] / "docs" / "scaling.md").read_text()
    base = re.search(r"(\d+) MB \+ tets × ", page).group(1)
    table = (request.path.parents[2] / "docs" / "frame_fields.md").read_text()
    factor = {}  # kB per tet, of the default solver; of sh4 by the others
    for name, solvers in re.findall(r"^\| `(\w+)` \|(.*)\|[^|]*\|$", table, flags=re.MULTILINE):
        by_solver = dict(re.findall(r"(\w+) \(([\d.]+)\)", solvers.split(" | ")[-1]))
        factor[name] = float(next(iter(by_solver.values())))
        if name == "sh4":
            factor |= {f"solver {solver}": float(kb) for solver, kb in by_solver.items()}
    tets_times = float(re.search(r"([\d.]+) times the bytes per tet where frames live in\s+tets", page).group(1))
    of_method = {
        name: run_of(representation=name)
        for name in ("sh4", "tensor4", "odeco", "su2", "sh469", "odeco_lengths", "geodesic", "su2_midpoint")
    }
    of_method |= {f"solver {name}": run_of(solver=name) for name in ("lbfgs", "levenberg_marquardt")}
    for name, run in of_method.items():
        megabytes = int(base) + 2e6 * factor[name] / 1e3
        assert memory.needed_mb(2e6, [run]) == pytest.approx(megabytes), name
        in_tets = replace(run, options=replace(run.options, sampling="tets"))
        assert memory.needed_mb(2e6, [in_tets]) == pytest.approx(int(base) + tets_times * (megabytes - int(base))), name
        assert (
            memory.needed_mb(2e6, [run, of_method["sh4"]])
            == memory.needed_mb(2e6, [of_method["sh4"], run])
            == pytest.approx(megabytes)
        ), name
    assert memory.needed_mb(0, []) == memory.needed_mb(1e9, []) == int(base)
    head, *rows = [
        [cell.strip() for cell in line.strip("| ").split("|")]
        for line in page.splitlines()
        if line.startswith("| ") and line.count("|") > 10
    ]
    measured = [dict(zip(head, row, strict=True)) for row in rows if len(row) == len(head) and row[0] != "---"]
    number = lambda row, name: float(row[name].replace(",", ""))
    assert len(measured) > 10
    for row in measured:
        need, reserved = (
            number(row, "process, all MB"),
            memory.needed_mb(number(row, "tets"), [of_method[row["representation"]]]),
        )
        assert 1.15 * need < reserved < 4 * need, row


# ---- rows and orders ----

MEDIT = """MeshVersionFormatted 2
Dimension 3
Vertices
4
0 0 0 0
1 0 0 0
0 1 0 0
0 0 1 0
Tetrahedra
1
1 2 3 4 7
End
"""


def test_medit_and_tetgen_rows_beyond_the_count_are_refused_with_their_line():
    assert len(read_medit(MEDIT, "a.mesh").points) == 4
    for wrong, line in (
        (MEDIT.replace("Vertices\n4", "Vertices\n3"), 8),
        (MEDIT.replace("3 4 7", "3 4 7\n2 1 3 4 7"), 12),
    ):
        with pytest.raises(IoError, match=f"line {line}: .* goes on after"):
            read_medit(wrong, "a.mesh")
    node, ele = "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n", "1 4 1\n0 0 1 2 3 5\n"
    face, edge = "1 0\n0 0 1 2\n", "1 1\n0 0 1 9\n"
    texts = {".node": node, ".ele": ele, ".face": face, ".edge": edge}
    given = lambda changed: {suffix: (text, f"a{suffix}") for suffix, text in {**texts, **changed}.items()}
    assert [kind for kind, _ in read_tetgen(given({})).cells] == ["tetra", "triangle", "line"]
    surplus = {".node": "4 9 9 9\n", ".ele": "1 0 1 3 2 5\n", ".face": "1 0 1 3\n", ".edge": "1 0 2 9\n"}
    for suffix, row in surplus.items():
        with pytest.raises(IoError, match=f"a{suffix}, line {texts[suffix].count(chr(10)) + 1}: .* goes on after"):
            read_tetgen(given({suffix: texts[suffix] + row}))


@pytest.mark.parametrize("name", ["a.frame", "a.fra", "a.ff3"])
@pytest.mark.parametrize("change", [-1, 1])
def test_text_frames_of_another_number_than_the_head_says_are_refused(mesh, tmp_path, name, change):
    """One frame less, and one more."""
    of.write_frames(tmp_path / name, mesh, random_frames(len(mesh.tets)), "tets")
    lines = (tmp_path / name).read_text().splitlines()
    rows = 3 if name == "a.fra" else 1
    end = len(lines) - (lines[-1] == "END")
    lines = lines[: end - rows] + lines[end:] if change < 0 else lines[:end] + lines[end - rows : end] + lines[end:]
    (tmp_path / name).write_text("\n".join(lines) + "\n")
    with pytest.raises(IoError, match=r"line \d+: holds .* but its head says"):
        of.read_frames(tmp_path / name, mesh)


def file_of(mesh, centres, frames, lengths):
    return FrameFile("a", "npz", frames, "tets", lengths=lengths, centres=centres)


@pytest.mark.parametrize("where", ["tets", "vertices"])
def test_frames_and_lengths_go_together_to_the_nearest_centre(mesh, where):
    points = np.asarray(mesh.vertices)
    sites = points if where == "vertices" else points[np.asarray(mesh.tets)].mean(axis=1)
    order = np.random.default_rng(1).permutation(len(sites))
    frames, lengths = random_frames(len(sites)), np.random.default_rng(2).uniform(1, 2, (len(sites), 3))
    found = placing.place(file_of(mesh, sites[order], frames[order], lengths[order]), mesh, where)
    assert found.where == where and "nearest centre" in found.notes[-1]
    np.testing.assert_array_equal(found.frames, frames)
    np.testing.assert_array_equal(found.lengths, lengths)
    few = placing.place(file_of(mesh, sites[:1], frames[:1], lengths[:1]), mesh, where)
    assert (few.frames == frames[0]).all() and (few.lengths == lengths[0]).all() and len(few.frames) == len(sites)
    assert placing.place(file_of(mesh, sites[order], frames, None), mesh, where).lengths is None


@pytest.mark.parametrize("part", [0.9, 1.1])
def test_centres_are_those_of_the_mesh_within_a_millionth_of_its_diagonal(mesh, part):
    points = np.asarray(mesh.vertices)
    centres = points[np.asarray(mesh.tets)].mean(axis=1) + [0, 0, part * EPS * math.sqrt(3)]
    found = placing.place(file_of(mesh, centres, random_frames(len(centres)), None), mesh, None)
    assert bool(found.notes) == (part > 1)


# ---- tolerances, at both sides ----


@pytest.mark.parametrize("part", [-1.1, -0.9, 0.9, 1.1])
def test_unit_quaternions_are_of_length_one_within_a_millionth(mesh, part):
    frames = random_frames(len(mesh.vertices))
    exact = of.volume.singular_graph(mesh, frames)
    frames[5] *= 1 + part * EPS
    for call in (of.volume.singular_graph, of.volume.isotropic_scale):
        if abs(part) < 1:
            call(mesh, frames)
        else:
            with pytest.raises(InvalidInput, match="row 5 .*unit within 1e-6"):
                call(mesh, frames)
    if abs(part) < 1:
        np.testing.assert_allclose(of.volume.singular_graph(mesh, frames).points, exact.points, atol=1e-12)


@pytest.mark.parametrize("part", [0.9, 1.1])
def test_changes_of_more_than_a_millionth_are_noted(tmp_path, part):
    one = np.array([[1.0, 0, 0, 0]])
    longer = from_quaternions(tmp_path / "a", "npy", "tets", one * (1 + part * EPS))
    assert bool(longer.notes) == (part > 1) and longer.frames.tolist() == one.tolist()
    stretched = from_axes(tmp_path / "a", "npy", "tets", np.diag([1, 1, 1 + part * EPS])[None])
    assert (stretched.lengths is not None) == bool(stretched.notes) == (part > 1)
    # Two axes that close up by an angle: the nearest frame's are off by half of it.
    skew = np.eye(3)
    skew[:, 1] = [math.sin(2 * part * EPS), math.cos(2 * part * EPS), 0]
    turned = from_axes(tmp_path / "a", "npy", "tets", skew[None])
    assert turned.deviation == pytest.approx(part * EPS, rel=1e-3) and bool(turned.notes) == (part > 1)


# ---- singular graphs ----


@pytest.fixture(scope="module")
def tangled(mesh):
    """Of random frames: hundreds of triangles of every type."""
    frames = random_frames(len(mesh.vertices), 4)
    return frames, of.volume.singular_graph(mesh, frames)


def test_a_singular_triangle_is_where_the_linear_interpolant_is_shortest(mesh, tangled):
    frames, graph = tangled
    points, vectors = np.asarray(mesh.vertices), np.asarray(of.frames.sh4_embed(frames))
    steps = np.array([(i, j, 60 - i - j) for i in range(61) for j in range(61 - i)]) / 60
    inside = 0
    for number, triangle in enumerate(graph.triangles):
        ids = [triangle.a, triangle.b, triangle.c]
        weights = np.linalg.lstsq(
            np.vstack([points[ids].T, np.ones(3)]), np.append(graph.points[number], 1), rcond=None
        )[0]
        assert weights.min() > -1e-12 and np.allclose(weights @ points[ids], graph.points[number], atol=1e-12)
        inside += weights.min() > 0.01
        shortest = np.linalg.norm(weights @ vectors[ids])
        assert shortest <= np.linalg.norm(steps @ vectors[ids], axis=1).min() + 1e-12
    assert 20 < inside < len(graph.triangles)


def test_a_segment_has_the_type_of_its_complex_triangle_else_of_the_first(tangled):
    _, graph = tangled
    turns = [triangle.quarter_turns for triangle in graph.triangles]
    mixed = 0
    for curve, of_curve in zip(graph.curves, graph.curve_quarter_turns, strict=True):
        for pair in zip(curve[:-1], curve[1:], strict=True):
            types = [turns[i] for i in sorted(pair) if i < len(turns)]
            assert of_curve == (0 if 0 in types else types[0]), (pair, types)
            mixed += len(set(types)) == 2
    assert mixed > 10 and graph.complex_triangles == turns.count(0)
