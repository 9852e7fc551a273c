"""Routes that FastAPI documents and that run without its overhead.

FastAPI writes the OpenAPI schema from the signature of an endpoint. Running it through FastAPI as well would cost
several times the kinematics: its middleware, resolving dependencies, validating the answer against its model (the
tests do that instead). So a `DocumentedRoute` keeps the one and replaces the other by a handler; and operations on
a robot, which are called thousands of times a second, are found by `Application` before anything else.
"""

import asyncio
import inspect
import re
from collections.abc import Awaitable, Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any, Generic, Literal, TypeAlias, TypeVar, cast

from fastapi import FastAPI
from fastapi.routing import APIRoute
from starlette.datastructures import QueryParams
from starlette.requests import ClientDisconnect
from starlette.responses import RedirectResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send

from gelenk.api import problems
from gelenk.api.bodies import Bodies
from gelenk.api.errand import Desk, Inquiry, buffers
from gelenk.api.lesson import Lesson, LessonErrand
from gelenk.api.long_work import LongWork, submitted
from gelenk.api.npy import npy_response, read_npy
from gelenk.api.openapi import (
    BY_THE_CREW,
    JOB_BEGUN,
    PreferHeader,
    RobotPath,
    csv_content,
    json_example,
    npy_body,
    npy_content,
    picture_content,
    problem_responses,
)
from gelenk.api.payloads import (
    CSV,
    JSON,
    NO_ARRAY,
    NPY,
    PNG,
    SVG,
    BoundedRequest,
    csv_response,
    json_response,
    read_json,
    read_query,
)
from gelenk.api.preference import wants_answer_later
from gelenk.api.problems import UnsupportedMediaType
from gelenk.api.remote import INLINE_BYTES, Remote
from gelenk.api.tally import TALLY, Tally
from gelenk.contract.common import Answer, Payload
from gelenk.jobs.runner import Runner
from gelenk.model.arrays import Array
from gelenk.model.errors import InvalidArray, InvalidField
from gelenk.store.library import Library
from gelenk.store.records import LoadedRobot

_OPERATION = re.compile(r"/v1/robots/(?P<robot>[^/]+)/(?P<operation>[a-z]+)")

Handler = Callable[[BoundedRequest], Awaitable[Response]]
PictureFormat: TypeAlias = Literal["svg", "png"]
_Request = TypeVar("_Request", bound=Payload)

_PICTURES: dict[str, PictureFormat] = {SVG: "svg", PNG: "png"}


class DocumentedRoute(APIRoute):
    """A path whose endpoint is described by FastAPI and answered by `handler`."""

    def __init__(
        self, path: str, endpoint: Callable[..., Any], handler: Handler, max_body_bytes: int, **documentation: Any
    ) -> None:
        documentation["responses"] = documentation.get("responses", {}) | problem_responses(*BY_THE_CREW)
        super().__init__(path, endpoint, **documentation)
        self._handler = handler
        self._max_body_bytes = max_body_bytes

    async def handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request that has matched; another method than the route's is FastAPI's to refuse."""
        if scope["method"] not in (self.methods or ()):
            await super().handle(scope, receive, send)
            return
        bodies: Bodies = scope["app"].bodies
        try:
            with BoundedRequest(scope, receive, send, self._max_body_bytes, bodies) as request:
                response = await self._handler(request)
        except ClientDisconnect:
            return
        await response(scope, receive, send)


class Application(FastAPI):
    """FastAPI, with the operations on a robot dispatched first.

    `operations` are the handlers of POST /v1/robots/{robot}/{operation}; any other request, also a wrong method or
    an unknown operation, takes FastAPI's way; and so do all where that way is traced (`is_traced`). `door` is where
    requests arrive, and leads to `answer`.
    """

    def __init__(self, max_body_bytes: int, bodies: Bodies, is_traced: bool = False, **description: Any) -> None:
        super().__init__(**description)
        self._max_body_bytes, self._is_traced = max_body_bytes, is_traced
        self.bodies = bodies
        self.operations: dict[str, Handler] = {}
        self.door: ASGIApp = self.answer

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a connection."""
        if self.root_path and scope["type"] == "http":
            scope = prefixed(scope, self.root_path)
        await self.door(scope, receive, send)

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request that has passed the checks; HEAD is GET without the body."""
        if self.root_path and scope.get("path") == self.root_path:  # links are relative to the folder
            await RedirectResponse(f"{self.root_path}/")(scope, receive, send)
            return
        if scope["type"] == "http" and scope["method"] == "HEAD":
            scope = {**scope, "method": "GET"}
        if scope["type"] == "http" and scope["method"] == "POST" and not self._is_traced:
            scope["root_path"] = self.root_path
            match = _OPERATION.fullmatch(scope["path"].removeprefix(self.root_path))
            handler = self.operations.get(match["operation"]) if match else None
            if match and handler:
                scope["path_params"] = {"robot": match["robot"]}
                try:
                    with BoundedRequest(scope, receive, send, self._max_body_bytes, self.bodies) as request:
                        response = await handler(request)
                except ClientDisconnect:
                    return
                except Exception as error:
                    response = problems.answer(request, error)
                await response(scope, receive, send)
                return
        await super().__call__(scope, receive, send)


def prefixed(scope: Scope, root_path: str) -> Scope:
    """A request with the path prefix, also behind a proxy that has taken it away: mounted files are found by it."""
    path: str = scope["path"]
    has_it = path == root_path or path.startswith(f"{root_path}/")
    return scope if has_it else {**scope, "path": root_path + path}


async def in_thread(executor: Executor, work: Callable[[], Response]) -> Response:
    """Do what would hold up the event loop beside it."""
    return await asyncio.get_running_loop().run_in_executor(executor, work)


@dataclass(frozen=True, slots=True)
class Outcome:
    """The result of a computation in the shapes it can travel in; each is made on demand.

    Attributes:
        content: For JSON.
        array: For npy, with headers that say what the array cannot; None where the call asked for something that one
            array cannot hold.
        picture: For an image, as `svg` or `png`.
        columns: Names of the array's columns, for CSV.
        solved: What the metrics count of inverse kinematics, by the number of targets.
    """

    content: Callable[[], Any]
    array: Callable[[], tuple[Array, dict[str, str]]] | None
    picture: Callable[[PictureFormat], bytes] | None = None
    columns: Sequence[str] | None = None
    solved: Callable[[int], Tally] | None = None


@dataclass(frozen=True, slots=True)
class Computation(Generic[_Request]):
    """An operation on a robot: request in, outcome out.

    Attributes:
        run: The operation.
        request: What it takes as JSON.
        is_heavy: Whether a request of few bytes can still be much work.
        options: The same without the array that an npy body brings; None where there is no such body.
        array_field: The field that such an array stands for.
        attempt: The operation where it is quick; None when called if it is not.
        lesson: What has to be known for that.
        picture: What an image of the answer shows, where there is one; it is drawn in a thread.
        table: What the answer holds as CSV, where there is one.
        long: How it is done as a job, where it can be.
    """

    run: Callable[[LoadedRobot, _Request], Outcome]
    request: type[_Request]
    is_heavy: Callable[[_Request], bool]
    options: type[Payload] | None = None
    array_field: str = ""
    attempt: Callable[[LoadedRobot, _Request], Outcome | None] | None = None
    lesson: Lesson[_Request] | None = None
    picture: str | None = None
    table: str | None = None
    long: LongWork[_Request] | None = None

    def handler(self, name: str, remote: Remote, runner: Runner) -> Handler:
        """The handler of its requests: on the event loop where that is fast, else in the crew, or as a job.

        Args:
            name: The operation's.
            remote: Who runs errands.
            runner: Who does jobs.
        """
        errand = OperationErrand(name)
        offered = (JSON, NPY, *((CSV,) if self.table else ()), *((SVG, PNG) if self.picture else ()))
        taken = (JSON,) if self.options is None else (JSON, NPY)

        async def handle(request: BoundedRequest) -> Response:
            npy_in, wanted = _is_npy(request, taken), request.preferred(offered)
            pieces = await request.pieces()
            robot, query = request.path_params["robot"], request.scope["query_string"].decode("latin-1")
            if self.long is not None and wants_answer_later(request.scope["headers"]):
                inquiry = Inquiry(buffers(pieces), robot, query, npy_in)
                planned = await remote.told(request, PlanErrand(name), inquiry)
                return await submitted(runner, self.long.kind, request, planned)
            if request.length <= INLINE_BYTES and not remote.crew.is_starting:
                call = self._parse(query, b"".join(pieces), npy_in)
                if wanted not in _PICTURES and not self.is_heavy(call):
                    loaded = await remote.resident(request, robot)
                    if self.lesson is not None and not self.lesson.is_known(loaded, call):
                        found = await remote.told(
                            request, LessonErrand(name), Inquiry(buffers(pieces), robot, query, npy_in)
                        )
                        await self.lesson.learnt(loaded, call, found)
                    outcome = (self.attempt or self.run)(loaded, call)
                    if outcome is not None:
                        return self._told(call, outcome, wanted)
            return await remote.answer(request, errand, Inquiry(buffers(pieces), robot, query, npy_in, wanted))

        return handle

    def answer(self, library: Library, inquiry: Inquiry) -> Response:
        """The answer to any request, however long it takes."""
        loaded, call = library.get(inquiry.robot), self._parse(inquiry.query, inquiry.body, inquiry.npy)
        return self._told(call, self.run(loaded, call), inquiry.wanted)

    def planned(self, library: Library, inquiry: Inquiry) -> Response:
        """What a job is done from that answers a request."""
        if self.long is None:
            raise NotImplementedError
        loaded = library.get(inquiry.robot)
        return self.long.planned(loaded, self._parse(inquiry.query, inquiry.body, inquiry.npy))

    def taught(self, library: Library, inquiry: Inquiry) -> Response:
        """What there is to learn before requests of this kind are quick."""
        if self.lesson is None:
            raise NotImplementedError
        loaded = library.get(inquiry.robot)
        return self.lesson.taught(loaded, self._parse(inquiry.query, inquiry.body, inquiry.npy))

    def _told(self, call: _Request, outcome: Outcome, wanted: str) -> Response:
        """The answer; what the metrics count of it is left behind."""
        batch = len(getattr(call, self.array_field)) if self.array_field else 0
        TALLY.set(Tally(batch) if outcome.solved is None else outcome.solved(batch))
        return _response(outcome, wanted)

    def _parse(self, query: str, body: bytes, npy: bool) -> _Request:
        if not npy or self.options is None:
            if query:
                raise InvalidField("query", "they are for an npy body; a JSON call has them as fields")
            return read_json(self.request, body)
        options = read_query(self.options, QueryParams(query))
        given = options.model_fields_set | {self.array_field}
        call = self.request.model_construct(given, **{**dict(options), self.array_field: read_npy(body)})
        return cast(_Request, call)


@dataclass(frozen=True, slots=True)
class OperationErrand:
    """An operation on a robot, by its name."""

    name: str

    def __call__(self, desk: Desk, inquiry: Inquiry) -> Response:
        """The answer."""
        return desk.computations[self.name].answer(desk.library, inquiry)


@dataclass(frozen=True, slots=True)
class PlanErrand:
    """To check a request that a job is to answer, by the operation's name."""

    name: str

    def __call__(self, desk: Desk, inquiry: Inquiry) -> Response:
        """What the job is done from."""
        return desk.computations[self.name].planned(desk.library, inquiry)


@dataclass(frozen=True, slots=True)
class Operation:
    """POST /v1/robots/{robot}/{name}, as the schema describes it.

    Attributes:
        name: Last part of its path.
        operation_id: Name of its function in a generated client.
        summary: In a few words.
        computation: What it does; its docstring is the description.
        answer: Model of the JSON answer.
        npy_answer: What the npy answer holds.
        example: A JSON request that runs as it stands, on the Panda.
        npy_body: What an npy body holds, where one is taken.
    """

    name: str
    operation_id: str
    summary: str
    computation: Computation[Any]
    answer: type[Answer]
    npy_answer: str
    example: dict[str, Any]
    npy_body: str | None = None

    def route(self, handler: Handler, max_body_bytes: int) -> DocumentedRoute:
        """Its route: it documents the operation and refuses other methods; `Application` sees the calls first."""

        def endpoint(robot: str, call: Any) -> Any: ...

        def endpoint_or_job(robot: str, call: Any, prefer: str | None = None) -> Any: ...

        long = self.computation.long
        described: Callable[..., Any] = endpoint if long is None else endpoint_or_job
        described.__annotations__ = {"robot": RobotPath, "call": self.computation.request, "return": self.answer}
        if long is not None:
            described.__annotations__["prefer"] = PreferHeader
        shapes = npy_content(self.npy_answer) | csv_content(self.computation.table)
        options, body = self.computation.options, json_example(self.example)
        if self.npy_body is not None and options is not None:
            body |= npy_body(self.npy_body, options)
        return DocumentedRoute(
            f"/v1/robots/{{robot}}/{self.name}",
            described,
            handler,
            max_body_bytes,
            methods=["POST"],
            operation_id=self.operation_id,
            summary=self.summary,
            description="\n\n".join(filter(None, (inspect.getdoc(self.computation.run), _job_note(long)))),
            tags=["Kinematics"],
            responses={
                200: {"content": {**shapes, **picture_content(self.computation.picture)}},
                **problem_responses(400, 404, 413, 415, 422),
                **({} if long is None else {**JOB_BEGUN, **problem_responses(507)}),
            },
            openapi_extra={"requestBody": {"content": body}},
        )


def _job_note(long: LongWork[Any] | None) -> str | None:
    if long is None:
        return None
    return (
        "With `Prefer: respond-async` the call is checked and a job computes the same answer: the reply is 202 with "
        f"the job's address in `Location`. Then there may be {long.more}."
    )


def _is_npy(request: BoundedRequest, taken: Sequence[str]) -> bool:
    given = request.media_type
    if given not in taken:
        raise UnsupportedMediaType(given, taken)
    return given == NPY


def _response(outcome: Outcome, wanted: str) -> Response:
    if wanted == JSON:
        return json_response(outcome.content())
    if wanted in _PICTURES:
        if outcome.picture is None:
            raise InvalidField("Accept", "this answer cannot be drawn: leave the header out for JSON")
        return Response(outcome.picture(_PICTURES[wanted]), media_type=wanted)
    if outcome.array is None:
        raise InvalidArray(NO_ARRAY)
    if wanted == CSV and outcome.columns is not None:
        return csv_response(outcome.columns, *outcome.array())
    return npy_response(*outcome.array())
