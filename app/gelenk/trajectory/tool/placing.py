"""The problem of a path that leaves a turn of the tool open, with the turn chosen: ordinary segments."""

from dataclasses import replace
from typing import cast

from gelenk.errors import InvalidField
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.demands import Demands
from gelenk.trajectory.problem.parts import PlannedPart, standing
from gelenk.trajectory.problem.problem import FreeTool, ToolTurn, TrajectoryProblem
from gelenk.trajectory.problem.result import PlanningFailure
from gelenk.trajectory.tool.sequence import ToolSequence, tool_sequence


def placed_tool(chain: Chain, problem: TrajectoryProblem, tool: FreeTool) -> tuple[TrajectoryProblem, ToolSequence]:
    """Return the problem with the turn and the branch of the cheapest sequence, as far as there is one.

    A motion of the joints before the path leads to the sequence's start. `InvalidField` if there is no path, the arm
    has no closed form, or the motion begins at the first pose and that is blocked.
    """
    (*there, along), following = problem.segments, problem.following
    start = problem.start if there else None
    least = 0.0 if following.near_singularity == "slow_down" else following.min_singular_value
    sequence = tool_sequence(chain, cast(Poses, along.poses), tool, along.limits.velocity, least, start, problem.cell)
    first = sequence.start
    if first is None:
        if start is None:
            raise InvalidField("path.poses.0", cast(PlanningFailure, sequence.failure).detail)
        first = start
    moves = [replace(one, configuration=first) for one in there]
    along = replace(along, turn=sequence.turn)
    return replace(problem, start=first if start is None else start, segments=(*moves, along)), sequence


def stopped(parts: list[PlannedPart], problem: TrajectoryProblem, sequence: ToolSequence) -> list[PlannedPart]:
    """Return the parts of a placed problem with what blocks the rest of the path, if anything does."""
    if sequence.failure is None:
        return parts
    path = len(problem.segments) - 1
    if parts and parts[-1].failure is not None and parts[-1].failure.reason == "collision":
        return parts
    if cast(ToolTurn, problem.segments[path].turn).is_blocked:
        index = 0 if sequence.start is None else path
        failure = replace(sequence.failure, segment=index)
        return [*parts, PlannedPart(standing(problem.start), (), Demands(), failure, 0.0)]
    last = parts[-1]
    failure = last.failure or replace(sequence.failure, segment=path)
    return [*parts[:-1], replace(last, failure=failure, share=last.share * sequence.share)]
