"""What goes wrong round a study ends in a typed error or a record, and the next call goes on from there."""

import json
import resource
import shutil
import sqlite3
import threading

import octafield
import pytest
from octafield import study
from octafield.domain.generators import generate
from octafield.study import digests
from octafield.study.store import Store
from study_fixtures import BODIES, STALLS, table, trap_workers


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    return study.run(study.parse(BODIES), tmp_path_factory.mktemp("sound") / "out").folder


@pytest.fixture
def copy(sound, tmp_path):
    return shutil.copytree(sound, tmp_path / "copy")


def test_a_run_past_the_limit_is_ended_and_recorded_and_retried_on_request(sound, tmp_path, monkeypatch):
    trap_workers(tmp_path, monkeypatch, STALLS)
    outcome = study.run(study.parse(BODIES + "limit: 9\n"), tmp_path / "out", jobs=2)
    assert outcome.status == study.Status(done=2, failed=2, crashed=0, open=0)
    for row in study.rows(outcome.folder):
        late = row["options"]["representation"] == "sh469"
        assert row["state"] == ("failed" if late else "done") and row.get("error_kind", "") == (
            "timed_out" if late else ""
        )
        assert not late or row["message"] == "not finished after 9 s, the study's limit"
    assert study.run(study.parse(BODIES + "limit: 90\n"), outcome.folder).computed == []
    monkeypatch.undo()
    assert len(study.run(study.parse(BODIES), outcome.folder, retry=True).computed) == 2
    assert table(outcome.folder) == table(sound)


def test_a_preparation_past_the_limit_fails_all_its_runs_at_once(tmp_path, monkeypatch):
    trap_workers(
        tmp_path,
        monkeypatch,
        "import time\nimport octafield.fields.frame_field as p\np.prepare_field = lambda *a: time.sleep(60)\n",
    )
    text = BODIES.replace("  - {generator: ball, mesh: {edge_length: 0.4}}\n", "")
    outcome = study.run(study.parse(text + "limit: 1\n"), tmp_path / "out")
    assert outcome.status == study.Status(done=0, failed=2, crashed=0, open=0)
    assert all(
        row["message"].startswith("reading, meshing and the cross field: not finished")
        for row in study.rows(outcome.folder)
    )


def test_inputs_that_change_meanwhile_give_no_record_under_the_old_key(tmp_path, monkeypatch):
    octafield.write_surface(generate("box"), tmp_path / "a.stl")
    octafield.write_surface(generate("ball"), tmp_path / "b.stl")
    described = study.parse("{name: x, inputs: [a.stl, b.stl], mesh: {edge_length: 0.4}}", folder=tmp_path)
    planned = study.plan(described)
    run_study = lambda: study.run(described, tmp_path / "out")
    from octafield.study.running import engine

    def plan_then_change(*arguments, **options):
        found = study.plan(*arguments, **options)
        octafield.write_surface(generate("torus"), tmp_path / "b.stl")
        return found

    monkeypatch.setattr(engine, "plan", plan_then_change)
    with pytest.raises(octafield.InvalidInput, match="b.stl: not there, or changed") as error:
        run_study()
    assert error.value.kind == "input_changed"
    monkeypatch.undo()
    assert {path.name for path in (tmp_path / "out" / "runs").iterdir()} == {planned[0].key}
    outcome = run_study()
    assert outcome.status.done == 2 and planned[1].key not in outcome.computed and len(outcome.computed) == 1


@pytest.mark.parametrize("content", [b"", b"no database at all " * 500, "half", "zeros"])
def test_a_broken_table_is_made_anew_from_the_runs(content, sound, copy):
    path = copy / "runs.sqlite"
    if isinstance(content, bytes):
        path.write_bytes(content)
    else:
        old = path.read_bytes()
        path.write_bytes(old[: len(old) // 2] if content == "half" else old[:4096] + bytes(len(old) - 4096))
    try:
        assert study.status(copy).total == 4
    except octafield.IoError as error:
        assert "makes a broken table anew" in str(error)
    assert study.run(study.parse(BODIES), copy).computed == []
    assert table(copy) == table(sound)
    with sqlite3.connect(path) as db:
        assert db.execute("PRAGMA integrity_check").fetchone() == ("ok",)


def test_runs_whose_record_is_not_whole_or_whose_folder_is_gone_run_again(sound, copy):
    runs = sorted((copy / "runs").iterdir())
    shutil.rmtree(runs[0])
    assert study.run(study.parse(BODIES), copy).computed == [runs[0].name]
    (copy / "runs.sqlite").unlink()
    record = runs[1] / "result.json"
    record.write_text(record.read_text()[:200])
    (runs[2] / "result.json").write_text(json.dumps({"key": "of another", "state": "done"}))
    assert set(study.run(study.parse(BODIES), copy).computed) == {runs[1].name, runs[2].name}
    assert table(copy) == table(sound)


def test_a_run_that_ends_while_a_leader_clears_up_is_whole_or_not_there(copy, monkeypatch):
    """A worker elsewhere renames its folder when the leader has begun to remove it: there would be half a run."""
    run = next((copy / "runs").iterdir())
    partial = run.rename(run.with_name(f".partial-{run.name}-x"))
    remove, refused = shutil.rmtree, []

    def ends_meanwhile(path, **options):
        try:
            partial.rename(run)
        except FileNotFoundError:
            refused.append(path)
        remove(path, **options)

    monkeypatch.setattr("octafield.study.store.shutil.rmtree", ends_meanwhile)
    with Store(copy).led(study.parse(BODIES)):
        pass
    assert refused and not run.exists() and not list((copy / "runs").glob(".*"))


def test_a_full_disk_is_an_error_and_no_record(sound, tmp_path):
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (30_000, hard))  # as a full disk, for large files
    try:
        with pytest.raises(octafield.IoError, match="field.vtu.*has space"):
            study.run(study.parse(BODIES), tmp_path / "out")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert all(row["state"] == "done" for row in study.rows(tmp_path / "out"))
    assert list((tmp_path / "out").rglob(".*")) == []
    study.run(study.parse(BODIES), tmp_path / "out")
    assert table(tmp_path / "out") == table(sound)


def test_a_folder_deleted_meanwhile_is_an_error(tmp_path):
    text = BODIES.replace("sh469", "geodesic, sh469, su2").replace("0.4}", "0.2}")
    strike = lambda what, fraction, merit: fraction == 0 or shutil.rmtree(tmp_path / "out", ignore_errors=True) or True
    with pytest.raises(octafield.IoError):
        study.run(study.parse(text), tmp_path / "out", progress=strike)


def test_whatever_libraries_print_runs_go_on(sound, tmp_path, monkeypatch):
    code = (
        "print('junk'); print('{}'); print('{\"event\": \"finished\", \"key\": 1}', flush=True); os.write(1,"
        " bytes([255, 10]))"
    )
    trap_workers(tmp_path, monkeypatch, code)
    assert study.run(study.parse(BODIES), tmp_path / "out").status.done == 4
    assert table(tmp_path / "out") == table(sound)


def test_a_process_without_memory_is_recorded_as_crashed_with_the_reason(tmp_path, monkeypatch):
    code = (
        "import octafield.fields.frame_field as p\ndef none(*a): raise MemoryError('std::bad_alloc')\n"
        "p.run_field = none\n"
    )
    trap_workers(tmp_path, monkeypatch, code)
    text = "{name: x, inputs: [{generator: box, mesh: {edge_length: 0.5}}]}"
    assert study.run(study.parse(text), tmp_path / "out").status.crashed == 1
    (row,) = study.rows(tmp_path / "out")
    assert "memory ran out, twice" in row["message"]


def test_files_beside_the_caller_named_as_modules_are_no_modules_of_runs(tmp_path, monkeypatch):
    for name in ("json", "queue", "numpy"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit(1)\n")
    monkeypatch.chdir(tmp_path)
    assert study.run(study.parse(BODIES), tmp_path / "out").status.done == 4


def test_a_worker_that_cannot_start_is_recorded(tmp_path, monkeypatch):
    trap_workers(tmp_path, monkeypatch, "os._exit(3)")
    text = "{name: x, inputs: [{generator: box}]}"
    assert study.run(study.parse(text), tmp_path / "out").status.crashed == 1
    assert "exit code 3" in study.rows(tmp_path / "out")[0]["message"]


def test_clocks_may_go_backwards(sound, tmp_path, monkeypatch):
    trap_workers(
        tmp_path,
        monkeypatch,
        "import itertools, time\nback = itertools.count(10**9, -1000)\ntime.time = lambda: float(next(back))\n",
    )
    study.run(study.parse(BODIES), tmp_path / "out")
    assert table(tmp_path / "out") == table(sound)
    told = []
    more = study.parse(BODIES + "seeds: 2\n")
    study.run(more, tmp_path / "out", progress=lambda *what: told.append(what) or True)
    assert told and study.status(tmp_path / "out").done == 8


def test_a_description_edited_meanwhile_counts_from_the_next_call(tmp_path):
    path = tmp_path / "study.yaml"
    path.write_text(BODIES)
    edit = lambda *_: path.write_text(BODIES + "seeds: [5]\n") > 0
    assert study.run(study.load(path), tmp_path / "out", progress=edit).status.total == 4
    assert {run.options.seed for run in study.plan(Store(tmp_path / "out").study())} == {0}


def test_two_leaders_at_once_one_of_them_runs(tmp_path):
    said = []

    def lead():
        try:
            said.append(study.run(study.parse(BODIES), tmp_path / "out").status.done)
        except octafield.InvalidInput as error:
            said.append(error.kind)

    both = [threading.Thread(target=lead) for _ in range(2)]
    for thread in both:
        thread.start()
    for thread in both:
        thread.join()
    assert sorted(map(str, said)) == ["4", "study_is_running"]


def test_progress_tells_what_is_in_work_and_how_much_is_done(tmp_path):
    told = []
    text = BODIES.replace("0.4}", "0.25}").replace("sh469", "geodesic, sh469")
    study.run(
        study.parse(text),
        tmp_path / "out",
        jobs=1,
        progress=lambda what, fraction, merit: told.append((what, fraction)) or True,
    )
    assert any(what.startswith("0 of 6: ball, sh4") for what, _ in told)
    assert {fraction for _, fraction in told} == {k / 6 for k in range(7)}
    assert all(what.startswith(f"{6 * fraction:.0f} of 6: ") for what, fraction in told)


def test_each_of_hundreds_of_inputs_in_one_glob_is_read_once(tmp_path, monkeypatch):
    box = generate("box")
    for k in range(300):
        octafield.write_surface(
            octafield.TriangleMesh(box.vertices * (1 + k / 300), box.triangles), tmp_path / f"b{k:03d}.stl"
        )
    described = study.parse(
        "{name: x, inputs: ['b*.stl'], runs: {representation: [sh4, su2]}, seeds: 10}", folder=tmp_path
    )
    read = []
    monkeypatch.setattr(digests, "digest_of", lambda path, real=digests.digest_of: read.append(path) or real(path))
    runs = study.plan(described)
    assert len({run.key for run in runs}) == 6000 and [run.name for run in runs[::2000]] == ["b000", "b100", "b200"]
    assert len(read) == len(set(read)) == 300
