"""Connections: slow, silent, oversized and too many of them; none of it changes anything for the others."""

import asyncio
import json
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from random import Random
from typing import Any, Literal, cast

import pytest
import uvicorn

from gelenk.connections import BoundedProtocol, ConnectionLimits, Gate

HOST = "127.0.0.1"
GET = b"GET / HTTP/1.1\r\nHost: x\r\n\r\n"
USUAL = ConnectionLimits()
QUICK = ConnectionLimits(head_seconds=1.5, body_seconds=1.5, stalled_seconds=1.5)
"""For tests of what takes too long: whoever is quick must be so on a busy machine too."""


class Application:
    """Answers with the length of the body; at other paths slowly, hugely, or when it may.

    Attributes:
        begun: Paths of the requests whose body has come, in order.
        left: How many clients have left before that.
        may_end: Set when `/waits`, `/held` and `/halves` may be answered, of which `/held` holds up all others.
    """

    def __init__(self) -> None:
        self.begun: list[str] = []
        self.left = 0
        self.may_end = threading.Event()
        self.headers: list[tuple[bytes, bytes]] = []
        self.path = ""

    async def __call__(self, scope: Any, receive: Any, send: Any) -> None:
        assert scope["type"] == "http"
        self.headers, self.path = scope["headers"], scope["path"]
        size, more = 0, True
        while more:
            message = await receive()
            if message["type"] == "http.disconnect":
                self.left += 1
                return
            size, more = size + len(message.get("body", b"")), message.get("more_body", False)
        body = str(size).encode()
        self.begun.append(scope["path"])
        match scope["path"]:
            case "/slow":
                await asyncio.sleep(3.0)
            case "/waits":
                await asyncio.to_thread(self.may_end.wait, 60.0)
            case "/busy":
                time.sleep(0.01)
            case "/held":
                self.may_end.wait(60.0)
            case "/full":
                scope["state"]["retry_after"] = 8
            case "/endless":
                while not scope["state"].get("stopping"):
                    await asyncio.sleep(0.02)
            case "/huge":
                body = bytes(50_000_000)
        await send(
            {"type": "http.response.start", "status": 200, "headers": [(b"content-length", str(len(body)).encode())]}
        )
        if scope["path"] == "/halves":
            await send({"type": "http.response.body", "body": body[:0], "more_body": True})
            await asyncio.to_thread(self.may_end.wait, 60.0)
        await send({"type": "http.response.body", "body": body})


@contextmanager
def serving(bounds: ConnectionLimits = USUAL) -> Iterator[tuple[int, Gate, Application, uvicorn.Server]]:
    gate, app = Gate(bounds), Application()
    with served(app, gate) as (port, server):
        yield port, gate, app, server


@contextmanager
def served(app: Any, gate: Gate, lifespan: Literal["on", "off"] = "off") -> Iterator[tuple[int, uvicorn.Server]]:
    """An application behind bounded connections, in a thread: its port, and the server."""
    config = uvicorn.Config(
        app,
        loop="asyncio",
        http=cast(type[asyncio.Protocol], partial(BoundedProtocol, gate=gate)),
        ws="none",
        lifespan=lifespan,
        log_level="critical",
        timeout_graceful_shutdown=60,
    )
    server = uvicorn.Server(config)
    listener = socket.create_server((HOST, 0), backlog=2048)
    thread = threading.Thread(target=server.run, args=([listener],), daemon=True)
    thread.start()
    wait_for(lambda: server.started)
    try:
        yield listener.getsockname()[1], server
    finally:
        server.should_exit = True
        thread.join(90)
        assert not thread.is_alive()
        listener.close()


def wait_for(condition: Any, seconds: float = 60.0) -> None:
    until = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < until
        time.sleep(0.01)


def connected(port: int) -> socket.socket:
    return socket.create_connection((HOST, port), timeout=60)


def answer(connection: socket.socket) -> tuple[int, dict[str, str], bytes]:
    """One answer; an empty one where the connection was closed without."""
    head = b""
    while b"\r\n\r\n" not in head:
        piece = connection.recv(65536)
        if not piece:
            return 0, {}, b""
        head += piece
    head, _, body = head.partition(b"\r\n\r\n")
    first, *lines = head.decode().split("\r\n")
    headers = {name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines)}
    while len(body) < int(headers.get("content-length", 0)):
        body += connection.recv(1_000_000)
    return int(first.split()[1]), headers, body


def check_problem(found: tuple[int, dict[str, str], bytes], status: int, kind: str) -> None:
    assert found[0] == status
    assert found[1]["content-type"] == "application/problem+json"
    problem = json.loads(found[2])
    assert (problem["status"], problem["type"]) == (status, f"urn:gelenk:{kind}")
    assert set(problem) == {"type", "title", "status", "detail", "instance"}


def still_answers(port: int) -> None:
    with connected(port) as connection:
        for _ in range(3):
            connection.sendall(GET)
            assert answer(connection)[0::2] == (200, b"0")


@pytest.mark.slow
@pytest.mark.parametrize("start", [b"", b"G", b"GET / HTTP/1.1\r\nHost: x\r\n", b"\r\n"])
def test_a_head_that_does_not_come_is_not_waited_for(start: bytes) -> None:
    began = time.monotonic()
    with serving(QUICK) as (port, gate, _, _), connected(port) as connection:
        connection.sendall(start)
        found = answer(connection)
        assert QUICK.head_seconds < time.monotonic() - began < 30.0
        if start.strip():
            check_problem(found, 408, "request-too-slow")
        else:
            assert found[0] == 0
        wait_for(lambda: gate.closed == 1)
        still_answers(port)


@pytest.mark.slow
def test_a_head_that_trickles_in_gets_no_more_time_for_it() -> None:
    with serving(QUICK) as (port, gate, _, _), connected(port) as connection:
        began = time.monotonic()
        with pytest.raises(OSError):
            connection.sendall(b"GET / HTTP/1.1\r\n")
            while time.monotonic() - began < 30.0:
                connection.sendall(b"X: y\r\n")
                time.sleep(0.1)
        assert time.monotonic() - began < 30.0
        wait_for(lambda: gate.closed == 1)


@pytest.mark.slow
def test_a_second_request_has_the_same_time() -> None:
    with serving(QUICK) as (port, _, _, _), connected(port) as connection:
        connection.sendall(GET)
        assert answer(connection)[0] == 200
        connection.sendall(b"GET /")
        check_problem(answer(connection), 408, "request-too-slow")


@pytest.mark.slow
def test_half_a_body_is_not_waited_for_and_whoever_reads_it_is_told() -> None:
    with serving(QUICK) as (port, gate, app, _), connected(port) as connection:
        connection.sendall(b"POST / HTTP/1.1\r\nContent-Length: 10\r\n\r\n12345")
        check_problem(answer(connection), 408, "request-too-slow")
        wait_for(lambda: app.left == 1)
        wait_for(lambda: gate.closed == 1)
        still_answers(port)


@pytest.mark.slow
def test_a_long_body_has_time_while_it_keeps_coming() -> None:
    bounds = ConnectionLimits(head_seconds=60.0, body_seconds=3.0)
    with serving(bounds) as (port, gate, _, _), connected(port) as connection:
        size, count = 16_000, 40
        connection.sendall(f"POST / HTTP/1.1\r\nContent-Length: {size * count}\r\n\r\n".encode())
        for _ in range(count):
            connection.sendall(bytes(size))
            time.sleep(0.1)
        assert answer(connection)[0::2] == (200, str(size * count).encode())
        assert gate.closed == 0


@pytest.mark.slow
def test_who_takes_nothing_of_an_answer_is_cut_off() -> None:
    with serving(QUICK) as (port, gate, _, _), connected(port) as connection:
        connection.sendall(GET.replace(b"/ ", b"/huge "))
        wait_for(lambda: gate.closed == 1)
        wait_for(lambda: not gate.connections)
        still_answers(port)


@pytest.mark.slow
def test_who_takes_an_answer_slowly_gets_it() -> None:
    with serving(QUICK) as (port, gate, _, _), connected(port) as connection:
        connection.sendall(GET.replace(b"/ ", b"/huge "))
        began, received = time.monotonic(), 0
        while received < 50_000_000:
            received += len(connection.recv(1_000_000))
            time.sleep(0.1)
        assert time.monotonic() - began > 2 * QUICK.stalled_seconds
        assert gate.closed == 0


@pytest.mark.slow
def test_a_long_computation_is_not_the_clients_fault() -> None:
    with serving(QUICK) as (port, gate, _, _), connected(port) as connection:
        connection.sendall(GET.replace(b"/ ", b"/slow "))
        assert answer(connection)[0] == 200
        assert gate.closed == 0


@pytest.mark.parametrize("field", [b"X: " + b"a" * 70_000, b"\r\n".join(b"X%d: y" % i for i in range(10_000))])
def test_a_head_has_a_size(field: bytes) -> None:
    with serving() as (port, _, _, _), connected(port) as connection:
        connection.sendall(b"GET / HTTP/1.1\r\n" + field)
        check_problem(answer(connection), 431, "head-too-large")
        still_answers(port)


def chunked(trailers: bytes = b"", extension: bytes = b"", body: bytes = b"12345") -> bytes:
    head = b"POST / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n"
    return head + b"%x%b\r\n%b\r\n0\r\n%b\r\n" % (len(body), extension, body, trailers)


@pytest.mark.slow
def test_trailers_add_nothing_to_the_headers_whatever_their_name() -> None:
    random = Random(1)
    names = ["Host", "Authorization", "Prefer", "Content-Type", "Origin", "Accept", "Expect"]
    names += ["".join(random.choices("abcXYZ-_019", k=random.randint(1, 40))) for _ in range(40)]
    with serving() as (port, _, app, _), connected(port) as connection:
        connection.sendall(chunked())
        assert answer(connection)[0::2] == (200, b"5")
        plain = app.headers
        for name in names:
            connection.sendall(chunked(f"{name}: 100-continue\r\n".encode()))
            assert answer(connection)[0::2] == (200, b"5")
            assert app.headers == plain


@pytest.mark.quick(2)
@pytest.mark.parametrize("trickles", [False, True])
@pytest.mark.parametrize("kind", ["one trailer", "trailers", "extension", "extensions"])
def test_trailers_and_chunk_extensions_are_bounded_like_a_head(kind: str, trickles: bool) -> None:
    start, piece = {
        "one trailer": (chunked()[:-2] + b"X: ", b"a" * 1000),
        "trailers": (chunked()[:-2], b"X: " + b"a" * 995 + b"\r\n"),
        "extension": (chunked()[: -len(b"0\r\n\r\n")] + b"1;a=", b"b" * 1000),
        "extensions": (chunked()[: -len(b"0\r\n\r\n")], b"1;a=" + b"b" * 990 + b"\r\nx\r\n"),
    }[kind]
    with serving() as (port, _, _, _), connected(port) as connection:
        sent = 0
        connection.sendall(start)
        with suppress(BrokenPipeError, ConnectionResetError):
            for _ in range(20_000):
                connection.sendall(piece if trickles else piece * 100)
                sent += len(piece) * (1 if trickles else 100)
        assert sent < 10_000_000  # what the system's buffers take is not refused yet
        with suppress(ConnectionResetError):
            check_problem(answer(connection), 431, "head-too-large")
        still_answers(port)


def test_a_body_in_chunks_of_a_byte_is_within_bounds() -> None:
    with serving(ConnectionLimits(body_seconds=20.0)) as (port, _, _, _), connected(port) as connection:
        head = b"POST / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n"
        connection.sendall(head + b"0000000000000001\r\nx\r\n" * 40_000 + b"0\r\n\r\n")
        assert answer(connection)[0::2] == (200, b"40000")


def test_large_bodies_with_the_next_request_behind_them_are_no_large_head() -> None:
    with serving() as (port, _, _, _), connected(port) as connection:
        post = b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 200000\r\n\r\n" + bytes(200_000)
        for _ in range(5):
            connection.sendall(post + b"GET / HT")
            assert answer(connection)[0::2] == (200, b"200000")
            connection.sendall(b"TP/1.1\r\nHost: x\r\n\r\n")
            assert answer(connection)[0::2] == (200, b"0")


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("target", "host", "path"),
    [
        (b"/p", b"x", "/p"),
        (b"http://y:80/p?a=//z/", b"y:80", "/p"),
        (b"HTTPS://y/", b"y", "/"),
        (b"http://y", b"y", "/"),
        (b"http://y?a=b", b"y", "/"),
        (b"http://x@y/p", b"x@y", "/p"),
    ],
)
def test_the_host_in_a_target_counts_in_the_place_of_the_field(target: bytes, host: bytes, path: str) -> None:
    with serving() as (port, _, app, _), connected(port) as connection:
        connection.sendall(b"GET %b HTTP/1.1\r\nHost: x\r\n\r\n" % target)
        assert answer(connection)[0] == 200
        assert (dict(app.headers)[b"host"], app.path) == (host, path)


def test_what_is_not_http_is_a_problem() -> None:
    with serving() as (port, _, _, _), connected(port) as connection:
        connection.sendall(b"HELO there\r\n\r\n")
        check_problem(answer(connection), 400, "malformed-request")
        still_answers(port)


@pytest.mark.slow
def test_slow_sockets_give_way_to_others_where_there_are_too_many() -> None:
    with serving(ConnectionLimits(connections=50)) as (port, gate, _, _):
        slow = [connected(port) for _ in range(150)]
        for connection in slow:
            connection.sendall(b"GET /")
        for _ in range(5):
            still_answers(port)
        wait_for(lambda: len(gate.connections) <= 50)
        wait_for(lambda: gate.closed >= 100)
        for connection in slow:
            connection.close()


def test_of_few_connections_most_stay_where_one_has_to_go() -> None:
    with serving(ConnectionLimits(connections=16)) as (port, gate, _, _), ExitStack() as crowd:
        for count in range(1, 17):
            crowd.enter_context(connected(port))
            wait_for(lambda count=count: len(gate.connections) == count)
        still_answers(port)
        assert 0 < gate.closed <= 4


@pytest.mark.slow
def test_of_a_crowd_that_comes_at_once_the_newest_stay() -> None:
    """All are let in within a turn of the event loop, in which those that have to go are still there."""
    with serving(ConnectionLimits(connections=16)) as (port, gate, app, _), ExitStack() as crowd:
        watching = crowd.enter_context(connected(port))
        watching.sendall(GET.replace(b"/ ", b"/held "))
        wait_for(lambda: app.begun)
        newest = [crowd.enter_context(connected(port)) for _ in range(100)][-10:]
        for connection in newest:
            connection.sendall(GET)
        app.may_end.set()
        assert [answer(connection)[0] for connection in newest] == [200] * 10
        wait_for(lambda: 10 <= len(gate.connections) <= 16)


@pytest.mark.slow
def test_where_all_are_at_work_a_new_connection_is_told_so() -> None:
    with serving(ConnectionLimits(connections=3)) as (port, _, app, _):
        working = [connected(port) for _ in range(3)]
        for connection in working:
            connection.sendall(GET.replace(b"/ ", b"/waits "))
        wait_for(lambda: len(app.begun) == 3)
        with connected(port) as one_more:
            found = answer(one_more)
            check_problem(found, 503, "service-busy")
            assert found[1]["retry-after"] == "1"
        app.may_end.set()
        assert [answer(connection)[0] for connection in working] == [200] * 3
        for connection in working:
            connection.close()


@pytest.mark.slow
def test_too_many_requests_at_once_are_refused_at_once_and_health_is_answered() -> None:
    """Each takes 10 ms of the event loop, and a hundred may wait; whoever watches does not wait for them."""
    with (
        serving(ConnectionLimits(waiting=100)) as (port, gate, app, _),
        connected(port) as first,
        connected(port) as watching,
    ):
        connections = [connected(port) for _ in range(160)]
        wait_for(lambda: len(gate.connections) == 162)
        first.sendall(GET.replace(b"/ ", b"/held "))
        wait_for(lambda: app.begun)
        for connection in connections:
            connection.sendall(GET.replace(b"/ ", b"/busy "))
        watching.sendall(GET.replace(b"/ ", b"/healthz "))
        app.may_end.set()  # all of them have come by now, however slowly they were sent
        assert answer(watching)[0] == 200
        found = [answer(connection) for connection in connections]
        refused = [one for one in found if one[0] == 503]
        assert gate.refused == len(refused) > 0
        for one in refused:
            check_problem(one, 503, "service-busy")
        assert len(found) - len(refused) >= 100
        assert app.begun.index("/healthz") < 60
        for connection in connections:
            connection.sendall(GET)
            assert answer(connection)[0] == 200
            connection.close()


@pytest.mark.slow
def test_who_asks_again_sooner_than_told_is_not_read_from_until_then_nearly() -> None:
    """By an application that says for how long: it is no work to refuse whom nobody listens to."""
    with serving() as (port, _, app, _), connected(port) as connection, connected(port) as other:
        began = time.monotonic()
        connection.sendall(GET.replace(b"/ ", b"/full "))
        assert answer(connection)[0] == 200
        connection.sendall(GET)
        other.sendall(GET.replace(b"/ ", b"/other "))
        assert answer(other)[0] == 200
        assert app.begun == ["/full", "/other"]
        assert answer(connection)[0] == 200
        assert time.monotonic() - began > 0.75 * 8


@pytest.mark.slow
def test_pipelined_requests_that_are_refused_end_the_connection() -> None:
    with serving(ConnectionLimits(waiting=1)) as (port, _, _, _), connected(port) as connection:
        busy = [connected(port) for _ in range(30)]
        for one in busy:
            one.sendall(GET.replace(b"/ ", b"/busy ") * 50)
        connection.sendall(GET * 2000)
        status = answer(connection)[0]
        assert status in {200, 503}
        for one in busy:
            one.close()
        still_answers(port)


@pytest.mark.slow
def test_whose_answer_has_begun_when_the_end_comes_may_ask_again_and_is_told() -> None:
    """The head of that answer did not say that it is the last one of its connection: it must not be."""
    with serving() as (port, gate, app, _), connected(port) as connection:
        connection.sendall(GET.replace(b"/ ", b"/halves "))
        head = connection.recv(65536)
        assert head.startswith(b"HTTP/1.1 200") and b"close" not in head
        gate.stop()
        app.may_end.set()
        assert connection.recv(65536) == b"0"
        connection.sendall(GET)
        found = answer(connection)
        assert (found[0], found[1]["connection"]) == (200, "close")


@pytest.mark.slow
def test_a_shutdown_waits_for_answers_and_hardly_for_clients() -> None:
    with serving() as (port, gate, app, server):
        idle, slow, half, endless, head = (connected(port) for _ in range(5))
        slow.sendall(GET.replace(b"/ ", b"/waits "))
        half.sendall(b"POST / HTTP/1.1\r\nContent-Length: 10\r\n\r\n12345")
        endless.sendall(GET.replace(b"/ ", b"/endless "))
        head.sendall(b"GET /")
        wait_for(lambda: len(gate.connections) == 5)
        wait_for(lambda: sum(one.cycle is not None for one in gate.connections) == 3)
        wait_for(lambda: any(one._in_head for one in gate.connections))
        began = time.monotonic()
        server.should_exit = True
        assert answer(endless)[0] == 200
        app.may_end.set()
        assert answer(slow)[0] == 200
        assert answer(idle)[0] == answer(head)[0] == 0
        check_problem(answer(half), 408, "request-too-slow")
        wait_for(lambda: not gate.connections)
        assert time.monotonic() - began < 30.0
        assert app.left == 1
        for connection in (idle, slow, half, endless, head):
            connection.close()
