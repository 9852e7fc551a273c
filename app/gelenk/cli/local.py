"""The application in this process: calls without a server, by the same code, with the same answers."""

import asyncio
import sys
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeVar

import httpx2
from anyio.from_thread import start_blocking_portal
from starlette.types import ASGIApp, Receive, Scope, Send

from gelenk.main import create_app
from gelenk.pool.pool import WorkerPool
from gelenk.settings import Settings

_EVENTS = "/events"
_LOOK_SECONDS = 0.05
_Argument = TypeVar("_Argument")
_Result = TypeVar("_Result")


class _Alone(WorkerPool):
    """A pool without processes for requests: a thread does the work, and Ctrl-C stops it."""

    def __init__(self, background: int) -> None:
        super().__init__(0, sys.maxsize, 0, background)

    async def run(
        self,
        function: Callable[[_Argument], _Result],
        argument: _Argument,
        seconds: float,  # noqa: ARG002
        client: str = "",  # noqa: ARG002
    ) -> _Result:
        return await asyncio.to_thread(function, argument)


def _looked_at(app: ASGIApp) -> ASGIApp:
    """Wrap an application so that event streams end after one event: answers come whole, and the client asks again."""

    async def answer(scope: Scope, receive: Receive, send: Send) -> None:
        if scope["path"].endswith(_EVENTS):
            await asyncio.sleep(_LOOK_SECONDS)
            scope = {**scope, "state": {"stopping": True}}
        await app(scope, receive, send)

    return answer


class InProcess(httpx2.BaseTransport):
    """Transport to an application in this process, which forgets all when closed; no call or job exceeds `seconds`."""

    def __init__(self, seconds: int = 3600) -> None:
        self._stack = ExitStack()
        folder = self._stack.enter_context(TemporaryDirectory(prefix="gelenk-"))
        settings = Settings(data_dir=Path(folder), request_seconds=seconds, job_seconds=seconds)
        app = create_app(settings, _Alone(settings.job_processes))
        self._portal = self._stack.enter_context(start_blocking_portal())
        lifespan = app.router.lifespan_context(app)
        self._stack.enter_context(self._portal.wrap_async_context_manager(lifespan))
        self._transport = httpx2.ASGITransport(_looked_at(app))

    def handle_request(self, request: httpx2.Request) -> httpx2.Response:
        """Return the whole response to a request."""
        return self._portal.call(self._answer, request)

    async def _answer(self, request: httpx2.Request) -> httpx2.Response:
        response = await self._transport.handle_async_request(request)
        content = await response.aread()
        headers: Any = response.headers.raw
        return httpx2.Response(response.status_code, headers=headers, content=content)

    def close(self) -> None:
        """Stop the application and remove its data."""
        self._stack.close()
