"""Motion from rest at A past the corner B to rest at C: a trapezoid of speed with a blend in its middle."""

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.course.motion.fly_over import Blend
from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.result import Result
from gelenk.trajectory.laws.trapezoid import JointMove, fastest
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

PhaseName: TypeAlias = Literal["accelerate", "coast_before", "blend", "coast_after", "decelerate"]

_ROUNDING = 1e-12
_RESOLVED = 1e-10
"""Share of the larger speed, and of the path, that the rounding of a time may cost where phases meet."""


@dataclass(frozen=True, slots=True)
class Phase(Result):
    """A part of the motion with constant acceleration.

    Attributes:
        name: What happens in the phase.
        duration: How long it takes, [s]; 0 where it is left out.
    """

    name: PhaseName
    duration: float


@dataclass(frozen=True, slots=True)
class BlendedMotion:
    """The motion over a blended corner, from rest to rest; durations in [s].

    Attributes:
        phases: All five phases, including those of zero duration.
        motion: Position over time; k coordinates, [m].
        stopping_duration: Duration of the same two legs with a stop at B.
    """

    blend: Blend
    phases: tuple[Phase, ...]
    motion: PiecewisePolynomial
    duration: float
    stopping_duration: float


def rest_to_rest(blend: Blend, acceleration: float) -> BlendedMotion:
    """Accelerate along AB, coast, blend, coast along BC, and decelerate; at rest at A and C.

    The acceleration, more than 0, [m/s²], is that when leaving A and approaching C; the blend has its own. Raises
    InvalidField if a leg is too short to reach its speed before the blend or to brake after it, or if a ramp or the
    blend is too short, compared with the whole motion, to resolve the times of its ends.
    """
    corner = blend.corner
    v1, v2 = corner.speed_before, corner.speed_after
    before = _coast("speed_before", v1, corner.length_before, blend.distance_before, acceleration)
    after = _coast("speed_after", v2, corner.length_after, blend.distance_after, acceleration)
    phases = (
        Phase("accelerate", v1 / acceleration),
        Phase("coast_before", before),
        Phase("blend", blend.time),
        Phase("coast_after", after),
        Phase("decelerate", v2 / acceleration),
    )
    legs = ((corner.length_before, v1), (corner.length_after, v2))
    stopping = sum(fastest(JointMove(length, 0.0, 0.0, speed, acceleration)).duration for length, speed in legs)
    _refuse_unresolved(blend, acceleration, phases)
    duration = sum(phase.duration for phase in phases)
    return BlendedMotion(blend, phases, _motion(blend, acceleration, phases), duration, stopping)


def _coast(field: str, speed: float, length: float, taken: float, acceleration: float) -> float:
    """Return how long a leg coasts at its speed between its ramp and the blend, which takes a part of it, [s]."""
    leg = "AB" if field == "speed_before" else "BC"
    if speed == 0.0:
        raise InvalidField(field, f"must be more than 0 in a motion from A to C, which covers all of {leg}")
    ramp = 0.5 * speed * speed / acceleration
    left = length - taken - ramp
    if left < -_ROUNDING * length:
        raise InvalidField(
            field,
            f"{speed:g} m/s takes a ramp of {ramp:g} m at {acceleration:g} m/s², the blend takes {taken:g} m, and "
            f"{leg} is {length:g} m long: the two overlap; lower the speed or the size of the blend, or raise the "
            "acceleration",
        )
    return max(left, 0.0) / speed


def _refuse_unresolved(blend: Blend, acceleration: float, phases: tuple[Phase, ...]) -> None:
    """Refuse phases whose durations differ so much that rounding of their breaks would leave gaps."""
    corner, duration = blend.corner, sum(phase.duration for phase in phases)
    lost = 4.0 * float(np.finfo(float).eps) * duration
    fastest = max(corner.speed_before, corner.speed_after)
    strongest = max(acceleration, math.hypot(*blend.acceleration))
    way = min(corner.length_before, corner.length_after)
    if lost * strongest > _RESOLVED * fastest or lost * fastest > _RESOLVED * way:
        shortest = min(phase.duration for phase in phases if phase.duration > 0.0)
        lasts = f"the shortest phase lasts {shortest:g} s in a motion of {duration:g} s"
        raise InvalidField("rest_acceleration", f"{lasts}: double precision cannot resolve both")


def _motion(blend: Blend, acceleration: float, phases: tuple[Phase, ...]) -> PiecewisePolynomial:
    """Return the phases of nonzero duration, one piece each."""
    corner = blend.corner
    first, second = corner.speed_before * corner.direction_before, corner.speed_after * corner.direction_after
    still = np.zeros_like(first)
    left = corner.start + 0.5 * phases[0].duration * first
    reached = corner.end - 0.5 * phases[4].duration * second
    pieces: tuple[tuple[Array, Array, Array], ...] = (
        (corner.start, still, acceleration * corner.direction_before),
        (left, first, still),
        (blend.entry, first, blend.acceleration),
        (blend.exit, second, still),
        (reached, second, -acceleration * corner.direction_after),
    )
    breaks, coefficients = [0.0], []
    for phase, (position, velocity, change) in zip(phases, pieces, strict=True):
        if breaks[-1] + phase.duration > breaks[-1]:
            breaks.append(breaks[-1] + phase.duration)
            coefficients.append((position, velocity, 0.5 * change))
    return PiecewisePolynomial(np.array(breaks), np.array(coefficients))
