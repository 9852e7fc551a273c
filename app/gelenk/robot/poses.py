"""SO(3) and SE(3) as matrices: checks of rotations, and transforms; `notations` has the other notations."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.errors import InvalidPose
from gelenk.robot.arrays import Array

ROTATION_TOLERANCE = 1e-6
"""Largest deviation from SO(3) accepted in an orientation from outside, which is then projected."""

_ROTATION_ROUNDING = 5e-15
"""Largest distance from SO(3) of a product of a few rotations; such a matrix is used unchanged."""


@dataclass(slots=True)  # not frozen: each request makes some, and freezing triples their cost
class Poses:
    """A batch of poses T_a_b: origins of b in a, (N, 3) in [m], and axes of b in a as columns, (N, 3, 3)."""

    positions: Array
    rotations: Array

    def __len__(self) -> int:
        return len(self.positions)

    def matrices(self) -> Array:
        """Return the poses as homogeneous transforms; shape (N, 4, 4)."""
        Ts = np.zeros((len(self), 4, 4))
        Ts[:, :3, :3] = self.rotations
        Ts[:, :3, 3] = self.positions
        Ts[:, 3, 3] = 1.0
        return Ts


def nearest_rotation(matrix: Array) -> Array:
    """Return the rotation nearest to a matrix that is nearly a rotation; shape (3, 3) → (3, 3).

    A matrix that differs from a rotation by rounding alone is returned unchanged, so a client gets back what it sent.
    One further than `ROTATION_TOLERANCE` (Frobenius norm) from every rotation raises InvalidPose.
    """
    if _is_rotation(*matrix.tolist()):
        return np.ascontiguousarray(matrix)
    U, stretches, Vt = np.linalg.svd(matrix)
    handedness = np.linalg.det(U @ Vt)
    R = U @ np.diag([1.0, 1.0, handedness]) @ Vt
    distance = math.hypot(*(matrix - R).ravel())
    if distance > ROTATION_TOLERANCE:
        kind = (
            "a reflection (determinant -1), not a rotation"
            if handedness < 0.0 and np.abs(stretches - 1.0).max() < ROTATION_TOLERANCE
            else "not a rotation (RᵀR ≠ I)"
        )
        raise InvalidPose(
            f"the matrix is {kind}; the limit is a distance of {ROTATION_TOLERANCE:g} from SO(3)", _finite(distance)
        )
    return np.ascontiguousarray(R if distance > _ROTATION_ROUNDING else matrix)


def _is_rotation(x: list[float], y: list[float], z: list[float]) -> bool:
    """Return whether a matrix of these rows surely differs from a rotation by rounding alone.

    Stretches s have |s - 1| ≤ |s² - 1|: so its RRᵀ - I is at least as large as its distance from the nearest one.
    Numbers of Python take a tenth of the time of a decomposition.
    """
    (a, b, c), (d, e, f), (g, h, i) = x, y, z
    squares = a * a + b * b + c * c - 1.0, d * d + e * e + f * f - 1.0, g * g + h * h + i * i - 1.0
    products = a * d + b * e + c * f, a * g + b * h + c * i, d * g + e * h + f * i
    is_right_handed = a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g) > 0.0
    return is_right_handed and math.hypot(*squares, *products, *products) <= _ROTATION_ROUNDING


def unit_quaternion(quaternion: Sequence[float]) -> list[float]:
    """Normalise a quaternion, in any order; raises InvalidPose if |length - 1| > `ROTATION_TOLERANCE`."""
    length = math.hypot(*quaternion)
    if abs(length - 1.0) > ROTATION_TOLERANCE:
        raise InvalidPose(
            f"the quaternion has length {length:.9g}; allowed: 1 ± {ROTATION_TOLERANCE:g}",
            _finite(abs(length - 1.0)),
        )
    return [part / length for part in quaternion]


def _finite(distance: float) -> float | None:
    return distance if math.isfinite(distance) else None


def transform(position: Array, rotation: Array) -> Array:
    """Return the homogeneous transform (4, 4) of a position (3,) and a rotation (3, 3)."""
    T = np.eye(4)
    T[:3, :3] = rotation
    T[:3, 3] = position
    return T


def inverse(T_a_b: Array) -> Array:
    """Return T_b_a of T_a_b; shape (4, 4)."""
    R = T_a_b[:3, :3]
    return transform(-R.T @ T_a_b[:3, 3], R.T)
