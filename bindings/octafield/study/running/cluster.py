"""Runs a study on the workers of a dask scheduler.

Each task carries out one group in a process of its own beside the dask worker, which writes finished runs into the
folder of the study; all machines see that under one path. The leader enters them into its table. A process or a worker
that dies loses the run it was in: the group goes to another, which goes on after the last finished one.

Workers that declare a resource MB get groups whose expected memory fits beside what they have in work. How large a mesh
is shows once it is made; a group that needs more than it was sent with comes back and is sent where there is enough.
"""

import contextlib
import logging
import math
import os
import queue
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from ...errors import Error, InvalidInput, IoError
from ...progress.phases import octafield_version
from ..memory import needed_mb
from ..plan import Run, mesh_of
from .child import Child, Ending, Event
from .dask_types import Client, Described, Future
from .leader import Group, Leader

if TYPE_CHECKING:
    from distributed import Worker

_RESOURCE = "MB"
_LEAST_TETS = 200_000  # that a group is first sent with memory for
_ALLOWED_DEATHS = 3  # of workers with the same group, before its run counts as crashed; dask's default
_LOOK_EVERY = 5.0  # seconds between looks at the scheduler
_SCHEDULER_GONE = 20.0  # seconds without a connection

_log = logging.getLogger("octafield")


def run_on_cluster(leader: Leader, scheduler: str, patience: float) -> None:
    """Raises IoError where the scheduler cannot be reached, is gone, or has no worker for what is left after `patience`
    seconds; InvalidInput where dask is not installed."""
    try:
        import distributed
    except ImportError as error:
        raise InvalidInput("dask.distributed is not installed; pip install octafield[cluster]", "no_dask") from error
    with _silent(logging.getLogger("distributed")):
        _lead(cast("Callable[..., Client]", distributed.Client), leader, scheduler, patience)


@contextlib.contextmanager
def _silent(logger: logging.Logger) -> Iterator[None]:
    """Lost connections are told by our own errors."""
    level = logger.level
    logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        logger.setLevel(level)


def _lead(connect: Callable[..., Client], leader: Leader, scheduler: str, patience: float) -> None:
    try:
        client = connect(scheduler, timeout=10, set_as_default=False)
    except (OSError, ValueError) as error:
        raise IoError(f"{scheduler}: no dask scheduler answers there ({error})", "no_scheduler") from error
    try:
        _Cluster(leader, client, scheduler, patience).run()
    finally:
        with contextlib.suppress(Exception):  # of a scheduler that is gone
            client.close(timeout=2)


class _Cluster:
    def __init__(self, leader: Leader, client: Client, scheduler: str, patience: float):
        self.leader, self.client, self.scheduler, self.patience = leader, client, scheduler, patience
        self.topic = f"octafield-{os.uname().nodename}-{os.getpid()}-{time.monotonic_ns()}"
        self.events: queue.SimpleQueue[Event] = queue.SimpleQueue()
        self.groups: dict[int, tuple[Group, float]] = {}  # sent, with the megabytes they need
        self.futures: dict[int, Future] = {}
        self.sent = 0
        self.connected = self.useful = time.monotonic()  # last time that it was so
        self.warned: set[str] = set()

    def run(self) -> None:
        self.client.subscribe_topic(self.topic, lambda event: self.events.put(event[1]))
        looked = -math.inf
        workers: list[Described] = []
        while self.leader.pending or self.groups:
            if time.monotonic() - looked >= _LOOK_EVERY:
                workers, looked = self._look(), time.monotonic()
            while workers and self.leader.pending:
                self._send(self.leader.pending.popleft(), workers)
            with contextlib.suppress(queue.Empty):
                self._on(self.events.get(timeout=1.0))

    def _look(self) -> list[Described]:
        """Workers of the scheduler. Raises where it has been gone, or has had no worker for what is left, for too
        long."""
        now = time.monotonic()
        workers = None
        if self.client.status == "running":
            with contextlib.suppress(OSError, RuntimeError):
                workers = list(self.client.sync(self._workers, callback_timeout=_SCHEDULER_GONE).values())
        if workers is None:
            if now - self.connected >= _SCHEDULER_GONE:
                self._scheduler_gone()
            return []
        self.connected = now
        largest = _largest_mb(workers)
        too_large = [group for group, need in self.groups.values() if need > largest]
        if not workers:
            self._warn(f"{self.scheduler}: no worker is connected; waiting for one")
        for group in too_large if workers else ():
            need = self.groups[group.number][1]
            self._warn(
                f"{group.label}: needs {need:,.0f} MB, the largest worker declares {largest:,.0f}; waiting for another"
            )
        if workers and (self.leader.pending or len(too_large) < len(self.groups)):
            self.useful = now
        elif now - self.useful >= self.patience:
            self._no_worker(workers, too_large, largest)
        return workers

    async def _workers(self) -> dict[str, Described]:
        known: dict[str, Described] = (await self.client.scheduler.identity(n_workers=-1))["workers"]
        return known

    def _no_worker(self, workers: list[Described], too_large: list[Group], largest: float) -> None:
        for future in self.futures.values():
            future.cancel()
        if not workers:
            raise IoError(
                f"{self.scheduler}: no worker for {self.patience:g} s; start one (dask worker {self.scheduler}) and"
                " resume the study",
                "no_worker",
            )
        names = ", ".join(dict.fromkeys(group.runs[0].name for group in too_large))
        need = max(self.groups[group.number][1] for group in too_large)
        raise IoError(
            f"{self.scheduler}: no worker has the memory for {names}: up to {need:,.0f} MB, the largest declares "
            f"{largest:,.0f}; "
            f"start one (dask worker {self.scheduler} --resources \"{_RESOURCE}={need:.0f}\") and resume the study",
            "no_worker",
        )  # fmt: skip

    def _scheduler_gone(self) -> None:
        raise IoError(
            f"{self.scheduler}: the dask scheduler does not answer any more; start it and its workers again and resume"
            " the study",
            "no_scheduler",
        )

    def _warn(self, message: str) -> None:
        if message not in self.warned:
            self.warned.add(message)
            _log.warning("%s", message)

    def _send(self, group: Group, workers: list[Described]) -> None:
        tets = self.leader.sizes.tets(mesh_of(group.runs[0]))
        if self.leader.sizes.knows(mesh_of(group.runs[0])):
            mb = needed_mb(tets, group.runs)
        else:
            mb = min(needed_mb(max(tets, _LEAST_TETS), group.runs), _largest_mb(workers))
        declared = _largest_mb(workers) < math.inf
        self.sent += 1
        content = {
            "folder": str(self.leader.store.folder), "runs": [run.to_json() for run in group.runs],
            "keep_fields": self.leader.keep_fields,
            "limit": self.leader.limit, "mb": mb if declared else math.inf, "topic": self.topic, "group": group.number,
            "version": octafield_version(),
        }  # fmt: skip
        future = self.client.submit(
            _carry_out, content, key=f"{self.topic}-{group.number}-{self.sent}", pure=False, retries=0,
            resources={_RESOURCE: mb} if declared else None,
        )  # fmt: skip
        self.groups[group.number], self.futures[group.number] = (group, mb if declared else 0.0), future
        future.add_done_callback(
            lambda done: self.events.put({"event": "returned", "group": group.number, "future": done})
        )

    def _on(self, event: Event) -> None:
        group, _ = self.groups.get(event["group"], (None, 0))
        if group is None:
            return
        kind = event["event"]
        if kind == "returned":
            if event["future"] is self.futures[group.number]:
                self._on_returned(group, event["future"])
        elif kind == "prepared":
            self.leader.sizes.saw_tets(mesh_of(group.runs[0]), event["tets"])
        elif kind == "finished":
            self.leader.finished(group, event["key"])
        if kind in ("progress", "finished"):
            self.leader.tell(
                f"{group.label} on {event['host']}" + (f": {event['phase']}" if kind == "progress" else "")
            )

    def _on_returned(self, group: Group, future: Future) -> None:
        from distributed import KilledWorker

        del self.groups[group.number], self.futures[group.number]
        if future.cancelled():
            self._scheduler_gone()
        error = future.exception(timeout=_SCHEDULER_GONE)
        if isinstance(error, KilledWorker):
            self.leader.collect(group)
            if group.runs:
                self.leader.crashed(group, f"workers that had this run died {_ALLOWED_DEATHS} times")
        elif error is not None:
            raise (
                error
                if isinstance(error, Error)
                else IoError(
                    f"{self.scheduler}: a worker cannot run octafield ({type(error).__name__}: {error})", "bad_worker"
                )
            )
        else:
            self._settle(group, future.result(timeout=_SCHEDULER_GONE))
        if group.runs:
            self.leader.add(group, first=True)

    def _settle(self, group: Group, answer: dict[str, Any]) -> None:
        if answer["changed"]:
            self.leader.input_changed(group, answer["changed"])
        elif answer["tets"]:  # come back for more memory; sizes know how many now
            self.leader.sizes.saw_tets(mesh_of(group.runs[0]), answer["tets"])
        else:
            self.leader.ended(group, Ending(**answer["ending"]))


def _largest_mb(workers: list[Described]) -> float:
    """That a worker declares; infinite where none declares any."""
    declared = [worker["resources"][_RESOURCE] for worker in workers if _RESOURCE in (worker.get("resources") or {})]
    return max(declared, default=math.inf)


def _carry_out(content: dict[str, Any]) -> dict[str, Any]:
    """On the worker. How it ended: {"ending": of the process, "changed": message of an input, "tets": needs memory for
    so many}."""
    from distributed import get_worker

    if content["version"] != octafield_version():
        raise InvalidInput(
            f"a worker has octafield {octafield_version()}, the leader {content['version']}; install one version"
            " everywhere",
            "bad_worker",
        )
    folder = Path(content["folder"])
    if not (folder / "runs").is_dir():
        raise IoError(
            f"{folder}: a worker does not see this folder; all machines need it under the same path", "bad_worker"
        )
    return _Task(content, get_worker()).run(folder)


class _Task:
    def __init__(self, content: dict[str, Any], worker: "Worker"):
        self.content, self.worker = content, worker
        self.key = worker.get_current_task()
        self.runs = [Run.from_json(run) for run in content["runs"]]
        self.events: queue.SimpleQueue[Event] = queue.SimpleQueue()

    def run(self, folder: Path) -> dict[str, Any]:
        answer: dict[str, Any] = {"ending": None, "changed": "", "tets": 0}
        child = Child(
            folder,
            self.runs,
            self.content["keep_fields"],
            self.content["limit"],
            lambda _, event: self.events.put(event),
        )
        try:
            while True:
                child.stop_if_late()
                if not self._wanted():
                    raise IoError("the leader of the study has gone", "cancelled")
                try:
                    event = self.events.get(timeout=min(max(child.seconds_to_deadline, 0.01), 2.0))
                except queue.Empty:
                    continue
                if event["event"] == "ended":
                    return answer | {"ending": child.ending().to_json()}
                if event["event"] == "unwritable":
                    raise IoError(event["message"], "cannot_write")
                if event["event"] == "changed":
                    return answer | {"changed": event["message"]}
                if event["event"] == "prepared":
                    if needed_mb(event["tets"], self.runs) > self.content["mb"]:
                        return answer | {"tets": event["tets"]}
                    child.go()
                self._tell(event)
        finally:
            child.stop()

    def _tell(self, event: Event) -> None:
        self.worker.log_event(
            self.content["topic"], {**event, "group": self.content["group"], "host": os.uname().nodename}
        )

    def _wanted(self) -> bool:
        """Whether the scheduler still asks for this task: a leader that is killed takes its tasks back."""
        task = self.worker.state.tasks.get(self.key)
        return task is not None and task.state != "cancelled"
