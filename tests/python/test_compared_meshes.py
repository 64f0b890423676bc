"""Comparisons and studies with a hex-dominant mesh along every field: figures in records, a ranking, errors told."""

import csv
import json

import numpy as np
import octafield as of
import pytest
from hex_mesh_checks import require_conforming, volume_of
from octafield import study
from octafield.domain.generators import generate
from octafield.runs import compared_meshes
from octafield.study.memory import needed_mb
from octafield.study.plan import Run
from octafield.view import scene
from pipeline_fixtures import octafield, write_cube
from report_pages import elements, page_of, prose, record

COARSE = of.FieldOptions(edge_length=0.6)
CELLS = of.HexMeshOptions(edge_length=0.5)
STUDY = """name: meshes
inputs: [{generator: box}]
mesh: {edge_length: 0.5}
runs: {representation: [sh4, su2]}
"""


@pytest.fixture(scope="module")
def comparison(tmp_path_factory):
    folder = tmp_path_factory.mktemp("compare") / "out"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scene, "can_draw", lambda: False)
        return of.compare(
            generate("cylinder"), folder, representations=["sh4", "su2"], options=COARSE, mesh="hex-dominant",
            hex_options=CELLS,
        )  # fmt: skip


def told(page: str) -> str:
    """What the page says of meshes."""
    return " ".join(text for text in prose(page, references=False) if "mesh" in text and "hexahedra" in text)


def with_mesh(volume=None, number=0.5, error=None, **more):
    """A run's record with a mesh of these shares, or without one."""
    if volume is None:
        figures = {"error": error, "error_kind": "bad"}
    else:
        figures = {
            "hex_volume_share": volume, "hex_number_share": number, "inverted": 0, "nonconforming_faces": 0,
            "scaled_jacobian": {"hexahedra": {"min": 0.4, "p05": 0.5, "mean": 0.9}},
            "cells": {"tets": 1, "hexahedra": 2, "wedges": 3, "pyramids": 4}, "volume_error": 0.01,
            "boundary_deviation": {"max": 0.02, "rms": 0.01},
        }  # fmt: skip
    return record(mesh={"edge_length": 0.5, "seconds": 1.0, **figures}, **more)


def test_every_row_has_the_figures_of_the_mesh_in_its_folder(comparison):
    for row in comparison.rows:
        assert f"{row.folder}/mesh.vtu" in row.files
        mesh = of.read_cells(comparison.folder / row.folder / "mesh.vtu")
        require_conforming(mesh)
        assert row.mesh.cells == {
            kind: len(getattr(mesh, kind)) for kind in ("tets", "hexahedra", "wedges", "pyramids")
        }
        only = of.volume.MixedMesh(mesh.vertices, hexahedra=mesh.hexahedra)
        assert row.mesh.hex_volume_share == pytest.approx(volume_of(only) / volume_of(mesh))
        assert row.mesh.hex_number_share == pytest.approx(
            len(mesh.hexahedra) / sum(len(getattr(mesh, kind)) for kind in row.mesh.cells)
        )
        worst = np.asarray(of.volume.scaled_jacobians(only)).min()
        assert row.mesh.scaled_jacobian["hexahedra"].min == pytest.approx(worst) and worst > 0
        assert row.mesh.inverted == row.mesh.nonconforming_faces == 0 and row.mesh.error is None
        assert row.mesh.edge_length == 0.5 and row.mesh.seconds > 0
        assert of.read_record(comparison.folder / row.folder / "result.json").mesh == row.mesh
    assert json.loads((comparison.folder / "results.json").read_text()) == comparison.rows
    named = {file for row in comparison.rows for file in row.files} | {"results.json"}
    assert named == {
        str(path.relative_to(comparison.folder)) for path in comparison.folder.rglob("*") if path.is_file()
    }


def test_the_line_of_a_run_has_its_shares(comparison):
    with open(comparison.folder / "results.csv", newline="") as file:
        lines = list(csv.DictReader(file))
    for line, row in zip(lines, comparison.rows, strict=True):
        assert float(line["mesh_hex_volume_share"]) == row.mesh.hex_volume_share
        assert int(line["mesh_cells_hexahedra"]) == row.mesh.cells.hexahedra
        assert float(line["mesh_scaled_jacobian_hexahedra_min"]) == row.mesh.scaled_jacobian["hexahedra"].min
        assert float(line["mesh_boundary_deviation_max"]) == row.mesh.boundary_deviation.max
    with open(comparison.folder / "tables" / "runs.csv", newline="") as file:
        shares = [float(line["hexahedra volume, %"]) for line in csv.DictReader(file)]
    assert sorted(shares) == pytest.approx(sorted(100 * row.mesh.hex_volume_share for row in comparison.rows))


def test_the_report_ranks_methods_by_their_meshes_and_names_the_best(comparison):
    with open(comparison.folder / "tables" / "hex_meshes.csv", newline="") as file:
        lines = list(csv.DictReader(file))
    best = sorted(comparison.rows, key=lambda row: -row.mesh.hex_volume_share)
    assert [(line["boundary"], line["method"]) for line in lines] == [(r.boundary, r.representation) for r in best]
    assert {(line["meshes"], line["of"], line["inverted"], line["nonconforming"]) for line in lines} == {
        ("1", "1", "0", "0")
    }
    text = told(comparison.to_html())
    assert f"The best mesh is along {best[0].representation} ({best[0].boundary}): hexahedra are" in text
    assert f"{100 * best[0].mesh.hex_volume_share:.1f} % of the volume" in text


def test_without_meshes_nothing_is_told_of_them(comparison, tmp_path, monkeypatch):
    monkeypatch.setattr(scene, "can_draw", lambda: False)
    plain = of.compare(generate("cylinder"), tmp_path / "out", representations=["sh4", "su2"], options=COARSE)
    for row, other in zip(plain.rows, comparison.rows, strict=True):
        assert list(row) == [name for name in other if name != "mesh"]
        assert row.energy_history == other.energy_history and row.options == other.options
    assert not list(plain.folder.rglob("mesh.vtu")) and "Hex-dominant" not in plain.to_html()
    assert "mesh_" not in (plain.folder / "results.csv").read_text().splitlines()[0].replace("mesh_sha256", "")
    assert not (plain.folder / "tables" / "hex_meshes.csv").exists()
    assert "hexahedra" not in (plain.folder / "tables" / "runs.csv").read_text()


def test_where_no_mesh_can_be_made_the_error_is_told_and_the_comparison_goes_on(tmp_path, monkeypatch):
    def failing(result, *arguments, **options):
        if result.record.representation == "su2":
            raise of.GeometryError("part: cannot be <filled>", "not_filled")
        return real(result, *arguments, **options)

    real = compared_meshes.compute_hex_dominant
    monkeypatch.setattr(compared_meshes, "compute_hex_dominant", failing)
    monkeypatch.setattr(scene, "can_draw", lambda: False)
    found = of.compare(
        generate("box"), tmp_path / "out", representations=["su2", "sh4"], boundaries=["fixed"], options=COARSE,
        mesh="hex-dominant",
    )  # fmt: skip
    without, made = found.rows
    assert set(without.mesh) == {"edge_length", "seconds", "error", "error_kind"} and without.energy >= 0
    assert (without.mesh.error, without.mesh.error_kind) == ("part: cannot be <filled>", "not_filled")
    assert made.mesh.hex_volume_share == 1 and made.mesh.edge_length == without.mesh.edge_length
    assert not (found.folder / without.folder / "mesh.vtu").exists()
    assert [name for name in without.files if name.endswith("mesh.vtu")] == []
    text = " ".join(prose(found.to_html(), references=False))
    assert "No mesh could be made along 1 of 2 fields: “part: cannot be <filled>”" in text
    assert "Not ranked, for want of a mesh that another method has: su2." in text


def test_cells_that_are_far_too_small_are_an_error_in_every_record(tmp_path, monkeypatch):
    monkeypatch.setattr(scene, "can_draw", lambda: False)
    found = of.compare(
        generate("box"), tmp_path / "out", representations=["sh4"], options=COARSE, mesh="hex-dominant",
        hex_options=of.HexMeshOptions(edge_length=1e-4),
    )  # fmt: skip
    assert {row.mesh.error_kind for row in found.rows} == {"too_many_cells"}
    text = " ".join(prose(found.to_html(), references=False))
    assert "No mesh could be made along 2 of 2 fields" in text and "best mesh" not in text


def test_files_that_cannot_be_written_and_callbacks_that_stop_end_the_comparison(tmp_path, monkeypatch):
    given = {"representations": ["sh4"], "options": COARSE, "mesh": "hex-dominant"}
    with pytest.raises(of.Cancelled):
        of.compare(generate("box"), tmp_path / "out", progress=lambda phase, *_: "lattice" not in phase, **given)

    def full(*arguments, **options):
        raise of.IoError("disk full", "cannot_write")

    monkeypatch.setattr("octafield.hexdom.files.write_file", full)
    with pytest.raises(of.IoError, match="disk full"):
        of.compare(generate("box"), tmp_path / "out", **given)
    assert not (tmp_path / "out").exists()


def test_a_number_of_cells_is_one_edge_length_for_all_runs_and_the_default_is_that_of_the_surface(tmp_path):
    meshed = of.prepare_mesh(generate("box"), of.MeshOptions(edge_length=0.5))
    length = lambda **options: compared_meshes.of_one_length(of.HexMeshOptions(**options), meshed.volume())
    assert (length(cells=27).edge_length, length(cells=27).cells) == (pytest.approx(1 / 3), 0)
    assert length().edge_length == of.surface.mean_edge_length(meshed.surface) == length(correction="none").edge_length
    assert length(edge_length=0.2, correction="none") == of.HexMeshOptions(edge_length=0.2, correction="none")


def test_the_best_mesh_of_every_boundary_treatment_is_drawn(tmp_path, monkeypatch):
    for other in ("_surface_pictures", "_volume_pictures"):
        monkeypatch.setattr(f"octafield.runs.compare.{other}", lambda *arguments: [])
    found = of.compare(
        generate("cylinder"), tmp_path / "out", representations=["sh4", "su2"], options=COARSE, mesh="hex-dominant",
        hex_options=CELLS,
    )  # fmt: skip
    titles = [attributes["alt"] for tag, attributes in elements(found.to_html()) if tag == "img"]
    rows = {boundary: [row for row in found.rows if row.boundary == boundary] for boundary in ("fixed", "aligned")}
    best = [max(of_boundary, key=lambda row: row.mesh.hex_volume_share) for of_boundary in rows.values()]
    assert titles == [f"Hex-dominant mesh ({row.label})" for row in best]
    for row in best:
        assert f"Hexahedra are {row.mesh.hex_volume_share:.1%} of the volume" in found.to_html()


@pytest.mark.parametrize(
    ("shares", "words"),
    [
        ([(0.9, 0.5), (0.8, 0.9)], "The best mesh is along sh4: hexahedra are 90.0 % of the volume and 50.0 %"),
        ([(0.8, 0.9), (0.85, 0.1)], "The best mesh is along su2: hexahedra are 85.0 % of the volume"),
        ([(0.9, 0.5), (0.9001, 0.6)], "along su2: hexahedra are 90.0 % of the volume and 60.0 % of the cells; with the"
         " others they are 90.0 % of the volume; it is the share of the cells that decides"),
        ([(0.9, 0.5), (0.90004, 0.49998)], "No field leads to a better mesh than another: with each of the 2"),
        ([(0.9, 0.5), (0.7, 0.5), (0.9, 0.5)], "The best meshes, 2 that are equal to a tenth of a per cent, are along"
         " sh4 and odeco: hexahedra are 90.0 %"),
        ([(0.9, 0.5)], "In the mesh along sh4, hexahedra are 90.0 % of the volume"),
        ([(0.7, 0.5), (None, "no way")], "In the mesh along sh4, hexahedra are 70.0 %"),
    ],
)  # fmt: skip
def test_the_best_is_named_and_ties_are_told(tmp_path, shares, words):
    names = ("sh4", "su2", "odeco")
    rows = [
        ("part", with_mesh(*([None, 0, one[1]] if one[0] is None else one), representation=name))
        for one, name in zip(shares, names, strict=False)
    ]
    assert words in told(page_of(tmp_path, rows))


def test_inputs_and_seeds_count_alike_and_a_mesh_that_is_missing_somewhere_is_not_ranked(tmp_path):
    rows = [("a", with_mesh(0.6, seed=seed)) for seed in (0, 1)]
    rows += [("b", with_mesh(0.9)), ("b", with_mesh(0.7, seed=1))]
    rows += [("a", with_mesh(1.0, representation="su2", seed=seed)) for seed in (0, 1)]
    rows += [
        ("b", with_mesh(0.9, representation="su2")),
        ("b", with_mesh(None, error="no", representation="su2", seed=1)),
    ]
    text = told(page_of(tmp_path, rows))
    assert "In the meshes along sh4, hexahedra are 70.0 % of the volume" in text and "over 2 inputs" in text
    assert "Not ranked, for want of a mesh that another method has: su2." in text
    lines = list(csv.reader((tmp_path / "tables" / "hex_meshes.csv").read_text().splitlines()))
    assert [line[1:4] for line in lines[1:]] == [["sh4", "4", "4"], ["su2", "3", "4"]]


def test_options_of_cells_without_meshes_and_unknown_meshes_are_refused(tmp_path):
    with pytest.raises(of.InvalidInput, match="need meshes") as caught:
        of.compare(generate("box"), tmp_path / "out", hex_options=CELLS)
    assert caught.value.kind == "ignored_options"
    with pytest.raises(of.InvalidInput, match="did you mean 'hex-dominant'"):
        of.compare(generate("box"), tmp_path / "out", mesh="hexdominant")
    done = octafield("compare", write_cube(tmp_path), "-o", tmp_path / "out", "--cells", "8", check=2)
    assert "--mesh hex-dominant" in done.stderr and not (tmp_path / "out").exists()


def test_the_command_line_makes_meshes_and_shows_their_shares(tmp_path, monkeypatch):
    from octafield.command_line import fields as cli
    from typer.testing import CliRunner

    monkeypatch.setattr(scene, "can_draw", lambda: False)
    common = ["compare", write_cube(tmp_path), "-o", tmp_path / "out", "--representations", "sh4", "--boundaries"]
    common += ["fixed", "--edge-length", "0.5", "--mesh", "hex-dominant"]
    run = lambda *more: CliRunner().invoke(cli.app, [*map(str, [*common, *more])], catch_exceptions=False)
    done = run("--cells", "8", "--json", tmp_path / "rows.json")
    assert done.exit_code == 0 and "volume, %" in done.stdout and "100.0" in done.stdout
    (row,) = json.loads((tmp_path / "rows.json").read_text())
    assert row["mesh"]["cells"]["hexahedra"] == 8 and row["mesh"]["edge_length"] == pytest.approx(0.5)
    done = run("--cell-edge", "0.34", "--json", tmp_path / "rows.json")
    assert json.loads((tmp_path / "rows.json").read_text())[0]["mesh"]["cells"]["hexahedra"] == 27


def test_a_study_makes_meshes_and_its_report_ranks_them(tmp_path):
    described = study.parse(STUDY + "hex_dominant: {cells: 27, hold_angle: 40}\n")
    assert study.run(described, tmp_path / "out", jobs=1).status.done == 2
    rows = study.rows(tmp_path / "out")
    assert [row.mesh.cells.hexahedra for row in rows] == [27, 27]
    for row in rows:
        cells = of.read_cells(tmp_path / "out" / "runs" / row.key / "mesh.vtu")
        assert len(cells.hexahedra) == 27 and "mesh.vtu" in row.files
    assert "No field leads to a better mesh" in told(study.write_report(tmp_path / "out").read_text())
    assert study.run(described, tmp_path / "out", jobs=1).computed == []


def test_keys_tell_whether_meshes_are_made_and_how_and_those_without_are_as_before():
    keys = lambda more: [run.key for run in study.plan(study.parse(STUDY + more))]
    plain, default, fine = keys(""), keys("hex_dominant: {}\n"), keys("hex_dominant: {edge_length: 0.1}\n")
    assert len({*plain, *default, *fine}) == 6
    spoken = STUDY.replace("mesh: {edge_length: 0.5}", "mesh: hex-dominant")
    assert study.parse(spoken).hex_dominant == {} and study.parse(spoken).mesh == {}
    for run in study.plan(study.parse(STUDY + "hex_dominant: {hold_angle: 30}\n")):
        assert run.hex_options.hold_angle == pytest.approx(np.pi / 6)
        assert Run.from_json(json.loads(json.dumps(run.to_json()))) == run
        assert "HexMeshOptions" in repr(run)


def test_memory_is_reserved_for_the_tets_that_may_be_cut():
    def more(line, tets=10_000):
        plain, meshed = (study.plan(study.parse(STUDY + text)) for text in ("", f"hex_dominant: {line}\n"))
        return needed_mb(tets, meshed) - needed_mb(0, plain)

    assert more("{}") == pytest.approx(0.0011 * 64 * 10_000)
    assert more("{most_tets: 100000}") == pytest.approx(0.0011 * 100_000)
    assert more("{}", 1e6) == pytest.approx(
        max(0.0011 * 1e6, needed_mb(1e6, study.plan(study.parse(STUDY))) - needed_mb(0, []))
    )


def test_a_study_without_kept_fields_keeps_figures_only(tmp_path):
    described = study.parse(STUDY.replace("[sh4, su2]", "sh4") + "hex_dominant: {edge_length: 0.0001}\nfields: false\n")
    study.run(described, tmp_path / "out", jobs=1)
    (row,) = study.rows(tmp_path / "out")
    assert row.state == "done" and row.mesh.error_kind == "too_many_cells"
    folder = tmp_path / "out" / "runs" / row.key
    assert {path.name for path in folder.iterdir()} == {"result.json", "log.txt"}
    assert "no mesh along the field: mesh in memory: the edge length asks for" in (folder / "log.txt").read_text()


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("{edge_length: -1}", "must be positive"),
        ("{edge: 1}", "no option 'edge'"),
        ("{edge_length: 1, cells: 3}", "leave it or the number of cells out"),
        ("{hold_angle: 100}", "between 0 and 90 degrees"),
        ("{recombine: maybe}", "recombine"),
        ("5", "hex_dominant"),
    ],
)
def test_an_error_in_a_description_names_its_line(line, words):
    with pytest.raises(of.InvalidInput, match="^s.yaml:5: ") as caught:
        study.parse(STUDY + f"hex_dominant: {line}\n", name="s.yaml")
    assert words in str(caught.value)
