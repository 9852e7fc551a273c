"""Endpoints of existing jobs: the list, state, progress events, result, cancelling and removal."""

import asyncio
from collections.abc import AsyncIterator, Iterator, Mapping
from typing import IO, Annotated, Any

import orjson
from fastapi import APIRouter, Header, Path, Query, Response
from starlette.requests import Request
from starlette.responses import StreamingResponse

from gelenk.contract.jobs import Finished
from gelenk.errors import InvalidArray, UnknownJob
from gelenk.http.jobs import trajectory_job
from gelenk.http.jobs.long_work import HEADERS, NO_STORE, RESULTS, headers_of, job_content, job_response
from gelenk.http.jobs.long_works import LONG_WORK
from gelenk.http.messages.openapi import documentation
from gelenk.http.messages.payloads import CSV, JSON, NO_ARRAY, NPY, PICTURES, preferred_type
from gelenk.http.workers.pool_client import client_of
from gelenk.jobs.job import JobRecord
from gelenk.jobs.runner import Runner
from gelenk.jobs.workspace import ARRAY, KIND, SUMMARY
from gelenk.jobs.workspace_picture import picture
from gelenk.store.folders import open_plain

EVENT_STREAM = "text/event-stream"
LOOK_SECONDS = 0.2
"""Interval at which an event stream checks its job, [s]."""
HEARTBEAT_SECONDS = 15.0
"""Time without news after which a stream sends a comment, so that no proxy takes it for dead, [s]."""

_PIECE = 256 * 1024
EXTRA: dict[str, tuple[str, ...]] = {KIND: (*PICTURES,), trajectory_job.KIND: (CSV, *PICTURES)}
"""Media types, besides JSON and npy, in which a kind of job has a result."""

JobPath = Annotated[
    str, Path(description="Name of a job.", openapi_examples={"panda-workspace": {"value": "panda-workspace"}})
]
_NEWEST = 2**53 - 1
LimitQuery = Annotated[
    int, Query(ge=1, le=1000, description="How many at most.", openapi_examples={"few": {"value": 20}})
]
BeforeQuery = Annotated[
    int,
    Query(
        ge=1,
        le=_NEWEST,
        description="`next` of the answer before; the newest if left out.",
        openapi_examples={"newest": {"value": _NEWEST}},
    ),
]
FinishedQuery = Annotated[
    Finished,
    Query(
        description="What to do with a finished job.",
        openapi_examples={"remove": {"value": "remove"}},
    ),
]
LastEvent = Annotated[
    str | None,
    Header(
        description="Sent by a browser when it reconnects; after the last event the answer is 204, and the browser "
        "stops.",
        openapi_examples={"none": {"value": "0"}},
    ),
]

_FORWARDED = {"forwarded", "x-forwarded-for", "x-real-ip"}
"""Headers by which a proxy tells that the request is someone else's."""


def jobs_router(runner: Runner) -> APIRouter:
    """Return the router of the operations on existing jobs."""
    router = APIRouter()

    @router.api_route(**documentation("list_jobs"))
    def list_jobs(request: Request, limit: LimitQuery = 50, before: BeforeQuery = _NEWEST) -> Response:
        # Behind a proxy that does not name them, all clients without a key look like one: nobody is shown the others'.
        is_one_of_many = not client_of(request) and not _FORWARDED.isdisjoint(request.headers.keys())
        found = [] if is_one_of_many else runner.store.newest(client_of(request), limit + 1, before)
        following = found[limit - 1].number if len(found) > limit else None
        content = {"jobs": [job_content(job) for job in found[:limit]], "next": following}
        return Response(orjson.dumps(content), headers=NO_STORE, media_type=JSON)

    @router.api_route(**documentation("get_job"))
    def get_job(job: JobPath) -> Response:
        return job_response(runner.store.get(job))

    @router.api_route(**documentation("watch_job"))
    async def watch_job(job: JobPath, request: Request, last_event_id: LastEvent = None) -> Response:
        first = await asyncio.to_thread(runner.store.get, job)
        if first.is_final and last_event_id == _event_id(first):
            return Response(status_code=204)
        return StreamingResponse(
            _events(runner, first, request.scope.get("state", {})), media_type=EVENT_STREAM, headers=NO_STORE
        )

    @router.api_route(**documentation("get_job_result"))
    def get_result(job: JobPath, request: Request) -> Response:
        record = runner.store.get(job)
        wanted = preferred_type(request.headers.get("accept", ""), (JSON, NPY, *EXTRA.get(record.kind, ())))
        if record.kind == KIND and wanted in PICTURES:
            paths = runner.result(job, ARRAY), runner.result(job, SUMMARY)
            response = Response(runner.rendered(picture, (*paths, PICTURES[wanted])), media_type=wanted)
        else:
            response = _result_response(runner, record, wanted)
        if record.robot_digest is not None:
            response.headers["Gelenk-Robot-Digest"] = record.robot_digest
        return response

    @router.api_route(**documentation("cancel_job"))
    def cancel_job(job: JobPath, finished: FinishedQuery = "keep") -> Response:
        return job_response(runner.cancel(job, remove=finished == "remove"))

    return router


def _event_id(job: JobRecord) -> str:
    return job.state if job.is_final else f"{job.progress:.6f}"


async def _events(runner: Runner, job: JobRecord, state: Mapping[str, Any]) -> AsyncIterator[str]:
    """Yield the events of a job from now on; when its client has left, the server ends the iteration.

    The state of the connection says when the service stops: the stream ends, and a browser reconnects.
    """
    sent, quiet = "", 0.0
    while True:
        if (event_id := f"{job.state} {job.progress}") != sent:
            sent, quiet = event_id, 0.0
            name = "finished" if job.is_final else "progress"
            yield f"event: {name}\nid: {_event_id(job)}\ndata: {orjson.dumps(job_content(job)).decode()}\n\n"
        elif quiet >= HEARTBEAT_SECONDS:
            quiet = 0.0
            yield ": still there\n\n"
        if job.is_final or state.get("stopping"):
            return
        await asyncio.sleep(LOOK_SECONDS)
        quiet += LOOK_SECONDS
        try:
            job = await asyncio.to_thread(runner.store.get, job.id)
        except UnknownJob:
            return


def _result_response(runner: Runner, job: JobRecord, media_type: str) -> Response:
    """Return a result of a job in pieces; once open, its files stay readable to their end."""
    path = runner.result(job.id, RESULTS[media_type])
    pieces, length = LONG_WORK[job.kind].streamed(path.parent, media_type), {}
    if pieces is None:
        try:
            stream = open_plain(path)
        except FileNotFoundError:
            runner.store.get(job.id)
            raise InvalidArray(NO_ARRAY) from None
        pieces, length = _pieces_of(stream), {"Content-Length": str(path.stat().st_size)}
    headers = headers_of(runner.result(job.id, HEADERS), media_type)
    return StreamingResponse(
        pieces,
        media_type=f"{CSV}; header=present" if media_type == CSV else media_type,
        headers={**NO_STORE, **headers, **length},
    )


def _pieces_of(stream: IO[bytes]) -> Iterator[bytes]:
    with stream:
        while piece := stream.read(_PIECE):
            yield piece
