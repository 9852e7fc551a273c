"""Compiled conversions between rotation matrices and quaternions, RPY, ZYZ and rotation vectors.

All conversions work on batches: rotations are (N, 3, 3), positions (N, 3). Angles are in radians. Conventions:

- `rpy` (roll, pitch, yaw) is URDF's: fixed axes x, y, z, so R = Rz(yaw) Ry(pitch) Rx(roll); pitch in [-π/2, π/2].
- `zyz` (φ, θ, ψ) is the course's: R = Rz(φ) Ry(θ) Rz(ψ); θ in [0, π], the branch with sin θ ≥ 0.
- The name of a quaternion gives the order of its parts; the scalar part is never negative.
- A rotation vector is axis times angle, with the angle in [0, π].

Where a triple degenerates (pitch = ±π/2, θ = 0 or π), only a sum or a difference of the outer angles is determined: yaw
= 0 or ψ = 0 is chosen, and roll or φ takes it all.
"""

import math
from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.description import Origin
from gelenk.robot.poses import transform

_Function = TypeVar("_Function", bound=Callable[..., Any])
try:
    from gelenk.robot.compilation import compiled
except ModuleNotFoundError:  # without numba, as in a client that converts a few poses: plain Python

    def compiled(function: _Function) -> _Function:
        """Return the function unchanged."""
        return function


_DEGENERATE = 1e-14
"""Sine or cosine below which an Euler triple counts as degenerate, at an error of that size; rounding is 1e-16."""


@compiled
def rotations_from_rpy(rpy: Array) -> Array:
    """Return Rz(yaw) Ry(pitch) Rx(roll) for each (roll, pitch, yaw), [rad]; shape (N, 3) → (N, 3, 3)."""
    Rs = np.empty((len(rpy), 3, 3))
    for i in range(len(rpy)):
        cr, sr = math.cos(rpy[i, 0]), math.sin(rpy[i, 0])
        cp, sp = math.cos(rpy[i, 1]), math.sin(rpy[i, 1])
        cy, sy = math.cos(rpy[i, 2]), math.sin(rpy[i, 2])
        Rs[i, 0, 0], Rs[i, 0, 1], Rs[i, 0, 2] = cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr
        Rs[i, 1, 0], Rs[i, 1, 1], Rs[i, 1, 2] = sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr
        Rs[i, 2, 0], Rs[i, 2, 1], Rs[i, 2, 2] = -sp, cp * sr, cp * cr
    return Rs


@compiled
def rpy_from_rotations(Rs: Array) -> Array:
    """Return (roll, pitch, yaw) of each rotation, [rad]; shape (N, 3, 3) → (N, 3).

    Pitch and roll are computed after undoing yaw, so that an ill-determined yaw near pitch = ±π/2 does not spoil the
    product: everywhere, the triple reproduces the rotation to rounding.
    """
    rpy = np.empty((len(Rs), 3))
    for i in range(len(Rs)):
        R = Rs[i]
        yaw = 0.0
        if math.hypot(R[0, 0], R[1, 0]) > _DEGENERATE:
            yaw = math.atan2(R[1, 0], R[0, 0])
        cy, sy = math.cos(yaw), math.sin(yaw)
        rpy[i, 0] = math.atan2(sy * R[0, 2] - cy * R[1, 2], cy * R[1, 1] - sy * R[0, 1])
        rpy[i, 1] = math.atan2(-R[2, 0], cy * R[0, 0] + sy * R[1, 0])
        rpy[i, 2] = yaw
    return rpy


@compiled
def rotations_from_zyz(zyz: Array) -> Array:
    """Return Rz(φ) Ry(θ) Rz(ψ) for each (φ, θ, ψ), [rad]; shape (N, 3) → (N, 3, 3)."""
    Rs = np.empty((len(zyz), 3, 3))
    for i in range(len(zyz)):
        c1, s1 = math.cos(zyz[i, 0]), math.sin(zyz[i, 0])
        c2, s2 = math.cos(zyz[i, 1]), math.sin(zyz[i, 1])
        c3, s3 = math.cos(zyz[i, 2]), math.sin(zyz[i, 2])
        Rs[i, 0, 0], Rs[i, 0, 1], Rs[i, 0, 2] = c1 * c2 * c3 - s1 * s3, -c1 * c2 * s3 - s1 * c3, c1 * s2
        Rs[i, 1, 0], Rs[i, 1, 1], Rs[i, 1, 2] = s1 * c2 * c3 + c1 * s3, -s1 * c2 * s3 + c1 * c3, s1 * s2
        Rs[i, 2, 0], Rs[i, 2, 1], Rs[i, 2, 2] = -s2 * c3, s2 * s3, c2
    return Rs


@compiled
def zyz_from_rotations(Rs: Array) -> Array:
    """Return (φ, θ, ψ) of each rotation, [rad], later angles after undoing the first; shape (N, 3, 3) → (N, 3)."""
    zyz = np.empty((len(Rs), 3))
    for i in range(len(Rs)):
        R = Rs[i]
        if math.hypot(R[0, 2], R[1, 2]) > _DEGENERATE:
            phi = math.atan2(R[1, 2], R[0, 2])
        elif R[2, 2] > 0.0:
            phi = math.atan2(R[1, 0], R[0, 0])
        else:
            phi = math.atan2(-R[1, 0], -R[0, 0])
        c1, s1 = math.cos(phi), math.sin(phi)
        zyz[i, 0] = phi
        zyz[i, 1] = abs(math.atan2(c1 * R[0, 2] + s1 * R[1, 2], R[2, 2]))
        zyz[i, 2] = math.atan2(c1 * R[1, 0] - s1 * R[0, 0], c1 * R[1, 1] - s1 * R[0, 1])
    return zyz


@compiled
def rotations_from_quaternions_xyzw(quaternions: Array) -> Array:
    """Return the rotation of each unit quaternion (x, y, z, w); shape (N, 4) → (N, 3, 3)."""
    Rs = np.empty((len(quaternions), 3, 3))
    turn_by_quaternions_xyzw(quaternions, Rs)
    return Rs


@compiled
def turn_by_quaternions_xyzw(quaternions: Array, Rs: Array) -> None:
    """Fill in what `rotations_from_quaternions_xyzw` returns: Python calls this in half the time."""
    for i in range(len(quaternions)):
        x, y, z, w = quaternions[i, 0], quaternions[i, 1], quaternions[i, 2], quaternions[i, 3]
        Rs[i, 0, 0], Rs[i, 0, 1], Rs[i, 0, 2] = (
            1 - 2 * (y * y + z * z),
            2 * (x * y - z * w),
            2 * (x * z + y * w),
        )
        Rs[i, 1, 0], Rs[i, 1, 1], Rs[i, 1, 2] = (
            2 * (x * y + z * w),
            1 - 2 * (x * x + z * z),
            2 * (y * z - x * w),
        )
        Rs[i, 2, 0], Rs[i, 2, 1], Rs[i, 2, 2] = (
            2 * (x * z - y * w),
            2 * (y * z + x * w),
            1 - 2 * (x * x + y * y),
        )


@compiled
def quaternions_xyzw_from_rotations(Rs: Array) -> Array:
    """Return the unit quaternion (x, y, z, w), w ≥ 0, of each rotation; shape (N, 3, 3) → (N, 4).

    The largest of the four components is computed from the diagonal and divides the others [Shepperd1978].
    """
    quaternions = np.empty((len(Rs), 4))
    for i in range(len(Rs)):
        R = Rs[i]
        trace = R[0, 0] + R[1, 1] + R[2, 2]
        if trace >= R[0, 0] and trace >= R[1, 1] and trace >= R[2, 2]:
            x, y, z, w = R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1], 1 + trace
        elif R[0, 0] >= R[1, 1] and R[0, 0] >= R[2, 2]:
            x, y, z, w = 1 + 2 * R[0, 0] - trace, R[0, 1] + R[1, 0], R[0, 2] + R[2, 0], R[2, 1] - R[1, 2]
        elif R[1, 1] >= R[2, 2]:
            x, y, z, w = R[0, 1] + R[1, 0], 1 + 2 * R[1, 1] - trace, R[1, 2] + R[2, 1], R[0, 2] - R[2, 0]
        else:
            x, y, z, w = R[0, 2] + R[2, 0], R[1, 2] + R[2, 1], 1 + 2 * R[2, 2] - trace, R[1, 0] - R[0, 1]
        scale = math.copysign(1.0 / math.sqrt(x * x + y * y + z * z + w * w), w)
        quaternions[i, 0], quaternions[i, 1] = x * scale, y * scale
        quaternions[i, 2], quaternions[i, 3] = z * scale, w * scale
    return quaternions


@compiled
def rotations_from_vectors(vectors: Array) -> Array:
    """Return the rotation of each rotation vector, [rad]; shape (N, 3) → (N, 3, 3)."""
    quaternions = np.empty((len(vectors), 4))
    for i in range(len(vectors)):
        angle = math.sqrt(vectors[i, 0] ** 2 + vectors[i, 1] ** 2 + vectors[i, 2] ** 2)
        scale = math.sin(0.5 * angle) / angle if angle > 1e-12 else 0.5
        for k in range(3):
            quaternions[i, k] = scale * vectors[i, k]
        quaternions[i, 3] = math.cos(0.5 * angle)
    return rotations_from_quaternions_xyzw(quaternions)


@compiled
def vectors_from_rotations(Rs: Array) -> Array:
    """Return the rotation vector of each rotation, [rad]; shape (N, 3, 3) → (N, 3)."""
    vectors = np.empty((len(Rs), 3))
    quaternions = quaternions_xyzw_from_rotations(Rs)
    for i in range(len(Rs)):
        x, y, z, w = quaternions[i, 0], quaternions[i, 1], quaternions[i, 2], quaternions[i, 3]
        sine = math.sqrt(x * x + y * y + z * z)
        scale = 2.0 * math.atan2(sine, w) / sine if sine > 1e-12 else 2.0
        vectors[i, 0], vectors[i, 1], vectors[i, 2] = scale * x, scale * y, scale * z
    return vectors


def placement(xyz: tuple[float, float, float], rpy: tuple[float, float, float]) -> Array:
    """Return the homogeneous transform of a URDF origin, [m] and [rad]; shape (4, 4)."""
    return transform(np.array(xyz), rotations_from_rpy(np.array([rpy]))[0])


@compiled
def pose_errors(
    positions: Array, rotations: Array, other_positions: Array, other_rotations: Array
) -> tuple[float, float, float]:
    """Return the largest distance [m] and angle [rad] between paired poses, and the largest other coordinate [m].

    The angle comes from the Frobenius norm of the difference of the rotations, which stays accurate near zero. A NaN in
    a pose makes distance and angle NaN.
    """
    distance, angle, extent = 0.0, 0.0, 0.0
    for i in range(len(positions)):
        square, difference = 0.0, 0.0
        for j in range(3):
            square += (positions[i, j] - other_positions[i, j]) ** 2
            extent = max(extent, abs(other_positions[i, j]))
            for k in range(3):
                difference += (rotations[i, j, k] - other_rotations[i, j, k]) ** 2
        if math.isnan(square) or math.isnan(difference):
            return math.nan, math.nan, extent
        distance = max(distance, math.sqrt(square))
        angle = max(angle, 2.0 * math.asin(min(1.0, math.sqrt(difference / 8.0))))
    return distance, angle, extent


def origin_of(T: Array) -> Origin:
    """Return a homogeneous transform (4, 4) as a URDF origin; its angles reproduce the rotation to rounding."""
    # Adding zero turns -0.0 into 0.0, which reads better.
    x, y, z = (float(value) + 0.0 for value in T[:3, 3])
    roll, pitch, yaw = (float(value) + 0.0 for value in rpy_from_rotations(np.ascontiguousarray(T[None, :3, :3]))[0])
    return Origin((x, y, z), (roll, pitch, yaw))
