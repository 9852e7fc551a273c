"""What a process of the pool runs: one call after the other, within limits of memory and of processor time."""

import math
import os
import pickle
import resource
import socket
import sys
import time
import traceback
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, Literal, TypeAlias

from gelenk.pool import wire
from gelenk.processes.copies import load_seldom_needed
from gelenk.processes.fork_server import SELDOM_NEEDED

Outcome: TypeAlias = tuple[Literal["result", "error", "memory"], Any]
"""What came of a call: its result, what it has raised, or that there was not enough memory."""
Reply: TypeAlias = tuple[Outcome, bool]
"""An outcome, and whether the process continues."""

_NICENESS = 5
"""The event loops take precedence: they answer within a fraction of a millisecond, and accept nothing before."""
_SPARE_SECONDS = 2
_TIRED = 0.5
"""A process that holds this share of its memory limit is replaced by a fresh one."""
_OWN_SECONDS = 20.0
"""So is one that loaded modules of its own so long ago: fresh ones share theirs."""


def serve(memory_bytes: int, connection: Connection) -> None:
    """Answer calls until the other side is gone or memory has run out.

    Args:
        memory_bytes: What it may take beside what it has at its start.
        connection: To the service.
    """
    stream = socket.socket(fileno=os.dup(connection.fileno()))
    connection.close()
    os.nice(_NICENESS)
    _limit(resource.RLIMIT_CORE, 0)
    at_start = _held_bytes()
    _limit(resource.RLIMIT_DATA, at_start + memory_bytes)
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
            load_seldom_needed()
            ends = time.monotonic() + _OWN_SECONDS
        is_tired = _held_bytes() - at_start >= _TIRED * memory_bytes or time.monotonic() > ends
        goes_on = outcome[0] != "memory" and not is_tired
        try:
            wire.send(stream, (outcome, goes_on))
        except OSError:
            return
        del outcome
        if not goes_on:
            return


def _seldom_needed() -> set[str]:
    """Which of the modules that few requests need are loaded."""
    return sys.modules.keys() & {*SELDOM_NEEDED}


def _outcome(function: Callable[[Any], Any], argument: Any) -> Outcome:
    try:
        return "result", function(argument)
    except MemoryError:
        return "memory", None
    except Exception as error:
        return "error", _sendable(error)


def _sendable(error: Exception) -> Exception:
    """The error itself if it can be sent, with its traceback as a note, because a traceback cannot."""
    trace = "".join(traceback.format_exception(error))
    try:
        again = pickle.loads(pickle.dumps(error))  # noqa: S301 - our own
    except Exception:
        again = None
    if type(again) is not type(error):
        error = RuntimeError(f"{type(error).__name__}: {error}")
    error.add_note(trace)
    return error


def _held_bytes() -> int:
    """The memory that `RLIMIT_DATA` counts, where the system reports it."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[5]) * resource.getpagesize()
    except OSError:
        return 0


def _limit_processor_time(seconds: float) -> None:
    """A last resort if nothing is left to kill this process: the time of all processors during the call."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    most = used.ru_utime + used.ru_stime + (os.cpu_count() or 1) * seconds + _SPARE_SECONDS
    _limit(resource.RLIMIT_CPU, int(most))


def _limit(what: int, most: int) -> None:
    """Lower the soft limit; the hard one stays, so that it can be raised again."""
    hard = resource.getrlimit(what)[1]
    resource.setrlimit(what, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
