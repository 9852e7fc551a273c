"""Endpoints of existing jobs: state, progress events, result, cancelling and removal."""

import asyncio
from collections.abc import AsyncIterator, Mapping
from typing import Annotated, Any, Literal

import orjson
from fastapi import APIRouter, Header, Path, Query, Response
from starlette.background import BackgroundTask
from starlette.requests import Request
from starlette.responses import StreamingResponse

from gelenk.contract.ik import InverseAnswer
from gelenk.contract.jobs import Finished, JobInfo
from gelenk.contract.trajectory_answer import TrajectoryAnswer
from gelenk.contract.workspace import WorkspaceAnswer
from gelenk.errors import InvalidArray, UnknownJob
from gelenk.http.jobs import trajectory_job
from gelenk.http.jobs.info import NO_STORE, job_content, job_response
from gelenk.http.jobs.long_work import HEADERS, RESULTS, headers_of
from gelenk.http.messages.openapi import csv_content, npy_content, picture_content, problem_responses
from gelenk.http.messages.payloads import CSV, JSON, NO_ARRAY, NPY, PNG, SVG, preferred_type
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
EXTRA: dict[str, tuple[str, ...]] = {KIND: (SVG, PNG), trajectory_job.KIND: (CSV, SVG, PNG)}
"""Media types, besides JSON and npy, in which a kind of job has a result."""
_PICTURES: dict[str, Literal["svg", "png"]] = {SVG: "svg", PNG: "png"}

_EVENT = {
    "type": "object",
    "properties": {
        "event": {"enum": ["progress", "finished"]},
        "id": {"type": "string", "description": "Same as `Last-Event-ID`, which a browser sends when it reconnects."},
        "data": {
            "type": "string",
            "contentMediaType": JSON,
            "contentSchema": {"$ref": f"#/components/schemas/{JobInfo.__name__}"},
        },
    },
    "required": ["event", "id", "data"],
}
JobPath = Annotated[
    str, Path(description="Name of a job.", openapi_examples={"panda-workspace": {"value": "panda-workspace"}})
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


def jobs_router(runner: Runner) -> APIRouter:
    """Return the router of the operations on existing jobs."""
    router = APIRouter(prefix="/v1/jobs", tags=["Jobs"])

    @router.get(
        "/{job}",
        operation_id="get_job",
        summary="A job",
        response_model=JobInfo,
        responses=problem_responses(404, 422),
    )
    def get_job(job: JobPath) -> Response:
        """A job's state and progress. Every worker knows every job, and jobs survive a restart.

        A job whose process ended is `queued` until another process resumes the unfinished part.
        """
        return job_response(runner.store.get(job))

    @router.get(
        "/{job}/events",
        operation_id="watch_job",
        summary="A job's progress as events",
        response_class=StreamingResponse,
        responses={
            200: {"content": {EVENT_STREAM: {"itemSchema": _EVENT}}, "description": "Server-sent events"},
            204: {"description": "The last event was received before"},
            **problem_responses(404, 422),
        },
    )
    async def watch_job(job: JobPath, request: Request, last_event_id: LastEvent = None) -> Response:
        """Server-sent events until the job finishes.

        `event: progress` on each advance, and at the end `event: finished`; the data of both is the job as
        `GET /v1/jobs/{job}` has it. Comments keep the connection alive between them.
        """
        first = await asyncio.to_thread(runner.store.get, job)
        if first.is_final and last_event_id == _event_id(first):
            return Response(status_code=204)
        return StreamingResponse(
            _events(runner, first, request.scope.get("state", {})), media_type=EVENT_STREAM, headers=NO_STORE
        )

    @router.get(
        "/{job}/result",
        operation_id="get_job_result",
        summary="A job's result",
        response_model=WorkspaceAnswer | InverseAnswer | TrajectoryAnswer,
        responses={
            200: {
                "content": {
                    **npy_content(
                        "Of a workspace the array, columns as `array.columns` of the JSON has them: (N, 4) x y z "
                        "measure of a cloud, (M, 5) x y z samples best_measure of a grid, (M, 6) with the share of a "
                        "dexterity map. For other jobs what the call itself answers, headers included."
                    ),
                    **csv_content("For a trajectory what the call itself answers."),
                    **picture_content(
                        "A workspace from the front, the side and above, or in its plane, coloured by the measure or "
                        "the dexterity. For a trajectory what the call itself answers."
                    ),
                }
            },
            **problem_responses(404, 409, 413, 422, 500, 503),
        },
    )
    def get_result(job: JobPath, request: Request) -> Response:
        """Returns a workspace's summary (JSON), array (npy) or picture, as `Accept` says, or the answer of another job.

        That answer is byte for byte what the operation returns directly. The header `Gelenk-Robot-Digest` has the
        `robot_digest` of the job. A failed job returns its problem.

        A job given up because the service ended every time it was started returns 409: submit it again.
        """
        told = runner.store.get(job)
        wanted = preferred_type(request.headers.get("accept", ""), (JSON, NPY, *EXTRA.get(told.kind, ())))
        if told.kind == KIND and wanted in _PICTURES:
            paths = runner.result(job, ARRAY), runner.result(job, SUMMARY)
            response = Response(runner.rendered(picture, (*paths, _PICTURES[wanted])), media_type=wanted)
        else:
            response = _file_response(runner, job, wanted)
        if told.robot_digest is not None:
            response.headers["Gelenk-Robot-Digest"] = told.robot_digest
        return response

    @router.delete(
        "/{job}",
        operation_id="cancel_job",
        summary="Cancel a job, or remove a finished one",
        response_model=JobInfo,
        responses=problem_responses(404, 409, 422, 503, 507),
    )
    def cancel_job(job: JobPath, finished: FinishedQuery = "keep") -> Response:
        """A queued or running job is cancelled at once, whichever worker runs it, and can still be read.

        A finished job, even if it finished only now, keeps its result: 409 with its `state`. With `finished=remove` it
        is removed together with its result; the answer shows it one last time.
        """
        return job_response(runner.cancel(job, remove=finished == "remove"))

    return router


def _event_id(job: JobRecord) -> str:
    return job.state if job.is_final else f"{job.progress:.6f}"


async def _events(runner: Runner, job: JobRecord, state: Mapping[str, Any]) -> AsyncIterator[str]:
    """Yield the events of a job from now on; when its client has left, the server ends the iteration.

    Args:
        runner: Runner whose store holds the job.
        job: Present state of the job.
        state: State of the connection; it says when the service stops: the stream ends, and a browser reconnects.
    """
    told, quiet = "", 0.0
    while True:
        if (event_id := f"{job.state} {job.progress}") != told:
            told, quiet = event_id, 0.0
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


def _file_response(runner: Runner, job_id: str, media_type: str) -> Response:
    """Return a result file of a job in pieces; once open, the file stays readable to its end."""
    path = runner.result(job_id, RESULTS[media_type])
    try:
        stream = open_plain(path)
    except FileNotFoundError:
        runner.store.get(job_id)
        raise InvalidArray(NO_ARRAY) from None
    headers = headers_of(runner.result(job_id, HEADERS), media_type)
    return StreamingResponse(
        iter(lambda: stream.read(_PIECE), b""),
        media_type=f"{CSV}; header=present" if media_type == CSV else media_type,
        headers={**NO_STORE, **headers, "Content-Length": str(path.stat().st_size)},
        background=BackgroundTask(stream.close),
    )
