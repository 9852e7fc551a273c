"""Independent check of a blend: small steps along its acceleration, without the formulas that planned it."""

import math
from dataclasses import dataclass

import numpy as np

from gelenk.course.motion.fly_over import Blend
from gelenk.errors import certify
from gelenk.robot.arrays import Array
from gelenk.robot.result import Result
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

STEPS = 400
_TOLERANCE = 1e-9


@dataclass(frozen=True, slots=True)
class BlendCheck(Result):
    """The blend recomputed by small steps along its acceleration, and B's distance from each of them.

    Attributes:
        steps: Number of time steps; 0 where the blend takes no time.
        max_position_error: At C', and of the motion where phases meet, [m].
        max_velocity_error: Likewise, [m/s].
        closest_distance_error: Smallest distance of a step to B against the one sent, [m].
    """

    steps: int
    max_position_error: float
    max_velocity_error: float
    closest_distance_error: float


def checked(blend: Blend, motion: PiecewisePolynomial | None) -> BlendCheck:
    """Integrate a blend step by step, and see whether phases meet; raises CertificationFailed beyond rounding."""
    corner = blend.corner
    begin, finish = corner.speed_before * corner.direction_before, corner.speed_after * corner.direction_after
    step = blend.time / STEPS
    # The mean velocity of each step is exact where the acceleration is constant.
    velocities = begin + np.outer(np.arange(STEPS + 1) * step, blend.acceleration)
    positions = blend.entry + np.cumsum(
        np.vstack((0.0 * begin, 0.5 * step * (velocities[1:] + velocities[:-1]))), axis=0
    )
    gaps, jumps = (0.0, 0.0) if motion is None else _joints(motion)
    position = max(_norm(positions[-1] - blend.exit), gaps)
    velocity = max(_norm(velocities[-1] - finish), jumps)
    nearest = float(np.linalg.norm(positions - corner.corner, axis=1).min())
    extent = max(float(np.abs([corner.start, corner.corner, corner.end]).max()), 1.0)
    fastest = max(corner.speed_before, corner.speed_after, 1.0)
    # The nearest step is at most half a step away from the nearest point.
    difference, spacing = abs(nearest - blend.closest_distance), 0.5 * step * fastest
    for quantity, error, scale in (
        ("the end of the blend", position, extent),
        ("the velocity after the blend", velocity, fastest),
        ("the smallest distance to the corner", max(difference - spacing, 0.0), extent),
    ):
        certify(quantity, error, _TOLERANCE * scale)
    return BlendCheck(STEPS if blend.time > 0.0 else 0, position, velocity, difference)


def _joints(motion: PiecewisePolynomial) -> tuple[float, float]:
    """Return the largest gap [m] and the largest jump of velocity [m/s] where pieces meet."""
    gap, jump = 0.0, 0.0
    for i in range(len(motion.breaks) - 2):
        h, c, following = motion.breaks[i + 1] - motion.breaks[i], motion.coefficients[i], motion.coefficients[i + 1]
        gap = max(gap, _norm(c[0] + c[1] * h + c[2] * h * h - following[0]))
        jump = max(jump, _norm(c[1] + 2.0 * c[2] * h - following[1]))
    return gap, jump


def _norm(vector: Array) -> float:
    return math.hypot(*vector)
