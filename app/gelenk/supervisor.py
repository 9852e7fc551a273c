"""Supervises several worker processes on one address, and replaces a failed one within a fraction of a second."""

import asyncio
import contextlib
import logging
import os
import signal
import socket
import sys
import time
from collections.abc import Iterator
from functools import partial
from multiprocessing import reduction
from multiprocessing.connection import Connection, wait
from typing import Any, cast

import uvicorn

from gelenk.connections import Gate
from gelenk.processes import copies
from gelenk.processes.copies import Copy

LISTENERS = 8
"""Number of connections that an event loop accepts per turn; each takes less than 0.1 ms."""
LEAVING_SECONDS = 0.5
"""How long requests are still accepted after SIGTERM, [s]; each response announces that its connection closes."""
STILL_STARTING = "still getting ready; where kernels must be compiled, once for a processor, it takes a minute or two"
STARTUP_FAILURE = 3
"""Exit code of a worker that could not start serving."""
_BEAT_SECONDS = 5.0
"""Interval of the heartbeats from a worker's event loop, [s]."""
_HANGS_SECONDS = 60.0
"""Time without a heartbeat after which a worker counts as hung, [s]."""
_PATIENCE_SECONDS = 2.5
"""Time to load the kernels before a worker serves without them, [s]; from the cache, they load faster."""
_SOON_SECONDS = 5.0
"""If a worker ends within this time after its start, [s], its replacement has to wait, because it may do the same."""
_LOOK_SECONDS = 0.5
_PAUSE_SECONDS, _MOST_PAUSE_SECONDS = 0.1, 10.0
_END_SECONDS = 1.0

logger = logging.getLogger("gelenk")


class Supervisor:
    """Starts the workers, watches them and replaces them.

    Args:
        config: Configuration of each worker; `workers` is their number.
        listener: Listening socket; it queues connections until a worker accepts them.
    """

    def __init__(self, config: uvicorn.Config, listener: socket.socket) -> None:
        self._config, self._listener = config, listener
        self._seats, self._early = [_Seat() for _ in range(config.workers)], _Seat()
        self._warming: socket.socket | None = None
        self._since = 0.0
        self._goes_on, self._has_told = True, False

    def run(self) -> None:
        """Serve until SIGINT or SIGTERM, or until a worker cannot start serving.

        Raises:
            SystemExit: A worker could not start serving.
        """
        wakes, woken = socket.socketpair()
        for end in (wakes, woken):
            end.setblocking(False)
        signal.set_wakeup_fd(wakes.fileno())
        for stop in (signal.SIGINT, signal.SIGTERM):
            signal.signal(stop, self._stop)
        looked = time.monotonic()
        while self._goes_on and not any(seat.cannot_begin for seat in self._seats):
            self._fill()
            ready = wait([woken, *self._signs()], timeout=_LOOK_SECONDS)
            now = time.monotonic()
            if self._warming is not None:
                self._look_after(self._warming, self._warming in ready)
            for seat in (*self._seats, self._early):
                # If this process was suspended, missing heartbeats prove nothing.
                seat.look(now, is_forgiving=now - looked > _BEAT_SECONDS)
            looked = now
        self._end()
        if self._goes_on:
            logger.error("a worker process could not start serving: the service ends")
            sys.exit(STARTUP_FAILURE)

    def _stop(self, *_: object) -> None:
        self._goes_on = False

    def _fill(self) -> None:
        """Start a worker on each free seat as soon as the fork server has loaded everything."""
        empty = [seat for seat in self._seats if seat.wants_worker]
        if not empty:
            return
        try:
            if copies.begin():
                self._since = time.monotonic()
                self._early.take(self._config, "early")
                self._warming = copies.warm_up()
            for seat in empty if self._warming is None else ():
                seat.take(self._config, "worker")
                seat.serve(self._listener)
        except OSError as error:
            logger.error("no worker process could be started: %s", error)
            for seat in empty:
                seat.rest()

    def _look_after(self, warming: socket.socket, is_over: bool) -> None:
        """Let an early worker report the service's state while the kernels are compiled, which may take a minute."""
        if is_over:
            warming.close()
            self._warming = None
            self._early.stop()
        elif time.monotonic() > self._since + _PATIENCE_SECONDS:
            if not self._has_told:
                print(STILL_STARTING, flush=True)
                self._has_told = True
            self._early.serve(self._listener)

    def _signs(self) -> list[int | socket.socket]:
        """Return what becomes readable when a worker or the warm-up needs attention."""
        found: list[int | socket.socket] = [one for seat in (*self._seats, self._early) for one in seat.signs]
        return found if self._warming is None else [*found, self._warming]

    def _end(self) -> None:
        """Let running requests finish, then kill the workers that do not end by themselves."""
        seats = [*self._seats, self._early]
        for seat in seats:
            seat.stop()
        self._listener.close()  # once all workers close theirs, no connection is accepted in vain
        until = time.monotonic() + LEAVING_SECONDS + (self._config.timeout_graceful_shutdown or 0) + _END_SECONDS
        for seat in seats:
            seat.leave(until)


class _Seat:
    """The place of one worker.

    Attributes:
        cannot_begin: Whether the worker could not start serving, and none here ever did, so a new one could not either.
    """

    def __init__(self) -> None:
        self._worker: Copy | None = None
        self._beats: Connection | None = None
        self._began = self._heard = self._empty_until = 0.0
        self._pause, self._has_served = _PAUSE_SECONDS, False
        self._serves = self._is_stopped = False
        self.cannot_begin = False

    @property
    def wants_worker(self) -> bool:
        return self._worker is None and time.monotonic() >= self._empty_until

    @property
    def signs(self) -> list[int]:
        """File descriptors that become readable when the worker needs attention."""
        return [one.fileno() for one in (self._worker, self._beats) if one is not None]

    def take(self, config: uvicorn.Config, name: str) -> None:
        """Start a worker unless this seat has one; it waits until `serve` lets it serve.

        Raises:
            OSError: No worker could be started.
        """
        if self._worker is None:
            self._worker, self._beats = copies.started(partial(work, config), name)
            self._began = self._heard = time.monotonic()
            self._is_stopped = self._serves = False

    def serve(self, listener: socket.socket) -> None:
        """Let the worker serve, by sending it the listening socket."""
        if self._worker is not None and self._beats is not None and not self._serves:
            self._serves = True
            with contextlib.suppress(OSError):  # the worker has ended; `look` notices that
                reduction.send_handle(self._beats, listener.fileno(), self._worker.pid)

    def look(self, now: float, is_forgiving: bool) -> None:
        """Read the worker's heartbeats, and release a worker that has ended or hangs."""
        if self._worker is None or self._beats is None:
            return
        with contextlib.suppress(EOFError, OSError):
            while self._beats.poll():
                self._beats.recv_bytes()
                self._has_served, self._heard = True, now
        if is_forgiving:
            self._heard = now
        hangs = now - self._heard > _HANGS_SECONDS
        if self._worker.is_alive() and not hangs:
            return
        pid, code = self._worker.pid, self._worker.exitcode
        self._let_go()
        if self._is_stopped:
            return
        self.cannot_begin = code == STARTUP_FAILURE and not self._has_served
        how = "hangs" if hangs else f"has ended with code {code}"
        logger.error("worker process %d %s; a new one replaces it", pid, how)
        if now - self._began < _SOON_SECONDS:
            self.rest()
        else:
            self._pause = _PAUSE_SECONDS

    def rest(self) -> None:
        """Leave the seat empty for a while, longer each time."""
        self._empty_until = time.monotonic() + self._pause
        self._pause = min(2.0 * self._pause, _MOST_PAUSE_SECONDS)

    def stop(self) -> None:
        """Let the worker end: SIGTERM if it serves, otherwise by killing it."""
        self._is_stopped = True
        if self._worker is not None and self._serves:
            self._worker.signal(signal.SIGTERM)
        elif self._worker is not None:
            self._let_go()

    def leave(self, until: float) -> None:
        """Wait for the worker to end, until this time of the monotonic clock, [s]; then kill it."""
        if self._worker is not None:
            self._worker.join(max(0.0, until - time.monotonic()))
            self._let_go()

    def _let_go(self) -> None:
        copies.ended(self._worker, self._beats)
        self._worker = self._beats = None


def work(config: uvicorn.Config, connection: Connection) -> None:
    """Serve requests; a worker process runs this function.

    Args:
        config: Configuration of the server.
        connection: Connection to the supervisor, which sends the listening socket and receives heartbeats.

    Raises:
        SystemExit: The worker could not start serving.
    """
    listener = socket.socket(fileno=reduction.recv_handle(connection))
    os.set_blocking(connection.fileno(), False)
    config.configure_logging()
    server = _Server(config, connection)
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, server.handle_exit)
    try:
        server.run(sockets=several(listener))
    except Exception:
        logger.exception("a worker process has failed")
    if not server.started:
        sys.exit(STARTUP_FAILURE)


def several(listener: socket.socket) -> list[socket.socket]:
    """Duplicate a listening socket `LISTENERS` - 1 times; all of them share one queue of connections.

    The event loop accepts one connection per turn from each socket. With a single one, the last of a thousand
    simultaneous connections would wait a thousand turns, and in each turn, earlier requests are answered.
    """
    # All duplicates in all workers share the blocking mode: a blocking one would block the workers that already serve.
    listener.setblocking(False)
    return [listener, *(listener.dup() for _ in range(LISTENERS - 1))]


def waiting(listener: socket.socket) -> Iterator[socket.socket]:
    """Accept and yield the pending connections of a non-blocking listening socket."""
    with contextlib.suppress(OSError):
        while True:
            yield listener.accept()[0]


class _Server(uvicorn.Server):
    """Server that sends heartbeats to the supervisor."""

    def __init__(self, config: uvicorn.Config, connection: Connection) -> None:
        super().__init__(config)
        self._connection = connection

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Start serving, and then the heartbeats."""
        await super().startup(sockets=sockets)
        if self.started:
            self._beat()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Stop serving, but first answer requests that clients are about to send over open connections."""
        gate: Gate = cast(partial[Any], self.config.http).keywords["gate"]
        gate.stop()
        until = time.monotonic() + LEAVING_SECONDS
        while gate.connections and time.monotonic() < until:
            await asyncio.sleep(0.05)
        # Connections still queued when the listener closes are cut off, so accept them right before, without an await.
        arrived = asyncio.gather(*map(self._let_in, waiting(sockets[0]) if sockets else ()))
        await super().shutdown(sockets)
        await arrived

    async def _let_in(self, connection: socket.socket) -> None:
        make: Any = self.config.http_protocol_class
        protocol = partial(make, config=self.config, server_state=self.server_state, app_state=self.lifespan.state)
        with contextlib.suppress(OSError):  # the client has already left
            await asyncio.get_running_loop().connect_accepted_socket(protocol, connection)

    def _beat(self) -> None:
        with contextlib.suppress(OSError):
            self._connection.send_bytes(b".")
        asyncio.get_running_loop().call_later(_BEAT_SECONDS, self._beat)
