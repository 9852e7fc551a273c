"""Uniform time scaling: in k times the time, velocities scale by 1/k, accelerations by 1/k², jerks by 1/k³.

The course only slows down: k = max{1, k_vel, √k_acc}, where k_vel and k_acc are the largest ratios of a peak to its
limit. Without the 1, k may also speed up, and some limit is just reached. Peaks are exact, from the derivative's roots.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.result import Result
from gelenk.trajectory.motion.extremes import Peaks, peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

Quantity: TypeAlias = Literal["velocity", "acceleration", "jerk"]

QUANTITIES: tuple[Quantity, ...] = ("velocity", "acceleration", "jerk")
"""All quantities in the order of their derivatives, starting with the first."""

SMALLEST, LARGEST = 1e-9, 1e9
"""Range of a limit; positions and durations are at most as large."""
_STANDS_STILL = 1e-12
"""Factor below which a motion counts as standing still, so that it has no shortest duration."""


@dataclass(frozen=True, slots=True)
class ScalingLimits:
    """Limits of each joint; > 0, shape (n,) each, [rad or m per s, s² or s³], None for no limit."""

    velocity: Array | None = None
    acceleration: Array | None = None
    jerk: Array | None = None

    def of(self, quantity: Quantity) -> Array | None:
        """Return the limits of a quantity."""
        found: Array | None = getattr(self, quantity)
        return found


@dataclass(frozen=True, slots=True)
class Bound(Result):
    """The joint that is nearest to its limit of a quantity, or furthest beyond it, in the given motion.

    Attributes:
        quantity: Whose limit sets the duration.
        ratio: Peak over limit, no unit.
        factor: The k that this quantity alone requires: the ratio of a velocity, the square root of that of an
            acceleration, the cube root of that of a jerk; no unit.
        joint: Number of the joint, from 1; no unit.
        time: Time of the peak, [s].
        peak: Signed peak, [rad or m per s, s² or s³].
        limit: The limit, in the unit of the peak.
    """

    quantity: Quantity
    ratio: float
    factor: float
    joint: int
    time: float
    peak: float
    limit: float


@dataclass(frozen=True, slots=True)
class Scaling:
    """Factors by which a motion can be slowed down or sped up.

    Attributes:
        binding: Bound that requires the largest k.
        course_factor: k = max{1, k_vel, √k_acc} as in the course.
        factor: The same without the 1; None for a motion that stands still.
    """

    bounds: tuple[Bound, ...]
    binding: Bound
    course_factor: float
    factor: float | None


def check_limits(limits: Sequence[Array] | Array) -> None:
    """Refuse limits of velocity, acceleration and so on, (n,) each, that are not usable, with `InvalidField`."""
    rows = np.array(limits)
    if not (rows.min(initial=LARGEST) >= SMALLEST and rows.max(initial=SMALLEST) <= LARGEST):
        wrong = ~((rows >= SMALLEST) & (rows <= LARGEST))
        order, joint = (int(index) for index in np.argwhere(wrong)[0])
        reason = f"joint {joint + 1}: must be a number from {SMALLEST:g} to {LARGEST:g}"
        raise InvalidField(f"limits.joint_{QUANTITIES[order]}", reason)


def uniform_scaling(motion: PiecewisePolynomial, limits: ScalingLimits) -> Scaling:
    """Compute the factors by which to multiply a motion's time, under limits of at least one quantity."""
    bounds = tuple(
        _bound(quantity, order, peaks(motion, order), limit)
        for order, quantity in enumerate(QUANTITIES, start=1)
        if (limit := limits.of(quantity)) is not None
    )
    binding = max(bounds, key=lambda bound: bound.factor)
    factor = binding.factor if binding.factor > _STANDS_STILL else None
    return Scaling(bounds, binding, max(1.0, binding.factor), factor)


def _bound(quantity: Quantity, order: int, found: Peaks, limit: Array) -> Bound:
    ratios = np.abs(found.values) / limit
    j = int(ratios.argmax())
    ratio = float(ratios[j])
    # Among joints whose ratios differ only by rounding, take the first.
    j = int(np.argmax(ratios >= ratio * (1.0 - 1e-12)))
    return Bound(
        quantity, ratio, ratio ** (1.0 / order), j + 1, float(found.times[j]), float(found.values[j]), float(limit[j])
    )
