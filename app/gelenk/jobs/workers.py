"""Parts of jobs for the worker pool, from threads: tried again where their process dies, ended when time is up."""

import asyncio
import time
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from typing import Any

from gelenk.errors import DeadlineExceeded, ServiceStopping, WorkerCrashed
from gelenk.pool.pool import WorkerPool

ATTEMPTS = 3
"""How often to start a part whose process dies, which may not be the part's fault."""
DIED = f"its process died {ATTEMPTS} times, the limit; possibly out of memory"


class Cancelled(Exception):
    """The result is no longer wanted."""


class OutOfTime(Exception):
    """The result was not ready before the deadline."""


class Unavailable(Exception):
    """No process can compute the part now, through no fault of the part: it may be submitted again."""


class PoolExecutor:
    """Computes parts in the background of a pool; safe to use from many threads, but not from its event loop's.

    Args:
        pool: The processes.
    """

    failure = None
    """They are always there."""

    def __init__(self, pool: WorkerPool) -> None:
        self._pool = pool
        self._loop: asyncio.AbstractEventLoop | None = None

    def start(self) -> None:
        """Learn the event loop of the pool, which is the running one."""
        self._loop = asyncio.get_running_loop()

    @property
    def count(self) -> int:
        """Parts computed at a time."""
        return self._pool.background.turns.size

    def prepare(self) -> None:
        """The first part starts the processes."""

    def submit(self, function: Callable[[Any], Any], argument: Any, until: float) -> "Future[Any]":
        """Have a part computed; cancelling the future ends it.

        Args:
            function: Of a module, with an argument and a result that can be sent to another process.
            argument: What it is called with.
            until: When it is given up, on the clock of `time.monotonic`, [s].

        Returns:
            Future of the function's result. Its exception is the function's, `Cancelled`, `OutOfTime`, or
            ChildProcessError if the process died `ATTEMPTS` times.

        Raises:
            Cancelled: The service is shutting down.
        """
        if self._loop is None or self._loop.is_closed():
            raise Cancelled
        return asyncio.run_coroutine_threadsafe(self._compute(function, argument, until), self._loop)

    def close(self) -> None:
        """End all parts, and the pool with them."""
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
