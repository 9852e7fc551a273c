"""Composition of frames: R_0_2 = R_0_1 R_1_2, about moving or fixed axes.

T_a_b maps coordinates from b to a, and its position is its last *column* (the notes once say row). A further motion
about the moving axes multiplies from the right, one about the fixed axes from the left. The inverse is Rᵀ with -Rᵀp.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.errors import certify
from gelenk.robot.arrays import Array
from gelenk.robot.poses import inverse

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
