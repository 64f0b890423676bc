"""Runs a study on this machine: one process per group of runs that share a mesh, as many at once as cores and memory
allow.

A crash or a kill of such a process costs the run it was in, which is tried once more; the others go on.
"""

import math
import os
import queue
from dataclasses import dataclass
from pathlib import Path

from ...errors import InvalidInput, IoError
from ...options import LARGEST_INT, integer_in
from ...progress.phases import Progress
from ..description import Study
from ..finished_runs import Status, status_of
from ..memory import needed_mb
from ..plan import plan
from ..store import Store
from .child import Child, Event
from .leader import Group, Leader

PATIENCE = 300.0


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
    patience: float = PATIENCE,
    retry: bool = False,
    progress: Progress | None = None,
) -> Outcome:
    """Carries out what `folder` does not hold yet. Killed at any moment, it goes on from there when called again.

    jobs: processes at once (0: one per core). threads: of each run; results do not depend on it. memory_mb: that all
    processes together may be expected to need (0: four fifths of the machine's). scheduler: address of a dask
    scheduler, whose workers see `folder` and the inputs under the same paths, in place of this machine; patience:
    seconds to wait for a worker that can take what is left. retry: runs that failed are tried again. progress: called
    with what is done and what is in work, as one text, and the fraction of runs done. Raises
    InvalidInput (also for a folder of something else, and for inputs that changed meanwhile: their runs stay open),
    IoError, Cancelled.
    """
    jobs = integer_in("jobs", jobs, 0, LARGEST_INT) or len(os.sched_getaffinity(0))
    threads = integer_in("threads", threads, 0, LARGEST_INT)
    for name, value in (("memory_mb", memory_mb), ("patience", patience)):
        if not value >= 0:
            raise InvalidInput(f"{name} must not be negative, not {value!r}", "option_out_of_range")
    store = Store(folder)
    digests = store.digests()
    runs = plan(study, threads=threads, digests=digests)
    with store.led(study):
        store.keep(digests)
        leader = Leader(store, study, runs, retry, progress)
        if scheduler:
            from .cluster import run_on_cluster

            run_on_cluster(leader, scheduler, patience)
        elif leader.pending:
            _Local(leader, jobs, memory_mb or 0.8 * _machine_mb()).run()
        leader.require_unchanged()
        return Outcome(status_of(store, runs), leader.computed, store.folder)


@dataclass(eq=False)
class _Job:
    group: Group
    child: Child
    memory_mb: float
    waits: bool = False  # for leave to begin


class _Local:
    def __init__(self, leader: Leader, jobs: int, memory_mb: float):
        self.leader, self.slots, self.memory_mb = leader, jobs, memory_mb
        self.events: queue.SimpleQueue[tuple[Child, Event]] = queue.SimpleQueue()
        self.active: dict[Child, _Job] = {}

    def run(self) -> None:
        try:
            while self.leader.pending or self.active:
                self._start_jobs()
                try:
                    child, event = self.events.get(timeout=self._seconds_to_deadline())
                    if child in self.active:
                        getattr(self, f"_on_{event['event']}")(self.active[child], event)
                except queue.Empty:
                    pass
                for child in self.active:
                    child.stop_if_late()
        finally:
            for child in self.active:
                child.stop()

    def _seconds_to_deadline(self) -> float | None:
        seconds = min((child.seconds_to_deadline for child in self.active), default=math.inf)
        return None if seconds == math.inf else max(seconds, 0.0)

    def _start_jobs(self) -> None:
        jobs = self.active.values()
        while self.leader.pending and len(jobs) < self.slots and not any(job.waits for job in jobs):
            self._start(self.leader.pending.popleft())
        for job in jobs:
            fits = sum(other.memory_mb for other in jobs if not other.waits) + job.memory_mb <= self.memory_mb
            if job.waits and (fits or all(other.waits for other in jobs)):
                job.waits = False
                job.child.go()

    def _start(self, group: Group) -> None:
        leader = self.leader
        child = Child(
            leader.store.folder,
            group.runs,
            leader.keep_fields,
            leader.limit,
            lambda child, event: self.events.put((child, event)),
        )
        self.active[child] = _Job(group, child, needed_mb(0, group.runs))

    def _on_ready(self, job: _Job, _event: Event) -> None:
        pass  # the child's clock begins

    def _on_prepared(self, job: _Job, event: Event) -> None:
        job.memory_mb, job.waits = needed_mb(event["tets"], job.group.runs), True

    def _on_progress(self, job: _Job, event: Event) -> None:
        self.leader.tell(f"{job.group.label}: {event['phase']}")

    def _on_finished(self, job: _Job, event: Event) -> None:
        self.leader.finished(job.group, event["key"])
        self.leader.tell(job.group.label)

    def _on_changed(self, job: _Job, event: Event) -> None:
        self.leader.input_changed(job.group, event["message"])

    def _on_unwritable(self, job: _Job, event: Event) -> None:
        raise IoError(event["message"], "cannot_write")

    def _on_broken(self, job: _Job, _event: Event) -> None:
        pass  # the child keeps the words for its end

    def _on_ended(self, job: _Job, _event: Event) -> None:
        del self.active[job.child]
        if self.leader.ended(job.group, job.child.ending()):
            self.leader.add(job.group, first=True)


def _machine_mb() -> float:
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e6
