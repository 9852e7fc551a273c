"""Functions that the calculators of time laws, splines and time scaling share."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from gelenk.contract.course_motion import (
    MAX_SAMPLED_NUMBERS,
    MotionLimits,
    PlanarLinePayload,
    SampledRequest,
    SampleTimesRequest,
)
from gelenk.course.cartesian.planar_line import PlanarLine, planar_line
from gelenk.course.motion.check import MotionClaims, certified
from gelenk.course.motion.time_law_steps import SHOWN_JOINTS
from gelenk.errors import InvalidField, counted
from gelenk.language import marked, translated as _
from gelenk.operations.outcome import Outcome, PictureFormat
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.time_scaling import QUANTITIES, ScalingLimits
from gelenk.trajectory.laws.trapezoid import PointToPoint
from gelenk.trajectory.motion.extremes import Peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_QUICK_NUMBERS = 300
_QUICK_KNOTS = 24
_ROUNDING = 1e-9
_UNITS = (marked("rad or m"), marked("(rad or m)/s"), marked("(rad or m)/s²"), marked("(rad or m)/s³"))

_Request = TypeVar("_Request", bound=SampledRequest)


@dataclass(frozen=True, slots=True)
class PlannedMotion:
    """A planned motion, what its certificate promises, and further fields of the answer.

    If the motion only passes near its knots, a picture marks the points `passed` instead, of shapes (K,) and (K, n).
    """

    motion: PiecewisePolynomial
    claims: MotionClaims
    limits: ScalingLimits
    title: str
    further: dict[str, Any]
    passed: tuple[Array, Array] | None = None


def motion_outcome(call: _Request, plan: Callable[[_Request], PlannedMotion]) -> Outcome:
    """Return the motion that `plan` computes of a request, as JSON, or its profiles as a picture."""
    return Outcome(lambda: _answer(call, plan(call)), picture=lambda kind: _picture(plan(call), kind))


def is_heavy_motion(call: SampledRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    waypoints = getattr(call, "waypoints", None) or ()
    first = (
        getattr(call, "start", None) or getattr(call, "displacement", None) or (waypoints[0] if waypoints else (0.0,))
    )
    count = call.samples if call.sample_times is None else len(call.sample_times)
    return count * len(first) > _QUICK_NUMBERS or len(waypoints) * len(first) > _QUICK_KNOTS


def _picture(planned: PlannedMotion, kind: PictureFormat) -> bytes:
    from gelenk.plots.profiles import ProfileLines, profiles_picture  # noqa: PLC0415

    claims, limits = planned.claims, planned.limits
    certified(planned.motion, claims)
    names = [_("joint {number}").format(number=j + 1) for j in range(claims.points.shape[1])]
    marked = planned.passed or (claims.times, claims.points)
    lines = ProfileLines(names, _UNITS, (limits.velocity, limits.acceleration, limits.jerk), marked)
    return profiles_picture(planned.title, planned.motion, lines, kind)


def _answer(call: SampledRequest, planned: PlannedMotion) -> dict[str, Any]:
    motion, times = planned.motion, sample_times(call, planned.motion)
    positions, velocities, accelerations, jerks = (motion.derivative(order).at(times) for order in range(4))
    return {
        "duration": motion.duration,
        "switching_times": motion.breaks,
        "segments": segments_info(motion),
        "peaks": peaks_info(planned.claims.peaks, planned.limits),
        "times": times,
        "joint_positions": positions,
        "joint_velocities": velocities,
        "joint_accelerations": accelerations,
        "joint_jerks": jerks,
        **planned.further,
        "certificate": certified(motion, planned.claims),
    }


def segments_info(motion: PiecewisePolynomial) -> list[dict[str, Any]]:
    """Return the pieces of a motion as JSON content."""
    return [
        {"start_time": start, "end_time": end, "coefficients": c.T.tolist()}
        for start, end, c in zip(motion.breaks[:-1], motion.breaks[1:], motion.coefficients, strict=True)
    ]


def peaks_info(found: Mapping[int, Peaks], limits: ScalingLimits) -> dict[str, Any]:
    """Return the peaks of all quantities as JSON content."""
    return {
        quantity: _peaks_of(found[order], limits.of(quantity)) for order, quantity in enumerate(QUANTITIES, start=1)
    }


def sample_times(call: SampleTimesRequest, motion: PiecewisePolynomial) -> Array:
    """Return the times at which a request samples its motion; shape (N,), [s]; raises InvalidField."""
    start, end = float(motion.breaks[0]), float(motion.breaks[-1])
    count, joints = call.samples if call.sample_times is None else len(call.sample_times), motion.coefficients.shape[2]
    if count * joints > MAX_SAMPLED_NUMBERS:
        field = "samples" if call.sample_times is None else "sample_times"
        numbers = f"{count} samples of {counted(joints, 'joint')}"
        raise InvalidField(field, f"{numbers} are more than the {MAX_SAMPLED_NUMBERS} numbers allowed")
    if call.sample_times is None:
        return np.linspace(start, end, call.samples) if end > start else np.array([start])
    times = np.array(call.sample_times)
    slack = _ROUNDING * (end - start)
    if times.min() < start - slack or times.max() > end + slack:
        raise InvalidField("sample_times", f"the motion lasts from {start:.10g} to {end:.10g} s")
    return times


def _peaks_of(found: Peaks, limit: Array | None) -> list[dict[str, float | None]]:
    limits: list[float] | list[None] = [None] * len(found.values) if limit is None else limit.tolist()
    return [
        {"value": value, "time": time, "limit": most, "ratio": None if most is None else abs(value) / most}
        for value, time, most in zip(found.values.tolist(), found.times.tolist(), limits, strict=True)
    ]


def profile_info(plan: PointToPoint, joint: int) -> dict[str, Any]:
    """Return the trapezoid of one joint as JSON content."""
    profile = plan.profiles[joint]
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


def limit_warnings(found: Mapping[int, Peaks], limits: ScalingLimits, on_others: str = "") -> list[str]:
    """Return a warning for each joint and quantity whose limit is exceeded.

    `on_others` is the message about the joints that a worked solution does not show, where it shows only some.
    """
    texts = []
    for order, quantity in enumerate(QUANTITIES, start=1):
        limit = limits.of(quantity)
        if limit is not None:
            ratios = np.abs(found[order].values) / limit
            texts += [
                _(_BEYOND[quantity]).format(joint=j + 1, factor=ratios[j], time=found[order].times[j])
                for j in np.flatnonzero(ratios > 1.0 + _ROUNDING)
            ]
    joints = len(found[1].values)
    if on_others and joints > SHOWN_JOINTS:
        texts.append(_(on_others).format(shown=SHOWN_JOINTS, joints=joints))
    return texts


_BEYOND = {
    "velocity": marked("Joint {joint} goes beyond its limit of velocity by a factor of {factor:.4g}, at {time:.6g} s."),
    "acceleration": marked(
        "Joint {joint} goes beyond its limit of acceleration by a factor of {factor:.4g}, at {time:.6g} s."
    ),
    "jerk": marked("Joint {joint} goes beyond its limit of jerk by a factor of {factor:.4g}, at {time:.6g} s."),
}


def limits_of(call: SampledRequest, joints: int) -> ScalingLimits:
    """Return the limits of a request, one number per joint; raises as `spread` does."""
    return joint_limits(call.limits, joints)


def joint_limits(limits: MotionLimits | None, joints: int) -> ScalingLimits:
    """Return limits, one number per joint; raises as `spread` does."""
    given = limits or ()
    return ScalingLimits(
        *(None if values is None else spread(values, joints, f"limits.{name}") for name, values in given)
    )


def spread(values: Sequence[float], count: int, field: str, of: str = "joints") -> Array:
    """Return `count` numbers, from as many or from one for all; raises InvalidField for another count."""
    if len(values) not in {1, count}:
        raise InvalidField(field, f"has {counted(len(values), 'number')} where there are {count} {of}")
    return np.broadcast_to(np.array(values), (count,))


def line_of(call: PlanarLinePayload, place: str = "") -> PlanarLine:
    """Return the line of a planar arm's tip; raises InvalidField, whose field begins with `place`."""
    try:
        return planar_line((call.lengths[0], call.lengths[1]), np.array(call.start), np.array(call.target))
    except InvalidField as error:
        raise InvalidField(place + error.field, error.reason) from None


def row(values: Sequence[float] | None, joints: int, field: str) -> Array:
    """Return one number per joint, zeros if none are given; raises InvalidField for another count."""
    if values is None:
        return np.zeros(joints)
    if len(values) != joints:
        raise InvalidField(field, f"has {counted(len(values), 'number')} for {counted(joints, 'joint')}")
    return np.array(values)


def table(rows: Sequence[Sequence[float]], field: str, count: int, joints: int | None = None) -> Array:
    """Return rows, one number per joint, as an array; raises InvalidField for another count of rows or numbers."""
    if len(rows) != count:
        raise InvalidField(field, f"has {counted(len(rows), 'entry')} for {counted(count, 'time')}")
    width = len(rows[0]) if joints is None else joints
    for i, one in enumerate(rows):
        if len(one) != width:
            raise InvalidField(field, f"entry {i} has {counted(len(one), 'number')} for {counted(width, 'joint')}")
    return np.array(rows)


def needed(call: SampledRequest, fields: Sequence[str], why: str) -> None:
    """Raise InvalidField if a field is missing."""
    for field in fields:
        if getattr(call, field) is None:
            raise InvalidField(field, f"is needed {why}")


def unused(call: SampledRequest, fields: Sequence[str], why: str) -> None:
    """Raise InvalidField if a field is given."""
    for field in fields:
        if field in call.model_fields_set and getattr(call, field) not in (None, False):
            raise InvalidField(field, why)
