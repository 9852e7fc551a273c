"""Handle of a child process, which the fork server starts within milliseconds, and the client of that server."""

import atexit
import contextlib
import os
import signal
import socket
import struct
import subprocess
import sys
import threading
from collections.abc import Callable
from typing import Any

from gelenk.processes import wire
from gelenk.processes.fork_server import FORK, LOAD, NUMBER, WARM_UP

KILL_SECONDS = 1.0
"""How long to wait for a killed process to end, [s]."""
_PROGRAM = """
import sys
sys.path[:] = sys.argv[3:]
from gelenk.processes import fork_server, worker_process
worker_process.FORK_SERVER.inherit(int(sys.argv[1]))
fork_server.main(int(sys.argv[2]))
"""


class WorkerProcess:
    """Handle of a child process; safe to use from several threads.

    The process ignores SIGINT and SIGTERM unless it sets handlers; it is killed when the service ends. `exitcode` is
    minus the number of a signal that ended it, and None while unknown.
    """

    def __init__(self, pid: int, to_process: socket.socket, lifeline: socket.socket) -> None:
        self.pid, self.socket = pid, to_process
        self.exitcode: int | None = None
        self._lifeline, self._lock, self._has_ended = lifeline, threading.Lock(), False

    @classmethod
    def start(cls, target: Callable[[socket.socket], object], name: str) -> "WorkerProcess":
        """Start a process that calls a picklable function with its end of the socket; raises ChildProcessError.

        The very first start takes seconds. The system shows `gelenk-` and the name, which has at most 8 letters.
        """
        (ours, theirs), (lifeline, far_end) = socket.socketpair(), socket.socketpair()
        try:
            for end in (ours, theirs):
                end.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, wire.BUFFER)
            with theirs, far_end:
                if FORK_SERVER.start():
                    FORK_SERVER.warm_up().close()
                FORK_SERVER.request(FORK, theirs.fileno(), far_end.fileno())
            (pid,) = NUMBER.unpack(lifeline.recv(NUMBER.size))
            wire.send(ours, (name, target))
            return cls(pid, ours, lifeline)
        except (OSError, struct.error) as error:
            ours.close()
            lifeline.close()
            raise ChildProcessError("no process could be started") from error

    @property
    def exit_reason(self) -> str:
        """Name of the signal that ended the process, or its exit code as text."""
        code = self.exitcode
        return signal.Signals(-code).name if code is not None and code < 0 else f"exit code {code}"

    def fileno(self) -> int:
        """Return a file descriptor that becomes readable when the process ends."""
        return self._lifeline.fileno()

    def is_alive(self) -> bool:
        """Check whether the process is still running."""
        self.join(0.0)
        return not self._has_ended

    def is_silent(self) -> bool:
        """Check that no data is pending and the other end is open; it closes before `is_alive` returns False."""
        try:
            self.socket.recv(1, socket.MSG_PEEK | socket.MSG_DONTWAIT)
        except BlockingIOError:
            return True
        except OSError:
            pass
        return False

    def join(self, seconds: float) -> None:
        """Wait at most `seconds` for the process to end."""
        with self._lock:
            if self._has_ended:
                return
            try:
                self._lifeline.settimeout(seconds)
                content = self._lifeline.recv(NUMBER.size)
            except (TimeoutError, BlockingIOError):
                return
            except OSError:
                content = b""
            self._has_ended = True
            if len(content) == NUMBER.size:
                (self.exitcode,) = NUMBER.unpack(content)

    async def ask(self, message: Any) -> Any:
        """Send a message over the non-blocking socket, return its answer; EOFError or OSError if the process ends."""
        await wire.send_async(self.socket, message)
        return await wire.receive_async(self.socket)

    def signal(self, number: signal.Signals) -> None:
        """Send the process a signal if it is still running."""
        if self.is_alive():
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.pid, number)

    def kill(self) -> None:
        """Kill the process and wait for its end; a pending `ask` then raises an error, because the other end closes."""
        self.signal(signal.SIGKILL)
        self.join(KILL_SECONDS)

    def close(self) -> None:
        """Kill the process and close the sockets; no `ask` may be pending."""
        self.kill()
        self.socket.close()
        self._lifeline.close()


class ForkServerClient:
    """Client of the fork server, which this process either started or was forked from."""

    def __init__(self) -> None:
        self._control: socket.socket | None = None
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()

    def start(self) -> bool:
        """Start the fork server if it is not running, and return whether it was not; `warm_up` loads the kernels."""
        with self._lock:
            if self._process is not None and self._process.poll() is not None:
                self.close()
            if self._control is not None:
                return False
            control, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
            # The fork server also gets this end, for its children to send requests.
            descriptors = control.fileno(), theirs.fileno()
            command = [sys.executable, "-c", _PROGRAM, *map(str, descriptors), *sys.path]
            with theirs:
                self._process = subprocess.Popen(command, stdin=subprocess.PIPE, pass_fds=descriptors)  # noqa: S603
            self._control = control
            return True

    def inherit(self, control: int) -> None:
        """Set, in the fork server, the socket over which its children send it requests."""
        self._control = socket.socket(fileno=control)

    def warm_up(self) -> socket.socket:
        """Let the fork server load the kernels, after earlier requests; the socket becomes readable when it is done."""
        ours, theirs = socket.socketpair()
        with theirs:
            self.request(WARM_UP, theirs.fileno())
        return ours

    def load_seldom_needed(self) -> None:
        """Let the fork server load modules that few requests need, for later processes to share; do not wait for it."""
        with contextlib.suppress(OSError):
            self.request(LOAD)

    def request(self, what: bytes, *descriptors: int) -> None:
        """Send a request and file descriptors to the fork server; OSError if it has ended or was never started."""
        if self._control is None:
            raise ChildProcessError("the fork server is not running")
        socket.send_fds(self._control, [what], descriptors)

    def close(self) -> None:
        """End the fork server if this process started it, and with it all its children."""
        if self._control is not None:
            self._control.close()
        if self._process is not None and self._process.stdin is not None:
            self._process.stdin.close()
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(KILL_SECONDS)
        self._control = self._process = None


FORK_SERVER = ForkServerClient()
atexit.register(FORK_SERVER.close)
