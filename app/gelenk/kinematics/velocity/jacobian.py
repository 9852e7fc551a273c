"""Jacobians of a chain in three reference frames, geometric or analytic, with their derivatives.

The kernels give the course's geometric Jacobian (base axes, at the tip) and its ∂J/∂q; everything else follows
from these two by the product rule. J̇ = Σ_j ∂J/∂q_j q̇_j throughout.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

import numpy as np

from gelenk.errors import RepresentationSingularity
from gelenk.kinematics.judge.judge import certify_jacobians
from gelenk.kinematics.judge.words import JacobianCertificate, Reference, Screws, View
from gelenk.kinematics.simd.kernels import chain_hessians, chain_jacobians
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.notations import rpy_from_rotations, zyz_from_rotations
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel

Representation: TypeAlias = Literal["geometric", "zyz", "rpy"]

REPRESENTATION_TOLERANCE = 1e-6
"""|sin θ| (ZYZ) or |cos pitch| (RPY) below which Euler rates are refused: they would lose half of their digits."""


@dataclass(frozen=True, slots=True)
class Jacobians:
    """Jacobians at N configurations, linear rows before angular, one column per variable of the chain.

    Attributes:
        poses: T_base_tip.
        values: J; shape (N, 6, n), [m or rad per rad or m].
        hessians: H[:, k, i, j] = ∂J[k, i]/∂q_j; shape (N, 6, n, n). None if not requested.
    """

    poses: Poses
    values: Array
    hessians: Array | None
    certificate: JacobianCertificate

    def time_variations(self, velocities: Array) -> Array:
        """Compute J̇ at joint velocities (N, n), [rad/s or m/s]; shape (N, 6, n). Needs the Hessians."""
        if self.hessians is None:
            raise ValueError("time variation needs the Hessians")
        return np.asarray(np.einsum("bkij,bj->bki", self.hessians, velocities))


def jacobians(
    robot: RobotModel,
    chain: Chain,
    qs: Array,
    *,
    reference: Reference | Screws = "local_world_aligned",
    representation: Representation = "geometric",
    derivatives: bool = False,
) -> Jacobians:
    """Compute and certify Jacobians of a chain.

    Args:
        qs: Configurations in the chain's order; shape (N, n), [rad or m].
        reference: `local_world_aligned`: base axes, at the tip (the course's). `local`: tip axes, at the tip.
            `world`: base axes, at the point of the tip's body that coincides with the base origin (the spatial twist).
            `space_screws`, `body_screws`: `world` and `local` with the angular rows first [LynchPark2017, ch. 5].
        representation: `geometric`: angular rows give ω. `zyz`, `rpy`: they give the rates of these angles, which
            are the same in every reference frame; the linear rows are those of `local_world_aligned`.
        derivatives: Whether to compute the Hessians too.

    Raises:
        RepresentationSingularity: The Euler rates do not exist at a configuration.
        CertificationFailed: Pinocchio's Jacobians differ by more than rounding.
    """
    positions, rotations, Js = chain_jacobians(chain.flat, qs)
    Hs = chain_hessians(chain.flat, qs) if derivatives else None
    poses = Poses(positions, rotations)
    view: View = reference if representation == "geometric" else representation
    if representation == "geometric":
        values, derivative = in_reference(poses, Js, Hs, reference)
    else:
        values, derivative = _analytic(representation, poses, Js, Hs)
    certificate = certify_jacobians(robot, chain, qs, Js, Hs, view, values)
    return Jacobians(poses, values, derivative, certificate)


def singular_values(Js: Array) -> Array:
    """Return σ of each Jacobian, largest first; shape (N, 6, n) → (N, min(6, n)). Metres and radians are mixed."""
    return np.asarray(np.linalg.svd(Js, compute_uv=False))


def ranks(sigmas: Array, tolerance: float) -> Indices:
    """Count the singular values above `tolerance` times the largest; shape (N, k) → (N,)."""
    if sigmas.shape[1] == 0:
        return np.zeros(len(sigmas), dtype=np.int64)
    return np.asarray(np.sum((sigmas > tolerance * sigmas[:, :1]) & (sigmas > 0.0), axis=1))


def condition_numbers(sigmas: Array, counts: Indices) -> list[float | None]:
    """Return σ_max / σ_min for singular values of shape (N, k) and ranks of shape (N,); None where not all count."""
    full = sigmas.shape[1]
    return [
        float(sigma[0] / sigma[-1]) if full and rank == full else None
        for sigma, rank in zip(sigmas, counts, strict=True)
    ]


def in_reference(
    poses: Poses, Js: Array, Hs: Array | None, reference: Reference | Screws
) -> tuple[Array, Array | None]:
    """Express geometric Jacobians in the base's axes at the tip, and their derivatives, in a reference of `jacobians`.

    The shapes are (N, 6, n) and (N, 6, n, n); derivatives are None if not requested.
    """
    if reference in get_args(Screws):
        J, H = in_reference(poses, Js, Hs, "world" if reference == "space_screws" else "local")
        return np.roll(J, 3, axis=1), None if H is None else np.roll(H, 3, axis=1)
    if reference == "local":
        return _in_tip_axes(poses, Js, Hs)
    return _at_base_origin(poses, Js, Hs) if reference == "world" else (Js, Hs)


def _in_tip_axes(poses: Poses, Js: Array, Hs: Array | None) -> tuple[Array, Array | None]:
    """J' = diag(Rᵀ, Rᵀ) J, and ∂J' = diag(Rᵀ, Rᵀ)(∂J - ω_j × J), because ∂Rᵀ/∂q_j = -Rᵀ [ω_j]×."""

    def turned(linear: Array, angular: Array) -> Array:
        halves = [np.einsum("brk,br...->bk...", poses.rotations, rows) for rows in (linear, angular)]
        return np.concatenate(halves, axis=1)

    linear, angular = Js[:, :3], Js[:, 3:]
    if Hs is None:
        return turned(linear, angular), None
    carried = [np.cross(angular[:, :, None], rows[:, :, :, None], axis=1) for rows in (linear, angular)]
    return turned(linear, angular), turned(Hs[:, :3] - carried[0], Hs[:, 3:] - carried[1])


def _at_base_origin(poses: Poses, Js: Array, Hs: Array | None) -> tuple[Array, Array | None]:
    """J' with v' = v + p × ω, and ∂v' = ∂v + v_j × ω + p × ∂ω, because ∂p/∂q_j = v_j."""
    world = Js.copy()
    world[:, :3] += np.cross(poses.positions[:, :, None], Js[:, 3:], axis=1)
    if Hs is None:
        return world, None
    derivative = Hs.copy()
    derivative[:, :3] += np.cross(Js[:, :3, None, :], Js[:, 3:, :, None], axis=1)
    derivative[:, :3] += np.cross(poses.positions[:, :, None, None], Hs[:, 3:], axis=1)
    return world, derivative


def _analytic(representation: Representation, poses: Poses, Js: Array, Hs: Array | None) -> tuple[Array, Array | None]:
    """Angular rows as rates of Euler angles: E J' = J_ω where ω = E(φ) φ̇, so E ∂J' = ∂J_ω - (∂E) J'."""
    E, dE = _zyz_rates(poses.rotations) if representation == "zyz" else _rpy_rates(poses.rotations)
    analytic = Js.copy()
    analytic[:, 3:] = np.linalg.solve(E, Js[:, 3:])
    if Hs is None:
        return analytic, None
    # ∂E/∂q_j = Σ_m ∂E/∂φ_m ∂φ_m/∂q_j, and ∂φ_m/∂q_j is the analytic Jacobian itself.
    turning = np.einsum("bmkl,bmj,bli->bkij", dE, analytic[:, 3:], analytic[:, 3:])
    derivative = Hs.copy()
    count, n = len(Js), Js.shape[2]
    flat = (Hs[:, 3:] - turning).reshape(count, 3, n * n)
    derivative[:, 3:] = np.linalg.solve(E, flat).reshape(count, 3, n, n)
    return analytic, derivative


def _zyz_rates(rotations: Array) -> tuple[Array, Array]:
    """E(φ, θ, ψ) with ω = E (φ̇, θ̇, ψ̇), shape (N, 3, 3), and its derivative by each angle, shape (N, 3, 3, 3)."""
    phi, theta, _ = zyz_from_rotations(np.ascontiguousarray(rotations)).T
    _refuse_singular("zyz", "theta", theta, np.sin(theta))
    c1, s1, c2, s2 = np.cos(phi), np.sin(phi), np.cos(theta), np.sin(theta)
    o, one = np.zeros_like(phi), np.ones_like(phi)
    E = _matrices([[o, -s1, c1 * s2], [o, c1, s1 * s2], [one, o, c2]])
    by_phi = _matrices([[o, -c1, -s1 * s2], [o, -s1, c1 * s2], [o, o, o]])
    by_theta = _matrices([[o, o, c1 * c2], [o, o, s1 * c2], [o, o, -s2]])
    return E, np.stack((by_phi, by_theta, np.zeros_like(E)), axis=1)


def _rpy_rates(rotations: Array) -> tuple[Array, Array]:
    """E(roll, pitch, yaw) and its derivatives; shapes as in `_zyz_rates`."""
    _, pitch, yaw = rpy_from_rotations(np.ascontiguousarray(rotations)).T
    _refuse_singular("rpy", "pitch", pitch, np.cos(pitch))
    cp, sp, cy, sy = np.cos(pitch), np.sin(pitch), np.cos(yaw), np.sin(yaw)
    o, one = np.zeros_like(yaw), np.ones_like(yaw)
    E = _matrices([[cy * cp, -sy, o], [sy * cp, cy, o], [-sp, o, one]])
    by_pitch = _matrices([[-cy * sp, o, o], [-sy * sp, o, o], [-cp, o, o]])
    by_yaw = _matrices([[-sy * cp, -cy, o], [cy * cp, -sy, o], [o, o, o]])
    return E, np.stack((np.zeros_like(E), by_pitch, by_yaw), axis=1)


def _matrices(rows: list[list[Array]]) -> Array:
    return np.moveaxis(np.array(rows), -1, 0)


def _refuse_singular(representation: str, angle: str, values: Array, determinants: Array) -> None:
    singular = np.abs(determinants) < REPRESENTATION_TOLERANCE
    if singular.any():
        index = int(np.argmax(singular))
        raise RepresentationSingularity(representation, angle, float(values[index]), index)
