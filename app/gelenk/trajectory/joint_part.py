"""Segments in joint space: to a configuration, to a pose by inverse kinematics, or through waypoints."""

import math
from contextlib import suppress
from dataclasses import replace
from typing import cast

import numpy as np

from gelenk.errors import InvalidField
from gelenk.ik.closed.closed_form import closed_form
from gelenk.ik.search.problem import Options, TargetProblem
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import Status
from gelenk.ik.solve import solve
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.demands import Demands, JointLimits
from gelenk.trajectory.audit.pieces import pieces_of
from gelenk.trajectory.audit.tip import tip_peaks
from gelenk.trajectory.audit.words import StopReason
from gelenk.trajectory.joints.excess import first_limit_excess
from gelenk.trajectory.joints.motion import compared_point_to_point, point_to_point_motion
from gelenk.trajectory.joints.moving_ends import given_rates, moving_motion
from gelenk.trajectory.joints.splines import JointSpline, promised
from gelenk.trajectory.joints.via_blends import via_blends
from gelenk.trajectory.joints.waypoints import check_within
from gelenk.trajectory.joints.ways import fastest_way
from gelenk.trajectory.laws.laws import LAWS, scaled_law
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import EndRates
from gelenk.trajectory.problem.parts import PlannedPart, in_field, standing
from gelenk.trajectory.problem.problem import Segment, SegmentReport, TrajectoryProblem
from gelenk.trajectory.problem.result import PlanningFailure, TimingComparison
from gelenk.trajectory.timing.torque_constraints import torque_factor

_REASONS: dict[Status, StopReason] = {
    "unreachable": "out_of_reach",
    "outside_limits": "joint_limit",
    "singular": "singularity",
    "not_converged": "out_of_reach",
    "in_collision": "collision",
}
_MARGIN = 1e-9
"""Extra slowdown, because the sampled peaks of the tip may be slightly too low."""
_LONGER, _MOST_TRIES = 1.05, 10
"""Least factor from one duration to the next that is tried for limits of torque between moving ends, and how many."""


def joint_part(
    robot: RobotModel, chain: Chain, start: Array, segment: Segment, index: int, problem: TrajectoryProblem
) -> PlannedPart:
    """Plan a joint segment, number `index`, as far as it is possible, from a configuration of shape (n,), [rad or m].

    It is of type `joint`, or a spline through configurations. `InvalidField` if there is no such motion, or not in the
    given time.
    """
    target = segment.configuration
    if segment.configurations is None and target is None:
        found = _solved(robot, chain, start, segment, index, problem)
        if isinstance(found, PlanningFailure):
            return PlannedPart(standing(start), (), Demands(), found, 0.0)
        target = found
    if segment.ends is None or segment.duration is not None or len(problem.segments) > 1:
        with in_field(f"segments.{index}"):
            return _planned(chain, start, target, segment, index, problem)
    # Its duration, which cannot be changed later, is that of the whole.
    with in_field(f"segments.{index}", "duration"):
        return _planned(chain, start, target, replace(segment, duration=problem.duration), index, problem)


def _planned(
    chain: Chain, start: Array, target: Array | None, segment: Segment, index: int, problem: TrajectoryProblem
) -> PlannedPart:
    failure: PlanningFailure | None = None
    share = 1.0
    notes: tuple[str, ...] = ()
    if target is not None:
        check_within(chain, target[None], "target")
    if segment.ends is not None:
        motion = _moving(chain, start, target, segment, segment.ends)
    elif target is not None:
        motion = point_to_point_motion(start, target, segment.law, segment.limits, segment.duration)
    elif segment.blends:
        motion, note = _beside(chain, start, segment)
        notes = (note,)
    else:
        motion, failure, share = _through(chain, start, segment, index)
    motion = _within_tip_limits(chain, motion, segment)
    timing = _comparison(chain, start, target, segment, index) if problem.compares_timing else None
    goal = target if segment.configurations is None else segment.configurations[-1]
    end = motion.at(motion.breaks[-1:])[0] if failure is not None or goal is None else goal
    report = SegmentReport(index, segment.type, segment.law, 0.0, motion.duration, notes=notes)
    return PlannedPart(motion, (report,), _demands(segment, start, end, problem.following.task), failure, share, timing)


def _moving(chain: Chain, start: Array, target: Array | None, segment: Segment, ends: EndRates) -> PiecewisePolynomial:
    """Return the motion between moving ends; without a given time, the first of longer ones that keeps the torques."""
    motion = moving_motion(chain, start, target, segment, ends)
    torque = segment.limits.torque
    is_free = segment.duration is None and segment.times is None
    if torque is None or not torque.is_limited or not is_free or motion.duration == 0.0:
        return motion
    duration = motion.duration
    for _ in range(_MOST_TRIES):
        factor = torque_factor(motion, torque)
        if factor == 1.0:
            break
        duration *= max(_LONGER, factor)
        # More time can also mean more of another quantity.
        with suppress(InvalidField):
            motion = moving_motion(chain, start, target, replace(segment, duration=duration), ends)
    return motion


def _solved(
    robot: RobotModel, chain: Chain, start: Array, segment: Segment, index: int, problem: TrajectoryProblem
) -> Array | PlanningFailure:
    """Return the target's configuration nearest to the start (for a redundant arm, the one that iteration finds).

    In a cell, if that touches something, return the nearest that touches nothing; raises CertificationFailed if Coal
    contradicts that there is none.
    """
    task, cell = problem.following.task, problem.cell
    T = cast(Array, segment.pose)
    form = closed_form(chain, task)
    every = form is not None and not form.has_free_elbow
    options = Options(task=task, every=every, most=1, windings=every)
    target = TargetProblem(robot, chain, Poses(T[None, :3, 3], T[None, :3, :3]), start[None], options)
    answer = solve(target)
    if cell is not None and len(answer.qs) and cell.touching(answer.qs)[0]:
        answer = solve(replace(target, options=Options(task=task)), cell)
    if len(answer.qs):
        return cast(Array, answer.qs[0])
    failure = answer.failures[0]
    if cell is not None and failure.status == "in_collision":
        at = failure.nearest[None]
        cell.certified_nearest(at, cell.nearest(at))
    blocking = failure.blocking_joints
    reason, joint = _REASONS[answer.statuses[0]], blocking[0].name if blocking else None
    return PlanningFailure(reason, index, 0.0, _position(chain, start), joint, failure.reason)


def _position(chain: Chain, configuration: Array) -> tuple[float, ...]:
    return tuple(chain_poses(chain.flat, configuration[None])[0][0].tolist())


def _through(
    chain: Chain, start: Array, segment: Segment, index: int
) -> tuple[PiecewisePolynomial, PlanningFailure | None, float]:
    """Plan through all waypoints, or the share of them before which no joint leaves its limits."""
    usual = fastest_way(chain, start, segment)
    if usual is not None:
        return usual, None, 1.0
    spline = JointSpline.of(start, segment, chain)
    motion, excess = spline.motion(), first_limit_excess(chain, spline.path)
    if excess is None:
        return motion, None, 1.0
    count = len(cast(Array, segment.configurations))
    motion, done = spline.prefix(chain, excess)
    joint = chain.joint_names[excess.joint]
    detail = (
        f"between its waypoints the spline takes {joint} to {excess.value:.6g}, beyond its limit {excess.bound:.6g}; "
        f"the first {done} of {count} waypoints can be done: put more of them where it swings out"
    )
    position = _position(chain, spline.path.at(np.array([excess.time]))[0])
    return motion, PlanningFailure("joint_limit", index, 0.0, position, joint, detail), done / count


def _beside(chain: Chain, start: Array, segment: Segment) -> tuple[PiecewisePolynomial, str]:
    """Plan straight lines with parabolic blends, which stay within the waypoints' range; note the largest miss."""
    waypoints = cast(Array, segment.configurations)
    check_within(chain, waypoints, "waypoints.{}")
    found = via_blends(start, waypoints, segment.limits, times=segment.times, duration=segment.duration)
    row, joint = np.unravel_index(int(found.deviations.argmax()), found.deviations.shape)
    note = (
        f"the blends pass beside the inner waypoints: furthest, by {found.deviations[row, joint]:.6g} rad or m, joint "
        f"{chain.joint_names[joint]} beside waypoint {row - 1}"
    )
    return found.motion, note


def _within_tip_limits(chain: Chain, motion: PiecewisePolynomial, segment: Segment) -> PiecewisePolynomial:
    """Slow the whole motion down if the tip is too fast; raise `InvalidField` if its duration or times are given."""
    tip = segment.limits.tip
    bounds = {name: getattr(tip, name) for name in ("speed", "angular_speed", "acceleration", "angular_acceleration")}
    if not any(math.isfinite(bound) for bound in bounds.values()) or motion.duration == 0.0:
        return motion
    peaks = tip_peaks(pieces_of(motion), chain)
    ratios = {name: peaks[name].value / bound for name, bound in bounds.items()}
    factor = max(math.sqrt(ratio) if "acceleration" in name else ratio for name, ratio in ratios.items())
    if factor <= 1.0:
        return motion
    if segment.ends is not None:
        reason = f"with it the tip would be too fast: {factor:.6g} times the time would keep its limits from rest"
        raise InvalidField(given_rates(segment.ends), reason)
    given = "times" if segment.times is not None else "duration"
    if segment.times is not None or segment.duration is not None:
        reason = f"the tip would be too fast: its limits are kept in {factor:.6g} times the time"
        raise InvalidField(given, reason)
    return motion.scaled(factor * (1.0 + _MARGIN))


def _comparison(
    chain: Chain, start: Array, target: Array | None, segment: Segment, index: int
) -> TimingComparison | None:
    """Compare two timings of the same path; None if its times or rates are given."""
    if segment.times is not None or segment.blends or segment.ends is not None:
        return None
    law, limits = segment.law, segment.limits
    if target is not None:
        law = scaled_law(law)
        numbers = compared_point_to_point(start, target, law, limits)
        return TimingComparison((index,), law, *numbers) if numbers.uniform_duration > 0.0 else None
    return TimingComparison((index,), law, *JointSpline.of(start, segment, chain).timings())


def _demands(segment: Segment, start: Array, end: Array, task: Task) -> Demands:
    continuous, keeps_jerk = promised(segment)
    return Demands(
        JointLimits(segment.limits.velocity, segment.limits.acceleration, segment.limits.jerk),
        segment.limits.tip,
        (start, end),
        task=task,
        continuous=continuous,
        keeps_jerk=keeps_jerk,
        stated_jerk=segment.stated_jerk,
        end_rates=None if segment.ends is None else _end_rates(segment, segment.ends),
        torque=segment.limits.torque,
    )


def _end_rates(segment: Segment, ends: EndRates) -> tuple[Array, Array]:
    """Return the rates that a motion must have at both ends, of those that its law or its spline determines there."""
    count = 2 if segment.boundary == "assigned" else LAWS[segment.law].end_rates
    start = np.array([ends.start_velocity, ends.start_acceleration])
    end = np.array([ends.end_velocity, ends.end_acceleration])
    return start[:count], end[:count]
