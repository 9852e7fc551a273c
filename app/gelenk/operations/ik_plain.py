"""What most calls for inverse kinematics want: one solution for each of a few poses, by search, with no more options.

Each step of the general way takes longer than the search. So here it is called with the numbers of the request, and its
numbers are the answer.
"""

from functools import lru_cache
from typing import Any, cast

import numpy as np

from gelenk.contract.ik import InverseRequest
from gelenk.contract.pose import Pose
from gelenk.errors import InvalidPose
from gelenk.ik.closed.closed_form import closed_form
from gelenk.ik.quick import QuickSearch, quick_search
from gelenk.ik.search.task import FULL_POSE
from gelenk.operations.chains import head
from gelenk.operations.ik_answer import unsolved_headers
from gelenk.operations.ik_request import NUMBERS_OF_SOLUTION, PLAIN, seeds_of, starts_of
from gelenk.operations.outcome import Limits, Outcome, RequestCounts
from gelenk.robot.chain import Chain
from gelenk.robot.poses import unit_quaternion
from gelenk.robot.robot import RobotModel

_KEPT = 64


def plain_outcome(robot: RobotModel, call: InverseRequest, limits: Limits) -> tuple[Outcome | None] | None:
    """Return the outcome of such a call, None in its place if a target has no solution; and None for other calls."""
    if not call.__pydantic_fields_set__ <= PLAIN or not (goals := _goals(call)):
        return None
    tolerances = call.position_tolerance, call.orientation_tolerance
    chain, search = _search(robot, call.base_frame, call.tip_frame, tolerances, call.respect_limits, call.random_seed)
    if search is None or len(goals) * (len(chain) + NUMBERS_OF_SOLUTION) > limits.answer_numbers:
        return None
    seeds = None if call.seeds is None else seeds_of(chain, call, len(goals))
    found = []
    for i, goal in enumerate(goals):
        seed = None if seeds is None else seeds[i if len(seeds) > 1 else 0]
        if (numbers := search(goal, seed)) is None:
            return (None,)
        found.append(numbers)
    return (_outcome(chain, found),)


def _goals(call: InverseRequest) -> list[list[float]] | None:
    """Return unit quaternions x y z w and positions; None for another notation, and for what is none of that."""
    if isinstance(call.targets, np.ndarray):
        return None
    goals = []
    for pose in cast(list[Pose], call.targets):
        if pose.quaternion_xyzw is None:
            return None
        try:
            goals.append([*unit_quaternion(pose.quaternion_xyzw), *pose.position])
        except InvalidPose:  # for the general way to say so
            return None
    return goals


@lru_cache(_KEPT)
def _search(
    robot: RobotModel,
    base_frame: str | None,
    tip_frame: str | None,
    tolerances: tuple[float, float],
    respect_limits: bool,
    random_seed: int,
) -> tuple[Chain, QuickSearch | None]:
    """Return a chain and its search, None if it has a closed form."""
    chain = robot.chain(base_frame, tip_frame)
    if closed_form(chain) is not None:
        return chain, None
    starts = starts_of(chain, None)
    return chain, quick_search(robot, chain, FULL_POSE, tolerances, respect_limits, starts, random_seed)


def _outcome(chain: Chain, found: list[tuple[Any, ...]]) -> Outcome:
    def content() -> dict[str, Any]:
        answer = head(chain)
        answer["task"], answer["closed_form"] = FULL_POSE.directions, None
        answer["results"] = [{"status": "solved", "solutions": [_solution(one)], "reason": None} for one in found]
        return answer

    return Outcome(
        content,
        lambda: (np.array(found)[:, : len(chain)], unsolved_headers([])),
        solved=lambda targets: RequestCounts(targets, {"solved": targets}, targets, sum([one[-2] for one in found])),
    )


def _solution(numbers: tuple[Any, ...]) -> dict[str, Any]:
    *q, position_error, orientation_error, restarts, iterations, _ = numbers
    return {
        "joint_positions": q,
        "position_error": position_error,
        "orientation_error": orientation_error,
        "method": "damped_least_squares",
        "iterations": iterations,
        "restarts": restarts,
        "branch": None,
    }
