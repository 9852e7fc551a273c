"""Seven-phase profiles along a path of length 1, from rest to rest, computed for many limits at once.

Jerk j for t_j, acceleration a for t_a, jerk -j for t_j, coast, then the mirror image [Biagiotti2008]. From rest to
rest, `jerk_limited` finds the same profile.
"""

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_SHORTEST = 1e-5
"""Shortest phase as a fraction of the whole: jerk phases last at least this long, other shorter phases are dropped."""


def phases(caps: Array) -> tuple[Array, Array, Array]:
    """Return the durations of jerk, of constant acceleration and of the coast in the least time; shape (N,) each.

    The caps are the largest speed, acceleration and jerk; shape (N, 3), [1/s, 1/s², 1/s³].
    """
    v, a, j = caps.T
    # The speed at which no coast is left: with the full acceleration reached, or without.
    lag = a / j
    reached = 0.5 * a * (np.sqrt(lag**2 + 4.0 / a) - lag)
    peak = np.minimum(v, np.where(reached >= a * lag, reached, np.cbrt(0.25 * j)))
    jerking = np.minimum(lag, np.sqrt(peak / j))
    even = np.maximum(peak / (j * jerking) - jerking, 0.0)
    coast = np.maximum(1.0 / peak - (2.0 * jerking + even), 0.0)
    return jerking, even, coast


def lasting(caps: Array) -> Array:
    """Return the duration of each profile; shape (N,), [s]."""
    jerking, even, coast = phases(caps)
    total: Array = 4.0 * jerking + 2.0 * even + coast
    return total


def planned(caps: Array) -> PiecewisePolynomial:
    """Return one profile as s(t), with its own duration, for caps of shape (3,), in the units of `phases`."""
    found = np.array(phases(caps[None]))
    total = float(np.array([4.0, 2.0, 1.0]) @ found[:, 0])
    jerking, even, coast = np.where(found > _SHORTEST * total, found, [[_SHORTEST * total], [0.0], [0.0]])
    widths = np.hstack((jerking, even, jerking, coast, jerking, even, jerking))
    states = [np.delete(column[0, ::2], 4) for column in _states((jerking, even, coast), 2)]
    lasts = widths > 0.0
    rows = np.column_stack(states)[lasts] / np.array([1.0, 1.0, 2.0, 6.0])
    return PiecewisePolynomial(np.concatenate(([0.0], np.cumsum(widths[lasts]))), rows[:, :, None])


def profiles(caps: Array, count: int) -> tuple[Array, Array, Array, Array]:
    """Return s, ṡ, s̈ and s⃛ at `count` evenly spread instants of each phase and half coast; shape (N, 8 count) each."""
    return _states(phases(caps), count)


def _states(lasting_each: tuple[Array, Array, Array], count: int) -> tuple[Array, Array, Array, Array]:
    jerking, even, coast = (values[:, None] for values in lasting_each)
    shares = np.linspace(0.0, 1.0, count)
    rising, steady, falling, coasting = (width * shares for width in (jerking, even, jerking, 0.5 * coast))
    ramp = 2.0 * jerking + even
    # Choose the jerk so that s ends at 1 despite rounding.
    j = 1.0 / (jerking * (jerking + even) * (ramp + coast))
    a, v = j * jerking, j * jerking * (jerking + even)
    left, first = falling[:, ::-1], j * jerking**3 / 6.0
    one, none = np.ones_like(rising), np.zeros_like(rising)
    jerk = np.hstack((j * one, none, -j * one, none))
    acceleration = np.hstack((j * rising, a * one, j * left, none))
    speed = np.hstack((0.5 * j * rising**2, a * (0.5 * jerking + steady), v - 0.5 * j * left**2, v * one))
    places = (
        j * rising**3 / 6.0,
        first + 0.5 * a * steady * (jerking + steady),
        v * (0.5 * ramp - left) + j * left**3 / 6.0,
        v * (0.5 * ramp + coasting),
    )
    s = np.hstack(places)
    mirrored = (1.0 - s[:, ::-1], speed[:, ::-1], -acceleration[:, ::-1], jerk[:, ::-1])
    found = [np.hstack(pair) for pair in zip((s, speed, acceleration, jerk), mirrored, strict=True)]
    return found[0], found[1], found[2], found[3]
