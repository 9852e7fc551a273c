"""Solution of linear equations J x = b by exact, pseudo- and damped inverses, also for singular or non-square J.

All come from one singular value decomposition, of

    A = S J W^(-1/2) = Σ u_i σ_i v_iᵀ

where W weights the joints (a larger weight moves less) and S multiplies the angular rows by a characteristic length.
Without that length metres and radians are mixed: J#, σ, the condition number and the distance from a singularity then
depend on the unit of length. Only a unique solution of J x = b is independent of this choice.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.kinematics.velocity.jacobian import ranks
from gelenk.kinematics.velocity.words import InverseName, InverseStatus
from gelenk.robot.arrays import Array, Flags, Indices

SOLVED = 1e-9
"""Largest residual entry that counts as zero, relative to the largest of 1 and the entries of b."""

_LARGEST = 1e100
"""Largest joint velocity that counts as a solution."""
_DAMPINGS = 10.0 ** np.arange(-16.0, 33.0, 0.25)
"""Trial values, relative to σ_max², in the search for the smallest damping that satisfies the velocity limits."""
_ROUNDS, _POINTS = 6, 65
"""Number of rounds of that search, and grid points in each refinement."""
_ROUNDING = 1e-15
"""A singular value up to this times the largest is rounding, and is never used, not even with damping."""


@dataclass(frozen=True, slots=True)
class InverseRule:
    """The method and parameters for solving J x = b.

    Attributes:
        inverse: `exact`: x = J⁻¹ b for a square J. `pseudo_inverse`: the x with the smallest xᵀWx among those that
            minimise ‖S(Jx - b)‖. `damped`: minimises λ xᵀWx + ‖S(Jx - b)‖², x = (JᵀS²J + λW)⁻¹ JᵀS² b.
        rank_tolerance: A singular value of A counts towards the rank if it exceeds this times the largest.
        damping: λ ≥ 0 as in the course (others write λ² for it); None: as small as `damping_threshold` and the
            velocity limits allow.
        damping_threshold: σ₀ of the adaptive λ = max(0, σ₀² - σ_min²), which bounds all gains by 1/σ₀.
        weights: The positive diagonal of W; shape (n,). None for ones.
    """

    inverse: InverseName = "pseudo_inverse"
    rank_tolerance: float = 1e-10
    damping: float | None = None
    damping_threshold: float = 0.05
    weights: Array | None = None


@dataclass(frozen=True, slots=True)
class Decomposition:
    """Singular value decompositions A = U diag(σ) Vᵀ at N configurations.

    Attributes:
        left, right: Columns u_i, shape (N, k, k), and rows v_iᵀ, shape (N, n, n).
        sigmas: σ, largest first; shape (N, min(k, n)). Units are mixed unless a characteristic length is given.
        ranks, least: Numerical ranks, and bounds up to which singular values are rounding and never used; shape (N,).
        row_scales, column_scales: The diagonals of S, shape (k,), and W^(-1/2), shape (n,).
    """

    left: Array
    sigmas: Array
    right: Array
    ranks: Indices
    least: Array
    row_scales: Array
    column_scales: Array

    def lost_directions(self, row: int) -> Array:
        """Return unit vectors, in the rows of J, along which the tip cannot move; shape (lost, k)."""
        lost = self.left[row, :, self.ranks[row] :].T / self.row_scales
        return np.asarray(lost / np.linalg.norm(lost, axis=1, keepdims=True))

    def gains(self, damping: Array) -> Array:
        """Return the factors of uᵢᵀSb: σ/(σ² + λ); for λ = 0, 1/σ up to the rank and 0 beyond; (N, min(k, n))."""
        dampings = np.reshape(damping, (-1, 1))
        counts = np.arange(self.sigmas.shape[1]) < self.ranks[:, None]
        usable = np.where(dampings > 0.0, self.sigmas > self.least[:, None], counts)
        # σ² may underflow where σ does not.
        denominators = self.sigmas + dampings / np.where(usable, self.sigmas, 1.0)
        return np.where(usable, 1.0 / np.where(usable, denominators, 1.0), 0.0)

    def apply(self, gains: Array, bs: Array) -> Array:
        """Compute x = W^(-1/2) V diag(gains) Uᵀ S b; shape (N, n)."""
        few = self.sigmas.shape[1]
        parts = gains * np.einsum("bki,bk->bi", self.left[:, :, :few], bs * self.row_scales)
        return np.asarray(np.einsum("bij,bi->bj", self.right[:, :few], parts) * self.column_scales)

    def kernel_parts(self, xs: Array) -> Array:
        """Compute (I - J#J) ξ with the weighted pseudo-inverse; shape (N, n)."""
        counts = np.arange(self.right.shape[1]) < self.ranks[:, None]
        coordinates = np.einsum("bij,bj->bi", self.right, xs / self.column_scales)
        free = np.where(counts, 0.0, coordinates)
        return np.asarray(np.einsum("bij,bi->bj", self.right, free) * self.column_scales)


@dataclass(frozen=True, slots=True)
class Inversion:
    """The solutions of N equations J x = b.

    Attributes:
        xs, residuals: Solutions, zero where none exists, shape (N, n), and b - J x, shape (N, k).
        statuses: `solved`; `approximate`: no x gives b, or damping prevents it; `singular`: no solution exists.
        dampings: λ of each equation; shape (N,).
        shares: Share of the null-space motion that the velocity limits allow, in [0, 1]; shape (N,).
    """

    xs: Array
    residuals: Array
    statuses: tuple[InverseStatus, ...]
    dampings: Array
    shares: Array
    decomposition: Decomposition


def decompose(Js: Array, rule: InverseRule, row_scales: Array, least: Array | None = None) -> Decomposition:
    """Compute the singular value decomposition of A = S J W^(-1/2) at each configuration.

    Args:
        Js: The rows of the Jacobian that count; shape (N, k, n).
        least: Magnitude of rounding errors in the entries of Js; shape (N,). Zero if None.
    """
    column_scales = np.ones(Js.shape[2]) if rule.weights is None else 1.0 / np.sqrt(rule.weights)
    left, sigmas, right = np.linalg.svd(row_scales[:, None] * Js * column_scales)
    floors = np.zeros(len(Js)) if least is None else least * (row_scales.max() * column_scales.max(initial=1.0))
    floors = np.maximum(floors, _ROUNDING * sigmas[:, :1].sum(axis=1))
    counted = np.minimum(ranks(sigmas, rule.rank_tolerance), np.sum(sigmas > floors[:, None], axis=1))
    return Decomposition(left, sigmas, right, counted, floors, row_scales, column_scales)


def invert(
    Js: Array,
    bs: Array,
    rule: InverseRule,
    row_scales: Array,
    null_motion: Array | None = None,
    limits: Array | None = None,
    least: Array | None = None,
) -> Inversion:
    """Solve J x = b at N configurations.

    Args:
        Js, bs: The rows of the Jacobian that count, shape (N, k, n), and right-hand sides, shape (N, k).
        null_motion: ξ, whose component in ker J is added; shape (N, n).
        limits: Largest |x| of each joint, observed by the adaptive damping only; shape (n,), inf for no limit.
    """
    parts = decompose(Js, rule, row_scales, least)
    dampings = _dampings(parts, rule)
    xs = parts.apply(parts.gains(dampings), bs)
    bounds = limits if rule.inverse == "damped" and rule.damping is None else None
    if bounds is not None:
        for row in np.flatnonzero((np.abs(xs) > bounds).any(axis=1)):
            dampings[row], xs[row] = _damped_to_limits(parts, int(row), bs[row], dampings[row], bounds)
    shares = np.ones(len(Js))
    if null_motion is not None:
        added = parts.kernel_parts(null_motion)
        if bounds is not None:
            shares = _room(xs, added, bounds)
        xs = xs + shares[:, None] * added
    # A solution that does not exist, or is not finite or too large, becomes zero.
    void: Flags = np.logical_not((np.abs(xs) <= _LARGEST).all(axis=1))
    if rule.inverse == "exact":
        void |= parts.ranks < Js.shape[1]
    xs = np.where(void[:, None], 0.0, xs)
    residuals = bs - np.einsum("bki,bi->bk", Js, xs)
    solved = np.abs(residuals).max(axis=1, initial=0.0) <= SOLVED * np.maximum(1.0, np.abs(bs).max(axis=1, initial=0.0))
    statuses: tuple[InverseStatus, ...] = tuple(
        "singular" if none else "solved" if good else "approximate" for none, good in zip(void, solved, strict=True)
    )
    return Inversion(xs, residuals, statuses, dampings, shares, parts)


def _dampings(parts: Decomposition, rule: InverseRule) -> Array:
    """λ of each configuration, without the velocity limits; shape (N,)."""
    count = len(parts.sigmas)
    if rule.inverse != "damped" or parts.sigmas.shape[1] == 0:
        return np.zeros(count)
    if rule.damping is not None:
        return np.full(count, rule.damping)
    return np.maximum(0.0, rule.damping_threshold**2 - np.square(parts.sigmas[:, -1]))


def _damped_to_limits(parts: Decomposition, row: int, b: Array, least: float, limits: Array) -> tuple[float, Array]:
    """Smallest λ ≥ `least` at which all joints keep their velocity limits, and the joint velocities there.

    The weighted length of x falls as λ grows, but a single joint may become faster: a grid over all magnitudes finds
    the first λ at which all joints keep their limits, and finer grids between its points refine it.
    """
    sigmas = parts.sigmas[row]
    few = len(sigmas)
    counted = np.where(sigmas > parts.least[row], sigmas, 0.0)
    shares = counted * (parts.left[row, :, :few].T @ (b * parts.row_scales))
    joints = parts.right[row, :few] * parts.column_scales

    def at(dampings: Array) -> Array:
        return np.asarray((shares / (np.square(sigmas) + dampings[:, None])) @ joints)

    grid = least + _DAMPINGS * max(float(np.square(sigmas[:1]).sum()), 1e-300)
    low = least
    for _ in range(_ROUNDS):
        fits = (np.abs(at(grid)) <= limits).all(axis=1)
        if not fits.any():
            break
        first = int(np.argmax(fits))
        low, high = float(grid[first - 1]) if first else low, float(grid[first])
        grid = np.linspace(low, high, _POINTS)[1:]
    return float(grid[-1]), at(grid[-1:])[0]


def _room(xs: Array, added: Array, limits: Array) -> Array:
    """Largest share of `added`, in [0, 1], that keeps every joint within its limit; shape (N,)."""
    rooms = np.maximum(np.where(added > 0.0, limits - xs, limits + xs), 0.0)
    too_far = np.abs(added) > rooms
    shares = np.where(too_far, rooms, 1.0) / np.where(too_far, np.abs(added), 1.0)
    return np.asarray(shares.min(axis=1, initial=1.0))
