"""Studies on a dask scheduler: what dies loses its run only, what finds no worker is told."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import octafield
import pytest
from octafield import study
from study_fixtures import BODIES, STALLS, table, trap_workers

distributed = pytest.importorskip("distributed")
LARGE = """name: one large
inputs:
  - {generator: ball, mesh: {edge_length: 0.12}}
  - {generator: box, mesh: {edge_length: 0.4}}
runs: {representation: [geodesic]}
"""


class Cluster:
    """A scheduler and workers, each a process."""

    def __init__(self, folder: Path):
        self.folder, self.file, self.workers = folder, folder / "scheduler.json", []
        self.start_scheduler()

    def start_scheduler(self) -> None:
        self.file.unlink(missing_ok=True)
        self.scheduler = self._start("scheduler", "--port", "0")
        while not self.file.is_file() or not self.file.stat().st_size:
            time.sleep(0.05)
        self.address = json.loads(self.file.read_text())["address"]

    def start_worker(self, *options: str) -> subprocess.Popen:
        one = ["--nthreads", "1", "--nworkers", "1", "--no-nanny", "--local-directory", self.folder]
        self.workers.append(self._start("worker", *one, *options))
        return self.workers[-1]

    def wait(self, count: int) -> None:
        with distributed.Client(self.address, set_as_default=False) as client:
            client.wait_for_workers(count, timeout=60)

    def _start(self, *words) -> subprocess.Popen:
        command = [sys.executable, "-m", "dask", words[0], "--scheduler-file", self.file, "--no-dashboard", *words[1:]]
        return subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def stop(self) -> None:
        for process in [self.scheduler, *self.workers]:
            process.kill()
            process.wait()


@pytest.fixture
def cluster(tmp_path_factory):
    made = Cluster(tmp_path_factory.mktemp("dask"))
    yield made
    made.stop()


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory) -> Path:
    text = BODIES.replace("sh469]", "sh469, geodesic]")
    return study.run(study.parse(text), tmp_path_factory.mktemp("undisturbed") / "out").folder


@pytest.fixture
def described(tmp_path) -> Path:
    (tmp_path / "study.yaml").write_text(BODIES.replace("sh469]", "sh469, geodesic]"))
    return tmp_path / "study.yaml"


def finished(folder: Path) -> set[str]:
    runs = folder / "runs"
    return {p.name for p in runs.iterdir() if not p.name.startswith(".")} if runs.is_dir() else set()


def test_two_workers_one_killed_lose_and_double_nothing_and_tell_the_leader(undisturbed, described, cluster, tmp_path):
    victim = cluster.start_worker()
    cluster.start_worker()
    cluster.wait(2)
    folder, told = tmp_path / "out", []

    def progress(what, fraction, merit):
        told.append(what)
        if victim.poll() is None and finished(folder):
            victim.send_signal(signal.SIGKILL)
            victim.wait()

    outcome = study.run(study.load(described), folder, scheduler=cluster.address, progress=progress)
    assert victim.poll() is not None and len(outcome.computed) == len(set(outcome.computed)) == 6
    assert table(folder) == table(undisturbed)
    assert any(f"on {os.uname().nodename}" in what for what in told) and told[0].startswith("0 of 6")
    with pytest.raises(octafield.IoError, match="no dask scheduler") as error:
        study.run(study.load(described), folder, scheduler="tcp://127.0.0.1:1")
    assert error.value.kind == "no_scheduler"


def test_a_scheduler_that_dies_is_an_error_and_resume_goes_on_with_the_next(undisturbed, described, cluster, tmp_path):
    cluster.start_worker()
    cluster.wait(1)
    folder = tmp_path / "out"

    def strike(what, fraction, merit):
        if fraction > 0:
            cluster.scheduler.kill()

    with pytest.raises(octafield.IoError, match="does not answer any more") as error:
        study.run(study.load(described), folder, scheduler=cluster.address, progress=strike)
    assert error.value.kind == "no_scheduler"
    kept = finished(folder)
    assert 0 < len(kept) < 6
    cluster.stop()
    cluster.start_scheduler()
    cluster.start_worker()
    outcome = study.run(study.load(described), folder, scheduler=cluster.address)
    assert not kept & set(outcome.computed)
    assert table(folder) == table(undisturbed)


def test_large_meshes_go_where_memory_is_declared_and_else_are_reported(cluster, tmp_path, caplog):
    cluster.start_worker("--resources", "MB=300")
    cluster.wait(1)
    described = study.parse(LARGE)
    with pytest.raises(octafield.IoError, match="no worker has the memory for ball") as error:
        study.run(described, tmp_path / "out", scheduler=cluster.address, patience=6)
    assert error.value.kind == "no_worker" and 'resources "MB=' in str(error.value)
    assert "the largest worker declares 300" in caplog.text
    assert {row["input"] for row in study.rows(tmp_path / "out")} == {"box"}
    cluster.start_worker("--resources", "MB=2000")
    cluster.wait(2)
    assert study.run(described, tmp_path / "out", scheduler=cluster.address, patience=6).status.done == 2


def test_without_workers_a_study_waits_for_as_long_as_told(cluster, tmp_path, caplog):
    with pytest.raises(octafield.IoError, match="no worker for 1 s"):
        study.run(study.parse(BODIES), tmp_path / "out", scheduler=cluster.address, patience=1)
    assert "no worker is connected" in caplog.text


def test_runs_past_the_limit_end_on_workers_too(cluster, tmp_path, monkeypatch):
    trap_workers(tmp_path, monkeypatch, STALLS)
    cluster.start_worker()
    outcome = study.run(study.parse(BODIES + "limit: 9\n"), tmp_path / "out", scheduler=cluster.address)
    assert outcome.status == study.Status(done=2, failed=2, crashed=0, open=0)
    late = [row for row in study.rows(outcome.folder) if row["state"] == "failed"]
    assert {(row["options"]["representation"], row["error_kind"]) for row in late} == {("sh469", "timed_out")}


def test_workers_that_do_not_see_the_folder_are_told(cluster, tmp_path, monkeypatch):
    from octafield.study.running import cluster as module

    with pytest.raises(octafield.IoError, match="does not see this folder"):
        module._carry_out({"version": octafield.__version__, "folder": str(tmp_path / "elsewhere")})
    with pytest.raises(octafield.InvalidInput, match="install one version"):
        module._carry_out({"version": "0.0", "folder": ""})
