"""Segments along which the tip follows a path: the path, the joints that follow it, and the time they take."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import numpy as np

from gelenk.kinematics.kernels import chain_poses
from gelenk.model.arrays import Array
from gelenk.model.chain import Chain
from gelenk.model.errors import InvalidField
from gelenk.model.poses import Poses
from gelenk.model.robot import Robot
from gelenk.trajectory.audit_demands import Demands, Ends, JointLimits, Stretch, TipLimits, WayError
from gelenk.trajectory.composition import times_at
from gelenk.trajectory.follow import JointWay, follow
from gelenk.trajectory.follow_exact import way_error
from gelenk.trajectory.parts import Halt, Part, standing
from gelenk.trajectory.passing_times import passing_at
from gelenk.trajectory.paths import Path
from gelenk.trajectory.polynomial import PiecewisePolynomial
from gelenk.trajectory.problem import (
    BlendReport,
    Following,
    MotionLimits,
    Problem,
    Segment,
    SegmentReport,
    TimingComparison,
)
from gelenk.trajectory.spline_paths import PolynomialPath
from gelenk.trajectory.time_scaling import QUANTITIES
from gelenk.trajectory.timing import Timed, compared, timed
from gelenk.trajectory.way_geometry import Zone, tip_through
from gelenk.trajectory.ways import Way, way_of
from gelenk.trajectory.words import Law

_DONE = 1e-9
"""Share of a segment that may be missing from one that counts as done."""
_EARLY = 1e-6
"""Share of a path by which a motion can end before what ends it, without a word."""
_ANGLE_SAMPLES = 65
_SLACK = 1.05
"""The audit looks more closely than what measured the deviation that damping costs."""


def tip_part(
    robot: Robot, chain: Chain, start: Array, segments: Sequence[Segment], first: int, problem: Problem
) -> Part:
    """A line, a circle, a spline, or lines that are blended, as far as the joints can follow.

    Args:
        robot: The robot.
        chain: What moves.
        start: Configuration at its beginning; shape (n,), [rad or m].
        segments: One, or lines all but the last of which are blended into the next.
        first: Number of the first in the trajectory.
        problem: Whose segments they are.

    Raises:
        InvalidField: There is no such path, or not in the time that is given.
    """
    following = problem.following
    positions, rotations = chain_poses(chain.flat, start[None])
    way = way_of(Poses(positions, rotations).matrices()[0], segments, first)
    joints = follow(robot, chain, way.path, start, following)
    halt = _halt(joints, way, first, following)
    limits = tightest([segment.limits for segment in segments])
    if joints.reached <= 0.0:
        return Part(standing(start), (), Demands(), halt)
    timing = _timed(chain, way, joints, segments, limits, first)
    blends = _blends(way, joints, timing.law)
    stretches = _stretches(way.zones(segments), joints, timing.law)
    demands = _demands(way.path, joints, timing, limits, following, stretches)
    demands = replace(demands, stated_jerk=_stated(segments), way_error=_way_error(joints, timing, limits))
    comparison = _comparison(chain, way, joints, segments, limits, first) if problem.compares_timing else None
    reports = _reports(way, joints, timing, segments, first, following, blends)
    return Part(timing.motion, reports, demands, halt, comparison)


def tightest(limits: Sequence[MotionLimits]) -> MotionLimits:
    """What keeps to all of several limits of joints; of the tip those that all keep to, `Way.zones` has the others."""
    if len(limits) == 1:
        return limits[0]
    tip = TipLimits(*(max(getattr(one.tip, name) for one in limits) for name in TipLimits.__slots__))
    velocity, acceleration, jerk = (
        np.min([getattr(one, name) for one in limits], axis=0) for name in ("velocity", "acceleration", "jerk")
    )
    return MotionLimits(velocity, acceleration, jerk, tip)


def _stated(segments: Sequence[Segment]) -> Array | None:
    """The limits of jerk that were requested."""
    stated = [one.stated_jerk for one in segments if one.stated_jerk is not None]
    return np.min(stated, axis=0) if stated else None


def _timed(
    chain: Chain,
    way: Way,
    joints: JointWay,
    segments: Sequence[Segment],
    limits: MotionLimits,
    first: int,
) -> Timed:
    """The law of time; of a path that is not done wholly the fastest there is."""
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


def _blends(way: Way, joints: JointWay, law: PiecewisePolynomial) -> list[BlendReport]:
    """The blends that the motion reaches."""
    blends = []
    for corner in way.corners:
        if corner.begin >= joints.reached:
            break
        times = _times_at(law, corner.begin, min(corner.end, joints.reached))
        limit = corner.acceleration if math.isfinite(corner.acceleration) else None
        blends.append(BlendReport(corner.radius, *times, limit))
    return blends


def _stretches(zones: Sequence[Zone], joints: JointWay, law: PiecewisePolynomial) -> tuple[Stretch, ...]:
    """When the motion is where the tip has limits of its own."""
    return tuple(
        Stretch(*_times_at(law, zone.begin, min(zone.end, joints.reached)), zone.tip)
        for zone in zones
        if zone.begin < joints.reached
    )


def _demands(
    path: Path,
    joints: JointWay,
    timing: Timed,
    limits: MotionLimits,
    following: Following,
    stretches: tuple[Stretch, ...],
) -> Demands:
    """What the motion must keep; at equal times its path is the wanted one."""
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


def _way_error(joints: JointWay, timing: Timed, limits: MotionLimits) -> WayError:
    """How far the motion is from the exact path; None for one that leaves its path."""
    if joints.bend_errors is None:
        return WayError(math.inf, math.inf, math.inf)
    return way_error(joints.positions, joints.bend_errors, timing, limits)


def _halt(joints: JointWay, way: Way, first: int, following: Following) -> Halt | None:
    """The place where the path could not continue, as a share of the segment there."""
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
    way: Way,
    joints: JointWay,
    timing: Timed,
    segments: Sequence[Segment],
    first: int,
    following: Following,
    blends: Sequence[BlendReport],
) -> tuple[SegmentReport, ...]:
    """Reports of the segments that were started."""
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
            (joints.path_deviation, joints.orientation_deviation) if damped else None,
            i + 1 < len(segments),
            blends[i] if i < len(blends) else None,
            (*way.notes, *_of_corners(segments), *timing.notes),
        )
        reports.append(report)
    return tuple(reports)


def _slows_at_corners(segments: Sequence[Segment]) -> bool:
    """Whether a corner is to slow down the tip there alone: bang-coast-bang on each line, and through each corner."""
    return len(segments) > 1 and segments[0].law == "trapezoidal"


def _of_corners(segments: Sequence[Segment]) -> tuple[str, ...]:
    """Whose limits of joints hold on blended lines."""
    if len(segments) == 1:
        return ()
    limits = [segment.limits for segment in segments]
    notes = []
    if not all(np.array_equal(getattr(one, name), getattr(limits[0], name)) for one in limits for name in QUANTITIES):
        notes.append("the limits of joints differ among blended lines: the tightest of each joint holds on all of them")
    return tuple(notes)


def _travelled(path: Path, begin: float, end: float) -> tuple[float, float]:
    """Length of the position's path and angle of the orientation's between two places, [m] and [rad]."""
    s = np.linspace(begin, end, _ANGLE_SAMPLES)
    rates = path.at(s).first
    length = end - begin if path.unit == "m" else 0.0
    return length, float(np.trapezoid(np.linalg.norm(rates[:, 3:], axis=1), s))


def _times_at(law: PiecewisePolynomial, begin: float, finish: float) -> tuple[float, float]:
    """When a law that never goes back is at two places, at its ends to the last digit, [s]."""
    places = np.array([begin, finish])
    first, last = law.at(law.breaks[[0, -1]])[:, 0]
    # At rest a place of rounding beside the end is a time well before it.
    rounding = 8.0 * np.spacing(last)
    times = np.where(places <= first + rounding, law.breaks[0], law.breaks[-1])
    inside = (places > first + rounding) & (places < last - rounding)
    if inside.any():
        times[inside] = times_at(law, places[inside])
    return float(times[0]), float(times[1])


def _comparison(
    chain: Chain, way: Way, joints: JointWay, segments: Sequence[Segment], limits: MotionLimits, first: int
) -> TimingComparison:
    # The course scales the cubic: what is time-optimal has nothing to be compared with in itself.
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
