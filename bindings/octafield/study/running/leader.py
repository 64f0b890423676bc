"""What is left of a study, and what is said about it: the part that running it here and on a cluster share."""

import itertools
import math
import os
from collections import deque
from dataclasses import dataclass, field

from ...errors import Cancelled, InvalidInput
from ...progress.phases import Progress
from ..description import Study
from ..memory import MeshSizes
from ..plan import Run, groups, mesh_of
from ..store import LOG_FILE, Store, write_failure
from .child import Ending

_ATTEMPTS = 2  # of a run whose process dies


@dataclass(eq=False)
class Group:
    """Runs that share a mesh and cross field and are not finished."""

    runs: list[Run]
    number: int = field(default_factory=itertools.count().__next__)

    def __post_init__(self) -> None:
        self.name = self.runs[0].name

    @property
    def label(self) -> str:
        """Of the run in work."""
        return f"{self.name}, {self.runs[0].options.scheme_name}" if self.runs else self.name


class Leader:
    """The only one that writes the table. pending: groups in the order they are to begin."""

    def __init__(self, store: Store, study: Study, plan: list[Run], retry: bool, progress: Progress | None):
        self.store, self.keep_fields, self.limit = store, study.fields, study.limit or math.inf
        self.total = len(plan)
        self.computed: list[str] = []  # keys
        self.changed: list[str] = []  # messages about inputs
        self._attempts: dict[str, int] = {}  # by key
        self._progress = progress
        self.sizes = MeshSizes()
        entered = self._entered(plan, retry)
        self.done = len(entered)
        self.pending: deque[Group] = deque()
        left = [run for run in plan if run.key not in entered]
        if left:
            self._learn(plan)
        for runs in groups(left):
            self.add(Group(runs))

    def _entered(self, plan: list[Run], retry: bool) -> set[str]:
        """Keys of the plan that need no run: in the table with a folder, or with a folder that a killed leader had not
        entered."""
        states, folders = self.store.states(), self.store.folders()
        again = {
            key
            for key, state in states.items()
            if state == "crashed" or (retry and state == "failed") or key not in folders
        }
        if again:
            self.store.forget(list(again))
        known = set(states) - again
        left_over = [run.key for run in plan if run.key in folders and run.key not in known and run.key not in again]
        known.update(self.store.enter(left_over) if left_over else [])
        return known & {run.key for run in plan}

    def _learn(self, plan: list[Run]) -> None:
        """What finished runs and the files' sizes tell of the tets that others have."""
        known = self.store.tets()
        for run in plan:
            if isinstance(run.source, str) and os.path.exists(run.source):
                self.sizes.saw_file(mesh_of(run), os.path.getsize(run.source))
            if run.key in known:
                self.sizes.saw_tets(mesh_of(run), known[run.key])

    def add(self, group: Group, first: bool = False) -> None:
        """A group to do, or to do again."""
        if first:
            self.pending.appendleft(group)
        else:
            self.pending.append(group)

    def finished(self, group: Group, key: str) -> None:
        """A run has its folder. Told twice it counts once; a folder that is not whole is removed, and its run stays in
        the group."""
        if all(run.key != key for run in group.runs) or not self.store.enter([key]):
            return
        group.runs = [run for run in group.runs if run.key != key]
        self.computed.append(key)
        self.done += 1

    def ended(self, group: Group, ending: Ending) -> bool:
        """The process that had the group has ended. Whether something is left of it."""
        self.collect(group)
        late = group.runs if not ending.prepared else group.runs[:1]
        if group.runs and ending.late and (not ending.prepared or ending.late == group.runs[0].key):
            step = "" if ending.prepared else "reading, meshing and the cross field: "
            for run in list(late):
                self._without_result(
                    group, run, "failed", f"{step}not finished after {self.limit:g} s, the study's limit", "timed_out"
                )
        elif group.runs and not ending.late:
            self._count_attempt(group, ending.told())
        return bool(group.runs)

    def collect(self, group: Group) -> None:
        """Enters runs whose process or machine died between their end and its message."""
        for run in list(group.runs):
            if self.store.is_finished(run.key):
                self.finished(group, run.key)

    def _count_attempt(self, group: Group, message: str) -> None:
        first = group.runs[0]
        self._attempts[first.key] = self._attempts.get(first.key, 0) + 1
        if self._attempts[first.key] >= _ATTEMPTS:
            self.crashed(group, f"{message}, twice")

    def crashed(self, group: Group, message: str) -> None:
        """Of its first run."""
        self._without_result(group, group.runs[0], "crashed", message)

    def _without_result(self, group: Group, run: Run, state: str, message: str, kind: str = "") -> None:
        with self.store.new_run(run) as folder:
            (folder / LOG_FILE).write_text(message + "\n", encoding="utf-8")
            about = {"error": "SolverError", "error_kind": kind} if kind else {}
            write_failure(folder, run, state, message, **about)
        self.finished(group, run.key)

    def input_changed(self, group: Group, message: str) -> None:
        """Its runs stay open."""
        if message not in self.changed:
            self.changed.append(message)
        group.runs = []

    def require_unchanged(self) -> None:
        """After everything else is done."""
        if self.changed:
            more = f" (and {len(self.changed) - 3} more inputs)" if len(self.changed) > 3 else ""
            raise InvalidInput(
                f"{'; '.join(self.changed[:3])}{more}. Their runs are open; run the study again", "input_changed"
            )

    def tell(self, what: str) -> None:
        if self._progress is None:
            return
        answer = self._progress(f"{self.done} of {self.total}: {what}", self.done / self.total, math.nan)
        if answer is not None and not answer:
            raise Cancelled(f"cancelled after {self.done} of {self.total} runs")
