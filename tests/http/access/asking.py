"""Requests down to their last header, and the answers as they leave the application."""

import asyncio
import atexit
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import orjson
from fastapi import FastAPI
from starlette.types import Message

from gelenk.contract.endpoint import Scope
from gelenk.http.access.keyring import new_key
from gelenk.main import create_app
from gelenk.settings import Settings

_FOLDER = tempfile.TemporaryDirectory()
atexit.register(_FOLDER.cleanup)
_LOOP = asyncio.new_event_loop()
"""One for all: the processes of an application belong to its loop."""
HOST = (b"host", b"127.0.0.1:8000")


def application(**settings: Any) -> FastAPI:
    """An application with these settings; all of them share a data folder."""
    return create_app(Settings(**{"data_dir": Path(_FOLDER.name), **settings}))


class Sent(list[Message]):
    """What the application has sent, in order."""


@dataclass(frozen=True, slots=True)
class Answer:
    """Status, headers as they are, body."""

    status: int
    headers: list[tuple[str, str]]
    body: bytes

    def all(self, name: str) -> list[str]:
        return [value for key, value in self.headers if key == name]

    def header(self, name: str) -> str | None:
        values = self.all(name)
        assert len(values) < 2
        return values[0] if values else None

    @property
    def problem(self) -> dict[str, Any]:
        assert self.header("content-type") == "application/problem+json"
        content: dict[str, Any] = orjson.loads(self.body)
        assert content["status"] == self.status
        return content


def ask(
    app: FastAPI,
    path: str,
    method: str = "GET",
    headers: Sequence[tuple[bytes, bytes]] = (HOST,),
    body: bytes = b"",
) -> Answer:
    """One request, with exactly these headers; its caller stays for the answer."""
    return _LOOP.run_until_complete(_asked(app, path, method, headers, body))


async def _asked(app: FastAPI, path: str, method: str, headers: Sequence[tuple[bytes, bytes]], body: bytes) -> Answer:
    scope = {
        "type": "http",
        "asgi": {"version": "3.0"},
        "http_version": "1.1",
        "method": method,
        "scheme": "http",
        "path": path,
        "raw_path": path.encode(),
        "query_string": b"",
        "root_path": "",
        "headers": list(headers),
        "client": ("192.0.2.7", 4711),
        "server": ("192.0.2.1", 8000),
    }
    requests: list[Message] = [{"type": "http.request", "body": body}]
    sent = Sent()

    async def receive() -> Message:
        if not requests:
            await asyncio.Event().wait()
        return requests.pop()

    async def send(message: Message) -> None:
        sent.append(message)

    await app(scope, receive, send)
    start, *rest = sent
    decoded = [(name.decode(), value.decode()) for name, value in start["headers"]]
    return Answer(start["status"], decoded, b"".join(message.get("body", b"") for message in rest))


def bearer(token: str) -> tuple[bytes, bytes]:
    return b"authorization", f"Bearer {token}".encode()


def keys_for(*scopes: str) -> tuple[str, dict[str, str]]:
    """Entries, and the keys by what they are good for, such as `read+write`."""
    made = {name: new_key(name.replace("+", "-"), [Scope(scope) for scope in name.split("+")]) for name in scopes}
    return "\n".join(key.entry() for _, key in made.values()), {name: token for name, (token, _) in made.items()}
