"""A child process and the socket to it: started within milliseconds by the fork server, asked, and killed."""

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
"""How long to wait for the end of a killed process."""
_PROGRAM = """
import sys
sys.path[:] = sys.argv[3:]
from gelenk.processes import fork_server, worker_process
worker_process.FORK_SERVER.inherit(int(sys.argv[1]))
fork_server.main(int(sys.argv[2]))
"""


class WorkerProcess:
    """A child process; safe to use from several threads.

    It ignores SIGINT and SIGTERM: the service ends first, and its processes with it, whatever they are doing.

    Attributes:
        pid: Its process id.
        socket: To the process; carries the messages of `wire`.
        exitcode: How it ended, for example -9 by signal 9; None while that is unknown.
    """

    def __init__(self, pid: int, to_process: socket.socket, lifeline: socket.socket) -> None:
        self.pid, self.socket = pid, to_process
        self.exitcode: int | None = None
        self._lifeline, self._lock, self._has_ended = lifeline, threading.Lock(), False

    @classmethod
    def start(cls, target: Callable[[socket.socket], object], name: str) -> "WorkerProcess":
        """Start a process that calls a function with its end of the socket; takes seconds for the very first one.

        Args:
            target: One that can be pickled.
            name: What the system calls the process, after `gelenk-`; at most 8 letters.

        Raises:
            ChildProcessError: No process could be started.
        """
        (ours, theirs), (lifeline, far_end) = socket.socketpair(), socket.socketpair()
        try:
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
        """How it ended: the name of a signal, or its exit code."""
        code = self.exitcode
        return signal.Signals(-code).name if code is not None and code < 0 else f"exit code {code}"

    def fileno(self) -> int:
        """A file descriptor that becomes readable when the process ends."""
        return self._lifeline.fileno()

    def is_alive(self) -> bool:
        """Whether it is still running."""
        self.join(0.0)
        return not self._has_ended

    def is_silent(self) -> bool:
        """Whether it has neither sent anything nor closed its end, which shows sooner than its end."""
        try:
            self.socket.recv(1, socket.MSG_PEEK | socket.MSG_DONTWAIT)
        except BlockingIOError:
            return True
        except OSError:
            pass
        return False

    def join(self, seconds: float) -> None:
        """Wait for its end for at most this time, [s]."""
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
        """The answer to a message, on an event loop; the socket must not block.

        Raises:
            EOFError: The process has ended.
            OSError: The same, in the middle of something.
        """
        await wire.send_async(self.socket, message)
        return await wire.receive_async(self.socket)

    def signal(self, number: signal.Signals) -> None:
        """Send it a signal, if it is still there."""
        if self.is_alive():
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.pid, number)

    def kill(self) -> None:
        """Kill it and wait for its end; whoever waits for a message sees the socket closed."""
        self.signal(signal.SIGKILL)
        self.join(KILL_SECONDS)

    def close(self) -> None:
        """Kill it and release the sockets; nobody may be waiting for a message."""
        self.kill()
        self.socket.close()
        self._lifeline.close()


class ForkServerClient:
    """The fork server as this process knows it: started here, or inherited from it."""

    def __init__(self) -> None:
        self._control: socket.socket | None = None
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()

    def start(self) -> bool:
        """Start the fork server where there is none; it does not yet load what `warm_up` is for.

        Returns:
            Whether there was none.

        Raises:
            OSError: It could not be started.
        """
        with self._lock:
            if self._process is not None and self._process.poll() is not None:
                self.close()
            if self._control is not None:
                return False
            control, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
            # Its children use it too: it keeps an end of its own for them.
            descriptors = control.fileno(), theirs.fileno()
            command = [sys.executable, "-c", _PROGRAM, *map(str, descriptors), *sys.path]
            with theirs:
                self._process = subprocess.Popen(command, stdin=subprocess.PIPE, pass_fds=descriptors)  # noqa: S603
            self._control = control
            return True

    def inherit(self, control: int) -> None:
        """Set, in the fork server, how its children reach it."""
        self._control = socket.socket(fileno=control)

    def warm_up(self) -> socket.socket:
        """Have it load what takes long, after it has started the processes requested before.

        Returns:
            A socket that becomes readable when that is done.

        Raises:
            OSError: It is gone.
        """
        ours, theirs = socket.socketpair()
        with theirs:
            self.request(WARM_UP, theirs.fileno())
        return ours

    def load_seldom_needed(self) -> None:
        """Have it load what few requests need, so that later processes share it; do not wait."""
        with contextlib.suppress(OSError):
            self.request(LOAD)

    def request(self, what: bytes, *descriptors: int) -> None:
        """Send a request.

        Raises:
            OSError: It is gone.
        """
        if self._control is None:
            raise ChildProcessError("there is no fork server")
        socket.send_fds(self._control, [what], descriptors)

    def close(self) -> None:
        """End it, and all processes that it has started."""
        if self._control is not None:
            self._control.close()
        if self._process is not None and self._process.stdin is not None:
            self._process.stdin.close()
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(KILL_SECONDS)
        self._control = self._process = None


FORK_SERVER = ForkServerClient()
atexit.register(FORK_SERVER.close)
