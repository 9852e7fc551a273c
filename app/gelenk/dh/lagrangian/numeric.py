"""M, C and g of an arm in numbers, from the columns of the Jacobians of its centres of mass.

    M = Σ_b m_b Jv_bᵀ Jv_b + I_b Jω_bᵀ Jω_b,   g = -Σ_b m_b Jv_bᵀ g
    c_ijk = Σ_b m_b Jv_b,i · ∂Jv_b,k/∂q_j + I_b Jω_b,i · ½ z_j × z_k   (j < k),   C_ij = Σ_k c_ijk q̇_k

This is the equation of motion projected on the columns, and needs no derivative of M. A column of joint k changes with
joint j ≤ k before it as z_j × column, and not at all if j is prismatic.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.dh.lagrangian.bodies import LinkBody, Point, center_in_frame
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable


@dataclass(frozen=True, slots=True)
class NumericMotion:
    """M, C and g at one configuration, in [kg], [kg m] or [kg m²] and in [N or N m].

    Attributes:
        q, v: Joint positions and velocities, [rad or m (/s)]; shape (n,). No velocities are None.
        mass_matrix: M; shape (n, n).
        christoffel: c[i, j, k], symmetric in j and k; shape (n, n, n).
        gravity_vector: g; shape (n,).
    """

    q: Array
    v: Array | None
    mass_matrix: Array
    christoffel: Array
    gravity_vector: Array

    @property
    def coriolis(self) -> Array | None:
        """C; shape (n, n); None without velocities."""
        return None if self.v is None else np.asarray(self.christoffel @ self.v)

    @property
    def coriolis_vector(self) -> Array | None:
        """C q̇; shape (n,), [N m or N]; None without velocities."""
        return None if self.v is None else np.asarray(self.christoffel @ self.v @ self.v)


def centers_in_frames(table: DhTable, bodies: Sequence[LinkBody]) -> list[Point]:
    """Return each centre of mass in its link's frame, [m]; one that was left out is at zero on its line."""
    standard = table.convention == "standard"
    given = [0.0 if body.center is None else body.center for body in bodies]
    return [center_in_frame(table.joints, i, standard, center) for i, center in enumerate(given)]


def numeric_motion(
    table: DhTable, bodies: Sequence[LinkBody], gravity: Array, q: Array, v: Array | None
) -> NumericMotion:
    """Compute M, C and g at a configuration q with velocities v, each as in `NumericMotion`.

    There is one body per row; a quantity left out counts as zero. `gravity` (3,) is free fall in the base, [m/s²].
    """
    n = len(table.joints)
    frames = table.frames(q.tolist())
    axes = frames[:-1] if table.convention == "standard" else frames[1:]
    turns = [row.type == "revolute" for row in table.joints]
    zs = [T[:3, 2] for T in axes]
    M, c, g = np.zeros((n, n)), np.zeros((n, n, n)), np.zeros(n)
    centers = centers_in_frames(table, bodies)
    for b, (body, center) in enumerate(zip(bodies, centers, strict=True)):
        m, inertia = body.mass or 0.0, body.inertia or 0.0
        p = frames[b + 1][:3, :3] @ center + frames[b + 1][:3, 3]
        Jv, Jw = np.zeros((3, n)), np.zeros((3, n))
        for j in range(b + 1):
            Jv[:, j] = np.cross(zs[j], p - axes[j][:3, 3]) if turns[j] else zs[j]
            Jw[:, j] = zs[j] * turns[j]
        M += m * Jv.T @ Jv + inertia * Jw.T @ Jw
        g -= m * Jv.T @ gravity
        for j in (j for j in range(b + 1) if turns[j]):
            for k in range(j, b + 1):
                change = m * Jv.T @ np.cross(zs[j], Jv[:, k]) + inertia * Jw.T @ np.cross(zs[j], Jw[:, k]) / 2.0
                c[:, j, k] += change
                c[:, k, j] += change * (j != k)
    return NumericMotion(q, v, M, c, g)
