"""octafield report: the page of a quad layout."""

import csv
import json

import numpy as np
import octafield as of
import pytest
import pyvista
from octafield.command_line import fields as cli
from octafield.report.quad_layout import write_layout_report
from quad_mesh_checks import disk, four_points
from report_pages import elements, require_sound
from typer.testing import CliRunner


def run(*arguments):
    """In this process."""
    return CliRunner().invoke(cli.app, [*map(str, arguments), "-q"])


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("disk")
    of.write_surface(disk(), folder / "a & b.obj")
    (folder / "points.json").write_text(json.dumps(four_points()))
    made = run("quad-layout", folder / "a & b.obj", "-o", folder / "out", "--singularities", folder / "points.json",
               "--quads", "200", "--no-remesh")  # fmt: skip
    assert made.exit_code == 0
    return folder / "out"


@pytest.fixture(scope="module")
def page(folder):
    done = run("report", folder, "--json", folder.parent / "told.json")
    assert done.exit_code == 0
    told = json.loads((folder.parent / "told.json").read_text())
    assert told == {"folder": str(folder), "report": str(folder / "report.html")}
    return (folder / "report.html").read_text()


def test_the_page_is_sound_and_tells_the_main_figures(folder, page):
    require_sound(page, folder)
    record = json.loads((folder / "result.json").read_text())
    assert "Quad layout of a &amp; b.obj" in page and "a & b" not in page
    assert f"{record['quads']:,} quads in 5 blocks and 3 chords" in page
    assert f"{record['scaled_jacobian']['min']:.3f} at least" in page
    images = [attributes["src"] for tag, attributes in elements(page) if tag == "img"]
    assert len(images) == 2 and all(src.startswith("data:image/png;base64,") for src in images)


def test_pictures_show_blocks_and_the_scaled_jacobian(folder, page):
    blocks, jacobian = (
        np.asarray(pyvista.read(folder / "figures" / f"figure-{k}.png").active_scalars)[:, :3].astype(int)
        for k in (1, 2)
    )
    assert ((blocks[:, 0] > 180) & (blocks[:, 1] < 130) & (blocks[:, 2] < 60)).any()  # points of valence 3
    pale = np.unique((blocks[(blocks.min(axis=1) > 130) & (np.ptp(blocks, axis=1) > 25)] // 16), axis=0)
    assert len(pale) >= 3
    yellow = (jacobian[:, 0] > 220) & (jacobian[:, 1] > 190) & (jacobian[:, 2] < 90)  # near 1 in viridis
    drawn = (jacobian < 250).any(axis=1)
    assert yellow.sum() > 0.5 * drawn.sum()


def test_tables_hold_the_record_in_full(folder, page):
    record = json.loads((folder / "result.json").read_text())
    rows = {row[0]: row[1] for row in csv.reader((folder / "tables" / "figures.csv").open())}
    for name in ("quads", "patches", "chords", "irregular_vertices", "inverted", "t_joints"):
        assert int(rows[name]) == record[name]
    assert float(rows["scaled_jacobian min"]) == pytest.approx(record["scaled_jacobian"]["min"], rel=1e-5)
    assert float(rows["surface_deviation max"]) == pytest.approx(record["surface_deviation"]["max"], rel=1e-5)
    points = list(csv.DictReader((folder / "tables" / "points.csv").open()))
    assert [float(p["x"]) for p in points] == [p["position"][0] for p in record["singular_points"]]
    phases = list(csv.DictReader((folder / "tables" / "phases.csv").open()))
    assert [p["phase"] for p in phases] == list(record["wall_seconds"])
    assert not (folder / "tables" / "misalignment.csv").exists()  # a disk has no conditions
    assert r"\toprule" in (folder / "tables" / "points.tex").read_text()


def test_it_is_written_again_the_same_and_view_still_works(folder, page):
    assert write_layout_report(folder) == folder / "report.html"
    assert (folder / "report.html").read_text() == page
    assert run("view", folder, "-o", folder.parent / "p.png").exit_code == 0


def test_what_is_no_quad_layout_is_refused(folder, tmp_path):
    def refused(path, kind, words):
        done = run("report", path, "--json", tmp_path / "e.json")
        error = json.loads((tmp_path / "e.json").read_text())["error"]
        assert done.exit_code == 2 and words in error["message"] and kind in (None, error["kind"])

    refused(tmp_path / "nowhere", "cannot_read", "cannot read")
    of.write_surface(disk(), tmp_path / "disk.obj")
    assert run("surface-field", tmp_path / "disk.obj", "-o", tmp_path / "field").exit_code == 0
    refused(tmp_path / "field", "other_record", "no record of a quad layout")
    assert not (tmp_path / "field" / "report.html").exists()
    broken = tmp_path / "broken"
    broken.mkdir()
    (broken / "result.json").write_bytes((folder / "result.json").read_bytes())
    refused(broken, None, "mesh.vtu")
    (broken / "mesh.vtu").write_bytes((folder / "mesh.vtu").read_bytes()[:2000])
    refused(broken, None, "mesh.vtu")
    (broken / "result.json").write_text("{")
    refused(broken, "bad_record", "no whole JSON")
