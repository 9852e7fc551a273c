"""Bodies that the variables of a chain move, and their equations of motion from our own Jacobians.

Joints that the chain's variables do not move are locked. This merges links into bodies, one for each moving joint.
With J_v and J_ω the Jacobians of a body's centre of mass, in the axes of the root, the Lagrangian gives
[Siciliano2009, 7.1]

    M(q) = Σ m J_vᵀJ_v + J_ωᵀ I J_ω,    g(q) = -Σ m J_vᵀ g₀,    U(q) = -Σ m g₀ᵀ c,
    S(q, q̇) = Σ m J_vᵀJ̇_v + J_ωᵀ (I J̇_ω + [ω]× I J_ω),    Ṁ = S + Sᵀ,

where S q̇ are the Coriolis and centrifugal torques. Nothing here uses Pinocchio, so each can check the other.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from gelenk.kinematics.simd.kernels import chain_hessians, chain_jacobians
from gelenk.robot.arrays import Array, Indices, cross_matrices
from gelenk.robot.chain import Chain, FlatChain, build_chain
from gelenk.robot.description import MOVABLE, Description, Inertial, Joint, Link
from gelenk.robot.notations import origin_of, placement, rotations_from_vectors
from gelenk.robot.poses import transform


@dataclass(frozen=True, slots=True, eq=False)
class Load:
    """A rigid payload on the tip.

    Attributes:
        mass, center: Mass, [kg], and its centre in the tip frame; shape (3,), [m].
        inertia: Inertia about the centre of mass, in the tip's axes; shape (3, 3), [kg m²].
    """

    mass: float
    center: Array
    inertia: Array


@dataclass(frozen=True, slots=True, eq=False)
class RigidBody:
    """A rigid group of links that move together, or a payload.

    Attributes:
        joint: The joint that carries the body; None for a payload.
        links: Names of the links; the frame of the first is the body's frame. A payload has the tip's frame.
        mass, center, inertia: As of a `Load`, in the body's frame and axes.
        flat: The chain from the root to the body's frame.
        columns: Indices of that chain's variables among those of the robot's chain.
    """

    joint: str | None
    links: tuple[str, ...]
    mass: float
    center: Array
    inertia: Array
    flat: FlatChain
    columns: Indices


def locked(description: Description, chain: Chain) -> Description:
    """Copy a robot, with every joint fixed that the chain's variables do not move.

    A fixed joint is at zero, a mimic joint at its position for a leader at zero. Floating and planar joints are fixed.
    """
    joints = tuple(_locked_joint(description, chain, joint) for joint in description.joints)
    return replace(description, joints=joints, warnings=())


def _locked_joint(description: Description, chain: Chain, joint: Joint) -> Joint:
    drive = description.drives.get(joint.name)
    if drive is not None and drive.leader in chain.joint_names:
        return joint
    origin = joint.origin
    if drive is not None and drive.offset != 0.0:
        shift = np.array(joint.axis) * drive.offset
        slides = joint.type == "prismatic"
        turn = np.eye(3) if slides else rotations_from_vectors(shift[None])[0]
        motion = transform(shift if slides else np.zeros(3), turn)
        origin = origin_of(placement(origin.xyz, origin.rpy) @ motion)
    return replace(joint, type="fixed", origin=origin, mimic=None)


def bodies(description: Description, chain: Chain) -> tuple[RigidBody, ...]:
    """Return the bodies that a chain's variables move, one per moving joint; other joints are `locked` already."""
    parts: dict[str, list[tuple[Link, Array]]] = {j.child: [] for j in description.joints if j.type in MOVABLE}
    for link in description.links:
        first, T = _carrier(description, link.name)
        if first in parts:
            # The link attached to the joint itself comes first, whatever its position in the document.
            parts[first].insert(0 if first == link.name else len(parts[first]), (link, T))
    return tuple(_joined(description, chain, first, links) for first, links in parts.items())


def loaded(description: Description, chain: Chain, load: Load) -> RigidBody:
    """Return a payload as a body; its columns are empty if no variable moves it."""
    part = build_chain(description, description.root, chain.tip_frame)
    return RigidBody(None, (), load.mass, load.center, load.inertia, part.flat, _columns(part, chain))


def _carrier(description: Description, link: str) -> tuple[str, Array]:
    """Child link of the nearest joint that moves a link (the root if none does), and the link's pose T in it."""
    T = np.eye(4)
    for joint in description.path_to_root(link):
        if joint.type in MOVABLE:
            return joint.child, T
        T = placement(joint.origin.xyz, joint.origin.rpy) @ T
    return description.root, T


def _joined(description: Description, chain: Chain, first: str, links: Sequence[tuple[Link, Array]]) -> RigidBody:
    """Merge links into one body by Steiner's theorem."""
    weights = [_weight(link.inertial, T) for link, T in links if link.inertial is not None]
    mass = sum(weight[0] for weight in weights)
    center, inertia = np.zeros(3), np.zeros((3, 3))
    if mass > 0.0:
        center = sum((m * c for m, c, _ in weights), center) / mass
    for m, c, about_own in weights:
        r = c - center
        inertia += about_own + m * (r @ r * np.eye(3) - np.outer(r, r))
    part = build_chain(description, description.root, first)
    names = tuple(link.name for link, _ in links)
    joint = description.joint_above[first].name
    return RigidBody(joint, names, float(mass), center, inertia, part.flat, _columns(part, chain))


def _weight(inertial: Inertial, T: Array) -> tuple[float, Array, Array]:
    """Mass, centre of mass and inertia about it, transformed by T."""
    T = T @ placement(inertial.origin.xyz, inertial.origin.rpy)
    return inertial.mass, T[:3, 3], T[:3, :3] @ tensor(inertial.inertia) @ T[:3, :3].T


def tensor(entries: Sequence[float] | Array) -> Array:
    """Return the matrix of an inertia from ixx, ixy, ixz, iyy, iyz, izz; shape (3, 3), [kg m²]."""
    return np.asarray(entries, dtype=float)[[[0, 1, 2], [1, 3, 4], [2, 4, 5]]]


def _columns(part: Chain, chain: Chain) -> Indices:
    return np.array([chain.joint_names.index(name) for name in part.joint_names], dtype=np.int64)


@dataclass(frozen=True, slots=True, eq=False)
class Motions:
    """Bodies at N configurations, in the axes of the root; B bodies, n variables.

    Attributes:
        masses, centers: Masses, shape (B,), [kg], and their centres in the root frame, shape (N, B, 3), [m].
        inertias: Inertias about the centres of mass; shape (N, B, 3, 3), [kg m²].
        linear, angular: J_v of the centres of mass, and J_ω; shape (N, B, 3, n) each.
        speeds: q̇, zero if no rates were requested; shape (N, n).
        linear_rates, angular_rates: J̇_v and J̇_ω at q̇, likewise. Empty if no rates were requested.
    """

    masses: Array
    centers: Array
    inertias: Array
    linear: Array
    angular: Array
    speeds: Array
    linear_rates: Array
    angular_rates: Array

    def mass_matrices(self) -> Array:
        """Return M; shape (N, n, n), [kg m²], [kg m] or [kg]."""
        return _summed(self.linear, self._momenta()) + _summed(self.angular, self.inertias @ self.angular)

    def velocity_products(self) -> Array:
        """Return S; shape (N, n, n). S q̇ are the Coriolis and centrifugal torques, S + Sᵀ = Ṁ."""
        omegas = self.angular @ self.speeds[:, None, :, None]
        turning = cross_matrices(omegas[..., 0]) @ (self.inertias @ self.angular)
        return _summed(self.linear, self.masses[:, None, None] * self.linear_rates) + _summed(
            self.angular, self.inertias @ self.angular_rates + turning
        )

    def gravity_torques(self, gravity: Array) -> Array:
        """Return g, the torques that balance a gravity (3,) [m/s²] in the root's axes; shape (N, n), [N m or N]."""
        return np.asarray(-np.einsum("kbcj,c->kj", self._momenta(), gravity))

    def potential_energies(self, gravity: Array) -> Array:
        """Return U, zero where the centre of mass is level with the root; shape (N,), [J]."""
        return np.asarray(-(self.masses @ self.centers) @ gravity)

    def mass_scale(self) -> float:
        """Return the largest term in the sums for M, about the root's origin too: rounding errors scale with it."""
        turning = (
            np.abs(self.inertias).max(axis=(2, 3), initial=0.0)
            * np.abs(self.angular).max(axis=(2, 3), initial=0.0) ** 2
        )
        return float((self.masses * self._speeds() ** 2 + turning).max(initial=0.0))

    def gravity_scale(self, gravity: Array) -> float:
        """Return the magnitude of gravity torques, for relative errors, [N m or N]."""
        return float((self.masses * self._speeds()).max(initial=0.0) * np.abs(gravity).max())

    def _speeds(self) -> Array:
        """Largest entries of J_v at the centre of mass, plus those due to its lever about the root; shape (N, B)."""
        turning = np.abs(self.angular).max(axis=(2, 3), initial=0.0) * np.abs(self.centers).max(axis=2)
        return np.asarray(np.abs(self.linear).max(axis=(2, 3), initial=0.0) + turning)

    def _momenta(self) -> Array:
        return np.asarray(self.masses[:, None, None] * self.linear)


def motions(carried: Sequence[RigidBody], qs: Array, speeds: Array | None = None) -> Motions:
    """Compute positions, inertias and Jacobians of bodies at configurations (N, n), and their rates if q̇ is given."""
    shape = len(qs), len(carried), 6, qs.shape[1]
    Js, rates = np.zeros(shape), np.zeros(shape if speeds is not None else (0,) * 4)
    positions, rotations = np.empty((*shape[:2], 3)), np.empty((*shape[:2], 3, 3))
    for b, body in enumerate(carried):
        part = np.ascontiguousarray(qs[:, body.columns])
        positions[:, b], rotations[:, b], moved = chain_jacobians(body.flat, part)
        Js[:, b, :, body.columns] = moved.transpose(2, 0, 1)
        if speeds is not None:
            Hs = chain_hessians(body.flat, part)
            along = Hs @ speeds[:, None, body.columns, None]
            rates[:, b, :, body.columns] = along[..., 0].transpose(2, 0, 1)
    masses = np.array([body.mass for body in carried])
    tensors = np.array([body.inertia for body in carried]).reshape(-1, 3, 3)
    levers = np.einsum("kbij,bj->kbi", rotations, np.array([body.center for body in carried]).reshape(-1, 3))
    linear, angular = Js[:, :, :3], Js[:, :, 3:]
    # ω × r = [r]×ᵀ ω, column by column.
    across = cross_matrices(levers).swapaxes(2, 3)
    linear = linear + across @ angular
    linear_rates, angular_rates = rates[:, :, :3], rates[:, :, 3:]
    if speeds is not None:
        lever_rates = across @ (angular @ speeds[:, None, :, None])
        linear_rates = (
            linear_rates + across @ angular_rates + cross_matrices(lever_rates[..., 0]).swapaxes(2, 3) @ angular
        )
    inertias = rotations @ tensors @ rotations.swapaxes(2, 3)
    still = speeds if speeds is not None else np.zeros_like(qs)
    return Motions(masses, positions + levers, inertias, linear, angular, still, linear_rates, angular_rates)


def _summed(left: Array, right: Array) -> Array:
    """Σ_b leftᵀ right over the bodies; shapes (N, B, 3, n) → (N, n, n)."""
    count, number, _, n = left.shape
    return np.asarray(left.reshape(count, 3 * number, n).swapaxes(1, 2) @ right.reshape(count, 3 * number, n))
