"""Composition of frames: R_0_2 = R_0_1 R_1_2, about the axes that moved along or about those that stay.

T_a_b takes what is written in b to a, and its position is its last *column* (the notes once say row). A further motion
about the moved axes multiplies from the right, one about the fixed axes from the left. The inverse is Rᵀ with -Rᵀp.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.model.arrays import Array
from gelenk.model.errors import CertificationFailed
from gelenk.model.poses import inverse

About: TypeAlias = Literal["moving", "fixed"]

_ROUNDING = 1e-12


@dataclass(frozen=True, slots=True)
class Motion:
    """A further motion: a homogeneous transform (4, 4), and whose axes it is written in."""

    transform: Array
    about: About


@dataclass(frozen=True, slots=True)
class Composition:
    """A sequence of motions.

    Attributes:
        transforms: The frame after each of them, the first one included; shape (4, 4) each.
        inverse: Of the last one; shape (4, 4).
        points: Given in the last frame, written in the first; shape (N, 3), [m].
        inverse_error: Largest entry of T T⁻¹ - I, lengths relative to the largest coordinate.
        point_error: Largest difference to the points when each motion is applied to them in turn, relative likewise.
    """

    transforms: tuple[Array, ...]
    inverse: Array
    points: Array
    inverse_error: float
    point_error: float


def composed(first: Array, further: Sequence[Motion], points: Array) -> Composition:
    """The frame that a sequence of motions leads to, and points of it written in the first frame.

    Args:
        first: The first motion; shape (4, 4).
        further: The others, in order.
        points: Shape (N, 3), [m].

    Raises:
        CertificationFailed: Two ways to the same number differ.
    """
    transforms = [first]
    for motion in further:
        T = transforms[-1]
        transforms.append(T @ motion.transform if motion.about == "moving" else motion.transform @ T)
    T = transforms[-1]
    back = inverse(T)
    moved = points @ T[:3, :3].T + T[:3, 3]
    one_by_one = _one_by_one(first, further, points)
    lengths = (np.abs(one[:3, 3]).max() for one in (first, T, back, *(motion.transform for motion in further)))
    extent = max(1.0, float(np.abs(points).max(initial=0.0)), *map(float, lengths))
    inverse_error = float(np.abs(T @ back - np.eye(4)).max()) / extent
    point_error = float(np.abs(moved - one_by_one).max(initial=0.0)) / extent
    for what, error in (("inverse", inverse_error), ("points", point_error)):
        if not error <= _ROUNDING:
            raise CertificationFailed(what, error, _ROUNDING)
    return Composition(tuple(transforms), back, moved, inverse_error, point_error)


def _one_by_one(first: Array, further: Sequence[Motion], points: Array) -> Array:
    """The points, taken through each motion by itself: from the innermost outwards, without a product of matrices."""
    inner = [motion.transform for motion in further if motion.about == "moving"]
    outer = [motion.transform for motion in further if motion.about == "fixed"]
    for T in (*reversed(inner), first, *outer):
        points = points @ T[:3, :3].T + T[:3, 3]
    return points
