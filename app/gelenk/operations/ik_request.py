"""Converts an inverse kinematics request for the core; checks its fields against each other and the chain."""

from functools import lru_cache
from operator import attrgetter
from typing import NamedTuple, cast

import numpy as np

from gelenk.contract.ik import MAX_TRACE, InverseRequest
from gelenk.errors import InvalidField, TooLarge, counted, quoted
from gelenk.ik.search.bounds import mid_range
from gelenk.ik.search.problem import DescentRule, Objective, Options, TargetProblem
from gelenk.ik.search.search import ITERATIONS_PER_START, MAX_ITERATIONS
from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.search.words import DIRECTIONS, Direction, StepMethod
from gelenk.operations.cells import has_cell
from gelenk.operations.pose_arrays import poses_from
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import MAX_MAGNITUDE, configurations, one_configuration
from gelenk.robot.robot import RobotModel

_TOLERANCES = {"position_tolerance", "orientation_tolerance"}
PLAIN = {"targets", "seeds", "base_frame", "tip_frame", "respect_limits", "random_seed", "pose_format"} | _TOLERANCES
"""Fields that go with any others: a call that sets no more, as most do, is not searched for what does not."""
_VARIED = attrgetter("position_tolerance", "orientation_tolerance", "respect_limits", "random_seed")
QUICK_TARGETS = 8
"""Most targets of a call that the event loop searches for itself."""
_QUICK_STARTS = 64
"""Starts of seven joints that take the event loop about 0.1 ms; a target that needs more goes to a worker."""
NUMBERS_OF_SOLUTION = 4
"""Numbers of a solution beside its joint positions."""
NUMBERS_OF_CONTACT = 9
"""Numbers about the contacts of a solution."""
NUMBERS_OF_STEPS = 1000
"""What the worked solution of a target counts for in the size of an answer."""


class TargetLimits(NamedTuple):
    """Limits of one call; `stepwise` holds for targets that are followed or worked out step by step, in Python."""

    targets: int
    stepwise: int
    numbers: int | None


def parse(
    robot: RobotModel, call: InverseRequest, bounds: TargetLimits, time_limit: float | None = None
) -> TargetProblem:
    """Return the problem to solve, within a time limit, [s], if given; raises InvalidInput or TooLarge."""
    is_plain = call.model_fields_set <= PLAIN
    if not is_plain:
        _check_options(call)
    chain = robot.chain(call.base_frame, call.tip_frame)
    if not is_plain:
        _check_fixed_joints(chain, call)
    targets = poses_from(call.targets, "targets", None if task_of(call).has_rotations else np.eye(3))
    _check_size(call, len(targets), len(chain), bounds)
    options = _plain_options(*_VARIED(call)) if is_plain else options_of(chain, call, time_limit)
    return TargetProblem(robot, chain, targets, seeds_of(chain, call, len(targets)), options)


def seeds_of(chain: Chain, call: InverseRequest, count: int) -> Array:
    """Return the seeds for a number of targets, shape (1 or N, n), [rad or m]; raises InvalidField."""
    if call.seeds is None and call.posture is not None:
        # A search for a configuration near a posture starts there.
        return one_configuration(chain, call.posture, "posture")
    if call.seeds is None:
        return mid_range(chain)[None]
    seeds = configurations(chain, call.seeds, "seeds")
    if len(seeds) not in {1, count}:
        raise InvalidField(
            "seeds", f"{counted(len(seeds), 'entry')} for {counted(count, 'target')}: one for all of them or one each"
        )
    return seeds


@lru_cache(maxsize=64)
def _plain_options(
    position_tolerance: float, orientation_tolerance: float, respect_limits: bool, random_seed: int
) -> Options:
    """Return the options of a plain call, which differ in nothing else: to build them takes longer than to look."""
    return Options(
        position_tolerance=position_tolerance,
        orientation_tolerance=orientation_tolerance,
        respect_limits=respect_limits,
        random_seed=random_seed,
    )


def options_of(chain: Chain, call: InverseRequest, time_limit: float | None) -> Options:
    """Return the options of the solver; without a time limit if that is None."""
    rule = None
    if call.method not in {"auto", "analytic"}:
        rule = DescentRule(cast(StepMethod, call.method), call.step_size, call.damping, call.switch_error)
    objective = None
    if call.objective is not None:
        posture = None if call.posture is None else one_configuration(chain, call.posture, "posture")
        objective = Objective(call.objective, posture)
    return Options(
        task=task_of(call),
        position_tolerance=call.position_tolerance,
        orientation_tolerance=call.orientation_tolerance,
        respect_limits=call.respect_limits,
        every=call.solutions == "all",
        most=call.max_solutions,
        windings=call.windings,
        method=call.method,
        rule=rule,
        max_iterations=call.max_iterations,
        time_limit=time_limit,
        random_seed=call.random_seed,
        objective=objective,
        elbow_angle=call.elbow_angle,
        trace=call.trace,
        fixed_joints=call.fixed_joints or {},
    )


def starts_of(chain: Chain, max_iterations: int | None) -> int:
    """Return how many starts a target may have before it takes the event loop too long."""
    budget = max(1, (max_iterations or MAX_ITERATIONS) // ITERATIONS_PER_START)
    return min(budget, max(1, _QUICK_STARTS * 7 // max(7, len(chain))))


def task_of(call: InverseRequest) -> Task:
    """Return the task: the directions that count."""
    return FULL_POSE if call.task is None else _task_of(frozenset(call.task))


@lru_cache(maxsize=64)
def _task_of(directions: frozenset[Direction]) -> Task:
    if len(directions) == len(DIRECTIONS):
        return FULL_POSE
    return Task(tuple(direction for direction in DIRECTIONS if direction in directions))


def _check_fixed_joints(chain: Chain, call: InverseRequest) -> None:
    """Refuse to fix a joint that is not a variable of the chain, a position out of range, or all joints."""
    fixed = call.fixed_joints or {}
    for name, value in fixed.items():
        field = f"fixed_joints.{name}"
        if name not in chain.joint_names:
            known = ", ".join(map(quoted, chain.joint_names))
            raise InvalidField(field, f"the chain has no variable of this name; it has {known}")
        if not abs(value) <= MAX_MAGNITUDE:
            raise InvalidField(field, f"a finite number of magnitude ≤ {MAX_MAGNITUDE:g}")
        j = chain.joint_names.index(name)
        lower, upper = float(chain.lower[j]), float(chain.upper[j])
        if call.respect_limits and not lower <= value <= upper:
            raise InvalidField(
                field, f"{value:.6g} is beyond the joint's limits: from {lower:.6g} to {upper:.6g} is allowed"
            )
        if len(fixed) == len(chain):
            raise InvalidField(field, "no joint is left to move: leave at least one of the chain out")


def _check_size(call: InverseRequest, targets: int, joints: int, bounds: TargetLimits) -> None:
    if targets > bounds.targets:
        raise TooLarge("targets", targets, bounds.targets)
    if is_stepwise(call) and targets > bounds.stepwise:
        raise TooLarge("targets that are followed or worked out step by step", targets, bounds.stepwise)
    rows = call.max_solutions if call.solutions == "all" else MAX_TRACE if call.trace else 1
    # The sweeps of families together have at most as many configurations as there may be solutions.
    contact = NUMBERS_OF_CONTACT * has_cell(call)
    each = joints + NUMBERS_OF_SOLUTION + contact + joints * (call.solutions == "all")
    numbers = targets * (each * rows + NUMBERS_OF_STEPS * call.steps)
    if bounds.numbers is not None and numbers > bounds.numbers:
        raise TooLarge("numbers in the answer", numbers, bounds.numbers)


def is_stepwise(call: InverseRequest) -> bool:
    """Check whether each iteration is followed, or each solution worked out, in Python."""
    return call.method not in {"auto", "analytic"} or call.trace or call.steps


def has_table(call: InverseRequest) -> bool:
    """Check whether a table with one row per target holds all of the answer."""
    return call.solutions == "one" and not call.trace and not call.steps


def _check_options(call: InverseRequest) -> None:
    if call.task is not None and len(set(call.task)) < len(call.task):
        raise InvalidField("task", "each direction may appear only once")
    if call.solutions == "all" and call.method not in {"auto", "analytic"}:
        raise InvalidField("solutions", "`all` is allowed with the methods `auto` and `analytic` only")
    if call.method == "analytic" and call.trace:
        raise InvalidField("trace", "a closed form has no iterations")
    if call.elbow_angle is not None and call.method != "analytic":
        raise InvalidField("elbow_angle", "only for the method `analytic`")
    if call.elbow_angle is not None and call.fixed_joints is not None:
        raise InvalidField("fixed_joints", "either they or `elbow_angle`, not both")
    if call.solutions == "all" and (call.trace or call.objective is not None):
        raise InvalidField("solutions", "`all` does not take `trace` or `objective`")
    if call.windings and (call.solutions != "all" or not call.respect_limits):
        raise InvalidField("windings", "only allowed with `solutions: all` within the limits")
    if call.posture is not None and call.objective != "posture":
        raise InvalidField("posture", "only for the objective `posture`")
    if call.step_size is not None and call.method not in {"gradient", "gradient_then_newton"}:
        raise InvalidField("step_size", "only for the methods `gradient` and `gradient_then_newton`")
    if call.damping is not None and call.method != "damped_least_squares":
        raise InvalidField("damping", "only for the method `damped_least_squares`")
    if call.objective == "clearance" and not has_cell(call):
        raise InvalidField("objective", "`clearance` needs a `scene`, or a `min_clearance` from the robot itself")
    if call.objective is not None and call.method != "auto":
        raise InvalidField("objective", "only for the method `auto`")
