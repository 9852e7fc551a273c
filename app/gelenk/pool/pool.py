"""Pool of worker processes that run the calls of an event loop, each call with a deadline.

If a call crashes its process, misses its deadline or is abandoned, only its own process ends. A new one starts within
milliseconds, because it is forked from a process that has everything loaded. If other clients occupy all processes, a
new client gets an additional one just as fast. Parts of jobs run in separate processes of lower priority.
"""

import math
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any, TypeVar

from gelenk.errors import ServiceBusy
from gelenk.pool.worker import Priority
from gelenk.pool.workers import Workers

_Argument = TypeVar("_Argument")
_Result = TypeVar("_Result")

REQUEST = Priority("crew", niceness=5, grace_seconds=0.05)
"""A client waits for the result. Letting an abandoned call finish briefly is cheaper than starting a new process."""
BACKGROUND = Priority("jobs", niceness=10, grace_seconds=1.0, idle_seconds=300.0)
"""Parts of jobs: no client waits for an individual part."""

_CROWD_SECONDS = 10.0
"""Longest time over which to spread the retries of refused calls, [s]; limited because many clients never retry."""
_START_SECONDS = 600.0
"""Extra time that calls may wait while the first processes start, [s]: kernels may have to be compiled."""


class WorkerPool:
    """Pool of processes that run calls; use each pool in one event loop only.

    Args:
        count: Number of processes for requests; `Turns` explains when there are more.
        waiting: Number of requests that may wait for a process.
        memory_bytes: Memory that each of these may allocate after its start, [bytes].
        background: Number of processes for calls of low priority, started when first needed.
    """

    def __init__(self, count: int, waiting: int, memory_bytes: int, background: int = 1) -> None:
        self.size, self.waiting = count, waiting
        self.requests = Workers(count, replace(REQUEST, memory_bytes=memory_bytes))
        self.background = Workers(background, BACKGROUND)
        self.refused, self.is_starting = 0, False
        self._outside, self._outside_since = 0.0, 0.0

    @property
    def pids(self) -> list[int]:
        """Ids of the running processes."""
        return [*self.requests.pids, *self.background.pids]

    @property
    def retry_after(self) -> int:
        """Estimated time until the queued requests and retries of refused ones are done, [s]; at least 1."""
        queue = self.requests.seconds_a_call * (len(self.requests.turns) + 1) / self.size
        return max(1, math.ceil(queue), math.ceil(min(_CROWD_SECONDS, queue + self._crowd_seconds())))

    async def start(self) -> None:
        """Start all processes for requests, and return when they are ready."""
        self.is_starting = True
        await self.requests.start()
        self.is_starting = False

    def check_room(self, client: str = "") -> None:
        """Raise ServiceBusy if a request would not be accepted, before the caller creates a task for it."""
        if len(self.requests.turns) >= self.waiting and not self.requests.is_free_for(client):
            self._turn_away()
            raise ServiceBusy(self.retry_after)

    def _turn_away(self) -> None:
        """Count a refused request, and expect that its client retries it."""
        self.refused += 1
        self._outside = self._crowd_seconds() * self.size / max(self.requests.seconds_a_call, 1e-6) + 1.0
        self._outside_since = time.monotonic()

    def _crowd_seconds(self) -> float:
        """Return the remaining time that retries of refused requests would occupy the pool, [s]."""
        seconds = self._outside * self.requests.seconds_a_call / self.size
        return min(_CROWD_SECONDS, max(0.0, seconds - (time.monotonic() - self._outside_since)))

    async def run(
        self, function: Callable[[_Argument], _Result], argument: _Argument, seconds: float, client: str = ""
    ) -> _Result:
        """Run a function in a worker process and return its result; cancelling this coroutine cancels the call.

        Besides the function's own exceptions, it raises ServiceBusy if too many requests are waiting or no worker
        becomes available in time, DeadlineExceeded, WorkerCrashed, WorkerOutOfMemory, and ServiceStopping.

        Args:
            function: Module-level function whose argument and result can be pickled.
            seconds: Longest time to wait for a worker (longer while the pool starts), and then to run, [s].
            client: Client that sent the request; clients take turns.
        """
        self.requests.fill()
        self.check_room(client)
        try:
            worker = await self.requests.turn(client, seconds + _START_SECONDS * self.is_starting)
        except TimeoutError:
            self._turn_away()
            raise ServiceBusy(self.retry_after) from None
        result: _Result = await self.requests.run(worker, client, (function, argument, seconds))
        return result

    async def run_in_background(self, function: Callable[[_Argument], Any], argument: _Argument, seconds: float) -> Any:
        """Run a function at low priority and return its result; unlike `run`, wait for a worker without limit."""
        worker = await self.background.turn("", None)
        return await self.background.run(worker, "", (function, argument, seconds))

    def close(self) -> None:
        """Kill all processes, even during calls, and refuse later calls."""
        self.requests.close()
        self.background.close()
