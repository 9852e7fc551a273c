"""Largest velocities and forces of the tip with every joint within its limits, per configuration and direction.

They lie in polytopes, which ellipsoids only approximate. Velocities {Jq̇ : |q̇_i| ≤ q̇max_i} form a zonotope, a sum of
segments, one per joint. Forces {F : |J_iᵀF| ≤ τmax_i}, whose torques are within the limits, form an intersection of
strips. Both are symmetric about zero. All results are exact, in coordinates of range(J), where J of shape (r, n) has
full rank r ≤ 3: each facet of a zonotope is parallel to r - 1 of its segments, and a linear programme over strips has
its optimum where r of them are tight [Ziegler1995].
"""

import math
from dataclasses import dataclass
from itertools import combinations
from typing import cast

import numpy as np

from gelenk.errors import TooLarge
from gelenk.kinematics.ellipsoids.manipulability import Ellipsoids, is_within_task
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel

_PARALLEL = 1e-12
"""Sine of the angle, or determinant of unit vectors, below which directions count as dependent."""
_NEXT_TO_NOTHING = 1e-14
"""A column shorter than this share of the longest is rounding."""
_ON = 1e-9
"""Tolerance for rounding of a vertex outside a strip, as a share of its half-width."""


def largest_velocities(J: Array, limits: Array, directions: Array) -> Array:
    """Compute the largest speed purely along each direction, where the ray leaves the zonotope; shape (D,).

    Args:
        J: Jacobian in coordinates of its range; shape (r, n), r ≥ 1.
        limits: q̇max > 0; shape (n,).
        directions: Unit vectors in these coordinates; shape (D, r).
    """
    normals = _normals(J)
    offsets = np.abs(normals @ J) @ limits
    slopes = np.abs(directions @ normals.T)
    return np.asarray(np.divide(offsets, slopes, out=np.full_like(slopes, np.inf), where=slopes > 0.0).min(axis=1))


def largest_velocity_components(J: Array, limits: Array, directions: Array) -> Array:
    """Compute the largest velocity component along each direction: the support function Σ q̇max_i |J_iᵀu|; (D,)."""
    return np.asarray(np.abs(directions @ J) @ limits)


def largest_forces(J: Array, limits: Array, directions: Array) -> Array:
    """Compute the largest force purely along each direction, NaN where it loads no joint; shape (D,).

    The arguments are those of `largest_velocities`, with limits τmax > 0.
    """
    torques = np.abs(directions @ J)
    felt = torques > _PARALLEL * np.linalg.norm(J, axis=0)
    forces = np.divide(limits, torques, out=np.full_like(torques, np.inf), where=felt).min(axis=1)
    return np.asarray(np.where(np.isfinite(forces), forces, np.nan))


def largest_force_components(J: Array, limits: Array, directions: Array) -> Array:
    """Compute the largest component along each direction of any force within the limits; shape (D,).

    By duality, max uᵀF over |J_iᵀF| ≤ τmax_i is the smallest Σ τmax_i |λ_i| with Jλ = u, which is attained where all
    but r of the λ_i are zero.
    """
    r, n = J.shape
    best = np.full(len(directions), np.inf)
    chosen = np.array(list(combinations(range(n), r)))
    columns = J.T[chosen].transpose(0, 2, 1)
    sizes = np.linalg.norm(columns, axis=1)
    shares = np.abs(np.linalg.det(columns)) > _PARALLEL * np.prod(sizes, axis=1)
    columns, weights = columns[shares], limits[chosen[shares]]
    for i, direction in enumerate(directions):
        multipliers = np.linalg.solve(columns, np.broadcast_to(direction[:, None], (len(columns), r, 1)))[:, :, 0]
        best[i] = np.min(np.sum(weights * np.abs(multipliers), axis=1))
    return best


def velocity_polygon(J: Array, limits: Array) -> Array:
    """Compute the vertices of the zonotope of a planar J, anticlockwise (its two ends if flat); (2, n) → (V, 2)."""
    segments = (J * limits).T[_felt(J)]
    below = (segments[:, 1] < 0.0) | ((segments[:, 1] == 0.0) & (segments[:, 0] < 0.0))
    segments[below] *= -1.0
    merged: list[Array] = []
    for segment in segments[np.argsort(np.arctan2(segments[:, 1], segments[:, 0]), kind="stable")]:
        if merged and _sine(merged[-1], segment) < _PARALLEL:
            merged[-1] = merged[-1] + segment
        else:
            merged.append(segment)
    # The first and the last segment may be parallel too, at angles 0 and π.
    if len(merged) > 1 and _sine(merged[0], merged[-1]) < _PARALLEL:
        merged[0] = merged[0] - merged.pop()
    if not merged:
        return np.zeros((1, 2))
    half = np.cumsum(2.0 * np.array(merged), axis=0) - np.sum(merged, axis=0)
    return np.concatenate((half, -half))


def force_polygon(J: Array, limits: Array) -> Array:
    """Compute the vertices of the force polytope of a planar J of rank 2, anticlockwise; shape (2, n) → (V, 2)."""
    strips = (J / limits).T[_felt(J)]
    corners = []
    for a, b in combinations(strips, 2):
        if _sine(a, b) < _PARALLEL:
            continue
        for signs in ((1.0, 1.0), (1.0, -1.0)):
            corner = np.linalg.solve(np.array([a, b]), np.array(signs))
            corners += [corner, -corner]
    vertices = np.array(corners)
    vertices = vertices[np.abs(vertices @ strips.T).max(axis=1) <= 1.0 + _ON]
    vertices = vertices[np.argsort(np.arctan2(vertices[:, 1], vertices[:, 0]), kind="stable")]
    apart = np.linalg.norm(vertices - np.roll(vertices, 1, axis=0), axis=1)
    return cast(Array, vertices[apart > _ON * np.linalg.norm(vertices, axis=1)])


def _normals(J: Array) -> Array:
    """Unit normals of the facets of the zonotope, one per parallel pair; shape (F, r)."""
    r = len(J)
    sizes = np.linalg.norm(J, axis=0)
    units = (J[:, sizes > 0.0] / sizes[sizes > 0.0]).T
    if r == 1:
        return np.ones((1, 1))
    if r == 2:
        return np.stack((-units[:, 1], units[:, 0]), axis=1)
    first, second = np.triu_indices(len(units), 1)
    normals = np.cross(units[first], units[second])
    sines = np.linalg.norm(normals, axis=1)
    apart = sines > _PARALLEL
    return cast(Array, normals[apart] / sines[apart, None])


def _felt(J: Array) -> Flags:
    """Which columns of a planar J are more than rounding, compared with the longest; shape (2, n) → (n,)."""
    lengths = np.linalg.norm(J, axis=0)
    return np.asarray(lengths > _NEXT_TO_NOTHING * lengths.max(initial=0.0))


def _sine(a: Array, b: Array) -> float:
    """|sin| of the angle between two plane vectors."""
    return float(abs(a[0] * b[1] - a[1] * b[0]) / (np.linalg.norm(a) * np.linalg.norm(b)))


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
