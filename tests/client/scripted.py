"""A service on a port of this machine that does with each request what a test tells it, to the last byte."""

import contextlib
import socket
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import orjson

Step = Callable[["Visit"], None]


@dataclass
class Visit:
    """A request that has come in.

    Attributes:
        line: Method and path.
        body: What of it was read.
        connection: It came on.
        number: Of the connection.
    """

    line: str
    body: bytes
    connection: socket.socket
    number: int


@dataclass
class Scripted:
    """The service: its steps, one a request, the last one for all that follow; and what came.

    Attributes:
        url: Its address.
        steps: What is done with each request.
        visits: What came, in order.
        most_read: Bytes of a body; what is more stays unread.
        most: How many requests it had at a time.
        left: Set when a connection has come to its end.
    """

    url: str
    steps: list[Step]
    most_read: int
    visits: list[Visit] = field(default_factory=list)
    most: int = 0
    left: threading.Event = field(default_factory=threading.Event)
    _now: int = 0
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def serve(self, connection: socket.socket, number: int) -> None:
        """All requests of a connection."""
        with connection, contextlib.suppress(OSError):
            while (visit := _read(connection, number, self.most_read)) is not None:
                with self._lock:
                    step = self.steps[min(len(self.visits), len(self.steps) - 1)]
                    self.visits.append(visit)
                    self._now += 1
                    self.most = max(self.most, self._now)
                try:
                    step(visit)
                finally:
                    with self._lock:
                        self._now -= 1
        self.left.set()

    @property
    def lines(self) -> list[str]:
        """Method and path of what came."""
        return [visit.line for visit in self.visits]


def _read(connection: socket.socket, number: int, most: int) -> Visit | None:
    """A request with its body; None where the caller has hung up."""
    received = b""
    while b"\r\n\r\n" not in received:
        piece = connection.recv(65536)
        if not piece:
            return None
        received += piece
    head, _, body = received.partition(b"\r\n\r\n")
    sizes = [line for line in head.lower().split(b"\r\n") if line.startswith(b"content-length:")]
    size = int(sizes[0].split(b":")[1]) if sizes else 0
    while len(body) < min(size, most):
        body += connection.recv(65536)
    line = head.split(b"\r\n")[0].decode().removesuffix(" HTTP/1.1")
    return Visit(line, body[:most], connection, number)


@contextlib.contextmanager
def scripted(*steps: Step, most_read: int = 10**9) -> Iterator[Scripted]:
    """A service that takes these steps; it ends with its callers."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        service = Scripted(f"http://127.0.0.1:{listener.getsockname()[1]}", list(steps), most_read)
        connections: list[socket.socket] = []

        def accept() -> None:
            with contextlib.suppress(OSError):
                while True:
                    connection, _ = listener.accept()
                    connections.append(connection)
                    arguments = (connection, len(connections))
                    threading.Thread(target=service.serve, args=arguments, daemon=True).start()

        thread = threading.Thread(target=accept, daemon=True)
        thread.start()
        try:
            yield service
        finally:
            for open_one in (listener, *connections):
                with contextlib.suppress(OSError):
                    open_one.shutdown(socket.SHUT_RDWR)
            thread.join(10)


def says(status: str, content: Any = None, media: str = "application/json", **headers: str) -> Step:
    """Answer with a status such as `200 OK`, JSON or bytes, and headers; the connection stays open."""
    body = content if isinstance(content, bytes) else orjson.dumps(content)
    told = {"content-type": media, "content-length": str(len(body)), **headers}
    head = "".join(f"{name.replace('_', '-')}: {value}\r\n" for name, value in told.items())
    raw = f"HTTP/1.1 {status}\r\n{head}\r\n".encode() + body
    return lambda visit: visit.connection.sendall(raw)


def refuses(status: str, kind: str, **facts: Any) -> Step:
    """Answer with a problem; of it `retry_after` stands in the header too."""
    content = {"type": f"urn:gelenk:{kind}", "status": int(status[:3]), "detail": f"it is {kind}", **facts}
    wait = {"retry_after": str(facts["retry_after"])} if "retry_after" in facts else {}
    return says(status, content, "application/problem+json", **wait)


def hangs_up(visit: Visit) -> None:
    """Close the connection in the place of an answer."""
    visit.connection.close()


def reads_on(visit: Visit) -> None:
    """Take what is still to come of a body, then close the connection."""
    visit.connection.settimeout(0.5)
    with contextlib.suppress(TimeoutError):
        while visit.connection.recv(65536):
            pass
    visit.connection.close()


def stops_halfway(visit: Visit) -> None:
    """Close it in the middle of an answer."""
    visit.connection.sendall(b"HTTP/1.1 200 OK\r\ncontent-type: application/json\r\ncontent-length: 100\r\n\r\n{")
    hangs_up(visit)


def keeps_silent(visit: Visit) -> None:
    """Give no answer for as long as the caller waits."""
    visit.connection.settimeout(60)
    visit.connection.recv(1)


def then(*parts: Step) -> Step:
    """One after the other."""

    def step(visit: Visit) -> None:
        for part in parts:
            part(visit)

    return step
