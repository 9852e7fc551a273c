"""Ways through orientations by the Euler angles ZYZ, the course's alternative to one axis and an angle.

Each angle goes on its own, the axis is another at each moment. An orientation has two triples, (φ, θ, ψ) and
(φ + π, -θ, ψ + π), and so two ways lead from one to another: θ keeps its sign or changes it. The start is taken with
θ ≥ 0: from its other triple the same two ways lead through the same orientations.

Where θ = 0 only φ + ψ is determined, and where θ = π only φ - ψ: φ is then that of a neighbour.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, TypeAlias

import numpy as np

from gelenk.model.arrays import Array, Flags
from gelenk.model.notations import rotations_from_zyz, zyz_from_rotations
from gelenk.trajectory.orientation_paths import travelled
from gelenk.trajectory.polynomial import PiecewisePolynomial
from gelenk.trajectory.splines import cubic_spline

ZyzBranch: TypeAlias = Literal["regular", "flipped"]

_DEGENERATE = 1e-14
"""Sine of θ below which only φ + ψ or φ - ψ is determined."""


@dataclass(frozen=True, slots=True)
class ZyzPath:
    """φ, θ and ψ each at a rate of their own, constant in x.

    Attributes:
        start: (φ, θ, ψ) of R_i; shape (3,), [rad].
        change: To those of R_f; shape (3,), [rad].
        branch: Which of R_f's triples it leads to: `regular` where the sign of θ stays, `flipped` where it changes.
        degenerate: Of the two ends those at which only φ + ψ or φ - ψ is determined; there φ is that of the other end.
    """

    start: Array
    change: Array
    branch: ZyzBranch = "regular"
    degenerate: tuple[Literal["start", "end"], ...] = ()

    @property
    def breaks(self) -> tuple[float, ...]:
        """None."""
        return ()

    @property
    def angle(self) -> float:
        """See `OrientationPath`; by Gauss's formula."""
        return travelled(self)

    def triple_at(self, x: float) -> Array:
        """(φ, θ, ψ); shape (3,), [rad]."""
        triple: Array = self.start + x * self.change
        return triple

    def at(self, x: Array) -> tuple[Array, Array, Array]:
        """See `OrientationPath`."""
        still = np.zeros((len(x), 3))
        return _motion(self.start + x[:, None] * self.change, still + self.change, still)

    def part(self, begin: float, finish: float) -> "ZyzPath":
        """See `Turn`."""
        return ZyzPath(self.triple_at(begin), (finish - begin) * self.change, self.branch)


@dataclass(frozen=True, slots=True)
class ZyzCurve:
    """φ, θ and ψ as polynomials of x.

    Attributes:
        angles: Over x from 0 to 1, twice differentiable; 3 coordinates, [rad].
    """

    angles: PiecewisePolynomial

    @property
    def breaks(self) -> tuple[float, ...]:
        """None: the angular rate is continuous."""
        return ()

    @property
    def angle(self) -> float:
        """See `OrientationPath`."""
        return travelled(self, max(64, 8 * len(self.angles.coefficients)))

    def at(self, x: Array) -> tuple[Array, Array, Array]:
        """See `OrientationPath`."""
        return _motion(*self.angles.rates_at(x))


def zyz_paths(start: Array, end: Array) -> tuple[ZyzPath, ZyzPath]:
    """The two ways by ZYZ angles, to either triple of R_f; φ and ψ go the short way round.

    Args:
        start: R_i; shape (3, 3).
        end: R_f; shape (3, 3).
    """
    both = np.array([start, end])
    regular, flipped = zyz_turns(both, [False])[0], zyz_turns(both, [True])[0]
    return regular, flipped


def zyz_turns(rotations: Array, flips: Sequence[bool]) -> list[ZyzPath]:
    """The turns from each orientation to the next, each starting with the angles at which the one before ends.

    Args:
        rotations: Shape (M + 1, 3, 3).
        flips: On which of the M paths θ changes its sign.
    """
    triples = zyz_triples(rotations, flips)
    flat = _degenerate(rotations)
    names: tuple[Literal["start", "end"], ...] = ("start", "end")
    turns = []
    for i, flip in enumerate(flips):
        degenerate = tuple(name for name, is_flat in zip(names, flat[i : i + 2], strict=True) if is_flat)
        turns.append(ZyzPath(triples[i], triples[i + 1] - triples[i], "flipped" if flip else "regular", degenerate))
    return turns


def zyz_spline(rotations: Array, knots: Array, flips: Sequence[bool]) -> ZyzCurve:
    """The natural cubic spline of the angles: C², straight between two orientations.

    Args:
        rotations: At least two; shape (M + 1, 3, 3).
        knots: Where x is at each, increasing from 0 to 1; shape (M + 1,).
        flips: On which of the M paths θ changes its sign.
    """
    return ZyzCurve(cubic_spline(np.asarray(knots, dtype=float), zyz_triples(rotations, flips), "natural").motion)


def zyz_corner(entry: Array, corner: Array, leaving: Array) -> ZyzCurve:
    """The turn over a corner, a parabola in the angles: c + (1 - u)² (e - c) + u² (l - c).

    Its rates at both ends are those of the turns that it connects, as with the parabola of positions.

    Args:
        entry: e, the triple at A'; shape (3,), [rad].
        corner: c, that at B, which is not reached.
        leaving: l, that at C'.
    """
    a, b = entry - corner, leaving - corner
    return ZyzCurve(PiecewisePolynomial(np.array([0.0, 1.0]), np.array([[entry, -2.0 * a, a + b]])))


def zyz_triples(rotations: Array, flips: Sequence[bool]) -> Array:
    """Triples of orientations, φ and ψ going the short way from each to the next; shape (M + 1, 3), [rad].

    Args:
        rotations: Shape (M + 1, 3, 3).
        flips: On which of the M paths θ changes its sign.
    """
    triples = zyz_from_rotations(rotations)
    other = np.logical_xor.accumulate(np.array([False, *flips]))
    triples[other] = triples[other] * [1.0, -1.0, 1.0] + [math.pi, 0.0, math.pi]
    _settle(triples, _degenerate(rotations))
    for before, triple in pairwise(triples):
        for i in (0, 2):
            triple[i] = before[i] + math.remainder(triple[i] - before[i], 2.0 * math.pi)
    return triples


def _degenerate(rotations: Array) -> Flags:
    """Whether only φ + ψ or φ - ψ is determined; shape (N,)."""
    flat: Flags = np.hypot(rotations[:, 0, 2], rotations[:, 1, 2]) <= _DEGENERATE
    return flat


def _settle(triples: Array, flat: Flags) -> None:
    """Give degenerate triples the φ of the one before; those at the beginning that of the first that has one."""
    first = int(np.argmin(flat))
    for i in (*range(first - 1, -1, -1), *range(first + 1, len(triples))):
        if flat[i]:
            _move_phi(triples[i], triples[i + 1 if i < first else i - 1][0])


def _move_phi(triple: Array, phi: float) -> None:
    """Another φ of a degenerate triple: φ + ψ stays where θ = 0, φ - ψ where θ = π."""
    sign = 1.0 if math.cos(triple[1]) > 0.0 else -1.0
    triple[2] += sign * (triple[0] - phi)
    triple[0] = phi


def _motion(triples: Array, rates: Array, changes: Array) -> tuple[Array, Array, Array]:
    """R, ω_x and dω_x/dx of angles and their two derivatives; shape (N, 3) each → (N, 3, 3), (N, 3), (N, 3).

    ω = φ' z + θ' y' + ψ' z'' with y' = (-sin φ, cos φ, 0) and z'' the tip's z.
    """
    (c1, s1), (c2, s2) = ((np.cos(triples[:, i]), np.sin(triples[:, i])) for i in (0, 1))
    phi, theta, psi = rates.T[:, :, None]
    zero = np.zeros(len(triples))
    z = np.array([0.0, 0.0, 1.0])
    y, tip_z = np.column_stack((-s1, c1, zero)), np.column_stack((c1 * s2, s1 * s2, c2))
    y_rate = -phi * np.column_stack((c1, s1, zero))
    tip_z_rate = theta * np.column_stack((c1 * c2, s1 * c2, -s2)) + phi * np.column_stack((-s1 * s2, c1 * s2, zero))
    phi2, theta2, psi2 = changes.T[:, :, None]
    omegas = phi * z + theta * y + psi * tip_z
    alphas = phi2 * z + theta2 * y + psi2 * tip_z + theta * y_rate + psi * tip_z_rate
    return rotations_from_zyz(triples), omegas, alphas
