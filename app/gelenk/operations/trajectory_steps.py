"""The worked solution of a trajectory, segment by segment."""

from typing import cast

import numpy as np

from gelenk.course.cartesian.line_steps import line_derivatives
from gelenk.course.cartesian.segment_steps import (
    JointTask,
    arc_segment_step,
    corner_step,
    joint_steps,
    knots_step,
    moving_step,
    path_law_step,
    tip_spline_step,
    titled,
)
from gelenk.course.steps import Step
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.trajectory.laws.laws import LAWS
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.paths.curves import arc_through
from gelenk.trajectory.problem.problem import Segment, SegmentReport, Trajectory

_SAME = 1e-9
_NO_LENGTH = 1e-9


def trajectory_steps(chain: Chain, segments: tuple[Segment, ...], found: Trajectory) -> list[Step]:
    """Return path, law and corners of each segment that was begun, as planned."""
    laws, steps = dict(found.laws), []
    position = _tip(chain, found.motion, 0.0)
    for report in found.segments:
        segment = segments[report.index]
        if segment.type == "joint" or segment.configurations is not None:
            own = _of_joints(segment, report, found.motion)
            position = _tip(chain, found.motion, report.end_time)
        else:
            law = laws.get(report.index)
            laid = () if law is None else (path_law_step(law, "rad" if report.length == 0.0 else "m"),)
            following = segments[report.index + 1] if report.blend is not None else None
            if following is not None and following.type == "circle":
                following = None  # The step is that of a corner of lines.
            own = (*_of_tip(segment, report, position, following), *laid)
            position = _end(segment)
        steps += titled(own, report.index)
    return steps


def _tip(chain: Chain, motion: PiecewisePolynomial, time: float) -> Array:
    found: Array = chain_poses(chain.flat, motion.at(np.array([time])))[0][0]
    return found


def _end(segment: Segment) -> Array:
    return segment.poses.positions[-1] if segment.poses is not None else cast(Array, segment.pose)[:3, 3]


def _of_joints(segment: Segment, report: SegmentReport, motion: PiecewisePolynomial) -> tuple[Step, ...]:
    begin, end = report.start_time, report.end_time
    if segment.configurations is not None:
        inside = (motion.breaks >= begin - _SAME) & (motion.breaks <= end + _SAME)
        times = motion.breaks[inside]
        return (knots_step(times - begin, motion.derivative().at(times)),)
    start, target = motion.at(np.array([begin, end]))
    if segment.ends is not None:
        ends, count = segment.ends, 1 + LAWS[segment.law].end_rates
        states = (
            (start, ends.start_velocity, ends.start_acceleration),
            (target, ends.end_velocity, ends.end_acceleration),
        )
        return (moving_step([state[:count] for state in states], end - begin),)
    limits = segment.limits
    task = JointTask(start, target, (limits.velocity, limits.acceleration, limits.jerk), end - begin)
    return joint_steps(task, segment.law)


def _of_tip(segment: Segment, report: SegmentReport, start: Array, following: Segment | None) -> tuple[Step, ...]:
    if segment.poses is not None:
        return (tip_spline_step(len(segment.poses)),)
    end = _end(segment)
    if segment.type == "circle":
        return (arc_segment_step(arc_through(start, cast(Array, segment.via)[:3, 3], end)),)
    if np.linalg.norm(end - start) <= _NO_LENGTH:
        return ()
    line = line_derivatives(start, end)
    if following is None or report.blend is None:
        return (line,)
    directions = tuple(way / np.linalg.norm(way) for way in (end - start, _end(following) - end))
    time = report.blend.end_time - report.blend.start_time
    is_smooth = LAWS[segment.law].keeps_jerk and report.blend.acceleration is None
    return line, corner_step(end, (directions[0], directions[1]), report.blend.radius, time, is_smooth=is_smooth)
