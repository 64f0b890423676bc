"""Medit and TetGen text, row by row: what each section is read as, and the line that each defect is told with."""

import re

import numpy as np
import pytest
from octafield.errors import IoError
from octafield.meshes.text_meshes import read_medit, read_tetgen

POINTS = 30
HEAD = f"MeshVersionFormatted 2\nDimension 3\nVertices\n{POINTS}\n" + "".join(
    f"{i} {2 * i} {3 * i} 7\n" for i in range(POINTS)
)
FIRST = HEAD.count("\n") + 1  # line of what follows the head

# Keyword: meshio's name of the cell and its vertices. Medit's manual of .mesh and libMeshb's keywords.
SECTIONS = {
    "Edges": ("line", 2), "Triangles": ("triangle", 3), "Quadrilaterals": ("quad", 4), "Tetrahedra": ("tetra", 4),
    "Prisms": ("wedge", 6),
    "Pyramids": ("pyramid", 5), "Hexahedra": ("hexahedron", 8), "Hexaedra": ("hexahedron", 8), "EdgesP2": ("line3", 3),
    "TrianglesP2": ("triangle6", 6),
    "QuadrilateralsQ2": ("quad9", 9), "TetrahedraP2": ("tetra10", 10), "PrismsP2": ("wedge18", 18),
    "PyramidsP2": ("pyramid14", 14),
    "HexahedraQ2": ("hexahedron27", 27), "EdgesP3": ("line4", 4), "TrianglesP3": ("triangle10", 10),
    "TetrahedraP3": ("tetra20", 20),
}  # fmt: skip


@pytest.mark.parametrize("section", SECTIONS)
def test_a_row_of_every_medit_section_is_its_vertices_from_0_and_its_reference(section):
    kind, corners = SECTIONS[section]
    rows = np.add.outer([1, 2], np.arange(corners))
    text = "".join(" ".join(map(str, [*row, 40 + k])) + "\n" for k, row in enumerate(rows))
    mesh = read_medit(f"{HEAD}{section}\n2\n{text}End\n", "a.mesh")
    assert mesh.points.tolist() == [[i, 2 * i, 3 * i] for i in range(POINTS)]
    ((found, cells),) = mesh.cells
    assert found == kind and cells.tolist() == (rows - 1).tolist() and cells.dtype == np.int64
    assert [references.tolist() for references in mesh.references] == [[40, 41]]
    assert mesh.ridges is None and mesh.notes == []


def test_ridges_are_rows_of_edges_from_0_and_left_out_where_edges_are_curved():
    edges = "Edges\n3\n1 2 0\n2 3 0\n3 4 0\nRidges\n2\n1\n3\n"
    assert read_medit(f"{HEAD}{edges}End\n", "a.mesh").ridges.tolist() == [0, 2]
    curved = "EdgesP2\n1\n1 2 3 0\n"
    for text in (edges[: edges.index("Ridges")], edges[edges.index("Ridges") :], edges + curved):
        assert read_medit(f"{HEAD}{text}End\n", "a.mesh").ridges is None


def test_a_medit_file_without_end_is_noted_and_dimension_and_remarks_are_optional():
    cut = read_medit(HEAD + "Edges 1\n1 2 0\n", "a.mesh")
    assert cut.notes == ["the file does not end with End, but with Edges: it may be cut"]
    remarked = (
        HEAD.replace("Dimension 3\n", "")
        .replace("Vertices\n", "  Vertices # points\n")
        .replace("0 0 0 7", "0 0 0 7 # Edges 5")
    )
    found = read_medit(remarked + "Unknown 3 4\nEnd", "a.mesh")
    assert found.points.tolist() == cut.points.tolist() and found.cells == [] and found.notes == []


EDGES = "Edges\n2\n1 2 5\n"  # the second row follows
MEDIT_DEFECTS = [
    ("Vertices 0", "line 1: a Medit .mesh file begins with MeshVersionFormatted"),
    ("", "line 1: a Medit .mesh file begins with"),
    ("MeshVersionFormatted 2\nEnd\n", "a.mesh: has no section Vertices"),
    (HEAD.replace("Dimension 3", "Dimension\n2"), "line 2: points of dimension 2; 3 is needed"),
    (HEAD.replace("Dimension 3", "Dimension"), "line 2: Dimension ends after 0 of 1 rows of 1 numbers"),
    (HEAD.replace("\n1 2 3 7", "\n1 inf 3 7"), "line 6: the coordinates of point 2 (from 1) are not finite"),
    (HEAD + EDGES + "1 x 5\n", f"line {FIRST + 3}: no number in Edges: 'x'"),
    (HEAD + EDGES + "1 2 5\n1 2 5\n1 2 5\n", f"line {FIRST + 4}: Edges goes on after the 2 rows of 3 numbers"),
    (HEAD + EDGES + "1 2\n\nEnd", f"line {FIRST + 3}: Edges ends after 1 of 2 rows of 3 numbers"),
    (HEAD + EDGES + "1 2.5 5\n", f"line {FIRST + 3}: Edges holds a number that is no id"),
    (HEAD + EDGES + "1 2 1e17\n", f"line {FIRST + 3}: Edges holds a number that is no id"),
    (HEAD + EDGES + "0 2 5\n", f"line {FIRST + 3}: row 2 of Edges names a number outside 1 .. 30"),
    (HEAD + EDGES + "30 31 5\n", f"line {FIRST + 3}: row 2 of Edges names a number outside 1 .. 30"),
    (HEAD + "Edges\n", f"line {FIRST}: Edges is not followed by a count"),
    (HEAD + "Edges\n1.5\n", f"line {FIRST}: Edges is not followed by a count"),
    (HEAD + "Edges\n-1\n", f"line {FIRST}: Edges is not followed by a count"),
    (HEAD + "Edges\n1e19\n", f"line {FIRST}: Edges is not followed by a count"),
    (HEAD + "Edges\n9223372036854775808\n", f"line {FIRST}: Edges is not followed by a count"),
    (HEAD + "Edges\nnan\n", f"line {FIRST}: Edges is not followed by a count"),
    (HEAD + "Edges\n1\n1 2 0\nRidges\n2\n1\n2\n", f"line {FIRST + 6}: row 2 of Ridges names a number outside 1 .. 1"),
    (HEAD + "Edges\n1\n1 2 0\nRidges\n1\n0\n", f"line {FIRST + 5}: row 1 of Ridges names a number outside 1 .. 1"),
    (HEAD + "Edges\n1\n1 2 0\nRidges\n1\n0.5\n", f"line {FIRST + 5}: Ridges holds a number that is no id"),
]


@pytest.mark.parametrize(("text", "message"), MEDIT_DEFECTS)
def test_every_defect_of_a_medit_file_is_told_with_its_line(text, message):
    with pytest.raises(IoError, match=re.escape(message)):
        read_medit(text, "a.mesh")


def test_ids_and_references_are_whole_up_to_two_to_the_53():
    largest = 2**53 - 1
    assert read_medit(f"{HEAD}Edges 2\n1 30 {largest}\n30 1 -{largest}\nEnd\n", "a.mesh").references[0].tolist() == [
        largest,
        -largest,
    ]
    with pytest.raises(IoError, match="holds a number that is no id"):
        read_medit(f"{HEAD}Edges 1\n1 30 {2**53}\nEnd\n", "a.mesh")
    assert len(read_medit(f"{HEAD}Edges 0\nEnd\n", "a.mesh").cells[0][1]) == 0


# ---- TetGen ----


def files(base: int = 1, **changed: str) -> dict[str, tuple[str, str]]:
    """Five points, two tets of regions 4 and 6, three faces and two edges, with markers."""
    b = base
    texts = {
        "node": (
            f"# points\n5 3 1 1\n{b} 0 0 0 9 1\n{b + 1} 1 0 0 9 1\n{b + 2} 0 1 0 9 1\n{b + 3} 0 0 1 9 1\n{b + 4} 1 1 1"
            " 9 1\n"
        ),
        "ele": f"2 4 1\n{b} {b} {b + 1} {b + 2} {b + 3} 4\n{b + 1} {b + 1} {b + 2} {b + 3} {b + 4} 6\n",
        "face": f"3 1\n{b} {b} {b + 1} {b + 2} 11\n{b + 1} {b} {b + 2} {b + 3} 12\n{b + 2} {b + 1} {b + 2} {b + 4} 0\n",
        "edge": f"2 1\n{b} {b} {b + 1} 3\n{b + 1} {b + 1} {b + 4} 0\n",
    }
    texts |= changed
    return {f".{suffix}": (text, f"a.{suffix}") for suffix, text in texts.items()}


@pytest.mark.parametrize("base", [0, 1, 5])
def test_tetgen_rows_are_points_tets_with_regions_faces_with_markers_and_the_marked_edges(base):
    mesh = read_tetgen(files(base))
    assert mesh.points.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]
    assert [(kind, cells.tolist()) for kind, cells in mesh.cells] == [
        ("tetra", [[0, 1, 2, 3], [1, 2, 3, 4]]), ("triangle", [[0, 1, 2], [0, 2, 3], [1, 2, 4]]), ("line", [[0, 1]])
    ]  # fmt: skip
    assert [references.tolist() for references in mesh.references] == [[4, 6], [11, 12, 0], [3]]
    assert mesh.notes == [] and mesh.ridges is None


def test_one_marker_of_faces_tells_none_apart_and_edges_without_markers_are_all_features():
    one = read_tetgen(files(face="2 1\n1 1 2 3 -1\n2 1 3 4 7\n", edge="2 0\n1 1 2\n2 2 5\n"))
    assert [references.tolist() for references in one.references] == [[4, 6], [0, 0], [0, 0]]
    assert one.cells[2][1].tolist() == [[0, 1], [1, 4]]
    two = read_tetgen(files(face="3 1\n1 1 2 3 -1\n2 1 3 4 7\n3 2 3 5 8\n", edge="0 1\n"))
    assert two.references[1].tolist() == [-1, 7, 8] and two.cells[2][1].shape == (0, 2)


def test_regions_that_are_no_whole_numbers_are_numbered_from_1_in_their_order():
    assert read_tetgen(files(ele="2 4 1\n1 1 2 3 4 0.5\n2 2 3 4 5 -2\n")).references[0].tolist() == [2, 1]
    assert read_tetgen(files(ele="2 4 0\n1 1 2 3 4\n2 2 3 4 5\n")).references[0].tolist() == [0, 0]
    assert read_tetgen(files(ele="2 4 2\n1 1 2 3 4 8 3\n2 2 3 4 5 9 3\n")).references[0].tolist() == [8, 9]


def test_quadratic_tets_faces_and_edges_are_read_by_their_corners():
    middles = "1 1 1 1 1 1"
    ele = f"2 10 1\n1 1 2 3 4 {middles} 4\n2 2 3 4 5 {middles} 6\n"
    face = "3 1\n1 1 2 3 5 5 5 11\n2 1 3 4 5 5 5 12\n3 2 3 5 5 5 5 0\n"
    quadratic = read_tetgen(files(ele=ele, face=face, edge="2 1\n1 1 2 4 3\n2 2 5 4 0\n"))
    linear = read_tetgen(files())
    for (kind, cells), (_, expected), refs, wanted in zip(
        quadratic.cells, linear.cells, quadratic.references, linear.references, strict=True
    ):
        assert cells.tolist() == expected.tolist() and refs.tolist() == wanted.tolist(), kind
    assert quadratic.notes == ["cells of higher order were read by their corners, with straight edges: 2 of type tetra"]
    corners_alone = read_tetgen(files(ele=ele))  # TetGen writes them without -nn, too
    assert [cells.tolist() for _, cells in corners_alone.cells] == [cells.tolist() for _, cells in linear.cells]


def test_columns_that_the_head_does_not_tell_are_left_out():
    wide = read_tetgen(
        files(face="3 1\n1 1 2 3 11 1 2\n2 1 3 4 12 1 -1\n\n3 2 3 5 0 2 -1\n", edge="2 0\n1 1 2 7 8\n2 2 5 9 9\n")
    )
    assert wide.cells[1][1].tolist() == [[0, 1, 2], [0, 2, 3], [1, 2, 4]] and wide.references[1].tolist() == [11, 12, 0]
    assert wide.cells[2][1].tolist() == [[0, 1], [1, 4]] and wide.references[2].tolist() == [0, 0]


POINT = "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n"
TETGEN_DEFECTS = [
    ("node", "", "a.node: does not begin with the number of points and what each row holds"),
    ("node", "5 3 0\n", "a.node: does not begin with the number of points"),
    ("node", "five 3 0 0\n", "a.node: does not begin with the number of points"),
    ("node", POINT.replace("5 3", "5 2", 1), "a.node: dimension is 2; 3 is needed"),
    ("node", POINT.replace("3 0 0\n1", "3 0 -1\n1"), "its head tells of -1 attributes or markers"),
    ("node", POINT.replace("3 0 0\n1", "3 -2 1\n1"), "its head tells of -2 attributes or markers"),
    ("node", "-1 3 0 0\n", "a.node, line 1: the number of points is -1"),
    ("node", POINT.replace("3 0 1 0", "4 0 1 0"), "a.node: row 3 of the points has number 4; number them in order"),
    (
        "node",
        POINT.replace("\n3 0 1", "\n3 0 nan"),
        "a.node, line 4: the coordinates of point 3 (from 1) are not finite",
    ),
    ("node", POINT.replace("\n3 0 1", "\n3 0 y"), "a.node, line 4: no number in points: 'y'"),
    ("node", POINT.replace("1 1 1", "1 1"), "a.node, line 6: points ends after 4 of 5 rows of 4 numbers"),
    ("node", POINT + "6 0 0 0\n", "a.node, line 7: points goes on after the 5 rows of 4 numbers"),
    ("ele", "2 4\n", "a.ele: does not begin with the number of tets and what each row holds"),
    ("ele", "1 5 0\n1 1 2 3 4 5\n", "a.ele: vertices per tet is 5; 4 is needed"),
    ("ele", "1 4 -1\n1 1 2 3 4\n", "its head tells of -1 attributes or markers"),
    ("ele", "2 4 0\n1 1 2 3 4\n2 2 3 4.5 5\n", "a.ele, line 3: a vertex id is no whole number"),
    ("ele", "2 4 0\n1 1 2 3 4\n2 2 3 1e17 5\n", "a.ele, line 3: a vertex id is no whole number"),
    ("ele", f"2 4 0\n1 1 2 3 4\n2 2 3 {2**53} 5\n", "a.ele, line 3: a vertex id is no whole number"),
    ("ele", "2 4 0\n1 1 2 3 4\n2 2 3 4 6\n", "a.ele, line 3: a tet names a point outside 1 .. 5, the ids of a.node"),
    ("ele", "2 4 0\n1 1 2 3 4\n2 0 3 4 5\n", "a.ele, line 3: a tet names a point outside 1 .. 5"),
    ("ele", "2 4 0\n1 1 2 3 4\n2 2 3 4\n", "a.ele, line 3: tets ends after 1 of 2 rows of 5 numbers"),
    ("face", "", "a.face: does not begin with the number of faces and whether they have markers"),
    ("face", "3\n", "a.face: does not begin with the number of faces"),
    ("face", "-1 1\n1 1 2 3 1\n", "a.face, line 1: the number of faces is -1"),
    ("face", "2 1\n1 1 2 3 1\n2 1 2 6 1\n", "a.face, line 3: row 2 of the faces names a point outside 1 .. 5"),
    ("face", "2 1\n1 1 2 3 1\n2 0 2 3 1\n", "a.face, line 3: row 2 of the faces names a point outside 1 .. 5"),
    ("face", "2 1\n1 1 2 3 1\n2 1 2.5 3 1\n", "a.face, line 3: row 2 of the faces names a point outside 1 .. 5"),
    ("face", "2 1\n1 1 2 3 1\n2 1 2 3 1e16\n", "a.face, line 3: row 2 of the faces names a point outside"),
    ("face", "2 1\n1 1 2 3 1\n2 1 2 3\n", "a.face, line 3: faces ends after 1 of 2 rows of 5 numbers"),
    ("edge", "x 1\n", "a.edge: does not begin with the number of edges and whether they have markers"),
    ("edge", "2 1\n1 1 2 3\n2 2 6 3\n", "a.edge, line 3: row 2 of the edges names a point outside 1 .. 5"),
]


@pytest.mark.parametrize(("suffix", "text", "message"), TETGEN_DEFECTS)
def test_every_defect_of_a_tetgen_file_is_told_with_its_line(suffix, text, message):
    with pytest.raises(IoError, match=re.escape(message)):
        read_tetgen(files(**{suffix: text}))


BROKEN = [  # one number per line: the line is that of the number that begins the row
    (
        "node",
        "5 3 0 0\n" + "\n".join("1 0 0 0 2 1 nan 0 3 0 1 0 4 0 0 1 5 1 1 1".split()),
        "a.node, line 6: the coordinates of point 2",
    ),
    ("ele", "2 4 0\n" + "\n".join("1 1 2 3 4 2 2.5 3 4 5".split()), "a.ele, line 7: a vertex id is no whole number"),
    ("ele", "2 4 0\n" + "\n".join("1 1 2 3 4 2 2 3 4 6".split()), "a.ele, line 7: a tet names a point outside"),
    (
        "face",
        "2 1\n1 1 2 3 1\n" + "\n".join("2 1 2 6 1".split()),
        "a.face, line 3: row 2 of the faces names a point outside",
    ),
    ("edge", "2 0\n1 1 2\n" + "\n".join("2 0 2".split()), "a.edge, line 3: row 2 of the edges names a point outside"),
    ("ele", "2\n4\n0\n1 1 2 3 4 2 2 3 4 5\n7 1 2 3 4\n", "a.ele, line 5: tets goes on after the 2 rows"),
]


@pytest.mark.parametrize(("suffix", "text", "message"), BROKEN)
def test_the_line_of_a_row_is_where_its_first_number_is(suffix, text, message):
    with pytest.raises(IoError, match=re.escape(message)):
        read_tetgen(files(**{suffix: text}))
    broken = HEAD + "Edges\n2\n1 2 5 1\n2\n1e20\nEnd\n"
    for text, what in (
        (broken, "holds a number that is no id"),
        (broken.replace("\n2\n1e20", "\n99\n5"), "row 2 of Edges names a number outside"),
    ):
        with pytest.raises(IoError, match=re.escape(f"line {FIRST + 2}: ") + ".*" + what):
            read_medit(text, "a.mesh")


@pytest.mark.parametrize("bad", ["nan 0 0", "0 nan 0", "0 0 inf"])
def test_every_coordinate_is_finite_and_attributes_may_be_anything(bad):
    with pytest.raises(IoError, match=r"a.node, line 3: the coordinates of point 2 \(from 1\)"):
        read_tetgen(files(node=POINT.replace("2 1 0 0", f"2 {bad}")))
    with pytest.raises(IoError, match=r"a.mesh, line 6: the coordinates of point 2"):
        read_medit(HEAD.replace("1 2 3 7", f"{bad} 7"), "a.mesh")
    nodes = files()[".node"][0].replace(" 9 1", " nan 1")
    assert len(read_tetgen(files(node=nodes)).points) == 5


def test_the_row_named_is_the_first_bad_one_whatever_its_region_and_however_large_sound_ids_are():
    many = "150 3 0 0\n" + "".join(f"{i} {i} {i * i} {i**3}\n" for i in range(1, 151))
    for bad in ("2.5", "1e17", f"{2**53}"):
        with pytest.raises(IoError, match="a.ele, line 3: a vertex id is no whole number"):
            read_tetgen(files(node=many, ele=f"3 4 1\n1 147 148 149 150 0.5\n2 2 3 4 {bad} 6\n3 2 3 4 {bad} 6\n"))
        with pytest.raises(IoError, match="a.face, line 3: row 2 of the faces"):
            read_tetgen(files(node=many, face=f"3 1\n1 148 149 150 1\n2 2 3 {bad} 6\n3 2 3 {bad} 6\n"))
        with pytest.raises(IoError, match=f"line {FIRST + 3}: Edges holds a number that is no id"):
            read_medit(f"{HEAD}Edges\n3\n1 30 150\n1 2 -{bad}\n1 {bad} 1\n", "a.mesh")


def test_no_points_and_no_tets_are_an_empty_mesh():
    empty = read_tetgen(files(node="0 3 0 0\n", ele="0 4 0\n", face="0 0\n", edge="0 0\n"))
    assert empty.points.shape == (0, 3) and [len(cells) for _, cells in empty.cells] == [0, 0, 0]
