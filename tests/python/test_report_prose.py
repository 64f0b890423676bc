"""What a report says is what its rows hold, whatever these are."""

import csv
import re

import numpy as np
import octafield
import pytest
import pyvista
from octafield.options import FieldOptions
from octafield.runs.compare import compare
from octafield.view import scene
from pipeline_fixtures import write_cube, write_sphere
from report_pages import page_of, prose, record

METHODS, BOUNDARIES = ("sh4", "odeco", "su2", "geodesic"), ("fixed", "aligned")


@pytest.fixture(scope="module")
def comparison(tmp_path_factory):
    folder = tmp_path_factory.mktemp("compare")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scene, "can_draw", lambda: False)  # pictures take the most time
        return compare(
            [write_sphere(folder), write_cube(folder)],
            folder / "out",
            representations=METHODS,
            options=FieldOptions(edge_length=0.5),
        )


def of(rows, **wanted):
    return [row for row in rows if all(row[key] == value for key, value in wanted.items())]


def recomputed(comparison) -> list[float]:
    """Numbers that the prose may hold, from the rows and files, by other means than the report's."""
    rows = comparison.rows
    inputs = list(dict.fromkeys(row["input"] for row in rows))
    found = [len(METHODS), len(inputs), len(BOUNDARIES), len(rows), len(rows) // len(METHODS), 0.01, 1, 95, 40.7]
    found += [row[key] for row in rows for key in ("vertices", "tets", "energy")]
    for boundary in BOUNDARIES:
        best = {name: min(row["energy"] for row in of(rows, input=name, boundary=boundary)) for name in inputs}
        counted = [name for name in inputs if best[name] > 1e-9]
        found += [len(counted), len(inputs) - len(counted)]
        for method in METHODS:
            own = of(rows, boundary=boundary, representation=method)
            ratios = [row["energy"] / best[row["input"]] for row in own if row["input"] in counted]
            found += [
                *ratios,
                float(np.prod(ratios) ** (1 / len(ratios))),
                sum(r["energy"] <= 1.0001 * best[r["input"]] + 1e-9 for r in own),
            ]
            found += [
                sum(row[key] for row in own) for key in ("singular_edges", "complex_edges", "non_meshable_vertices")
            ]
    seconds = {m: [row["cpu_seconds"]["smooth"] for row in of(rows, representation=m)] for m in METHODS}
    fastest = np.min(list(seconds.values()), axis=0)
    found += [sum(s) for s in seconds.values()] + [
        float(np.exp(np.mean(np.log(s / fastest)))) for s in seconds.values()
    ]
    found += [
        sum(of(rows, input=name)[0]["wall_seconds"][phase] for phase in ("read", "mesh", "surface")) for name in inputs
    ]
    lowest = lambda row: min(r["energy"] for r in of(rows, input=row["input"], boundary=row["boundary"]))
    found.append(len({(row["input"], row["boundary"]) for row in rows if lowest(row) > 1e-9}))
    for method in METHODS:
        ratios = [row["energy"] / lowest(row) for row in of(rows, representation=method) if lowest(row) > 1e-9]
        found.append(100 * float(np.mean(np.array(ratios) <= 1.01)))
    return found + angles(comparison)


def angles(comparison) -> list[float]:
    frames = {
        row["folder"]: pyvista.read(comparison.folder / row["folder"] / "field.vtu").point_data["quaternion"]
        for row in comparison.rows
    }
    found = []
    for a in METHODS:
        for b in METHODS:
            pairs = [
                np.degrees(octafield.frames.distance(frames[one["folder"]], frames[other["folder"]]))
                for one, other in zip(
                    of(comparison.rows, representation=a), of(comparison.rows, representation=b), strict=True
                )
            ]
            found += [float(np.mean([p.mean() for p in pairs])), float(np.mean([np.percentile(p, 95) for p in pairs]))]
    return [*found, 1e-4]


def test_every_number_in_the_prose_is_one_of_the_rows(comparison):
    known = recomputed(comparison)
    text = " ".join(prose(comparison.to_html(), references=False)[:-1])  # the last is about versions and files
    text = re.sub("|".join(METHODS), "", text)
    numbers = re.findall(r"(?<![\w.])\d[\d,]*(?:\.\d+)?(?:e-?\d+)?", text)
    assert len(numbers) > 30
    for number in (n.rstrip(",") for n in numbers):
        digits = len(re.split("e", number)[0].partition(".")[2])
        exponent = int(number.partition("e")[2] or 0)
        half = 0.5000001 * 10.0 ** (exponent - digits)
        assert any(abs(float(number.replace(",", "")) - value) <= half for value in known), (number, text)


def test_every_sentence_on_results_names_its_table_or_figure(comparison):
    for paragraph in prose(comparison.to_html())[1:-1]:
        for sentence in re.split(r"(?<=\))\. ", paragraph):
            assert re.search(r"\((Table|Figure) \d+", sentence), sentence


def energies(tmp_path, *energies, boundary="aligned", **options):
    methods = ("sh4", "su2", "odeco", "geodesic")
    page = page_of(
        tmp_path,
        [
            (f"m{k}", record(m, boundary, e))
            for k, row in enumerate(energies)
            for m, e in zip(methods, row, strict=False)
        ],
        **options,
    )
    return " ".join(prose(page, references=False))


def test_the_lowest_is_named_with_the_distance_of_the_others(tmp_path):
    text = energies(tmp_path, (2.0, 2.2, 3.0))
    assert "sh4 has the lowest energy, E = 2; the others end at 1.1000 (su2) to 1.5000 (odeco) times that" in text


def test_means_over_problems_are_geometric(tmp_path):
    text = energies(tmp_path, (2.0, 2.2), (1.0, 4.4))
    assert (
        "sh4 has the lowest energies: 1.0000 times the lowest of each problem on geometric mean; the other ends at"
        " 2.2000 times it" in text
    )
    assert (
        "single problems reach 4.4000 (su2)" in text
        and "On 2 of 2 problems the lowest energy, or one within 0.01 % of it, is that of sh4" in text
    )


def test_energies_closer_than_a_hundredth_of_a_per_cent_are_not_ranked(tmp_path):
    text = energies(tmp_path, (2.0, 2.0001, 2.00005))
    assert "all 3 methods end at the same energy within 0.01 %, E = 2" in text
    text = energies(tmp_path, (2.0, 2.0001, 2.2))
    assert (
        "sh4 and su2 have the lowest energy, E = 2 (within 0.01 % of each other); the other ends at 1.1000 times that"
        in text
    )


def test_opposite_orders_on_two_problems_are_equal_on_the_mean(tmp_path):
    text = energies(tmp_path, (1.0, 2.0), (2.0, 1.0))
    assert (
        "both methods are equal on geometric mean, at 1.4142 times the lowest of each problem; single problems reach"
        " 2.0000" in text
    )


def test_boundary_treatments_are_not_ranked_against_each_other(tmp_path):
    records = [
        ("part", record(m, b, e))
        for b, scale in (("fixed", 100.0), ("aligned", 1.0))
        for m, e in (("sh4", scale), ("su2", 1.5 * scale))
    ]
    text = " ".join(prose(page_of(tmp_path, records), references=False))
    assert "With the boundary fixed, sh4 has the lowest energy, E = 100; the other ends at 1.5000 times that" in text
    assert "With the boundary aligned, sh4 has the lowest energy, E = 1; the other ends at 1.5000 times that" in text
    assert (tmp_path / "tables" / "summary.csv").read_text().count(",1.0,1.0,1,") == 2


def test_fields_without_energy_are_no_base_of_ratios(tmp_path):
    assert "the lowest energy is zero up to rounding; both methods reach it" in energies(tmp_path, (1e-29, 3e-27))
    assert "on both problems; sh4 reaches it, the other ends above" in energies(tmp_path, (1e-29, 1.0), (0.0, 1.0))
    text = energies(tmp_path, (1e-29, 3e-27), (1.0, 2.0))
    assert "sh4 has the lowest energies" in text and "keeps 1 problem out of the ratios" in text


def test_one_method_on_one_mesh_is_not_compared(tmp_path):
    page = page_of(tmp_path, [("part", record(energy=3.5, singular_edges=1))])
    text = " ".join(prose(page, references=False))
    assert "One method, sh4, is applied to part with the boundary aligned: 1 run" in text
    assert "sh4 ends at E = 3.5" in text and "1 singular edge, none of them complex, and no places" in text
    assert "lowest" not in text and "Performance profiles." not in page.split('id="methods"')[0]


def test_runs_without_a_field_are_told_and_take_no_part_in_rankings(tmp_path):
    records = [(name, record(m, energy=e)) for name in ("a", "b") for m, e in (("sh4", 2.0), ("su2", 1.0))]
    records[2] = ("b", record("sh4", state="failed", message="<b> is wrong"))
    records += [("a", record("odeco", state="crashed", message="SIGKILL")), ("b", record("odeco", energy=3.0))]
    page = page_of(tmp_path, records, open_runs=3)
    text = " ".join(prose(page, references=False))
    assert (
        "A field was obtained in 4 of the 6 runs; 1 failed and 1 crashed" in text
        and "Not carried out yet: 3 runs" in text
    )
    assert (
        "only su2 has a field on every problem" in text
        and "Not ranked, for want of a field on some problem that another method solves: sh4 and odeco" in text
    )
    assert "Runs without a field" in page and "&lt;b&gt; is wrong" in page


def test_times_are_those_of_methods_with_every_field_and_relative_to_the_fastest_of_all(tmp_path):
    smooth = lambda seconds: {"cpu_seconds": {"smooth": seconds}}  # noqa: E731
    records = [
        ("a", record("sh4", **smooth(2.0))),
        ("a", record("su2", **smooth(8.0))),
        ("a", record("odeco", **smooth(1.0))),
    ]
    records += [
        ("b", record("sh4", **smooth(3.0))),
        ("b", record("su2", **smooth(3.0))),
        ("b", record("odeco", state="failed")),
    ]
    text = " ".join(prose(page_of(tmp_path, records), references=False))
    assert "Smoothing takes 5 (sh4) to 11 (su2) processor seconds in all on 2 problems" in text
    assert (
        "relative to the fastest method on each problem that is a factor of 1.41 (sh4) to 2.83 (su2)"
        in text.replace("Relative", "relative")
    )
    assert "Left out of times, for want of a field on some problem that another method solves: odeco" in text


def test_problems_that_no_method_solves_count_for_nothing(tmp_path):
    records = [("a", record("sh4", energy=1.0)), ("a", record("su2", energy=2.0))]
    records += [("b", record(m, state="failed", message="no")) for m in ("sh4", "su2")]
    text = " ".join(prose(page_of(tmp_path, records), references=False))
    assert "sh4 has the lowest energy, E = 1; the other ends at 2.0000 times that" in text
    assert "of 1 problem with an energy above zero" in text and "on 2 problems" in text.split(".")[0]
    assert "Left out" not in text and "Not ranked" not in text


def test_seeds_are_no_problems_their_mean_and_spread_are_told(tmp_path):
    records = [
        ("part", record(m, energy=e, seed=k))
        for m, of in (("sh4", (1.0, 3.0)), ("su2", (2.0, 4.0)))
        for k, e in enumerate(of)
    ]
    page = page_of(tmp_path, records)
    text = " ".join(prose(page, references=False))
    assert "4 runs on 1 problem" in text and "and 2 seeds" in text and "means over its seeds" in text
    assert "sh4 has the lowest energy, E = 2; the other ends at 1.5000 times that" in text
    assert "Performance profiles. " not in page.split('id="methods"')[0]  # of a single problem there are none
    head, sh4, su2 = (line.split(",") for line in (tmp_path / "tables" / "summary.csv").read_text().splitlines())
    assert [line[head.index("energy E")] for line in (sh4, su2)] == ["2.0", "3.0"]
    spread = [float(line[head.index("energy seeds %")]) for line in (sh4, su2)]
    assert spread == pytest.approx([100 * 2**0.5 / 2, 100 * 2**0.5 / 3])


def test_a_seed_without_a_field_leaves_its_problem_unsolved(tmp_path):
    records = [
        ("part", record(m, energy=1.0, seed=k, state="failed" if (m, k) == ("su2", 1) else "done"))
        for m in ("sh4", "su2")
        for k in (0, 1)
    ]
    text = " ".join(prose(page_of(tmp_path, records), references=False))
    assert "only sh4 has a field on every problem" in text


def test_where_methods_start_and_what_they_are_judged_by_is_told(tmp_path):
    text = " ".join(prose(page_of(tmp_path, [("a", record(m)) for m in ("sh4", "su2")]), references=False))
    assert (
        "Every method starts from the minimum that was found of sh4's energy; all are judged by sh4's energy E" in text
    )
    text = " ".join(
        prose(page_of(tmp_path, [("a", record(m, rounds=k)) for m in ("sh4", "su2") for k in (2, 0)]), references=False)
    )
    assert (
        "2 variants (default and independent start)" in text
        and "those called “independent start” from one linear solve" in text
    )
    text = " ".join(prose(page_of(tmp_path, [("a", record(m, rounds=0)) for m in ("sh4", "su2")]), references=False))
    assert "Every method starts for itself, from one linear solve" in text


def test_edges_that_no_frame_serves_are_explained_and_left_out_of_what_is_held(tmp_path):
    page = page_of(
        tmp_path, [("nut", record(alignment_deg={"median": 0.0, "max": 45.0, "held_max": 0.5}, unserved_vertices=12))]
    )
    assert "At 12 vertices on edges between faces no frame serves all faces that meet" in page
    (line,) = csv.DictReader((tmp_path / "tables" / "runs.csv").open())
    assert (
        line["alignment, deg held, max"] == "0.5"
        and line["alignment, deg unserved"] == "12"
        and "45.0" not in line.values()
    )


def test_nothing_but_failures_is_a_report_too(tmp_path):
    page = page_of(tmp_path, [("a", record(state="failed", message="no")), ("b", record(state="crashed"))])
    assert "A field was obtained in 0 of the 2 runs; 1 failed and 1 crashed" in " ".join(prose(page, references=False))


def test_frames_in_tets_have_no_meshability_and_are_problems_of_their_own(tmp_path):
    absent = ("non_meshable_vertices", "non_meshable_feature_edges", "non_meshable_corners", "integrability")
    in_tets = record(energy=9.0, sampling="tets", singular_edges=3).changed(**dict.fromkeys(absent))
    page = page_of(tmp_path, [("a", record()), ("a", in_tets)])
    text = " ".join(prose(page, references=False))
    assert "(aligned, frames at vertices; aligned, frames in tets)" in text
    assert "With the boundary aligned (frames in tets), the field has 3 singular edges, none of them complex." in text


def test_unconverged_fields_and_missing_counts_are_told(tmp_path):
    rows = [
        ("a", record("sh4", converged=False, stop_reason="too <long>")),
        ("a", record("su2", complex_edges=2, singular_edges=5)),
    ]
    text = " ".join(prose(page_of(tmp_path, rows), references=False))
    assert "The tolerance was not met by 1 of 2 fields (“too <long>”)" in text
    assert (
        "0 (sh4) to 5 (su2) singular edges, 0 (sh4) to 2 (su2) of them complex, and no places that no hex mesh has"
        in text
    )


@pytest.mark.parametrize("value", [float("inf"), 1e-300, 1e300])
def test_extreme_energies_do_not_break_a_report(tmp_path, value):
    assert "a report" in page_of(tmp_path, [("a", record("sh4", energy=value)), ("a", record("su2"))])


def test_methods_are_what_varies_in_smoothing(tmp_path):
    rows = [
        ("a", record("sh4", energy=1.0)),
        ("a", record("sh4", energy=2.0, solver="lbfgs")),
        ("a", record("sh4", energy=4.0, rounds=3, solver="lbfgs")),
    ]
    text = " ".join(prose(page_of(tmp_path, rows), references=False))
    assert re.search(r"sh4 rounds \d, sh4 lbfgs rounds \d and sh4 lbfgs rounds 3", text)
