"""A process of its own for work that holds the GIL and may take longer than anyone waits.

It starts at the first call, stays warm for the next ones, and is killed and replaced when a call takes longer than it
may or when it dies. One call runs at a time; the others wait, each within its own time.
"""

import contextlib
import signal
import threading
import time
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any, TypeVar

from app.processes.copies import Copy, ended, started

_Argument = TypeVar("_Argument")
_Result = TypeVar("_Result")

_LONGEST = 3600.0
_SHORTEST = 0.1
"""With less time left than this, a call is not begun, [s]: it would only cost the warm process."""


class Isolated:
    """One replaceable process; safe to call from several threads."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._process: Copy | None = None
        self._connection: Connection | None = None
        self._ready = False
        self._closed = False

    @property
    def pid(self) -> int | None:
        """The process, where there is one."""
        process = self._process
        return None if process is None else process.pid

    def run(self, function: Callable[[_Argument], _Result], argument: _Argument, seconds: float) -> _Result:
        """The function's result.

        Args:
            function: Of a module, with an argument and a result that can be sent to another process.
            argument: What it is called with.
            seconds: How long the caller waits: for its turn, for the process to start and for the result.

        Raises:
            TimeoutError: It takes longer.
            ChildProcessError: The process died, or the service is shutting down.
            Exception: Whatever the function raises.
        """
        until = time.monotonic() + min(seconds, _LONGEST)
        if not self._lock.acquire(timeout=max(0.0, until - time.monotonic())):
            raise TimeoutError("no turn within the time allowed")
        try:
            return self._ask(function, argument, until)
        finally:
            self._lock.release()

    def close(self) -> None:
        """End the process, in the middle of a call if need be; later calls are refused."""
        self._closed = True
        while not self._lock.acquire(timeout=0.05):
            if (process := self._process) is not None:
                with contextlib.suppress(ValueError):
                    process.signal(signal.SIGKILL)
        self._end()
        self._lock.release()

    def _ask(self, function: Callable[[_Argument], _Result], argument: _Argument, until: float) -> _Result:
        if self._closed:
            raise ChildProcessError("the service is shutting down")
        if until - time.monotonic() < _SHORTEST:
            raise TimeoutError("no turn within the time allowed")
        try:
            connection = self._started(until)
            connection.send((function, argument))
            if not connection.poll(max(0.0, until - time.monotonic())):
                self._end()
                raise TimeoutError("no result within the time allowed")
            succeeded, result = connection.recv()
        except (EOFError, ConnectionError) as error:
            self._end()
            raise ChildProcessError("the process died") from error
        if not succeeded:
            raise result
        return result  # type: ignore[no-any-return]

    def _started(self, until: float) -> Connection:
        """The connection to the process, which is started where there is none or where it has died meanwhile.

        A process that is still starting at the end of the caller's time goes on: the next call finds it further on.
        """
        connection = self._connection
        if connection is None or self._process is None or not self._process.is_alive():
            self._end()
            connection = self._start()
        if not self._ready:
            if not connection.poll(max(0.0, until - time.monotonic())):
                raise TimeoutError("the process did not start within the time allowed")
            self._ready = bool(connection.recv())
        return connection

    def _start(self) -> Connection:
        self._process, self._connection = started(serve, "isolated")
        return self._connection

    def _end(self) -> None:
        ended(self._process, self._connection)
        self._process, self._connection, self._ready = None, None, False


def serve(connection: Connection) -> None:
    """Answer calls until the other side is gone; what the process runs."""
    connection.send(True)
    while True:
        try:
            function, argument = connection.recv()
        except (EOFError, OSError):
            return
        answer = _answered(function, argument)
        try:
            connection.send(answer)
        except OSError:
            return


def _answered(function: Callable[[Any], Any], argument: Any) -> tuple[bool, Any]:
    try:
        return True, function(argument)
    except Exception as error:
        return False, error
