"""Joint motion through waypoints along a cubic spline, at rest at both ends.

A `clamped` or `assigned` spline is at rest at its ends by itself: it is a motion in time. Another spline is a
path q(u), and a time law s(t) leads from rest to rest along it, q(s(t)). Meaning of the laws:

- `cubic`, `trapezoidal` on a clamped or assigned spline: the spline in time, all times multiplied by the k that just
  keeps the limits of velocity and acceleration. (Since q' = 0 at the ends, the limits would let a trapezoid along
  the path reach its speed at once.) On other splines: that law along the path.
- `quintic`, `septic`, `jerk_limited`: that law along the path, which also keeps jerk limits.
- `time_optimal`: the fastest motion along the path under the limits of velocity and acceleration.

With `times` a clamped or assigned spline takes exactly these; they are then the time law. Laws whose promise they
cannot keep are refused: `time_optimal` always, and `jerk_limited` on a clamped spline, whose acceleration jumps at both
ends.
"""

from dataclasses import dataclass, replace

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.trajectory.joints.excess import LimitExcess, first_limit_excess
from gelenk.trajectory.joints.motion import ROUNDING, check_duration, kept_limits, lasting, timings
from gelenk.trajectory.joints.waypoints import Knots, check_closed, check_within, knots
from gelenk.trajectory.laws.laws import LAWS
from gelenk.trajectory.laws.time_scaling import Scaling, check_limits, uniform_scaling
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import cubic_spline
from gelenk.trajectory.paths.path_geometry import geometry_of
from gelenk.trajectory.problem.parts import standing
from gelenk.trajectory.problem.problem import Segment
from gelenk.trajectory.timing.time_optimal import time_optimal
from gelenk.trajectory.timing.timing import Timings, compared, timed
from gelenk.trajectory.timing.torque_constraints import optimal_within

_AT_REST = ("clamped", "assigned")
"""Boundaries of splines that are at rest at both ends."""
_STILL = 1e-12
"""Largest q' at an end that counts as rest, in fractions of the steepest step."""


@dataclass(frozen=True, slots=True)
class JointSpline:
    """The spline through the waypoints of a segment; the module explains its law, times and boundary.

    Between waypoints it can exceed joint limits: check with `first_limit_excess`. `points` are the start and the
    waypoints, with their times or, without times, spaced; `path` is the spline q(u) without its time law.
    """

    segment: Segment
    points: Knots
    path: PiecewisePolynomial

    @classmethod
    def of(cls, start: Array, segment: Segment, chain: Chain) -> "JointSpline":
        """Return the spline of a segment with `configurations`, from a start of shape (n,), [rad or m].

        `InvalidField` if there is none, its times are impossible, or a waypoint is outside limits.
        """
        check_limits(segment.limits.joints)
        check_duration(segment.duration)
        points = knots(start, segment.configurations, segment.times, segment.limits.velocity)
        check_within(chain, points.positions[1:], "waypoints.{}")
        check_closed(points.positions, segment.boundary)
        if segment.times is not None:
            _check_law_of_times(segment)
        return cls._through(segment, points)

    @classmethod
    def _through(cls, segment: Segment, points: Knots) -> "JointSpline":
        return cls(segment, points, cubic_spline(points.times, points.positions, segment.boundary).motion)

    def motion(self) -> PiecewisePolynomial:
        """Return the motion from time 0 on, at rest at both ends.

        `InvalidField` if times or duration are too short; `TooLarge` with too many pieces for the fastest motion.
        """
        segment = self.segment
        if segment.times is None:
            motion = self._fastest()
            if segment.duration is None:
                return motion
            return lasting(motion, segment.duration, segment.law, segment.limits)
        scaling = self._scaling_at_times()
        if scaling.course_factor > 1.0 + ROUNDING:
            bound = scaling.binding
            raise InvalidField(
                "times",
                f"joint {bound.joint} reaches {bound.ratio:.6g} times its limit of {bound.quantity} at "
                f"{bound.time:.6g} s: to keep the limits, multiply all times by {scaling.course_factor:.10g}",
            )
        return self.path

    def timings(self) -> Timings:
        """Compare the law of a segment without `times` with the fastest motion along the same path."""
        limits = self.segment.limits
        if not self._is_scaled():
            return compared(geometry_of(None, self.path, limits), self.segment.law)
        optimal = time_optimal(self.path, limits.velocity, limits.acceleration).motion.duration
        return timings(self._fastest(), limits, optimal)

    def prefix(self, chain: Chain, excess: LimitExcess) -> tuple[PiecewisePolynomial, int]:
        """Plan through as many waypoints before `excess` as a spline passes within joint limits, and count them.

        The spline ends at rest at the last of them. Part of a periodic spline gets a natural boundary; part of a spline
        at given times is slowed down if its stop would exceed the limits.
        """
        before = int(np.searchsorted(self.points.times, excess.time, side="right")) - 1
        most = min(before, len(self.points.times) - 2)
        boundary = "natural" if self.segment.boundary == "periodic" else self.segment.boundary
        shorter = replace(self.segment, boundary=boundary, duration=None)
        for count in range(most, 0, -1):
            points = Knots(self.points.times[: count + 1], self.points.positions[: count + 1])
            part = JointSpline._through(shorter, points)
            if first_limit_excess(chain, part.path) is None:
                if shorter.times is None:
                    return part._fastest(), count
                return part.path.scaled(part._scaling_at_times().course_factor), count
        return standing(self.points.positions[0]), 0

    def _is_scaled(self) -> bool:
        if not LAWS[self.segment.law].scales_splines:
            return False
        path = self.path
        chords = np.diff(path.at(path.breaks), axis=0) / np.diff(path.breaks)[:, None]
        ends = path.derivative().at(path.breaks[[0, -1]])
        return bool(np.abs(ends).max(initial=0.0) <= _STILL * np.abs(chords).max(initial=0.0))

    def _scaling_at_times(self) -> Scaling:
        """Return the scaling of the spline in time; jerk is limited only if acceleration does not jump at its ends."""
        law = self.segment.law if self.segment.boundary == "assigned" else "cubic"
        return uniform_scaling(self.path, kept_limits(law, self.segment.limits))

    def _fastest(self) -> PiecewisePolynomial:
        law, limits = self.segment.law, self.segment.limits
        if self._is_scaled():
            return self.path.scaled(uniform_scaling(self.path, kept_limits(law, limits)).factor or 1.0)
        if law == "time_optimal":
            return optimal_within(geometry_of(None, self.path, limits)).motion
        return timed(geometry_of(None, self.path, limits), law).motion


def promised(segment: Segment) -> tuple[int, bool]:
    """Return how smooth the motion of a joint segment is, for a spline or from point to point.

    The first number is the order up to which its derivatives do not jump within it; the flag tells whether acceleration
    jumps neither within it nor at its ends, and jerk is limited.
    """
    law = LAWS[segment.law]
    if segment.blends:
        return 1, False
    if segment.times is not None:
        return 2, law.keeps_jerk and segment.boundary == "assigned"
    is_scaled = segment.configurations is not None and law.scales_splines and segment.boundary in _AT_REST
    return 2 if law.keeps_jerk or is_scaled else 1, law.keeps_jerk


def _check_law_of_times(segment: Segment) -> None:
    if segment.boundary not in _AT_REST:
        raise InvalidField(
            "boundary",
            f"with `times` a `{segment.boundary}` spline would neither start nor end at rest: leave `times` out, so "
            "that a time law leads from rest to rest, or take `clamped` or `assigned`",
        )
    if segment.duration is not None:
        raise InvalidField("duration", "is not allowed beside `times`, which determine it")
    if segment.law == "time_optimal":
        raise InvalidField("times", "are not allowed with the law `time_optimal`, which finds them")
    if segment.law == "jerk_limited" and segment.boundary == "clamped":
        raise InvalidField(
            "boundary",
            "at given `times` the acceleration of a `clamped` spline jumps at both ends, which the law `jerk_limited` "
            "forbids: take `assigned`, or leave `times` out",
        )
