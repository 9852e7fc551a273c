"""Calls on stored robots and jobs, and on the service itself."""

from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any, Concatenate, Literal, ParamSpec, TypeVar
from urllib.parse import quote

from pydantic import BaseModel

from gelenk.client.call import ROBOT, Call
from gelenk.client.exchange import described_by, encoded, posted, reader, segment
from gelenk.contract.common import Answer, ChainEnds
from gelenk.contract.dh_from_urdf import FromUrdfAnswer
from gelenk.contract.health import Health
from gelenk.contract.jobs import Finished, JobInfo
from gelenk.contract.robots import NewRobot, RobotInfo, RobotList, RobotReplacement

P = ParamSpec("P")
A = TypeVar("A", bound=Answer)


def robots() -> Call[RobotList]:
    """All robots: those of the catalogue, and those that were uploaded."""
    return Call("GET", "v1/robots", reader(RobotList))


def robot(robot: str) -> Call[RobotInfo]:
    """A robot's joints, links, limits, licence and warnings."""
    return Call("GET", f"v1/robots/{segment(robot)}", reader(RobotInfo))


def urdf(robot: str) -> Call[str]:
    """A robot as URDF."""
    return Call("GET", f"v1/robots/{segment(robot)}/urdf", lambda reply: reply.body.decode(), accept="application/xml")


def table(
    robot: str,
    convention: Literal["standard", "modified"] = "standard",
    base_frame: str | None = None,
    tip_frame: str | None = None,
    snap_tolerance: float | None = None,
) -> Call[FromUrdfAnswer]:
    """A chain of a robot as a Denavit-Hartenberg table, with its certificate.

    Args:
        robot: Name of the robot.
        convention: Convention of the table.
        base_frame: Base of the chain; the default chain's if left out.
        tip_frame: Tip of the chain; the default chain's if left out.
        snap_tolerance: Tolerance within which numbers are rounded to plain ones, [rad or m]; no rounding if left out.
    """
    chosen = {"base_frame": base_frame, "tip_frame": tip_frame, "snap_tolerance": snap_tolerance}
    query = {"convention": convention, **{name: value for name, value in chosen.items() if value is not None}}
    return Call("GET", f"v1/robots/{segment(robot)}/dh", reader(FromUrdfAnswer), query)


def mesh(robot: str, path: str) -> Call[bytes]:
    """A mesh that a robot's URDF names; `meshes` of `robot` lists their paths."""
    return Call("GET", f"v1/robots/{segment(robot)}/meshes/{quote(path)}", lambda reply: reply.body, accept="*/*")


def adding(request: Callable[P, NewRobot]) -> Callable[P, Call[RobotInfo]]:
    """Define the call that adds a robot, with the fields of this model."""

    def describe(*_: P.args, **fields: P.kwargs) -> Call[RobotInfo]:
        return posted("v1/robots", fields, RobotInfo)  # the same bytes under the same name change nothing

    return described_by(describe, request, RobotInfo)


def replacing(request: Callable[P, RobotReplacement]) -> Callable[Concatenate[str, P], Call[RobotInfo]]:
    """Define the call that replaces a robot, with the fields of this model."""

    def describe(robot: str, /, *_: P.args, **fields: P.kwargs) -> Call[RobotInfo]:
        return Call("PUT", f"v1/robots/{segment(robot)}", reader(RobotInfo), body=encoded(fields))

    return described_by(describe, request, RobotInfo, ROBOT)


def add_archive(
    name: str,
    archive: bytes | str | PathLike[str],
    description: str = "",
    default_chain: ChainEnds | None = None,
    strict: bool = False,
) -> Call[RobotInfo]:
    """Add a robot with its meshes: a zip of one URDF and the files that it names."""
    fields = _archive_fields(description, default_chain, strict, name=name)
    return Call("POST", "v1/robots", reader(RobotInfo), form=fields, files={"archive": content_of(archive)})


def replace_archive(
    robot: str,
    archive: bytes | str | PathLike[str],
    description: str = "",
    default_chain: ChainEnds | None = None,
    strict: bool = False,
) -> Call[RobotInfo]:
    """Replace an uploaded robot by a zip of one URDF and the files that it names."""
    fields, path = _archive_fields(description, default_chain, strict), f"v1/robots/{segment(robot)}"
    return Call("PUT", path, reader(RobotInfo), form=fields, files={"archive": content_of(archive)})


def _archive_fields(description: str, chain: ChainEnds | None, strict: bool, **further: str) -> dict[str, str]:
    ends = {} if chain is None else {"base_frame": chain.base_frame, "tip_frame": chain.tip_frame}
    return {**further, "description": description, **ends, **({"strict": "true"} if strict else {})}


def content_of(file: bytes | str | PathLike[str]) -> bytes:
    """Return the bytes of a file, given as such or by its path."""
    return file if isinstance(file, bytes) else Path(file).read_bytes()


def remove(robot: str) -> Call[None]:
    """Remove an uploaded robot."""
    return Call("DELETE", f"v1/robots/{segment(robot)}", lambda _: None, is_repeatable=False)


def beginning(request: Callable[P, BaseModel]) -> Callable[Concatenate[str, P], Call[JobInfo]]:
    """Define the call that starts the workspace job of a robot, with the fields of this model."""

    def describe(robot: str, /, *_: P.args, **fields: P.kwargs) -> Call[JobInfo]:
        # With a `job_id`, the same call finds the same job.
        is_named = fields.get("job_id") is not None
        return posted(f"v1/robots/{segment(robot)}/workspace", fields, JobInfo, is_repeatable=is_named)

    return described_by(describe, request, JobInfo, ROBOT)


def job(job: str) -> Call[JobInfo]:
    """State and progress of a job."""
    return Call("GET", f"v1/jobs/{segment(job)}", reader(JobInfo))


def cancel(job: str, finished: Finished = "keep") -> Call[JobInfo]:
    """Cancel a job; a finished one is refused, or with `finished="remove"` removed."""
    query = {} if finished == "keep" else {"finished": finished}
    return Call("DELETE", f"v1/jobs/{segment(job)}", reader(JobInfo), query, is_repeatable=False)


def result(answer: type[A]) -> Callable[[str], Call[A]]:
    """Define the call that gets the result of a job, with answers of this model."""

    def describe(job: str) -> Call[A]:
        """Result of a job of this kind."""
        return Call("GET", f"v1/jobs/{segment(job)}/result", reader(answer))

    return describe


def picture(path: str, kind: Literal["svg", "png"], fields: Mapping[str, Any] | None = None) -> Call[bytes]:
    """An answer as a picture, if the operation draws one.

    Args:
        path: Path of the operation or of a job's result, such as `v1/robots/panda/trajectory`.
        kind: Format of the picture.
        fields: Fields of the request; None for a job's result.
    """
    method, body = ("GET", b"") if fields is None else ("POST", encoded(fields))
    return Call(method, path, lambda reply: reply.body, body=body, accept=_PICTURES[kind])


def health() -> Call[Health]:
    """Whether the process is alive."""
    return Call("GET", "healthz", reader(Health))


def readiness() -> Call[Health]:
    """Whether the service is ready for work; retried a few times before it is an error."""
    return Call("GET", "readyz", reader(Health))


def metrics() -> Call[str]:
    """Metrics of the service, in Prometheus's text format."""
    return Call("GET", "metrics", lambda reply: reply.body.decode(), accept="text/plain")


_PICTURES = {"svg": "image/svg+xml", "png": "image/png"}
