"""Tet meshes from files of every kind, regions and interfaces, locking tets, and constraints of the user's own."""

import gzip
import json
import warnings
from dataclasses import replace

import meshio
import numpy as np
import octafield as of
import pytest
from conftest import box_tets
from octafield.domain.inputs import read_input
from octafield.domain.meshing import prepare_mesh
from octafield.fields.frame_field import compute_field, prepare_field, run_field
from octafield.options import FieldOptions
from octafield.runs.run_folder import write_field_result
from pipeline_fixtures import SHARED_TETS, octafield, shared

SHARED_ARFF = SHARED_TETS.parent / "arff"


def halves(tets: of.TetMesh) -> np.ndarray:
    """Region 2 where x < 1/2, else 5."""
    centres = np.asarray(tets.vertices)[np.asarray(tets.tets)].mean(axis=1)
    return np.where(centres[:, 0] < 0.5, 2, 5)


def cube_edges(tets: of.TetMesh) -> np.ndarray:
    """Mesh edges on the twelve edges of the unit cube."""
    points, t = np.asarray(tets.vertices), np.asarray(tets.tets)
    edges = np.concatenate([t[:, [i, j]] for i in range(4) for j in range(i)])
    edges = np.unique(np.sort(edges, axis=1), axis=0)
    same = points[edges[:, 0]] == points[edges[:, 1]]
    return edges[(same & np.isin(points[edges[:, 0]], (0.0, 1.0))).sum(axis=1) == 2]


def grid_of(tets: of.TetMesh, names: tuple[str, ...]) -> meshio.Mesh:
    """Tets with their region and feature lines, ids in cell data of these names."""
    lines = cube_edges(tets)
    cells = [("line", lines), ("tetra", np.asarray(tets.tets))]
    ids = [np.full(len(lines), 9), halves(tets)]
    return meshio.Mesh(np.asarray(tets.vertices), cells, cell_data={name: ids for name in names})


GMSH = ("gmsh:physical", "gmsh:geometrical")


def write_msh4(path, tets: of.TetMesh) -> None:
    """As Gmsh writes version 4.1: entities with their boxes, nodes, elements per entity. meshio leaves entities out."""
    points, lines, of_region = np.asarray(tets.vertices), cube_edges(tets), halves(tets)
    box, count = "0 0 0 1 1 1", len(tets.vertices)
    text = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$Entities", "0 1 0 2", f"9 {box} 0 0"]
    text += [f"{region} {box} 0 0" for region in (2, 5)]
    text += ["$EndEntities", "$Nodes", f"1 {count} 1 {count}", f"3 2 0 {count}", *map(str, range(1, count + 1))]
    text += [" ".join(map(repr, p)) for p in points.tolist()]
    blocks = [(1, 9, 1, lines), *((3, r, 4, np.asarray(tets.tets)[of_region == r]) for r in (2, 5))]
    total = sum(len(cells) for *_, cells in blocks)
    text += ["$EndNodes", "$Elements", f"{len(blocks)} {total} 1 {total}"]
    tag = 0
    for dimension, entity, kind, cells in blocks:
        text.append(f"{dimension} {entity} {kind} {len(cells)}")
        for cell in (cells + 1).tolist():
            tag += 1
            text.append(" ".join(map(str, [tag, *cell])))
    path.write_text("\n".join([*text, "$EndElements", ""]))


def write_by_meshio(path, tets: of.TetMesh, kind: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        if kind == "msh2":
            meshio.gmsh.write(path, grid_of(tets, GMSH), "2.2", binary=False)
        elif kind == "msh2 binary":
            meshio.gmsh.write(path, grid_of(tets, GMSH), "2.2", binary=True)
        elif kind == "msh4":
            write_msh4(path, tets)
        elif kind in ("mesh", "meshb"):
            meshio.medit.write(str(path), grid_of(tets, ("medit:ref",)))
        elif kind == "tetgen":
            meshio.tetgen.write(path, meshio.Mesh(tets.vertices, [("tetra", tets.tets)],
                                                  cell_data={"tetgen:ref": [halves(tets)]}))  # fmt: skip
        else:
            grid_of(tets, ("CellEntityIds",)).write(path)


KINDS = {"msh2": "a.msh", "msh2 binary": "a.msh", "msh4": "a.msh", "mesh": "a.mesh", "meshb": "a.meshb",
         "tetgen": "a.ele",
         "vtk": "a.vtk", "vtu": "a.vtu"}  # fmt: skip


@pytest.mark.parametrize("packed", [False, True])
@pytest.mark.parametrize("kind", KINDS)
def test_what_meshio_writes_comes_back_with_regions_and_lines(tmp_path, kind, packed):
    tets = box_tets(4)
    path = tmp_path / KINDS[kind]
    write_by_meshio(path, tets, kind)
    if packed:
        for file in list(tmp_path.iterdir()):
            file.with_name(file.name + ".gz").write_bytes(gzip.compress(file.read_bytes()))
            file.unlink()
        path = path.with_name(path.name + ".gz")
    found = read_input(path)
    order = np.argsort(halves(tets), kind="stable") if kind == "msh4" else slice(None)  # one block per region there
    assert np.array_equal(found.tets.vertices, tets.vertices)
    assert np.array_equal(found.tets.tets, np.asarray(tets.tets)[order])
    assert np.array_equal(found.regions, halves(tets)[order])
    assert found.interface_triangles == 2 * 4 * 4
    if kind != "tetgen":
        ends = np.asarray(found.volume().surface.vertex_map)[found.lines]
        assert np.array_equal(np.unique(np.sort(ends, axis=1), axis=0), cube_edges(tets))


def test_fields_that_octafield_writes_come_back_with_their_regions(tmp_path):
    tets = box_tets(2)
    frames = np.tile([1.0, 0, 0, 0], (len(tets.vertices), 1))
    of.volume.write_field(tmp_path / "a.vtu", of.TetDomain(tets, regions=halves(tets)), frames)
    assert np.array_equal(read_input(tmp_path / "a.vtu").regions, halves(tets))
    assert np.array_equal(meshio.read(tmp_path / "a.vtu").cell_data["region"][0], halves(tets))
    with pytest.raises(of.InvalidInput, match="one per tet"):
        of.TetDomain(tets, regions=[1])


@pytest.mark.parametrize("name", ["sphere_r0.17.mesh.gz", "78322_gear.2.mesh.gz", "genus3.mesh.gz", "prism.ele.gz"])
def test_arff_files_read_as_meshio_reads_them(tmp_path, name):
    path = shared(SHARED_ARFF / name)
    for file in (path, *([path.with_name("prism.node.gz")] if "prism" in name else [])):
        (tmp_path / file.name.removesuffix(".gz")).write_bytes(gzip.decompress(file.read_bytes()))
    plain = str(tmp_path / name.removesuffix(".gz"))
    oracle = meshio.tetgen.read(plain) if "prism" in name else meshio.medit.read(plain)
    found = read_input(path)
    assert np.allclose(found.tets.vertices, oracle.points, rtol=1e-6, atol=1e-6)  # single precision there
    assert np.array_equal(np.sort(found.tets.tets, axis=1), np.sort(oracle.cells_dict["tetra"], axis=1))
    assert found.regions is None


def medit(sections: str) -> str:
    return "MeshVersionFormatted 1\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n" + sections


def test_medit_files_of_other_programs_are_read(tmp_path):
    path = tmp_path / "a.mesh"
    path.write_text(
        medit(
            "# a comment\nTetrahedra\n1 # how many\n1 2 3 4 7\nRequiredTriangles 1 1\nEdges 2\n1 2 0\n3 4"
            " 0\nRidges\n1\n2\nEnd\n"
        )
    )
    found = read_input(path)
    assert found.lines.tolist() == [[2, 3]] and found.lines_are_features()
    assert np.asarray(found.tets.vertices)[1, 0] == 1
    path.write_text(medit("Tetrahedra 1\n1 2 3 4 0\n").replace("1 0 0 0", "0.123456789012345678 0 0 0"))
    assert np.asarray(read_input(path).tets.vertices)[1, 0] == 0.123456789012345678  # double, whatever the version


@pytest.mark.parametrize("text, words", [
    (medit("Tetrahedra\n2\n1 2 3 4 0\n"), "line 10: Tetrahedra ends after 1 of 2 rows"),
    (medit("Tetrahedra\n1\n1 2 three 4 0\n"), "line 10: no number in Tetrahedra: 'three'"),
    (medit("Tetrahedra\n1\n1 2 3 5 0\n"), "line 10: row 1 of Tetrahedra names a number outside 1 .. 4"),
    (medit("Tetrahedra\n1\n1 2 3 4.5 0\n"), "line 10: Tetrahedra holds a number that is no id"),
    (medit("Tetrahedra\n"), "line 8: Tetrahedra is not followed by a count"),
    ("Vertices 0\n", "line 1: a Medit .mesh file begins with"),
    ("MeshVersionFormatted 2\nDimension 2\nVertices 0\n", "line 2: points of dimension 2"),
    ("MeshVersionFormatted 2\nDimension 3\n", "no section Vertices"),
])  # fmt: skip
def test_a_broken_medit_file_gives_the_line(tmp_path, text, words):
    (tmp_path / "broken.mesh").write_text(text)
    with pytest.raises(of.IoError, match="broken.mesh") as caught:
        read_input(tmp_path / "broken.mesh")
    assert words in str(caught.value)


NODE, ELE = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n", "1 4 0\n1 1 2 3 4\n"


@pytest.mark.parametrize("node, ele, words", [
    (NODE, "2 4 0\n1 1 2 3 4\n", "line 2: tets ends after 1 of 2 rows"),
    (NODE, "1 4 0\n1 1 2 3 5\n", "line 2: a tet names a point outside 1 .. 4"),
    (NODE, "1 11 0\n1 1 2 3 4\n", "vertices per tet is 11"),
    (NODE.replace("3 0 1", "7 0 1"), ELE, "row 3 of the points has number 7"),
    (NODE.replace("0 1 0", "0 y 0"), ELE, "line 4: no number in points: 'y'"),
    ("", ELE, "does not begin with the number of points"),
    (None, ELE, "needs broken.node"),
])  # fmt: skip
def test_a_broken_tetgen_pair_gives_the_line(tmp_path, node, ele, words):
    if node is not None:
        (tmp_path / "broken.node").write_text(node)
    (tmp_path / "broken.ele").write_text(ele)
    with pytest.raises(of.IoError, match="broken") as caught:
        read_input(tmp_path / "broken.ele")
    assert words in str(caught.value)


def write_tetgen_boundary(stem, tets: of.TetMesh, base: int, extra: bool = False) -> np.ndarray:
    """.node, .ele, .face with a marker per side of the cube, .edge with marker 0 off the cube's edges. Returns the
    markers."""
    points, boundary = np.asarray(tets.vertices), of.volume.boundary_surface(tets)
    triangles = np.asarray(boundary.vertex_map)[np.asarray(boundary.mesh.triangles)]
    corners = points[triangles]
    flat = np.array([[(corners[:, :, c] == side).all(axis=1) for side in (0.0, 1.0)] for c in range(3)])
    markers = flat.reshape(6, -1).argmax(axis=0) + 10
    lines = cube_edges(tets)
    tables = {
        ".node": (f"{len(points)} 3 0 0", points.tolist()),
        ".ele": (f"{len(tets.tets)} 4 0", (np.asarray(tets.tets) + base).tolist()),
        ".face": (
            f"{len(triangles)} 1",
            np.column_stack([triangles + base, markers, *([markers] if extra else [])]).tolist(),
        ),
        ".edge": (
            f"{len(lines) + 1} 1",
            [*np.column_stack([lines + base, lines[:, 0] * 0 + 3]).tolist(), [base, base + 1, 0]],
        ),
    }
    for suffix, (head, rows) in tables.items():
        text = "\n".join(
            [f"# made by rule\n{head}", *(" ".join(map(repr, [n + base, *row])) for n, row in enumerate(rows))]
        )
        stem.with_suffix(suffix).write_text(text + "\n# end\n")
    return markers


@pytest.mark.parametrize("base", [0, 1])
def test_tetgen_edges_are_features_and_markers_of_faces_are_faces(tmp_path, base):
    tets = box_tets(3)
    write_tetgen_boundary(tmp_path / "a", tets, base, extra=base == 1)  # with a column that the header does not tell
    found = read_input(tmp_path / "a.node")
    ends = np.asarray(found.volume().surface.vertex_map)[found.lines]
    assert np.array_equal(np.unique(np.sort(ends, axis=1), axis=0), cube_edges(tets))
    assert prepare_mesh(tmp_path / "a.ele").feature_source == "file"
    (tmp_path / "a.edge").unlink()
    assert read_input(tmp_path / "a.node").lines is None


def test_a_tetgen_edge_with_one_face_on_both_sides_is_a_seam(tmp_path):
    tets = box_tets(3)
    write_tetgen_boundary(tmp_path / "a", tets, 1)
    lines = (tmp_path / "a.face").read_text().splitlines()
    merged = [" ".join([*line.split()[:-1], "10" if line.split()[-1] == "12" else line.split()[-1]])
              if len(line.split()) == 5 else line for line in lines]  # fmt: skip
    (tmp_path / "a.face").write_text("\n".join(merged))
    found = read_input(tmp_path / "a.node")
    assert len(found.lines) == 36 - 3 and "3 seam edges" in " ".join(found.notes)  # x = 0 and y = 0 are one face


@pytest.mark.parametrize("suffix, text, words", [
    (".face", "1 1\n1 1 2 99 5\n", "broken.face, line 2: row 1 of the faces names a point outside 1 .. 4"),
    (".face", "2 1\n1 1 2 3 5\n", "broken.face, line 2: faces ends after 1 of 2 rows"),
    (".edge", "1 0\n1 1 x\n", "broken.edge, line 2: no number in edges: 'x'"),
    (".edge", "some words\n", "broken.edge: does not begin with the number of edges"),
    (".edge", "1 0\n1 1 2.5\n", "broken.edge, line 2: row 1 of the edges"),
])  # fmt: skip
def test_a_broken_face_or_edge_file_gives_the_line(tmp_path, suffix, text, words):
    (tmp_path / "broken.node").write_text("4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n")
    (tmp_path / "broken.ele").write_text("1 4 0\n1 1 2 3 4\n")
    (tmp_path / f"broken{suffix}").write_text(text)
    with pytest.raises(of.IoError) as error:
        read_input(tmp_path / "broken.node")
    assert words in str(error.value)


def touching_blocks(dimensions: int) -> of.TetMesh:
    """Blocks of a 2 x 2 x 2 box that meet at an edge (2) or a vertex (3) only."""
    tets = box_tets(4)
    centres = np.asarray(tets.vertices)[np.asarray(tets.tets)].mean(axis=1)[:, :dimensions] < 0.5
    kept = np.asarray(tets.tets)[(centres == centres[:, :1]).all(axis=1)]
    used, ids = np.unique(kept, return_inverse=True)
    return of.TetMesh(np.asarray(tets.vertices)[used], ids.reshape(-1, 4))


@pytest.mark.parametrize("dimensions, words", [(2, "at 4 edges and 0 other"), (3, "at 0 edges and 1 other")])
def test_blocks_that_touch_have_the_constant_field(tmp_path, dimensions, words):
    tets = touching_blocks(dimensions)
    result = compute_field(tets)
    assert result.record["energy"] < 1e-20 and result.record["alignment_deg"]["max"] < 1e-6
    assert any(words in note for note in result.record["notes"])
    assert set(result.record["hexahedra_at_features"]) == {"1"} and result.record["non_meshable_corners"] == 0
    write_field_result(result, tmp_path)
    without = compute_field(
        tets, FieldOptions(features="none", boundary="none")
    )  # edges of contact are features all the same
    assert (without.record["feature_edges"] > 0) == (dimensions == 2)
    # The doctor says the same.
    of.volume.write_field(tmp_path / "a.vtu", tets, result.frames)
    info = json.loads(octafield("info", tmp_path / "a.vtu", "--json", "-", check=0).stdout)
    assert info["ok"] and "touches itself" in " ".join(info["notes"])


def test_ids_of_points_that_are_not_there_name_their_cells(tmp_path):
    points = np.eye(4, 3)
    for kind, width in (("tetra", 4), ("triangle", 3), ("line", 2)):
        cells = [("tetra", [[0, 1, 2, 3]])] if kind != "tetra" else []
        bad = np.array([np.arange(width), np.arange(width) + 90])
        (tmp_path / "bad.vtu").unlink(missing_ok=True)
        meshio.Mesh(points, [*cells, (kind, bad)]).write(tmp_path / "bad.vtu")
        with pytest.raises(of.InvalidInput, match=f"bad.vtu: .*{kind}.*not there.*cell 1 of") as caught:
            read_input(tmp_path / "bad.vtu")
        assert caught.value.elements == [1]


@pytest.fixture(scope="module")
def two_regions(tmp_path_factory):
    path = tmp_path_factory.mktemp("regions") / "two.vtk"
    grid_of(box_tets(4), ("CellEntityIds",)).write(path)
    return path


def test_an_interface_holds_the_field_as_a_boundary_does(tmp_path, two_regions):
    meshed = prepare_mesh(two_regions)
    result = run_field(prepare_field(meshed), FieldOptions())
    assert result.record["regions"] == 2 and result.record["interface_triangles"] == 32
    assert result.record["boundary_triangles"] == 6 * 2 * 4 * 4
    points, kind = np.asarray(result.tets.vertices), np.asarray(result.constraints.kind)
    inside = (points[:, 0] == 0.5) & ((points[:, 1:] > 0) & (points[:, 1:] < 1)).all(axis=1)
    assert (kind[inside] == 1).all()
    assert np.allclose(np.abs(np.asarray(result.constraints.axis)[inside]), [1, 0, 0])
    rim = (points[:, 0] == 0.5) & ~inside
    assert (kind[rim] == 2).all()
    assert result.record["energy"] == pytest.approx(0, abs=1e-9)
    assert result.record["alignment_deg"]["max"] < 1e-4
    assert len(result.surface.vertices) == len(result.directions)
    write_field_result(result, tmp_path)
    assert set(meshio.read(tmp_path / "field.vtu").cell_data["region"][0]) == {2, 5}
    free = prepare_mesh(two_regions, FieldOptions(interfaces=False))
    assert free.interface_triangles == 0 and free.regions is None


@pytest.mark.parametrize("features", ["file", "angle", "none"])
def test_the_rim_of_an_interface_is_a_feature_whatever_their_source(two_regions, features):
    meshed = prepare_mesh(two_regions, FieldOptions(features=features))
    points = np.asarray(meshed.tets.surface.mesh.vertices)
    ends = points[np.asarray(meshed.tets.features.edges)]
    assert ((ends[:, :, 0] == 0.5).all(axis=1)).sum() == 16
    assert len(ends) == 16 + (0 if features == "none" else 12 * 4)
    of.surface.edge_topology(meshed.surface)  # raises unless the sheets are manifold
    lifted = np.asarray(meshed.sheet_map)[np.asarray(meshed.features.edges)]
    pairs = {tuple(sorted(edge)) for edge in lifted.tolist()}
    assert pairs == {tuple(edge) for edge in np.asarray(meshed.tets.features.edges).tolist()}


def test_an_interface_that_is_oblique_turns_the_field_with_it():
    """Two halves of a cube about a tilted plane are no grid, so the pipeline starts from tets with regions in
    memory."""
    tets = box_tets(4)
    points = np.asarray(tets.vertices).copy()
    bump = 0.15 * np.sin(np.pi * points[:, 1]) * np.sin(np.pi * points[:, 0])
    points[:, 0] += bump  # the middle plane becomes curved, the sides x = 0 and 1 stay
    bent = of.TetMesh(points, np.asarray(tets.tets))
    domain = of.TetDomain(bent, regions=halves(tets))
    surface = domain.surface.mesh
    features = of.surface.detect_features(domain.boundary.mesh)
    assert len(features.edges) == 48
    sheets = domain.sheets
    edges = np.asarray(sheets.vertex_map)[np.asarray(of.surface.detect_features(sheets.mesh).edges)]
    graph = of.surface.feature_graph(surface, edges)
    directions = np.tile([0.3, 0.5, 0.8], (len(surface.vertices), 1))
    held = of.volume.boundary_constraints(domain.with_features(graph), directions)
    frames = np.asarray(of.volume.frame_field(domain, held).smooth.frames)
    normals = np.asarray(held.axis)
    middle = np.flatnonzero((np.asarray(tets.vertices)[:, 0] == 0.5) & (np.asarray(held.kind) == 1))
    assert len(middle) >= 9
    axes = np.asarray(of.frames.rotation_matrices(frames[middle]))
    cosines = np.abs(np.einsum("nij,ni->nj", axes, normals[middle])).max(axis=1)
    assert np.degrees(np.arccos(np.minimum(cosines, 1))).max() < 0.01
    assert np.abs(normals[middle][:, 1]).max() > 0.1


def test_locking_tets_are_counted_always_and_split_on_request(tmp_path):
    path = tmp_path / "flat.vtk"
    tets = box_tets(2)
    meshio.Mesh(np.asarray(tets.vertices), [("tetra", np.asarray(tets.tets))]).write(path)
    plain, split = (json.loads(octafield("field", path, "-o", tmp_path / name, *more, "--json", "-", check=0).stdout)
                    for name, more in (("plain", ()), ("split", ("--split",))))  # fmt: skip
    assert plain["locking"]["tets"] > 0 and plain["locking"]["edges"] > 0 and "left" not in plain["locking"]
    assert split["locking"]["tets"] == plain["locking"]["tets"] and split["locking"]["left"] == 0
    assert split["vertices"] == plain["vertices"] + split["locking"]["added_vertices"]
    assert split["boundary_triangles"] == plain["boundary_triangles"]
    assert split["energy"] == pytest.approx(0, abs=1e-9)


def test_a_surface_is_filled_then_split(tmp_path):
    from pipeline_fixtures import write_cube

    cube = write_cube(tmp_path)
    options = FieldOptions(edge_length=0.5)
    plain, split = prepare_mesh(cube, options), prepare_mesh(cube, replace(options, split=True))
    assert plain.locking["tets"] == split.locking["tets"] > 0
    assert len(split.tets.tets) == len(plain.tets.tets) + split.locking["added_tets"]
    assert np.array_equal(split.surface.vertices, plain.surface.vertices)
    assert len(of.volume.find_locking(split.tets).tets) == 0


def test_constraints_of_the_user_hold_inside_and_are_counted():
    meshed = prepare_mesh(box_tets(4))
    centre = int(np.argmin(np.linalg.norm(np.asarray(meshed.tets.vertices) - 0.5, axis=1)))
    turned = of.frames.quaternion_exp([[0.0, 0.0, np.pi / 4]])
    asked = of.volume.VertexConstraints(vertices=[centre], kinds=[2], frames=turned)
    result = compute_field(meshed, FieldOptions(), constraints=asked)
    assert of.frames.distance(np.asarray(result.frames)[[centre]], turned)[0] < 1e-7
    assert result.record["constraints"]["given"] == 1
    assert result.record["energy"] > 0.1
    assert sum(result.record["constraints"][kind] for kind in ("free", "axis", "fixed")) == result.record["vertices"]
    with pytest.raises(of.InvalidInput, match="prepare_mesh"):
        compute_field(box_tets(2), FieldOptions(), constraints=asked)
    with pytest.raises(of.InvalidInput, match="cannot have at vertex 999"):
        compute_field(meshed, FieldOptions(), constraints=of.volume.VertexConstraints([999], [0]))
    with pytest.raises(of.InvalidInput, match="a value above"):
        compute_field(
            meshed, FieldOptions(), constraints=of.volume.VertexConstraints([0], [len(of.volume.constraint_kinds)])
        )


def test_kinds_of_constraints_are_given_by_name_or_by_number():
    assert of.volume.constraint_kinds[:3] == ("free", "axis", "fixed")
    numbers = list(range(len(of.volume.constraint_kinds)))
    by_name = of.volume.VertexConstraints(vertices=numbers, kinds=of.volume.constraint_kinds)
    assert np.asarray(by_name.kinds).tolist() == numbers
    assert np.asarray(of.volume.VertexConstraints(vertices=numbers, kinds=numbers).kinds).tolist() == numbers
    held = of.volume.BoundaryConstraints(["axis", "free"], [[0, 0, 1], [0, 0, 0]], [[1, 0, 0, 0]] * 2, [1, 0])
    assert np.asarray(held.kind).tolist() == [1, 0]
    held.kind = ["free", "fixed"]
    assert np.asarray(held.kind).tolist() == [0, 2]
    assert repr(held) == "BoundaryConstraints(1 free, 0 axis, 1 fixed)"
    with pytest.raises(of.InvalidInput, match="unknown kind 'axes' in row 1; there are 0 free, 1 axis, 2 fixed"):
        of.volume.VertexConstraints(vertices=[0, 1], kinds=["axis", "axes"])
    with pytest.raises(of.InvalidInput, match="shape"):
        of.volume.VertexConstraints(vertices=[0], kinds=[["axis"]])
    with pytest.raises(of.InvalidInput, match="integers"):
        of.volume.VertexConstraints(vertices=[0], kinds=[1.5])


def test_the_prism_reaches_the_published_energy_with_its_crease_vertices_free():
    """Free are the vertices whose area-weighted normal points away from one of their triangles: 18, as published."""
    options = FieldOptions(features="none")
    meshed = prepare_mesh(shared(SHARED_ARFF / "prism.node.gz"), options)
    triangles = np.asarray(meshed.surface.triangles)
    normals, faces = (
        np.asarray(of.surface.vertex_normals(meshed.surface)),
        np.asarray(of.surface.triangle_normals(meshed.surface)),
    )
    least = np.ones(len(normals))
    for k in range(3):
        np.minimum.at(least, triangles[:, k], (faces * normals[triangles[:, k]]).sum(axis=1))
    creases = np.asarray(meshed.tets.surface.vertex_map)[least < 0]
    assert len(creases) == 18
    free = of.volume.VertexConstraints(vertices=creases, kinds=np.zeros(18, np.uint8))
    assert compute_field(meshed, options, constraints=free).record["energy"] <= 38.3987 * 1.0005


SMALL = ["s01c", "s02c", "s03c", "s04c", "s06u", "s07c", "s10c", "s11c", "s13c", "s01b"]


@pytest.mark.parametrize("name", SMALL)
def test_small_hexme_files_give_an_aligned_field(name):
    import sys
    from pathlib import Path

    sys.path.insert(0, str(Path(__file__).parents[2]))
    from studies.benchmarks.volume.parts import HEADER, measure

    line, _ = measure(shared(SHARED_TETS / f"{name}.vtk.gz"), FieldOptions(), [])
    row = dict(zip(HEADER, line, strict=True))
    assert row["error deg"] < 1e-10  # held exactly, but for rounding
    assert np.isfinite(row["energy"])
    if name.startswith("s01"):
        assert row["singular"] == 0
    assert row["regions"] == (2 if name.endswith("b") else 1)
