"""HTTP connections with bounds: on time, on the size of a head, on their number, and on the requests started at once.

The underlying server waits for a slow client forever, accepts a head of any size, and starts every request as it
arrives, so the last one of a thousand waits for all others, even if it is a health check.
"""

import asyncio
import re
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from heapq import nsmallest
from http import HTTPStatus
from random import uniform
from typing import Any
from urllib.parse import unquote

import orjson
from httptools import parse_url
from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol, RequestResponseCycle

from gelenk.answering import RequestCycle, answered

AT_ONCE = ("/healthz", "/readyz", "/metrics")
"""Paths that never wait and are never refused: monitoring must see the service when it is busy."""

_AT_A_TIME = 8
"""Requests started in one turn of the event loop: most take a fifth of a millisecond."""
_SWEEP_SECONDS = 0.5
_SLOWEST_BYTES = 32 * 1024
"""Minimum rate of a body that takes longer than its time, [bytes/s]."""
_GRACE_SECONDS = 2.0
"""How long the service waits for the rest of a body at shutdown, [s]."""
_ARRIVAL_SECONDS = 0.5
"""How long a new connection has to send its request at shutdown, [s]."""
_RETRY_SECONDS = 1.0
"""`Retry-After` of a request that was refused before it started, [s]."""
_SHORTEST_PAUSE = 0.75
"""Smallest share of `Retry-After` for which the service reads nothing from a refused client's connection.

Otherwise refusing would take all its time. By then, the connection of an obedient client is read again. Others are
read again at different moments: together they would block the event loop.
"""
_LONGEST_PAUSE = 8.0
"""Longest time for which a connection is not read, [s]: after a longer one it would be taken for idle."""
_EVICTED = 16
"""Connections closed together if there are too many; at most an eighth of all, or new ones would be among them."""
_CHUNK_BYTES = 20
"""Maximum number of bytes that frame a chunk of a body: sixteen hexadecimal digits and two line ends."""
_ABSOLUTE = re.compile(rb"[a-z][a-z0-9+.-]*://([^/?#]*)(.*)", re.IGNORECASE | re.DOTALL)


@dataclass(frozen=True, slots=True)
class ConnectionLimits:
    """Bounds of connections.

    Attributes:
        connections: Open connections of this process; beyond that, those that wait longest for their client are
            closed.
        waiting: Requests that may wait to be started; more are refused.
        head_seconds: Time from the start of a connection, the end of a response or the first byte of a request to the
            end of the request's head, [s].
        body_seconds: Time for a body, [s]; a longer one must keep coming.
        stalled_seconds: How long a client may read nothing of its response, [s].
        head_bytes: Size of request line and header fields; also of a body's chunk extensions and trailer fields.
    """

    connections: int = 2000
    waiting: int = 150
    head_seconds: float = 10.0
    body_seconds: float = 30.0
    stalled_seconds: float = 30.0
    head_bytes: int = 64 * 1024


class Gate:
    """State that the connections of a process share: the queue of requests, and the check for slow clients.

    Attributes:
        connections: Open connections in the order of their arrival: many arrive within one tick of the loop's clock.
        closed: Number of connections closed because their client was slow, or because there were too many.
        is_stopping: Whether each response is the last one of its connection.
    """

    def __init__(self, bounds: ConnectionLimits) -> None:
        self.bounds = bounds
        self.connections: dict[BoundedProtocol, None] = {}
        self.refused = self.closed = 0
        self.is_stopping = False
        self._waiting: deque[Callable[[], None]] = deque()
        self._begun = 0

    @property
    def queue_length(self) -> int:
        """Number of requests that wait to be started."""
        return len(self._waiting)

    def stop(self) -> None:
        """Announce in each response from now on that its connection closes: no client is cut off without notice."""
        self.is_stopping = True
        for connection in self.connections:
            connection.end_with_answer()

    def enter(self, begin: Callable[[RequestResponseCycle], None], cycle: RequestResponseCycle) -> bool:
        """Start a request now or after those before it; return False if too many wait."""
        if self._begun < _AT_A_TIME:
            if not self._begun:
                asyncio.get_running_loop().call_soon(self._turn)
            self._begun += 1
            begin(cycle)
        elif len(self._waiting) < self.bounds.waiting:
            self._waiting.append(partial(begin, cycle))
        else:
            self.refused += 1
            return False
        return True

    def _turn(self) -> None:
        """Start the next few requests; between two turns the event loop serves all connections."""
        self._begun = min(len(self._waiting), _AT_A_TIME)
        for _ in range(self._begun):
            self._waiting.popleft()()
        if self._begun:
            asyncio.get_running_loop().call_soon(self._turn)

    def admit(self, connection: "BoundedProtocol") -> bool:
        """Accept a new connection; return False if all others are busy and there is no room for it."""
        if not self.connections:
            asyncio.get_running_loop().call_later(_SWEEP_SECONDS, self._sweep)
        self.connections[connection] = None
        if len(self.connections) <= self.bounds.connections:
            return True
        staying = [one for one in self.connections if not one.is_gone]
        if len(staying) <= self.bounds.connections:
            return True
        idle = [one for one in staying if one.waits_for_client and one is not connection]
        for one in nsmallest(min(_EVICTED, 1 + self.bounds.connections // 8), idle, key=lambda one: one.since):
            self.closed += 1
            one.leave()
        return bool(idle)

    def _sweep(self) -> None:
        now = asyncio.get_running_loop().time()
        for connection in list(self.connections):
            if connection.is_late(now):
                self.closed += 1
        if self.connections:
            asyncio.get_running_loop().call_later(_SWEEP_SECONDS, self._sweep)


class BoundedProtocol(HttpToolsProtocol):
    """A connection within bounds; `since` is the start of its current wait, on the loop's clock, [s]."""

    def __init__(self, *arguments: Any, gate: Gate, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.app_state["gate"] = self._gate = gate
        self.since = self.loop.time()
        self._body_bytes = self._chunks = self._unsent = 0
        self._in_message = self._in_head = False
        self._stage = self._other_bytes = 0
        self._ends: float | None = None
        self._arriving: RequestCycle | None = None

    @property
    def waits_for_client(self) -> bool:
        """Whether the service waits for the client: no request is in progress, or its body is incomplete."""
        return self.cycle is None or self.cycle.response_complete or self.cycle.more_body

    @property
    def is_gone(self) -> bool:
        """Whether it closes at the end of this turn of the event loop."""
        return self.transport.is_closing() and not self.transport.get_write_buffer_size()

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Register the connection; refuse it if there are too many."""
        super().connection_made(transport)
        if not self._gate.admit(self):
            self._refuse(HTTPStatus.SERVICE_UNAVAILABLE, "service-busy", "there are too many connections")
        elif self._gate.is_stopping:
            self.loop.call_later(_ARRIVAL_SECONDS, self.shutdown)

    def connection_lost(self, exc: Exception | None) -> None:
        """Forget the connection."""
        self._gate.connections.pop(self, None)
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Parse bytes that have arrived; those outside a body are counted, except in the read that ends its stage."""
        stage, body_bytes = self._stage + (not self._in_message), self._body_bytes
        super().data_received(data)
        if stage != self._stage:
            self._other_bytes = self._chunks = 0
        else:
            self._other_bytes += len(data) - (self._body_bytes - body_bytes)
            most = self._gate.bounds.head_bytes
            if self._other_bytes > most + self._chunks * _CHUNK_BYTES:
                what = "request line and header fields" if self._in_head else "chunk extensions and trailer fields"
                status = HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE
                self._refuse(status, "head-too-large", f"{what} may have {most} bytes in all")
        self._begin_request()  # though its body is not complete

    def on_message_begin(self) -> None:
        """Note that the first byte of a request has arrived."""
        super().on_message_begin()
        self.since = self.loop.time()
        self._stage, self._in_head, self._in_message = self._stage + 1, True, True

    def on_header(self, name: bytes, value: bytes) -> None:
        """Store a header field; a trailer field is dropped, since the headers have been acted upon."""
        if self._in_head:
            name = name.lower()
            if name == b"expect" and value.lower() == b"100-continue":
                self.expect_100_continue = True
            self.headers.append((name, value))

    def on_headers_complete(self) -> None:
        """Prepare the request that the complete head describes; if its target names a host, that one counts.

        (RFC 9112, 3.2.2.) The server does the same, but for WebSockets and for its options `root_path` and
        `limit_concurrency`, which are not in use.
        """
        self.since, self._body_bytes = self.loop.time(), 0
        self._stage, self._in_head = self._stage + 1, False
        if self.url[:1] != b"/" and (absolute := _ABSOLUTE.fullmatch(self.url)):
            host, rest = absolute.groups()
            self.url = rest if rest.startswith(b"/") else b"/" + rest
            self.headers[:] = [(name, host if name == b"host" else value) for name, value in self.headers]
        target, version, before = parse_url(self.url), self.parser.get_http_version(), self.cycle
        path = target.path.decode("ascii")
        self.scope["method"], self.scope["http_version"] = self.parser.get_method().decode("ascii"), version
        self.scope["path"], self.scope["raw_path"] = unquote(path) if "%" in path else path, target.path
        self.scope["query_string"] = target.query or b""
        self.cycle = RequestCycle(
            self.scope,
            self.transport,
            self.flow,
            self.logger,
            self.access_logger,
            self.access_log,
            self.server_state.default_headers,
            asyncio.Event(),
            self.expect_100_continue,
            version != "1.0" and self.parser.should_keep_alive(),
            self.on_response_complete,
        )
        if before is None or before.response_complete:
            self._arriving = self.cycle  # its body may be among the bytes at hand
        else:
            self.flow.pause_reading()
            self.pipeline.appendleft((self.cycle, self.app))

    def on_chunk_header(self) -> None:
        """Count a chunk of the body."""
        self._chunks += 1

    def on_body(self, body: bytes) -> None:
        """Count and pass on a part of the body."""
        self._body_bytes += len(body)
        super().on_body(body)

    def on_message_complete(self) -> None:
        """Note that the request is complete."""
        self._stage, self._in_message = self._stage + 1, False
        super().on_message_complete()
        self._begin_request()

    def on_response_complete(self) -> None:
        """Note that the response is sent; after a refusal, do not read for a while.

        The server's own timer for idle connections is left out, since there is the check for slow clients.
        """
        self.since = self.loop.time()
        self.server_state.total_requests += 1
        if self.transport.is_closing():
            return
        self.flow.resume_reading()
        if self.pipeline:  # soon and not now, or a hundred would be a hundred calls deep
            self.loop.call_soon(self._start, self.pipeline.pop()[0])
        seconds = self.cycle.scope["state"].get("retry_after")
        if self.cycle.response_complete and seconds is not None:
            self._pause(seconds)

    def _begin_request(self) -> None:
        if self._arriving is not None:
            cycle, self._arriving = self._arriving, None
            self._start(cycle)

    def _start(self, cycle: RequestResponseCycle) -> None:
        if self.transport.is_closing() and not cycle.disconnected:  # nobody would get the answer
            return
        if self._gate.is_stopping:
            self.end_with_answer()
        if cycle.scope["path"].endswith(AT_ONCE):
            self._answer(cycle)
        elif not self._gate.enter(self._answer, cycle):
            self._turn_away(cycle)

    def _answer(self, cycle: RequestResponseCycle) -> None:
        if (task := answered(cycle, self.app, self.loop)) is not None:
            self.tasks.add(task)
            task.add_done_callback(self.tasks.discard)

    def _turn_away(self, cycle: RequestResponseCycle) -> None:
        """Refuse a request; the connection stays open, but is not read for a while."""
        stays = cycle.keep_alive and not self.pipeline
        detail = f"the service is at capacity: try again in {_RETRY_SECONDS:g} s"
        status, path = HTTPStatus.SERVICE_UNAVAILABLE, cycle.scope["path"]
        self.transport.write(_answer(status, "service-busy", detail, path, stays=stays))
        cycle.response_started = cycle.response_complete = True
        cycle.scope["state"]["retry_after"] = _RETRY_SECONDS
        if not stays:
            self.transport.close()
            return
        self.on_response_complete()

    def _pause(self, seconds: float) -> None:
        """Read nothing for nearly as long as the client is asked to wait, [s]."""
        if not self.transport.is_closing():
            self.flow.pause_reading()
            pause = min(seconds, _LONGEST_PAUSE) * uniform(_SHORTEST_PAUSE, 1.0)  # noqa: S311 - nothing secret
            self.loop.call_later(pause, self._listen)

    def _listen(self) -> None:
        if not self.transport.is_closing():
            self.flow.resume_reading()

    def send_400_response(self, msg: str) -> None:
        """Refuse bytes that are not HTTP."""
        self._refuse(HTTPStatus.BAD_REQUEST, "malformed-request", msg.rstrip("."))

    def end_with_answer(self) -> None:
        """Make the response to the current request the last one, unless it has started; streams end."""
        if self.cycle is not None and not self.cycle.response_complete:
            self.cycle.keep_alive &= self.cycle.response_started
            self.cycle.scope["state"]["stopping"] = True

    def shutdown(self) -> None:
        """Prepare to stop: requests in progress finish, streams end, and a client has little time left."""
        self.end_with_answer()
        if self.cycle is not None and not self.cycle.response_complete:
            self.cycle.keep_alive = False
            if self.cycle.more_body:
                self._ends = self.loop.time() + _GRACE_SECONDS
        elif self.loop.time() < self.since + _ARRIVAL_SECONDS:
            self.loop.call_later(_ARRIVAL_SECONDS, super().shutdown)
        else:
            super().shutdown()

    def is_late(self, now: float) -> bool:
        """Close the connection if its client has taken too long; return whether that is so."""
        bounds = self._gate.bounds
        if self.transport.is_closing() or self.flow.write_paused:
            return self._is_stalled(now)
        self._unsent = 0
        if self.cycle is None or self.cycle.response_complete:
            if now <= self.since + bounds.head_seconds:
                return False
            if self._in_head:
                seconds = bounds.head_seconds
                detail = f"the request did not come within {seconds:g} s"
                self._refuse(HTTPStatus.REQUEST_TIMEOUT, "request-too-slow", detail)
            else:
                self.transport.close()
            return True
        if not self.cycle.more_body:
            return False
        if now <= (self._ends or self.since + bounds.body_seconds + self._body_bytes / _SLOWEST_BYTES):
            return False
        self._refuse(HTTPStatus.REQUEST_TIMEOUT, "request-too-slow", "the rest of the body did not come in time")
        return True

    def _is_stalled(self, now: float) -> bool:
        """Abort the connection if its client has read nothing for too long; return whether that is so."""
        unsent = self.transport.get_write_buffer_size()
        if unsent != self._unsent:
            self._unsent, self.since = unsent, now
        if now <= self.since + self._gate.bounds.stalled_seconds:
            return False
        self.transport.abort()
        return True

    def leave(self) -> None:
        """Close this connection to make room for another."""
        detail = "too many connections are open, and this one has been idle the longest"
        if self.transport.is_closing():
            self.transport.abort()
        elif self.cycle is not None and not self.cycle.response_complete:
            self._refuse(HTTPStatus.SERVICE_UNAVAILABLE, "service-busy", detail)
        else:
            self.transport.close()

    def _refuse(self, status: HTTPStatus, kind: str, detail: str) -> None:
        """Close the connection with a problem; code that waits for the rest of the request sees a disconnect."""
        cycle = self.cycle
        if cycle is not None and not cycle.response_complete:
            cycle.disconnected = True
            cycle.message_event.set()
        if cycle is None or cycle.response_complete or not cycle.response_started:
            self.transport.write(_answer(status, kind, detail, "", stays=False))
        self.transport.close()


def _answer(status: HTTPStatus, kind: str, detail: str, path: str, *, stays: bool) -> bytes:
    """Return a problem as the bytes of an HTTP response."""
    content = {"type": f"urn:gelenk:{kind}", "title": kind.replace("-", " ").capitalize(), "status": status.value}
    body = orjson.dumps({**content, "detail": detail, "instance": path[:256]})
    head = f"HTTP/1.1 {status.value} {status.phrase}\r\ncontent-type: application/problem+json\r\n"
    if status == HTTPStatus.SERVICE_UNAVAILABLE:
        head += f"retry-after: {_RETRY_SECONDS:g}\r\n"
    if not stays:
        head += "connection: close\r\n"
    return f"{head}content-length: {len(body)}\r\n\r\n".encode() + body
