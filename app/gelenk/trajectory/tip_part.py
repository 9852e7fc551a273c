"""Segments along which the tip follows a path: plan the path, the joints that follow it, and the timing."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import numpy as np

from gelenk.errors import InvalidField
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.demands import Demands, Ends, JointLimits, LimitedInterval, TipLimits
from gelenk.trajectory.audit.result import PathError
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.follow.exact import path_error
from gelenk.trajectory.follow.follow import FollowedPath, follow
from gelenk.trajectory.laws.time_scaling import QUANTITIES
from gelenk.trajectory.motion.composition import times_at
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.paths.path_geometry import Zone, tip_through
from gelenk.trajectory.paths.paths import Path
from gelenk.trajectory.paths.segment_paths import SegmentsPath, path_through
from gelenk.trajectory.paths.spline_paths import PolynomialPath
from gelenk.trajectory.problem.parts import Halt, PlannedPart, standing
from gelenk.trajectory.problem.problem import Following, Segment, SegmentLimits, SegmentReport, TrajectoryProblem
from gelenk.trajectory.problem.result import Damping, SegmentBlend, TimingComparison
from gelenk.trajectory.timing.passing_times import passing_at
from gelenk.trajectory.timing.timing import Timed, compared, timed

_DONE = 1e-9
"""Fraction of a segment that may be missing if it is to count as completed."""
_EARLY = 1e-6
"""Fraction of a path by which a motion may end before its obstacle without a remark."""
_ANGLE_SAMPLES = 65
_SLACK = 1.05
"""Factor on the measured deviation due to damping, because the audit samples more finely."""


def tip_part(
    robot: RobotModel, chain: Chain, start: Array, segments: Sequence[Segment], first: int, problem: TrajectoryProblem
) -> PlannedPart:
    """Plan a line, a circle, a spline, or blended lines, as far as the joints can follow.

    Args:
        robot: The robot.
        chain: Chain that moves.
        start: Start configuration; shape (n,), [rad or m].
        segments: One segment, or lines that are each blended into the next.
        first: Index of the first segment in the trajectory.
        problem: Request that contains the segments.

    Raises:
        InvalidField: The path is impossible, or cannot be travelled in the given time.
    """
    following = problem.following
    positions, rotations = chain_poses(chain.flat, start[None])
    way = path_through(Poses(positions, rotations).matrices()[0], segments, first)
    joints = follow(robot, chain, way.path, start, following)
    halt = _halt(joints, way, first, following)
    limits = tightest([segment.limits for segment in segments])
    if joints.reached <= 0.0:
        return PlannedPart(standing(start), (), Demands(), halt)
    timing = _timed(chain, way, joints, segments, limits, first)
    blends = _blends(way, joints, timing.law)
    stretches = _stretches(way.zones(segments), joints, timing.law)
    demands = _demands(way.path, joints, timing, limits, following, stretches)
    demands = replace(demands, stated_jerk=_stated(segments), way_error=_path_error(joints, timing, limits))
    comparison = _comparison(chain, way, joints, segments, limits, first) if problem.compares_timing else None
    reports = _reports(way, joints, timing, segments, first, following, blends)
    return PlannedPart(timing.motion, reports, demands, halt, comparison)


def tightest(limits: Sequence[SegmentLimits]) -> SegmentLimits:
    """Return the tightest joint limits and the loosest tip limits of several; `SegmentsPath.zones` has tighter ones."""
    if len(limits) == 1:
        return limits[0]
    tip = TipLimits(*(max(getattr(one.tip, name) for one in limits) for name in TipLimits.__slots__))
    velocity, acceleration, jerk = (
        np.min([getattr(one, name) for one in limits], axis=0) for name in ("velocity", "acceleration", "jerk")
    )
    return SegmentLimits(velocity, acceleration, jerk, tip)


def _stated(segments: Sequence[Segment]) -> Array | None:
    """Return the tightest requested jerk limits, shape (n,); None if none were requested."""
    stated = [one.stated_jerk for one in segments if one.stated_jerk is not None]
    return np.min(stated, axis=0) if stated else None


def _timed(
    chain: Chain,
    way: SegmentsPath,
    joints: FollowedPath,
    segments: Sequence[Segment],
    limits: SegmentLimits,
    first: int,
) -> Timed:
    """Time the path; an incomplete path gets the shortest time, whatever the request."""
    is_whole = joints.stop is None
    segment = segments[0]
    try:
        if segment.times is not None and is_whole:
            places = cast(PolynomialPath, way.path).knots[1:]
            return passing_at(way.path, joints.positions, places, segment.times, limits, tip_through(chain))
        return timed(
            way.path,
            joints.positions,
            segment.law,
            limits,
            duration=segment.duration if is_whole else None,
            slow_down=_slows_at_corners(segments),
            tip_motion=tip_through(chain),
            zones=way.zones(segments),
            corners=way.edges,
        )
    except InvalidField as error:
        raise InvalidField(f"segments.{first}.{error.field}", error.reason) from error


def _blends(way: SegmentsPath, joints: FollowedPath, law: PiecewisePolynomial) -> list[SegmentBlend]:
    """Return reports of the blends that the motion reaches."""
    blends = []
    for corner in way.corners:
        if corner.begin >= joints.reached:
            break
        times = _times_at(law, corner.begin, min(corner.end, joints.reached))
        limit = corner.acceleration if math.isfinite(corner.acceleration) else None
        blends.append(SegmentBlend(corner.radius, *times, limit))
    return blends


def _stretches(zones: Sequence[Zone], joints: FollowedPath, law: PiecewisePolynomial) -> tuple[LimitedInterval, ...]:
    """Return the time intervals in which the tip has its own limits."""
    return tuple(
        LimitedInterval(*_times_at(law, zone.begin, min(zone.end, joints.reached)), zone.tip)
        for zone in zones
        if zone.begin < joints.reached
    )


def _demands(
    path: Path,
    joints: FollowedPath,
    timing: Timed,
    limits: SegmentLimits,
    following: Following,
    stretches: tuple[LimitedInterval, ...],
) -> Demands:
    """Return the requirements on the motion, which include the pose of the tip at each time."""
    law = timing.law
    position, orientation = following.position_tolerance, following.orientation_tolerance
    if following.near_singularity == "damp":
        position = max(position, _SLACK * joints.path_deviation)
        orientation = max(orientation, _SLACK * joints.orientation_deviation)
    last = joints.positions.at(np.array([joints.reached]))[0]
    return Demands(
        JointLimits(limits.velocity, limits.acceleration, limits.jerk),
        limits.tip,
        Ends(joints.positions.at(np.zeros(1))[0], last),
        lambda times: path.at(np.clip(law.at(times)[:, 0], 0.0, joints.reached)).poses,
        following.task,
        position,
        orientation,
        timing.continuous,
        stretches,
        timing.has_bounded_jerk,
    )


def _path_error(joints: FollowedPath, timing: Timed, limits: SegmentLimits) -> PathError:
    """Bound how much ratios to limits differ from those of the exact path; None if unknown, as off the path."""
    if joints.bend_errors is None:
        return PathError(None, None, None)
    return path_error(joints.positions, joints.bend_errors, timing, limits)


def _halt(joints: FollowedPath, way: SegmentsPath, first: int, following: Following) -> Halt | None:
    """Return where and why the path could not continue; None if it is complete."""
    stop = joints.stop
    if stop is None:
        return None
    ends = np.array([0.0, *way.ends])
    i = int(np.clip(np.searchsorted(ends, joints.reached, side="right") - 1, 0, len(ends) - 2))
    width = ends[i + 1] - ends[i]
    share = float((joints.reached - ends[i]) / width) if width > 0.0 else 0.0
    detail = stop.detail
    if stop.s > joints.reached + _EARLY * way.path.extent:
        detail += (
            f"; the motion ends before, at {100.0 * joints.reached / way.path.extent:.4f}% of the path, where the "
            f"smallest singular value falls to {following.min_singular_value:g}"
        )
    return Halt(stop.reason, first + i, share, stop.position, stop.joint, detail)


def _reports(
    way: SegmentsPath,
    joints: FollowedPath,
    timing: Timed,
    segments: Sequence[Segment],
    first: int,
    following: Following,
    blends: Sequence[SegmentBlend],
) -> tuple[SegmentReport, ...]:
    """Return reports of the segments that were started."""
    begins = (0.0, *way.ends[:-1])
    damped = following.near_singularity == "damp" and joints.path_deviation > following.position_tolerance
    reports = []
    for i, (segment, begin, end) in enumerate(zip(segments, begins, way.ends, strict=True)):
        if begin >= joints.reached:
            break
        finish = min(end, joints.reached)
        begun, done = _times_at(timing.law, begin, finish)
        length, angle = _travelled(way.path, begin, finish)
        report = SegmentReport(
            first + i,
            segment.type,
            "time_optimal" if _slows_at_corners(segments) else segment.law,
            begun,
            done,
            length,
            angle,
            Damping(joints.path_deviation, joints.orientation_deviation) if damped else None,
            i + 1 < len(segments),
            blends[i] if i < len(blends) else None,
            (*way.notes, *_of_corners(segments), *timing.notes),
        )
        reports.append(report)
    return tuple(reports)


def _slows_at_corners(segments: Sequence[Segment]) -> bool:
    """Return whether a corner slows the tip down only there: accelerate, coast and brake on each line and corner."""
    return len(segments) > 1 and segments[0].law == "trapezoidal"


def _of_corners(segments: Sequence[Segment]) -> tuple[str, ...]:
    """Return a note on the joint limits if they differ among blended lines."""
    if len(segments) == 1:
        return ()
    limits = [segment.limits for segment in segments]
    notes = []
    if not all(np.array_equal(getattr(one, name), getattr(limits[0], name)) for one in limits for name in QUANTITIES):
        notes.append("the limits of joints differ among blended lines: the tightest of each joint holds on all of them")
    return tuple(notes)


def _travelled(path: Path, begin: float, end: float) -> tuple[float, float]:
    """Return the length of the position's path and the angle of the orientation's between two places, [m] and [rad]."""
    s = np.linspace(begin, end, _ANGLE_SAMPLES)
    rates = path.at(s).first
    length = end - begin if path.unit == "m" else 0.0
    return length, float(np.trapezoid(np.linalg.norm(rates[:, 3:], axis=1), s))


def _times_at(law: PiecewisePolynomial, begin: float, finish: float) -> tuple[float, float]:
    """Return when a law that never goes backwards is at two places, exact at its ends, [s]."""
    places = np.array([begin, finish])
    first, last = law.at(law.breaks[[0, -1]])[:, 0]
    # Near rest, a rounding error in s is a large error in time.
    rounding = 8.0 * np.spacing(last)
    times = np.where(places <= first + rounding, law.breaks[0], law.breaks[-1])
    inside = (places > first + rounding) & (places < last - rounding)
    if inside.any():
        times[inside] = times_at(law, places[inside])
    return float(times[0]), float(times[1])


def _comparison(
    chain: Chain,
    way: SegmentsPath,
    joints: FollowedPath,
    segments: Sequence[Segment],
    limits: SegmentLimits,
    first: int,
) -> TimingComparison:
    # As in the course, scale the cubic: comparing the time-optimal law with itself would say nothing.
    law: Law = "cubic" if segments[0].law == "time_optimal" else segments[0].law
    uniform, by_velocity, by_acceleration, optimal = compared(
        way.path,
        joints.positions,
        law,
        limits,
        tip_motion=tip_through(chain),
        zones=way.zones(segments),
        corners=way.edges,
    )
    numbers = tuple(range(first, first + len(segments)))
    return TimingComparison(numbers, law, uniform, by_velocity, by_acceleration, optimal)
