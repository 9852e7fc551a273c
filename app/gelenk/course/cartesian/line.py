"""A straight line p(s) = p_i + s (p_f - p_i), s = σ/L, with a time law on σ or, where L = 0, on s itself.

The same line as the motion of a PPP robot, whose axes have limits of their own: no axis arrives before T_j, its own
bang-coast-bang, so that max T_j bounds every path from below. Along the line the axes share s(t), which keeps
v_s = min v_j/|Δ_j| and a_s = min a_j/|Δ_j|: the line takes no more than that bound if one axis sets both.
"""

import math
from dataclasses import dataclass

import numpy as np

from gelenk.course.motion.check import MotionCertificate, MotionClaims, certified
from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.result import Result
from gelenk.trajectory.laws.trapezoid import JointMove, PointToPoint, fastest, point_to_point
from gelenk.trajectory.motion.extremes import peaks_by_order
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.time_laws import between


@dataclass(frozen=True, slots=True)
class LineLaw:
    """The law along a line; speeds in [m/s].

    Attributes:
        max_velocity, acceleration: Of bang-coast-bang, [m/s] and [m/s²]; the velocity may be infinite.
        conditions: Of a polynomial, the derivatives given at each end, counting the position; None for bang-coast-bang.
        duration: T, [s]; the shortest possible if None.
    """

    max_velocity: float
    acceleration: float
    start_velocity: float = 0.0
    end_velocity: float = 0.0
    conditions: int | None = None
    duration: float | None = None
    may_reverse: bool = False


@dataclass(frozen=True, slots=True)
class LineMotion:
    """A motion along a line.

    Attributes:
        start, end: p_i and p_f; shape (k,), [m].
        length: L, [m].
        law: σ(t), one coordinate, [m].
        share: s(t) from 0 to 1, one coordinate.
        planned: The profile of bang-coast-bang; None for a polynomial.
    """

    start: Array
    end: Array
    length: float
    law: PiecewisePolynomial
    share: PiecewisePolynomial
    planned: PointToPoint | None

    @property
    def direction(self) -> Array | None:
        """Unit vector from p_i to p_f, (k,); None if L = 0."""
        return None if self.length == 0.0 else (self.end - self.start) / self.length

    @property
    def motion(self) -> PiecewisePolynomial:
        """p(t); k coordinates, [m]."""
        coefficients = self.share.coefficients * (self.end - self.start)
        coefficients[:, 0] += self.start
        return PiecewisePolynomial(self.share.breaks, coefficients)


def line_move(length: float, law: LineLaw) -> JointMove:
    """Return the motion along a length, [m], as that of one joint."""
    return JointMove(length, law.start_velocity, law.end_velocity, law.max_velocity, law.acceleration)


def along_line(start: Array, end: Array, law: LineLaw) -> LineMotion:
    """Return the motion from p_i to p_f, (k,) each; raises InvalidField if the law is impossible on this length."""
    length = math.dist(start, end)
    if length == 0.0 and (law.start_velocity or law.end_velocity):
        field = "start_velocity" if law.start_velocity else "end_velocity"
        raise InvalidField(field, "`start` and `target` are the same point: a speed has no direction there; allowed: 0")
    if law.conditions is None:
        planned = _bang_coast_bang(length, law)
        way = planned.motion
        share = PiecewisePolynomial(way.breaks, way.coefficients / length if length > 0.0 else way.coefficients)
        return LineMotion(start, end, length, way, share, planned)
    ends = np.zeros((2, law.conditions, 1))
    ends[:, 1, 0] = np.array([law.start_velocity, law.end_velocity]) / (length or 1.0)
    ends[1, 0] = 1.0
    if law.duration is None:
        raise InvalidField("duration", "is needed with a polynomial `law`")
    share = between(ends[0], ends[1], law.duration)
    way = PiecewisePolynomial(share.breaks, share.coefficients * length)
    return LineMotion(start, end, length, way, share, None)


def _bang_coast_bang(length: float, law: LineLaw) -> PointToPoint:
    duration = law.duration if length > 0.0 else None
    try:
        return point_to_point(np.zeros(1), [line_move(length, law)], duration, may_reverse=law.may_reverse)
    except InvalidField as error:
        raise InvalidField(error.field, error.reason.replace("joint 1", "the point")) from None


def line_certificate(found: LineMotion, law: LineLaw) -> MotionCertificate:
    """Recompute p(t) from control points, and its peaks; raises CertificationFailed if an error exceeds rounding."""
    motion, direction = found.motion, found.direction
    if direction is None:
        direction = np.zeros_like(found.start)
    speeds = [law.start_velocity * direction], [law.end_velocity * direction]
    claims = MotionClaims(
        motion.breaks[[0, -1]],
        np.array([found.start, found.end]),
        np.array(speeds[0]),
        np.array(speeds[1]),
        1,
        peaks_by_order(motion, 2),
    )
    return certified(motion, claims)


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
