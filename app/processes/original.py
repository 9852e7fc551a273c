"""The process that others are copies of: it loads everything once, copies itself when asked, and does nothing else.

It is asked over a socket that whoever started it has, and each of its copies. A request brings two sockets: the way to
the copy, and its lifeline, on which the copy's number comes first and its exit code last. Whoever asked holds the other
end of that; when it is closed, because they are gone for example, the copy is killed. The process itself ends when its
standard input does, which the one who started it holds, and its copies end with it.

Copies that are asked for before it is told to warm up are there before that: it may take a minute. What is seldom
needed it loads when it has been idle for a while, so that the copies that it makes from then on have that too.
"""

import contextlib
import ctypes
import importlib
import logging
import os
import selectors
import signal
import socket
import struct
import sys
from collections.abc import Callable
from functools import partial
from multiprocessing.connection import Connection
from typing import NoReturn

LOADED = "app.preload"
"""What is imported first.

Its function `warm_up` computes one of everything, `is_compiled` tells whether another process could compile nothing for
it, and `load` imports.
"""
SELDOM_NEEDED = ("matplotlib.figure", "app.plots.profiles", "sympy")
"""Modules that only pictures and worked solutions need: they take a second, for which nobody waits at the start."""
COPY, WARM_UP = b"c", b"w"
NUMBER = struct.Struct("!i")

_IDLE_SECONDS, _STEP_SECONDS = 2.0, 0.1
"""After how long without a request the first of them is loaded, and each further one."""
_PR_SET_PDEATHSIG, _PR_SET_NAME = 1, 15

logger = logging.getLogger("gelenk")


def main(control: int) -> None:
    """Load everything, then do what is asked until the end.

    Args:
        control: File descriptor of the socket on which requests come.
    """
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, signal.SIG_IGN)
    _name("original")
    loaded = importlib.import_module(LOADED)
    Original(socket.socket(fileno=control), loaded.is_compiled, loaded.warm_up, loaded.load).run()


class Original:
    """Copies this process; it must have no other thread.

    Args:
        control: Where requests come from.
        is_compiled: Whether another process could compile nothing for `warm_up`.
        warm_up: Loads what takes longer than the first copies can wait.
        load: Imports a module.
    """

    def __init__(
        self,
        control: socket.socket,
        is_compiled: Callable[[], bool],
        warm_up: Callable[[], None],
        load: Callable[[str], None],
    ) -> None:
        self._control, self._is_compiled, self._warm_up, self._load = control, is_compiled, warm_up, load
        self._lifelines: dict[int, socket.socket] = {}
        self._compiling: tuple[int, socket.socket] | None = None
        self._selector = selectors.DefaultSelector()
        self._wakes, self._woken = socket.socketpair()
        self._goes_on = True

    def run(self) -> None:
        """Do what is asked until nobody is left to ask."""
        self._wakes.setblocking(False)
        signal.set_wakeup_fd(self._wakes.fileno())
        signal.signal(signal.SIGCHLD, lambda *_: None)
        for source, act in (
            (sys.stdin, self._stop),
            (self._control, self._take),
            (self._woken, self._reap),
        ):
            self._selector.register(source, selectors.EVENT_READ, act)
        missing, pause = list(SELDOM_NEEDED), _IDLE_SECONDS
        while self._goes_on:
            ready = self._selector.select(pause if missing else None)
            for key, _ in ready:
                key.data()
            if not ready and missing:
                module, pause = missing.pop(0), _STEP_SECONDS
                self._try(module, partial(self._load, module))

    def _stop(self) -> None:
        self._goes_on = False

    def _take(self) -> None:
        """Take a request."""
        content, descriptors, _, _ = socket.recv_fds(self._control, 1, 2)
        if content == WARM_UP:
            self._get_warm(socket.socket(fileno=descriptors[0]))
        elif content == COPY:
            self._copy(descriptors[0], socket.socket(fileno=descriptors[1]))

    def _get_warm(self, asker: socket.socket) -> None:
        """Load what takes long; the end of its socket tells whoever asked that this is over."""
        if self._is_compiled() or not self._compiles_elsewhere(asker):
            self._try("the kernels", self._warm_up)
            asker.close()

    def _compiles_elsewhere(self, asker: socket.socket) -> bool:
        """Let a process of its own compile: the gigabyte that this takes is gone with it, here and in all copies.

        Who asks for a copy has to wait until it has ended, and this one has loaded what it has left.
        """
        parent = os.getpid()
        try:
            pid = os.fork()
        except OSError as error:
            logger.error("the kernels are compiled where they stay, which takes memory: %s", error.strerror)
            return False
        if pid == 0:
            _set(_PR_SET_PDEATHSIG, signal.SIGKILL)
            if os.getppid() == parent:  # else it has ended before that could be said
                _name("compiler")
                self._try("the kernels", self._warm_up)
            os._exit(0)
        self._compiling = pid, asker
        self._selector.unregister(self._control)
        return True

    def _take_over(self, asker: socket.socket) -> None:
        """Load what was compiled, and take requests again."""
        self._compiling = None
        self._try("the kernels", self._warm_up)
        asker.close()
        self._selector.register(self._control, selectors.EVENT_READ, self._take)

    def _try(self, what: str, load: Callable[[], None]) -> None:
        try:
            load()
        except Exception:
            logger.exception("could not be loaded: %s", what)

    def _copy(self, way: int, lifeline: socket.socket) -> None:
        """A copy; where there is none to be had, its lifeline ends without a word."""
        parent = os.getpid()
        try:
            pid = os.fork()
        except OSError as error:
            logger.error("no process could be started: %s", error.strerror)
            os.close(way)
            lifeline.close()
            return
        if pid == 0:
            lifeline.close()
            self._become(way, parent)
        os.close(way)
        self._lifelines[pid] = lifeline
        self._selector.register(lifeline, selectors.EVENT_READ, partial(self._let_go, pid))
        self._tell(lifeline, pid)

    def _become(self, way: int, parent: int) -> NoReturn:
        """Do what the other end of the way asks for, and end."""
        code = 1
        try:
            _set(_PR_SET_PDEATHSIG, signal.SIGKILL)
            if os.getppid() == parent:  # else it has ended before that could be said
                self._forget()
                connection = Connection(way)
                name, target = connection.recv()
                _name(name)
                target(connection)
                code = 0
        except SystemExit as error:
            code = error.code if isinstance(error.code, int) else 1
        except (EOFError, OSError):
            code = 0  # nobody is there any more
        except BaseException:
            logger.exception("a process has failed")
        finally:
            with contextlib.suppress(Exception):
                logging.shutdown()
                sys.stdout.flush()
            os._exit(code)

    def _forget(self) -> None:
        """Let go, in a copy, of what the original alone needs."""
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        self._selector.close()
        for one in (self._control, self._wakes, self._woken, *self._lifelines.values()):
            one.close()
        nothing = os.open(os.devnull, os.O_RDONLY)
        os.dup2(nothing, sys.stdin.fileno())
        os.close(nothing)

    def _let_go(self, pid: int) -> None:
        """End a copy whose lifeline was closed; `_reap` tells of it where somebody still listens."""
        if pid in self._lifelines:  # else it was reaped in this very turn
            self._selector.unregister(self._lifelines[pid])
            os.kill(pid, signal.SIGKILL)

    def _reap(self) -> None:
        """Tell of the copies that have ended."""
        self._woken.recv(4096)
        while self._lifelines or self._compiling:
            pid, status = os.waitpid(-1, os.WNOHANG)
            if not pid:
                return
            if self._compiling and pid == self._compiling[0]:
                self._take_over(self._compiling[1])
            lifeline = self._lifelines.pop(pid, None)
            if lifeline is None:
                continue
            with contextlib.suppress(KeyError):
                self._selector.unregister(lifeline)
            self._tell(lifeline, os.waitstatus_to_exitcode(status))
            lifeline.close()

    def _tell(self, lifeline: socket.socket, number: int) -> None:
        with contextlib.suppress(OSError):
            lifeline.sendall(NUMBER.pack(number))


def _name(name: str) -> None:
    """Say what this process is; at most eight letters."""
    _set(_PR_SET_NAME, f"gelenk-{name}".encode("ascii"))


def _set(what: int, value: object) -> None:
    """Tell the system something about this process, where it takes that."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(what, value)
