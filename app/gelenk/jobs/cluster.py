"""Computes parts of jobs on a Ray cluster, through a process that runs `driver` at the other end of a pipe.

Ray terminates its own process when it loses the cluster, and that process must not be the service. If the process ends
or falls silent, or no machine of the cluster computes any more, the parts in progress fail with `Unavailable`. Only
`prepare` reconnects to the cluster.
"""

import contextlib
import itertools
import socket
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future, InvalidStateError
from functools import partial
from signal import SIGKILL
from typing import Any

from gelenk.jobs.driver import SIZE, Driver
from gelenk.jobs.workers import Cancelled, Unavailable
from gelenk.processes import wire
from gelenk.processes.worker_process import WorkerProcess

_ANSWER_SECONDS, _CONNECT_SECONDS = 5.0, 30.0
"""How long the cluster's head may take to accept a connection, and `driver` to send its first message, [s]."""
_SILENCE_SECONDS = 15.0
"""Silence after which the process that runs `driver`, which sends a message every second, counts as hung, [s]."""


class Cluster:
    """Computes parts on the Ray cluster of a head `host:port`, to which this machine belongs; safe in all threads."""

    def __init__(self, address: str) -> None:
        self.address = address
        self.failure: str | None = f"the Ray cluster at {address} has not answered yet"
        self._lock = threading.Lock()
        self._process: WorkerProcess | None = None
        self._heard = 0.0
        self._futures: dict[int, Future[Any]] = {}
        self._numbers = itertools.count()
        self._count = 1
        self._closed = threading.Event()

    @property
    def count(self) -> int:
        """Number of processors on the machines that were last known to compute; at least 1."""
        return self._count

    def prepare(self) -> None:
        """Connect to the cluster if necessary; set `failure` if that fails. Only one thread at a time may call it."""
        if self._process is None:
            self._connect()
        elif time.monotonic() > self._heard + _SILENCE_SECONDS:
            self._kill()  # `_listen` then reports the connection as lost

    def submit(self, function: Callable[[Any], Any], argument: Any, _: float) -> "Future[Any]":
        """Submit a part as `PoolExecutor.submit`, but without deadline; raises Unavailable if no machine computes."""
        if self._closed.is_set():
            raise Cancelled
        with self._lock:
            if self._process is None or self.failure is not None:
                raise Unavailable(self.failure)
            number = next(self._numbers)
            future: Future[Any] = Future()
            self._futures[number] = future
            try:
                wire.send(self._process.socket, (number, (function, argument)))
            except OSError as error:
                raise self._disconnect() from error
        future.add_done_callback(partial(self._drop, number))
        return future

    def _drop(self, number: int, future: "Future[Any]") -> None:
        if not future.cancelled():
            return
        with self._lock:
            if self._futures.pop(number, None) is not None and self._process is not None:
                try:
                    wire.send(self._process.socket, (number, None))
                except OSError:
                    self._disconnect()

    def close(self) -> None:
        """Stop all parts, even if the other process hangs, and reject later ones."""
        self._closed.set()
        self._kill()
        with self._lock:
            self._end(Cancelled())

    def _kill(self) -> None:
        """Kill the process that runs `driver`, so that no thread waits for it any longer; this needs no lock."""
        if (process := self._process) is not None:
            process.signal(SIGKILL)

    def _connect(self) -> None:
        try:
            # Ray would wait for minutes if the head were missing.
            host, _, port = self.address.rpartition(":")
            socket.create_connection((host.strip("[]"), int(port)), _ANSWER_SECONDS).close()
            self._process = process = WorkerProcess.start(Driver(self.address), "ray")
            if self._closed.is_set():
                self._kill()
            process.socket.settimeout(_CONNECT_SECONDS)
            first = wire.receive(process.socket)
            process.socket.settimeout(None)
        except (OSError, EOFError) as error:
            reason = error.strerror if isinstance(error, OSError) and error.strerror else "it does not answer"
            first = f"the Ray cluster at {self.address} cannot be reached: {reason}"
        with self._lock:
            if isinstance(first, str):
                self.failure = first
                self._end(Unavailable(first))
                return
        self._update_count(first[-1])
        threading.Thread(target=self._listen, args=(process,), name="ray", daemon=True).start()

    def _update_count(self, count: int) -> None:
        """Record the number of processors that compute now; if it is zero, let the parts in progress fail."""
        self._count, self._heard = max(1, count), time.monotonic()
        if count:
            self.failure = None
            return
        with self._lock:
            self.failure = f"the Ray cluster at {self.address} has no machine to compute with"
            self._fail(Unavailable(self.failure))

    def _listen(self, process: WorkerProcess) -> None:
        while True:
            try:
                number, succeeded, result = wire.receive(process.socket)
            except (OSError, EOFError):
                break
            if number == SIZE:
                self._update_count(result)
                continue
            with self._lock:
                future = self._futures.pop(number, None)
            # A future that was cancelled at this moment accepts no result.
            with contextlib.suppress(InvalidStateError):
                if future is not None and succeeded:
                    future.set_result(result)
                elif future is not None:
                    future.set_exception(result)
        with self._lock:
            if self._process is process:
                self._disconnect()

    def _disconnect(self) -> Unavailable:
        self.failure = f"the connection to the Ray cluster at {self.address} was lost"
        self._end(lost := Unavailable(self.failure))
        return lost

    def _end(self, error: Exception) -> None:
        if self._process is not None:
            self._process.close()
            self._process = None
        self._fail(error)

    def _fail(self, error: Exception) -> None:
        futures, self._futures = list(self._futures.values()), {}
        for future in futures:
            with contextlib.suppress(InvalidStateError):
                future.set_exception(error)
