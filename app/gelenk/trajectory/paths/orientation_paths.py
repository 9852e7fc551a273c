"""Paths from one orientation to another, planned separately from the position; x runs from 0 to 1 along a path.

- Axis and angle, the default: R(x) = R_i Rot(r, x θ) with R_iᵀ R_f = Rot(r, θ), the shortest path, about one fixed
  axis. For θ = 0 the axis is undefined; for θ = π there are two axes, and both paths are equally short.
- ZYZ angles, the course's alternative: `zyz_paths`. Through several orientations: `rotation_splines`.

The angular rate ω_x is the angular velocity in the base frame for dx/dt = 1; with a time law x(t), ω = ω_x ẋ.
"""

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.notations import vectors_from_rotations
from gelenk.trajectory.paths.sampling import about_axis

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

    def at(self, x: Array) -> tuple[Array, Array, Array]:
        """Return R, ω_x and dω_x/dx at N values of x; shapes (N, 3, 3), (N, 3), (N, 3), [rad]."""


@dataclass(frozen=True, slots=True)
class AxisAnglePath:
    """A turn about one axis, R(x) = R_i Rot(r, x θ).

    Attributes:
        start: R_i; shape (3, 3).
        axis: r, a unit vector in the frame R_i; zero if the orientation does not change; shape (3,).
        angle: θ, in [0, π], [rad].
    """

    start: Array
    axis: Array
    angle: float

    def at(self, x: Array) -> tuple[Array, Array, Array]:
        """See `OrientationPath`."""
        return about_axis(*self.as_vector, x)

    @property
    def as_vector(self) -> tuple[Array, Array]:
        """R_i and θ r, as kernels take them."""
        return np.ascontiguousarray(self.start), self.angle * self.axis


def axis_angle(start: Array, end: Array) -> AxisAnglePath:
    """Return the shortest path about one axis from R_i to R_f; shape (3, 3) each.

    Of the two paths at θ = π, within `HALF_TURN`, this is the one whose axis has a positive first nonzero component, so
    that the choice does not depend on rounding.
    """
    vector = vectors_from_rotations((start.T @ end)[None])[0]
    angle = math.hypot(*vector)
    if angle < NO_TURN:
        return AxisAnglePath(start, np.zeros(3), 0.0)
    axis = vector / angle
    if angle > math.pi - HALF_TURN and next(part for part in axis if abs(part) > 1e-6) < 0.0:
        return AxisAnglePath(start, -axis, 2.0 * math.pi - angle)
    return AxisAnglePath(start, axis, angle)


def travelled(path: OrientationPath, intervals: int = _INTERVALS) -> float:
    """Compute the angle travelled, ∫ ‖ω_x‖ dx, by Gauss quadrature, [rad]."""
    nodes, weights = np.polynomial.legendre.leggauss(8)
    edges = np.arange(intervals)[:, None]
    x = ((edges + 0.5 * (nodes + 1.0)) / intervals).ravel()
    speeds = np.linalg.norm(path.at(x)[1], axis=1).reshape(intervals, -1)
    return float((speeds @ weights).sum() / (2.0 * intervals))
