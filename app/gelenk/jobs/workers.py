"""Local processes that compute parts of jobs: started on first use, kept warm, replaced when they die or hang.

A thread for each process hands it one part after the other and waits for the result. So a process that dies affects
only its own part, and the process that computes for a cancelled or late job can be killed. No process outlives the
service.
"""

import os
import pickle
import queue
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from typing import Any, TypeAlias

from gelenk.processes.copies import GOODBYE_SECONDS, Copy, ended, started

_LOOK = 0.05
"""How often a thread that waits for a result checks whether it is still wanted, [s]."""
_GRACE = 1.0
"""How long a part of a cancelled job may go on before its process is killed, [s]."""
_IDLE = 300.0
"""Idle time after which a process is ended, [s]."""
_NICENESS = 10
"""Niceness of the processes, above that of the pool: requests, whose clients wait, have priority."""
ATTEMPTS = 3
"""How often to start a part whose process dies, which may not be the part's fault."""
DIED = f"its process died {ATTEMPTS} times, the limit; possibly out of memory"


class Cancelled(Exception):
    """The result is no longer wanted."""


class OutOfTime(Exception):
    """The result was not ready before the deadline."""


class Unavailable(Exception):
    """No process can compute the part now, through no fault of the part: it may be submitted again."""


@dataclass(eq=False)
class Order:
    """Deadline and cancellation of the parts of one job.

    Attributes:
        until: Deadline, on the clock of `time.monotonic`, [s].
        cancelled: Set when the parts are no longer wanted.
    """

    until: float
    cancelled: threading.Event = field(default_factory=threading.Event)


_Part: TypeAlias = tuple[Callable[[Any], Any], Any, Order, "Future[Any]"]


class Workers:
    """A fixed number of local processes; safe to use from many threads.

    Args:
        count: Number of processes.
    """

    def __init__(self, count: int) -> None:
        self.count = count
        self._parts: queue.SimpleQueue[_Part | None] = queue.SimpleQueue()
        self._closed = threading.Event()
        self._lock = threading.Lock()
        self._seats: list[_Seat] = []

    @property
    def pids(self) -> list[int]:
        """Ids of the running processes."""
        return [pid for seat in self._seats if (pid := seat.pid) is not None]

    failure = None
    """Always None, because local processes are always available."""

    def prepare(self) -> None:
        """Do nothing, because the first part starts the processes."""

    def submit(self, function: Callable[[Any], Any], argument: Any, order: Order) -> "Future[Any]":
        """Submit a part.

        Args:
            function: Module-level function whose argument and result can be pickled.
            argument: Argument of the function.
            order: Deadline and cancellation of the part's job.

        Returns:
            Future of the function's result. Its exception is the function's, `Cancelled`, `OutOfTime`, or
            ChildProcessError if the process died `ATTEMPTS` times.
        """
        future: Future[Any] = Future()
        with self._lock:
            if self._closed.is_set():
                raise Cancelled
            if not self._seats:
                self._seats = [_Seat(self._parts, self._closed, number) for number in range(self.count)]
        self._parts.put((function, argument, order, future))
        return future

    def close(self) -> None:
        """End all processes, even in the middle of a part, and reject later parts."""
        with self._lock:
            self._closed.set()
        for _ in self._seats:
            self._parts.put(None)
        for seat in self._seats:
            seat.join(GOODBYE_SECONDS + 4 * _LOOK)
        while True:
            try:
                part = self._parts.get_nowait()
            except queue.Empty:
                return
            if part is not None and part[3].set_running_or_notify_cancel():
                part[3].set_exception(Cancelled())


class _Seat(threading.Thread):
    """A thread, and the process to which it hands parts."""

    def __init__(self, parts: "queue.SimpleQueue[_Part | None]", closed: threading.Event, number: int) -> None:
        super().__init__(name=f"jobs-{number}", daemon=True)
        self._parts, self._closed = parts, closed
        self._process: Copy | None = None
        self._connection: Connection | None = None
        self.start()

    @property
    def pid(self) -> int | None:
        process = self._process
        return None if process is None else process.pid

    def run(self) -> None:
        """Have parts computed until shutdown."""
        while not self._closed.is_set():
            try:
                part = self._parts.get(timeout=_IDLE)
            except queue.Empty:
                self._end()
                continue
            if part is None:
                break
            function, argument, order, future = part
            if not future.set_running_or_notify_cancel():
                continue
            try:
                future.set_result(self._done(function, argument, order))
            except BaseException as error:
                future.set_exception(error)
        self._end()

    def _done(self, function: Callable[[Any], Any], argument: Any, order: Order) -> Any:
        message = pickle.dumps((function, argument), protocol=pickle.HIGHEST_PROTOCOL)
        for attempt in range(1, ATTEMPTS + 1):
            self._look(order, None)
            try:
                succeeded, result = self._asked(message, order)
            except (EOFError, ConnectionError, OSError) as error:
                self._end()
                if attempt == ATTEMPTS:
                    raise ChildProcessError(DIED) from error
                continue
            if not succeeded:
                raise result
            return result
        raise AssertionError

    def _asked(self, message: bytes, order: Order) -> Any:
        connection = self._connection
        if connection is None or self._process is None or not self._process.is_alive():
            self._end()
            connection = self._start()
        connection.send_bytes(message)
        unwanted: float | None = None
        while not connection.poll(_LOOK):
            if order.cancelled.is_set() and unwanted is None:
                unwanted = time.monotonic()
            self._look(order, unwanted)
        return connection.recv()

    def _look(self, order: Order, unwanted: float | None) -> None:
        """Raise an error if the result is no longer wanted, and kill the process if it is at work on the part.

        Args:
            order: Deadline and cancellation of the job.
            unwanted: When the cancellation was noticed during the part, by `time.monotonic`, [s]; None if it was not.
        """
        late = time.monotonic() > order.until
        cancelled = order.cancelled.is_set() and (unwanted is None or time.monotonic() > unwanted + _GRACE)
        if not (late or cancelled or self._closed.is_set()):
            return
        if unwanted is not None or late or self._closed.is_set():
            self._end()
        raise OutOfTime if late else Cancelled

    def _start(self) -> Connection:
        self._process, self._connection = started(serve, "jobs")
        return self._connection

    def _end(self) -> None:
        ended(self._process, self._connection)
        self._process, self._connection = None, None


def serve(connection: Connection) -> None:
    """Compute parts until the pipe closes: the main function of a process."""
    os.nice(_NICENESS)
    while True:
        try:
            function, argument = connection.recv()
        except (EOFError, OSError):
            return
        try:
            answer = (True, function(argument))
        except Exception as error:
            answer = (False, error)
        try:
            connection.send(answer)
        except OSError:
            return
