"""Names used in requests and answers of inverse kinematics, importable without the solver code."""

from typing import Literal, TypeAlias, get_args

Status: TypeAlias = Literal["solved", "unreachable", "outside_limits", "singular", "not_converged"]
StopReason: TypeAlias = Literal[
    "converged", "stagnated", "near_singular", "at_limits", "diverged", "time_limit", "iterations"
]
Direction: TypeAlias = Literal["x", "y", "z", "rx", "ry", "rz"]
DIRECTIONS: tuple[Direction, ...] = get_args(Direction)
ObjectiveName: TypeAlias = Literal["posture", "mid_range", "limits", "manipulability"]
