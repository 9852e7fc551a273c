"""Requests are answered at once, in the bytes that the underlying server would send; what waits goes on in a task."""

import asyncio
from collections.abc import Awaitable, Callable
from typing import Any

import pytest
import uvicorn
from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol
from uvicorn.server import ServerState

from gelenk.connections import BoundedProtocol, ConnectionLimits, Gate

GET = b"GET / HTTP/1.1\r\nHost: x\r\n\r\n"
POST = b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 3\r\n\r\nabc"
App = Callable[[Any, Any, Any], Awaitable[None]]
Headers = list[tuple[bytes, bytes]]
LENGTH = (b"content-length", b"2")


class Wire(asyncio.Transport):
    """A transport that keeps what is written."""

    def __init__(self) -> None:
        super().__init__({"sockname": ("127.0.0.1", 80), "peername": ("127.0.0.1", 9)})
        self.sent, self.writes, self.is_closed = b"", 0, False

    def write(self, data: Any) -> None:
        self.sent, self.writes = self.sent + bytes(data), self.writes + 1

    def is_closing(self) -> bool:
        return self.is_closed

    def close(self) -> None:
        self.is_closed = True

    def get_write_buffer_size(self) -> int:
        return 0

    def pause_reading(self) -> None: ...

    def resume_reading(self) -> None: ...


def connected(app: App, *, bounded: bool = True) -> tuple[Any, Wire]:
    config = uvicorn.Config(app, ws="none", log_level="critical", access_log=False)
    config.load()
    state, wire = ServerState(), Wire()
    state.default_headers = [(b"date", b"Mon, 30 Nov 2026 00:00:00 GMT")]
    kind: Any = BoundedProtocol if bounded else HttpToolsProtocol
    options = {"gate": Gate(ConnectionLimits())} if bounded else {}
    config.loaded_app = app
    protocol = kind(config, state, {}, asyncio.get_running_loop(), **options)
    protocol.connection_made(wire)
    return protocol, wire


def answering(
    headers: Headers, body: bytes = b"ok", status: int = 200, wait: float | None = None, whole: bool = False
) -> App:
    async def app(_: Any, receive: Any, send: Any) -> None:
        while (await receive()).get("more_body"):
            pass
        if wait is not None:
            await asyncio.sleep(wait)
        head: dict[str, Any] = {"type": "http.response.start", "status": status, "headers": headers}
        if whole:
            head["whole"] = body
        await send(head)
        if not whole or "whole" in head:
            await send({"type": "http.response.body", "body": body})

    return app


async def exchanged(protocol: Any, wire: Wire, data: bytes) -> bytes:
    protocol.data_received(data)
    for _ in range(20):
        await asyncio.sleep(0)
    return wire.sent


def test_what_needs_no_waiting_is_answered_before_the_next_bytes_are_read() -> None:
    async def run() -> None:
        protocol, wire = connected(answering([LENGTH]))
        protocol.data_received(POST[:30])
        assert wire.sent == b""
        protocol.data_received(POST[30:] + GET)
        assert wire.sent.count(b"HTTP/1.1 200 OK") == 2
        assert wire.sent.endswith(b"content-length: 2\r\n\r\nok")
        assert not protocol.tasks

    asyncio.run(run())


HEADS: list[Headers] = [
    [LENGTH],
    [LENGTH, (b"content-type", b"application/json"), (b"x-a", b"\xe9\t~")],
    [(b"x-none", b"")],
    [],
    [(b"Content-Length", b"2"), (b"X-Mixed", b"a")],
    [LENGTH, LENGTH],
    [LENGTH, (b"connection", b"close")],
    [LENGTH, (b"connection", b"keep-alive")],
    [(b"transfer-encoding", b"chunked")],
    [(b"content-length", b"3")],
    [(b"content-length", b"1")],
    [(b"content-length", b"0")],
    [LENGTH, (b"x-bad", b"a\r\nb: c")],
    [LENGTH, (b"x-bad", b"\x7f")],
    [LENGTH, (b"x bad", b"a")],
]


@pytest.mark.parametrize("headers", HEADS, ids=str)
def test_the_bytes_are_those_of_the_underlying_server(headers: Headers) -> None:
    async def run() -> None:
        for status, body in ((200, b"ok"), (204, b"ok"), (404, b"ok"), (200, b"")):
            for request in (GET, POST, GET.replace(b"GET", b"HEAD"), GET.replace(b"1.1", b"1.0"), GET + POST):
                theirs = await exchanged(*connected(answering(headers, body, status), bounded=False), request)
                for whole in (False, True):
                    assert theirs == await exchanged(*connected(answering(headers, body, status, whole=whole)), request)

    asyncio.run(run())


TARGETS = (b"/", b"/a%20b/%C3%A4?x=%20", b"/a?", b"/?a=b?c", b"//a/b", b"*", b"a:1")


@pytest.mark.parametrize("target", TARGETS, ids=str)
def test_a_request_is_described_as_by_the_underlying_server(target: bytes) -> None:
    async def run() -> None:
        async def app(scope: Any, receive: Any, send: Any) -> None:
            known = repr(sorted((name, value) for name, value in scope.items() if name != "state")).encode()
            await answering([(b"content-length", b"%d" % len(known))], known)(scope, receive, send)

        for method in (b"GET", b"POST", b"HEAD", b"OPTIONS", b"CONNECT"):
            for version in (b"HTTP/1.0", b"HTTP/1.1"):
                for field in (b"", b"Connection: keep-alive\r\n", b"Connection: upgrade\r\nUpgrade: websocket\r\n"):
                    request = method + b" " + target + b" " + version + b"\r\nHost: x\r\n" + field + b"\r\n"
                    ours, theirs = [
                        await exchanged(*connected(app, bounded=bounded), request) for bounded in (True, False)
                    ]
                    assert ours == theirs or ours[:12] == theirs[:12] == b"HTTP/1.1 400"

    asyncio.run(run())


def test_a_body_that_comes_with_its_head_is_sent_with_it() -> None:
    async def run() -> None:
        protocol, wire = connected(answering([LENGTH], whole=True))
        assert (await exchanged(protocol, wire, POST + POST)).count(b"\r\n\r\nok") == wire.writes == 2

    asyncio.run(run())


def test_the_rest_of_what_waits_gets_results_errors_and_cancellations() -> None:
    async def run() -> None:
        seen: list[str] = []
        loop = asyncio.get_running_loop()
        futures = [loop.create_future() for _ in range(3)]

        async def app(_: Any, __: Any, send: Any) -> None:
            seen.append(await futures[0])
            try:
                await futures[1]
            except ValueError as error:
                seen.append(str(error))
            assert asyncio.current_task() is not None
            try:
                await futures[2]
            except asyncio.CancelledError:
                seen.append("cancelled")
            await answering([LENGTH])(_, __, send)

        protocol, wire = connected(app)
        protocol.data_received(POST)
        (task,) = protocol.tasks
        futures[0].set_result("result")
        await asyncio.sleep(0.01)
        futures[1].set_exception(ValueError("error"))
        await asyncio.sleep(0.01)
        task.cancel()
        await task
        assert seen == ["result", "error", "cancelled"]
        assert wire.sent.endswith(b"ok")
        await asyncio.sleep(0)
        assert not protocol.tasks

    asyncio.run(run())


def test_a_failure_before_any_waiting_is_the_servers_to_answer() -> None:
    async def run() -> None:
        async def app(_: Any, __: Any, ___: Any) -> None:
            raise ValueError

        assert (await exchanged(*connected(app), GET)).startswith(b"HTTP/1.1 500")

    asyncio.run(run())


def test_pipelined_requests_are_answered_in_order_however_many() -> None:
    async def run() -> None:
        numbers = iter(range(10**6))

        async def app(scope: Any, receive: Any, send: Any) -> None:
            number = b"%06d" % next(numbers)
            wait = 0.01 if scope["path"] == "/slow" else None
            await answering([(b"content-length", b"6")], number, wait=wait)(scope, receive, send)

        protocol, wire = connected(app)
        protocol.data_received(GET.replace(b"/ ", b"/slow ") + GET.replace(b"/ ", b"/healthz ") * 2000)
        while wire.sent.count(b"200 OK") < 2001:
            await asyncio.sleep(0.001)
        bodies = [int(part[:6]) for part in wire.sent.split(b"\r\n\r\n")[1:]]
        assert bodies == list(range(2001))

    asyncio.run(run())


def test_after_the_last_answer_of_a_connection_nothing_more_is_run() -> None:
    async def run() -> None:
        count = 0

        async def app(scope: Any, receive: Any, send: Any) -> None:
            nonlocal count
            count += 1
            await answering([LENGTH])(scope, receive, send)

        sent = await exchanged(*connected(app), GET.replace(b"\r\n\r\n", b"\r\nConnection: close\r\n\r\n") + GET)
        assert (count, sent.count(b"HTTP/1.1")) == (1, 1)

    asyncio.run(run())
