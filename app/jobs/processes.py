"""A process of ours at the other end of a pipe: started, and ended so that nothing of it is left.

Each is a copy of one that has loaded everything already and does nothing else: it is there within milliseconds, and
shares the memory of what it never changes.
"""

import contextlib
import ctypes
import multiprocessing
import os
import signal
import sys
from collections.abc import Callable
from multiprocessing import forkserver
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any

LOADED = "app.preload"
"""The module that the process which is copied imports first."""
GOODBYE_SECONDS = 1.0
"""How long the end of a killed process is waited for."""
_PR_SET_PDEATHSIG = 1


def started(target: Callable[[Connection], None], name: str) -> tuple[BaseProcess, Connection]:
    """A new process that runs a function with its end of a pipe, and our end.

    Args:
        target: Of a module, because the process imports it anew.
        name: What the process is called.

    Raises:
        ChildProcessError: No process could be started.
    """
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload([LOADED])
    ours, theirs = context.Pipe()
    process = context.Process(target=target, args=(theirs,), name=name, daemon=True)
    try:
        process.start()
    except (OSError, EOFError, RuntimeError) as error:
        ours.close()
        raise ChildProcessError("no process could be started") from error
    finally:
        theirs.close()
    return process, ours


def settle() -> None:
    """Leave the end to the service, which lets requests finish first; to be called in a process that was started.

    Where the service itself is killed, nothing of its processes is left, whatever they are at: the one that they are
    copies of ends when nobody holds the other end of its pipe any more, and with it they do.
    """
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, signal.SIG_IGN)
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    copied: Any = forkserver._forkserver
    held, copied._forkserver_alive_fd = copied._forkserver_alive_fd, None
    if held is not None:
        os.close(held)


def ended(process: BaseProcess | None, connection: Connection | None) -> None:
    """Close our end, kill the process and wait for its end."""
    if connection is not None:
        connection.close()
    if process is not None:
        process.kill()
        process.join(GOODBYE_SECONDS)
        with contextlib.suppress(ValueError):
            process.close()
