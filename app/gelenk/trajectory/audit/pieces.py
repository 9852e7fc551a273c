"""Polynomial pieces as the audit evaluates them, and the extremes of their derivatives.

The audit uses nothing from the planners: it scales each piece to τ from 0 to 1, evaluates it as a sum of powers, and
never computes roots. A polynomial of degree m that is sampled at the N + 1 extremes of a Chebyshev polynomial, N > m,
is nowhere larger than its largest sample over cos(m π / 2N) [Ehlich1964]. So the samples show which pieces could hold a
peak, and only those are refined.
"""

import math
from dataclasses import dataclass

import numpy as np

from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.trajectory.audit.peaks import highest
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_MIN_INTERVALS = 12
_CHUNK = 1024
"""Number of pieces that are sampled at a time."""
_ROUNDING = 1e-13
_SAME = 1e-12
"""Share by which a piece must be able to exceed the largest sample to be refined."""


@dataclass(frozen=True, slots=True)
class Pieces:
    """A motion as separate pieces, each scaled to τ from 0 to 1.

    Attributes:
        starts, widths: Start time and duration of each piece; shape (M,), [s].
        scaled: c_k hᵏ, the coefficients in τ; shape (degree + 1, M, n).
    """

    starts: Array
    widths: Array
    scaled: Array

    def part(self, first: int, last: int) -> "Pieces":
        """Return the pieces from number `first` up to, but not including, `last`."""
        return Pieces(self.starts[first:last], self.widths[first:last], self.scaled[:, first:last])

    def between(self, begin: float, end: float) -> "Pieces":
        """Return the pieces whose middle lies between two times, [s]."""
        middles = self.starts + 0.5 * self.widths
        return self.part(int(np.searchsorted(middles, begin)), int(np.searchsorted(middles, end)))

    def negated(self) -> "Pieces":
        """Return the pieces of the opposite motion, whose highest values are the lowest."""
        return Pieces(self.starts, self.widths, -self.scaled)

    @property
    def degree(self) -> int:
        """Degree of the positions."""
        return len(self.scaled) - 1

    def on(self, nodes: Array, order: int) -> Array:
        """Evaluate a time derivative at the same τ of every piece; shape (K,) → (K, M, n)."""
        powers = _powers(nodes, order, self.degree)
        flat = powers @ self.scaled.reshape(self.degree + 1, -1)
        values: Array = flat.reshape(len(nodes), *self.scaled.shape[1:])
        return values / self.widths[:, None] ** order if order else values

    def at(self, piece: Indices, tau: Array, order: int) -> Array:
        """Evaluate a time derivative at τ of the given pieces; shape (N,) each → (N, n)."""
        powers = _powers(tau, order, self.degree)
        values: Array = np.einsum("nk,knj->nj", powers, self.scaled[:, piece])
        return values / self.widths[piece, None] ** order if order else values

    def rates(self, piece: Indices, tau: Array) -> tuple[Array, Array, Array]:
        """Evaluate positions, velocities and accelerations at τ of some pieces; shape (N,) each → three of (N, n)."""
        scaled, per_width = self.scaled[:, piece], 1.0 / self.widths[piece, None]
        values, first, second = (
            np.einsum("nk,knj->nj", _powers(tau, order, self.degree), scaled) for order in range(3)
        )
        return values, first * per_width, second * per_width**2

    def positions(self, times: Array) -> Array:
        """Evaluate positions at times, [s]; shape (N,) → (N, n)."""
        piece = np.clip(np.searchsorted(self.starts, times, side="right") - 1, 0, len(self.starts) - 1)
        return self.at(piece, (times - self.starts[piece]) / self.widths[piece], 0)

    def joint_at(self, piece: Indices, joint: Indices, tau: Array, order: int) -> Array:
        """Evaluate a time derivative of one joint each at several τ; shapes (C,), (C,), (C, P) → (C, P)."""
        powers = _powers(tau, order, self.degree)
        values: Array = np.einsum("cpk,kc->cp", powers, self.scaled[:, piece, joint])
        return values / self.widths[piece, None] ** order

    def times(self, piece: Indices, tau: Array) -> Array:
        """Return the times at τ of some pieces, [s]."""
        return self.starts[piece] + tau * self.widths[piece]


def pieces_of(motion: PiecewisePolynomial) -> Pieces:
    """The pieces of a motion."""
    widths = np.diff(motion.breaks)
    powers = widths ** np.arange(motion.coefficients.shape[1])[:, None]
    return Pieces(motion.breaks[:-1], widths, motion.coefficients.transpose(1, 0, 2) * powers[:, :, None])


def extremes(pieces: Pieces, order: int, *, absolute: bool = False) -> tuple[Array, Array]:
    """Find each joint's highest value of a derivative, or largest magnitude, and its time [s]; shape (n,) each."""
    degree = max(pieces.degree - order, 0)
    count = max(_MIN_INTERVALS, 2 * degree + 2)
    nodes = 0.5 - 0.5 * np.cos(np.arange(count + 1) * math.pi / count)
    n = pieces.scaled.shape[2]
    found = _Largest(np.full(n, -np.inf), np.zeros(n, dtype=np.int64), np.zeros(n))
    for first in range(0, len(pieces.widths), _CHUNK):
        part = pieces.part(first, first + _CHUNK)
        values = part.on(nodes, order)
        signed = np.abs(values) if absolute else values
        found.take_samples(signed, nodes, first)
        if degree > 1:
            # At degree 0 or 1 the extremes are at the ends, which are samples.
            bounds = _bounds(values, absolute, 1.0 / math.cos(0.5 * math.pi * degree / count))
            can_exceed = bounds > found.best + _SAME * np.abs(found.best)
            _refine(part, order, absolute, nodes, signed, can_exceed, found, first)
    values = pieces.joint_at(found.piece, np.arange(n), found.tau[:, None], order)[:, 0]
    return values, pieces.times(found.piece, found.tau)


def largest_jumps(pieces: Pieces, order: int) -> tuple[Array, Array]:
    """Find the largest jump of a derivative of each joint where two pieces meet, and when; zero in a single piece."""
    if len(pieces.widths) == 1:
        n = pieces.scaled.shape[2]
        return np.zeros(n), np.full(n, pieces.starts[0])
    ends = pieces.on(np.array([0.0, 1.0]), order)
    jumps = np.abs(ends[0, 1:] - ends[1, :-1])
    where = jumps.argmax(axis=0)
    return jumps[where, np.arange(jumps.shape[1])], pieces.starts[1:][where]


def _powers(tau: Array, order: int, degree: int) -> Array:
    """Return d^order/dτ^order of 1, τ, τ², …; shape (…) → (…, degree + 1)."""
    powers = np.zeros((*tau.shape, degree + 1))
    power = np.ones_like(tau)
    for k in range(order, degree + 1):
        powers[..., k] = math.perm(k, order) * power
        power = power * tau
    return powers


def _bounds(values: Array, absolute: bool, factor: float) -> Array:
    """Bound the values of each piece from its samples, applying [Ehlich1964] around their middle; shape (M, n)."""
    low, high = values.min(axis=0), values.max(axis=0)
    middle, half = 0.5 * (low + high), 0.5 * factor * (high - low)
    bounds: Array = (np.abs(middle) if absolute else middle) + half
    return bounds


def _refine(
    part: Pieces,
    order: int,
    absolute: bool,
    nodes: Array,
    signed: Array,
    can_exceed: Flags,
    found: "_Largest",
    first: int,
) -> None:
    """Refine around each local maximum of the samples in pieces that may exceed the extremes found so far.

    The samples `signed` at `nodes` have shape (K, P, n), `can_exceed` (P, n); `first` is the number of the first piece.
    """
    piece, joint = np.nonzero(can_exceed)
    samples = signed[:, piece, joint]
    padded = np.pad(samples, ((1, 1), (0, 0)), constant_values=-np.inf)
    node, candidate = np.nonzero((samples >= padded[:-2]) & (samples >= padded[2:]))
    piece, joint = piece[candidate], joint[candidate]
    if len(piece) == 0:
        return

    def values_at(tau: Array) -> Array:
        values = part.joint_at(piece, joint, tau, order)
        return np.abs(values) if absolute else values

    near = np.clip(node, 1, len(nodes) - 2)[:, None] + np.arange(-1, 2)
    largest, where = highest(
        values_at, nodes[near], samples[near, candidate[:, None]], _ROUNDING * np.abs(found.best[joint])
    )
    found.take(largest, joint, piece + first, where)


@dataclass(slots=True)
class _Largest:
    """The largest value of each joint so far: the value, the piece and τ; shape (n,) each."""

    best: Array
    piece: Indices
    tau: Array

    def take_samples(self, signed: Array, nodes: Array, first: int) -> None:
        flat = signed.reshape(-1, signed.shape[2])
        where = flat.argmax(axis=0)
        joint = np.arange(len(where))
        node, piece = np.divmod(where, signed.shape[1])
        self.take(flat[where, joint], joint, piece + first, nodes[node])

    def take(self, values: Array, joint: Indices, piece: Indices, tau: Array) -> None:
        """Update with samples of some joints; an increase within rounding is ignored."""
        for i in np.argsort(values, kind="stable")[::-1]:
            j = joint[i]
            if self.best[j] == -np.inf or values[i] > self.best[j] + _ROUNDING * abs(self.best[j]):
                self.best[j], self.piece[j], self.tau[j] = values[i], piece[i], tau[i]
