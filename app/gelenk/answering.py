"""How a connection answers a request: at once, as far as that needs no waiting, and by few steps.

The underlying server answers in a task, which waits for its turn. Most requests are answered without waiting for
anything, and then the task costs as much as the kinematics.
"""

from asyncio import AbstractEventLoop, Task
from collections.abc import Coroutine, Generator
from contextvars import copy_context
from functools import lru_cache, partial
from types import coroutine
from typing import Any

from uvicorn.protocols.http.httptools_impl import HEADER_RE, HEADER_VALUE_RE, STATUS_LINE, RequestResponseCycle

_REFUSED = bytes(byte for byte in range(256) if HEADER_VALUE_RE.search(bytes([byte])))
"""Bytes that the server refuses in the value of a header field; its regular expression takes four times as long."""

_KEPT = 256
"""Sets of header fields that are remembered: responses have few."""


def answered(cycle: RequestResponseCycle, app: Any, loop: AbstractEventLoop) -> Task[None] | None:
    """Answer a request until it is done, or has to wait for something; return the task that does the rest, if any."""
    receive, send = partial(_receive, cycle), partial(_send, cycle)
    context, answering = copy_context(), cycle.run_asgi(lambda scope, *_: app(scope, receive, send))
    try:
        awaited = context.run(answering.send, None)
    except StopIteration:
        return None
    return loop.create_task(_rest(answering, awaited), context=context)


async def _rest(begun: Coroutine[Any, Any, None], awaited: Any) -> None:
    await _steps(begun, awaited)


@coroutine
def _steps(begun: Coroutine[Any, Any, None], awaited: Any) -> Generator[Any, Any, None]:
    """Pass on what a coroutine that has begun waits for, and what comes of that."""
    try:
        while True:
            try:
                result = yield awaited
            except BaseException as error:  # also a cancellation is the coroutine's to handle
                awaited = begun.throw(error)
            else:
                awaited = begun.send(result)
    except StopIteration:
        return


async def _receive(cycle: RequestResponseCycle) -> Any:
    """Return the next part of a request as the server does; a body that is whole without a wait for it."""
    is_whole = not cycle.more_body and cycle.message_event.is_set()
    is_over = cycle.disconnected or cycle.response_complete
    if not is_whole or is_over or cycle.waiting_for_100_continue or cycle.flow.read_paused:
        return await cycle.receive()
    cycle.message_event.clear()
    body, cycle.body = bytes(cycle.body), bytearray()
    return {"type": "http.request", "body": body, "more_body": False}


async def _send(cycle: RequestResponseCycle, message: Any) -> None:
    """Send a part of a response as the server does; the head of nearly every response at once, not field by field."""
    if message["type"] == "http.response.start" and not (
        cycle.response_started or cycle.disconnected or cycle.flow.write_paused or cycle.access_log
    ):
        headers = [*cycle.default_headers, *message.get("headers", ())]
        place = _place_of_length(tuple([name for name, _ in headers]))
        values = b"".join([value for _, value in headers])
        if place >= 0 and len(values.translate(None, _REFUSED)) == len(values):
            cycle.response_started, cycle.waiting_for_100_continue, cycle.chunked_encoding = True, False, False
            cycle.expected_content_length = int(headers[place][1])
            end = b"\r\n\r\n" if cycle.keep_alive else b"\r\nconnection: close\r\n\r\n"
            cycle.transport.write(STATUS_LINE[message["status"]] + b"\r\n".join(map(b": ".join, headers)) + end)
            return
    await cycle.send(message)


@lru_cache(_KEPT)
def _place_of_length(names: tuple[bytes, ...]) -> int:
    """Return which header field gives the length of the body; -1 if none does, or if others say how it is sent."""
    are_plain = all(name.islower() and not HEADER_RE.search(name) for name in names)
    say_how = {b"connection", b"transfer-encoding"} & set(names)
    return names.index(b"content-length") if are_plain and not say_how and names.count(b"content-length") == 1 else -1
