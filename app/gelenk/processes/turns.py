"""Whose turn it is, where clients share a number of places: processes, or jobs that run at a time."""

import time
from collections import Counter, deque
from collections.abc import Iterator
from itertools import chain
from typing import Generic, TypeVar

_Turn = TypeVar("_Turn")

_PRESENT_SECONDS = 2.0
"""A client counts as present for so long after its last turn."""


class Turns(Generic[_Turn]):
    """A queue for each client, and how many places each one holds.

    Turns go round the clients: between two turns of one client each other waiting client has one. A single client has
    all places; beside others it takes more than half of them only if one is left for these. If all places are taken, a
    client that has none gets an extra one, up to half as many more: running work is not interrupted for others.

    Args:
        size: How many places there are.
    """

    def __init__(self, size: int) -> None:
        self.size, self.half = size, max(1, size // 2)
        self._queues: dict[str, deque[_Turn]] = {}  # in the order in which their next turns come
        self._held: Counter[str] = Counter()
        self._seen: dict[str, float] = {}

    def __len__(self) -> int:
        return sum(map(len, self._queues.values()))

    def __iter__(self) -> Iterator[_Turn]:
        return chain.from_iterable(self._queues.values())

    def add(self, client: str, turn: _Turn) -> None:
        """Wait, behind what the client has waiting already."""
        self._queues.setdefault(client, deque()).append(turn)
        self._seen[client] = time.monotonic()

    def remove(self, client: str, turn: _Turn) -> bool:
        """Stop waiting; False if it did not wait."""
        queue = self._queues.get(client)
        if queue is None or turn not in queue:
            return False
        queue.remove(turn)
        if not queue:
            del self._queues[client]
        return True

    def take(self) -> tuple[str, _Turn] | None:
        """The next item to get a place, and its client; None if none may."""
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
        """A client needs a place no longer."""
        self._held[client] -= 1
        self._held += Counter()  # drops those that have none
        now = time.monotonic()
        self._seen = {one: seen for one, seen in self._seen.items() if seen > now - _PRESENT_SECONDS} | {client: now}

    def is_beyond(self, client: str) -> bool:
        """Whether a client would have a place beyond their number."""
        return self._held.total() >= self.size and self.has_room(client)

    def has_room(self, client: str) -> bool:
        """Whether a client may have a place, or one more."""
        own, taken = self._held[client], self._held.total()
        if own == 0 or taken >= self.size:
            return own == 0 and taken < self.size + self.half
        if own < self.half:
            return True
        if len(self._queues) > (client in self._queues):
            return False
        since = time.monotonic() - _PRESENT_SECONDS
        return taken < self.size - 1 or all(seen < since for one, seen in self._seen.items() if one != client)
