"""Routes and handlers of all operations, built from the table of endpoints.

The event loop answers fast requests itself; a worker or a job answers the others. A worker receives the endpoint's
name and the request as it arrived.
"""

import asyncio
import pickle
import time
from collections.abc import Callable, Iterable
from functools import lru_cache
from inspect import Parameter, Signature
from typing import Annotated, Any, Literal, cast

from fastapi import Query
from starlette.datastructures import QueryParams
from starlette.responses import Response

from gelenk.contract.endpoint import Endpoint, RobotEndpoint
from gelenk.contract.endpoints import BY_NAME
from gelenk.contract.trajectory import JOINT_TRAJECTORY, URSCRIPT, YAML
from gelenk.errors import InvalidArray, InvalidField, UnknownScene, quoted
from gelenk.http.jobs.long_work import submitted
from gelenk.http.jobs.long_works import LONG_WORK
from gelenk.http.messages.npy import npy_response, read_npy
from gelenk.http.messages.openapi import PreferHeader, RobotPath, endpoint_documentation
from gelenk.http.messages.payloads import (
    CSV,
    JSON,
    NO_ARRAY,
    NPY,
    PICTURES,
    PREFERENCE_APPLIED,
    BoundedRequest,
    JsonResponse,
    csv_response,
    read_json,
    read_query,
    wants_answer_later,
)
from gelenk.http.messages.problems import UnsupportedMediaType
from gelenk.http.messages.routes import DocumentedRoute, Handler
from gelenk.http.workers.pool_client import INLINE_BYTES, PoolClient
from gelenk.http.workers.task import Context, TaskRequest, buffers
from gelenk.jobs.runner import Runner
from gelenk.operations.operation import Operation, operation
from gelenk.operations.outcome import REQUEST_COUNTS, Limits, Outcome, RequestCounts
from gelenk.store.records import LoadedRobot

_FORMATS = {"json": JSON, "csv": CSV, "npy": NPY, "joint_trajectory": JOINT_TRAJECTORY, "urscript": URSCRIPT}
"""Media types by their names in a query, which goes before `Accept`."""
_OPTIONAL = {"prefer", "format"}
FormatQuery = Annotated[
    Literal["json", "csv", "npy", "joint_trajectory", "urscript"] | None,
    Query(description="Form of the answer; without it `Accept` counts.", openapi_examples={"JSON": {"value": "json"}}),
]


def answer(context: Context, task_request: TaskRequest) -> Response:
    """Answer any request, in a worker, however long it takes."""
    found = operation(task_request.endpoint)
    robot, call = _robot_and_call(context, found.endpoint, task_request)
    return _answered(found.endpoint, call, found.run(robot, call, context.limits), task_request.wanted)


def plan_job(context: Context, task_request: TaskRequest) -> Response:
    """Check the request for a job, and return the files that the job is computed from, packed into one."""
    robot, call = _robot_and_call(context, BY_NAME[task_request.endpoint], task_request)
    return Response(LONG_WORK[task_request.endpoint].planned(cast(LoadedRobot, robot), call, context.limits))


def find(context: Context, task_request: TaskRequest) -> Response:
    """Find what has to be known about a robot before requests of this kind are fast, and return it pickled."""
    warm_up = operation(task_request.endpoint).warm_up
    robot, call = _robot_and_call(context, BY_NAME[task_request.endpoint], task_request)
    return Response(b"" if warm_up is None else pickle.dumps(warm_up.find(cast(LoadedRobot, robot), call)))


def handler(endpoint: Endpoint[Any, Any], pool_client: PoolClient, runner: Runner, limits: Limits) -> Handler:
    """Return the handler of an endpoint's requests."""
    further = {NPY: endpoint.npy_answer, CSV: endpoint.table, **dict.fromkeys(PICTURES, endpoint.picture)}
    offered = (JSON, *(media_type for media_type, content in further.items() if content), *endpoint.programs)
    if endpoint.is_picture:
        offered = (*PICTURES, JSON)
    accepted = (JSON,) if endpoint.options is None else (JSON, NPY)
    is_job = endpoint.is_job

    async def handle(request: BoundedRequest) -> Response:
        media_type = request.media_type
        if media_type not in accepted:
            raise UnsupportedMediaType(media_type, accepted)
        wanted, pieces = request.preferred(offered), await request.pieces()
        query, is_npy = request.scope["query_string"].decode("latin-1"), media_type == NPY
        if query and endpoint.programs:
            wanted, query = _format(query, wanted), ""

        def task_request() -> TaskRequest:
            robot = request.path_params.get("robot", "")
            return TaskRequest(buffers(pieces), robot, query, is_npy, wanted, endpoint.name)

        if is_job or (endpoint.job and wants_answer_later(request.scope["headers"])):
            if wanted in endpoint.programs:
                raise InvalidField("format", "a job's result is fetched as JSON, CSV, npy or a picture")
            planned = await pool_client.content(request, plan_job, task_request())
            applied = {} if is_job else PREFERENCE_APPLIED
            return await submitted(runner, endpoint.name, request, planned, pieces, applied)
        if request.length <= INLINE_BYTES and pool_client.may_compute_here:
            call, found = _parsed(endpoint, query, pieces, is_npy), operation(endpoint.name)
            robot = pool_client.loaded(request.scope["path_params"]["robot"]) if found.needs_robot else None
            if robot is not None and found.at_once is not None:
                began = time.perf_counter()  # processor time is the same or less, and a tenth as quick to read
                outcome = found.at_once(robot, call, limits)
                pool_client.note_computation(time.perf_counter() - began)
                if outcome is not None:
                    return _answered(endpoint, call, outcome, wanted)
            # After a long attempt it is no longer the event loop's turn.
            is_light = pool_client.may_compute_here and wanted not in PICTURES and not _names_scene(call)
            if is_light and not found.is_heavy(call):
                if found.needs_robot and not _is_prepared(found, robot, call):
                    robot = await _prepared(found, pool_client, request, call, task_request)
                began = time.thread_time()
                outcome = found.run(None, call, limits) if robot is None else found.attempt(robot, call, limits)
                took_long = pool_client.note_computation(time.thread_time() - began)
                if outcome is not None:
                    if took_long:  # Others get their turn before this is encoded.
                        await asyncio.sleep(0)
                    return _answered(endpoint, call, outcome, wanted)
        return await pool_client.answer(request, answer, task_request())

    return handle


def _format(query: str, wanted: str) -> str:
    """Return the media type that a query names, and nothing else; raises InvalidField."""
    given = QueryParams(query).multi_items()
    if [name for name, _ in given] != ["format"]:
        raise InvalidField("query", "this call has its parameters as fields of the body; only `format` may stand here")
    if (name := given[0][1]) not in _FORMATS:
        raise InvalidField("format", f"{quoted(name)} is none of {', '.join(_FORMATS)}")
    return YAML if name == "joint_trajectory" and wanted == YAML else _FORMATS[name]


def _is_prepared(found: Operation, robot: LoadedRobot | None, call: Any) -> bool:
    """Check whether a robot is in memory with all that a quick answer needs of it."""
    return robot is not None and (found.warm_up is None or found.warm_up.is_known(robot, call))


async def _prepared(
    found: Operation,
    pool_client: PoolClient,
    request: BoundedRequest,
    call: Any,
    task_request: Callable[[], TaskRequest],
) -> LoadedRobot:
    """Load the robot of a request; a worker first finds what a quick answer needs of it."""
    robot = await pool_client.resident(request, request.path_params["robot"])
    if found.warm_up is not None and not found.warm_up.is_known(robot, call):
        content = await pool_client.content(request, find, task_request())
        known = pickle.loads(content)  # noqa: S301 - from a process of ours
        await asyncio.to_thread(found.warm_up.keep, robot, call, known)
    return robot


def route(endpoint: Endpoint[Any, Any], handle: Handler, max_body_bytes: int) -> DocumentedRoute:
    """Return the route of an endpoint: it documents the operation and refuses other methods."""
    types: dict[str, Any] = {"call": endpoint.request}
    if isinstance(endpoint, RobotEndpoint):
        types = {"robot": RobotPath, **types, **({"prefer": PreferHeader} if endpoint.job else {})}
    types |= {"format": FormatQuery} if endpoint.programs else {}

    def described(**_: Any) -> Any: ...

    described.__signature__ = Signature(  # type: ignore[attr-defined]
        [
            Parameter(
                name, Parameter.KEYWORD_ONLY, annotation=kind, default=None if name in _OPTIONAL else Parameter.empty
            )
            for name, kind in types.items()
        ]
    )
    return DocumentedRoute(described, handle, max_body_bytes, **endpoint_documentation(endpoint))


def _robot_and_call(
    context: Context, endpoint: Endpoint[Any, Any], task_request: TaskRequest
) -> tuple[LoadedRobot | None, Any]:
    """Return the robot of a request and its call, which has the scene itself where it named a stored one."""
    robot = context.library.get(task_request.robot) if task_request.robot else None
    call = _parsed(endpoint, task_request.query, task_request.pieces, task_request.npy)
    if endpoint.robot_field and (name := getattr(call, endpoint.robot_field)) is not None:
        robot = context.library.get(name)
    if _names_scene(call):
        try:
            call = call.model_copy(update={"scene": context.scenes.get(call.scene)})
        except UnknownScene as error:
            raise UnknownScene(error.scene, error.close, "scene") from None
    return robot, call


def _names_scene(call: Any) -> bool:
    """Check whether a call names a stored scene; a worker answers it, because scenes are read from disk.

    Asking a call for a field that it does not have takes as long as its kernel.
    """
    return "scene" in type(call).__pydantic_fields__ and isinstance(call.scene, str)


def _parsed(endpoint: Endpoint[Any, Any], query: str, pieces: Iterable[bytes | pickle.PickleBuffer], npy: bool) -> Any:
    model: Any = endpoint.request
    if endpoint.options is not None and npy:
        options = read_query(cast(Any, endpoint.options), QueryParams(query))
        given = options.model_fields_set | {endpoint.batch}
        return model.model_construct(given, **{**dict(options), endpoint.batch: read_npy(bytearray().join(pieces))})
    if query:
        why = "they are for an npy body; a JSON call has them as fields"
        raise InvalidField(
            "query", "this call has its parameters as fields of the body" if endpoint.options is None else why
        )
    return read_json(model, b"".join(pieces))


_counts = lru_cache(RequestCounts)
"""Most batches have one of a few sizes."""


def _answered(endpoint: Endpoint[Any, Any], call: Any, outcome: Outcome, wanted: str) -> Response:
    """Build the response, and set what the metrics count of it."""
    batch = len(getattr(call, endpoint.batch)) if endpoint.batch else 0
    REQUEST_COUNTS.set(_counts(batch) if outcome.solved is None else outcome.solved(batch))
    if wanted == JSON:
        return JsonResponse(outcome.content())
    if wanted in PICTURES:
        if outcome.picture is None:
            raise InvalidField("Accept", "this answer cannot be drawn: leave the header out for JSON")
        return Response(outcome.picture(PICTURES[wanted]), media_type=wanted)
    if wanted in outcome.programs:
        return Response(outcome.programs[wanted](), media_type=wanted)
    if outcome.array is None:
        raise InvalidArray(NO_ARRAY)
    if wanted == CSV and outcome.columns is not None:
        return csv_response(outcome.columns, *outcome.array())
    return npy_response(*outcome.array())
