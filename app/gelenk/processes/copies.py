"""Starting and ending a process at the other end of a pipe, as a copy of one that has loaded everything."""

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
"""How long to wait for the end of a killed process."""
_BEGIN = """
import sys
sys.path[:] = sys.argv[3:]
from gelenk.processes import copies, fork_server
copies.reach_by(int(sys.argv[1]))
fork_server.main(int(sys.argv[2]))
"""


class Copy:
    """A process that has been started; safe to use from several threads.

    Args:
        pid: Its number.
        lifeline: Where its exit code comes from.

    Attributes:
        exitcode: How it ended, for example -9 by signal 9; None while that is not known.
    """

    def __init__(self, pid: int, lifeline: socket.socket) -> None:
        self.pid, self.exitcode = pid, None
        self._lifeline, self._lock, self._is_over = lifeline, threading.Lock(), False

    def fileno(self) -> int:
        """What becomes readable when it ends."""
        return self._lifeline.fileno()

    def is_alive(self) -> bool:
        """Whether it is still running."""
        self.join(0.0)
        return not self._is_over

    def join(self, seconds: float) -> None:
        """Wait for its end for at most this time, [s]."""
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
        """Send it a signal, if it is still there."""
        if self.is_alive():
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.pid, number)

    def end(self) -> None:
        """Kill it, wait for its end, and release it."""
        self.signal(signal.SIGKILL)
        self.join(GOODBYE_SECONDS)
        self._lifeline.close()


class _Original:
    """The process that is copied, as this one knows it: started here, or inherited by a copy."""

    def __init__(self) -> None:
        self._control: socket.socket | None = None
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()

    def begin(self) -> bool:
        """Start it unless there is one, and return whether it was started."""
        with self._lock:
            if self._process is not None and self._process.poll() is not None:
                self.end()
            if self._control is not None:
                return False
            control, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
            # The copies ask it too: it keeps an end of its own for them.
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
    """Start the process that is copied where there is none; it does not yet load what `warm_up` is for.

    Returns:
        Whether there was none.

    Raises:
        OSError: It could not be started.
    """
    return _original.begin()


def warm_up() -> socket.socket:
    """Have it load what takes long, after it has made the copies requested before.

    Returns:
        A descriptor that becomes readable when that is done.

    Raises:
        OSError: It is gone.
    """
    ours, theirs = socket.socketpair()
    with theirs:
        _original.ask(WARM_UP, theirs.fileno())
    return ours


def load_seldom_needed() -> None:
    """Have it load what few requests need, so that later copies share it; do not wait."""
    with contextlib.suppress(OSError):
        _original.ask(LOAD)


def reach_by(control: int) -> None:
    """Set, in the process that is copied, how its copies reach it."""
    _original.inherit(control)


def started(target: Callable[[Connection], object], name: str) -> tuple[Copy, Connection]:
    """A new process that runs a function with its end of a pipe, and our end.

    It ignores SIGINT and SIGTERM: the service ends first, and its processes with it, whatever they are doing.

    Args:
        target: One that can be pickled.
        name: What the system calls it, after `gelenk-`; at most 8 letters.

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
    """Close our end, kill the process and wait for its end."""
    if connection is not None:
        connection.close()
    if process is not None:
        process.end()
