"""Tables, scenes, profiles and plots of a report."""

import base64
import csv
import itertools
import json
import re
import zlib

import numpy as np
import pytest
import pyvista
from octafield import compute_field, from_pyvista
from octafield.options import COMPARED, SOLVERS, FieldOptions
from octafield.report import Run
from octafield.report.numbers.deviations import deviations
from octafield.report.numbers.profiles import lines, performance_profiles
from octafield.report.numbers.records import Results
from octafield.report.page import figures, scenes
from octafield.runs.compare import compare
from octafield.view import scene
from PIL import Image
from pipeline_fixtures import write_cube, write_sphere
from report_pages import elements, page_of, record

NAMES = ['<script>alert("1")</script>', "50 % & $x_1^2$ {\\tt}~#", "größe 立方体", "../../etc/passwd", "a\nb"]


@pytest.fixture(scope="module")
def fields(tmp_path_factory):
    folder = tmp_path_factory.mktemp("fields")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scene, "can_draw", lambda: False)
        return compare(
            write_sphere(folder),
            folder / "out",
            representations=("sh4", "geodesic"),
            options=FieldOptions(edge_length=0.4),
        )


@pytest.fixture(scope="module")
def all_methods(tmp_path_factory):
    folder = tmp_path_factory.mktemp("all_methods")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scene, "can_draw", lambda: False)
        return compare(
            write_sphere(folder),
            folder / "out",
            representations=(*COMPARED, "odeco_lengths"),
            boundaries=("aligned",),
            options=FieldOptions(edge_length=0.4),
        )


def runs_of(comparison) -> list[Run]:
    return [Run(row, "sphere", comparison.folder / row["folder"], row["folder"]) for row in comparison.rows]


def test_hostile_names_stay_text(tmp_path):
    page = page_of(tmp_path, [(name, record(m, message=name, notes=[name])) for name in NAMES for m in ("sh4", "su2")])
    assert "<script>alert" not in page and "&lt;script&gt;alert" in page
    assert [a for tag, a in elements(page) if tag == "section"] and page.count('<section class="mesh"') == len(NAMES)
    for name in NAMES:
        assert name in [line["input"] for line in csv.DictReader((tmp_path / "tables" / "runs.csv").open(newline=""))]


def test_latex_tables_are_rectangles_with_all_specials_escaped(tmp_path):
    page_of(
        tmp_path,
        [(name, record(m, b)) for name in NAMES for m in ("sh4", "su2_midpoint") for b in ("fixed", "aligned")],
    )
    for path in (tmp_path / "tables").glob("*.tex"):
        text = path.read_text()
        first, *inside, last = text.strip().splitlines()
        columns = len(re.fullmatch(r"\\begin\{tabular\}\{([lr]+)\}", first)[1])
        assert last == r"\end{tabular}" and [line for line in inside if "rule" in line and "cmid" not in line] == [
            r"\toprule",
            r"\midrule",
            r"\bottomrule",
        ]
        for line in (line for line in inside if "rule" not in line):
            assert line.endswith(r" \\")
            cells = re.split(r"(?<!\\)&", line.removesuffix(r" \\"))
            widths = [int(w[1]) if (w := re.match(r"\s*\\multicolumn\{(\d+)\}", cell)) else 1 for cell in cells]
            assert sum(widths) == columns, line
            bare = re.sub(
                r"\\(multicolumn\{\d+\}\{c\}\{[^}]*\}|text\w+(\{\})?|[&%$#_{}])", "", line.removesuffix(r" \\")
            )
            assert not re.search(r"[%$#_{}~^\\<>]", bare), line


def test_csv_tables_hold_full_precision_and_one_column_per_name(fields):
    table = list(csv.DictReader((fields.folder / "tables" / "runs.csv").open()))
    by_energy = sorted(row["energy"] for row in fields.rows)
    assert sorted(float(line["energy E"]) for line in table) == by_energy
    head, *_ = csv.reader((fields.folder / "tables" / "runs.csv").open())
    assert len(head) == len(set(head)) == len(table[0])


def test_numbers_of_a_summary_line_are_those_of_its_runs():
    rows = [
        ("a", record("sh4", energy=1.0)),
        ("a", record("su2", energy=2.0)),
        ("b", record("sh4", energy=3.0)),
        ("b", record("su2", energy=1.5)),
    ]
    sh4, su2 = lines(Results([Run(row, name) for name, row in rows]))
    assert (sh4.ratio, sh4.largest, sh4.lowest) == pytest.approx((2**0.5, 2.0, 1)) and (
        su2.ratio,
        su2.largest,
    ) == pytest.approx((2**0.5, 2.0))
    assert sh4.solved == sh4.problems == 2 and sh4.seconds == 1.0 and sh4.slowdown == 1.0


def test_repeats_count_once_with_their_least_time():
    rows = [record("sh4", cpu_seconds={"smooth": t}, repeat=k) for k, t in enumerate((3.0, 1.0, 2.0))]
    (line,) = lines(Results([Run(row, "a") for row in rows]))
    assert line.seconds == 1.0 and line.solved == line.problems == 1


def test_performance_profiles_count_problems():
    found = performance_profiles({"a": [1, 4, 2, 0], "b": [2, 2, float("inf"), 1]})
    assert found["a"].ratio.tolist() == [1, 1, 1, 2] and found["a"].share.tolist() == pytest.approx(
        [2 / 3, 1 / 3, 2 / 3, 1]
    )
    assert found["b"].ratio.tolist() == [1, 1, 2] and found["b"].share.tolist() == pytest.approx([1 / 3, 1 / 3, 2 / 3])
    assert (
        found["a"].at(1) == pytest.approx(2 / 3)
        and found["a"].at(2) == 1
        and found["b"].at(1.5) == pytest.approx(1 / 3)
    )


def test_distances_are_symmetric_and_zero_to_itself(fields):
    results = Results([*runs_of(fields)])
    found = deviations(results)
    assert np.array_equal(found.mean, found.mean.T) and np.array_equal(np.diag(found.mean), [0, 0])
    assert 0 < found.mean[0, 1] < found.high[0, 1] < 62.8
    assert len(found.drawn[results.methods[1]]) == 2 * fields.rows[0]["vertices"]


def decode(block: str):
    """(size, outline, scenes) of a block, by the description in scenes.py."""
    content = zlib.decompress(base64.b64decode(block))
    length = int.from_bytes(content[:4], "little")
    head = json.loads(content[4 : 4 + length])
    numbers = iter(np.frombuffer(content[4 + length :], "<i2").reshape(-1, 3).astype(int))
    take = lambda counts: [np.cumsum([next(numbers) for _ in range(count)], axis=0) for count in counts]  # noqa: E731
    outline = take(head["outline"])
    found = [{kind: take(counts) for kind, counts in scene.items()} for scene in head["scenes"]]
    assert next(numbers, None) is None
    return head["size"], outline, found


def length_of(lines) -> float:
    return sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in lines)


def test_scenes_decode_to_the_curves_of_the_files(fields):
    runs = runs_of(fields)
    block, places = scenes.encode(runs)
    size, outline, found = decode(block)
    surface = pyvista.read(runs[0].file("surface.vtp"))
    extent = np.ptp(np.asarray(surface.points), axis=0)
    step = extent.max() / scenes.STEPS
    assert np.abs(np.array(size) * step - extent).max() <= step and len(outline) > 0
    for run, place in zip(runs, places, strict=True):
        file = pyvista.read(run.file("singular.vtp"))
        file.points = file.point_data["smoothed"]
        expected = file.compute_cell_sizes(area=False, volume=False).cell_data["Length"].sum()
        curves = [line for kind in ("valence 3", "valence 5", "other") for line in found[place][kind]]
        points = sum(map(len, curves))
        assert sum(len(line) for line in curves) == len(file.lines) - file.n_lines
        assert length_of(curves) * step == pytest.approx(expected, abs=2 * points * step)
        nodes = sum(map(len, found[place]["nodes"]))
        assert nodes == np.sum(file.point_data["node"]) == run.row["singular_nodes"]


def test_runs_with_equal_curves_share_a_scene_and_missing_files_leave_none(fields):
    run = runs_of(fields)[0]
    block, places = scenes.encode([run, Run(run.row, "sphere"), run])
    assert places == [0, None, 0] and len(decode(block)[2]) == 1
    assert scenes.encode([Run(run.row, "sphere")]) == ("", [None])


def test_the_page_holds_the_scenes_and_the_outline_once(fields):
    seen = elements(fields.to_html())
    views = [a for tag, a in seen if tag == "canvas"]
    assert len(views) == len(fields.rows) and len({a["data-block"] for a in views}) == 1
    assert sum(tag == "script" and a.get("type") == "text/plain" for tag, a in seen) == 1


def test_twenty_one_methods_are_told_apart_by_colour_and_dash():
    rows = [("a", record(r, solver=s)) for r, s in itertools.product(COMPARED, SOLVERS[:1] + SOLVERS[2:])]
    results = Results([Run(row, name) for name, row in rows])
    found = figures.styles(results.methods)
    assert len(found) == 21 and len({(s.colour, s.dash) for s in found.values()}) == 21


def test_convergence_ends_with_the_energy_of_the_tables_for_every_method(all_methods):
    results = Results([Run(row, "sphere") for row in all_methods.rows])
    (case,) = results.cases
    curves = figures.convergence(results, case)
    assert [m.name for m in curves] == [row["representation"] for row in all_methods.rows] and len(curves) > 6
    for row, curve in zip(all_methods.rows, curves.values(), strict=True):
        assert curve.energy[-1] == pytest.approx(row["energy"], rel=1e-9)
        assert curve.own[0] == 1 and len(curve.own) == len(curve.energy) - curve.begin
        assert curve.own[-1] * row["objective_history"][0] == pytest.approx(row["objective"], rel=1e-9)
        assert curve.energy[curve.begin] == pytest.approx(
            curves[results.methods[0]].energy[-1 if curve.begin else 0], rel=1e-2
        )  # about where sh4 ended


def test_independent_starts_are_rows_of_their_own_without_a_step_in_sh4(tmp_path):
    options = FieldOptions(edge_length=0.4)
    found = compare(write_sphere(tmp_path), tmp_path / "out", representations=("sh4", "su2"), boundaries=("aligned",),
        starts=("sh4", "independent"), options=options)  # fmt: skip
    assert [(row["representation"], row["options"]["rounds"], row["diffusion_steps"] > 0) for row in found.rows] == [
        ("sh4", options.rounds, True), ("su2", options.rounds, True), ("sh4", 0, False), ("su2", 0, False)]  # fmt: skip
    assert [m.name for m in Results([Run(row, "s") for row in found.rows]).methods] == [
        "sh4",
        "su2",
        "sh4 independent start",
        "su2 independent start",
    ]
    alone = found.rows[3]
    assert len(alone["energy_history"]) == len(alone["objective_history"]) == alone["iterations"] + 1


def test_pictures_are_files_of_two_thousand_pixels(tmp_path):
    found = compare(
        write_sphere(tmp_path),
        tmp_path / "out",
        representations=("sh4",),
        boundaries=("aligned",),
        options=FieldOptions(edge_length=0.4),
    )
    files = sorted((found.folder / "figures").glob("*.png"))
    assert len(files) >= 3 and {f"figures/{file.name}" for file in files} <= set(found.rows[0]["files"])
    for file in files:
        with Image.open(file) as image:
            assert 1200 < max(image.size) <= 2000


def test_every_input_has_a_section_and_plots_share_no_ids(tmp_path):
    page = page_of(
        tmp_path, [(f"part {k}", record(m, b)) for k in range(3) for m in ("sh4", "su2") for b in ("fixed", "aligned")]
    )
    sections = [a["id"] for tag, a in elements(page) if tag == "section"]
    assert sections == ["mesh-1-part-0", "mesh-2-part-1", "mesh-3-part-2"]
    assert all(f'href="#{anchor}"' in page for anchor in sections) and 'classList.add("paged")' in page


def test_plots_keep_the_text_of_their_axes(tmp_path):
    page = page_of(
        tmp_path,
        [
            (
                "a",
                record(
                    "sh4", wall_seconds=dict.fromkeys(("read", "mesh", "surface", "smooth", "analyse", "write"), 0.0042)
                ),
            )
        ],
    )
    assert ">0.005<" in page.split("seconds per phase")[1]


def test_the_page_is_for_light_and_dark(tmp_path):
    page = page_of(tmp_path, [("a", record())])
    assert "prefers-color-scheme: dark" in page and "currentColor" in page and "#010203" not in page


def test_vertices_that_no_frame_serves_are_counted_and_left_out_of_the_held_alignment(tmp_path):
    prism = pyvista.Cylinder(radius=1, height=1, resolution=8).clean().triangulate()
    octagon = compute_field(from_pyvista(prism), FieldOptions(edge_length=0.3, streamlines=0)).record
    assert (
        octagon["alignment_deg"]["max"] > 20
        and octagon["alignment_deg"]["held_max"] < 2
        and octagon["unserved_vertices"] > 8
    )
    cube = compute_field(write_cube(tmp_path), FieldOptions(edge_length=0.5, streamlines=0)).record
    assert cube["unserved_vertices"] == 0 and cube["alignment_deg"]["held_max"] == cube["alignment_deg"]["max"]
