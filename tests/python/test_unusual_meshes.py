"""What other programs put into mesh files beside plain tets: partitions, parameters, higher order, cells twice, cells
of other kinds, folds."""

import warnings

import meshio
import numpy as np
import octafield as of
import pytest
from conftest import box_tets
from octafield import frame_formats, read_frames, write_frames
from octafield.domain.inputs import from_mesh, read_input
from octafield.fields.frame_field import compute_field
from octafield.runs.conversion import convert_file
from pipeline_fixtures import SHARED_TETS

WILD = SHARED_TETS.parent / "wild"


def wild(name):
    path = WILD / name
    if not path.exists():
        pytest.skip(f"needs {name} of the shared data")
    return path


def parts_of(mesh):
    return np.array(mesh.vertices), np.array(mesh.tets)


def regions(path):
    found = read_input(path)
    return found, sorted(np.unique(found.regions).tolist(), key=int)


def test_partitions_of_gmsh_are_no_regions():
    one, of_one = regions(wild("part41.msh"))
    two, of_two = regions(wild("two41.msh"))
    assert of_one == of_two == [10, 20]
    assert np.bincount(one.regions).tolist() == np.bincount(two.regions).tolist()
    fields = [compute_field(wild(name)) for name in ("part41.msh", "two41.msh")]
    assert max(field.record["energy"] for field in fields) < 1e-12
    assert len(fields[0].features.edges) == len(fields[1].features.edges)


PARTITIONED = """$MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 1 1 1
1 0 0 0 1 1 1 0 0
1 0 0 0 1 1 1 0 0
7 0 0 0 1 1 1 1 30 0
$EndEntities
$PartitionedEntities
2
0
0 2 1 2
11 1 1 1 1 0 0 0 1 1 1 0 0
12 2 1 2 1 2 0 0 0 1 1 1 0 0
11 3 7 2 1 2 0 0 0 1 1 1 0 0
21 3 7 1 1 0 0 0 1 1 1 1 30 0
22 3 7 1 2 0 0 0 1 1 1 0 0
$EndPartitionedEntities
$Nodes
1 5 1 5
3 21 0 5
1
2
3
4
5
0 0 0
1 0 0
0 1 0
0 0 1
1 1 1
$EndNodes
$Elements
5 5 1 5
1 11 1 1
1 1 2
1 12 1 1
2 2 3
2 11 2 1
3 2 3 4
3 21 4 1
4 1 2 3 4
3 22 4 1
5 2 3 4 5
$EndElements
"""


def test_what_bounds_partitions_is_no_feature(tmp_path):
    (tmp_path / "a.msh").write_text(PARTITIONED)
    found = read_input(tmp_path / "a.msh")
    assert found.regions is None and len(found.tets.tets) == 2
    assert found.lines.tolist() == [[0, 1]]  # the line between partitions is left out


@pytest.mark.parametrize("name", ["order2_41.msh", "order2.mesh"])
def test_shared_meshes_of_second_order_are_read_by_their_corners(name):
    found, of_regions = regions(wild(name))
    assert len(found.tets.tets) == 750 and len(of_regions) == 2
    assert any("750 of type tetra" in note and "corners" in note for note in found.notes)


def quadratic(mesh):
    points, tets = parts_of(mesh)
    middles = [
        (points[tets[:, i]] + points[tets[:, j]]) / 2 for i, j in ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))
    ]
    ids = len(points) + np.arange(6 * len(tets)).reshape(6, -1).T
    return np.concatenate([points, *middles]), np.hstack([tets, ids])


@pytest.mark.parametrize("suffix", [".vtk", ".vtu", ".msh", ".mesh", ".ele"])
def test_tets_of_second_order_are_read_by_their_corners_from_every_format(tmp_path, suffix):
    points, tets = quadratic(box_tets(1))
    path = tmp_path / f"a{suffix}"
    if suffix == ".mesh":
        rows = "\n".join(" ".join(map(str, (*(row + 1), 1))) for row in tets)
        at = "\n".join("%r %r %r 0" % tuple(p) for p in points.tolist())
        path.write_text(
            "MeshVersionFormatted 2\nDimension"
            f" 3\nVertices\n{len(points)}\n{at}\nTetrahedraP2\n{len(tets)}\n{rows}\nEnd\n"
        )
    elif suffix == ".ele":
        path.write_text(
            f"{len(tets)} 10 0\n"
            + "\n".join(f"{i} " + " ".join(map(str, row)) for i, row in enumerate(tets.tolist()))
            + "\n"
        )
        path.with_suffix(".node").write_text(
            f"{len(points)} 3 0 0\n" + "\n".join("%d %r %r %r" % (i, *p) for i, p in enumerate(points.tolist())) + "\n"
        )
    else:
        meshio.write(
            path, meshio.Mesh(points, [("tetra10", tets)]), **({"file_format": "gmsh22"} if suffix == ".msh" else {})
        )
    found = read_input(path)
    np.testing.assert_array_equal(np.asarray(found.tets.tets), np.asarray(box_tets(1).tets))
    assert any(f"{len(tets)} of type tetra" in note for note in found.notes)


@pytest.mark.parametrize(("suffix", "kind", "width", "name"), [
    (".vtk", 11, 8, "voxel"), (".vtu", 11, 8, "voxel"), (".vtk", 12, 8, "hexahedron"), (".vtu", 13, 6, "wedge"),
    (".vtk", 200, 4, "VTK type 200"), (".vtu", 200, 4, "VTK type 200"),
])  # fmt: skip
def test_cells_that_are_not_used_are_named(tmp_path, suffix, kind, width, name):
    ids = " ".join(map(str, range(width)))
    points = "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1"
    if suffix == ".vtk":
        text = (
            f"# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n{points}\nCELLS 1"
            f" {width + 1}\n{width} {ids}\nCELL_TYPES 1\n{kind}\n"
        )
    else:
        cells = "".join(
            f'<DataArray type="Int64" Name="{key}" format="ascii">{value}</DataArray>'
            for key, value in (("connectivity", ids), ("offsets", width), ("types", kind))
        )
        text = (
            '<VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece NumberOfPoints="8"'
            ' NumberOfCells="1"><Points><DataArray type="Float64" NumberOfComponents="3"'
            f' format="ascii">{points}</DataArray></Points><Cells>{cells}</Cells></Piece></UnstructuredGrid></VTKFile>'
        )
    (tmp_path / f"a{suffix}").write_text(text)
    with pytest.raises(of.InvalidInput, match=f"holds cells that are not used: 1 of type {name}|cell types: {name}"):
        read_input(tmp_path / f"a{suffix}")


@pytest.mark.parametrize("name", ["voxel.vtk", "voxel.vtu"])
def test_shared_voxels_are_named(name):
    with pytest.raises(of.InvalidInput, match="of type voxel"):
        read_input(wild(name))


def test_parametric_nodes_are_nodes(tmp_path):
    found, of_regions = regions(wild("param22.msh"))
    assert len(found.tets.vertices) == 241 and of_regions == [10, 20]


def test_parametric_nodes_have_as_many_parameters_as_their_entity_has_dimensions(tmp_path):
    nodes = "1 0 0 0 0 1\n2 1 0 0 1 1 0.5\n3 0 1 0 2 1 0.5 0.25\n4 0 0 1 3 1"
    (tmp_path / "a.msh").write_text(
        f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$ParametricNodes\n4\n{nodes}\n$EndParametricNodes\n$Elements\n1\n1 4 2"
        " 1 1 1 2 3 4\n$EndElements\n"
    )
    assert np.asarray(read_input(tmp_path / "a.msh").tets.vertices).tolist() == [
        [0, 0, 0],
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
    ]


def test_shared_overlapping_groups_are_merged():
    found, _ = regions(wild("overlap22.msh"))
    assert len(found.tets.tets) == 750 and any("750 of 1500 tets" in note for note in found.notes)


def test_tets_in_several_groups_are_read_once_with_the_regions_of_the_model_and_their_frames(tmp_path):
    points, tets = parts_of(box_tets(2))
    inner = np.flatnonzero(points[tets].mean(axis=1)[:, 0] < 0.5)
    entity = np.full(len(tets), 7)
    entity[inner] = 8
    cells = [("tetra", np.concatenate([tets, tets[inner]]))]
    ids = {
        "gmsh:physical": [np.concatenate([np.full(len(tets), 1), np.full(len(inner), 2)])],
        "gmsh:geometrical": [np.concatenate([entity, entity[inner]])],
    }
    quaternions = np.zeros((len(tets) + len(inner), 4))
    quaternions[:, 0] = 1
    meshio.gmsh.write(tmp_path / "a.msh", meshio.Mesh(points, cells, cell_data=ids), "2.2", binary=False)
    found = read_input(tmp_path / "a.msh")
    assert len(found.tets.tets) == len(tets)
    np.testing.assert_array_equal(found.regions, entity)
    meshio.vtu.write(tmp_path / "a.vtu", meshio.Mesh(points, cells, cell_data={"quaternion": [quaternions]}))
    assert len(read_frames(tmp_path / "a.vtu").frames) == len(tets)


def test_a_point_that_is_not_finite_is_an_error_without_warnings():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(of.GeometryError, match="not finite"):
            read_input(wild("nan.vtu"))


def pulled_through(mesh, by):
    """A vertex inside is pulled out of the star of its tets: some turn inside out over others."""
    points, tets = parts_of(mesh)
    points[np.argmin(np.abs(points - 0.5).sum(axis=1))] += by
    return points, tets


def volumes(points, tets):
    return np.linalg.det(points[tets[:, 1:]] - points[tets[:, :1]])


@pytest.mark.parametrize("turned", ["as the others", "all", "each to positive volume", "at random"])
def test_folded_tets_are_named_however_they_are_ordered(turned):
    points, tets = pulled_through(box_tets(4), (0.4, 0.03, 0.02))
    folded = np.flatnonzero(volumes(points, tets) < 0)
    assert len(folded)
    swap = {
        "as the others": [],
        "all": np.arange(len(tets)),
        "each to positive volume": folded,
        "at random": np.flatnonzero(np.random.default_rng(1).integers(0, 2, len(tets))),
    }[turned]
    tets[swap] = tets[swap][:, [0, 1, 3, 2]]
    with pytest.raises(of.GeometryError, match="folded over neighbours") as caught:
        from_mesh(of.TetMesh(points, tets))
    assert caught.value.kind == "folded_tet" and caught.value.elements == folded.tolist()


@pytest.mark.parametrize("swap", ["all", "at random"])
def test_tets_that_are_only_ordered_otherwise_are_turned_over(swap):
    points, tets = parts_of(box_tets(3))
    chosen = (
        np.arange(len(tets)) if swap == "all" else np.flatnonzero(np.random.default_rng(1).integers(0, 2, len(tets)))
    )
    tets[chosen] = tets[chosen][:, [0, 1, 3, 2]]
    found = from_mesh(of.TetMesh(points, tets))
    assert (volumes(*parts_of(found.tets)) > 0).all() and any("turned over" in note for note in found.notes)


@pytest.mark.parametrize("name", ["outside.mesh", "ball_folded_deep.mesh"])
def test_shared_folded_meshes_are_refused(name):
    with pytest.raises(of.GeometryError, match="folded over neighbours"):
        read_input(wild(name))


@pytest.mark.parametrize("name", ["damaged_count_a.vtp", "damaged_count_b.vtp", "damaged_count_c.vtp"])
def test_wrong_counts_of_vtp_are_typed_errors(name):
    with pytest.raises(of.IoError, match="NumberOf|rows"):
        read_input(wild(name))


def test_polygons_strips_and_polylines_of_vtp(tmp_path):
    import pyvista

    surface = pyvista.PolyData(
        np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0.0]]), faces=[4, 0, 1, 2, 3]
    )
    surface.strips = [4, 1, 4, 2, 5]
    surface.lines = [3, 0, 1, 4]
    for binary in (True, False):
        surface.save(tmp_path / "a.vtp", binary=binary)
        found = read_input(tmp_path / "a.vtp")
        points, triangles = np.asarray(found.surface.vertices), np.asarray(found.surface.triangles)
        normals = np.cross(
            points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]]
        )
        assert len(triangles) == 4 and (normals[:, 2] == 1).all()
        assert len(found.lines) == 2


PLACES = ("field", "field.dat", "FIELD.TXT.BAK", "field.gz")


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("name", [name for name, form in frame_formats.items() if form.write])
def test_a_format_given_by_name_needs_no_extension(tmp_path, name, place):
    mesh, form = box_tets(1), frame_formats[name]
    where = form.where[0]
    frames = np.tile([1.0, 0, 0, 0], (len(mesh.vertices if where == "vertices" else mesh.tets), 1))
    write_frames(tmp_path / place, mesh, frames, where, name)
    if form.read is None:
        return
    found = read_frames(tmp_path / place, mesh, name)
    assert found.format == name and len(found.frames) == len(frames)
    source = tmp_path / "source.npz"
    write_frames(source, mesh, frames, where)
    convert_file(source, tmp_path / f"to_{place}", to_format=name)
    assert len(read_frames(tmp_path / f"to_{place}", mesh, name).frames) == len(frames)
    convert_file(
        tmp_path / place,
        tmp_path / "back.npz",
        from_format=name,
        mesh=None if form.holds_mesh else _mesh_file(tmp_path, mesh),
    )


def _mesh_file(folder, mesh):
    write_frames(folder / "mesh.vtu", mesh, np.tile([1.0, 0, 0, 0], (len(mesh.vertices), 1)))
    return folder / "mesh.vtu"
