"""The numeric workspace of a robot, as a job."""

import math
from pathlib import Path

import numpy as np

from gelenk.contract.workspace import SlicePlane, WorkspaceRequest
from gelenk.errors import InvalidField, TooLarge
from gelenk.http.jobs.long_work import CALL, LongWork
from gelenk.http.messages.payloads import read_json
from gelenk.jobs.robot_files import robot_of, robot_text
from gelenk.jobs.runner import Work
from gelenk.jobs.workspace import WorkspaceWork, check_size, question, work_of
from gelenk.kinematics.workspace.survey import POINT_COLUMNS
from gelenk.kinematics.workspace.workspace import Plane, Wish
from gelenk.operations.outcome import Limits
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.store.folders import read_plain
from gelenk.store.records import LoadedRobot


def _request(loaded: LoadedRobot, call: WorkspaceRequest, limits: Limits) -> dict[str, bytes]:
    if call.samples > limits.job_samples:
        raise TooLarge("samples", call.samples, limits.job_samples)
    numbers = call.samples * len(POINT_COLUMNS)
    if call.kind == "cloud" and numbers > limits.answer_numbers:
        raise TooLarge("numbers in the result (a grid has fewer)", numbers, limits.answer_numbers)
    if call.task is not None and len(set(call.task)) < len(call.task):
        raise InvalidField("task", "each direction may appear only once")
    chain = loaded.robot.chain(call.base_frame, call.tip_frame)
    for field in ("orientations", "orientations_over"):
        if call.kind != "dexterity" and field in call.model_fields_set:
            raise InvalidField(field, f"is only allowed with the kind `dexterity`; this one is `{call.kind}`")
    check_size(_question(loaded.record.name, loaded.robot, chain, call))
    whole = call.model_copy(update={"base_frame": chain.base_frame, "tip_frame": chain.tip_frame})
    return {CALL: whole.model_dump_json().encode()}


def _work(_: Limits, folder: Path) -> Work:
    text = robot_text(folder)
    robot = robot_of(text)
    call = read_json(WorkspaceRequest, read_plain(folder / CALL))
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


WORK = LongWork(_request, _work)
