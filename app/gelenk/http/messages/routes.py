"""Routes that FastAPI documents but that run without its overhead.

FastAPI writes the OpenAPI document from the signature of an endpoint. Running the endpoint through FastAPI as well
would cost several times the kinematics: its middleware, resolving dependencies, validating the response against its
model (the tests do that instead). So a `DocumentedRoute` keeps the documentation and runs a handler; and `Application`
finds that of an operation, which clients call thousands of times a second, by its name alone.
"""

import asyncio
from collections.abc import Awaitable, Callable
from typing import Any

from fastapi import FastAPI
from fastapi.routing import APIRoute
from starlette.requests import ClientDisconnect
from starlette.responses import RedirectResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send

from gelenk.http.messages import problems
from gelenk.http.messages.payloads import Bodies, BoundedRequest

Handler = Callable[[BoundedRequest], Awaitable[Response]]


class DocumentedRoute(APIRoute):
    """A route that FastAPI describes and `handler` answers."""

    def __init__(
        self, endpoint: Callable[..., Any], handler: Handler, max_body_bytes: int, **documentation: Any
    ) -> None:
        super().__init__(endpoint=endpoint, **documentation)
        self._handler = handler
        self._max_body_bytes = max_body_bytes

    async def handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request for this path; FastAPI refuses other methods than the route's."""
        if scope["method"] not in (self.methods or ()):
            await super().handle(scope, receive, send)
            return
        if (response := await self.response(scope, receive, send)) is not None:
            await response(scope, receive, send)

    async def response(self, scope: Scope, receive: Receive, send: Send) -> Response | None:
        """Return the response to a request for this path and method; None if its client has left."""
        request = BoundedRequest(scope, receive, send, self._max_body_bytes, scope["app"].bodies)
        try:
            return await self._handler(request)
        except ClientDisconnect:
            return None
        except Exception as error:
            return problems.answer(request, error)
        finally:
            request.release()


class Application(FastAPI):
    """FastAPI, with the operations dispatched first.

    `operations` are their routes by id; in their paths only the robot varies. Any other request, also a wrong method
    or an unknown operation, goes through FastAPI, and so do all requests if they are traced (`is_traced`). Requests
    arrive at `entry`, which finds the operation, checks that the caller may call it, and calls its route or `answer`.
    """

    def __init__(self, bodies: Bodies, is_traced: bool = False, **description: Any) -> None:
        super().__init__(**description)
        self.bodies, self._is_traced = bodies, is_traced
        self.operations: dict[str, DocumentedRoute] = {}
        self.entry: ASGIApp = self.answer

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a request or the lifespan events."""
        if self.root_path and scope["type"] == "http":
            scope = prefixed(scope, self.root_path)
        await self.entry(scope, receive, send)

    def route_of(self, operation: str, robot: str | None, scope: Scope) -> DocumentedRoute | None:
        """Return the route of an operation, and put in the scope what it needs; None if FastAPI is to answer."""
        route = None if self._is_traced else self.operations.get(operation)
        if route is not None:
            scope["root_path"], scope["app"] = self.root_path, self
            scope["path_params"] = {} if robot is None else {"robot": robot}
        return route

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let FastAPI answer a request that has passed the checks; HEAD is GET without the body."""
        if self.root_path and scope.get("path") == self.root_path:  # links are relative to the folder
            await RedirectResponse(f"{self.root_path}/")(scope, receive, send)
            return
        if scope["type"] == "http" and scope["method"] == "HEAD":
            scope = {**scope, "method": "GET"}
        await asyncio.sleep(0)  # From here on it is in a task, which what FastAPI uses asks for.
        await super().__call__(scope, receive, send)


def prefixed(scope: Scope, root_path: str) -> Scope:
    """Return a request with the path prefix, which a proxy may have removed: mounted files are found by it."""
    path: str = scope["path"]
    has_it = path == root_path or path.startswith(f"{root_path}/")
    return scope if has_it else {**scope, "path": root_path + path}
