"""What is used of dask.distributed, which leaves most of it without types."""

from collections.abc import Awaitable, Callable
from typing import Any, Protocol

Described = dict[str, Any]  # a worker, as the scheduler describes it


class Future(Protocol):
    def add_done_callback(self, fn: Callable[["Future"], None]) -> None: ...
    def cancel(self) -> None: ...
    def cancelled(self) -> bool: ...
    def exception(self, timeout: float) -> BaseException | None: ...
    def result(self, timeout: float) -> dict[str, Any]: ...


class Scheduler(Protocol):
    async def identity(self, n_workers: int) -> dict[str, Any]: ...


class Client(Protocol):
    status: str
    scheduler: Scheduler

    def close(self, timeout: float) -> None: ...
    def subscribe_topic(self, topic: str, handler: Callable[[tuple[float, dict[str, Any]]], None]) -> None: ...
    def sync(
        self, func: Callable[[], Awaitable[dict[str, Described]]], callback_timeout: float
    ) -> dict[str, Described]: ...
    def submit(
        self,
        func: Callable[[dict[str, Any]], dict[str, Any]],
        content: dict[str, Any],
        *,
        key: str,
        pure: bool,
        retries: int,
        resources: dict[str, float] | None,
    ) -> Future: ...
