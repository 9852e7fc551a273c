"""Torques of the joints along a motion: their limits, the two ways to compute them, and their peaks.

The planner uses our own Newton-Euler equations body by body, the audit Pinocchio's recursive Newton-Euler algorithm.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from gelenk.robot.arrays import Array, Indices
from gelenk.trajectory.audit.pieces import Pieces, values_at
from gelenk.trajectory.audit.tip import MIN_SAMPLES, between, grid

TorqueParts: TypeAlias = Callable[[Array, Array, Array], tuple[Array, Array]]
"""Maps q, q̇ and q̈, shape (N, n) each, to M q̈ + C q̇ and to the weight's g, (N, n) each, [N m or N]."""
Torques: TypeAlias = Callable[[Array, Array, Array], Array]
"""Maps q, q̇ and q̈, shape (N, n) each, to M q̈ + C q̇ + g; (N, n), [N m or N]."""

_ROUNDING = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class TorqueLimits:
    """Limits of the joints' torques, and how these follow from a motion of the robot with its payload.

    Attributes:
        most: Of each joint, infinite for none; shape (n,), [N m or N].
        parts, recomputed: Torques by the planner's way and by the audit's.
        names, units: Of each joint, and of its torque.
    """

    most: Array
    parts: TorqueParts
    recomputed: Torques
    names: tuple[str, ...]
    units: tuple[str, ...]

    @property
    def is_limited(self) -> bool:
        """Whether any joint has a limit."""
        return bool(np.isfinite(self.most).any())

    def tightened(self, factor: float) -> "TorqueLimits":
        """Return the limits divided by a factor."""
        return replace(self, most=self.most / factor)


def torque_peaks(pieces: Pieces, limits: TorqueLimits) -> tuple[Array, Array]:
    """Find the largest torque of each joint, also between samples, with its sign, and its time; shape (n,) each."""

    def torques(piece: Indices, tau: Array) -> Array:
        return limits.recomputed(*(values_at(pieces, piece, tau, order) for order in range(3)))

    piece, tau, inner = grid(pieces, MIN_SAMPLES)
    found = between(tau, piece, inner, lambda *at: np.abs(torques(*at)), np.full(len(limits.most), _ROUNDING))
    places = np.array([place for _, _, place in found])
    at = piece[[row for _, row, _ in found]]
    return np.diagonal(torques(at, places)).copy(), pieces.starts[at] + places * pieces.widths[at]
