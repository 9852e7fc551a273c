"""The operations of the service, each described once for both clients.

The fields of a call are those of the request in the API's reference, by name; types come from the same models.
"""

from collections.abc import Callable
from typing import Concatenate, ParamSpec, TypeVar

import numpy as np
from pydantic import BaseModel

from gelenk.calls import kept
from gelenk.calls.call import NPY, ROBOT, Call, Sent
from gelenk.calls.exchange import described_by, posted, reader, segment
from gelenk.calls.npy import fits_query, packed, query_of
from gelenk.contract.common import Answer
from gelenk.contract.compare import CompareAnswer, CompareRequest
from gelenk.contract.course_components import (
    DcMotorAnswer,
    DcMotorRequest,
    GearAnswer,
    GearRequest,
    PwmAnswer,
    PwmRequest,
)
from gelenk.contract.course_encoder import EncoderAnswer, EncoderRequest
from gelenk.contract.course_fly_over import FlyOverAnswer, FlyOverRequest
from gelenk.contract.course_mobility import MobilityRequest
from gelenk.contract.course_mobility_answer import MobilityAnswer
from gelenk.contract.course_orientation import OrientationAnswer, OrientationRequest
from gelenk.contract.course_spline import SplineAnswer, SplineRequest
from gelenk.contract.course_time_law import TimeLawAnswer, TimeLawRequest
from gelenk.contract.course_time_scaling import TimeScalingAnswer, TimeScalingRequest
from gelenk.contract.course_workspace import PlanarWorkspaceAnswer, PlanarWorkspaceRequest
from gelenk.contract.derive import DeriveAnswer, DeriveRequest
from gelenk.contract.dh import (
    ConvertAnswer,
    ConvertRequest,
    FromUrdfAnswer,
    FromUrdfRequest,
    ToUrdfAnswer,
    ToUrdfRequest,
)
from gelenk.contract.dynamics import DynamicsAnswer, DynamicsRequest
from gelenk.contract.ik import InverseAnswer, InverseRequest
from gelenk.contract.kinematics import ForwardAnswer, ForwardRequest, JacobianAnswer, JacobianRequest
from gelenk.contract.manipulability import ManipulabilityAnswer, ManipulabilityRequest
from gelenk.contract.pose import pose_fields
from gelenk.contract.robots import NewRobot, RobotReplacement
from gelenk.contract.singularity import SingularityAnswer, SingularityRequest
from gelenk.contract.statics import StaticsAnswer, StaticsRequest
from gelenk.contract.trajectory import TrajectoryRequest
from gelenk.contract.trajectory_answer import TrajectoryAnswer
from gelenk.contract.velocity import VelocityAnswer, VelocityRequest
from gelenk.contract.workspace import WorkspaceAnswer, WorkspaceRequest

P = ParamSpec("P")
A = TypeVar("A", bound=Answer)


def _operation(
    name: str, request: Callable[P, BaseModel], answer: type[A], batch: str = ""
) -> Sent[Concatenate[str, P], A]:
    """`POST /v1/robots/{robot}/{name}`.

    Args:
        name: The operation's.
        request: Its model.
        answer: Its model.
        batch: The field that goes as npy where it is an array, and all other fields fit into the query.
    """

    def describe(robot: str, /, *_: P.args, **fields: P.kwargs) -> Call[A]:
        path = f"v1/robots/{segment(robot)}/{name}"
        array, rest = fields.get(batch), {field: value for field, value in fields.items() if field != batch}
        if isinstance(array, np.ndarray) and fits_query(rest):
            return Call("POST", path, reader(answer), query_of(rest), packed(array), NPY)
        if isinstance(array, np.ndarray) and batch == "targets":
            return posted(path, {**rest, batch: pose_fields(array)}, answer)
        return posted(path, fields, answer)

    return Sent(described_by(describe, request, answer, ROBOT))


def _calculator(path: str, request: Callable[P, BaseModel], answer: type[A]) -> Sent[P, A]:
    """A call that is about no robot in particular."""

    def describe(*_: P.args, **fields: P.kwargs) -> Call[A]:
        return posted(f"v1/{path}", fields, answer)

    return Sent(described_by(describe, request, answer))


class Operations:
    """The calls of the service as methods."""

    robots = Sent(kept.robots)
    robot = Sent(kept.robot)
    urdf = Sent(kept.urdf)
    dh_table = Sent(kept.table)
    mesh = Sent(kept.mesh)
    add_robot = Sent(kept.adding(NewRobot))
    add_archive = Sent(kept.add_archive)
    replace_robot = Sent(kept.replacing(RobotReplacement))
    replace_archive = Sent(kept.replace_archive)
    remove_robot = Sent(kept.remove)

    fk = _operation("fk", ForwardRequest, ForwardAnswer, "joint_positions")
    jacobian = _operation("jacobian", JacobianRequest, JacobianAnswer, "joint_positions")
    ik = _operation("ik", InverseRequest, InverseAnswer, "targets")
    velocity = _operation("velocity", VelocityRequest, VelocityAnswer)
    statics = _operation("statics", StaticsRequest, StaticsAnswer, "joint_positions")
    dynamics = _operation("dynamics", DynamicsRequest, DynamicsAnswer, "joint_positions")
    manipulability = _operation("manipulability", ManipulabilityRequest, ManipulabilityAnswer, "joint_positions")
    singularities = _operation("singularities", SingularityRequest, SingularityAnswer, "joint_positions")
    trajectory = _operation("trajectory", TrajectoryRequest, TrajectoryAnswer)

    workspace = Sent(kept.beginning(WorkspaceRequest))
    workspace_result = Sent(kept.result(WorkspaceAnswer))
    ik_result = Sent(kept.result(InverseAnswer))
    trajectory_result = Sent(kept.result(TrajectoryAnswer))
    job = Sent(kept.job)
    cancel_job = Sent(kept.cancel)
    picture = Sent(kept.picture)

    health = Sent(kept.health)
    readiness = Sent(kept.readiness)
    metrics = Sent(kept.metrics)

    dh_to_urdf = _calculator("dh/to-urdf", ToUrdfRequest, ToUrdfAnswer)
    dh_from_urdf = _calculator("dh/from-urdf", FromUrdfRequest, FromUrdfAnswer)
    convert_dh = _calculator("dh/convert", ConvertRequest, ConvertAnswer)
    compare_dh = _calculator("dh/compare", CompareRequest, CompareAnswer)
    derive_dh = _calculator("dh/derive", DeriveRequest, DeriveAnswer)

    dc_motor = _calculator("course/dc-motor", DcMotorRequest, DcMotorAnswer)
    gear = _calculator("course/gear", GearRequest, GearAnswer)
    pulse_width_modulation = _calculator("course/pwm", PwmRequest, PwmAnswer)
    encoder = _calculator("course/encoder", EncoderRequest, EncoderAnswer)
    planar_workspace = _calculator("course/workspace", PlanarWorkspaceRequest, PlanarWorkspaceAnswer)
    fly_over = _calculator("course/fly-over", FlyOverRequest, FlyOverAnswer)
    mobility = _calculator("course/mobility", MobilityRequest, MobilityAnswer)
    orientation = _calculator("course/orientation", OrientationRequest, OrientationAnswer)
    time_law = _calculator("course/time-law", TimeLawRequest, TimeLawAnswer)
    spline = _calculator("course/spline", SplineRequest, SplineAnswer)
    time_scaling = _calculator("course/time-scaling", TimeScalingRequest, TimeScalingAnswer)
