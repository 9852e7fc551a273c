"""A time law that passes places of a path at given times: a clamped cubic spline s(t) that never goes backwards."""

import numpy as np

from gelenk.errors import InvalidField, counted
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.composition import in_time
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import checked_times, cubic_spline
from gelenk.trajectory.paths.path_geometry import TipMotion, geometry_of
from gelenk.trajectory.paths.paths import Path
from gelenk.trajectory.problem.problem import SegmentLimits
from gelenk.trajectory.timing.path_peaks import peaks_of
from gelenk.trajectory.timing.timing import Timed

_ROUNDING = 1e-9


def passing_at(
    path: Path,
    joints: PiecewisePolynomial,
    places: Array,
    times: Array,
    limits: SegmentLimits,
    tip_motion: TipMotion | None,
) -> Timed:
    """Plan the motion along a path, from rest to rest, that passes each place at its time; C² where the path is.

    Args:
        path: Path of the tip.
        joints: q(s) along the whole path.
        places: s of each waypoint after the start; shape (m,), [m or rad].
        times: Time of each waypoint, counted from the start; shape (m,), [s].
        limits: Limits of joints and tip.
        tip_motion: See `timed`.

    Raises:
        InvalidField: The times do not increase, would make the tip go backwards, or are too short for the limits.
    """
    if len(times) != len(places):
        raise InvalidField("times", f"{counted(len(times), 'entry')} for {counted(len(places), 'waypoint')}")
    knots = np.concatenate(([0.0], times))
    checked_times(knots, "times")
    law = cubic_spline(knots, np.concatenate(([0.0], places))[:, None], "clamped").motion
    _refuse_going_back(law)
    motion = in_time(joints, law)
    geometry = geometry_of(path, joints, limits, tip_motion)
    peaks = peaks_of(geometry, motion, law, with_jerk=False)
    if peaks.factor > 1.0 + _ROUNDING:
        reason = f"{peaks.binding(limits)}: to keep the limits, multiply all times by {peaks.factor:.10g}"
        raise InvalidField("times", reason)
    continuous = 1 if len(geometry.bends()) else 2
    return Timed(motion, law, continuous, False, "the times are given")


def _refuse_going_back(law: PiecewisePolynomial) -> None:
    """Refuse ds/dt < 0; the minimum on a piece is at an end or at the vertex of the parabola."""
    a, b, c = (law.coefficients[:, k, 0] for k in (1, 2, 3))
    widths = np.diff(law.breaks)
    turn = np.clip(np.divide(-b, 3.0 * c, out=np.zeros_like(b), where=c != 0.0), 0.0, widths)
    places = np.stack((np.zeros_like(widths), turn, widths))
    rates = a + places * (2.0 * b + places * 3.0 * c)
    least = rates.min(axis=0)
    if (least < -_ROUNDING * rates.max()).any():
        i = int(least.argmin())
        reason = (
            f"the tip would have to go backwards along its path between {law.breaks[i]:.6g} and "
            f"{law.breaks[i + 1]:.6g} s: space the times more evenly over the length of the path"
        )
        raise InvalidField("times", reason)
