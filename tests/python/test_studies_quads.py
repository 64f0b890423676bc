"""The figures of quad layouts: their layouts have the published counts, and what is refused says by how much."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import octafield as of
import pytest

STUDIES = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def figures(tmp_path_factory):
    folder = tmp_path_factory.mktemp("figures")
    names = "holed_5,holed_6,l_shape,annulus_fail,annulus_rotate,kite,trapezoid_50,trapezoid_40,diamond"
    command = [sys.executable, "-m", "studies.quad_figures", "-o", folder, "--only", names]
    done = subprocess.run(command, cwd=STUDIES, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in (folder / "summary.md").open()]
    return folder, {line[0]: dict(zip(lines[0], line, strict=False)) for line in lines[2:]}


@pytest.mark.parametrize(
    ("figure", "counts", "irregular"),
    [
        ("square less a disk, valence 5", "20, 32, 12", "4"),  # closed form of the combinatorics
        ("square less a disk, valence 6", "14, 22, 8", "2"),
        ("L", "8, 10, 3", "0"),
        ("kite, separatrices", "8, 12, 5", "4"),
        ("turned by 5, field rotated", "26, 45, 19", "8"),
        ("right trapezoid, 50 degrees", "4, 4, 1", "0"),
        ("right trapezoid, 40 degrees", "7, 9, 3", "1"),
        ("diamond, 28.65 degrees", "4, 4, 1", "0"),
    ],
)
def test_figures_have_the_layouts_that_follow_from_their_points(figures, figure, counts, irregular):
    row = figures[1][figure]
    assert (row["V, E, F"], row["irregular"]) == (counts, irregular)
    assert float(row["SJ min"]) > 0.45


def test_rings_that_are_turned_are_refused_with_the_angle(figures):
    row = figures[1]["turned by 20 degrees"]
    assert row["V, E, F"] == "`inadmissible_pattern`" and row["misalignment"] == "20 degrees"


def test_sheets_are_small_pictures(figures):
    for sheet in ("blocks", "rings", "cycles", "corners"):
        content = (figures[0] / f"quad_figures_{sheet}.png").read_bytes()
        assert content[:8] == b"\x89PNG\r\n\x1a\n" and 3_000 < len(content) < 100_000


def test_the_study_of_fixed_boundaries_finds_every_mesh_sound(tmp_path):
    pytest.importorskip("gmsh")
    command = [sys.executable, "-m", "studies.channel", "-o", tmp_path, *"--edge 0.06 --angles 1 --quads 500".split()]
    done = subprocess.run(command, cwd=STUDIES, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    text = (tmp_path / "summary.md").read_text()
    assert "4 configurations" in text and ": 0 failures." in text
    row = next(line for line in text.splitlines() if line.startswith("| octafield |"))
    assert row.split("|")[3].strip() == "0"  # triangles
    content = (tmp_path / "channel_coast.png").read_bytes()
    assert content[:8] == b"\x89PNG\r\n\x1a\n" and 3_000 < len(content) < 300_000


def test_the_judge_of_quads_sees_what_is_wrong():
    from studies.quad_judge import judged

    plate = of.TriangleMesh([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    features = np.array([[0, 1], [1, 2], [2, 3], [0, 3]])
    points = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0]], float)
    quads, no_triangles = np.array([[0, 1, 4, 3], [1, 2, 5, 4]]), np.zeros((0, 3), int)
    good = judged(points, quads, no_triangles, plate, features, 1.0)
    assert (good["quads"], good["inverted"], good["nonconforming"], good["irregular"]) == (2, 0, 0, 0)
    assert good["least"] == good["p10"] == good["p90"] == 1 and good["off_features"] == 0
    folded = points.copy()
    folded[4] = [2.5, 0.5, 0]
    assert judged(folded, quads, no_triangles, plate, features, 1.0)["inverted"] == 1
    gap = judged(
        np.vstack([points, points[1:2] + [0, 0.3, 0]]),
        np.array([[0, 6, 4, 3], [1, 2, 5, 4]]),
        no_triangles,
        plate,
        features,
        1.0,
    )
    assert gap["nonconforming"] > 0
    short = judged(points * [0.9, 1, 1], quads, no_triangles, plate, features, 1.0)
    assert short["off_features"] > 0.08
    uneven = points.copy()
    uneven[[1, 4], 0] = 0.4
    small = judged(uneven, quads, no_triangles, plate, features, 1.0)
    assert (small["small"], small["small_area"], small["poor"]) == (0.5, pytest.approx(0.2), 0)
    assert (good["small"], good["small_area"], good["poor"]) == (0, 0, 0)
    uneven[4] = [1, 0.1, 0]  # at vertex 1 corners of 9 and 171 degrees
    assert judged(uneven, quads, no_triangles, plate, features, 1.0)["poor"] == 2
