"""What a process of the crew runs: one call after the other, within limits of memory and of processor time."""

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

from gelenk.crew import wire
from gelenk.processes.copies import load_seldom_needed
from gelenk.processes.original import SELDOM_NEEDED

Outcome: TypeAlias = tuple[Literal["result", "error", "memory"], Any]
"""What came of a call: its result, what it has raised, or that there was not enough memory."""
Reply: TypeAlias = tuple[Outcome, bool]
"""An outcome, and whether the process goes on."""

_NICENESS = 5
"""The event loops go first: they answer in a fraction of a millisecond, and while they wait nobody is let in."""
_SPARE_SECONDS = 2
_TIRED = 0.5
"""A process that has come to hold this share of what it may makes room for a fresh one."""
_OWN_SECONDS = 20.0
"""So does one that has loaded modules of its own so long ago: fresh ones share them."""


def serve(memory_bytes: int, connection: Connection) -> None:
    """Answer calls until the other side is gone, or until memory has run out.

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
    """The error itself where it survives the way, with its trace as a note: a trace does not travel."""
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
    """What `RLIMIT_DATA` counts, where the system tells it."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[5]) * resource.getpagesize()
    except OSError:
        return 0


def _limit_processor_time(seconds: float) -> None:
    """A last resort, should nobody be left to kill this process: all processors for as long as the call may take."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    most = used.ru_utime + used.ru_stime + (os.cpu_count() or 1) * seconds + _SPARE_SECONDS
    _limit(resource.RLIMIT_CPU, int(most))


def _limit(what: int, most: int) -> None:
    """Lower the soft limit; the hard one stays, so that it can be raised again."""
    hard = resource.getrlimit(what)[1]
    resource.setrlimit(what, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
