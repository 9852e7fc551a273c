"""Exact workspaces of arms of two links, and of these with a hand: by distances alone.

A point is reached by links of lengths a and b if and only if its distance from the shoulder is between |a - b| and
a + b. A hand of a given direction takes that question to the wrist, one hand's length back.
"""

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Array: TypeAlias = npt.NDArray[np.float64]


def annulus(lengths: list[float]) -> tuple[float, float]:
    """Smallest and largest distance that links in a row reach: max(0, 2 l_max - Σl) and Σl."""
    return max(0.0, 2.0 * max(lengths) - sum(lengths)), sum(lengths)


def secondary(lengths: list[float], radii: Array) -> npt.NDArray[np.bool_]:
    """Whether three planar links reach a distance from the base in every direction of the hand."""
    a, b, hand = lengths
    outside = (radii >= hand + abs(a - b)) | (radii <= hand - abs(a - b))
    return np.asarray((radii + hand <= a + b) & outside)


def share(points: Array, hands: Array, shoulder: Array, lengths: tuple[float, float]) -> Array:
    """Of each point the share of hand vectors (wrist to tip) that two links reach it with; (M, 3), (K, 3) → (M,)."""
    wrists = points[:, None] - hands[None] - shoulder
    distances = np.linalg.norm(wrists, axis=2)
    reached = (distances >= abs(lengths[0] - lengths[1])) & (distances <= sum(lengths))
    return np.asarray(reached.mean(axis=1))
