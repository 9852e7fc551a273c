"""Compiled search for the exact configuration next to another one at a pose of the tip, and its rates along a path.

For all six directions, and at least as many joints. `nearest` decomposes J, and is sound near singularities too. The
others eliminate with JJᵀ, for many samples at once: several times as quick, and as good away from singularities; near
one they say so.
"""

import math
from typing import NamedTuple, TypeAlias

import numpy as np

from gelenk.kinematics.simd.kernels import chain_hessians, chain_jacobians, chain_poses
from gelenk.kinematics.simd.vectors import dot, row, scaled
from gelenk.robot.arrays import Array
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, inlined
from gelenk.robot.notations import vectors_from_rotations

EXACT = 1e-14
"""Error that no further step reduces, in fractions of 1 plus the largest position and joint value, [m and rad]."""
NEARLY = 1e-10
MOST_STEPS = 12
FAR = 1e6
"""Magnitude of a joint beyond which a configuration counts as diverged, [rad or m]."""
FARTHEST = 1.0
"""Longest step of Newton's method, [rad or m]."""
RANK = 1e-13
"""Share of the largest singular value below which one counts as zero."""

_LEAST = 1e-10
"""Pivot of a row, in fractions of its square, below which J nearly loses rank: σ is some 1e-5."""
_CORRECTIONS = 2
_SETTLED, _SETTLED_ALL = 1e-12, 1e-13
"""Change of the joints that counts as none, [rad or m]: of a spare motion, and of all samples at once."""
_NO_TURN = 1e-100

Decomposition: TypeAlias = tuple[Array, Array, Array]
"""Left vectors, inverses of the singular values (0 for one that counts as zero), and right vectors."""


@compiled
def nearest(
    flat: FlatChain, position: Array, rotation: Array, twist: Array, bend: Array, start: Array
) -> tuple[bool, Array, Array, Array, float, Array, float]:
    """Find the configuration nearest to `start` at which the tip has a pose, with its rates along a path, or none.

    Args:
        position, rotation: Of the tip, in the base; shape (3,), [m], and (3, 3).
        twist, bend: ξ and its derivative along the path; shape (6,), linear before angular.
        start: Shape (n,), n ≥ 6, [rad or m].

    Returns:
        Whether Newton's method converged; q, q' and q'', shape (n,); the smallest singular value of J; an orthonormal
        basis of its rows, shape (6, n); and the norm of dJ/ds.
    """
    q, before, J = start.copy(), np.inf, np.zeros((6, len(start)))
    floor = EXACT * (1.0 + np.abs(position).max() + np.abs(q).max())
    for _ in range(MOST_STEPS):
        if not np.abs(q).max() <= FAR:
            break
        positions, rotations, Js = chain_jacobians(flat, q.reshape((1, -1)))
        turn = np.ascontiguousarray(rotation @ rotations[0].T).reshape((1, 3, 3))
        J, e = Js[0], np.concatenate((position - positions[0], vectors_from_rotations(turn)[0]))
        error = np.abs(e).max()
        left, sigmas, right = np.linalg.svd(J, False)
        parts = (left, np.where(sigmas > RANK * sigmas[0], 1.0 / sigmas, 0.0), right)
        if error <= floor or (error <= NEARLY and error > 0.5 * before):
            dq, ddq, change = _rates(flat, J, parts, twist, bend, q)
            return True, q, dq, ddq, sigmas[-1], right, change
        step = _applied(parts, e)
        if not np.abs(step).max() <= FARTHEST:
            break
        q, before = q + step, error
    return False, q, q, q, 0.0, J, 0.0


@compiled
def _applied(parts: Decomposition, b: Array) -> Array:
    """Return J⁺b."""
    left, gains, right = parts
    return right.T @ (gains * (left.T @ b))


@compiled
def _rates(
    flat: FlatChain, J: Array, parts: Decomposition, twist: Array, bend: Array, q: Array
) -> tuple[Array, Array, float]:
    """Return q' and q'', and the norm of dJ/ds; the formula is that of `rate_field`."""
    dq, (left, gains, right) = _applied(parts, twist), parts
    H, dJ = chain_hessians(flat, q.reshape((1, -1)))[0], np.zeros(J.shape)
    for k in range(6):
        dJ[k] = H[k] @ dq
    missing, along = bend - dJ @ dq, np.zeros(len(q))
    if len(q) > 6:
        along = dJ.T @ (left @ (gains * (right @ dq)))
    return dq, along + _applied(parts, missing - J @ along), np.sqrt((dJ * dJ).sum())


@compiled
def factored(J: Array, L: Array) -> bool:
    """Write the factors L and D of JJᵀ = LDLᵀ into a matrix, D on its diagonal; false if J nearly loses rank."""
    for i in range(len(J)):
        square = 0.0
        for k in range(i + 1):
            entry = 0.0
            for j in range(J.shape[1]):
                entry += J[i, j] * J[k, j]
            square = entry
            for j in range(k):
                entry -= L[i, j] * L[k, j] * L[j, j]
            L[i, k] = entry if k == i else entry / L[k, k]
        if not L[i, i] > _LEAST * square:
            return False
    return True


@compiled
def weights(L: Array, b: Array) -> Array:
    """Return (JJᵀ)⁻¹b from the factors; shape (m,)."""
    x = b.copy()
    _divide(L, x)
    return x


@inlined
def _divide(L: Array, x: Array) -> None:
    for i in range(len(x)):
        for j in range(i):
            x[i] -= L[i, j] * x[j]
    for i in range(len(x) - 1, -1, -1):
        x[i] /= L[i, i]
        for j in range(i + 1, len(x)):
            x[i] -= L[j, i] * x[j]


@compiled
def _moved(J: Array, L: Array, b: Array, x: Array) -> float:
    """Add J⁺b to x; return the largest change. In the place of b, (JJᵀ)⁻¹b is left."""
    _divide(L, b)
    largest = 0.0
    for j in range(len(x)):
        change = 0.0
        for k in range(len(b)):
            change += J[k, j] * b[k]
        x[j] += change
        if not abs(change) <= largest:  # Unlike `max`, this does not lose a NaN.
            largest = abs(change)
    return largest


@inlined
def _store_rest(b: Array, J: Array, x: Array, rest: Array) -> None:
    """Write b - Jx."""
    for k in range(len(b)):
        rest[k] = b[k]
        for j in range(len(x)):
            rest[k] -= J[k, j] * x[j]


@inlined
def _store_errors(position: Array, rotation: Array, at: Array, turned: Array, e: Array) -> None:
    """Write the remaining motion of the tip from a pose to a wanted one; shape (6,), [m, rad]."""
    for k in range(3):
        e[k] = position[k] - at[k]
    a, b, c = row(rotation, 0), row(rotation, 1), row(rotation, 2)
    x, y, z = row(turned, 0), row(turned, 1), row(turned, 2)
    axial = 0.5 * (dot(c, y) - dot(b, z)), 0.5 * (dot(a, z) - dot(c, x)), 0.5 * (dot(b, x) - dot(a, y))
    # It is as long as the sine of the angle.
    sine, cosine = math.sqrt(dot(axial, axial)), 0.5 * (dot(a, x) + dot(b, y) + dot(c, z) - 1.0)
    scale = math.atan2(sine, cosine) / sine if sine > _NO_TURN else 1.0
    e[3], e[4], e[5] = scaled(scale, axial)


@compiled
def _settled(flat: FlatChain, position: Array, rotation: Array, q: Array, J: Array, L: Array) -> bool:
    """Lead q to the nearest configuration at a pose by Newton's method; J and its factors are those there."""
    before, e, one = np.inf, np.empty(6), q.copy().reshape((1, -1))
    floor = EXACT * (1.0 + np.abs(position).max() + np.abs(q).max())
    for _ in range(MOST_STEPS):
        positions, rotations, Js = chain_jacobians(flat, one)
        J[:] = Js[0]
        if not factored(J, L):
            break
        _store_errors(position, rotation, positions[0], rotations[0], e)
        error = np.abs(e).max()
        if error <= floor or (error <= NEARLY and error > 0.5 * before):
            q[:] = one[0]
            return True
        if not _moved(J, L, e, one[0]) <= FARTHEST:
            break
        before = error
    return False


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

    Args:
        places: s of the samples, rising; shape (N,), [m or rad].
        positions, rotations, twists, bends: The path there; shapes (N, 3), (N, 3, 3), (N, 6), (N, 6).
        start: Shape (n,), [rad or m].
    """
    n, count, J, L = len(start), len(places), np.empty((6, len(start))), np.empty((6, 6))
    walk = Walk(True, np.zeros((3, count, n)), np.zeros(count), np.zeros(count))
    rates, b = walk.rates, np.empty(6)
    for i in range(count):
        last = max(i - 1, 0)
        h, q, dq, ddq = places[i] - places[last], rates[0, last], rates[1, last], rates[2, last]
        rates[0, i] = start if i == 0 else q + h * (dq + 0.5 * h * ddq)
        for correction in range(1 + (_CORRECTIONS if n > 6 and i > 0 else 0)):
            if correction > 0:
                off = q + 0.5 * h * (dq + rates[1, i]) + h * h / 12.0 * (ddq - rates[2, i]) - rates[0, i]
                _store_rest(np.zeros(6), J, off, b)
                _moved(J, L, b, off)
                if np.abs(off).max() <= _SETTLED:
                    break
                rates[0, i] += off
            if not _settled(flat, positions[i], rotations[i], rates[0, i], J, L):
                return Walk(False, rates, walk.sigmas, walk.changes)
            walk.changes[i] = _add_rates(flat, J, L, twists[i], bends[i], rates[:, i])
        walk.sigmas[i] = _least_sigma(L)
    return walk


@compiled
def _add_rates(flat: FlatChain, J: Array, L: Array, twist: Array, bend: Array, rates: Array) -> float:
    """Write q' and q'' below q, by the formula of `rate_field`; return the norm of dJ/ds."""
    q, dq, ddq = rates[0], rates[1], rates[2]
    H, lam, b = chain_hessians(flat, q.copy().reshape((1, -1)))[0], twist.copy(), np.empty(6)
    dq[:], ddq[:] = 0.0, 0.0
    _moved(J, L, lam, dq)
    _store_rest(twist, J, dq, b)
    _moved(J, L, b, dq)
    square, missing = 0.0, bend.copy()
    for k in range(6):
        for i in range(len(q)):
            change = 0.0
            for j in range(len(q)):
                change += H[k, i, j] * dq[j]
            square += change * change
            missing[k] -= change * dq[i]
            if len(q) > 6:
                ddq[i] += change * lam[k]
    for _ in range(2):
        _store_rest(missing, J, ddq, b)
        _moved(J, L, b, ddq)
    return math.sqrt(square)


@compiled
def _least_sigma(L: Array) -> float:
    """Return a lower bound of J's smallest singular value from the factors: ‖J⁺‖ ≥ 1/σ, in Frobenius's norm."""
    total, inverse = 0.0, np.empty(len(L))
    for i in range(len(L)):
        # Row i of the inverse of L.
        inverse[i] = 1.0
        for j in range(i - 1, -1, -1):
            inverse[j] = 0.0
            for k in range(j + 1, i + 1):
                inverse[j] -= inverse[k] * L[k, j]
        for j in range(i + 1):
            total += inverse[j] * inverse[j] / L[i, i]
    return 1.0 / math.sqrt(total)


@compiled
def rates_at(flat: FlatChain, twists: Array, qs: Array) -> tuple[Array, Array]:
    """Return the shortest rates q' for twists, (N, n), and lower bounds of σ, (N,), both 0 near singularities."""
    rates, sigmas, L = np.zeros(qs.shape), np.zeros(len(qs)), np.empty((6, 6))
    _, _, Js = chain_jacobians(flat, qs)
    for i in range(len(qs)):
        if factored(Js[i], L):
            _moved(Js[i], L, twists[i].copy(), rates[i])
            sigmas[i] = _least_sigma(L)
    return rates, sigmas


@compiled
def beside(
    flat: FlatChain, positions: Array, rotations: Array, twists: Array, bends: Array, rates: Array, steps: int
) -> tuple[Array, Array]:
    """Return exact q, q', q'' next to given ones, (3, N, n), and each one's last Newton step, (N,), [rad or m].

    What of the given rates moves along the path's solutions stays; the step is NaN near a singularity.
    """
    count, exact, b = len(twists), rates.copy(), np.empty(6)
    lasts, Ls = np.full(count, np.nan), np.empty((count, 6, 6))
    _, _, chords = chain_jacobians(flat, exact[0])
    for i in range(count):
        if factored(chords[i], Ls[i]):
            lasts[i] = np.inf
    for _ in range(steps):
        at, turned = chain_poses(flat, exact[0])
        for i in range(count):
            if lasts[i] > 0.0:
                _store_errors(positions[i], rotations[i], at[i], turned[i], b)
                lasts[i] = _moved(chords[i], Ls[i], b, exact[0, i])
        if not (lasts > _SETTLED_ALL).any():
            break
    _, _, Js = chain_jacobians(flat, exact[0])
    Hs, L = chain_hessians(flat, exact[0]), np.empty((6, 6))
    for i in range(count):
        if math.isnan(lasts[i]) or not factored(Js[i], L):
            lasts[i] = np.nan
            continue
        _store_rest(twists[i], Js[i], exact[1, i], b)
        _moved(Js[i], L, b, exact[1, i])
        _store_rest(bends[i], Js[i], exact[2, i], b)
        _subtract_change(Hs[i], exact[1, i], b)
        _moved(Js[i], L, b, exact[2, i])
    return exact, lasts


@inlined
def _subtract_change(H: Array, dq: Array, b: Array) -> None:
    """Subtract (dJ/ds)q'."""
    for k in range(len(b)):
        for i in range(len(dq)):
            for j in range(len(dq)):
                b[k] -= H[k, i, j] * dq[i] * dq[j]
