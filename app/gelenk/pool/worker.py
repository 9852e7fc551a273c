"""Main loop of a worker process: it runs one call after another, within limits on memory and processor time."""

import math
import os
import pickle
import resource
import socket
import sys
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeAlias

from gelenk.processes import wire
from gelenk.processes.fork_server import SELDOM_NEEDED
from gelenk.processes.memory import keep_freed_memory
from gelenk.processes.worker_process import FORK_SERVER

Outcome: TypeAlias = tuple[Literal["result", "error", "memory"], Any]
"""Outcome of a call: its kind, and the result, the exception, or None if memory ran out."""
Reply: TypeAlias = tuple[Outcome, bool]
"""An outcome, and whether the process accepts further calls."""

_SPARE_SECONDS = 2
_TIRED = 0.5
"""Share of the memory limit at which a fresh process replaces a worker."""
_OWN_SECONDS = 20.0
"""Time after which to replace a worker that loaded seldom needed modules itself, [s]: later processes share them."""


@dataclass(frozen=True, slots=True)
class Priority:
    """Settings of the worker processes for calls of one priority.

    Attributes:
        title: Name of the processes in the system, without the prefix `gelenk-`.
        niceness: Niceness of the processes; the event loops take precedence over all of them.
        grace_seconds: An abandoned call may finish within this time before its process is killed, [s].
        idle_seconds: Time without work after which a process ends, [s].
        memory_bytes: Memory that a process may allocate after its start, [bytes]; infinite means no limit.
    """

    title: str
    niceness: int
    grace_seconds: float
    idle_seconds: float = math.inf
    memory_bytes: float = math.inf


def serve(priority: Priority, stream: socket.socket) -> None:
    """Run calls until the service disconnects, memory runs out, or a fresh process should replace this one."""
    os.nice(priority.niceness)
    keep_freed_memory()
    _limit(resource.RLIMIT_CORE, 0)
    at_start = _held_bytes()
    if math.isfinite(priority.memory_bytes):
        _limit(resource.RLIMIT_DATA, at_start + int(priority.memory_bytes))
    shared, ends = _seldom_needed(), math.inf
    while True:
        try:
            function, argument, seconds = wire.receive(stream)
        except (EOFError, OSError):
            return
        except MemoryError:
            wire.send(stream, (("memory", None), False))
            return
        _limit_processor_time(seconds)
        outcome = _outcome(function, argument)
        del function, argument
        if ends == math.inf and _seldom_needed() != shared:
            FORK_SERVER.load_seldom_needed()
            ends = time.monotonic() + _OWN_SECONDS
        is_tired = _held_bytes() - at_start >= _TIRED * priority.memory_bytes or time.monotonic() > ends
        goes_on = outcome[0] != "memory" and not is_tired
        try:
            wire.send(stream, (outcome, goes_on))
        except OSError:
            return
        del outcome
        if not goes_on:
            return


def _seldom_needed() -> set[str]:
    return sys.modules.keys() & {*SELDOM_NEEDED}


def _outcome(function: Callable[[Any], Any], argument: Any) -> Outcome:
    try:
        return "result", function(argument)
    except MemoryError:
        return "memory", None
    except Exception as error:
        return "error", _sendable(error)


def _sendable(error: Exception) -> Exception:
    """Return the error, or a `RuntimeError` if it cannot be pickled, with the traceback as a note."""
    trace = "".join(traceback.format_exception(error))
    try:
        again = pickle.loads(pickle.dumps(error))  # noqa: S301 - pickled here
    except Exception:
        again = None
    if type(again) is not type(error):
        error = RuntimeError(f"{type(error).__name__}: {error}")
    error.add_note(trace)
    return error


def _held_bytes() -> int:
    """Return the memory that `RLIMIT_DATA` counts, [bytes]; 0 if the system does not report it."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[5]) * resource.getpagesize()
    except OSError:
        return 0


def _limit_processor_time(seconds: float) -> None:
    """Limit processor time to that of all processors during the call, in case no pool is left to kill the process."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    most = used.ru_utime + used.ru_stime + (os.cpu_count() or 1) * seconds + _SPARE_SECONDS
    _limit(resource.RLIMIT_CPU, int(most))


def _limit(what: int, most: int) -> None:
    """Set the soft limit only, so that it can be raised again."""
    hard = resource.getrlimit(what)[1]
    resource.setrlimit(what, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
