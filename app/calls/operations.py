"""What the service can be asked, each described once for both clients.

The fields of a call are those of the request in the API's reference, by name; types come from the same models.
"""

import inspect
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Concatenate, Literal, ParamSpec, TypeVar
from urllib.parse import quote

import numpy as np
import orjson
from pydantic import BaseModel

from app.calls.call import ROBOT, Call, Reply, Sent, documented
from app.schemas.common import Answer, ChainEnds
from app.schemas.compare import CompareAnswer, CompareRequest
from app.schemas.course_components import (
    DcMotorAnswer,
    DcMotorRequest,
    GearAnswer,
    GearRequest,
    PwmAnswer,
    PwmRequest,
)
from app.schemas.course_encoder import EncoderAnswer, EncoderRequest
from app.schemas.course_fly_over import FlyOverAnswer, FlyOverRequest
from app.schemas.course_mobility import MobilityRequest
from app.schemas.course_mobility_answer import MobilityAnswer
from app.schemas.course_orientation import OrientationAnswer, OrientationRequest
from app.schemas.course_spline import SplineAnswer, SplineRequest
from app.schemas.course_time_law import TimeLawAnswer, TimeLawRequest
from app.schemas.course_time_scaling import TimeScalingAnswer, TimeScalingRequest
from app.schemas.course_workspace import PlanarWorkspaceAnswer, PlanarWorkspaceRequest
from app.schemas.derive import DeriveAnswer, DeriveRequest
from app.schemas.dh import (
    ConvertAnswer,
    ConvertRequest,
    FromUrdfAnswer,
    FromUrdfRequest,
    ToUrdfAnswer,
    ToUrdfRequest,
)
from app.schemas.dynamics import DynamicsAnswer, DynamicsRequest
from app.schemas.health import Health
from app.schemas.ik import InverseAnswer, InverseRequest
from app.schemas.jobs import JobInfo
from app.schemas.kinematics import ForwardAnswer, ForwardRequest, JacobianAnswer, JacobianRequest
from app.schemas.manipulability import ManipulabilityAnswer, ManipulabilityRequest
from app.schemas.robots import NewRobot, RobotInfo, RobotList, RobotReplacement
from app.schemas.singularity import SingularityAnswer, SingularityRequest
from app.schemas.statics import StaticsAnswer, StaticsRequest
from app.schemas.trajectory import TrajectoryRequest
from app.schemas.trajectory_answer import TrajectoryAnswer
from app.schemas.velocity import VelocityAnswer, VelocityRequest
from app.schemas.workspace import WorkspaceAnswer, WorkspaceRequest

P = ParamSpec("P")
A = TypeVar("A", bound=Answer)


def posted(path: str, fields: Mapping[str, Any], answer: type[A], **details: Any) -> Call[A]:
    """A call with JSON in both directions."""
    return Call("POST", path, reader(answer), body=encoded(fields), **details)


def encoded(fields: Mapping[str, Any]) -> bytes:
    """The fields of a request as JSON; arrays and models go as what they hold."""
    return orjson.dumps(dict(fields), option=orjson.OPT_SERIALIZE_NUMPY, default=_plain)


def _plain(value: Any) -> Any:
    if isinstance(value, BaseModel):
        return value.model_dump(exclude_unset=True)
    if isinstance(value, np.ndarray):  # one that orjson does not take: not contiguous, or of another type
        return value.tolist()
    raise TypeError(f"a {type(value).__name__} cannot be sent as JSON")


def reader(answer: type[A]) -> Callable[[Reply], A]:
    """How an answer is read; what a newer service tells beside it is left out."""
    return lambda reply: answer.model_validate_json(reply.body, extra="ignore")


def segment(name: str) -> str:
    """A name as a part of a path."""
    return quote(name, safe="")


def _operation(name: str, request: Callable[P, BaseModel], answer: type[A]) -> Sent[Concatenate[str, P], A]:
    """`POST /v1/robots/{robot}/{name}`."""

    def describe(robot: str, /, *_: P.args, **fields: P.kwargs) -> Call[A]:
        return posted(f"v1/robots/{segment(robot)}/{name}", fields, answer)

    return Sent(_documented(describe, request, answer, ROBOT))


def _calculator(path: str, request: Callable[P, BaseModel], answer: type[A]) -> Sent[P, A]:
    """A call that is about no robot in particular."""

    def describe(*_: P.args, **fields: P.kwargs) -> Call[A]:
        return posted(f"v1/{path}", fields, answer)

    return Sent(_documented(describe, request, answer))


def _documented(
    describe: Callable[P, Call[A]], request: Callable[..., BaseModel], answer: type[A], *before: inspect.Parameter
) -> Callable[P, Call[A]]:
    sentences = f"{inspect.getdoc(request)}\n\nReturns:\n    {answer.__name__}: {inspect.getdoc(answer)}"
    return documented(describe, request, sentences, *before)


def _robots() -> Call[RobotList]:
    """All robots: those of the catalogue, and those that were uploaded."""
    return Call("GET", "v1/robots", reader(RobotList))


def _robot(robot: str) -> Call[RobotInfo]:
    """A robot's joints, links, limits, licence and warnings."""
    return Call("GET", f"v1/robots/{segment(robot)}", reader(RobotInfo))


def _urdf(robot: str) -> Call[str]:
    """A robot as URDF."""
    return Call("GET", f"v1/robots/{segment(robot)}/urdf", lambda reply: reply.body.decode(), accept="application/xml")


def _table(
    robot: str,
    convention: Literal["standard", "modified"] = "standard",
    base_frame: str | None = None,
    tip_frame: str | None = None,
    snap_tolerance: float | None = None,
) -> Call[FromUrdfAnswer]:
    """A chain of a robot as a Denavit-Hartenberg table, with its certificate.

    Args:
        robot: Its name.
        convention: Of the table.
        base_frame: Of the chain; the default chain's if left out.
        tip_frame: Of the chain; the default chain's if left out.
        snap_tolerance: How far a number may be moved to one that a person would write; not at all if left out.
    """
    chosen = {"base_frame": base_frame, "tip_frame": tip_frame, "snap_tolerance": snap_tolerance}
    query = {"convention": convention, **{name: value for name, value in chosen.items() if value is not None}}
    return Call("GET", f"v1/robots/{segment(robot)}/dh", reader(FromUrdfAnswer), query)


def _mesh(robot: str, path: str) -> Call[bytes]:
    """A mesh that a robot's URDF names; `meshes` of `robot` lists their paths."""
    return Call("GET", f"v1/robots/{segment(robot)}/meshes/{quote(path)}", lambda reply: reply.body, accept="*/*")


def _adding(request: Callable[P, NewRobot]) -> Callable[P, Call[RobotInfo]]:
    def describe(*_: P.args, **fields: P.kwargs) -> Call[RobotInfo]:
        return posted("v1/robots", fields, RobotInfo)  # the same bytes under the same name change nothing

    return _documented(describe, request, RobotInfo)


def _replacing(request: Callable[P, RobotReplacement]) -> Callable[Concatenate[str, P], Call[RobotInfo]]:
    def describe(robot: str, /, *_: P.args, **fields: P.kwargs) -> Call[RobotInfo]:
        return Call("PUT", f"v1/robots/{segment(robot)}", reader(RobotInfo), body=encoded(fields))

    return _documented(describe, request, RobotInfo, ROBOT)


def _add_archive(
    name: str, archive: bytes | Path, description: str = "", default_chain: ChainEnds | None = None
) -> Call[RobotInfo]:
    """Add a robot with its meshes: a zip of one URDF and the files that it names."""
    fields = _archive_fields(description, default_chain, name=name)
    return Call("POST", "v1/robots", reader(RobotInfo), form=fields, files={"archive": content_of(archive)})


def _replace_archive(
    robot: str, archive: bytes | Path, description: str = "", default_chain: ChainEnds | None = None
) -> Call[RobotInfo]:
    """Replace an uploaded robot by a zip of one URDF and the files that it names."""
    fields, path = _archive_fields(description, default_chain), f"v1/robots/{segment(robot)}"
    return Call("PUT", path, reader(RobotInfo), form=fields, files={"archive": content_of(archive)})


def _archive_fields(description: str, chain: ChainEnds | None, **further: str) -> dict[str, str]:
    ends = {} if chain is None else {"base_frame": chain.base_frame, "tip_frame": chain.tip_frame}
    return {**further, "description": description, **ends}


def content_of(file: bytes | Path) -> bytes:
    """The bytes of a file that is given as such or by its path."""
    return file.read_bytes() if isinstance(file, Path) else file


def _remove(robot: str) -> Call[None]:
    """Remove an uploaded robot."""
    return Call("DELETE", f"v1/robots/{segment(robot)}", lambda _: None, is_repeatable=False)


def _workspace(request: Callable[P, BaseModel]) -> Callable[Concatenate[str, P], Call[JobInfo]]:
    def describe(robot: str, /, *_: P.args, **fields: P.kwargs) -> Call[JobInfo]:
        # Under a name of its own the same call finds the same job.
        is_named = fields.get("job_id") is not None
        return posted(f"v1/robots/{segment(robot)}/workspace", fields, JobInfo, is_repeatable=is_named)

    return _documented(describe, request, JobInfo, ROBOT)


def _job(job: str) -> Call[JobInfo]:
    """How far a job is."""
    return Call("GET", f"v1/jobs/{segment(job)}", reader(JobInfo))


def _cancel(job: str) -> Call[JobInfo]:
    """Cancel a job, or remove one that has come to its end."""
    return Call("DELETE", f"v1/jobs/{segment(job)}", reader(JobInfo), is_repeatable=False)


def _result(answer: type[A]) -> Callable[[str], Call[A]]:
    def describe(job: str) -> Call[A]:
        """What came out of a job of this kind."""
        return Call("GET", f"v1/jobs/{segment(job)}/result", reader(answer))

    return describe


def _picture(path: str, kind: Literal["svg", "png"], fields: Mapping[str, Any] | None = None) -> Call[bytes]:
    """An answer as a picture, where there is one.

    Args:
        path: Of the operation or of a job's result, such as `v1/robots/panda/trajectory`.
        kind: Of picture.
        fields: Of the request; None where there is none.
    """
    method, body = ("GET", b"") if fields is None else ("POST", encoded(fields))
    return Call(method, path, lambda reply: reply.body, body=body, accept=_PICTURES[kind])


def _health() -> Call[Health]:
    """Whether the process lives."""
    return Call("GET", "healthz", reader(Health))


def _readiness() -> Call[Health]:
    """Whether the service is ready for work; one that is not is asked a few times, then it is an error."""
    return Call("GET", "readyz", reader(Health))


def _metrics() -> Call[str]:
    """What the service does, in numbers: Prometheus's text format."""
    return Call("GET", "metrics", lambda reply: reply.body.decode(), accept="text/plain")


_PICTURES = {"svg": "image/svg+xml", "png": "image/png"}


class Operations:
    """The calls of the service as methods."""

    robots = Sent(_robots)
    robot = Sent(_robot)
    urdf = Sent(_urdf)
    dh_table = Sent(_table)
    mesh = Sent(_mesh)
    add_robot = Sent(_adding(NewRobot))
    add_archive = Sent(_add_archive)
    replace_robot = Sent(_replacing(RobotReplacement))
    replace_archive = Sent(_replace_archive)
    remove_robot = Sent(_remove)

    fk = _operation("fk", ForwardRequest, ForwardAnswer)
    jacobian = _operation("jacobian", JacobianRequest, JacobianAnswer)
    ik = _operation("ik", InverseRequest, InverseAnswer)
    velocity = _operation("velocity", VelocityRequest, VelocityAnswer)
    statics = _operation("statics", StaticsRequest, StaticsAnswer)
    dynamics = _operation("dynamics", DynamicsRequest, DynamicsAnswer)
    manipulability = _operation("manipulability", ManipulabilityRequest, ManipulabilityAnswer)
    singularities = _operation("singularities", SingularityRequest, SingularityAnswer)
    trajectory = _operation("trajectory", TrajectoryRequest, TrajectoryAnswer)

    workspace = Sent(_workspace(WorkspaceRequest))
    workspace_result = Sent(_result(WorkspaceAnswer))
    ik_result = Sent(_result(InverseAnswer))
    trajectory_result = Sent(_result(TrajectoryAnswer))
    job = Sent(_job)
    cancel_job = Sent(_cancel)
    picture = Sent(_picture)

    health = Sent(_health)
    readiness = Sent(_readiness)
    metrics = Sent(_metrics)

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
