"""Runs a study on the workers of a dask scheduler.

Workers write finished runs into the folder of the study themselves, which all machines see under one path; the leader enters
them into its table. A worker that dies loses the run it was in: dask gives the group to another, which goes on after the last finished one.
"""

from ..errors import InvalidInput, IoError
from .plan import Run
from .store import Store
from .worker import execute

_ALLOWED_DEATHS = 3  # of workers with the same group, before its run counts as crashed


def run_on_cluster(leader, scheduler: str) -> None:
    """`leader`: engine.py. Raises IoError where the scheduler cannot be reached, InvalidInput where dask is not installed."""
    try:
        from distributed import Client, KilledWorker, as_completed
    except ImportError as error:
        raise InvalidInput("dask.distributed is not installed; pip install octafield[cluster]", "no_dask") from error
    try:
        client = Client(scheduler, timeout=10)
    except (OSError, ValueError) as error:
        raise IoError(f"{scheduler}: no dask scheduler answers there ({error})") from error
    with client:
        folder, keep = str(leader.store.folder), leader.keep_fields
        submit = lambda group: client.submit(
            _group, folder, [run.to_json() for run in group], keep, key=f"octafield-{group[0].key}-{len(group)}", retries=0
        )
        futures = {submit(group): group for group in leader.pending}
        completed = as_completed(futures)
        for future in completed:
            group = futures[future]
            _enter_finished(leader, group)
            rest = [run for run in group if not leader.store.is_finished(run.key)]
            if not rest:
                leader.tell(group[0].name)
                continue
            error = future.exception()
            if not isinstance(error, KilledWorker):
                raise error if error else IoError(f"{folder}: workers do not see this folder")
            leader.crashed(rest[0], f"workers that had this run died {_ALLOWED_DEATHS} times")
            if rest[1:]:
                again = submit(rest[1:])
                futures[again] = rest[1:]
                completed.add(again)


def _enter_finished(leader, group: list[Run]) -> None:
    known = set(leader.computed)
    leader.finished([run.key for run in group if run.key not in known and leader.store.is_finished(run.key)])


def _group(folder: str, runs: list[dict], keep_fields: bool) -> None:
    execute(Store(folder), [Run.from_json(run) for run in runs], keep_fields, lambda tets: None, lambda key: None)
