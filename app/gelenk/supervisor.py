"""Supervises the worker processes that serve one address; replaces failed ones within a fraction of a second."""

import asyncio
import contextlib
import logging
import signal
import socket
import sys
import time
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import chain
from multiprocessing.connection import wait
from typing import Any, cast

import uvicorn

from gelenk.connections import Gate
from gelenk.processes.worker_process import FORK_SERVER, WorkerProcess

LISTENERS = 8
"""Number of connections that an event loop accepts per turn; each takes less than 0.1 ms."""
LEAVING_SECONDS = 0.5
"""How long to accept requests after SIGTERM, [s]; each response announces that its connection closes."""
STILL_STARTING = "still starting; if kernels must be compiled, once per processor, this takes a minute or two"
STARTUP_FAILURE = 3
"""Exit code of a worker that could not start serving."""
_BEAT_SECONDS = 5.0
"""Interval of the heartbeats from a worker's event loop, [s]."""
_HANGS_SECONDS = 60.0
"""Time without a heartbeat after which a worker counts as hung, [s]."""
_PATIENCE_SECONDS = 2.5
"""Time to wait for the kernels before a worker serves without them, [s]; cached kernels load faster."""
_SOON_SECONDS = 5.0
"""If a worker ends within this time after its start, [s], its replacement starts with a delay, as it may fail too."""
_LOOK_SECONDS = 0.5
_PAUSE_SECONDS, _MOST_PAUSE_SECONDS = 0.1, 10.0
_MOST_LISTENERS = 128
_END_SECONDS = 1.0

logger = logging.getLogger("gelenk")


class Supervisor:
    """Starts the workers, watches them and replaces them.

    The listening sockets, one for each worker, stay open here and queue connections, which the replacement of a failed
    worker then answers.
    """

    def __init__(self, config: uvicorn.Config, listeners: Sequence[socket.socket]) -> None:
        self._listeners, self._grace = listeners, config.timeout_graceful_shutdown or 0
        self._workers = [Worker(config, "worker", [listener]) for listener in listeners]
        self._early = Worker(config, "early", listeners)
        self._warming: socket.socket | None = None
        self._since = 0.0
        self._is_running, self._has_announced = True, False

    def run(self) -> None:
        """Serve until SIGINT or SIGTERM, or until a worker cannot start serving, which raises SystemExit."""
        wakes, woken = socket.socketpair()
        for end in (wakes, woken):
            end.setblocking(False)
        signal.set_wakeup_fd(wakes.fileno())
        for stop in (signal.SIGINT, signal.SIGTERM):
            signal.signal(stop, self._stop)
        looked = time.monotonic()
        while self._is_running and not any(worker.cannot_start for worker in self._workers):
            self._fill()
            ready = wait([woken, *self._watched()], timeout=_LOOK_SECONDS)
            now = time.monotonic()
            if self._warming is not None:
                self._watch_warm_up(self._warming, self._warming in ready)
            for worker in (*self._workers, self._early):
                # If this process was suspended, missing heartbeats prove nothing.
                worker.check(now, is_forgiving=now - looked > _BEAT_SECONDS)
            looked = now
        self._end()
        if self._is_running:
            logger.error("a worker process could not start serving: stopping the service")
            sys.exit(STARTUP_FAILURE)

    def _stop(self, *_: object) -> None:
        self._is_running = False

    def _fill(self) -> None:
        """Start missing workers if the fork server has loaded everything; start the fork server first if necessary."""
        missing = [worker for worker in self._workers if worker.is_due]
        if not missing:
            return
        try:
            if FORK_SERVER.start():
                self._since = time.monotonic()
                self._early.start()
                self._warming = FORK_SERVER.warm_up()
            for worker in missing if self._warming is None else ():
                worker.start()
                worker.serve()
        except OSError as error:
            logger.error("no worker process could be started: %s", error)
            for worker in missing:
                worker.back_off()

    def _watch_warm_up(self, warming: socket.socket, is_over: bool) -> None:
        """Let an early worker report the service's state while kernels are compiled, which may take a minute."""
        if is_over:
            warming.close()
            self._warming = None
            self._early.stop()
        elif time.monotonic() > self._since + _PATIENCE_SECONDS:
            if not self._has_announced:
                print(STILL_STARTING, flush=True)
                self._has_announced = True
            self._early.serve()

    def _watched(self) -> list[int | socket.socket]:
        found: list[int | socket.socket] = [one for worker in (*self._workers, self._early) for one in worker.watched]
        return found if self._warming is None else [*found, self._warming]

    def _end(self) -> None:
        """Let requests in flight finish, then kill the workers that have not ended in time."""
        workers = [*self._workers, self._early]
        for worker in workers:
            worker.stop()
        for listener in self._listeners:
            # Once its worker closes it too, clients are refused instead of waiting for an answer in vain.
            listener.close()
        until = time.monotonic() + LEAVING_SECONDS + self._grace + _END_SECONDS
        for worker in workers:
            worker.join(until)


class Worker:
    """A worker process and its replacements; the system shows its name after `gelenk-`.

    `cannot_start` says that a process failed to start serving before any had served; a replacement would fail too.
    """

    def __init__(self, config: uvicorn.Config, name: str, listeners: Sequence[socket.socket]) -> None:
        self._config, self._name, self._listeners = config, name, listeners
        self.process: WorkerProcess | None = None
        self._started = self._heard = self._due = 0.0
        self._pause, self._has_served = _PAUSE_SECONDS, False
        self._is_serving = self._is_stopped = False
        self.cannot_start = False

    @property
    def is_due(self) -> bool:
        """Whether no process is running and one may be started now."""
        return self.process is None and time.monotonic() >= self._due

    @property
    def watched(self) -> list[int]:
        """File descriptors that become readable when there is something to check."""
        return [] if self.process is None else [self.process.fileno(), self.process.socket.fileno()]

    def start(self) -> None:
        """Start a process, unless one is running; it waits until `serve` is called. Raises OSError if that fails."""
        if self.process is None:
            self.process = WorkerProcess.start(partial(work, self._config), self._name)
            self._started = self._heard = time.monotonic()
            self._is_stopped = self._is_serving = False

    def serve(self) -> None:
        """Send the process its listening sockets, so that it starts serving."""
        if self.process is not None and not self._is_serving:
            self._is_serving = True
            with contextlib.suppress(OSError):  # the process has ended; `check` handles that
                listeners = [listener.fileno() for listener in self._listeners]
                socket.send_fds(self.process.socket, [b"."], listeners)

    def check(self, now: float, is_forgiving: bool) -> None:
        """Receive heartbeats, and close the process if it has ended or hangs; `is_forgiving` ignores missing ones."""
        process = self.process
        if process is None:
            return
        with contextlib.suppress(OSError):
            if process.socket.recv(4096, socket.MSG_DONTWAIT):
                self._has_served, self._heard = True, now
        if is_forgiving:
            self._heard = now
        hangs = now - self._heard > _HANGS_SECONDS
        if process.is_alive() and not hangs:
            return
        code = process.exitcode
        self._close()
        if self._is_stopped:
            return
        self.cannot_start = code == STARTUP_FAILURE and not self._has_served
        how = "hangs" if hangs else f"has ended with code {code}"
        logger.error("worker process %d %s; a new one replaces it", process.pid, how)
        if now - self._started < _SOON_SECONDS:
            self.back_off()
        else:
            self._pause = _PAUSE_SECONDS

    def back_off(self) -> None:
        """Delay the next start; double the delay each time, up to a limit."""
        self._due = time.monotonic() + self._pause
        self._pause = min(2.0 * self._pause, _MOST_PAUSE_SECONDS)

    def stop(self) -> None:
        """Send SIGTERM to the process, or kill it if it is not serving yet."""
        self._is_stopped = True
        if self.process is not None and self._is_serving:
            self.process.signal(signal.SIGTERM)
        else:
            self._close()

    def join(self, until: float) -> None:
        """Wait for the process to end; kill it at the time `until`, on the clock of `time.monotonic`, [s]."""
        if self.process is not None:
            self.process.join(max(0.0, until - time.monotonic()))
            self._close()

    def _close(self) -> None:
        if self.process is not None:
            self.process.close()
            self.process = None


def work(config: uvicorn.Config, connection: socket.socket) -> None:
    """Serve requests, as the main function of a worker process; raises SystemExit if it cannot start serving.

    The supervisor sends the listening sockets over the connection, and receives heartbeats.
    """
    _, descriptors, _, _ = socket.recv_fds(connection, 1, _MOST_LISTENERS)
    listeners = [socket.socket(fileno=descriptor) for descriptor in descriptors]
    connection.setblocking(False)
    config.configure_logging()
    server = _Server(config, connection)
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, server.handle_exit)
    try:
        server.run(sockets=[one for listener in listeners for one in several(listener)])
    except Exception:
        logger.exception("a worker process has failed")
    if not server.started:
        sys.exit(STARTUP_FAILURE)


def several(listener: socket.socket) -> list[socket.socket]:
    """Duplicate a listening socket `LISTENERS` - 1 times; all of them share one queue of connections.

    The event loop accepts one connection per turn from each socket. With a single one, the last of a thousand
    simultaneous connections would wait a thousand turns, and in each turn, earlier requests are answered.
    """
    # All duplicates in all workers share the blocking mode; a blocking socket would block workers that already serve.
    listener.setblocking(False)
    return [listener, *(listener.dup() for _ in range(LISTENERS - 1))]


def waiting(listener: socket.socket) -> Iterator[socket.socket]:
    """Accept and yield the pending connections of a non-blocking listening socket."""
    with contextlib.suppress(OSError):
        while True:
            yield listener.accept()[0]


class _Server(uvicorn.Server):
    """Server that sends heartbeats to the supervisor."""

    def __init__(self, config: uvicorn.Config, connection: socket.socket) -> None:
        super().__init__(config)
        self._connection = connection

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
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
        # Closing a listener resets the connections in its queue, so accept them just before, without an await between.
        arrived = asyncio.gather(*map(self._let_in, chain.from_iterable(map(waiting, sockets or ()))))
        await super().shutdown(sockets)
        await arrived

    async def _let_in(self, connection: socket.socket) -> None:
        make: Any = self.config.http_protocol_class
        protocol = partial(make, config=self.config, server_state=self.server_state, app_state=self.lifespan.state)
        with contextlib.suppress(OSError):  # the client has already left
            await asyncio.get_running_loop().connect_accepted_socket(protocol, connection)

    def _beat(self) -> None:
        with contextlib.suppress(OSError):
            self._connection.send(b".")
        asyncio.get_running_loop().call_later(_BEAT_SECONDS, self._beat)
