"""What the folder of a study holds."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from .plan import Run, plan
from .store import RunRecord, Store


@dataclass(frozen=True)
class Status:
    """How many runs of a study are done, failed (the input or an option is at fault, or the study's limit was passed;
    the record's message says which), crashed (their process died) and open."""

    done: int
    failed: int
    crashed: int
    open: int

    @property
    def total(self) -> int:
        return self.done + self.failed + self.crashed + self.open


def rows(folder: str | Path) -> list[RunRecord]:
    """Records of the finished runs of the study, in the order of its description; state: done, failed or crashed.
    Raises InvalidInput where `folder` is not that of a study.

        >>> from octafield import study
        >>> described = study.parse("{name: one, inputs: [{generator: box}], mesh: {edge_length: 0.4}}")
        >>> outcome = study.run(described, "folder")
        >>> [row.singular_edges for row in study.rows("folder")]
        [0]
    """
    store = Store(folder)
    runs = plan(store.study(), digests=store.digests())
    known = store.entered()
    return [known[run.key] for run in runs if run.key in known]


def status(folder: str | Path) -> Status:
    """Of the study that `folder` holds. Raises InvalidInput where it holds none.

    >>> from octafield import study
    >>> outcome = study.run(study.parse("{name: one, inputs: [{generator: box}], mesh: {edge_length: 0.4}}"), "folder")
    >>> study.status("folder")
    Status(done=1, failed=0, crashed=0, open=0)
    """
    store = Store(folder)
    return status_of(store, plan(store.study(), digests=store.digests()))


def status_of(store: Store, runs: Sequence[Run]) -> Status:
    """Of a study whose plan is known."""
    known = store.states()
    states = [known.get(run.key, "open") for run in runs]
    return Status(*(states.count(state) for state in ("done", "failed", "crashed", "open")))
