"""The equations of motion of a Denavit-Hartenberg arm by the definition alone: energies, and differences of these.

T and U are summed up from the poses of the frames; velocities of centres of mass, the slope of U and the slopes of the
mass matrix are central differences. Nothing here knows a Jacobian or that an arm may be planar.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from tests.oracles.dh_columns import Array, Table

STEP = 1e-4


@dataclass(frozen=True)
class Link:
    """Mass [kg], centre of mass in frame i [m], moment of inertia about any axis through it [kg m²]."""

    mass: float
    center: Sequence[float]
    inertia: float


@dataclass(frozen=True)
class Arm:
    """A table with a link a row, and free fall in the base, [m/s²]."""

    table: Table
    links: Sequence[Link]
    gravity: Sequence[float]

    def centers(self, q: Array) -> Array:
        """Centres of mass in the base, one row a link."""
        frames = self.table.frames(q)[1:]
        return np.array(
            [T[:3, :3] @ np.array(link.center) + T[:3, 3] for T, link in zip(frames, self.links, strict=True)]
        )

    def potential(self, q: Array) -> float:
        """U."""
        masses = np.array([link.mass for link in self.links])
        return -float(masses @ self.centers(q) @ np.array(self.gravity))

    def rotations(self, q: Array) -> Array:
        """Of the frames in the base, one a link."""
        return np.array([T[:3, :3] for T in self.table.frames(q)[1:]])

    def mass_matrix(self, q: Array) -> Array:
        """M by T = ½ q̇ᵀ M q̇: each velocity is a difference of positions, each turn one of rotations."""
        speeds, turns = slopes(self.centers, q), slopes(self.rotations, q)
        M = np.zeros((len(q), len(q)))
        for b, link in enumerate(self.links):
            M += link.mass * speeds[:, b] @ speeds[:, b].T
            M += link.inertia * 0.5 * np.einsum("jab,kab->jk", turns[:, b], turns[:, b])  # ½ tr(Ṙᵀ Ṙ) = |ω|²
        return M

    def christoffel(self, q: Array) -> Array:
        """c[i, j, k] by slopes of M."""
        rates = slopes(self.mass_matrix, q).transpose(1, 2, 0)
        return np.asarray(rates + rates.transpose(0, 2, 1) - rates.transpose(2, 0, 1)) / 2.0

    def gravity_vector(self, q: Array) -> Array:
        """The slope of U."""
        return slopes(lambda at: np.array(self.potential(at)), q)


def slopes(function: Callable[[Array], Array], q: Array) -> Array:
    """The derivative along each coordinate, to the fourth order of the step; the coordinate is the first axis."""
    found = []
    for unit in STEP * np.eye(len(q)):
        near, far = function(q + unit) - function(q - unit), function(q + 2 * unit) - function(q - 2 * unit)
        found.append((8.0 * near - far) / (12.0 * STEP))
    return np.array(found)
