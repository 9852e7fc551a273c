"""POST /v1/course/spline: cubic splines through knots."""

from typing import Any

import numpy as np

from gelenk.contract.common import content_of
from gelenk.contract.spline import SplineRequest, SystemInfo
from gelenk.course.motion.check import MotionClaims
from gelenk.course.motion.spline_steps import spline_steps
from gelenk.course.motion.time_law_steps import peak_step
from gelenk.language import marked, translated as _
from gelenk.operations.course_motion import (
    PlannedMotion,
    is_heavy_motion,
    limit_warnings,
    limits_of,
    motion_outcome,
    row,
    table,
    unused,
)
from gelenk.operations.outcome import Outcome
from gelenk.trajectory.motion.extremes import peaks_by_order
from gelenk.trajectory.motion.splines import Boundary, EndRates, Spline, cubic_spline

_SHOWN_UNKNOWNS = 32
_OTHERS = marked("The worked solution shows {shown} of {joints} joints; A is the same for all.")
_TITLES: dict[Boundary, str] = {
    "clamped": marked("Cubic spline, clamped"),
    "natural": marked("Cubic spline, natural"),
    "not_a_knot": marked("Cubic spline, not a knot"),
    "periodic": marked("Cubic spline, periodic"),
    "assigned": marked("Cubic spline, assigned"),
}
_VELOCITIES = ("start_velocity", "end_velocity")
_ACCELERATIONS = ("start_acceleration", "end_acceleration")


def run(call: SplineRequest) -> Outcome:
    """Compute a cubic spline through knots, its peaks and samples, with a worked solution."""
    return motion_outcome(call, _plan)


is_heavy = is_heavy_motion


def _plan(call: SplineRequest) -> PlannedMotion:
    if call.boundary not in {"clamped", "assigned"}:
        unused(call, _VELOCITIES, f"is not allowed with `boundary` {call.boundary}")
    if call.boundary != "assigned":
        unused(call, (*_ACCELERATIONS, "fictitious_times"), "is only allowed with `boundary` assigned")
    times = np.array(call.times)
    knots = table(call.waypoints, "waypoints", len(times))
    rates = [row(getattr(call, name), knots.shape[1], name) for name in (*_VELOCITIES, *_ACCELERATIONS)]
    between = None if call.fictitious_times is None else (call.fictitious_times[0], call.fictitious_times[1])
    found = cubic_spline(times, knots, call.boundary, EndRates(*rates), between)
    limits, peaks = limits_of(call, knots.shape[1]), peaks_by_order(found.motion)
    given = {"clamped": 1, "assigned": 2}.get(call.boundary, 0)
    starts, ends = np.array(rates[::2])[:given], np.array(rates[1::2])[:given]
    further = {
        "boundary": call.boundary,
        "system": _system(found),
        "knots": _knots(found),
        "steps": (*spline_steps(found, call.boundary), peak_step(peaks[1], peaks[2])),
        "warnings": limit_warnings(peaks, limits, _OTHERS),
    }
    title = _(_TITLES[call.boundary])
    return PlannedMotion(found.motion, MotionClaims(times, knots, starts, ends, 2, peaks), limits, title, further)


def _system(found: Spline) -> dict[str, Any] | None:
    A = found.matrix
    if A is None:
        return None
    matrix, unknowns = A.dense().tolist() if len(A) <= _SHOWN_UNKNOWNS else None, [i + 1 for i in found.unknowns]
    return content_of(SystemInfo, A, matrix=matrix, right_side=found.right_side.tolist(), unknowns=unknowns)


def _knots(found: Spline) -> list[dict[str, Any]]:
    accelerations = found.motion.derivative(2).at(found.times)
    return [
        {
            "time": float(found.times[i]),
            "positions": found.knots[i].tolist(),
            "velocities": found.velocities[i].tolist(),
            "accelerations": accelerations[i].tolist(),
            "fictitious": i in found.fictitious,
        }
        for i in range(len(found.times))
    ]
