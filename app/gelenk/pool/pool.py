"""A pool of processes that an event loop sends calls to: bounded, each call with a deadline, none lost.

If a call crashes its process, misses its deadline or is abandoned, only its own process ends. A new one is there within
milliseconds, because it is a copy of one that has everything loaded. A client that comes while others occupy all
processes gets an additional one in the same time.
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
"""How long to wait for the reason why a process ended."""
_PATIENCE = 0.05
"""An abandoned call may finish within this time, [s]: that costs less than a new process."""
_RETRY_SECONDS, _MOST_RETRY_SECONDS = 0.5, 30.0
_CROWD_SECONDS = 10.0
"""Retries of refused calls are spread over at most this time, [s]: many clients never return."""
_SMOOTHING = 0.1
_START_SECONDS = 600.0
"""How long the first processes may take, because they may compile; calls' waiting times do not count it."""
_MOMENT = 1.0
"""How long processes may be missing before that is reported, [s]."""
_LOOK_SECONDS = 0.5
"""How often to check whether clients have left for whom an idle process is kept, [s]."""

Call: TypeAlias = tuple[Callable[[Any], Any], Any, float]
"""A function, its argument, and how many seconds it may take."""

logger = logging.getLogger("gelenk")


class WorkerPool:
    """The processes; belongs to one event loop.

    Args:
        count: How many; see `Turns` for when there are more.
        waiting: Calls that may wait for one.
        memory_bytes: What each may take in addition to what it has at its start.

    Attributes:
        busy: Processes at work.
        restarts: Processes replaced after a crash, a missed deadline, a lack of memory or an abandoned call.
        refused: Calls for which there was no room.
        is_starting: Whether the first processes are being started.
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
        """Calls that wait."""
        return len(self._turns)

    @property
    def pids(self) -> list[int]:
        """Ids of the running processes."""
        return [pid for seat in self._seats if (pid := seat.pid) is not None]

    @property
    def retry_after(self) -> int:
        """Estimated seconds until the queue and the calls refused meanwhile are done."""
        queue = self._seconds_a_call * (len(self._turns) + 1) / self.size
        return max(1, math.ceil(queue), math.ceil(min(_CROWD_SECONDS, queue + self._crowd_seconds())))

    @property
    def is_short(self) -> bool:
        """Whether processes have been missing for longer than it takes to replace one."""
        return not self._seats or (bool(self._renewals) and time.monotonic() > self._whole_until + _MOMENT)

    async def start(self) -> None:
        """Start all processes, and return when they are ready."""
        self.is_starting = True
        self._fill()
        await asyncio.gather(*self._renewals)
        self.is_starting, self._is_begun = False, True

    def check_room(self, client: str = "") -> None:
        """Check whether a call would be accepted, so that many can be refused before a task is made for each.

        Raises:
            ServiceBusy: Too many calls wait.
        """
        is_next = self._turns.has_room(client) if self._idle else self._turns.is_beyond(client)
        if len(self._turns) >= self.waiting and not is_next:
            self._turn_away()
            raise ServiceBusy(self.retry_after)

    def _turn_away(self) -> None:
        """Count a refused call among those that will be retried."""
        self.refused += 1
        self._outside = self._crowd_seconds() * self.size / max(self._seconds_a_call, 1e-6) + 1.0
        self._outside_since = time.monotonic()

    def _crowd_seconds(self) -> float:
        """How long the refused calls would take one after the other, less the time that has passed."""
        seconds = self._outside * self._seconds_a_call / self.size
        return min(_CROWD_SECONDS, max(0.0, seconds - (time.monotonic() - self._outside_since)))

    async def run(
        self, function: Callable[[_Argument], _Result], argument: _Argument, seconds: float, client: str = ""
    ) -> _Result:
        """The function's result; cancelling this ends the call.

        Args:
            function: Of a module, with an argument and a result that can be sent to another process.
            argument: What it is called with.
            seconds: How long it may wait for its turn, and how long it may then take, not counting the start.
            client: Whose call it is.

        Raises:
            ServiceBusy: Too many calls wait, or its turn does not come in time.
            DeadlineExceeded: It takes longer.
            WorkerCrashed: Its process has died.
            WorkerOutOfMemory: It needs more memory than it may have.
            ServiceStopping: The pool has been closed.
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
        """End all processes, even during calls; later calls are refused."""
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
        """Give idle processes to the clients whose turn it is, and end surplus ones."""
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
            threading.Thread(target=seat.close, daemon=True).start()  # it waits for the process to end
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
        """Give a process to the next client; replace it first if it is no longer fit."""
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
        """A new process in the place of the old one; blocks for some milliseconds, the first time for seconds.

        Raises:
            ChildProcessError: None could be started.
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
        """End the process for good; a running call notices, and then closes the connection."""
        self._is_closed = True
        self._end_process()
        if not self._is_asked:
            self._close_stream()

    def is_alive(self) -> bool:
        """Whether an idle process is still alive: it has sent nothing and not closed its connection."""
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
        """The outcome of a call.

        Raises:
            Exception: As `WorkerPool.run`.
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
        self.is_retired = not goes_on and kind != "memory"  # it has made room by itself, which is no fault
        if kind == "result":
            return value
        raise value if kind == "error" else WorkerOutOfMemory(self._memory_bytes)

    async def _reason(self, seconds: float) -> Exception:
        """Why the process ended, as far as known."""
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
    """Do something in a thread of its own; the end of the service does not wait for it.

    Raises:
        Exception: Whatever it raises.
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
        with contextlib.suppress(RuntimeError):  # the loop is closed: nobody waits any more
            loop.call_soon_threadsafe(tell, error)

    threading.Thread(target=run, name="crew", daemon=True).start()
    await done
