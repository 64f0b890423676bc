"""octafield field --axes free: frames along both faces of sharp edges, in records, files and what reads them."""

import json
import math

import numpy as np
import octafield as of
import pytest
import pyvista
from octafield.command_line import fields as cli
from octafield.domain.generators import generate
from pipeline_fixtures import SHARED_TETS, octafield, shared
from surface_fixtures import prism
from typer.testing import CliRunner

WEDGE = 30.0
EDGE = 0.12


def run(*arguments):
    """In this process."""
    return CliRunner().invoke(cli.app, [*map(str, arguments), "-q"])


def options(**more):
    return of.FieldOptions(**{"edge_length": EDGE, "axes": "free", "feature_angle": math.radians(20), **more})


@pytest.fixture(scope="module")
def result():
    return of.compute_field(prism(WEDGE), options())


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    folder = tmp_path_factory.mktemp("free")
    of.write_surface(prism(WEDGE), folder / "prism.obj")
    octafield("field", folder / "prism.obj", "-o", folder / "out", "--axes", "free", "--edge-length", EDGE,
              "--feature-angle", 20, "--json", folder / "out.json", "-q", check=0)  # fmt: skip
    return folder / "out"


def kind_of(call, *arguments, **more):
    with pytest.raises(of.InvalidInput) as caught:
        call(*arguments, **more)
    return caught.value.kind


@pytest.mark.parametrize("degrees", [15, 30, 45, 60, 75])
def test_both_faces_of_a_wedge_are_followed_and_get_a_hexahedron(degrees):
    found = of.compute_field(prism(degrees), options())
    record = found.record
    sharpest = min(degrees, 90 - degrees)
    by_angle = {wedges.angle_deg: wedges for wedges in record.axes.wedges}
    assert {degrees, 90 - degrees, 90} == set(by_angle)
    for wedges in by_angle.values():
        assert wedges.off_faces_deg.max < 1 and wedges.off_edges_deg.max < 1
    assert record.axes.largest_obliqueness_deg == pytest.approx(90 - sharpest, abs=0.01)
    assert record.axes.oblique_share > 0.5 and record.axes.sharp_vertices > 0 == record.axes.needle_vertices
    assert record.alignment_deg.max < 1 and record.feature_alignment_deg.max < 1
    assert set(record.hexahedra_at_features) == {"1"} and record.verdict.state == "fine"
    right = of.compute_field(prism(degrees), options(axes="orthogonal")).record
    assert right.axes is None and right.alignment_deg.max > 5 and right.hexahedra_at_features["0"] > 0


def test_what_is_defined_at_right_angles_is_left_out_and_a_note_says_so(result):
    assert result.integrability is None and result.record.integrability is None
    assert any("not at right angles" in note for note in result.record.notes)
    assert result.record.options["axes"] == "free"


def test_streamlines_follow_the_axes_and_not_their_rotation(result):
    """From a point beside the face y = 0, near the sharp edge: one curve along that edge, one along the face, and one
    along the other face. Rotations alone run at 45 degrees to the bisector of both."""
    seed = [[0.3, 0.02, 0.3]]

    def ways_of(stretch):
        lines = of.volume.frame_streamlines(result.tets, result.frames, seed, stretch=stretch)
        ways = np.array([line.points[-1] - line.points[0] for line in lines])
        return abs(ways / np.linalg.norm(ways, axis=1, keepdims=True))

    followed, turned = ways_of(result.stretch), ways_of(None)
    for direction in ([0, 0, 1], [1, 0, 0], [math.cos(math.radians(WEDGE)), math.sin(math.radians(WEDGE)), 0]):
        assert (followed @ direction).max() > 0.998
    assert (turned @ [1, 0, 0]).max() < 0.95
    assert len(result.streamlines) > 30


def test_a_right_angled_solid_has_the_same_frames_bit_by_bit():
    free, right = (
        of.compute_field(generate("box"), of.FieldOptions(edge_length=0.3, axes=axes))
        for axes in ("free", "orthogonal")
    )
    np.testing.assert_array_equal(free.frames, right.frames)
    assert free.stretch is None and free.record.integrability == right.record.integrability
    assert free.record.axes.oblique_share == free.record.axes.sharp_vertices == 0
    assert free.record.axes.lengths.max == pytest.approx(1) and free.record.notes == right.record.notes
    same = {"wall_seconds", "cpu_seconds", "peak_mb", "machine", "axes", "options"}
    assert {k: v for k, v in free.record.items() if k not in same} == {
        k: v for k, v in right.record.items() if k not in same
    }


def test_the_file_has_the_axes_and_nothing_that_reads_as_right_angles(done, result):
    record = of.read_record(done / "result.json")
    assert record.to_dict() == json.loads((done.parent / "out.json").read_text())
    assert record.energy == result.record.energy
    grid = pyvista.read(done / "field.vtu")
    assert not {"quaternion", "sh4"} & set(grid.point_data)
    axes = np.stack([grid.point_data[name] for name in ("frame_u", "frame_v", "frame_w")], axis=1)
    exact = np.asarray(of.volume.stretched_axes(result.frames, result.stretch))
    lengths = grid.point_data["frame_lengths"]
    np.testing.assert_allclose(axes * lengths[:, :, None], exact, atol=1e-14)
    np.testing.assert_array_equal(grid.point_data["stretch"], result.stretch)
    points = np.asarray(grid.points)
    at_wedge = np.linalg.norm(points[:, :2], axis=1) < 1e-9
    wanted = [(0, 0, 1), (1, 0, 0), (math.cos(math.radians(WEDGE)), math.sin(math.radians(WEDGE)), 0)]
    assert abs(np.einsum("vid,jd->vij", axes[at_wedge], wanted)).max(axis=1) == pytest.approx(1, abs=1e-9)
    assert "not at right angles" in bytes(grid.field_data["convention"]).decode()
    features = pyvista.read(done / "features.vtp")
    sharp = np.isclose(features.cell_data["angle"], WEDGE, atol=1e-6)
    assert sharp.sum() > 3 and features.cell_data["off_faces"][sharp].max() < 1
    assert of.to_pyvista(result)["stretch"].shape == (len(points), 6) and "sh4" not in of.to_pyvista(result).point_data


@pytest.mark.parametrize("suffix", [".vtu", ".npz", ".vtu.gz"])
def test_written_and_read_back_the_axes_are_the_same(result, tmp_path, suffix):
    path = tmp_path / f"field{suffix}"
    of.write_frames(path, result, result.frames)
    assert kind_of(of.read_frames, path) == "stretched_axes"
    found = of.read_frames(path, stretched=True)
    np.testing.assert_array_equal(found.stretch, result.stretch)
    np.testing.assert_allclose(found.frames, result.frames, atol=1e-15)
    again = of.analyse(found.mesh, found.frames, stretch=found.stretch, options=of.FieldOptions(features="none"))
    assert again.record.energy == pytest.approx(result.record.energy) and again.stretch is not None


def test_analyse_finds_in_the_file_what_the_run_told(done, tmp_path):
    assert run("analyse", done / "field.vtu", "-o", tmp_path / "out").exit_code == 0
    told, found = (of.read_record(folder / "result.json") for folder in (done, tmp_path / "out"))
    for name in ("energy", "alignment_deg", "feature_alignment_deg", "hexahedra_at_features", "streamlines", "verdict",
                 "singular_axis_deg"):  # fmt: skip
        assert found[name] == told[name], name
    assert found.axes.wedges == told.axes.wedges and "integrability" not in found


@pytest.mark.parametrize("suffix", [".fra", ".npy", ".ovmb", ".msh", ".txt", ".vtp", ".ff3"])
def test_formats_that_would_lose_the_stretch_are_refused(result, done, tmp_path, suffix):
    path = tmp_path / f"field{suffix}"
    assert kind_of(of.write_frames, path, result, result.frames) == "stretched_axes"
    found = run("convert", done / "field.vtu", "-o", path, "--json", tmp_path / "e.json")
    assert found.exit_code == 2 and not path.exists()
    assert json.loads((tmp_path / "e.json").read_text())["error"]["kind"] == "stretched_axes"


@pytest.mark.parametrize(
    "arguments",
    [
        "field PRISM -o OUT --axes free --sampling tets",
        "field PRISM -o OUT --axes free --sizes isotropic",
        "field PRISM -o OUT --axes free --representation odeco_lengths",
        "field FIELD -o OUT --axes free --boundary start --start PLAIN",
        "field FIELD -o OUT --axes free --start PLAIN",
        "field FIELD -o OUT --start FIELD",
        "analyse FIELD -o OUT --sizes isotropic",
        "convert FIELD -o OUT.vtu --at tets",
        "convert FIELD -o OUT.vtu --sizes isotropic",
        "convert FIELD -o OUT.vtu --split-singular",
        "convert FIELD -o OUT.npz --combed",
        "compare FIELD -o OUT --field mine=FIELD --representations sh4",
        "hex-dominant FIELD -o OUT --field FIELD",
    ],
)
def test_what_needs_right_angles_says_so(done, tmp_path, arguments):
    plain = tmp_path / "plain.npy"
    grid = pyvista.read(done / "field.vtu")
    np.save(plain, np.tile([1.0, 0, 0, 0], (grid.n_points, 1)))
    places = {"PRISM": done.parent / "prism.obj", "FIELD": done / "field.vtu", "PLAIN": plain}
    words = [str(places.get(word, word)) for word in arguments.split()]
    words = [str(tmp_path / word) if word.startswith("OUT") else word.replace("=FIELD", f"={done / 'field.vtu'}")
             for word in words]  # fmt: skip
    found = run(*words, "--json", tmp_path / "e.json")
    assert found.exit_code == 2
    assert json.loads((tmp_path / "e.json").read_text())["error"]["kind"] == "stretched_axes"


def test_functions_of_python_that_need_right_angles_say_so(result):
    assert kind_of(of.sample_frames, result, [[0.5, 0.1, 0.3]]) == "stretched_axes"
    assert kind_of(of.slice_frames, result) == "stretched_axes"
    assert kind_of(of.compute_hex_dominant, result) == "stretched_axes"
    assert kind_of(of.compute_hex_dominant, prism(WEDGE), options()) == "stretched_axes"
    assert kind_of(of.compare, prism(WEDGE), "out", options=options()) == "stretched_axes"
    start = np.tile([1.0, 0, 0, 0], (len(result.frames), 1))
    assert kind_of(of.compute_field, result.tets, options(edge_length=0.0), start=start) == "stretched_axes"
    assert kind_of(of.FieldOptions, axes="oblique") == "unknown_option_value"


def test_a_stretch_that_is_none_is_refused_by_name(result, tmp_path):
    stretch = np.array(result.stretch)
    stretch[7, 0] = -1
    with pytest.raises(of.InvalidInput, match="positive definite") as caught:
        of.analyse(result.tets, result.frames, stretch=stretch)
    assert list(caught.value.elements) == [7]
    assert kind_of(of.analyse, result.tets, result.frames, stretch=stretch[1:]) == "bad_count"
    assert kind_of(of.write_frames, tmp_path / "f.npz", result, result.frames, stretch=stretch[1:]) == "bad_count"
    stretch[7, 0] = np.nan
    assert kind_of(of.volume.boundary_meshability, result.tets, result.frames, stretch=stretch) == "not_positive"
    parts = {"rotation": result.frames, "stretch": stretch, "where": np.array("vertices")}
    np.savez(tmp_path / "bad.npz", **parts)
    assert kind_of(of.read_frames, tmp_path / "bad.npz", stretched=True) == "not_positive"


@pytest.mark.parametrize("name", ["s02u", "s17c", "i10c"])
def test_files_of_hexme_run_and_report(name, tmp_path):
    path = shared(SHARED_TETS / f"{name}.vtk.gz")
    assert run("field", path, "-o", tmp_path / "out", "--axes", "free", "--json", tmp_path / "r.json").exit_code == 0
    record = of.read_record(tmp_path / "out" / "result.json")
    assert sum(wedges.edges for wedges in record.axes.wedges) == sum(record.hexahedra_at_features.values())
    if name == "s02u":  # a prism over a triangle
        assert max(wedges.off_faces_deg.max for wedges in record.axes.wedges) < 1 and record.verdict.state == "fine"
