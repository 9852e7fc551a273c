"""Access to the worker pool for code outside coroutines: a thread waits while a worker runs part of its request."""

import asyncio
import threading
from collections.abc import Callable
from concurrent.futures import CancelledError, Future
from typing import Any, TypeVar

from gelenk.errors import DeadlineExceeded, WorkerCrashed, WorkerOutOfMemory
from gelenk.pool.pool import WorkerPool

_Argument = TypeVar("_Argument")
_Result = TypeVar("_Result")


class BlockingPoolClient:
    """Runs functions in the worker pool for one request; create and end it on the event loop.

    Args:
        pool: Worker pool that runs them.
        client: Client that sent the request.
    """

    def __init__(self, pool: WorkerPool, client: str = "") -> None:
        self._pool, self._client, self._loop = pool, client, asyncio.get_running_loop()
        self._lock = threading.Lock()
        self._under_way: Future[Any] | None = None
        self._is_over = False

    def run(self, function: Callable[[_Argument], _Result], argument: _Argument, seconds: float) -> _Result:
        """Run a function in a worker and return its result; see `WorkerPool.run`, whose other errors it raises too.

        Call it from one thread at a time, not the event loop's.

        Raises:
            TimeoutError: The result does not come within `seconds`, which include the wait for a worker.
            ChildProcessError: The worker died, or the result is no longer needed.
        """

        async def call() -> _Result:
            work = self._pool.run(function, argument, seconds, self._client)
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
        """Cancel the current call, and refuse later ones."""
        with self._lock:
            self._is_over = True
            if self._under_way is not None:
                self._under_way.cancel()
