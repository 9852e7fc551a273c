"""Compiled search for the exact configuration next to another one at a pose of the tip, and its rates along a path.

For all six directions, and at least as many joints. `nearest` decomposes J, and is sound near singularities too. The
others eliminate with JJᵀ, for many samples at once: several times as quick, and as good away from singularities; near
one they say so.
"""

from typing import TypeAlias

import numpy as np

from gelenk.kinematics.simd.kernels import chain_hessians, chain_jacobians
from gelenk.robot.arrays import Array
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled
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
_SETTLED = 1e-12
"""Change of the joints that counts as none, [rad or m]."""

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
    for i in range(len(x)):
        for j in range(i):
            x[i] -= L[i, j] * x[j]
    for i in range(len(x) - 1, -1, -1):
        x[i] /= L[i, i]
        for j in range(i + 1, len(x)):
            x[i] -= L[j, i] * x[j]
    return x


@compiled
def errors(position: Array, rotation: Array, at: Array, turned: Array) -> Array:
    """Return the remaining motion of the tip from a pose to a wanted one; shape (6,), [m, rad]."""
    turn = np.ascontiguousarray(rotation @ turned.T).reshape((1, 3, 3))
    return np.concatenate((position - at, vectors_from_rotations(turn)[0]))


@compiled
def _settled(flat: FlatChain, position: Array, rotation: Array, start: Array, J: Array, L: Array) -> tuple[bool, Array]:
    """Find the configuration nearest to `start` at a pose by Newton's method; J and its factors are those there."""
    q, before = start.copy(), np.inf
    floor = EXACT * (1.0 + np.abs(position).max() + np.abs(q).max())
    for _ in range(MOST_STEPS):
        positions, rotations, Js = chain_jacobians(flat, q.reshape((1, -1)))
        J[:] = Js[0]
        if not factored(J, L):
            break
        e = errors(position, rotation, positions[0], rotations[0])
        error = np.abs(e).max()
        if error <= floor or (error <= NEARLY and error > 0.5 * before):
            return True, q
        step = J.T @ weights(L, e)
        if not np.abs(step).max() <= FARTHEST:
            break
        q, before = q + step, error
    return False, q


@compiled
def walked(
    flat: FlatChain, places: Array, positions: Array, rotations: Array, twists: Array, bends: Array, start: Array
) -> tuple[bool, Array]:
    """Follow a path from a configuration at its first sample from sample to sample, as `step.next_knot` does.

    Args:
        places: s of the samples, rising; shape (N,), [m or rad].
        positions, rotations, twists, bends: The path there; shapes (N, 3), (N, 3, 3), (N, 6), (N, 6).
        start: Shape (n,), [rad or m].

    Returns:
        Whether each sample has a configuration, far from singularities; and q, q' and q'', shape (3, N, n).
    """
    n, J, L = len(start), np.empty((6, len(start))), np.empty((6, 6))
    rates = np.zeros((3, len(places), n))
    for i in range(len(places)):
        h = places[i] - places[max(i - 1, 0)]
        q, dq, ddq = (
            (start, rates[1, 0], rates[2, 0]) if i == 0 else (rates[0, i - 1], rates[1, i - 1], rates[2, i - 1])
        )
        wanted = q + h * (dq + 0.5 * h * ddq)
        for correction in range(1 + (_CORRECTIONS if n > 6 and i > 0 else 0)):
            if correction > 0:
                wanted = q + 0.5 * h * (dq + rates[1, i]) + h * h / 12.0 * (ddq - rates[2, i])
                off = wanted - rates[0, i]
                off -= J.T @ weights(L, J @ off)
                if np.abs(off).max() <= _SETTLED:
                    break
                wanted = rates[0, i] + off
            found, settled = _settled(flat, positions[i], rotations[i], wanted, J, L)
            if not found:
                return False, rates
            rates[0, i] = settled
            _add_rates(flat, J, L, twists[i], bends[i], rates[:, i])
    return True, rates


@compiled
def _add_rates(flat: FlatChain, J: Array, L: Array, twist: Array, bend: Array, rates: Array) -> None:
    """Write q' and q'' below q, by the formula of `rate_field`."""
    n, lam = J.shape[1], weights(L, twist)
    dq = J.T @ lam
    dq += J.T @ weights(L, twist - J @ dq)
    H, dJ = chain_hessians(flat, rates[0].copy().reshape((1, -1)))[0], np.zeros(J.shape)
    for k in range(6):
        dJ[k] = H[k] @ dq
    missing = bend - dJ @ dq
    ddq = dJ.T @ lam if n > 6 else np.zeros(n)
    for _ in range(2):
        ddq += J.T @ weights(L, missing - J @ ddq)
    rates[1], rates[2] = dq, ddq


@compiled
def beside(
    flat: FlatChain, positions: Array, rotations: Array, twists: Array, bends: Array, rates: Array, steps: int
) -> tuple[Array, Array]:
    """Return exact q, q', q'' next to given ones, (3, N, n), and each one's last Newton step, (N,), [rad or m].

    What of the given rates moves along the path's solutions stays; the step is NaN near a singularity.
    """
    exact, lasts, Ls = rates.copy(), np.full(len(twists), np.nan), np.empty((len(twists), 6, 6))
    _, _, Js = chain_jacobians(flat, exact[0])
    sound = np.zeros(len(twists), dtype=np.bool_)
    for i in range(len(twists)):
        sound[i] = factored(Js[i], Ls[i])
    chords = Js
    for _ in range(steps):
        at, turned, _ = chain_jacobians(flat, exact[0])
        for i in range(len(twists)):
            if sound[i]:
                step = chords[i].T @ weights(Ls[i], errors(positions[i], rotations[i], at[i], turned[i]))
                exact[0, i] += step
                lasts[i] = np.abs(step).max()
    _, _, Js = chain_jacobians(flat, exact[0])
    Hs, L = chain_hessians(flat, exact[0]), np.empty((6, 6))
    for i in range(len(twists)):
        J, dJ = Js[i], np.empty(Js[i].shape)
        if not (sound[i] and factored(J, L)):
            lasts[i] = np.nan
            continue
        exact[1, i] += J.T @ weights(L, twists[i] - J @ exact[1, i])
        for k in range(6):
            dJ[k] = Hs[i, k] @ exact[1, i]
        exact[2, i] += J.T @ weights(L, bends[i] - dJ @ exact[1, i] - J @ exact[2, i])
    return exact, lasts
