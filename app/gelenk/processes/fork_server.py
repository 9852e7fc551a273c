"""The fork server: a process that loads everything once and forks itself on request.

Requests come over a socket that its parent and each of its children hold. A request to fork passes two sockets: the
child's connection to the requester, and the lifeline, which carries first the child's process id and finally its exit
code. When the requester closes its end of the lifeline or dies, the fork server kills the child. The fork server itself
ends when its parent closes its standard input, and its children end with it.

Children requested before the warm-up, which may take a minute, are forked before it. Seldom needed modules are loaded
once a child has needed one, so that later children share them.
"""

import contextlib
import ctypes
import importlib
import logging
import os
import re
import selectors
import signal
import socket
import struct
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, NoReturn

from gelenk.processes import wire

_DONT_NEED = 4
_MAPPING = re.compile(r"([0-9a-f]+)-([0-9a-f]+) (r-[x-]p) \S+ \S+ \S+ +/")


def release_code() -> None:
    """Return the memory of library code to the system; only loading the kernels needed 80 MB of it.

    Only pages equal to their file are returned: code that runs again is read from it. Only Linux supports this.
    """
    try:
        mappings = Path("/proc/self/smaps").read_text()
    except OSError:
        return
    advise = ctypes.CDLL(None).madvise
    for start, end in _unchanged_code(mappings):
        advise(ctypes.c_void_p(start), ctypes.c_size_t(end - start), _DONT_NEED)


def _unchanged_code(mappings: str) -> Iterator[tuple[int, int]]:
    """Yield the address ranges that are mapped read-only from files and contain no changed page."""
    found: tuple[int, int] | None = None
    for line in mappings.splitlines():
        if match := _MAPPING.match(line):
            found = int(match[1], 16), int(match[2], 16)
        elif line.startswith("Anonymous:"):
            if found is not None and line.split()[1] == "0":
                yield found
            found = None


LOADED = "gelenk.preload"
"""Name of the module that is imported first.

Its function `warm_up` runs every computation once, `is_compiled` checks whether compiler processes have nothing to do,
and `load` imports a module. `basics` compiles what most requests need, and each function in `PARTS` a part of the rest.
"""
SELDOM_NEEDED = ("matplotlib.figure", "gelenk.plots.profiles", "sympy")
"""Modules that only pictures and worked solutions need; they take 50 MB and half a second to load."""
FORK, WARM_UP, LOAD = b"f", b"w", b"l"
NUMBER = struct.Struct("!i")

_PR_SET_PDEATHSIG, _PR_SET_NAME = 1, 15

logger = logging.getLogger("gelenk")


def main(control: int) -> None:
    """Import everything, then serve requests from the socket `control` until the parent ends."""
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, signal.SIG_IGN)
    _set_title("original")
    loaded = importlib.import_module(LOADED)
    ForkServer(socket.socket(fileno=control), loaded).run()


class ForkServer:
    """Forks the process that it runs in, which must have no other threads."""

    def __init__(self, control: socket.socket, loaded: Any) -> None:
        self._control, self._loaded = control, loaded
        self._lifelines: dict[int, socket.socket] = {}
        self._compilers: set[int] = set()
        self._waiting: list[socket.socket] = []
        self._selector = selectors.DefaultSelector()
        self._wakes, self._woken = socket.socketpair()
        self._is_running = True

    def run(self) -> None:
        """Serve requests until the parent closes the standard input."""
        self._wakes.setblocking(False)
        signal.set_wakeup_fd(self._wakes.fileno())
        signal.signal(signal.SIGCHLD, lambda *_: None)
        for source, act in (
            (sys.stdin, self._stop),
            (self._control, self._handle_request),
            (self._woken, self._reap),
        ):
            self._selector.register(source, selectors.EVENT_READ, act)
        while self._is_running:
            for key, _ in self._selector.select():
                key.data()

    def _stop(self) -> None:
        self._is_running = False

    def _handle_request(self) -> None:
        content, descriptors, _, _ = socket.recv_fds(self._control, 1, 2)
        if content == WARM_UP:
            self._start_warm_up(socket.socket(fileno=descriptors[0]))
        elif content == FORK:
            self._fork(descriptors[0], socket.socket(fileno=descriptors[1]))
        elif content == LOAD:
            for module in SELDOM_NEEDED:
                self._try(module, partial(self._loaded.load, module))

    def _start_warm_up(self, requester: socket.socket) -> None:
        """Load the kernels, if necessary after compiling them; close the requester's socket when done."""
        if not self._compilers and (self._loaded.is_compiled() or not self._compile_in_child(self._loaded.basics)):
            self._try("the kernels", self._loaded.warm_up)
            release_code()
            requester.close()
            return
        if not self._waiting:
            # Fork no children until the kernels that most requests need are compiled.
            self._selector.unregister(self._control)
        self._waiting.append(requester)

    def _compile_in_child(self, compute: Callable[[], None]) -> bool:
        """Compile in a separate process, so that its end frees the gigabyte used; return False if it cannot start."""

        def compile_and_end() -> None:
            _set_title("compiler")
            self._try("the kernels", compute)

        try:
            self._compilers.add(_forked(compile_and_end))
        except OSError as error:
            logger.error("the kernels are compiled in every process, which takes memory: %s", error.strerror)
            return False
        return True

    def _continue_warm_up(self) -> None:
        """Load the compiled kernels: first the basics, then the rest, once other processes have compiled it."""
        if self._control not in self._selector.get_map():
            self._try("the kernels", self._loaded.basics)
            self._selector.register(self._control, selectors.EVENT_READ, self._handle_request)
            for part in self._loaded.PARTS:
                self._compile_in_child(part)
        if not self._compilers:
            self._try("the kernels", self._loaded.warm_up)
            release_code()
            while self._waiting:
                self._waiting.pop().close()

    def _try(self, what: str, load: Callable[[], None]) -> None:
        try:
            load()
        except Exception:
            logger.exception("could not load %s", what)

    def _fork(self, connection: int, lifeline: socket.socket) -> None:
        """Fork a child; if that fails, close its lifeline without sending a process id."""
        try:
            pid = _forked(partial(self._run_child, connection, lifeline))
        except OSError as error:
            logger.error("no process could be started: %s", error.strerror)
            lifeline.close()
            return
        finally:
            os.close(connection)
        self._lifelines[pid] = lifeline
        self._selector.register(lifeline, selectors.EVENT_READ, partial(self._kill_child, pid))
        self._report(lifeline, pid)

    def _run_child(self, connection: int, lifeline: socket.socket) -> NoReturn:
        """In the child: receive a function over the connection, run it, and exit."""
        code = 1
        try:
            lifeline.close()
            self._release()
            to_requester = socket.socket(fileno=connection)
            name, target = wire.receive(to_requester)
            _set_title(name)
            target(to_requester)
            code = 0
        except SystemExit as error:
            code = error.code if isinstance(error.code, int) else 1
        except (EOFError, OSError):
            code = 0  # the requester has disconnected
        except BaseException:
            logger.exception("a process has failed")
        finally:
            with contextlib.suppress(Exception):
                logging.shutdown()
                sys.stdout.flush()
            os._exit(code)

    def _release(self) -> None:
        """In a child: close the files and reset the signals that only the fork server needs."""
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        self._selector.close()
        for one in (self._control, self._wakes, self._woken, *self._lifelines.values()):
            one.close()
        nothing = os.open(os.devnull, os.O_RDONLY)
        os.dup2(nothing, sys.stdin.fileno())
        os.close(nothing)

    def _kill_child(self, pid: int) -> None:
        """Kill a child whose lifeline was closed; `_reap` then reports its exit code if possible."""
        if pid in self._lifelines:  # otherwise `_reap` removed it in the same turn of the loop
            self._selector.unregister(self._lifelines[pid])
            os.kill(pid, signal.SIGKILL)

    def _reap(self) -> None:
        """Report the exit codes of the children that have ended, and continue the warm-up after the last compiler."""
        self._woken.recv(4096)
        while self._lifelines or self._compilers:
            pid, status = os.waitpid(-1, os.WNOHANG)
            if not pid:
                return
            if pid in self._compilers:
                self._compilers.remove(pid)
                if not self._compilers:
                    self._continue_warm_up()
            lifeline = self._lifelines.pop(pid, None)
            if lifeline is None:
                continue
            with contextlib.suppress(KeyError):
                self._selector.unregister(lifeline)
            self._report(lifeline, os.waitstatus_to_exitcode(status))
            lifeline.close()

    def _report(self, lifeline: socket.socket, number: int) -> None:
        with contextlib.suppress(OSError):
            lifeline.sendall(NUMBER.pack(number))


def _forked(run: Callable[[], None]) -> int:
    """Fork a child that runs a function, and ends with this process at the latest; return its process id."""
    parent = os.getpid()
    pid = os.fork()
    if pid == 0:
        try:
            _prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
            if os.getppid() == parent:  # otherwise the parent ended before the signal was set
                run()
        finally:
            os._exit(0)
    return pid


def _set_title(name: str) -> None:
    """Set the name of this process to `gelenk-` and the given name, at most eight letters."""
    _prctl(_PR_SET_NAME, f"gelenk-{name}".encode("ascii"))


def _prctl(what: int, value: object) -> None:
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(what, value)
