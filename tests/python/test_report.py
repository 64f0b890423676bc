"""The comparison: its files, and a report that needs nothing but itself."""

import base64
import csv
import json
from io import BytesIO
from xml.etree import ElementTree

import octafield
import pytest
import pyvista
from octafield.options import FieldOptions
from octafield.runs.compare import compare
from PIL import Image
from pipeline_fixtures import write_cube, write_sphere
from report_pages import elements, require_sound

COARSE = FieldOptions(edge_length=0.4)
PNG = b"\x89PNG\r\n\x1a\n"


@pytest.fixture(scope="module")
def comparison(tmp_path_factory):
    folder = tmp_path_factory.mktemp("compare")
    return compare(
        [write_sphere(folder), write_cube(folder)], folder / "out", representations=("sh4", "odeco"), options=COARSE
    )


@pytest.fixture(scope="module")
def page(comparison):
    return comparison.to_html()


def test_a_row_per_input_representation_and_boundary_treatment(comparison):
    assert [row["boundary"] for row in comparison.rows] == ["fixed", "aligned"] * 4
    assert [row["representation"] for row in comparison.rows] == ["sh4", "sh4", "odeco", "odeco"] * 2
    assert json.loads((comparison.folder / "results.json").read_text()) == comparison.rows


def test_every_file_named_in_the_rows_exists_and_no_other(comparison):
    named = {file for row in comparison.rows for file in row["files"]} | {"results.json"}
    found = {str(path.relative_to(comparison.folder)) for path in comparison.folder.rglob("*") if path.is_file()}
    assert found == named


def test_the_table_has_one_line_per_run_with_its_numbers(comparison):
    with open(comparison.folder / "results.csv", newline="") as file:
        lines = list(csv.DictReader(file))
    assert [float(line["energy"]) for line in lines] == [row["energy"] for row in comparison.rows]
    assert [float(line["alignment_deg_max"]) for line in lines] == [r["alignment_deg"]["max"] for r in comparison.rows]
    assert "wall_seconds_smooth" in lines[0]


def test_field_files_hold_the_mesh_the_frames_and_the_options(comparison):
    row = comparison.rows[0]
    grid = pyvista.read(comparison.folder / row["folder"] / "field.vtu")
    assert grid.n_points == row["vertices"] and grid.n_cells == row["tets"]
    assert {"frame_u", "frame_v", "frame_w", "quaternion", "sh4"} <= set(grid.point_data)
    points = pyvista.read(comparison.folder / row["folder"] / "surface_singularities.vtp")
    assert points.point_data["index"].sum() == pytest.approx(row["surface_field"]["index_sum"])
    written = json.loads(str(points.field_data["options"][0]))  # all but the thread count, which changes no result
    assert written == {name: value for name, value in row["options"].items() if name != "threads"}


def test_the_page_is_well_formed_and_asks_nothing_of_the_network(comparison, page):
    require_sound(page, comparison.folder)


def test_pictures_are_small_and_say_something(comparison, page):
    pictures = [a["src"] for tag, a in elements(page) if tag == "img"]
    curves = len({(row["boundary"], row["singular_curves"]) for row in comparison.rows if row["singular_edges"]})
    assert (
        len(pictures) >= 2 * (2 + 2) + curves
    )  # per input: the surface, streamlines; per boundary treatment a cut; curves that differ
    for source in pictures:
        data = base64.b64decode(source.removeprefix("data:image/png;base64,"), validate=True)
        assert data.startswith(PNG) and len(data) < 250_000 and Image.open(BytesIO(data)).width > 500


def test_without_opengl_the_report_goes_without_pictures_and_says_so(tmp_path, monkeypatch):
    from octafield.view import scene

    monkeypatch.setattr(scene, "can_draw", lambda: False)
    page = compare(write_cube(tmp_path), tmp_path / "out", representations=("sh4",), options=COARSE).to_html()
    assert "<img" not in page and scene.NO_OPENGL in page and 'data-scene="0"' in page


def test_captions_state_the_index_sum_and_the_table_the_energy(comparison, page):
    assert "Euler characteristic 2" in page
    for row in comparison.rows:
        assert f"{row['energy']:.6g}" in page


def test_separatrices_are_drawn_where_there_are_any(comparison, page):
    drawn = [
        section
        for section in page.split('<section class="mesh" id="mesh-')[1:]
        if "separatrix" in section.split("</section>")[0]
    ]
    assert len(drawn) == 1 and drawn[0].startswith("1-sphere-ply")  # those of the cube are its edges
    for row in comparison.rows:
        curves = pyvista.read(comparison.folder / row["folder"] / "surface_separatrices.vtp")
        assert (curves.n_cells > 0) == row["input"].endswith("sphere.ply")


def test_a_new_comparison_replaces_the_old_one_only(comparison, tmp_path):
    out, cube = tmp_path / "out", write_cube(tmp_path)
    compare(cube, out, options=COARSE)
    (out / "notes.txt").write_text("mine")
    compare(cube, out, representations=("sh4",), boundaries=("none",), options=COARSE)
    assert {p.name for p in out.iterdir()} == {
        "report.html",
        "results.json",
        "results.csv",
        "notes.txt",
        "tables",
        "figures",
        "cube-sh4-none",
    }
    for plot in (out / "figures").glob("*.svg"):
        assert ElementTree.parse(plot).getroot().tag == "{http://www.w3.org/2000/svg}svg"
    assert {p.name for p in (out / "tables").iterdir()} == {
        f"{stem}.{end}" for stem in ("summary", "deviations", "inputs", "runs") for end in ("csv", "tex")
    }


def test_a_folder_of_something_else_is_refused_and_untouched(tmp_path):
    (tmp_path / "results.json").write_text('{"not": "ours"}')
    with pytest.raises(octafield.InvalidInput, match="not an earlier result"):
        compare(write_cube(tmp_path), tmp_path)
    assert json.loads((tmp_path / "results.json").read_text()) == {"not": "ours"}


def test_seeds_make_rows_of_their_own(tmp_path):
    rows = compare(
        write_sphere(tmp_path),
        tmp_path / "out",
        representations=("sh4",),
        boundaries=("aligned",),
        seeds=2,
        options=COARSE,
    ).rows
    assert [row["seed"] for row in rows] == [0, 1]
    assert rows[0]["mesh_sha256"] == rows[1]["mesh_sha256"]


@pytest.mark.parametrize("bad", [{"representations": ()}, {"boundaries": ("fixed", "fixed")}, {"seeds": 0}])
def test_comparisons_of_nothing_or_twice_the_same_are_refused(tmp_path, bad):
    with pytest.raises(octafield.InvalidInput):
        compare(write_cube(tmp_path), tmp_path / "out", **bad)
    assert not (tmp_path / "out").exists()


def test_every_input_is_read_before_the_first_is_meshed(tmp_path):
    seen = []
    with pytest.raises(octafield.IoError, match="absent"):
        compare(
            [write_cube(tmp_path), tmp_path / "absent.vtk"],
            tmp_path / "out",
            options=COARSE,
            progress=lambda phase, fraction, merit: seen.append(phase),
        )
    assert {phase.split(": ")[-1] for phase in seen} == {"read"}


@pytest.mark.parametrize("seeds", [0, 1.5, 3])
def test_a_number_of_seeds_that_leaves_the_range_is_refused(tmp_path, seeds):
    with pytest.raises(octafield.InvalidInput, match="seeds"):
        compare(write_cube(tmp_path), tmp_path / "out", options=FieldOptions(seed=2**64 - 2), seeds=seeds)
