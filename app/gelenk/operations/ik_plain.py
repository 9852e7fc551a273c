"""What most calls for inverse kinematics want: one solution for each of a few poses, by search, with no more options.

Each step of the general way takes longer than the search. So here it is called with the numbers of the request, and its
numbers are the answer.
"""

from functools import lru_cache
from math import hypot
from typing import Any

import numpy as np

from gelenk.contract.ik import InverseRequest
from gelenk.ik.closed.closed_form import closed_form, is_looked_at
from gelenk.ik.quick import QuickSearch, quick_search
from gelenk.ik.search.task import FULL_POSE
from gelenk.operations.chains import head
from gelenk.operations.ik_answer import unsolved_headers
from gelenk.operations.ik_request import NUMBERS_OF_SOLUTION, PLAIN, QUICK_TARGETS, seeds_of, starts_of
from gelenk.operations.outcome import Limits, Outcome, RequestCounts
from gelenk.robot.chain import Chain
from gelenk.robot.compilation import is_awaited
from gelenk.robot.poses import ROTATION_TOLERANCE
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot

_KEPT = 64


def plain_outcome(loaded: LoadedRobot, call: InverseRequest, limits: Limits) -> Outcome | None:
    """Return the outcome of such a call; None for other calls, and if a target has no solution.

    A search is prepared only if that is quick: if the kernels are there, and the lack of a closed form is known.
    """
    if not call.__pydantic_fields_set__ <= PLAIN or not (goals := _goals(call.targets)):
        return None
    robot, tolerances = loaded.robot, (call.position_tolerance, call.orientation_tolerance)
    try:
        search = _search(robot, call.base_frame, call.tip_frame, tolerances, call.respect_limits, call.random_seed)
    except _NotYetError:
        return None
    if search is None or len(goals) * (search.count + NUMBERS_OF_SOLUTION) > limits.answer_numbers:
        return None
    seeds = None if call.seeds is None else seeds_of(search.chain, call, len(goals))
    found = []
    for i, goal in enumerate(goals):
        seed = None if seeds is None else seeds[i if len(seeds) > 1 else 0]
        if (numbers := search(goal, seed)) is None:
            return None
        found.append(numbers)
    return _outcome(search.chain, found)


def _goals(targets: Any) -> list[list[float]] | None:
    """Return what a search takes; None for many, for another notation, and for quaternions of no rotation."""
    if type(targets) is not list or len(targets) > QUICK_TARGETS:
        return None
    goals = []
    for pose in targets:
        if (quaternion := pose.quaternion_xyzw) is None:
            return None
        length = hypot(*quaternion)
        if abs(length - 1.0) > ROTATION_TOLERANCE:
            return None
        goals.append([length, *quaternion, *pose.position])
    return goals


class _NotYetError(Exception):
    """What a search needs is not there yet: raised, because the cache would keep a result."""


@lru_cache(_KEPT)
def _search(
    robot: RobotModel,
    base_frame: str | None,
    tip_frame: str | None,
    tolerances: tuple[float, float],
    respect_limits: bool,
    random_seed: int,
) -> QuickSearch | None:
    """Return the search of a chain, None if it has a closed form."""
    chain = robot.chain(base_frame, tip_frame)
    if is_awaited() or not is_looked_at(chain):
        raise _NotYetError
    if closed_form(chain) is not None:
        return None
    starts = starts_of(chain, None)
    return quick_search(robot, chain, FULL_POSE, tolerances, respect_limits, starts, random_seed)


def _outcome(chain: Chain, found: list[tuple[Any, ...]]) -> Outcome:
    def content() -> dict[str, Any]:
        answer = head(chain)
        answer["task"], answer["closed_form"] = FULL_POSE.directions, None
        answer["results"] = [{"status": "solved", "solutions": [_solution(one)], "reason": None} for one in found]
        return answer

    return Outcome(
        content,
        lambda: (np.array(found)[:, : len(chain)], unsolved_headers([])),
        solved=lambda targets: _counts(targets, sum([one[-2] for one in found])),
    )


@lru_cache
def _counts(targets: int, iterations: int) -> RequestCounts:
    return RequestCounts(targets, {"solved": targets}, targets, iterations)


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
