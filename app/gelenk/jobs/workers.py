"""Processes that do the parts of jobs: started when first needed, kept warm, replaced when they die or hang.

Each process has a thread here that hands it one part after the other and waits for the result, so that a process
which dies takes its own part with it and no other, and a job that is cancelled or out of time can have its process
killed. Nothing of them is left when the service ends.
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
"""How often a thread that waits for a result looks whether it is still wanted, [s]."""
_GRACE = 1.0
"""How long a part of a cancelled job may go on before its process is killed, [s]."""
_IDLE = 300.0
"""After how long without work a process is let go, [s]."""
_NICENESS = 10
"""Requests whose client waits go first, before the pool too."""
ATTEMPTS = 3
"""How often a part is started whose process dies, which may not be the part's fault."""
DIED = f"its process died {ATTEMPTS} times, the limit; possibly out of memory"


class Cancelled(Exception):
    """The result is no longer wanted."""


class OutOfTime(Exception):
    """The result has not come in time."""


class Unavailable(Exception):
    """No process can compute it, through no fault of its own: it may be submitted again."""


@dataclass(eq=False)
class Order:
    """What the parts of one job have in common.

    Attributes:
        until: When they are given up, on the clock of `time.monotonic`, [s].
        cancelled: Set when they are no longer wanted.
    """

    until: float
    cancelled: threading.Event = field(default_factory=threading.Event)


_Part: TypeAlias = tuple[Callable[[Any], Any], Any, Order, "Future[Any]"]


class Workers:
    """A number of processes; safe to use from many threads.

    Args:
        count: How many.
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
    """They are always there."""

    def prepare(self) -> None:
        """They are started by the first part."""

    def submit(self, function: Callable[[Any], Any], argument: Any, order: Order) -> "Future[Any]":
        """Have a part done.

        Args:
            function: Of a module, with an argument and a result that can be sent to another process.
            argument: What it is called with.
            order: The job that it belongs to.

        Returns:
            The function's result, or what it has raised; `Cancelled`, `OutOfTime`, or ChildProcessError where its
            process has died `ATTEMPTS` times.
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
        """End all processes, in the middle of a part if need be; later parts are refused."""
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
    """A thread, and the process that it hands its parts to."""

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
        """Take parts until the end."""
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
        """Kill the process, if there is one at work, where its result is no longer wanted.

        Args:
            order: The job.
            unwanted: Since when it has been seen to be cancelled; None before a part is started.
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
    """Do parts until the other side is gone; what a process runs."""
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
