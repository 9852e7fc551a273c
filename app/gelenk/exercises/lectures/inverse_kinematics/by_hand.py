"""Solutions and steps of an arm that is given by the rows of its standard table."""

from collections.abc import Sequence

import numpy as np

from gelenk.course.inverse.agreement import SentSolutions, hand_steps
from gelenk.course.inverse.arm import HandTarget, hand_arm
from gelenk.course.inverse.by_hand import prepared, solver_of
from gelenk.course.steps import Step
from gelenk.course.writing import wrapped
from gelenk.exercises.table_field import table_of
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable

POSITION = frozenset("xyz")
POSE = POSITION | {"rx", "ry", "rz"}


def revolute(*rows: Sequence[float]) -> DhTable:
    """Return the table of revolute joints with rows of a, α, d, ϑ."""
    return table_of(np.array(rows, float), (False,) * len(rows))


def solutions(table: DhTable, pose: Array, directions: frozenset[str] = POSE) -> list[Array]:
    """Return all configurations by hand, angles in (-π, π]; raises ValueError if there are none, or too many."""
    arm = prepared(hand_arm(table))
    solve = solver_of(arm, directions)
    if solve is None:
        raise ValueError("no solution by hand")
    found = solve(arm, HandTarget(pose, directions, np.zeros(len(arm.rows)))).solutions
    if not found or any(np.isnan(one.values).any() for one in found):
        raise ValueError("out of reach, or a joint is free")
    return [_wrapped(arm.positions(one.values), arm.slides) for one in found]


def _wrapped(q: Array, slides: Sequence[bool]) -> Array:
    return np.array([x if slide else wrapped(x) for x, slide in zip(q.tolist(), slides, strict=True)])


def steps_by_hand(table: DhTable, pose: Array, directions: frozenset[str] = POSE) -> list[Step]:
    """Return the worked solution, which the forward kinematics confirms."""
    sent = SentSolutions(pose, directions, np.array(solutions(table, pose, directions)))
    found = hand_steps(hand_arm(table), sent)
    if found is None:
        raise ValueError("the solutions by hand are not confirmed")
    return found
