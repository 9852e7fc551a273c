"""Field of joint rates along a path of the tip, and the exact knots of the joint path in it.

q' = J⁺ξ; with more joints than directions that count it is the shortest q'. With at least as many joints its
derivative is q'' = J̇ᵀλ + J⁺(ξ' - J̇q' - J J̇ᵀλ) with λ = (JJᵀ)⁻¹ξ.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.notations import rotations_from_vectors
from gelenk.robot.poses import Poses
from gelenk.trajectory.follow.kernels.nearest import EXACT, FAR, FARTHEST, MOST_STEPS, NEARLY, RANK, nearest
from gelenk.trajectory.follow.rows import PLACES, STENCIL, CountedRows, row_derivatives, task_rows
from gelenk.trajectory.paths.paths import Path, PathSamples

Velocities: TypeAlias = Callable[[PathSamples, Array], tuple[Array, Array]]
"""Returns the rates q' of a field, shape (N, n), and the smallest singular value, shape (N,), at any configurations."""

SHARE = 1.0 / 3.0
"""Share of the tolerances that interpolation may use."""
_DIFFERENCE = 1e-3
"""Step of differences in q, [rad or m]; smaller near a singularity, where the field changes fast."""
_ELIMINATED = 1e-6


@dataclass(frozen=True, slots=True)
class Knot:
    """An exact point of the joint path.

    Attributes:
        s: Its place, [m or rad].
        q, dq, ddq: q, q' and q'' there; shape (n,).
        sigma: The smallest singular value of the rows that count.
        span: An orthonormal basis of the rows of J; shape (r, n).
        change: Norm of dJ/ds, which bounds the change of σ.
        offset: Distance of q from the path, for a first knot only, [rad or m].
    """

    s: float
    q: Array
    dq: Array
    ddq: Array
    sigma: float
    span: Array
    change: float
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class RateField:
    """The joint rates that follow a path of the tip.

    Attributes:
        tolerances: Largest distance [m] and angle [rad] from the path.
        threshold: σ at which following ends; 0 goes through singularities as long as an exact path exists.
        limited: Whether joints must keep their limits.
    """

    chain: Chain
    path: Path
    task: Task
    tolerances: tuple[float, float]
    threshold: float = 0.0
    limited: bool = True

    @property
    def is_redundant(self) -> bool:
        """Whether there are more joints than directions that count."""
        return len(self.chain) > len(self.task)

    @property
    def residuals(self) -> tuple[float, float]:
        """Distance [m] and angle [rad] allowed to an arm with too few joints for all directions."""
        return SHARE * self.tolerances[0], SHARE * self.tolerances[1]

    def samples(self, s: Array, begin: float, end: float) -> PathSamples:
        """Sample the path between two of its breaks; at the end the derivatives are those before the break."""
        return self.path.at(np.minimum(np.maximum(s, begin), end - 8.0 * np.spacing(end)))

    def errors(self, at: PathSamples, qs: Array) -> Array:
        """Return the distances [m] and angles [rad] of configurations from the path; shape (2, N)."""
        return self.task.errors(at.poses, Poses(*chain_poses(self.chain.flat, qs)))

    def velocities(self, at: PathSamples, qs: Array) -> tuple[Array, Array]:
        """Return the field's rates q', shape (N, n), and the smallest singular value, shape (N,)."""
        dqs, (_, sigmas, _) = _rates(task_rows(self.chain, self.task, at, qs))
        return dqs, sigmas[:, -1]

    def knot(self, s: float, at: PathSamples, q: Array, rows: CountedRows | None = None) -> Knot:
        """Return the knot at a configuration on the path; `at` is one sample, `rows` its task rows if known."""
        rows = task_rows(self.chain, self.task, at, q[None]) if rows is None else rows
        dq, (left, sigmas, right) = _rates(rows)
        dJ, dxi = row_derivatives(self.chain, self.task, at, q[None], dq)
        ddq = _acceleration(rows, left, sigmas, right, dq, dJ, dxi)[0]
        return Knot(s, q, dq[0], ddq, float(sigmas[0, -1]), right[0], float(np.sqrt(np.sum(dJ * dJ))))

    def knots(self, places: Array, at: PathSamples, rates: Array, offset: float = 0.0) -> list[Knot]:
        """Return the knots at places, (N,), with the q, q' and q'' given, (3, N, n); `offset` is that of the first."""
        q, dq, ddq = rates
        rows = task_rows(self.chain, self.task, at, q)
        _, sigmas, right = np.linalg.svd(rows.jacobians, full_matrices=False)
        changes = np.sqrt(np.square(row_derivatives(self.chain, self.task, at, q, dq)[0]).sum(axis=(1, 2)))
        s, sigma, change = (values.tolist() for values in (places, sigmas[:, -1], changes))
        offsets = [offset, *[0.0] * (len(s) - 1)]
        return [Knot(*row) for row in zip(s, q, dq, ddq, sigma, right, change, offsets, strict=True)]

    def first_knot(self, s: float, at: PathSamples, q: Array) -> Knot:
        """Return the knot at a configuration that is nearly on the path."""
        rows = task_rows(self.chain, self.task, at, q[None])
        offset = _applied(*np.linalg.svd(rows.jacobians, full_matrices=False), rows.errors)
        return replace(self.knot(s, at, q), offset=float(np.abs(offset).max()))

    def next_to(self, s: float, at: PathSamples, q: Array) -> Knot | None:
        """Find the knot nearest to a configuration by Newton's method; None if it does not converge."""
        if len(self.task) == len(FULL_POSE) <= len(self.chain):
            one = (at.poses.positions[0], at.poses.rotations[0], at.first[0], at.second[0], q)
            found = nearest(self.chain.flat, *map(np.ascontiguousarray, one))
            return Knot(s, *found[1:]) if found[0] else None
        floor = EXACT * (1.0 + float(np.abs(at.poses.positions).max()) + float(np.abs(q).max()))
        before = np.inf
        for _ in range(MOST_STEPS):
            if not float(np.abs(q).max(initial=0.0)) <= FAR:
                return None
            rows = task_rows(self.chain, self.task, at, q[None])
            error = float(np.abs(rows.errors).max())
            if error <= floor or (error <= NEARLY and error > 0.5 * before):
                return self.knot(s, at, q, rows)
            step = _step(rows)
            length = float(np.abs(step).max())
            if not length <= FARTHEST:
                return None
            q, before = q + step, error
            if len(self.chain) < len(self.task) and length <= EXACT * (1.0 + float(np.abs(q).max())) * 10.0:
                return self.knot(s, at, q) if self.within(at, q) else None
        return None

    def within(self, at: PathSamples, q: Array) -> bool:
        """Return whether the tip is on the path within the residuals."""
        rows = task_rows(self.chain, self.task, at, q[None])
        limits = np.where(np.flatnonzero(self.task.weights) < 3, *self.residuals)
        return bool((np.abs(rows.errors[0]) <= limits).all())


def _rates(rows: CountedRows) -> tuple[Array, tuple[Array, Array, Array]]:
    """Return the shortest rates q', shape (N, n), and the singular value decompositions of J."""
    left, sigmas, right = np.linalg.svd(rows.jacobians, full_matrices=False)
    return _applied(left, sigmas, right, rows.rates), (left, sigmas, right)


def _step(rows: CountedRows) -> Array:
    """Return J⁺e of the one configuration, by elimination if J is far from losing rank; shape (n,)."""
    J, e = rows.jacobians[0], rows.errors[0]
    if len(J) <= J.shape[1]:
        try:
            step: Array = J.T @ np.linalg.solve(J @ J.T, e)
        except np.linalg.LinAlgError:
            step = np.full(J.shape[1], np.nan)
        # Elimination is as good as an SVD if its residual is a small share of the error.
        if float(np.abs(J @ step - e).max()) <= _ELIMINATED * float(np.abs(e).max()):
            return step
    decomposed: Array = _applied(*np.linalg.svd(rows.jacobians, full_matrices=False), rows.errors)[0]
    return decomposed


def _applied(left: Array, sigmas: Array, right: Array, bs: Array) -> Array:
    """Return J⁺b from singular value decompositions of J; shape (N, n)."""
    gains = _gains(sigmas)
    return ((gains[:, :, None] * (left.transpose(0, 2, 1) @ bs[:, :, None])).transpose(0, 2, 1) @ right)[:, 0]


def _gains(sigmas: Array) -> Array:
    counts = sigmas > RANK * sigmas[:, :1]
    return np.where(counts, 1.0 / np.where(counts, sigmas, 1.0), 0.0)


def _acceleration(
    rows: CountedRows, left: Array, sigmas: Array, right: Array, dq: Array, dJ: Array, dxi: Array
) -> Array:
    missing = dxi - (dJ @ dq[:, :, None])[:, :, 0]
    if rows.jacobians.shape[2] <= rows.jacobians.shape[1]:
        return _applied(left, sigmas, right, missing)
    # λ = (JJᵀ)⁻¹ξ = (J⁺)ᵀq'.
    lam = (left @ (_gains(sigmas)[:, :, None] * (right @ dq[:, :, None])))[:, :, 0]
    along = (dJ.transpose(0, 2, 1) @ lam[:, :, None])[:, :, 0]
    return along + _applied(left, sigmas, right, missing - (rows.jacobians @ along[:, :, None])[:, :, 0])


def taken(at: PathSamples, rows: slice) -> PathSamples:
    """Return some of the samples."""
    return PathSamples(Poses(at.poses.positions[rows], at.poses.rotations[rows]), at.first[rows], at.second[rows])


def sampled(at: PathSamples) -> tuple[Array, Array, Array, Array]:
    """Return positions, rotations, ξ and ξ' as kernels take them."""
    parts = (at.poses.positions, at.poses.rotations, at.first, at.second)
    position, rotation, first, second = (np.ascontiguousarray(part) for part in parts)
    return position, rotation, first, second


def derivative_along(velocities: Velocities, at: PathSamples, q: Array, dq: Array, sigma: float) -> Array:
    """Return the derivative of a field by s along its own path, by a difference of fourth order; shape (n,)."""
    step = min(_DIFFERENCE, 0.05 * max(sigma, 1e-6)) / max(
        float(np.abs(dq).max()), float(np.abs(at.first[:, 3:]).max()), 1e-300
    )
    places = PLACES * step
    return STENCIL @ velocities(beside(at, places), q + places[:, None] * dq)[0] / step


def beside(at: PathSamples, places: Array) -> PathSamples:
    """Extrapolate the path from one sample to offsets in s, with its twist linear in s and without regard to breaks."""
    first, second = at.first + places[:, None] * at.second, np.repeat(at.second, len(places), axis=0)
    mean = at.first + 0.5 * places[:, None] * at.second
    positions = at.poses.positions + places[:, None] * mean[:, :3]
    rotations = rotations_from_vectors(np.ascontiguousarray(places[:, None] * mean[:, 3:])) @ at.poses.rotations
    return PathSamples(Poses(positions, rotations), first, second)
