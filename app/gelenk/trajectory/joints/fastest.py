"""Compiled motions of joints from rest to rest in the least time, by closed forms.

A polynomial leads along the straight line q = q_i + s(t) Δq. The other laws are made of seven phases [Biagiotti2008]:
jerk j for t_j, constant acceleration for t_a, jerk -j for t_j, coast for t_c, and the mirror image; a trapezoid has no
jerk phases. A profile covers the distance 1, so that its three durations determine its speed, acceleration and jerk.
"""

import math
from functools import cache
from typing import NamedTuple

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.laws.laws import LAWS
from gelenk.trajectory.motion.time_laws import rest_to_rest

NO_LENGTH = 1e-12
"""Largest displacement that counts as standing still, [rad or m]."""
WORTH = 1e-6
"""Share of the duration that must be saved for leaving the straight line."""
_MOST = 5e5
"""Cap on limits, in units of the time that the tightest limit alone takes: doubles do not resolve shorter phases."""
_SAME = 1e-14
"""Switching times that differ by less, in fractions of the whole motion, are merged."""
_ACCELERATES = np.array([1.0, 1.0, 1.0, 0.0, -1.0, -1.0, -1.0])
_JERKS = np.array([1.0, 0.0, -1.0, 0.0, -1.0, 0.0, 1.0])


class LawShape(NamedTuple):
    """A law as the kernel takes it.

    Attributes:
        keeps_jerk: Whether the limit of jerk counts.
        peaks: Largest magnitudes of a polynomial's derivatives, from 0 to 1 in 1 s, whose limits count.
        coefficients: Of the polynomial s(t); empty for a law made of phases.
    """

    keeps_jerk: bool
    peaks: Array
    coefficients: Array


@cache
def shape_of(law: Law) -> LawShape:
    """Return the shape of a law."""
    one = LAWS[law]
    polynomial = np.empty(0) if one.conditions is None else rest_to_rest(0.0, 1.0, one.conditions).coefficients.ravel()
    return LawShape(one.keeps_jerk, np.array(one.peaks), polynomial)


@compiled
def fastest_motion(start: Array, target: Array, limits: Array, law: LawShape) -> tuple[Array, Array]:
    """Return breaks (M + 1,), [s], and coefficients (M, degree + 1, n), lowest power first.

    If nothing moves it is one piece whose two breaks are equal.

    Args:
        start, target: Shape (n,), n ≥ 1, [rad or m].
        limits: Of velocity, acceleration and jerk; shape (3, n).
    """
    steps = target - start
    if np.abs(steps).max() <= NO_LENGTH:
        standing = np.empty((1, 1, len(start)))
        standing[0, 0] = start
        return np.zeros(2), standing
    if len(law.coefficients):
        return _polynomial(start, steps, limits, law)
    return _of_phases(start, steps, _phases(steps, limits, law.keeps_jerk), 4 if law.keeps_jerk else 3)


@compiled
def _polynomial(start: Array, steps: Array, limits: Array, law: LawShape) -> tuple[Array, Array]:
    duration, shape = 0.0, law.coefficients
    for k in range(len(law.peaks)):
        for j in range(len(steps)):
            duration = max(duration, (law.peaks[k] * abs(steps[j]) / limits[k, j]) ** (1.0 / (k + 1)))
    coefficients = np.empty((1, len(shape), len(steps)))
    for k in range(len(shape)):
        coefficients[0, k] = shape[k] / duration**k * steps
    coefficients[0, 0] += start
    return np.array([0.0, duration]), coefficients


@compiled
def _phases(steps: Array, limits: Array, keeps_jerk: bool) -> Array:
    """Return t_j, t_a and t_c of each joint, all of one duration; shape (n, 3), [s].

    A joint that could be faster takes all phases in k times their own time. A law with jerk limits leads all joints
    along the line unless that takes longer.
    """
    n = len(steps)
    phases, line = np.zeros((n, 3)), np.full(3, np.inf)
    for j in range(n):
        if steps[j] != 0.0:
            caps = limits[:, j] / abs(steps[j])
            line = np.minimum(line, caps)
            phases[j] = _least(caps, keeps_jerk)
    lasting = 4.0 * phases[:, 0] + 2.0 * phases[:, 1] + phases[:, 2]
    longest = lasting.max()
    if keeps_jerk:
        on_line = _least(line, True)
        if longest >= (4.0 * on_line[0] + 2.0 * on_line[1] + on_line[2]) * (1.0 - WORTH):
            phases[:] = on_line
            return phases
    for j in range(n):
        if lasting[j] > 0.0:
            phases[j] *= longest / lasting[j]
        else:
            phases[j, 2] = longest
    return phases


@compiled
def _least(caps: Array, keeps_jerk: bool) -> Array:
    """Return t_j, t_a and t_c of the fastest profile under caps of speed, acceleration and jerk."""
    unit = max(1.0 / caps[0], math.sqrt(1.0 / caps[1]))
    if keeps_jerk:
        unit = max(unit, np.cbrt(1.0 / caps[2]))
    v, a, j = min(caps[0] * unit, _MOST), min(caps[1] * unit**2, _MOST), min(caps[2] * unit**3, _MOST)
    lag = a / j if keeps_jerk else 0.0
    # The speed at which no coast is left: with the full acceleration reached, or without.
    reached = 2.0 / (math.sqrt(lag * lag + 4.0 / a) + lag)
    peak = min(v, reached if reached >= a * lag else np.cbrt(0.25 * j))
    jerking = min(lag, math.sqrt(peak / j))
    even = max(peak / a - lag, 0.0)
    coast = max(1.0 / peak - (2.0 * jerking + even), 0.0)
    phases: Array = np.array([jerking, even, coast]) * unit
    return phases


@compiled
def _of_phases(start: Array, steps: Array, phases: Array, size: int) -> tuple[Array, Array]:
    """Return the motion in which each joint has its own phases; its breaks are the switching times of all joints."""
    n = len(steps)
    times, states, jerks = np.zeros((n, 8)), np.zeros((n, 7, 3)), np.empty((n, 7))
    for j in range(n):
        _integrate(start[j], steps[j], phases[j], times[j], states[j], jerks[j])
    breaks = _merged(times)
    coefficients = np.empty((len(breaks) - 1, size, n))
    for j in range(n):
        phase = 0
        for i in range(len(breaks) - 1):
            middle = 0.5 * (breaks[i] + breaks[i + 1])
            while phase < 6 and times[j, phase + 1] <= middle:
                phase += 1
            q, v, a = _carried(states[j, phase], jerks[j, phase], breaks[i] - times[j, phase])
            coefficients[i, 0, j], coefficients[i, 1, j], coefficients[i, 2, j] = q, v, 0.5 * a
            if size > 3:
                coefficients[i, 3, j] = jerks[j, phase] / 6.0
    return breaks, coefficients


@compiled
def _integrate(start: float, step: float, phases: Array, times: Array, states: Array, jerks: Array) -> None:
    """Write when each phase of a joint begins and the last one ends, its state at that time, and its jerk."""
    jerking, even, coast = phases
    rising = jerking + even
    top = step / (rising + jerking + coast)
    acceleration = top / rising if rising > 0.0 else 0.0
    widths = (jerking, even, jerking, coast, jerking, even, jerking)
    q, v = start, 0.0
    for i in range(7):
        jerks[i] = _JERKS[i] * acceleration / jerking if jerking > 0.0 else 0.0
        a = acceleration * _ACCELERATES[i]
        if jerks[i] != 0.0 and i % 4 == 0:  # The jerk starts from acceleration 0.
            a = 0.0
        states[i] = q, v, a
        q, v, _ = _carried(states[i], jerks[i], widths[i])
        times[i + 1] = times[i] + widths[i]


@compiled
def _carried(state: Array, jerk: float, dt: float) -> tuple[float, float, float]:
    """Return position, velocity and acceleration after some time of constant jerk."""
    q, v, a = state
    return (
        q + dt * (v + dt * (0.5 * a + dt * jerk / 6.0)),
        v + dt * (a + 0.5 * dt * jerk),
        a + dt * jerk,
    )


@compiled
def _merged(times: Array) -> Array:
    """Return 0 and all switching times in order, without those that are the same up to rounding."""
    ordered = np.sort(times.ravel())
    last = ordered[-1]
    breaks, count = np.zeros(len(ordered)), 1
    for time in ordered:
        if time - breaks[count - 1] > _SAME * last and time < last * (1.0 - _SAME):
            breaks[count] = time
            count += 1
    breaks[count] = last
    return breaks[: count + 1]
