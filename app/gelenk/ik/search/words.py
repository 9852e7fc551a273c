"""Names and parts of requests and answers of inverse kinematics, importable without the solver code."""

from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

from gelenk.robot.result import Result

Status: TypeAlias = Literal["solved", "unreachable", "outside_limits", "singular", "not_converged", "in_collision"]
StopReason: TypeAlias = Literal[
    "converged", "stagnated", "near_singular", "at_limits", "diverged", "time_limit", "iterations"
]
Direction: TypeAlias = Literal["x", "y", "z", "rx", "ry", "rz"]
DIRECTIONS: tuple[Direction, ...] = get_args(Direction)
ObjectiveName: TypeAlias = Literal["posture", "mid_range", "limits", "manipulability"]
SelfMotionObjective: TypeAlias = Literal[ObjectiveName, "clearance"]
StepMethod: TypeAlias = Literal["newton", "gradient", "gradient_then_newton", "damped_least_squares"]
Method: TypeAlias = Literal["auto", "analytic", StepMethod]


@dataclass(frozen=True, slots=True)
class Family(Result):
    """Infinitely many solutions, joined by a motion of some joints while the others stand still.

    The motion was walked in steps of up to 0.2 rad (or m), as far as limits or a full turn allow, and each of its
    configurations met the target within 1e-9 m and rad.

    Attributes:
        free_joints: The joints that move, base to tip.
        relation: Which sums of them stay, `q_k` being the k-th of `joint_names`: `q_4 + q_6 = c`; null where no sum
            with small whole factors does.
        text: The relation in words, with the value of each sum [rad or m].
        sweep: Some of its configurations in the order of the motion, [rad or m]; those of all families together are
            at most `max_solutions`.
    """

    free_joints: list[str]
    relation: str | None
    text: str
    sweep: list[list[float]]


@dataclass(frozen=True, slots=True)
class BlockingJoint(Result):
    """A joint whose limit prevents the solution.

    Attributes:
        name: Of the joint.
        position: Position it would need, [rad or m].
        lower: Lower limit, [rad or m].
        upper: Upper limit, [rad or m].
        excess: How far beyond the limit that is, [rad or m].
    """

    name: str
    position: float
    lower: float
    upper: float
    excess: float


@dataclass(frozen=True, slots=True)
class Iterate(Result):
    """One configuration in the course of an iteration.

    Attributes:
        error: ‖e‖ of the directions that count: distance [m] and rotation vector [rad] mixed.
        min_singular_value: Smallest singular value of J in these directions, mixed likewise.
        step_length: ‖Δq‖ of the step from here, [rad or m]; null at the last.
        method: Method of that step; null at the last.
        joint_positions: The configuration itself, [rad or m].
    """

    error: float
    min_singular_value: float
    step_length: float | None
    method: str | None
    joint_positions: list[float]


@dataclass(frozen=True, slots=True)
class IterationPath:
    """The path of one iterative method to where it stopped.

    Attributes:
        stop_reason: Why the method stopped.
        trace: Every configuration, with the first and the last; empty without a turn. None if it was not requested.
    """

    stop_reason: StopReason
    trace: list[Iterate] | None
