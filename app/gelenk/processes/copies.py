"""Starts and ends processes that are copies of the fork server, each connected by a pipe."""

import atexit
import contextlib
import multiprocessing
import os
import signal
import socket
import struct
import subprocess
import sys
import threading
from collections.abc import Callable
from multiprocessing.connection import Connection

from gelenk.processes.fork_server import COPY, LOAD, NUMBER, WARM_UP

GOODBYE_SECONDS = 1.0
"""Longest wait for the end of a killed process, [s]."""
_BEGIN = """
import sys
sys.path[:] = sys.argv[3:]
from gelenk.processes import copies, fork_server
copies.reach_by(int(sys.argv[1]))
fork_server.main(int(sys.argv[2]))
"""


class Copy:
    """A copy of the fork server; safe to use from several threads.

    Args:
        pid: Process id.
        lifeline: Socket that delivers the exit code; closing it kills the process.

    Attributes:
        exitcode: Exit code, for example -9 after signal 9; None while it is unknown.
    """

    def __init__(self, pid: int, lifeline: socket.socket) -> None:
        self.pid, self.exitcode = pid, None
        self._lifeline, self._lock, self._is_over = lifeline, threading.Lock(), False

    def fileno(self) -> int:
        """Return a file descriptor that becomes readable when the process ends."""
        return self._lifeline.fileno()

    def is_alive(self) -> bool:
        """Check whether the process is still running."""
        self.join(0.0)
        return not self._is_over

    def join(self, seconds: float) -> None:
        """Wait for the end of the process, for at most this time, [s]."""
        with self._lock:
            if self._is_over:
                return
            self._lifeline.settimeout(seconds)
            try:
                told = self._lifeline.recv(NUMBER.size)
            except (TimeoutError, BlockingIOError):
                return
            except OSError:
                told = b""
            self._is_over = True
            if len(told) == NUMBER.size:
                self.exitcode = NUMBER.unpack(told)[0]

    def signal(self, number: signal.Signals) -> None:
        """Send a signal to the process if it still runs."""
        if self.is_alive():
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.pid, number)

    def end(self) -> None:
        """Kill the process, wait for its end, and close the lifeline."""
        self.signal(signal.SIGKILL)
        self.join(GOODBYE_SECONDS)
        self._lifeline.close()


class _Original:
    """Connection to the fork server, which this process has started or is a copy of."""

    def __init__(self) -> None:
        self._control: socket.socket | None = None
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()

    def begin(self) -> bool:
        """Start the fork server unless it runs, and return whether it was started."""
        with self._lock:
            if self._process is not None and self._process.poll() is not None:
                self.end()
            if self._control is not None:
                return False
            control, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
            # The fork server also gets this end, because its copies send requests too.
            descriptors = control.fileno(), theirs.fileno()
            command = [sys.executable, "-c", _BEGIN, *map(str, descriptors), *sys.path]
            with theirs:
                self._process = subprocess.Popen(command, stdin=subprocess.PIPE, pass_fds=descriptors)  # noqa: S603
            self._control = control
            return True

    def inherit(self, control: int) -> None:
        self._control = socket.socket(fileno=control)

    def ask(self, request: bytes, *descriptors: int) -> None:
        if self._control is None:
            raise ChildProcessError("there is nothing to copy")
        socket.send_fds(self._control, [request], descriptors)

    def end(self) -> None:
        if self._control is not None:
            self._control.close()
        if self._process is not None and self._process.stdin is not None:
            self._process.stdin.close()
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(GOODBYE_SECONDS)
        self._control = self._process = None


_original = _Original()
atexit.register(_original.end)


def begin() -> bool:
    """Start the fork server unless it runs; it loads the kernels only when `warm_up` requests that.

    Returns:
        Whether it was started.

    Raises:
        OSError: It could not be started.
    """
    return _original.begin()


def warm_up() -> socket.socket:
    """Let the fork server load the kernels, after it has made the copies requested before.

    Returns:
        A socket that becomes readable when the kernels are loaded.

    Raises:
        OSError: The fork server is gone.
    """
    ours, theirs = socket.socketpair()
    with theirs:
        _original.ask(WARM_UP, theirs.fileno())
    return ours


def load_seldom_needed() -> None:
    """Let the fork server load the seldom needed modules, so that later copies share them; do not wait."""
    with contextlib.suppress(OSError):
        _original.ask(LOAD)


def reach_by(control: int) -> None:
    """Set, in the fork server, the file descriptor over which its copies send it requests."""
    _original.inherit(control)


def started(target: Callable[[Connection], object], name: str) -> tuple[Copy, Connection]:
    """Start a process that runs a function with its end of a pipe; return the process and our end.

    The process ignores SIGINT and SIGTERM, because it ends together with the service, whatever it is doing.

    Args:
        target: Function to run; must be picklable.
        name: Name of the process in the system, after `gelenk-`; at most 8 letters.

    Raises:
        ChildProcessError: No process could be started.
    """
    ours, theirs = multiprocessing.Pipe()
    lifeline, far_end = socket.socketpair()
    try:
        with theirs, far_end:
            if begin():
                warm_up().close()
            _original.ask(COPY, theirs.fileno(), far_end.fileno())
        told = lifeline.recv(NUMBER.size)
        ours.send((name, target))
        return Copy(NUMBER.unpack(told)[0], lifeline), ours
    except (OSError, struct.error) as error:
        ours.close()
        lifeline.close()
        raise ChildProcessError("no process could be started") from error


def ended(process: Copy | None, connection: Connection | None) -> None:
    """Close our end of the pipe, kill the process and wait until it ends."""
    if connection is not None:
        connection.close()
    if process is not None:
        process.end()
