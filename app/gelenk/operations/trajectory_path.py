"""Converts the path of a tool, which may stand in place of the segments of a trajectory, for the core."""

from dataclasses import replace

import numpy as np

from gelenk.contract.trajectory_request import ToolPath, TrajectoryRequest
from gelenk.errors import InvalidField
from gelenk.operations.pose_arrays import poses_from
from gelenk.trajectory.problem.problem import FreeTool, Segment

_AXES = ("rx", "ry", "rz")
_NOT_BESIDE = (
    "segments",
    "at",
    "start_velocities",
    "start_accelerations",
    "end_velocities",
    "end_accelerations",
    "task",
)


def refuse_beside(call: TrajectoryRequest) -> None:
    """Refuse a motion with neither segments nor a path, and what is not allowed beside a path; `InvalidField`."""
    if call.path is None:
        if call.segments is None:
            raise InvalidField("segments", "is missing: give a list of at least one segment, or the `path` of a tool")
        return
    for name in _NOT_BESIDE:
        if getattr(call, name) is not None:
            raise InvalidField(name, "is not allowed beside `path`, which leads from rest to rest along its own poses")
    if call.near_singularity == "damp":
        raise InvalidField("near_singularity", "`damp` leaves the path; with `path` it is `stop` or `slow_down`")


def tool_segments(call: TrajectoryRequest, path: ToolPath, part: Segment) -> tuple[Segment, ...]:
    """Return a spline through the poses, with the options of `part`, and a motion of the joints before it."""
    along = replace(part, poses=poses_from(path.poses, "path.poses"))
    return (along,) if call.start is None else (replace(part, type="joint"), along)


def free_tool(path: ToolPath) -> FreeTool:
    """Return the axis about which the tool may turn; zero if there is none."""
    return FreeTool(np.array([float(name in path.free) for name in _AXES]), path.steps)
