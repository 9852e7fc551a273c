"""What a process of the crew is sent to do: a request as a whole, and the function that answers it there.

An errand is a function of a module, or a frozen dataclass with a `__call__`, because it travels by name.
"""

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pickle import PickleBuffer
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeAlias

from starlette.responses import Response

from gelenk.api.payloads import JSON, SVG, json_response, read_json
from gelenk.api.tally import TALLY, Tally
from gelenk.contract.common import Payload
from gelenk.crew.wire import pieces_of
from gelenk.store.library import Library

if TYPE_CHECKING:
    from gelenk.api.routes import Computation


@dataclass(frozen=True, slots=True)
class Inquiry:
    """A request, as far as an answer depends on it.

    Attributes:
        pieces: The body as it came in.
        robot: The robot that the path names, where it names one.
        query: The query string.
        npy: Whether the body is an array.
        wanted: Media type of the answer.
    """

    pieces: Sequence[PickleBuffer] = ()
    robot: str = ""
    query: str = ""
    npy: bool = False
    wanted: str = JSON

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
        computations: The operations on a robot, by name.
    """

    library: Library
    computations: "Mapping[str, Computation[Any]]"


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


@dataclass(frozen=True, slots=True)
class JsonErrand:
    """A JSON request in; JSON or a picture out.

    Attributes:
        model: Of the request.
        content: What the JSON answer holds.
        picture: What draws an SVG or a PNG, where these are offered.
    """

    model: type[Payload]
    content: Callable[[Any], Any]
    picture: Callable[[Any, Literal["svg", "png"]], bytes] | None = None

    def __call__(self, _: Desk, inquiry: Inquiry) -> Response:
        """The answer."""
        call = read_json(self.model, inquiry.body)
        if inquiry.wanted == JSON or self.picture is None:
            return json_response(self.content(call))
        return Response(self.picture(call, "svg" if inquiry.wanted == SVG else "png"), media_type=inquiry.wanted)


@dataclass(frozen=True, slots=True)
class RobotErrand:
    """A JSON request in that may name a robot; JSON out.

    Attributes:
        model: Of the request.
        content: What the answer holds, of the request and the library.
    """

    model: type[Payload]
    content: Callable[[Any, Library], Any]

    def __call__(self, desk: Desk, inquiry: Inquiry) -> Response:
        """The answer."""
        return json_response(self.content(read_json(self.model, inquiry.body), desk.library))
