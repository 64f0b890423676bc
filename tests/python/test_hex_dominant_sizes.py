"""Sizes of cells: functions, numbers at vertices, points with sizes, files; and what is wrong with some."""

import numpy as np
import octafield as of
import pytest
from hex_mesh_checks import require_conforming
from octafield.domain.generators import generate
from octafield.domain.inputs import Input
from octafield.hexdom.sizes import size_function


@pytest.fixture(scope="module")
def box():
    return of.compute_field(generate("box", x=3.0), of.FieldOptions(edge_length=0.35))


@pytest.fixture(scope="module")
def given(box):
    return Input("a box", box.tets.surface.mesh, box.tets)


def lengths_along(mesh):
    """Middle and length of the edges along x."""
    cells = np.asarray(mesh.vertices)[np.asarray(mesh.hexahedra)]
    middles, sizes = cells.mean(axis=1), np.cbrt(np.abs(np.linalg.det(cells[:, [1, 3, 4]] - cells[:, :1])))
    return middles[:, 0], sizes


def graded(points):
    return 0.15 + 0.1 * points[:, 0]


def test_cells_get_the_sizes_of_a_function(box):
    result = of.compute_hex_dominant(box, sizes=graded)
    require_conforming(result.mesh)
    x, sizes = lengths_along(result.mesh)
    assert np.median(sizes[x > 2.25]) > 1.4 * np.median(sizes[x < 0.75])
    assert result.record.edge_to_size.median == pytest.approx(1, rel=0.15)
    assert result.record.options["sizes"] == "function graded"


def test_numbers_at_vertices_points_with_sizes_and_files_of_both_say_the_same(box, given, tmp_path):
    vertices = np.asarray(box.tets.vertices)
    numbers = graded(vertices)
    rows = np.column_stack([vertices, numbers])
    np.save(tmp_path / "numbers.npy", numbers)
    np.savetxt(tmp_path / "numbers.txt", numbers, fmt="%.17g", header="sizes")
    np.savetxt(tmp_path / "rows.csv", rows, fmt="%.17g", delimiter=",")
    every = [numbers, numbers.tolist(), rows, *sorted(tmp_path.iterdir()), str(tmp_path / "rows.csv")]
    for sizes in every:
        assert np.array_equal(size_function(sizes, given)(vertices), numbers)
    between = size_function(rows, given)(np.array([[1.5, 0.5, 0.5]]))
    assert between == pytest.approx([0.3], rel=0.2)


def test_one_point_gives_one_size_everywhere(given):
    assert size_function([[0, 0, 0, 0.4]], given)(np.array([[0, 0, 0], [9.0, 9, 9]])).tolist() == [0.4, 0.4]


def test_sizes_at_the_vertices_of_a_surface_reach_the_tets_inside():
    surface = generate("box")
    result = of.compute_hex_dominant(surface, sizes=np.full(len(surface.vertices), 0.25))
    assert len(result.mesh.hexahedra) == 64 and result.record.edge_length.target == pytest.approx(0.25)


def test_tets_of_a_surface_get_the_edge_length_of_the_cells_unless_they_have_their_own():
    cells = of.HexMeshOptions(edge_length=0.5)
    alike = of.compute_hex_dominant(generate("box"), hex_options=cells)
    own = of.compute_hex_dominant(generate("box"), of.FieldOptions(edge_length=0.25), hex_options=cells)
    assert len(alike.mesh.hexahedra) == len(own.mesh.hexahedra) == 8
    assert alike.record.field.edge_length > 1.5 * own.record.field.edge_length


def test_a_number_of_cells_is_that_of_cubes_in_the_volume():
    result = of.compute_hex_dominant(generate("box", x=2.0), hex_options=of.HexMeshOptions(cells=16))
    assert len(result.mesh.hexahedra) == 16


@pytest.mark.parametrize(
    ("sizes", "words"),
    [
        (lambda points: 0.3, "array of shape ()"),
        (lambda points: np.zeros(len(points)), "not above 0"),
        (lambda points: [None] * len(points), "not an array of numbers"),
        ([0.1, 0.2], "2 sizes, but a box has"),
        (np.ones((5, 3)), "shape (5, 3)"),
        ([], "holds no sizes"),
        ([[0, 0, 0, -1.0]], "not above 0"),
        ([[0, np.nan, 0, 1.0]], "row 0 (from 0) is not finite"),
    ],
)
def test_bad_sizes_are_named(given, sizes, words):
    with pytest.raises(of.InvalidInput) as caught:
        size_function(sizes, given)(np.zeros((4, 3)))
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"0.1\n0.2 0.3\n", "not a file of sizes"),
        (b"a b c d\n", "not a file of sizes"),
        (b"# nothing\n", "holds no sizes"),
        (b"", "holds no sizes"),
        (b"\x93NUMPY\x01\x00cut", "not a file of sizes"),
        (b"\xff\xfe\x00", "not a file of sizes"),
        (b"0 0 0 0\n", "not above 0"),
        (b"1 2 3\n", "shape (1, 3)"),
    ],
)
def test_bad_files_of_sizes_are_named(given, tmp_path, content, words):
    path = tmp_path / "sizes.txt"
    path.write_bytes(content)
    with pytest.raises((of.InvalidInput, of.IoError)) as caught:
        size_function(path, given)
    assert words in str(caught.value) and str(path) in str(caught.value)


def test_an_absent_file_of_sizes_is_named(given, tmp_path):
    with pytest.raises(of.IoError, match="none.npy"):
        size_function(tmp_path / "none.npy", given)


def test_sizes_and_an_edge_length_exclude_each_other(box):
    with pytest.raises(of.InvalidInput, match="leave one out"):
        of.compute_hex_dominant(box, sizes=graded, hex_options=of.HexMeshOptions(cells=8))
