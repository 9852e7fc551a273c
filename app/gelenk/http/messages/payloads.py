"""Request bodies and responses: strict JSON, CSV, and the choice of a response's media type."""

import json
import re
from collections.abc import AsyncGenerator, Iterable, Iterator, Mapping, Sequence
from functools import cache, lru_cache
from typing import Any, TypeVar

import orjson
from pydantic import BaseModel, ValidationError
from starlette.datastructures import QueryParams
from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response
from starlette.types import Message, Receive, Scope, Send

from gelenk.contract.common import Payload
from gelenk.errors import NoRoomForBody, TooLarge, quoted
from gelenk.http.messages.problems import InvalidPayload
from gelenk.operations.outcome import PictureFormat
from gelenk.operations.rows import csv_head, csv_rows
from gelenk.robot.arrays import Array

MAX_MEMBERS = 1_000_000
"""Maximum number of object members in a body: each unknown one would be a validation error of its own."""

NO_ARRAY = "what this call asks for does not fit into one array: leave `Accept` out for JSON"

MAX_PARAMETERS = 1000
"""Maximum number of query parameters: enough for the frames of the largest robot, one by one."""

JSON = "application/json"
NPY = "application/x-npy"
CSV = "text/csv"
SVG = "image/svg+xml"
PNG = "image/png"
PDF = "application/pdf"
PICTURES: dict[str, PictureFormat] = {SVG: "svg", PNG: "png", PDF: "pdf"}
"""Formats of pictures by their media types, the preferred one first."""
MULTIPART = "multipart/form-data"

SMALL = 64 * 1024
"""Smaller bodies are not counted: connections are limited, and the server buffers as much for each anyway, [bytes]."""
PREFERENCE_APPLIED = {"Preference-Applied": "respond-async"}
"""Header of a response that follows the preference of `wants_answer_later`."""
_STRING = re.compile(rb'"([^"\\]*+(?:\\.[^"\\]*+)*+)(?:"(\s*:)?|\\?\Z)', re.DOTALL)
"""A JSON string, and the colon after it if it is the name of a member.

A string that is cut ends with the bytes: otherwise each quote in it would be tried as the start of another one.
"""
_FIRST = 64 * 1024
"""Leading bytes of a large body, checked first for repeated names."""

_KEPT = 64
"""Values of `Content-Type` that are remembered."""
_JSON_TYPE = b"content-type", JSON.encode()
_WEIGHT = re.compile(r"0(\.\d{0,3})?|1(\.0{0,3})?", re.ASCII)

_Model = TypeVar("_Model", bound=Payload)


class Bodies:
    """Counts the bytes of large bodies that a process holds, from their arrival until their requests are answered.

    Received bytes count, not announced ones: a client that announces many and sends none takes no room from others.
    """

    def __init__(self, allowed: int) -> None:
        self._allowed, self.held = allowed, 0

    def check_room(self, count: int) -> None:
        """Check that there is room for `count` more bytes; raises NoRoomForBody otherwise."""
        if self.held + count > self._allowed:
            raise NoRoomForBody(self._allowed)


class BoundedRequest(Request):
    """A request whose body is never read beyond the limit; `release` returns its bytes to `bodies`.

    It reads headers and body itself, more simply than Starlette does, because every call pays for that.
    """

    def __init__(self, scope: Scope, receive: Receive, send: Send, max_bytes: int, bodies: Bodies) -> None:
        super().__init__(scope, receive, send)
        self._max_bytes, self._bodies = max_bytes, bodies
        self._count = self._held = 0
        self._fields: dict[bytes, bytes] = dict(scope["headers"])

    def release(self) -> None:
        """Note that its bytes are no longer held."""
        self._bodies.held -= self._held
        self._held = 0

    @property
    def media_type(self) -> str:
        """Media type of the body, in lower case, without parameters; "" if none is given."""
        return _media_type(self._fields.get(b"content-type", b""))

    def preferred(self, offered: Sequence[str]) -> str:
        """Return the media type of the response, among those offered; see `preferred_type`."""
        given = self._fields.get(b"accept", b"*/*")
        if given == b"*/*":
            return offered[0]
        accept = given.decode("latin-1")
        return accept if accept in offered else preferred_type(accept, offered)  # most clients name a single type

    @property
    def length(self) -> int:
        """Number of bytes of the body received so far."""
        return self._count

    async def body(self) -> bytes:
        """Return the whole body; raises as `stream` does."""
        return b"".join(await self.pieces())

    async def pieces(self) -> list[bytes]:
        """Return the whole body in the pieces that it arrives in; raises as `stream` does."""
        self._check_announced()
        pieces, more = [], True
        while more:
            chunk, more = self._chunk(await self.receive())
            pieces.append(chunk)
        return pieces

    async def stream(self) -> AsyncGenerator[bytes, None]:
        """Yield the body in pieces; raises TooLarge even for an announced size, NoRoomForBody and ClientDisconnect."""
        self._check_announced()
        more = True
        while more:
            chunk, more = self._chunk(await self.receive())
            yield chunk

    def _check_announced(self) -> None:
        announced = self._fields.get(b"content-length", b"0")
        self._check_size(int(announced) if announced.isdigit() else 0)

    def _chunk(self, message: Message) -> tuple[bytes, bool]:
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


@lru_cache(_KEPT)
def _media_type(content_type: bytes) -> str:
    return content_type.partition(b";")[0].strip().lower().decode("latin-1")


def wants_answer_later(headers: Iterable[tuple[bytes, bytes]]) -> bool:
    """Check whether a request's headers prefer that a job answers it: `Prefer: respond-async` (RFC 7240)."""
    preferences = [value for name, value in headers if name == b"prefer"]
    tokens = b",".join(preferences).split(b",")
    return any(token.partition(b";")[0].strip().lower() == b"respond-async" for token in tokens)


def preferred_type(accept: str, offered: Sequence[str]) -> str:
    """Return the media type of a response by the caller's `Accept` (RFC 9110, 12.5.1).

    Of equal weights the more specific range wins, then the type offered first. That type is also returned if none is
    accepted: a response that can be read is better than none.
    """
    ranges = [_weighted(part) for part in accept.lower().split(",")[:MAX_PARAMETERS]]
    best, best_rank = offered[0], (0.0, 0)
    for media_type in offered:
        group = media_type.partition("/")[0] + "/*"
        found = [(name.count("*"), weight) for name, weight in ranges if name in {media_type, group, "*/*"}]
        # A type's own range decides its weight, even zero, whatever wider ranges say.
        stars, weight = min(found, default=(2, 0.0))
        if (weight, -stars) > best_rank and weight > 0.0:
            best, best_rank = media_type, (weight, -stars)
    return best


def _weighted(part: str) -> tuple[str, float]:
    """Return a media range of `Accept` and its weight, from 0 to 1; 0 if the weight cannot be read."""
    name, *parameters = (word.strip() for word in part.split(";"))
    weight = 1.0
    for parameter in parameters:
        if parameter.startswith("q="):
            weight = float(parameter[2:]) if _WEIGHT.fullmatch(parameter[2:]) else 0.0
    return name, weight


class JsonResponse(Response):
    """Python objects and NumPy arrays as JSON, numbers at full double precision; built and sent by the fewest steps."""

    def __init__(self, content: Any, status: int = 200, headers: Mapping[str, str] | None = None) -> None:
        self.status_code, self.background = status, None
        self.body = orjson.dumps(content, option=orjson.OPT_SERIALIZE_NUMPY)
        self.raw_headers = [(b"content-length", b"%d" % len(self.body)), _JSON_TYPE]
        if headers:
            self.raw_headers += [(k.lower().encode("latin-1"), v.encode("latin-1")) for k, v in headers.items()]

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:  # noqa: ARG002
        """Send the response; a server that can takes the body together with the head."""
        status, headers, body = self.status_code, self.raw_headers, self.body
        head = {"type": "http.response.start", "status": status, "headers": headers, "whole": body}
        await send(head)
        if "whole" in head:
            await send({"type": "http.response.body", "body": body})


def csv_response(columns: Sequence[str], array: Array, headers: dict[str, str]) -> Response:
    """Return an array of shape (N, columns) as CSV (RFC 4180): names, then numbers that read back exactly."""
    body = csv_head(columns) + b"".join(csv_rows(array))
    return Response(body, headers=headers, media_type=f"{CSV}; header=present")


def read_json(model: type[_Model], body: bytes) -> _Model:
    """Parse and check a payload; raises InvalidPayload, or TooLarge for more than `MAX_MEMBERS`."""
    if body.count(b":") > MAX_MEMBERS:
        raise TooLarge("members in the body", body.count(b":"), MAX_MEMBERS)
    try:
        found: _Model = model.__pydantic_validator__.validate_json(body)  # a method of Python around it costs a fifth
    except ValidationError as error:
        raise InvalidPayload.of(error) from None
    _check_members(body)
    return found


def _check_members(body: bytes) -> None:
    """Refuse an object with two members of the same name in valid JSON: parsers differ in which of them counts."""
    if body.count(b'"') < 4:  # a single name
        return
    if len(body) <= _FIRST and b"\\" not in body:
        strings = body.split(b'"')[1::2]
        if len(set(strings)) == len(strings):  # names and values
            return
    # If no two names in the whole body are the same, as in most calls, there is no need to parse it again.
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
    """Parse JSON in a query; return invalid JSON as text, which no object field accepts."""
    try:
        return orjson.loads(text)
    except ValueError:
        return text


@cache
def _json_types(model: type[BaseModel]) -> dict[str, set[Any]]:
    schema = model.model_json_schema()
    fields, models = schema["properties"], schema.get("$defs", {})
    return {
        name: {models.get(choice.get("$ref", "").rpartition("/")[2], choice).get("type") for choice in _choices(field)}
        for name, field in fields.items()
    }


def _choices(field: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield the schemas of which a value of a field needs to follow one."""
    if choices := field.get("anyOf") or field.get("oneOf"):
        for choice in choices:
            yield from _choices(choice)
    else:
        yield field


def read_query(model: type[_Model], query: QueryParams) -> _Model:
    """Read a payload from the query string, for an array body; a list repeats its key, an object is JSON.

    Raises InvalidPayload, or TooLarge for more than `MAX_PARAMETERS`.
    """
    count = len(query.multi_items())
    if count > MAX_PARAMETERS:
        raise TooLarge("parameters in the query", count, MAX_PARAMETERS)
    values: dict[str, Any] = {}
    for key in query:
        given, types = query.getlist(key), _json_types(model).get(key, set())
        if "array" in types and given != ["all"] and (len(given) > 1 or "boolean" not in types):
            values[key] = given
        elif len(given) > 1:
            raise InvalidPayload(True, [{"pointer": f"#/{quoted(key)[1:-1]}", "detail": "it is given twice"}], 1)
        else:
            is_json = "object" in types and ("string" not in types or given[0].startswith("{"))
            values[key] = _object(given[0]) if is_json else given[0]
    try:
        return model.model_validate(values, strict=False)
    except ValidationError as error:
        raise InvalidPayload.of(error) from None
