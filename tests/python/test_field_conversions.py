"""What a computed field takes along when it becomes another file: feature edges, a size of cells, a mesh whose singular
vertices are apart."""

from dataclasses import replace

import numpy as np
import octafield as of
import pytest
from conftest import box_tets
from format_table import frames_at
from octafield.command_line.fields import app
from octafield.command_line.files import _cell_edge
from octafield.domain.generators import generate
from octafield.domain.inputs import read_input
from octafield.runs.conversion import convert_file
from typer.testing import CliRunner

WITH_FEATURES = (".ovmb", ".ovm", ".npz", ".vtu", ".msh")


def edges_of(array) -> list[list[int]]:
    return np.unique(np.sort(np.asarray(array), axis=1), axis=0).tolist()


@pytest.fixture(scope="module", params=["vertices", "tets"])
def run(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp(request.param)
    of.write_surface(generate("box"), folder / "box.stl")
    arguments = [
        "field",
        str(folder / "box.stl"),
        "-o",
        str(folder / "out"),
        "--sampling",
        request.param,
        "--edge-length",
        "0.3",
        "-q",
        "--streamlines",
        "0",
    ]
    assert CliRunner().invoke(app, arguments).exit_code == 0
    return folder / "out"


@pytest.mark.parametrize("suffix", WITH_FEATURES)
def test_feature_edges_found_by_field_travel_with_it(run, tmp_path, suffix):
    found = of.read_frames(run / "field.vtu")
    assert len(found.features) == 12 * 4
    points = np.asarray(found.mesh.vertices)[found.features]
    assert (
        np.isclose(np.abs(points[:, 0] - points[:, 1]).max(axis=1), np.linalg.norm(points[:, 0] - points[:, 1], axis=1))
    ).all()  # along the axes
    done = convert_file(run / "field.vtu", tmp_path / f"x{suffix}")
    assert not any("feature" in note for note in done.notes)
    assert edges_of(of.read_frames(tmp_path / f"x{suffix}").features) == edges_of(found.features)


@pytest.mark.parametrize("suffix", [".mesh", ".meshb", ".vtk"])
def test_feature_edges_travel_with_the_mesh_alone(run, tmp_path, suffix):
    convert_file(run / "field.vtu", tmp_path / f"x{suffix}")
    mesh = read_input(tmp_path / f"x{suffix}")
    assert edges_of(mesh.features_of_tets()) == edges_of(of.read_frames(run / "field.vtu").features)


def test_corners_come_back_with_the_feature_edges(run):
    again = of.analyse(
        run / "field.vtu", of.read_frames(run / "field.vtu").frames, of.read_frames(run / "field.vtu").where
    )
    assert len(again.features.corners) == 8 and again.record["feature_source"] == "file"


def test_what_cannot_hold_features_or_gets_none_says_so(run, tmp_path):
    assert any(
        "feature edges were left out" in note for note in convert_file(run / "field.vtu", tmp_path / "x.qtn").notes
    )
    mesh = box_tets(2)
    notes = of.write_frames(tmp_path / "a.ovmb", mesh, frames_at(mesh, "tets"), "tets")
    assert notes == ["no feature edges were given: the file marks none"]


def test_a_result_gives_its_features_and_regions_to_the_file(tmp_path):
    result = of.compute_field(generate("box"), of.FieldOptions(edge_length=0.4, streamlines=0))
    assert of.write_frames(tmp_path / "a.npz", result, result.frames) == []
    found = of.read_frames(tmp_path / "a.npz")
    assert edges_of(found.features) == edges_of(result.feature_edges) and len(found.features) > 12
    with pytest.raises(of.InvalidInput, match="str"):
        of.write_frames(tmp_path / "a.npz", "box.vtu", result.frames)


@pytest.mark.parametrize("damage", ["7 99999", "0.5 1", "1 2 3"])
def test_damaged_feature_edges_are_refused(run, tmp_path, damage):
    (tmp_path / "a.vtu").write_text(
        '<VTKFile type="UnstructuredGrid"><UnstructuredGrid><FieldData><DataArray type="Float64" Name="feature_edges"'
        f' NumberOfComponents="2" format="ascii">{damage}</DataArray></FieldData><Piece NumberOfPoints="4"'
        ' NumberOfCells="1"><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0'
        ' 0 0 1</DataArray></Points><Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2'
        ' 3</DataArray><DataArray type="Int64" Name="offsets" format="ascii">4</DataArray><DataArray type="UInt8"'
        ' Name="types" format="ascii">10</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>'
    )
    with pytest.raises(of.IoError, match="feature_edges"):
        read_input(tmp_path / "a.vtu")


def lengths_in(path) -> np.ndarray:
    found = of.read_frames(path, box_tets(2))
    return np.ones((len(found.frames), 3)) if found.lengths is None else found.lengths


@pytest.mark.parametrize("suffix, power", [(".fra", -1), (".bfra", -1), (".ff3", 1)])
def test_the_edge_of_cells_divides_densities_and_multiplies_edges(tmp_path, suffix, power):
    mesh = box_tets(2)
    frames = frames_at(mesh, "tets")
    given = np.random.default_rng(3).uniform(0.5, 2, (len(frames), 3))
    of.write_frames(tmp_path / f"a{suffix}", mesh, frames, "tets", lengths=given, cell_edge=0.25)
    assert np.allclose(lengths_in(tmp_path / f"a{suffix}"), given * 0.25**power)
    notes = of.write_frames(tmp_path / f"b{suffix}", mesh, frames, "tets", cell_edge="auto")
    tets, points = np.asarray(mesh.tets), np.asarray(mesh.vertices)
    edges = {tuple(sorted((int(a), int(b)))) for tet in tets for a in tet for b in tet if a != b}
    mean = np.mean([np.linalg.norm(points[a] - points[b]) for a, b in edges])
    assert np.allclose(lengths_in(tmp_path / f"b{suffix}"), mean**power) and any(
        f"{mean:.6g}" in note for note in notes
    )


def test_the_edge_of_cells_goes_with_sizes(run, tmp_path):
    convert_file(run / "field.vtu", tmp_path / "a.fra", sizes="isotropic")
    convert_file(run / "field.vtu", tmp_path / "b.fra", sizes="isotropic", cell_edge=_cell_edge("0.5"))
    found = [of.read_frames(tmp_path / name, read_input(run / "field.vtu").tets) for name in ("a.fra", "b.fra")]
    one = np.ones((len(found[0].frames), 3)) if found[0].lengths is None else found[0].lengths
    assert np.allclose(found[1].lengths, 2 * one)


@pytest.mark.parametrize("wrong", [0.0, -1.0, float("nan"), "wide", True])
def test_an_edge_of_cells_that_is_no_length_is_refused(tmp_path, wrong):
    mesh = box_tets(1)
    with pytest.raises(of.InvalidInput, match="positive length"):
        of.write_frames(tmp_path / "a.fra", mesh, frames_at(mesh, "tets"), "tets", cell_edge=wrong)
    with pytest.raises(of.InvalidInput, match="no size of cells"):
        of.write_frames(tmp_path / "a.qtn", mesh, frames_at(mesh, "tets"), "tets", cell_edge=1.0)
    assert list(tmp_path.iterdir()) == []


def test_a_word_for_the_edge_of_cells_is_bad_usage(run, tmp_path):
    result = CliRunner().invoke(
        app, ["convert", str(run / "field.vtu"), "-o", str(tmp_path / "a.fra"), "--cell-edge", "wide"]
    )
    assert result.exit_code == 2


def test_splitting_between_singular_vertices_keeps_frames_singular_edges_and_features(tmp_path):
    mesh = box_tets(3)
    frames = np.asarray(of.frames.random_rotations(len(mesh.tets), 5))
    features = np.asarray(of.volume.boundary_surface(mesh).vertex_map)[
        of.surface.detect_features(of.volume.boundary_surface(mesh).mesh).edges
    ]
    of.write_frames(tmp_path / "a.vtu", mesh, frames, "tets", features=features, regions=np.arange(len(frames)) % 1)
    done = convert_file(tmp_path / "a.vtu", tmp_path / "b.vtu", split_singular=True)
    found = of.read_frames(tmp_path / "b.vtu")
    split = of.volume.split_between_singular(mesh, frames)
    assert len(split.edges) > 5 and len(split.left) == 0 and done.cells == len(split.mesh.tets) > len(mesh.tets)
    assert np.array_equal(found.mesh.tets, split.mesh.tets) and np.allclose(
        of.frames.distance(found.frames, frames[split.parent]), 0, atol=1e-7
    )
    before, after = of.volume.singular_edges(mesh, frames), of.volume.singular_edges(found.mesh, found.frames)
    assert [(e.a, e.b, e.quarter_turns) for e in after.edges] == [(e.a, e.b, e.quarter_turns) for e in before.edges]
    assert edges_of(found.features) == edges_of(features)
    assert any(f"{len(split.edges)} edges inside between singular vertices were split" in note for note in done.notes)
    again = convert_file(tmp_path / "b.vtu", tmp_path / "c.vtu", split_singular=True)
    assert any(note.startswith("0 edges") for note in again.notes)


def test_splitting_needs_a_file_with_the_mesh(run, tmp_path):
    with pytest.raises(of.InvalidInput, match="another mesh"):
        convert_file(run / "field.vtu", tmp_path / "a.fra", split_singular=True)
    with pytest.raises(of.InvalidInput):
        convert_file(run / "field.vtu", tmp_path / "a.mesh", split_singular=True)


def test_frames_in_tets_have_the_verdict_of_meshability(run):
    import json

    record = json.loads((run / "result.json").read_text())
    assert (
        record["non_meshable_vertices"] == record["non_meshable_corners"] == record["non_meshable_feature_edges"] == 0
    )
    assert record["hexahedra_at_features"] == {"1": 48}
    assert (run / "features.vtp").exists() and record["undecided_edges"] == 0


@pytest.mark.parametrize("interfaces", [True, False])
def test_field_splits_between_singular_vertices_on_request(tmp_path, interfaces):
    """The same field on a finer mesh; the box has two regions, so that surfaces with and without interfaces keep their
    vertices."""
    mesh = box_tets(3)
    regions = (np.asarray(mesh.vertices)[np.asarray(mesh.tets)].mean(axis=1)[:, 0] > 0.5).astype(np.int32)
    domain = of.TetDomain(mesh, regions=regions)
    of.volume.write_field(tmp_path / "in.vtu", domain, np.tile([1.0, 0, 0, 0], (len(mesh.vertices), 1)))
    options = of.FieldOptions(
        sampling="tets", boundary="none", interfaces=interfaces, max_iterations=0, rounds=0, streamlines=0
    )
    meshed = of.prepare_mesh(tmp_path / "in.vtu", options)
    random = np.asarray(of.frames.random_rotations(len(mesh.tets), 5))
    plain, split = (of.compute_field(meshed, replace(options, split_singular=on), start=random) for on in (False, True))
    counts = split.record["split_singular"]
    assert counts["edges"] > 5 and counts["left"] == 0 and "split_singular" not in plain.record
    assert (
        len(split.tets.tets) == len(plain.tets.tets) + counts["added_tets"]
        and len(split.tets.vertices) == len(plain.tets.vertices) + counts["added_vertices"]
    )
    assert np.array_equal(split.tet_frames, plain.tet_frames[split.parent]) and plain.parent is None
    ends = lambda result: [
        (e.a, e.b, e.quarter_turns) for e in of.volume.singular_edges(result.tets, result.tet_frames).edges
    ]
    assert ends(split) == ends(plain) and split.record["singular_edges"] == plain.record["singular_edges"] > 0
    assert np.array_equal(split.surface.triangles, plain.surface.triangles) and edges_of(
        split.feature_edges
    ) == edges_of(plain.feature_edges)
    assert (
        split.record["boundary_triangles"] == plain.record["boundary_triangles"]
        and split.record["alignment_deg"] == plain.record["alignment_deg"]
    )
    assert (
        split.record["mesh_sha256"] != plain.record["mesh_sha256"]
        and split.record["energy_history"] == plain.record["energy_history"]
    )
    assert len(of.volume.split_between_singular(split.tets, split.tet_frames).edges) == 0


def test_field_and_convert_split_alike(tmp_path):
    of.write_surface(generate("ball"), tmp_path / "ball.stl")
    common = [
        "field",
        str(tmp_path / "ball.stl"),
        "--sampling",
        "tets",
        "--edge-length",
        "0.45",
        "-q",
        "--streamlines",
        "0",
    ]
    for name, more in (("plain", []), ("split", ["--split-singular"])):
        assert CliRunner().invoke(app, [*common, "-o", str(tmp_path / name), *more]).exit_code == 0
    convert_file(tmp_path / "plain" / "field.vtu", tmp_path / "converted.vtu", split_singular=True)
    field, converted = of.read_frames(tmp_path / "split" / "field.vtu"), of.read_frames(tmp_path / "converted.vtu")
    assert len(field.mesh.tets) > len(of.read_frames(tmp_path / "plain" / "field.vtu").mesh.tets)
    assert np.array_equal(field.mesh.tets, converted.mesh.tets) and np.allclose(
        of.frames.distance(field.frames, converted.frames), 0, atol=1e-7
    )
    result = CliRunner().invoke(app, [*common[:2], "-o", str(tmp_path / "none"), "--split-singular"])
    assert result.exit_code == 2 and "--sampling tets" in result.output + result.stderr


@pytest.mark.parametrize("name", ["a.vtu", "a.npz"])
def test_features_and_regions_of_a_domain_go_with_its_frames(tmp_path, name):
    mesh = box_tets(3)
    regions = (np.asarray(mesh.vertices)[np.asarray(mesh.tets)].mean(axis=1)[:, 0] > 0.5).astype(np.int32)
    domain = of.TetDomain(mesh, regions=regions)
    domain = domain.with_features(of.surface.feature_graph(domain.surface.mesh, domain.sheets.cuts))
    of.write_frames(tmp_path / name, domain, of.frames.random_rotations(len(mesh.tets)), "tets")
    found = of.read_frames(tmp_path / name)
    assert np.array_equal(found.regions, regions)
    expected = np.asarray(domain.surface.vertex_map)[np.asarray(domain.features.edges)]
    assert np.array_equal(found.features, expected) and len(expected) > 10
