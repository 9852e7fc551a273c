"""A chain as a product of exponentials: its home pose and the screw axes of its joints, and back to a description.

    T(q) = exp([S₁] θ₁) ⋯ exp([S_m] θ_m) M = M exp([B₁] θ₁) ⋯ exp([B_m] θ_m)

M is the pose of the tip where every variable is zero, S_i are the screw axes in the base's axes and B_i in the tip's,
angular part first [LynchPark2017, ch. 4]. θ_i is the position of joint i; that of a joint which follows another one is
`multiplier` times the variable, and M takes its offset.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.robot.arrays import Array, Indices, cross_matrices
from gelenk.robot.chain import FlatChain
from gelenk.robot.dh import about_z
from gelenk.robot.poses import inverse, transform


@dataclass(frozen=True, slots=True)
class ScrewTable:
    """A product of exponentials with m joints, mimic joints included, and n variables.

    Attributes:
        home: M, shape (4, 4); [m].
        space, body: Screw axes (ω, v), one a row; shape (m, 6), [rad or m] per [rad or m].
        variables: Index of the variable that moves each joint; shape (m,).
        multipliers: Position of the joint per position of its variable; shape (m,).
    """

    home: Array
    space: Array
    body: Array
    variables: Indices
    multipliers: Array

    def poses(self, qs: Array, *, in_body: bool = False) -> Array:
        """Return T_base_tip by the product of exponentials in the base's axes, or the tip's; (N, n) → (N, 4, 4)."""
        thetas = qs[:, self.variables] * self.multipliers
        product = np.tile(self.home if in_body else np.eye(4), (len(qs), 1, 1))
        for axis, angles in zip(self.body if in_body else self.space, thetas.T, strict=True):
            product = product @ exponentials(axis, angles)
        return product if in_body else product @ self.home


def screws_of_chain(flat: FlatChain) -> ScrewTable:
    """Return the product of exponentials of a chain."""
    T = np.eye(4)
    space = np.empty((len(flat.joints), 6))
    for i, ((slides, _), (_, offset)) in enumerate(zip(flat.joints, flat.drives, strict=True)):
        T = T @ flat.placement(i)
        z, p = T[:3, 2], T[:3, 3]
        space[i] = np.concatenate((np.zeros(3), z) if slides else (z, np.cross(p, z)))
        T = T @ (about_z(0.0, offset) if slides else about_z(offset, 0.0))
    home = T @ flat.placement(-1)
    return ScrewTable(home, space, space @ adjoint(inverse(home)).T, flat.joints[:, 1], flat.drives[:, 0])


def adjoint(T: Array) -> Array:
    """Return the matrix that takes a screw (ω, v) from b to a, of T_a_b; shape (6, 6)."""
    A = np.zeros((6, 6))
    A[:3, :3] = A[3:, 3:] = T[:3, :3]
    A[3:, :3] = cross_matrices(T[:3, 3]) @ T[:3, :3]
    return A


def exponentials(axis: Array, angles: Array) -> Array:
    """Return exp([S] θ) of a screw axis (ω, v), ω a unit vector or zero, at angles (N,); shape (N, 4, 4).

    Rodrigues' formula and its integral, as in [LynchPark2017, prop. 3.25].
    """
    w, v = cross_matrices(axis[:3]), axis[3:]
    theta = angles[:, None, None]
    if not axis[:3].any():
        return np.array([transform(angle * v, np.eye(3)) for angle in angles]).reshape(-1, 4, 4)
    Ts = np.tile(np.eye(4), (len(angles), 1, 1))
    Ts[:, :3, :3] += np.sin(theta) * w + (1.0 - np.cos(theta)) * (w @ w)
    Ts[:, :3, 3] = (theta * np.eye(3) + (1.0 - np.cos(theta)) * w + (theta - np.sin(theta)) * (w @ w)) @ v
    return Ts
