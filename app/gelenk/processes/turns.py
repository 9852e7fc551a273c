"""A fair queue for clients that share a number of places, such as processes or concurrent jobs."""

import time
from collections import Counter, deque
from collections.abc import Iterator
from itertools import chain
from typing import Generic, TypeVar

_Turn = TypeVar("_Turn")

_PRESENT_SECONDS = 2.0
"""How long a client counts as present after it last queued or returned a place, [s]."""


class Turns(Generic[_Turn]):
    """A queue for each client, and the number of places that each client holds, of `size` in total.

    Clients take turns: between two turns of one client, each other waiting client has one. A single client may use all
    places; beside others, it may hold more than half of them only if it leaves one free. If all places are taken, a
    client without one gets an extra place, up to half the size in total, because running work is never interrupted.
    """

    def __init__(self, size: int) -> None:
        self.size, self.half = size, max(1, size // 2)
        self._queues: dict[str, deque[_Turn]] = {}  # in the order of their next turns
        self._held: Counter[str] = Counter()
        self._seen: dict[str, float] = {}

    def __len__(self) -> int:
        return sum(map(len, self._queues.values()))

    def __iter__(self) -> Iterator[_Turn]:
        return chain.from_iterable(self._queues.values())

    def add(self, client: str, turn: _Turn) -> None:
        """Add an item to the end of the client's queue."""
        self._queues.setdefault(client, deque()).append(turn)
        self._seen[client] = time.monotonic()

    def remove(self, client: str, turn: _Turn) -> bool:
        """Remove an item from the client's queue; return False if it is not there."""
        queue = self._queues.get(client)
        if queue is None or turn not in queue:
            return False
        queue.remove(turn)
        if not queue:
            del self._queues[client]
        return True

    def take(self) -> tuple[str, _Turn] | None:
        """Give a place to the next item and return it with its client; return None if no item may have one."""
        client = next(filter(self.has_room, self._queues), None)
        if client is None:
            return None
        queue = self._queues.pop(client)
        turn = queue.popleft()
        if queue:
            self._queues[client] = queue
        self._held[client] += 1
        return client, turn

    def give_back(self, client: str) -> None:
        """Return a place that a client no longer needs."""
        self._held[client] -= 1
        self._held += Counter()  # drops clients without places
        now = time.monotonic()
        self._seen = {one: seen for one, seen in self._seen.items() if seen > now - _PRESENT_SECONDS} | {client: now}

    def is_beyond(self, client: str) -> bool:
        """Check whether all places are taken and the client may have an extra one."""
        return self._held.total() >= self.size and self.has_room(client)

    def has_room(self, client: str) -> bool:
        """Check whether a client may have another place."""
        own, taken = self._held[client], self._held.total()
        if own == 0 or taken >= self.size:
            return own == 0 and taken < self.size + self.half
        if own < self.half:
            return True
        if len(self._queues) > (client in self._queues):
            return False
        since = time.monotonic() - _PRESENT_SECONDS
        return taken < self.size - 1 or all(seen < since for one, seen in self._seen.items() if one != client)
