"""Rotations of the course, about an axis or a coordinate axis, and how far a matrix is from a rotation; composition.

Frames are composed as R_0_2 = R_0_1 R_1_2, about moving or fixed axes. T_a_b maps coordinates from b to a, and its
position is its last *column* (the notes once say row). A further motion about the moving axes multiplies from the
right, one about the fixed axes from the left. The inverse is Rᵀ with -Rᵀp.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.errors import InvalidField, certify
from gelenk.robot.arrays import Array
from gelenk.robot.poses import ROTATION_TOLERANCE, inverse
from gelenk.robot.result import Result

AxisName: TypeAlias = Literal["x", "y", "z"]
DEGENERATE = 1e-14
"""Sine or cosine below which a notation counts as degenerate, at an error of that size; rounding is some 1e-16."""


@dataclass(frozen=True, slots=True)
class Validation(Result):
    """Distance of a given matrix from a rotation.

    Attributes:
        orthogonality_error: ‖RᵀR - I‖ (Frobenius), no unit.
        determinant: Of the matrix; +1 of a rotation, no unit.
        distance: ‖R - nearest rotation‖ (Frobenius), no unit.
        is_reflection: Whether the determinant is negative.
        is_unique: Whether one rotation is nearer than all others; not so of a pure reflection.
        projected: Whether the nearest rotation was taken for a matrix further than 1e-6 from it.
    """

    orthogonality_error: float
    determinant: float
    distance: float
    is_reflection: bool
    is_unique: bool
    projected: bool


def unit_axis(direction: Sequence[float], field: str) -> Array:
    """Return the unit vector (3,) along a direction of any length; raises InvalidField if it is zero."""
    given = np.array(direction)
    largest = float(np.abs(given).max())
    if largest == 0.0:
        raise InvalidField(field, "an axis has a direction: not all of its numbers are 0")
    scaled = given / largest
    unit: Array = scaled / np.linalg.norm(scaled)
    return unit


def elementary(axis: AxisName, angle: float) -> Array:
    """Return Rx, Ry or Rz of an angle [rad], counter-clockwise; shape (3, 3). Only Ry has its minus sign below."""
    c, s = math.cos(angle), math.sin(angle)
    if axis == "x":
        return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    if axis == "y":
        return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def about_axis(axis: Array, angle: float) -> Array:
    """Return Rodrigues' R = I + sin θ [r]× + (1 - cos θ) [r]×² about a unit axis r (3,), θ in [rad]; shape (3, 3)."""
    x, y, z = axis.tolist()
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    # 1 - cos θ loses digits near 0, 2 sin²(θ/2) does not.
    R: Array = np.eye(3) + math.sin(angle) * K + 2.0 * math.sin(0.5 * angle) ** 2 * K @ K
    return R


def validated(matrix: Array) -> tuple[Validation, Array]:
    """Return how far a matrix (3, 3) is from the nearest rotation, U diag(1, 1, det UVᵀ) Vᵀ [Umeyama1991], and that."""
    U, sigma, Vt = np.linalg.svd(matrix)
    sign = round(float(np.linalg.det(U @ Vt)))
    R = U @ np.diag([1.0, 1.0, float(sign)]) @ Vt
    # Turning about the axis of the largest σ costs least, in proportion to σ₂ ± σ₃.
    gap = sigma[1] + sign * sigma[2]
    distance = math.hypot(*(matrix - R).ravel().tolist())
    found = Validation(
        float(np.linalg.norm(matrix.T @ matrix - np.eye(3))),
        float(np.prod(sigma)) * sign,
        distance,
        bool(sign < 0 and sigma[2] > 0.0),
        bool(gap > DEGENERATE * max(1.0, sigma[0])),
        distance > ROTATION_TOLERANCE,
    )
    return found, np.ascontiguousarray(R)


About: TypeAlias = Literal["moving", "fixed"]

_ROUNDING = 1e-12


FrameMotion: TypeAlias = tuple[Array, About]
"""A further motion: a homogeneous transform (4, 4), about the moving or the fixed axes."""


@dataclass(frozen=True, slots=True)
class Composition:
    """The result of a sequence of motions.

    Attributes:
        transforms: Transform after each motion, the first included; shape (4, 4) each.
        inverse: Inverse of the last transform; shape (4, 4).
        points: Points of the last frame, expressed in the reference frame; shape (N, 3), [m].
        inverse_error: Largest entry of T T⁻¹ - I, lengths relative to the largest coordinate.
        point_error: Largest difference from the points to which each motion is applied in turn, relative likewise.
    """

    transforms: tuple[Array, ...]
    inverse: Array
    points: Array
    inverse_error: float
    point_error: float


def composed(first: Array, further: Sequence[FrameMotion], points: Array) -> Composition:
    """Compose motions, and express points of the last frame in the reference frame; raises CertificationFailed."""
    transforms = [first]
    for motion, about in further:
        T = transforms[-1]
        transforms.append(T @ motion if about == "moving" else motion @ T)
    T = transforms[-1]
    back = inverse(T)
    moved = points @ T[:3, :3].T + T[:3, 3]
    one_by_one = _one_by_one(first, further, points)
    lengths = (np.abs(one[:3, 3]).max() for one in (first, T, back, *(motion for motion, _ in further)))
    extent = max(1.0, float(np.abs(points).max(initial=0.0)), *map(float, lengths))
    inverse_error = float(np.abs(T @ back - np.eye(4)).max()) / extent
    point_error = float(np.abs(moved - one_by_one).max(initial=0.0)) / extent
    for what, error in (("inverse", inverse_error), ("points", point_error)):
        certify(what, error, _ROUNDING)
    return Composition(tuple(transforms), back, moved, inverse_error, point_error)


def _one_by_one(first: Array, further: Sequence[FrameMotion], points: Array) -> Array:
    """Apply each motion to the points in turn, from the innermost outwards, without multiplying matrices."""
    inner, outer = ([T for T, about in further if about == axes] for axes in ("moving", "fixed"))
    for T in (*reversed(inner), first, *outer):
        points = points @ T[:3, :3].T + T[:3, 3]
    return points
