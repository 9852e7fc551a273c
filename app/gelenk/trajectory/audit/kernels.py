"""Compiled rates of the tip and singular values along a motion; eight samples at a time.

Speeds and accelerations come from the forward recursion of Newton and Euler [Luh1980]: each joint adds to the angular
velocity and acceleration of the frame that it moves, and the frame's origin is carried along. No Jacobian, whose
differences over time would be needed otherwise.
"""

from typing import TypeAlias

import numpy as np

from gelenk.kinematics.simd.kernels import (
    COLUMN,
    Frame,
    first_frame,
    gather_rows,
    joint_columns,
    moved,
    placed,
    variable_columns,
)
from gelenk.kinematics.simd.lanes import LANES, Lanes, abs_lanes, bits, lanes, load, min_lanes, sqrt_lanes, store, where
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, inlined, unmanaged
from gelenk.trajectory.audit.pieces import Pieces

_SWEEPS = 12
_ORTHOGONAL = 1e-12
"""Cosine of two vectors that count as orthogonal."""
_NEARLY = 1e-7
"""Cosine whose square is less than that: where no larger one was left, a sweep has made all vectors orthogonal."""
_TINY = 1e-150
"""Keeps two zero vectors as they are; its square is still a double."""

Triple: TypeAlias = tuple[Lanes, Lanes, Lanes]


@compiled
def tip_rates(flat: FlatChain, pieces: Pieces, piece: Indices, tau: Array) -> Array:
    """Compute ‖ṗ‖, ‖ω‖, ‖p̈‖, ‖ω̇‖ of the tip at τ of the given pieces; (N,) each → (N, 4), [m/s, rad/s, …]."""
    _, size, n = pieces.scaled.shape
    rates, work, norms = np.empty((len(tau), 4)), np.zeros(3 * max(n, 1) * LANES), np.empty(4 * LANES)
    rows, per_width, places = np.empty(size * n * LANES), np.empty(LANES), np.empty(LANES)
    held, last = np.full(LANES, -1), len(tau) - 1
    for first in range(0, len(tau), LANES):
        for lane in range(LANES):
            i = min(first + lane, last)
            places[lane] = tau[i]
            if held[lane] != piece[i]:
                held[lane], per_width[lane] = piece[i], 1.0 / pieces.widths[piece[i]]
                _gather(pieces, piece[i], lane, rows)
        _store_states(rows, size, n, load(places, 0), load(per_width, 0), work)
        _store_norms(flat, n, work, norms)
        for lane in range(min(LANES, len(tau) - first)):
            for k in range(4):
                rates[first + lane, k] = norms[k * LANES + lane]
    return rates


@inlined
def _gather(pieces: Pieces, piece: int, lane: int, rows: Array) -> None:
    """Write the coefficients of a piece into a lane, row k n + j for the power k of variable j."""
    _, size, n = pieces.scaled.shape
    for k in range(size):
        for j in range(n):
            rows[(k * n + j) * LANES + lane] = pieces.scaled[piece, k, j]


@unmanaged
def _store_states(rows: Array, size: int, n: int, tau: Lanes, per_width: Lanes, work: Array) -> None:
    """Store position, velocity and acceleration of each variable, three times n rows."""
    for j in range(n):
        value, first, second = load(rows, (size - 1) * n + j), lanes(0.0), lanes(0.0)
        for k in range(size - 2, -1, -1):
            second = second * tau + first
            first = first * tau + value
            value = value * tau + load(rows, k * n + j)
        store(work, j, value)
        store(work, n + j, per_width * first)
        store(work, 2 * n + j, (2.0 * per_width * per_width) * second)


@unmanaged
def _store_norms(flat: FlatChain, n: int, work: Array, norms: Array) -> None:
    """Carry twist and acceleration from the base to the tip, and store their norms."""
    zero = lanes(0.0)
    w, v = (zero, zero, zero), (zero, zero, zero)
    b, a = (zero, zero, zero), (zero, zero, zero)
    frame = first_frame(flat)
    for i in range(len(flat.joints)):
        variable, factor = flat.joints[i, 1], flat.drives[i, 0]
        value = factor * load(work, variable) + flat.drives[i, 1]
        rate, change = factor * load(work, n + variable), factor * load(work, 2 * n + variable)
        z = (frame[2], frame[5], frame[8])
        turning = _cross(w, z)
        if flat.joints[i, 0] == 0:
            b = _plus(_plus(b, change, z), rate, turning)
            w = _plus(w, rate, z)
        following = placed(moved(frame, flat.joints[i, 0], value), flat, i + 1)
        r = (following[9] - frame[9], following[10] - frame[10], following[11] - frame[11])
        wr = _cross(w, r)
        v, a = _sum(v, wr), _sum(_sum(a, _cross(b, r)), _cross(w, wr))
        if flat.joints[i, 0]:
            v, a = _plus(v, rate, z), _plus(_plus(a, change, z), 2.0 * rate, turning)
        frame = following
    store(norms, 0, _norm(v))
    store(norms, 1, _norm(w))
    store(norms, 2, _norm(a))
    store(norms, 3, _norm(b))


@inlined
def _cross(a: Triple, b: Triple) -> Triple:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@inlined
def _sum(a: Triple, b: Triple) -> Triple:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@inlined
def _plus(a: Triple, factor: Lanes, b: Triple) -> Triple:
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


@inlined
def _norm(a: Triple) -> Lanes:
    return sqrt_lanes(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


@compiled
def smallest_singular_values(flat: FlatChain, qs: Array, rows: Indices, about_tip: bool) -> Array:
    """Compute the last of the min(m, n) singular values of m rows of the Jacobian, by Jacobi's rotations [Demmel1992].

    Args:
        qs: Configurations; shape (N, n).
        rows: Of the geometric Jacobian in the base frame, linear before angular; (m,).
        about_tip: Whether its rotations are about the tip's axes.
    """
    n, m = qs.shape[1], len(rows)
    count, length = min(m, n), max(m, n)
    sigmas = np.empty(len(qs))
    work, columns = np.empty(n * LANES), np.empty(COLUMN * len(flat.joints) * LANES)
    J, vectors, sigma = np.empty(COLUMN * n * LANES), np.empty(m * n * LANES), np.empty(LANES)
    for first in range(0, len(qs), LANES):
        gather_rows(qs, first, work)
        frame = joint_columns(flat, work, columns)
        variable_columns(flat, columns, J)
        if about_tip:
            _turn_to_tip(frame, J, n)
        for i in range(m):
            for j in range(n):
                store(vectors, i * n + j if m <= n else j * m + i, load(J, COLUMN * j + rows[i]))
        store(sigma, 0, _shortest_orthogonal(vectors, count, length))
        for lane in range(min(LANES, len(qs) - first)):
            sigmas[first + lane] = sigma[lane]
    return sigmas


@inlined
def _turn_to_tip(frame: Frame, J: Array, n: int) -> None:
    for j in range(n):
        w0, w1, w2 = load(J, COLUMN * j + 3), load(J, COLUMN * j + 4), load(J, COLUMN * j + 5)
        for k in range(3):
            store(J, COLUMN * j + 3 + k, frame[k] * w0 + frame[3 + k] * w1 + frame[6 + k] * w2)


@unmanaged
def _shortest_orthogonal(vectors: Array, count: int, length: int) -> Lanes:
    """Rotate vectors in pairs until all are orthogonal; return the length of the shortest, a singular value."""
    for _ in range(_SWEEPS):
        turned = 0
        # Pairs with the same sum are disjoint, so that the processor can rotate them at the same time.
        for total in range(count):
            for i in range(count):
                j = (total - i + count) % count
                if i < j:
                    turned |= _make_orthogonal(vectors, i * length, j * length, length)
        if not turned:
            break
    shortest = lanes(np.inf)
    for i in range(count):
        square = lanes(0.0)
        for k in range(length):
            a = load(vectors, i * length + k)
            square = square + a * a
        shortest = min_lanes(shortest, square)
    return sqrt_lanes(shortest)


@inlined
def _make_orthogonal(vectors: Array, a: int, b: int, length: int) -> int:
    """Rotate two vectors in their plane; return in which lanes they were not nearly orthogonal."""
    aa, ab, bb = lanes(0.0), lanes(0.0), lanes(0.0)
    for k in range(length):
        x, y = load(vectors, a + k), load(vectors, b + k)
        aa, ab, bb = aa + x * x, ab + x * y, bb + y * y
    if bits(ab * ab > (_ORTHOGONAL * _ORTHOGONAL) * (aa * bb)):
        half = 0.5 * (bb - aa)
        size = abs_lanes(half) + sqrt_lanes(half * half + ab * ab) + _TINY
        per_length = 1.0 / sqrt_lanes(size * size + ab * ab)
        c, s = size * per_length, where(half >= 0.0, ab, -ab) * per_length
        for k in range(length):
            x, y = load(vectors, a + k), load(vectors, b + k)
            store(vectors, a + k, c * x - s * y)
            store(vectors, b + k, s * x + c * y)
    askew: int = bits(ab * ab > (_NEARLY * _NEARLY) * (aa * bb))
    return askew
