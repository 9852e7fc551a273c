"""Segments along which the tip follows a path: plan the path, the joints that follow it, and the timing."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import cast

import numpy as np

from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.demands import Demands, JointLimits, TipLimits
from gelenk.trajectory.audit.torques import TorqueLimits
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.follow.exact import path_error
from gelenk.trajectory.follow.follow import FollowedPath, follow
from gelenk.trajectory.follow.verdict import Stop
from gelenk.trajectory.laws.laws import LAWS, scaled_law
from gelenk.trajectory.motion.composition import times_at
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.paths.path_geometry import LimitedPath, geometry_of, tip_through
from gelenk.trajectory.paths.segment_paths import SegmentsPath, path_through
from gelenk.trajectory.paths.spline_paths import PolynomialPath
from gelenk.trajectory.problem.parts import PlannedPart, in_field, standing
from gelenk.trajectory.problem.problem import Following, Segment, SegmentLimits, SegmentReport, TrajectoryProblem
from gelenk.trajectory.problem.result import Damping, PlanningFailure, SegmentBlend, TimingComparison
from gelenk.trajectory.timing.timing import Timed, compared, passing_at, timed

_EARLY = 1e-6
"""Fraction of a path by which a motion may end before its obstacle without a remark."""
_ANGLE_SAMPLES = 65
_SLACK = 1.05
"""Factor on the measured deviation due to damping, because the audit samples more finely."""


def tip_part(
    robot: RobotModel,
    chain: Chain,
    start: Array,
    segments: Sequence[Segment],
    first: int,
    problem: TrajectoryProblem,
    stop: Stop | None = None,
) -> PlannedPart:
    """Plan a line, a circle, a spline, or lines each blended into the next, as far as the joints can follow.

    The start has the shape (n,), [rad or m]; `first` is the index of the first segment in the trajectory. The path may
    be given an earlier end, at which it stops.
    `InvalidField` if the path is impossible, or cannot be travelled in the given time.
    """
    positions, rotations = chain_poses(chain.flat, start[None])
    path = path_through(Poses(positions, rotations).matrices()[0], segments, first)
    turn = segments[0].turn
    joints = follow(robot, chain, path.path, start, problem.following, None if turn is None else turn.guide)
    if stop is not None and stop.s < joints.reached:
        joints = joints.until(stop)
    part = _TipPart(chain, problem.following, segments, first, path, joints)
    if joints.reached <= 0.0:
        return PlannedPart(standing(start), (), Demands(), *part.failure())
    timing = part.timed()
    comparison = part.comparison() if problem.compares_timing else None
    demands = part.demands(timing)
    return PlannedPart(timing.motion, part.reports(timing), demands, *part.failure(), comparison, timing.law)


@dataclass(frozen=True)
class _TipPart:
    """A path of the tip and the joints that follow it as far as they can; `first` is its first segment's index."""

    chain: Chain
    following: Following
    segments: Sequence[Segment]
    first: int
    path: SegmentsPath
    joints: FollowedPath

    @property
    def limited(self) -> Sequence[Segment]:
        """The segments, or the ways between waypoints, that have limits of their own."""
        return self.segments[0].ways or self.segments

    @cached_property
    def limits(self) -> SegmentLimits:
        """The loosest limits; `SegmentsPath.zones` has the tighter ones."""
        limits = [one.limits for one in self.limited]
        if len(limits) == 1:
            return limits[0]
        tip = TipLimits(*(max(getattr(one.tip, name) for one in limits) for name in TipLimits.__slots__))
        torque = limits[0].torque
        if torque is not None:
            torque = replace(torque, most=np.max([cast(TorqueLimits, one.torque).most for one in limits], axis=0))
        velocity, acceleration, jerk = np.max([one.joints for one in limits], axis=0)
        return SegmentLimits(velocity, acceleration, jerk, tip, torque)

    @property
    def slows_down(self) -> bool:
        """Whether the tip slows down where its path bends, along a spline and at corners, instead of everywhere."""
        return len(self.segments) > 1 or (self.segments[0].type == "spline" and not self.has_times)

    @property
    def has_times(self) -> bool:
        """Whether the waypoints' times are given; an incomplete path gets the shortest time, whatever the request."""
        return self.segments[0].times is not None and self.joints.stop is None

    @property
    def law(self) -> Law:
        """The law taken: where the tip slows down, the time-optimal one in place of those as smooth."""
        law = self.segments[0].law
        return law if LAWS[law].keeps_jerk or not self.slows_down else "time_optimal"

    @cached_property
    def geometry(self) -> LimitedPath:
        motion, path = tip_through(self.chain), self.path
        return geometry_of(path.path, self.joints.positions, self.limits, motion, path.zones)

    def timed(self) -> Timed:
        segment = self.segments[0]
        with in_field(f"segments.{self.first}"):
            if self.has_times:
                knots = cast(PolynomialPath, self.path.path).knots[1:]
                return passing_at(self.geometry, knots, cast(Array, segment.times))
            duration = segment.duration if self.joints.stop is None else None
            return timed(self.geometry, segment.law, duration=duration, slow_down=self.slows_down)

    def comparison(self) -> TimingComparison:
        law = scaled_law(self.segments[0].law)
        numbers = compared(self.geometry, law)
        return TimingComparison(tuple(range(self.first, self.first + len(self.segments))), law, *numbers)

    def demands(self, timing: Timed) -> Demands:
        """Return the requirements on the motion, which include the pose of the tip at each time."""
        law, joints, limits, following = timing.law, self.joints, self.limits, self.following
        position, orientation = following.position_tolerance, following.orientation_tolerance
        if following.near_singularity == "damp":
            position = max(position, _SLACK * joints.path_deviation)
            orientation = max(orientation, _SLACK * joints.orientation_deviation)
        start, end = joints.positions.at(np.array([0.0, joints.reached]))
        stated = [one.stated_jerk for one in self.limited]
        return Demands(
            JointLimits(limits.velocity, limits.acceleration, limits.jerk),
            limits.tip,
            (start, end),
            lambda times: self.path.path.at(np.clip(law.at(times)[:, 0], 0.0, joints.reached)).poses,
            following.task,
            position,
            orientation,
            timing.continuous,
            tuple(
                zone.between(*self._times_at(law, [zone.begin, zone.end]))
                for zone in self.path.zones
                if zone.begin < joints.reached
            ),
            timing.has_bounded_jerk,
            None if any(one is None for one in stated) else np.max(cast(list[Array], stated), axis=0),
            path_error(joints.positions, joints.bend_errors, timing, self.geometry),
            torque=limits.torque,
        )

    def failure(self) -> tuple[PlanningFailure | None, float]:
        """Return why the path could not continue, if it is incomplete, and the completed share of the last segment."""
        stop, reached, extent = self.joints.stop, self.joints.reached, self.path.path.extent
        if stop is None:
            return None, 1.0
        ends = np.array([0.0, *self.path.ends])
        i = int(np.clip(np.searchsorted(ends, reached, side="right") - 1, 0, len(ends) - 2))
        width = ends[i + 1] - ends[i]
        share = float((reached - ends[i]) / width) if width > 0.0 else 0.0
        detail = stop.detail
        if stop.s > reached + _EARLY * extent:
            detail += (
                f"; the motion ends before, at {100.0 * reached / extent:.4f}% of the path, where the smallest "
                f"singular value falls to {self.following.min_singular_value:g}"
            )
        return PlanningFailure(
            stop.reason, self.first + i, 0.0, tuple(stop.position.tolist()), stop.joint, detail
        ), share

    def reports(self, timing: Timed) -> tuple[SegmentReport, ...]:
        path, joints = self.path, self.joints
        deviation = Damping(joints.path_deviation, joints.orientation_deviation)
        damped = self.following.near_singularity == "damp" and deviation.distance > self.following.position_tolerance
        ends = np.minimum([0.0, *path.ends], joints.reached)
        count = max(1, int(np.count_nonzero(ends[:-1] < joints.reached)))
        times, travelled = self._times_at(timing.law, ends), self._travelled(ends[: count + 1])
        return tuple(
            SegmentReport(
                self.first + i,
                segment.type,
                self.law,
                times[i],
                times[i + 1],
                *travelled[i],
                deviation if damped else None,
                i + 1 < len(self.segments),
                self._blend(i, timing.law),
                (*path.notes, *timing.notes),
            )
            for i, segment in enumerate(self.segments[:count])
        )

    def _blend(self, i: int, law: PiecewisePolynomial) -> SegmentBlend | None:
        if i == len(self.path.corners) or self.path.corners[i].begin >= self.joints.reached:
            return None
        corner = self.path.corners[i]
        limit = corner.acceleration if math.isfinite(corner.acceleration) else None
        begin, end = self._times_at(law, [corner.begin, corner.end])
        return SegmentBlend(corner.radius, begin, end, limit)

    def _travelled(self, ends: Array) -> list[tuple[float, float]]:
        """Return the lengths of the position's and the orientation's path between places, [m] and [rad]."""
        path, s = self.path.path, np.linspace(ends[:-1], ends[1:], _ANGLE_SAMPLES, axis=1)
        rates = np.linalg.norm(path.at(s.ravel()).first[:, 3:], axis=1).reshape(s.shape)
        lengths = np.diff(ends) if path.unit == "m" else np.zeros(len(s))
        return list(zip(lengths.tolist(), np.trapezoid(rates, s, axis=1).tolist(), strict=True))

    def _times_at(self, law: PiecewisePolynomial, at: Sequence[float] | Array) -> list[float]:
        """Return when a law that never goes backwards is at places, or at its end before them, [s]."""
        places = np.minimum(at, self.joints.reached)
        first, last = law.at(law.breaks[[0, -1]])[:, 0]
        # Near rest, a rounding error in s is a large error in time.
        rounding = 8.0 * np.spacing(last)
        times = np.where(places <= first + rounding, law.breaks[0], law.breaks[-1])
        inside = (places > first + rounding) & (places < last - rounding)
        if inside.any():
            times[inside] = times_at(law, places[inside])
        found: list[float] = times.tolist()
        return found
