"""Compiled search for the exact configuration next to another one at a pose of the tip, and its rates along a path.

For all six directions, and at least as many joints. J is decomposed, which is sound near singularities too;
`elimination` is quicker away from them.
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
