"""The pool for code that is not a coroutine: part of a request runs elsewhere while a thread waits for it."""

import asyncio
import threading
from collections.abc import Callable
from concurrent.futures import CancelledError, Future
from typing import Any, TypeVar

from gelenk.model.errors import DeadlineExceeded, WorkerCrashed, WorkerOutOfMemory
from gelenk.pool.pool import WorkerPool

_Argument = TypeVar("_Argument")
_Result = TypeVar("_Result")


class BlockingPoolClient:
    """Has functions run by the pool on behalf of one request; to be made on the event loop, and ended there.

    Args:
        pool: Who runs them.
        client: Whose request it is.
    """

    def __init__(self, pool: WorkerPool, client: str = "") -> None:
        self._crew, self._client, self._loop = pool, client, asyncio.get_running_loop()
        self._lock = threading.Lock()
        self._under_way: Future[Any] | None = None
        self._is_over = False

    def run(self, function: Callable[[_Argument], _Result], argument: _Argument, seconds: float) -> _Result:
        """The function's result; for one thread at a time, which is not the event loop's.

        Args:
            function: Of a module, with an argument and a result that can be sent to another process.
            argument: What it is called with.
            seconds: How long the caller waits, for its turn and for the result.

        Raises:
            TimeoutError: It takes longer.
            ChildProcessError: Its process died, or the result is no longer needed.
            KinematicsError: As `WorkerPool.run` where the pool takes no more calls.
            Exception: Whatever the function raises.
        """

        async def call() -> _Result:
            work = self._crew.run(function, argument, seconds, self._client)
            return await asyncio.wait_for(work, max(0.0, seconds))

        with self._lock:
            if self._is_over:
                raise ChildProcessError("the client no longer waits")
            self._under_way = under_way = asyncio.run_coroutine_threadsafe(call(), self._loop)
        try:
            return under_way.result()
        except DeadlineExceeded as error:
            raise TimeoutError("no result within the time allowed") from error
        except (WorkerCrashed, WorkerOutOfMemory) as error:
            raise ChildProcessError(error.detail) from error
        except CancelledError as error:
            raise ChildProcessError("the client no longer waits") from error

    def end(self) -> None:
        """Break off what is under way; later calls are refused."""
        with self._lock:
            self._is_over = True
            if self._under_way is not None:
                self._under_way.cancel()
