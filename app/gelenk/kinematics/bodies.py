"""What the variables of a chain carry: bodies with mass, and their equations of motion from our own Jacobians.

Joints that the chain's variables do not move are locked, which joins links to bodies; one body hangs on each joint that
moves. With J_v and J_ω the Jacobians of a body's centre of mass, in the axes of the root, the Lagrangian gives
[Siciliano2009, 7.1]

    M(q) = Σ m J_vᵀJ_v + J_ωᵀ I J_ω,    g(q) = -Σ m J_vᵀ g₀,    U(q) = -Σ m g₀ᵀ c,
    S(q, q̇) = Σ m J_vᵀJ̇_v + J_ωᵀ (I J̇_ω + [ω]× I J_ω),    Ṁ = S + Sᵀ,

and S q̇ are the Coriolis and centrifugal torques. Nothing here knows Pinocchio, so that the two can judge each other.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from gelenk.kinematics.kernels import chain_hessians, chain_jacobians
from gelenk.model.arrays import Array, Indices
from gelenk.model.chain import Chain, FlatChain, build_chain
from gelenk.model.description import MOVABLE, Description, Inertial, Joint, Link
from gelenk.model.notations import placement, rotations_from_vectors
from gelenk.model.origins import origin_of
from gelenk.model.poses import transform

_SKEW = -np.cross(np.eye(3)[:, None], np.eye(3)[None]).reshape(3, 9)
"""[r]× row by row as a linear function of r."""


@dataclass(frozen=True, slots=True, eq=False)
class Load:
    """A rigid payload on the tip.

    Attributes:
        mass: [kg].
        center: Centre of mass in the tip frame; shape (3,), [m].
        inertia: About the centre of mass, in the tip's axes; shape (3, 3), [kg m²].
    """

    mass: float
    center: Array
    inertia: Array


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """Links that move as one.

    Attributes:
        joint: The joint that carries it; of a payload None.
        links: Their names; the first is the one whose frame the numbers are in.
        mass: [kg].
        center: Centre of mass; shape (3,), [m].
        inertia: About the centre of mass; shape (3, 3), [kg m²].
        flat: The chain from the root to its frame.
        columns: The places of that chain's variables among those of the robot's chain.
    """

    joint: str | None
    links: tuple[str, ...]
    mass: float
    center: Array
    inertia: Array
    flat: FlatChain
    columns: Indices


def locked(description: Description, chain: Chain) -> Description:
    """A copy of the robot in which every joint that the chain's variables do not move is fixed.

    These stand at zero; a mimic joint stands where its leader at zero has it. Floating and planar joints are fixed too.
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
        motion = (
            transform(shift, np.eye(3)) if slides else transform(np.zeros(3), rotations_from_vectors(shift[None])[0])
        )
        origin = origin_of(placement(origin.xyz, origin.rpy) @ motion)
    return replace(joint, type="fixed", origin=origin, mimic=None)


def bodies(description: Description, chain: Chain) -> tuple[Body, ...]:
    """The bodies that a chain's variables move, one a moving joint.

    Args:
        description: The robot, its other joints `locked`.
        chain: The chain.
    """
    parts: dict[str, list[tuple[Link, Array]]] = {j.child: [] for j in description.joints if j.type in MOVABLE}
    for link in description.links:
        first, T = _carrier(description, link.name)
        if first in parts:
            # The link that hangs on the joint itself comes first, wherever it stands in the document.
            parts[first].insert(0 if first == link.name else len(parts[first]), (link, T))
    return tuple(_joined(description, chain, first, links) for first, links in parts.items())


def loaded(description: Description, chain: Chain, load: Load) -> Body:
    """A payload as a body; one that no variable moves has no columns."""
    part = build_chain(description, description.root, chain.tip_frame)
    return Body(None, (), load.mass, load.center, load.inertia, part.flat, _columns(part, chain))


def _carrier(description: Description, link: str) -> tuple[str, Array]:
    """The link next to the joint that moves a link (the root if none does), and T from that to the link."""
    T = np.eye(4)
    for joint in description.path_to_root(link):
        if joint.type in MOVABLE:
            return joint.child, T
        T = placement(joint.origin.xyz, joint.origin.rpy) @ T
    return description.root, T


def _joined(description: Description, chain: Chain, first: str, links: Sequence[tuple[Link, Array]]) -> Body:
    """Masses joined to one, by Steiner's theorem."""
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
    return Body(joint, names, float(mass), center, inertia, part.flat, _columns(part, chain))


def _weight(inertial: Inertial, T: Array) -> tuple[float, Array, Array]:
    """Mass, centre and inertia about it, seen through a transform."""
    T = T @ placement(inertial.origin.xyz, inertial.origin.rpy)
    ixx, ixy, ixz, iyy, iyz, izz = inertial.inertia
    tensor = np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])
    return inertial.mass, T[:3, 3], T[:3, :3] @ tensor @ T[:3, :3].T


def _columns(part: Chain, chain: Chain) -> Indices:
    return np.array([chain.joint_names.index(name) for name in part.joint_names], dtype=np.int64)


@dataclass(frozen=True, slots=True, eq=False)
class Motions:
    """Bodies at N configurations, in the axes of the root; B bodies, n variables.

    Attributes:
        masses: Shape (B,), [kg].
        centers: Centres of mass in the root; shape (N, B, 3), [m].
        inertias: About these; shape (N, B, 3, 3), [kg m²].
        linear: J_v of the centres; shape (N, B, 3, n).
        angular: J_ω; shape (N, B, 3, n).
        speeds: q̇; shape (N, n), where rates were requested.
        linear_rates: J̇_v at q̇; shape (N, B, 3, n).
        angular_rates: J̇_ω at q̇; shape (N, B, 3, n).
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
        """M; shape (N, n, n), [kg m²], [kg m] or [kg]."""
        return _summed(self.linear, self._momenta()) + _summed(self.angular, self.inertias @ self.angular)

    def velocity_products(self) -> Array:
        """S; shape (N, n, n): S q̇ are the Coriolis and centrifugal torques, S + Sᵀ is Ṁ."""
        omegas = self.angular @ self.speeds[:, None, :, None]
        turning = _skew(omegas[..., 0]) @ (self.inertias @ self.angular)
        return _summed(self.linear, self.masses[:, None, None] * self.linear_rates) + _summed(
            self.angular, self.inertias @ self.angular_rates + turning
        )

    def gravity_torques(self, gravity: Array) -> Array:
        """g: what holds the bodies against a gravity (3,) [m/s²] in the root's axes; shape (N, n), [N m or N]."""
        torques: Array = -np.einsum("kbcj,c->kj", self._momenta(), gravity)
        return torques

    def potential_energies(self, gravity: Array) -> Array:
        """U, zero where the centre of mass is level with the root; shape (N,), [J]."""
        energies: Array = -(self.masses @ self.centers) @ gravity
        return energies

    def mass_scale(self) -> float:
        """The largest term of the sums that M is, about the root's origin too, to which rounding is relative."""
        turning = (
            np.abs(self.inertias).max(axis=(2, 3), initial=0.0)
            * np.abs(self.angular).max(axis=(2, 3), initial=0.0) ** 2
        )
        return float((self.masses * self._speeds() ** 2 + turning).max(initial=0.0))

    def gravity_scale(self, gravity: Array) -> float:
        """The size of gravity torques, for relative errors, [N m or N]."""
        return float((self.masses * self._speeds()).max(initial=0.0) * np.abs(gravity).max())

    def _speeds(self) -> Array:
        """Largest entries of J_v, of the centre of mass and of what moves through the root's origin; shape (N, B)."""
        turning = np.abs(self.angular).max(axis=(2, 3), initial=0.0) * np.abs(self.centers).max(axis=2)
        speeds: Array = np.abs(self.linear).max(axis=(2, 3), initial=0.0) + turning
        return speeds

    def _momenta(self) -> Array:
        momenta: Array = self.masses[:, None, None] * self.linear
        return momenta


def motions(carried: Sequence[Body], qs: Array, speeds: Array | None = None) -> Motions:
    """Positions and motions of the bodies.

    Args:
        carried: The bodies.
        qs: Configurations of the chain; shape (N, n), [rad or m].
        speeds: q̇, where rates of the Jacobians are wanted; shape (N, n).
    """
    shape = len(qs), len(carried), 6, qs.shape[1]
    Js, rates = np.zeros(shape), np.zeros(shape if speeds is not None else (0,) * 4)
    positions, rotations = np.empty((*shape[:2], 3)), np.empty((*shape[:2], 3, 3))
    for b, body in enumerate(carried):
        part = np.ascontiguousarray(qs[:, body.columns])
        positions[:, b], rotations[:, b], Js[:, b, :, body.columns] = _placed(body, part)
        if speeds is not None:
            Hs = chain_hessians(body.flat, part)
            along = Hs @ speeds[:, None, body.columns, None]
            rates[:, b, :, body.columns] = along[..., 0].transpose(2, 0, 1)
    masses = np.array([body.mass for body in carried])
    tensors = np.array([body.inertia for body in carried]).reshape(-1, 3, 3)
    levers = np.einsum("kbij,bj->kbi", rotations, np.array([body.center for body in carried]).reshape(-1, 3))
    linear, angular = Js[:, :, :3], Js[:, :, 3:]
    # ω × r = [r]×ᵀ ω, column by column.
    across = _skew(levers).swapaxes(2, 3)
    linear = linear + across @ angular
    linear_rates, angular_rates = rates[:, :, :3], rates[:, :, 3:]
    if speeds is not None:
        lever_rates = across @ (angular @ speeds[:, None, :, None])
        linear_rates = linear_rates + across @ angular_rates + _skew(lever_rates[..., 0]).swapaxes(2, 3) @ angular
    inertias = rotations @ tensors @ rotations.swapaxes(2, 3)
    still = speeds if speeds is not None else np.zeros_like(qs)
    return Motions(masses, positions + levers, inertias, linear, angular, still, linear_rates, angular_rates)


def _placed(body: Body, part: Array) -> tuple[Array, Array, Array]:
    """Position, rotation and Jacobian of a body's frame; the Jacobian with its columns first, as indexing wants it."""
    positions, rotations, Js = chain_jacobians(body.flat, part)
    return positions, rotations, Js.transpose(2, 0, 1)


def _skew(vectors: Array) -> Array:
    """[r]×, so that [r]× a = r × a; shape (…, 3) → (…, 3, 3)."""
    matrices: Array = (vectors @ _SKEW).reshape(*vectors.shape, 3)
    return matrices


def _summed(left: Array, right: Array) -> Array:
    """Σ_b leftᵀ right over the bodies; shapes (N, B, 3, n)."""
    count, number, _, n = left.shape
    total: Array = left.reshape(count, 3 * number, n).swapaxes(1, 2) @ right.reshape(count, 3 * number, n)
    return total
