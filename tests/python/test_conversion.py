"""octafield convert: meshes and fields from one kind of file to another, checked with other people's readers."""

import gzip
import json
import os
import resource
import signal

import meshio
import numpy as np
import octafield as of
import other_readers as readers
import pytest
import pyvista
from conftest import box_tets
from format_table import frames_at
from octafield.domain.inputs import read_input
from octafield.runs.conversion import convert_file
from pipeline_fixtures import SHARED_TETS, octafield, shared
from test_tet_input import cube_edges, halves

WRITTEN = [form for form in of.mesh_formats.values() if form.write is not None]
VOLUMES = [s for form in WRITTEN if {"tets", "features", "faces", "regions"} <= set(form.holds) for s in form.suffixes]
SURFACES = [s for form in WRITTEN if "tets" not in form.holds and not form.soup for s in form.suffixes]


@pytest.fixture(scope="module")
def halved(tmp_path_factory):
    """A cube in two regions with its twelve edges as features, and six CAD faces."""
    tets = box_tets(4)
    points = np.asarray(tets.vertices)
    boundary = of.volume.boundary_surface(tets)
    triangles = np.asarray(boundary.vertex_map)[boundary.mesh.triangles]
    at = points[triangles]
    faces = sum((1 + 2 * k + side) * (at[:, :, k] == side).all(axis=1) for k in range(3) for side in (0, 1))
    lines = cube_edges(tets)
    cells = [("line", lines), ("triangle", triangles), ("tetra", np.asarray(tets.tets))]
    ids = [np.ones(len(lines), int), faces, halves(tets)]
    path = tmp_path_factory.mktemp("halved") / "halved.vtk"
    meshio.Mesh(points, cells, cell_data={"CellEntityIds": ids}).write(path)
    return path


def feature_lines(found):
    if found.lines is None or not found.lines_are_features():
        return None
    lines = found.lines if found.tets is None else np.asarray(found.volume().surface.vertex_map)[found.lines]
    return np.unique(np.sort(lines, axis=1), axis=0)


@pytest.mark.parametrize("packed", ["", ".gz"])
@pytest.mark.parametrize("suffix", VOLUMES)
def test_tets_keep_points_regions_features_and_cad_faces_in_every_format_that_holds_them(
    halved, tmp_path, suffix, packed
):
    before = read_input(halved)
    done = convert_file(halved, tmp_path / f"a{suffix}{packed}")
    after = read_input(tmp_path / f"a{suffix}{packed}")
    assert (done.kind, done.vertices, done.cells) == ("tets", 125, 384)
    assert np.array_equal(after.tets.vertices, before.tets.vertices)
    assert np.array_equal(np.sort(after.tets.tets, axis=1), np.sort(before.tets.tets, axis=1))
    assert np.array_equal(after.regions, before.regions)
    assert np.array_equal(feature_lines(after), cube_edges(before.tets))
    known = before.faces > 0
    assert np.array_equal(after.faces[known], before.faces[known]) and known.sum() == 6 * 2 * 16


@pytest.mark.parametrize("suffix", SURFACES)
def test_surfaces_keep_their_points_and_say_what_is_lost(halved, tmp_path, suffix):
    done = convert_file(halved, tmp_path / f"a{suffix}")
    after = read_input(tmp_path / f"a{suffix}").surface
    expected = of.volume.boundary_surface(read_input(halved).tets).mesh
    assert done.kind == "surface" and any("hold triangles" in note for note in done.notes)
    if suffix != ".vtp":  # which has the interface, too
        assert np.array_equal(after.vertices, expected.vertices) and np.array_equal(after.triangles, expected.triangles)
        assert any("no feature edges, no CAD faces, no regions" in note for note in done.notes)


def test_other_libraries_read_the_meshes(halved, tmp_path):
    points, tets = np.asarray(read_input(halved).tets.vertices), np.asarray(read_input(halved).tets.tets)
    for suffix in (".vtk", ".vtu", ".msh", ".mesh", ".meshb", ".node"):
        convert_file(halved, tmp_path / f"a{suffix}")
        found = meshio.read(tmp_path / f"a{suffix}")
        assert np.array_equal(found.points, points) and np.array_equal(found.cells_dict["tetra"], tets), suffix
        if suffix != ".node":
            assert np.array_equal(np.unique(np.sort(found.cells_dict["line"], axis=1), axis=0), cube_edges(box_tets(4)))
    for suffix in (".vtk", ".vtu"):
        grid = pyvista.read(tmp_path / f"a{suffix}")
        assert np.array_equal(grid.points, points) and np.array_equal(grid.cells_dict[pyvista.CellType.TETRA], tets)
        assert sorted(set(np.asarray(grid.cell_data["CellEntityIds"])[-len(tets) :])) == [2, 5]


def test_gmsh_reads_what_is_written_for_it(halved, tmp_path):
    import gmsh

    for suffix in (".msh", ".mesh", ".vtk"):
        convert_file(halved, tmp_path / f"a{suffix}")
        gmsh.initialize(["test"], readConfigFiles=False, interruptible=False)
        try:
            gmsh.option.setNumber("General.Terminal", 0)
            gmsh.open(str(tmp_path / f"a{suffix}"))
            tags, points, _ = gmsh.model.mesh.getNodes()
            order = np.argsort(tags)
            assert np.array_equal(points.reshape(-1, 3)[order], read_input(halved).tets.vertices)
            assert len(gmsh.model.mesh.getElementsByType(4)[0]) == 384
            assert len(gmsh.model.mesh.getElementsByType(1)[0]) == 48
            if suffix == ".msh":
                assert sorted(tag for _, tag in gmsh.model.getPhysicalGroups(3)) == [2, 5]
        finally:
            gmsh.finalize()


def test_trimesh_reads_the_surfaces(halved, tmp_path):
    import trimesh

    for suffix in (".stl", ".obj", ".off", ".ply"):
        convert_file(halved, tmp_path / f"a{suffix}")
        found = trimesh.load(tmp_path / f"a{suffix}")
        assert found.is_watertight and found.volume == pytest.approx(1) and len(found.faces) == 192


def test_medit_files_are_what_the_readers_of_arff_and_cubecover_want(halved, tmp_path):
    """ARFF: sections in the order Vertices, Triangles, Edges, Tetrahedra; CubeCover: no other sections, version 1 or 2,
    an End."""
    convert_file(halved, tmp_path / "a.mesh")
    words = [line.split()[0] for line in (tmp_path / "a.mesh").read_text().splitlines() if line[:1].isalpha()]
    assert words == ["MeshVersionFormatted", "Dimension", "Vertices", "Triangles", "Edges", "Tetrahedra", "End"]
    assert (tmp_path / "a.mesh").read_text().split()[:2] == ["MeshVersionFormatted", "2"]


def test_the_vtk_file_for_algohex_has_cells_and_colours_as_hexme_has_them(tmp_path):
    path = shared(SHARED_TETS / "s01u.vtk.gz")
    convert_file(path, tmp_path / "a.ovm")
    convert_file(tmp_path / "a.ovm", tmp_path / "b.vtk")
    ours, theirs = read_input(tmp_path / "b.vtk"), read_input(path)
    assert np.array_equal(feature_lines(ours), feature_lines(theirs))
    assert np.array_equal(ours.faces, theirs.faces)
    found = readers.ovm_text(tmp_path / "a.ovm")
    assert set(np.unique(found["FProp", "AlgoHex::FeatureFaces"])) == {0, *np.unique(theirs.faces)}


def test_legacy_vtk_is_version_2_in_ascii_with_a_colour_per_cell(halved, tmp_path):
    """What OpenVolumeMesh's VtkColorReader, by which AlgoHex reads, insists on, in its order."""
    convert_file(halved, tmp_path / "a.vtk")
    lines = (tmp_path / "a.vtk").read_text().splitlines()
    assert lines[0] == "# vtk DataFile Version 2.0" and lines[2:5] == [
        "ASCII",
        "DATASET UNSTRUCTURED_GRID",
        "POINTS 125 double",
    ]
    cells = 5 + 125
    count = int(lines[cells].split()[1])
    assert lines[cells].split()[0] == "CELLS" and count == 48 + 6 * 32 + 32 + 384
    assert lines[cells + count + 1] == f"CELL_TYPES {count}" and lines[cells + 2 * count + 2] == f"CELL_DATA {count}"
    assert (
        lines[cells + 2 * count + 3].split()[0] == "SCALARS"
        and lines[cells + 2 * count + 4].split()[0] == "LOOKUP_TABLE"
    )
    assert len(lines) == cells + 3 * count + 5


def test_lines_without_cad_faces_survive_readers_that_look_for_seams(tmp_path):
    """A slit: a line that ends inside a face."""
    mesh = box_tets(3)
    lines = np.concatenate([cube_edges(mesh), [[index(1, 1, 0), index(1, 2, 0)]]])
    meshio.Mesh(mesh.vertices, [("line", lines), ("tetra", mesh.tets)]).write(tmp_path / "a.vtu")
    for suffix in VOLUMES:
        convert_file(tmp_path / "a.vtu", tmp_path / f"b{suffix}")
        assert len(feature_lines(read_input(tmp_path / f"b{suffix}"))) == 37, suffix
    faces = read_input(tmp_path / "b.vtk").faces
    assert len(np.unique(faces)) == 7 and faces.min() == 1


def index(i, j, k):
    return 16 * i + 4 * j + k


def test_fields_go_through_a_chain_of_formats(tmp_path):
    mesh = box_tets(2)
    q = frames_at(mesh, "tets")
    meshio.Mesh(mesh.vertices, [("tetra", mesh.tets)]).write(tmp_path / "box.mesh")
    np.save(tmp_path / "0.npy", q)
    chain = ("1.frame", "2.fra", "3.ovmb", "4.vtu", "5.ff3", "6.bfra", "7.msh", "8.npz", "9.qtn.gz")
    source = tmp_path / "0.npy"
    for name in chain:
        convert_file(source, tmp_path / name, mesh=tmp_path / "box.mesh")
        source = tmp_path / name
    assert np.max(of.frames.distance(readers.qtn(_unpacked(source)), q)) < 1e-14


def _unpacked(path):
    plain = path.with_name(path.name.removesuffix(".gz"))
    plain.write_bytes(gzip.decompress(path.read_bytes()))
    return plain


def test_the_command_tells_what_it_did(tmp_path):
    mesh = box_tets(2)
    of.write_frames(tmp_path / "a.vtu", mesh, frames_at(mesh, "vertices"))
    done = octafield("convert", tmp_path / "a.vtu", "-o", tmp_path / "b.frame", "--json", "-", check=0)
    record = json.loads(done.stdout)
    assert (record["kind"], record["frames"], record["where"]) == ("field", 48, "tets")
    assert "nearest to the mean sh4 vector" in done.stderr and "wrote" in done.stderr
    record = json.loads(
        octafield("convert", tmp_path / "a.vtu", "-o", tmp_path / "c.mesh", "--json", "-", check=0).stdout
    )
    assert record["kind"] == "tets" and any("frames were left out" in note for note in record["notes"])
    record = json.loads(
        octafield(
            "convert", tmp_path / "a.vtu", "-o", tmp_path / "d.txt", "--to", "geogram", "--json", "-", check=0
        ).stdout
    )
    assert len(readers.geogram(tmp_path / "d.txt")) == 48 == record["frames"]
    done = octafield(
        "convert",
        tmp_path / "b.frame",
        "-o",
        tmp_path / "e.npy",
        "--mesh",
        tmp_path / "c.mesh",
        "--at",
        "vertices",
        check=0,
    )
    assert np.load(tmp_path / "e.npy").shape == (27, 4)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["a.frame", "-o", "b.vtu"], "need the mesh"),
        (["a.frame", "-o", "b.mesh"], "give it with --mesh"),
        (["a.mesh", "-o", "b.frame"], "holds no frames to write"),
        (["a.off", "-o", "b.ovm"], "hold tets"),
        (["a.mesh", "-o", "b.doc"], "unknown kind of file"),
        (["a.mesh", "-o", "b.vtu", "--from", "unheard"], "format 'unheard'"),
        (["a.frame", "-o", "b.qtn", "--mesh", "a.off"], "holds triangles"),
        (["a.frame", "-o", "b.frame", "--at", "corners"], "where must be one of"),
        (["none.mesh", "-o", "b.vtu"], "no such file"),
    ],
)
def test_what_cannot_be_converted_is_told_in_one_line(tmp_path, arguments, message):
    mesh = box_tets(1)
    of.write_frames(tmp_path / "a.frame", mesh, frames_at(mesh, "tets"), "tets")
    meshio.Mesh(mesh.vertices, [("tetra", mesh.tets)]).write(tmp_path / "a.mesh")
    of.write_surface(of.volume.boundary_surface(mesh).mesh, tmp_path / "a.off")
    words = [str(tmp_path / word) if "." in word else word for word in arguments]
    done = octafield("convert", *words, check=2)
    assert message in done.stderr and len(done.stderr.splitlines()) == 1


def test_field_takes_every_kind_of_mesh(halved, tmp_path):
    energies = []
    for suffix in (".ovmb", ".ele", ".msh"):
        convert_file(halved, tmp_path / f"a{suffix}")
        energies.append(of.compute_field(tmp_path / f"a{suffix}").record["energy"])
    assert np.ptp(energies) < 1e-9


@pytest.mark.parametrize("values", [(0, 1), (-3, 7), (0, 2**31 - 1)])
def test_every_number_is_a_region_in_every_format_that_holds_regions(tmp_path, values):
    mesh = box_tets(2)
    regions = np.where(halves(mesh) == 2, *values)
    meshio.Mesh(mesh.vertices, [("tetra", mesh.tets)], cell_data={"region": [regions]}).write(tmp_path / "a.vtu")
    assert np.array_equal(read_input(tmp_path / "a.vtu").regions, regions)
    from_one = np.unique(regions, return_inverse=True)[1] + 1  # Gmsh's groups are positive
    for suffix in VOLUMES:
        done = convert_file(tmp_path / "a.vtu", tmp_path / f"b{suffix}")
        assert np.array_equal(read_input(tmp_path / f"b{suffix}").regions, from_one if suffix == ".msh" else regions), (
            suffix
        )
        assert any("numbered from 1" in note for note in done.notes) == (suffix == ".msh")
    for name, form in of.frame_formats.items():
        if form.holds_regions:
            notes = of.write_frames(
                tmp_path / f"c.{name}", mesh, frames_at(mesh, "tets"), "tets", name, regions=regions
            )
            assert np.array_equal(
                of.read_frames(tmp_path / f"c.{name}", format=name).regions, from_one if name == "msh" else regions
            ), name
            assert any("numbered from 1" in note for note in notes) == (name == "msh")


def test_regions_and_features_that_do_not_fit_are_refused(tmp_path):
    mesh, frames = box_tets(1), frames_at(box_tets(1), "tets")
    for what in (
        {"regions": [2**31] * 6},
        {"regions": [0.5] * 6},
        {"regions": [1]},
        {"features": [[0, 8]]},
        {"features": [[0, -1]]},
    ):
        with pytest.raises(of.InvalidInput, match="32 bits|are needed|outside 0 .. 7"):
            of.write_frames(tmp_path / "a.npz", mesh, frames, "tets", **what)
    meshio.Mesh(mesh.vertices, [("tetra", mesh.tets)], cell_data={"region": [np.array([1, 2**40, 1, 1, 1, 1])]}).write(
        tmp_path / "a.vtu"
    )
    with pytest.raises(of.InvalidInput, match=r"tet 1 .* 1099511627776: numbers of regions have 32 bits"):
        read_input(tmp_path / "a.vtu")


@pytest.mark.parametrize("binary", [0, 1])
@pytest.mark.parametrize("version", [2.2, 4.1])
def test_what_gmsh_writes_comes_back_with_groups_lines_and_views_by_their_ids(tmp_path, version, binary):
    import gmsh

    gmsh.initialize(["test"], readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.add("two")
        boxes = [(3, gmsh.model.occ.addBox(x, 0, 0, 1, 1, 1)) for x in (0, 1)]
        gmsh.model.occ.fragment(boxes[:1], boxes[1:])
        gmsh.model.occ.synchronize()
        for solid, group in ((1, 11), (2, 7)):
            gmsh.model.addPhysicalGroup(3, [solid], group, name="two words")
        for name, value in (
            ("Mesh.MeshSizeMax", 0.9),
            ("Mesh.SaveAll", 1),
            ("Mesh.MshFileVersion", version),
            ("Mesh.Binary", binary),
        ):
            gmsh.option.setNumber(name, value)
        gmsh.model.mesh.generate(3)
        tags = gmsh.model.mesh.getElementsByType(4)[0]
        for k, name in enumerate(("frame_u", "frame_v", "frame_w")):
            view, axis = gmsh.view.add(name), np.eye(3)[k]
            values = [list(axis * (1 + i)) for i in range(len(tags))]
            gmsh.view.addModelData(view, 0, "two", "ElementData", tags[::-1], values[::-1])
            gmsh.view.write(view, str(tmp_path / "a.msh"), k > 0)
        gmsh.write(str(tmp_path / "mesh.msh"))
    finally:
        gmsh.finalize()
    found, plain = of.read_frames(tmp_path / "a.msh"), read_input(tmp_path / "mesh.msh")
    assert found.where == "tets" and np.array_equal(found.lengths[:, 0], 1 + np.arange(len(tags)))
    assert np.max(of.frames.distance(found.frames, np.tile([1.0, 0, 0, 0], (len(tags), 1)))) < 1e-14
    left = plain.tets.vertices[plain.tets.tets].mean(axis=1)[:, 0] < 1
    groups = (11, 7) if version == 4.1 else (1, 2)  # saving all, Gmsh writes no groups in version 2
    assert set(groups) == set(plain.regions) and len({*plain.regions[left]}) == len({*plain.regions[~left]}) == 1
    lines = feature_lines(plain)
    assert len(lines) >= 20 and (np.isin(plain.tets.vertices[lines], (0, 1, 2)).sum(axis=2) >= 2).all()


def test_pieces_of_vtu_files_are_joined(tmp_path):
    mesh = box_tets(1)
    meshio.vtu.write(
        tmp_path / "a.vtu",
        meshio.Mesh(mesh.vertices, [("tetra", mesh.tets)], cell_data={"region": [halves(mesh)]}),
        binary=False,
    )
    text = (tmp_path / "a.vtu").read_text()
    begin, end = text.index("<Piece"), text.index("</Piece>") + len("</Piece>")
    moved = text[begin:end].replace("0.00000000000e+00", "5.00000000000e+00")
    (tmp_path / "b.vtu").write_text(text[:end] + moved + text[end:])
    found = read_input(tmp_path / "b.vtu")
    assert (len(found.tets.tets), len(found.tets.vertices)) == (12, 16)
    assert np.array_equal(found.regions, np.tile(halves(mesh), 2))


TARGETS = (
    *VOLUMES,
    *SURFACES,
    ".stl",
    ".vtk.gz",
    ".fra",
    ".bfra",
    ".qtn",
    ".frame",
    ".npy",
    ".npz",
    ".pos",
    ".ff3",
    ".txt",
)


@pytest.mark.parametrize("suffix", TARGETS)
def test_a_full_disk_is_told_by_the_name_of_the_target_and_leaves_nothing(tmp_path, suffix):
    of.write_frames(tmp_path / "a.vtu", box_tets(3), frames_at(box_tets(3), "vertices"))
    (tmp_path / "out").mkdir()
    before, how = resource.getrlimit(resource.RLIMIT_FSIZE), signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    try:
        resource.setrlimit(resource.RLIMIT_FSIZE, (600, before[1]))
        with pytest.raises(of.IoError, match=rf"out/b\.({suffix.split('.')[1]}|node).* \(.*\)"):
            convert_file(tmp_path / "a.vtu", tmp_path / "out" / f"b{suffix}")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, how)
    assert not list((tmp_path / "out").iterdir())


def test_pipes_and_devices_are_no_files_and_links_are_followed(tmp_path):
    mesh = box_tets(1)
    of.write_frames(tmp_path / "a.vtu", mesh, frames_at(mesh, "vertices"))
    os.mkfifo(tmp_path / "pipe.vtu")
    for path in (tmp_path / "pipe.vtu", "/dev/null"):
        with pytest.raises(of.IoError, match="is no regular file"):
            convert_file(tmp_path / "a.vtu", path, to_format="npy")
    for name in ("pipe.vtu", "pipe.frame", "pipe.stl", "pipe.step"):
        (tmp_path / name).exists() or os.mkfifo(tmp_path / name)
        with pytest.raises(of.IoError, match="is a pipe or a device; save it to a file first"):
            convert_file(
                tmp_path / name,
                tmp_path / ("b.npz" if name.endswith(("vtu", "frame")) else "b.ply"),
                mesh=tmp_path / "a.vtu",
            )
    (tmp_path / "link.npz").symlink_to(tmp_path / "true.npz")
    convert_file(tmp_path / "a.vtu", tmp_path / "link.npz")
    assert (tmp_path / "link.npz").is_symlink() and len(of.read_frames(tmp_path / "true.npz").frames) == 8
    convert_file(tmp_path / "a.vtu", tmp_path / "a.vtu")
    assert len(of.read_frames(tmp_path / "a.vtu").frames) == 8


@pytest.mark.parametrize("name", ["with space.vtu", "-dash.vtu", "a.b.c.VTU", "quote'\"$.vtu", "überm äßig.vtu"])
def test_any_name_will_do(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    of.write_frames(name, box_tets(1), frames_at(box_tets(1), "vertices"))
    convert_file(name, f"{name}.ovmb.gz")
    assert len(of.read_frames(f"{name}.ovmb.gz").frames) == 8


def test_where_numbers_do_not_tell_the_place_of_frames_a_note_does(tmp_path):
    """Eight vertices, eight tets: an octahedron's, about its axis, and a corner of one."""
    ring = [2, 3, 4, 5]
    points = [[0, 0, 1], [0, 0, -1], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 0], [0, 0, 3]]
    tets = [[a, b, c, 6] for i, j in zip(ring, ring[1:] + ring[:1]) for a, b, c in ((0, i, j), (1, j, i))]
    points, tets = np.array(points, float), np.array(tets)
    tets[np.linalg.det(points[tets[:, 1:]] - points[tets[:, :1]]) < 0] = tets[
        np.linalg.det(points[tets[:, 1:]] - points[tets[:, :1]]) < 0
    ][:, [0, 2, 1, 3]]
    mesh = of.TetMesh(points[:7], tets[:7])
    frames = frames_at(mesh, "vertices")
    np.save(tmp_path / "a.npy", frames)
    found = of.read_frames(tmp_path / "a.npy", mesh)
    assert found.where == "vertices" and any("as many vertices as tets" in note for note in found.notes)
    assert not of.read_frames(tmp_path / "a.npy", mesh, where="tets").notes
    of.write_frames(tmp_path / "a.npz", mesh, frames)
    assert not of.read_frames(tmp_path / "a.npz").notes
