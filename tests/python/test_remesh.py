"""Surfaces remeshed for their own sake: figures checked on the arrays, files, options, damaged inputs."""

import json

import meshio
import numpy as np
import octafield as of
import pytest
import pyvista
from damaged_surfaces import ZOO, ball, joined, mesh_of, moved, parts, sheet
from octafield.command_line.fields import app
from octafield.domain.generators import generate
from octafield.meshes.figures import surface_deviation
from octafield.records.record_file import any_record
from octafield.remeshing.options import RemeshingOptions
from typer.testing import CliRunner

from studies import remeshing_surfaces


def edge_counts(mesh):
    triangles = np.asarray(mesh.triangles)
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    return np.unique(sides, axis=0, return_counts=True)[1]


def farthest_from(surface, points):
    given = pyvista.PolyData.from_regular_faces(np.array(surface.vertices), np.array(surface.triangles, int))
    _, nearest = given.find_closest_cell(points, return_closest_point=True)
    return np.linalg.norm(nearest - points, axis=1).max()


@pytest.mark.parametrize("name", ["ball", "box", "cylinder", "torus", "nut"])
def test_the_default_size_gives_good_triangles_that_follow_the_surface(name):
    surface = generate(name)
    result = of.compute_remesh(surface)
    mesh, record = result.mesh, result.record
    assert of.surface.find_defects(mesh) == [] and (edge_counts(mesh) == 2).all() and record.watertight
    assert of.surface.euler_characteristic(mesh) == of.surface.euler_characteristic(surface)
    assert record.quality.min == result.qualities.min() > 0.3 and record.poor == 0
    assert (
        surface_deviation(np.asarray(mesh.vertices), np.asarray(mesh.triangles), np.zeros((0, 4), int), surface)[0]
        <= 1.2e-3
    )  # there are points between those that were looked at
    assert max(record.deviation.of_input, record.deviation.of_mesh) <= 1e-3
    assert farthest_from(surface, np.asarray(mesh.vertices)) < 1e-9
    assert record.features.missed_corners == 0 and record.features.off_curves < 1e-12


@pytest.mark.parametrize("wanted", [500, 4000])
def test_the_number_of_vertices_is_met(wanted):
    record = of.compute_remesh(generate("torus"), remeshing=RemeshingOptions(vertices=wanted)).record
    assert abs(record.vertices / wanted - 1) < 0.05 and record.quality.min > 0.3


def mean_away_from_features(result):
    points, on_feature = np.asarray(result.mesh.vertices), np.zeros(len(result.mesh.vertices), bool)
    on_feature[np.asarray(result.features.edges).ravel()] = True
    ends = np.asarray(of.surface.edge_topology(result.mesh).edges)
    ends = ends[~on_feature[ends].any(axis=1)]
    return np.linalg.norm(points[ends[:, 1]] - points[ends[:, 0]], axis=1).mean()


@pytest.mark.parametrize(("name", "length"), [("ball", 0.1), ("ball", 0.25), ("torus", 0.15), ("box", 0.08)])
def test_edges_are_as_long_as_asked_for_by_a_length_or_by_sizes(name, length):
    surface = generate(name)
    by_length = of.compute_remesh(surface, remeshing=RemeshingOptions(edge_length=length))
    by_sizes = of.compute_remesh(surface, sizes=lambda points: np.full(len(points), length))
    for result in (by_length, by_sizes):
        assert mean_away_from_features(result) == pytest.approx(length, rel=0.05)
    assert by_sizes.record.vertices == pytest.approx(by_length.record.vertices, rel=0.1)
    assert not any("mean length" in note for note in by_length.record.notes)


def test_edges_that_the_deviation_makes_shorter_than_asked_for_are_told():
    asked = RemeshingOptions(edge_length=0.5, deviation=2e-3)
    result = of.compute_remesh(ball(4), remeshing=asked)
    assert mean_away_from_features(result) < 0.25 and max(vars(result.record.deviation).values()) <= 2e-3
    assert [note for note in result.record.notes if "the deviation is kept" in note]


def test_lengths_by_curvature_are_shorter_where_the_surface_bends():
    points, triangles = parts(ball(4))
    egg = mesh_of(points * [1, 1, 4], triangles)
    mesh = of.compute_remesh(egg, remeshing=RemeshingOptions(curvature=True)).mesh
    areas, heights = np.asarray(of.surface.triangle_areas(mesh)), np.asarray(mesh.vertices)[np.asarray(mesh.triangles)]
    height = np.abs(heights.mean(axis=1)[:, 2])
    assert np.median(areas[height > 3.8]) < 0.2 * np.median(areas[height < 1])


def test_an_open_surface_keeps_its_rim():
    record = of.compute_remesh(sheet(), remeshing=RemeshingOptions(edge_length=0.1)).record
    assert not record.watertight and record.open_edges > 0 and record.features.missed_corners == 0
    assert record.kept is False and record.mean_edge == pytest.approx(0.1, rel=0.15)


def test_sizes_between_the_vertices_of_coarse_triangles_are_seen():
    sizes = lambda points: 0.03 + 0.1 * np.abs(points[:, 2] - 0.5)  # noqa: E731
    mesh = of.compute_remesh(generate("box"), sizes=sizes).mesh
    middle = np.asarray(mesh.vertices)[np.asarray(mesh.triangles)].mean(axis=1)[:, 2]
    areas = np.asarray(of.surface.triangle_areas(mesh))
    assert np.median(areas[np.abs(middle - 0.5) < 0.1]) < 0.5 * np.median(areas[np.abs(middle - 0.5) > 0.4])


@pytest.mark.parametrize(
    "name", [f"out.{kind}" for kind in ("stl", "obj", "off", "ply", "vtp", "vtu", "msh", "mesh", "vtk", "ply.gz")]
)
def test_the_command_writes_any_surface_format(name, tmp_path):
    of.write_surface(generate("box"), tmp_path / "box.obj")
    out = tmp_path / name
    done = CliRunner().invoke(
        app,
        ["remesh", str(tmp_path / "box.obj"), "-o", str(out), "--edge-length", "0.3", "--json", str(tmp_path / "r")],
    )
    assert done.exit_code == 0, done.output
    told = any_record(tmp_path / "r")
    found = of.prepare_mesh(out, of.MeshOptions(remesh=False), volume=False)
    assert len(found.surface.triangles) == told.triangles and told.output == str(out)
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(["box.obj", name, "r"])


def test_features_of_the_file_are_written_with_the_mesh(tmp_path):
    done = of.compute_remesh(generate("box"), remeshing=RemeshingOptions(edge_length=0.3))
    done.write(tmp_path / "box.vtu")
    lines = meshio.read(tmp_path / "box.vtu").cells_dict["line"]
    assert len(lines) == len(done.features.edges) == done.record.features.edges > 12


def test_tets_give_their_boundary():
    tets = of.prepare_mesh(generate("box"), of.MeshOptions(edge_length=0.4)).volume()
    record = of.compute_remesh(tets.mesh, remeshing=RemeshingOptions(vertices=300)).record
    assert record.input_kind == "tets" and record.watertight and abs(record.vertices - 300) <= 15


@pytest.mark.parametrize(
    ("arguments", "kind"),
    [
        (["--edge-length", "0.1", "--vertices", "9"], "option_out_of_range"),
        (["--edge-length", "-1"], "option_out_of_range"),
        (["--quality", "0.9"], "option_out_of_range"),
        (["--curvature", "--size", "growth=0.1"], "ignored_option"),
        (["--edge-length", "1e-7"], "too_many_cells"),
        (["--vertices", "100000000"], "option_out_of_range"),
    ],
)
def test_what_cannot_be_done_is_refused_before_a_file_is_written(arguments, kind, tmp_path):
    of.write_surface(generate("box"), tmp_path / "box.obj")
    done = CliRunner().invoke(
        app, ["remesh", str(tmp_path / "box.obj"), "-o", str(tmp_path / "o.stl"), *arguments, "--json", "-", "-q"]
    )
    assert done.exit_code == 2 and json.loads(done.stdout)["error"]["kind"] == kind
    assert not (tmp_path / "o.stl").exists()


@pytest.mark.parametrize(
    ("wanted", "kind"), [({"deviation": 1e-9}, "too_many_cells"), ({"edge_length": 3.0}, "too_few_cells")]
)
def test_what_no_triangles_of_the_surface_give_is_refused(wanted, kind):
    with pytest.raises(of.InvalidInput) as refused:
        of.compute_remesh(generate("torus"), remeshing=RemeshingOptions(**wanted))
    assert refused.value.kind == kind


def test_files_that_hold_no_surface_are_refused_before_the_work(tmp_path):
    for name in ("out.ovm", "out.xyz"):
        with pytest.raises((of.InvalidInput, of.IoError)):
            from octafield.remeshing.remesh import require_surface_format

            require_surface_format(tmp_path / name)


def test_the_record_is_read_back_and_makes_the_same_options(tmp_path):
    of.write_surface(generate("ball"), tmp_path / "ball.obj")
    CliRunner().invoke(app, ["remesh", str(tmp_path / "ball.obj"), "-o", str(tmp_path / "o.obj"), "--vertices", "400",
        "--json", str(tmp_path / "r.json"), "-q"])  # fmt: skip
    record = any_record(tmp_path / "r.json")
    assert type(record).__name__ == "RemeshRecord"
    assert RemeshingOptions(**record.options) == RemeshingOptions(vertices=400)
    assert of.MeshOptions(**record.mesh_options) == of.MeshOptions()
    assert record.seconds == pytest.approx(sum(record.wall_seconds.values()))


# Damaged inputs beside those of the zoo, and what is said of each: the kind of an error, or a word of a note.
def with_number(value):
    points, triangles = parts(ball())
    points[5, 1] = value
    return mesh_of(points, triangles)


OTHERS = {
    "a NaN": (lambda: with_number(np.nan), "non_finite"),
    "infinite": (lambda: with_number(np.inf), "non_finite"),
    "empty": (lambda: mesh_of(np.zeros((0, 3)), np.zeros((0, 3), int)), "empty"),
    "one point": (lambda: mesh_of(np.zeros((3, 3)), [[0, 1, 2]]), None),
    "ids out of range": (lambda: mesh_of(np.eye(3), [[0, 1, 7]]), "index_out_of_range"),
    "two balls touching at a point": (
        lambda: joined(ball(2), moved(ball(2), *(2 * np.asarray(ball(2).vertices)[0]))),
        None,
    ),
}


@pytest.mark.parametrize("name", [*ZOO, *OTHERS])
def test_damaged_surfaces_are_repaired_with_a_sentence_or_refused_by_kind(name):
    make = (ZOO | OTHERS)[name][0]
    try:
        record = of.compute_remesh(
            make(), of.MeshOptions(repair="wrap"), remeshing=RemeshingOptions(vertices=900)
        ).record
    except (of.GeometryError, of.InvalidInput) as error:
        assert error.kind
        assert "; " in str(error) or error.kind in ("non_finite", "index_out_of_range"), "what is left, and what to do"
        if name in OTHERS and OTHERS[name][1]:
            assert error.kind == OTHERS[name][1]
        return
    assert any(note.startswith("repair: ") for note in record.notes), "says what was done"
    assert record.quality.min > 0.25 or record.poor == record.forced or record.notes


def test_a_wrap_is_drawn_onto_the_surface_and_stays_sound():
    mesh = joined(generate("box"), moved(generate("box"), 1, 1, 0))
    mesh = of.surface.repair(mesh, level="merge").mesh
    done = of.surface.repair(mesh, level="wrap", wrap_alpha=0.1, wrap_offset=0.01)
    assert of.surface.find_defects(done.mesh) == [] and "drawn onto the surface" in done.actions[-1]
    points = np.asarray(done.mesh.vertices)
    _, near = pyvista.PolyData.from_regular_faces(
        np.array(mesh.vertices), np.array(mesh.triangles, int)
    ).find_closest_cell(points, return_closest_point=True)
    on = np.linalg.norm(near - points, axis=1) < 1e-12
    assert on.mean() > 0.9
    assert abs(of.surface.signed_volume(done.mesh) - 2) < 0.02


@pytest.fixture(scope="module")
def foam():
    """Both walls of a gyroid, cut by a box: genus 27, features along stairs, triangles of any shape."""
    points, triangles = remeshing_surfaces.foam(24, 1.0)
    return mesh_of(points, triangles)


@pytest.mark.parametrize("wanted", [600, 1200])
def test_few_vertices_on_a_foam_give_a_sound_surface_though_they_may_be_more(foam, wanted):
    """Triangles cross at first; what is shortened there is not lengthened again to meet the number."""
    done = of.compute_remesh(foam, remeshing=RemeshingOptions(vertices=wanted))
    assert not done.record.kept and of.surface.find_defects(done.mesh) == [] and done.record.quality.min > 0.25
    assert of.surface.euler_characteristic(done.mesh) == of.surface.euler_characteristic(foam)
    told = any("cannot be met" in note for note in done.record.notes)
    assert told == (abs(done.record.vertices / wanted - 1) > 0.05) and done.record.vertices < 3 * wanted


def test_turns_of_a_tight_roll_are_not_mixed_up():
    """An edge's arc is more than half a gap deep: the nearest point of its middle is on the next turn."""
    along, across, gap = 600, 8, 0.0012
    turns, height = (
        t.ravel() for t in np.meshgrid(np.linspace(0, 3, along), np.linspace(0, 0.2, across), indexing="ij")
    )
    radius = 0.5 + gap * turns
    points = np.stack([radius * np.cos(2 * np.pi * turns), radius * np.sin(2 * np.pi * turns), height], axis=1)
    i, j = (t.ravel() for t in np.meshgrid(np.arange(along - 1), np.arange(across - 1), indexing="ij"))
    a = i * across + j
    roll = mesh_of(
        points, np.concatenate([np.stack([a, a + across, a + across + 1], 1), np.stack([a, a + across + 1, a + 1], 1)])
    )
    features = of.surface.detect_features(roll)

    def jumps(mesh):
        """Triangles whose corners are of several turns: farther apart across the layers than an edge's arc is deep."""
        places = np.asarray(mesh.vertices)
        angle = np.arctan2(places[:, 1], places[:, 0]) / (2 * np.pi)
        turn = np.round((np.linalg.norm(places[:, :2], axis=1) - 0.5) / gap - angle)
        at = (turn + angle)[np.asarray(mesh.triangles)]
        return int((np.ptp(at, axis=1) > 0.5).sum())

    walked = of.surface.close_remesh(roll, features, np.full(len(points), 0.06))
    assert jumps(walked.mesh) == 0 and not walked.kept
    assert np.asarray(of.surface.triangle_qualities(walked.mesh)).min() > 0.3
