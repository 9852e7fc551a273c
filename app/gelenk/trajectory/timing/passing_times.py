"""A time law that passes places of a path at given times: a clamped cubic spline s(t) that never goes backwards."""

import numpy as np

from gelenk.errors import InvalidField, counted
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.composition import in_time
from gelenk.trajectory.motion.extremes import candidates
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import cubic_spline
from gelenk.trajectory.paths.path_geometry import LimitedPath
from gelenk.trajectory.timing.path_peaks import peaks_of
from gelenk.trajectory.timing.timing import Timed

_ROUNDING = 1e-9


def passing_at(geometry: LimitedPath, places: Array, times: Array) -> Timed:
    """Plan the motion along a path, from rest to rest, that passes each place at its time; C² where the path is.

    Args:
        geometry: The path of the joints, complete, and the limits.
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
        reason = f"{peaks.binding(geometry.limits)}: to keep the limits, multiply all times by {peaks.factor:.10g}"
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
