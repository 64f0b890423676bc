"""Files of frames: what octafield writes others read, what others write it reads, and what each convention means."""

import gzip
from dataclasses import replace

import mesh_table
import numpy as np
import octafield
import other_readers as readers
import pytest
from conftest import box_tets
from format_table import FORMATS_BEGIN, available, axes, frames_at, on_page, rows, table_of, table_of_formats
from hypothesis import given, settings
from hypothesis import strategies as st
from octafield import frame_formats, read_frames, write_frames
from octafield.frame_files.registry import FORMATS

SUFFIX = {"geogram": ".txt", "geogram-centres": ".txt"}


@pytest.fixture(scope="module")
def mesh():
    return box_tets(3)


def name_of(folder, name: str, packed: str = ""):
    return folder / f"field{SUFFIX.get(name) or frame_formats[name].extensions[0]}{packed}"


def test_the_table_of_round_trips_in_the_docs_is_what_this_run_finds(mesh, tmp_path):
    lines = on_page().splitlines()
    here = [line for line in lines if "|" not in line or available((line.split("|") + [""] * 4)[4].strip())]
    assert here == table_of(rows(mesh, tmp_path)).splitlines(), (
        "PYTHONPATH=tests/python python tests/python/format_table.py"
    )


def test_the_table_of_mesh_round_trips_in_the_docs_is_what_this_run_finds(tmp_path):
    assert on_page(mesh_table.BEGIN) == mesh_table.table_of(mesh_table.rows(tmp_path)), (
        "PYTHONPATH=tests/python python tests/python/format_table.py"
    )


def test_the_list_of_formats_in_the_docs_is_that_of_the_program():
    assert on_page(FORMATS_BEGIN) == table_of_formats()


@pytest.mark.parametrize("packed", ["", ".gz"])
@pytest.mark.parametrize("name", FORMATS)
def test_own_round_trips_keep_the_frames_and_the_bits_where_promised(mesh, tmp_path, name, packed):
    form = frame_formats[name]
    for where in form.where:
        if not (form.read and form.write):
            continue
        frames = frames_at(mesh, where)
        none_given = ["no feature edges were given: the file marks none"] if frame_formats[name].holds_features else []
        assert write_frames(name_of(tmp_path, name, packed), mesh, frames, where, name) == none_given
        found = read_frames(name_of(tmp_path, name, packed), None if form.holds_mesh else mesh, name)
        assert found.where == where and found.format == name and found.deviation == 0 and found.left_handed == 0
        assert (
            np.array_equal(found.frames, frames)
            if form.exact
            else np.max(octafield.frames.distance(found.frames, frames)) < 2e-15
        )
        assert np.array_equal(np.sort(found.mesh.tets, axis=1), np.sort(mesh.tets, axis=1))
        assert np.array_equal(found.mesh.vertices, mesh.vertices)


def test_equal_fields_make_equal_bytes_and_a_failed_write_leaves_nothing(mesh, tmp_path):
    frames = frames_at(mesh, "tets")
    for name in ("npz", "ovmb", "mouette", "vtu"):
        for packed in ("", ".gz"):
            path = name_of(tmp_path, name, packed)
            write_frames(path, mesh, frames, "tets", name)
            first = path.read_bytes()
            write_frames(path, mesh, frames, "tets", name)
            assert path.read_bytes() == first
    (tmp_path / "file").write_text("")
    with pytest.raises(octafield.IoError, match="cannot write"):
        write_frames(tmp_path / "file" / "a.qtn", mesh, frames, "tets")
    with pytest.raises(octafield.IoError, match="is a folder"):
        write_frames(tmp_path, mesh, frames, "tets", "qtn")
    assert not [p for p in tmp_path.iterdir() if p.name.startswith(".")]


def test_perm_tells_which_axis_of_the_neighbour_an_axis_becomes(mesh, tmp_path):
    frames = frames_at(mesh, "tets")
    write_frames(tmp_path / "a.fra", mesh, frames, "tets")
    count, listed = readers.perm(tmp_path / "a.perm")
    assert count == len(mesh.tets) and len(listed) > 0
    known = {tuple(row[:2]): row[2:] for row in listed}
    triads = axes(frames)
    tets = np.asarray(mesh.tets)
    pairs = 0
    for a in range(count):
        for b in range(a + 1, count):
            if len(np.intersect1d(tets[a], tets[b])) != 3:
                assert (a, b) not in known
                continue
            pairs += 1
            p = known.get((a, b), np.array([1, 2, 3]))
            mapped = np.sign(p) * triads[b][:, np.abs(p) - 1]
            best = max(np.trace(triads[a].T @ triads[b] @ m) for m in rotations_of_the_cube())
            assert np.trace(triads[a].T @ mapped) == pytest.approx(best, abs=1e-12)  # the closest of all 24
            assert np.linalg.det(mapped) == pytest.approx(1)
    assert pairs > 100


def rotations_of_the_cube():
    import itertools

    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1, -1), repeat=3):
            m = np.zeros((3, 3))
            m[order, range(3)] = signs
            if np.linalg.det(m) > 0:
                yield m


@pytest.mark.parametrize("suffix", [".ovm", ".ovmb"])
def test_openvolumemesh_files_have_half_faces_into_their_cells_and_features_as_algohex_names_them(tmp_path, suffix):
    from test_tet_input import cube_edges, halves

    mesh = box_tets(4)
    path = tmp_path / f"a{suffix}"
    write_frames(path, mesh, frames_at(mesh, "tets"), "tets", features=cube_edges(mesh), regions=halves(mesh))
    found = readers.ovm_text(path) if suffix == ".ovm" else readers.ovm_binary(path)
    cells, volumes = readers.ovm_tets(found)
    assert np.array_equal(cells, np.sort(mesh.tets, axis=1))
    assert np.allclose(volumes, octafield.volume.tet_volumes(mesh))
    marked = found["Edges"][found["EProp", "AlgoHex::FeatureEdges"].ravel() > 0]
    assert np.array_equal(np.unique(np.sort(marked, axis=1), axis=0), cube_edges(mesh))
    corners = np.flatnonzero(found["VProp", "AlgoHex::FeatureVertices"])
    assert np.array_equal(corners, np.flatnonzero(np.isin(mesh.vertices, (0, 1)).all(axis=1)))
    assert (found["FProp", "AlgoHex::FeatureFaces"] > 0).sum() == 6 * 2 * 16 + 2 * 16  # and between the halves
    assert np.array_equal(found["CProp", "region"].ravel(), halves(mesh))
    back = read_frames(path)
    assert np.array_equal(back.features[np.lexsort(back.features.T[::-1])], cube_edges(mesh))
    assert np.array_equal(back.regions, halves(mesh))


def test_faces_of_a_cell_are_found_for_every_vertex_order_in_an_ovm_file(tmp_path):
    tet = octafield.TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
    q = np.array([[1.0, 0, 0, 0]])
    write_frames(tmp_path / "a.ovm", tet, q, "tets")
    text = (tmp_path / "a.ovm").read_text()
    row = next(line for line in text.splitlines() if line.startswith("4 "))
    half_faces = row.split()[1:]
    for turn in range(4):
        turned = half_faces[turn:] + half_faces[:turn]
        (tmp_path / "b.ovm").write_text(text.replace(row, "4 " + " ".join(turned)))
        assert octafield.volume.tet_volumes(read_frames(tmp_path / "b.ovm").mesh) == pytest.approx([1 / 6])
    (tmp_path / "c.ovm").write_text(
        text.replace(row, f"4 {half_faces[0]} {half_faces[0]} {half_faces[1]} {half_faces[2]}")
    )
    with pytest.raises(octafield.InvalidInput, match="cell 0 .* bound no tetrahedron"):
        read_frames(tmp_path / "c.ovm")


def test_lengths_handedness_and_skew_of_axes_are_told(mesh, tmp_path):
    frames = frames_at(mesh, "vertices")
    triads = axes(frames)
    rng = np.random.default_rng(2)
    lengths = rng.uniform(0.1, 9, (len(frames), 3))
    left = rng.random(len(frames)) < 0.5
    given = triads * lengths[:, None, :]
    given[left, :, 1] *= -1
    np.savetxt(tmp_path / "a.txt", given.transpose(0, 2, 1).reshape(-1, 9), fmt="%.17g")
    found = read_frames(tmp_path / "a.txt", mesh)
    assert np.max(octafield.frames.distance(found.frames, frames)) < 2e-15
    assert np.allclose(found.lengths, lengths, rtol=1e-14) and found.left_handed == left.sum()
    assert any("left-handed" in note for note in found.notes) and any("lengths" in note for note in found.notes)
    write_frames(
        tmp_path / "b.ff3",
        mesh,
        octafield.volume.tet_frames(mesh, frames),
        "tets",
        lengths=np.full((len(mesh.tets), 3), 2.5),
    )
    assert np.allclose(read_frames(tmp_path / "b.ff3", mesh).lengths, 2.5)
    skew = triads.copy()
    skew[:, :, 0] += 0.1 * skew[:, :, 1]  # 5.7 degrees between two axes: half of it for each
    np.savetxt(tmp_path / "c.txt", skew.transpose(0, 2, 1).reshape(-1, 9), fmt="%.17g")
    found = read_frames(tmp_path / "c.txt", mesh)
    assert found.deviation == pytest.approx(np.arctan(0.1) / 2, rel=1e-6)
    from scipy.linalg import polar

    unit = skew / np.linalg.norm(skew, axis=1, keepdims=True)
    assert np.allclose(axes(found.frames)[5], polar(unit[5])[0])  # the nearest rotation


@pytest.mark.parametrize(
    "bad", ["0 0 0  0 1 0  0 0 1", "1 0 0  0 1 0  1 1 0", "1 0 0  0 1 0  0 0 nan", "1 0 0  0 1 0  0 0 inf"]
)
def test_triads_that_are_no_frames_are_refused_with_their_line(mesh, tmp_path, bad):
    path = tmp_path / "a.txt"
    path.write_text("1 0 0 0 1 0 0 0 1\n\n" + bad + "\n")
    with pytest.raises(octafield.InvalidInput, match="a.txt, line 3: .*frame 1") as caught:
        read_frames(path, format="arff")
    assert caught.value.elements == [1]


def test_numbers_of_frames_tell_where_they_sit(mesh, tmp_path):
    q = frames_at(mesh, "tets")
    np.save(tmp_path / "t.npy", q)
    assert read_frames(tmp_path / "t.npy", mesh).where == "tets"
    assert (
        read_frames(tmp_path / "t.npy").where == "vertices"
    )  # as numpy files usually have it; there is no mesh to tell
    assert read_frames(tmp_path / "t.npy", where="tets").where == "tets"
    with pytest.raises(
        octafield.InvalidInput, match="162 frames; the mesh has 64 vertices and 162 tets, and frames at vertices"
    ):
        read_frames(tmp_path / "t.npy", mesh, where="vertices")
    with pytest.raises(octafield.InvalidInput, match="162 frames; the mesh has 27 vertices and 48 tets"):
        read_frames(tmp_path / "t.npy", box_tets(2))


def test_centres_find_their_tets_in_any_order(mesh, tmp_path):
    q = frames_at(mesh, "tets")
    path = tmp_path / "a.txt"
    write_frames(path, mesh, q, "tets", "geogram-centres")
    lines = path.read_text().splitlines()
    order = np.random.default_rng(1).permutation(len(lines))
    path.write_text("\n".join(lines[i] for i in order))
    found = read_frames(path, mesh)
    assert np.max(octafield.frames.distance(found.frames, q)) < 2e-15 and "nearest centre" in found.notes[-1]


def test_points_that_no_tet_uses_take_their_frames_with_them(mesh, tmp_path):
    import meshio

    points = np.vstack([[9.0, 9, 9], np.asarray(mesh.vertices), [8.0, 8, 8]])
    q = np.asarray(octafield.frames.random_rotations(len(points), 4))
    cells = [("tetra", np.asarray(mesh.tets) + 1)]
    meshio.Mesh(points, cells).write(tmp_path / "a.mesh")
    np.save(tmp_path / "a.npy", q)
    assert np.array_equal(read_frames(tmp_path / "a.npy", tmp_path / "a.mesh").frames, q[1:-1])
    meshio.Mesh(points, cells, point_data={"quaternion": q}).write(tmp_path / "a.vtu")
    assert np.array_equal(read_frames(tmp_path / "a.vtu").frames, q[1:-1])


def test_frames_move_between_vertices_and_tets_by_the_mean(mesh, tmp_path):
    free = octafield.volume.BoundaryConstraints(
        np.zeros(64, np.uint8),
        np.zeros((64, 3)),
        np.tile([1.0, 0, 0, 0], (64, 1)),
        np.zeros(64, np.uint8),
        np.empty(0, np.int32),
    )
    q = np.asarray(octafield.volume.smooth(mesh, free, frames_at(mesh, "vertices"), max_iterations=3).frames)
    notes = write_frames(tmp_path / "a.frame", mesh, q)
    assert "nearest to the mean sh4 vector" in notes[0]
    found = read_frames(tmp_path / "a.frame", mesh)
    assert np.max(octafield.frames.distance(found.frames, octafield.volume.tet_frames(mesh, q))) < 2e-15
    write_frames(tmp_path / "b.npy", mesh, found.frames, "tets", at="vertices")
    assert (
        np.max(
            octafield.frames.distance(
                read_frames(tmp_path / "b.npy").frames, octafield.volume.vertex_frames(mesh, found.frames)
            )
        )
        < 2e-15
    )
    with pytest.raises(octafield.InvalidInput, match="at tets only"):
        write_frames(tmp_path / "c.frame", mesh, q, at="vertices")


def test_sh4_vectors_are_read_with_m_ascending(mesh, tmp_path):
    import meshio

    q = frames_at(mesh, "vertices")
    meshio.Mesh(mesh.vertices, [("tetra", mesh.tets)], point_data={"sh4": 3 * octafield.frames.sh4_embed(q)}).write(
        tmp_path / "a.vtu"
    )
    assert np.max(octafield.frames.distance(read_frames(tmp_path / "a.vtu").frames, q)) < 1e-7


@given(
    st.lists(
        st.lists(st.floats(-1, 1), min_size=4, max_size=4).filter(lambda q: sum(x * x for x in q) > 1e-3),
        min_size=1,
        max_size=20,
    )
)
@settings(max_examples=50, deadline=None)
def test_any_rotation_goes_through_nine_numbers(tmp_path_factory, values):
    q = np.array(values)
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    path = tmp_path_factory.mktemp("q") / "a.txt"
    write_frames(path, None, q)
    assert np.max(octafield.frames.distance(read_frames(path).frames, q)) < 2e-15
    write_frames(path.with_suffix(".qtn"), None, q, "tets")
    q = np.where(
        np.abs(np.linalg.norm(q, axis=1, keepdims=True) - 1) > 1e-15, read_frames(path.with_suffix(".qtn")).frames, q
    )
    assert np.array_equal(read_frames(path.with_suffix(".qtn")).frames, q)


def test_lines_are_written_and_read_without_a_call_each(tmp_path):
    """Of ours: numpy's own loop over lines is its affair."""
    import sys

    q, calls = np.tile(octafield.frames.random_rotations(1000, 1), (20, 1)), []
    sys.setprofile(
        lambda frame, event, argument: (
            event == "call"
            and "octafield" in frame.f_code.co_filename
            and frame.f_code.co_name[0] != "<"
            and calls.append(frame.f_code.co_name)
        )
    )
    try:
        write_frames(tmp_path / "a.txt", None, q)
        found = read_frames(tmp_path / "a.txt")
    finally:
        sys.setprofile(None)
    assert len(found.frames) == len(q) and len(calls) < len(q) / 2


def test_writers_refuse_what_does_not_fit(mesh, tmp_path):
    q = frames_at(mesh, "vertices")
    for arguments, message in (
        (("a.frame", mesh, q[1:]), "63 frames; the mesh has 64 vertices"),
        (("a.fra", None, q), "need the mesh"),
        (("a.frame", None, q), "taken to tets with the mesh"),
        (("a.npy", mesh, q[:, :3]), r"\(n, 4\)"),
        (("a.npy", mesh, 0 * q), "zero or not finite"),
        (("a.npy", mesh, q, "corners"), "where must be one of"),
        (("a.npy", mesh, q, "vertices", "unheard"), "format 'unheard' is not one of"),
    ):
        with pytest.raises(octafield.InvalidInput, match=message):
            write_frames(tmp_path / arguments[0], *arguments[1:])
    with pytest.raises(octafield.IoError, match="known to write are arff"):
        write_frames(tmp_path / "a.xyz", mesh, q)
    with pytest.raises(octafield.InvalidInput, match="no edges of the tet mesh"):
        write_frames(tmp_path / "a.ovm", mesh, q, features=[[0, 63]])
    assert list(tmp_path.iterdir()) == []


def test_every_format_tells_what_it_is():
    for name, form in frame_formats.items():
        assert form.name == name and form.title and form.holds and form.source and (form.read or form.write)
        assert replace(form, name=name) == form
    with pytest.raises(TypeError):
        frame_formats["mine"] = None


def test_packed_files_are_packed(mesh, tmp_path):
    write_frames(tmp_path / "a.qtn.gz", mesh, frames_at(mesh, "tets"), "tets")
    assert gzip.decompress((tmp_path / "a.qtn.gz").read_bytes()).count(b"\n") == len(mesh.tets)
