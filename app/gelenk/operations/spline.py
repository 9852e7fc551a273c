"""POST /v1/course/spline: cubic splines through knots."""

from typing import Any

import numpy as np

from gelenk.contract.spline import SplineRequest
from gelenk.course.motion.formulas import SHOWN_JOINTS
from gelenk.course.motion.spline_steps import spline_steps
from gelenk.course.motion.time_law_steps import peak_step
from gelenk.operations.course_motion import (
    PeaksByOrder,
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
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.splines import EndRates, Spline, cubic_spline

_SHOWN_UNKNOWNS = 32
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
    joints = knots.shape[1]
    ends = EndRates(*(row(getattr(call, name), joints, name) for name in (*_VELOCITIES, *_ACCELERATIONS)))
    between = None if call.fictitious_times is None else (call.fictitious_times[0], call.fictitious_times[1])
    found = cubic_spline(times, knots, call.boundary, ends, between)
    limits = limits_of(call, joints)

    def told(peaks: PeaksByOrder) -> dict[str, Any]:
        warnings = limit_warnings(peaks, limits)
        if joints > SHOWN_JOINTS:
            warnings.append(f"The worked solution shows {SHOWN_JOINTS} of {joints} joints; A is the same for all.")
        return {
            "boundary": call.boundary,
            "system": _system(found),
            "knots": _knots(found),
            "steps": (*spline_steps(found, call.boundary), peak_step(peaks[1], peaks[2])),
            "warnings": warnings,
        }

    starts, finals = _end_rates(call, ends, joints)
    return PlannedMotion(
        found.motion, limits, times, knots, starts, finals, 2, f"Cubic spline, {call.boundary.replace('_', ' ')}", told
    )


def _end_rates(call: SplineRequest, ends: EndRates, joints: int) -> tuple[Array, Array]:
    """Return the derivatives that the boundary gives, at the start and at the end."""
    if call.boundary == "clamped":
        return ends.start_velocity[None], ends.end_velocity[None]
    if call.boundary == "assigned":
        return (
            np.array([ends.start_velocity, ends.start_acceleration]),
            np.array([ends.end_velocity, ends.end_acceleration]),
        )
    return np.empty((0, joints)), np.empty((0, joints))


def _system(found: Spline) -> dict[str, Any] | None:
    A = found.matrix
    if A is None:
        return None
    return {
        "matrix": A.dense().tolist() if len(A) <= _SHOWN_UNKNOWNS else None,
        "lower": A.lower,
        "diagonal": A.diagonal,
        "upper": A.upper,
        "right_side": found.right_side.tolist(),
        "unknowns": [i + 1 for i in found.unknowns],
    }


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
