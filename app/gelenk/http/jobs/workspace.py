"""The numeric workspace of a robot, as a job."""

from functools import partial
from pathlib import Path

from gelenk.contract.workspace import WorkspaceRequest
from gelenk.errors import InvalidField, TooLarge
from gelenk.http.jobs.long_work import CALL, LongWork
from gelenk.http.messages.payloads import read_json
from gelenk.jobs.robot_files import robot_of, robot_text
from gelenk.jobs.runner import Work
from gelenk.jobs.workspace import work_of
from gelenk.jobs.workspace_request import WorkspaceWork, check_size, workspace_work
from gelenk.kinematics.workspace.survey import POINT_COLUMNS
from gelenk.operations.cells import IN_BODIES, CellBodies, cell_bodies, read_cell_bodies
from gelenk.operations.outcome import Limits
from gelenk.robot.robot import RobotModel
from gelenk.store.folders import read_plain
from gelenk.store.records import LoadedRobot

_CELL = "cell.json"
"""File of a request that holds the bodies of the robot and around it, if contacts matter."""


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
    bodies = cell_bodies(loaded, call)
    check_size(_planned(loaded.record.name, loaded.robot, call, bodies))
    ends = {"base_frame": chain.base_frame, "tip_frame": chain.tip_frame}
    files = {CALL: call.model_copy(update={**ends, **IN_BODIES}).model_dump_json().encode()}
    return files if bodies is None else {**files, _CELL: bodies.to_bytes()}


def _planned(name: str, robot: RobotModel, call: WorkspaceRequest, bodies: CellBodies | None) -> WorkspaceWork:
    if bodies is None:
        return workspace_work(name, robot, call)
    return workspace_work(name, robot, call, partial(bodies.cell, min_clearance=call.min_clearance), bodies.warnings)


def _work(_: Limits, folder: Path) -> Work:
    text = robot_text(folder)
    call = read_json(WorkspaceRequest, read_plain(folder / CALL))
    bodies = read_cell_bodies(read_plain(folder / _CELL)) if (folder / _CELL).exists() else None
    return work_of(_planned(text.name, robot_of(text), call, bodies))


WORK = LongWork(_request, _work)
