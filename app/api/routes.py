"""A route that FastAPI documents and that runs without its overhead.

FastAPI writes the OpenAPI schema from the signature of an endpoint. Running it through FastAPI as well would cost
more than the kinematics: resolving dependencies, parsing into Python objects, validating the answer against its
model (the tests do that instead). So a `DocumentedRoute` keeps the one and replaces the other by a handler.
"""

import asyncio
from collections.abc import Awaitable, Callable
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any, Generic, TypeVar, cast

from fastapi.routing import APIRoute
from starlette.requests import Request
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from app.api.payloads import JSON, NPY, from_query, json_response, media_type, npy_response, read_npy, wants_npy
from app.api.problems import UnsupportedMediaType
from app.model.arrays import Array
from app.model.errors import InvalidArray
from app.schemas.common import Payload
from app.store.library import Library
from app.store.records import LoadedRobot

INLINE_BYTES = 4096
"""Bodies up to here hold so little work that a thread would cost more: the event loop does it, in under 2 ms."""

Handler = Callable[[Request], Awaitable[Response]]
_Request = TypeVar("_Request", bound=Payload)


class DocumentedRoute(APIRoute):
    """A path whose endpoint is described by FastAPI and answered by `handler`."""

    def __init__(self, path: str, endpoint: Callable[..., Any], handler: Handler, **documentation: Any) -> None:
        super().__init__(path, endpoint, **documentation)
        self._handler = handler

    async def handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request that has matched; another method than the route's is FastAPI's to refuse."""
        if scope["method"] not in (self.methods or ()):
            await super().handle(scope, receive, send)
            return
        response = await self._handler(Request(scope, receive, send))
        await response(scope, receive, send)


@dataclass(frozen=True, slots=True)
class Outcome:
    """The result of a computation in the two shapes it can travel in; each is made when asked for.

    Attributes:
        content: For JSON.
        array: For npy; None where the call asked for something that one array cannot hold.
    """

    content: Callable[[], Any]
    array: Callable[[], Array] | None


@dataclass(frozen=True, slots=True)
class Computation(Generic[_Request]):
    """An operation on a robot: request in, outcome out.

    Attributes:
        run: The operation.
        request: What it takes as JSON.
        options: The same without the array that an npy body brings.
        array_field: The field that such an array stands for.
        is_heavy: Whether a request of few bytes can still be much work.
    """

    run: Callable[[LoadedRobot, _Request], Outcome]
    request: type[_Request]
    options: type[Payload]
    array_field: str
    is_heavy: Callable[[_Request], bool]

    def handler(self, library: Library, executor: Executor) -> Handler:
        """What answers its requests: on the event loop where that is quick, else in a thread."""

        async def handle(request: Request) -> Response:
            body = await request.body()
            npy_in, npy_out = _is_npy(request), wants_npy(request)
            name: str = request.path_params["robot"]

            def compute(loaded: LoadedRobot | None = None, call: _Request | None = None) -> Response:
                loaded = loaded or library.get(name)
                outcome = self.run(loaded, call or self._parse(request, body, npy_in))
                return _response(outcome, npy_out)

            if len(body) <= INLINE_BYTES and (loaded := library.loaded(name)) is not None:
                call = self._parse(request, body, npy_in)
                if not self.is_heavy(call):
                    return compute(loaded, call)
            return await asyncio.get_running_loop().run_in_executor(executor, compute)

        return handle

    def _parse(self, request: Request, body: bytes, npy: bool) -> _Request:
        if not npy:
            return self.request.model_validate_json(body)
        options = from_query(self.options, request)
        call = self.request.model_construct(**{**dict(options), self.array_field: read_npy(body)})
        return cast(_Request, call)


def _is_npy(request: Request) -> bool:
    given = media_type(request)
    if given not in {JSON, NPY}:
        raise UnsupportedMediaType(given, (JSON, NPY))
    return given == NPY


def _response(outcome: Outcome, npy: bool) -> Response:
    if not npy:
        return json_response(outcome.content())
    if outcome.array is None:
        raise InvalidArray("what this call asks for does not fit into one array: leave `Accept` out for JSON")
    return npy_response(outcome.array())
