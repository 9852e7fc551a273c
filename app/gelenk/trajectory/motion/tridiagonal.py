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
    from gelenk.trajectory.motion.evaluation import eliminated  # noqa: PLC0415 - a client has no compiler

    if A.lower[0] == 0.0 == A.upper[-1]:
        return eliminated(A.lower, A.diagonal, A.upper, np.ascontiguousarray(b))
    if len(A) <= 2:
        return np.asarray(np.linalg.solve(A.dense(), b), dtype=float)
    corner = -A.diagonal[0]
    diagonal = A.diagonal.copy()
    diagonal[0] -= corner
    diagonal[-1] -= A.lower[0] * A.upper[-1] / corner
    u = np.zeros((len(A), 1))
    u[0], u[-1] = corner, A.upper[-1]
    both = eliminated(A.lower, diagonal, A.upper, np.concatenate([b, u], axis=1))
    y, z = both[:, :-1], both[:, -1:]
    ratio = A.lower[0] / corner
    found: Array = y - z * ((y[0] + ratio * y[-1]) / (1.0 + z[0] + ratio * z[-1]))
    return found
