"""Newton's method and rates of joints along a path, by elimination with JJᵀ = LDLᵀ; eight configurations at a time.

Several times as quick as a decomposition of J, and as good away from singularities; near one it says so.
"""

from typing import NamedTuple

import numpy as np

from gelenk.kinematics.simd.kernels import (
    COLUMN,
    Frame,
    first_frame,
    joint_columns,
    moved as driven,
    placed,
    variable_columns,
)
from gelenk.kinematics.simd.lanes import LANES, Lanes, abs_lanes, bits, lanes, load, max_lanes, sqrt_lanes, store, where
from gelenk.robot.arrays import Array
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, inlined, unmanaged

_LEAST = 1e-10
"""Pivot of a row, in fractions of its square, below which J nearly loses rank: σ is some 1e-5."""
_SETTLED = 1e-13
"""Newton's step of eight samples at once that counts as none, [rad or m]."""
_NEARLY_TURNED = 1e-6
"""Least square of the cosine of half an angle, which keeps its inverse finite."""

GOAL, TWIST, BEND, RIGHT, WEIGHTS = 0, 12, 18, 24, 30
"""First rows of `Elimination.state`."""

_Triple = tuple[Lanes, Lanes, Lanes]


class Elimination(NamedTuple):
    """Eight configurations with their rates along a path, and work space, in rows of lanes.

    Attributes:
        rates: q, q' and q'' of each variable; 3n rows.
        state: Rotation and position of the tip's goal, ξ and ξ' of the path, and two vectors of six numbers.
        columns: Columns of the Jacobian by joint; J: by variable; change: dJ/ds.
        L: Factors of JJᵀ, with the inverse of D on the diagonal.
        number: One row.
    """

    rates: Array
    state: Array
    columns: Array
    J: Array
    change: Array
    L: Array
    number: Array


@compiled
def elimination(flat: FlatChain, n: int) -> Elimination:
    """Allocate the work space for a chain of n variables."""
    size = COLUMN * n * LANES
    return Elimination(
        np.zeros(3 * n * LANES),
        np.zeros(36 * LANES),
        np.empty(COLUMN * len(flat.joints) * LANES),
        np.empty(size),
        np.empty(size),
        np.empty(36 * LANES),
        np.empty(LANES),
    )


@inlined
def linearised(flat: FlatChain, work: Elimination) -> Frame:
    """Write J at q; return the tip's frame."""
    frame = joint_columns(flat, work.rates, work.columns)
    variable_columns(flat, work.columns, work.J)
    return frame


@inlined
def tip_frame(flat: FlatChain, work: Array) -> Frame:
    """Return the tip's frame at q."""
    frame = first_frame(flat)
    for i in range(len(flat.joints)):
        value = flat.drives[i, 0] * load(work, flat.joints[i, 1]) + flat.drives[i, 1]
        frame = placed(driven(frame, flat.joints[i, 0], value), flat, i + 1)
    return frame


@inlined
def store_errors(work: Elimination, frame: Frame) -> Lanes:
    """Write the way from a frame to the goal, in metres and twice the sine of half the angle; return its size."""
    state, largest = work.state, lanes(0.0)
    for k in range(3):
        a, b = 3 * ((k + 2) % 3), 3 * ((k + 1) % 3)
        off, axial = load(state, GOAL + 9 + k) - frame[9 + k], lanes(0.0)
        for i in range(3):
            axial = axial + (load(state, GOAL + a + i) * frame[b + i] - load(state, GOAL + b + i) * frame[a + i])
        store(state, RIGHT + k, off)
        store(state, RIGHT + 3 + k, axial)
    square = lanes(1.0)
    for i in range(9):
        square = square + load(state, GOAL + i) * frame[i]
    scale = 0.5 / sqrt_lanes(max_lanes(0.25 * square, _NEARLY_TURNED))
    for k in range(3):
        turn = scale * load(state, RIGHT + 3 + k)
        store(state, RIGHT + 3 + k, turn)
        largest = max_lanes(largest, max_lanes(abs_lanes(load(state, RIGHT + k)), abs_lanes(turn)))
    return largest


@unmanaged
def factored(work: Elimination) -> Lanes:
    """Write the factors of JJᵀ; return 1 in lanes where J is far from losing rank, else 0."""
    J, L, n, good = work.J, work.L, len(work.J) // (COLUMN * LANES), lanes(1.0)
    for i in range(COLUMN):
        for k in range(i + 1):
            entry = lanes(0.0)
            for j in range(n):
                entry = entry + load(J, COLUMN * j + i) * load(J, COLUMN * j + k)
            square = entry
            for j in range(k if k < i else 0):
                entry = entry - load(L, COLUMN * i + j) * load(L, COLUMN * k + j)
            store(L, COLUMN * i + k, entry)
        # So far row i of L is multiplied by D.
        for k in range(i):
            product = load(L, COLUMN * i + k)
            share = product * load(L, (COLUMN + 1) * k)
            entry = entry - product * share
            store(L, COLUMN * i + k, share)
        good = where(entry > _LEAST * square, good, 0.0)
        store(L, (COLUMN + 1) * i, 1.0 / entry)
    return good


@unmanaged
def moved(work: Elimination, right: int, order: int) -> Lanes:
    """Add J⁺b to q, or to a derivative of some order; return the largest change.

    The vector b is in `state` from row `right` on; (JJᵀ)⁻¹b is left in its place.
    """
    J, L, state, n, largest = work.J, work.L, work.state, len(work.J) // (COLUMN * LANES), lanes(0.0)
    for i in range(COLUMN):
        value = load(state, right + i)
        for j in range(i):
            value = value - load(L, COLUMN * i + j) * load(state, right + j)
        store(state, right + i, value)
    for i in range(COLUMN - 1, -1, -1):
        value = load(state, right + i) * load(L, (COLUMN + 1) * i)
        for j in range(i + 1, COLUMN):
            value = value - load(L, COLUMN * j + i) * load(state, right + j)
        store(state, right + i, value)
    for j in range(n):
        change, row = lanes(0.0), order * n + j
        for k in range(COLUMN):
            change = change + load(J, COLUMN * j + k) * load(state, right + k)
        store(work.rates, row, load(work.rates, row) + change)
        # Unlike a maximum, this does not lose a NaN.
        largest = where(abs_lanes(change) <= largest, largest, abs_lanes(change))
    return largest


@inlined
def store_rest(work: Elimination, vector: int, matrix: Array, order: int) -> None:
    """Subtract the product of a matrix, J or dJ/ds, and q or a derivative from a vector, and write it as b."""
    n = len(work.J) // (COLUMN * LANES)
    for k in range(COLUMN):
        rest = load(work.state, vector + k)
        for j in range(n):
            rest = rest - load(matrix, COLUMN * j + k) * load(work.rates, order * n + j)
        store(work.state, RIGHT + k, rest)


@unmanaged
def store_change(flat: FlatChain, work: Elimination) -> Lanes:
    """Write dJ/ds for the given q', of the columns by joint; return the square of its norm.

    A column (v; w) changes with the joints before it, which turn it, and its v with the joints behind it.
    """
    n, zero = len(work.J) // (COLUMN * LANES), lanes(0.0)
    work.change[:] = 0.0
    turn, behind = (zero, zero, zero), (zero, zero, zero)
    for i in range(len(flat.joints)):
        behind = _plus(behind, _rate(flat, work, i), _part(work.columns, COLUMN * i))
    for i in range(len(flat.joints)):
        v, w, rate = _part(work.columns, COLUMN * i), _part(work.columns, COLUMN * i + 3), _rate(flat, work, i)
        behind = _plus(behind, -rate, v)
        spin = _cross(turn, w)
        turn = _plus(turn, rate, w)
        pull = _plus(_cross(turn, v), lanes(1.0), _cross(w, behind))
        row = COLUMN * flat.joints[i, 1]
        for k in range(3):
            store(work.change, row + k, load(work.change, row + k) + flat.drives[i, 0] * pull[k])
            store(work.change, row + 3 + k, load(work.change, row + 3 + k) + flat.drives[i, 0] * spin[k])
    square = zero
    for k in range(COLUMN * n):
        square = square + load(work.change, k) * load(work.change, k)
    return square


@inlined
def _rate(flat: FlatChain, work: Elimination, i: int) -> Lanes:
    return flat.drives[i, 0] * load(work.rates, len(work.J) // (COLUMN * LANES) + flat.joints[i, 1])


@inlined
def _part(columns: Array, row: int) -> _Triple:
    return load(columns, row), load(columns, row + 1), load(columns, row + 2)


@inlined
def _plus(a: _Triple, factor: Lanes, b: _Triple) -> _Triple:
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


@inlined
def _cross(a: _Triple, b: _Triple) -> _Triple:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@unmanaged
def least_sigma(work: Elimination) -> Lanes:
    """Return a lower bound of J's smallest singular value from the factors: ‖J⁺‖ ≥ 1/σ, in Frobenius's norm."""
    total, L, inverse = lanes(0.0), work.L, work.state
    for i in range(COLUMN):
        # Row i of the inverse of L.
        store(inverse, RIGHT + i, lanes(1.0))
        for j in range(i - 1, -1, -1):
            entry = lanes(0.0)
            for k in range(j + 1, i + 1):
                entry = entry - load(inverse, RIGHT + k) * load(L, COLUMN * k + j)
            store(inverse, RIGHT + j, entry)
        for j in range(i + 1):
            entry = load(inverse, RIGHT + j)
            total = total + entry * entry * load(L, (COLUMN + 1) * i)
    return 1.0 / sqrt_lanes(total)


@compiled
def rates_at(flat: FlatChain, twists: Array, qs: Array) -> tuple[Array, Array]:
    """Return the shortest rates q' for twists, (N, n), and lower bounds of σ, (N,), both 0 near singularities."""
    count, n = qs.shape
    rates, sigmas, work = np.zeros((count, n)), np.zeros(count), elimination(flat, n)
    for first in range(0, count, LANES):
        work.rates[:] = 0.0
        gather(qs, first, 0, work.rates)
        gather(twists, first, RIGHT, work.state)
        linearised(flat, work)
        good = factored(work)
        moved(work, RIGHT, 1)
        store(work.number, 0, where(good > 0.0, least_sigma(work), 0.0))
        for lane in range(min(LANES, count - first)):
            sigmas[first + lane] = work.number[lane]
            for j in range(n if work.number[lane] > 0.0 else 0):
                rates[first + lane, j] = work.rates[(n + j) * LANES + lane]
    return rates, sigmas


@inlined
def gather(rows: Array, first: int, row: int, work: Array) -> None:
    """Copy eight rows of numbers into lanes."""
    for lane in range(LANES):
        i = min(first + lane, len(rows) - 1)
        for k in range(rows.shape[1]):
            work[(row + k) * LANES + lane] = rows[i, k]


@inlined
def gather_goals(positions: Array, rotations: Array, first: int, state: Array) -> None:
    """Copy eight poses into lanes."""
    for lane in range(LANES):
        i = min(first + lane, len(positions) - 1)
        for k in range(3):
            state[(GOAL + 9 + k) * LANES + lane] = positions[i, k]
            for j in range(3):
                state[(GOAL + 3 * k + j) * LANES + lane] = rotations[i, k, j]


@compiled
def beside(
    flat: FlatChain, positions: Array, rotations: Array, twists: Array, bends: Array, rates: Array, steps: int
) -> tuple[Array, Array]:
    """Return exact q, q', q'' next to given ones, (3, N, n), and each one's last Newton step, (N,), [rad or m].

    What of the given rates moves along the path's solutions stays; the step is NaN near a singularity.
    """
    _, count, n = rates.shape
    exact, lasts, work = np.empty((3, count, n)), np.empty(count), elimination(flat, n)
    for first in range(0, count, LANES):
        for order in range(3):
            gather(rates[order], first, order * n, work.rates)
        gather_goals(positions, rotations, first, work.state)
        gather(twists, first, TWIST, work.state)
        gather(bends, first, BEND, work.state)
        store(work.number, 0, _exact(flat, work, steps))
        for lane in range(min(LANES, count - first)):
            lasts[first + lane] = work.number[lane]
            for order in range(3):
                for j in range(n):
                    exact[order, first + lane, j] = work.rates[(order * n + j) * LANES + lane]
    return exact, lasts


@unmanaged
def _exact(flat: FlatChain, work: Elimination, steps: int) -> Lanes:
    """Make q, q' and q'' exact by chords; return the last Newton step, NaN near a singularity."""
    frame = linearised(flat, work)
    good, last = factored(work), lanes(0.0)
    for step in range(steps):
        if step:
            frame = tip_frame(flat, work.rates)
        store_errors(work, frame)
        last = moved(work, RIGHT, 0)
        if not bits(last > _SETTLED):
            break
    linearised(flat, work)
    good = where(factored(work) > 0.0, good, 0.0)
    store_rest(work, TWIST, work.J, 1)
    moved(work, RIGHT, 1)
    store_change(flat, work)
    store_rest(work, BEND, work.change, 1)
    store_rest(work, RIGHT, work.J, 2)
    moved(work, RIGHT, 2)
    return where(good > 0.0, last, np.nan)
