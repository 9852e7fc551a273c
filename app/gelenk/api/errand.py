"""What a process of the crew is sent to do: a request as a whole, and the function that answers it there.

An errand is a function of a module, or a frozen dataclass with a `__call__`, because it travels by name.
"""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pickle import PickleBuffer
from typing import Protocol, TypeAlias

from starlette.responses import Response

from gelenk.api.payloads import JSON
from gelenk.crew.wire import pieces_of
from gelenk.operations.outcome import Limits
from gelenk.operations.tally import TALLY, Tally
from gelenk.store.library import Library


@dataclass(frozen=True, slots=True)
class Inquiry:
    """A request, as far as an answer depends on it.

    Attributes:
        pieces: The body as it came in.
        robot: The robot that the path names, where it names one.
        query: The query string.
        npy: Whether the body is an array.
        wanted: Media type of the answer.
        endpoint: Name of the operation, where it is one of the table.
    """

    pieces: Sequence[PickleBuffer] = ()
    robot: str = ""
    query: str = ""
    npy: bool = False
    wanted: str = JSON
    endpoint: str = ""

    @property
    def body(self) -> bytes:
        """The whole body."""
        return b"".join(self.pieces)


def buffers(pieces: Sequence[bytes]) -> list[PickleBuffer]:
    """A body, so that it travels without being copied."""
    return [PickleBuffer(piece) for piece in pieces]


@dataclass(frozen=True, slots=True)
class Desk:
    """What a process of the crew has at hand.

    Attributes:
        library: All robots.
        limits: What an answer may take.
    """

    library: Library
    limits: Limits


class Shop(Hashable, Protocol):
    """What a desk is set up from; it is sent along with each errand."""

    def desk(self) -> Desk:
        """Set up the desk that works off the errands."""
        raise NotImplementedError


Errand: TypeAlias = Callable[[Desk, Inquiry], Response]
Reply: TypeAlias = tuple[int, list[tuple[bytes, bytes]], list[PickleBuffer], Tally | None]
"""Status, headers, the body in pieces, and what the metrics count."""


def answered(order: tuple[Shop, Errand, Inquiry]) -> Reply:
    """Run an errand in a process of the crew."""
    shop, errand, inquiry = order
    TALLY.set(None)
    response = errand(_desk(shop), inquiry)
    return response.status_code, response.raw_headers, pieces_of(bytes(response.body)), TALLY.get()


@lru_cache(maxsize=1)
def _desk(shop: Shop) -> Desk:
    return shop.desk()
