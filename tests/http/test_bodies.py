"""Large bodies share the room there is: who finds none is told so at once, and room comes back whatever happens."""

import json
import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient
from starlette.requests import ClientDisconnect
from starlette.responses import Response

from gelenk.connections import ConnectionLimits, Gate
from gelenk.http.messages import problems
from gelenk.http.messages.payloads import SMALL, Bodies, BoundedRequest
from gelenk.main import create_app
from gelenk.settings import Settings
from tests.test_connections import answer, connected, served, wait_for

MIB = 1024 * 1024
ROOM = 4 * MIB


class Measuring:
    """Answers with the length of the body."""

    def __init__(self) -> None:
        self.bodies, self.most_held = Bodies(ROOM), 0

    async def __call__(self, scope: Any, receive: Any, send: Any) -> None:
        async def taken() -> Any:
            self.most_held = max(self.most_held, self.bodies.held)
            return await receive()

        request = BoundedRequest(scope, taken, send, MIB, self.bodies)
        try:
            response = Response(str(len(await request.body())))
        except ClientDisconnect:
            return
        except Exception as error:
            response = problems.answer(request, error)
        finally:
            request.release()
        await response(scope, receive, send)


@contextmanager
def measuring() -> Iterator[tuple[int, Measuring]]:
    app = Measuring()
    with served(app, Gate(ConnectionLimits())) as (port, _):
        yield port, app
        wait_for(lambda: app.bodies.held == 0)


def begun(port: int, size: int = MIB) -> socket.socket:
    connection = connected(port)
    connection.sendall(f"POST / HTTP/1.1\r\nContent-Length: {size}\r\n\r\n".encode())
    return connection


def check_refused(found: tuple[int, dict[str, str], bytes]) -> None:
    assert found[0] == 503
    assert found[1]["retry-after"] == "1"
    problem = json.loads(found[2])
    assert (problem["type"], problem["allowed"]) == ("urn:gelenk:no-room-for-body", ROOM)


@pytest.mark.slow
def test_many_who_send_largest_bodies_slowly_take_no_more_than_there_is() -> None:
    with measuring() as (port, app):
        clients, piece = [begun(port) for _ in range(40)], bytes(SMALL)
        for _ in range(MIB // SMALL):
            for client in clients:
                client.sendall(piece)
            time.sleep(0.03)
        found = [answer(client) for client in clients]
        assert ROOM / 2 < app.most_held <= ROOM
        refused = [one for one in found if one[0] != 200]
        assert 3 <= len(found) - len(refused) < 40
        assert all(body == str(MIB).encode() for status, _, body in found if status == 200)
        for one in refused:
            check_refused(one)
        wait_for(lambda: app.bodies.held == 0)
        for client in clients:
            client.sendall(b"POST / HTTP/1.1\r\nContent-Length: 2\r\n\r\n{}")
            assert answer(client)[::2] == (200, b"2")
            client.close()


def test_a_large_body_is_refused_before_it_is_sent_and_a_small_one_never() -> None:
    with measuring() as (port, app):
        half = [begun(port) for _ in range(4)]
        for client in half:
            client.sendall(bytes(MIB - 1))
        wait_for(lambda: app.bodies.held == 4 * (MIB - 1))
        for size in (MIB, SMALL + 1):
            with begun(port, size) as client:
                check_refused(answer(client))
        with begun(port, SMALL) as client:
            client.sendall(bytes(SMALL))
            assert answer(client)[::2] == (200, str(SMALL).encode())
        for client in half:
            client.sendall(b"x")
            assert answer(client)[0] == 200
            client.close()


def test_who_announces_much_and_sends_nothing_takes_no_room() -> None:
    with measuring() as (port, app):
        silent = [begun(port) for _ in range(20)]
        with begun(port) as client:
            client.sendall(bytes(MIB))
            assert answer(client)[::2] == (200, str(MIB).encode())
        assert app.bodies.held == 0
        for one in silent:
            one.close()


def test_chunks_count_as_they_come_and_who_leaves_gives_the_room_back() -> None:
    with measuring() as (port, app):
        clients = [connected(port) for _ in range(8)]
        for client in clients:
            client.sendall(b"POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n")
        chunk = b"%x\r\n" % (MIB - 1) + bytes(MIB - 1) + b"\r\n"
        for client in clients[:4]:
            client.sendall(chunk)
        wait_for(lambda: app.bodies.held == 4 * (MIB - 1))
        clients[4].sendall(chunk)
        check_refused(answer(clients[4]))
        for client in clients:
            client.close()
        wait_for(lambda: app.bodies.held == 0)


@pytest.mark.parametrize("path", ["/v1/robots/panda/fk", "/v1/dh/to-urdf", "/v1/robots"])
def test_the_service_keeps_to_it(path: str, tmp_path: Path) -> None:
    """Room for one of the largest is there whatever the setting says; here another one has taken it."""
    app = create_app(Settings(data_dir=tmp_path, held_body_bytes=1, max_body_bytes=MIB))
    client = TestClient(app, base_url="http://localhost", headers={"Content-Type": "application/json"})
    app.bodies.held = MIB
    refused = client.post(path, content=b"[" + bytes(SMALL))
    assert (refused.status_code, refused.json()["type"]) == (503, "urn:gelenk:no-room-for-body")
    assert (refused.headers["retry-after"], refused.json()["allowed"]) == ("1", MIB)
    assert app.bodies.held == MIB
