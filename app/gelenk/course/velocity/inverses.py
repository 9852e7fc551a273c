"""Inverses of one Jacobian by the formulas of the lecture: exact, pseudo-inverse by cases, weighted, damped.

The core inverts by singular values alone; here each case has the formula that the lecture gives it, so that the numbers
are computed a second time. J has m rows and n columns; W = diag(w) weights the joints.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal, TypeAlias

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.result import Result

Case: TypeAlias = Literal["square", "wide", "tall", "rank_deficient"]

_ROUNDING = 1e-15
"""Singular values up to this times the largest are rounding too."""
_SMALL = 1e-100
"""Singular values whose squares may underflow."""
_WELL_CONDITIONED = 1e5
"""Condition number up to which JJᵀ, whose condition number is the square, loses fewer than half of the digits."""


@dataclass(frozen=True, slots=True)
class Derivation(Result):
    """The matrices behind a solution; angular rows are multiplied by `characteristic_length` where one is given.

    Attributes:
        case: `square`: J⁻¹. `wide`, fewer directions than joints: Jᵀ(JJᵀ)⁻¹. `tall`: (JᵀJ)⁻¹Jᵀ. `rank_deficient`:
            VΣ#Uᵀ.
        jacobian: J, the rows that count, [m or rad] per [rad or m].
        pseudo_inverse: J#, with `weights` the weighted one; n rows, [rad or m] per [m or rad].
        moore_penrose: Largest entries of JJ#J - J, J#JJ# - J#, (J#J)ᵀ - J#J, (JJ#)ᵀ - JJ#, which are rounding; with
            weights the third is of W J#J; units of these matrices.
        null_space_projector: I - J#J; n rows, units of the joints mixed.
        gains: Factors of the singular directions, σ/(σ² + λ), or 1/σ without damping and 0 beyond the rank; unit of
            `pseudo_inverse`.
        damped_inverse: Jᵀ(JJᵀ + λI)⁻¹ with `damped`, likewise; null without damping.
        damped_objective: λ q̇ᵀWq̇ + ‖Jq̇ - v‖² at its minimum, metres and radians mixed; null without damping.
        damped_error: e = λ(JJᵀ + λI)⁻¹v = v - Jq̇, units of v; null without damping.
        objective: H at the configuration, with an objective in `null_space`; unit depends on it.
        objective_gradient: ∇H by each joint; unit of H per [rad or m].
        null_space_motion: (I - J#J) ξ as it was added, [rad/s or m/s], or per s more; null without `null_space`.
    """

    case: Case
    jacobian: list[list[float]]
    pseudo_inverse: list[list[float]]
    moore_penrose: tuple[float, float, float, float]
    null_space_projector: list[list[float]]
    gains: list[float]
    damped_inverse: list[list[float]] | None = None
    damped_objective: float | None = None
    damped_error: list[float] | None = None
    objective: float | None = None
    objective_gradient: list[float] | None = None
    null_space_motion: list[float] | None = None


@dataclass(frozen=True)
class LectureInverse:
    """The inverse of a Jacobian of shape (m, n) and given rank, with weights of the joints, shape (n,), and λ.

    Singular values up to `rounding` are never used, not even with damping.
    """

    J: Array
    rank: int
    weights: Array
    damping: float = 0.0
    rounding: float = 0.0

    @property
    def is_weighted(self) -> bool:
        """Whether any joint counts more than another."""
        return bool((self.weights != 1.0).any())

    @cached_property
    def factors(self) -> tuple[Array, Array, Array]:
        """U, σ and Vᵀ of J W^(-1/2)."""
        left, sigmas, right = np.linalg.svd(self.J / np.sqrt(self.weights))
        return left, sigmas, right

    @property
    def case(self) -> Case:
        """Which formula holds."""
        m, n = self.J.shape
        if self.rank < min(m, n):
            return "rank_deficient"
        return "square" if m == n else "wide" if m < n else "tall"

    @property
    def by_singular_values(self) -> bool:
        """Whether the formula of singular values is taken: always where the rank is too small or nearly so."""
        sigmas = self.factors[1]
        if self.case == "rank_deficient" or not len(sigmas) or not _SMALL < sigmas[-1] <= sigmas[0] < 1.0 / _SMALL:
            return True
        return bool(sigmas[0] > _WELL_CONDITIONED * sigmas[-1])

    @cached_property
    def gains(self) -> Array:
        """σ/(σ² + λ), or 1/σ up to the rank; shape (min(m, n),)."""
        sigmas = self.factors[1]
        if self.damping > 0.0:
            counts = sigmas > np.maximum(self.rounding, _ROUNDING * sigmas[:1])
            return np.where(counts, sigmas / (np.square(sigmas) + self.damping), 0.0)
        return self.inverted_values

    @property
    def inverted_values(self) -> Array:
        """The diagonal of Σ#: 1/σ up to the rank, and 0 beyond; shape (min(m, n),)."""
        sigmas = self.factors[1]
        counts = np.arange(len(sigmas)) < self.rank
        return np.where(counts, 1.0 / np.where(counts, sigmas, 1.0), 0.0)

    @cached_property
    def pseudo_inverse(self) -> Array:
        """J#, shape (n, m)."""
        J, inverse = self.J, 1.0 / self.weights
        if self.by_singular_values:
            return self._spread(self.inverted_values)
        if self.case == "square":
            return np.asarray(np.linalg.inv(J))
        if self.case == "wide":
            return np.asarray(inverse[:, None] * J.T @ np.linalg.inv(J * inverse @ J.T))
        return np.asarray(np.linalg.inv(J.T @ J) @ J.T)

    @cached_property
    def damped_inverse(self) -> Array:
        """(JᵀJ + λW)⁻¹Jᵀ, which is W⁻¹Jᵀ(JW⁻¹Jᵀ + λI)⁻¹; shape (n, m)."""
        J, sigmas = self.J, self.factors[1]
        if self.damping * _WELL_CONDITIONED**2 < np.square(sigmas[:1]).sum():
            return self._spread(self.gains)
        return np.asarray(np.linalg.solve(J.T @ J + self.damping * np.diag(self.weights), J.T))

    @property
    def projector(self) -> Array:
        """I - J#J; shape (n, n)."""
        return np.eye(self.J.shape[1]) - self.pseudo_inverse @ self.J

    @property
    def moore_penrose(self) -> tuple[float, float, float, float]:
        """Largest entries of what the four conditions say is zero."""
        J, P = self.J, self.pseudo_inverse
        inner, outer = self.weights[:, None] * (P @ J), J @ P
        differences = (outer @ J - J, P @ outer - P, inner.T - inner, outer.T - outer)
        first, second, third, fourth = (float(np.abs(each).max(initial=0.0)) for each in differences)
        return first, second, third, fourth

    def _spread(self, gains: Array) -> Array:
        left, _, right = self.factors
        few = len(gains)
        return np.asarray((right[:few].T * gains) @ left[:, :few].T / np.sqrt(self.weights)[:, None])
