"""Joints along a straight line of the tip, exactly: Newton's method at Chebyshev's nodes, and the series through these.

What a time law makes of it is found on a dense grid of times, without polynomials in time.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.chebyshev import Chebyshev
from numpy.polynomial.polynomial import Polynomial
from scipy.spatial.transform import Rotation

from tests.oracles.dh_columns import Array, Table

LAWS = {
    "cubic": (0, 0, 3, -2),
    "quintic": (0, 0, 0, 10, -15, 6),
    "septic": (0, 0, 0, 0, 35, -84, 70, -20),
}
ALL = (0, 1, 2, 3, 4, 5)
_NODES = 100
_TIMES = 20_001


@dataclass(frozen=True)
class LineWay:
    """q(u) along a line, u from 0 to 1: one series a joint."""

    series: Sequence[Chebyshev]

    def rates(self, u: Array, order: int) -> Array:
        """A derivative by u; shape (N,) → (N, n)."""
        return np.stack([one.deriv(order)(u) for one in self.series], axis=1)

    def peaks(self, law: str, duration: float = 1.0) -> tuple[Array, Array, Array]:
        """Of each joint the largest velocity, acceleration and jerk from rest to rest by a polynomial; shape (n,)."""
        t, u = np.linspace(0.0, 1.0, _TIMES), Polynomial(LAWS[law])
        v, w, j = (u.deriv(order)(t)[:, None] / duration**order for order in (1, 2, 3))
        a, b, c = (self.rates(u(t), order) for order in (1, 2, 3))
        return largest(a * v), largest(a * w + b * v**2), largest(a * j + 3.0 * b * v * w + c * v**3)


def largest(values: Array) -> Array:
    """Of each joint the largest magnitude, by the parabola through three samples; shape (n,)."""
    sizes = np.abs(values)
    i, each = np.clip(sizes.argmax(axis=0), 1, len(sizes) - 2), np.arange(sizes.shape[1])
    before, at, after = (sizes[i + k, each] for k in (-1, 0, 1))
    bend = np.maximum(2.0 * at - before - after, np.finfo(float).tiny)
    vertex = np.abs(0.5 * (after - before)) <= bend
    rise: Array = np.where(vertex, 0.125 * (after - before) ** 2 / bend, 0.0)
    peaks: Array = np.maximum(sizes.max(axis=0), at + rise)
    return peaks


def of_joints(joints: Callable[[float, Array], Array], start: Array) -> LineWay:
    """The series through joints that are found at u, next to those at the place before.

    Raises:
        ArithmeticError: The way is not smooth enough for them.
    """
    nodes = 0.5 - 0.5 * np.cos(np.pi * (np.arange(_NODES) + 0.5) / _NODES)
    found, q = [], start
    for u in nodes:
        q = joints(float(u), q)
        found.append(q)
    series = [Chebyshev.fit(nodes, values, _NODES - 1, domain=[0.0, 1.0]) for values in np.array(found).T]
    if max(float(np.abs(one.coef[-10:]).max()) for one in series) > 1e-12:
        raise ArithmeticError("the series does not converge")
    return LineWay(series)


def line_way(table: Table, start: Array, shift: Array, turn: Array, rows: Sequence[int] = ALL) -> LineWay:
    """The joints' way on the branch of its start.

    Args:
        table: The arm, with as many joints as rows that count.
        start: Shape (n,), [rad or m].
        shift: From the first position of the tip to the last, [m].
        turn: Rotation vector from the first orientation to the last, in the axes of the base, [rad].
        rows: Which of x, y, z and the rotations about the base's axes count.
    """
    T, kept = table.pose(start), list(rows)

    def joints(u: float, q: Array) -> Array:
        position, rotation = T[:3, 3] + u * shift, Rotation.from_rotvec(u * turn) * Rotation.from_matrix(T[:3, :3])
        for _ in range(50):
            pose = table.pose(q)
            angle = (rotation * Rotation.from_matrix(pose[:3, :3]).inv()).as_rotvec()
            step = np.linalg.solve(table.jacobian(q)[kept], np.concatenate((position - pose[:3, 3], angle))[kept])
            q = q + step
            if np.abs(step).max() < 1e-14:
                break
        return q

    return of_joints(joints, start)
