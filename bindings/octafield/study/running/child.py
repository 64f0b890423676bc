"""A process of worker.py with one group of runs, and the clock that ends it when a run takes too long."""

import contextlib
import json
import math
import os
import subprocess
import threading
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from ...errors import IoError
from ...files.process import reason, start_isolated
from ..plan import Run

WORKERS_LOG = "workers.log"
Event = dict[str, Any]  # see worker.py


@dataclass(frozen=True)
class Ending:
    """How a process ended. code: as of subprocess. late: key of the run that took too long. prepared: whether it had a
    mesh.
    message: its own last words."""

    code: int
    late: str = ""
    prepared: bool = False
    message: str = ""

    def to_json(self) -> dict[str, Any]:
        return asdict(self)

    def told(self) -> str:
        if self.message:
            return f"the process ended: {self.message}"
        if self.code >= 0:
            return f"the process ended with exit code {self.code}; {WORKERS_LOG} may tell why"
        return f"the process was stopped by signal {reason(self.code)}"


class Child:
    """tell(child, event): called from another thread for every event of worker.py; the last is {"event": "ended"}."""

    def __init__(
        self, folder: Path, runs: list[Run], keep_fields: bool, limit: float, tell: Callable[["Child", Event], None]
    ):
        self.runs = list(runs)  # that are not finished, as far as its reader knows
        self._left = [run.key for run in runs]  # the same, as far as it has told
        self._limit, self._tell, self._message = limit, tell, ""
        self._late, self._prepared = "", False
        self._since: float | None = None  # the step in work began; None: it starts, or waits for leave
        reading, writing = os.pipe()  # not stdout, on which anything may print
        try:
            with (folder / WORKERS_LOG).open("a") as log:
                self._process = start_isolated(
                    "octafield.study.running.worker", [str(writing)], str(folder), "its runs are open",
                    {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"},
                    stdin=subprocess.PIPE, stdout=log, stderr=log, pass_fds=(writing,),
                )  # fmt: skip
        except OSError as error:
            os.close(reading)
            if isinstance(error, IoError):
                raise
            raise IoError(f"{folder}: cannot write {WORKERS_LOG} there ({error.strerror})", "cannot_start") from error
        finally:
            os.close(writing)
        self._send(
            json.dumps({"folder": str(folder), "keep_fields": keep_fields, "runs": [run.to_json() for run in runs]})
        )
        threading.Thread(target=self._listen, args=(reading,), daemon=True).start()

    def go(self) -> None:
        """Leave to compute, after "prepared"."""
        self._since = time.monotonic()
        self._send("go")

    @property
    def seconds_to_deadline(self) -> float:
        since = self._since
        return math.inf if since is None or self._late else since + self._limit - time.monotonic()

    def stop_if_late(self) -> None:
        if self.seconds_to_deadline <= 0 and self._left:
            self._late = self._left[0]
            self._process.kill()

    def stop(self) -> None:
        self._process.kill()
        self._process.wait()

    def ending(self) -> Ending:
        """After "ended"."""
        return Ending(self._process.wait(), self._late, self._prepared, self._message)

    def _listen(self, reading: int) -> None:
        with os.fdopen(reading, errors="replace") as lines:
            for line in lines:
                event = _parsed(line)
                if event is None:
                    continue
                if event["event"] == "ready":
                    self._since = time.monotonic()
                elif event["event"] == "prepared":
                    self._since, self._prepared = None, True
                elif event["event"] == "finished":
                    self._since, self._left = time.monotonic(), [key for key in self._left if key != event["key"]]
                elif event["event"] == "broken":
                    self._message = event["message"]
                self._tell(self, event)
        self._since = None
        self._tell(self, {"event": "ended"})

    def _send(self, line: str) -> None:
        with contextlib.suppress(BrokenPipeError):  # it has died; the end of its events tells
            print(line, file=self._process.stdin, flush=True)


def _parsed(line: str) -> Event | None:
    try:
        event = json.loads(line)
    except ValueError:
        return None
    return event if isinstance(event, dict) and "event" in event else None
