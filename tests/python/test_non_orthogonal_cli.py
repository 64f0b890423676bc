"""octafield surface-field --non-orthogonal: files, record, what it follows and what it refuses."""

import dataclasses
import inspect
import json
import math

import numpy as np
import octafield as of
import pytest
import pyvista
from octafield.command_line import fields as cli
from octafield.domain.generators import generate
from octafield.layout.non_orthogonal import compute_non_orthogonal_field
from octafield.options import NonOrthogonalOptions
from pipeline_fixtures import octafield
from surface_fixtures import polygon, prism, right_triangle
from test_bindings_non_orthogonal import sheared
from typer.testing import CliRunner


def run(*arguments):
    """In this process."""
    return CliRunner().invoke(cli.app, ["surface-field", *map(str, arguments), "-q"])


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("inputs")
    of.write_surface(polygon(right_triangle(30.0)), folder / "WEDGE.obj")
    of.write_surface(sheared(math.radians(30)), folder / "RHOMBUS.obj")
    of.write_surface(prism(30.0), folder / "PRISM.obj")
    (folder / "CORNERS.json").write_text(json.dumps([{"vertex": v, "quads": 1} for v in (0, 8, 72, 80)]))
    (folder / "INNER.json").write_text(json.dumps([{"vertex": 40, "quads": 1}]))
    (folder / "TIP.json").write_text(json.dumps([{"vertex": 0, "quads": 2}]))
    return folder


@pytest.fixture(scope="module")
def done(inputs):
    octafield("surface-field", inputs / "WEDGE.obj", "-o", inputs / "out", "--non-orthogonal", "--edge-length", "0.05",
              "--json", inputs / "out.json", "-q", check=0)  # fmt: skip
    return inputs / "out"


def off_lines(surface, direction, at):
    """Degrees, the largest at these vertices, from a direction to the nearer one of the two lines."""
    lines = np.stack([surface.point_data[name][at] for name in ("direction", "second_direction")], axis=1)
    return np.degrees(np.arccos(np.minimum(abs(lines @ direction), 1))).min(axis=1).max()


def test_both_sides_of_a_sharp_corner_are_followed_in_the_file(done):
    surface = pyvista.read(done / "surface.vtp")
    points = np.asarray(surface.points)
    for degrees in (0.0, 30.0):
        side = np.array([math.cos(math.radians(degrees)), math.sin(math.radians(degrees)), 0])
        at = np.abs(points @ [-side[1], side[0], 0]) < 1e-9
        assert at.sum() > 10 and off_lines(surface, side, at) < 1e-5
    tip = np.linalg.norm(points, axis=1).argmin()
    assert surface.point_data["angle_deg"][tip] == pytest.approx(30) and surface.point_data["quads"][tip] == 1


def test_the_record_is_of_a_surface_field_and_tells_of_the_lines(done):
    record = of.read_surface_record(done / "result.json")
    content = json.loads((done / "result.json").read_text())
    assert content == json.loads((done.parent / "out.json").read_text())
    of_crosses = ("imposed", "dirichlet_energy", "energy_history", "residual")
    assert list(content) == [name for name in type(record).order() if name not in of_crosses]
    assert (record.method, record.symmetry, record.index_sum, record.converged) == ("angles", 4, 1.0, True)
    lines = record.non_orthogonal
    assert lines.smallest_angle_deg == pytest.approx(30) and lines.oblique_share > 0.5 and lines.agree
    assert lines.corners == {"1": 3} and lines.corner_source == "angle" and lines.cut_edges == lines.inverted == 0
    inside = [point.index for point in record.singularities if not point.boundary]
    assert inside == [0.25]
    assert pyvista.read(done / "surface_separatrices.vtp").n_cells == 3
    options = NonOrthogonalOptions(**record.options)
    again = compute_non_orthogonal_field(done.parent / "WEDGE.obj", options)
    np.testing.assert_array_equal(again.second_directions, pyvista.read(done / "surface.vtp")["second_direction"])
    assert again.record.energy == record.energy


def test_options_reach_the_solver_and_corners_are_those_of_their_file(inputs, tmp_path):
    words = [inputs / "RHOMBUS.obj", "-o", tmp_path / "out", "--no-remesh", "--non-orthogonal"]
    found = {}
    for name, more in {
        "plain": [], "corners": ["--corners", inputs / "CORNERS.json"], "free": ["--second-line", "free"],
        "projected": ["--lines-method", "projected", "--lines-iterations", "2"], "lambda": ["--lambda", "3"],
        "unit": ["--weights", "unit"], "angle": ["--corner-angle", "20"],
    }.items():  # fmt: skip
        assert run(*words, *more).exit_code == 0, name
        found[name] = of.read_surface_record(tmp_path / "out" / "result.json")
    energies = {name: record.energy for name, record in found.items()}
    assert energies["corners"] < 1e-7 < energies["free"] < energies["plain"] != energies["unit"]
    assert energies["angle"] < 1e-7 and found["angle"].options["corner_angle"] == math.radians(20)
    assert found["corners"].non_orthogonal.corner_source.endswith("CORNERS.json")
    assert found["corners"].non_orthogonal.corners == {"1": 4} and found["plain"].non_orthogonal.corners == {"1": 2}
    assert found["projected"].iterations == 2 and not found["projected"].converged
    assert found["free"].options["least_angle"] == NonOrthogonalOptions().least_angle


def test_features_inside_are_followed_on_both_sides(inputs):
    result = compute_non_orthogonal_field(inputs / "PRISM.obj", NonOrthogonalOptions(edge_length=0.1))
    figures = result.record.non_orthogonal
    assert figures.cut_edges > 0 and figures.agree and figures.input_vertices < len(result.surface.vertices)
    assert figures.smallest_angle_deg == pytest.approx(30)
    points, origins = np.asarray(result.surface.vertices), result.origins
    copies = np.bincount(origins)
    at_wedge = np.flatnonzero((np.linalg.norm(points[:, :2], axis=1) < 1e-9) & (copies[origins] == 2))
    lines = np.stack([result.directions, result.second_directions], axis=1)[at_wedge]
    assert len(at_wedge) > 6 and abs(lines[:, :, 2]).max(axis=1) == pytest.approx(1)  # along the sharp edge


def test_a_closed_surface_without_features_keeps_right_angles_and_says_so():
    result = compute_non_orthogonal_field(generate("ball"))
    assert result.record.non_orthogonal.smallest_angle_deg == pytest.approx(90)
    assert any("nothing asks for another angle" in note for note in result.record.notes)


def test_a_run_that_is_stopped_keeps_the_best_field(inputs):
    stopped = compute_non_orthogonal_field(inputs / "RHOMBUS.obj", progress=lambda phase, *_: phase != "surface")
    assert stopped.record.stopped and not stopped.record.converged and len(stopped.separatrices) == 0


def test_view_draws_a_surface_field(done, tmp_path):
    octafield("view", done, "-o", tmp_path / "field.png", check=0)
    assert (tmp_path / "field.png").stat().st_size > 1000


def test_the_command_has_the_options_of_the_class():
    parameters = inspect.signature(cli.surface_field).parameters
    for option in dataclasses.fields(NonOrthogonalOptions):
        name = cli._OF_LINES.get(option.name, option.name)
        if name in ("interfaces", "split", "seed") or name in cli._SHARED:
            continue
        default = parameters[name].default
        wanted = math.degrees(option.default) if name.endswith("_angle") else option.default
        assert default == (pytest.approx(wanted, abs=1e-6) if name.endswith("_angle") else wanted)


@pytest.mark.parametrize(
    ("arguments", "kind"),
    [
        ("--non-orthogonal --method mbo", "ignored_options"),
        ("--non-orthogonal --symmetry 6", "ignored_options"),
        ("--non-orthogonal --curvature 1", "ignored_options"),
        ("--non-orthogonal --feature-alignment none", "ignored_options"),
        ("--non-orthogonal --imposed CORNERS.json", "ignored_options"),
        ("--non-orthogonal --inadmissible move", "ignored_options"),
        ("--non-orthogonal --penalty 3", "ignored_options"),
        ("--non-orthogonal --least-angle 3", "ignored_options"),
        ("--non-orthogonal --lines-method projected --least-angle 3", "ignored_options"),
        ("--non-orthogonal --lines-method newton", "unknown_option_value"),
        ("--non-orthogonal --lines-method poly_vector --second-line free", "bad_option"),
        ("--non-orthogonal --corner-angle 90", "option_out_of_range"),
        ("--non-orthogonal --lambda 0", "option_out_of_range"),
        ("--non-orthogonal --lines-iterations 0", "option_out_of_range"),
        ("--non-orthogonal --corners INNER.json", "not_on_boundary"),
        ("--non-orthogonal --corners MISSING.json", None),
        ("--second-line free", "ignored_options"),
        ("--lambda 2", "ignored_options"),
        ("--lines-method projected", "ignored_options"),
    ],
)
def test_what_cannot_be_is_refused_and_nothing_written(inputs, tmp_path, arguments, kind):
    words = [inputs / word if "." in word else word for word in arguments.split()]
    found = run(inputs / "RHOMBUS.obj", *words, "-o", tmp_path / "out", "--json", tmp_path / "e.json", "--no-remesh")
    assert found.exit_code == 2 and [path.name for path in tmp_path.iterdir()] == ["e.json"]
    error = json.loads((tmp_path / "e.json").read_text())["error"]
    assert kind in (None, error["kind"]) and error["message"]


def test_a_corner_where_several_faces_meet_is_refused(inputs, tmp_path):
    words = ["--non-orthogonal", "--corners", inputs / "TIP.json", "--json", tmp_path / "e.json"]
    assert run(inputs / "PRISM.obj", "-o", tmp_path / "out", *words).exit_code == 2
    assert json.loads((tmp_path / "e.json").read_text())["error"]["kind"] == "several_faces"
