"""Runs a study on this machine: one process per group of runs that share a mesh, as many at once as cores and memory allow.

A crash or a kill of such a process costs the run it was in, which is tried once more; the others go on.
"""

import json
import os
import queue
import signal
import subprocess
import sys
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import Cancelled, InvalidInput
from ..options import LARGEST_INT, integer_in
from ..phases import Progress
from .description import Study
from .plan import Run, groups, plan
from .results import Status, status
from .store import LOG_FILE, Store, write_record

_ATTEMPTS = 2  # of a run whose process dies


@dataclass(frozen=True)
class Outcome:
    """status: of the whole study afterwards. computed: keys of the runs this call carried out. folder: of the study."""

    status: Status
    computed: list[str]
    folder: Path


def run(
    study: Study,
    folder: str | Path,
    *,
    jobs: int = 0,
    threads: int = 1,
    memory_mb: float = 0,
    scheduler: str = "",
    retry: bool = False,
    progress: Progress | None = None,
) -> Outcome:
    """Carries out what `folder` does not hold yet. Killed at any moment, it goes on from there when called again.

    jobs: processes at once (0: one per core). threads: of each run; results do not depend on it. memory_mb: that all
    processes together may be expected to need (0: four fifths of the machine's). scheduler: address of a dask scheduler,
    whose workers see `folder` and the inputs under the same paths, in place of this machine. retry: runs that failed are tried again.
    Raises InvalidInput (also for a folder of something else), IoError, Cancelled.
    """
    jobs = integer_in("jobs", jobs, 0, LARGEST_INT) or len(os.sched_getaffinity(0))
    runs = plan(study, threads=integer_in("threads", threads, 0, LARGEST_INT))
    if not memory_mb >= 0:
        raise InvalidInput(f"memory_mb must not be negative, not {memory_mb!r}", "option_out_of_range")
    store = Store(folder)
    with store.led(study):
        known = store.entered()
        stale = [key for key, r in known.items() if r["state"] == "crashed" or (retry and r["state"] == "failed")]
        store.forget(stale)
        entered = set(known) - set(stale)
        left_over = [r.key for r in runs if r.key not in entered and store.is_finished(r.key)]
        store.enter(left_over)
        entered.update(left_over)
        pending = groups([r for r in runs if r.key not in entered])
        leader = _Leader(store, pending, study.fields, len(runs), len(entered & {r.key for r in runs}), progress)
        if scheduler:
            from .cluster import run_on_cluster

            run_on_cluster(leader, scheduler)
        elif pending:
            _Local(leader, jobs, memory_mb or 0.8 * _machine_mb()).run()
    return Outcome(status(store.folder), leader.computed, store.folder)


class _Leader:
    """What is left to do, and what is said about it; the only one that writes the table."""

    def __init__(self, store: Store, pending: list[list[Run]], keep_fields: bool, total: int, done: int, progress: Progress | None):
        self.store, self.pending, self.keep_fields = store, pending, keep_fields
        self.total, self.done, self.progress = total, done, progress
        self.computed: list[str] = []

    def finished(self, keys: Sequence[str]) -> None:
        self.store.enter(list(keys))
        self.computed += keys
        self.done += len(keys)

    def crashed(self, run: Run, message: str) -> None:
        with self.store.new_run(run) as folder:
            (folder / LOG_FILE).write_text(message + "\n", encoding="utf-8")
            write_record(folder, run, {}, "crashed", message)
        self.finished([run.key])

    def tell(self, what: str) -> None:
        if self.progress is None:
            return
        answer = self.progress(f"{self.done} of {self.total}: {what}", self.done / self.total, float("nan"))
        if answer is not None and not answer:
            raise Cancelled(f"cancelled after {self.done} of {self.total} runs")


@dataclass
class _Job:
    runs: list[Run]
    process: subprocess.Popen
    memory_mb: float
    tets: int = 0
    waits: bool = False  # for leave to begin


class _Local:
    def __init__(self, leader: _Leader, jobs: int, memory_mb: float):
        self.leader, self.slots, self.memory_mb = leader, jobs, memory_mb
        self.events: queue.SimpleQueue = queue.SimpleQueue()
        self.active: list[_Job] = []
        self.attempts: dict[str, int] = {}

    def run(self) -> None:
        try:
            while self.leader.pending or self.active:
                self._start_jobs()
                job, event = self.events.get()
                getattr(self, f"_on_{event['event']}")(job, event)
        finally:
            for job in self.active:
                job.process.kill()
                job.process.wait()

    def _start_jobs(self) -> None:
        while self.leader.pending and len(self.active) < self.slots and not any(job.waits for job in self.active):
            self._start(self.leader.pending.pop(0))
        for job in self.active:
            fits = sum(other.memory_mb for other in self.active if not other.waits) + job.memory_mb <= self.memory_mb
            if job.waits and (fits or all(other.waits for other in self.active)):
                job.waits = False
                _send(job, "go")

    def _start(self, runs: list[Run]) -> None:
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
        log = self.leader.store.folder / "workers.log"
        with log.open("a") as errors:
            process = subprocess.Popen(
                [sys.executable, "-m", "octafield.study.worker"],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=errors, text=True, env=environment,
            )  # fmt: skip
        job = _Job(runs, process, needed_mb(0, runs))
        self.active.append(job)
        content = {"folder": str(self.leader.store.folder), "keep_fields": self.leader.keep_fields}
        _send(job, json.dumps({**content, "runs": [run.to_json() for run in runs]}))
        threading.Thread(target=self._listen, args=(job,), daemon=True).start()

    def _listen(self, job: _Job) -> None:
        for line in job.process.stdout:
            self.events.put((job, json.loads(line)))
        self.events.put((job, {"event": "ended"}))

    def _on_prepared(self, job: _Job, event: dict) -> None:
        job.tets, job.memory_mb, job.waits = event["tets"], needed_mb(event["tets"], job.runs), True

    def _on_progress(self, job: _Job, event: dict) -> None:
        self.leader.tell(f"{_label(job.runs[0])}: {event['phase']}")

    def _on_finished(self, job: _Job, event: dict) -> None:
        self.leader.finished([event["key"]])
        job.runs = [run for run in job.runs if run.key != event["key"]]
        self.leader.tell(_label(job.runs[0]) if job.runs else "")

    def _on_ended(self, job: _Job, _event: dict) -> None:
        self.active.remove(job)
        code = job.process.wait()
        if not job.runs:
            return
        first = job.runs[0]
        if self.leader.store.is_finished(first.key):  # it died between the run's end and its message
            self.leader.finished([first.key])
            job.runs = job.runs[1:]
        else:
            self.attempts[first.key] = self.attempts.get(first.key, 0) + 1
            if self.attempts[first.key] == _ATTEMPTS:
                self.leader.crashed(first, _ending(code))
                job.runs = job.runs[1:]
        if job.runs:
            self.leader.pending.insert(0, job.runs)


def needed_mb(tets: int, runs: list[Run]) -> float:
    """Peak memory to expect of a process that carries out `runs` on so many tets. Measured on 1.36 million tets (HexMe's i16c):
    sh4 690, sh469 880, geodesic 3,540, su2_midpoint 4,000."""
    by_ceres = any(run.options.solver in ("levenberg_marquardt", "lbfgs") or _is_metric(run) for run in runs)
    return 250 + tets * (3.5e-3 if by_ceres else 5e-4)


def _is_metric(run: Run) -> bool:
    from .. import _core

    return run.options.representation not in _core.representations


def _label(run: Run) -> str:
    return f"{run.name}, {run.options.representation}"


def _send(job: _Job, line: str) -> None:
    try:
        job.process.stdin.write(line + "\n")
        job.process.stdin.flush()
    except BrokenPipeError:
        pass  # it has died; the end of its output tells


def _ending(code: int) -> str:
    if code >= 0:
        return f"the process ended with exit code {code}; workers.log may tell why"
    name = signal.Signals(-code).name
    why = "most likely memory ran out" if name == "SIGKILL" else "a defect of octafield: please report this input"
    return f"the process was stopped by signal {name}, twice; {why}"


def _machine_mb() -> float:
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e6
