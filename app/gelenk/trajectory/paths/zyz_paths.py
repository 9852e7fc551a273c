"""Paths through orientations by ZYZ Euler angles, the course's alternative to axis and angle.

Each angle changes independently, so the axis of rotation varies. An orientation has two triples, (φ, θ, ψ) and
(φ + π, -θ, ψ + π), so two paths lead from one to another: θ keeps its sign or changes it. The start is taken with
θ ≥ 0; from its other triple, the same two paths lead through the same orientations.

If θ = 0 only φ + ψ is determined, and if θ = π only φ - ψ; φ is then taken from an adjacent orientation.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from gelenk.robot.arrays import Array, Flags
from gelenk.robot.notations import rotations_from_zyz, zyz_from_rotations
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import cubic_spline
from gelenk.trajectory.paths.orientation_paths import travelled

_DEGENERATE = 1e-14
"""Sine of θ up to which only φ + ψ or φ - ψ counts as determined."""


@dataclass(frozen=True, slots=True)
class ZyzPath:
    """A path on which φ, θ and ψ, [rad], are twice differentiable piecewise polynomials of x, from 0 to 1."""

    angles: PiecewisePolynomial

    @property
    def angle(self) -> float:
        """See `OrientationPath`."""
        return travelled(self, max(64, 8 * len(self.angles.coefficients)))

    def triple_at(self, x: float) -> Array:
        """Return (φ, θ, ψ) at x; shape (3,), [rad]."""
        triple: Array = self.angles.at(np.array([x]))[0]
        return triple

    def at(self, x: Array) -> tuple[Array, Array, Array]:
        """See `OrientationPath`."""
        return _motion(*self.angles.rates_at(x))


def zyz_turns(rotations: Array, flips: Sequence[bool]) -> list[ZyzPath]:
    """Return the turns from each orientation to the next, each starting with the angles at which the previous one ends.

    The rotations have the shape (M + 1, 3, 3); `flips` tells for each of the M turns whether θ changes its sign.
    """
    return [_polynomial(first, last - first) for first, last in pairwise(zyz_triples(rotations, flips))]


def zyz_spline(rotations: Array, knots: Array, flips: Sequence[bool]) -> ZyzPath:
    """Return the natural cubic spline of the angles: C², and linear if there are only two orientations.

    Rotations and flips are those of `zyz_turns`, at x = `knots`, (M + 1,), increasing from 0 to 1.
    """
    return ZyzPath(cubic_spline(np.asarray(knots, dtype=float), zyz_triples(rotations, flips), "natural").motion)


def zyz_triples(rotations: Array, flips: Sequence[bool]) -> Array:
    """Return triples of orientations; φ and ψ change by at most π from each to the next; shape (M + 1, 3), [rad].

    Rotations and flips are those of `zyz_turns`.
    """
    triples = zyz_from_rotations(rotations)
    other = np.logical_xor.accumulate(np.array([False, *flips]))
    triples[other] = triples[other] * [1.0, -1.0, 1.0] + [math.pi, 0.0, math.pi]
    _settle(triples, np.hypot(rotations[:, 0, 2], rotations[:, 1, 2]) <= _DEGENERATE)
    for before, triple in pairwise(triples):
        for i in (0, 2):
            triple[i] = before[i] + math.remainder(triple[i] - before[i], 2.0 * math.pi)
    return triples


def _polynomial(*coefficients: Array) -> ZyzPath:
    return ZyzPath(PiecewisePolynomial(np.array([0.0, 1.0]), np.array([coefficients])))


def _settle(triples: Array, flat: Flags) -> None:
    """Give degenerate triples the φ of the previous one; those at the start get the first φ that is determined."""
    first = int(np.argmin(flat))
    for i in (*range(first - 1, -1, -1), *range(first + 1, len(triples))):
        if flat[i]:
            phi, triple = triples[i + 1 if i < first else i - 1][0], triples[i]
            # φ + ψ stays if θ = 0, φ - ψ if θ = π.
            triple[2] += math.copysign(1.0, math.cos(triple[1])) * (triple[0] - phi)
            triple[0] = phi


def _motion(triples: Array, rates: Array, changes: Array) -> tuple[Array, Array, Array]:
    """Return R, ω_x and dω_x/dx from angles and two derivatives; shape (N, 3) each → (N, 3, 3), (N, 3), (N, 3).

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
