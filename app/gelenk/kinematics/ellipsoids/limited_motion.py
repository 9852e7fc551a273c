"""Largest velocities and forces of the tip with every joint within its limits, per configuration and direction."""

import math
from dataclasses import dataclass

import numpy as np

from gelenk.errors import TooLarge
from gelenk.kinematics.ellipsoids.manipulability import Ellipsoids, is_within_task
from gelenk.kinematics.ellipsoids.polytope import (
    force_polygon,
    largest_force_components,
    largest_forces,
    largest_velocities,
    largest_velocity_components,
    velocity_polygon,
)
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel

MAX_SUBSETS = 2_000_000
"""Largest number of sets of joints that one call examines, at a few microseconds each."""

_WITHIN = 1e-9


@dataclass(frozen=True, slots=True)
class JointBounds:
    """Symmetric limits of a chain's variables: q̇max [rad/s or m/s] and τmax [N m or N], (n,); NaN for no limit."""

    velocity: Array
    effort: Array


@dataclass(frozen=True, slots=True)
class LimitedMotion:
    """Velocities, [m/s] or [rad/s], and forces, [N] or [N m], within the joint limits at one configuration.

    Attributes:
        velocities: Largest velocity purely along each of D directions, and largest component along it; shape (D, 2).
            None if a joint has no velocity limit.
        velocity_vertices: Vertices of the velocity polytope if all motion stays in a plane, else None; shape (V, k).
            None also if a joint has no velocity limit.
        forces: Largest forces in the same way, NaN where unbounded; None if a joint has no effort limit.
        force_vertices: Vertices of the force polytope in the same way; None also if it is unbounded.
    """

    velocities: Array | None
    velocity_vertices: Array | None
    forces: Array | None
    force_vertices: Array | None


def joint_bounds(robot: RobotModel, chain: Chain) -> JointBounds:
    """Return the velocity and effort limits of the chain's variables from the robot's description."""
    limits = [robot.description.joint[name].limits for name in chain.joint_names]
    return JointBounds(
        np.array([np.nan if limit.velocity is None else limit.velocity for limit in limits], dtype=float),
        np.array([np.nan if limit.effort is None else limit.effort for limit in limits], dtype=float),
    )


def limited_motion(ellipsoids: Ellipsoids, Js: Array, bounds: JointBounds, directions: Array) -> list[LimitedMotion]:
    """Compute the tip's largest velocities and forces within the joint limits, one entry per configuration.

    Args:
        ellipsoids, Js: Ellipsoids of translation or of rotation, and their Jacobians; shape (N, 6, n).
        directions: Unit vectors in the axes of the Jacobians; shape (D, 3). Numbers for directions outside the task are
            meaningless.

    Raises:
        TooLarge: More sets of joints than `MAX_SUBSETS`.
    """
    space = ellipsoids.space
    work = len(Js) * len(directions) * math.comb(Js.shape[2], min(3, space.dimension))
    if work > MAX_SUBSETS:
        raise TooLarge("sets of joints, times directions and configurations", work, MAX_SUBSETS)
    along = directions[:, [row % 3 for row in space.rows]]
    inside = is_within_task(space, directions)
    entries = []
    for J, axes, sigmas in zip(Js[:, space.rows], ellipsoids.axes, ellipsoids.sigmas, strict=True):
        range_ = axes[:, sigmas > 0.0]
        entries.append(_at(J, range_, bounds, along, inside, space.basis if space.is_plane else None))
    return entries


def _at(
    J: Array, range_: Array, bounds: JointBounds, along: Array, inside: Flags, plane: Array | None
) -> LimitedMotion:
    """One configuration; the columns of `range_` span range(J), those of `plane` the plane of all motion."""
    reduced, shares = range_.T @ J, along @ range_
    moves = inside & (np.linalg.norm(along - shares @ range_.T, axis=1) <= _WITHIN)
    velocities = forces = velocity_vertices = force_vertices = None
    has_velocity, has_effort = not np.isnan(bounds.velocity).any(), not np.isnan(bounds.effort).any()
    if has_velocity:
        velocities = _velocities(reduced, bounds.velocity, shares, moves)
    if has_effort:
        forces = _forces(reduced, bounds.effort, shares, moves)
    if plane is not None:
        # In a lost direction only rounding is left, which would otherwise give the polygon a false width.
        flat = plane.T @ range_ @ reduced
        if has_velocity:
            velocity_vertices = velocity_polygon(flat, bounds.velocity) @ plane.T
        if has_effort and len(reduced) == 2:
            force_vertices = force_polygon(flat, bounds.effort) @ plane.T
    return LimitedMotion(velocities, velocity_vertices, forces, force_vertices)


def _velocities(J: Array, limits: Array, shares: Array, moves: Flags) -> Array:
    velocities = np.zeros((len(shares), 2))
    if len(J):
        velocities[moves, 0] = largest_velocities(J, limits, shares[moves])
        velocities[:, 1] = largest_velocity_components(J, limits, shares)
    return velocities


def _forces(J: Array, limits: Array, shares: Array, moves: Flags) -> Array:
    """A component is unbounded if part of it loads no joint; a pure force, if none of it loads a joint."""
    forces = np.full((len(shares), 2), np.nan)
    if len(J):
        forces[:, 0] = largest_forces(J, limits, shares)
        forces[moves, 1] = largest_force_components(J, limits, shares[moves])
    return forces
