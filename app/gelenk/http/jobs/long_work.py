"""Operations on a robot that can run as a job: checked at once, computed later, with the same answer; jobs in JSON."""

import asyncio
import hashlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np
import orjson
from numpy.typing import NDArray
from starlette.requests import Request
from starlette.responses import Response

from gelenk.contract.common import Payload, content_of
from gelenk.contract.jobs import JobInfo
from gelenk.errors import kind_of
from gelenk.http.messages.payloads import CSV, JSON, NPY, PICTURES
from gelenk.http.workers.pool_client import client_of
from gelenk.jobs.job import JobRecord
from gelenk.jobs.parts import packed, unpacked
from gelenk.jobs.robot_files import robot_files
from gelenk.jobs.runner import Runner, Work
from gelenk.logs import moment
from gelenk.operations.outcome import Limits
from gelenk.store.records import LoadedRobot

NO_STORE = {"Cache-Control": "no-store"}


def job_response(job: JobRecord, status: int = 200, headers: dict[str, str] | None = None) -> Response:
    """Return a job as a response."""
    return Response(orjson.dumps(job_content(job)), status, {**NO_STORE, **(headers or {})}, JSON)


def job_content(job: JobRecord) -> dict[str, Any]:
    """Return a job as JSON content."""
    moments = {"created": job.created, "started": job.started, "finished": job.finished}
    times = {name: None if time is None else moment(time) for name, time in moments.items()}
    if (failure := job.failure) is None:
        return content_of(JobInfo, job, **times, error=None)
    kind = f"urn:gelenk:{kind_of(type(failure.error_again()))}"
    error = {"type": kind, "detail": failure.detail, "facts": failure.facts}
    return content_of(JobInfo, job, **times, error=error)


_Request = TypeVar("_Request", bound=Payload)

RESULTS = {
    JSON: "result.json",
    NPY: "result.npy",
    CSV: "result.csv",
    **{media_type: f"result.{kind}" for media_type, kind in PICTURES.items()},
}
"""File of a result by its media type, for every kind of job."""
CALL = "call.json"
"""File of a request that holds the call, perhaps with a name for the job in `job_id`."""
HEADERS = "headers.json"
"""File with further headers of these results, by media type."""
AS_SENT = None
"""In place of a file's content: the body of the request, which need not come back from the process that checks it."""
_AS_SENT = "as sent"
"""Where the names of these files are packed."""


@dataclass(frozen=True, slots=True)
class LongWork(Generic[_Request]):
    """Computes an operation as a job.

    `request` checks a call and returns the files that the job is computed from, besides the robot's. `work` returns
    the function that computes the job from the folder of these files. `streamed` returns the pieces of a result of a
    media type that is only made while it is sent, from the job's folder; None if there is a file of it, or no such
    result.
    """

    request: Callable[[LoadedRobot, _Request, Limits], Mapping[str, bytes | None]]
    work: Callable[[Limits, Path], Work]
    streamed: Callable[[Path, str], Iterator[bytes] | None] = lambda *_: None

    def planned(self, robot: LoadedRobot, call: _Request, limits: Limits) -> bytes:
        """Check the call and return all files of its request, packed into one, except the body as it was sent."""
        files = {**robot_files(robot.record.name, robot.robot, robot.urdf), **self.request(robot, call, limits)}
        contents = {name: as_bytes(content) for name, content in files.items() if content is not AS_SENT}
        as_sent = [name for name, content in files.items() if content is AS_SENT]
        return packed(**contents, **{_AS_SENT: as_bytes(orjson.dumps(as_sent))})


def as_bytes(content: bytes) -> NDArray[np.uint8]:
    """Return bytes as an array, to be packed with others."""
    return np.frombuffer(content, np.uint8)


def npy_file(array: NDArray[np.float64]) -> bytes:
    """Return an array as the content of an npy file."""
    target = BytesIO()
    np.lib.format.write_array(target, np.ascontiguousarray(array), allow_pickle=False)
    return target.getvalue()


async def submitted(
    runner: Runner, kind: str, request: Request, planned: bytes, pieces: Sequence[bytes], headers: dict[str, str]
) -> Response:
    """Submit a planned job; return 202 with the job's address and these headers; raises as `Runner.submit`.

    `pieces` are those of the request's body.
    """

    def submit() -> Response:
        files = {name: content.tobytes() for name, content in unpacked(planned).items()}
        digest = hashlib.sha256(planned)
        for name in orjson.loads(files.pop(_AS_SENT)):
            files[name] = b"".join(pieces)
            digest.update(files[name])
        job_id = orjson.loads(files[CALL]).get("job_id")
        job = runner.submit(kind, digest.hexdigest(), files, job_id, client_of(request))
        location = f"{request.scope.get('root_path', '')}/v1/jobs/{job.id}"
        return job_response(job, 202, {"Location": location, **headers})

    return await asyncio.to_thread(submit)


def headers_file(headers: dict[str, dict[str, str]]) -> bytes:
    """Return the content of the file of headers, by media type."""
    return orjson.dumps(headers)


def headers_of(path: Path, media_type: str) -> dict[str, str]:
    """Read the headers of a result; empty if it has none."""
    try:
        headers: dict[str, dict[str, str]] = orjson.loads(path.read_bytes())
    except FileNotFoundError:
        return {}
    return headers.get(media_type, {})
