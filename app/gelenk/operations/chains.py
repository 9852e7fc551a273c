"""Steps that many operations on a robot share: the chain, the configurations, the size of the answer."""

from collections.abc import Sequence
from typing import Any

from gelenk.contract.options import MAX_WORKED, WithSteps
from gelenk.errors import InvalidField, TooLarge, counted
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import DIRECTIONS, Direction
from gelenk.kinematics.velocity.task_space import TaskSpace, slides
from gelenk.operations.outcome import Limits
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import check_limits, configurations
from gelenk.robot.robot import RobotModel


def chain_and_positions(robot: RobotModel, call: Any) -> tuple[Chain, Array]:
    """Return the chain of a request and its configurations, shape (N, n), [rad or m].

    The request has `base_frame`, `tip_frame`, `joint_positions` and `respect_limits`. Raises UnknownFrame; InvalidField
    for a configuration without one number per joint; OutsideLimits for one beyond limits that the request respects.
    """
    chain = robot.chain(call.base_frame, call.tip_frame)
    return chain, positions(chain, call)


def positions(chain: Chain, call: Any) -> Array:
    """Return the configurations of a request, shape (N, n), [rad or m]; raises as `chain_and_positions` does."""
    qs = configurations(chain, call.joint_positions)
    if call.respect_limits:
        check_limits(chain, qs)
    return qs


def check_numbers(numbers: int, limits: Limits) -> None:
    """Refuse an answer with more numbers than the operator allows; raises TooLarge."""
    if numbers > limits.answer_numbers:
        raise TooLarge("numbers in the answer", numbers, limits.answer_numbers)


def check_worked(call: WithSteps, count: int) -> None:
    """Refuse to work out too many solutions; raises TooLarge."""
    if call.steps and count > MAX_WORKED:
        raise TooLarge("configurations with `steps`", count, MAX_WORKED)


def check_count(rows: int, count: int, field: str, hint: str = "") -> None:
    """Refuse a field whose rows are not one per configuration; raises InvalidField, with a hint."""
    if rows != count:
        raise InvalidField(field, f"{counted(rows, 'entry')} for {counted(count, 'configuration')}{hint}")


def task_of(directions: Sequence[Direction] | None) -> Task:
    """Return the task of the given directions, in their order, or of all six; raises InvalidField for a repetition."""
    task = Task(tuple(directions or DIRECTIONS))
    if len(set(task.directions)) < len(task):
        raise InvalidField("task", "each direction may appear only once")
    return task


def units_are_mixed(chain: Chain, space: TaskSpace) -> bool:
    """Check whether the rows of the Jacobian, or its columns, have different units."""
    rows = 0 < space.turns < len(space) and space.characteristic_length is None
    return rows or len(set(slides(chain).tolist())) > 1


def head(chain: Chain) -> dict[str, Any]:
    """Return the first fields of every answer about a chain."""
    return {"joint_names": chain.joint_names, "base_frame": chain.base_frame, "tip_frame": chain.tip_frame}
