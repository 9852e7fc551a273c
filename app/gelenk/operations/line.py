"""POST /v1/course/line: a straight line with a law of time, without a robot."""

from typing import Any

import numpy as np

from gelenk.contract.line import LineRequest
from gelenk.course.cartesian.line import AxisLimits, LineLaw, LineMotion, along_line, compared_axes, line_certificate
from gelenk.course.cartesian.line_steps import axes_steps, line_steps, optimal_step
from gelenk.course.cartesian.turn import Turn, rates, turn_steps
from gelenk.errors import InvalidField, counted
from gelenk.language import translated as _
from gelenk.operations.course_motion import profile_info, sample_times
from gelenk.operations.outcome import Outcome, PictureFormat
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.laws import POLYNOMIALS
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.paths.orientation_paths import HALF_TURN

_QUICK_SAMPLES = 100
_DEGENERATE = 1e-6
"""Sine of θ below which a warning says that a triple is not determined."""


def run(call: LineRequest) -> Outcome:
    """Plan a motion along a line, and an orientation if requested, with a worked solution."""
    return Outcome(lambda: _line(call), picture=lambda kind: _picture(call, kind))


def is_heavy(call: LineRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    count = call.samples if call.sample_times is None else len(call.sample_times)
    return count > _QUICK_SAMPLES or call.start_orientation is not None


def _law(call: LineRequest, displacement: Array) -> tuple[LineLaw, AxisLimits | None]:
    """Return the law along the line, and the limits of the axes that give its own, if they are given."""
    names = ("start_velocity", "end_velocity", "duration")
    speeds: dict[str, Any] = {name: getattr(call, name) for name in names}
    limits = ("velocity", "acceleration", "axis_velocity", "axis_acceleration", "may_reverse")
    if call.law != "trapezoidal":
        for field in limits:
            if getattr(call, field):
                raise InvalidField(field, f"is a limit of bang-coast-bang: leave it out with `law` {call.law}")
        return LineLaw(np.inf, np.inf, conditions=POLYNOMIALS[call.law], **speeds), None
    for norm, axis in (("velocity", "axis_velocity"), ("acceleration", "axis_acceleration")):
        if getattr(call, norm) is not None and call.axis_acceleration is not None:
            raise InvalidField(norm, f"is the limit of the norm: give it or `{axis}`, not both")
    if call.axis_acceleration is None:
        if call.axis_velocity is not None:
            raise InvalidField("axis_acceleration", "is needed beside `axis_velocity`")
        if call.acceleration is None:
            raise InvalidField("acceleration", "is needed with `law` trapezoidal, or `axis_acceleration`")
        return LineLaw(call.velocity or np.inf, call.acceleration, **speeds, may_reverse=call.may_reverse), None
    velocity = np.full(len(displacement), np.inf) if call.axis_velocity is None else np.array(call.axis_velocity)
    axes = AxisLimits(velocity, np.array(call.axis_acceleration))
    compared_axes(displacement, axes)
    return LineLaw(*axes.along(displacement), **speeds, may_reverse=call.may_reverse), axes


def _planned(call: LineRequest) -> tuple[LineMotion, LineLaw, AxisLimits | None]:
    if len(call.target) != len(call.start):
        raise InvalidField(
            "target", f"has {counted(len(call.target), 'coordinate')}, and `start` has {len(call.start)}"
        )
    start, end = np.array(call.start), np.array(call.target)
    law, axes = _law(call, end - start)
    return along_line(start, end, law), law, axes


def _turn(call: LineRequest, found: LineMotion) -> Turn | None:
    first, last = call.start_orientation, call.target_orientation
    if first is None or last is None:
        if first is not last:
            missing = "start_orientation" if first is None else "target_orientation"
            raise InvalidField(missing, "is needed beside the other orientation")
        return None
    turn = Turn(first.turned("start_orientation/")[0], last.turned("target_orientation/")[0])
    if found.law.duration == 0.0 and turn.by_axis.angle > 0.0:
        raise InvalidField("law", "where L = 0, only a polynomial with a `duration` turns the orientation")
    return turn


def _line(call: LineRequest) -> dict[str, Any]:
    found, law, axes = _planned(call)
    turn, times = _turn(call, found), sample_times(call, found.law)
    compared = None if axes is None else compared_axes(found.end - found.start, axes)
    steps = list(line_steps(found, law))
    is_quickest = found.planned is not None and found.length > 0.0 and law.duration is None
    if is_quickest and law.start_velocity == 0.0 == law.end_velocity and axes is None:
        steps.append(optimal_step(found))
    if axes is not None and compared is not None and found.length > 0.0:
        steps += axes_steps(found.end - found.start, axes, compared)
    return {
        "length": found.length,
        "direction": found.direction,
        "duration": found.law.duration,
        "profile": None if found.planned is None else profile_info(found.planned, 0),
        "sigma": _sigma(found, law),
        "samples": _samples(found, times),
        "axes": compared,
        "orientation": None if turn is None else _orientation(turn, found.share, times),
        "steps": steps if turn is None else [*steps, *turn_steps(turn, found.share)],
        "warnings": _warnings(found, turn),
        "certificate": line_certificate(found, law),
    }


def _sigma(found: LineMotion, law: LineLaw) -> dict[str, Any]:
    answer: dict[str, Any] = {"breaks": found.law.breaks, "coefficients": found.law.coefficients[:, :, 0].tolist()}
    for order, name, limit in ((1, "velocity", law.max_velocity), (2, "acceleration", law.acceleration)):
        peak, most = peaks(found.law, order), limit if np.isfinite(limit) else None
        value = float(peak.values[0])
        ratio = None if most is None else abs(value) / most
        answer[f"peak_{name}"] = {"value": value, "time": float(peak.times[0]), "limit": most, "ratio": ratio}
    return answer


def _samples(found: LineMotion, times: Array) -> dict[str, Any]:
    sigma, path = found.law.rates_at(times), found.motion.rates_at(times)
    names = ("sigma", "sigma_velocity", "sigma_acceleration")
    return {
        "times": times,
        **{name: values[:, 0] for name, values in zip(names, sigma, strict=True)},
        "s": found.share.at(times)[:, 0],
        **dict(zip(("positions", "velocities", "accelerations"), path, strict=True)),
    }


def _orientation(turn: Turn, share: PiecewisePolynomial, times: Array) -> dict[str, Any]:
    path, (middle, zyz_middle) = turn.by_axis, turn.middles
    turns, half = path.angle > 0.0, path.angle > np.pi - HALF_TURN
    speed = abs(float(peaks(share, 1).values[0]))
    ways = {}
    for name, way in (("about_axis", path), ("by_angles", turn.by_angles)):
        rotations, velocities, accelerations = rates(way, share, times)
        ways[name] = {
            "rotations": rotations.tolist(),
            "angular_velocities": velocities,
            "angular_accelerations": accelerations,
        }
    return {
        "axis": path.axis if turns else None,
        "base_axis": turn.base_axis if turns else None,
        "other_axis": -path.axis if half else None,
        "angle": path.angle,
        "peak_angular_velocity": speed * path.angle * turn.base_axis,
        "zyz_start": turn.by_angles.triple_at(0.0),
        "zyz_target": turn.by_angles.triple_at(1.0),
        "middle": middle.tolist(),
        "zyz_middle": zyz_middle.tolist(),
        "middle_difference": turn.apart,
        **ways,
        "max_rotation_error": turn.error(share.at(times)[:, 0]),
    }


def _warnings(found: LineMotion, turn: Turn | None) -> list[str]:
    texts = []
    if found.length == 0.0:
        texts.append(_("Both points are the same: L = 0, and the position does not move."))
    if turn is not None:
        if turn.by_axis.angle == 0.0:
            texts.append(_("Both orientations are the same: the axis is not defined."))
        elif turn.by_axis.angle > np.pi - HALF_TURN:
            texts.append(_("θ = π: the opposite axis leads to the same orientation, by other ones."))
        ends = [turn.by_angles.triple_at(x)[1] for x in (0.0, 1.0)]
        if min(abs(np.sin(ends))) < _DEGENERATE:
            texts.append(_("sin θ = 0 at an end: only the sum or the difference of φ and ψ is determined there."))
    return texts


def _picture(call: LineRequest, kind: PictureFormat) -> bytes:
    from gelenk.plots.motion.line import line_picture  # noqa: PLC0415

    found, law, _axes = _planned(call)
    line_certificate(found, law)
    return line_picture(found.length, found.law, (law.max_velocity, law.acceleration), kind)
