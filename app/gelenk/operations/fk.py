"""Forward kinematics of a robot."""

from typing import Any

from gelenk.contract.fk import ForwardRequest
from gelenk.course.steps import Step
from gelenk.dh.table_steps import forward_steps, placement_steps
from gelenk.dh.tables.from_chain import standard_table
from gelenk.kinematics.poses.forward import forward_kinematics
from gelenk.operations.chains import chain_and_positions, check_numbers, check_worked, head
from gelenk.operations.outcome import Limits, Outcome
from gelenk.operations.pose_arrays import pose_array, pose_list
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot

_QUICK = 100
"""Configurations that take the event loop less than about a millisecond; more go to a worker."""


def run(loaded: LoadedRobot, call: ForwardRequest, limits: Limits) -> Outcome:
    """Compute the pose of the tip, and of other requested frames, at each configuration."""
    robot = loaded.robot
    chain, qs = chain_and_positions(robot, call)
    frames = robot.frames_on(chain) if call.frames == "all" else tuple(dict.fromkeys(call.frames or ()))
    check_numbers(len(qs) * (1 + len(frames)) * 16, limits)
    check_worked(call, len(qs))
    result = forward_kinematics(robot, chain, qs, frames)

    def content() -> dict[str, Any]:
        answer = head(chain)
        answer["poses"] = pose_list(result.poses, call.pose_format)
        if call.frames is not None:
            lists = {name: pose_list(poses, call.pose_format) for name, poses in result.frames.items()}
            answer["frames"] = [{name: poses[row] for name, poses in lists.items()} for row in range(len(qs))]
        if call.steps:
            answer["steps"] = _worked(robot, chain, qs, call.pose_format)
        return answer | {"certificate": result.certificate}

    fits = call.frames is None and not call.steps
    return Outcome(content, (lambda: (pose_array(result.poses, call.pose_format), {})) if fits else None)


def is_heavy(call: ForwardRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return call.frames is not None or call.steps or len(call.joint_positions) > _QUICK


def _worked(robot: RobotModel, chain: Chain, qs: Array, notation: str) -> list[list[Step]]:
    table = standard_table(robot.description, chain)
    if table is None:
        return [placement_steps(chain.flat, q, notation) for q in qs]
    return [forward_steps(table, q, notation) for q in qs]
