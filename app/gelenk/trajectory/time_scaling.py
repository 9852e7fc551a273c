"""Uniform time scaling: the same path in k times the time, velocities by 1/k, accelerations by 1/k², jerks by 1/k³.

The course slows down alone: k = max{1, k_vel, √k_acc}, each k the largest ratio of a peak to its limit. Without the 1
the same maximum also speeds up: some limit is then just reached. Peaks are exact, from the roots of the derivative.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.model.arrays import Array
from gelenk.trajectory.extremes import Peaks, peaks
from gelenk.trajectory.polynomial import PiecewisePolynomial

Quantity: TypeAlias = Literal["velocity", "acceleration", "jerk"]

QUANTITIES: tuple[Quantity, ...] = ("velocity", "acceleration", "jerk")
"""In the order of their derivatives, from the first one on."""

STANDS_STILL = 1e-12
"""A factor below which a motion counts as none: there is no time that it would just take."""


@dataclass(frozen=True, slots=True)
class Limits:
    """The limits of each joint; each > 0, of shape (n,), None where there is no limit.

    Attributes:
        velocity: [rad/s or m/s].
        acceleration: [rad/s² or m/s²].
        jerk: [rad/s³ or m/s³].
    """

    velocity: Array | None = None
    acceleration: Array | None = None
    jerk: Array | None = None

    def of(self, quantity: Quantity) -> Array | None:
        """The limits of a quantity."""
        found: Array | None = getattr(self, quantity)
        return found


@dataclass(frozen=True, slots=True)
class Bound:
    """The joint that is nearest to its limit of a quantity, or furthest beyond it.

    Attributes:
        quantity: Which.
        ratio: Its peak over its limit.
        factor: The k that this quantity alone asks for: the ratio, its square root or its cube root.
        joint: Which, from 0.
        time: When, in the motion that is not scaled, [s].
        peak: With its sign.
        limit: Of this joint.
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
    """The factors by which a motion can be slowed down or sped up.

    Attributes:
        bounds: One a quantity that is limited.
        binding: The one that asks for the largest k.
        course_factor: k = max{1, k_vel, √k_acc}, as in the course: it slows down alone.
        factor: The same without the 1; None for a motion that stands still.
    """

    bounds: tuple[Bound, ...]
    binding: Bound
    course_factor: float
    factor: float | None


def uniform_scaling(motion: PiecewisePolynomial, limits: Limits) -> Scaling:
    """The factors by which a motion's time is to be multiplied.

    Args:
        motion: The motion.
        limits: At least one.
    """
    bounds = tuple(
        _bound(quantity, order, peaks(motion, order), limit)
        for order, quantity in enumerate(QUANTITIES, start=1)
        if (limit := limits.of(quantity)) is not None
    )
    binding = max(bounds, key=lambda bound: bound.factor)
    factor = binding.factor if binding.factor > STANDS_STILL else None
    return Scaling(bounds, binding, max(1.0, binding.factor), factor)


def _bound(quantity: Quantity, order: int, found: Peaks, limit: Array) -> Bound:
    ratios = np.abs(found.values) / limit
    j = int(ratios.argmax())
    ratio = float(ratios[j])
    # Of two joints at the same ratio, the first one that is as near as rounding tells.
    j = int(np.argmax(ratios >= ratio * (1.0 - 1e-12)))
    return Bound(
        quantity, ratio, ratio ** (1.0 / order), j, float(found.times[j]), float(found.values[j]), float(limit[j])
    )
