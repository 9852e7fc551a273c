"""Point-to-point motion in the least time under limits of velocity, acceleration and jerk, all joints synchronized.

The switching times come from Ruckig [Berscheid2021], which finds them in closed form; its features that call a server
are not used. Ruckig accepts an error of 1e-8 at the target. So its profiles are integrated here, and if the end is off
by more than rounding, the smallest change of the jerks closes the gap: the motion ends exactly at its target.
"""

import numpy as np
import ruckig

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.time_scaling import LARGEST, check_limits
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.motion.phases import merged
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

LONGEST = 7600.0
"""Longest duration for which Ruckig's arithmetic is accurate, [s]."""

_SAME = 1e-12
"""Switching times that differ by less, in fractions of the whole motion, are merged."""
_ROUNDING = 1e-13
_EXCESS = 1e-9
"""Allowed relative excess over a limit from closing the gap at the end."""
_ATTEMPTS = 4
_FACTORIALS = np.array([[1.0], [1.0], [2.0]])


def at_rest(positions: Array) -> Array:
    """Return the state of joints at rest, (3, n), at positions of shape (n,), [rad or m]."""
    return np.array([positions, np.zeros_like(positions), np.zeros_like(positions)])


def jerk_limited(start: Array, end: Array, limits: Array) -> PiecewisePolynomial:
    """Return the motion of least duration from one state to another: cubics, C² throughout, from time 0 on.

    All joints start and end together. With zero duration it is one piece whose two breaks are equal.

    Args:
        start: Position, velocity and acceleration, within the limits and able to stay within them afterwards; shape
            (3, n), [rad or m per sᵏ].
        end: Likewise, and reachable without exceeding the limits before.
        limits: Of velocity, acceleration and jerk, for both directions; each > 0; shape (3, n).

    Raises:
        InvalidField: A limit is out of range, a state is beyond the limits, or no motion is shorter than `LONGEST`.
    """
    _check(start, end, limits)
    if start.shape[1] == 0:  # Ruckig divides by the number of joints.
        return PiecewisePolynomial(np.zeros(2), np.empty((1, 1, 0)))
    tightened = limits
    for _ in range(_ATTEMPTS):
        motion, is_as_found = _of_profiles(start, end, *_profiles(start, end, tightened))
        excess = 0.0 if is_as_found else _excess(motion, limits)
        if excess <= _EXCESS:
            return motion
        tightened = (1.0 - 2.0 * excess) * tightened
        # Both ends have to keep the smaller limits too.
        tightened[:2] = np.maximum.reduce((tightened[:2], np.abs(start[1:]), np.abs(end[1:])))
    raise InvalidField("limits", "the numbers of this motion differ by too many powers of ten to be planned accurately")


def _check(start: Array, end: Array, limits: Array) -> None:
    check_limits(limits)
    for field, state in (("start", start), ("end", end)):
        if not (np.abs(state[0]) <= LARGEST).all():
            raise InvalidField(field, f"positions must be of magnitude ≤ {LARGEST:g}")
        if not (np.abs(state[1:]) <= limits[:2] * (1.0 + _ROUNDING)).all():
            raise InvalidField(field, "is beyond the limits of velocity or acceleration")


def _profiles(start: Array, end: Array, limits: Array) -> tuple[Array, Array]:
    """Return durations [s] and jerks of the phases of each joint; shape (n, phases) each."""
    joints = start.shape[1]
    task, found = ruckig.InputParameter(joints), ruckig.Trajectory(joints)
    # Only differences matter, and they are exact even if positions are far from zero.
    task.target_position = (end[0] - start[0]).tolist()
    _, task.current_velocity, task.current_acceleration = start.tolist()
    _, task.target_velocity, task.target_acceleration = end.tolist()
    task.max_velocity, task.max_acceleration, task.max_jerk = limits.tolist()
    try:
        ruckig.Ruckig(joints).calculate(task, found)
    except ruckig.RuckigError as error:
        reason = "no motion was found: these limits and this distance are too many powers of ten apart"
        raise InvalidField("limits", reason) from error
    except ValueError as error:  # Ruckig's Python binding has no name for this result.
        raise InvalidField("limits", f"the motion would take longer than {LONGEST:g} s") from error
    profiles = found.profiles[0]
    durations = np.array([[*p.brake.t, *p.t, *p.accel.t] for p in profiles])
    return durations, np.array([[*p.brake.j, *p.j, *p.accel.j] for p in profiles])


def _of_profiles(start: Array, end: Array, durations: Array, jerks: Array) -> tuple[PiecewisePolynomial, bool]:
    """Merge the phases of each joint into one motion; return also whether their jerks ended it exactly."""
    switches = np.cumsum(durations, axis=1)
    breaks = merged(switches, _SAME)
    if breaks[-1] == 0.0:
        return PiecewisePolynomial(np.zeros(2), end[None] / _FACTORIALS), True
    middle = 0.5 * (breaks[:-1] + breaks[1:])
    phases = np.minimum((switches[:, None, :] <= middle[:, None]).sum(axis=2), jerks.shape[1] - 1)
    rows = np.take_along_axis(jerks, phases, axis=1).T
    coefficients, is_as_found = _closed(start, end, np.diff(breaks), rows)
    return PiecewisePolynomial(breaks, coefficients), is_as_found


def _closed(start: Array, end: Array, dts: Array, jerks: Array) -> tuple[Array, bool]:
    """Return coefficients with the jerks changed by the least that ends exactly, and whether by none."""
    given = jerks
    for _ in range(_ATTEMPTS):
        coefficients, missed = _integrated(start, end, dts, jerks)
        q, v, a = np.abs(coefficients[:, :3]).max(axis=0)
        rounding = _ROUNDING * np.stack((q + np.abs(end[0]) + dts.sum() * v, v, a))
        late = np.flatnonzero((np.abs(missed) > rounding).any(axis=0))
        if len(late) == 0:
            break
        jerks = jerks.copy()
        for j in late:
            jerks[:, j] += _correction(dts, jerks[:, j], missed[:, j])
    return coefficients, jerks is given


def _integrated(start: Array, end: Array, dts: Array, jerks: Array) -> tuple[Array, Array]:
    """Return coefficients, (M, 4, n), and the errors of position, velocity and acceleration at the end, (3, n)."""
    dt = dts[:, None]
    a = _accumulated(start[2], jerks * dt)
    v = _accumulated(start[1], dt * (a[:-1] + dt * jerks / 2.0))
    q = _accumulated(start[0], dt * (v[:-1] + dt * (a[:-1] / 2.0 + dt * jerks / 6.0)))
    coefficients = np.stack((q[:-1], v[:-1], a[:-1] / 2.0, jerks / 6.0), axis=1)
    return coefficients, end - np.stack((q[-1], v[-1], a[-1]))


def _accumulated(start: Array, steps: Array) -> Array:
    return np.concatenate((start[None], start + np.cumsum(steps, axis=0)))


def _correction(dts: Array, jerks: Array, missed: Array) -> Array:
    """Return the least relative change of one joint's jerks that removes its errors at the end; shape (M,)."""
    total = dts.sum()
    ts, left = dts / total, 1.0 - np.cumsum(dts) / total
    effects = np.stack((ts**3 / 6.0 + ts**2 * left / 2.0 + ts * left**2 / 2.0, ts**2 / 2.0 + ts * left, ts))
    units = np.array([total**-3, total**-2, total**-1])
    weights = np.abs(jerks) / np.sqrt(np.maximum(ts, _SAME))
    change: Array = weights * np.linalg.lstsq(effects * weights, units * missed, rcond=_ROUNDING)[0]
    return change


def _excess(motion: PiecewisePolynomial, limits: Array) -> float:
    """Return the largest relative excess over a limit; negative if all limits are kept with room."""
    return max(float((np.abs(peaks(motion, k).values) / bound).max()) for k, bound in enumerate(limits, 1)) - 1.0
