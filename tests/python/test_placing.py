"""Which frame of a file belongs to which vertex or tet, and what comes with it."""

import numpy as np
import octafield as of
import pytest
from conftest import box_tets
from octafield.domain.inputs import read_input
from octafield.errors import InvalidInput
from octafield.frame_files import placing
from octafield.frame_files.base import FrameFile


@pytest.fixture(scope="module")
def mesh():
    return box_tets(2)


def file_of(count: int, where: str = "tets", **more) -> FrameFile:
    frames = np.asarray(of.frames.random_rotations(count, 3)) if count else np.empty((0, 4))
    return FrameFile("a.x", "npz", frames, where, **more)


def test_the_number_of_frames_tells_where_they_are(mesh):
    counts = {"vertices": len(mesh.vertices), "tets": len(mesh.tets)}
    for site, count in counts.items():
        for usual in counts:
            found = placing.place(file_of(count, usual), mesh, None)
            assert (found.where, found.mesh, len(found.frames)) == (site, mesh, count)
            assert placing.place(file_of(count, usual), mesh, site).where == site


@pytest.mark.parametrize("off", [-1, 1])
@pytest.mark.parametrize("asked", [None, "vertices", "tets"])
def test_another_number_of_frames_is_refused_with_all_numbers(mesh, off, asked):
    counts = {"vertices": len(mesh.vertices), "tets": len(mesh.tets)}
    count = counts[asked or "tets"] + off
    with pytest.raises(
        InvalidInput, match=f"a.x: {count} frames; the mesh has {counts['vertices']} vertices and {counts['tets']} tets"
    ) as error:
        placing.place(file_of(count), mesh, asked)
    assert (asked is not None) == (
        f"frames at {asked} were asked for" in str(error.value)
    ) and error.value.kind == "bad_count"
    other = "vertices" if asked == "tets" else "tets"
    if asked:
        with pytest.raises(InvalidInput, match=f"frames at {asked} were asked for"):
            placing.place(file_of(counts[other]), mesh, asked)


def test_where_both_numbers_fit_the_formats_usual_place_is_taken():
    mesh = of.TetMesh(np.eye(8, 3), np.array([[0, 1, 2, 3]] * 8, np.int32))
    for where in ("vertices", "tets"):
        assert placing.place(file_of(8, where), mesh, None).where == where


def test_without_a_mesh_frames_stay_where_the_file_has_them_or_where_they_are_asked_for():
    for where in ("vertices", "tets"):
        assert placing.place(file_of(5, where), None, None).where == where
        found = placing.place(file_of(5, where), None, "tets")
        assert found.where == "tets" and found.mesh is None


def test_the_mesh_of_the_file_is_taken_where_none_is_given(mesh):
    found = placing.place(file_of(len(mesh.tets), mesh=mesh), None, None)
    assert found.mesh is mesh and found.where == "tets"
    with pytest.raises(InvalidInput, match="were made on"):
        placing.place(file_of(7, mesh=mesh), None, None)


def two_regions_and_a_stray_point(tmp_path, mesh):
    """A Medit file of the box: a point first that no tet has, two regions, the box's feature edges as ridges."""
    path = tmp_path / "a.mesh"
    points = np.vstack([[9, 9, 9], np.asarray(mesh.vertices)])
    tets = np.asarray(mesh.tets) + 2
    text = f"MeshVersionFormatted 2\nDimension 3\nVertices {len(points)}\n" + "".join(
        f"{x} {y} {z} 0\n" for x, y, z in points
    )
    text += f"Tetrahedra {len(tets)}\n" + "".join(
        f"{a} {b} {c} {d} {1 + (k % 2)}\n" for k, (a, b, c, d) in enumerate(tets)
    )
    text += "Edges 1\n2 3 0\nRidges 1\n1\nEnd\n"
    path.write_text(text)
    return read_input(path)


def test_frames_for_all_points_of_the_file_lose_those_of_points_without_tets(tmp_path, mesh):
    given = two_regions_and_a_stray_point(tmp_path, mesh)
    count = len(mesh.vertices) + 1
    assert given.points_in_file == count and len(given.tets.vertices) == count - 1
    lengths = np.random.default_rng(1).uniform(1, 2, (count, 3))
    for asked in (None, "vertices"):
        frames = file_of(count, lengths=lengths)
        found = placing.place(frames, given, asked)
        assert found.where == "vertices"
        np.testing.assert_array_equal(found.mesh.tets, given.tets.tets)
        np.testing.assert_array_equal(found.mesh.vertices, given.tets.vertices)
        np.testing.assert_array_equal(found.frames, frames.frames[1:])
        np.testing.assert_array_equal(found.lengths, lengths[1:])
    assert placing.place(file_of(count), given, None).lengths is None
    with pytest.raises(InvalidInput, match="frames at tets were asked for"):
        placing.place(file_of(count), given, "tets")
    with pytest.raises(InvalidInput, match=f"{count + 1} frames"):
        placing.place(file_of(count + 1), given, None)
    with pytest.raises(InvalidInput, match=f"{count} frames"):
        placing.place(file_of(count), given.tets, None)


def test_regions_features_and_notes_of_the_mesh_come_with_the_frames(tmp_path, mesh):
    given = two_regions_and_a_stray_point(tmp_path, mesh)
    before = np.array([[0, 2]])
    found = placing.place(file_of(len(mesh.tets), notes=["first"], features=before), given, None)
    assert given.notes and found.notes == ["first", *given.notes]
    np.testing.assert_array_equal(found.regions, given.regions)
    np.testing.assert_array_equal(found.features, given.features_of_tets())
    assert sorted(found.features[0].tolist()) == [0, 1]
    given.lines = None
    np.testing.assert_array_equal(placing.place(file_of(len(mesh.tets), features=before), given, None).features, before)


def test_frames_with_centres_of_every_vertex_or_tet_are_in_order(mesh):
    points = np.asarray(mesh.vertices)
    for where, sites in (("vertices", points), ("tets", points[np.asarray(mesh.tets)].mean(axis=1))):
        for asked in (None, where):
            frames = file_of(len(sites), centres=sites)
            found = placing.place(frames, mesh, asked)
            assert found.where == where and found.notes == [] and found.frames is frames.frames
        other = "tets" if where == "vertices" else "vertices"
        moved = placing.place(file_of(len(sites), centres=sites), mesh, other)
        assert (
            moved.where == other
            and len(moved.notes) == 1
            and len(moved.frames) == len(mesh.tets if other == "tets" else points)
        )


def test_the_note_tells_how_far_the_nearest_centres_are_and_tets_are_the_usual_place(mesh):
    centres = np.array([[0.0, 0, 0], [1, 1, 1]])
    found = placing.place(file_of(2, centres=centres, notes=["before"]), mesh, None)
    sites = np.asarray(mesh.vertices)[np.asarray(mesh.tets)].mean(axis=1)
    distances = np.linalg.norm(sites[:, None] - centres[None], axis=2)
    assert found.where == "tets" and (found.frames == file_of(2).frames[distances.argmin(axis=1)]).all()
    assert found.notes == [
        "before",
        f"each of the tets took the frame with the nearest centre, {distances.min(axis=1).max():.3g} away at most",
    ]
    with pytest.raises(InvalidInput, match="a.x: holds no frames"):
        placing.place(file_of(0, centres=np.empty((0, 3))), mesh, None)
