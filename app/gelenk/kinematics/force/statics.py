"""Statics: joint torques, the wrench that the tip exerts, and the four subspaces of the Jacobian between them.

By the principle of virtual work τᵀq̇ = γᵀJq̇ for every q̇, so τ = Jᵀγ: J maps joint to tip velocities, and Jᵀ maps
wrenches to torques. The motors of a robot with mass also hold its weight, τ = Jᵀγ + g(q).

A wrench and its dual twist refer to the same point and axes, so γᵀv is a power. The twist is that of the tip's body
relative to the base, at the body point that coincides with the given point, so τ = Jᵀγ for any point.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.errors import InvalidField
from gelenk.kinematics.dynamics.bodies import Load, motions
from gelenk.kinematics.dynamics.mechanism import PinocchioDynamics, mechanism
from gelenk.kinematics.judge.judge import Differences, largest, pinocchio_poses, sampled_rows
from gelenk.kinematics.judge.words import Reference, StaticsCertificate
from gelenk.kinematics.simd.kernels import chain_jacobians, chain_poses
from gelenk.kinematics.velocity.subspaces import Subspaces, subspaces
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel


@dataclass(frozen=True, slots=True)
class WrenchFrame:
    """Axes and point of a wrench.

    Attributes:
        reference: `local_world_aligned`: base axes, at the tip. `local`: tip axes, at the tip. `world`: base axes, at
            the base origin.
        expressed_in: Frame whose axes replace those of the reference.
        point: Point that replaces that of the reference, in coordinates of `point_frame`, [m].
        point_frame: Frame of `point`; the tip if None.
    """

    reference: Reference = "local_world_aligned"
    expressed_in: str | None = None
    point: Sequence[float] | None = None
    point_frame: str | None = None

    def check(self) -> None:
        """Refuse contradictory fields: raises InvalidField if one needs or excludes another."""
        if self.expressed_in is not None and self.reference != "local_world_aligned":
            raise InvalidField("expressed_in", "it names the axes itself, so no other `reference` may be given")
        if self.point is not None and self.reference == "world":
            raise InvalidField("point", "not allowed with `world`, which takes the origin of the base")
        if self.point_frame is not None and self.point is None:
            raise InvalidField("point_frame", "it needs `point`")

    def poses(self, chain: Chain, poses_of: Callable[[str], Poses]) -> Poses:
        """Return point and axes in the base frame; `poses_of` gives the poses of a named frame in the base."""
        tip = poses_of(chain.tip_frame)
        points, axes = tip.positions, tip.rotations
        if self.reference != "local":
            axes = np.broadcast_to(np.eye(3), axes.shape)
        if self.reference == "world":
            points = np.zeros_like(points)
        if self.expressed_in is not None:
            axes = poses_of(self.expressed_in).rotations
        if self.point is not None:
            frame = tip if self.point_frame is None else poses_of(self.point_frame)
            points = frame.positions + frame.rotations @ np.array(self.point)
        return Poses(points, axes)


def frame_jacobians(robot: RobotModel, chain: Chain, qs: Array, frame: WrenchFrame) -> tuple[Poses, Array, Array]:
    """Compute the pose of a wrench frame, and the Jacobian in it; joints off the chain are at zero.

    Returns:
        Point and axes in the base frame, Jacobians of shape (N, 6, n), linear before angular, and the terms of their
        linear rows, to which rounding is relative, of shape (N, 3, n).
    """
    frame.check()
    positions, rotations, Js = chain_jacobians(chain.flat, qs)
    tip = Poses(positions, rotations)

    def poses_of(name: str) -> Poses:
        if name == chain.tip_frame:
            return tip
        found = mechanism(robot, chain)
        part, columns = found.robot.frame_on(found.chain, name)
        return Poses(*chain_poses(part.flat, np.ascontiguousarray(qs[:, columns])))

    places = frame.poses(chain, poses_of)
    if places.positions is not positions:
        levers = (places.positions - positions)[:, :, None]
        Js[:, :3] += np.cross(Js[:, 3:], levers, axis=1)
    far = np.linalg.norm(positions, axis=1) + np.linalg.norm(places.positions, axis=1)
    terms = Js[:, 3:] * far[:, None, None]
    inverse = places.rotations.swapaxes(1, 2)
    return places, np.concatenate((inverse @ Js[:, :3], inverse @ Js[:, 3:]), axis=1), terms


def in_base_axes(places: Poses, rows: Indices, wrenches: Array) -> Array:
    """Expand wrenches to six components and rotate them into the base's axes; shape (N, m) → (N, 6)."""
    full = np.zeros((len(wrenches), 6))
    full[:, rows] = wrenches
    return np.asarray(np.einsum("kij,kpj->kpi", places.rotations, full.reshape(-1, 2, 3)).reshape(-1, 6))


_NUMBERS_AT_ONCE = 1_000_000
"""Largest number of entries of the bodies' Jacobians held in memory at once."""


@dataclass(frozen=True, slots=True, eq=False)
class Statics:
    """A robot at rest at N configurations.

    Attributes:
        qs: Configurations; shape (N, n), [rad or m].
        frame: Axes and point of twists and wrenches.
        rows: Indices of their components that count; shape (m,).
        places: Poses of this frame in the base.
        Js: The rows of the Jacobian in this frame that count; shape (N, m, n).
        terms: All rows, and the terms of the linear ones: values within their rounding are zero; shape (N, 9, n).
        gravity: Gravity in the root's axes, [m/s²]; None if weight is ignored.
        gravity_torques: g(q), zero if weight is ignored; shape (N, n), [N m or N].
        gravity_scale: Largest term in the sums for g, [N m or N].
    """

    robot: RobotModel
    chain: Chain
    qs: Array
    frame: WrenchFrame
    rows: Indices
    places: Poses
    Js: Array
    terms: Array
    gravity: Array | None
    load: Load | None
    gravity_torques: Array
    gravity_scale: float

    def wrench_torques(self, wrenches: Array) -> Array:
        """Compute Jᵀγ; shape (N, m) → (N, n), [N m or N]."""
        return np.asarray(np.einsum("kij,ki->kj", self.Js, wrenches))

    def subspaces(self, tolerance: float) -> list[Subspaces]:
        """Compute the four subspaces at each configuration."""
        return [subspaces(J, tolerance, terms) for J, terms in zip(self.Js, self.terms, strict=True)]


@dataclass(frozen=True, slots=True, eq=False)
class NearestWrench:
    """The least-squares wrenches of minimum norm for given joint torques.

    Attributes:
        wrenches: γ; shape (N, m), [N] and [N m].
        residuals: τ - g - Jᵀγ, which no wrench balances and which accelerates the robot; shape (N, n), [N m or N].
        splits: The four subspaces at each configuration; any vector of ker(Jᵀ) may be added to γ.
    """

    wrenches: Array
    residuals: Array
    splits: list[Subspaces]


def statics(
    robot: RobotModel,
    chain: Chain,
    qs: Array,
    frame: WrenchFrame | None = None,
    *,
    rows: Indices | None = None,
    gravity: Array | None = None,
    load: Load | None = None,
) -> Statics:
    """Compute the Jacobians of a robot at rest where the wrench acts, and the torques that hold its weight.

    Args:
        robot: The robot; joints off the chain are at zero, and their links have weight too.
        qs: Configurations; shape (N, n), [rad or m].
        frame: Axes and point of the wrench; at the tip if None.
        rows: Indices of the wrench components that count; shape (m,). All if None.
        gravity: Gravity in the axes of the robot's root; shape (3,), [m/s²]. None to ignore weight.
        load: A payload on the tip; ignored without gravity.

    Raises:
        UnknownFrame: The robot has no such frame.
        InvalidField: The fields of the frame are contradictory.
    """
    frame, rows = frame or WrenchFrame(), np.arange(6) if rows is None else rows
    places, Js, sums = frame_jacobians(robot, chain, qs, frame)
    torques, scale = np.zeros_like(qs), 0.0
    if gravity is not None and len(chain):
        carried = mechanism(robot, chain).carried(load)
        size = max(1, _NUMBERS_AT_ONCE // (6 * len(carried) * len(chain)))
        for first in range(0, len(qs), size):
            moving = motions(carried, qs[first : first + size])
            torques[first : first + size] = moving.gravity_torques(gravity)
            scale = max(scale, moving.gravity_scale(gravity))
    terms = np.concatenate((Js, sums), axis=1)
    return Statics(robot, chain, qs, frame, rows, places, Js[:, rows], terms, gravity, load, torques, scale)


def balance(still: Statics, torques: Array, tolerance: float) -> NearestWrench:
    """Compute the wrench for given joint torques: γ = (Jᵀ)#(τ - g), which is J⁻ᵀ(τ - g) if J is square and regular.

    Args:
        torques: Torques of the motors; shape (N, n), [N m or N].
        tolerance: A singular value counts if it exceeds this times the largest.
    """
    splits = still.subspaces(tolerance)
    wanted = torques - still.gravity_torques
    wrenches = np.zeros((len(torques), len(still.rows)))
    for k, split in enumerate(splits):
        wrenches[k] = split.range @ ((split.row_space.T @ wanted[k]) / split.sigmas[: split.rank])
    return NearestWrench(wrenches, wanted - still.wrench_torques(wrenches), splits)


def components(
    inside: Array, outside: Array, vector: Array, tolerance: float
) -> tuple[Array, Array, tuple[bool, bool]]:
    """Split a vector into its components in two complementary orthogonal subspaces, given by orthonormal columns.

    Also return whether it lies in the first and in the second: it does if its other component is at most `tolerance`
    times its length. A zero vector lies in both.
    """
    first, second = inside @ (inside.T @ vector), outside @ (outside.T @ vector)
    most = tolerance * float(np.linalg.norm(vector))
    return first, second, (float(np.linalg.norm(second)) <= most, float(np.linalg.norm(first)) <= most)


def overloaded_joints(robot: RobotModel, chain: Chain, torques: Array) -> list[list[str]]:
    """List the joints whose torque exceeds the effort limit, per configuration; a limit of zero means no limit.

    The torques have shape (N, n), [N m or N].
    """
    given = (robot.description.joint[name].limits.effort for name in chain.joint_names)
    limits = np.array([limit or np.inf for limit in given])
    beyond = np.abs(torques) > limits
    found: list[list[str]] = [[] for _ in torques]
    for row, column in np.argwhere(beyond).tolist():
        found[row].append(chain.joint_names[column])
    return found


def certify_statics(still: Statics, wrenches: Array, torques: Array, seed: int = 0) -> StaticsCertificate:
    """Compare torques that hold the robot while its tip exerts a wrench with Pinocchio's; raises if they differ.

    Args:
        wrenches, torques: At the tip, shape (N, m), and of the joints, including weight, shape (N, n).
        seed: Seed of the sample selection, the joint velocities and a random wrench that tests the whole Jacobian.
    """
    robot, chain, qs = still.robot, still.chain, still.qs
    rows = sampled_rows(len(qs) if len(chain) else 0, seed)
    if not rows:
        return StaticsCertificate(0, 0.0, 0.0, seed)
    rng = np.random.default_rng(seed)
    found = mechanism(robot, chain)
    places = still.frame.poses(chain, lambda name: pinocchio_poses(found.robot, found.chain, name, qs, rows))
    gravity = np.zeros(3) if still.gravity is None else still.gravity
    judge = PinocchioDynamics(found, gravity, still.load)
    others = rng.uniform(-1.0, 1.0, (len(rows), len(still.rows)))
    by_others = np.einsum("kij,ki->kj", still.Js[rows], others) + still.gravity_torques[rows]
    worst = Differences()
    for given, held in ((wrenches[rows], torques[rows]), (others, by_others)):
        in_base = in_base_axes(places, still.rows, given)
        for k, row in enumerate(rows):
            q_dot = rng.uniform(-1.0, 1.0, len(chain))
            expected, power = judge.static_torques(qs[row], q_dot, places.positions[k], in_base[k])
            # The largest terms of the torques: here, or through the wrench's moment about the base's origin.
            by_wrench = largest(np.abs(still.Js[row].T) @ np.abs(given[k]))
            scale = max(by_wrench, largest(given[k]) * (1.0 + largest(places.positions[k])), still.gravity_scale)
            worst.add("max_torque_error", "a torque", held[k] - expected, scale)
            work = (held[k] - still.gravity_torques[row]) @ q_dot - power
            worst.add("max_virtual_work_error", "the virtual work", work, scale * len(chain))
    return StaticsCertificate(samples=len(rows), seed=seed, **worst)
