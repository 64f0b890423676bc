"""What tests of studies share."""

import os
from pathlib import Path

from octafield import study

BODIES = """name: bodies
inputs:
  - {generator: ball, mesh: {edge_length: 0.4}}
  - {generator: box, mesh: {edge_length: 0.4}}
runs: {representation: [sh4, sh469]}
"""
# Of processes of runs: sh469 takes a minute.
STALLS = """import time
import octafield.fields.frame_field as p
run = p.run_field
p.run_field = lambda problem, o, *a: time.sleep(60) if o.representation == 'sh469' else run(problem, o, *a)
"""


def table(folder: Path) -> list[dict]:
    """What a run decides; times and hosts differ from run to run."""
    keys = (
        "key",
        "input",
        "state",
        "message",
        "repeat",
        "mesh_sha256",
        "energy",
        "energy_history",
        "singular_edges",
        "options",
    )
    return [{key: row.get(key) for key in keys} for row in study.rows(folder)]


def trap_workers(folder: Path, monkeypatch, code: str) -> None:
    """Has every process of a run execute `code` as it starts."""
    trap = folder / "trap"
    trap.mkdir()
    guarded = "".join(f"    {line}\n" for line in code.splitlines())
    (trap / "sitecustomize.py").write_text(
        f"import os, sys\nif any('study.running.worker' in a for a in sys.orig_argv):\n{guarded}"
    )
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(trap), *filter(None, [os.environ.get("PYTHONPATH")])]))
