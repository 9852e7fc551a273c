"""Piecewise polynomials in time with several coordinates: the common form of every motion.

Cubics, splines, trapezoidal and jerk-limited profiles and time-optimal parabolas along a spline all have this form, so
code that plays, samples, scales or audits a motion needs to handle no other.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import factorial, perm

import numpy as np

from gelenk.robot.arrays import Array, Indices


@dataclass(frozen=True, slots=True)
class PiecewisePolynomial:
    """A motion q(t) = Σ_k c[i, k] (t - t_i)^k on t_i ≤ t ≤ t_{i+1}; the outer pieces extend beyond its ends.

    Attributes:
        breaks: t_0 < t_1 < …, the ends of the M pieces; shape (M + 1,), [s].
        coefficients: c, lowest power first; shape (M, degree + 1, n), [rad or m per sᵏ].
    """

    breaks: Array
    coefficients: Array

    @property
    def duration(self) -> float:
        """Time from the first break to the last, [s]."""
        return float(self.breaks[-1] - self.breaks[0])

    def derivative(self, order: int = 1) -> "PiecewisePolynomial":
        """Return the time derivative of a given order."""
        c = self.coefficients
        factors = np.array([perm(k, order) for k in range(order, c.shape[1])])[:, None]
        rates = c[:, order:] * factors if len(factors) else np.zeros_like(c[:, :1])
        return PiecewisePolynomial(self.breaks, rates)

    def between(self, begin: float, end: float) -> "PiecewisePolynomial":
        """Return the pieces whose middle lies between two times, [s]."""
        first, last = np.searchsorted(0.5 * (self.breaks[:-1] + self.breaks[1:]), (begin, end))
        return PiecewisePolynomial(self.breaks[first : last + 1], self.coefficients[first:last])

    def at(self, times: Array) -> Array:
        """Return values of shape (N, n) at times of shape (N,), [s]; at an inner break, the later piece counts."""
        found: Array = self._evaluated(times, 0)[0]
        return found

    def rates_at(self, times: Array) -> list[Array]:
        """Return values and first and second derivatives at times of shape (N,), [s]; shape (N, n) each."""
        return list(self._evaluated(times, 2))

    def _evaluated(self, times: Array, order: int) -> Array:
        from gelenk.trajectory.motion.evaluation import evaluated  # noqa: PLC0415 - a client has no compiler

        c, t = np.ascontiguousarray(self.coefficients), np.ascontiguousarray(times, dtype=float)
        return evaluated(np.ascontiguousarray(self.breaks), c, t, order)

    def scaled(self, factor: float) -> "PiecewisePolynomial":
        """Return the same path in `factor` times the time: velocities scale by 1/factor, accelerations by 1/factor²."""
        powers = factor ** -np.arange(self.coefficients.shape[1])[:, None]
        start = self.breaks[0]
        return PiecewisePolynomial(start + factor * (self.breaks - start), self.coefficients * powers)

    def lasting(self, duration: float) -> "PiecewisePolynomial":
        """Return a motion from time 0 on, scaled to end at exactly `duration`, [s]."""
        scaled = self.scaled(duration / self.duration)
        return PiecewisePolynomial(np.append(scaled.breaks[:-1], duration), scaled.coefficients)


def joined(parts: Sequence[PiecewisePolynomial]) -> PiecewisePolynomial:
    """Join one or more motions of the same coordinates, each beginning when the previous one ends."""
    degree = max(part.coefficients.shape[1] for part in parts)
    breaks, rows = [parts[0].breaks[:1]], []
    for part in parts:
        breaks.append(breaks[-1][-1] + part.breaks[1:] - part.breaks[0])
        rows.append(np.pad(part.coefficients, ((0, 0), (0, degree - part.coefficients.shape[1]), (0, 0))))
    return PiecewisePolynomial(np.concatenate(breaks), np.concatenate(rows))


def derivatives(c: Array, local: Array, order: int = 3) -> list[Array]:
    """Evaluate polynomials and their derivatives up to `order` by Horner's scheme; shape (M, n) each.

    Args:
        c: Coefficients, lowest power first; shape (M, d + 1, n).
        local: Where to evaluate each; shape (M, 1).
    """
    value = c[:, -1] + 0.0 * local
    found = [value, *[np.zeros_like(value)] * order]
    for k in range(c.shape[1] - 2, -1, -1):
        for i in range(order, 0, -1):
            found[i] = found[i] * local + found[i - 1]
        found[0] = found[0] * local + c[:, k]
    return [*found[:2], *(factorial(i) * found[i] for i in range(2, order + 1))]


def cut(path: PiecewisePolynomial, nodes: Array) -> Array:
    """Return the coefficients of a path between nodes, (N + 1,), which include all its breaks; shape (N, d + 1, n)."""
    from gelenk.trajectory.motion.evaluation import expanded  # noqa: PLC0415 - a client has no compiler

    return expanded(np.ascontiguousarray(path.breaks), np.ascontiguousarray(path.coefficients), nodes)


def divided(breaks: Array, counts: Indices) -> Array:
    """Return breaks, (M + 1,), with each piece divided evenly into a number of parts, (M,)."""
    piece = np.repeat(np.arange(len(counts)), counts)
    share = (np.arange(len(piece)) - (np.cumsum(counts) - counts)[piece]) / counts[piece]
    return np.append(breaks[piece] + share * np.diff(breaks)[piece], breaks[-1])
