"""Configurations along a path from sample to sample, each the next to the one before, by elimination."""

from typing import NamedTuple

import numpy as np

from gelenk.kinematics.simd.kernels import COLUMN
from gelenk.kinematics.simd.lanes import LANES, Lanes, lanes, load, sqrt_lanes, store
from gelenk.robot.arrays import Array
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, inlined, unmanaged
from gelenk.trajectory.follow.kernels.elimination import (
    BEND,
    RIGHT,
    TWIST,
    WEIGHTS,
    Elimination,
    elimination,
    factored,
    gather,
    gather_goals,
    least_sigma,
    linearised,
    moved,
    store_change,
    store_errors,
    store_rest,
)
from gelenk.trajectory.follow.kernels.nearest import EXACT, FARTHEST, MOST_STEPS, NEARLY

_CORRECTIONS, _SETTLED = 2, 1e-12
"""Corrections of a spare motion, and its change that counts as none, [rad or m]."""


class Walk(NamedTuple):
    """Configurations along a path.

    Attributes:
        is_whole: Whether each sample has one, far from singularities.
        rates: q, q' and q''; shape (3, N, n).
        sigmas: Lower bounds of the smallest singular value of J; shape (N,).
        changes: Norms of dJ/ds; shape (N,).
    """

    is_whole: bool
    rates: Array
    sigmas: Array
    changes: Array


@compiled
def walked(
    flat: FlatChain, places: Array, positions: Array, rotations: Array, twists: Array, bends: Array, start: Array
) -> Walk:
    """Follow a path from a configuration at its first sample from sample to sample, as `step.next_knot` does.

    All lanes hold the same. Nothing here is done for several samples at once: each begins at the one before.

    Args:
        places: s of the samples, rising; shape (N,), [m or rad].
        positions, rotations, twists, bends: The path there; shapes (N, 3), (N, 3, 3), (N, 6), (N, 6).
        start: Shape (n,), [rad or m].
    """
    n, count, work, off = len(start), len(places), elimination(flat, len(start)), np.empty(len(start))
    walk = Walk(True, np.zeros((3, count, n)), np.zeros(count), np.zeros(count))
    rates = walk.rates
    for i in range(count):
        last = max(i - 1, 0)
        h, q, dq, ddq = places[i] - places[last], rates[0, last], rates[1, last], rates[2, last]
        rates[0, i] = start if i == 0 else q + h * (dq + 0.5 * h * ddq)
        gather_goals(positions[i : i + 1], rotations[i : i + 1], 0, work.state)
        gather(twists[i : i + 1], 0, TWIST, work.state)
        gather(bends[i : i + 1], 0, BEND, work.state)
        floor = EXACT * (1.0 + np.abs(positions[i]).max() + np.abs(rates[0, i]).max())
        for correction in range(1 + (_CORRECTIONS if n > COLUMN and i > 0 else 0)):
            if correction > 0:
                off[:] = q + 0.5 * h * (dq + rates[1, i]) + h * h / 12.0 * (ddq - rates[2, i]) - rates[0, i]
                if _along_self_motion(work, off) <= _SETTLED:
                    break
                rates[0, i] += off
            _spread(rates[0, i], 0, work.rates)
            if not _settled(flat, work, floor):
                return Walk(False, rates, walk.sigmas, walk.changes)
            walk.changes[i] = _store_rates(flat, work)
            for order in range(3):
                for j in range(n):
                    rates[order, i, j] = work.rates[(order * n + j) * LANES]
        walk.sigmas[i] = _first(work, least_sigma(work))
    return walk


@inlined
def _first(work: Elimination, values: Lanes) -> float:
    """Return the first of eight numbers."""
    store(work.number, 0, values)
    number: float = work.number[0]
    return number


@inlined
def _spread(values: Array, row: int, work: Array) -> None:
    """Write each number into a row of lanes."""
    for j in range(len(values)):
        store(work, row + j, lanes(values[j]))


@unmanaged
def _along_self_motion(work: Elimination, off: Array) -> float:
    """Leave of a change of the joints what J maps to zero; return its size."""
    zero = lanes(0.0)
    for k in range(COLUMN):
        store(work.state, RIGHT + k, zero)
    _spread(off, 0, work.rates)
    store_rest(work, RIGHT, work.J, 0)
    moved(work, RIGHT, 0)
    size = 0.0
    for j in range(len(off)):
        off[j] = work.rates[j * LANES]
        size = max(size, abs(off[j]))
    return size


@unmanaged
def _settled(flat: FlatChain, work: Elimination, floor: float) -> bool:
    """Lead q to the nearest configuration at the goal by Newton's method; J and its factors are those there."""
    before = np.inf
    for _ in range(MOST_STEPS):
        frame = linearised(flat, work)
        if not _first(work, factored(work)) > 0.0:
            break
        error = _first(work, store_errors(work, frame))
        if error <= floor or (error <= NEARLY and error > 0.5 * before):
            return True
        if not _first(work, moved(work, RIGHT, 0)) <= FARTHEST:
            break
        before = error
    return False


@unmanaged
def _store_rates(flat: FlatChain, work: Elimination) -> float:
    """Write q' and q'' at q, by the formula of `rate_field`; return the norm of dJ/ds."""
    n, zero = len(work.J) // (COLUMN * LANES), lanes(0.0)
    for j in range(2 * n):
        store(work.rates, n + j, zero)
    for k in range(COLUMN):
        store(work.state, WEIGHTS + k, load(work.state, TWIST + k))
    moved(work, WEIGHTS, 1)
    store_rest(work, TWIST, work.J, 1)
    moved(work, RIGHT, 1)
    square = store_change(flat, work)
    for j in range(n if n > COLUMN else 0):
        along = zero
        for k in range(COLUMN):
            along = along + load(work.change, COLUMN * j + k) * load(work.state, WEIGHTS + k)
        store(work.rates, 2 * n + j, along)
    for _ in range(2):
        store_rest(work, BEND, work.change, 1)
        store_rest(work, RIGHT, work.J, 2)
        moved(work, RIGHT, 2)
    return _first(work, sqrt_lanes(square))
