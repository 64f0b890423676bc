"""A study ends with the same table however often it is killed, on one machine or several."""

import csv
import json
import os
import random
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import octafield
import pytest
from octafield import study
from report_pages import require_sound
from study_fixtures import table, trap_workers

TEXT = """name: cubes and balls
inputs:
  - {generator: ball, mesh: {edge_length: 0.45}}
  - {generator: box, with: {x: 2}, mesh: {edge_length: 0.4}}
  - nothing_here_*.stl
runs:
  representation: [sh4, geodesic]
  boundary: [aligned, fixed]
"""
PROGRAM = "import sys; from octafield import study; study.run(study.load(sys.argv[1]), sys.argv[2], jobs=2)"


@pytest.fixture(scope="module")
def described(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("study")
    (folder / "nothing_here_1.stl").write_text("solid\nendsolid\n")  # fails: no triangles
    (folder / "study.yaml").write_text(TEXT)
    return folder / "study.yaml"


@pytest.fixture(scope="module")
def undisturbed(described) -> Path:
    outcome = study.run(study.load(described), described.parent / "undisturbed")
    assert outcome.status == study.Status(done=8, failed=4, crashed=0, open=0) and len(outcome.computed) == 12
    return outcome.folder


def left_over(folder: Path) -> list[str]:
    return [path.name for path in folder.rglob(".*")]


def test_a_finished_study_has_a_row_and_a_folder_per_run(undisturbed):
    rows = study.rows(undisturbed)
    for row in rows:
        files = {path.name for path in (undisturbed / "runs" / row["key"]).iterdir()}
        assert {"result.json", "log.txt"} <= files
        assert ({"field.vtu", "singular.vtp"} <= files) == (row["state"] == "done")
    (message,) = {row["message"] for row in rows if row["state"] == "failed"}
    assert "nothing_here_1.stl" in message
    with sqlite3.connect(undisturbed / "runs.sqlite") as db:
        assert db.execute("SELECT state, COUNT(*) FROM runs GROUP BY state").fetchall() == [("done", 8), ("failed", 4)]
    assert left_over(undisturbed) == []


def test_a_finished_study_computes_nothing_again_and_grows_with_its_description(undisturbed, described):
    assert study.run(study.load(described), undisturbed).computed == []
    more = study.parse(TEXT + "seeds: [0, 1]\n", folder=described.parent)
    grown = study.run(more, undisturbed)
    assert grown.status.done == 16 and len(grown.computed) == 12
    assert study.run(study.load(described), undisturbed).computed == []
    assert study.status(undisturbed).total == 12


def test_records_equal_those_of_a_field_computed_alone(undisturbed):
    run = next(r for r in study.plan(study.parse(TEXT.replace("  - nothing_here_*.stl\n", ""))) if r.name == "box x 2")
    from octafield.domain.generators import generate

    alone = octafield.compute_field(generate("box", x=2), run.options)
    (row,) = [row for row in study.rows(undisturbed) if row["key"] == run.key]
    assert row["energy"] == alone.record["energy"] and row["mesh_sha256"] == alone.record["mesh_sha256"]


def test_kills_at_random_moments_change_nothing(undisturbed, described, tmp_path):
    choose, folder = random.Random(7), tmp_path / "killed"
    seen = set()
    for _ in range(10):
        process = subprocess.Popen([sys.executable, "-c", PROGRAM, described, folder], stderr=subprocess.DEVNULL)
        wanted = min(len(seen) + choose.randrange(0, 3), 12)  # let it get on, then strike while the next is in work
        stop = time.monotonic() + 60
        while process.poll() is None and len(finished(folder)) < wanted and time.monotonic() < stop:
            time.sleep(0.02)
        time.sleep(choose.uniform(0, 0.4))
        process.send_signal(signal.SIGKILL)
        process.wait()
        now = finished(folder)
        assert seen <= now, "a finished run was lost"
        for key in now:
            assert json.loads((folder / "runs" / key / "result.json").read_text())["key"] == key
        seen = now
    assert 0 < len(seen), "all kills struck before any run"
    outcome = study.run(study.load(described), folder)
    assert table(folder) == table(undisturbed)
    assert len(outcome.computed) == 12 - len(seen) and left_over(folder) == []


def finished(folder: Path) -> set[str]:
    runs = folder / "runs"
    return {p.name for p in runs.iterdir() if not p.name.startswith(".")} if runs.is_dir() else set()


def workers(of: int) -> list[int]:
    children = Path(f"/proc/{of}/task").glob("*/children")
    return [int(pid) for path in children for pid in path.read_text().split()]


def test_a_run_whose_process_is_killed_is_tried_again(undisturbed, described, tmp_path):
    folder = tmp_path / "struck"
    process = subprocess.Popen([sys.executable, "-c", PROGRAM, described, folder], stderr=subprocess.DEVNULL)
    struck = False
    while process.poll() is None:
        if not struck and finished(folder) and workers(process.pid):
            os.kill(workers(process.pid)[0], signal.SIGKILL)
            struck = True
        time.sleep(0.01)
    assert struck and process.returncode == 0
    assert table(folder) == table(undisturbed)


def test_a_run_that_kills_its_process_twice_is_recorded_and_tried_on_resume(described, tmp_path, monkeypatch):
    text = (
        "{name: x, inputs: [{generator: ball, mesh: {edge_length: 0.45}}], runs: {representation: [sh4, su2,"
        " geodesic]}}"
    )
    trap_workers(
        tmp_path,
        monkeypatch,
        "import octafield.fields.frame_field as p\nrun = p.run_field\n"
        "p.run_field = lambda problem, options, *a: os.abort() if"
        " options.representation == 'su2' else run(problem, options, *a)\n",
    )
    outcome = study.run(study.parse(text), tmp_path / "out", jobs=1)
    assert outcome.status == study.Status(done=2, failed=0, crashed=1, open=0)
    (row,) = [row for row in study.rows(tmp_path / "out") if row["state"] == "crashed"]
    assert row["options"]["representation"] == "su2" and "SIGABRT" in row["message"]
    monkeypatch.undo()
    again = study.run(study.parse(text), tmp_path / "out", jobs=1)
    assert again.computed == [row["key"]] and again.status.done == 3


def test_runs_wait_for_each_other_where_memory_is_for_one(described, tmp_path):
    text = TEXT.replace("  - nothing_here_*.stl\n", "")
    study.run(study.parse(text), tmp_path / "narrow", jobs=2, memory_mb=1)
    spans = {name: [] for name in ("ball", "box x 2")}
    for row in study.rows(tmp_path / "narrow"):
        spans[row["input"]].append((row["began"], row["ended"]))
    first, second = sorted((min(b for b, _ in s), max(e for _, e in s)) for s in spans.values())
    assert first[1] <= second[0]


def test_one_process_at_a_time_leads_a_study_and_foreign_folders_are_refused(described, tmp_path):
    folder = tmp_path / "held"
    store_program = (
        "import sys, time; from octafield import study; from octafield.study.store import Store\n"
        "with Store(sys.argv[2]).led(study.load(sys.argv[1])): print('held', flush=True); time.sleep(60)"
    )
    holder = subprocess.Popen([sys.executable, "-c", store_program, described, folder], stdout=subprocess.PIPE)
    try:
        assert holder.stdout.readline() == b"held\n"
        with pytest.raises(octafield.InvalidInput, match="another process"):
            study.run(study.load(described), folder)
    finally:
        holder.kill()
        holder.wait()
    (tmp_path / "foreign").mkdir()
    (tmp_path / "foreign" / "thesis.tex").write_text("")
    with pytest.raises(octafield.InvalidInput, match="not the folder of a study"):
        study.run(study.load(described), tmp_path / "foreign")
    assert [path.name for path in (tmp_path / "foreign").iterdir()] == ["thesis.tex"]
    with pytest.raises(octafield.InvalidInput, match="not the folder of a study"):
        study.rows(tmp_path / "foreign")


def test_cancelling_keeps_what_is_finished(described, tmp_path):
    with pytest.raises(octafield.Cancelled):
        study.run(study.load(described), tmp_path / "out", progress=lambda what, fraction, merit: fraction < 0.3)
    assert 3 <= len(study.rows(tmp_path / "out")) < 12


def test_reports_show_what_every_kind_of_run_has(undisturbed, described, tmp_path):
    page = study.write_report(undisturbed)
    text = page.read_text()
    assert "Runs without a field" in text and "nothing_here_1.stl" in text and 'data-scene="0"' in text
    assert {path.name for path in (page.parent / "tables").iterdir()} == {
        f"{stem}.{end}" for stem in ("summary", "deviations", "inputs", "runs") for end in ("csv", "tex")
    }
    assert len(list(csv.DictReader((page.parent / "results.csv").open()))) == 12
    require_sound(text, page.parent)
    mixed = (
        "{name: m, inputs: [{generator: box, mesh: {edge_length: 0.4}}], runs: {sampling: [vertices, tets]}, fields:"
        " false}"
    )
    study.run(study.parse(mixed), tmp_path / "mixed")
    text = study.write_report(tmp_path / "mixed").read_text()
    assert 'data-scene="0"' not in text and "frames in tets" in text
    require_sound(text, tmp_path / "mixed")
