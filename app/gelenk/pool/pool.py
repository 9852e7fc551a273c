"""Process pool for an event loop: a bounded queue, and a deadline for each call.

A call that crashes, misses its deadline or is abandoned ends only its own process. A new process replaces it within
milliseconds, because it is a copy of one that has everything loaded. A client that arrives while others occupy all
processes gets an additional one just as fast.
"""

import asyncio
import contextlib
import logging
import math
import os
import signal
import socket
import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Any, TypeAlias, TypeVar

from gelenk.errors import DeadlineExceeded, ServiceBusy, ServiceStopping, WorkerCrashed, WorkerOutOfMemory
from gelenk.pool import wire
from gelenk.pool.worker import serve
from gelenk.processes.copies import Copy, ended, started
from gelenk.processes.turns import Turns

_Argument = TypeVar("_Argument")
_Result = TypeVar("_Result")

_END_SECONDS = 2.0
"""Longest wait for the exit code of a process that ended, [s]."""
_PATIENCE = 0.05
"""Time in which an abandoned call may still finish, [s]: that costs less than a new process."""
_RETRY_SECONDS, _MOST_RETRY_SECONDS = 0.5, 30.0
_CROWD_SECONDS = 10.0
"""Longest time over which retries of refused calls are spread, [s]: many clients never return."""
_SMOOTHING = 0.1
_START_SECONDS = 600.0
"""Time added to the wait of calls while the first processes start, [s]: they may have to compile."""
_MOMENT = 1.0
"""How long processes may be missing before the pool reports it, [s]."""
_LOOK_SECONDS = 0.5
"""Interval of checks whether the clients for which an idle process is reserved have left, [s]."""

Call: TypeAlias = tuple[Callable[[Any], Any], Any, float]
"""A function, its argument, and its time limit, [s]."""

logger = logging.getLogger("gelenk")


class WorkerPool:
    """Pool of processes that run calls; belongs to one event loop.

    Args:
        count: Number of processes; `Turns` explains when there are more.
        waiting: Maximum number of calls that wait for a process.
        memory_bytes: Memory that a process may use in addition to what it holds at its start, [bytes].

    Attributes:
        busy: Number of processes that run a call.
        restarts: Number of processes replaced after a crash, a missed deadline, a lack of memory or an abandoned call.
        refused: Number of calls refused because the queue was full or their turn came too late.
        is_starting: Whether the first processes are still starting.
    """

    def __init__(self, count: int, waiting: int, memory_bytes: int) -> None:
        self.size, self.waiting, self._memory_bytes = count, waiting, memory_bytes
        self.busy = self.restarts = self.refused = 0
        self._idle: list[_Seat] = []
        self._turns: Turns[asyncio.Future[_Seat]] = Turns(count)
        self._look: asyncio.TimerHandle | None = None
        self._seats: list[_Seat] = []
        self._renewals: set[asyncio.Task[None]] = set()
        self._seconds_a_call = 0.0
        self._outside, self._outside_since = 0.0, 0.0
        self._whole_until = -math.inf
        self._is_begun = self._closed = self.is_starting = False

    @property
    def queue_length(self) -> int:
        """Number of waiting calls."""
        return len(self._turns)

    @property
    def pids(self) -> list[int]:
        """Ids of the running processes."""
        return [pid for seat in self._seats if (pid := seat.pid) is not None]

    @property
    def retry_after(self) -> int:
        """Estimated time until the queued calls and the recently refused ones are done, [s]."""
        queue = self._seconds_a_call * (len(self._turns) + 1) / self.size
        return max(1, math.ceil(queue), math.ceil(min(_CROWD_SECONDS, queue + self._crowd_seconds())))

    @property
    def is_short(self) -> bool:
        """Whether the pool has lacked processes for longer than a replacement takes."""
        return not self._seats or (bool(self._renewals) and time.monotonic() > self._whole_until + _MOMENT)

    async def start(self) -> None:
        """Start all processes and wait until they are ready."""
        self.is_starting = True
        self._fill()
        await asyncio.gather(*self._renewals)
        self.is_starting, self._is_begun = False, True

    def check_room(self, client: str = "") -> None:
        """Check that a call would be accepted, so that a caller can refuse it before creating a task.

        Raises:
            ServiceBusy: Too many calls wait.
        """
        is_next = self._turns.has_room(client) if self._idle else self._turns.is_beyond(client)
        if len(self._turns) >= self.waiting and not is_next:
            self._turn_away()
            raise ServiceBusy(self.retry_after)

    def _turn_away(self) -> None:
        """Count a refused call; its client is expected to retry it."""
        self.refused += 1
        self._outside = self._crowd_seconds() * self.size / max(self._seconds_a_call, 1e-6) + 1.0
        self._outside_since = time.monotonic()

    def _crowd_seconds(self) -> float:
        """Estimate how long the refused calls would still take, less the time since the last refusal, [s]."""
        seconds = self._outside * self._seconds_a_call / self.size
        return min(_CROWD_SECONDS, max(0.0, seconds - (time.monotonic() - self._outside_since)))

    async def run(
        self, function: Callable[[_Argument], _Result], argument: _Argument, seconds: float, client: str = ""
    ) -> _Result:
        """Run a function in a process and return its result; cancelling this coroutine cancels the call.

        Args:
            function: Module-level function; its argument and its result must be picklable.
            argument: Argument of the function.
            seconds: Longest wait for a process, and longest run time, [s]; the start of the pool does not count.
            client: Client that makes the call; the clients take turns.

        Raises:
            ServiceBusy: Too many calls wait, or no process is free in time.
            DeadlineExceeded: The function takes too long.
            WorkerCrashed: The process has died.
            WorkerOutOfMemory: The function needs more memory than allowed.
            ServiceStopping: The pool is closed.
            Exception: Whatever the function raises.
        """
        seat = await self._turn(client, seconds)
        work = asyncio.get_running_loop().create_task(self._worked(seat, client, (function, argument, seconds)))
        try:
            return await asyncio.shield(work)
        except asyncio.CancelledError:
            asyncio.get_running_loop().call_later(_PATIENCE, work.cancel)
            work.add_done_callback(lambda task: task.cancelled() or task.exception())
            raise

    def close(self) -> None:
        """End all processes, including those that run calls, and refuse later calls."""
        self._closed = True
        for renewal in self._renewals:
            renewal.cancel()
        for turn in self._turns:
            if not turn.done():
                turn.set_exception(ServiceStopping())
        for seat in self._seats:
            seat.close()

    def _fill(self) -> None:
        if not self._seats and not self._closed:
            self._seats = [_Seat(self._memory_bytes) for _ in range(self.size)]
            for seat in self._seats:
                self._renew(seat)

    async def _turn(self, client: str, seconds: float) -> "_Seat":
        self._fill()
        if self._closed:
            raise ServiceStopping
        self.check_room(client)
        turn: asyncio.Future[_Seat] = asyncio.get_running_loop().create_future()
        self._turns.add(client, turn)
        if self._turns.is_beyond(client) and not self._idle and len(self._seats) < self.size + self._turns.half:
            self._seats.append(_Seat(self._memory_bytes))
            self._renew(self._seats[-1])
        self._hand_out()
        try:
            async with asyncio.timeout(seconds + _START_SECONDS * self.is_starting):
                return await turn
        except BaseException as error:
            if not self._turns.remove(client, turn) and not turn.cancelled() and turn.exception() is None:
                self._turns.give_back(client)
                self._give_back(turn.result())
            if not isinstance(error, TimeoutError):
                raise
            self._turn_away()
            raise ServiceBusy(self.retry_after) from None

    def _hand_out(self) -> None:
        """Give idle processes to the next clients in turn, and end surplus processes."""
        while self._idle and not self._closed:
            if not self._idle[-1].is_alive():
                self._renew(self._idle.pop())
            elif (found := self._turns.take()) is None:
                break
            elif found[1].done():
                self._turns.give_back(found[0])
            else:
                found[1].set_result(self._idle.pop())
        while len(self._idle) > 1 and len(self._seats) > self.size:
            seat = self._idle.pop(0)
            self._seats.remove(seat)
            threading.Thread(target=seat.close, daemon=True).start()  # closing waits for the process
        if self._look is not None:
            self._look.cancel()
        if self._idle and self._turns and not self._closed:
            self._look = asyncio.get_running_loop().call_later(_LOOK_SECONDS, self._hand_out)

    async def _worked(self, seat: "_Seat", client: str, call: Call) -> Any:
        self.busy += 1
        began = time.monotonic()
        try:
            return await seat.asked(call)
        finally:
            self.busy -= 1
            self._seconds_a_call += _SMOOTHING * (time.monotonic() - began - self._seconds_a_call)
            self._turns.give_back(client)
            self._give_back(seat)

    def _give_back(self, seat: "_Seat") -> None:
        """Give a process to the next client; replace it first if it is broken."""
        if self._closed:
            seat.close()
            return
        if seat.is_broken:
            self.restarts += not seat.is_retired
            self._renew(seat)
            return
        self._idle.append(seat)
        self._hand_out()

    def _renew(self, seat: "_Seat") -> None:
        if not self._renewals and self._is_begun:
            self._whole_until = time.monotonic()
        renewal = asyncio.get_running_loop().create_task(self._renewed(seat))
        self._renewals.add(renewal)
        renewal.add_done_callback(self._renewals.discard)

    async def _renewed(self, seat: "_Seat") -> None:
        pause = _RETRY_SECONDS
        while not self._closed:
            try:
                await _beside(seat.start)
            except ChildProcessError as error:
                logger.error("%s; once more in %g s", error, pause)
                await asyncio.sleep(pause)
                pause = min(2.0 * pause, _MOST_RETRY_SECONDS)
                continue
            self._give_back(seat)
            return


class _Seat:
    """A process and the connection to it."""

    def __init__(self, memory_bytes: int) -> None:
        self._memory_bytes = memory_bytes
        self._process: Copy | None = None
        self._stream: socket.socket | None = None
        self._is_asked = self._is_closed = self.is_retired = False
        self.is_broken = True

    @property
    def pid(self) -> int | None:
        process = self._process
        return None if process is None else process.pid

    def start(self) -> None:
        """Replace the process with a new one; this blocks for milliseconds, the first time for seconds.

        Raises:
            ChildProcessError: No process could be started.
        """
        self._end_process()
        self._close_stream()
        self._process, connection = started(partial(serve, self._memory_bytes), "crew")
        self._stream = socket.socket(fileno=os.dup(connection.fileno()))
        self._stream.setblocking(False)
        connection.close()
        self.is_broken = False
        if self._is_closed:
            self.close()

    def close(self) -> None:
        """End the process for good; a running call fails, and the connection closes."""
        self._is_closed = True
        self._end_process()
        if not self._is_asked:
            self._close_stream()

    def is_alive(self) -> bool:
        """Check whether an idle process still lives, by peeking at its connection: it has neither sent nor closed."""
        if self._stream is None:
            return False
        try:
            self._stream.recv(1, socket.MSG_PEEK)
        except BlockingIOError:
            return True
        except OSError:
            pass
        return False

    async def asked(self, call: Call) -> Any:
        """Send a call to the process and return its result.

        Raises:
            Exception: As for `WorkerPool.run`.
        """
        stream, seconds = self._stream, call[2]
        if stream is None:
            raise ServiceStopping
        self._is_asked, self.is_broken, self.is_retired = True, True, False
        try:
            async with asyncio.timeout(seconds):
                await wire.send_soon(stream, call)
                (kind, value), goes_on = await wire.receive_soon(stream)
        except TimeoutError:
            raise DeadlineExceeded(seconds) from None
        except (EOFError, OSError):
            raise await self._reason(seconds) from None
        finally:
            self._is_asked = False
        self.is_broken = not goes_on
        self.is_retired = not goes_on and kind != "memory"  # a worker that makes room for a fresh one is no fault
        if kind == "result":
            return value
        raise value if kind == "error" else WorkerOutOfMemory(self._memory_bytes)

    async def _reason(self, seconds: float) -> Exception:
        """Return the exception that explains why the process ended."""
        process = self._process
        if self._is_closed or process is None:
            return ServiceStopping()
        await _beside(partial(process.join, _END_SECONDS))
        code = process.exitcode
        if code == -signal.SIGXCPU:
            return DeadlineExceeded(seconds)
        if code is not None and code < 0:
            return WorkerCrashed(signal.Signals(-code).name)
        return WorkerCrashed(f"exit code {code}")

    def _end_process(self) -> None:
        process, self._process = self._process, None
        ended(process, None)

    def _close_stream(self) -> None:
        stream, self._stream = self._stream, None
        if stream is not None:
            stream.close()


async def _beside(work: Callable[[], None]) -> None:
    """Run a function in a daemon thread, which does not delay the end of the service.

    Raises:
        Exception: Whatever the function raises.
    """
    loop = asyncio.get_running_loop()
    done: asyncio.Future[None] = loop.create_future()

    def tell(error: Exception | None) -> None:
        if not done.done():
            done.set_result(None) if error is None else done.set_exception(error)

    def run() -> None:
        error = None
        try:
            work()
        except Exception as raised:
            error = raised
        with contextlib.suppress(RuntimeError):  # the loop is closed, so no caller waits
            loop.call_soon_threadsafe(tell, error)

    threading.Thread(target=run, name="crew", daemon=True).start()
    await done
