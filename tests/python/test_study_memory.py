"""The memory that studies reserve is what runs need, and not many times more."""

import subprocess
import sys

import numpy as np
from test_studies_volume import ROOT, rows


def test_reserved_memory_fits_the_measured_and_the_page_is_written(tmp_path):
    command = [
        sys.executable,
        "-m",
        "studies.benchmarks.scaling",
        "-o",
        tmp_path,
        "--tets",
        "4000,20000",
        "--runs",
        "40",
    ]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    table = rows(tmp_path / "memory" / "memory.md")
    number = lambda row, name: float(row[name].replace(",", ""))
    for representation in ("sh4", "sh469", "geodesic", "su2_midpoint"):
        of = [row for row in table if row["representation"] == representation and row["mesh"] == "ball"]
        tets, needs, reserved = (
            np.array([number(row, name) for row in of])
            for name in ("tets", "process, all MB", "expected by studies MB")
        )
        assert len(of) == 2 and (needs < reserved).all(), of
        assert np.diff(reserved) < 4 * np.diff(needs), of
        assert (np.diff(tets) > 5000).all()
    page = (tmp_path / "scaling.md").read_text()
    assert "(not run)" not in page and "40 runs: runs.sqlite" in page and "all of them" in page
