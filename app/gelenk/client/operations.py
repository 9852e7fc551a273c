"""The operations of the service, each described once for both clients.

The fields of a call are those of the request in the API's reference, by name; types come from the same models.
"""

import inspect
from collections.abc import Callable
from typing import Any, Concatenate, ParamSpec, TypeVar

import numpy as np
from pydantic import BaseModel

from gelenk.client import stored
from gelenk.client.call import EXERCISE, NPY, ROBOT, Call, Sent, documented
from gelenk.client.exchange import described_by, encoded, fits_query, json_call, packed, query_of, reader, segment
from gelenk.contract import (
    collisions,
    compare_dh,
    convert_dh,
    dc_motor,
    derive_dh,
    dh_from_urdf,
    dh_picture,
    dh_to_urdf,
    dynamics,
    encoder,
    fk,
    fly_over,
    gear,
    ik,
    jacobian,
    line,
    manipulability,
    mobility,
    orientation,
    pipeline,
    planar_workspace,
    pulse_width_modulation,
    singularities,
    spline,
    statics,
    time_law,
    time_scaling,
    trajectories,
    trajectory,
    triangle,
    velocity,
)
from gelenk.contract.collision_pairs import CollisionPairs, PairChoices
from gelenk.contract.common import Answer
from gelenk.contract.endpoint import Endpoint, RobotEndpoint
from gelenk.contract.endpoints import ENDPOINTS
from gelenk.contract.exercises import (
    ExerciseGrade,
    ExerciseGradeRequest,
    ExerciseRequest,
    ExerciseSolution,
    ExerciseVariant,
)
from gelenk.contract.ik import InverseAnswer
from gelenk.contract.jobs import JobInfo
from gelenk.contract.pose import pose_fields
from gelenk.contract.robots import NewRobot, RobotInfo, RobotReplacement
from gelenk.contract.sheets import SheetsGradeRequest, SheetsRequest
from gelenk.contract.trajectories import MotionsAnswer
from gelenk.contract.trajectory_answer import TrajectoryAnswer
from gelenk.contract.workspace import WorkspaceAnswer, WorkspaceRequest

P = ParamSpec("P")
A = TypeVar("A", bound=Answer)


def _about_robot(
    path: str, request: Callable[P, BaseModel], answer: type[A], method: str = "POST"
) -> Sent[Concatenate[str, P], A]:
    """Define a call on a robot; one that starts a job finds it again only by a `job_id`."""

    def describe(robot: str, /, *_: P.args, **fields: P.kwargs) -> Call[A]:
        is_repeatable = answer is not JobInfo or fields.get("job_id") is not None
        return json_call(method, path.format(robot=segment(robot)), fields, answer, is_repeatable=is_repeatable)

    return Sent(described_by(describe, request, answer, ROBOT))


def _operation(endpoint: RobotEndpoint[P, A]) -> Sent[Concatenate[str, P], A]:
    """Define an operation on a robot; an array batch is sent as npy if all other fields fit into the query."""

    def describe(robot: str, /, *_: P.args, **fields: P.kwargs) -> Call[A]:
        path, batch = endpoint.path.format(robot=segment(robot)), endpoint.batch
        array, rest = fields.get(batch), {field: value for field, value in fields.items() if field != batch}
        if isinstance(array, np.ndarray) and not endpoint.npy_holds_more and fits_query(rest):
            return Call("POST", path, reader(endpoint.answer), query_of(rest), packed(array), NPY)
        if isinstance(array, np.ndarray) and endpoint is ik.ENDPOINT:
            return json_call("POST", path, {**rest, batch: pose_fields(array)}, endpoint.answer)
        return json_call("POST", path, fields, endpoint.answer)

    return Sent(described_by(describe, endpoint.request, endpoint.answer, ROBOT))


def _about_exercise(path: str, request: Callable[P, BaseModel], answer: type[A]) -> Sent[Concatenate[str, P], A]:
    def describe(exercise: str, *_: P.args, **fields: P.kwargs) -> Call[A]:
        return json_call("POST", path.format(exercise=segment(exercise)), fields, answer)

    return Sent(described_by(describe, request, answer, EXERCISE))


def _without_robot(path: str, request: Callable[P, BaseModel], answer: type[A]) -> Sent[P, A]:
    def describe(*_: P.args, **fields: P.kwargs) -> Call[A]:
        return json_call("POST", path, fields, answer)

    return Sent(described_by(describe, request, answer))


def _file(path: str, request: Callable[P, BaseModel], returned: str) -> Sent[P, bytes]:
    """Define a call that is answered by a file."""

    def describe(*_: P.args, **fields: P.kwargs) -> Call[bytes]:
        return Call("POST", path, lambda response: response.content, body=encoded(fields), accept="*/*")

    return Sent(documented(describe, request, f"{inspect.getdoc(request)}\n\nReturns:\n    {returned}"))


def _calculator(endpoint: Endpoint[P, A]) -> Sent[P, A]:
    return _without_robot(endpoint.path, endpoint.request, endpoint.answer)


class Operations:
    """The calls of the service as methods."""

    robots = Sent(stored.robots)
    robot = Sent(stored.robot)
    urdf = Sent(stored.urdf)
    mjcf = Sent(stored.mjcf)
    dh_table = Sent(stored.table)
    dh_file = Sent(stored.table_file)
    screws = Sent(stored.screws)
    mesh = Sent(stored.mesh)
    add_robot = _without_robot("v1/robots", NewRobot, RobotInfo)
    add_archive = Sent(stored.add_archive)
    replace_robot = _about_robot("v1/robots/{robot}", RobotReplacement, RobotInfo, "PUT")
    replace_archive = Sent(stored.replace_archive)
    remove_robot = Sent(stored.remove)
    collision_bodies = Sent(stored.collision_bodies)
    collision_pairs = Sent(stored.collision_pairs)
    choose_collision_pairs = _about_robot("v1/robots/{robot}/collision-pairs", PairChoices, CollisionPairs, "PUT")

    scenes = Sent(stored.scenes)
    scene = Sent(stored.scene)
    scene_file = Sent(stored.scene_file)
    add_scene = Sent(stored.add_scene)
    add_scene_files = Sent(stored.add_scene_files)
    replace_scene = Sent(stored.replace_scene)
    replace_scene_files = Sent(stored.replace_scene_files)
    remove_scene = Sent(stored.remove_scene)

    fk = _operation(fk.ENDPOINT)
    jacobian = _operation(jacobian.ENDPOINT)
    ik = _operation(ik.ENDPOINT)
    velocity = _operation(velocity.ENDPOINT)
    statics = _operation(statics.ENDPOINT)
    dynamics = _operation(dynamics.ENDPOINT)
    manipulability = _operation(manipulability.ENDPOINT)
    singularities = _operation(singularities.ENDPOINT)
    trajectory = _operation(trajectory.ENDPOINT)
    trajectories = _operation(trajectories.ENDPOINT)
    collisions = _operation(collisions.ENDPOINT)

    workspace = _about_robot("v1/robots/{robot}/workspace", WorkspaceRequest, JobInfo)
    workspace_result = Sent(stored.result(WorkspaceAnswer))
    ik_result = Sent(stored.result(InverseAnswer))
    trajectory_result = Sent(stored.result(TrajectoryAnswer))
    trajectories_result = Sent(stored.result(MotionsAnswer))
    list_jobs = Sent(stored.list_jobs)
    job = Sent(stored.job)
    cancel_job = Sent(stored.cancel)
    picture = Sent(stored.picture)
    course_pictures = Sent(stored.course_pictures)
    dh_parameters = Sent(stored.dh_parameters)
    course_picture = Sent(stored.course_picture)

    exercises = Sent(stored.exercises)
    draw_exercise = _about_exercise("v1/course/exercises/{exercise}", ExerciseRequest, ExerciseVariant)
    solve_exercise = _about_exercise("v1/course/exercises/{exercise}/solution", ExerciseRequest, ExerciseSolution)
    write_sheets = _file("v1/course/sheets", SheetsRequest, "The sheets as an HTML page; `picture` gets other forms.")
    grade_sheets = _file("v1/course/sheets/grade", SheetsGradeRequest, "Points and mistakes as CSV.")
    grade_exercise = _about_exercise("v1/course/exercises/{exercise}/grade", ExerciseGradeRequest, ExerciseGrade)

    health = Sent(stored.health)
    readiness = Sent(stored.readiness)
    metrics = Sent(stored.metrics)

    dh_to_urdf = _calculator(dh_to_urdf.ENDPOINT)
    dh_from_urdf = _calculator(dh_from_urdf.ENDPOINT)
    convert_dh = _calculator(convert_dh.ENDPOINT)
    compare_dh = _calculator(compare_dh.ENDPOINT)
    dh_picture = _calculator(dh_picture.ENDPOINT)
    derive_dh = _calculator(derive_dh.ENDPOINT)

    dc_motor = _calculator(dc_motor.ENDPOINT)
    gear = _calculator(gear.ENDPOINT)
    pulse_width_modulation = _calculator(pulse_width_modulation.ENDPOINT)
    encoder = _calculator(encoder.ENDPOINT)
    planar_workspace = _calculator(planar_workspace.ENDPOINT)
    fly_over = _calculator(fly_over.ENDPOINT)
    mobility = _calculator(mobility.ENDPOINT)
    orientation = _calculator(orientation.ENDPOINT)
    line = _calculator(line.ENDPOINT)
    pipeline = _calculator(pipeline.ENDPOINT)
    time_law = _calculator(time_law.ENDPOINT)
    spline = _calculator(spline.ENDPOINT)
    time_scaling = _calculator(time_scaling.ENDPOINT)
    triangle = _calculator(triangle.ENDPOINT)


# The lines above only give methods their types: an operation without one becomes a method all the same.
for _endpoint in ENDPOINTS:
    if not hasattr(Operations, _endpoint.name):
        _method: Any = _operation(_endpoint) if isinstance(_endpoint, RobotEndpoint) else _calculator(_endpoint)
        _method.__set_name__(Operations, _endpoint.name)
        setattr(Operations, _endpoint.name, _method)
