"""Where every request comes in and every answer goes out."""

from collections.abc import Callable, Sequence
from typing import TypeAlias

from starlette.responses import Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.api.access.directory import Directory
from app.api.access.exchange import Exchange
from app.api.access.headers import completed

Check: TypeAlias = Callable[[Exchange], Response | None]
"""Looks at a request; what it returns is the answer, and None lets the request pass."""


class Door:
    """Passes requests through the checks, in their order, to the application; completes the headers of answers.

    Args:
        app: The application.
        directory: Its operations.
        root_path: Path prefix under which a proxy serves it.
        checks: The first refusal counts.
    """

    def __init__(self, app: ASGIApp, directory: Directory, root_path: str, checks: Sequence[Check]) -> None:
        self._app, self._directory, self._root_path = app, directory, root_path
        self._checks = tuple(checks)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a connection."""
        if scope["type"] == "http":
            await self._serve(scope, receive, send)
        elif scope["type"] == "lifespan":
            await self._app(scope, receive, send)
        else:
            await send({"type": "websocket.close", "code": 1008})

    async def _serve(self, scope: Scope, receive: Receive, send: Send) -> None:
        path: str = scope["path"].removeprefix(self._root_path)
        exchange = Exchange.begun(scope, *self._directory.find(path, scope["method"]))

        async def answer(message: Message) -> None:
            if message["type"] == "http.response.start":
                exchange.status = message["status"]
                own = (b"x-request-id", exchange.request_id.encode())
                message["headers"] = completed(message.get("headers", ()), [own, *exchange.answer_headers])
            await send(message)

        for check in self._checks:
            if (refusal := check(exchange)) is not None:
                await refusal(scope, receive, answer)
                return
        await self._app(scope, receive, answer)
