"""A process of ours at the other end of a pipe: started, and ended so that nothing of it is left.

Each is a copy of one that has loaded everything already and does nothing else: it is there within milliseconds, and
shares the memory of what it never changes.
"""

import contextlib
import multiprocessing
from collections.abc import Callable
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess

LOADED = "app.preload"
"""The module that the process which is copied imports first."""
GOODBYE_SECONDS = 1.0
"""How long the end of a killed process is waited for."""


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


def ended(process: BaseProcess | None, connection: Connection | None) -> None:
    """Close our end, kill the process and wait for its end."""
    if connection is not None:
        connection.close()
    if process is not None:
        process.kill()
        process.join(GOODBYE_SECONDS)
        with contextlib.suppress(ValueError):
            process.close()
