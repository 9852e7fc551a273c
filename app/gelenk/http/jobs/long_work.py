"""Operations on a robot that can run as a job: checked at once, computed later, answered with the same bytes."""

import asyncio
import hashlib
from collections.abc import Callable
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Generic, TypeVar

import numpy as np
import orjson
from numpy.typing import NDArray
from starlette.requests import Request
from starlette.responses import Response

from gelenk.contract.common import Payload
from gelenk.http.jobs.info import job_response
from gelenk.http.messages.payloads import CSV, JSON, NPY, PNG, SVG
from gelenk.http.workers.pool_client import client_of
from gelenk.jobs.parts import packed, unpacked
from gelenk.jobs.robot_files import robot_files
from gelenk.jobs.runner import Runner, Work
from gelenk.operations.outcome import Limits
from gelenk.store.records import LoadedRobot

_Request = TypeVar("_Request", bound=Payload)

RESULTS = {JSON: "result.json", NPY: "result.npy", CSV: "result.csv", SVG: "result.svg", PNG: "result.png"}
"""File of a result by its media type, for every kind of job."""
CALL = "call.json"
"""File of a request that holds the call, perhaps with a name for the job in `job_id`."""
HEADERS = "headers.json"
"""File with further headers of these results, by media type."""


@dataclass(frozen=True, slots=True)
class LongWork(Generic[_Request]):
    """Computes an operation as a job.

    `request` checks a call and returns the files that the job is computed from, besides the robot's. `work` returns
    the function that computes the job from the folder of these files.
    """

    request: Callable[[LoadedRobot, _Request, Limits], dict[str, bytes]]
    work: Callable[[Limits, Path], Work]

    def planned(self, robot: LoadedRobot, call: _Request, limits: Limits) -> bytes:
        """Check the call and return all files of its request, packed into one."""
        files = {**robot_files(robot.record.name, robot.robot, robot.urdf), **self.request(robot, call, limits)}
        return packed(**{name: as_bytes(content) for name, content in files.items()})


def as_bytes(content: bytes) -> NDArray[np.uint8]:
    """Return bytes as an array, to be packed with others."""
    return np.frombuffer(content, np.uint8)


def npy_file(array: NDArray[np.float64]) -> bytes:
    """Return an array as the content of an npy file."""
    target = BytesIO()
    np.lib.format.write_array(target, np.ascontiguousarray(array), allow_pickle=False)
    return target.getvalue()


async def submitted(runner: Runner, kind: str, request: Request, planned: bytes, headers: dict[str, str]) -> Response:
    """Submit a planned job; return 202 with the job's address and these headers; raises as `Runner.submit`."""

    def submit() -> Response:
        files = {name: content.tobytes() for name, content in unpacked(planned).items()}
        job_id = orjson.loads(files[CALL]).get("job_id")
        job = runner.submit(kind, hashlib.sha256(planned).hexdigest(), files, job_id, client_of(request))
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
