"""A request of inverse kinematics → what the core is asked, every field checked against the others and the chain."""

from dataclasses import dataclass
from functools import lru_cache

from app.kinematics.configuration import configurations, one_configuration
from app.kinematics.ik.descent import Rule
from app.kinematics.ik.null_space import Objective
from app.kinematics.ik.search import mid_range
from app.kinematics.ik.solve import Options
from app.kinematics.ik.task import FULL_POSE, Task
from app.kinematics.ik.words import DIRECTIONS, Direction
from app.model.arrays import Array
from app.model.chain import Chain
from app.model.errors import InvalidField, TooLarge, counted
from app.model.poses import Poses
from app.schemas.ik import MAX_TRACE, InverseRequest
from app.schemas.pose_arrays import poses_from
from app.store.records import LoadedRobot


@dataclass(frozen=True, slots=True)
class Bounds:
    """How much may be asked in one call.

    Attributes:
        targets: Of any method.
        stepwise: Of a method that is followed step by step, in Python.
        numbers: In the answer; None for as many as there is room for.
    """

    targets: int
    stepwise: int
    numbers: int | None


def asked(loaded: LoadedRobot, call: InverseRequest, bounds: Bounds) -> tuple[Chain, Poses, Array]:
    """The chain, the targets, and where to start: one configuration for all or one each, shape (1 or N, n).

    Raises:
        InvalidInput: The field, and what is wrong with it.
        TooLarge: More is asked for than may be.
    """
    _check_options(call)
    chain = loaded.robot.chain(call.base_frame, call.tip_frame)
    targets = poses_from(call.targets, "targets")
    _check_size(call, len(targets), len(chain), bounds)
    return chain, targets, _seeds(chain, call, len(targets))


def _seeds(chain: Chain, call: InverseRequest, count: int) -> Array:
    if call.seeds is None and call.posture is not None:
        # Whoever wants to be near a posture starts there.
        return one_configuration(chain, call.posture, "posture")
    if call.seeds is None:
        return mid_range(chain)[None]
    seeds = configurations(chain, call.seeds, "seeds")
    if len(seeds) not in {1, count}:
        raise InvalidField(
            "seeds", f"{counted(len(seeds), 'entry')} for {counted(count, 'target')}: one for all of them or one each"
        )
    return seeds


def options_of(chain: Chain, call: InverseRequest, time_limit: float | None) -> Options:
    """How it is to be solved; with None it may take any time."""
    match call.method:
        case "auto" | "analytic":
            rule = None
        case step_method:
            rule = Rule(step_method, call.step_size, call.damping, call.switch_error)
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
        objective=_objective(chain, call),
        elbow_angle=call.elbow_angle,
        trace=call.trace,
    )


def task_of(call: InverseRequest) -> Task:
    """The directions that count."""
    return FULL_POSE if call.task is None else _task_of(frozenset(call.task))


@lru_cache(maxsize=64)
def _task_of(directions: frozenset[Direction]) -> Task:
    if len(directions) == len(DIRECTIONS):
        return FULL_POSE
    return Task(tuple(direction for direction in DIRECTIONS if direction in directions))


def _objective(chain: Chain, call: InverseRequest) -> Objective | None:
    if call.objective is None:
        return None
    if call.posture is None:
        return Objective(call.objective)
    return Objective(call.objective, one_configuration(chain, call.posture, "posture"))


def _check_size(call: InverseRequest, targets: int, joints: int, bounds: Bounds) -> None:
    if targets > bounds.targets:
        raise TooLarge("targets", targets, bounds.targets)
    if is_stepwise(call) and targets > bounds.stepwise:
        raise TooLarge("targets of a method that is followed step by step", targets, bounds.stepwise)
    rows = call.max_solutions if call.solutions == "all" else MAX_TRACE if call.trace else 1
    numbers = targets * (joints + 4) * rows
    if bounds.numbers is not None and numbers > bounds.numbers:
        raise TooLarge("numbers in the answer", numbers, bounds.numbers)


def is_stepwise(call: InverseRequest) -> bool:
    """Whether each iteration is followed in Python."""
    return call.method not in {"auto", "analytic"} or call.trace


def _check_options(call: InverseRequest) -> None:
    """Refuse what does not go together.

    Raises:
        InvalidField: The field, and what it goes with.
    """
    if call.task is not None and len(set(call.task)) < len(call.task):
        raise InvalidField("task", "each direction at most once")
    if call.solutions == "all" and call.method not in {"auto", "analytic"}:
        raise InvalidField("solutions", "`all` goes with the methods `auto` and `analytic` only")
    if call.method == "analytic" and call.trace:
        raise InvalidField("trace", "a closed form has no iterations to tell of")
    if call.elbow_angle is not None and call.method != "analytic":
        raise InvalidField("elbow_angle", "it goes with the method `analytic` only")
    if call.solutions == "all" and (call.trace or call.objective is not None):
        raise InvalidField("solutions", "`all` goes without `trace` and `objective`")
    if call.windings and (call.solutions != "all" or not call.respect_limits):
        raise InvalidField("windings", "they go with `solutions: all` within the limits, without which there is no end")
    if call.posture is not None and call.objective != "posture":
        raise InvalidField("posture", "it goes with the objective `posture` only")
    if call.step_size is not None and call.method not in {"gradient", "gradient_then_newton"}:
        raise InvalidField("step_size", "it goes with the methods `gradient` and `gradient_then_newton` only")
    if call.damping is not None and call.method != "damped_least_squares":
        raise InvalidField("damping", "it goes with the method `damped_least_squares` only")
    if call.objective is not None and call.method != "auto":
        raise InvalidField("objective", "it goes with the method `auto` only")
