"""Computes parts of jobs in the worker pool, from threads; retries a part whose process dies, up to a deadline."""

import asyncio
import time
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from typing import Any

from gelenk.errors import DeadlineExceeded, ServiceStopping, WorkerCrashed
from gelenk.pool.pool import WorkerPool

ATTEMPTS = 3
"""Number of times to start a part whose process dies: the part may not be the cause."""
DIED = f"its process died {ATTEMPTS} times, the limit; possibly out of memory"


class Cancelled(Exception):
    """The result is no longer wanted."""


class OutOfTime(Exception):
    """The result was not ready before the deadline."""


class Unavailable(Exception):
    """No process can compute the part now, through no fault of the part: it may be submitted again."""


class PoolExecutor:
    """Computes parts in a pool's background processes; safe in all threads except that of the pool's event loop."""

    failure = None
    """Always None: unlike a cluster, the pool is always available."""

    def __init__(self, pool: WorkerPool) -> None:
        self._pool = pool
        self._loop: asyncio.AbstractEventLoop | None = None

    def start(self) -> None:
        """Store the running event loop, which must be the pool's."""
        self._loop = asyncio.get_running_loop()

    @property
    def count(self) -> int:
        """Number of parts computed at the same time."""
        return self._pool.background.turns.size

    def prepare(self) -> None:
        """Do nothing: the first part starts the processes."""

    def submit(self, function: Callable[[Any], Any], argument: Any, until: float) -> "Future[Any]":
        """Submit a part with a deadline on the clock of `time.monotonic`, [s]; cancelling the future cancels the part.

        The function is module-level; its argument and result can be pickled. The future's exception is the function's,
        `Cancelled`, `OutOfTime`, or ChildProcessError if the process died `ATTEMPTS` times. During shutdown,
        `Cancelled` is raised at once.
        """
        if self._loop is None or self._loop.is_closed():
            raise Cancelled
        return asyncio.run_coroutine_threadsafe(self._compute(function, argument, until), self._loop)

    def close(self) -> None:
        """Close the pool, which stops all parts."""
        if self._loop is not None and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._pool.close)

    async def _compute(self, function: Callable[[Any], Any], argument: Any, until: float) -> Any:
        try:
            async with asyncio.timeout(until - time.monotonic()):
                for _ in range(ATTEMPTS):
                    with suppress(WorkerCrashed):
                        return await self._pool.run_in_background(function, argument, until - time.monotonic())
        except (TimeoutError, DeadlineExceeded):
            raise OutOfTime from None
        except ServiceStopping:
            raise Cancelled from None
        raise ChildProcessError(DIED)
