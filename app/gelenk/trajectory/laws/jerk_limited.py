"""Motion from state to state under limits of velocity, acceleration and jerk, in the least time or a given one.

`jerk_profiles` finds the profiles of each joint. All joints take the least time that every one of them can take; one
that could be faster mixes its highest and its lowest profile. The profiles are integrated here, and if the end is off
by more than rounding, the smallest change of the jerks closes the gap: the motion ends exactly at its target.
"""

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.jerk_profiles import JERKS, least_times, profiles
from gelenk.trajectory.laws.time_scaling import LARGEST, check_limits
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.motion.phases import merged
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_SAME = 1e-12
"""Switching times that differ by less, in fractions of the whole motion, are merged."""
_ROUNDING = 1e-13
_EXCESS = 1e-9
"""Allowed relative excess over a limit from closing the gap at the end, and of a state that is given."""
_SHORTER = 1e-9
"""Relative shortfall of a given duration that still means the least one."""
_ATTEMPTS = 4
_FACTORIALS = np.array([[1.0], [1.0], [2.0]])


def at_rest(positions: Array) -> Array:
    """Return the state of joints at rest, (3, n), at positions of shape (n,), [rad or m]."""
    return np.array([positions, np.zeros_like(positions), np.zeros_like(positions)])


def jerk_limited(start: Array, end: Array, limits: Array, duration: float | None = None) -> PiecewisePolynomial:
    """Return the motion from one state to another in the least time, or a given one: cubics, C² throughout, from 0 s.

    All joints start and end together. With zero duration it is one piece whose two breaks are equal.

    Args:
        start: Position, velocity and acceleration, within the limits and able to stay within them afterwards; shape
            (3, n), [rad or m per sᵏ].
        end: Likewise, and reachable without exceeding the limits before.
        limits: Of velocity, acceleration and jerk, for both directions; each > 0; shape (3, n).
        duration: T, [s]; the least if None.

    Raises:
        InvalidField: A limit is out of range, a state is beyond the limits, or not all joints can take this time.
    """
    start, end, limits = (np.ascontiguousarray(rows, dtype=float) for rows in (start, end, limits))
    _check(start, end, limits)
    if start.shape[1] == 0:
        return PiecewisePolynomial(np.array([0.0, duration or 0.0]), np.empty((1, 1, 0)))
    tightened = limits
    for _ in range(_ATTEMPTS):
        motion, is_as_found = _of_profiles(start, end, tightened, duration)
        excess = 0.0 if is_as_found else _excess(motion, limits)
        if excess <= _EXCESS:
            return motion
        tightened = (1.0 - 2.0 * excess) * tightened
        # Both ends have to keep the smaller limits too.
        tightened[:2] = np.maximum.reduce((tightened[:2], np.abs(start[1:]), np.abs(end[1:])))
    raise _too_far_apart()


def _too_far_apart() -> InvalidField:
    return InvalidField(
        "limits", "the numbers of this motion differ by too many powers of ten to be planned accurately"
    )


def _check(start: Array, end: Array, limits: Array) -> None:
    check_limits(limits)
    for field, state, sign in (("start", start, 1.0), ("end", end, -1.0)):
        if not (np.abs(state[0]) <= LARGEST).all():
            raise InvalidField(field, f"positions must be of magnitude ≤ {LARGEST:g}")
        check_rates(field, state[1:], limits)
        # Where the velocity goes to, or comes from, while the jerk changes the acceleration.
        v, a, j = state[1], state[2], limits[2]
        reason = "takes the velocity to {:.10g}, beyond its limit {:.10g}, because the jerk is limited"
        _refuse_beyond(f"{field}_accelerations", v + sign * 0.5 * a * np.abs(a) / j, limits[0], reason)


def check_rates(side: str, rates: Array, limits: Array) -> None:
    """Refuse velocities and accelerations at the `start` or the `end`, (2, n), beyond their limits, (3, n)."""
    for name, values, most in zip(("velocities", "accelerations"), rates, limits, strict=False):
        _refuse_beyond(f"{side}_{name}", values, most, "is {:.10g}, beyond its limit {:.10g}")


def _refuse_beyond(field: str, values: Array, most: Array, reason: str) -> None:
    wrong = ~(np.abs(values) <= most * (1.0 + _EXCESS))
    if wrong.any():
        j = int(wrong.argmax())
        raise InvalidField(field, f"that of joint {j + 1} {reason.format(values[j], most[j])}")


def _common_duration(start: Array, end: Array, limits: Array, wanted: float | None) -> float:
    """Return the least time that every joint can take, or the wanted one if every joint can take it, [s]."""
    least, times = least_times(start, end, limits)
    if not np.isfinite(least).all():
        raise _too_far_apart()
    slowest = int(least.argmax())
    if wanted is not None and wanted < least[slowest] * (1.0 - _SHORTER):
        raise InvalidField("duration", f"must be at least {least[slowest]:.10g} s, which joint {slowest + 1} needs")
    after = max(least[slowest], wanted or 0.0)
    for time in (after, *np.unique(times[(times > after) & np.isfinite(times)])):
        if profiles(start, end, limits, time)[2]:
            break
    else:
        raise _too_far_apart()
    if wanted is not None and time > after:
        reason = f"not all joints can take {wanted:.10g} s from these velocities and accelerations, but {time:.10g} s"
        raise InvalidField("duration", reason)
    return float(time)


def _of_profiles(start: Array, end: Array, limits: Array, wanted: float | None) -> tuple[PiecewisePolynomial, bool]:
    """Mix and merge the profiles of the joints into one motion; return also whether their jerks ended it exactly."""
    duration = _common_duration(start, end, limits, wanted)
    if duration == 0.0:
        return PiecewisePolynomial(np.zeros(2), end[None] / _FACTORIALS), True
    durations, shares, _ = profiles(start, end, limits, duration)
    weights = np.array([shares, shares - 1.0])
    switches = np.where(weights[:, :, None] == 0.0, duration, np.cumsum(durations, axis=2))
    switches[:, :, -1] = duration
    breaks = merged(switches, _SAME)
    middle = 0.5 * (breaks[:-1] + breaks[1:])
    phases = np.minimum((switches[:, :, None] <= middle[:, None]).sum(axis=3), len(JERKS) - 1)
    rows = np.einsum("kn,n,knm->mn", weights, limits[2], JERKS[phases])
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
