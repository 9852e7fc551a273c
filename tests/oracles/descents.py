"""The least distance of a pose from a target that many independent descents within the limits come to.

Levenberg-Marquardt over the variables that no limit holds back [Nocedal2006, 10.3], from random starts; the best are
taken on until nothing changes. A metre counts as much as a radian of the rotation vector between the two.
"""

from typing import TypeAlias

import numba
import numpy as np
import numpy.typing as npt

Array: TypeAlias = npt.NDArray[np.float64]
_TAKEN_ON = 24


@numba.njit(cache=False, nogil=True)
def _errors(placements, joints, drives, q, target, whole, e, J):  # type: ignore[no-untyped-def]
    """Fill the way still to go and the Jacobian by variables, both in the base's axes; ½‖e‖²."""
    R, p = placements[0, :9].copy().reshape(3, 3), placements[0, 9:].copy()
    m = len(joints)
    axes, points = np.empty((m, 3)), np.empty((m, 3))
    for i in range(m):
        value = drives[i, 0] * q[joints[i, 1]] + drives[i, 1]
        axes[i], points[i] = R[:, 2], p
        if joints[i, 0]:
            p = p + value * R[:, 2]
        else:
            c, s = np.cos(value), np.sin(value)
            x, y = c * R[:, 0] + s * R[:, 1], c * R[:, 1] - s * R[:, 0]
            R[:, 0], R[:, 1] = x, y
        p = p + R @ placements[i + 1, 9:]
        R = R @ placements[i + 1, :9].copy().reshape(3, 3)
    J[:] = 0.0
    for i in range(m):
        z, k = drives[i, 0] * axes[i], joints[i, 1]
        if joints[i, 0]:
            J[:3, k] += z
        else:
            J[:3, k] += np.cross(z, p - points[i])
            J[3:, k] += z
    e[:3], e[3:] = target[9:] - p, 0.0
    if not whole:
        J[3:] = 0.0
        return 0.5 * (e @ e)
    D = target[:9].copy().reshape(3, 3) @ R.T
    v = np.array([D[2, 1] - D[1, 2], D[0, 2] - D[2, 0], D[1, 0] - D[0, 1]])
    sine, cosine = 0.5 * np.sqrt(v @ v), 0.5 * (D[0, 0] + D[1, 1] + D[2, 2] - 1.0)
    angle = np.arctan2(sine, cosine)
    if sine > 1e-6:
        e[3:] = v * (0.5 * angle / sine)
    elif cosine > 0.0:
        e[3:] = 0.5 * v
    else:
        k = int(np.argmax(np.diag(D)))
        column = D[:, k] + np.eye(3)[k]
        e[3:] = angle * column / np.sqrt(column @ column)
    return 0.5 * (e @ e)


@numba.njit(cache=False, nogil=True)
def _descend(placements, joints, drives, q, lower, upper, target, whole, most):  # type: ignore[no-untyped-def]
    """Take `q` down in place; ½‖e‖² in the end."""
    n = len(q)
    e, J, e2, J2 = np.empty(6), np.empty((6, n)), np.empty(6), np.empty((6, n))
    cost = _errors(placements, joints, drives, q, target, whole, e, J)
    damping, idle = 1e-2, 0
    for _ in range(most):
        slope = J.T @ e
        A = J.T @ J
        for j in range(n):
            if (q[j] <= lower[j] and slope[j] < 0.0) or (q[j] >= upper[j] and slope[j] > 0.0):
                A[j, :], A[:, j], slope[j] = 0.0, 0.0, 0.0
            A[j, j] += damping
        if np.sqrt(slope @ slope) <= 1e-13 * (1.0 + cost):
            break
        step = np.linalg.solve(A, slope)
        step *= min(1.0, 1.0 / np.abs(step).max())
        trial = np.minimum(np.maximum(q + step, lower), upper)
        after = _errors(placements, joints, drives, trial, target, whole, e2, J2)
        if after < cost:
            idle = idle + 1 if cost - after < 1e-9 * cost else 0
            q[:], cost = trial, after
            e, J, e2, J2 = e2, J2, e, J
            damping = max(0.2 * damping, 1e-12)
        else:
            damping *= 6.0
            idle += 1
        if idle > 12 or damping > 1e9:
            break
    return cost


@numba.njit(cache=False, nogil=True)
def _least(placements, joints, drives, starts, lower, upper, target, whole):  # type: ignore[no-untyped-def]
    costs = np.empty(len(starts))
    for i in range(len(starts)):
        costs[i] = _descend(placements, joints, drives, starts[i], lower, upper, target, whole, 60)
    order = np.argsort(costs)[:_TAKEN_ON]
    for i in order:
        costs[i] = _descend(placements, joints, drives, starts[i], lower, upper, target, whole, 3000)
    best = order[np.argmin(costs[order])]
    return np.sqrt(2.0 * costs[best]), starts[best]


def least_distance(
    placements: Array,
    joints: npt.NDArray[np.int64],
    drives: Array,
    lower: Array,
    upper: Array,
    target: Array,
    whole: bool,
    count: int = 2000,
    seed: int = 0,
) -> tuple[float, Array]:
    """The least √(distance² + angle²) that so many descents come to, and where.

    Args:
        placements: Constant placements before each joint and after the last, rotation row by row, then position.
        joints: Of each joint whether it slides along z or turns about it, and its variable.
        drives: Of each joint multiplier and offset of its variable.
        lower: Of each variable, [rad or m].
        upper: Likewise.
        target: Rotation row by row, then position; shape (12,).
        whole: Whether the orientation counts.
        count: Of descents.
        seed: Of their starts.
    """
    low, high = np.where(np.isinf(lower), -np.pi, lower), np.where(np.isinf(upper), np.pi, upper)
    starts = np.random.default_rng(seed).uniform(low, high, (count, len(lower)))
    distance, q = _least(placements, joints, drives, starts, lower, upper, target, whole)
    return float(distance), q
