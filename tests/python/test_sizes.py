"""The option sizes, from the command line to files and reports: against the core's functions, numpy and independent
readers."""

import csv
import json

import numpy as np
import octafield as of
import other_readers as readers
import pytest
import pyvista
from conftest import box_tets
from octafield import study
from octafield.domain.generators import generate
from octafield.domain.rotations import quaternions_of
from octafield.fields.sizes import log_scales_of
from octafield.runs.conversion import convert_file
from octahedral_fixtures import GROUP, matrices
from pipeline_fixtures import octafield
from report_pages import require_sound


@pytest.fixture(scope="module")
def ball():
    """Sizes per axis at the vertices' frames."""
    return of.compute_field(generate("ball"), of.FieldOptions(edge_length=0.3, sizes="axes", streamlines=0))


@pytest.fixture(scope="module")
def polar(tmp_path_factory):
    """A file of the frames of polar coordinates on 1 < r < 2, whose sizes are known."""
    grid = box_tets(8)
    x, y, z = np.asarray(grid.vertices).T
    mesh = of.TetMesh(np.column_stack([(1 + x) * np.cos(1.5 * y), (1 + x) * np.sin(1.5 * y), z]), grid.tets)
    frames = of.frames.quaternion_exp(np.column_stack([0 * x, 0 * x, 1.5 * y]))
    path = tmp_path_factory.mktemp("polar") / "polar.npz"
    of.write_frames(path, mesh, frames)
    return path, mesh, frames


def test_isotropic_sizes_lower_the_curl_and_go_into_files(tmp_path):
    of.write_surface(generate("ball"), tmp_path / "ball.stl")
    done = octafield(
        "field",
        tmp_path / "ball.stl",
        "-o",
        tmp_path / "out",
        "--edge-length",
        "0.3",
        "--sizes",
        "isotropic",
        "--json",
        "-",
        check=0,
    )
    record = json.loads(done.stdout)
    found = record["sizes"]
    assert (
        found["kind"] == "isotropic" and found["curl_rms_after"] <= found["curl_rms_before"] and found["size_ratio"] > 1
    )
    assert record["wall_seconds"]["sizes"] > 0 and record["options"]["sizes"] == "isotropic"
    grid = pyvista.read(tmp_path / "out" / "field.vtu")
    mesh = of.TetMesh(grid.points, grid.cells_dict[10])
    again = of.volume.isotropic_scale(mesh, grid.point_data["quaternion"])
    np.testing.assert_allclose(grid.point_data["log_scale"], again.log_scale, atol=1e-9)
    np.testing.assert_allclose(grid.cell_data["curl"], again.after.curl, rtol=1e-6, atol=1e-9)
    volumes = of.volume.tet_volumes(mesh)
    assert found["curl_rms_after"] == pytest.approx(
        np.sqrt(volumes @ grid.cell_data["curl"] ** 2 / volumes.sum()), rel=1e-9
    )
    assert abs(volumes @ grid.point_data["log_scale"][grid.cells_dict[10]].mean(axis=1)) < 1e-9 * volumes.sum()
    plain = octafield("analyse", tmp_path / "out" / "field.vtu", "--json", "-", check=0)
    assert "sizes" not in json.loads(plain.stdout)
    sized = json.loads(
        octafield("analyse", tmp_path / "out" / "field.vtu", "--sizes", "isotropic", "--json", "-", check=0).stdout
    )["sizes"]
    assert sized["curl_rms_after"] == pytest.approx(found["curl_rms_after"], rel=1e-6)


def test_sizes_per_axis_are_in_the_file_with_the_axes_they_belong_to(ball, tmp_path):
    from octafield.runs.run_folder import write_field_result

    assert isinstance(ball.sizes, of.volume.AxisScales) and ball.record["sizes"]["kind"] == "axes"
    write_field_result(ball, tmp_path)
    cells = pyvista.read(tmp_path / "field.vtu").cell_data
    np.testing.assert_array_equal(cells["log_scales"], ball.sizes.log_scales)
    scaled = np.swapaxes(cells["scaled_frame"].reshape(-1, 3, 3), 1, 2)
    np.testing.assert_allclose(
        scaled, matrices(ball.sizes.of_tets) * np.exp(ball.sizes.log_scales)[:, None, :], atol=1e-12
    )


def test_frames_in_tets_have_the_sizes_of_their_own_axes(ball):
    """Other representatives of the same frames: sizes go with the axes."""
    axes = matrices(ball.sizes.of_tets)
    turned = axes @ GROUP[np.arange(len(axes)) % 24]
    logs = log_scales_of(ball.sizes, quaternions_of(turned))
    along = abs(np.einsum("tji,tjk->tik", turned, axes)) > 0.99
    np.testing.assert_array_equal(np.einsum("tik,tk->ti", along, ball.sizes.log_scales), logs)
    in_tets = of.compute_field(ball.tets, of.FieldOptions(sampling="tets", sizes="axes", features="none"))
    assert in_tets.record["sizes"]["curl_rms_after"] < in_tets.record["sizes"]["curl_rms_before"]
    assert of.compute_field(ball.tets, of.FieldOptions(features="none")).sizes is None


@pytest.mark.parametrize(
    ("name", "sign"), [("a.fra", 1), ("a.bfra", 1), ("a.txt", 1), ("a.npz", 1), ("a.vtu", 1), ("a.ff3", -1)]
)
def test_lengths_written_are_densities_but_edges_of_cells_in_ff3(polar, tmp_path, name, sign):
    path, mesh, frames = polar
    done = convert_file(path, tmp_path / name, at="tets", sizes="axes")
    assert done.sizes["curl_rms_after"] < 0.2 * done.sizes["curl_rms_before"]
    expected = of.volume.axis_scales(mesh, frames)
    back = of.read_frames(tmp_path / name, mesh)
    axes = np.swapaxes(matrices(back.frames) * np.asarray(back.lengths)[:, None, :], 1, 2)  # rows
    own = np.swapaxes(matrices(expected.of_tets) * np.exp(sign * np.asarray(expected.log_scales))[:, None, :], 1, 2)
    assert back.where == "tets"
    match = np.abs(np.einsum("tik,tjk->tij", axes, own)).argmax(axis=2)
    np.testing.assert_allclose(
        np.abs(np.einsum("tik,tik->ti", axes, np.take_along_axis(own, match[:, :, None], 1))),
        np.linalg.norm(axes, axis=2) ** 2,
        rtol=1e-9,
    )
    # Of the map: the angle's gradient has length 1 / r.
    centre = np.asarray(mesh.vertices)[mesh.tets].mean(axis=1)
    radius = np.hypot(*centre[:, :2].T)
    around = np.column_stack([-centre[:, 1], centre[:, 0], 0 * radius]) / radius[:, None]
    lengths = np.linalg.norm(axes, axis=2)
    which = abs(np.einsum("tik,tk->ti", axes / lengths[:, :, None], around)).argmax(axis=1)
    along = np.log(lengths[np.arange(len(which)), which]) + sign * np.log(radius)
    assert np.std(along) < 0.03 < np.std(np.log(radius))


def test_another_program_reads_the_lengths(polar, tmp_path):
    path, mesh, frames = polar
    expected = of.volume.axis_scales(mesh, frames)
    convert_file(path, tmp_path / "a.fra", at="tets", sizes="axes")
    axes = readers.fra(tmp_path / "a.fra")  # in columns
    np.testing.assert_allclose(np.linalg.norm(axes, axis=1), np.exp(expected.log_scales), rtol=1e-12)
    convert_file(path, tmp_path / "b.txt", sizes="isotropic")
    rows = np.loadtxt(tmp_path / "b.txt").reshape(-1, 3, 3)
    one = np.exp(of.volume.isotropic_scale(mesh, frames).log_scale)
    np.testing.assert_allclose(np.linalg.norm(rows, axis=2), np.repeat(one[:, None], 3, axis=1), rtol=1e-12)


def test_what_cannot_be_done_is_said(polar, tmp_path):
    path, mesh, frames = polar
    with pytest.raises(of.InvalidInput, match="did you mean 'isotropic'"):
        of.FieldOptions(sizes="isotropik")
    for command in ("field", "analyse"):
        done = octafield(command, path, "-o", tmp_path / "out", "--sizes", "all", check=2)
        assert "sizes 'all' is not one of: none, isotropic, axes" in done.stderr
    with pytest.raises(of.InvalidInput, match="--at tets"):
        convert_file(path, tmp_path / "a.txt", sizes="axes")
    with pytest.raises(of.InvalidInput, match="cannot hold frames"):
        convert_file(path, tmp_path / "a.mesh", sizes="isotropic")
    of.write_frames(tmp_path / "bare.txt", None, frames)
    with pytest.raises(of.InvalidInput, match="mesh of the frames"):
        convert_file(tmp_path / "bare.txt", tmp_path / "a.npz", sizes="isotropic")
    done = convert_file(path, tmp_path / "a.ovmb", sizes="isotropic")
    assert done.sizes == {} and any("sizes were left out" in note for note in done.notes)
    with pytest.raises(of.InvalidInput, match="give one per tet"):
        of.volume.write_field(tmp_path / "a.vtu", mesh, frames, cell_data={"few": [1.0]})
    with pytest.raises(of.InvalidInput, match="array of the field itself"):
        of.volume.write_field(tmp_path / "a.vtu", mesh, frames, point_data={"sh4": np.ones(len(frames))})


def test_the_report_tells_curl_before_and_after(tmp_path):
    options = of.FieldOptions(edge_length=0.4, sizes="isotropic", streamlines=0)
    found = of.compare(
        [generate("ball"), generate("box")],
        tmp_path / "out",
        representations=["sh4", "su2"],
        boundaries=["aligned"],
        options=options,
    )
    page = (tmp_path / "out" / "report.html").read_text()
    require_sound(page, tmp_path / "out")
    assert "Integrability.</b> One line per run with sizes" in page
    assert "One size for all axes leaves" in page and "2 runs without any curl, up to rounding, are left out" in page
    rows = list(csv.DictReader((tmp_path / "out" / "tables" / "integrability.csv").open()))
    assert [float(row["curl after"]) for row in rows] == [r["sizes"]["curl_rms_after"] for r in found.rows]
    assert r"\begin{tabular}" in (tmp_path / "out" / "tables" / "integrability.tex").read_text()
    header, line = list(csv.reader((tmp_path / "out" / "results.csv").open()))[:2]
    assert float(line[header.index("sizes_curl_rms_before")]) == found.rows[0]["sizes"]["curl_rms_before"]


def test_runs_of_studies_keep_their_keys_where_no_sizes_are_asked_for():
    text = "{{name: keys, inputs: [{{generator: box}}], runs: {{sizes: {}}}}}"
    plain = study.plan(study.parse("{name: keys, inputs: [{generator: box}]}"))
    (none, axes) = study.plan(study.parse(text.format("[none, axes]")))
    assert [run.key for run in plain] == [none.key] and axes.key != none.key and axes.options.sizes == "axes"
    with pytest.raises(of.InvalidInput, match=":1: sizes 'all'"):
        study.parse(text.format("all"))


def test_sizes_follow_the_axes_of_combed_frames(ball, tmp_path):
    source = tmp_path / "ball.npz"
    of.write_frames(source, ball.tets, ball.frames)
    for name, combed in (("plain", False), ("combed", True)):
        convert_file(source, tmp_path / f"{name}.npz", at="tets", sizes="axes", combed=combed)
    plain, combed = (np.load(tmp_path / f"{name}.npz") for name in ("plain", "combed"))
    between = np.abs(np.swapaxes(matrices(combed["frames"]), 1, 2) @ matrices(plain["frames"]))
    assert (between.max(axis=2) > 1 - 1e-12).all()
    np.testing.assert_array_equal(
        np.take_along_axis(plain["lengths"], between.argmax(axis=2), axis=1), combed["lengths"]
    )
    assert np.ptp(plain["lengths"]) > 0.1 and combed["element"].any()
