"""Functions that the calculators of time laws, splines and time scaling share."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from gelenk.contract.course_motion import MAX_SAMPLED_NUMBERS, SampledRequest
from gelenk.course.motion.check import MotionCertificate, MotionClaims, certified
from gelenk.errors import InvalidField, counted
from gelenk.operations.outcome import Outcome, PictureFormat
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.time_scaling import QUANTITIES, ScalingLimits
from gelenk.trajectory.motion.extremes import Peaks, peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_QUICK_NUMBERS = 300
_QUICK_KNOTS = 24
_ROUNDING = 1e-9
_UNITS = ("rad or m", "(rad or m)/s", "(rad or m)/s²", "(rad or m)/s³")

_Request = TypeVar("_Request", bound=SampledRequest)
PeaksByOrder = dict[int, Peaks]


@dataclass(frozen=True, slots=True)
class PlannedMotion:
    """A planned motion, what its certificate promises, and further fields of the answer.

    Attributes:
        motion: Positions over time.
        limits: Limits of each joint.
        times: Times of the knots, [s]; shape (K,).
        knots: Positions at the knots, [rad or m]; shape (K, n).
        start_rates: Derivatives given at the start; shape (m, n).
        end_rates: Derivatives given at the end; shape (m, n).
        continuity: Order of the highest derivative that is continuous at the joins.
        title: Title of a picture.
        told: Returns further fields of the answer, from the motion's peaks.
        passed: Points that a picture marks instead of the knots, if the motion only passes near them; (K,) and (K, n).
    """

    motion: PiecewisePolynomial
    limits: ScalingLimits
    times: Array
    knots: Array
    start_rates: Array
    end_rates: Array
    continuity: int
    title: str
    told: Callable[[PeaksByOrder], dict[str, Any]]
    passed: tuple[Array, Array] | None = None


def motion_outcome(call: _Request, plan: Callable[[_Request], PlannedMotion]) -> Outcome:
    """Return a motion as JSON, or its profiles as a picture.

    Args:
        call: The request.
        plan: Computes the motion of a request.
    """
    return Outcome(lambda: _answer(call, plan), picture=lambda kind: _picture(call, kind, plan))


def is_heavy_motion(call: SampledRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    waypoints = getattr(call, "waypoints", None) or ()
    first = (
        getattr(call, "start", None) or getattr(call, "displacement", None) or (waypoints[0] if waypoints else (0.0,))
    )
    count = call.samples if call.sample_times is None else len(call.sample_times)
    return count * len(first) > _QUICK_NUMBERS or len(waypoints) * len(first) > _QUICK_KNOTS


def _picture(call: _Request, kind: PictureFormat, plan: Callable[[_Request], PlannedMotion]) -> bytes:
    # Matplotlib takes a third of a second to load.
    from gelenk.plots.profiles import ProfileLines, profiles_picture  # noqa: PLC0415

    planned = plan(call)
    limits, joints = planned.limits, planned.knots.shape[1]
    _certified(planned, _peaks(planned.motion))
    lines = ProfileLines(
        [f"joint {j + 1}" for j in range(joints)],
        _UNITS,
        (limits.velocity, limits.acceleration, limits.jerk),
        planned.passed or (planned.times, planned.knots),
    )
    return profiles_picture(planned.title, planned.motion, lines, kind)


def _peaks(motion: PiecewisePolynomial) -> PeaksByOrder:
    return {order: peaks(motion, order) for order in (1, 2, 3)}


def _certified(planned: PlannedMotion, found: PeaksByOrder) -> MotionCertificate:
    promise = MotionClaims(
        planned.times, planned.knots, planned.start_rates, planned.end_rates, planned.continuity, found
    )
    return certified(planned.motion, promise)


def _answer(call: _Request, plan: Callable[[_Request], PlannedMotion]) -> dict[str, Any]:
    planned = plan(call)
    motion = planned.motion
    times, found = _sample_times(call, motion), _peaks(motion)
    derivatives = [motion.derivative(order).at(times) for order in range(4)]
    return {
        "duration": motion.duration,
        "switching_times": motion.breaks,
        "segments": segments(motion),
        "peaks": {
            quantity: _told_peaks(found[order], planned.limits.of(quantity))
            for order, quantity in enumerate(QUANTITIES, start=1)
        },
        "times": times,
        "joint_positions": derivatives[0],
        "joint_velocities": derivatives[1],
        "joint_accelerations": derivatives[2],
        "joint_jerks": derivatives[3],
        **planned.told(found),
        "certificate": _certified(planned, found),
    }


def _sample_times(call: SampledRequest, motion: PiecewisePolynomial) -> Array:
    start, end = float(motion.breaks[0]), float(motion.breaks[-1])
    count, joints = call.samples if call.sample_times is None else len(call.sample_times), motion.coefficients.shape[2]
    if count * joints > MAX_SAMPLED_NUMBERS:
        field = "samples" if call.sample_times is None else "sample_times"
        raise InvalidField(
            field,
            f"{count} samples of {counted(joints, 'joint')} are more than the {MAX_SAMPLED_NUMBERS} numbers allowed",
        )
    if call.sample_times is None:
        return np.linspace(start, end, call.samples) if end > start else np.array([start])
    times = np.array(call.sample_times)
    slack = _ROUNDING * (end - start)
    if times.min() < start - slack or times.max() > end + slack:
        raise InvalidField("sample_times", f"the motion lasts from {start:.10g} to {end:.10g} s")
    return times


def segments(motion: PiecewisePolynomial) -> list[dict[str, Any]]:
    """Return the pieces of a motion as JSON content."""
    return [
        {"start_time": start, "end_time": end, "coefficients": c.T.tolist()}
        for start, end, c in zip(
            motion.breaks[:-1].tolist(), motion.breaks[1:].tolist(), motion.coefficients, strict=True
        )
    ]


def _told_peaks(found: Peaks, limit: Array | None) -> list[dict[str, Any]]:
    return [
        {
            "value": value,
            "time": time,
            "limit": None if limit is None else float(limit[j]),
            "ratio": None if limit is None else abs(value) / float(limit[j]),
        }
        for j, (value, time) in enumerate(zip(found.values.tolist(), found.times.tolist(), strict=True))
    ]


def limit_warnings(found: PeaksByOrder, limits: ScalingLimits) -> list[str]:
    """Return a warning for each joint and quantity whose limit is exceeded."""
    texts = []
    for order, quantity in enumerate(QUANTITIES, start=1):
        limit = limits.of(quantity)
        if limit is not None:
            ratios = np.abs(found[order].values) / limit
            texts += [
                f"Joint {j + 1} goes beyond its limit of {quantity} by a factor of {ratios[j]:.4g}, "
                f"at {found[order].times[j]:.6g} s."
                for j in np.flatnonzero(ratios > 1.0 + _ROUNDING)
            ]
    return texts


def limits_of(call: SampledRequest, joints: int) -> ScalingLimits:
    """Return the limits of a request, one number per joint.

    Raises:
        InvalidField: A limit has neither one number nor one per joint.
    """
    given = call.limits
    if given is None:
        return ScalingLimits()
    names = ("joint_velocity", "joint_acceleration", "joint_jerk")
    found = (getattr(given, name) for name in names)
    return ScalingLimits(
        *(
            None if values is None else spread(values, joints, f"limits.{name}")
            for name, values in zip(names, found, strict=True)
        )
    )


def spread(values: Sequence[float], count: int, field: str, of: str = "joints") -> Array:
    """Return `count` numbers, from as many or from one for all.

    Raises:
        InvalidField: There is another count of numbers.
    """
    if len(values) not in {1, count}:
        raise InvalidField(field, f"has {counted(len(values), 'number')} where there are {count} {of}")
    return np.broadcast_to(np.array(values), (count,))


def row(values: Sequence[float] | None, joints: int, field: str) -> Array:
    """Return one number per joint; zeros if none are given.

    Raises:
        InvalidField: There is another count of numbers.
    """
    if values is None:
        return np.zeros(joints)
    if len(values) != joints:
        raise InvalidField(field, f"has {counted(len(values), 'number')} for {counted(joints, 'joint')}")
    return np.array(values)


def table(rows: Sequence[Sequence[float]], field: str, count: int | None = None, joints: int | None = None) -> Array:
    """Return rows of the same length as an array, one number per joint.

    Raises:
        InvalidField: Rows differ in length, or the count of rows or joints is wrong.
    """
    if count is not None and len(rows) != count:
        raise InvalidField(field, f"has {counted(len(rows), 'entry')} for {counted(count, 'time')}")
    width = len(rows[0]) if joints is None else joints
    for i, one in enumerate(rows):
        if len(one) != width:
            raise InvalidField(field, f"entry {i} has {counted(len(one), 'number')} for {counted(width, 'joint')}")
    return np.array(rows)


def needed(call: SampledRequest, fields: Sequence[str], why: str) -> None:
    """Check that fields are given.

    Raises:
        InvalidField: A field is missing.
    """
    for field in fields:
        if getattr(call, field) is None:
            raise InvalidField(field, f"is needed {why}")


def unused(call: SampledRequest, fields: Sequence[str], why: str) -> None:
    """Check that fields are not given.

    Raises:
        InvalidField: A field is given.
    """
    for field in fields:
        given = getattr(call, field) if field in call.model_fields_set else None
        if given is not None and given is not False:
            raise InvalidField(field, why)
