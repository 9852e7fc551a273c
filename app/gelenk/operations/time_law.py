"""POST /v1/course/time-law: a motion between two points, or through several, by a time law."""

from typing import Any

import numpy as np

from gelenk.contract.course_motion import MAX_SAMPLED_NUMBERS
from gelenk.contract.time_law import TimeLawRequest
from gelenk.course.motion.formulas import SHOWN_JOINTS
from gelenk.course.motion.time_law_steps import lift_steps, peak_step, two_point_steps
from gelenk.course.motion.trapezoid_steps import blend_steps, trapezoid_steps
from gelenk.course.steps import Step
from gelenk.errors import InvalidField, counted
from gelenk.operations.course_motion import (
    PeaksByOrder,
    PlannedMotion,
    is_heavy_motion,
    limit_warnings,
    limits_of,
    motion_outcome,
    needed,
    row,
    spread,
    table,
    unused,
)
from gelenk.operations.outcome import Outcome
from gelenk.robot.arrays import Array
from gelenk.trajectory.joints.parabolic_blends import Blends, with_accelerations, with_blend_times
from gelenk.trajectory.laws.time_scaling import ScalingLimits
from gelenk.trajectory.laws.trapezoid import JointMove, PointToPoint, Profile, point_to_point
from gelenk.trajectory.motion.splines import checked_times
from gelenk.trajectory.motion.time_laws import between, normalised, quartic_cubic_quartic

_RATES = ("velocity", "acceleration", "jerk")
_GIVEN_RATES = {"cubic": 1, "quintic": 2, "septic": 3, "4-3-4": 2, "trapezoidal": 1, "parabolic_blends": 0}
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
    starts = np.concatenate([start[None], _rates(call, "start", len(start))])
    ends = np.concatenate([target[None], _rates(call, "end", len(start))])
    motion, limits = between(starts, ends, call.duration), limits_of(call, len(start))
    forms = normalised(motion, target - start)

    def told(found: PeaksByOrder) -> dict[str, Any]:
        steps = (*two_point_steps(motion, starts, ends, forms), peak_step(found[1], found[2]))
        return _told(call, limits, found, steps, normalised=forms)

    return PlannedMotion(
        motion,
        limits,
        motion.breaks,
        np.array([start, target]),
        starts[1:],
        ends[1:],
        len(starts) - 1,
        f"{call.law.capitalize()} time law",
        told,
    )


def _lift(call: TimeLawRequest, times: Array, knots: Array) -> PlannedMotion:
    unused(call, ("blend_time",), "is not allowed with `law` 4-3-4")
    if len(times) != 4:
        raise InvalidField("waypoints", f"4-3-4 goes through four: start, lift-off, set-down, end; {len(times)} given")
    starts, ends = (_rates(call, end, knots.shape[1]) for end in ("start", "end"))
    motion = quartic_cubic_quartic(times, knots, starts, ends)
    limits = limits_of(call, knots.shape[1])

    def told(found: PeaksByOrder) -> dict[str, Any]:
        return _told(call, limits, found, (*lift_steps(motion, knots), peak_step(found[1], found[2])))

    return PlannedMotion(motion, limits, times, knots, starts, ends, 2, "4-3-4 time law", told)


def _trapezoid(call: TimeLawRequest, start: Array, target: Array) -> PlannedMotion:
    joints = len(start)
    limits = limits_of(call, joints)
    if limits.acceleration is None:
        raise InvalidField("limits.joint_acceleration", "is needed with `law` trapezoidal")
    rates = _rates(call, "start", joints), _rates(call, "end", joints)
    most = np.full(joints, np.inf) if limits.velocity is None else limits.velocity
    distances = target - start
    tasks = [
        JointMove(*(float(value) for value in numbers))
        for numbers in zip(distances, rates[0][0], rates[1][0], most, limits.acceleration, strict=True)
    ]
    plan = point_to_point(start, tasks, call.duration, may_reverse=call.may_reverse)

    def told(found: PeaksByOrder) -> dict[str, Any]:
        profiles = [_profile(plan, j) for j in range(joints)]
        return _told(call, limits, found, trapezoid_steps(tasks, plan), profiles=profiles)

    return PlannedMotion(
        plan.motion,
        limits,
        plan.motion.breaks[[0, -1]],
        np.array([start, target]),
        *rates,
        1,
        "Trapezoid of velocity",
        told,
    )


def _profile(plan: PointToPoint, joint: int) -> dict[str, Any]:
    profile: Profile = plan.profiles[joint]
    return {
        "peak_velocity": profile.peak_velocity,
        "acceleration": profile.acceleration,
        "acceleration_time": profile.first,
        "coast_time": profile.coast,
        "deceleration_time": profile.last,
        "own_duration": plan.own[joint].duration,
        "factor": plan.factors[joint],
        "reverses": profile.reverses,
    }


def _blends(call: TimeLawRequest, times: Array, knots: Array) -> PlannedMotion:
    limits = limits_of(call, knots.shape[1])
    if call.blend_time is not None:
        if limits.acceleration is not None:
            raise InvalidField("blend_time", "follows from `limits.joint_acceleration`: give one of the two")
        found = with_blend_times(times, knots, spread(call.blend_time, len(times), "blend_time", "waypoints"))
    elif limits.acceleration is not None:
        pieces = 2 * len(times) * knots.shape[1]
        if pieces * knots.shape[1] > MAX_SAMPLED_NUMBERS:
            raise InvalidField(
                "waypoints",
                f"{len(times)} of them make up to {pieces} pieces of {counted(knots.shape[1], 'joint')}, each joint "
                f"switching at times of its own: more than the {MAX_SAMPLED_NUMBERS} numbers allowed; "
                "give `blend_time`",
            )
        found = with_accelerations(times, knots, limits.acceleration)
    else:
        raise InvalidField("blend_time", "is needed with `law` parabolic_blends, or `limits.joint_acceleration`")
    rest = np.zeros((1, knots.shape[1]))

    def told(peaks: PeaksByOrder) -> dict[str, Any]:
        return _told(call, limits, peaks, blend_steps(found), blends=_told_blends(found))

    ends = [0, -1]
    return PlannedMotion(
        found.motion,
        limits,
        times[ends],
        knots[ends],
        rest,
        rest,
        1,
        "Straight segments, parabolic blends",
        told,
        (times, knots),
    )


def _told_blends(found: Blends) -> dict[str, Any]:
    return {
        "velocities": found.velocities.T.tolist(),
        "accelerations": found.accelerations.T.tolist(),
        "blend_times": found.durations.T.tolist(),
        "deviations": found.deviations.T.tolist(),
    }


def _told(
    call: TimeLawRequest, limits: ScalingLimits, found: PeaksByOrder, steps: tuple[Step, ...], **further: Any
) -> dict[str, Any]:
    warnings = limit_warnings(found, limits)
    joints = len(found[1].values)
    if joints > SHOWN_JOINTS:
        warnings.append(f"The worked solution shows {SHOWN_JOINTS} of {joints} joints; the others go the same way.")
    return {
        "law": call.law,
        "normalised": None,
        "profiles": None,
        "blends": None,
        **further,
        "steps": steps,
        "warnings": warnings,
    }
