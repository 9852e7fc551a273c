"""The field of joint rates along a path of the tip, and the exact points of the joints' path in it.

q' = J⁺ξ where the joints are just as many as the directions that count, or more: then it is the shortest q'. Its
derivative is q'' = J̇ᵀλ + J⁺(ξ' - J̇q' - J J̇ᵀλ) with λ = (JJᵀ)⁻¹ξ. Of an arm with joints to spare the field may have a
part along the self-motion besides, which keeps joints away from their limits.
"""

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from gelenk.kinematics.ik.task import Task
from gelenk.model.arrays import Array
from gelenk.model.chain import Chain
from gelenk.model.notations import rotations_from_vectors
from gelenk.model.poses import Poses
from gelenk.trajectory.follow_rows import Rows, row_derivatives, task_rows
from gelenk.trajectory.paths import Path, PathSamples

STENCIL = np.array([1.0, -8.0, 8.0, -1.0]) / 12.0
PLACES = np.array([-2.0, -1.0, 1.0, 2.0])
"""Of the difference of fourth order."""
_DIFFERENCE = 1e-3
"""Step of that difference in q, [rad or m]; less where the field changes within less."""
_RANK = 1e-13
"""Share of the largest singular value below which one is none."""
_EXACT = 1e-14
"""An error that no step makes less, in fractions of 1 and the distances at hand, [m and rad]."""
_NEARLY = 1e-10
_MOST_STEPS = 12
_ELIMINATED = 1e-6
_FAR = 1e6
"""Beyond which a predicted configuration is none, [rad or m]."""
_FARTHEST = 1.0
"""Of a step of Newton's method, [rad or m]."""
_EDGE = 0.2
"""Share of a joint's range at each limit in which it is pushed away."""


@dataclass(frozen=True, slots=True)
class Knot:
    """An exact point of the joints' path.

    Attributes:
        s: Where, [m or rad].
        q: Shape (n,), [rad or m].
        dq: q' there; shape (n,).
        ddq: q'' there; shape (n,).
        sigma: The smallest singular value of the rows that count.
        span: An orthonormal basis of the rows of J; shape (r, n).
        change: The size of dJ/ds, by which σ changes at most.
        offset: How far q is from the way: of the first knot alone, [rad or m].
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
class Course:
    """The path to follow, and how.

    Attributes:
        chain: Base and tip.
        path: The path of the tip.
        task: Which directions of it count.
        residuals: Largest distance [m] and angle [rad] of an arm that has too few joints for all directions.
        limited: Whether joints have to keep their limits.
        push: How hard joints to spare are pushed away from their limits.
    """

    chain: Chain
    path: Path
    task: Task
    residuals: tuple[float, float]
    limited: bool = True
    push: float = 0.0

    @property
    def is_redundant(self) -> bool:
        """Whether there are more joints than directions."""
        return len(self.chain) > len(self.task)

    def samples(self, s: Array, begin: float, end: float) -> PathSamples:
        """The path within a stretch between two of its breaks, whose derivatives at its end are those before it."""
        return self.path.at(np.minimum(np.maximum(s, begin), end - 8.0 * np.spacing(end)))

    def velocities(self, at: PathSamples, qs: Array) -> tuple[Array, Array]:
        """Rates q' of the field, shape (N, n), and the smallest singular value, shape (N,)."""
        rows = task_rows(self.chain, self.task, at, qs)
        left, sigmas, right = np.linalg.svd(rows.jacobians, full_matrices=False)
        dqs = _applied(left, sigmas, right, rows.rates)
        if self.push > 0.0:
            dqs = dqs + self._pushed(right, rows.rates, qs)
        return dqs, sigmas[:, -1]

    def knot(self, s: float, at: PathSamples, q: Array, rows: Rows | None = None) -> Knot:
        """The knot at a configuration on the way; `at` is one sample, and `rows` are those there, if known."""
        rows = task_rows(self.chain, self.task, at, q[None]) if rows is None else rows
        left, sigmas, right = np.linalg.svd(rows.jacobians, full_matrices=False)
        dq = _applied(left, sigmas, right, rows.rates)
        if self.push > 0.0:
            dq = dq + self._pushed(right, rows.rates, q[None])
        dJ, dxi = row_derivatives(self.chain, self.task, at, q[None], dq)
        if self.push > 0.0:
            ddq = derivative_along(self, at, q, dq[0], float(sigmas[0, -1]))
        else:
            ddq = _acceleration(rows, left, sigmas, right, dq, dJ, dxi)[0]
        return Knot(s, q, dq[0], ddq, float(sigmas[0, -1]), right[0], float(np.sqrt(np.sum(dJ * dJ))))

    def first_knot(self, s: float, at: PathSamples, q: Array) -> Knot:
        """The knot at a configuration that is nearly on the path."""
        rows = task_rows(self.chain, self.task, at, q[None])
        offset = _applied(*np.linalg.svd(rows.jacobians, full_matrices=False), rows.errors)
        return replace(self.knot(s, at, q), offset=float(np.abs(offset).max()))

    def next_to(self, s: float, at: PathSamples, q: Array) -> Knot | None:
        """The knot next to a configuration, by Newton's method; None where that does not converge."""
        floor = _EXACT * (1.0 + float(np.abs(at.poses.positions).max()) + float(np.abs(q).max()))
        before = np.inf
        for _ in range(_MOST_STEPS):
            if not float(np.abs(q).max(initial=0.0)) <= _FAR:
                return None
            rows = task_rows(self.chain, self.task, at, q[None])
            error = float(np.abs(rows.errors).max())
            if error <= floor or (error <= _NEARLY and error > 0.5 * before):
                return self.knot(s, at, q, rows)
            step = _step(rows)
            length = float(np.abs(step).max())
            if not length <= _FARTHEST:
                return None
            q, before = q + step, error
            if len(self.chain) < len(self.task) and length <= _EXACT * (1.0 + float(np.abs(q).max())) * 10.0:
                return self.knot(s, at, q) if self.within(at, q) else None
        return None

    def within(self, at: PathSamples, q: Array) -> bool:
        """Whether the tip is on the way as nearly as it may be."""
        rows = task_rows(self.chain, self.task, at, q[None])
        limits = np.where(np.flatnonzero(self.task.weights) < 3, *self.residuals)
        return bool((np.abs(rows.errors[0]) <= limits).all())

    def _pushed(self, right: Array, rates: Array, qs: Array) -> Array:
        """The part of the field along the self-motion, away from limits that are near; shape (N, n)."""
        lower, upper = self.chain.lower, self.chain.upper
        ranges = upper - lower
        limited = np.isfinite(ranges) & (ranges > 0.0)
        edges = np.where(limited, _EDGE * ranges, 1.0)
        low = np.where(limited, np.maximum(lower + edges - qs, 0.0) / edges, 0.0)
        high = np.where(limited, np.maximum(qs - upper + edges, 0.0) / edges, 0.0)
        # The cube keeps q'' continuous where a joint comes near to its limit.
        away = self.push * np.linalg.norm(rates, axis=1)[:, None] * (low**3 - high**3)
        result: Array = away - np.einsum("bri,br->bi", right, np.einsum("bri,bi->br", right, away))
        return result


def _step(rows: Rows) -> Array:
    """J⁺e of the one configuration, by elimination where J is far from losing rank; shape (n,)."""
    J, e = rows.jacobians[0], rows.errors[0]
    if len(J) <= J.shape[1]:
        try:
            step: Array = J.T @ np.linalg.solve(J @ J.T, e)
        except np.linalg.LinAlgError:
            step = np.full(J.shape[1], np.nan)
        # Elimination is as good as a decomposition where what it leaves is a small part of what there was.
        if float(np.abs(J @ step - e).max()) <= _ELIMINATED * float(np.abs(e).max()):
            return step
    decomposed: Array = _applied(*np.linalg.svd(rows.jacobians, full_matrices=False), rows.errors)[0]
    return decomposed


def _applied(left: Array, sigmas: Array, right: Array, bs: Array) -> Array:
    """J⁺b of decompositions; shape (N, n)."""
    counts = sigmas > _RANK * sigmas[:, :1]
    gains = np.where(counts, 1.0 / np.where(counts, sigmas, 1.0), 0.0)
    result: Array = ((gains[:, :, None] * (left.transpose(0, 2, 1) @ bs[:, :, None])).transpose(0, 2, 1) @ right)[:, 0]
    return result


def _acceleration(rows: Rows, left: Array, sigmas: Array, right: Array, dq: Array, dJ: Array, dxi: Array) -> Array:
    """Acceleration q'' of the shortest q'; shape (N, n)."""
    missing = dxi - (dJ @ dq[:, :, None])[:, :, 0]
    if rows.jacobians.shape[2] <= rows.jacobians.shape[1]:
        return _applied(left, sigmas, right, missing)
    # λ = (JJᵀ)⁻¹ξ = (J⁺)ᵀq'.
    counts = sigmas > _RANK * sigmas[:, :1]
    gains = np.where(counts, 1.0 / np.where(counts, sigmas, 1.0), 0.0)
    lam = (left @ (gains[:, :, None] * (right @ dq[:, :, None])))[:, :, 0]
    along = (dJ.transpose(0, 2, 1) @ lam[:, :, None])[:, :, 0]
    return along + _applied(left, sigmas, right, missing - (rows.jacobians @ along[:, :, None])[:, :, 0])


class Field(Protocol):
    """Joint rates anywhere."""

    def velocities(self, at: PathSamples, qs: Array) -> tuple[Array, Array]:
        """Rates q', shape (N, n), and the smallest singular value, shape (N,)."""


def taken(at: PathSamples, rows: slice) -> PathSamples:
    """Some of the samples."""
    return PathSamples(Poses(at.poses.positions[rows], at.poses.rotations[rows]), at.first[rows], at.second[rows])


def derivative_along(field: Field, at: PathSamples, q: Array, dq: Array, sigma: float) -> Array:
    """The derivative by s of a field along its own path, by a difference of fourth order; shape (n,)."""
    step = min(_DIFFERENCE, 0.05 * max(sigma, 1e-6)) / max(
        float(np.abs(dq).max()), float(np.abs(at.first[:, 3:]).max()), 1e-300
    )
    places = PLACES * step
    velocities = field.velocities(beside(at, places), q + places[:, None] * dq)[0]
    result: Array = STENCIL @ velocities / step
    return result


def beside(at: PathSamples, places: Array) -> PathSamples:
    """The path near to one sample of it, right to first order in the places' distance; never beyond a break of it."""
    first, second = at.first + places[:, None] * at.second, np.repeat(at.second, len(places), axis=0)
    mean = at.first + 0.5 * places[:, None] * at.second
    positions = at.poses.positions + places[:, None] * mean[:, :3]
    rotations = rotations_from_vectors(np.ascontiguousarray(places[:, None] * mean[:, 3:])) @ at.poses.rotations
    return PathSamples(Poses(positions, rotations), first, second)
