"""The four subspaces of a Jacobian, by its singular value decomposition.

Tip velocities that joints can make and those they cannot, joint torques that a wrench at the tip can ask for and joint
velocities that leave the tip at rest: range(J) ⊕ ker(Jᵀ) = Rᵐ and range(Jᵀ) ⊕ ker(J) = Rⁿ, each pair orthogonal in the
coordinates that the rows and columns are given in. Where metres and radians are mixed these depend on the units.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.model.arrays import Array

_ROUNDING = 1e-14
"""Share of the largest entry that the rounding of sines and sums along a chain may come to."""


@dataclass(frozen=True, slots=True)
class Subspaces:
    """J = Σ u_i σ_i v_iᵀ, split at its rank.

    Attributes:
        sigmas: σ, largest first; shape (min(m, n),).
        rank: How many of them count.
        left: All u_i as columns, the ones that span range(J) first; shape (m, m).
        right: All v_i as columns, the ones that span range(Jᵀ) first; shape (n, n).
    """

    sigmas: Array
    rank: int
    left: Array
    right: Array

    @property
    def range(self) -> Array:
        """Tip velocities that joint velocities make: an orthonormal basis; shape (m, rank)."""
        return self.left[:, : self.rank]

    @property
    def left_kernel(self) -> Array:
        """ker(Jᵀ), wrenches that no joint feels, and tip velocities that are lost; shape (m, m - rank)."""
        return self.left[:, self.rank :]

    @property
    def row_space(self) -> Array:
        """range(Jᵀ), joint torques that balance a wrench; shape (n, rank)."""
        return self.right[:, : self.rank]

    @property
    def kernel(self) -> Array:
        """Joint velocities that leave the tip at rest; shape (n, n - rank)."""
        return self.right[:, self.rank :]

    @property
    def pseudo_inverse(self) -> Array:
        """J# = Σ v_i uᵢᵀ / σ_i over the singular values that count [Penrose1955]; shape (n, m)."""
        inverse: Array = (self.row_space / self.sigmas[: self.rank]) @ self.range.T
        return inverse


def subspaces(J: Array, tolerance: float, whole: Array | None = None) -> Subspaces:
    """The four subspaces of a matrix.

    Args:
        J: Rows that count, columns the joints; shape (m, n), m or n may be 0.
        tolerance: A singular value counts where it exceeds this times the largest.
        whole: The Jacobian that the rows are of, where they are not all: if all of them vanish, what is left is the
            rounding of the others, and none counts.
    """
    left, sigmas, right = np.linalg.svd(J)
    counts = (sigmas > tolerance * sigmas[:1]) & (sigmas > rounding(J if whole is None else whole))
    return Subspaces(sigmas, int(np.sum(counts)), left, right.T)


def rounding(Js: Array) -> Array:
    """The size of rounding errors in the entries of Jacobians; shape (…, 6, n) → (…,)."""
    largest: Array = _ROUNDING * np.abs(Js).max(axis=(-2, -1), initial=0.0)
    return largest
