"""Several worker processes on one address: watched, and replaced within a fraction of a second."""

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
"""Connections accepted in one turn of an event loop, each in less than a tenth of a millisecond."""
LEAVING_SECONDS = 0.5
"""How long requests are still accepted after SIGTERM; each answer says that its connection closes, [s]."""
STILL_STARTING = "still getting ready; where kernels must be compiled, once for a processor, it takes a minute or two"
STARTUP_FAILURE = 3
"""How a worker ends that could not begin to serve."""
_BEAT_SECONDS = 5.0
"""How often a worker says that its event loop goes on."""
_HANGS_SECONDS = 60.0
"""After how long without a word a worker is taken to hang."""
_PATIENCE_SECONDS = 2.5
"""How long the kernels may take before a worker is wanted without them: from their cache they come sooner."""
_SOON_SECONDS = 5.0
"""A worker that ends sooner after its beginning than this may do so again: the next one has to wait."""
_LOOK_SECONDS = 0.5
_PAUSE_SECONDS, _MOST_PAUSE_SECONDS = 0.1, 10.0
_END_SECONDS = 1.0

logger = logging.getLogger("gelenk")


class Supervisor:
    """Starts the workers, and watches over them.

    Args:
        config: What each of them serves, and how; `workers` is how many there are.
        listener: Where requests come in; it queues them until a worker accepts them.
    """

    def __init__(self, config: uvicorn.Config, listener: socket.socket) -> None:
        self._config, self._listener = config, listener
        self._seats, self._early = [_Seat() for _ in range(config.workers)], _Seat()
        self._warming: socket.socket | None = None
        self._since = 0.0
        self._goes_on, self._has_told = True, False

    def run(self) -> None:
        """Serve until SIGINT or SIGTERM, or until a worker cannot even begin to.

        Raises:
            SystemExit: The latter.
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
                # Who was stopped itself cannot blame others for their silence.
                seat.look(now, is_forgiving=now - looked > _BEAT_SECONDS)
            looked = now
        self._end()
        if self._goes_on:
            logger.error("a worker process could not start serving: the service ends")
            sys.exit(STARTUP_FAILURE)

    def _stop(self, *_: object) -> None:
        self._goes_on = False

    def _fill(self) -> None:
        """A worker on each seat that wants one, as soon as what they are copied from has loaded everything."""
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
        """Where the kernels are compiled, which may take a minute, let an early worker say how things are."""
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
        """What becomes readable when there is something to look at."""
        found: list[int | socket.socket] = [one for seat in (*self._seats, self._early) for one in seat.signs]
        return found if self._warming is None else [*found, self._warming]

    def _end(self) -> None:
        """Let requests in flight finish; what does not end by itself is killed."""
        seats = [*self._seats, self._early]
        for seat in seats:
            seat.stop()
        self._listener.close()  # when the last worker has closed its own, nobody is let in whom nobody will answer
        until = time.monotonic() + LEAVING_SECONDS + (self._config.timeout_graceful_shutdown or 0) + _END_SECONDS
        for seat in seats:
            seat.leave(until)


class _Seat:
    """The place of one worker.

    Attributes:
        cannot_begin: Whether the first one that was here could not begin to serve: no other one could.
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
        """File descriptors that become readable when there is something to look at."""
        return [one.fileno() for one in (self._worker, self._beats) if one is not None]

    def take(self, config: uvicorn.Config, name: str) -> None:
        """Have a worker here, which waits for the word to serve.

        Raises:
            OSError: None could be started.
        """
        if self._worker is None:
            self._worker, self._beats = copies.started(partial(work, config), name)
            self._began = self._heard = time.monotonic()
            self._is_stopped = self._serves = False

    def serve(self, listener: socket.socket) -> None:
        """Let the worker serve."""
        if self._worker is not None and self._beats is not None and not self._serves:
            self._serves = True
            with contextlib.suppress(OSError):  # it has ended: `look` will see that
                reduction.send_handle(self._beats, listener.fileno(), self._worker.pid)

    def look(self, now: float, is_forgiving: bool) -> None:
        """Listen to the worker, and let go of one that has ended or hangs."""
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
        """Stay empty for a while, longer each time."""
        self._empty_until = time.monotonic() + self._pause
        self._pause = min(2.0 * self._pause, _MOST_PAUSE_SECONDS)

    def stop(self) -> None:
        """Tell the worker to end; one that does not serve yet does so when its connection ends."""
        self._is_stopped = True
        if self._worker is not None and self._serves:
            self._worker.signal(signal.SIGTERM)
        elif self._worker is not None:
            self._let_go()

    def leave(self, until: float) -> None:
        """Wait for the worker's end until then, and kill it where it does not come."""
        if self._worker is not None:
            self._worker.join(max(0.0, until - time.monotonic()))
            self._let_go()

    def _let_go(self) -> None:
        copies.ended(self._worker, self._beats)
        self._worker = self._beats = None


def work(config: uvicorn.Config, connection: Connection) -> None:
    """Serve; what a worker process does.

    Args:
        config: What, and how.
        connection: To the supervisor: the listening socket comes from there, and beats go there.

    Raises:
        SystemExit: It could not begin.
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
    """One listening socket as several, all on one queue of connections.

    The event loop takes one connection a turn from each. From a single one it would take a thousand turns until the
    last of a thousand that have come at once is accepted, and in each turn those before it are being answered.
    """
    # All of them, in all workers, share one mode: a copy in another one would make those block that serve already.
    listener.setblocking(False)
    return [listener, *(listener.dup() for _ in range(LISTENERS - 1))]


def waiting(listener: socket.socket) -> Iterator[socket.socket]:
    """The pending connections of a non-blocking listening socket."""
    with contextlib.suppress(OSError):
        while True:
            yield listener.accept()[0]


class _Server(uvicorn.Server):
    """A server that says that it goes on."""

    def __init__(self, config: uvicorn.Config, connection: Connection) -> None:
        super().__init__(config)
        self._connection = connection

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Begin to serve."""
        await super().startup(sockets=sockets)
        if self.started:
            self._beat()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """End; a client that is just about to ask again over an open connection is answered before it is closed."""
        gate: Gate = cast(partial[Any], self.config.http).keywords["gate"]
        gate.stop()
        until = time.monotonic() + LEAVING_SECONDS
        while gate.connections and time.monotonic() < until:
            await asyncio.sleep(0.05)
        # Who stands in the queue when it is closed is cut off: it is emptied first, and there is no wait in between.
        arrived = asyncio.gather(*map(self._let_in, waiting(sockets[0]) if sockets else ()))
        await super().shutdown(sockets)
        await arrived

    async def _let_in(self, connection: socket.socket) -> None:
        make: Any = self.config.http_protocol_class
        protocol = partial(make, config=self.config, server_state=self.server_state, app_state=self.lifespan.state)
        with contextlib.suppress(OSError):  # it has left already
            await asyncio.get_running_loop().connect_accepted_socket(protocol, connection)

    def _beat(self) -> None:
        with contextlib.suppress(OSError):
            self._connection.send_bytes(b".")
        asyncio.get_running_loop().call_later(_BEAT_SECONDS, self._beat)
