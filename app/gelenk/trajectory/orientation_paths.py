"""Ways from one orientation to another, planned apart from the position: x from 0 to 1 leads along the whole of it.

- Axis and angle, the default: R(x) = R_i Rot(r, x θ) with R_iᵀ R_f = Rot(r, θ), one axis throughout and the shortest
  way. At θ = 0 there is no axis; at θ = π there are two, and both paths are equally short.
- ZYZ angles, the course's alternative: `zyz_paths`.
- Through several orientations: by axis and angle from each to the next, or as a smooth spline (`rotation_splines`).

Angular rates are those of ω along the base's axes for dx/dt = 1; with a time law x(t), ω = ω_x ẋ.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, Protocol, TypeAlias

import numpy as np

from gelenk.model.arrays import Array
from gelenk.model.notations import rotations_from_vectors, vectors_from_rotations

Turning: TypeAlias = Literal["none", "regular", "half_turn"]

NO_TURN = 1e-14
"""Angle below which two orientations are the same: it has no axis, and rounding leaves as much, [rad]."""
HALF_TURN = 1e-9
"""How close to π an angle has two axes, [rad]."""
_INTERVALS = 64
"""Of the integral of the angle travelled."""


class OrientationPath(Protocol):
    """A path through orientations."""

    @property
    def angle(self) -> float:
        """The angle travelled, ∫ ‖ω_x‖ dx, [rad]."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Where inside of (0, 1) the angular rate jumps."""

    def at(self, x: Array) -> tuple[Array, Array, Array]:
        """R, ω_x and dω_x/dx, [rad]; shape (N,) → (N, 3, 3), (N, 3), (N, 3)."""


class Turn(OrientationPath, Protocol):
    """A path from one orientation to another at a constant rate."""

    def part(self, begin: float, finish: float) -> "Turn":
        """What is between two values of x."""


@dataclass(frozen=True, slots=True)
class AxisAngle:
    """R(x) = R_i Rot(r, x θ).

    Attributes:
        start: R_i; shape (3, 3).
        axis: r, a unit vector in the frame R_i; zero where there is no turn; shape (3,).
        angle: θ, in [0, 2π], [rad].
        turning: Whether the axis is determined.
    """

    start: Array
    axis: Array
    angle: float
    turning: Turning

    @property
    def breaks(self) -> tuple[float, ...]:
        """None."""
        return ()

    @property
    def base_axis(self) -> Array:
        """The axis along the base's axes, the same at both ends; shape (3,)."""
        axis: Array = self.start @ self.axis
        return axis

    def at(self, x: Array) -> tuple[Array, Array, Array]:
        """See `OrientationPath`."""
        rotations = self.start @ rotations_from_vectors(x[:, None] * (self.angle * self.axis))
        still = np.zeros((len(x), 3))
        return rotations, still + self.angle * self.base_axis, still

    def part(self, begin: float, finish: float) -> "AxisAngle":
        """See `Turn`."""
        rotation = self.at(np.array([begin]))[0][0]
        return AxisAngle(rotation, self.axis, (finish - begin) * self.angle, self.turning)


def axis_angle(start: Array, end: Array) -> AxisAngle:
    """The shortest path about one axis; of two that are equally short, the one of `both_ways` that comes first."""
    return both_ways(start, end)[0]


def both_ways(start: Array, end: Array) -> tuple[AxisAngle, ...]:
    """Both paths about one axis, the shorter first: about r by θ, and about -r by 2π - θ; one alone where θ = 0.

    At θ = π, within `HALF_TURN`, they are equally short; first comes the one whose axis has a first component that is
    positive (that is not zero), whatever rounding makes of the angle.

    Args:
        start: R_i; shape (3, 3).
        end: R_f; shape (3, 3).
    """
    vector = vectors_from_rotations((start.T @ end)[None])[0]
    angle = math.hypot(*vector)
    if angle < NO_TURN:
        return (AxisAngle(start, np.zeros(3), 0.0, "none"),)
    axis = vector / angle
    half = angle > math.pi - HALF_TURN
    turning: Turning = "half_turn" if half else "regular"
    ways = AxisAngle(start, axis, angle, turning), AxisAngle(start, -axis, 2.0 * math.pi - angle, turning)
    first = next(component for component in axis if abs(component) > 1e-6)
    return ways[::-1] if half and first < 0.0 else ways


@dataclass(frozen=True, slots=True)
class Through:
    """From each orientation to the next about one axis; the angular rate jumps at those between.

    Attributes:
        knots: Values of x, from 0 to 1; shape (M + 1,).
        ways: M of them.
    """

    knots: Array
    ways: tuple[AxisAngle, ...]

    @property
    def angle(self) -> float:
        """The sum of all, [rad]."""
        return sum(way.angle for way in self.ways)

    @property
    def breaks(self) -> tuple[float, ...]:
        """All knots between the ends."""
        return tuple(self.knots[1:-1].tolist())

    def at(self, x: Array) -> tuple[Array, Array, Array]:
        """See `OrientationPath`; at a knot the later path counts."""
        rotations, rates = np.empty((len(x), 3, 3)), np.empty((len(x), 3))
        part = np.clip(np.searchsorted(self.knots, x, side="right") - 1, 0, len(self.ways) - 1)
        for i, way in enumerate(self.ways):
            rows = part == i
            width = self.knots[i + 1] - self.knots[i]
            rotations[rows], omegas, _ = way.at((x[rows] - self.knots[i]) / width)
            rates[rows] = omegas / width
        return rotations, rates, np.zeros_like(rates)


def through(rotations: Array, knots: Sequence[float] | Array) -> Through:
    """The shortest paths from each orientation to the next.

    Args:
        rotations: Shape (M + 1, 3, 3).
        knots: Where x is at each, increasing from 0 to 1; shape (M + 1,).
    """
    ends = pairwise(rotations)
    return Through(np.asarray(knots, dtype=float), tuple(axis_angle(first, last) for first, last in ends))


def travelled(path: OrientationPath, intervals: int = _INTERVALS) -> float:
    """∫ ‖ω_x‖ dx, [rad]."""
    nodes, weights = np.polynomial.legendre.leggauss(8)
    edges = np.arange(intervals)[:, None]
    x = ((edges + 0.5 * (nodes + 1.0)) / intervals).ravel()
    speeds = np.linalg.norm(path.at(x)[1], axis=1).reshape(intervals, -1)
    return float((speeds @ weights).sum() / (2.0 * intervals))
