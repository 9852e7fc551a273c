"""Parts of jobs on a Ray cluster, for the service: what speaks to Ray is `driver`.

Ray lives in a process of its own at the other end of a pipe: it ends the process that it is in when it loses its
cluster, and that must not be the service. Where that happens, or nothing is heard of it, or no machine of the cluster
computes any more, what is under way is `Unavailable`; it is `prepare` alone that looks for the cluster again.
"""

import contextlib
import itertools
import pickle
import socket
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future, InvalidStateError
from multiprocessing.connection import Connection
from signal import SIGKILL
from typing import Any

from gelenk.jobs.driver import SIZE, Driver
from gelenk.jobs.workers import Cancelled, Order, Unavailable
from gelenk.processes.copies import Copy, ended, started

_ANSWER_SECONDS, _CONNECT_SECONDS = 5.0, 30.0
"""How long the cluster's head may take to answer at all, and until one of its machines has computed something, [s]."""
_SILENCE_SECONDS = 15.0
"""After how long the process that speaks to the cluster counts as hung, which tells every second that it lives, [s]."""
_MESSAGES = pickle.HIGHEST_PROTOCOL


class Cluster:
    """Computes parts on a Ray cluster; safe to use from many threads.

    Args:
        address: Of the cluster's head, `host:port`; this machine is one of the cluster's.
    """

    def __init__(self, address: str) -> None:
        self.address = address
        self.failure: str | None = f"the Ray cluster at {address} has not answered yet"
        self._lock = threading.Lock()
        self._process: Copy | None = None
        self._connection: Connection | None = None
        self._heard = 0.0
        self._futures: dict[int, Future[Any]] = {}
        self._numbers = itertools.count()
        self._count = 1
        self._closed = threading.Event()

    @property
    def count(self) -> int:
        """Processors of the machines that were last seen to compute."""
        return self._count

    def prepare(self) -> None:
        """Find the cluster, unless it is found; `failure` says where none of it computes. For one thread at a time."""
        if self._connection is None:
            self._connect()
        elif time.monotonic() > self._heard + _SILENCE_SECONDS:
            self._kill()  # whoever waits for it finds it gone

    def submit(self, function: Callable[[Any], Any], argument: Any, order: Order) -> "Future[Any]":
        """Have a part done; see `Workers.submit`. A cancelled future's part is ended on the cluster too.

        Raises:
            Unavailable: No machine of the cluster computes.
            Cancelled: The service is shutting down.
        """
        if order.cancelled.is_set() or self._closed.is_set():
            raise Cancelled
        with self._lock:
            if self._connection is None or self.failure is not None:
                raise Unavailable(self.failure)
            number, future = next(self._numbers), _Part(self)
            future.number = number
            self._futures[number] = future
            try:
                self._connection.send_bytes(pickle.dumps((number, (function, argument)), _MESSAGES))
            except OSError as error:
                raise self._lost() from error
        return future

    def drop(self, number: int) -> None:
        """Stop a part that is no longer needed."""
        with self._lock:
            if self._futures.pop(number, None) is not None and self._connection is not None:
                try:
                    self._connection.send_bytes(pickle.dumps((number, None), _MESSAGES))
                except OSError:
                    self._lost()

    def close(self) -> None:
        """End all that is under way, also where the other side hangs; later parts are refused."""
        self._closed.set()
        self._kill()
        with self._lock:
            self._end(Cancelled())

    def _kill(self) -> None:
        """Kill the process at the other end, which ends whatever waits for it, with or without the lock."""
        if (process := self._process) is not None:
            process.signal(SIGKILL)

    def _connect(self) -> None:
        try:
            # One that is not there would be waited for for minutes.
            host, _, port = self.address.rpartition(":")
            socket.create_connection((host.strip("[]"), int(port)), _ANSWER_SECONDS).close()
            self._process, connection = started(Driver(self.address), "ray")
            if self._closed.is_set():
                self._kill()
            if not connection.poll(_CONNECT_SECONDS):
                raise TimeoutError
            first = connection.recv()
        except (OSError, EOFError) as error:
            reason = error.strerror if isinstance(error, OSError) and error.strerror else "it does not answer"
            first = f"the Ray cluster at {self.address} cannot be reached: {reason}"
        with self._lock:
            if isinstance(first, str):
                self.failure = first
                self._end(Unavailable(first))
                return
            self._connection = connection
        self._know(first[-1])
        threading.Thread(target=self._listen, args=(connection,), name="ray", daemon=True).start()

    def _know(self, count: int) -> None:
        """How many processors compute by now; where there are none, so is what was under way."""
        self._count, self._heard = max(1, count), time.monotonic()
        if count:
            self.failure = None
            return
        with self._lock:
            self.failure = f"the Ray cluster at {self.address} has no machine to compute with"
            self._fail(Unavailable(self.failure))

    def _listen(self, connection: Connection) -> None:
        """Pass on results until there are no more."""
        while True:
            try:
                number, succeeded, result = connection.recv()
            except (OSError, EOFError):
                break
            if number == SIZE:
                self._know(result)
                continue
            with self._lock:
                future = self._futures.pop(number, None)
            # One that was cancelled in this moment takes no result.
            with contextlib.suppress(InvalidStateError):
                if future is not None and succeeded:
                    future.set_result(result)
                elif future is not None:
                    future.set_exception(result)
        with self._lock:
            if self._connection is connection:
                self._lost()

    def _lost(self) -> Unavailable:
        self.failure = f"the connection to the Ray cluster at {self.address} was lost"
        self._end(lost := Unavailable(self.failure))
        return lost

    def _end(self, error: Exception) -> None:
        ended(self._process, self._connection)
        self._process, self._connection = None, None
        self._fail(error)

    def _fail(self, error: Exception) -> None:
        """What is under way comes to nothing."""
        futures, self._futures = list(self._futures.values()), {}
        for future in futures:
            with contextlib.suppress(InvalidStateError):
                future.set_exception(error)


class _Part(Future[Any]):
    """A part under way, which cancelling ends on the cluster too."""

    def __init__(self, cluster: Cluster) -> None:
        super().__init__()
        self.number = -1
        self._cluster = cluster

    def cancel(self) -> bool:
        """End it."""
        self._cluster.drop(self.number)
        return super().cancel()
