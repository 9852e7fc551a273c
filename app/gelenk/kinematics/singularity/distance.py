"""Distance in joint space from a configuration to the nearest singular one.

Where a direction is lost, the block F = Uᵀ J V of the Jacobian vanishes; U and V are the singular vectors from number r
on, r being the structural rank. Joint j changes F by Uᵀ ∂J/∂q_j V, so sequential quadratic programming projects onto
the singular set: x = q + A⁺(-F - A(q - x_k)). A fixed point has F = 0, and the line from q meets the set at a right
angle. To avoid missing the nearest such point, many starts are used: minima of the manipulability measure along rays
from q, then again inside the ball given by the first result. The result is singular, but not proven to be the nearest.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from gelenk.kinematics.simd.kernels import chain_measures
from gelenk.kinematics.velocity.task_space import STRUCTURAL_TOLERANCE, TaskSpace, random_configurations, structure
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain

_TRIALS = 8
_RAYS = 40
_STATIONS = 32
_STARTS = 32
_KEPT, _SETTLED = 6, 3
_ROUNDS, _MORE_ROUNDS, _NEWTON_STEPS = 5, 6, 5
_DIFFERENCE = 1e-6
_LONGEST_STEP = 0.6
"""Longest step of a start, [rad or m]: the projections are linear approximations."""
_AT_REST = 1e-10
_MOVED = 1e-6
"""A joint counts as moving if it moves by more than this, [rad or m]."""


@dataclass(frozen=True, slots=True)
class NearestSingularity:
    """The nearest singular configuration found.

    Attributes:
        distance: Norm of the joint motion to it, [rad and m].
        joints: Indices of the joints that move.
        sigma: The smallest singular value there, zero up to rounding.
    """

    q: Array
    distance: float
    joints: tuple[int, ...]
    sigma: float


def nearest_singularity(
    chain: Chain, q: Array, space: TaskSpace, *, radius: float, tolerance: float, respect_limits: bool
) -> NearestSingularity | None:
    """Find the nearest configuration that loses a direction the arm has elsewhere; None if none was found.

    The search is deterministic. Joint positions are compared without wrapping by full turns.

    Args:
        q: Configuration, within the limits if these are respected; shape (n,), [rad or m].
        radius: Largest distance from the configuration, [rad and m].
        tolerance: A singular value counts if it exceeds this times the largest.
    """
    if not can_lose(chain, space):
        return None
    free = np.full(len(q), np.inf)
    bounds = (chain.lower, chain.upper) if respect_limits else (-free, free)
    rank = structure(chain, space.task, space.reference).rank
    projection = _Projection(chain, q, space, rank, radius, tolerance, *bounds)
    if (here := projection.judged(q[None])) is not None:
        return here
    best = projection.nearest(_minima(projection, radius, 0))
    inside = projection.nearest(_minima(projection, radius if best is None else best.distance, 1))
    found = [singularity for singularity in (best, inside) if singularity is not None]
    return min(found, key=lambda singularity: singularity.distance, default=None)


def can_lose(chain: Chain, space: TaskSpace) -> bool:
    """Return whether any joint affects the rank of the rows that count."""
    return structure(chain, space.task, space.reference).rank > 0 and bool(_deciding_joints(chain, space))


def vanishing_block(chain: Chain, space: TaskSpace, rank: int, xs: Array) -> tuple[Array, Array]:
    """Compute the block F, which is zero where the Jacobian has less than a rank, and its derivative by the joints.

    The rank is the one that the chain has elsewhere, at least 1. For configurations (N, n), F is flattened, shape
    (N, k), and ∂F/∂q has shape (N, k, n).
    """
    left, sigmas, right = np.linalg.svd(space.jacobians(chain, xs))
    U, V = left[:, :, rank - 1 :], right[:, rank - 1 :]
    A = np.einsum("nka,nkij,nbi->nabj", U, space.hessians(chain, xs), V, optimize=True)
    F = np.zeros(A.shape[:3])
    for i in range(rank - 1, sigmas.shape[1]):
        F[:, i - rank + 1, i - rank + 1] = sigmas[:, i]
    return F.reshape(len(xs), -1), A.reshape(len(xs), -1, A.shape[3])


@dataclass(frozen=True, slots=True)
class _Projection:
    """Projection of a configuration q, shape (n,), onto the singular set, within bounds; `rank` is structural."""

    chain: Chain
    q: Array
    space: TaskSpace
    rank: int
    radius: float
    tolerance: float
    lower: Array
    upper: Array

    def nearest(self, xs: Array) -> NearestSingularity | None:
        """Find the nearest singular configuration reached from starts of shape (N, n)."""
        relax, last = np.ones(len(xs)), np.full(len(xs), np.inf)
        for k in range(_ROUNDS + _MORE_ROUNDS):
            if k == _ROUNDS:
                keep = self._best(xs, _KEPT)
                xs, relax, last = xs[keep], relax[keep], last[keep]
            normal, along = self._steps(xs)
            strides = np.linalg.norm(along, axis=1)
            # Where the set bends towards q, the step overshoots the foot: then take a shorter one.
            relax = np.where(strides > 0.8 * last, np.maximum(0.5 * relax, 1.0 / 16.0), relax)
            last = strides
            xs = self._moved(xs, normal + relax[:, None] * along)
        return self.judged(self._settled(xs[self._best(xs, _SETTLED)]))

    def _moved(self, xs: Array, steps: Array) -> Array:
        """Move starts by steps of bounded length, within the limits."""
        lengths = np.linalg.norm(steps, axis=1, keepdims=True)
        bounded = steps * np.minimum(1.0, _LONGEST_STEP / np.maximum(lengths, _LONGEST_STEP))
        return np.asarray(np.clip(xs + bounded, self.lower, self.upper))

    def _strides(self, xs: Array) -> Array:
        """Full step from each start to the foot of the perpendicular from q, to first order."""
        normal, along = self._steps(xs)
        return normal + along

    def _settled(self, xs: Array) -> Array:
        """Find zeros of the full step by Newton's method with difference quotients: there q is locally nearest."""
        count, n = xs.shape
        for _ in range(_NEWTON_STEPS):
            around = np.concatenate((xs[:, None], xs[:, None] + _DIFFERENCE * np.eye(n)), axis=1)
            steps = self._strides(around.reshape(-1, n)).reshape(count, n + 1, n)
            slopes = (steps[:, 1:] - steps[:, :1]).transpose(0, 2, 1) / _DIFFERENCE
            newton = -np.einsum("nij,nj->ni", np.linalg.pinv(slopes, rcond=1e-9), steps[:, 0])
            trials = self._moved(xs, newton)
            left = np.linalg.norm(self._strides(trials), axis=1)
            better = left < np.linalg.norm(steps[:, 0], axis=1)
            xs = np.where(better[:, None], trials, self._moved(xs, 0.5 * steps[:, 0]))
            if left.max() < _AT_REST:
                break
        return xs

    def _steps(self, xs: Array) -> tuple[Array, Array]:
        """Step to F = 0, and step along the singular set to the foot; joints at a limit stay there."""
        F, A = vanishing_block(self.chain, self.space, self.rank, xs)
        target = np.broadcast_to(self.q, xs.shape)
        free = np.ones(xs.shape, dtype=bool)
        for _ in range(3):
            inverse = np.linalg.pinv(A * free[:, None, :], rcond=1e-7)
            goal = target - np.einsum("njk,nk->nj", inverse, F + np.einsum("nkj,nj->nk", A, target - xs))
            outside = (goal < self.lower) | (goal > self.upper)
            if not outside.any():
                break
            free &= ~outside
            target = np.where(outside, np.clip(goal, self.lower, self.upper), target)
        normal = -np.einsum("njk,nk->nj", inverse, F)
        return normal, goal - xs - normal

    def _best(self, xs: Array, count: int) -> Array:
        """Indices of the most promising starts, without duplicates."""
        F, A = vanishing_block(self.chain, self.space, self.rank, xs)
        slopes = np.linalg.norm(A, axis=(1, 2))
        scores = np.linalg.norm(xs - self.q, axis=1) + 2.0 * np.linalg.norm(F, axis=1) / np.maximum(slopes, 1e-9)
        chosen: list[int] = []
        for i in np.argsort(scores, kind="stable"):
            if all(np.abs(xs[i] - xs[j]).max() > 1e-3 for j in chosen):
                chosen.append(int(i))
            if len(chosen) == count:
                break
        return np.array(chosen)

    def judged(self, xs: Array) -> NearestSingularity | None:
        """Return the nearest of the configurations that are singular and within the radius; None if none is."""
        Js, least = self.space.with_rounding(self.chain, xs)
        sigmas = np.linalg.svd(Js, compute_uv=False)
        distances = np.linalg.norm(xs - self.q, axis=1)
        vanished = sigmas[:, self.rank - 1] <= np.maximum(self.tolerance * sigmas[:, 0], least)
        good = vanished & (distances <= self.radius)
        if not good.any():
            return None
        i = int(np.argmin(np.where(good, distances, np.inf)))
        moved = np.flatnonzero(np.abs(xs[i] - self.q) > _MOVED)
        return NearestSingularity(xs[i], float(distances[i]), tuple(moved.tolist()), float(sigmas[i, self.rank - 1]))


def _minima(projection: _Projection, radius: float, seed: int) -> Array:
    """Minima of the manipulability measure on rays of a given length, nearest first; at most `_STARTS`, then q."""
    q, n = projection.q, len(projection.q)
    rays = _rays(_deciding_joints(projection.chain, projection.space), n, seed)
    stations = radius * np.arange(1, _STATIONS + 1) / _STATIONS
    points = np.clip(q + stations[:, None] * rays[:, None, :], projection.lower, projection.upper)
    measures = _measures(projection, points.reshape(-1, n)).reshape(len(rays), _STATIONS)
    start = np.full((len(rays), 1), _measures(projection, q[None])[0])
    padded = np.concatenate((start, measures, np.full((len(rays), 1), np.inf)), axis=1)
    lowest: Flags = (padded[:, 1:-1] < padded[:, :-2]) & (padded[:, 1:-1] <= padded[:, 2:])
    candidates = points[lowest]
    nearest = np.argsort(np.linalg.norm(candidates - q, axis=1), kind="stable")[:_STARTS]
    return np.concatenate((candidates[nearest], q[None]))


def _measures(projection: _Projection, xs: Array) -> Array:
    """Manipulability measure, or smallest singular value, which vanish where a direction is lost; shape (N,)."""
    space, chain = projection.space, projection.chain
    if not space.is_of_the_geometric_rows or projection.rank < min(len(space), len(chain)):
        sigmas = np.linalg.svd(space.jacobians(chain, xs), compute_uv=False)
        return np.asarray(sigmas[:, projection.rank - 1])
    return np.asarray(chain_measures(chain.flat, np.ascontiguousarray(xs), np.array(space.rows, dtype=np.int64))[2])


@lru_cache(maxsize=1024)
def _deciding_joints(chain: Chain, space: TaskSpace) -> tuple[int, ...]:
    """Joints that affect which directions are lost; a joint about the first axis, for example, does not."""
    xs = random_configurations(chain, _TRIALS)
    rank = structure(chain, space.task, space.reference).rank
    Js, least = space.with_rounding(chain, xs)
    left, _, right = np.linalg.svd(Js)
    slopes = np.einsum("nk,nkij,ni->nj", left[:, :, rank - 1], space.hessians(chain, xs), right[:, rank - 1])
    slight = max(STRUCTURAL_TOLERANCE * float(np.abs(slopes).max()), float(least.max()))
    return tuple(np.flatnonzero(np.abs(slopes).max(axis=0) > slight).tolist())


@lru_cache(maxsize=256)
def _rays(joints: tuple[int, ...], n: int, seed: int) -> Array:
    """Unit directions from a configuration: each of some joints alone, both signs, and random ones; shape (k, n)."""
    unit = np.eye(n)[list(joints)]
    drawn = np.random.default_rng(seed).normal(size=(_RAYS, len(joints))) @ unit
    return np.concatenate((unit, -unit, drawn / np.linalg.norm(drawn, axis=1, keepdims=True)))
