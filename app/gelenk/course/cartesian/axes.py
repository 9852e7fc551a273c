"""A line as the motion of a PPP robot, whose axes have limits of their own.

No axis arrives before T_j, its own bang-coast-bang, so that max T_j bounds every path from below. Along the line the
axes share s(t), which keeps v_s = min v_j/|Δ_j| and a_s = min a_j/|Δ_j|: the line takes no more than that bound if one
axis sets both.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.result import Result
from gelenk.trajectory.laws.trapezoid import JointMove, fastest

_SAME = 1e-12


@dataclass(frozen=True, slots=True)
class AxesComparison(Result):
    """The line, from rest to rest in the shortest time, beside the axes of a PPP robot, each by itself.

    Attributes:
        durations: T_j of each axis alone, [s].
        lower_bound: The largest of them, which no path can beat, [s].
        line_duration: Of bang-coast-bang on the line, [s].
        velocity_axis: Number of the axis that limits the speed on the line, from 1; null without such limits. No unit.
        acceleration_axis: Number of the axis that limits the acceleration there, from 1; no unit.
        is_time_optimal: Whether the line takes no longer than the bound.
    """

    durations: tuple[float, ...]
    lower_bound: float
    line_duration: float
    velocity_axis: int | None
    acceleration_axis: int
    is_time_optimal: bool


@dataclass(frozen=True, slots=True)
class AxisLimits:
    """Limits of each axis; shape (k,), [m/s] and [m/s²]; velocities may be infinite."""

    velocity: Array
    acceleration: Array

    def along(self, displacement: Array) -> tuple[float, float]:
        """Return the largest σ̇ and σ̈ along a displacement, (k,), [m]: min v_j/|K_j| and min a_j/|K_j|."""
        parts = np.abs(displacement) / (np.linalg.norm(displacement) or 1.0)
        with np.errstate(divide="ignore"):
            velocity, acceleration = (limit / parts for limit in (self.velocity, self.acceleration))
        if not parts.any():
            velocity, acceleration = self.velocity, self.acceleration
        return float(velocity.min()), float(acceleration.min())


def compared_axes(displacement: Array, limits: AxisLimits) -> AxesComparison:
    """Compare the line with its axes; raises InvalidField for a count of limits other than that of coordinates."""
    for field, values in (("axis_velocity", limits.velocity), ("axis_acceleration", limits.acceleration)):
        if len(values) != len(displacement):
            raise InvalidField(field, f"needs one number per coordinate, {len(displacement)}; here are {len(values)}")
    moves = zip(np.abs(displacement).tolist(), limits.velocity.tolist(), limits.acceleration.tolist(), strict=True)
    durations = tuple(fastest(JointMove(d, 0.0, 0.0, v, a)).duration for d, v, a in moves)
    v, a = limits.along(displacement)
    line = fastest(JointMove(float(np.linalg.norm(displacement)), 0.0, 0.0, v, a)).duration
    with np.errstate(divide="ignore", invalid="ignore"):
        shares = [np.nan_to_num(np.abs(displacement) / limit) for limit in (limits.velocity, limits.acceleration)]
    first = int(shares[0].argmax()) + 1 if shares[0].any() else None
    bound = max(durations)
    return AxesComparison(durations, bound, line, first, int(shares[1].argmax()) + 1, line <= bound * (1.0 + _SAME))
