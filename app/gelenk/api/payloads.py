"""Bodies in, answers out: JSON, strictly; and in which of its shapes an answer is wanted."""

import json
import re
from collections.abc import AsyncGenerator, Sequence
from typing import Any, Self, TypeVar

import orjson
from pydantic import ValidationError
from starlette.datastructures import QueryParams
from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from gelenk.api.bodies import SMALL, Bodies
from gelenk.api.problems import InvalidPayload
from gelenk.contract.common import Payload
from gelenk.model.arrays import Array
from gelenk.model.errors import TooLarge, quoted
from gelenk.operations.rows import csv_head, csv_rows

MAX_MEMBERS = 1_000_000
"""Members of objects in a body: each unknown one would be a validation error of its own."""

NO_ARRAY = "what this call asks for does not fit into one array: leave `Accept` out for JSON"

MAX_PARAMETERS = 1000
"""Parameters in a query: enough for the frames of the largest robot, one by one."""

JSON = "application/json"
NPY = "application/x-npy"
CSV = "text/csv"
SVG = "image/svg+xml"
PNG = "image/png"

_STRING = re.compile(rb'"([^"\\]*+(?:\\.[^"\\]*+)*+)(?:"(\s*:)?|\\?\Z)', re.DOTALL)
"""A string of JSON, and the colon behind it where it is the name of a member.

One that is cut ends with the bytes: if it were none, each quote in it would be tried as the begin of another.
"""
_FIRST = 64 * 1024
"""Bytes of a large body that tell at once whether names come more than once."""

_WEIGHT = re.compile(r"0(\.\d{0,3})?|1(\.0{0,3})?", re.ASCII)
_ANYTHING = frozenset({b"", b"*/*", b"application/json"})

_Model = TypeVar("_Model", bound=Payload)


class BoundedRequest(Request):
    """A request whose body is never read beyond the limit; on leaving its context it holds no body.

    It does its own reading of headers and body, both plainer than Starlette's, because every call pays for them.

    Args:
        scope: As the server has it.
        receive: What gives the body.
        send: What takes an answer.
        max_bytes: Of the body.
        bodies: Those that the process holds.
    """

    def __init__(self, scope: Scope, receive: Receive, send: Send, max_bytes: int, bodies: Bodies) -> None:
        super().__init__(scope, receive, send)
        self._max_bytes, self._bodies = max_bytes, bodies
        self._count = self._held = 0
        self._fields: dict[bytes, bytes] = dict(scope["headers"])

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._bodies.held -= self._held
        self._held = 0

    @property
    def media_type(self) -> str:
        """The media type of the body, lower case, without parameters; "" where none is given."""
        return self._fields.get(b"content-type", b"").partition(b";")[0].strip().lower().decode("latin-1")

    def preferred(self, offered: Sequence[str]) -> str:
        """The media type in which the caller wants the answer, of those offered; see `preferred_type`."""
        accept = self._fields.get(b"accept", b"")
        # What nearly every client sends names none but the first.
        return offered[0] if accept in _ANYTHING else preferred_type(accept.decode("latin-1"), offered)

    @property
    def length(self) -> int:
        """Bytes of the body that have come in."""
        return self._count

    async def body(self) -> bytes:
        """The whole body; raises as `pieces` does."""
        return b"".join(await self.pieces())

    async def pieces(self) -> list[bytes]:
        """The whole body as it comes in.

        Raises:
            TooLarge: It is larger than allowed, or says so.
            NoRoomForBody: Other large bodies take all the room there is.
            ClientDisconnect: The caller has left.
        """
        pieces, more = [], True
        while more:
            piece, more = await self._receive_chunk()
            pieces.append(piece)
        return pieces

    async def stream(self) -> AsyncGenerator[bytes, None]:
        """The body in pieces; raises as `pieces` does."""
        more = True
        while more:
            chunk, more = await self._receive_chunk()
            yield chunk

    async def _receive_chunk(self) -> tuple[bytes, bool]:
        """The next piece of the body, and whether there is more."""
        if self._count == 0:
            announced = self._fields.get(b"content-length", b"0")
            self._check_size(int(announced) if announced.isdigit() else 0)
        message = await self.receive()
        if message["type"] == "http.disconnect":
            raise ClientDisconnect
        chunk: bytes = message.get("body", b"")
        self._count += len(chunk)
        self._check_size(self._count)
        if self._count > SMALL:
            self._bodies.held += self._count - self._held
            self._held = self._count
        return chunk, message.get("more_body", False)

    def _check_size(self, count: int) -> None:
        if count > self._max_bytes:
            raise TooLarge("bytes in the body", count, self._max_bytes)
        if count > SMALL:
            self._bodies.check_room(count - self._held)


def preferred_type(accept: str, offered: Sequence[str]) -> str:
    """The media type of an answer by the caller's `Accept` (RFC 9110, 12.5.1).

    Of equal weights the more specific range wins, then what is offered first. That is also the answer where nothing
    offered is accepted: an answer that can be read is better than none.

    Args:
        accept: The header.
        offered: Media types, the default one first.
    """
    ranges = [_weighted(part) for part in accept.lower().split(",")[:MAX_PARAMETERS]]
    best, best_rank = offered[0], (0.0, 0)
    for media_type in offered:
        group = media_type.partition("/")[0] + "/*"
        found = [(name.count("*"), weight) for name, weight in ranges if name in {media_type, group, "*/*"}]
        # A range of its own settles a type's weight, be it zero, whatever wider ranges say.
        stars, weight = min(found, default=(2, 0.0))
        if (weight, -stars) > best_rank and weight > 0.0:
            best, best_rank = media_type, (weight, -stars)
    return best


def _weighted(part: str) -> tuple[str, float]:
    """A media range of `Accept` and its weight, between 0 and 1; one that cannot be read counts for nothing."""
    name, *parameters = (word.strip() for word in part.split(";"))
    weight = 1.0
    for parameter in parameters:
        if parameter.startswith("q="):
            weight = float(parameter[2:]) if _WEIGHT.fullmatch(parameter[2:]) else 0.0
    return name, weight


def json_response(content: Any, status: int = 200, headers: dict[str, str] | None = None) -> Response:
    """Python objects and NumPy arrays as JSON, numbers at full double precision."""
    body = orjson.dumps(content, option=orjson.OPT_SERIALIZE_NUMPY)
    return Response(body, status, headers, JSON)


def csv_response(columns: Sequence[str], array: Array, headers: dict[str, str]) -> Response:
    """A table as CSV (RFC 4180): a row of names, then numbers that read back to the last bit.

    Args:
        columns: Names; at least one.
        array: Shape (N, columns).
        headers: Of the answer.
    """
    body = csv_head(columns) + b"".join(csv_rows(array))
    return Response(body, headers=headers, media_type=f"{CSV}; header=present")


def read_json(model: type[_Model], body: bytes) -> _Model:
    """A payload, checked.

    Raises:
        InvalidPayload: It is not what the model asks for.
    """
    if body.count(b":") > MAX_MEMBERS:
        raise TooLarge("members in the body", body.count(b":"), MAX_MEMBERS)
    try:
        found = model.model_validate_json(body)
    except ValidationError as error:
        raise InvalidPayload.of(error) from None
    _check_members(body)
    return found


def _check_members(body: bytes) -> None:
    """Refuse an object with two members of the same name: readers of JSON differ in which of them counts.

    Args:
        body: JSON that has been read already.

    Raises:
        InvalidPayload: There is such an object.
    """
    # Where no two names in the whole body are the same there is nothing to parse once more: so it is with most calls.
    for part in (body[:_FIRST], body) if len(body) > _FIRST else (body,):
        names = [name for name, colon in _STRING.findall(part) if colon]
        if len(set(names)) < len(names) or any(b"\\" in name for name in names):
            break
    else:
        return
    json.loads(body, object_pairs_hook=_without_doubles, parse_int=float)


def _without_doubles(members: list[tuple[str, Any]]) -> None:
    names = [name for name, _ in members]
    if len(set(names)) < len(names):
        double = next(name for i, name in enumerate(names) if name in names[:i])
        detail = f"an object has two members of the name {quoted(double)}"
        raise InvalidPayload(True, [{"pointer": "#", "detail": detail}], 1)


def _object(text: str) -> Any:
    """What JSON in a query says; the text itself, which no object field takes, where it is none."""
    try:
        return orjson.loads(text)
    except ValueError:
        return text


def read_query(model: type[_Model], query: QueryParams) -> _Model:
    """A payload from the query string, where the body is an array; a list field takes its key repeatedly.

    Raises:
        InvalidPayload: It is not what the model asks for.
        TooLarge: More than `MAX_PARAMETERS`.
    """
    items = query.multi_items()
    if len(items) > MAX_PARAMETERS:
        raise TooLarge("parameters in the query", len(items), MAX_PARAMETERS)
    values: dict[str, Any] = {}
    for key, value in items:
        is_repeated = key in model.vector_fields and len(query.getlist(key)) > 1
        if is_repeated or (key in model.list_fields and value != "all"):
            values.setdefault(key, []).append(value)
        elif key in values:
            raise InvalidPayload(True, [{"pointer": f"#/{quoted(key)[1:-1]}", "detail": "it is given twice"}], 1)
        else:
            values[key] = _object(value) if key in model.object_fields else value
    try:
        return model.model_validate(values, strict=False)
    except ValidationError as error:
        raise InvalidPayload.of(error) from None
