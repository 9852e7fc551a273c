"""Motions made of phases of constant acceleration, with separate switching times for each coordinate."""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

Phase: TypeAlias = Sequence[float]
"""Duration, [s], and acceleration, [rad/s² or m/s²]."""

_SAME = 1e-14
"""Difference, as a fraction of the whole duration, below which switching times are merged into one."""
_SHORTEST = 1e-6
"""Least time to reach the top speed, as a fraction of the latest time: a double cannot resolve less."""


def of_phases(
    starts: Array,
    start_velocities: Array,
    phases: Sequence[Sequence[Phase]],
    start_time: float = 0.0,
    field: str = "limits.joint_acceleration",
) -> PiecewisePolynomial:
    """Build a motion from phases; its breaks are the switching times of all coordinates.

    Phases of zero duration are dropped. A motion of zero duration is one piece whose two breaks coincide.

    Args:
        starts: Initial positions; shape (n,), [rad or m].
        start_velocities: Shape (n,), [rad/s or m/s].
        phases: Phases of each coordinate in order; their durations add up to the same time for all.
        start_time: Time at which the motion begins, [s].
        field: Request field to blame if phases are too short.

    Raises:
        InvalidField: A speed is reached so fast that the switching times cannot be told apart.
    """
    own = [_alone(*one) for one in zip(starts, start_velocities, phases, strict=True)]
    breaks = merged(np.concatenate([breaks for breaks, _ in own]), _SAME)
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


def merged(switches: Array, same: float) -> Array:
    """Return 0 and all switching times in order, without those that differ by less than a share `same` of the last."""
    times = np.sort(switches, axis=None)
    last = times[-1]
    inner = times[(times > same * last) & (times < last * (1.0 - same))]
    is_new = np.diff(inner, prepend=-np.inf) > same * last
    return np.concatenate(([0.0], inner[is_new], [last]))
