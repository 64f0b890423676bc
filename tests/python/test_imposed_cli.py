"""octafield surface-field --imposed: files, record, and what it refuses."""

import json

import numpy as np
import octafield as of
import pytest
import pyvista
from octafield.command_line import fields as cli
from octafield.layout.imposed import compute_imposed_field
from pipeline_fixtures import octafield
from quad_mesh_checks import disk, four_points
from surface_fixtures import square
from test_imposed_fields import annulus
from test_quad_layout_runs import ring_points
from typer.testing import CliRunner


def run(*arguments):
    """In this process."""
    return CliRunner().invoke(cli.app, ["surface-field", *map(str, arguments), "-q"])


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("inputs")
    for name, mesh in {"DISK": disk(), "RING": annulus(around=48, rings=8), "SQUARE": square(8)}.items():
        of.write_surface(mesh, folder / f"{name}.obj")
    box = of.TriangleMesh(
        [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)],
        [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
         [0, 6, 4], [1, 5, 7], [1, 7, 3]],
    )  # fmt: skip
    of.write_surface(box, folder / "BOX.obj")
    texts = {
        "FOUR": four_points(), "THREE": four_points()[:3], "TURNED": ring_points(np.radians(10)), "LIST": [1],
        "OUTSIDE": [*four_points()[:3], {"position": [3, 0, 0], "valence": 3}], "NO_INDEX": [{"position": [0, 0, 0]}],
        "NONE": [], "CORNERS": [{"position": [0, 0, 0], "quads": 2}],
        "INNER": [{"position": [0.5, 0.5, 0], "quads": 1}],
        "POINT": [{"position": [0.4, 0.4, 0], "valence": 3}],
        "EIGHT": [{"vertex": v, "index_times_four": 1} for v in range(8)],
    }  # fmt: skip
    for name, content in texts.items():
        (folder / f"{name}.json").write_text(json.dumps(content))
    (folder / "CUT.json").write_text(json.dumps(four_points())[:40])
    rows = [f"{x},{y},3" for (x, y, _), *_ in (p.values() for p in four_points())]
    (folder / "FOUR.csv").write_text("x,y,valence\n" + "\n".join(rows) + "\n")
    (folder / "HEAD.csv").write_text("a,b\n1,2\n")
    return folder


@pytest.fixture(scope="module")
def done(inputs):
    octafield("surface-field", inputs / "DISK.obj", "-o", inputs / "out", "--imposed", inputs / "FOUR.json",
              "--no-remesh", "--json", inputs / "out.json", "-q", check=0)  # fmt: skip
    return inputs / "out"


def index_of(directions, surface, vertex):
    """Quarter turns of the crosses round a vertex, from the file's arrays alone."""
    points, triangles = np.asarray(surface.points), surface.regular_faces
    ring = np.unique(triangles[(triangles == vertex).any(axis=1)])
    ring = ring[ring != vertex]
    away = (points[ring] - points[vertex])[:, :2]
    order = ring[np.argsort(np.arctan2(away[:, 1], away[:, 0]))]
    angle = 4 * np.arctan2(directions[order, 1], directions[order, 0])
    return round(np.angle(np.exp(1j * np.diff(angle, append=angle[:1]))).sum() / (2 * np.pi))


def test_the_files_are_those_of_every_surface_field_with_sizes(done):
    record = json.loads((done / "result.json").read_text())
    assert record == json.loads((done.parent / "out.json").read_text())
    names = ["surface.vtp", "surface_singularities.vtp", "surface_separatrices.vtp", "result.json"]
    assert record["files"] == names and sorted(path.name for path in done.iterdir()) == sorted(names)
    surface = pyvista.read(done / "surface.vtp")
    assert (surface.n_points, surface.n_cells) == (record["vertices"], record["triangles"])
    four = surface.point_data["index_times_four"]
    assert sorted(four[four != 0]) == [1] * 4
    for vertex in np.flatnonzero(four):
        assert index_of(surface.point_data["direction"], surface, vertex) == 1
    # H = sum log|z - a| |1 - a* z| / 4 up to a constant.
    z = surface.points[:, 0] + 1j * surface.points[:, 1]
    at = [complex(*p["position"][:2]) for p in four_points()]
    far = np.min([abs(z - a) for a in at], axis=0) > 0.15
    exact = sum(np.log(abs(z[far] - a) * abs(1 - np.conj(a) * z[far])) for a in at) / 4
    assert np.ptp(surface.point_data["log_size"][far] - exact) < 0.06
    assert pyvista.read(done / "surface_singularities.vtp").n_points == 4
    assert pyvista.read(done / "surface_separatrices.vtp").n_cells == 12


def test_the_record_is_of_a_surface_field_and_tells_of_the_points(done):
    record = of.read_surface_record(done / "result.json")
    names = [name for name in type(record).order() if name != "non_orthogonal"]
    assert list(json.loads((done / "result.json").read_text())) == names
    assert (record.method, record.symmetry, record.index_sum, record.converged) == ("imposed", 4, 1.0, True)
    imposed = record.imposed
    assert [p.index_times_four for p in imposed.points] == [1] * 4 and imposed.closure < 1e-9
    assert imposed.point_source.endswith("FOUR.json") and imposed.corner_source == "angle"
    assert imposed.input_triangles == len(disk().triangles) < record.triangles
    assert imposed.misalignment == [] and imposed.inadmissible == "fail" and imposed.largest_move == 0
    np.testing.assert_allclose([p.position for p in record.singularities][0], imposed.points[0].position, atol=0.02)


def test_the_same_points_in_csv_a_record_and_python_give_the_same_field(inputs, done, tmp_path):
    for points in (inputs / "FOUR.csv", done / "result.json"):
        assert run(inputs / "DISK.obj", "-o", tmp_path / "out", "--imposed", points, "--no-remesh").exit_code == 0
        again, before = (pyvista.read(folder / "surface.vtp") for folder in (tmp_path / "out", done))
        np.testing.assert_allclose(again.point_data["log_size"], before.point_data["log_size"], atol=1e-6)
    options = of.SurfaceFieldOptions(remesh=False)
    result = compute_imposed_field(inputs / "DISK.obj", options, singularities=four_points())
    np.testing.assert_array_equal(result.vertex_data["log_size"], before.point_data["log_size"])
    np.testing.assert_array_equal(result.directions, before.point_data["direction"])


def test_places_that_no_field_has_are_refused_moved_or_rotated(inputs, tmp_path):
    words = [inputs / "RING.obj", "-o", tmp_path / "out", "--imposed", inputs / "TURNED.json", "--no-remesh"]
    refused = run(*words, "--json", tmp_path / "e.json")
    assert refused.exit_code == 2 and not (tmp_path / "out").exists()
    assert json.loads((tmp_path / "e.json").read_text())["error"]["kind"] == "inadmissible_pattern"
    for way in ("move", "rotate"):
        assert run(*words, "--inadmissible", way).exit_code == 0
        imposed = of.read_surface_record(tmp_path / "out" / "result.json").imposed
        (missed,) = imposed.misalignment
        assert imposed.inadmissible == way
        if way == "move":
            assert abs(missed.angle_deg) < 1e-4 and 0.01 < imposed.largest_move < 0.1
        else:
            assert abs(missed.angle_deg) == pytest.approx(10, abs=0.2) and imposed.largest_move == 0
            assert missed.size_factor == pytest.approx(np.exp(np.radians(10) * 2 * np.pi / np.log(1 / 0.4)), rel=0.02)


def test_corners_are_those_of_their_file(inputs, tmp_path):
    words = ["--imposed", inputs / "POINT.json", "--corners", inputs / "CORNERS.json", "--no-remesh"]
    assert run(inputs / "SQUARE.obj", "-o", tmp_path / "out", *words).exit_code == 0
    record = of.read_surface_record(tmp_path / "out" / "result.json")
    assert record.imposed.corner_source.endswith("CORNERS.json") and record.index_sum == 1
    at_rim = [p.position for p in record.imposed.points if p.boundary]
    assert len(at_rim) == 3 and [0, 0, 0] not in at_rim


def test_features_inside_are_noted(inputs, tmp_path):
    words = ["--imposed", inputs / "EIGHT.json", "--no-remesh"]
    assert run(inputs / "BOX.obj", "-o", tmp_path / "out", *words).exit_code == 0
    notes = of.read_surface_record(tmp_path / "out" / "result.json").notes
    assert "12 feature edges inside the surface are not followed: imposed fields follow the boundary alone" in notes


@pytest.mark.parametrize(
    ("arguments", "kind"),
    [
        ("DISK.obj --imposed THREE.json", "index_sum"),
        ("DISK.obj --imposed OUTSIDE.json", "outside_surface"),
        ("DISK.obj --imposed NO_INDEX.json", "bad_points"),
        ("DISK.obj --imposed LIST.json", "bad_points"),
        ("DISK.obj --imposed CUT.json", "bad_points"),
        ("DISK.obj --imposed HEAD.csv", "bad_points"),
        ("DISK.obj --imposed MISSING.json", None),
        ("DISK.obj --imposed DISK.obj", "bad_points"),
        ("SQUARE.obj --imposed NONE.json --corners INNER.json", "not_on_boundary"),
        ("SQUARE.obj --imposed NONE.json --corners NO_INDEX.json", "bad_points"),
        ("DISK.obj --imposed FOUR.json --inadmissible bend", "unknown_option_value"),
        ("DISK.obj --imposed FOUR.json --symmetry 6", "wrong_symmetry"),
        ("DISK.obj --imposed FOUR.json --method mbo", "ignored_options"),
        ("DISK.obj --imposed FOUR.json --curvature 1", "ignored_options"),
        ("DISK.obj --imposed FOUR.json --seed 3", "ignored_options"),
        ("DISK.obj --corners CORNERS.json", "ignored_options"),
        ("DISK.obj --inadmissible move", "ignored_options"),
        ("MISSING.obj --imposed FOUR.json", None),
    ],
)
def test_what_cannot_be_is_refused_and_nothing_written(inputs, tmp_path, arguments, kind):
    words = [inputs / word if "." in word else word for word in arguments.split()]
    found = run(*words, "-o", tmp_path / "out", "--json", tmp_path / "e.json")
    assert found.exit_code == 2 and [path.name for path in tmp_path.iterdir()] == ["e.json"]
    error = json.loads((tmp_path / "e.json").read_text())["error"]
    assert kind in (None, error["kind"]) and error["message"]
