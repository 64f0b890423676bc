"""Each level of repair mends what it says and no more; what a message recommends works."""

import numpy as np
import octafield as of
import pytest
from conftest import SHARED_DATA
from damaged_surfaces import ZOO, ball, joined, mesh_of, moved, open_cylinder, sheet, soup
from octafield.command_line.fields import app
from octafield.domain.generators import generate
from octafield.domain.meshing import load_surface, read_sound
from octafield.inspect.info import examine
from octafield.options import REPAIR_LEVELS, MeshOptions
from octafield.runs.conversion import convert_file
from pipeline_fixtures import octafield, shared
from typer.testing import CliRunner

WILD = SHARED_DATA / "wild"
SOUND = {"ball": ball, "box": lambda: generate("box"), "torus": lambda: generate("torus"),
    "cavity": lambda: joined(ball(), mesh_of(np.asarray(ball(2).vertices) / 2,
        np.asarray(ball(2).triangles)[:, ::-1])), "tiny beside large": lambda: joined(ball(),
        moved(mesh_of(np.asarray(ball(1).vertices) * 1e-5, ball(1).triangles), 2, 0, 0))}  # fmt: skip


def kinds(mesh, **tests):
    return [defect.kind for defect in of.surface.find_defects(mesh, **tests)]


@pytest.mark.parametrize("name", SOUND)
@pytest.mark.parametrize("level", REPAIR_LEVELS)
def test_a_sound_surface_is_left_as_it_is_bit_by_bit(name, level):
    mesh = SOUND[name]()
    assert kinds(mesh) == []
    done = of.surface.repair(mesh, level=level)
    assert done.actions == [] and done.largest_move == 0
    assert np.asarray(done.mesh.vertices).tobytes() == np.asarray(mesh.vertices).tobytes()
    np.testing.assert_array_equal(done.mesh.triangles, mesh.triangles)


@pytest.mark.parametrize("name", ZOO)
def test_the_level_that_is_recommended_mends_it_and_none_below_does(name):
    make, expected = ZOO[name]
    mesh = make()
    advice = of.surface.advise_repair(mesh)
    left = {level: kinds(of.surface.repair(mesh, level=level).mesh) for level in REPAIR_LEVELS}
    assert advice.level == (expected or "none"), left
    if expected is None:
        assert all(left.values()) and [defect.kind for defect in advice.left] == left["wrap"]
        return
    place = REPAIR_LEVELS.index(expected)
    assert left[expected] == [] and all(left[level] for level in REPAIR_LEVELS[:place])
    done = of.surface.repair(mesh, level=expected)
    assert done.actions == advice.actions != []
    assert all(left[level] == [] for level in REPAIR_LEVELS[place:])


@pytest.mark.parametrize("name", [name for name, (_, level) in ZOO.items() if level in ("merge", "safe", "fill")])
def test_below_resolve_every_point_stays_but_for_merging_within_the_tolerance(name):
    mesh = ZOO[name][0]()
    done = of.surface.repair(mesh, level="fill")
    before = {tuple(point) for point in (np.asarray(mesh.vertices) + 0.0).tolist()}
    kept = [tuple(point) in before for point in (np.asarray(done.mesh.vertices) + 0.0).tolist()]
    first_new = kept.index(False) if False in kept else len(kept)
    assert not any(kept[first_new:])  # new points of patches come last
    assert done.largest_move <= 2 * of.surface.coordinate_precision(mesh.vertices)


def test_precision_is_seen_in_the_numbers():
    points = np.random.default_rng(1).random((50, 3)) * 3
    assert of.surface.coordinate_precision(points.astype(np.float32)) == 2**-22  # spacing of float32 between 2 and 4
    for digits in (6, 9, 14):
        rounded = [[float(f"{x:.{digits}g}") for x in point] for point in points]
        assert of.surface.coordinate_precision(rounded) == pytest.approx(10.0 ** (1 - digits))
    assert of.surface.coordinate_precision(points) == pytest.approx(8 * np.finfo(float).eps * points.max())
    assert of.surface.coordinate_precision(points * 1e-6) == pytest.approx(8e-6 * np.finfo(float).eps * points.max())
    assert of.surface.coordinate_precision(np.zeros((0, 3))) == 0


def test_points_farther_apart_than_the_tolerance_are_not_merged():
    apart = soup(ball(1))
    points = np.asarray(apart.vertices) + 1e-9 * np.random.default_rng(2).standard_normal((len(apart.vertices), 3))
    mesh = mesh_of(points, apart.triangles)
    assert of.surface.repair(mesh, level="merge", merge_tolerance=1e-10).actions == []
    merged = of.surface.repair(mesh, level="merge", merge_tolerance=2e-8)
    assert kinds(merged.mesh) == [] and 0 < merged.largest_move <= 2e-8
    assert merged.actions[0].startswith(f"merged {len(points) - 42} points of open edges")


def test_counts_in_actions_are_those_of_the_defects():
    torn = joined(ball(), mesh_of(np.eye(3) * 1e-4 + 2, [[0, 1, 2]]))
    points, triangles = np.asarray(torn.vertices), np.array(torn.triangles)
    triangles[3:8] = triangles[3:8, ::-1]
    triangles = np.concatenate([np.delete(triangles, [40, 41], axis=0), triangles[:2]])
    actions = of.surface.repair(mesh_of([*points, [9, 9, 9], [8, 8, 8]], triangles)).actions
    assert [action.partition(" ")[0] + " " + action.split()[1] for action in actions][:3] == [
        "removed 2",
        "removed 1",
        "reversed 5",
    ]
    assert any(
        action.startswith("filled 1 hole with 2 triangles") or action.startswith("filled 2 holes with 2 triangles")
        for action in actions
    )
    assert actions[-1].startswith("left out 5 points")  # and the three of the crumb


def test_a_cylinder_gets_a_lid_and_a_ball_its_cap_again():
    lid = of.surface.repair(open_cylinder(), level="fill").mesh
    assert of.surface.signed_volume(lid) == pytest.approx(of.surface.signed_volume(generate("cylinder")), rel=1e-12)
    cap = of.surface.repair(ZOO["ball without a cap"][0](), level="fill").mesh
    whole = of.surface.signed_volume(ball(4))
    assert of.surface.signed_volume(cap) == pytest.approx(whole, rel=0.01)
    assert (
        of.surface.signed_volume(
            of.surface.repair(ZOO["ball without a cap"][0](), level="safe", small_hole_edges=1000).mesh
        )
        < 0.985 * whole
    )


def test_the_bound_of_holes_is_kept_and_told():
    mesh = open_cylinder()
    bounded = of.surface.repair(mesh, level="fill", max_hole_edges=63)
    assert kinds(bounded.mesh) == ["not_closed"]
    assert any("63" in action and "64" in action and "--max-hole-edges" in action for action in bounded.actions)
    assert kinds(of.surface.repair(mesh, level="fill", max_hole_edges=64).mesh) == []


def test_pieces_that_cross_become_their_union():
    one, other = generate("box"), moved(generate("box"), 0.5, 0.25, 0.125)
    done = of.surface.repair(joined(one, other), level="resolve")
    assert kinds(done.mesh) == [] and "united 1 piece" in done.actions[0]
    assert of.surface.signed_volume(done.mesh) == pytest.approx(2 - 0.5 * 0.75 * 0.875, rel=1e-12)


def test_a_wrap_says_how_far_it_lies_and_lies_no_farther():
    mesh = joined(generate("box"), moved(generate("box"), 1, 1, 0))
    mesh = of.surface.repair(mesh, level="merge").mesh
    done = of.surface.repair(mesh, level="wrap", wrap_alpha=0.1, wrap_offset=0.01)
    assert kinds(done.mesh) == [] and "alpha 0.1, offset 0.01" in done.actions[-1]
    points = np.asarray(done.mesh.vertices)
    assert -points.min() < 0.011
    assert abs(of.surface.signed_volume(done.mesh) - 2) < 12 * done.largest_move
    refused = of.surface.repair(sheet(), level="wrap").actions
    assert any(action.startswith("not wrapped") for action in refused)


def test_unused_points_are_left_out_before_anything_is_measured(tmp_path):
    path = tmp_path / "far.obj"
    points = [*np.asarray(ball().vertices).tolist(), [500, 0, 0]]
    path.write_text(
        "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points)
        + "".join(f"f {a} {b} {c}\n" for a, b, c in np.asarray(ball().triangles) + 1)
    )
    record = examine(path)
    assert (
        record["ok"]
        and record["bounding_box"]["diagonal"] < 4
        and record["notes"] == ["1 vertices that no triangle uses were left out"]
    )


def test_lines_of_the_file_survive_repair_where_they_are_edges(tmp_path):
    import meshio

    box = generate("box")
    points, triangles = np.asarray(box.vertices), np.asarray(box.triangles)
    lines = of.surface.detect_features(box).edges
    path = tmp_path / "turned.vtk"
    meshio.Mesh(points, [("triangle", np.concatenate([triangles[:3], triangles[3:, ::-1]])), ("line", lines)]).write(
        path, binary=False
    )
    sound = read_sound(path, of.MeshOptions(repair="safe", features="file"))
    assert len(sound.features.edges) == 12 and any(note.startswith("repair: reversed 3") for note in sound.found.notes)


def test_levels_are_words_and_true_means_safe():
    assert of.MeshOptions(repair=True).repair == "safe" and of.MeshOptions(repair=False).repair == "none"
    with pytest.raises(of.InvalidInput, match="did you mean 'merge'"):
        of.MeshOptions(repair="marge")
    for wrong in ({"max_hole_edges": -1}, {"wrap_alpha": float("nan")}, {"wrap_offset": -1.0}):
        with pytest.raises(of.InvalidInput):
            of.MeshOptions(**wrong)


@pytest.mark.parametrize("name, level", [("open cylinder", "fill"), ("spike", "resolve"), ("sheet", None)])
def test_the_command_recommends_what_works(name, level, tmp_path):
    path = tmp_path / "damaged.ply"
    of.write_surface(ZOO[name][0](), path)
    for command in (("info", path), ("field", path, "-o", tmp_path / "out")):
        message = octafield(*command, check=2).stderr
        assert "defect:" not in message
        if level is None:
            assert "no level of --repair makes it sound" in message and "not wrapped" in message
        else:
            assert f"--repair {level} makes it sound (" in message and "(0" not in message.split("the first at")[0]
    if level:
        octafield("info", path, "--repair", level, check=0)
        below = octafield("info", path, "--repair", REPAIR_LEVELS[REPAIR_LEVELS.index(level) - 1], check=2).stderr
        assert f"--repair {level} makes it sound" in below


@pytest.mark.parametrize("name, euler", [("cube_split_zero.stl", 2), ("part_split_points.stl", -16)])
def test_split_points_of_stl_files_are_one_by_default(name, euler):
    surface = load_surface(shared(WILD / name))
    assert kinds(surface) == [] and of.surface.euler_characteristic(surface) == euler
    with pytest.raises(of.GeometryError, match="--repair merge makes it sound"):
        load_surface(WILD / name, repair="none")


def test_a_large_hole_is_filled_on_request():
    path = shared(WILD / "cup_open_60.stl")
    with pytest.raises(of.GeometryError, match="--repair fill makes it sound .filled 1 hole"):
        load_surface(path)
    assert kinds(load_surface(path, repair="fill")) == []


def test_a_fold_of_rounded_coordinates_is_repaired_within_a_stated_tolerance():
    mesh = of.read_surface(shared(WILD / "fold_patch.stl"))
    assert "self_intersection" in kinds(mesh, closed=False)
    done = of.surface.repair(mesh, level="resolve", closed=False)
    assert kinds(done.mesh, closed=False) == [] and done.actions
    assert 0 < done.largest_move < 1e-3 * of.surface.bounding_box_diagonal(mesh.vertices)


@pytest.mark.parametrize("name, diagonal", [("o_unref.obj", 1.5), ("t_flap.off", None)])
def test_unused_far_points_do_not_count(name, diagonal):
    record = examine(shared(WILD / name), of.MeshOptions(repair="safe"))
    assert record["ok"], [r for r in record["requirements"] if r["state"] == "fail"]
    used = of.read_surface(WILD / name)
    points = np.asarray(used.vertices)[np.unique(used.triangles)]
    assert record["bounding_box"]["diagonal"] <= np.linalg.norm(np.ptp(points, axis=0)) + 1e-12


def test_a_word_that_is_no_number_is_shown():
    message = octafield("info", shared(WILD / "s_comma.stl"), check=2).stderr
    assert '"-1,000000e+01" (a decimal comma; points are needed)' in message and "line 4" in message


@pytest.mark.parametrize("name, content, shown", [
    ("a.stl", "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 x1", '"x1"'),
    ("a.stl", "solid a\nfacet normal 0 0 0\nouter lop", '"lop"'),
    ("a.obj", "v 0 0 1,5\n", '"1,5" (a decimal comma'),
    ("a.obj", "v 0 0\n", "the line or file ends"),
    ("a.obj", "v 0 0 0\nf 1 b 1\n", '"b"'),
    ("a.off", "OFF\n3 one 0\n", '"one"'),
    ("a.off", "OFF\n3 1 0\n0 0 0\n0 0 0x\n0 0 0\n3 0 1 2\n", '"0x"'),
    ("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2.5\n", '"2.5"'),
    ("a.ply", "ply\nformat ascii 1.0\nelement vertex many\nend_header\n", '"many"'),
    ("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
              "z\nend_header\n0 \x01z 0\n", '"?z"'),
])  # fmt: skip
def test_every_text_reader_shows_the_word_it_cannot_use(name, content, shown, tmp_path):
    (tmp_path / name).write_text(content)
    with pytest.raises(of.IoError) as caught:
        of.read_surface(tmp_path / name)
    assert shown in str(caught.value)


def test_convert_repairs_up_to_the_level_and_says_what_is_left(tmp_path):
    """A box without one triangle, its points apart: merge leaves the hole and says so, safe fills it; without the
    option nothing changes."""
    mesh = generate("box")
    triangles = np.asarray(mesh.triangles)[1:]
    apart = of.TriangleMesh(np.asarray(mesh.vertices)[triangles.ravel()], np.arange(triangles.size).reshape(-1, 3))
    of.write_surface(apart, tmp_path / "in.obj")
    level = lambda name: MeshOptions(repair=name)
    plain = convert_file(tmp_path / "in.obj", tmp_path / "plain.obj")
    assert plain.vertices == len(apart.vertices) and plain.notes == []
    merged = convert_file(tmp_path / "in.obj", tmp_path / "merged.obj", repair=level("merge"))
    assert merged.vertices == len(mesh.vertices) and kinds(of.read_surface(tmp_path / "merged.obj")) == ["not_closed"]
    assert any(note.startswith("repair: ") for note in merged.notes) and merged.notes[-1].startswith(
        "after --repair merge: "
    )
    safe = convert_file(tmp_path / "in.obj", tmp_path / "safe.ply", repair=level("safe"))
    assert kinds(of.read_surface(tmp_path / "safe.ply")) == [] and not any(
        "after --repair" in note for note in safe.notes
    )
    assert np.isclose(of.surface.signed_volume(of.read_surface(tmp_path / "safe.ply")), of.surface.signed_volume(mesh))
    done = CliRunner().invoke(
        app, ["convert", str(tmp_path / "in.obj"), "-o", str(tmp_path / "b.off"), "--repair", "safe", "-q"]
    )
    assert (
        done.exit_code == 0
        and of.read_surface(tmp_path / "b.off").triangles.shape
        == of.read_surface(tmp_path / "safe.ply").triangles.shape
    )


def test_convert_does_not_ignore_repair_of_tets_or_frames(tmp_path):
    tets = of.prepare_mesh(generate("box"), MeshOptions(edge_length=0.5)).tets
    of.volume.write_field(tmp_path / "a.vtu", tets, np.tile([1.0, 0, 0, 0], (len(tets.vertices), 1)))
    with pytest.raises(of.InvalidInput, match="surfaces only"):
        convert_file(tmp_path / "a.vtu", tmp_path / "b.ovmb", repair=MeshOptions(repair="safe"))
    convert_file(tmp_path / "a.vtu", tmp_path / "a.mesh")
    assert any(
        "repair was ignored" in note
        for note in convert_file(tmp_path / "a.mesh", tmp_path / "b.vtk", repair=MeshOptions(repair="safe")).notes
    )
    done = CliRunner().invoke(
        app, ["convert", str(tmp_path / "a.mesh"), "-o", str(tmp_path / "c.vtk"), "--repair", "saef"]
    )
    assert done.exit_code == 2 and "did you mean 'safe'" in done.stderr


@pytest.mark.parametrize("length, collapsed", [(1e-17, True), (1e-9, False)])
def test_an_edge_that_is_rounding_is_collapsed_and_a_short_one_is_not(length, collapsed):
    box = generate("box")
    points, triangles = np.asarray(box.vertices), np.asarray(box.triangles).tolist()
    start = int(np.argmin(np.abs(points).sum(axis=1)))
    points = points - points[start]
    first = next(t for t in triangles if start in t)
    end = first[(first.index(start) + 1) % 3]
    second = next(t for t in triangles if t is not first and start in t and end in t)
    middle = len(points)
    for t in (first, second):
        triangles.remove(t)
        triangles += [[middle if v == start else v for v in t], [middle if v == end else v for v in t]]
    step = length * (points[end] - points[start]) / np.linalg.norm(points[end] - points[start])
    done = of.surface.repair(of.TriangleMesh(np.vstack([points, step]), np.array(triangles, np.int32)), level="safe")
    assert (
        (len(done.mesh.triangles) == len(box.triangles))
        == collapsed
        == any("joined the ends of 1 edge" in a for a in done.actions)
    )
    assert kinds(done.mesh) == [] and of.surface.signed_volume(done.mesh) == pytest.approx(
        of.surface.signed_volume(box)
    )


def test_a_far_point_that_no_triangle_uses_makes_nothing_small():
    box = generate("box")
    points = np.vstack([np.asarray(box.vertices), [1e15, 0, 0]])
    done = of.surface.repair(of.TriangleMesh(points, box.triangles), level="safe")
    assert done.actions == ["left out 1 point that no triangle uses"]
    assert len(done.mesh.triangles) == len(box.triangles) and len(done.mesh.vertices) == len(box.vertices)
