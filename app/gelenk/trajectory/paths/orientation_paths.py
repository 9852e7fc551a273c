"""Paths from one orientation to another, planned separately from the position; x runs from 0 to 1 along a path.

- Axis and angle, the default: R(x) = R_i Rot(r, x θ) with R_iᵀ R_f = Rot(r, θ), the shortest path, about one fixed
  axis. For θ = 0 the axis is undefined; for θ = π there are two axes, and both paths are equally short.
- ZYZ angles, the course's alternative: `zyz_paths`.
- Through several orientations: about one axis from each to the next, or as a smooth spline (`rotation_splines`).

The angular rate ω_x is the angular velocity in the base frame for dx/dt = 1; with a time law x(t), ω = ω_x ẋ.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, Protocol, TypeAlias

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.notations import rotations_from_vectors, vectors_from_rotations

Turning: TypeAlias = Literal["none", "regular", "half_turn"]

NO_TURN = 1e-14
"""Angle below which two orientations count as equal, [rad]: rounding alone can cause it, and its axis is undefined."""
HALF_TURN = 1e-9
"""Distance from π within which an angle counts as a half turn, which has two axes, [rad]."""
_INTERVALS = 64
"""Default number of integration intervals of `travelled`."""


class OrientationPath(Protocol):
    """A path through orientations."""

    @property
    def angle(self) -> float:
        """Angle travelled, ∫ ‖ω_x‖ dx, [rad]."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Values of x inside (0, 1) at which the angular rate jumps."""

    def at(self, x: Array) -> tuple[Array, Array, Array]:
        """Return R, ω_x and dω_x/dx at N values of x; shapes (N, 3, 3), (N, 3), (N, 3), [rad]."""


class Turn(OrientationPath, Protocol):
    """A path from one orientation to another at a constant rate of its angle or of its Euler angles."""

    def part(self, begin: float, finish: float) -> "Turn":
        """Return the part between two values of x as a turn of its own."""


@dataclass(frozen=True, slots=True)
class AxisAnglePath:
    """A turn about one axis, R(x) = R_i Rot(r, x θ).

    Attributes:
        start: R_i; shape (3, 3).
        axis: r, a unit vector in the frame R_i; zero if the orientation does not change; shape (3,).
        angle: θ, in [0, 2π], [rad].
        turning: Whether the axis is unique; it is not for `none` (θ = 0) and `half_turn` (θ = π).
    """

    start: Array
    axis: Array
    angle: float
    turning: Turning

    @property
    def breaks(self) -> tuple[float, ...]:
        """Always empty: the angular rate is constant."""
        return ()

    @property
    def base_axis(self) -> Array:
        """Axis in the base frame, the same throughout the turn; shape (3,)."""
        axis: Array = self.start @ self.axis
        return axis

    def at(self, x: Array) -> tuple[Array, Array, Array]:
        """See `OrientationPath`."""
        rotations = self.start @ rotations_from_vectors(x[:, None] * (self.angle * self.axis))
        still = np.zeros((len(x), 3))
        return rotations, still + self.angle * self.base_axis, still

    def part(self, begin: float, finish: float) -> "AxisAnglePath":
        """See `Turn`."""
        rotation = self.at(np.array([begin]))[0][0]
        return AxisAnglePath(rotation, self.axis, (finish - begin) * self.angle, self.turning)


def axis_angle(start: Array, end: Array) -> AxisAnglePath:
    """Return the shortest path about one axis; of two equally short ones, the first of `both_ways`."""
    return both_ways(start, end)[0]


def both_ways(start: Array, end: Array) -> tuple[AxisAnglePath, ...]:
    """Return both paths about one axis, the shorter first: about r by θ, and about -r by 2π - θ; only one if θ = 0.

    At θ = π, within `HALF_TURN`, both are equally short. The first is then the one whose axis has a positive first
    nonzero component, so that the order does not depend on rounding.

    Args:
        start: R_i; shape (3, 3).
        end: R_f; shape (3, 3).
    """
    vector = vectors_from_rotations((start.T @ end)[None])[0]
    angle = math.hypot(*vector)
    if angle < NO_TURN:
        return (AxisAnglePath(start, np.zeros(3), 0.0, "none"),)
    axis = vector / angle
    half = angle > math.pi - HALF_TURN
    turning: Turning = "half_turn" if half else "regular"
    ways = AxisAnglePath(start, axis, angle, turning), AxisAnglePath(start, -axis, 2.0 * math.pi - angle, turning)
    first = next(component for component in axis if abs(component) > 1e-6)
    return ways[::-1] if half and first < 0.0 else ways


@dataclass(frozen=True, slots=True)
class Through:
    """Turns about one axis from each orientation to the next; the angular rate jumps at the inner orientations.

    Attributes:
        knots: Values of x at the orientations, from 0 to 1; shape (M + 1,).
        ways: The M turns.
    """

    knots: Array
    ways: tuple[AxisAnglePath, ...]

    @property
    def angle(self) -> float:
        """Sum of the angles of all turns, [rad]."""
        return sum(way.angle for way in self.ways)

    @property
    def breaks(self) -> tuple[float, ...]:
        """The inner knots."""
        return tuple(self.knots[1:-1].tolist())

    def at(self, x: Array) -> tuple[Array, Array, Array]:
        """See `OrientationPath`; at a knot, the later turn counts."""
        rotations, rates = np.empty((len(x), 3, 3)), np.empty((len(x), 3))
        part = np.clip(np.searchsorted(self.knots, x, side="right") - 1, 0, len(self.ways) - 1)
        for i, way in enumerate(self.ways):
            rows = part == i
            width = self.knots[i + 1] - self.knots[i]
            rotations[rows], omegas, _ = way.at((x[rows] - self.knots[i]) / width)
            rates[rows] = omegas / width
        return rotations, rates, np.zeros_like(rates)


def through(rotations: Array, knots: Sequence[float] | Array) -> Through:
    """Join the shortest turns about one axis from each orientation to the next.

    Args:
        rotations: Orientations; shape (M + 1, 3, 3).
        knots: Values of x at the orientations, increasing from 0 to 1; shape (M + 1,).
    """
    ends = pairwise(rotations)
    return Through(np.asarray(knots, dtype=float), tuple(axis_angle(first, last) for first, last in ends))


def travelled(path: OrientationPath, intervals: int = _INTERVALS) -> float:
    """Compute the angle travelled, ∫ ‖ω_x‖ dx, by Gauss quadrature, [rad]."""
    nodes, weights = np.polynomial.legendre.leggauss(8)
    edges = np.arange(intervals)[:, None]
    x = ((edges + 0.5 * (nodes + 1.0)) / intervals).ravel()
    speeds = np.linalg.norm(path.at(x)[1], axis=1).reshape(intervals, -1)
    return float((speeds @ weights).sum() / (2.0 * intervals))
