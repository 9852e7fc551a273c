"""Derivatives by central differences, extrapolated after Richardson.

Poses are differentiated on the manifold: the difference of two poses is the logarithm of one by the other's inverse.
What is to be differentiated is a function of a batch of configurations, shape (N, n), one result a row.
"""

from collections.abc import Callable
from itertools import pairwise
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
from scipy.spatial.transform import Rotation

Array: TypeAlias = npt.NDArray[np.float64]
OfConfigurations: TypeAlias = Callable[[Array], Array]
Difference: TypeAlias = Callable[[Array, Array], Array]

STEP, LEVELS = 0.04, 4
"""Errors: STEP⁸ / 4¹⁺²⁺³ ≈ 1e-15 from the truncated series, 1e-16 · 2⁴ / STEP ≈ 1e-13 from rounding."""


def derivatives(function: OfConfigurations, q: Array, difference: Difference) -> list[Array]:
    """The derivative by each joint position at one configuration, of a function whose results differ like that."""
    return _along(function, q, np.eye(len(q)), difference)


def along(function: OfConfigurations, q: Array, direction: Array, difference: Difference) -> Array:
    """The derivative at one configuration in one direction."""
    return _along(function, q, direction[None], difference)[0]


def _along(function: OfConfigurations, q: Array, directions: Array, difference: Difference) -> list[Array]:
    """The derivative in each direction; the function is called once, with all configurations of all steps."""
    steps = STEP / 2.0 ** np.arange(LEVELS)
    offsets = np.einsum("s,kn,l->skln", [1.0, -1.0], directions, steps)
    values = function((q + offsets).reshape(-1, len(q)))
    ahead, behind = values.reshape(2, len(directions), LEVELS, *values.shape[1:])
    return [_extrapolated(a, b, difference) for a, b in zip(ahead, behind, strict=True)]


def _extrapolated(ahead: Array, behind: Array, difference: Difference) -> Array:
    estimates = [difference(ahead[level], behind[level]) / (2 * STEP / 2.0**level) for level in range(LEVELS)]
    for order in range(1, LEVELS):
        factor = 4.0**order
        estimates = [(factor * fine - coarse) / (factor - 1) for coarse, fine in pairwise(estimates)]
    return estimates[0]


def plain(a: Array, b: Array) -> Array:
    """Of numbers."""
    return np.asarray(a - b)


def aligned(a: Array, b: Array) -> Array:
    """Of poses, as a motion at the tip in the axes of the base."""
    return np.concatenate((a[:3, 3] - b[:3, 3], _rotation(a[:3, :3] @ b[:3, :3].T)))


def spatial(a: Array, b: Array) -> Array:
    """Of poses, as the motion of the body's point at the origin of the base, in the axes of the base."""
    return _logarithm(a @ np.linalg.inv(b))


def body(a: Array, b: Array) -> Array:
    """Of poses, as a motion at the tip in the axes of the tip."""
    return _logarithm(np.linalg.inv(b) @ a)


def euler(sequence: str) -> Difference:
    """Of poses, the position's difference over that of Euler angles, which do not jump by more than half a turn."""

    def difference(a: Array, b: Array) -> Array:
        angles = [Rotation.from_matrix(T[:3, :3]).as_euler(sequence) for T in (a, b)]
        jump = angles[0] - angles[1]
        return np.concatenate((a[:3, 3] - b[:3, 3], jump - 2 * np.pi * np.round(jump / (2 * np.pi))))

    return difference


def _rotation(R: Array) -> Array:
    return np.asarray(Rotation.from_matrix(R).as_rotvec())


def _logarithm(T: Array) -> Array:
    """The twist (v, ω) whose exponential is a pose: v = (I - [ω]×/2 + (1 - θ/2 · cot θ/2)/θ² [ω]ײ) p."""
    w, p = _rotation(T[:3, :3]), T[:3, 3]
    half = np.linalg.norm(w) / 2
    factor = 1 / 12 if half < 1e-4 else (1 - half / np.tan(half)) / (2 * half) ** 2
    return np.concatenate((p - np.cross(w, p) / 2 + factor * np.cross(w, np.cross(w, p)), w))
