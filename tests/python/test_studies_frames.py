"""The studies of frame representations run, write what they say, and find the numbers derived elsewhere."""

import csv
import subprocess
import sys
from pathlib import Path

import numpy as np
import octafield
import pytest

STUDIES = Path(__file__).parents[2] / "studies"
LARGEST = 62.7994  # degrees between two frames


def run(script: str, output: Path, *options: str) -> Path:
    done = subprocess.run(
        [sys.executable, STUDIES / script, "-o", output, *options], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    return output


def columns(path: Path) -> dict[str, np.ndarray]:
    with path.open(newline="") as file:
        header, *rows = csv.reader(file)
    return {name: np.array(values, dtype=float) for name, values in zip(header, zip(*rows))}


def summary(folder: Path) -> dict[str, str]:
    """Quantity -> what was found."""
    lines = [line.strip("| ").split(" | ") for line in (folder / "summary.md").read_text().splitlines()[2:]]
    return {line[1]: line[3] for line in lines}


@pytest.fixture(scope="module")
def thesis(tmp_path_factory) -> Path:
    return run("thesis_frames.py", tmp_path_factory.mktemp("thesis"), "--frames", "2000")


@pytest.fixture(scope="module")
def distortion_folder(tmp_path_factory) -> Path:
    return run("metric_distortion.py", tmp_path_factory.mktemp("distortion"), "--pairs", "2000", "--threads", "1")


@pytest.fixture(scope="module")
def distortion(distortion_folder) -> dict[str, dict[float, dict[str, float]]]:
    """metric -> angle in degrees -> quantity."""
    table: dict = {}
    with (distortion_folder / "distortion.csv").open(newline="") as file:
        for row in csv.DictReader(file):
            numbers = {key: float(row[key]) for key in ("speed", "min", "q01", "q50", "q99", "max")}
            table.setdefault(row["metric"], {})[float(row["angle_deg"])] = numbers
    return table


def test_each_figure_has_a_picture_and_its_numbers(thesis):
    for figure in ("4_3", "4_4", "4_7a", "4_7b", "4_8"):
        assert (thesis / f"frames_{figure}.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
        assert all(np.isfinite(values).all() for values in columns(thesis / f"frames_{figure}.csv").values())


def test_only_the_figures_asked_for_are_made(tmp_path):
    run("thesis_frames.py", tmp_path, "--figures", "4.4")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["frames_4_4.csv", "frames_4_4.png", "summary.md"]


def test_an_unknown_figure_is_refused_with_the_list(tmp_path):
    done = subprocess.run(
        [sys.executable, STUDIES / "thesis_frames.py", "-o", tmp_path, "--figures", "4.9"],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 2
    assert "4.9" in done.stderr and "4.7a" in done.stderr


def test_figure_4_3_is_the_quartic_and_its_degree_4_expansion(thesis):
    table = columns(thesis / "frames_4_3.csv")
    assert np.allclose(table["f"], table["x"] ** 4 + table["y"] ** 4 + table["z"] ** 4, atol=1e-8)
    assert np.allclose(table["f"], table["f_by_harmonics"], atol=1e-8)
    assert np.allclose(table["f_rotated"], table["f_rotated_by_harmonics"], atol=1e-8)
    found = summary(thesis)
    assert float(found["coefficient of Y40"]) == pytest.approx(4 * np.sqrt(np.pi) / 15, abs=1e-6)
    assert float(found["coefficient of Y44"]) == pytest.approx(4 * np.sqrt(np.pi) / 15 * np.sqrt(5 / 7), abs=1e-6)
    # '+ 12' adds 4 sqrt(pi)/15 sqrt(5/7) 3/16 sqrt(35/pi) 12 = 3
    assert float(found["largest error of the expansion with Y44 as printed"]) == pytest.approx(3, abs=1e-4)


def test_figure_4_4_lies_on_the_unit_sphere_of_the_4_norm(thesis):
    table = columns(thesis / "frames_4_4.csv")
    points = np.stack([table[name] * table["radius"] for name in "xyz"])
    assert np.allclose(np.sum(points**4, axis=0), 1, atol=1e-7)


def test_figure_4_7a_follows_the_invariants_along_the_three_axes(thesis):
    table = columns(thesis / "frames_4_7a.csv")
    t = np.radians(table["angle_deg"])
    # About the special axis h0 = exp(4it), h1 = h2 = 0. About another one, with X = sin^2 t and p = X / 4: h0 = 1 - 16
    # p (1/4 - p), h1 = p (1 - 4p), h2^2 = h1 (h0^3 - 108 h1^2).
    p = np.sin(t) ** 2 / 4
    h0, h1 = 1 - 4 * p + 16 * p**2, p * (1 - 4 * p)
    other = np.sqrt((1 - h0) ** 2 + h1**2 + np.maximum(h1 * (h0**3 - 108 * h1**2), 0))
    for convention, special in (("here", "i"), ("section_4_2", "k"), ("printed_4_25", "i")):
        for axis in "ijk":
            expected = 2 * abs(np.sin(2 * t)) if axis == special else other
            assert np.allclose(table[f"c3_{convention}_{axis}"], expected, atol=1e-7)
    for axis in "ijk":
        assert np.allclose(table[f"r4_{axis}"], 2 * np.sin(np.minimum(t, np.pi / 2 - t) / 4), atol=1e-8)


def test_only_the_printed_4_25_is_invariant_on_the_wrong_side(thesis):
    for name, wrong in (("this project", 1), ("thesis, section 4.2", 1), ("thesis, (4.25) as printed", 0)):
        changes = [
            float(x) for x in summary(thesis)[f"largest change of h over the 48 o, q o and o q: {name}"].split(", ")
        ]
        assert changes[wrong] > 0.1
        assert changes[1 - wrong] < 1e-12


def test_figure_4_7b_shows_frames_near_in_c3_and_far_in_r4(thesis):
    table = columns(thesis / "frames_4_7b.csv")
    assert len(table["r4"]) == 2000
    assert table["r4"].max() <= 2 * np.sin(np.radians(LARGEST) / 4) + 1e-6
    for convention in ("c3_here", "c3_section_4_2"):
        near = table["r4"][table[convention] < 0.3]
        assert near.min() < 0.1 and near.max() > 0.35


def test_figure_4_8_points_lie_on_their_ellipses(thesis):
    table = columns(thesis / "frames_4_8.csv")
    assert len(table["angle"]) == 500
    for convention, component in (("here", 2 / 7), ("section_4_2", 3 / 7)):  # the special coordinate of the shared axis
        p = ((1 + component) / (1 - component)) ** 2
        for name, center in (("H0", 14), ("H1", -2)):
            x, y = table[f"re_{name}_{convention}"] - center, table[f"im_{name}_{convention}"]
            assert np.allclose((x / (p + 1 / p)) ** 2 + (y / (p - 1 / p)) ** 2, 1, atol=1e-6)


def test_distortion_covers_every_metric_up_to_the_largest_angle(distortion):
    assert list(distortion) == list(octafield.frames.metrics)
    for rows in distortion.values():
        assert max(rows) == pytest.approx(LARGEST, abs=1e-4)
        assert min(rows) == 0.5


@pytest.mark.parametrize("name", ["geodesic", "su2_geodesic"])
def test_geodesic_metrics_do_not_distort(distortion, name):
    for row in distortion[name].values():
        assert row["min"] == pytest.approx(1, abs=1e-6)
        assert row["max"] == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize("name", ["sh4", "tensor4", "odeco"])
def test_chordal_distance_of_degree_4_distorts_by_1_6571(distortion, name):
    smallest = min(row["min"] for row in distortion[name].values())
    largest = max(row["max"] for row in distortion[name].values())
    # Of frames R and 1 the tensors are sqrt(6 - 2 sum R_ij^4) apart, sqrt(3.5) for the farthest ones; speed sqrt(8).
    assert smallest == pytest.approx(np.sqrt(3.5 / 8) / np.radians(LARGEST), rel=1e-5)
    assert largest == pytest.approx(1, abs=1e-4)
    assert largest / smallest == pytest.approx(1.6571, abs=2e-4)


def test_naive_su2_distance_is_off_by_factors_even_at_2_degrees(distortion):
    row = distortion["su2"][2.0]
    assert row["q01"] * row["speed"] == pytest.approx(0.48, abs=0.06)
    assert row["q99"] * row["speed"] == pytest.approx(3.7, abs=0.1)


@pytest.mark.parametrize("angle, low, high", [(2.0, 0.995, 1.001), (5.0, 0.967, 1.007), (10.0, 0.88, 1.03)])
def test_midpoint_metric_is_good_for_small_angles(distortion, angle, low, high):
    row = distortion["su2_midpoint"][angle]
    assert row["q01"] == pytest.approx(low, abs=0.002 + 0.05 * (1 - low))
    assert row["q99"] == pytest.approx(high, abs=0.002 + 0.05 * (1 - low))


def test_midpoint_metric_is_of_no_use_beyond_30_degrees(distortion):
    row = distortion["su2_midpoint"][45.0]
    assert row["max"] / row["min"] > 5


def test_distortion_does_not_depend_on_threads(distortion_folder, tmp_path):
    again = run("metric_distortion.py", tmp_path, "--pairs", "2000", "--threads", "2")
    assert (again / "distortion.csv").read_bytes() == (distortion_folder / "distortion.csv").read_bytes()


def test_distortion_has_a_picture_and_tables(distortion_folder):
    assert (distortion_folder / "frames_distortion.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    tables = (distortion_folder / "distortion.md").read_text()
    assert all(tables.count(f"| {name} |") == 2 for name in octafield.frames.metrics)
