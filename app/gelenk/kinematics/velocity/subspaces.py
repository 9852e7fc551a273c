"""The four fundamental subspaces of a Jacobian, by its singular value decomposition.

They are the tip velocities that joints can and cannot produce, the joint torques that balance a wrench at the tip, and
the joint velocities that leave the tip at rest: range(J) ⊕ ker(Jᵀ) = Rᵐ and range(Jᵀ) ⊕ ker(J) = Rⁿ. Each pair is
orthogonal in the given coordinates of rows and columns, so mixing metres and radians makes them depend on the units.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.robot.arrays import Array

_ROUNDING = 1e-14
"""Bound on the rounding of sines and sums along a chain, relative to the largest entry."""


@dataclass(frozen=True, slots=True)
class Subspaces:
    """J = Σ u_i σ_i v_iᵀ, split at its rank.

    Attributes:
        sigmas: σ, largest first; shape (min(m, n),).
        left, right: All u_i, (m, m), and v_i, (n, n), as columns; those that span range(J) and range(Jᵀ) first.
    """

    sigmas: Array
    rank: int
    left: Array
    right: Array

    @property
    def range(self) -> Array:
        """Orthonormal basis of the range of J: tip velocities that joints can produce; shape (m, rank)."""
        return self.left[:, : self.rank]

    @property
    def left_kernel(self) -> Array:
        """Basis of ker(Jᵀ): wrenches that need no torque, and lost tip velocities; shape (m, m - rank)."""
        return self.left[:, self.rank :]

    @property
    def row_space(self) -> Array:
        """Basis of range(Jᵀ), the joint torques that balance a wrench; shape (n, rank)."""
        return self.right[:, : self.rank]

    @property
    def kernel(self) -> Array:
        """Basis of ker(J), the joint velocities that leave the tip at rest; shape (n, n - rank)."""
        return self.right[:, self.rank :]


def subspaces(J: Array, tolerance: float, whole: Array | None = None) -> Subspaces:
    """Compute the four subspaces of a matrix.

    Args:
        J: The rows that count, with one column per joint; shape (m, n), m or n may be 0.
        tolerance: A singular value counts if it exceeds this times the largest.
        whole: The full Jacobian, if J has only some of its rows: singular values within its rounding do not count.
    """
    left, sigmas, right = np.linalg.svd(J)
    counts = (sigmas > tolerance * sigmas[:1]) & (sigmas > rounding(J if whole is None else whole))
    return Subspaces(sigmas, int(np.sum(counts)), left, right.T)


def rounding(Js: Array) -> Array:
    """Estimate rounding errors in the entries of Jacobians; shape (…, 6, n) → (…,)."""
    return np.asarray(_ROUNDING * np.abs(Js).max(axis=(-2, -1), initial=0.0))
