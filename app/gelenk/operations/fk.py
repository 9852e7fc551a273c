"""Forward kinematics of a robot."""

from typing import TYPE_CHECKING, Any

from gelenk.contract.fk import ForwardRequest
from gelenk.kinematics.poses.forward import forward_kinematics
from gelenk.kinematics.poses.quick import poses_in, quick_pose
from gelenk.operations.chains import check_numbers, check_worked, head, positions
from gelenk.operations.outcome import Limits, Outcome
from gelenk.operations.pose_arrays import pose_array, pose_list
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot

if TYPE_CHECKING:
    from gelenk.course.steps import Step

_NUMBERS = 16
"""Most numbers of a pose."""
_QUICK = 100
"""Configurations that take the event loop less than about a millisecond; more go to a worker."""


def run(loaded: LoadedRobot, call: ForwardRequest, limits: Limits) -> Outcome:
    """Compute the pose of the tip, and of other requested frames, at each configuration."""
    robot, wanted, notation = loaded.robot, call.frames, call.pose_format
    chain = robot.chain(call.base_frame, call.tip_frame)
    if (outcome := _of_one(robot, chain, call, limits)) is not None:
        return outcome
    qs = positions(chain, call)
    frames = robot.frames_on(chain) if wanted == "all" else tuple(dict.fromkeys(wanted or ()))
    check_numbers(len(qs) * (1 + len(frames)) * _NUMBERS, limits)
    check_worked(call, len(qs))
    result = forward_kinematics(robot, chain, qs, frames)

    def content() -> dict[str, Any]:
        answer = head(chain)
        answer["poses"] = pose_list(result.poses, notation)
        if wanted is not None:
            lists = {name: pose_list(poses, notation) for name, poses in result.frames.items()}
            answer["frames"] = [{name: poses[row] for name, poses in lists.items()} for row in range(len(qs))]
        if call.steps:
            answer["steps"] = _worked(robot, chain, qs, notation)
        answer["certificate"] = result.certificate
        return answer

    fits = wanted is None and not call.steps
    return Outcome(content, (lambda: (pose_array(result.poses, notation), {})) if fits else None)


def _of_one(robot: RobotModel, chain: Chain, call: ForwardRequest, limits: Limits) -> Outcome | None:
    """Return the outcome of what most calls want: the pose of the tip at one list of numbers; None for all others."""
    given, notation = call.joint_positions, call.pose_format
    q = given[0] if type(given) is list and len(given) == 1 else None
    if not isinstance(q, list) or call.frames is not None or call.steps or call.respect_limits:
        return None
    if limits.answer_numbers < _NUMBERS or (found := quick_pose(robot, chain)(q)) is None:
        return None
    numbers, certificate = found

    def content() -> dict[str, Any]:
        answer = head(chain)
        if notation == "quaternion_xyzw":
            plain = numbers.tolist()
            answer["poses"] = [{"position": plain[:3], "quaternion_xyzw": plain[12:]}]
        else:
            answer["poses"] = pose_list(Poses(*poses_in(numbers)), notation)
        answer["certificate"] = certificate
        return answer

    return Outcome(content, lambda: (pose_array(Poses(*poses_in(numbers)), notation), {}))


def is_heavy(call: ForwardRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return call.frames is not None or call.steps or len(call.joint_positions) > _QUICK


def _worked(robot: RobotModel, chain: Chain, qs: Array, notation: str) -> "list[list[Step]]":
    from gelenk.dh.table_steps import forward_steps, placement_steps  # noqa: PLC0415 - for those who ask for steps
    from gelenk.dh.tables.from_chain import standard_table  # noqa: PLC0415

    table = standard_table(robot.description, chain)
    if table is None:
        return [placement_steps(chain.flat, q, notation) for q in qs]
    return [forward_steps(table, q, notation) for q in qs]
