"""POST /v1/course/time-scaling: the factor of time with which a motion keeps its limits."""

import numpy as np

from gelenk.contract.time_scaling import TimeScalingRequest
from gelenk.course.cartesian.planar_line import PlanarLine, along_planar_line, planar_motion_steps
from gelenk.course.motion.check import MotionClaims
from gelenk.course.motion.time_law_steps import scaling_steps
from gelenk.errors import InvalidField
from gelenk.language import translated as _
from gelenk.operations.course_motion import (
    PlannedMotion,
    is_heavy_motion,
    limit_warnings,
    limits_of,
    line_of,
    motion_outcome,
    needed,
    table,
    unused,
)
from gelenk.operations.outcome import Outcome
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.laws import POLYNOMIALS
from gelenk.trajectory.laws.time_scaling import Scaling, uniform_scaling
from gelenk.trajectory.motion.extremes import peaks_by_order
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import cubic_spline, through_samples
from gelenk.trajectory.motion.time_laws import between, rest_to_rest

_AT_REST = 1e-9


def run(call: TimeScalingRequest) -> Outcome:
    """Scale a motion in time so that it keeps its limits, with a worked solution."""
    return motion_outcome(call, _plan)


def is_heavy(call: TimeScalingRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return call.line is not None or is_heavy_motion(call)


def _plan(call: TimeScalingRequest) -> PlannedMotion:
    line = None if call.line is None else line_of(call.line, "line.")
    motion, times, knots, continuity = _motion(call) if line is None else _along(call, line)
    limits = limits_of(call, knots.shape[1])
    if limits.velocity is None and limits.acceleration is None and limits.jerk is None:
        raise InvalidField("limits", "at least one of joint_velocity, joint_acceleration and joint_jerk is needed")
    scaling = uniform_scaling(motion, limits)
    factor = _factor(call, scaling)
    # Start at 0: at a late time no digits are left for a motion that has become short.
    scaled = PiecewisePolynomial(motion.breaks - motion.breaks[0], motion.coefficients).scaled(factor)

    along = () if line is None else planar_motion_steps(line, _share(call), scaling.binding)
    peaks, ratios = peaks_by_order(scaled), {bound.quantity: bound.ratio for bound in scaling.bounds}
    further = {
        "course_factor": scaling.course_factor,
        "unclipped_factor": scaling.factor,
        "applied_factor": factor,
        "k_vel": max(1.0, ratios["velocity"]) if "velocity" in ratios else None,
        "k_acc": max(1.0, ratios["acceleration"]) if "acceleration" in ratios else None,
        "bounds": scaling.bounds,
        "binding": scaling.binding,
        "original_duration": motion.duration,
        "steps": (*along, *scaling_steps(scaling, motion.duration)),
        "warnings": [*limit_warnings(peaks, limits), *_warnings(motion, scaling)],
    }
    rest = np.zeros((POLYNOMIALS[call.law] - 1 if call.waypoints is None else 0, knots.shape[1]))
    when = factor * (times - times[0])
    when[-1] = scaled.breaks[-1]
    claims = MotionClaims(when, knots, rest, rest, continuity, peaks)
    passed = None if line is None else (when[[0, -1]], knots[[0, -1]])
    return PlannedMotion(scaled, claims, limits, _("Scaled by k = {factor:.6g}").format(factor=factor), further, passed)


def _share(call: TimeScalingRequest) -> PiecewisePolynomial:
    return rest_to_rest(0.0, 1.0, POLYNOMIALS[call.law]).lasting(call.duration or 1.0)


def _along(call: TimeScalingRequest, line: PlanarLine) -> tuple[PiecewisePolynomial, Array, Array, int]:
    """Return the joints along a line like `_motion`, all breaks as knots, whose positions are inverse kinematics."""
    others = ("displacement", "times", "waypoints", "velocities", "accelerations", "boundary")
    unused(call, others, "give it instead of `line`, not with it")
    needed(call, ("duration",), "with `line`")
    law = _share(call)
    motion = along_planar_line(line, law)
    return motion, motion.breaks, line.configurations(law.at(motion.breaks)[:, 0]), POLYNOMIALS[call.law] - 1


def _motion(call: TimeScalingRequest) -> tuple[PiecewisePolynomial, Array, Array, int]:
    """Return the given motion, times and positions of its knots, and the order of its last continuous derivative."""
    if call.waypoints is None:
        unused(call, ("times", "velocities", "accelerations", "boundary"), "needs `waypoints`, which are missing")
        needed(call, ("displacement", "duration"), "for a motion by a law; or give `times` and `waypoints`")
        ends = np.zeros((POLYNOMIALS[call.law], len(call.displacement or ())))
        ends[0] = call.displacement
        motion = between(np.zeros_like(ends), ends, call.duration or 1.0)
        return motion, motion.breaks, np.array([np.zeros_like(ends[0]), ends[0]]), len(ends) - 1
    unused(call, ("displacement", "duration", "law"), "give it instead of `waypoints`, not with them")
    needed(call, ("times",), "beside `waypoints`")
    times = np.array(call.times)
    knots = table(call.waypoints, "waypoints", len(times))
    if call.velocities is None:
        unused(call, ("accelerations",), "needs `velocities`, which are missing")
        return cubic_spline(times, knots, call.boundary).motion, times, knots, 2
    unused(call, ("boundary",), "is that of a spline, and with `velocities` there is none")
    velocities = table(call.velocities, "velocities", len(times), knots.shape[1])
    if call.accelerations is None:
        return through_samples(times, knots, velocities), times, knots, 1
    accelerations = table(call.accelerations, "accelerations", len(times), knots.shape[1])
    return through_samples(times, knots, velocities, accelerations), times, knots, 2


def _factor(call: TimeScalingRequest, scaling: Scaling) -> float:
    if call.factor is not None:
        unused(call, ("scaling",), "chooses a k, and `factor` gives one: leave one of the two out")
        return call.factor
    if call.scaling == "course":
        return scaling.course_factor
    if scaling.factor is None:
        raise InvalidField("scaling", "nothing moves: no k lets it just reach a limit")
    return scaling.factor


def _warnings(motion: PiecewisePolynomial, scaling: Scaling) -> list[str]:
    if scaling.factor is None:
        return [_("Nothing moves: any time will do.")]
    velocities = np.abs(motion.derivative().at(motion.breaks))
    if np.any(velocities[[0, -1]].max(axis=0) > _AT_REST * np.maximum(velocities.max(axis=0), scaling.factor)):
        return [_("The motion does not begin and end at rest: its end velocities are divided by k too.")]
    return []
