"""Timing of the joints along a path, from rest to rest: six laws, each as fast as limits of joints and tip allow.

A law s(t) is chosen, then scaled uniformly until the joints' polynomials in time, or the tip, just reach some limit:

- `cubic`, `quintic`, `septic`: a fixed shape.
- `trapezoidal`: the acceleration and the cruise speed of the shortest time.
- `jerk_limited`: likewise, with a jerk along s.
- `time_optimal`: some joint, or the tip, is at a limit nearly always.

One shape along a path that bends is slow everywhere because of its narrowest bend. A motion that may slow down locally
has the smoothness of its law instead: the time-optimal law, averaged over time as often as that takes (`averages`).

Jerk limits apply to the laws with continuous acceleration: `quintic`, `septic`, `jerk_limited`.
"""

from dataclasses import dataclass, replace
from typing import Final, NamedTuple

import numpy as np

from gelenk.errors import InvalidField, counted
from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.laws.laws import LAWS, POLYNOMIALS
from gelenk.trajectory.motion.composition import in_time
from gelenk.trajectory.motion.extremes import candidates
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, joined
from gelenk.trajectory.motion.splines import cubic_spline
from gelenk.trajectory.motion.time_laws import rest_to_rest
from gelenk.trajectory.paths.path_geometry import LimitedPath
from gelenk.trajectory.problem.parts import standing
from gelenk.trajectory.timing.averages import averaged
from gelenk.trajectory.timing.path_laws import least_trapezoidal, s_curve, trapezoid
from gelenk.trajectory.timing.path_peaks import peaks_of
from gelenk.trajectory.timing.torque_constraints import optimal_within

_IN_PLACE: Final = "to be slow only where the path bends, the time-optimal law is taken in place of `{}`"
_AVERAGED: Final = "to be slow only where the path bends, `{}` is a moving average of the time-optimal law"
_ROUNDING = 1e-9
"""Relative tolerance for a requested duration that falls short of the shortest one, and then means it."""
_SLOWER = 1.1
"""Ratio to the time-optimal duration, itself within 1.5 % of the optimum, from which a lower bound is conclusive."""


@dataclass(frozen=True, slots=True)
class Timed:
    """A motion along a path, from rest to rest.

    Attributes:
        motion: Joint motion, starting at 0 s; if nothing moves, one piece of zero or of the requested duration.
        continuous: Highest order up to which the motion's derivatives are continuous.
        has_bounded_jerk: Whether the jerk limits hold throughout; where the acceleration jumps, they cannot.
        binding: Limit that prevents a shorter time with this law, in words.
    """

    motion: PiecewisePolynomial
    law: PiecewisePolynomial
    continuous: int
    has_bounded_jerk: bool
    binding: str
    notes: tuple[str, ...] = ()


def timed(geometry: LimitedPath, law: Law, *, duration: float | None = None, slow_down: bool = False) -> Timed:
    """Plan the fastest motion with a law, slowed down uniformly if a longer duration is requested.

    The motion stops where q' jumps. Where q'' jumps, the acceleration jumps with any law, and a jerk limit holds only
    before and after the jump.

    The time-optimal law is within 1.5 % of the optimum (`time_optimal`). Where the path bends, tip limits cost up to
    0.25 % more (`tip_rows`). A final uniform scaling by k ≥ 1, mostly by less than 1e-5, keeps them also between the
    places at which they are checked. If the trapezoidal law takes no longer, it is used, because it has fewer pieces.

    Args:
        geometry: The path of the joints, possibly ending before the path of the tip does, and the limits.
        duration: Requested duration, [s]; the shortest within the limits if None.
        slow_down: Whether the motion may slow down locally where the limits require it, with the smoothness of `law`
            but not its shape.

    Raises:
        InvalidField: The duration is shorter than the limits allow, or limits and path differ too much in magnitude.
    """
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        found = _whole(geometry, law, slow_down)
    if not np.isfinite(found.motion.coefficients).all():
        raise InvalidField("limits", "these limits and this path are too many powers of ten apart")
    return found if duration is None else _lasting(found, duration)


class Timings(NamedTuple):
    """Durations of one path with two time laws, and factors, as `TimingComparison` describes them."""

    uniform_duration: float
    velocity_factor: float
    acceleration_factor: float
    time_optimal_duration: float


def compared(geometry: LimitedPath, law: Law) -> Timings:
    """Compare a law, scaled uniformly until some limit is just reached, with the time-optimal one on the same path.

    Limits of torque do not count.
    """
    geometry = replace(geometry, limits=replace(geometry.limits, torque=None))
    uniform, optimal = timed(geometry, law), timed(geometry, "time_optimal")
    duration = uniform.motion.duration
    if duration == 0.0:
        return Timings(0.0, 0.0, 0.0, 0.0)
    peaks = peaks_of(geometry, uniform.motion, uniform.law, with_jerk=False)
    return Timings(duration, peaks.of_order(1) * duration, peaks.of_order(2) * duration**2, optimal.motion.duration)


def passing_at(geometry: LimitedPath, places: Array, times: Array) -> Timed:
    """Plan the motion along a path, from rest to rest, that passes each place at its time; C² where the path is.

    The law is a clamped cubic spline s(t) that never goes backwards.

    Args:
        geometry: The complete path of the joints, and the limits.
        places: s of each waypoint after the start; shape (m,), [m or rad].
        times: Time of each waypoint, counted from the start; shape (m,), [s].

    Raises:
        InvalidField: The times do not increase, would make the tip go backwards, or are too short for the limits.
    """
    if len(times) != len(places):
        raise InvalidField("times", f"{counted(len(times), 'entry')} for {counted(len(places), 'waypoint')}")
    law = cubic_spline(np.append(0.0, times), np.append(0.0, places)[:, None], "clamped").motion
    _refuse_going_back(law)
    motion = in_time(geometry.joints, law)
    peaks = peaks_of(geometry, motion, law, with_jerk=False)
    if peaks.factor > 1.0 + _ROUNDING:
        reason = f"{peaks.binding(geometry)}: to keep the limits, multiply all times by {peaks.factor:.10g}"
        raise InvalidField("times", reason)
    return Timed(motion, law, 1 if len(geometry.bends()) else 2, False, "the times are given")


def _refuse_going_back(law: PiecewisePolynomial) -> None:
    """Refuse ds/dt < 0; each piece is slowest at an end or where the acceleration is zero."""
    rates = candidates(law.derivative())[1]
    least = rates.min(axis=(1, 2))
    if (least < -_ROUNDING * rates.max()).any():
        i = int(least.argmin())
        reason = (
            f"the tip would have to go backwards along its path between {law.breaks[i]:.6g} and "
            f"{law.breaks[i + 1]:.6g} s: space the times more evenly over the length of the path"
        )
        raise InvalidField("times", reason)


def _whole(geometry: LimitedPath, law: Law, slow_down: bool) -> Timed:
    if geometry.stands_still:
        end = geometry.joints.breaks[-1:]
        return Timed(standing(geometry.joints.at(end)[0]), standing(end), 2, True, "nothing moves")
    parts = [_fastest(part, law, slow_down) for part in geometry.parts()]
    if len(parts) == 1:
        return parts[0]
    stops = ", ".join(f"{part.law.at(part.law.breaks[-1:])[0, 0]:.4g}" for part in parts[:-1])
    notes = dict.fromkeys(note for part in parts for note in part.notes)
    return Timed(
        joined([part.motion for part in parts]),
        joined([part.law for part in parts]),
        min(part.continuous for part in parts),
        all(part.has_bounded_jerk for part in parts),
        parts[0].binding,
        (f"the direction jumps at s = {stops}: the motion stops there", *notes),
    )


def _fastest(geometry: LimitedPath, law: Law, slow_down: bool) -> Timed:
    averages = LAWS[law].continuous - 1
    if law == "time_optimal" or (slow_down and averages == 0):
        optimal = _time_optimal(geometry)
        return optimal if law == "time_optimal" else replace(optimal, notes=(_IN_PLACE.format(law), *optimal.notes))
    single = _along(geometry, law, _shape(geometry, law))
    if not slow_down:
        return single
    average = _along(geometry, law, averaged(geometry, averages))
    if single.motion.duration <= average.motion.duration:
        return single
    return replace(average, notes=(_AVERAGED.format(law), *average.notes))


def _along(geometry: LimitedPath, law: Law, along: PiecewisePolynomial) -> Timed:
    motion = in_time(geometry.joints, along)
    smooth = LAWS[law].keeps_jerk
    peaks = peaks_of(geometry, motion, along, with_jerk=smooth)
    bends = geometry.bends()
    jerk_holds = smooth and len(bends) == 0
    notes: tuple[str, ...] = ()
    if smooth and not jerk_holds:
        places = ", ".join(f"{s:.4g}" for s in bends[:4]) + (", …" if len(bends) > 4 else "")
        note = f"the path's curvature jumps at s = {places}: so does the acceleration there, and the limit of jerk"
        notes = (f"{note} holds in between only",)
    binding = peaks.binding(geometry)
    return _scaled(Timed(motion, along, 2 if jerk_holds else 1, jerk_holds, binding, notes), peaks.factor)


def _shape(geometry: LimitedPath, law: Law) -> PiecewisePolynomial:
    """Return a law's s(t) with an arbitrary duration."""
    if law in POLYNOMIALS:
        return rest_to_rest(*geometry.ends, POLYNOMIALS[law])
    return trapezoid(geometry) if law == "trapezoidal" else s_curve(geometry)


def _time_optimal(geometry: LimitedPath) -> Timed:
    found = optimal_within(geometry)
    timing = Timed(found.motion, found.time_law, 1, False, "some limit is reached nearly everywhere")
    if geometry.limits_tip or geometry.zones:
        peaks = peaks_of(geometry, found.motion, found.time_law, with_jerk=False, with_joints=bool(geometry.zones))
        timing = _scaled(timing, max(1.0, peaks.factor))
    if geometry.limits_torque:
        return timing
    # Along a straight path the trapezoidal law is the exact optimum, with only three pieces; here it would be slower.
    if least_trapezoidal(timing.law) > _SLOWER * timing.motion.duration:
        return timing
    simple = _fastest(geometry, "trapezoidal", False)
    return simple if simple.motion.duration <= timing.motion.duration * (1.0 + _ROUNDING) else timing


def _scaled(timing: Timed, factor: float) -> Timed:
    return replace(timing, motion=timing.motion.scaled(factor), law=timing.law.scaled(factor))


def _lasting(fastest: Timed, duration: float) -> Timed:
    """Slow a motion down to a given duration; `InvalidField` if it cannot be that fast."""
    least = fastest.motion.duration
    if duration < least * (1.0 - _ROUNDING):
        raise InvalidField("duration", f"must be at least {least:.10g} s: {fastest.binding}")
    if least == 0.0:
        motion, law = (standing(one.coefficients[0, 0], duration) for one in (fastest.motion, fastest.law))
    else:
        motion, law = fastest.motion.lasting(duration), fastest.law.lasting(duration)
    return replace(fastest, motion=motion, law=law)
