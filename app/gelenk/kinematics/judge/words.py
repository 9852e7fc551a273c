"""Names of reference frames, and the certificates of answers; without the code that computes these."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.robot.result import Result

Reference: TypeAlias = Literal["local_world_aligned", "local", "world"]
"""Axes and point of a motion of the tip: the base's axes at the tip, the tip's, or the base's at its own origin."""
Screws: TypeAlias = Literal["space_screws", "body_screws"]
"""The Jacobians of the product of exponentials: those of `world` and `local` with the angular rows first."""
View: TypeAlias = Reference | Screws | Literal["zyz", "rpy"]
"""Reference frame of a Jacobian, or the Euler angles whose rates its angular rows give."""

Term: TypeAlias = Literal["mass_matrix", "coriolis_matrix", "coriolis_torques", "gravity_torques", "energies"]
"""A term of the equations of motion."""


@dataclass(frozen=True)  # without slots, which orjson reads three times as slowly
class PoseCertificate(Result):
    """Differences of these poses from those computed through Pinocchio.

    Attributes:
        samples: Configurations that were recomputed: all of a small batch.
        max_position_error: Largest distance, [m].
        max_orientation_error: Largest angle, [rad].
        seed: Random seed of the sampling.
    """

    samples: int
    max_position_error: float
    max_orientation_error: float
    seed: int

    @classmethod
    def of_all(cls, parts: Sequence["PoseCertificate"]) -> "PoseCertificate":
        """Return the certificate of several batches together, at least one."""
        return PoseCertificate(
            sum(one.samples for one in parts),
            max(one.max_position_error for one in parts),
            max(one.max_orientation_error for one in parts),
            parts[0].seed,
        )


@dataclass(frozen=True)
class WorkspaceCertificate(PoseCertificate):
    """Differences of the results at a sample of the configurations from Pinocchio's.

    Attributes:
        samples: Configurations that were recomputed, spread over all of them.
        seed: Random seed of the choice among the samples.
        max_jacobian_error: Largest difference of an entry, [m or rad] per [rad or m].
        max_measure_error: Largest difference of a measure from the product of singular values of that Jacobian; as
            those.
    """

    max_jacobian_error: float
    max_measure_error: float


@dataclass(frozen=True, slots=True)
class JacobianCertificate(Result):
    """Differences of these Jacobians from those computed through Pinocchio.

    Attributes:
        samples: Configurations that were recomputed: all of a small batch.
        max_error: Largest difference of an entry, of the geometric Jacobian and of the one that is sent, [m or rad] per
            [rad or m].
        max_time_variation_error: Largest difference of an entry of the geometric dJ/dt at random joint velocities,
            [m or rad] per [rad or m] and second; null if no derivative was requested.
        seed: Random seed of the sampling.
    """

    samples: int
    max_error: float
    max_time_variation_error: float | None
    seed: int


@dataclass(frozen=True, slots=True)
class EllipsoidCertificate(JacobianCertificate):
    """Differences of the Jacobians from Pinocchio's, and of the ellipsoids from the Jacobians.

    Attributes:
        max_ellipsoid_error: Largest difference of an entry between JJᵀ and Σ u_i σ_i² u_iᵀ, relative to the largest σ²
            or the square of the largest entry of the whole Jacobian; no unit. It also bounds the motion in a direction
            reported as having none.
    """

    max_ellipsoid_error: float


@dataclass(frozen=True, slots=True)
class SingularityCertificate(JacobianCertificate):
    """Differences of the Jacobians from Pinocchio's, and products of those with the reported motions and directions.

    Attributes:
        max_internal_motion: Largest ‖J v‖ over the internal motions v of the same configurations, J the rows that count
            of Pinocchio's Jacobian: rounding, or what `rank_tolerance` lets pass; in the unit of the singular values.
        max_lost_direction: Largest ‖uᵀ J‖ over the lost directions u, unit vectors of these rows; likewise.
    """

    max_internal_motion: float
    max_lost_direction: float


@dataclass(frozen=True, slots=True)
class TipMotionCertificate(Result):
    """Differences of the tip's motion from the one computed through Pinocchio.

    The snap is compared with a difference quotient of Pinocchio's jerk, which is itself accurate to about nine digits.

    Attributes:
        samples: Configurations that were recomputed: all of a small batch.
        max_twist_error: Largest difference of an entry, [m/s or rad/s].
        max_acceleration_error: The same, [m/s² or rad/s²]; null where there is none.
        max_spatial_acceleration_error: The same, [m/s² or rad/s²]; null where there is none.
        max_jerk_error: The same, [m/s³ or rad/s³]; null where there is none.
        max_snap_error: The same, [m/s⁴ or rad/s⁴]; null where there is none.
        seed: Random seed of the sampling.
    """

    samples: int
    max_twist_error: float
    max_acceleration_error: float | None
    max_spatial_acceleration_error: float | None
    max_jerk_error: float | None
    max_snap_error: float | None
    seed: int


@dataclass(frozen=True, slots=True)
class StaticsCertificate(Result):
    """Differences of these torques from Pinocchio's.

    Attributes:
        samples: Configurations that were recomputed: all of a small batch.
        max_torque_error: Largest difference from Newton-Euler at rest with the wrench as an external force, [N m or N].
        max_virtual_work_error: Largest |τᵀq̇ - γᵀv| at random joint velocities q̇, the tip's twist v by Pinocchio, [W].
        seed: Random seed of the samples and velocities.
    """

    samples: int
    max_torque_error: float
    max_virtual_work_error: float
    seed: int


@dataclass(frozen=True, slots=True)
class DynamicsCertificate(Result):
    """Differences of these numbers from sums over the bodies by our own Jacobians; null if not requested.

    Attributes:
        samples: Configurations that were recomputed: all of a small batch.
        max_mass_error: Of M = Σ m J_vᵀJ_v + J_ωᵀIJ_ω, [kg m², kg m or kg].
        max_coriolis_error: Of C q̇, [N m or N].
        max_skew_error: Of C + Cᵀ - dM/dt, which is zero where dM/dt - 2C is skew, [kg m², kg m or kg] per second.
        max_gravity_error: Of g = -Σ m J_vᵀg₀, [N m or N].
        max_energy_error: Of kinetic and potential energy, [J].
        max_torque_error: Of M q̈ + C q̇ + g + Jᵀγ - τ, [N m or N].
        max_round_trip_error: Of the torques that inverse dynamics give for the accelerations of forward dynamics,
            [N m or N].
        seed: Random seed of the sampling.
    """

    samples: int
    max_mass_error: float | None
    max_coriolis_error: float | None
    max_skew_error: float | None
    max_gravity_error: float | None
    max_energy_error: float | None
    max_torque_error: float | None
    max_round_trip_error: float | None
    seed: int
