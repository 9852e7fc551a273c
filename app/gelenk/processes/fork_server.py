"""The fork server: a process that loads everything once, forks copies of itself on request, and does nothing else.

Requests come over a socket that its parent and all copies share. A request for a copy brings two sockets: the copy's
connection, and its lifeline, over which the fork server sends first the copy's process id and later its exit code. The
requester holds the other end of the lifeline; when that closes, for example because the requester has died, the fork
server kills the copy. It ends when its parent closes its standard input, and its copies end with it.

Copies requested before the warm-up are made before it, because the warm-up may take a minute. Seldom needed modules are
loaded once a copy has needed one, so that later copies share them.
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
from typing import Any, NoReturn

from gelenk.processes.pages import release_code

LOADED = "gelenk.preload"
"""Name of the module that is imported first.

Its function `warm_up` runs every computation once, `is_compiled` checks whether other processes have nothing left to
compile, and `load` imports a module. `basics` compiles what most requests need, and each of `PARTS` part of the rest.
"""
SELDOM_NEEDED = ("matplotlib.figure", "gelenk.plots.profiles", "sympy")
"""Modules that only pictures and worked solutions need: they take 50 MB, and half a second to load."""
COPY, WARM_UP, LOAD = b"c", b"w", b"l"
NUMBER = struct.Struct("!i")

_PR_SET_PDEATHSIG, _PR_SET_NAME = 1, 15

logger = logging.getLogger("gelenk")


def main(control: int) -> None:
    """Import everything, then serve requests until the parent ends.

    Args:
        control: File descriptor of the socket that requests come from.
    """
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, signal.SIG_IGN)
    _name("original")
    loaded = importlib.import_module(LOADED)
    Original(socket.socket(fileno=control), loaded).run()


class Original:
    """The fork server in its own process, which must have only one thread.

    Args:
        control: Socket that requests come from.
        loaded: Module that `LOADED` names.
    """

    def __init__(self, control: socket.socket, loaded: Any) -> None:
        self._control, self._loaded = control, loaded
        self._lifelines: dict[int, socket.socket] = {}
        self._compilers: set[int] = set()
        self._askers: list[socket.socket] = []
        self._selector = selectors.DefaultSelector()
        self._wakes, self._woken = socket.socketpair()
        self._goes_on = True

    def run(self) -> None:
        """Serve requests until the parent closes the standard input."""
        self._wakes.setblocking(False)
        signal.set_wakeup_fd(self._wakes.fileno())
        signal.signal(signal.SIGCHLD, lambda *_: None)
        for source, act in (
            (sys.stdin, self._stop),
            (self._control, self._take),
            (self._woken, self._reap),
        ):
            self._selector.register(source, selectors.EVENT_READ, act)
        while self._goes_on:
            for key, _ in self._selector.select():
                key.data()

    def _stop(self) -> None:
        self._goes_on = False

    def _take(self) -> None:
        """Receive a request and serve it."""
        content, descriptors, _, _ = socket.recv_fds(self._control, 1, 2)
        if content == WARM_UP:
            self._get_warm(socket.socket(fileno=descriptors[0]))
        elif content == COPY:
            self._copy(descriptors[0], socket.socket(fileno=descriptors[1]))
        elif content == LOAD:
            for module in SELDOM_NEEDED:
                self._try(module, partial(self._loaded.load, module))

    def _get_warm(self, asker: socket.socket) -> None:
        """Load the kernels, then close the requester's socket to report that."""
        if not self._compilers and (self._loaded.is_compiled() or not self._compile_apart(self._loaded.basics)):
            self._try("the kernels", self._loaded.warm_up)
            release_code()
            asker.close()
            return
        if not self._askers:
            # Requests for copies wait until the basics are compiled and loaded.
            self._selector.unregister(self._control)
        self._askers.append(asker)

    def _compile_apart(self, compute: Callable[[], None]) -> bool:
        """Compile in a separate process, whose end frees the gigabyte needed; return False if it cannot be started."""
        parent = os.getpid()
        try:
            pid = os.fork()
        except OSError as error:
            logger.error("the kernels are compiled in every process, which takes memory: %s", error.strerror)
            return False
        if pid == 0:
            _set(_PR_SET_PDEATHSIG, signal.SIGKILL)
            if os.getppid() == parent:  # otherwise the parent ended before the signal was set
                _name("compiler")
                self._try("the kernels", compute)
            os._exit(0)
        self._compilers.add(pid)
        return True

    def _go_on(self) -> None:
        """Load what was compiled: first the basics, then everything, once other processes have compiled the parts."""
        if self._control not in self._selector.get_map():
            self._try("the kernels", self._loaded.basics)
            self._selector.register(self._control, selectors.EVENT_READ, self._take)
            for part in self._loaded.PARTS:
                self._compile_apart(part)
        if not self._compilers:
            self._try("the kernels", self._loaded.warm_up)
            release_code()
            while self._askers:
                self._askers.pop().close()

    def _try(self, what: str, load: Callable[[], None]) -> None:
        try:
            load()
        except Exception:
            logger.exception("could not be loaded: %s", what)

    def _copy(self, way: int, lifeline: socket.socket) -> None:
        """Fork a copy; if that fails, only close its lifeline."""
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
        """Run, in the copy, the function that comes over its connection, then exit."""
        code = 1
        try:
            _set(_PR_SET_PDEATHSIG, signal.SIGKILL)
            if os.getppid() == parent:  # otherwise the parent ended before the signal was set
                self._forget()
                connection = Connection(way)
                name, target = connection.recv()
                _name(name)
                target(connection)
                code = 0
        except SystemExit as error:
            code = error.code if isinstance(error.code, int) else 1
        except (EOFError, OSError):
            code = 0  # the requester is gone
        except BaseException:
            logger.exception("a process has failed")
        finally:
            with contextlib.suppress(Exception):
                logging.shutdown()
                sys.stdout.flush()
            os._exit(code)

    def _forget(self) -> None:
        """Release, in a copy, what only the fork server needs."""
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        self._selector.close()
        for one in (self._control, self._wakes, self._woken, *self._lifelines.values()):
            one.close()
        nothing = os.open(os.devnull, os.O_RDONLY)
        os.dup2(nothing, sys.stdin.fileno())
        os.close(nothing)

    def _let_go(self, pid: int) -> None:
        """Kill a copy whose lifeline was closed; `_reap` then collects it."""
        if pid in self._lifelines:  # otherwise it was just reaped
            self._selector.unregister(self._lifelines[pid])
            os.kill(pid, signal.SIGKILL)

    def _reap(self) -> None:
        """Collect the processes that have ended, and report the exit codes of copies."""
        self._woken.recv(4096)
        while self._lifelines or self._compilers:
            pid, status = os.waitpid(-1, os.WNOHANG)
            if not pid:
                return
            if pid in self._compilers:
                self._compilers.remove(pid)
                if not self._compilers:
                    self._go_on()
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
    """Name this process `gelenk-` and the given name, which has at most eight letters."""
    _set(_PR_SET_NAME, f"gelenk-{name}".encode("ascii"))


def _set(what: int, value: object) -> None:
    """Set an attribute of this process by `prctl`, on Linux only."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(what, value)
