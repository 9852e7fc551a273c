"""Tridiagonal systems, also with the two corners of a periodic one, solved in linear time."""

from dataclasses import dataclass

import numpy as np

from gelenk.robot.arrays import Array


@dataclass(frozen=True, slots=True)
class Tridiagonal:
    """A tridiagonal matrix, given by its diagonals; two corner entries continue the outer ones periodically.

    Attributes:
        lower: lower[i] = A[i, i - 1], and lower[0] = A[0, -1]; shape (N,).
        diagonal: A[i, i]; shape (N,).
        upper: upper[i] = A[i, i + 1], and upper[-1] = A[-1, 0]; shape (N,).
    """

    lower: Array
    diagonal: Array
    upper: Array

    def __len__(self) -> int:
        return len(self.diagonal)

    def dense(self) -> Array:
        """Return the full matrix of shape (N, N); diagonals that overlap, as in a periodic one of two rows, add up."""
        N = len(self)
        i = np.arange(N)
        A = np.diag(self.diagonal)
        np.add.at(A, (i, (i - 1) % N), self.lower)
        np.add.at(A, (i, (i + 1) % N), self.upper)
        return A


def solution(A: Tridiagonal, b: Array) -> Array:
    """Solve A x = b for a diagonally dominant matrix; x has the shape (N, n) of b.

    The corners are split off as a rank-one matrix, which the Sherman-Morrison formula takes into account.
    """
    if len(A) <= 2:
        return np.asarray(np.linalg.solve(A.dense(), b), dtype=float)
    if A.lower[0] == 0.0 == A.upper[-1]:
        return _reduced(A.lower, A.diagonal, A.upper, b)
    corner = -A.diagonal[0]
    diagonal = A.diagonal.copy()
    diagonal[0] -= corner
    diagonal[-1] -= A.lower[0] * A.upper[-1] / corner
    u = np.zeros((len(A), 1))
    u[0], u[-1] = corner, A.upper[-1]
    lower, upper = A.lower.copy(), A.upper.copy()
    lower[0] = upper[-1] = 0.0
    both = _reduced(lower, diagonal, upper, np.concatenate([b, u], axis=1))
    y, z = both[:, :-1], both[:, -1:]
    ratio = A.lower[0] / corner
    found: Array = y - z * ((y[0] + ratio * y[-1]) / (1.0 + z[0] + ratio * z[-1]))
    return found


def _reduced(lower: Array, diagonal: Array, upper: Array, b: Array) -> Array:
    """Solve by cyclic reduction: eliminate every second unknown, all at once, until one is left."""
    N = len(diagonal)
    if N == 1:
        x: Array = b / diagonal[:, None]
        return x
    if N % 2 == 0:
        # A dummy last row gives every odd row two neighbours.
        one_more = np.concatenate([b, np.zeros((1, b.shape[1]))])
        return _reduced(np.append(lower, 0.0), np.append(diagonal, 1.0), np.append(upper, 0.0), one_more)[:N]
    before = -lower[1::2] / diagonal[:-1:2]
    after = -upper[1::2] / diagonal[2::2]
    x = np.empty_like(b)
    x[1::2] = _reduced(
        before * lower[:-1:2],
        diagonal[1::2] + before * upper[:-1:2] + after * lower[2::2],
        after * upper[2::2],
        b[1::2] + before[:, None] * b[:-1:2] + after[:, None] * b[2::2],
    )
    x[::2] = b[::2]
    x[2::2] -= lower[2::2, None] * x[1::2]
    x[:-1:2] -= upper[:-1:2, None] * x[1::2]
    x[::2] /= diagonal[::2, None]
    return x
