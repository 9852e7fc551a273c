"""Fly-over of a corner without stopping: the path A-B-C with a parabola at B, at constant acceleration.

The parabola leads from A' = B - d₁ K_AB, at speed v₁ along AB, to C' = B + d₂ K_BC, at speed v₂ along BC, in time ΔT:

    p(t) = A' + v₁ K_AB t + (v₂ K_BC - v₁ K_AB) t² / (2 ΔT),   d₁ = v₁ ΔT / 2,   d₂ = v₂ ΔT / 2

It lies in the plane of A, B and C, and its tangents at the ends meet in B. If A, B and C lie on a line in this order,
it is a mere change of speed; if BC leads back along AB, it slows down, turns before B, and returns. Any one of ΔT, d₁,
d₂ and the acceleration ‖v₂ K_BC - v₁ K_AB‖ / ΔT determines the others.
"""

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

Turn: TypeAlias = Literal["corner", "straight", "reversal"]
Given: TypeAlias = Literal["blend_time", "distance_before", "distance_after", "radius", "max_acceleration"]

STRAIGHT = 1e-9
"""Angle between the legs, or to a reversal, below which there is no corner, [rad]."""
_ROUNDING = 1e-12
"""Share by which a blend may exceed a leg, to allow for rounding if it just fits."""


@dataclass(frozen=True, slots=True)
class Corner:
    """The path A-B-C, and the speeds on its two legs.

    Attributes:
        start, corner, end: A, B and C; shape (k,), [m].
        speed_before, speed_after: v₁ ≥ 0 along AB and v₂ ≥ 0 along BC, [m/s].
        length_before, length_after: |AB| and |BC|, [m].
        direction_before, direction_after: K_AB and K_BC, unit vectors along AB and BC; shape (k,).
        angle: Angle between the two directions, in [0, π], [rad].
    """

    start: Array
    corner: Array
    end: Array
    speed_before: float
    speed_after: float
    length_before: float
    length_after: float
    direction_before: Array
    direction_after: Array
    angle: float
    turn: Turn

    @property
    def velocity_change(self) -> Array:
        """v₂ K_BC - v₁ K_AB; shape (k,), [m/s]."""
        change: Array = self.speed_after * self.direction_after - self.speed_before * self.direction_before
        return change

    @property
    def longest_blend_time(self) -> float:
        """Largest ΔT that fits, at which d₁ = |AB| or d₂ = |BC|, [s]."""
        lengths, speeds = (self.length_before, self.length_after), (self.speed_before, self.speed_after)
        return min(2.0 * length / speed for length, speed in zip(lengths, speeds, strict=True) if speed > 0.0)


@dataclass(frozen=True, slots=True)
class Blend:
    """The parabola at a corner.

    Attributes:
        time: ΔT, [s]; 0 if the velocity does not change.
        distance_before, distance_after: d₁ from A' to B and d₂ from B to C', [m].
        entry, exit: A' and C'; shape (k,), [m].
        acceleration: Constant; shape (k,), [m/s²].
        closest_distance, closest_time: Smallest distance from B, [m], and its time since A', [s].
    """

    corner: Corner
    time: float
    distance_before: float
    distance_after: float
    entry: Array
    exit: Array
    acceleration: Array
    closest_distance: float
    closest_time: float

    @property
    def coefficients(self) -> Array:
        """Coefficients of p(t) with t = 0 at A', lowest power first; shape (3, k), [m/sᵏ]."""
        return np.array([self.entry, self.corner.speed_before * self.corner.direction_before, 0.5 * self.acceleration])

    @property
    def motion(self) -> PiecewisePolynomial:
        """Motion from A' to C'; raises ValueError if it takes no time."""
        if self.time == 0.0:
            raise ValueError("a blend of zero time is not a motion")
        return PiecewisePolynomial(np.array([0.0, self.time]), self.coefficients[None])


def corner_of(start: Array, corner: Array, end: Array, speed_before: float, speed_after: float) -> Corner:
    """Measure the legs of A-B-C; raises InvalidField if successive points coincide or both speeds are zero."""
    if speed_before == 0.0 and speed_after == 0.0:
        raise InvalidField("speed_after", "one of the two speeds must be greater than 0: otherwise nothing moves")
    lengths = [math.dist(start, corner), math.dist(corner, end)]
    extent = max(float(np.abs([start, corner, end]).max()), np.finfo(float).tiny)
    for length, field, names in zip(lengths, ("start", "end"), ("A and B", "B and C"), strict=True):
        if length <= 1e-12 * extent:
            raise InvalidField(field, f"{names} are the same point, and a leg between them has no direction")
    before, after = (corner - start) / lengths[0], (end - corner) / lengths[1]
    angle = 2.0 * math.atan2(math.hypot(*(after - before)), math.hypot(*(after + before)))
    turn: Turn = "straight" if angle < STRAIGHT else "reversal" if angle > math.pi - STRAIGHT else "corner"
    return Corner(start, corner, end, speed_before, speed_after, lengths[0], lengths[1], before, after, angle, turn)


def blended(corner: Corner, given: Given, value: float) -> Blend:
    """Return the blend with a given time, distance, radius or acceleration.

    The value, more than 0, is that of ΔT, [s], of d₁, d₂ or the larger of both, [m], or of the acceleration, [m/s²].
    Raises InvalidField if the blend would begin before A or end after C, or if the speed is 0 on the leg of a given
    distance.
    """
    time, longest = _time(corner, given, value), corner.longest_blend_time
    if time > longest * (1.0 + _ROUNDING):
        raise InvalidField(given, _too_long(corner, given, time, longest))
    before, after = 0.5 * corner.speed_before * time, 0.5 * corner.speed_after * time
    share = _closest_share(corner)
    return Blend(
        corner,
        time,
        before,
        after,
        corner.corner - before * corner.direction_before,
        corner.corner + after * corner.direction_after,
        corner.velocity_change / time if time > 0.0 else np.zeros_like(corner.corner),
        _distance_at(corner, time, share),
        share * time,
    )


def _time(corner: Corner, given: Given, value: float) -> float:
    if given == "blend_time":
        return value
    if given == "max_acceleration":
        return math.hypot(*corner.velocity_change) / value
    speeds = {"distance_before": corner.speed_before, "distance_after": corner.speed_after}
    speed = speeds.get(given, max(speeds.values()))
    if speed == 0.0:
        reason = "cannot determine the blend, because the speed on this leg is 0: give another quantity"
        raise InvalidField(given, reason)
    return 2.0 * value / speed


def _too_long(corner: Corner, given: Given, time: float, longest: float) -> str:
    v1, v2 = corner.speed_before, corner.speed_after
    before, after = 0.5 * v1 * time, 0.5 * v2 * time
    what = f"the blend would end {after:g} m after B, and BC is {corner.length_after:g} m long"
    if before / corner.length_before >= after / corner.length_after:
        what = f"the blend would begin {before:g} m before B, and AB is {corner.length_before:g} m long"
    limits = {
        "blend_time": f"at most {longest:g} s",
        "distance_before": f"at most {0.5 * v1 * longest:g} m",
        "distance_after": f"at most {0.5 * v2 * longest:g} m",
        "radius": f"at most {0.5 * max(v1, v2) * longest:g} m",
        "max_acceleration": f"at least {math.hypot(*corner.velocity_change) / longest:g} m/s²",
    }
    return f"{what}; allowed: {limits[given]}"


def _closest_share(corner: Corner) -> float:
    """Return the place in [0, 1] at which the parabola is closest to B.

    With τ = t / ΔT, p - B = ΔT/2 (v₂ τ² K_BC - v₁ (1 - τ)² K_AB), so the slope of the squared distance has the
    sign of v₂² τ³ - v₁² (1 - τ)³ - v₁ v₂ cos α τ (1 - τ)(1 - 2τ). That has exactly one zero: the region that the
    parabola encloses is convex, and B lies outside it.
    """
    v1, v2 = corner.speed_before, corner.speed_after
    if 0.0 in {v1, v2}:
        return 0.0 if v1 == 0.0 else 1.0
    scale, cosine = max(v1, v2), math.cos(corner.angle)
    v1, v2 = v1 / scale, v2 / scale
    low, high = 0.0, 1.0
    while (middle := 0.5 * (low + high)) not in {low, high}:
        rest = 1.0 - middle
        slope = v2 * v2 * middle**3 - v1 * v1 * rest**3 - v1 * v2 * cosine * middle * rest * (rest - middle)
        low, high = (middle, high) if slope < 0.0 else (low, middle)
    return middle


def _distance_at(corner: Corner, time: float, share: float) -> float:
    """Return the distance from B to the parabola at a share of its time, [m]."""
    along = corner.speed_after * share**2 * corner.direction_after
    return 0.5 * time * math.hypot(*(along - corner.speed_before * (1.0 - share) ** 2 * corner.direction_before))
