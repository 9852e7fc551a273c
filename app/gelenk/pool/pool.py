"""The pool of worker processes that an event loop sends calls to: each call with a deadline, none lost.

If a call crashes its process, misses its deadline or is abandoned, only its own process ends. A new one is there within
milliseconds, because it is forked from one that has everything loaded. A client that comes while others occupy all
processes gets an additional one in the same time. Parts of jobs have processes of their own, which the system runs when
those for requests leave it time.
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
"""A client waits. Finishing an abandoned call soon costs less than a new process."""
BACKGROUND = Priority("jobs", niceness=10, grace_seconds=1.0, idle_seconds=300.0)
"""Parts of jobs: nobody waits for a single one."""

_CROWD_SECONDS = 10.0
"""Longest time over which retries of refused calls are spread, [s]: many clients never return."""
_START_SECONDS = 600.0
"""How long the first processes may take, because they may compile; calls' waiting times do not count it."""


class WorkerPool:
    """Pool of processes that run calls; belongs to one event loop.

    Args:
        count: Processes for requests; see `Turns` for when there are more.
        waiting: Requests that may wait for one.
        memory_bytes: What each of these may take in addition to what it has at its start.
        background: Processes for calls of low priority, started when first needed.

    Attributes:
        requests: The workers for requests.
        background: Those for calls of low priority.
        refused: Requests for which there was no room.
        is_starting: Whether the first processes are being started.
    """

    def __init__(self, count: int, waiting: int, memory_bytes: int, background: int = 0) -> None:
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
        """Estimated seconds until the queue and the requests refused meanwhile are done."""
        queue = self.requests.seconds_a_call * (len(self.requests.turns) + 1) / self.size
        return max(1, math.ceil(queue), math.ceil(min(_CROWD_SECONDS, queue + self._crowd_seconds())))

    async def start(self) -> None:
        """Start all processes for requests, and return when they are ready."""
        self.is_starting = True
        await self.requests.start()
        self.is_starting = False

    def check_room(self, client: str = "") -> None:
        """Check whether a request would be accepted, so that many can be refused before a task is made for each.

        Raises:
            ServiceBusy: Too many requests wait.
        """
        if len(self.requests.turns) >= self.waiting and not self.requests.is_free_for(client):
            self._turn_away()
            raise ServiceBusy(self.retry_after)

    def _turn_away(self) -> None:
        """Count a refused request among those that will be retried."""
        self.refused += 1
        self._outside = self._crowd_seconds() * self.size / max(self.requests.seconds_a_call, 1e-6) + 1.0
        self._outside_since = time.monotonic()

    def _crowd_seconds(self) -> float:
        """How long the refused requests would take one after the other, less the time that has passed."""
        seconds = self._outside * self.requests.seconds_a_call / self.size
        return min(_CROWD_SECONDS, max(0.0, seconds - (time.monotonic() - self._outside_since)))

    async def run(
        self, function: Callable[[_Argument], _Result], argument: _Argument, seconds: float, client: str = ""
    ) -> _Result:
        """Run a function in a process and return its result; cancelling this coroutine cancels the call.

        Args:
            function: Of a module, with an argument and a result that can be sent to another process.
            argument: What it is called with.
            seconds: How long it may wait for its turn, and how long it may then take, not counting the start.
            client: Whose request it is for.

        Raises:
            ServiceBusy: Too many requests wait, or its turn does not come in time.
            DeadlineExceeded: It takes longer.
            WorkerCrashed: Its process has died.
            WorkerOutOfMemory: It needs more memory than it may have.
            ServiceStopping: The pool has been closed.
            Exception: Whatever the function raises.
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
        """The result of a call of low priority, as `run` has it: it waits for its turn as long as need be."""
        worker = await self.background.turn("", None)
        return await self.background.run(worker, "", (function, argument, seconds))

    def close(self) -> None:
        """End all processes, even during calls; later calls are refused."""
        self.requests.close()
        self.background.close()
