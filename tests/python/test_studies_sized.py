"""The study of sizes wanted and reached runs on a small mesh and finds what it says."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_exponential_growth_is_nearly_reached_and_the_strip_doubles(tmp_path):
    command = [sys.executable, "-m", "studies.sized_fields", "-o", tmp_path]
    command += ["--edge", "0.09", "--spacing", "0.15", "--only", "exponential,x10"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    tables = (tmp_path / "summary.md").read_text().split("\n\n")
    rows = [[[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()] for table in tables]
    radial = {line[2]: dict(zip(rows[1][0], line, strict=True)) for line in rows[1][2:]}
    by_metric = radial["diffusion in the metric"]
    assert 7 < float(by_metric["reached"]) < 14
    strip = {line[0]: [float(cell) for cell in line[1:]] for line in rows[2][2:]}
    assert 1.7 < strip["along the growth"][0] < 2.3
    assert (tmp_path / "sized_fields.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"


def test_quads_of_the_strip_grow_without_irregular_ones():
    from studies.quad_sizes import STRIP, strip_row

    row = dict(zip(STRIP, strip_row(), strict=True))
    assert row["irregular"] == "none" and 0.9 < float(row["median"]) < 1.1


def test_a_nautilus_is_meshed_with_points_moved_where_they_may_be_and_refused_where_they_are_kept():
    from studies.limit_cycles import FIELDS, HEADER, row

    name = next(name for name in FIELDS if name.startswith("nautilus"))
    found = dict(zip(HEADER, row(name), strict=True))
    assert found["points kept (quad-layout)"] == "no_integers" and found["valence 3, 5"] == "1, 1"
    assert found["changed"] and float(found["SJ min"]) > 0.5 and float(found["sizes after a turn"]) > 10
