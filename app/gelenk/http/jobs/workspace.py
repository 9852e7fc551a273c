"""The numeric workspace of a robot, as a job."""

import asyncio
import hashlib
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from starlette.responses import Response

from gelenk.contract.jobs import JobInfo
from gelenk.contract.workspace import SlicePlane, WorkspaceRequest
from gelenk.errors import InvalidField, TooLarge
from gelenk.http.jobs.info import job_response
from gelenk.http.messages.openapi import RobotPath, json_example, problem_responses
from gelenk.http.messages.payloads import JSON, BoundedRequest, read_json
from gelenk.http.messages.problems import UnsupportedMediaType
from gelenk.http.messages.routes import DocumentedRoute
from gelenk.http.workers.pool_client import PARSED_HERE_BYTES, PoolClient, client_of
from gelenk.jobs.job import JobRecord
from gelenk.jobs.robot_files import robot_files, robot_of, robot_text
from gelenk.jobs.runner import Runner, Work
from gelenk.jobs.workspace import KIND, WorkspaceWork, check_size, question, work_of
from gelenk.kinematics.workspace.survey import POINT_COLUMNS
from gelenk.kinematics.workspace.workspace import Plane, Wish
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.store.folders import read_plain
from gelenk.store.records import LoadedRobot

_CALL = "call.json"


@dataclass(frozen=True, slots=True)
class SampleLimits:
    """Limits of one job.

    Attributes:
        samples: Maximum number of configurations.
        numbers: Maximum number of entries in the array of its result.
    """

    samples: int
    numbers: int


def workspace_route(
    runner: Runner, pool_client: PoolClient, limits: SampleLimits, max_body_bytes: int
) -> DocumentedRoute:
    """Return the route POST /v1/robots/{robot}/workspace; it checks the request in a thread before it creates a job."""

    def workspace(robot: RobotPath, call: WorkspaceRequest) -> JobInfo:
        """Samples the workspace of any chain within its joint limits, as a job.

        The reply is immediate, with the job's address in `Location`; `GET` that, or its `/events`, until `state` is
        `succeeded`, then get `/result`: as JSON a summary (extent, reach, volume, the largest manipulability, how well
        a sample of it agrees with Pinocchio), as npy the positions or voxels, as SVG or PNG a picture.

        The same request gives the same result, whatever the number of processes. Samples are uniform in joint space:
        regions that few configurations lead to need more of them, and `late_share` shows whether there were enough. For
        planar arms `/v1/course/workspace` gives the exact workspace.
        """
        raise NotImplementedError

    async def handle(request: BoundedRequest) -> Response:
        if request.media_type != JSON:
            raise UnsupportedMediaType(request.media_type, (JSON,))
        if request.scope["query_string"]:
            raise InvalidField("query", "this call has its parameters as fields of the body")
        body = await request.body()
        robot = await pool_client.resident(request, request.path_params["robot"])

        def begin() -> Response:
            call = read_json(WorkspaceRequest, body)
            job = _submitted(runner, robot, call, limits, client_of(request))
            return job_response(job, 202, {"Location": f"{request.scope.get('root_path', '')}/v1/jobs/{job.id}"})

        return await asyncio.to_thread(begin)

    return DocumentedRoute(
        "/v1/robots/{robot}/workspace",
        workspace,
        handle,
        min(max_body_bytes, PARSED_HERE_BYTES),
        methods=["POST"],
        operation_id="workspace",
        summary="Workspace",
        tags=["Kinematics"],
        status_code=202,
        responses=problem_responses(400, 404, 409, 413, 415, 422, 429, 503, 507),
        openapi_extra={
            "requestBody": {
                "content": json_example(
                    {"kind": "cloud", "samples": 100_000, "tip_frame": "panda_link8", "job_id": "panda-workspace"}
                )
            }
        },
    )


def _submitted(
    runner: Runner, loaded: LoadedRobot, call: WorkspaceRequest, limits: SampleLimits, client: str
) -> JobRecord:
    """Check a call and submit its job."""
    if call.samples > limits.samples:
        raise TooLarge("samples", call.samples, limits.samples)
    numbers = call.samples * len(POINT_COLUMNS)
    if call.kind == "cloud" and numbers > limits.numbers:
        raise TooLarge("numbers in the result (a grid has fewer)", numbers, limits.numbers)
    if call.task is not None and len(set(call.task)) < len(call.task):
        raise InvalidField("task", "each direction may appear only once")
    chain = loaded.robot.chain(call.base_frame, call.tip_frame)
    for field in ("orientations", "orientations_over"):
        if call.kind != "dexterity" and field in call.model_fields_set:
            raise InvalidField(field, f"is only allowed with the kind `dexterity`; this one is `{call.kind}`")
    if call.job_id is None:  # a job of that name may be this one
        runner.store.check_room(client)
    check_size(_question(loaded.record.name, loaded.robot, chain, call))
    ends = f"{loaded.record.name}\0{chain.base_frame}\0{chain.tip_frame}\0"
    content = call.model_dump_json(exclude={"job_id", "base_frame", "tip_frame"})
    digest = hashlib.sha256((ends + content + loaded.urdf).encode("utf-8", "surrogatepass")).hexdigest()
    whole = call.model_copy(update={"base_frame": chain.base_frame, "tip_frame": chain.tip_frame, "job_id": None})
    request = {**robot_files(loaded.record.name, loaded.robot, loaded.urdf), _CALL: whole.model_dump_json().encode()}
    return runner.submit(KIND, digest, request, call.job_id, client)


def workspace_work(folder: Path) -> Work:
    """Return the function that computes a job, from the folder of its request."""
    text = robot_text(folder)
    robot = robot_of(text)
    call = read_json(WorkspaceRequest, read_plain(folder / _CALL))
    return work_of(_question(text.name, robot, robot.chain(call.base_frame, call.tip_frame), call))


def _question(name: str, robot: RobotModel, chain: Chain, call: WorkspaceRequest) -> WorkspaceWork:
    """Return what the job computes, checked as far as that depends on the robot."""
    return question(name, robot, chain, _wish(call), call.orientations_over, call.orientations)


def _wish(call: WorkspaceRequest) -> Wish:
    return Wish(
        call.kind,
        call.samples,
        call.sequence,
        call.random_seed,
        call.voxel_size,
        None if call.task is None else tuple(call.task),
        None if call.plane is None else _plane(call.plane),
        {name: (bounds[0], bounds[1]) for name, bounds in call.joint_ranges.items()},
    )


def _plane(plane: SlicePlane) -> Plane:
    length = math.hypot(*plane.normal)
    if length == 0.0:
        raise InvalidField("plane/normal", "a normal cannot have length zero")
    return Plane(np.array(plane.origin), np.array(plane.normal) / length, plane.thickness)
