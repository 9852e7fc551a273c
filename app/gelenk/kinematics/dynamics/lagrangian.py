"""The equations of motion as the Lagrangian's sums over the bodies, which check the results of `dynamics`."""

from dataclasses import dataclass

import numpy as np

from gelenk.kinematics.dynamics.bodies import Motions
from gelenk.kinematics.judge.judge import agreed
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
        qs: Configurations; shape (N, n), [rad or m].
        speeds: q̇; shape (N, n), [rad/s or m/s].
        held: Jᵀγ, the torques that the wrench at the tip requires; shape (N, n), [N m or N].
    """

    qs: Array
    speeds: Array
    held: Array


def unit_scales(Ms: Array) -> Array:
    """Return the square roots of M's diagonal, zero where an entry is rounding; shape (N, n, n) → (N, n)."""
    diagonals = np.diagonal(Ms, axis1=1, axis2=2)
    least = _ROUNDING * diagonals.max(axis=1, initial=0.0, keepdims=True)
    scales: Array = np.sqrt(np.where(diagonals > least, diagonals, 0.0))
    return scales


def scaled(Ms: Array, scales: Array) -> Array:
    """Divide rows and columns of M by scales, with zero where a scale is zero; shapes (N, n, n), (N, n)."""
    inverses = np.divide(1.0, scales, out=np.zeros_like(scales), where=scales > 0.0)
    quotient: Array = Ms * inverses[:, :, None] * inverses[:, None, :]
    return quotient


class Lagrangian:
    """The equations of motion by sums over bodies, with comparisons of other results.

    A comparison returns None if the other result is None, and raises CertificationFailed if the two differ by more than
    rounding.

    Args:
        moving: The bodies.
        state: The states of the chain.
        gravity: Gravity in the root's axes; shape (3,), [m/s²].
    """

    def __init__(self, moving: Motions, state: State, gravity: Array) -> None:
        self._state, self._moving, self._gravity = state, moving, gravity
        self._Ms, self._Ss = moving.mass_matrices(), moving.velocity_products()
        self._by_speed = np.einsum("kij,kj->ki", self._Ss, state.speeds)
        self._by_gravity = moving.gravity_torques(gravity)
        self._mass_scale = moving.mass_scale()
        self._speed_scale = self._mass_scale * float(np.abs(state.speeds).max(initial=0.0))
        self._bias_scale = self._speed_scale * float(np.abs(state.speeds).max(initial=0.0))
        self._gravity_scale = moving.gravity_scale(gravity)

    def is_definite(self) -> bool:
        """Return whether all M are positive definite beyond rounding."""
        values = np.linalg.eigvalsh(scaled(self._Ms, unit_scales(self._Ms)))
        return bool((values[:, 0] > SINGULAR).all())

    def scale(self, accelerations: Array) -> float:
        """Return the largest term of M q̈ + C q̇ + g + Jᵀγ, [N m or N]."""
        by_mass = (np.abs(self._Ms) @ np.abs(accelerations)[..., None]).max(initial=0.0)
        held = np.abs(self._state.held).max(initial=0.0)
        return max(float(by_mass), float(held), self._bias_scale, self._gravity_scale)

    def mass_error(self, Ms: Array | None) -> float | None:
        """Return the largest error in an entry of M."""
        return None if Ms is None else agreed("the mass matrix", Ms - self._Ms, self._mass_scale)

    def coriolis_error(self, torques: Array | None) -> float | None:
        """Return the largest error in C q̇, [N m or N]."""
        return None if torques is None else agreed("a Coriolis torque", torques - self._by_speed, self._bias_scale)

    def skew_error(self, Cs: Array | None) -> float | None:
        """Return the largest entry of C + Cᵀ - Ṁ."""
        if Cs is None:
            return None
        M_dots = self._Ss + self._Ss.swapaxes(1, 2)
        return agreed("the mass matrix's derivative", Cs + Cs.swapaxes(1, 2) - M_dots, self._speed_scale)

    def gravity_error(self, torques: Array | None) -> float | None:
        """Return the largest error in g, [N m or N]."""
        return None if torques is None else agreed("a gravity torque", torques - self._by_gravity, self._gravity_scale)

    def energy_error(self, kinetic: Array | None, potential: Array | None) -> float | None:
        """Return the largest error in T or U, [J]."""
        if kinetic is None or potential is None:
            return None
        speeds = self._state.speeds
        expected = np.einsum("ki,kij,kj->k", speeds, self._Ms, speeds) / 2.0
        error = agreed("the kinetic energy", kinetic - expected, self._bias_scale)
        expected = self._moving.potential_energies(self._gravity)
        weights = np.abs(self._moving.masses @ np.abs(self._moving.centers)).max() * np.abs(self._gravity).max()
        return max(error, agreed("the potential energy", potential - expected, float(weights)))

    def torque_error(self, accelerations: Array, torques: Array) -> float:
        """Return the largest residual M q̈ + C q̇ + g + Jᵀγ - τ, [N m or N]."""
        by_mass = (self._Ms @ accelerations[..., None])[..., 0]
        expected = by_mass + self._by_speed + self._by_gravity + self._state.held
        return agreed("a torque", torques - expected, self.scale(accelerations))
