"""POST /v1/course/time-law: a motion between two points, or through several, by a time law."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from gelenk.contract.course_motion import MAX_SAMPLED_NUMBERS
from gelenk.contract.time_law import TimeLawRequest
from gelenk.course.motion.check import MotionClaims
from gelenk.course.motion.time_law_steps import lift_steps, peak_step, two_point_steps
from gelenk.course.motion.trapezoid_steps import blend_steps, trapezoid_steps
from gelenk.course.steps import Step
from gelenk.errors import InvalidField, counted
from gelenk.language import marked, translated as _
from gelenk.operations.course_motion import (
    PlannedMotion,
    is_heavy_motion,
    limit_warnings,
    limits_of,
    motion_outcome,
    needed,
    profile_info,
    row,
    spread,
    table,
    unused,
)
from gelenk.operations.outcome import Outcome
from gelenk.robot.arrays import Array
from gelenk.trajectory.joints.parabolic_blends import Blends, with_accelerations, with_blend_times
from gelenk.trajectory.laws.laws import POLYNOMIALS
from gelenk.trajectory.laws.time_scaling import ScalingLimits
from gelenk.trajectory.laws.trapezoid import JointMove, point_to_point
from gelenk.trajectory.motion.extremes import peaks_by_order
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import checked_times
from gelenk.trajectory.motion.time_laws import between, normalised, quartic_cubic_quartic

_RATES = ("velocity", "acceleration", "jerk")
_GIVEN_RATES: dict[str, int] = {
    **{law: conditions - 1 for law, conditions in POLYNOMIALS.items()},
    "4-3-4": 2,
    "trapezoidal": 1,
    "parabolic_blends": 0,
}
_OTHERS = marked("The worked solution shows {shown} of {joints} joints; the others go the same way.")
_TITLES = {
    "cubic": marked("Cubic time law"),
    "quintic": marked("Quintic time law"),
    "septic": marked("Septic time law"),
}
_KNOTS = {"4-3-4", "parabolic_blends"}


def run(call: TimeLawRequest) -> Outcome:
    """Compute a motion by a time law, its peaks and samples, with a worked solution."""
    return motion_outcome(call, _plan)


is_heavy = is_heavy_motion


def _plan(call: TimeLawRequest) -> PlannedMotion:
    law = f"with `law` {call.law}"
    unused_rates = [f"{end}_{rate}" for rate in _RATES[_GIVEN_RATES[call.law] :] for end in ("start", "end")]
    unused(call, unused_rates, f"is not allowed {law}")
    if call.law in _KNOTS:
        unused(call, ("start", "target", "duration", "may_reverse"), f"is not allowed {law}")
        needed(call, ("waypoints", "times"), law)
        times = np.array(call.times)
        checked_times(times, "times")
        knots = table(call.waypoints or [], "waypoints", len(times))
        return _lift(call, times, knots) if call.law == "4-3-4" else _blends(call, times, knots)
    unused(call, ("waypoints", "times", "blend_time"), f"is not allowed {law}")
    needed(call, ("start", "target"), law)
    start = np.array(call.start)
    target = row(call.target, len(start), "target")
    if call.law == "trapezoidal":
        return _trapezoid(call, start, target)
    unused(call, ("may_reverse",), f"is not allowed {law}")
    return _two_points(call, start, target)


def _rates(call: TimeLawRequest, end: str, joints: int) -> Array:
    names = [f"{end}_{rate}" for rate in _RATES[: _GIVEN_RATES[call.law]]]
    return np.array([row(getattr(call, name), joints, name) for name in names]).reshape(-1, joints)


def _two_points(call: TimeLawRequest, start: Array, target: Array) -> PlannedMotion:
    if call.duration is None:
        raise InvalidField("duration", f"is needed with `law` {call.law}")
    starts = np.vstack((start, _rates(call, "start", len(start))))
    ends = np.vstack((target, _rates(call, "end", len(start))))
    motion = between(starts, ends, call.duration)
    forms = normalised(motion, target - start)
    peaks = peaks_by_order(motion)
    claims = MotionClaims(motion.breaks, np.array([start, target]), starts[1:], ends[1:], len(starts) - 1, peaks)
    steps = (*two_point_steps(motion, starts, ends, forms), peak_step(peaks[1], peaks[2]))
    return _planned(call, motion, claims, _(_TITLES[call.law]), steps, {"normalised": forms})


def _lift(call: TimeLawRequest, times: Array, knots: Array) -> PlannedMotion:
    unused(call, ("blend_time",), "is not allowed with `law` 4-3-4")
    if len(times) != 4:
        raise InvalidField("waypoints", f"4-3-4 goes through four: start, lift-off, set-down, end; {len(times)} given")
    starts, ends = (_rates(call, end, knots.shape[1]) for end in ("start", "end"))
    motion = quartic_cubic_quartic(times, knots, starts, ends)
    peaks = peaks_by_order(motion)
    claims = MotionClaims(times, knots, starts, ends, 2, peaks)
    return _planned(
        call, motion, claims, _("4-3-4 time law"), (*lift_steps(motion, knots), peak_step(peaks[1], peaks[2]))
    )


def _trapezoid(call: TimeLawRequest, start: Array, target: Array) -> PlannedMotion:
    joints = len(start)
    limits = limits_of(call, joints)
    if limits.acceleration is None:
        raise InvalidField("limits.joint_acceleration", "is needed with `law` trapezoidal")
    starts, ends = _rates(call, "start", joints), _rates(call, "end", joints)
    most = np.full(joints, np.inf) if limits.velocity is None else limits.velocity
    moves = np.column_stack((target - start, starts[0], ends[0], most, limits.acceleration))
    tasks = [JointMove(*numbers) for numbers in moves.tolist()]
    plan = point_to_point(start, tasks, call.duration, may_reverse=call.may_reverse)
    profiles = [profile_info(plan, j) for j in range(joints)]
    motion, knots = plan.motion, np.array([start, target])
    claims = MotionClaims(motion.breaks[[0, -1]], knots, starts, ends, 1, peaks_by_order(motion))
    return _planned(
        call, motion, claims, _("Trapezoid of velocity"), trapezoid_steps(tasks, plan), {"profiles": profiles}
    )


def _blends(call: TimeLawRequest, times: Array, knots: Array) -> PlannedMotion:
    found = _blended(call, times, knots, limits_of(call, knots.shape[1]))
    rest, ends = np.zeros((1, knots.shape[1])), [0, -1]
    claims = MotionClaims(times[ends], knots[ends], rest, rest, 1, peaks_by_order(found.motion))
    blends = {
        "velocities": found.velocities.T.tolist(),
        "accelerations": found.accelerations.T.tolist(),
        "blend_times": found.durations.T.tolist(),
        "deviations": found.deviations.T.tolist(),
    }
    title = _("Straight segments, parabolic blends")
    return _planned(call, found.motion, claims, title, blend_steps(found), {"blends": blends}, (times, knots))


def _blended(call: TimeLawRequest, times: Array, knots: Array, limits: ScalingLimits) -> Blends:
    if call.blend_time is not None:
        if limits.acceleration is not None:
            raise InvalidField("blend_time", "follows from `limits.joint_acceleration`: give one of the two")
        return with_blend_times(times, knots, spread(call.blend_time, len(times), "blend_time", "waypoints"))
    if limits.acceleration is None:
        raise InvalidField("blend_time", "is needed with `law` parabolic_blends, or `limits.joint_acceleration`")
    joints = knots.shape[1]
    pieces = 2 * len(times) * joints
    if pieces * joints > MAX_SAMPLED_NUMBERS:
        reason = (
            f"{len(times)} of them make up to {pieces} pieces of {counted(joints, 'joint')}, each joint switching at "
            f"times of its own: more than the {MAX_SAMPLED_NUMBERS} numbers allowed; give `blend_time`"
        )
        raise InvalidField("waypoints", reason)
    return with_accelerations(times, knots, limits.acceleration)


def _planned(
    call: TimeLawRequest,
    motion: PiecewisePolynomial,
    claims: MotionClaims,
    title: str,
    steps: Sequence[Step],
    of_this_law: Mapping[str, Any] | None = None,
    passed: tuple[Array, Array] | None = None,
) -> PlannedMotion:
    """Return the plan, with the fields that only answers for other laws have set to None."""
    limits = limits_of(call, claims.points.shape[1])
    warnings = limit_warnings(claims.peaks, limits, _OTHERS)
    others = dict.fromkeys(("normalised", "profiles", "blends"))
    further = {"law": call.law, **others, **(of_this_law or {}), "steps": steps, "warnings": warnings}
    return PlannedMotion(motion, claims, limits, title, further, passed)
