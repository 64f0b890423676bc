"""What a record tells of the cost of a run: the machine it ran on, and the memory it took, writing included."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import octafield as of
import pytest
from octafield.domain.generators import generate
from octafield.progress import phases
from octafield.runs import run_folder as results

MB = 1e6
WRITTEN = {
    "field": lambda: (of.compute_field(generate("box"), of.FieldOptions(edge_length=0.5)), results.write_field_result),
    "surface": lambda: (of.compute_surface_field(generate("box"), of.SurfaceFieldOptions(edge_length=0.5)),
        results.write_surface_result),
    "analysis": lambda: (of.analyse(mesh := of.prepare_mesh(generate("box"), of.MeshOptions(edge_length=0.5)),
        [[1, 0, 0, 0]] * len(mesh.tets.vertices)),
                         results.write_analysis),
}  # fmt: skip


@pytest.mark.parametrize("kind", WRITTEN)
def test_the_peak_includes_writing(kind, tmp_path, monkeypatch):
    result, write = WRITTEN[kind]()
    before, save, seen = result.record["peak_mb"], results._save, []

    def hungry(*arguments):
        needed = np.ones(int(400 * MB / 8))  # given back before writing ends
        seen.append(phases.PeakMemory().megabytes() if needed[-1] else 0)
        save(*arguments)

    monkeypatch.setattr(results, "_save", hungry)
    write(result, tmp_path)
    assert result.record["peak_mb"] >= max(seen) - 1 and max(seen) > 400
    assert result.record["peak_mb"] > before or before > 400
    assert json.loads((tmp_path / "result.json").read_text())["peak_mb"] == result.record["peak_mb"]


@pytest.mark.parametrize("kind", WRITTEN)
def test_a_record_names_the_machine(kind, monkeypatch):
    monkeypatch.setattr(os, "getloadavg", lambda: (3.25, 1.0, 1.0))
    found = WRITTEN[kind]()[0].record["machine"]
    models = [
        line.partition(":")[2].strip()
        for line in Path("/proc/cpuinfo").read_text().splitlines()
        if line.startswith("model name")
    ]
    assert (
        found == {"cpu": models[0] if models else found["cpu"], "cores": len(os.sched_getaffinity(0)), "load": 3.25}
        and found["cpu"]
    )


def test_cores_are_those_the_process_may_use():
    one = min(os.sched_getaffinity(0))
    script = (
        f"import os; os.sched_setaffinity(0, {{{one}}}); from octafield.progress import phases; "
        "print(phases.machine()['cores'])"
    )
    assert subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout == "1\n"
