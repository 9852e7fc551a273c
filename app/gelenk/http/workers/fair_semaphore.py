"""An asyncio semaphore for which clients take turns."""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from gelenk.processes.turns import Turns


class FairSemaphore:
    """Semaphore that gives its places to clients in turn; belongs to one event loop.

    Args:
        size: Number of places; `Turns` explains when there are more.
    """

    def __init__(self, size: int) -> None:
        self._turns: Turns[asyncio.Future[None]] = Turns(size)

    @asynccontextmanager
    async def taken(self, client: str) -> AsyncIterator[None]:
        """Wait for the client's turn, then hold a place while the context is open."""
        turn: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._turns.add(client, turn)
        try:
            self._hand_out()
            await turn
            yield
        finally:
            if not self._turns.remove(client, turn):
                self._turns.give_back(client)
                self._hand_out()

    def _hand_out(self) -> None:
        while (found := self._turns.take()) is not None:
            if not found[1].done():
                found[1].set_result(None)
