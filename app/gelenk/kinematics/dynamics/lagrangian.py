"""The equations of motion as the Lagrangian's sums over the bodies, which check the results of `dynamics`."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from gelenk.kinematics.dynamics.bodies import Motions
from gelenk.kinematics.judge.judge import Differences, agreed, largest
from gelenk.robot.arrays import Array

SINGULAR = 1e-12
"""Smallest eigenvalue at or below which M counts as singular, once scaled to a unit diagonal: the scaling removes the
units, and accelerations would keep fewer than four digits."""
_ROUNDING = 1e-14
"""A diagonal entry of M below this share of the largest is rounding."""


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """N states of a chain, with the load of the wrench at its tip.

    Attributes:
        qs, speeds: Configurations and q̇; shape (N, n) each, [rad or m] and [rad/s or m/s].
        held: Jᵀγ, the torques that the wrench at the tip requires; shape (N, n), [N m or N].
    """

    qs: Array
    speeds: Array
    held: Array


def unit_scales(Ms: Array) -> Array:
    """Return the square roots of M's diagonal, zero where an entry is rounding; shape (N, n, n) → (N, n)."""
    diagonals = np.diagonal(Ms, axis1=1, axis2=2)
    least = _ROUNDING * diagonals.max(axis=1, initial=0.0, keepdims=True)
    return np.asarray(np.sqrt(np.where(diagonals > least, diagonals, 0.0)))


def scaled(Ms: Array, scales: Array) -> Array:
    """Divide rows and columns of M by scales, with zero where a scale is zero; shapes (N, n, n), (N, n)."""
    inverses = np.divide(1.0, scales, out=np.zeros_like(scales), where=scales > 0.0)
    return np.asarray(Ms * inverses[:, :, None] * inverses[:, None, :])


class Lagrangian:
    """The equations of motion by sums over bodies, which check other results; gravity is in the root's axes, [m/s²]."""

    def __init__(self, moving: Motions, state: State, gravity: Array) -> None:
        self._state, self._moving, self._gravity = state, moving, gravity
        self._Ms, self._Ss = moving.mass_matrices(), moving.velocity_products()
        self._by_speed = np.einsum("kij,kj->ki", self._Ss, state.speeds)
        self._by_gravity = moving.gravity_torques(gravity)
        fastest = largest(state.speeds)
        self._mass_scale = moving.mass_scale()
        self._speed_scale = self._mass_scale * fastest
        self._bias_scale = self._speed_scale * fastest
        self._gravity_scale = moving.gravity_scale(gravity)

    def is_definite(self) -> bool:
        """Return whether all M are positive definite beyond rounding."""
        values = np.linalg.eigvalsh(scaled(self._Ms, unit_scales(self._Ms)))
        return bool((values[:, 0] > SINGULAR).all())

    def scale(self, accelerations: Array) -> float:
        """Return the largest term of M q̈ + C q̇ + g + Jᵀγ, [N m or N]."""
        by_mass = largest(np.abs(self._Ms) @ np.abs(accelerations)[..., None])
        return max(by_mass, largest(self._state.held), self._bias_scale, self._gravity_scale)

    def errors(self, terms: Mapping[str, Array]) -> Differences:
        """Compare terms, by their names in `Dynamics`, and return the fields of the certificate that they give.

        Raises CertificationFailed if a term differs by more than rounding.
        """
        worst, speeds = Differences(), self._state.speeds
        if (Ms := terms.get("mass_matrices")) is not None:
            worst.add("max_mass_error", "the mass matrix", Ms - self._Ms, self._mass_scale)
        if (by_speed := terms.get("coriolis_torques")) is not None:
            worst.add("max_coriolis_error", "a Coriolis torque", by_speed - self._by_speed, self._bias_scale)
        if (Cs := terms.get("coriolis_matrices")) is not None:
            skew = Cs + Cs.swapaxes(1, 2) - (self._Ss + self._Ss.swapaxes(1, 2))
            worst.add("max_skew_error", "the mass matrix's derivative", skew, self._speed_scale)
        if (by_gravity := terms.get("gravity_torques")) is not None:
            worst.add("max_gravity_error", "a gravity torque", by_gravity - self._by_gravity, self._gravity_scale)
        if (kinetic := terms.get("kinetic_energies")) is not None:
            expected = np.einsum("ki,kij,kj->k", speeds, self._Ms, speeds) / 2.0
            worst.add("max_energy_error", "the kinetic energy", kinetic - expected, self._bias_scale)
            potential = terms["potential_energies"] - self._moving.potential_energies(self._gravity)
            weights = largest(self._moving.masses @ np.abs(self._moving.centers)) * largest(self._gravity)
            worst.add("max_energy_error", "the potential energy", potential, weights)
        return worst

    def torque_error(self, accelerations: Array, torques: Array) -> float:
        """Return the largest residual M q̈ + C q̇ + g + Jᵀγ - τ, [N m or N]; raises as `errors` does."""
        by_mass = (self._Ms @ accelerations[..., None])[..., 0]
        expected = by_mass + self._by_speed + self._by_gravity + self._state.held
        return agreed("a torque", torques - expected, self.scale(accelerations))
