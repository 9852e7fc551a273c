"""Point-to-point motion in the least time under limits of velocity, acceleration and jerk, all joints synchronized.

The switching times come from Ruckig [Berscheid2021], which finds them in closed form; its features that call a server
are not used. Ruckig accepts an error of 1e-8 at the target. So its profiles are integrated here, and if the end is off
by more than rounding, the smallest change of the jerks closes the gap: the motion ends exactly at its target.
"""

from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np
import ruckig

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

Synchronization: TypeAlias = Literal["time", "phase"]

LONGEST = 7600.0
"""Longest duration for which Ruckig's arithmetic is accurate, [s]."""
SMALLEST, LARGEST = 1e-9, 1e9
"""Range of a limit."""

_SAME = 1e-12
"""Switching times that differ by less, in fractions of the whole motion, are merged."""
_ROUNDING = 1e-13
_EXCESS = 1e-9
"""Allowed relative excess over a limit from closing the gap at the end."""
_ATTEMPTS = 4
_OFF_LINE = 1e-9
"""Allowed deviation of a velocity or acceleration from a straight line, in fractions of its limit."""


@dataclass(frozen=True, slots=True)
class JointState:
    """State of the joints at an instant.

    Attributes:
        positions: Shape (n,), [rad or m].
        velocities: Shape (n,), [rad/s or m/s].
        accelerations: Shape (n,), [rad/s² or m/s²].
    """

    positions: Array
    velocities: Array
    accelerations: Array


@dataclass(frozen=True, slots=True)
class JerkLimits:
    """The limits of each joint, for both directions.

    Attributes:
        velocity: Shape (n,), [rad/s or m/s].
        acceleration: Shape (n,), [rad/s² or m/s²].
        jerk: Shape (n,), [rad/s³ or m/s³].
    """

    velocity: Array
    acceleration: Array
    jerk: Array


def at_rest(positions: Array) -> JointState:
    """Return the state of joints at rest; positions of shape (n,), [rad or m]."""
    return JointState(positions, np.zeros_like(positions), np.zeros_like(positions))


def jerk_limited(
    start: JointState,
    end: JointState,
    limits: JerkLimits,
    *,
    synchronization: Synchronization = "time",
    minimum_duration: float | None = None,
) -> PiecewisePolynomial:
    """Return the motion of least duration from one state to another: cubics, C² throughout.

    All joints start and end together. Synchronization by `phase` also keeps one fixed proportion, a straight line
    in joint space; this can take longer, and velocities and accelerations at the ends must lie along the line.

    Args:
        start: Within the limits, and able to stay within them afterwards.
        end: Within the limits, and reachable without exceeding them before.
        limits: Each > 0.
        synchronization: How joints are synchronized.
        minimum_duration: ≥ 0, [s]; if a moving start or end makes this duration impossible, the next longer possible
            one is used.

    Returns:
        The motion, from time 0 on. With zero duration it is one piece whose two breaks are equal.

    Raises:
        InvalidField: A limit is not positive, a state is beyond the limits or off the straight line, or no motion is
            shorter than `LONGEST`.
    """
    _check_limits(limits)
    _check_state("start", start, limits, direction=1.0)
    _check_state("end", end, limits, direction=-1.0)
    if minimum_duration is not None and not 0.0 <= minimum_duration <= LONGEST:
        raise InvalidField("duration", f"must be a number from 0 to {LONGEST:g} seconds")
    if len(start.positions) == 0:  # Ruckig divides by the number of joints.
        return PiecewisePolynomial(np.array([0.0, minimum_duration or 0.0]), np.empty((1, 1, 0)))
    if synchronization == "phase":
        return _along_line(start, end, limits, minimum_duration)
    return _in_time(start, end, limits, minimum_duration)


def _along_line(
    start: JointState, end: JointState, limits: JerkLimits, minimum_duration: float | None
) -> PiecewisePolynomial:
    """Return the fastest motion along the straight line, planned for the joint that goes furthest."""
    distances = end.positions - start.positions
    furthest = distances[np.argmax(np.abs(distances))]
    shares = distances / furthest if furthest != 0.0 else np.zeros_like(distances)
    ends = [_on_line(field, state, shares, limits) for field, state in (("start", start), ("end", end))]
    if furthest == 0.0:
        return _in_time(start, end, limits, minimum_duration)
    with np.errstate(divide="ignore"):
        bounds = [
            (values / np.abs(shares)).min(keepdims=True)
            for values in (limits.velocity, limits.acceleration, limits.jerk)
        ]
    goal = replace(ends[1], positions=np.array([furthest]))
    line = _in_time(ends[0], goal, JerkLimits(*bounds), minimum_duration)
    coefficients = line.coefficients * shares
    coefficients[:, 0] += start.positions
    return PiecewisePolynomial(line.breaks, coefficients)


def _on_line(field: str, state: JointState, shares: Array, limits: JerkLimits) -> JointState:
    """Return the state at an end of the joint that goes furthest, at position 0; refuse a state off the line."""
    found = []
    for name, values, bound in (
        ("velocities", state.velocities, limits.velocity),
        ("accelerations", state.accelerations, limits.acceleration),
    ):
        along = values[np.argmax(np.abs(shares))]
        off = np.abs(values - along * shares) > _OFF_LINE * bound
        if off.any():
            reason = "is not in proportion to the distances, so the joints cannot be synchronized by phase"
            raise InvalidField(f"{field}/{name}/{int(np.argmax(off))}", reason)
        found.append(np.array([along]))
    return JointState(np.zeros(1), *found)


def _in_time(
    start: JointState, end: JointState, limits: JerkLimits, minimum_duration: float | None
) -> PiecewisePolynomial:
    """Return the fastest motion of joints that start and end together."""
    tightened = limits
    for _ in range(_ATTEMPTS):
        profiles = _profiles(start, end, tightened, minimum_duration)
        motion, is_as_found = _of_profiles(start, end, *profiles)
        excess = 0.0 if is_as_found else _excess(motion, limits)
        if excess <= _EXCESS:
            return motion
        tightened = _tightened(tightened, 1.0 - 2.0 * excess, start, end)
    raise InvalidField("limits", "the numbers of this motion differ by too many powers of ten to be planned accurately")


def _check_limits(limits: JerkLimits) -> None:
    for name in ("velocity", "acceleration", "jerk"):
        values = getattr(limits, name)
        wrong = ~((values >= SMALLEST) & (values <= LARGEST))
        if wrong.any():
            reason = f"must be a number from {SMALLEST:g} to {LARGEST:g}"
            raise InvalidField(f"limits/joint_{name}/{int(np.argmax(wrong))}", reason)


def _check_state(field: str, state: JointState, limits: JerkLimits, *, direction: float) -> None:
    """Check the limits now, and where acceleration has been brought to zero: after the start, or before the end."""
    q, v, a = state.positions, state.velocities, state.accelerations
    room = 1.0 + _ROUNDING
    at_zero_acceleration = v + direction * a * np.abs(a) / (2.0 * limits.jerk)
    checks = (
        ("positions", ~(np.abs(q) <= LARGEST), f"must be a number of magnitude ≤ {LARGEST:g}"),
        ("velocities", ~(np.abs(v) <= limits.velocity * room), "is beyond the limit of velocity"),
        ("accelerations", ~(np.abs(a) <= limits.acceleration * room), "is beyond the limit of acceleration"),
        (
            "accelerations",
            np.abs(at_zero_acceleration) > limits.velocity * room,
            "cannot be brought to zero under the limit of jerk without passing the limit of velocity",
        ),
    )
    for name, wrong, reason in checks:
        if wrong.any():
            raise InvalidField(f"{field}/{name}/{int(np.argmax(wrong))}", reason)


def _profiles(
    start: JointState,
    end: JointState,
    limits: JerkLimits,
    minimum_duration: float | None,
) -> tuple[Array, Array]:
    """Return durations [s] and jerks of the phases of each joint; shape (n, phases) each."""
    joints = len(start.positions)
    task, found = ruckig.InputParameter(joints), ruckig.Trajectory(joints)
    # Only differences matter, and they are exact even if positions are far from zero.
    task.target_position = (end.positions - start.positions).tolist()
    task.current_velocity, task.current_acceleration = start.velocities.tolist(), start.accelerations.tolist()
    task.target_velocity, task.target_acceleration = end.velocities.tolist(), end.accelerations.tolist()
    task.max_velocity, task.max_acceleration = limits.velocity.tolist(), limits.acceleration.tolist()
    task.max_jerk, task.minimum_duration = limits.jerk.tolist(), minimum_duration
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


def _tightened(limits: JerkLimits, factor: float, start: JointState, end: JointState) -> JerkLimits:
    """Return smaller limits that the ends still keep."""
    velocity = np.maximum.reduce((factor * limits.velocity, np.abs(start.velocities), np.abs(end.velocities)))
    ends = np.abs(start.accelerations), np.abs(end.accelerations)
    return JerkLimits(velocity, np.maximum.reduce((factor * limits.acceleration, *ends)), factor * limits.jerk)


def _of_profiles(
    start: JointState, end: JointState, durations: Array, jerks: Array
) -> tuple[PiecewisePolynomial, bool]:
    """Merge the phases of each joint into one motion; return also whether their jerks ended it exactly."""
    switches = np.cumsum(durations, axis=1)
    breaks = _merged(switches)
    if breaks[-1] == 0.0:
        constant = np.stack((end.positions, end.velocities, end.accelerations / 2.0))
        return PiecewisePolynomial(np.zeros(2), constant[None]), True
    dts = np.diff(breaks)
    middle = 0.5 * (breaks[:-1] + breaks[1:])
    phases = np.minimum((switches[:, None, :] <= middle[:, None]).sum(axis=2), jerks.shape[1] - 1)
    rows = np.take_along_axis(jerks, phases, axis=1).T
    coefficients, is_as_found = _closed(start, end, dts, rows)
    return PiecewisePolynomial(breaks, coefficients), is_as_found


def _merged(switches: Array) -> Array:
    """Return all switching times in order, merging those that differ by rounding; the last one is kept."""
    times = np.sort(switches, axis=None)
    last = times[-1]
    inner = times[(times > _SAME * last) & (times < last * (1.0 - _SAME))]
    is_new = np.diff(inner, prepend=-np.inf) > _SAME * last
    merged: Array = np.concatenate(([0.0], inner[is_new], [last]))
    return merged


def _closed(start: JointState, end: JointState, dts: Array, jerks: Array) -> tuple[Array, bool]:
    """Return coefficients with the jerks changed by the least that ends exactly, and whether by none."""
    given = jerks
    for _ in range(_ATTEMPTS):
        coefficients, missed = _integrated(start, end, dts, jerks)
        q, v, a = np.abs(coefficients[:, :3]).max(axis=0)
        rounding = _ROUNDING * np.stack((q + np.abs(end.positions) + dts.sum() * v, v, a))
        late = np.flatnonzero((np.abs(missed) > rounding).any(axis=0))
        if len(late) == 0:
            break
        jerks = jerks.copy()
        for j in late:
            jerks[:, j] += _correction(dts, jerks[:, j], missed[:, j])
    return coefficients, jerks is given


def _integrated(start: JointState, end: JointState, dts: Array, jerks: Array) -> tuple[Array, Array]:
    """Return coefficients, (M, 4, n), and the errors of position, velocity and acceleration at the end, (3, n)."""
    dt = dts[:, None]
    a = np.concatenate((start.accelerations[None], start.accelerations + np.cumsum(jerks * dt, axis=0)))
    steps = dt * (a[:-1] + dt * jerks / 2.0)
    v = np.concatenate((start.velocities[None], start.velocities + np.cumsum(steps, axis=0)))
    steps = dt * (v[:-1] + dt * (a[:-1] / 2.0 + dt * jerks / 6.0))
    q = np.concatenate((start.positions[None], start.positions + np.cumsum(steps, axis=0)))
    coefficients = np.stack((q[:-1], v[:-1], a[:-1] / 2.0, jerks / 6.0), axis=1)
    return coefficients, np.stack((end.positions - q[-1], end.velocities - v[-1], end.accelerations - a[-1]))


def _correction(dts: Array, jerks: Array, missed: Array) -> Array:
    """Return the least relative change of one joint's jerks that removes its errors at the end; shape (M,)."""
    total = dts.sum()
    ts, left = dts / total, 1.0 - np.cumsum(dts) / total
    effects = np.stack((ts**3 / 6.0 + ts**2 * left / 2.0 + ts * left**2 / 2.0, ts**2 / 2.0 + ts * left, ts))
    units = np.array([total**-3, total**-2, total**-1])
    weights = np.abs(jerks) / np.sqrt(np.maximum(ts, _SAME))
    change: Array = weights * np.linalg.lstsq(effects * weights, units * missed, rcond=_ROUNDING)[0]
    return change


def _excess(motion: PiecewisePolynomial, limits: JerkLimits) -> float:
    """Return the largest relative excess over a limit; negative if all limits are kept with room."""
    bounds = (limits.velocity, limits.acceleration, limits.jerk)
    return max(float((np.abs(peaks(motion, k).values) / bound).max()) for k, bound in enumerate(bounds, 1)) - 1.0
