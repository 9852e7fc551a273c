"""Starts the worker processes of one priority, assigns them to clients in turn, and replaces them."""

import asyncio
import logging
import math
import signal
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from functools import partial
from typing import Any, TypeAlias, TypeVar

from gelenk.errors import DeadlineExceeded, ServiceStopping, WorkerCrashed, WorkerOutOfMemory
from gelenk.pool.worker import Priority, serve
from gelenk.processes.turns import Turns
from gelenk.processes.worker_process import WorkerProcess

_Result = TypeVar("_Result")

_END_SECONDS = 2.0
"""How long to wait for the exit code of a process that ended, [s]."""
_RETRY_SECONDS, _MOST_RETRY_SECONDS = 0.5, 30.0
_SMOOTHING = 0.1
_MOMENT = 1.0
"""How long workers may be missing before `is_short` reports it, [s]."""
_LOOK_SECONDS = 0.5
"""Interval at which to check whether an idle worker reserved for other clients may be handed out, [s]."""

Call: TypeAlias = tuple[Callable[[Any], Any], Any, float]
"""A function, its argument, and the longest time that it may take, [s]."""

logger = logging.getLogger("gelenk")


class Workers:
    """Worker processes of one priority; `Turns` explains when there are more than `count`; for one event loop only.

    Attributes:
        restarts: Number of workers replaced after a crash, a missed deadline, lack of memory or an abandoned call.
        seconds_a_call: Exponential moving average of the duration of a call, [s].
    """

    def __init__(self, count: int, priority: Priority) -> None:
        self.turns: Turns[asyncio.Future[WorkerProcess]] = Turns(count)
        self.busy = self.restarts = 0
        self.seconds_a_call = 0.0
        self._priority = priority
        self._workers: list[WorkerProcess] = []
        self._idle: dict[WorkerProcess, asyncio.TimerHandle] = {}  # the most recently used one is last
        self._starting: set[asyncio.Task[WorkerProcess | None]] = set()
        self._complete_until, self._is_started = -math.inf, False
        self._look: asyncio.TimerHandle | None = None
        self._is_closed = False

    @property
    def count(self) -> int:
        """Number of workers that are running or starting."""
        return len(self._workers) + len(self._starting)

    @property
    def pids(self) -> list[int]:
        """Process ids of the running workers."""
        return [worker.pid for worker in self._workers]

    @property
    def is_short(self) -> bool:
        """Whether workers have been missing for longer than it takes to replace one."""
        is_missing = self.count == 0 < self.turns.size or bool(self._starting)
        return is_missing and time.monotonic() > self._complete_until + _MOMENT

    def is_free_for(self, client: str) -> bool:
        """Check whether a call could get an idle or an additional worker now."""
        return self.turns.has_room(client) if self._idle else self.turns.is_beyond(client)

    def fill(self) -> None:
        """Start all workers if none is running or starting."""
        if not self.count and not self._is_closed:
            for _ in range(self.turns.size):
                self._start()

    async def start(self) -> None:
        """Start all workers, and return when they are ready."""
        self.fill()
        await asyncio.gather(*self._starting)
        self._is_started = True

    async def turn(self, client: str, seconds: float | None) -> WorkerProcess:
        """Wait for the client's turn and return a worker for one call; `run` gives the worker back.

        Raises TimeoutError if the turn does not come within `seconds` (None: no limit), and ServiceStopping.
        """
        if self._is_closed:
            raise ServiceStopping
        turn: asyncio.Future[WorkerProcess] = asyncio.get_running_loop().create_future()
        self.turns.add(client, turn)
        if not self._idle and self.count < self.turns.size + self.turns.half * self.turns.is_beyond(client):
            self._start()
        self._hand_out()
        try:
            async with asyncio.timeout(seconds):
                return await turn
        except BaseException:
            if not self.turns.remove(client, turn) and not turn.cancelled() and turn.exception() is None:
                self.turns.give_back(client)
                self._rest(turn.result())
            raise

    async def run(self, worker: WorkerProcess, client: str, call: Call) -> Any:
        """Run a call and return its result as `WorkerPool.run`; if cancelled, the call ends after a grace period."""
        loop = asyncio.get_running_loop()
        work = loop.create_task(self._ask(worker, client, call))
        try:
            return await asyncio.shield(work)
        except asyncio.CancelledError:
            loop.call_later(self._priority.grace_seconds, work.cancel)
            work.add_done_callback(lambda task: task.cancelled() or task.exception())
            raise

    def close(self) -> None:
        """Kill all workers, even during calls, and refuse later calls."""
        self._is_closed = True
        for turn in self.turns:
            if not turn.done():
                turn.set_exception(ServiceStopping())
        for worker in self._workers:
            worker.close() if worker in self._idle else worker.kill()  # `_ask` sees it end, then closes it

    async def _ask(self, worker: WorkerProcess, client: str, call: Call) -> Any:
        self.busy += 1
        began, seconds = time.monotonic(), call[2]
        is_fit, is_fault = False, True
        try:
            async with asyncio.timeout(seconds):
                (kind, value), is_fit = await worker.ask(call)
            is_fault = kind == "memory"  # otherwise an unfit worker has ended by choice
        except TimeoutError:
            raise DeadlineExceeded(seconds) from None
        except (EOFError, OSError):
            raise await self._death(worker, seconds) from None
        finally:
            self.busy -= 1
            self.seconds_a_call += _SMOOTHING * (time.monotonic() - began - self.seconds_a_call)
            self.restarts += is_fault and not self._is_closed
            self.turns.give_back(client)
            self._rest(worker) if is_fit else self._replace(worker)
        if kind == "result":
            return value
        raise value if kind == "error" else self._out_of_memory()

    async def _death(self, worker: WorkerProcess, seconds: float) -> Exception:
        if self._is_closed:
            return ServiceStopping()
        await asyncio.wrap_future(_in_thread(partial(worker.join, _END_SECONDS)))
        is_late = worker.exitcode == -signal.SIGXCPU
        return DeadlineExceeded(seconds) if is_late else WorkerCrashed(worker.exit_reason)

    def _out_of_memory(self) -> Exception:
        limit = self._priority.memory_bytes
        return MemoryError() if math.isinf(limit) else WorkerOutOfMemory(int(limit))

    def _rest(self, worker: WorkerProcess) -> None:
        if self._is_closed:
            worker.close()
            return
        self._idle[worker] = asyncio.get_running_loop().call_later(self._priority.idle_seconds, self._end, worker)
        self._hand_out()

    def _hand_out(self) -> None:
        """Give idle workers to the clients whose turn it is, and end surplus workers."""
        while self._idle and not self._is_closed:
            worker = next(reversed(self._idle))
            if not worker.is_silent():
                self._replace(worker)
            elif (found := self.turns.take()) is None:
                break
            elif found[1].done():
                self.turns.give_back(found[0])
            else:
                self._idle.pop(worker).cancel()
                found[1].set_result(worker)
        while len(self._idle) > 1 and self.count > self.turns.size:
            self._end(next(iter(self._idle)))
        if self._look is not None:
            self._look.cancel()
        if self._idle and self.turns and not self._is_closed:
            self._look = asyncio.get_running_loop().call_later(_LOOK_SECONDS, self._hand_out)

    def _end(self, worker: WorkerProcess) -> None:
        self._remove(worker)
        _in_thread(worker.close)

    def _remove(self, worker: WorkerProcess) -> None:
        self._workers.remove(worker)
        if (timer := self._idle.pop(worker, None)) is not None:
            timer.cancel()

    def _replace(self, worker: WorkerProcess) -> None:
        if self._is_closed:
            worker.close()
        else:
            self._remove(worker)
            self._start(worker)

    def _start(self, old: WorkerProcess | None = None) -> None:
        """Start a worker, after closing the old one that it replaces, if any."""
        if not self._starting and self._is_started:
            self._complete_until = time.monotonic()
        task = asyncio.get_running_loop().create_task(self._new_worker(old))
        self._starting.add(task)
        task.add_done_callback(self._add)

    def _add(self, task: asyncio.Task[WorkerProcess | None]) -> None:
        self._starting.remove(task)
        if not task.cancelled() and (worker := task.result()) is not None:
            self._workers.append(worker)
            self._rest(worker)

    async def _new_worker(self, old: WorkerProcess | None) -> WorkerProcess | None:
        """Start a worker, retrying until that succeeds, and return it; return None if the pool is closed."""
        if old is not None:
            await asyncio.wrap_future(_in_thread(old.close))
        start = partial(WorkerProcess.start, partial(serve, self._priority), self._priority.title)
        pause = _RETRY_SECONDS
        while not self._is_closed:
            starting = _in_thread(start)
            try:
                worker = await asyncio.wrap_future(starting)
            except asyncio.CancelledError:
                starting.add_done_callback(_close)
                raise
            except ChildProcessError as error:
                logger.error("%s; retrying in %g s", error, pause)
                await asyncio.sleep(pause)
                pause = min(2.0 * pause, _MOST_RETRY_SECONDS)
            else:
                worker.socket.setblocking(False)
                return worker
        return None


def _close(started: "Future[WorkerProcess]") -> None:
    if started.exception() is None:
        started.result().close()


def _in_thread(work: Callable[[], _Result]) -> "Future[_Result]":
    """Run a function in a new daemon thread, which does not delay the end of the service."""
    outcome: Future[_Result] = Future()
    outcome.set_running_or_notify_cancel()

    def run() -> None:
        try:
            outcome.set_result(work())
        except Exception as error:
            outcome.set_exception(error)

    threading.Thread(target=run, name="pool", daemon=True).start()
    return outcome
