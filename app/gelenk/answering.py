"""How a connection answers a request: at once, as far as that needs no waiting, and by few steps.

The underlying server answers in a task, which waits for its turn. Most requests are answered without waiting for
anything, and then the task costs as much as the kinematics.
"""

from asyncio import AbstractEventLoop, Task
from collections.abc import Coroutine, Generator
from contextvars import copy_context
from functools import lru_cache
from types import coroutine
from typing import Any

from uvicorn.protocols.http.httptools_impl import HEADER_RE, HEADER_VALUE_RE, STATUS_LINE, RequestResponseCycle

_REFUSED = bytes(byte for byte in range(256) if HEADER_VALUE_RE.search(bytes([byte])))
"""Bytes that the server refuses in the value of a header field; its regular expression takes four times as long."""

_KEPT = 256
"""Sets of header fields that are remembered: responses have few."""


def answered(cycle: RequestResponseCycle, app: Any, loop: AbstractEventLoop) -> Task[None] | None:
    """Answer a request until it is done, or has to wait for something; return the task that does the rest, if any."""
    context, answering = copy_context(), cycle.run_asgi(app)
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


class RequestCycle(RequestResponseCycle):
    """A request and its response, as the server has them, in fewer steps."""

    async def receive(self) -> Any:
        """Return the next part of a request as the server does; a body that is whole without a wait for it."""
        is_whole = not self.more_body and self.message_event.is_set()
        is_over = self.disconnected or self.response_complete
        if not is_whole or is_over or self.waiting_for_100_continue or self.flow.read_paused:
            return await super().receive()
        self.message_event.clear()
        body, self.body = bytes(self.body), bytearray()
        return {"type": "http.request", "body": body, "more_body": False}

    async def send(self, message: Any) -> None:
        """Send a part of a response as the server does; the head of nearly every response at once, not field by field.

        A body under the key `whole` of its head goes with it, and is taken from the message.
        """
        if message["type"] == "http.response.start" and not (
            self.response_started or self.disconnected or self.flow.write_paused or self.access_log
        ):
            headers = [*self.default_headers, *message.get("headers", ())]
            place = _place_of_length(tuple([name for name, _ in headers]))
            fields = b"\r\n".join(map(b": ".join, headers))
            if place >= 0 and len(fields.translate(None, _REFUSED)) == len(fields) - 2 * (len(headers) - 1):
                self.response_started, self.waiting_for_100_continue, self.chunked_encoding = True, False, False
                self.expected_content_length = length = int(headers[place][1])
                end = b"\r\n\r\n" if self.keep_alive else b"\r\nconnection: close\r\n\r\n"
                head, body = STATUS_LINE[message["status"]] + fields + end, message.get("whole")
                if body is None or len(body) != length or not self.keep_alive or self.scope["method"] == "HEAD":
                    self.transport.write(head)
                    return
                del message["whole"]
                self.transport.write(head + body)
                self.expected_content_length, self.response_complete = 0, True
                self.message_event.set()
                self.on_response()
                return
        await super().send(message)


@lru_cache(_KEPT)
def _place_of_length(names: tuple[bytes, ...]) -> int:
    """Return which header field gives the length of the body; -1 if none does, or if others say how it is sent."""
    are_plain = all(name.islower() and not HEADER_RE.search(name) for name in names)
    say_how = {b"connection", b"transfer-encoding"} & set(names)
    return names.index(b"content-length") if are_plain and not say_how and names.count(b"content-length") == 1 else -1
