"""Motions of phases of constant acceleration, each coordinate with switching times of its own."""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from gelenk.model.arrays import Array
from gelenk.model.errors import InvalidField
from gelenk.trajectory.polynomial import PiecewisePolynomial

Phase: TypeAlias = tuple[float, float]
"""How long, [s], and the acceleration, [rad/s² or m/s²]."""

_SAME = 1e-14
"""Switching times that differ by less, in fractions of the whole motion, are one."""
_SHORTEST = 1e-6
"""Least time to the greatest speed, in fractions of the latest time: a double has no digits for less."""


def of_phases(
    starts: Array,
    start_velocities: Array,
    phases: Sequence[Sequence[Phase]],
    start_time: float = 0.0,
    field: str = "limits.joint_acceleration",
) -> PiecewisePolynomial:
    """The motion; its breaks are the switching times of all coordinates.

    Phases of no duration are left out. A motion of no duration at all is one piece whose two breaks are the same.

    Args:
        starts: Positions at first; shape (n,), [rad or m].
        start_velocities: Velocities at first; shape (n,), [rad/s or m/s].
        phases: Of each coordinate, in order; their durations add up to the same time.
        start_time: When it begins, [s].
        field: What is to blame where phases are too short.

    Raises:
        InvalidField: A speed is reached so fast that the switching times do not tell when.
    """
    own = [_alone(*one) for one in zip(starts, start_velocities, phases, strict=True)]
    breaks = _merged([breaks for breaks, _ in own])
    _check_resolution(own, max(abs(start_time), abs(start_time + breaks[-1])), field)
    rows = np.empty((len(breaks) - 1, 3, len(own)))
    for j, (switches, c) in enumerate(own):
        middle = 0.5 * (breaks[:-1] + breaks[1:])
        i = np.clip(np.searchsorted(switches, middle, side="right") - 1, 0, len(c) - 1)
        dt = breaks[:-1] - switches[i]
        rows[:, 0, j] = c[i, 0] + dt * (c[i, 1] + dt * c[i, 2])
        rows[:, 1, j] = c[i, 1] + 2.0 * dt * c[i, 2]
        rows[:, 2, j] = c[i, 2]
    return PiecewisePolynomial(start_time + breaks, rows)


def _alone(q: float, v: float, phases: Sequence[Phase]) -> tuple[Array, Array]:
    """Breaks and coefficients of one coordinate; shapes (M + 1,) and (M, 3)."""
    breaks, rows = [0.0], []
    for duration, acceleration in phases:
        if duration > 0.0:
            rows.append((q, v, 0.5 * acceleration))
            q, v = q + duration * (v + 0.5 * acceleration * duration), v + acceleration * duration
            breaks.append(breaks[-1] + duration)
    if not rows:
        return np.zeros(2), np.array([(q, v, 0.0)])
    return np.array(breaks), np.array(rows)


def _check_resolution(own: Sequence[tuple[Array, Array]], latest: float, field: str) -> None:
    for j, (_, c) in enumerate(own):
        speed, acceleration = float(np.abs(c[:, 1]).max()), 2.0 * float(np.abs(c[:, 2]).max())
        if acceleration * _SHORTEST * latest > speed > 0.0:
            raise InvalidField(
                field,
                f"joint {j + 1} reaches its speed within {speed / acceleration:.3g} s, and times go up to "
                f"{latest:.3g} s: less than a millionth of that cannot be told apart; let it accelerate more slowly",
            )


def _merged(switches: Sequence[Array]) -> Array:
    """All switching times in order, those that differ by rounding once, the latest of all at the end."""
    times = np.unique(np.concatenate(switches))
    kept = [0.0]
    for time in times[times < times[-1] * (1.0 - _SAME)]:
        if time - kept[-1] > _SAME * times[-1]:
            kept.append(float(time))
    return np.array([*kept, times[-1]])
