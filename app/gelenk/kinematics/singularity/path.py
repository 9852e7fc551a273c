"""Places where a path of configurations passes through or near singular configurations.

The path is piecewise linear in joint space. It is sampled in steps of a few hundredths of a radian; each minimum of the
smallest singular value is then refined by golden-section search and, as the value has a kink at zero, by Gauss-Newton
steps on the block of the Jacobian that vanishes there.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.kinematics.singularity.distance import vanishing_block
from gelenk.kinematics.velocity.task_space import TaskSpace, structure
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain

_STEP = 0.05
"""Longest joint motion between two stations, [rad or m]."""
_MOST_STATIONS = 64
"""Largest number of stations per segment."""
_FLAT = 1e-9
"""Difference of singular values, relative to the largest, that counts as rounding."""
_SECTIONS, _NEWTON_STEPS = 30, 6
_APART = 1e-6
_GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)


@dataclass(frozen=True, slots=True)
class PathMinimum:
    """A minimum of the smallest singular value along the path.

    Attributes:
        start: Position along the path, in configurations: 2.5 lies halfway between those of index 2 and 3.
        end: Equal to `start`, or the end of the interval if the value is constant for a while.
        q: The configuration at `start`; shape (n,), [rad or m].
        sigma: The smallest structurally nonzero singular value there.
        share: `sigma` over the largest singular value.
    """

    start: float
    end: float
    q: Array
    sigma: float
    share: float


def places_along(
    chain: Chain, qs: Array, space: TaskSpace, tolerance: float, threshold: float
) -> tuple[PathMinimum, ...]:
    """Find the minima of the smallest singular value along a path, in path order.

    Args:
        qs: The path; shape (N, n), [rad or m].
        tolerance: A singular value counts if it exceeds this times the largest.
        threshold: Omit minima above this share of the largest singular value.
    """
    line = _Line(chain, qs, space, structure(chain, space.task, space.reference).rank)
    if line.rank == 0 or len(qs) == 0:
        return ()
    stations = _stations(qs)
    sigmas, largest, least = line.sigmas(stations)
    sigmas = np.where(sigmas <= np.maximum(tolerance * largest, least), 0.0, sigmas)
    first, last = _valleys(sigmas, _FLAT * float(largest.max()))
    points = np.flatnonzero((first == last) & (sigmas[first] > 0.0))
    starts, ends = stations[first], stations[last]
    below, above = stations[np.maximum(first - 1, 0)], stations[np.minimum(last + 1, len(stations) - 1)]
    starts[points] = ends[points] = line.bottoms(below[points], above[points])
    # Neighbouring valleys may have the same minimum.
    own = np.append(True, np.diff(starts) > _APART)
    starts, ends = starts[own], ends[own]
    sigmas, largest, least = line.sigmas(starts)
    # With one row the smallest value is also the largest: within rounding it counts as zero.
    shares = np.where(sigmas > least, sigmas / np.where(sigmas > least, largest, 1.0), 0.0)
    return tuple(
        PathMinimum(float(start), float(end), line.at(start[None])[0], float(sigma), float(share))
        for start, end, sigma, share in zip(starts, ends, sigmas, shares, strict=True)
        if share <= threshold
    )


@dataclass(frozen=True, slots=True)
class _Line:
    """A piecewise linear path through configurations of shape (N, n); `rank` is the chain's structural one."""

    chain: Chain
    qs: Array
    space: TaskSpace
    rank: int

    def at(self, s: Array) -> Array:
        """Configurations at positions s along the path; shape (k,) → (k, n)."""
        segment = self._segments(s)
        following = np.minimum(segment + 1, len(self.qs) - 1)
        part = (s - segment)[:, None]
        return np.asarray((1.0 - part) * self.qs[segment] + part * self.qs[following])

    def sigmas(self, s: Array) -> tuple[Array, Array, Array]:
        """Smallest structurally nonzero singular values, largest ones, and their rounding; shape (k,) each."""
        Js, least = self.space.with_rounding(self.chain, self.at(s))
        values = np.linalg.svd(Js, compute_uv=False)
        return np.asarray(values[:, self.rank - 1]), np.asarray(values[:, 0]), least

    def bottoms(self, low: Array, high: Array) -> Array:
        """Find the minima of the smallest singular value between bounds; positions of shape (k,)."""
        if len(low) == 0:
            return low
        bounds = low, high
        inner, outer = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        for _ in range(_SECTIONS):
            falls = self.sigmas(inner)[0] > self.sigmas(outer)[0]
            low, high = np.where(falls, inner, low), np.where(falls, high, outer)
            inner, outer = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        s = 0.5 * (low + high)
        value = self.sigmas(s)[0]
        for _ in range(_NEWTON_STEPS):
            trial = np.clip(s + self._newton_step(s), *bounds)
            better = self.sigmas(trial)[0] < value
            s = np.where(better, trial, s)
            value = self.sigmas(s)[0]
        return s

    def _newton_step(self, s: Array) -> Array:
        """Gauss-Newton step along the path that minimises the vanishing block."""
        segment = self._segments(s)
        along = self.qs[np.minimum(segment + 1, len(self.qs) - 1)] - self.qs[segment]
        F, A = vanishing_block(self.chain, self.space, self.rank, self.at(s))
        slopes = np.einsum("nkj,nj->nk", A, along)
        squares = np.sum(slopes**2, axis=1)
        return np.where(squares > 0.0, -np.sum(slopes * F, axis=1) / np.where(squares > 0.0, squares, 1.0), 0.0)

    def _segments(self, s: Array) -> Array:
        return np.clip(np.floor(s).astype(np.int64), 0, max(len(self.qs) - 2, 0))


def _stations(qs: Array) -> Array:
    """Positions at which the path is sampled, including its configurations; shape (k,)."""
    strides = np.abs(np.diff(qs, axis=0)).max(axis=1, initial=0.0)
    counts = np.clip(np.ceil(strides / _STEP), 1, _MOST_STATIONS).astype(int)
    parts = [i + np.arange(count) / count for i, count in enumerate(counts)]
    return np.concatenate((*parts, [len(qs) - 1.0]))


def _valleys(values: Array, flat: float) -> tuple[Array, Array]:
    """First and last index of each run of equal values with a higher value, or the end, on both sides."""
    steps = np.diff(values)
    steps = np.where(np.abs(steps) <= flat, 0.0, steps)
    breaks = np.flatnonzero(steps)
    first, last = np.concatenate(([0], breaks + 1)), np.concatenate((breaks, [len(values) - 1]))
    falls_into = np.concatenate(([True], steps[breaks] < 0.0))
    rises_from = np.concatenate((steps[breaks] > 0.0, [True]))
    is_valley = falls_into & rises_from
    return first[is_valley], last[is_valley]
