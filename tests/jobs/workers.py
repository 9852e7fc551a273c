"""A worker pool for parts of jobs alone."""

import asyncio
import threading

from gelenk.jobs.workers import PoolExecutor
from gelenk.pool.pool import WorkerPool


class Workers(PoolExecutor):
    """A pool on an event loop in a thread of its own, which ends with it.

    Args:
        count: Processes.
    """

    def __init__(self, count: int) -> None:
        self.pool = WorkerPool(0, 0, 0, count)
        super().__init__(self.pool)
        self._is_ready, self._is_over = threading.Event(), asyncio.Event()
        self._thread = threading.Thread(target=asyncio.run, args=(self._serve(),), daemon=True)
        self._thread.start()
        self._is_ready.wait()

    @property
    def pids(self) -> list[int]:
        return self.pool.pids

    async def _serve(self) -> None:
        self.start()
        self._is_ready.set()
        await self._is_over.wait()
        await asyncio.gather(*asyncio.all_tasks() - {asyncio.current_task()}, return_exceptions=True)

    def close(self) -> None:
        """End all parts; whoever waits for one is told."""
        super().close()
        if self._loop is not None and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._is_over.set)
        self._thread.join()
